//! Names with values as other languages declare them, `let x = 3;`, and the ways they write such a name in a value:
//! `vars.x`, `{x}`, `$x`.

use super::arithmetic::is_given;
use super::ron::Parser;
use crate::codes;
use crate::diagnostic::{Diagnostic, Edit};
use crate::expression;
use crate::tree::Kind;

/// A declaration may have this many bytes.
const LONGEST: usize = 2000;

/// The words that a declaration begins with elsewhere.
const WORDS: [&str; 14] =
    ["let", "var", "const", "local", "def", "auto", "static", "float", "double", "int", "number", "real", "val", "set"];

/// `let x = 3;` at the beginning of a text: its name, its value, the length of its head, and all of its length.
pub(super) fn declaration(rest: &str) -> Option<(&str, &str, usize, usize)> {
    let word_of = |text: &str| text.find(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).unwrap_or(text.len());
    let word = &rest[..word_of(rest)];
    let after = rest[word.len()..].strip_prefix(' ').filter(|_| WORDS.contains(&word))?.trim_start_matches(' ');
    let after = after.strip_prefix("mut ").unwrap_or(after).trim_start_matches(' ');
    let name = &after[..word_of(after)];
    let head = rest.len() - after.len() + name.len();
    let after = after[name.len()..].trim_start_matches(' ');
    // The type, where one is written.
    let typed = after.strip_prefix(':').map(|typed| typed.trim_start_matches(' '));
    let after = typed.map_or(after, |typed| typed[word_of(typed)..].trim_start_matches(' '));
    let value = after.strip_prefix('=').filter(|value| !value.starts_with('=') && !name.is_empty())?;
    let begin = rest.len() - value.len();
    let (mut depth, mut end) = (0usize, None);
    for (at, byte) in value.bytes().enumerate().take(LONGEST) {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' if depth > 0 => depth -= 1,
            b';' if depth == 0 => {
                end = Some((at, at + 1));
                break;
            }
            b',' | b'\n' | b')' | b']' | b'}' if depth == 0 => {
                end = Some((at, at));
                break;
            }
            _ => {}
        }
    }
    let (end, after) = end.unwrap_or((value.len().min(LONGEST), value.len().min(LONGEST)));
    let value = value.get(..end)?.trim();
    Some((name, value, head, begin + after))
}

/// How a name with a value is written and used here.
pub(crate) fn way(name: &str, value: &str) -> String {
    let short = value.len() <= 40 && !value.contains('\n');
    let value = if short && !value.is_empty() { value } else { ".." };
    format!("values with names stand in `vars`: vars: {{ \"{name}\": {value} }}, and are used so: \"={name}\"")
}

/// The name of which a hint tells the way.
pub(crate) fn name_in_way(hint: &str) -> Option<&str> {
    let (name, _) = hint.strip_prefix("values with names stand in `vars`: vars: { \"")?.split_once('"')?;
    Some(name)
}

impl Parser<'_> {
    /// `{x}`, `$x` or `${x}` where a value stands, which is reported.
    pub(super) fn name_elsewhere(&mut self, start: usize) -> bool {
        let line = super::line_ahead(self.text, start);
        let inner = line.trim_start_matches(['$', '@', '%']);
        let braced = inner.strip_prefix('{').map(|inner| inner.trim_start_matches(['{', ' ', '$']));
        let bare = braced.unwrap_or(inner);
        let length = bare.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(bare.len());
        let (name, after) = bare.split_at(length);
        let after = match braced {
            Some(_) => match after.trim_start_matches(' ').strip_prefix('}') {
                Some(after) => after.strip_prefix('}').filter(|_| inner.starts_with("{{")).unwrap_or(after),
                None => return false,
            },
            None => after,
        };
        if !expression::is_name(name) {
            return false;
        }
        let name = name.to_owned();
        self.named_value(start, start + line.len() - after.len(), &name);
        true
    }

    /// What stands at `start..end` is a name with a value, written in the way of another language.
    pub(super) fn named_value(&mut self, start: usize, end: usize, name: &str) {
        let found = self.span(start, end);
        let message = format!("`{}` is no value", &self.text[start..end]);
        let mut fault = Diagnostic::error(codes::BARE_EXPRESSION, found, message)
            .expected("a number, or a text that begins with `=`");
        if is_given(self.text, name) {
            fault.hint = format!("write \"={name}\"");
            fault.edit = Some(Edit { span: found, replacement: format!("\"={name}\"") });
        } else {
            fault.hint = way(name, "..");
        }
        self.sink.push(fault);
        self.at = end;
        self.builder.leaf(Kind::Broken, start, end);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_end_where_their_line_does() {
        for (text, name, value, length) in [
            ("let x = 3; rest", "x", "3", 10),
            ("const  r_1: f64 = (1, 2),", "r_1", "(1, 2)", 24),
            ("let mut a = [1,\n 2]\nb", "a", "[1,\n 2]", 19),
            ("var h = 2", "h", "2", 9),
        ] {
            let (found, told, _, all) = declaration(text).expect(text);
            assert_eq!((found, told, all), (name, value, length), "{text}");
        }
        for text in ["let: 3", "let", "variable x = 3", "let x == 3", "var", "set = 3"] {
            assert!(declaration(text).is_none(), "{text}");
        }
    }
}
