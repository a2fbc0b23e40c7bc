//! What ends a rendering before all samples are done, because it is good enough or has taken long enough.

use super::outputs::Output;
use crate::args::RenderArgs;
use crate::failure::Failure;
use crate::progress::{Goals, SMALL};
use crate::shell::Shell;
use crate::write::Encoding;
use scene_format::SceneDesc;
use std::time::{Duration, Instant};
use tracer_core::{Crop, Film, Plan, Scene};

/// The most samples where a goal is given on the command line and nothing else is said: the scene's own number is not
/// for that.
const MOST: u32 = 1_000_000;

/// Seconds that a pixel takes to be developed on one core, and a channel of it to be written to an EXR and to another
/// file; and that denoising it takes. Guesses on the long side, by the processor time of a picture of 1920x1080.
const DEVELOP: f64 = 3e-7;
const WRITE_EXR: f64 = 3.5e-7;
const WRITE: f64 = 6e-8;
const DENOISE: f64 = 2e-5;

/// What is done with a film when the rendering has ended.
pub struct Afterwards<'a> {
    pub outputs: &'a [Output],
    /// The channels of an EXR.
    pub channels: usize,
    pub is_denoised: bool,
    pub threads: usize,
}

impl Afterwards<'_> {
    /// Seconds that it will take for so many pixels.
    fn seconds(&self, pixels: f64) -> f64 {
        let channels = |output: &Output| match output.encoding {
            Encoding::Exr => self.channels as f64 * WRITE_EXR,
            _ => 3.0 * WRITE,
        };
        let denoise = if self.is_denoised { DENOISE } else { 0.0 };
        pixels * (DEVELOP + denoise + self.outputs.iter().map(channels).sum::<f64>()) / self.threads.max(1) as f64
    }
}

/// The scene with the goals of the command line.
pub fn described(args: &RenderArgs, desc: &mut SceneDesc) {
    if let Some(noise) = args.noise {
        desc.render.noise = Some(noise.into());
    }
    if let Some(adaptive) = args.adaptive {
        desc.render.adaptive = adaptive.word();
    }
    if let Some(time) = args.time {
        desc.render.time = Some(time.as_secs_f64().into());
    }
    if args.samples.is_none() && (args.noise.is_some() || args.time.is_some()) {
        desc.render.samples = MOST.into();
    }
    if let Some(plan) = args.plan {
        (desc.render.noise, desc.render.time) = (None, None);
        desc.render.samples = plan.end.into();
    }
}

/// A plan that no rendering of a scene with motion has told is refused.
pub fn is_of_moments(plan: Option<Plan>, scene: &Scene) -> Result<(), Failure> {
    match plan.filter(|plan| scene.moves() && plan.end != plan.whole + 1) {
        Some(Plan { whole, .. }) => Err(Failure::wrong(format!(
            "--plan: each sample of this scene sees a moment of its own, so the second number is {} here",
            whole + 1
        ))),
        None => Ok(()),
    }
}

/// The goals of a scene, with what is done afterwards; its time began with the program.
pub fn goals(desc: &SceneDesc, crop: Crop, afterwards: &Afterwards<'_>, started: Instant) -> Goals {
    let pixels = f64::from(crop.width) * f64::from(crop.height);
    let afterwards = afterwards.seconds(pixels);
    let until = desc.render.time.as_ref().and_then(|time| {
        // A time that no clock can hold is none.
        let time = Duration::try_from_secs_f64((time.value - afterwards).max(0.0)).ok()?;
        started.checked_add(time)
    });
    Goals { noise: desc.render.noise.as_ref().map(|goal| goal.value), until }
}

/// Says what became of the goals. Where one of them ended the rendering, the scene asks for the samples that the film
/// has: so the report names a command that makes the picture anew.
pub fn end(desc: &mut SceneDesc, film: &Film, interrupted: bool, shell: &Shell) {
    let (fewest, most) = film.samples().into_inner();
    let asked = desc.render.samples.value;
    let goal = desc.render.noise.as_ref().map(|goal| goal.value);
    if interrupted || fewest == 0 {
        return;
    }
    let say = |line: String| {
        if shell.is_told() {
            shell.say(&line);
        }
    };
    let noise = film.relative_noise();
    if fewest < asked {
        let held = if fewest == most { format!("{most}") } else { format!("{fewest} to {most}") };
        let why = if goal.is_some_and(|goal| noise <= goal) { "that is good enough" } else { "the time is up" };
        let Crop { width, height, .. } = film.crop();
        let mean = film.camera_samples() as f64 / (f64::from(width) * f64::from(height));
        let on_average = if film.is_adaptive() { format!(", {mean:.0} on average") } else { String::new() };
        say(format!("{held} samples per pixel{on_average}: {why}"));
        desc.render.samples = fewest.into();
    } else if let Some(goal) = goal.filter(|goal| noise > *goal) {
        let (noise, percent) = (100.0 * noise, 100.0 * goal);
        say(format!("the noise is {noise:.2} %, not {percent} %: {asked} samples came first"));
        if film.few_noisy().is_some() {
            say(SMALL.to_owned());
        }
    }
}
