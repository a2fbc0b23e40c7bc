//! Pictures from memory, as programs have them.

use super::environment::panorama;
use super::heights::landscape;
use super::{Channel, Landscape, MAX_SIDE, Panorama, Reading, Texels, Texture, TextureError, from_picture, no_alpha};
use image::{DynamicImage, ImageBuffer, Luma, LumaA, Rgb, Rgba};
use rayon::prelude::*;
use scene_format::Diagnostics;
use std::path::Path;

/// A picture in memory, which stands in a scene as a file would ([`crate::Assets`]). Row 0 is the top row, each row
/// from left to right.
///
/// ```
/// use tracer_core::texture::Pixels;
///
/// let grey = Pixels::srgb8(2, 1, 1, vec![0, 255])?;
/// let colors = Pixels::linear(1, 1, 3, vec![0.5, 0.25, 0.0])?;
/// assert!(Pixels::srgb8(2, 2, 3, vec![0; 11]).is_err());
/// # Ok::<(), tracer_core::texture::PixelsError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    picture: DynamicImage,
    /// Of floats, whose picture has none; empty: there is none.
    alpha: Vec<f32>,
}

/// Why numbers are no picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PixelsError {
    /// A side is zero or too long.
    #[error("a picture has 1 to {MAX_SIDE} pixels along a side, and this one would have {width} x {height}")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// It has so many channels.
    #[error("a picture has 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA) channels, and not {0}")]
    Channels(u32),
    /// There are too few or too many numbers.
    #[error("{width} x {height} pixels of {channels} channels are not {numbers} numbers")]
    Numbers {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Numbers of a pixel.
        channels: u32,
        /// How many there are.
        numbers: usize,
    },
}

impl Pixels {
    /// Bytes in sRGB, as PNG and JPEG files have them: grey, grey and alpha, RGB, or RGBA.
    ///
    /// # Errors
    /// When they are no picture of this size.
    pub fn srgb8(width: u32, height: u32, channels: u32, values: Vec<u8>) -> Result<Self, PixelsError> {
        let size = checked(width, height, channels, values.len())?;
        Ok(Pixels {
            picture: match channels {
                1 => size.made::<Luma<u8>>(values)?.into(),
                2 => size.made::<LumaA<u8>>(values)?.into(),
                3 => size.made::<Rgb<u8>>(values)?.into(),
                _ => size.made::<Rgba<u8>>(values)?.into(),
            },
            alpha: Vec::new(),
        })
    }

    /// As [`Pixels::srgb8`], with 16 bits a number.
    ///
    /// # Errors
    /// When they are no picture of this size.
    pub fn srgb16(width: u32, height: u32, channels: u32, values: Vec<u16>) -> Result<Self, PixelsError> {
        let size = checked(width, height, channels, values.len())?;
        Ok(Pixels {
            picture: match channels {
                1 => size.made::<Luma<u16>>(values)?.into(),
                2 => size.made::<LumaA<u16>>(values)?.into(),
                3 => size.made::<Rgb<u16>>(values)?.into(),
                _ => size.made::<Rgba<u16>>(values)?.into(),
            },
            alpha: Vec::new(),
        })
    }

    /// Linear numbers, as EXR and HDR files have them: light, reflectance, heights. Alpha counts for textures alone
    /// that ask for it.
    ///
    /// # Errors
    /// When they are no picture of this size.
    pub fn linear(width: u32, height: u32, channels: u32, values: Vec<f32>) -> Result<Self, PixelsError> {
        let size = checked(width, height, channels, values.len())?;
        let alpha = match channels {
            2 => values.as_chunks::<2>().0.iter().map(|[_, alpha]| *alpha).collect(),
            4 => values.as_chunks::<4>().0.iter().map(|[.., alpha]| *alpha).collect(),
            _ => Vec::new(),
        };
        let colors: Vec<f32> = match channels {
            1 => values.iter().flat_map(|grey| [*grey; 3]).collect(),
            2 => values.as_chunks::<2>().0.iter().flat_map(|[grey, _]| [*grey; 3]).collect(),
            3 => values,
            _ => values.as_chunks::<4>().0.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect(),
        };
        let size = Size { channels: 3, ..size };
        Ok(Pixels { picture: size.made::<Rgb<f32>>(colors)?.into(), alpha })
    }

    /// As a texture.
    pub(crate) fn texture(&self, name: &Path, reading: Reading) -> Result<Texture, TextureError> {
        let DynamicImage::ImageRgb32F(picture) = &self.picture else {
            return Ok(from_picture(self.picture.clone(), name, reading));
        };
        let colors = picture.as_raw().as_chunks::<3>().0;
        let texel = |(k, color): (usize, &[f32; 3])| reading.texel(*color, self.alpha.get(k).copied().unwrap_or(1.0));
        let texels: Vec<[f32; 3]> = colors.par_iter().enumerate().map(texel).collect();
        let wrong = texels.par_iter().filter(|texel| !texel.iter().all(|x| (0.0..=1.0).contains(x))).count();
        if wrong > 0 {
            return Err(TextureError::Range { path: name.to_owned(), wrong });
        }
        let (width, height) = picture.dimensions();
        let lacks = reading.channel == Channel::Alpha && self.alpha.is_empty();
        let warnings: Diagnostics = lacks.then(|| no_alpha(name)).into_iter().collect();
        Ok(Texture { width, height, texels: Texels::Linear(texels), warnings })
    }

