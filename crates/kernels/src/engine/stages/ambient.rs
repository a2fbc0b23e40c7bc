//! Ambient occlusion: how much of the sky above a surface is free, by one ray a sample, drawn by the cosine. Materials
//! and lights do not matter.

use super::points::{PairPoints, PixelOf};
use super::shade::leaves;
use super::surface_at::surface_at;
use crate::engine::batch::{Batch, path};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::Purpose;
use crate::sampling::warp;
use crate::scene::{NONE, Scene};

/// No ray is longer: as far as the sky is.
const FAR: f32 = 1e30;

/// Puts into `batch.shadows` a ray of this length from what each camera ray has hit; if nothing is in its way, it
/// brings one. There are no paths afterwards.
#[inline(always)]
pub fn ambient<F: Lanes>(scene: &Scene, seed: u32, distance: f32, batch: &mut Batch) {
    let directions = PairPoints::<F>::new(seed, Purpose::Direction(0), &batch.items);
    let (paths, shadows) = (&*batch.paths, &mut *batch.shadows);
    shadows.len = 0;
    for i in (0..paths.len).step_by(F::N) {
        let primitive = F::U::load(&batch.hits.primitive[i..]);
        let hit = F::first(paths.len - i) & !primitive.eq(F::U::splat(NONE));
        if !hit.any() {
            continue;
        }
        let origin = V3::<F>::load(&paths.origin, i);
        let direction = V3::<F>::load(&paths.direction, i);
        let instance = F::U::load(&batch.hits.instance[i..]);
        let s = surface_at(scene, origin, direction, F::load(&batch.hits.t[i..]), primitive, instance, hit);
        let slot = F::U::load(&paths.slot[i..]) & F::U::splat(path::SLOT);
        let (u, v) = directions.points(&PixelOf::<F>::new(slot, &batch.pixels));
        let wi = s.ns.to_world(warp::cosine_hemisphere(u, v));
        let hit = hit & !s.buries(wi);
        let k = shadows.len;
        s.start.compress(hit, &mut shadows.origin, k);
        wi.compress(hit, &mut shadows.direction, k);
        F::splat(distance.min(FAR)).compress(hit, &mut shadows.t_max[k..]);
        V3::grey(F::splat(1.0)).compress(hit, &mut shadows.contribution, k);
        slot.compress(hit, &mut shadows.slot[k..]);
        leaves(&s, wi, primitive).compress(hit, &mut shadows.from_primitive[k..]);
        instance.compress(hit, &mut shadows.from_instance[k..]);
        F::U::splat(NONE).compress(hit, &mut shadows.target_primitive[k..]);
        shadows.len += hit.count();
    }
    batch.paths.len = 0;
    batch.counters.shadow_rays += batch.shadows.len as u64;
}
