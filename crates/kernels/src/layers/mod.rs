//! Picture layers: what camera rays hit first, or what is seen over mirrors and glass, kept beside the picture.
//!
//! A layer is a file here, named as its word in scenes is, with one contract ([`PictureLayer`]), and one line of
//! `layers!`. The kernels that fill them (`engine::stages::first_hits` and `seen`), the film that sums them
//! (`film::layers`) and the files that they end in go by the contract and know no layer by its name.
//!
//! Samples lie where the pixel's filter has them, so their plain mean is the filtered one, as it is of the picture.

mod albedo;
mod alpha;
mod batch;
mod denoising_albedo;
mod denoising_normal;
mod depth;
mod direct;
mod emission;
mod indirect;
mod leaves;
mod material_id;
mod motion;
mod nodes;
mod noise;
mod normal;
mod object_id;
mod path_length;
mod position;
mod samples;
mod uv;
mod variance;

use crate::engine::Surface;
use crate::lanes::Lanes;
use crate::math::V3;
use crate::scene::Scene;
pub use batch::{DirectLight, LayerSamples};

/// How a pixel's value comes of its samples.
#[derive(Clone, Copy, Debug)]
pub enum Pixel {
    /// Their mean; a camera ray that hits nothing brings zero.
    Mean,
    /// The mean over those that hit something; this value where none does.
    MeanOfHits(f32),
    /// A number below 2^24 of the sample nearest to the pixel's centre, by primitive, instance and body
    /// ([`Surface::body`]); zero where that hits nothing.
    Nearest(fn(&Scene, u32, u32, u32) -> u32),
    /// The mean of what samples see, be it over mirrors and through glass ([`PictureLayer::seen`]).
    Seen,
    /// Not of what camera rays hit: the mean of what is counted while the rays of a sample are traced; of one channel.
    Counted(Count),
    /// Not of what camera rays hit: the mean of what has come to the samples over one surface at most; three channels.
    Direct,
    /// What the picture has beside that.
    Indirect,
    /// Not of what camera rays hit: a number that the film has of each pixel.
    OfFilm(FilmNumber),
}

/// What is counted of the rays of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Rays of paths, without those that only ask whether a light is seen.
    Rays,
    /// Nodes of the tree, each of up to eight boxes, that all its rays ask.
    Nodes,
    /// Leaves of the tree, each of up to four primitives, that all its rays ask.
    Leaves,
}

/// A number that the film has of each pixel, in the person's units.
#[derive(Clone, Copy, Debug)]
pub enum FilmNumber {
    /// Its variance (`tracer_core::Film::variance`).
    Variance,
    /// Its standard error relative to its luminance.
    Noise,
    /// How many samples it has.
    Samples,
}

/// How the numbers of a layer in render space become the person's: by a factor and an offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// The factor.
    pub scale: f64,
    /// Added after it.
    pub offset: [f64; 3],
}

impl Units {
    /// The same numbers.
    pub const SAME: Units = Units { scale: 1.0, offset: [0.0; 3] };
}

/// What a layer is.
pub trait PictureLayer {
    /// Its name in files, before the dot: `depth`.
    const NAME: &'static str;
    /// Its channels in files, behind the dot; one to three.
    const CHANNELS: &'static [&'static str];
    /// How a pixel's value comes of its samples.
    const PIXEL: Pixel;
    /// Whether it reads texture coordinates, which are not found for nothing.
    const READS_UV: bool = false;

    /// Of means: its value at what camera rays hit first, a number for each channel and anything for the others; in
    /// render space. Lanes outside of `hit.valid` may hold anything.
    #[inline(always)]
    fn at<F: Lanes>(_: &FirstHit<'_, F>) -> [F; 3] {
        [F::splat(0.0), F::splat(0.0), F::splat(0.0)]
    }

    /// Of what is seen over mirrors and glass: the same. Lanes that are of none of its masks may hold anything.
    #[inline(always)]
    fn seen<F: Lanes>(_: &Seen<F>) -> [F; 3] {
        [F::splat(0.0), F::splat(0.0), F::splat(0.0)]
    }

    /// How its numbers become the person's.
    fn units(_: &Scene) -> Units {
        Units::SAME
    }
}

/// What camera rays hit first.
pub struct FirstHit<'a, F: Lanes> {
    /// The scene.
    pub scene: &'a Scene,
    /// The lanes that hit something.
    pub valid: F::M,
    /// Unit direction of the ray.
    pub direction: V3<F>,
    /// Its length.
    pub t: F,
    /// The surface there.
    pub surface: &'a Surface<F>,
}

