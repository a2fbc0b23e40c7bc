//! Buffers and what stands in them: accessors, checked once and then read element by element.

use super::document::{Document, Element, List};
use crate::cursor::{Fault, shown};
use crate::files::Files;
use base64::Engine as _;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Bytes that repeated meshes and zeros may take, whatever the size of the file.
const FREE: u64 = 1 << 28;

/// Base64 with or without its padding.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new().with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Buffer {
    byte_length: u64,
    uri: Option<String>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct View {
    buffer: u32,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    byte_stride: Option<u64>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Accessor {
    buffer_view: Option<u32>,
    #[serde(default)]
    byte_offset: u64,
    component_type: u32,
    #[serde(default)]
    normalized: bool,
    count: u64,
    r#type: String,
    sparse: Option<SparseWords>,
}

#[derive(Deserialize)]
struct SparseWords {
    count: u64,
    indices: SparseIndices,
    values: SparseValues,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct SparseIndices {
    buffer_view: u32,
    #[serde(default)]
    byte_offset: u64,
    component_type: u32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct SparseValues {
    buffer_view: u32,
    #[serde(default)]
    byte_offset: u64,
}

/// What a component of an element is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Component {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Component {
    fn of(code: u32) -> Option<Component> {
        Some(match code {
            5120 => Component::I8,
            5121 => Component::U8,
            5122 => Component::I16,
            5123 => Component::U16,
            5125 => Component::U32,
            5126 => Component::F32,
            _ => return None,
        })
    }

    const fn bytes(self) -> usize {
        match self {
            Component::I8 | Component::U8 => 1,
            Component::I16 | Component::U16 => 2,
            Component::U32 | Component::F32 => 4,
        }
    }

    /// Whether it may be an index.
    const fn is_index(self) -> bool {
        matches!(self, Component::U8 | Component::U16 | Component::U32)
    }

    /// What normalized numbers are divided by.
    const fn largest(self) -> f64 {
        match self {
            Component::I8 => 127.0,
            Component::U8 => 255.0,
            Component::I16 => 32767.0,
            Component::U16 => 65535.0,
            Component::U32 | Component::F32 => 1.0,
        }
    }

    /// The number at the beginning of some bytes; zero where they are too few, which they never are.
    #[inline]
    fn number(self, bytes: &[u8]) -> f64 {
        fn chunk<const N: usize>(bytes: &[u8]) -> [u8; N] {
            bytes.first_chunk().copied().unwrap_or([0; N])
        }
        match self {
            Component::I8 => f64::from(i8::from_le_bytes(chunk(bytes))),
            Component::U8 => f64::from(u8::from_le_bytes(chunk(bytes))),
            Component::I16 => f64::from(i16::from_le_bytes(chunk(bytes))),
            Component::U16 => f64::from(u16::from_le_bytes(chunk(bytes))),
            Component::U32 => f64::from(u32::from_le_bytes(chunk(bytes))),
            Component::F32 => f64::from(f32::from_le_bytes(chunk(bytes))),
        }
    }
}

/// The bytes of a buffer.
#[derive(Clone)]
enum Bytes<'a> {
    /// Those of the container.
    Chunk(&'a [u8]),
    Own(Arc<Vec<u8>>),
}

impl Bytes<'_> {
    fn all(&self) -> &[u8] {
        match self {
            Bytes::Chunk(bytes) => bytes,
            Bytes::Own(bytes) => bytes,
        }
    }
}

/// Elements at equal distances, all of them within their buffer.
struct Run<'a> {
    bytes: Bytes<'a>,
    start: usize,
    stride: usize,
}

impl Run<'_> {
    /// The bytes from an element on.
    #[inline]
    fn from(&self, index: usize) -> &[u8] {
        self.bytes.all().get(self.start + index * self.stride..).unwrap_or_default()
    }
}

struct Sparse<'a> {
    /// Which elements are replaced, ascending.
    indices: Vec<u32>,
    values: Run<'a>,
}

