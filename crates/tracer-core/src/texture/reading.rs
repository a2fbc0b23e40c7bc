//! What of a picture counts, and what its numbers mean.

use crate::texture::SRGB_TO_LINEAR;
use image::DynamicImage;
use rayon::prelude::*;
use tracer_kernels::scene::Texels;
use tracer_kernels::srgb::linear_of_srgb;

/// What of a picture counts, and what its numbers mean. The default is the colours as files have them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Reading {
    /// What the numbers mean.
    pub space: ColorSpace,
    /// What counts.
    pub channel: Channel,
}

/// What the numbers of a picture mean.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum ColorSpace {
    /// sRGB where they are whole, linear where they are floats.
    #[default]
    Auto,
    /// sRGB.
    Srgb,
    /// Linear.
    Linear,
}

/// What of a picture counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Channel {
    /// Red, green and blue.
    #[default]
    Color,
    /// Red as a grey.
    Red,
    /// Green as a grey.
    Green,
    /// Blue as a grey.
    Blue,
    /// Alpha as a grey, linear; 1 where there is none.
    Alpha,
    /// 0.2126 R + 0.7152 G + 0.0722 B as a grey.
    Luminance,
}

impl Reading {
    /// The texels of a picture of whole numbers.
    #[expect(
        clippy::indexing_slicing,
        reason = "a value of 8 or 16 bits has its entry of 256 or 65536, and pixels are chunks of exactly three or four"
    )]
    pub(super) fn texels(self, picture: DynamicImage) -> Texels {
        let linear = self.space == ColorSpace::Linear;
        let deep = picture.color().bytes_per_pixel() > picture.color().channel_count();
        let is_bytes = !linear && !matches!(self.channel, Channel::Alpha | Channel::Luminance);
        if !deep && is_bytes {
            let picture = picture.into_rgb8();
            let which = match self.channel {
                Channel::Red => [0; 3],
                Channel::Green => [1; 3],
                Channel::Blue => [2; 3],
                _ => [0, 1, 2],
            };
            let pack = |p: &[u8]| u32::from_le_bytes([p[which[0]], p[which[1]], p[which[2]], 0]);
            return Texels::Srgb8(picture.as_raw().par_chunks_exact(3).map(pack).collect());
        }
        if deep {
            let table = tracer_kernels::srgb::linear_of_srgb16();
            let share = |x: u16| (f64::from(x) / 65535.0) as f32;
            let light = |x: u16| if linear { share(x) } else { table[usize::from(x)] };
            let picture = picture.into_rgba16();
            let texel = |p: &[u16]| self.counts([light(p[0]), light(p[1]), light(p[2])], share(p[3]));
            return Texels::Linear(picture.as_raw().par_chunks_exact(4).map(texel).collect());
        }
        let share = |x: u8| (f64::from(x) / 255.0) as f32;
        let light = |x: u8| if linear { share(x) } else { SRGB_TO_LINEAR[usize::from(x)] };
        let picture = picture.into_rgba8();
        let texel = |p: &[u8]| self.counts([light(p[0]), light(p[1]), light(p[2])], share(p[3]));
        Texels::Linear(picture.as_raw().par_chunks_exact(4).map(texel).collect())
    }

    /// A texel of floats.
    pub(super) fn texel(self, color: [f32; 3], alpha: f32) -> [f32; 3] {
        let linear = match self.space {
            ColorSpace::Srgb => color.map(|x| linear_of_srgb(f64::from(x)) as f32),
            ColorSpace::Auto | ColorSpace::Linear => color,
        };
        self.counts(linear, alpha)
    }

    /// What counts of linear light.
    fn counts(self, color: [f32; 3], alpha: f32) -> [f32; 3] {
        let [red, green, blue] = color;
        match self.channel {
            Channel::Color => color,
            Channel::Red => [red; 3],
            Channel::Green => [green; 3],
            Channel::Blue => [blue; 3],
            Channel::Alpha => [alpha; 3],
            Channel::Luminance => {
                let [red, green, blue] = color.map(f64::from);
                // Of greys the very number.
                [(green + 0.2126 * (red - green) + 0.0722 * (blue - green)) as f32; 3]
            }
        }
    }
}
