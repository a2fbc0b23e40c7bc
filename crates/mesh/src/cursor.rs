//! Reading words and numbers of line-based text files, fast and exactly.
//!
//! Numbers equal what `str::parse::<f64>` gives: decimal mantissas up to 2^53 with powers of ten up to 10^22 are one
//! exact integer and one correctly rounded operation (Clinger, "How to read floating point numbers accurately", 1990);
//! all others go to the standard library.

use super::data::MAX_COORDINATE;

/// What stands between words besides spaces and tabs.
#[derive(Clone, Copy)]
pub(super) struct Blanks {
    /// A comma separates words.
    pub(super) comma: bool,
    /// A backslash at the end of a line joins the next one to it.
    pub(super) continuation: bool,
}

/// Something wrong at a byte of a text.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) at: usize,
    pub(super) message: String,
    pub(super) expected: String,
}

impl Fault {
    #[cold]
    pub(super) fn new(at: usize, message: impl Into<String>, expected: impl Into<String>) -> Box<Fault> {
        Box::new(Fault { at, message: message.into(), expected: expected.into() })
    }

    /// Says what was expected, where the fault does not yet.
    #[cold]
    pub(super) fn expecting(mut self: Box<Fault>, expected: &str) -> Box<Fault> {
        if self.expected.is_empty() {
            self.expected.push_str(expected);
        }
        self
    }

    /// 1-based line of the fault in the text that `at` counts in.
    pub(super) fn line_in(&self, text: &[u8]) -> u64 {
        line_of(text, self.at)
    }
}

/// 1-based line of a byte.
#[expect(clippy::indexing_slicing, reason = "cut to the text's length")]
pub(super) fn line_of(text: &[u8], at: usize) -> u64 {
    // A fault at the end of the text belongs to the last line that has something in it, not to the empty one after it.
    let before = &text[..at.min(text.len())];
    let before = if at >= text.len() { before.strip_suffix(b"\n").unwrap_or(before) } else { before };
    1 + before.iter().filter(|&&byte| byte == b'\n').count() as u64
}

/// A word as messages show it: cut to a sensible length, unprintable characters escaped.
#[expect(clippy::indexing_slicing, reason = "cut to the word's length")]
pub(super) fn shown(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let text = String::from_utf8_lossy(&word[..word.len().min(4 * LONGEST)]);
    let mut out = String::from("`");
    for (count, character) in text.chars().enumerate() {
        if count == LONGEST {
            out.push('…');
            break;
        }
        if character.is_control() { out.extend(character.escape_default()) } else { out.push(character) }
    }
    out.push('`');
    out
}

