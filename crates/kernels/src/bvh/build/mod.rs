//! Building an [`Accel`]: one binary tree for each mesh that is placed somewhere, one for everything in the world.
//!
//! Triangles of meshes whose positions are in render space already are in the world's tree together, however many
//! meshes there are, so that overlapping meshes do not overlap as trees. Nor do those of other kinds ([`interleave`]).

mod binary;
mod collapse;
mod contents;
mod interleave;
mod parts;
mod wide;

use super::arena::Arena;
use super::bounds::Bounds;
use super::coplanar::{Coplanar, Ranks};
use super::geometry::{Geometry, LeftOut, NONE, ShapeGeometry};
use super::kernels::{DEEPEST, MeshRecord};
use super::layout::{INSTANCE_UNITS, InstanceRecord, Ref, SecondBoxes, TopBoxes, Unit};
use super::ray_space::RANGE;
use super::{Accel, AccelStats, Acceleration};
use crate::level::Level;
use binary::{BinaryNode, BinaryTree, Item, Kind, join};
use contents::{Contents, TriangleList, instance_bounds, object_from_world};
use interleave::interleave;
pub use parts::Polygon;
use rayon::prelude::*;
use std::time::Instant;
use wide::Plan;

/// Why an [`Accel`] cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// A triangle refers to a vertex that is not there.
    #[error("mesh {mesh}, triangle {triangle}: it refers to vertex {vertex}, but there are {vertices} vertices")]
    Vertex {
        /// Index of the mesh.
        mesh: u32,
        /// Index of the triangle.
        triangle: u32,
        /// The vertex referred to.
        vertex: u32,
        /// How many there are.
        vertices: usize,
    },
    /// An instance refers to a mesh that is not there.
    #[error("instance {instance}: it refers to mesh {mesh}, but there are {meshes} meshes")]
    Mesh {
        /// Index of the instance.
        instance: u32,
        /// The mesh referred to.
        mesh: u32,
        /// How many there are.
        meshes: usize,
    },
    /// The primitive ids of meshes and spheres overlap or do not rise.
    #[error("mesh {mesh}: its primitive ids start at {first}, but those before it reach to {taken}")]
    Ids {
        /// Index of the mesh.
        mesh: u32,
        /// Its first id.
        first: u32,
        /// One past the last id before it.
        taken: u64,
    },
    /// The primitive ids of shapes overlap those of spheres.
    #[error("shapes: their primitive ids start at {first}, but those of spheres reach to {taken}")]
    ShapeIds {
        /// The first id.
        first: u32,
        /// One past the last id before it.
        taken: u64,
    },
    /// A curved shape is not finite, or beyond the range of single precision.
    #[error("shape {shape}: it is beyond the range of single precision")]
    Shape {
        /// Index of the shape.
        shape: u32,
    },
    /// An instance is flattened, not finite, or out of range.
    #[error("instance {instance}: its placement has no inverse, or is beyond the range of single precision")]
    Placement {
        /// Index of the instance.
        instance: u32,
    },
    /// More than the references of the tree can count.
    #[error("the scene needs {bytes} bytes of acceleration structure; {most} is the most that there can be")]
    TooLarge {
        /// Bytes needed.
        bytes: u64,
        /// Bytes possible.
        most: u64,
    },
    /// The system has no memory left.
    #[error("no memory for {bytes} bytes of acceleration structure: {reason}")]
    Memory {
        /// Bytes asked for.
        bytes: u64,
        /// What the system said.
        reason: String,
    },
}

/// A tree to be laid out: its binary nodes, and what its leaves hold.
struct Tree<'a> {
    nodes: Vec<BinaryNode>,
    contents: Contents<'a>,
}

