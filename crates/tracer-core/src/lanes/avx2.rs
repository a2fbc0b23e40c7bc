//! Eight lanes in a 256-bit register (AVX2, FMA).
//!
//! SAFETY of every `unsafe` block here: the values of these types come to life only inside entry functions that
//! [`super::level`] calls after it has seen the CPU's features, and loads, stores and gathers check their bounds first.
#![allow(clippy::undocumented_unsafe_blocks)]

use super::{Bits, Lanes, Mask};
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
        M8(unsafe { _mm256_xor_ps(self.0, _mm256_castsi256_ps(_mm256_set1_epi32(-1))) })
    }
}
impl Mask for M8 {
    #[inline(always)]
    fn bits(self) -> u32 {
        unsafe { _mm256_movemask_ps(self.0) as u32 }
    }
    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
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
    unsafe { _mm256_loadu_si256(COMPRESS[(mask.bits() & 0xff) as usize].as_ptr().cast()) }
}

impl U8 {
    /// Indices no greater than `len - 1`, for gathers.
    #[inline(always)]
    fn clamped(self, len: usize) -> __m256i {
        assert!(len > 0 && len <= i32::MAX as usize);
        unsafe { _mm256_min_epu32(self.0, _mm256_set1_epi32((len - 1) as i32)) }
    }
}

impl Bits for U8 {
    type M = M8;
    #[inline(always)]
    fn splat(x: u32) -> Self {
        U8(unsafe { _mm256_set1_epi32(x as i32) })
    }
    #[inline(always)]
    fn load(from: &[u32]) -> Self {
        let from = &from[..8];
        U8(unsafe { _mm256_loadu_si256(from.as_ptr().cast()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [u32]) {
        let to = &mut to[..8];
        unsafe { _mm256_storeu_si256(to.as_mut_ptr().cast(), self.0) }
    }
    #[inline(always)]
    fn shr<const K: u32>(self) -> Self {
        U8(unsafe { _mm256_srl_epi32(self.0, _mm_cvtsi32_si128(K as i32)) })
    }
    #[inline(always)]
    fn shl<const K: u32>(self) -> Self {
        U8(unsafe { _mm256_sll_epi32(self.0, _mm_cvtsi32_si128(K as i32)) })
    }
    #[inline(always)]
    fn eq(self, other: Self) -> M8 {
        M8(unsafe { _mm256_castsi256_ps(_mm256_cmpeq_epi32(self.0, other.0)) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M8 {
        // Unsigned order is signed order with the top bit flipped.
        unsafe {
            let top = _mm256_set1_epi32(i32::MIN);
            let (a, b) = (_mm256_xor_si256(self.0, top), _mm256_xor_si256(other.0, top));
            M8(_mm256_castsi256_ps(_mm256_cmpgt_epi32(b, a)))
        }
    }
    #[inline(always)]
    fn select(mask: M8, a: Self, b: Self) -> Self {
        unsafe {
            let (a, b) = (_mm256_castsi256_ps(a.0), _mm256_castsi256_ps(b.0));
            U8(_mm256_castps_si256(_mm256_blendv_ps(b, a, mask.0)))
        }
    }
    #[inline(always)]
    fn gather(table: &[u32], index: Self) -> Self {
        let index = index.clamped(table.len());
        U8(unsafe { _mm256_i32gather_epi32::<4>(table.as_ptr().cast(), index) })
    }
    #[inline(always)]
    fn reverse_bits(self) -> Self {
        // Nibbles by table, then the bytes of each word back to front.
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
        U8(unsafe { _mm256_permutevar8x32_epi32(self.0, compress_order(mask)) }).store(to)
    }
}

impl Lanes for F8 {
    const N: usize = 8;
    type M = M8;
    type U = U8;
    #[inline(always)]
    fn splat(x: f32) -> Self {
        F8(unsafe { _mm256_set1_ps(x) })
    }
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        let from = &from[..8];
        F8(unsafe { _mm256_loadu_ps(from.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..8];
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        F8(unsafe { _mm256_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        F8(unsafe { _mm256_fmadd_ps(self.0, b.0, c.0) })
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        F8(unsafe { _mm256_fnmadd_ps(self.0, b.0, c.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        F8(unsafe { _mm256_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        F8(unsafe { _mm256_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M8 {
        M8(unsafe { _mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn le(self, other: Self) -> M8 {
        M8(unsafe { _mm256_cmp_ps::<_CMP_LE_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn select(mask: M8, a: Self, b: Self) -> Self {
        F8(unsafe { _mm256_blendv_ps(b.0, a.0, mask.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        F8(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
    }
    #[inline(always)]
    fn to_bits(self) -> U8 {
        U8(unsafe { _mm256_castps_si256(self.0) })
    }
    #[inline(always)]
    fn from_bits(bits: U8) -> Self {
        F8(unsafe { _mm256_castsi256_ps(bits.0) })
    }
    #[inline(always)]
    fn from_int(ints: U8) -> Self {
        F8(unsafe { _mm256_cvtepi32_ps(ints.0) })
    }
    #[inline(always)]
    fn to_int(self) -> U8 {
        U8(unsafe { _mm256_cvttps_epi32(self.0) })
    }
    #[inline(always)]
    fn gather(table: &[f32], index: U8) -> Self {
        let index = index.clamped(table.len());
        F8(unsafe { _mm256_i32gather_ps::<4>(table.as_ptr().cast(), index) })
    }
    #[inline(always)]
    fn compress(self, mask: M8, to: &mut [f32]) {
        F8(unsafe { _mm256_permutevar8x32_ps(self.0, compress_order(mask)) }).store(to)
    }
}
