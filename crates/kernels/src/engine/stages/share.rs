//! Pixels of an item share the second vertices of their paths.
//!
//! A path's first diffuse or glossy vertex x (after any mirrors and glass) is a *member*; where the ray that it casts
//! meets a diffuse surface, that point y with the light L that leaves it is a *suffix*. Every member i of a group (one
//! item, the same number of vertices before) could have cast a ray to every suffix j, with the density per area p_ij =
//! q_i pdf_i cos_y / d^2, so all of them are one estimate by the balance heuristic (Veach 1997), visibility V included:
//!
//! pixel i gets  w_i f_ij cos_x cos_y / d^2 V_ij L_j / sum_k p_kj V_kj,
//!
//! w_i being what its path carries to x_i, q_i its chance to survive roulette. That is unbiased: whether a term is
//! counted does not depend on who has found it. Every segment that counts is tested, so no sample is below zero and no
//! light comes through a wall. Spheres and the boxes under the tree's root, as far as they can be between
//! ([`super::shaft`]), are tested over lanes, for a whole group at once; where many segments have to be traced through
//! the tree, the suffix is shared by half of the group only, the finder's. To test a sixteenth of the segments and
//! correct what was wrong by sixteen times as much was a fifth to a half faster, and made pixels below zero and dots
//! along edges. A suffix is always seen by the member that has found it.
//!
//! The rays' own densities count, so members that sample a glossy lobe join those that do not; glossy y, mirrors and
//! glass behind x and the light that the ray itself meets stay with the path's own pixel.

use super::fan::Fan;
use super::materials::{Bsdf, Packed};
use super::reach::Slabs;
use super::shade::Vertex;
use super::shaft::{Ends, Left, Obstacles, Shaft};
use super::spheres::{Ray, large_blocks, small_blocks};
use crate::bvh::SecondBoxes;
use crate::engine::batch::{Batch, Columns, Group, Members, PATHS, RAISED, Shadows, Suffixes, path};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{ConductorTable, NONE, Scene};

/// Where more segments to a suffix than this have to be traced through the tree, it is shared by fewer members.
const MOST_TRACED: u32 = 32;
/// Those are every so many of the group's. With 16 and 4 instead of 32 and 2 the error of a matt mesh was half as large
/// again, for four fifths of the time; blurred by 1.5 pixels it was the same. To trace all of them took half as long
/// again.
const CLASSES: u32 = 2;

/// Where no more boxes than this are left of the tree's second level, segments that pass none of them are not traced.
/// What the tree is asked about does not change the picture. With 16 the time was the same, with all 64 what the tree
/// saves went into the boxes.
const MOST_BOXES: u32 = 6;

/// Adds the lanes of the mask to the members.
#[inline(always)]
pub fn add_members<F: Lanes>(members: &mut Members, at: &Vertex<'_, F>, weight: V3<F>, survival: F, mask: F::M) {
    let Vertex { ray, s, bsdf, wo, .. } = at;
    let Packed { kind, numbers } = bsdf.pack();
    let k = members.len;
    s.start.compress(mask, &mut members.start, k);
    s.ns.compress(mask, &mut members.normal, k);
    s.ng.compress(mask, &mut members.geometric, k);
    wo.compress(mask, &mut members.wo, k);
    weight.compress(mask, &mut members.weight, k);
    numbers[0].compress(mask, &mut members.numbers[0][k..]);
    numbers[1].compress(mask, &mut members.numbers[1][k..]);
    survival.compress(mask, &mut members.survival[k..]);
    F::U::select(s.raised(), kind | F::U::splat(RAISED), kind).compress(mask, &mut members.kind[k..]);
    ray.slot.compress(mask, &mut members.slot[k..]);
    ray.primitive.compress(mask, &mut members.primitive[k..]);
    ray.instance.compress(mask, &mut members.instance[k..]);
    members.smooth |= u64::from(s.smooth.bits());
    members.len += mask.count();
}

/// How members i .. i + N scatter, without colour.
#[inline(always)]
pub fn bsdf_of<F: Lanes>(members: &Members, i: usize, lanes: F::M) -> Bsdf<'static, F> {
    let [first, second] = &members.numbers;
    let numbers = [F::load(&first[i..]), F::load(&second[i..])];
    Bsdf::unpack(Packed { kind: F::U::load(&members.kind[i..]), numbers }, lanes)
}

