//! What a picture file tells of itself, read from its head alone: pixels are not looked at. Whoever made the file may
//! mean ill, so a head has a limit, and so has what comes of it unpacked.

use super::{Bits, Encoding, Provenance};
use png::{BitDepth, Decoder, DecodingError, Limits};
use std::fs::File;
use std::io::{self, BufReader, Cursor, Read};
use std::path::Path;

/// What a picture file tells of itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Told {
    /// The kind of file, by its content.
    pub encoding: Encoding,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Names of the layers in it, of those that have some of the form `NAME.CHANNEL`: EXR alone has them.
    pub layers: Vec<String>,
    /// The program that wrote it.
    pub software: Option<String>,
    /// The scene file's name and the settings, for people: one text in EXR.
    pub comment: Option<String>,
    /// The scene file's text.
    pub scene: Option<String>,
    /// What it takes to make it again ([`Provenance::record`]).
    pub record: Option<String>,
}

/// Why a file tells nothing.
#[derive(Debug, thiserror::Error)]
pub enum ToldError {
    /// It cannot be read.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// It is no PNG, EXR, HDR or PFM.
    #[error("it is no PNG, EXR, HDR or PFM")]
    Foreign,
    /// Its head is cut off, damaged or too large to be believed.
    #[error("its head cannot be read: {0}")]
    Broken(String),
}

/// More than that no head has: texts are limited, and so are the names in an EXR.
const MAX_HEAD: u64 = 64 << 20;

/// Reads what a picture tells of itself.
///
/// # Errors
/// When the file cannot be read, is none of the kinds that are written here, or its head is broken.
pub fn told(path: &Path) -> Result<Told, ToldError> {
    let file = File::open(path)?;
    if !file.metadata()?.is_file() {
        return Err(ToldError::Io(io::Error::other("it is no file")));
    }
    told_in(BufReader::new(file))
}

/// The same of the bytes of a file, of which no more than the head is read.
///
/// # Errors
/// As [`told`].
pub fn told_in(file: impl Read) -> Result<Told, ToldError> {
    let mut file = file.take(MAX_HEAD);
    let mut magic = Vec::new();
    file.by_ref().take(4).read_to_end(&mut magic)?;
    let whole = Cursor::new(magic.clone()).chain(file);
    match magic.as_slice() {
        b"\x89PNG" => of_png(whole),
        b"\x76\x2f\x31\x01" => of_exr(whole),
        [b'#', b'?', ..] => of_hdr(whole),
        [b'P', b'F' | b'f', b'\n', ..] => of_pfm(whole),
        _ => Err(ToldError::Foreign),
    }
}

fn broken(what: impl Into<String>) -> ToldError {
    ToldError::Broken(what.into())
}

/// The texts before the pixels: that is where this program writes them.
fn of_png(file: impl Read) -> Result<Told, ToldError> {
    // The decoder wants to seek; a head is all that is read.
    let mut bytes = Vec::new();
    head_of_png(file, &mut bytes)?;
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: MAX_HEAD as usize });
    decoder.set_ignore_iccp_chunk(true);
    let wrong = |error: DecodingError| broken(error.to_string());
    let reader = decoder.read_info().map_err(wrong)?;
    let info = reader.info();
    let text = |keyword: &str, most: usize| {
        let chunk = info.utf8_text.iter().find(|chunk| chunk.keyword == keyword);
        let Some(mut chunk) = chunk.cloned() else { return Ok(None) };
        chunk.decompress_text_with_limit(most).map_err(|_| broken(format!("the text `{keyword}` is too long")))?;
        let text = chunk.get_text().map_err(wrong)?;
        // What is not packed has no limit of its own.
        if text.len() > most { Err(broken(format!("the text `{keyword}` is too long"))) } else { Ok(Some(text)) }
    };
    const LINE: usize = 1 << 20;
    let lines = [text("Source", LINE)?, text("Comment", LINE)?];
    let comment = lines.into_iter().flatten().collect::<Vec<_>>().join(": ");
    Ok(Told {
        encoding: Encoding::Png(if info.bit_depth == BitDepth::Sixteen { Bits::Sixteen } else { Bits::Eight }),
        width: info.width,
        height: info.height,
        layers: Vec::new(),
        software: text("Software", LINE)?,
        comment: Some(comment).filter(|comment| !comment.is_empty()),
        // A NUL of the text takes three bytes there.
        scene: text("Scene", 3 * Provenance::MAX_SCENE_BYTES)?,
        record: text(Provenance::RECORD, Provenance::MAX_RECORD_BYTES)?,
    })
}

/// All up to the head of the first pixels.
fn head_of_png(mut file: impl Read, head: &mut Vec<u8>) -> Result<(), ToldError> {
    const SIGNATURE: u64 = 8;
    let mut read = |head: &mut Vec<u8>, count: u64| {
        let got = file.by_ref().take(count).read_to_end(head)? as u64;
        if got < count { Err(broken("it ends too early, or is too large")) } else { Ok(()) }
    };
    read(head, SIGNATURE)?;
    loop {
        // Length and name; of what is no pixels, the data and their checksum.
        read(head, 8)?;
        let length = head[head.len() - 8..].first_chunk().map_or(0, |bytes| u32::from_be_bytes(*bytes));
        if matches!(&head[head.len() - 4..], b"IDAT" | b"IEND") {
            return Ok(());
        }
        read(head, u64::from(length) + 4)?;
    }
}

