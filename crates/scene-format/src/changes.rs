//! What edits made of a text, told change by change.

use crate::diagnostic::Edit;
use crate::render::in_order;
use serde::Serialize;
use std::ops::Range;

/// One place of a text that was changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Which bytes of the text were replaced.
    pub bytes: Range<usize>,
    /// The line where it begins, from 1, as it was before all changes.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// What stood there.
    pub before: String,
    /// What stands there now.
    pub after: String,
}

/// More of a text than this is not shown.
const SHOWN: usize = 240;

impl Change {
    /// What was changed, in a few words: `` `raduis` is now `radius` ``.
    pub fn said(&self) -> String {
        let (before, after) = (shown(&self.before), shown(&self.after));
        match (before.is_empty(), after.is_empty()) {
            (true, true) => "a line end or a blank".to_owned(),
            (true, false) => format!("added `{after}`"),
            (false, true) => format!("removed `{before}`"),
            (false, false) => format!("`{before}` is now `{after}`"),
        }
    }
}

/// A change as a record, like those of diagnostics.
#[derive(Serialize)]
struct Record<'r> {
    severity: &'r str,
    code: &'r str,
    message: String,
    place: Place<'r>,
    before: &'r str,
    after: &'r str,
}

#[derive(Serialize)]
struct Place<'r> {
    file: &'r str,
    bytes: [usize; 2],
    start: Start,
}

#[derive(Serialize)]
struct Start {
    line: usize,
    column: usize,
}

impl Change {
    /// The change of a file as a JSON object in one line, beside those of diagnostics.
    pub fn json(&self, file: &str) -> String {
        let start = Start { line: self.line, column: self.column };
        let place = Place { file, bytes: [self.bytes.start, self.bytes.end], start };
        let (before, after) = (&*self.before, &*self.after);
        let record = Record { severity: "mended", code: "", message: self.said(), place, before, after };
        serde_json::to_string(&record).unwrap_or_default()
    }
}

/// A text in one line, its middle left out where it is long.
fn shown(text: &str) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let count = line.chars().count();
    if count <= SHOWN {
        return line;
    }
    let begin: String = line.chars().take(SHOWN - 62).collect();
    let end: String = line.chars().skip(count - 60).collect();
    format!("{begin} [..] {end}")
}

/// A piece of the first text, and what stands for it.
#[derive(Clone, Debug)]
struct Piece {
    bytes: Range<usize>,
    text: String,
}

/// What became of a text by edits, one after the other.
#[derive(Clone, Debug, Default)]
pub(crate) struct Changes {
    /// In order; no two of them meet.
    pieces: Vec<Piece>,
}

impl Changes {
    /// Makes edits of the text as it is now; gives the new one.
    pub fn apply(&mut self, text: &str, edits: &[Edit]) -> String {
        let mut now = text.to_owned();
        // From the last to the first, so that the others are still where they say.
        for (bytes, replacement) in in_order(text, edits).into_iter().rev() {
            if now[bytes.clone()] != *replacement {
                self.replace(&now, bytes.clone(), replacement);
                now.replace_range(bytes, replacement);
            }
        }
        now
    }

    /// Puts a text in place of these bytes of the present one, in which no edit before them was made yet.
    fn replace(&mut self, now: &str, bytes: Range<usize>, replacement: &str) {
        // What stands before the first piece that is met: (pieces, how far they moved what follows).
        let (mut first, mut moved) = (0, 0isize);
        let at = |original: usize, moved: isize| original.wrapping_add_signed(moved);
        while let Some(piece) = self.pieces.get(first) {
            let end = at(piece.bytes.start, moved) + piece.text.len();
            // What only touches stays a change of its own.
            if end > bytes.start {
                break;
            }
            moved += piece.text.len() as isize - piece.bytes.len() as isize;
            first += 1;
        }
        let (mut last, mut start, mut end) = (first, bytes.start, bytes.end);
        let mut from = bytes.start.wrapping_add_signed(-moved);
        let mut after = moved;
        while let Some(piece) = self.pieces.get(last) {
            let begin = at(piece.bytes.start, after);
            if begin >= bytes.end {
                break;
            }
            if last == first && begin < start {
                (start, from) = (begin, piece.bytes.start);
            }
            end = end.max(begin + piece.text.len());
            after += piece.text.len() as isize - piece.bytes.len() as isize;
            last += 1;
        }
        let to = end.wrapping_add_signed(-after);
        let text = format!("{}{replacement}{}", &now[start..bytes.start], &now[bytes.end..end]);
        self.pieces.splice(first..last, [Piece { bytes: from..to, text }]);
    }

    /// What was changed between the first text and the last, lines of which may have been put back.
    pub fn between(mut self, before: &str, after: &str) -> Vec<Change> {
        self.pieces.retain(|piece| before[piece.bytes.clone()] != *piece.text);
        if self.made_of(before) != after {
            self.pieces.retain(|piece| !is_put_back(before, after, &piece.bytes));
        }
        if self.made_of(before) != after {
            self.pieces = by_lines(before, after);
        }
        let (mut line, mut at) = (1, 0);
        let change = |piece: Piece| {
            line += before[at..piece.bytes.start].matches('\n').count();
            at = piece.bytes.start;
            let begin = before[..at].rfind('\n').map_or(0, |end| end + 1);
            let column = before[begin..at].trim_start_matches('\u{feff}').chars().count() + 1;
            Change {
                before: before[piece.bytes.clone()].to_owned(),
                bytes: piece.bytes,
                line,
                column,
                after: piece.text,
            }
        };
        self.pieces.into_iter().map(change).collect()
    }

