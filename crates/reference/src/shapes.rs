//! Curved shapes that are no spheres, by their equations in the space where each is of a size of one.

use crate::surface::Surface;
use crate::{Ray, torus};
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};
use tracer_core::scene::Shape;
use tracer_core::shapes::UnitShape;

/// Nearer hits are the surface that the ray leaves.
pub const NEAREST: f64 = 1e-9;

/// A quadric x.A x + b.x + c = 0 with A diagonal, b along z, and the z between which it counts.
struct Sheet {
    squares: [f64; 3],
    linear: f64,
    constant: f64,
    between: [f64; 2],
}

/// A piece of a plane z = height that faces along `normal`, between two radii.
struct Flat {
    height: f64,
    normal: f64,
    radii: [f64; 2],
}

/// All pieces of a shape's surface.
fn pieces(unit: &UnitShape) -> (Vec<Sheet>, Vec<Flat>) {
    let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
    match *unit {
        UnitShape::Sphere => {
            (vec![Sheet { squares: [1.0; 3], linear: 0.0, constant: -1.0, between: everywhere }], Vec::new())
        }
        UnitShape::Plane => (Vec::new(), vec![Flat { height: 0.0, normal: 1.0, radii: [0.0, f64::INFINITY] }]),
        UnitShape::Disk { inner } => (Vec::new(), vec![Flat { height: 0.0, normal: 1.0, radii: [inner, 1.0] }]),
        UnitShape::Cone { radii: [first, last], caps, .. } => {
            let (m, s) = ((first + last) / 2.0, (last - first) / 2.0);
            // x^2 + y^2 - (m + s z)^2
            let side =
                Sheet { squares: [1.0, 1.0, -s * s], linear: -2.0 * m * s, constant: -m * m, between: [-1.0, 1.0] };
            let caps = match caps {
                true => vec![
                    Flat { height: -1.0, normal: -1.0, radii: [0.0, first] },
                    Flat { height: 1.0, normal: 1.0, radii: [0.0, last] },
                ],
                false => Vec::new(),
            };
            (vec![side], caps)
        }
        UnitShape::Capsule { half } => {
            let ball = |z: f64, between| Sheet { squares: [1.0; 3], linear: -2.0 * z, constant: z * z - 1.0, between };
            let side = Sheet { squares: [1.0, 1.0, 0.0], linear: 0.0, constant: -1.0, between: [-half, half] };
            (vec![side, ball(-half, [-half - 2.0, -half]), ball(half, [half, half + 2.0])], Vec::new())
        }
        UnitShape::Cube => {
            let pair = |axis: usize| {
                let mut squares = [0.0; 3];
                squares[axis] = 1.0;
                Sheet { squares, linear: 0.0, constant: -0.25, between: everywhere }
            };
            ((0..3).map(pair).collect(), Vec::new())
        }
        // See `torus` and `solids`.
        UnitShape::Torus { .. } | UnitShape::Solid(_) => (Vec::new(), Vec::new()),
    }
}

/// The ray in object space; t is the same.
fn object_ray(ray: &Ray, shape: &Shape) -> (DVec3, DVec3, DMat3) {
    let inverse = shape.placement.matrix3.inverse();
    (inverse * (ray.origin - shape.placement.translation), inverse * ray.direction, inverse)
}

/// The nearest hit ahead.
pub fn meet(ray: &Ray, shape: &Shape) -> Option<f64> {
    crossings(ray, shape).into_iter().filter(|&t| t > NEAREST).reduce(f64::min)
}

/// Every t, also behind the ray's origin, where its line crosses a piece of the surface; of cubes also where it crosses
/// the planes of their faces.
pub fn crossings(ray: &Ray, shape: &Shape) -> Vec<f64> {
    let (o, d, _) = object_ray(ray, shape);
    if let UnitShape::Torus { tube } = shape.unit {
        return torus::crossings(tube, o, d);
    }
    let (sheets, flats) = pieces(&shape.unit);
    let mut found = Vec::new();
    for Sheet { squares, linear, constant, between } in sheets {
        let squares = DVec3::from(squares);
        let (a, b) = ((squares * d).dot(d), 2.0 * (squares * o).dot(d) + linear * d.z);
        let c = (squares * o).dot(o) + linear * o.z + constant;
        let root = (b * b - 4.0 * a * c).sqrt();
        for t in [(-b - root) / (2.0 * a), (-b + root) / (2.0 * a)] {
            let z = o.z + t * d.z;
            if t.is_finite() && z >= between[0] && z <= between[1] {
                found.push(t);
            }
        }
    }
    for Flat { height, radii: [inner, outer], .. } in flats {
        let t = (height - o.z) / d.z;
        let r = (o + t * d).truncate().length();
        if t.is_finite() && r >= inner && r <= outer {
            found.push(t);
        }
    }
    found
}

