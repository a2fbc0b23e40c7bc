//! Values of RON in a file of TOML: how they are written there.

use super::{Sink, Syntax, constructs, is_toml_number, ron};
use crate::print;
use crate::tree::{Builder, Item, Kind, Text, Tree};
use std::path::Path;

/// Groups of the scene, which TOML writes without their names.
const GROUPS: [&str; 5] = ["Camera", "Image", "Render", "Effects", "Output"];

/// The length of the value of RON that a text begins with, `Name(..)` or `(..)`, over several lines if need be; `None`
/// where its bracket is not closed.
pub(super) fn length(rest: &str) -> Option<usize> {
    let open = rest.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))?;
    rest[open..].starts_with('(').then(|| constructs::closed(rest, open)).flatten()
}

/// A whole value of RON in TOML; `None` where it has comments, faults, or what there is no word for.
pub(super) fn in_toml(text: &str) -> Option<String> {
    let mut builder = Builder::new(0);
    let mut sink = Sink::default();
    ron::parse_from(text, 0, &mut builder, &mut sink);
    if sink.errors > 0 || text.contains("//") || text.contains("/*") {
        return None;
    }
    let texts = vec![Text { text, syntax: Syntax::Ron, folder: Path::new("") }];
    let tree = Tree { texts, nodes: builder.nodes, ..Tree::default() };
    value(tree.root()?)
}

fn value(item: Item<'_, '_>) -> Option<String> {
    let item = item.without_some();
    let list = || item.children().map(value).collect::<Option<Vec<String>>>();
    let fields = || {
        let fields: Option<Vec<String>> = item
            .fields()
            .map(|(key, inner)| Some(format!("{} = {}", print::toml_key(&key.text()), value(inner)?)))
            .collect();
        fields.map(|fields| if fields.is_empty() { "{}".to_owned() } else { format!("{{ {} }}", fields.join(", ")) })
    };
    let kind = |inner: String| match item.name() {
        Some(name) if !GROUPS.contains(&name) => format!("{{ {name} = {inner} }}"),
        _ => inner,
    };
    Some(match item.kind() {
        Kind::Bool => item.lexeme().to_owned(),
        Kind::Integer | Kind::Float if is_toml_number(item.lexeme()) => item.lexeme().to_owned(),
        Kind::Integer | Kind::Float => print::number(item.number()?),
        Kind::Text | Kind::Word => print::toml_text(&item.text()),
        Kind::List => format!("[{}]", list()?.join(", ")),
        Kind::Map => fields()?,
        Kind::Struct => kind(fields()?),
        Kind::Tuple if item.name().is_none() => format!("[{}]", list()?.join(", ")),
        Kind::Tuple => {
            let mut all = list()?;
            kind(match all.len() {
                0 => "{}".to_owned(),
                1 => all.swap_remove(0),
                _ => format!("[{}]", all.join(", ")),
            })
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_ron_are_written_in_toml() {
        for (ron, toml) in [
            ("Sphere(center: (0, .5, 0), radius: 1)", "{ Sphere = { center = [0, 0.5, 0], radius = 1 } }"),
            ("Camera(fov: 40)", "{ fov = 40 }"),
            ("(0, 1, 2)", "[0, 1, 2]"),
            ("Scale((1, 2, 1))", "{ Scale = [1, 2, 1] }"),
            ("Mirror()", "{ Mirror = {} }"),
            (
                "Mesh(file: \"a.obj\", shading: Smooth, transform: [Scale(2)])",
                "{ Mesh = { file = \"a.obj\", shading = \"Smooth\", transform = [{ Scale = 2 }] } }",
            ),
            ("(\n  fov: 40,\n)", "{ fov = 40 }"),
        ] {
            assert_eq!(length(ron), Some(ron.len()), "{ron}");
            assert_eq!(in_toml(ron).as_deref(), Some(toml), "{ron}");
        }
        assert_eq!(in_toml("Sphere(radius: 1 // one\n)"), None);
        assert_eq!(length("Sphere(radius: 1"), None);
    }
}
