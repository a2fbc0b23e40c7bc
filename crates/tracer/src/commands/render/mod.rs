//! `tracer render`: a scene becomes pictures, and a report.

mod empty;
pub(super) mod frames;
mod goals;
mod kept;
pub(super) mod outputs;
pub(super) mod parts;
mod reference;
pub(super) mod repeat;
pub(super) mod rescue;

use crate::args::{DenoiseArgs, DenoiseName, IntegratorName, RenderArgs};
use crate::cache::Cache;
use crate::checkpoint::{Checkpoints, Extent, assets_hash, part_told};
use crate::denoising::{self, Denoiser, Developed};
use crate::failure::{Failure, exit};
use crate::loading::{Known, asset_files, compile, expect_all_moments, is_dash, load, use_threads};
use crate::progress::{Watch, noise_of, rate};
use crate::report::{
    ClampedReport, FileReport, Machine, Memory, Noise, PictureReport, Primitives, Rays, Report, Samples, SceneReport,
    Seconds, Stats, Transport, Tree, VERSION,
};
use crate::shell::Shell;
use crate::write::{Place, save};
use crate::{interrupt, lanes, layer_view, memory};
use frames::{AtEnd, Frames};
use goals::Afterwards;
use kept::{Kept, Places};
use rescue::{Pictures, Rescued, pictures, rescue};
use scene_format::SceneDesc;
use scene_format::desc::Integrator;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Instant;
use tracer_core::{Counters, Crop, Film, Image, Layer, Mattes, RenderOptions, Scene, render, resume};

pub(super) fn run(args: &RenderArgs, shell: &Shell, started: Instant) -> Result<ExitCode, Failure> {
    use_threads(args.threads)?;
    let args = &with_integrator(args);
    let cache = Cache::open(&args.cache, args.threads, shell)?;
    let cached = cache.as_ref();
    if args.frames.is_none() {
        frames::tell_of_names(args, shell);
    }
    let ended = match args.frames {
        _ if args.integrator.is_some() => {
            frames::numbered(args).and_then(|args| reference::run(&args, cached, shell, started))
        }
        Some(frames) => frames::run(args, frames, cached, shell, started),
        None => frames::numbered(args).and_then(|args| one(&args, shell, started, (None, cached))),
    };
    // What is kept for the next time is on the disk before this one ends.
    if let Some(cache) = cached {
        cache.finish();
    }
    ended
}

/// The same, with the integrator as a field of the scene that is set: so checkpoints, reports and pictures tell of it
/// as of all others. The reference is no word of scenes.
fn with_integrator(args: &RenderArgs) -> RenderArgs {
    let mut args = args.clone();
    if let Some(word) = args.integrator.and_then(IntegratorName::word) {
        // A kind with fields has brackets, whether they are empty or not.
        let brackets = if matches!(word, Integrator::AmbientOcclusion { .. }) { "()" } else { "" };
        args.scene.set.push(format!("render.integrator={word}{brackets}"));
        args.integrator = None;
    }
    args
}

