//! From one syntax to the other, or tidied up in the same one, on the tree: so comments, the order of fields and the
//! form of values stay as the person wrote them.

use crate::codes;
use crate::desc::Scene;
use crate::diagnostic::{Diagnostic, Severity};
use crate::form::{BLANK_LINE, Entry, FILLED, Form, OWN_LINES};
use crate::load::{LoadError, load_str};
use crate::print;
use crate::read::{PICK, REPEAT, SETTINGS, is_expression, pick_body, repeat_body};
use crate::schema::{Content, EnumDef, StructDef, Type, fits};
use crate::syntax::parse;
use crate::syntax::{Sink, Syntax};
use crate::tree::{Item, Kind, Tree};
use crate::words::Words;
use std::path::Path;

/// Writes a scene in another syntax. `name` is shown in diagnostics. JSON has no comments, so a scene's own are left
/// out there: how many it has [`comments`] says.
///
/// # Errors
/// [`LoadError::Invalid`] when the scene is not right: nobody could say what to write. Faults of files that it
/// includes do not count.
pub fn convert(name: &str, text: &str, from: Syntax, to: Syntax) -> Result<String, LoadError> {
    let written = write(name, text, from, to, false)?;
    // Laid out as it would be if a person had written it so: a comment may stand elsewhere now.
    Ok(format(name, &written, to).unwrap_or(written))
}

/// How many comments a text has.
pub fn comments(text: &str, syntax: Syntax) -> usize {
    parse(text, syntax, &mut Sink::default()).comments.len()
}

/// Writes a scene as everybody's looks: what fits on a line of 120 characters on one line, else one entry a line, as in
/// RON what stood so already, its first entry not behind the bracket; with the person's comments, order and empty lines
/// (one of several). What it gives it leaves as it is. Lines end as most
/// of them did, and a byte order mark stays. `name` is shown in diagnostics.
///
/// # Errors
/// As [`convert`], but names that nobody has given, values out of range and what is missing do not count, as the rest
/// is laid out all the same.
pub fn format(name: &str, text: &str, syntax: Syntax) -> Result<String, LoadError> {
    let tidy = write(name, text, syntax, syntax, true)?;
    // Whoever has saved it so has editors that want it so.
    let mark = if text.starts_with('\u{feff}') { "\u{feff}" } else { "" };
    let of_windows = 2 * text.matches("\r\n").count() > text.matches('\n').count();
    Ok(if of_windows { format!("{mark}{}", tidy.replace('\n', "\r\n")) } else { format!("{mark}{tidy}") })
}

fn write(name: &str, text: &str, from: Syntax, to: Syntax, keeps_blanks: bool) -> Result<String, LoadError> {
    let folder = Path::new(name).parent().unwrap_or(Path::new(""));
    match load_str(name, text, from, folder, &[]) {
        // What is wrong with included files is theirs: this text says what to write.
        Err(LoadError::Invalid { diagnostics, .. })
            if diagnostics.iter().all(|fault| {
                is_of_others(fault)
                    || (from == to && is_of_values(fault))
                    || (fault.code == codes::NO_OBJECTS && is_library(text, from))
            }) => {}
        // Whichever is meant, the text stays what it is.
        Err(LoadError::Invalid { undecided: Some(_), .. }) => {}
        loaded => {
            loaded?;
        }
    }
    let mut sink = Sink::default();
    let tree = parse(text, from, &mut sink);
    let Some(root) = tree.root() else { return Ok(if from == to { text.to_owned() } else { String::new() }) };
    let blanks = keeps_blanks.then_some(0);
    let mut converter = Converter { tree: &tree, next_comment: 0, inside: Vec::new(), from, to, blanks };
    // What stands at the file's top stays there: a headline, a licence, how to render it.
    let before = match from {
        Syntax::Ron | Syntax::Json => converter.comments_before(root.span().start),
        Syntax::Toml => converter.comments_of_the_file(),
    };
    let form = converter.form(root, Scene::TYPE);
    let mut after = converter.comments_before(u32::MAX);
    after.pop_if(|last| last == BLANK_LINE);
    Ok(print::scene(&form, to, &before, &after))
}

