//! Cutting triangles whose boxes are empty, before the tree is built: spatial splits.
//!
//! A long triangle that lies aslant fills little of its box, and every ray through the box tests it. Cut into parts,
//! each with a box of its own, it is found where it is. Cuts are made beforehand, triangle by triangle (Ernst and
//! Greiner, *Early split clipping for bounding volume hierarchies*, 2007), not while the tree is built (Stich,
//! Friedrich and Dietrich, *Spatial splits in bounding volume hierarchies*, 2009): they are then a function of the
//! geometry alone, so that every [`Acceleration`](super::super::Acceleration) has the same parts and gives the same
//! answers.
//!
//! What a cut gains is surface: half that of the box before it less half those of the two boxes after it. Divided by
//! half that of the box of all triangles it is the number of tests that a ray through them is spared. A cut costs
//! memory, and levels of the tree; so it is made only where it gains [`WORTH`] times a triangle's share of one test a
//! ray, and [`SHARE`] of its own box. The cuts of a triangle together gain no more than half its box's surface less its
//! own shadows on the three planes: by the sum of these the least gain is raised until there cannot be more cuts than
//! [`MOST`] and [`LIMIT`] allow. And unless all cuts together spare a ray a good share of its tests ([`PAYS`]), which
//! they do for girders, pipes, cables, and buildings askew, but not for scans and what lies along the axes, there are
//! none. What the constants were chosen by is in `docs/performance.md`.

use super::super::bounds::Bounds;
use super::super::triangle::padding;
use super::binary::Item;
use super::contents::TriangleList;
use glam::{DVec3, Vec3A, Vec4};
use rayon::prelude::*;

/// A part of a triangle.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    pub triangle: u32,
    /// Padded as the triangle's own box is.
    pub bounds: Bounds,
}

/// Triangles are left whole if they are smaller or larger than this: in between no product of the test's slack is
/// subnormal or infinite (see [`triangle`](super::super::triangle)).
const SIZES: std::ops::RangeInclusive<f64> = 1.0 / 1_073_741_824.0..=1_073_741_824.0;

/// In tests a ray, divided by the number of triangles.
const WORTH: f64 = 4.0;
/// In half surfaces of the box that is cut, of which a long, thin triangle aslant gains half. Less, and triangles of
/// all shapes are cut, for little.
const SHARE: f64 = 0.4;
/// Of the boxes of all triangles together. Where cuts gain less, they are not made: a part takes longer to test than a
/// triangle, and more memory.
const PAYS: f64 = 0.1;
/// Cuts for each triangle of a tree.
const MOST: f64 = 3.0;
/// Cuts of a tree, at about 100 bytes each.
const LIMIT: f64 = 262_144.0;

impl TriangleList<'_> {
    /// Replaces the items of triangles that are worth it by items of their parts. `bounds` is the box of all.
    pub fn cut(&mut self, items: &mut Vec<Item>, bounds: &Bounds) {
        let half_area = |item: &Item| f64::from(item.bounds().half_area());
        let sum_of = |parts: &[Bounds]| parts.iter().map(|part| f64::from(part.half_area())).sum::<f64>();
        // In pieces of the same size for any number of threads.
        let pieces: Vec<f64> = items.par_chunks(4096).map(|items| items.iter().map(half_area).sum()).collect();
        let all: f64 = pieces.iter().sum();
        let most = (MOST * items.len() as f64).min(LIMIT);
        let least = WORTH * f64::from(bounds.half_area()) / items.len() as f64;
        let candidates: Vec<(usize, f64)> = items
            .par_iter()
            .enumerate()
            // A cut leaves more than about half, of a figure that is flat.
            .filter(|(_, item)| half_area(item) > 2.0 * least)
            .filter_map(|(at, item)| {
                let polygon = self.polygon(item.index());
                let gain = most_gain(&polygon);
                (gain > least && gain > SHARE * polygon.half_area()).then_some((at, gain))
            })
            .collect();
        let total: f64 = candidates.iter().map(|(_, gain)| gain).sum();
        if total < PAYS * all {
            return;
        }
        let least = least.max(total / most);
        let cut: Vec<(usize, Vec<Bounds>)> = candidates
            .into_par_iter()
            .filter(|(_, gain)| *gain > least)
            .map(|(at, _)| {
                let triangle = items[at].index();
                let pad = Vec4::splat(padding(self.corners(triangle)));
                let mut parts = Vec::new();
                self.polygon(triangle).cut(least, &mut parts);
                parts.iter_mut().for_each(|part| *part = Bounds { lower: part.lower - pad, upper: part.upper + pad });
                (at, parts)
            })
            .filter(|(_, parts)| parts.len() > 1)
            .collect();
        let gain: f64 = cut.iter().map(|(at, parts)| half_area(&items[*at]) - sum_of(parts)).sum();
        if gain < PAYS * all {
            return;
        }
        self.cut = cut.len();
        for (at, parts) in cut {
            let triangle = items[at].index();
            for (k, bounds) in parts.into_iter().enumerate() {
                let item = Item::new(&bounds, self.add(Part { triangle, bounds }));
                if k == 0 {
                    items[at] = item;
                } else {
                    items.push(item);
                }
            }
        }
    }

    fn polygon(&self, triangle: u32) -> Polygon {
        Polygon::of(self.corners(triangle))
    }
}

