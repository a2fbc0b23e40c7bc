//! Which primitive does a ray hit first, and is anything in its way: a tree of boxes, eight children wide.
//!
//! [`Accel`] is built once from a [`Geometry`] and then asked in batches (structure of arrays, a few thousand rays),
//! for the closest hit or for any. It holds triangles, spheres, other curved shapes, and instances of meshes.
//!
//! # The same bits, always
//! A hit is a pure function of the ray and the primitive (and the instance it is in): `triangle` and [`sphere_hit`] say
//! which, operation by operation, and [`Row::hit`](crate::shapes::Row::hit) of other shapes. A triangle that leaves its
//! box empty is cut, and is hit where the first of its parts is; how it is cut depends on nothing but the geometry. Of
//! all hits with 0 < t the closest wins, and of those equally far the one with the smaller (primitive, instance). Of
//! triangles in one plane that overlap, one wins wherever both are (`coplanar`). Boxes only leave out what cannot win.
//! So the answer depends neither on the [`Acceleration`], nor on the [`Level`] of vector instructions, the batch, the
//! order of its rays, or the threads that built the tree.
//!
//! # Frames and units
//! Render space, f32. Directions need not be unit; t counts in lengths of the direction. A ray with anything not
//! finite, without direction, or with components beyond 2^±40 hits nothing.

mod arena;
mod bounds;
mod build;
mod coplanar;
mod few;
mod geometry;
mod kernels;
mod layout;
mod ray_space;
mod sphere;
mod stored;
mod triangle;
mod validate;

pub use build::BuildError;
pub use few::{Few, FewTriangle};
pub use geometry::{Geometry, InstanceGeometry, LeftOut, MeshGeometry, NONE, ShapeGeometry, SphereGeometry};
pub use kernels::Counters;
pub use sphere::sphere_hit;
pub use stored::{RestoreError, TreeHead};
pub use triangle::{part_hit, triangle_hit};
pub use validate::{Invalid, TrianglePart};

pub use layout::{Boxes, SecondBoxes, TopBoxes};
pub use ray_space::{PAD, SMALLEST_COMPONENT};

use crate::level::Level;
use arena::Arena;
use bounds::Bounds;
use coplanar::Coplanar;
pub use coplanar::{Materials, Ranks, SAME_SIDE, TRANSMITS};
use kernels::{Batch, MeshRecord, TreeView};
use layout::{INSTANCE_UNITS, InstanceRecord, Ref};

/// How much of the geometry boxes are put around. The pictures are the same; the times are not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Acceleration {
    /// Every ray meets every primitive.
    None,
    /// One box around each mesh of each instance.
    BoundingBox,
    /// A hierarchy of boxes.
    #[default]
    Bvh,
}

/// Whether neighbouring rays of a batch go the same way. A hint about speed only.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Coherence {
    /// Neighbours have little in common: bounces.
    #[default]
    Incoherent,
    /// Neighbours have nearly the same origin or direction: camera rays, shadow rays to a small light.
    Coherent,
}

/// A batch of rays; all slices have the same length.
#[derive(Clone, Copy)]
pub struct Rays<'a> {
    /// Origins, x.
    pub ox: &'a [f32],
    /// Origins, y.
    pub oy: &'a [f32],
    /// Origins, z.
    pub oz: &'a [f32],
    /// Directions, x.
    pub dx: &'a [f32],
    /// Directions, y.
    pub dy: &'a [f32],
    /// Directions, z.
    pub dz: &'a [f32],
    /// The primitive that the ray leaves, or [`NONE`]. A triangle that a ray leaves is not hit; a curved shape not
    /// where it leaves it.
    pub from_primitive: &'a [u32],
    /// The instance of that primitive; [`NONE`] for spheres and other curved shapes.
    pub from_instance: &'a [u32],
}

impl<'a> Rays<'a> {
    /// One of them alone.
    pub fn only(&self, ray: usize) -> Rays<'a> {
        let of = ray..ray + 1;
        Rays {
            ox: &self.ox[of.clone()],
            oy: &self.oy[of.clone()],
            oz: &self.oz[of.clone()],
            dx: &self.dx[of.clone()],
            dy: &self.dy[of.clone()],
            dz: &self.dz[of.clone()],
            from_primitive: &self.from_primitive[of.clone()],
            from_instance: &self.from_instance[of],
        }
    }
}

/// The closest hits of a batch, updated in place.
pub struct Hits<'a> {
    /// In: the limit, or a hit found earlier. Out: the closest hit's t, or what it was.
    pub t: &'a mut [f32],
    /// In: the primitive of the hit found earlier, or [`NONE`]. Out: the closest hit's.
    pub primitive: &'a mut [u32],
    /// The hit primitive's instance: an index into [`Geometry::instances`]; [`NONE`] for spheres.
    pub instance: &'a mut [u32],
}

