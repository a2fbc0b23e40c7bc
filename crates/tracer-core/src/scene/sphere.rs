//! Spheres, held so that f32 is enough for any radius.
//!
//! A sphere is a point P on its surface (the nearest to the origin), the outward unit normal N there and the curvature k = 1/r,
//! found in f64. With g = o - P a ray o + t d (d unit) meets it where k t^2 + 2 beta t + gamma = 0,
//! beta = N.d + k g.d, gamma = k g.g + 2 N.g. Nothing of the size of r occurs. Two classes:
//!
//! * *large* (r at least an eighth of the scene's size): lifted, gamma = k |o|^2 + 2 m.o + c, beta = k o.d + m.d with m = N - k P and
//!   c = k P.P - 2 N.P: eight fused operations;
//! * *small*: recentred, the same quadratic seen from the ray's closest approach to P (t = u - g.d), clean at every radius.

use super::padded;
use glam::DVec3;

/// A sphere in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: DVec3,
    /// Radius.
    pub radius: f64,
    /// Index into `Scene::materials`; [`super::NONE`] for a light's sphere.
    pub material: u32,
    /// Index into `Scene::lights`; [`super::NONE`] for an object.
    pub light: u32,
}

/// A sphere for the linear stage.
#[derive(Clone, Copy, Debug)]
pub struct LinearSphere {
    /// Primitive id.
    pub id: u32,
    /// P.
    pub p: [f32; 3],
    /// N.
    pub n: [f32; 3],
    /// 1/r.
    pub k: f32,
    /// r.
    pub r: f32,
    /// m.
    pub m: [f32; 3],
    /// c.
    pub c: f32,
}

/// Spheres as look-up tables (index = primitive id) and as lists for the linear stage.
pub(crate) struct SphereTable {
    pub p: [Vec<f32>; 3],
    pub n: [Vec<f32>; 3],
    pub k: Vec<f32>,
    /// Material (the emitters' entry for lights).
    pub material: Vec<f32>,
    /// Light + 1, or 0.
    pub light: Vec<f32>,
    /// Number of spheres.
    pub len: u32,
    /// Large spheres, tested by every ray.
    pub large: Vec<LinearSphere>,
    /// Small spheres, tested by every ray because they are few.
    pub small: Vec<LinearSphere>,
    /// So many of the first spheres hang in the tree.
    pub in_tree: usize,
}

/// Up to so many small spheres are tested by every ray over lanes; more of them go into the tree.
const FEW: usize = 24;

/// Radius from which a sphere is large, in render space.
const LARGE: f64 = 0.125;

/// How many spheres are small, if they are too many to be tested by every ray.
fn many_small(spheres: &[Sphere]) -> usize {
    let small = spheres.iter().filter(|s| s.radius < LARGE).count();
    if small > FEW { small } else { 0 }
}

impl SphereTable {
    /// Puts the spheres in the order of their primitive ids: those that hang in the tree first.
    pub fn order(spheres: &mut [Sphere]) {
        if many_small(spheres) > 0 {
            spheres.sort_by_key(|s| s.radius >= LARGE);
        }
    }

    /// Of spheres in their [`order`](SphereTable::order).
    pub fn new(spheres: &[Sphere], emitter_material: u32) -> Self {
        let linear: Vec<LinearSphere> = spheres.iter().enumerate().map(|(id, s)| anchor(id as u32, s)).collect();
        let in_tree = many_small(spheres);
        let every_ray = || linear.iter().skip(in_tree).copied();
        let is_large = |s: &LinearSphere| spheres[s.id as usize].radius >= LARGE;
        let large = every_ray().filter(is_large).collect();
        let small = every_ray().filter(|s| !is_large(s)).collect();
        let column = |f: &dyn Fn(&LinearSphere) -> f32| padded(linear.iter().map(f).collect());
        SphereTable {
            p: [0, 1, 2].map(|a| column(&|s| s.p[a])),
            n: [0, 1, 2].map(|a| column(&|s| s.n[a])),
            k: column(&|s| s.k),
            material: padded(
                spheres
                    .iter()
                    .map(|s| (if s.light == super::NONE { s.material } else { emitter_material }) as f32)
                    .collect(),
            ),
            light: padded(spheres.iter().map(|s| s.light.wrapping_add(1) as f32).collect()),
            len: spheres.len() as u32,
            large,
            small,
            in_tree,
        }
    }
}

fn anchor(id: u32, s: &Sphere) -> LinearSphere {
    let distance = s.center.length();
    let n = if distance > 0.0 { -s.center / distance } else { DVec3::Z };
    // Where |centre| and r are large and nearly equal, |centre| - r loses what centre + r n would lose per component.
    let p = n * (s.radius - distance);
    let k = 1.0 / s.radius;
    let m = n - p * k;
    let c = k * p.dot(p) - 2.0 * n.dot(p);
    LinearSphere {
        id,
        p: p.as_vec3().to_array(),
        n: n.as_vec3().to_array(),
        k: k as f32,
        r: s.radius as f32,
        m: m.as_vec3().to_array(),
        c: c as f32,
    }
}
