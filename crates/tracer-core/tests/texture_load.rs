//! Pictures: every kind of PNG, JPEG, HDR and EXR comes out as the right texels, and wrong files as clear errors.

use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType as Color, ImageEncoder, ImageFormat};
use scene_format::diagnostic::Span;
use std::path::Path;
use tracer_core::texture::{Channel, ColorSpace, Reading, SRGB_TO_LINEAR, Texels, Texture, decode, decode_as, load};

fn png(pixels: &[u8], width: u32, height: u32, color: Color) -> Vec<u8> {
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes).write_image(pixels, width, height, color).expect("encoded");
    bytes
}

fn picture(bytes: &[u8]) -> Texture {
    decode(bytes, Path::new("p.png")).unwrap_or_else(|error| panic!("{error}"))
}

fn srgb8(bytes: &[u8]) -> Vec<u32> {
    match picture(bytes).texels {
        Texels::Srgb8(texels) => texels,
        other => panic!("{other:?}"),
    }
}

fn linear(bytes: &[u8]) -> Vec<[f32; 3]> {
    match picture(bytes).texels {
        Texels::Linear(texels) => texels,
        other => panic!("{other:?}"),
    }
}

/// The error's code, message, expectation and hint.
fn error(bytes: &[u8]) -> [String; 4] {
    let error = decode(bytes, Path::new("p.png")).expect_err("an error").to_diagnostic(Span::NONE);
    [error.code.to_string(), error.message, error.expected, error.hint]
}

#[test]
fn eight_bit_pictures_keep_their_code_values_row_by_row_from_the_top() {
    let pixels = [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 250, 251, 252];
    let texture = picture(&png(&pixels, 3, 2, Color::Rgb8));
    assert_eq!((texture.width, texture.height), (3, 2));
    assert_eq!(texture.texels, Texels::Srgb8(vec![0x030201, 0x060504, 0x090807, 0x0c0b0a, 0x0f0e0d, 0xfcfbfa]));
    assert!(texture.warnings.is_empty());
    assert_eq!(srgb8(&png(&[7, 200], 2, 1, Color::L8)), [0x070707, 0xc8c8c8]);
}

/// A 2 x 1 palette picture of one bit, with a transparent second entry when asked for; written chunk by chunk, since
/// the encoder makes none.
fn palette(transparency: &[u8]) -> Vec<u8> {
    fn crc(bytes: impl Iterator<Item = u8>) -> u32 {
        !bytes.fold(u32::MAX, |crc, byte| {
            (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 * (crc & 1)))
        })
    }
    let mut bytes = b"\x89PNG\r\n\x1a\n".to_vec();
    let mut chunk = |name: &[u8; 4], data: &[u8]| {
        bytes.extend((data.len() as u32).to_be_bytes());
        bytes.extend(name);
        bytes.extend(data);
        bytes.extend(crc(name.iter().chain(data).copied()).to_be_bytes());
    };
    chunk(b"IHDR", &[0, 0, 0, 2, 0, 0, 0, 1, 1, 3, 0, 0, 0]);
    chunk(b"PLTE", &[10, 20, 30, 40, 50, 60]);
    if !transparency.is_empty() {
        chunk(b"tRNS", transparency);
    }
    // zlib, one stored block: filter 0, then pixels 1 and 0; Adler-32 of both bytes.
    chunk(b"IDAT", &[0x78, 1, 1, 2, 0, 0xfd, 0xff, 0, 0x80, 0, 0x82, 0, 0x81]);
    chunk(b"IEND", &[]);
    bytes
}

#[test]
fn palettes_are_looked_up() {
    assert_eq!(srgb8(&palette(&[])), [0x3c3228, 0x1e140a]);
    let transparent = picture(&palette(&[255, 0]));
    assert_eq!(transparent.texels, Texels::Srgb8(vec![0x3c3228, 0x1e140a]));
    assert_eq!(transparent.warnings.len(), 1);
}

