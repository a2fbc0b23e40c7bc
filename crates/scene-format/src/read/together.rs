//! Several fields of other programs that say together what one of ours says: `width` and `height`, `min` and `max`.

use super::ambiguous;
use super::elsewhere::{Fields, numbers, whole_field};
use super::figures;
use super::transforms_elsewhere::{as_radians, placed};
use super::unknown::Unknown;
use super::vars::is_expression;
use crate::diagnostic::{Edit, Span};
use crate::syntax::{Syntax, decode};
use crate::tree::Item;

/// What is said of such fields.
pub(super) struct Together {
    /// What to write; `None` where it has been said at the first of them.
    pub hint: Option<String>,
    pub edit: Option<Edit>,
    /// The fields that they stand for.
    pub fields: Vec<&'static str>,
}

/// What the values of such fields are in ours.
type Turned = fn(&[Item<'_, '_>], Syntax) -> Option<String>;

/// A kind, the names of its fields elsewhere, what they are of ours, how that is written in RON and in TOML, and it
/// written.
type Row = (&'static str, &'static [&'static [&'static str]], &'static [&'static str], [&'static str; 2], Turned);

const MIN: &[&str] = &["min", "minimum", "pmin", "p_min", "lower", "corner1", "corner_1", "bbmin", "from", "p1"];
const MAX: &[&str] = &["max", "maximum", "pmax", "p_max", "upper", "corner2", "corner_2", "bbmax", "to", "p2"];
const INNER: &[&str] = &["inner", "inner_radius", "interior_radius"];
const OUTER: &[&str] = &["outer", "outer_radius", "exterior_radius"];

const UV_SCALES: &[&[&str]] = &[&["uscale", "u_scale", "su"], &["vscale", "v_scale", "sv"]];

const UV_SCALE: [&str; 2] = ["mapping: Uv(scale: (u, v))", "mapping = { Uv = { scale = [u, v] } }"];

const SIDES: [&[&str]; 3] = [&["width", "w"], &["height", "h"], &["depth", "length", "d"]];

const OPERANDS: &[&[&str]] = &[
    &["a", "left", "base", "first", "minuend", "shape1", "object1", "lhs"],
    &["b", "right", "tool", "second", "subtrahend", "shape2", "object2", "rhs"],
];

const A: &[&str] = &["a", "p0", "v0"];
const B: &[&str] = &["b", "p1", "v1"];
const C: &[&str] = &["c", "p2", "v2"];

const POINTS: [&str; 2] = ["points: [(x, y, z), ..]", "points = [[x, y, z], ..]"];

const ROWS: &[Row] = &[
    ("Plane", &[&["y", "level", "elevation"]], &["point"], ["point: (0, y, 0)", "point = [0, y, 0]"], at_height),
    (
        "Plane",
        &[&["x"]],
        &["point", "normal"],
        ["point: (x, 0, 0), normal: (1, 0, 0)", "point = [x, 0, 0], normal = [1, 0, 0]"],
        across_x,
    ),
    (
        "Plane",
        &[&["z"]],
        &["point", "normal"],
        ["point: (0, 0, z), normal: (0, 0, 1)", "point = [0, 0, z], normal = [0, 0, 1]"],
        across_z,
    ),
    (
        "Box",
        &[MIN, MAX],
        &["center", "size"],
        ["center: (x, y, z), size: (x, y, z)", "center = [x, y, z], size = [x, y, z]"],
        middle_and_sides,
    ),
    ("Box", &SIDES, &["size"], ["size: (x, y, z)", "size = [x, y, z]"], size),
    (
        "Rectangle",
        &[&["width", "w"], &["height", "h", "depth", "length"]],
        &["size"],
        ["size: (x, y)", "size = [x, y]"],
        size,
    ),
    (
        "Checkerboard",
        &[&["color0", "color_0"], &["color1", "color_1"]],
        &["a", "b"],
        ["a: .., b: ..", "a = .., b = .."],
        two_colors,
    ),
    ("Checkerboard", UV_SCALES, &["mapping"], UV_SCALE, uv_scale),
    ("Lines", UV_SCALES, &["mapping"], UV_SCALE, uv_scale),
    ("Dots", UV_SCALES, &["mapping"], UV_SCALE, uv_scale),
    ("Texture", UV_SCALES, &["mapping"], UV_SCALE, uv_scale),
    (
        "Cone",
        &[&["radius0", "radius_0", "r0"], &["radius1", "radius_1", "r1"]],
        &["radius", "tip_radius"],
        ["radius: .., tip_radius: ..", "radius = .., tip_radius = .."],
        two_radii,
    ),
    ("Polygon", &[A, B, C, &["d", "p3", "v3"]], &["points"], POINTS, points),
    ("Polygon", &[A, B, C], &["points"], POINTS, points),
    ("Polygon", &[&["p1", "v1"], &["p2", "v2"], &["p3", "v3"], &["p4", "v4"]], &["points"], POINTS, points),
    ("Polygon", &[&["p1", "v1"], &["p2", "v2"], &["p3", "v3"]], &["points"], POINTS, points),
    ("Difference", OPERANDS, &["objects"], ["objects: [a, b]", "objects = [a, b]"], objects),
    ("Union", OPERANDS, &["objects"], ["objects: [a, b]", "objects = [a, b]"], objects),
    ("Intersection", OPERANDS, &["objects"], ["objects: [a, b]", "objects = [a, b]"], objects),
    // Where the outer edge of the ring is, or its middle: nobody knows.
    (
        "Torus",
        &[INNER, OUTER],
        &["radius", "tube_radius"],
        ["radius: .., tube_radius: ..", "radius = .., tube_radius = .."],
        unclear,
    ),
];

/// What is said of a field that is one of several; `None` where the others are not there.
pub(super) fn of(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let of_rows = || ROWS.iter().find_map(|row| of_row(unknown, row));
    let of_figures = || figures::of(unknown);
    ambiguous::of(unknown).or_else(of_rows).or_else(|| by_axes(unknown)).or_else(of_figures).or_else(|| placed(unknown))
}

/// Degrees or factors by their axes: `Rotate(x: 30, y: 40)`, `Scale(x: 2)`. One turn goes about one axis.
fn by_axes(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    const AXES: [&str; 3] = ["x", "y", "z"];
    let Unknown { name, item, def, .. } = unknown;
    let fields = match def.name {
        "Rotate" => vec!["axis", "degrees"],
        "Scale" => vec!["factor"],
        _ => return None,
    };
    if !AXES.contains(name) || item.fields().any(|(key, _)| fields.contains(&&*key.text())) {
        return None;
    }
    let find = |axis: &str| item.fields().find(|(key, _)| key.text() == axis);
    let found: Vec<(Item<'_, '_>, Item<'_, '_>)> = AXES.iter().filter_map(|axis| find(axis)).collect();
    if found.iter().any(|(key, _)| key.span().start < unknown.key.span().start) {
        return Some(Together { hint: None, edit: None, fields });
    }
    let syntax = item.syntax();
    let is_number = |value: &Item<'_, '_>| value.number().is_some() || is_expression(*value);
    let said = |axis: &str| find(axis).map(|(_, value)| value).filter(is_number);
    let write = |field: &str, value: &str| format!("{}{value}", Fields(syntax).name(field));
    let unit = |axis: &str| {
        let numbers: Vec<String> = AXES.iter().map(|other| u8::from(*other == axis).to_string()).collect();
        bracketed(&numbers, syntax)
    };
    let turns: Vec<String> = AXES
        .iter()
        .filter_map(|axis| {
            let (axis_of, degrees) = (write("axis", &unit(axis)), write("degrees", said(axis)?.lexeme()));
            Some(format!("{axis_of}, {degrees}"))
        })
        .collect();
    let (hint, mended) = match (def.name, turns.as_slice()) {
        ("Rotate", [only]) if let Some(radians) = AXES.iter().find_map(|axis| said(axis)).and_then(as_radians) => {
            let degrees = |degrees: &str| write("degrees", degrees);
            let only = only.rsplit_once(", ").map_or("", |(axis, _)| axis);
            (format!("angles are in degrees: if that is in radians, write `{only}, {}`", degrees(&radians)), None)
        }
        ("Rotate", [only]) => (format!("write `{only}`"), Some(only.clone())),
        ("Rotate", []) => (format!("write `{}, {}`", write("axis", &unit("x")), write("degrees", "30")), None),
        ("Rotate", turns) => {
            let all = if syntax == Syntax::Ron {
                turns.iter().map(|turn| format!("Rotate({turn})")).collect::<Vec<String>>().join(", ")
            } else {
                let turn = |turn: &String| format!("{{ Rotate = {{ {turn} }} }}");
                syntax.of_toml(turns.iter().map(turn).collect::<Vec<String>>().join(", ")).into_owned()
            };
            (format!("turn about one axis after the other: {all}"), None)
        }
        _ => {
            let factor = |axis: &&str| said(axis).map_or("1".to_owned(), |value| value.lexeme().to_owned());
            let mended = write("factor", &bracketed(&AXES.iter().map(factor).collect::<Vec<String>>(), syntax));
            (format!("write `{mended}`"), Some(mended))
        }
    };
    // In the order in which they are written.
    let edit = mended.and_then(|replacement| Some(Edit { span: all_of(&found, *item)?, replacement }));
    Some(Together { hint: Some(hint), edit, fields })
}

fn of_row(unknown: &Unknown<'_, '_, '_>, (kind, theirs, ours, [ron, toml], turned): &Row) -> Option<Together> {
    let Unknown { name, item, def, .. } = unknown;
    if def.name != *kind || !theirs.iter().any(|names| names.contains(name)) {
        return None;
    }
    // More fields than these are no scene.
    const MOST: usize = 64;
    let find = |names: &&[&str]| item.fields().take(MOST).find(|(key, _)| names.contains(&&*key.text()));
    let found: Vec<(Item<'_, '_>, Item<'_, '_>)> = theirs.iter().map(find).collect::<Option<_>>()?;
    let fields = ours.to_vec();
    // `from` with `height` is one of each.
    let of_ours = |key: Item<'_, '_>| def.field(&key.text()).is_some();
    let written = |field: &&str| item.fields().take(MOST).any(|(key, _)| key.text() == **field);
    if found.iter().any(|(key, _)| of_ours(*key)) && ours.iter().all(written) {
        return None;
    }
    if found.iter().any(|(key, _)| !of_ours(*key) && key.span().start < unknown.key.span().start) {
        return Some(Together { hint: None, edit: None, fields });
    }
    let syntax = item.syntax();
    let values: Vec<Item<'_, '_>> = found.iter().map(|(_, value)| *value).collect();
    let is_found = |field: &&&str| found.iter().any(|(key, _)| key.text() == **field);
    let there = ours.iter().find(|field| written(field) && !is_found(field));
    let mended = turned(&values, syntax).filter(|_| there.is_none());
    let way = if syntax == Syntax::Ron { (*ron).into() } else { syntax.of_toml(*toml) };
    let hint = match &mended {
        Some(mended) => format!("write `{mended}`"),
        None if let Some(there) = there => {
            format!("`{there}` is written already: leave these out, or write all of it as `{way}`")
        }
        None if *kind == "Torus" => "a torus has the `radius` of its ring, to the middle of the tube, and a \
                                     `tube_radius`"
            .to_owned(),
        None => format!("write `{way}`"),
    };
    // Which way a box is long nobody knows.
    let is_guess = *kind == "Box" && found.iter().any(|(key, _)| key.text() == "length");
    let edit = mended.filter(|_| !is_guess).and_then(|mended| in_place_of(&found, *item, mended));
    Some(Together { hint: Some(hint), edit, fields })
}

/// What is written in place of fields: at the first of them; what stands between them stays behind it.
pub(super) fn in_place_of(
    found: &[(Item<'_, '_>, Item<'_, '_>)],
    item: Item<'_, '_>,
    mut replacement: String,
) -> Option<Edit> {
    if let Some(span) = all_of(found, item) {
        return Some(Edit { span, replacement });
    }
    let mut spans: Vec<Span> = found.iter().map(|(key, value)| whole_field(*key, *value)).collect();
    spans.sort();
    let within = |at: u32| at.checked_sub(item.span().start).map(|at| at as usize);
    for pair in spans.windows(2) {
        // Tables under a header of TOML are not in one piece.
        let between = item.lexeme().get(within(pair[0].end)?..within(pair[1].start)?)?;
        let comment = if item.syntax() == Syntax::Toml { between.contains('#') } else { between.contains('/') };
        if comment || between.contains('[') && item.syntax() == Syntax::Toml {
            return None;
        }
        replacement += between.trim_end_matches([' ', ',', '\n', '\r', '\t']);
    }
    let (first, last) = (*spans.first()?, *spans.last()?);
    Some(Edit { span: Span { end: last.end, ..first }, replacement })
}

/// The place of fields that stand side by side, with nothing but commas and blanks between them.
fn all_of(found: &[(Item<'_, '_>, Item<'_, '_>)], item: Item<'_, '_>) -> Option<Span> {
    let mut spans: Vec<Span> = found.iter().map(|(key, value)| whole_field(*key, *value)).collect();
    spans.sort();
    let (first, last) = (*spans.first()?, *spans.last()?);
    let within = |at: u32| at.checked_sub(item.span().start).map(|at| at as usize);
    let joined = spans.windows(2).all(|pair| {
        let between = within(pair[0].end).zip(within(pair[1].start)).and_then(|(end, start)| {
            // Tables under a header of TOML are not in one piece.
            item.lexeme().get(end..start)
        });
        between.is_some_and(|between| between.bytes().all(|byte| matches!(byte, b' ' | b',' | b'\n' | b'\r' | b'\t')))
    });
    joined.then_some(Span { end: last.end, ..first })
}

fn bracketed(numbers: &[String], syntax: Syntax) -> String {
    match syntax {
        Syntax::Ron => format!("({})", numbers.join(", ")),
        _ => format!("[{}]", numbers.join(", ")),
    }
}

/// Lengths of sides.
fn size(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let sides: Vec<String> =
        values.iter().map(|value| value.number().map(|_| value.lexeme().to_owned())).collect::<Option<_>>()?;
    Some(format!("{}{}", Fields(syntax).name("size"), bracketed(&sides, syntax)))
}

/// What solids are made of.
fn objects(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let all: Vec<&str> = values.iter().map(|value| value.lexeme()).collect();
    Some(format!("{}[{}]", Fields(syntax).name("objects"), all.join(", ")))
}

/// The corners of a polygon.
fn points(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let all: Vec<&str> = values.iter().map(|value| point(value).map(|_| value.lexeme())).collect::<Option<_>>()?;
    Some(format!("{}[{}]", Fields(syntax).name("points"), all.join(", ")))
}

/// Two colours, whatever they are.
fn two_colors(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let [a, b] = values else { return None };
    let name = |field: &str| Fields(syntax).name(field);
    Some(format!("{}{}, {}{}", name("a"), a.lexeme(), name("b"), b.lexeme()))
}

/// Those of the two ends of a cone.
fn two_radii(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let [radius, tip] = values else { return None };
    let name = |field: &str| Fields(syntax).name(field);
    Some(format!("{}{}, {}{}", name("radius"), radius.lexeme(), name("tip_radius"), tip.lexeme()))
}

/// How often a texture lies along each side.
fn uv_scale(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let numbers: Vec<String> =
        values.iter().map(|value| value.number().map(|_| value.lexeme().to_owned())).collect::<Option<_>>()?;
    let scale = bracketed(&numbers, syntax);
    let mapping = match syntax {
        Syntax::Ron => format!("Uv(scale: {scale})"),
        syntax => syntax.of_toml(format!("{{ Uv = {{ scale = {scale} }} }}")).into_owned(),
    };
    Some(format!("{}{mapping}", Fields(syntax).name("mapping")))
}

/// Three numbers as they stand.
fn point(item: &Item<'_, '_>) -> Option<[f64; 3]> {
    let all: Vec<f64> = numbers(*item)?.iter().map(|number| decode::number(number)).collect();
    all.try_into().ok()
}

/// A reckoned number: what sums of decimal fractions leave over is not meant.
fn shown(value: f64) -> String {
    format!("{}", (value * 1e9).round() / 1e9 + 0.0)
}

/// Of a height.
fn at_height(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let [y] = values else { return None };
    let y = y.number().map(|_| y.lexeme().to_owned())?;
    Some(format!("{}{}", Fields(syntax).name("point"), bracketed(&["0".to_owned(), y, "0".to_owned()], syntax)))
}

/// A plane where x is a number.
fn across_x(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let x = values.first().and_then(|x| x.number().map(|_| x.lexeme()))?;
    let write =
        |field: &str, point: [&str; 3]| Fields(syntax).name(field) + &bracketed(&point.map(str::to_owned), syntax);
    Some(format!("{}, {}", write("point", [x, "0", "0"]), write("normal", ["1", "0", "0"])))
}

/// A plane where z is a number.
fn across_z(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let z = values.first().and_then(|z| z.number().map(|_| z.lexeme()))?;
    let write =
        |field: &str, point: [&str; 3]| Fields(syntax).name(field) + &bracketed(&point.map(str::to_owned), syntax);
    Some(format!("{}, {}", write("point", ["0", "0", z]), write("normal", ["0", "0", "1"])))
}

/// Two corners.
fn middle_and_sides(values: &[Item<'_, '_>], syntax: Syntax) -> Option<String> {
    let [low, high] = values else { return None };
    let (low, high) = (point(low)?, point(high)?);
    let middle: Vec<String> = low.iter().zip(&high).map(|(low, high)| shown((low + high) / 2.0)).collect();
    let sides: Vec<String> = low.iter().zip(&high).map(|(low, high)| shown((high - low).abs())).collect();
    let name = |field: &str| Fields(syntax).name(field);
    let (middle, sides) = (bracketed(&middle, syntax), bracketed(&sides, syntax));
    Some(format!("{}{middle}, {}{sides}", name("center"), name("size")))
}

fn unclear(_: &[Item<'_, '_>], _: Syntax) -> Option<String> {
    None
}
