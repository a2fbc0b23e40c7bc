//! How much there is in a compiled scene.

use super::Scene;
use crate::bvh::AccelStats;
use glam::DVec3;

/// How much there is in a compiled scene, and what it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Spheres, those of lights among them.
    pub spheres: u64,
    /// Other curved shapes, ellipsoids among them.
    pub shapes: u64,
    /// Planes without an end.
    pub planes: u64,
    /// Lights.
    pub lights: u64,
    /// Meshes, each counted once.
    pub meshes: u64,
    /// Placed meshes.
    pub instances: u64,
    /// Triangles of the meshes, each mesh counted once.
    pub triangles: u64,
    /// Triangles of the placed meshes, as many times as they are placed.
    pub placed_triangles: u64,
    /// Materials.
    pub materials: u64,
    /// Textures.
    pub textures: u64,
    /// Bytes of vertices, normals, texture coordinates and indices.
    pub geometry_bytes: u64,
    /// Bytes of texels.
    pub texture_bytes: u64,
    /// The tree; `None` when there are no meshes and few spheres.
    pub tree: Option<AccelStats>,
    /// The box around all that has an end, in the person's world; `None` where nothing has.
    pub bounds: Option<WorldBounds>,
}

/// A box in the person's world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldBounds {
    /// Least coordinates.
    pub min: [f64; 3],
    /// Largest coordinates.
    pub max: [f64; 3],
}

impl Scene {
    /// How much there is in the scene. It looks at every vertex and every placed mesh once.
    pub fn statistics(&self) -> Statistics {
        let placed = |mesh: u32| self.meshes.get(mesh as usize).map_or(0, |m| u64::from(m.triangle_count));
        let textures = self.tables.textures.uses.len() as u64;
        let t = &self.triangles;
        let geometry_bytes = size_of_val(&t.positions[..])
            + size_of_val(&t.vertices[..])
            + size_of_val(&t.normals[..])
            + size_of_val(&t.normal_indices[..])
            + size_of_val(&t.uvs[..])
            + size_of_val(&t.uv_indices[..])
            + size_of_val(&t.material[..])
            + size_of_val(&self.tables.colors.words[..]);
        Statistics {
            spheres: self.spheres.len() as u64,
            shapes: (self.shapes.len() - self.tables.planes.rows.len()) as u64,
            planes: self.tables.planes.rows.len() as u64,
            lights: self.lights.len() as u64,
            meshes: self.meshes.len() as u64,
            instances: self.instances.len() as u64,
            triangles: t.vertices.len() as u64,
            placed_triangles: self.instances.iter().map(|i| placed(i.mesh)).sum(),
            materials: self.materials.len() as u64,
            textures,
            geometry_bytes: geometry_bytes as u64,
            texture_bytes: if textures == 0 { 0 } else { size_of_val(&self.tables.textures.words[..]) as u64 },
            tree: self.accel.as_deref().map(crate::bvh::Accel::stats),
            bounds: self.bounds(),
        }
    }

    fn bounds(&self) -> Option<WorldBounds> {
        let mut all = Bounds::EMPTY;
        for sphere in self.spheres.iter() {
            all.add(sphere.center - DVec3::splat(sphere.radius));
            all.add(sphere.center + DVec3::splat(sphere.radius));
        }
        let bounded = self.shapes.iter().filter(|shape| !shape.unit.is_endless());
        for [low, high] in bounded.map(super::Shape::bounds) {
            all.add(low);
            all.add(high);
        }
        let meshes: Vec<Bounds> = self.meshes.iter().map(|mesh| self.mesh_bounds(mesh)).collect();
        for instance in self.instances.iter() {
            let Some(mesh) = meshes.get(instance.mesh as usize).filter(|mesh| mesh.min.x <= mesh.max.x) else {
                continue;
            };
            for corner in 0..8u32 {
                let bit = |axis: u32| corner >> axis & 1 == 1;
                let corner = DVec3::select(glam::BVec3::new(bit(0), bit(1), bit(2)), mesh.max, mesh.min);
                all.add(match &instance.placement {
                    None => corner,
                    Some(rows) => DVec3::from([0, 1, 2].map(|k: usize| {
                        let [x, y, z, w] = rows[k].map(f64::from);
                        DVec3::new(x, y, z).dot(corner) + w
                    })),
                });
            }
        }
        let world = |p: DVec3| (p / self.frame.scale + self.frame.centre).to_array();
        (all.min.x <= all.max.x).then(|| WorldBounds { min: world(all.min), max: world(all.max) })
    }

    fn mesh_bounds(&self, mesh: &super::Mesh) -> Bounds {
        let mut bounds = Bounds::EMPTY;
        for triangle in mesh.first_triangle..mesh.first_triangle + mesh.triangle_count {
            for corner in self.triangles.corners(triangle).into_iter().flatten() {
                bounds.add(corner);
            }
        }
        bounds
    }
}

#[derive(Clone, Copy)]
struct Bounds {
    min: DVec3,
    max: DVec3,
}

impl Bounds {
    const EMPTY: Self = Bounds { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    fn add(&mut self, point: DVec3) {
        self.min = self.min.min(point);
        self.max = self.max.max(point);
    }
}
