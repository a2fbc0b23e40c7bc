//! Adds the light of unblocked shadow rays to their slots.

use crate::engine::batch::Batch;

/// Adds each unblocked contribution to its slot; those of a slot in the order of its paths.
pub fn deposit(batch: &mut Batch) {
    let shadows = &batch.shadows;
    let [red, green, blue] = &mut batch.radiance;
    let [r, g, b] = &shadows.contribution;
    for i in 0..shadows.len {
        if shadows.occluded[i] == 0 {
            let slot = shadows.slot[i] as usize;
            red[slot] += r[i];
            green[slot] += g[i];
            blue[slot] += b[i];
        }
    }
}