/// The elements of an accessor, of N numbers each.
pub(super) struct Values<'a, const N: usize> {
    pub(super) count: usize,
    /// Where the accessor stands in the JSON, and what it is.
    pub(super) at: usize,
    pub(super) label: String,
    component: Component,
    normalized: bool,
    /// `None`: all zeros.
    run: Option<Run<'a>>,
    sparse: Option<Sparse<'a>>,
}

impl<const N: usize> Values<'_, N> {
    /// An element as it is written.
    #[inline]
    fn raw(&self, index: usize) -> [f64; N] {
        let replaced = self
            .sparse
            .as_ref()
            .and_then(|sparse| Some(sparse.values.from(sparse.indices.binary_search(&(index as u32)).ok()?)));
        let bytes = replaced.or_else(|| self.run.as_ref().map(|run| run.from(index)));
        let Some(bytes) = bytes else { return [0.0; N] };
        let size = self.component.bytes();
        std::array::from_fn(|k| self.component.number(bytes.get(k * size..).unwrap_or_default()))
    }

    /// An element; the fault is that it is no number.
    #[inline]
    pub(super) fn get(&self, index: usize) -> Result<[f64; N], Box<Fault>> {
        let value = self.raw(index);
        if !value.iter().all(|number| number.is_finite()) {
            return Err(self.no_number(index));
        }
        if !self.normalized {
            return Ok(value);
        }
        let largest = self.component.largest();
        Ok(value.map(|number| (number / largest).max(-1.0)))
    }

    #[cold]
    fn no_number(&self, index: usize) -> Box<Fault> {
        Fault::new(self.at, format!("element {index} of {} is not a finite number", self.label), "finite numbers")
    }
}

impl Values<'_, 1> {
    /// An index.
    #[inline]
    pub(super) fn index(&self, index: usize) -> u32 {
        let [number] = self.raw(index);
        number as u32
    }
}

