//! The film of a rendering: begun, or gone on with.

use super::Clock;
use super::asked::Asked;
use super::goals::{self, Afterwards};
use super::outputs::{self, Output};
use super::ready::Ready;
use crate::args::AdaptiveName;
use crate::checkpoint::Checkpoints;
use crate::failure::Failure;
use crate::interrupt;
use crate::loading::expect_all_moments;
use crate::progress::{Goals, Watch};
use std::time::Instant;
use tracer_core::{Counters, Film, Misfit, RenderOptions, render, resume};

/// A film, and what became of the rendering.
pub(super) struct Rendered {
    pub film: Film,
    /// What a checkpoint brought.
    pub before: Before,
    /// Samples per pixel that were asked for.
    pub asked: u32,
    /// Samples of the pixels that have fewest, and of those that have most.
    pub fewest: u32,
    pub most: u32,
    /// A signal came before all samples were done.
    pub interrupted: bool,
    pub seconds: f64,
}

/// What a checkpoint brought.
#[derive(Clone, Copy, Default)]
pub(super) struct Before {
    /// Samples that all pixels had.
    pub samples: u32,
    pub counters: Counters,
}

impl Before {
    fn of(film: Option<&Film>) -> Self {
        film.map_or(Before::default(), |film| Before { samples: *film.samples().start(), counters: film.counters })
    }
}

impl Rendered {
    /// Renders until all is done, a goal is reached, or a signal comes.
    ///
    /// # Errors
    /// A film that does not go with the options; what is wrong with the scene at some moment.
    pub fn of(asked: &Asked<'_>, ready: &mut Ready, clock: &mut Clock) -> Result<Self, Failure> {
        if asked.frames.is_none() {
            interrupt::listen(*asked.shell)?;
        }
        let begun = ready.kept.film.take();
        let (scene, checkpoints) = (&ready.scene, ready.kept.checkpoints.as_ref());
        let before = Before::of(begun.as_ref());
        let samples = asked.part.map_or(scene.samples, |part| part.end - part.first);
        let pixels = u64::from(asked.crop.width) * u64::from(asked.crop.height);
        let (done, all) = (pixels * u64::from(before.samples), pixels * u64::from(samples));
        let goals = goals(asked, ready, begun.as_ref(), clock.started);
        let watch = Watch::new(asked.shell, all).going_on(done, all, checkpoints).until(goals);
        let options = options(asked, ready, goals.until);
        let film = match begun {
            Some(film) => {
                resume(scene, &options, film, &watch).map_err(|misfit| Failure::wrong(unfit(misfit, asked)))?
            }
            None => render(scene, &options, &watch),
        };
        watch.finish();
        expect_all_moments(&film, &asked.desc, asked.args.scene.diagnostics, asked.shell)?;
        let seconds = clock.lap();
        let (fewest, most) = film.samples().into_inner();
        let interrupted = fewest < samples && interrupt::requested().is_some();
        Ok(Rendered { film, before, asked: samples, fewest, most, interrupted, seconds })
    }

    /// Has what is asked for say what came of it: so the report names a command that makes the picture anew.
    pub fn settle(&self, asked: &mut Asked<'_>) {
        if asked.part.is_none() && asked.args.plan.is_none() {
            goals::end(&mut asked.desc, &self.film, self.interrupted, asked.shell);
        }
        asked.args.plan = self.film.plan().filter(|_| !self.interrupted);
        if self.film.is_adaptive() {
            // Also where no noise is asked for.
            asked.args.adaptive = Some(AdaptiveName::Always);
        }
    }

    /// Whether no picture is made of it. Of a picture that is there already there is more than of one that has hardly
    /// begun.
    pub fn is_too_little(&self, outputs: &[Output]) -> bool {
        self.most == 0 || self.interrupted && self.fewest == 0 && outputs::are_there(outputs)
    }
}

/// Why a film is not gone on with, and what to do.
fn unfit(misfit: Misfit, asked: &Asked<'_>) -> String {
    match (misfit, &asked.args.resume, asked.part) {
        (Misfit::Samples { held, .. }, Some(file), None) => format!(
            "{misfit}; write --samples {held} or more; `tracer merge {} -o out.png` makes the picture of what is there",
            file.display()
        ),
        _ => misfit.to_string(),
    }
}

/// What may end it before all samples are done.
fn goals(asked: &Asked<'_>, ready: &Ready, begun: Option<&Film>, started: Instant) -> Goals {
    let desc = &asked.desc;
    let channels = 4
        + tracer_core::film_layers(&desc.output).channels()
        + ready.scene.mattes.channels()
        + 3 * begun.map_or(tracer_core::most_light_groups(desc), |film| film.light_groups().len());
    let afterwards = Afterwards {
        outputs: &asked.outputs,
        channels,
        is_denoised: asked.denoiser.is_some(),
        threads: rayon::current_num_threads(),
    };
    goals::goals(desc, asked.crop, &afterwards, started)
}

fn options(asked: &Asked<'_>, ready: &Ready, until: Option<Instant>) -> RenderOptions {
    let args = &asked.args;
    RenderOptions {
        crop: Some(asked.crop),
        part: asked.part,
        threads: args.threads.map_or(0, usize::from),
        level: Some(asked.level),
        until,
        plan: args.plan,
        halves: args.denoise.is_on(),
        mattes: ready.scene.mattes.kept(),
        statistics: args.stats,
        longest_pass: ready.kept.checkpoints.as_ref().map(Checkpoints::longest_pass),
        ..RenderOptions::default()
    }
}
