//! Eight lanes in a 256-bit register (AVX2, FMA).
//!
//! Why the instructions are there: these functions are inlined into the entry functions of `engine/kernels.rs`, which
//! are compiled for the features and called only for a [`Level`](crate::Level), and a `Level` exists only where the
//! CPU was seen to have them. No code outside this crate can name the types. That is "the CPU" in the comments below.

use super::{Bits, Lanes, Mask, Part};
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// Eight floats.
#[derive(Clone, Copy)]
pub struct F8(__m256);
/// Eight integers.
#[derive(Clone, Copy)]
pub struct U8(__m256i);
/// Eight truth values, all bits of a lane set or clear.
#[derive(Clone, Copy)]
pub struct M8(__m256);

macro_rules! binary {
    ($T:ident, $Trait:ident, $f:ident, $intrinsic:ident) => {
        impl $Trait for $T {
            type Output = Self;
            #[inline(always)]
            fn $f(self, other: Self) -> Self {
                // SAFETY: the CPU; no memory is touched.
                $T(unsafe { $intrinsic(self.0, other.0) })
            }
        }
    };
}
binary!(F8, Add, add, _mm256_add_ps);
binary!(F8, Sub, sub, _mm256_sub_ps);
binary!(F8, Mul, mul, _mm256_mul_ps);
binary!(F8, Div, div, _mm256_div_ps);
binary!(U8, Add, add, _mm256_add_epi32);
binary!(U8, Sub, sub, _mm256_sub_epi32);
binary!(U8, Mul, mul, _mm256_mullo_epi32);
binary!(U8, BitXor, bitxor, _mm256_xor_si256);
binary!(U8, BitAnd, bitand, _mm256_and_si256);
binary!(U8, BitOr, bitor, _mm256_or_si256);
binary!(M8, BitAnd, bitand, _mm256_and_ps);
binary!(M8, BitOr, bitor, _mm256_or_ps);

impl Not for M8 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        M8(unsafe { _mm256_xor_ps(self.0, _mm256_castsi256_ps(_mm256_set1_epi32(-1))) })
    }
}
impl Mask for M8 {
    const N: usize = 8;
    #[inline(always)]
    fn bits(self) -> u32 {
        // SAFETY: the CPU; no memory is touched.
        unsafe { _mm256_movemask_ps(self.0) as u32 }
    }
    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        // SAFETY: the CPU; no memory is touched.
        unsafe {
            let weights = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let set = _mm256_and_si256(_mm256_set1_epi32(bits as i32), weights);
            M8(_mm256_castsi256_ps(_mm256_cmpeq_epi32(set, weights)))
        }
    }
}
impl Neg for F8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_xor_ps(self.0, _mm256_set1_ps(-0.0)) })
    }
}

