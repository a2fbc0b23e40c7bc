//! Diagnostics as text for people (source line, caret, what was expected, a hint) and as JSON lines for editors.
//!
//! Nothing is printed here: the functions return strings, and the caller says whether there are colours and how wide
//! the terminal is.

mod alike;
mod sarif;

pub use sarif::Sarif;

use crate::diagnostic::{Diagnostic, Edit, Severity, Source, Span};
use crate::written::in_their_syntax;
use alike::grouped;
use annotate_snippets::renderer::{DEFAULT_TERM_WIDTH, DecorStyle};
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use serde::Serialize;
use std::ops::Range;

/// How text is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// ANSI colours.
    pub color: bool,
    /// Columns of the terminal; longer source lines are cut around the caret.
    pub width: usize,
}

impl Default for Style {
    fn default() -> Self {
        Style { color: false, width: DEFAULT_TERM_WIDTH }
    }
}

/// A place in a text as editors count it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Position {
    /// 1-based.
    pub line: usize,
    /// 1-based, in characters (Unicode scalar values); a tab is one, a byte order mark none.
    pub column: usize,
}

/// Line and column of a byte.
pub fn position(text: &str, byte: usize) -> Position {
    LineIndex::new(text).position(text, byte)
}

/// Where the lines of a text begin, so that many diagnostics in a large file do not count them again and again.
struct LineIndex {
    starts: Vec<usize>,
}

impl LineIndex {
    fn new(text: &str) -> LineIndex {
        let newlines = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1);
        LineIndex { starts: std::iter::once(0).chain(newlines).collect() }
    }

    /// 0-based line of a byte.
    fn line(&self, byte: usize) -> usize {
        self.starts.partition_point(|&start| start <= byte).saturating_sub(1)
    }

    fn position(&self, text: &str, byte: usize) -> Position {
        let byte = floor(text, byte);
        let line = self.line(byte);
        let before = &text[self.starts[line]..byte];
        let before = if line == 0 { before.trim_start_matches('\u{feff}') } else { before };
        Position { line: line + 1, column: before.chars().count() + 1 }
    }

    /// The line's bytes, without its end and without a byte order mark.
    fn range(&self, text: &str, line: usize) -> Range<usize> {
        let start = self.starts.get(line).copied().unwrap_or(text.len());
        let end = self.starts.get(line + 1).copied().unwrap_or(text.len());
        let mark = if line == 0 && text.starts_with('\u{feff}') { 3 } else { 0 };
        let content = text[start..end].trim_end_matches(['\n', '\r']);
        (start + mark).min(start + content.len())..start + content.len()
    }
}

/// The nearest character boundary at or before a byte.
fn floor(text: &str, byte: usize) -> usize {
    let mut byte = byte.min(text.len());
    while !text.is_char_boundary(byte) {
        byte -= 1;
    }
    byte
}

/// A source with its lines.
struct Lines<'s> {
    source: &'s Source,
    index: LineIndex,
}

fn lines(sources: &[Source]) -> Vec<Lines<'_>> {
    sources.iter().map(|source| Lines { source, index: LineIndex::new(&source.text) }).collect()
}

impl Lines<'_> {
    fn range(&self, span: Span) -> Range<usize> {
        let start = floor(&self.source.text, span.start as usize);
        start..floor(&self.source.text, span.end as usize).max(start)
    }
}

/// All diagnostics as text, a blank line after each. Where many are alike, the first one tells of the others.
pub fn text(diagnostics: &[Diagnostic], sources: &[Source], style: Style) -> String {
    texts(diagnostics, sources, style).into_iter().map(|(_, text)| text + "\n\n").collect()
}

/// As [`text`], one by one: which diagnostic, and its text. Those that another one tells of are left out.
pub fn texts(diagnostics: &[Diagnostic], sources: &[Source], style: Style) -> Vec<(usize, String)> {
    let diagnostics = &in_their_syntax(diagnostics, sources)[..];
    let lines = lines(sources);
    let renderer = if style.color { Renderer::styled() } else { Renderer::plain() };
    let renderer = renderer.term_width(style.width.max(40)).decor_style(DecorStyle::Ascii);
    let others = grouped(diagnostics, &lines);
    let told = diagnostics.iter().zip(&others).enumerate();
    told.filter_map(|(index, (diagnostic, others))| {
        Some((index, without_nameless(renderer.render(&[group(diagnostic, &lines, others.as_ref()?)]))))
    })
    .collect()
}

