//! Values without names where fields stand, and what has no fields: what is to be written.

use super::{Reader, field_list, field_words, hinted, shortened};
use crate::codes;
use crate::desc::{Material, Object, PlacementPattern, Scene, TransformWords};
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::schema::{self, StructDef};
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};

/// The field that a value must be of, and both as they are written.
pub(crate) fn field_of(value: &str) -> Option<(&'static str, String)> {
    let kind = value.split(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).next()?;
    if !value[kind.len()..].trim_start().starts_with('(') {
        return None;
    }
    let field = match kind {
        _ if Material::DEF.variant(kind).is_some() => return Some(("material", format!("material: {value}"))),
        _ if TransformWords::DEF.variant(kind).is_some() => "transform",
        _ if PlacementPattern::DEF.variant(kind).is_some() => {
            return Some(("placements", format!("placements: {value}")));
        }
        _ => {
            let group =
                Scene::DEF.fields.iter().find(|field| field.kind.group().is_some_and(|def| def.name == kind))?;
            return Some((group.name, format!("{}: {value}", group.name)));
        }
    };
    Some((field, format!("{field}: [{value}]")))
}

impl Reader<'_> {
    /// Reports that the values of `item` have no names.
    pub(super) fn without_names<T>(&mut self, item: Item<'_, '_>, def: &'static StructDef) -> Option<T> {
        let values: Vec<Item<'_, '_>> = item.solid_children().take(20).collect();
        let (first, last) = (*values.first()?, *values.last()?);
        let message = format!("the values of {} are written with their names", def.noun);
        let mut fault = Diagnostic::error(codes::MISSING_NAME, first.head(), message).expected(field_list(def));
        let whole = Span { end: last.span().end, ..first.span() };
        if let Some(rows) = super::elsewhere::matrix_rows(first).filter(|_| values.len() == 1 && def.name == "Matrix") {
            fault.hint =
                "four numbers are a row, and there are three: `rows: ((1, 0, 0, x), (0, 1, 0, y), (0, 0, 1, z))`"
                    .to_owned();
            fault.edit = Some(Edit { span: first.span(), replacement: rows });
        } else if def.name == "Scale" && values.len() == 2 && values.iter().all(|value| value.number().is_some()) {
            let [x, y] = [first, last].map(|value| value.lexeme());
            fault.hint = match item.syntax() {
                Syntax::Ron => format!("three factors stand in brackets: `Scale(({x}, {y}, 1))`"),
                _ => format!("three factors stand in brackets: `[{x}, {y}, 1]`"),
            };
        } else if let Some(mended) = named(&values, def).filter(|_| def.name != "Pick") {
            // With its kind, where that is on the same line.
            let kind = item.name().filter(|name| *name == def.name && values.len() == 1);
            fault.hint = match kind {
                Some(kind) => format!("write `{}`", hinted(&format!("{kind}({mended})"))),
                None => format!("write `{}`", hinted(&mended)),
            };
            // Which of them is meant nobody knows.
            if def.name == "FitTo" {
                fault.hint += ", or `width`, `depth` or `size` as it is meant";
            } else {
                fault.edit = Some(Edit { span: whole, replacement: mended });
            }
        } else if def.name == "Pick" && values.len() == 1 {
            let index = match self.indices.last() {
                Some((index, _)) => format!("\"={index}\""),
                None => "0".to_owned(),
            };
            fault.hint = format!("write `Pick(from: {}, index: {index})`", shortened(first.lexeme()));
        } else if let ([only], Some(color)) = (def.fields, self.color(first))
            && only.kind.is_texture()
            && values.len() == 1
        {
            let mended = format!("{}: {color}", only.name);
            fault.hint = format!("write `{}({mended})`", def.name);
            fault.edit = Some(Edit { span: whole, replacement: mended });
        } else if let [only] = def.fields {
            let is_plain = matches!(first.kind(), Kind::Text | Kind::Integer | Kind::Float) && values.len() == 1;
            fault.hint = format!("write `{}: {}`", only.name, if is_plain { first.lexeme() } else { "value" });
        } else {
            fault.hint = format!("write the name of each: {}", field_words(def));
        }
        self.report(fault);
        None
    }

    /// Reports what stands in place of a struct and can have no fields.
    pub(super) fn not_a_struct<T>(&mut self, item: Item<'_, '_>, def: &'static StructDef) -> Option<T> {
        let end = item.span().end as usize;
        // `include: ..` before the scene is told of by itself.
        let is_field = || item.text_between(end, end + 1).is_none_or(|next| next == ":" || next == "=");
        if def.name == Scene::DEF.name
            && (matches!(item.kind(), Kind::Integer | Kind::Float) || item.kind() == Kind::Word && !is_field())
        {
            return self.no_scene(item);
        }
        let header = item.kind() == Kind::List && item.lexeme().starts_with("[[");
        let header_edit = || header.then(|| item.lexeme().replace("[[", "[").replace("]]", "]"));
        // Nothing, for a thing that needs no field.
        let is_bare = item.is_null() && def.fields.iter().all(|field| field.default.is_some());
        let edit = header_edit().or_else(|| is_bare.then(|| "{}".to_owned())).or_else(|| first_alone(item, def));
        let expected = match item.syntax() {
            _ if header => "a table".to_owned(),
            Syntax::Ron => format!("{}({})", def.name, field_words(def)),
            syntax => {
                let words = format!("{{ {} }}", field_words(def).replace(": ", " = "));
                syntax.of_toml(words).into_owned()
            }
        };
        self.wrong_kind(item, def.noun, &expected, edit)
    }
}