/// Whether a fault is one of an included file, or that there is none.
fn is_of_others(fault: &Diagnostic) -> bool {
    fault.severity == Severity::Warning || fault.code == codes::INCLUDE || fault.span.source != 0
}

/// Whether a fault is one of what is written, not of how: what it is laid out as does not depend on it.
fn is_of_values(fault: &Diagnostic) -> bool {
    let names = [codes::UNKNOWN_MATERIAL, codes::UNKNOWN_NAME, codes::UNKNOWN_CAMERA, codes::UNKNOWN_MASK];
    // What is not there yet does not stand in the way of what is.
    let missing = [codes::MISSING_FIELD, codes::EXACTLY_ONE, codes::NO_OBJECTS];
    fault.code.is_value() || names.contains(&fault.code) || missing.contains(&fault.code)
}

/// Whether a text is there to be included: it has values, textures, materials, cameras or settings for other scenes,
/// and nothing to render. A background alone is a scene that somebody has begun.
pub fn is_library(text: &str, syntax: Syntax) -> bool {
    let tree = parse(text, syntax, &mut Sink::default());
    let fields = || tree.root().into_iter().flat_map(|root| root.fields().map(|(key, _)| key.text().into_owned()));
    const SHARED: [&str; 5] = ["vars", "textures", "materials", "cameras", "include"];
    let is_setting = |key: &str| SETTINGS.contains(&key);
    let is_shared = |key: &str| SHARED.contains(&key);
    fields().any(|key| is_shared(&key) || is_setting(&key) && key != "background")
        && fields().all(|key| key == "version" || is_shared(&key) || is_setting(&key))
}

struct Converter<'t, 's> {
    tree: &'t Tree<'s>,
    next_comment: usize,
    from: Syntax,
    to: Syntax,
    /// Comments within numbers that stand on one line: they move up before it.
    inside: Vec<String>,
    /// Where the last thing ended that has been taken, if empty lines are kept.
    blanks: Option<u32>,
}

impl Converter<'_, '_> {
    fn text(&self) -> &str {
        self.tree.texts.first().map_or("", |text| text.text)
    }

    /// Comments that stand before a byte and have not been taken yet.
    fn comments_before(&mut self, byte: u32) -> Vec<String> {
        let mut taken = Vec::new();
        while let Some(span) = self.tree.comments.get(self.next_comment)
            && span.start < byte
        {
            taken.extend(self.blank_before(span.start));
            let text = self.text().get(span.start as usize..span.end as usize).unwrap_or("");
            taken.extend(comment_lines(text));
            self.next_comment += 1;
            self.ended(span.end);
        }
        taken.extend(self.blank_before(byte));
        taken
    }

    /// [`BLANK_LINE`] where one stands between the last thing that was taken and a byte.
    fn blank_before(&mut self, byte: u32) -> Option<String> {
        let from = self.blanks?;
        let between = self.text().get(from as usize..(byte as usize).min(self.text().len()))?;
        let mut lines = between.split('\n');
        // What stands before the first and behind the last line's end are no whole lines.
        lines.next();
        lines.next_back();
        let blank = lines.any(|line| line.trim().is_empty());
        self.ended(byte);
        blank.then(|| BLANK_LINE.to_owned())
    }

    /// All up to this byte has been taken.
    fn ended(&mut self, byte: u32) {
        self.blanks = self.blanks.map(|last| last.max(byte));
    }

    /// The comments at the head of a TOML file, up to an empty line or the first entry: those are the file's.
    fn comments_of_the_file(&mut self) -> Vec<String> {
        let text = self.text();
        let mut end = text.len() - text.trim_start_matches('\u{feff}').trim_start().len();
        for line in text[end..].split_inclusive('\n') {
            if !line.trim_start().starts_with('#') {
                break;
            }
            end += line.len();
        }
        self.comments_before(end as u32)
    }

