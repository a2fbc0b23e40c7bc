//! `cargo xtask sweeps`: no cliffs, no pops. A parameter of a scene is changed step by step, and neither the noise of
//! the default picture, over that of the plain path tracer at equal samples, nor its mean may jump between neighbours
//! where that of the plain path tracer does not;
//! frames of a film may not flicker more than the plain path tracer's. How that is told: `statistics`; what is swept:
//! `scenes`.

pub mod scenes;
pub mod statistics;

use crate::truth::trial::Source;
use crate::truth::world::grey;
use crate::truth::written::compiled;
use scenes::{ALL, SEED, SIZE, Sweep};
use statistics::{LARGEST, Measured, OF_MEAN, Pictures, flicker, jump, jump_of_mean, ratios};
use std::ops::Range;

/// The chance that a run in which nothing jumps has a finding.
const LEVEL: f64 = 0.01;

/// What is to be done.
#[derive(Clone, Debug)]
pub struct Options {
    /// Steps of each parameter; films have 24 at most.
    pub steps: usize,
    /// Pictures of each step, default and plain.
    pub pictures: u32,
    /// Samples per pixel.
    pub samples: u32,
    /// Pixels along a side.
    pub size: u32,
    /// Only sweeps whose names contain this.
    pub name: String,
    /// Only these steps of each.
    pub only: Range<usize>,
}

/// Frames of a film.
const FRAMES: usize = 24;

/// The pictures of one step.
struct Step {
    ours: Pictures,
    ratios: Vec<f64>,
    plain: Pictures,
}

/// Makes all sweeps, and prints what was measured; gives how many jumps are too large.
///
/// # Errors
/// A scene is refused; nothing has such a name.
pub fn run(options: &Options) -> anyhow::Result<usize> {
    let sweeps: Vec<&Sweep> = ALL.iter().filter(|sweep| sweep.name.contains(&options.name)).collect();
    anyhow::ensure!(!sweeps.is_empty(), "no sweep has {:?} in its name", options.name);
    anyhow::ensure!(options.pictures > 3, "four pictures at least");
    let tests: usize = sweeps.iter().map(|sweep| 3 * steps_of(sweep, options)).sum();
    let level = LEVEL / tests as f64;
    println!(
        "{} pictures of {} samples; ratio: noise of the default picture over the plain path tracer's; the largest \
         jumps \
         between neighbours, as factors, with their standard errors",
        options.pictures, options.samples
    );
    println!("{:20} {:>13} {:>16} {:>9} {:>16} {:>9}", "sweep", "ratio", "jump of noise", "at", "jump of mean", "at");
    let mut findings = 0;
    for sweep in sweeps {
        findings += one(sweep, options, level)?;
    }
    Ok(findings)
}

fn steps_of(sweep: &Sweep, options: &Options) -> usize {
    if sweep.film { options.steps.min(FRAMES) } else { options.steps }
}

fn one(sweep: &Sweep, options: &Options, level: f64) -> anyhow::Result<usize> {
    let count = steps_of(sweep, options);
    let made = options.only.start..options.only.end.min(count);
    anyhow::ensure!(made.len() > 3, "{}: four steps at least", sweep.name);
    let mut steps: Vec<Step> = Vec::with_capacity(made.len());
    for k in made.clone() {
        let value = sweep.value(k, count);
        let size = if sweep.name == SIZE { value.round() as u32 } else { options.size };
        // Seeds: each step has its own pictures of few seeds.
        let first = if sweep.name == SEED { options.pictures * value.round() as u32 } else { 0 };
        steps.push(pictures(&(sweep.scene)(value, size), first, options)?);
    }
    let at = |k: usize| sweep.value(made.start + k, count);
    let n = options.pictures as usize;
    let noises: Vec<Measured> = steps.windows(2).map(|pair| jump(&pair[0].ratios, &pair[1].ratios)).collect();
    let means: Vec<Measured> = if sweep.name == SEED {
        Vec::new()
    } else {
        let four = |w: &[Step]| {
            let all = [&w[0], &w[1], &w[2], &w[3]];
            jump_of_mean(all.map(|step| &step.ours), all.map(|step| &step.plain))
        };
        steps.windows(4).map(four).collect()
    };
    let all: Vec<f64> = steps.iter().map(|step| step.ratios[n].exp()).collect();
    let (least, most) = all.iter().fold((f64::INFINITY, 0f64), |(least, most), &x| (least.min(x), most.max(x)));
    let worst = |list: &[Measured], limit: f64| {
        let chance = |k: &usize| list[*k].chance(limit, n);
        let size = |k: &usize| list[*k].value.abs();
        (0..list.len()).min_by(|a, b| chance(a).total_cmp(&chance(b)).then(size(b).total_cmp(&size(a))))
    };
    let noise = worst(&noises, LARGEST.ln());
    let mean = worst(&means, OF_MEAN);
    let of_noise = noise.map_or(String::new(), |k| {
        let d = noises[k];
        format!("{:.2} +- {:.2}", d.value.abs().exp(), d.value.abs().exp() * d.error)
    });
    let of_mean = mean.map_or(String::new(), |k| format!("{:.3} +- {:.3}", 1.0 + means[k].value.abs(), means[k].error));
    let place = |k: Option<usize>, offset: usize| k.map_or(String::new(), |k| format!("{:.4}", at(k + offset)));
    println!(
        "{:20} {:>13} {of_noise:>16} {:>9} {of_mean:>16} {:>9}",
        sweep.name,
        format!("{least:.3}..{most:.3}"),
        place(noise, 0),
        place(mean, 1)
    );
    let mut findings = noises.iter().filter(|d| d.chance(LARGEST.ln(), n) < level).count();
    findings += means.iter().filter(|d| d.chance(OF_MEAN, n) < level).count();
    if sweep.film {
        let pair = |w: &[Step]| flicker([&w[0].ours, &w[1].ours], [&w[0].plain, &w[1].plain]);
        let frames: Vec<Measured> = steps.windows(2).map(pair).collect();
        let most = frames.iter().map(|d| d.value).fold(f64::NEG_INFINITY, f64::max);
        println!("{:20} differences between frames over the plain path tracer's: at most {:.3}", "", most.exp());
        // Only more of it is a fault.
        findings += frames.iter().filter(|d| d.value > 0.0 && d.chance(0.0, n) < level).count();
    }
    Ok(findings)
}

fn pictures(text: &str, first: u32, options: &Options) -> anyhow::Result<Step> {
    let scenes = [compiled(text)?];
    let of = |plain: bool| -> Pictures {
        let source = Source { scenes: &scenes, plain, samples: options.samples, threads: 1, flip: false };
        (first..first + options.pictures).map(|seed| grey_pixels(&source, seed)).collect()
    };
    let (ours, plain) = (of(false), of(true));
    let below = ours.iter().flatten().filter(|&&x| x < 0.0).count();
    anyhow::ensure!(below == 0, "{below} pixels below zero in\n{text}");
    let ratios = ratios(&ours, &plain);
    Ok(Step { ours, ratios, plain })
}

fn grey_pixels(source: &Source<'_>, seed: u32) -> Vec<f64> {
    let film = source.films(seed).remove(0);
    let [width, height] = film.size();
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| grey(film.radiance(x, y))).collect()
}
