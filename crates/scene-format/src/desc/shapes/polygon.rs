//! Flat polygons.

use super::{Placements, points};
use crate::desc::{MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::Spanned;
use crate::files::FileKind;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Told, Words, scene_struct};

scene_struct! {
    /// A flat face with any number of corners: a roof, a window that is no rectangle. Its front is where they go round counter-clockwise.
    /// Texture coordinates go from 0 to 1 over the square around it, as of a rectangle that faces the same way.
    pub struct Polygon as "Polygon", "a polygon" {
        /// Three or more corners, in one plane (to a ten-thousandth of its size). Its sides do not meet but at the corners.
        points: Spanned<Corners> => Rule::point();
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last. Turns and scales without `about` are about the middle of its bounds.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a
        /// placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// What it is called: `--set objects.NAME.transform=[]` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for Polygon {
    const ALSO: &'static [&'static str] = &["triangle", "ngon", "face"];
    const EXAMPLE: &'static str =
        "Polygon(points: [(-1, -0.9, 0), (1, -0.9, 0), (1, 0.3, 0), (0, 1, 0), (-1, 0.3, 0)])";
}

impl ShapeWords for Polygon {
    const MANY: &'static str = "polygons";
}

/// Corners of a polygon.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Corners(pub Vec<Vec3>);

/// One of them.
static CORNER: FieldDef = FieldDef {
    name: "",
    noun: "a point of the polygon",
    doc: &[],
    kind: Type::Vector,
    rule: Rule::point(),
    default: None,
};

impl Words for Corners {
    const TYPE: Type = Type::List(&Type::Vector);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        points::read(reader, item, at, &CORNER, ("a polygon", 3)).map(Corners)
    }

    fn form(&self, all: bool) -> Form {
        self.0.form(all)
    }
}
