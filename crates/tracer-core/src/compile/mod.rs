//! From [`SceneDesc`] to [`Scene`]: assets loaded, names resolved, everything in render space, tables and tree built.
//! The second hand.

mod assets;
mod bodies;
mod camera;
mod csg;
mod curved;
mod dark_lamps;
mod energy;
mod environment;
mod files;
mod frames;
mod hidden_flat;
mod in_one_place;
mod kept;
mod light_groups;
mod lights_in_one_place;
mod loading;
mod materials;
mod meshes;
mod moments;
mod nearby;
mod other_scale;
mod out_of_view;
mod patterns;
mod placed;
mod placing;
mod polygonal;
mod programs;
mod radiances;
mod settled;
mod shut_in;
mod stored;
mod textures;
mod trees;
mod unmeant;
mod vertex_colors;

use crate::develop::{Backdrop, Look};
use crate::mattes::Mattes;
use crate::scene::{CompileTimes, Scene, backdrop, film_layers};
pub use assets::{Asset, Assets};
use assets::{DISK, Sources};
use curved::Curved;
pub use files::{check_files, check_files_from};
pub use frames::{LookedAt, Looking, ToldFrame, check_frames};
use glam::{DAffine3, DVec3};
pub use kept::Kept;
pub use light_groups::{most_light_groups, shining_objects};
use materials::{Finished, MaterialBuilder};
use placing::Given;
use scene_format::codes;
use scene_format::desc::{Acceleration, Caustics, Integrator, Reuse};
use scene_format::diagnostic::{Source, Span, keep_first, say_where_included};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, Severity, desc};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;
pub use stored::{ContentHash, Fill, KeptError, KeptFile, KeptKind, Stamp, Store, Told, is_kept_file};
use tracer_kernels::scene::{
    CurvedLight, Frame, InstanceTable, Light, LightTable, MaterialTable, NONE, OccluderTable, PatternTable, Picture,
    PlaneTable, Program, Shape, ShapeTable, Sharing, Solids, Space, Sphere, SphereTable, Tables, TextureTable, Written,
};
use tracer_kernels::{bvh, scene};
use tracer_mesh::file_of;
use trees::Hung;

/// Of so many triangles at most a scene has a table of what can hide points from each other.
const OCCLUDERS: usize = 256;

/// Why a scene could not be compiled: everything that was found, errors and warnings.
#[derive(Debug, thiserror::Error)]
#[error("{}", summary(.diagnostics))]
pub struct CompileError {
    /// What is wrong; at least one is an error.
    pub diagnostics: Diagnostics,
}

fn summary(diagnostics: &[Diagnostic]) -> String {
    let mut errors = diagnostics.iter().filter(|d| d.severity == Severity::Error);
    let first = errors.next().map_or("", |d| d.message.as_str());
    match errors.count() {
        0 => first.to_owned(),
        more => format!("{first} (and {more} more)"),
    }
}

/// Compiles the scene. Relative paths start from `desc.base_dir`.
///
/// # Errors
/// All faults of the assets at once: missing or unreadable files, wrong meshes and textures, singular transforms, each
/// at the place in the scene file that names it.
pub fn compile(desc: &SceneDesc) -> Result<Scene, CompileError> {
    compile_with(desc, &DISK)
}

/// As [`compile`], of a scene whose files may be in memory.
///
/// # Errors
/// As [`compile`].
pub fn compile_from(desc: &SceneDesc, assets: &Assets) -> Result<Scene, CompileError> {
    compile_with(desc, &Sources::new(assets, &desc.base_dir))
}

/// As [`compile`], to the same scene, but what is in `kept` and has not changed is neither read nor built anew, and
/// what was read and built is kept in it. For programs that compile a scene again and again while it is edited.
///
/// # Errors
/// As [`compile`].
pub fn compile_keeping(desc: &SceneDesc, kept: &Kept) -> Result<Scene, CompileError> {
    let compiled = compile_with(desc, &Sources::keeping(kept));
    // A scene with faults has not told what it uses.
    if compiled.is_ok() {
        kept.sweep();
    }
    compiled
}

