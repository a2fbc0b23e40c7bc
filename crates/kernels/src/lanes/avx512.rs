//! Sixteen lanes in a 512-bit register (AVX-512 F, VL, DQ, BW).
//!
//! Why the instructions are there: these functions are inlined into the entry functions of `engine/kernels.rs`, which
//! are compiled for the features and called only for a [`Level`](crate::Level), and a `Level` exists only where the
//! CPU was seen to have them. No code outside this crate can name the types. That is "the CPU" in the comments below.

use super::{Bits, Lanes, Mask, Part};
use std::arch::x86_64::*;
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// Sixteen floats.
#[derive(Clone, Copy)]
pub struct F16(__m512);
/// Sixteen integers.
#[derive(Clone, Copy)]
pub struct U16(__m512i);
/// Sixteen truth values.
#[derive(Clone, Copy)]
pub struct M16(__mmask16);

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
binary!(F16, Add, add, _mm512_add_ps);
binary!(F16, Sub, sub, _mm512_sub_ps);
binary!(F16, Mul, mul, _mm512_mul_ps);
binary!(F16, Div, div, _mm512_div_ps);
binary!(U16, Add, add, _mm512_add_epi32);
binary!(U16, Sub, sub, _mm512_sub_epi32);
binary!(U16, Mul, mul, _mm512_mullo_epi32);
binary!(U16, BitXor, bitxor, _mm512_xor_si512);
binary!(U16, BitAnd, bitand, _mm512_and_si512);
binary!(U16, BitOr, bitor, _mm512_or_si512);

impl BitAnd for M16 {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        M16(self.0 & other.0)
    }
}
impl BitOr for M16 {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        M16(self.0 | other.0)
    }
}
impl Not for M16 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        M16(!self.0)
    }
}
impl Mask for M16 {
    const N: usize = 16;
    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self.0)
    }
    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        M16(bits as u16)
    }
}
impl Neg for F16 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_xor_ps(self.0, _mm512_set1_ps(-0.0)) })
    }
}

impl U16 {
    /// Indices no greater than `len - 1`, for gathers.
    #[inline(always)]
    fn clamped(self, len: usize) -> __m512i {
        assert!(len > 0 && len <= i32::MAX as usize);
        // SAFETY: the CPU; no memory is touched.
        unsafe { _mm512_min_epu32(self.0, _mm512_set1_epi32((len - 1) as i32)) }
    }
}

