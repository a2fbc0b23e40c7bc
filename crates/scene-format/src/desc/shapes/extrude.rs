//! Outlines that are pushed along z.

use super::{Curve, Placements, points};
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform};
use crate::diagnostic::{Diagnostic, Edit, Span, Spanned};
use crate::files::FileKind;
use crate::form::Form;
use crate::path::{Ends, Piece, Point, crossing, distinct, extent, orientation, pieces, shown, touching, winding};
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::{Item, Kind};
use crate::words::{Told, Words, scene_struct};

scene_struct! {
    /// An outline that is pushed along z: a letter, a star, a moulding, a plate with holes. It is closed, faces
    /// outwards, and is made of triangles. Texture coordinates of the ends go from 0 to 1 over the square around the
    /// outline, which has its middle, as on a `Rectangle` that faces outwards: of the end at `depth`, seen from +z, u
    /// grows along x and v along y; of that at 0, seen from -z, u grows along -x. On the sides u goes from 0 to 1 once
    /// round each ring, counter-clockwise round the outer one and clockwise round holes, from the ring's first point,
    /// and v from 0 at z = 0 to 1 at `depth`.
    pub struct Extrude as "Extrude", "an extrude" {
        /// Rings of three or more points (x, y): the outer one first, then those of holes. Either way round; none meets
        /// itself or another. A point that repeats the last one, or at the end the first, is left out.
        outline: Spanned<Outline> => Rule::point();
        /// How far it is pushed: from z = 0 to this.
        depth: Spanned<f64> => Rule::length("a length");
        /// How the points of each ring are joined.
        curve: Curve = Curve::Linear;
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
        /// What it is called: `--set objects.NAME.depth=2` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for Extrude {
    const ALSO: &'static [&'static str] = &["prism", "extrusion", "extruded", "linearextrude", "linear_extrude"];
    const EXAMPLE: &'static str =
        "Extrude(outline: [[(-1, -1), (1, -1), (0, 1)], [(-0.3, -0.5), (0.3, -0.5), (0, 0.2)]], depth: 0.5)";
}

impl ShapeWords for Extrude {
    const MANY: &'static str = "extrudes";
}

impl Faulty for Extrude {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        let at = if self.outline.span == Span::NONE { span } else { self.outline.span };
        self.outline_fault(at).into_iter().collect()
    }
}

/// Rings of points (x, y), each of three or more.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Outline(pub Vec<Vec<[f64; 2]>>);

/// Curves are cut into pieces that turn by so much at most: 128 go round.
const STEP: f64 = std::f64::consts::TAU / 128.0;

/// Rings times sides that are looked at for holes in holes, at most: what is wrong with more is told when triangles are
/// made of them.
const MOST_NESTED: usize = 2_000_000;

/// The sides of rings, and which ring each is of.
struct Sides {
    sides: Vec<[Point; 2]>,
    of: Vec<usize>,
}

/// What a ring is called.
fn ring_name(ring: usize) -> String {
    match ring {
        0 => "the outline of the extrude".to_owned(),
        hole => format!("hole {hole} of the extrude"),
    }
}

impl Extrude {
    /// Its sides; `Err`: this ring has no extent.
    fn sides(&self) -> Result<Sides, usize> {
        let rings = &self.outline.value.0;
        let size = rings.iter().map(|ring| extent(ring)).fold(0.0, f64::max);
        let mut all = Sides { sides: Vec::new(), of: Vec::new() };
        for (number, ring) in rings.iter().enumerate() {
            let points: Vec<Point> = distinct(ring, size, true).into_iter().map(|k| ring[k]).collect();
            if points.len() < 3 {
                return Err(number);
            }
            let cut: Vec<Piece> = pieces(&points, Ends::Joined, self.curve == Curve::CatmullRom, STEP);
            all.of.extend(cut.iter().map(|_| number));
            all.sides.extend(cut.iter().map(|piece| [piece.from, piece.to]));
        }
        Ok(all)
    }

    /// Which sides of its outline cross, and where, if any do.
    pub fn crossing(&self) -> Option<String> {
        self.sides().ok()?.crossing()
    }

    /// Why its rings bound no face.
    fn outline_fault(&self, at: Span) -> Option<Diagnostic> {
        let all = match self.sides() {
            Ok(all) => all,
            Err(ring) => {
                let message = format!("{} has no extent", ring_name(ring));
                let fault = Diagnostic::error(codes::NO_EXTENT, at, message);
                return Some(fault.expected("three points or more that are not on one line"));
            }
        };
        let outline = |message: String| Diagnostic::error(codes::BAD_OUTLINE, at, message);
        if let Some(message) = all.crossing() {
            return Some(outline(message).expected("sides that do not meet but at the points"));
        }
        let [a, b] = *all.sides.first()?;
        if all.sides.iter().all(|[p, _]| orientation(a, b, *p) == 0.0) {
            let message = "the outline of the extrude lies on one line";
            let fault = Diagnostic::error(codes::NO_EXTENT, at, message);
            return Some(fault.expected("three points or more that are not on one line"));
        }
        if let Some(message) = all.touch() {
            return Some(outline(message).expected("rings that do not meet themselves or each other"));
        }
        all.nesting()
            .map(|(message, hint)| outline(message).expected("the outer ring first, and in it the holes").hint(hint))
    }
}

