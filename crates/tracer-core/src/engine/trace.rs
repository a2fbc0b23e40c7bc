//! A batch from camera rays to radiance: the loop over the vertices of its paths.

use super::technique::{Engine, Technique, Vertex};
use super::watcher::Watcher;
use super::{counting, direct};
use tracer_kernels::bvh::{Accel, Coherence, Hits, Occlusion};
use tracer_kernels::engine::batch::{BRANCHING, Batch, rays};
use tracer_kernels::engine::kernels::Kernels;
use tracer_kernels::engine::pass::Pass;
use tracer_kernels::engine::{deposit, planes_closest, planes_occluded};
use tracer_kernels::level::Level;
use tracer_kernels::report::Stage;
use tracer_kernels::scene::Integrator;

/// Traces the items of the batch; the radiance of slot s is in `batch.radiance` afterwards.
pub fn trace(
    engine: Engine<'_>,
    pass: Pass<'_>,
    techniques: &[Box<dyn Technique>],
    batch: &mut Batch,
    watcher: &mut impl Watcher,
) {
    batch.start();
    if pass.layers.are_of_hits() && engine.is_first {
        // Here, for a batch may have no path at all: beside a fisheye's circle.
        batch.layers.start(pass.layers.kept(), pass.lamps);
    }
    direct::start(batch);
    engine.kernels.camera(engine.scene, pass.seed, watcher.items(), batch);
    batch.watch.lap(Stage::Camera);
    if let Integrator::AmbientOcclusion { distance } = engine.scene.integrator {
        return ambient(engine, pass, distance, batch);
    }
    let mut number = 0;
    while batch.paths.len > 0 {
        let vertex = Vertex { number, members: batch.members.len, suffixes: batch.suffixes.len };
        bounce(engine, pass, number, batch);
        for technique in techniques {
            let before = batch.paths.len;
            technique.after_vertex(engine, pass, vertex, batch);
            watcher.after_vertex(before, batch);
        }
        number += 1;
    }
    watcher.after_paths(batch);
    for technique in techniques {
        technique.after_batch(engine, pass, batch);
        watcher.after_batch(technique.name(), batch);
    }
}

/// One vertex of all paths: what their rays hit, the light that is seen and sampled from there, and the next rays.
pub fn bounce(engine: Engine<'_>, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
    met(engine, pass, vertex, batch);
    batch.watch.shaded(batch.paths.len, pass.lanes);
    shade(engine, pass, vertex, batch);
    seen(engine, pass, batch);
    if vertex < direct::LAST {
        direct::take(batch);
    }
}

/// The light that rays meet, the lights' samples and the next rays.
pub fn shade(engine: Engine<'_>, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
    if vertex > direct::LAST {
        engine.kernels.shade(engine.scene, pass, vertex, batch);
    } else {
        direct::mark(batch);
        engine.kernels.shade(engine.scene, pass, vertex, batch);
        direct::take(batch);
    }
    batch.watch.lap(Stage::Shade);
}

/// How much is free of what lies above the surfaces that camera rays hit.
fn ambient(engine: Engine<'_>, pass: Pass<'_>, distance: f32, batch: &mut Batch) {
    met(engine, pass, 0, batch);
    engine.kernels.ambient(engine.scene, pass.seed, distance, batch);
    batch.watch.lap(Stage::Shade);
    seen(engine, pass, batch);
    direct::take(batch);
}

/// What the rays of a vertex hit, and what layers want of it.
pub fn met(engine: Engine<'_>, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
    let for_layers = vertex == 0 && pass.layers.are_of_hits() && engine.is_first;
    counting::paths(engine, pass.layers, vertex == 0, batch);
    closest(engine, vertex == 0, batch);
    if for_layers {
        engine.kernels.first_hits(engine.seen, pass.seed, pass.layers, batch);
        batch.watch.lap(Stage::Layers);
    }
    if engine.is_first && pass.layers.seen().next().is_some() {
        engine.kernels.seen(engine.seen, pass.layers, vertex, batch);
        batch.watch.lap(Stage::Layers);
    }
    lamps(engine, pass, vertex, batch);
}

/// Behind so many mirrors and surfaces of glass lamps are told apart: behind three panes. Where glass is followed both
/// ways, up to [`BRANCHING`], and farther on, where chance nearly always lets light pass.
const LAMPS_BEHIND: u32 = 2 * BRANCHING;

