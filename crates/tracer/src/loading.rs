//! The scene on the command line, read and compiled, its faults told.

use crate::args::{DiagnosticsForm, SceneArgs};
use crate::cache::Cache;
use crate::failure::{Failure, leads_nowhere, why};
use crate::memory::human;
use crate::shell::{Shell, counted};
use scene_format::desc::{Material, MaterialRef, with_operands};
use scene_format::diagnostic::{Source, keep_first};
use scene_format::{LoadError, Loaded, MAX_FILE_BYTES, SceneDesc, Syntax};
use std::collections::HashSet;
use std::io::{self, Read};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use tracer_core::mesh::MeshFormat;
use tracer_core::{CompileError, Film, Kept, Scene};

/// Sees that nothing is wrong with a scene at a moment that a film was to show; else it has been printed.
///
/// # Errors
/// Something is.
pub fn expect_all_moments(film: &Film, desc: &SceneDesc, form: DiagnosticsForm, shell: &Shell) -> Result<(), Failure> {
    let Some(faults) = &film.fault else { return Ok(()) };
    shell.diagnostics(faults, &desc.sources, form);
    Err(Failure::WrongScene)
}

/// The name that stands for standard input, and output.
pub fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads the scene: the first hand. Warnings are printed.
///
/// # Errors
/// When it cannot be read, or is wrong: then everything that is wrong has been printed.
pub fn load(args: &SceneArgs, shell: &Shell) -> Result<SceneDesc, Failure> {
    told_of(args, loaded(args, None)?, shell).map(|(scene, _)| scene)
}

/// As [`load`], for those who render nothing: of cameras of which none is chosen the first is taken, and its name put
/// into `args`. How many warnings there were goes with it.
///
/// # Errors
/// As [`load`].
pub fn load_to_look(args: &mut SceneArgs, shell: &Shell) -> Result<(SceneDesc, usize), Failure> {
    let bytes = is_dash(&args.scene).then(|| read(&args.scene)).transpose()?;
    let mut first = loaded(args, bytes.clone())?;
    if let Err(LoadError::Invalid { undecided: Some(camera), .. }) = &first {
        args.camera = Some(camera.to_string());
        first = loaded(args, bytes)?;
    }
    told_of(args, first, shell)
}

/// Reads the scene, from `bytes` with their name where these were read before.
fn loaded(args: &SceneArgs, bytes: Option<(String, Vec<u8>)>) -> Result<Result<Loaded, LoadError>, Failure> {
    let overrides = args.overrides();
    let syntax = args.syntax.map(Syntax::from);
    expect_none_else(&args.scene, syntax)?;
    if bytes.is_none() && !is_dash(&args.scene) && syntax.is_none() {
        return Ok(scene_format::load_with(&args.scene, &overrides));
    }
    let (name, bytes) = bytes.map_or_else(|| read(&args.scene), Ok)?;
    let folder = args.scene.parent().unwrap_or(Path::new(""));
    let syntax = syntax.or(Syntax::from_path(&args.scene));
    Ok(scene_format::load_bytes(&name, bytes, syntax, folder, &overrides))
}

/// The scene and how many warnings there were, which are printed, as what is wrong is.
fn told_of(args: &SceneArgs, loaded: Result<Loaded, LoadError>, shell: &Shell) -> Result<(SceneDesc, usize), Failure> {
    // Looking at the files that a wrong scene names asks for a pool, too.
    use_threads(None)?;
    let Loaded { scene, warnings } = loaded.map_err(|error| {
        let folder = if is_dash(&args.scene) { Path::new("") } else { args.scene.parent().unwrap_or(Path::new("")) };
        told(with_faults_of_files(error, folder), args.diagnostics, shell)
    })?;
    shell.diagnostics(&warnings, &scene.sources, args.diagnostics);
    shell.explain(|| {
        let source = scene.sources.first().map_or("", |source| source.name.as_str());
        let (objects, lights) = (counted(scene.objects.len(), "object"), counted(scene.lights.len(), "light"));
        format!("read {source}: {objects}, {lights}")
    });
    Ok((scene, shell.count(&warnings)))
}

/// The same error with what is wrong with the files that the text names: all mistakes in one run.
/// For those who tell it themselves.
pub(crate) fn with_faults_of_files(mut error: LoadError, folder: &Path) -> LoadError {
    if let LoadError::Invalid { diagnostics, sources, files, .. } = &mut error {
        diagnostics.extend(tracer_core::check_files(files, folder, sources));
        diagnostics.sort_by_key(|fault| fault.span);
        keep_first(diagnostics);
    }
    error
}

/// Why a file that is there is no scene, told by its extension: a picture or a mesh.
fn no_scene(path: &Path) -> Option<String> {
    let extension = path.extension()?.to_str()?.to_ascii_lowercase();
    let shown = path.display();
    let why = match extension.as_str() {
        _ if is_picture(path) => {
            format!(
                "{shown} is a picture, not a scene; `tracer new scene.ron --from {shown}` writes the one that tracer \
                 rendered it of, and as a texture it stands in one: Texture(file: \"..\")"
            )
        }
        _ if MeshFormat::of(path).is_some() => format!(
            "{shown} is a mesh, not a scene; it stands in one: Mesh(file: \"..\"). `tracer new scene.ron` starts a \
             scene"
        ),
        "mtl" => format!("{shown} holds the materials of an OBJ mesh; the mesh's own file stands in a scene"),
        _ => return None,
    };
    path.is_file().then_some(why)
}

