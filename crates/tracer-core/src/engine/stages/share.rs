//! Pixels of an item share the second vertices of their paths.
//!
//! A path's first diffuse or glossy vertex x (after any mirrors and glass) is a *member*; where the ray that it casts meets a
//! diffuse surface, that point y with the light L that leaves it is a *suffix*. Every member i of a group (one item, the same
//! number of vertices before) could have cast a ray to every suffix j, with the density per area p_ij = q_i pdf_i cos_y / d^2, so
//! all of them are one estimate by the balance heuristic (Veach 1997), visibility V included:
//!
//! pixel i gets  w_i f_ij cos_x cos_y / d^2 V_ij L_j / sum_k q_k p_kj V_kj,
//!
//! w_i being what its path carries to x_i, q_i its chance to survive roulette. That is unbiased: whether a term is counted does not
//! depend on who has found it. Testing all 64 segments to a suffix would cost more than the paths. So the segments are put into
//! 16 classes ([`CLASSES`]), and those of one class, chosen by hash, are traced. When none is blocked, the sums are taken as if none at
//! all were: W. When one is, all others are traced too, which gives W', and W + (W' - W)/Q is taken, where Q, the share of classes
//! that hold a blocked segment, is the probability that this was noticed. The expectation is W'; single samples can be negative.
//! A suffix is always seen by the member that has found it.
//!
//! The rays' own densities count, so members that sample a glossy lobe join those that do not; glossy y, mirrors and glass behind x
//! and the light that the ray itself meets stay with the path's own pixel.

use super::materials::Bsdf;
use super::surface::Surface;
use crate::engine::batch::{Batch, Columns, Group, Item, Members, PATHS, Suffixes, member_kind, path};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::sampler::hash3;
use crate::scene::NONE;

/// The members of each class, a bit each: i, i / 4 and i / 16 mixed, so that a class is spread over the item.
const fn classes<const COUNT: usize>() -> [u64; COUNT] {
    let mut class = [0; COUNT];
    let mut i = 0;
    while i < 64 {
        class[(i ^ i >> 2 ^ i >> 4) & (COUNT - 1)] |= 1 << i;
        i += 1;
    }
    class
}

/// The classes. More of them would mean fewer segments, and stronger corrections where one is blocked.
static CLASSES: [u64; 16] = classes();

/// Adds the lanes of the mask to the members.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn add_members<F: Lanes>(
    members: &mut Members,
    bsdf: &Bsdf<F>,
    s: &Surface<F>,
    wo: V3<F>,
    weight: V3<F>,
    survival: F,
    slot: F::U,
    primitive: F::U,
    instance: F::U,
    mask: F::M,
) {
    let kind = F::U::splat;
    let raised = s.smooth & !s.start.sub(s.p).dot(s.ng).le(s.offset);
    let glossy = F::U::select(bsdf.conserving, kind(member_kind::CONSERVING), kind(member_kind::GLOSSY));
    let scatters = F::U::select(bsdf.glossy, glossy, kind(member_kind::DIFFUSE));
    let k = members.len;
    s.start.compress(mask, &mut members.start, k);
    s.ns.compress(mask, &mut members.normal, k);
    s.ng.compress(mask, &mut members.geometric, k);
    wo.compress(mask, &mut members.wo, k);
    weight.compress(mask, &mut members.weight, k);
    bsdf.parameter.compress(mask, &mut members.parameter[k..]);
    bsdf.specular.compress(mask, &mut members.specular[k..]);
    survival.compress(mask, &mut members.survival[k..]);
    F::U::select(raised, scatters | kind(member_kind::RAISED), scatters).compress(mask, &mut members.kind[k..]);
    slot.compress(mask, &mut members.slot[k..]);
    primitive.compress(mask, &mut members.primitive[k..]);
    instance.compress(mask, &mut members.instance[k..]);
    members.len += mask.count();
}

