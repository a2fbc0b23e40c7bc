//! Choices: `Name`, `Name(..)` in RON; `"Name"`, `{ Name = .. }` in TOML, and in JSON with `"Name": ..`.

use super::hints::{kind_elsewhere, other_kind};
use super::kinds_elsewhere::{needs, of_all_purposes};
use super::{Fields, Reader, describe, kinds_of_figures, plain};
use crate::codes;
use crate::desc::{Metal, Scene};
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::schema::{Content, EnumDef, Type, VariantDef};
use crate::suggest;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};
use crate::words::Words;

/// A variant that was found, with what stands in its brackets.
pub(crate) struct Chosen<'t, 's> {
    pub variant: &'static VariantDef,
    body: Body<'t, 's>,
    item: Item<'t, 's>,
}

enum Body<'t, 's> {
    /// A bare word.
    None,
    /// `Name(..)`: the item itself.
    Brackets(Item<'t, 's>),
    /// `{ Name = value }`: the value.
    Value(Item<'t, 's>),
}

/// The first of a table's names that is a kind.
fn kind_among<'t, 's>(item: Item<'t, 's>, def: &'static EnumDef) -> Option<Item<'t, 's>> {
    // No kind has more fields; a table of a million names is told as what it is.
    const MOST: usize = 32;
    item.fields().take(MOST).map(|(key, _)| key).find(|key| def.variant(&key.text()).is_some())
}

