//! What can stand between a suffix and its group at all: one test for all their segments, where there are sixty-four.
//!
//! The segments from a point y to the members of a group lie in the *shaft* of y and the bounds B of the members'
//! points (Haines and Wallace: Shaft Culling for Efficient Ray-Traced Radiosity, 1991): the union of the boxes y + t
//! (B - y), t from 0 to 1. An object that the shaft misses is not asked about. The answers are the same to the last
//! bit, so the tests here may keep too much and never too little.

use crate::bvh::Boxes;
use crate::engine::batch::{Group, Members};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{LargeSphere, NONE, Scene};

/// 2^-17: by this part of the coordinates boxes are padded. A slab test (`reach`) finds a ray in a box that it passes
/// at 2^-19 of its origin's largest coordinate and some 2^-20 of all coordinates, the roundings of its direction among
/// them; small spheres are off by less. The shaft's own roundings are some 2^-20. That is half of it.
const PAD: f32 = 1.0 / 131_072.0;
/// 2^-16: by this part of its terms a large sphere's F has to be clear of zero. F itself, and what is made of it in
/// `spheres::blocked`, is off by a fifth of that.
const MARGIN: f32 = 1.0 / 65_536.0;
/// In place of zero, whose inverse is infinite: the bounds become as much wider.
const TINY: f32 = 1e-18;
/// Boxes or spheres in a table: a bit each in a word.
const PLACES: usize = 64;
/// Top boxes come first, the boxes of small spheres after them.
const TOP: usize = 8;

/// Columns of boxes, padded for what their own coordinates make wrong. Places that are not used hold boxes that nothing
/// meets.
struct Table {
    planes: [[f32; PLACES]; 6],
    len: usize,
}

impl Table {
    fn new() -> Self {
        let (lower, upper) = ([f32::INFINITY; PLACES], [f32::NEG_INFINITY; PLACES]);
        Table { planes: [lower, upper, lower, upper, lower, upper], len: 0 }
    }

    /// A box: x lower, x upper, y lower and so on.
    fn set(&mut self, place: usize, planes: [f32; 6]) {
        let pad = PAD * planes.iter().fold(0.0, |largest: f32, plane| largest.max(plane.abs()));
        for (k, (column, plane)) in self.planes.iter_mut().zip(planes).enumerate() {
            column[place] = if k % 2 == 0 { plane - pad } else { plane + pad };
        }
        self.len = self.len.max(place + 1);
    }

    /// All places, a bit each.
    fn all(&self) -> u64 {
        u64::MAX.checked_shr(64 - self.len as u32).unwrap_or(0)
    }

    fn set_all<const N: usize>(&mut self, boxes: &Boxes<N>) {
        for k in 0..boxes.len {
            self.set(k, boxes.planes.map(|column| column[k]));
        }
    }
}

/// Columns of large spheres; see `scene::sphere`.
struct LargeTable {
    k: [f32; PLACES],
    m: [[f32; PLACES]; 3],
    c: [f32; PLACES],
    id: [u32; PLACES],
    len: usize,
}

/// All that may stand between members and suffixes.
pub struct Obstacles {
    /// Top boxes and small spheres.
    boxes: Table,
    /// The top boxes' bits.
    top: u64,
    small: [u32; PLACES],
    second: Table,
    /// What is no triangle, where the tree holds little.
    others: Table,
    large: LargeTable,
}

/// What a shaft leaves, a bit each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Left {
    /// Of the first large spheres; those beyond are always left.
    pub large: u64,
    /// Of the small spheres.
    pub small: u64,
    /// Of the boxes under the tree's root.
    pub top: u64,
    /// There are more large spheres.
    pub more: bool,
}

impl Left {
    /// Large spheres beyond so many are always left.
    pub const LARGE: usize = PLACES;

    /// Whether anything is.
    pub fn any(&self) -> bool {
        (self.large | self.small | self.top) != 0 || self.more
    }
}

