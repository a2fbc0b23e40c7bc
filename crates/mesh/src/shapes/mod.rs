//! Shapes of the scene language that become triangles: a file each, and a line each in the registry below.
//!
//! Corners, normals and texture coordinates are in the frame that the shape is written in. Normals are those of the
//! surface itself, so that it is shaded as round; where it turns by more than 40 degrees it has an edge. Edges are
//! shared by number, not by place: what is closed has no gap.

mod arrow;
mod axis;
mod extrude;
mod height_field;
mod lathe;
mod outline;
mod polygon;
mod rounded_box;
mod skew;
mod tube;

pub use height_field::{Heights, MOST_HEIGHTS, height_field};

use super::data::MeshData;
use scene_format::desc::{Faulty, Object};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, codes};

/// A shape that becomes triangles.
pub trait Triangulated: Sync {
    /// What it is called in messages.
    fn noun(&self) -> &'static str;

    /// Whether it has an inside.
    fn is_closed(&self) -> bool;

    /// What to do where it is to have one.
    fn way_to_close(&self) -> &'static str {
        ""
    }

    /// The fixed point of its turns and scales where those name none; `None`: the middle of its bounds.
    fn middle(&self) -> Option<[f64; 3]> {
        None
    }

    /// Its triangles, counter-clockwise seen from its front, which of closed ones is the outside. `span`: where it
    /// stands in the scene.
    ///
    /// # Errors
    /// The diagnostic that says why there are none: it has no extent (`E0542`), its outline bounds no face (`E0545`),
    /// or there are too many (`E0606`).
    fn mesh(&self, span: Span) -> Result<MeshData, Box<Diagnostic>>;
}

/// The object as a shape that becomes triangles, if it is one.
pub fn of_object(object: &Object) -> Option<&dyn Triangulated> {
    Some(match object {
        Object::Lathe(lathe) => &**lathe,
        Object::Extrude(extrude) => &**extrude,
        Object::Polygon(polygon) => &**polygon,
        Object::Tube(tube) => &**tube,
        Object::Arrow(arrow) => &**arrow,
        Object::Box(cuboid) if cuboid.is_rounded() => &**cuboid,
        _ => return None,
    })
}

/// Triangles of one shape, at most: with its tree 16 million take two to three gigabytes.
const MOST_TRIANGLES: u64 = 1 << 24;

/// The first thing that is wrong with the numbers of a shape.
fn first_fault(shape: &dyn Faulty, span: Span) -> Option<Box<Diagnostic>> {
    shape.faults(span).into_iter().next().map(Box::new)
}

/// An error where a shape would have more triangles than that.
fn check_count(count: u64, noun: &str, at: Span, hint: &str) -> Result<(), Box<Diagnostic>> {
    if count <= MOST_TRIANGLES {
        return Ok(());
    }
    let fault = Diagnostic::error(codes::TOO_MUCH, at, format!("the {noun} would have {count} triangles"));
    Err(Box::new(fault.expected(format!("at most {MOST_TRIANGLES}")).hint(hint)))
}

#[cfg(test)]
mod tests;
