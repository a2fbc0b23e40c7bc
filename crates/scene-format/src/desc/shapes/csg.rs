//! Constructive solid geometry: closed shapes put together, what they have in common, one without others.

use super::Placements;
use crate::codes;
use crate::desc::{Cone, Cylinder, Faulty, ITEMS, MOST_NESTED, MaterialRef, Name, Object, ShapeWords, Transform};
use crate::diagnostic::{Diagnostic, Edit, Span, Spanned};
use crate::files::FileKind;
use crate::form::Form;
use crate::read::Reader;
use crate::schema::{FieldDef, Rule, Type};
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};
use crate::words::{Told, Words, scene_struct};

/// Shapes that one solid is made of, at most, those of solids in it counted.
const MOST_OPERANDS: usize = 64;

/// The shapes that a solid is made of.
#[derive(Clone, Debug, PartialEq)]
pub struct Operands(pub Vec<Spanned<Object>>);

impl Words for Operands {
    const TYPE: Type = Type::List(&Type::Later(|| Type::Enum(&Object::DEF)));

    fn read(reader: &mut Reader<'_>, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Self> {
        if reader.groups >= MOST_NESTED {
            let message = format!("groups and solids stand more than {MOST_NESTED} deep");
            reader.report(Diagnostic::error(codes::TOO_MUCH, item.head(), message).expected("fewer"));
            return None;
        }
        reader.groups += 1;
        let few = if item.kind() == Kind::List { item.children().take(MOST_OPERANDS).count() } else { 0 };
        let (mut list, mut whole) = (Vec::with_capacity(few), true);
        let read = reader.items(item, at, |reader, child| {
            let Some(chosen) = reader.variant(child, &ITEMS) else {
                whole = false;
                return;
            };
            if let kind @ ("Group" | "Include") = chosen.variant.name {
                whole = false;
                reader.report(holder(kind, child));
                return;
            }
            match Object::of_chosen(reader, &chosen) {
                Some(value) => list.push(Spanned { value, span: child.span() }),
                None => whole = false,
            }
        });
        reader.groups -= 1;
        read?;
        // Of what could not be read nobody knows whether the rest would do.
        whole.then_some(Operands(list))
    }

    fn form(&self, all: bool) -> Form {
        Form::list(self.0.iter().map(|object| object.value.form(all)))
    }
}

scene_struct! {
    /// Closed shapes put together to one body: there are no walls inside it, also where they touch. Every surface has
    /// the material of the shape that it is of, and its texture coordinates. It may shine, whole or in parts, by
    /// `radiance` or `luminance`; light samples find it, photons and light paths do not start on it.
    pub struct Union as "Union", "a union" {
        /// The shapes, at least one: `Sphere`, `Box`, `Cylinder` and `Cone` with caps, `Capsule`, `Torus`, `Union`,
        /// `Intersection`, `Difference`, with their transforms and without placements; 64 at most, those within each
        /// other counted. Where surfaces coincide that of the first shows. Solids that have an end may have a `Plane`,
        /// too, which is all of space behind it, as seen from where its normal points.
        objects: Operands;
        /// The material of those shapes in it that have none of their own.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms of all of it, applied first to last, after those of the shapes in it. Turns and scales without
        /// `about` are about the origin. `DropTo`, `CenterTo` and `FitTo` go by the boxes of the shapes.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.transform=[]` finds it where no other has this name. Masks know the
        /// whole, by this name.
        name: Name = Name::default();
    }
}

scene_struct! {
    /// What closed shapes have in common: of two balls a lens. Every surface has the material of the shape that it is
    /// of, and its texture coordinates. It may shine as a `Union` may.
    pub struct Intersection as "Intersection", "an intersection" {
        /// The shapes, as those of a `Union`. Where surfaces coincide that of the first shows.
        objects: Operands;
        /// The material of those shapes in it that have none of their own.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms of all of it, applied first to last, after those of the shapes in it. Turns and scales without
        /// `about` are about the origin. `DropTo`, `CenterTo` and `FitTo` go by what the boxes of the shapes have in
        /// common.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.transform=[]` finds it where no other has this name. Masks know the
        /// whole, by this name.
        name: Name = Name::default();
    }
}

