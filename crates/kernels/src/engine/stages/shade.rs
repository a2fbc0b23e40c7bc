//! One vertex of every path: light that the ray met, light sampled from here, and the next ray.
//!
//! Direct light by multiple importance sampling (Veach 1997, power heuristic) of the light's solid angle and the
//! material's lobe. At the last vertex a diffuse surface casts no further ray, so there the light sample has weight
//! one; but where there is a background, which only a further ray finds.

mod emission;
mod light_sample;
mod mis;
mod scatter;
mod sharing;
mod vertex;

pub use mis::{power_heuristic, weight_of_ratio};
pub use vertex::{Ray, Vertex, has, leaves};

use super::cameras::View;
use super::materials::Bsdf;
use super::points::{PairPoints, PixelOf};
use crate::engine::batch::{Batch, Hits, Paths, path};
use crate::engine::pass::{Pass, Task};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::blocks::{Item, Pixels};
use crate::sampling::sampler::Purpose;
use crate::scene::Scene;
use scatter::Onward;

/// From this vertex on (0 = first hit) a path goes on with a probability that falls with its throughput. Earlier,
/// roulette throws away the stratification that the sampler pays for.
pub const ROULETTE_FROM: u32 = 3;

/// Paths that carry less than this when they are cut could show little: light that is caught in a glass ball.
const LEAST_CUT: f32 = 0.25;

/// Shades the hits of vertex `vertex`; the paths that go on are in `batch.paths` afterwards, their shadow rays in
/// `batch.shadows`. Where pixels share (`pass.reuse`, see [`super::share`]), their vertices are added to
/// `batch.members` and `batch.suffixes`.
#[inline(always)]
pub fn shade<F: Lanes>(scene: &Scene, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
    let stage = Stage::<F>::new(scene, pass, vertex, &batch.items);
    let (paths, hits) = (&*batch.paths, &*batch.hits);
    let (next, branches, shadows) = (&mut *batch.next, &mut *batch.branches, &mut *batch.shadows);
    let (members, suffixes, aimers) = (&mut *batch.members, &mut *batch.suffixes, &mut *batch.aimers);
    let radiance = &mut *batch.radiance;
    let glint_weight = Some(&batch.glint_weight).filter(|_| batch.glints != 0);
    (next.len, branches.len, shadows.len, aimers.len) = (0, 0, 0, 0);
    for i in (0..paths.len).step_by(F::N) {
        let ray = Ray::load(paths, hits, i);
        let aimed = stage.aimed(&ray);

        // Light that the ray met, by throughput: what lies beyond all surfaces, and lights.
        let shown = stage.shown(&ray, glint_weight);
        let mut seen = stage.beyond(&ray, aimed, paths, shown);
        if !ray.hit.any() {
            seen.add(radiance, ray.sum());
            continue;
        }
        let s = ray.surface(scene, hits);
        let lamp = ray.hit & !s.light.eq(F::U::splat(0));
        stage.emission((&ray, &s), (paths, hits), shown, lamp & !aimed, &mut seen);
        seen.add(radiance, ray.sum());
        let cut = stage.cut(&ray, ray.hit & !lamp);
        batch.counters.cut += u64::from(cut.count() as u32);
        let surfaces = stage.scattering(&ray, ray.hit & !lamp);
        if !surfaces.any() {
            continue;
        }

        // How the surface scatters, and for whom.
        let bsdf = Bsdf::met(scene, &s, surfaces, &hits.behind[..], i);
        let mut at = Vertex::new(ray, s, bsdf, surfaces);
        if pass.task == Task::Chains && !at.keep_specular() {
            continue;
        }
        stage.film(&mut at, paths, hits);
        stage.weigh_aimed(&mut at, aimed, paths);
        stage.leave_suffixes(&mut at, suffixes);

        // Light sampled from here, the lobe, roulette, and the next ray.
        let points = stage.points(&at, &batch.pixels);
        let goes_on = stage.goes_on(&at);
        stage.sample_light(&at, &points, at.bsdf.rough() & at.ray.valid, goes_on, shadows);
        let mut onward = stage.sample_bsdf(&at, &points, goes_on, branches);
        stage.change_of_film(&mut at, &onward);
        let sharing = stage.members(&at, &batch.item_shares);
        let survival = stage.roulette(&at, points.roulette.0, sharing, &mut onward);
        stage.join(&mut at, sharing, survival, members);
        stage.leave_aimers(&mut at, aimers);
        stage.go_on(&at, &onward, next);
    }
    // Behind all others, so that their order does not depend on the number of lanes.
    next.append(branches);
    std::mem::swap(&mut batch.paths, &mut batch.next);
    batch.counters.scattered_rays += batch.paths.len as u64;
    batch.counters.shadow_rays += batch.shadows.len as u64;
}