/// Renders one picture, or one of several frames.
fn one(
    args: &RenderArgs,
    shell: &Shell,
    started: Instant,
    (frames, cache): (Option<&Frames>, Option<&Cache>),
) -> Result<ExitCode, Failure> {
    let mut clock = Clock { last: started };
    let args = &outputs::named(args)?;
    let part_file = args.part.map(|_| parts::place(args)).transpose()?;
    let outputs = if part_file.is_some() { Vec::new() } else { outputs::outputs(args)? };
    let level = lanes::from_environment()?;
    outputs::probe(&outputs, args.report.as_deref())?;
    // A part is denoised by whoever merges it.
    let denoiser = if part_file.is_some() { None } else { Denoiser::ready(args.denoise.how())? };
    let places = Places::new(args, shell)?;
    let mut desc = AtEnd::new(described(args, shell)?, frames);
    frames.map_or(Ok(()), |frames| frames.is_as_before(&desc))?;
    let crop = crop(args, &desc)?;
    let part = parts::part(args, &desc, crop)?;
    let crop = part.map_or(crop, |part| part.crop);
    check_memory(crop, &desc, args.denoise.how())?;
    if part.is_none() && args.show.is_none() && frames.is_none() {
        outputs::tell_of_layers(&outputs, args, &desc, shell);
    }
    let named: Vec<PathBuf> = asset_files(&desc).into_iter().map(|file| desc.base_dir.join(file)).collect();
    outputs::spare_inputs(&outputs, args, &named)?;
    if frames.is_none() {
        let written: Vec<_> = outputs::written(args).map(|(option, path)| (option, path.to_owned())).collect();
        outputs::spare_mentioned(&written, &desc)?;
    }
    let read = clock.lap();

    let known = match (frames, cache) {
        (Some(frames), _) => Known::Kept(&frames.kept),
        (None, Some(cache)) => Known::Cached(cache),
        (None, None) => Known::Nothing,
    };
    let mut scene = AtEnd::new(compile(&desc, args.scene.diagnostics, known, shell)?, frames);
    // Not the one that a backdrop needs, unless it is asked for.
    let written_layers = tracer_core::layer_set(&desc.output.layers);
    goals::is_of_moments(args.plan, &scene)?;
    denoising::prepare(&mut scene, args.denoise.is_on())?;
    // Only now it is known what the meshes' own materials name.
    outputs::spare_inputs(&outputs, args, &scene.files)?;
    outputs::spare_others(&outputs, args.report.as_deref())?;
    // A part that is kept under its own name needs no second file.
    let is_kept = part_file.as_ref().is_some_and(|file| places.writes(file));
    let extent = Extent::Film(crop, part);
    let Kept { film: begun, checkpoints, notes, .. } = &mut places.open(args, &mut desc, &scene, extent, shell)?;
    let hashing = kept::hashing(args, notes, &scene, &desc, (frames, cache));
    let compiled = clock.lap();

    if frames.is_none() {
        interrupt::listen(*shell)?;
    }
    let pixels = u64::from(crop.width) * u64::from(crop.height);
    let before = Before::of(begun.as_ref());
    let done = pixels * u64::from(before.samples);
    let asked = part.map_or(scene.samples, |part| part.end - part.first);
    let all = pixels * u64::from(asked);
    let channels = 4
        + tracer_core::film_layers(&desc.output).channels()
        + scene.mattes.channels()
        + 3 * begun.as_ref().map_or(tracer_core::most_light_groups(&desc), |film| film.light_groups().len());
    let afterwards = Afterwards {
        outputs: &outputs,
        channels,
        is_denoised: denoiser.is_some(),
        threads: rayon::current_num_threads(),
    };
    let goals = goals::goals(&desc, crop, &afterwards, started);
    let watch = Watch::new(shell, all).going_on(done, all, checkpoints.as_ref()).until(goals);
    let options = RenderOptions {
        crop: Some(crop),
        part,
        threads: args.threads.map_or(0, usize::from),
        level: Some(level),
        until: goals.until,
        plan: args.plan,
        halves: args.denoise.is_on(),
        mattes: scene.mattes.kept(),
        statistics: args.stats,
        longest_pass: checkpoints.as_ref().map(Checkpoints::longest_pass),
        ..RenderOptions::default()
    };
    let film = match begun.take() {
        Some(film) => resume(&scene, &options, film, &watch).map_err(|misfit| Failure::wrong(misfit.to_string()))?,
        None => render(&scene, &options, &watch),
    };
    watch.finish();
    expect_all_moments(&film, &desc, args.scene.diagnostics, shell)?;
    let rendered = clock.lap();

    let (fewest, most) = film.samples().into_inner();
    let interrupted = fewest < asked && interrupt::requested().is_some();
    if part.is_none() && args.plan.is_none() {
        goals::end(&mut desc, &film, interrupted, shell);
    }
    let args = &RenderArgs { plan: film.plan().filter(|_| !interrupted), ..args.clone() };
    // Of a picture that is there already there is more than of one that has hardly begun.
    if most == 0 || interrupted && fewest == 0 && outputs::are_there(&outputs) {
        if let Some(Err(error)) = checkpoints.take().filter(|_| most > 0).map(|checkpoints| checkpoints.end(&film)) {
            shell.error(&error);
        }
        shell.say(match most {
            0 => "interrupted before the first sample: no picture is written",
            _ => "interrupted before all pixels had a sample: the picture that was there stays",
        });
        return Ok(ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED)));
    }
    if interrupted && frames.is_some() {
        return frames::unfinished(checkpoints.take().map(|checkpoints| checkpoints.end(&film)), shell);
    }
    let made = (!outputs.is_empty())
        .then(|| denoising::picture(&film, &scene.look, written_layers, denoiser.as_ref(), shell))
        .transpose()?;
    let is_noisy = made.as_ref().is_some_and(|made| made.is_noisy(shell));
    let is_ended = made.as_ref().is_some_and(|made| made.is_ended);
    // The picture is the one that comes without.
    let denoise = if is_ended { DenoiseArgs { denoise: None } } else { args.denoise };
    let args = &RenderArgs { denoise, ..args.clone() };
    if is_ended && frames.is_some() {
        return frames::unfinished(checkpoints.take().map(|checkpoints| checkpoints.end(&film)), shell);
    }
    let (mut image, denoised) = made.map(|Developed { image, denoised, .. }| (image, denoised)).unzip();
    if let Some(image) = image.as_mut().filter(|_| outputs::has_exr(&outputs)) {
        image.mattes = scene.mattes.develop(&film);
    }
    if let Some(layer) = args.show {
        image = shown(layer, &film, shell);
    }
    let developed = clock.lap();

    notes.extend(kept::hashed(hashing, shell));
    let denoised = denoised.flatten();
    let denoised_by = denoiser.filter(|_| denoised.is_some()).map(|by| by.name().name());
    let provenance = kept::provenance(args, notes, &film, denoised_by);
    // First, because all else can be made of it. The pictures are written whatever becomes of it.
    let kept = checkpoints.take().map(|checkpoints| checkpoints.end(&film));
    if let Some(Err(error)) = &kept {
        shell.error(error);
    }
    let written = image.as_ref().map(|image| pictures(&outputs, image, &provenance, shell)).transpose()?;
    let Pictures { mut files, failed: mut elsewhere } = written.unwrap_or_default();
    if let Some(file) = &part_file {
        let place = Place::File(file.named().to_owned());
        let is_there = is_kept && matches!(kept, Some(Ok(_)));
        let rescued = rescue(&place, shell, |place| match is_there {
            true => parts::written(place),
            false => parts::save(place, &film, notes, shell),
        })?;
        let Rescued { written, name: path, elsewhere: is_elsewhere } = rescued;
        elsewhere |= is_elsewhere;
        files.push(FileReport { path, format: "film", bytes: written.bytes, sha256: written.sha256 });
    }
    let names = outputs::names(&files);
    let to_open = args.open.then(|| outputs::to_open(&files)).flatten();
    let mut report = args
        .report
        .is_some()
        .then(|| report(args, &desc, &scene, &film, rendered, files, interrupted || is_ended, &before));
    if let Some(report) = &mut report {
        report.scene.assets = assets_hash(notes);
        report.cache = cache.map(Cache::report);
        report.picture.marks = tracer_core::marks(&mut scene, &desc).into_iter().map(Into::into).collect();
        let layers = written_layers.names().map(str::to_owned);
        let groups = film.light_groups().iter().map(|group| format!("light.{group}"));
        report.picture.layers = layers.chain(scene.mattes.names()).chain(groups).collect();
        report.denoise = denoised.clone();
    }
    let written = clock.lap();
    let seconds = Seconds {
        read,
        compile: compiled - scene.times.tree,
        build: scene.times.tree,
        render: rendered,
        develop: developed,
        write: written,
        total: clock.last.duration_since(started).as_secs_f64(),
    };

    if let Some(denoised) = denoised.as_ref().filter(|_| shell.is_told()) {
        shell.say(&denoised.to_text());
    }
    tell_of(&film, args, &desc, shell);
    shell.diagnostics(empty::warning(&film, &desc, &scene).as_slice(), &desc.sources, args.scene.diagnostics);
    if let Some(part) = part.filter(|_| shell.is_told()) {
        shell.say(&format!("{names} in {:.2} s: {}", seconds.total, part_told(Some(part))));
    } else if shell.is_told() {
        // Each group has camera rays of its own.
        let groups = film.light_groups().len().max(1) as u64;
        let samples = (film.counters.camera_rays - before.counters.camera_rays) / groups;
        let speed = match samples {
            0 => "all samples were there".to_owned(),
            samples => rate(samples as f64 / seconds.render),
        };
        let noise = noise_of(&film, fewest).map_or(String::new(), |noise| format!("; {noise}"));
        let noise = if denoised.is_some() { noise.replacen(" %", " % before it was denoised", 1) } else { noise };
        shell.say(&format!("{names} in {:.2} s, {speed}{noise}", seconds.total));
    }
    if let (Some(path), Some(report)) = (&args.report, &mut report) {
        report.seconds = seconds;
        write_report(path, report.to_json())?;
    }
    if let Some(picture) = to_open.filter(|_| !interrupted) {
        outputs::open(&picture, shell);
    }
    if interrupted {
        let held = if fewest == most { format!("{most}") } else { format!("{fewest} to {most}") };
        let goes_on = kept.and_then(Result::ok).or(part.map(|_| names.clone()));
        let goes_on = goes_on.map_or(String::new(), |name| format!("; --resume {name} goes on"));
        shell.say(&format!("interrupted: {names} holds {held} of {asked} samples per pixel{goes_on}"));
        return Ok(ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED)));
    }
    if let Some(code) = interrupt::requested().filter(|_| is_ended) {
        return Ok(ExitCode::from(code));
    }
    let failed = elsewhere || is_noisy || matches!(kept, Some(Err(_)));
    Ok(ExitCode::from(if failed { exit::FAILED } else { exit::DONE }))
}

