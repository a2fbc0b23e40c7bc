//! An expected picture with its noise, as an OpenEXR file of two parts.
//!
//! The part `picture` has R, G, B and `variance.Y` of each pixel, as `tracer render --layers variance` writes them, for
//! any program that reads EXR. The part `batches` has a pixel for each cell of 8x8 pixels, and R, G, B of each batch of
//! samples: `00.R` to `63.B`.

use crate::measured::{Measured, batch_count, cells};
use exr::image::{Blocks, Encoding};
use exr::meta::MetaData;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Compression, FlatSamples, Image, ImageAttributes, IntegerBounds, Layer,
    LayerAttributes, LineOrder, ReadChannels, ReadLayers, SmallVec, Text, Vec2, WritableImage, read,
};
use serde::{Deserialize, Serialize};
use std::io::Cursor;

const PICTURE: &str = "picture";
const BATCHES: &str = "batches";
/// The attribute that says what the numbers are of.
const ATTRIBUTE: &str = "golden";
/// Of this form of file.
const VERSION: u32 = 1;
/// Deflate makes at most about so many bytes of one: a header that promises more is not believed.
const MOST_INFLATED: u64 = 1100;
/// Samples of a pixel at most; the scene language has the same limit.
const MOST_SAMPLES: u32 = 1_000_000_000;

#[derive(Serialize, Deserialize)]
struct Head {
    version: u32,
    samples: u32,
    brightest: f32,
    look: String,
}

/// The bytes of the file.
///
/// # Errors
/// What the encoder says.
pub fn encode(measured: &Measured) -> Result<Vec<u8>, String> {
    let head = Head {
        version: VERSION,
        samples: measured.samples,
        brightest: measured.brightest,
        look: measured.look.clone(),
    };
    let head = serde_json::to_string(&head).map_err(|error| error.to_string())?;
    let channel = |name: &str, values: Vec<f32>| AnyChannel::new(name, FlatSamples::F32(values));
    let every = |numbers: &[f32], c: usize| numbers.iter().skip(c).step_by(3).copied().collect::<Vec<f32>>();
    let mut of_picture: Vec<_> =
        ["R", "G", "B"].iter().enumerate().map(|(c, name)| channel(name, every(&measured.rgb, c))).collect();
    of_picture.push(channel("variance.Y", measured.variance.clone()));
    let [columns, rows] = cells(measured.width, measured.height);
    let of_batches = measured.batches.chunks(3 * columns * rows).enumerate().flat_map(|(k, batch)| {
        ["R", "G", "B"]
            .into_iter()
            .enumerate()
            .map(move |(c, name)| channel(&format!("{k:02}.{name}"), every(batch, c)))
    });
    let layer = |name: &str, size: Vec2<usize>, channels: Vec<AnyChannel<FlatSamples>>| {
        let mut attributes = LayerAttributes::named(name);
        if name == PICTURE {
            // The only one of its map: the order of several would change from run to run, and the bytes with it.
            attributes.other.insert(text(ATTRIBUTE), AttributeValue::Text(text(&head)));
        }
        let encoding =
            Encoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
        Layer::new(size, attributes, encoding, AnyChannels::sort(SmallVec::from_vec(channels)))
    };
    let size = Vec2(measured.width as usize, measured.height as usize);
    let layers = [layer(PICTURE, size, of_picture), layer(BATCHES, Vec2(columns, rows), of_batches.collect())];
    let attributes = ImageAttributes::new(IntegerBounds::from_dimensions(size));
    let mut bytes = Cursor::new(Vec::new());
    let image = Image::from_layers(attributes, SmallVec::<[_; 2]>::from(layers));
    image.write().non_parallel().to_unbuffered(&mut bytes).map_err(|error| error.to_string())?;
    Ok(bytes.into_inner())
}

