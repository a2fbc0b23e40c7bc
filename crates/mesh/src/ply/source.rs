//! The numbers of a PLY file's data, one after the other: from a text, or from bytes of either order.

use super::header::{Element, Scalar};
use crate::cursor::{Blanks, Cursor, Fault, shown};
use crate::oddities::{Oddities, Oddity};

/// Where numbers come from. A fault without a message means that the data ends too early.
pub(super) trait Source: Clone {
    /// The byte of the next number, or of blanks before it.
    fn at(&self) -> usize;

    /// Bytes from here on.
    fn bytes_left(&self) -> usize;

    /// How many items of so many bytes and values there can be from here on.
    fn most_items(&self, bytes: u64, values: u64) -> u64;

    /// Goes to the next item of an element.
    fn start_item(&mut self) -> Result<(), Box<Fault>>;

    /// A finite number.
    fn number(&mut self, kind: Scalar) -> Result<f64, Box<Fault>>;

    /// A number of an integer type.
    fn integer(&mut self, kind: Scalar) -> Result<i64, Box<Fault>>;

    /// The length of a list whose values are of a type; in a binary file there is room for as many.
    fn length(&mut self, kind: Scalar, item: Scalar) -> Result<u64, Box<Fault>>;

    /// Steps over numbers that have so many bytes in all.
    fn skip(&mut self, values: u64, bytes: u64) -> Result<(), Box<Fault>>;

    /// Ends the item: nothing more may stand in its line.
    fn end_item(&mut self) -> Result<(), Box<Fault>>;

    /// Counts what is left after the data.
    fn count_rest(self, oddities: &mut Oddities);

    /// The fault of an item, with what was expected of it.
    fn expecting(fault: Box<Fault>, element: &Element) -> Box<Fault>;
}

#[cold]
fn ends(at: usize) -> Box<Fault> {
    Fault::new(at, "", "")
}

/// Text: each item on a line of its own; lines without anything are passed over.
#[derive(Clone)]
pub(super) struct Ascii<'a> {
    cursor: Cursor<'a>,
}

impl<'a> Ascii<'a> {
    /// From a byte of the file on.
    pub(super) fn new(text: &'a [u8], at: usize) -> Self {
        let mut cursor = Cursor::new(text, Blanks { comma: false, continuation: false });
        cursor.advance(at);
        Ascii { cursor }
    }
}

impl Source for Ascii<'_> {
    fn at(&self) -> usize {
        self.cursor.at()
    }

    fn bytes_left(&self) -> usize {
        self.cursor.rest().len()
    }

    fn most_items(&self, _: u64, values: u64) -> u64 {
        // One digit and one blank or line break each; the last line may lack its own.
        (self.bytes_left() as u64 + 1) / (2 * values).max(1)
    }

    fn start_item(&mut self) -> Result<(), Box<Fault>> {
        if self.cursor.find_statement() { Ok(()) } else { Err(ends(self.cursor.at())) }
    }

    #[inline]
    fn number(&mut self, _: Scalar) -> Result<f64, Box<Fault>> {
        self.cursor.skip_blanks();
        self.cursor.number()
    }

    #[inline]
    fn integer(&mut self, _: Scalar) -> Result<i64, Box<Fault>> {
        self.cursor.skip_blanks();
        let start = self.cursor.at();
        match self.cursor.integer() {
            Some(value) if self.cursor.is_at_end_of_word() => Ok(value),
            _ => Err(self.cursor.no_integer(start, "a whole number", "")),
        }
    }

    #[inline]
    fn length(&mut self, _: Scalar, _: Scalar) -> Result<u64, Box<Fault>> {
        self.cursor.skip_blanks();
        self.cursor.count("")
    }

    fn skip(&mut self, values: u64, _: u64) -> Result<(), Box<Fault>> {
        for _ in 0..values {
            self.cursor.skip_blanks();
            if self.cursor.is_at_end_of_statement() {
                return Err(self.cursor.no_integer(self.cursor.at(), "", ""));
            }
            self.cursor.word();
        }
        Ok(())
    }

    #[inline]
    fn end_item(&mut self) -> Result<(), Box<Fault>> {
        self.cursor.end_of_line("")
    }

    fn count_rest(mut self, oddities: &mut Oddities) {
        while self.cursor.find_statement() {
            oddities.add(Oddity::TrailingLine);
            self.cursor.skip_statement();
        }
    }

    #[cold]
    fn expecting(fault: Box<Fault>, element: &Element) -> Box<Fault> {
        const MOST_NAMES: usize = 12;
        let mut expected = String::from("one line with");
        for property in element.properties.iter().take(MOST_NAMES) {
            expected += " ";
            expected += &shown(property.name);
        }
        if element.properties.len() > MOST_NAMES {
            expected += " ...";
        }
        fault.expecting(&expected)
    }
}

