//! Pictures of all directions, written to files.

use super::meshes::write;
use image::{DynamicImage, ImageFormat, Rgb32FImage};
use std::io::Cursor;
use std::path::PathBuf;

/// The file of a picture whose pixel in column i and row j is `color(i, j)`.
pub fn sky(
    name: &str,
    [width, height]: [u32; 2],
    format: ImageFormat,
    color: impl Fn(u32, u32) -> [f32; 3],
) -> PathBuf {
    let picture = Rgb32FImage::from_fn(width, height, |i, j| image::Rgb(color(i, j)));
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(picture).write_to(&mut bytes, format).expect("a picture in memory");
    write(name, bytes.get_ref())
}

/// A blue sky, a dark ground and a sun of two texels.
pub fn sunny() -> PathBuf {
    sky("sunny.exr", [32, 16], ImageFormat::OpenExr, |i, j| match (i, j) {
        (20 | 21, 4) => [80.0, 70.0, 50.0],
        (_, 0..8) => [0.2, 0.3 + 0.01 * i as f32, 0.6],
        _ => [0.15, 0.1, 0.05],
    })
}

/// A sky with a sun of three degrees by six.
pub fn with_a_small_sun() -> PathBuf {
    sky("small_sun.exr", [256, 128], ImageFormat::OpenExr, |i, j| match (i, j) {
        (160..164, 34..36) => [1600.0, 1400.0, 1000.0],
        (_, 0..64) => [0.2, 0.4, 0.6],
        _ => [0.15, 0.1, 0.05],
    })
}

/// Blue above, brown below.
pub fn sky_without_a_sun() -> PathBuf {
    sky("plain_sky.exr", [16, 8], ImageFormat::OpenExr, |i, j| match j {
        0..4 => [0.2, 0.3 + 0.01 * i as f32, 0.6],
        _ => [0.15, 0.1, 0.05],
    })
}

/// A sky with a sun of 34 degrees by 34, which paths find by chance, too; below the horizon something as bright.
pub fn with_wide_suns() -> PathBuf {
    sky("wide_suns.exr", [64, 32], ImageFormat::OpenExr, |i, j| match (i, j) {
        (38..44, 6..12) => [16.0, 14.0, 10.0],
        (20..24, 16..20) => [8.0, 12.0, 16.0],
        (_, 0..16) => [0.1, 0.2, 0.3],
        _ => [0.1, 0.08, 0.05],
    })
}

/// Black but for a sun from the horizon to 22 degrees below.
pub fn with_a_sun_below() -> PathBuf {
    sky("sun_below.exr", [64, 32], ImageFormat::OpenExr, |i, j| match (i, j) {
        (20..26, 17..20) => [50.0, 40.0, 30.0],
        _ => [0.0; 3],
    })
}