/// What is the same for all paths of a stage.
struct Stage<'a, F: Lanes> {
    scene: &'a Scene,
    pass: Pass<'a>,
    /// The number of the vertex.
    vertex: u32,
    /// Something is seen beyond all surfaces.
    open: bool,
    /// There is a choice of lights.
    several: bool,
    choices: PairPoints<F>,
    light_points: PairPoints<F>,
    directions: PairPoints<F>,
    roulettes: PairPoints<F>,
}

/// Points of the sampler at a vertex.
struct Points<F: Lanes> {
    /// Which light; zero where there is no choice.
    choice: (F, F),
    /// Where on it.
    on_light: (F, F),
    /// Where to from a rough surface.
    direction: (F, F),
    /// Whether the path goes on, and by which lobe; zero where neither is asked.
    roulette: (F, F),
}

impl<'a, F: Lanes> Stage<'a, F> {
    #[inline(always)]
    fn new(scene: &'a Scene, pass: Pass<'a>, vertex: u32, items: &[Item]) -> Self {
        // No closure: it would not be inlined, and be without the level's instructions.
        let seed = pass.seed;
        Stage {
            scene,
            pass,
            vertex,
            open: scene.is_under_sky(),
            several: scene.tables.lights.several(),
            choices: PairPoints::<F>::new(seed, Purpose::Choice(vertex), items),
            light_points: PairPoints::<F>::new(seed, Purpose::Light(vertex), items),
            directions: PairPoints::<F>::new(seed, Purpose::Direction(vertex), items),
            roulettes: PairPoints::<F>::new(seed, Purpose::Roulette(vertex), items),
        }
    }

    /// Lanes whose ray was aimed: what it finds other than mirrors, glass and glossy surfaces, its path's own ray
    /// finds.
    #[inline(always)]
    fn aimed(&self, ray: &Ray<F>) -> F::M {
        if self.pass.guide.is_some() { ray.valid & has(ray.slot, path::AIMED) } else { F::M::from_bits(0) }
    }

    /// Of lanes that hit a surface, those that came over mirrors and glass only, and see nothing there since they may
    /// scatter no more.
    #[inline(always)]
    fn cut(&self, ray: &Ray<F>, surfaces: F::M) -> F::M {
        if self.vertex <= self.scene.max_bounces || self.pass.task == Task::Chains {
            return F::M::from_bits(0);
        }
        let carried = ray.throughput.max_component() * ray.eta2;
        surfaces & !has(ray.slot, path::NOT_FOLLOWED) & F::splat(LEAST_CUT).lt(carried)
    }

    /// Of lanes that hit a surface those that it scatters.
    #[inline(always)]
    fn scattering(&self, ray: &Ray<F>, surfaces: F::M) -> F::M {
        if self.vertex > self.scene.max_bounces {
            // After the last scattering a ray is cast only to see the light that it meets.
            F::M::from_bits(0)
        } else if self.pass.task == Task::Direct {
            // What a rough surface has scattered sees lights only.
            surfaces & !has(ray.slot, path::OWN)
        } else {
            surfaces
        }
    }

    /// Lanes that a further ray is cast from: all but diffuse ones at the last vertex, where no background is to be
    /// seen.
    #[inline(always)]
    fn goes_on(&self, at: &Vertex<'_, F>) -> F::M {
        let is_last = self.vertex == self.scene.max_bounces || self.pass.task == Task::Direct;
        if is_last && !self.open { !at.bsdf.diffuse } else { at.ray.valid }
    }