#[test]
fn sixteen_bit_pictures_are_decoded_to_linear_light() {
    let pixels: Vec<u8> = [0_u16, 65535, 257 * 10, 257 * 188, 1, 30000].iter().flat_map(|v| v.to_ne_bytes()).collect();
    let texels = linear(&png(&pixels, 2, 1, Color::Rgb16));
    assert_eq!(texels[0], [0.0, 1.0, SRGB_TO_LINEAR[10]]);
    assert_eq!(texels[1][0], SRGB_TO_LINEAR[188]);
    assert_eq!(texels[1][1], (1.0 / 65535.0 / 12.92) as f32);
    // ((30000 / 65535 + 0.055) / 1.055)^2.4
    assert!((texels[1][2] - 0.177_014_83).abs() < 1e-6, "{}", texels[1][2]);
    let grey: Vec<u8> = 65535_u16.to_ne_bytes().to_vec();
    assert_eq!(linear(&png(&grey, 1, 1, Color::L16)), [[1.0; 3]]);
}

#[test]
fn alpha_is_ignored_with_a_warning_unless_it_is_opaque() {
    let clear = picture(&png(&[10, 20, 30, 0, 40, 50, 60, 255], 2, 1, Color::Rgba8));
    assert_eq!(clear.texels, Texels::Srgb8(vec![0x1e140a, 0x3c3228]));
    let warnings: Vec<_> = clear.warnings.iter().map(|w| (w.code.as_str(), w.message.as_str())).collect();
    assert_eq!(warnings, [("W0520", "the picture has an alpha channel, which is ignored")]);
    let opaque = picture(&png(&[10, 20, 30, 255], 1, 1, Color::Rgba8));
    assert!(opaque.warnings.is_empty());
    assert_eq!(srgb8(&png(&[9, 128], 1, 1, Color::La8)), [0x090909]);
    let deep: Vec<u8> = [65535_u16, 0, 0, 9].iter().flat_map(|v| v.to_ne_bytes()).collect();
    let deep = picture(&png(&deep, 1, 1, Color::Rgba16));
    assert_eq!((deep.texels, deep.warnings.len()), (Texels::Linear(vec![[1.0, 0.0, 0.0]]), 1));
}

/// Two texels, (10, 20, 30, 40) and (200, 100, 50, 255) in 255 parts, read in every way; deep ones alike.
#[test]
fn a_channel_and_a_colour_space_are_taken_of_the_numbers_as_they_are() {
    let codes = [[10, 20, 30, 40], [200, 100, 50, 255]];
    let bytes = png(codes.as_flattened(), 2, 1, Color::Rgba8);
    let deep: Vec<u8> = codes.as_flattened().iter().flat_map(|&x| (u16::from(x) * 257).to_ne_bytes()).collect();
    let deep = png(&deep, 2, 1, Color::Rgba16);
    let light = |code: u8, space| match space {
        ColorSpace::Linear => f64::from(code) / 255.0,
        _ => f64::from(SRGB_TO_LINEAR[usize::from(code)]),
    };
    for space in [ColorSpace::Auto, ColorSpace::Srgb, ColorSpace::Linear] {
        for channel in [Channel::Color, Channel::Red, Channel::Green, Channel::Blue, Channel::Alpha, Channel::Luminance]
        {
            for file in [&bytes, &deep] {
                let texture = decode_as(file, Path::new("p.png"), Reading { space, channel }).expect("a picture");
                for (k, code) in codes.iter().enumerate() {
                    let [r, g, b] = [0, 1, 2].map(|c| light(code[c], space));
                    let expected = match channel {
                        Channel::Color => [r, g, b],
                        Channel::Red => [r; 3],
                        Channel::Green => [g; 3],
                        Channel::Blue => [b; 3],
                        Channel::Alpha => [f64::from(code[3]) / 255.0; 3],
                        Channel::Luminance => [0.2126 * r + 0.7152 * g + 0.0722 * b; 3],
                    };
                    let found = match &texture.texels {
                        Texels::Srgb8(words) => [0, 1, 2].map(|c| SRGB_TO_LINEAR[(words[k] >> (8 * c) & 255) as usize]),
                        Texels::Linear(texels) => texels[k],
                    };
                    for (found, expected) in found.into_iter().zip(expected) {
                        assert!(
                            (f64::from(found) - expected).abs() < 1e-7,
                            "{space:?} {channel:?}: {found} {expected}"
                        );
                    }
                }
                let warned = texture.warnings.len();
                assert_eq!(warned, usize::from(channel == Channel::Color), "{space:?} {channel:?}");
            }
        }
    }
    let alpha = Reading { channel: Channel::Alpha, ..Reading::default() };
    let opaque = decode_as(&png(&[1, 2, 3], 1, 1, Color::Rgb8), Path::new("p.png"), alpha).expect("a picture");
    assert_eq!(opaque.texels, Texels::Linear(vec![[1.0; 3]]));
    let message = "the picture has no alpha channel, and its alpha is all that counts: it is 1 everywhere";
    assert_eq!(opaque.warnings.iter().map(|w| &*w.message).collect::<Vec<_>>(), [message]);
}

