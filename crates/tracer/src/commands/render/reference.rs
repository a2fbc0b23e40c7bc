//! `--integrator reference`: the picture of the textbook path tracer (`crates/reference`), in double precision, without
//! tree or lanes: every ray is tested against everything. Slow, and sure: what the engine's own pictures are held
//! against.

use super::outputs::{outputs, probe, spare_inputs, spare_others};
use super::rescue::{Pictures, pictures};
use crate::args::RenderArgs;
use crate::cache::Cache;
use crate::failure::{Failure, exit};
use crate::loading::{Known, asset_files, compile};
use crate::progress::{Watch, noise, rate};
use crate::shell::Shell;
use crate::write::{Provenance, Setting};
use crate::{interrupt, memory};
use rayon::prelude::*;
use scene_format::desc::Integrator;
use scene_format::{Diagnostics, SceneDesc};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use tracer_core::{Backdrop, Observer, Progress, Scene, develop_radiance};
use tracer_reference::{Reference, Smoothing, Sums, moments};

pub(super) fn run(
    args: &RenderArgs,
    cache: Option<&Cache>,
    shell: &Shell,
    started: Instant,
) -> Result<ExitCode, Failure> {
    if let Some(option) = of_no_use(args) {
        return Err(Failure::wrong(format!(
            "--integrator reference does not go with {option}: it renders a whole picture, and nothing beside it"
        )));
    }
    let args = &super::outputs::named(args)?;
    let outputs = outputs(args)?;
    probe(&outputs, None)?;
    let mut desc = super::described(args, shell)?;
    if desc.render.samples.value < 2 {
        return Err(Failure::wrong("--integrator reference needs two samples per pixel at least; --samples 16"));
    }
    // Nothing of what saves noise is used; the tree stays unasked.
    desc.render.integrator = Integrator::Path;
    let pixels = u64::from(desc.image.width.value) * u64::from(desc.image.height.value);
    // Means and variances, and the picture.
    let needed = pixels * 100;
    if memory::available().is_some_and(|free| needed > free) {
        return Err(Failure::could_not("the picture does not fit into memory; lower --size"));
    }
    let named: Vec<PathBuf> = asset_files(&desc).into_iter().map(|file| desc.base_dir.join(file)).collect();
    spare_inputs(&outputs, args, &named)?;
    let scene = compile(&desc, args.scene.diagnostics, cache.map_or(Known::Nothing, Known::Cached), shell)?;
    spare_inputs(&outputs, args, &scene.files)?;
    spare_others(&outputs, None)?;
    if scene.look.backdrop != Backdrop::Background {
        return Err(Failure::wrong("--integrator reference knows no output.alpha and no output.backdrop"));
    }
    interrupt::listen(*shell)?;
    let rendering = Instant::now();
    let pixels_told = if scene.moves() {
        rendered_moving(&scene, &desc, shell).map_err(|faults| {
            shell.diagnostics(&faults, &desc.sources, args.scene.diagnostics);
            Failure::WrongScene
        })?
    } else {
        rendered(&scene, &desc, shell)
    };
    let Some((radiance, relative)) = pixels_told.map(told) else {
        shell.say("interrupted: no picture is written");
        return Ok(ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED)));
    };
    let seconds = rendering.elapsed().as_secs_f64();
    let image = develop_radiance(scene.size, &scene.look, &radiance);
    let Pictures { files, failed } = pictures(&outputs, &image, &provenance(&desc, args), shell)?;
    if shell.is_told() {
        let names = files.iter().map(|file| file.path.as_str()).collect::<Vec<_>>().join(", ");
        let samples = desc.render.samples.value;
        let noise = noise(relative, samples).map_or(String::new(), |noise| format!("; {noise}"));
        let per_second = pixels as f64 * f64::from(samples) / seconds;
        shell.say(&format!("{names} in {:.2} s, {}{noise}", started.elapsed().as_secs_f64(), rate(per_second)));
    }
    Ok(ExitCode::from(if failed { exit::FAILED } else { exit::DONE }))
}

/// An option of renderings that the reference has no use for.
fn of_no_use(args: &RenderArgs) -> Option<&'static str> {
    let options = [
        (args.frames.is_some(), "--frames"),
        (args.crop.is_some(), "--crop"),
        (args.part.is_some(), "--part"),
        (args.noise.is_some(), "--noise"),
        (args.time.is_some(), "--time"),
        (args.plan.is_some(), "--plan"),
        (args.adaptive.is_some(), "--adaptive"),
        (!args.layers.is_empty(), "--layers"),
        (args.show.is_some(), "--show"),
        (args.denoise.is_on(), "--denoise"),
        (args.checkpoint.is_some(), "--checkpoint"),
        (args.resume.is_some(), "--resume"),
        (args.report.is_some(), "--report"),
        (args.stats, "--stats"),
        (args.open, "--open"),
    ];
    options.into_iter().find(|(is_there, _)| *is_there).map(|(_, option)| option)
}