    /// A comment on the same line, with nothing but a comma between.
    fn comment_after(&mut self, end: u32) -> Option<String> {
        let span = self.tree.comments.get(self.next_comment)?;
        let text = self.text();
        let between = text.get(end as usize..span.start as usize)?;
        if between.bytes().any(|byte| !matches!(byte, b' ' | b'\t' | b',')) {
            return None;
        }
        let lines = comment_lines(text.get(span.start as usize..span.end as usize)?);
        let [line] = lines.as_slice() else { return None };
        let end = span.end;
        self.next_comment += 1;
        self.ended(end);
        Some(line.clone())
    }

    /// An entry with its comments.
    fn entry(&mut self, name: String, start: u32, item: Item<'_, '_>, kind: Type) -> Entry {
        self.entry_of(name, start, item, |converter| converter.form(item, kind))
    }

    /// An entry with its comments, whose value is made so.
    fn entry_of(
        &mut self,
        name: String,
        start: u32,
        item: Item<'_, '_>,
        value: impl FnOnce(&mut Self) -> Form,
    ) -> Entry {
        let mut before = self.comments_before(start);
        let end = item.span().end;
        // The fields of a TOML table follow after its header has ended.
        let header = item.children().next().is_some_and(|child| child.span().start >= end);
        let early = if header { self.comment_after(end) } else { None };
        let value = value(self);
        let inside = std::mem::take(&mut self.inside);
        before.extend(inside.into_iter().filter(|line| line != BLANK_LINE));
        self.ended(end);
        // Where its last line ends.
        let last = || item.children().last().map_or(end, |child| child.span().end.max(end));
        let late = if header { self.comment_after(last()) } else { self.comment_after(end) };
        // Only one of them can stand behind the value.
        let after = match late {
            Some(late) => {
                before.extend(early);
                Some(late)
            }
            None => early,
        };
        Entry { name: name.into(), value, before, after }
    }

    /// With the comments that stand before the bracket that closes an item, behind its last entry: what somebody has
    /// commented out there stays within.
    fn with_last_comments(&mut self, item: Item<'_, '_>, mut entries: Vec<Entry>) -> Vec<Entry> {
        if let Some(comments) = self.comments_below(item) {
            entries.push(Entry { before: comments, ..Entry::new("", Form::Absent) });
            return entries;
        }
        let Some(bracket) = item.span().end.checked_sub(1) else { return entries };
        let closes = self.text().as_bytes().get(bracket as usize).is_some_and(|byte| b")]}".contains(byte));
        if closes && self.to != Syntax::Json {
            let mut comments = self.comments_before(bracket);
            comments.pop_if(|last| last == BLANK_LINE);
            if !comments.is_empty() {
                entries.push(Entry { before: comments, ..Entry::new("", Form::Absent) });
            }
        }
        if let Some(first) = entries.first_mut().filter(|_| self.keeps_lines(item)) {
            first.before.insert(0, OWN_LINES.to_owned());
        }
        entries
    }

    /// Comments right below the last field of a table of TOML that an empty line parts from what follows.
    fn comments_below(&mut self, item: Item<'_, '_>) -> Option<Vec<String>> {
        let last = item.children().last()?.span().end;
        let of_header = self.from == Syntax::Toml && self.to != Syntax::Json && last > item.span().end;
        let taken = self.next_comment.checked_sub(1).and_then(|before| self.tree.comments.get(before));
        let (text, mut end, mut count) = (self.text(), taken.map_or(last, |taken| taken.end.max(last)), 0);
        while let Some(span) = self.tree.comments.get(self.next_comment + count).filter(|_| of_header) {
            let between = text.get(end as usize..span.start as usize)?;
            if between.matches('\n').count() != 1 || !between.trim().is_empty() {
                break;
            }
            (end, count) = (span.end, count + 1);
        }
        let apart = text.get(end as usize..)?.trim_start_matches([' ', '\t', '\r']);
        let apart = apart.is_empty() || apart.strip_prefix('\n').is_some_and(|next| next.starts_with(['\n', '\r']));
        (count > 0 && apart).then(|| self.comments_before(end))
    }

