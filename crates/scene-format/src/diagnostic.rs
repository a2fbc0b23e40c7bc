//! Diagnostics as data: what is wrong, where, what was expected, and how to mend it.

use crate::codes::{self, Code};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A range of bytes in one source text. `Span::NONE` stands for things that no file says (built in code, defaults).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Span {
    /// Which source of [`crate::SceneDesc::sources`] (`u32::MAX`: none).
    pub source: u32,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// No position: the value was not read from a file.
    pub const NONE: Span = Span { source: u32::MAX, start: 0, end: 0 };
}

impl Default for Span {
    fn default() -> Self {
        Span::NONE
    }
}

/// A value and where it was written.
#[derive(Clone, Debug, Default)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Where it stands.
    pub span: Span,
}

impl<T> From<T> for Spanned<T> {
    fn from(value: T) -> Self {
        Spanned { value, span: Span::NONE }
    }
}

impl From<PathBuf> for Spanned<Arc<Path>> {
    fn from(file: PathBuf) -> Self {
        Spanned::from(Arc::from(file))
    }
}

impl From<String> for Spanned<Arc<str>> {
    fn from(name: String) -> Self {
        Spanned::from(Arc::from(name))
    }
}

/// Two values are equal when they say the same, wherever they stand.
impl<T: PartialEq> PartialEq for Spanned<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T> std::ops::Deref for Spanned<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.value
    }
}

/// One text that spans point into: a scene file, an argument of `--set`, or a mesh, texture or placements file that is
/// wrong.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Source {
    /// The name to show (`scenes/fig4.ron`, `<stdin>`, `--set`).
    pub name: String,
    /// The whole text.
    pub text: String,
    /// Where another source includes this one, and what is said there.
    pub included: Option<Label>,
}

/// How grave a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Severity {
    /// The picture is made, but something is probably not what was meant.
    Warning,
    /// No picture can be made.
    Error,
}

/// A line in a file other than the scene (a mesh, a placements file), where no byte span into a [`Source`] is kept
/// because the file may be large.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileLine {
    /// The file.
    pub path: PathBuf,
    /// 1-based; 0 when the whole file is meant.
    pub line: u64,
    /// The line, where it can be shown.
    pub excerpt: Option<Excerpt>,
}

/// A line of a file that no [`Source`] holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Excerpt {
    /// The line without its end; a long one is cut.
    pub text: String,
    /// The bytes of `text` that are at fault.
    pub at: Range<usize>,
}

/// Bytes of a line that are shown, at most.
const SHOWN_BYTES: usize = 200;

impl Excerpt {
    /// The line around a byte of a text, with the word that begins there at fault. `None`: it cannot be shown, since it
    /// is no UTF-8 or the byte stands too far along it.
    pub fn around(text: &[u8], at: usize) -> Option<Excerpt> {
        // What is wrong at the end of a file is so in its last line.
        let whole = text.strip_suffix(b"\n").unwrap_or(text);
        let at = at.min(whole.len());
        let start = whole.get(..at)?.iter().rposition(|&byte| byte == b'\n').map_or(0, |newline| newline + 1);
        let line = whole.get(start..)?.split(|&byte| byte == b'\n').next()?;
        let line = line.get(..line.len().min(SHOWN_BYTES))?;
        // A character may be cut in two.
        let valid = std::str::from_utf8(line).map_or_else(|error| error.valid_up_to(), str::len);
        let line = std::str::from_utf8(line.get(..valid)?).ok()?.trim_end_matches('\r');
        let from = at - start;
        let rest = line.get(from..)?;
        let length = rest.find(char::is_whitespace).unwrap_or(rest.len());
        let shown = |c: char| if c.is_control() && c != '\t' { ' ' } else { c };
        let is_plain = line.chars().all(|c| !c.is_control() || c.is_ascii());
        is_plain.then(|| Excerpt { text: line.chars().map(shown).collect(), at: from..from + length })
    }
}

/// A replacement of the bytes of `span` that mends the fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// The bytes to replace.
    pub span: Span,
    /// What to write there.
    pub replacement: String,
}

/// A second place that belongs to a diagnostic, with a few words about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// What is there: `first written here`.
    pub text: String,
}

/// One thing that is wrong (or doubtful), with its position, what was expected and a hint.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// Error or warning.
    pub severity: Severity,
    /// Stable, documented code (`E0102`).
    pub code: Code,
    /// One sentence: what is wrong.
    pub message: String,
    /// The very value, in the scene file.
    pub span: Span,
    /// Field path (`objects[2].radius`), empty when there is none.
    pub path: String,
    /// What was expected, with unit and range; may be empty.
    pub expected: String,
    /// What to do; may be empty.
    pub hint: String,
    /// The place in another file (mesh, placements) that is at fault.
    pub elsewhere: Option<FileLine>,
    /// A change of the scene file that mends it, when one is certain enough to offer.
    pub edit: Option<Edit>,
    /// Other places that have to do with it.
    pub labels: Vec<Label>,
}

