//! Rays aimed at where light comes from over mirrors, glass and glossy surfaces, from the rough vertices of paths: from
//! the first ones, and from [`LATE_AIMS`] behind them, so that there is room for all.
//!
//! From a rough vertex x one more ray is cast, by a chance that goes with the strength of that light, into a cone
//! around one of the spheres that the guide has for the place ([`crate::engine::guide`]), or around a caster; what it
//! meets first must be a mirror, glass or glossy surface, else it counts nothing: lamps are found by light samples, and
//! what diffuse surfaces send is shared ([`super::share`]). The two ways to find a direction w have the densities p(w),
//! that of the surface's own samples, and
//!
//! a(w) = chance sum_k c_k [w in cone k] / (solid angle of cone k),
//!
//! and each counts by the balance heuristic (Veach 1997, 9.2.2): the aimed ray f cos / (p + a), the own one by p / (p +
//! a). The chance c_k of a sphere goes with its share of the photons' flux (casters: with their solid angle) and a
//! bound on the cosine. Spheres that x is in or near to are not aimed at: the own ray meets them anyway.
//!
//! Roulette knows nothing of it: that the own ray of a later vertex goes on is by a chance that its weight takes out
//! again, so that both ways sum to one whatever the chance. What a path sees through several sides of glass is aimed
//! from, too; without it the brightest pixels were those of lamps over a mirror or glass from a surface that is itself
//! seen over one (docs/noise.md).

use super::materials::TWO_PI;
use super::points::{PairPoints, PixelOf};
use super::share::{bsdf_of, buried};
use crate::engine::batch::{BRANCHING, Batch, CAPACITY, LATE_AIMS, RAISED, path};
use crate::engine::guide::cells::{SPHERES, SphereRows};
use crate::engine::guide::{Guide, MOST_CASTERS};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::Purpose;
use crate::scene::NONE;

/// Chance that a ray is aimed where the guide has nothing, or knows of faint light only.
const LEAST_CHANCE: f32 = 0.1;
/// With s, the strength of light over mirrors and glass over what the lights send to the middle of a scene, the chance
/// is this times s / (s + 1), at most one: so rays are spent where the noise is. A ray from every vertex was twice as
/// many in a room of balls, for a fifth less error.
const STEEPNESS: f32 = 5.0;
/// Share of the aimed rays that goes to the casters' own spheres, where the guide knows something.
const TO_CASTERS: f32 = 0.1;
/// Cones wider than this are not aimed at: squared sine of half the angle.
const WIDEST: f32 = 0.75;
/// Cones are not narrower than this, by 1 - cos of half the angle: a thousandth of a radian, whose square single
/// precision tells to 1e-4.
const NARROWEST: f32 = 5e-7;

/// The cone from a point around a sphere.
#[derive(Clone, Copy)]
struct Cone<F: Lanes> {
    axis: V3<F>,
    /// 1 - cos of half its angle.
    width: F,
    /// The largest cosine to the normal of any of its directions, or more; 0: it is not aimed at.
    highest: F,
}

impl<F: Lanes> Cone<F> {
    #[inline(always)]
    fn new(center: V3<F>, radius2: F, p: V3<F>, n: V3<F>) -> Self {
        let c = F::splat;
        let one = c(1.0);
        let to = center.sub(p);
        let inverse2 = one / to.dot(to).max(c(1e-30));
        let axis = to.scale(inverse2.sqrt());
        let sin2 = (radius2 * inverse2).min(one);
        let width = (sin2 / (one + (one - sin2).sqrt())).max(c(NARROWEST));
        let highest = (n.dot(axis) + sin2.sqrt().max(c(1e-3))).max(c(0.0));
        Cone { axis, width, highest: F::select(sin2.lt(c(WIDEST)), highest, c(0.0)) }
    }

    /// Whether a direction lies within: 1 - cos as half the squared way between two unit vectors, which keeps its
    /// digits where it is small.
    #[inline(always)]
    fn holds(&self, w: V3<F>) -> F::M {
        let d = w.sub(self.axis);
        d.dot(d).le(self.width + self.width)
    }
}

