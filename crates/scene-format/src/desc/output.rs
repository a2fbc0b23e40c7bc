//! What is written beside the picture.

use crate::words::{scene_struct, scene_words};

scene_struct! {
    /// What is written beside the picture.
    pub struct Output as "Output", "the output" {
        /// Layers that EXR files get beside the picture: what camera rays hit first. The picture is the same with and without them.
        layers: Vec<Layer> = Vec::new();
    }
}

scene_words! {
    /// A layer of the picture: what camera rays hit first, averaged over a pixel's samples as the picture is. Not developed: exposure
    /// and tone map are the picture's.
    pub enum Layer, "layer" {
        /// The surface's colour as it is without light, from textures too: the albedo, of mirrors the reflectance, of glass the
        /// transmittance. Black where nothing is hit and where lamps are.
        Albedo,
        /// The unit shading normal in the scene's axes, on the viewer's side. Zero where nothing is hit, so that it is shorter than one
        /// at edges.
        Normal,
        /// The distance from the eye along the view axis, as `focus_distance` is measured: the mean over the samples that hit something,
        /// infinite where none does.
        Depth,
    }
}

// The macro's structs derive no default of their own.
#[allow(clippy::derivable_impls)]
impl Default for Output {
    fn default() -> Self {
        Output { layers: Vec::new() }
    }
}