/// Adds the lanes of the mask to the suffixes.
#[inline(always)]
pub fn add_suffixes<F: Lanes>(
    suffixes: &mut Suffixes,
    s: &Surface<F>,
    distance: F,
    slot: F::U,
    primitive: F::U,
    instance: F::U,
    mask: F::M,
) {
    let k = suffixes.len;
    s.ng.mad(s.offset, s.p).compress(mask, &mut suffixes.point, k);
    s.ng.compress(mask, &mut suffixes.normal, k);
    distance.compress(mask, &mut suffixes.distance[k..]);
    (slot & F::U::splat(path::SLOT)).compress(mask, &mut suffixes.slot[k..]);
    primitive.compress(mask, &mut suffixes.primitive[k..]);
    instance.compress(mask, &mut suffixes.instance[k..]);
    suffixes.len += mask.count();
}

/// Which segments are to be traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Round {
    /// Those of one class per suffix.
    Look,
    /// All others of the suffixes where one was blocked.
    Rest,
}

/// The members whose segments to the suffix of a slot are looked at.
#[inline(always)]
fn looked_at(seed: u32, item_z: u32, item: &Item, slot: u32) -> u64 {
    let salt = hash3(seed, item.sample, 0x5e6_3e47) as u32;
    CLASSES[hash3(salt, item_z, slot & 63) as usize % CLASSES.len()]
}

/// A suffix, the same in all lanes.
struct Target<F: Lanes> {
    point: V3<F>,
    normal: V3<F>,
    slot: F::U,
}

impl<F: Lanes> Target<F> {
    #[inline(always)]
    fn new(suffixes: &Suffixes, j: usize) -> Self {
        let at = |columns: &Columns| [columns[0][j], columns[1][j], columns[2][j]];
        Target {
            point: V3::splat(at(&suffixes.point)),
            normal: V3::splat(at(&suffixes.normal)),
            slot: F::U::splat(suffixes.slot[j]),
        }
    }
}

/// The light that leaves suffix j.
#[inline(always)]
fn light(batch: &Batch, j: usize) -> [f32; 3] {
    let at = PATHS + batch.suffixes.slot[j] as usize;
    [batch.radiance[0][at], batch.radiance[1][at], batch.radiance[2][at]]
}

/// Nearer than its root nothing is told apart: render space is about one in size.
const LEAST_DISTANCE2: f32 = 1e-15;

/// Members i .. i + N seen from a suffix.
struct Pairs<F: Lanes> {
    /// From the member to the suffix.
    to: V3<F>,
    /// Its squared length.
    distance2: F,
    /// The cosines at both ends times the distance.
    cos_member: F,
    cos_suffix: F,
    /// The member that has found the suffix.
    own: F::M,
}

impl<F: Lanes> Pairs<F> {
    #[inline(always)]
    fn new(members: &Members, i: usize, target: &Target<F>) -> Self {
        let to = target.point.sub(V3::load(&members.start, i));
        Pairs {
            to,
            distance2: to.dot(to).max(F::splat(LEAST_DISTANCE2)),
            cos_member: V3::load(&members.normal, i).dot(to),
            cos_suffix: -target.normal.dot(to),
            own: F::U::load(&members.slot[i..]).eq(target.slot),
        }
    }
}