impl Diagnostic {
    /// An error with code, place and message; the rest empty.
    pub fn error(code: Code, span: Span, message: impl Into<String>) -> Self {
        Diagnostic {
            severity: Severity::Error,
            code,
            message: message.into(),
            span,
            path: String::new(),
            expected: String::new(),
            hint: String::new(),
            elsewhere: None,
            edit: None,
            labels: Vec::new(),
        }
    }

    /// A warning with code, place and message; the rest empty.
    pub fn warning(code: Code, span: Span, message: impl Into<String>) -> Self {
        Diagnostic { severity: Severity::Warning, ..Diagnostic::error(code, span, message) }
    }

    /// Adds what was expected.
    pub fn expected(mut self, expected: impl Into<String>) -> Self {
        self.expected = expected.into();
        self
    }

    /// Adds what to do.
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = hint.into();
        self
    }

    /// Adds the field path.
    pub fn at_path(mut self, path: impl Into<String>) -> Self {
        self.path = path.into();
        self
    }

    /// Adds a second place.
    pub fn label(mut self, span: Span, text: impl Into<String>) -> Self {
        self.labels.push(Label { span, text: text.into() });
        self
    }

    /// Offers `word` in place of what stands at the span, written as `written` says.
    pub(crate) fn did_you_mean(&mut self, word: Option<&str>, written: impl Fn(&str) -> String) {
        if let Some(word) = word {
            self.hint = format!("did you mean `{word}`?");
            self.edit = Some(Edit { span: self.span, replacement: written(word) });
        }
    }

    /// Adds the place in another file.
    pub fn at_line(mut self, path: impl Into<PathBuf>, line: u64) -> Self {
        self.elsewhere = Some(FileLine { path: path.into(), line, excerpt: None });
        self
    }

    /// Shows the line of the other file.
    pub fn showing(mut self, excerpt: Option<Excerpt>) -> Self {
        if let Some(file) = &mut self.elsewhere {
            file.excerpt = excerpt;
        }
        self
    }
}

/// Files within each other that are told of, at most.
const MOST_INCLUDED: usize = 256;

/// Says of a fault in an included file how one gets there, where nobody did before.
pub fn say_where_included(fault: &mut Diagnostic, sources: &[Source]) {
    let of = |span: Span| sources.get(span.source as usize).and_then(|source| source.included.as_ref());
    let mut at = fault.span;
    for _ in 0..MOST_INCLUDED {
        let Some(label) = of(at) else { return };
        let leads_out = |label: &Label| of(label.span).is_none() && label.span.source != fault.span.source;
        if fault.labels.iter().any(|known| leads_out(known) || known.span == label.span) {
            return;
        }
        at = label.span;
        fault.labels.push(label.clone());
    }
}

/// All that was found in one run, in order of position.
pub type Diagnostics = Vec<Diagnostic>;

/// More faults than this are not listed: nobody reads them, and they must not fill the memory.
pub(crate) const MAX_DIAGNOSTICS: usize = 1000;

/// That there are more faults than are listed.
pub(crate) fn too_many(span: Span) -> Diagnostic {
    Diagnostic::error(codes::TOO_MANY, span, format!("more than {MAX_DIAGNOSTICS} faults; the rest is not listed"))
        .hint("mend the first ones and run again")
}

/// Keeps the first thousand, and says so where there are more errors than that.
pub fn keep_first(diagnostics: &mut Diagnostics) {
    let Some(rest) = diagnostics.get(MAX_DIAGNOSTICS..).filter(|rest| !rest.is_empty()) else { return };
    let error = rest.iter().find(|fault| fault.severity == Severity::Error).map(|fault| too_many(fault.span));
    diagnostics.truncate(MAX_DIAGNOSTICS);
    diagnostics.extend(error);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn excerpts_are_lines_with_the_word_at_fault() {
        let of = |text: &[u8], at: usize| Excerpt::around(text, at).map(|found| (found.text, found.at));
        let line = |text: &str, at: Range<usize>| Some((text.to_owned(), at));
        assert_eq!(of(b"v 0 0\r\nv 1 x 2\n", 11), line("v 1 x 2", 4..5));
        assert_eq!(of(b"v 0 0\nv 1\n", 10), line("v 1", 3..3));
        assert_eq!(of(b"v 0 0\nv 1\n", 99), line("v 1", 3..3));
        assert_eq!(of("# \u{e4}\nf 1".as_bytes(), 7), line("f 1", 2..3));
        assert_eq!(of(b"", 0), line("", 0..0));
        // No text, and too far along the line.
        assert_eq!(of(b"\xff\xfe 1", 3), None);
        assert_eq!(of("\u{e4}".repeat(300).as_bytes(), 400), None);
        assert_eq!(of(&[b'a'; 500], 0).map(|(text, _)| text.len()), Some(SHOWN_BYTES));
    }
}
