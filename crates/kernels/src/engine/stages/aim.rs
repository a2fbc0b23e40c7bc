//! Rays aimed at where light comes from over mirrors, glass and glossy surfaces, from the rough vertices of paths: from
//! the first ones, and from [`LATE_AIMS`] behind them, so that there is room for all.
//!
//! From a rough vertex x one more ray is cast, by a chance that goes with the strength of that light, into a cone
//! around one of the spheres that the guide has for the place ([`crate::engine::guide`]), or around a caster; what it
//! meets first must be a mirror, glass or glossy surface, or the sky where the guide knows of it, else it counts
//! nothing: lamps are found by light samples, and what diffuse surfaces send is shared ([`super::share`]). The two ways
//! to find a direction w have the densities p(w), that of the surface's own samples, and
//!
//! a(w) = chance sum_k c_k s_k(w),
//! s_k(w) = (1 - [`AROUND`]) [w in cone k] / (solid angle of cone k) + AROUND [w around it] / (that around it),
//!
//! and each counts by the balance heuristic (Veach 1997, 9.2.2): the aimed ray f cos / (p + a), the own one by p / (p +
//! a). The chance c_k of a sphere goes with its share of the photons' flux (casters: with their solid angle, and none
//! around them) and a bound on the cosine. Spheres that x is in or near to are not aimed at: the own ray meets them
//! anyway.
//!
//! Roulette knows nothing of it: that the own ray of a later vertex goes on is by a chance that its weight takes out
//! again, so that both ways sum to one whatever the chance. Mirrors and glass spare aimed rays ([`path::SPARED`]). What
//! a path sees through several sides of glass is aimed from, too; without it the brightest pixels were those of lamps
//! over a mirror or glass from a surface that is itself seen over one (docs/noise.md). A sky that light samples find as
//! well counts by the power heuristic of p + a against theirs (`super::shade`).

use super::materials::TWO_PI;
use super::points::{PairPoints, PixelOf};
use super::share::{buried, colored_bsdf_of};
use crate::engine::batch::{BRANCHING, Batch, CAPACITY, LATE_AIMS, Paths, RAISED, path};
use crate::engine::guide::cells::{Cells, SPHERES, SphereRows};
use crate::engine::guide::{Guide, MOST_CASTERS};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::Purpose;
use crate::scene::{ConductorTable, NONE};

/// Share of the aimed rays that goes to the casters' own spheres, where the guide knows something.
const TO_CASTERS: f32 = 0.1;
/// Share of a cell's cone that goes into one [`WIDER`] times as large around it. Photons are few, and the spheres
/// around clusters of them leave gaps in the images that they stand for: own rays that met a lamp there counted for
/// nearly all that they brought, which a whole block shared as a cluster of dots (docs/noise.md).
const AROUND: f32 = 0.2;
/// The solid angle around a cone over its own: twice the angle.
const WIDER: f32 = 4.0;
/// The chance that a ray is aimed at the sky is this times as much where pixels share what it finds: of 64 it is most
/// of what they need, and each vertex that is lit is one more to share.
const OF_SHARED: f32 = 0.1;
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

    /// Whether a direction lies within, or within so many times its solid angle: 1 - cos as half the squared way
    /// between two unit vectors, which keeps its digits where it is small.
    #[inline(always)]
    fn holds(&self, w: V3<F>, wider: f32) -> F::M {
        let d = w.sub(self.axis);
        d.dot(d).le(self.width * F::splat(2.0 * wider))
    }

    /// The density of its directions and those around it, times its solid angle. A direction that was drawn within it
    /// or around it is so whatever rounding says.
    #[inline(always)]
    fn spread(&self, w: V3<F>, within: F::M, around: F::M) -> F {
        let c = F::splat;
        let inner = F::select(self.holds(w, 1.0) | within, c(1.0 - AROUND), c(0.0));
        inner + F::select(self.holds(w, WIDER) | around, c(AROUND / WIDER), c(0.0))
    }
}