/// The spheres that rays from some points may be aimed at, lane by lane: those of the guide's cell and the casters.
struct Targets<'a, F: Lanes> {
    guide: &'a Guide,
    p: V3<F>,
    n: V3<F>,
    /// First row of the cell.
    row: F::U,
    /// Chance that a ray is aimed.
    chance: F,
}

impl<'a, F: Lanes> Targets<'a, F> {
    #[inline(always)]
    fn new(guide: &'a Guide, p: V3<F>, n: V3<F>, mask: F::M) -> Self {
        let (cell, chance) = cell_and_chance(guide, p, mask);
        Targets { guide, p, n, row: cell * F::U::splat(SPHERES as u32), chance }
    }

    /// Sphere k of the cell, and its weight.
    #[inline(always)]
    fn of_cell(&self, k: usize) -> (Cone<F>, F) {
        let SphereRows { spheres, weight } = &self.guide.cells.rows;
        let row = self.row + F::U::splat(k as u32);
        let [x, y, z, radius2] = F::gather4(spheres, row.shl::<2>());
        let cone = Cone::new(V3(x, y, z), radius2, self.p, self.n);
        (cone, F::gather(weight, row) * cone.highest)
    }

    /// Caster k, and its weight.
    #[inline(always)]
    fn of_caster(&self, k: usize) -> (Cone<F>, F) {
        let [x, y, z, radius2] = self.guide.casters.splat(k);
        let cone = Cone::new(V3(x, y, z), radius2, self.p, self.n);
        (cone, cone.width * cone.highest)
    }
}

/// Cones and their weights: those of a cell, then those of the casters.
type Cones<F> = [(Cone<F>, F); SPHERES + MOST_CASTERS];

impl<F: Lanes> Targets<'_, F> {
    /// All spheres, so many casters among them, and the sums of the weights of both kinds.
    #[inline(always)]
    fn all(&self, casters: usize) -> (Cones<F>, [F; 2]) {
        let zero = F::splat(0.0);
        let none = Cone { axis: self.n, width: F::splat(1.0), highest: zero };
        let mut cones = [(none, zero); SPHERES + MOST_CASTERS];
        let mut sums = [zero; 2];
        for (k, cone) in cones.iter_mut().enumerate().take(SPHERES + casters) {
            *cone = if k < SPHERES { self.of_cell(k) } else { self.of_caster(k - SPHERES) };
            let sum = &mut sums[usize::from(k >= SPHERES)];
            *sum = *sum + cone.1;
        }
        (cones, sums)
    }
}

/// The guide's cells around points, and the chances that rays are aimed from there.
#[inline(always)]
fn cell_and_chance<F: Lanes>(guide: &Guide, p: V3<F>, mask: F::M) -> (F::U, F) {
    let c = F::splat;
    let cell = guide.cells.find(p, mask);
    let strength = F::gather(&guide.cells.strength, cell);
    let chance = (strength * c(STEEPNESS) / (strength + c(1.0))).max(c(LEAST_CHANCE)).min(c(1.0));
    (cell, chance)
}

/// The shares of cell and casters in the aimed rays, from the sums of their weights: one goes without the other.
#[inline(always)]
fn shares<F: Lanes>(of_cell: F, of_casters: F) -> (F, F) {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let known = zero.lt(of_cell);
    let casters = F::select(known, c(TO_CASTERS), one);
    let casters = F::select(zero.lt(of_casters), casters, zero);
    (F::select(known, one - casters, zero), casters)
}

#[inline(always)]
fn over<F: Lanes>(share: F, sum: F) -> F {
    F::select(F::splat(0.0).lt(sum), share / sum, F::splat(0.0))
}

