//! Pictures as bytes, and as PNG files.

use glam::DVec3;

/// An 8-bit sRGB picture, rows from the top.
pub struct Picture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Three bytes per pixel.
    pub rgb: Vec<u8>,
}

impl Picture {
    /// A picture from the sRGB-encoded colour at each pixel's centre, `u` to the right and `v` up, 0 to 1.
    pub fn from_fn(width: usize, height: usize, color: impl Fn(f64, f64) -> DVec3) -> Picture {
        let rgb = (0..width * height)
            .map(|i| ((i % width) as f64 + 0.5, (i / width) as f64 + 0.5))
            .flat_map(|(x, y)| color(x / width as f64, 1.0 - y / height as f64).to_array())
            .map(byte)
            .collect();
        Picture { width, height, rgb }
    }

    /// The PNG file of the picture.
    ///
    /// # Errors
    /// When the encoder refuses the picture.
    pub fn png(&self) -> anyhow::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, u32::try_from(self.width)?, u32::try_from(self.height)?);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::High);
        encoder.write_header()?.write_image_data(&self.rgb)?;
        Ok(bytes)
    }
}

/// 0..1 as 0..255.
pub fn byte(value: f64) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
