//! Pixels share the second vertices of their paths ([`tracer_kernels::engine::share`]).

use super::Trial;
use super::trial::{quarters, stratified};
use crate::engine::technique::{Engine, Technique, Vertex};
use crate::engine::trace::{bounce, occluded_in_tree};
use std::time::Instant;
use tracer_kernels::bvh::Coherence;
use tracer_kernels::engine::batch::{Batch, Group, ITEMS, Shadows};
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::engine::{Obstacles, planes_hide};
use tracer_kernels::report::Stage;
use tracer_kernels::sampling::blocks::{Block, ITEM_PIXELS};
use tracer_kernels::sampling::sampler::hash3;
use tracer_kernels::scene::Sharing;

/// Under a background pixels share in all blocks where such a share of the paths has a second vertex, as in rooms with
/// a window, in none where it is [`OUTDOORS`] or less, and in a part of the blocks between, so that pictures of a
/// sequence, or of other seeds, do not differ in kind. What a ray sees where it leaves the scene is its own pixel's;
/// outdoors to share never paid (docs/noise.md).
const INDOORS: f32 = 0.75;
const OUTDOORS: f32 = 0.6;

/// Which blocks share.
struct Reuse {
    seed: u32,
    /// So large a part of them.
    share_of_blocks: f32,
}

/// Sharing, where any block does.
pub fn plan(trial: &Trial<'_>) -> Option<Box<dyn Technique>> {
    let share_of_blocks = share_of_blocks(trial);
    (share_of_blocks > 0.0).then(|| Box::new(Reuse { seed: trial.pass.seed, share_of_blocks }) as Box<dyn Technique>)
}

impl Technique for Reuse {
    fn name(&self) -> &'static str {
        "sharing"
    }

    fn tell<'a>(&'a self, pass: &mut Pass<'a>) {
        pass.reuse = true;
    }

    fn mark(&self, block: &Block, sample: u32, items: u32, batch: &mut Batch) {
        if shares(self.seed, block.tile, sample, self.share_of_blocks) {
            batch.shares |= items;
        }
    }

    /// Who shares what was found at this vertex.
    fn after_vertex(&self, _: Engine<'_>, _: Pass<'_>, vertex: Vertex, batch: &mut Batch) {
        for j in vertex.suffixes..batch.suffixes.len {
            batch.groups.of_suffix[j] = batch.groups.of_item[(batch.suffixes.slot[j] >> 6) as usize];
        }
        group(vertex.members, batch);
    }

    fn after_batch(&self, engine: Engine<'_>, _: Pass<'_>, batch: &mut Batch) {
        if batch.suffixes.len > 0 {
            let start = Instant::now();
            share(engine, batch);
            batch.watch.costs.reuse += start.elapsed().as_secs_f64();
        }
    }
}

/// The share of the blocks whose pixels share.
fn share_of_blocks(trial: &Trial<'_>) -> f32 {
    let sharing = match trial.options.reuse {
        None => trial.engine.scene.reuse,
        Some(true) => Sharing::Always,
        Some(false) => Sharing::Never,
    };
    match sharing {
        Sharing::Always => 1.0,
        Sharing::Never => 0.0,
        Sharing::Indoors => {
            let has_second = if trial.has_samples { second_vertices(trial) } else { 0.0 };
            ((has_second - OUTDOORS) / (INDOORS - OUTDOORS)).clamp(0.0, 1.0)
        }
    }
}

/// Whether the pixels of the block of a tile share at a sample index: so large a share of the blocks does, by chance.
fn shares(seed: u32, tile: [i32; 2], sample: u32, share: f32) -> bool {
    let salt = hash3(seed, sample, 0x05ba_5e55) as u32;
    ((hash3(salt, tile[0] as u32, tile[1] as u32) >> 40) as f32) < share * (1u32 << 24) as f32
}

/// The share of a trial's paths that have a second vertex. It depends on scene and seed alone.
fn second_vertices(trial: &Trial<'_>) -> f32 {
    let Engine { scene, kernels, .. } = trial.engine;
    // Choices of its own: whether pixels share must not depend on the very paths that do.
    let pass = Pass { reuse: true, seed: hash3(trial.pass.seed, 0, 0x001d_17ee) as u32, ..trial.pass };
    let count = (ITEMS as u64).min(quarters(scene)) as u32;
    let found = trial.pool.once(|batch| {
        batch.watch.resume();
        let start = Instant::now();
        let before = (batch.counters, batch.watch.costs);
        batch.items.clear();
        batch.items.extend((0..count).map(|k| stratified(scene, pass.seed, k, count)));
        batch.glints = 0;
        batch.shares = u32::MAX;
        batch.start();
        kernels.camera(scene, pass.seed, u32::MAX, batch);
        for vertex in 0..=scene.max_bounces {
            bounce(trial.engine, pass, vertex, batch);
        }
        (batch.counters, batch.watch.costs) = before;
        batch.watch.costs.reuse += start.elapsed().as_secs_f64();
        batch.watch.lap(Stage::Share);
        batch.suffixes.len
    });
    found as f32 / (count as usize * ITEM_PIXELS) as f32
}

/// Groups the members from `first` on, those of one vertex, by item.
fn group(first: usize, batch: &mut Batch) {
    let mut item = u32::MAX;
    for i in first..batch.members.len {
        let of_member = batch.members.slot[i] >> 6;
        if of_member != item {
            item = of_member;
            batch.groups.of_item[item as usize] = batch.groups.list.len() as u32;
            batch.groups.list.push(Group { first: i as u32, len: 0 });
        }
        if let Some(group) = batch.groups.list.last_mut() {
            group.len += 1;
        }
    }
}

/// Gives the members of each group the light of its suffixes.
fn share(engine: Engine<'_>, batch: &mut Batch) {
    let Engine { scene, kernels, .. } = engine;
    let obstacles = Obstacles::new(scene);
    let mut next = 0;
    while next < batch.suffixes.len {
        let first = next;
        next = kernels.share_segments(scene, &obstacles, next, batch);
        if !scene.tables.planes.is_empty() {
            planes_hide(&scene.tables.planes, first..next, batch);
        }
        batch.watch.lap(Stage::Share);
        let Some(accel) = &scene.accel else { continue };
        std::mem::swap(&mut batch.shadows, &mut batch.segments);
        batch.active_len = batch.shadows.len;
        for (k, active) in batch.active[..batch.active_len].iter_mut().enumerate() {
            *active = k as u32;
        }
        batch.shadows.occluded[..batch.active_len].fill(0);
        // All rays of a suffix go to the same point.
        occluded_in_tree(accel, kernels, Coherence::Coherent, batch);
        std::mem::swap(&mut batch.shadows, &mut batch.segments);
        let Shadows { len, occluded, slot: tags, .. } = &*batch.segments;
        for (&occluded, &tag) in occluded[..*len].iter().zip(tags.iter()) {
            batch.groups.hidden[(tag >> 6) as usize] |= u64::from(occluded) << (tag & 63);
        }
    }
    kernels.share_gather(batch);
    batch.watch.lap(Stage::Share);
    for (channel, gathered) in batch.radiance.iter_mut().zip(batch.groups.gathered.iter()) {
        for (&slot, &light) in batch.members.slot[..batch.members.len].iter().zip(gathered.iter()) {
            channel[slot as usize] += light;
        }
    }
}