    /// Whether somebody has given the entries of an item lines of their own, the first of them not behind the bracket.
    fn keeps_lines(&self, item: Item<'_, '_>) -> bool {
        let first = item.fields().next().map(|(key, _)| key.span()).or_else(|| Some(item.children().next()?.span()));
        let before = first.and_then(|span| self.text().get(..span.start as usize)).unwrap_or("");
        self.blanks.is_some()
            && (self.from, self.to) == (Syntax::Ron, Syntax::Ron)
            && before.trim_end_matches([' ', '\t', '\r']).ends_with('\n')
    }

    fn form(&mut self, item: Item<'_, '_>, kind: Type) -> Form {
        if is_expression(item) && !matches!(kind, Type::Text | Type::File) {
            return Form::Text(item.text().into_owned());
        }
        if let Some(body) = pick_body(item) {
            return self.pick(body, kind);
        }
        if item.is_null() && self.to == Syntax::Json {
            return Form::Lexeme(item.lexeme().to_owned());
        }
        match kind.resolved() {
            Type::Value => self.of_var(item),
            Type::Bool => Form::Bool(item.lexeme() == "true"),
            Type::Number | Type::Integer => Form::Lexeme(self.number(item)),
            Type::Text | Type::File => Form::Text(item.text().into_owned()),
            Type::Pair | Type::Vector | Type::Rows => self.vector(item),
            Type::Color => match item.kind() {
                Kind::Text => Form::Text(item.text().into_owned()),
                Kind::List | Kind::Tuple => self.vector(item),
                _ => Form::Lexeme(self.number(item)),
            },
            Type::List(inner) => self.list(item, inner),
            Type::Map(inner) => {
                let entry = |(key, value): (Item<'_, '_>, _)| {
                    self.entry(key.text().into_owned(), key.span().start, value, *inner)
                };
                let entries = item.fields().map(entry).collect();
                Form::Map(self.with_shared_lines(item, entries))
            }
            Type::Struct(def) => self.fields(item, def),
            Type::Enum(def) => self.variant(item, def),
            Type::Optional(inner) => {
                if item.is_word("None") {
                    Form::word("None")
                } else {
                    self.form(item.without_some(), *inner)
                }
            }
            Type::OneOf(kinds) => {
                let item = item.without_some();
                if kind.is_texture() && item.kind() == Kind::Text {
                    return Form::Text(item.text().into_owned());
                }
                match kinds.iter().find(|kind| fits(item, kind)) {
                    Some(kind) => self.form(item, *kind),
                    None => Form::Absent,
                }
            }
            // Resolved above.
            Type::Later(_) => Form::Absent,
        }
    }

    /// The items of a list, each of this type or a `Repeat` of such.
    fn list(&mut self, item: Item<'_, '_>, inner: &'static Type) -> Form {
        let entries = item.children().map(|child| {
            let start = child.span().start;
            match repeat_body(child) {
                Some(body) => self.entry_of(String::new(), start, child, |converter| converter.repeat(body, inner)),
                None => self.entry(String::new(), start, child, *inner),
            }
        });
        let entries = entries.collect();
        Form::List(self.with_shared_lines(item, entries))
    }

    /// With its last comments, and marked where entries share lines.
    fn with_shared_lines(&mut self, item: Item<'_, '_>, entries: Vec<Entry>) -> Vec<Entry> {
        let mut entries = self.with_last_comments(item, entries);
        if let Some(first) = entries.first_mut().filter(|_| self.shares_lines(item)) {
            let own_lines = first.before.first().is_some_and(|line| line == OWN_LINES);
            first.before.insert(usize::from(own_lines), FILLED.to_owned());
        }
        entries
    }

