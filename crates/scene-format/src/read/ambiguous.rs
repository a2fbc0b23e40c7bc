//! Fields of other programs that need more than another name: ends from a middle, a length and an axis, and those whose
//! value says two things, which are told and not mended.

use super::elsewhere::{self, Fields, numbers};
use super::shortened;
use super::together::{Together, in_place_of};
use super::unknown::Unknown;
use super::{LOOK_AT, is_expression};
use crate::syntax::{Syntax, decode};
use crate::tree::{Item, Kind};

const AXIS: &[&str] = &["axis", "direction", "dir", "normal", "orientation"];
const CENTER: &[&str] = &["center", "centre", "position", "pos", "location"];
const BASE: &[&str] = &["base", "base_center", "bottom", "start"];
const HEIGHT: &[&str] = &["height", "length", "h", "depth"];
const SIDES: &[&str] = &["width", "w", "height", "h", "depth", "length"];

/// What is said of such a field; `None`: it is another one.
pub(super) fn of(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let of_shape = plane(unknown).or_else(|| numbered(unknown)).or_else(|| ends(unknown)).or_else(|| across(unknown));
    of_shape
        .or_else(|| geometry(unknown))
        .or_else(|| listed(unknown))
        .or_else(|| corners(unknown))
        .or_else(|| corner(unknown))
        .or_else(|| across_view(unknown))
        .or_else(|| lasting(unknown))
        .or_else(|| scattered(unknown))
}

type Found<'t, 's> = (Item<'t, 's>, Item<'t, 's>);

/// A field of one of these names that is none of ours.
fn find<'t, 's>(unknown: &Unknown<'_, 't, 's>, names: &[&str]) -> Option<Found<'t, 's>> {
    let is_one = |(key, _): &Found<'t, 's>| names.contains(&&*key.text()) && unknown.def.field(&key.text()).is_none();
    unknown.item.fields().take(LOOK_AT).find(is_one)
}

fn is_written(unknown: &Unknown<'_, '_, '_>, field: &str) -> bool {
    unknown.item.fields().take(LOOK_AT).any(|(key, _)| key.text() == field)
}

