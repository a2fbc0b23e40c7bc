//! Spheres, held so that f32 is enough for any radius.
//!
//! A sphere is a point P on its surface (the nearest to the origin), the outward unit normal N there and the curvature
//! k = 1/r, found in f64. With g = o - P a ray o + t d (d unit) meets it where k t^2 + 2 beta t + gamma = 0, beta =
//! N.d + k g.d, gamma = k g.g + 2 N.g. Nothing of the size of r occurs. Where every ray is to test a sphere, there are
//! two forms:
//!
//! * *large* ones (see [`Sphere::is_large`]) are lifted, gamma = k |o|^2 + 2 m.o + c, beta = k o.d +
//!   m.d with m = N - k P and c = k P.P - 2 N.P: eight fused operations;
//! * *small* ones are seen from the ray's closest approach to their centre, which needs no P (Haines, Guenther,
//!   Akenine-Moeller: Precision Improvements for Ray/Sphere Intersection, Ray Tracing Gems, 2019): half the operations
//!   of the same about P. As exact where r is not large against the scene, and where the ray begins far away, a
//!   thousand radii or a million: what is lifted is wrong by 2^-24 (|o| / r)^2 of itself there, and a lamp of radius
//!   1 at 1000 was seen an eighth too large.

use super::table::Table;
use glam::DVec3;

/// A sphere in render space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: DVec3,
    /// Radius.
    pub radius: f64,
    /// Index into `Scene::materials`; [`super::NONE`] for a lamp that is no object.
    pub material: u32,
    /// Its object's place in the scene; of lamps that are none the number of objects and their own place.
    pub object: u32,
    /// Which of its object's copies it is.
    pub copy: u32,
    /// Index into `Scene::lights`; [`super::NONE`] for an object.
    pub light: u32,
    /// Which coordinates it is written in, where a pattern asks (`Scene::to_object`); 0 the world's.
    pub coordinates: u32,
}

/// A sphere by a point on its surface.
#[derive(Clone, Copy, Debug)]
struct Anchored {
    p: [f32; 3],
    n: [f32; 3],
    k: f32,
}

/// A large sphere, lifted.
#[derive(Clone, Copy, Debug)]
pub struct LargeSphere {
    /// Primitive id.
    pub id: u32,
    /// 1/r.
    pub k: f32,
    /// m.
    pub m: [f32; 3],
    /// c.
    pub c: f32,
}

/// A small sphere, by its centre.
#[derive(Clone, Copy, Debug)]
pub struct SmallSphere {
    /// Primitive id.
    pub id: u32,
    /// Centre.
    pub center: [f32; 3],
    /// r^2.
    pub r2: f32,
}

/// Spheres as a look-up table (index = primitive id) and as lists for the linear stage.
pub struct SphereTable {
    /// P, N, k, and the bits of the material (the emitters' entry for lights) and of light + 1, or 0.
    pub rows: Table<9>,
    /// Number of spheres.
    pub len: u32,
    /// Large spheres, tested by every ray.
    pub large: Vec<LargeSphere>,
    /// Small spheres, tested by every ray because they are few.
    pub small: Vec<SmallSphere>,
    /// So many of the first spheres hang in the tree.
    pub in_tree: usize,
}

/// Up to so many spheres below [`SMALL`] are tested by every ray over lanes; more of them go into the tree.
const FEW: usize = 24;

/// Radius from which a sphere may be large, in render space.
const LARGE: f64 = 2.0;

/// Large spheres are at most so many radii away: rays begin near the origin.
const NEAR: f64 = 16.0;

impl Sphere {
    /// Whether its size is much of what rays have to do with it: a floor or a wall.
    pub fn is_large(&self) -> bool {
        self.radius >= LARGE && self.center.length() <= NEAR * self.radius
    }
}

/// Radius below which a sphere is small, in render space: one for the tree, if there are many.
const SMALL: f64 = 0.125;

/// Up to so many spheres that are neither large nor small are tested by every ray, as most rays would come to them in a
/// tree; more of them go into it, and all small ones.
const SOME: usize = 24;

/// Which spheres hang in the tree: small ones, and, not without them, those that are neither large nor small.
#[derive(Clone, Copy)]
struct InTree {
    small: bool,
    others: bool,
}

