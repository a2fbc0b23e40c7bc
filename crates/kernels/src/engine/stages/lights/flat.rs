//! Flat lights, parallelograms and triangles: a point on one, uniform in area, and its density.

use super::{LightHit, LightSample};
use crate::lanes::{Bits, Lanes};
use crate::math::V3;
use crate::scene::{LightTable, NONE};

/// Where a number of a row stands (see [`LightTable::FLAT`]).
const AREA: usize = 15;
const OFFSET: usize = 16;
const FLAGS: usize = 17;
/// Rays end before this part of the way: from afar the tree finds the light itself up to 16 units in the last place of
/// the way off (see `bvh::ray_space`), which its own coordinates say nothing of.
const SHORT: f32 = 1.0 - 1.0 / 524_288.0;

/// A light's row.
struct Row<F: Lanes> {
    corner: V3<F>,
    edges: [V3<F>; 2],
    normal: V3<F>,
    radiance: V3<F>,
    area: F,
    offset: F,
    flags: F::U,
}

impl<F: Lanes> Row<F> {
    #[inline(always)]
    fn load(lights: &LightTable, k: F::U) -> Self {
        let row = lights.flat.row::<F>(k);
        Row {
            corner: V3(row[0], row[1], row[2]),
            edges: [V3(row[3], row[4], row[5]), V3(row[6], row[7], row[8])],
            normal: V3(row[9], row[10], row[11]),
            radiance: V3(row[12], row[13], row[14]),
            area: row[AREA],
            offset: row[OFFSET],
            flags: row[FLAGS].to_bits(),
        }
    }

    #[inline(always)]
    fn has(&self, bit: u32) -> F::M {
        !(self.flags & F::U::splat(bit)).eq(F::U::splat(0))
    }

    /// The point of the light for two random numbers, uniform: of a triangle the half of the square beyond its long
    /// side is folded back.
    #[inline(always)]
    fn point(&self, u: F, v: F) -> V3<F> {
        let one = F::splat(1.0);
        let fold = self.has(LightTable::TRIANGLE) & one.lt(u + v);
        let (u, v) = (F::select(fold, one - u, u), F::select(fold, one - v, v));
        self.edges[0].mad(u, self.edges[1].mad(v, self.corner))
    }
}

/// A direction from `p` to a point of flat light `k`.
#[inline(always)]
pub fn sample<F: Lanes>(lights: &LightTable, k: F::U, p: V3<F>, u: F, v: F) -> LightSample<F> {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let row = Row::<F>::load(lights, k);
    let point = row.point(u, v);
    let front = zero.lt(p.sub(row.corner).dot(row.normal));
    // The ray ends a little before the light, so that the light itself is not in its way.
    let end = row.normal.mad(F::select(front, row.offset, -row.offset), point);
    let to = end.sub(p);
    let d2 = to.dot(to);
    let usable = zero.lt(d2);
    let distance = F::select(usable, d2, one).sqrt();
    let wi = to.scale(one / distance);
    let shines = usable & (front | row.has(LightTable::TWO_SIDED));
    LightSample {
        wi,
        distance: distance * c(SHORT),
        inverse_pdf: F::select(usable, row.area * wi.dot(row.normal).abs() / d2, zero),
        radiance: V3::select(shines, row.radiance, V3::zero()),
        primitive: F::U::splat(NONE),
    }
}

/// One over the density of [`sample`] in solid angle, of a direction that has met light `k`.
#[inline(always)]
pub fn inverse_pdf<F: Lanes>(lights: &LightTable, k: F::U, hit: &LightHit<F>) -> F {
    let area = lights.flat.column::<F>(k, AREA);
    area * hit.cos / (hit.distance * hit.distance)
}

/// Radiance of light `k` to the side from which it was met; `outside`: its front.
#[inline(always)]
pub fn radiance<F: Lanes>(lights: &LightTable, k: F::U, outside: F::M) -> V3<F> {
    let row = Row::<F>::load(lights, k);
    V3::select(outside | row.has(LightTable::TWO_SIDED), row.radiance, V3::zero())
}

#[cfg(test)]
mod tests {
    use super::super::{Receiver, Start, choose, pdf, radiance, sample};
    use super::*;
    use crate::lanes::ArrayF;
    use crate::scene::{FlatLight, Light};
    use glam::DVec3;
    use tracer_reference::Random;

    type S = ArrayF<1>;

    fn scalar(x: S) -> f64 {
        let mut out = [0.0];
        x.store(&mut out);
        f64::from(out[0])
    }

    fn point(v: V3<S>) -> DVec3 {
        DVec3::new(scalar(v.0), scalar(v.1), scalar(v.2))
    }

