//! The picture's size, and how to render.

use crate::diagnostic::Spanned;
use crate::schema::Rule;
use crate::words::{scene_enum, scene_struct, scene_words};

scene_struct! {
    /// Size of the picture in pixels.
    pub struct Image as "Image", "the image" {
        /// Pixels across.
        width: Spanned<u32> = 512u32 => Rule::within("a whole number", 1.0, 65536.0).unit("in pixels");
        /// Pixels down.
        height: Spanned<u32> = 512u32 => Rule::within("a whole number", 1.0, 65536.0).unit("in pixels");
    }
}

scene_struct! {
    /// How to render.
    pub struct Render as "Render", "`Render`" {
        /// Camera samples per pixel.
        samples: Spanned<u32> = 64u32 => Rule::within("a whole number", 1.0, 1_000_000_000.0);
        /// Scattering events after the first hit: a path has at most `max_bounces + 1` segments from the camera through
        /// surfaces, and one more to a light. Each side of glass that is seen through is one: a glass in a glass has
        /// eight sides, and what lies behind them is black with fewer.
        max_bounces: Spanned<u32> = 5u32 => Rule::within("a whole number", 0.0, 1_000_000.0);
        /// Seed of all random choices.
        seed: Spanned<u32> = 0u32 => Rule::within("a whole number", 0.0, 4_294_967_295.0);
        /// What finds the hits; the picture is the same, byte for byte.
        acceleration: Acceleration = Acceleration::Bvh;
        /// What the picture is of, and with or without what saves noise.
        integrator: Integrator = Integrator::Full;
        /// Whether the pixels of a block share what they find.
        reuse: Reuse = Reuse::Blocks;
        /// How light comes over mirrors and glass to diffuse surfaces.
        caustics: Caustics = Caustics::Photons;
        /// How light comes to second vertices over further surfaces.
        indirect: Indirect = Indirect::Paths;
        /// The most that one camera sample counts: where the largest channel of what it has found, lamps in view
        /// included, is more than this (before exposure), all three are scaled down together, so that the hue stays.
        /// That takes fireflies, and their light with them: such pixels stay too dark however many samples follow. The
        /// report says how much was taken. `None` takes nothing. What one light path brings (`caustics`) counts at most
        /// as much; a caustic of many may be brighter.
        clamp: Option<Spanned<f64>> = None => Rule::length("a radiance").unit("in W/(sr m^2)");
        /// The rendering ends as soon as the noise is no more than this: the root mean square over the pixels of their
        /// standard error, relative to the mean luminance, as the report has it. 0.01 is hardly seen. It is told by how
        /// two halves of the samples differ, 0.8 to 1.2 times the true error (docs/noise.md), where few pixels bear it
        /// half to twice as much, and where something moves while the shutter is open by how they scatter, which is
        /// more. With `alpha` or `backdrop` it is that of the picture without the background. `samples` are the most.
        /// It is looked at after whole passes only, four times while the samples double, so the picture depends on
        /// nothing else; first when all pixels have 16 samples, where something moves 16 or 64. What is rarer is
        /// missing in a picture that ends then, and in its noise. `None`: all samples.
        noise: Option<Spanned<f64>> = None => Rule::between("a relative error", 0.0, 1.0);
        /// Whether parts of the picture that are quiet take fewer samples than those that are noisy: tiles of 16x16
        /// pixels a half, a quarter or an eighth of them, from 64 samples per pixel on. It is unbiased: four pictures
        /// of one sample per pixel, which are not shown, tell which, and where less than a fifth of the samples would
        /// be saved all tiles take all. `samples` are those of the noisy ones then (docs/noise.md). Where something
        /// moves while the shutter is open all take all.
        adaptive: Adaptive = Adaptive::WithNoise;
        /// The rendering ends when the program has run so long. `samples` are the most. `None`: all samples.
        time: Option<Spanned<f64>> = None => Rule::length("a time").unit("in seconds");
    }
}

scene_words! {
    /// Whether quiet parts of a picture take fewer samples.
    pub enum Adaptive, "choice of adaptive sampling" {
        /// Where a `noise` is asked for that takes 128 samples or more.
        WithNoise,
        /// From 64 samples on.
        Always,
        /// All pixels take all samples.
        Never,
    }
}

