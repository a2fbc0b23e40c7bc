//! `--set path=value`: edits of the tree before it is checked, so that the same checks apply and the carets point into
//! the argument.
#![allow(clippy::result_large_err, reason = "an argument is read once, and a wrong one ends the run")]

mod named;
mod steps;
mod value;

use crate::codes;
use crate::desc::Scene;
use crate::diagnostic::Diagnostic;
use crate::files::MOST_FILES;
use crate::read::{command_line, shortened, synonyms};
use crate::schema::{Content, EnumDef, StructDef, Type, VariantDef, fits};
use crate::suggest;
use crate::syntax::{Sink, Syntax, ron, span};
use crate::tree::{Builder, Item, Kind, Node, Text, Tree};
use crate::words::Words;
use std::path::Path;
use steps::{Step, What, end_of_path, steps};
pub(crate) use value::as_arguments;

/// An argument of `--set`: `camera.fov=40`, `materials.glass=Transparent(ior: 1.6)`, `objects[2].radius=3`. The value
/// is written in RON, whatever the scene file is written in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Override {
    /// The argument as it was given.
    pub argument: String,
    /// The option that it belongs to, as messages name it.
    pub option: &'static str,
}

impl Override {
    /// `--camera NAME`
    pub fn camera(name: &str) -> Self {
        let name = name.replace('\\', "\\\\").replace('"', "\\\"");
        Override { argument: format!("camera=\"{name}\""), option: "--camera" }
    }

    /// `--frame N`
    pub fn frame(frame: u32) -> Self {
        Override { argument: format!("animation.frame={frame}"), option: "--frame" }
    }

    /// One of `--frames A-B`
    pub fn of_frames(frame: u32) -> Self {
        Override { option: "--frames", ..Override::frame(frame) }
    }
}

impl<T: Into<String>> From<T> for Override {
    fn from(argument: T) -> Self {
        let argument = argument.into();
        let quoted = completed(&argument);
        Override { argument: quoted.unwrap_or(argument), option: "--set" }
    }
}

/// The argument with the quotes or brackets that a shell makes hard to write: `albedo=#ff0000`, `material=gold`,
/// `file=cat.obj`, `position=1,2,3`, and expressions, `fov==30+5`. `None`: it is as it is.
fn completed(argument: &str) -> Option<String> {
    let (path, value) = argument.split_at(end_of_path(argument)? + 1);
    let value = value.trim();
    if value.len() > 1 && value.starts_with('=') {
        return Some(format!("{path}\"{}\"", value.replace('\\', "\\\\").replace('"', "\\\"")));
    }
    let field = path.trim_end_matches('=').trim().rsplit('.').next()?;
    let hex = value.strip_prefix('#').is_some_and(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()));
    let of_text = matches!(field, "material" | "file" | "placements" | "camera");
    if let Some(quoted) = value::name_of_file(field, value) {
        return Some(format!("{path}{quoted}"));
    }
    let plain = value.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '/' | ' ' | '~'));
    let word = plain
        && value
            .starts_with(|c: char| c.is_lowercase() || c == '/' || c == '.' || field == "file" && c.is_alphanumeric());
    if hex || of_text && word {
        return Some(format!("{path}\"{value}\""));
    }
    let numbers = value.split(',').filter(|number| number.trim().parse::<f64>().is_ok()).count();
    (numbers > 1 && numbers == value.split(',').count()).then(|| format!("{path}({value})"))
}

/// More overrides than this are not taken.
pub(crate) const MAX_OVERRIDES: usize = u16::MAX as usize - 1 - MOST_FILES;

/// Edits the tree, one override after the other.
pub(crate) fn apply<'s>(tree: &mut Tree<'s>, overrides: &'s [Override], sink: &mut Sink) {
    if !overrides.is_empty() {
        tree.flatten();
    }
    for (index, set) in overrides.iter().take(MAX_OVERRIDES).enumerate() {
        let source = index as u16 + 1;
        tree.texts.push(Text { text: &set.argument, syntax: Syntax::Ron, folder: Path::new("") });
        if let Err(fault) = apply_one(tree, &set.argument, source, sink) {
            sink.push(fault);
        }
    }
}

