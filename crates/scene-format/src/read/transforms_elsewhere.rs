//! Transforms and placements in the ways of other programs: `RotateY(30)`, `Translate(x: 1)`, `[(1, 0, 0)]`.

use super::elsewhere::{Fields, axis, degrees, fields_named, matrix_rows, numbers};
use super::synonyms::synonyms;
use super::together::{Together, in_place_of};
use super::unknown::Unknown;
use super::{LOOK_AT, Reader, hinted, is_expression};
use crate::codes;
use crate::desc::matrix::unnamed_rows;
use crate::desc::{PlacementPattern, TransformWords};
use crate::diagnostic::{Diagnostic, Edit};
use crate::schema::{FieldDef, StructDef};
use crate::syntax::{Syntax, decode};
use crate::tree::{Item, Kind};
use std::borrow::Cow;

/// Transforms as they are written here.
const TRANSFORMS: [&str; 4] = ["Translate", "Rotate", "Scale", "Matrix"];

impl Reader<'_> {
    /// A transform as other programs write it, `RotateY(30)` or `Translate(x: 1)`: reports it, and says that it did.
    pub(crate) fn transform_elsewhere(&mut self, item: Item<'_, '_>) -> bool {
        let bare = matches!(item.kind(), Kind::Tuple | Kind::List) && item.name().is_none();
        if let Some([x, y, z]) = numbers(item).filter(|_| bare).and_then(|all| <[&str; 3]>::try_from(all).ok()) {
            let mended = match item.syntax() {
                Syntax::Ron => format!("Translate(({x}, {y}, {z}))"),
                syntax => syntax.of_toml(format!("{{ Translate = [{x}, {y}, {z}] }}")).into_owned(),
            };
            let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), "a transform cannot be three numbers")
                .expected("one of Translate(..), Rotate(..), Scale(..) and others")
                .hint(format!("write {mended}"));
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
            self.report(fault);
            return true;
        }
        let Some((name, body)) = kind_and_body(item) else { return false };
        let Some(steps) = meant_transform(&name, body) else { return false };
        let mended = match item.syntax() {
            Syntax::Ron => format!("{}({})", steps.kind, steps.ron),
            syntax => syntax.of_toml(format!("{{ {} = {} }}", steps.kind, steps.toml)).into_owned(),
        };
        let mut fault =
            Diagnostic::error(codes::WRONG_TYPE, item.head(), format!("a {} is not written so", steps.noun)).expected(
                match item.syntax() {
                    Syntax::Ron => steps.form.to_owned(),
                    syntax => syntax.of_toml(steps.form_of_toml).into_owned(),
                },
            );
        fault.hint = match steps.doubt {
            None => format!("write {mended}"),
            Some(Doubt::Radians) => format!("angles are in degrees: if that is in radians, write {mended}"),
            Some(Doubt::Axis) => format!("{OR_AXIS} write {mended} with the degrees that it turns"),
            Some(Doubt::Part) => format!("one step turns about one axis, as in {mended}"),
        };
        fault.edit = steps.doubt.is_none().then(|| Edit { span: item.span(), replacement: mended });
        self.report(fault);
        true
    }

    /// A rule for copies in the brackets of a list, `[Ring(count: 6, radius: 2)]`: told once, with the rule alone.
    pub(crate) fn pattern_in_brackets(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> bool {
        let is_pattern = |child: &Item<'_, '_>| {
            kind_and_body(*child).is_some_and(|(name, _)| PlacementPattern::DEF.variant(&name).is_some())
        };
        // What stands under a header of TOML has no brackets that could be left out.
        let is_header = item.syntax() == Syntax::Toml && !item.lexeme().ends_with(']')
            || item.lexeme().strip_prefix("[[").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_lowercase()));
        let mut children = item.children();
        let Some(first) = children.next().filter(|_| !is_header) else { return false };
        // Two pairs of brackets: a placement is a list, too.
        let within = || first.children().next().filter(|_| first.kind() == Kind::List && first.children().count() == 1);
        let Some(pattern) = Some(first).filter(is_pattern).or_else(|| within().filter(is_pattern)) else {
            return false;
        };
        let message = format!("{} are a rule alone, or a list of lists of transforms", super::plain(at.noun));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message);
        let alone = Fields(item.syntax()).name(at.name) + pattern.lexeme();
        fault.expected = alone.clone();
        if children.next().is_some() {
            fault.hint = format!("one rule stands alone, `{}`; each other has an object of its own", hinted(&alone));
        } else {
            fault.hint = format!("write `{}`, without the brackets", hinted(&alone));
            fault.edit = Some(Edit { span: item.span(), replacement: pattern.lexeme().to_owned() });
        }
        self.report(fault);
        true
    }

    /// A list of points or of single transforms where one of placements stands, `[(1, 0, 0), (2, 0, 0)]`: told once.
    pub(crate) fn placements_elsewhere(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> bool {
        // More than these are told one by one.
        const MOST: usize = 20;
        let mut children = item.children();
        let right =
            |first: Item<'_, '_>| first.kind() == Kind::List && first.children().any(|step| step.number().is_none());
        if children.next().is_none_or(right) || children.next().is_none() || children.nth(MOST - 2).is_some() {
            return false;
        }
        let placement = |child: Item<'_, '_>| {
            let point = numbers(child).filter(|numbers| child.name().is_none() && numbers.len() == 3);
            let Some(numbers) = point else {
                let certain = child.name().is_some() && TRANSFORMS.contains(&child.name().unwrap_or_default());
                return certain.then(|| format!("[{}]", child.lexeme()));
            };
            let by = numbers.join(", ");
            Some(match child.syntax() {
                Syntax::Ron => format!("[Translate(({by}))]"),
                syntax => syntax.of_toml(format!("[{{ Translate = [{by}] }}]")).into_owned(),
            })
        };
        let Some(all) = item.children().map(placement).collect::<Option<Vec<String>>>() else { return false };
        let mended = format!("[{}]", all.join(", "));
        let message = format!("{} are lists of transforms, one list for each copy", super::plain(at.noun));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message)
            .expected("[[a transform, ..], [a transform, ..]]")
            .hint(format!("write {mended}"));
        fault.edit = Some(Edit { span: item.span(), replacement: mended });
        self.report(fault);
        true
    }

    /// `{ translate: (0, 1, 0), rotate: (0, 45, 0) }` where a list of transforms stands: reported, with what they are.
    pub(super) fn transforms_in_braces<T>(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<T> {
        let expected = match item.syntax() {
            Syntax::Ron => "a list: [Translate((x, y, z)), Rotate(axis: (x, y, z), degrees: ..)]",
            _ => "a list of transforms",
        };
        let Some((steps, doubt)) = steps_of_fields(item) else {
            return self.wrong_kind(item, at.noun, expected, each_by_itself(item));
        };
        let message = format!("{} cannot be {}", super::plain(at.noun), super::describe(item));
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected);
        fault.hint = way_of_steps(&steps, doubt, item.syntax(), "");
        let mended = listed(&steps, item.syntax());
        fault.edit = doubt.is_none().then(|| Edit { span: item.span(), replacement: mended });
        self.report(fault);
        None
    }

    /// Numbers or fields where a placement stands, which is a list of transforms: reports it, and says that it did.
    pub(crate) fn placement_elsewhere(&mut self, item: Item<'_, '_>) -> bool {
        let expected = match item.syntax() {
            Syntax::Ron => "[Translate((x, y, z))]".into(),
            syntax => syntax.of_toml("[{ Translate = [x, y, z] }]"),
        };
        if matches!(item.kind(), Kind::Struct | Kind::Map) && item.name().is_none() {
            let Some((steps, doubt)) = steps_of_fields(item) else { return false };
            let message = "a placement is a list of transforms, not a group of fields";
            let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected);
            fault.hint = way_of_steps(&steps, doubt, item.syntax(), "");
            let mended = listed(&steps, item.syntax());
            fault.edit = doubt.is_none().then(|| Edit { span: item.span(), replacement: mended });
            self.report(fault);
            return true;
        }
        let bare = matches!(item.kind(), Kind::Tuple | Kind::List) && item.name().is_none();
        let Some(numbers) = numbers(item).filter(|_| bare) else { return false };
        let message = format!("a placement is a list of transforms, not of {} numbers", numbers.len());
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected(expected);
        if let [x, y, z] = numbers[..] {
            let mended = match item.syntax() {
                Syntax::Ron => format!("[Translate(({x}, {y}, {z}))]"),
                syntax => syntax.of_toml(format!("[{{ Translate = [{x}, {y}, {z}] }}]")).into_owned(),
            };
            fault = fault.hint(format!("write {mended}"));
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
        } else if let Some(rows) = matrix_rows(item) {
            let mended = match item.syntax() {
                Syntax::Ron => format!("[Matrix({rows})]"),
                syntax => {
                    let rows = rows.trim_start_matches("rows: ").replace('(', "[").replace(')', "]");
                    syntax.of_toml(format!("[{{ Matrix = {{ rows = {rows} }} }}]")).into_owned()
                }
            };
            fault = fault.hint(format!("write {mended}"));
            fault.edit = Some(Edit { span: item.span(), replacement: mended });
        } else {
            fault = fault.hint("rows of numbers stand in a placements file: `placements: \"copies.txt\"`");
        }
        self.report(fault);
        true
    }
}