impl Reader<'_> {
    /// Finds out which variant is written.
    pub fn variant<'t, 's>(&mut self, item: Item<'t, 's>, def: &'static EnumDef) -> Option<Chosen<'t, 's>> {
        let (name, span, body) = match item.kind() {
            Kind::Broken => return None,
            Kind::Word if item.is_null() => match def.variant("None") {
                Some(_) => ("None".into(), item.span(), Body::None),
                None => return self.no_variant(item, def),
            },
            Kind::Word => (item.lexeme().into(), item.span(), Body::None),
            Kind::Text => {
                let name = item.text();
                if item.syntax() == Syntax::Ron {
                    return self.quoted_variant(item, &name, def);
                }
                (name, item.span(), Body::None)
            }
            Kind::Struct | Kind::Tuple => match item.name() {
                Some(name) => {
                    let span = item.span();
                    (name.into(), Span { end: span.start + name.len() as u32, ..span }, Body::Brackets(item))
                }
                None => {
                    let Some((variant, inner)) = self.kind_within(item, def) else { return self.no_variant(item, def) };
                    return Some(Chosen { variant, body: Body::Brackets(inner), item });
                }
            },
            Kind::Map if let Some(meant) = self.typed_elsewhere(item, def) => {
                return meant.map(|variant| Chosen { variant, body: Body::Value(item), item });
            }
            Kind::Map => {
                let mut fields = item.fields();
                match (fields.next(), fields.next()) {
                    (Some((key, value)), None) => (key.text(), key.span(), Body::Value(value)),
                    (Some(_), Some(_)) if let Some(kind) = kind_among(item, def) => {
                        self.beside_kind(item, &kind, def);
                        return None;
                    }
                    (None, _) if item.is_damaged() => return None,
                    _ => return self.no_variant(item, def),
                }
            }
            _ => return self.no_variant(item, def),
        };
        if let Some(variant) = def.variant(&name) {
            return Some(Chosen { variant, body, item });
        }
        // { albedo = 1 }: the fields of a kind without its name.
        let is_field =
            |variant: &VariantDef| matches!(variant.content, Content::Struct(def) if def.field(&name).is_some());
        if matches!(body, Body::Value(_)) && def.variants.iter().any(is_field) {
            return self.no_variant(item, def);
        }
        if matches!(body, Body::None) && self.color_as_texture(item, def) {
            return None;
        }
        // What is meant is read all the same, so that what is wrong inside is told in the same run.
        let inner = match body {
            Body::None => None,
            Body::Brackets(inner) | Body::Value(inner) => Some(inner),
        };
        let variant = self.unknown_variant(span, &name, def, item.syntax(), inner)?;
        self.renamed = item.index() as u32;
        let readable = !matches!(body, Body::None) || matches!(variant.content, Content::Unit);
        readable.then_some(Chosen { variant, body, item })
    }

    /// Reports what stands beside a kind, where only the kind can stand: `{ name = "a", Sphere = { .. } }`.
    fn beside_kind(&mut self, item: Item<'_, '_>, kind: &Item<'_, '_>, def: &'static EnumDef) {
        // What stands beside may belong to a bracket that is never closed.
        if self.sink.diagnostics.iter().any(|fault| fault.code == codes::UNCLOSED_BRACKET) {
            return;
        }
        let Some((other, _)) = item.fields().find(|(key, _)| key.index() != kind.index()) else { return };
        let (name, field) = (kind.text(), other.text());
        let message = format!("beside `{name}` nothing else can stand here");
        let mut fault = Diagnostic::error(codes::UNKNOWN_FIELD, other.span(), message)
            .expected(format!("one {}; its fields stand inside its own braces", def.noun))
            .label(kind.span(), format!("this is the {}", def.noun));
        // Two kinds below one header of a list: the second has none of its own.
        let header = item.fields().find(|(key, _)| key.index() == other.index()).map(|(_, value)| value);
        if let Some(header) = header.filter(|value| def.variant(&field).is_some() && value.lexeme().starts_with('['))
            && item.lexeme().starts_with("[[")
        {
            let (list, at) = (item.lexeme(), header.span());
            fault.expected = format!("{list} before each");
            fault.hint = format!("write {list} on a line before it");
            let span = crate::diagnostic::Span { end: at.start, ..at };
            // Where the list's name is mistyped there, that is told already.
            let name = format!("`{}`", list.trim_matches(['[', ']']));
            if !self.sink.diagnostics.iter().any(|told| told.hint.contains(&name)) {
                fault.edit = Some(Edit { span, replacement: format!("{list}\n") });
            }
            return self.report(fault);
        }
        let own = def.variant(&name).is_some_and(
            |variant| matches!(variant.content, Content::Struct(fields) if fields.field(&field).is_some()),
        );
        let value = item.fields().find(|(key, _)| key.index() == kind.index()).map_or("", |(_, value)| value.lexeme());
        if own && item.syntax() == Syntax::Toml && value.starts_with('[') {
            let list = item.lexeme().trim_matches(['[', ']']);
            fault.hint = format!("put `{field}` below [{list}.{name}]");
        } else if own {
            fault.hint = format!("put `{field}` into the braces of `{name}`");
        } else if item.lexeme().starts_with("[[") && Scene::DEF.field(&field).is_some() {
            let list = item.lexeme();
            fault.hint = format!("what stands below {list} belongs to it: put `{field}` above the first [header]");
        }
        self.report(fault);
    }

    fn no_variant<T>(&mut self, item: Item<'_, '_>, def: &'static EnumDef) -> Option<T> {
        if item.is_damaged() && item.children().count() <= 1 || item.kind() == Kind::List && item.holds_damage() {
            return None;
        }
        if self.mapping_elsewhere(item, def) || self.color_as_texture(item, def) {
            return None;
        }
        let mut fault = Diagnostic::error(
            codes::WRONG_TYPE,
            item.head(),
            format!("a {} cannot be {}", def.noun, describe(item))
                .replace("a acc", "an acc")
                .replace("a caustics", "caustics")
                .replace("an object of fields", "fields without the name of a kind")
                .replace("a obj", "an obj"),
        )
        .expected(choices(def, item.syntax()));
        if item.kind() == Kind::Bool && item.lexeme() == "false" && def.variant("None").is_some() {
            fault.hint = format!("write {}", super::none(item.syntax()));
            fault.edit = Some(Edit { span: item.span(), replacement: super::none(item.syntax()).to_owned() });
        } else if item.kind() == Kind::Bool && def.noun == "pixel filter" {
            fault.hint = "leave it out: edges are smooth without it".to_owned();
        } else if matches!(item.kind(), Kind::Map) && item.fields().next().is_none() && def.noun == "object" {
            fault.message = "these braces are empty: an object is a kind with its fields".to_owned();
            fault.hint = "write Sphere(center: (0, 0, 0), radius: 1), say".to_owned();
        } else if let Some((hint, edit)) = self.color_as_material(item, def) {
            (fault.hint, fault.edit) = (hint, edit);
        } else if matches!(item.kind(), Kind::Struct | Kind::Map) {
            // The fields alone, without the name of the kind: say which kind has them.
            let fits = def.variants.iter().filter(|variant| {
                matches!(variant.content, Content::Struct(fields)
                    if item.fields().next().is_some()
                    && item.fields().all(|(key, _)| fields.field(&key.text()).is_some())
                    && fields.fields.iter().all(|field| field.default.is_some()
                        || item.fields().any(|(key, _)| key.text() == field.name)))
            });
            // Of several the one that cannot do without these fields: centre and radius are a sphere's before a disk's.
            let needs = |variant: &&VariantDef| match variant.content {
                Content::Struct(fields) => fields.fields.iter().filter(|field| field.default.is_none()).count(),
                _ => 0,
            };
            let fits: Vec<&VariantDef> = fits.collect();
            let most = fits.iter().map(needs).max();
            let fits: Vec<&str> =
                fits.iter().filter(|variant| Some(needs(variant)) == most).map(|variant| variant.name).collect();
            if let [only] = fits.as_slice() {
                let (start, lexeme) = (item.span().start, item.lexeme());
                if item.syntax() == Syntax::Ron && lexeme.starts_with('(') {
                    fault.hint = format!("write `{only}` before the bracket");
                    fault.edit =
                        Some(Edit { span: Span { end: start, ..item.span() }, replacement: (*only).to_owned() });
                } else if lexeme.starts_with('{') {
                    let syntax = item.syntax();
                    fault.hint = match syntax {
                        Syntax::Ron => format!("write `{only}(..)`"),
                        syntax => syntax.of_toml(format!("write `{{ {only} = {{ .. }} }}`")).into_owned(),
                    };
                    let replacement = match syntax {
                        Syntax::Json => format!("{{ \"{only}\": {lexeme} }}"),
                        Syntax::Ron => format!("{only}({})", lexeme.trim_matches(['{', '}'])),
                        Syntax::Toml => format!("{{ {only} = {lexeme} }}"),
                    };
                    fault.edit = Some(Edit { span: item.span(), replacement });
                } else {
                    fault.hint = format!("put the fields into a table `{only}`");
                }
            }
        }
        if fault.hint.is_empty() && def.noun == "object" && item.kind() == Kind::Map && item.lexeme().starts_with('{') {
            let way = item.syntax().of_toml("{ Sphere = { radius = 1 } }");
            fault.hint = format!("an object is its kind with its fields: {way}");
        }
        self.report(fault);
        None
    }

    /// Reports a kind that there is not; gives the one that is meant.
    fn unknown_variant(
        &mut self,
        span: Span,
        name: &str,
        def: &'static EnumDef,
        syntax: Syntax,
        inner: Option<Item<'_, '_>>,
    ) -> Option<&'static VariantDef> {
        let mut fault = Diagnostic::error(
            codes::UNKNOWN_VARIANT,
            span,
            format!("`{}` is not a kind of {}", super::shortened(name), of_kind(def)),
        )
        .expected(match (def.noun, syntax) {
            // Which is also a colour alone.
            ("background", Syntax::Ron) => format!("a colour, (r, g, b), or {}", choices(def, syntax)),
            ("background", _) => format!("a colour, [r, g, b], or {}", choices(def, syntax)),
            _ => choices(def, syntax),
        });
        let quoted = syntax != Syntax::Ron && span.end - span.start == name.len() as u32 + 2;
        let names = def.variants.iter().map(|variant| variant.name);
        let elsewhere = kind_elsewhere(name, def);
        if let Some(metal) = inner.and_then(|inner| metal_of(inner, def)) {
            let fields = || inner.into_iter().flat_map(|inner| inner.fields().take(8));
            let roughness = fields().find(|(key, _)| key.text() == "roughness");
            let roughness = roughness.map(|(_, value)| format!(", roughness: {}", value.lexeme()));
            let used = 1 + usize::from(roughness.is_some());
            let mended = format!("Conductor(metal: {metal}{})", roughness.unwrap_or_default());
            fault.hint = format!("write {mended}");
            // What else is said of it would be lost.
            fault.edit = inner
                .filter(|_| fields().count() <= used)
                .map(|inner| Edit { span: Span { end: inner.span().end, ..span }, replacement: mended });
            self.report(fault);
            return None;
        }
        if let Some(polygon) = inner.filter(|_| elsewhere == Some("Rectangle")).and_then(by_corners) {
            let way = super::hinted(&polygon);
            self.report(fault.hint(format!("what is said by its corners is a polygon: {way}")));
            return None;
        }
        if let Some(way) = kinds_of_figures::way(name, def, inner, syntax) {
            self.report(fault.hint(way));
            return None;
        }
        if let Some(way) = of_all_purposes(name, def, inner, syntax) {
            self.report(fault.hint(format!("write {way}")));
            return None;
        }
        // The nearest kind of ours, with other fields than theirs: reading on would tell of every one of them.
        if let Some(variant) = elsewhere.and_then(|word| def.variant(word))
            && let Some(needs) = needs(variant, inner, syntax)
        {
            let more = other_kind(name, def).filter(|_| !needs.starts_with("`BlinnPhong("));
            let more = more.map_or(String::new(), |way| format!("; {way}"));
            self.report(fault.hint(format!("the nearest here is {needs}{more}")));
            return None;
        }
        let near =
            elsewhere.or_else(|| suggest::nearest(name, names).filter(|near| suggest::has_same_number(name, near)));
        // A word alone for a kind that needs its fields.
        if let (None, Some(variant)) = (inner, near.and_then(|word| def.variant(word)))
            && let (Content::Struct(_), Some(written)) = (&variant.content, alone(variant, syntax))
            && (elsewhere.is_some() || other_kind(name, def).is_none())
        {
            fault.hint = format!("write {}", written.0);
            fault.edit = written.1.then_some(Edit { span, replacement: written.0 });
            self.report(fault);
            return None;
        }
        let meant = near.filter(|_| elsewhere.is_some() || other_kind(name, def).is_none());
        fault.did_you_mean(meant, |word| if quoted { format!("\"{word}\"") } else { word.to_owned() });
        if fault.hint.is_empty()
            && let Some(way) = other_kind(name, def)
        {
            fault.hint = way.to_owned();
        }
        self.report(fault);
        meant.and_then(|word| def.variant(word))
    }

    fn quoted_variant<T>(&mut self, item: Item<'_, '_>, name: &str, def: &'static EnumDef) -> Option<T> {
        let known = suggest::nearest(name, def.variants.iter().map(|variant| variant.name));
        let Some(word) = known.or_else(|| kind_elsewhere(name, def)) else { return self.no_variant(item, def) };
        let message = format!("the kind of {} is written without quotes", of_kind(def));
        let mut fault =
            Diagnostic::error(codes::WRONG_TYPE, item.span(), message).expected(choices(def, item.syntax()));
        let unit = def.variant(word).is_some_and(|variant| matches!(variant.content, Content::Unit));
        if unit {
            fault.hint = format!("write {word}");
            fault.edit = Some(Edit { span: item.span(), replacement: word.to_owned() });
        } else {
            fault.hint = format!("write {word}(..)");
        }
        self.report(fault);
        None
    }

    /// Makes sure that a variant without values has none.
    pub fn unit(&mut self, chosen: &Chosen<'_, '_>) -> Option<()> {
        let (Body::Brackets(item) | Body::Value(item)) = chosen.body else { return Some(()) };
        if item.kind() == Kind::Broken {
            return None;
        }
        let name = chosen.variant.name;
        let span = chosen.item.span();
        let replacement = if chosen.item.syntax() == Syntax::Ron { name.to_owned() } else { format!("\"{name}\"") };
        let mut fault =
            Diagnostic::error(codes::WRONG_TYPE, chosen.item.head(), format!("`{name}` stands alone, without values"))
                .expected(replacement.clone())
                .hint(format!("write {replacement}"));
        if chosen.item.kind() != Kind::Map || chosen.item.lexeme().starts_with('{') {
            fault.edit = Some(Edit { span, replacement });
        }
        self.report(fault);
        None
    }

    /// The one value of a variant: its fields, or what stands in its brackets.
    pub fn content<T: Words>(&mut self, chosen: &Chosen<'_, '_>) -> Option<T> {
        let at = match &chosen.variant.content {
            Content::Value(at) => at,
            _ => &NO_FIELD,
        };
        if let Type::Struct(_) = T::TYPE {
            return match chosen.body {
                Body::None => self.needs_brackets(chosen),
                Body::Brackets(item) | Body::Value(item) => T::read(self, item, at),
            };
        }
        match chosen.body {
            Body::None => self.needs_brackets(chosen),
            Body::Value(value) => self.picked(value).and_then(|value| T::read(self, value, at)),
            Body::Brackets(item) => {
                let mut children = item.solid_children();
                match (children.next(), children.next()) {
                    (None, None) if item.is_damaged() => None,
                    (Some(only), None) if item.kind() == Kind::Tuple => {
                        self.picked(only).and_then(|only| T::read(self, only, at))
                    }
                    (Some(_), Some(_)) if item.kind() == Kind::Tuple => {
                        // Translate(1, 2, 3): the vector's own brackets are missing.
                        let lexeme = item.lexeme();
                        // The name may be another program's.
                        let inner = lexeme.find('(').and_then(|open| lexeme.get(open..)).unwrap_or("").trim();
                        let replacement = format!("{}({inner})", chosen.variant.name);
                        let mut fault = Diagnostic::error(
                            codes::WRONG_COUNT,
                            item.head(),
                            format!("{} is one vector, with brackets of its own", plain(at.noun)),
                        )
                        .expected(format!("{}((x, y, z))", chosen.variant.name));
                        if item.solid_children().count() == 3 {
                            fault.hint = format!("write {}", super::hinted(&replacement));
                            fault.edit = Some(Edit { span: item.span(), replacement });
                        } else {
                            fault.hint = format!("a vector has three numbers: {}((x, y, z))", chosen.variant.name);
                        }
                        self.report(fault);
                        None
                    }
                    _ => self.wrong_kind(item, at.noun, &super::value::expected_for(at, item), None),
                }
            }
        }
    }

    fn needs_brackets<T>(&mut self, chosen: &Chosen<'_, '_>) -> Option<T> {
        let name = chosen.variant.name;
        let (expected, complete) = match (&chosen.variant.content, chosen.item.syntax()) {
            (Content::Struct(def), Syntax::Ron) => {
                (format!("{name}({})", super::field_words(def)), def.fields.iter().all(|f| f.default.is_some()))
            }
            (Content::Struct(def), syntax) => {
                let words = format!("{{ {name} = {{ {} }} }}", super::field_words(def).replace(": ..", " = .."));
                (syntax.of_toml(words).into_owned(), def.fields.iter().all(|f| f.default.is_some()))
            }
            (_, Syntax::Ron) => (format!("{name}(..)"), false),
            (_, syntax) => (syntax.of_toml(format!("{{ {name} = .. }}")).into_owned(), false),
        };
        let needs = match chosen.item.syntax() {
            Syntax::Ron => format!("`{name}` needs brackets after it"),
            Syntax::Toml => format!("`{name}` needs a table of its fields"),
            Syntax::Json => format!("`{name}` needs its fields in braces"),
        };
        let mut fault = Diagnostic::error(codes::WRONG_TYPE, chosen.item.span(), needs).expected(expected);
        match alone(chosen.variant, chosen.item.syntax()) {
            Some((replacement, _)) if complete => {
                fault.hint = format!("write {replacement} for the defaults");
                fault.edit = Some(Edit { span: chosen.item.span(), replacement });
            }
            Some((written, _)) if name == "Orthographic" => fault.hint = format!("write {written}"),
            _ => {}
        }
        self.report(fault);
        None
    }

    /// The fields of a variant.
    pub fn variant_fields<'t, 's>(&mut self, chosen: &Chosen<'t, 's>) -> Option<Fields<'t, 's>> {
        let Content::Struct(def) = chosen.variant.content else { return None };
        match chosen.body {
            Body::None => self.needs_brackets(chosen),
            Body::Brackets(item) => self.fields_unnamed(item, def),
            Body::Value(item) => {
                if let Some(bare) = def.bare
                    && !matches!(item.kind(), Kind::Struct | Kind::Map | Kind::Broken)
                {
                    let slot = def.fields.iter().position(|field| field.name == bare)?;
                    let mut fields = Fields::new(def, item);
                    fields.set(slot, item);
                    return Some(fields);
                }
                self.fields(item, def)
            }
        }
    }
}