/// As [`compile`], to the same scene, but meshes that were read and trees that were built by an earlier run of the
/// program are taken from where it keeps them, and new ones are kept there.
///
/// # Errors
/// As [`compile`].
pub fn compile_storing(desc: &SceneDesc, store: &dyn Store) -> Result<Scene, CompileError> {
    compile_with(desc, &Sources::storing(store))
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

fn compile_with(desc: &SceneDesc, sources: &Sources<'_>) -> Result<Scene, CompileError> {
    if desc.moves() { moments::compile(desc, sources) } else { compile_like(desc, sources, Like::default()) }
}

/// What a scene has in common with another, so that one film can be of both.
#[derive(Clone, Copy, Debug, Default)]
struct Like {
    frame: Option<Frame>,
    radiance_unit: Option<f64>,
}

/// What a scene is made of: all that may be wrong with it but its tree.
struct Gathered<'d> {
    loaded: loading::Loaded,
    assigned: meshes::Assigned,
    curved: Vec<Curved>,
    solid_objects: Vec<csg::SolidObject>,
    files: BTreeSet<PathBuf>,
    mattes: Mattes,
    finished: Finished,
    background: environment::Loaded<'d>,
    placed: placed::Placed,
    /// Warnings.
    diagnostics: Diagnostics,
}

fn gather<'d>(desc: &'d SceneDesc, sources: &Sources<'_>) -> Result<Gathered<'d>, CompileError> {
    let mut diagnostics = Diagnostics::new();
    let mut builder = MaterialBuilder::new(desc);
    let loaded = meshes::load(desc, sources, &mut diagnostics);
    vertex_colors::check(desc, &loaded, &mut diagnostics);
    let assigned = meshes::assign_materials(desc, &loaded, &mut builder, &mut diagnostics);
    let mut curved = curved::load(desc, sources, &mut builder, &mut diagnostics);
    let mut solid_objects = csg::load(desc, sources, &mut builder, &mut diagnostics);
    let settled =
        settled::settle(desc, sources, &settled::Things { loaded: &loaded, solids: &solid_objects }, &mut diagnostics);
    let given = Given { desc, sources, settled: &settled };
    curved::place(given, &mut curved, &mut diagnostics);
    csg::place_copies(given, &mut solid_objects, &mut diagnostics);
    let named = named_files(desc);
    let files = named.iter().chain(loaded.libraries()).chain(builder.textures());
    let files: BTreeSet<PathBuf> = files.map(|path| file_of(path).to_owned()).collect();
    let mattes = Mattes::of(desc, builder.names());
    let finished = builder.finish(sources, &mut diagnostics);
    let background = environment::load(desc, sources, &mut diagnostics);
    let placed = placed::place(given, &loaded, &mut diagnostics);
    if diagnostics.iter().any(|d| d.severity == Severity::Error) {
        diagnostics.sort_by_key(|d| d.span);
        keep_first(&mut diagnostics);
        nearby::suggest(&desc.base_dir, &desc.sources, &nearby::by_place(desc), &mut diagnostics);
        return Err(CompileError { diagnostics: with_ways(diagnostics, &desc.sources) });
    }
    Ok(Gathered { loaded, assigned, curved, solid_objects, files, mattes, finished, background, placed, diagnostics })
}

/// The same, those in included files with the way there.
fn with_ways(mut diagnostics: Diagnostics, sources: &[Source]) -> Diagnostics {
    diagnostics.iter_mut().for_each(|fault| say_where_included(fault, sources));
    diagnostics
}

/// Warns of what is surely not meant, as far as it is seen without a frame; of shapes in one place one is left.
fn warn(desc: &SceneDesc, gathered: &mut Gathered<'_>) {
    let Gathered { loaded, assigned, curved, solid_objects, finished, background, placed, diagnostics, .. } = gathered;
    in_one_place::leave_out(desc, curved, &finished.materials, diagnostics);
    unmeant::warn(desc, loaded, placed, curved, diagnostics);
    shut_in::warn(desc, &shut_in::Made { loaded, placed, curved, solids: solid_objects }, diagnostics);
    dark_lamps::warn(desc, assigned, diagnostics);
    hidden_flat::warn(desc, placed, diagnostics);
    curved::warn_of_open_glass(desc, diagnostics);
    other_scale::warn(desc, background.brightest(), diagnostics);
}

