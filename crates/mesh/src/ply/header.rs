//! The header of a PLY file: how its data is written, and what elements with what properties it has.

use crate::cursor::{Fault, shown};

/// Most elements: a header of nothing but elements must not take more memory than a mesh.
const MOST_ELEMENTS: usize = 256;

const FILE: &str = "a PLY file: `ply`, its `format`, its elements with their properties, and `end_header`";
const FORMAT: &str = "`format ascii 1.0`, `format binary_little_endian 1.0` or `format binary_big_endian 1.0`";
const ELEMENT: &str = "an element: `element NAME COUNT`";
const PROPERTY: &str = "a property: `property TYPE NAME` or `property list TYPE TYPE NAME`";
const TYPES: &str = "one of char, uchar, short, ushort, int, uint, float, double (int8 to uint32, float32, float64)";

/// How the data is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    LittleEndian,
    BigEndian,
}

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Scalar {
    fn from_name(name: &[u8]) -> Option<Scalar> {
        Some(match name {
            b"char" | b"int8" => Scalar::I8,
            b"uchar" | b"uint8" => Scalar::U8,
            b"short" | b"int16" => Scalar::I16,
            b"ushort" | b"uint16" => Scalar::U16,
            b"int" | b"int32" => Scalar::I32,
            b"uint" | b"uint32" => Scalar::U32,
            b"float" | b"float32" => Scalar::F32,
            b"double" | b"float64" => Scalar::F64,
            _ => return None,
        })
    }

    /// Its length in a binary file.
    pub(super) fn bytes(self) -> u64 {
        match self {
            Scalar::I8 | Scalar::U8 => 1,
            Scalar::I16 | Scalar::U16 => 2,
            Scalar::I32 | Scalar::U32 | Scalar::F32 => 4,
            Scalar::F64 => 8,
        }
    }

    pub(super) fn is_integer(self) -> bool {
        !matches!(self, Scalar::F32 | Scalar::F64)
    }
}

/// What a property holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    /// How many there are is of an integer type.
    List {
        count: Scalar,
        item: Scalar,
    },
}

/// One of the things that each item of an element has.
#[derive(Debug)]
pub(super) struct Property<'a> {
    pub(super) name: &'a [u8],
    pub(super) kind: Kind,
}

/// A kind of things, and how many of them there are.
#[derive(Debug)]
pub(super) struct Element<'a> {
    pub(super) name: &'a [u8],
    pub(super) count: u64,
    pub(super) properties: Vec<Property<'a>>,
    /// Byte of its line.
    pub(super) at: usize,
}

impl Element<'_> {
    /// Its items in words.
    pub(super) fn what(&self) -> String {
        match self.name {
            b"vertex" => "vertices".to_owned(),
            b"face" => "faces".to_owned(),
            name => format!("items of {}", shown(name)),
        }
    }
}

/// All that a header says.
#[derive(Debug)]
pub(super) struct Header<'a> {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element<'a>>,
    /// Byte of the line `end_header`.
    pub(super) at_end: usize,
    /// Byte at which the data starts.
    pub(super) data: usize,
}

/// The words of a line.
type Words<'w, 'a> = &'w mut dyn Iterator<Item = &'a [u8]>;

impl<'a> Header<'a> {
    pub(super) fn parse(text: &'a [u8]) -> Result<Header<'a>, Box<Fault>> {
        let mut lines = Lines { text, next: if text.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 } };
        read_magic(&mut lines)?;
        let mut encoding = None;
        let mut elements: Vec<Element> = Vec::new();
        while let Some((at, line)) = lines.next() {
            let mut words = line.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            match words.next() {
                None | Some(b"comment" | b"obj_info") => continue,
                Some(b"format") if encoding.is_some() => return Err(Fault::new(at, "a second `format`", FORMAT)),
                Some(b"format") => encoding = Some(read_format(at, &mut words)?),
                Some(b"element") => {
                    if elements.len() == MOST_ELEMENTS {
                        return Err(Fault::new(at, "too many elements", format!("at most {MOST_ELEMENTS}")));
                    }
                    elements.push(read_element(at, &mut words)?);
                }
                Some(b"property") => match elements.last_mut() {
                    Some(element) => element.properties.push(read_property(at, &mut words)?),
                    None => return Err(Fault::new(at, "a property before the first element", ELEMENT)),
                },
                Some(b"end_header") => {
                    let encoding = encoding.ok_or_else(|| Fault::new(at, "the header has no `format`", FORMAT))?;
                    return Ok(Header { encoding, elements, at_end: at, data: lines.next });
                }
                Some(word) => {
                    let expected = "`comment`, `obj_info`, `element`, `property` or `end_header`";
                    return Err(Fault::new(at, format!("{} is no line of a header", shown(word)), expected));
                }
            }
            if let Some(word) = words.next() {
                return Err(Fault::new(at, format!("{} is too much", shown(word)), "the end of the line"));
            }
        }
        Err(Fault::new(text.len(), "the header does not end", "`end_header` on a line of its own"))
    }
}

