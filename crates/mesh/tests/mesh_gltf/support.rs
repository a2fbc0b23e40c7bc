//! Files of glTF, made piece by piece.

use serde_json::{Value, json};
use std::path::Path;
use tracer_mesh::{MeshData, MeshError, MeshFormat, parse};

/// A file in the making: one buffer, filled by accessors.
pub struct File {
    pub json: Value,
    pub binary: Vec<u8>,
}

pub const FLOAT: u32 = 5126;

impl File {
    /// A file with nothing in it.
    pub fn new() -> File {
        let json = json!({
            "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [] }], "nodes": [], "meshes": [],
            "accessors": [], "bufferViews": [], "buffers": [{ "byteLength": 0 }],
        });
        File { json, binary: Vec::new() }
    }

    fn push(&mut self, list: &str, value: Value) -> usize {
        let list = self.json[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    /// A view of some bytes.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        let start = self.binary.len();
        self.binary.extend(bytes);
        self.json["buffers"][0]["byteLength"] = self.binary.len().into();
        self.push("bufferViews", json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() }))
    }

    /// An accessor of some bytes.
    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({ "bufferView": view, "componentType": component, "type": kind, "count": count }))
    }

    pub fn floats<const N: usize>(&mut self, values: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = values.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(&bytes, FLOAT, ["", "SCALAR", "VEC2", "VEC3"][N], values.len())
    }

    pub fn shorts(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.accessor(&bytes, 5123, "SCALAR", indices.len())
    }

    pub fn mesh(&mut self, primitives: Value) -> usize {
        self.push("meshes", json!({ "primitives": primitives }))
    }

    /// A node of the scene.
    pub fn root(&mut self, node: Value) -> usize {
        let node = self.node(node);
        self.json["scenes"][0]["nodes"].as_array_mut().expect("nodes").push(node.into());
        node
    }

    pub fn node(&mut self, node: Value) -> usize {
        self.push("nodes", node)
    }

    /// As a container.
    pub fn glb(&self) -> Vec<u8> {
        glb(&self.json.to_string(), &self.binary)
    }

    /// As text, with the buffer in it.
    pub fn text(&self) -> String {
        let mut json = self.json.clone();
        use base64::Engine as _;
        let data = base64::engine::general_purpose::STANDARD.encode(&self.binary);
        json["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{data}").into();
        format!("{json:#}")
    }

    pub fn read(&self) -> MeshData {
        let mesh = parse(&self.glb(), MeshFormat::Glb, Path::new("m.glb")).expect("a mesh");
        assert_eq!(
            parse(self.text().as_bytes(), MeshFormat::Gltf, Path::new("m.gltf")).map(plain).ok(),
            Some(plain(mesh.clone()))
        );
        mesh
    }

    /// Without the name of the file.
    pub fn fault(&self) -> [String; 2] {
        fault_of(parse(&self.glb(), MeshFormat::Glb, Path::new("m.glb")))
    }
}

/// What does not depend on the name of the file.
fn plain(mesh: MeshData) -> MeshData {
    MeshData { warnings: Vec::new().into_iter().collect(), ..mesh }
}

pub fn fault_of(read: Result<MeshData, MeshError>) -> [String; 2] {
    match read {
        Err(MeshError::Broken { message, expected, .. }) => [message, expected],
        other => panic!("{other:?}"),
    }
}

/// A container.
pub fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = [&b"glTF"[..], &2_u32.to_le_bytes(), &[0; 4]].concat();
    for (kind, content) in [(b"JSON", &json[..]), (b"BIN\0", binary)] {
        bytes.extend((content.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(content);
    }
    let length = (bytes.len() as u32).to_le_bytes();
    bytes[8..12].copy_from_slice(&length);
    bytes
}

/// A square in the plane z = 0, its corners counterclockwise from the lower left.
pub const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