/// The most that cuts of a triangle can gain; nothing where it is not to be cut.
fn most_gain(triangle: &Polygon) -> f64 {
    let [a, b, c] = [0, 1, 2].map(|k: usize| triangle.points[k]);
    let shadows = 0.5 * (b - a).cross(c - a).abs().element_sum();
    let (lower, upper) = triangle.extent();
    if SIZES.contains(&(upper - lower).max_element()) { triangle.half_area() - shadows } else { 0.0 }
}

/// What of a triangle is in a box: convex, with no more corners than the triangle and one for each side of the box.
#[derive(Clone, Copy)]
pub struct Polygon {
    points: [DVec3; 9],
    count: usize,
}

impl Polygon {
    pub fn of(triangle: [[f32; 3]; 3]) -> Self {
        let mut polygon = Self { points: [DVec3::ZERO; 9], count: 3 };
        for (place, corner) in polygon.points.iter_mut().zip(triangle) {
            *place = Vec3A::from_array(corner).as_dvec3();
        }
        polygon
    }

    /// Says whether there was room.
    fn push(&mut self, point: DVec3) -> bool {
        let Some(place) = self.points.get_mut(self.count) else {
            return false;
        };
        *place = point;
        self.count += 1;
        true
    }

    pub fn points(&self) -> &[DVec3] {
        &self.points[..self.count]
    }

    fn extent(&self) -> (DVec3, DVec3) {
        let first = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        self.points().iter().fold(first, |(lower, upper), &p| (lower.min(p), upper.max(p)))
    }

    /// Half the surface of its box.
    fn half_area(&self) -> f64 {
        let (lower, upper) = self.extent();
        let e = (upper - lower).max(DVec3::ZERO);
        e.x * (e.y + e.z) + e.y * e.z
    }

    /// What of it is below a plane across an axis, and what is above. What is in the plane is in both. `None` where
    /// rounding has bent it so that it has too many corners.
    pub fn halves(&self, axis: usize, plane: f64) -> Option<[Self; 2]> {
        let mut halves = [Self { points: [DVec3::ZERO; 9], count: 0 }; 2];
        let points = self.points();
        for (i, &p) in points.iter().enumerate() {
            let q = points[if i + 1 < points.len() { i + 1 } else { 0 }];
            let (a, b) = (p[axis] - plane, q[axis] - plane);
            let mut room = true;
            if a <= 0.0 {
                room &= halves[0].push(p);
            }
            if a >= 0.0 {
                room &= halves[1].push(p);
            }
            if a * b < 0.0 {
                let mut cut = p + (q - p) * (a / (a - b));
                cut[axis] = plane;
                room &= halves[0].push(cut) && halves[1].push(cut);
            }
            if !room {
                return None;
            }
        }
        Some(halves)
    }

    /// Cuts it, and its halves, as long as a cut gains so much; adds the boxes, which are not padded.
    fn cut(&self, least: f64, parts: &mut Vec<Bounds>) {
        let area = self.half_area();
        let (lower, upper) = self.extent();
        let mut most = least.max(SHARE * area);
        let mut best = None;
        for axis in 0..3 {
            let halves = self.halves(axis, 0.5 * (lower[axis] + upper[axis]));
            let left = halves.map_or(f64::INFINITY, |halves| halves[0].half_area() + halves[1].half_area());
            if area - left > most {
                most = area - left;
                best = halves;
            }
        }
        match best {
            Some(halves) => halves.iter().for_each(|half| half.cut(least, parts)),
            // Rounding to single precision is far within the padding.
            None => parts.push(Bounds { lower: lower.as_vec3().extend(0.0), upper: upper.as_vec3().extend(0.0) }),
        }
    }
}
