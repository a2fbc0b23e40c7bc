//! What paths see over mirrors and through glass, for the layers that are of it ([`Pixel::Seen`]): a kernel of its own,
//! run before each vertex is shaded where there are any.
//!
//! Of paths that have met mirrors and glass only, those whose ray meets anything else add it to their sample, by what
//! they carry: the colours of mirrors and glass, shares at glass where a path goes both ways, and what roulette has
//! spared them for. So the mean over the samples is that of all ways that light takes, as it is of the picture.
//!
//! [`Pixel::Seen`]: crate::layers::Pixel::Seen

use super::lights::{self, LightHit};
use super::materials::Bsdf;
use super::shade::{Ray, has};
use crate::engine::batch::{Batch, path};
use crate::lanes::{Bits, Lanes, Mask};
use crate::layers::{LayerSet, Seen, seen_at};
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

/// Adds to `batch.layers.lamps` what the rays in `batch.paths` add of lamps to their samples, of paths that have met
/// mirrors and glass only, or nothing yet: what `shade` adds of it, to the last bit but for the order of the sum. No
/// other way finds that light, so it counts whole, or by the weight that glint chains and paths have of it.
#[inline(always)]
pub fn lamps<F: Lanes>(scene: &Scene, batch: &mut Batch) {
    let (paths, hits, weights) = (&*batch.paths, &*batch.hits, &batch.glint_weight);
    for i in (0..paths.len).step_by(F::N) {
        let ray = Ray::<F>::load(paths, hits, i);
        let chains = ray.hit & !has(ray.slot, path::NOT_FOLLOWED);
        if !chains.any() {
            continue;
        }
        let s = ray.surface(scene, hits);
        let lanes = chains & !s.light.eq(F::U::splat(0));
        if !lanes.any() {
            continue;
        }
        let tables = &scene.tables.lights;
        let light = F::U::select(lanes, s.light - F::U::splat(1), F::U::splat(0));
        let cos = ray.direction.dot(s.ng).abs();
        let met = LightHit { direction: ray.direction, distance: ray.distance(hits), cos, front: s.outside, lanes };
        let shown = ray.eta2 * F::gather(weights, ray.item());
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
