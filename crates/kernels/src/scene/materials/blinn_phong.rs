//! Blinn-Phong.

use super::{Albedo, BxdfFlags, LEAST_EXPONENT, Lobe, MaterialKind, Row, Traits, narrow};

/// albedo ((1 - s)/pi + s (alpha + 2)/(2 pi) cos^alpha theta_h), or with the glossy lobe of Ashikhmin and Shirley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlinnPhong {
    /// Colour of both lobes.
    pub albedo: Albedo,
    /// alpha, 0 to 10^7.
    pub exponent: Albedo,
    /// s, 0 to 1.
    pub specular: Albedo,
    /// The glossy lobe is s (alpha + 1)/(8 pi (wo.h) max(cos i, cos o)) cos^alpha theta_h.
    pub energy_conserving: bool,
}

impl MaterialKind for BlinnPhong {
    fn row(&self) -> Row {
        let lobe = if self.energy_conserving { Lobe::BlinnPhongConserving } else { Lobe::BlinnPhong };
        Row { parameters: [self.exponent, self.specular], ..Row::new(lobe, self.albedo) }
    }

    fn traits(&self) -> Traits {
        let flags = BxdfFlags::REFLECTION.or(BxdfFlags::DIFFUSE).or(BxdfFlags::GLOSSY);
        // At normal incidence.
        let specular = self.specular.largest();
        let lobe = if self.energy_conserving { specular } else { 4.0 * specular };
        // A texture may be narrow somewhere.
        let exponent = self.exponent.constant().map(|[exponent, ..]| exponent);
        let is_narrow = exponent.is_none_or(|exponent| exponent as f32 >= LEAST_EXPONENT);
        let casts = if is_narrow { self.albedo.largest() * lobe } else { 0.0 };
        let narrow = exponent.map_or(1.0, |exponent| narrow((2.0 / (exponent + 2.0)).sqrt()));
        Traits { flags, color: self.albedo, casts, narrow }
    }
}
