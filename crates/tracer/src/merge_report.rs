//! The report of a merged picture as JSON; `docs/scale.md` is its documentation.

use crate::checkpoint::{assets_hash, note};
use crate::denoising::DenoiseReport;
use crate::memory;
use crate::report::{ClampedReport, FileReport, Noise, SceneReport};
use serde::Serialize;
use std::path::Path;
use tracer_core::{Crop, Film, FilmHead, Gap, Part};

/// What one `tracer merge` did.
#[derive(Debug, Serialize)]
pub struct MergeReport {
    report_version: u32,
    tracer_version: &'static str,
    command: String,
    scene: SceneReport,
    picture: MergedPicture,
    parts: Vec<PartReport>,
    missing: Vec<MissingReport>,
    rays: MergedRays,
    samples: MergedSamples,
    mean_path_length: f64,
    noise: Noise,
    denoise: Option<DenoiseReport>,
    clamped: Option<ClampedReport>,
    memory: MergedMemory,
    seconds: MergedSeconds,
    files: Vec<FileReport>,
}

#[derive(Debug, Serialize)]
struct MergedPicture {
    width: u32,
    height: u32,
    crop: [u32; 4],
    seed: u32,
    samples_asked: u32,
    samples_min: u32,
    samples_max: u32,
    layers: Vec<String>,
}

/// A part: its file, and rows and sample indices from the first to the one that it ends before.
#[derive(Debug, Serialize)]
pub struct PartReport {
    file: String,
    rows: [u32; 2],
    samples: [u32; 2],
}

impl PartReport {
    /// Of a file.
    pub fn new(path: &Path, part: &Part) -> Self {
        let Part { crop, first, end, .. } = *part;
        PartReport { file: path.display().to_string(), rows: [crop.y, crop.y + crop.height], samples: [first, end] }
    }
}

#[derive(Debug, Serialize)]
struct MissingReport {
    rows: [u32; 2],
    samples: [u32; 2],
}

#[derive(Debug, Serialize)]
struct MergedRays {
    camera: u64,
    scattered: u64,
    shadow: u64,
    segments: u64,
    photons: u64,
    chains: u64,
    total: u64,
}

#[derive(Debug, Serialize)]
struct MergedSamples {
    total: u64,
    dropped: u64,
    beyond: u64,
    cut: u64,
}

#[derive(Debug, Serialize)]
struct MergedMemory {
    peak: Option<u64>,
    film: u64,
}

#[derive(Debug, Serialize)]
struct MergedSeconds {
    /// Of all parts, summed over threads and machines.
    render: f64,
    merge: f64,
    develop: f64,
    write: f64,
    total: f64,
}

impl MergeReport {
    /// From the film and what it was made of; layers that are written, and what denoising did; seconds of merging,
    /// developing, writing, and all.
    #[allow(clippy::too_many_arguments)]
    pub fn new(
        command: String,
        film: &Film,
        head: &FilmHead,
        parts: Vec<PartReport>,
        gaps: &[Gap],
        (layers, denoise): (Vec<String>, Option<DenoiseReport>),
        [merge, develop, write, total]: [f64; 4],
        files: Vec<FileReport>,
    ) -> Self {
        let counters = film.counters;
        let Crop { x, y, width, height } = film.crop();
        let (samples_min, samples_max) = film.samples_of_pixels().into_inner();
        let [file, hash] = ["scene", "hash"].map(|name| note(head, name).to_owned());
        let mut rays = MergedRays {
            camera: counters.camera_rays,
            scattered: counters.scattered_rays,
            shadow: counters.shadow_rays,
            segments: counters.segments,
            photons: counters.photon_rays,
            chains: counters.chain_rays,
            total: 0,
        };
        let of_kinds = [rays.camera, rays.scattered, rays.shadow, rays.segments, rays.photons, rays.chains];
        rays.total = of_kinds.into_iter().fold(0, u64::saturating_add);
        let missing = |Gap { rows, samples }: &Gap| MissingReport {
            rows: [rows.start, rows.end],
            samples: [samples.start, samples.end],
        };
        MergeReport {
            report_version: crate::report::VERSION,
            tracer_version: env!("CARGO_PKG_VERSION"),
            command,
            scene: SceneReport { file, hash, assets: assets_hash(&head.notes) },
            picture: MergedPicture {
                width: film.size()[0],
                height: film.size()[1],
                crop: [x, y, width, height],
                seed: film.seed(),
                samples_asked: head.part().of_samples,
                samples_min,
                samples_max,
                layers,
            },
            parts,
            missing: gaps.iter().map(missing).collect(),
            mean_path_length: (rays.camera.saturating_add(rays.scattered)) as f64 / rays.camera.max(1) as f64,
            samples: MergedSamples {
                total: rays.camera,
                dropped: counters.dropped,
                beyond: counters.beyond,
                cut: counters.cut,
            },
            rays,
            noise: Noise::of(film),
            denoise,
            clamped: film.clamped().map(ClampedReport::from),
            memory: MergedMemory { peak: memory::peak(), film: film.bytes() as u64 },
            seconds: MergedSeconds { render: film.costs.total, merge, develop, write, total },
            files,
        }
    }

    /// As text.
    ///
    /// # Errors
    /// When a number cannot be told.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|text| text + "\n")
    }
}
