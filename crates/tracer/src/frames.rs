//! All frames of an animation, looked at before any is rendered.

use crate::args::{DiagnosticsForm, SceneArgs};
use crate::failure::Failure;
use crate::loading::{is_dash, use_threads};
use crate::shell::{Shell, counted};
use scene_format::{LoadError, Loaded, Override, SceneDesc, Syntax};
use std::path::Path;
use tracer_core::{LookedAt, Looking, check_frames};

/// No more frames than this are looked at.
const MOST: usize = 1000;

/// What there is to say of frames that are right.
#[derive(Default)]
pub struct Told {
    /// How many there are; `None` where nothing can move.
    pub count: Option<String>,
    /// Warnings that only other frames have than the one that is seen; they have been told.
    pub warnings: usize,
}

/// Looks at each frame from the first to the last one, or at all; what is wrong with one is told with its number, and
/// once for all frames. Of all frames warnings are told, too; of some they are told by who renders these.
///
/// # Errors
/// A frame is wrong, which has been told.
pub fn told(args: &SceneArgs, desc: &SceneDesc, range: Option<(u32, u32)>, shell: &Shell) -> Result<Told, Failure> {
    use_threads(None)?;
    let (first, last) = range.unwrap_or((0, desc.animation.frames.value - 1));
    // Standard input is there once.
    if is_dash(&args.scene) {
        return Ok(Told::default());
    }
    let load =
        |frame: u32| load(args, if range.is_some() { Override::of_frames(frame) } else { Override::frame(frame) });
    let looking = Looking { first, last, most: MOST, warnings: range.is_none() };
    let Some(LookedAt { all, looked, wrong, warned }) = check_frames(desc, looking, load) else {
        return Ok(Told::default());
    };
    for frame in &warned {
        shell.diagnostics(&frame.diagnostics, &frame.sources, args.diagnostics);
    }
    for frame in &wrong {
        shell.diagnostics(&frame.diagnostics, &frame.sources, args.diagnostics);
    }
    if !wrong.is_empty() {
        if args.diagnostics == DiagnosticsForm::Text && looked > 1 {
            let of = if looked < all { format!("{looked} frames that were looked at") } else { counted(all, "frame") };
            let (wrong, are) = (wrong.len(), if wrong.len() == 1 { "is" } else { "are" });
            shell.error(&anyhow::anyhow!("{wrong} of {of} {are} wrong"));
        }
        return Err(Failure::WrongScene);
    }
    let looked_at = if looked < all { format!(" ({looked} looked at)") } else { String::new() };
    let warnings = warned.iter().map(|frame| shell.count(&frame.diagnostics)).sum();
    Ok(Told { count: Some(format!("{}{looked_at}", counted(all, "frame"))), warnings })
}

fn load(args: &SceneArgs, frame: Override) -> Result<Loaded, LoadError> {
    let mut overrides = SceneArgs { frame: None, ..args.clone() }.overrides();
    overrides.push(frame);
    let Some(syntax) = args.syntax.map(Syntax::from) else {
        return scene_format::load_with(&args.scene, &overrides);
    };
    let io = |source| LoadError::Io { path: args.scene.clone(), source };
    let bytes = std::fs::read(&args.scene).map_err(io)?;
    let folder = args.scene.parent().unwrap_or(Path::new(""));
    scene_format::load_bytes(&args.scene.display().to_string(), bytes, Some(syntax), folder, &overrides)
}
