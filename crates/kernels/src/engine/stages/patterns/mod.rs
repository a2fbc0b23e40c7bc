//! Textures that are reckoned, over lanes: from a surface to the pattern's coordinates, from there to t by one file a
//! pattern, and to mix(a, b, t).

mod checkerboard;
mod dots;
mod gradient;
mod lines;
mod marble;
mod noise;
mod program;
mod vertex_color;
mod voronoi;
mod wood;

use super::surface::Surface;
use super::textures::floor;
use crate::lanes::{Bits, Lanes, Mask, Part};
use crate::math::{V3, acos, atan2_turns};
use crate::scene::{PatternTable, STRIDE, Scene, pattern_kind as kind};

/// The colour of pattern `id`, or of a program numbered behind the patterns, at a place with its shading normal, in the
/// lanes of the mask; anything elsewhere. A call, since all stages that meet materials look up their colours.
#[inline(always)]
pub fn pattern_color<F: Lanes>(scene: &Scene, id: F::U, at: At<F>, normal: V3<F>, mask: F::M) -> V3<F> {
    let table = &scene.tables.patterns;
    if table.programs.is_empty() {
        return F::apart(Lookup { table, id, at, mask });
    }
    F::apart(program::Mixed { scene, id, at, normal, mask })
}

/// 0.2126 R + 0.7152 G + 0.0722 B, of greys the very number.
#[inline(always)]
pub fn luminance<F: Lanes>(c: V3<F>) -> F {
    F::splat(0.0722).fma(c.2 - c.1, F::splat(0.2126).fma(c.0 - c.1, c.1))
}

/// Where a surface is met. A copy of what parts need: were they handed the surface, it would lie in memory everywhere.
#[derive(Clone, Copy)]
pub struct At<F: Lanes> {
    p: V3<F>,
    u: F,
    v: F,
    body: F::U,
    primitive: F::U,
}

impl<F: Lanes> At<F> {
    /// Of a surface.
    #[inline(always)]
    pub fn of(s: &Surface<F>) -> Self {
        At { p: s.p, u: s.u, v: s.v, body: s.body, primitive: s.primitive }
    }

    /// Texture coordinates.
    #[inline(always)]
    pub fn uv(&self) -> [F; 2] {
        [self.u, self.v]
    }
}

/// What is looked up.
struct Lookup<'t, F: Lanes> {
    table: &'t PatternTable,
    id: F::U,
    at: At<F>,
    mask: F::M,
}

impl<F: Lanes> Part<F> for Lookup<'_, F> {
    type Out = V3<F>;
    #[inline(always)]
    fn run(self) -> V3<F> {
        color(self.table, self.id, &self.at, self.mask)
    }
}

#[inline(always)]
fn color<F: Lanes>(table: &PatternTable, id: F::U, s: &At<F>, mask: F::M) -> V3<F> {
    let id = F::U::select(mask, id, F::U::splat(0));
    let place = id * F::U::splat(STRIDE);
    let kind = F::U::gather(&table.kind, id);
    let p = coordinates(table, id, place, s, mask);
    let shape = V3::<F>::gather_at(&table.rows, place + F::U::splat(21));
    let mut t = F::splat(0.0);
    let on = of_kind::<F>(table, kind, kind::CHECKERBOARD, mask);
    if on.any() {
        let beside = At { p: s.p.scale(F::splat(1.0 + checkerboard::MOVED)), ..*s };
        t = F::select(on, checkerboard::t(p, coordinates(table, id, place, &beside, on)), t);
    }
    let on = of_kind::<F>(table, kind, kind::LINES, mask);
    if on.any() {
        t = F::select(on, lines::t(p, shape), t);
    }
    let on = of_kind::<F>(table, kind, kind::DOTS, mask);
    if on.any() {
        t = F::select(on, dots::t(p, shape.0), t);
    }
    let on = of_kind::<F>(table, kind, kind::GRADIENT, mask);
    if on.any() {
        t = F::select(on, gradient::along(p, shape), t);
    }
    let on = of_kind::<F>(table, kind, kind::RADIAL, mask);
    if on.any() {
        t = F::select(on, gradient::radial(p), t);
    }
    let on = of_kind::<F>(table, kind, kind::VORONOI, mask);
    if on.any() {
        t = F::select(on, voronoi::t(p, shape.0, shape.1, on), t);
    }
    if table.kinds & kind::NOISY != 0 {
        let fbm = of_kind::<F>(table, kind, kind::FBM, mask);
        let turbulence = of_kind::<F>(table, kind, kind::TURBULENCE, mask);
        let wood = of_kind::<F>(table, kind, kind::WOOD, mask);
        let marble = of_kind::<F>(table, kind, kind::MARBLE, mask);
        let noisy = fbm | turbulence | wood | marble;
        if noisy.any() {
            let octaves = V3::<F>::gather_at(&table.rows, place + F::U::splat(18));
            let sum = noise::octaves(p, octaves, turbulence | marble, noisy);
            t = F::select(fbm, sum.fma(F::splat(0.5), F::splat(0.5)), t);
            t = F::select(turbulence, sum, t);
            if (wood | marble).any() {
                let distortion = F::gather(&table.rows, place + F::U::splat(26));
                t = F::select(wood, wood::t(p, shape, distortion, sum), t);
                t = F::select(marble, marble::t(p, shape, distortion, sum), t);
            }
        }
    }
    let a = V3::<F>::gather_at(&table.rows, place + F::U::splat(12));
    let b = V3::<F>::gather_at(&table.rows, place + F::U::splat(15));
    b.sub(a).mad(t, a)
}

