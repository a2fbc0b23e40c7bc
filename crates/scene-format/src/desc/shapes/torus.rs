//! Tori.

use super::Placements;
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A ring with a round section, closed. Texture coordinates: u goes round its axis as a sphere's, v round its
    /// section, 1/2 on the outside, where it grows along the axis.
    pub struct Torus as "Torus", "a torus" {
        /// Its middle.
        center: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Direction that it goes round.
        axis: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
        /// From its middle to the middle of the section.
        radius: Spanned<f64> => Rule::length("a length");
        /// Radius of the section, at most `radius`.
        tube_radius: Spanned<f64> => Rule::length("a length");
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last. Turns and scales without `about` are about its middle.
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

impl Told for Torus {
    const ALSO: &'static [&'static str] = &["donut", "doughnut", "ringtorus"];
    const EXAMPLE: &'static str = "Torus(axis: (0, 1, 1), radius: 1, tube_radius: 0.4)";
}

impl ShapeWords for Torus {
    const MANY: &'static str = "tori";
}

impl Faulty for Torus {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        let (radius, tube) = (self.radius.value, self.tube_radius.value);
        if tube <= radius {
            return Vec::new();
        }
        let at = if self.tube_radius.span == Span::NONE { span } else { self.tube_radius.span };
        let message = format!("the section of the torus is wider than it: its `tube_radius` is {tube}");
        let fault = Diagnostic::error(codes::OUT_OF_RANGE, at, message);
        vec![fault.expected(format!("at most the radius, which is {radius}"))]
    }
}