    /// Whether some of an item's entries stand on one line.
    fn shares_lines(&self, item: Item<'_, '_>) -> bool {
        let starts =
            || item.children().filter(|child| child.kind() != Kind::Key).map(|child| child.span().start as usize);
        let shared = |(from, to): (usize, usize)| self.text().get(from..to).is_some_and(|text| !text.contains('\n'));
        self.blanks.is_some()
            && (self.from, self.to) == (Syntax::Ron, Syntax::Ron)
            && starts().zip(starts().skip(1)).any(shared)
    }

    fn repeat(&mut self, body: Item<'_, '_>, inner: &'static Type) -> Form {
        let fields = body.fields().map(|(key, value)| {
            let (name, start) = (key.text().into_owned(), key.span().start);
            match REPEAT.field(&name) {
                Some(field) if !matches!(field.kind, Type::List(_)) => self.entry(name, start, value, field.kind),
                _ => self.entry_of(name, start, value, |converter| converter.list(value, inner)),
            }
        });
        let fields = fields.collect();
        let fields = Form::Struct { name: REPEAT.name, fields: self.with_last_comments(body, fields) };
        Form::Variant { name: REPEAT.name, content: Some(Box::new(fields)) }
    }

    fn pick(&mut self, body: Item<'_, '_>, kind: Type) -> Form {
        let fields = body.fields().map(|(key, value)| {
            let (name, start) = (key.text().into_owned(), key.span().start);
            self.entry_of(name, start, value, |converter| match value.kind() {
                Kind::List => {
                    let items = value.children();
                    let items = items.map(|item| converter.entry(String::new(), item.span().start, item, kind));
                    let items = items.collect();
                    Form::List(converter.with_last_comments(value, items))
                }
                _ => converter.form(value, Type::Integer),
            })
        });
        let fields = fields.collect();
        let fields = Form::Struct { name: PICK.name, fields: self.with_last_comments(body, fields) };
        Form::Variant { name: PICK.name, content: Some(Box::new(fields)) }
    }

    fn vector(&mut self, item: Item<'_, '_>) -> Form {
        let inside = self.comments_before(item.span().end);
        self.inside.extend(inside);
        Form::Vector(item.children().map(|child| self.value(child)).collect())
    }

    /// What stands in `vars`. A list stays one, for it may have any number of items; what other syntaxes write as a
    /// list of two or three numbers is RON's pair or point.
    fn of_var(&mut self, item: Item<'_, '_>) -> Form {
        let is_number = |x: Item<'_, '_>| x.number().is_some() || is_expression(x);
        let is_point = || matches!(item.children().count(), 2 | 3) && item.children().all(is_number);
        static VALUE: Type = Type::Value;
        if let Some(body) = repeat_body(item) {
            return self.repeat(body, &VALUE);
        }
        if item.kind() != Kind::List || (self.from != Syntax::Ron && is_point()) {
            return if matches!(item.kind(), Kind::List | Kind::Tuple) { self.vector(item) } else { self.value(item) };
        }
        let entries = item
            .children()
            .map(|child| self.entry_of(String::new(), child.span().start, child, |converter| converter.of_var(child)));
        let entries = entries.collect();
        Form::List(self.with_last_comments(item, entries))
    }

    /// A number, or what may stand in its place.
    fn value(&self, item: Item<'_, '_>) -> Form {
        match item.kind() {
            Kind::Bool => Form::Bool(item.lexeme() == "true"),
            Kind::Text => Form::Text(item.text().into_owned()),
            Kind::List | Kind::Tuple => Form::Vector(item.children().map(|child| self.value(child)).collect()),
            _ => Form::Lexeme(self.number(item)),
        }
    }

