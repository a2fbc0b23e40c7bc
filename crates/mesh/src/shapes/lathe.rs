//! Profiles that turn about the y axis.

#![expect(clippy::indexing_slicing, reason = "rings and corners are numbered here")]

use super::skew::{self, Cut};
use super::{Triangulated, check_count};
use crate::data::MeshData;
use scene_format::Diagnostic;
use scene_format::desc::{Curve, Lathe};
use scene_format::diagnostic::Span;
use scene_format::path::{Piece, Point, length, pieces, smooth, sub, unit};
use std::f64::consts::{PI, TAU};

/// Tips whose sides turn by less than this from the axis to the other side are shaded as round: half of 40 degrees.
const ROUND_TIP: f64 = 0.342_020_143_325_669;

impl Triangulated for Lathe {
    fn noun(&self) -> &'static str {
        "lathe"
    }

    fn is_closed(&self) -> bool {
        self.profile.value.turned().closed
    }

    fn way_to_close(&self) -> &'static str {
        "let the profile go from the axis to the axis, or back to its first point"
    }

    fn mesh(&self, span: Span) -> Result<MeshData, Box<Diagnostic>> {
        let at = if self.profile.span == Span::NONE { span } else { self.profile.span };
        let turning = self.profile.value.turned();
        if let Some(fault) = turning.fault(at) {
            return Err(Box::new(fault));
        }
        let segments = self.segments.value;
        let curved = self.curve == Curve::CatmullRom;
        let mut profile = pieces(&turning.points, turning.ends, curved, TAU / f64::from(segments));
        for piece in &mut profile {
            // Where a curve would cross the axis.
            piece.from[0] = piece.from[0].max(0.0);
            piece.to[0] = piece.to[0].max(0.0);
        }
        // What goes along the axis is no surface.
        profile.retain(|piece| piece.from != piece.to && (piece.from[0] > 0.0 || piece.to[0] > 0.0));
        let plan = Plan::new(&profile);
        let hint = "fewer points in the profile, or fewer `segments`";
        check_count(plan.triangles(segments), "lathe", at, hint)?;
        Ok(plan.turned(segments, turning.closed))
    }
}

/// What pieces of a profile pass over as they turn, and how that is cut.
pub(super) struct Plan<'a> {
    profile: &'a [Piece],
    /// Which way each piece's profile goes at both ends, as it is shaded, and how it is cut.
    bands: Vec<([Point; 2], Cut)>,
}

impl<'a> Plan<'a> {
    pub(super) fn new(profile: &'a [Piece]) -> Self {
        let count = profile.len();
        let neighbour = |other: &Piece, here: Point, there: Point| if here == there { Some(*other) } else { None };
        let band = |(k, piece): (usize, &Piece)| {
            let [before, after] = [&profile[(k + count - 1) % count], &profile[(k + 1) % count]];
            let before = neighbour(before, before.to, piece.from);
            let after = neighbour(after, after.from, piece.to);
            let directions = [
                before.and_then(|b| smooth(b.directions[1], piece.directions[0])).unwrap_or(piece.directions[0]),
                after.and_then(|a| smooth(piece.directions[1], a.directions[0])).unwrap_or(piece.directions[1]),
            ];
            let (radii, outs) = ([piece.from[0], piece.to[0]], directions.map(|direction| direction[1]));
            let cut = match radii.iter().position(|radius| *radius == 0.0) {
                // A round tip has the axis for its normal, and those of its triangles go evenly to that of the ring.
                Some(tip) if is_round(outs[tip]) => Cut::to_tip(tip == 1, [0.0; 2]),
                Some(tip) => Cut::to_tip(tip == 1, outs),
                None => Cut::new(radii, outs),
            };
            (directions, cut)
        };
        Plan { profile, bands: profile.iter().enumerate().map(band).collect() }
    }

    pub(super) fn triangles(&self, segments: u32) -> u64 {
        let of = |(piece, (_, cut)): (&Piece, &(_, Cut))| cut.triangles([piece.from, piece.to].map(|p| p[0] == 0.0));
        u64::from(segments) * self.profile.iter().zip(&self.bands).map(of).sum::<u64>()
    }

