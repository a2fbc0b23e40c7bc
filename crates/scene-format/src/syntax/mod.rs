//! The three syntaxes and how they become a [`Tree`](crate::tree::Tree).

mod arithmetic;
mod bare_numbers;
mod brackets;
mod constructs;
pub(crate) mod declarations;
pub(crate) mod decode;
pub(crate) mod foreign;
mod from_ron;
mod json;
mod json_literal;
mod json_scan;
pub(crate) mod ron;
mod ron_brackets;
mod ron_calls;
mod ron_extensions;
pub(crate) mod ron_literal;
mod ron_misplaced;
mod ron_names;
mod ron_scan;
pub(crate) mod toml;
mod toml_brackets;
mod toml_lexer;
mod toml_literal;
mod toml_names;
mod toml_tables;
pub(crate) mod units;

use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, MAX_DIAGNOSTICS, Span, too_many};
use crate::files::Files;
use crate::tape::Tape;
use crate::tree::{Builder, Kind, Text, Tree};
use std::borrow::Cow;
use std::collections::HashMap;
use std::path::Path;

/// Brackets inside brackets deeper than this are refused, so that no file can overflow the stack.
pub(crate) const MAX_DEPTH: usize = 128;

/// The language of a scene file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Syntax {
    /// Rusty Object Notation: `Scene(camera: Camera(fov: 40))`.
    Ron,
    /// Tom's Obvious Minimal Language: `[camera]`, `fov = 40`.
    Toml,
    /// JavaScript Object Notation (RFC 8259), for programs that write scenes: `{ "camera": { "fov": 40 } }`. The
    /// values are those of TOML; `null` is `None`.
    Json,
}

impl Syntax {
    /// All of them.
    pub const ALL: [Syntax; 3] = [Syntax::Ron, Syntax::Toml, Syntax::Json];

    /// By the file name's extension, which is `.ron`, `.toml` or `.json`; `None` for others.
    pub fn from_path(path: &Path) -> Option<Syntax> {
        let extension = path.extension()?.to_str()?;
        Syntax::ALL.into_iter().find(|syntax| extension.eq_ignore_ascii_case(syntax.name()))
    }

    /// By what the text looks like, for texts without a file name: TOML when the first thing in it is `key =` or
    /// `[header`, JSON when it is `{`.
    pub fn guess(text: &str) -> Syntax {
        for line in text.trim_start_matches('\u{feff}').lines().map(str::trim) {
            if line.is_empty() || line.starts_with('#') && !line.starts_with("#!") {
                continue;
            }
            if line.starts_with('{') {
                return Syntax::Json;
            }
            let key = line.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '"' | '\'' | ' ')));
            let is_toml = line.starts_with('[') || key.is_some_and(|at| at > 0 && line[at..].starts_with('='));
            return if is_toml { Syntax::Toml } else { Syntax::Ron };
        }
        Syntax::Ron
    }

    /// `RON`, `TOML` or `JSON`.
    pub fn name(self) -> &'static str {
        match self {
            Syntax::Ron => "RON",
            Syntax::Toml => "TOML",
            Syntax::Json => "JSON",
        }
    }

    /// Words that are written in TOML, `{ Sphere = { radius = 1 } }`, in TOML or in JSON, `{ "Sphere": { "radius": 1
    /// } }`: every name before a ` = ` outside of quotes.
    pub(crate) fn of_toml(self, words: impl Into<Cow<'static, str>>) -> Cow<'static, str> {
        let words = words.into();
        if self != Syntax::Json || !words.contains(" = ") {
            return words;
        }
        let mut out = String::with_capacity(words.len() + 16);
        // Where the text between quotes ends that one is in, and where the last name begins.
        let (mut quoted, mut name) = (false, 0);
        let mut signs = words.chars().peekable();
        while let Some(sign) = signs.next() {
            match sign {
                '\\' if quoted => {
                    out.push(sign);
                    out.extend(signs.next());
                    continue;
                }
                '"' => quoted = !quoted,
                '=' if !quoted && out.ends_with(' ') && signs.peek() == Some(&' ') => {
                    out.pop();
                    out.insert(name, '"');
                    out.push_str("\":");
                    name = out.len();
                    continue;
                }
                _ => {}
            }
            out.push(sign);
            let of_name = sign == '_' || sign.is_ascii_alphanumeric();
            if !(of_name || sign == ' ' && signs.peek() == Some(&'=')) {
                name = out.len();
            }
        }
        Cow::Owned(out)
    }
}

/// Collects the diagnostics of one run, up to a limit that keeps memory in proportion to the file.
#[derive(Debug, Default)]
pub(crate) struct Sink {
    pub diagnostics: Vec<Diagnostic>,
    pub errors: usize,
    /// What files the text names.
    pub files: Files,
    /// Items that repetitions and included files have made.
    pub repeated: u64,
    full: bool,
}