/// Bytes, the highest of a number first (`BIG`) or last.
#[derive(Clone)]
pub(super) struct Binary<'a, const BIG: bool> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a, const BIG: bool> Binary<'a, BIG> {
    /// From a byte of the file on.
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Binary { bytes, at: at.min(bytes.len()) }
    }

    /// The bytes of a number, the lowest first.
    #[inline]
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Box<Fault>> {
        let Some(&(mut bytes)) = self.bytes.get(self.at..).and_then(<[u8]>::first_chunk) else {
            return Err(ends(self.bytes.len()));
        };
        self.at += N;
        if BIG {
            bytes.reverse();
        }
        Ok(bytes)
    }
}

impl<const BIG: bool> Source for Binary<'_, BIG> {
    fn at(&self) -> usize {
        self.at
    }

    fn bytes_left(&self) -> usize {
        self.bytes.len() - self.at
    }

    fn most_items(&self, bytes: u64, _: u64) -> u64 {
        (self.bytes_left() as u64).checked_div(bytes).unwrap_or(u64::MAX)
    }

    #[inline]
    fn start_item(&mut self) -> Result<(), Box<Fault>> {
        Ok(())
    }

    #[inline]
    fn number(&mut self, kind: Scalar) -> Result<f64, Box<Fault>> {
        let at = self.at;
        let value = match kind {
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
            _ => return self.integer(kind).map(|value| value as f64),
        };
        if value.is_finite() {
            return Ok(value);
        }
        Err(Fault::new(at, format!("`{value}` is not a finite number"), "finite numbers"))
    }

    #[inline]
    fn integer(&mut self, kind: Scalar) -> Result<i64, Box<Fault>> {
        Ok(match kind {
            Scalar::I8 => i64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => i64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => i64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => i64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => i64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 => i64::from(u32::from_le_bytes(self.take()?)),
            // The header is refused where these should be whole numbers.
            Scalar::F32 | Scalar::F64 => self.number(kind)? as i64,
        })
    }

    #[inline]
    fn length(&mut self, kind: Scalar, item: Scalar) -> Result<u64, Box<Fault>> {
        let at = self.at;
        let length = self.integer(kind)?;
        let Ok(length) = u64::try_from(length) else {
            let message = format!("`{length}` is not a whole number from 0");
            return Err(Fault::new(at, message, "the length of a list"));
        };
        let most = self.bytes_left() as u64 / item.bytes();
        if length <= most {
            return Ok(length);
        }
        let message = format!("a list of {length} values, but the file is too short for them");
        Err(Fault::new(at, message, format!("at most {most} values in the bytes that follow")))
    }

    #[inline]
    fn skip(&mut self, _: u64, bytes: u64) -> Result<(), Box<Fault>> {
        if bytes > self.bytes_left() as u64 {
            return Err(ends(self.bytes.len()));
        }
        self.at += bytes as usize;
        Ok(())
    }

    #[inline]
    fn end_item(&mut self) -> Result<(), Box<Fault>> {
        Ok(())
    }

    fn count_rest(self, oddities: &mut Oddities) {
        oddities.add_many(Oddity::TrailingByte, self.bytes_left() as u64);
    }

    #[cold]
    fn expecting(fault: Box<Fault>, _: &Element) -> Box<Fault> {
        fault
    }
}
