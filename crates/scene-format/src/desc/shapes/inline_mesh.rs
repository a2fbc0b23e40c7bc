//! Meshes that stand in the scene itself: points, and faces that name them.

use crate::codes;
use crate::desc::{Color, Vec3};
use crate::diagnostic::{Diagnostic, Spanned};
use crate::form::Form;
use crate::read::{Reader, is_expression, make_room};
use crate::schema::{FieldDef, Rule, Type};
use crate::tree::{Item, Kind};
use crate::words::Words;

/// A mesh that a scene writes out. Every corner of a face is a point that there is, and every face has three or more.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct InlineMesh {
    /// Its points.
    pub points: Vec<Vec3>,
    /// Its faces.
    pub faces: Faces,
    /// The colours of its points, linear; as many as those, or none.
    pub colors: Vec<Color>,
}

/// Faces, each by the numbers of its corners' points. The corners of all of them stand in one list: a scene may have
/// millions.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Faces {
    corners: Vec<u32>,
    /// Where the corners of each face end.
    ends: Vec<u32>,
}

impl Faces {
    /// Adds a face.
    pub fn push(&mut self, corners: &[u32]) {
        self.corners.extend_from_slice(corners);
        self.ends.push(self.corners.len() as u32);
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The corners of each face.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> {
        let mut start = 0;
        self.ends.iter().map(move |&end| {
            let corners = &self.corners[start..end as usize];
            start = end as usize;
            corners
        })
    }
}

/// What stands in a field that may be left out.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) enum Written<T> {
    #[default]
    Not,
    /// Something that could not be read, which was told.
    Wrong,
    /// A value, and where it stands.
    As(Spanned<T>),
}

impl<T> Written<T> {
    fn form(&self, form: impl FnOnce(&T) -> Form) -> Form {
        match self {
            Written::As(value) => form(&value.value),
            Written::Not | Written::Wrong => Form::Absent,
        }
    }
}

/// What `points` holds.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Points(pub Written<Vec<Vec3>>);

/// What `faces` holds.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct WrittenFaces(pub Written<Faces>);

/// What `colors` holds.
#[derive(Clone, Debug, PartialEq, Default)]
pub(crate) struct Colors(pub Written<Vec<Color>>);

/// A point among `points`.
static POINT: FieldDef =
    FieldDef { name: "", noun: "a point of a mesh", doc: &[], kind: Type::Vector, rule: Rule::point(), default: None };

/// A colour among `colors`.
static COLOR: FieldDef =
    FieldDef { name: "", noun: "a colour of a point", doc: &[], kind: Type::Color, rule: Rule::share(), default: None };

/// A corner of a face.
static CORNER: FieldDef = FieldDef {
    name: "",
    noun: "a corner of a face",
    doc: &[],
    kind: Type::Integer,
    rule: Rule::within("the number of a point", 0.0, u32::MAX as f64),
    default: None,
};

/// A face that an expression comes to.
static FACE_OF_VALUE: FieldDef = FieldDef {
    name: "",
    noun: "a face of a mesh",
    doc: &[],
    kind: Type::List(&Type::Integer),
    rule: Rule::ANY,
    default: None,
};

/// A face among `faces`.
const FACE: &str = "the numbers of three or more points: [0, 1, 2]";

impl Words for Points {
    const TYPE: Type = Type::List(&Type::Vector);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let (mut points, mut whole) = (Vec::new(), true);
        reader.passed_over = false;
        let read = reader.items(item, at, |reader, child| {
            make_room(&mut points, item, child);
            match Vec3::read(reader, child, &POINT) {
                Some(point) => points.push(point),
                None => whole = false,
            }
        });
        if read.is_none() {
            return Some(Points(Written::Wrong));
        }
        whole &= !reader.passed_over && !item.is_damaged();
        // Where one could not be read, the numbers of those after it are not known.
        reader.points = whole.then_some(points.len());
        if whole && points.len() < 3 {
            let message = format!("a mesh has at least 3 points, not {}", points.len());
            reader.report(Diagnostic::error(codes::WRONG_COUNT, item.head(), message).expected("three or more points"));
            whole = false;
        }
        Some(Points(written(whole, points, item)))
    }

    fn form(&self, _all: bool) -> Form {
        self.0.form(|points| Form::list(points.iter().map(|&point| Form::vector(point))))
    }
}