    /// What light paths count by: see [`Paths::film`].
    #[inline(always)]
    fn film(&self, at: &mut Vertex<'_, F>, paths: &Paths, hits: &Hits) {
        if self.pass.light_paths.is_none() {
            return;
        }
        let zero = F::splat(0.0);
        let film = F::load(&paths.film[at.ray.first..]);
        at.film = if self.vertex == 0 {
            let view = View::new(&self.scene.camera, self.scene.size);
            let film = film * view.area_of(at.ray.direction, at.ray.distance(hits), &at.s);
            F::select(at.bsdf.has_one_color() & !at.s.smooth, film, zero)
        } else {
            F::select(at.bsdf.rough(), zero, film)
        };
    }

    /// The sampler's points that are asked for.
    #[inline(always)]
    fn points(&self, at: &Vertex<'_, F>, pixels: &Pixels) -> Points<F> {
        let zero = F::splat(0.0);
        let pixel = PixelOf::<F>::new(at.ray.slot, pixels);
        let [on_light, direction] = PairPoints::points_of([&self.light_points, &self.directions], &pixel);
        let lobes_or_end = at.bsdf.glossy.any() || at.bsdf.transparent.any() || self.vertex >= ROULETTE_FROM;
        let (mut choice, mut roulette) = ((zero, zero), (zero, zero));
        if self.several {
            [choice, roulette] = PairPoints::points_of([&self.choices, &self.roulettes], &pixel);
        } else if lobes_or_end {
            roulette = self.roulettes.points(&pixel);
        }
        Points { choice, on_light, direction, roulette }
    }

    /// Ends paths by a chance that falls with what they carry, and gives the chance that they go on. That one which
    /// shares goes on must not depend on where to: other pixels reckon with its density. Of aimed rays mirrors and
    /// glass end what they take themselves: such rays bring far more than the path carries (docs/noise.md).
    #[inline(always)]
    fn roulette(&self, at: &Vertex<'_, F>, chance: F, sharing: F::M, onward: &mut Onward<F>) -> F {
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        onward.carried = at.ray.throughput.mul(onward.weight);
        if self.vertex < ROULETTE_FROM {
            return one;
        }
        let whole = V3::select(sharing, at.colored(), onward.carried);
        let decides = V3::select(at.bsdf.specular() & has(at.ray.slot, path::SPARED), onward.weight, whole);
        let survival = decides.max_component().min(one);
        onward.alive = onward.alive & chance.lt(survival);
        onward.carried = onward.carried.scale(one / F::select(zero.lt(survival), survival, one));
        survival
    }

    /// Adds the rays that go on.
    #[inline(always)]
    fn go_on(&self, at: &Vertex<'_, F>, onward: &Onward<F>, next: &mut Paths) {
        let alive = onward.alive & F::splat(0.0).lt(onward.carried.max_component());
        let k = next.len;
        onward.start.compress(alive, &mut next.origin, k);
        onward.wi.compress(alive, &mut next.direction, k);
        onward.carried.compress(alive, &mut next.throughput, k);
        onward.eta2.compress(alive, &mut next.eta2[k..]);
        onward.pdf.compress(alive, &mut next.pdf[k..]);
        if self.several || self.pass.guide.is_some() {
            at.s.ns.compress(alive, &mut next.normal, k);
        }
        if self.pass.light_paths.is_some() {
            at.film.compress(alive, &mut next.film[k..]);
        }
        let [specular, not_spared] = [path::SPECULAR, !path::SPARED].map(F::U::splat);
        let slot = F::U::select(at.bsdf.specular(), at.ray.slot | specular, at.ray.slot & not_spared);
        slot.compress(alive, &mut next.slot[k..]);
        // Rays of mirrors and glass begin at the triangle, on the side that they go to.
        let left = F::U::select(at.bsdf.specular(), at.ray.primitive, at.leaves(onward.wi));
        left.compress(alive, &mut next.from_primitive[k..]);
        at.ray.instance.compress(alive, &mut next.from_instance[k..]);
        next.len += alive.count();
    }
}
