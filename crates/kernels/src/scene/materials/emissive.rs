//! What shines.

use super::{Albedo, BxdfFlags, Lobe, MaterialKind, Row, Traits};

/// It shines, as the light of its surface says, and reflects nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Emissive;

impl MaterialKind for Emissive {
    fn row(&self) -> Row {
        Row::new(Lobe::Emitter, Albedo::Color([0.0; 3]))
    }

    fn traits(&self) -> Traits {
        Traits { flags: BxdfFlags::NONE, color: Albedo::Color([0.0; 3]), casts: 0.0 }
    }
}
