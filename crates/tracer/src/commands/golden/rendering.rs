//! A scene of a folder, rendered as its settings say, with what is known of its noise.

use crate::compare::before_checkerboard;
use crate::interrupt;
use crate::loading::with_faults_of_files;
use crate::write::sha256;
use scene_format::render::{Style, text};
use scene_format::{LoadError, Loaded, Override, SceneDesc, hash_hex};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use tracer_core::{Film, LayerImage, Level, Observer, Progress, RenderOptions, Scene, develop, named_files, render};
use tracer_golden::folder::Case;
use tracer_golden::measured::{Measured, Recorder};
use tracer_golden::picture::Rgb8;
use tracer_golden::settings::{FILE, Settings, Shows};

/// What was made of a scene.
pub struct Rendered {
    /// As a PNG has it.
    pub picture: Rgb8,
    /// Where the folder keeps noise.
    pub measured: Option<Measured>,
    /// Everything that it was made of.
    pub files: Vec<PathBuf>,
    /// What all of that is known by.
    pub stamp: String,
}

/// Why there is no picture.
pub enum NoPicture {
    /// The scene is wrong: what is wrong in lines, and the files that it names as far as is known.
    Wrong {
        /// In lines.
        what: String,
        /// Its own among them.
        files: Vec<PathBuf>,
    },
    /// Ctrl-C.
    Interrupted,
}

/// Columns of what is said of faults: it goes into files, too.
const STYLE: Style = Style { color: false, width: 100 };

/// Reads a scene and sets what the settings say.
///
/// # Errors
/// When it is wrong.
pub fn load(case: &Case, settings: &Settings) -> Result<SceneDesc, NoPicture> {
    let own = settings.of(&case.name);
    let camera = own.camera.as_deref().map(Override::camera);
    let overrides: Vec<Override> = own.set.iter().cloned().map(Override::from).chain(camera).collect();
    let folder = case.scene.parent().unwrap_or(Path::new(""));
    let Loaded { scene: mut desc, .. } = scene_format::load_with(&case.scene, &overrides).map_err(|error| {
        let error = with_faults_of_files(error, folder);
        let what = match &error {
            LoadError::Invalid { diagnostics, sources, undecided, .. } => {
                let mut errors = diagnostics.to_vec();
                errors.retain(|fault| fault.severity == scene_format::Severity::Error);
                let mut told = text(&errors, sources, STYLE).trim_end().to_owned();
                if let Some(camera) = undecided {
                    told += &format!(
                        "\n\nhere one is chosen in {FILE}: `camera = {camera:?}` for all scenes, or below \
                         `[scene.{:?}]` for this one",
                        case.name
                    );
                }
                told
            }
            LoadError::Io { .. } => error.to_string(),
        };
        let named = match error {
            LoadError::Invalid { files, .. } => files.into_iter().map(|file| folder.join(file.path)).collect(),
            LoadError::Io { .. } => Vec::new(),
        };
        NoPicture::Wrong { what, files: named }
    })?;
    if let Some([width, height]) = own.size {
        (desc.image.width, desc.image.height) = (width.into(), height.into());
    }
    if let Some(samples) = own.samples {
        desc.render.samples = samples.into();
    }
    if let Some(seed) = own.seed {
        desc.render.seed = seed.into();
    }
    Ok(desc)
}

/// What a picture is known by: the scene with its settings, and the contents of the files that it uses. A file that
/// cannot be read any more is none.
pub fn stamp(desc: &SceneDesc, files: &[PathBuf]) -> String {
    let mut known = hash_hex(desc);
    for file in files {
        known += &std::fs::read(file).map_or_else(|_| "gone".to_owned(), |bytes| sha256(&bytes));
    }
    sha256(known.as_bytes())
}

