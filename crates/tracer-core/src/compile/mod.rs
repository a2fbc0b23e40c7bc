//! From [`SceneDesc`] to [`Scene`]: assets loaded, names resolved, everything in render space, tables and tree built.
//! The second hand.

mod assets;
mod behind_planes;
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
mod measured;
mod meshes;
mod moments;
mod nearby;
mod other_scale;
mod out_of_view;
mod patterns;
mod placed;
mod placing;
mod polygonal;
mod prepared;
mod programs;
mod radiances;
mod settled;
mod shaped;
mod shared_walls;
mod shut_in;
mod stored;
mod textures;
mod trees;
mod turned;
mod unmeant;
mod vertex_colors;

use crate::develop::Look;
use crate::mattes::Mattes;
use crate::scene::{CompileTimes, Scene, backdrop};
pub use assets::{Asset, Assets};
use assets::{DISK, Sources};
use curved::Curved;
pub use files::{check_files, check_files_from};
pub use frames::{LookedAt, Looking, ToldFrame, check_frames};
pub use kept::Kept;
pub use light_groups::{most_light_groups, shining_objects};
use materials::{Finished, MaterialBuilder};
pub use out_of_view::way_into_view;
use placing::Given;
use prepared::Prepared;
use scene_format::diagnostic::{Source, keep_first, say_where_included};
use scene_format::{Diagnostic, Diagnostics, SceneDesc, Severity};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;
pub use stored::{ContentHash, Fill, KeptError, KeptFile, KeptKind, Stamp, Store, Told, is_kept_file};
use tracer_kernels::scene::Frame;
use tracer_mesh::file_of;

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

fn compile_with(desc: &SceneDesc, sources: &Sources<'_>) -> Result<Scene, CompileError> {
    if desc.moves() { moments::compile(desc, sources) } else { compile_like(desc, sources, Like::default()) }
}

/// What a scene has in common with another, so that one film can be of both.
#[derive(Clone, Copy, Debug, Default)]
struct Like {
    frame: Option<Frame>,
    radiance_unit: Option<f64>,
}

/// What stands in a scene, as it is written there, and where.
struct Objects {
    loaded: loading::Loaded,
    assigned: meshes::Assigned,
    curved: Vec<Curved>,
    solids: Vec<csg::SolidObject>,
    placed: placed::Placed,
}

/// What a scene is made of: all that may be wrong with it but its tree.
struct Gathered<'d> {
    objects: Objects,
    files: BTreeSet<PathBuf>,
    mattes: Mattes,
    finished: Finished,
    background: environment::Loaded<'d>,
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
    let mut solids = csg::load(desc, sources, &mut builder, &mut diagnostics);
    let settled =
        settled::settle(desc, sources, &settled::Things { loaded: &loaded, solids: &solids }, &mut diagnostics);
    let given = Given { desc, sources, settled: &settled };
    curved::place(given, &mut curved, &mut diagnostics);
    csg::place_copies(given, &mut solids, &mut diagnostics);
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
    let objects = Objects { loaded, assigned, curved, solids, placed };
    Ok(Gathered { objects, files, mattes, finished, background, diagnostics })
}

/// The same, those in included files with the way there.
fn with_ways(mut diagnostics: Diagnostics, sources: &[Source]) -> Diagnostics {
    diagnostics.iter_mut().for_each(|fault| say_where_included(fault, sources));
    diagnostics
}

/// Warns of what is surely not meant, as far as it is seen without a frame; of shapes in one place one is left.
fn warn(desc: &SceneDesc, gathered: &mut Gathered<'_>) {
    let Gathered { objects, finished, background, diagnostics, .. } = gathered;
    let Objects { loaded, assigned, curved, solids, placed } = objects;
    let turned = turned::warn(desc, diagnostics);
    in_one_place::leave_out(desc, curved, (&finished.materials, &turned), diagnostics);
    unmeant::warn(desc, loaded, placed, curved, diagnostics);
    shut_in::warn(desc, &shut_in::Made { loaded, placed, curved, solids }, diagnostics);
    dark_lamps::warn(desc, assigned, diagnostics);
    hidden_flat::warn(desc, placed, &turned, diagnostics);
    behind_planes::warn(desc, placed, (curved, solids), diagnostics);
    csg::warn(desc, solids, diagnostics);
    csg::part(desc, loaded, placed, curved, solids);
    shared_walls::warn(desc, (curved, solids), &finished.materials, diagnostics);
    curved::warn_of_open_glass(desc, diagnostics);
    other_scale::warn(desc, background.brightest(), diagnostics);
}

fn compile_like(desc: &SceneDesc, sources: &Sources<'_>, like: Like) -> Result<Scene, CompileError> {
    let start = Instant::now();
    let mut gathered = gather(desc, sources)?;
    let assets = start.elapsed().as_secs_f64();
    warn(desc, &mut gathered);
    let Gathered { objects, files, mattes, finished, background, mut diagnostics } = gathered;

    let start = Instant::now();
    let prepared = Prepared::new(desc, objects, finished, background, like, &mut diagnostics);
    let tables = start.elapsed().as_secs_f64();

    let start = Instant::now();
    let trees = prepared.trees(desc, sources)?;
    let tree = start.elapsed().as_secs_f64();

    let (rendered, light_groups) = prepared.rendered(desc, trees);
    diagnostics.extend(out_of_view::warning(desc, &rendered));
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
        times: CompileTimes { assets, tables, tree },
    })
}

/// The files that the scene names, each once: the scenes that it includes, and what [`compile`] opens: meshes,
/// placements, pictures. What these name in turn is known when they have been read ([`Scene::files`]).
pub fn named_files(desc: &SceneDesc) -> Vec<PathBuf> {
    let included = desc.includes.iter().map(|file| &**file);
    let named: BTreeSet<&Path> = nearby::named(desc).map(|file| &*file.value).chain(included).collect();
    named.into_iter().map(|path| desc.base_dir.join(file_of(path))).collect()
}
