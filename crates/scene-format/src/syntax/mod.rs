//! The two syntaxes and how they become a [`Tree`](crate::tree::Tree).

mod arithmetic;
mod bare_numbers;
mod brackets;
pub(crate) mod decode;
pub(crate) mod foreign;
pub(crate) mod ron;
mod ron_extensions;
mod ron_literal;
mod ron_names;
mod ron_scan;
pub(crate) mod toml;
mod toml_brackets;
mod toml_lexer;
mod toml_literal;
mod toml_names;
mod toml_tables;

use crate::diagnostic::{Diagnostic, MAX_DIAGNOSTICS, Span, too_many};
use crate::files::Files;
use crate::tree::{Builder, Kind, Text, Tree};
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
}

impl Syntax {
    /// By the file name's extension: `.toml` is TOML, `.ron` is RON; `None` for others.
    pub fn from_path(path: &Path) -> Option<Syntax> {
        let extension = path.extension()?.to_str()?;
        if extension.eq_ignore_ascii_case("toml") {
            Some(Syntax::Toml)
        } else if extension.eq_ignore_ascii_case("ron") {
            Some(Syntax::Ron)
        } else {
            None
        }
    }

    /// By what the text looks like, for texts without a file name: TOML when the first thing in it is `key =` or `[header`.
    pub fn guess(text: &str) -> Syntax {
        for line in text.trim_start_matches('\u{feff}').lines().map(str::trim) {
            if line.is_empty() || line.starts_with('#') && !line.starts_with("#!") {
                continue;
            }
            let key = line.find(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-' | '.' | '"' | '\'' | ' ')));
            let is_toml = line.starts_with('[') || key.is_some_and(|at| at > 0 && line[at..].starts_with('='));
            return if is_toml { Syntax::Toml } else { Syntax::Ron };
        }
        Syntax::Ron
    }

    /// `RON` or `TOML`.
    pub fn name(self) -> &'static str {
        match self {
            Syntax::Ron => "RON",
            Syntax::Toml => "TOML",
        }
    }
}

/// Collects the diagnostics of one run, up to a limit that keeps memory in proportion to the file.
#[derive(Debug, Default)]
pub(crate) struct Sink {
    pub diagnostics: Vec<Diagnostic>,
    pub errors: usize,
    /// What files the text names.
    pub files: Files,
    full: bool,
}

impl Sink {
    /// Whether no more is taken: readers stop then.
    pub fn is_full(&self) -> bool {
        self.full
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

/// What stands on the line from a byte on, as far as a look ahead goes: a file in one line must not take quadratic time.
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

/// A span of `usize` bytes in source `source`.
pub(crate) fn span(source: u16, start: usize, end: usize) -> Span {
    Span { source: u32::from(source), start: start as u32, end: end as u32 }
}

/// The tree of a text, whatever is wrong with it.
pub(crate) fn parse<'s>(text: &'s str, syntax: Syntax, sink: &mut Sink) -> Tree<'s> {
    let mut builder = Builder::new(0);
    let errors = sink.errors;
    let (comments, added) = match syntax {
        Syntax::Ron => (ron::parse(text, &mut builder, sink), HashMap::new()),
        Syntax::Toml => toml::parse(text, &mut builder, sink),
    };
    let texts = vec![Text { text, syntax, folder: Path::new("") }];
    Tree { texts, nodes: builder.nodes, added, comments, damaged: sink.errors > errors, included: Vec::new() }
}