impl Reader<'_> {
    /// A file that begins with a number or a word, as tables and meshes do: what follows is none of a scene either.
    fn no_scene<T>(&mut self, item: Item<'_, '_>) -> Option<T> {
        let before = self.sink.diagnostics.len();
        self.sink.diagnostics.retain(|fault| fault.code != codes::TEXT_AFTER_END);
        self.sink.errors -= before - self.sink.diagnostics.len();
        let message = format!("this is no scene: it begins with {}", super::describe(item));
        self.report(Diagnostic::error(codes::WRONG_TYPE, item.head(), message).expected("Scene(objects: [..])").hint(
            "a scene is RON, TOML or JSON, and names other files: Mesh(file: \"cat.obj\"), Sphere(radius: 0.1, \
                 placements: \"points.csv\")",
        ));
        None
    }
}

/// The first field of a thing by its value alone, `"render": 16` or `{ "Diffuse": 0.5 }`, where it needs no other.
fn first_alone(item: Item<'_, '_>, def: &'static StructDef) -> Option<String> {
    let (first, others) = def.fields.split_first()?;
    let one = matches!(item.kind(), Kind::Integer | Kind::Float | Kind::List | Kind::Text | Kind::Bool);
    let enough = def.exactly_one.is_empty() && others.iter().all(|field| field.default.is_some());
    if !one || !enough || def.name == Scene::DEF.name || !schema::fits(item, &first.kind) {
        return None;
    }
    let value = item.lexeme();
    Some(match item.syntax() {
        Syntax::Ron => format!("{}({}: {value})", def.name, first.name),
        syntax => syntax.of_toml(format!("{{ {} = {value} }}", first.name)).into_owned(),
    })
}

/// The values with the names of their fields, where that is certain.
fn named(values: &[Item<'_, '_>], def: &'static StructDef) -> Option<String> {
    let is_object = |item: &Item<'_, '_>| {
        matches!(item.kind(), Kind::Struct | Kind::Tuple)
            && item.name().is_some_and(|name| Object::DEF.variant(name).is_some())
    };
    if def.field("objects").is_some() && values.iter().all(is_object) {
        let all: Vec<&str> = values.iter().map(Item::lexeme).collect();
        return Some(format!("objects: [{}]", all.join(", ")));
    }
    if let [only] = values
        && let Some((field, mended)) = field_of(only.lexeme())
    {
        return def.field(field).is_some().then_some(mended);
    }
    // Two points of a box may be its corners.
    if def.name == "Box" && values.len() > 1 {
        return None;
    }
    // `Uv(8)`: what fits the first fields is most probably that.
    let fields = def.fields.iter().zip(values);
    let fits =
        values.len() <= def.fields.len() && fields.clone().all(|(field, value)| schema::fits(*value, &field.kind));
    let all = || fields.map(|(field, value)| format!("{}: {}", field.name, value.lexeme())).collect::<Vec<_>>();
    fits.then(|| all().join(", "))
}