    /// A number as it was written, or the same number where the other syntax does not know the form.
    fn number(&self, item: Item<'_, '_>) -> String {
        let lexeme = item.lexeme();
        let known = match self.to {
            Syntax::Ron => true,
            Syntax::Toml => crate::syntax::is_toml_number(lexeme),
            Syntax::Json => crate::syntax::is_json_number(lexeme),
        };
        if !known {
            return print::number(item.number().unwrap_or(0.0));
        }
        if self.to == Syntax::Ron { lexeme.trim_start_matches('+').to_owned() } else { lexeme.to_owned() }
    }

    fn fields(&mut self, item: Item<'_, '_>, def: &'static StructDef) -> Form {
        let fields = item
            .fields()
            .filter_map(|(key, value)| {
                let name = key.text();
                // Where the schema is, for editors of TOML and JSON.
                if name == "$schema" && def.name == "Scene" && self.to != Syntax::Ron {
                    return Some(self.entry(name.into_owned(), key.span().start, value, Type::Text));
                }
                let field = def.field(&name)?;
                // What stands before the first [[header]] of a list is said of the first item.
                let of_item = value.kind() == Kind::List && value.lexeme().starts_with("[[");
                let start = if of_item && self.to != Syntax::Toml { 0 } else { key.span().start };
                Some(self.entry(field.name.to_owned(), start, value, field.kind))
            })
            .collect();
        // What RON needs no name for keeps none.
        let unnamed = (self.from, self.to) == (Syntax::Ron, Syntax::Ron) && item.name().is_none();
        let name = if unnamed { "" } else { def.name };
        Form::Struct { name, fields: self.with_last_comments(item, fields) }
    }

    fn variant(&mut self, item: Item<'_, '_>, def: &'static EnumDef) -> Form {
        let item = item.without_some();
        let (name, body) = match item.kind() {
            Kind::Struct | Kind::Tuple => (item.name().unwrap_or_default().into(), Some(item)),
            Kind::Map => match item.fields().next() {
                Some((key, value)) => (key.text(), Some(value)),
                None => ("".into(), None),
            },
            _ if item.is_null() => ("None".into(), None),
            _ => (item.text(), None),
        };
        let Some(variant) = def.variant(&name) else { return Form::Absent };
        let content = match (&variant.content, body) {
            (Content::Struct(fields), Some(body)) => {
                let bare = fields.bare.and_then(|bare| fields.field(bare));
                // Scale(2), { Scale = 2 }: the value without the name of its field.
                let unnamed = match (body.kind(), item.kind()) {
                    (Kind::Struct | Kind::Map, _) => None,
                    (Kind::Tuple, Kind::Tuple) => body.children().next(),
                    _ => Some(body),
                };
                match (bare, unnamed) {
                    (Some(field), Some(value)) => Some(self.form(value, field.kind)),
                    _ => Some(self.fields(body, fields)),
                }
            }
            (Content::Value(at), Some(body)) => {
                let value = if item.kind() == Kind::Map { Some(body) } else { body.children().next() };
                value.map(|value| self.form(value, at.kind))
            }
            _ => None,
        };
        Form::Variant { name: variant.name, content: content.map(Box::new) }
    }
}

/// The lines of a comment without its signs.
fn comment_lines(comment: &str) -> Vec<String> {
    if let Some(block) = comment.strip_prefix("/*") {
        let block = block.strip_suffix("*/").unwrap_or(block);
        let lines = block.lines().map(|line| printable(line.trim().trim_start_matches('*').trim()));
        let lines: Vec<String> = lines.collect();
        let first = lines.iter().position(|line| !line.is_empty()).unwrap_or(0);
        let last = lines.iter().rposition(|line| !line.is_empty()).map_or(first, |last| last + 1);
        return lines[first..last].to_vec();
    }
    let text = comment.strip_prefix("//").or_else(|| comment.strip_prefix('#')).unwrap_or(comment);
    vec![printable(text.strip_prefix(' ').unwrap_or(text).trim_end())]
}

/// A comment without the control characters that TOML does not allow in one.
fn printable(comment: &str) -> String {
    comment.chars().map(|c| if c.is_control() && c != '\t' { ' ' } else { c }).collect()
}
