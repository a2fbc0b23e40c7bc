//! `SceneDesc`: what the person wrote, complete (every default filled in) and valid; every item knows its position.
//!
//! Lengths are in the scene's own unit; angles in degrees; colours are linear RGB (sRGB primaries); radiometric values per
//! channel. `serde` is not derived here on purpose: reading goes through the spanned tree, so that faults have positions.

use crate::diagnostic::{Source, Spanned};
use std::path::PathBuf;

/// A point or direction (x, y, z) in the scene's unit.
pub type Vec3 = [f64; 3];

/// Linear RGB.
pub type Color = [f64; 3];

/// A whole scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneDesc {
    /// Version of the language.
    pub version: u32,
    /// The camera.
    pub camera: Camera,
    /// The picture's size.
    pub image: Image,
    /// How to render.
    pub render: Render,
    /// Film and lens effects.
    pub effects: Effects,
    /// Radiance of everything that no object covers.
    pub background: Color,
    /// Lights.
    pub lights: Vec<Spanned<Light>>,
    /// Named materials in order of writing.
    pub materials: Vec<NamedMaterial>,
    /// Objects.
    pub objects: Vec<Spanned<Object>>,
    /// Folder that relative paths start from.
    pub base_dir: PathBuf,
    /// The texts that spans point into.
    pub sources: Vec<Source>,
}

/// A pinhole or thin-lens camera.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Eye point.
    pub position: Spanned<Vec3>,
    /// A point in the middle of the picture.
    pub look_at: Spanned<Vec3>,
    /// The direction that is up in the picture.
    pub up: Spanned<Vec3>,
    /// Vertical field of view in degrees.
    pub fov: Spanned<f64>,
}

/// Size of the picture in pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// Pixels across.
    pub width: Spanned<u32>,
    /// Pixels down.
    pub height: Spanned<u32>,
}

/// How to render.
#[derive(Clone, Debug, PartialEq)]
pub struct Render {
    /// Camera samples per pixel.
    pub samples: Spanned<u32>,
    /// Scattering events after the first hit: a path has at most `max_bounces + 1` segments from the camera through surfaces,
    /// and one more to a light.
    pub max_bounces: Spanned<u32>,
    /// Seed of all random choices.
    pub seed: Spanned<u32>,
    /// What finds the hits; the picture is the same, byte for byte.
    pub acceleration: Acceleration,
}

/// What finds the hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Acceleration {
    /// A bounding volume hierarchy.
    #[default]
    Bvh,
    /// One bounding box per mesh, every triangle inside it tested.
    BoundingBox,
    /// Every triangle tested for every ray.
    None,
}

/// Film and lens effects.
#[derive(Clone, Debug, PartialEq)]
pub struct Effects {
    /// The pixel's reconstruction filter.
    pub antialiasing: PixelFilter,
    /// Lens; `None` is a pinhole.
    pub depth_of_field: Option<ThinLens>,
    /// Exposure in stops: the radiance is multiplied by 2^exposure.
    pub exposure: Spanned<f64>,
    /// Curve from exposed radiance to display.
    pub tone_map: ToneMap,
}

/// The pixel's reconstruction filter, by filter importance sampling.
#[derive(Clone, Debug, PartialEq)]
pub enum PixelFilter {
    /// Every sample through the pixel's centre.
    None,
    /// The pixel's square.
    Box,
    /// A Gaussian of this standard deviation, in pixels.
    Gaussian {
        /// Standard deviation in pixels.
        sigma: Spanned<f64>,
    },
    /// The Blackman-Harris window, 4 terms, of this radius in pixels.
    BlackmanHarris {
        /// Half width in pixels.
        radius: Spanned<f64>,
    },
}

/// A thin lens: a disc-shaped aperture, sharp at the plane of focus.
#[derive(Clone, Debug, PartialEq)]
pub struct ThinLens {
    /// Diameter of the lens, in the scene's unit.
    pub aperture: Spanned<f64>,
    /// Distance from the eye to the plane of focus, along the view axis.
    pub focus_distance: Spanned<f64>,
}

/// Curve from exposed radiance to display values, before sRGB encoding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum ToneMap {
    /// Clip to 0..1.
    #[default]
    None,
    /// A filmic curve per channel.
    Filmic,
    /// An AgX-like curve: bright colours go to white.
    AgX,
}

/// A light.
#[derive(Clone, Debug, PartialEq)]
pub enum Light {
    /// A luminous sphere; it emits and does not reflect.
    SphereLight(SphereLight),
}

/// A luminous sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct SphereLight {
    /// Centre.
    pub center: Spanned<Vec3>,
    /// Radius.
    pub radius: Spanned<f64>,
    /// How much light.
    pub emission: Spanned<Emission>,
}

/// How much light a sphere gives, per channel.
#[derive(Clone, Debug, PartialEq)]
pub enum Emission {
    /// Radiant intensity in W/sr: L = I / (pi r^2).
    Intensity(Color),
    /// Radiance in W/(sr m^2).
    Radiance(Color),
    /// Power in W: L = P / (4 pi^2 r^2).
    Power(Color),
}

/// A material with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// The name.
    pub name: Spanned<String>,
    /// The material.
    pub material: Material,
}

