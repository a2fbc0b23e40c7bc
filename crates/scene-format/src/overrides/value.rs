//! What is said of a value of `--set` that cannot be read: it stands in no file, and in no scene; and how names are
//! written in its path.

use super::{Override, Step, What, end_of_path};
use crate::codes;
use crate::desc::Scene;
use crate::diagnostic::{Diagnostic, Edit, Severity, Span};
use crate::read::{is_picture, shortened};
use crate::schema::Type;
use crate::syntax::Sink;

/// Faults of a value, from this one on, in words for a whole scene, in those for one value.
pub(super) fn of_arguments(sink: &mut Sink, told: usize, argument: &str) {
    if let (Some(fault), Some((start, quoted))) = (sink.diagnostics.get_mut(told), whole_text(argument)) {
        let span = Span { start: start as u32, end: argument.trim_end().len() as u32, ..fault.span };
        fault.hint = format!("write {quoted}");
        fault.edit = Some(Edit { span, replacement: quoted });
        // The others are of the same text.
        let others = sink.diagnostics.drain(told + 1..);
        sink.errors -= others.filter(|fault| fault.severity == Severity::Error).count();
        return;
    }
    sink.diagnostics.iter_mut().skip(told).for_each(|fault| of_argument(fault, argument));
}

fn of_argument(fault: &mut Diagnostic, argument: &str) {
    match fault.code {
        codes::TEXT_AFTER_END => {
            fault.message = "the value ended before this".to_owned();
            fault.expected = "one value after `=`".to_owned();
            fault.hint =
                "remove what follows; several values stand in brackets, (1, 2, 3), and each has a --set of its \
                          own"
                .to_owned();
        }
        codes::BARE_EXPRESSION => {
            // A shell takes quotes away: an expression that is all of the value needs none.
            let written = fault.edit.as_ref().map(|edit| edit.replacement.clone());
            let Some(written) = written.or_else(|| fault.hint.strip_prefix("write ").map(str::to_owned)) else {
                return;
            };
            let (start, end) = (fault.span.start as usize, fault.span.end as usize);
            let Some((before, after)) = argument.get(..start).zip(argument.get(end..)) else { return };
            let whole = before.trim_end().ends_with('=') && after.trim().is_empty();
            let written = if whole { written.trim_matches('"') } else { &written };
            fault.hint = format!("write --set '{before}{written}{after}'");
        }
        codes::UNCLOSED_BRACKET => fault.hint = format!("write {} at its end", fault.expected),
        codes::BAD_NUMBER if let Some(size) = size_of(argument) => (fault.hint, fault.edit) = (size, None),
        codes::WORD_NOT_QUOTED if let Some(edit) = &mut fault.edit => {
            let (path, _) = argument.split_once('=').unwrap_or((argument, ""));
            if let Some(meant) = file_of(path.trim(), &edit.replacement) {
                fault.hint = format!("write {meant}");
                edit.replacement = meant;
            }
        }
        _ => {}
    }
}

/// A value of several words for a field that takes a text, `material=gold #2`: where it begins, and the whole of it
/// between quotes.
fn whole_text(argument: &str) -> Option<(usize, String)> {
    const OF_TEXTS: [&str; 5] = ["name", "group", "material", "camera", "placements"];
    let (path, value) = argument.split_at(end_of_path(argument)? + 1);
    let field = path.trim_end_matches('=').trim().rsplit('.').next()?;
    let start = argument.len() - value.trim_start().len();
    let value = value.trim();
    // What begins with a capital may be a kind that is not written right.
    let is_kind = value.starts_with(char::is_uppercase) && !matches!(field, "name" | "group");
    let is_text = value.starts_with(char::is_alphabetic) && value.contains(' ') && !is_kind;
    (is_text && OF_TEXTS.contains(&field)).then(|| (start, quoted(value)))
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// The name of a file between quotes. It may be any: it is a text however it is written, but for texts as RON has them.
pub(super) fn name_of_file(field: &str, value: &str) -> Option<String> {
    let is_name = value.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '.' | '/' | '~' | '_' | '#'));
    let is_call = value.find(|c: char| !c.is_alphanumeric()).is_some_and(|at| value[at..].starts_with('('));
    let is_raw = value.starts_with("r\"") || value.starts_with("r#");
    (field == "file" && is_name && !is_raw && !(is_call && value.ends_with(')'))).then(|| quoted(value))
}

/// What the name of a file, between its quotes, is for a field that takes more than that.
fn file_of(path: &str, quoted: &str) -> Option<String> {
    const OF_TEXTURES: [&str; 8] = ["albedo", "color", "reflectance", "transmittance", "a", "b", "specular", "input"];
    let field = path.rsplit('.').next().unwrap_or(path);
    let picture = is_picture(quoted.trim_matches('"'));
    match field {
        "include" => Some(format!("[{quoted}]")),
        "background" if picture => Some(format!("Environment(file: {quoted})")),
        _ if picture && (OF_TEXTURES.contains(&field) || path.starts_with("textures.")) => {
            Some(format!("Texture(file: {quoted})"))
        }
        _ => None,
    }
}

