//! Spheres.

use crate::desc::{MaterialRef, Vec3};
use crate::diagnostic::Spanned;
use crate::schema::Rule;
use crate::words::scene_struct;

scene_struct! {
    /// A sphere.
    pub struct Sphere as "Sphere", "a sphere" {
        /// Centre.
        center: Spanned<Vec3> => Rule::point();
        /// Radius.
        radius: Spanned<f64> => Rule::length("a length");
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
    }
}
