//! Layers that count what rays cost: nodes and leaves of the tree that are asked, rays of paths.
//!
//! Rays go through the tree beside others, as many as the registers hold, and what they ask together depends on that.
//! So where it is to be counted each goes once more, alone, through the code that is the same on every machine: the
//! counts depend on scene and ray only. They are whole numbers, far below 2^24.

use super::technique::Engine;
use tracer_kernels::bvh::{Accel, Coherence, Counters, Hits, Occlusion};
use tracer_kernels::engine::batch::{Batch, path, rays};
use tracer_kernels::layers::{Count, LayerSet};
use tracer_kernels::level::Level;

/// What is counted, and in which column.
fn counted(layers: LayerSet) -> Vec<(usize, Count)> {
    layers.counted().collect()
}

fn asks_tree(what: &[(usize, Count)]) -> bool {
    what.iter().any(|&(_, count)| count != Count::Rays)
}

/// Counts the rays of the paths, before it is known what they hit; `camera`: they come from there.
pub fn paths(engine: Engine<'_>, layers: LayerSet, camera: bool, batch: &mut Batch) {
    let what = counted(layers);
    if what.is_empty() {
        return;
    }
    for &(column, _) in what.iter().filter(|&&(_, count)| count == Count::Rays) {
        for &slot in &batch.paths.slot[..batch.paths.len] {
            batch.layers.sums[column][(slot & path::SLOT) as usize] += 1.0;
        }
    }
    let met = engine.scene.met(camera);
    let Some(accel) = met.accel.filter(|_| asks_tree(&what)) else { return };
    // What they would hit elsewhere ends them sooner.
    engine.kernels.closest(met.spheres, batch);
    engine.kernels.reach_closest(accel.top_boxes(), batch);
    for k in 0..batch.active_len {
        let i = batch.active[k] as usize;
        let counters = closest_alone(accel, batch, i);
        add(&what, batch.paths.slot[i], &counters, batch);
    }
}

fn closest_alone(accel: &Accel, batch: &Batch, i: usize) -> Counters {
    let paths = &*batch.paths;
    let all = rays(&paths.origin, &paths.direction, &paths.from_primitive[..], &paths.from_instance[..], paths.len);
    let (mut t, mut primitive) = ([batch.hits.t[i]], [batch.hits.primitive[i]]);
    let mut instance = [batch.hits.instance[i]];
    let mut hits = Hits { t: &mut t, primitive: &mut primitive, instance: &mut instance };
    accel.closest_at(Level::PORTABLE, &all.only(i), &[0], &mut hits, Coherence::Incoherent)
}

/// Counts the shadow rays, before it is known which of them arrive.
pub fn shadows(engine: Engine<'_>, layers: LayerSet, batch: &mut Batch) {
    let what = counted(layers);
    let met = engine.scene.met(false);
    let Some(accel) = met.accel.filter(|_| asks_tree(&what)) else { return };
    engine.kernels.occluded(met.spheres, batch);
    engine.kernels.reach_occluded(accel.top_boxes(), batch);
    for k in 0..batch.active_len {
        let i = batch.active[k] as usize;
        let counters = occluded_alone(accel, batch, i);
        add(&what, batch.shadows.slot[i], &counters, batch);
    }
}

fn occluded_alone(accel: &Accel, batch: &Batch, i: usize) -> Counters {
    let shadows = &*batch.shadows;
    let (origin, direction) = (&shadows.origin, &shadows.direction);
    let all = rays(origin, direction, &shadows.from_primitive[..], &shadows.from_instance[..], shadows.len);
    let mut occluded = [shadows.occluded[i]];
    let mut occlusion = Occlusion {
        tmax: &shadows.t_max[i..=i],
        target_primitive: &shadows.target_primitive[i..=i],
        target_instance: &shadows.target_instance[i..=i],
        occluded: &mut occluded,
    };
    accel.occluded_at(Level::PORTABLE, &all.only(i), &[0], &mut occlusion, Coherence::Incoherent)
}

/// Adds what a ray has asked to its pixel's sample.
fn add(what: &[(usize, Count)], slot: u32, counters: &Counters, batch: &mut Batch) {
    for &(column, count) in what {
        let number = match count {
            Count::Rays => continue,
            Count::Nodes => counters.nodes,
            Count::Leaves => counters.triangle_leaves + counters.sphere_leaves,
        };
        batch.layers.sums[column][(slot & path::SLOT) as usize] += number as f32;
    }
}
