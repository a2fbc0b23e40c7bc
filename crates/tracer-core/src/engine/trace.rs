//! A batch from camera rays to radiance: the loop over the vertices of its paths.

use super::batch::{Batch, Columns, Group, ITEMS, Shadows};
use super::glints::chains;
use super::guide::Guide;
use super::guide::plan::Plan;
use super::kernels::Kernels;
use super::light_paths::LightPaths;
use super::stages::aim::AIMS_UNTIL;
use super::stages::deposit::deposit;
use super::stages::shaft::Obstacles;
use super::statistics::Stage;
use crate::bvh::{Accel, Coherence, Hits, Occlusion, Rays};
use crate::layers::LayerSet;
use crate::level::Level;
use crate::scene::Scene;
use std::time::Instant;

/// What paths are traced for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// The picture.
    Picture,
    /// Glint chains: they end at all but mirrors and glass ([`super::glints`]).
    Chains,
}

/// What is the same for all batches of a rendering.
#[derive(Clone, Copy)]
pub struct Pass<'a> {
    /// Seed of all random choices.
    pub seed: u32,
    /// Pixels share what they find ([`super::stages::share`]).
    pub reuse: bool,
    /// Lanes of the kernels; for the statistics.
    pub lanes: usize,
    /// What rays are aimed at, where the scene has lights and casters.
    pub guide: Option<&'a Guide>,
    /// What lights send to the camera over mirrors and glass, where light paths are at work.
    pub light_paths: Option<(&'a LightPaths, &'a Plan)>,
    /// What for.
    pub task: Task,
    /// What is kept of the first hits of the picture's camera rays.
    pub layers: LayerSet,
}

/// Traces the items of the batch; the radiance of slot s is in `batch.radiance` afterwards.
pub fn trace(scene: &Scene, kernels: &Kernels, pass: Pass<'_>, batch: &mut Batch) {
    batch.start();
    kernels.camera(scene, pass.seed, u32::MAX, batch);
    batch.watch.lap(Stage::Camera);
    let mut groups_before = [0; ITEMS];
    let mut vertex = 0;
    while batch.paths.len > 0 {
        let (members, suffixes) = (batch.members.len, batch.suffixes.len);
        bounce(scene, kernels, pass, vertex, batch);
        for j in suffixes..batch.suffixes.len {
            batch.groups.of_suffix[j] = groups_before[(batch.suffixes.slot[j] >> 6) as usize];
        }
        group(members, batch, &mut groups_before);
        if let Some(guide) = pass.guide
            && vertex < AIMS_UNTIL
        {
            let start = Instant::now();
            kernels.aim(guide, pass.seed, vertex, batch);
            batch.watch.costs.caustics += start.elapsed().as_secs_f64();
            batch.watch.lap(Stage::Aim);
        }
        vertex += 1;
    }
    if batch.suffixes.len > 0 {
        let start = Instant::now();
        share(scene, kernels, batch);
        batch.watch.costs.reuse += start.elapsed().as_secs_f64();
    }
    if batch.glints != 0 {
        chains(scene, kernels, pass, batch);
    }
}

/// One vertex of all paths: what their rays hit, the light that is seen and sampled from there, and the next rays.
pub fn bounce(scene: &Scene, kernels: &Kernels, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
    closest(scene, kernels, vertex == 0, batch);
    if vertex == 0 && pass.layers.are_of_hits() {
        batch.layers.start(pass.layers.kept());
        kernels.first_hits(scene, pass.seed, pass.layers, batch);
        batch.watch.lap(Stage::Layers);
    }
    batch.watch.shaded(batch.paths.len, pass.lanes);
    kernels.shade(scene, pass, vertex, batch);
    batch.watch.lap(Stage::Shade);
    occluded(scene, kernels, Coherence::Incoherent, batch);
    deposit(batch);
    batch.watch.lap(Stage::Deposit);
}

/// Groups the members from `first` on, those of one vertex, by item.
fn group(first: usize, batch: &mut Batch, group_of_item: &mut [u32; ITEMS]) {
    let mut item = u32::MAX;
    for i in first..batch.members.len {
        let of_member = batch.members.slot[i] >> 6;
        if of_member != item {
            item = of_member;
            group_of_item[item as usize] = batch.groups.list.len() as u32;
            batch.groups.list.push(Group { first: i as u32, len: 0 });
        }
        if let Some(group) = batch.groups.list.last_mut() {
            group.len += 1;
        }
    }
}