/// What paths see that have met mirrors and glass only.
pub struct Seen<F: Lanes> {
    /// They come straight from the camera.
    pub straight: bool,
    /// The lanes that meet a surface that is neither mirror nor glass nor lamp.
    pub surfaces: F::M,
    /// The lanes that meet a lamp.
    pub lamps: F::M,
    /// The lanes that meet nothing.
    pub beyond: F::M,
    /// What mirrors and glass let through, times the sample's share of it.
    pub weight: V3<F>,
    /// The surface's colour.
    pub color: V3<F>,
    /// Its unit shading normal, on the ray's side.
    pub normal: V3<F>,
}

impl<F: Lanes> Seen<F> {
    /// The weight without its colour.
    #[inline(always)]
    pub fn share(&self) -> F {
        let V3(red, green, blue) = self.weight;
        (red + green + blue) * F::splat(1.0 / 3.0)
    }
}

/// What is kept of each pixel for a set of layers: so many sums, and so many numbers of the sample nearest to its
/// centre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Kept {
    /// Sums of a pixel.
    pub sums: usize,
    /// Numbers of its nearest sample.
    pub nearest: usize,
    /// Texture coordinates have to be found, whether there are textures or not.
    pub uv: bool,
    /// What comes over one surface at most is told apart.
    pub direct: bool,
}

/// A layer's contract as data.
#[derive(Clone, Copy, Debug)]
pub struct Definition {
    /// [`PictureLayer::NAME`].
    pub name: &'static str,
    /// [`PictureLayer::CHANNELS`].
    pub channels: &'static [&'static str],
    /// [`PictureLayer::PIXEL`].
    pub pixel: Pixel,
    /// [`PictureLayer::READS_UV`].
    pub uv: bool,
}

impl Definition {
    const fn of<L: PictureLayer>() -> Self {
        Definition { name: L::NAME, channels: L::CHANNELS, pixel: L::PIXEL, uv: L::READS_UV }
    }
}

/// How many sums of a pixel are kept for a layer.
fn sums_of(channels: &[&str], pixel: Pixel) -> usize {
    match pixel {
        Pixel::Nearest(_) | Pixel::OfFilm(_) => 0,
        Pixel::Mean | Pixel::MeanOfHits(_) | Pixel::Seen => channels.len(),
        Pixel::Counted(_) | Pixel::Direct | Pixel::Indirect => channels.len(),
    }
}

