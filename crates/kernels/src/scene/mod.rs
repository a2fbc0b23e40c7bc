//! The compiled scene: `Sync`, in render space, made by `tracer_core::compile` and only read afterwards. Rendering it
//! cannot fail. Its public fields are for looking at: the engine reads the tables beside them, which are not built
//! anew when a field is changed.
//!
//! Render space is the person's world, moved so that the middle of what is seen is the origin and scaled by a power of
//! two so that its size is about one ([`Frame`]): single precision is then spent where it counts, wherever and however
//! large the scene is.

mod camera;
mod colors;
mod environment;
mod frame;
mod glow;
mod light;
pub mod materials;
mod mesh;
mod met;
mod motion;
mod occluders;
mod pattern;
mod place;
mod plane;
mod program;
mod shape;
mod sphere;
mod statistics;
mod table;
mod texture;

pub use camera::{Camera, Filter, FisheyeMapping, Lens, Projection, Stereo};
pub use colors::{Coded, ColorTable, MeshColors, VertexSpace};
pub use environment::Environment;
pub use frame::Frame;
pub use glow::Glow;
pub use light::LightTable;
pub use light::{CurvedLight, CurvedRow, FlatLight, Light};
pub use materials::{Albedo, Material};
pub use materials::{ConductorTable, GGX_STEPS, LEAST_ALPHA, LEAST_EXPONENT, Lobe, MaterialTable, NARROWEST_ALPHA};
pub use mesh::InstanceTable;
pub use mesh::{Instance, Mesh, Triangles};
pub use met::{CameraSees, Met};
pub use motion::{End, Ends};
pub use occluders::OccluderTable;
pub use pattern::{
    GradientAxis, NoiseKind, Pattern, PatternKey, PatternKind, PatternTable, Space, VoronoiFeature, Written,
};
pub(crate) use pattern::{STRIDE, kind as pattern_kind, voronoi_feature};
pub use place::Seen;
pub use plane::{Plane, PlaneTable};
pub use program::{Between, Made, Op, PLACES, Program};
pub use shape::{Operand, Shape, Solids, Step};
pub use shape::{OperandRow, ShapeTable};
pub use sphere::Sphere;
pub use sphere::{LargeSphere, SmallSphere, SphereTable};
pub use statistics::{Statistics, WorldBounds};
pub(crate) use table::Table;
pub use texture::{Picture, Texels, TextureFilter, TextureTable, TextureUse, TextureWrap};
pub use texture::{Texel, TextureView};

use crate::bvh::Acceleration;
use std::sync::Arc;

/// No primitive, no instance.
pub const NONE: u32 = u32::MAX;

/// When the pixels of a block share what they find.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sharing {
    /// Every pixel for itself.
    Never,
    /// Where a trial finds that hardly a path leaves the scene for its background.
    Indoors,
    /// Whatever the scene.
    Always,
}

/// What is rendered of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Integrator {
    /// All light.
    Paths,
    /// Light that comes straight to what the camera sees, also in mirrors and through glass.
    Direct,
    /// How much is free of what lies above each surface.
    AmbientOcclusion {
        /// What is further off does not count; in render space, may be infinite.
        distance: f32,
    },
}

/// A compiled scene. What is large in it is shared by its clones.
#[derive(Clone)]
pub struct Scene {
    /// Where render space lies in the person's world.
    pub frame: Frame,
    /// Camera and pixel filter.
    pub camera: Camera,
    /// Picture size in pixels: width, height.
    pub size: [u32; 2],
    /// Samples per pixel, unless the caller says otherwise.
    pub samples: u32,
    /// Scattering events after the first hit.
    pub max_bounces: u32,
    /// Seed of all random choices, unless the caller says otherwise.
    pub seed: u32,
    /// What the picture is of.
    pub integrator: Integrator,
    /// Whether the pixels of a block share what they find, unless the caller says otherwise.
    pub reuse: Sharing,
    /// Whether photons carry the light that reaches diffuse surfaces over mirrors and glass, unless the caller says
    /// otherwise.
    pub caustics: bool,
    /// The most that the largest channel of a sample counts, unless the caller says otherwise; `None`: no limit.
    pub clamp: Option<f32>,
    /// The relative noise at which rendering ends, unless the caller says otherwise.
    pub noise: Option<f64>,
    /// Whether quiet tiles take fewer samples, unless the caller says otherwise.
    pub adaptive: Option<bool>,
    /// Seconds after which rendering ends, unless the caller says otherwise.
    pub time: Option<f64>,
    /// What is kept of what camera rays hit first, unless the caller says otherwise.
    pub layers: crate::layers::LayerSet,
    /// What camera rays see behind everything is to be told from the rest: each sample has one camera ray then.
    pub backdrop: bool,
    /// What a radiance of one in this scene stands for, in W/(sr m^2): a power of two, so that the brightest light or
    /// background is from 1 to 2 and the range of `f32` and of the film's sums lies where the scene's numbers are. All
    /// of a film that is read is in W/(sr m^2) again.
    pub radiance_unit: f64,
    /// Radiance of everything that no object covers, in `radiance_unit`, where it is the same in all directions; black
    /// where it is [`Scene::environment`].
    pub background: [f32; 3],
    /// Spheres of objects and lights, in the order of their primitive ids 0 .. `spheres.len()`.
    pub spheres: Arc<Vec<Sphere>>,
    /// Curved shapes that are no spheres, and behind them planes without an end. Shape k has primitive id
    /// `spheres.len() + k`.
    pub shapes: Arc<Vec<Shape>>,
    /// What those of them are made of that are made of several.
    pub solids: Arc<Solids>,
    /// Materials; surfaces name them by index.
    pub materials: Arc<Vec<Material>>,
    /// Lights: the spheres, then the other curved ones, then the flat ones.
    pub lights: Vec<Light>,
    /// Meshes, each once.
    pub meshes: Arc<Vec<Mesh>>,
    /// The triangles of all meshes. Triangle k has primitive id `spheres.len() + shapes.len() + k`.
    pub triangles: Arc<Triangles>,
    /// Meshes placed in the scene.
    pub instances: Arc<Vec<Instance>>,
    /// What finds the hits.
    pub acceleration: Acceleration,
    /// The scene as tables for the engine.
    pub tables: Tables,
    /// The tree over meshes and many spheres; `None` when there are neither.
    pub accel: Option<Arc<crate::bvh::Accel>>,
    /// What camera rays meet, where not all of it.
    pub camera_sees: Option<Arc<CameraSees>>,
    /// The boxes under the root of the bounding volume hierarchy, also where another structure finds the hits.
    pub top_boxes: Option<crate::bvh::TopBoxes>,
    /// The boxes under those.
    pub second_boxes: Option<crate::bvh::SecondBoxes>,
    /// All of that, where it is little.
    pub occluders: Option<Arc<OccluderTable>>,
    /// It as the shutter opens and closes, where something moves and a layer is to tell how.
    pub ends: Option<Arc<Ends>>,
}

