//! From film to picture: exposure, tone map, sRGB. The fourth hand.

mod srgb;
mod tone_map;

pub use srgb::{srgb_decode, srgb_encode};
pub use tone_map::{agx, filmic};

use crate::denoise::Denoised;
use crate::film::{Crop, Film, LayerImage};
use crate::mattes::MatteImage;
use rayon::prelude::*;
use scene_format::desc::ToneMap;
use srgb::ENCODER;

/// Rows of a tile of the film.
const TILE: usize = 16;

/// How a film is developed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// Stops: radiance is multiplied by 2^exposure.
    pub exposure: f64,
    /// Curve from exposed radiance to display.
    pub tone_map: ToneMap,
    /// What is behind everything.
    pub backdrop: Backdrop,
}

/// What a picture has behind everything. All but the first need a film that keeps it apart, as that of a scene with one
/// of them does ([`Film::has_backdrop`]); else the background stays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Backdrop {
    /// What the camera sees there.
    #[default]
    Background,
    /// Nothing: the picture is to be laid over another one.
    Clear,
    /// A colour of the display, linear RGB in 0..=1, whatever exposure and tone map do to the rest: paper stays white.
    Color([f64; 3]),
}

/// A picture: linear radiance for EXR, HDR and PFM, display values for PNG. Row 0 is the top; three numbers a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Exposed radiance, linear, not clipped. Where `alpha` is there without what is seen behind everything: it is
    /// premultiplied, as EXR files have it.
    pub linear: Vec<f32>,
    /// Tone-mapped and sRGB-encoded, in 0..=1. Where `alpha` is there the colour of what covers a pixel, as PNG files
    /// have it: not multiplied.
    pub display: Vec<f32>,
    /// How much of each pixel is covered, 0 to 1; where the look asks for [`Backdrop::Clear`].
    pub alpha: Option<Vec<f32>>,
    /// The film's layers, as they are: not developed.
    pub layers: Vec<LayerImage>,
    /// Mattes; [`crate::Mattes::develop`] makes them.
    pub mattes: MatteImage,
    /// Channels of the film's light groups, `light.key.R`, and their pixels: linear and exposed as `linear` is, and
    /// without what is seen behind everything where that is.
    pub light_groups: Vec<(String, Vec<f32>)>,
}

impl Look {
    /// The luminance of what the picture is laid over, as the radiance that looks like it; zero where that is nothing.
    pub(crate) fn paper(&self) -> f64 {
        match self.backdrop {
            Backdrop::Color(color) => crate::film::luminance(color) / libm::exp2(self.exposure),
            Backdrop::Background | Backdrop::Clear => 0.0,
        }
    }
}

/// Develops the film, its rows over the threads of rayon's current pool. The picture does not depend on their number.
pub fn develop(film: &Film, look: &Look) -> Image {
    developed(film, look, |x, y| film.radiance(x, y), |x, y| film.background(x, y))
}

/// Develops what denoising made of a film. The last of its layers, `noisy`, is the picture without it, as linear
/// radiance, exposed as the picture is: what was filtered away cannot be had back otherwise.
pub fn develop_denoised(film: &Film, look: &Look, denoised: &Denoised) -> Image {
    let Crop { x: left, y: top, width, .. } = film.crop();
    let radiance = |x: u32, y: u32| {
        let first = 3 * ((y - top) as usize * width as usize + (x - left) as usize);
        // It is without the background where the film keeps that by itself.
        let behind = if look.backdrop == Backdrop::Background { film.background(x, y) } else { [0.0; 3] };
        [0, 1, 2].map(|c| f64::from(denoised.radiance[first + c]) + behind[c])
    };
    let mut image = developed(film, look, radiance, |_, _| [0.0; 3]);
    let noisy = develop(film, &Look { tone_map: ToneMap::None, ..*look });
    image.layers.push(LayerImage { name: "noisy", channels: &["R", "G", "B"], values: noisy.linear });
    image
}

/// Develops radiance that no film has, row by row from the top: what another renderer has made. What is behind
/// everything cannot be told from the rest.
pub fn develop_radiance([width, height]: [u32; 2], look: &Look, radiance: &[[f64; 3]]) -> Image {
    let gain = libm::exp2(look.exposure);
    let encoder = &*ENCODER;
    let mut image = Image {
        width,
        height,
        linear: Vec::new(),
        display: Vec::new(),
        alpha: None,
        layers: Vec::new(),
        mattes: MatteImage::default(),
        light_groups: Vec::new(),
    };
    for pixel in radiance {
        let exposed = pixel.map(|x| x * gain);
        image.linear.extend(exposed.map(finite));
        image.display.extend(mapped(look.tone_map, exposed).map(|x| encoder.encode(x.clamp(0.0, 1.0))));
    }
    image
}

