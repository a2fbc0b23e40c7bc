//! The lane type: N `f32` in one value, one trait, several ways of filling it.
//!
//! Every operation is either correctly rounded by IEEE 754 (add, sub, mul, div, sqrt, fma, int → float) or a pure bit
//! operation, so a program written over [`Lanes`] gives the same bits for every N. There is no rcp, no rsqrt, no libm.
//! `min` and `max` are defined as `a < b ? a : b` and `a > b ? a : b` (what MINPS and MAXPS do).
//!
//! Every generic function over lanes carries `#[inline(always)]`: it has to end up inside an entry function with
//! `#[target_feature]` (see `engine/kernels.rs`), because only there do the `std::arch` intrinsics become
//! instructions. One forgotten attribute costs a factor of 20 and changes no bit; `tests/vector_code.rs` looks at the
//! disassembly for it.

mod array;
// For the entry functions alone, which unit tests do without.
#[cfg(all(target_arch = "x86_64", not(test)))]
#[allow(unsafe_code)]
mod avx2;
#[cfg(all(target_arch = "x86_64", not(test)))]
#[allow(unsafe_code)]
mod avx512;
#[cfg(all(target_arch = "x86_64", not(test)))]
mod pair;

pub use array::{ArrayF, ArrayU};
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};
#[cfg(all(target_arch = "x86_64", not(test)))]
pub use {avx2::F8, avx512::F16, pair::Pair};

/// A truth value per lane.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Number of lanes.
    const N: usize;
    /// One bit per lane, lane 0 lowest; bits above N are zero.
    fn bits(self) -> u32;
    /// The inverse of [`Mask::bits`].
    fn from_bits(bits: u32) -> Self;
    /// Whether any lane is true.
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    /// Number of true lanes.
    #[inline(always)]
    fn count(self) -> usize {
        self.bits().count_ones() as usize
    }
}

/// N unsigned integers; arithmetic wraps.
pub trait Bits:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + BitXor<Output = Self>
    + BitAnd<Output = Self>
    + BitOr<Output = Self>
{
    /// The truth values that belong to it.
    type M: Mask;
    /// The same in all lanes.
    fn splat(x: u32) -> Self;
    /// The first N of a slice.
    fn load(from: &[u32]) -> Self;
    /// Into the first N of a slice.
    fn store(self, to: &mut [u32]);
    /// Logical shift right by the same amount in all lanes.
    fn shr<const K: u32>(self) -> Self;
    /// Shift left by the same amount in all lanes.
    fn shl<const K: u32>(self) -> Self;
    /// Equal.
    fn eq(self, other: Self) -> Self::M;
    /// Unsigned less than.
    fn lt(self, other: Self) -> Self::M;
    /// Lane by lane `mask ? a : b`.
    fn select(mask: Self::M, a: Self, b: Self) -> Self;
    /// `table[index]`; indices past the end read the last entry (the table must not be empty).
    fn gather(table: &[u32], index: Self) -> Self;
    /// Three consecutive entries, the first at `place`; where they go past the end, anything of the table (which must
    /// hold three).
    #[inline(always)]
    fn gather3(table: &[u32], place: Self) -> [Self; 3] {
        let one = Self::splat(1);
        [Self::gather(table, place), Self::gather(table, place + one), Self::gather(table, place + one + one)]
    }
    /// Bit 31 becomes bit 0 and so on.
    fn reverse_bits(self) -> Self;
    /// Stores the lanes where the mask is true, packed, to the front of `to`, which must hold N; what follows them is
    /// undefined.
    fn compress(self, mask: Self::M, to: &mut [u32]);
}

/// A piece of a stage that is large and seldom needed: compiled once a lane type, as a function that the stages call,
/// instead of in every stage that has need of it ([`Lanes::apart`]).
pub trait Part<F: Lanes> {
    /// What comes of it.
    type Out;
    /// Does it; `#[inline(always)]`, as all that is generic over lanes.
    fn run(self) -> Self::Out;
}

/// N `f32`.
pub trait Lanes
where
    Self: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>,
    Self: Div<Output = Self> + Neg<Output = Self> + 'static,
{
    /// Number of lanes.
    const N: usize;
    /// The truth values that belong to it.
    type M: Mask;
    /// The integers that belong to it.
    type U: Bits<M = Self::M>;
    /// The same in all lanes.
    fn splat(x: f32) -> Self;
    /// The first N of a slice.
    fn load(from: &[f32]) -> Self;
    /// Into the first N of a slice.
    fn store(self, to: &mut [f32]);
    /// Square root, correctly rounded.
    fn sqrt(self) -> Self;
    /// self * b + c, one rounding.
    fn fma(self, b: Self, c: Self) -> Self;
    /// c - self * b, one rounding.
    fn fnma(self, b: Self, c: Self) -> Self;
    /// `self < other ? self : other`.
    fn min(self, other: Self) -> Self;
    /// `self > other ? self : other`.
    fn max(self, other: Self) -> Self;
    /// Less than; false for NaN.
    fn lt(self, other: Self) -> Self::M;
    /// Less or equal; false for NaN.
    fn le(self, other: Self) -> Self::M;
    /// Lane by lane `mask ? a : b`.
    fn select(mask: Self::M, a: Self, b: Self) -> Self;
    /// Sign bit cleared.
    fn abs(self) -> Self;
    /// The bit patterns.
    fn to_bits(self) -> Self::U;
    /// The inverse of [`Lanes::to_bits`].
    fn from_bits(bits: Self::U) -> Self;
    /// From integers below 2^31, rounded to nearest.
    fn from_int(ints: Self::U) -> Self;
    /// To integers, towards zero; the value must lie in [0, 2^31).
    fn to_int(self) -> Self::U;
    /// `table[index]`; indices past the end read the last entry (the table must not be empty).
    fn gather(table: &[f32], index: Self::U) -> Self;
    /// Two consecutive entries, the first at `place`; where they go past the end, anything of the table (which must
    /// hold two).
    #[inline(always)]
    fn gather2(table: &[f32], place: Self::U) -> [Self; 2] {
        [Self::gather(table, place), Self::gather(table, place + Self::U::splat(1))]
    }
    /// Three consecutive entries, the first at `place`; where they go past the end, anything of the table (which must
    /// hold three).
    #[inline(always)]
    fn gather3(table: &[f32], place: Self::U) -> [Self; 3] {
        let one = Self::U::splat(1);
        [Self::gather(table, place), Self::gather(table, place + one), Self::gather(table, place + one + one)]
    }
    /// Four consecutive entries, the first at `place`; where they go past the end, anything of the table (which must
    /// hold four).
    #[inline(always)]
    fn gather4(table: &[f32], place: Self::U) -> [Self; 4] {
        let two = Self::U::splat(2);
        let ([a, b], [c, d]) = (Self::gather2(table, place), Self::gather2(table, place + two));
        [a, b, c, d]
    }
    /// Stores the lanes where the mask is true, packed, to the front of `to`, which must hold N; what follows them is
    /// undefined.
    fn compress(self, mask: Self::M, to: &mut [f32]);

    /// Runs a part as a function of its own, with the instructions that these lanes are made of. Its operands go over
    /// memory, so that they stay in registers where no part is run.
    fn apart<P: Part<Self>>(part: P) -> P::Out;

    /// True in the first `n` lanes (all of them when `n` is N or more).
    #[inline(always)]
    fn first(n: usize) -> Self::M {
        Self::M::from_bits(if n >= Self::N { (((1u64 << Self::N) - 1) & 0xffff_ffff) as u32 } else { (1u32 << n) - 1 })
    }
}