/// A layer of a film in place of its picture; what its colours stand for is said.
fn shown(layer: Layer, film: &Film, shell: &Shell) -> Option<Image> {
    let layer = film.layer(layer)?;
    let (image, range) = layer_view::picture(&layer, film.crop().width);
    if let Some([low, high]) = range.map(|range| range.map(layer_view::number)).filter(|_| shell.is_told()) {
        shell.say(&format!("{}: {low} is dark, {high} and more is bright", layer.name));
    }
    Some(image)
}

/// What there is to say of a film: where the time went, what was left out.
fn tell_of(film: &Film, args: &RenderArgs, desc: &SceneDesc, shell: &Shell) {
    if let Some(statistics) = film.statistics.as_ref().filter(|_| !args.quiet) {
        shell.say(&Stats::new(statistics).to_text());
        shell.say(&Transport::new(&desc.render, film).to_text());
    } else if let Some(clamped) = film.clamped().filter(|_| shell.is_watched()) {
        shell.say(&ClampedReport::from(clamped).to_text());
    }
    if film.counters.dropped > 0 {
        shell.say(&format!(
            "warning: {} samples were not finite and are left out; repeat with: {}",
            film.counters.dropped,
            repeat::command(args, desc)
        ));
    }
    if film.counters.beyond > 0 {
        shell.say(&format!(
            "warning: {} samples were more than 6.7e7 times the brightest light and are left out",
            film.counters.beyond
        ));
    }
}

