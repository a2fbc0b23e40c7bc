//! Light paths: from the lights over mirrors and glass to rough surfaces, and from there to the camera.
//!
//! What a diffuse or glossy surface shows of light that comes over mirrors and glass (E D S+ L in Heckbert's notation)
//! is found from both ends: by paths, whose rays from the surface happen to meet the light or are aimed
//! ([`super::aim`]), and by light paths (light tracing: Arvo 1986; Dutre, Lafortune, Willems 1993), each of which is
//! seen by whatever pixel it falls into. Far from a bent mirror the first are rare and bright, the second many and
//! faint. Both count by the balance heuristic (Veach 1997, 9.2), so nothing is lost where one of them finds nothing.
//!
//! A path is told by the point u of the film and the direction w at the surface point y; what follows is given by
//! mirrors and glass, which both ends choose between alike. Per unit of film area (in pixels) and solid angle
//!
//! - pixel j samples it with h_j(u) P(w), h_j the pixel's filter, P the densities of own and aimed ray together;
//! - light paths with D = rho / cos_q  K  cos_y J: rho per area of the light and solid angle there (all of a sample
//!   index together), cos_q and cos_y the cosines at light and surface, J the area of surface that a unit of film sees,
//!   K what mirrors and glass change: they keep n^2 dA cos dw (n the refractive index), and where the shading normal s
//!   differs from the geometric one g, each reflection has the factor |l.g| / |e.g| and each refraction |l.g| |e.s| /
//!   (|e.g| |l.s|), l and e being the directions on the sides of light and eye.
//!
//! Of the bright parts of a picture of all directions (see [`crate::engine::guide`]) rho / cos_q is their number times
//! the picture's density over the area of the disc before the caster that they come through: per area across the
//! direction and solid angle, which is the same measure.
//!
//! With the integrand h_j F, F = f cos L (and colours and the radiance scaling of glass), a light path adds h_j F /
//! (h_j P + D) to pixel j, and a path that has met the light counts by h_j P / (h_j P + D).
//!
//! Left to paths alone: surfaces with interpolated normals, where rays do not start where light paths land; reflections
//! and refractions that are not the same from both sides (bent normals of low-poly meshes); glossy lobes on the way;
//! metals that are not smooth.

use super::aim;
use super::cameras::View;
use super::lights::curved;
use super::materials::{Bsdf, TWO_PI, reflect_bent};
use super::photons::Numbers;
use super::surface::Surface;
use super::surface_at::surface_at;
use crate::engine::batch::{Batch, Shadows, Splats};
use crate::engine::guide::Guide;
use crate::engine::guide::plan::{Plan, aim as way};
use crate::engine::light_paths::LightPaths;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::hash3;
use crate::scene::{LightTable, NONE, Scene};

/// Where glass reflects all light.
struct Total<F> {
    /// (n_i / n_t)^2.
    eta2: F,
}

impl<F: Lanes> Total<F> {
    /// At this cosine.
    #[inline(always)]
    fn at(&self, cos: F) -> F::M {
        let one = F::splat(1.0);
        one.le(self.eta2 * (one - cos * cos))
    }
}

/// Cosine to the geometric normal of a direction's reflection in the shading normal, from the direction's own to both.
#[inline(always)]
fn height<F: Lanes>(s: &Surface<F>, on_shading: F, on_geometric: F) -> F {
    (on_shading + on_shading) * s.ns.dot(s.ng) - on_geometric
}

/// A cosine that may be divided by.
#[inline(always)]
fn cosine<F: Lanes>(v: V3<F>, n: V3<F>) -> F {
    v.dot(n).abs().max(F::splat(1e-6))
}

