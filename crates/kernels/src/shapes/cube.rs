//! The cube of side 1 about the origin: a box under a map, as an operand of [`super::csg`]. Boxes by themselves are
//! triangles.

use super::{Interval, ObjectRay, OnUnit, both, first_end};
use glam::{DVec2, DVec3};

/// Axis and sign of the face that is nearest.
fn face(q: DVec3) -> (usize, f64) {
    let size = q.abs();
    let axis = match (size.x >= size.y && size.x >= size.z, size.y >= size.z) {
        (true, _) => 0,
        (_, true) => 1,
        _ => 2,
    };
    (axis, 1f64.copysign(q[axis]))
}

pub(super) fn hit(ray: &ObjectRay, leaves: bool) -> Option<f64> {
    let from = leaves.then(|| face(ray.o));
    if let Some((axis, sign)) = from
        && sign * ray.d[axis] >= 0.0
    {
        return None;
    }
    let mut within: Interval = [f64::NEG_INFINITY, f64::INFINITY];
    for axis in 0..3 {
        let (o, d) = (ray.o[axis], ray.d[axis]);
        if d == 0.0 {
            if o.abs() > 0.5 {
                return None;
            }
            continue;
        }
        let [a, b] = [(-0.5 - o) / d, (0.5 - o) / d];
        let near = if from.is_some_and(|from| from.0 == axis) { 0.0 } else { a.min(b) };
        within = both(within, [near, a.max(b)])?;
    }
    first_end(ray, within, leaves)
}

/// Each face is a rectangle that faces outwards: right and up as they are there.
pub(super) fn surface(q: DVec3) -> OnUnit {
    let (axis, sign) = face(q);
    let (mut on, mut n) = (q.clamp(DVec3::splat(-0.5), DVec3::splat(0.5)), DVec3::ZERO);
    on[axis] = 0.5 * sign;
    n[axis] = sign;
    let [right, up] = match axis {
        0 => [-sign * q.z, q.y],
        1 => [q.x, -sign * q.z],
        _ => [sign * q.x, q.y],
    };
    OnUnit { q: on, n, uv: DVec2::new(0.5 + right, 0.5 + up) }
}
