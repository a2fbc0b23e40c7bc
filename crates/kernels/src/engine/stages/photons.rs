//! Photons: from the lights, over mirrors, glass and narrow lobes, to rough surfaces (see `engine::guide`).

use super::lights::{curved, environment, share_towards};
use super::materials::{Bsdf, reflect_bent};
use super::shade::leaves;
use super::surface_at::surface_at;
use crate::engine::batch::{Batch, Photons};
use crate::engine::guide::cells::FARTHEST;
use crate::engine::guide::plan::{Plan, aim};
use crate::engine::pass::PhotonPass;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::{hash3, unit};
use crate::sampling::sobol::{owen, pascal_upper, shuffle_indices};
use crate::sampling::warp;
use crate::scene::{LightTable, NONE, Scene};

/// Random numbers of a photon: Owen-scrambled Sobol' pairs over the photons of its light and caster in all maps, each
/// pair with an order of its own.
pub struct Numbers<F: Lanes> {
    /// Which photon.
    pub index: F::U,
    /// Which pair.
    pub key: F::U,
}

impl<F: Lanes> Numbers<F> {
    #[inline(always)]
    fn keyed(&self, salt: u32) -> F::U {
        let mixed = (self.key ^ F::U::splat(salt)) * F::U::splat(0x9e37_79b1);
        mixed ^ mixed.shr::<15>()
    }
    #[inline(always)]
    pub fn pair(&self, salt: u32) -> (F, F) {
        let index = shuffle_indices(self.index, self.keyed(salt));
        let x = owen(index, self.keyed(salt ^ 0x5bd1_e995));
        let y = owen(pascal_upper(index), self.keyed(salt ^ 0x2545_f491));
        (unit::<F>(x.reverse_bits()), unit::<F>(y.reverse_bits()))
    }
}

