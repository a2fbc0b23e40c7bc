//! What is said of a rendering when it has ended.

use super::asked::Asked;
use super::kept::Kept;
use super::picture::Picture;
use super::ready::Ready;
use super::rendered::Rendered;
use super::{cut, empty, repeat};
use crate::args::RenderArgs;
use crate::checkpoint::part_told;
use crate::progress::{noise_of, rate};
use crate::report::{ClampedReport, Stats, Transport};
use crate::shell::Shell;
use scene_format::SceneDesc;
use tracer_core::Film;

/// Says why no picture is written, and keeps what there is.
pub(super) fn of_no_picture(rendered: &Rendered, kept: &mut Kept, shell: &Shell) {
    let checkpoints = kept.checkpoints.take().filter(|_| rendered.most > 0);
    if let Some(Err(error)) = checkpoints.map(|checkpoints| checkpoints.end(&rendered.film)) {
        shell.error(&error);
    }
    shell.say(match rendered.most {
        0 => "interrupted before the first sample: no picture is written",
        _ => "interrupted before all pixels had a sample: the picture that was there stays",
    });
}

/// Says how it went; `names`: of what was written, `seconds`: of all that was done.
pub(super) fn of_picture(
    asked: &Asked<'_>,
    ready: &Ready,
    rendered: &Rendered,
    picture: &Picture,
    (names, seconds): (&str, f64),
) {
    let Asked { args, shell, desc, .. } = asked;
    let film = &rendered.film;
    if let Some(denoised) = picture.denoised.as_ref().filter(|_| shell.is_told()) {
        shell.say(&denoised.to_text());
    }
    of_film(film, args, desc, shell);
    let empty = empty::warning(film, desc, &ready.scene, args.exposure.is_some());
    let warnings: Vec<_> = empty.into_iter().chain(cut::warning(film, desc)).collect();
    shell.diagnostics(&warnings, &desc.sources, args.scene.diagnostics);
    if !shell.is_told() {
        return;
    }
    shell.say(&match asked.part {
        Some(part) if args.denoise.is_on() => {
            let part = part_told(Some(part));
            format!("{names} in {seconds:.2} s: {part}; it is denoised when it is merged: `tracer merge .. --denoise`")
        }
        Some(part) => format!("{names} in {seconds:.2} s: {}", part_told(Some(part))),
        None => format!("{names} in {seconds:.2} s, {}", speed_and_noise(rendered, picture)),
    });
}

/// What there is to say of a film: where the time went, what was left out.
fn of_film(film: &Film, args: &RenderArgs, desc: &SceneDesc, shell: &Shell) {
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
        let beyond = film.counters.beyond;
        let samples = if beyond == 1 { "sample was" } else { "samples were" };
        shell.say(&format!("warning: {beyond} {samples} more than 6.7e7 times the brightest light and left out",));
    }
}

fn speed_and_noise(Rendered { film, before, fewest, seconds, .. }: &Rendered, picture: &Picture) -> String {
    // Each group has camera rays of its own.
    let groups = film.light_groups().len().max(1) as u64;
    let samples = (film.counters.camera_rays - before.counters.camera_rays) / groups;
    let speed = match samples {
        0 => "all samples were there".to_owned(),
        samples => rate(samples as f64 / seconds),
    };
    let noise = noise_of(film, *fewest).map_or(String::new(), |noise| format!("; {noise}"));
    let is_denoised = picture.denoised.is_some();
    let noise = if is_denoised { noise.replacen(" %", " % before it was denoised", 1) } else { noise };
    format!("{speed}{noise}")
}

/// Says what there is of a rendering that a signal has ended, and how it is gone on with; `kept`: where its film is.
pub(super) fn of_interruption(asked: &Asked<'_>, rendered: &Rendered, names: &str, kept: Option<&str>) {
    let Rendered { fewest, most, asked: all, .. } = rendered;
    let held = if fewest == most { format!("{most}") } else { format!("{fewest} to {most}") };
    let goes_on = kept.or(asked.part.map(|_| names));
    let goes_on = goes_on.map_or(String::new(), |name| format!("; --resume {name} goes on"));
    asked.shell.say(&format!("interrupted: {names} holds {held} of {all} samples per pixel{goes_on}"));
}