    /// The triangles. Of closed ones the outside is the front.
    pub(super) fn turned(&self, segments: u32, closed: bool) -> MeshData {
        let profile = self.profile;
        // Pappus, piece by piece: up on the outside, down on the inside.
        let volume = |piece: &Piece| {
            let ([r, y], [s, z]) = (piece.from, piece.to);
            (z - y) * (r * r + r * s + s * s)
        };
        let inward = closed && profile.iter().map(volume).sum::<f64>() < 0.0;
        let mut mesh = Turned { segments, inward, ..Turned::default() };
        let around = |shift: f64| {
            let angle = move |k: u32| TAU * (f64::from(k) + shift) / f64::from(segments) - PI;
            (0..segments).map(|k| [libm::sin(angle(k)), libm::cos(angle(k))]).collect()
        };
        (mesh.around, mesh.halfway) = (around(0.0), around(0.5));
        let whole: f64 = profile.iter().map(|piece| length(sub(piece.to, piece.from))).sum();
        let mut along = 0.0;
        let mut last: Option<(Point, u32)> = None;
        let mut first = None;
        for (k, (piece, (directions, cut))) in profile.iter().zip(&self.bands).enumerate() {
            let count = profile.len();
            let from = match last {
                Some((point, ring)) if point == piece.from => ring,
                _ => mesh.ring(piece.from),
            };
            let first_ring = *first.get_or_insert((piece.from, from));
            let to = match k + 1 == count && count > 1 && first_ring.0 == piece.to {
                true => first_ring.1,
                false => mesh.ring(piece.to),
            };
            let next = along + length(sub(piece.to, piece.from));
            mesh.bands(piece, [from, to], (*directions, cut), [along / whole, next / whole]);
            (along, last) = (next, Some((piece.to, to)));
        }
        mesh.data
    }
}

/// Whether the sides of a tip with this part of the normal outwards meet smoothly there.
fn is_round(out: f64) -> bool {
    out.abs() <= ROUND_TIP
}

/// A circle of the surface.
#[derive(Clone, Copy)]
struct Circle {
    point: Point,
    direction: Point,
    v: f64,
    /// Numbers of its first position, normal and texture coordinates.
    first: [u32; 3],
}

impl Circle {
    fn is_tip(&self) -> bool {
        self.point[0] == 0.0
    }
}

/// Where vertices lie.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// On a circle.
    Ring,
    /// All on the axis.
    Tip,
    /// In the middle of the pieces between two circles.
    Middle,
}

/// A surface of revolution in the making.
#[derive(Default)]
struct Turned {
    data: MeshData,
    segments: u32,
    /// Whether what the profile's right is on is the inside.
    inward: bool,
    /// Sine and cosine of each vertex's angle, from +z to +x, beginning at -z.
    around: Vec<[f64; 2]>,
    /// Of the middle between it and the next.
    halfway: Vec<[f64; 2]>,
}

impl Turned {
    /// Adds the vertices that a point turns into; one where it is on the axis.
    fn ring(&mut self, [r, y]: Point) -> u32 {
        let first = self.data.positions.len() as u32;
        if r == 0.0 {
            self.data.positions.push([0.0, y, 0.0]);
        } else {
            self.data.positions.extend(self.around.iter().map(|[sin, cos]| [r * sin, y, r * cos]));
        }
        first
    }

    /// Adds normals where the profile goes this way: at the vertices of a ring, or half way between them.
    fn normals(&mut self, direction: Point, place: Place) -> u32 {
        let first = self.data.normals.len() as u32;
        let sign = if self.inward { -1.0 } else { 1.0 };
        let [out, up] = [sign * direction[1], -sign * direction[0]];
        // The sides of a flat tip meet smoothly there.
        let round = place == Place::Tip && is_round(out);
        let angles = if place == Place::Ring { &self.around } else { &self.halfway };
        self.data.normals.extend(angles.iter().map(|&[sin, cos]| match round {
            true => [0.0, up.signum() as f32, 0.0],
            false => [out * sin, up, out * cos].map(|x| x as f32),
        }));
        first
    }

    /// Adds texture coordinates, as normals.
    fn uvs(&mut self, v: f64, place: Place) -> u32 {
        let first = self.data.uvs.len() as u32;
        let is_ring = place == Place::Ring;
        let (count, shift) = if is_ring { (self.segments + 1, 0.0) } else { (self.segments, 0.5) };
        let u = |k: u32| (f64::from(k) + shift) / f64::from(self.segments);
        self.data.uvs.extend((0..count).map(|k| [u(k) as f32, v as f32]));
        first
    }

