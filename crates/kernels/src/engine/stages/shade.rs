//! One vertex of every path: light that the ray met, light sampled from here, and the next ray.
//!
//! Direct light by multiple importance sampling (Veach 1997, power heuristic) of the light's solid angle and the
//! material's lobe. At the last vertex a diffuse surface casts no further ray, so there the light sample has weight
//! one.

use super::aim;
use super::cameras::View;
use super::light_paths::{Turn, change, density_ratio};
use super::lights::{self, LightHit, Receiver};
use super::materials::{Bsdf, reflect_bent};
use super::points::{PairPoints, PixelOf};
use super::share::{add_members, add_suffixes};
use super::surface::{Surface, surface};
use crate::engine::batch::{BRANCHING, Batch, Columns, LATE_AIMS, path};
use crate::engine::pass::{Pass, Task};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::Purpose;
use crate::scene::{NONE, Scene};

/// From this vertex on (0 = first hit) a path goes on with a probability that falls with its throughput. Earlier,
/// roulette throws away the stratification that the sampler pays for.
pub const ROULETTE_FROM: u32 = 3;

/// Where the fainter of both ways carries less than this, one of them is taken at random.
const LEAST_BRANCH: f32 = 0.003;

/// Shades the hits of vertex `vertex`; the paths that go on are in `batch.paths` afterwards, their shadow rays in
/// `batch.shadows`. Where pixels share (`pass.reuse`, see [`super::share`]), their vertices are added to
/// `batch.members` and `batch.suffixes`.
#[inline(always)]
pub fn shade<F: Lanes>(scene: &Scene, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
    let seed = pass.seed;
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let tables = &scene.tables;
    let items = &batch.items;
    let choices = PairPoints::<F>::new(seed, Purpose::Choice(vertex), items);
    let light_points = PairPoints::<F>::new(seed, Purpose::Light(vertex), items);
    let directions = PairPoints::<F>::new(seed, Purpose::Direction(vertex), items);
    let roulettes = PairPoints::<F>::new(seed, Purpose::Roulette(vertex), items);
    let background = V3::<F>::splat(scene.background);
    let open = scene.is_open();
    let several = tables.lights.several();
    let guide = pass.guide;
    // After the last scattering a ray is cast only to see the light that it meets.
    let scatters = vertex <= scene.max_bounces;
    let last = vertex == scene.max_bounces;
    let direct = pass.task == Task::Direct;

    let (paths, next, shadows) = (&*batch.paths, &mut *batch.next, &mut *batch.shadows);
    let (members, suffixes) = (&mut *batch.members, &mut *batch.suffixes);
    // A member's second vertex needs a scattering of its own.
    let joins = pass.reuse && vertex < scene.max_bounces;
    // What a ray aimed from the last vertex met could not scatter.
    let aims_here = guide.is_some() && vertex < scene.max_bounces;
    let (aimers, branches) = (&mut *batch.aimers, &mut *batch.branches);
    next.len = 0;
    branches.len = 0;
    shadows.len = 0;
    aimers.len = 0;
    for i in (0..paths.len).step_by(F::N) {
        let valid = F::first(paths.len - i);
        let origin = V3::<F>::load(&paths.origin, i);
        let direction = V3::<F>::load(&paths.direction, i);
        let mut throughput = V3::<F>::load(&paths.throughput, i);
        let mut eta2 = F::load(&paths.eta2[i..]);
        let mut slot = F::U::load(&paths.slot[i..]);
        let primitive = F::U::load(&batch.hits.primitive[i..]);
        let instance = F::U::load(&batch.hits.instance[i..]);
        let hit = valid & !primitive.eq(F::U::splat(NONE));
        // What an aimed ray finds other than mirrors, glass and glossy surfaces, its path's own ray finds.
        let aimed = if guide.is_some() { valid & has(slot, path::AIMED) } else { F::M::from_bits(0) };
        let left = if open { valid & !hit & !aimed } else { F::M::from_bits(0) };
        let mut shown = eta2;
        if batch.glints != 0 {
            let item = (slot & F::U::splat(path::SLOT)).shr::<6>();
            let mirrors_and_glass = (slot & F::U::splat(!(path::SLOT | path::BRANCH))).eq(F::U::splat(0));
            shown = F::select(mirrors_and_glass, eta2 * F::gather(&batch.glint_weight, item), eta2);
        }
        let mut seen = throughput.scale(shown).mul(background);
        if let Some(environment) = &tables.lights.environment
            && (vertex > 0 || environment.camera_visible)
            && left.any()
        {
            let pdf = F::load(&paths.pdf[i..]);
            let (sampled, radiance) = lights::beyond(&tables.lights, environment, direction);
            let weight = F::select(pdf.lt(zero), one, power_heuristic(pdf, sampled));
            seen = throughput.mul(radiance).scale(shown * weight);
        }
        if !hit.any() {
            add_to_slots(&mut batch.radiance, slot & F::U::splat(path::SUM), seen, left);
            continue;
        }
        let s = surface(scene, origin, direction, F::load(&batch.hits.t[i..]), primitive, instance, hit);

        // Light met by the ray, a lamp's or the background's. Added path by path, not kind by kind: both ways at glass
        // have one slot, and the order of a sum must not depend on the number of lanes.
        let lamp = hit & !s.light.eq(F::U::splat(0));
        let emits = lamp & !aimed;
        if emits.any() {
            let light = F::U::select(emits, s.light - F::U::splat(1), F::U::splat(0));
            let pdf = F::load(&paths.pdf[i..]);
            let normal = if several { V3::<F>::load(&paths.normal, i) } else { V3::grey(zero) };
            let (distance, cos) = (F::load(&batch.hits.t[i..]), direction.dot(s.ng).abs());
            let met = LightHit { direction, distance, cos, front: s.outside, lanes: emits };
            let sampled = lights::pdf(&tables.lights, light, Receiver { p: origin, n: normal }, &met);
            let mut weight = F::select(pdf.lt(zero), one, power_heuristic(pdf, sampled));
            if let Some((light_paths, plan)) = pass.light_paths
                && vertex > 1
            {
                let ratio = F::load(&paths.film[i..]);
                let found = emits & zero.lt(ratio);
                if found.any() {
                    let primitive = F::U::load(&paths.from_primitive[i..]);
                    let instance = F::U::load(&paths.from_instance[i..]);
                    let by_light =
                        density_ratio(light_paths, plan, &s, direction, light, primitive, instance, ratio, found);
                    weight = F::select(found, one / (one + by_light), weight);
                }
            }
            let mut shines = lights::radiance(&tables.lights, light, &met).mul(throughput).scale(shown * weight);
            if tables.lights.glow.is_some() {
                shines = shines.mul(lights::share_at(scene, &s, emits));
            }
            seen = V3::select(emits, shines, seen);
        }
        add_to_slots(&mut batch.radiance, slot & F::U::splat(path::SUM), seen, emits | left);
        let mut surfaces = hit & !lamp;
        if direct {
            // What a rough surface has scattered sees lights only.
            surfaces = surfaces & !has(slot, path::OWN);
        }
        if !scatters || !surfaces.any() {
            continue;
        }

        let mut bsdf = Bsdf::met(scene, &s, surfaces, &batch.hits.behind[..], i);
        if pass.task == Task::Chains {
            // Chains end at all other surfaces.
            surfaces = surfaces & bsdf.specular();
            bsdf.keep_specular();
            if !surfaces.any() {
                continue;
            }
        }
        let wo = direction.neg();
        let mut film = zero;
        if pass.light_paths.is_some() {
            film = F::load(&paths.film[i..]);
            if vertex == 0 {
                let distance = F::load(&batch.hits.t[i..]);
                film = film * View::new(&scene.camera, scene.size).area_of(direction, distance, &s);
                film = F::select(bsdf.packs() & !s.smooth, film, zero);
            } else {
                film = F::select(bsdf.rough(), zero, film);
            }
        }
        if let Some(guide) = guide
            && vertex > 0
        {
            surfaces = surfaces & !(aimed & bsdf.diffuse);
            bsdf.diffuse = bsdf.diffuse & surfaces;
            let both_find = surfaces & !bsdf.diffuse & has(slot, path::AIMS);
            slot = slot & F::U::splat(!(path::AIMED | path::AIMS));
            if both_find.any() {
                let by_itself = F::load(&paths.pdf[i..]);
                let normal = V3::<F>::load(&paths.normal, i);
                let by_aiming = aim::density(guide, origin, normal, direction, both_find);
                let weight = by_itself / (by_itself + by_aiming);
                // Not in the throughput: roulette would undo it.
                eta2 = F::select(both_find, eta2 * weight, eta2);
                film = F::select(both_find, film * normal.dot(direction) / (by_itself + by_aiming), film);
            }
        }
        let rough = bsdf.rough();
        if pass.reuse && vertex > 0 {
            let found = surfaces & !(slot & F::U::splat(path::MAKER)).eq(F::U::splat(0));
            // Light leaves a diffuse vertex alike in all directions: what comes from here on is any member's.
            let shared = found & bsdf.diffuse;
            if shared.any() {
                add_suffixes(suffixes, &s, slot, primitive, instance, shared);
                throughput = V3::select(shared, V3::grey(one), throughput);
                eta2 = F::select(shared, one, eta2);
            }
            let bare = slot & F::U::splat(path::SLOT | path::LATES);
            let own = F::U::select(shared, bare | F::U::splat(path::SHARED), bare | F::U::splat(path::OWN));
            slot = F::U::select(found, own, slot);
        }
        let lit_here = rough & valid;
        // Diffuse surfaces go on at the last vertex only to see a background.
        let goes_on = if (last || direct) && !open { !bsdf.diffuse } else { valid };
        let pixel = PixelOf::<F>::new(slot, &batch.pixels);
        let [on_light, of_direction] = PairPoints::points_of([&light_points, &directions], &pixel);
        let lobes_or_end = bsdf.glossy.any() || bsdf.transparent.any() || vertex >= ROULETTE_FROM;
        let (mut of_choice, mut of_roulette) = ((zero, zero), (zero, zero));
        if several {
            [of_choice, of_roulette] = PairPoints::points_of([&choices, &roulettes], &pixel);
        } else if lobes_or_end {
            of_roulette = roulettes.points(&pixel);
        }

        // Light sampled from here.
        if lit_here.any() && !tables.lights.is_empty() {
            let (u, v) = of_choice;
            let choice = lights::choose(&tables.lights, Receiver { p: s.start, n: s.ns }, u, v);
            let (u, v) = on_light;
            let on = F::U::select(instance.eq(F::U::splat(NONE)), primitive, F::U::splat(NONE));
            let from = lights::Start { p: s.start, on, parts: &tables.shapes.parts };
            let l = lights::sample(&tables.lights, &choice, from, u, v, lit_here);
            let cos_i = s.ns.dot(l.wi);
            let lit = lit_here & bsdf.reaches(cos_i) & zero.lt(l.distance);
            if lit.any() {
                let (f, pdf) = bsdf.evaluate(s.ns, wo, l.wi, cos_i);
                let weight = F::select(goes_on, weight_of_ratio(pdf * l.inverse_pdf), one);
                let mut value = f.mul(throughput).mul(l.radiance).scale(cos_i * l.inverse_pdf * (weight * eta2));
                if tables.lights.glow.is_some() {
                    let on_lamp = lit & !choice.environment;
                    let ray = (s.start, l.wi);
                    value = value.mul(lights::share_towards(scene, choice.light, ray, l.distance, on_lamp));
                }
                let cast = lit & zero.lt(value.max_component());
                let k = shadows.len;
                s.start.compress(cast, &mut shadows.origin, k);
                l.wi.compress(cast, &mut shadows.direction, k);
                l.distance.compress(cast, &mut shadows.t_max[k..]);
                value.compress(cast, &mut shadows.contribution, k);
                (slot & F::U::splat(path::SUM)).compress(cast, &mut shadows.slot[k..]);
                leaves(&s, l.wi, primitive).compress(cast, &mut shadows.from_primitive[k..]);
                instance.compress(cast, &mut shadows.from_instance[k..]);
                l.primitive.compress(cast, &mut shadows.target_primitive[k..]);
                shadows.len += cast.count();
            }
        }

        // The next ray.
        let (go_on, lobe) = of_roulette;
        let mut wi = direction;
        let mut weight = bsdf.color;
        let mut pdf = c(-1.0);
        let mut start = s.start;
        let mut new_eta2 = eta2;
        let mut alive = surfaces & goes_on;
        if (rough & goes_on).any() {
            let (u, v) = of_direction;
            let sample = bsdf.sample_rough(s.ns, wo, u, v, lobe);
            wi = V3::select(rough, sample.wi, wi);
            weight = V3::select(rough, sample.weight, weight);
            pdf = F::select(rough, sample.pdf, pdf);
            alive = alive & !(rough & sample.pdf.le(zero));
        }
        if bsdf.mirror.any() {
            let (reflected, normal) = reflect_bent(&s, wo);
            wi = V3::select(bsdf.mirror, reflected, wi);
            weight = V3::select(bsdf.mirror, bsdf.mirrored_color(wo.dot(normal)), weight);
            start = V3::select(bsdf.mirror, s.ng.mad(s.offset, s.p), start);
        }
        if bsdf.transparent.any() {
            let d = bsdf.dielectric(&s, wo);
            let mut refracted = d.reflectance.le(lobe);
            let mut share = one;
            if vertex < BRANCHING {
                // The path goes on where more of the light goes; the rest is a path of its own, and shares nothing.
                // Roulette must not see their shares: they make a whole.
                let fresh = (slot & F::U::splat(!path::SLOT)).eq(F::U::splat(0));
                let fainter = d.reflectance.min(one - d.reflectance);
                let both = bsdf.transparent & fresh & c(LEAST_BRANCH).lt(fainter * eta2 * throughput.max_component());
                let passes = d.reflectance.lt(c(0.5));
                refracted = (both & passes) | (!both & refracted);
                share = F::select(both, one - fainter, one);
                if both.any() {
                    let o = d.take(!passes);
                    let color = V3::select(o.refracted, bsdf.color, V3::grey(one));
                    let side = F::select(o.refracted, -s.offset, s.offset);
                    let k = branches.len;
                    s.ng.mad(side, s.p).compress(both, &mut branches.origin, k);
                    o.wi.compress(both, &mut branches.direction, k);
                    throughput.mul(color).compress(both, &mut branches.throughput, k);
                    (eta2 * o.eta2 * fainter).compress(both, &mut branches.eta2[k..]);
                    c(-1.0).compress(both, &mut branches.pdf[k..]);
                    (slot | F::U::splat(path::BRANCH)).compress(both, &mut branches.slot[k..]);
                    primitive.compress(both, &mut branches.from_primitive[k..]);
                    instance.compress(both, &mut branches.from_instance[k..]);
                    branches.len += both.count();
                }
            }
            let d = d.take(refracted);
            wi = V3::select(bsdf.transparent, d.wi, wi);
            let side = F::select(d.refracted, -s.offset, s.offset);
            start = V3::select(bsdf.transparent, s.ng.mad(side, s.p), start);
            weight = V3::select(bsdf.transparent & !d.refracted, V3::grey(one), weight);
            new_eta2 = F::select(bsdf.transparent, eta2 * d.eta2 * share, eta2);
        }
        if pass.light_paths.is_some() && vertex > 0 && zero.lt(film).any() {
            let refracted = bsdf.transparent & wi.dot(s.ng).lt(zero);
            let ior = bsdf.ior();
            let eta = F::select(s.outside, one / ior, ior);
            let eta2 = F::select(refracted, eta * eta, one);
            film = film * change(&s, Turn { wo, wi, refracted, ior, eta2 }, true);
        }
        let mut carried = throughput.mul(weight);
        let mut survival = one;
        let mut member = F::M::from_bits(0);
        let colored = throughput.mul(bsdf.color);
        if joins {
            let fresh = (slot & F::U::splat(!path::SLOT)).eq(F::U::splat(0));
            let item = (slot & F::U::splat(path::SLOT)).shr::<6>();
            let shares = !F::U::gather(&batch.item_shares, item).eq(F::U::splat(0));
            member = surfaces & bsdf.packs() & fresh & shares & zero.lt(colored.max_component());
        }
        if vertex >= ROULETTE_FROM {
            // That a member goes on must not depend on where to: other pixels reckon with its density.
            survival = F::select(member, colored.max_component(), carried.max_component()).min(one);
            alive = alive & go_on.lt(survival);
            carried = carried.scale(one / F::select(zero.lt(survival), survival, one));
        }
        if member.any() {
            let arrives = colored.scale(eta2);
            add_members(members, &bsdf, &s, wo, arrives, survival, slot, primitive, instance, member);
            slot = F::U::select(member, slot | F::U::splat(path::MAKER), slot);
        }
        let untouched = rough & !has(slot, path::SHARED | path::MAKER | path::OWN);
        slot = F::U::select(untouched, slot | F::U::splat(path::OWN), slot);
        if aims_here {
            let mut aims = surfaces & bsdf.packs() & zero.lt(colored.max_component());
            if vertex >= BRANCHING {
                let late = F::U::splat(path::LATE);
                aims = aims & (slot & F::U::splat(path::LATES)).lt(late * F::U::splat(LATE_AIMS));
                slot = F::U::select(aims, slot + late, slot);
            }
            film.compress(aims, &mut aimers.film[aimers.len..]);
            add_members(aimers, &bsdf, &s, wo, colored, eta2, slot, primitive, instance, aims);
            slot = F::U::select(aims, slot | F::U::splat(path::AIMS), slot);
        }
        let alive = alive & zero.lt(carried.max_component());
        let k = next.len;
        start.compress(alive, &mut next.origin, k);
        wi.compress(alive, &mut next.direction, k);
        carried.compress(alive, &mut next.throughput, k);
        new_eta2.compress(alive, &mut next.eta2[k..]);
        pdf.compress(alive, &mut next.pdf[k..]);
        if several || guide.is_some() {
            s.ns.compress(alive, &mut next.normal, k);
        }
        if pass.light_paths.is_some() {
            film.compress(alive, &mut next.film[k..]);
        }
        slot.compress(alive, &mut next.slot[k..]);
        leaves(&s, wi, primitive).compress(alive, &mut next.from_primitive[k..]);
        instance.compress(alive, &mut next.from_instance[k..]);
        next.len += alive.count();
    }
    // Behind all others, so that their order does not depend on the number of lanes.
    next.append(branches);
    std::mem::swap(&mut batch.paths, &mut batch.next);
    batch.counters.scattered_rays += batch.paths.len as u64;
    batch.counters.shadow_rays += batch.shadows.len as u64;
}

