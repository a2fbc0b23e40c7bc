//! Rays aimed at mirrors, glass and glossy surfaces from the first diffuse vertices of paths.
//!
//! What a member's own ray finds there is the one thing that pixels do not share ([`super::share`]): y is no Lambert surface, or there
//! is a mirror between. A quarter of the members send one more ray, into the cone around one of the casters' spheres; what it meets
//! first must be such a surface, else it counts nothing. For the Lambert lobe of a member x the two ways to find a direction w are
//!
//! p(w) = P(Lambert lobe) cos / pi,   a(w) = 1/4 sum_k c_k [w in cone k] / (solid angle of k),
//!
//! and each counts by the balance heuristic (Veach 1997, 9.2.2), the aimed one f cos / (p + a), the own one by p / (p + a). The chance
//! c_k of a caster goes with its solid angle and a bound on the cosine. Spheres that x is in or near to are not aimed at: the own ray
//! meets them anyway.

use super::materials::TWO_PI;
use super::points::{PairPoints, PixelOf};
use crate::engine::batch::{Batch, member_kind, path};
use crate::engine::caustics::aims::{Aims, MOST};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::Purpose;
use crate::scene::NONE;
use std::f32::consts::FRAC_1_PI;

/// Share of the members that aim.
const CHANCE: f32 = 0.25;
/// Cones wider than this are not aimed at: squared sine of half the angle.
const WIDEST: f32 = 0.75;
/// Cones narrower than this are not aimed at, by 1 - cos of half the angle: whether a direction lies within one is known to 1e-7 of that only.
const NARROWEST: f32 = 1e-4;

/// The cone from a point around a caster.
struct Cone<F: Lanes> {
    axis: V3<F>,
    /// 1 - cos of half its angle.
    width: F,
    /// Its chance, up to a factor; 0: it is not aimed at.
    weight: F,
}

impl<F: Lanes> Cone<F> {
    #[inline(always)]
    fn new(aims: &Aims, k: usize, p: V3<F>, n: V3<F>) -> Self {
        let c = F::splat;
        let one = c(1.0);
        let center = V3::<F>::splat([aims.center[0][k], aims.center[1][k], aims.center[2][k]]);
        let to = center.sub(p);
        let inverse2 = one / to.dot(to).max(c(1e-30));
        let axis = to.scale(inverse2.sqrt());
        let sin2 = (c(aims.radius2[k]) * inverse2).min(one);
        let width = sin2 / (one + (one - sin2).sqrt());
        let usable = sin2.lt(c(WIDEST)) & c(NARROWEST).lt(width);
        // No direction of the cone has a larger cosine.
        let highest = (n.dot(axis) + sin2.sqrt()).max(c(0.0));
        Cone { axis, width, weight: F::select(usable, width * highest, c(0.0)) }
    }
}

/// Density in solid angle with which a ray from a member at p with shading normal n is aimed along w.
#[inline(always)]
pub fn density<F: Lanes>(aims: &Aims, p: V3<F>, n: V3<F>, w: V3<F>) -> F {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let (mut sum, mut within) = (zero, zero);
    for k in 0..aims.len() {
        let cone = Cone::new(aims, k, p, n);
        let meets = (one - cone.width).le(w.dot(cone.axis)) & zero.lt(cone.weight);
        sum = sum + cone.weight;
        within = within + F::select(meets, cone.weight / cone.width, zero);
    }
    F::select(zero.lt(sum), within * c(CHANCE / TWO_PI) / sum, zero)
}

