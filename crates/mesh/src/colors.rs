//! The colours of vertices.

use rayon::prelude::*;

/// What of a file is read beside what every mesh has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Wanted<'a> {
    /// The colours of vertices. Where they are not wanted they are counted in the mesh's warning, as what is ignored.
    pub colors: bool,
    /// This part of it alone: the faces of OBJ objects (`o`) and groups (`g`) of this name, or glTF nodes, with what is
    /// below them, and meshes of this name. The mesh is then that of a file with nothing else in it.
    pub part: Option<&'a str>,
}

/// The colours of all vertices of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct VertexColors {
    /// One for each of [`MeshData::positions`](crate::MeshData::positions).
    pub values: ColorValues,
    /// Whether the file means them to be in sRGB; else they are linear.
    pub is_srgb: bool,
}

/// Red, green and blue of all vertices, from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub enum ColorValues {
    /// Where all of them are 255ths: packed as `0x00BBGGRR`.
    Bytes(Vec<u32>),
    /// The numbers.
    Numbers(Vec<[f32; 3]>),
}

/// How far 255 times a number may be from a whole one, to be a 255th: six digits after the point are off by half of
/// 1e-6, times 255.
const OF_SIX_DIGITS: f32 = 2e-4;

impl VertexColors {
    /// Of numbers from 0 to 1, one triple for each vertex; what is beyond is clipped.
    pub fn new(numbers: Vec<[f32; 3]>, is_srgb: bool) -> Self {
        let clipped = |x: f32| if x > 0.0 { x.min(1.0) } else { 0.0 };
        let mut numbers = numbers;
        numbers.par_iter_mut().for_each(|color| *color = color.map(clipped));
        let is_whole = |x: f32| (255.0 * x - (255.0 * x).round()).abs() <= OF_SIX_DIGITS;
        let values = if numbers.par_iter().all(|color| color.iter().copied().all(is_whole)) {
            let byte = |x: f32| u32::from((255.0 * x).round() as u8);
            let pack = |&[r, g, b]: &[f32; 3]| byte(r) | byte(g) << 8 | byte(b) << 16;
            ColorValues::Bytes(numbers.par_iter().map(pack).collect())
        } else {
            ColorValues::Numbers(numbers)
        };
        VertexColors { values, is_srgb }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        match &self.values {
            ColorValues::Bytes(values) => values.len(),
            ColorValues::Numbers(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}