/// `position: (0, 1, 0), rotation: (0, 45, 0)` as steps of a transform, in the order of most programs.
fn steps_of_fields(item: Item<'_, '_>) -> Option<(Vec<Meant>, Option<Doubt>)> {
    let steps = item.fields().map(|(key, value)| {
        let name = key.text().to_ascii_lowercase();
        let three = numbers(value).and_then(|numbers| <[&str; 3]>::try_from(numbers).ok());
        Some(match (&*name, three) {
            ("translate" | "translation" | "position" | "location" | "move", Some(by)) => (2, vec![translation(by)]),
            ("scale", Some(by)) => (0, vec![scaling(by)]),
            ("rotate" | "rotation" | "rotation_euler", Some(degrees)) => (1, all_angles(degrees)),
            _ => return None,
        })
    });
    steps.collect::<Option<Vec<(u8, Vec<Meant>)>>>().map(in_order)
}

/// Steps in the order in which most programs take them: they scale, then turn, then move; and what is not sure of them.
fn in_order(mut steps: Vec<(u8, Vec<Meant>)>) -> (Vec<Meant>, Option<Doubt>) {
    steps.sort_by_key(|(place, _)| *place);
    let steps: Vec<Meant> = steps.into_iter().flat_map(|(_, steps)| steps).collect();
    let doubt = steps.iter().find_map(|step| step.doubt);
    (steps, doubt)
}