    /// Adds what a piece of the profile between two rings passes over.
    fn bands(&mut self, piece: &Piece, rings: [u32; 2], (directions, cut): ([Point; 2], &Cut), v: [f64; 2]) {
        let mut before: Option<Circle> = None;
        for &share in &cut.rings {
            let between = |a: Point, b: Point| [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
            let (point, direction) = match share {
                0.0 => (piece.from, directions[0]),
                1.0 => (piece.to, directions[1]),
                _ => {
                    let direction = between(directions[0], directions[1]);
                    (between(piece.from, piece.to), unit(direction).unwrap_or(directions[0]))
                }
            };
            let number = match share {
                0.0 => rings[0],
                1.0 => rings[1],
                _ => self.ring(point),
            };
            let v = v[0] + share * (v[1] - v[0]);
            let place = if point[0] == 0.0 { Place::Tip } else { Place::Ring };
            let first = [number, self.normals(direction, place), self.uvs(v, place)];
            let circle = Circle { point, direction, v, first };
            if let Some(before) = before {
                let tips = before.is_tip() || circle.is_tip();
                let middles = (cut.middles && !tips).then(|| self.middles(&before, &circle));
                self.band(&before, &circle, middles);
            }
            before = Some(circle);
        }
    }

    /// Adds the vertices in the middle of the trapezoids between two circles; gives the numbers of the first.
    fn middles(&mut self, from: &Circle, to: &Circle) -> [u32; 3] {
        let share = skew::middle([from.point[0], to.point[0]]);
        let between = |a: Point, b: Point| [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
        let ([r, y], n) = (between(from.point, to.point), self.segments);
        // Half way along a chord.
        let r = r * libm::cos(PI / f64::from(n));
        let position = self.data.positions.len() as u32;
        self.data.positions.extend(self.halfway.iter().map(|[sin, cos]| [r * sin, y, r * cos]));
        let direction = between(from.direction, to.direction);
        let normal = self.normals(unit(direction).unwrap_or(from.direction), Place::Middle);
        [position, normal, self.uvs(from.v + share * (to.v - from.v), Place::Middle)]
    }

    /// Adds the triangles between two circles.
    fn band(&mut self, from: &Circle, to: &Circle, middles: Option<[u32; 3]>) {
        let n = self.segments;
        // A wall that two lathes share is cut along the same diagonal, whichever way their profiles go.
        let upward = [from.point[1], from.point[0]] < [to.point[1], to.point[0]];
        for k in 0..n {
            let next = (k + 1) % n;
            // Position, normal, texture coordinates of the corner on this circle.
            let corner = |circle: &Circle, last: bool| {
                let around = if last { next } else { k };
                let [position, normal, uv] = circle.first;
                match circle.is_tip() {
                    true => [position, normal + k, uv + k],
                    false => [position + around, normal + around, uv + if last { k + 1 } else { k }],
                }
            };
            let [a, b, c, d] = [corner(from, false), corner(from, true), corner(to, true), corner(to, false)];
            if let Some(middle) = middles {
                let middle = middle.map(|first| first + k);
                for [one, other] in [[a, b], [b, c], [c, d], [d, a]] {
                    self.triangle([one, other, middle]);
                }
                continue;
            }
            let triangles = match (from.is_tip(), to.is_tip()) {
                (true, _) => [Some([a, c, d]), None],
                (_, true) => [Some([a, b, d]), None],
                _ if upward => [Some([a, b, c]), Some([a, c, d])],
                _ => [Some([a, b, d]), Some([b, c, d])],
            };
            triangles.into_iter().flatten().for_each(|triangle| self.triangle(triangle));
        }
    }

    fn triangle(&mut self, [a, b, c]: [[u32; 3]; 3]) {
        let corners = if self.inward { [a, c, b] } else { [a, b, c] };
        let data = &mut self.data;
        data.triangles.push(corners.map(|corner| corner[0]));
        data.normal_triangles.get_or_insert_default().push(corners.map(|corner| corner[1]));
        data.uv_triangles.get_or_insert_default().push(corners.map(|corner| corner[2]));
    }
}
