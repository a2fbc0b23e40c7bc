//! Tubes: what a ball passes over along a path.

use super::{Placements, TubeCurve, points};
use crate::codes;
use crate::desc::{Faulty, MaterialRef, Name, ShapeWords, Transform, Vec3};
use crate::diagnostic::{Diagnostic, Span, Spanned};
use crate::expression::Value;
use crate::files::FileKind;
use crate::form::Form;
use crate::path::{NEAR, Point3, distinct, length, shown, sub};
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::{Item, Kind};
use crate::words::{Told, Words, scene_struct};

scene_struct! {
    /// What a ball passes over as it goes along a path: a cable, a spring, a tree's branch, a knot. It is closed: its
    /// ends are round, and so are its elbows where the points are joined by straight lines; a ball that swallows others
    /// is round, too. It is made of triangles, shaded as round. Where the path bends tighter than the radius, an elbow
    /// has less room than its inner side takes, or the path turns straight back, it passes through itself, which shows
    /// in glass and in the `power` of a light only. Texture coordinates: u goes round, v from 0 to 1 by length along
    /// it, round ends and the outer side of elbows included.
    pub struct Tube as "Tube", "a tube" {
        /// Two or more points that the middle of the ball passes, three or more of a closed one; with `curve: Bezier`
        /// each but the last is followed by two handles. Of points that repeat the last one, or at the end of a closed
        /// one the first, one is left, with the largest radius.
        points: Spanned<PathPoints> => Rule::point();
        /// The ball's radius, or one for each point that is passed (handles have none); between them it changes evenly,
        /// smoothly where the curve is not `Linear`.
        radius: Spanned<Radii> => Rule::length("a length");
        /// How the points are joined.
        curve: TubeCurve = TubeCurve::CatmullRom;
        /// Whether the path goes on from the last point to the first. That of a closed one with `curve: Bezier` is
        /// written to its end: the last point is the first once more.
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
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
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
        "beziercurve",
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
    /// The points that are not the same as those before, and their radii; `span`: where it stands. Of a Bezier path all
    /// points of its spans that are more than a point; radii are those of the points where spans meet, and of a closed
    /// one the last point is the first.
    ///
    /// # Errors
    /// The diagnostic that says why they are no path.
    pub fn path(&self, span: Span) -> Result<(Vec<Point3>, Vec<f64>), Box<Diagnostic>> {
        let at = if self.points.span == Span::NONE { span } else { self.points.span };
        let is_bezier = self.curve == TubeCurve::Bezier;
        if is_bezier {
            self.spans_are_whole(at)?;
        }
        self.radii_are_of_points(span)?;
        let (points, radii) = if is_bezier { self.spans() } else { self.balls() };
        if points.len() < 2 {
            let fault = Diagnostic::error(codes::NO_EXTENT, at, "the path of the tube has no extent");
            return Err(Box::new(fault.expected("two points or more that are not the same")));
        }
        if self.closed && points.len() < 3 {
            let message = "the path of the closed tube goes through two points only";
            let fault = Diagnostic::error(codes::NO_EXTENT, at, message);
            let expected = "three points or more that are not the same, or a tube that is not `closed`";
            return Err(Box::new(fault.expected(expected)));
        }
        Ok((points, radii))
    }

    /// An error where a Bezier path ends within a span, or a closed one does not end where it begins.
    fn spans_are_whole(&self, at: Span) -> Result<(), Box<Diagnostic>> {
        let points = &self.points.value.0;
        let count = points.len();
        if count < 4 || count % 3 != 1 {
            let message = format!("the Bezier path of the tube ends within a span: it has {count} points");
            let low = (count.max(4) - 1) / 3 * 3 + 1;
            let counts = if count < 4 { "4".to_owned() } else { format!("{low} or {}", low + 3) };
            let fault = Diagnostic::error(codes::WRONG_COUNT, at, message);
            let fault = fault.expected(format!(
                "{counts} points: where it begins, then for each span two handles and the point where it ends"
            ));
            return Err(Box::new(match self.closed && count.is_multiple_of(3) {
                true => fault.hint("a closed path is written to its end: the first point stands at the end once more"),
                false => fault.hint("a curve through all of these points is `curve: CatmullRom`"),
            }));
        }
        if self.closed && length(sub(points[count - 1], points[0])) > NEAR * self.size() {
            let message = "the Bezier path of the closed tube does not end where it begins";
            let [first, last] = [points[0], points[count - 1]].map(|point| shown(&point));
            let fault = Diagnostic::error(codes::WRONG_COUNT, at, message);
            let expected = format!("{first} as its last point too, not {last}, or a tube that is not `closed`");
            let hint = format!("a span more leads back: two handles and the first point, {} points in all", count + 3);
            return Err(Box::new(fault.expected(expected).hint(hint)));
        }
        Ok(())
    }

    /// An error where there are several radii, and not as many as points that are passed.
    fn radii_are_of_points(&self, span: Span) -> Result<(), Box<Diagnostic>> {
        let written = self.points.value.0.len();
        let at = if self.radius.span == Span::NONE { span } else { self.radius.span };
        let Radii::Each(radii) = &self.radius.value else { return Ok(()) };
        let is_bezier = self.curve == TubeCurve::Bezier;
        let passed = if is_bezier { written / 3 + 1 } else { written };
        if radii.len() == passed {
            return Ok(());
        }
        let handles = if is_bezier { " between handles" } else { "" };
        let message = format!("the tube has {passed} points{handles} and {} radii", radii.len());
        let fault = Diagnostic::error(codes::WRONG_COUNT, at, message);
        let expected = if is_bezier {
            format!("one radius, or {passed}: one for each point that the path passes")
        } else {
            "one radius, or as many as points".to_owned()
        };
        Err(Box::new(fault.expected(expected)))
    }

    /// The radius at a point that is passed.
    fn radius_at(&self, number: usize) -> f64 {
        match &self.radius.value {
            Radii::All(radius) => *radius,
            Radii::Each(radii) => radii[number],
        }
    }

    /// The longest side of the box around all points.
    fn size(&self) -> f64 {
        let written = &self.points.value.0;
        let along = |axis: usize| written.iter().fold(0.0, |most: f64, p| most.max((p[axis] - written[0][axis]).abs()));
        [0, 1, 2].map(along).into_iter().fold(0.0, f64::max)
    }

    /// The spans of a Bezier path that are more than a point.
    fn spans(&self) -> (Vec<Point3>, Vec<f64>) {
        let written = &self.points.value.0;
        let near = NEAR * self.size();
        let (mut points, mut radii) = (vec![written[0]], vec![self.radius_at(0)]);
        for (number, span) in written.windows(4).step_by(3).enumerate() {
            let radius = self.radius_at(number + 1);
            if span[1..].iter().all(|&point| length(sub(point, span[0])) <= near) {
                // Of points that are one the largest ball is that of all.
                let last = radii.len() - 1;
                radii[last] = radii[last].max(radius);
                continue;
            }
            points.extend_from_slice(&span[1..]);
            radii.push(radius);
        }
        if self.closed && points.len() > 1 {
            let last = points.len() - 1;
            points[last] = points[0];
            radii[0] = radii.pop().map_or(radii[0], |radius| radius.max(radii[0]));
        }
        (points, radii)
    }

    fn balls(&self) -> (Vec<Point3>, Vec<f64>) {
        let written = &self.points.value.0;
        let size = self.size();
        // Of a closed path the first point may stand at the end again.
        let kept = distinct(written, size, self.closed);
        let mut radii: Vec<f64> = kept.iter().map(|&k| self.radius_at(k)).collect();
        // Of points that are one the largest ball is that of all.
        for k in 0..written.len() {
            let last = kept.partition_point(|&other| other <= k) - 1;
            let repeats = length(sub(written[k], written[kept[last]])) <= NEAR * size;
            let one = if repeats { last } else { 0 };
            radii[one] = radii[one].max(self.radius_at(k));
        }
        (kept.into_iter().map(|k| written[k]).collect(), radii)
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
        if let Some(value) = reader.expression(item)
            && !matches!(value?, Value::Number(_) | Value::Bool(_))
        {
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