/// What is said of steps that stand for fields, `name` being that of the field to write.
fn way_of_steps(steps: &[Meant], doubt: Option<Doubt>, syntax: Syntax, name: &str) -> String {
    let mark = if name.is_empty() { "" } else { "`" };
    let mended = format!("{mark}{name}{}{mark}", listed(steps, syntax));
    match doubt {
        Some(Doubt::Radians) => format!("angles are in degrees: if these are in radians, write {mended}"),
        Some(Doubt::Axis) => format!("{OR_AXIS} write {mended} with the degrees that it turns"),
        _ if steps.windows(2).any(|two| two[0].kind != two[1].kind) => {
            format!("write {mended}: a list is applied from first to last, and such fields scale, turn, then move")
        }
        _ => format!("write {mended}"),
    }
}

/// How a thing is brought to a place by its middle, for `center: true` of OpenSCAD, `recenter: true` and the like.
pub(super) fn centred(name: &str, value: Item<'_, '_>, def: &'static StructDef) -> Option<Cow<'static, str>> {
    let is_one = match name.to_ascii_lowercase().as_str() {
        "center" | "centre" => value.kind() == Kind::Bool,
        "centered" | "centred" | "recenter" | "recentre" | "center_mesh" | "center_geometry" | "auto_center" => true,
        _ => false,
    };
    if !is_one || def.field("transform").is_none() {
        return None;
    }
    let step = match value.syntax() {
        Syntax::Ron => "transform: [CenterTo((0, 0, 0))]".into(),
        syntax => syntax.of_toml("transform = [{ CenterTo = [0, 0, 0] }]"),
    };
    Some(format!("the middle of its bounds comes to a point by `{step}`").into())
}

/// One transform without its list, as it is written here within one: `[Translate((1, 0, 0))]`; `None` where it is
/// written in our way.
pub(super) fn lone_transform(item: Item<'_, '_>) -> Option<String> {
    let (name, body) = kind_and_body(item)?;
    let lower = name.to_ascii_lowercase();
    let three = numbers(body).filter(|_| matches!(&*lower, "translate" | "move" | "translation"));
    let meant = match three.as_deref() {
        Some(&[x, y, z]) => translation([x, y, z]),
        _ => meant_transform(&name, body).filter(|meant| meant.doubt.is_none())?,
    };
    Some(match item.syntax() {
        Syntax::Ron => format!("[{}({})]", meant.kind, meant.ron),
        syntax => syntax.of_toml(format!("[{{ {} = {} }}]", meant.kind, meant.toml)).into_owned(),
    })
}

/// The name of a kind and what stands in its brackets.
fn kind_and_body<'t, 's>(item: Item<'t, 's>) -> Option<(String, Item<'t, 's>)> {
    match item.kind() {
        Kind::Tuple | Kind::Struct => Some((item.name()?.to_owned(), item)),
        Kind::Map if item.lexeme().starts_with('{') => {
            let mut fields = item.fields();
            let (key, value) = fields.next().filter(|_| fields.clone().next().is_none())?;
            Some((key.text().into_owned(), value))
        }
        _ => None,
    }
}

/// A transform, written in our way.
#[derive(Clone)]
struct Meant {
    kind: &'static str,
    noun: &'static str,
    form: &'static str,
    form_of_toml: &'static str,
    ron: String,
    toml: String,
    /// What is not sure of it.
    doubt: Option<Doubt>,
}

/// Why a transform may not be what was meant.
#[derive(Clone, Copy)]
enum Doubt {
    /// It is not all that was meant.
    Part,
    /// An angle was taken for one in radians.
    Radians,
    /// `(0, 1, 0)` may be an angle for each axis, or an axis.
    Axis,
}

/// What is asked of such numbers.
const OR_AXIS: &str = "is that an axis, or an angle for each axis?";

/// A number or an expression as it is written.
fn one<'s>(item: Item<'_, 's>) -> Option<&'s str> {
    (item.number().is_some() || is_expression(item)).then(|| item.lexeme())
}

/// Numbers or expressions within brackets as they are written.
fn reckoned<'s>(item: Item<'_, 's>) -> Option<Vec<&'s str>> {
    let all: Option<Vec<&str>> = item.children().take(20).map(one).collect();
    all.filter(|all| !all.is_empty())
}

fn meant_transform(name: &str, body: Item<'_, '_>) -> Option<Meant> {
    let lower = name.to_ascii_lowercase();
    let list = matches!(body.kind(), Kind::Tuple | Kind::List).then(|| numbers(body)).flatten();
    let named = matches!(body.kind(), Kind::Struct | Kind::Map);
    let values = || matches!(body.kind(), Kind::Tuple | Kind::List).then(|| reckoned(body)).flatten();
    let number = one(body).or_else(|| match values().as_deref() {
        Some([only]) => Some(*only),
        _ => None,
    });
    // `RotateX(degrees: 30)`; asked of names with an axis alone.
    let in_degrees = || {
        let all = ["degrees", "angle", "deg", "by", "theta", "value"];
        let named = |field: &&str| body.fields().take(4).find(|(key, _)| key.text().eq_ignore_ascii_case(field));
        let found = all.iter().find_map(named).and_then(|(_, degrees)| one(degrees)).map(str::to_owned);
        let radians = || fields_named(body, ["radians"]).map(|[radians]| degrees(decode::number(radians), radians));
        found.or_else(radians).or(number.map(str::to_owned))
    };
    if let Some(letter) = lower.strip_prefix("rotate").or(lower.strip_prefix("rot")).map(|rest| rest.trim_matches('_'))
        && let (Some(axis), Some(degrees)) = (axis(letter), in_degrees())
    {
        return Some(rotation(axis, &degrees, true));
    }
    match lower.as_str() {
        "rotate" | "rotation" => {
            for letter in ["x", "y", "z"] {
                if let Some([degrees]) = fields_named(body, [letter]).filter(|_| named) {
                    return Some(rotation(axis(letter)?, degrees, true));
                }
            }
            match number {
                Some(degrees) if !named => Some(rotation(["0", "1", "0"], degrees, false)),
                _ => turned(body, list.as_deref()),
            }
        }
        "translate" | "move" | "translation" if named => {
            let vector = ["by", "offset", "vector", "value", "to", "delta", "v"];
            let mut fields = body.fields();
            if let (Some((key, by)), None) = (fields.next(), fields.next())
                && vector.contains(&&*key.text())
            {
                return Some(translation(<[&str; 3]>::try_from(numbers(by)?).ok()?));
            }
            let mut by = ["0"; 3];
            for (key, value) in body.fields().take(4) {
                let at = ["x", "y", "z"].iter().position(|name| key.text() == **name)?;
                let reckoned = value.kind() == Kind::Text && value.text().starts_with('=');
                by[at] = Some(value.lexeme()).filter(|_| reckoned || value.number().is_some())?;
            }
            body.fields().next()?;
            Some(translation(by))
        }
        "scale" => {
            let three = match list.as_deref() {
                Some(&[x, y, z]) if body.name().is_some() => Some([x, y, z]),
                _ => fields_named(body, ["x", "y", "z"]).filter(|_| named),
            };
            three.map(scaling)
        }
        "centerto" | "center" | "centre" | "recenter" | "recentre" => {
            let ours = name == "CenterTo";
            let mut inside = body.children();
            let only = inside.next().filter(|_| !ours && !named && inside.next().is_none()).and_then(numbers);
            let three = match list.or(only).as_deref() {
                Some(&[x, y, z]) if !ours || body.name().is_some() => Some([x, y, z]),
                _ => fields_named(body, ["x", "y", "z"]).filter(|_| named),
            };
            three.map(centring)
        }
        "matrix" if !named => unnamed_rows(body).map(|rows| matrix(&rows)),
        _ => None,
    }
}

fn matrix(rows: &str) -> Meant {
    Meant {
        kind: "Matrix",
        noun: "matrix",
        form: "Matrix(rows: ((a, b, c, x), (d, e, f, y), (g, h, i, z)))",
        form_of_toml: "{ Matrix = { rows = [[a, b, c, x], [d, e, f, y], [g, h, i, z]] } }",
        ron: format!("rows: {rows}"),
        toml: format!("{{ rows = {rows} }}"),
        doubt: None,
    }
}

/// `Rotate((0, 30, 0))`, an angle an axis, `Rotate((0, 1, 0), 30)` and `Rotate(30, (0, 1, 0))`.
fn turned(body: Item<'_, '_>, list: Option<&[&str]>) -> Option<Meant> {
    if body.kind() == Kind::List && body.syntax() != Syntax::Ron {
        return angles(<[&str; 3]>::try_from(list?).ok()?);
    }
    if body.kind() != Kind::Tuple || body.name().is_none() {
        return None;
    }
    let mut children = body.children();
    let (first, second, third) = (children.next()?, children.next(), children.next());
    if let Some(&[x, y, z]) = list {
        return angles([x, y, z]);
    }
    if let (Some(_), Some(axis), None) = (first.number(), second, third)
        && let Ok(axis) = <[&str; 3]>::try_from(numbers(axis)?)
    {
        return Some(rotation(axis, first.lexeme(), true));
    }
    let three: [&str; 3] = numbers(first).filter(|_| first.name().is_none())?.try_into().ok()?;
    match (second, third) {
        (None, _) => angles(three),
        (Some(degrees), None) => degrees.number().map(|_| rotation(three, degrees.lexeme(), true)),
        _ => None,
    }
}

/// Steps in the list of a syntax.
fn listed(steps: &[Meant], syntax: Syntax) -> String {
    let step = |meant: &Meant| match syntax {
        Syntax::Ron => format!("{}({})", meant.kind, meant.ron),
        syntax => syntax.of_toml(format!("{{ {} = {} }}", meant.kind, meant.toml)).into_owned(),
    };
    format!("[{}]", steps.iter().map(step).collect::<Vec<_>>().join(", "))
}

/// An angle for each axis, x first, as most programs turn: a step for each that is not zero.
fn all_angles(degrees: [&str; 3]) -> Vec<Meant> {
    let turned = ["x", "y", "z"].into_iter().zip(degrees).filter(|(_, degrees)| decode::number(degrees) != 0.0);
    let step = |(letter, angle): (&str, &str)| {
        let step = rotation(axis(letter)?, angle, true);
        Some(Meant { doubt: step.doubt.or(may_be_axis(degrees).then_some(Doubt::Axis)), ..step })
    };
    turned.filter_map(step).collect()
}

/// Whether three numbers may be an axis: as angles they are hardly any.
fn may_be_axis(numbers: [&str; 3]) -> bool {
    numbers.iter().all(|number| matches!(decode::number(number), -1.0 | 0.0 | 1.0))
}

/// What a field of other programs is among the steps of a transform, and at which place: most of them scale, then turn,
/// then move.
fn step_as_field(name: &str, value: Item<'_, '_>, def: &'static StructDef) -> Option<(u8, Vec<Meant>)> {
    if def.field(name).is_some() || !synonyms(name, def).is_empty() || value.name().is_some() {
        return None;
    }
    // `{ "y": 45 }` says nothing of the others.
    let by_axes = |other: &'static str| {
        let mut three = [other; 3];
        for (key, value) in value.fields().take(4) {
            let at = ["x", "y", "z"].iter().position(|axis| key.text() == **axis)?;
            three[at] = one(value)?;
        }
        value.fields().next().map(|_| three)
    };
    let other = if name.starts_with("scal") { "1" } else { "0" };
    let three = || reckoned(value).and_then(|all| <[&str; 3]>::try_from(all).ok()).or_else(|| by_axes(other));
    match name {
        // How high hills are.
        "scale" if def.name == "HeightField" && one(value).is_some() => None,
        "scale" | "scaling" => {
            let factors = three().or_else(|| one(value).map(|factor| [factor; 3]))?;
            let same = one(value).is_some();
            let mut step = scaling(factors);
            if same {
                (step.ron, step.toml) = (factors[0].to_owned(), factors[0].to_owned());
            }
            Some((0, vec![step]))
        }
        "rotate" | "rotation" | "euler" | "rotation_euler" | "orientation" => {
            let steps = all_angles(three()?);
            (!steps.is_empty()).then_some((1, steps))
        }
        "rotateX" | "rotateY" | "rotateZ" | "rotate_x" | "rotate_y" | "rotate_z" => {
            let letter = name.rsplit(['e', '_']).next()?;
            Some((1, vec![rotation(axis(letter)?, one(value)?, true)]))
        }
        "position" | "pos" | "location" | "center" | "translate" | "translation" | "move" | "offset" => {
            Some((2, vec![translation(three()?)]))
        }
        _ => None,
    }
}

