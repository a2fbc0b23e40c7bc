//! Tokens of TOML: those of `toml_parser`'s lexer, at three times its speed. That one searches a list of eleven
//! characters for every byte of a word, and a scene file is made of words.

use toml_parser::Span;
use toml_parser::lexer::TokenKind;

/// Bytes that end a word or a number.
const ENDS_ATOM: [bool; 256] = {
    let mut ends = [false; 256];
    let bytes = b".=,[]{} \t#\r\n";
    let mut index = 0;
    while index < bytes.len() {
        ends[bytes[index] as usize] = true;
        index += 1;
    }
    ends
};

/// Gives one token after the other, and at the end `Eof` for ever.
#[derive(Debug)]
pub(super) struct Lexer<'l> {
    bytes: &'l [u8],
    at: usize,
}

impl<'l> Lexer<'l> {
    /// Begins at a byte of the text, after the byte order mark.
    pub fn new(text: &'l str, at: usize) -> Lexer<'l> {
        let mark = at == 0 && text.starts_with('\u{feff}');
        Lexer { bytes: text.as_bytes(), at: if mark { 3 } else { at } }
    }

    fn ahead(&self, offset: usize) -> Option<u8> {
        self.bytes.get(self.at + offset).copied()
    }

    /// Goes to the first byte from here on that is among those that end something, or to the end of the text.
    #[inline]
    fn skip_until(&mut self, ends: impl Fn(u8) -> bool) {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        self.at += rest.iter().position(|&byte| ends(byte)).unwrap_or(rest.len());
    }

    /// The next token.
    #[inline]
    pub fn next(&mut self) -> (TokenKind, Span) {
        let start = self.at;
        let kind = match self.ahead(0) {
            None => TokenKind::Eof,
            Some(byte) => self.token(byte),
        };
        (kind, Span::new_unchecked(start, self.at))
    }

    #[inline]
    fn token(&mut self, byte: u8) -> TokenKind {
        self.at += 1;
        match byte {
            b'.' => TokenKind::Dot,
            b'=' => TokenKind::Equals,
            b',' => TokenKind::Comma,
            b'[' => TokenKind::LeftSquareBracket,
            b']' => TokenKind::RightSquareBracket,
            b'{' => TokenKind::LeftCurlyBracket,
            b'}' => TokenKind::RightCurlyBracket,
            b'\n' => TokenKind::Newline,
            b' ' | b'\t' => {
                self.skip_until(|byte| !matches!(byte, b' ' | b'\t'));
                TokenKind::Whitespace
            }
            b'#' => {
                self.skip_until(|byte| matches!(byte, b'\r' | b'\n'));
                TokenKind::Comment
            }
            b'\r' => {
                self.at += usize::from(self.ahead(0) == Some(b'\n'));
                TokenKind::Newline
            }
            b'"' | b'\'' => self.text(byte),
            _ => {
                self.skip_until(|byte| ENDS_ATOM[usize::from(byte)]);
                TokenKind::Atom
            }
        }
    }

    /// A text after its first quote; one that is not closed ends with its line, or with the file if its quotes are
    /// three.
    fn text(&mut self, quote: u8) -> TokenKind {
        let basic = quote == b'"';
        let many = self.ahead(0) == Some(quote) && self.ahead(1) == Some(quote);
        if many {
            self.at += 2;
        }
        loop {
            self.skip_until(|byte| byte == quote || basic && byte == b'\\' || !many && byte == b'\n');
            match self.ahead(0) {
                None | Some(b'\n') => break,
                Some(b'\\') if basic => {
                    self.at += 1;
                    self.at += usize::from(matches!(self.ahead(0), Some(b'\\' | b'"')));
                }
                Some(_) if !many => {
                    self.at += 1;
                    break;
                }
                Some(_) if self.ahead(1) == Some(quote) && self.ahead(2) == Some(quote) => {
                    self.at += 3;
                    // Up to two quotes may stand before the three that end the text.
                    self.at += usize::from(self.ahead(0) == Some(quote));
                    self.at += usize::from(self.ahead(0) == Some(quote));
                    break;
                }
                Some(_) => self.at += 1,
            }
        }
        match (many, basic) {
            (false, false) => TokenKind::LiteralString,
            (false, true) => TokenKind::BasicString,
            (true, false) => TokenKind::MlLiteralString,
            (true, true) => TokenKind::MlBasicString,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pieces put together by chance give the tokens that the lexer of `toml_parser` gives.
    #[test]
    fn tokens_are_those_of_toml_parser() {
        const PIECES: [&str; 32] = [
            "a", "é", "🐈", "1", ".", "=", ",", "[", "]", "{", "}", " ", "\t", "  ", "#", "\r", "\n", "\r\n", "'",
            "''", "'''", "\"", "\"\"", "\"\"\"", "\\", "\\\\", "\\\"", "\\n", "-1.5e+3", "(", ":", "\u{feff}",
        ];
        let mut state = 3u64;
        let mut below = |count: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) % count as u64) as usize
        };
        for _ in 0..20_000 {
            let text: String = (0..1 + below(12)).map(|_| PIECES[below(PIECES.len())]).collect();
            let mut lexer = Lexer::new(&text, 0);
            for token in toml_parser::Source::new(&text).lex() {
                assert_eq!(lexer.next(), (token.kind(), token.span()), "{text:?}");
            }
            assert_eq!(lexer.next().0, TokenKind::Eof);
        }
    }
}
