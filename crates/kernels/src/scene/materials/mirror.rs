//! Perfect mirrors.

use super::{Albedo, BxdfFlags, Lobe, MaterialKind, Row, Traits};

/// A perfect mirror.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mirror {
    /// Reflected share, linear RGB.
    pub reflectance: [f64; 3],
}

impl MaterialKind for Mirror {
    fn row(&self) -> Row {
        Row { lobe: Lobe::Mirror, color: Albedo::Color(self.reflectance), parameters: [0.0; 2] }
    }

    fn traits(&self) -> Traits {
        let color = Albedo::Color(self.reflectance);
        Traits { flags: BxdfFlags::REFLECTION.or(BxdfFlags::SPECULAR), color, casts: color.largest() }
    }
}
