//! What shines.

use super::{Albedo, BxdfFlags, Lobe, MaterialKind, Row, Traits};

/// It shines, as the light of its surface says, and reflects nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emissive {
    /// The share of the light's radiance that each point has, per channel, from 0 to 1.
    pub glow: Albedo,
}

impl Emissive {
    /// All points shine alike.
    pub const EVEN: Emissive = Emissive { glow: Albedo::number(1.0) };
}

impl MaterialKind for Emissive {
    fn row(&self) -> Row {
        Row { glow: self.glow, ..Row::new(Lobe::Emitter, Albedo::Color([0.0; 3])) }
    }

    fn traits(&self) -> Traits {
        Traits { flags: BxdfFlags::NONE, color: Albedo::Color([0.0; 3]), casts: 0.0, narrow: 0.0 }
    }
}
