//! Cones, cylinders among them: x^2 + y^2 = R(z)^2, R = middle + slope z >= 0, |z| <= 1. Parameters: R(-1), R(1), and
//! bits that say whether they are closed.
//!
//! The line is within the double cone where a t^2 + 2 beta t + gamma <= 0, and R >= 0 on one side of its apex only. A
//! closed one is what that and the slab |z| <= 1 have in common: convex, so one interval.

use super::{CAPS, Interval, ObjectRay, OnUnit, UPRIGHT, both, disk, first_end, longitude, quadratic, slab};
use glam::{DVec2, DVec3};

/// How R runs.
#[derive(Clone, Copy)]
pub(super) struct Side {
    middle: f64,
    pub(super) slope: f64,
}

impl Side {
    /// With these radii at z = -1 and 1.
    pub(super) fn of([first, last]: [f64; 2]) -> Self {
        Side { middle: 0.5 * (first + last), slope: 0.5 * (last - first) }
    }

    pub(super) fn radius(self, z: f64) -> f64 {
        self.middle + self.slope * z
    }

    /// a, beta, gamma along a line; `on`: it starts on the side.
    fn quadratic(self, ray: &ObjectRay, on: bool) -> [f64; 3] {
        let (o, d) = (ray.o.truncate(), ray.d.truncate());
        let (r, dr) = (self.radius(ray.o.z), self.slope * ray.d.z);
        [d.dot(d) - dr * dr, o.dot(d) - r * dr, if on { 0.0 } else { o.dot(o) - r * r }]
    }

    /// Where the line is within the half of the double cone with R >= 0.
    pub(super) fn within(self, ray: &ObjectRay, on: bool) -> Option<Interval> {
        let [a, beta, gamma] = self.quadratic(ray, on);
        if a > 0.0 {
            return quadratic(a, beta, gamma);
        }
        let (before, after) = (|t: f64| [f64::NEG_INFINITY, t], |t: f64| [t, f64::INFINITY]);
        if a == 0.0 {
            // Along a line of the cone, or along the axis of a cylinder.
            return match beta {
                0.0 => (gamma <= 0.0).then_some([f64::NEG_INFINITY, f64::INFINITY]),
                _ if beta > 0.0 => Some(before(-0.5 * gamma / beta)),
                _ => Some(after(-0.5 * gamma / beta)),
            };
        }
        // Steeper than the cone: the line comes from within one half and goes on into the other.
        let root = (beta * beta - a * gamma).max(0.0).sqrt();
        let q = -(beta + root.copysign(beta));
        let [first, second] = if q == 0.0 { [0.0; 2] } else { [gamma / q + 0.0, q / a] };
        let widens = self.slope * ray.d.z > 0.0;
        Some(if widens { after(first.max(second)) } else { before(first.min(second)) })
    }
}

fn side(&[first, last, _]: &[f32; 3]) -> Side {
    Side::of([f64::from(first), f64::from(last)])
}

fn flags(parameters: &[f32; 3]) -> u32 {
    parameters[2].to_bits()
}

/// The cap that a point near the surface lies on, by the sign of its z; `None`: the side.
fn cap(side: Side, q: DVec3, flags: u32) -> Option<f64> {
    let r = side.radius(q.z);
    let from_side = (q.x * q.x + q.y * q.y - r * r).abs();
    (flags & CAPS != 0 && 1.0 - q.z.abs() < from_side).then_some(1f64.copysign(q.z))
}

pub(super) fn hit(parameters: &[f32; 3], ray: &ObjectRay, leaves: bool) -> Option<f64> {
    let (side, flags) = (side(parameters), flags(parameters));
    if flags & CAPS == 0 {
        return open(side, ray, leaves);
    }
    let from_cap = if leaves { cap(side, ray.o, flags) } else { None };
    if let Some(z) = from_cap
        && z * ray.d.z >= 0.0
    {
        return None;
    }
    let within = side.within(ray, leaves && from_cap.is_none())?;
    first_end(ray, both(within, slab(ray, 1.0)?)?, leaves)
}

/// Without caps both roots count that are between the ends.
fn open(side: Side, ray: &ObjectRay, leaves: bool) -> Option<f64> {
    let [a, beta, gamma] = side.quadratic(ray, leaves);
    let disc = beta * beta - a * gamma;
    let q = -(beta + disc.max(0.0).sqrt().copysign(beta));
    // Of a line that is steeper than the cone rounding may only hide that it passes through the apex.
    if q == 0.0 || disc < 0.0 && a > 0.0 {
        return None;
    }
    // A ray that leaves the side is not met where it starts. Where a is 0 there is no second root.
    let first = if leaves { f64::NAN } else { gamma / q };
    let second = if a == 0.0 { f64::NAN } else { q / a };
    let counts = |t: &f64| ray.t0 + *t > 0.0 && (ray.o.z + *t * ray.d.z).abs() <= 1.0;
    [first, second].into_iter().filter(counts).reduce(f64::min).map(|t| ray.t0 + t)
}

/// z and radii of its caps, where it has any.
pub(super) fn faces(parameters: &[f32; 3]) -> [Option<(f64, [f64; 2])>; 2] {
    let side = side(parameters);
    [-1.0, 1.0].map(|z| (flags(parameters) & CAPS != 0 && side.radius(z) > 0.0).then(|| (z, [0.0, side.radius(z)])))
}

pub(super) fn surface(parameters: &[f32; 3], q: DVec3) -> OnUnit {
    let (side, flags) = (side(parameters), flags(parameters));
    if let Some(z) = cap(side, q, flags) {
        // Seen from below right is where left is from above, but for upright axes, where right is +x for both.
        let r = side.radius(z);
        let [right, up] = match (z > 0.0, flags & UPRIGHT != 0) {
            (true, _) => [q.x / r, q.y / r],
            (false, false) => [-q.x / r, q.y / r],
            (false, true) => [q.x / r, -q.y / r],
        };
        return OnUnit { q: DVec3::new(q.x, q.y, z), n: DVec3::new(0.0, 0.0, z), uv: disk::square(right, up) };
    }
    let z = q.z.clamp(-1.0, 1.0);
    let out = q.truncate().try_normalize().unwrap_or(DVec2::X);
    OnUnit {
        q: (side.radius(z) * out).extend(z),
        n: out.extend(-side.slope),
        uv: DVec2::new(longitude(q), 0.5 + 0.5 * z),
    }
}
