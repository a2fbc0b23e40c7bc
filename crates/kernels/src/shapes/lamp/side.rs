//! Sides of cones and cylinders about the z axis that shine: a straight line of it, then a point of that line.
//!
//! A tangent plane of a cone passes through its apex, so of each line either all is seen or nothing: with R the radius
//! at the height of the point o, and r the distance of o from the axis, the line that lies x round from o is seen from
//! its front where r cos x > R. Lines are chosen by the angle under which the circle of radius R is seen at that
//! height, so that what is near is not chosen too seldom; above the apex, where there is no circle, by x alone. Points
//! of a line are chosen by the solid angle of the strip that it stands for: with D the distance of o from the line, t
//! the way along it from the point that is nearest to o, and R(t) = f + k t the radius there, the density goes with
//! R(t) D^2 / (D^2 + t^2)^(3/2), whose integral is G(t) = (f t - k D^2) / sqrt(D^2 + t^2). Of a cylinder all together
//! is uniform in the solid angle of what is seen at a height.

use super::Way;
use glam::{DVec2, DVec3};
use std::f64::consts::{PI, TAU};

/// A side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Side {
    /// Its radius at height z is middle + slope z.
    pub(super) middle: f64,
    /// See there.
    pub(super) slope: f64,
    /// It lies between z = -half and half.
    pub(super) half: f64,
}

/// Which part of it: what is seen from the front, or from the back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Facing {
    Near,
    Far,
}

/// How a point sees it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    o: DVec3,
    /// The distance from the axis, and the direction from there.
    rho: f64,
    out: DVec2,
    /// The radius at that height, below zero behind the apex.
    radius: f64,
}

/// A line of the side.
struct Line {
    /// The unit vector from the axis to it.
    out: DVec2,
    /// Its lower end, and the unit vector along it.
    foot: DVec3,
    along: DVec3,
    /// The point's distance from it, squared.
    distance2: f64,
    /// Its ends, from the point of it that is nearest.
    ends: [f64; 2],
    /// The radius at its ends.
    radii: [f64; 2],
    /// r cos x - R.
    height: f64,
}

impl Side {
    fn radius(&self, z: f64) -> f64 {
        self.middle + self.slope * z
    }

    /// Its area.
    pub(super) fn area(&self) -> f64 {
        2.0 * TAU * self.half * self.middle * self.stretch()
    }

    /// How much longer a line of it is than high.
    fn stretch(&self) -> f64 {
        (1.0 + self.slope * self.slope).sqrt()
    }

    /// Whether a point between its ends is within.
    pub(super) fn holds(&self, q: DVec3) -> bool {
        let r = self.radius(q.z);
        r >= 0.0 && q.truncate().length_squared() <= r * r
    }

    /// Whether a point of the surface of a closed one is rather on a cap.
    pub(super) fn is_beside(&self, q: DVec3) -> bool {
        let r = self.radius(q.z);
        self.half - q.z.abs() < (q.truncate().length() - r).abs()
    }

    /// A point as it is seen from the middle of one of its ends: -1 or 1.
    pub(super) fn beside_end(&self, o: DVec3, end: f64) -> DVec3 {
        o - DVec3::new(0.0, 0.0, end * self.half)
    }

    /// The density of a direction whose line comes to the side of a cylinder of radius 1 from outside; 0 of others.
    pub(super) fn density_of_line(&self, way: &Way) -> f64 {
        let (o, d) = (way.o.truncate(), way.d.truncate());
        let (a, b, c) = (d.length_squared(), o.dot(d), o.length_squared() - 1.0);
        let disc = b * b - a * c;
        if c <= 0.0 || b >= 0.0 || disc < 0.0 {
            return 0.0;
        }
        let q = way.o + c / (disc.sqrt() - b) * way.d;
        if q.z.abs() > self.half {
            return 0.0;
        }
        self.density(&self.seen(way.o), Facing::Near, &Way { q, ..*way })
    }