/// The attributes of the first part.
fn of_exr(mut file: impl Read) -> Result<Told, ToldError> {
    const LONGEST_NAME: usize = 255;
    let mut told = Told {
        encoding: Encoding::Exr,
        width: 0,
        height: 0,
        layers: Vec::new(),
        software: None,
        comment: None,
        scene: None,
        record: None,
    };
    bytes(&mut file, 8)?;
    loop {
        let name = until_nul(&mut file, LONGEST_NAME)?;
        if name.is_empty() {
            break;
        }
        let kind = until_nul(&mut file, LONGEST_NAME)?;
        let size = bytes(&mut file, 4)?.first_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes));
        let value = bytes(&mut file, size as usize)?;
        let text = |most: usize| match String::from_utf8(value.clone()) {
            Ok(text) if text.len() <= most => Ok(Some(text)),
            _ => Err(broken(format!("the text `{}` is too long, or no UTF-8", String::from_utf8_lossy(&name)))),
        };
        const LINE: usize = 1 << 20;
        match (name.as_slice(), kind.as_slice()) {
            (b"software", b"string") => told.software = text(LINE)?,
            (b"comments", b"string") => told.comment = text(LINE)?,
            (b"scene", b"string") => told.scene = text(Provenance::MAX_SCENE_BYTES)?,
            (name, b"string") if name == Provenance::RECORD.as_bytes() => {
                told.record = text(Provenance::MAX_RECORD_BYTES)?;
            }
            (b"channels", b"chlist") => told.layers = layers(&value)?,
            (b"dataWindow", b"box2i") => {
                let corners: Vec<i64> =
                    value.as_chunks::<4>().0.iter().map(|bytes| i32::from_le_bytes(*bytes).into()).collect();
                let &[left, top, right, bottom] = corners.as_slice() else { return Err(broken("its size is damaged")) };
                let side = |from: i64, to: i64| u32::try_from(to - from + 1).ok();
                let sides = side(left, right).zip(side(top, bottom));
                (told.width, told.height) = sides.ok_or_else(|| broken("its size is damaged"))?;
            }
            _ => {}
        }
    }
    if told.width == 0 || told.height == 0 { Err(broken("its size is missing")) } else { Ok(told) }
}

/// The layers of a list of channels, each once.
fn layers(mut list: &[u8]) -> Result<Vec<String>, ToldError> {
    /// Kind, marks and sampling of a channel, which stand behind its name.
    const REST: usize = 16;
    const LONGEST_NAME: usize = 255;
    let mut layers: Vec<String> = Vec::new();
    loop {
        let name = until_nul(&mut list, LONGEST_NAME)?;
        if name.is_empty() {
            return Ok(layers);
        }
        bytes(&mut list, REST)?;
        let name = String::from_utf8_lossy(&name);
        // The channels of a layer stand together: they are in the order of the alphabet.
        if let Some((layer, _)) = name.rsplit_once('.')
            && layers.last().is_none_or(|last| last != layer)
        {
            layers.push(layer.to_owned());
        }
    }
}

/// So many bytes; memory is taken as they come.
fn bytes(file: &mut impl Read, count: usize) -> Result<Vec<u8>, ToldError> {
    let mut bytes = Vec::new();
    file.by_ref().take(count as u64).read_to_end(&mut bytes)?;
    if bytes.len() < count { Err(broken("it ends too early, or is too large")) } else { Ok(bytes) }
}

/// What stands before the next NUL.
fn until_nul(file: &mut impl Read, most: usize) -> Result<Vec<u8>, ToldError> {
    until(file, 0, most)
}

fn until(file: &mut impl Read, end: u8, most: usize) -> Result<Vec<u8>, ToldError> {
    let mut found = Vec::new();
    loop {
        let byte = bytes(file, 1)?[0];
        if byte == end {
            return Ok(found);
        }
        if found.len() == most {
            return Err(broken("a name or line in it is too long"));
        }
        found.push(byte);
    }
}

fn line(file: &mut impl Read) -> Result<String, ToldError> {
    const LONGEST: usize = 1 << 16;
    Ok(String::from_utf8_lossy(&until(file, b'\n', LONGEST)?).trim_end().to_owned())
}

fn of_hdr(mut file: impl Read) -> Result<Told, ToldError> {
    const LINES: usize = 1000;
    let (mut software, mut comments) = (None, Vec::new());
    for _ in 0..LINES {
        let text = line(&mut file)?;
        if text.is_empty() {
            let size = line(&mut file)?;
            let words: Vec<&str> = size.split(' ').collect();
            let &["-Y", height, "+X", width] = words.as_slice() else {
                return Err(broken("its size is not -Y HEIGHT +X WIDTH"));
            };
            let side = |text: &str| text.parse().map_err(|_| broken("its size is damaged"));
            let (width, height) = (side(width)?, side(height)?);
            let comment = Some(comments.join(": ")).filter(|comment: &String| !comment.is_empty());
            let (encoding, layers) = (Encoding::Hdr, Vec::new());
            return Ok(Told { encoding, width, height, layers, software, comment, scene: None, record: None });
        }
        if let Some(name) = text.strip_prefix("SOFTWARE=") {
            software = Some(name.to_owned());
        } else if let Some(comment) = text.strip_prefix("# ") {
            comments.push(comment.strip_prefix("scene ").unwrap_or(comment).to_owned());
        }
    }
    Err(broken("it has no end"))
}

fn of_pfm(mut file: impl Read) -> Result<Told, ToldError> {
    line(&mut file)?;
    let size = line(&mut file)?;
    let side = |text: &str| text.trim().parse().map_err(|_| broken("its size is damaged"));
    let (width, height) = size.split_once(' ').ok_or_else(|| broken("its size is damaged"))?;
    let (width, height) = (side(width)?, side(height)?);
    let (encoding, layers) = (Encoding::Pfm, Vec::new());
    Ok(Told { encoding, width, height, layers, software: None, comment: None, scene: None, record: None })
}
