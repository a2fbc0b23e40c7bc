//! Calls of other languages where a value stands: `THREE.Vector3(0, 1, 6)`, `np.array([0, 1, 6])`, `new Sphere(..)`.

use super::ron::Parser;
use super::{Syntax, arithmetic, constructs};
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::syntax::ron_literal::number_kind;
use crate::tree::Kind;

/// A call, by bytes from its beginning.
struct Call {
    /// Where its last name begins, and where that ends.
    name: [usize; 2],
    /// Its opening bracket, and what follows on the closing one.
    brackets: [usize; 2],
}

/// The call that a line begins with: names joined by `.` or `::`, or behind `new`, before a bracket that is closed on
/// the same line. One name alone is a kind.
fn call(line: &str) -> Option<Call> {
    let is_of_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut at = line.strip_prefix("new ").map_or(0, |rest| line.len() - rest.trim_start().len());
    let mut joined = at > 0;
    let begin = loop {
        let length = line[at..].find(|c| !is_of_name(c))?;
        let next = &line[at + length..];
        if length == 0 {
            return None;
        }
        if next.starts_with('(') {
            break at;
        }
        at += length + next.strip_prefix("::").map_or_else(|| next.starts_with('.').then_some(1), |_| Some(2))?;
        joined = true;
    };
    let open = begin + line[begin..].find('(')?;
    let mut depth = 0usize;
    let close = line[open..].bytes().position(|byte| {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            _ => {}
        }
        depth == 0
    })?;
    joined.then_some(Call { name: [begin, open], brackets: [open, open + close + 1] })
}

impl Parser<'_> {
    /// A call of another language, which is reported: a vector is read without its name, a kind without what stands
    /// before it.
    pub(super) fn call_elsewhere(&mut self, start: usize) -> bool {
        if let Some(found) = constructs::directive_of_pbrt(&self.text[start..], Syntax::Ron) {
            self.pass_over(found);
            return true;
        }
        let line = super::line_ahead(self.text, start);
        let Some(Call { name: [begin, end], brackets: [open, after] }) = call(line) else { return false };
        // `Math.sqrt(2)` is no vector of one number.
        if arithmetic::of_languages(line).is_some() {
            return false;
        }
        let inner = line[open + 1..after - 1].trim();
        let hex = inner.strip_prefix("0x").or_else(|| inner.trim_matches(['"', '\'']).strip_prefix('#'));
        if let Some(hex) = hex.filter(|hex| hex.len() == 6 && hex.bytes().all(|byte| byte.is_ascii_hexdigit())) {
            let found = self.span(start, start + after);
            let message = format!("`{}(..)` is of another language", &line[..open]);
            let mut fault = Diagnostic::error(codes::OTHER_LANGUAGE, found, message)
                .expected("a colour")
                .hint(format!("write \"#{hex}\""));
            fault.edit = Some(Edit { span: found, replacement: format!("\"#{hex}\"") });
            self.sink.push(fault);
            self.at = start + after;
            self.builder.leaf(Kind::Broken, start, self.at);
            return true;
        }
        let list = inner.strip_prefix('[').and_then(|inner| inner.strip_suffix(']'));
        let numbers = list.unwrap_or(inner);
        let is_vector = numbers.split(',').all(|number| number_kind(number.trim()).is_some());
        let has_fields = inner.is_empty() || inner.split_once(':').is_some_and(|(name, _)| is_plain(name.trim()));
        let is_kind = line[begin..end].starts_with(|c: char| c.is_ascii_uppercase()) && has_fields;
        if !is_vector && !is_kind {
            return false;
        }
        let name = &line[..open];
        let found = self.span(start, start + after);
        let mut fault = Diagnostic::error(codes::OTHER_LANGUAGE, found, format!("`{name}(..)` is of another language"));
        let (span, replacement) = if is_vector {
            fault.expected = "numbers in brackets: (x, y, z)".to_owned();
            fault.hint = format!("write ({numbers})");
            (found, format!("({numbers})"))
        } else {
            let kind = &line[begin..end];
            fault.expected = format!("{kind}(..)");
            fault.hint = format!("write {kind}(..)");
            (self.span(start, start + begin), String::new())
        };
        fault.edit = Some(Edit { span, replacement });
        self.sink.push(fault);
        self.at = start + open;
        if !is_vector {
            self.bracket(start + begin, b'(');
        } else if list.is_none() {
            self.bracket(start + open, b'(');
        } else {
            self.at += 1;
            self.trivia();
            self.bracket(self.at, b'[');
            self.at = start + after;
        }
        true
    }
}

fn is_plain(name: &str) -> bool {
    !name.is_empty() && name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}
