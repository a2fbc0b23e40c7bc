//! A structure as bytes that a file may hold, and put together again of such bytes.
//!
//! The bytes are those of the arena: the same on all machines of one order of bytes, whatever their vector
//! instructions. Kernels follow what stands in them without asking, so whatever they rely on is looked at before:
//! a structure that came back from anywhere can be wrong, but lead nowhere.

use super::arena::Arena;
use super::bounds::Bounds;
use super::build::{self, size_of_scene};
use super::coplanar::{Coplanar, Ranks};
use super::geometry::{Geometry, NONE};
use super::kernels::{DEEPEST, MeshRecord};
use super::layout::{
    INSTANCE_UNITS, InstanceRecord, Kind, LINE_UNITS, Node, Parts4, Ref, SecondBoxes, Shape, Spheres4, TopBoxes,
    Triangles4, Unit,
};
use super::{Accel, AccelStats};
use crate::level::Level;
use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;
use std::ops::Range;
use std::time::Instant;

/// What there is to say of a structure beside its bytes, the roots of its meshes, and its geometry.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct TreeHead {
    /// How many bytes there are.
    pub bytes: u64,
    /// Triangles, parts, spheres, shapes, instances, nodes, leaves.
    counts: [u64; 7],
    lower: [f32; 3],
    upper: [f32; 3],
    root: u32,
    depth: u32,
}

/// Why a structure cannot be put together.
#[derive(Debug, thiserror::Error)]
pub enum RestoreError<E> {
    /// Its bytes could not be had.
    #[error("{0}")]
    Read(E),
    /// It is not one of this geometry, or none at all.
    #[error("{0}")]
    Unfit(&'static str),
    /// The system has no memory left.
    #[error("no memory for {bytes} bytes of acceleration structure: {reason}")]
    Memory {
        /// Bytes asked for.
        bytes: u64,
        /// What the system said.
        reason: String,
    },
}

/// Trees are looked through in parallel below this level.
const FRONT: u32 = 3;

impl Accel {
    /// What [`restore`](Self::restore) wants to know beside [`bytes`](Self::bytes) and [`roots`](Self::roots).
    pub fn head(&self) -> TreeHead {
        let AccelStats { triangles, parts, spheres, shapes, instances, nodes, leaves, depth, .. } = self.stats;
        TreeHead {
            bytes: self.arena.bytes() as u64,
            counts: [triangles, parts, spheres, shapes, instances, nodes, leaves],
            lower: self.bounds.lower.truncate().to_array(),
            upper: self.bounds.upper.truncate().to_array(),
            root: self.root.0,
            depth,
        }
    }

    /// Of each mesh where its own tree begins.
    pub fn roots(&self) -> Vec<u32> {
        self.meshes.iter().map(|mesh| mesh.root).collect()
    }

    /// The structure that [`build_with`](Self::build_with) has made of this geometry and these ranks once, of what it
    /// said of itself then. `read` is given [`TreeHead::bytes`] zeros to put its bytes there.
    ///
    /// # Errors
    /// When `read` fails, there is no memory, or it is not a structure of this geometry.
    pub fn restore<E>(
        geometry: &Geometry,
        ranks: &Ranks,
        head: &TreeHead,
        roots: &[u32],
        read: impl FnOnce(&mut [u8]) -> Result<(), E>,
    ) -> Result<Self, RestoreError<E>> {
        let start = Instant::now();
        build::check(geometry).map_err(|_| RestoreError::Unfit("its geometry is none"))?;
        let unit = size_of::<Unit>() as u64;
        let (units, records) = (head.bytes / unit, geometry.instances.len() as u64 * u64::from(INSTANCE_UNITS));
        if !head.bytes.is_multiple_of(unit) || units > u64::from(Ref::LIMIT) || units < records {
            return Err(RestoreError::Unfit("it is not as long as any tree"));
        }
        if roots.len() != geometry.meshes.len() {
            return Err(RestoreError::Unfit("it is of other meshes"));
        }
        let mut arena = Arena::new(units as usize)
            .map_err(|error| RestoreError::Memory { bytes: head.bytes, reason: error.to_string() })?;
        read(bytemuck::cast_slice_mut(arena.units_mut())).map_err(RestoreError::Read)?;
        let (direct, placed) = build::places(geometry);
        let meshes: Vec<MeshRecord> = geometry
            .meshes
            .iter()
            .zip(direct)
            .zip(roots)
            .map(|((mesh, direct_instance), &root)| MeshRecord {
                first_primitive: mesh.first_primitive,
                direct_instance,
                root,
            })
            .collect();
        let check = Check { units: arena.units(), geometry, meshes: &meshes };
        let depth = check.all(Ref(head.root), &placed).map_err(RestoreError::Unfit)?;
        let bounds = Bounds::new(head.lower, head.upper);
        let [triangles, parts, spheres, shapes, instances, nodes, leaves] = head.counts;
        let table_bytes = meshes.len() * size_of::<MeshRecord>() + size_of_val(geometry.parts);
        let bytes = head.bytes + table_bytes as u64;
        let (root, coplanar) = (Ref(head.root), Coplanar::find(geometry, ranks));
        let seconds = start.elapsed().as_secs_f64();
        Ok(Accel {
            root,
            top: TopBoxes::of(root, arena.units(), &bounds),
            second: SecondBoxes::of(root, arena.units(), &bounds),
            arena,
            meshes,
            parts: geometry.parts.to_vec(),
            spheres: geometry.spheres.len() as u32,
            instances: geometry.instances.len() as u32,
            size: size_of_scene(&bounds),
            bounds,
            level: Level::best(),
            coplanar,
            stats: AccelStats { triangles, parts, spheres, shapes, instances, nodes, leaves, depth, bytes, seconds },
        })
    }
}

/// Looks at what kernels rely on.
struct Check<'a> {
    units: &'a [Unit],
    geometry: &'a Geometry<'a>,
    meshes: &'a [MeshRecord],
}