    fn lanes(v: DVec3) -> V3<S> {
        V3::splat(v.as_vec3().to_array())
    }

    /// The solid angle of a triangle (van Oosterom and Strackee 1983).
    fn solid_angle([a, b, c]: [DVec3; 3]) -> f64 {
        let [a, b, c] = [a, b, c].map(DVec3::normalize);
        let turn = a.dot(b.cross(c)).atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a));
        2.0 * turn.abs()
    }

    /// One over the density is on average the solid angle under which a light is seen; directions go to the light; the
    /// density of what they meet is the same; and only the front shines.
    #[test]
    fn samples_cover_the_light() {
        let mut random = Random::new(3);
        for k in 0..60 {
            let v = |random: &mut Random, size: f64| size * random.direction();
            let (corner, size) = (v(&mut random, 0.5), random.between(0.05, 1.0));
            let edges = [v(&mut random, size), v(&mut random, 0.7 * size)];
            let flat = FlatLight { corner, edges, radiance: [1.0, 2.0, 3.0], two_sided: k % 3 == 0, offset: 0.0 };
            if flat.edges[0].cross(flat.edges[1]).length() < 0.1 * size * size {
                continue;
            }
            let is_triangle = k % 2 == 0;
            let light = if is_triangle { Light::Triangle(flat) } else { Light::Parallelogram(flat) };
            let other = Light::Triangle(FlatLight { corner: corner + DVec3::splat(3.0), two_sided: true, ..flat });
            let table = LightTable::new(&[light, other], &[], None);
            let away = random.between(0.3, 2.0) * size;
            let p = corner + (edges[0] + edges[1]) * 0.3 + v(&mut random, away);
            let (mut sum, mut squares, mut taken) = (0.0, 0.0, 0.0);
            const SAMPLES: u32 = 20_000;
            let at = Receiver { p: lanes(p), n: lanes((corner - p).normalize()) };
            let in_front = (p - corner).dot(flat.normal()) > 0.0;
            for _ in 0..SAMPLES {
                let mut number = || S::splat((random.bits() >> 40) as f32 / 16_777_216.0);
                let choice = choose(&table, at, number(), number());
                let s = sample(&table, &choice, Start::free(at.p), number(), number(), S::first(1));
                let mut chosen = [9];
                choice.light.store(&mut chosen);
                if chosen[0] != 0 {
                    continue;
                }
                taken += 1.0;
                let inverse = scalar(s.inverse_pdf);
                (sum, squares) = (sum + inverse, squares + inverse * inverse);
                let (wi, distance) = (point(s.wi), scalar(s.distance));
                let on_light = p + distance * wi - corner;
                assert!((wi.length() - 1.0).abs() < 1e-6 && on_light.dot(flat.normal()).abs() < 1e-5);
                let across = edges[0].cross(edges[1]);
                let u = on_light.cross(edges[1]).dot(across) / across.length_squared();
                let v = edges[0].cross(on_light).dot(across) / across.length_squared();
                let limit = if is_triangle { 1.0 - u } else { 1.0 };
                assert!(u > -1e-4 && v > -1e-4 && u < 1.0001 && v < limit + 1e-4, "{u} {v}");
                let hit = LightHit {
                    direction: s.wi,
                    lanes: S::first(1),
                    distance: s.distance,
                    cos: S::splat(wi.dot(flat.normal()).abs() as f32),
                    front: S::first(usize::from(in_front)),
                };
                let product = inverse * scalar(pdf(&table, choice.light, at, &hit));
                assert!((product - 1.0).abs() < 1e-4, "{product}");
                let shines = point(s.radiance).length() > 0.0;
                assert_eq!(shines, in_front || flat.two_sided);
                assert_eq!(point(radiance(&table, choice.light, &hit)).length() > 0.0, shines);
            }
            if !in_front && !flat.two_sided {
                // Where the other one is below the horizon, both are as good as each other.
                let other_shows = (corner + DVec3::splat(3.0) - p).dot(corner - p) > 5.0 * size;
                assert!(!other_shows || taken == 0.0, "{k}: a light is asked from behind");
                continue;
            }
            let [a, b] = edges;
            let mut expected = solid_angle([corner - p, corner + a - p, corner + b - p]);
            if !is_triangle {
                expected += solid_angle([corner + a - p, corner + a + b - p, corner + b - p]);
            }
            // Over all samples, those of the other light counting zero; 1e-4 for densities in single precision.
            let n = f64::from(SAMPLES);
            let mean = sum / n;
            let error = ((squares / n - mean * mean) / n).sqrt();
            assert!((mean - expected).abs() < 4.5 * error + 1e-4 * expected, "{k}: {mean} +- {error}, not {expected}");
        }
    }
}
