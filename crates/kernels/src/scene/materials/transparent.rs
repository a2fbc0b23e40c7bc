//! Smooth dielectrics.

use super::{Albedo, BxdfFlags, Lobe, MaterialKind, Row, Traits};

/// A smooth dielectric.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transparent {
    /// Index of the inside against the outside.
    pub ior: f64,
    /// Share of refracted light that passes the surface.
    pub transmittance: Albedo,
}

impl MaterialKind for Transparent {
    fn row(&self) -> Row {
        let parameters = [Albedo::number(self.ior), Albedo::number(0.0)];
        Row { parameters, ..Row::new(Lobe::Dielectric, self.transmittance) }
    }

    fn traits(&self) -> Traits {
        let flags = BxdfFlags::REFLECTION.or(BxdfFlags::TRANSMISSION).or(BxdfFlags::SPECULAR);
        // What it does not let through it reflects, and that is not coloured.
        Traits { flags, color: self.transmittance, casts: 1.0, narrow: 1.0 }
    }
}