/// For each 8-bit mask, the lanes to take, packed to the front.
static COMPRESS: [[u32; 8]; 256] = {
    let mut table = [[0; 8]; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut next) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                table[mask][next] = lane as u32;
                next += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

#[inline(always)]
fn compress_order(mask: M8) -> __m256i {
    // SAFETY: the CPU; a row of the table has eight entries.
    unsafe { _mm256_loadu_si256(COMPRESS[(mask.bits() & 0xff) as usize].as_ptr().cast()) }
}

impl U8 {
    /// Indices no greater than `len - 1`, for gathers.
    #[inline(always)]
    fn clamped(self, len: usize) -> __m256i {
        assert!(len > 0 && len <= i32::MAX as usize);
        // SAFETY: the CPU; no memory is touched.
        unsafe { _mm256_min_epu32(self.0, _mm256_set1_epi32((len - 1) as i32)) }
    }
}

/// `table[index]` within `sixteens` (1 or 2) times sixteen entries, by permutations: with gathers, which are 39
/// micro-operations each on Zen 3, an eighth of the time.
///
/// # Safety
/// The CPU has AVX2; `table` points to 16 times `sixteens` floats.
#[inline(always)]
unsafe fn look_up(table: *const f32, index: __m256i, sixteens: usize) -> __m256 {
    // SAFETY: the CPU; the pointers are the caller's promise.
    unsafe {
        // blendv goes by the sign bit: bit 3 of the index chooses between eights, bit 4 between sixteens.
        let bit3 = _mm256_castsi256_ps(_mm256_slli_epi32::<28>(index));
        let low = _mm256_blendv_ps(eight(table, index), eight(table.add(8), index), bit3);
        if sixteens == 1 {
            return low;
        }
        let high = _mm256_blendv_ps(eight(table.add(16), index), eight(table.add(24), index), bit3);
        _mm256_blendv_ps(low, high, _mm256_castsi256_ps(_mm256_slli_epi32::<27>(index)))
    }
}

/// `table[index & 7]`.
///
/// # Safety
/// The CPU has AVX2; `table` points to 8 floats.
#[inline(always)]
unsafe fn eight(table: *const f32, index: __m256i) -> __m256 {
    // SAFETY: the CPU; the pointers are the caller's promise. A plain read: of the intrinsic's loads calls are left
    // standing.
    unsafe { _mm256_permutevar8x32_ps(table.cast::<__m256>().read_unaligned(), index) }
}

/// Three consecutive floats in one register.
///
/// # Safety
/// The CPU has AVX2; `at` points to 3 floats.
#[inline(always)]
unsafe fn three(at: *const f32) -> __m128 {
    // SAFETY: the CPU; the pointers are the caller's promise.
    unsafe { _mm_insert_ps::<0x20>(_mm_castpd_ps(_mm_load_sd(at.cast())), _mm_load_ss(at.add(2))) }
}

/// Two pairs of consecutive floats in one register.
///
/// # Safety
/// The CPU has AVX2; both point to 2 floats.
#[inline(always)]
unsafe fn two(first: *const f32, second: *const f32) -> __m128 {
    // SAFETY: the CPU; the pointers are the caller's promise.
    unsafe { _mm_castpd_ps(_mm_loadh_pd(_mm_load_sd(first.cast()), second.cast())) }
}

/// Both halves of a register.
///
/// # Safety
/// The CPU has AVX2.
#[inline(always)]
unsafe fn halves(low: __m128, high: __m128) -> __m256 {
    // SAFETY: the CPU; the pointers are the caller's promise.
    unsafe { _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(low), high) }
}

/// Three consecutive entries of each of eight places, as columns: rows loaded one by one and transposed, which is half
/// of what three gathers cost on Zen 3. Places are clamped to the last three entries.
#[inline(always)]
fn rows_of_three(table: &[f32], place: U8) -> [__m256; 3] {
    assert!(table.len() >= 3);
    let mut places = [0u32; 8];
    U8(place.clamped(table.len() - 2)).store(&mut places);
    let [p0, p1, p2, p3, p4, p5, p6, p7] = places;
    let t = table.as_ptr();
    // SAFETY: the CPU; `clamped` leaves each place that many entries before the end of the table.
    unsafe {
        let a = halves(three(t.add(p0 as usize)), three(t.add(p4 as usize)));
        let b = halves(three(t.add(p1 as usize)), three(t.add(p5 as usize)));
        let c = halves(three(t.add(p2 as usize)), three(t.add(p6 as usize)));
        let d = halves(three(t.add(p3 as usize)), three(t.add(p7 as usize)));
        let (ab, cd) = (_mm256_unpacklo_ps(a, b), _mm256_unpacklo_ps(c, d));
        let (ab_z, cd_z) = (_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d));
        [_mm256_shuffle_ps::<0x44>(ab, cd), _mm256_shuffle_ps::<0xee>(ab, cd), _mm256_shuffle_ps::<0x44>(ab_z, cd_z)]
    }
}

/// As [`rows_of_three`], four entries.
#[inline(always)]
fn rows_of_four(table: &[f32], place: U8) -> [__m256; 4] {
    assert!(table.len() >= 4);
    let mut places = [0u32; 8];
    U8(place.clamped(table.len() - 3)).store(&mut places);
    let [p0, p1, p2, p3, p4, p5, p6, p7] = places;
    let t = table.as_ptr();
    // SAFETY: the CPU; `clamped` leaves each place that many entries before the end of the table.
    unsafe {
        let a = halves(_mm_loadu_ps(t.add(p0 as usize)), _mm_loadu_ps(t.add(p4 as usize)));
        let b = halves(_mm_loadu_ps(t.add(p1 as usize)), _mm_loadu_ps(t.add(p5 as usize)));
        let c = halves(_mm_loadu_ps(t.add(p2 as usize)), _mm_loadu_ps(t.add(p6 as usize)));
        let d = halves(_mm_loadu_ps(t.add(p3 as usize)), _mm_loadu_ps(t.add(p7 as usize)));
        let (ab, cd) = (_mm256_unpacklo_ps(a, b), _mm256_unpacklo_ps(c, d));
        let (ab_high, cd_high) = (_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d));
        [
            _mm256_shuffle_ps::<0x44>(ab, cd),
            _mm256_shuffle_ps::<0xee>(ab, cd),
            _mm256_shuffle_ps::<0x44>(ab_high, cd_high),
            _mm256_shuffle_ps::<0xee>(ab_high, cd_high),
        ]
    }
}