/// Whether a mirror or glass takes light from `wi` to `wo`, the side that `s` is seen from, and from there to here
/// alike: always, but for what is done about interpolated normals.
#[inline(always)]
fn alike<F: Lanes>(s: &Surface<F>, wo: V3<F>, wi: V3<F>, refracted: F::M, ior: F) -> F::M {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let (og, ig, os, is) = (wo.dot(s.ng), wi.dot(s.ng), wo.dot(s.ns), wi.dot(s.ns));
    let (low, high) = (og.abs().min(ig.abs()), og.abs().max(ig.abs()));
    let eta = F::select(s.outside, one / ior, ior);
    let total = Total { eta2: eta * eta };
    // Reflected in the very shading normal: `reflect_bent` bends where either side is low, and `Dielectric` takes the
    // triangle's own normal where that would let the light out.
    let off = s.ns.scale(os + os).sub(wo).sub(wi);
    let caught = !s.outside & total.at(os) & (!total.at(og) | !total.at(ig));
    let unbent = (high * c(0.9)).min(c(0.0101)).lt(low) & off.dot(off).lt(c(1e-8));
    let reflects = zero.lt(og) & zero.lt(ig) & unbent & !caught;
    // Refracted in it by Snell's law, and on neither side would the reflected direction be bent, nor does the other
    // pass so low that the triangle's own normal is taken.
    let tall = c(0.0101);
    let turn = wo.scale(eta).add(wi);
    let across = s.ns.scale(-turn.dot(s.ns)).add(turn);
    let passes = zero.lt(og) & ig.lt(zero) & zero.lt(os) & is.lt(zero) & tall.lt(low);
    let passes = passes & tall.lt(height(s, os, og)) & tall.lt(height(s, -is, -ig)) & across.dot(across).lt(c(1e-8));
    !s.smooth | (refracted & passes) | (!refracted & reflects)
}

/// K of one mirror or glass, zero where it is not the same from both sides; `from_eye`: the ray comes from the eye's
/// side.
#[inline(always)]
pub fn change<F: Lanes>(s: &Surface<F>, seen: Turn<F>, from_eye: bool) -> F {
    let Turn { wo, wi, refracted, ior, eta2 } = seen;
    if !s.smooth.any() {
        return eta2;
    }
    let (to_eye, to_light) = if from_eye { (wo, wi) } else { (wi, wo) };
    let sides = cosine(to_light, s.ng) / cosine(to_eye, s.ng);
    let bends = cosine(to_eye, s.ns) / cosine(to_light, s.ns);
    let factor = F::select(refracted, sides * bends, sides) * eta2;
    let factor = F::select(s.smooth, factor, eta2);
    F::select(alike(s, wo, wi, refracted, ior), factor, F::splat(0.0))
}

/// What a mirror or glass did.
#[derive(Clone, Copy)]
pub struct Turn<F: Lanes> {
    /// Where the ray came from.
    pub wo: V3<F>,
    /// Where it goes.
    pub wi: V3<F>,
    /// It passes the surface.
    pub refracted: F::M,
    /// Index of refraction of glass, one of mirrors.
    pub ior: F,
    /// (n_e / n_l)^2 where refracted, n_e and n_l the indices on the sides of eye and light, else one.
    pub eta2: F,
}