/// A text without the line where the renderer names the file of an excerpt that has no name: of a line that was cut,
/// its name stands above.
fn without_nameless(text: String) -> String {
    let is_nameless = |line: &str| {
        let mut colored = false;
        let shown = line.chars().filter(|&c| {
            colored |= c == '\u{1b}';
            let plain = !colored;
            colored &= c != 'm';
            plain && !c.is_whitespace()
        });
        shown.eq(":::".chars())
    };
    if !text.contains(":::") {
        return text;
    }
    let lines: Vec<&str> = text.lines().filter(|line| !is_nameless(line)).collect();
    lines.join("\n")
}

/// A piece of a source that is shown: whole lines, long ones cut.
struct Excerpt {
    text: String,
    /// 1-based number of its first line.
    line: usize,
    /// For each line: where it begins in the source, and where in `text`.
    offsets: Vec<(Range<usize>, usize)>,
    /// Whether a line was cut.
    cut: bool,
}

/// Source lines longer than this are cut around what they are shown for.
const LONG_LINE: usize = 20_000;
/// Two places this many lines apart are shown in one excerpt.
const NEAR_LINES: usize = 200;
/// A place over more lines than this is shown by its first line.
const TALL: usize = 3;

impl Excerpt {
    fn new(lines: &Lines<'_>, first: usize, last: usize, focus: &[Range<usize>]) -> Excerpt {
        let text = &lines.source.text;
        let mut excerpt = Excerpt { text: String::new(), line: first + 1, offsets: Vec::new(), cut: false };
        for line in first..=last {
            let mut range = lines.index.range(text, line);
            if range.len() > LONG_LINE {
                excerpt.cut = true;
                let wanted = focus.iter().find(|focus| focus.start >= range.start && focus.start <= range.end);
                let centre = wanted.map_or(range.start, |focus| focus.start);
                let start = floor(text, centre.saturating_sub(LONG_LINE / 2).max(range.start));
                range = start..floor(text, (centre + LONG_LINE / 2).min(range.end));
            }
            excerpt.offsets.push((range.clone(), excerpt.text.len()));
            // What would spoil the line or the terminal is shown as a sign.
            excerpt.text.extend(text[range].chars().map(|c| if c.is_control() && c != '\t' { '\u{fffd}' } else { c }));
            excerpt.text.push('\n');
        }
        excerpt
    }

    /// A byte of the source as a byte of the excerpt.
    fn byte(&self, source: &str, byte: usize) -> usize {
        for (range, offset) in self.offsets.iter().rev() {
            if byte >= range.start {
                let end = byte.min(range.end);
                let shown = |c: char| if c.is_control() && c != '\t' { '\u{fffd}' } else { c };
                return offset + source[range.start..end].chars().map(|c| shown(c).len_utf8()).sum::<usize>();
            }
        }
        0
    }

    fn range(&self, source: &str, range: &Range<usize>) -> Range<usize> {
        let start = self.byte(source, range.start);
        start..self.byte(source, range.end).max(start)
    }
}

fn group<'g>(diagnostic: &'g Diagnostic, lines: &'g [Lines<'g>], others: &'g str) -> Group<'g> {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let mut group = Group::with_title(level.primary_title(&diagnostic.message).id(diagnostic.code.as_str()));
    if let Some(source) = lines.get(diagnostic.span.source as usize) {
        for element in snippets(diagnostic, source) {
            group = match element {
                Element::Origin(origin) => group.element(origin),
                Element::Snippet(snippet) => group.element(snippet),
            };
        }
    }
    for label in diagnostic.labels.iter().filter(|label| label.span.source != diagnostic.span.source) {
        if let Some(source) = lines.get(label.span.source as usize) {
            let position = source.index.position(&source.source.text, source.range(label.span).start);
            let place = format!("{}:{}:{}: {}", source.source.name, position.line, position.column, label.text);
            group = group.element(Level::NOTE.with_name(Some("from")).message(place));
        }
    }
    if let Some(file) = &diagnostic.elsewhere {
        let path = file.path.display().to_string();
        group = match &file.excerpt {
            Some(excerpt) => {
                let annotation = AnnotationKind::Primary.span(excerpt.at.clone());
                let snippet = Snippet::source(excerpt.text.as_str()).line_start(file.line as usize);
                group.element(snippet.path(path).annotation(annotation))
            }
            None => {
                let place = if file.line == 0 { path } else { format!("{path}:{}", file.line) };
                group.element(Level::NOTE.with_name(Some("in")).message(place))
            }
        };
    }
    if !diagnostic.expected.is_empty() {
        group = group.element(Level::NOTE.with_name(Some("expected")).message(&diagnostic.expected));
    }
    if !diagnostic.hint.is_empty() {
        group = group.element(Level::HELP.with_name(Some("hint")).message(&diagnostic.hint));
    }
    if !others.is_empty() {
        group = group.element(Level::NOTE.with_name(Some("and")).message(others));
    }
    group
}

