//! Tori: at most `tube` away from the circle of radius 1 about the origin in the plane z = 0. Parameters: tube <= 1.
//!
//! A line meets one up to four times, so there is no interval but up to two. With p(s) = o + s d, o the point of the
//! line that is nearest to the origin and d a unit vector, the surface is
//! f(s) = (|p|^2 + 1 - tube^2)^2 - 4 rho^2 = 0, rho the distance from the axis. Where f' = 0 is a cubic without a
//! square; its roots part those of f. So none is missed but where a line touches the surface, and between two of them
//! the sign of f tells whether there is one. Roots themselves are of (rho - 1)^2 + z^2 - tube^2, f over a factor above
//! zero, which keeps its digits however thin the ring is.

use super::{Interval, ObjectRay, OnUnit, longitude};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// What a line has within a torus: so many intervals, in order.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Within {
    intervals: [Interval; 2],
    count: usize,
}

impl Within {
    pub(super) fn intervals(&self) -> &[Interval] {
        &self.intervals[..self.count]
    }

    fn begin(&mut self, t: f64) {
        // Four roots are two intervals.
        if self.count < 2 {
            self.intervals[self.count] = [t, f64::INFINITY];
            self.count += 1;
        }
    }

    fn end(&mut self, t: f64) {
        if let Some(last) = self.count.checked_sub(1) {
            self.intervals[last][1] = t;
        }
    }
}

/// A line by its point that is nearest to the origin and its unit direction.
struct Line {
    o: DVec3,
    d: DVec3,
    tube: f64,
}

impl Line {
    fn at(&self, s: f64) -> DVec3 {
        self.o + s * self.d
    }

    /// (rho - 1)^2 + z^2 - tube^2, below zero within, and its derivative.
    fn value(&self, s: f64) -> (f64, f64) {
        let p = self.at(s);
        let rho = (p.x * p.x + p.y * p.y).sqrt();
        let off = rho - 1.0;
        let climb = if rho > 0.0 { (p.x * self.d.x + p.y * self.d.y) / rho } else { 0.0 };
        (off * off + p.z * p.z - self.tube * self.tube, 2.0 * (off * climb + p.z * self.d.z))
    }

    /// Ends of the part of the line that may be within, a little farther.
    fn reach(&self) -> Option<[f64; 2]> {
        let most = (1.0 + self.tube) * (1.0 + 1e-12);
        let half = most * most - self.o.length_squared();
        if half < 0.0 {
            return None;
        }
        let half = half.sqrt();
        let mut ends = [-half, half];
        // Between the planes that it lies between.
        let height = self.tube * (1.0 + 1e-12);
        if self.d.z.abs() < 1e-12 {
            if self.o.z.abs() > height + 1e-11 {
                return None;
            }
        } else {
            let [a, b] = [(-height - self.o.z) / self.d.z, (height - self.o.z) / self.d.z];
            ends = [ends[0].max(a.min(b)), ends[1].min(a.max(b))];
        }
        // Through the hole: rho is convex along a line, and largest at an end.
        let rho2 = |s: f64| self.at(s).truncate().length_squared();
        let hole = (1.0 - self.tube) * (1.0 - 1e-12);
        let misses = ends[0] > ends[1] || rho2(ends[0]).max(rho2(ends[1])) < hole * hole;
        (!misses).then_some(ends)
    }

    /// Where f' = 0, in order: s^3 + p s + q = 0 with p = |o|^2 + 1 - tube^2 - 2 |d_xy|^2, q = -2 o_xy . d_xy.
    fn turns(&self) -> ([f64; 3], usize) {
        let d2 = self.d.truncate().length_squared();
        let p = self.o.length_squared() + 1.0 - self.tube * self.tube - 2.0 * d2;
        let q = -2.0 * self.o.truncate().dot(self.d.truncate());
        let (third, half) = (p / 3.0, 0.5 * q);
        let disc = half * half + third * third * third;
        if disc >= 0.0 {
            // One (Cardano), by the larger of both cube roots.
            let u = libm::cbrt(-(half + disc.sqrt().copysign(half)));
            return ([if u == 0.0 { 0.0 } else { u - third / u }, 0.0, 0.0], 1);
        }
        let m = (-third).sqrt();
        let angle = libm::acos((-half / (m * m * m)).clamp(-1.0, 1.0)) / 3.0;
        let root = |turn: f64| 2.0 * m * libm::cos(angle + turn);
        // The angle is at most pi / 3.
        ([root(2.0 * PI / 3.0), root(-2.0 * PI / 3.0), root(0.0)], 3)
    }

