//! What rays can hit: every sphere, every other curved shape and every triangle of every copy, in one list each.

use crate::{Ray, Smoothing, shapes, solids, surface};
use glam::{DMat3, DVec3};
use tracer_core::Scene;
use tracer_core::scene::{self, Instance, NONE, Sphere};
use tracer_core::shapes::UnitShape;

/// Nearer hits are the surface that the ray leaves. Render space is of size one, and `f64` has 16 digits.
const NEAREST: f64 = 1e-9;

/// A triangle in render space.
pub struct Triangle {
    pub corners: [DVec3; 3],
    /// Vertex normals of smooth ones.
    pub normals: Option<[DVec3; 3]>,
    pub uvs: Option<[[f64; 2]; 3]>,
    pub material: u32,
    /// Index of the light, or `NONE`.
    pub light: u32,
    /// The object that it is of.
    pub object: u32,
    /// See [`surface::Surface::body`].
    pub body: u32,
    /// The numbers of the corners.
    pub vertices: [u32; 3],
    /// Which copy of a mesh it is of.
    pub instance: u32,
}

/// What a ray hit.
#[derive(Clone, Copy, Debug)]
pub enum Shape {
    Sphere(usize),
    Curved(usize),
    Triangle(usize),
}

/// Where a ray hit something.
#[derive(Clone, Copy, Debug)]
pub struct Hit {
    pub t: f64,
    pub shape: Shape,
}

/// All shapes.
pub struct World {
    spheres: Vec<Sphere>,
    curved: Vec<scene::Shape>,
    solids: scene::Solids,
    /// The number of the first operand of solids as a body.
    first_operand: u32,
    triangles: Vec<Triangle>,
    /// Which objects the camera does not see.
    hidden: Vec<bool>,
}

impl World {
    pub fn new(scene: &Scene) -> Self {
        let loose = (scene.spheres.len() + scene.shapes.len()) as u32;
        let triangles = (loose..).zip(scene.instances.iter()).flat_map(|(body, instance)| {
            let mesh = scene.meshes[instance.mesh as usize];
            (mesh.first_triangle..mesh.first_triangle + mesh.triangle_count)
                .map(move |k| triangle(scene, (body, body - loose), instance, k))
        });
        World {
            spheres: scene.spheres.to_vec(),
            curved: scene.shapes.to_vec(),
            solids: (*scene.solids).clone(),
            first_operand: loose + scene.instances.len() as u32,
            triangles: triangles.collect(),
            hidden: scene.camera_sees.as_ref().map_or_else(Vec::new, |seen| seen.hidden.clone()),
        }
    }

    /// The nearest hit; `camera`: of a ray from there.
    pub fn closest(&self, ray: &Ray, camera: bool) -> Option<Hit> {
        let is_there = |object: u32| !(camera && self.hidden.get(object as usize).copied().unwrap_or(false));
        let mut closest = Hit { t: f64::INFINITY, shape: Shape::Sphere(0) };
        for (k, sphere) in self.spheres.iter().enumerate().filter(|(_, sphere)| is_there(sphere.object)) {
            if let Some(t) = meet_sphere(ray, sphere).filter(|&t| t < closest.t) {
                closest = Hit { t, shape: Shape::Sphere(k) };
            }
        }
        for (k, shape) in self.curved.iter().enumerate().filter(|(_, shape)| is_there(shape.object)) {
            let met = match &shape.unit {
                UnitShape::Solid(solid) => solids::meet(ray, &self.solids, solid),
                _ => shapes::meet(ray, shape),
            };
            if let Some(t) = met.filter(|&t| t < closest.t) {
                closest = Hit { t, shape: Shape::Curved(k) };
            }
        }
        for (k, triangle) in self.triangles.iter().enumerate().filter(|(_, triangle)| is_there(triangle.object)) {
            if let Some(t) = meet_triangle(ray, &triangle.corners).filter(|&t| t < closest.t) {
                closest = Hit { t, shape: Shape::Triangle(k) };
            }
        }
        closest.t.is_finite().then_some(closest)
    }

