//! Film and lens effects.

use super::ThinLens;
use crate::diagnostic::Spanned;
use crate::schema::Rule;
use crate::words::{scene_enum, scene_struct, scene_words};

scene_struct! {
    /// Film and lens effects.
    pub struct Effects as "Effects", "`Effects`" {
        /// The pixel's reconstruction filter.
        antialiasing: PixelFilter = PixelFilter::default();
        /// Lens; `None` is a pinhole.
        depth_of_field: Option<ThinLens> = None;
        /// Exposure in stops: the radiance is multiplied by 2^exposure.
        exposure: Spanned<f64> = 0.0 => Rule::within("a number", -64.0, 64.0).unit("in stops");
        /// Curve from exposed radiance to display.
        tone_map: ToneMap = ToneMap::None;
    }
}

scene_enum! {
    /// The pixel's reconstruction filter, by filter importance sampling.
    pub enum PixelFilter, "pixel filter" {
        /// Every sample through the pixel's centre.
        None;
        /// The pixel's square.
        Box;
        /// A Gaussian of this standard deviation, in pixels.
        Gaussian as "a Gaussian filter" {
            /// Standard deviation in pixels.
            sigma: Spanned<f64> = 0.4 => Rule::within("a width", 0.0, 64.0).unit("in pixels");
        };
        /// The Blackman-Harris window, 4 terms, of this radius in pixels.
        BlackmanHarris as "a Blackman-Harris filter" {
            /// Half width in pixels.
            radius: Spanned<f64> = 1.5 => Rule::within("a width", 1e-3, 64.0).unit("in pixels");
        };
    }
}

scene_words! {
    /// Curve from exposed radiance to display values, before sRGB encoding.
    pub enum ToneMap, "tone map" {
        /// Clip to 0..1.
        None,
        /// A filmic curve per channel.
        Filmic,
        /// An AgX-like curve: bright colours go to white.
        AgX,
    }
}

impl Default for PixelFilter {
    fn default() -> Self {
        PixelFilter::Gaussian { sigma: 0.4.into() }
    }
}

impl Default for Effects {
    fn default() -> Self {
        Effects {
            antialiasing: PixelFilter::default(),
            depth_of_field: None,
            exposure: 0.0.into(),
            tone_map: ToneMap::None,
        }
    }
}