    /// As a picture of all directions.
    pub(crate) fn panorama(&self, name: &Path) -> Panorama {
        panorama(self.picture.clone(), name)
    }

    /// As heights.
    pub(crate) fn landscape(&self, name: &Path) -> Result<Landscape, TextureError> {
        let bytes = self.picture.as_bytes().len() as u64;
        landscape(self.picture.clone(), name, bytes)
    }
}

/// What a picture is to be, checked.
#[derive(Clone, Copy)]
struct Size {
    width: u32,
    height: u32,
    channels: u32,
}

fn checked(width: u32, height: u32, channels: u32, numbers: usize) -> Result<Size, PixelsError> {
    if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
        return Err(PixelsError::Size { width, height });
    }
    if !(1..=4).contains(&channels) {
        return Err(PixelsError::Channels(channels));
    }
    let wanted = u64::from(width) * u64::from(height) * u64::from(channels);
    if numbers as u64 != wanted {
        return Err(PixelsError::Numbers { width, height, channels, numbers });
    }
    Ok(Size { width, height, channels })
}

impl Size {
    fn made<P: image::Pixel>(self, values: Vec<P::Subpixel>) -> Result<ImageBuffer<P, Vec<P::Subpixel>>, PixelsError> {
        let Size { width, height, channels } = self;
        let numbers = values.len();
        let fault = PixelsError::Numbers { width, height, channels, numbers };
        ImageBuffer::from_raw(width, height, values).ok_or(fault)
    }
}

#[cfg(test)]
mod tests {
    use super::super::ColorSpace;
    use super::*;

    #[test]
    fn pictures_of_memory_are_those_of_files() {
        let bytes: Vec<u8> = (0..24).map(|k| k * 10).collect();
        for channels in 1..=4 {
            let width = 24 / channels / 2;
            let pixels = Pixels::srgb8(width, 2, channels, bytes.clone()).expect("a picture");
            let mut file = std::io::Cursor::new(Vec::new());
            pixels.picture.write_to(&mut file, image::ImageFormat::Png).expect("a file");
            let file = file.into_inner();
            let name = Path::new("a");
            let (made, read) =
                (pixels.texture(name, Reading::default()).expect("a texture"), super::super::decode(&file, name));
            assert_eq!(made, read.expect("a texture"));
            assert_eq!(made.warnings.len(), usize::from(channels % 2 == 0), "{channels}");
            if width > 1 {
                let read = super::super::decode_heights(&file, name).expect("heights");
                assert_eq!(pixels.landscape(name).expect("heights"), read);
            }
        }
    }

    #[test]
    fn floats_are_linear_unless_something_is_said_and_keep_their_alpha() {
        let light = Pixels::linear(1, 1, 4, vec![0.5, 0.25, 0.0, 0.75]).expect("a picture");
        let read = |space, channel| {
            let texture = light.texture(Path::new("a"), Reading { space, channel }).expect("a texture");
            assert!(texture.warnings.is_empty());
            texture.texels
        };
        let of = |texel| Texels::Linear(vec![texel]);
        assert_eq!(read(ColorSpace::Auto, Channel::Color), of([0.5, 0.25, 0.0]));
        assert_eq!(read(ColorSpace::Linear, Channel::Green), of([0.25; 3]));
        assert_eq!(read(ColorSpace::Srgb, Channel::Alpha), of([0.75; 3]));
        // ((0.5 + 0.055) / 1.055)^2.4
        let Texels::Linear(decoded) = read(ColorSpace::Srgb, Channel::Red) else { panic!("floats expected") };
        assert!((decoded[0][0] - 0.214_041_14).abs() < 1e-7, "{decoded:?}");
        let opaque = Pixels::linear(1, 1, 3, vec![0.5; 3]).expect("a picture");
        let alpha = Reading { space: ColorSpace::Auto, channel: Channel::Alpha };
        assert_eq!(opaque.texture(Path::new("a"), alpha).expect("a texture").warnings.len(), 1);
    }

    #[test]
    fn numbers_stay_numbers() {
        let name = Path::new("a");
        let grey = Pixels::linear(2, 2, 1, vec![0.0, 0.25, 0.5, 1.0]).expect("a picture");
        let texture = grey.texture(name, Reading::default()).expect("a texture");
        assert_eq!(texture.texels, Texels::Linear([0.0, 0.25, 0.5, 1.0].map(|x| [x; 3]).to_vec()));
        assert_eq!(grey.landscape(name).expect("heights").heights.values, [0.0, 0.25, 0.5, 1.0]);
        let light = Pixels::linear(2, 1, 4, vec![1.0, 20.0, 300.0, 0.0, 1.0, 2.0, 3.0, 1.0]).expect("a picture");
        assert_eq!(light.panorama(name).texels, [[1.0, 20.0, 300.0], [1.0, 2.0, 3.0]]);
        let fault = light.texture(name, Reading::default()).expect_err("no colours").to_diagnostic(Default::default());
        assert!(fault.message.starts_with("2 pixels of the picture a "), "{}", fault.message);
    }
}