/// Fills `batch.segments` with rays from suffix `next` on; gives the suffix to go on with. The tag of a ray, in `slot`, is its
/// suffix times 64 plus its member's place in the group.
#[inline(always)]
pub fn share_segments<F: Lanes>(seed: u32, round: Round, next: usize, batch: &mut Batch) -> usize {
    let zero = F::splat(0.0);
    let (next, count) = list_pairs(seed, round, next, batch);
    let (members, suffixes, rays) = (&batch.members, &batch.suffixes, &mut batch.segments);
    rays.len = 0;
    for k in (0..count).step_by(F::N) {
        let tag = F::U::load(&batch.groups.pair_tag[k..]);
        let i = F::U::load(&batch.groups.pair_member[k..]);
        let j = tag.shr::<6>();
        let start = V3::<F>::gather_columns(&members.start, i);
        let to = V3::<F>::gather_columns(&suffixes.point, j).sub(start);
        let faces = zero.lt(V3::gather_columns(&members.normal, i).dot(to))
            & V3::<F>::gather_columns(&suffixes.normal, j).dot(to).lt(zero);
        let own = F::U::gather(&members.slot[..], i).eq(F::U::gather(&suffixes.slot[..], j));
        let cast = F::first(count - k) & faces & !own;
        let kind = F::U::gather(&members.kind[..], i);
        let raised = !(kind & F::U::splat(member_kind::RAISED)).eq(F::U::splat(0));
        let mut from = F::U::gather(&members.primitive[..], i);
        if raised.any() {
            let sinks = raised & V3::gather_columns(&members.geometric, i).dot(to).le(zero);
            from = F::U::select(sinks, F::U::splat(NONE), from);
        }
        let distance = to.dot(to).max(F::splat(LEAST_DISTANCE2)).sqrt();
        let k = rays.len;
        start.compress(cast, &mut rays.origin, k);
        to.scale(F::splat(1.0) / distance).compress(cast, &mut rays.direction, k);
        distance.compress(cast, &mut rays.t_max[k..]);
        from.compress(cast, &mut rays.from_primitive[k..]);
        F::U::gather(&members.instance[..], i).compress(cast, &mut rays.from_instance[k..]);
        F::U::gather(&suffixes.primitive[..], j).compress(cast, &mut rays.target_primitive[k..]);
        F::U::gather(&suffixes.instance[..], j).compress(cast, &mut rays.target_instance[k..]);
        tag.compress(cast, &mut rays.slot[k..]);
        rays.len += cast.count();
    }
    batch.counters.segments += rays.len as u64;
    next
}

/// Lists the pairs of suffixes from `next` on and members that are to be tested in this round, as many as fit; gives the suffix to go
/// on with, and how many pairs there are. Few of the members of a group are looked at, so they are gathered one by one: with whole
/// vectors of the group, of which four lanes in 64 were wanted, a room of spheres took a tenth longer in all.
#[inline(always)]
fn list_pairs(seed: u32, round: Round, next: usize, batch: &mut Batch) -> (usize, usize) {
    let (mut j, mut count) = (next, 0);
    while j < batch.suffixes.len && count + 64 <= PATHS {
        let idle = round == Round::Rest && batch.groups.blocked[j] == 0 || light(batch, j) == [0.0; 3];
        if !idle {
            let slot = batch.suffixes.slot[j];
            let item = (slot >> 6) as usize;
            let looked = looked_at(seed, batch.item_z[item], &batch.items[item], slot);
            let Group { first, len } = batch.groups.list[batch.groups.of_suffix[j] as usize];
            let mut wanted = (if round == Round::Look { looked } else { !looked }) & (u64::MAX >> (64 - len));
            while wanted != 0 {
                let place = wanted.trailing_zeros();
                wanted &= wanted - 1;
                batch.groups.pair_tag[count] = (j as u32) << 6 | place;
                batch.groups.pair_member[count] = first + place;
                count += 1;
            }
        }
        j += 1;
    }
    (j, count)
}

/// Gives every member its share of every suffix.
#[inline(always)]
pub fn share_gather<F: Lanes>(batch: &mut Batch) {
    for column in &mut batch.groups.gathered {
        column[..batch.members.len].fill(0.0);
    }
    for j in 0..batch.suffixes.len {
        let light = light(batch, j);
        if light == [0.0; 3] {
            continue;
        }
        let group = batch.groups.list[batch.groups.of_suffix[j] as usize];
        let blocked = batch.groups.blocked[j];
        let target = Target::<F>::new(&batch.suffixes, j);
        let mut pairs = PairTerms { density: [0.0; 64], value: [0.0; 64] };
        for base in (0..group.len as usize).step_by(F::N) {
            pairs.fill::<F>(&batch.members, group, base, &target);
        }
        let all = pairs.sum(0);
        let unblocked = if blocked == 0 { all } else { pairs.sum(blocked) };
        // A finder that could not have found it, by rounding.
        if unblocked <= 0.0 {
            continue;
        }
        // What a segment that is seen counts, and what one that is not.
        let (seen, hidden) = if blocked == 0 {
            (1.0 / all, 1.0 / all)
        } else {
            let mut noticing = 0;
            for class in &CLASSES {
                noticing += usize::from(class & blocked != 0);
            }
            let noticed = noticing as f32 / CLASSES.len() as f32;
            let untested = (1.0 - 1.0 / noticed) / all;
            (untested + 1.0 / (unblocked * noticed), untested)
        };
        let light = V3::<F>::splat(light);
        for base in (0..group.len as usize).step_by(F::N) {
            let i = group.first as usize + base;
            let hides = F::M::from_bits((blocked >> base) as u32 & F::first(F::N).bits());
            let share = F::load(&pairs.value[base..]) * F::select(hides, F::splat(hidden), F::splat(seen));
            let lit = V3::load(&batch.members.weight, i).mul(light).scale(share);
            // Beyond the group's end the share is zero.
            V3::load(&batch.groups.gathered, i).add(lit).store(&mut batch.groups.gathered, i);
        }
    }
}

