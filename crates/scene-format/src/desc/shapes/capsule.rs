//! Capsules.

use super::Placements;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3, no_length};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A cylinder with half spheres on its ends: all points at most `radius` away from the way between two points.
    /// Texture coordinates: u goes round it, v along its outline from 0 below `from` to 1 beyond `to`, by the length of
    /// the way.
    pub struct Capsule as "Capsule", "a capsule" {
        /// Middle of its first half sphere.
        from: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Middle of the other one.
        to: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::point();
        /// Radius.
        radius: Spanned<f64> => Rule::length("a length");
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last.
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

impl Told for Capsule {
    const ALSO: &'static [&'static str] = &["pill", "spherocylinder"];
    const EXAMPLE: &'static str = "Capsule(from: (-1, -0.4, 0), to: (1, 0.4, 0), radius: 0.5)";
}

impl ShapeWords for Capsule {
    const MANY: &'static str = "capsules";
}

impl Faulty for Capsule {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        no_length(&self.from, &self.to, "capsule", span).into_iter().collect()
    }
}