/// What is known while a tree is looked through.
struct Walk {
    /// Nodes that there can be yet: else one that many others lead to would be looked at again and again.
    left: usize,
    deepest: u32,
    /// Triangles of the mesh that was asked for last.
    known: Range<u32>,
}

type Checked<T = ()> = Result<T, &'static str>;

impl Check<'_> {
    /// The depth of all trees, where they are sound; `placed`: which meshes have one of their own.
    fn all(&self, root: Ref, placed: &[bool]) -> Checked<u32> {
        let records = self.records();
        for (index, (record, instance)) in records.iter().zip(self.geometry.instances).enumerate() {
            let direct = self.meshes[instance.mesh as usize].direct_instance == index as u32;
            let mesh = if direct { instance.mesh | InstanceRecord::DIRECT } else { instance.mesh };
            if record.mesh != mesh {
                return Err("its instances are not those of the scene");
            }
        }
        let of_mesh = |(mesh, (record, placed)): (usize, (&MeshRecord, &bool))| match (Ref(record.root), placed) {
            (Ref::END, _) => Ok(0),
            (_, false) => Err("a mesh that is not placed has a tree"),
            (root, true) => self.tree(root, Some(mesh)),
        };
        let trees = self.meshes.par_iter().zip(placed).enumerate();
        let below = trees.map(of_mesh).try_reduce(|| 0, |a, b| Ok(a.max(b)))?;
        let depth = below + self.tree(root, None)?;
        if depth as usize > DEEPEST { Err("it is deeper than any tree") } else { Ok(depth) }
    }

    fn records(&self) -> &[InstanceRecord] {
        let units = self.geometry.instances.len() * INSTANCE_UNITS as usize;
        bytemuck::cast_slice(&self.units[..units])
    }

    /// The depth of a tree: a mesh's, or the world's.
    fn tree(&self, root: Ref, mesh: Option<usize>) -> Checked<u32> {
        if root == Ref::END {
            return Ok(0);
        }
        let walk = || Walk { left: self.units.len(), deepest: 0, known: 0..0 };
        let (mut top, mut front) = (walk(), Vec::new());
        self.visit(root, mesh, 0, &mut top, &mut Some(&mut front))?;
        let below = front.par_iter().map(|&(reference, depth)| {
            let mut walk = walk();
            self.visit(reference, mesh, depth, &mut walk, &mut None).map(|()| walk.deepest)
        });
        Ok(top.deepest.max(below.try_reduce(|| 0, |a, b| Ok(a.max(b)))?))
    }

    /// Looks at what a reference leads to, below so many nodes; nodes below `front` are left to whoever has that.
    fn visit(
        &self,
        reference: Ref,
        mesh: Option<usize>,
        above: u32,
        walk: &mut Walk,
        front: &mut Option<&mut Vec<(Ref, u32)>>,
    ) -> Checked {
        match reference.kind() {
            Kind::Node(unit) => self.node(unit, mesh, above, walk, front),
            Kind::Triangles(unit) => self.triangles(&self.read::<Triangles4>(unit)?.ids, mesh, walk),
            Kind::Parts(unit) => self.triangles(&self.read::<Parts4>(unit)?.triangles.ids, mesh, walk),
            Kind::Spheres(unit) if mesh.is_none() => self.spheres(unit),
            Kind::Instance(index) if mesh.is_none() => {
                let record = self.records().get(index as usize).ok_or("an instance is not there")?;
                // Of one whose triangles are in the world's tree, the flag leads beyond all meshes.
                let of = self.meshes.get(record.mesh as usize).ok_or("an instance has no mesh")?;
                if Ref(of.root) == Ref::END { Err("an instance has no tree") } else { Ok(()) }
            }
            _ => Err("a reference leads nowhere"),
        }
    }

    fn node(
        &self,
        unit: usize,
        mesh: Option<usize>,
        above: u32,
        walk: &mut Walk,
        front: &mut Option<&mut Vec<(Ref, u32)>>,
    ) -> Checked {
        let depth = above + 1;
        walk.left = walk.left.checked_sub(1).ok_or("nodes are there more than once")?;
        walk.deepest = walk.deepest.max(depth);
        if depth as usize > DEEPEST || !unit.is_multiple_of(LINE_UNITS as usize) {
            return Err("a node is where none can be");
        }
        let node = self.read::<Node>(unit)?;
        for (child, &reference) in node.children.iter().enumerate() {
            match reference.kind() {
                Kind::Nothing => {
                    let side = |k: usize| if k.is_multiple_of(2) { f32::INFINITY } else { f32::NEG_INFINITY };
                    // No ray may enter a child that is not there.
                    if reference != Ref::END || (0..6).any(|k| node.planes[k][child] != side(k)) {
                        return Err("a child that is not there has a box");
                    }
                }
                // What comes later never leads back.
                Kind::Node(below) if below <= unit => return Err("nodes lead back"),
                Kind::Node(_) if depth == FRONT && front.is_some() => {
                    front.iter_mut().for_each(|front| front.push((reference, depth)));
                }
                _ => self.visit(reference, mesh, depth, walk, front)?,
            }
        }
        Ok(())
    }

    /// Triangles of a mesh's tree are the mesh's, those of the world's tree stand there.
    fn triangles(&self, ids: &[u32; 4], mesh: Option<usize>, walk: &mut Walk) -> Checked {
        for &id in ids.iter().filter(|&&id| id != NONE) {
            if walk.known.contains(&id) {
                continue;
            }
            let after = self.meshes.partition_point(|mesh| mesh.first_primitive <= id);
            let of = after.checked_sub(1).ok_or("a triangle is not there")?;
            let is_there = match mesh {
                Some(mesh) => mesh == of,
                None => self.meshes[of].direct_instance != NONE,
            };
            let first = self.meshes[of].first_primitive;
            walk.known = first..first + self.geometry.meshes[of].triangles.len() as u32;
            if !is_there || !walk.known.contains(&id) {
                return Err("a triangle is not there");
            }
        }
        Ok(())
    }

    fn spheres(&self, unit: usize) -> Checked {
        let leaf = self.read::<Spheres4>(unit)?;
        if !leaf.is_shape() {
            let is_there = |&id: &u32| id == NONE || (id as usize) < self.geometry.spheres.len();
            return if leaf.ids.iter().all(is_there) { Ok(()) } else { Err("a sphere is not there") };
        }
        // Numbers of it lead to lists of parts.
        let leaf = self.read::<Shape>(unit)?;
        let index = leaf.ids[0].wrapping_sub(self.geometry.first_shape) as usize;
        let known = self.geometry.shapes.get(index).ok_or("a shape is not there")?;
        let is_same = bytemuck::bytes_of(leaf) == bytemuck::bytes_of(&Shape::new(known.row, leaf.ids[0]));
        if is_same { Ok(()) } else { Err("a shape is another one") }
    }

    fn read<T: Pod>(&self, unit: usize) -> Checked<&T> {
        let item = self.units.get(unit..unit + size_of::<T>() / size_of::<Unit>());
        item.map(|item| &bytemuck::cast_slice::<Unit, T>(item)[0]).ok_or("a reference leads out of it")
    }
}