pub fn build(geometry: &Geometry, acceleration: Acceleration, ranks: &Ranks) -> Result<Accel, BuildError> {
    let start = Instant::now();
    check(geometry)?;
    let (direct, placed) = places(geometry);
    let mesh_trees = mesh_trees(geometry, &placed, acceleration)?;
    let world = {
        let boxes = instance_boxes(geometry, &direct, &mesh_trees)?;
        world_tree(geometry, &direct, &boxes, acceleration)?
    };

    // The world's is the last.
    let trees: Vec<&Tree> = mesh_trees.iter().flatten().chain([&world]).collect();
    let plans: Vec<Plan> = trees.par_iter().map(|tree| Plan::new(&tree.nodes, &tree.contents)).collect();
    let mut arena = room(geometry, &plans)?;
    let first = record_units(geometry) as u32;
    let (records, units) = arena.units_mut().split_at_mut(first as usize);
    write_records(geometry, &direct, &mesh_trees, bytemuck::cast_slice_mut(records));
    let roots = write_trees(&trees, &plans, first, units);
    let (meshes, root) = with_roots(geometry, &direct, &mesh_trees, &roots);

    let depth = depth(&plans);
    let coplanar = Coplanar::find(geometry, ranks);
    let table_bytes = meshes.len() * size_of::<MeshRecord>() + size_of_val(geometry.parts);
    let bytes = (arena.bytes() + table_bytes) as u64;
    let stats = AccelStats { depth, bytes, seconds: start.elapsed().as_secs_f64(), ..counted(&trees, &plans) };
    let bounds = world.contents.bounds;
    let top = TopBoxes::of(root, arena.units(), &bounds);
    let second = SecondBoxes::of(root, arena.units(), &bounds);
    Ok(Accel {
        arena,
        root,
        top,
        second,
        meshes,
        parts: geometry.parts.to_vec(),
        spheres: geometry.spheres.len() as u32,
        instances: geometry.instances.len() as u32,
        bounds,
        size: size_of_scene(&bounds),
        level: Level::best(),
        coplanar,
        stats,
    })
}

/// The trees of those meshes that are placed.
fn mesh_trees<'a>(
    geometry: &Geometry<'a>,
    placed: &[bool],
    acceleration: Acceleration,
) -> Result<Vec<Option<Tree<'a>>>, BuildError> {
    let tree = |mesh: usize| {
        placed[mesh].then(|| triangle_tree(TriangleList::new(geometry, &[mesh as u32]), acceleration)).transpose()
    };
    (0..geometry.meshes.len()).into_par_iter().map(tree).collect()
}

/// The units of the records of all instances, which lie before the trees.
fn record_units(geometry: &Geometry) -> u64 {
    geometry.instances.len() as u64 * u64::from(INSTANCE_UNITS)
}

/// An arena for the records and for what is planned.
fn room(geometry: &Geometry, plans: &[Plan]) -> Result<Arena, BuildError> {
    let units = plans.iter().fold(record_units(geometry), |sum, plan| sum + u64::from(plan.units));
    let most = u64::from(Ref::LIMIT);
    if units > most || geometry.instances.len() as u64 > most {
        return Err(BuildError::TooLarge { bytes: units * 32, most: most * 32 });
    }
    Arena::new(units as usize).map_err(|error| BuildError::Memory { bytes: units * 32, reason: error.to_string() })
}

/// Writes all trees, one behind the other, into `units`, which are those from `first` on; gives their roots.
fn write_trees(trees: &[&Tree], plans: &[Plan], first: u32, units: &mut [Unit]) -> Vec<Ref> {
    let (mut at, mut rest) = (first, units);
    let mut parts = Vec::with_capacity(trees.len());
    let mut roots = Vec::with_capacity(trees.len());
    for (tree, plan) in trees.iter().zip(plans) {
        let (part, after) = rest.split_at_mut(plan.units as usize);
        roots.push(plan.root(&tree.nodes, at));
        parts.push((tree, plan, at, part));
        at += plan.units;
        rest = after;
    }
    parts.into_par_iter().for_each(|(tree, plan, at, part)| plan.write(&tree.nodes, &tree.contents, at, part));
    roots
}

