//! A rendering, watched by Python.

use crate::attended::{Shared, attended};
use crate::picture;
use crate::request::maybe;
use crate::scene::{Faults, Held, told};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};
use scene_format::desc::{Background, Object, Sphere};
use scene_format::{SceneDesc, Severity};
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};
use tracer_core::{
    Crop, Denoised, Film, GUIDES, Image, LayerSet, Look, Noisy, Observer, Progress, RenderOptions, Scene, develop,
    develop_denoised, layer_set, layer_word,
};
use tracer_oidn::{NAMED_BY, Oidn, Picture};

/// What a caller asks for.
struct Settings {
    /// The scene's, with what the caller says in place of it.
    desc: SceneDesc,
    crop: Option<Crop>,
    threads: usize,
    layers: LayerSet,
    denoise: Option<Denoiser>,
}

/// Who takes the noise out.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Denoiser {
    BuiltIn,
    Oidn,
}

/// What came of it.
pub struct Made {
    pub image: Image,
    pub film: Film,
    /// Why it was not denoised though that was asked for.
    pub note: Option<String>,
    /// Files that it was made of.
    pub files: Vec<PathBuf>,
    pub stopped: bool,
}

/// Renders a scene with the settings of a dictionary; the second argument is told how far it is, if it is not `None`.
///
/// # Errors
/// When a setting is wrong, and what Python raises meanwhile.
pub fn render(held: &Arc<Held>, args: &Bound<'_, PyTuple>) -> PyResult<Py<PyDict>> {
    let py = args.py();
    let (given, progress) = (args.get_item(0)?, args.get_item(1)?);
    let settings = settings(held, given.cast()?)?;
    let out = PyDict::new(py);
    let faults: Vec<_> = faults(&settings.desc);
    if !faults.is_empty() {
        told(&out, "faults", &Faults { diagnostics: faults, sources: Vec::new() })?;
        return Ok(out.unbind());
    }
    let desc = settings.desc.clone();
    let threads = settings.threads;
    let of_worker = Arc::clone(held);
    let progress = (!progress.is_none()).then_some(&progress);
    let made = attended(py, threads, progress, move |shared| made(&of_worker, &settings, shared))?;
    match made {
        Err(faults) => told(&out, "faults", &faults)?,
        Ok(made) => picture::put(&out, made, &desc)?,
    }
    Ok(out.unbind())
}

fn settings(held: &Held, given: &Bound<'_, PyDict>) -> PyResult<Settings> {
    let mut desc = held.desc.clone();
    if let Some((width, height)) = maybe::<(u32, u32)>(given, "size")? {
        (desc.image.width, desc.image.height) = (width.into(), height.into());
    }
    if let Some(samples) = maybe::<u32>(given, "samples")? {
        desc.render.samples = samples.into();
    }
    if let Some(seed) = maybe::<u32>(given, "seed")? {
        desc.render.seed = seed.into();
    }
    if let Some(noise) = maybe::<f64>(given, "noise")? {
        desc.render.noise = Some(noise.into());
    }
    if let Some(time) = maybe::<f64>(given, "time")? {
        desc.render.time = Some(time.into());
    }
    if let Some(exposure) = maybe::<f64>(given, "exposure")? {
        desc.effects.exposure = exposure.into();
    }
    let mut layers = layer_set(&desc.output.layers);
    for name in maybe::<Vec<String>>(given, "layers")?.unwrap_or_default() {
        let layer = LayerSet::by_name(&name).ok_or_else(|| {
            let all: Vec<&str> = LayerSet::all().names().collect();
            let near = scene_format::nearest(&name, all.iter().copied());
            let tip = near.map_or(String::new(), |near| format!("; did you mean {near:?}?"));
            PyValueError::new_err(format!("there is no layer {name:?}{tip} (there are {})", all.join(", ")))
        })?;
        desc.output.layers.push(layer_word(layer));
        layers = layers.iter().chain([layer]).collect();
    }
    let size = [desc.image.width.value, desc.image.height.value];
    let crop = maybe::<(u32, u32, u32, u32)>(given, "crop")?.map(|(x, y, width, height)| Crop { x, y, width, height });
    if let Some(crop) = crop.filter(|crop| crop.within(size) != *crop || crop.width == 0 || crop.height == 0) {
        let Crop { x, y, width, height } = crop;
        return Err(PyValueError::new_err(format!(
            "crop=({x}, {y}, {width}, {height}) does not lie in the picture of {} x {} pixels; it is (x, y, width, \
             height) from the upper left",
            size[0], size[1]
        )));
    }
    let threads = maybe::<u16>(given, "threads")?.unwrap_or_default().into();
    let denoise = match maybe::<String>(given, "denoise")?.as_deref() {
        None => None,
        Some("oidn") => Some(Denoiser::Oidn),
        Some(_) => Some(Denoiser::BuiltIn),
    };
    if denoise.is_some() && desc.render.samples.value < 2 {
        return Err(PyValueError::new_err("denoise needs two samples per pixel at least, as samples=16 has"));
    }
    if denoise == Some(Denoiser::Oidn) {
        // So that nothing is rendered in vain.
        Oidn::from_environment(threads).map_err(|why| {
            PyOSError::new_err(format!(
                "denoise=\"oidn\": no Open Image Denoise: {why}; install Open Image Denoise 2, or have {NAMED_BY} in \
                 os.environ name its library or the folder of that; denoise=True needs none"
            ))
        })?;
    }
    Ok(Settings { desc, crop, threads, layers, denoise })
}

