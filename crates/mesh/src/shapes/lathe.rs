//! Profiles that turn about the y axis.

#![expect(clippy::indexing_slicing, reason = "rings and corners are numbered here")]

use super::{Triangulated, check_count};
use crate::data::MeshData;
use scene_format::Diagnostic;
use scene_format::desc::{Curve, Lathe};
use scene_format::diagnostic::Span;
use scene_format::path::{Piece, Point, length, pieces, smooth, sub};
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
        check_count(
            2 * u64::from(segments) * profile.len() as u64,
            "lathe",
            at,
            "fewer points in the profile, or fewer `segments`",
        )?;
        Ok(turned(&profile, segments, turning.closed))
    }
}

/// What pieces of a profile pass over as they turn. Of closed ones the outside is the front.
pub(super) fn turned(profile: &[Piece], segments: u32, closed: bool) -> MeshData {
    // Pappus, piece by piece: up on the outside, down on the inside.
    let volume = |piece: &Piece| {
        let ([r, y], [s, z]) = (piece.from, piece.to);
        (z - y) * (r * r + r * s + s * s)
    };
    let inward = closed && profile.iter().map(volume).sum::<f64>() < 0.0;
    let mut mesh = Turned { segments, inward, ..Turned::default() };
    mesh.around = (0..segments)
        .map(|k| {
            let angle = TAU * f64::from(k) / f64::from(segments) - PI;
            [libm::sin(angle), libm::cos(angle)]
        })
        .collect();
    mesh.halfway = (0..segments)
        .map(|k| {
            let angle = TAU * (f64::from(k) + 0.5) / f64::from(segments) - PI;
            [libm::sin(angle), libm::cos(angle)]
        })
        .collect();
    let whole: f64 = profile.iter().map(|piece| length(sub(piece.to, piece.from))).sum();
    let mut along = 0.0;
    let mut last: Option<(Point, u32)> = None;
    let mut first = None;
    for (k, piece) in profile.iter().enumerate() {
        let count = profile.len();
        let neighbour = |other: &Piece, here: Point, there: Point| if here == there { Some(*other) } else { None };
        let before = neighbour(&profile[(k + count - 1) % count], profile[(k + count - 1) % count].to, piece.from);
        let after = neighbour(&profile[(k + 1) % count], profile[(k + 1) % count].from, piece.to);
        let directions = [
            before.and_then(|b| smooth(b.directions[1], piece.directions[0])).unwrap_or(piece.directions[0]),
            after.and_then(|a| smooth(piece.directions[1], a.directions[0])).unwrap_or(piece.directions[1]),
        ];
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
        mesh.band(piece, [from, to], directions, [along / whole, next / whole]);
        (along, last) = (next, Some((piece.to, to)));
    }
    mesh.data
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
    /// Of the middle of each piece.
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

    /// Adds normals of a ring where the profile goes this way: at its vertices, or, at a tip, of the triangles there.
    fn normals(&mut self, direction: Point, tip: bool) -> u32 {
        let first = self.data.normals.len() as u32;
        let sign = if self.inward { -1.0 } else { 1.0 };
        let [out, up] = [sign * direction[1], -sign * direction[0]];
        // The sides of a flat tip meet smoothly there.
        let round = tip && out.abs() <= ROUND_TIP;
        let angles = if tip { &self.halfway } else { &self.around };
        self.data.normals.extend(angles.iter().map(|&[sin, cos]| match round {
            true => [0.0, up.signum() as f32, 0.0],
            false => [out * sin, up, out * cos].map(|x| x as f32),
        }));
        first
    }

    /// Adds texture coordinates of a ring.
    fn uvs(&mut self, v: f64, tip: bool) -> u32 {
        let first = self.data.uvs.len() as u32;
        let (count, shift) = if tip { (self.segments, 0.5) } else { (self.segments + 1, 0.0) };
        let u = |k: u32| (f64::from(k) + shift) / f64::from(self.segments);
        self.data.uvs.extend((0..count).map(|k| [u(k) as f32, v as f32]));
        first
    }

    /// Adds what a piece of the profile between two rings passes over.
    fn band(&mut self, piece: &Piece, rings: [u32; 2], directions: [Point; 2], v: [f64; 2]) {
        let tips = [piece.from[0] == 0.0, piece.to[0] == 0.0];
        let normals = [self.normals(directions[0], tips[0]), self.normals(directions[1], tips[1])];
        let uvs = [self.uvs(v[0], tips[0]), self.uvs(v[1], tips[1])];
        let n = self.segments;
        for k in 0..n {
            let next = (k + 1) % n;
            // Position, normal, texture coordinates of the corner on this ring at the piece's beginning or end.
            let corner = |end: usize, last: bool| {
                let around = if last { next } else { k };
                match tips[end] {
                    true => [rings[end], normals[end] + k, uvs[end] + k],
                    false => [rings[end] + around, normals[end] + around, uvs[end] + if last { k + 1 } else { k }],
                }
            };
            let [a, b, c, d] = [corner(0, false), corner(0, true), corner(1, true), corner(1, false)];
            if !tips[0] {
                self.triangle(if tips[1] { [a, b, d] } else { [a, b, c] });
            }
            if !tips[1] {
                self.triangle([a, c, d]);
            }
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
