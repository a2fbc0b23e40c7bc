//! The colours of meshes' vertices, where a texture reads them.

use super::{Instance, Scene, Texel};

/// What the numbers of vertices' colours mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum VertexSpace {
    /// As their file has it.
    AsFile = 0,
    /// sRGB.
    Srgb = 1,
    /// Linear.
    Linear = 2,
}

/// How colours stand in [`ColorTable::words`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Coded {
    /// One word `0x00BBGGRR` a vertex, in sRGB.
    Srgb8 = 0,
    /// One word `0x00BBGGRR` a vertex, 255ths of linear light.
    Linear8 = 1,
    /// Three words a vertex: linear light as floats.
    Floats = 2,
}

/// The colours of a mesh as they are read in one way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshColors {
    /// How they stand.
    pub coded: Coded,
    /// The word of its first vertex.
    pub first_word: u32,
    /// The number of its first vertex in [`Triangles::positions`](super::Triangles::positions).
    pub first_vertex: u32,
}

/// Colours of vertices; nothing where no texture reads any.
#[derive(Default)]
pub struct ColorTable {
    /// All colours, each once however many meshes have them; three words at least.
    pub words: Vec<u32>,
    /// Which mesh each instance is of.
    pub mesh: Vec<u32>,
    /// By [`VertexSpace`], a pair a mesh: how its colours are [`Coded`], and where they begin, counted from the vertex
    /// of number 0 (modulo 2^32); empty where no texture reads them so.
    pub places: [Vec<u32>; 3],
}

impl ColorTable {
    /// Of the meshes' colours by [`VertexSpace`]: of each mesh how they are read, `None` where nothing reads them; an
    /// empty list where no texture reads any so.
    pub fn new(mut words: Vec<u32>, of_meshes: [Vec<Option<MeshColors>>; 3], instances: &[Instance]) -> Self {
        if of_meshes.iter().all(Vec::is_empty) {
            return ColorTable::default();
        }
        // Floats are read three at a time.
        words.resize(words.len().max(3), 0);
        let pair = |of: &Option<MeshColors>| {
            of.map_or([0; 2], |MeshColors { coded, first_word, first_vertex }| {
                let stride = if coded == Coded::Floats { 3 } else { 1 };
                [coded as u32, first_word.wrapping_sub(first_vertex.wrapping_mul(stride))]
            })
        };
        let places = of_meshes.map(|meshes| meshes.iter().flat_map(pair).collect());
        ColorTable { words, mesh: instances.iter().map(|instance| instance.mesh).collect(), places }
    }
}

impl Scene {
    /// The colour of a vertex (an index into [`Triangles::positions`](super::Triangles::positions)) of an instance;
    /// `None` where no texture reads it so.
    pub fn vertex_color(&self, space: VertexSpace, instance: u32, vertex: u32) -> Option<Texel> {
        let table = &self.tables.colors;
        let mesh = *table.mesh.get(instance as usize)? as usize;
        let place = table.places.get(space as usize)?.get(2 * mesh..2 * mesh + 2)?;
        let word = |k: u32| table.words.get(place[1].wrapping_add(k) as usize).copied();
        if place[0] == Coded::Floats as u32 {
            let first = vertex.wrapping_mul(3);
            let part = |k: u32| word(first.wrapping_add(k)).map(f32::from_bits);
            return Some(Texel::Linear([part(0)?, part(1)?, part(2)?]));
        }
        let [red, green, blue, _] = word(vertex)?.to_le_bytes();
        let bytes = [red, green, blue];
        let linear = || bytes.map(|byte| (f64::from(byte) / 255.0) as f32);
        Some(if place[0] == Coded::Srgb8 as u32 { Texel::Srgb8(bytes) } else { Texel::Linear(linear()) })
    }
}
