//! The report of a rendering as JSON; `docs/report.md` is its documentation.

use crate::cache::CacheReport;
use crate::denoising::DenoiseReport;
use scene_format::desc::Render;
use serde::Serialize;
use tracer_core::{Clamped, Eye, FewNoisy, Film, MarkSeen, Stage, Statistics, TreeWork};

/// Changes whenever a field changes its meaning or goes; new fields may come at any time.
pub const VERSION: u32 = 1;

/// What one `tracer render` did.
#[derive(Debug, Serialize)]
pub struct Report {
    /// Version of this schema.
    pub report_version: u32,
    /// Version of the program.
    pub tracer_version: &'static str,
    /// A command line that makes the same pictures, from the same folder.
    pub command: String,
    /// Whether Ctrl-C ended it; then `command` may hold more samples than the pictures.
    pub interrupted: bool,
    /// The scene.
    pub scene: SceneReport,
    /// The picture.
    pub picture: PictureReport,
    /// How light was carried.
    pub transport: Transport,
    /// Where the time went.
    pub seconds: Seconds,
    /// Rays.
    pub rays: Rays,
    /// Camera samples.
    pub samples: Samples,
    /// Segments of a path from the camera, on average.
    pub mean_path_length: f64,
    /// Noise of the picture.
    pub noise: Noise,
    /// What denoising did; null where it was not asked for.
    pub denoise: Option<DenoiseReport>,
    /// What there is to be hit.
    pub primitives: Primitives,
    /// The tree of boxes; null when the scene needs none.
    pub tree: Option<Tree>,
    /// Memory.
    pub memory: Memory,
    /// What came from the cache, of all frames so far; null without `--cache`.
    pub cache: Option<CacheReport>,
    /// Where the time of rendering went; null unless `--stats` asked for it.
    pub stats: Option<Stats>,
    /// What it ran on.
    pub machine: Machine,
    /// The pictures.
    pub files: Vec<FileReport>,
}

/// The scene.
#[derive(Debug, Serialize)]
pub struct SceneReport {
    /// As named on the command line; `<stdin>` for standard input.
    pub file: String,
    /// SHA-256 over what the scene says after all options; not how it is written.
    pub hash: String,
    /// SHA-256 over the contents of all files that it names; null where it names none, or one could not be read again.
    pub assets: Option<String>,
}

/// The picture.
#[derive(Debug, Serialize)]
pub struct PictureReport {
    /// Pixels across, of the whole picture.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// The part that was rendered: left, top, width, height.
    pub crop: [u32; 4],
    /// The frame of the scene's animation.
    pub frame: u32,
    /// The name of the camera; null where it has none.
    pub camera: Option<String>,
    /// Seed of all random choices.
    pub seed: u32,
    /// Samples per pixel that were asked for.
    pub samples_asked: u32,
    /// Fewest samples of a pixel.
    pub samples_min: u32,
    /// Most samples of a pixel.
    pub samples_max: u32,
    /// Samples of a pixel, the mean.
    pub samples_mean: f64,
    /// Whether quiet tiles have taken fewer samples than the others.
    pub adaptive: bool,
    /// Of these, fewest samples of a pixel that came from a checkpoint.
    pub samples_resumed: u32,
    /// First sample index and the one after the last, where it is a part (`--part`); else null.
    pub part: Option<[u32; 2]>,
    /// Layers that EXR files hold beside it.
    pub layers: Vec<String>,
    /// The scene's marks.
    pub marks: Vec<MarkReport>,
}

/// Where a mark is in the picture.
#[derive(Debug, Serialize)]
pub struct MarkReport {
    /// Its name.
    pub name: String,
    /// `left` or `right`, where two eyes share the picture; else none.
    pub eye: Option<&'static str>,
    /// From the upper left corner; none where no place shows it.
    pub pixel: Option<[f64; 2]>,
    /// As `focus_distance` is measured.
    pub depth: f64,
    /// In the picture, and nothing before it.
    pub seen: bool,
}