/// Where rays from some points may be aimed, lane by lane: at the spheres of the guide's cell and at the casters, and
/// at the sky.
struct Targets<'a, F: Lanes> {
    guide: &'a Guide,
    p: V3<F>,
    n: V3<F>,
    /// Of both.
    places: [Place<F>; 2],
}

/// A cell, and the chance that a ray is aimed from there.
#[derive(Clone, Copy)]
struct Place<F: Lanes> {
    cell: F::U,
    chance: F,
}

impl<F: Lanes> Place<F> {
    #[inline(always)]
    fn none() -> Self {
        Place { cell: F::U::splat(0), chance: F::splat(0.0) }
    }

    /// That around points.
    #[inline(always)]
    fn new(cells: &Cells, p: V3<F>, mask: F::M) -> Self {
        let cell = cells.find(p, mask);
        Place { cell, chance: F::gather(&cells.chance, cell) }
    }

    /// With less of a chance where pixels share.
    #[inline(always)]
    fn less(self, shared: F::M) -> Self {
        let times = F::select(shared, F::splat(OF_SHARED), F::splat(1.0));
        Place { chance: self.chance * times, ..self }
    }
}

/// The cells of a guide around points, and of its sky. Of both chances not more than one is taken.
#[inline(always)]
fn places<F: Lanes>(guide: &Guide, p: V3<F>, mask: F::M, shared: F::M) -> [Place<F>; 2] {
    let (lights, sky) = match (&guide.lights, &guide.sky) {
        (Some(lights), Some(sky)) => (Place::new(lights, p, mask), Place::new(sky, p, mask).less(shared)),
        (Some(lights), None) => return [Place::new(lights, p, mask), Place::none()],
        (None, Some(sky)) => return [Place::none(), Place::new(sky, p, mask).less(shared)],
        (None, None) => return [Place::none(); 2],
    };
    let one = F::splat(1.0);
    let most = one / (lights.chance + sky.chance).max(one);
    [lights, sky].map(|Place { cell, chance }| Place { cell, chance: chance * most })
}

impl<F: Lanes> Targets<'_, F> {
    /// Cone k of one kind of cell, and its weight.
    #[inline(always)]
    fn of_cell(&self, cells: &Cells, place: &Place<F>, k: usize) -> (Cone<F>, F) {
        let SphereRows { spheres, weight } = &cells.rows;
        let row = place.cell * F::U::splat(SPHERES as u32) + F::U::splat(k as u32);
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

    /// All cones, those of cells first, and the sums of the weights of each kind.
    #[inline(always)]
    fn all(&self, casters: usize) -> (Cones<F>, [F; 3]) {
        let zero = F::splat(0.0);
        let none = Cone { axis: self.n, width: F::splat(1.0), highest: zero };
        let mut cones = [(none, zero); 2 * SPHERES + MOST_CASTERS];
        let mut sums = [zero; 3];
        let mut at = 0;
        for kind in [LIGHTS, SKY] {
            let Some(cells) = cells_of(self.guide, kind) else { continue };
            for k in 0..SPHERES {
                cones[at] = self.of_cell(cells, &self.places[kind], k);
                sums[kind] = sums[kind] + cones[at].1;
                at += 1;
            }
        }
        for k in 0..casters {
            cones[at] = self.of_caster(k);
            sums[CASTERS] = sums[CASTERS] + cones[at].1;
            at += 1;
        }
        (cones, sums)
    }

    /// What the weights of each kind are multiplied by: the chances to be aimed at, by the sums of their weights. The
    /// cell and the casters share theirs: one goes without the other.
    #[inline(always)]
    fn scales(&self, sums: [F; 3]) -> [F; 3] {
        let c = F::splat;
        let (zero, one) = (c(0.0), c(1.0));
        let [lights, sky] = self.places;
        let known = zero.lt(sums[LIGHTS]);
        let casters = F::select(known, c(TO_CASTERS), one);
        let casters = F::select(zero.lt(sums[CASTERS]), casters, zero);
        [
            over((one - casters) * lights.chance, sums[LIGHTS]),
            over(sky.chance, sums[SKY]),
            over(casters * lights.chance, sums[CASTERS]),
        ]
    }
}