enum Element<'g> {
    Origin(Origin<'g>),
    Snippet(Snippet<'g, annotate_snippets::Annotation<'g>>),
}

/// The source lines of a diagnostic: one piece where its places stand together, else one for each.
fn snippets<'g>(diagnostic: &'g Diagnostic, source: &'g Lines<'g>) -> Vec<Element<'g>> {
    let text = &source.source.text;
    let mut places = vec![(source.range(diagnostic.span), None)];
    for label in diagnostic.labels.iter().filter(|label| label.span.source == diagnostic.span.source) {
        places.push((source.range(label.span), Some(label.text.as_str())));
    }
    let line_of = |range: &Range<usize>| {
        let first = source.index.line(range.start);
        (first, source.index.line(range.end.max(range.start + 1) - 1).clamp(first, first + TALL - 1))
    };
    let name = source.source.name.as_str();
    let mut elements = Vec::new();
    let mut rest = places;
    while !rest.is_empty() {
        let mut taken = vec![rest.remove(0)];
        let (mut first, mut last) = line_of(&taken[0].0);
        while let Some(near) = rest.iter().position(|(range, _)| {
            let (start, end) = line_of(range);
            start <= last + NEAR_LINES && end + NEAR_LINES >= first
        }) {
            let place = rest.remove(near);
            let (start, end) = line_of(&place.0);
            (first, last) = (first.min(start), last.max(end));
            taken.push(place);
        }
        let focus: Vec<Range<usize>> = taken.iter().map(|(range, _)| range.clone()).collect();
        let excerpt = Excerpt::new(source, first, last, &focus);
        let annotations: Vec<_> = taken
            .iter()
            .map(|(range, label)| {
                let kind = if label.is_none() { AnnotationKind::Primary } else { AnnotationKind::Context };
                kind.span(excerpt.range(text, range)).label(*label)
            })
            .collect();
        let mut snippet = Snippet::source(excerpt.text).line_start(excerpt.line).annotations(annotations);
        if excerpt.cut {
            // The renderer counts columns in what it is given: of a cut line only we know them.
            let position = source.index.position(text, focus[0].start);
            elements.push(Element::Origin(Origin::path(name).line(position.line).char_column(position.column)));
        } else {
            snippet = snippet.path(name);
        }
        elements.push(Element::Snippet(snippet));
    }
    elements
}

#[derive(Serialize)]
struct JsonDiagnostic<'d> {
    severity: &'static str,
    code: &'static str,
    message: &'d str,
    path: &'d str,
    #[serde(flatten)]
    place: Option<JsonPlace<'d>>,
    expected: &'d str,
    hint: &'d str,
    labels: Vec<JsonLabel<'d>>,
    elsewhere: Option<JsonElsewhere>,
    edit: Option<JsonEdit<'d>>,
}

/// A span in all the ways that editors count.
#[derive(Serialize)]
struct JsonPlace<'d> {
    file: &'d str,
    /// Bytes from the file's beginning.
    bytes: [usize; 2],
    start: JsonPosition,
    end: JsonPosition,
}

#[derive(Serialize)]
struct JsonPosition {
    line: usize,
    column: usize,
}

#[derive(Serialize)]
struct JsonLabel<'d> {
    #[serde(flatten)]
    place: Option<JsonPlace<'d>>,
    message: &'d str,
}

#[derive(Serialize)]
struct JsonElsewhere {
    file: String,
    line: u64,
}

#[derive(Serialize)]
struct JsonEdit<'d> {
    #[serde(flatten)]
    place: Option<JsonPlace<'d>>,
    replacement: &'d str,
}

/// What is no diagnostic of a text, a file that is not there, say, as such an object: an error without a code and a
/// place.
pub fn json_error(message: &str) -> String {
    let object = JsonDiagnostic {
        severity: "error",
        code: "",
        message,
        path: "",
        place: None,
        expected: "",
        hint: "",
        labels: Vec::new(),
        elsewhere: None,
        edit: None,
    };
    // As below.
    serde_json::to_string(&object).unwrap_or_default()
}

