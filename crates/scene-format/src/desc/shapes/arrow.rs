//! Arrows.

use super::Placements;
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::path::{length, sub};
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A round shaft with a cone at its tip: an axis, a direction, a force. It is closed, and made of triangles.
    /// Texture coordinates: u goes round it as round a cylinder, v from 0 to 1 by length along its outline.
    pub struct Arrow as "Arrow", "an arrow" {
        /// Middle of its flat end.
        from: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Its tip.
        to: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::point();
        /// Radius of the shaft.
        radius: Spanned<f64> => Rule::length("a length");
        /// Radius of the head; without it 2.5 times that of the shaft.
        head_radius: Option<Spanned<f64>> = None => Rule::length("a length");
        /// Length of the head; without it 6 radii of the shaft, or half of the arrow where that is less. As long
        /// as the arrow: it is a cone.
        head_length: Option<Spanned<f64>> = None => Rule::length("a length");
        /// How many flat pieces go round.
        segments: Spanned<u32> = 64u32 => Rule::within("a whole number", 3.0, 4096.0);
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last. Turns and scales without `about` are about the middle between its ends.
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

impl Told for Arrow {
    const ALSO: &'static [&'static str] = &["vector", "axis", "quiver"];
    const EXAMPLE: &'static str = "Arrow(from: (-1, -1, 0), to: (1, 1, 0), radius: 0.15)";
}

impl ShapeWords for Arrow {
    const MANY: &'static str = "arrows";
}

/// What rounding may make of a head that is as long as the arrow.
const LONGER: f64 = 1.0 + 1e-12;

impl Faulty for Arrow {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        let here = |at: Span| if at == Span::NONE { span } else { at };
        let (whole, shaft) = (length(sub(self.to.value, self.from.value)), self.radius.value);
        let mut faults = Vec::new();
        if whole == 0.0 {
            let message = "the arrow begins and ends at the same point";
            let fault = Diagnostic::error(codes::NO_EXTENT, here(self.to.span), message);
            faults.push(fault.expected("`from` and `to` at different places"));
        } else if let Some(head) = self.head_length.as_ref().filter(|head| head.value > LONGER * whole) {
            let message = format!("the head of the arrow is longer than it: {}", head.value);
            let fault = Diagnostic::error(codes::OUT_OF_RANGE, here(head.span), message);
            faults.push(fault.expected(format!("at most the length of the arrow, which is {whole}")));
        }
        if let Some(head) = self.head_radius.as_ref().filter(|head| head.value < shaft) {
            let message = format!("the head of the arrow is thinner than its shaft: {}", head.value);
            let fault = Diagnostic::error(codes::OUT_OF_RANGE, here(head.span), message);
            faults.push(fault.expected(format!("at least the radius of the shaft, which is {shaft}")));
        }
        faults
    }
}
