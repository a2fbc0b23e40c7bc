//! The boxes that a ray must pass to meet anything in the tree: those under its root, and for the largest placed meshes, while there is
//! room, those under the root of the mesh. The engine sorts rays out by them before the tree is asked (`engine::stages::reach`).

use super::bounds::Bounds;
use super::build::instance_bounds;
use super::kernels::MeshRecord;
use super::layout::{INSTANCE_UNITS, InstanceRecord, Kind, NODE_UNITS, Node, Ref, Unit};
use glam::{Affine3A, Mat3A, Vec3A};

/// Room for so many boxes: eight under the root, and eight in place of one of them.
const MOST: usize = 16;

/// Boxes in the world, without those that hold nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TopBoxes {
    /// Lower and upper planes: x lower, x upper, y lower and so on.
    pub planes: [[f32; MOST]; 6],
    /// How many there are.
    pub len: usize,
}

impl TopBoxes {
    /// Of a tree that is no node, the box of everything.
    pub(crate) fn of(root: Ref, units: &[Unit], meshes: &[MeshRecord], everything: &Bounds) -> Self {
        let mut boxes = match root.kind() {
            Kind::Node(unit) => children(units, unit),
            Kind::Nothing => Vec::new(),
            Kind::Triangles(_) | Kind::Spheres(_) | Kind::Instance(_) => vec![(*everything, root)],
        };
        let mut instances: Vec<(Bounds, Ref)> =
            boxes.iter().copied().filter(|(_, child)| matches!(child.kind(), Kind::Instance(_))).collect();
        instances.sort_by(|a, b| b.0.half_area().total_cmp(&a.0.half_area()));
        for (_, instance) in instances {
            let Some(parts) = parts(units, meshes, instance) else { continue };
            if boxes.len() - 1 + parts.len() <= MOST {
                boxes.retain(|&(_, child)| child != instance);
                boxes.extend(parts.into_iter().map(|part| (part, Ref::END)));
            }
        }
        let mut top = Self { planes: [[0.0; MOST]; 6], len: boxes.len() };
        for (k, (bounds, _)) in boxes.iter().enumerate() {
            for axis in 0..3 {
                top.planes[2 * axis][k] = bounds.lower[axis];
                top.planes[2 * axis + 1][k] = bounds.upper[axis];
            }
        }
        top
    }
}

/// The children of a node that are there, and their boxes.
fn children(units: &[Unit], unit: usize) -> Vec<(Bounds, Ref)> {
    let node: &Node = bytemuck::from_bytes(bytemuck::cast_slice(&units[unit..unit + NODE_UNITS as usize]));
    let plane = |k: usize, child: usize| node.planes[k][child];
    let bounds = |child: usize| {
        let corner = |upper: usize| [plane(upper, child), plane(2 + upper, child), plane(4 + upper, child)];
        Bounds::new(corner(0), corner(1))
    };
    (0..8)
        .filter(|&child| node.children[child] != Ref::END)
        .map(|child| (bounds(child), node.children[child]))
        .collect()
}

/// The boxes under the root of a placed mesh, in the world; `None` where that root is no node or a box is of no use there.
fn parts(units: &[Unit], meshes: &[MeshRecord], instance: Ref) -> Option<Vec<Bounds>> {
    let Kind::Instance(index) = instance.kind() else { return None };
    let at = (index * INSTANCE_UNITS) as usize;
    let record: &InstanceRecord = bytemuck::from_bytes(bytemuck::cast_slice(&units[at..at + INSTANCE_UNITS as usize]));
    let Kind::Node(unit) = Ref(meshes[record.mesh as usize].root).kind() else { return None };
    let [x, y, z] = record.object_from_world;
    let column = |k: usize| Vec3A::new(x[k], y[k], z[k]);
    let map = Affine3A { matrix3: Mat3A::from_cols(column(0), column(1), column(2)), translation: column(3) };
    let parts = children(units, unit);
    let mut mesh = Bounds::EMPTY;
    parts.iter().for_each(|(part, _)| mesh.include(part));
    parts.iter().map(|(part, _)| instance_bounds(&map, &mesh, part)).collect()
}