/// What a checkpoint brought.
#[derive(Clone, Copy, Default)]
struct Before {
    /// Samples that all pixels had.
    samples: u32,
    counters: Counters,
}

impl Before {
    fn of(film: Option<&Film>) -> Self {
        film.map_or(Before::default(), |film| Before { samples: *film.samples().start(), counters: film.counters })
    }
}

/// Time in laps, without gaps.
struct Clock {
    last: Instant,
}

impl Clock {
    /// Seconds since the last lap.
    fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let seconds = now.duration_since(self.last).as_secs_f64();
        self.last = now;
        seconds
    }
}

/// The scene of a rendering in so many parts, with what the options say; what no part could be made of is told here.
pub(super) fn of_parts(args: &RenderArgs, parts: u32, shell: &Shell) -> Result<SceneDesc, Failure> {
    if args.integrator == Some(IntegratorName::Reference) {
        return Err(Failure::wrong(
            "--integrator reference renders whole pictures only; render it with `tracer render`",
        ));
    }
    let desc = described(args, shell)?;
    let crop = crop(args, &desc)?;
    let part = parts::part_of(args, &desc, crop, [1, parts], &format!("--parts {parts}"))?;
    check_memory(part.crop, &desc, args.denoise.how())?;
    Ok(desc)
}

