//! Perfect mirrors.

use super::{Albedo, BxdfFlags, Lobe, MaterialKind, Row, Traits};

/// A perfect mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// Reflected share.
    pub reflectance: Albedo,
}

impl MaterialKind for Mirror {
    fn row(&self) -> Row {
        Row::new(Lobe::Mirror, self.reflectance)
    }

    fn traits(&self) -> Traits {
        let color = self.reflectance;
        Traits { flags: BxdfFlags::REFLECTION.or(BxdfFlags::SPECULAR), color, casts: color.largest(), narrow: 1.0 }
    }
}
