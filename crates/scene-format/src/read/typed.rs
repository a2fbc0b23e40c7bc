//! Kinds that a field `type` tells, as other programs write them: `{"type": "Sphere", "radius": 1}`.

use super::hints::{kind_elsewhere, other_kind};
use super::synonyms::squeezed;
use super::variant::{choices, of_kind};
use super::{Reader, hinted, shortened};
use crate::codes;
use crate::desc::{Light, Object};
use crate::diagnostic::{Diagnostic, Edit};
use crate::schema::{Content, EnumDef, StructDef, VariantDef};
use crate::suggest;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};

/// Fields that tell a kind.
pub(super) const NAMES: [&str; 5] = ["type", "$type", "class", "kind", "shape"];
/// So many fields are looked at.
const MOST: usize = 64;

impl Reader<'_> {
    /// Reports a table or object that tells its kind by a field; `None` where it does not. What is meant is read all
    /// the same.
    pub(super) fn typed_elsewhere(
        &mut self,
        item: Item<'_, '_>,
        def: &'static EnumDef,
    ) -> Option<Option<&'static VariantDef>> {
        let is_one = |(key, value): &(Item<'_, '_>, Item<'_, '_>)| {
            NAMES.contains(&&*key.text()) && matches!(value.kind(), Kind::Text | Kind::Word)
        };
        let (key, value) = item.fields().take(MOST).find(is_one)?;
        let told = value.text();
        let named = item.fields().take(2).count() == 1;
        let theirs = other_kind(&told, def);
        // What a kind of ours has one of is no kind of this choice.
        let ours = |(key, _): (Item<'_, '_>, Item<'_, '_>)| def.variant(&key.text()).is_some();
        if item.fields().take(MOST).any(ours) || named && def.variants.len() < 2 && theirs.is_none() {
            return None;
        }
        let folded = |variant: &&VariantDef| variant.name.eq_ignore_ascii_case(&told);
        let near = || {
            let same = kind_elsewhere(&told, def);
            let guess = || theirs.is_none().then(|| suggest::nearest(&told, variants(def))).flatten();
            same.or_else(guess).and_then(|word| def.variant(word))
        };
        let message = format!("the kind of {} stands before its fields, not in a field `{}`", of_kind(def), key.text());
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, key.span(), message).expected(choices(def, item.syntax()));
        // Of one kind there is no choice, but for what is something else here: a lamp with a flat side, a sun.
        let is_point = matches!(&*squeezed(&told), "point" | "omni" | "sphere");
        let only = || def.variants.first().filter(|_| def.variants.len() == 1 && (is_point || theirs.is_none()));
        let meant = def.variants.iter().find(folded).or_else(near).or_else(only);
        // These two are names of ours, too.
        if meant.is_none() && matches!(&*key.text(), "kind" | "shape") {
            return None;
        }
        match meant {
            Some(variant) if let Some((way, edit)) = headed(item, key, value, Some(variant.name)) => {
                (fault.hint, fault.edit) = (way, edit);
                fault.expected = String::new();
            }
            None if told.eq_ignore_ascii_case("repeat")
                && let Some((way, edit)) = headed(item, key, value, Some("Repeat")) =>
            {
                (fault.hint, fault.edit) = (way, edit);
                fault.expected = String::new();
            }
            Some(variant) => {
                let written = inside_out(item, key, value, variant);
                fault.hint = match &written {
                    Some(written) => format!("write `{}`", hinted(&written.replace('\n', " "))),
                    None => format!("write `{}`", way(variant, item.syntax())),
                };
                fault.edit = written.map(|replacement| Edit { span: item.span(), replacement });
            }
            None => {
                fault.hint = match theirs {
                    Some(hint) => {
                        let message = format!("`{}` is not a kind of {}", shortened(&told), of_kind(def));
                        (fault.code, fault.span, fault.message) = (codes::UNKNOWN_VARIANT, value.span(), message);
                        hint.to_owned()
                    }
                    None => {
                        let example = def.variants.iter().find(|variant| matches!(variant.content, Content::Struct(_)));
                        let example = example.map_or(String::new(), |variant| way(variant, item.syntax()));
                        format!("there is no `{}`; a kind is written `{example}`", shortened(&told))
                    }
                };
            }
        }
        self.report(fault);
        self.typed = item.index() as u32;
        Some(meant.filter(|variant| matches!(variant.content, Content::Struct(_))))
    }
}

