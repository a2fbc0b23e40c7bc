//! From the nodes of the default scene to triangles.

use super::accessor::{Buffers, Values};
use super::document::{Document, Element, List};
use super::instancing::Instancing;
use crate::builder::{Builder, MOST_VERTICES, coordinate};
use crate::colors::Wanted;
use crate::cursor::Fault;
use crate::data::NO_INDEX;
use crate::oddities::Oddity;
use glam::{DAffine3, DMat3, DQuat, DVec3, DVec4};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::value::RawValue;
use std::collections::BTreeMap;

#[derive(Deserialize)]
struct Scene {
    #[serde(default)]
    nodes: Vec<u32>,
}

#[derive(Deserialize)]
struct Node {
    mesh: Option<u32>,
    #[serde(default)]
    extensions: NodeExtensions,
    #[serde(default)]
    children: Vec<u32>,
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
}

#[derive(Deserialize, Default)]
struct NodeExtensions {
    #[serde(rename = "EXT_mesh_gpu_instancing")]
    instancing: Option<Instancing>,
}

#[derive(Deserialize)]
struct Children {
    #[serde(default)]
    children: Vec<u32>,
}

#[derive(Deserialize)]
struct Mesh<'a> {
    #[serde(borrow, default)]
    primitives: Vec<&'a RawValue>,
}

#[derive(Deserialize)]
struct Primitive {
    attributes: Attributes,
    indices: Option<u32>,
    material: Option<u32>,
    mode: Option<u32>,
    #[serde(default)]
    targets: Vec<IgnoredAny>,
}

#[derive(Deserialize)]
struct Attributes {
    #[serde(rename = "POSITION")]
    position: Option<u32>,
    #[serde(rename = "NORMAL")]
    normal: Option<u32>,
    #[serde(rename = "TEXCOORD_0")]
    uv: Option<u32>,
    #[serde(rename = "COLOR_0")]
    color: Option<u32>,
}

/// What was found besides triangles.
#[derive(Default)]
pub(super) struct Found {
    /// Meshes on the nodes of the scene.
    pub(super) meshes: u64,
    /// Primitives with morph targets.
    pub(super) morphs: u64,
    /// Materials of triangles, in order of first use.
    pub(super) materials: Vec<u32>,
    /// For each triangle, which of these it has; empty: all have the default.
    pub(super) triangle_material: Vec<u32>,
    /// How many triangles have no texture coordinates where others have some, by their material.
    pub(super) without_uvs: BTreeMap<Option<u32>, u64>,
    /// Texture coordinates of triangles, where some have none.
    pub(super) uvs: Option<Vec<[u32; 3]>>,
}

/// Triangles in a row that are of one kind.
struct Stretch {
    end: usize,
    /// Whether they have texture coordinates.
    uv: bool,
    /// Their material, by its number in the file.
    material: Option<u32>,
}

/// Nodes of one parent that are still to be visited.
struct Siblings {
    nodes: std::vec::IntoIter<u32>,
    /// From the parent to the scene.
    parent: DAffine3,
    /// Where the parent stands, which names them.
    named_at: usize,
    /// Whether the parent, or one above it, is the part that is wanted.
    in_part: bool,
}

impl Siblings {
    fn new(nodes: Vec<u32>, parent: DAffine3, named_at: usize, in_part: bool) -> Siblings {
        Siblings { nodes: nodes.into_iter(), parent, named_at, in_part }
    }
}

/// The part that is wanted.
struct Part<'n> {
    name: &'n str,
    /// Of each mesh its name, until it is met in the scene, and whether it is of the part.
    meshes: Vec<(Option<String>, bool)>,
    /// Names of nodes and meshes that were met.
    names: Vec<String>,
    is_there: bool,
}

impl<'n> Part<'n> {
    fn new(document: &Document<'_>, name: &'n str) -> Part<'n> {
        let of_mesh = |mesh: u32| {
            let named = document.name_of(List::Meshes, mesh);
            let is_part = named.as_deref() == Some(name);
            (named, is_part)
        };
        let meshes = (0..document.count(List::Meshes) as u32).map(of_mesh).collect();
        Part { name, meshes, names: Vec::new(), is_there: false }
    }

    /// Whether a node of the scene is the part.
    fn is_of_node(&mut self, name: Option<String>) -> bool {
        let is_part = name.as_deref() == Some(self.name);
        self.names.extend(name);
        self.is_there |= is_part;
        is_part
    }

    /// Whether a mesh of the scene is the part.
    fn is_of_mesh(&mut self, index: u32) -> bool {
        // The mesh that there is not is told by who reads it.
        let Some((name, is_part)) = self.meshes.get_mut(index as usize) else { return true };
        self.names.extend(name.take());
        self.is_there |= *is_part;
        *is_part
    }
}