fn apply_one(tree: &mut Tree<'_>, argument: &str, source: u16, sink: &mut Sink) -> Result<(), Diagnostic> {
    let equals = end_of_path(argument).ok_or_else(|| {
        Diagnostic::error(
            codes::BAD_SET_SYNTAX,
            span(source, 0, argument.len()),
            "this argument of --set has no `=` between path and value",
        )
        .expected("path=value, as in --set camera.fov=40")
        .hint("put quotes around it in the shell if it has spaces or brackets: --set 'camera.fov=40'")
    })?;
    if let Some(operator) = argument[..equals].chars().next_back().filter(|c| "+-*/".contains(*c)) {
        let at = span(source, equals - 1, equals + 1);
        return Err(Diagnostic::error(
            codes::BAD_SET_SYNTAX,
            at,
            format!("`{operator}=`: --set gives a field a value, and reckons with none that stands there"),
        )
        .expected("path=value, as in --set camera.fov=40")
        .hint("give what comes of it; or let the scene reckon with a name of `vars`: --set vars.name=2"));
    }
    let steps = steps(&argument[..equals], source)?;
    let mut builder = Builder::new(source);
    let (faults, told) = (sink.errors, sink.diagnostics.len());
    if argument[equals + 1..].trim().is_empty() {
        return Err(Diagnostic::error(
            codes::BAD_SET_SYNTAX,
            span(source, equals, equals + 1),
            "there is no value after `=`",
        )
        .expected("path=value, as in --set camera.fov=40"));
    }
    ron::parse_from(argument, equals + 1, &mut builder, sink);
    if sink.errors > faults {
        value::of_arguments(sink, told, argument);
        return Ok(());
    }
    if tree.nodes.is_empty() {
        // An empty file: it has no root to put the field into.
        tree.nodes.push(Node { start: 0, end: 0, size: 1, source: 0, kind: Kind::Struct });
    }
    let set = Setter { source, value: builder.nodes.iter().collect() }.set(tree, &steps);
    set.map_err(|fault| match value::size_of(argument) {
        Some(size) => Diagnostic { hint: size, edit: None, ..fault },
        None => fault,
    })
}

/// What the edit of the tape will be.
enum Edited {
    /// The node at this index is replaced.
    Replace(usize),
    /// A field with this path of names is added to the node at this index.
    Add(usize, Vec<(usize, usize)>),
}

struct Setter {
    source: u16,
    value: Vec<Node>,
}

