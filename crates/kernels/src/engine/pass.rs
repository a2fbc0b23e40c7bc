//! What the stages are told of a pass.

use super::guide::Guide;
use super::guide::plan::Plan;
use super::light_paths::LightPaths;
use crate::layers::LayerSet;

/// What paths are traced for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Task {
    /// The picture.
    Picture,
    /// Direct light: a path that a rough surface has scattered sees lights and the background, no more.
    Direct,
    /// Glint chains: they end at all but mirrors and glass (`techniques::glints`).
    Chains,
}

/// What is the same for all batches of a pass.
#[derive(Clone, Copy)]
pub struct Pass<'a> {
    /// Seed of all random choices.
    pub seed: u32,
    /// Pixels share what they find ([`super::stages::share`]).
    pub reuse: bool,
    /// Lanes of the kernels; for the statistics.
    pub lanes: usize,
    /// What rays are aimed at, where the scene has lights and casters.
    pub guide: Option<&'a Guide>,
    /// What lights send to the camera over mirrors and glass, where light paths are at work.
    pub light_paths: Option<(&'a LightPaths, &'a Plan)>,
    /// What for.
    pub task: Task,
    /// What is kept of the first hits of the picture's camera rays.
    pub layers: LayerSet,
    /// What is seen of lamps, straight, over mirrors and glass or in what nearly is a mirror, is told apart.
    pub lamps: bool,
}

impl Pass<'_> {
    /// That of plain paths.
    pub fn plain(seed: u32, lanes: usize) -> Self {
        Pass {
            seed,
            reuse: false,
            lanes,
            guide: None,
            light_paths: None,
            task: Task::Picture,
            layers: LayerSet::default(),
            lamps: false,
        }
    }
}

/// What the photons of a batch have in common.
#[derive(Clone, Copy)]
pub struct PhotonPass<'a> {
    /// Seed of all random choices.
    pub seed: u32,
    /// Photons in the batch.
    pub count: usize,
    /// They are light paths, that go on to the camera.
    pub light_paths: Option<&'a LightPaths>,
}