/// All diagnostics as JSON, one object a line. Lines and columns count from 1 (columns in characters), bytes from 0;
/// `end` is one past the last.
pub fn json_lines(diagnostics: &[Diagnostic], sources: &[Source]) -> String {
    let diagnostics = &in_their_syntax(diagnostics, sources)[..];
    let lines = lines(sources);
    let place = |span: Span| -> Option<JsonPlace<'_>> {
        let source = lines.get(span.source as usize)?;
        let range = source.range(span);
        let position = |byte| {
            let position = source.index.position(&source.source.text, byte);
            JsonPosition { line: position.line, column: position.column }
        };
        Some(JsonPlace {
            file: &source.source.name,
            bytes: [range.start, range.end],
            start: position(range.start),
            end: position(range.end),
        })
    };
    let mut out = String::new();
    for diagnostic in diagnostics {
        let object = JsonDiagnostic {
            severity: match diagnostic.severity {
                Severity::Error => "error",
                Severity::Warning => "warning",
            },
            code: diagnostic.code.as_str(),
            message: &diagnostic.message,
            path: &diagnostic.path,
            place: place(diagnostic.span),
            expected: &diagnostic.expected,
            hint: &diagnostic.hint,
            labels: diagnostic
                .labels
                .iter()
                .map(|label| JsonLabel { place: place(label.span), message: &label.text })
                .collect(),
            elsewhere: diagnostic
                .elsewhere
                .as_ref()
                .map(|file| JsonElsewhere { file: file.path.display().to_string(), line: file.line }),
            edit: diagnostic
                .edit
                .as_ref()
                .map(|Edit { span, replacement }| JsonEdit { place: place(*span), replacement }),
        };
        // Strings and numbers only: this cannot fail.
        out.push_str(&serde_json::to_string(&object).unwrap_or_default());
        out.push('\n');
    }
    out
}

/// All diagnostics as annotations that GitHub's Actions show in the changed lines of a pull request: one workflow
/// command a line.
pub fn github_lines(diagnostics: &[Diagnostic], sources: &[Source]) -> String {
    let diagnostics = &in_their_syntax(diagnostics, sources)[..];
    // As the runner decodes them.
    let escaped = |text: &str| text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A");
    let property = |text: &str| escaped(text).replace(':', "%3A").replace(',', "%2C");
    let lines = lines(sources);
    let mut out = String::new();
    for diagnostic in diagnostics {
        let command = match diagnostic.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
        };
        out.push_str(&format!("::{command} title={}", property(diagnostic.code.as_str())));
        if let Some(elsewhere) = &diagnostic.elsewhere {
            let file = property(&elsewhere.path.display().to_string());
            out.push_str(&format!(",file={file},line={}", elsewhere.line.max(1)));
        } else if let Some(source) = lines.get(diagnostic.span.source as usize) {
            let range = source.range(diagnostic.span);
            let start = source.index.position(&source.source.text, range.start);
            let end = source.index.position(&source.source.text, range.end);
            let file = property(&source.source.name);
            out.push_str(&format!(",file={file},line={},col={}", start.line, start.column));
            out.push_str(&format!(",endLine={},endColumn={}", end.line, end.column));
        }
        let mut message = diagnostic.message.clone();
        for (what, text) in [("expected", &diagnostic.expected), ("hint", &diagnostic.hint)] {
            if !text.is_empty() {
                message.push_str(&format!("\n{what}: {text}"));
            }
        }
        out.push_str(&format!("::{}\n", escaped(&message)));
    }
    out
}

/// A text with edits made, those that overlap an earlier one left out. For editors that mend a file, and for tests.
pub fn apply_edits(text: &str, edits: &[Edit]) -> String {
    let mut out = String::with_capacity(text.len());
    let mut at = 0;
    for (bytes, replacement) in in_order(text, edits) {
        out.push_str(&text[at..bytes.start]);
        out.push_str(replacement);
        at = bytes.end;
    }
    out.push_str(&text[at..]);
    out
}