/// The same of those that rays are aimed from: metals have their colours.
#[inline(always)]
pub fn colored_bsdf_of<'t, F: Lanes>(
    metals: Option<&'t ConductorTable>,
    aimers: &Members,
    i: usize,
    lanes: F::M,
) -> Bsdf<'t, F> {
    let bsdf = bsdf_of(aimers, i, lanes);
    let Some(table) = metals else { return bsdf };
    bsdf.metals(table, F::U::load(&aimers.kind[i..]), [0, 1].map(|of| V3::load(&aimers.colors[of], i)))
}

/// Of members i .. i + N those whose surface buries this direction: see [`super::surface::Surface::buries`].
#[inline(always)]
pub fn buried<F: Lanes>(members: &Members, i: usize, wi: V3<F>) -> F::M {
    let flat = (F::U::load(&members.kind[i..]) & F::U::splat(RAISED)).eq(F::U::splat(0));
    flat & V3::<F>::load(&members.geometric, i).dot(wi).le(F::splat(0.0))
}

/// Adds the lanes of the mask to the suffixes.
#[inline(always)]
pub fn add_suffixes<F: Lanes>(suffixes: &mut Suffixes, at: &Vertex<'_, F>, mask: F::M) {
    let Vertex { ray, s, .. } = at;
    let k = suffixes.len;
    s.ng.mad(s.offset, s.p).compress(mask, &mut suffixes.point, k);
    s.ng.compress(mask, &mut suffixes.normal, k);
    (ray.slot & F::U::splat(path::SLOT)).compress(mask, &mut suffixes.slot[k..]);
    ray.primitive.compress(mask, &mut suffixes.primitive[k..]);
    ray.instance.compress(mask, &mut suffixes.instance[k..]);
    suffixes.len += mask.count();
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
pub fn light(suffixes: &Suffixes, radiance: &Columns, j: usize) -> [f32; 3] {
    let at = PATHS + suffixes.slot[j] as usize;
    [radiance[0][at], radiance[1][at], radiance[2][at]]
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
        let mut cos_member = V3::load(&members.normal, i).dot(to);
        if members.smooth != 0 {
            cos_member = F::select(buried(members, i, to), F::splat(0.0), cos_member);
        }
        Pairs {
            to,
            distance2: to.dot(to).max(F::splat(LEAST_DISTANCE2)),
            cos_member,
            cos_suffix: -target.normal.dot(to),
            own: F::U::load(&members.slot[i..]).eq(target.slot),
        }
    }
}

/// The segments of a suffix, per member of its group.
struct Segments {
    direction: [[f32; 64]; 3],
    distance: [f32; 64],
    from: [u32; 64],
    /// Members that a sphere hides it from, a bit each.
    blocked: u64,
    /// Members from which the tree may hide it.
    reaching: u64,
    /// The member that has found it.
    own: u64,
}

impl Segments {
    /// Members base .. base + N of the group.
    #[inline(always)]
    #[allow(clippy::too_many_arguments)]
    fn add<F: Lanes>(
        &mut self,
        scene: &Scene,
        members: &Members,
        suffixes: &Suffixes,
        j: usize,
        group: Group,
        base: usize,
        left: Left,
    ) {
        let c = F::splat;
        let zero = c(0.0);
        let i = group.first as usize + base;
        let target = Target::<F>::new(suffixes, j);
        let p = Pairs::new(members, i, &target);
        let lanes = F::first(group.len as usize - base);
        let own = p.own & lanes;
        self.own |= u64::from(own.bits()) << base;
        // The others throw no light on it and get none.
        let faces = lanes & (own | (zero.lt(p.cos_member) & zero.lt(p.cos_suffix)));
        if !faces.any() {
            return;
        }
        let start = V3::<F>::load(&members.start, i);
        let kind = F::U::load(&members.kind[i..]);
        let raised = !(kind & F::U::splat(RAISED)).eq(F::U::splat(0));
        let sinks = raised & V3::<F>::load(&members.geometric, i).dot(p.to).le(zero);
        let from = F::U::select(sinks, F::U::splat(NONE), F::U::load(&members.primitive[i..]));
        let distance = p.distance2.sqrt();
        let direction = p.to.scale(c(1.0) / distance);
        let ray = Ray::<F>::new(start, direction, from);
        let hidden = faces & !own & blocked(scene, left, &ray, distance, suffixes.primitive[j]);
        self.blocked |= u64::from(hidden.bits()) << base;
        let Some(boxes) = scene.top_boxes.as_ref().filter(|_| left.top != 0) else { return };
        let reaching = faces & !hidden & Slabs::new(start, direction).pass_some(boxes, left.top, distance);
        if reaching.any() {
            self.reaching |= u64::from(reaching.bits()) << base;
            direction.0.store(&mut self.direction[0][base..]);
            direction.1.store(&mut self.direction[1][base..]);
            direction.2.store(&mut self.direction[2][base..]);
            distance.store(&mut self.distance[base..]);
            from.store(&mut self.from[base..]);
        }
    }

