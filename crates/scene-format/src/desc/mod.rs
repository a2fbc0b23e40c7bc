//! `SceneDesc`: what the person wrote, complete (every default filled in) and valid; every item knows its position.
//!
//! Lengths are in the scene's own unit; angles in degrees; colours are linear RGB (sRGB primaries); radiometric
//! values per channel. All of it is serde's (`serde_types`): nothing is derived, since what is read goes through the
//! spanned tree and its checks, whoever reads.
//!
//! The types are declared by the macros of `words`: the doc comments, defaults and ranges that stand here are the ones
//! that the reader goes by and that the reference and the JSON Schema show.
//!
//! The enums are exhaustive on purpose: whoever walks a scene wants the compiler to name the kinds that he has not
//! thought of. So a new kind, field or word comes with a new minor version (0.2 after 0.1), never with a patch.

mod amount;
mod animation;
mod background;
mod camera;
mod cameras;
mod effects;
mod fit_to;
pub(crate) mod group;
mod include;
mod lens;
mod light;
mod light_group;
mod materials;
pub(crate) mod matrix;
mod moments;
mod name;
mod object;
mod output;
mod per_axis;
mod shapes;
mod stereo;
mod textures;
mod transform;
mod view;

pub use amount::{Amount, Radiometric};
pub use animation::Animation;
pub(crate) use animation::Film;
pub(crate) use background::BackgroundWords;
pub use background::{Background, Environment};
pub use camera::{Camera, FisheyeMapping, FovAxis, Projection};
pub use cameras::NamedCamera;
pub(crate) use cameras::{CameraChoice, Chosen};
pub use effects::{Effects, PixelFilter, ToneMap};
pub use group::endless_group;
pub(crate) use group::{ITEMS, MOST_NESTED, Objects};
pub(crate) use include::IncludeWords;
pub(crate) use lens::DepthOfField;
pub use lens::{Focus, ThinLens};
pub use light::{Light, SphereLight};
pub use light_group::LightGroup;
pub use materials::{
    BlinnPhong, Conductor, Diffuse, Emissive, Material, MaterialRef, Metal, Mirror, NamedMaterial, Reflectance,
    Transparent,
};
pub use moments::Moments;
pub(crate) use moments::Texts;
pub use name::Name;
pub use object::{Faulty, Object, cannot_shine, no_power_of_solid, with_operands};
pub(crate) use object::{ShapeWords, no_length};
pub use output::{Layer, Mark, MaskName, Matte, Output};
pub use per_axis::PerAxis;
pub use shapes::{
    Arrow, Capsule, Cone, Copies, Corners, Curve, Cylinder, Difference, Disk, Extrude, Faces, Groups, HeightField,
    InlineMesh, Instances, Intersection, Lathe, Mesh, MeshSource, Moved, Operands, Outline, Part, PathPoints,
    PlacementList, PlacementPattern, Placements, Plane, Polygon, Profile, Radii, RectBox, Rectangle, Shading, Sphere,
    Torus, Tube, TubeCurve, Turning, Union, Within, no_extent,
};
pub(crate) use stereo::Stereoscopy;
pub use stereo::{Stereo, StereoLayout};
pub use textures::{
    Albedo, Checkerboard, ColorRamp, Dots, Gradient, GradientAxis, Lines, LinesAlong, Mapping, Marble, Mix, Multiply,
    NamedTexture, Noise, NoiseKind, Number, Pattern, Planar, RampInterpolation, SolidMapping, Spherical, Stop, Stops,
    Texture, TextureChannel, TextureColorSpace, TextureFilter, TextureWrap, Triplanar, Uv, VertexColor,
    VertexColorSpace, Voronoi, VoronoiFeature, Wood,
};
pub(crate) use textures::{MappingWords, Nested, PatternWords, is_color, is_texture};
pub(crate) use transform::TransformWords;
pub use transform::{Extent, Transform};
pub use view::{Acceleration, Adaptive, Caustics, Image, Indirect, Integrator, Render, Reuse};

use crate::diagnostic::{Source, Spanned};
use crate::files::FileKind;
use crate::read::{Includes, Vars};
use crate::schema::Rule;
use crate::words::scene_struct;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A point or direction (x, y, z) in the scene's unit.
pub type Vec3 = [f64; 3];

/// Linear RGB.
pub type Color = [f64; 3];

/// The version of the language that this crate reads.
pub const VERSION: u32 = 1;

