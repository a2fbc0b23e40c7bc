//! A scene in render space with its tables: all that is rendered, before there are trees, and with them.

use super::assets::Sources;
use super::materials::Finished;
use super::measured::Measured;
use super::shaped::Shaped;
use super::trees::{Hung, Trees};
use super::{CompileError, Like, Objects, environment, light_groups};
use crate::develop::Backdrop;
use crate::scene::{LightGroups, backdrop, film_layers};
use crate::texture::Texture;
use scene_format::desc::{Acceleration, Adaptive, Caustics, Indirect, Integrator, Reuse};
use scene_format::diagnostic::Span;
use scene_format::{Diagnostic, Diagnostics, SceneDesc, codes};
use std::sync::Arc;
use tracer_kernels::bvh;
use tracer_kernels::scene::{
    self, Frame, InstanceTable, LightTable, Material, MaterialTable, OccluderTable, PatternTable, Picture, PlaneTable,
    Scene, ShapeTable, Sharing, SphereTable, Tables, TextureTable, TextureUse, Written,
};

/// Of so many triangles at most a scene has a table of what can hide points from each other.
const OCCLUDERS: usize = 256;

/// All that is rendered but the trees, and those tables that wait for them.
pub(super) struct Prepared {
    measured: Measured,
    /// Where it is the same in all directions.
    background: [f32; 3],
    /// No light comes from behind everything.
    is_dark: bool,
    shaped: Shaped,
    materials: Vec<Material>,
    images: Vec<Arc<Texture>>,
    uses: Vec<TextureUse>,
    sphere_table: SphereTable,
    plane_table: PlaneTable,
    material_table: MaterialTable,
    light_table: LightTable,
    pattern_table: PatternTable,
    /// The first of the triangles' bodies.
    first_body: u32,
}

impl Prepared {
    /// Brings everything into render space and into tables.
    pub(super) fn new(
        desc: &SceneDesc,
        objects: Objects,
        finished: Finished,
        background: environment::Loaded<'_>,
        like: Like,
        diagnostics: &mut Diagnostics,
    ) -> Self {
        let behind = background.brightest();
        let (measured, mesh_radiances) = Measured::new(desc, &objects, behind, like, diagnostics);
        let (background, environment) = background.build(measured.radiance_unit);
        diagnostics.extend(map_is_gone(desc));
        let mut shaped = Shaped::new(desc, objects, mesh_radiances, &finished, &measured, diagnostics);
        let maps = shaped.written.take();
        let Finished { materials, images, uses, patterns, programs } = finished;
        let Shaped { spheres, shapes, solids, lights, built, .. } = &shaped;
        let material_table = MaterialTable::new(&materials, uses.len() as u32, (uses.len() + patterns.len()) as u32);
        let sphere_table = SphereTable::new(spheres, material_table.emitter);
        let plane_table = PlaneTable::new(shapes, spheres.len() as u32);
        let light_table = LightTable::new(lights, spheres, environment.map(Arc::new));
        let written = maps.map_or_else(Written::default, |maps| {
            Written::new(maps, spheres, shapes, &built.coordinates, &solids.operands)
        });
        let first_body = (spheres.len() + shapes.len() + built.copies.len()) as u32;
        let pattern_table = PatternTable::new(patterns, programs, &measured.frame, written);
        Prepared {
            measured,
            background,
            is_dark: behind == [0.0; 3],
            shaped,
            materials,
            images,
            uses,
            sphere_table,
            plane_table,
            material_table,
            light_table,
            pattern_table,
            first_body,
        }
    }

    /// Builds the trees.
    ///
    /// # Errors
    /// The scene cannot be traced.
    pub(super) fn trees(&self, desc: &SceneDesc, sources: &Sources<'_>) -> Result<Trees, CompileError> {
        let hung = Hung {
            spheres: &self.shaped.spheres,
            in_tree: self.sphere_table.in_tree,
            shapes: &self.shaped.shapes,
            solids: &self.shaped.solids,
            built: &self.shaped.built,
            materials: &self.materials,
            sources,
        };
        hung.trees(desc, acceleration(desc.render.acceleration), &self.sphere_table, &self.plane_table)
    }

