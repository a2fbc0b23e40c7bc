//! RON into the tree, with recovery: a fault is reported where it stands, and reading goes on at the next comma or
//! bracket.

use super::brackets::{self, Fate, Open};
use super::{MAX_DEPTH, Sink, arithmetic};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit, Span};
use crate::expression;
use crate::tape::Tape;
use crate::tree::{Builder, Kind};

/// Reads one text into `builder`; returns the comments.
pub(crate) fn parse(text: &str, builder: &mut Builder, sink: &mut Sink) -> Tape<Span> {
    let (mut comments, mut faults) = attempt(text, builder, Trust::Brackets);
    if faults.diagnostics.iter().any(|fault| brackets::CODES.contains(&fault.code)) {
        // Brackets do not match: where the lines are indented, that may say better what was meant. One tree at a time,
        // for a large file's tree is large.
        let cost = faults.cost();
        drop((comments, faults));
        (comments, faults) = attempt(text, builder, Trust::Indentation);
        if faults.cost() > cost {
            drop((comments, faults));
            (comments, faults) = attempt(text, builder, Trust::Brackets);
        }
    }
    faults.diagnostics.into_iter().for_each(|fault| sink.push(fault));
    comments
}

fn attempt(text: &str, builder: &mut Builder, trust: Trust) -> (Tape<Span>, Sink) {
    builder.nodes.truncate(0);
    let mut sink = Sink::default();
    let mut parser = Parser::new(text, 0, trust, builder, &mut sink);
    parser.document();
    (parser.comments, sink)
}

/// Reads a value that stands at `start..` of `text` (an argument of `--set`).
pub(crate) fn parse_from(text: &str, start: usize, builder: &mut Builder, sink: &mut Sink) {
    let mut parser = Parser::new(text, start, Trust::Brackets, builder, sink);
    parser.trivia();
    parser.value();
    parser.end_of_text();
}

/// What tells where a bracket that is never closed should have ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Trust {
    /// Closing brackets alone.
    Brackets,
    /// Also lines that are indented no deeper than the line where the bracket was opened.
    Indentation,
}

pub(super) struct Parser<'p> {
    pub text: &'p str,
    pub at: usize,
    pub builder: &'p mut Builder,
    pub sink: &'p mut Sink,
    pub comments: Tape<Span>,
    /// Brackets that are open, outermost first.
    pub open: Vec<Open>,
    /// Whether an open bracket was reported at the end of the file.
    pub at_end_reported: bool,
    /// The comma after the entry was read already, inside a bracket that was never closed.
    pub separated: bool,
    /// The node of the field name that was read last, with its value, of the innermost bracket that is open if that has
    /// fields.
    pub last_field: usize,
    trust: Trust,
    /// Where the current line begins, and how far its first word is indented.
    pub line: usize,
    pub indent: usize,
}

/// What the entries of a bracket have been so far.
#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Unknown,
    Named,
    Positional,
    /// Both, which has been reported.
    Mixed,
}