/// What the rays of a vertex show of lamps, where that is told apart.
pub fn lamps(engine: Engine<'_>, pass: Pass<'_>, vertex: u32, batch: &mut Batch) {
    if pass.lamps && vertex <= LAMPS_BEHIND {
        engine.kernels.lamps(engine.scene, vertex, batch);
        batch.watch.lap(Stage::Layers);
    }
}

/// Which shadow rays arrive, and what they bring.
pub fn seen(engine: Engine<'_>, pass: Pass<'_>, batch: &mut Batch) {
    counting::shadows(engine, pass.layers, batch);
    occluded(engine, false, batch);
    deposit(batch);
    batch.watch.lap(Stage::Deposit);
}

/// What the rays of `batch.paths` hit; `camera`: they come from there.
pub fn closest(engine: Engine<'_>, camera: bool, batch: &mut Batch) {
    let Engine { scene, kernels, .. } = engine;
    let met = scene.met(camera);
    kernels.closest(met.spheres, batch);
    if !met.planes.is_empty() {
        planes_closest(met.planes, batch);
    }
    batch.watch.lap(Stage::Spheres);
    if scene.has_touching() {
        batch.hits.behind[..batch.paths.len].fill(0);
    }
    let Some(accel) = met.accel else { return };
    kernels.reach_closest(accel.top_boxes(), batch);
    batch.watch.lap(Stage::Reach);
    closest_in_tree(accel, kernels.level(), camera, batch);
    batch.watch.lap(Stage::Closest);
}

/// What the tree holds nearer than the spheres that every ray tests, for the paths in `batch.active`.
fn closest_in_tree(accel: &Accel, level: Level, camera: bool, batch: &mut Batch) {
    let (paths, len) = (&*batch.paths, batch.paths.len);
    let found = &mut *batch.hits;
    let mut hits =
        Hits { t: &mut found.t[..len], primitive: &mut found.primitive[..len], instance: &mut found.instance[..len] };
    let coherence = if camera { Coherence::Coherent } else { Coherence::Incoherent };
    let rays = rays(&paths.origin, &paths.direction, &paths.from_primitive[..], &paths.from_instance[..], len);
    let active = &batch.active[..batch.active_len];
    let counters = accel.closest_at(level, &rays, active, &mut hits, coherence);
    if accel.has_touching() {
        accel.touching(&rays, active, &hits, &mut found.behind[..len]);
    }
    if batch.watch.is_on() {
        batch.watch.statistics.closest.add(active.len(), &counters);
    }
}

/// Which of the shadow rays something blocks; `camera`: they go there.
pub fn occluded(engine: Engine<'_>, camera: bool, batch: &mut Batch) {
    let Engine { scene, kernels, .. } = engine;
    let met = scene.met(camera);
    kernels.occluded(met.spheres, batch);
    if !met.planes.is_empty() {
        planes_occluded(met, batch);
    }
    batch.watch.lap(Stage::Spheres);
    let Some(accel) = met.accel else { return };
    kernels.reach_occluded(accel.top_boxes(), batch);
    batch.watch.lap(Stage::Reach);
    occluded_in_tree(accel, kernels, Coherence::Incoherent, batch);
}

/// Which of the shadow rays in `batch.active` something in the tree blocks.
pub fn occluded_in_tree(accel: &Accel, kernels: &Kernels, coherence: Coherence, batch: &mut Batch) {
    let len = batch.shadows.len;
    let shadows = &mut *batch.shadows;
    let mut occlusion = Occlusion {
        tmax: &shadows.t_max[..len],
        target_primitive: &shadows.target_primitive[..len],
        target_instance: &shadows.target_instance[..len],
        occluded: &mut shadows.occluded[..len],
    };
    let rays = rays(&shadows.origin, &shadows.direction, &shadows.from_primitive[..], &shadows.from_instance[..], len);
    let active = &batch.active[..batch.active_len];
    let counters = accel.occluded_at(kernels.level(), &rays, active, &mut occlusion, coherence);
    if batch.watch.is_on() {
        batch.watch.statistics.occluded.add(active.len(), &counters);
    }
    batch.watch.lap(Stage::Occluded);
}