/// The lines of a header, without their ends.
struct Lines<'a> {
    text: &'a [u8],
    next: usize,
}

impl<'a> Iterator for Lines<'a> {
    /// With the byte at which it starts.
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        let at = self.next;
        let rest = self.text.get(at..).filter(|rest| !rest.is_empty())?;
        let line = rest.split(|&byte| byte == b'\n').next()?;
        self.next = (at + line.len() + 1).min(self.text.len());
        Some((at, line))
    }
}

fn read_magic(lines: &mut Lines) -> Result<(), Box<Fault>> {
    let Some((at, line)) = lines.next() else { return Err(Fault::new(0, "the file is empty", FILE)) };
    if line.trim_ascii_end() == b"ply" {
        return Ok(());
    }
    if line.starts_with(b"ply\r") {
        return Err(Fault::new(at, "lines end with carriage returns alone", "lines that end with LF, or CR and LF"));
    }
    let word = line.split(u8::is_ascii_whitespace).find(|word| !word.is_empty()).unwrap_or_default();
    Err(Fault::new(at, format!("the file starts with {}", shown(word)), FILE))
}

fn read_format(at: usize, words: Words) -> Result<Encoding, Box<Fault>> {
    let encoding = match words.next() {
        Some(b"ascii") => Encoding::Ascii,
        Some(b"binary_little_endian") => Encoding::LittleEndian,
        Some(b"binary_big_endian") => Encoding::BigEndian,
        Some(word) => return Err(Fault::new(at, format!("{} is no format of a PLY file", shown(word)), FORMAT)),
        None => return Err(missing(at, "word", FORMAT)),
    };
    match words.next() {
        Some(b"1.0") => Ok(encoding),
        Some(word) => Err(Fault::new(at, format!("{} is no version of PLY", shown(word)), FORMAT)),
        None => Err(missing(at, "word", FORMAT)),
    }
}

fn read_element<'a>(at: usize, words: Words<'_, 'a>) -> Result<Element<'a>, Box<Fault>> {
    let name = words.next().ok_or_else(|| missing(at, "name", ELEMENT))?;
    let count = words.next().ok_or_else(|| missing(at, "number", ELEMENT))?;
    if !count.iter().all(u8::is_ascii_digit) {
        return Err(Fault::new(at, format!("{} is not a whole number from 0", shown(count)), ELEMENT));
    }
    // What is no u64 is larger than any file.
    let count = std::str::from_utf8(count).ok().and_then(|count| count.parse().ok()).unwrap_or(u64::MAX);
    Ok(Element { name, count, properties: Vec::new(), at })
}

fn read_property<'a>(at: usize, words: Words<'_, 'a>) -> Result<Property<'a>, Box<Fault>> {
    let scalar = |name: Option<&[u8]>| {
        let name = name.ok_or_else(|| missing(at, "type", PROPERTY))?;
        Scalar::from_name(name)
            .ok_or_else(|| Fault::new(at, format!("{} is no type of a property", shown(name)), TYPES))
    };
    let kind = match words.next() {
        Some(b"list") => {
            let (count_name, item) = (words.next(), words.next());
            let count = scalar(count_name)?;
            if !count.is_integer() {
                let name = shown(count_name.unwrap_or_default());
                let message = format!("the length of a list is of the type {name}");
                return Err(Fault::new(at, message, "an integer type, such as `uchar`"));
            }
            Kind::List { count, item: scalar(item)? }
        }
        name => Kind::Scalar(scalar(name)?),
    };
    let name = words.next().ok_or_else(|| missing(at, "name", PROPERTY))?;
    Ok(Property { name, kind })
}

#[cold]
fn missing(at: usize, what: &str, expected: &str) -> Box<Fault> {
    Fault::new(at, format!("a {what} is missing at the end of the line"), expected)
}