impl<'p> Parser<'p> {
    fn new(text: &'p str, at: usize, trust: Trust, builder: &'p mut Builder, sink: &'p mut Sink) -> Parser<'p> {
        Parser {
            text,
            at,
            builder,
            sink,
            comments: Tape::default(),
            open: Vec::new(),
            at_end_reported: false,
            separated: false,
            last_field: usize::MAX,
            trust,
            line: 0,
            indent: 0,
        }
    }

    fn document(&mut self) {
        if self.text.starts_with('\u{feff}') {
            self.at = 3;
        }
        self.trivia();
        while self.rest().starts_with("#!") {
            self.extensions();
            self.trivia();
        }
        if self.at == self.text.len() {
            return; // An empty file: the reader says what a scene needs.
        }
        self.value();
        self.end_of_text();
    }

    fn end_of_text(&mut self) {
        self.trivia();
        if self.at < self.text.len() {
            let start = self.at;
            let end = start + self.rest().trim_end().lines().next().map_or(1, |line| line.trim_end().len());
            if matches!(self.peek(), Some(b')' | b']' | b'}')) {
                self.sink.push(brackets::stray(self.text, self.builder.source, start));
                return;
            }
            if let Some(sign) = self.rest().chars().next().filter(|c| c.is_control()) {
                return self.sink.push(super::means_nothing(self.span(start, start + sign.len_utf8()), sign));
            }
            let found = self.span(start, end);
            self.sink.push(
                Diagnostic::error(codes::TEXT_AFTER_END, found, "the scene ended before this")
                    .expected("the end of the file, after the bracket that closes the scene")
                    .hint("remove what follows, or the bracket that ended the scene too early"),
            );
        }
    }

    /// One value; always exactly one node (with its children), `Broken` where nothing could be read.
    pub(super) fn value(&mut self) {
        let start = self.at;
        match self.peek() {
            None | Some(b',' | b')' | b']' | b'}') => {
                let found = self.span(start, start);
                self.sink.push(
                    Diagnostic::error(codes::MISSING_VALUE, found, "a value is missing here")
                        .hint("write a value, or remove the name before it to get the default"),
                );
                self.builder.leaf(Kind::Broken, start, start);
            }
            Some(b'(') => self.bracket(start, b'('),
            Some(b'[') => self.bracket(start, b'['),
            Some(b'{') if self.name_elsewhere(start) => {}
            Some(b'{') => self.bracket(start, b'{'),
            Some(b'"') => self.text_or_kind(start),
            Some(b'.' | b'/') if ["../", "./", "/"].iter().any(|head| self.rest().starts_with(head)) => {
                self.word(start)
            }
            Some(b'\'') => self.char_literal(),
            Some(b'0'..=b'9' | b'+' | b'-' | b'.') => self.number_literal(),
            Some(b'r') if self.is_raw_text() => self.raw_text_literal(),
            Some(b'r') if self.is_raw_word() => {
                self.at += 2;
                self.value();
            }
            _ if self.construct_elsewhere() => {}
            _ => {
                let length = self.word_length();
                if length == 0 {
                    return self.unexpected();
                }
                let word = &self.text[start..start + length];
                // Words are followed by a bracket or a comma nearly always: nothing else is asked of those.
                let after = &self.text[start + length..];
                let plain = matches!(after.as_bytes().first(), Some(b'(' | b',' | b')' | b']' | b'\n'));
                if !plain && self.call_elsewhere(start) {
                    return;
                }
                let reckoned = !plain && (arithmetic::reckons(after) || arithmetic::chooses(after));
                let called = || after.trim_start().starts_with('(') || expression::function(word).is_none();
                if (expression::is_known(word) && called() || reckoned) && self.arithmetic(start) {
                    return;
                }
                self.at += length;
                match word {
                    _ if self.peek() == Some(b'<') && self.angle_brackets(start) => {}
                    "true" | "false" => self.builder.leaf(Kind::Bool, start, self.at),
                    "inf" | "NaN" | "nan" | "infinity" => self.builder.leaf(Kind::Float, start, self.at),
                    _ => {
                        let (resume, comments) = (self.at, self.comments.len());
                        self.trivia();
                        let same_line = resume >= self.line;
                        let kind = self.text[start..].starts_with(|c: char| c.is_uppercase());
                        if let Some(bracket @ (b'(' | b'[' | b'{')) = self.peek()
                            && (bracket == b'(' || same_line && kind)
                        {
                            self.bracket(start, bracket);
                        } else {
                            self.at = resume;
                            self.comments.truncate(comments);
                            self.word(start);
                        }
                    }
                }
            }
        }
    }

    /// `mirror 0.5` or `glossy tabby`, a name of several words without its quotes: its length.
    fn name_of_words(&self, start: usize) -> Option<usize> {
        if self.peek() != Some(b' ') {
            return None;
        }
        let line = super::line_ahead(self.text, start);
        let name = line.split([',', ')', ']', '}', '/']).next()?.trim_end();
        let of_name = |word: &str| {
            word.starts_with(|c: char| c.is_lowercase() || c.is_ascii_digit())
                && word.bytes().all(|byte| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'-' | b'.'))
        };
        (name.contains(' ') && name.split(' ').filter(|word| !word.is_empty()).all(of_name)).then_some(name.len())
    }

