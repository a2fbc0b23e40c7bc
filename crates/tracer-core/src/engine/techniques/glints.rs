//! Glint chains: what mirrors and glass show of the lamps, sampled more often than all else.
//!
//! A lamp in a bent mirror or behind glass is smaller than a pixel and as bright as the lamp: few of the pixel's paths
//! find it. To follow a path over mirrors and glass only is cheap beside the rest of a sample. So where a mirror or
//! glass is seen every pixel follows [`CHAINS`] more at each sample index, which end at all other surfaces, and what a
//! path sees that has met mirrors and glass only is the mean over its own and theirs. Where, a pilot tells, whose
//! random choices are its own, so that weights do not depend on what they weigh: unbiased. It depends on scene, seed
//! and place: the same for any crop and any number of samples.

use super::Trial;
use crate::engine::technique::{Engine, Technique};
use crate::engine::trace::{closest, lamps, shade};
use std::time::Instant;
use tracer_kernels::engine::batch::{Batch, CHAINS, ITEMS, path};
use tracer_kernels::engine::pass::{Pass, Task};
use tracer_kernels::report::{Counters, Stage};
use tracer_kernels::sampling::blocks::{Block, ITEM_PIXELS, Item, TILE};
use tracer_kernels::sampling::sampler::hash3;
use tracer_kernels::scene::Material;
use tracer_kernels::scene::materials::BxdfFlags;

/// Which tiles have chains.
#[derive(Clone, Debug)]
struct Glints {
    first: [u32; 2],
    columns: u32,
    flags: Vec<bool>,
}

impl Glints {
    /// Whether the pixels of a block have chains: where any of the tiles that it touches has. All pixels of a block are
    /// traced alike, and blocks are cut anew for each sample index, whereas tiles are not: no border shows.
    fn in_block(&self, block: &Block) -> bool {
        block.tiles(1).any(|row| block.tiles(0).any(|column| self.of_tile(column, row)))
    }

    fn of_tile(&self, column: i32, row: i32) -> bool {
        let (Ok(column), Ok(row)) = (u32::try_from(column), u32::try_from(row)) else { return false };
        let (Some(column), Some(row)) = (column.checked_sub(self.first[0]), row.checked_sub(self.first[1])) else {
            return false;
        };
        column < self.columns && self.flags.get((row * self.columns + column) as usize).is_some_and(|&flag| flag)
    }
}

/// Chains, where rays are guided and mirrors or glass are seen.
pub fn plan(trial: &Trial<'_>) -> Option<Box<dyn Technique>> {
    trial.plan.as_ref()?;
    // Of a sample's four chains some would see the background and others not.
    if trial.engine.scene.backdrop {
        return None;
    }
    let glints = pilot(trial)?;
    glints.flags.contains(&true).then(|| Box::new(glints) as Box<dyn Technique>)
}

impl Technique for Glints {
    fn name(&self) -> &'static str {
        "glint chains"
    }

    fn mark(&self, block: &Block, _sample: u32, items: u32, batch: &mut Batch) {
        if self.in_block(block) {
            batch.glints |= items;
        }
    }

    fn after_batch(&self, engine: Engine<'_>, pass: Pass<'_>, batch: &mut Batch) {
        if batch.glints != 0 {
            chains(engine, pass, batch);
        }
    }
}

/// Which tiles have chains: those where the camera ray of a pixel, of one in four, meets a mirror or glass. All tiles
/// of the picture are asked that a block may touch which touches the crop. `None` where the scene has neither.
fn pilot(trial: &Trial<'_>) -> Option<Glints> {
    let (scene, crop) = (trial.engine.scene, trial.crop);
    let specular = |material: &Material| material.traits().flags.has(BxdfFlags::SPECULAR);
    if !scene.materials.iter().any(specular) {
        return None;
    }
    let first = [crop.x, crop.y].map(|x| x.saturating_sub(TILE - 1) / TILE);
    let end = [crop.x + crop.width, crop.y + crop.height];
    let end = [0, 1].map(|axis| (end[axis] + TILE - 1).min(scene.size[axis]).div_ceil(TILE));
    let (columns, rows) = (end[0] - first[0], end[1] - first[1]);
    let count = columns as usize * rows as usize;
    let pass = of_chains(trial.pass, 0x0091_1075);
    let of_batch = trial.pool.each(count.div_ceil(ITEMS), |k, batch| {
        batch.watch.resume();
        let start = Instant::now();
        batch.items.clear();
        let tiles = (k * ITEMS..count.min((k + 1) * ITEMS)).map(|tile| tile as u32);
        let block =
            |tile: u32| Block::straight([first[0] + tile % columns, first[1] + tile / columns].map(|x| x as i32));
        batch.items.extend(tiles.map(|tile| Item { block: block(tile), quarter: 0, sample: 0, resting: 0 }));
        batch.glints = 0;
        batch.start();
        follow(trial.engine, pass, u32::MAX, 1, batch);
        let goes_on = &batch.paths.slot[..batch.paths.len];
        let items = goes_on.iter().fold(0, |items, &slot| items | 1u32 << ((slot & path::SLOT) / ITEM_PIXELS as u32));
        batch.watch.costs.photons_since(start);
        items
    });
    let flags = (0..count).map(|k| of_batch[k / ITEMS] >> (k % ITEMS) & 1 == 1).collect();
    Some(Glints { first, columns, flags })
}

/// The pass of chains with random choices of their own.
fn of_chains(pass: Pass<'_>, choices: u32) -> Pass<'_> {
    Pass {
        seed: hash3(pass.seed, 0, choices) as u32,
        reuse: false,
        guide: None,
        light_paths: None,
        task: Task::Chains,
        ..pass
    }
}

/// Adds the chains of the items `batch.glints` to their slots.
fn chains(engine: Engine<'_>, pass: Pass<'_>, batch: &mut Batch) {
    let start = Instant::now();
    let pass = of_chains(pass, 0x0091_1076);
    let samples: [u32; ITEMS] = std::array::from_fn(|k| batch.items.get(k).map_or(0, |item| item.sample));
    for chain in 0..CHAINS {
        for (item, sample) in batch.items.iter_mut().zip(samples) {
            item.sample = sample * CHAINS + chain;
        }
        follow(engine, pass, batch.glints, u32::MAX, batch);
    }
    for (item, sample) in batch.items.iter_mut().zip(samples) {
        item.sample = sample;
    }
    batch.watch.costs.caustics += start.elapsed().as_secs_f64();
}

/// Follows a chain from every pixel of these items, a bit each, to so many hits at most.
fn follow(engine: Engine<'_>, pass: Pass<'_>, items: u32, hits: u32, batch: &mut Batch) {
    let Engine { scene, kernels, .. } = engine;
    let Counters { camera_rays, scattered_rays, .. } = batch.counters;
    kernels.camera(scene, pass.seed, items, batch);
    batch.watch.lap(Stage::Camera);
    let mut vertex = 0;
    while batch.paths.len > 0 && vertex < hits {
        closest(engine, vertex == 0, batch);
        lamps(engine, pass, vertex, batch);
        shade(engine, pass, vertex, batch);
        vertex += 1;
    }
    let counters = &mut batch.counters;
    counters.chain_rays += counters.camera_rays - camera_rays + counters.scattered_rays - scattered_rays;
    (counters.camera_rays, counters.scattered_rays) = (camera_rays, scattered_rays);
}