/// Vertices of one primitive or of several that share them.
#[derive(Clone, Copy)]
struct Vertices {
    first: u32,
    count: u32,
}

/// A place in the tree of nodes.
#[derive(Clone, Copy)]
struct Placed {
    map: DAffine3,
    /// Of normals: the inverse transposed, times a positive number.
    normals: DMat3,
    mirrored: bool,
}

impl Placed {
    fn new(map: DAffine3) -> Placed {
        // Brought to a size of one: products of three columns must stay numbers.
        let m = map.matrix3;
        let largest = m.to_cols_array().iter().fold(0.0_f64, |largest, part| largest.max(part.abs()));
        let m = if largest > 0.0 { m * (1.0 / largest) } else { m };
        let mirrored = m.determinant() < 0.0;
        let sign = if mirrored { -1.0 } else { 1.0 };
        let cofactors = [(m.y_axis, m.z_axis), (m.z_axis, m.x_axis), (m.x_axis, m.y_axis)];
        let [x, y, z] = cofactors.map(|(a, b)| a.cross(b) * sign);
        Placed { map, normals: DMat3::from_cols(x, y, z), mirrored }
    }
}

/// The walk over the nodes.
pub(super) struct Walk<'w, 'a> {
    document: &'a Document<'a>,
    builder: &'w mut Builder,
    buffers: &'w mut Buffers<'a>,
    /// Whether colours of vertices are.
    wants_colors: bool,
    part: Option<Part<'w>>,
    stretches: Vec<Stretch>,
    pub(super) found: Found,
}

impl<'w, 'a> Walk<'w, 'a> {
    pub(super) fn new(
        document: &'a Document<'a>,
        builder: &'w mut Builder,
        buffers: &'w mut Buffers<'a>,
        wanted: Wanted<'w>,
    ) -> Self {
        builder.colors_are = (1.0, false);
        let part = wanted.part.map(|name| Part::new(document, name));
        let (stretches, found) = (Vec::new(), Found::default());
        Walk { document, builder, buffers, wants_colors: wanted.colors, part, stretches, found }
    }

    /// The names of the scene's nodes and meshes, where a part is wanted and the scene has none of this name.
    pub(super) fn names_without_part(&self) -> Option<impl Iterator<Item = &str>> {
        let part = self.part.as_ref().filter(|part| !part.is_there)?;
        Some(part.names.iter().map(String::as_str))
    }

    /// Brings all meshes of the default scene.
    pub(super) fn all(&mut self) -> Result<(), Box<Fault>> {
        let mut visited = vec![false; self.document.count(List::Nodes)];
        let mut open: Vec<Siblings> = Vec::new();
        match (self.document.scene(), self.document.count(List::Scenes)) {
            (None, 0) if visited.is_empty() => {
                for mesh in 0..self.document.count(List::Meshes) as u32 {
                    self.mesh(mesh, 0, DAffine3::IDENTITY, false)?;
                }
            }
            (None, 0) => open.push(Siblings::new(self.roots()?, DAffine3::IDENTITY, 0, false)),
            (scene, _) => {
                let Element { value, at } =
                    self.document.element::<Scene>(List::Scenes, scene.unwrap_or_default(), 0)?;
                open.push(Siblings::new(value.nodes, DAffine3::IDENTITY, at, false));
            }
        }
        while let Some(Siblings { nodes, parent, named_at, in_part }) = open.last_mut() {
            let (parent, named_at, in_part) = (*parent, *named_at, *in_part);
            let Some(node) = nodes.next() else {
                open.pop();
                continue;
            };
            let Element { value, at } = self.document.element::<Node>(List::Nodes, node, named_at)?;
            match visited.get_mut(node as usize) {
                Some(visited) if !*visited => *visited = true,
                _ => {
                    let message = format!("{} is met twice on the way down from the scene", List::Nodes.shown(node));
                    return Err(Fault::new(named_at, message, "nodes with one parent each, and no circle"));
                }
            }
            let map = parent * map_of(&value, node, at)?;
            if !map.is_finite() {
                let message = format!("the matrices down to {} leave the range of numbers", List::Nodes.shown(node));
                return Err(Fault::new(at, message, "finite numbers"));
            }
            // A name that is no text is no fault of those who do not ask for it.
            let name = || self.document.name_of(List::Nodes, node);
            let in_part = in_part || self.part.as_mut().is_some_and(|part| part.is_of_node(name()));
            if let Some(mesh) = value.mesh {
                match &value.extensions.instancing {
                    None => self.mesh(mesh, at, map, in_part)?,
                    Some(instancing) => {
                        let words = self.document.length(List::Meshes, mesh);
                        for placement in instancing.placements(self.buffers, words, at)? {
                            self.mesh(mesh, at, map * placement, in_part)?;
                        }
                    }
                }
            }
            open.push(Siblings::new(value.children, map, at, in_part));
        }
        self.finish_uvs();
        self.finish_materials()
    }