#[test]
fn jpeg_pictures_are_read_whatever_the_file_is_called() {
    let (width, height) = (24, 16);
    let pixels: Vec<u8> = (0..width * height).flat_map(|i| [if i % width < 12 { 200 } else { 50 }, 100, 150]).collect();
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, 100).write_image(&pixels, width, height, Color::Rgb8).expect("encoded");
    let texture = picture(&bytes);
    assert_eq!((texture.width, texture.height), (24, 16));
    let Texels::Srgb8(texels) = texture.texels else { panic!("8 bits expected") };
    for (texel, pixel) in texels.iter().zip(pixels.chunks_exact(3)) {
        for (channel, &value) in pixel.iter().enumerate() {
            // Flat fields at quality 100: colour conversion, subsampling at the seam's block and rounding remain.
            let found = texel >> (8 * channel) & 0xff;
            assert!(found.abs_diff(u32::from(value)) <= 6, "{found} {value}");
        }
    }
    let mut grey = Vec::new();
    JpegEncoder::new_with_quality(&mut grey, 100).write_image(&[77; 64], 8, 8, Color::L8).expect("encoded");
    assert_eq!(srgb8(&grey), [0x4d4d4d; 64]);
}

/// An orientation that a camera noted: 6 = the top row is the picture's right side.
#[test]
fn jpeg_pictures_are_turned_as_the_camera_noted() {
    let mut encoded = Vec::new();
    let pixels: Vec<u8> = (0..16 * 8).map(|i| if i % 16 < 8 { 10 } else { 240 }).collect();
    JpegEncoder::new_with_quality(&mut encoded, 100).write_image(&pixels, 16, 8, Color::L8).expect("encoded");
    let exif = b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0";
    let mut bytes = encoded[..2].to_vec();
    bytes.extend([0xff, 0xe1]);
    bytes.extend((exif.len() as u16 + 2).to_be_bytes());
    bytes.extend(exif);
    bytes.extend(&encoded[2..]);
    let texture = picture(&bytes);
    assert_eq!((texture.width, texture.height), (8, 16));
    let Texels::Srgb8(texels) = texture.texels else { panic!("8 bits expected") };
    // What was the left half is the upper half now.
    assert!(texels[..64].iter().all(|texel| texel & 0xff < 20) && texels[64..].iter().all(|texel| texel & 0xff > 230));
}

#[test]
fn other_formats_and_broken_files_are_clear_errors() {
    const SAVE_AGAIN: &str = "open it in an image program and save it again";
    const CONVERT: &str = "convert the picture to PNG";
    for (bytes, message) in [
        (&b""[..], "p.png is no PNG, JPEG, HDR or EXR picture"),
        (b"v 0 0 0\n", "p.png is no PNG, JPEG, HDR or EXR picture"),
        (b"GIF89a\x01\0\x01\0", "p.png is no PNG, JPEG, HDR or EXR picture, but looks like `gif`"),
    ] {
        assert_eq!(error(bytes), ["E0520", message, "a PNG, JPEG, HDR or EXR file", CONVERT].map(str::to_owned));
    }
    let good = png(&[1; 300], 10, 10, Color::Rgb8);
    for end in [8, 20, 33, 50, good.len() - 20] {
        let [code, message, expected, hint] = error(&good[..end]);
        assert!(message.starts_with("the picture p.png is broken: "), "{message}");
        assert_eq!([code.as_str(), &expected, &hint], ["E0520", "a whole PNG, JPEG, HDR or EXR file", SAVE_AGAIN]);
    }
}