/// What is in the file.
///
/// # Errors
/// What is wrong with it: it is no such file, or a broken one.
pub fn decode(bytes: &[u8]) -> Result<Measured, String> {
    let other = || "it is no EXR file of `tracer golden accept`; accept the picture anew".to_owned();
    let heads = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|error| error.to_string())?.headers;
    let promised = |size: Vec2<usize>, channels: usize| size.0 as u64 * size.1 as u64 * channels as u64 * 4;
    let all: u64 = heads.iter().map(|head| promised(head.layer_size, head.channels.list.len())).sum();
    if all > MOST_INFLATED * bytes.len() as u64 {
        return Err("it promises more pixels than it can hold".to_owned());
    }
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| error.to_string())?;
    let part = |name: &str| {
        let named = |layer: &&Layer<AnyChannels<FlatSamples>>| layer.attributes.layer_name == Some(text(name));
        image.layer_data.iter().find(named).ok_or_else(other)
    };
    let (picture, batches) = (part(PICTURE)?, part(BATCHES)?);
    let head: Head = match picture.attributes.other.get(&text(ATTRIBUTE)) {
        Some(AttributeValue::Text(head)) => serde_json::from_str(&head.to_string()).map_err(|_| other())?,
        _ => return Err(other()),
    };
    if head.version != VERSION {
        return Err(format!(
            "it is of form {}, and this program reads {VERSION}; accept the picture anew",
            head.version
        ));
    }
    if !(1..=MOST_SAMPLES).contains(&head.samples) {
        return Err(other());
    }
    let [width, height] = [picture.size.0, picture.size.1].map(|side| side as u32);
    let [columns, rows] = cells(width, height);
    if batches.size != Vec2(columns, rows) {
        return Err(other());
    }
    let mut measured = Measured {
        width,
        height,
        samples: head.samples,
        brightest: head.brightest,
        look: head.look,
        rgb: interleaved(picture, &["R", "G", "B"]).ok_or_else(other)?,
        variance: numbers(picture, "variance.Y").ok_or_else(other)?.to_vec(),
        batches: Vec::new(),
    };
    for k in 0..batch_count(head.samples) {
        let names = ["R", "G", "B"].map(|name| format!("{k:02}.{name}"));
        let names = names.each_ref().map(String::as_str);
        measured.batches.extend(interleaved(batches, &names).ok_or_else(other)?);
    }
    let brightest = [measured.brightest];
    let mut all = brightest.iter().chain(&measured.rgb).chain(&measured.variance).chain(&measured.batches);
    if !all.all(|x| x.is_finite()) {
        return Err("a number in it is not finite".to_owned());
    }
    Ok(measured)
}

fn numbers<'a>(layer: &'a Layer<AnyChannels<FlatSamples>>, name: &str) -> Option<&'a [f32]> {
    let channel = layer.channel_data.list.iter().find(|channel| channel.name == text(name))?;
    match &channel.sample_data {
        FlatSamples::F32(numbers) => Some(numbers),
        _ => None,
    }
}

fn interleaved(layer: &Layer<AnyChannels<FlatSamples>>, names: &[&str; 3]) -> Option<Vec<f32>> {
    let [r, g, b] = names.map(|name| numbers(layer, name));
    Some(r?.iter().zip(g?).zip(b?).flat_map(|((&r, &g), &b)| [r, g, b]).collect())
}

/// The bytes of the text as they are; the format does not say which encoding, and readers take UTF-8.
fn text(text: &str) -> Text {
    Text::from_bytes_unchecked(SmallVec::from_slice(text.as_bytes()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(width: u32, height: u32, samples: u32) -> Measured {
        let [columns, rows] = cells(width, height);
        let numbers = |count: usize| (0..count).map(|k| k as f32 * 0.37 - 1.0).collect::<Vec<f32>>();
        let pixels = (width * height) as usize;
        Measured {
            width,
            height,
            samples,
            brightest: 20.5,
            look: "exposure 0, tone map filmic".to_owned(),
            rgb: numbers(3 * pixels),
            variance: numbers(pixels),
            batches: numbers(3 * columns * rows * batch_count(samples) as usize),
        }
    }

    #[test]
    fn there_and_back() {
        for (width, height, samples) in [(1, 1, 1), (48, 32, 32), (11, 9, 640)] {
            let measured = measured(width, height, samples);
            let bytes = encode(&measured).expect("a file");
            assert_eq!(decode(&bytes).expect("what was written"), measured);
            assert_eq!(encode(&measured).expect("a file"), bytes, "the bytes are the same every time");
        }
    }

    /// No damage makes it panic; what is read nevertheless is of the size that it says.
    #[test]
    fn damage_is_an_error() {
        let bytes = encode(&measured(11, 9, 4)).expect("a file");
        assert!(decode(b"").is_err() && decode(&bytes[..bytes.len() / 2]).is_err());
        let mut state = 1u64;
        for _ in 0..2000 {
            let mut broken = bytes.clone();
            for _ in 0..3 {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                let at = (state >> 33) as usize % broken.len();
                broken[at] = (state >> 24) as u8;
            }
            if let Ok(read) = decode(&broken) {
                assert_eq!(read.rgb.len(), 3 * (read.width * read.height) as usize);
            }
        }
    }
}
