//! Disks across the z axis that shine, caps among them: a half-line of the plane from the point below (or above) the
//! one that sees it, then a point of what the disk covers of that.
//!
//! Half-lines are chosen by their angle, points of one by solid angle: with h the height above the plane and s the way
//! along it, dw = h s ds dx / (s^2 + h^2)^(3/2), whose integral is w(s) = 1 - h / sqrt(s^2 + h^2). So what is near is
//! not chosen too seldom, and one over the density is never more than 2 pi.

use super::Way;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A disk, or what two circles enclose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flat {
    /// Its height.
    pub(super) z: f64,
    /// Radii of both circles.
    pub(super) radii: [f64; 2],
}

/// What a half-line has in common with a disk: from where to where, and where its hole is.
struct Covered {
    height: f64,
    ends: [f64; 2],
    hole: [f64; 2],
}

impl Flat {
    /// Its area.
    pub(super) fn area(&self) -> f64 {
        PI * (self.radii[1] * self.radii[1] - self.radii[0] * self.radii[0])
    }

    /// The solid angle, about: that of a disk seen from its axis, with the distance of its nearest point and the height
    /// above it.
    pub(super) fn measure(&self, o: DVec3) -> f64 {
        let [inner, outer] = self.radii;
        let height = (o.z - self.z).abs();
        let off = (o.truncate().length() - outer).max(0.0);
        let nearest = (height * height + off * off).sqrt();
        if height <= 0.0 || outer <= inner {
            return 0.0;
        }
        let spread = outer * outer * height / (nearest * nearest * nearest);
        TAU * (1.0 - inner * inner / (outer * outer)) * spread / (1.0 + spread + (1.0 + spread).sqrt())
    }

    /// A point, uniform in area.
    pub(super) fn point(&self, u: f64, v: f64) -> DVec3 {
        let [inner, outer] = self.radii.map(|r| r * r);
        let r = (inner + u * (outer - inner)).sqrt();
        DVec3::new(r * libm::cos(TAU * v), r * libm::sin(TAU * v), self.z)
    }

    /// A point as it is seen from `o`, for two random numbers.
    pub(super) fn towards(&self, o: DVec3, u: f64, v: f64) -> DVec3 {
        let (sin, cos) = libm::sincos((u - 0.5) * self.spread(o));
        let to_axis = -o.truncate().try_normalize().unwrap_or(DVec2::X);
        let out = DVec2::new(to_axis.x * cos - to_axis.y * sin, to_axis.x * sin + to_axis.y * cos);
        (o.truncate() + out * self.covered(o, out).at(v)).extend(self.z)
    }

    /// The density of a direction that meets it, in solid angle.
    pub(super) fn density(&self, way: &Way) -> f64 {
        let out = way.d.truncate().try_normalize().unwrap_or(DVec2::X);
        1.0 / (self.spread(way.o) * self.covered(way.o, out).measure())
    }

    /// The angle that all half-lines over it have together.
    fn spread(&self, o: DVec3) -> f64 {
        let (rho, outer) = (o.truncate().length(), self.radii[1]);
        if rho > outer { 2.0 * libm::asin(outer / rho) } else { TAU }
    }

    fn covered(&self, o: DVec3, out: DVec2) -> Covered {
        let [hole, ends] = self.radii.map(|r| chord(o.truncate(), out, r));
        let ends = ends.unwrap_or([0.0; 2]);
        Covered { height: (o.z - self.z).abs(), ends, hole: hole.unwrap_or([ends[1]; 2]) }
    }
}

impl Covered {
    /// w(to) - w(from).
    fn between(&self, from: f64, to: f64) -> f64 {
        let [a, b] = [from, to].map(|s| (s * s + self.height * self.height).sqrt());
        self.height * (to - from) * (to + from) / (a * b * (a + b))
    }

    fn measure(&self) -> f64 {
        self.between(self.ends[0], self.hole[0]) + self.between(self.hole[1], self.ends[1])
    }

    /// The way along the half-line for a number from 0 to 1.
    fn at(&self, number: f64) -> f64 {
        let before = self.between(self.ends[0], self.hole[0]);
        let mut rest = number * (before + self.between(self.hole[1], self.ends[1]));
        let mut from = self.ends[0];
        if rest >= before {
            rest -= before;
            from = self.hole[1];
        }
        let w = (self.between(0.0, from) + rest).min(1.0 - f64::EPSILON);
        let s = self.height * (w * (2.0 - w)).max(0.0).sqrt() / (1.0 - w);
        s.clamp(self.ends[0], self.ends[1])
    }
}

/// From where to where a half-line is within a circle about the origin.
fn chord(from: DVec2, out: DVec2, radius: f64) -> Option<[f64; 2]> {
    let (along, across) = (from.dot(out), from.perp_dot(out));
    let half = (radius - across) * (radius + across);
    if half <= 0.0 || radius <= 0.0 {
        return None;
    }
    let (half, product) = (half.sqrt(), from.length_squared() - radius * radius);
    let ends = if along < 0.0 {
        let far = half - along;
        [product / far, far]
    } else {
        let near = -along - half;
        [near, product / near]
    };
    (ends[1] > 0.0).then(|| ends.map(|s| s.max(0.0)))
}
