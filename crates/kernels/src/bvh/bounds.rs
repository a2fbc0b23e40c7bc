//! Axis-aligned boxes for the builder, kept in SIMD registers.

use glam::{Vec3, Vec4};

/// A box. The fourth lanes carry nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    pub lower: Vec4,
    pub upper: Vec4,
}

impl Default for Bounds {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Bounds {
    pub const EMPTY: Self = Self { lower: Vec4::INFINITY, upper: Vec4::NEG_INFINITY };
    /// Every ray is inside, at any time.
    pub const EVERYTHING: Self = Self { lower: Vec4::NEG_INFINITY, upper: Vec4::INFINITY };

    pub fn new(lower: [f32; 3], upper: [f32; 3]) -> Self {
        Self { lower: Vec3::from_array(lower).extend(0.0), upper: Vec3::from_array(upper).extend(0.0) }
    }

    #[inline(always)]
    pub fn include(&mut self, other: &Self) {
        self.lower = self.lower.min(other.lower);
        self.upper = self.upper.max(other.upper);
    }

    #[inline(always)]
    pub fn include_point(&mut self, point: Vec4) {
        self.lower = self.lower.min(point);
        self.upper = self.upper.max(point);
    }

    /// There is nothing in it.
    pub fn is_empty(&self) -> bool {
        self.lower.x > self.upper.x
    }

    /// Half the surface area; 0 for an empty box.
    #[inline(always)]
    pub fn half_area(&self) -> f32 {
        let e = (self.upper - self.lower).max(Vec4::ZERO);
        let area = e.x * (e.y + e.z) + e.y * e.z;
        // Two planes far apart: the area may be infinite, and inf times 0 NaN; both compare as the worst choice.
        if area.is_nan() { f32::INFINITY } else { area }
    }
}
