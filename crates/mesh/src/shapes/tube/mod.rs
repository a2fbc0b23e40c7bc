//! What a ball passes over along a path: the envelope of the balls.
//!
//! Where the ball's radius changes by s along a unit of the way, the circle in which the envelope touches the ball lies
//! s times the radius behind its middle, and its normals lean back by as much: n = -s t + sqrt(1 - s^2) e, with t along
//! the path and e across it. Where s is 1 or more one ball swallows the others: the circle is a point.
//!
//! Each piece of the path is the cone between two such circles, each joint the part of its ball between the circles of
//! both pieces ([`elbow`]). A point is inside as often as there are stretches of the path whose balls it is in: where
//! the distance to the ball's middle less its radius is least it enters one, and leaves where it is most. So the
//! surface is that of all balls, whatever the path; parts of it may lie within.
//!
//! The circle of each joint is numbered round by a frame that turns as little as it can (double reflection: Wang,
//! Jüttler, Zheng, Liu, "Computation of Rotation Minimizing Frames", 2008).

#![expect(clippy::indexing_slicing, reason = "rings and corners are numbered here")]

mod elbow;
mod swept;

use self::elbow::circles;
use self::swept::Swept;
use super::axis::cross;
use super::{MOST_TRIANGLES, Triangulated, check_count};
use crate::data::MeshData;
use scene_format::desc::{Tube, TubeCurve};
use scene_format::diagnostic::Span;
use scene_format::path::{Ends, Piece, Point3, bezier_pieces, dot, length, pieces, sub, turn, unit};
use scene_format::{Diagnostic, codes};
use std::f64::consts::TAU;

impl Triangulated for Tube {
    fn noun(&self) -> &'static str {
        "tube"
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn mesh(&self, span: Span) -> Result<MeshData, Box<Diagnostic>> {
        let at = if self.points.span == Span::NONE { span } else { self.points.span };
        let (points, radii) = self.path(span)?;
        let segments = self.segments.value;
        let step = TAU / f64::from(segments);
        let smooth = self.curve != TubeCurve::Linear;
        let ends = if self.closed { Ends::Joined } else { Ends::Open };
        let pieces = match self.curve {
            TubeCurve::Bezier => bezier_pieces(&points, step, (MOST_TRIANGLES / u64::from(2 * segments)) as usize),
            TubeCurve::Linear | TubeCurve::CatmullRom => pieces(&points, ends, smooth, step),
        };
        let too_many = |triangles: u64| check_count(triangles, "tube", at, "fewer points, or fewer `segments`");
        too_many(2 * u64::from(segments) * pieces.len() as u64)?;
        if pieces.is_empty() {
            // A loop of handles so short that rounding leaves nothing of it.
            let fault = Diagnostic::error(codes::NO_EXTENT, at, "the path of the tube has no extent");
            return Err(Box::new(fault.expected("two points or more that are not the same")));
        }
        let joints = joints(&pieces, &radii, self, step);
        let circles: Vec<Vec<_>> = joints.iter().map(|joint| circles(joint, segments)).collect();
        let ends = if self.closed { 0 } else { u64::from(segments) / 2 };
        let rings = ends + circles.iter().map(|circles| circles.len() as u64).sum::<u64>();
        too_many(2 * u64::from(segments) * rings)?;
        let swept = Swept::new(segments, self.closed, !smooth);
        let mesh = swept.swept(&joints, &circles);
        too_many(mesh.triangles.len() as u64)?;
        Ok(mesh)
    }
}

/// Where pieces of the path meet, or it ends.
#[derive(Clone, Copy, Debug)]
struct Joint {
    at: Point3,
    radius: f64,
    /// The piece that comes here and the one that leaves; one is the other's where the path ends.
    sides: [Side; 2],
    /// Length of the path up to here.
    along: f64,
}

/// A piece at a joint.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// Which way it goes, of unit length.
    direction: Point3,
    /// By which angle normals lean back; its sine is what the radius changes by along a unit of the way.
    lean: f64,
}

/// A smooth tube's piece is cut in so many at most where its radius swells.
const MOST_PARTS: f64 = 256.0;

/// The joints of a path; of a closed one the last is the first once more.
fn joints(pieces: &[Piece<3>], radii: &[f64], tube: &Tube, step: f64) -> Vec<Joint> {
    let chord = |piece: &Piece<3>| sub(piece.to, piece.from);
    let profile = Radius::new(pieces, radii, tube);
    let mut joints: Vec<Joint> = Vec::with_capacity(pieces.len() + 1);
    let (mut along, mut within, mut last) = (0.0, 0.0, 0);
    for piece in pieces {
        let (way, whole) = (chord(piece), length(chord(piece)));
        if piece.number != last {
            (within, last) = (0.0, piece.number);
        }
        // A piece that is no finer for all cuts, as where a curve turns nearly back, is straight with elbows.
        let mut directions = piece.directions;
        if let Some(straight) = unit(way)
            && directions.iter().map(|&direction| turn(direction, straight)).sum::<f64>() > 2.0 * step
        {
            directions = [straight; 2];
        }
        let at = |share: f64| profile.at(piece.number, within + share * whole);
        let leans = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| at(share).1);
        let swells: f64 = leans.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum();
        let parts = (swells / step).ceil().clamp(1.0, MOST_PARTS);
        for part in 0..parts as u32 {
            let [begin, end] = [part, part + 1].map(|part| f64::from(part) / parts);
            let side = |share: f64| {
                let direction = match share {
                    0.0 => directions[0],
                    1.0 => directions[1],
                    _ => unit(blend(directions[0], 1.0 - share, directions[1], share)).unwrap_or(directions[0]),
                };
                Side { direction, lean: at(share).1 }
            };
            match joints.last_mut() {
                Some(joint) => joint.sides[1] = side(begin),
                None => joints.push(Joint { at: piece.from, radius: at(0.0).0, sides: [side(begin); 2], along }),
            }
            let place = if end == 1.0 { piece.to } else { add(piece.from, way, end) };
            let along = along + end * whole;
            joints.push(Joint { at: place, radius: at(end).0, sides: [side(end); 2], along });
        }
        along += whole;
        within += whole;
    }
    if tube.closed {
        let end = joints.len() - 1;
        let sides = [joints[end].sides[0], joints[0].sides[1]];
        (joints[0].sides, joints[end].sides) = (sides, sides);
    }
    joints
}

