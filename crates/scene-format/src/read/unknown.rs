//! Fields that there are not: what is meant by them.

use super::elsewhere::{self, Fields};
use super::hints::{self, field_of_others, other_way, right_place};
use super::of_lights;
use super::pattern_fields::is_mapping;
use super::synonyms::synonyms;
use super::transforms_elsewhere;
use super::value::expected_for;
use super::{LOOK_AT, Reader, field_list, hinted, is_expression, names, pattern_fields, together, typed};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::schema::{FieldDef, StructDef, Type};
use crate::suggest;
use crate::syntax::{Syntax, declarations, decode};
use crate::tree::{Item, Kind};

/// Words that later versions of the language will give a meaning.
const RESERVED: [&str; 4] = ["repeat", "keyframes", "for", "let"];

/// What the unknown fields of one struct stand for.
#[derive(Default)]
pub(super) struct Others<'t, 's> {
    /// Fields, each with the value that was written under another name.
    pub mistyped: Vec<(&'static str, Item<'t, 's>)>,
    /// Fields that something was written for which says nothing of them: that they are missing is not told.
    pub excused: Vec<&'static str>,
}

/// A field that there is not, with its value, in what it stands.
pub(super) struct Unknown<'u, 't, 's> {
    pub key: Item<'t, 's>,
    pub value: Item<'t, 's>,
    pub name: &'u str,
    pub item: Item<'t, 's>,
    pub def: &'static StructDef,
}