impl Reader<'_> {
    /// Reports a group of fields one of which is a kind with fields of its own, `(shape: Sphere(radius: 1), material:
    /// ..)`: which one, and where it stands.
    pub(super) fn kind_within<'t, 's>(
        &mut self,
        item: Item<'t, 's>,
        def: &'static EnumDef,
    ) -> Option<(&'static VariantDef, Item<'t, 's>)> {
        let kind_of = |value: &Item<'t, 's>| value.name().and_then(|name| def.variant(name));
        let (key, value) = item.fields().take(MOST).find(|(_, value)| kind_of(value).is_some())?;
        let variant = kind_of(&value).filter(|variant| matches!(variant.content, Content::Struct(_)))?;
        let others = item.fields().take(MOST).filter(|(other, _)| other.index() != key.index());
        let others: Vec<String> = others.map(|(key, value)| format!("{}: {}", key.lexeme(), value.lexeme())).collect();
        let open = value.lexeme().strip_suffix(')')?.trim_end().trim_end_matches(',');
        let between = if open.ends_with('(') || others.is_empty() { "" } else { ", " };
        let written = format!("{open}{between}{})", others.join(", "));
        let message = format!("the kind of {} stands before its fields, not in a field `{}`", of_kind(def), key.text());
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, key.span(), message);
        fault.hint = format!("write `{}`", hinted(&written.replace('\n', " ")));
        fault.edit = Some(Edit { span: item.span(), replacement: written });
        self.report(fault);
        Some((variant, value))
    }

    /// The fields of a group whose name stands once more before them, `[camera.Camera]`, as kinds of objects do: tells
    /// that it does not belong there.
    pub(super) fn named_within<'t, 's>(&mut self, item: Item<'t, 's>, def: &'static StructDef) -> Option<Item<'t, 's>> {
        if item.syntax() == Syntax::Ron {
            return None;
        }
        let mut fields = item.fields();
        let (key, value) = fields.next().filter(|_| fields.next().is_none())?;
        if key.text() != def.name || value.kind() != Kind::Map {
            return None;
        }
        let (noun, header) = (super::plain(def.noun), value.lexeme());
        let message = format!("{noun} has no kind before its fields");
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, key.span(), message);
        let (hint, span, replacement) = match header.trim_end_matches([']', ' ']).rsplit_once('.') {
            Some((path, _)) if header.starts_with('[') => (format!("write {path}]"), value.span(), format!("{path}]")),
            None if header.starts_with('[') => {
                self.report(fault.hint(format!("leave {header} out: its fields begin the file")));
                return Some(value);
            }
            _ => (format!("leave out `{}` and the brackets around it", def.name), item.span(), header.to_owned()),
        };
        fault.edit = Some(Edit { span, replacement });
        self.report(fault.hint(hint));
        Some(value)
    }
}

/// `[[Box]]` or `[[SphereLight]]` in the scene itself: what to write, and the edit.
pub(super) fn kind_as_list(name: &str, value: Item<'_, '_>, def: &'static StructDef) -> Option<(String, Option<Edit>)> {
    let header = value.lexeme();
    if def.name != "Scene" || value.syntax() != Syntax::Toml || !header.starts_with('[') {
        return None;
    }
    let (what, list) = if Object::DEF.variant(name).is_some() {
        ("an object", "objects")
    } else if Light::DEF.variant(name).is_some() {
        ("a light", "lights")
    } else {
        return None;
    };
    let lines = [format!("[[{list}]]"), format!("[{list}.{name}]")];
    let edit = header.trim_matches(['[', ']', ' ']) == name;
    let edit = edit.then(|| Edit { span: value.span(), replacement: lines.join("\n") });
    Some((format!("{what} begins with two lines: {} and {}", lines[0], lines[1]), edit))
}

/// How a table of TOML with a header of its own tells its kind, and the edit that has it do so where the field that
/// told it stands right below.
fn headed(
    item: Item<'_, '_>,
    key: Item<'_, '_>,
    value: Item<'_, '_>,
    kind: Option<&str>,
) -> Option<(String, Option<Edit>)> {
    let header = Some(item.lexeme()).filter(|header| header.starts_with('[') && item.syntax() == Syntax::Toml)?;
    let (path, kind) = (header.trim_matches(['[', ']', ' ', '\t']), kind?);
    let (way, mended) = match header.starts_with("[[") {
        true => (format!("write [{path}.{kind}] below [[{path}]]"), format!("{header}\n[{path}.{kind}]")),
        false => (format!("write the header as [{path}.{kind}]"), format!("[{path}.{kind}]")),
    };
    let (start, end) = (item.span().end as usize, key.span().start as usize);
    let below = item.text_between(start, end).is_some_and(|between| between.trim().is_empty());
    let span = crate::diagnostic::Span { end: value.span().end, ..item.span() };
    Some((way, below.then_some(Edit { span, replacement: mended })))
}

fn variants(def: &'static EnumDef) -> impl Iterator<Item = &'static str> {
    def.variants.iter().map(|variant| variant.name)
}

/// How a kind is written.
fn way(variant: &VariantDef, syntax: Syntax) -> String {
    let name = variant.name;
    match (&variant.content, syntax) {
        (Content::Unit, Syntax::Ron) => name.to_owned(),
        (Content::Unit, _) => format!("\"{name}\""),
        (_, Syntax::Ron) => format!("{name}(..)"),
        (_, Syntax::Toml) => format!("{{ {name} = {{ .. }} }}"),
        (_, Syntax::Json) => format!("{{\"{name}\": {{..}}}}"),
    }
}

/// The same fields within the name of the kind; `None` where they do not stand in one pair of braces.
fn inside_out(item: Item<'_, '_>, key: Item<'_, '_>, value: Item<'_, '_>, variant: &VariantDef) -> Option<String> {
    let (lexeme, syntax) = (item.lexeme(), item.syntax());
    let Content::Struct(_) = variant.content else {
        let alone = item.fields().take(2).count() == 1 && matches!(variant.content, Content::Unit);
        return alone.then(|| way(variant, syntax));
    };
    if !lexeme.starts_with('{') || syntax == Syntax::Ron {
        return None;
    }
    let at = |byte: u32| byte.checked_sub(item.span().start).map(|at| at as usize);
    let (before, after) = (lexeme.get(..at(key.span().start)?)?, lexeme.get(at(value.span().end)?..)?);
    // Its comma goes with it: the one that follows, else the one before.
    let fields = match after.trim_start().strip_prefix(',') {
        Some(after) => format!("{before}{}", after.trim_start()),
        None => {
            let kept = before.trim_end();
            format!("{}{after}", kept.strip_suffix(',').unwrap_or(kept))
        }
    };
    Some(match syntax {
        Syntax::Json => format!("{{\"{}\": {fields}}}", variant.name),
        _ => format!("{{ {} = {fields} }}", variant.name),
    })
}