/// Density in solid angle with which a ray from a rough vertex at p with shading normal n is aimed along w, for the
/// lanes of the mask.
#[inline(always)]
pub fn density<F: Lanes>(guide: &Guide, p: V3<F>, n: V3<F>, w: V3<F>, mask: F::M) -> F {
    let zero = F::splat(0.0);
    let targets = Targets::new(guide, p, n, mask);
    let (mut sums, mut within) = ([zero; 2], [zero; 2]);
    for k in 0..SPHERES {
        let (cone, weight) = targets.of_cell(k);
        sums[0] = sums[0] + weight;
        within[0] = within[0] + F::select(cone.holds(w), weight / cone.width, zero);
    }
    for k in 0..guide.casters.count() {
        let (cone, weight) = targets.of_caster(k);
        sums[1] = sums[1] + weight;
        within[1] = within[1] + F::select(cone.holds(w), weight / cone.width, zero);
    }
    let (of_cell, of_casters) = shares(sums[0], sums[1]);
    (within[0] * over(of_cell, sums[0]) + within[1] * over(of_casters, sums[1]))
        * (targets.chance * F::splat(1.0 / TWO_PI))
}

/// Leaves those of `batch.aimers` from which rays are aimed this time. `batch.next`, in which nothing is between two
/// vertices, has their cells in place of primitives, their chances in place of densities, and in place of `eta2` the
/// numbers that were below them.
#[inline(always)]
fn leave_by_chance<F: Lanes>(guide: &Guide, seed: u32, vertex: u32, batch: &mut Batch) {
    let choices = PairPoints::<F>::new(seed, Purpose::Aim(vertex), &batch.items);
    let (aimers, drawn) = (&mut *batch.aimers, &mut *batch.next);
    let mut left = 0;
    for i in (0..aimers.len).step_by(F::N) {
        let valid = F::first(aimers.len - i);
        let pixel = PixelOf::<F>::new(F::U::load(&aimers.slot[i..]), &batch.pixels);
        let (choice, _) = choices.points(&pixel);
        let (cell, chance) = cell_and_chance(guide, V3::<F>::load(&aimers.start, i), valid);
        let aims = valid & choice.lt(chance);
        cell.compress(aims, &mut drawn.from_primitive[left..]);
        chance.compress(aims, &mut drawn.pdf[left..]);
        choice.compress(aims, &mut drawn.eta2[left..]);
        if left < i || aims.count() < F::N {
            aimers.keep::<F>(i, aims, left);
        }
        left += aims.count();
    }
    aimers.len = left;
}

/// The last cone with any weight that begins at or below the threshold, and which it is; of a cell's weights and of the
/// casters' each counts by its scale.
#[inline(always)]
fn choose<F: Lanes>(cones: &[(Cone<F>, F)], scales: [F; 2], threshold: F, n: V3<F>) -> (Cone<F>, F::U) {
    let zero = F::splat(0.0);
    let mut below = zero;
    let mut taken = Cone { axis: n, width: zero, highest: zero };
    let mut which = F::U::splat(0);
    for (k, &(cone, weight)) in cones.iter().enumerate() {
        let takes = zero.lt(weight) & below.le(threshold);
        taken.axis = V3::select(takes, cone.axis, taken.axis);
        taken.width = F::select(takes, cone.width, taken.width);
        which = F::U::select(takes, F::U::splat(k as u32), which);
        below = below + weight * scales[usize::from(k >= SPHERES)];
    }
    (taken, which)
}

/// The sum of the weights over the widths of the cones that hold a direction: the one that was taken holds it whatever
/// rounding says.
#[inline(always)]
fn within<F: Lanes>(cones: &[(Cone<F>, F)], scales: [F; 2], taken: F::U, wi: V3<F>) -> F {
    let zero = F::splat(0.0);
    let mut sum = zero;
    for (k, &(cone, weight)) in cones.iter().enumerate() {
        let holds = cone.holds(wi) | taken.eq(F::U::splat(k as u32));
        sum = sum + F::select(holds, weight * scales[usize::from(k >= SPHERES)] / cone.width, zero);
    }
    sum
}