impl From<MarkSeen> for MarkReport {
    fn from(MarkSeen { name, eye, pixel, depth, seen }: MarkSeen) -> Self {
        let eye = eye.map(|eye| match eye {
            Eye::Left => "left",
            Eye::Right => "right",
        });
        MarkReport { name, eye, pixel, depth, seen }
    }
}

/// Wall-clock seconds of the phases, one after the other: they sum to `total`.
#[derive(Clone, Copy, Debug, Default, Serialize)]
pub struct Seconds {
    /// Command line and scene file.
    pub read: f64,
    /// Assets loaded, everything placed.
    pub compile: f64,
    /// The tree of boxes built.
    pub build: f64,
    /// Paths traced.
    pub render: f64,
    /// Film to picture.
    pub develop: f64,
    /// Pictures encoded and written.
    pub write: f64,
    /// From the program's first instruction to the last picture.
    pub total: f64,
}

/// How light was carried.
#[derive(Debug, Serialize)]
pub struct Transport {
    /// `render.integrator`.
    pub integrator: String,
    /// The pixels of a block shared what they found (`render.reuse`).
    pub reuse: bool,
    /// Photons told where rays were aimed (`render.caustics`): asked for, and the scene has lights and what they may
    /// shine over.
    pub caustics: bool,
    /// What all switches together make of the picture.
    pub estimate: Estimate,
    /// Seconds of rendering, summed over threads: what the shares of the switches are of.
    pub seconds: f64,
    /// Each switch.
    pub switches: [Switch; 3],
    /// What clamping took; null where samples are not clamped.
    pub clamped: Option<ClampedReport>,
}

/// What a picture is an estimate of; the worse come later.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Estimate {
    /// Right on average, with any number of samples.
    Unbiased,
    /// Wrong, however many samples there are.
    Biased,
}

impl Estimate {
    /// One word.
    pub fn name(self) -> &'static str {
        match self {
            Estimate::Unbiased => "unbiased",
            Estimate::Biased => "biased",
        }
    }
}

/// A switch of the scene's `render` group.
#[derive(Clone, Debug, Serialize)]
pub struct Switch {
    /// Its name there.
    pub name: &'static str,
    /// What the scene says of it, after all options.
    pub setting: String,
    /// Whether it was at work.
    pub on: bool,
    /// What it makes of the picture.
    pub estimate: Estimate,
    /// What it took, summed over threads.
    pub seconds: f64,
    /// That as share of all seconds of rendering.
    pub share: f64,
}

/// What clamping took.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct ClampedReport {
    /// The limit.
    pub limit: f32,
    /// Samples that were scaled down.
    pub samples: u64,
    /// Radiance taken: red, green, blue; mean over the pixels that were rendered.
    pub radiance: [f64; 3],
    /// Its luminance as share of the mean luminance without clamping.
    pub share: f64,
}

impl From<Clamped> for ClampedReport {
    fn from(clamped: Clamped) -> Self {
        let Clamped { limit, samples, radiance, share } = clamped;
        ClampedReport { limit, samples, radiance, share }
    }
}

impl Transport {
    /// From what the scene asked for and what came of it.
    pub fn new(asked: &Render, film: &Film) -> Self {
        let costs = &film.costs;
        let switch = |name, setting: String, on: bool, when_on: Estimate, seconds: f64| Switch {
            name,
            setting,
            on,
            estimate: if on { when_on } else { Estimate::Unbiased },
            seconds,
            share: if costs.total > 0.0 { seconds / costs.total } else { 0.0 },
        };
        let limit = asked.clamp.as_ref().map_or_else(|| "None".to_owned(), |limit| limit.value.to_string());
        let switches = [
            switch("reuse", format!("{:?}", asked.reuse), film.reuse, Estimate::Unbiased, costs.reuse),
            switch("caustics", format!("{:?}", asked.caustics), film.caustics, Estimate::Unbiased, costs.caustics),
            switch("clamp", limit, film.clamp.is_some(), Estimate::Biased, costs.clamp),
        ];
        Transport {
            integrator: asked.integrator.to_string(),
            reuse: film.reuse,
            caustics: film.caustics,
            estimate: switches.iter().map(|switch| switch.estimate).fold(Estimate::Unbiased, Estimate::max),
            seconds: costs.total,
            switches,
            clamped: film.clamped().map(ClampedReport::from),
        }
    }

