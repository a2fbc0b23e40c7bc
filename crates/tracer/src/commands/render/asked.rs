//! What a rendering is asked for: all that is known, and has to be right, before the scene is compiled.

use super::frames::{AtEnd, Frames};
use super::kept::Places;
use super::outputs::{self, Output};
use super::{check_memory, crop, described, parts};
use crate::args::RenderArgs;
use crate::cache::Cache;
use crate::checkpoint::{Lock, Place};
use crate::denoising::Denoiser;
use crate::failure::Failure;
use crate::lanes;
use crate::loading::asset_files;
use crate::shell::Shell;
use scene_format::SceneDesc;
use std::path::PathBuf;
use tracer_core::{Crop, Level, Part};

/// A rendering as the command line and the scene ask for it.
pub(super) struct Asked<'a> {
    /// With the names that nobody has written.
    pub args: RenderArgs,
    pub shell: &'a Shell,
    /// What frames have in common, where it is one of them.
    pub frames: Option<&'a Frames>,
    pub cache: Option<&'a Cache>,
    pub desc: AtEnd<SceneDesc>,
    /// The pixels to render.
    pub crop: Crop,
    pub part: Option<Part>,
    /// Where the part goes, if it is one.
    pub part_file: Option<Place>,
    /// Keeps others off it.
    _part_lock: Option<Lock>,
    pub outputs: Vec<Output>,
    pub level: Level,
    pub denoiser: Option<Denoiser>,
}

impl<'a> Asked<'a> {
    /// Reads the scene and sees that all can be done; with it the places of checkpoints, which are locked.
    ///
    /// # Errors
    /// What is wrong with options or scene, or would be replaced.
    pub fn new(
        args: &RenderArgs,
        shell: &'a Shell,
        (frames, cache): (Option<&'a Frames>, Option<&'a Cache>),
    ) -> Result<(Self, Places), Failure> {
        let args = outputs::named(args)?;
        let part_file = args.part.map(|_| parts::place(&args)).transpose()?;
        let outputs = if part_file.is_some() { Vec::new() } else { outputs::outputs(&args)? };
        let level = lanes::from_environment()?;
        outputs::probe(&outputs, args.report.as_deref())?;
        // A part is denoised by whoever merges it.
        let denoiser = if part_file.is_some() { None } else { Denoiser::ready(args.denoise.how())? };
        let places = Places::new(&args, shell)?;
        let desc = AtEnd::new(described(&args, shell)?, frames);
        frames.map_or(Ok(()), |frames| frames.is_as_before(&desc))?;
        let crop = crop(&args, &desc)?;
        let part = parts::part(&args, &desc, crop)?;
        let part_lock = match (&part_file, &part) {
            (Some(file), Some(part)) if !places.writes(file) => {
                let lock = file.lock()?;
                parts::spare_other(file, part, &desc)?;
                Some(lock)
            }
            _ => None,
        };
        let crop = part.map_or(crop, |part| part.crop);
        check_memory(crop, &desc, args.denoise.how())?;
        let asked = Asked {
            args,
            shell,
            frames,
            cache,
            desc,
            crop,
            part,
            part_file,
            _part_lock: part_lock,
            outputs,
            level,
            denoiser,
        };
        if part.is_none() && asked.args.show.is_none() && frames.is_none() {
            outputs::tell_of_layers(&asked.outputs, &asked.args, &asked.desc, shell);
        }
        asked.spare_named()?;
        Ok((asked, places))
    }

    /// Sees that nothing that is written would replace what the scene names.
    ///
    /// # Errors
    /// The first place that would.
    fn spare_named(&self) -> Result<(), Failure> {
        let Asked { args, desc, .. } = self;
        let named: Vec<PathBuf> = asset_files(desc).into_iter().map(|file| desc.base_dir.join(file)).collect();
        outputs::spare_inputs(&self.outputs, args, &named)?;
        if self.frames.is_some() {
            return Ok(());
        }
        let written: Vec<_> = outputs::written(args).map(|(option, path)| (option, path.to_owned())).collect();
        outputs::spare_mentioned(&written, desc)
    }
}