/// The option that says what an argument means by `image.size=160x100`.
pub(super) fn size_of(argument: &str) -> Option<String> {
    const PATHS: [&str; 5] = ["image", "image.size", "image.resolution", "size", "resolution"];
    let (_, value) = argument.split_once('=').filter(|(path, _)| PATHS.contains(&path.trim()))?;
    let value = value.trim().trim_matches(['(', ')', '[', ']', '"']);
    let sides: Vec<u32> =
        value.split(['x', 'X', ',']).map(|side| side.trim().parse()).collect::<Result<_, _>>().ok()?;
    let [width, height] = sides[..] else { return None };
    Some(format!("write --size {width}x{height}"))
}

/// Has faults in arguments of `--set` say the whole argument that is to be written, as a shell takes it: what it is
/// given without these quotes it takes apart, and quotes of the value go away.
pub(crate) fn as_arguments(faults: &mut [Diagnostic], overrides: &[Override]) {
    for fault in faults {
        let source = fault.span.source;
        let set = (source as usize).checked_sub(1).and_then(|index| overrides.get(index));
        let Some(set) = set.filter(|set| set.option == "--set") else { continue };
        let Some(way) = fault.hint.strip_prefix("write ").filter(|way| !way.starts_with("--")) else { continue };
        let (span, written, rest) = match &fault.edit {
            Some(Edit { span, replacement }) if span.source == source => {
                let bare = way.trim_start_matches('`');
                let rest = bare.strip_prefix(replacement.as_str()).map_or("", |rest| rest.trim_start_matches('`'));
                (*span, replacement.as_str(), rest)
            }
            None if let Some(written) = way.strip_suffix(", say") => (fault.span, written, ", say"),
            _ => continue,
        };
        let (start, end) = (span.start as usize, span.end as usize);
        let Some((before, after)) = set.argument.get(..start).zip(set.argument.get(end..)) else { continue };
        let whole = before.trim_end().ends_with('=') && after.trim().is_empty();
        // An expression that is all of the value needs no quotes of its own.
        let bare = written.strip_prefix("\"=").and_then(|inner| inner.strip_suffix('"')).filter(|_| whole);
        let written = bare.map_or_else(|| written.to_owned(), |inner| format!("={inner}"));
        let argument = format!("{before}{written}{after}").replace('\'', "'\\''");
        fault.hint = format!("write --set '{argument}'{rest}");
    }
}

/// How a list or map that the scene does not have is set.
pub(super) fn as_a_list(noun: &str) -> String {
    match Scene::DEF.fields.iter().find(|field| field.noun == noun).map(|field| field.name) {
        Some("lights") => {
            "set it as a whole: --set 'lights=[SphereLight(center: (0, 5, 0), radius: 0.1, power: 100)]'".to_owned()
        }
        Some("objects") => "set it as a whole: --set 'objects=[Sphere(center: (0, 0, 0), radius: 1)]'".to_owned(),
        _ => "set it as a whole".to_owned(),
    }
}

/// Where a name stands in the argument, with its quotes, without brackets around them: as it is written in a map.
pub(super) fn name(step: &Step<'_>) -> (usize, usize) {
    match step.what {
        What::Name(name) if step.end - step.start > name.len() + 2 => (step.start + 1, step.end - 1),
        _ => (step.start, step.end),
    }
}

/// A name as a step of a path: between quotes where it has more than letters, digits and strokes.
pub(super) fn step(name: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-');
    if !name.is_empty() && name.chars().all(is_plain) { name.to_owned() } else { format!("\"{name}\"") }
}

/// How an entry of a map of the scene is set that no file of the scene itself has.
pub(super) fn as_a_whole(noun: &str, name: &str, kind: Type) -> String {
    let map = Scene::DEF.fields.iter().find(|field| field.noun == noun).map_or("", |field| field.name);
    let value = kind.group().map_or("Diffuse", |def| def.name);
    match map {
        "cameras" | "materials" => format!("set it as a whole: '{map}.{name}={value}(..)'"),
        _ => "set it as a whole".to_owned(),
    }
}

/// What is to be set instead, where a `kind` is given by its name: the one of that name, by its path as a shell takes
/// it.
pub(super) fn instead(kind: &str, name: &str, rest: &str) -> String {
    let (step, rest) = (step(&shortened(name)), if rest.is_empty() { String::new() } else { format!(".{rest}") });
    let path = format!("{kind}s.{step}{rest}");
    let path = if step.starts_with('"') { format!("'{path}'") } else { path };
    format!("set the {kind} of that name: {path}")
}