/// The ball's radius along a path.
struct Radius<'a> {
    radii: &'a [f64],
    /// How long each span between two written points is.
    spans: Vec<f64>,
    /// Its slopes at the points, of a smooth path.
    slopes: Option<Vec<f64>>,
}

impl<'a> Radius<'a> {
    fn new(pieces: &[Piece<3>], radii: &'a [f64], tube: &Tube) -> Self {
        let mut spans = vec![0.0; if tube.closed { radii.len() } else { radii.len() - 1 }];
        pieces.iter().for_each(|piece| spans[piece.number] += length(sub(piece.to, piece.from)));
        let smooth = tube.curve != TubeCurve::Linear;
        let slopes = smooth.then(|| monotone(radii, &spans, tube.closed));
        Radius { radii, spans, slopes }
    }

    /// Radius and lean in a span, so far from its beginning.
    fn at(&self, span: usize, from: f64) -> (f64, f64) {
        let next = (span + 1) % self.radii.len();
        let (one, other) = (self.radii[span], self.radii[next]);
        let whole = self.spans[span];
        let t = (from / whole).clamp(0.0, 1.0);
        let chord = (other - one) / whole;
        let Some(slopes) = &self.slopes else {
            return (one + (other - one) * t, libm::asin(chord.clamp(-1.0, 1.0)));
        };
        let (a, b) = (slopes[span], slopes[next]);
        let (t2, t3) = (t * t, t * t * t);
        let value = one + whole * (a * (t3 - 2.0 * t2 + t) + b * (t3 - t2) + chord * (3.0 * t2 - 2.0 * t3));
        let slope = a * (3.0 * t2 - 4.0 * t + 1.0) + b * (3.0 * t2 - 2.0 * t) + 6.0 * chord * (t - t2);
        (value, libm::asin(slope.clamp(-1.0, 1.0)))
    }
}

/// Slopes of a smooth curve through these values, so many units apart, that nowhere passes beyond them (Fritsch,
/// Butland, "A method for constructing local monotone piecewise cubic interpolants", 1984).
fn monotone(values: &[f64], ways: &[f64], closed: bool) -> Vec<f64> {
    let count = values.len();
    let chord = |k: usize| if ways[k] > 0.0 { (values[(k + 1) % count] - values[k]) / ways[k] } else { 0.0 };
    let slope = |k: usize| {
        if !closed && (k == 0 || k + 1 == count) {
            return if k == 0 { chord(0) } else { chord(k - 1) };
        }
        let before = (k + ways.len() - 1) % ways.len();
        let (one, other) = (chord(before), chord(k));
        if one * other <= 0.0 {
            return 0.0;
        }
        let share = (ways[before] + 2.0 * ways[k]) / (3.0 * (ways[before] + ways[k]));
        one * other / (share * other + (1.0 - share) * one)
    };
    (0..count).map(slope).collect()
}

fn add(a: Point3, b: Point3, times: f64) -> Point3 {
    std::array::from_fn(|axis| a[axis] + times * b[axis])
}

fn blend(a: Point3, x: f64, b: Point3, y: f64) -> Point3 {
    std::array::from_fn(|axis| x * a[axis] + y * b[axis])
}

/// Of unit length, across a unit direction.
fn across(direction: Point3) -> Point3 {
    let [x, y, z] = direction.map(f64::abs);
    let axis = if x <= y && x <= z {
        [1.0, 0.0, 0.0]
    } else if y <= z {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    unit(cross(direction, axis)).unwrap_or(axis)
}

/// What a direction across `from` turns into where `from` turns into `to` by the shortest way.
fn turned(x: Point3, from: Point3, to: Point3) -> Point3 {
    // Two reflections: first to the direction half way, then to the other. Straight back: about x.
    let half = add(from, to, 1.0);
    let last = match unit(half) {
        Some(half) if dot(from, to) > -1.0 + 1e-15 => {
            let mirrored = add(x, half, -2.0 * dot(x, half));
            add(mirrored, to, -2.0 * dot(mirrored, to))
        }
        _ => x,
    };
    unit(add(last, to, -dot(last, to))).unwrap_or_else(|| across(to))
}
