//! What is told of a sample, as data: points in the scene's coordinates and unit, radiance in W/(sr m^2).

/// A sample of a pixel, explained.
#[derive(Clone, Debug, PartialEq)]
pub struct Inspection {
    /// Column and row, from the upper left.
    pub pixel: [u32; 2],
    /// The sample index, from 0.
    pub sample: u32,
    /// Its path in the plain path tracer.
    pub path: PathTold,
    /// What the techniques make of it; `None` where none is at work.
    pub whole: Option<Whole>,
}

/// The path of a sample. At glass it may go both ways, so it is a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct PathTold {
    /// Where the camera's ray starts; `None` where this place of the picture shows nothing (around a fisheye's circle).
    pub camera: Option<[f64; 3]>,
    /// Ends of its rays, in the order in which they are traced.
    pub vertices: Vec<VertexTold>,
    /// What the pixel gets: the sum of all contributions in single precision, in the order of the batch.
    pub radiance: [f64; 3],
    /// What of that the film adds, where samples are clamped.
    pub counts: [f64; 3],
    /// The batch that makes pictures has the same bits.
    pub agrees: bool,
}

/// The end of a ray.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexTold {
    /// How many surfaces the path met before.
    pub depth: u32,
    /// The vertex that the ray comes from, by its place in the list; `None`: the camera.
    pub from: Option<usize>,
    /// It is the fainter of both ways at glass.
    pub is_branch: bool,
    /// Where the ray starts.
    pub origin: [f64; 3],
    /// Its unit direction.
    pub direction: [f64; 3],
    /// What radiance that comes back along the ray counts in the pixel.
    pub throughput: [f64; 3],
    /// Density of its direction in solid angle; `None` where it was the only one (camera, mirror, glass).
    pub pdf: Option<f64>,
    /// What it has hit; `None`: nothing.
    pub told: Option<Told>,
    /// Light that it met here.
    pub met: Option<MetTold>,
    /// Light that was sampled from here.
    pub sampled: Option<SampledTold>,
    /// How the path was scattered.
    pub scattering: Option<Scattering>,
    /// Why it ends here; `None` where it goes on.
    pub ended: Option<Ended>,
}

/// What a ray has hit.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// The point.
    pub point: [f64; 3],
    /// Shading normal, on the side that the ray came from.
    pub normal: [f64; 3],
    /// Normal of the surface itself.
    pub geometric: [f64; 3],
    /// Length of the ray.
    pub distance: f64,
    /// The object, from 0; behind the objects come the lamps of `lights`.
    pub object: Option<u32>,
    /// The material, from 0; behind those with names come all others.
    pub material: Option<u32>,
    /// It is a light.
    pub is_light: bool,
    /// Colour of the material there, textures included.
    pub color: [f64; 3],
    /// The ray came from outside.
    pub is_outside: bool,
    /// Of glass: the share that is reflected, and the index of refraction.
    pub glass: Option<[f64; 2]>,
}

/// Light that a ray met.
#[derive(Clone, Debug, PartialEq)]
pub struct MetTold {
    /// What comes from there.
    pub radiance: [f64; 3],
    /// Density with which a light sample takes this direction; `None` where there was none that could.
    pub light_pdf: Option<f64>,
    /// Its weight beside light samples.
    pub weight: f64,
    /// What it brings to the pixel.
    pub brings: [f64; 3],
}

/// Which light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightOf {
    /// One of an object, from 0, as [`Told::object`] counts.
    Object(u32),
    /// The picture of all directions.
    Environment,
}

/// A light sample.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledTold {
    /// Which light.
    pub light: LightOf,
    /// Where on it; `None` where it is infinitely far.
    pub point: Option<[f64; 3]>,
    /// Unit direction.
    pub direction: [f64; 3],
    /// Density of the direction in solid angle, the choice of the light included.
    pub pdf: f64,
    /// Density with which the material's own ray takes it.
    pub material_pdf: f64,
    /// Its weight beside the material's own ray.
    pub weight: f64,
    /// f of the material.
    pub f: [f64; 3],
    /// What the light sends.
    pub radiance: [f64; 3],
    /// Cosine at the surface.
    pub cos: f64,
    /// What it brings to the pixel where nothing is between.
    pub carries: [f64; 3],
    /// Whether it arrives; `None` where no ray was cast, because it would bring nothing.
    pub arrives: Option<bool>,
}

impl SampledTold {
    /// What it brings to the pixel.
    pub fn brings(&self) -> [f64; 3] {
        if self.arrives == Some(true) { self.carries } else { [0.0; 3] }
    }
}

/// How a path was scattered.
#[derive(Clone, Debug, PartialEq)]
pub struct Scattering {
    /// By what: `diffuse`, `glossy`, `mirror`, `reflection` or `refraction`.
    pub lobe: &'static str,
    /// The next direction.
    pub direction: [f64; 3],
    /// Its density, where there is one.
    pub pdf: Option<f64>,
    /// f cos / pdf.
    pub weight: [f64; 3],
    /// Whether it goes on by chance.
    pub roulette: Option<Roulette>,
}

/// Russian roulette.
#[derive(Clone, Debug, PartialEq)]
pub struct Roulette {
    /// How likely the path was to go on.
    pub survival: f64,
    /// The number that was drawn; the path goes on where it is smaller.
    pub drawn: f64,
}

/// Why a path ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ended {
    /// It has hit nothing.
    Left,
    /// Lights reflect nothing.
    AtLight,
    /// `max_bounces`; a last ray may have looked for lights.
    Bounces,
    /// `render.integrator: Direct` follows light over no rough surface.
    Direct,
    /// Roulette.
    Roulette,
    /// Nothing is scattered that way, or the material is black.
    Nothing,
}

/// What the techniques make of a sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Whole {
    /// What each way brings, in the order in which it comes: paths, rays that were aimed, then techniques by name.
    pub brought: Vec<Brought>,
    /// What rounding in single precision makes of their sum.
    pub rounding: [f64; 3],
    /// What clamping takes.
    pub taken: [f64; 3],
    /// What the film adds: all of the above.
    pub radiance: [f64; 3],
    /// Aimed rays of this pixel.
    pub aimed: u32,
    /// Where the path shares.
    pub shared: Option<Shared>,
    /// The batch that makes pictures has the same, and rounding is no more than rounding.
    pub agrees: bool,
}

/// What one way brings.
#[derive(Clone, Debug, PartialEq)]
pub struct Brought {
    /// Which.
    pub by: &'static str,
    /// What.
    pub radiance: [f64; 3],
}

/// What a pixel shares with others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shared {
    /// Pixels that share, this one included.
    pub pixels: u32,
    /// Second vertices that their paths have found.
    pub found: u32,
    /// Those of them that this pixel's vertex sees.
    pub seen: u32,
}