/// The powers of ten that are exact in an `f64`.
const POWERS_OF_TEN: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// A place in a text. A statement is a line (with those joined to it); `#` starts a comment to the end of the line.
#[derive(Clone)]
pub(super) struct Cursor<'a> {
    text: &'a [u8],
    at: usize,
    blanks: Blanks,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(text: &'a [u8], blanks: Blanks) -> Self {
        Cursor { text, at: 0, blanks }
    }

    /// Byte offset into the text.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    #[inline]
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    /// Bytes from here on.
    #[expect(clippy::indexing_slicing, reason = "the cursor never goes beyond the end of its text")]
    pub(super) fn rest(&self) -> &'a [u8] {
        &self.text[self.at..]
    }

    /// Steps over bytes that the caller has looked at.
    #[inline]
    pub(super) fn advance(&mut self, bytes: usize) {
        self.at = (self.at + bytes).min(self.text.len());
    }

    /// Whether this byte is here.
    #[inline]
    pub(super) fn is_at(&self, byte: u8) -> bool {
        self.peek() == Some(byte)
    }

    /// Steps over this byte if it is here.
    #[inline]
    pub(super) fn take(&mut self, byte: u8) -> bool {
        let here = self.is_at(byte);
        self.at += usize::from(here);
        here
    }

    /// Looks again at what starts at an earlier byte.
    pub(super) fn go_back_to(&mut self, at: usize) {
        self.at = at.min(self.at);
    }

    /// Steps over spaces within the statement.
    #[inline]
    pub(super) fn skip_blanks(&mut self) {
        loop {
            match self.peek() {
                Some(b' ' | b'\t' | b'\r' | 0x0b | 0x0c) => self.at += 1,
                Some(b',') if self.blanks.comma => self.at += 1,
                Some(b'\\') => match self.continuation_length() {
                    0 => return,
                    length => self.at += length,
                },
                _ => return,
            }
        }
    }

    /// Length of the backslash and line break here; 0 when they are none.
    fn continuation_length(&self) -> usize {
        match self.rest() {
            _ if !self.blanks.continuation => 0,
            [b'\\', b'\n', ..] => 2,
            [b'\\', b'\r', b'\n', ..] => 3,
            _ => 0,
        }
    }

    /// Whether nothing more stands in the statement (call after [`Cursor::skip_blanks`]).
    #[inline]
    pub(super) fn is_at_end_of_statement(&self) -> bool {
        matches!(self.peek(), None | Some(b'\n' | b'#'))
    }

    /// Steps over the rest of the statement and its line break; a comment ends with its line even after a backslash.
    pub(super) fn skip_statement(&mut self) {
        let mut comment = false;
        while let Some(byte) = self.peek() {
            match byte {
                b'\n' => {
                    self.at += 1;
                    return;
                }
                b'\\' if !comment => self.at += self.continuation_length().max(1),
                _ => {
                    comment |= byte == b'#';
                    self.at += 1;
                }
            }
        }
    }

    /// Steps to the first word of the next statement that has one; `false` at the end of the text.
    #[inline]
    pub(super) fn find_statement(&mut self) -> bool {
        loop {
            self.skip_blanks();
            match self.peek() {
                None => return false,
                Some(b'\n') => self.at += 1,
                Some(b'#') => self.skip_statement(),
                Some(_) => return true,
            }
        }
    }

    /// Whether a word ends before the byte here.
    #[inline]
    pub(super) fn is_at_end_of_word(&self) -> bool {
        match self.peek() {
            None | Some(b' ' | b'\t' | b'\r' | b'\n' | 0x0b | 0x0c | b'#') => true,
            Some(b',') => self.blanks.comma,
            Some(b'\\') => self.continuation_length() > 0,
            Some(_) => false,
        }
    }

    /// The word here, stepped over; empty at the end of the statement.
    #[inline]
    #[expect(clippy::indexing_slicing, reason = "the cursor never goes beyond the end of its text")]
    pub(super) fn word(&mut self) -> &'a [u8] {
        let start = self.at;
        while !self.is_at_end_of_word() {
            self.at += 1;
        }
        &self.text[start..self.at]
    }

    /// The rest of the line without blanks around it, as a name: only a `#` after a blank starts a comment.
    #[expect(clippy::indexing_slicing, reason = "places found in the line itself")]
    pub(super) fn name(&mut self) -> &'a [u8] {
        self.skip_blanks();
        let line = self.rest();
        let end = line.iter().position(|&byte| byte == b'\n').unwrap_or(line.len());
        let comment = line[..end].windows(2).position(|pair| matches!(pair, [b' ' | b'\t', b'#']));
        let name = if line.first() == Some(&b'#') { &[] } else { line[..comment.unwrap_or(end)].trim_ascii() };
        self.at += end;
        name
    }

    /// A finite number, stepped over. The fault says what stands here instead; the caller fills in what was expected.
    #[inline]
    #[expect(
        clippy::indexing_slicing,
        reason = "the power is compared with 22 first, and the cursor never goes beyond the end of its text"
    )]
    pub(super) fn number(&mut self) -> Result<f64, Box<Fault>> {
        let start = self.at;
        let negative = self.peek() == Some(b'-');
        if negative || self.peek() == Some(b'+') {
            self.at += 1;
        }
        let mut mantissa = 0_u64;
        let mut digits = self.digits(&mut mantissa);
        let mut exponent = 0_i64;
        if self.peek() == Some(b'.') {
            self.at += 1;
            let fraction = self.digits(&mut mantissa);
            digits += fraction;
            exponent = -(fraction as i64);
        }
        if digits == 0 {
            return Err(self.no_number(start));
        }
        if let Some(b'e' | b'E') = self.peek() {
            self.at += 1;
            let down = self.peek() == Some(b'-');
            if down || self.peek() == Some(b'+') {
                self.at += 1;
            }
            let mut power = 0_u64;
            match self.digits(&mut power) {
                0 => return Err(self.no_number(start)),
                // Out of the fast range, however it wrapped.
                6.. => exponent = i64::MAX,
                _ => exponent += if down { -(power as i64) } else { power as i64 },
            }
        }
        if !self.is_at_end_of_word() {
            return Err(self.no_number(start));
        }
        // 19 digits fit a u64 without wrapping.
        if digits <= 19 && mantissa <= 1 << 53 && exponent.unsigned_abs() <= 22 {
            let power = POWERS_OF_TEN[exponent.unsigned_abs() as usize];
            let magnitude = if exponent < 0 { mantissa as f64 / power } else { mantissa as f64 * power };
            return Ok(if negative { -magnitude } else { magnitude });
        }
        match std::str::from_utf8(&self.text[start..self.at]).ok().and_then(|word| word.parse::<f64>().ok()) {
            Some(value) if value.is_finite() => Ok(value),
            _ => Err(self.no_number(start)),
        }
    }

    /// Steps over decimal digits and appends them to `value` (wrapping); says how many there were.
    #[inline]
    fn digits(&mut self, value: &mut u64) -> usize {
        let start = self.at;
        while let Some(digit @ b'0'..=b'9') = self.peek() {
            *value = value.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
            self.at += 1;
        }
        self.at - start
    }

    /// A whole number, stepped over; `None` (nothing stepped over) when something else stands here.
    #[inline]
    pub(super) fn integer(&mut self) -> Option<i64> {
        let start = self.at;
        let negative = self.peek() == Some(b'-');
        if negative || self.peek() == Some(b'+') {
            self.at += 1;
        }
        let mut magnitude = 0_u64;
        let digits = self.digits(&mut magnitude);
        if digits == 0 {
            self.at = start;
            return None;
        }
        // Beyond 18 digits: larger than any count, whatever it is.
        let magnitude = if digits > 18 { i64::MAX } else { magnitude as i64 };
        Some(if negative { -magnitude } else { magnitude })
    }

    /// A whole number from 0, stepped over.
    #[inline]
    pub(super) fn count(&mut self, expected: &str) -> Result<u64, Box<Fault>> {
        let start = self.at;
        match self.integer() {
            Some(count @ 0..) if self.is_at_end_of_word() => Ok(count.unsigned_abs()),
            _ => Err(self.no_integer(start, "a whole number from 0", expected)),
        }
    }

    /// The fault that what starts at a byte is not `what`.
    #[cold]
    pub(super) fn no_integer(&mut self, start: usize, what: &str, expected: &str) -> Box<Fault> {
        self.at = start;
        let message = if self.is_at_end_of_statement() {
            "a number is missing at the end of the line".to_owned()
        } else {
            format!("{} is not {what}", shown(self.word()))
        };
        Fault::new(start, message, expected)
    }

    /// Steps to the next line; a fault when anything more stands in this one.
    #[inline]
    pub(super) fn end_of_line(&mut self, expected: &str) -> Result<(), Box<Fault>> {
        self.skip_blanks();
        if !self.is_at_end_of_statement() {
            let at = self.at;
            return Err(Fault::new(at, format!("{} is too much", shown(self.word())), expected));
        }
        self.skip_statement();
        Ok(())
    }

    /// Three coordinates of at most [`MAX_COORDINATE`] in magnitude, the first one here.
    #[inline]
    #[expect(clippy::indexing_slicing, reason = "the cursor never goes beyond the end of its text")]
    pub(super) fn position(&mut self) -> Result<[f64; 3], Box<Fault>> {
        let mut position = [0.0; 3];
        for coordinate in &mut position {
            self.skip_blanks();
            let start = self.at;
            *coordinate = self.number()?;
            if coordinate.abs() > MAX_COORDINATE {
                let message = format!("the coordinate {} is too large", shown(&self.text[start..self.at]));
                return Err(Fault::new(start, message, format!("a magnitude of at most {MAX_COORDINATE:e}")));
            }
        }
        Ok(position)
    }

    #[cold]
    fn no_number(&mut self, start: usize) -> Box<Fault> {
        self.at = start;
        if self.is_at_end_of_statement() {
            return Fault::new(start, "a number is missing at the end of the line", "");
        }
        let word = self.word();
        let parsed = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f64>().ok());
        let message = match parsed {
            Some(_) => format!("{} is not a finite number", shown(word)),
            None if std::str::from_utf8(word).is_err() => format!("{} is not UTF-8 text", shown(word)),
            None => format!("{} is not a number", shown(word)),
        };
        Fault::new(start, message, "")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: Blanks = Blanks { comma: false, continuation: true };

    fn number(word: &str) -> Option<f64> {
        Cursor::new(word.as_bytes(), PLAIN).number().ok()
    }

    #[test]
    fn numbers_equal_those_of_the_standard_library() {
        let words = [
            "0",
            "-0",
            "+1",
            "1.",
            ".5",
            "-.5e1",
            "1e22",
            "1e23",
            "1e-22",
            "1e-23",
            "9007199254740992",
            "9007199254740993",
            "123456789012345678901234567890",
            "0.1",
            "0.30000000000000004",
            "2.2250738585072011e-308",
            "5e-324",
            "1e-400",
            "1.7976931348623157e308",
            "000000000000000000000000000001.5",
            "0.000000000000000000000000000000012345",
            "1e000000005",
            "1e-0000000000000001",
            "18446744073709551615e-3",
            "99999999999999999999e0",
        ];
        for word in words {
            let expected: f64 = word.parse().expect("a number");
            assert_eq!(number(word).map(f64::to_bits), Some(expected.to_bits()), "{word}");
        }
        // A linear congruential walk through digits, points and exponents.
        let mut state = 1_u64;
        let mut next = |below: u64| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) % below
        };
        for _ in 0..100_000 {
            let whole: String = (0..=next(12)).map(|_| char::from(b'0' + next(10) as u8)).collect();
            let fraction: String = (0..next(12)).map(|_| char::from(b'0' + next(10) as u8)).collect();
            let mut word = format!("{}{whole}.{fraction}", ["", "-", "+"][next(3) as usize]);
            if next(3) == 0 {
                word += &format!("{}{}", ["e", "E-", "e+"][next(3) as usize], next(40));
            }
            let expected: f64 = word.parse().expect("a number");
            assert_eq!(number(&word).map(f64::to_bits), Some(expected.to_bits()), "{word}");
        }
    }

    #[test]
    fn what_is_no_finite_number_is_refused() {
        for word in
            ["", "-", ".", "e5", "1e", "1e+", "1.2.3", "1,5", "0x10", "nan", "inf", "-inf", "1e309", "1e99999999", "1f"]
        {
            assert_eq!(number(word), None, "{word}");
        }
        assert_eq!(number("0e99999999"), Some(0.0));
    }

    #[test]
    fn statements_end_where_lines_do() {
        let mut cursor = Cursor::new(b"# a \\\n\r\n  one \\\r\n two # c\nthree", PLAIN);
        assert!(cursor.find_statement());
        assert_eq!(cursor.word(), b"one");
        cursor.skip_blanks();
        assert_eq!(cursor.word(), b"two");
        cursor.skip_blanks();
        assert!(cursor.is_at_end_of_statement());
        cursor.skip_statement();
        assert!(cursor.find_statement());
        assert_eq!(cursor.word(), b"three");
        assert!(!cursor.find_statement());
    }
}