/// Adds aimed rays from the members from `first` on to `batch.paths`.
#[inline(always)]
pub fn aim<F: Lanes>(aims: &Aims, seed: u32, first: usize, batch: &mut Batch) {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let choices = PairPoints::<F>::new(seed, Purpose::Aim, &batch.items);
    let directions = PairPoints::<F>::new(seed, Purpose::AimedDirection, &batch.items);
    let (members, paths) = (&batch.members, &mut batch.paths);
    let before = paths.len;
    for i in (first..members.len).step_by(F::N) {
        let slot = F::U::load(&members.slot[i..]);
        let pixel = PixelOf::<F>::new(slot, &batch.item_z);
        let (choice, _) = choices.points(&pixel);
        let mut aimed = F::first(members.len - i) & choice.lt(c(CHANCE));
        if !aimed.any() {
            continue;
        }
        let p = V3::<F>::load(&members.start, i);
        let n = V3::<F>::load(&members.normal, i);
        let mut weights = [zero; MOST];
        let mut sum = zero;
        for (k, weight) in weights.iter_mut().enumerate().take(aims.len()) {
            *weight = Cone::new(aims, k, p, n).weight;
            sum = sum + *weight;
        }
        // The last with any weight that begins at or below this.
        let threshold = choice * c(1.0 / CHANCE) * sum;
        let mut below = zero;
        let (mut axis, mut width) = (n, zero);
        for (k, &weight) in weights.iter().enumerate().take(aims.len()) {
            let taken = zero.lt(weight) & below.le(threshold);
            if taken.any() {
                let cone = Cone::new(aims, k, p, n);
                axis = V3::select(taken, cone.axis, axis);
                width = F::select(taken, cone.width, width);
            }
            below = below + weight;
        }
        let (u, v) = directions.points(&pixel);
        let wi = axis.to_world(crate::sampling::warp::cone(u, v, width));
        let cos = n.dot(wi);
        aimed = aimed & zero.lt(sum) & zero.lt(cos);
        if !aimed.any() {
            continue;
        }
        // Lambert lobe: its f, and the density with which the own ray takes it.
        let kind = F::U::load(&members.kind[i..]);
        let specular = F::load(&members.specular[i..]);
        let conserving = !(kind & F::U::splat(member_kind::CONSERVING)).eq(F::U::splat(0));
        let glossy = conserving | !(kind & F::U::splat(member_kind::GLOSSY)).eq(F::U::splat(0));
        let lambert = F::select(glossy, one - specular, one);
        let lobe = F::select(conserving, specular, specular * c(4.0));
        let chance = F::select(glossy, lambert / (lobe + lambert), one);
        let by_itself = chance * cos * c(FRAC_1_PI);
        let value = lambert * cos * c(FRAC_1_PI) / (by_itself + density(aims, p, n, wi));
        let throughput = V3::<F>::load(&members.weight, i).scale(value);
        aimed = aimed & zero.lt(throughput.max_component());
        let raised = !(kind & F::U::splat(member_kind::RAISED)).eq(F::U::splat(0));
        let sinks = raised & V3::<F>::load(&members.geometric, i).dot(wi).le(zero);
        let primitive = F::U::select(sinks, F::U::splat(NONE), F::U::load(&members.primitive[i..]));
        let k = paths.len;
        p.compress(aimed, &mut paths.origin, k);
        wi.compress(aimed, &mut paths.direction, k);
        throughput.compress(aimed, &mut paths.throughput, k);
        one.compress(aimed, &mut paths.eta2[k..]);
        c(-1.0).compress(aimed, &mut paths.pdf[k..]);
        (slot | F::U::splat(path::OWN | path::MAPPED | path::AIMED)).compress(aimed, &mut paths.slot[k..]);
        primitive.compress(aimed, &mut paths.from_primitive[k..]);
        F::U::load(&members.instance[i..]).compress(aimed, &mut paths.from_instance[k..]);
        paths.len += aimed.count();
    }
    batch.counters.scattered_rays += (batch.paths.len - before) as u64;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::batch::{BLOCK_PIXELS, Item};
    use crate::lanes::ArrayF;
    use crate::sampling::sampler::z_order;

    type One = ArrayF<1>;

    /// Two spheres whose cones overlap, one half below the horizon, one that the point is in, one too small and one behind.
    fn spheres() -> Aims {
        let list: [([f32; 3], f32); 6] = [
            ([0.5, 0.3, 0.0], 0.2),
            ([1.0, 0.5, 0.2], 0.3),
            ([0.0, 0.05, 0.7], 0.25),
            ([0.0, 0.1, 0.0], 0.3),
            ([0.0, 0.9, 0.9], 0.01),
            ([0.2, -0.5, 0.1], 0.2),
        ];
        let mut aims = Aims { center: Default::default(), radius2: Vec::new() };
        for (center, radius) in list {
            (0..3).for_each(|k| aims.center[k].push(center[k]));
            aims.radius2.push(radius * radius);
        }
        aims
    }

    const UP: [f32; 3] = [0.0, 1.0, 0.0];

    fn density_of(w: [f32; 3]) -> f64 {
        let mut out = [0.0];
        density(&spheres(), V3::<One>::zero(), V3::splat(UP), V3::splat(w)).store(&mut out);
        f64::from(out[0])
    }

    /// Directions over the sphere by equal areas: 400 heights and 800 turns; gives each to `f` with its solid angle.
    fn over_directions(mut f: impl FnMut([f32; 3], f64)) {
        for i in 0..400 {
            for k in 0..800 {
                let (y, turn) =
                    ((f64::from(i) + 0.5) / 200.0 - 1.0, std::f64::consts::TAU * (f64::from(k) + 0.5) / 800.0);
                let r = (1.0 - y * y).sqrt();
                let w = [r * libm::cos(turn), y, r * libm::sin(turn)].map(|x| x as f32);
                f(w, 4.0 * std::f64::consts::PI / 320_000.0);
            }
        }
    }

    /// Some sphere is always aimed at here, so the density integrates to the chance to aim. The cones' borders are 6 long in all, the cells
    /// 0.006 wide: some 1000 of them are cut by a border, each right or wrong by half a cell of 4e-5 at random and a density of 0.25 at most.
    #[test]
    fn densities_integrate_to_the_chance_to_aim() {
        let mut sum = 0.0;
        over_directions(|w, area| sum += density_of(w) * area);
        assert!((sum - f64::from(CHANCE)).abs() < 4.0 * 0.5 * 4e-5 * 0.25 * 1000f64.sqrt() + 1e-4, "{sum}");
    }

    /// Members that all lie at one point: directions come with the density that is reckoned with, and count what the balance heuristic says.
    #[test]
    fn directions_have_the_density_that_is_reckoned_with() {
        let aims = spheres();
        let mut batch = Batch::new();
        let (mut area, mut squares, mut members) = (0.0, 0.0, 0.0);
        for sample in 0..256 {
            batch.items = vec![Item::new([16, 32], 1, sample)];
            batch.item_z[0] = batch.items[0].z();
            batch.paths.len = 0;
            batch.members.len = BLOCK_PIXELS;
            for k in 0..BLOCK_PIXELS {
                (0..3).for_each(|axis| batch.members.normal[axis][k] = UP[axis]);
                (0..3).for_each(|axis| batch.members.weight[axis][k] = 1.0);
                batch.members.kind[k] = member_kind::DIFFUSE;
                batch.members.slot[k] = k as u32;
            }
            aim::<One>(&aims, 5, 0, &mut batch);
            members += BLOCK_PIXELS as f64;
            for i in 0..batch.paths.len {
                let w = batch.paths.direction.each_ref().map(|column| column[i]);
                let a = density_of(w);
                let cos = f64::from(w[1]) / std::f64::consts::PI;
                assert!(a > 0.0 && cos > 0.0, "{w:?}: {a}");
                let counts = f64::from(batch.paths.throughput[0][i]);
                assert!((counts - cos / (cos + a)).abs() < 1e-5, "{w:?}: {counts}");
                area += 1.0 / a;
                squares += 1.0 / (a * a);
            }
        }
        // The mean of 1/density over all members is the area that may be aimed at. Stratified points spread less than independent ones, whose
        // standard error this is.
        let (mean, variance) = (area / members, (squares / members - (area / members).powi(2)) / members);
        let mut expected = 0.0;
        over_directions(|w, area| expected += if density_of(w) > 0.0 && w[1] > 0.0 { area } else { 0.0 });
        let rounding = 4.0 * 0.5 * 4e-5 * 1000f64.sqrt();
        assert!((mean - expected).abs() < 4.0 * variance.sqrt() + rounding, "{mean} {expected} {}", variance.sqrt());
    }
}
