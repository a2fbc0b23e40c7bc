//! `tracer bench-acceleration`: a scene rendered without boxes, with one box per mesh, and with a tree of boxes. Figure
//! 3 of the report is this table; its times stand beside ours.

use crate::args::BenchAccelerationArgs;
use crate::failure::{Failure, exit};
use crate::interrupt;
use crate::lanes;
use crate::loading::{Known, compile, load, use_threads};
use crate::progress::Watch;
use crate::shell::Shell;
use crate::write::{Bits, Encoding, Provenance, encode, sha256};
use scene_format::desc::{Acceleration, Integrator};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;
use tracer_core::{RenderOptions, develop, render};

/// A way of finding hits, and the report's time for figure 3 (256x256, 10 rays, 5 bounces, 4 cores).
struct Way {
    acceleration: Acceleration,
    name: &'static str,
    report: &'static str,
}

/// Samples of figure 3 in the report; the scene's own may be more.
const REPORT_SAMPLES: u32 = 10;

const WAYS: [Way; 3] = [
    Way { acceleration: Acceleration::None, name: "None", report: "167 s" },
    Way { acceleration: Acceleration::BoundingBox, name: "BoundingBox", report: "40 s" },
    Way { acceleration: Acceleration::Bvh, name: "Bvh", report: "7 s" },
];

pub(super) fn run(args: &BenchAccelerationArgs, shell: &Shell) -> Result<ExitCode, Failure> {
    let level = lanes::from_environment()?;
    use_threads(args.threads)?;
    let mut desc = load(&args.scene, shell)?;
    if let Some(size) = args.size {
        desc.image.width = size.width.into();
        desc.image.height = size.height.into();
    }
    if let Some(samples) = args.samples {
        desc.render.samples = samples.into();
    }
    interrupt::listen(*shell)?;
    // The plain path tracer: what the table times are its rays.
    desc.render.integrator = Integrator::Path;
    // The report's times belong to figure 3 as it is there.
    let is_figure = Path::new(&args.scene.scene).file_stem().is_some_and(|stem| stem == "fig3")
        && args.size.is_none()
        && args.samples.is_none()
        && args.scene.sets().is_empty();
    if is_figure {
        desc.render.samples = desc.render.samples.value.min(REPORT_SAMPLES).into();
    }
    let mut out = std::io::stdout().lock();
    let header = if is_figure { "  the report (4 cores)" } else { "" };
    writeln!(out, "{:<12} {:>10} {:>10}{header}", "acceleration", "build", "render")?;
    let mut hashes = Vec::new();
    for way in &WAYS {
        desc.render.acceleration = way.acceleration;
        let scene = compile(&desc, args.scene.diagnostics, Known::Nothing, shell)?;
        let pixels = u64::from(scene.size[0]) * u64::from(scene.size[1]);
        let watch = Watch::new(shell, pixels * u64::from(scene.samples));
        let options = RenderOptions {
            threads: args.threads.map_or(0, usize::from),
            level: Some(level),
            ..RenderOptions::default()
        };
        let start = Instant::now();
        let film = render(&scene, &options, &watch);
        let seconds = start.elapsed().as_secs_f64();
        watch.finish();
        if *film.samples().start() < scene.samples {
            return Ok(ExitCode::from(interrupt::requested().unwrap_or(exit::INTERRUPTED)));
        }
        let image = develop(&film, &scene.look);
        hashes.push(sha256(&encode(&image, Encoding::Png(Bits::Sixteen), &Provenance::default())?));
        let report = if is_figure { format!("  {:>20}", way.report) } else { String::new() };
        writeln!(out, "{:<12} {:>8.3} s {:>8.3} s{report}", way.name, scene.times.tree, seconds)?;
        out.flush()?;
    }
    if hashes.iter().any(|hash| *hash != hashes[0]) {
        return Err(Failure::could_not(
            "the pictures are not the same, which is a fault of this program; please report it",
        ));
    }
    writeln!(out, "the same picture in all three, byte for byte")?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}
