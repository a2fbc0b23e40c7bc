//! `tracer bench-figures`: the nine figures of the report at its own settings, by the plain path tracer as there; its
//! times beside ours. The scenes themselves ask for the engine at its best.

use crate::args::{BenchFiguresArgs, SceneArgs};
use crate::failure::{Failure, exit};
use crate::interrupt;
use crate::lanes;
use crate::loading::{Known, compile, load, use_threads};
use crate::progress::Watch;
use crate::shell::Shell;
use scene_format::desc::Integrator;
use std::io::Write;
use std::process::ExitCode;
use std::time::Instant;
use tracer_core::{RenderOptions, develop, render};

/// A figure as the report's caption has it.
struct Figure {
    number: u8,
    /// Pixels of a side.
    size: u32,
    samples: u32,
    bounces: u32,
    /// The time printed there, on 4 cores with 8 threads.
    report: &'static str,
}

const FIGURES: [Figure; 9] = [
    Figure { number: 1, size: 512, samples: 100, bounces: 5, report: "807 s" },
    Figure { number: 2, size: 512, samples: 100, bounces: 10, report: "764 s" },
    Figure { number: 3, size: 256, samples: 10, bounces: 5, report: "7 s (with a tree)" },
    Figure { number: 4, size: 512, samples: 1000, bounces: 5, report: "1855 s" },
    Figure { number: 5, size: 512, samples: 100, bounces: 10, report: "1766 s" },
    Figure { number: 6, size: 512, samples: 100, bounces: 5, report: "232 s" },
    Figure { number: 7, size: 512, samples: 100, bounces: 5, report: "226 s" },
    Figure { number: 8, size: 256, samples: 200, bounces: 5, report: "83-93 s" },
    Figure { number: 9, size: 256, samples: 200, bounces: 5, report: "83-93 s" },
];

pub(super) fn run(args: &BenchFiguresArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    use_threads(args.threads)?;
    interrupt::listen(*shell)?;
    let wanted = |figure: &&Figure| args.figures.is_empty() || args.figures.contains(&figure.number);
    let scene = |figure: &Figure| args.scenes.join(format!("fig{}.ron", figure.number));
    if let Some(missing) = FIGURES.iter().filter(wanted).map(scene).find(|scene| !scene.exists()) {
        return Err(Failure::wrong(format!(
            "there is no {}: the scenes of the report's figures are in the folder scenes of tracer's sources; run it \
             there, or name that folder by --scenes",
            missing.display()
        )));
    }
    let mut out = std::io::stdout().lock();
    writeln!(out, "{:<7} {:<34} {:>9}  the report (4 cores)", "figure", "plain path tracer", "here")?;
    for figure in FIGURES.iter().filter(wanted) {
        let samples = args.samples.map_or(figure.samples, |most| most.min(figure.samples));
        let Some(seconds) = timed(figure, samples, args, shell)? else {
            return Ok(ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED)));
        };
        let Figure { number, size, bounces, .. } = figure;
        let setting = format!("{size}x{size}, {samples} samples, {bounces} bounces");
        // The report's time is one of its own number of samples.
        let report = if samples == figure.samples { figure.report } else { "-" };
        writeln!(out, "{number:<7} {setting:<34} {seconds:>7.2} s  {report}")?;
        out.flush()?;
    }
    Ok(ExitCode::from(exit::DONE))
}

/// Seconds from the scene file to the developed picture; `None`: it was interrupted.
fn timed(figure: &Figure, samples: u32, args: &BenchFiguresArgs, shell: &Shell) -> Result<Option<f64>, Failure> {
    let start = Instant::now();
    let scene = SceneArgs::plain(args.scenes.join(format!("fig{}.ron", figure.number)));
    let mut desc = load(&scene, shell)?;
    desc.image.width = figure.size.into();
    desc.image.height = figure.size.into();
    desc.render.samples = samples.into();
    desc.render.max_bounces = figure.bounces.into();
    desc.render.integrator = Integrator::Path;
    // What the formula of the report's Blinn-Phong brings is known here.
    let scene = compile(&desc, scene.diagnostics, Known::Nothing, &shell.without_warnings())?;
    let watch = Watch::new(shell, u64::from(figure.size * figure.size) * u64::from(samples));
    let options = RenderOptions {
        threads: args.threads.map_or(0, usize::from),
        level: Some(lanes::from_environment()?),
        ..RenderOptions::default()
    };
    let film = render(&scene, &options, &watch);
    let image = develop(&film, &scene.look);
    let seconds = start.elapsed().as_secs_f64();
    watch.finish();
    let whole = *film.samples().start() == samples && !image.display.is_empty();
    Ok(whole.then_some(seconds))
}