    fn made_of(&self, before: &str) -> String {
        let (mut out, mut at) = (String::with_capacity(before.len()), 0);
        for piece in &self.pieces {
            out += &before[at..piece.bytes.start];
            out += &piece.text;
            at = piece.bytes.end;
        }
        out + &before[at..]
    }
}

/// Whether the lines that a piece of the first text touches are in the last one as they were, of as many lines.
fn is_put_back(before: &str, after: &str, bytes: &Range<usize>) -> bool {
    let first = before[..bytes.start].matches('\n').count();
    let count = before[bytes.clone()].matches('\n').count() + 1;
    let lines = |text| str::split_inclusive(text, '\n').skip(first).take(count);
    lines(before).eq(lines(after))
}

/// The lines that differ between two texts of as many lines, without the words at their ends that both have.
fn by_lines(before: &str, after: &str) -> Vec<Piece> {
    let mut at = 0;
    let mut pieces = Vec::new();
    for (old, new) in before.split_inclusive('\n').zip(after.split_inclusive('\n')) {
        if old != new {
            let same = |a: &mut dyn Iterator<Item = char>, b: &mut dyn Iterator<Item = char>| -> usize {
                a.zip(b).take_while(|(a, b)| a == b).map(|(a, _)| a.len_utf8()).sum()
            };
            let mut head = same(&mut old.chars(), &mut new.chars());
            head -= old[..head].chars().rev().take_while(|c| is_of_word(*c)).map(char::len_utf8).sum::<usize>();
            let mut tail = same(&mut old[head..].chars().rev(), &mut new[head..].chars().rev());
            let end = &old[old.len() - tail..];
            tail -= end.chars().take_while(|c| is_of_word(*c)).map(char::len_utf8).sum::<usize>();
            let text = new[head..new.len() - tail].to_owned();
            pieces.push(Piece { bytes: at + head..at + old.len() - tail, text });
        }
        at += old.len();
    }
    pieces
}

fn is_of_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Span;

    fn edit(start: u32, end: u32, replacement: &str) -> Edit {
        Edit { span: Span { source: 0, start, end }, replacement: replacement.to_owned() }
    }

    /// All changes in words, after these rounds of edits.
    fn told(text: &str, rounds: &[&[Edit]]) -> Vec<String> {
        let (mut changes, mut now) = (Changes::default(), text.to_owned());
        for edits in rounds {
            now = changes.apply(&now, edits);
            assert_eq!(changes.made_of(text), now);
        }
        let all = changes.between(text, &now);
        all.iter().map(|change| format!("{}:{} {}", change.line, change.column, change.said())).collect()
    }

    #[test]
    fn changes_are_told_by_their_places_in_the_first_text() {
        assert_eq!(
            told("ab\ncd ef", &[&[edit(4, 5, "xyz"), edit(0, 1, "")], &[edit(7, 9, "E")]]),
            ["1:1 removed `a`", "2:2 `d` is now `xyz`", "2:4 `ef` is now `E`"]
        );
        // What is changed again is one change.
        assert_eq!(told("one two", &[&[edit(0, 3, "three")], &[edit(2, 8, "!")]]), ["1:1 `one tw` is now `th!`"]);
        assert_eq!(told("one", &[&[edit(3, 3, ",")]]), ["1:4 added `,`"]);
        assert_eq!(told("one", &[&[edit(0, 3, "two")], &[edit(0, 3, "one")]]), [""; 0]);
        // What only touches is not, whichever is first.
        for rounds in [&[&[edit(0, 3, "two"), edit(3, 4, "(")][..]][..], &[&[edit(3, 4, "(")], &[edit(0, 3, "two")]]] {
            assert_eq!(told("one{", rounds), ["1:1 `one` is now `two`", "1:4 `{` is now `(`"]);
        }
        let long = "a b ".repeat(50);
        assert_eq!(told(&long, &[&[edit(0, 199, "c")]]), [format!("1:1 `{}` is now `c`", long.trim_end())]);
    }

    #[test]
    fn lines_that_were_put_back_are_not_told() {
        let mut changes = Changes::default();
        let now = changes.apply("a b\nc d\n", &[edit(0, 1, "x"), edit(6, 7, "y")]);
        assert_eq!(now, "x b\nc y\n");
        let kept = changes.between("a b\nc d\n", "a b\nc y\n");
        assert_eq!(kept.iter().map(|change| (change.line, change.column)).collect::<Vec<_>>(), [(2, 3)]);
        assert_eq!((&*kept[0].before, &*kept[0].after), ("d", "y"));
        // Each by whole words, where nothing else is known of it.
        let kept = Changes::default().between("radius: 1,5 + wide\n", "radius: 1.5 + tide\n");
        assert_eq!((kept.len(), &*kept[0].said()), (1, "`1,5 + wide` is now `1.5 + tide`"));
    }
}