/// `position`, `rotation` and `scale` of what has a `transform`, all together as one.
pub(super) fn placed(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { key, item, def, name, value } = unknown;
    let is_written = || item.fields().take(LOOK_AT).any(|(key, _)| key.text() == "transform");
    step_as_field(name, value, def).filter(|_| def.field("transform").is_some() && !is_written())?;
    let mut found = Vec::new();
    let mut steps = Vec::new();
    for (key, value) in item.fields().take(LOOK_AT) {
        if let Some(step) = step_as_field(&key.text(), value, def) {
            steps.push(step);
            found.push((key, value));
        }
    }
    let fields = vec!["transform"];
    if found.iter().any(|(other, _)| other.span().start < key.span().start) {
        return Some(Together { hint: None, edit: None, fields });
    }
    let (steps, doubt) = in_order(steps);
    let name = Fields(item.syntax()).name("transform");
    let hint = Some(way_of_steps(&steps, doubt, item.syntax(), &name));
    let mended = || in_place_of(&found, item, name + &listed(&steps, item.syntax()));
    Some(Together { hint, edit: doubt.is_none().then(mended).flatten(), fields })
}

/// An angle for each axis: one step where only one is not zero.
fn angles(degrees: [&str; 3]) -> Option<Meant> {
    let turned = |degrees: &str| decode::number(degrees) != 0.0;
    let count = degrees.iter().filter(|degrees| turned(degrees)).count();
    let at = degrees.iter().position(|degrees| turned(degrees))?;
    let step = rotation(axis(["x", "y", "z"][at])?, degrees[at], count == 1);
    Some(Meant { doubt: step.doubt.or(may_be_axis(degrees).then_some(Doubt::Axis)), ..step })
}