/// What is wrong with the numbers that a caller may set; the rest was right when it was read.
fn faults(desc: &SceneDesc) -> Vec<scene_format::Diagnostic> {
    let ball = Sphere {
        center: [0.0; 3].into(),
        radius: 1.0.into(),
        material: Default::default(),
        transform: Vec::new(),
        placements: Default::default(),
        camera_visible: true,
        name: Default::default(),
    };
    let small = SceneDesc {
        image: desc.image.clone(),
        render: desc.render.clone(),
        effects: desc.effects.clone(),
        background: Background::Color([1.0; 3]),
        objects: vec![Object::from(ball).into()],
        ..SceneDesc::default()
    };
    small.validate().into_iter().filter(|fault| fault.severity == Severity::Error).collect()
}

/// Tells how far it is, and stops where that is wanted.
struct Watch<'a>(&'a Shared);

impl Observer for Watch<'_> {
    fn progress(&self, progress: Progress) -> ControlFlow<()> {
        self.0.done.store(progress.samples_done, Ordering::Relaxed);
        self.0.all.store(progress.samples_total, Ordering::Relaxed);
        if self.0.stopped.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// The film without its noise; or why not.
fn filtered(by: Denoiser, film: &Film, threads: usize) -> Result<Denoised, String> {
    if by == Denoiser::BuiltIn {
        return tracer_core::denoise(film).map_err(|error| error.to_string());
    }
    let noisy = Noisy::of(film).map_err(|error| error.to_string())?;
    let oidn = Oidn::from_environment(threads).map_err(|why| why.to_string())?;
    let Noisy { width, height, color, albedo, normal, .. } = &noisy;
    let picture = Picture { width: *width as usize, height: *height as usize, color, albedo, normal };
    let pixels = oidn.denoise(&picture).map_err(|fault| format!("{} has failed: {fault}", oidn.name()))?;
    noisy.denoised(pixels).map_err(|error| error.to_string())
}

fn made(held: &Held, settings: &Settings, shared: &Shared) -> Result<Made, Faults> {
    let Settings { desc, crop, threads, layers, denoise: denoised } = settings;
    let started = Instant::now();
    let scene: Arc<Scene> = held.compiled([desc.image.width.value, desc.image.height.value])?;
    let kept = if denoised.is_some() { layers.iter().chain(GUIDES).collect() } else { *layers };
    let time = desc.render.time.as_ref().and_then(|time| Duration::try_from_secs_f64(time.value).ok());
    let options = RenderOptions {
        samples: Some(desc.render.samples.value),
        seed: Some(desc.render.seed.value),
        crop: *crop,
        threads: *threads,
        noise: desc.render.noise.as_ref().map(|noise| noise.value),
        until: time.and_then(|time| started.checked_add(time)),
        layers: Some(kept),
        halves: denoised.is_some(),
        ..RenderOptions::default()
    };
    let film = tracer_core::render(&scene, &options, &Watch(shared));
    if let Some(diagnostics) = film.fault {
        return Err(Faults { diagnostics, sources: desc.sources.clone() });
    }
    let look = Look { exposure: desc.effects.exposure.value, ..scene.look };
    let mut note = None;
    let filtered = denoised.map(|by| filtered(by, &film, *threads)).transpose().unwrap_or_else(|error| {
        note = Some(format!("the picture is not denoised: {error}"));
        None
    });
    let mut image = match &filtered {
        Some(filtered) => develop_denoised(&film, &look, filtered),
        None => develop(&film, &look),
    };
    image.layers.retain(|layer| layer.name == "noisy" || layers.names().any(|name| name == layer.name));
    let stopped = shared.stopped.load(Ordering::Relaxed);
    Ok(Made { image, film, note, files: scene.files.clone(), stopped })
}
