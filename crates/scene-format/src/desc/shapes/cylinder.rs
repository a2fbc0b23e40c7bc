//! Cylinders.

use super::Placements;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3, no_length};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A round cylinder. With its caps it is closed; without them it is a tube of no thickness, which is seen from
    /// inside, too. Its front is its outside. Texture coordinates: u goes once round it from 0 to 1, counter-clockwise
    /// seen from beyond `to`, v from 0 at `from` to 1 at `to`; on the caps both grow from 0 to 1 as on a `Disk` that
    /// faces outwards.
    pub struct Cylinder as "Cylinder", "a cylinder" {
        /// Middle of its first end.
        from: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Middle of its other end.
        to: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::point();
        /// Radius.
        radius: Spanned<f64> => Rule::length("a length");
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

impl Told for Cylinder {
    const ALSO: &'static [&'static str] = &["rod", "pipe", "pole"];
    const EXAMPLE: &'static str =
        "Cylinder(from: (0, -1, 0), to: (0.5, 1, 0), radius: 0.6, material: Diffuse(albedo: 0.6))";
}

impl ShapeWords for Cylinder {
    const MANY: &'static str = "cylinders";
}

impl Faulty for Cylinder {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        no_length(&self.from, &self.to, "cylinder", span).into_iter().collect()
    }
}
