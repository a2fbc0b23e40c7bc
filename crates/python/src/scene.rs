//! A scene, read and compiled.

use crate::arrays;
use crate::attended::attended;
use crate::rendering;
use crate::request::maybe;
use pyo3::exceptions::{PyFileNotFoundError, PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyDict, PyList, PyTuple};
use scene_format::diagnostic::Source;
use scene_format::{Diagnostics, LoadError, Override, SceneDesc, Syntax, render};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};
use tracer_core::{Assets, CompileError, check_files_from, compile_from};

/// Wide enough for the lines that a scene of dictionaries is laid out in.
const STYLE: render::Style = render::Style { color: false, width: 140 };

/// A scene that is right, with what it names in memory.
pub struct Held {
    pub desc: SceneDesc,
    pub assets: Assets,
    /// The last one that was compiled, and its size: it is rendered again and again.
    compiled: Mutex<Option<([u32; 2], Arc<tracer_core::Scene>)>>,
}

/// What is wrong: diagnostics, and the texts that they point into.
pub struct Faults {
    pub diagnostics: Diagnostics,
    pub sources: Vec<Source>,
}

impl Held {
    /// The scene compiled for pictures of this size.
    pub fn compiled(&self, size: [u32; 2]) -> Result<Arc<tracer_core::Scene>, Faults> {
        let mut kept = self.compiled.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, scene)) = kept.as_ref().filter(|(of, _)| *of == size) {
            return Ok(Arc::clone(scene));
        }
        let mut desc = self.desc.clone();
        (desc.image.width, desc.image.height) = (size[0].into(), size[1].into());
        let compiled = compile_from(&desc, &self.assets);
        let scene = compiled.map_err(|CompileError { diagnostics }| Faults { diagnostics, sources: desc.sources })?;
        let scene = Arc::new(scene);
        *kept = Some((size, Arc::clone(&scene)));
        Ok(scene)
    }
}

/// Where a scene is read from.
enum From {
    File(PathBuf),
    Text { name: String, text: Vec<u8>, syntax: Option<Syntax>, folder: PathBuf },
}

/// Reads and compiles what the request says. Gives a dictionary: `faults` (JSON, a line each) and `text` where it is
/// wrong, else `warnings`, `text`, `size`, `files`, and `render`, a function.
///
/// # Errors
/// When there is no such file, or the request is wrong.
pub fn load(args: &Bound<'_, PyTuple>) -> PyResult<Py<PyDict>> {
    let py = args.py();
    let request = args.get_item(0)?;
    let request: &Bound<'_, PyDict> = request.cast()?;
    let from = source(request)?;
    let sets: Vec<String> = maybe(request, "set")?.unwrap_or_default();
    let assets = match request.get_item("assets")? {
        Some(list) => arrays::assets(list.cast::<PyList>()?)?,
        None => Assets::default(),
    };
    let names: Vec<PathBuf> = assets.names().map(Path::to_owned).collect();
    let loaded = attended(py, 0, None, move |_| read(&from, &sets, assets))?;
    let out = PyDict::new(py);
    match loaded.map_err(|(path, error)| unread(&path, &error))? {
        Err(faults) => told(&out, "faults", &faults)?,
        Ok((held, warnings, scene)) => {
            told(&out, "warnings", &Faults { diagnostics: warnings, sources: held.desc.sources.clone() })?;
            out.set_item("size", (held.desc.image.width.value, held.desc.image.height.value))?;
            out.set_item("samples", held.desc.render.samples.value)?;
            let (base, files) = (held.desc.base_dir.clone(), &scene.files);
            let is_used = |name: &PathBuf| files.contains(&base.join(name)) || files.contains(name);
            let unused = names.iter().filter(|name| !is_used(name)).map(|name| name.display().to_string());
            out.set_item("unused", unused.collect::<Vec<_>>())?;
            out.set_item("files", files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>())?;
            let held = Arc::new(held);
            let doc = c"render(settings, progress) -> dict: renders the scene.";
            let render = move |args: &Bound<'_, PyTuple>, _: Option<&Bound<'_, PyDict>>| rendering::render(&held, args);
            out.set_item("render", PyCFunction::new_closure(py, Some(c"render"), Some(doc), render)?)?;
        }
    }
    Ok(out.unbind())
}