/// Fills `batch.paths` with the first rays of the photons in `batch.photons`: slot the photon, throughput its flux,
/// `pdf` how far from the light they start; of light paths radiance, and `pdf` their density per area and solid angle
/// over the cosine.
// Long: one way of starting for each kind of light, which share their numbers.
#[inline(always)]
pub fn photons_emit<F: Lanes>(scene: &Scene, plan: &Plan, pass: PhotonPass<'_>, batch: &mut Batch) {
    let c = F::splat;
    let (zero, one, two) = (c(0.0), c(1.0), c(2.0));
    let pairs = &plan.pairs;
    let salt = |k: u32| hash3(pass.seed, k, 0xb010_9a17) as u32;
    let salts = [salt(0), salt(1), salt(2)];
    let (photons, paths) = (&*batch.photons, &mut *batch.paths);
    paths.len = 0;
    for i in (0..pass.count).step_by(F::N) {
        let valid = F::first(pass.count - i);
        let pair = F::U::select(valid, F::U::load(&photons.pair[i..]), F::U::splat(0));
        let numbers = Numbers::<F> { index: F::U::load(&photons.index[i..]), key: F::U::gather(&pairs.key, pair) };
        let aimed = F::U::gather(&pairs.aim, pair);
        let inside = aimed.eq(F::U::splat(aim::INSIDE));
        let everywhere = aimed.eq(F::U::splat(aim::EVERYWHERE));
        // A point of the light.
        let (u, v) = numbers.pair(salts[0]);
        let axis = V3::<F>::gather_columns(&pairs.axis, pair);
        let outward = axis.to_world(warp::cone(u, v, F::gather(&pairs.cap, pair)));
        let center = V3::<F>::gather_columns(&pairs.light_center, pair);
        let radius = F::gather(&pairs.light_radius, pair);
        let mut point = outward.mad(radius, center);
        let mut normal = V3::select(inside, outward.neg(), outward);
        let flags = F::U::gather(&pairs.flags, pair);
        let two_sided = !(flags & F::U::splat(LightTable::TWO_SIDED)).eq(F::U::splat(0));
        let flat = !(flags & F::U::splat(LightTable::PLANE)).eq(F::U::splat(0));
        if flat.any() {
            let fold = !(flags & F::U::splat(LightTable::TRIANGLE)).eq(F::U::splat(0)) & one.lt(u + v);
            let (u, v) = (F::select(fold, one - u, u), F::select(fold, one - v, v));
            let edge = V3::<F>::gather_columns(&pairs.edge, pair);
            point = V3::select(flat, axis.mad(u, edge.mad(v, center)), point);
            normal = V3::select(flat, V3::gather_columns(&pairs.normal, pair), normal);
        }
        let (mut sided, mut rarity) = (flat, one);
        if !plan.curved.is_empty() {
            let on = valid & !(flags & F::U::splat(LightTable::CURVED)).eq(F::U::splat(0));
            if on.any() {
                let start = curved::start::<F>(&plan.curved, F::U::gather(&pairs.row, pair), u, v, on);
                point = V3::select(on, start.point, point);
                normal = V3::select(on, start.normal, normal);
                rarity = F::select(on, start.rarity, rarity);
                sided = sided | on;
            }
        }
        // A direction from there to the caster's sphere, uniform.
        let (u, v) = numbers.pair(salts[1]);
        let to = V3::<F>::gather_columns(&pairs.caster_center, pair).sub(point);
        let distance2 = to.dot(to).max(c(1e-30));
        let sin2 = (F::gather(&pairs.caster_radius2, pair) / distance2).min(one);
        let cone = sin2 / (one + (one - sin2).sqrt());
        let towards = to.scale(one / distance2.sqrt());
        let in_cone = warp::cone(u, v, cone);
        let mut direction = towards.to_world(in_cone);
        let back = sided & two_sided & normal.dot(direction).lt(zero);
        normal = V3::select(back, normal.neg(), normal);
        let mut density = normal.dot(direction) * cone * c(super::materials::TWO_PI);
        if everywhere.any() {
            // A direction from one of its sides, by the cosine.
            let (side, _) = numbers.pair(salts[2]);
            normal = V3::select(everywhere & two_sided & side.lt(c(0.5)), normal.neg(), normal);
            direction = V3::select(everywhere, normal.to_world(warp::cosine_hemisphere(u, v)), direction);
            density = F::select(everywhere, one, density);
        }
        if sided.any() {
            point = V3::select(sided, normal.mad(F::gather(&pairs.offset, pair), point), point);
        }
        let mut sent = valid & zero.lt(density) & density.lt(two * c(super::materials::TWO_PI));
        density = density * rarity;
        let mut flux = V3::<F>::gather_columns(&pairs.flux, pair).scale(density);
        let mut radiance = V3::<F>::gather_columns(&pairs.radiance, pair);
        if scene.tables.lights.glow.is_some() {
            let light = F::U::gather(&pairs.light, pair);
            let share = share_towards(scene, light, (point, normal.neg()), zero, sent);
            (flux, radiance) = (flux.mul(share), radiance.mul(share));
        }
        let mut leaves = F::U::gather(&pairs.light_primitive, pair);
        let mut passed = zero;
        if pairs.any_far {
            let approach = F::gather(&pairs.approach, pair);
            let distance = distance2.sqrt();
            let aside = towards.to_world(V3(in_cone.0, in_cone.1, zero)).scale(distance / in_cone.2);
            let before = direction.mad(-approach, V3::gather_columns(&pairs.caster_center, pair).add(aside));
            let on_the_way = approach.lt(distance);
            point = V3::select(on_the_way, before, point);
            passed = F::select(on_the_way, distance - approach, zero);
            leaves = F::U::select(on_the_way, F::U::splat(NONE), leaves);
        }
        let from_sky = valid & aimed.eq(F::U::splat(aim::SKY));
        if from_sky.any() {
            let start = SkyStart::new(scene, plan, pair, &numbers, [salts[0], salts[1]]);
            point = V3::select(from_sky, start.point, point);
            direction = V3::select(from_sky, start.direction, direction);
            flux = V3::select(from_sky, start.flux, flux);
            radiance = V3::select(from_sky, start.radiance, radiance);
            density = F::select(from_sky, start.inverse_pdf, density);
            passed = F::select(from_sky, c(FARTHEST), passed);
            leaves = F::U::select(from_sky, F::U::splat(NONE), leaves);
            sent = (sent & !from_sky) | (from_sky & start.bright);
        }
        let k = paths.len;
        point.compress(sent, &mut paths.origin, k);
        direction.compress(sent, &mut paths.direction, k);
        if let Some(light_paths) = pass.light_paths {
            radiance.compress(sent, &mut paths.throughput, k);
            (F::gather(&light_paths.density, pair) / density).compress(sent, &mut paths.pdf[k..]);
            one.compress(sent, &mut paths.eta2[k..]);
        } else {
            flux.compress(sent, &mut paths.throughput, k);
            passed.compress(sent, &mut paths.pdf[k..]);
        }
        leaves.compress(sent, &mut paths.from_primitive[k..]);
        F::U::splat(NONE).compress(sent, &mut paths.from_instance[k..]);
        lane_numbers::<F>(i).compress(sent, &mut paths.slot[k..]);
        paths.len += sent.count();
    }
    batch.counters.photon_rays += batch.paths.len as u64;
}