/// The ends of a batch of shadow rays, and which of them something blocks.
pub struct Occlusion<'a> {
    /// Only what is hit at 0 < t < `tmax` blocks.
    pub tmax: &'a [f32],
    /// The primitive that the ray goes to, which does not block it; or [`NONE`].
    pub target_primitive: &'a [u32],
    /// The instance of that primitive.
    pub target_instance: &'a [u32],
    /// Set to 1 where something blocks the ray; left alone elsewhere.
    pub occluded: &'a mut [u32],
}

/// The acceleration structure of a scene. Immutable; shared by all threads.
pub struct Accel {
    arena: Arena,
    root: Ref,
    top: TopBoxes,
    second: SecondBoxes,
    meshes: Vec<MeshRecord>,
    /// Of the shapes that are made of several.
    parts: Vec<crate::shapes::csg::Part>,
    spheres: u32,
    instances: u32,
    /// Of all that is in the tree.
    bounds: Bounds,
    size: f32,
    level: Level,
    coplanar: Option<Coplanar>,
    stats: AccelStats,
}

/// What was built.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AccelStats {
    /// Triangles in the trees (each mesh counted once), without those that are not finite.
    pub triangles: u64,
    /// Parts that some of them have been cut into, for boxes that are less empty.
    pub parts: u64,
    /// Spheres in the tree.
    pub spheres: u64,
    /// Curved shapes in the tree that are no spheres.
    pub shapes: u64,
    /// Placed instances in the tree.
    pub instances: u64,
    /// Nodes of eight boxes.
    pub nodes: u64,
    /// Leaves of up to four triangles, parts or spheres, or one other shape.
    pub leaves: u64,
    /// Nodes on the longest way down, through an instance if there is one.
    pub depth: u32,
    /// Bytes in memory.
    pub bytes: u64,
    /// Wall-clock seconds of the build.
    pub seconds: f64,
}

impl Accel {
    /// Builds the structure on the current rayon pool. The result does not depend on its size.
    ///
    /// # Errors
    /// Geometry that refers to what is not there, lies beyond the range of f32 arithmetic, or is too large.
    pub fn build(geometry: &Geometry, acceleration: Acceleration) -> Result<Self, BuildError> {
        Self::build_with(geometry, acceleration, &Ranks::default())
    }

    /// As [`build`](Self::build), where of triangles in one plane those of the least rank win.
    pub fn build_with(geometry: &Geometry, acceleration: Acceleration, ranks: &Ranks) -> Result<Self, BuildError> {
        build::build(geometry, acceleration, ranks)
    }

    /// The same structure, asked by itself with another level of vector instructions. The answers are the same. A
    /// rendering asks with its own level (`tracer_core::RenderOptions::level`).
    #[must_use]
    pub fn with_level(mut self, level: Level) -> Self {
        self.level = level;
        self
    }

    /// The level of vector instructions in use where a question brings none.
    pub fn level(&self) -> Level {
        self.level
    }

    /// What was built.
    pub fn stats(&self) -> AccelStats {
        self.stats
    }

    /// Finds the closest hit of the rays whose indices are in `active`, and says what it did.
    ///
    /// # Panics
    /// If an index is beyond a slice.
    pub fn closest(&self, rays: &Rays, active: &[u32], hits: &mut Hits, coherence: Coherence) -> Counters {
        self.closest_at(self.level, rays, active, hits, coherence)
    }

    /// As [`closest`](Self::closest) with the instructions of a level, whatever the structure's own.
    pub fn closest_at(
        &self,
        level: Level,
        rays: &Rays,
        active: &[u32],
        hits: &mut Hits,
        coherence: Coherence,
    ) -> Counters {
        let mut counters = Counters::default();
        kernels::closest(level, coherence, &self.view(), Batch { rays, active }, hits, &mut counters);
        if let Some(coplanar) = &self.coplanar {
            coplanar.settle(rays, active, hits);
        }
        counters
    }

    /// Finds which of the rays whose indices are in `active` are blocked, and says what it did.
    ///
    /// # Panics
    /// If an index is beyond a slice.
    pub fn occluded(&self, rays: &Rays, active: &[u32], occlusion: &mut Occlusion, coherence: Coherence) -> Counters {
        self.occluded_at(self.level, rays, active, occlusion, coherence)
    }

