//! Cones.

use super::Placements;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3, no_length};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A round cone, or a part of one: a lampshade, a bucket. With its caps it is closed; without them it has no
    /// thickness and is seen from inside, too. Texture coordinates are those of a `Cylinder`.
    pub struct Cone as "Cone", "a cone" {
        /// Middle of the end of radius `radius`.
        from: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// The tip, or the middle of the end of radius `tip_radius`.
        to: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::point();
        /// Radius at `from`.
        radius: Spanned<f64> => Rule::length("a length");
        /// Radius at `to`; 0: a tip.
        tip_radius: Spanned<f64> = 0.0 => Rule::within("a radius", 0.0, 1e12).unit("in the scene's unit");
        /// Whether disks close its ends.
        caps: bool = true;
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

impl Told for Cone {
    const ALSO: &'static [&'static str] = &["frustum", "truncatedcone"];
    const EXAMPLE: &'static str = "Cone(from: (0, -1, 0), to: (0, 1, 0), radius: 1, tip_radius: 0.3, caps: false)";
}

impl ShapeWords for Cone {
    const MANY: &'static str = "cones";
}

impl Faulty for Cone {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        no_length(&self.from, &self.to, "cone", span).into_iter().collect()
    }
}