/// A kind with the fields that it needs, and whether these are all there; `None`: it takes a value.
fn alone(variant: &VariantDef, syntax: Syntax) -> Option<(String, bool)> {
    let Content::Struct(def) = variant.content else { return None };
    let name = variant.name;
    let mut needed: Vec<&str> =
        def.fields.iter().filter(|field| field.default.is_none()).map(|field| field.name).collect();
    needed.extend(def.exactly_one.first().filter(|_| name == "ThinLens"));
    // How high the picture is nobody knows; what is written is to be seen.
    let value = |field: &str| match (name, field) {
        ("Orthographic", "height") => "8",
        ("ThinLens", "aperture") => "0.1",
        ("ThinLens", _) => "5",
        _ => "..",
    };
    let join = |between: &str| {
        needed.iter().map(|field| format!("{field}{between}{}", value(field))).collect::<Vec<_>>().join(", ")
    };
    let written = match syntax {
        Syntax::Ron => format!("{name}({})", join(": ")),
        syntax if needed.is_empty() => syntax.of_toml(format!("{{ {name} = {{}} }}")).into_owned(),
        syntax => syntax.of_toml(format!("{{ {name} = {{ {} }} }}", join(" = "))).into_owned(),
    };
    Some((written, needed.is_empty() && def.exactly_one.is_empty()))
}

