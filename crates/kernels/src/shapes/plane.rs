//! Planes: z = 0, facing +z, without an end. Texture coordinates are x and y. They hang in no tree: rays are tested
//! with them by a table of their own ([`crate::scene::PlaneTable`]), and come here for the surface.

use super::{ObjectRay, OnUnit};
use glam::DVec3;

pub(super) fn hit(ray: &ObjectRay, leaves: bool) -> Option<f64> {
    // A line meets a plane once: who leaves it does not come back.
    if leaves || ray.d.z == 0.0 {
        return None;
    }
    let t = ray.t0 - ray.o.z / ray.d.z;
    (t > 0.0).then_some(t)
}

/// z and radii of its flat face.
pub(super) fn face() -> (f64, [f64; 2]) {
    (0.0, [0.0, f64::INFINITY])
}

pub(super) fn surface(q: DVec3) -> OnUnit {
    OnUnit { q: DVec3::new(q.x, q.y, 0.0), n: DVec3::Z, uv: q.truncate() }
}