impl Obstacles {
    /// Those of a scene.
    pub fn new(scene: &Scene) -> Self {
        let spheres = &scene.tables.spheres;
        let mut boxes = Table::new();
        if let Some(top) = &scene.top_boxes {
            boxes.set_all(top);
        }
        let top = boxes.all();
        let mut small = [NONE; PLACES];
        for (k, s) in spheres.small.iter().take(PLACES - TOP).enumerate() {
            let r = s.r2.sqrt();
            let [x, y, z] = s.center;
            boxes.set(TOP + k, [x - r, x + r, y - r, y + r, z - r, z + r]);
            small[TOP + k] = s.id;
        }
        let mut large = LargeTable::new();
        spheres.large.iter().take(PLACES).for_each(|s| large.push(s));
        let mut second = Table::new();
        if let Some(below) = &scene.second_boxes {
            second.set_all(below);
        }
        let mut others = Table::new();
        if let Some(few) = &scene.occluders {
            others.set_all(&few.boxes);
        }
        Obstacles { boxes, top, small, second, others, large }
    }

    /// What may stand between a group and a point on a primitive.
    #[inline(always)]
    pub fn left<F: Lanes>(&self, scene: &Scene, ends: &Ends, shaft: &Shaft, primitive: u32) -> Left {
        let met = shaft.meets::<F>(&self.boxes);
        let mut small = met >> TOP;
        // The suffix's own sphere does not hide it.
        for (k, &id) in self.small.iter().take(self.boxes.len).skip(TOP).enumerate() {
            small &= !(u64::from(id == primitive) << k);
        }
        let large = self.large.left::<F>(ends, shaft, primitive);
        let more = scene.tables.spheres.large.len() > PLACES;
        Left { large, small, top: met & self.top, more }
    }

    /// Boxes of what is no triangle in a tree that holds little, which the shaft meets.
    #[inline(always)]
    pub fn others_left<F: Lanes>(&self, shaft: &Shaft) -> u64 {
        shaft.meets::<F>(&self.others)
    }

    /// Boxes of the tree's second level that the shaft meets.
    #[inline(always)]
    pub fn second_left<F: Lanes>(&self, shaft: &Shaft) -> u64 {
        shaft.meets::<F>(&self.second)
    }
}

impl LargeTable {
    fn new() -> Self {
        let zero = [0.0; PLACES];
        LargeTable { k: zero, m: [zero; 3], c: zero, id: [NONE; PLACES], len: 0 }
    }

    fn push(&mut self, s: &LargeSphere) {
        let k = self.len;
        (self.k[k], self.c[k], self.id[k]) = (s.k, s.c, s.id);
        (0..3).for_each(|axis| self.m[axis][k] = s.m[axis]);
        self.len += 1;
    }

    /// Those that may hide a point on a primitive. Along a segment of length d that ends in y, F is F(y) - 2 b s + k
    /// s^2, s from y on.
    #[inline(always)]
    fn left<F: Lanes>(&self, ends: &Ends, shaft: &Shaft, primitive: u32) -> u64 {
        let (c, zero) = (F::splat, F::splat(0.0));
        let y = V3::<F>::splat(shaft.y);
        let (size, yy) = (c(shaft.magnitude), y.dot(y));
        let mut left = 0;
        for base in (0..self.len).step_by(F::N) {
            let k = F::load(&self.k[base..]);
            let m = V3(F::load(&self.m[0][base..]), F::load(&self.m[1][base..]), F::load(&self.m[2][base..]));
            let constant = F::load(&self.c[base..]);
            let my = m.dot(y);
            let f = yy.fma(k, (my + my) + constant);
            let slope = m.abs().0 + m.abs().1 + m.abs().2;
            let terms = size.fma(size.fma(k, slope + slope), constant.abs());
            let margin = terms * c(MARGIN);
            // F falls by k d^2 at most on the way from its lowest point, where it does not fall, to the end: where one
            // end is above that and the other not inside, nothing between is.
            let fall = c(shaft.length2).fma(k, margin);
            let (least, most) = (F::load(&ends.least[base..]), F::load(&ends.most[base..]));
            let outside = zero.le(least) & fall.lt(f);
            let far = margin.lt(f) & fall.lt(least);
            // It is convex: between two points inside all are.
            let inside = most.lt(zero) & f.lt(-margin);
            let own = F::U::load(&self.id[base..]).eq(F::U::splat(primitive));
            let lanes = !(outside | far | inside | own) & F::first(self.len - base);
            left |= u64::from(lanes.bits()) << base;
        }
        left
    }
}