/// D over h P of paths that have met a light at a surface `s` along `direction`, coming from a caster's surface:
/// `ratio` is K cos_y J / (h P).
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn density_ratio<F: Lanes>(
    light_paths: &LightPaths,
    plan: &Plan,
    s: &Surface<F>,
    direction: V3<F>,
    light: F::U,
    primitive: F::U,
    instance: F::U,
    ratio: F,
    mask: F::M,
) -> F {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let nothing = F::U::splat(0);
    let (pair, known) = pair_of::<F>(light_paths, plan, light, [primitive, instance], mask);
    let pairs = &plan.pairs;
    let everywhere = F::U::gather(&pairs.aim, pair).eq(F::U::splat(way::EVERYWHERE));
    let center = V3::<F>::gather_columns(&pairs.light_center, pair);
    let radius = F::gather(&pairs.light_radius, pair);
    let mut outward = s.p.sub(center).scale(one / radius);
    let mut rarity = one;
    if !pairs.edge[0].is_empty() || !plan.curved.is_empty() {
        let flags = F::U::gather(&pairs.flags, pair);
        let others = flags & F::U::splat(LightTable::PLANE | LightTable::CURVED);
        outward = V3::select(others.eq(nothing), outward, s.ng);
        let on_curved = known & !(flags & F::U::splat(LightTable::CURVED)).eq(nothing);
        if on_curved.any() {
            let row = F::U::gather(&pairs.row, pair);
            rarity = F::select(on_curved, curved::rarity(&plan.curved, row, s.ng, on_curved), one);
        }
    }
    let cos = outward.dot(direction).abs();
    let cone = cone_to(plan, pair, s.p);
    let density = F::select(everywhere, one, cos * cone * c(TWO_PI)) * rarity;
    let known = known & zero.lt(density);
    let per_path = F::gather(&light_paths.density, pair) / F::select(known, density, one);
    F::select(known, per_path * ratio, zero)
}

/// [`density_ratio`] of paths that have left the scene: `density` and `radiance` are the sky's where they go.
#[inline(always)]
pub fn density_ratio_of_sky<F: Lanes>(
    light_paths: &LightPaths,
    plan: &Plan,
    (density, radiance): (F, V3<F>),
    from: [F::U; 2],
    ratio: F,
    mask: F::M,
) -> F {
    let Some(bright) = &plan.bright else { return F::splat(0.0) };
    let mask = mask & bright.has(radiance);
    let (pair, known) = pair_of::<F>(light_paths, plan, F::U::splat(light_paths.sky), from, mask);
    let per_path = F::gather(&light_paths.density, pair) * density;
    F::select(known, per_path * ratio, F::splat(0.0))
}

/// The pair of these lanes' lights and the casters that rays have left at a primitive of an instance, and which lanes
/// have one.
#[inline(always)]
fn pair_of<F: Lanes>(
    light_paths: &LightPaths,
    plan: &Plan,
    light: F::U,
    [primitive, instance]: [F::U; 2],
    mask: F::M,
) -> (F::U, F::M) {
    let nothing = F::U::splat(0);
    let on_sphere = mask & instance.eq(F::U::splat(NONE));
    let on_instance = mask & !on_sphere;
    let known = on_instance | (on_sphere & primitive.lt(F::U::splat(plan.casters.of_sphere.len() as u32)));
    let of_sphere = F::U::gather(&plan.casters.of_sphere, F::U::select(on_sphere & known, primitive, nothing));
    let of_instance = F::U::gather(&plan.casters.of_instance, F::U::select(on_instance, instance, nothing));
    let caster = F::U::select(on_instance, of_instance, of_sphere);
    let known = known & !caster.eq(F::U::splat(NONE));
    let casters = F::U::splat(plan.casters.list.len() as u32);
    let place = F::U::select(known, light * casters + caster, nothing);
    let pair = F::U::gather(&light_paths.pair_of, place);
    let known = known & !pair.eq(F::U::splat(NONE));
    (F::U::select(known, pair, nothing), known)
}

/// 1 - cos of half the angle of the cone from a point of a pair's light around its caster.
#[inline(always)]
fn cone_to<F: Lanes>(plan: &Plan, pair: F::U, point: V3<F>) -> F {
    let one = F::splat(1.0);
    let to = V3::<F>::gather_columns(&plan.pairs.caster_center, pair).sub(point);
    let sin2 = (F::gather(&plan.pairs.caster_radius2, pair) / to.dot(to).max(F::splat(1e-30))).min(one);
    sin2 / (one + (one - sin2).sqrt())
}

