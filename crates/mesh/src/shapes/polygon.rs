//! Flat polygons.

#![expect(clippy::indexing_slicing, reason = "three axes, and corners are numbered here")]

use super::Triangulated;
use super::outline::{Fault, fill, square};
use crate::data::MeshData;
use scene_format::desc::{Polygon, Vec3};
use scene_format::diagnostic::Span;
use scene_format::path::Point;
use scene_format::{Diagnostic, codes};

/// Corners may lie so far off the plane, as a share of the polygon's size.
const FLAT: f64 = 1e-4;

impl Triangulated for Polygon {
    fn noun(&self) -> &'static str {
        "polygon"
    }

    fn is_closed(&self) -> bool {
        false
    }

    fn way_to_close(&self) -> &'static str {
        "a pane of glass is a thin `Extrude`"
    }

    fn mesh(&self, span: Span) -> Result<MeshData, Box<Diagnostic>> {
        let at = if self.points.span == Span::NONE { span } else { self.points.span };
        let (corners, numbers) = self.points.value.distinct();
        let flat = || match self.points.value.crossing() {
            // Two halves that go round either way have no area together.
            Some(message) => crossed(at, message),
            None => {
                let fault = Diagnostic::error(codes::NO_EXTENT, at, "the polygon has no extent");
                Box::new(fault.expected("three points or more that are not on one line"))
            }
        };
        let Some(frame) = Frame::of(&corners) else { return Err(flat()) };
        let places: Vec<Vec3> = corners.iter().map(|&p| frame.place(p)).collect();
        let plane: Vec<Point> = places.iter().map(|&[x, y, _]| [x, y]).collect();
        let (middle, size) = square(&plane);
        let heights = places.iter().map(|p| p[2]);
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
        if high - low > FLAT * size {
            let message = format!("the points of the polygon lie up to {:.2e} off one plane", high - low);
            let fault = Diagnostic::error(codes::BAD_OUTLINE, at, message);
            let expected = format!("points in one plane, to a ten-thousandth of its size: {:.2e} here", FLAT * size);
            return Err(Box::new(fault.expected(expected).hint("bent faces are a `Mesh` with `points` and `faces`")));
        }
        let triangles = fill(std::slice::from_ref(&plane)).map_err(|fault| {
            let message = match fault {
                Fault::Flat | Fault::Outside(_) | Fault::WithinHole(_) => return flat(),
                Fault::Crossing([a, b]) => self.points.value.crossing().unwrap_or_else(|| {
                    let [a, b] = [a, b].map(|k| numbers[k]);
                    format!("the polygon crosses itself: the side from points[{a}] and that from points[{b}]")
                }),
                Fault::Twice([a, b]) => {
                    let [a, b] = [a, b].map(|k| numbers[k]);
                    format!("the polygon touches itself: points[{a}] and points[{b}] are one")
                }
                Fault::Touching(a) => {
                    let a = numbers[a];
                    format!("the polygon touches itself: the side from points[{a}] passes through another point")
                }
            };
            crossed(at, message)
        })?;
        Ok(MeshData {
            positions: corners,
            triangles,
            uvs: plane.iter().map(|p| [0, 1].map(|k| (0.5 + (p[k] - middle[k]) / size) as f32)).collect(),
            ..MeshData::default()
        })
    }
}

/// That sides meet.
fn crossed(at: Span, message: String) -> Box<Diagnostic> {
    Box::new(Diagnostic::error(codes::BAD_OUTLINE, at, message).expected("sides that do not meet but at the points"))
}

/// Right, up and normal of a face, and its first corner.
struct Frame {
    axes: [Vec3; 3],
    origin: Vec3,
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn unit(a: Vec3) -> Option<Vec3> {
    let most = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if most == 0.0 {
        return None;
    }
    let a = a.map(|x| x / most);
    let length = dot(a, a).sqrt();
    Some(a.map(|x| x / length))
}

impl Frame {
    /// By Newell's normal (Sutherland, Sproull, Schumacker 1974); `None` where the corners have none.
    fn of(corners: &[Vec3]) -> Option<Frame> {
        let origin = *corners.first()?;
        let mut normal = [0.0; 3];
        for pair in corners.windows(2) {
            let part = cross(sub(pair[0], origin), sub(pair[1], origin));
            normal = [0, 1, 2].map(|k| normal[k] + part[k]);
        }
        // Less is rounding.
        let size = corners.iter().map(|&p| dot(sub(p, origin), sub(p, origin))).fold(0.0, f64::max);
        if dot(normal, normal).sqrt() <= 1e-12 * size {
            return None;
        }
        let normal = unit(normal)?;
        let right = if normal[1].abs() > 0.9999 { [1.0, 0.0, 0.0] } else { unit(cross([0.0, 1.0, 0.0], normal))? };
        // Where the normal is nearly upright x is not quite across it.
        let up = unit(cross(normal, right))?;
        Some(Frame { axes: [cross(up, normal), up, normal], origin })
    }

    fn place(&self, point: Vec3) -> Vec3 {
        self.axes.map(|axis| dot(axis, sub(point, self.origin)))
    }
}
