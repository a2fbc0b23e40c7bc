//! OpenEXR: one layer of R, G, B in 32-bit floats, ZIP, with attributes that say what the picture was made from.

use super::{Encoding, Provenance, WriteError};
use exr::image::Blocks;
use exr::image::Encoding as ExrEncoding;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Compression, FlatSamples, Image as ExrImage, Layer, LayerAttributes,
    LineOrder, SmallVec, Text, Vec2, WritableImage,
};
use std::io::Cursor;
use tracer_core::Image;

pub(super) fn encode(image: &Image, provenance: &Provenance) -> Result<Vec<u8>, WriteError> {
    let channel = |name: &str, c: usize| {
        AnyChannel::new(name, FlatSamples::F32(image.linear.iter().skip(c).step_by(3).copied().collect()))
    };
    // The format wants channels in alphabetical order; `sort` makes it so.
    let channels = AnyChannels::sort(SmallVec::from_vec(vec![channel("R", 0), channel("G", 1), channel("B", 2)]));
    let mut attributes = LayerAttributes::default();
    attributes.software_name = Some(text(Provenance::SOFTWARE));
    let comments = [provenance.scene_name.as_str(), &provenance.settings_line()].join(": ");
    attributes.comments = Some(text(&comments));
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
    Ok(bytes.into_inner())
}

/// The bytes of the text as they are; the format does not say which encoding, and readers take UTF-8.
fn text(text: &str) -> Text {
    Text::from_bytes_unchecked(SmallVec::from_slice(text.as_bytes()))
}