impl Words for WrittenFaces {
    const TYPE: Type = Type::List(&Type::List(&Type::Integer));

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let (mut faces, mut whole) = (Faces::default(), true);
        reader.passed_over = false;
        let read = reader.items(item, at, |reader, child| {
            make_room(&mut faces.ends, item, child);
            match face(reader, child, item, &mut faces.corners) {
                Some(()) => faces.ends.push(faces.corners.len() as u32),
                None => whole = false,
            }
        });
        if read.is_none() {
            return Some(WrittenFaces(Written::Wrong));
        }
        whole &= !reader.passed_over && !item.is_damaged();
        if whole && faces.is_empty() {
            let message = "a mesh has at least one face, not none";
            reader.report(Diagnostic::error(codes::WRONG_COUNT, item.head(), message).expected(FACE));
            whole = false;
        }
        Some(WrittenFaces(written(whole, faces, item)))
    }

    fn form(&self, _all: bool) -> Form {
        let face = |corners: &[u32]| Form::Vector(corners.iter().map(|&k| Form::Integer(u64::from(k))).collect());
        self.0.form(|faces| Form::list(faces.iter().map(face)))
    }
}

impl Words for Colors {
    const TYPE: Type = Type::List(&Type::Color);

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        let (mut colors, mut whole, mut count) = (Vec::new(), true, 0);
        // Points come first, so that there is never room for more colours than those.
        let most = reader.points.unwrap_or(0);
        reader.passed_over = false;
        let read = reader.items(item, at, |reader, child| {
            let color = Color::read(reader, child, &COLOR);
            whole &= color.is_some();
            if let (true, Some(color)) = (count < most, color) {
                make_room(&mut colors, item, child);
                colors.push(color);
            }
            count += 1;
        });
        if read.is_none() {
            return Some(Colors(Written::Wrong));
        }
        whole &= !reader.passed_over && !item.is_damaged();
        if let (true, Some(points)) = (whole, reader.points)
            && count != points
        {
            let (number, what) = (count.min(points), if count < points { "has no colour" } else { "is not there" });
            let message = format!("a mesh of {points} points has {count} colours: point {number} {what}");
            let fault = Diagnostic::error(codes::WRONG_COUNT, item.head(), message);
            reader.report(fault.expected("a colour for each of the `points`, in their order"));
            whole = false;
        }
        Some(Colors(written(whole, colors, item)))
    }

    fn form(&self, _all: bool) -> Form {
        self.0.form(|colors| Form::list(colors.iter().map(|&color| Form::vector(color))))
    }
}

fn written<T>(whole: bool, value: T, item: Item<'_, '_>) -> Written<T> {
    if whole { Written::As(Spanned { value, span: item.head() }) } else { Written::Wrong }
}

/// Reads the corners of a face.
fn face(reader: &mut Reader<'_>, item: Item<'_, '_>, all: Item<'_, '_>, corners: &mut Vec<u32>) -> Option<()> {
    let bare = matches!(item.kind(), Kind::List | Kind::Tuple) && item.name().is_none();
    let is_value = is_expression(item);
    if !bare && !is_value {
        return reader.wrong_kind(item, "a face of a mesh", FACE, None);
    }
    let (first, mut good) = (corners.len(), true);
    if is_value {
        reader.items(item, &FACE_OF_VALUE, |reader, child| match corner(reader, child) {
            Some(corner) => corners.push(corner),
            None => good = false,
        })?;
    }
    for child in item.children().filter(|_| bare) {
        if child.kind() == Kind::Broken {
            good = false;
            continue;
        }
        make_room(corners, all, child);
        match corner(reader, child) {
            Some(corner) => corners.push(corner),
            None => good = false,
        }
    }
    let count = corners.len() - first;
    if good && count < 3 && !item.is_damaged() {
        let message = format!("a face has at least 3 corners, not {count}");
        reader.report(Diagnostic::error(codes::WRONG_COUNT, item.head(), message).expected(FACE));
        return None;
    }
    good.then_some(())
}

/// Reads a corner of a face.
fn corner(reader: &mut Reader<'_>, item: Item<'_, '_>) -> Option<u32> {
    let corner = u32::read(reader, item, &CORNER)?;
    match reader.points {
        Some(count) if corner as usize >= count => {
            let message = format!("a face names point {corner}, but the mesh has {count} points");
            let fault = Diagnostic::error(codes::OUT_OF_RANGE, item.span(), message)
                .expected(format!("a number from 0 to {}", count.saturating_sub(1)));
            let from_one = corner as usize == count;
            reader.report(if from_one { fault.hint("points are counted from 0") } else { fault });
            None
        }
        _ => Some(corner),
    }
}