    /// The scene with its trees, and the groups of its lights where they are told apart.
    pub(super) fn rendered(self, desc: &SceneDesc, trees: Trees) -> (Scene, Option<LightGroups>) {
        let Measured { frame, camera, radiance_unit } = self.measured;
        let Shaped { spheres, shapes, solids, solid_groups, lights, built, colors, .. } = self.shaped;
        // Only now: nothing else takes as much as a tree that is being built.
        let instances = built.instances();
        drop((built.copies, built.of_copies));
        let instance_table = InstanceTable::new(&instances);
        let full = desc.render.integrator == Integrator::Full;
        let hierarchy = trees.hierarchy.as_deref();
        let mut rendered = Scene {
            frame,
            camera,
            size: [desc.image.width.value, desc.image.height.value],
            samples: desc.render.samples.value,
            max_bounces: desc.render.max_bounces.value,
            seed: desc.render.seed.value,
            integrator: integrator(&desc.render.integrator, &frame),
            reuse: match desc.render.reuse {
                Reuse::Blocks if full && self.is_dark && !self.light_table.has_sky => Sharing::Always,
                Reuse::Blocks if full => Sharing::Indoors,
                _ => Sharing::Never,
            },
            caustics: full && desc.render.caustics == Caustics::Photons,
            clamp: desc.render.clamp.as_ref().map(|limit| limit.value as f32),
            noise: desc.render.noise.as_ref().map(|goal| goal.value),
            adaptive: match desc.render.adaptive {
                Adaptive::WithNoise => None,
                Adaptive::Always => Some(true),
                Adaptive::Never => Some(false),
            },
            time: desc.render.time.as_ref().map(|seconds| seconds.value),
            layers: film_layers(&desc.output),
            backdrop: backdrop(&desc.output) != Backdrop::Background,
            radiance_unit,
            background: self.background,
            spheres: spheres.into(),
            tables: Tables {
                spheres: self.sphere_table.into(),
                shapes: ShapeTable::new(&shapes, &solids, self.first_body).into(),
                planes: self.plane_table.into(),
                materials: self.material_table.into(),
                lights: self.light_table,
                textures: texture_table(&self.images, &self.uses).into(),
                patterns: self.pattern_table.into(),
                colors: colors.into(),
                instances: instance_table.into(),
            },
            shapes: shapes.into(),
            solids: solids.into(),
            materials: self.materials.into(),
            lights,
            meshes: built.meshes.into(),
            triangles: built.triangles.into(),
            instances: instances.into(),
            accel: trees.accel,
            camera_sees: trees.camera_sees,
            top_boxes: hierarchy.map(|accel| *accel.top_boxes()),
            second_boxes: hierarchy.map(|accel| *accel.second_boxes()),
            occluders: hierarchy.filter(|_| full).and_then(|accel| OccluderTable::new(accel, OCCLUDERS)).map(Arc::new),
            acceleration: acceleration(desc.render.acceleration),
            ends: None,
        };
        tracer_kernels::engine::glow::measure(&mut rendered);
        let light_groups = desc.output.light_groups.then(|| light_groups::of(desc, &rendered, &solid_groups));
        (rendered, light_groups)
    }
}

fn texture_table(images: &[Arc<Texture>], uses: &[TextureUse]) -> TextureTable {
    let pictures =
        images.iter().map(|image| Picture { width: image.width, height: image.height, texels: &image.texels });
    TextureTable::new(pictures, uses)
}

/// A warning where a scene asks for what there is no more.
fn map_is_gone(desc: &SceneDesc) -> Option<Diagnostic> {
    let message = "there is no map of indirect light any more: it comes by paths";
    (desc.render.indirect == Indirect::Map)
        .then(|| Diagnostic::warning(codes::MAP_IS_GONE, Span::NONE, message).hint("leave `render.indirect` out"))
}

/// What is rendered.
fn integrator(words: &Integrator, frame: &Frame) -> scene::Integrator {
    match words {
        Integrator::Full | Integrator::Path => scene::Integrator::Paths,
        Integrator::Direct => scene::Integrator::Direct,
        Integrator::AmbientOcclusion { distance } => {
            let distance = distance.as_ref().map_or(f64::INFINITY, |distance| frame.length(distance.value));
            scene::Integrator::AmbientOcclusion { distance: distance as f32 }
        }
    }
}

fn acceleration(word: Acceleration) -> bvh::Acceleration {
    match word {
        Acceleration::Bvh => bvh::Acceleration::Bvh,
        Acceleration::BoundingBox => bvh::Acceleration::BoundingBox,
        Acceleration::None => bvh::Acceleration::None,
    }
}
