//! Perlin: Improving Noise (2002), with its table of permutations, and octaves of it.

use super::whole;
use crate::engine::stages::textures::floor;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;

/// Perlin's table of permutations.
#[rustfmt::skip]
pub static PERMUTATION: [u32; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225,
    140, 36, 103, 30, 69, 142, 8, 99, 37, 240, 21, 10, 23, 190, 6, 148,
    247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32,
    57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175,
    74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122,
    60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54,
    65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169,
    200, 196, 135, 130, 116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64,
    52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82, 85, 212,
    207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213,
    119, 248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9,
    129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104,
    218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162, 241,
    81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157,
    184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93,
    222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78, 66, 215, 61, 156, 180,
];

/// sum g^i n(l^i p) / sum g^i over octaves i, |n| for n in the lanes of `unsigned`; from -1 to 1. `parameters`: how
/// many octaves, l, g.
#[inline(always)]
pub fn octaves<F: Lanes>(p: V3<F>, parameters: V3<F>, unsigned: F::M, mask: F::M) -> F {
    let V3(count, lacunarity, gain) = parameters;
    let zero = F::splat(0.0);
    let (mut p, mut weight, mut i) = (p, F::splat(1.0), zero);
    let (mut sum, mut weights) = (zero, zero);
    loop {
        let on = mask & i.lt(count);
        if !on.any() {
            break;
        }
        let n = noise(p);
        let n = F::select(unsigned, n.abs(), n);
        sum = F::select(on, weight.fma(n, sum), sum);
        weights = F::select(on, weights + weight, weights);
        weight = weight * gain;
        p = V3(p.0 * lacunarity, p.1 * lacunarity, p.2 * lacunarity);
        i = i + F::splat(1.0);
    }
    let usable = zero.lt(weights);
    let mean = sum / F::select(usable, weights, F::splat(1.0));
    mean.max(F::splat(-1.0)).min(F::splat(1.0))
}

/// Improved noise, from -1 to 1; it repeats after 256 along each axis.
#[inline(always)]
pub fn noise<F: Lanes>(p: V3<F>) -> F {
    let one = F::splat(1.0);
    let (x0, x) = cell(p.0);
    let (y0, y) = cell(p.1);
    let (z0, z) = cell(p.2);
    let (u, v, w) = (fade(x), fade(y), fade(z));
    let next = F::U::splat(1);
    let a = hash::<F>(x0) + y0;
    let b = hash::<F>(x0 + next) + y0;
    let (aa, ab) = (hash::<F>(a) + z0, hash::<F>(a + next) + z0);
    let (ba, bb) = (hash::<F>(b) + z0, hash::<F>(b + next) + z0);
    let (x1, y1, z1) = (x - one, y - one, z - one);
    let low = mix(
        mix(slope(hash::<F>(aa), x, y, z), slope(hash::<F>(ba), x1, y, z), u),
        mix(slope(hash::<F>(ab), x, y1, z), slope(hash::<F>(bb), x1, y1, z), u),
        v,
    );
    let high = mix(
        mix(slope(hash::<F>(aa + next), x, y, z1), slope(hash::<F>(ba + next), x1, y, z1), u),
        mix(slope(hash::<F>(ab + next), x, y1, z1), slope(hash::<F>(bb + next), x1, y1, z1), u),
        v,
    );
    mix(low, high, w)
}

/// The whole part, modulo 256, and the rest.
#[inline(always)]
fn cell<F: Lanes>(x: F) -> (F::U, F) {
    // Octaves may go beyond what has a fraction.
    let rest = (x - floor(x)).max(F::splat(0.0)).min(F::splat(1.0));
    (whole(x) & F::U::splat(255), rest)
}

#[inline(always)]
fn hash<F: Lanes>(k: F::U) -> F::U {
    F::U::gather(&PERMUTATION, k & F::U::splat(255))
}

/// t^3 (t (6 t - 15) + 10).
#[inline(always)]
fn fade<F: Lanes>(t: F) -> F {
    let c = F::splat;
    t * t * t * t.fma(t.fma(c(6.0), c(-15.0)), c(10.0))
}

/// The dot product with one of the twelve directions to the edges of a cube, four of them twice.
#[inline(always)]
fn slope<F: Lanes>(hash: F::U, x: F, y: F, z: F) -> F {
    let h = hash & F::U::splat(15);
    let u = F::select(h.lt(F::U::splat(8)), x, y);
    let of_x = (h & F::U::splat(13)).eq(F::U::splat(12));
    let v = F::select(h.lt(F::U::splat(4)), y, F::select(of_x, x, z));
    let (sign_u, sign_v) = ((h & F::U::splat(1)).shl::<31>(), (h & F::U::splat(2)).shl::<30>());
    F::from_bits(u.to_bits() ^ sign_u) + F::from_bits(v.to_bits() ^ sign_v)
}

/// a + f (b - a).
#[inline(always)]
fn mix<F: Lanes>(a: F, b: F, f: F) -> F {
    f.fma(b - a, a)
}