/// The points of a group's members.
pub struct Ends {
    pub lower: [f32; 3],
    pub upper: [f32; 3],
    /// Not less than any coordinate; not finite where one is not.
    magnitude: f32,
    /// Least and greatest F of each large sphere; of members on it 0 and -1.
    least: [f32; PLACES],
    most: [f32; PLACES],
}

impl Ends {
    /// Of no group.
    pub fn new() -> Self {
        let none = [0.0; PLACES];
        Ends { lower: [0.0; 3], upper: [0.0; 3], magnitude: 0.0, least: none, most: none }
    }

    /// Of a group.
    #[inline(always)]
    pub fn find<F: Lanes>(&mut self, scene: &Scene, members: &Members, group: Group) {
        self.bound::<F>(members, group);
        for (k, s) in scene.tables.spheres.large.iter().take(PLACES).enumerate() {
            (self.least[k], self.most[k]) = range::<F>(s, members, group);
        }
    }

    /// Finds the bounds.
    #[inline(always)]
    pub fn bound<F: Lanes>(&mut self, members: &Members, group: Group) {
        let c = F::splat;
        let (mut lower, mut upper) = (V3::grey(c(f32::INFINITY)), V3::grey(c(f32::NEG_INFINITY)));
        let mut wrong = c(0.0);
        for base in (0..group.len as usize).step_by(F::N) {
            let start = points::<F>(members, group, base);
            lower = V3(lower.0.min(start.0), lower.1.min(start.1), lower.2.min(start.2));
            upper = V3(upper.0.max(start.0), upper.1.max(start.1), upper.2.max(start.2));
            // Comparisons lose what is no number: this is zero but where it or its square is none.
            wrong = start.dot(start).fma(c(0.0), wrong);
        }
        self.lower = [lower.0, lower.1, lower.2].map(least_lane);
        self.upper = [upper.0, upper.1, upper.2].map(|x| -least_lane(-x));
        let magnitude: f32 = (0..3).map(|k| self.lower[k].abs().max(self.upper[k].abs())).sum();
        self.magnitude = if wrong.le(c(0.0)).bits() == F::first(F::N).bits() { magnitude } else { f32::NAN };
    }
}

/// Least and greatest F of a large sphere over the points of a group; 0 and -1 of those that are on it.
#[inline(always)]
fn range<F: Lanes>(s: &LargeSphere, members: &Members, group: Group) -> (f32, f32) {
    let c = F::splat;
    let (mut least, mut most) = (c(f32::INFINITY), c(f32::NEG_INFINITY));
    for base in (0..group.len as usize).step_by(F::N) {
        let start = points::<F>(members, group, base);
        // As in `spheres::large_blocks`, bit for bit: where this is not below zero, no segment starts inside.
        let mo = V3::splat(s.m).dot(start);
        let f = start.dot(start).fma(c(s.k), (mo + mo) + c(s.c));
        let own = primitives::<F>(members, group, base).eq(F::U::splat(s.id));
        least = least.min(F::select(own, c(0.0), f));
        most = most.max(F::select(own, c(-1.0), f));
    }
    (least_lane(least), -least_lane(-most))
}

/// Members base .. base + N of a group; beyond its end the first.
#[inline(always)]
fn points<F: Lanes>(members: &Members, group: Group, base: usize) -> V3<F> {
    let first = group.first as usize;
    let lanes = F::first(group.len as usize - base);
    let start = &members.start;
    V3::select(lanes, V3::load(start, first + base), V3::splat([start[0][first], start[1][first], start[2][first]]))
}