/// Pixels as HDR or EXR file.
fn floats(pixels: &[f32], width: u32, height: u32, color: Color, format: ImageFormat) -> Vec<u8> {
    let bytes: Vec<u8> = pixels.iter().flat_map(|x| x.to_ne_bytes()).collect();
    let mut file = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut file, &bytes, width, height, color, format).expect("encoded");
    file.into_inner()
}

/// The numbers of EXR as they stand, those of HDR to its eight bits; row 0 on top.
#[test]
fn floats_are_linear() {
    let pixels = [0.5, 0.25, 0.125, 1.0, 0.0, 0.75, 0.1, 0.2, 0.3, 0.9, 0.01, 0.6];
    for format in [ImageFormat::OpenExr, ImageFormat::Hdr] {
        let texture = picture(&floats(&pixels, 2, 2, Color::Rgb32F, format));
        assert_eq!((texture.width, texture.height), (2, 2));
        assert!(texture.warnings.is_empty(), "{:?}", texture.warnings);
        let Texels::Linear(texels) = &texture.texels else { panic!("{:?}", texture.texels) };
        for (texel, expected) in texels.iter().zip(pixels.as_chunks::<3>().0) {
            // HDR has a common exponent, and a mantissa of eight bits for the largest channel.
            let most = expected.iter().copied().fold(0.0, f32::max);
            let off = if format == ImageFormat::Hdr { most / 128.0 } else { 0.0 };
            assert!(texel.iter().zip(expected).all(|(a, b)| (a - b).abs() <= off), "{texel:?} {expected:?}");
        }
    }
}

#[test]
fn floats_are_read_by_channel_and_space() {
    let file = floats(&[0.5, 0.25, 0.125, 0.75, 1.0, 0.0, 0.5, 1.0], 2, 1, Color::Rgba32F, ImageFormat::OpenExr);
    let read = |space, channel| decode_as(&file, Path::new("p.exr"), Reading { space, channel }).expect("a picture");
    let first = |space, channel| match read(space, channel).texels {
        Texels::Linear(texels) => texels[0],
        other => panic!("{other:?}"),
    };
    for space in [ColorSpace::Auto, ColorSpace::Linear] {
        assert_eq!(first(space, Channel::Color), [0.5, 0.25, 0.125]);
        assert_eq!(first(space, Channel::Red), [0.5; 3]);
        assert_eq!(first(space, Channel::Green), [0.25; 3]);
        assert_eq!(first(space, Channel::Blue), [0.125; 3]);
        let luminance = (0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 0.125) as f32;
        assert!((first(space, Channel::Luminance)[1] - luminance).abs() < 1e-7);
    }
    // Alpha is linear whatever is said: ((0.5 + 0.055) / 1.055)^2.4 for red.
    assert_eq!(first(ColorSpace::Srgb, Channel::Alpha), [0.75; 3]);
    assert!((first(ColorSpace::Srgb, Channel::Red)[0] - 0.214_041_14).abs() < 1e-7);
    let codes = |texture: Texture| texture.warnings.iter().map(|w| w.code.as_str().to_owned()).collect::<Vec<_>>();
    assert_eq!(codes(read(ColorSpace::Auto, Channel::Color)), ["W0520"]);
    assert!(codes(read(ColorSpace::Auto, Channel::Alpha)).is_empty());
    let opaque = floats(&[0.5; 3], 1, 1, Color::Rgb32F, ImageFormat::OpenExr);
    let alpha = Reading { space: ColorSpace::Auto, channel: Channel::Alpha };
    let alpha = decode_as(&opaque, Path::new("p.exr"), alpha).expect("a picture");
    assert_eq!((&alpha.texels, codes(alpha.clone())), (&Texels::Linear(vec![[1.0; 3]]), vec!["W0520".to_owned()]));
}