fn compile_like(desc: &SceneDesc, sources: &Sources<'_>, like: Like) -> Result<Scene, CompileError> {
    let start = Instant::now();
    let mut gathered = gather(desc, sources)?;
    let assets = start.elapsed().as_secs_f64();
    warn(desc, &mut gathered);
    let Gathered { loaded, assigned, curved, solid_objects, files, mattes, .. } = gathered;
    let Gathered { finished, background, placed, mut diagnostics, .. } = gathered;
    let Finished { materials, images, uses, patterns, programs } = finished;
    let start = Instant::now();
    let eye = DVec3::from(desc.camera.position.value);
    let look_at = DVec3::from(desc.camera.look_at.value);
    let chosen = || Frame::choose(eye, &marks(&curved, &solid_objects, &placed, look_at));
    let frame = like.frame.unwrap_or_else(chosen);
    let camera = camera::camera(desc, &frame);
    unmeant::far_view(desc, &camera, &frame, &mut diagnostics);
    let mesh_radiances = meshes::radiances(&loaded, &placed, &assigned);
    let shining = radiances::of_objects(desc, (&curved, &solid_objects), &mesh_radiances);
    let behind = background.brightest();
    let radiance_unit = like.radiance_unit.unwrap_or_else(|| radiances::unit(desc, &shining, behind));
    diagnostics.extend(radiances::too_dark(desc, &shining, behind, radiance_unit));
    let is_dark = behind == [0.0; 3];
    let (background, environment) = background.build(radiance_unit);
    if desc.render.indirect == desc::Indirect::Map {
        let message = "there is no map of indirect light any more: it comes by paths";
        diagnostics
            .push(Diagnostic::warning(codes::MAP_IS_GONE, Span::NONE, message).hint("leave `render.indirect` out"));
    }
    // The world's own coordinates are the first.
    let solid = patterns.iter().any(|pattern| pattern.space != Space::Uv) || programs.iter().any(Program::is_solid);
    let mut written = solid.then(|| vec![DAffine3::IDENTITY]);
    let (spheres, mut shapes, mut lights) = curved_and_lights(desc, &frame, radiance_unit, curved, written.as_mut());
    let (mut solids, mut solid_groups) = (Solids::default(), BTreeMap::new());
    let mut lit = csg::Lit { lights: &mut lights, radiance_unit, groups: &mut solid_groups };
    // What has no end stays behind them.
    let mut endless = shapes.split_off(shapes.partition_point(|shape| !shape.unit.is_endless()));
    for object in &solid_objects {
        object.build(&frame, &mut shapes, &mut solids, &mut lit, written.as_mut());
    }
    shapes.append(&mut endless);
    let parts = meshes::Parts {
        desc,
        loaded: &loaded,
        placed: &placed,
        assigned: &assigned,
        radiances: &mesh_radiances,
        radiance_unit,
        first_light: lights.len() as u32,
    };
    let mut built = meshes::build(&frame, &parts, written.as_mut());
    lights.append(&mut built.lights);
    lights_in_one_place::keep_first(&mut lights);
    diagnostics.extend(built.unlit.iter().map(|&span| unmeant::unlit(span)));
    let color_table = vertex_colors::table(&programs, &loaded, &built);
    // The tree is what takes the most: what was made of the description is there no more.
    drop((loaded, placed, assigned, mesh_radiances, solid_objects));
    let material_table = MaterialTable::new(&materials, uses.len() as u32, (uses.len() + patterns.len()) as u32);
    let sphere_table = SphereTable::new(&spheres, material_table.emitter);
    let plane_table = PlaneTable::new(&shapes, spheres.len() as u32);
    let light_table = LightTable::new(&lights, &spheres, environment.map(Arc::new));
    let written = written.map_or_else(Written::default, |maps| {
        Written::new(maps, &spheres, &shapes, &built.coordinates, &solids.operands)
    });
    let first_body = (spheres.len() + shapes.len() + built.copies.len()) as u32;
    let pattern_table = PatternTable::new(patterns, programs, &frame, written);
    let tables_seconds = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let hung = Hung {
        spheres: &spheres,
        in_tree: sphere_table.in_tree,
        shapes: &shapes,
        solids: &solids,
        built: &built,
        materials: &materials,
        sources,
    };
    let way = acceleration(desc.render.acceleration);
    let accel = hung.tree(way, &[])?;
    let camera_sees = hung.camera_sees(way, trees::hidden(desc), &sphere_table, &plane_table)?;
    let full = desc.render.integrator == Integrator::Full;
    let integrator = integrator(&desc.render.integrator, &frame);
    // Who shares what goes by the boxes of the hierarchy, whatever finds the hits: the picture must not depend on that.
    let hierarchy = match &accel {
        Some(_) if way != bvh::Acceleration::Bvh && full => hung.tree(bvh::Acceleration::Bvh, &[])?,
        accel => accel.clone(),
    };
    let hierarchy = hierarchy.as_deref();
    let tree = start.elapsed().as_secs_f64();
    // Only now: nothing else takes as much as a tree that is being built.
    let instances = built.instances();
    drop((built.copies, built.of_copies));
    let instance_table = InstanceTable::new(&instances);
    let pictures =
        images.iter().map(|image| Picture { width: image.width, height: image.height, texels: &image.texels });
    let mut rendered = tracer_kernels::scene::Scene {
        frame,
        camera,
        size: [desc.image.width.value, desc.image.height.value],
        samples: desc.render.samples.value,
        max_bounces: desc.render.max_bounces.value,
        seed: desc.render.seed.value,
        integrator,
        reuse: match desc.render.reuse {
            Reuse::Blocks if full && is_dark => Sharing::Always,
            Reuse::Blocks if full => Sharing::Indoors,
            _ => Sharing::Never,
        },
        caustics: full && desc.render.caustics == Caustics::Photons,
        clamp: desc.render.clamp.as_ref().map(|limit| limit.value as f32),
        noise: desc.render.noise.as_ref().map(|goal| goal.value),
        time: desc.render.time.as_ref().map(|seconds| seconds.value),
        layers: film_layers(&desc.output),
        backdrop: backdrop(&desc.output) != Backdrop::Background,
        radiance_unit,
        background,
        spheres: spheres.into(),
        tables: Tables {
            spheres: sphere_table.into(),
            shapes: ShapeTable::new(&shapes, &solids, first_body).into(),
            planes: plane_table.into(),
            materials: material_table.into(),
            lights: light_table,
            textures: TextureTable::new(pictures, &uses).into(),
            patterns: pattern_table.into(),
            colors: color_table.into(),
            instances: instance_table.into(),
        },
        shapes: shapes.into(),
        solids: solids.into(),
        materials: materials.into(),
        lights,
        meshes: built.meshes.into(),
        triangles: built.triangles.into(),
        instances: instances.into(),
        accel,
        camera_sees,
        top_boxes: hierarchy.map(|accel| *accel.top_boxes()),
        second_boxes: hierarchy.map(|accel| *accel.second_boxes()),
        occluders: hierarchy.filter(|_| full).and_then(|accel| OccluderTable::new(accel, OCCLUDERS)).map(Arc::new),
        acceleration: way,
        ends: None,
    };
    tracer_kernels::engine::glow::measure(&mut rendered);
    diagnostics.extend(out_of_view::warning(desc, &rendered));
    let light_groups = desc.output.light_groups.then(|| light_groups::of(desc, &rendered, &solid_groups));
    Ok(Scene {
        rendered,
        light_groups,
        look: Look {
            exposure: desc.effects.exposure.value,
            tone_map: desc.effects.tone_map,
            backdrop: backdrop(&desc.output),
        },
        files: files.into_iter().collect(),
        mattes,
        warnings: with_ways(diagnostics, &desc.sources),
        moments: None,
        times: CompileTimes { assets, tables: tables_seconds, tree },
    })
}