/// A whole scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneDesc {
    /// Version of the language.
    pub version: u32,
    /// Frames and time: the scene is as it is seen in its `frame`.
    pub animation: Animation,
    /// The camera that is meant.
    pub camera: Camera,
    /// Its name, where it is one of `cameras`.
    pub camera_name: Option<Arc<str>>,
    /// All cameras that have names.
    pub cameras: Vec<NamedCamera>,
    /// The picture's size.
    pub image: Image,
    /// How to render.
    pub render: Render,
    /// Film and lens effects.
    pub effects: Effects,
    /// What is written beside the picture.
    pub output: Output,
    /// Radiance of everything that no object covers.
    pub background: Background,
    /// Lights.
    pub lights: Vec<Spanned<Light>>,
    /// Named textures in order of writing. Whoever uses one holds it, too: [`Albedo::Named`].
    pub textures: Vec<Arc<NamedTexture>>,
    /// Named materials in order of writing.
    pub materials: Vec<NamedMaterial>,
    /// Objects.
    pub objects: Vec<Spanned<Object>>,
    /// Folder that relative paths start from.
    pub base_dir: PathBuf,
    /// The texts that spans point into.
    pub sources: Vec<Source>,
    /// The scene files that it includes, relative to `base_dir`.
    pub includes: Vec<Arc<Path>>,
    /// Where it moves while the shutter is open: what it is read of again ([`SceneDesc::at`]).
    pub moments: Moments,
}

scene_struct! {
    /// A whole scene: one file.
    pub(crate) struct Scene as "Scene", "the scene" {
        /// Version of the language. Files of version 1 load for ever.
        version: u32 = VERSION => Rule::within("version", 1.0, 1.0);
        /// Files whose `vars`, `textures`, `materials`, `cameras`, `image`, `render`, `effects`, `output` and
        /// `background` are taken as if they stood here, but that what this file says wins, name by name and field by
        /// field, and of two files what the later says. Paths in a file start from its folder.
        include: Includes = Includes => Rule::file(FileKind::Scene);
        /// Values by name, for expressions: texts that begin with `=`, which may stand for any number, vector, colour
        /// or truth value.
        vars: Vars = Vars;
        /// Frames and time, for expressions.
        animation: Film = Film::default();
        /// Cameras by name.
        cameras: Vec<NamedCamera> = Vec::new();
        /// The camera, or the name of one of `cameras`, as `--camera` chooses it. It may be left out where there is one
        /// among `cameras`, or none; those of files that are included count where the scene has none of its own.
        camera: CameraChoice = CameraChoice::Only;
        /// The picture's size.
        image: Image = Image::default();
        /// How to render.
        render: Render = Render::default();
        /// Film and lens effects.
        effects: Effects = Effects::default();
        /// What is written beside the picture.
        output: Output = Output::default();
        /// Radiance of everything that no object covers.
        background: Background = Background::default() => Rule::light("in W/(sr m^2)");
        /// Lights. A scene needs one, or a background.
        lights: Vec<Spanned<Light>> = Vec::new();
        /// Textures by name, for colours of materials and of other textures: `albedo: "bricks"`. A text that begins
        /// with `#` is a colour there, and one that begins with `=` an expression; any other is a name.
        textures: Vec<Arc<NamedTexture>> = Vec::new() => Rule::share();
        /// Materials by name, for objects to use.
        materials: Vec<NamedMaterial> = Vec::new();
        /// What is to be seen; at least one.
        objects: Objects = Objects(Vec::new());
    }
}

impl Default for SceneDesc {
    fn default() -> Self {
        SceneDesc {
            version: VERSION,
            animation: Animation::default(),
            camera: Camera::default(),
            camera_name: None,
            cameras: Vec::new(),
            image: Image::default(),
            render: Render::default(),
            effects: Effects::default(),
            output: Output::default(),
            background: Background::default(),
            lights: Vec::new(),
            textures: Vec::new(),
            materials: Vec::new(),
            objects: Vec::new(),
            base_dir: PathBuf::new(),
            sources: Vec::new(),
            includes: Vec::new(),
            moments: Moments::default(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Spanned;

    /// A scene may have millions of these; `tests/memory.rs` says why they must be small. Of a mesh more than 120 bytes
    /// would be more than ten times its text.
    #[test]
    fn what_scenes_have_many_of_is_small() {
        assert_eq!(size_of::<Spanned<Object>>(), 32);
        assert_eq!(size_of::<Mesh>(), 120);
        assert_eq!(size_of::<Placements>(), 8);
        assert_eq!(size_of::<NamedMaterial>(), 88);
        assert_eq!(size_of::<Spanned<Transform>>(), 64);
    }
}
