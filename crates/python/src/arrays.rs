//! What a scene names and Python has in memory: bytes of numbers, of files.

use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList};
use scene_format::desc::Faces;
use tracer_core::mesh::{MeshArrays, VertexColors};
use tracer_core::texture::Pixels;
use tracer_core::{Asset, Assets};

/// The assets of a list of dictionaries, each with `name` and what `kind` says.
///
/// # Errors
/// When one cannot be: the message has its name.
pub fn assets(list: &Bound<'_, PyList>) -> PyResult<Assets> {
    let mut assets = Assets::default();
    for item in list.iter() {
        let item: &Bound<'_, PyDict> = item.cast()?;
        let name: String = field(item, "name")?.extract()?;
        assets.insert(&name, asset(item, &name)?);
    }
    Ok(assets)
}

fn asset(item: &Bound<'_, PyDict>, name: &str) -> PyResult<Asset> {
    let wrong = |error: &dyn std::fmt::Display| PyValueError::new_err(format!("asset {name:?}: {error}"));
    let bytes = |key: &str| -> PyResult<Vec<u8>> { Ok(field(item, key)?.cast::<PyBytes>()?.as_bytes().to_vec()) };
    let number = |key: &str| -> PyResult<u32> { field(item, key)?.extract() };
    let kind: String = field(item, "kind")?.extract()?;
    Ok(match kind.as_str() {
        "file" => bytes("bytes")?.into(),
        "mesh" => {
            let mut faces = Faces::default();
            let corners: Vec<u32> = numbers(&bytes("faces")?, u32::from_ne_bytes);
            let width = number("corners")? as usize;
            corners.chunks_exact(width.max(1)).for_each(|face| faces.push(face));
            let points = numbers(&bytes("points")?, f64::from_ne_bytes).as_chunks::<3>().0.to_vec();
            let normals = numbers(&bytes("normals")?, f64::from_ne_bytes).as_chunks::<3>().0.to_vec();
            let uvs = numbers(&bytes("uvs")?, f64::from_ne_bytes).as_chunks::<2>().0.to_vec();
            let of_bytes = number("color_bytes")? == 1;
            let colors = bytes("colors")?;
            let shares: Vec<f32> = match of_bytes {
                true => colors.iter().map(|byte| f32::from(*byte) / 255.0).collect(),
                false => numbers(&colors, f32::from_ne_bytes),
            };
            let colors = (!shares.is_empty()).then(|| VertexColors::new(shares.as_chunks::<3>().0.to_vec(), of_bytes));
            MeshArrays { points, faces, normals, uvs, colors }.into()
        }
        kind => {
            let (width, height, channels) = (number("width")?, number("height")?, number("channels")?);
            let values = bytes("values")?;
            let pixels = match kind {
                "uint8" => Pixels::srgb8(width, height, channels, values),
                "uint16" => Pixels::srgb16(width, height, channels, numbers(&values, u16::from_ne_bytes)),
                _ => Pixels::linear(width, height, channels, numbers(&values, f32::from_ne_bytes)),
            };
            pixels.map_err(|error| wrong(&error))?.into()
        }
    })
}

fn field<'py>(item: &Bound<'py, PyDict>, key: &str) -> PyResult<Bound<'py, PyAny>> {
    item.get_item(key)?.ok_or_else(|| PyValueError::new_err(format!("an asset without {key}")))
}

/// Numbers as memory holds them.
fn numbers<const N: usize, T>(bytes: &[u8], of: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.as_chunks::<N>().0.iter().map(|bytes| of(*bytes)).collect()
}
