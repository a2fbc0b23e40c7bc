//! Pictures that are compared: read from files that the fifth hand writes, and from JPEG.

use image::{DynamicImage, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use tracer_core::{srgb_decode, srgb_encode};

/// What the numbers of a picture are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Display values, sRGB, 0 to 1 (PNG, JPEG).
    Display,
    /// Linear radiance, 1 is white (EXR, HDR, PFM).
    Linear,
}

/// A picture with three numbers a pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// What the numbers are.
    pub kind: Kind,
    /// Red, green, blue of each pixel; all finite.
    pub values: Vec<f32>,
}

/// Why a file is no picture to compare.
#[derive(Debug, thiserror::Error)]
pub enum PictureError {
    /// The file cannot be read.
    #[error("cannot read {}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The file is no picture, or a broken one.
    #[error("{} is not a picture that can be read: {message}", path.display())]
    Broken {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        message: String,
    },
    /// A number of the picture is infinite or no number.
    #[error("{} cannot be compared: pixel ({x}, {y}) is not finite", path.display())]
    NotFinite {
        /// The file.
        path: PathBuf,
        /// Column.
        x: usize,
        /// Row.
        y: usize,
    },
}

impl Picture {
    /// Reads a PNG, JPEG, EXR, HDR or PFM file; its content decides which.
    ///
    /// # Errors
    /// When it cannot be read, is none of these, or holds numbers that are not finite.
    pub fn load(path: &Path) -> Result<Self, PictureError> {
        let bytes = std::fs::read(path).map_err(|source| PictureError::Io { path: path.to_owned(), source })?;
        Picture::of(&bytes, path)
    }

    /// The same of the bytes of a file of that name.
    ///
    /// # Errors
    /// When they are none of these, or hold numbers that are not finite.
    pub fn of(bytes: &[u8], path: &Path) -> Result<Self, PictureError> {
        let broken = |message: String| PictureError::Broken { path: path.to_owned(), message };
        let picture = if bytes.starts_with(b"PF\n") || bytes.starts_with(b"Pf\n") { pfm(bytes) } else { decode(bytes) };
        let picture = picture.map_err(broken)?;
        match picture.values.iter().position(|value| !value.is_finite()) {
            None => Ok(picture),
            Some(at) => {
                let (pixel, width) = (at / 3, picture.width as usize);
                Err(PictureError::NotFinite { path: path.to_owned(), x: pixel % width, y: pixel / width })
            }
        }
    }

    /// The same as display values: linear ones clipped to 0..=1 and sRGB-encoded.
    pub fn display(&self) -> Vec<f32> {
        match self.kind {
            Kind::Display => self.values.clone(),
            Kind::Linear => self.values.iter().map(|&x| srgb_encode(f64::from(x).clamp(0.0, 1.0)) as f32).collect(),
        }
    }
}

/// The checkerboard that editors show behind pictures with alpha, linear: two greys, so that whatever covers more or
/// less is another picture, black things and white ones, too.
fn checkerboard([x, y]: [usize; 2]) -> f64 {
    if (x / 8 + y / 8) % 2 == 0 { 0.5 } else { 0.25 }
}

/// A pixel (column, row) of a picture with alpha, sRGB and not multiplied, as it is seen over the checkerboard: sRGB.
pub fn before_checkerboard(color: [f32; 3], alpha: f32, at: [usize; 2]) -> [f64; 3] {
    let alpha = f64::from(alpha);
    color.map(|x| srgb_encode((srgb_decode(x.into()) * alpha + (1.0 - alpha) * checkerboard(at)).clamp(0.0, 1.0)))
}