/// Where photons from the bright parts of the sky start.
struct SkyStart<F: Lanes> {
    point: V3<F>,
    direction: V3<F>,
    flux: V3<F>,
    radiance: V3<F>,
    /// One over the density of the direction.
    inverse_pdf: F,
    /// Lanes whose direction is of these parts, and that nothing keeps from there.
    bright: F::M,
}

impl<F: Lanes> SkyStart<F> {
    /// From a direction by the sky's density, at a point of the disc before the caster.
    #[inline(always)]
    fn new(scene: &Scene, plan: &Plan, pair: F::U, numbers: &Numbers<F>, salts: [u32; 2]) -> Self {
        let zero = F::splat(0.0);
        let none = F::M::from_bits(0);
        let (Some(sky), Some(bright)) = (scene.environment(), &plan.bright) else {
            let nothing = V3::zero();
            let (point, direction, flux, radiance) = (nothing, nothing, nothing, nothing);
            return SkyStart { point, direction, flux, radiance, inverse_pdf: zero, bright: none };
        };
        let pairs = &plan.pairs;
        let (u, v) = numbers.pair(salts[0]);
        let from = environment::sample(sky, u, v);
        let (u, v) = numbers.pair(salts[1]);
        let (x, y) = warp::disc(u, v);
        let radius = F::gather(&pairs.caster_radius2, pair).sqrt();
        let center = V3::<F>::gather_columns(&pairs.caster_center, pair);
        let aside = from.wi.to_world(V3(x * radius, y * radius, zero));
        let point = from.wi.mad(F::gather(&pairs.approach, pair), center.add(aside));
        SkyStart {
            point,
            direction: from.wi.neg(),
            flux: V3::<F>::gather_columns(&pairs.flux, pair).mul(from.radiance).scale(from.inverse_pdf),
            radiance: from.radiance,
            inverse_pdf: from.inverse_pdf,
            bright: bright.has(from.radiance) & zero.lt(from.inverse_pdf) & !behind_planes(scene, point, from.wi),
        }
    }
}

/// Lanes that meet a plane between a point, which is outside of all that has an end, and the sky.
#[inline(always)]
fn behind_planes<F: Lanes>(scene: &Scene, point: V3<F>, towards: V3<F>) -> F::M {
    let c = |x: f64| F::splat(x as f32);
    scene.tables.planes.rows.iter().fold(F::M::from_bits(0), |behind, plane| {
        let normal = V3(c(plane.normal[0]), c(plane.normal[1]), c(plane.normal[2]));
        let (height, rises) = (point.dot(normal) - c(plane.offset), towards.dot(normal));
        behind | (height * rises).lt(F::splat(0.0))
    })
}

/// Stores the photons of a mask: where, whence, whence they seem to come, and their flux.
#[inline(always)]
fn store<F: Lanes>(photons: &mut Photons, stored: F::M, [point, from, seen]: [V3<F>; 3], flux: F) {
    if stored.any() {
        let k = photons.len;
        point.compress(stored, &mut photons.point, k);
        from.compress(stored, &mut photons.from, k);
        seen.compress(stored, &mut photons.origin, k);
        flux.compress(stored, &mut photons.flux[k..]);
        photons.len += stored.count();
    }
}

/// i, i + 1, ..
#[inline(always)]
fn lane_numbers<F: Lanes>(i: usize) -> F::U {
    let mut numbers = [0u32; 32];
    for (k, number) in numbers.iter_mut().enumerate() {
        *number = (i + k) as u32;
    }
    F::U::load(&numbers)
}