/// Develops pixels of this radiance, of which so much is background where that is not to be seen.
fn developed(
    film: &Film,
    look: &Look,
    radiance: impl Fn(u32, u32) -> [f64; 3] + Sync,
    background: impl Fn(u32, u32) -> [f64; 3] + Sync,
) -> Image {
    let Crop { x, y, width, height } = film.crop();
    let gain = libm::exp2(look.exposure);
    let backdrop = if film.has_backdrop() { look.backdrop } else { Backdrop::Background };
    let encoder = &*ENCODER;
    let mut linear = vec![0.0; 3 * width as usize * height as usize];
    let mut display = vec![0.0; linear.len()];
    let row = (3 * width as usize).max(1);
    let rows = (linear.par_chunks_exact_mut(row), display.par_chunks_exact_mut(row), y..y + height);
    // A tile's rows by one thread, which finds them in its cache.
    rows.into_par_iter().with_min_len(TILE).for_each(|(linear, display, py)| {
        let pixels = linear.as_chunks_mut::<3>().0.iter_mut().zip(display.as_chunks_mut::<3>().0);
        for (px, (linear, display)) in (x..x + width).zip(pixels) {
            let [r, g, b] = radiance(px, py);
            let mut exposed = [r * gain, g * gain, b * gain];
            let shown = match backdrop {
                Backdrop::Background => mapped(look.tone_map, exposed),
                Backdrop::Clear | Backdrop::Color(_) => {
                    let (alpha, behind) = (film.alpha(px, py), background(px, py));
                    // Rounded, it may be less than none.
                    let foreground = [0, 1, 2].map(|c| (exposed[c] - behind[c] * gain).max(0.0));
                    let color = mapped(look.tone_map, foreground.map(|x| if alpha > 0.0 { x / alpha } else { 0.0 }));
                    match backdrop {
                        Backdrop::Color(paper) => {
                            exposed = [0, 1, 2].map(|c| foreground[c] + (1.0 - alpha) * paper[c]);
                            [0, 1, 2].map(|c| alpha * color[c].clamp(0.0, 1.0) + (1.0 - alpha) * paper[c])
                        }
                        _ => {
                            exposed = foreground;
                            color
                        }
                    }
                }
            };
            for (to, from) in linear.iter_mut().zip(exposed) {
                *to = finite(from);
            }
            for (to, from) in display.iter_mut().zip(shown) {
                *to = encoder.encode(from.clamp(0.0, 1.0));
            }
        }
    });
    let layers = film.layers().iter().filter_map(|layer| film.layer(layer)).collect();
    let alpha_of = |k: u32| film.alpha(x + k % width, y + k / width) as f32;
    let alpha = (backdrop == Backdrop::Clear).then(|| (0..width * height).into_par_iter().map(alpha_of).collect());
    let light_groups = light_groups(film, gain, backdrop);
    Image { width, height, linear, display, alpha, layers, mattes: MatteImage::default(), light_groups }
}

/// The channels of the film's light groups, exposed by a gain. The background is of one of them, where it is seen.
fn light_groups(film: &Film, gain: f64, backdrop: Backdrop) -> Vec<(String, Vec<f32>)> {
    let Crop { x, y, width, height } = film.crop();
    let hides = |group: usize| backdrop != Backdrop::Background && film.group_of_background() == Some(group);
    let channel = |(group, name, c): (usize, &String, usize)| {
        let value = |k: u32| {
            let (px, py) = (x + k % width, y + k / width);
            let behind = if hides(group) { film.background(px, py)[c] } else { 0.0 };
            finite((film.radiance_of_group(group, px, py)[c] - behind) * gain)
        };
        let name = format!("light.{name}.{}", ["R", "G", "B"][c]);
        (name, (0..width * height).into_par_iter().map(value).collect())
    };
    let groups = film.light_groups().iter().enumerate();
    groups.flat_map(|(group, name)| [0, 1, 2].map(|c| (group, name, c))).map(channel).collect()
}

/// In single precision; what is beyond its range is its largest number: files and what reads them want finite ones.
fn finite(x: f64) -> f32 {
    x.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32
}

/// The display's linear colour of exposed radiance.
#[inline(always)]
fn mapped(tone_map: ToneMap, exposed: [f64; 3]) -> [f64; 3] {
    match tone_map {
        ToneMap::None => exposed,
        ToneMap::Filmic => filmic(exposed),
        ToneMap::AgX => agx(exposed),
    }
}
