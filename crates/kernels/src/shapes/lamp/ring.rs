//! Tori about the z axis that shine, seen from outside: a section of it, then a point of that circle.
//!
//! The middles of all sections lie on the circle of radius 1, and a section is chosen by one over the squared distance
//! of its middle, so that what is near is not chosen too seldom. With the point o at the distance rho from the axis and
//! the height z, x the way round from it, that distance squared is A - B cos x, A = rho^2 + z^2 + 1, B = 2 rho; the
//! integral of one over it is 2 / sqrt(A^2 - B^2) atan(sqrt((A + B) / (A - B)) tan(x / 2)). In the plane of the section
//! let L be the distance of o from its middle: the point is chosen by the angle under which the circle is seen, as
//! lines of cylinders are, and where o projects into the circle nothing is seen of the section. A piece of the surface
//! is tube rho' dx dy, rho' its distance from the axis, and all together is D^3 / (l^2 rho' spread) in solid angle,
//! with D the point's distance, l that in the plane, and spread the angle.
//!
//! So near to the surface that the distance of a middle says little, half of the sections are chosen by that of the
//! surface: near^2 becomes (near - tube)^2, and A and far^2 lessen by as much.
//!
//! A line may pass through the front more than once: all that could have taken a direction count.

use super::Way;
use crate::shapes::{ObjectRay, torus};
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// The radius of its section, that of the circle of middles being 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Ring {
    pub(super) tube: f64,
}

/// A section as a point sees it, in the plane of both directions `across` and z.
struct Section {
    across: DVec2,
    /// From its middle to the projected point.
    to: DVec2,
}

impl Section {
    fn of(o: DVec3, across: DVec2) -> Section {
        Section { across, to: DVec2::new(o.truncate().dot(across) - 1.0, o.z) }
    }
}

impl Ring {
    /// Its area.
    pub(super) fn area(&self) -> f64 {
        TAU * TAU * self.tube
    }

    /// Whether a point is within.
    pub(super) fn holds(&self, o: DVec3) -> bool {
        torus::depth(self.tube, o).0 <= 0.0
    }

    /// The unit normal at a point.
    pub(super) fn normal(&self, q: DVec3) -> DVec3 {
        torus::depth(self.tube, q).1
    }

    /// A point, uniform in area.
    pub(super) fn point(&self, u: f64, v: f64) -> DVec3 {
        let (sin, cos) = libm::sincos(TAU * v);
        let (up, out) = libm::sincos(self.turn(TAU * (u - 0.5)));
        let rho = 1.0 + self.tube * out;
        DVec3::new(rho * cos, rho * sin, self.tube * up)
    }

    /// The angle y round a section with y + tube sin y = mean: its area up to there.
    fn turn(&self, mean: f64) -> f64 {
        let [mut low, mut high] = [-PI, PI];
        let mut y = mean;
        for _ in 0..60 {
            let (sin, cos) = libm::sincos(y);
            let off = y + self.tube * sin - mean;
            if off < 0.0 {
                low = y;
            } else {
                high = y;
            }
            let newton = y - off / (1.0 + self.tube * cos);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - y).abs() <= 1e-15 {
                return next;
            }
            y = next;
        }
        y
    }

    /// By the distances of middles, and of the surface.
    fn rules(&self, o: DVec3) -> [Rule; 2] {
        let rho = o.truncate().length();
        let [near, far] = [-1.0, 1.0].map(|side| libm::hypot(rho + side, o.z));
        // Outside of it the nearest middle is farther than the surface; rounding may say otherwise.
        let off = (near - self.tube).max(1e-9 * near);
        let less = (near - off) * (near + off);
        [Rule { ends: [near, far], less: 0.0 }, Rule { ends: [off, (far * far - less).sqrt()], less }]
    }

    /// A point as it is seen from `o`, for two random numbers; `None`: of the section that was chosen nothing is seen.
    pub(super) fn towards(&self, o: DVec3, u: f64, v: f64) -> Option<DVec3> {
        let from_axis = o.truncate().try_normalize().unwrap_or(DVec2::X);
        let (rule, u) = if u < 0.5 { (0, 2.0 * u) } else { (1, 2.0 * u - 1.0) };
        let [near, far] = self.rules(o)[rule].ends;
        let tangent = near / far * libm::tan(PI * (u - 0.5));
        let down = 1.0 / (1.0 + tangent * tangent);
        // Sine and cosine of an angle by the tangent of its half.
        let turn = DVec2::new((1.0 - tangent * tangent) * down, 2.0 * tangent * down);
        let section = Section::of(o, turn.rotate(from_axis));
        let length = section.to.length();
        if length <= self.tube {
            return None;
        }
        let angle = (2.0 * v - 1.0) * libm::asin(self.tube / length);
        // The law of sines.
        let at_circle = libm::asin((length * libm::sin(angle) / self.tube).clamp(-1.0, 1.0));
        let (sin, cos) = libm::sincos(at_circle - angle);
        let normal = DVec2::new(cos, sin).rotate(section.to / length);
        let rho = 1.0 + self.tube * normal.x;
        Some((section.across * rho).extend(self.tube * normal.y))
    }

    /// The density of a direction, in solid angle.
    pub(super) fn density(&self, way: &Way) -> f64 {
        let ray = ObjectRay { o: way.o, d: way.d, t0: 0.0 };
        let within = torus::within(self.tube, &ray, None);
        let of = |near: f64| if near > 0.0 { self.density_at(way.o, way.o + near * way.d) } else { 0.0 };
        within.intervals().iter().map(|[near, _]| of(*near)).sum()
    }

    /// The density of a point that faces `o`.
    fn density_at(&self, o: DVec3, q: DVec3) -> f64 {
        let Some(across) = q.truncate().try_normalize() else { return 0.0 };
        let section = Section::of(o, across);
        let length2 = section.to.length_squared();
        if length2 <= self.tube * self.tube {
            return 0.0;
        }
        let middle2 = (o - across.extend(0.0)).length_squared();
        let in_plane2 = (section.to - DVec2::new(q.truncate().length() - 1.0, q.z)).length_squared();
        let distance2 = (o - q).length_squared();
        let spread = 2.0 * libm::asin(self.tube / length2.sqrt());
        let of = |rule: Rule| 0.5 * rule.ends[0] * rule.ends[1] / (TAU * (middle2 - rule.less));
        let section: f64 = self.rules(o).into_iter().map(of).sum();
        section * distance2 * distance2.sqrt() / (in_plane2 * spread * q.truncate().length())
    }
}

/// How sections are chosen.
struct Rule {
    /// Distances of the nearest and of the farthest middle, lessened.
    ends: [f64; 2],
    /// By how much less squared distances are.
    less: f64,
}