/// An angle that is no more than a turn in radians, and no whole number: as degrees.
pub(super) fn as_radians(angle: Item<'_, '_>) -> Option<String> {
    angle.number().and_then(|_| in_degrees(angle.lexeme()))
}

fn in_degrees(angle: &str) -> Option<String> {
    let value = decode::number(angle);
    let is_one = value.fract() != 0.0 && value.abs() <= 6.3;
    is_one.then(|| degrees(value, angle))
}

fn rotation(axis: [&str; 3], angle: &str, certain: bool) -> Meant {
    let axis = axis.join(", ");
    let radians = in_degrees(angle);
    let degrees = radians.as_deref().unwrap_or(angle);
    Meant {
        kind: "Rotate",
        noun: "rotation",
        form: "Rotate(axis: (x, y, z), degrees: ..)",
        form_of_toml: "{ Rotate = { axis = [x, y, z], degrees = .. } }",
        ron: format!("axis: ({axis}), degrees: {degrees}"),
        toml: format!("{{ axis = [{axis}], degrees = {degrees} }}"),
        doubt: match (radians, certain) {
            (Some(_), _) => Some(Doubt::Radians),
            (None, true) => None,
            (None, false) => Some(Doubt::Part),
        },
    }
}

fn translation(by: [&str; 3]) -> Meant {
    of_numbers("Translate", "translation", ["Translate((x, y, z))", "{ Translate = [x, y, z] }"], by)
}