/// The primitive that a ray from this surface must not meet: the one it leaves. A ray that sinks below a smooth
/// triangle starts above it (Hanika) and may well meet it.
#[inline(always)]
pub fn leaves<F: Lanes>(s: &Surface<F>, wi: V3<F>, primitive: F::U) -> F::U {
    let sinks = s.smooth & wi.dot(s.ng).le(F::splat(0.0)) & !s.start.sub(s.p).dot(s.ng).le(s.offset);
    F::U::select(sinks, F::U::splat(NONE), primitive)
}

/// Lanes with this bit of [`path`].
#[inline(always)]
fn has<U: Bits>(slot: U, bit: u32) -> U::M {
    !(slot & U::splat(bit)).eq(U::splat(0))
}

/// a^2 / (a^2 + b^2), written so that large densities do not overflow.
#[inline(always)]
fn power_heuristic<F: Lanes>(a: F, b: F) -> F {
    weight_of_ratio(b / a)
}

/// 1 / (1 + (b / a)^2) of the ratio b / a.
#[inline(always)]
pub fn weight_of_ratio<F: Lanes>(ratio: F) -> F {
    F::splat(1.0) / ratio.fma(ratio, F::splat(1.0))
}

/// Adds the lanes of the mask to their slots' radiance, one after the other.
#[inline(always)]
fn add_to_slots<F: Lanes>(radiance: &mut Columns, slot: F::U, value: V3<F>, mask: F::M) {
    let mut bits = mask.bits();
    if bits == 0 {
        return;
    }
    let mut slots = [0u32; 32];
    let mut values = [[0f32; 32]; 3];
    slot.store(&mut slots);
    value.0.store(&mut values[0]);
    value.1.store(&mut values[1]);
    value.2.store(&mut values[2]);
    while bits != 0 {
        let lane = bits.trailing_zeros() as usize;
        bits &= bits - 1;
        let to = slots[lane] as usize;
        for channel in 0..3 {
            radiance[channel][to] += values[channel][lane];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::ArrayF;

    /// The weights of both ways to find a light sum to one (Veach 1997, 9.2), also where one density is all or nothing.
    #[test]
    fn mis_weights_sum_to_one() {
        type S = ArrayF<1>;
        let weight = |a: f32, b: f32| {
            let mut out = [0.0];
            power_heuristic(S::splat(a), S::splat(b)).store(&mut out);
            f64::from(out[0])
        };
        for a in [1e-20f32, 1e-8, 0.01, 0.3, 1.0, 7.0, 1e5, 1e20] {
            for b in [1e-20f32, 1e-8, 0.01, 0.3, 1.0, 7.0, 1e5, 1e20] {
                let (of_a, of_b) = (weight(a, b), weight(b, a));
                assert!((of_a + of_b - 1.0).abs() < 3e-7, "{a} {b}: {of_a} + {of_b}");
                let ratio = f64::from(b) / f64::from(a);
                assert!((of_a - 1.0 / (1.0 + ratio * ratio)).abs() < 3e-7, "{a} {b}: {of_a}");
            }
            assert_eq!(weight(a, 0.0), 1.0);
        }
    }
}