impl Sides {
    fn crossing(&self) -> Option<String> {
        let found = crossing(&self.sides)?;
        let [first, second] = found.sides.map(|side| self.of[side]);
        // Holes are told to cross what they are in.
        let whose = if first == second { "itself".to_owned() } else { ring_name(first) };
        let [a, b] = found.sides.map(|side| self.sides[side].map(|end| shown(&end)).join(" to "));
        let (who, at) = (ring_name(second), shown(&found.at));
        Some(format!("{who} crosses {whose} at {at}: the side from {a} crosses that from {b}"))
    }

    /// Where a point lies on a side that it does not end.
    fn touch(&self) -> Option<String> {
        let [one, other] = touching(&self.sides)?;
        let ([a, b], [p, _]) = (self.sides[one], self.sides[other]);
        if a == p {
            let whose = if self.of[one] == self.of[other] { "itself".to_owned() } else { ring_name(self.of[one]) };
            return Some(format!("{} touches {whose} at {}", ring_name(self.of[other]), shown(&p)));
        }
        let side = [a, b].map(|end| shown(&end)).join(" to ");
        Some(format!("the side of {} from {side} passes through another point", ring_name(self.of[one])))
    }

    /// A ring that is not where a hole is: what is told, and what to do. No two rings meet.
    fn nesting(&self) -> Option<(String, &'static str)> {
        let count = self.of.last()? + 1;
        if count.saturating_mul(self.sides.len()) > MOST_NESTED {
            return None;
        }
        let within = |ring: usize, other: usize| {
            let [point, _] = self.sides[self.of.partition_point(|of| *of < ring)];
            let sides = self.of.iter().zip(&self.sides).filter(|(of, _)| **of == other);
            sides.map(|(_, side)| winding(*side, point)).sum::<i32>() != 0
        };
        for ring in 1..count {
            if !within(ring, 0) {
                let message = format!("{} is not within its outline", ring_name(ring));
                return Some((message, "shapes beside each other are an `Extrude` each"));
            }
            if (1..count).any(|other| other != ring && within(ring, other)) {
                let message = format!("{} is within another hole", ring_name(ring));
                return Some((message, "what stands in a hole is an `Extrude` of its own"));
            }
        }
        None
    }
}

/// A point of a ring.
static POINT: FieldDef = FieldDef {
    name: "",
    noun: "a point of the outline",
    doc: &[],
    kind: Type::Pair,
    rule: Rule::point(),
    default: None,
};

/// A ring.
static RING: FieldDef = FieldDef {
    name: "",
    noun: "a ring of the outline",
    doc: &[],
    kind: Type::List(&Type::Pair),
    rule: Rule::point(),
    default: None,
};

/// Whether this is a ring where there should be a list of rings: its first item is two numbers.
fn is_ring(item: Item<'_, '_>) -> bool {
    let number = |item: Item<'_, '_>| matches!(item.kind(), Kind::Integer | Kind::Float);
    let first = if item.kind() == Kind::List { item.children().next() } else { None };
    first.is_some_and(|point| {
        matches!(point.kind(), Kind::Tuple | Kind::List)
            && point.name().is_none()
            && point.children().next().is_some_and(number)
    })
}

impl Words for Outline {
    const TYPE: Type = Type::List(&Type::List(&Type::Pair));

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if is_ring(item) {
            let mut fault =
                Diagnostic::error(codes::WRONG_TYPE, item.head(), "the outline cannot be one ring by itself")
                    .expected("a list of rings of points: [[(x, y), ..], ..]")
                    .hint("put square brackets around it");
            fault.edit = Some(Edit { span: item.span(), replacement: format!("[{}]", item.lexeme()) });
            reader.report(fault);
            return None;
        }
        let (mut rings, mut whole) = (Vec::new(), true);
        reader.items(item, at, |reader, child| {
            match points::read(reader, child, &RING, &POINT, ("a ring of the outline", 3)) {
                Some(ring) => rings.push(ring),
                None => whole = false,
            }
        })?;
        if !whole || item.is_damaged() {
            return None;
        }
        if rings.is_empty() {
            let fault =
                Diagnostic::error(codes::WRONG_COUNT, item.head(), "the outline has at least one ring, not none");
            reader.report(fault.expected("a list of rings of points: [[(x, y), ..], ..]"));
            return None;
        }
        Some(Outline(rings))
    }

    fn form(&self, all: bool) -> Form {
        self.0.form(all)
    }
}
