//! Constructive solid geometry: what closed shapes have together, in common, or one without the others.
//!
//! A solid is one primitive. It is a list of [`Part`]s in postfix order: surfaces, which make operands, and operations.
//! Every surface bounds a convex set (half a space, a ball, a round cone, a capsule), so a line is within it in one
//! interval, or a torus, where it is in up to two; an operand is what its surfaces have in common, and operations go by
//! the sorted lists of intervals of both sides. The nearest end ahead is the hit. Surfaces of several operands that are
//! one and the same have the same numbers, hence the same ends to the last bit: where faces coincide there is neither a
//! skin nor a wall nor a gap.
//!
//! A ray that leaves a solid is at t = 0 on the border that is nearest to where it starts, and on all surfaces that
//! coincide with it there. Each of these it leaves, or goes into: it is within its convex set from 0 on, or never
//! again; a torus that it leaves it may meet once more. No epsilon decides.
//!
//! Nothing here asks for memory: lists are arrays for the most operands that there may be, or shorter ones for few.

use super::cone::Side;
use super::{Interval, ObjectRay, both, quadratic, slab, torus};
use bytemuck::{Pod, Zeroable};
use glam::{DAffine3, DMat3, DVec3};

/// Operands of a solid, at most.
pub const MOST_OPERANDS: usize = 64;

/// Parts of a solid, at most: of boxes, with the operations between them.
const MOST_PARTS: usize = 7 * MOST_OPERANDS - 1;

/// Intervals of a line within all operands, at most: two of each.
const MOST_INTERVALS: usize = 2 * MOST_OPERANDS;

/// Solids with so many parts have no more operands than [`FEW_OPERANDS`], and take less of the stack.
const FEW_PARTS: usize = 24;
const FEW_OPERANDS: usize = 12;

/// Borders that are looked at, nearest first, before the nearest is taken for want of a better one: at an edge rounding
/// may have moved a point outside of all.
const MOST_TRIES: usize = 12;

/// A surface in an object space of its own, and the convex set that it bounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// z <= 0.
    Plane,
    /// At most 1 from the origin.
    Ball,
    /// Within the cone about the z axis with these radii at z = -1 and 1, without end on its wider side.
    Side {
        /// The radii.
        radii: [f64; 2],
    },
    /// As [`UnitShape::Capsule`](super::UnitShape::Capsule).
    Capsule {
        /// Half the distance between its centres.
        half: f64,
    },
    /// As [`UnitShape::Torus`](super::UnitShape::Torus).
    Torus {
        /// Radius of its section.
        tube: f64,
    },
}

/// What becomes of two solids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// What is in either.
    Union,
    /// What is in both.
    Intersection,
    /// What is in the first and not in the second.
    Difference,
}

/// A surface of an operand, or an operation; 128 bytes.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct Part {
    /// Rows of the linear part of the map from render space to the surface's object space.
    object: [[f64; 3]; 3],
    /// Where the origin of object space is in render space.
    anchor: [f64; 3],
    parameters: [f64; 2],
    kind: u32,
    flags: u32,
    /// Which operand it is of, among those of the scene.
    operand: u32,
    /// Nothing.
    unused: u32,
}

/// What is on the other side of the surface.
const FLIPPED: u32 = 1;
/// One more surface of the operand before it.
const JOINS: u32 = 2;

impl Part {
    const PLANE: u32 = 0;
    const BALL: u32 = 1;
    const SIDE: u32 = 2;
    const CAPSULE: u32 = 3;
    const TORUS: u32 = 4;
    /// The first of the operations.
    const UNION: u32 = 5;
    const INTERSECTION: u32 = 6;
    const DIFFERENCE: u32 = 7;

    /// A surface under a map to render space. `flipped`: of a plane what is before it; `joins`: one more surface of the
    /// operand before it.
    pub fn of_surface(surface: &Surface, map: &DAffine3, flipped: bool, joins: bool, operand: u32) -> Self {
        let (kind, parameters) = match *surface {
            Surface::Plane => (Self::PLANE, [0.0; 2]),
            Surface::Ball => (Self::BALL, [0.0; 2]),
            Surface::Side { radii } => (Self::SIDE, radii),
            Surface::Capsule { half } => (Self::CAPSULE, [half, 0.0]),
            Surface::Torus { tube } => (Self::TORUS, [tube, 0.0]),
        };
        let inverse = map.matrix3.inverse();
        Part {
            object: [0, 1, 2].map(|k| inverse.row(k).to_array()),
            anchor: map.translation.to_array(),
            // As single shapes have them, so that a solid of one shape is that shape.
            parameters: parameters.map(|x| f64::from(x as f32)),
            kind,
            flags: if flipped { FLIPPED } else { 0 } | if joins { JOINS } else { 0 },
            operand,
            unused: 0,
        }
    }

