//! The frames of an animation, looked at before any is rendered.

use super::assets::Sources;
use super::{Kept, check_files, gather, warn};
use scene_format::diagnostic::{Source, keep_first};
use scene_format::{Diagnostics, LoadError, Loaded, SceneDesc, Severity};
use std::collections::BTreeSet;

/// So many bytes of text are read for all frames together; of longer films fewer frames are looked at.
const MOST_BYTES: usize = 256 << 20;

/// A frame of which something is to be told.
#[derive(Debug)]
pub struct ToldFrame {
    /// Its number.
    pub frame: u32,
    /// What is found in it and was not in an earlier one; each tells the number.
    pub diagnostics: Diagnostics,
    /// The texts that these point into.
    pub sources: Vec<Source>,
}

/// What looking at frames has found.
#[derive(Debug)]
pub struct LookedAt {
    /// How many were to be looked at.
    pub all: usize,
    /// How many were: of long films not all.
    pub looked: usize,
    /// Those that are wrong.
    pub wrong: Vec<ToldFrame>,
    /// Warnings of frames that are not wrong, beside those of the frame that is seen; where they were asked for.
    pub warned: Vec<ToldFrame>,
}

/// Which frames are looked at, and what for.
#[derive(Clone, Copy, Debug)]
pub struct Looking {
    /// From this one.
    pub first: u32,
    /// To this one.
    pub last: u32,
    /// No more than this, as far apart as may be.
    pub most: usize,
    /// Whether warnings are told, too.
    pub warnings: bool,
}

/// Looks at frames: their texts, the files that they name, and all else that compiling may find but the tree. `load`
/// reads the scene at a frame. `None` where nothing moves, so that all frames are as `desc`, which is one of them.
pub fn check_frames(
    desc: &SceneDesc,
    looking: Looking,
    load: impl Fn(u32) -> Result<Loaded, LoadError>,
) -> Option<LookedAt> {
    let Looking { first, last, most, warnings } = looking;
    let frames = desc.animation.frames.value;
    let moves = desc.sources.iter().any(|source| source.text.contains("frame") || source.text.contains("time"));
    if last < frames && (frames == 1 || !moves) {
        return None;
    }
    let bytes: usize = desc.sources.iter().map(|source| source.text.len()).sum();
    let all = (last - first) as usize + 1;
    let looked = all.min((MOST_BYTES / bytes.max(1)).clamp(2, most.max(2)));
    let kept = Kept::default();
    let found = |frame: u32| found(desc, load(frame), warnings, &kept);
    // What is told of the frame that is seen is told by who compiles it.
    let seen = desc.animation.frame.value;
    let mut of_seen = warnings.then(|| found(seen));
    let mut known = BTreeSet::new();
    if let Some(Some((diagnostics, _))) = &of_seen {
        let warnings = diagnostics.iter().filter(|fault| fault.severity == Severity::Warning);
        known.extend(warnings.map(|fault| (fault.span, fault.code)));
    }
    let (mut wrong, mut warned) = (Vec::new(), Vec::new());
    for k in 0..looked {
        let frame = first + (k as u64 * u64::from(last - first) / (looked as u64 - 1).max(1)) as u32;
        let of_frame = if frame == seen { of_seen.take().unwrap_or_else(|| found(frame)) } else { found(frame) };
        let Some((mut diagnostics, sources)) = of_frame else { continue };
        let is_wrong = diagnostics.iter().any(|fault| fault.severity == Severity::Error);
        diagnostics
            .retain(|fault| (fault.severity == Severity::Error) == is_wrong && known.insert((fault.span, fault.code)));
        diagnostics.iter_mut().for_each(|fault| fault.message += &format!(" (frame {frame})"));
        if is_wrong {
            wrong.push(ToldFrame { frame, diagnostics, sources });
        } else if !diagnostics.is_empty() {
            warned.push(ToldFrame { frame, diagnostics, sources });
        }
    }
    Some(LookedAt { all, looked, wrong, warned })
}

/// What is found in a frame, and the texts; `None`: nothing. Warnings of a frame that is not wrong where they are asked
/// for.
fn found(
    desc: &SceneDesc,
    loaded: Result<Loaded, LoadError>,
    warnings: bool,
    kept: &Kept,
) -> Option<(Diagnostics, Vec<Source>)> {
    match loaded {
        Ok(Loaded { scene, warnings: mut diagnostics }) => {
            let gathered = gather(&scene, &Sources::keeping(kept));
            kept.sweep();
            match gathered {
                Err(error) => diagnostics = error.diagnostics,
                Ok(mut gathered) if warnings => {
                    warn(&scene, &mut gathered);
                    diagnostics.append(&mut gathered.diagnostics);
                }
                Ok(_) => return None,
            }
            Some((diagnostics, scene.sources))
        }
        Err(LoadError::Invalid { mut diagnostics, sources, files, .. }) => {
            diagnostics.extend(check_files(&files, &desc.base_dir, &sources));
            diagnostics.sort_by_key(|fault| fault.span);
            keep_first(&mut diagnostics);
            Some((diagnostics, sources))
        }
        // It was there a moment ago: who reads it again tells.
        Err(LoadError::Io { .. }) => None,
    }
}
