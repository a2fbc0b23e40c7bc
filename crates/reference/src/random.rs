//! Random numbers: SplitMix64 (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators, 2014).

use glam::DVec3;

/// A stream of independent random numbers.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The stream of a seed; neighbouring seeds give unrelated streams.
    pub fn new(seed: u64) -> Self {
        let mut random = Random(seed);
        random.0 = random.bits();
        random
    }

    /// 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A number in [0, 1).
    pub fn number(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// A number in [a, b).
    pub fn between(&mut self, a: f64, b: f64) -> f64 {
        a + (b - a) * self.number()
    }

    /// A whole number below n.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// A direction, uniform over the sphere (Archimedes: its z is uniform).
    pub fn direction(&mut self) -> DVec3 {
        let z = self.between(-1.0, 1.0);
        polar(z, self.number())
    }
}

/// The unit vector with this z, at this fraction of a turn about the z axis.
pub(crate) fn polar(z: f64, turn: f64) -> DVec3 {
    let (sin, cos) = (std::f64::consts::TAU * turn).sin_cos();
    let r = (1.0 - z * z).max(0.0).sqrt();
    DVec3::new(r * cos, r * sin, z)
}

/// A vector given in a frame whose third axis is `axis` (unit), in world coordinates.
pub(crate) fn about(axis: DVec3, local: DVec3) -> DVec3 {
    let (x, y) = axis.any_orthonormal_pair();
    x * local.x + y * local.y + axis * local.z
}