#[test]
fn floats_beyond_a_share_are_clipped_and_told() {
    let pixels =
        [2.0, 0.5, -1.0, f32::INFINITY, f32::NAN, 1.0, 0.0, 1.0, 0.5, f32::NEG_INFINITY, 65504.0, 1.0 + f32::EPSILON];
    let texture = picture(&floats(&pixels, 2, 2, Color::Rgb32F, ImageFormat::OpenExr));
    let clipped = vec![[1.0, 0.5, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.5], [0.0, 1.0, 1.0]];
    assert_eq!(texture.texels, Texels::Linear(clipped));
    let told: Vec<_> = texture.warnings.iter().map(|w| (w.code.as_str(), w.message.as_str())).collect();
    assert_eq!(told, [("W0522", "3 texels of the picture are beyond 0 to 1, or no numbers")]);
}

/// Headers that promise more than the file holds, files that are cut off, layers without colours.
#[test]
fn wrong_pictures_of_floats_are_clear_errors() {
    let exr = floats(&[0.5; 300], 10, 10, Color::Rgb32F, ImageFormat::OpenExr);
    let hdr = floats(&[0.5; 300], 10, 10, Color::Rgb32F, ImageFormat::Hdr);
    for (file, ends) in [(&exr, [20, 100, exr.len() - 40]), (&hdr, [12, 40, hdr.len() - 10])] {
        for end in ends {
            let [code, message, expected, _] = error(&file[..end]);
            assert!(message.starts_with("the picture p.png is broken: "), "{message}");
            assert_eq!([code.as_str(), &expected], ["E0520", "a whole PNG, JPEG, HDR or EXR file"], "{message}");
        }
    }
    let huge = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n";
    let [code, message, ..] = error(huge);
    assert_eq!((code.as_str(), &*message), ("E0520", "the picture p.png has 30000 x 30000 pixels in 53 bytes"));
    // Channels of a layer with a name, as programs write passes: no R, G and B by themselves.
    let mut named = exr;
    let at = |file: &[u8], name: &[u8]| file.windows(name.len()).position(|window| window == name);
    for name in [b"\0R\0\x02\0\0\0", b"\0G\0\x02\0\0\0"] {
        if let Some(at) = at(&named, name) {
            named[at + 1] += 1;
        }
    }
    let [code, message, expected, _] = error(&named);
    assert_eq!(code, "E0520");
    assert!(expected.contains("R, G and B"), "{message}: {expected}");
}

/// A file of one channel, as NumPy and OpenEXR write an array of heights, whatever its name: grey, and numbers as they
/// stand. Cut off, it is an error.
#[test]
fn one_channel_of_an_exr_is_grey() {
    use exr::prelude::{
        AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage, f16,
    };
    let numbers = [0.0f32, 0.25, 0.5, 0.75, 1.0, 0.125];
    let written = |name: &str, samples: FlatSamples| {
        let channels = AnyChannels::sort(std::iter::once(AnyChannel::new(name, samples)).collect());
        let layer = Layer::new((3, 2), LayerAttributes::default(), Encoding::default(), channels);
        let mut bytes = std::io::Cursor::new(Vec::new());
        Image::from_layer(layer).write().to_buffered(&mut bytes).expect("a file");
        bytes.into_inner()
    };
    let half = FlatSamples::F16(numbers.map(f16::from_f32).to_vec());
    for file in [written("Y", FlatSamples::F32(numbers.to_vec())), written("depth.Z", half)] {
        let texture = decode(&file, Path::new("p.exr")).expect("a picture");
        let Texels::Linear(texels) = &texture.texels else { panic!("floats") };
        assert_eq!((texture.width, texture.height), (3, 2));
        assert!(texels.iter().zip(numbers).all(|(texel, x)| texel[..3] == [x; 3]), "{texels:?}");
        let heights = tracer_core::texture::decode_heights(&file, Path::new("p.exr")).expect("heights").heights;
        assert_eq!((heights.width, heights.depth, heights.values.as_slice()), (3, 2, &numbers[..]));
        for end in [20, file.len() / 2, file.len() - 3] {
            assert_eq!(error(&file[..end])[0], "E0520", "{end}");
        }
    }
}

