//! What comes to a sample over one surface at most, for the layers `direct` and `indirect`.
//!
//! It is told by when it is added to the sample's radiance: what camera rays meet, what lights send to where they hit,
//! and what the rays meet that go on from there. Chains ([`super::techniques`]) are weighed against paths, so what they
//! meet at their first two vertices belongs to it, too. All else is added elsewhere and comes over two surfaces at
//! least: what pixels share, what light paths bring.

use crate::film::counts;
use tracer_kernels::engine::batch::Batch;
use tracer_kernels::layers::LayerSet;
use tracer_kernels::sampling::blocks::ITEM_PIXELS;

/// Rays up to this vertex meet light that has come over one surface at most.
pub const LAST: u32 = 1;

/// Before the lights' first ray: no radiance yet.
pub fn start(batch: &mut Batch) {
    for light in &mut batch.layers.direct {
        (light.now, light.mark) = ([0.0; 3], [0.0; 3]);
    }
}

/// Looks at the radiance of all samples; what is added from now on may be taken.
pub fn mark(batch: &mut Batch) {
    for (slot, light) in batch.layers.direct.iter_mut().enumerate() {
        light.mark = [0, 1, 2].map(|c: usize| batch.radiance[c][slot]);
    }
}

/// Takes what was added since it was looked at, and looks again. A difference of single precision is exact in double.
pub fn take(batch: &mut Batch) {
    for (slot, light) in batch.layers.direct.iter_mut().enumerate() {
        for c in 0..3 {
            let radiance = batch.radiance[c][slot];
            light.now[c] += f64::from(radiance) - f64::from(light.mark[c]);
            light.mark[c] = radiance;
        }
    }
}

/// Writes what was taken into the columns of layers, after clamping: no more than there is left of the sample.
pub fn settle(layers: LayerSet, batch: &mut Batch) {
    if batch.layers.direct.is_empty() {
        return;
    }
    for slot in 0..batch.items.len() * ITEM_PIXELS {
        let light = &mut batch.layers.direct[slot];
        let left = [0, 1, 2].map(|c: usize| batch.radiance[c][slot]);
        // Else the film leaves the sample out.
        if counts(left) {
            (0..3).for_each(|c| light.before[c] += light.now[c].min(f64::from(left[c])));
        }
        let sum = light.before;
        for column in layers.direct() {
            (0..3).for_each(|c| batch.layers.sums[column + c][slot] = sum[c] as f32);
        }
    }
}
