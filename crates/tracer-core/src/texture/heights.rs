//! Pictures of heights: PNG, JPEG, EXR and HDR files, whose numbers are taken as they stand.

use super::{Channel, ENVIRONMENTS, TextureError, checked_up_to, format_of, warning_of_alpha};
use image::DynamicImage;
use rayon::prelude::*;
use scene_format::Diagnostics;
use std::path::Path;
use tracer_mesh::read_regular_file;
use tracer_mesh::shapes::{Heights, MOST_HEIGHTS};

/// Heights, and what of their file was ignored: at most one `W0520`, without a span.
#[derive(Clone, Debug, PartialEq)]
pub struct Landscape {
    /// 0 is black and 1 white.
    pub heights: Heights,
    /// What was ignored.
    pub warnings: Diagnostics,
}

/// Reads the heights in `path`; its content decides the format, not its extension. Row 0 is the picture's top row. No
/// curve is taken off: the byte 128 is 128/255. Of colours it is the luminance of Rec. 709.
///
/// # Errors
/// When there is no such file, it cannot be read, is of another format or broken, has less than two pixels along a side
/// or more than [`MOST_HEIGHTS`], or a height is not finite.
pub fn load_heights(path: &Path) -> Result<Landscape, TextureError> {
    decode_heights(&read_regular_file(path)?, path)
}

/// Decodes heights from the bytes of their file; `path` is what messages show.
///
/// # Errors
/// As [`load_heights`].
pub fn decode_heights(bytes: &[u8], path: &Path) -> Result<Landscape, TextureError> {
    let format = format_of(bytes, path, &ENVIRONMENTS)?;
    landscape(checked_up_to(bytes, path, format, MOST_HEIGHTS)?, path, bytes.len() as u64)
}

/// The heights of a picture of so many bytes.
pub(super) fn landscape(picture: DynamicImage, path: &Path, bytes: u64) -> Result<Landscape, TextureError> {
    let (width, depth) = (picture.width(), picture.height());
    if width < 2 || depth < 2 || u64::from(width) * u64::from(depth) > MOST_HEIGHTS {
        return Err(TextureError::Size { path: path.to_owned(), width, height: depth, bytes });
    }
    let warnings = warning_of_alpha(&picture, path, Channel::Color).into_iter().collect();
    let values = values(picture);
    let wrong = values.par_iter().filter(|height| !height.is_finite()).count();
    if wrong > 0 {
        return Err(TextureError::Heights { path: path.to_owned(), wrong });
    }
    Ok(Landscape { heights: Heights { width, depth, values }, warnings })
}

/// The heights of all pixels.
fn values(picture: DynamicImage) -> Vec<f32> {
    let (byte, word) = (f32::from(u8::MAX), f32::from(u16::MAX));
    match picture {
        DynamicImage::ImageLuma8(p) => p.as_raw().par_iter().map(|x| f32::from(*x) / byte).collect(),
        DynamicImage::ImageLuma16(p) => p.as_raw().par_iter().map(|x| f32::from(*x) / word).collect(),
        DynamicImage::ImageLumaA8(p) => of_pixels::<2, _>(p.as_raw(), |[grey, _]| f32::from(grey) / byte),
        DynamicImage::ImageLumaA16(p) => of_pixels::<2, _>(p.as_raw(), |[grey, _]| f32::from(grey) / word),
        DynamicImage::ImageRgb16(p) => of_pixels::<3, _>(p.as_raw(), |p| luminance(p.map(|x| f32::from(x) / word))),
        DynamicImage::ImageRgba16(p) => {
            of_pixels::<4, _>(p.as_raw(), |[r, g, b, _]| luminance([r, g, b].map(|x| f32::from(x) / word)))
        }
        DynamicImage::ImageRgb32F(p) => of_pixels::<3, _>(p.as_raw(), luminance),
        DynamicImage::ImageRgba32F(p) => of_pixels::<4, _>(p.as_raw(), |[r, g, b, _]| luminance([r, g, b])),
        other => of_pixels::<3, _>(other.into_rgb8().as_raw(), |p| luminance(p.map(|x| f32::from(x) / byte))),
    }
}

fn of_pixels<const N: usize, T: Copy + Sync>(raw: &[T], height: impl Fn([T; N]) -> f32 + Sync) -> Vec<f32> {
    raw.as_chunks::<N>().0.par_iter().map(|pixel| height(*pixel)).collect()
}