/// What has a list of corners in another program, as a polygon.
fn by_corners(inner: Item<'_, '_>) -> Option<String> {
    let is_corners = |name: &str| matches!(name, "corners" | "points" | "vertices");
    let (_, points) = inner.fields().find(|(key, value)| is_corners(&key.text()) && value.kind() == Kind::List)?;
    let points = points.lexeme();
    Some(match inner.syntax() {
        Syntax::Ron => format!("Polygon(points: {points})"),
        syntax => syntax.of_toml(format!("{{ Polygon = {{ points = {points} }} }}")).into_owned(),
    })
}

/// What a choice is a choice of kinds of: the noun `kind of noise` says it itself.
pub(super) fn of_kind(def: &'static EnumDef) -> &'static str {
    def.noun.strip_prefix("kind of ").unwrap_or(def.noun)
}

/// Stands for the field of a value that is not in one.
pub(super) static NO_FIELD: crate::schema::FieldDef = crate::schema::FieldDef {
    name: "",
    noun: "this",
    doc: &[],
    kind: Type::Bool,
    rule: crate::schema::Rule::ANY,
    default: None,
};

/// The metal that a material of RON names in its brackets: `Metal(Gold)`, `Metal(preset: "gold", roughness: 0.2)`.
fn metal_of(inner: Item<'_, '_>, def: &'static EnumDef) -> Option<&'static str> {
    if inner.syntax() != Syntax::Ron || def.noun != "material" {
        return None;
    }
    let named = |item: Item<'_, '_>| {
        let is_name = matches!(item.kind(), Kind::Word | Kind::Text);
        let text = item.text();
        let mut metals = Metal::DEF.variants.iter().map(|metal| metal.name);
        metals.find(|metal| is_name && metal.eq_ignore_ascii_case(text.trim()))
    };
    let mut fields = inner.fields().take(8).map(|(_, value)| value).peekable();
    match fields.peek() {
        Some(_) => fields.find_map(named),
        None => inner.children().next().and_then(named),
    }
}

/// All that a choice may be, as it is written.
pub(crate) fn choices(def: &'static EnumDef, syntax: Syntax) -> String {
    let words: Vec<String> = def
        .variants
        .iter()
        .map(|variant| match (&variant.content, syntax) {
            (Content::Unit, Syntax::Ron) => variant.name.to_owned(),
            (Content::Unit, _) => format!("\"{}\"", variant.name),
            (_, Syntax::Ron) => format!("{}(..)", variant.name),
            (_, syntax) => syntax.of_toml(format!("{{ {} = .. }}", variant.name)).into_owned(),
        })
        .collect();
    match words.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => String::new(),
    }
}
