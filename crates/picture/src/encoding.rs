//! The kinds of picture files.

use std::path::Path;

/// Bits per channel of a PNG.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Bits {
    /// 8 bits: 256 code values.
    #[default]
    Eight,
    /// 16 bits: 65536 code values.
    Sixteen,
}

/// How a picture is put into bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Encoding {
    /// PNG: display values, sRGB.
    Png(Bits),
    /// OpenEXR: linear, 32-bit floats, ZIP.
    Exr,
    /// Radiance RGBE: linear, 8 bits of mantissa, one exponent for the three channels.
    Hdr,
    /// Portable float map: linear, 32-bit floats.
    Pfm,
}

/// A name that is none of the kinds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not a kind of picture that is written")]
pub struct UnknownEncoding;

impl Encoding {
    /// By a name as in `--format`, large or small letters; PNG with these bits.
    ///
    /// # Errors
    /// When the name is none of [`Encoding::NAMES`].
    pub fn from_name(name: &str, bits: Bits) -> Result<Self, UnknownEncoding> {
        match name.to_ascii_lowercase().as_str() {
            "png" => Ok(Encoding::Png(bits)),
            "exr" => Ok(Encoding::Exr),
            "hdr" => Ok(Encoding::Hdr),
            "pfm" => Ok(Encoding::Pfm),
            _ => Err(UnknownEncoding),
        }
    }

    /// By the file name's extension; PNG with these bits.
    ///
    /// # Errors
    /// When there is no extension or it is none of [`Encoding::NAMES`].
    pub fn from_path(path: &Path, bits: Bits) -> Result<Self, UnknownEncoding> {
        let extension = path.extension().and_then(|e| e.to_str()).ok_or(UnknownEncoding)?;
        Encoding::from_name(extension, bits)
    }

    /// All names.
    pub const NAMES: [&str; 4] = ["png", "exr", "hdr", "pfm"];

    /// Its name, which is the extension of its files.
    pub fn name(self) -> &'static str {
        match self {
            Encoding::Png(_) => "png",
            Encoding::Exr => "exr",
            Encoding::Hdr => "hdr",
            Encoding::Pfm => "pfm",
        }
    }
}
