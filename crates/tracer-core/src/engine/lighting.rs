//! What lights a picture: all lights of the scene at once, or, where light groups are told apart, one group after the
//! other. No kernel knows groups: each has the scene by itself, lit by its own lights alone, and techniques of its own.

use super::technique::{Engine, Technique};
use tracer_kernels::engine::batch::Batch;
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::sampling::blocks::runs;
use tracer_kernels::scene::Scene;

/// Lights that are traced together.
pub struct Lighting<'a> {
    /// The scene lit by them.
    pub engine: Engine<'a>,
    /// Which group they are, of so many; `None`: all lights there are.
    pub group: Option<[usize; 2]>,
    /// What finds their light.
    pub techniques: Vec<Box<dyn Technique>>,
}

impl Lighting<'_> {
    /// The pass as its techniques tell it.
    pub fn pass<'a>(&'a self, plain: Pass<'a>) -> Pass<'a> {
        let mut pass = plain;
        self.techniques.iter().for_each(|technique| technique.tell(&mut pass));
        pass
    }

    /// Has the techniques say in which of a batch's blocks they work.
    pub fn mark(&self, batch: &mut Batch) {
        (batch.glints, batch.shares) = (0, 0);
        let items = std::mem::take(&mut batch.items);
        for run in runs(&items) {
            let (block, sample) = (items[run.start].block, items[run.start].sample);
            let of_run = ((1 << run.len()) - 1) << run.start;
            self.techniques.iter().for_each(|technique| technique.mark(&block, sample, of_run, batch));
        }
        batch.items = items;
    }
}

/// The scene as each group lights it, or as all lights do where there are no groups. Layers tell of it with all its
/// lights, and begin with the first.
pub fn engines<'a>(all: Engine<'a>, lit: &'a [Scene]) -> Vec<Engine<'a>> {
    if lit.is_empty() {
        return vec![all];
    }
    lit.iter().enumerate().map(|(k, scene)| Engine { scene, is_first: k == 0, ..all }).collect()
}