/// What is the same for all batches of light paths of a rendering.
#[derive(Clone, Copy)]
pub struct LightPass<'a> {
    /// Seed of their random choices.
    pub seed: u32,
    /// The plan, which is the guides', too.
    pub plan: &'a Plan,
    /// How many go where.
    pub light_paths: &'a LightPaths,
    /// What paths aim at, at this sample index.
    pub guide: &'a Guide,
}

/// Light paths where they have come to a surface.
struct Arrival<'s, 't, F: Lanes> {
    s: &'s Surface<F>,
    bsdf: &'s Bsdf<'t, F>,
    /// Towards where they came from.
    back: V3<F>,
    /// What they carry, without the radiance scaling of glass.
    carried: V3<F>,
    /// rho / cos_q  K.
    density: F,
    /// The radiance scaling of glass.
    eta2: F,
    primitive: F::U,
    instance: F::U,
}

/// Ends light paths at rough surfaces that the camera may see, from the point of its lens for (u, v): what they bring
/// to the film, and the shadow rays to the lens.
#[inline(always)]
fn to_camera<F: Lanes>(
    view: &View<F>,
    pass: LightPass<'_>,
    at: &Arrival<'_, '_, F>,
    lens: (F, F),
    shadows: &mut Shadows,
    splats: &mut Splats,
) {
    let (c, zero) = (F::splat, F::splat(0.0));
    let Arrival { s, bsdf, back, .. } = *at;
    let rough = bsdf.has_one_color() & !s.smooth;
    if !rough.any() {
        return;
    }
    let place = view.place(s.start, lens);
    let wo = place.wo;
    let (cos_eye, cos_y) = (s.ng.dot(wo), s.ng.dot(back));
    let margin = c(pass.light_paths.reach);
    let (right, bottom) = (c(2.0 * view.middle[0]), c(2.0 * view.middle[1]));
    let falls = rough
        & place.seen
        & zero.lt(cos_eye)
        & zero.lt(cos_y)
        & (-margin).lt(place.x)
        & place.x.lt(right + margin)
        & (-margin).lt(place.y)
        & place.y.lt(bottom + margin);
    if !falls.any() {
        return;
    }
    let (f, own) = bsdf.evaluate(s.ns, wo, back, cos_y);
    let aimed = aim::density(pass.guide, aim::From { p: s.start, n: s.ns, shared: F::first(0) }, back, falls);
    let seen = view.area(place.distance, place.cos, cos_eye) * place.measure;
    let brings = f.mul(at.carried).scale(cos_y * at.eta2);
    let falls = falls & zero.lt(brings.max_component());
    let k = splats.len;
    brings.compress(falls, &mut splats.brings, k);
    (own + aimed).compress(falls, &mut splats.by_paths[k..]);
    (at.density * cos_y * seen).compress(falls, &mut splats.by_light[k..]);
    place.x.compress(falls, &mut splats.x[k..]);
    place.y.compress(falls, &mut splats.y[k..]);
    splats.len += falls.count();
    let k = shadows.len;
    s.start.compress(falls, &mut shadows.origin, k);
    wo.compress(falls, &mut shadows.direction, k);
    place.free.compress(falls, &mut shadows.t_max[k..]);
    at.primitive.compress(falls, &mut shadows.from_primitive[k..]);
    at.instance.compress(falls, &mut shadows.from_instance[k..]);
    F::U::splat(NONE).compress(falls, &mut shadows.target_primitive[k..]);
    F::U::splat(NONE).compress(falls, &mut shadows.target_instance[k..]);
    shadows.len += falls.count();
}