/// The scene with what the options say.
fn described(args: &RenderArgs, shell: &Shell) -> Result<SceneDesc, Failure> {
    let mut desc = load(&args.scene, shell)?;
    if let Some(size) = args.size {
        desc.image.width = size.width.into();
        desc.image.height = size.height.into();
    }
    if let Some(samples) = args.samples {
        desc.render.samples = samples.into();
    }
    goals::described(args, &mut desc);
    if let Some(seed) = args.seed {
        desc.render.seed = seed.into();
    }
    if let Some(exposure) = args.exposure {
        desc.effects.exposure = exposure.into();
    }
    if let Some(word) = args.integrator.and_then(IntegratorName::word) {
        desc.render.integrator = word;
    }
    for layer in args.layers.iter().chain(&args.show).copied().map(tracer_core::layer_word) {
        if !desc.output.layers.contains(&layer) {
            desc.output.layers.push(layer);
        }
    }
    Ok(desc)
}

fn crop(args: &RenderArgs, desc: &SceneDesc) -> Result<Crop, Failure> {
    let size = [desc.image.width.value, desc.image.height.value];
    let Some(crop) = args.crop else { return Ok(Crop::whole(size)) };
    if crop.within(size) == crop {
        return Ok(crop);
    }
    let Crop { x, y, width, height } = crop;
    Err(Failure::wrong(format!(
        "--crop {x},{y},{width},{height} does not lie in the picture, which has {}x{} pixels (--size changes that)",
        size[0], size[1]
    )))
}

/// A picture that cannot fit is refused here: later the system would end the program.
pub(super) fn check_memory(crop: Crop, desc: &SceneDesc, denoise: DenoiseName) -> Result<(), Failure> {
    // The developed picture, and an encoded one while it is made and written.
    const BYTES_PER_PIXEL: u64 = 48;
    let pixels = u64::from(crop.width) * u64::from(crop.height);
    let layers = tracer_core::film_layers(&desc.output);
    let layers = if denoise.is_on() { denoising::with_guides(layers) } else { layers };
    // As numbers, as channels and as bytes.
    let of_denoising = denoising::bytes_per_pixel(denoise);
    let mattes = Mattes::asked(&desc.output);
    let groups = tracer_core::most_light_groups(desc);
    let channels = (layers.channels() + mattes.channels() + 3 * groups) as u64;
    let of_pixel = BYTES_PER_PIXEL + 12 * channels + of_denoising + mattes.kept().bytes_of_pixel();
    let needed = memory::of_film(crop, &desc.render, layers, denoise.is_on())
        + Film::bytes_of_groups(crop, groups)
        + pixels * of_pixel;
    match memory::available() {
        Some(available) if needed > available => Err(Failure::could_not(format!(
            "a picture of {}x{} pixels takes {} of memory, and {} are free; lower --size, or render parts of it by \
             --crop",
            crop.width,
            crop.height,
            memory::human(needed),
            memory::human(available)
        ))),
        _ => Ok(()),
    }
}