scene_words! {
    /// What finds the hits.
    pub enum Acceleration, "acceleration" {
        /// A bounding volume hierarchy.
        Bvh,
        /// One bounding box per mesh, every triangle inside it tested.
        BoundingBox,
        /// Every triangle tested for every ray.
        None,
    }
}

scene_enum! {
    /// What the picture is of, and with or without what saves noise.
    pub enum Integrator, "integrator" {
        /// Path tracing with all that `reuse` and `caustics` say. Right on average, too.
        Full;
        /// The plain path tracer, whatever `reuse` and `caustics` say: every pixel for itself, no ray guided; right on
        /// average with any number of samples, unless `clamp` is written.
        Path;
        /// Direct light alone: what lights and background send straight to the surfaces that the camera sees, also in
        /// mirrors and through glass (up to `max_bounces`). No surface lights another one, and mirrors and glass throw
        /// no light on any. As `Path`, every pixel for itself. Without mirrors and glass it is the picture of `Path`
        /// with `max_bounces: 0`.
        Direct;
        /// No light at all: how much of the half space above each surface that the camera sees is free, weighted by the
        /// cosine. 1 is free, 0 all closed; where nothing is seen it is 0. Materials and lights do not matter, glass
        /// and lamps are in the way like all else.
        AmbientOcclusion as "ambient occlusion" {
            /// What is further off than this does not count. `None`: everything counts.
            distance: Option<Spanned<f64>> = None => Rule::length("a distance");
        };
    }
}

scene_words! {
    /// Whether the pixels of a block share what they find. The picture is right on average either way.
    pub enum Reuse, "reuse" {
        /// The second vertices of the paths of 64 pixels light all of these pixels: far less noise for the time in the
        /// light that one matt surface throws on another. Light gathered by mirrors and glass (caustics) gains nothing
        /// from it, for it stays with the pixel whose path has found it; `render.caustics` is for that. Under a
        /// background this is done indoors: in all blocks where a trial finds that three in four paths meet a second
        /// matt surface, in none where it is six in ten.
        Blocks,
        /// Every pixel for itself, as denoisers expect it.
        None,
    }
}

scene_words! {
    /// How light comes over mirrors, glass and shiny lobes to matt surfaces: the bright curves under a glass ball, say.
    pub enum Caustics, "caustics" {
        /// Photons are sent from the lights over mirrors and glass, and tell where rays from other surfaces are aimed.
        /// They bring no light themselves. Light paths bring it to surfaces that the camera sees. Each way counts by
        /// how likely it was, so the picture is right on average. What mirrors and glass show of lamps is sampled four
        /// times as often. Rays are aimed at the `background` as well, a colour or a picture, where it is seen through
        /// windows and doors ajar; of a picture its bright parts send photons.
        Photons,
        /// By the rays that happen to meet a light: right on average, and slow to become smooth.
        None,
    }
}

scene_words! {
    /// How light comes to the second vertices of paths over three surfaces and more. There was a choice in earlier
    /// versions.
    pub enum Indirect, "indirect" {
        /// Read as `Paths`: the map of earlier versions let light through walls.
        Map,
        /// By the paths themselves: right on average.
        Paths,
    }
}

/// As scenes have it.
impl std::fmt::Display for Integrator {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Integrator::Full => f.write_str("Full"),
            Integrator::Path => f.write_str("Path"),
            Integrator::Direct => f.write_str("Direct"),
            Integrator::AmbientOcclusion { distance: None } => f.write_str("AmbientOcclusion"),
            Integrator::AmbientOcclusion { distance: Some(distance) } => {
                write!(f, "AmbientOcclusion(distance: {})", distance.value)
            }
        }
    }
}

impl Default for Image {
    fn default() -> Self {
        Image { width: 512.into(), height: 512.into() }
    }
}

impl Default for Render {
    fn default() -> Self {
        Render {
            samples: 64.into(),
            max_bounces: 5.into(),
            seed: 0.into(),
            acceleration: Acceleration::Bvh,
            integrator: Integrator::Full,
            reuse: Reuse::Blocks,
            caustics: Caustics::Photons,
            indirect: Indirect::Paths,
            clamp: None,
            noise: None,
            adaptive: Adaptive::WithNoise,
            time: None,
        }
    }
}
