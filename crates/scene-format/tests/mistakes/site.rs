//! Places of a scene's text where a mistake may be made.

use scene_format::Syntax;
use std::ops::Range;

/// A word, number, text or sign of a scene file.
#[derive(Clone, Debug)]
pub struct Token {
    pub at: Range<usize>,
    pub kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    Word,
    Number,
    /// Between quotes.
    Text,
    Sign,
    Comment,
}

pub fn tokens(text: &str, syntax: Syntax) -> Vec<Token> {
    let comment = if syntax == Syntax::Toml { "#" } else { "//" };
    let mut found = Vec::new();
    let mut at = 0;
    while let Some(first) = text[at..].chars().next() {
        let rest = &text[at..];
        let (kind, length) = if first.is_whitespace() {
            at += first.len_utf8();
            continue;
        } else if rest.starts_with(comment) {
            (Kind::Comment, rest.find('\n').unwrap_or(rest.len()))
        } else if first == '"' {
            let length = rest[1..].find('"').map_or(rest.len(), |length| length + 2);
            let inner = rest.get(1..length - 1).unwrap_or_default();
            let word = inner.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
            if syntax == Syntax::Json && word && rest[length..].starts_with(':') {
                // Names of the language without their quotes, as in the other syntaxes.
                found.push(Token { at: at + 1..at + length - 1, kind: Kind::Word });
                at += length;
                continue;
            }
            (Kind::Text, length)
        } else if first.is_ascii_digit() || first == '-' {
            let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | '-' | '_');
            (Kind::Number, rest.find(|c| !number(c)).unwrap_or(rest.len()))
        } else if first.is_alphabetic() {
            (Kind::Word, rest.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(rest.len()))
        } else {
            (Kind::Sign, first.len_utf8())
        };
        found.push(Token { at: at..at + length, kind });
        at += length;
    }
    found
}

/// A place where a mistake may be made.
pub struct Site<'s> {
    pub text: &'s str,
    pub tokens: &'s [Token],
    pub index: usize,
}

/// What is written instead of what.
pub type Change = Option<(Range<usize>, String)>;

impl Site<'_> {
    pub fn token(&self, offset: isize) -> Option<&Token> {
        self.tokens.get(self.index.checked_add_signed(offset)?)
    }

    /// A token near the place.
    pub fn is(&self, offset: isize, kind: Kind, texts: &[&str]) -> bool {
        self.token(offset).is_some_and(|token| {
            token.kind == kind && (texts.is_empty() || texts.contains(&&self.text[token.at.clone()]))
        })
    }

    pub fn sign(&self, offset: isize, signs: &[&str]) -> bool {
        self.is(offset, Kind::Sign, signs)
    }

    pub fn here(&self) -> &str {
        &self.text[self.tokens[self.index].at.clone()]
    }

    pub fn becomes(&self, text: impl Into<String>) -> Change {
        Some((self.tokens[self.index].at.clone(), text.into()))
    }

    /// From here to the token at `offset`, that one included.
    pub fn through(&self, offset: isize) -> Option<Range<usize>> {
        Some(self.tokens[self.index].at.start..self.token(offset)?.at.end)
    }

    /// `(x, y, z)` begins here, of numbers, as the value of a field.
    pub fn is_vector(&self) -> bool {
        self.sign(0, &["(", "["])
            && self.sign(-1, &[":", "="])
            && [1, 3, 5].iter().all(|&number| self.is(number, Kind::Number, &[]))
            && self.sign(6, &[")", "]"])
    }

    /// The name of a field, its value following. (In TOML and JSON names of materials and textures look the
    /// same.)
    pub fn is_field(&self) -> bool {
        let named = |sign: &str| self.text.contains(&format!("{sign}\"{}\"", self.here()));
        if named("= ") || named("\": ") {
            return false;
        }
        self.is(0, Kind::Word, &[]) && self.sign(1, &[":", "="]) && self.here().starts_with(char::is_lowercase)
    }

    /// The name of a kind or struct, its brackets following.
    pub fn is_kind(&self) -> bool {
        self.is(0, Kind::Word, &[]) && self.here().starts_with(char::is_uppercase) && self.sign(1, &["(", "=", ":"])
    }

    /// A name with the quotes around it that JSON has.
    pub fn with_quotes(&self) -> Range<usize> {
        let at = &self.tokens[self.index].at;
        at.start - 1..at.end + 1
    }

    /// Whether a bracket closes next, comments aside: before it no comma is needed.
    pub fn closes_next(&self) -> bool {
        let mut next = self.tokens.iter().skip(self.index + 1).skip_while(|token| token.kind == Kind::Comment);
        next.next().is_some_and(|token| matches!(&self.text[token.at.clone()], ")" | "]" | "}"))
    }

    /// The sign that closes the bracket which opens here.
    pub fn close(&self) -> Option<usize> {
        let mut depth = 0;
        for (index, token) in self.tokens.iter().enumerate().skip(self.index) {
            if token.kind == Kind::Sign {
                match &self.text[token.at.clone()] {
                    "(" | "[" | "{" => depth += 1,
                    ")" | "]" | "}" => depth -= 1,
                    _ => {}
                }
                if depth == 0 {
                    return Some(index);
                }
            }
        }
        None
    }
}