/// A pixel's mean radiance, and the variance of that.
type PixelTold = [[f64; 3]; 2];

/// Pixels row by row from the top; `None` where the rendering was ended. Rows go to whatever thread is free; each pixel
/// has its own random numbers.
fn rendered(scene: &Scene, desc: &SceneDesc, shell: &Shell) -> Option<Vec<PixelTold>> {
    let [width, height] = scene.size;
    let samples = desc.render.samples.value;
    let of_row = u64::from(width) * u64::from(samples);
    let samples_total = of_row * u64::from(height);
    let watch = Watch::new(shell, samples_total);
    let reference = Reference::new(scene, Smoothing::Hanika);
    let done = AtomicU64::new(0);
    let seed = u64::from(desc.render.seed.value);
    let row = |y: u32| {
        let samples_done = done.fetch_add(of_row, Ordering::Relaxed);
        if watch.progress(Progress { samples_done, samples_total }).is_break() {
            return None;
        }
        Some((0..width).map(|x| reference.pixel([x, y], samples, seed).map(|rgb| rgb.to_array())).collect::<Vec<_>>())
    };
    let rows: Option<Vec<Vec<PixelTold>>> = (0..height).into_par_iter().map(row).collect();
    watch.finish();
    Some(rows?.concat())
}

/// The same where something moves while the shutter is open: a sample of all pixels at each moment.
fn rendered_moving(scene: &Scene, desc: &SceneDesc, shell: &Shell) -> Result<Option<Vec<PixelTold>>, Diagnostics> {
    let [width, height] = scene.size;
    let samples = desc.render.samples.value;
    let pixels = u64::from(width) * u64::from(height);
    let samples_total = pixels * u64::from(samples);
    let watch = Watch::new(shell, samples_total);
    let mut sums = vec![Sums::default(); pixels as usize];
    for (samples_done, (seed, now)) in (0..).zip(moments(scene, samples, u64::from(desc.render.seed.value))) {
        if watch.progress(Progress { samples_done: samples_done * pixels, samples_total }).is_break() {
            watch.finish();
            return Ok(None);
        }
        let now = now?;
        let reference = Reference::new(&now, Smoothing::Hanika);
        let row = |(y, row): (usize, &mut [Sums])| {
            (0..).zip(row).for_each(|(x, sums)| reference.add([x, y as u32], 1, seed, sums));
        };
        sums.par_chunks_mut(width as usize).enumerate().for_each(row);
    }
    watch.finish();
    Ok(Some(sums.iter().map(|sums| sums.mean_and_variance().map(|rgb| rgb.to_array())).collect()))
}

/// Radiance of the pixels, and the noise of the picture.
fn told(pixels: Vec<PixelTold>) -> (Vec<[f64; 3]>, f64) {
    let luminance = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    // Of three numbers that go together, at most; as the engine's own estimate an upper bound.
    let error = |variance: [f64; 3]| luminance(variance.map(f64::sqrt)).powi(2);
    let n = pixels.len() as f64;
    let mean = pixels.iter().map(|[mean, _]| luminance(*mean)).sum::<f64>() / n;
    let variance = pixels.iter().map(|[_, variance]| error(*variance)).sum::<f64>() / n;
    let relative = if mean > 0.0 { variance.sqrt() / mean } else { 0.0 };
    (pixels.into_iter().map(|[mean, _]| mean).collect(), relative)
}

/// What the pictures tell of themselves, if they may; no record: `repro` is for what the engine makes.
fn provenance(desc: &SceneDesc, args: &RenderArgs) -> Provenance {
    if args.no_metadata {
        return Provenance::hidden();
    }
    let source = desc.sources.first();
    let setting = |name, value: String| Setting { name, value };
    let mut settings = vec![
        setting("integrator", "reference".to_owned()),
        setting("samples", desc.render.samples.value.to_string()),
        setting("seed", desc.render.seed.value.to_string()),
        setting("size", format!("{}x{}", desc.image.width.value, desc.image.height.value)),
        setting("max_bounces", desc.render.max_bounces.value.to_string()),
        setting("exposure", desc.effects.exposure.value.to_string()),
        setting("tone_map", format!("{:?}", desc.effects.tone_map)),
    ];
    settings.extend(args.scene.sets().into_iter().map(|set| setting("set", set)));
    let name = source.map_or("", |source| source.name.as_str());
    let name = std::path::Path::new(name).file_name().unwrap_or(name.as_ref()).to_string_lossy().into_owned();
    let scene_text = source.map_or(String::new(), |source| source.text.clone());
    Provenance { scene_name: name, scene_text, settings, ..Provenance::default() }
}
