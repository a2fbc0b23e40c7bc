//! All frames of an animation, looked at before any is rendered.

use crate::args::{DiagnosticsForm, SceneArgs};
use crate::failure::Failure;
use crate::loading::{is_dash, with_faults_of_files};
use crate::shell::{Shell, counted};
use scene_format::diagnostic::Severity;
use scene_format::{LoadError, Override, SceneDesc, Syntax};
use std::collections::HashSet;
use std::path::Path;

/// So many bytes of text are read for all frames together; of longer films fewer frames are looked at.
const MOST_BYTES: usize = 256 << 20;
/// No more frames than this.
const MOST: usize = 1000;

/// Looks at the text of each frame from the first to the last one, or of all; what is wrong with one is told with its
/// number, and once for all frames. Gives a word on how many there are; `None` where nothing can move.
///
/// # Errors
/// A frame is wrong, which has been told.
pub fn told(
    args: &SceneArgs,
    desc: &SceneDesc,
    range: Option<(u32, u32)>,
    shell: &Shell,
) -> Result<Option<String>, Failure> {
    let frames = desc.animation.frames.value;
    let (first, last) = range.unwrap_or((0, frames - 1));
    let moves = desc.sources.iter().any(|source| source.text.contains("frame") || source.text.contains("time"));
    // Standard input is there once.
    if last < frames && (frames == 1 || !moves) || is_dash(&args.scene) {
        return Ok(None);
    }
    let bytes: usize = desc.sources.iter().map(|source| source.text.len()).sum();
    let all = (last - first) as usize + 1;
    let looked = all.min((MOST_BYTES / bytes.max(1)).clamp(2, MOST));
    let mut known = HashSet::new();
    let mut wrong = 0;
    for k in 0..looked {
        // The first, the last, and as far apart as may be between.
        let frame = first + (k as u64 * u64::from(last - first) / (looked as u64 - 1).max(1)) as u32;
        let Err(error) = load(args, frame) else { continue };
        let folder = args.scene.parent().unwrap_or(Path::new(""));
        let LoadError::Invalid { mut diagnostics, sources, .. } = with_faults_of_files(error, folder) else { continue };
        diagnostics.retain(|fault| fault.severity == Severity::Error && known.insert((fault.span, fault.code)));
        diagnostics.iter_mut().for_each(|fault| fault.message += &format!(" (frame {frame})"));
        wrong += 1;
        shell.diagnostics(&diagnostics, &sources, args.diagnostics);
    }
    if wrong > 0 {
        if args.diagnostics == DiagnosticsForm::Text && looked > 1 {
            let of = if looked < all { format!("{looked} frames that were looked at") } else { counted(all, "frame") };
            shell.error(&anyhow::anyhow!("{wrong} of {of} {} wrong", if wrong == 1 { "is" } else { "are" }));
        }
        return Err(Failure::WrongScene);
    }
    let looked_at = if looked < all { format!(" ({looked} looked at)") } else { String::new() };
    Ok(Some(format!("{}{looked_at}", counted(all, "frame"))))
}

fn load(args: &SceneArgs, frame: u32) -> Result<(), LoadError> {
    let mut overrides = SceneArgs { frame: None, ..args.clone() }.overrides();
    overrides.push(Override::frame(frame));
    let Some(syntax) = args.syntax.map(Syntax::from) else {
        return scene_format::load_with(&args.scene, &overrides).map(|_| ());
    };
    let io = |source| LoadError::Io { path: args.scene.clone(), source };
    let bytes = std::fs::read(&args.scene).map_err(io)?;
    let folder = args.scene.parent().unwrap_or(Path::new(""));
    scene_format::load_bytes(&args.scene.display().to_string(), bytes, Some(syntax), folder, &overrides).map(|_| ())
}
