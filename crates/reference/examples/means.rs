//! The mean of a scene's picture by the reference tracer, and its standard error: a third opinion where two renderers
//! differ.
//!
//! `cargo run --release -p tracer-reference --example means -- SCENE SAMPLES [SEED]` prints one line: mean and error of
//! red, green and blue.
#![forbid(unsafe_code)]

use std::process::ExitCode;
use tracer_reference::{Smoothing, render};

fn main() -> ExitCode {
    match run(&std::env::args().skip(1).collect::<Vec<_>>()) {
        Ok(line) => {
            println!("{line}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &[String]) -> Result<String, String> {
    let [file, samples, seed @ ..] = arguments else {
        return Err("expected SCENE SAMPLES [SEED]".to_owned());
    };
    let samples: u32 = samples.parse().map_err(|e| format!("samples: {e}"))?;
    if samples < 2 {
        return Err("samples: at least two, or there is no error to tell".to_owned());
    }
    let seed: u64 = seed.first().map_or(Ok(1), |s| s.parse()).map_err(|e| format!("seed: {e}"))?;
    let loaded = scene_format::load(std::path::Path::new(file)).map_err(|e| e.to_string())?;
    let scene = tracer_core::compile(&loaded.scene).map_err(|e| e.to_string())?;
    let picture = render(&scene, samples, seed, Smoothing::Hanika);
    let pixels = picture.mean.len() as f64;
    let mean = picture.mean.iter().sum::<glam::DVec3>() / pixels;
    // Pixels are independent, so their variances add up.
    let variance = picture.variance.iter().sum::<glam::DVec3>() / (pixels * pixels);
    let words = [0, 1, 2].map(|k| format!("{:.7} +- {:.7}", mean[k], variance[k].sqrt()));
    Ok(words.join("  "))
}
