//! Casters: objects with mirrors, glass or narrow glossy lobes on them, each within a sphere at which photons are
//! aimed.

use crate::scene::{NONE, Scene, Shape};
use crate::shapes::{Solid, UnitShape};
use glam::{DMat3, DVec3};

/// A caster, or several that lie together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Caster {
    /// Middle of a sphere around it.
    pub center: DVec3,
    /// Radius of that sphere.
    pub radius: f64,
    /// The largest share of light that it passes on.
    pub reflectance: f64,
    /// How many photons it is worth, of those of a mirror.
    pub narrow: f64,
}

impl Caster {
    fn new((center, radius): (DVec3, f64), passes: Passes) -> Self {
        Caster { center, radius, reflectance: passes.reflectance, narrow: passes.narrow }
    }
}

/// What a material passes on to photons.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Passes {
    /// The largest share of light, about; 0: it is no caster.
    reflectance: f64,
    /// How many photons that is worth.
    narrow: f64,
}

impl Passes {
    /// Of several the most.
    fn or(self, other: Passes) -> Passes {
        Passes { reflectance: self.reflectance.max(other.reflectance), narrow: self.narrow.max(other.narrow) }
    }

    fn casts(self) -> bool {
        self.reflectance > 0.0
    }
}

/// The casters, and which objects belong to them.
pub struct Casters {
    /// The casters.
    pub list: Vec<Caster>,
    /// Caster of each sphere of the scene, and behind them of each shape, or [`NONE`]; never empty.
    pub of_sphere: Vec<u32>,
    /// Caster of each instance, or [`NONE`]; never empty.
    pub of_instance: Vec<u32>,
}

/// An object that may become part of a caster.
struct Object {
    caster: Caster,
    /// Sphere, behind them shapes, behind them instances.
    id: u32,
}

impl Casters {
    /// All casters of a scene; where there are more than `most`, those that lie together are one.
    pub fn new(scene: &Scene, most: usize) -> Self {
        let spheres = scene.spheres.len();
        let mut objects: Vec<Object> = Vec::new();
        for (id, sphere) in scene.spheres.iter().enumerate() {
            if sphere.light == NONE {
                let passes = passes_on(scene, sphere.material);
                if passes.casts() {
                    let caster = Caster::new((sphere.center, sphere.radius), passes);
                    objects.push(Object { caster, id: id as u32 });
                }
            }
        }
        for (id, shape) in scene.shapes.iter().enumerate() {
            let passes = match shape.unit {
                UnitShape::Solid(Solid { operands: [first, count], .. }) => (first..first + count)
                    .filter_map(|k| scene.solids.operands.get(k as usize))
                    .map(|operand| passes_on(scene, operand.material))
                    .fold(Passes::default(), Passes::or),
                _ => passes_on(scene, shape.material),
            };
            if passes.casts() {
                let caster = Caster::new(around_shape(shape), passes);
                objects.push(Object { caster, id: (spheres + id) as u32 });
            }
        }
        let loose = spheres + scene.shapes.len();
        let mut bounds = MeshBounds::new(scene);
        for (id, instance) in scene.instances.iter().enumerate() {
            if let Some((center, radius, passes)) = bounds.of(instance.mesh, instance.material) {
                let around = match instance.placement {
                    None => (center, radius),
                    Some(rows) => placed(rows, center, radius),
                };
                let caster = Caster::new(around, passes);
                objects.push(Object { caster, id: (loose + id) as u32 });
            }
        }
        let mut of_object = vec![NONE; loose + scene.instances.len()];
        let mut list = Vec::new();
        if objects.len() <= most {
            for object in &objects {
                of_object[object.id as usize] = list.len() as u32;
                list.push(object.caster);
            }
        } else {
            cluster(&mut objects, most.max(1), &mut list, &mut of_object);
        }
        let of_instance = of_object.split_off(loose);
        let never_empty = |mut table: Vec<u32>| {
            table.resize(table.len().max(1), NONE);
            table
        };
        Casters { list, of_sphere: never_empty(of_object), of_instance: never_empty(of_instance) }
    }
}

/// A sphere around a shape. A plane's holds all that a scene has, lights and all, so that photons go everywhere by the
/// cosine and find all of it, however far.
pub(super) fn around_shape(shape: &Shape) -> (DVec3, f64) {
    if shape.unit.is_endless() {
        return (DVec3::ZERO, 1e9);
    }
    let [low, high] = shape.bounds();
    ((low + high) * 0.5, 0.5 * low.distance(high))
}

