//! Checks a scene file and shows what is wrong: `cargo run -p scene-format --example check -- scene.ron camera.fov=40`.

use scene_format::{LoadError, Override, load_with, render};
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let mut arguments = std::env::args().skip(1);
    let Some(path) = arguments.next() else {
        eprintln!("usage: check SCENE [path=value ..]");
        return ExitCode::from(2);
    };
    let overrides: Vec<Override> = arguments.map(Override::from).collect();
    match load_with(Path::new(&path), &overrides) {
        Ok(loaded) => {
            eprint!("{}", render::text(&loaded.warnings, &loaded.scene.sources, render::Style::default()));
            println!("{} objects, {} lights", loaded.scene.objects.len(), loaded.scene.lights.len());
            ExitCode::SUCCESS
        }
        Err(LoadError::Invalid { diagnostics, sources, .. }) => {
            eprint!("{}", render::text(&diagnostics, &sources, render::Style::default()));
            ExitCode::from(2)
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