    /// Which material each triangle has.
    fn finish_materials(&mut self) -> Result<(), Box<Fault>> {
        if self.stretches.iter().all(|stretch| stretch.material.is_none()) {
            return Ok(());
        }
        self.buffers.spend(4 * self.builder.mesh.triangles.len() as u64, 0)?;
        let mut index_of: BTreeMap<u32, u32> = BTreeMap::new();
        let mut triangles = Vec::with_capacity(self.builder.mesh.triangles.len());
        for Stretch { end, material, .. } in &self.stretches {
            let index = material.map_or(NO_INDEX, |number| {
                *index_of.entry(number).or_insert_with(|| {
                    self.found.materials.push(number);
                    self.found.materials.len() as u32 - 1
                })
            });
            triangles.resize(*end, index);
        }
        self.found.triangle_material = triangles;
        Ok(())
    }

    /// The nodes that are nobody's children.
    fn roots(&self) -> Result<Vec<u32>, Box<Fault>> {
        let count = self.document.count(List::Nodes) as u32;
        let mut root = vec![true; count as usize];
        for node in 0..count {
            let Element { value: Children { children }, .. } = self.document.element(List::Nodes, node, 0)?;
            for child in children {
                if let Some(root) = root.get_mut(child as usize) {
                    *root = false;
                }
            }
        }
        Ok((0..).zip(root).filter_map(|(node, root)| root.then_some(node)).collect())
    }

    /// Brings a mesh. `in_part`: its node, or one above that, is the part that is wanted.
    fn mesh(&mut self, index: u32, named_at: usize, map: DAffine3, in_part: bool) -> Result<(), Box<Fault>> {
        if self.part.as_mut().is_some_and(|part| !part.is_of_mesh(index) && !in_part) {
            return Ok(());
        }
        let Element { value: Mesh { primitives }, at } = self.document.element(List::Meshes, index, named_at)?;
        self.found.meshes += 1;
        let placed = Placed::new(map);
        // Primitives of a mesh often share their vertices.
        let mut known: BTreeMap<[u32; 4], Vertices> = BTreeMap::new();
        for (k, raw) in primitives.into_iter().enumerate() {
            let label = || format!("{}.primitives[{k}]", List::Meshes.shown(index));
            self.buffers.spend(raw.get().len() as u64, at)?;
            let Element { value: primitive, at } = self.document.read::<Primitive>(raw, label)?;
            self.primitive(&primitive, at, &label, &placed, &mut known)?;
        }
        Ok(())
    }