/// The lanes that have a kind of pattern.
#[inline(always)]
fn of_kind<F: Lanes>(table: &PatternTable, kind: F::U, k: u32, mask: F::M) -> F::M {
    if table.kinds >> k & 1 == 1 { mask & kind.eq(F::U::splat(k)) } else { F::M::from_bits(0) }
}

/// The point in the patterns' coordinates.
#[inline(always)]
fn coordinates<F: Lanes>(table: &PatternTable, id: F::U, place: F::U, s: &At<F>, mask: F::M) -> V3<F> {
    let mut p = V3(s.u, s.v, F::splat(0.0));
    if table.solid {
        let space = F::U::gather(&table.space, id);
        let solid = mask & !space.eq(F::U::splat(0));
        let of_object = solid & !space.eq(F::U::splat(2));
        let world = F::U::splat(0);
        let entry = F::U::gather(&table.entry, F::U::select(of_object, s.body, world));
        let entry = F::U::select(of_object, entry, world);
        p = V3::select(solid, mapped(&table.to_object, entry * F::U::splat(12), s.p), p);
    }
    let mut p = mapped(&table.rows, place, p);
    if table.spherical {
        let on = mask & F::U::gather(&table.space, id).eq(F::U::splat(3));
        let [u, v] = F::gather2(&table.rows, place + F::U::splat(24));
        let (longitude, latitude) = on_sphere(p);
        p = V3::select(on, V3(longitude * u, latitude * v, F::splat(0.0)), p);
    }
    V3(bounded(p.0), bounded(p.1), bounded(p.2))
}

/// Longitude and latitude of a direction, from 0 to 1, as spheres have them about their y axis.
#[inline(always)]
fn on_sphere<F: Lanes>(p: V3<F>) -> (F, F) {
    let (zero, half) = (F::splat(0.0), F::splat(0.5));
    let length = p.dot(p).sqrt();
    let usable = zero.lt(length);
    let sine = F::select(usable, p.1 / F::select(usable, length, F::splat(1.0)), zero);
    let latitude = acos(sine.max(F::splat(-1.0)).min(F::splat(1.0)));
    (atan2_turns(p.0, p.2) + half, latitude.fma(F::splat(-std::f32::consts::FRAC_1_PI), F::splat(1.0)))
}

/// Within what has a fraction worth the name; what is no number becomes one.
#[inline(always)]
fn bounded<F: Lanes>(x: F) -> F {
    x.max(F::splat(-4_194_304.0)).min(F::splat(4_194_304.0))
}

/// The whole part, modulo 2^22 and not below 0.
#[inline(always)]
fn whole<F: Lanes>(x: F) -> F::U {
    (floor(x) + F::splat(4_194_304.0)).to_int()
}

/// A point by the three rows of a matrix that begin at `place`.
#[inline(always)]
fn mapped<F: Lanes>(rows: &[f32], place: F::U, p: V3<F>) -> V3<F> {
    let four = F::U::splat(4);
    let [ax, ay, az, x] = F::gather4(rows, place);
    let [bx, by, bz, y] = F::gather4(rows, place + four);
    let [cx, cy, cz, z] = F::gather4(rows, place + four + four);
    V3(
        az.fma(p.2, ay.fma(p.1, ax.fma(p.0, x))),
        bz.fma(p.2, by.fma(p.1, bx.fma(p.0, y))),
        cz.fma(p.2, cy.fma(p.1, cx.fma(p.0, z))),
    )
}