scene_struct! {
    /// The first of several closed shapes without the others: a wall with a window, a bowl. Where it is cut the surface
    /// is that of the shape that cuts, with its material, where it has one, and its texture coordinates. It may shine
    /// as a `Union` may.
    pub struct Difference as "Difference", "a difference" {
        /// The shapes, as those of a `Union`: first what is cut, then what is taken away. Where both have a face in
        /// one place, and what is taken away lies behind it, it is gone: no skin is left.
        objects: Operands;
        /// The material of those shapes in it that have none of their own.
        material: MaterialRef = MaterialRef::Default;
        /// Transforms of all of it, applied first to last, after those of the shapes in it. Turns and scales without
        /// `about` are about the origin. `DropTo`, `CenterTo` and `FitTo` go by the box of the first shape.
        transform: Vec<Spanned<Transform>> = Vec::new();
        /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it. A text is the
        /// name of a placements file, one placement a line; `Grid`, `Ring` and `Scatter` make copies by a rule.
        placements: Placements = Placements::One => Rule::file(FileKind::Placements);
        /// Whether the camera sees it. If not, camera rays pass as if it were not there; it still throws shadows,
        /// shines, and is seen in mirrors and through glass.
        camera_visible: bool = true;
        /// What it is called: `--set objects.NAME.transform=[]` finds it where no other has this name. Masks know the
        /// whole, by this name.
        name: Name = Name::default();
    }
}

impl Told for Union {
    const ALSO: &'static [&'static str] = &["merge", "fuse", "booleanunion"];
    const EXAMPLE: &'static str = "Union(objects: [Box(size: (2, 0.3, 1)), Cylinder(to: (0, 1, 0), radius: 0.3)])";
}

impl Told for Intersection {
    const ALSO: &'static [&'static str] = &["intersect", "booleanintersect", "common"];
    const EXAMPLE: &'static str = "Intersection(material: Transparent(ior: 1.5), objects: [\n    \
         Sphere(center: (0, 0, -2), radius: 2.2),\n    Sphere(center: (0, 0, 2), radius: 2.2),\n])";
}

impl Told for Difference {
    const ALSO: &'static [&'static str] = &["subtract", "subtraction", "booleandifference", "cut", "minus"];
    const EXAMPLE: &'static str = "Difference(objects: [\n    Box(size: (3, 2, 0.2)),\n    \
         Box(size: (1, 1, 1), material: Diffuse(albedo: (0.8, 0.3, 0.2))),\n])";
}

impl ShapeWords for Union {
    const MANY: &'static str = "unions";
}

impl ShapeWords for Intersection {
    const MANY: &'static str = "intersections";
}

impl ShapeWords for Difference {
    const MANY: &'static str = "differences";
}

impl Faulty for Union {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        faults(&self.objects, "union", span)
    }
}

impl Faulty for Intersection {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        faults(&self.objects, "intersection", span)
    }
}

impl Faulty for Difference {
    fn faults(&self, span: Span) -> Vec<Diagnostic> {
        faults(&self.objects, "difference", span)
    }
}

const CLOSED: &str = "`Sphere`, `Box`, `Cylinder` and `Cone` with caps, `Capsule`, `Torus`, `Plane`, `Union`, \
                      `Intersection` or `Difference`";

fn no_operand(at: Span, message: String, expected: &str) -> Diagnostic {
    Diagnostic::error(codes::NO_OPERAND, at, message).expected(expected)
}

/// What is said of a kind that holds others and is no shape itself.
fn holder(kind: &str, child: Item<'_, '_>) -> Diagnostic {
    if kind != "Group" {
        let fault = no_operand(child.head(), "an include is no closed shape".to_owned(), CLOSED);
        return fault.hint("write its shapes here, in a `Union`");
    }
    let mut fault = no_operand(child.head(), "a group is no closed shape".to_owned(), CLOSED);
    let body = match child.kind() {
        Kind::Map => child.fields().next().map(|(_, body)| body),
        _ => Some(child),
    };
    let fields = || body.into_iter().flat_map(|body| body.fields().take(8));
    // A union turns about its own middle, and has no lights in it.
    let is_same = fields().all(|(key, _)| matches!(&*key.text(), "objects" | "material" | "name"));
    let turns = fields().any(|(key, _)| key.text() == "transform");
    let of_ron = child.lexeme().strip_prefix("Group").filter(|_| child.syntax() == Syntax::Ron);
    fault.hint = match (of_ron, child.syntax()) {
        (Some(rest), _) if rest.len() < 100 && !rest.contains('\n') => format!("write Union{rest}"),
        (_, Syntax::Ron) => "write Union(objects: [..])".to_owned(),
        (_, Syntax::Toml) => "shapes that are one are a `Union`".to_owned(),
        (_, Syntax::Json) => "write \"Union\" in place of \"Group\"".to_owned(),
    };
    if turns {
        fault.hint += "; a union turns about its own middle, a group about the origin";
    }
    let start = child.span().start;
    let word = Span { end: start + "Group".len() as u32, ..child.span() };
    fault.edit = of_ron.filter(|_| is_same).map(|_| Edit { span: word, replacement: "Union".to_owned() });
    fault
}