    /// A few lines for people.
    pub fn to_text(&self) -> String {
        let mut text = format!("what the switches of `render` cost (the picture is {})", self.estimate.name());
        for Switch { name, setting, on, estimate, seconds, share } in &self.switches {
            let asks_for_it = !matches!(setting.as_str(), "None" | "Paths");
            let setting = if *on || !asks_for_it { setting.clone() } else { format!("{setting}, not used") };
            let estimate = estimate.name();
            text += &format!("\n  {name:<9} {seconds:8.3}  {:4.1} %  {setting}: {estimate}", 100.0 * share);
        }
        if let Some(clamped) = &self.clamped {
            text += &format!("\n  {}", clamped.to_text());
        }
        text
    }
}

impl ClampedReport {
    /// One line for people.
    pub fn to_text(&self) -> String {
        format!("clamping took {:.3} % of the light, from {} samples", 100.0 * self.share, self.samples)
    }
}

/// Rays.
#[derive(Debug, Serialize)]
pub struct Rays {
    /// From the camera.
    pub camera: u64,
    /// From surfaces onward.
    pub scattered: u64,
    /// From surfaces to lights.
    pub shadow: u64,
    /// From surfaces to what other pixels have found (`render.reuse`).
    pub segments: u64,
    /// Photons from the lights, and from mirrors and glass on (`render.caustics`).
    pub photons: u64,
    /// Rays of glint chains and of the pilot that tells where they are followed.
    pub chains: u64,
    /// All.
    pub total: u64,
    /// All, per second of `seconds.render`.
    pub per_second: f64,
}

/// Where the time of rendering went.
#[derive(Clone, Debug, Serialize)]
pub struct Stats {
    /// The stages of the engine.
    pub stages: Vec<StageSeconds>,
    /// Share of the lanes that held a path while surfaces were shaded.
    pub lanes_used: f64,
    /// What a closest hit costs the tree.
    pub closest: PerRay,
    /// What a shadow ray, or a segment between pixels, costs the tree.
    pub occluded: PerRay,
}

/// One stage.
#[derive(Clone, Debug, Serialize)]
pub struct StageSeconds {
    /// One word.
    pub name: &'static str,
    /// Summed over threads.
    pub seconds: f64,
}

/// What a ray costs the tree, on average; null where it was not asked about one.
#[derive(Clone, Debug, Serialize)]
pub struct PerRay {
    /// Nodes of eight boxes.
    pub nodes: Option<f64>,
    /// Leaves.
    pub leaves: Option<f64>,
}

impl Stats {
    /// From what the engine kept.
    pub fn new(statistics: &Statistics) -> Self {
        let per_ray = |work: TreeWork| {
            let part = |count: u64| (work.rays > 0).then(|| count as f64 / work.rays as f64);
            PerRay { nodes: part(work.nodes), leaves: part(work.leaves) }
        };
        Stats {
            stages: Stage::ALL
                .iter()
                .zip(statistics.seconds)
                .map(|(stage, seconds)| StageSeconds { name: stage.name(), seconds })
                .collect(),
            lanes_used: statistics.vertices as f64 / statistics.lanes.max(1) as f64,
            closest: per_ray(statistics.closest),
            occluded: per_ray(statistics.occluded),
        }
    }

    /// A few lines for people.
    pub fn to_text(&self) -> String {
        let total: f64 = self.stages.iter().map(|stage| stage.seconds).sum();
        let mut text = String::from("where the time went (seconds of all threads)\n");
        for StageSeconds { name, seconds } in &self.stages {
            text += &format!("  {name:<9} {seconds:8.3}  {:4.1} %\n", 100.0 * seconds / total.max(1e-9));
        }
        text += &format!("  lanes used in shade: {:.1} %", 100.0 * self.lanes_used);
        for (what, cost) in [("closest hit", &self.closest), ("shadow ray", &self.occluded)] {
            if let PerRay { nodes: Some(nodes), leaves: Some(leaves) } = cost {
                text += &format!("\n  a {what} that reaches the tree: {nodes:.1} nodes, {leaves:.1} leaves");
            }
        }
        text
    }
}

