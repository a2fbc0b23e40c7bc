//! Brackets of RON that are left open, too many, of the wrong kind or too deep, and commas with nothing before them.
//! Each is told, and read as it was meant.

use super::ron::Parser;
use super::{MAX_DEPTH, brackets};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::tree::Kind;

impl Parser<'_> {
    /// A bracket opens here, whose node has begun, within more others than may be: it is passed over.
    pub(super) fn too_deep(&mut self, node: usize) {
        let found = self.span(self.at, self.at + 1);
        self.sink.push(
            Diagnostic::error(codes::TOO_DEEP, found, format!("brackets stand more than {MAX_DEPTH} deep"))
                .hint("a scene needs no more than ten"),
        );
        self.skip_brackets();
        self.builder.close(node, Kind::Broken, self.at);
    }

    /// The innermost bracket, which is closed here, should have been of another kind; the name before it begins at
    /// `start`.
    pub(super) fn of_wrong_kind(&mut self, start: usize) {
        let Some(&open) = self.open.last() else { return };
        let name = self.text[start..open.at].trim_end();
        self.sink.push(brackets::wrong_kind(self.text, self.builder.source, open, name, self.at));
        // What is missing besides is told once the brackets are right.
        if open.bracket == b'(' && start < open.at {
            self.builder.leaf(Kind::Broken, self.at, self.at);
        }
    }

    /// `close` stands here, and another bracket should close the innermost one: it is taken for that.
    pub(super) fn closed_by_another(&mut self, close: u8) {
        if let Some(&open) = self.open.last() {
            self.sink.push(brackets::wrong_closer(self.builder.source, open, self.at, close));
        }
        self.at += 1;
    }

    /// `close` stands here and closes nothing, or the innermost bracket too early: it is passed over, with its comma.
    pub(super) fn closes_nothing(&mut self, close: u8) {
        let fault = brackets::stray(self.text, self.builder.source, self.at);
        let closes = self.open.last().is_some_and(|open| brackets::closer_of(open.bracket) == close);
        self.sink.push(if closes { brackets::early(fault) } else { fault });
        self.at += 1;
        self.trivia();
        if self.peek() == Some(b',') {
            self.at += 1;
        }
    }

    /// A comma stands where an entry should.
    pub(super) fn nothing_before_comma(&mut self) {
        let found = self.span(self.at, self.at + 1);
        let mut fault = Diagnostic::error(codes::MISSING_VALUE, found, "there is nothing before this comma")
            .hint("remove one of the two commas");
        fault.edit = Some(Edit { span: found, replacement: String::new() });
        self.sink.push(fault);
        self.at += 1;
    }

    /// Whether the name here is of a field that stands after the innermost bracket, a list that was left open.
    pub(super) fn is_field_after_list(&self) -> bool {
        let in_fields = self.open.len() >= 2 && self.open[self.open.len() - 2].bracket == b'(';
        let behind = self.open.last().is_some_and(|open| open.line < self.line)
            && brackets::fields_behind(self.text, self.at).is_some();
        in_fields && !behind
    }

    /// The innermost bracket was left open: an entry of an outer one begins here.
    pub(super) fn left_open_before_entry(&mut self) {
        self.separated = true;
        self.left_open(Some(self.at));
    }

    /// The innermost bracket was not closed before `noticed` (`None`: before the end of the file).
    pub(super) fn left_open(&mut self, noticed: Option<usize>) {
        self.report_unclosed(noticed);
        self.builder.leaf(Kind::Broken, self.at, self.at);
    }

    fn report_unclosed(&mut self, noticed: Option<usize>) {
        let Some(&open) = self.open.last() else { return };
        // At the end of the file the innermost open bracket stands for all that are open.
        if noticed.is_none() && self.at_end_reported {
            return;
        }
        self.at_end_reported |= noticed.is_none();
        self.sink.push(brackets::unclosed(self.builder.source, open, noticed));
    }
}
