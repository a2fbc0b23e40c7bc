//! What paths see over mirrors and through glass, for the layers that are of it ([`Pixel::Seen`]): a kernel of its own,
//! run before each vertex is shaded where there are any.
//!
//! Of paths that have met mirrors and glass only, those whose ray meets anything else add it to their sample, by what
//! they carry: the colours of mirrors and glass, shares at glass where a path goes both ways, and what roulette has
//! spared them for. So the mean over the samples is that of all ways that light takes, as it is of the picture.
//!
//! [`Pixel::Seen`]: crate::layers::Pixel::Seen

use super::lights::{self, LightHit, Receiver};
use super::materials::Bsdf;
use super::shade::{Ray, has, power_heuristic};
use crate::engine::batch::{Batch, path};
use crate::lanes::{Bits, Lanes, Mask};
use crate::layers::{LayerSet, Seen, seen_at};
use crate::math::V3;
use crate::scene::{Integrator, Scene};

/// Lanes of the widest registers.
const MOST_LANES: usize = 16;

/// Adds to `batch.layers` what the rays in `batch.paths` have hit, for these layers; `vertex`: 0 for camera rays.
#[inline(always)]
pub fn seen<F: Lanes>(scene: &Scene, layers: LayerSet, vertex: u32, batch: &mut Batch) {
    let (paths, hits, samples) = (&*batch.paths, &*batch.hits, &mut batch.layers);
    // All surfaces look alike to it.
    let follows = !matches!(scene.integrator, Integrator::AmbientOcclusion { .. });
    for i in (0..paths.len).step_by(F::N) {
        let ray = Ray::<F>::load(paths, hits, i);
        let chains = ray.valid & !has(ray.slot, path::NOT_FOLLOWED);
        if !chains.any() {
            continue;
        }
        let s = ray.surface(scene, hits);
        let hit = chains & ray.hit;
        let lamps = hit & !s.light.eq(F::U::splat(0));
        let bsdf = Bsdf::at(scene, &s, hit & !lamps);
        let shown = if follows { bsdf.specular() } else { F::M::from_bits(0) };
        let of = Seen {
            straight: vertex == 0,
            surfaces: hit & !lamps & !shown,
            lamps,
            beyond: chains & !ray.hit,
            weight: ray.throughput.scale(ray.eta2),
            color: bsdf.color,
            normal: s.ns,
        };
        let (slots, bits) = (&paths.slot[i..], (of.surfaces | of.lamps | of.beyond).bits());
        for (first, layer, channels) in layers.seen() {
            for (channel, value) in (0..channels).zip(seen_at(layer, &of)) {
                let mut of_lane = [0.0; MOST_LANES];
                value.store(&mut of_lane);
                let column = &mut samples.sums[first + channel];
                for lane in (0..F::N).filter(|lane| bits >> lane & 1 == 1) {
                    column[(slots[lane] & path::SLOT) as usize] += of_lane[lane];
                }
            }
        }
    }
}

/// Rays that leave what the camera sees with at least this density are those of what is nearly a mirror: metals as
/// rough as 0.25.
const SHARP: f32 = 20.0;
/// And they count at least so much beside light samples: where these are far better little of the noise is the rays'.
/// With 100 and 0.9 metals of 0.1 to 0.2 had 1.3 to 5.5 times the error of denoised pictures (fifteen small lamps over
/// a ball, 16 samples, two seeds each, without the worst thousandth), with 5 and 0.1 0.77 to 1.04 times.
const OWN_WEIGHT: f32 = 0.3;

/// Adds to `batch.layers.lamps` what the rays in `batch.paths` add of lamps to their samples, of paths that have met
/// mirrors and glass only, or nothing yet: what `shade` adds of it, to the last bit but for the order of the sum. No
/// other way finds that light, so it counts whole, or by the weight that glint chains and paths have of it. And what
/// lamps show in surfaces that the camera sees and that are nearly mirrors, as far as rays by chance find it.
#[inline(always)]
pub fn lamps<F: Lanes>(scene: &Scene, vertex: u32, batch: &mut Batch) {
    let (paths, hits, weights) = (&*batch.paths, &*batch.hits, &batch.glint_weight);
    let tables = &scene.tables.lights;
    for i in (0..paths.len).step_by(F::N) {
        let ray = Ray::<F>::load(paths, hits, i);
        let chains = ray.hit & !has(ray.slot, path::NOT_FOLLOWED);
        let mut sharp = F::M::from_bits(0);
        if vertex == 1 {
            let is_rough = !has(ray.slot, path::SPECULAR | path::AIMED | path::SHARED);
            sharp = ray.hit & is_rough & F::splat(SHARP).le(F::load(&paths.pdf[i..]));
        }
        if !(chains | sharp).any() {
            continue;
        }
        let s = ray.surface(scene, hits);
        let mut lanes = (chains | sharp) & !s.light.eq(F::U::splat(0));
        if !lanes.any() {
            continue;
        }
        let light = F::U::select(lanes, s.light - F::U::splat(1), F::U::splat(0));
        let cos = ray.direction.dot(s.ng).abs();
        let met = LightHit { direction: ray.direction, distance: ray.distance(hits), cos, front: s.outside, lanes };
        let mut weight = F::gather(weights, ray.item());
        sharp = sharp & !chains & lanes;
        if sharp.any() {
            // As `shade` weighs it.
            let normal = if tables.several() { V3::<F>::load(&paths.normal, i) } else { V3::grey(F::splat(0.0)) };
            let sampled = lights::pdf(tables, light, Receiver { p: ray.origin, n: normal }, &met);
            let own = power_heuristic(F::load(&paths.pdf[i..]), sampled);
            lanes = lanes & !(sharp & own.lt(F::splat(OWN_WEIGHT)));
            weight = F::select(sharp, own, weight);
        }
        let shown = ray.eta2 * weight;
        let mut shines = lights::radiance(tables, light, &met).mul(ray.throughput).scale(shown);
        if tables.glow.is_some() {
            shines = shines.mul(lights::share_at(scene, &s, lanes));
        }
        let mut of_lanes = [[0.0; MOST_LANES]; 3];
        shines.0.store(&mut of_lanes[0]);
        shines.1.store(&mut of_lanes[1]);
        shines.2.store(&mut of_lanes[2]);
        let (slots, bits) = (&paths.slot[i..], lanes.bits());
        for lane in (0..F::N).filter(|lane| bits >> lane & 1 == 1) {
            let sum = &mut batch.layers.lamps[(slots[lane] & path::SLOT) as usize];
            (0..3).for_each(|c| sum[c] += of_lanes[c][lane]);
        }
    }
}