    /// An operation on the two solids before it.
    pub fn of_operation(operation: Operation) -> Self {
        let kind = match operation {
            Operation::Union => Self::UNION,
            Operation::Intersection => Self::INTERSECTION,
            Operation::Difference => Self::DIFFERENCE,
        };
        Part { kind, ..Self::zeroed() }
    }

    /// Which operand it is of, among those of the scene.
    pub fn operand(&self) -> u32 {
        self.operand
    }

    fn is_operation(&self) -> bool {
        self.kind >= Self::UNION
    }

    fn joins(&self) -> bool {
        self.flags & JOINS != 0
    }

    fn is_flipped(&self) -> bool {
        self.flags & FLIPPED != 0
    }

    fn object_from_render(&self) -> DMat3 {
        DMat3::from_cols_array_2d(&self.object).transpose()
    }

    fn side(&self) -> Side {
        Side::of(self.parameters)
    }

    fn is_torus(&self) -> bool {
        self.kind == Self::TORUS
    }

    /// A line in its object space; `on`: it starts on the surface.
    fn object_ray(&self, origin: DVec3, direction: DVec3, on: bool) -> ObjectRay {
        let map = self.object_from_render();
        let from_anchor = origin - DVec3::from(self.anchor);
        let t0 = if on { 0.0 } else { -(from_anchor.dot(direction) / direction.dot(direction)) };
        ObjectRay { o: map * (from_anchor + t0 * direction), d: map * direction, t0 }
    }

    /// Where a line is within a torus; `start`: it starts on the surface, within or not from there.
    fn within_torus(&self, origin: DVec3, direction: DVec3, start: Option<bool>) -> torus::Within {
        torus::within(self.parameters[0], &self.object_ray(origin, direction, start.is_some()), start)
    }

    /// Where a line is within a convex set; `on`: it starts on the surface and goes into it.
    fn interval(&self, origin: DVec3, direction: DVec3, on: bool) -> Option<Interval> {
        if self.kind == Self::PLANE {
            let n = DVec3::from(self.object[2]);
            return half_line(n.dot(origin - DVec3::from(self.anchor)), n.dot(direction), self.is_flipped(), on);
        }
        let ray = self.object_ray(origin, direction, on);
        let [near, far] = match self.kind {
            Self::BALL => super::ball(&ray, 0.0, on),
            Self::SIDE => self.side().within(&ray, on),
            _ => capsule(self.parameters[0], &ray),
        }?;
        // A ray that goes into it is in it from where it starts.
        Some(if on { [0.0, far.max(0.0)] } else { [ray.t0 + near, ray.t0 + far] })
    }

    /// How far a point is from the surface, about, below zero within the set; and the unit normal there, outwards.
    fn depth(&self, point: DVec3) -> (f64, DVec3) {
        let map = self.object_from_render();
        let q = map * (point - DVec3::from(self.anchor));
        // The value of a function that is zero on the surface, and its gradient.
        let (value, gradient) = match self.kind {
            Self::PLANE => (q.z, DVec3::Z),
            Self::BALL => (0.5 * (q.dot(q) - 1.0), q),
            Self::SIDE => {
                let (side, across) = (self.side(), q.truncate());
                let r = side.radius(q.z);
                if r < 0.0 {
                    // Beyond the apex there is nothing.
                    return (f64::INFINITY, DVec3::Z);
                }
                (0.5 * (across.dot(across) - r * r), across.extend(-r * side.slope))
            }
            Self::TORUS => torus::depth(self.parameters[0], q),
            _ => {
                let half = self.parameters[0];
                let out = q - DVec3::new(0.0, 0.0, q.z.clamp(-half, half));
                (out.length() - 1.0, out.normalize_or(DVec3::X))
            }
        };
        let gradient = map.transpose() * gradient;
        let steep = gradient.length();
        if steep == 0.0 {
            return (f64::NEG_INFINITY, DVec3::Z);
        }
        let sign = if self.is_flipped() { -1.0 } else { 1.0 };
        (sign * value / steep, sign / steep * gradient)
    }
}