    /// Of the members with a bit set in the mask those whose segments pass one of the boxes that are left of the tree's
    /// second level.
    #[inline(always)]
    fn passing<F: Lanes>(&self, boxes: &SecondBoxes, left: u64, members: &Members, group: Group, mask: u64) -> u64 {
        let mut passing = 0;
        for base in (0..group.len as usize).step_by(F::N) {
            let lanes = F::M::from_bits((mask >> base) as u32) & F::first(F::N);
            if left != 0 && lanes.any() {
                let start = V3::<F>::load(&members.start, group.first as usize + base);
                let [x, y, z] = &self.direction;
                let direction = V3(F::load(&x[base..]), F::load(&y[base..]), F::load(&z[base..]));
                let slabs = Slabs::new(start, direction);
                let pass = lanes & slabs.pass_some(boxes, left, F::load(&self.distance[base..]));
                passing |= u64::from(pass.bits()) << base;
            }
        }
        passing
    }

    /// Adds a member's segment to the rays for the tree.
    #[inline(always)]
    fn list(&self, members: &Members, suffixes: &Suffixes, j: usize, group: Group, place: usize, rays: &mut Shadows) {
        let (k, i) = (rays.len, group.first as usize + place);
        for axis in 0..3 {
            rays.origin[axis][k] = members.start[axis][i];
            rays.direction[axis][k] = self.direction[axis][place];
        }
        rays.t_max[k] = self.distance[place];
        rays.from_primitive[k] = self.from[place];
        rays.from_instance[k] = members.instance[i];
        rays.target_primitive[k] = suffixes.primitive[j];
        rays.target_instance[k] = suffixes.instance[j];
        rays.slot[k] = (j as u32) << 6 | place as u32;
        rays.len += 1;
    }

    /// Who shares the suffix: the whole group, or every second member, the finder among them. Both depend on where
    /// the suffix and the members are, not on who has found it, so that whoever could have found it reckons alike.
    fn users(&self, len: u32) -> u64 {
        let all = u64::MAX >> (64 - len);
        if self.reaching.count_ones() <= MOST_TRACED {
            return all;
        }
        const EVERY: u64 = u64::MAX / ((1 << CLASSES) - 1);
        all & EVERY << (self.own.trailing_zeros() % CLASSES)
    }
}

/// Whether one of the spheres that are left blocks the way up to `t_max`.
#[inline(always)]
fn blocked<F: Lanes>(scene: &Scene, left: Left, ray: &Ray<F>, t_max: F, target: u32) -> F::M {
    let spheres = &scene.tables.spheres;
    let mut hidden = F::M::from_bits(0);
    for k in places(left.large) {
        hidden = hidden | large_blocks(&spheres.large[k], ray, t_max);
    }
    for k in places(left.small) {
        hidden = hidden | small_blocks(&spheres.small[k], ray, t_max);
    }
    if left.more {
        for s in spheres.large.iter().skip(Left::LARGE).filter(|s| s.id != target) {
            hidden = hidden | large_blocks(s, ray, t_max);
        }
    }
    hidden
}

/// Where bits are set.
#[inline(always)]
fn places(mut mask: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let place = mask.trailing_zeros() as usize;
        let any = mask != 0;
        mask &= mask.wrapping_sub(1);
        any.then_some(place)
    })
}

