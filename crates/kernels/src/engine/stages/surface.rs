//! What is known of a surface at a hit: point, normals, texture coordinates, material.

use crate::lanes::{Bits, Lanes};
use crate::math::V3;

/// The surface at a hit.
#[derive(Clone, Copy)]
pub struct Surface<F: Lanes> {
    /// The point, on the surface to a few ulp.
    pub p: V3<F>,
    /// Where rays of diffuse and glossy scattering start: on low-poly smooth meshes a point of the smooth surface that
    /// the triangle stands for (Hanika: Hacking the Shadow Terminator, Ray Tracing Gems II, 2021), else `p`; offset by
    /// `offset`.
    pub start: V3<F>,
    /// Geometric normal, unit, on the side the ray came from.
    pub ng: V3<F>,
    /// Shading normal, unit, on the same side.
    pub ns: V3<F>,
    /// The ray came from outside.
    pub outside: F::M,
    /// Interpolated normals: `ns` may differ from `ng`.
    pub smooth: F::M,
    /// Bound of the error of `p` along `ng`; zero on curved shapes, whose rays know the one that they leave, unless
    /// they lie in one plane with others.
    pub offset: F,
    /// Texture coordinates: u to the right, v upwards.
    pub u: F,
    /// See `u`.
    pub v: F,
    /// Material.
    pub material: F::U,
    /// Light + 1, or 0.
    pub light: F::U,
    /// What it is of: the number of the sphere, behind the spheres that of the shape, behind those that of the
    /// instance, behind those that of a solid's operand.
    pub body: F::U,
    /// The primitive that was hit.
    pub primitive: F::U,
}

impl<F: Lanes> Surface<F> {
    /// Lanes that start above their triangle by more than rounding: where a smooth mesh bulges towards the viewer.
    #[inline(always)]
    pub fn raised(&self) -> F::M {
        self.smooth & (self.offset + self.offset).lt(self.start.sub(self.p).dot(self.ng))
    }

    /// Lanes where `wi`, though above the shading normal's horizon, leads into the triangle at once: where a smooth
    /// mesh is hollow. What lies there is behind a wall.
    #[inline(always)]
    pub fn buries(&self, wi: V3<F>) -> F::M {
        self.smooth & wi.dot(self.ng).le(F::splat(0.0)) & !self.raised()
    }

    /// The first where it is picked, else the second, whose primitive it is in both.
    #[inline(always)]
    pub fn select(pick: F::M, m: Self, s: Self) -> Self {
        Surface {
            p: V3::select(pick, m.p, s.p),
            start: V3::select(pick, m.start, s.start),
            ng: V3::select(pick, m.ng, s.ng),
            ns: V3::select(pick, m.ns, s.ns),
            outside: (m.outside & pick) | (s.outside & !pick),
            smooth: (m.smooth & pick) | (s.smooth & !pick),
            offset: F::select(pick, m.offset, s.offset),
            u: F::select(pick, m.u, s.u),
            v: F::select(pick, m.v, s.v),
            material: F::U::select(pick, m.material, s.material),
            light: F::U::select(pick, m.light, s.light),
            body: F::U::select(pick, m.body, s.body),
            primitive: s.primitive,
        }
    }
}
