//! Flat rectangles.

use super::Placements;
use crate::desc::{Faulty, MaterialRef, Name, PerAxis, ShapeWords, Transform, Vec3};
use crate::diagnostic::Spanned;
use crate::files::FileKind;
use crate::schema::Rule;
use crate::words::{Told, scene_struct};

scene_struct! {
    /// A flat rectangle. Seen against its normal, its sides run to the right and upwards: to the right is (0, 1, 0) x
    /// normal, or (1, 0, 0) where the normal is upright. Texture coordinates grow along the sides from 0 to 1. Where it
    /// shines it shines to the normal's side.
    pub struct Rectangle as "Rectangle", "a rectangle" {
        /// Its middle.
        center: Spanned<Vec3> = [0.0; 3] => Rule::point();
        /// Direction that it faces.
        normal: Spanned<Vec3> = [0.0, 1.0, 0.0] => Rule::direction();
        /// Lengths of its sides to the right and upwards, or one number for both.
        size: Spanned<PerAxis<2>> = PerAxis([1.0; 2]) => Rule::length("a length");
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

impl Told for Rectangle {
    const ALSO: &'static [&'static str] = &["quad", "square", "rect", "bilinearmesh"];
    const EXAMPLE: &'static str =
        "Rectangle(center: (0, 0.5, 0), normal: (1, 1, 2), size: (3, 2), material: Diffuse(albedo: 0.6))";
}

impl ShapeWords for Rectangle {
    const MANY: &'static str = "rectangles";
}

impl Faulty for Rectangle {}
