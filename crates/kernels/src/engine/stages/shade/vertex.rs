//! What a vertex of a path is while it is shaded.

use crate::engine::batch::{Hits, Paths, path};
use crate::engine::stages::materials::Bsdf;
use crate::engine::stages::surface::Surface;
use crate::engine::stages::surface_at::surface_at;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{NONE, Scene};

/// Lanes with this bit of [`path`].
#[inline(always)]
pub fn has<U: Bits>(slot: U, bit: u32) -> U::M {
    !(slot & U::splat(bit)).eq(U::splat(0))
}

/// The rays of a vector of paths, what they carry, and what they hit.
#[derive(Clone, Copy)]
pub struct Ray<F: Lanes> {
    /// The first of them among the batch's paths.
    pub first: usize,
    /// Lanes that have one.
    pub valid: F::M,
    /// Lanes that hit something.
    pub hit: F::M,
    /// See [`Paths::origin`].
    pub origin: V3<F>,
    /// See [`Paths::direction`].
    pub direction: V3<F>,
    /// See [`Paths::throughput`].
    pub throughput: V3<F>,
    /// See [`Paths::eta2`].
    pub eta2: F,
    /// See [`Paths::slot`].
    pub slot: F::U,
    /// What it hit.
    pub primitive: F::U,
    /// Its instance.
    pub instance: F::U,
}

impl<F: Lanes> Ray<F> {
    /// Those from this place on.
    #[inline(always)]
    pub fn load(paths: &Paths, hits: &Hits, first: usize) -> Self {
        let valid = F::first(paths.len - first);
        let primitive = F::U::load(&hits.primitive[first..]);
        Ray {
            first,
            valid,
            hit: valid & !primitive.eq(F::U::splat(NONE)),
            origin: V3::load(&paths.origin, first),
            direction: V3::load(&paths.direction, first),
            throughput: V3::load(&paths.throughput, first),
            eta2: F::load(&paths.eta2[first..]),
            slot: F::U::load(&paths.slot[first..]),
            primitive,
            instance: F::U::load(&hits.instance[first..]),
        }
    }

    /// The number of the sum that the paths' light goes to.
    #[inline(always)]
    pub fn sum(&self) -> F::U {
        self.slot & F::U::splat(path::SUM)
    }

    /// The items of the paths.
    #[inline(always)]
    pub fn item(&self) -> F::U {
        (self.slot & F::U::splat(path::SLOT)).shr::<6>()
    }

    /// Distances to what they hit.
    #[inline(always)]
    pub fn distance(&self, hits: &Hits) -> F {
        F::load(&hits.t[self.first..])
    }

    /// The surfaces that they hit.
    #[inline(always)]
    pub fn surface(&self, scene: &Scene, hits: &Hits) -> Surface<F> {
        let Ray { origin, direction, primitive, instance, hit, .. } = *self;
        surface_at(scene, origin, direction, self.distance(hits), primitive, instance, hit)
    }
}

/// A vertex: the rays that have come here, the surface and how it scatters.
pub struct Vertex<'t, F: Lanes> {
    /// The rays; what they carry is what they bring here.
    pub ray: Ray<F>,
    /// The surface.
    pub s: Surface<F>,
    /// How it scatters.
    pub bsdf: Bsdf<'t, F>,
    /// Towards where the ray came from.
    pub wo: V3<F>,
    /// Lanes that scatter.
    pub surfaces: F::M,
    /// See [`Paths::film`].
    pub film: F,
}

impl<'t, F: Lanes> Vertex<'t, F> {
    /// Where rays have come to.
    #[inline(always)]
    pub fn new(mut ray: Ray<F>, s: Surface<F>, bsdf: Bsdf<'t, F>, surfaces: F::M) -> Self {
        // What it was is of no use any more.
        ray.slot = ray.slot & F::U::splat(!path::SPECULAR);
        Vertex { ray, s, bsdf, wo: ray.direction.neg(), surfaces, film: F::splat(0.0) }
    }

    /// Leaves the specular lobes alone; whether any lane has one.
    #[inline(always)]
    pub fn keep_specular(&mut self) -> bool {
        self.surfaces = self.surfaces & self.bsdf.specular();
        self.bsdf.keep_specular();
        self.surfaces.any()
    }

    /// What a diffuse or glossy surface sends on of light that arrives, without its f.
    #[inline(always)]
    pub fn colored(&self) -> V3<F> {
        self.ray.throughput.mul(self.bsdf.color)
    }

    /// The primitive that a ray from here along `wi` must not meet: the one it leaves.
    #[inline(always)]
    pub fn leaves(&self, wi: V3<F>) -> F::U {
        leaves(&self.s, wi, self.ray.primitive)
    }
}

/// The primitive that a ray from this surface's start, which it does not bury, must not meet: the one it leaves. A ray
/// that sinks below a smooth triangle starts above it (Hanika) and may well meet it.
#[inline(always)]
pub fn leaves<F: Lanes>(s: &Surface<F>, wi: V3<F>, primitive: F::U) -> F::U {
    let sinks = s.smooth & wi.dot(s.ng).le(F::splat(0.0));
    F::U::select(sinks, F::U::splat(NONE), primitive)
}