/// The same for the surfaces that they are on.
#[inline(always)]
fn primitives<F: Lanes>(members: &Members, group: Group, base: usize) -> F::U {
    let first = group.first as usize;
    let lanes = F::first(group.len as usize - base);
    F::U::select(lanes, F::U::load(&members.primitive[first + base..]), F::U::splat(members.primitive[first]))
}

#[inline(always)]
fn least_lane<F: Lanes>(x: F) -> f32 {
    let mut lanes = [f32::INFINITY; 32];
    x.store(&mut lanes);
    lanes[..F::N].iter().fold(f32::INFINITY, |least, &x| least.min(x))
}

/// The shaft of a point and the bounds of a group.
pub struct Shaft {
    pub y: [f32; 3],
    /// B - y, without zeros, and the inverses.
    pub lower: [f32; 3],
    pub upper: [f32; 3],
    inverse_lower: [f32; 3],
    inverse_upper: [f32; 3],
    /// Not less than any coordinate; not finite where one is not.
    pub magnitude: f32,
    /// The square of the longest segment.
    pub length2: f32,
}

impl Shaft {
    /// Of a suffix at y.
    #[inline(always)]
    pub fn new(ends: &Ends, y: [f32; 3]) -> Self {
        let mut shaft = Shaft {
            y,
            lower: [0.0; 3],
            upper: [0.0; 3],
            inverse_lower: [0.0; 3],
            inverse_upper: [0.0; 3],
            magnitude: ends.magnitude + (y[0].abs() + y[1].abs() + y[2].abs()),
            length2: 0.0,
        };
        for (k, y) in y.into_iter().enumerate() {
            let (lower, upper) = (ends.lower[k] - y, ends.upper[k] - y);
            let longest = lower.abs().max(upper.abs());
            shaft.length2 += longest * longest;
            shaft.lower[k] = if lower.abs() < TINY { -TINY } else { lower };
            shaft.upper[k] = if upper.abs() < TINY { TINY } else { upper };
            shaft.inverse_lower[k] = 1.0 / shaft.lower[k];
            shaft.inverse_upper[k] = 1.0 / shaft.upper[k];
        }
        shaft
    }

    /// Which boxes it meets, a bit each: those for which there is a t from 0 to 1 such that, on each axis, the least of
    /// y + t (B - y) is not above the box and the greatest not below it. That is six half lines of t.
    #[inline(always)]
    fn meets<F: Lanes>(&self, boxes: &Table) -> u64 {
        let c = F::splat;
        let pad = PAD * self.magnitude;
        let mut met = 0;
        for base in (0..boxes.len).step_by(F::N) {
            let (mut first, mut last) = (c(0.0), c(1.0));
            for k in 0..3 {
                let below = (F::load(&boxes.planes[2 * k + 1][base..]) - c(self.y[k] - pad)) * c(self.inverse_lower[k]);
                let above = (F::load(&boxes.planes[2 * k][base..]) - c(self.y[k] + pad)) * c(self.inverse_upper[k]);
                // t lower <= upper plane, t upper >= lower plane; which way that bounds t, the signs say, the same for
                // all boxes.
                let falls = F::first(if self.lower[k] < 0.0 { F::N } else { 0 });
                let rises = F::first(if self.upper[k] > 0.0 { F::N } else { 0 });
                first = first.max(F::select(falls, below, first)).max(F::select(rises, above, first));
                last = last.min(F::select(falls, last, below)).min(F::select(rises, last, above));
            }
            let missed = last.lt(first);
            met |= u64::from((!missed & F::first(boxes.len - base)).bits()) << base;
        }
        // Where a coordinate is no number, nothing is known.
        if self.magnitude.is_finite() { met } else { boxes.all() }
    }
}

#[cfg(test)]
mod tests;
