//! What a ball passes over along a path: the envelope of the balls.
//!
//! Where the ball's radius changes by s along a unit of the way, the circle in which the envelope touches the ball lies
//! s times the radius behind its middle, and its normals lean back by as much: n = -s t + sqrt(1 - s^2) e, with t along
//! the path and e across it.
//!
//! The circle of each joint is numbered round by a frame that turns as little as it can (double reflection: Wang,
//! Jüttler, Zheng, Liu, "Computation of Rotation Minimizing Frames", 2008). Where the path has an elbow, the ball
//! itself shows on the outer side, a fan about its middle, and on the inner side both pieces meet in the plane between
//! them.

#![expect(clippy::indexing_slicing, reason = "rings and corners are numbered here")]

use super::axis::cross;
use super::{Triangulated, check_count};
use crate::data::MeshData;
use scene_format::Diagnostic;
use scene_format::desc::{Curve, Tube};
use scene_format::diagnostic::Span;
use scene_format::path::{Ends, Piece, Point3, dot, length, pieces, sub, turn, unit};
use std::f64::consts::{FRAC_PI_2, TAU};

/// The radius of smooth tubes changes by so much of the way at most: what is steeper is nearly a ball.
const STEEPEST: f64 = 0.98;

/// Directions that turn by less are one: curves are smooth but for rounding.
const SMOOTH: f64 = 1e-6;

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
        let ends = if self.closed { Ends::Joined } else { Ends::Open };
        let pieces = pieces(&points, ends, self.curve == Curve::CatmullRom, TAU / f64::from(segments));
        // An elbow, and each end, has rings of its own: half a turn of them at most.
        let elbows = if self.curve == Curve::Linear { points.len() } else { 2 };
        let rings = pieces.len() as u64 + elbows as u64 * u64::from(segments);
        check_count(2 * u64::from(segments) * rings, "tube", at, "fewer points, or fewer `segments`")?;
        let joints = joints(&pieces, &radii, self);
        Ok(Swept { data: MeshData::default(), segments, closed: self.closed }.swept(&joints))
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
    /// What its radius changes by along a unit of the way.
    slope: f64,
}

/// The joints of a path; of a closed one the last is the first once more.
fn joints(pieces: &[Piece<3>], radii: &[f64], tube: &Tube) -> Vec<Joint> {
    let lengths: Vec<f64> = pieces.iter().map(|piece| length(sub(piece.to, piece.from))).collect();
    // How long each span between two written points is.
    let mut spans = vec![0.0; if tube.closed { radii.len() } else { radii.len() - 1 }];
    pieces.iter().zip(&lengths).for_each(|(piece, length)| spans[piece.number] += length);
    let smooth = tube.curve == Curve::CatmullRom;
    let slopes = if smooth { monotone(radii, &spans, tube.closed) } else { Vec::new() };
    let count = radii.len();
    // Radius and slope in a span, by length from its beginning.
    let radius = |span: usize, from: f64| {
        let (one, other) = (radii[span], radii[(span + 1) % count]);
        let (whole, t) = (spans[span], from / spans[span]);
        let chord = (other - one) / whole;
        if !smooth {
            return (one + (other - one) * t, chord);
        }
        let (a, b) = (slopes[span], slopes[(span + 1) % count]);
        let (t2, t3) = (t * t, t * t * t);
        let value = one + whole * (a * (t3 - 2.0 * t2 + t) + b * (t3 - t2) + chord * (3.0 * t2 - 2.0 * t3));
        let slope = a * (3.0 * t2 - 4.0 * t + 1.0) + b * (3.0 * t2 - 2.0 * t) + 6.0 * chord * (t - t2);
        (value, slope.clamp(-STEEPEST, STEEPEST))
    };
    let mut joints: Vec<Joint> = Vec::with_capacity(pieces.len() + 1);
    let (mut along, mut within, mut last) = (0.0, 0.0, 0);
    for (piece, length) in pieces.iter().zip(&lengths) {
        if piece.number != last {
            (within, last) = (0.0, piece.number);
        }
        let [begin, end] = [within, (within + length).min(spans[piece.number])].map(|from| radius(piece.number, from));
        let leaving = Side { direction: piece.directions[0], slope: begin.1 };
        match joints.last_mut() {
            Some(joint) => joint.sides[1] = leaving,
            None => joints.push(Joint { at: piece.from, radius: begin.0, sides: [leaving; 2], along }),
        }
        along += length;
        within += length;
        let coming = Side { direction: piece.directions[1], slope: end.1 };
        joints.push(Joint { at: piece.to, radius: end.0, sides: [coming; 2], along });
    }
    if tube.closed {
        let end = joints.len() - 1;
        let sides = [joints[end].sides[0], joints[0].sides[1]];
        (joints[0].sides, joints[end].sides) = (sides, sides);
    }
    joints
}

