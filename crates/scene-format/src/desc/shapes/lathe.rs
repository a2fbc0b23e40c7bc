//! Lathes: profiles that turn about an axis.

use super::{Curve, Placements, points};
use crate::codes;
use crate::desc::{MaterialRef, Name, ShapeWords, Transform};
use crate::diagnostic::{Diagnostic, Spanned};
use crate::files::FileKind;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Told, Words, scene_struct};

scene_struct! {
    /// What a profile passes over as it turns about the y axis: a vase, a glass, a chess piece. Where both ends of the profile lie on the axis,
    /// or its last point is its first, it is closed; else it has no thickness and its front is on the right of its profile, seen
    /// with the axis on the left. It is made of triangles. Texture coordinates: u goes round as a sphere's, v by length along the profile.
    pub struct Lathe as "Lathe", "a lathe" {
        /// Two or more points (distance from the axis, height).
        profile: Spanned<Profile> => Rule::point();
        /// How the points are joined. A curve that would cross the axis goes along it.
        curve: Curve = Curve::Linear;
        /// How many flat pieces go round; curves of the profile are as fine.
        segments: Spanned<u32> = 128u32 => Rule::within("a whole number", 3.0, 4096.0);
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last. Turns and scales without `about` are about the middle of its bounds.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the name of a
        /// placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// What it is called: `--set objects.NAME.segments=64` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for Lathe {
    const ALSO: &'static [&'static str] = &["sor", "revolve", "screw", "spin", "turned", "surfaceofrevolution"];
    const EXAMPLE: &'static str = "Lathe(profile: [(0, -1), (0.8, -0.9), (0.4, 0), (0.7, 1)], curve: CatmullRom)";
}

impl ShapeWords for Lathe {
    const MANY: &'static str = "lathes";
}

/// Points (distance from the axis, height), none on the other side of the axis.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Profile(pub Vec<[f64; 2]>);

/// A point among them.
static POINT: FieldDef = FieldDef {
    name: "",
    noun: "a point of the profile",
    doc: &[],
    kind: Type::Pair,
    rule: Rule::point(),
    default: None,
};

/// One that has been found not to lie on the other side.
struct ProfilePoint([f64; 2]);

impl Words for ProfilePoint {
    const TYPE: Type = Type::Pair;

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let point = <[f64; 2]>::read(reader, item, at)?;
        if point[0] < 0.0 {
            let message = "a point of the profile lies on the other side of the axis";
            reader.report(
                Diagnostic::error(codes::NEGATIVE, item.head(), message)
                    .expected("(distance from the axis, height), the distance >= 0"),
            );
            return None;
        }
        Some(ProfilePoint(point))
    }

    fn form(&self, all: bool) -> Form {
        self.0.form(all)
    }
}

impl Words for Profile {
    const TYPE: Type = Type::List(&Type::Pair);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let points: Vec<ProfilePoint> = points::read(reader, item, at, &POINT, ("a profile", 2))?;
        Some(Profile(points.into_iter().map(|point| point.0).collect()))
    }

    fn form(&self, all: bool) -> Form {
        self.0.form(all)
    }
}