/// Grey is what it is, to the last bit.
fn luminance([r, g, b]: [f32; 3]) -> f32 {
    if r == g && g == b { r } else { (0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)) as f32 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{GrayImage, ImageBuffer, ImageFormat, Luma, LumaA, Rgb, Rgb32FImage, RgbImage};

    fn written(picture: impl Into<DynamicImage>, name: &str) -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join(name);
        picture.into().save(&path).expect("a picture");
        (folder, path)
    }

    fn heights(picture: impl Into<DynamicImage>, name: &str) -> Vec<f32> {
        let (_folder, path) = written(picture, name);
        load_heights(&path).expect("heights").heights.values
    }

    #[test]
    fn numbers_are_taken_as_they_stand() {
        let bytes = GrayImage::from_raw(2, 2, vec![0, 128, 55, 255]).expect("a picture");
        assert_eq!(heights(bytes, "a.png"), [0.0, 128.0 / 255.0, 55.0 / 255.0, 1.0]);
        let words: ImageBuffer<Luma<u16>, Vec<u16>> =
            ImageBuffer::from_raw(2, 2, vec![0, 1, 32768, 65535]).expect("a picture");
        assert_eq!(heights(words, "a.png"), [0.0, 1.0 / 65535.0, 32768.0 / 65535.0, 1.0]);
        let colors = RgbImage::from_raw(2, 2, vec![255, 0, 0, 0, 255, 0, 0, 0, 255, 77, 77, 77]).expect("a picture");
        assert_eq!(heights(colors, "a.png"), [0.2126, 0.7152, 0.0722, 77.0 / 255.0]);
        // Row 0 is the top row, below zero and above one is allowed.
        let numbers = Rgb32FImage::from_fn(3, 2, |x, y| Rgb([x as f32 - 10.0 * y as f32; 3]));
        assert_eq!(heights(numbers, "a.exr"), [0.0, 1.0, 2.0, -10.0, -9.0, -8.0]);
        let (_folder, path) = written(GrayImage::from_pixel(16, 16, Luma([200])), "a.jpg");
        let jpeg = load_heights(&path).expect("heights").heights.values;
        assert!(jpeg.iter().all(|h| (h - 200.0 / 255.0).abs() < 0.01));
    }

    #[test]
    fn what_is_no_landscape_is_told() {
        let fault = |picture: DynamicImage, name: &str| {
            let (_folder, path) = written(picture, name);
            let fault = load_heights(&path).expect_err("no landscape").to_heights_diagnostic(Default::default());
            assert_eq!(fault.code, scene_format::codes::BROKEN_TEXTURE);
            (fault.message, fault.expected, fault.hint)
        };
        let narrow = fault(GrayImage::new(9, 1).into(), "a.png");
        assert!(narrow.0.contains("9 x 1 pixels") && narrow.2.contains("has no surface"), "{narrow:?}");
        let mut holes = Rgb32FImage::new(3, 3);
        holes.put_pixel(1, 1, Rgb([f32::NAN; 3]));
        holes.put_pixel(2, 1, Rgb([f32::INFINITY; 3]));
        let holes = fault(holes.into(), "a.exr");
        assert!(holes.0.starts_with("2 heights of the picture ") && holes.2.contains("fill it in"), "{holes:?}");
        let (_folder, path) = written(GrayImage::new(5, 4), "a.png");
        let bytes = std::fs::read(&path).expect("a file");
        assert!(matches!(
            checked_up_to(&bytes, &path, ImageFormat::Png, 19),
            Err(TextureError::Size { width: 5, height: 4, .. })
        ));
        std::fs::write(&path, b"no picture").expect("a file");
        let none = load_heights(&path).expect_err("no picture").to_heights_diagnostic(Default::default());
        assert!(none.expected.contains("HDR, EXR, PNG or JPEG"), "{none:?}");
    }

    #[test]
    fn what_is_not_opaque_is_told() {
        let picture: ImageBuffer<LumaA<u8>, Vec<u8>> = ImageBuffer::from_pixel(2, 2, LumaA([9, 7]));
        let (_folder, path) = written(picture, "a.png");
        let landscape = load_heights(&path).expect("heights");
        assert_eq!(landscape.warnings.len(), 1);
        assert_eq!(landscape.heights.values, [9.0 / 255.0; 4]);
    }
}