/// Decoders fill the rest of a JPEG that is cut off with grey: here it is an error, wherever the cut is.
#[test]
fn truncated_pictures_are_errors() {
    let pixels: Vec<u8> = (0..40 * 30 * 3).map(|i| (i * 97 % 251) as u8).collect();
    let mut jpeg = Vec::new();
    JpegEncoder::new(&mut jpeg).write_image(&pixels, 40, 30, Color::Rgb8).expect("encoded");
    for end in 0..jpeg.len() {
        assert_eq!(error(&jpeg[..end])[0], "E0520", "{end}");
    }
    let [_, message, ..] = error(&jpeg[..jpeg.len() / 2 + 200]);
    assert_eq!(message, "the picture p.png is broken: the file ends before the picture does");
    let png = png(&pixels, 40, 30, Color::Rgb8);
    // The last chunk is 12 bytes long and says only that nothing follows.
    for end in 0..png.len() - 12 {
        assert_eq!(error(&png[..end])[0], "E0520", "{end}");
    }
}

#[test]
fn pictures_out_of_proportion_are_refused_before_they_are_decoded() {
    // A JPEG keeps no checksum of its size: the same file that claims 30000 x 30000.
    let mut jpeg = Vec::new();
    JpegEncoder::new(&mut jpeg).write_image(&[0; 192], 8, 8, Color::Rgb8).expect("encoded");
    let frame = jpeg.windows(2).position(|pair| pair == [0xff, 0xc0]).expect("a frame header");
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x75, 0x30, 0x75, 0x30]);
    let message = format!("the picture p.png is broken: {} bytes are too few for its 30000 x 30000 pixels", jpeg.len());
    assert_eq!(error(&jpeg)[1], message);
    // As a PNG, where the check comes before that of the checksum.
    let mut small = png(&[0; 3], 1, 1, Color::Rgb8);
    small[16..24].copy_from_slice(&[0, 0, 0x75, 0x30, 0, 0, 0x75, 0x30]);
    let message =
        format!("the picture p.png is broken: {} bytes are too few for its 30000 x 30000 pixels", small.len());
    assert_eq!(error(&small)[1], message);
    // Whole, but longer than any side may be.
    let long = png(&vec![0; 32769], 32769, 1, Color::L8);
    let [code, message, expected, hint] = error(&long);
    assert_eq!(message, format!("the picture p.png has 32769 x 1 pixels in {} bytes", long.len()));
    assert_eq!([code.as_str(), &hint], ["E0520", "save the picture smaller"]);
    assert!(expected.starts_with("1 to 32768 pixels along a side"));
    // Whole, packed a thousand times, but of an ordinary size.
    let flat = png(&vec![9; 3000 * 3000], 3000, 3000, Color::L8);
    assert_eq!(srgb8(&flat), vec![0x090909; 3000 * 3000]);
}

#[test]
fn a_file_that_is_not_there_is_named() {
    let folder = tempfile::tempdir().expect("a folder");
    let error = load(&folder.path().join("fur.png")).expect_err("no file").to_diagnostic(Span::NONE);
    assert_eq!(error.code, "E0501");
    assert_eq!(load(folder.path()).expect_err("a folder").to_diagnostic(Span::NONE).code, "E0502");
    let path = folder.path().join("fur.png");
    std::fs::write(&path, png(&[1, 2, 3], 1, 1, Color::Rgb8)).expect("written");
    assert_eq!(load(&path).expect("a picture").texels, Texels::Srgb8(vec![0x030201]));
}