fn acceleration(word: Acceleration) -> bvh::Acceleration {
    match word {
        Acceleration::Bvh => bvh::Acceleration::Bvh,
        Acceleration::BoundingBox => bvh::Acceleration::BoundingBox,
        Acceleration::None => bvh::Acceleration::None,
    }
}

/// The files that the scene names, each once: the scenes that it includes, and what [`compile`] opens: meshes,
/// placements, pictures. What these name in turn is known when they have been read ([`Scene::files`]).
pub fn named_files(desc: &SceneDesc) -> Vec<PathBuf> {
    let included = desc.includes.iter().map(|file| &**file);
    let named: BTreeSet<&Path> = nearby::named(desc).map(|file| &*file.value).chain(included).collect();
    named.into_iter().map(|path| desc.base_dir.join(file_of(path))).collect()
}

/// One point per object near what the camera looks at, on its surface or in its box. What has no end says nothing of
/// where a scene is, unless there is nothing else.
fn marks(curved: &[Curved], solids: &[csg::SolidObject], placed: &placed::Placed, look_at: DVec3) -> Vec<DVec3> {
    let of = |endless: bool| {
        let some = curved.iter().filter(move |object| object.is_endless() == endless);
        some.flat_map(move |object| object.marks(look_at))
    };
    let of_solids = solids.iter().flat_map(|object| object.marks(look_at));
    let marks: Vec<DVec3> = of(false).chain(of_solids).chain(placed.marks(look_at)).collect();
    if marks.is_empty() { of(true).collect() } else { marks }
}