/// Sees that a scene that is to be read, of a syntax that the command line names or not, is no file of another kind:
/// what is wrong with its text would be no help, and edits of it would ruin it.
///
/// # Errors
/// It is one.
pub fn expect_none_else(path: &Path, syntax: Option<Syntax>) -> Result<(), Failure> {
    match no_scene(path) {
        Some(why) if syntax.is_none() => Err(Failure::wrong(why)),
        _ => Ok(()),
    }
}

/// Sees that a path leads to a file that may be a scene; whether it is one, reading it tells.
///
/// # Errors
/// When it is standard input, not there, or a file of another kind.
pub fn expect_scene(path: &Path) -> Result<(), Failure> {
    if is_dash(path) {
        return Err(Failure::wrong("standard input cannot be saved again; name a scene file"));
    }
    expect_none_else(path, None)?;
    let opened = std::fs::File::open(path).map_err(|error| unread(path, &error))?;
    if opened.metadata().is_ok_and(|found| found.is_dir()) {
        return Err(unread(path, &std::io::Error::other("it is a folder")));
    }
    Ok(())
}

/// Sees that a path leads to something, and to no folder. It is not opened: a pipe gives what it has once.
///
/// # Errors
/// It does not.
pub fn expect_there(path: &Path) -> Result<(), Failure> {
    match path.metadata() {
        Err(error) if leads_nowhere(&error) => Err(unread(path, &error)),
        Ok(found) if found.is_dir() => Err(unread(path, &std::io::Error::other("it is a folder"))),
        _ => Ok(()),
    }
}

/// Whether a name is that of a picture.
pub fn is_picture(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase());
    matches!(extension.as_deref(), Some("png" | "jpg" | "jpeg" | "exr" | "hdr" | "pfm"))
}

/// So many names of a folder are looked at for a suggestion: a mistyped name must not take seconds in a folder of
/// millions of files.
const MAX_NAMES: usize = 5000;

/// A file of a kind near a path where none is: of nearly the same name, or of the same one with another extension.
pub fn nearby(path: &Path, is_kind: impl Fn(&Path) -> bool) -> Option<String> {
    let name = path.file_name()?.to_str()?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut scenes: Vec<String> = std::fs::read_dir(folder.unwrap_or(Path::new(".")))
        .ok()?
        .take(MAX_NAMES)
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| is_kind(Path::new(name)))
        .collect();
    scenes.sort();
    let stem = Path::new(name).file_stem();
    let of_stem = || scenes.iter().map(String::as_str).filter(|scene| Path::new(scene).file_stem() == stem);
    let same = scene_format::nearest(name, of_stem()).or_else(|| of_stem().next());
    let near = same.or_else(|| scene_format::nearest(name, scenes.iter().map(String::as_str)))?;
    Some(path.with_file_name(near).display().to_string())
}

/// The name to show and the bytes of a scene file or of standard input.
///
/// # Errors
/// When it cannot be read.
fn read(scene: &Path) -> Result<(String, Vec<u8>), Failure> {
    let could_not = |name: &str, error: std::io::Error| Failure::could_not(format!("cannot read {name}: {error}"));
    let unread = |error| unread(scene, &error);
    if is_dash(scene) {
        let mut bytes = Vec::new();
        // One byte more than a scene may have: then it says so itself.
        let mut input = std::io::stdin().lock().take(MAX_FILE_BYTES + 1);
        input.read_to_end(&mut bytes).map_err(|error| could_not("the scene from standard input", error))?;
        Ok(("<stdin>".to_owned(), bytes))
    } else {
        let name = scene.display().to_string();
        let file = std::fs::File::open(scene).map_err(unread)?;
        let mut bytes = Vec::new();
        let mut input = file.take(MAX_FILE_BYTES + 1);
        input.read_to_end(&mut bytes).map_err(unread)?;
        Ok((name, bytes))
    }
}

/// The same for those who take the text as it is, in a syntax that the command line names or not.
///
/// # Errors
/// When it cannot be read, or is a picture or a mesh.
pub fn read_text(scene: &Path, syntax: Option<Syntax>) -> Result<(String, Vec<u8>), Failure> {
    expect_none_else(scene, syntax)?;
    read(scene)
}

/// The failure of a scene that did not load, after its diagnostics were printed.
pub fn told(error: LoadError, form: DiagnosticsForm, shell: &Shell) -> Failure {
    match error {
        LoadError::Invalid { diagnostics, sources, .. } => {
            shell.diagnostics(&diagnostics, &sources, form);
            Failure::WrongScene
        }
        LoadError::Io { path, source } => unread(&path, &source),
    }
}