    /// A bare word, or a text that has no quotes: `cat.obj`.
    fn word(&mut self, start: usize) {
        let end = self.at;
        if let Some(length) = self.name_of_words(start) {
            return self.text_without_quotes(start, start + length);
        }
        if !matches!(self.peek(), Some(b'.' | b'"' | b'/' | b'\\' | b'-'))
            || self.rest().starts_with("//")
            || self.rest().starts_with("/*")
        {
            return self.builder.leaf(Kind::Word, start, end);
        }
        let rest = &self.text[start..];
        let length = rest.find([',', ')', ']', '}', ' ', '\t', '\r', '\n']).unwrap_or(rest.len());
        self.text_without_quotes(start, start + length);
    }

    /// A text that has no quotes stands here.
    fn text_without_quotes(&mut self, start: usize, end: usize) {
        self.at = end;
        let text = self.text[start..end].trim_end_matches('"');
        if let Some(name) = text.strip_prefix("vars.").filter(|name| expression::is_name(name)) {
            let name = name.to_owned();
            return self.named_value(start, end, &name);
        }
        if let Some((body, length)) = arithmetic::of_languages(super::line_ahead(self.text, start)) {
            // Whether an angle was meant, and in which unit, nobody knows: no edit is certain.
            self.at = start + length;
            let fault = arithmetic::without_quotes(&body, self.span(start, self.at));
            let hint = format!("{}; angles are in degrees", fault.hint);
            self.sink.push(Diagnostic { edit: None, hint, ..fault });
            return self.builder.leaf(Kind::Broken, start, self.at);
        }
        // By their names things are known without the map that they stand in.
        let of_map = ["materials.", "textures.", "cameras."].iter().find_map(|map| text.strip_prefix(map));
        let meant = of_map.filter(|name| expression::is_name(name)).unwrap_or(text);
        // Between quotes a backslash would begin a sign.
        let slashed = meant.replace('\\', "/");
        let found = self.span(start, self.at);
        let mut fault =
            Diagnostic::error(codes::WORD_NOT_QUOTED, found, format!("the text `{text}` is not between quotes"))
                .hint(format!("write \"{slashed}\""));
        fault.edit = Some(Edit { span: found, replacement: format!("\"{slashed}\"") });
        self.sink.push(fault);
        self.builder.leaf(Kind::Broken, start, self.at);
    }

    fn unexpected(&mut self) {
        let start = self.at;
        if self.angle_brackets(start) || self.bare_expression(start) {
            return;
        }
        if matches!(self.peek(), Some(b'$' | b'@' | b'%')) && self.name_elsewhere(start) {
            return;
        }
        let character = self.rest().chars().next().unwrap_or(' ');
        let found = self.span(start, start + character.len_utf8());
        let message = format!("a value cannot begin with `{}`", character.escape_debug());
        let mut fault = match character.is_control() {
            true => super::means_nothing(found, character),
            false => Diagnostic::error(codes::UNEXPECTED_CHARACTER, found, message)
                .expected("a number, a \"text\", a word, or one of ( [ {"),
        };
        let after = &self.rest()[character.len_utf8()..];
        if matches!(character, '−' | '–' | '—' | '＋') && after.starts_with(|c: char| c.is_ascii_digit() || c == '.')
        {
            let sign = if character == '＋' { "+" } else { "-" };
            fault = fault.hint(format!("write a plain `{sign}`"));
            fault.edit = Some(Edit { span: found, replacement: sign.to_owned() });
        } else if matches!(character, '“' | '”' | '„' | '‘' | '’' | '«') {
            fault = fault.hint("write texts between straight quotes: \"text\"");
            let inner = &self.rest()[character.len_utf8()..];
            if let Some(length) = inner.find(['“', '”', '’', '»', ',', '\n', '"'])
                && let Some(close) = inner[length..].chars().next().filter(|c| !matches!(c, ',' | '\n' | '"'))
            {
                let end = start + character.len_utf8() + length + close.len_utf8();
                fault.span = self.span(start, end);
                fault.edit = Some(Edit { span: fault.span, replacement: format!("\"{}\"", &inner[..length]) });
            }
        } else if character == '#' && self.is_hex_color() {
            let digits = &self.text[start + 1..start + 1 + self.hex_digits()];
            let twice = if digits.len() == 3 { 2 } else { 1 };
            let color: String = digits.chars().flat_map(|digit| std::iter::repeat_n(digit, twice)).collect();
            fault.span = self.span(start, start + 1 + digits.len());
            fault = fault.hint(format!("write \"#{color}\""));
            fault.edit = Some(Edit { span: fault.span, replacement: format!("\"#{color}\"") });
        } else if character == '#' {
            fault = fault.hint("comments begin with `//`; colours are texts: \"#rrggbb\"");
        } else if matches!(character, '=' | ':' | ';') {
            fault = fault.hint("remove it");
        }
        self.sink.push(fault);
        self.skip_broken();
        self.builder.leaf(Kind::Broken, start, self.at);
    }

