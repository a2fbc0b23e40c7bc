//! Tubes: what a ball passes over along a path.

use super::{Curve, Placements, points};
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::files::FileKind;
use crate::form::Form;
use crate::path::{Point3, distinct, length, sub, turn};
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::{Item, Kind};
use crate::words::{Told, Words, scene_struct};
use std::f64::consts::PI;

scene_struct! {
    /// What a ball passes over as it goes along a path: a cable, a spring, a tree's branch, a knot. It is closed: its
    /// ends are round, and so are its elbows where the points are joined by straight lines. It is made of triangles,
    /// shaded as round. Where the path bends tighter than the radius it passes through itself, which shows in glass
    /// only. Texture coordinates: u goes round, v from 0 to 1 by length along it, round ends included.
    pub struct Tube as "Tube", "a tube" {
        /// Two or more points that the middle of the ball passes.
        points: Spanned<PathPoints> => Rule::point();
        /// The ball's radius, or one for each point; between them it changes evenly, and smoothly with `curve:
        /// CatmullRom`.
        radius: Spanned<Radii> => Rule::length("a length");
        /// How the points are joined.
        curve: Curve = Curve::CatmullRom;
        /// Whether the path goes on from the last point to the first.
        closed: bool = false;
        /// How many flat pieces go round; curves of the path are as fine.
        segments: Spanned<u32> = 32u32 => Rule::within("a whole number", 3.0, 4096.0);
        /// Its material, by name or written here; without one `Diffuse(albedo: 0.8)`.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms, applied first to last. Turns and scales without `about` are about the middle of its bounds.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// What it is called: `--set objects.NAME.segments=64` finds it where no other has this name.
        name: Name = Name::default();
    }
}

impl Told for Tube {
    const ALSO: &'static [&'static str] = &[
        "spheresweep",
        "sweep",
        "pipealong",
        "wire",
        "cable",
        "curve",
        "curves",
        "linearcurve",
        "bsplinecurve",
        "spline",
    ];
    const EXAMPLE: &'static str =
        "Tube(points: [(-1, -0.8, 0), (1, -0.4, 0), (-1, 0.4, 0), (1, 0.8, 0)], radius: [0.3, 0.2, 0.2, 0.1])";
}

impl ShapeWords for Tube {
    const MANY: &'static str = "tubes";
}

impl Faulty for Tube {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        self.path(span).err().map(|fault| *fault).into_iter().collect()
    }
}

impl Tube {
    /// The points that are not the same as those before, and their radii; `span`: where it stands.
    ///
    /// # Errors
    /// The diagnostic that says why they are no path.
    pub fn path(&self, span: Span) -> Result<(Vec<Point3>, Vec<f64>), Box<Diagnostic>> {
        let at = if self.points.span == Span::NONE { span } else { self.points.span };
        let (points, radii) = self.balls(span)?;
        if points.len() < if self.closed { 3 } else { 2 } {
            let fault = Diagnostic::error(codes::NO_EXTENT, at, "the path of the tube has no extent");
            let expected = if self.closed {
                "three points or more that are not the same"
            } else {
                "two points that are not the same"
            };
            return Err(Box::new(fault.expected(expected)));
        }
        self.check_turns(&points, at)?;
        Ok((points, radii))
    }

    fn balls(&self, span: Span) -> Result<(Vec<Point3>, Vec<f64>), Box<Diagnostic>> {
        let written: &[Point3] = &self.points.value.0;
        let at = if self.radius.span == Span::NONE { span } else { self.radius.span };
        let of = |k: usize| match &self.radius.value {
            Radii::All(radius) => *radius,
            Radii::Each(radii) => radii[k],
        };
        if let Radii::Each(radii) = &self.radius.value
            && radii.len() != written.len()
        {
            let message = format!("the tube has {} points and {} radii", written.len(), radii.len());
            let fault = Diagnostic::error(codes::WRONG_COUNT, at, message);
            return Err(Box::new(fault.expected("one radius, or as many as points")));
        }
        let size =
            [0, 1, 2].map(|axis| written.iter().fold(0.0, |most: f64, p| most.max((p[axis] - written[0][axis]).abs())));
        let size = size.into_iter().fold(0.0, f64::max);
        // Of a closed path the first point may stand at the end again.
        let kept = distinct(written, size, self.closed);
        let (points, radii): (Vec<Point3>, Vec<f64>) = kept.into_iter().map(|k| (written[k], of(k))).unzip();
        let count = points.len();
        for k in 1..if self.closed { count + 1 } else { count } {
            let (one, other) = (k - 1, k % count);
            let way = length(sub(points[other], points[one]));
            if (radii[other] - radii[one]).abs() >= way {
                let shown = |[x, y, z]: Point3| format!("({x}, {y}, {z})");
                let ends = format!("{} and {}", shown(points[one]), shown(points[other]));
                let message = format!("of the balls of the tube at {ends} one lies within the other");
                let fault = Diagnostic::error(codes::BAD_OUTLINE, at, message);
                return Err(Box::new(
                    fault
                        .expected(format!("radii that differ by less than the way of {way}"))
                        .hint("leave out the point of the smaller one"),
                ));
            }
        }
        Ok((points, radii))
    }

    /// An error where a path of straight lines turns straight back.
    fn check_turns(&self, points: &[Point3], at: Span) -> Result<(), Box<Diagnostic>> {
        let count = points.len();
        let elbows = if self.closed { 0..count } else { 1..count - 1 };
        for k in elbows.filter(|_| self.curve == Curve::Linear) {
            let [before, here, after] = [(k + count - 1) % count, k, (k + 1) % count].map(|k| points[k]);
            if turn(sub(here, before), sub(after, here)) > PI - 1e-4 {
                let [x, y, z] = here;
                let message = format!("the tube turns straight back at ({x}, {y}, {z})");
                let fault = Diagnostic::error(codes::BAD_OUTLINE, at, message);
                return Err(Box::new(fault.expected("a path that goes on").hint("two tubes may end in one point")));
            }
        }
        Ok(())
    }
}

/// Points of a path.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct PathPoints(pub Vec<Vec3>);

/// One of them.
static POINT: FieldDef = FieldDef {
    name: "",
    noun: "a point of the path",
    doc: &[],
    kind: Type::Vector,
    rule: Rule::point(),
    default: None,
};

impl Words for PathPoints {
    const TYPE: Type = Type::List(&Type::Vector);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        points::read(reader, item, at, &POINT, ("a path", 2)).map(PathPoints)
    }

    fn form(&self, all: bool) -> Form {
        self.0.form(all)
    }
}

/// A radius for all points, or one for each.
#[derive(Clone, Debug, PartialEq)]
pub enum Radii {
    /// The same everywhere.
    All(f64),
    /// One for each point.
    Each(Vec<f64>),
}

impl Default for Radii {
    fn default() -> Self {
        Radii::All(1.0)
    }
}

/// One of several radii.
static RADIUS: FieldDef = FieldDef {
    name: "",
    noun: "a radius of the path",
    doc: &[],
    kind: Type::Number,
    rule: Rule::length("a length"),
    default: None,
};

impl Words for Radii {
    const TYPE: Type = Type::OneOf(&[Type::Number, Type::List(&Type::Number)]);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if item.kind() == Kind::List {
            return points::read(reader, item, at, &RADIUS, ("a list of radii", 2)).map(Radii::Each);
        }
        f64::read(reader, item, at).map(Radii::All)
    }

    fn form(&self, all: bool) -> Form {
        match self {
            Radii::All(radius) => radius.form(all),
            Radii::Each(radii) => radii.form(all),
        }
    }
}
