//! Smooth dielectrics.

use super::{Albedo, BxdfFlags, Lobe, MaterialKind, Row, Traits};

/// A smooth dielectric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transparent {
    /// Index of the inside against the outside.
    pub ior: f64,
    /// Share of refracted light that passes the surface, linear RGB.
    pub transmittance: [f64; 3],
}

impl MaterialKind for Transparent {
    fn row(&self) -> Row {
        Row { lobe: Lobe::Dielectric, color: Albedo::Color(self.transmittance), parameters: [self.ior, 0.0] }
    }

    fn traits(&self) -> Traits {
        let flags = BxdfFlags::REFLECTION.or(BxdfFlags::TRANSMISSION).or(BxdfFlags::SPECULAR);
        // What it does not let through it reflects, and that is not coloured.
        Traits { flags, color: Albedo::Color(self.transmittance), casts: 1.0 }
    }
}
