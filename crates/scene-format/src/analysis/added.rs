//! What is written into a scene for a name that it lacks.

use crate::diagnostic::{Edit, Span};
use crate::print;
use crate::syntax::{Sink, Syntax, parse};
use crate::tree::{Item, Kind};

/// Where a material of this name is written into a scene, grey for a start: among its materials, or before its objects,
/// which come last in most scenes. `None`: there are neither, or the name is there.
pub fn material_to_add(text: &str, syntax: Syntax, name: &str) -> Option<Edit> {
    let tree = parse(text, syntax, &mut Sink::default());
    let field = |name: &str| tree.root()?.fields().find(|(key, _)| key.text() == name);
    let quoted = print::text(name, syntax);
    let entry = match syntax {
        Syntax::Ron => format!("{quoted}: Diffuse(albedo: 0.5)"),
        Syntax::Toml => format!("{} = {{ Diffuse = {{ albedo = 0.5 }} }}", print::toml_key(name)),
        Syntax::Json => format!("{quoted}: {{ \"Diffuse\": {{ \"albedo\": 0.5 }} }}"),
    };
    let (at, replacement) = match (field("materials"), field("objects")) {
        (Some((_, materials)), _) if materials.kind() == Kind::Map => {
            if materials.fields().any(|(key, _)| key.text() == name) {
                return None;
            }
            among(text, syntax, &materials, &entry)?
        }
        (None, Some((key, objects))) => before(text, syntax, &key, &objects, &entry),
        _ => return None,
    };
    let at = at as u32;
    Some(Edit { span: Span { source: 0, start: at, end: at }, replacement })
}

/// As the first of the materials that there are.
fn among(text: &str, syntax: Syntax, materials: &Item<'_, '_>, entry: &str) -> Option<(usize, String)> {
    let (start, lexeme) = (materials.span().start as usize, materials.lexeme());
    let first = materials.fields().next().map(|(key, _)| key.span().start as usize);
    if lexeme.starts_with('{') {
        let gap = first.map(|first| &text[start + 1..first]);
        let inserted = match gap.map(|gap| (gap, gap.rsplit_once('\n'))) {
            Some((_, Some((_, indent)))) => format!("\n{indent}{entry},"),
            Some((gap, None)) => format!(" {entry},{}", if gap.is_empty() { " " } else { "" }),
            None => format!(" {entry} "),
        };
        return Some((start + 1, inserted));
    }
    // `materials.red.Diffuse.albedo = 1` at the top.
    if syntax == Syntax::Toml && lexeme == "materials" {
        let line = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        return Some((line, format!("materials.{entry}\n")));
    }
    // A table of TOML with its header, or one that other headers imply.
    if lexeme.trim_matches(['[', ']', ' ', '\t']) == "materials" {
        return Some((start + lexeme.len(), format!("\n{entry}")));
    }
    let header = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
    (syntax == Syntax::Toml).then(|| (header, format!("[materials]\n{entry}\n\n")))
}

/// Before the objects.
fn before(text: &str, syntax: Syntax, key: &Item<'_, '_>, objects: &Item<'_, '_>, entry: &str) -> (usize, String) {
    let at = key.span().start as usize;
    let line = text[..at].rfind('\n').map_or(0, |newline| newline + 1);
    let alone = text[line..at].trim().is_empty();
    let gap = if alone { format!("\n{}", &text[line..at]) } else { " ".to_owned() };
    match syntax {
        Syntax::Ron => (at, format!("materials: {{ {entry} }},{gap}")),
        Syntax::Json => (at, format!("\"materials\": {{ {entry} }},{gap}")),
        // Above the line of the header.
        Syntax::Toml if objects.lexeme().starts_with("[[") => (line, format!("[materials]\n{entry}\n\n")),
        Syntax::Toml => (line, format!("materials = {{ {entry} }}\n")),
    }
}
