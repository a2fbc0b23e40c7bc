//! Spheres.

use super::Placements;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::Spanned;
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A sphere; an ellipsoid by `Scale` in `transform`.
    pub struct Sphere as "Sphere", "a sphere" {
        /// Centre.
        center: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Radius.
        radius: Spanned<f64> => Rule::length("a length");
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last; textures turn along.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.FIELD=2` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for Sphere {
    const ALSO: &'static [&'static str] = &["ball", "icosphere", "uvsphere"];
    const EXAMPLE: &'static str = "Sphere(center: (0, 0, 0), radius: 1.2, material: Diffuse(albedo: 0.6))";
}

impl ShapeWords for Sphere {
    const MANY: &'static str = "spheres";
}

impl Faulty for Sphere {}