/// Kinds of cones: of a cell for lights over mirrors and glass, of one for the sky, of casters.
const LIGHTS: usize = 0;
const SKY: usize = 1;
const CASTERS: usize = 2;

/// Cones and their weights, in the order of their kinds.
type Cones<F> = [(Cone<F>, F); 2 * SPHERES + MOST_CASTERS];

/// Of a kind of cones, where there are any.
#[inline(always)]
fn cells_of(guide: &Guide, kind: usize) -> Option<&Cells> {
    if kind == LIGHTS { guide.lights.as_ref() } else { guide.sky.as_ref() }
}

/// Which cones a guide has.
#[derive(Clone, Copy)]
struct Kinds {
    /// The kind of the first ones.
    first: usize,
    /// So many are of cells, [`SPHERES`] of a kind; the rest are casters'.
    of_cells: usize,
}

impl Kinds {
    #[inline(always)]
    fn new(guide: &Guide) -> Self {
        let count = [LIGHTS, SKY].into_iter().filter(|&kind| cells_of(guide, kind).is_some()).count();
        Kinds { first: if guide.lights.is_some() { LIGHTS } else { SKY }, of_cells: count * SPHERES }
    }

    /// That of cone k.
    #[inline(always)]
    fn of(&self, k: usize) -> usize {
        if k >= self.of_cells { CASTERS } else { self.first + k / SPHERES }
    }
}

#[inline(always)]
fn over<F: Lanes>(share: F, sum: F) -> F {
    F::select(F::splat(0.0).lt(sum), share / sum, F::splat(0.0))
}

/// Rough vertices from which rays may be aimed, lane by lane.
#[derive(Clone, Copy)]
pub struct From<F: Lanes> {
    /// Where.
    pub p: V3<F>,
    /// The shading normal.
    pub n: V3<F>,
    /// Lanes whose light pixels share.
    pub shared: F::M,
}

/// Lanes of paths whose light pixels share.
#[inline(always)]
pub fn is_shared<F: Lanes>(slot: F::U) -> F::M {
    !(slot & F::U::splat(path::SHARED)).eq(F::U::splat(0))
}

/// Density in solid angle with which a ray is aimed along w, for the lanes of the mask.
#[inline(always)]
pub fn density<F: Lanes>(guide: &Guide, from: From<F>, w: V3<F>, mask: F::M) -> F {
    let From { p, n, shared } = from;
    let zero = F::splat(0.0);
    let targets = Targets { guide, p, n, places: places(guide, p, mask, shared) };
    let (mut sums, mut within) = ([zero; 3], [zero; 3]);
    let none = F::first(0);
    for kind in [LIGHTS, SKY] {
        let Some(cells) = cells_of(guide, kind) else { continue };
        for k in 0..SPHERES {
            let (cone, weight) = targets.of_cell(cells, &targets.places[kind], k);
            sums[kind] = sums[kind] + weight;
            within[kind] = within[kind] + cone.spread(w, none, none) * weight / cone.width;
        }
    }
    for k in 0..guide.casters.count() {
        let (cone, weight) = targets.of_caster(k);
        sums[CASTERS] = sums[CASTERS] + weight;
        within[CASTERS] = within[CASTERS] + F::select(cone.holds(w, 1.0), weight / cone.width, zero);
    }
    let scales = targets.scales(sums);
    let mut density = within[LIGHTS].fma(scales[LIGHTS], within[CASTERS] * scales[CASTERS]);
    if guide.sky.is_some() {
        density = within[SKY].fma(scales[SKY], density);
    }
    density * F::splat(1.0 / TWO_PI)
}