/// Camera samples.
#[derive(Debug, Serialize)]
pub struct Samples {
    /// All.
    pub total: u64,
    /// Per second of `seconds.render`.
    pub per_second: f64,
    /// Not finite, and left out of the picture.
    pub dropped: u64,
    /// Finite, but more than 6.7e7 times the scene's brightest light, and left out of the picture.
    pub beyond: u64,
    /// Paths that had met mirrors and glass only when `max_bounces` ended them.
    pub cut: u64,
}

/// Noise of the picture.
#[derive(Debug, Serialize)]
pub struct Noise {
    /// Root mean square of the standard error of a pixel's luminance, relative to the picture's mean luminance; of
    /// parts that were merged an upper bound.
    pub relative: f64,
    /// The few pixels that bear nearly all of it; null where there are none such.
    pub few: Option<Few>,
}

/// Few pixels that bear nearly all of the noise.
#[derive(Debug, Serialize)]
pub struct Few {
    /// How many they are.
    pub pixels: usize,
    /// The one that bears most: column and row.
    pub worst: [u32; 2],
    /// The noise of all others, relative to their mean luminance; an upper bound.
    pub rest: f64,
}

impl Noise {
    /// The noise of a film.
    pub fn of(film: &Film) -> Noise {
        let of = |FewNoisy { pixels, worst, rest }| Few { pixels, worst, rest };
        Noise { relative: film.relative_noise(), few: film.few_noisy().map(of) }
    }
}

/// What there is to be hit.
#[derive(Debug, Serialize)]
pub struct Primitives {
    /// Spheres, those of lights among them.
    pub spheres: u64,
    /// Triangles, each mesh counted once.
    pub triangles: u64,
    /// Triangles as often as they are placed.
    pub placed_triangles: u64,
    /// Meshes.
    pub meshes: u64,
    /// Placed meshes.
    pub instances: u64,
    /// Lights.
    pub lights: u64,
}

/// The tree of boxes.
#[derive(Debug, Serialize)]
pub struct Tree {
    /// Nodes of eight boxes.
    pub nodes: u64,
    /// Leaves.
    pub leaves: u64,
    /// Parts that triangles have been cut into.
    pub parts: u64,
    /// Nodes on the longest way down.
    pub depth: u32,
    /// Bytes.
    pub bytes: u64,
}

/// Memory in bytes.
#[derive(Debug, Serialize)]
pub struct Memory {
    /// The most that the process held; null where the system does not say.
    pub peak: Option<u64>,
    /// Vertices, normals, texture coordinates, indices.
    pub geometry: u64,
    /// Texels.
    pub textures: u64,
    /// The film.
    pub film: u64,
}

/// What it ran on.
#[derive(Debug, Serialize)]
pub struct Machine {
    /// Threads that rendered.
    pub threads: usize,
    /// Vector instructions of the engine.
    pub simd: &'static str,
    /// Their lanes.
    pub lanes: usize,
    /// Processor family.
    pub arch: &'static str,
    /// Operating system.
    pub os: &'static str,
}

/// A picture file.
#[derive(Debug, Serialize)]
pub struct FileReport {
    /// As named on the command line.
    pub path: String,
    /// `png`, `exr`, `hdr` or `pfm`.
    pub format: &'static str,
    /// Size.
    pub bytes: u64,
    /// SHA-256 of the file.
    pub sha256: String,
}

impl Report {
    /// As JSON text.
    ///
    /// # Errors
    /// None that a report can cause.
    pub fn to_json(&self) -> serde_json::Result<String> {
        serde_json::to_string_pretty(self).map(|json| json + "\n")
    }
}
