//! Lambert.

use super::{Albedo, BxdfFlags, Lobe, MaterialKind, Row, Traits};

/// albedo / pi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diffuse {
    /// Reflected share.
    pub albedo: Albedo,
}

impl MaterialKind for Diffuse {
    fn row(&self) -> Row {
        Row::new(Lobe::Lambert, self.albedo)
    }

    fn traits(&self) -> Traits {
        Traits { flags: BxdfFlags::REFLECTION.or(BxdfFlags::DIFFUSE), color: self.albedo, casts: 0.0, narrow: 0.0 }
    }
}