/// Slopes of a smooth curve through these values, so many units apart, that nowhere passes beyond them (Fritsch,
/// Butland, "A method for constructing local monotone piecewise cubic interpolants", 1984).
fn monotone(values: &[f64], ways: &[f64], closed: bool) -> Vec<f64> {
    let count = values.len();
    let chord = |k: usize| (values[(k + 1) % count] - values[k]) / ways[k];
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
    // Two reflections: first to the direction half way, then to the other.
    let Some(half) = unit(add(from, to, 1.0)) else {
        // Straight back: about x.
        return x;
    };
    let mirrored = add(x, half, -2.0 * dot(x, half));
    let last = add(mirrored, to, -2.0 * dot(mirrored, to));
    unit(last).unwrap_or(x)
}

/// A ring of vertices: numbers of their positions, of the first of as many normals, and of the first of one texture
/// coordinate more.
struct Ring {
    positions: Vec<u32>,
    normal: u32,
    uvs: u32,
    /// All positions are one.
    is_tip: bool,
}

/// A tube in the making.
struct Swept {
    data: MeshData,
    segments: u32,
    closed: bool,
}

impl Swept {
    fn swept(mut self, joints: &[Joint]) -> MeshData {
        let (first, last) = (&joints[0], &joints[joints.len() - 1]);
        // From the tips of the round ends to their circles.
        let before = if self.closed { 0.0 } else { first.radius * end_angle(first, true) };
        let whole = before + last.along + if self.closed { 0.0 } else { last.radius * end_angle(last, false) };
        let [begin, end] = frames(joints);
        let twist = if self.closed {
            libm::atan2(dot(cross(end, begin), first.sides[1].direction), dot(end, begin))
        } else {
            0.0
        };
        let mut frame = turned(begin, first.sides[1].direction, first.sides[0].direction);
        let mut last_ring: Option<Ring> = None;
        // A closed path ends with the elbow that it begins behind.
        let mut closing: Vec<Ring> = Vec::new();
        for (k, joint) in joints.iter().enumerate() {
            let [coming, leaving] = joint.sides.map(|side| side.direction);
            let (is_first, is_last) = (k == 0, k + 1 == joints.len());
            let round = Round { frame, turn: twist * joint.along / last.along };
            let rings = match (self.closed, is_first || is_last) {
                (false, true) => self.end(joint, &round, is_first, [before + joint.along, whole]),
                (true, true) if is_first => {
                    closing = self.elbow(joint, &round, 1.0);
                    closing.last().map(|ring| self.again(ring, 0.0)).into_iter().collect()
                }
                (true, true) => std::mem::take(&mut closing),
                (_, false) => self.elbow(joint, &round, (before + joint.along) / whole),
            };
            for ring in rings {
                if let Some(before) = &last_ring {
                    self.band(before, &ring);
                }
                last_ring = Some(ring);
            }
            frame = turned(frame, coming, leaving);
            if let Some(next) = joints.get(k + 1) {
                frame = turned(frame, leaving, next.sides[0].direction);
            }
        }
        self.data
    }