impl Sink {
    /// Whether no more is taken: readers stop then.
    pub fn is_full(&self) -> bool {
        self.full
    }

    /// How badly a text was read: one that ends before its file does hides all that follows.
    pub fn cost(&self) -> (bool, usize) {
        (self.diagnostics.iter().any(|fault| fault.code == codes::TEXT_AFTER_END), self.errors)
    }

    /// Says that reading makes no sense after this fault.
    pub fn push_last(&mut self, diagnostic: Diagnostic) {
        self.push(diagnostic);
        self.full = true;
    }

    pub fn push(&mut self, diagnostic: Diagnostic) {
        if diagnostic.severity == crate::Severity::Error {
            self.errors += 1;
        }
        if self.diagnostics.len() < MAX_DIAGNOSTICS {
            self.diagnostics.push(diagnostic);
        } else if !self.full {
            self.full = true;
            self.diagnostics.push(too_many(diagnostic.span));
        }
    }
}

/// What stands on the line from a byte on, as far as a look ahead goes: a file in one line must not take quadratic
/// time.
fn line_ahead(text: &str, at: usize) -> &str {
    const LOOK_AHEAD: usize = 300;
    let mut end = text.len().min(at + LOOK_AHEAD);
    while !text.is_char_boundary(end) {
        end -= 1;
    }
    let ahead = text.get(at..end).unwrap_or("");
    ahead.split('\n').next().unwrap_or("")
}

/// Whether TOML reads this lexeme as a number.
pub(crate) fn is_toml_number(lexeme: &str) -> bool {
    matches!(toml_literal::scalar_kind(lexeme), Some(Kind::Integer | Kind::Float))
}

/// Whether JSON reads this lexeme as a number.
pub(crate) fn is_json_number(lexeme: &str) -> bool {
    json_literal::is_json_number(lexeme)
}

/// A span of `usize` bytes in source `source`.
pub(crate) fn span(source: u16, start: usize, end: usize) -> Span {
    Span { source: u32::from(source), start: start as u32, end: end as u32 }
}

/// A character that nobody sees.
fn means_nothing(found: Span, sign: char) -> Diagnostic {
    let message = format!("the character {} means nothing here", sign.escape_unicode());
    let mut fault = Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message).hint("remove it");
    fault.edit = Some(Edit { span: found, replacement: String::new() });
    fault
}

/// The tree of a text, whatever is wrong with it.
pub(crate) fn parse<'s>(text: &'s str, syntax: Syntax, sink: &mut Sink) -> Tree<'s> {
    parse_as(0, text, syntax, sink)
}

/// As [`parse`], for the text of this number.
pub(crate) fn parse_as<'s>(source: u16, text: &'s str, syntax: Syntax, sink: &mut Sink) -> Tree<'s> {
    let mut builder = Builder::new(source);
    let errors = sink.errors;
    let (comments, added) = match syntax {
        Syntax::Ron => (ron::parse(text, &mut builder, sink), HashMap::new()),
        Syntax::Toml => toml::parse(text, &mut builder, sink),
        Syntax::Json => {
            json::parse(text, &mut builder, sink);
            (Tape::default(), HashMap::new())
        }
    };
    debug_assert!(builder.is_nested(), "nodes of a subtree beyond its end: {text}");
    let texts = vec![Text { text, syntax, folder: Path::new("") }];
    Tree { texts, nodes: builder.nodes, added, comments, damaged: sink.errors > errors, ..Tree::default() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_toml_are_written_in_json() {
        for (toml, json) in [
            (
                "{ Sphere = { center = [0, 0, 0], radius = .. } }",
                r#"{ "Sphere": { "center": [0, 0, 0], "radius": .. } }"#,
            ),
            ("write it as `transform = [{ Scale = 2 }]`", r#"write it as `"transform": [{ "Scale": 2 }]`"#),
            (r#"{ Texture = { file = "a = \" b = c.png" } }"#, r#"{ "Texture": { "file": "a = \" b = c.png" } }"#),
            (r#"{ Diffuse = {"albedo": 1} }"#, r#"{ "Diffuse": {"albedo": 1} }"#),
        ] {
            assert_eq!(Syntax::Json.of_toml(toml), json);
            assert_eq!(Syntax::Toml.of_toml(toml), toml);
        }
    }

    #[test]
    fn a_syntax_is_told_by_its_first_signs() {
        let guesses = [("// x\nScene(", Syntax::Ron), ("# x\n[camera]", Syntax::Toml), ("\u{feff}\n {", Syntax::Json)];
        for (text, syntax) in guesses {
            assert_eq!(Syntax::guess(text), syntax, "{text}");
        }
        assert_eq!(Syntax::from_path(Path::new("a/b.Json")), Some(Syntax::Json));
        assert_eq!(Syntax::from_path(Path::new("a.json5")), None);
    }
}
