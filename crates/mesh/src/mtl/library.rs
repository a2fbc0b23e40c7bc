//! Reads an MTL file: what it says, material by material.

use crate::cursor::{Blanks, Cursor, Fault, shown};
use crate::error::MeshError;
use scene_format::desc::Color;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// An MTL file.
#[derive(Default)]
pub(super) struct Library {
    pub(super) materials: Vec<MtlMaterial>,
}

/// A material as its file says it; `None`: it does not.
#[derive(Default)]
pub(super) struct MtlMaterial {
    pub(super) name: String,
    /// The MTL file.
    pub(super) file: PathBuf,
    /// `Kd`.
    pub(super) diffuse: Option<Color>,
    /// `Ks`.
    pub(super) specular: Option<Color>,
    /// `Ns`.
    pub(super) exponent: Option<f64>,
    /// `Ni`.
    pub(super) ior: Option<f64>,
    /// `d`, or 1 - `Tr` where there is no `d`.
    pub(super) opacity: Option<f64>,
    /// `Ke`.
    pub(super) emission: Option<Color>,
    /// `Tf`.
    pub(super) transmission: Option<Color>,
    /// `illum`.
    pub(super) illumination: Option<i64>,
    /// `map_Kd`.
    pub(super) picture: Option<Picture>,
    /// What else it says, as messages name it.
    pub(super) unsupported: BTreeSet<String>,
    /// Whether `opacity` is from `d`.
    has_d: bool,
}

/// A picture and how it is laid.
pub(super) struct Picture {
    /// As written.
    pub(super) name: String,
    /// `-clamp on`.
    pub(super) clamp: bool,
}

const COLOR: &str = "a colour: 1 or 3 numbers";
const NUMBER: &str = "one number";

impl Library {
    /// Parses the text of the file at `path`.
    pub(super) fn parse(text: &[u8], path: &Path) -> Result<Library, MeshError> {
        let mut library = Library::default();
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        let mut cursor = Cursor::new(text, Blanks { comma: false, continuation: true });
        library.parse_statements(&mut cursor, path).map_err(|fault| MeshError::at_line(path, text, *fault))?;
        Ok(library)
    }

    fn parse_statements(&mut self, cursor: &mut Cursor, path: &Path) -> Result<(), Box<Fault>> {
        while cursor.find_statement() {
            let start = cursor.at();
            let word = cursor.word();
            cursor.skip_blanks();
            if word == b"newmtl" {
                let name = parse_text(cursor, "the name of a material: `newmtl NAME`")?.to_owned();
                self.materials.push(MtlMaterial { name, file: path.to_owned(), ..MtlMaterial::default() });
            } else if let Some(material) = self.materials.last_mut() {
                material.parse_statement(word, cursor)?;
            } else {
                let message = format!("{} stands before the first material", shown(word));
                return Err(Fault::new(start, message, "an MTL file: `newmtl NAME`, then what the material is"));
            }
            cursor.skip_statement();
        }
        Ok(())
    }
}

impl MtlMaterial {
    fn parse_statement(&mut self, word: &[u8], cursor: &mut Cursor) -> Result<(), Box<Fault>> {
        match word {
            b"Kd" => self.diffuse = self.parse_color("Kd", cursor)?.or(self.diffuse),
            b"Ks" => self.specular = self.parse_color("Ks", cursor)?.or(self.specular),
            b"Ke" => self.emission = self.parse_color("Ke", cursor)?.or(self.emission),
            b"Tf" => self.transmission = self.parse_color("Tf", cursor)?.or(self.transmission),
            b"Ns" => self.exponent = Some(parse_number(cursor)?),
            b"Ni" => self.ior = Some(parse_number(cursor)?),
            b"illum" => self.illumination = Some(parse_number(cursor)? as i64),
            b"d" => {
                if cursor.rest().starts_with(b"-halo") {
                    cursor.word();
                    self.unsupported.insert("`d -halo`".to_owned());
                }
                self.opacity = Some(parse_number(cursor)?);
                self.has_d = true;
            }
            // Some programs write `Tr` as the opacity: `d` is to be trusted where both stand.
            b"Tr" if self.has_d => {}
            b"Tr" => self.opacity = Some(1.0 - parse_number(cursor)?),
            b"map_Kd" => self.picture = Some(self.parse_picture(cursor)?),
            b"Ka" | b"map_Ka" => {}
            _ => {
                if !says_nothing(cursor) {
                    self.unsupported.insert(shown(word));
                }
            }
        }
        Ok(())
    }