    fn primitive(
        &mut self,
        primitive: &Primitive,
        at: usize,
        label: &impl Fn() -> String,
        placed: &Placed,
        known: &mut BTreeMap<[u32; 4], Vertices>,
    ) -> Result<(), Box<Fault>> {
        let attributes = &primitive.attributes;
        let mode = primitive.mode.unwrap_or(4);
        if mode > 6 {
            return Err(Fault::new(at, format!("{} has the mode {mode}", label()), "a mode from 0 to 6"));
        }
        if mode < 4 {
            self.builder.oddities.add(Oddity::OtherPrimitive);
            return Ok(());
        }
        let Some(position) = attributes.position else {
            self.builder.oddities.add(Oddity::NoPositions);
            return Ok(());
        };
        self.found.morphs += u64::from(!primitive.targets.is_empty());
        let color = attributes.color.filter(|_| self.wants_colors);
        let key = [Some(position), attributes.normal, attributes.uv, color].map(|of| of.unwrap_or(NO_INDEX));
        let vertices = match known.get(&key) {
            Some(&vertices) => vertices,
            None => {
                let vertices = self.vertices(position, attributes, at, placed)?;
                known.insert(key, vertices);
                vertices
            }
        };
        let first = self.builder.mesh.triangles.len();
        match primitive.indices {
            Some(indices) => {
                let values = self.buffers.values::<1>(indices, at, "indices")?;
                self.triangles(mode, values.count, at, vertices, placed.mirrored, |k| {
                    let index = values.index(k);
                    if index < vertices.count { Ok(index) } else { Err(no_vertex(&values, k, index, vertices.count)) }
                })?;
            }
            None => {
                self.triangles(mode, vertices.count as usize, at, vertices, placed.mirrored, |k| Ok(k as u32))?;
            }
        }
        let end = self.builder.mesh.triangles.len();
        if end > first {
            let count = (end - first) as u64;
            self.stretches.push(Stretch { end, uv: attributes.uv.is_some(), material: primitive.material });
            if attributes.color.is_some() && !self.wants_colors {
                self.builder.oddities.add_many(Oddity::VertexColor, u64::from(vertices.count));
            }
            if attributes.normal.is_none() {
                self.builder.without_normals(count);
            }
        }
        Ok(())
    }

    /// Adds the vertices of a primitive.
    fn vertices(
        &mut self,
        position: u32,
        attributes: &Attributes,
        at: usize,
        placed: &Placed,
    ) -> Result<Vertices, Box<Fault>> {
        // Position, normal, texture coordinates.
        const BYTES: u64 = 24 + 12 + 8;
        let positions = self.buffers.values::<3>(position, at, "POSITION")?;
        let first = self.builder.mesh.positions.len();
        self.buffers.spend(BYTES * positions.count as u64, at)?;
        if (first + positions.count) as u64 > MOST_VERTICES {
            return Err(Fault::new(at, "too many vertices", format!("at most {MOST_VERTICES}")));
        }
        self.builder.mesh.positions.reserve(positions.count);
        for k in 0..positions.count {
            let point = placed.map.transform_point3(DVec3::from(positions.get(k)?)).to_array();
            for number in point {
                coordinate(number, positions.at)?;
            }
            self.builder.mesh.positions.push(point);
        }
        let same = |count: usize, at: usize, label: &str| match count == positions.count {
            true => Ok(()),
            false => {
                let message = format!("{label} has {count} elements, but {} has {}", positions.label, positions.count);
                Err(Fault::new(at, message, "as many of each attribute as there are positions"))
            }
        };
        if let Some(normal) = attributes.normal {
            let normals = self.buffers.values::<3>(normal, at, "NORMAL")?;
            same(normals.count, normals.at, &normals.label)?;
            self.builder.lack_normals(first);
            for k in 0..normals.count {
                let normal = placed.normals * DVec3::from(normals.get(k)?);
                self.builder.add_normal(normal.to_array());
            }
        }
        if let Some(uv) = attributes.uv {
            let uvs = self.buffers.values::<2>(uv, at, "TEXCOORD_0")?;
            same(uvs.count, uvs.at, &uvs.label)?;
            self.builder.mesh.uvs.resize(first, [0.0; 2]);
            for k in 0..uvs.count {
                let [u, v] = uvs.get(k)?;
                self.builder.add_uv([u, 1.0 - v], uvs.at)?;
            }
        }
        if let Some(color) = attributes.color.filter(|_| self.wants_colors) {
            self.buffers.spend(12 * positions.count as u64, at)?;
            if self.buffers.are_fours(color, at)? {
                let colors = self.buffers.values::<4>(color, at, "COLOR_0")?;
                same(colors.count, colors.at, &colors.label)?;
                self.colors(first, &colors)?;
            } else {
                let colors = self.buffers.values::<3>(color, at, "COLOR_0")?;
                same(colors.count, colors.at, &colors.label)?;
                self.colors(first, &colors)?;
            }
        }
        Ok(Vertices { first: first as u32, count: positions.count as u32 })
    }

    /// Adds the colours of the vertices from here on; alpha is passed over.
    fn colors<const N: usize>(&mut self, first: usize, colors: &Values<'_, N>) -> Result<(), Box<Fault>> {
        self.builder.lack_colors(first);
        for k in 0..colors.count {
            if let [red, green, blue, ..] = colors.get(k)?[..] {
                self.builder.add_color([red, green, blue]);
            }
        }
        Ok(())
    }

