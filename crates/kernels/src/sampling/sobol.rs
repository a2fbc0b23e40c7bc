//! Sobol' points in base 2 and their Owen scrambling by hashing.
//!
//! Words are held bit-reversed where that saves work: in a *reversed fraction* bit 0 weighs 1/2, bit 1 weighs 1/4, and
//! so on, so that the first Sobol' dimension of index i (van der Corput) is i itself.

use crate::lanes::Bits;

/// The second Sobol' dimension of an index, as a reversed fraction: the Pascal matrix mod 2 (upper triangle) over the
/// bits.
#[inline(always)]
pub fn pascal_upper<U: Bits>(i: U) -> U {
    let m = U::splat;
    let i = i ^ i.shr::<16>();
    let i = i ^ (i & m(0xff00_ff00)).shr::<8>();
    let i = i ^ (i & m(0xf0f0_f0f0)).shr::<4>();
    let i = i ^ (i & m(0xcccc_cccc)).shr::<2>();
    i ^ (i & m(0xaaaa_aaaa)).shr::<1>()
}

/// What the second dimension takes for a pixel's Z-order number, reversed as that: the number times a matrix V, upper
/// triangular in the number's own order (columns, lowest bit first: 1 2 6 8 1d 3e 7e f8), which leaves the order of
/// tiles of 256 pixels as it is. With the number itself the points of 64 samples of 8x8 pixels would be clumped. How V
/// was found and what it is worth: docs/noise.md, "Neighbours in two dimensions".
#[inline(always)]
pub fn second_of_pixel<U: Bits>(z: U) -> U {
    let m = U::splat;
    let z = z ^ (z.shl::<4>() & m(0xf000_0000));
    let z = z ^ (z.shl::<1>() & m(0x5e00_0000));
    z ^ (z.shl::<2>() & m(0x3c00_0000))
}

/// Owen scrambling of a reversed fraction, keyed: each bit is flipped by a hash of the bits that weigh more.
/// Laine and Karras: Stratified Sampling for Stochastic Transparency (2011), with the constants of Vegdahl (2021).
#[inline(always)]
pub fn owen<U: Bits>(x: U, key: U) -> U {
    let m = U::splat;
    let x = x ^ (x * m(0x3d20_adea));
    let x = (x + key) * (key.shr::<16>() | m(1));
    let x = x ^ (x * m(0x0552_6c56));
    x ^ (x * m(0x53a2_2864))
}