    /// A point, uniform in area.
    pub(super) fn point(&self, u: f64, v: f64) -> DVec3 {
        let [first, last] = [-self.half, self.half].map(|z| self.radius(z));
        let z = self.half * (2.0 * share(first, last, u) - 1.0);
        let r = self.radius(z);
        DVec3::new(r * libm::cos(TAU * v), r * libm::sin(TAU * v), z)
    }

    /// The unit normal at a point.
    pub(super) fn normal(&self, q: DVec3) -> DVec3 {
        let out = q.truncate().try_normalize().unwrap_or(DVec2::X);
        out.extend(-self.slope) / self.stretch()
    }

    pub(super) fn seen(&self, o: DVec3) -> Seen {
        let across = o.truncate();
        let rho = across.length();
        Seen { o, rho, out: across.try_normalize().unwrap_or(DVec2::X), radius: self.radius(o.z) }
    }

    fn line(&self, seen: &Seen, out: DVec2) -> Line {
        let radii = [-self.half, self.half].map(|z| self.radius(z));
        let foot = (out * radii[0]).extend(-self.half);
        let along = (out * self.slope).extend(1.0) / self.stretch();
        let from = seen.o - foot;
        let nearest = from.dot(along);
        Line {
            out,
            foot,
            along,
            distance2: from.cross(along).length_squared(),
            ends: [-nearest, 2.0 * self.half * self.stretch() - nearest],
            radii,
            height: seen.o.truncate().dot(out) - seen.radius,
        }
    }

    /// The solid angle, about: that of the line in its middle, times the number of lines.
    pub(super) fn measure(&self, seen: &Seen, facing: Facing) -> f64 {
        if !seen.sees(facing) {
            return 0.0;
        }
        let out = if facing == Facing::Near { seen.out } else { -seen.out };
        let line = self.line(seen, out);
        let density = self.of_line(seen, &line, facing) * line.density(0.5 * (line.ends[0] + line.ends[1]));
        if density > 0.0 && density.is_finite() { 1.0 / density } else { 0.0 }
    }

    /// A point, for two random numbers.
    pub(super) fn towards(&self, seen: &Seen, facing: Facing, u: f64, v: f64) -> DVec3 {
        let (sin, cos) = libm::sincos(seen.turn(facing, 2.0 * u - 1.0));
        let out = DVec2::new(seen.out.x * cos - seen.out.y * sin, seen.out.x * sin + seen.out.y * cos);
        let line = self.line(seen, out);
        let t = line.at(v).clamp(line.ends[0], line.ends[1]);
        line.foot + line.along * (t - line.ends[0])
    }

    /// The density of a direction that meets it, in solid angle.
    pub(super) fn density(&self, seen: &Seen, facing: Facing, way: &Way) -> f64 {
        if !seen.sees(facing) {
            return 0.0;
        }
        let line = self.line(seen, way.q.truncate().try_normalize().unwrap_or(seen.out));
        let t = line.ends[0] + (way.q - line.foot).dot(line.along);
        self.of_line(seen, &line, facing) * line.density(t)
    }

    /// The density of x over |r cos x - R|, times the stretch.
    fn of_line(&self, seen: &Seen, line: &Line, facing: Facing) -> f64 {
        let spread = seen.spread(facing);
        if seen.radius > 0.0 {
            // dx = l^2 / (R |r cos x - R|) of the angle, l the distance of the circle's point.
            let to = seen.o.truncate() - line.out * seen.radius;
            return seen.radius * self.stretch() / (to.length_squared() * spread);
        }
        self.stretch() / (spread * line.height.abs())
    }
}

impl Seen {
    /// Whether any of it is seen from there.
    fn sees(&self, facing: Facing) -> bool {
        match facing {
            Facing::Near => self.radius < self.rho,
            Facing::Far => self.radius > -self.rho,
        }
    }

