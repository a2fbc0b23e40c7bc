//! Flat polygons.

#![expect(clippy::indexing_slicing, reason = "three axes, and corners are numbered here")]

use super::Triangulated;
use super::outline::{Fault, fill, square};
use crate::data::MeshData;
use scene_format::desc::{Polygon, Vec3, no_extent};
use scene_format::diagnostic::Span;
use scene_format::path::Point;
use scene_format::plane::Frame;
use scene_format::{Diagnostic, codes};

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
        let flat = || Box::new(no_extent(at));
        if let Some(fault) = self.points.value.fault(at) {
            return Err(Box::new(fault));
        }
        let Some(frame) = Frame::of(&corners) else { return Err(flat()) };
        let places: Vec<Vec3> = corners.iter().map(|&p| frame.place(p)).collect();
        let plane: Vec<Point> = places.iter().map(|&[x, y, _]| [x, y]).collect();
        let (middle, size) = square(&plane);
        let triangles = fill(std::slice::from_ref(&plane)).map_err(|fault| {
            let message = match fault {
                Fault::Flat | Fault::Outside(_) | Fault::WithinHole(_) => return flat(),
                Fault::Crossing([a, b]) => {
                    let [a, b] = [a, b].map(|k| numbers[k]);
                    format!("the polygon crosses itself: the side from points[{a}] and that from points[{b}]")
                }
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