fn centring(point: [&str; 3]) -> Meant {
    of_numbers("CenterTo", "centring", ["CenterTo((x, y, z))", "{ CenterTo = [x, y, z] }"], point)
}

fn scaling(factors: [&str; 3]) -> Meant {
    let forms = ["Scale(factor) or Scale((x, y, z))", "{ Scale = factor } or { Scale = [x, y, z] }"];
    of_numbers("Scale", "scaling", forms, factors)
}

/// A step that three numbers say.
fn of_numbers(kind: &'static str, noun: &'static str, forms: [&'static str; 2], numbers: [&str; 3]) -> Meant {
    let numbers = numbers.join(", ");
    let [form, form_of_toml] = forms;
    Meant { kind, noun, form, form_of_toml, ron: format!("({numbers})"), toml: format!("[{numbers}]"), doubt: None }
}

/// `{ Rotate = { .. }, Scale = 2 }`, our own transforms in one table, each in a table of its own.
fn each_by_itself(item: Item<'_, '_>) -> Option<String> {
    let ours = |key: &Item<'_, '_>| TransformWords::DEF.variant(&key.text()).is_some();
    if item.syntax() == Syntax::Ron || !item.lexeme().starts_with('{') || !item.fields().all(|(key, _)| ours(&key)) {
        return None;
    }
    let join = if item.syntax() == Syntax::Toml { " =" } else { ":" };
    let steps: Vec<String> =
        item.fields().map(|(key, value)| format!("{{ {}{join} {} }}", key.lexeme(), value.lexeme())).collect();
    Some(format!("[{}]", steps.join(", ")))
}