/// What an unknown field stands for.
enum Meant {
    Nothing,
    /// This one: it is read as if it were written.
    Field(&'static str),
    /// These: their value says nothing of them, which is told. That they are missing need not be said too.
    Unreadable(Vec<&'static str>),
}

/// The fields of a struct that mistyped names before stand for.
type Mistyped<'t, 's> = [(&'static str, Item<'t, 's>)];

impl Unknown<'_, '_, '_> {
    /// Whether a field has a value already.
    fn is_written(&self, field: &str, mistyped: &Mistyped<'_, '_>) -> bool {
        // Another header of TOML adds to what is there.
        let lexeme = self.value.lexeme();
        let header = self.value.syntax() == Syntax::Toml
            && match self.value.kind() {
                Kind::Map => !lexeme.starts_with('{'),
                Kind::List => {
                    lexeme.strip_prefix("[[").is_some_and(|name| name.starts_with(|c: char| c.is_alphabetic()))
                }
                _ => false,
            };
        if header {
            return false;
        }
        mistyped.iter().any(|(meant, _)| *meant == field)
            || self.item.fields().take(LOOK_AT).any(|(key, _)| key.text() == field)
    }

    /// Fields of ours that may be meant, the most likely first. Only words of other programs are more than a guess.
    fn candidates(&self, mistyped: &Mistyped<'_, '_>) -> Vec<&'static str> {
        // A word of other programs is no typo of a word that happens to be near: `pos` is no `fov`.
        let known = synonyms(self.name, self.def);
        if !known.is_empty() {
            return known;
        }
        // A word of other programs is no typo of ours: `dof` is no `fov`.
        if field_of_others(self.name, self.def, self.item.syntax()).is_some() {
            return Vec::new();
        }
        let free = names(self.def).filter(|field| !self.is_written(field, mistyped));
        let near = suggest::nearest(self.name, free).into_iter();
        let any = suggest::nearest(self.name, names(self.def));
        let mut all: Vec<&'static str> = near.collect();
        all.extend(any.filter(|any| !all.contains(any)));
        all
    }

    fn suits(&self, field: &str) -> bool {
        self.def.field(field).is_some_and(|field| suits(self.value, &field.kind, field))
    }
}

impl Reader<'_> {
    /// Reports a field that there is not, unless it may be there all the same; keeps in `others` what is meant.
    pub(super) fn other_field<'t, 's>(
        &mut self,
        key: Item<'t, 's>,
        value: Item<'t, 's>,
        item: Item<'t, 's>,
        def: &'static StructDef,
        others: &mut Others<'t, 's>,
    ) {
        match &*key.text() {
            // Where the schema is, for editors.
            "$schema" if def.name == "Scene" => {}
            // Told of already.
            name if self.typed == item.index() as u32 && typed::NAMES.contains(&name) => {}
            name => {
                let unknown = Unknown { key, value, name, item, def };
                match self.unknown_field(&unknown, &others.mistyped) {
                    Meant::Field(field) => others.mistyped.push((field, value)),
                    Meant::Unreadable(fields) => others.excused.extend(fields),
                    Meant::Nothing => {}
                }
            }
        }
    }

    /// Reports a field that there is not; gives what is meant.
    fn unknown_field(&mut self, unknown: &Unknown<'_, '_, '_>, mistyped: &Mistyped<'_, '_>) -> Meant {
        let &Unknown { key, value, name, item, def } = unknown;
        let is_mapped = pattern_fields::of_mapping(name, value, item, def).is_some() || is_mapping(def);
        // A repetition over a list is told with what it is here.
        let is_loop = def.name == "Repeat" && matches!(name, "for" | "let");
        if RESERVED.contains(&name) && !(name == "repeat" && is_mapped) && !is_loop {
            self.report(reserved(name, key.span(), def));
            return Meant::Nothing;
        }
        let mut fault =
            Diagnostic::error(codes::UNKNOWN_FIELD, key.span(), format!("{} has no field `{name}`", def.noun))
                .expected(field_list(def));
        if let Some(together) = together::of(unknown) {
            if let Some(hint) = together.hint {
                fault.hint = hint;
                fault.edit = together.edit;
                self.report(fault);
            }
            return Meant::Unreadable(together.fields);
        }
        let of_sphere = || elsewhere::by_radii(name, value, item, def);
        let of_color = || self.color_of_object(name, value, def).map(|mended| (None, mended));
        if let Some((meant, mended)) = elsewhere::field_elsewhere(name, value, def).or_else(of_sphere).or_else(of_color)
        {
            return self.written_otherwise(fault, unknown, mistyped, (meant, mended));
        }
        if let Some((hint, edit)) = typed::kind_as_list(name, value, def) {
            (fault.hint, fault.edit) = (hint, edit);
            self.report(fault);
            return Meant::Nothing;
        }
        if let Some((hint, mended)) = pattern_fields::of_mapping(name, value, item, def) {
            fault.hint = hint;
            fault.edit = mended.map(|replacement| Edit { span: elsewhere::whole_field(key, value), replacement });
            self.report(fault);
            return Meant::Nothing;
        }
        if let Some(of_light) = of_lights::strength(name, def) {
            self.report(fault.hint(of_light));
            // Whatever it stands for: that there is none need not be said too.
            return Meant::Unreadable(def.exactly_one.to_vec());
        }
        if let Some(way) = self.of_others_alone(unknown) {
            self.report(fault.hint(way));
            return Meant::Nothing;
        }
        let candidates = unknown.candidates(mistyped);
        let free = |field: &&&'static str| !unknown.is_written(field, mistyped);
        if let Some(field) = candidates.iter().filter(free).find(|field| unknown.suits(field)) {
            let quoted = key.lexeme().starts_with(['"', '\'']);
            fault.did_you_mean(Some(*field), |word| if quoted { format!("\"{word}\"") } else { word.to_owned() });
            self.report(fault);
            return Meant::Field(field);
        }
        let syntax = item.syntax();
        let way = hints::clear_background(name, value)
            .map(Into::into)
            .or_else(|| transforms_elsewhere::centred(name, value, def))
            .or_else(|| other_way(name, def, syntax))
            .or_else(|| field_of_others(name, def, syntax).map(Into::into))
            .or_else(|| right_place(name, def, item).map(Into::into));
        let unreadable = candidates.iter().find(free);
        fault.hint = match (way, unreadable, candidates.first()) {
            (Some(way), ..) => way.into_owned(),
            (_, Some(field), _) => {
                let takes = def.field(field).map_or(String::new(), |field| expected_for(field, value));
                let name = Fields(syntax).name(field);
                format!("there is `{}`, which takes {takes}", name.trim_end_matches([':', '=', ' ']))
            }
            (_, None, Some(written)) => is_there(written),
            (_, None, None) => String::new(),
        };
        self.report(fault);
        match unreadable {
            Some(field) => Meant::Unreadable(vec![*field]),
            // An f-number is told in place of the aperture.
            None if name.starts_with('f') && def.field("aperture").is_some() => Meant::Unreadable(vec!["aperture"]),
            None => Meant::Nothing,
        }
    }
}

impl Reader<'_> {
    /// What says by another quantity what a field of ours says: reports the way.
    fn written_otherwise(
        &mut self,
        mut fault: Diagnostic,
        unknown: &Unknown<'_, '_, '_>,
        mistyped: &Mistyped<'_, '_>,
        (meant, mended): (Option<&'static str>, String),
    ) -> Meant {
        let &Unknown { key, value, def, .. } = unknown;
        let told = |field: &&FieldDef| {
            let begins = mended.starts_with(&Fields(value.syntax()).name(field.name));
            // The size of a picture is two fields.
            begins || def.name == "Image" && matches!(field.name, "width" | "height")
        };
        let written = |field: &&FieldDef| unknown.is_written(field.name, mistyped);
        if let Some(written) = def.fields.iter().filter(told).find(written) {
            fault.hint = is_there(written.name);
            self.report(fault);
            return Meant::Nothing;
        }
        // What is to be written need not be missed, too.
        let fields = def.fields.iter().filter(told).map(|field| field.name).collect();
        fault.hint = format!("write `{}`", hinted(&mended));
        fault.edit = Some(Edit { span: elsewhere::whole_field(key, value), replacement: mended });
        self.report(fault);
        meant.map_or(Meant::Unreadable(fields), Meant::Field)
    }

    /// What is said of a field that reads like one of ours, and is none.
    fn of_others_alone(&mut self, unknown: &Unknown<'_, '_, '_>) -> Option<String> {
        let &Unknown { key, value, name, item, def } = unknown;
        let written = |field: &str| item.fields().take(LOOK_AT).any(|(key, _)| key.text() == field);
        if def.name == "Mesh" && synonyms(name, def).contains(&"points") && written("file") {
            return Some(format!("the points of this mesh are in its `file`: remove `{name}`, or `file`"));
        }
        if def.name == "Scene" && value.syntax() == Syntax::Ron && synonyms(name, def).is_empty() {
            // `x = 3`, as values get their names elsewhere: the sign between was told.
            let (end, begin) = (key.span().end, value.span().start);
            let is_sign = |fault: &Diagnostic| {
                let span = fault.span;
                fault.code == codes::MISSING_COLON
                    && (span.source, span.start >= end, span.end <= begin) == (key.span().source, true, true)
                    && fault.edit.is_some()
            };
            let near = suggest::nearest(name, names(def)).is_some();
            let plain = matches!(value.kind(), Kind::Integer | Kind::Float | Kind::Text | Kind::Tuple | Kind::Bool);
            let told =
                self.sink.diagnostics.iter().position(is_sign).filter(|_| !near && plain && value.name().is_none())?;
            self.sink.diagnostics.remove(told);
            self.sink.errors -= 1;
            return Some(declarations::way(name, value.lexeme()));
        }
        None
    }
}

/// The fault of a word that no field has yet.
fn reserved(name: &str, at: Span, def: &'static StructDef) -> Diagnostic {
    let message = format!("`{name}` is kept for later versions of the language");
    let mut fault = Diagnostic::error(codes::RESERVED_WORD, at, message).expected(field_list(def));
    fault.hint = match name {
        "keyframes" => "what changes stands in expressions: \"=keyframes(time, 0, 1, 2, 5)\"",
        "let" => "values by name stand in `vars`",
        _ => "what a list is to hold several times is made by an item `Repeat`, with a `count` and `items`",
    }
    .to_owned();
    fault
}

/// Whether an unknown name may stand for a field.
pub(super) fn is_meant(name: &str, item: Item<'_, '_>, def: &'static StructDef, field: &str) -> bool {
    let known = synonyms(name, def);
    let written = |field: &&str| item.fields().take(LOOK_AT).any(|(key, _)| key.text() == **field);
    match known.first() {
        Some(_) => known.contains(&field),
        None => {
            suggest::nearest(name, names(def).filter(|field| !written(field)))
                .or_else(|| suggest::nearest(name, names(def)))
                == Some(field)
        }
    }
}

/// What is said of a name for something that is written already.
fn is_there(field: &str) -> String {
    format!("remove it: `{field}` is written already")
}

/// Whether a value may be one of a type: what is surely another is not. What expressions come to is not known here.
fn suits(value: Item<'_, '_>, kind: &Type, field: &FieldDef) -> bool {
    let value = value.without_some();
    let item = value.kind();
    let number = matches!(item, Kind::Integer | Kind::Float);
    let brackets = matches!(item, Kind::List | Kind::Tuple | Kind::Struct | Kind::Map);
    let unnamed = brackets && value.name().is_none();
    if item == Kind::Broken || value.is_null() {
        return true;
    }
    let expression = is_expression(value);
    match kind.resolved() {
        Type::Optional(inner) => suits(value, inner, field),
        Type::OneOf(kinds) => kinds.iter().any(|kind| suits(value, kind, field)),
        Type::Text | Type::File => matches!(item, Kind::Text | Kind::Char | Kind::Word),
        Type::Bool => expression || matches!(item, Kind::Bool | Kind::Word),
        Type::Number | Type::Integer => {
            let numeric = || decode::number(&value.text()).is_finite();
            match item {
                Kind::Text => expression || numeric(),
                Kind::Bool => false,
                _ => !unnamed || value.children().take(2).count() < 2,
            }
        }
        Type::Vector | Type::Pair => match item {
            Kind::Text | Kind::Char => expression || field.rule.direction && value.text().chars().count() < 3,
            Kind::Bool => false,
            _ => !number,
        },
        Type::Rows => brackets && value.name().is_none() && value.children().all(|row| row.name().is_none()),
        Type::Color => item != Kind::Bool,
        Type::List(inner) => {
            brackets || expression && kind.is_of_values() || matches!((item, inner), (Kind::Text, Type::File))
        }
        Type::Map(_) => brackets,
        Type::Struct(def) => def.bare.is_some() || !number && item != Kind::Bool,
        Type::Enum(_) => !number && item != Kind::Bool && (item != Kind::Text || value.syntax() != Syntax::Ron),
        _ => true,
    }
}

/// Whether a key needs no quotes in a path.
pub(super) fn is_plain(key: &str) -> bool {
    !key.is_empty() && key.chars().all(|c| c.is_alphanumeric() || c == '_')
}
