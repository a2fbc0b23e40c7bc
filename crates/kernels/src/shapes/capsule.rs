//! Capsules: at most 1 away from the z axis between z = -half and half. Parameters: half.
//!
//! A cylinder and two balls that overlap: their union is convex, so the line is within it from the least to the
//! greatest of their ends.

use super::{Interval, ObjectRay, OnUnit, ball, both, first_end, longitude, quadratic, slab};
use glam::{DVec2, DVec3};
use std::f64::consts::PI;

/// The height of the nearest point of the axis.
fn foot(q: DVec3, half: f64) -> f64 {
    q.z.clamp(-half, half)
}

pub(super) fn hit(&[half, ..]: &[f32; 3], ray: &ObjectRay, leaves: bool) -> Option<f64> {
    let half = f64::from(half);
    let foot = foot(ray.o, half);
    if leaves && (ray.o - DVec3::new(0.0, 0.0, foot)).dot(ray.d) >= 0.0 {
        return None;
    }
    let on_side = leaves && foot.abs() < half;
    let (o, d) = (ray.o.truncate(), ray.d.truncate());
    let a = d.dot(d);
    let gamma = if on_side { 0.0 } else { o.dot(o) - 1.0 };
    let side = match a > 0.0 {
        true => quadratic(a, o.dot(d), gamma),
        false => (gamma <= 0.0).then_some([f64::NEG_INFINITY, f64::INFINITY]),
    };
    let side = side.zip(slab(ray, half)).and_then(|(side, slab)| both(side, slab));
    let ball_at = |z: f64| ball(ray, z, leaves && !on_side && foot == z);
    let parts = [side, ball_at(-half), ball_at(half)];
    let whole = parts.into_iter().flatten().reduce(|a: Interval, b| [a[0].min(b[0]), a[1].max(b[1])])?;
    first_end(ray, whole, leaves)
}

pub(super) fn surface(&[half, ..]: &[f32; 3], q: DVec3) -> OnUnit {
    let half = f64::from(half);
    let foot = foot(q, half);
    let n = (q - DVec3::new(0.0, 0.0, foot)).try_normalize().unwrap_or(DVec3::X);
    // The way along the outline from the lower end.
    let way = PI - libm::acos(n.z.clamp(-1.0, 1.0)) + foot + half;
    OnUnit { q: n + DVec3::new(0.0, 0.0, foot), n, uv: DVec2::new(longitude(q), way / (PI + 2.0 * half)) }
}