/// A keyed permutation of indices that maps [2^m, 2^(m+1)) to itself for every m, and 0 to 0: [`owen`] on the reversed
/// index without its addition keeps trailing zeros and the lowest set bit. So the first N = 2^m samples are the same
/// set whatever the key, in another order: two dimension pairs get independent orders, and no prefix of a power of two
/// loses its stratification.
pub fn shuffle_index(i: u32, key: u32) -> u32 {
    let x = i.reverse_bits();
    let x = x ^ x.wrapping_mul(0x3d20_adea);
    let x = x.wrapping_mul(key | 1);
    let x = x ^ x.wrapping_mul(0x0552_6c56);
    let x = x.wrapping_mul((key >> 16) | 1);
    let x = x ^ x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// [`shuffle_index`] over lanes, a key each.
#[inline(always)]
pub fn shuffle_indices<U: Bits>(i: U, key: U) -> U {
    let m = U::splat;
    let x = i.reverse_bits();
    let x = x ^ (x * m(0x3d20_adea));
    let x = x * (key | m(1));
    let x = x ^ (x * m(0x0552_6c56));
    let x = x * (key.shr::<16>() | m(1));
    let x = x ^ (x * m(0x53a2_2864));
    x.reverse_bits()
}

/// Direction numbers of the third and fourth Sobol' dimension (Joe and Kuo 2008, new-joe-kuo-6: s = 2, a = 1, m = 1 3
/// and s = 3, a = 1, m = 1 3 1), reversed.
const DIRECTIONS: [[u32; 32]; 2] = [directions(2, 1, [1, 3, 0]), directions(3, 1, [1, 3, 1])];

const fn directions(s: usize, a: u32, m: [u32; 3]) -> [u32; 32] {
    let mut v = [0u32; 32];
    let mut k = 0;
    while k < 32 {
        if k < s {
            v[k] = m[k] << (31 - k);
        } else {
            v[k] = v[k - s] ^ (v[k - s] >> s);
            let mut j = 1;
            while j < s {
                if (a >> (s - 1 - j)) & 1 == 1 {
                    v[k] ^= v[k - j];
                }
                j += 1;
            }
        }
        k += 1;
    }
    let mut k = 0;
    while k < 32 {
        v[k] = v[k].reverse_bits();
        k += 1;
    }
    v
}

/// The third (`which` = 0) or fourth (1) Sobol' dimension of an index, as a reversed fraction.
pub fn higher_dimension(which: usize, i: u32) -> u32 {
    let mut word = 0;
    let mut rest = i;
    while rest != 0 {
        word ^= DIRECTIONS[which & 1][rest.trailing_zeros() as usize];
        rest &= rest - 1;
    }
    word
}

/// Columns of [`companion_index`]'s matrix for the first 2^16 indices: upper triangular, ones on the diagonal. Found by
/// a search column by column: all subsets of rows of the four generator matrices that an elementary interval asks about
/// were tried, and what left the fewest of them dependent was kept.
const COMPANION: [u32; 16] =
    [0x1, 0x3, 0x4, 0xd, 0x11, 0x32, 0x57, 0x81, 0x16c, 0x325, 0x505, 0xf47, 0x1c69, 0x269f, 0x6a92, 0xe8cd];

/// The index of a second pair that belongs to a first pair of index `i`: the four dimensions together are a (t,
/// 4)-sequence whose first 2^m points have t = 0, 1, 1, 1, 2, 1, 2, 2, 2, 3 for m = 1 to 10 (four dimensions of Sobol':
/// 0, 1, 2, 2, 2, 2, 2, 3, 3, 2), and, as those of Sobol' do not, both pairs alone are (0, 2)-sequences: a linear map
/// of the index whose matrix is upper triangular only changes the order of the points within [2^m, 2^(m + 1)). Ahmed,
/// Skopenkov, Hadwiger and Wonka: Analysis and Synthesis of Digital Dyadic Sequences (2023) build such sequences in
/// another way.
pub fn companion_index(i: u32) -> u32 {
    let (mut word, mut rest) = (0, i);
    while rest != 0 {
        let k = rest.trailing_zeros() as usize;
        let column = COMPANION[k & 15];
        word ^= if k < 16 { column } else { column << 16 | column };
        rest &= rest - 1;
    }
    word
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::ArrayU;

    fn upper(i: u32) -> u32 {
        let mut out = [0];
        pascal_upper(ArrayU::<1>::splat(i)).store(&mut out);
        out[0]
    }
    /// The Pascal matrix mod 2 (lower triangle): row r, column c is binomial(r, c). Any k successive rows of its first
    /// k columns are invertible (the binomials are polynomials of degree c in r), which is what the sampler needs.
    fn lower(i: u32) -> u32 {
        let i = i ^ (i << 16);
        let i = i ^ ((i & 0x00ff_00ff) << 8);
        let i = i ^ ((i & 0x0f0f_0f0f) << 4);
        let i = i ^ ((i & 0x3333_3333) << 2);
        i ^ ((i & 0x5555_5555) << 1)
    }

    #[test]
    fn pascal_matrices_are_binomials_mod_2() {
        for c in 0..32u32 {
            for r in 0..32u32 {
                // Lucas: binomial(n, k) is odd when the bits of k are among those of n.
                assert_eq!(lower(1 << c) >> r & 1, u32::from(c & !r == 0), "lower {r} {c}");
                assert_eq!(upper(1 << c) >> r & 1, u32::from(r & !c == 0), "upper {r} {c}");
            }
        }
    }

    /// The matrix whose columns its text lists, and none of it leads out of a tile.
    #[test]
    fn the_second_dimension_of_pixels_is_upper_triangular() {
        let columns = [0x1, 0x2, 0x6, 0x8, 0x1d, 0x3e, 0x7e, 0xf8];
        for bit in 0..32 {
            let mut word = [0];
            second_of_pixel(ArrayU::<1>::splat((1u32 << bit).reverse_bits())).store(&mut word);
            assert_eq!(word[0].reverse_bits(), columns.get(bit).copied().unwrap_or(1 << bit), "{bit}");
        }
    }

    /// What the sampler's points rest on: columns suffice, as all of it is linear.
    #[test]
    fn lower_upper_lower_reverses() {
        for column in (0..32).map(|c| 1u32 << c) {
            assert_eq!(lower(upper(lower(column))), column.reverse_bits());
            assert_eq!(lower(upper(column)), lower(column).reverse_bits());
            assert_eq!(lower(column.reverse_bits()), upper(column).reverse_bits());
        }
    }

    #[test]
    fn shuffling_keeps_every_prefix_of_a_power_of_two() {
        for key in [0u32, 1, 0xdead_beef, 0x1234_5678, u32::MAX] {
            for m in 0..12 {
                let mut seen: Vec<u32> = (0..1 << m).map(|i| shuffle_index(i, key)).collect();
                seen.sort_unstable();
                assert!(seen.iter().enumerate().all(|(i, &s)| i as u32 == s), "key {key:x} m {m}");
            }
        }
    }

    /// Every elementary interval of the first 2^m points of a pair holds what a (t, 2)-sequence promises (t = 0 for the
    /// first pair).
    #[test]
    fn first_pair_is_a_zero_two_sequence() {
        for m in 0..=10u32 {
            for a in 0..=m {
                let mut cells = vec![0u32; 1 << m];
                for i in 0..1u32 << m {
                    let x = u64::from(i.reverse_bits());
                    let y = u64::from(upper(i).reverse_bits());
                    let column = (x << a) >> 32;
                    let row = (y << (m - a)) >> 32;
                    cells[((column << (m - a)) | row) as usize] += 1;
                }
                assert!(cells.iter().all(|&c| c == 1), "m {m} a {a}");
            }
        }
    }

    /// Indices keep their powers of two, so that every prefix of one of them is the same set.
    #[test]
    fn companion_indices_are_a_permutation_of_every_power_of_two() {
        for m in 0..=17 {
            let mut seen: Vec<u32> = (0..1 << m).map(companion_index).collect();
            seen.sort_unstable();
            assert!(seen.iter().enumerate().all(|(k, &i)| k as u32 == i), "m {m}");
        }
        for k in 0..32 {
            assert_eq!(companion_index(1 << k) >> k, 1, "bit {k}");
        }
    }

    /// The least t so that every elementary interval of volume 2^(t - m) holds 2^t of the first 2^m points.
    fn quality(points: &[[u32; 4]], m: u32) -> u32 {
        let even = |t: u32| {
            let s = m - t;
            let splits = (0..=s).flat_map(|a| (0..=s - a).flat_map(move |b| (0..=s - a - b).map(move |c| [a, b, c])));
            splits.into_iter().all(|[a, b, c]| {
                let bits = [a, b, c, s - a - b - c];
                let mut cells = vec![0u32; 1 << s];
                for point in points {
                    // The upper bits of each dimension, one after the other.
                    let cell =
                        point.iter().zip(bits).fold(0, |cell, (&x, n)| cell << n | (u64::from(x) << n >> 32) as usize);
                    cells[cell] += 1;
                }
                cells.iter().all(|&count| count == 1 << t)
            })
        };
        (0..=m).find(|&t| even(t)).expect("all points lie in the whole")
    }

    #[test]
    fn a_pair_and_its_companion_are_stratified_together_and_alone() {
        let point = |i: u32| {
            let j = companion_index(i);
            [i, upper(i), j, upper(j)].map(u32::reverse_bits)
        };
        let expected = [0, 0, 1, 1, 1, 2, 1, 2, 2, 2, 3];
        for m in 0..=10u32 {
            let points: Vec<[u32; 4]> = (0..1 << m).map(point).collect();
            assert_eq!(quality(&points, m), expected[m as usize], "m {m}");
            // Alone: the other two dimensions are the same for all and out of the way.
            let pair: Vec<[u32; 4]> = points.iter().map(|p| [p[2], p[3], 0, 0]).collect();
            for a in 0..=m {
                let mut cells = vec![0u32; 1 << m];
                for [x, y, ..] in &pair {
                    let (column, row) = (u64::from(*x) << a >> 32, u64::from(*y) << (m - a) >> 32);
                    cells[(column << (m - a) | row) as usize] += 1;
                }
                assert!(cells.iter().all(|&c| c == 1), "the second pair alone, m {m} a {a}");
            }
        }
    }

    #[test]
    fn higher_dimensions_are_stratified_alone() {
        for which in 0..2 {
            let mut seen: Vec<u32> = (0..1024).map(|i| higher_dimension(which, i).reverse_bits() >> 22).collect();
            seen.sort_unstable();
            assert!(seen.iter().enumerate().all(|(i, &s)| i as u32 == s));
        }
    }
}