impl Bits for U16 {
    type M = M16;
    #[inline(always)]
    fn splat(x: u32) -> Self {
        // SAFETY: the CPU; no memory is touched.
        U16(unsafe { _mm512_set1_epi32(x as i32) })
    }
    #[inline(always)]
    fn load(from: &[u32]) -> Self {
        /// A vector that need not be aligned. To read it is no call: in large functions the compiler leaves that of
        /// `_mm512_loadu_si512` where it is.
        #[repr(C, packed)]
        struct Loose(__m512i);
        let from = &from[..16];
        // SAFETY: the CPU; the slice was cut to 16 entries.
        U16(unsafe { (*from.as_ptr().cast::<Loose>()).0 })
    }
    #[inline(always)]
    fn store(self, to: &mut [u32]) {
        let to = &mut to[..16];
        // SAFETY: the CPU; the slice was cut to 16 entries.
        unsafe { _mm512_storeu_si512(to.as_mut_ptr().cast(), self.0) }
    }
    #[inline(always)]
    fn shr<const K: u32>(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        U16(unsafe { _mm512_srli_epi32::<K>(self.0) })
    }
    #[inline(always)]
    fn shl<const K: u32>(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        U16(unsafe { _mm512_slli_epi32::<K>(self.0) })
    }
    #[inline(always)]
    fn eq(self, other: Self) -> M16 {
        // SAFETY: the CPU; no memory is touched.
        M16(unsafe { _mm512_cmpeq_epi32_mask(self.0, other.0) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M16 {
        // SAFETY: the CPU; no memory is touched.
        M16(unsafe { _mm512_cmplt_epu32_mask(self.0, other.0) })
    }
    #[inline(always)]
    fn select(mask: M16, a: Self, b: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        U16(unsafe { _mm512_mask_blend_epi32(mask.0, b.0, a.0) })
    }
    #[inline(always)]
    fn gather(table: &[u32], index: Self) -> Self {
        let at = index.clamped(table.len());
        if table.len() == 16 {
            // SAFETY: the CPU; `load` checks its slice.
            return U16(unsafe { _mm512_permutexvar_epi32(at, U16::load(table).0) });
        }
        // SAFETY: the CPU; indices are clamped to the table, and registers are loaded of tables of just their size.
        U16(unsafe { _mm512_i32gather_epi32::<4>(at, table.as_ptr().cast()) })
    }
    #[inline(always)]
    fn reverse_bits(self) -> Self {
        // Nibbles by table, then the bytes of each word back to front.
        // SAFETY: the CPU; no memory is touched.
        unsafe {
            let low = _mm512_set1_epi8(0x0f);
            let table = _mm512_broadcast_i32x4(_mm_setr_epi8(0, 8, 4, 12, 2, 10, 6, 14, 1, 9, 5, 13, 3, 11, 7, 15));
            let swap = _mm512_broadcast_i32x4(_mm_setr_epi8(3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12));
            let a = _mm512_shuffle_epi8(table, _mm512_and_si512(self.0, low));
            let b = _mm512_shuffle_epi8(table, _mm512_and_si512(_mm512_srli_epi32::<4>(self.0), low));
            U16(_mm512_shuffle_epi8(_mm512_or_si512(_mm512_slli_epi32::<4>(a), b), swap))
        }
    }
    #[inline(always)]
    fn compress(self, mask: M16, to: &mut [u32]) {
        // SAFETY: the CPU; no memory is touched.
        U16(unsafe { _mm512_maskz_compress_epi32(mask.0, self.0) }).store(to)
    }
}

impl Lanes for F16 {
    const N: usize = 16;
    type M = M16;
    type U = U16;
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_set1_ps(x) })
    }
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        let from = &from[..16];
        // SAFETY: the CPU; the slice was cut to 16 entries.
        F16(unsafe { _mm512_loadu_ps(from.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..16];
        // SAFETY: the CPU; the slice was cut to 16 entries.
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), self.0) }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_sqrt_ps(self.0) })
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_fmadd_ps(self.0, b.0, c.0) })
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_fnmadd_ps(self.0, b.0, c.0) })
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_min_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_max_ps(self.0, other.0) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> M16 {
        // SAFETY: the CPU; no memory is touched.
        M16(unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn le(self, other: Self) -> M16 {
        // SAFETY: the CPU; no memory is touched.
        M16(unsafe { _mm512_cmp_ps_mask::<_CMP_LE_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn select(mask: M16, a: Self, b: Self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_mask_blend_ps(mask.0, b.0, a.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_abs_ps(self.0) })
    }
    #[inline(always)]
    fn to_bits(self) -> U16 {
        // SAFETY: the CPU; no memory is touched.
        U16(unsafe { _mm512_castps_si512(self.0) })
    }
    #[inline(always)]
    fn from_bits(bits: U16) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_castsi512_ps(bits.0) })
    }
    #[inline(always)]
    fn from_int(ints: U16) -> Self {
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_cvtepi32_ps(ints.0) })
    }
    #[inline(always)]
    fn to_int(self) -> U16 {
        // SAFETY: the CPU; no memory is touched.
        U16(unsafe { _mm512_cvttps_epi32(self.0) })
    }
    #[inline(always)]
    fn gather(table: &[f32], index: U16) -> Self {
        // Small tables are looked up by a permutation within one or two registers: a fifth of a gather's time. Plain
        // reads, since the compiler leaves some of the intrinsic's loads standing as calls in functions as large as
        // `shade`. SAFETY: the CPU; indices are clamped to the table, and registers are loaded of tables of just their
        // size.
        unsafe {
            let n = table.len();
            if n == 32 {
                let index = index.clamped(n);
                let table: *const __m512 = table.as_ptr().cast();
                let (a, b) = (table.read_unaligned(), table.add(1).read_unaligned());
                F16(_mm512_permutex2var_ps(a, index, b))
            } else if n == 16 {
                let table: *const __m512 = table.as_ptr().cast();
                F16(_mm512_permutexvar_ps(index.clamped(n), table.read_unaligned()))
            } else {
                F16(_mm512_i32gather_ps::<4>(index.clamped(n), table.as_ptr().cast()))
            }
        }
    }
    #[inline(always)]
    fn apart<P: Part<Self>>(part: P) -> P::Out {
        #[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx512cd,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
        #[inline(never)]
        fn enter<P: Part<F16>>(part: P) -> P::Out {
            part.run()
        }
        // SAFETY: the CPU has the features of the level that this is compiled into, which are those of `enter`.
        unsafe { enter(part) }
    }
    #[inline(always)]
    fn compress(self, mask: M16, to: &mut [f32]) {
        // In a register and then whole: compressing straight to memory is microcode on some CPUs.
        // SAFETY: the CPU; no memory is touched.
        F16(unsafe { _mm512_maskz_compress_ps(mask.0, self.0) }).store(to)
    }
}
