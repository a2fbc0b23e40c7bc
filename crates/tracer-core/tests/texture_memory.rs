//! Memory stays in proportion to a picture's file, whatever it promises.
//!
//! One test alone in its process, because the count is that of the whole process.

#[path = "../../mesh/tests/support/peak.rs"]
mod peak;

use peak::peak_of;
use std::path::Path;
use tracer_core::texture;

#[test]
fn memory_is_in_proportion_to_the_file() {
    // A JPEG of a few hundred bytes that claims more pixels than it has.
    let mut jpeg = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new(&mut jpeg);
    image::ImageEncoder::write_image(encoder, &[0; 192], 8, 8, image::ExtendedColorType::Rgb8).expect("encoded");
    let frame = jpeg.windows(2).position(|pair| pair == [0xff, 0xc0]).expect("a frame header");
    for side in [100_u16, 4000, 30000] {
        jpeg[frame + 5..frame + 7].copy_from_slice(&side.to_be_bytes());
        jpeg[frame + 7..frame + 9].copy_from_slice(&side.to_be_bytes());
        let peak = peak_of(|| assert!(texture::decode(&jpeg, Path::new("p.jpg")).is_err()));
        assert!(peak <= 9 * jpeg.len() + (1 << 20), "{peak} bytes for {side} x {side}");
    }
    // Radiance files that promise as much.
    for side in [5000, 30000] {
        let hdr = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {side} +X {side}\n");
        let peak = peak_of(|| assert!(texture::decode(hdr.as_bytes(), Path::new("p.hdr")).is_err()));
        assert!(peak <= 9 * hdr.len() + (1 << 20), "{peak} bytes for {side} x {side}");
    }
}