    /// `( .. )`, `[ .. ]` or `{ .. }`; `start` is where the name before it begins.
    pub(super) fn bracket(&mut self, start: usize, written: u8) {
        let bracket = self.meant(start, written);
        let node = self.builder.open(start);
        let opened = self.at;
        if self.open.len() >= MAX_DEPTH {
            return self.too_deep(node);
        }
        self.at += 1;
        self.open.push(Open { bracket, written, at: opened, line: self.line, indent: self.indent });
        let mut shape = if bracket == b'{' { Shape::Named } else { Shape::Unknown };
        loop {
            if self.sink.is_full() {
                self.at = self.text.len();
            }
            self.trivia();
            match self.peek() {
                Some(close @ (b')' | b']' | b'}')) => match self.fate(close) {
                    Fate::Closes => {
                        if bracket != written {
                            self.of_wrong_kind(start);
                        }
                        self.at += 1;
                        break;
                    }
                    Fate::Typo => {
                        self.closed_by_another(close);
                        break;
                    }
                    Fate::ClosesOuter => {
                        self.left_open(Some(self.at));
                        break;
                    }
                    Fate::Stray => self.closes_nothing(close),
                },
                None => {
                    self.left_open(None);
                    break;
                }
                Some(b',') => self.nothing_before_comma(),
                Some(_) if self.line_ends_bracket() => {
                    self.left_open_before_entry();
                    break;
                }
                Some(_) => {
                    let (mark, begin) = (self.builder.nodes.len(), self.at);
                    if !self.entry(bracket, &mut shape) {
                        break;
                    }
                    self.comprehension(mark, begin);
                    self.separator();
                }
            }
        }
        self.open.pop();
        let kind = match (bracket, shape) {
            (b'[', _) => Kind::List,
            (b'{', _) => Kind::Map,
            (_, Shape::Named | Shape::Mixed) => Kind::Struct,
            _ => Kind::Tuple,
        };
        self.builder.close(node, kind, self.at);
    }

    fn fate(&self, close: u8) -> Fate {
        let fate = brackets::fate(self.text, &self.open, self.at, close);
        // A bracket in the middle of a line whose own brackets are all closed is one too many.
        let stray = self.trust == Trust::Indentation
            && fate == Fate::ClosesOuter
            && self.open.last().is_some_and(|open| open.line < self.line)
            && self.at > self.line + self.indent;
        let early = || brackets::closes_too_early(self.text, &self.open, self.at, self.line, self.indent);
        let early = self.trust == Trust::Indentation && fate == Fate::Closes && early();
        if stray || early { Fate::Stray } else { fate }
    }

    /// Whether a new line begins here that is indented no deeper than the one that opened the innermost bracket.
    fn line_ends_bracket(&self) -> bool {
        self.trust == Trust::Indentation
            && self.at == self.line + self.indent
            && self.open.last().is_some_and(|open| open.line < self.line && self.indent <= open.indent)
    }

