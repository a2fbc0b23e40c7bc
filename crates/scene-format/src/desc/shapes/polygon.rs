//! Flat polygons.

use super::{Placements, points};
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::form::Form;
use crate::path::{Point, crossing, distinct, extent, shown};
use crate::plane::{Frame, cross, dot, sub};
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::Item;
use crate::words::{Told, Words, scene_struct};

scene_struct! {
    /// A flat face with any number of corners: a roof, a window that is no rectangle. Its front is the side from which
    /// they go round counter-clockwise; an `Emissive` one shines to that side, and the back is seen as the front is.
    /// Seen from the front, u grows to the right and v upwards, as on a `Rectangle` that faces the same way: right is
    /// (0, 1, 0) x normal, or (1, 0, 0) where the normal is upright. The square around it that has the same middle has
    /// coordinates from 0 to 1. It is open: it has no inside.
    pub struct Polygon as "Polygon", "a polygon" {
        /// Three or more corners, in one plane (to a ten-thousandth of its size). Its sides do not meet but at the
        /// corners. A corner that repeats the last one, or at the end the first, is left out.
        points: Spanned<Corners> => Rule::point();
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

impl Faulty for Polygon {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        let at = if self.points.span == Span::NONE { span } else { self.points.span };
        self.points.value.fault(at).into_iter().collect()
    }
}

/// Corners of a polygon.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Corners(pub Vec<Vec3>);

impl Corners {
    /// Each but once where it repeats the last, and their numbers among those that are written.
    pub fn distinct(&self) -> (Vec<Vec3>, Vec<usize>) {
        let extent = |axis: usize| {
            let along = self.0.iter().map(|corner| corner[axis]);
            let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            high - low
        };
        let size = [0, 1, 2].map(extent).into_iter().fold(0.0, f64::max);
        let numbers = distinct(&self.0, size, true);
        (numbers.iter().map(|&k| self.0[k]).collect(), numbers)
    }

    /// Why they bound no face, as far as can be told without cutting it into triangles.
    pub fn fault(&self, at: Span) -> Option<Diagnostic> {
        let (corners, _) = self.distinct();
        let crossed = || {
            let fault = Diagnostic::error(codes::BAD_OUTLINE, at, self.crossing()?);
            Some(fault.expected("sides that do not meet but at the points"))
        };
        // Two halves that go round either way have no area together.
        let Some(frame) = Frame::of(&corners) else { return Some(crossed().unwrap_or_else(|| no_extent(at))) };
        let places: Vec<Vec3> = corners.iter().map(|&corner| frame.place(corner)).collect();
        let plane: Vec<Point> = places.iter().map(|&[x, y, _]| [x, y]).collect();
        let size = extent(&plane);
        let heights = places.iter().map(|place| place[2]);
        let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| (l.min(z), h.max(z)));
        if high - low > FLAT * size {
            let message = format!("the points of the polygon lie up to {:.2e} off one plane", high - low);
            let fault = Diagnostic::error(codes::BAD_OUTLINE, at, message);
            let expected = format!("points in one plane, to a ten-thousandth of its size: {:.2e} here", FLAT * size);
            return Some(fault.expected(expected).hint("bent faces are a `Mesh` with `points` and `faces`"));
        }
        crossed()
    }

    /// Which sides cross, and where, if any do and the corners lie in one plane.
    pub fn crossing(&self) -> Option<String> {
        let (corners, numbers) = self.distinct();
        let count = corners.len();
        let origin = *corners.first()?;
        let from: Vec<Vec3> = corners.iter().map(|&corner| sub(corner, origin)).collect();
        let size = from.iter().map(|p| dot(*p, *p)).fold(0.0, f64::max);
        // A bow tie's halves cancel out in Newell's normal, so that of the widest triangle at the first corner is
        // taken.
        let far = from.iter().copied().max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)))?;
        let normals = from.iter().map(|&p| cross(far, p));
        let normal = normals.max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)))?;
        let length = dot(normal, normal).sqrt();
        if count < 4
            || length <= 1e-12 * size
            || from.iter().any(|&p| dot(p, normal).abs() > FLAT * length * size.sqrt())
        {
            return None;
        }
        let most = [0, 1, 2].into_iter().max_by(|&a, &b| normal[a].abs().total_cmp(&normal[b].abs()))?;
        let flat = |p: Vec3| -> Point { [p[(most + 1) % 3], p[(most + 2) % 3]] };
        let sides: Vec<[Point; 2]> = (0..count).map(|k| [flat(from[k]), flat(from[(k + 1) % count])]).collect();
        let found = crossing(&sides)?;
        let ends = found.sides.map(|k| [numbers[k], numbers[(k + 1) % count]]);
        let (a, b) = (corners[found.sides[0]], corners[(found.sides[0] + 1) % count]);
        let at = shown(&[0, 1, 2].map(|k| a[k] + found.along * (b[k] - a[k])));
        let side = |[from, to]: [usize; 2]| format!("points[{from}] to points[{to}]");
        let (first, second) = (side(ends[0]), side(ends[1]));
        Some(format!("the polygon crosses itself: the side from {first} crosses that from {second} at {at}"))
    }
}

/// Corners may lie so far off one plane, as a share of the polygon's size.
const FLAT: f64 = 1e-4;

/// That corners lie on one line.
pub fn no_extent(at: Span) -> Diagnostic {
    Diagnostic::error(codes::NO_EXTENT, at, "the polygon has no extent")
        .expected("three points or more that are not on one line")
}

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