/// Adds rays aimed from `batch.aimers` to `batch.paths`.
#[inline(always)]
pub fn aim<F: Lanes>(guide: &Guide, seed: u32, vertex: u32, batch: &mut Batch) {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    if batch.aimers.len > 0 {
        leave_by_chance::<F>(guide, seed, vertex, batch);
    }
    if batch.aimers.len == 0 {
        return;
    }
    debug_assert!(batch.paths.len + batch.aimers.len <= CAPACITY - 64, "more paths than there is room for");
    let directions = PairPoints::<F>::new(seed, Purpose::AimedDirection(vertex), &batch.items);
    let (aimers, paths, drawn) = (&*batch.aimers, &mut *batch.paths, &*batch.next);
    let before = paths.len;
    let casters = guide.casters.count().min(MOST_CASTERS);
    for i in (0..aimers.len).step_by(F::N) {
        let slot = F::U::load(&aimers.slot[i..]);
        let pixel = PixelOf::<F>::new(slot, &batch.pixels);
        let mut aimed = F::first(aimers.len - i);
        let p = V3::<F>::load(&aimers.start, i);
        let n = V3::<F>::load(&aimers.normal, i);
        let row = F::U::load(&drawn.from_primitive[i..]) * F::U::splat(SPHERES as u32);
        let (choice, chance) = (F::load(&drawn.eta2[i..]), F::load(&drawn.pdf[i..]));
        let targets = Targets { guide, p, n, row, chance };
        let (cones, sums) = targets.all(casters);
        let cones = &cones[..SPHERES + casters];
        let (of_cell, of_casters) = shares(sums[0], sums[1]);
        let scales = [over(of_cell, sums[0]), over(of_casters, sums[1])];
        let (taken, which) = choose(cones, scales, choice / targets.chance * (of_cell + of_casters), n);
        let (u, v) = directions.points(&pixel);
        let wi = taken.axis.to_world(crate::sampling::warp::cone(u, v, taken.width));
        let cos = n.dot(wi);
        aimed = aimed & zero.lt(sums[0] + sums[1]) & zero.lt(cos);
        if !aimed.any() {
            continue;
        }
        let density = within(cones, scales, which, wi) * targets.chance * c(1.0 / TWO_PI);
        let bsdf = bsdf_of::<F>(aimers, i, aimed);
        let (f, by_itself) = bsdf.evaluate(n, V3::load(&aimers.wo, i), wi, cos);
        // What the own ray carried along this direction, and the weight apart, which roulette must not see: both ways
        // are one sum.
        aimed = aimed & zero.lt(by_itself) & !buried(aimers, i, wi);
        let by_itself = F::select(aimed, by_itself, one);
        let throughput = V3::<F>::load(&aimers.weight, i).scale(f.0 * cos / by_itself);
        let weight = by_itself / (by_itself + density);
        aimed = aimed & zero.lt(throughput.max_component());
        let kind = F::U::load(&aimers.kind[i..]);
        let raised = !(kind & F::U::splat(RAISED)).eq(F::U::splat(0));
        let sinks = raised & V3::<F>::load(&aimers.geometric, i).dot(wi).le(zero);
        let primitive = F::U::select(sinks, F::U::splat(NONE), F::U::load(&aimers.primitive[i..]));
        let sum = slot & F::U::splat(path::SUM);
        let shared = !(slot & F::U::splat(path::SHARED)).eq(F::U::splat(0));
        let late = if vertex < BRANCHING { 0 } else { LATE_AIMS * path::LATE };
        let state =
            F::U::select(shared, sum, sum | F::U::splat(path::OWN)) | F::U::splat(path::AIMED | path::SPECULAR | late);
        let k = paths.len;
        p.compress(aimed, &mut paths.origin, k);
        wi.compress(aimed, &mut paths.direction, k);
        throughput.compress(aimed, &mut paths.throughput, k);
        (F::load(&aimers.survival[i..]) * weight).compress(aimed, &mut paths.eta2[k..]);
        (F::load(&aimers.film[i..]) * cos / (by_itself + density)).compress(aimed, &mut paths.film[k..]);
        n.compress(aimed, &mut paths.normal, k);
        state.compress(aimed, &mut paths.slot[k..]);
        primitive.compress(aimed, &mut paths.from_primitive[k..]);
        F::U::load(&aimers.instance[i..]).compress(aimed, &mut paths.from_instance[k..]);
        paths.len += aimed.count();
    }
    batch.counters.scattered_rays += (batch.paths.len - before) as u64;
}

#[cfg(test)]
mod tests;
