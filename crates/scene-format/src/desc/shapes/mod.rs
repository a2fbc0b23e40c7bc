//! Shapes: one file each, with the shape's words.

mod r#box;
mod capsule;
mod cone;
mod cylinder;
mod disk;
mod inline_mesh;
mod mesh;
mod pattern;
mod placements;
mod rectangle;
mod sphere;

pub use r#box::RectBox;
pub use capsule::Capsule;
pub use cone::Cone;
pub use cylinder::Cylinder;
pub use disk::Disk;
pub use inline_mesh::{Faces, InlineMesh};
pub use mesh::{Instances, Mesh, MeshSource, Shading};
pub use pattern::PlacementPattern;
pub use placements::{Groups, Moved, PlacementList, Placements, Within};
pub use rectangle::Rectangle;
pub use sphere::Sphere;
