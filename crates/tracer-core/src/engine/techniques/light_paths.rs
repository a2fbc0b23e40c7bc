//! Light paths ([`tracer_kernels::engine::light_paths`]): followed at the beginning of a pass, onto whatever pixels
//! they fall.

use super::Trial;
use super::photons::{batches, load};
use crate::engine::technique::{Engine, OnFilm, Technique};
use crate::engine::trace::{closest, occluded};
use std::ops::Range;
use std::sync::Arc;
use std::time::Instant;
use tracer_kernels::engine::LightPass;
use tracer_kernels::engine::batch::{Batch, PATHS};
use tracer_kernels::engine::guide::plan::{Plan, Share};
use tracer_kernels::engine::light_paths::LightPaths;
use tracer_kernels::engine::pass::{Pass, PhotonPass};
use tracer_kernels::engine::pool::Pool;
use tracer_kernels::engine::{along_axis, density};
use tracer_kernels::report::Stage;
use tracer_kernels::sampling::blocks::QUARTERS;
use tracer_kernels::scene::Scene;

/// The light paths of a rendering.
struct OfRendering {
    light_paths: LightPaths,
    plan: Arc<Plan>,
}

/// Light paths, where photons are wanted and have a way to go, and pixels could see them.
pub fn plan(trial: &Trial<'_>) -> Option<Box<dyn Technique>> {
    let plan = trial.plan.clone()?;
    let light_paths = LightPaths::new(trial.engine.scene, &plan, trial.pass.seed)?;
    Some(Box::new(OfRendering { light_paths, plan }))
}

impl Technique for OfRendering {
    fn name(&self) -> &'static str {
        "light paths"
    }

    fn tell<'a>(&'a self, pass: &mut Pass<'a>) {
        pass.light_paths = Some((&self.light_paths, &self.plan));
    }

    fn at_once(&self) -> Option<u32> {
        Some(self.light_paths.at_once())
    }

    fn count(&self) -> u64 {
        self.light_paths.count()
    }

    /// Follows the light paths of these sample indices, which have one guide, onto the film.
    fn bring(&self, engine: Engine<'_>, pass: Pass<'_>, samples: Range<u32>, film: OnFilm<'_, '_>, pool: &Pool) {
        let Some(guide) = pass.guide else { return };
        let LightPaths { seed, shares, .. } = &self.light_paths;
        let pass = LightPass { seed: *seed, plan: &self.plan, light_paths: &self.light_paths, guide };
        // Batches of full length, whichever sample index their paths are of.
        let count = samples.end - samples.start;
        let of_samples = |share: &Share| {
            let all = Share { first: share.count.wrapping_mul(samples.start), count: share.count * count, ..*share };
            film.quarter.map_or(all, |quarter| quarter_of(all, quarter))
        };
        let batches = batches(shares.iter().map(of_samples));
        pool.each(batches.len(), |k, batch| {
            batch.watch.resume();
            let start = Instant::now();
            follow(engine, pass, &batches[k], film, batch);
            batch.watch.costs.photons_since(start);
        });
    }
}

/// A quarter of what a share has: the quarters are all of it.
fn quarter_of(share: Share, quarter: u32) -> Share {
    let [from, to] =
        [quarter, quarter + 1].map(|k| (u64::from(share.count) * u64::from(k) / u64::from(QUARTERS)) as u32);
    Share { first: share.first.wrapping_add(from), count: to - from, ..share }
}

/// Follows a batch of light paths.
fn follow(engine: Engine<'_>, pass: LightPass<'_>, shares: &[Share], film: OnFilm<'_, '_>, batch: &mut Batch) {
    let Engine { scene, kernels, .. } = engine;
    let count = load(shares, batch);
    debug_assert!(count <= PATHS);
    let photons = PhotonPass { seed: pass.seed, count, light_paths: Some(pass.light_paths) };
    kernels.photons_emit(scene, pass.plan, photons, batch);
    let mut event = 0;
    batch.watch.lap(Stage::Photons);
    while batch.paths.len > 0 {
        closest(engine, false, batch);
        batch.splats.len = 0;
        kernels.light_paths(scene, pass, event, batch);
        batch.watch.lap(Stage::Photons);
        occluded(engine, true, batch);
        splat(scene, film, batch);
        batch.watch.lap(Stage::Film);
        event += 1;
    }
}

/// Adds what reaches the lens to the film.
fn splat(scene: &Scene, film: OnFilm<'_, '_>, batch: &Batch) {
    let splats = &batch.splats;
    let filter = scene.camera.filter;
    let reach = filter.reach();
    let arrives = |k: usize| batch.shadows.occluded[k] == 0;
    // The shadow ray leaves what the camera is to see.
    let is_hidden =
        |k: usize| scene.is_hidden_primitive(batch.shadows.from_primitive[k], batch.shadows.from_instance[k]);
    // What falls into one eye's half stays there.
    let half = scene.camera.stereo.map(|stereo| usize::from(stereo.above));
    let half = half.map(|axis| (axis, 0.5 * scene.size[axis] as f32));
    let (mut columns, mut falls) = (Vec::new(), Vec::new());
    for k in (0..splats.len).filter(|&k| arrives(k) && !is_hidden(k)) {
        let (x, y) = (splats.x[k], splats.y[k]);
        let is_of_eye = |pixel: [i32; 2]| {
            half.is_none_or(|(axis, border)| (pixel[axis] as f32 + 0.5 < border) == ([x, y][axis] < border))
        };
        let pixels = |at: f32| (at - 0.5 - reach).ceil() as i32..=(at - 0.5 + reach).floor() as i32;
        columns.clear();
        columns.extend(pixels(x).map(|column| {
            let offset = x - 0.5 - column as f32;
            (column, offset, along_axis(filter, offset))
        }));
        falls.clear();
        for row in pixels(y) {
            let offset = y - 0.5 - row as f32;
            let along = along_axis(filter, offset);
            for &(column, of_column, along_column) in &columns {
                let h = density(filter, [of_column, offset], [along_column, along]);
                let scale = h / (h * splats.by_paths[k] + splats.by_light[k]);
                if scale > 0.0 && scale.is_finite() && is_of_eye([column, row]) {
                    falls.push(([column, row], [0, 1, 2].map(|c| splats.brings[c][k] * scale)));
                }
            }
        }
        film.cells.splat(&falls, (film.limit, film.sample), film.group);
    }
}
