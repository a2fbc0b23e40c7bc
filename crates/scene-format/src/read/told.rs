//! Values and names in words, for messages.

use super::{is_picture, names};
use crate::desc::{Material, Object, SphereLight};
use crate::schema::StructDef;
use crate::suggest;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};

/// A value in words, for "cannot be ..".
pub(crate) fn describe(item: Item<'_, '_>) -> String {
    match item.kind() {
        Kind::Bool => format!("`{}`", item.lexeme()),
        Kind::Integer | Kind::Float => format!("the number {}", shortened(item.lexeme())),
        Kind::Text => format!("the text {}", shortened(item.lexeme())),
        Kind::Char => "a single character".to_owned(),
        Kind::Date => "a date or time".to_owned(),
        Kind::Word if item.is_null() => "null".to_owned(),
        Kind::Word => format!("the word `{}`", shortened(item.lexeme())),
        Kind::Key => "a name".to_owned(),
        Kind::List => match item.children().count() {
            0 => "an empty list".to_owned(),
            1 => "a list of one item".to_owned(),
            count => format!("a list of {count} items"),
        },
        Kind::Tuple | Kind::Struct if item.name().is_some() => {
            format!("`{}(..)`", shortened(item.name().unwrap_or_default()))
        }
        Kind::Tuple => match item.children().count() {
            0 => "an empty pair of brackets".to_owned(),
            1 => "one value in brackets".to_owned(),
            count => format!("{count} values in brackets"),
        },
        Kind::Struct => "a group of fields".to_owned(),
        Kind::Map if item.syntax() == Syntax::Json => "an object of fields".to_owned(),
        Kind::Map => "a table of fields".to_owned(),
        // The rest is syntax that readers do not see.
        _ => "this".to_owned(),
    }
}

/// What is said of a value that other programs write where another stands here.
pub(super) fn of_value(item: Item<'_, '_>, noun: &str) -> Option<String> {
    const KEYS: [&str; 8] =
        ["keyframes", "keyframe", "keys", "animated", "animate", "animation", "track", "animationtrack"];
    let name = item.name().map(str::to_ascii_lowercase);
    if name.is_some_and(|name| KEYS.contains(&&*name)) {
        let values = if noun.contains("center") || noun.contains("position") || noun.contains("point") {
            ["(0, 0, 0)", "(1, 0, 0)"]
        } else {
            ["1", "2"]
        };
        let [first, last] = values;
        return Some(format!(
            "what changes stands in an expression, each time with its value: \"=keyframes(time, 0, {first}, 1, \
             {last})\""
        ));
    }
    let picture =
        (noun == "the image" && item.kind() == Kind::Text).then(|| item.text()).filter(|name| is_picture(name));
    picture.map(|name| {
        format!("where it is written is said on the command line: tracer render scene.ron -o {}", shortened(&name))
    })
}

/// So many characters of something long are shown.
pub(super) const SHOWN: usize = 40;

/// The first characters of something that may be long.
pub(crate) fn shortened(text: &str) -> String {
    first(text, SHOWN)
}

/// What is to be written instead: it can only be followed where it is whole.
pub(crate) fn hinted(text: &str) -> String {
    first(text, 3 * SHOWN)
}

fn first(text: &str, most: usize) -> String {
    let line = text.lines().next().unwrap_or("");
    if line.len() == text.len() && line.chars().count() <= most {
        return line.to_owned();
    }
    let head: String = line.chars().take(most - 2).collect();
    format!("{head}..")
}

/// ``the `focus_distance` of a thin lens``: names that are no words are set off.
pub(crate) fn plain(noun: &str) -> String {
    let off = |k: usize, word: &str| word.contains('_') || k == 1 && matches!(word, "from" | "to");
    let word = |(k, word): (usize, &str)| if off(k, word) { format!("`{word}`") } else { word.to_owned() };
    noun.split(' ').enumerate().map(word).collect::<Vec<String>>().join(" ")
}

/// `this sphere` from `a sphere`; `the camera` stays.
pub(super) fn article_free(noun: &str) -> String {
    match noun.split_once(' ') {
        Some(("a" | "an", rest)) => format!("this {rest}"),
        _ => noun.to_owned(),
    }
}

/// All fields, for what was expected.
pub(super) fn field_list(def: &'static StructDef) -> String {
    let names: Vec<&str> = names(def).collect();
    match names.as_slice() {
        [only] => format!("the field `{only}`"),
        names => format!("one of {}", suggest::list(names)),
    }
}

/// `center: .., radius: ..`: the fields that must be written, or the first one.
pub(super) fn field_words(def: &'static StructDef) -> String {
    if def.name == "Scene" {
        return "objects: [..]".to_owned();
    }
    let mut words: Vec<String> =
        def.fields.iter().filter(|field| field.default.is_none()).map(|field| format!("{}: ..", field.name)).collect();
    if words.is_empty() {
        words.extend(def.fields.first().map(|field| format!("{}: ..", field.name)));
    }
    words.join(", ")
}

/// How one of the fields of which there must be one is added: as in the example of the kind.
pub(super) fn one_of(def: &StructDef, syntax: Syntax) -> String {
    let told = Material::TOLD.iter().chain(Object::TOLD).map(|(kind, _, example)| (*kind, *example));
    let example = told.chain([SphereLight::TOLD]).find(|(kind, _)| *kind == def.name);
    match (example, syntax) {
        (Some((_, example)), Syntax::Ron) => format!("add one, as in {example}"),
        (_, Syntax::Ron) => format!("add `{}: ..`", def.exactly_one[0]),
        _ => syntax.of_toml(format!("add `{} = ..`", def.exactly_one[0])).into_owned(),
    }
}