/// The registry: everything that asks for a layer by its word.
macro_rules! layers {
    ($($(#[$doc:meta])+ $Word:ident: $Room:path),+ $(,)?) => {
        /// A layer. Their words are those of the scene language.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Layer {
            $($(#[$doc])+ $Word,)+
        }

        /// All layers, in the order of their words.
        const ALL: [Layer; [$(Layer::$Word),+].len()] = [$(Layer::$Word),+];

        /// What a layer is.
        pub fn definition(layer: Layer) -> Definition {
            match layer {
                $(Layer::$Word => const { Definition::of::<$Room>() },)+
            }
        }

        /// How the numbers of a layer become the person's.
        pub fn units(layer: Layer, scene: &Scene) -> Units {
            match layer {
                $(Layer::$Word => <$Room>::units(scene),)+
            }
        }

        /// [`PictureLayer::at`] of a layer.
        #[inline(always)]
        pub fn at<F: Lanes>(layer: Layer, hit: &FirstHit<'_, F>) -> [F; 3] {
            match layer {
                $(Layer::$Word => <$Room>::at(hit),)+
            }
        }

        /// [`PictureLayer::seen`] of a layer.
        #[inline(always)]
        pub fn seen_at<F: Lanes>(layer: Layer, of: &Seen<F>) -> [F; 3] {
            match layer {
                $(Layer::$Word => <$Room>::seen(of),)+
            }
        }
    };
}

layers! {
    /// See [`albedo`].
    Albedo: albedo::Albedo,
    /// See [`normal`].
    Normal: normal::Normal,
    /// See [`depth`].
    Depth: depth::Depth,
    /// See [`position`].
    Position: position::Position,
    /// See [`uv`].
    Uv: uv::Uv,
    /// See [`emission`].
    Emission: emission::Emission,
    /// See [`object_id`].
    ObjectId: object_id::ObjectId,
    /// See [`material_id`].
    MaterialId: material_id::MaterialId,
    /// See [`variance`].
    Variance: variance::Variance,
    /// See [`alpha`].
    Alpha: alpha::Alpha,
    /// See [`noise`].
    Noise: noise::Noise,
    /// See [`path_length`].
    PathLength: path_length::PathLength,
    /// See [`nodes`].
    Nodes: nodes::Nodes,
    /// See [`leaves`].
    Leaves: leaves::Leaves,
    /// See [`direct`].
    Direct: direct::Direct,
    /// See [`indirect`].
    Indirect: indirect::Indirect,
    /// See [`samples`].
    Samples: samples::Samples,
    /// See [`motion`].
    Motion: motion::Motion,
    /// See [`denoising_albedo`].
    DenoisingAlbedo: denoising_albedo::DenoisingAlbedo,
    /// See [`denoising_normal`].
    DenoisingNormal: denoising_normal::DenoisingNormal,
}

/// A set of layers, for a rendering's options; it goes through them in the order in which files have them.
///
/// # Examples
///
/// ```
/// use tracer_kernels::layers::{Layer, LayerSet};
///
/// let layers = LayerSet::from_iter([Layer::Depth, Layer::Albedo, Layer::Depth]);
/// assert_eq!(layers.iter().collect::<Vec<_>>(), [Layer::Albedo, Layer::Depth]);
/// assert_eq!(layers.to_string(), "albedo, depth");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LayerSet(u32);

impl LayerSet {
    /// All layers that there are.
    pub fn all() -> Self {
        LayerSet::from_iter(ALL)
    }

    /// The layer of a name, as files have it: `depth`. Large letters, hyphens and underscores do not matter, so the
    /// words of scenes are understood, too.
    pub fn by_name(name: &str) -> Option<Layer> {
        let bare = |name: &str| name.replace(['_', '-'], "").to_ascii_lowercase();
        ALL.into_iter().find(|&layer| bare(definition(layer).name) == bare(name))
    }

    /// Whether there is none in it.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Those in it.
    pub fn iter(self) -> impl Iterator<Item = Layer> {
        ALL.into_iter().filter(move |&layer| self.0 >> layer as u32 & 1 == 1)
    }

    /// Their names, as files have them.
    pub fn names(self) -> impl Iterator<Item = &'static str> {
        self.iter().map(|layer| definition(layer).name)
    }

    /// Numbers that a pixel has of them.
    pub fn channels(self) -> usize {
        self.iter().map(|layer| definition(layer).channels.len()).sum()
    }

    /// What is kept of each pixel for them.
    pub fn kept(self) -> Kept {
        let mut kept = Kept::default();
        for layer in self.iter() {
            let Definition { channels, pixel, uv, .. } = definition(layer);
            match pixel {
                Pixel::Nearest(_) => kept.nearest += 1,
                _ => kept.sums += sums_of(channels, pixel),
            }
            kept.uv |= uv;
            kept.direct |= matches!(pixel, Pixel::Direct | Pixel::Indirect);
        }
        kept
    }

    /// Which column of [`LayerSamples::sums`] is the first of each layer.
    fn placed(self) -> impl Iterator<Item = (usize, Layer, Definition)> {
        let mut next = 0;
        self.iter().map(move |layer| {
            let definition = definition(layer);
            let column = next;
            next += sums_of(definition.channels, definition.pixel);
            (column, layer, definition)
        })
    }

    /// What is counted for them, and in which column of [`LayerSamples::sums`].
    pub fn counted(self) -> impl Iterator<Item = (usize, Count)> {
        self.placed().filter_map(|(column, _, of)| match of.pixel {
            Pixel::Counted(count) => Some((column, count)),
            _ => None,
        })
    }

    /// In which columns of [`LayerSamples::sums`] the first channel is of what comes over one surface at most.
    pub fn direct(self) -> impl Iterator<Item = usize> {
        let is_direct = |pixel| matches!(pixel, Pixel::Direct | Pixel::Indirect);
        self.placed().filter(move |(_, _, of)| is_direct(of.pixel)).map(|(column, ..)| column)
    }

    /// Those of what is seen over mirrors and glass: the first column of [`LayerSamples::sums`], and how many they
    /// have.
    pub fn seen(self) -> impl Iterator<Item = (usize, Layer, usize)> {
        let seen = self.placed().filter(|(_, _, of)| matches!(of.pixel, Pixel::Seen));
        seen.map(|(column, layer, of)| (column, layer, of.channels.len()))
    }

    /// Whether camera rays have to be looked at for them.
    pub fn are_of_hits(self) -> bool {
        self.kept() != Kept::default()
    }
}

impl FromIterator<Layer> for LayerSet {
    fn from_iter<I: IntoIterator<Item = Layer>>(layers: I) -> Self {
        LayerSet(layers.into_iter().fold(0, |bits, layer| bits | 1 << layer as u32))
    }
}

/// Their names; `none` where there is none.
impl std::fmt::Display for LayerSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.is_empty() {
            return f.write_str("none");
        }
        f.write_str(&self.names().collect::<Vec<_>>().join(", "))
    }
}
