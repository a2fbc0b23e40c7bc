//! A compiled scene: what is rendered, and what programs want to know of it beside.

use crate::develop::{Backdrop, Look};
use crate::mattes::{Mattes, mattes_kept};
use scene_format::{Diagnostic, desc};
use std::ops::{Deref, DerefMut};
use std::path::PathBuf;
use tracer_kernels::layers::{Layer, LayerSet};
pub use tracer_kernels::scene::{
    Albedo, Between, Camera, CurvedLight, Environment, Filter, FisheyeMapping, FlatLight, Frame, GradientAxis,
    Instance, Integrator, Lens, Light, Made, Material, Mesh, NONE, NoiseKind, Op, Operand, Pattern, PatternKind,
    Program, Projection, Shape, Sharing, Solids, Space, Sphere, Statistics, Step, Texel, TextureFilter, TextureView,
    TextureWrap, Triangles, VoronoiFeature, WorldBounds, materials,
};

/// A scene that was compiled ([`crate::compile`]); what is rendered of it is reached as if it were its own.
pub struct Scene {
    /// What is rendered.
    pub rendered: tracer_kernels::scene::Scene,
    /// How the film is developed unless the caller says otherwise.
    pub look: Look,
    /// All files that were read for it, as they were opened: meshes, their MTL files, placements, textures. The
    /// scene's own is not among them.
    pub files: Vec<PathBuf>,
    /// What mattes its picture has; the film counts for them if it is asked to ([`crate::RenderOptions::mattes`]).
    pub mattes: Mattes,
    /// What was odd but not wrong.
    pub warnings: Vec<Diagnostic>,
    /// How long compiling took.
    pub times: CompileTimes,
}

/// Seconds that the parts of compiling took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompileTimes {
    /// Loading meshes, textures and placements.
    pub assets: f64,
    /// Placing everything in render space, tables.
    pub tables: f64,
    /// Building the tree.
    pub tree: f64,
}

impl Deref for Scene {
    type Target = tracer_kernels::scene::Scene;

    fn deref(&self) -> &Self::Target {
        &self.rendered
    }
}

impl DerefMut for Scene {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.rendered
    }
}

/// The layers that these words of a scene ask for.
///
/// # Examples
///
/// ```
/// use scene_format::desc;
/// use tracer_core::{Layer, layer_set};
///
/// let layers = layer_set(&[desc::Layer::Depth, desc::Layer::Albedo]);
/// assert_eq!(layers.iter().collect::<Vec<_>>(), [Layer::Albedo, Layer::Depth]);
/// ```
pub fn layer_set(words: &[desc::Layer]) -> LayerSet {
    words.iter().map(|word| of_word(*word)).collect()
}

/// The layers of the film: those that the scene asks for, the one that tells what a backdrop is seen through, and those
/// whose samples are counted for mattes.
pub fn film_layers(output: &desc::Output) -> LayerSet {
    let alpha = (backdrop(output) != Backdrop::Background).then_some(Layer::Alpha);
    layer_set(&output.layers).iter().chain(alpha).chain(mattes_kept(output).layers().iter()).collect()
}

/// What the picture has behind everything.
pub(crate) fn backdrop(output: &desc::Output) -> Backdrop {
    match &output.backdrop {
        _ if output.alpha => Backdrop::Clear,
        Some(color) => Backdrop::Color(color.value),
        None => Backdrop::Background,
    }
}

/// One line a layer: its word and itself.
macro_rules! words {
    ($($Word:ident),+) => {
        fn of_word(word: desc::Layer) -> Layer {
            match word {$( desc::Layer::$Word => Layer::$Word, )+}
        }

        /// The word of a layer.
        pub fn layer_word(layer: Layer) -> desc::Layer {
            match layer {$( Layer::$Word => desc::Layer::$Word, )+}
        }
    };
}

words!(
    Albedo, Normal, Depth, Position, Uv, Emission, ObjectId, MaterialId, Variance, Alpha, Noise, PathLength, Nodes,
    Leaves
);