/// Puts diagnostics into a dictionary: as data, and as people read them.
pub fn told(out: &Bound<'_, PyDict>, key: &str, faults: &Faults) -> PyResult<()> {
    out.set_item(key, render::json_lines(&faults.diagnostics, &faults.sources))?;
    out.set_item("text", render::text(&faults.diagnostics, &faults.sources, STYLE))
}

fn source(request: &Bound<'_, PyDict>) -> PyResult<From> {
    if let Some(path) = maybe::<PathBuf>(request, "path")? {
        return Ok(From::File(path));
    }
    let text: String = maybe(request, "source")?.ok_or_else(|| PyValueError::new_err("there is no scene"))?;
    let syntax = match maybe::<String>(request, "syntax")?.as_deref() {
        None => None,
        Some("ron") => Some(Syntax::Ron),
        Some("toml") => Some(Syntax::Toml),
        Some("json") => Some(Syntax::Json),
        Some(other) => {
            return Err(PyValueError::new_err(format!("syntax is \"ron\", \"toml\" or \"json\", and not {other:?}")));
        }
    };
    let name = maybe(request, "name")?.unwrap_or_else(|| "<scene>".to_owned());
    let folder = maybe(request, "base_dir")?.unwrap_or_default();
    Ok(From::Text { name, text: text.into_bytes(), syntax, folder })
}

type Read = Result<(Held, Diagnostics, Arc<tracer_core::Scene>), Faults>;

/// The scene; what is wrong with it; or why its file could not be read.
fn read(from: &From, sets: &[String], assets: Assets) -> Result<Read, (PathBuf, std::io::Error)> {
    let sets: Vec<Override> = sets.iter().map(|set| Override::from(set.as_str())).collect();
    let (loaded, folder) = match from {
        From::File(path) => (scene_format::load_with(path, &sets), path.parent().unwrap_or(Path::new("")).to_owned()),
        From::Text { name, text, syntax, folder } => {
            (scene_format::load_bytes(name, text.clone(), *syntax, folder, &sets), folder.clone())
        }
    };
    let loaded = match loaded {
        Ok(loaded) => loaded,
        Err(LoadError::Io { path, source }) => return Err((path, source)),
        Err(LoadError::Invalid { mut diagnostics, sources, files, .. }) => {
            diagnostics.extend(check_files_from(&files, &folder, &sources, &assets));
            diagnostics.sort_by_key(|fault| fault.span);
            return Ok(Err(Faults { diagnostics, sources }));
        }
    };
    let held = Held { desc: loaded.scene, assets, compiled: Mutex::new(None) };
    let size = [held.desc.image.width.value, held.desc.image.height.value];
    Ok(held.compiled(size).map(|scene| {
        let warnings = loaded.warnings.into_iter().chain(scene.warnings.iter().cloned()).collect();
        (held, warnings, scene)
    }))
}

fn unread(path: &Path, error: &std::io::Error) -> PyErr {
    let shown = path.display();
    if path.is_dir() {
        return PyOSError::new_err(format!("cannot read {shown}: it is a folder; name a scene file in it"));
    }
    if error.kind() != std::io::ErrorKind::NotFound {
        return PyOSError::new_err(format!("cannot read the scene file {shown}: {error}"));
    }
    let near = tracer::loading::nearby(path, |name| Syntax::from_path(name).is_some());
    let tip = near.map_or(String::new(), |near| format!("; did you mean {near}?"));
    PyFileNotFoundError::new_err(format!("there is no scene file {shown}{tip}"))
}
