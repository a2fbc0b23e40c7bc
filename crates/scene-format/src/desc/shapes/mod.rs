//! Shapes: one file each, with the shape's words.

mod r#box;
mod capsule;
mod cone;
mod curve;
mod cylinder;
mod disk;
mod extrude;
mod inline_mesh;
mod lathe;
mod mesh;
mod pattern;
mod placements;
mod points;
mod polygon;
mod rectangle;
mod sphere;

pub use r#box::RectBox;
pub use capsule::Capsule;
pub use cone::Cone;
pub use curve::Curve;
pub use cylinder::Cylinder;
pub use disk::Disk;
pub use extrude::{Extrude, Outline};
pub use inline_mesh::{Faces, InlineMesh};
pub use lathe::{Lathe, Profile, Turning};
pub use mesh::{Instances, Mesh, MeshSource, Shading};
pub use pattern::PlacementPattern;
pub use placements::{Groups, Moved, PlacementList, Placements, Within};
pub use polygon::{Corners, Polygon, no_extent};
pub use rectangle::Rectangle;
pub use sphere::Sphere;