fn decode(bytes: &[u8]) -> Result<Picture, String> {
    let format = image::guess_format(bytes).map_err(|_| "it is no PNG, JPEG, EXR, HDR or PFM".to_owned())?;
    let kind = match format {
        ImageFormat::Png | ImageFormat::Jpeg => Kind::Display,
        ImageFormat::OpenExr | ImageFormat::Hdr => Kind::Linear,
        other => return Err(format!("it is {}, not PNG, JPEG, EXR, HDR or PFM", other.to_mime_type())),
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(MAX_SIDE);
    limits.max_image_height = Some(MAX_SIDE);
    limits.max_alloc = Some(MOST_BYTES);
    reader.limits(limits);
    let picture: DynamicImage = reader.decode().map_err(|error| error.to_string())?;
    let (width, height) = (picture.width(), picture.height());
    if width == 0 || height == 0 {
        return Err("it has no pixels".to_owned());
    }
    let values = if picture.color().has_alpha() {
        let pixels = picture.into_rgba32f();
        let over = |(k, &[r, g, b, a]): (usize, &[f32; 4])| {
            let at = [k % width as usize, k / width as usize];
            match kind {
                Kind::Display => before_checkerboard([r, g, b], a, at).map(|x| x as f32),
                // Multiplied already.
                Kind::Linear => [r, g, b].map(|x| x + (1.0 - a) * checkerboard(at) as f32),
            }
        };
        pixels.as_raw().as_chunks::<4>().0.iter().enumerate().flat_map(over).collect()
    } else {
        picture.into_rgb32f().into_raw()
    };
    Ok(Picture { width, height, kind, values })
}

/// Most pixels along a side.
const MAX_SIDE: u32 = 1 << 16;
/// Most bytes that a decoder may take: a file that promises more than that is not believed.
const MOST_BYTES: u64 = 4 << 30;

/// Portable float map: `PF` or `Pf` (grey), width, height, scale (negative: little-endian), then rows from the bottom.
fn pfm(bytes: &[u8]) -> Result<Picture, String> {
    let mut lines = bytes.splitn(4, |&byte| byte == b'\n');
    let mut line = || lines.next().and_then(|line| std::str::from_utf8(line).ok()).map(str::trim);
    let header = "the header of a PFM is `PF`, width and height, and a scale on three lines";
    let channels = if line() == Some("PF") { 3 } else { 1 };
    let (width, height) = line().and_then(|size| size.split_once(' ')).ok_or(header)?;
    let side = |text: &str| text.trim().parse().ok().filter(|side| (1..=MAX_SIDE).contains(side)).ok_or(header);
    let (width, height): (u32, u32) = (side(width)?, side(height)?);
    let scale: f32 = line().and_then(|scale| scale.parse().ok()).ok_or(header)?;
    let numbers = lines.next().ok_or(header)?;
    let expected = u64::from(width) * u64::from(height) * channels * 4;
    if numbers.len() as u64 != expected {
        return Err(format!("its header promises {expected} bytes of pixels, and {} are there", numbers.len()));
    }
    let decode = if scale < 0.0 { f32::from_le_bytes } else { f32::from_be_bytes };
    let number = |four: &[u8]| <[u8; 4]>::try_from(four).map(decode).unwrap_or(f32::NAN);
    let row = 4 * channels as usize * width as usize;
    let repeat = if channels == 3 { 1 } else { 3 };
    let values = numbers
        .chunks_exact(row)
        .rev()
        .flat_map(|row| row.chunks_exact(4).flat_map(|four| std::iter::repeat_n(number(four), repeat)))
        .collect();
    Ok(Picture { width, height, kind: Kind::Linear, values })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pfm_rows_go_upwards() {
        let mut bytes = b"Pf\n1 2\n1.0\n".to_vec();
        bytes.extend(2.0f32.to_be_bytes());
        bytes.extend(3.0f32.to_be_bytes());
        let picture = pfm(&bytes).expect("a right file");
        assert_eq!(picture.values, [3.0, 3.0, 3.0, 2.0, 2.0, 2.0]);
    }

    #[test]
    fn broken_pfms_are_refused() {
        for bad in
            ["PF\n", "PF\n1 1\n", "PF\n1 1\n-1.0\n", "PF\n60000 60000\n-1.0\n1234", "PF\n0 1\n-1\n", "PF\nx y\nz\n"]
        {
            assert!(pfm(bad.as_bytes()).is_err(), "{bad:?}");
        }
    }
}
