//! Shapes: one file each, with the shape's words.

mod r#box;
mod mesh;
mod placements;
mod rectangle;
mod sphere;

pub use r#box::RectBox;
pub use mesh::{Instances, Mesh, Shading};
pub use placements::{PlacementList, Placements};
pub use rectangle::Rectangle;
pub use sphere::Sphere;