/// What is wrong with the shapes of a solid.
fn faults(objects: &Operands, noun: &str, span: Span) -> Vec<Diagnostic> {
    let count = count(objects);
    if count > MOST_OPERANDS {
        let message = format!("the {noun} is made of {count} shapes");
        let fault = Diagnostic::error(codes::TOO_MUCH, span, message).expected(format!("{MOST_OPERANDS} at most"));
        return vec![fault.hint(
            "make several of it that stand side by side, each with the shapes that meet it; or make a mesh of it in \
             another program",
        )];
    }
    let mut found = Vec::new();
    collect(objects, noun, span, &mut found);
    found
}

/// A plane in a solid is all of space behind it: whether the solid has an end, by which of its shapes have one.
fn has_end(objects: &Operands, noun: &str) -> bool {
    // Solids in it have one, or are told themselves.
    let mut ends = objects.0.iter().map(|object| !matches!(object.value, Object::Plane(_)));
    match noun {
        "union" => ends.all(|end| end),
        "intersection" => ends.any(|end| end),
        _ => ends.next().unwrap_or(true),
    }
}

fn count(objects: &Operands) -> usize {
    objects.0.iter().map(|object| object.value.operands().map_or(1, count)).sum()
}

fn collect(objects: &Operands, noun: &str, span: Span, found: &mut Vec<Diagnostic>) {
    if objects.0.is_empty() {
        found.push(no_operand(span, format!("the {noun} is made of nothing"), "at least one shape in `objects`"));
    } else if !has_end(objects, noun) {
        let message = format!("the {noun} has no end: a plane in it is all of space behind the plane");
        let expected = match noun {
            "union" => "shapes that have an end",
            "intersection" => "one shape at least that has an end",
            _ => "a first shape that has an end",
        };
        let hint = "a `Box` has an end; planes cut an `Intersection` or a `Difference`";
        found.push(no_operand(span, message, expected).hint(hint));
    }
    for object in &objects.0 {
        let at = if object.span == Span::NONE { span } else { object.span };
        if let Some(inner) = object.value.operands() {
            collect(inner, &object.value.kind().to_lowercase(), at, found);
        } else if let Some((why, hint)) = unfit(&object.value) {
            found.push(no_operand(at, why, CLOSED).hint(hint));
            continue;
        } else {
            found.extend(object.value.faults(at));
        }
        if *object.value.placements() != Placements::One {
            let message = format!("a shape in a {noun} has no copies: its `placements` are not empty");
            let fault = no_operand(at, message, "one shape, moved by `transform`");
            found.push(fault.hint("copies in a solid are items of a `Repeat`"));
        }
        if !object.value.camera_visible() {
            let message = format!("a shape in a {noun} cannot be hidden from the camera by itself");
            let fault = no_operand(at, message, "`camera_visible` of the whole solid");
            found.push(fault.hint(format!("write it on the {noun}, or leave it out")));
        }
    }
}

/// Why a shape cannot be part of a solid, and what to do.
fn unfit(object: &Object) -> Option<(String, &'static str)> {
    let closed = "close it: `caps: true`";
    Some(match object {
        Object::Box(cuboid) if cuboid.is_rounded() => {
            let message = "a box with round edges is made of triangles, and cannot be part of a solid";
            (
                message.to_owned(),
                "leave `rounding` out, or let it stand beside the solid; a die is Intersection(objects: [Box(size: 1), \
                 Sphere(radius: 0.7)])",
            )
        }
        Object::Sphere(_) | Object::Box(_) | Object::Capsule(_) | Object::Torus(_) | Object::Plane(_) => return None,
        Object::Cylinder(cylinder) if matches!(**cylinder, Cylinder { caps: true, .. }) => return None,
        Object::Cone(cone) if matches!(**cone, Cone { caps: true, .. }) => return None,
        Object::Cylinder(_) => ("an open cylinder has no inside".to_owned(), closed),
        Object::Cone(_) => ("an open cone has no inside".to_owned(), closed),
        Object::Rectangle(_) => ("a rectangle has no inside".to_owned(), "a thin `Box` has one"),
        Object::Disk(_) => ("a disk has no inside".to_owned(), "a short `Cylinder` has one"),
        Object::Extrude(_) => {
            let message = "an `Extrude` is made of triangles, and cannot be part of a solid";
            (message.to_owned(), "its holes are further rings of its `outline`; or let it stand beside the solid")
        }
        other => {
            let kind = other.kind();
            let article = if kind.starts_with(['A', 'E']) { "an" } else { "a" };
            let message = format!("{article} `{kind}` is made of triangles, and cannot be part of a solid");
            (
                message,
                "build it of such shapes, or let it stand beside the solid; a mesh is seen cut open by `near` of the \
                 camera: what is nearer is not seen",
            )
        }
    })
}
