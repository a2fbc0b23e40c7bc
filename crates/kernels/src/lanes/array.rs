//! Lanes as plain arrays. `ArrayF<1>` is the scalar twin of the vector code; wider ones serve machines without AVX2.

use super::{Bits, Lanes, Mask, Part};
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// N floats.
#[derive(Clone, Copy)]
pub struct ArrayF<const N: usize>([f32; N]);
/// N integers.
#[derive(Clone, Copy)]
pub struct ArrayU<const N: usize>([u32; N]);
/// N truth values.
#[derive(Clone, Copy)]
pub struct ArrayM<const N: usize>([bool; N]);

/// Does something for each lane, by a loop and not by a closure: the inliner may decline a closure. One lane has no
/// loop: shading has thousands of such, and the optimizer visited each of them many times.
macro_rules! for_each {
    ($n:ident, |$i:ident| $do:expr) => {
        if $n == 1 {
            let $i = 0;
            $do
        } else {
            let mut $i = 0;
            while $i < $n {
                $do;
                $i += 1;
            }
        }
    };
}
/// `[expression in i; N]`.
macro_rules! each {
    ($n:ident, $zero:expr, |$i:ident| $e:expr) => {{
        let mut result = [$zero; $n];
        for_each!($n, |$i| result[$i] = $e);
        result
    }};
}
macro_rules! binary {
    ($T:ident, $Trait:ident, $f:ident, $zero:expr, |$a:ident, $b:ident| $e:expr) => {
        impl<const N: usize> $Trait for $T<N> {
            type Output = Self;
            #[inline(always)]
            fn $f(self, other: Self) -> Self {
                $T(each!(N, $zero, |i| {
                    let ($a, $b) = (self.0[i], other.0[i]);
                    $e
                }))
            }
        }
    };
}
binary!(ArrayF, Add, add, 0f32, |a, b| a + b);
binary!(ArrayF, Sub, sub, 0f32, |a, b| a - b);
binary!(ArrayF, Mul, mul, 0f32, |a, b| a * b);
binary!(ArrayF, Div, div, 0f32, |a, b| a / b);
binary!(ArrayU, Add, add, 0u32, |a, b| a.wrapping_add(b));
binary!(ArrayU, Sub, sub, 0u32, |a, b| a.wrapping_sub(b));
binary!(ArrayU, Mul, mul, 0u32, |a, b| a.wrapping_mul(b));
binary!(ArrayU, BitXor, bitxor, 0u32, |a, b| a ^ b);
binary!(ArrayU, BitAnd, bitand, 0u32, |a, b| a & b);
binary!(ArrayU, BitOr, bitor, 0u32, |a, b| a | b);
binary!(ArrayM, BitAnd, bitand, false, |a, b| a & b);
binary!(ArrayM, BitOr, bitor, false, |a, b| a | b);

impl<const N: usize> Not for ArrayM<N> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        ArrayM(each!(N, false, |i| !self.0[i]))
    }
}

impl<const N: usize> Neg for ArrayF<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        ArrayF(each!(N, 0f32, |i| -self.0[i]))
    }
}

impl<const N: usize> Mask for ArrayM<N> {
    const N: usize = N;
    #[inline(always)]
    fn bits(self) -> u32 {
        let mut bits = 0;
        for_each!(N, |i| bits |= (self.0[i] as u32) << i);
        bits
    }
    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        ArrayM(each!(N, false, |i| (bits >> i) & 1 != 0))
    }
}

