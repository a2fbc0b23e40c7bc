//! Adds the light of unblocked shadow rays to their slots.

use crate::engine::batch::{Batch, path};

/// Adds each unblocked contribution to its slot; those of a slot in the order of its paths. Which rays are blocked
/// cannot be foretold, so the others are listed first, without a branch.
pub fn deposit(batch: &mut Batch) {
    let (shadows, open) = (&*batch.shadows, &mut *batch.active);
    let mut count = 0;
    for (i, &occluded) in (0..).zip(&shadows.occluded[..shadows.len]) {
        open[count] = i;
        count += usize::from(occluded == 0);
    }
    let [red, green, blue] = batch.radiance.each_mut().map(|channel| &mut channel[..]);
    let [r, g, b] = shadows.contribution.each_ref().map(|channel| &channel[..]);
    let slots = &shadows.slot[..];
    for &i in &open[..count] {
        let i = i as usize;
        let slot = (slots[i] & path::SUM) as usize;
        red[slot] += r[i];
        green[slot] += g[i];
        blue[slot] += b[i];
    }
}
