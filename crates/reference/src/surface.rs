//! From a hit to the surface there.

use crate::Smoothing;
use crate::world::Triangle;
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tracer_core::scene::Sphere;

/// The surface at a hit. Both normals are unit and on the side that the ray came from.
pub struct Surface {
    /// The point that was hit.
    pub p: DVec3,
    /// Where rays of diffuse and glossy scattering start.
    pub start: DVec3,
    /// Geometric normal.
    pub ng: DVec3,
    /// Shading normal.
    pub ns: DVec3,
    /// `ns` is interpolated.
    pub smooth: bool,
    /// The ray came from outside.
    pub outside: bool,
    /// Texture coordinates, v upwards.
    pub uv: [f64; 2],
    pub material: u32,
    /// What it is of: the number of the sphere, behind the spheres that of the shape, behind those that of the copy of
    /// a mesh.
    pub body: u32,
    /// Where it lies on a mesh.
    pub on_mesh: Option<OnMesh>,
}

/// Starts that are less above a triangle lie on it: what rounding makes of scenes some units wide.
const RAISED: f64 = 1e-9;

impl Surface {
    /// Whether a direction leads from `start` into the triangle at once. The shading normal of a hollow smooth mesh
    /// leaves such directions above the horizon; what lies there is behind a wall.
    pub fn buries(&self, direction: DVec3) -> bool {
        self.smooth && direction.dot(self.ng) <= 0.0 && (self.start - self.p).dot(self.ng) <= RAISED
    }
}

/// A point of a triangle of a mesh.
pub struct OnMesh {
    /// The numbers of the corners' vertices.
    pub vertices: [u32; 3],
    /// Barycentric coordinates.
    pub weights: [f64; 3],
    /// Which copy of a mesh.
    pub instance: u32,
}

/// The normal is (p - c)/r; u is the longitude from -z over -x, z and x (the middle of the picture looks along +z), v
/// the latitude.
pub fn on_sphere(body: u32, sphere: &Sphere, p: DVec3, direction: DVec3) -> Surface {
    let outward = (p - sphere.center).normalize();
    let outside = outward.dot(direction) < 0.0;
    let n = if outside { outward } else { -outward };
    let uv = [0.5 + outward.x.atan2(outward.z) / TAU, 1.0 - outward.y.clamp(-1.0, 1.0).acos() / PI];
    Surface { p, start: p, ng: n, ns: n, smooth: false, outside, uv, material: sphere.material, body, on_mesh: None }
}

/// Counter-clockwise is outside. The shading normal is the vertex normals', weighted by the barycentric coordinates
/// (Phong 1975).
pub fn on_triangle(triangle: &Triangle, p: DVec3, direction: DVec3, smoothing: Smoothing) -> Surface {
    let [a, b, c] = triangle.corners;
    let outward = (b - a).cross(c - a).normalize();
    // Barycentric coordinates as ratios of areas.
    let area = |q: DVec3, r: DVec3| outward.dot((q - p).cross(r - p));
    let whole = area(b, c) + area(c, a) + area(a, b);
    let weights = [area(b, c) / whole, area(c, a) / whole, area(a, b) / whole];
    let outside = outward.dot(direction) < 0.0;
    let ng = if outside { outward } else { -outward };
    let mut surface = Surface {
        p,
        start: p,
        ng,
        ns: ng,
        smooth: false,
        outside,
        uv: triangle.uvs.map_or([0.0; 2], |uvs| [0, 1].map(|axis| (0..3).map(|k| weights[k] * uvs[k][axis]).sum())),
        material: triangle.material,
        body: triangle.body,
        on_mesh: Some(OnMesh { vertices: triangle.vertices, weights, instance: triangle.instance }),
    };
    let Some(normals) = triangle.normals else { return surface };
    let interpolated: DVec3 = (0..3).map(|k| weights[k] * normals[k]).sum();
    if interpolated.length_squared() <= 1e-12 {
        return surface;
    }
    let side = if interpolated.dot(ng) < 0.0 { -1.0 } else { 1.0 };
    surface.smooth = true;
    surface.ns = side * interpolated.normalize();
    if smoothing == Smoothing::Hanika {
        // Hanika: Hacking the Shadow Terminator (Ray Tracing Gems II, 2021): up to the vertices' tangent planes where
        // they are above.
        surface.start = p
            + (0..3)
                .map(|k| {
                    let n = side * normals[k];
                    -weights[k] * (p - triangle.corners[k]).dot(n).min(0.0) * n
                })
                .sum::<DVec3>();
    }
    surface
}
