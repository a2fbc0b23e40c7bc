//! What is reported of a rendering.

use super::asked::Asked;
use super::picture::Picture;
use super::ready::Ready;
use super::rendered::{Before, Rendered};
use super::repeat;
use crate::cache::Cache;
use crate::checkpoint::assets_hash;
use crate::memory;
use crate::report::{
    FileReport, Machine, Memory, Noise, PictureReport, Primitives, Rays, Report, Samples, SceneReport, Seconds, Stats,
    Transport, Tree, VERSION,
};
use scene_format::SceneDesc;
use tracer_core::{Counters, Crop, Film, Note};

/// The report, but for the seconds of the phases: they are told when the last one, of which making this is part, has
/// ended.
pub(super) fn report(
    asked: &Asked<'_>,
    ready: &mut Ready,
    rendered: &Rendered,
    picture: &Picture,
    files: Vec<FileReport>,
) -> Report {
    let Asked { args, desc, .. } = asked;
    let Rendered { film, before, seconds, .. } = rendered;
    let statistics = ready.scene.statistics();
    let counters = film.counters;
    let mut report = Report {
        report_version: VERSION,
        tracer_version: env!("CARGO_PKG_VERSION"),
        command: repeat::command(args, desc),
        interrupted: rendered.interrupted || picture.is_ended,
        scene: of_scene(desc, &ready.kept.notes),
        picture: of_picture(desc, ready, film, before),
        transport: Transport::new(&desc.render, film),
        rays: rays(&counters, before, *seconds),
        samples: samples(&counters, before, *seconds),
        mean_path_length: (counters.camera_rays + counters.scattered_rays) as f64 / counters.camera_rays.max(1) as f64,
        noise: Noise::of(film),
        denoise: picture.denoised.clone(),
        primitives: Primitives {
            spheres: statistics.spheres,
            triangles: statistics.triangles,
            placed_triangles: statistics.placed_triangles,
            meshes: statistics.meshes,
            instances: statistics.instances,
            lights: statistics.lights,
        },
        tree: statistics.tree.map(|tree| Tree {
            nodes: tree.nodes,
            leaves: tree.leaves,
            parts: tree.parts,
            depth: tree.depth,
            bytes: tree.bytes,
        }),
        memory: Memory {
            peak: memory::peak(),
            geometry: statistics.geometry_bytes,
            textures: statistics.texture_bytes,
            film: film.bytes() as u64,
        },
        cache: asked.cache.map(Cache::report),
        stats: film.statistics.as_ref().map(Stats::new),
        machine: machine(film),
        seconds: Seconds::default(),
        files,
    };
    // What looking for them takes is no part of the rendering's memory.
    report.picture.marks = tracer_core::marks(&mut ready.scene, desc).into_iter().map(Into::into).collect();
    report
}

fn of_scene(desc: &SceneDesc, notes: &[Note]) -> SceneReport {
    SceneReport {
        file: desc.sources.first().map(|source| source.name.clone()).unwrap_or_default(),
        hash: scene_format::hash_hex(desc),
        assets: assets_hash(notes),
    }
}

/// But for the marks.
fn of_picture(desc: &SceneDesc, ready: &Ready, film: &Film, before: &Before) -> PictureReport {
    let (samples_min, samples_max) = film.samples_of_pixels().into_inner();
    let Crop { x, y, width, height } = film.crop();
    let layers = ready.written_layers.names().map(str::to_owned);
    let groups = film.light_groups().iter().map(|group| format!("light.{group}"));
    PictureReport {
        width: film.size()[0],
        height: film.size()[1],
        crop: [x, y, width, height],
        frame: desc.animation.frame.value,
        camera: desc.camera_name.as_deref().map(str::to_owned),
        seed: film.seed(),
        samples_asked: film.part().map_or(ready.scene.samples, |part| part.end - part.first),
        part: film.part().map(|part| [part.first, part.end]),
        samples_min,
        samples_max,
        samples_mean: film.camera_samples() as f64 / (f64::from(width) * f64::from(height)),
        adaptive: film.is_adaptive(),
        samples_resumed: before.samples,
        layers: layers.chain(ready.scene.mattes.names()).chain(groups).collect(),
        marks: Vec::new(),
    }
}

/// What came from a checkpoint took its time elsewhere.
fn per_second(count: u64, before: u64, seconds: f64) -> f64 {
    if seconds > 0.0 { (count - before) as f64 / seconds } else { 0.0 }
}

fn rays(counters: &Counters, before: &Before, seconds: f64) -> Rays {
    let all = |counters: &Counters| {
        let Counters { camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, .. } = counters;
        camera_rays + scattered_rays + shadow_rays + segments + photon_rays + chain_rays
    };
    let total = all(counters);
    Rays {
        camera: counters.camera_rays,
        scattered: counters.scattered_rays,
        shadow: counters.shadow_rays,
        segments: counters.segments,
        photons: counters.photon_rays,
        chains: counters.chain_rays,
        total,
        per_second: per_second(total, all(&before.counters), seconds),
    }
}

fn samples(counters: &Counters, before: &Before, seconds: f64) -> Samples {
    Samples {
        total: counters.camera_rays,
        per_second: per_second(counters.camera_rays, before.counters.camera_rays, seconds),
        dropped: counters.dropped,
        beyond: counters.beyond,
        cut: counters.cut,
    }
}

fn machine(film: &Film) -> Machine {
    Machine {
        threads: film.threads,
        simd: film.level.name(),
        lanes: film.level.lanes(),
        arch: std::env::consts::ARCH,
        os: std::env::consts::OS,
    }
}