/// Where a line is at n.p <= 0; `flipped`: at n.p > 0.
fn half_line(height: f64, climb: f64, flipped: bool, on: bool) -> Option<Interval> {
    if on {
        return Some([0.0, f64::INFINITY]);
    }
    if climb == 0.0 {
        return ((height <= 0.0) != flipped).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let t = -(height / climb);
    Some(if (climb > 0.0) != flipped { [f64::NEG_INFINITY, t] } else { [t, f64::INFINITY] })
}

/// Where a line is within a capsule: from the least to the greatest end of its three convex parts.
fn capsule(half: f64, ray: &ObjectRay) -> Option<Interval> {
    let (o, d) = (ray.o.truncate(), ray.d.truncate());
    let (a, gamma) = (d.dot(d), o.dot(o) - 1.0);
    let side = match a > 0.0 {
        true => quadratic(a, o.dot(d), gamma),
        false => (gamma <= 0.0).then_some([f64::NEG_INFINITY, f64::INFINITY]),
    };
    let side = side.zip(slab(ray, half)).and_then(|(side, slab)| both(side, slab));
    let parts = [side, super::ball(ray, -half, false), super::ball(ray, half, false)];
    parts.into_iter().flatten().reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
}

/// Lists of intervals on a stack, each sorted and without overlaps.
struct Lists<const O: usize> {
    intervals: [Interval; O],
    lengths: [usize; O],
    /// Lists, and the intervals in all of them.
    depth: usize,
    total: usize,
}

impl<const O: usize> Lists<O> {
    fn new() -> Self {
        Lists { intervals: [[0.0; 2]; O], lengths: [0; O], depth: 0, total: 0 }
    }

    fn push(&mut self, interval: Option<Interval>) {
        if self.depth < O && self.total < O {
            self.lengths[self.depth] = 0;
            self.depth += 1;
            self.set(interval);
        }
    }

    /// One list more, of these.
    fn push_all(&mut self, intervals: &[Interval]) {
        let (depth, total) = (self.depth, self.total);
        if depth < O && total + intervals.len() <= O {
            let mut count = 0;
            for interval in intervals.iter().filter(|[near, far]| near < far) {
                self.intervals[total + count] = *interval;
                count += 1;
            }
            self.lengths[depth] = count;
            (self.depth, self.total) = (depth + 1, total + count);
        }
    }

    /// Makes the last list, which is empty, this interval.
    fn set(&mut self, interval: Option<Interval>) {
        if let Some(interval) = interval.filter(|[near, far]| near < far) {
            self.intervals[self.total] = interval;
            self.total += 1;
            self.lengths[self.depth - 1] = 1;
        }
    }

    /// Leaves of the last list, which has one interval at most, what is within this one.
    fn join(&mut self, interval: Option<Interval>) {
        if self.depth > 0 && self.lengths[self.depth - 1] == 1 {
            self.total -= 1;
            self.lengths[self.depth - 1] = 0;
            let held = self.intervals[self.total];
            self.set(interval.and_then(|interval| both(held, interval)));
        }
    }

    /// Puts what the operation makes of the last two lists in their place.
    fn combine(&mut self, kind: u32) {
        let Some(below) = self.depth.checked_sub(2) else { return };
        let (first, second) = (self.lengths[below], self.lengths[below + 1]);
        let start = self.total - first - second;
        let (a, b) = (start, start + first);
        let (mut i, mut j) = (0, 0);
        let (mut inside, mut from, mut count) = (false, 0.0, 0);
        let mut made = [[0.0; 2]; O];
        while i < 2 * first || j < 2 * second {
            let end = |at: usize, k: usize| self.intervals[at + k / 2][k % 2];
            let next_a = if i < 2 * first { Some(end(a, i)) } else { None };
            let next_b = if j < 2 * second { Some(end(b, j)) } else { None };
            // Ends at one place are passed at once: nothing is between them.
            let t = match (next_a, next_b) {
                (Some(x), Some(y)) => x.min(y),
                (Some(x), None) | (None, Some(x)) => x,
                (None, None) => break,
            };
            i += usize::from(next_a == Some(t));
            j += usize::from(next_b == Some(t));
            let now = of_kind(kind, i % 2 == 1, j % 2 == 1);
            if now && !inside {
                from = t;
            } else if inside && !now && from < t && count < O {
                made[count] = [from, t];
                count += 1;
            }
            inside = now;
        }
        self.intervals[start..start + count].copy_from_slice(&made[..count]);
        self.lengths[below] = count;
        self.depth -= 1;
        self.total = start + count;
    }

    /// The first end ahead. What is shorter than the roundings of its ends is none.
    fn first_end(&self) -> Option<f64> {
        let mut rest = &self.intervals[..self.total];
        while let Some((&[near, mut far], after)) = rest.split_first() {
            rest = after;
            while let Some((&[next, end], after)) = rest.split_first()
                && next - far <= SLIVER * far.abs()
            {
                (far, rest) = (end, after);
            }
            if near > 0.0 && (far == f64::INFINITY || far - near > SLIVER * far) {
                return Some(near);
            }
            if near <= 0.0 && far > 0.0 {
                return Some(far);
            }
        }
        None
    }
}

/// 2^-40: what is less of a distance is rounding, of surfaces that coincide but are of different kinds. t is rounded to
/// 2^-24 of itself.
const SLIVER: f64 = 1.0 / 1_099_511_627_776.0;

fn of_kind(kind: u32, first: bool, second: bool) -> bool {
    match kind {
        Part::UNION => first | second,
        Part::INTERSECTION => first & second,
        _ => first & !second,
    }
}

/// A point near the border of a solid, as all its surfaces see it.
struct Near<const P: usize> {
    depth: [f64; P],
    normal: [DVec3; P],
    /// Depths that differ by less are the same.
    same: f64,
}

/// Where the border is.
struct Border<const P: usize> {
    /// The part of the operand that it is of.
    owner: usize,
    /// Unit normal, out of the solid.
    outward: DVec3,
    /// Of each part: 1 where its set is left along `outward`, -1 where it is entered, 0 where it is not near.
    sign: [i8; P],
}

impl<const P: usize> Near<P> {
    fn of(parts: &[Part], point: DVec3) -> Self {
        let largest = point.abs().max_element();
        let mut near = Near { depth: [f64::INFINITY; P], normal: [DVec3::ZERO; P], same: largest / 4_194_304.0 };
        for (k, part) in parts.iter().enumerate().take(P) {
            if !part.is_operation() {
                (near.depth[k], near.normal[k]) = part.depth(point);
            }
        }
        near
    }

    /// Whether the solid is on that side (1 or -1) of the surfaces of `sign`, with the part `other` seen from its other
    /// side.
    fn holds(&self, parts: &[Part], sign: &[i8; P], side: i8, other: usize) -> bool {
        // A bit for each solid, the last one lowest.
        let mut stack = 0u64;
        for (k, part) in parts.iter().enumerate().take(P) {
            if part.is_operation() {
                let (first, second) = (stack >> 1 & 1 == 1, stack & 1 == 1);
                stack = stack >> 2 << 1 | u64::from(of_kind(part.kind, first, second));
                continue;
            }
            let within = match sign[k] {
                0 if part.is_flipped() => self.depth[k] < 0.0,
                0 => self.depth[k] <= 0.0,
                sign => sign != side,
            };
            let within = within != (k == other);
            stack = match part.joins() {
                true => stack & (!1 | u64::from(within)),
                false => stack << 1 | u64::from(within),
            };
        }
        stack & 1 == 1
    }

    /// Of each part whose surface coincides with that of part `k`: whether it faces the same way (1) or not (-1).
    fn along(&self, parts: &[Part], k: usize) -> [i8; P] {
        let mut sign = [0; P];
        for (j, sign) in sign.iter_mut().enumerate().take(parts.len()) {
            let cosine = self.normal[j].dot(self.normal[k]);
            let (turned, along) = if cosine < 0.0 { (-self.depth[j], -1) } else { (self.depth[j], 1) };
            if j == k || (turned - self.depth[k]).abs() <= self.same && cosine.abs() >= ALONG {
                *sign = along;
            }
        }
        sign
    }

    /// The border at the surface of part `k` and those that coincide with it, if it is there.
    fn border_at(&self, parts: &[Part], k: usize, mut sign: [i8; P]) -> Option<Border<P>> {
        let sides = [1, -1].map(|side| self.holds(parts, &sign, side, P));
        if sides[0] == sides[1] {
            return None;
        }
        // The first whose surface makes the difference.
        let bounds = |j: usize| sign[j] != 0 && (0..2).any(|s| self.holds(parts, &sign, [1, -1][s], j) != sides[s]);
        let owner = (0..parts.len().min(P)).find(|&j| bounds(j)).unwrap_or(k);
        if sides[0] {
            sign.iter_mut().for_each(|sign| *sign = -*sign);
        }
        Some(Border { owner, outward: if sides[0] { -self.normal[k] } else { self.normal[k] }, sign })
    }

    /// The nearest border.
    fn border(&self, parts: &[Part]) -> Option<Border<P>> {
        let mut nearest = None;
        let mut tried = [false; P];
        for _ in 0..MOST_TRIES {
            let mut next: Option<(f64, usize)> = None;
            for (k, depth) in self.depth.iter().enumerate().take(parts.len()) {
                let key = (depth.abs(), k);
                if !tried[k] && depth.is_finite() && next.is_none_or(|next| key < next) {
                    next = Some(key);
                }
            }
            let Some((_, k)) = next else { break };
            let sign = self.along(parts, k);
            if let Some(border) = self.border_at(parts, k, sign) {
                return Some(border);
            }
            nearest = nearest.or(Some(k));
            tried.iter_mut().zip(sign).for_each(|(tried, sign)| *tried |= sign != 0);
        }
        let k = nearest?;
        let mut sign = [0; P];
        sign[k] = 1;
        Some(Border { owner: k, outward: self.normal[k], sign })
    }
}

/// The cosine of the angle within which surfaces at one place coincide: 2 in a thousand.
const ALONG: f64 = 1.0 - 2e-6;

/// The least t > 0 at which a ray meets the solid; `leaves`: it starts on it and is not met there.
pub(super) fn hit(parts: &[Part], origin: DVec3, direction: DVec3, leaves: bool) -> Option<f64> {
    match (parts.len() <= FEW_PARTS, parts.iter().any(Part::is_torus)) {
        (true, false) => hit_of::<FEW_PARTS, FEW_OPERANDS>(parts, origin, direction, leaves),
        (true, true) => hit_of::<FEW_PARTS, { 2 * FEW_OPERANDS }>(parts, origin, direction, leaves),
        (false, false) => hit_of::<MOST_PARTS, MOST_OPERANDS>(parts, origin, direction, leaves),
        (false, true) => hit_of::<MOST_PARTS, MOST_INTERVALS>(parts, origin, direction, leaves),
    }
}

fn hit_of<const P: usize, const O: usize>(
    parts: &[Part],
    origin: DVec3,
    direction: DVec3,
    leaves: bool,
) -> Option<f64> {
    let border = if leaves { Near::<P>::of(parts, origin).border(parts) } else { None };
    let out = border.as_ref().is_none_or(|border| border.outward.dot(direction) >= 0.0);
    let mut lists = Lists::<O>::new();
    for (k, part) in parts.iter().enumerate().take(P) {
        if part.is_operation() {
            lists.combine(part.kind);
            continue;
        }
        let sign = border.as_ref().map_or(0, |border| border.sign[k]);
        if part.is_torus() {
            let start = (sign != 0).then_some((sign > 0) != out);
            lists.push_all(part.within_torus(origin, direction, start).intervals());
            continue;
        }
        let interval = match sign {
            0 => part.interval(origin, direction, false),
            sign if (sign > 0) == out => None,
            _ => part.interval(origin, direction, true),
        };
        if part.joins() {
            lists.join(interval);
        } else {
            lists.push(interval);
        }
    }
    lists.first_end()
}

/// The surface of a solid near a point.
pub struct OnSolid {
    /// The operand that it is of, among those of the scene.
    pub operand: u32,
    /// The unit normal, out of the solid.
    pub outward: DVec3,
}

/// The surface of the solid near a point.
pub(super) fn surface(parts: &[Part], point: DVec3) -> Option<OnSolid> {
    match parts.len() <= FEW_PARTS {
        true => surface_of::<FEW_PARTS>(parts, point),
        false => surface_of::<MOST_PARTS>(parts, point),
    }
}

fn surface_of<const P: usize>(parts: &[Part], point: DVec3) -> Option<OnSolid> {
    let border = Near::<P>::of(parts, point).border(parts)?;
    let part = parts.get(border.owner)?;
    Some(OnSolid { operand: part.operand, outward: border.outward })
}
