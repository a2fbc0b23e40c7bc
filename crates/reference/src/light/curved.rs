//! Points of curved lights, and the density of directions that meet them. A part of one, each as likely as the others;
//! in it a point that is uniform in area where the shape is of a size of one. What hides a part does not matter: all
//! that a direction's line passes through count.

use crate::torus;
use glam::DVec3;
use std::f64::consts::TAU;
use tracer_core::scene::CurvedLight;
use tracer_core::shapes::UnitShape;

/// A part of the surface of a unit shape.
enum Part {
    /// Of the sphere about (0, 0, z): what is between these heights above its middle.
    Zone { z: f64, from: f64, to: f64 },
    /// x^2 + y^2 = r(z)^2, r being linear, between these heights.
    Side { heights: [f64; 2], radii: [f64; 2] },
    /// At most `tube` away from the circle of radius 1 about the z axis.
    Ring { tube: f64 },
    /// At one height between two radii.
    Flat { z: f64, radii: [f64; 2] },
}

fn parts(unit: &UnitShape) -> Vec<Part> {
    match *unit {
        UnitShape::Sphere => vec![Part::Zone { z: 0.0, from: -1.0, to: 1.0 }],
        UnitShape::Disk { inner } => vec![Part::Flat { z: 0.0, radii: [inner, 1.0] }],
        UnitShape::Cone { radii, caps, .. } => {
            let side = Part::Side { heights: [-1.0, 1.0], radii };
            let cap = |z, r| Part::Flat { z, radii: [0.0, r] };
            let caps = [cap(-1.0, radii[0]), cap(1.0, radii[1])].into_iter().filter(|_| caps);
            let all = std::iter::once(side).chain(caps);
            all.filter(|part| !matches!(part, Part::Flat { radii: [_, outer], .. } if *outer == 0.0)).collect()
        }
        UnitShape::Capsule { half } => vec![
            Part::Zone { z: -half, from: -1.0, to: 0.0 },
            Part::Zone { z: half, from: 0.0, to: 1.0 },
            Part::Side { heights: [-half, half], radii: [1.0; 2] },
        ],
        UnitShape::Torus { tube } => vec![Part::Ring { tube }],
        UnitShape::Plane | UnitShape::Cube | UnitShape::Solid(_) => unreachable!("it does not shine"),
    }
}

impl Part {
    fn area(&self) -> f64 {
        match *self {
            Part::Zone { from, to, .. } => TAU * (to - from),
            Part::Side { heights: [low, high], radii: [first, last] } => {
                TAU / 2.0 * (first + last) * (high - low).hypot(last - first)
            }
            Part::Flat { radii: [inner, outer], .. } => TAU / 2.0 * (outer * outer - inner * inner),
            Part::Ring { tube } => TAU * TAU * tube,
        }
    }

    fn point(&self, u: f64, v: f64) -> DVec3 {
        let round = |r: f64, z: f64| DVec3::new(r * (TAU * v).cos(), r * (TAU * v).sin(), z);
        match *self {
            Part::Zone { z, from, to } => {
                let h = from + u * (to - from);
                round((1.0 - h * h).max(0.0).sqrt(), z + h)
            }
            Part::Side { heights: [low, high], radii: [first, last] } => {
                // The area up to a radius goes with its square.
                let r = (first * first + u * (last * last - first * first)).sqrt();
                let share = if first == last { u } else { (r - first) / (last - first) };
                round(r, low + share * (high - low))
            }
            Part::Flat { z, radii: [inner, outer] } => {
                round((inner * inner + u * (outer * outer - inner * inner)).sqrt(), z)
            }
            Part::Ring { tube } => {
                // The area up to an angle a goes with a + tube sin a.
                let [mut low, mut high] = [0.0, TAU];
                for _ in 0..60 {
                    let a: f64 = 0.5 * (low + high);
                    if a + tube * a.sin() < TAU * u { low = a } else { high = a }
                }
                round(1.0 + tube * low.cos(), tube * low.sin())
            }
        }
    }

    /// t of a line's points on it, and the normals there.
    fn passed(&self, o: DVec3, d: DVec3) -> Vec<(f64, DVec3)> {
        let roots = |a: f64, b: f64, c: f64| {
            let root = (b * b - a * c).sqrt();
            [(-b - root) / a, (-b + root) / a]
        };
        match *self {
            Part::Zone { z, from, to } => {
                let o = o - DVec3::new(0.0, 0.0, z);
                let all = roots(d.dot(d), o.dot(d), o.dot(o) - 1.0).map(|t| (t, o + t * d));
                all.into_iter().filter(|(_, q)| (from..=to).contains(&q.z)).collect()
            }
            Part::Side { heights: [low, high], radii: [first, last] } => {
                let slope = (last - first) / (high - low);
                let (r, dr) = (first + slope * (o.z - low), slope * d.z);
                let (p, e) = (o.truncate(), d.truncate());
                let all = roots(e.dot(e) - dr * dr, p.dot(e) - r * dr, p.dot(p) - r * r);
                let within = all.into_iter().filter(|t| (low..=high).contains(&(o.z + t * d.z)));
                within.map(|t| (t, (p + t * e).normalize().extend(-slope))).collect()
            }
            Part::Ring { tube } => {
                torus::crossings(tube, o, d).into_iter().map(|t| (t, torus::gradient(o + t * d))).collect()
            }
            Part::Flat { z, radii: [inner, outer] } => {
                let t = (z - o.z) / d.z;
                let within = (inner..=outer).contains(&(o + t * d).truncate().length());
                if within { vec![(t, DVec3::Z)] } else { Vec::new() }
            }
        }
    }
}

/// A point of a light in render space, for three random numbers.
pub fn point(light: &CurvedLight, [which, u, v]: [f64; 3]) -> DVec3 {
    let parts = parts(&light.unit);
    let part = &parts[((which * parts.len() as f64) as usize).min(parts.len() - 1)];
    light.placement.transform_point3(part.point(u, v))
}

/// The density in solid angle: of each point of the line d^2 / (A cos), A the part's area times how much larger the map
/// makes a piece with that normal.
pub fn density(light: &CurvedLight, from: DVec3, direction: DVec3) -> f64 {
    let matrix = light.placement.matrix3;
    let inverse = matrix.inverse();
    let (o, d) = (inverse * (from - light.placement.translation), inverse * direction);
    let parts = parts(&light.unit);
    let mut sum = 0.0;
    for part in &parts {
        for (t, n) in part.passed(o, d) {
            // cof(M) n = det(M) M^-T n: its length is the growth, its direction the normal in render space.
            let grown = matrix.determinant() * (inverse.transpose() * n.normalize());
            if t > 0.0 {
                sum += t * t / (part.area() * grown.dot(direction).abs());
            }
        }
    }
    sum / parts.len() as f64
}