impl Scene {
    /// The picture of all directions behind everything, if there is one.
    pub fn environment(&self) -> Option<&Environment> {
        self.tables.lights.environment.as_deref()
    }

    /// Whether light comes from where no object is.
    pub fn is_open(&self) -> bool {
        self.background.iter().any(|&x| x > 0.0) || self.environment().is_some()
    }

    /// Whether light comes that is never asked for, so that rays go on from the last vertices, too: that of a
    /// background or of a sky.
    pub fn is_under_sky(&self) -> bool {
        self.is_open() || self.tables.lights.has_sky
    }

    /// The same scene in which only some of the lights shine: those of which `shines` is true, by their index, and the
    /// background where `background` is. The others are there, and dark. All but the lights is shared with this one.
    pub fn lit_by(&self, shines: impl Fn(usize) -> bool, background: bool) -> Scene {
        let mut lit = self.clone();
        for (_, light) in lit.lights.iter_mut().enumerate().filter(|(k, _)| !shines(*k)) {
            light.darken();
        }
        let environment = self.tables.lights.environment.clone().filter(|_| background);
        let glow = self.tables.lights.glow.clone();
        lit.tables.lights = LightTable::with_glow(&lit.lights, &lit.spheres, environment, glow);
        if !background {
            lit.background = [0.0; 3];
        }
        if lit.reuse == Sharing::Indoors && !lit.is_under_sky() {
            lit.reuse = Sharing::Always;
        }
        lit
    }

    /// A texture, by the index in [`Albedo::Texture`].
    pub fn texture(&self, index: u32) -> Option<TextureView<'_>> {
        self.tables.textures.view(index)
    }

    /// Whether bodies that let light through touch anywhere.
    pub fn has_touching(&self) -> bool {
        self.accel.as_deref().is_some_and(crate::bvh::Accel::has_touching)
    }

    /// A texture that is reckoned, by the index in [`Albedo::Pattern`].
    pub fn pattern(&self, index: u32) -> Option<&Pattern> {
        self.tables.patterns.patterns.get(index as usize)
    }

    /// A texture made of others, by the index in [`Albedo::Program`].
    pub fn program(&self, index: u32) -> Option<&Program> {
        self.tables.patterns.programs.get(index as usize)
    }

    /// Rows of the 3x4 matrix from render space to the coordinates that a surface is written in, before its transforms;
    /// `body`: the number of the sphere, behind the spheres that of the shape, behind those that of the instance,
    /// behind those that of a solid's operand; `None`: to the world's. `None` where no pattern asks for it.
    pub fn to_object(&self, body: Option<u32>) -> Option<[[f64; 4]; 3]> {
        let patterns = &self.tables.patterns;
        let entry = body.map_or(Some(0), |body| patterns.entry.get(body as usize).copied())?;
        patterns.maps.get(entry as usize).copied()
    }
}

/// The scene as the engine reads it: structures of arrays, padded for whole-register loads and look-ups.
#[derive(Clone)]
pub struct Tables {
    /// Spheres.
    pub spheres: Arc<SphereTable>,
    /// Curved shapes and planes.
    pub shapes: Arc<ShapeTable>,
    /// Planes, as rays are tested with them.
    pub planes: Arc<PlaneTable>,
    /// Materials.
    pub materials: Arc<MaterialTable>,
    /// Lights.
    pub lights: LightTable,
    /// Textures.
    pub textures: Arc<TextureTable>,
    /// Patterns.
    pub patterns: Arc<PatternTable>,
    /// The colours of vertices.
    pub colors: Arc<ColorTable>,
    /// Instances.
    pub instances: Arc<InstanceTable>,
}

impl Tables {
    /// Spheres and shapes: the primitive id of the first triangle.
    #[inline(always)]
    pub fn loose(&self) -> u32 {
        self.spheres.len + self.shapes.rows.len() as u32
    }
}