/// The surface at a hit: that of the piece whose equation holds best there.
pub fn surface(body: u32, shape: &Shape, p: DVec3, direction: DVec3) -> Surface {
    let inverse = shape.placement.matrix3.inverse();
    let q = inverse * (p - shape.placement.translation);
    if shape.unit == UnitShape::Cube {
        return on_cube(body, shape.material, (p, q), &inverse, direction);
    }
    let (sheets, flats) = pieces(&shape.unit);
    let mut best = (f64::INFINITY, DVec3::Z, None);
    for Sheet { squares, linear, constant, between } in sheets {
        let value = (DVec3::from(squares) * q).dot(q) + linear * q.z + constant;
        if q.z > between[0] - 1e-7 && q.z < between[1] + 1e-7 && value.abs() < best.0 {
            best = (value.abs(), 2.0 * DVec3::from(squares) * q + DVec3::new(0.0, 0.0, linear), None);
        }
    }
    for Flat { height, normal, radii: [_, outer] } in flats {
        let away = (q.z - height).abs();
        if away < best.0 && q.truncate().length() < outer + 1e-7 {
            best = (away, DVec3::new(0.0, 0.0, normal), Some((normal, outer)));
        }
    }
    let (_, mut gradient, flat) = best;
    if let UnitShape::Torus { .. } = shape.unit {
        gradient = torus::gradient(q);
    }
    let outward = (inverse.transpose() * gradient).normalize();
    let outside = outward.dot(direction) < 0.0;
    let n = if outside { outward } else { -outward };
    let uv = uv(&shape.unit, q, flat);
    Surface { p, start: p, ng: n, ns: n, smooth: false, outside, uv, material: shape.material, body, on_mesh: None }
}

/// The face of a cube that is nearest: a rectangle that faces outwards, as the manual says.
fn on_cube(body: u32, material: u32, (p, q): (DVec3, DVec3), inverse: &DMat3, direction: DVec3) -> Surface {
    let axis = (0..3).fold(0, |best, axis| if q[axis].abs() > q[best].abs() { axis } else { best });
    let mut normal = DVec3::ZERO;
    normal[axis] = q[axis].signum();
    let outward = (inverse.transpose() * normal).normalize();
    let right = if axis == 1 { DVec3::X } else { DVec3::Y.cross(normal) };
    let up = normal.cross(right);
    let outside = outward.dot(direction) < 0.0;
    let n = if outside { outward } else { -outward };
    let uv = [0.5 + right.dot(q), 0.5 + up.dot(q)];
    Surface { p, start: p, ng: n, ns: n, smooth: false, outside, uv, material, body, on_mesh: None }
}

/// Texture coordinates as the manual says them.
fn uv(unit: &UnitShape, q: DVec3, flat: Option<(f64, f64)>) -> [f64; 2] {
    let round = 0.5 + q.x.atan2(-q.y) / TAU;
    match (*unit, flat) {
        (UnitShape::Sphere, _) => {
            let n = q.normalize();
            [0.5 + n.x.atan2(n.z) / TAU, 1.0 - n.y.clamp(-1.0, 1.0).acos() / PI]
        }
        (UnitShape::Cone { upright, .. }, Some((normal, radius))) if normal < 0.0 => {
            let (right, up) = if upright { (q.x, -q.y) } else { (-q.x, q.y) };
            [(right / radius + 1.0) / 2.0, (up / radius + 1.0) / 2.0]
        }
        (UnitShape::Torus { .. }, _) => [round, torus::section(q)],
        (UnitShape::Plane, _) => [q.x, q.y],
        (_, Some((_, radius))) => [(q.x / radius + 1.0) / 2.0, (q.y / radius + 1.0) / 2.0],
        (UnitShape::Capsule { half }, None) => {
            let along = if q.z > half {
                PI / 2.0 + 2.0 * half + (q.z - half).clamp(-1.0, 1.0).asin()
            } else if q.z < -half {
                PI / 2.0 + (q.z + half).clamp(-1.0, 1.0).asin()
            } else {
                PI / 2.0 + half + q.z
            };
            [round, along / (PI + 2.0 * half)]
        }
        _ => [round, (q.z + 1.0) / 2.0],
    }
}
