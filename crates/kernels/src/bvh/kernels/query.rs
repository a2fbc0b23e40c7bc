//! What a batch asks, and where the answers go.

use super::super::geometry::NONE;
use super::super::layout::InstanceRecord;
use super::super::{Hits, Occlusion, Rays};
use super::packet::gather;
use crate::shapes::csg::Part;
use std::ops::Range;

/// A tree as the kernels see it.
///
/// Invariant, kept by the builder (and checked by `validate`): every reference reachable from `root` lies within the
/// arena at `base`, every instance index is below `instances.len()`, every mesh index below `meshes.len()`, and no
/// path from `root` is deeper than `depth` nodes, both levels together, with 7 `depth` + 10 <= [`STACK`](super::STACK).
#[derive(Clone, Copy)]
pub struct TreeView<'a> {
    pub base: *const u8,
    /// The arena's size.
    pub bytes: usize,
    pub root: u32,
    /// The longest side of what is in the tree.
    pub size: f32,
    pub spheres: u32,
    pub instances: &'a [InstanceRecord],
    pub meshes: &'a [MeshRecord],
    /// The parts of all shapes that are made of several.
    pub parts: &'a [Part],
}

/// A mesh as the kernels see it.
#[derive(Clone, Copy, Debug)]
pub struct MeshRecord {
    pub first_primitive: u32,
    /// The instance whose triangles are in the top tree, or `NONE`.
    pub direct_instance: u32,
    /// The root of the mesh's own tree, for placed instances.
    pub root: u32,
}

/// Stands for the instance of a hit on the top tree's triangles until the hit is handed out.
pub const WORLD: u32 = NONE - 1;

impl TreeView<'_> {
    /// The instance of a primitive of the top tree.
    pub fn world_instance(&self, primitive: u32) -> u32 {
        if primitive < self.spheres {
            return NONE;
        }
        let after = self.meshes.partition_point(|mesh| mesh.first_primitive <= primitive);
        after.checked_sub(1).map_or(NONE, |mesh| self.meshes[mesh].direct_instance)
    }

    /// The primitive to leave out in the world space, of a surface (primitive, instance): `NONE` for surfaces of placed
    /// instances.
    #[inline(always)]
    pub fn in_world(&self, primitive: u32, instance: u32) -> u32 {
        match self.instances.get(instance as usize) {
            Some(record) if record.mesh & InstanceRecord::DIRECT == 0 => NONE,
            _ => primitive,
        }
    }

    /// Whether a hit on (`primitive`, `instance`) wins over one equally far on (`held_primitive`, `held_instance`).
    #[cold]
    #[inline(never)]
    pub fn wins_tie(&self, primitive: u32, instance: u32, held_primitive: u32, held_instance: u32) -> bool {
        let resolve = |p, i| if i == WORLD { self.world_instance(p) } else { i };
        (primitive, resolve(primitive, instance)) < (held_primitive, resolve(held_primitive, held_instance))
    }
}

/// Where a ray stands before its traversal.
#[derive(Clone, Copy)]
pub struct Start {
    pub t: f32,
    pub primitive: u32,
    pub instance: u32,
}

/// One kind of question.
pub trait Goal {
    /// Stop at the first hit strictly nearer than the start's t, and say no more than that there is one.
    const ANY_HIT: bool;
    fn start(&self, ray: usize) -> Start;
    /// A second surface that cannot be hit, as (primitive, instance). Used where `ANY_HIT`.
    fn target(&self, ray: usize) -> (u32, u32);
    /// [`start`](Self::start) for up to 16 rays, which are those of `run` where there is one.
    fn start_packet(
        &self,
        rays: &[u32],
        run: &Option<Range<usize>>,
        t: &mut [f32; 16],
        primitive: &mut [u32; 16],
        instance: &mut [u32; 16],
    );
    /// [`target`](Self::target) for up to 16 rays. Used where `ANY_HIT`.
    fn target_packet(
        &self,
        rays: &[u32],
        run: &Option<Range<usize>>,
        primitive: &mut [u32; 16],
        instance: &mut [u32; 16],
    );
    /// Called once for each ray that found something.
    fn found(&mut self, ray: usize, t: f32, primitive: u32, instance: u32);
}

pub struct Closest<'a, 'b> {
    pub hits: &'a mut Hits<'b>,
}

impl Goal for Closest<'_, '_> {
    const ANY_HIT: bool = false;
    #[inline(always)]
    fn start(&self, ray: usize) -> Start {
        Start { t: self.hits.t[ray], primitive: self.hits.primitive[ray], instance: self.hits.instance[ray] }
    }
    #[inline(always)]
    fn target(&self, _ray: usize) -> (u32, u32) {
        (NONE, NONE)
    }
    #[inline(always)]
    fn start_packet(
        &self,
        rays: &[u32],
        run: &Option<Range<usize>>,
        t: &mut [f32; 16],
        primitive: &mut [u32; 16],
        instance: &mut [u32; 16],
    ) {
        gather(t, self.hits.t, rays, run);
        gather(primitive, self.hits.primitive, rays, run);
        gather(instance, self.hits.instance, rays, run);
    }
    #[inline(always)]
    fn target_packet(&self, _: &[u32], _: &Option<Range<usize>>, _: &mut [u32; 16], _: &mut [u32; 16]) {}
    #[inline(always)]
    fn found(&mut self, ray: usize, t: f32, primitive: u32, instance: u32) {
        self.hits.t[ray] = t;
        self.hits.primitive[ray] = primitive;
        self.hits.instance[ray] = instance;
    }
}

pub struct AnyHit<'a, 'b> {
    pub occlusion: &'a mut Occlusion<'b>,
}

impl Goal for AnyHit<'_, '_> {
    const ANY_HIT: bool = true;
    #[inline(always)]
    fn start(&self, ray: usize) -> Start {
        Start { t: self.occlusion.tmax[ray], primitive: NONE, instance: NONE }
    }
    #[inline(always)]
    fn target(&self, ray: usize) -> (u32, u32) {
        (self.occlusion.target_primitive[ray], self.occlusion.target_instance[ray])
    }
    #[inline(always)]
    fn start_packet(
        &self,
        rays: &[u32],
        run: &Option<Range<usize>>,
        t: &mut [f32; 16],
        _: &mut [u32; 16],
        _: &mut [u32; 16],
    ) {
        gather(t, self.occlusion.tmax, rays, run);
    }
    #[inline(always)]
    fn target_packet(
        &self,
        rays: &[u32],
        run: &Option<Range<usize>>,
        primitive: &mut [u32; 16],
        instance: &mut [u32; 16],
    ) {
        gather(primitive, self.occlusion.target_primitive, rays, run);
        gather(instance, self.occlusion.target_instance, rays, run);
    }
    #[inline(always)]
    fn found(&mut self, ray: usize, _t: f32, _primitive: u32, _instance: u32) {
        self.occlusion.occluded[ray] = 1;
    }
}

/// The rays of a batch and which of them to trace.
#[derive(Clone, Copy)]
pub struct Batch<'a> {
    pub rays: &'a Rays<'a>,
    pub active: &'a [u32],
}

impl Batch<'_> {
    #[inline(always)]
    pub fn origin(&self, ray: usize) -> [f32; 3] {
        [self.rays.ox[ray], self.rays.oy[ray], self.rays.oz[ray]]
    }
    #[inline(always)]
    pub fn direction(&self, ray: usize) -> [f32; 3] {
        [self.rays.dx[ray], self.rays.dy[ray], self.rays.dz[ray]]
    }
}