    /// A colour; `None` when it is given as a spectrum or in another space.
    fn parse_color(&mut self, statement: &str, cursor: &mut Cursor) -> Result<Option<Color>, Box<Fault>> {
        for space in ["spectral", "xyz"] {
            if cursor.rest().starts_with(space.as_bytes()) {
                self.unsupported.insert(format!("`{statement} {space}`"));
                return Ok(None);
            }
        }
        let mut color = [0.0; 3];
        for (count, part) in color.iter_mut().enumerate() {
            cursor.skip_blanks();
            if count == 1 && cursor.is_at_end_of_statement() {
                return Ok(Some([color[0]; 3]));
            }
            *part = number(cursor, COLOR)?;
        }
        expect_end(cursor, COLOR)?;
        Ok(Some(color))
    }

    fn parse_picture(&mut self, cursor: &mut Cursor) -> Result<Picture, Box<Fault>> {
        let mut clamp = false;
        while cursor.is_at(b'-') {
            let option = cursor.word();
            let values = Values::of_option(option, cursor);
            let is_default = match option {
                b"-clamp" => {
                    clamp = values.words == ["on"];
                    true
                }
                b"-o" | b"-t" => values.are_all(0.0),
                b"-s" => values.are_all(1.0),
                b"-mm" => values.words.len() == 2 && values.are(&[0.0, 1.0]),
                b"-bm" | b"-boost" => values.are_all(if option == b"-bm" { 1.0 } else { 0.0 }),
                b"-blendu" | b"-blendv" => values.words == ["on"],
                b"-cc" => values.words == ["off"],
                _ => false,
            };
            if !is_default {
                self.unsupported.insert(format!("`map_Kd {}", shown(option).trim_start_matches('`')));
            }
        }
        let name = parse_text(cursor, "a picture: `map_Kd FILE.png`")?.to_owned();
        Ok(Picture { name, clamp })
    }
}

/// What stands after an option of a map.
struct Values {
    words: Vec<String>,
}

impl Values {
    /// Takes as many words as the option has; only numbers where their count is open.
    fn of_option(option: &[u8], cursor: &mut Cursor) -> Values {
        let (most, only_numbers) = match option {
            b"-o" | b"-s" | b"-t" => (3, true),
            b"-mm" => (2, true),
            b"-blendu" | b"-blendv" | b"-cc" | b"-clamp" | b"-imfchan" | b"-type" => (1, false),
            _ => (1, true),
        };
        let mut words = Vec::new();
        cursor.skip_blanks();
        while words.len() < most && !cursor.is_at_end_of_statement() {
            if only_numbers && cursor.clone().number().is_err() {
                break;
            }
            words.push(String::from_utf8_lossy(cursor.word()).into_owned());
            cursor.skip_blanks();
        }
        Values { words }
    }

    fn are_all(&self, value: f64) -> bool {
        self.words.iter().all(|word| word.parse() == Ok(value))
    }

    fn are(&self, values: &[f64]) -> bool {
        self.words.iter().zip(values).all(|(word, &value)| word.parse() == Ok(value))
    }
}

/// Whether a statement that is not known here has only zeros (`Pm 0`), so that leaving it out changes nothing.
fn says_nothing(cursor: &mut Cursor) -> bool {
    while !cursor.is_at_end_of_statement() {
        if cursor.number().ok() != Some(0.0) {
            return false;
        }
        cursor.skip_blanks();
    }
    true
}

fn number(cursor: &mut Cursor, expected: &str) -> Result<f64, Box<Fault>> {
    cursor.number().map_err(|fault| fault.expecting(expected))
}

fn parse_number(cursor: &mut Cursor) -> Result<f64, Box<Fault>> {
    cursor.skip_blanks();
    let value = number(cursor, NUMBER)?;
    expect_end(cursor, NUMBER)?;
    Ok(value)
}

fn expect_end(cursor: &mut Cursor, expected: &str) -> Result<(), Box<Fault>> {
    cursor.skip_blanks();
    if cursor.is_at_end_of_statement() {
        return Ok(());
    }
    let at = cursor.at();
    Err(Fault::new(at, format!("{} is too much", shown(cursor.word())), expected))
}

/// The rest of the line, which must be something.
fn parse_text<'a>(cursor: &mut Cursor<'a>, expected: &str) -> Result<&'a str, Box<Fault>> {
    let start = cursor.at();
    let text = cursor.name();
    match std::str::from_utf8(text) {
        Ok("") => Err(Fault::new(start, "a name is missing at the end of the line", expected)),
        Ok(text) => Ok(text),
        Err(_) => Err(Fault::new(start, format!("{} is not UTF-8 text", shown(text)), expected)),
    }
}