/// The spheres of objects and lights in the order of their primitive ids (see [`SphereTable`]), the other curved
/// shapes, and the lights.
fn curved_and_lights(
    desc: &SceneDesc,
    frame: &Frame,
    radiance_unit: f64,
    curved: Vec<Curved>,
    mut written: Option<&mut Vec<DAffine3>>,
) -> (Vec<Sphere>, Vec<Shape>, Vec<Light>) {
    let mut lights: Vec<Light> = Vec::new();
    let mut shine = |radiance: [f64; 3], two_sided: bool| {
        lights.push(Light::Sphere { sphere: NONE, radiance: radiance.map(|x| x / radiance_unit), two_sided });
        lights.len() as u32 - 1
    };
    let mut spheres = Vec::with_capacity(curved.len() + desc.lights.len());
    let (mut shapes, mut lamps): (Vec<Shape>, Vec<CurvedLight>) = (Vec::new(), Vec::new());
    for object in &curved {
        object.build(frame, &mut shine, &mut spheres, (&mut shapes, &mut lamps), written.as_deref_mut());
    }
    // To put millions in order takes as much again.
    drop(curved);
    for (object, light) in (desc.objects.len() as u32..).zip(&desc.lights) {
        let desc::Light::SphereLight(light) = &light.value;
        let index = shine(radiances::of_light(light), true);
        let (center, radius) = (frame.point(DVec3::from(light.center.value)), frame.length(light.radius.value));
        spheres.push(Sphere { center, radius, material: NONE, object, copy: 0, light: index, coordinates: 0 });
    }
    SphereTable::order(&mut spheres);
    // Behind those that hang in the tree.
    shapes.sort_by_key(|shape| shape.unit.is_endless());
    for (k, sphere) in spheres.iter().enumerate() {
        if let Some(Light::Sphere { sphere: index, .. }) = lights.get_mut(sphere.light as usize) {
            *index = k as u32;
        }
    }
    // Behind those of the spheres.
    let first = lights.len() as u32;
    for (k, shape) in (0..).zip(&mut shapes).filter(|(_, shape)| shape.light != NONE) {
        if let Some(lamp) = lamps.get_mut(shape.light as usize) {
            lamp.shape = k;
        }
        shape.light += first;
    }
    let in_unit = |lamp: CurvedLight| CurvedLight { radiance: lamp.radiance.map(|x| x / radiance_unit), ..lamp };
    lights.extend(lamps.into_iter().map(|lamp| Light::Curved(in_unit(lamp))));
    (spheres, shapes, lights)
}
