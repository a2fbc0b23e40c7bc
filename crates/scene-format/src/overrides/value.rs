//! What is said of a value of `--set` that cannot be read: it stands in no file, and in no scene; and how names are
//! written in its path.

use super::{Step, What};
use crate::codes;
use crate::desc::Scene;
use crate::diagnostic::Diagnostic;
use crate::read::shortened;
use crate::schema::Type;

/// A fault of a value, in words for a whole scene, in those for one value.
pub(super) fn of_argument(fault: &mut Diagnostic, argument: &str) {
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
        _ => {}
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
