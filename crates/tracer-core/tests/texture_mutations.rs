//! Damaged pictures: with random mutations they never panic, never take long, and give either an error or as many
//! texels as they say.
//!
//! `TRACER_MUTANTS=100000` sets the number of mutants.

#[path = "../../mesh/tests/support/mutate.rs"]
mod mutate;

use image::ImageEncoder;
use mutate::{mutants, run};
use std::path::Path;
use tracer_core::texture::{Texels, decode};

#[test]
fn mutated_pictures() {
    let pixels: Vec<u8> = (0..16 * 12 * 3).map(|i| (i * 37 % 256) as u8).collect();
    let (mut png, mut jpeg) = (Vec::new(), Vec::new());
    let rgb = image::ExtendedColorType::Rgb8;
    image::codecs::png::PngEncoder::new(&mut png).write_image(&pixels, 16, 12, rgb).expect("encoded");
    image::codecs::jpeg::JpegEncoder::new(&mut jpeg).write_image(&pixels, 16, 12, rgb).expect("encoded");
    let floats: Vec<u8> = pixels.iter().flat_map(|byte| (f32::from(*byte) / 200.0).to_ne_bytes()).collect();
    let of_floats = |format| {
        let mut file = std::io::Cursor::new(Vec::new());
        let rgb = image::ExtendedColorType::Rgb32F;
        image::write_buffer_with_format(&mut file, &floats, 16, 12, rgb, format).expect("encoded");
        file.into_inner()
    };
    let (hdr, exr) = (of_floats(image::ImageFormat::Hdr), of_floats(image::ImageFormat::OpenExr));
    let grey = {
        use exr::prelude::{
            AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage,
        };
        let samples = FlatSamples::F32(pixels.iter().take(16 * 12).map(|byte| f32::from(*byte) / 200.0).collect());
        let channels = AnyChannels::sort(std::iter::once(AnyChannel::new("Y", samples)).collect());
        let layer = Layer::new((16, 12), LayerAttributes::default(), Encoding::default(), channels);
        let mut file = std::io::Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut file).expect("encoded");
        file.into_inner()
    };
    // Checksums make nearly every change of a PNG an error; a JPEG often decodes to something.
    for (seed, original, least) in [(6, png, 0), (7, jpeg, 50), (8, hdr, 50), (9, exr, 50), (10, grey, 50)] {
        let count = mutants() / 5;
        let good = run(seed, count, &original, |bytes| match decode(bytes, Path::new("p")) {
            Ok(texture) => {
                let texels = match &texture.texels {
                    Texels::Srgb8(texels) => texels.len(),
                    Texels::Linear(texels) => texels.len(),
                };
                assert_eq!(texels, texture.width as usize * texture.height as usize);
                true
            }
            Err(_) => false,
        });
        assert!(good >= least && good < count, "{good} of {count}");
    }
}
