//! Lathes: profiles that turn about an axis.

use super::{Curve, Placements, points};
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::form::Form;
use crate::path::{Crossing, Ends, NEAR, Point, crossing, distinct, extent, least_x, pieces};
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Told, Words, scene_struct};

scene_struct! {
    /// What a profile passes over as it turns about the y axis: a vase, a glass, a chess piece. Where both ends of the
    /// profile lie on the axis, or its last point is its first, it is closed and faces outwards, either way round. Else
    /// it is open: it has no thickness, and its front is on the right of its profile, drawn with the axis on the left:
    /// outwards where the profile goes up. An open `Emissive` one shines to its front, and open glass has no inside. It
    /// is made of triangles. Texture coordinates: u goes round from 0 to 1 as a sphere's, beginning at -z and at 1/4 at
    /// -x, v grows from 0 at the first point to 1 at the last, by length along the profile.
    pub struct Lathe as "Lathe", "a lathe" {
        /// Two or more points (distance from the axis, height). A point that repeats the last one is left out.
        profile: Spanned<Profile> => Rule::point();
        /// How the points are joined. A `CatmullRom` curve swings out where a long way between points meets a short
        /// one: between two points of a thin stem it comes nearer to the axis than they are, and one that would cross
        /// the axis goes along it. Points at even distances prevent that.
        curve: Curve = Curve::Linear;
        /// How many flat pieces go round; curves of the profile are as fine.
        segments: Spanned<u32> = 128u32 => Rule::within("a whole number", 3.0, 4096.0);
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last. Turns and scales without `about` are about the middle of its bounds.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.segments=64` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for Lathe {
    const ALSO: &'static [&'static str] = &["sor", "revolve", "spin", "turned", "surfaceofrevolution"];
    const EXAMPLE: &'static str = "Lathe(profile: [(0, -1), (0.8, -0.9), (0.4, 0), (0.7, 1)], curve: CatmullRom)";
}

impl ShapeWords for Lathe {
    const MANY: &'static str = "lathes";
}

impl Faulty for Lathe {}

/// Points (distance from the axis, height), none on the other side of the axis.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Profile(pub Vec<[f64; 2]>);

/// A profile as it is turned.
#[derive(Clone, Debug, PartialEq)]
pub struct Turning {
    /// Its points, each but once where it repeats the last; those that lie nearly on the axis lie on it.
    pub points: Vec<Point>,
    /// Which of the written points these are.
    pub numbers: Vec<usize>,
    /// Whether it goes on at its first point.
    pub ends: Ends,
    /// Whether it has an inside: it goes on at its first point, or from the axis to the axis.
    pub closed: bool,
}

impl Turning {
    /// Whether it goes on at its first point.
    pub fn joined(&self) -> bool {
        self.ends == Ends::Joined
    }
}

impl Profile {
    /// As it is turned.
    pub fn turned(&self) -> Turning {
        let size = extent(&self.0).max(self.0.iter().fold(0.0, |most, point| point[0].max(most)));
        let snapped = self.0.iter().map(|&[r, y]| [if r <= NEAR * size { 0.0 } else { r }, y]);
        let snapped: Vec<Point> = snapped.collect();
        let mut numbers = distinct(&snapped, size, false);
        let ring = distinct(&snapped, size, true);
        let on_axis = |k: Option<&usize>| k.is_some_and(|&k| snapped[k][0] == 0.0);
        let joined = ring.len() < numbers.len() && !on_axis(numbers.first());
        let closed = joined || numbers.len() > 1 && on_axis(numbers.first()) && on_axis(numbers.last());
        if joined {
            numbers = ring;
        }
        let ends = if joined { Ends::Joined } else { Ends::Mirrored };
        Turning { points: numbers.iter().map(|&k| snapped[k]).collect(), numbers, ends, closed }
    }
}

impl Turning {
    /// Why it passes over no surface.
    pub fn fault(&self, at: Span) -> Option<Diagnostic> {
        let message = if self.points.len() < if self.joined() { 3 } else { 2 } {
            "the profile of the lathe has no extent"
        } else if self.points.iter().all(|point| point[0] == 0.0) {
            "the profile of the lathe lies on its axis"
        } else {
            return None;
        };
        let fault = Diagnostic::error(codes::NO_EXTENT, at, message);
        Some(fault.expected("two points or more that are not the same, not all on the axis"))
    }

    /// The first points between which a curve through them comes much nearer to the axis than both of them are, by
    /// their written numbers, with a point between them that would prevent it, where one would.
    pub fn thin(&self) -> Option<([usize; 2], Option<Point>)> {
        let count = self.points.len();
        if count < 2 {
            return None;
        }
        let size = extent(&self.points);
        let is_thin = |least: f64, from: Point, to: Point| match from[0].min(to[0]) {
            0.0 => least < -1e-9 * size,
            near => least < 0.5 * near,
        };
        let thin = |points: &[Point]| {
            let least = least_x(points, self.ends).into_iter().enumerate();
            let mut spans = least.map(|(k, least)| (k, least, points[k], points[(k + 1) % points.len()]));
            spans.find(|&(_, least, from, to)| is_thin(least, from, to)).map(|(k, ..)| k)
        };
        let k = thin(&self.points)?;
        let next = (k + 1) % count;
        let (from, to) = (self.points[k], self.points[next]);
        let between = [0, 1].map(|axis| 0.5 * (from[axis] + to[axis]));
        let mut more = self.points.clone();
        more.insert(k + 1, between);
        let helps = thin(&more).is_none_or(|other| other > k + 1);
        Some(([self.numbers[k], self.numbers[next]], helps.then_some(between)))
    }

    /// Where it crosses itself, its sides numbered by the written points that they begin at.
    pub fn crossing(&self, curve: Curve, step: f64) -> Option<Crossing> {
        if self.points.len() < 2 {
            return None;
        }
        let pieces = pieces(&self.points, self.ends, curve == Curve::CatmullRom, step);
        let sides: Vec<[Point; 2]> =
            pieces.iter().map(|piece| [piece.from, piece.to].map(|[r, y]| [r.max(0.0), y])).collect();
        let found = crossing(&sides)?;
        Some(Crossing { sides: found.sides.map(|side| self.numbers[pieces[side].number]), ..found })
    }
}

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
