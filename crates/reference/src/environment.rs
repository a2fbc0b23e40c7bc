//! Pictures of all directions.

use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tracer_core::scene::Environment;

/// Radiance, in the scene's unit, that comes from where a ray of this direction goes.
pub fn radiance(sky: &Environment, direction: DVec3) -> DVec3 {
    let [right, up, front] = sky.axes;
    let d = direction.normalize();
    let longitude = d.dot(right).atan2(d.dot(front));
    let colatitude = d.dot(up).clamp(-1.0, 1.0).acos();
    // Texel (i, j) covers [i, i + 1) x [j, j + 1), row 0 at the top; between their middles it is linear.
    let x = (0.5 + longitude / TAU) * f64::from(sky.width) - 0.5;
    let y = colatitude / PI * f64::from(sky.height) - 0.5;
    let row = |j: f64| texel(sky, x.floor(), j).lerp(texel(sky, x.floor() + 1.0, j), x - x.floor());
    row(y.floor()).lerp(row(y.floor() + 1.0), y - y.floor())
}

fn texel(sky: &Environment, i: f64, j: f64) -> DVec3 {
    let column = i.rem_euclid(f64::from(sky.width)) as u32;
    let row = j.clamp(0.0, f64::from(sky.height - 1)) as u32;
    DVec3::from(sky.texel(column, row).expect("a texel of the picture").map(f64::from))
}