    /// Adds the triangles of so many corners in a row.
    fn triangles(
        &mut self,
        mode: u32,
        corners: usize,
        at: usize,
        vertices: Vertices,
        mirrored: bool,
        corner: impl Fn(usize) -> Result<u32, Box<Fault>>,
    ) -> Result<(), Box<Fault>> {
        // A triangle and the indices of its normals and texture coordinates.
        const BYTES: u64 = 3 * 12;
        let count = if mode == 4 { corners / 3 } else { corners.saturating_sub(2) };
        self.buffers.spend(BYTES * count as u64, at)?;
        // What is left of the corners is no triangle.
        let left = if mode == 4 { corners % 3 } else { corners % 3 * usize::from(corners < 3) };
        self.builder.oddities.add_many(Oddity::SmallFace, u64::from(left > 0));
        for k in 0..count {
            // Section 3.7.2.1 of the specification has the order of strips and fans.
            let [a, b, c] = match mode {
                4 => [3 * k, 3 * k + 1, 3 * k + 2],
                5 => [k, k + 1 + k % 2, k + 2 - k % 2],
                _ => [k + 1, k + 2, 0],
            };
            let [a, b, c] = [corner(a)?, corner(b)?, corner(c)?].map(|index| vertices.first + index);
            self.builder.add_triangle(if mirrored { [a, c, b] } else { [a, b, c] });
        }
        Ok(())
    }

    /// Where some triangles have texture coordinates and some have none: which each has.
    fn finish_uvs(&mut self) {
        if !self.stretches.iter().any(|stretch| stretch.uv) {
            self.builder.mesh.uvs = Vec::new();
            return;
        }
        let count = self.builder.mesh.positions.len();
        self.builder.mesh.uvs.resize(count, [0.0; 2]);
        if self.stretches.iter().all(|stretch| stretch.uv) {
            return;
        }
        let mut uvs = Vec::with_capacity(self.builder.mesh.triangles.len());
        for Stretch { end, uv, material } in &self.stretches {
            let rest = self.builder.mesh.triangles.get(uvs.len()..*end).unwrap_or_default();
            if *uv {
                uvs.extend_from_slice(rest);
            } else {
                *self.found.without_uvs.entry(*material).or_default() += rest.len() as u64;
                uvs.resize(*end, [NO_INDEX; 3]);
            }
        }
        self.found.uvs = Some(uvs);
    }
}

#[cold]
fn no_vertex(indices: &Values<'_, 1>, k: usize, index: u32, count: u32) -> Box<Fault> {
    let message = format!("element {k} of {} names vertex {index}, but there are {count}", indices.label);
    Fault::new(indices.at, message, "indices below the number of vertices")
}

/// The matrix of a node.
fn map_of(node: &Node, index: u32, at: usize) -> Result<DAffine3, Box<Fault>> {
    if let Some(m) = node.matrix {
        let [x, y, z, w] = *m.as_chunks::<4>().0 else { return Ok(DAffine3::IDENTITY) };
        if [x, y, z, w].map(|column| DVec4::from(column).w) != [0.0, 0.0, 0.0, 1.0] {
            let message = format!("the matrix of {} is no affine one", List::Nodes.shown(index));
            return Err(Fault::new(at, message, "0, 0, 0, 1 as its last row"));
        }
        let [x, y, z, w] = [x, y, z, w].map(|[x, y, z, _]| DVec3::new(x, y, z));
        return Ok(DAffine3 { matrix3: DMat3::from_cols(x, y, z), translation: w });
    }
    let rotation = match node.rotation {
        None => DQuat::IDENTITY,
        Some(rotation) => {
            let rotation = DVec4::from(rotation);
            let largest = rotation.abs().max_element();
            if largest == 0.0 {
                let message = format!("the rotation of {} is zero", List::Nodes.shown(index));
                return Err(Fault::new(at, message, "a quaternion of length one"));
            }
            DQuat::from_vec4((rotation / largest).normalize())
        }
    };
    let scale = DVec3::from(node.scale.unwrap_or([1.0; 3]));
    let translation = DVec3::from(node.translation.unwrap_or_default());
    Ok(DAffine3::from_scale_rotation_translation(scale, rotation, translation))
}