/// What a material passes on to photons; none where it is no caster.
fn passes_on(scene: &Scene, material: u32) -> Passes {
    let traits = scene.materials.get(material as usize).map(|material| material.traits());
    traits
        .filter(|traits| traits.casts > 0.0)
        .map_or_else(Passes::default, |traits| Passes { reflectance: traits.casts, narrow: traits.narrow })
}

/// The sphere around a placed sphere: the largest stretch of a matrix M is at most the root of the largest row sum of
/// M^T M.
pub(super) fn placed(rows: [[f32; 4]; 3], center: DVec3, radius: f64) -> (DVec3, f64) {
    let row = |k: usize| DVec3::from([rows[k][0], rows[k][1], rows[k][2]].map(f64::from));
    let linear = DMat3::from_cols(row(0), row(1), row(2)).transpose();
    let translation = DVec3::from([rows[0][3], rows[1][3], rows[2][3]].map(f64::from));
    let squared = linear.transpose() * linear;
    let row_sum = |k: usize| squared.row(k).abs().element_sum();
    let stretch = row_sum(0).max(row_sum(1)).max(row_sum(2)).sqrt();
    (linear * center + translation, radius * stretch)
}

/// Spheres around the casting triangles of meshes, each found once.
struct MeshBounds<'a> {
    scene: &'a Scene,
    /// Per mesh: around all of it, and around the triangles whose own material casts.
    whole: Vec<Option<(DVec3, f64)>>,
    own: Vec<Option<Option<(DVec3, f64, Passes)>>>,
}

impl<'a> MeshBounds<'a> {
    fn new(scene: &'a Scene) -> Self {
        MeshBounds { scene, whole: vec![None; scene.meshes.len()], own: vec![None; scene.meshes.len()] }
    }

    /// Middle and radius of what casts in a mesh with this material ([`NONE`]: the triangles' own), and what it passes
    /// on.
    fn of(&mut self, mesh: u32, material: u32) -> Option<(DVec3, f64, Passes)> {
        let scene = self.scene;
        let at = mesh as usize;
        let range = scene.meshes.get(at)?;
        let triangles = range.first_triangle..range.first_triangle + range.triangle_count;
        if material != NONE {
            let passes = passes_on(scene, material);
            if !passes.casts() {
                return None;
            }
            let (center, radius) = *self.whole[at].get_or_insert_with(|| around(scene, triangles));
            return Some((center, radius, passes));
        }
        *self.own[at].get_or_insert_with(|| {
            let of = |t: u32| {
                let material = scene.triangles.material.get(t as usize);
                material.map_or_else(Passes::default, |&material| passes_on(scene, material))
            };
            let passes = triangles.clone().map(of).fold(Passes::default(), Passes::or);
            let (center, radius) = around(scene, triangles.filter(|&t| of(t).casts()));
            passes.casts().then_some((center, radius, passes))
        })
    }
}

/// A sphere around triangles: the middle of their box, and the farthest corner.
pub(super) fn around(scene: &Scene, triangles: impl Iterator<Item = u32> + Clone) -> (DVec3, f64) {
    let corners = || triangles.clone().filter_map(|t| scene.triangles.corners(t)).flatten();
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for corner in corners() {
        (low, high) = (low.min(corner), high.max(corner));
    }
    let center = (low + high) * 0.5;
    (center, corners().map(|c| c.distance(center)).fold(0.0, f64::max))
}

/// Halves the objects by number along the widest axis until they are few enough.
fn cluster(objects: &mut [Object], most: usize, list: &mut Vec<Caster>, of_object: &mut [u32]) {
    if most > 1 && objects.len() > 1 {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for object in objects.iter() {
            (low, high) = (low.min(object.caster.center), high.max(object.caster.center));
        }
        let size = high - low;
        let axis = (0..3).fold(0, |widest, axis| if size[axis] > size[widest] { axis } else { widest });
        let along = |o: &Object| o.caster.center[axis];
        objects.sort_unstable_by(|a, b| along(a).total_cmp(&along(b)).then(a.id.cmp(&b.id)));
        let (left, right) = objects.split_at_mut(objects.len() / 2);
        cluster(left, most / 2, list, of_object);
        cluster(right, most - most / 2, list, of_object);
        return;
    }
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut passes = Passes::default();
    for Object { caster, id } in objects.iter() {
        (low, high) = (low.min(caster.center - caster.radius), high.max(caster.center + caster.radius));
        passes = passes.or(Passes { reflectance: caster.reflectance, narrow: caster.narrow });
        of_object[*id as usize] = list.len() as u32;
    }
    let center = (low + high) * 0.5;
    let radius = objects.iter().map(|o| o.caster.center.distance(center) + o.caster.radius).fold(0.0, f64::max);
    list.push(Caster::new((center, radius), passes));
}