impl InTree {
    fn of(spheres: &[Sphere]) -> Self {
        let count = |pick: fn(&Sphere) -> bool| spheres.iter().filter(|s| pick(s)).count();
        let others = count(|s| !s.is_large() && s.radius >= SMALL) > SOME;
        InTree { small: others || count(|s| !s.is_large() && s.radius < SMALL) > FEW, others }
    }

    fn holds(self, sphere: &Sphere) -> bool {
        !sphere.is_large() && if sphere.radius < SMALL { self.small } else { self.others }
    }
}

impl SphereTable {
    /// Puts the spheres in the order of their primitive ids: those that hang in the tree first.
    pub fn order(spheres: &mut [Sphere]) {
        let in_tree = InTree::of(spheres);
        if in_tree.small {
            spheres.sort_by_key(|sphere| !in_tree.holds(sphere));
        }
    }

    /// Of spheres in their [`order`](SphereTable::order).
    pub fn new(spheres: &[Sphere], emitter_material: u32) -> Self {
        let anchored: Vec<Anchored> = spheres.iter().map(Anchored::new).collect();
        let hangs = InTree::of(spheres);
        let in_tree = spheres.iter().filter(|sphere| hangs.holds(sphere)).count();
        let every_ray = || (0..).zip(spheres.iter().zip(&anchored)).skip(in_tree);
        let large = every_ray().filter(|(_, (s, _))| s.is_large()).map(|(id, (s, _))| LargeSphere::new(id, s));
        let small = every_ray().filter(|(_, (s, _))| !s.is_large()).map(|(id, (_, a))| SmallSphere::new(id, a));
        let rows = spheres.iter().zip(&anchored).map(|(s, &Anchored { p, n, k })| {
            let material = if s.material == super::NONE { emitter_material } else { s.material };
            let light = s.light.wrapping_add(1);
            [p[0], p[1], p[2], n[0], n[1], n[2], k, f32::from_bits(material), f32::from_bits(light)]
        });
        SphereTable {
            rows: Table::new(rows),
            len: spheres.len() as u32,
            large: large.collect(),
            small: small.collect(),
            in_tree,
        }
    }

    /// Those of the spheres that every ray tests which a camera sees, by what is hidden from it. They are not looked up
    /// here: of rows there are none.
    pub fn seen(&self, hidden: &[bool]) -> SphereTable {
        let is_seen = |id: u32| !hidden.get(id as usize).copied().unwrap_or(false);
        SphereTable {
            rows: Table::new([]),
            len: self.len,
            large: self.large.iter().filter(|sphere| is_seen(sphere.id)).copied().collect(),
            small: self.small.iter().filter(|sphere| is_seen(sphere.id)).copied().collect(),
            in_tree: self.in_tree,
        }
    }
}

/// P and N of a sphere: the point that is nearest to the origin.
fn anchor(s: &Sphere) -> (DVec3, DVec3) {
    let distance = s.center.length();
    let n = if distance > 0.0 { -s.center / distance } else { DVec3::Z };
    // Where |centre| and r are large and nearly equal, |centre| - r loses what centre + r n would lose per component.
    (n * (s.radius - distance), n)
}

impl Anchored {
    fn new(s: &Sphere) -> Self {
        let (p, n) = anchor(s);
        Anchored { p: p.as_vec3().to_array(), n: n.as_vec3().to_array(), k: (1.0 / s.radius) as f32 }
    }
}

impl LargeSphere {
    fn new(id: u32, s: &Sphere) -> Self {
        let (p, n) = anchor(s);
        let k = 1.0 / s.radius;
        let c = k * p.dot(p) - 2.0 * n.dot(p);
        LargeSphere { id, k: k as f32, m: (n - p * k).as_vec3().to_array(), c: c as f32 }
    }
}

impl SmallSphere {
    /// The sphere that the rounded P, N and k say, which is where rays that leave it start.
    fn new(id: u32, a: &Anchored) -> Self {
        let [p, n] = [a.p, a.n].map(|v| glam::Vec3::from(v).as_dvec3());
        let r = 1.0 / f64::from(a.k);
        SmallSphere { id, center: (p - n * r).as_vec3().to_array(), r2: (r * r) as f32 }
    }
}
