//! PNG: display values with an sRGB chunk, alpha beside them where the picture has it (not multiplied), and what the
//! picture was made from as text (iTXt, UTF-8).

use super::{Bits, Encoding, Provenance, WriteError};
use png::text_metadata::ITXtChunk;
use png::{BitDepth, ColorType, DeflateCompression, Encoder, EncodingError, Filter, Info, SrgbRenderingIntent};
use rayon::prelude::*;
use tracer_core::Image;

pub(super) fn encode(image: &Image, bits: Bits, provenance: &Provenance) -> Result<Vec<u8>, WriteError> {
    let with_alpha;
    let values = match &image.alpha {
        None => &image.display,
        Some(alpha) => {
            let pixels = image.display.as_chunks::<3>().0.iter().zip(alpha);
            with_alpha = pixels.flat_map(|(&[r, g, b], &alpha)| [r, g, b, alpha]).collect::<Vec<f32>>();
            &with_alpha
        }
    };
    let pixels: Vec<u8> = match bits {
        Bits::Eight => values.par_iter().map(|&x| code_value(x, 255.0) as u8).collect(),
        // PNG is big-endian.
        Bits::Sixteen => {
            values.par_iter().map(|&x| code_value(x, 65535.0).to_be_bytes()).collect::<Vec<_>>().into_flattened()
        }
    };
    encode_pixels(image, bits, provenance, &pixels)
        .map_err(|error| WriteError::Encode { encoding: Encoding::Png(bits).name(), message: error.to_string() })
}

fn encode_pixels(image: &Image, bits: Bits, provenance: &Provenance, pixels: &[u8]) -> Result<Vec<u8>, EncodingError> {
    let mut info = Info::with_size(image.width, image.height);
    info.color_type = if image.alpha.is_some() { ColorType::Rgba } else { ColorType::Rgb };
    info.bit_depth = match bits {
        Bits::Eight => BitDepth::Eight,
        Bits::Sixteen => BitDepth::Sixteen,
    };
    info.srgb = Some(SrgbRenderingIntent::RelativeColorimetric);
    info.utf8_text = text(provenance)?;
    let mut bytes = Vec::new();
    let mut encoder = Encoder::with_info(&mut bytes, info)?;
    // A twentieth of the time of zlib's level 6, for files that are a few hundredths larger, and an eighth where all is
    // noise (docs/performance.md).
    encoder.set_deflate_compression(DeflateCompression::FdeflateUltraFast);
    encoder.set_filter(Filter::Adaptive);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels)?;
    writer.finish()?;
    Ok(bytes)
}

/// The nearest of the code values 0..=max to x in 0..=1.
fn code_value(x: f32, max: f64) -> u16 {
    // Rounds towards zero.
    (f64::from(x).clamp(0.0, 1.0) * max + 0.5) as u16
}

/// Keywords are PNG's own where it has one.
fn text(provenance: &Provenance) -> Result<Vec<ITXtChunk>, EncodingError> {
    if provenance.is_hidden {
        return Ok(Vec::new());
    }
    let mut chunks = vec![ITXtChunk::new("Software", Provenance::SOFTWARE)];
    if !provenance.scene_name.is_empty() {
        chunks.push(ITXtChunk::new("Source", provenance.scene_name.as_str()));
    }
    if !provenance.settings.is_empty() {
        chunks.push(ITXtChunk::new("Comment", provenance.settings_line()));
    }
    // NUL would end the chunk's text in some readers; no scene that loads holds one outside of comments.
    let scene = provenance.embedded_scene().map(|scene| ("Scene", scene.replace('\0', "\u{fffd}")));
    let record = provenance.embedded_record().map(|record| (Provenance::RECORD, record.to_owned()));
    for (keyword, text) in scene.into_iter().chain(record) {
        let mut chunk = ITXtChunk::new(keyword, text);
        chunk.compressed = true;
        chunk.compress_text()?;
        chunks.push(chunk);
    }
    Ok(chunks)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_values_are_the_nearest() {
        for code in 0..=255 {
            let exact = f32::from(code) / 255.0;
            assert_eq!(code_value(exact, 255.0), code);
            assert_eq!(code_value(exact + 0.49 / 255.0, 255.0), code);
            assert_eq!(code_value(exact - 0.49 / 255.0, 255.0), code);
        }
        assert_eq!(code_value(1.0, 65535.0), 65535);
        assert_eq!(code_value(f32::INFINITY, 255.0), 255);
    }
}