    /// The rings of a joint within the path: one where the path is smooth.
    fn elbow(&mut self, joint: &Joint, round: &Round, v: f64) -> Vec<Ring> {
        let [coming, leaving] = joint.sides;
        let lean = libm::asin(leaving.slope) - libm::asin(coming.slope);
        let angle = turn(coming.direction, leaving.direction) + lean.abs();
        let count = if angle < SMOOTH { 0 } else { (angle * f64::from(self.segments) / TAU).ceil().max(1.0) as usize };
        let half = unit(add(coming.direction, leaving.direction, 1.0)).unwrap_or(coming.direction);
        let after = Round { frame: turned(round.frame, coming.direction, leaving.direction), ..*round };
        let columns: Vec<Column> = (0..self.segments)
            .map(|k| {
                let angle = TAU * f64::from(k) / f64::from(self.segments);
                let normals = [round.normal(&coming, angle), after.normal(&leaving, angle)];
                // At the sides of an elbow both normals are one.
                let is_inner = dot(sub(normals[1], normals[0]), half) < SMOOTH;
                let meeting = is_inner.then(|| {
                    let of = |side: &Side, n: Point3| {
                        // Along the surface to the plane between the pieces.
                        let along = add(side.direction, n, -dot(side.direction, n));
                        let way = -joint.radius * dot(n, half) / dot(along, half);
                        add(n.map(|x| joint.radius * x), along, way)
                    };
                    let [one, other] = [of(&coming, normals[0]), of(&leaving, normals[1])];
                    let middle: Point3 = std::array::from_fn(|axis| 0.5 * (one[axis] + other[axis]));
                    self.position(add(joint.at, middle, 1.0))
                });
                Column { normals, meeting }
            })
            .collect();
        (0..=count)
            .map(|n| {
                let share = if count == 0 { 0.5 } else { n as f64 / count as f64 };
                let normals: Vec<Point3> = columns.iter().map(|column| between(column.normals, share)).collect();
                let position = |(column, &normal): (&Column, &Point3)| match column.meeting.filter(|_| count > 0) {
                    Some(meeting) => meeting,
                    None => self.position(add(joint.at, normal, joint.radius)),
                };
                let positions = columns.iter().zip(&normals).map(position).collect();
                self.ring(positions, &normals, v, false)
            })
            .collect()
    }

    /// The rings of a round end. `along`, `whole`: length up to its circle, and of all.
    fn end(&mut self, joint: &Joint, round: &Round, is_first: bool, [along, whole]: [f64; 2]) -> Vec<Ring> {
        let side = if is_first { joint.sides[1] } else { joint.sides[0] };
        let angle = end_angle(joint, is_first);
        let axis = side.direction.map(|x| if is_first { -x } else { x });
        let count = (angle * f64::from(self.segments) / TAU).ceil().max(1.0) as u32;
        let mut rings = Vec::with_capacity(count as usize + 1);
        for n in 0..=count {
            // From the tip.
            let from_tip = f64::from(if is_first { n } else { count - n }) / f64::from(count) * angle;
            let off = (angle - from_tip) * joint.radius;
            let v = (if is_first { along - off } else { along + off }) / whole;
            if from_tip == 0.0 {
                let tip = self.position(add(joint.at, axis, joint.radius));
                let number = self.segments as usize;
                rings.push(self.ring(vec![tip; number], &vec![axis; number], v, true));
                continue;
            }
            let (sin, cos) = (libm::sin(from_tip), libm::cos(from_tip));
            let flat = Side { slope: 0.0, ..side };
            let normals: Vec<Point3> = (0..self.segments)
                .map(|k| {
                    let across = round.normal(&flat, TAU * f64::from(k) / f64::from(self.segments));
                    add(across.map(|x| sin * x), axis, cos)
                })
                .collect();
            let positions = normals.iter().map(|&n| self.position(add(joint.at, n, joint.radius))).collect();
            rings.push(self.ring(positions, &normals, v, false));
        }
        rings
    }

    fn position(&mut self, at: Point3) -> u32 {
        self.data.positions.push(at);
        self.data.positions.len() as u32 - 1
    }

    fn ring(&mut self, positions: Vec<u32>, normals: &[Point3], v: f64, is_tip: bool) -> Ring {
        let (normal, uvs) = (self.data.normals.len() as u32, self.uvs(v, is_tip));
        self.data.normals.extend(normals.iter().map(|n| n.map(|x| x as f32)));
        Ring { positions, normal, uvs, is_tip }
    }