    /// As [`occluded`](Self::occluded) with the instructions of a level, whatever the structure's own.
    pub fn occluded_at(
        &self,
        level: Level,
        rays: &Rays,
        active: &[u32],
        occlusion: &mut Occlusion,
        coherence: Coherence,
    ) -> Counters {
        let mut counters = Counters::default();
        let (view, batch) = (self.view(), Batch { rays, active });
        let Some(coplanar) = &self.coplanar else {
            kernels::occluded(level, coherence, &view, batch, occlusion, &mut counters);
            return counters;
        };
        let ends = coplanar.ends(rays, active, occlusion);
        let mut shorter = Occlusion {
            tmax: &ends,
            target_primitive: occlusion.target_primitive,
            target_instance: occlusion.target_instance,
            occluded: &mut *occlusion.occluded,
        };
        kernels::occluded(level, coherence, &view, batch, &mut shorter, &mut counters);
        coplanar.cover(rays, active, occlusion);
        counters
    }

    /// The boxes under the root: a ray that passes none of them hits nothing here.
    pub fn top_boxes(&self) -> &TopBoxes {
        &self.top
    }

    /// The boxes one level further down: what has been said of those above holds for these, too.
    pub fn second_boxes(&self) -> &SecondBoxes {
        &self.second
    }

    /// How far rays start off each triangle at least, by its place among the triangles: 0 but for those that lie in
    /// one plane with others and overlap them. `None` where there are none.
    pub fn coplanar_offsets(&self) -> Option<&[f32]> {
        self.coplanar.as_ref().map(Coplanar::offsets)
    }

    /// As [`coplanar_offsets`](Self::coplanar_offsets) off each curved shape, by its place among the shapes; `None`
    /// where none has any.
    pub fn coplanar_shape_offsets(&self) -> Option<&[f32]> {
        self.coplanar.as_ref().map(Coplanar::shape_offsets).filter(|offsets| !offsets.is_empty())
    }

    /// Whether surfaces lie in one plane and overlap anywhere.
    pub fn has_coplanar(&self) -> bool {
        self.coplanar.is_some()
    }

    /// How far rays end before a primitive at least: 0 but where it lies in one plane with others and they overlap.
    pub fn coplanar_offset(&self, primitive: u32) -> f32 {
        self.coplanar.as_ref().map_or(0.0, |coplanar| coplanar.offset(primitive))
    }

    /// Whether something else is met in place of some part of a primitive, in whose plane it lies.
    pub fn is_covered(&self, primitive: u32, instance: u32) -> bool {
        self.coplanar.as_ref().is_some_and(|coplanar| coplanar.is_covered(primitive, instance))
    }

    /// Whether that is so where one of some rays comes to the `target`, a primitive and its instance, at t; of a curved
    /// shape t may be that of a plane so far beside its own.
    ///
    /// # Panics
    /// If the index is beyond a slice.
    pub fn is_covered_at(&self, target: (u32, u32), rays: &Rays, ray: usize, t: f32, slack: f32) -> bool {
        self.coplanar.as_ref().is_some_and(|coplanar| coplanar.is_covered_at(target, rays, ray, t, slack))
    }

    /// Whether a primitive lies in a plane without an end.
    pub fn lies_in(&self, plane: u32, primitive: u32, instance: u32) -> bool {
        self.coplanar.as_ref().is_some_and(|coplanar| coplanar.lies_in(plane, primitive, instance))
    }

    /// Whether bodies that let light through touch anywhere: then [`touching`](Self::touching) has to be asked.
    pub fn has_touching(&self) -> bool {
        self.coplanar.as_ref().is_some_and(Coplanar::has_touching)
    }

    /// Which body begins where the closest hits of some rays are on another one that lets light through: its material +
    /// 1 is written to `behind`, which is left alone elsewhere.
    ///
    /// # Panics
    /// If an index is beyond a slice.
    pub fn touching(&self, rays: &Rays, active: &[u32], hits: &Hits, behind: &mut [u32]) {
        if let Some(coplanar) = &self.coplanar {
            coplanar.touching(rays, active, hits, behind);
        }
    }

    /// The tree's bytes, for comparing builds.
    pub fn bytes(&self) -> &[u8] {
        bytemuck::cast_slice(self.arena.units())
    }

    fn view(&self) -> TreeView<'_> {
        TreeView {
            base: self.arena.units().as_ptr().cast(),
            bytes: self.arena.bytes(),
            root: self.root.0,
            size: self.size,
            spheres: self.spheres,
            instances: self.records(),
            meshes: &self.meshes,
            parts: &self.parts,
        }
    }

    fn records(&self) -> &[InstanceRecord] {
        bytemuck::cast_slice(&self.arena.units()[..(self.instances * INSTANCE_UNITS) as usize])
    }
}