/// Why a scene file could not be opened: a name that leads to none is wrong input.
fn unread(path: &Path, error: &std::io::Error) -> Failure {
    let shown = path.display();
    if leads_nowhere(error) {
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let tip = match nearby(path, |name| Syntax::from_path(name).is_some()) {
            Some(near) => format!("did you mean {near}?"),
            // None can be started there.
            None if folder.is_some_and(|folder| !folder.is_dir()) => {
                format!("{} is no folder", folder.unwrap_or(path).display())
            }
            None if Syntax::from_path(path).is_some() => format!("`tracer new {shown}` starts one"),
            None => "the names of scenes end in .ron, .toml or .json".to_owned(),
        };
        return Failure::wrong(format!("there is no scene file {shown}; {tip}"));
    }
    if path.is_dir() {
        return Failure::wrong(format!("cannot read {shown}: it is a folder; name a scene file in it"));
    }
    Failure::could_not(format!("cannot read the scene file {shown}: {}", why(error)))
}

/// What is neither read nor built anew.
#[derive(Clone, Copy)]
pub enum Known<'k> {
    /// All is.
    Nothing,
    /// What the scene before has left.
    Kept(&'k Kept),
    /// What an earlier run of the program has left.
    Cached(&'k Cache),
}

/// Compiles the scene: the second hand. Warnings are printed.
///
/// # Errors
/// When assets are wrong: then everything that is wrong has been printed.
pub fn compile(desc: &SceneDesc, form: DiagnosticsForm, known: Known<'_>, shell: &Shell) -> Result<Scene, Failure> {
    use_threads(None)?;
    let sources: &[Source] = &desc.sources;
    let compiled = match known {
        Known::Nothing => tracer_core::compile(desc),
        Known::Kept(kept) => tracer_core::compile_keeping(desc, kept),
        Known::Cached(cache) => tracer_core::compile_storing(desc, cache),
    };
    let scene = compiled.map_err(|CompileError { diagnostics }| {
        shell.diagnostics(&diagnostics, sources, form);
        Failure::WrongScene
    })?;
    shell.diagnostics(&scene.warnings, sources, form);
    for file in asset_files(desc) {
        shell.explain(|| format!("loaded {}", desc.base_dir.join(file).display()));
    }
    shell.explain(|| {
        let s = scene.statistics();
        let count = |n: u64, noun: &str| counted(n as usize, noun);
        let mut line = format!(
            "compiled {}, {} of {} in {}, {}",
            count(s.spheres, "sphere"),
            count(s.meshes, "mesh"),
            count(s.triangles, "triangle"),
            count(s.instances, "place"),
            count(s.textures, "texture"),
        );
        if let Some(tree) = s.tree {
            line += &format!("; tree of {}, {} deep, {}", count(tree.nodes, "node"), tree.depth, human(tree.bytes));
        }
        let times = scene.times;
        line + &format!("; assets {:.3} s, tables {:.3} s, tree {:.3} s", times.assets, times.tables, times.tree)
    });
    Ok(scene)
}

/// The files that the scene names, in the order of their first mention: scenes, meshes, placements, textures.
pub fn asset_files(desc: &SceneDesc) -> Vec<&Path> {
    let mut files: Vec<&Path> = desc.includes.iter().map(|file| &**file).collect();
    let mut materials: Vec<&Material> = desc.materials.iter().map(|named| &named.material).collect();
    for object in with_operands(&desc.objects) {
        files.extend(object.value.file().map(|file| &*file.value));
        files.extend(object.value.placements().files().iter().map(|file| &*file.value));
        if let MaterialRef::Inline(material) = object.value.material() {
            materials.push(&material.value);
        }
    }
    for material in materials {
        files.extend(material.textures().into_iter().map(|texture| &*texture.file.value));
    }
    let mut seen = HashSet::new();
    files.retain(|file| seen.insert(*file));
    files
}

/// Makes the pool that compiles; the default one has a thread for each core.
///
/// # Errors
/// When the system gives no threads.
pub fn use_threads(threads: Option<u16>) -> Result<(), Failure> {
    /// Whether there is a pool.
    static DONE: AtomicBool = AtomicBool::new(false);
    if DONE.swap(true, Ordering::Relaxed) {
        return Ok(());
    }
    let (number, few) = threads.map_or((0, "; name fewer by --threads"), |number| (number.into(), "; lower --threads"));
    // One after the other: a thread's first block of memory may take up 128 MiB of addresses for a moment, and one that
    // starts in that moment, where there are hardly more, ends the program.
    let start = |thread: rayon::ThreadBuilder| {
        let (tell, started) = mpsc::channel();
        let run = move || {
            // No one listens to a thread that was given up.
            let _ = tell.send(Box::new(0));
            thread.run();
        };
        std::thread::Builder::new().spawn(run)?;
        started.recv().map(drop).map_err(io::Error::other)
    };
    rayon::ThreadPoolBuilder::new().num_threads(number).spawn_handler(start).build_global().map_err(|error| {
        let count = threads.map_or("threads".to_owned(), |number| counted(number.into(), "thread"));
        Failure::could_not(format!("cannot start {count}: {error}{few}"))
    })
}