/// The buffers of a file, each read when it is needed for the first time.
pub(super) struct Buffers<'a> {
    document: &'a Document<'a>,
    path: &'a Path,
    /// Where buffers are that lie beside it.
    files: &'a Files,
    chunk: Option<&'a [u8]>,
    known: BTreeMap<u32, Bytes<'a>>,
    of_files: BTreeMap<PathBuf, Bytes<'a>>,
    /// Bytes of the file and of its buffers.
    size: u64,
    spent: u64,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        document: &'a Document<'a>,
        (path, files): (&'a Path, &'a Files),
        chunk: Option<&'a [u8]>,
        size: u64,
    ) -> Self {
        Buffers { document, path, files, chunk, known: BTreeMap::new(), of_files: BTreeMap::new(), size, spent: 0 }
    }

    /// The files that were read.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        self.of_files.keys().cloned().collect()
    }

    /// Takes note of bytes that something named at a byte is going to take, or as much work.
    pub(super) fn spend(&mut self, bytes: u64, at: usize) -> Result<(), Box<Fault>> {
        self.spent = self.spent.saturating_add(bytes);
        let most = self.size.saturating_mul(9).saturating_add(FREE);
        if self.spent <= most {
            return Ok(());
        }
        let message = format!(
            "the scene of the file repeats its meshes, or zeros, beyond {} MB, while it has {} KB",
            most >> 20,
            self.size.div_ceil(1024)
        );
        Err(Fault::new(at, message, "one of each mesh; copies stand in the scene, as `placements`"))
    }

    fn buffer(&mut self, index: u32, named_at: usize) -> Result<Bytes<'a>, Box<Fault>> {
        if let Some(known) = self.known.get(&index) {
            return Ok(known.clone());
        }
        let label = List::Buffers.shown(index);
        let Element { value: Buffer { byte_length, uri }, at } =
            self.document.element(List::Buffers, index, named_at)?;
        let bytes = match uri {
            None => match self.chunk {
                Some(chunk) if index == 0 => Bytes::Chunk(chunk),
                _ => {
                    let expected = "a `uri`; only the first buffer of a GLB file goes without";
                    return Err(Fault::new(at, format!("{label} has no `uri`"), expected));
                }
            },
            Some(uri) => match is_data(&uri) {
                true => Bytes::Own(Arc::new(decoded(&uri, at, &label)?)),
                false => self.file(&uri, at, &label)?,
            },
        };
        let found = bytes.all().len();
        if (found as u64) < byte_length {
            let message = format!("{label} has {found} bytes instead of {byte_length}");
            return Err(Fault::new(at, message, "as many bytes as `byteLength` says"));
        }
        self.known.insert(index, bytes.clone());
        Ok(bytes)
    }

    /// The file that a URI names, beside the mesh.
    fn file(&mut self, uri: &str, at: usize, label: &str) -> Result<Bytes<'a>, Box<Fault>> {
        let scheme = uri.split_once(':').map_or("", |(scheme, _)| scheme);
        if scheme.len() > 1 && scheme.bytes().all(|b| b.is_ascii_alphanumeric() || b"+-.".contains(&b)) {
            let message = format!("{label} is at {}, which is not fetched", shown(uri.as_bytes()));
            return Err(Fault::new(at, message, "the name of a file beside the mesh, or a `data:` URI"));
        }
        let name = percent_encoding::percent_decode_str(uri).decode_utf8_lossy();
        let path = self.path.parent().unwrap_or(Path::new("")).join(&*name);
        if let Some(known) = self.of_files.get(&path) {
            return Ok(known.clone());
        }
        let bytes = self
            .files
            .read(&path)
            .map_err(|error| Fault::new(at, format!("{label}: {error}"), "the buffer's file beside the mesh"))?;
        self.size += bytes.len() as u64;
        let bytes = Bytes::Own(Arc::new(bytes));
        self.of_files.insert(path, bytes.clone());
        Ok(bytes)
    }

    /// All bytes of a view.
    pub(super) fn view(&mut self, view: u32, named_at: usize) -> Result<Vec<u8>, Box<Fault>> {
        let Element { value, .. } = self.document.element::<View>(List::BufferViews, view, named_at)?;
        let run = self.run(view, 0, 1, value.byte_length, (named_at, "the picture"))?;
        let bytes = run.from(0).get(..value.byte_length as usize);
        Ok(bytes.unwrap_or_default().to_vec())
    }

    /// So many elements of so many bytes from a place of a view on.
    fn run(&mut self, view: u32, offset: u64, count: u64, size: u64, of: (usize, &str)) -> Result<Run<'a>, Box<Fault>> {
        let (named_at, label) = of;
        let Element { value, at } = self.document.element::<View>(List::BufferViews, view, named_at)?;
        let shown = List::BufferViews.shown(view);
        let bytes = self.buffer(value.buffer, at)?;
        let length = bytes.all().len() as u64;
        if value.byte_offset.saturating_add(value.byte_length) > length {
            let message = format!(
                "{shown} goes from byte {} over {} bytes, but {} has {length}",
                value.byte_offset,
                value.byte_length,
                List::Buffers.shown(value.buffer)
            );
            return Err(Fault::new(at, message, "a view within its buffer"));
        }
        let stride = value.byte_stride.unwrap_or(size);
        if stride < size {
            let message = format!("{shown} has a `byteStride` of {stride}, but {label} has elements of {size} bytes");
            return Err(Fault::new(at, message, "a `byteStride` of at least an element"));
        }
        let needed = match count {
            0 => 0,
            _ => (count - 1).saturating_mul(stride).saturating_add(size).saturating_add(offset),
        };
        if needed > value.byte_length {
            let message = format!("{label} needs {needed} bytes of {shown}, which has {}", value.byte_length);
            return Err(Fault::new(named_at, message, "elements within their view"));
        }
        // Within the buffer, so all of it fits a usize.
        Ok(Run { bytes, start: (value.byte_offset + offset.min(needed)) as usize, stride: stride as usize })
    }

    /// Whether the elements of an accessor, named at a byte, have four numbers.
    pub(super) fn are_fours(&self, index: u32, named_at: usize) -> Result<bool, Box<Fault>> {
        let Element { value, .. } = self.document.element::<Accessor>(List::Accessors, index, named_at)?;
        Ok(value.r#type == "VEC4")
    }

    /// An accessor of elements of N numbers, named at a byte.
    pub(super) fn values<const N: usize>(
        &mut self,
        index: u32,
        named_at: usize,
        what: &str,
    ) -> Result<Values<'a, N>, Box<Fault>> {
        let Element { value: accessor, at } = self.document.element::<Accessor>(List::Accessors, index, named_at)?;
        let label = format!("{} ({what})", List::Accessors.shown(index));
        let kind = ["", "SCALAR", "VEC2", "VEC3", "VEC4"].get(N).copied().unwrap_or_default();
        if accessor.r#type != kind {
            let message = format!("{label} is {}", shown(accessor.r#type.as_bytes()));
            return Err(Fault::new(at, message, format!("the type {kind}")));
        }
        let component =
            Component::of(accessor.component_type).filter(|c| if N == 1 { c.is_index() } else { *c != Component::U32 });
        let Some(component) = component else {
            let message = format!("{label} has the componentType {}", accessor.component_type);
            let expected =
                if N == 1 { "5121, 5123 or 5125 (whole numbers from 0)" } else { "5126 (float), or 5120 to 5123" };
            return Err(Fault::new(at, message, expected));
        };
        if accessor.count > u64::from(u32::MAX) {
            let message = format!("{label} has {} elements", accessor.count);
            return Err(Fault::new(at, message, format!("at most {}", u32::MAX)));
        }
        let size = (N * component.bytes()) as u64;
        let run = match accessor.buffer_view {
            Some(view) => Some(self.run(view, accessor.byte_offset, accessor.count, size, (at, &label))?),
            None => None,
        };
        let sparse = match &accessor.sparse {
            Some(sparse) => Some(self.sparse(sparse, accessor.count, size, (at, &label))?),
            None => None,
        };
        let normalized = accessor.normalized && component != Component::F32;
        Ok(Values { count: accessor.count as usize, at, label, component, normalized, run, sparse })
    }

    /// The elements that are written anew.
    fn sparse(
        &mut self,
        words: &SparseWords,
        count: u64,
        size: u64,
        of: (usize, &str),
    ) -> Result<Sparse<'a>, Box<Fault>> {
        let (at, label) = of;
        let component = Component::of(words.indices.component_type).filter(|component| component.is_index());
        let Some(component) = component else {
            let message =
                format!("the sparse indices of {label} have the componentType {}", words.indices.component_type);
            return Err(Fault::new(at, message, "5121, 5123 or 5125 (whole numbers from 0)"));
        };
        let indices = &words.indices;
        let run = self.run(indices.buffer_view, indices.byte_offset, words.count, component.bytes() as u64, of)?;
        let values = self.run(words.values.buffer_view, words.values.byte_offset, words.count, size, of)?;
        self.spend(words.count.saturating_mul(4), at)?;
        let indices: Vec<u32> = (0..words.count as usize).map(|k| component.number(run.from(k)) as u32).collect();
        let ascending = indices.is_sorted_by(|a, b| a < b);
        if !ascending || indices.last().is_some_and(|&last| u64::from(last) >= count) {
            let message = format!("the sparse indices of {label} do not ascend, or name elements that are not there");
            return Err(Fault::new(at, message, format!("ascending numbers below {count}")));
        }
        Ok(Sparse { indices, values })
    }
}

/// Whether a URI holds its data itself.
pub(super) fn is_data(uri: &str) -> bool {
    uri.get(..5).is_some_and(|scheme| scheme.eq_ignore_ascii_case("data:"))
}

/// What a `data:` URI holds.
pub(super) fn decoded(uri: &str, at: usize, label: &str) -> Result<Vec<u8>, Box<Fault>> {
    const EXPECTED: &str = "data:application/octet-stream;base64, and the bytes in base 64";
    let Some((head, data)) = uri.split_once(',') else {
        return Err(Fault::new(at, format!("the data of {label} have no comma before them"), EXPECTED));
    };
    if !head.to_ascii_lowercase().ends_with(";base64") {
        return Err(Fault::new(at, format!("the data of {label} are not in base 64"), EXPECTED));
    }
    match BASE64.decode(data) {
        Ok(bytes) => Ok(bytes),
        Err(error) => Err(Fault::new(at, format!("the data of {label} are broken: {error}"), EXPECTED)),
    }
}