/// Finds out for the suffixes from `next` on who shares them and from whom spheres hide them, and fills
/// `batch.segments` with the segments that the tree is to be asked about; gives the suffix to go on with. The tag of a
/// segment, in `slot`, is its suffix times 64 plus its member's place in the group.
#[inline(always)]
pub fn share_segments<F: Lanes>(scene: &Scene, obstacles: &Obstacles, next: usize, batch: &mut Batch) -> usize {
    let (members, suffixes, rays) = (&*batch.members, &*batch.suffixes, &mut *batch.segments);
    rays.len = 0;
    let mut segments =
        Segments { direction: [[0.0; 64]; 3], distance: [0.0; 64], from: [0; 64], blocked: 0, reaching: 0, own: 0 };
    let mut fan = Fan::new();
    let (mut ends, mut ends_of) = (Ends::new(), u32::MAX);
    let mut j = next;
    while j < suffixes.len && rays.len + 64 <= PATHS {
        if light(suffixes, &batch.radiance, j) != [0.0; 3] {
            let of = batch.groups.of_suffix[j];
            let group = batch.groups.list[of as usize];
            if ends_of != of {
                ends.find::<F>(scene, members, group);
                ends_of = of;
            }
            let shaft = Shaft::new(&ends, std::array::from_fn(|axis| suffixes.point[axis][j]));
            let left = obstacles.left::<F>(scene, &ends, &shaft, suffixes.primitive[j]);
            (segments.blocked, segments.reaching, segments.own) = (0, 0, 0);
            if left.any() {
                for base in (0..group.len as usize).step_by(F::N) {
                    segments.add::<F>(scene, members, suffixes, j, group, base, left);
                }
            }
            let users = segments.users(group.len);
            batch.groups.hidden[j] = segments.blocked | !users;
            batch.counters.segments += u64::from(users.count_ones()) - 1;
            let mut traced = segments.reaching & users & !segments.own;
            if traced != 0 {
                let few = scene.occluders.as_ref().filter(|few| !few.may_be_covered(suffixes.primitive[j]));
                if let Some(few) = few
                    && fan.find::<F>(few, &ends, &shaft, suffixes.primitive[j])
                {
                    let others = obstacles.others_left::<F>(&shaft);
                    let beyond = segments.passing::<F>(&few.boxes, others, members, group, traced);
                    traced = beyond | fan.in_doubt::<F>(members, group, &segments.from, traced);
                } else if let Some(boxes) = &scene.second_boxes {
                    let second = obstacles.second_left::<F>(&shaft);
                    if second.count_ones() <= MOST_BOXES {
                        traced = segments.passing::<F>(boxes, second, members, group, traced);
                    }
                }
            }
            while traced != 0 {
                let place = traced.trailing_zeros() as usize;
                traced &= traced - 1;
                segments.list(members, suffixes, j, group, place, rays);
            }
        }
        j += 1;
    }
    j
}

/// Gives every member its share of every suffix.
#[inline(always)]
pub fn share_gather<F: Lanes>(batch: &mut Batch) {
    for column in batch.groups.gathered.iter_mut() {
        column[..batch.members.len].fill(0.0);
    }
    for j in 0..batch.suffixes.len {
        let light = light(&batch.suffixes, &batch.radiance, j);
        if light == [0.0; 3] {
            continue;
        }
        let group = batch.groups.list[batch.groups.of_suffix[j] as usize];
        let hidden = batch.groups.hidden[j];
        let target = Target::<F>::new(&batch.suffixes, j);
        let mut pairs = PairTerms { density: [0.0; 64], value: [0.0; 64] };
        for base in (0..group.len as usize).step_by(F::N) {
            pairs.fill::<F>(&batch.members, group, base, &target);
        }
        let density = pairs.sum(hidden);
        // A finder that could not have found it, by rounding.
        if density <= 0.0 {
            continue;
        }
        let light = V3::<F>::splat(light).scale(F::splat(1.0 / density));
        for base in (0..group.len as usize).step_by(F::N) {
            let i = group.first as usize + base;
            let hides = F::M::from_bits((hidden >> base) as u32 & F::first(F::N).bits());
            let share = F::select(hides, F::splat(0.0), F::load(&pairs.value[base..]));
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
        let glossy = Bsdf::<'_, F>::packed_glossy(F::U::load(&members.kind[i..]), lanes);
        if glossy.any() {
            let bsdf = bsdf_of::<F>(members, i, lanes);
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