/// What becomes of the light paths in `batch.paths` where they hit, after `event` mirrors and glass: over these they go
/// on; at rough surfaces behind them they end, and what they bring to the film is in `batch.splats`, with a shadow ray
/// to the lens each in `batch.shadows`.
#[inline(always)]
pub fn light_paths<F: Lanes>(scene: &Scene, pass: LightPass<'_>, event: u32, batch: &mut Batch) {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let plan = pass.plan;
    let view = View::<F>::new(&scene.camera, scene.size);
    let goes_on = event < scene.max_bounces;
    let salt = hash3(pass.seed, event, 0x00e4_e275) as u32;
    let lens_salt = hash3(pass.seed, event, 0x001e_2500) as u32;
    let (paths, next, photons) = (&*batch.paths, &mut *batch.next, &*batch.photons);
    let (shadows, splats) = (&mut *batch.shadows, &mut *batch.splats);
    next.len = 0;
    shadows.len = 0;
    for i in (0..paths.len).step_by(F::N) {
        let valid = F::first(paths.len - i);
        let direction = V3::<F>::load(&paths.direction, i);
        let carried = V3::<F>::load(&paths.throughput, i);
        let density = F::load(&paths.pdf[i..]);
        let eta2 = F::load(&paths.eta2[i..]);
        let slot = F::U::select(valid, F::U::load(&paths.slot[i..]), F::U::splat(0));
        let primitive = F::U::load(&batch.hits.primitive[i..]);
        let instance = F::U::load(&batch.hits.instance[i..]);
        let mut hit = valid & !primitive.eq(F::U::splat(NONE));
        let pair = F::U::gather(&photons.pair[..], slot);
        if event == 0 {
            hit = plan.on_caster::<F>(pair, primitive, instance, hit);
        }
        if !hit.any() {
            continue;
        }
        let origin = V3::<F>::load(&paths.origin, i);
        let s = surface_at(scene, origin, direction, F::load(&batch.hits.t[i..]), primitive, instance, hit);
        let surfaces = hit & s.light.eq(F::U::splat(0));
        let bsdf = Bsdf::<'_, F>::met(scene, &s, surfaces, &batch.hits.behind[..], i);
        let back = direction.neg();
        let numbers =
            Numbers::<F> { index: F::U::gather(&photons.index[..], slot), key: F::U::gather(&plan.pairs.key, pair) };
        if event > 0 {
            let at = Arrival { s: &s, bsdf: &bsdf, back, carried, density, eta2, primitive, instance };
            to_camera(&view, pass, &at, numbers.pair(lens_salt), shadows, splats);
        }
        let passes = bsdf.specular();
        if !goes_on || !passes.any() {
            continue;
        }
        let (mut to_eye, normal) = reflect_bent(&s, back);
        let mut start = s.ng.mad(s.offset, s.p);
        let mut weight = bsdf.mirrored_color(back.dot(normal));
        let (mut of_glass, mut refracted) = (one, F::M::from_bits(0));
        if bsdf.transparent.any() {
            let (lobe, _) = numbers.pair(salt);
            let d = bsdf.dielectric(&s, back).sample(lobe);
            refracted = bsdf.transparent & d.refracted;
            to_eye = V3::select(bsdf.transparent, d.wi, to_eye);
            start = V3::select(bsdf.transparent, s.ng.mad(F::select(d.refracted, -s.offset, s.offset), s.p), start);
            weight = V3::select(bsdf.transparent & !d.refracted, V3::grey(one), weight);
            // Seen from the light's side, so the other way round.
            of_glass = F::select(refracted, one / d.eta2, one);
        }
        let ior = bsdf.ior();
        let change = change(&s, Turn { wo: back, wi: to_eye, refracted, ior, eta2: of_glass }, false);
        let carried = carried.mul(weight);
        let alive = passes & zero.lt(carried.max_component()) & zero.lt(change);
        let k = next.len;
        start.compress(alive, &mut next.origin, k);
        to_eye.compress(alive, &mut next.direction, k);
        carried.compress(alive, &mut next.throughput, k);
        (density * change).compress(alive, &mut next.pdf[k..]);
        (eta2 * of_glass).compress(alive, &mut next.eta2[k..]);
        slot.compress(alive, &mut next.slot[k..]);
        primitive.compress(alive, &mut next.from_primitive[k..]);
        instance.compress(alive, &mut next.from_instance[k..]);
        next.len += alive.count();
    }
    std::mem::swap(&mut batch.paths, &mut batch.next);
    batch.counters.photon_rays += (batch.paths.len + batch.shadows.len) as u64;
}