/// What becomes of the photons in `batch.paths` where they hit: over mirrors, glass and narrow glossy lobes they go on,
/// at rough surfaces they are stored if they have come over `event` > 0 of these, all others end. The first thing that
/// a photon meets must belong to the caster that it was aimed at: so each way from a light over its first mirror or
/// glass is taken by the photons of one caster only.
#[inline(always)]
pub fn photons_scatter<F: Lanes>(scene: &Scene, plan: &Plan, seed: u32, event: u32, batch: &mut Batch) {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let goes_on = event < scene.max_bounces;
    let salt = hash3(seed, event, 0x00e4_e275) as u32;
    let (paths, next, photons) = (&*batch.paths, &mut *batch.next, &mut *batch.photons);
    next.len = 0;
    for i in (0..paths.len).step_by(F::N) {
        let valid = F::first(paths.len - i);
        let origin = V3::<F>::load(&paths.origin, i);
        let direction = V3::<F>::load(&paths.direction, i);
        let flux = V3::<F>::load(&paths.throughput, i);
        let slot = F::U::select(valid, F::U::load(&paths.slot[i..]), F::U::splat(0));
        let primitive = F::U::load(&batch.hits.primitive[i..]);
        let instance = F::U::load(&batch.hits.instance[i..]);
        let mut hit = valid & !primitive.eq(F::U::splat(NONE));
        if event == 0 {
            hit = plan.on_caster::<F>(F::U::gather(&photons.pair[..], slot), primitive, instance, hit);
        }
        if !hit.any() {
            continue;
        }
        let s = surface_at(scene, origin, direction, F::load(&batch.hits.t[i..]), primitive, instance, hit);
        let surfaces = hit & s.light.eq(F::U::splat(0));
        let bsdf = Bsdf::<'_, F>::met(scene, &s, surfaces, &batch.hits.behind[..], i);
        let wo = direction.neg();
        let way = F::load(&paths.pdf[i..]) + F::load(&batch.hits.t[i..]);
        if event > 0 {
            let seen = wo.mad(way.min(c(FARTHEST)), s.p);
            store(photons, bsdf.rough(), [s.p, origin, seen], flux.0 + flux.1 + flux.2);
        }
        let narrow = bsdf.narrow();
        let mut passes = bsdf.specular() | narrow;
        if !goes_on || !passes.any() {
            continue;
        }
        let photon = F::U::gather(&photons.pair[..], slot);
        let numbers =
            Numbers::<F> { index: F::U::gather(&photons.index[..], slot), key: F::U::gather(&plan.pairs.key, photon) };
        let (mut wi, normal) = reflect_bent(&s, wo);
        let mut start = s.ng.mad(s.offset, s.p);
        let mut weight = bsdf.mirrored_color(wo.dot(normal));
        if bsdf.transparent.any() {
            let (lobe, _) = numbers.pair(salt);
            let d = bsdf.dielectric(&s, wo).sample(lobe);
            wi = V3::select(bsdf.transparent, d.wi, wi);
            let side = F::select(d.refracted, -s.offset, s.offset);
            start = V3::select(bsdf.transparent, s.ng.mad(side, s.p), start);
            weight = V3::select(bsdf.transparent & !d.refracted, V3::grey(one), weight);
        }
        let mut leaving = primitive;
        if narrow.any() {
            // Always on by the lobe.
            let (u, v) = numbers.pair(salt ^ 0x6c0b_b1e5);
            let (in_lobe, carries) = bsdf.sample_narrow(s.ns, wo, u, v);
            wi = V3::select(narrow, in_lobe, wi);
            weight = V3::select(narrow, carries, weight);
            start = V3::select(narrow, s.start, start);
            leaving = F::U::select(narrow, leaves(&s, wi, primitive), leaving);
            passes = passes & !(narrow & s.buries(wi));
        }
        let carried = flux.mul(weight);
        let alive = passes & zero.lt(carried.max_component());
        let k = next.len;
        start.compress(alive, &mut next.origin, k);
        wi.compress(alive, &mut next.direction, k);
        carried.compress(alive, &mut next.throughput, k);
        way.compress(alive, &mut next.pdf[k..]);
        slot.compress(alive, &mut next.slot[k..]);
        leaving.compress(alive, &mut next.from_primitive[k..]);
        instance.compress(alive, &mut next.from_instance[k..]);
        next.len += alive.count();
    }
    std::mem::swap(&mut batch.paths, &mut batch.next);
    batch.counters.photon_rays += batch.paths.len as u64;
}
