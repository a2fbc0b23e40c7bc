//! A picture on its way to Python: numbers, and functions that make files of it.

use crate::rendering::Made;
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyByteArray, PyBytes, PyCFunction, PyDict, PyTuple};
use scene_format::SceneDesc;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tracer_core::Image;
use tracer_picture::{Bits, Encoding, Provenance, Setting, encode, is_one_file, save};

/// Puts a picture into a dictionary: `width`, `height`, `linear` and `display` (with alpha where there is one),
/// `layers` (name, channels, numbers; light groups as `light.key`), `samples`, `noise`, `stopped`, `note`, and the
/// functions `encode` and `save`.
///
/// # Errors
/// When there is no memory.
pub fn put(out: &Bound<'_, PyDict>, made: Made, desc: &SceneDesc) -> PyResult<()> {
    let py = out.py();
    let Made { image, film, note, files, stopped } = made;
    out.set_item("width", image.width)?;
    out.set_item("height", image.height)?;
    out.set_item("channels", if image.alpha.is_some() { 4 } else { 3 })?;
    out.set_item("linear", with_alpha(py, &image, &image.linear, f32::to_ne_bytes)?)?;
    out.set_item("display", with_alpha(py, &image, &image.display, |x| [(x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8])?)?;
    let layers = image.layers.iter().map(|layer| {
        let numbers = bytes(py, layer.values.iter().copied(), layer.values.len(), f32::to_ne_bytes)?;
        Ok((layer.name.to_owned(), layer.channels.len(), numbers))
    });
    let groups = image.light_groups.chunks_exact(3).map(|group| {
        let [(name, red), (_, green), (_, blue)] = group else { unreachable!("three channels each") };
        let numbers = red.iter().zip(green).zip(blue).flat_map(|((&r, &g), &b)| [r, g, b]);
        let name = name.strip_suffix(".R").unwrap_or(name).to_owned();
        Ok((name, 3, bytes(py, numbers, 3 * red.len(), f32::to_ne_bytes)?))
    });
    out.set_item("layers", layers.chain(groups).collect::<PyResult<Vec<_>>>()?)?;
    let samples = film.samples();
    out.set_item("samples", (*samples.start(), *samples.end()))?;
    let noise = film.relative_noise();
    out.set_item("noise", noise.is_finite().then_some(noise))?;
    out.set_item("seed", film.seed())?;
    out.set_item("stopped", stopped)?;
    out.set_item("note", note)?;
    let provenance = Arc::new(provenance(&image, film.seed(), *samples.end(), desc));
    let image = Arc::new(image);
    let spared: Vec<PathBuf> = files.into_iter().chain(desc.sources.first().map(|s| PathBuf::from(&s.name))).collect();
    let (its_image, its_provenance) = (Arc::clone(&image), Arc::clone(&provenance));
    let encode = PyCFunction::new_closure(
        py,
        Some(c"encode"),
        Some(c"encode(name, bits) -> bytes: the bytes of a file of this kind."),
        move |args: &Bound<'_, PyTuple>, _| {
            let encoding = encoding(args, |name, bits| Encoding::from_name(name, bits).ok())?;
            let made = args.py().detach(|| encode(&its_image, encoding, &its_provenance));
            made.map(|bytes| PyBytes::new(args.py(), &bytes).unbind()).map_err(wrong)
        },
    )?;
    out.set_item("encode", encode)?;
    let save = PyCFunction::new_closure(
        py,
        Some(c"save"),
        Some(c"save(path, bits): writes a file, of the kind that its extension says."),
        move |args: &Bound<'_, PyTuple>, _| {
            let encoding = encoding(args, |name, bits| Encoding::from_path(Path::new(name), bits).ok())?;
            let path: PathBuf = args.get_item(0)?.extract()?;
            if spared.iter().any(|file| is_one_file(file, &path)) {
                let message = format!("the scene is made of {}: it is not overwritten", path.display());
                return Err(PyValueError::new_err(message));
            }
            let bytes = args.py().detach(|| encode_to(&image, encoding, &provenance, &path));
            bytes.map_err(wrong)
        },
    )?;
    out.set_item("save", save)
}

fn encode_to(
    image: &Image,
    of: Encoding,
    provenance: &Provenance,
    path: &Path,
) -> Result<(), tracer_picture::WriteError> {
    save(path, &encode(image, of, provenance)?)
}

fn wrong(error: tracer_picture::WriteError) -> PyErr {
    PyOSError::new_err(error.to_string())
}

/// The kind of file that a name and a number of bits say.
fn encoding(args: &Bound<'_, PyTuple>, of: impl Fn(&str, Bits) -> Option<Encoding>) -> PyResult<Encoding> {
    let name: PathBuf = args.get_item(0)?.extract()?;
    let bits = match args.get_item(1)?.extract::<u32>()? {
        8 => Bits::Eight,
        16 => Bits::Sixteen,
        other => return Err(PyValueError::new_err(format!("bits is 8 or 16, and not {other}"))),
    };
    of(&name.to_string_lossy(), bits).ok_or_else(|| {
        let shown = name.display();
        let kinds = Encoding::NAMES.join(", ");
        PyValueError::new_err(format!("{shown} is none of the kinds of pictures that are written: {kinds}"))
    })
}

/// What the file is to tell of itself.
fn provenance(image: &Image, seed: u32, samples: u32, desc: &SceneDesc) -> Provenance {
    let source = desc.sources.first();
    let setting = |name, value: String| Setting { name, value };
    Provenance {
        scene_name: source.map(|source| file_name(&source.name)).unwrap_or_default(),
        scene_text: source.map(|source| source.text.clone()).unwrap_or_default(),
        settings: vec![
            setting("size", format!("{}x{}", image.width, image.height)),
            setting("samples", samples.to_string()),
            setting("seed", seed.to_string()),
        ],
        ..Provenance::default()
    }
}

fn file_name(name: &str) -> String {
    Path::new(name).file_name().map_or_else(|| name.to_owned(), |name| name.to_string_lossy().into_owned())
}

/// Three numbers of each pixel, and its alpha behind them where there is one.
fn with_alpha<'py, const N: usize>(
    py: Python<'py>,
    image: &Image,
    values: &[f32],
    of: impl Fn(f32) -> [u8; N],
) -> PyResult<Bound<'py, PyByteArray>> {
    match &image.alpha {
        None => bytes(py, values.iter().copied(), values.len(), of),
        Some(alpha) => {
            let pixels = values.as_chunks::<3>().0.iter().zip(alpha);
            let numbers = pixels.flat_map(|(&[r, g, b], &a)| [r, g, b, a]);
            bytes(py, numbers, values.len() + alpha.len(), of)
        }
    }
}

/// So many numbers as memory that Python may write to.
fn bytes<'py, const N: usize>(
    py: Python<'py>,
    values: impl Iterator<Item = f32>,
    count: usize,
    of: impl Fn(f32) -> [u8; N],
) -> PyResult<Bound<'py, PyByteArray>> {
    PyByteArray::new_with(py, N * count, |buffer| {
        for (slot, value) in buffer.as_chunks_mut::<N>().0.iter_mut().zip(values) {
            *slot = of(value);
        }
        Ok(())
    })
}