/// Leaves those of `batch.aimers` from which rays are aimed this time. `batch.next`, in which nothing is between two
/// vertices, has their cells in place of primitives and instances, their chances in place of densities and weights on
/// the film, and in place of `eta2` the numbers that were below them.
#[inline(always)]
fn leave_by_chance<F: Lanes>(guide: &Guide, seed: u32, vertex: u32, metals: bool, batch: &mut Batch) {
    let choices = PairPoints::<F>::new(seed, Purpose::Aim(vertex), &batch.items);
    let (aimers, drawn) = (&mut *batch.aimers, &mut *batch.next);
    let mut left = 0;
    for i in (0..aimers.len).step_by(F::N) {
        let valid = F::first(aimers.len - i);
        let slot = F::U::load(&aimers.slot[i..]);
        let pixel = PixelOf::<F>::new(slot, &batch.pixels);
        let (choice, _) = choices.points(&pixel);
        let [lights, sky] = places(guide, V3::<F>::load(&aimers.start, i), valid, is_shared::<F>(slot));
        let aims = valid & choice.lt(lights.chance + sky.chance);
        lights.cell.compress(aims, &mut drawn.from_primitive[left..]);
        lights.chance.compress(aims, &mut drawn.pdf[left..]);
        if guide.sky.is_some() {
            sky.cell.compress(aims, &mut drawn.from_instance[left..]);
            sky.chance.compress(aims, &mut drawn.film[left..]);
        }
        choice.compress(aims, &mut drawn.eta2[left..]);
        if left < i || aims.count() < F::N {
            aimers.keep::<F>(i, aims, left, metals);
        }
        left += aims.count();
    }
    aimers.len = left;
}

/// Those of [`leave_by_chance`].
#[inline(always)]
fn drawn_places<F: Lanes>(guide: &Guide, drawn: &Paths, i: usize) -> [Place<F>; 2] {
    let lights = Place { cell: F::U::load(&drawn.from_primitive[i..]), chance: F::load(&drawn.pdf[i..]) };
    if guide.sky.is_none() {
        return [lights, Place::none()];
    }
    [lights, Place { cell: F::U::load(&drawn.from_instance[i..]), chance: F::load(&drawn.film[i..]) }]
}

/// What a ray is aimed into, lane by lane.
struct Taken<F: Lanes> {
    axis: V3<F>,
    /// 1 - cos of half the angle.
    width: F,
    /// Which cone it is.
    which: F::U,
    /// Where it is the one around that.
    around: F::M,
    /// Lanes that have one.
    any: F::M,
}

/// The last cone with any share that begins at or below the choice, or the one around it where less than its part of
/// the share is left; where the choice is not below the shares' sum there is none. Of the cones the first are cells'.
#[inline(always)]
fn choose<F: Lanes>(cones: &[(Cone<F>, F)], of_cells: usize, choice: F, n: V3<F>) -> Taken<F> {
    let zero = F::splat(0.0);
    let mut below = zero;
    let none = F::first(0);
    let mut taken = Taken { axis: n, width: zero, which: F::U::splat(0), around: none, any: none };
    for (k, &(cone, share)) in cones.iter().enumerate() {
        let takes = zero.lt(share) & below.le(choice);
        taken.axis = V3::select(takes, cone.axis, taken.axis);
        taken.width = F::select(takes, cone.width, taken.width);
        taken.which = F::U::select(takes, F::U::splat(k as u32), taken.which);
        taken.around = taken.around & !takes;
        if k < of_cells {
            taken.around = taken.around | takes & (choice - below).lt(share * F::splat(AROUND));
        }
        below = below + share;
    }
    let wider = (taken.width * F::splat(WIDER)).min(F::splat(2.0));
    taken.width = F::select(taken.around, wider, taken.width);
    taken.any = choice.lt(below);
    taken
}

/// The sum of the shares times the densities of the cones that hold a direction, or that hold it around them: what was
/// taken holds it.
#[inline(always)]
fn within<F: Lanes>(cones: &[(Cone<F>, F)], of_cells: usize, taken: &Taken<F>, wi: V3<F>) -> F {
    let zero = F::splat(0.0);
    let mut sum = zero;
    for (k, &(cone, share)) in cones.iter().enumerate() {
        let own = taken.which.eq(F::U::splat(k as u32));
        let holds = if k < of_cells {
            cone.spread(wi, own & !taken.around, own)
        } else {
            F::select(cone.holds(wi, 1.0) | own, F::splat(1.0), zero)
        };
        sum = sum + holds * share / cone.width;
    }
    sum
}