    /// One entry of a bracket. `false`: the bracket was found to be unclosed, and what comes belongs to an outer one.
    fn entry(&mut self, bracket: u8, shape: &mut Shape) -> bool {
        if bracket == b'{' {
            self.map_entry();
            return true;
        }
        // Most entries of brackets are numbers, and no name begins like one.
        if matches!(self.peek(), Some(b'0'..=b'9' | b'-')) && matches!(*shape, Shape::Unknown | Shape::Positional) {
            *shape = Shape::Positional;
            self.number_literal();
            return true;
        }
        let name = self.field_ahead();
        if name.is_none() && self.construct_elsewhere() {
            return true;
        }
        let named = name.or_else(|| {
            let fields = bracket == b'(' && matches!(*shape, Shape::Unknown | Shape::Named);
            fields.then(|| self.field_without_colon()).flatten()
        });
        match (bracket, *shape, named) {
            (b'[', _, Some(length))
                if brackets::fields_behind(self.text, self.at).is_none()
                    && (self.named_item(length) || self.trust == Trust::Indentation && self.fields_without_kind()) =>
            {
                *shape = Shape::Positional;
            }
            (b'[', Shape::Positional, Some(_)) if self.is_field_after_list() => {
                self.left_open_before_entry();
                return false;
            }
            (b'[', _, Some(_)) => self.named_in_list(),
            (b'[', ..) => {
                *shape = Shape::Positional;
                self.value();
            }
            (_, Shape::Mixed, _) => {
                self.builder.leaf(Kind::Broken, self.at, self.at);
                self.skip_broken();
            }
            (_, Shape::Positional, Some(length)) => {
                *shape = Shape::Mixed;
                self.named_after_unnamed(length);
            }
            (_, _, Some(length)) => {
                *shape = Shape::Named;
                self.field(length);
            }
            (_, Shape::Named, None) if self.next_item_ahead() => {
                self.left_open_before_entry();
                return false;
            }
            (_, Shape::Named, None) => self.value_without_name(),
            (_, _, None) => {
                *shape = Shape::Positional;
                self.value();
            }
        }
        true
    }

    /// The comma after an entry, or the end of the bracket.
    fn separator(&mut self) {
        if std::mem::take(&mut self.separated) {
            return;
        }
        let end = self.at;
        self.trivia();
        match self.peek() {
            Some(b',') => self.at += 1,
            None | Some(b')' | b']' | b'}') => {}
            Some(_) if self.is_unit(end) => {
                let length = self.word_length();
                let found = self.span(self.at, self.at + length);
                let word = &self.text[self.at..self.at + length];
                let mut fault =
                    Diagnostic::error(codes::BAD_NUMBER, found, format!("`{word}` is not part of a number"))
                        .hint(super::units::way(None, word));
                fault.edit = Some(Edit { span: self.span(end, self.at + length), replacement: String::new() });
                self.sink.push(fault);
                self.at += length;
                self.separator();
            }
            Some(_) => {
                if let Some(sign) = self.rest().chars().next().filter(|c| c.is_control()) {
                    self.invisible(sign);
                    return self.separator();
                }
                if self.wide_comma() || self.without_commas(end) {
                    return;
                }
                let found = self.span(end, end);
                let semicolon = self.peek() == Some(b';');
                let mut fault = if semicolon {
                    let found = self.span(self.at, self.at + 1);
                    self.at += 1;
                    let mut fault = Diagnostic::error(codes::MISSING_COMMA, found, "values are parted by commas");
                    fault.edit = Some(Edit { span: found, replacement: ",".to_owned() });
                    fault
                } else {
                    let mut fault = Diagnostic::error(codes::MISSING_COMMA, found, "a comma is missing here");
                    fault.edit = Some(Edit { span: found, replacement: ",".to_owned() });
                    fault
                };
                fault.hint = "write `,` between two values".to_owned();
                self.sink.push(fault);
                if !semicolon && !self.entry_ahead() {
                    self.skip_broken();
                    if self.peek() == Some(b',') {
                        self.at += 1;
                    }
                }
            }
        }
    }
}