/// As [`rows_of_three`], two entries.
#[inline(always)]
fn rows_of_two(table: &[f32], place: U8) -> [__m256; 2] {
    assert!(table.len() >= 2);
    let mut places = [0u32; 8];
    U8(place.clamped(table.len() - 1)).store(&mut places);
    let [p0, p1, p2, p3, p4, p5, p6, p7] = places;
    let t = table.as_ptr();
    // SAFETY: the CPU; `clamped` leaves each place that many entries before the end of the table.
    unsafe {
        // u v u v of lanes 0 1 and 4 5, then of 2 3 and 6 7.
        let a = halves(two(t.add(p0 as usize), t.add(p1 as usize)), two(t.add(p4 as usize), t.add(p5 as usize)));
        let b = halves(two(t.add(p2 as usize), t.add(p3 as usize)), two(t.add(p6 as usize), t.add(p7 as usize)));
        [_mm256_shuffle_ps::<0x88>(a, b), _mm256_shuffle_ps::<0xdd>(a, b)]
    }
}

impl Bits for U8 {
    type M = M8;
    #[inline(always)]
    fn splat(x: u32) -> Self {
        // SAFETY: the CPU; no memory is touched.
        U8(unsafe { _mm256_set1_epi32(x as i32) })
    }
    #[inline(always)]
    fn load(from: &[u32]) -> Self {
        let from = &from[..8];
        // SAFETY: the CPU; the slice was cut to 8 entries.
        U8(unsafe { _mm256_loadu_si256(from.as_ptr().cast()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [u32]) {
        let to = &mut to[..8];
        // SAFETY: the CPU; the slice was cut to 8 entries.
        unsafe { _mm256_storeu_si256(to.as_mut_ptr().cast(), self.0) }
    }
    #[inline(always)]
    fn shr<const K: u32>(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        U8(unsafe { _mm256_srl_epi32(self.0, _mm_cvtsi32_si128(K as i32)) })
    }
    #[inline(always)]
    fn shl<const K: u32>(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        U8(unsafe { _mm256_sll_epi32(self.0, _mm_cvtsi32_si128(K as i32)) })
    }
    #[inline(always)]
    fn eq(self, other: Self) -> M8 {
        // SAFETY: the CPU; no memory is touched.
        M8(unsafe { _mm256_castsi256_ps(_mm256_cmpeq_epi32(self.0, other.0)) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M8 {
        // Unsigned order is signed order with the top bit flipped.
        // SAFETY: the CPU; no memory is touched.
        unsafe {
            let top = _mm256_set1_epi32(i32::MIN);
            let (a, b) = (_mm256_xor_si256(self.0, top), _mm256_xor_si256(other.0, top));
            M8(_mm256_castsi256_ps(_mm256_cmpgt_epi32(b, a)))
        }
    }
    #[inline(always)]
    fn select(mask: M8, a: Self, b: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        unsafe {
            let (a, b) = (_mm256_castsi256_ps(a.0), _mm256_castsi256_ps(b.0));
            U8(_mm256_castps_si256(_mm256_blendv_ps(b, a, mask.0)))
        }
    }
    #[inline(always)]
    fn gather(table: &[u32], index: Self) -> Self {
        let at = index.clamped(table.len());
        // SAFETY: the CPU; indices are clamped to the table, and registers are loaded of tables of just their size.
        unsafe {
            U8(match table.len() {
                16 => _mm256_castps_si256(look_up(table.as_ptr().cast(), at, 1)),
                _ => _mm256_i32gather_epi32::<4>(table.as_ptr().cast(), at),
            })
        }
    }
    #[inline(always)]
    fn gather3(table: &[u32], place: Self) -> [Self; 3] {
        // Bits are only moved: the registers of floats do.
        // SAFETY: u32 and f32 have one size and alignment, and every bit pattern is a value of both.
        let floats = unsafe { std::slice::from_raw_parts(table.as_ptr().cast::<f32>(), table.len()) };
        let [x, y, z] = rows_of_three(floats, place);
        // SAFETY: the CPU; no memory is touched.
        unsafe { [U8(_mm256_castps_si256(x)), U8(_mm256_castps_si256(y)), U8(_mm256_castps_si256(z))] }
    }
    #[inline(always)]
    fn reverse_bits(self) -> Self {
        // Nibbles by table, then the bytes of each word back to front.
        // SAFETY: the CPU; no memory is touched.
        unsafe {
            let low = _mm256_set1_epi8(0x0f);
            let table =
                _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
            let swap = _mm256_broadcastsi128_si256(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
            let a = _mm256_shuffle_epi8(table, _mm256_and_si256(self.0, low));
            let b = _mm256_shuffle_epi8(table, _mm256_and_si256(_mm256_srli_epi32::<4>(self.0), low));
            U8(_mm256_shuffle_epi8(_mm256_or_si256(_mm256_slli_epi32::<4>(a), b), swap))
        }
    }
    #[inline(always)]
    fn compress(self, mask: M8, to: &mut [u32]) {
        // SAFETY: the CPU; no memory is touched.
        U8(unsafe { _mm256_permutevar8x32_epi32(self.0, compress_order(mask)) }).store(to)
    }
}

impl Lanes for F8 {
    const N: usize = 8;
    type M = M8;
    type U = U8;
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_set1_ps(x) })
    }
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        let from = &from[..8];
        // SAFETY: the CPU; the slice was cut to 8 entries.
        F8(unsafe { _mm256_loadu_ps(from.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..8];
        // SAFETY: the CPU; the slice was cut to 8 entries.
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_fmadd_ps(self.0, b.0, c.0) })
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_fnmadd_ps(self.0, b.0, c.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M8 {
        // SAFETY: the CPU; no memory is touched.
        M8(unsafe { _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn le(self, other: Self) -> M8 {
        // SAFETY: the CPU; no memory is touched.
        M8(unsafe { _mm256_cmp_ps::<_CMP_LE_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn select(mask: M8, a: Self, b: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_blendv_ps(b.0, a.0, mask.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
    }
    #[inline(always)]
    fn to_bits(self) -> U8 {
        // SAFETY: the CPU; no memory is touched.
        U8(unsafe { _mm256_castps_si256(self.0) })
    }
    #[inline(always)]
    fn from_bits(bits: U8) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_castsi256_ps(bits.0) })
    }
    #[inline(always)]
    fn from_int(ints: U8) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_cvtepi32_ps(ints.0) })
    }
    #[inline(always)]
    fn to_int(self) -> U8 {
        // SAFETY: the CPU; no memory is touched.
        U8(unsafe { _mm256_cvttps_epi32(self.0) })
    }
    #[inline(always)]
    fn gather(table: &[f32], index: U8) -> Self {
        let at = index.clamped(table.len());
        // SAFETY: the CPU; indices are clamped to the table, and registers are loaded of tables of just their size.
        unsafe {
            F8(match table.len() {
                16 => look_up(table.as_ptr(), at, 1),
                32 => look_up(table.as_ptr(), at, 2),
                _ => _mm256_i32gather_ps::<4>(table.as_ptr(), at),
            })
        }
    }
    #[inline(always)]
    fn gather2(table: &[f32], place: U8) -> [Self; 2] {
        let [x, y] = rows_of_two(table, place);
        [F8(x), F8(y)]
    }
    #[inline(always)]
    fn gather3(table: &[f32], place: U8) -> [Self; 3] {
        let [x, y, z] = rows_of_three(table, place);
        [F8(x), F8(y), F8(z)]
    }
    #[inline(always)]
    fn gather4(table: &[f32], place: U8) -> [Self; 4] {
        let [a, b, c, d] = rows_of_four(table, place);
        [F8(a), F8(b), F8(c), F8(d)]
    }
    #[inline(always)]
    fn apart<P: Part<Self>>(part: P) -> P::Out {
        #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
        #[inline(never)]
        fn enter<P: Part<F8>>(part: P) -> P::Out {
            part.run()
        }
        // SAFETY: the CPU has the features of the level that this is compiled into, which are those of `enter`.
        unsafe { enter(part) }
    }
    #[inline(always)]
    fn compress(self, mask: M8, to: &mut [f32]) {
        // SAFETY: the CPU; no memory is touched.
        F8(unsafe { _mm256_permutevar8x32_ps(self.0, compress_order(mask)) }).store(to)
    }
}