impl Setter {
    fn set(self, tree: &mut Tree<'_>, steps: &[Step<'_>]) -> Result<(), Diagnostic> {
        let edited = {
            let Some(root) = tree.root() else { return Ok(()) };
            match self.find_light_in_group(root, steps) {
                Some(found) => found?,
                None => self.find(root, Scene::TYPE, steps, "the scene")?,
            }
        };
        let Some(edited) = edited else { return Ok(()) };
        match edited {
            Edited::Replace(index) => {
                let end = index + tree.nodes.at(index).size as usize;
                splice(tree, index, index..end, self.value);
            }
            Edited::Add(index, names) => {
                let mut nodes = Vec::new();
                let mut opened = Vec::new();
                for (depth, &(start, end)) in names.iter().enumerate() {
                    nodes.push(self.node(Kind::Key, start, end));
                    if depth + 1 < names.len() {
                        opened.push(nodes.len());
                        nodes.push(self.node(Kind::Map, start, end));
                    }
                }
                nodes.extend(self.value);
                let total = nodes.len();
                for index in opened {
                    nodes[index].size = (total - index) as u32;
                }
                let end = index + tree.nodes.at(index).size as usize;
                if matches!(tree.nodes.at(index).kind, Kind::Tuple) {
                    tree.nodes.at_mut(index).kind = Kind::Struct;
                }
                splice(tree, index, end..end, nodes);
            }
        }
        Ok(())
    }

    fn node(&self, kind: Kind, start: usize, end: usize) -> Node {
        Node { start: start as u32, end: end as u32, size: 1, source: self.source, kind }
    }

    /// Goes down the tree and the schema together. `Ok(None)`: the tree is broken there, which has been reported.
    fn find(
        &self,
        item: Item<'_, '_>,
        kind: Type,
        steps: &[Step<'_>],
        noun: &str,
    ) -> Result<Option<Edited>, Diagnostic> {
        let Some((step, rest)) = steps.split_first() else { return Ok(Some(Edited::Replace(item.index()))) };
        if item.kind() == Kind::Broken {
            return Ok(None);
        }
        match (kind.resolved(), &step.what) {
            (Type::Struct(def), What::Name(name)) => self.find_field(item, def, name, step, rest),
            (Type::Enum(def), What::Name(name)) => self.find_variant(item, def, name, step, steps, rest),
            (Type::OneOf([Type::Text, Type::Struct(_)]), What::Name(name)) if item.kind() == Kind::Text => {
                let camera = item.text();
                let fault = self.fault(codes::BAD_SET_PATH, step, format!("{noun} is one of `cameras`, by its name"));
                Err(fault.hint(value::instead("camera", &camera, name)))
            }
            (Type::OneOf(kinds), _) => self.find_fitting(item, kinds, step, steps, noun),
            (Type::Optional(inner), _) => self.find(item.without_some(), *inner, steps, noun),
            (Type::Map(inner), What::Name(name)) => self.find_in_map(item, *inner, name, step, rest),
            (Type::Vector | Type::Pair, _) => self.find_part(item, step, rest, noun),
            (Type::List(inner), What::Index(index)) => self.find_item(item, *inner, *index, step, rest, noun),
            (Type::List(inner), What::Name(name)) if named::have_names(*inner).is_some() => {
                let Some(def) = named::have_names(*inner) else { return Ok(None) };
                self.find_named(item, def, name, noun, step, rest)
            }
            (Type::List(_), What::Name(_)) => Err(self
                .fault(codes::BAD_SET_PATH, step, format!("{noun} is a list; its items have numbers"))
                .expected("the number of an item in brackets, counted from 0: [0]")),
            _ => Err(self.no_parts(item, step, noun)),
        }
    }

    /// Goes on where a value may be of several types: by the first that is written here.
    fn find_fitting(
        &self,
        item: Item<'_, '_>,
        kinds: &'static [Type],
        step: &Step<'_>,
        steps: &[Step<'_>],
        noun: &str,
    ) -> Result<Option<Edited>, Diagnostic> {
        let of_texture = Type::OneOf(kinds).is_texture();
        if of_texture && item.kind() == Kind::Text && !item.text().starts_with(['#', '=']) {
            let fault = self.fault(codes::BAD_SET_PATH, step, format!("{noun} is one of `textures`, by its name"));
            return Err(fault.hint(value::instead("texture", &item.text(), "")));
        }
        match kinds.iter().find(|kind| fits(item, kind)) {
            Some(&kind) if !matches!(kind, Type::Text | Type::File) => self.find(item, kind, steps, noun),
            Some(_) => {
                let message = format!("{noun} is {} and has no parts", crate::read::describe(item));
                Err(self.fault(codes::BAD_SET_PATH, step, message).hint(match item.kind() {
                    Kind::Text if kinds.iter().any(|kind| matches!(kind, Type::Text)) => {
                        value::instead("material", &item.text(), "")
                    }
                    _ => "set it as a whole".to_owned(),
                }))
            }
            None => Err(self.no_parts(item, step, noun)),
        }
    }

    /// Goes on from the value of this name in a map, or adds the name.
    fn find_in_map(
        &self,
        item: Item<'_, '_>,
        inner: Type,
        name: &str,
        step: &Step<'_>,
        rest: &[Step<'_>],
    ) -> Result<Option<Edited>, Diagnostic> {
        let (what, group) = match inner {
            Type::Value => ("var", "vars"),
            Type::Struct(_) => ("camera", "cameras"),
            Type::Vector => ("mark", "output.marks"),
            inner if inner.is_texture() => ("texture", "textures"),
            _ => ("material", "materials"),
        };
        let found = item.fields().find(|(key, _)| key.text() == name);
        if let Some((_, value)) = found {
            return self.find(value, inner, rest, &format!("the {what} \"{name}\""));
        }
        if rest.is_empty() && item.kind() == Kind::Map {
            // A new name.
            return Ok(Some(Edited::Add(item.index(), vec![value::name(step)])));
        }
        let keys: Vec<String> = item.fields().map(|(key, _)| key.text().into_owned()).collect();
        let words: Vec<&str> = keys.iter().map(String::as_str).collect();
        let mut fault = self.fault(codes::BAD_SET_PATH, step, format!("the scene has no {what} \"{name}\""));
        fault.expected = match words.len() {
            0 => format!("nothing: `{group}` is empty"),
            1..=8 => format!("one of {}", suggest::list(&words)),
            count => format!("one of the {count} names in `{group}`"),
        };
        let near = suggest::nearest(name, words.iter().copied()).map(value::step);
        fault.did_you_mean(near.as_deref(), str::to_owned);
        Err(fault)
    }

    /// Goes on from the item of this number in a list.
    fn find_item(
        &self,
        item: Item<'_, '_>,
        inner: Type,
        index: usize,
        step: &Step<'_>,
        rest: &[Step<'_>],
        noun: &str,
    ) -> Result<Option<Edited>, Diagnostic> {
        if !matches!(item.kind(), Kind::List) {
            return Err(self.no_parts(item, step, noun));
        }
        match item.children().nth(index) {
            Some(child) if crate::read::repeat_body(child).is_some() && !rest.is_empty() => Err(self
                .fault(codes::BAD_SET_PATH, step, format!("item {index} of {noun} is a `Repeat`"))
                .expected("an item that stands for itself")
                .hint("give what differs a name in `vars`, and set that: --set vars.height=2")),
            Some(child) => self.find(child, inner, rest, &format!("item {index} of {noun}")),
            None => {
                let count = item.children().count();
                let expected = match count {
                    0 => "nothing: the list is empty".to_owned(),
                    1 => "0: the list has one item".to_owned(),
                    count => format!("0 to {}: the list has {count} items", count - 1),
                };
                let message = format!("there is no item {index} in {}", crate::read::plain(noun));
                let fault = self.fault(codes::BAD_SET_INDEX, step, message).expected(expected);
                Err(if count == 0 { fault.hint(value::as_a_list(noun)) } else { fault })
            }
        }
    }

    fn find_field(
        &self,
        item: Item<'_, '_>,
        def: &'static StructDef,
        name: &str,
        step: &Step<'_>,
        rest: &[Step<'_>],
    ) -> Result<Option<Edited>, Diagnostic> {
        let Some(field) = def.field(name) else {
            let names: Vec<&str> = def.fields.iter().map(|field| field.name).collect();
            let mut fault = self
                .fault(codes::BAD_SET_PATH, step, format!("{} has no field `{}`", def.noun, shortened(name)))
                .expected(format!("one of {}", suggest::list(&names)));
            fault.did_you_mean(meant_field(name, def), str::to_owned);
            // `fov`, without the group that it is a field of.
            let group = Scene::DEF
                .fields
                .iter()
                .find(|group| group.kind.group().is_some_and(|fields| fields.field(name).is_some()));
            if let Some(group) = group.filter(|_| def.name == "Scene") {
                fault.did_you_mean(Some(&format!("{}.{name}", group.name)), str::to_owned);
            }
            let vars = || item.fields().find(|(key, _)| key.text() == "vars").map(|(_, vars)| vars);
            if def.name == "Scene" && vars().is_some_and(|vars| vars.fields().any(|(key, _)| key.text() == name)) {
                fault.did_you_mean(Some(&format!("vars.{name}")), str::to_owned);
            }
            if let Some(option) = command_line(name, def) {
                (fault.hint, fault.edit) = (option.to_owned(), None);
            } else if def.name == "Scene" && name == "time" {
                fault.hint = "the time goes by the frame: --frame 12".to_owned();
            } else if fault.hint.is_empty() && item.fields().any(|(key, _)| key.text() == "include") {
                fault.hint =
                    format!("a name of `vars`, in files that are included too, is set by vars.{}", shortened(name));
            }
            return Err(fault);
        };
        if !matches!(item.kind(), Kind::Struct | Kind::Map | Kind::Tuple) {
            return Err(self.no_parts(item, step, def.noun));
        }
        let found = item.fields().find(|(key, _)| key.text() == name).map(|(_, value)| value).or_else(|| {
            // Scale(2): the value without a name.
            (def.bare == Some(name) && item.kind() == Kind::Tuple).then(|| item.children().next()).flatten()
        });
        if let Some(value) = found {
            return self.find(value, field.kind, rest, field.noun);
        }
        if def.exactly_one.contains(&name) && rest.is_empty() {
            // `power` in the place of `intensity`.
            let other = item.fields().find(|(key, _)| def.exactly_one.contains(&&*key.text()));
            if let Some((key, _)) = other {
                return Err(self
                    .fault(
                        codes::BAD_SET_PATH,
                        step,
                        format!("the scene says how bright this light is by `{}`, not by `{name}`", key.text()),
                    )
                    .hint(format!("set `{}`", key.text())));
            }
        }
        if let Some(fault) = self.camera_of_names(item, def, step, rest) {
            return Err(fault);
        }
        // Not written yet: the field comes with all the names that lead to it.
        let mut names = vec![(step.start, step.end)];
        self.check_path(field.kind, rest, field.noun, &mut names)?;
        Ok(Some(Edited::Add(item.index(), names)))
    }

    /// A field of the camera, where none is written and the scene's camera is the first of those with names: what would
    /// be added would be another camera.
    fn camera_of_names(
        &self,
        item: Item<'_, '_>,
        def: &'static StructDef,
        step: &Step<'_>,
        rest: &[Step<'_>],
    ) -> Option<Diagnostic> {
        let What::Name(field) = rest.first()?.what else { return None };
        if def.name != Scene::DEF.name || !matches!(step.what, What::Name("camera")) {
            return None;
        }
        let (_, cameras) = item.fields().find(|(key, _)| key.text() == "cameras")?;
        let (first, _) = cameras.fields().next()?;
        let fault = self.fault(codes::BAD_SET_PATH, step, "the camera of this scene is one of its `cameras`");
        Some(fault.hint(value::instead("camera", &first.text(), field)))
    }

    /// Follows names that the tree does not have yet.
    fn check_path(
        &self,
        kind: Type,
        steps: &[Step<'_>],
        noun: &str,
        names: &mut Vec<(usize, usize)>,
    ) -> Result<(), Diagnostic> {
        let Some((step, rest)) = steps.split_first() else { return Ok(()) };
        let kind = kind.resolved();
        match (kind.group().map_or(kind, Type::Struct), &step.what) {
            (Type::Struct(def), What::Name(name)) => {
                let Some(field) = def.field(name) else {
                    let words: Vec<&str> = def.fields.iter().map(|field| field.name).collect();
                    let mut fault = self
                        .fault(codes::BAD_SET_PATH, step, format!("{} has no field `{}`", def.noun, shortened(name)))
                        .expected(format!("one of {}", suggest::list(&words)));
                    fault.did_you_mean(meant_field(name, def), str::to_owned);
                    if let Some(option) = command_line(name, def) {
                        (fault.hint, fault.edit) = (option.to_owned(), None);
                    }
                    return Err(fault);
                };
                names.push((step.start, step.end));
                self.check_path(field.kind, rest, field.noun, names)
            }
            (Type::Enum(def), What::Name(name)) => match variant_of(def, name) {
                Some((variant, named)) => {
                    if named {
                        names.push((step.start, step.end));
                        return match &variant.content {
                            Content::Struct(fields) => self.check_path(Type::Struct(fields), rest, fields.noun, names),
                            _ => Ok(()),
                        };
                    }
                    Err(self
                        .fault(
                            codes::BAD_SET_PATH,
                            step,
                            format!("{} is not written in the scene", crate::read::plain(noun)),
                        )
                        .hint(format!("set it as a whole, or say its kind: {}.{name}", variant.name)))
                }
                None => Err(self
                    .fault(codes::BAD_SET_PATH, step, format!("no {} has a field `{}`", def.noun, shortened(name)))
                    .expected(crate::read::choices(def, Syntax::Ron))),
            },
            (Type::Map(_), What::Name(_)) if rest.is_empty() => {
                names.push(value::name(step));
                Ok(())
            }
            (Type::Map(of), What::Name(name)) => Err(self
                .fault(codes::BAD_SET_PATH, step, format!("{} is not written in the scene", crate::read::plain(noun)))
                .hint(value::as_a_whole(noun, name, *of))),
            (Type::Map(_) | Type::List(_), _) => Err(self
                .fault(codes::BAD_SET_PATH, step, format!("{} is not written in the scene", crate::read::plain(noun)))
                .hint(value::as_a_list(noun))),
            (Type::Vector | Type::Pair, _) => Err(self
                .fault(codes::BAD_SET_PATH, step, format!("{} is not written in the scene", crate::read::plain(noun)))
                .hint(match kind {
                    Type::Vector => "set it as a whole: (x, y, z)",
                    _ => "set it as a whole: (x, y)",
                })),
            _ => Err(self.fault(codes::BAD_SET_PATH, step, format!("{} has no parts", crate::read::plain(noun)))),
        }
    }

    fn find_variant(
        &self,
        item: Item<'_, '_>,
        def: &'static EnumDef,
        name: &str,
        step: &Step<'_>,
        steps: &[Step<'_>],
        rest: &[Step<'_>],
    ) -> Result<Option<Edited>, Diagnostic> {
        // Name(..) or { Name = .. }: the steps go through the name of the kind.
        let (written, inner) = match item.kind() {
            Kind::Struct | Kind::Tuple => (item.name().map(str::to_owned), Some(item)),
            Kind::Map => match item.fields().next() {
                Some((key, value)) => (Some(key.text().into_owned()), Some(value)),
                None => (None, None),
            },
            _ => (Some(item.text().into_owned()), None),
        };
        let Some(variant) = written.as_deref().and_then(|written| def.variant(written)) else {
            return Err(self.no_parts(item, step, def.noun));
        };
        let steps = if variant.name == name { rest } else { steps };
        match (&variant.content, inner) {
            (_, Some(inner)) if steps.is_empty() => Ok(Some(Edited::Replace(inner.index()))),
            (Content::Struct(fields), Some(inner)) => self.find(inner, Type::Struct(fields), steps, fields.noun),
            (Content::Value(at), Some(inner)) => self.find(inner, at.kind, steps, at.noun),
            _ => Err(self.no_parts(item, step, def.noun)),
        }
    }

    fn no_parts(&self, item: Item<'_, '_>, step: &Step<'_>, noun: &str) -> Diagnostic {
        self.fault(
            codes::BAD_SET_PATH,
            step,
            format!("{} is {} and has no such part", crate::read::plain(noun), crate::read::describe(item)),
        )
        .hint("set it as a whole")
    }

    fn fault(&self, code: codes::Code, step: &Step<'_>, message: impl Into<String>) -> Diagnostic {
        Diagnostic::error(code, span(self.source, step.start, step.end), message)
    }
}

/// The field that is meant by a name that is none: what other programs call so, else the nearest.
fn meant_field(name: &str, def: &'static StructDef) -> Option<&'static str> {
    let of_others = synonyms(name, def).into_iter().next();
    of_others.or_else(|| suggest::nearest(name, def.fields.iter().map(|field| field.name)))
}

/// The variant of this name (`true`), or the first one with a field of this name.
fn variant_of(def: &'static EnumDef, name: &str) -> Option<(&'static VariantDef, bool)> {
    if let Some(variant) = def.variant(name) {
        return Some((variant, true));
    }
    let with_field = def.variants.iter().find(|variant| match &variant.content {
        Content::Struct(fields) => fields.field(name).is_some(),
        _ => false,
    });
    with_field.map(|variant| (variant, false))
}

/// Replaces a range of the tape and mends the sizes of all nodes around it; `inside` lies in the innermost of them.
fn splice(tree: &mut Tree<'_>, inside: usize, range: std::ops::Range<usize>, nodes: Vec<Node>) {
    let (old, new) = (range.len(), nodes.len());
    let replaced = old > 0;
    for index in 0..=inside {
        let node = tree.nodes.at_mut(index);
        let contains = index + node.size as usize > inside && (index < inside || !replaced);
        if contains {
            node.size = (node.size as usize + new - old) as u32;
        }
    }
    let rest: Vec<Node> = (range.end..tree.nodes.len()).map(|index| tree.nodes.at(index)).collect();
    tree.nodes.truncate(range.start);
    tree.nodes.extend(nodes);
    tree.nodes.extend(rest);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_and_brackets_are_added_where_a_shell_makes_them_hard() {
        for (written, read) in [
            ("materials.a.albedo=#ff0000", "materials.a.albedo=\"#ff0000\""),
            ("objects[1].material=gold", "objects[1].material=\"gold\""),
            ("objects[1].file=Models/cat.obj", "objects[1].file=\"Models/cat.obj\""),
            ("objects.part.file=m/my part (v2).stl", "objects.part.file=\"m/my part (v2).stl\""),
            ("objects.part.file=größe #2 \"a\".stl", "objects.part.file=\"größe #2 \\\"a\\\".stl\""),
            ("camera.position=1,2,-3", "camera.position=(1,2,-3)"),
            ("objects[1].material=Mirror()", "objects[1].material=Mirror()"),
            ("camera.fov=40", "camera.fov=40"),
            ("effects.tone_map=Filmic", "effects.tone_map=Filmic"),
            ("objects[1].material=\"gold\"", "objects[1].material=\"gold\""),
            ("camera.fov", "camera.fov"),
            ("camera.fov==30+5", "camera.fov=\"=30+5\""),
            ("camera.fov=\"=30+5\"", "camera.fov=\"=30+5\""),
            ("camera.fov==", "camera.fov=="),
        ] {
            assert_eq!(Override::from(written).argument, read);
        }
    }
}
