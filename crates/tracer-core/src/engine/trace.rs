//! A batch from camera rays to radiance: the loop over the vertices of its paths.

use super::batch::{Batch, Columns};
use super::kernels::Kernels;
use super::stages::deposit::deposit;
use crate::bvh::{Accel, Coherence, Hits, Occlusion, Rays};
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
        if let Some(accel) = &scene.accel {
            kernels.reach_closest(accel.top_boxes(), batch);
            closest_in_tree(accel, vertex == 0, batch);
        }
        kernels.shade(scene, seed, vertex, batch);
        kernels.occluded(scene, batch);
        if let Some(accel) = &scene.accel {
            kernels.reach_occluded(accel.top_boxes(), batch);
            occluded_in_tree(accel, batch);
        }
        deposit(batch);
        vertex += 1;
    }
}

/// The first `len` rays of columns, for the tree.
fn rays<'a>(
    origin: &'a Columns,
    direction: &'a Columns,
    from_primitive: &'a [u32],
    from_instance: &'a [u32],
    len: usize,
) -> Rays<'a> {
    Rays {
        ox: &origin[0][..len],
        oy: &origin[1][..len],
        oz: &origin[2][..len],
        dx: &direction[0][..len],
        dy: &direction[1][..len],
        dz: &direction[2][..len],
        from_primitive: &from_primitive[..len],
        from_instance: &from_instance[..len],
    }
}

/// What the tree holds nearer than the spheres that every ray tests, for the paths in `batch.active`.
fn closest_in_tree(accel: &Accel, camera: bool, batch: &mut Batch) {
    let (paths, len) = (&batch.paths, batch.paths.len);
    let mut hits = Hits {
        t: &mut batch.hits.t[..len],
        primitive: &mut batch.hits.primitive[..len],
        instance: &mut batch.hits.instance[..len],
    };
    let coherence = if camera { Coherence::Coherent } else { Coherence::Incoherent };
    let rays = rays(&paths.origin, &paths.direction, &paths.from_primitive, &paths.from_instance, len);
    accel.closest(&rays, &batch.active[..batch.active_len], &mut hits, coherence);
}

/// Which of the shadow rays in `batch.active` the tree blocks.
fn occluded_in_tree(accel: &Accel, batch: &mut Batch) {
    let len = batch.shadows.len;
    let shadows = &mut batch.shadows;
    let mut occlusion = Occlusion {
        tmax: &shadows.t_max[..len],
        target_primitive: &shadows.light_primitive[..len],
        target_instance: &shadows.light_instance[..len],
        occluded: &mut shadows.occluded[..len],
    };
    let rays = rays(&shadows.origin, &shadows.direction, &shadows.from_primitive, &shadows.from_instance, len);
    accel.occluded(&rays, &batch.active[..batch.active_len], &mut occlusion, Coherence::Incoherent);
}
