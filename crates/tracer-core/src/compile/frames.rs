//! The frames of an animation, looked at before any is rendered.

use super::assets::Sources;
use super::{Kept, check_files, gather};
use scene_format::diagnostic::{Source, keep_first};
use scene_format::{Diagnostics, LoadError, Loaded, SceneDesc, Severity};
use std::collections::BTreeSet;

/// So many bytes of text are read for all frames together; of longer films fewer frames are looked at.
const MOST_BYTES: usize = 256 << 20;

/// A frame that is wrong.
#[derive(Debug)]
pub struct WrongFrame {
    /// Its number.
    pub frame: u32,
    /// What is wrong with it and was not so with an earlier one; each fault tells the number.
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
    pub wrong: Vec<WrongFrame>,
}

/// Looks at the frames from the first to the last one, at no more than `most` of them, as far apart as may be: their
/// texts, the files that they name, and all else that compiling may find but the tree. `load` reads the scene at a
/// frame. `None` where nothing moves, so that all frames are as `desc`, which is one of them.
pub fn check_frames(
    desc: &SceneDesc,
    [first, last]: [u32; 2],
    most: usize,
    load: impl Fn(u32) -> Result<Loaded, LoadError>,
) -> Option<LookedAt> {
    let frames = desc.animation.frames.value;
    let moves = desc.sources.iter().any(|source| source.text.contains("frame") || source.text.contains("time"));
    if last < frames && (frames == 1 || !moves) {
        return None;
    }
    let bytes: usize = desc.sources.iter().map(|source| source.text.len()).sum();
    let all = (last - first) as usize + 1;
    let looked = all.min((MOST_BYTES / bytes.max(1)).clamp(2, most.max(2)));
    let (kept, mut known, mut wrong) = (Kept::default(), BTreeSet::new(), Vec::new());
    for k in 0..looked {
        let frame = first + (k as u64 * u64::from(last - first) / (looked as u64 - 1).max(1)) as u32;
        let Some((mut diagnostics, sources)) = faults(desc, load(frame), &kept) else { continue };
        diagnostics.retain(|fault| fault.severity == Severity::Error && known.insert((fault.span, fault.code)));
        diagnostics.iter_mut().for_each(|fault| fault.message += &format!(" (frame {frame})"));
        wrong.push(WrongFrame { frame, diagnostics, sources });
    }
    Some(LookedAt { all, looked, wrong })
}

/// What is wrong with a frame, and the texts; `None`: nothing.
fn faults(desc: &SceneDesc, loaded: Result<Loaded, LoadError>, kept: &Kept) -> Option<(Diagnostics, Vec<Source>)> {
    match loaded {
        Ok(Loaded { scene, .. }) => {
            let found = gather(&scene, &Sources::keeping(kept));
            kept.sweep();
            found.err().map(|error| (error.diagnostics, scene.sources))
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
