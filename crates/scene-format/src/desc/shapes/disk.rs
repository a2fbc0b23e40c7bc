//! Flat disks and rings.

use super::Placements;
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A flat disk, or a ring. Seen against its normal, right is (0, 1, 0) x normal, or (1, 0, 0) where the normal is
    /// upright; texture coordinates grow to the right and upwards from 0 to 1 over the square around it. It is open: it
    /// has no inside.
    pub struct Disk as "Disk", "a disk" {
        /// Its middle.
        center: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Direction that it faces.
        normal: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
        /// Radius.
        radius: Spanned<f64> = 1.0 => Rule::length("a length");
        /// Radius of the hole in its middle, less than `radius`; 0: there is none.
        inner_radius: Spanned<f64> = 0.0 => Rule::within("a radius", 0.0, 1e12).unit("in the scene's unit");
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

impl Told for Disk {
    const ALSO: &'static [&'static str] = &["disc", "circle", "ring", "annulus"];
    const EXAMPLE: &'static str = "Disk(center: (0, 0.3, 0), normal: (0, 1, 2), radius: 1.3, inner_radius: 0.5)";
}

impl ShapeWords for Disk {
    const MANY: &'static str = "disks";
}

impl Faulty for Disk {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        if self.inner_radius.value / self.radius.value < 1.0 {
            return Vec::new();
        }
        let at = [self.inner_radius.span, span].into_iter().find(|at| *at != Span::NONE).unwrap_or_default();
        let message = "the hole is as large as the disk: nothing of it is left";
        let fault = Diagnostic::error(codes::NO_EXTENT, at, message);
        vec![fault.expected(format!("`inner_radius` less than the radius, which is {}", self.radius.value))]
    }
}