/// Adds rays aimed from `batch.aimers` to `batch.paths`; `metals`: the table of metals, where there may be some.
#[inline(always)]
pub fn aim<F: Lanes>(metals: Option<&ConductorTable>, guide: &Guide, seed: u32, vertex: u32, batch: &mut Batch) {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    if batch.aimers.len > 0 {
        leave_by_chance::<F>(guide, seed, vertex, metals.is_some(), batch);
    }
    if batch.aimers.len == 0 {
        return;
    }
    debug_assert!(batch.paths.len + batch.aimers.len <= CAPACITY - 64, "more paths than there is room for");
    let directions = PairPoints::<F>::new(seed, Purpose::AimedDirection(vertex), &batch.items);
    let (aimers, paths, drawn) = (&*batch.aimers, &mut *batch.paths, &*batch.next);
    let before = paths.len;
    let casters = guide.casters.count().min(MOST_CASTERS);
    let kinds = Kinds::new(guide);
    for i in (0..aimers.len).step_by(F::N) {
        let slot = F::U::load(&aimers.slot[i..]);
        let pixel = PixelOf::<F>::new(slot, &batch.pixels);
        let mut aimed = F::first(aimers.len - i);
        let p = V3::<F>::load(&aimers.start, i);
        let n = V3::<F>::load(&aimers.normal, i);
        let targets = Targets { guide, p, n, places: drawn_places(guide, drawn, i) };
        let (mut cones, sums) = targets.all(casters);
        let cones = &mut cones[..kinds.of_cells + casters];
        let scales = targets.scales(sums);
        cones.iter_mut().enumerate().for_each(|(k, (_, weight))| *weight = *weight * scales[kinds.of(k)]);
        let taken = choose(cones, kinds.of_cells, F::load(&drawn.eta2[i..]), n);
        let (u, v) = directions.points(&pixel);
        let wi = taken.axis.to_world(crate::sampling::warp::cone(u, v, taken.width));
        let cos = n.dot(wi);
        aimed = aimed & taken.any & zero.lt(cos);
        if !aimed.any() {
            continue;
        }
        let density = within(cones, kinds.of_cells, &taken, wi) * c(1.0 / TWO_PI);
        let bsdf = colored_bsdf_of(metals, aimers, i, aimed);
        let (f, by_itself) = bsdf.evaluate(n, V3::load(&aimers.wo, i), wi, cos);
        // What the own ray carried along this direction, and the weight apart, which roulette must not see: both ways
        // are one sum.
        aimed = aimed & zero.lt(by_itself) & !buried(aimers, i, wi);
        let by_itself = F::select(aimed, by_itself, one);
        let throughput = V3::<F>::load(&aimers.weight, i).mul(f).scale(cos / by_itself);
        let weight = by_itself / (by_itself + density);
        aimed = aimed & zero.lt(throughput.max_component());
        let kind = F::U::load(&aimers.kind[i..]);
        let raised = !(kind & F::U::splat(RAISED)).eq(F::U::splat(0));
        let sinks = raised & V3::<F>::load(&aimers.geometric, i).dot(wi).le(zero);
        let primitive = F::U::select(sinks, F::U::splat(NONE), F::U::load(&aimers.primitive[i..]));
        let sum = slot & F::U::splat(path::SUM);
        let shared = is_shared::<F>(slot);
        let late = if vertex < BRANCHING { 0 } else { LATE_AIMS * path::LATE };
        let state = F::U::select(shared, sum, sum | F::U::splat(path::OWN))
            | F::U::splat(path::AIMED | path::SPARED | path::SPECULAR | late);
        let k = paths.len;
        p.compress(aimed, &mut paths.origin, k);
        wi.compress(aimed, &mut paths.direction, k);
        throughput.compress(aimed, &mut paths.throughput, k);
        (F::load(&aimers.survival[i..]) * weight).compress(aimed, &mut paths.eta2[k..]);
        (F::load(&aimers.film[i..]) * cos / (by_itself + density)).compress(aimed, &mut paths.film[k..]);
        if guide.sky.is_some() {
            (by_itself + density).compress(aimed, &mut paths.pdf[k..]);
        }
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