/// Density and value of the pairs of one suffix, per member of the group; zero beyond its end.
struct PairTerms {
    density: [f32; 64],
    value: [f32; 64],
}

impl PairTerms {
    /// Members base .. base + N of the group.
    #[inline(always)]
    fn fill<F: Lanes>(&mut self, members: &Members, group: Group, base: usize, target: &Target<F>) {
        let c = F::splat;
        let i = group.first as usize + base;
        let lanes = F::first(group.len as usize - base);
        let p = Pairs::new(members, i, target);
        // The finder's cosines are positive but for rounding.
        let least = F::select(p.own, c(1e-12), c(0.0));
        let cos_member = p.cos_member.max(least);
        let cos_suffix = p.cos_suffix.max(least);
        // cos_member cos_suffix / (pi d^2), each cosine with its distance.
        let inverse = c(1.0) / p.distance2;
        let mut density = (cos_member * inverse) * (cos_suffix * inverse) * c(std::f32::consts::FRAC_1_PI);
        let mut value = density;
        let kind = F::U::load(&members.kind[i..]) & F::U::splat(member_kind::GLOSSY | member_kind::CONSERVING);
        let glossy = lanes & !kind.eq(F::U::splat(member_kind::DIFFUSE));
        if glossy.any() {
            let none = F::M::from_bits(0);
            let bsdf = Bsdf {
                color: V3::grey(c(1.0)),
                parameter: F::load(&members.parameter[i..]),
                specular: F::load(&members.specular[i..]),
                diffuse: lanes & !glossy,
                mirror: none,
                transparent: none,
                glossy,
                conserving: glossy & kind.eq(F::U::splat(member_kind::CONSERVING)),
            };
            let (ns, wo) = (V3::load(&members.normal, i), V3::load(&members.wo, i));
            let inverse_length = inverse.sqrt();
            let cos_i = cos_member * inverse_length;
            let (f, pdf) = bsdf.evaluate(ns, wo, p.to.scale(inverse_length), cos_i);
            let geometry = cos_suffix * inverse_length * inverse;
            let usable = glossy & c(0.0).lt(cos_member);
            density = F::select(glossy, F::select(usable, pdf * geometry, c(0.0)), density);
            value = F::select(glossy, F::select(usable, f.0 * cos_i * geometry, c(0.0)), value);
        }
        let survival = F::load(&members.survival[i..]);
        F::select(lanes, density * survival, c(0.0)).store(&mut self.density[base..]);
        F::select(lanes, value, c(0.0)).store(&mut self.value[base..]);
    }

    /// The sum of the densities that are not blocked, in an order that does not depend on the number of lanes.
    #[inline(always)]
    fn sum(&self, blocked: u64) -> f32 {
        let mut sums = [0.0f32; 16];
        for (row, densities) in self.density.chunks_exact(16).enumerate() {
            let bits = (blocked >> (16 * row)) as u32;
            for (k, &density) in densities.iter().enumerate() {
                sums[k] += if bits >> k & 1 == 0 { density } else { 0.0 };
            }
        }
        sum_of_16(&sums)
    }
}

#[inline(always)]
fn sum_of_16(x: &[f32; 16]) -> f32 {
    let mut half = [0.0f32; 8];
    for (k, sum) in half.iter_mut().enumerate() {
        *sum = x[k] + x[k + 8];
    }
    ((half[0] + half[4]) + (half[1] + half[5])) + ((half[2] + half[6]) + (half[3] + half[7]))
}