    /// The light that was hit; `s`: the surface there.
    pub fn light_of(&self, hit: &Hit, s: &surface::Surface) -> Option<usize> {
        let light = match hit.shape {
            Shape::Sphere(k) => self.spheres[k].light,
            Shape::Curved(k) => match self.curved[k].unit {
                UnitShape::Solid(_) => self.solids.operands[(s.body - self.first_operand) as usize].light,
                _ => self.curved[k].light,
            },
            Shape::Triangle(k) => self.triangles[k].light,
        };
        (light != NONE).then_some(light as usize)
    }

    /// The object that was hit.
    pub fn object_of(&self, hit: &Hit) -> u32 {
        match hit.shape {
            Shape::Sphere(k) => self.spheres[k].object,
            Shape::Curved(k) => self.curved[k].object,
            Shape::Triangle(k) => self.triangles[k].object,
        }
    }

    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: &Hit, smoothing: Smoothing) -> surface::Surface {
        let p = ray.origin + hit.t * ray.direction;
        match hit.shape {
            Shape::Sphere(k) => surface::on_sphere(k as u32, &self.spheres[k], p, ray.direction),
            Shape::Curved(k) => match &self.curved[k].unit {
                UnitShape::Solid(solid) => solids::surface(ray, hit.t, &self.solids, solid, self.first_operand),
                _ => shapes::surface((self.spheres.len() + k) as u32, &self.curved[k], p, ray.direction),
            },
            Shape::Triangle(k) => surface::on_triangle(&self.triangles[k], p, ray.direction, smoothing),
        }
    }
}

/// A triangle of a copy, brought to render space: points by the matrix, normals by its inverse transpose.
fn triangle(scene: &Scene, (body, number): (u32, u32), instance: &Instance, k: u32) -> Triangle {
    let [x, y, z] =
        instance.placement.map_or([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]], |rows| {
            rows.map(|row| row.map(f64::from))
        });
    let matrix = DMat3::from_cols_array_2d(&[0, 1, 2].map(|c| [x[c], y[c], z[c]]));
    let translation = DVec3::new(x[3], y[3], z[3]);
    let normal_matrix = matrix.inverse().transpose();
    let triangles = &scene.triangles;
    // A mirrored copy winds the other way: two corners change places, and outside stays outside.
    let [a, b, c] = if matrix.determinant() < 0.0 { [0, 2, 1] } else { [0, 1, 2] };
    let corners = triangles.corners(k).expect("a triangle of a mesh").map(|p| matrix * p + translation);
    let normals = triangles.corner_normals(k).map(|n| n.map(|n| (normal_matrix * n).normalize_or_zero()));
    let vertices = triangles.vertices[k as usize];
    Triangle {
        corners: [corners[a], corners[b], corners[c]],
        normals: normals.map(|n| [n[a], n[b], n[c]]),
        uvs: triangles.corner_uvs(k).map(|t| [t[a], t[b], t[c]]),
        material: if instance.material == NONE { triangles.material[k as usize] } else { instance.material },
        light: triangles.light.get(k as usize).copied().unwrap_or(NONE),
        object: instance.object,
        body,
        vertices: [vertices[a], vertices[b], vertices[c]],
        instance: number,
    }
}

/// |o + t d - c|^2 = r^2. With b = d.(c - o), and m = c - o - b d the line's offset from the centre,
/// t = b -+ sqrt(r^2 - m.m).
fn meet_sphere(ray: &Ray, sphere: &Sphere) -> Option<f64> {
    let to_center = sphere.center - ray.origin;
    let b = to_center.dot(ray.direction);
    let offset = to_center - b * ray.direction;
    let half_chord = (sphere.radius * sphere.radius - offset.length_squared()).sqrt();
    // No number when the line passes by: then no comparison holds.
    [b - half_chord, b + half_chord].into_iter().find(|&t| t > NEAREST)
}

/// Möller and Trumbore: Fast, Minimum Storage Ray/Triangle Intersection (1997).
fn meet_triangle(ray: &Ray, [a, b, c]: &[DVec3; 3]) -> Option<f64> {
    let (e1, e2) = (*b - *a, *c - *a);
    let p = ray.direction.cross(e2);
    let inverse = 1.0 / e1.dot(p);
    let from_a = ray.origin - *a;
    let u = from_a.dot(p) * inverse;
    let q = from_a.cross(e1);
    let v = ray.direction.dot(q) * inverse;
    let t = e2.dot(q) * inverse;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > NEAREST).then_some(t)
}