    /// The root between two places of which one is within and the other is not.
    fn root(&self, from: f64, to: f64, from_within: bool) -> f64 {
        let [mut low, mut high] = [from, to];
        let mut s = 0.5 * (low + high);
        for _ in 0..80 {
            let (value, climb) = self.value(s);
            if value == 0.0 {
                return s;
            }
            if (value < 0.0) == from_within {
                low = s;
            } else {
                high = s;
            }
            let newton = s - value / climb;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - s).abs() <= 4.0 * f64::EPSILON * s.abs().max(self.tube) {
                return next;
            }
            s = next;
        }
        s
    }
}

/// Where a line is within a torus. `start`: from where it begins on, on the surface, within or not from there.
pub(super) fn within(tube: f64, ray: &ObjectRay, start: Option<bool>) -> Within {
    let mut found = Within::default();
    let length = ray.d.length();
    let d = ray.d / length;
    // The line's own s of the point that the ray is given by.
    let s_of_ray = ray.o.dot(d);
    // A ray that starts on it is off it by the rounding of its start: the torus through that point is meant.
    let tube = start.map_or(tube, |_| out(ray.o).length().min(1.0));
    let line = Line { o: ray.o - s_of_ray * d, d, tube };
    let t_of = |s: f64| ray.t0 + (s - s_of_ray) / length;
    let mut inside = start.unwrap_or(false);
    if inside {
        found.begin(t_of(s_of_ray));
    }
    let Some([first, last]) = line.reach() else {
        found.end(t_of(s_of_ray));
        return found;
    };
    let (turns, count) = line.turns();
    let mut from = if start.is_some() { s_of_ray } else { first };
    let ends = turns[..count].iter().copied().filter(|s| *s < last).chain([last]);
    for (place, is_last) in ends.map(|s| (s, s >= last)) {
        if place <= from {
            continue;
        }
        // It ends outside.
        let now = !is_last && line.value(place).0 < 0.0;
        if now != inside {
            let root = line.root(from, place, inside);
            if now {
                found.begin(t_of(root))
            } else {
                found.end(t_of(root))
            }
            inside = now;
        }
        from = place;
    }
    if inside {
        found.end(t_of(from));
    }
    found
}

pub(super) fn hit(&[tube, ..]: &[f32; 3], ray: &ObjectRay, leaves: bool) -> Option<f64> {
    let tube = f64::from(tube);
    let start = leaves.then(|| out(ray.o).dot(ray.d) < 0.0);
    let found = within(tube, ray, start);
    let mut ends = found.intervals().iter().flatten();
    // A ray that goes in begins within.
    if start == Some(true) {
        ends.next();
    }
    ends.copied().find(|t| *t > 0.0)
}

/// From the middle of the section that is nearest to a point towards it.
fn out(q: DVec3) -> DVec3 {
    let rho = q.truncate().length();
    let across = if rho > 0.0 { q.truncate() / rho } else { DVec2::X };
    (across * (rho - 1.0)).extend(q.z)
}

/// How far a point is from the surface, below zero within, and the unit normal there, outwards.
pub(super) fn depth(tube: f64, q: DVec3) -> (f64, DVec3) {
    let out = out(q);
    (out.length() - tube, out.normalize_or(DVec3::X))
}

pub(super) fn surface(&[tube, ..]: &[f32; 3], q: DVec3) -> OnUnit {
    let n = depth(f64::from(tube), q).1;
    let across = q.truncate().try_normalize().unwrap_or(DVec2::X);
    let around = libm::atan2(n.z, n.truncate().dot(across));
    OnUnit { q: across.extend(0.0) + f64::from(tube) * n, n, uv: DVec2::new(longitude(q), 0.5 + around / TAU) }
}
