//! A compiled scene: what is rendered, and what programs want to know of it beside.

use crate::develop::{Backdrop, Look};
use crate::mattes::{Mattes, mattes_kept};
use scene_format::{Diagnostic, Diagnostics, desc};
use std::ops::{Deref, DerefMut};
use std::path::PathBuf;
use std::sync::Arc;
use tracer_kernels::layers::{Layer, LayerSet};
use tracer_kernels::sampling::blocks::QUARTERS;
use tracer_kernels::sampling::sampler::{Pair, Purpose, hash3};
pub use tracer_kernels::scene::{
    Albedo, Between, Camera, CurvedLight, Environment, Filter, FisheyeMapping, FlatLight, Frame, GradientAxis,
    Instance, Integrator, Lens, Light, Made, Material, Mesh, NONE, NoiseKind, Op, Operand, Pattern, PatternKind,
    Program, Projection, Shape, Sharing, Solids, Space, Sphere, Statistics, Step, Texel, TextureFilter, TextureView,
    TextureWrap, Triangles, VertexSpace, VoronoiFeature, WorldBounds, materials,
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
    /// The groups that its lights are of, where a picture is to be made of each; `None` where not.
    pub light_groups: Option<LightGroups>,
    /// Where something moves while the camera's shutter is open: what it is compiled of at other times.
    pub moments: Option<Arc<dyn Moments>>,
    /// How long compiling took.
    pub times: CompileTimes,
}

/// Groups of lights whose shares of the picture are told apart ([`Film::light_groups`](crate::Film::light_groups)).
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LightGroups {
    /// Their names, in the order of the alphabet; behind them [`LightGroups::REST`], where anything shines that is of
    /// no group. None where nothing shines.
    pub names: Vec<String>,
    /// Which of them each light is of.
    pub of_light: Vec<u32>,
    /// Which of them the background is of, where it shines.
    pub of_background: Option<u32>,
}

impl LightGroups {
    /// What the lights are called together that are of no group; no group has this name.
    pub const REST: &str = desc::LightGroup::REST;

    /// The scene once for each group, lit by it alone; all but the lights is shared by them.
    pub(crate) fn lit(&self, scene: &tracer_kernels::scene::Scene) -> Vec<tracer_kernels::scene::Scene> {
        let of = |group: u32| {
            scene.lit_by(|light| self.of_light.get(light) == Some(&group), self.of_background == Some(group))
        };
        (0..self.names.len() as u32).map(of).collect()
    }
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

/// A scene at other times, where something moves while its camera's shutter is open. [`crate::compile`] makes it of the
/// scene's texts; a program that has other ways to move things may put its own there ([`Scene::moments`]).
pub trait Moments: Send + Sync {
    /// The scene as it is so large a part, from 0 to 1, of the time that the shutter is open after the shutter opens.
    /// It has the [`Frame`] and the unit of radiance of the scene that this stands in, and as many materials and
    /// objects where these are told apart, and the same [`LightGroups::names`].
    ///
    /// # Errors
    /// What is wrong with it then.
    fn at(&self, part: f64) -> Result<Scene, Diagnostics>;

    /// Which part of a frame the shutter is open, above 0: what moves is told per frame ([`Layer::Motion`]).
    fn shutter(&self) -> f64 {
        1.0
    }
}

/// Each run of so many sample indices has one in each of as many equal parts of the time that the shutter is open.
const PARTS: u32 = 16;

/// Where there is more than these and one triangle, or another shape, for so many pixels, all pixels of a sample index
/// see one moment: to compile the scene four times would take longer than to render it.
const FEW_PRIMITIVES: u64 = 256;
const PIXELS_PER_PRIMITIVE: u64 = 64;

/// When a sample index sees the scene: a part, from 0 to 1, of the time that the shutter is open. Each run of 2^k of
/// them that begins at a multiple of that has one in each of 2^k equal parts of the time.
///
/// Points of the sampler with a shuffle of their own: by the index's own bits in reverse, times would be tied to the
/// first of each two dimensions that a pixel draws.
fn moment(seed: u32, sample: u32) -> f64 {
    let pair = Pair::new(hash3(seed, 0, 0x005b_077e) as u32, Purpose::Grid);
    f64::from(pair.point(0, 0, sample)[0])
}

/// When a sample index of a quarter of the pixels sees it. Runs up to [`PARTS`] are as above, whichever quarters their
/// indices are of: a pixel is of another one each time. Within each of [`PARTS`] parts of the time all quarters of 2^k
/// such runs have one in each of 2^k [`QUARTERS`] parts of it.
fn moment_of_quarter(seed: u32, sample: u32, quarter: u32) -> f64 {
    let part = (moment(seed, sample) * f64::from(PARTS)).floor();
    let within = Pair::new(hash3(seed, part as u32 + 1, 0x005b_077e) as u32, Purpose::Grid);
    // Samples beyond the fourth part of all numbers begin anew.
    let number = (sample / PARTS).wrapping_mul(QUARTERS).wrapping_add(quarter);
    (part + f64::from(within.point(0, 0, number)[0])) / f64::from(PARTS)
}

impl Scene {
    /// Whether something moves while the camera's shutter is open: then its picture is of many scenes, of which this is
    /// the one when the shutter opens ([`Scene::at_sample`]).
    pub fn moves(&self) -> bool {
        self.moments.is_some()
    }

    /// The scene as it is so large a part, from 0 to 1, of the time that its shutter is open after the shutter opens;
    /// `None` where nothing moves. Nothing moves in it. Its render space and its unit of radiance are this scene's; so
    /// is what is rendered of it.
    ///
    /// # Errors
    /// What is wrong with it then.
    pub fn at(&self, part: f64) -> Option<Result<Scene, Diagnostics>> {
        let moments = self.moments.as_deref()?;
        Some(moments.at(part).map(|scene| self.rendered_as(scene)))
    }