/// Told at the first of several fields, and at the others not again.
fn told_at_first(
    unknown: &Unknown<'_, '_, '_>,
    found: &[Found<'_, '_>],
    fields: &[&'static str],
    told: impl FnOnce() -> (String, Option<String>),
) -> Together {
    let fields = fields.to_vec();
    // What is written in our way is told of nowhere.
    let is_theirs = |key: &Item<'_, '_>| unknown.def.field(&key.text()).is_none();
    if found.iter().any(|(key, _)| is_theirs(key) && key.span().start < unknown.key.span().start) {
        return Together { hint: None, edit: None, fields };
    }
    let (hint, mended) = told();
    let edit = mended.and_then(|mended| in_place_of(found, unknown.item, mended));
    Together { hint: Some(hint), edit, fields }
}

/// The sides of a plane, which has none.
fn plane(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { def, name, item, .. } = unknown;
    if def.name != "Plane" || !SIDES.contains(&name) {
        return None;
    }
    let found: Vec<Found<'_, '_>> = SIDES.iter().filter_map(|side| find(unknown, &[side])).collect();
    let sides: Vec<&str> =
        found.iter().filter(|(_, value)| value.number().is_some()).map(|(_, value)| value.lexeme()).collect();
    let (ron, toml) = match sides[..] {
        [a, b] => (format!("Rectangle(size: ({a}, {b}))"), format!("{{ Rectangle = {{ size = [{a}, {b}] }} }}")),
        [a] => (format!("Rectangle(size: {a})"), format!("{{ Rectangle = {{ size = {a} }} }}")),
        _ => return None,
    };
    let syntax = item.syntax();
    let rectangle = if syntax == Syntax::Ron { ron } else { syntax.of_toml(toml).into_owned() };
    Some(told_at_first(unknown, &found, &["point"], || {
        let mut hint = format!("a `Plane` has no end; what has one is a {rectangle}");
        if let ([y], "height" | "h") = (&sides[..], name) {
            let point = Fields(syntax).name("point") + &elsewhere::vector(item, &["0", y, "0"]);
            hint = format!("where it lies is said by a point of it: `{point}`");
        }
        (hint, None)
    }))
}

/// A coordinate or a length, which may be reckoned.
#[derive(Clone)]
enum Part {
    Number(f64),
    /// Without its sign.
    Expression(String),
}

impl Part {
    fn of(item: Item<'_, '_>) -> Option<Part> {
        if is_expression(item) {
            return Some(Part::Expression(item.text().trim_start_matches('=').trim().to_owned()));
        }
        item.number().map(Part::Number)
    }

    fn three(item: Item<'_, '_>) -> Option<[Part; 3]> {
        if item.name().is_some() {
            return None;
        }
        item.children().take(4).map(Part::of).collect::<Option<Vec<Part>>>()?.try_into().ok()
    }

    /// With a share of a length added, which is 1, or a half of either sign where it is reckoned.
    fn plus(&self, share: f64, length: &Part) -> Part {
        let length = match length {
            Part::Number(length) => match self {
                Part::Number(number) => return Part::Number(number + share * length),
                Part::Expression(_) => shown(share.abs() * length),
            },
            Part::Expression(body) if share == 1.0 => body.clone(),
            Part::Expression(body) if body.chars().all(|c| c.is_alphanumeric() || c == '_') => format!("{body}/2"),
            Part::Expression(body) => format!("({body})/2"),
        };
        let sign = if share < 0.0 { "-" } else { "+" };
        Part::Expression(match self {
            Part::Number(0.0) => format!("{}{length}", sign.trim_matches('+')),
            Part::Number(number) => format!("{}{sign}{length}", shown(*number)),
            Part::Expression(body) => format!("{body}{sign}{length}"),
        })
    }

    fn written(&self) -> String {
        match self {
            Part::Number(number) => shown(*number),
            Part::Expression(body) => format!("\"={body}\""),
        }
    }
}

/// A reckoned number: what sums of decimal fractions leave over is not meant.
fn shown(value: f64) -> String {
    format!("{}", (value * 1e9).round() / 1e9 + 0.0)
}

/// The way of one unit that an axis says: three numbers or a letter.
fn unit(item: Item<'_, '_>) -> Option<[f64; 3]> {
    let of_word = || match item.kind() {
        Kind::Word | Kind::Text | Kind::Char => elsewhere::axis(&item.text()),
        _ => None,
    };
    let axis: Vec<f64> = match numbers(item).filter(|numbers| item.name().is_none() && numbers.len() == 3) {
        Some(numbers) => numbers.iter().map(|number| decode::number(number)).collect(),
        None => of_word()?.iter().map(|number| decode::number(number)).collect(),
    };
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let axis: [f64; 3] = axis.try_into().ok()?;
    (length > 0.0 && length.is_finite()).then(|| axis.map(|x| x / length))
}

/// Two ends that are counted from 1, `p1` and `p2`; counted from 0 they are `p0` and `p1`.
fn numbered(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    const ENDS: [&[&str]; 2] = [&["p1", "point1", "end1", "v1"], &["p2", "point2", "end2", "v2"]];
    let &Unknown { def, name, item, .. } = unknown;
    let has_ends = def.field("from").and(def.field("to")).is_some();
    if !has_ends || !ENDS.iter().any(|names| names.contains(&name)) || find(unknown, &["p0"]).is_some() {
        return None;
    }
    let fields = &["from", "to"];
    let write = |field: &str, (_, value): &Found<'_, '_>| Fields(item.syntax()).name(field) + value.lexeme();
    let found: Vec<Found<'_, '_>> = ENDS.iter().filter_map(|names| find(unknown, names)).collect();
    let free: Vec<&str> = fields.iter().copied().filter(|field| !is_written(unknown, field)).collect();
    match (&found[..], &free[..]) {
        ([first, last], [from, to]) => Some(told_at_first(unknown, &found, fields, || {
            let mended = format!("{}, {}", write(from, first), write(to, last));
            (format!("write `{}`", super::hinted(&mended)), Some(mended))
        })),
        ([only], [other]) => Some(told_at_first(unknown, &found, fields, || {
            let mended = write(other, only);
            (format!("write `{}`", super::hinted(&mended)), Some(mended))
        })),
        ([only], [from, to]) => {
            let hint = format!("which end is it: `{}` or `{}`?", write(from, only), write(to, only));
            Some(Together { hint: Some(hint), edit: None, fields: fields.to_vec() })
        }
        _ => None,
    }
}

/// `from` and `to` of what is said by a middle or an end, a length and maybe an axis.
fn ends(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { def, name, item, .. } = unknown;
    let of_these = [AXIS, CENTER, BASE, HEIGHT].iter().any(|names| names.contains(&name));
    if !matches!(def.name, "Cylinder" | "Cone" | "Capsule") || !of_these {
        return None;
    }
    let (axis, height) = (find(unknown, AXIS), find(unknown, HEIGHT));
    let (center, base) = (find(unknown, CENTER), find(unknown, BASE));
    let way = match item.syntax() {
        Syntax::Ron => "`from: (x, y, z), to: (x, y, z)`".into(),
        syntax => syntax.of_toml("`from = [x, y, z], to = [x, y, z]`"),
    };
    let Some((_, length)) = height else {
        let told = AXIS.contains(&name).then(|| format!("its axis goes from one end to the other: {way}"));
        return told.map(|hint| Together { hint: Some(hint), edit: None, fields: Vec::new() });
    };
    let start = item.fields().take(LOOK_AT).find(|(key, _)| key.text() == "from");
    let found: Vec<Found<'_, '_>> = [axis, height, center, base, start].into_iter().flatten().collect();
    let one_place = [center.is_some(), base.is_some(), start.is_some()].iter().filter(|is| **is).count() < 2;
    if !one_place || is_written(unknown, "to") {
        return None;
    }
    let about = center.is_some();
    let place = center.or(base).or(start).map(|(_, value)| value);
    let place = place.map_or(Some([0.0; 3].map(Part::Number)), Part::three);
    let along = axis.map_or(Some([0.0, 1.0, 0.0]), |(_, axis)| unit(axis));
    let reckoned = place.zip(along).zip(Part::of(length)).filter(|((_, along), length)| {
        // Lengths that are reckoned are not taken apart.
        matches!(length, Part::Number(_)) || along.iter().all(|share| matches!(share, 0.0 | 1.0))
    });
    let fields = &["from", "to"];
    let Some(((place, along), length)) = reckoned else {
        return Some(told_at_first(unknown, &found, fields, || (format!("write {way}"), None)));
    };
    let end = |share: f64, by: &Part| -> [Part; 3] {
        std::array::from_fn(|k| match along[k] {
            part if part * share == 0.0 => place[k].clone(),
            part => place[k].plus(share * part, by),
        })
    };
    let written = |begin: f64, last: f64, by: &Part| {
        let point = |name: &str, share: f64| {
            let point = end(share, by).map(|part| part.written());
            Fields(item.syntax()).name(name) + &elsewhere::vector(item, &point.each_ref().map(|part| &**part))
        };
        format!("{}, {}", point("from", begin), point("to", last))
    };
    let (begin, last) = if about { (-0.5, 0.5) } else { (0.0, 1.0) };
    let mended = written(begin, last, &length);
    Some(told_at_first(unknown, &found, fields, || match def.name {
        "Capsule" => (of_capsule(unknown, &length, &mended, |inner| written(begin, last, inner)), None),
        _ => (format!("write `{}`", super::hinted(&mended)), Some(mended)),
    }))
}

/// The height of a capsule may be with its round ends or without them.
fn of_capsule(
    unknown: &Unknown<'_, '_, '_>,
    length: &Part,
    between: &str,
    written: impl Fn(&Part) -> String,
) -> String {
    let radius = unknown.item.fields().take(LOOK_AT).find(|(key, _)| key.text() == "radius");
    let whole = match (radius.and_then(|(_, radius)| radius.number()), length) {
        (Some(radius), Part::Number(length)) if *length > 2.0 * radius => Some(length - 2.0 * radius),
        _ => None,
    };
    let ends = "round ends reach its `radius` further than `from` and `to`";
    match whole {
        // Between points that lie a radius further inside on both sides.
        Some(inner) if find(unknown, CENTER).is_some() => {
            let within = written(&Part::Number(inner));
            format!("{ends}: write `{between}`, or, where its whole length is meant, `{within}`")
        }
        _ => format!("{ends}: write `{between}`, or points a `radius` nearer where its whole length is meant"),
    }
}

/// A size where a radius is due, which is half of it where that is from side to side.
fn across(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    const ROUND: [&str; 8] = ["Sphere", "Disk", "SphereLight", "Torus", "Cylinder", "Cone", "Capsule", "Ring"];
    let &Unknown { def, name, value, item, .. } = unknown;
    let is_size = name == "size" && ROUND.contains(&def.name)
        || matches!(name, "thickness" | "width" | "size") && matches!(def.name, "Tube" | "Arrow")
        || name == "thickness" && def.name == "Torus";
    let radius = if name == "thickness" && def.name == "Torus" { "tube_radius" } else { "radius" };
    if !is_size || is_written(unknown, radius) {
        return None;
    }
    let write = |field: &str, value: &str| format!("{}{value}", Fields(item.syntax()).name(field));
    let hint = if let Some(three) = numbers(value).filter(|three| three.len() == 3 && def.name == "Sphere") {
        let scale = elsewhere::vector(item, &three);
        let scaled = match item.syntax() {
            Syntax::Ron => format!("[Scale({scale})]"),
            syntax => syntax.of_toml(format!("[{{ Scale = {scale} }}]")).into_owned(),
        };
        let mended = format!("{}, {}", write("radius", "0.5"), write("transform", &scaled));
        format!("a ball with three sizes from side to side is an ellipsoid: write `{mended}`")
    } else {
        let half = Part::Number(0.0).plus(0.5, &Part::of(value)?);
        let half = write(radius, &half.written());
        format!("the `{radius}` is half of the size from side to side: write `{half}`")
    };
    Some(Together { hint: Some(hint), edit: None, fields: vec![radius] })
}

/// The shape of a mesh of three.js.
fn geometry(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { def, name, .. } = unknown;
    let hint =
        "a shape is a kind of its own, Sphere, Box or Cylinder, with its fields: there is no `geometry` around it";
    let is_shape = def.field("material").is_some() && matches!(name, "geometry" | "geometries");
    is_shape.then(|| Together { hint: Some(hint.to_owned()), edit: None, fields: def.exactly_one.to_vec() })
}

/// A rectangle by two corners opposite, which lie in a plane along two axes.
fn corners(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    const ENDS: [&[&str]; 2] =
        [&["min", "minimum", "lower", "corner1", "p1", "from"], &["max", "maximum", "upper", "corner2", "p2", "to"]];
    let &Unknown { def, name, item, .. } = unknown;
    if def.name != "Rectangle" || !ENDS.iter().any(|names| names.contains(&name)) {
        return None;
    }
    let (low, high) = (find(unknown, ENDS[0])?, find(unknown, ENDS[1])?);
    let point = |(_, value): Found<'_, '_>| -> Option<[f64; 3]> {
        let numbers: Vec<f64> = numbers(value)?.iter().map(|number| decode::number(number)).collect();
        numbers.try_into().ok()
    };
    let flat = |(low, high): ([f64; 3], [f64; 3])| {
        let axis = (0..3).find(|&k| low[k] == high[k])?;
        // Along s and t of a face to that axis.
        let (s, t) = [(2, 1), (0, 2), (0, 1)][axis];
        let three = |number: &dyn Fn(usize) -> f64| {
            let all = [0, 1, 2].map(|k| shown(number(k)));
            elsewhere::vector(item, &all.each_ref().map(|number| &**number))
        };
        let write = |field: &str, value: String| Fields(item.syntax()).name(field) + &value;
        let sides = [s, t].map(|k| shown((high[k] - low[k]).abs()));
        let center = write("center", three(&|k| (low[k] + high[k]) / 2.0));
        let normal = write("normal", three(&|k| f64::from(u8::from(k == axis))));
        let size = write("size", elsewhere::vector(item, &sides.each_ref().map(|side| &**side)));
        Some(format!("{center}, {normal}, {size}"))
    };
    let mended = point(low).zip(point(high)).and_then(flat);
    let fields = ["center", "normal", "size"];
    Some(told_at_first(unknown, &[low, high], &fields, || match mended {
        Some(mended) => (format!("write `{mended}`, or the `normal` the other way round"), None),
        None => ("what is flat has a `center`, a `normal` and two numbers as its `size`".to_owned(), None),
    }))
}

/// A box by its least corner and its sides.
fn corner(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    const LEAST: &[&str] = &["corner", "min_corner", "lower_corner", "min"];
    let &Unknown { def, name, item, .. } = unknown;
    const MOST: &[&str] = &["max", "max_corner", "upper_corner", "upper", "maximum", "corner1", "corner2"];
    let both = find(unknown, MOST).is_some();
    if def.name != "Box" || !LEAST.contains(&name) || both || is_written(unknown, "center") {
        return None;
    }
    let found = find(unknown, LEAST)?;
    let size = item.fields().take(LOOK_AT).find(|(key, _)| key.text() == "size").map(|(_, size)| size);
    let point = |value: Item<'_, '_>| -> Option<[f64; 3]> {
        let all: Vec<f64> = numbers(value)?.iter().map(|number| decode::number(number)).collect();
        all.try_into().ok().filter(|_| value.name().is_none())
    };
    let sides = size.and_then(|size| size.number().map(|side| [side; 3]).or_else(|| point(size)));
    let (mended, way) = match point(found.1).zip(sides) {
        Some((least, sides)) => {
            let middle = [0, 1, 2].map(|k| shown(least[k] + sides[k] / 2.0));
            let middle = elsewhere::vector(item, &middle.each_ref().map(|number| &**number));
            let mended = Fields(item.syntax()).name("center") + &middle;
            (Some(mended.clone()), format!("write `{mended}`, half of its `size` beyond that corner"))
        }
        None => (None, "a box lies about its `center`, half of its `size` beyond its least corner".to_owned()),
    };
    Some(told_at_first(unknown, &[found], &["center"], || (way, mended)))
}

/// How wide a view of parallel rays is: its height, by the shape of the picture.
fn across_view(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { def, name, value, item, .. } = unknown;
    if def.name != "Orthographic" || !matches!(name, "width" | "w") || is_written(unknown, "height") {
        return None;
    }
    let image = item.other(0)?.fields().take(LOOK_AT).find(|(key, _)| key.text() == "image").map(|(_, image)| image);
    let side = |side: &str| match image {
        Some(image) => match image.fields().find(|(key, _)| key.text() == side) {
            Some((_, value)) => value.number(),
            None => Some(512.0),
        },
        None => Some(512.0),
    };
    let sides = side("width").zip(side("height")).filter(|(wide, high)| *wide >= 1.0 && *high >= 1.0);
    let reckoned = value.number().zip(sides).map(|(width, (wide, high))| {
        let height = shown((width * high / wide * 1e6).round() / 1e6);
        (Fields(item.syntax()).name("height") + &height, format!("{wide}x{high}"))
    });
    let is_height = "how much it shows is said by its `height`, which is the width times the picture's height over its \
                     width";
    Some(match reckoned {
        Some((mended, size)) => told_at_first(unknown, &[(unknown.key, value)], &["height"], || {
            (format!("write `{mended}`: in a picture of {size} pixels that is {} across", value.lexeme()), Some(mended))
        }),
        None => Together { hint: Some(is_height.to_owned()), edit: None, fields: vec!["height"] },
    })
}

/// From when to when a film goes.
fn lasting(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    const BEGIN: &[&str] = &["start", "begin", "from", "first", "start_time"];
    const END: &[&str] = &["end", "to", "last", "stop", "end_time"];
    let &Unknown { def, name, item, .. } = unknown;
    if def.name != "Animation" || !BEGIN.contains(&name) && !END.contains(&name) {
        return None;
    }
    if is_written(unknown, "frames") {
        let found: Vec<Found<'_, '_>> = [BEGIN, END].iter().filter_map(|names| find(unknown, names)).collect();
        let hint = "how long it is is said by `frames`, from 0 on: leave it out; which are rendered is said on the \
                    command line: --frames 0-47";
        return Some(told_at_first(unknown, &found, &["frames"], || (hint.to_owned(), None)));
    }
    let (begin, end) = (find(unknown, BEGIN), find(unknown, END)?);
    let from = begin.map_or(Some(0.0), |(_, value)| value.number())?;
    let to = end.1.number().filter(|to| *to > from)?;
    let fps = item.fields().take(LOOK_AT).find(|(key, _)| key.text() == "fps");
    let fps = fps.map_or(Some(24.0), |(_, fps)| fps.number())?;
    let frames = |count: f64| format!("`{}{}`", Fields(item.syntax()).name("frames"), shown(count.round().max(1.0)));
    let found: Vec<Found<'_, '_>> = [begin, Some(end)].into_iter().flatten().collect();
    let seconds = shown(to - from);
    let hint = format!(
        "a film begins at 0: {seconds} seconds with {} frames in each are {}; if these are frames, write {}",
        shown(fps),
        frames((to - from) * fps),
        frames(to - from + 1.0)
    );
    Some(told_at_first(unknown, &found, &["frames"], || (hint, None)))
}

/// Where copies are scattered.
fn scattered(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { def, name, value, item, .. } = unknown;
    let of_place =
        matches!(name, "on" | "over" | "surface" | "radius" | "size" | "extent" | "width" | "area" | "within");
    if def.name != "Scatter" || !of_place || is_written(unknown, "min") {
        return None;
    }
    let far = value.number().map(|far| if name == "radius" { far } else { far / 2.0 }).filter(|far| *far > 0.0);
    let far = far.unwrap_or(5.0);
    let corner = |field: &str, far: f64| {
        let far = shown(far);
        Fields(item.syntax()).name(field) + &elsewhere::vector(item, &[&far, "0", &far])
    };
    let hint = format!(
        "copies lie in the box between two corners, which may be flat: `{}, {}`",
        corner("min", -far),
        corner("max", far)
    );
    Some(Together { hint: Some(hint), edit: None, fields: vec!["min", "max"] })
}

/// A repetition over values or over a range.
fn listed(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { def, name, item, .. } = unknown;
    if def.name != "Repeat" {
        return None;
    }
    if let Some(told) = over_values(unknown) {
        return Some(told);
    }
    if name == "for" && !is_written(unknown, "count") {
        let often = if unknown.value.number().is_some() { unknown.value.lexeme() } else { "8" };
        let hint = format!("how often it goes is `{}{often}`", Fields(item.syntax()).name("count"));
        return Some(Together { hint: Some(hint), edit: None, fields: vec!["count"] });
    }
    if !matches!(name, "from" | "to" | "start" | "end" | "first" | "last" | "step" | "by" | "range" | "min" | "max") {
        return None;
    }
    let hint =
        "it counts from 0, `count` times: from 1 to 8 in steps of 1 is a `count` of 8 with \"=1+i\" in its items";
    let told = |(key, _): &Found<'_, '_>| matches!(&*key.text(), "from" | "start" | "first" | "range" | "min");
    let found: Vec<Found<'_, '_>> = item.fields().take(LOOK_AT).filter(told).collect();
    Some(told_at_first(unknown, &found, &["count"], || (hint.to_owned(), None)))
}

/// What a list to go through is called elsewhere.
const LISTS: &[&str] = &[
    "values", "over", "in", "each", "array", "list", "for_each", "foreach", "iterate", "iterable", "data", "of",
    "sequence",
];
/// What the item of such a list is called by.
const CALLED: &[&str] = &["as", "for", "var", "variable", "item", "name", "let", "each_as", "element"];

/// A repetition over the items of a list: how often, and the item by its name.
fn over_values(unknown: &Unknown<'_, '_, '_>) -> Option<Together> {
    let &Unknown { name, item, .. } = unknown;
    let list = find(unknown, LISTS).or_else(|| find(unknown, &["for"]))?;
    let is_list = |(_, value): &Found<'_, '_>| value.kind() == Kind::List || body_of(*value).is_some();
    // `Repeat(count: 3, list: [Sphere(..)])` is another word for its items.
    let of_items = list.0.text() == "list" && !is_written(unknown, "items");
    if !LISTS.contains(&name) && !CALLED.contains(&name) || of_items || !is_list(&list) {
        return None;
    }
    let text_of = |(_, value): &Found<'_, '_>| matches!(value.kind(), Kind::Text | Kind::Word | Kind::Char);
    let called = find(unknown, CALLED).filter(|(key, _)| key.index() != list.0.index()).filter(text_of);
    let index = item.fields().take(LOOK_AT).find(|(key, _)| key.text() == "index").filter(text_of);
    // Without another name for the item the index is meant as one, where values themselves are written.
    let of_index = index.filter(|_| called.is_none() && list.1.kind() == Kind::List);
    let word = called.or(of_index).map_or("v".into(), |(_, word)| word.text());
    let counts = index.filter(|_| of_index.is_none()).map_or("i".into(), |(_, word)| word.text());
    let syntax = item.syntax();
    let write = |field: &str, value: &str| format!("{}{value}", Fields(syntax).name(field));
    let with = |count: &str, ron: &str, toml: &str| {
        let (inner, braced) = match syntax {
            Syntax::Ron => (format!("\"{word}\": {ron}"), format!("{{ \"{word}\": {ron} }}")),
            syntax => {
                let inner = syntax.of_toml(format!("{word} = {toml}")).into_owned();
                (inner, syntax.of_toml(format!("{{ {word} = {toml} }}")).into_owned())
            }
        };
        match (is_written(unknown, "count"), is_written(unknown, "vars")) {
            (false, false) => format!("{}, {}", write("count", count), write("vars", &braced)),
            (true, false) => write("vars", &braced),
            (false, true) => format!("{}`, and into its `vars` `{inner}", write("count", count)),
            (true, true) => inner,
        }
    };
    let way = |lexeme: &str| match body_of(list.1) {
        Some(body) => {
            let each = format!("\"={body}[{counts}]\"");
            with(&format!("\"=len({body})\""), &each, &each)
        }
        None => {
            let count = list.1.children().count().to_string();
            let ron = format!("Pick(from: {lexeme}, index: \"={counts}\")");
            with(&count, &ron, &format!("{{ Pick = {{ from = {lexeme}, index = \"={counts}\" }} }}"))
        }
    };
    let found: Vec<Found<'_, '_>> = [Some(list), called].into_iter().flatten().collect();
    let free = !is_written(unknown, "count") && !is_written(unknown, "vars");
    Some(told_at_first(unknown, &found, &["count", "vars"], || {
        let more = match (of_index, called) {
            (Some(_), _) => ", and no `index`".to_owned(),
            (_, None) => format!(": in its items \"={word}\" is one of them"),
            _ => String::new(),
        };
        let hint = format!("write `{}`{more}", way(&shortened(list.1.lexeme())));
        // What the items within call it is known where it has a name.
        (hint, (free && called.is_some()).then(|| way(list.1.lexeme())))
    }))
}

/// The name of a list of `vars` that stands for a list, with its sign or without.
fn body_of(value: Item<'_, '_>) -> Option<String> {
    let text = value.text();
    let name = match value.kind() {
        Kind::Text => text.trim().trim_start_matches('=').trim(),
        Kind::Word => &text,
        _ => return None,
    };
    crate::expression::is_name(name).then(|| name.to_owned())
}