/// Gives the members of each group the light of its suffixes.
fn share(scene: &Scene, kernels: &Kernels, batch: &mut Batch) {
    let obstacles = Obstacles::new(scene);
    let mut next = 0;
    while next < batch.suffixes.len {
        next = kernels.share_segments(scene, &obstacles, next, batch);
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
        let Shadows { len, occluded, slot: tags, .. } = &batch.segments;
        for (&occluded, &tag) in occluded[..*len].iter().zip(tags.iter()) {
            batch.groups.hidden[(tag >> 6) as usize] |= u64::from(occluded) << (tag & 63);
        }
    }
    kernels.share_gather(batch);
    batch.watch.lap(Stage::Share);
    for (channel, gathered) in batch.radiance.iter_mut().zip(&batch.groups.gathered) {
        for (&slot, &light) in batch.members.slot[..batch.members.len].iter().zip(gathered.iter()) {
            channel[slot as usize] += light;
        }
    }
}

/// The first `len` rays of columns, for the tree.
pub fn rays<'a>(
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

/// What the rays of `batch.paths` hit; `camera`: they come from there.
pub fn closest(scene: &Scene, kernels: &Kernels, camera: bool, batch: &mut Batch) {
    kernels.closest(scene, batch);
    batch.watch.lap(Stage::Spheres);
    let Some(accel) = &scene.accel else { return };
    kernels.reach_closest(accel.top_boxes(), batch);
    batch.watch.lap(Stage::Reach);
    closest_in_tree(accel, kernels.level(), camera, batch);
    batch.watch.lap(Stage::Closest);
}

/// What the tree holds nearer than the spheres that every ray tests, for the paths in `batch.active`.
fn closest_in_tree(accel: &Accel, level: Level, camera: bool, batch: &mut Batch) {
    let (paths, len) = (&batch.paths, batch.paths.len);
    let mut hits = Hits {
        t: &mut batch.hits.t[..len],
        primitive: &mut batch.hits.primitive[..len],
        instance: &mut batch.hits.instance[..len],
    };
    let coherence = if camera { Coherence::Coherent } else { Coherence::Incoherent };
    let rays = rays(&paths.origin, &paths.direction, &paths.from_primitive[..], &paths.from_instance[..], len);
    let active = &batch.active[..batch.active_len];
    if batch.watch.counts_tree() {
        let counters = accel.closest_at::<true>(level, &rays, active, &mut hits, coherence);
        batch.watch.statistics.closest.add(active.len(), &counters);
    } else {
        accel.closest_at::<false>(level, &rays, active, &mut hits, coherence);
    }
}

/// Which of the shadow rays something blocks.
pub fn occluded(scene: &Scene, kernels: &Kernels, coherence: Coherence, batch: &mut Batch) {
    kernels.occluded(scene, batch);
    batch.watch.lap(Stage::Spheres);
    let Some(accel) = &scene.accel else { return };
    kernels.reach_occluded(accel.top_boxes(), batch);
    batch.watch.lap(Stage::Reach);
    occluded_in_tree(accel, kernels, coherence, batch);
}

/// Which of the shadow rays in `batch.active` something in the tree blocks.
fn occluded_in_tree(accel: &Accel, kernels: &Kernels, coherence: Coherence, batch: &mut Batch) {
    let len = batch.shadows.len;
    let shadows = &mut batch.shadows;
    let mut occlusion = Occlusion {
        tmax: &shadows.t_max[..len],
        target_primitive: &shadows.target_primitive[..len],
        target_instance: &shadows.target_instance[..len],
        occluded: &mut shadows.occluded[..len],
    };
    let rays = rays(&shadows.origin, &shadows.direction, &shadows.from_primitive[..], &shadows.from_instance[..], len);
    let active = &batch.active[..batch.active_len];
    if batch.watch.counts_tree() {
        let counters = accel.occluded_at::<true>(kernels.level(), &rays, active, &mut occlusion, coherence);
        batch.watch.statistics.occluded.add(active.len(), &counters);
    } else {
        accel.occluded_at::<false>(kernels.level(), &rays, active, &mut occlusion, coherence);
    }
    batch.watch.lap(Stage::Occluded);
}
