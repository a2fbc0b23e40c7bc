//! What a caller may decide about a rendering.

use crate::film::{Crop, MattesKept, Part, Plan};
use std::time::{Duration, Instant};
use tracer_kernels::layers::LayerSet;
use tracer_kernels::level::Level;

/// What a caller may decide about a rendering; `None` and zero take what the scene says.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RenderOptions {
    /// Samples per pixel.
    pub samples: Option<u32>,
    /// Seed of all random choices.
    pub seed: Option<u32>,
    /// The part of the picture to render; the same bytes as that part of the whole.
    pub crop: Option<Crop>,
    /// A part of the rendering, to be merged with the others later ([`crate::Film::merge`]): its crop and samples are
    /// then those of the rendering. Goals of the scene (noise, time) are for whole renderings, and do not count.
    pub part: Option<Part>,
    /// Worker threads; 0: one per core.
    pub threads: usize,
    /// The vector instructions of stages and tree; the bytes are the same for all.
    pub level: Option<Level>,
    /// Whether the pixels of a block share what they find.
    pub reuse: Option<bool>,
    /// Whether photons tell where rays are aimed, so that they find lights over mirrors and glass.
    pub caustics: Option<bool>,
    /// The most that the largest channel of a sample counts, in W/(sr m^2): what is above is scaled down to it as a
    /// whole. A sample is all that a pixel gets at one sample index, its part of what others have found included; what
    /// one light path brings to a pixel is scaled by itself. What is not a finite number above zero is no limit.
    pub clamp: Option<f32>,
    /// The rendering ends as soon as [`crate::Film::relative_noise`] is no more than this, with fewer samples than are
    /// asked for. It is looked at where all pixels have 16 samples, and then four times from each power of two to the
    /// next, at 20, 24, 28, 32, 40 and so on: so the picture depends on nothing but the scene.
    pub noise: Option<f64>,
    /// Whether tiles of 16x16 pixels that are quiet take fewer samples than those that are noisy: a half, a quarter or
    /// an eighth of them, from 64 samples per pixel on. Four pictures of one sample per pixel, which are not shown,
    /// tell which; where less than a fifth of the samples would be saved, all take all. It is unbiased, and depends on
    /// scene, size and seed alone: crops and parts are as in the whole. `None`: what the scene says; else, where a
    /// noise is asked for that takes 128 samples or more. Where something moves while the shutter is open all take all.
    pub adaptive: Option<bool>,
    /// The rendering ends then, as an observer would end it; not before every pixel has a sample.
    pub until: Option<Instant>,
    /// A whole rendering ends as another one was ended by a time ([`crate::Film::plan`]); its samples count, and no
    /// goal. Where something moves while the shutter is open, its last pass is of one sample index.
    pub plan: Option<Plan>,
    /// What is kept of what camera rays hit first, beside the picture ([`crate::Film::layer`]).
    pub layers: Option<LayerSet>,
    /// Whether the film keeps two halves of the samples apart, too, as [`crate::denoise`] needs them.
    pub halves: bool,
    /// What the film counts for mattes ([`crate::Film::matte`]).
    pub mattes: MattesKept,
    /// Whether the film keeps apart what each group of lights brings ([`crate::Film::light_groups`]), where the scene
    /// tells them apart ([`crate::LightGroups`]). Each sample is traced once for each group then.
    pub light_groups: Option<bool>,
    /// Whether to keep [`crate::Statistics`].
    pub statistics: bool,
    /// Passes are made no longer than this, as far as those before tell, so that [`crate::Observer::state`] comes
    /// often: it comes between passes only. The picture does not depend on it.
    pub longest_pass: Option<Duration>,
}
