//! Boxes.

use super::Placements;
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, PerAxis, ShapeWords, Transform, Vec3};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A box with right angles, its sides along the axes before `transform`. Each face has texture coordinates from 0
    /// to 1, as a `Rectangle` that faces outwards: on the four upright ones v grows along y, and u to the right as seen
    /// from outside; on top and bottom u grows along x, and v along -z on top and along z below.
    pub struct RectBox as "Box", "a box" {
        /// Its middle.
        center: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Lengths of its sides along x, y and z, or one number for all.
        size: Spanned<PerAxis<3>> = PerAxis([1.0; 3]) => Rule::length("a length");
        /// Radius of its edges and corners, at most half the shortest side; 0: they are sharp. A box with round edges
        /// is made of triangles, shaded as round; of a face's texture the rounded border shows what lies inwards of it.
        rounding: Spanned<f64> = 0.0 => Rule::within("a radius", 0.0, 1e12).unit("in the scene's unit");
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

impl Told for RectBox {
    const ALSO: &'static [&'static str] = &["cube", "cuboid", "brick"];
    const EXAMPLE: &'static str = "Box(size: (1.5, 1, 2), transform: [Rotate(axis: (0, 1, 0), degrees: 30)])";
}

impl ShapeWords for RectBox {
    const MANY: &'static str = "boxes";
}

impl RectBox {
    /// Whether its edges are round.
    pub fn is_rounded(&self) -> bool {
        self.rounding.value > 0.0
    }
}

impl Faulty for RectBox {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        let shortest = self.size.value.0.into_iter().fold(f64::INFINITY, f64::min);
        if self.rounding.value <= 0.5 * shortest {
            return Vec::new();
        }
        let at = if self.rounding.span == Span::NONE { span } else { self.rounding.span };
        let message =
            format!("the edges of the box are rounder than it is thick: its `rounding` is {}", self.rounding.value);
        let fault = Diagnostic::error(codes::OUT_OF_RANGE, at, message);
        vec![fault.expected(format!("at most half the shortest side, which is {}", 0.5 * shortest))]
    }
}
