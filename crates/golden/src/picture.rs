//! Pictures of display values, as people look at them.

use std::io::Cursor;

/// An 8-bit picture, red, green and blue of each pixel, row by row from the top.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rgb8 {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Three numbers a pixel.
    pub rgb: Vec<u8>,
}

/// Where pictures differ.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The difference of each channel, times eight.
    pub picture: Rgb8,
    /// Pixels that differ.
    pub count: usize,
    /// Largest difference of a channel, of 255.
    pub largest: u8,
}

impl Rgb8 {
    /// As the bytes of a PNG file.
    ///
    /// # Errors
    /// When it has no pixels, or not three numbers for each.
    pub fn png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.width, self.height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.write_header()?.write_image_data(&self.rgb)?;
        Ok(bytes)
    }

    /// Of the bytes of a PNG file; grey and 16-bit ones become this kind, transparency is left out.
    ///
    /// # Errors
    /// When it is none, or a broken one.
    pub fn from_png(bytes: &[u8]) -> Result<Self, png::DecodingError> {
        let mut decoder = png::Decoder::new(Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info()?;
        let size = reader.output_buffer_size().ok_or(png::DecodingError::LimitsExceeded)?;
        let mut pixels = vec![0; size];
        let info = reader.next_frame(&mut pixels)?;
        pixels.truncate(info.buffer_size());
        let rgb = match info.color_type {
            png::ColorType::Grayscale => pixels.iter().flat_map(|&grey| [grey; 3]).collect(),
            png::ColorType::GrayscaleAlpha => pixels.chunks_exact(2).flat_map(|pixel| [pixel[0]; 3]).collect(),
            png::ColorType::Rgba => pixels.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect(),
            _ => pixels,
        };
        Ok(Rgb8 { width: info.width, height: info.height, rgb })
    }

    /// Whether both have one size.
    pub fn has_size_of(&self, other: &Rgb8) -> bool {
        (self.width, self.height) == (other.width, other.height)
    }

    /// How it differs from another of its size.
    pub fn difference(&self, other: &Rgb8) -> Difference {
        let rgb: Vec<u8> = self.rgb.iter().zip(&other.rgb).map(|(a, b)| a.abs_diff(*b)).collect();
        Difference {
            count: rgb.chunks(3).filter(|pixel| pixel.iter().any(|&d| d > 0)).count(),
            largest: rgb.iter().copied().max().unwrap_or(0),
            picture: Rgb8 {
                width: self.width,
                height: self.height,
                rgb: rgb.iter().map(|d| d.saturating_mul(8)).collect(),
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_and_back() {
        let picture = Rgb8 { width: 3, height: 2, rgb: (0..18).map(|k| k * 13).collect() };
        let png = picture.png().expect("a picture");
        assert_eq!(Rgb8::from_png(&png).expect("a picture"), picture);
        assert!(Rgb8::from_png(&png[..40]).is_err() && Rgb8::from_png(b"no picture").is_err());
        let other = Rgb8 { rgb: (0..18).map(|k| k * 13 + u8::from(k == 4) * 40).collect(), ..picture };
        let difference = picture_difference(&other);
        assert_eq!((difference.count, difference.largest, difference.picture.rgb[4]), (1, 40, 255));
    }

    fn picture_difference(other: &Rgb8) -> Difference {
        Rgb8 { width: 3, height: 2, rgb: (0..18).map(|k| k * 13).collect() }.difference(other)
    }
}
