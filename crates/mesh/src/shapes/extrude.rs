//! Outlines that are pushed along z.

#![expect(clippy::indexing_slicing, reason = "rings and corners are numbered here")]

use super::outline::{Fault, area, fill, square};
use super::{Triangulated, check_count};
use crate::data::{MeshData, NO_INDEX};
use scene_format::desc::{Curve, Extrude};
use scene_format::diagnostic::Span;
use scene_format::path::{Ends, Piece, Point, distinct, extent, length, pieces, smooth, sub};
use scene_format::{Diagnostic, codes};
use std::f64::consts::TAU;

/// Curves are cut into pieces that turn by so much at most: 128 go round.
const STEP: f64 = TAU / 128.0;

impl Triangulated for Extrude {
    fn noun(&self) -> &'static str {
        "extrude"
    }

    fn is_closed(&self) -> bool {
        true
    }

    fn mesh(&self, span: Span) -> Result<MeshData, Box<Diagnostic>> {
        let at = if self.outline.span == Span::NONE { span } else { self.outline.span };
        let written = &self.outline.value.0;
        let size = written.iter().map(|ring| extent(ring)).fold(0.0, f64::max);
        let mut rings: Vec<Vec<Piece>> = Vec::with_capacity(written.len());
        for (k, ring) in written.iter().enumerate() {
            let mut points: Vec<Point> = distinct(ring, size, true).into_iter().map(|k| ring[k]).collect();
            if points.len() < 3 {
                let message = format!("{} has no extent", name(k));
                let fault = Diagnostic::error(codes::NO_EXTENT, at, message);
                return Err(Box::new(fault.expected("three points or more that are not on one line")));
            }
            // Counter-clockwise outside, clockwise round holes, beginning where it is written to.
            if (area(&points) < 0.0) == (k == 0) {
                points[1..].reverse();
            }
            rings.push(pieces(&points, Ends::Joined, self.curve == Curve::CatmullRom, STEP));
        }
        let corners: Vec<Vec<Point>> = rings.iter().map(|ring| ring.iter().map(|piece| piece.from).collect()).collect();
        let count = corners.iter().map(Vec::len).sum::<usize>() as u64;
        check_count(4 * count + 4 * rings.len() as u64, "extrude", at, "fewer points in the outline")?;
        let ends = fill(&corners).map_err(|fault| Box::new(told(fault, &corners, at)))?;
        Ok(pushed(&rings, &ends, self.depth.value))
    }
}

fn name(ring: usize) -> String {
    if ring == 0 { "the outline of the extrude".to_owned() } else { format!("hole {ring} of the extrude") }
}

/// The diagnostic of rings that bound no face.
fn told(fault: Fault, rings: &[Vec<Point>], at: Span) -> Diagnostic {
    let mut starts = vec![0];
    for ring in rings {
        starts.push(starts[starts.len() - 1] + ring.len());
    }
    let ring_of = |number: usize| starts.partition_point(|&start| start <= number) - 1;
    let point = |number: usize| {
        let ring = ring_of(number);
        rings[ring][number - starts[ring]]
    };
    let after = |number: usize| {
        let ring = ring_of(number);
        rings[ring][(number - starts[ring] + 1) % rings[ring].len()]
    };
    let shown = |[x, y]: Point| format!("({x}, {y})");
    let side = |number: usize| format!("{} to {}", shown(point(number)), shown(after(number)));
    let outline = |message: String| Diagnostic::error(codes::BAD_OUTLINE, at, message);
    match fault {
        Fault::Flat => Diagnostic::error(codes::NO_EXTENT, at, "the outline of the extrude lies on one line")
            .expected("three points or more that are not on one line"),
        Fault::Crossing([a, b]) => {
            let whose = if ring_of(a) == ring_of(b) { "itself".to_owned() } else { name(ring_of(b)) };
            outline(format!(
                "{} crosses {whose}: the side from {} crosses that from {}",
                name(ring_of(a)),
                side(a),
                side(b)
            ))
            .expected("rings that do not meet themselves or each other")
        }
        Fault::Twice([a, b]) => {
            let whose = if ring_of(a) == ring_of(b) { "itself".to_owned() } else { name(ring_of(a)) };
            outline(format!("{} touches {whose} at {}", name(ring_of(b)), shown(point(b))))
                .expected("rings that do not meet themselves or each other")
        }
        Fault::Touching(a) => {
            outline(format!("the side of {} from {} passes through another point", name(ring_of(a)), side(a)))
                .expected("rings that do not meet themselves or each other")
        }
        Fault::Outside(ring) => outline(format!("{} is not within its outline", name(ring)))
            .expected("the outer ring first, and in it the holes")
            .hint("shapes beside each other are an `Extrude` each"),
        Fault::WithinHole(ring) => outline(format!("{} is within another hole", name(ring)))
            .expected("the outer ring first, and in it the holes")
            .hint("what stands in a hole is an `Extrude` of its own"),
    }
}

