//! Shapes about an axis: made about the y axis, then stood up along any other.

#![expect(clippy::indexing_slicing, reason = "axes are numbered here")]

use crate::data::MeshData;
use scene_format::path::{Point3, dot, unit};

/// Directions nearer to the y axis than this have (1, 0, 0) to their right: as of a `Disk` and a sphere's texture
/// coordinates.
const UPRIGHT: f64 = 0.9999;

/// a x b.
pub fn cross(a: Point3, b: Point3) -> Point3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The mesh with its y axis along another direction, of any length but zero, and its origin somewhere else. Its x axis
/// goes to the right of that direction, (0, 1, 0) x it.
pub fn stand(mut mesh: MeshData, origin: Point3, axis: Point3) -> MeshData {
    let y = unit(axis).unwrap_or([0.0, 1.0, 0.0]);
    let x = if y[1].abs() > UPRIGHT { None } else { unit(cross([0.0, 1.0, 0.0], y)) };
    // About an axis that is nearly upright: at right angles to it all the same.
    let x = x.or_else(|| unit(std::array::from_fn(|k| if k == 0 { 1.0 - y[0] * y[0] } else { -y[0] * y[k] })));
    let x = x.unwrap_or([1.0, 0.0, 0.0]);
    let z = cross(x, y);
    let rows: [Point3; 3] = std::array::from_fn(|k| [x[k], y[k], z[k]]);
    for position in &mut mesh.positions {
        let p = *position;
        *position = std::array::from_fn(|k| origin[k] + dot(rows[k], p));
    }
    for normal in &mut mesh.normals {
        let n = normal.map(f64::from);
        *normal = rows.map(|row| dot(row, n) as f32);
    }
    mesh
}