#[cfg(test)]
mod tests {
    use super::super::materials::Dielectric;
    use super::*;
    use crate::lanes::ArrayF;

    type One = ArrayF<1>;

    fn unit(k: u32, salt: u32) -> [f32; 3] {
        let of = |axis: u32| (hash3(k, axis, salt) >> 40) as f32 / (1u32 << 23) as f32 - 1.0;
        let v = [of(0), of(1), of(2)];
        let length = v.iter().map(|x| x * x).sum::<f32>().sqrt().max(1e-3);
        v.map(|x| x / length)
    }

    fn number(x: One) -> f32 {
        let mut out = [0.0];
        x.store(&mut out);
        out[0]
    }

    /// A triangle with an interpolated normal, seen from one side.
    fn surface_with(ng: V3<One>, ns: V3<One>, outside: bool) -> Surface<One> {
        let zero = V3::<One>::zero();
        let all = <One as Lanes>::M::from_bits(1);
        let mask = |yes: bool| <One as Lanes>::M::from_bits(u32::from(yes));
        let none = <One as Lanes>::U::splat(0);
        Surface {
            p: zero,
            start: zero,
            ng,
            ns,
            outside: mask(outside),
            smooth: all,
            offset: One::splat(0.0),
            u: One::splat(0.0),
            v: One::splat(0.0),
            material: none,
            light: none,
            body: none,
            primitive: none,
        }
    }

    /// What counts for both ends is the same way from both: mirrors and glass with interpolated normals lead back, with
    /// the same factor.
    #[test]
    fn ways_that_count_lead_back() {
        let (mut counted, mut reflections) = (0, 0);
        for k in 0..20_000 {
            let ng = V3::<One>::splat(unit(k, 1));
            let toward = |n: V3<One>, to: V3<One>| if number(n.dot(to)) < 0.0 { n.neg() } else { n };
            let ns = toward(V3::splat(unit(k, 2)).mad(One::splat(0.3), ng).normalise(), ng);
            let wo = toward(V3::splat(unit(k, 3)), ng);
            let (outside, refracts) = (k & 1 == 0, k & 2 == 0);
            let ior = One::splat([1.5, 1.33, 0.7, 2.4][(k >> 2) as usize & 3]);
            let s = surface_with(ng, ns, outside);
            let pass = <One as Lanes>::M::from_bits(u32::from(refracts));
            let d = Dielectric::new(&s, wo, ior);
            if refracts && number(d.reflectance) >= 1.0 || number(ns.dot(wo)) <= 0.0 {
                continue;
            }
            let t = d.take(pass);
            let forth = Turn { wo, wi: t.wi, refracted: pass, ior, eta2: t.eta2 };
            let there = number(change(&s, forth, true));
            if there == 0.0 {
                continue;
            }
            let flip = |n: V3<One>| if refracts { n.neg() } else { n };
            let other = surface_with(flip(ng), flip(ns), outside != refracts);
            let back = Dielectric::new(&other, t.wi, ior).take(pass);
            let off = back.wi.sub(wo);
            assert!(number(off.dot(off)) < 1e-5, "{k}: off by {}", number(off.dot(off)).sqrt());
            let turn = Turn { wo: t.wi, wi: wo, refracted: pass, ior, eta2: One::splat(1.0) / back.eta2 };
            let here = number(change(&other, turn, false));
            assert!((here / there - 1.0).abs() < 1e-3, "{k}: {there} and {here}");
            counted += 1;
            reflections += u32::from(!refracts);
        }
        // Most do.
        assert!(counted > 10_000 && reflections > 5_000, "{counted} {reflections}");
    }
}