/// How a surface scatters light.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Lambert: albedo / pi.
    Diffuse {
        /// Reflected share per channel.
        albedo: Albedo,
    },
    /// A perfect mirror.
    Mirror {
        /// Reflected share per channel.
        reflectance: Spanned<Color>,
    },
    /// A smooth dielectric: exact Fresnel reflection and refraction.
    Transparent {
        /// Index of refraction of the inside against the outside.
        ior: Spanned<f64>,
        /// Share of refracted light that passes each surface, per channel.
        transmittance: Spanned<Color>,
    },
    /// Blinn-Phong: albedo * ((1 - s)/pi + s (alpha + 2)/(2 pi) cos^alpha theta_h).
    BlinnPhong {
        /// Colour of both lobes.
        albedo: Albedo,
        /// alpha: 1 is dull, 100000 nearly a mirror.
        exponent: Spanned<f64>,
        /// s: share of the glossy lobe, 0 to 1.
        specular: Spanned<f64>,
        /// The glossy lobe after Ashikhmin and Shirley, that never reflects more than it gets.
        energy_conserving: bool,
    },
}

/// A colour, constant or from a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Albedo {
    /// The same everywhere.
    Color(Spanned<Color>),
    /// From a picture.
    Texture(Texture),
}

/// A picture laid over a surface by `vt` on meshes and by longitude and latitude on spheres.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// PNG or JPEG, relative to the scene file.
    pub file: Spanned<PathBuf>,
    /// Between texels.
    pub filter: TextureFilter,
    /// Beyond the borders.
    pub wrap: TextureWrap,
}

/// Between texels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum TextureFilter {
    /// Linear between the four nearest.
    #[default]
    Bilinear,
    /// The nearest texel.
    Nearest,
}

/// Beyond the borders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum TextureWrap {
    /// Tiles.
    #[default]
    Repeat,
    /// The border texel goes on.
    Clamp,
    /// Tiles, every second one mirrored.
    Mirror,
}

/// A thing in the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Object {
    /// A sphere.
    Sphere(Sphere),
    /// A triangle mesh from a file.
    Mesh(Mesh),
}

/// A sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Sphere {
    /// Centre.
    pub center: Spanned<Vec3>,
    /// Radius.
    pub radius: Spanned<f64>,
    /// Its material.
    pub material: MaterialRef,
}

/// A triangle mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// OFF or OBJ file, relative to the scene file.
    pub file: Spanned<PathBuf>,
    /// Its material; `Default`: what the file's MTL says, else the default material.
    pub material: MaterialRef,
    /// Transforms, applied first to last.
    pub transform: Vec<Spanned<Transform>>,
    /// Copies: each placement is applied after `transform`. Empty: one, where `transform` puts it.
    pub placements: Placements,
    /// Whether normals are interpolated.
    pub shading: Shading,
}

/// Whether normals are interpolated over triangles (Phong smoothing).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Shading {
    /// Smooth when the file has vertex normals, else flat.
    #[default]
    Auto,
    /// Smooth: by the file's vertex normals, or by area- and angle-weighted ones where it has none.
    Smooth,
    /// Flat: the triangles' own normals.
    Flat,
}

/// Many copies of one mesh.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum Placements {
    /// One copy, where `transform` puts it.
    #[default]
    One,
    /// Copies, each with its own transforms (about the origin of the scene unless they say `about`).
    List(Vec<Vec<Spanned<Transform>>>),
    /// A text file of placements, one a line, relative to the scene file.
    File(Spanned<PathBuf>),
}

/// One step of a mesh's way into the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Transform {
    /// Moves by a vector.
    Translate(Vec3),
    /// Scales per axis.
    Scale {
        /// Factor per axis; negative mirrors.
        factor: Vec3,
        /// Fixed point; `None`: the barycentre (mean of the vertices).
        about: Option<Vec3>,
    },
    /// Rotates by the right-hand rule.
    Rotate {
        /// Axis of rotation (any length but zero).
        axis: Vec3,
        /// Angle in degrees.
        degrees: f64,
        /// Fixed point; `None`: the barycentre (mean of the vertices).
        about: Option<Vec3>,
    },
    /// Moves along y so that the lowest vertex lies at this height.
    DropTo {
        /// Height of the lowest vertex.
        y: f64,
    },
}

/// Which material an object has.
#[derive(Clone, Debug, PartialEq, Default)]
pub enum MaterialRef {
    /// None was written.
    #[default]
    Default,
    /// By name.
    Named(Spanned<String>),
    /// Written inline.
    Inline(Box<Spanned<Material>>),
}

impl Default for Camera {
    fn default() -> Self {
        Camera {
            position: [0.0, 0.0, 5.0].into(),
            look_at: [0.0, 0.0, 0.0].into(),
            up: [0.0, 1.0, 0.0].into(),
            fov: 40.0.into(),
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
        Render { samples: 64.into(), max_bounces: 5.into(), seed: 0.into(), acceleration: Acceleration::Bvh }
    }
}

impl Default for PixelFilter {
    fn default() -> Self {
        PixelFilter::Gaussian { sigma: 0.4.into() }
    }
}

impl Default for Effects {
    fn default() -> Self {
        Effects {
            antialiasing: PixelFilter::default(),
            depth_of_field: None,
            exposure: 0.0.into(),
            tone_map: ToneMap::None,
        }
    }
}

impl Default for Albedo {
    fn default() -> Self {
        Albedo::Color([0.8; 3].into())
    }
}

impl Default for Material {
    fn default() -> Self {
        Material::Diffuse { albedo: Albedo::default() }
    }
}

impl Default for SceneDesc {
    fn default() -> Self {
        SceneDesc {
            version: 1,
            camera: Camera::default(),
            image: Image::default(),
            render: Render::default(),
            effects: Effects::default(),
            background: [0.0; 3],
            lights: Vec::new(),
            materials: Vec::new(),
            objects: Vec::new(),
            base_dir: PathBuf::new(),
            sources: Vec::new(),
        }
    }
}
