//! Disks: x^2 + y^2 <= 1 at z = 0, with a hole. Parameters: its radius.

use super::{ObjectRay, OnUnit};
use glam::{DVec2, DVec3};

pub(super) fn hit(&[inner, ..]: &[f32; 3], ray: &ObjectRay, leaves: bool) -> Option<f64> {
    // A line meets a plane once: who leaves it does not come back.
    if leaves || ray.d.z == 0.0 {
        return None;
    }
    let t = -(ray.o.z / ray.d.z);
    let at = ray.o.truncate() + t * ray.d.truncate();
    let inner = f64::from(inner);
    let within = at.dot(at) <= 1.0 && at.dot(at) >= inner * inner;
    within.then_some(ray.t0 + t).filter(|&t| t > 0.0)
}

/// z and radii of its flat face.
pub(super) fn face(&[inner, ..]: &[f32; 3]) -> (f64, [f64; 2]) {
    (0.0, [f64::from(inner), 1.0])
}

pub(super) fn surface(_: &[f32; 3], q: DVec3) -> OnUnit {
    OnUnit { q: DVec3::new(q.x, q.y, 0.0), n: DVec3::Z, uv: square(q.x, q.y) }
}

/// Texture coordinates over the square around a circle of radius 1.
pub(super) fn square(right: f64, up: f64) -> DVec2 {
    DVec2::new(0.5 + 0.5 * right, 0.5 + 0.5 * up)
}
