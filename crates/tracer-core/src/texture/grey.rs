//! EXR files of one channel: heights, depths, masks, as NumPy and OpenEXR write an array. The decoder of pictures wants
//! R, G and B.

use exr::meta::MetaData;
use exr::prelude::{ReadChannels, ReadLayers, read};
use image::error::{DecodingError, ImageFormatHint};
use image::{DynamicImage, ImageError, ImageFormat, Rgb32FImage};
use std::io::Cursor;

/// Columns and rows of the picture, if its file has one part, not deep, of one channel, whatever its name.
pub fn size(bytes: &[u8]) -> Option<[u32; 2]> {
    let headers = MetaData::read_from_buffered(Cursor::new(bytes), false).ok()?.headers;
    let [header] = headers.as_slice() else { return None };
    let is_lone = !header.deep && header.channels.list.len() == 1;
    let [width, height] = [header.layer_size.0, header.layer_size.1].map(|side| u32::try_from(side).ok());
    is_lone.then_some([width?, height?])
}

/// The picture, grey.
///
/// # Errors
/// What the decoder says.
pub fn decode(bytes: &[u8]) -> Result<DynamicImage, ImageError> {
    let broken =
        |text: String| ImageError::Decoding(DecodingError::new(ImageFormatHint::Exact(ImageFormat::OpenExr), text));
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .non_parallel()
        .from_buffered(Cursor::new(bytes))
        .map_err(|error| broken(error.to_string()))?;
    let layer = image.layer_data;
    let channel = layer.channel_data.list.first().ok_or_else(|| broken("it has no channel".to_owned()))?;
    let raw: Vec<f32> = channel.sample_data.values_as_f32().flat_map(|x| [x; 3]).collect();
    let [width, height] = [layer.size.0, layer.size.1].map(|side| side as u32);
    // A channel may have fewer samples than the picture has pixels.
    let picture = Rgb32FImage::from_raw(width, height, raw).filter(|_| channel.sampling == exr::math::Vec2(1, 1));
    picture
        .map(DynamicImage::ImageRgb32F)
        .ok_or_else(|| broken("its channel has not a sample for each pixel".to_owned()))
}