/// The edits in the order of the text, without those that begin before the one before them ends.
pub(crate) fn in_order<'e>(text: &str, edits: &'e [Edit]) -> Vec<(Range<usize>, &'e str)> {
    let mut sorted: Vec<&Edit> = edits.iter().collect();
    sorted.sort_by_key(|edit| edit.span);
    let mut at = 0;
    let mut all = Vec::with_capacity(sorted.len());
    for edit in sorted {
        let (start, end) = (floor(text, edit.span.start as usize), floor(text, edit.span.end as usize));
        if start >= at {
            at = end.max(start);
            all.push((start..at, edit.replacement.as_str()));
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LoadError, Syntax, load_str};
    use std::path::Path;

    fn faults(source: &str) -> (Vec<Diagnostic>, Vec<Source>) {
        match load_str("s.ron", source, Syntax::Ron, Path::new(""), &[]) {
            Err(LoadError::Invalid { diagnostics, sources, .. }) => (diagnostics, sources),
            other => panic!("the scene is wrong: {other:?}"),
        }
    }

    const BROKEN: &str = "Scene(\r\n\tobjects: [/* é🐈 */ Sphere(center: (0, 0, 0), radus: 1)],\r\n)";

    #[test]
    fn columns_count_characters_after_tabs_line_ends_and_marks() {
        let text = "\u{feff}a\r\n\té🐈x";
        assert_eq!(position(text, 3), Position { line: 1, column: 1 });
        let x = text.find('x').expect("x");
        assert_eq!(position(text, x), Position { line: 2, column: 4 });
        assert_eq!(position(text, 1000), Position { line: 2, column: 5 });
    }

    #[test]
    fn json_says_where_in_bytes_lines_and_columns_and_how_to_mend() {
        let (diagnostics, sources) = faults(BROKEN);
        let lines = json_lines(&diagnostics, &sources);
        let object: serde_json::Value = serde_json::from_str(lines.trim()).expect("one object");
        let at = BROKEN.find("radus").expect("the word");
        assert_eq!(object["severity"], "error");
        assert_eq!(object["code"], "E0201");
        assert_eq!(object["file"], "s.ron");
        assert_eq!(object["path"], "objects[0]");
        assert_eq!(object["bytes"], serde_json::json!([at, at + 5]));
        assert_eq!(object["start"], serde_json::json!({ "line": 2, "column": 47 }));
        assert_eq!(object["end"], serde_json::json!({ "line": 2, "column": 52 }));
        assert_eq!(object["edit"]["replacement"], "radius");
        assert_eq!(object["edit"]["bytes"], object["bytes"]);
    }

    #[test]
    fn text_carries_colours_only_when_asked() {
        let (diagnostics, sources) = faults(BROKEN);
        assert!(!text(&diagnostics, &sources, Style::default()).contains('\u{1b}'));
        assert!(text(&diagnostics, &sources, Style { color: true, width: 80 }).contains("\u{1b}["));
    }

    #[test]
    fn many_faults_that_are_alike_are_told_once_with_their_lines() {
        let spheres = "Sphere(center: (0, 0, 0), radus: 1),\n".repeat(200);
        let (diagnostics, sources) = faults(&format!("Scene(objects: [\n{spheres}])"));
        assert_eq!(diagnostics.len(), 200, "editors get all of them");
        let shown = text(&diagnostics, &sources, Style::default());
        assert_eq!(shown.matches("no field `radus`").count(), 1, "{shown}");
        assert!(shown.contains("and: 199 more like this, on lines 3, 4, 5, 6, 7, 8, 9, 10 .. 201"), "{shown}");
        let shown = text(&diagnostics[..3], &sources, Style::default());
        assert_eq!(shown.matches("no field `radus`").count(), 3, "three are few: {shown}");
    }

    #[test]
    fn narrow_terminals_get_the_caret_and_its_word() {
        let spheres = "Sphere(center: (0, 0, 0), radius: 1), ".repeat(20);
        let (diagnostics, sources) =
            faults(&format!("Scene(objects: [{spheres}Sphere(center: (0, 0, 0), radius: -7)])"));
        let shown = text(&diagnostics, &sources, Style { color: false, width: 50 });
        let lines: Vec<&str> = shown.lines().collect();
        let source = lines.iter().position(|line| line.contains("radius: -7")).expect("the value is shown");
        assert!(lines[source].chars().count() <= 70, "{shown}");
        let column = lines[source + 1].find("^^").expect("a caret");
        assert_eq!(lines[source].get(column..column + 2), Some("-7"), "{shown}");
    }

    #[test]
    fn a_diagnostic_of_another_file_names_it() {
        let fault =
            Diagnostic::error(crate::codes::BROKEN_MESH, Span::NONE, "the mesh is broken").at_line("cat.obj", 7);
        let shown = text(&[fault], &[], Style::default());
        assert!(shown.contains("error[E0510]: the mesh is broken") && shown.contains("in: cat.obj:7"), "{shown}");
    }

    #[test]
    fn edits_are_made_from_front_to_back_and_overlaps_left_out() {
        let edit = |start, end, text: &str| Edit { span: Span { source: 0, start, end }, replacement: text.to_owned() };
        assert_eq!(apply_edits("abcdef", &[edit(4, 5, "X"), edit(0, 2, ""), edit(1, 3, "Y")]), "cdXf");
    }
}
