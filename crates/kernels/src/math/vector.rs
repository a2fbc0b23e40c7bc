//! Three-component vectors over lanes.

use crate::lanes::{Bits, Lanes};

/// A point, direction or colour per lane.
#[derive(Clone, Copy)]
pub struct V3<F>(pub F, pub F, pub F);

impl<F: Lanes> V3<F> {
    /// The same vector in all lanes.
    #[inline(always)]
    pub fn splat(v: [f32; 3]) -> Self {
        V3(F::splat(v[0]), F::splat(v[1]), F::splat(v[2]))
    }
    /// Zero.
    #[inline(always)]
    pub fn zero() -> Self {
        V3(F::splat(0.0), F::splat(0.0), F::splat(0.0))
    }
    /// The same number in all components.
    #[inline(always)]
    pub fn grey(x: F) -> Self {
        V3(x, x, x)
    }
    /// Sum.
    #[inline(always)]
    #[allow(clippy::should_implement_trait)]
    pub fn add(self, o: Self) -> Self {
        V3(self.0 + o.0, self.1 + o.1, self.2 + o.2)
    }
    /// Difference.
    #[inline(always)]
    #[allow(clippy::should_implement_trait)]
    pub fn sub(self, o: Self) -> Self {
        V3(self.0 - o.0, self.1 - o.1, self.2 - o.2)
    }
    /// Product, component by component.
    #[inline(always)]
    #[allow(clippy::should_implement_trait)]
    pub fn mul(self, o: Self) -> Self {
        V3(self.0 * o.0, self.1 * o.1, self.2 * o.2)
    }
    /// Product with a number.
    #[inline(always)]
    pub fn scale(self, s: F) -> Self {
        V3(self.0 * s, self.1 * s, self.2 * s)
    }
    /// self * s + o, one rounding per component.
    #[inline(always)]
    pub fn mad(self, s: F, o: Self) -> Self {
        V3(self.0.fma(s, o.0), self.1.fma(s, o.1), self.2.fma(s, o.2))
    }
    /// Inner product: fma(z, fma(y, x)).
    #[inline(always)]
    pub fn dot(self, o: Self) -> F {
        self.2.fma(o.2, self.1.fma(o.1, self.0 * o.0))
    }
    /// Cross product; each component is fma(a, b, -(c * d)).
    #[inline(always)]
    pub fn cross(self, o: Self) -> Self {
        V3(self.1.fma(o.2, -(self.2 * o.1)), self.2.fma(o.0, -(self.0 * o.2)), self.0.fma(o.1, -(self.1 * o.0)))
    }
    /// Negative.
    #[inline(always)]
    #[allow(clippy::should_implement_trait)]
    pub fn neg(self) -> Self {
        V3(-self.0, -self.1, -self.2)
    }
    /// Lane by lane `mask ? a : b`.
    #[inline(always)]
    pub fn select(mask: F::M, a: Self, b: Self) -> Self {
        V3(F::select(mask, a.0, b.0), F::select(mask, a.1, b.1), F::select(mask, a.2, b.2))
    }
    /// To length one.
    #[inline(always)]
    pub fn normalise(self) -> Self {
        self.scale(F::splat(1.0) / self.dot(self).sqrt())
    }
    /// The largest component.
    #[inline(always)]
    pub fn max_component(self) -> F {
        self.0.max(self.1).max(self.2)
    }
    /// Absolute values.
    #[inline(always)]
    pub fn abs(self) -> Self {
        V3(self.0.abs(), self.1.abs(), self.2.abs())
    }
    /// From entry `index` of a table of triples.
    #[inline(always)]
    pub fn gather(table: &[f32], index: F::U) -> Self {
        Self::gather_at(table, index * F::U::splat(3))
    }
    /// From three consecutive entries of a table, the first at `place`.
    #[inline(always)]
    pub fn gather_at(table: &[f32], place: F::U) -> Self {
        let [x, y, z] = F::gather3(table, place);
        V3(x, y, z)
    }
    /// Two unit vectors that make a right-handed frame (t, b, self) with this unit vector. Duff, Burgess, Christensen,
    /// Hery, Kensler, Liani, Villemin: Building an Orthonormal Basis, Revisited (JCGT 2017).
    #[inline(always)]
    pub fn basis(self) -> (Self, Self) {
        let one = F::splat(1.0);
        let sign = F::from_bits((self.2.to_bits() & F::U::splat(0x8000_0000)) | one.to_bits());
        let a = F::splat(-1.0) / (sign + self.2);
        let b = self.0 * self.1 * a;
        (
            V3((sign * self.0 * self.0).fma(a, one), sign * b, -(sign * self.0)),
            V3(b, (self.1 * self.1).fma(a, sign), -self.1),
        )
    }
    /// x t + y b + z self, with (t, b) from [`V3::basis`].
    #[inline(always)]
    pub fn to_world(self, local: Self) -> Self {
        let (t, b) = self.basis();
        t.mad(local.0, b.mad(local.1, self.scale(local.2)))
    }
}