/// Renders a scene.
///
/// # Errors
/// When it is wrong, or Ctrl-C ended it.
pub fn make(case: &Case, settings: &Settings, threads: usize, level: Level) -> Result<Rendered, NoPicture> {
    let desc = load(case, settings)?;
    let mut files = named_files(&desc);
    let mut scene = tracer_core::compile(&desc).map_err(|error| {
        let what = text(&error.diagnostics, &desc.sources, STYLE).trim_end().to_owned();
        NoPicture::Wrong { what, files: files.clone() }
    })?;
    files.extend(scene.files.iter().cloned());
    files.sort();
    files.dedup();
    // A clock makes other pictures every time; where noise is kept, pictures have the samples that they are said to
    // have.
    scene.time = None;
    if settings.noise {
        scene.noise = None;
    }
    let watch = Watch::new(&scene, settings.noise);
    // The shortest passes there are: of one sample, so that the film can be seen after each. The picture is the same.
    let longest_pass = settings.noise.then_some(Duration::ZERO);
    let options = RenderOptions { threads, level: Some(level), longest_pass, ..RenderOptions::default() };
    let film = render(&scene, &options, &watch);
    if interrupt::requested().is_some() {
        return Err(NoPicture::Interrupted);
    }
    if let Some(faults) = &film.fault {
        let what = text(faults, &desc.sources, STYLE).trim_end().to_owned();
        return Err(NoPicture::Wrong { what, files });
    }
    let left_out = film.counters.dropped;
    if left_out > 0 {
        let what = format!("{left_out} samples were not finite, which is a fault of this program; please report it");
        return Err(NoPicture::Wrong { what, files });
    }
    let image = develop(&film, &scene.look);
    let asked = tracer_core::layer_set(&desc.output.layers);
    let mut layers = image.layers.iter().filter(|layer| asked.names().any(|name| name == layer.name));
    let shown = layers.next().filter(|_| settings.shows == Shows::Layer);
    let rgb = match shown {
        Some(layer) => codes(layer),
        // As the program writes files: in single precision a value just below a half is rounded up.
        None => {
            let shown: Vec<f64> = match &image.alpha {
                None => image.display.iter().map(|&x| x.into()).collect(),
                Some(alpha) => {
                    let pixels = image.display.as_chunks::<3>().0.iter().zip(alpha).enumerate();
                    let at = |k: usize| [k % image.width as usize, k / image.width as usize];
                    pixels.flat_map(|(k, (&color, &alpha))| before_checkerboard(color, alpha, at(k))).collect()
                }
            };
            shown.iter().map(|x| (x * 255.0 + 0.5) as u8).collect()
        }
    };
    let measured = watch.measured(&film, &scene, image.linear);
    let stamp = stamp(&desc, &files);
    Ok(Rendered { picture: Rgb8 { width: image.width, height: image.height, rgb }, measured, files, stamp })
}

/// A layer as it can be looked at: its least number black and its greatest white, and what is not finite, too.
fn codes(layer: &LayerImage) -> Vec<u8> {
    let finite = || layer.values.iter().copied().filter(|x| x.is_finite()).map(f64::from);
    let (least, most) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let code = |x: f32| if x.is_finite() { ((f64::from(x) - least) / (most - least) * 255.0 + 0.5) as u8 } else { 255 };
    let pixels = layer.values.chunks_exact(layer.channels.len());
    pixels.flat_map(|pixel| [0, 1, 2].map(|c| code(pixel[c % pixel.len()]))).collect()
}

/// Sees what samples bring to the film, and ends the rendering on Ctrl-C.
struct Watch {
    recorder: Option<Mutex<Recorder>>,
    /// Of the exposure.
    gain: f64,
}

impl Watch {
    fn new(scene: &Scene, noise: bool) -> Self {
        let recorder = noise.then(|| Mutex::new(Recorder::new(scene.size[0], scene.size[1], scene.samples)));
        Watch { recorder, gain: libm::exp2(scene.look.exposure) }
    }

    fn measured(self, film: &Film, scene: &Scene, linear: Vec<f32>) -> Option<Measured> {
        let batches = self.recorder?.into_inner().unwrap_or_else(PoisonError::into_inner).batches()?;
        let [width, height] = scene.size;
        let gain2 = self.gain * self.gain;
        // What is beyond the range of f32 is its largest number, as in a film's layers.
        let variance = |(x, y)| (film.variance(x, y) * gain2).min(f64::from(f32::MAX)) as f32;
        let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
        Some(Measured {
            width,
            height,
            samples: scene.samples,
            // The unit is the power of two below the brightest light.
            brightest: (2.0 * scene.radiance_unit * self.gain).min(f64::from(f32::MAX)) as f32,
            look: format!("exposure {}, tone map {:?}", scene.look.exposure, scene.look.tone_map),
            rgb: linear,
            variance: pixels.map(variance).collect(),
            batches,
        })
    }
}

impl Observer for Watch {
    fn progress(&self, _: Progress) -> ControlFlow<()> {
        if interrupt::requested().is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn pass(&self, film: &Film) {
        let Some(recorder) = &self.recorder else { return };
        let mut recorder = recorder.lock().unwrap_or_else(PoisonError::into_inner);
        let samples = *film.samples().end();
        if recorder.wants(samples) {
            recorder.see(samples, |x, y| film.radiance(x, y).map(|channel| channel * self.gain));
        }
    }
}
