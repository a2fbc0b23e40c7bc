//! A rendering that can begin: its scene is compiled, and what there is of its film is read.

use super::asked::Asked;
use super::frames::AtEnd;
use super::kept::{self, Kept, Places};
use super::{goals, outputs};
use crate::checkpoint::{Extent, Hashing};
use crate::denoising;
use crate::failure::Failure;
use crate::loading::{Known, compile};
use tracer_core::{LayerSet, Scene};

/// What a rendering begins with.
pub(super) struct Ready {
    pub scene: AtEnd<Scene>,
    pub kept: Kept,
    /// Of the scene's files, where somebody wants it.
    pub hashing: Option<Hashing>,
    /// Layers of the picture: not the one that a backdrop needs, unless it is asked for.
    pub written_layers: LayerSet,
    /// A part that is kept under its own name needs no second file.
    pub is_kept: bool,
}

impl Ready {
    /// Compiles the scene, and reads what there is of the film.
    ///
    /// # Errors
    /// What is wrong with the scene's files, does not go together, or would be replaced.
    pub fn new(asked: &mut Asked<'_>, places: Places) -> Result<Self, Failure> {
        let Asked { args, shell, frames, cache, desc, outputs, .. } = asked;
        let (frames, cache) = (*frames, *cache);
        let known = match (frames, cache) {
            (Some(frames), _) => Known::Kept(&frames.kept),
            (None, Some(cache)) => Known::Cached(cache),
            (None, None) => Known::Nothing,
        };
        let mut scene = AtEnd::new(compile(desc, args.scene.diagnostics, known, shell)?, frames);
        let written_layers = tracer_core::layer_set(&desc.output.layers);
        goals::is_of_moments(args.plan, &scene)?;
        denoising::prepare(&mut scene, args.denoise.is_on())?;
        // Only now it is known what the meshes' own materials name.
        outputs::spare_inputs(outputs, args, &scene.files)?;
        outputs::spare_others(outputs, args.report.as_deref())?;
        let is_kept = asked.part_file.as_ref().is_some_and(|file| places.writes(file));
        let kept = places.open(args, desc, &scene, Extent::Film(asked.crop, asked.part), shell)?;
        let hashing = kept::hashing(args, &kept.notes, &scene, desc, (frames, cache));
        Ok(Ready { scene, kept, hashing, written_layers, is_kept })
    }
}
