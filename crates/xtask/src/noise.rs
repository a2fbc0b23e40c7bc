//! Repeatable noise: pure functions of the place, the same on every machine.

use glam::DVec3;

/// 0 at `from` (and before), 1 at `to` (and beyond), smooth between.
pub fn smooth_step(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Value noise in -1..1: random values at the integer points, smoothly in between.
pub fn noise(p: DVec3) -> f64 {
    let cell = p.floor();
    let f = p - cell;
    let f = f * f * (3.0 - 2.0 * f);
    let [x, y, z] = [cell.x as i64, cell.y as i64, cell.z as i64];
    let mut sum = 0.0;
    for corner in 0..8 {
        let [i, j, k] = [corner & 1, corner >> 1 & 1, corner >> 2];
        let w = |one: i64, t: f64| if one == 1 { t } else { 1.0 - t };
        sum += w(i, f.x) * w(j, f.y) * w(k, f.z) * lattice(x + i, y + j, z + k);
    }
    sum
}

/// A value in -1..1 for an integer point: the finaliser of SplitMix64 (Steele, Lea and Flood 2014).
pub fn lattice(x: i64, y: i64, z: i64) -> f64 {
    let mut h = (x as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ (y as u64).wrapping_mul(0xc2b2_ae3d_27d4_eb4f)
        ^ (z as u64).wrapping_mul(0x1656_67b1_9e37_79f9);
    h = (h ^ (h >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    h = (h ^ (h >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    h ^= h >> 31;
    (h >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

/// Noise at several scales, the finer the fainter; in -1..1.
pub fn fractal_noise(p: DVec3, octaves: u32) -> f64 {
    let (mut sum, mut weight, mut total, mut q) = (0.0, 1.0, 0.0, p);
    for _ in 0..octaves {
        sum += weight * noise(q);
        total += weight;
        weight *= 0.5;
        // Shifted, so that the lattices of two octaves have no common points.
        q = q * 2.0 + DVec3::new(17.3, 5.1, 9.7);
    }
    sum / total
}
