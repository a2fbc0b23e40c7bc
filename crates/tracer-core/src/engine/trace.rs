//! A batch from camera rays to radiance: the loop over the vertices of its paths.

use super::batch::Batch;
use super::kernels::Kernels;
use super::stages::deposit::deposit;
use crate::sampling::sampler::z_order;
use crate::scene::Scene;

/// Traces the items of the batch; the radiance of slot s is in `batch.radiance` afterwards.
pub fn trace(scene: &Scene, kernels: &Kernels, seed: u32, batch: &mut Batch) {
    for (z, item) in batch.block_z.iter_mut().zip(&batch.items) {
        *z = z_order(item.block_x, item.block_y);
    }
    kernels.camera(scene, seed, batch);
    let mut vertex = 0;
    while batch.paths.len > 0 {
        kernels.closest(scene, batch);
        kernels.shade(scene, seed, vertex, batch);
        kernels.occluded(scene, batch);
        deposit(batch);
        vertex += 1;
    }
}