/// The solid between two copies of a face: its rings as pieces, and its triangles by the numbers of their points.
fn pushed(rings: &[Vec<Piece>], ends: &[[u32; 3]], depth: f64) -> MeshData {
    let points: Vec<Point> = rings.iter().flatten().map(|piece| piece.from).collect();
    let count = points.len() as u32;
    let mut mesh = MeshData::default();
    for z in [0.0, depth] {
        mesh.positions.extend(points.iter().map(|[x, y]| [*x, *y, z]));
    }
    let ([x, y], size) = square(&points);
    let (mut normals, mut uvs) = (Vec::new(), Vec::new());
    // Seen from the back the picture's right is -x.
    for (end, right) in [(0, -1.0), (1, 1.0)] {
        mesh.uvs.extend(points.iter().map(|p| [right * (p[0] - x), p[1] - y].map(|t| (0.5 + t / size) as f32)));
        for &[a, b, c] in ends {
            let corners = if end == 0 { [a, c, b] } else { [a, b, c] }.map(|k| k + end * count);
            mesh.triangles.push(corners);
            uvs.push(corners);
            normals.push([NO_INDEX; 3]);
        }
    }
    let mut first = 0;
    for ring in rings {
        let number = ring.len();
        let whole: f64 = ring.iter().map(|piece| length(sub(piece.to, piece.from))).sum();
        let first_uv = mesh.uvs.len() as u32;
        let mut along = 0.0;
        for piece in ring {
            mesh.uvs.extend([0.0, 1.0].map(|v| [(along / whole) as f32, v]));
            along += length(sub(piece.to, piece.from));
        }
        mesh.uvs.extend([[1.0, 0.0], [1.0, 1.0]]);
        for (k, piece) in ring.iter().enumerate() {
            let (before, after) = (&ring[(k + number - 1) % number], &ring[(k + 1) % number]);
            let joints =
                [smooth(before.directions[1], piece.directions[0]), smooth(piece.directions[1], after.directions[0])];
            // Flat between two edges: no normals needed.
            let straight = piece.directions[0] == piece.directions[1];
            let normal = match joints {
                [None, None] if straight => [NO_INDEX; 2],
                _ => [0, 1].map(|end| {
                    let [x, y] = joints[end].unwrap_or(piece.directions[end]);
                    mesh.normals.push([y as f32, -x as f32, 0.0]);
                    mesh.normals.len() as u32 - 1
                }),
            };
            let (here, next) = (first + k as u32, first + ((k + 1) % number) as u32);
            let uv = |step: u32, end: u32| first_uv + 2 * (k as u32 + step) + end;
            mesh.triangles.extend([[here, next, next + count], [here, next + count, here + count]]);
            normals.extend([[normal[0], normal[1], normal[1]], [normal[0], normal[1], normal[0]]]);
            uvs.extend([[uv(0, 0), uv(1, 0), uv(1, 1)], [uv(0, 0), uv(1, 1), uv(0, 1)]]);
        }
        first += number as u32;
    }
    if !mesh.normals.is_empty() {
        mesh.normal_triangles = Some(normals);
    }
    mesh.uv_triangles = Some(uvs);
    mesh
}