/// The records of the meshes with the roots of their trees, and the root of the world, which is the last.
fn with_roots(geometry: &Geometry, direct: &[u32], trees: &[Option<Tree>], roots: &[Ref]) -> (Vec<MeshRecord>, Ref) {
    let mut roots = roots.iter().copied();
    let record = |(mesh, tree): (usize, &Option<Tree>)| MeshRecord {
        first_primitive: geometry.meshes[mesh].first_primitive,
        direct_instance: direct[mesh],
        root: tree.as_ref().and_then(|_| roots.next()).unwrap_or(Ref::END).0,
    };
    let meshes = trees.iter().enumerate().map(record).collect();
    (meshes, roots.next().unwrap_or(Ref::END))
}

/// Nodes on the longest way down: through the world, and from there through a mesh.
fn depth(plans: &[Plan]) -> u32 {
    let Some((world, meshes)) = plans.split_last() else { return 0 };
    let depth = world.depth + meshes.iter().map(|plan| plan.depth).max().unwrap_or(0);
    // The binary trees are no deeper than their builder allows, so neither are these; the kernels' stacks rely on it.
    assert!(depth as usize <= DEEPEST, "a tree of depth {depth} exceeds the traversal's stack");
    depth
}

/// What can be counted of trees and their plans.
fn counted(trees: &[&Tree], plans: &[Plan]) -> AccelStats {
    let of_world = |count: fn(&Contents) -> usize| trees.last().map_or(0, |world| count(&world.contents) as u64);
    AccelStats {
        triangles: trees.iter().map(|tree| tree.contents.triangles.count()).sum(),
        parts: trees.iter().map(|tree| tree.contents.triangles.list.parts() as u64).sum(),
        spheres: of_world(|contents| contents.spheres.order.len()),
        shapes: of_world(|contents| contents.shapes.order.len()),
        instances: of_world(|contents| contents.instances.order.len()),
        nodes: plans.iter().map(|plan| plan.nodes).sum(),
        leaves: plans.iter().map(|plan| plan.leaves).sum(),
        ..AccelStats::default()
    }
}

/// Of each mesh the instance whose triangles are in the world's tree, or [`NONE`], and whether others are placed.
pub fn places(geometry: &Geometry) -> (Vec<u32>, Vec<bool>) {
    let mut direct = vec![NONE; geometry.meshes.len()];
    let mut placed = vec![false; geometry.meshes.len()];
    for (index, instance) in geometry.instances.iter().enumerate() {
        let mesh = instance.mesh as usize;
        if LeftOut::holds(geometry.left_out.instances, index) {
            continue;
        }
        match instance.placement {
            // A mesh can be in the world's tree once; a second one in the same place is an instance like any other.
            None if direct[mesh] == NONE => direct[mesh] = index as u32,
            _ => placed[mesh] = true,
        }
    }
    (direct, placed)
}

/// Sees that ids and meshes are there.
pub fn check(geometry: &Geometry) -> Result<(), BuildError> {
    let mut taken = geometry.spheres.len() as u64;
    if !geometry.shapes.is_empty() || !geometry.planes.is_empty() {
        if u64::from(geometry.first_shape) < taken {
            return Err(BuildError::ShapeIds { first: geometry.first_shape, taken });
        }
        taken = u64::from(geometry.first_shape) + (geometry.shapes.len() + geometry.planes.len()) as u64;
        let usable = |shape: &ShapeGeometry| shape.lower.iter().chain(&shape.upper).all(|x| x.abs() <= RANGE);
        if let Some(at) = geometry.shapes.iter().position(|shape| !usable(shape)) {
            return Err(BuildError::Shape { shape: at as u32 });
        }
    }
    for (mesh, data) in geometry.meshes.iter().enumerate() {
        // The two largest words are no ids.
        let end = u64::from(data.first_primitive) + data.triangles.len() as u64;
        if u64::from(data.first_primitive) < taken || end > u64::from(u32::MAX) - 1 {
            return Err(BuildError::Ids { mesh: mesh as u32, first: data.first_primitive, taken });
        }
        taken = end;
    }
    let meshes = geometry.meshes.len();
    match geometry.instances.iter().position(|instance| instance.mesh as usize >= meshes) {
        Some(at) => Err(BuildError::Mesh { instance: at as u32, mesh: geometry.instances[at].mesh, meshes }),
        None => Ok(()),
    }
}

