//! OpenEXR: R, G, B, A where the picture has it, and the channels of the picture's layers (`depth.Z`) and light groups
//! (`light.key.R`) in 32-bit floats,
//! ZIP, in one part as readers of channels by name expect it, with attributes that say what the picture was made from.

use super::{Encoding, Provenance, WriteError};
use exr::image::Blocks;
use exr::image::Encoding as ExrEncoding;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Compression, FlatSamples, Image as ExrImage, Layer, LayerAttributes,
    LineOrder, SmallVec, Text, Vec2, WritableImage,
};
use std::io::Cursor;
use tracer_core::{Image, LayerImage};

pub(super) fn encode(image: &Image, provenance: &Provenance) -> Result<Vec<u8>, WriteError> {
    let channel = |name: &str, c: usize| {
        AnyChannel::new(name, FlatSamples::F32(image.linear.iter().skip(c).step_by(3).copied().collect()))
    };
    let mut channels = vec![channel("R", 0), channel("G", 1), channel("B", 2)];
    channels.extend(image.alpha.iter().map(|alpha| AnyChannel::new("A", FlatSamples::F32(alpha.clone()))));
    channels.extend(image.layers.iter().flat_map(channels_of));
    let named = |(name, values): &(String, Vec<f32>)| AnyChannel::new(text(name), FlatSamples::F32(values.clone()));
    channels.extend(image.mattes.channels.iter().chain(&image.light_groups).map(named));
    // The format wants channels in alphabetical order; `sort` makes it so.
    let channels = AnyChannels::sort(SmallVec::from_vec(channels));
    let comments = [provenance.scene_name.as_str(), &provenance.settings_line()].join(": ");
    let mut attributes = LayerAttributes::default();
    if !provenance.is_hidden {
        (attributes.software_name, attributes.comments) = (Some(text(Provenance::SOFTWARE)), Some(text(&comments)));
    }
    if let Some(scene) = provenance.embedded_scene() {
        // The only one of its map: the order of several would change from run to run, and the bytes with it.
        attributes.other.insert(text("scene"), AttributeValue::Text(text(scene)));
    }
    let encoding =
        ExrEncoding { compression: Compression::ZIP16, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let size = Vec2(image.width as usize, image.height as usize);
    let mut picture = ExrImage::from_layer(Layer::new(size, attributes, encoding, channels));
    picture.attributes.chromaticities = Some(Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.30, 0.60),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.3290),
    });
    let mut bytes = Cursor::new(Vec::new());
    picture
        .write()
        .non_parallel()
        .to_unbuffered(&mut bytes)
        .map_err(|error| WriteError::Encode { encoding: Encoding::Exr.name(), message: error.to_string() })?;
    let bytes = bytes.into_inner();
    let record = provenance.embedded_record();
    let mut added = image.mattes.attributes.clone();
    added.extend(record.map(|record| (Provenance::RECORD.to_owned(), record.to_owned())));
    if added.is_empty() {
        return Ok(bytes);
    }
    with_attributes(&bytes, &added).ok_or_else(|| WriteError::Encode {
        encoding: Encoding::Exr.name(),
        message: "the names of the objects and materials are too long".to_owned(),
    })
}

/// A file of one part with more attributes, texts, in this order: the crate's own map of them has none, and the bytes
/// would change from run to run. `None` where a text is too long for the format.
fn with_attributes(file: &[u8], attributes: &[(String, String)]) -> Option<Vec<u8>> {
    let number = |bytes: &[u8]| Some(u32::from_le_bytes(*bytes.first_chunk()?) as usize);
    let text_end = |from: usize| Some(from + file.get(from..)?.iter().position(|&byte| byte == 0)? + 1);
    // Magic number and version; then name, type, length, value, until a name is empty.
    let mut end = 8;
    while *file.get(end)? != 0 {
        let size = text_end(text_end(end)?)?;
        end = size + 4 + number(file.get(size..)?)?;
    }
    let mut out = file[..end].to_vec();
    for (name, value) in attributes {
        // Longer names need a mark in the file's version.
        const LONGEST_NAME: usize = 31;
        let length = i32::try_from(value.len()).ok().filter(|_| name.len() <= LONGEST_NAME)?;
        out.extend([name.as_bytes(), b"\0string\0", &length.to_le_bytes(), value.as_bytes()].concat());
    }
    let added = (out.len() - end) as u64;
    out.push(0);
    // Where the blocks begin: eight bytes each, the first of which is behind them all.
    let table = end + 1;
    let mut next = table;
    let offset = |at: usize| Some(u64::from_le_bytes(*file.get(at..)?.first_chunk()?));
    let first = usize::try_from(offset(table)?).ok()?;
    while next < first {
        out.extend((offset(next)? + added).to_le_bytes());
        next += 8;
    }
    out.extend(file.get(next..)?);
    Some(out)
}

/// The channels of a layer: `normal.X`, `normal.Y`, `normal.Z`.
fn channels_of(layer: &LayerImage) -> impl Iterator<Item = AnyChannel<FlatSamples>> {
    let count = layer.channels.len();
    layer.channels.iter().enumerate().map(move |(c, channel)| {
        let values = layer.values.iter().skip(c).step_by(count).copied().collect();
        AnyChannel::new(text(&format!("{}.{channel}", layer.name)), FlatSamples::F32(values))
    })
}

/// The bytes of the text as they are; the format does not say which encoding, and readers take UTF-8.
fn text(text: &str) -> Text {
    Text::from_bytes_unchecked(SmallVec::from_slice(text.as_bytes()))
}
