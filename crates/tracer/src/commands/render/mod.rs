//! `tracer render`: a scene becomes pictures, and a report.

mod asked;
mod cut;
mod empty;
pub(super) mod frames;
mod goals;
mod kept;
pub(super) mod outputs;
pub(super) mod parts;
mod picture;
mod ready;
mod reference;
mod rendered;
pub(super) mod repeat;
mod report;
pub(super) mod rescue;
mod told;
mod written;

use crate::args::{DenoiseName, IntegratorName, RenderArgs};
use crate::cache::Cache;
use crate::failure::{Failure, exit};
use crate::loading::{is_dash, load, use_threads};
use crate::report::{Report, Seconds};
use crate::shell::Shell;
use crate::write::{Place, save};
use crate::{denoising, interrupt, memory};
use asked::Asked;
use frames::Frames;
use picture::Picture;
use ready::Ready;
use rendered::Rendered;
use scene_format::SceneDesc;
use scene_format::desc::Integrator;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use tracer_core::{Crop, Film, Mattes};
use written::Written;

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
    session: (Option<&Frames>, Option<&Cache>),
) -> Result<ExitCode, Failure> {
    let mut clock = Clock { started, last: started };
    let (mut asked, places) = Asked::new(args, shell, session)?;
    let read = clock.lap();
    let mut ready = Ready::new(&mut asked, places)?;
    let compiled = clock.lap();
    let rendered = Rendered::of(&asked, &mut ready, &mut clock)?;

    rendered.settle(&mut asked);
    if rendered.is_too_little(&asked.outputs) {
        told::of_no_picture(&rendered, &mut ready.kept, shell);
        return Ok(interrupted());
    }
    let is_frame = asked.frames.is_some();
    if rendered.interrupted && is_frame {
        return frames::unfinished(ready.kept.end(&rendered.film), shell);
    }
    let picture = Picture::of(&mut asked, &ready, &rendered)?;
    if picture.is_ended && is_frame {
        return frames::unfinished(ready.kept.end(&rendered.film), shell);
    }
    let picture = picture.into_written(&asked, &ready, &rendered.film);
    let developed = clock.lap();

    let Written { files, kept, elsewhere } = Written::of(&mut asked, &mut ready, &rendered.film, &picture)?;
    let names = outputs::names(&files);
    let to_open = asked.args.open.then(|| outputs::to_open(&files)).flatten();
    let report = asked.args.report.is_some().then(|| report::report(&asked, &mut ready, &rendered, &picture, files));
    let seconds = Seconds {
        read,
        compile: compiled - ready.scene.times.tree,
        build: ready.scene.times.tree,
        render: rendered.seconds,
        develop: developed,
        write: clock.lap(),
        total: clock.total(),
    };

    told::of_picture(&asked, &ready, &rendered, &picture, (&names, seconds.total));
    if let (Some(path), Some(report)) = (&asked.args.report, report) {
        write_report(path, Report { seconds, ..report }.to_json())?;
    }
    if let Some(picture) = to_open.filter(|_| !rendered.interrupted) {
        outputs::open(&picture, shell);
    }
    if rendered.interrupted {
        let kept = kept.as_ref().and_then(|kept| kept.as_deref().ok());
        told::of_interruption(&asked, &rendered, &names, kept);
        return Ok(interrupted());
    }
    if let Some(code) = interrupt::requested().filter(|_| picture.is_ended) {
        return Ok(ExitCode::from(code));
    }
    let failed = elsewhere || picture.is_noisy || matches!(kept, Some(Err(_)));
    Ok(ExitCode::from(if failed { exit::FAILED } else { exit::DONE }))
}

/// The exit code of what a signal has ended.
fn interrupted() -> ExitCode {
    ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED))
}

/// Time in laps, without gaps.
struct Clock {
    started: Instant,
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

    /// Seconds of all laps.
    fn total(&self) -> f64 {
        self.last.duration_since(self.started).as_secs_f64()
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
        exposed_once(args, &desc, exposure)?;
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

/// Sees that `--set` gives no other exposure than the option: one of them would be passed over.
fn exposed_once(args: &RenderArgs, desc: &SceneDesc, exposure: f64) -> Result<(), Failure> {
    let is_set = |set: &&String| set.split_once('=').is_some_and(|(path, _)| path.trim() == "effects.exposure");
    match args.scene.set.iter().rfind(is_set) {
        Some(set) if desc.effects.exposure.value != exposure => {
            Err(Failure::wrong(format!("--exposure {exposure} and --set {set} say two things: leave one of them out")))
        }
        _ => Ok(()),
    }
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
