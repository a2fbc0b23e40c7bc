//! Two vectors as one of twice the lanes: more independent work in flight, for stages whose chains of operations are
//! longer than what the processor looks ahead.

use super::{Bits, Lanes, Mask, Part};
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// The lanes of the first, then those of the second: of floats, of integers or of truth values.
#[derive(Clone, Copy)]
pub struct Pair<A>(A, A);

macro_rules! binary {
    ($($Trait:ident $f:ident),*) => {$(
        impl<A: $Trait<Output = A>> $Trait for Pair<A> {
            type Output = Self;
            #[inline(always)]
            fn $f(self, other: Self) -> Self {
                Pair(self.0.$f(other.0), self.1.$f(other.1))
            }
        }
    )*};
}
binary!(Add add, Sub sub, Mul mul, Div div, BitXor bitxor, BitAnd bitand, BitOr bitor);

macro_rules! unary {
    ($($Trait:ident $f:ident),*) => {$(
        impl<A: $Trait<Output = A>> $Trait for Pair<A> {
            type Output = Self;
            #[inline(always)]
            fn $f(self) -> Self {
                Pair(self.0.$f(), self.1.$f())
            }
        }
    )*};
}
unary!(Neg neg, Not not);

impl<M: Mask> Mask for Pair<M> {
    const N: usize = 2 * M::N;
    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.bits() | self.1.bits() << M::N
    }
    #[inline(always)]
    fn from_bits(bits: u32) -> Self {
        Pair(M::from_bits(bits & ((1 << M::N) - 1)), M::from_bits(bits >> M::N))
    }
    #[inline(always)]
    fn any(self) -> bool {
        (self.0 | self.1).any()
    }
}

impl<U: Bits> Bits for Pair<U> {
    type M = Pair<U::M>;
    #[inline(always)]
    fn splat(x: u32) -> Self {
        Pair(U::splat(x), U::splat(x))
    }
    #[inline(always)]
    fn load(from: &[u32]) -> Self {
        Pair(U::load(from), U::load(&from[U::M::N..]))
    }
    #[inline(always)]
    fn store(self, to: &mut [u32]) {
        self.0.store(to);
        self.1.store(&mut to[U::M::N..]);
    }
    #[inline(always)]
    fn shr<const K: u32>(self) -> Self {
        Pair(self.0.shr::<K>(), self.1.shr::<K>())
    }
    #[inline(always)]
    fn shl<const K: u32>(self) -> Self {
        Pair(self.0.shl::<K>(), self.1.shl::<K>())
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Self::M {
        Pair(self.0.eq(other.0), self.1.eq(other.1))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::M {
        Pair(self.0.lt(other.0), self.1.lt(other.1))
    }
    #[inline(always)]
    fn select(mask: Self::M, a: Self, b: Self) -> Self {
        Pair(U::select(mask.0, a.0, b.0), U::select(mask.1, a.1, b.1))
    }
    #[inline(always)]
    fn gather(table: &[u32], index: Self) -> Self {
        Pair(U::gather(table, index.0), U::gather(table, index.1))
    }
    #[inline(always)]
    fn reverse_bits(self) -> Self {
        Pair(self.0.reverse_bits(), self.1.reverse_bits())
    }
    #[inline(always)]
    fn compress(self, mask: Self::M, to: &mut [u32]) {
        self.0.compress(mask.0, to);
        self.1.compress(mask.1, &mut to[mask.0.count()..]);
    }
}

impl<F: Lanes> Lanes for Pair<F> {
    const N: usize = 2 * F::N;
    type M = Pair<F::M>;
    type U = Pair<F::U>;
    #[inline(always)]
    fn splat(x: f32) -> Self {
        Pair(F::splat(x), F::splat(x))
    }
    #[inline(always)]
    fn load(from: &[f32]) -> Self {
        Pair(F::load(from), F::load(&from[F::N..]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.0.store(to);
        self.1.store(&mut to[F::N..]);
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Pair(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        Pair(self.0.fma(b.0, c.0), self.1.fma(b.1, c.1))
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        Pair(self.0.fnma(b.0, c.0), self.1.fnma(b.1, c.1))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Pair(self.0.min(other.0), self.1.min(other.1))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Pair(self.0.max(other.0), self.1.max(other.1))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::M {
        Pair(self.0.lt(other.0), self.1.lt(other.1))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::M {
        Pair(self.0.le(other.0), self.1.le(other.1))
    }
    #[inline(always)]
    fn select(mask: Self::M, a: Self, b: Self) -> Self {
        Pair(F::select(mask.0, a.0, b.0), F::select(mask.1, a.1, b.1))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Pair(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn to_bits(self) -> Self::U {
        Pair(self.0.to_bits(), self.1.to_bits())
    }
    #[inline(always)]
    fn from_bits(bits: Self::U) -> Self {
        Pair(F::from_bits(bits.0), F::from_bits(bits.1))
    }
    #[inline(always)]
    fn from_int(ints: Self::U) -> Self {
        Pair(F::from_int(ints.0), F::from_int(ints.1))
    }
    #[inline(always)]
    fn to_int(self) -> Self::U {
        Pair(self.0.to_int(), self.1.to_int())
    }
    #[inline(always)]
    fn gather(table: &[f32], index: Self::U) -> Self {
        Pair(F::gather(table, index.0), F::gather(table, index.1))
    }
    /// In place: its features are not known here, and no stage of pairs has parts.
    #[inline(always)]
    fn apart<P: Part<Self>>(part: P) -> P::Out {
        part.run()
    }
    #[inline(always)]
    fn compress(self, mask: Self::M, to: &mut [f32]) {
        self.0.compress(mask.0, to);
        self.1.compress(mask.1, &mut to[mask.0.count()..]);
    }
}