impl<const N: usize> Bits for ArrayU<N> {
    type M = ArrayM<N>;
    #[inline(always)]
    fn splat(x: u32) -> Self {
        ArrayU(each!(N, 0, |i| x))
    }
    #[inline(always)]
    fn load(from: &[u32]) -> Self {
        ArrayU(each!(N, 0, |i| from[i]))
    }
    #[inline(always)]
    fn store(self, to: &mut [u32]) {
        to[..N].copy_from_slice(&self.0)
    }
    #[inline(always)]
    fn shr<const K: u32>(self) -> Self {
        ArrayU(each!(N, 0, |i| self.0[i] >> K))
    }
    #[inline(always)]
    fn shl<const K: u32>(self) -> Self {
        ArrayU(each!(N, 0, |i| self.0[i] << K))
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Self::M {
        ArrayM(each!(N, false, |i| self.0[i] == other.0[i]))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::M {
        ArrayM(each!(N, false, |i| self.0[i] < other.0[i]))
    }
    #[inline(always)]
    fn select(mask: Self::M, a: Self, b: Self) -> Self {
        ArrayU(each!(N, 0, |i| if mask.0[i] { a.0[i] } else { b.0[i] }))
    }
    #[inline(always)]
    fn gather(table: &[u32], index: Self) -> Self {
        ArrayU(each!(N, 0, |i| table[(index.0[i] as usize).min(table.len() - 1)]))
    }
    #[inline(always)]
    fn reverse_bits(self) -> Self {
        ArrayU(each!(N, 0, |i| self.0[i].reverse_bits()))
    }
    // With one lane nothing comes after it.
    #[allow(unused_assignments)]
    #[inline(always)]
    fn compress(self, mask: Self::M, to: &mut [u32]) {
        let mut next = 0;
        for_each!(N, |i| if mask.0[i] {
            to[next] = self.0[i];
            next += 1;
        });
    }
}

impl<const N: usize> Lanes for ArrayF<N> {
    const N: usize = N;
    type M = ArrayM<N>;
    type U = ArrayU<N>;
    #[inline(always)]
    fn splat(x: f32) -> Self {
        ArrayF(each!(N, 0f32, |i| x))
    }
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        ArrayF(each!(N, 0f32, |i| from[i]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        to[..N].copy_from_slice(&self.0)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        ArrayF(each!(N, 0f32, |i| self.0[i].sqrt()))
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        ArrayF(each!(N, 0f32, |i| self.0[i].mul_add(b.0[i], c.0[i])))
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        ArrayF(each!(N, 0f32, |i| (-self.0[i]).mul_add(b.0[i], c.0[i])))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        ArrayF(each!(N, 0f32, |i| if self.0[i] < other.0[i] { self.0[i] } else { other.0[i] }))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        ArrayF(each!(N, 0f32, |i| if self.0[i] > other.0[i] { self.0[i] } else { other.0[i] }))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::M {
        ArrayM(each!(N, false, |i| self.0[i] < other.0[i]))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::M {
        ArrayM(each!(N, false, |i| self.0[i] <= other.0[i]))
    }
    #[inline(always)]
    fn select(mask: Self::M, a: Self, b: Self) -> Self {
        ArrayF(each!(N, 0f32, |i| if mask.0[i] { a.0[i] } else { b.0[i] }))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        ArrayF(each!(N, 0f32, |i| f32::from_bits(self.0[i].to_bits() & 0x7fff_ffff)))
    }
    #[inline(always)]
    fn to_bits(self) -> Self::U {
        ArrayU(each!(N, 0, |i| self.0[i].to_bits()))
    }
    #[inline(always)]
    fn from_bits(bits: Self::U) -> Self {
        ArrayF(each!(N, 0f32, |i| f32::from_bits(bits.0[i])))
    }
    #[inline(always)]
    fn from_int(ints: Self::U) -> Self {
        ArrayF(each!(N, 0f32, |i| ints.0[i] as i32 as f32))
    }
    #[inline(always)]
    fn to_int(self) -> Self::U {
        ArrayU(each!(N, 0, |i| self.0[i] as i32 as u32))
    }
    #[inline(always)]
    fn gather(table: &[f32], index: Self::U) -> Self {
        ArrayF(each!(N, 0f32, |i| table[(index.0[i] as usize).min(table.len() - 1)]))
    }
    /// Without the instructions of the level that calls it, since one lane serves two of them: slower there, the same
    /// bits.
    #[inline(never)]
    fn apart<P: Part<Self>>(part: P) -> P::Out {
        part.run()
    }
    // With one lane nothing comes after it.
    #[allow(unused_assignments)]
    #[inline(always)]
    fn compress(self, mask: Self::M, to: &mut [f32]) {
        let mut next = 0;
        for_each!(N, |i| if mask.0[i] {
            to[next] = self.0[i];
            next += 1;
        });
    }
}