    /// How many moments the pixels of a sample index see: none where nothing moves; four, a quarter of the pixels each;
    /// one where much has to be compiled for each: more than 256 triangles and other shapes, and one for 64 pixels.
    pub fn moments_of_sample(&self) -> u32 {
        let tree = self.accel.as_ref().map_or_else(Default::default, |accel| accel.stats());
        let primitives = tree.triangles + tree.spheres + tree.shapes + tree.instances;
        let pixels = u64::from(self.size[0]) * u64::from(self.size[1]);
        match self.moves() {
            false => 0,
            true if primitives <= FEW_PRIMITIVES + pixels / PIXELS_PER_PRIMITIVE => QUARTERS,
            true => 1,
        }
    }

    /// The scene as a sample index of its picture sees it, with a seed, or a quarter of the pixels does where these
    /// have moments of their own ([`Scene::moments_of_sample`], [`crate::quarter_of`]); `None` where nothing moves.
    ///
    /// ```
    /// use scene_format::{Syntax, load_str};
    /// use std::path::Path;
    /// use tracer_core::compile;
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let text = "Scene(background: 1, camera: Camera(shutter: 0.5), \
    ///     objects: [Sphere(center: (\"=24*time\", 0, 0), radius: 1)])";
    /// let scene = compile(&load_str("s.ron", text, Syntax::Ron, Path::new(""), &[])?.scene)?;
    /// let later = scene.at_sample(7, Some(3), 0).ok_or("it moves")?.map_err(|faults| faults[0].message.clone())?;
    /// assert_ne!(later.spheres[0].center, scene.spheres[0].center);
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    /// What is wrong with it then.
    pub fn at_sample(&self, sample: u32, quarter: Option<u32>, seed: u32) -> Option<Result<Scene, Diagnostics>> {
        self.at(quarter.map_or_else(|| moment(seed, sample), |quarter| moment_of_quarter(seed, sample, quarter)))
    }

    /// Another scene, of which is rendered what is rendered of this one.
    fn rendered_as(&self, mut other: Scene) -> Scene {
        (other.size, other.samples, other.max_bounces) = (self.size, self.samples, self.max_bounces);
        (other.seed, other.integrator, other.clamp) = (self.seed, self.integrator, self.clamp);
        (other.noise, other.time, other.adaptive) = (self.noise, self.time, self.adaptive);
        (other.layers, other.backdrop, other.look) = (self.layers, self.backdrop, self.look);
        other
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
    Albedo,
    Normal,
    Depth,
    Position,
    Uv,
    Emission,
    ObjectId,
    MaterialId,
    Variance,
    Alpha,
    Noise,
    PathLength,
    Nodes,
    Leaves,
    Direct,
    Indirect,
    Samples,
    Motion,
    DenoisingAlbedo,
    DenoisingNormal
);

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    /// Every aligned run of a power of two is stratified, whatever the seed; so are both halves that denoising keeps.
    /// Where quarters have moments of their own, runs up to sixteen are, whichever quarters their indices are of, and
    /// the moments of all quarters of longer runs.
    #[test]
    fn moments_are_stratified() {
        let are_stratified = |moments: Vec<f64>| {
            let count = moments.len();
            let seen: BTreeSet<_> = moments.iter().map(|at| (at * count as f64) as usize).collect();
            seen.len() == count && moments.iter().all(|at| (0.0..1.0).contains(at))
        };
        for seed in 0..20 {
            for (power, run) in (0..8).flat_map(|power| (0..4).map(move |run| (power, run))) {
                let samples = || run << power..(run + 1) << power;
                let quarter = |sample: u32| hash3(seed, sample, run) as u32 % QUARTERS;
                let of_all = |sample: u32| (0..QUARTERS).map(move |q| moment_of_quarter(seed, sample, q));
                assert!(are_stratified(samples().map(|sample| moment(seed, sample)).collect()));
                if power <= 4 {
                    let any = samples().map(|sample| moment_of_quarter(seed, sample, quarter(sample)));
                    assert!(are_stratified(any.collect()), "seed {seed}, samples {:?}", samples());
                }
                if power >= 4 {
                    assert!(are_stratified(samples().flat_map(of_all).collect()), "seed {seed}, {:?}", samples());
                }
            }
        }
    }

    /// Times and the places in a pixel at the same indices fill the square.
    #[test]
    fn moments_know_nothing_of_places_in_pixels() {
        let (mut sum, mut worst) = (0.0, 0f64);
        for seed in 0..20 {
            let pixel = Pair::new(seed, Purpose::Pixel);
            let mut cells = [0u32; 64];
            for sample in 0..1024 {
                let [x, _] = pixel.point(5, 9, sample);
                cells[(moment_of_quarter(seed, sample, sample / 3 % QUARTERS) * 8.0) as usize * 8
                    + (f64::from(x) * 8.0) as usize] += 1;
            }
            let chi2: f64 = cells.iter().map(|&n| (f64::from(n) - 16.0).powi(2) / 16.0).sum();
            sum += chi2;
            worst = worst.max(chi2);
        }
        // Were one of them told by the other, eight cells would hold 128 each: 7168. Every eight samples are one
        // permutation of both, which gives 64 (7/8) = 56 in the mean over seeds. Runs of one seed are nested, so that
        // single seeds spread by about 30, and the mean of twenty by 7: four of these.
        let mean = sum / 20.0;
        assert!((mean - 56.0).abs() < 28.0 && worst < 716.8, "{mean}, {worst}");
    }
}
