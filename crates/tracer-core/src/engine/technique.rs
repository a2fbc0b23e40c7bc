//! What a technique is: a way to find light sooner than plain paths do, beside the others and without knowing them.
//!
//! What it does in lanes, the stages call by one function of its own (`stages::share`, `stages::aim`,
//! `stages::light_paths`), by what [`Technique::tell`] has told them. All else it does here: calls are by pass, batch
//! and vertex, never by lane.

use crate::film::Cells;
use std::any::Any;
use std::ops::Range;
use tracer_kernels::engine::batch::Batch;
use tracer_kernels::engine::kernels::Kernels;
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::sampling::blocks::Block;
use tracer_kernels::scene::Scene;

/// A scene, and the stages compiled for this CPU.
#[derive(Clone, Copy)]
pub struct Engine<'a> {
    pub scene: &'a Scene,
    pub kernels: &'a Kernels,
    /// What layers tell of: the same, with all its lights.
    pub seen: &'a Scene,
    /// A batch is not traced with another one before, whose layers it adds to.
    pub is_first: bool,
}

impl<'a> Engine<'a> {
    /// Of a scene with all its lights.
    pub fn new(scene: &'a Scene, kernels: &'a Kernels) -> Self {
        Engine { scene, kernels, seen: scene, is_first: true }
    }
}

/// The vertex of a batch's paths that was shaded last.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// Its number, from 0 at what camera rays hit.
    pub number: u32,
    /// Members that there were before it.
    pub members: usize,
    /// Suffixes that there were before it.
    pub suffixes: usize,
}

/// The film, for what comes to it by other ways than by samples.
#[derive(Clone, Copy)]
pub struct OnFilm<'a, 'b> {
    /// The film.
    pub cells: &'a Cells<'b>,
    /// The most that the largest channel of what one light path brings counts, where samples are clamped; in the film's
    /// unit.
    pub limit: Option<f64>,
    /// The first sample index that it comes with: the others have the same half and are taken by the same tiles
    /// ([`crate::film`]).
    pub sample: u32,
    /// The light group that it is of, and how many there are.
    pub group: Option<[usize; 2]>,
    /// The quarter of its sample index's light that comes at this moment, where something moves; else it is all of it.
    pub quarter: Option<u32>,
}

/// A way to find light. Whether it is at work depends on scene and settings alone, and so does all that it does: the
/// picture is the same for any crop, threads, lanes, and however the samples are divided into passes.
pub trait Technique: Send + Sync {
    /// What it is called where a sample is explained.
    fn name(&self) -> &'static str;

    /// Makes ready for the sample indices of a pass; none goes over a power of two.
    fn before_pass(&mut self, _: Engine<'_>, _samples: &Range<u32>, _: &Pool) {}

    /// Tells the stages.
    fn tell<'a>(&'a self, _: &mut Pass<'a>) {}

    /// Says which blocks it works in: `items` are the bits of the block's items in the batch, which is being filled.
    fn mark(&self, _: &Block, _sample: u32, _items: u32, _: &mut Batch) {}

    /// After a vertex of all paths of a batch was shaded and its light added.
    fn after_vertex(&self, _: Engine<'_>, _: Pass<'_>, _: Vertex, _: &mut Batch) {}

    /// After the last vertex of a batch.
    fn after_batch(&self, _: Engine<'_>, _: Pass<'_>, _: &mut Batch) {}

    /// What it was made ready with, for the technique of its name at the next moment of a scene that moves: there are
    /// new ones for each.
    fn hand_on(&mut self) -> Option<Box<dyn Any + Send>> {
        None
    }

    /// Goes on with what the one of the moment before has handed on.
    fn take_over(&mut self, _: Box<dyn Any + Send>) {}

    /// If it brings light to the film beside the samples: how many sample indices it works on at a time. At most one
    /// technique does: the film counts one such sum ([`crate::film`]).
    fn at_once(&self) -> Option<u32> {
        None
    }

    /// How many light paths it follows for a sample index.
    fn count(&self) -> u64 {
        0
    }

    /// Brings the light of these sample indices to the film, no more of them than [`Technique::at_once`] says.
    fn bring(&self, _: Engine<'_>, _: Pass<'_>, _samples: Range<u32>, _: OnFilm<'_, '_>, _: &Pool) {}
}