/// The longest side of a box; 0 if it is empty.
pub fn size_of_scene(bounds: &Bounds) -> f32 {
    (bounds.upper - bounds.lower).truncate().max_element().max(0.0)
}

/// The rows of an instance's matrix; `None` where the triangles are part of the world's tree. A mesh that is in the
/// world already and stands there a second time is an instance like any other.
fn rows_of(geometry: &Geometry, direct: &[u32], index: usize) -> Option<[[f32; 4]; 3]> {
    const IDENTITY: [[f32; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let instance = &geometry.instances[index];
    let in_world = direct[instance.mesh as usize] == index as u32;
    (!in_world).then(|| instance.placement.unwrap_or(IDENTITY))
}

/// The tree over the triangles of some meshes.
fn triangle_tree(mut triangles: TriangleList, acceleration: Acceleration) -> Result<Tree, BuildError> {
    let (mut items, bounds) = triangles.items()?;
    triangles.cut(&mut items, &bounds);
    let mut tree = match acceleration {
        Acceleration::Bvh => BinaryTree::build(items, Kind::Triangles, 4),
        Acceleration::None | Acceleration::BoundingBox => BinaryTree::in_given_order(&items, Kind::Triangles, 4),
    };
    tree.mark_parts(&triangles);
    let mut contents = Contents { bounds, ..Contents::default() };
    contents.triangles.list = triangles;
    contents.triangles.order = tree.order;
    Ok(Tree { nodes: tree.nodes, contents })
}

/// The box in the world of each instance that is placed and not empty.
fn instance_boxes(
    geometry: &Geometry,
    direct: &[u32],
    trees: &[Option<Tree>],
) -> Result<Vec<Option<Bounds>>, BuildError> {
    let one = |index: usize| {
        if LeftOut::holds(geometry.left_out.instances, index) {
            return Ok(None);
        }
        let Some(rows) = rows_of(geometry, direct, index) else { return Ok(None) };
        let tree = trees[geometry.instances[index].mesh as usize].as_ref();
        let Some(tree) = tree.filter(|tree| !tree.nodes.is_empty()) else { return Ok(None) };
        let bounds = instance_bounds(&object_from_world(&rows), &tree.contents.bounds);
        bounds.map(Some).ok_or(BuildError::Placement { instance: index as u32 })
    };
    (0..geometry.instances.len()).into_par_iter().map(one).collect()
}

/// Writes the records of all instances, whose placements have been found to be of use.
fn write_records(geometry: &Geometry, direct: &[u32], trees: &[Option<Tree>], records: &mut [InstanceRecord]) {
    records.par_iter_mut().enumerate().for_each(|(index, record)| {
        let mesh = geometry.instances[index].mesh;
        *record = InstanceRecord { object_from_world: [[0.0; 4]; 3], center: [0.0; 3], mesh };
        let Some(rows) = rows_of(geometry, direct, index) else {
            record.mesh |= InstanceRecord::DIRECT;
            return;
        };
        let Some(tree) = trees[mesh as usize].as_ref().filter(|tree| !tree.nodes.is_empty()) else { return };
        let map = object_from_world(&rows);
        let Some(bounds) = instance_bounds(&map, &tree.contents.bounds) else { return };
        let (columns, t) = (map.matrix3, map.translation);
        record.object_from_world =
            std::array::from_fn(|row| [columns.x_axis[row], columns.y_axis[row], columns.z_axis[row], t[row]]);
        record.center = ((bounds.lower + bounds.upper) * 0.5).truncate().to_array();
    });
}

/// The tree over spheres, other curved shapes, the triangles that are in the world already, and placed instances.
fn world_tree<'a>(
    geometry: &Geometry<'a>,
    direct: &[u32],
    boxes: &[Option<Bounds>],
    acceleration: Acceleration,
) -> Result<Tree<'a>, BuildError> {
    let direct: Vec<u32> = (0..direct.len()).filter(|&mesh| direct[mesh] != NONE).map(|mesh| mesh as u32).collect();
    let triangles = TriangleList::new(geometry, &direct);
    let mut world = match acceleration {
        Acceleration::BoundingBox => boxed_meshes(triangles, direct.len())?,
        _ => triangle_tree(triangles, acceleration)?,
    };
    let sphere_items: Vec<Item> = (0u32..)
        .zip(geometry.spheres)
        .filter(|(_, sphere)| sphere.lower.iter().chain(&sphere.upper).all(|x| x.is_finite()))
        .filter(|(index, _)| !LeftOut::holds(geometry.left_out.spheres, *index as usize))
        .map(|(index, sphere)| Item::new(&Bounds::new(sphere.lower, sphere.upper), index))
        .collect();
    let instance_items: Vec<Item> =
        (0u32..).zip(boxes).filter_map(|(index, bounds)| Some(Item::new(bounds.as_ref()?, index))).collect();
    let shape_items: Vec<Item> = (0u32..)
        .zip(geometry.shapes)
        .filter(|(index, _)| !LeftOut::holds(geometry.left_out.shapes, *index as usize))
        .map(|(index, shape)| Item::new(&Bounds::new(shape.lower, shape.upper), index))
        .collect();
    for item in sphere_items.iter().chain(&shape_items).chain(&instance_items) {
        world.contents.bounds.include(&item.bounds());
    }
    let (spheres, shapes, instances) = match acceleration {
        Acceleration::Bvh => (
            BinaryTree::build(sphere_items, Kind::Spheres, 4),
            BinaryTree::build(shape_items, Kind::Shape, 1),
            BinaryTree::build(instance_items, Kind::Instance, 1),
        ),
        _ => {
            let mut instances = BinaryTree::in_given_order(&instance_items, Kind::Instance, 1);
            if acceleration == Acceleration::BoundingBox {
                instances.restore_leaf_bounds(&instance_items);
            }
            let shapes = BinaryTree::in_given_order(&shape_items, Kind::Shape, 1);
            (BinaryTree::in_given_order(&sphere_items, Kind::Spheres, 4), shapes, instances)
        }
    };
    world.contents.spheres.list = geometry.spheres;
    world.contents.spheres.order = spheres.order;
    world.contents.shapes.list = geometry.shapes;
    world.contents.shapes.first = geometry.first_shape;
    world.contents.shapes.order = shapes.order;
    world.contents.instances.order = instances.order;
    let trees = vec![world.nodes, spheres.nodes, shapes.nodes, instances.nodes];
    world.nodes = if acceleration == Acceleration::Bvh { interleave(trees) } else { join(trees) };
    Ok(world)
}

/// A tree of one box for each mesh, with all its triangles in boxes that leave nothing out.
fn boxed_meshes(mut triangles: TriangleList, meshes: usize) -> Result<Tree, BuildError> {
    let (mut items, all) = triangles.items()?;
    triangles.cut(&mut items, &all);
    let mut of_meshes = vec![Vec::new(); meshes];
    for item in items {
        of_meshes[triangles.mesh_of(item.index())].push(item);
    }
    let mut trees = Vec::with_capacity(meshes);
    let mut order = Vec::new();
    for items in of_meshes {
        let mut bounds = Bounds::EMPTY;
        items.iter().for_each(|item| bounds.include(&item.bounds()));
        let mut tree = BinaryTree::in_given_order(&items, Kind::Triangles, 4);
        tree.mark_parts(&triangles);
        tree.start_at(order.len() as u32);
        tree.seal(bounds);
        order.append(&mut tree.order);
        trees.push(tree.nodes);
    }
    let mut contents = Contents { bounds: all, ..Contents::default() };
    contents.triangles.list = triangles;
    contents.triangles.order = order;
    Ok(Tree { nodes: join(trees), contents })
}