/// The report, but for the seconds of the phases.
#[allow(clippy::too_many_arguments)]
fn report(
    args: &RenderArgs,
    desc: &SceneDesc,
    scene: &Scene,
    film: &Film,
    render_seconds: f64,
    files: Vec<FileReport>,
    interrupted: bool,
    before: &Before,
) -> Report {
    let statistics = scene.statistics();
    let counters = film.counters;
    let all = |counters: &Counters| {
        let Counters { camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, .. } = counters;
        camera_rays + scattered_rays + shadow_rays + segments + photon_rays + chain_rays
    };
    let rays = all(&counters);
    // What came from a checkpoint took its time elsewhere.
    let per_second = |count: u64, before: u64| {
        if render_seconds > 0.0 { (count - before) as f64 / render_seconds } else { 0.0 }
    };
    let (samples_min, samples_max) = film.samples().into_inner();
    let Crop { x, y, width, height } = film.crop();
    Report {
        report_version: VERSION,
        tracer_version: env!("CARGO_PKG_VERSION"),
        command: repeat::command(args, desc),
        interrupted,
        scene: SceneReport {
            file: desc.sources.first().map(|source| source.name.clone()).unwrap_or_default(),
            hash: scene_format::hash_hex(desc),
            assets: None,
        },
        picture: PictureReport {
            width: film.size()[0],
            height: film.size()[1],
            crop: [x, y, width, height],
            frame: desc.animation.frame.value,
            camera: desc.camera_name.as_deref().map(str::to_owned),
            seed: film.seed(),
            samples_asked: film.part().map_or(scene.samples, |part| part.end - part.first),
            part: film.part().map(|part| [part.first, part.end]),
            samples_min,
            samples_max,
            samples_resumed: before.samples,
            layers: film.layers().names().map(str::to_owned).collect(),
            marks: Vec::new(),
        },
        transport: Transport::new(&desc.render, film),
        rays: Rays {
            camera: counters.camera_rays,
            scattered: counters.scattered_rays,
            shadow: counters.shadow_rays,
            segments: counters.segments,
            photons: counters.photon_rays,
            chains: counters.chain_rays,
            total: rays,
            per_second: per_second(rays, all(&before.counters)),
        },
        samples: Samples {
            total: counters.camera_rays,
            per_second: per_second(counters.camera_rays, before.counters.camera_rays),
            dropped: counters.dropped,
            beyond: counters.beyond,
        },
        mean_path_length: (counters.camera_rays + counters.scattered_rays) as f64 / counters.camera_rays.max(1) as f64,
        noise: Noise::of(film),
        denoise: None,
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
        cache: None,
        stats: film.statistics.as_ref().map(Stats::new),
        machine: Machine {
            threads: film.threads,
            simd: film.level.name(),
            lanes: film.level.lanes(),
            arch: std::env::consts::ARCH,
            os: std::env::consts::OS,
        },
        // Told when the last phase, of which making this is part, has ended.
        seconds: Seconds::default(),
        files,
    }
}

pub(super) fn write_report(path: &Path, json: serde_json::Result<String>) -> Result<(), Failure> {
    let json = json.map_err(|error| Failure::could_not(format!("cannot write the report: {error}")))?;
    if is_dash(path) {
        let mut out = std::io::stdout().lock();
        out.write_all(json.as_bytes())?;
        return Ok(out.flush()?);
    }
    Ok(save(path, json.as_bytes())?)
}

/// The place that a path on the command line means.
fn place(path: &Path) -> Place {
    if is_dash(path) { Place::Stdout } else { Place::File(path.to_owned()) }
}