    /// Adds texture coordinates of a ring; gives the number of the first.
    fn uvs(&mut self, v: f64, is_tip: bool) -> u32 {
        let first = self.data.uvs.len() as u32;
        // At a tip each triangle has its own.
        let shift = if is_tip { 0.5 } else { 0.0 };
        let u = |k: u32| (f64::from(k) + shift) / f64::from(self.segments);
        self.data.uvs.extend((0..=self.segments).map(|k| [u(k) as f32, v as f32]));
        first
    }

    /// A ring that is where another is, with other texture coordinates.
    fn again(&mut self, ring: &Ring, v: f64) -> Ring {
        let uvs = self.uvs(v, ring.is_tip);
        Ring { positions: ring.positions.clone(), uvs, ..*ring }
    }

    /// Adds what lies between two rings. Where both have one vertex, nothing does.
    fn band(&mut self, from: &Ring, to: &Ring) {
        for k in 0..self.segments as usize {
            let next = (k + 1) % self.segments as usize;
            let corner = |ring: &Ring, last: bool| {
                let at = if last { next } else { k };
                let uv = k as u32 + u32::from(last && !ring.is_tip);
                [ring.positions[at], ring.normal + at as u32, ring.uvs + uv]
            };
            let [a, b, c, d] = [corner(from, false), corner(from, true), corner(to, true), corner(to, false)];
            // One of the two where two corners are one: it does not matter which has that corner.
            self.triangle([a, b, c]);
            self.triangle([a, c, d]);
        }
    }

    fn triangle(&mut self, corners: [[u32; 3]; 3]) {
        let [a, b, c] = corners.map(|corner| corner[0]);
        if a == b || b == c || c == a {
            return;
        }
        let data = &mut self.data;
        data.triangles.push([a, b, c]);
        data.normal_triangles.get_or_insert_default().push(corners.map(|corner| corner[1]));
        data.uv_triangles.get_or_insert_default().push(corners.map(|corner| corner[2]));
    }
}

/// How vertices go round the path.
#[derive(Clone, Copy, Debug)]
struct Round {
    /// Across the path, where they begin.
    frame: Point3,
    /// By how much they are turned about the path from there, so that those of a closed path meet.
    turn: f64,
}

impl Round {
    /// The normal at an angle.
    fn normal(&self, side: &Side, angle: f64) -> Point3 {
        let (sin, cos) = (libm::sin(angle + self.turn), libm::cos(angle + self.turn));
        let across = add(self.frame.map(|x| cos * x), cross(side.direction, self.frame), sin);
        let upright = (1.0 - side.slope * side.slope).sqrt();
        add(across.map(|x| upright * x), side.direction, -side.slope)
    }
}

/// A line along the tube at a joint.
struct Column {
    /// Of the piece that comes and of the one that leaves.
    normals: [Point3; 2],
    /// The vertex in which both meet on the inner side of an elbow.
    meeting: Option<u32>,
}

/// The angle from the tip of a round end to the circle in which it meets the rest.
fn end_angle(joint: &Joint, is_first: bool) -> f64 {
    let lean = libm::asin(joint.sides[0].slope);
    FRAC_PI_2 + if is_first { -lean } else { lean }
}

/// Frames, that turn as little as they can, where the path begins and where one comes again at its end.
fn frames(joints: &[Joint]) -> [Point3; 2] {
    let begin = across(joints[0].sides[1].direction);
    let (mut frame, mut direction) = (begin, joints[0].sides[1].direction);
    for joint in &joints[1..] {
        for side in joint.sides {
            frame = turned(frame, direction, side.direction);
            direction = side.direction;
        }
    }
    [begin, frame]
}

/// A unit vector on the way from one to another.
fn between([one, other]: [Point3; 2], share: f64) -> Point3 {
    let angle = turn(one, other);
    let sin = libm::sin(angle);
    if sin < 1e-9 {
        return one;
    }
    let [a, b] = [1.0 - share, share].map(|share| libm::sin(share * angle) / sin);
    add(one.map(|x| a * x), other, b)
}