    /// x at the edge of what is seen from the front, where there is no circle.
    fn edge(&self) -> f64 {
        if self.radius <= -self.rho { PI } else { libm::acos(self.radius / self.rho) }
    }

    /// From where to where lines are chosen: of angles, where there is no circle of x.
    fn spread(&self, facing: Facing) -> f64 {
        match facing {
            _ if self.radius > 0.0 && self.rho > self.radius => 2.0 * libm::asin(self.radius / self.rho),
            _ if self.radius > 0.0 => TAU,
            Facing::Near => 2.0 * self.edge(),
            Facing::Far => TAU - 2.0 * self.edge(),
        }
    }

    /// x for a number from -1 to 1.
    fn turn(&self, facing: Facing, number: f64) -> f64 {
        let angle = 0.5 * self.spread(facing) * number;
        if self.radius <= 0.0 {
            return if facing == Facing::Near { angle } else { PI + angle };
        }
        // The law of sines.
        let at_circle = libm::asin((self.rho * libm::sin(angle) / self.radius).clamp(-1.0, 1.0));
        if facing == Facing::Near { at_circle - angle } else { PI - angle - at_circle }
    }
}

impl Line {
    /// Both ends are on one side of the nearest point and so far away beside it that G loses its digits: points are
    /// uniform in area there.
    fn is_grazing(&self) -> bool {
        let [a, b] = self.ends;
        a * b > 0.0 && self.distance2 < 1e-6 * (a * a).min(b * b)
    }

    /// f and k.
    fn radius(&self) -> [f64; 2] {
        let [a, b] = self.ends;
        let k = (self.radii[1] - self.radii[0]) / (b - a);
        [self.radii[0] - k * a, k]
    }

    /// G(b) - G(a).
    fn integral(&self) -> f64 {
        let ([a, b], [f, k]) = (self.ends, self.radius());
        let [at_a, at_b] = [a, b].map(|t| (self.distance2 + t * t).sqrt());
        let (sines, squares) = (b * at_a, a * at_b);
        let difference =
            if a * b > 0.0 { self.distance2 * (b * b - a * a) / (sines + squares) } else { sines - squares };
        (f * difference - k * self.distance2 * (a * a - b * b) / (at_a + at_b)) / (at_a * at_b)
    }

    /// The density of t times the distance cubed, over the radius there.
    fn density(&self, t: f64) -> f64 {
        if self.is_grazing() {
            let distance2 = self.distance2 + t * t;
            return distance2 * distance2.sqrt()
                / (0.5 * (self.radii[0] + self.radii[1]) * (self.ends[1] - self.ends[0]));
        }
        self.distance2 / self.integral()
    }

    /// t for a number from 0 to 1.
    fn at(&self, number: f64) -> f64 {
        let ([a, b], [f, k]) = (self.ends, self.radius());
        if self.is_grazing() {
            return a + share(self.radii[0], self.radii[1], number) * (b - a);
        }
        // f sin - k D cos = n sin(angle - turn).
        let distance = self.distance2.sqrt();
        let n = (f * f + k * k * self.distance2).sqrt();
        let (sin_turn, cos_turn) = (k * distance / n, f / n);
        let begin = (f * a - k * self.distance2) / (self.distance2 + a * a).sqrt();
        let sin = ((begin + number * self.integral()) / n).clamp(-1.0, 1.0);
        let cos = (1.0 - sin * sin).sqrt();
        distance * (sin * cos_turn + cos * sin_turn) / (cos * cos_turn - sin * sin_turn)
    }
}

/// How far along a line a point lies whose density goes with the radius, for a number from 0 to 1.
fn share(first: f64, last: f64, number: f64) -> f64 {
    let root = (first * first + number * (last * last - first * first)).max(0.0).sqrt();
    if first + root > 0.0 { number * (first + last) / (first + root) } else { 0.0 }
}
