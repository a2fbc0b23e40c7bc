//! From film to picture: exposure, tone map, sRGB. The fourth hand.

mod tone_map;

pub use tone_map::{agx, filmic};

use crate::film::{Crop, Film};
use scene_format::desc::ToneMap;

/// How a film is developed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// Stops: radiance is multiplied by 2^exposure.
    pub exposure: f64,
    /// Curve from exposed radiance to display.
    pub tone_map: ToneMap,
}

/// A picture: linear radiance for EXR, HDR and PFM, display values for PNG. Row 0 is the top; three numbers a pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Exposed radiance, linear, not clipped.
    pub linear: Vec<f32>,
    /// Tone-mapped and sRGB-encoded, in 0..=1.
    pub display: Vec<f32>,
}

/// Develops the film.
pub fn develop(film: &Film, look: &Look) -> Image {
    let Crop { x, y, width, height } = film.crop();
    let gain = libm::exp2(look.exposure);
    let mut linear = Vec::with_capacity(3 * width as usize * height as usize);
    let mut display = Vec::with_capacity(linear.capacity());
    for py in y..y + height {
        for px in x..x + width {
            let exposed = film.radiance(px, py).map(|c| c * gain);
            linear.extend(exposed.map(|c| c as f32));
            let mapped = match look.tone_map {
                ToneMap::None => exposed,
                ToneMap::Filmic => filmic(exposed),
                ToneMap::AgX => agx(exposed),
            };
            display.extend(mapped.map(|c| srgb_encode(c.clamp(0.0, 1.0)) as f32));
        }
    }
    Image { width, height, linear, display }
}

/// sRGB (IEC 61966-2-1) code value of linear light, both in 0..=1.
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn srgb_of_known_values() {
        assert_eq!(srgb_encode(0.0), 0.0);
        assert!((srgb_encode(1.0) - 1.0).abs() < 1e-12);
        // 18 % grey is code value 118 of 255.
        assert_eq!((srgb_encode(0.18) * 255.0).round(), 118.0);
        assert!((srgb_encode(0.003_130_8) - 0.003_130_8 * 12.92).abs() < 1e-6);
    }
}
