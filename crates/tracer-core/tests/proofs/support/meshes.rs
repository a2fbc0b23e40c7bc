//! Meshes and pictures made on the spot, written to files as a person would have them.

use scene_format::desc::{Faces, InlineMesh, MeshSource};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;

/// A triangle mesh, counter-clockwise from outside.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    pub positions: Vec<[f64; 3]>,
    /// Unit vertex normals; may be empty.
    pub normals: Vec<[f64; 3]>,
    /// May be empty.
    pub uvs: Vec<[f64; 2]>,
    pub triangles: Vec<[usize; 3]>,
}

/// Where the proofs write their files. One name per content: proofs run at the same time, and may write the same file.
pub fn write(name: &str, bytes: &[u8]) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("proofs");
    std::fs::create_dir_all(&folder).expect("a folder for meshes");
    let path = folder.join(name);
    let unfinished = folder.join(format!("{name}.{:?}", std::thread::current().id()));
    std::fs::write(&unfinished, bytes).expect("a mesh file");
    std::fs::rename(&unfinished, &path).expect("a mesh file");
    path
}

impl Mesh {
    /// As an OBJ file with what the mesh has.
    pub fn obj(&self, name: &str) -> PathBuf {
        let mut text = String::new();
        for [x, y, z] in &self.positions {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        for [x, y, z] in &self.normals {
            writeln!(text, "vn {x} {y} {z}").unwrap();
        }
        for [u, v] in &self.uvs {
            writeln!(text, "vt {u} {v}").unwrap();
        }
        for triangle in &self.triangles {
            text.push('f');
            for corner in triangle {
                let k = corner + 1;
                let uv = if self.uvs.is_empty() { String::new() } else { k.to_string() };
                let normal = if self.normals.is_empty() { String::new() } else { k.to_string() };
                write!(text, " {k}/{uv}/{normal}").unwrap();
            }
            text.push('\n');
        }
        let text = text.replace("//\n", "\n").replace("// ", " ");
        write(&format!("{name}.obj"), text.as_bytes())
    }

    /// As an OFF file: positions and triangles.
    pub fn off(&self, name: &str) -> PathBuf {
        let mut text = format!("OFF\n{} {} 0\n", self.positions.len(), self.triangles.len());
        for [x, y, z] in &self.positions {
            writeln!(text, "{x} {y} {z}").unwrap();
        }
        for [a, b, c] in &self.triangles {
            writeln!(text, "3 {a} {b} {c}").unwrap();
        }
        write(&format!("{name}.off"), text.as_bytes())
    }

    /// As a binary PLY file with what the mesh has, in double precision.
    pub fn ply(&self, name: &str) -> PathBuf {
        let (places, triangles) = (self.positions.len(), self.triangles.len());
        let mut bytes = format!("ply\nformat binary_big_endian 1.0\nelement vertex {places}\n").into_bytes();
        let has =
            [(&["x", "y", "z"][..], places), (&["nx", "ny", "nz"], self.normals.len()), (&["u", "v"], self.uvs.len())];
        for name in has.iter().filter(|(_, count)| *count > 0).flat_map(|(names, _)| *names) {
            bytes.extend(format!("property double {name}\n").bytes());
        }
        let faces = format!("element face {triangles}\nproperty list uchar uint vertex_indices\nend_header\n");
        bytes.extend(faces.bytes());
        for vertex in 0..places {
            let parts = [&self.positions[vertex][..], self.normals.get(vertex).map_or(&[], |normal| normal)];
            let parts = parts.into_iter().chain([self.uvs.get(vertex).map_or(&[][..], |uv| uv)]);
            bytes.extend(parts.flatten().flat_map(|x| x.to_be_bytes()));
        }
        for triangle in &self.triangles {
            bytes.push(3);
            bytes.extend(triangle.iter().flat_map(|&corner| (corner as u32).to_be_bytes()));
        }
        write(&format!("{name}.ply"), &bytes)
    }

    /// As an ASCII STL file: the places of the triangles' corners.
    pub fn stl(&self, name: &str) -> PathBuf {
        let mut text = format!("solid {name}\n");
        for triangle in &self.triangles {
            text += "facet normal 0 0 0\nouter loop\n";
            for [x, y, z] in triangle.map(|corner| self.positions[corner]) {
                writeln!(text, "vertex {x} {y} {z}").unwrap();
            }
            text += "endloop\nendfacet\n";
        }
        text += "endsolid\n";
        write(&format!("{name}.stl"), text.as_bytes())
    }

    /// As a glTF container with what the mesh has. The format has single precision: see [`Mesh::in_single_precision`].
    pub fn glb(&self, name: &str) -> PathBuf {
        let floats =
            |rows: &mut dyn Iterator<Item = f64>| rows.flat_map(|x| (x as f32).to_le_bytes()).collect::<Vec<u8>>();
        let down = self.uvs.iter().flat_map(|&[u, v]| [u, 1.0 - v]);
        let corners = self.triangles.as_flattened().iter();
        let parts = [
            ("\"POSITION\"", 5126, "VEC3", 12, floats(&mut self.positions.iter().flatten().copied())),
            ("\"NORMAL\"", 5126, "VEC3", 12, floats(&mut self.normals.iter().flatten().copied())),
            ("\"TEXCOORD_0\"", 5126, "VEC2", 8, floats(&mut down.into_iter())),
            ("", 5125, "SCALAR", 4, corners.flat_map(|&corner| (corner as u32).to_le_bytes()).collect()),
        ];
        let (mut attributes, mut accessors, mut views, mut binary) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for (word, component, kind, size, bytes) in parts.into_iter().filter(|part| !part.4.is_empty()) {
            let (number, count) = (views.len(), bytes.len() / size);
            if !word.is_empty() {
                attributes.push(format!("{word}:{number}"));
            }
            accessors.push(format!(
                "{{\"bufferView\":{number},\"componentType\":{component},\"type\":\"{kind}\",\"count\":{count}}}"
            ));
            let (at, length) = (binary.len(), bytes.len());
            views.push(format!("{{\"buffer\":0,\"byteOffset\":{at},\"byteLength\":{length}}}"));
            binary.extend(bytes);
        }
        let mut json = format!(
            "{{\"asset\":{{\"version\":\"2.0\"}},\"scene\":0,\"scenes\":[{{\"nodes\":[0]}}],\"nodes\":[{{\"mesh\":0}}],\
             \"meshes\":\
             [{{\"primitives\":[{{\"attributes\":{{{}}},\"indices\":{}}}]}}],\
             \"accessors\":[{}],\"bufferViews\":[{}],\"buffers\":\
             [{{\"byteLength\":{}}}]}}",
            attributes.join(","),
            attributes.len(),
            accessors.join(","),
            views.join(","),
            binary.len()
        );
        json.extend(std::iter::repeat_n(' ', json.len().next_multiple_of(4) - json.len()));
        let length = 28 + json.len() + binary.len();
        let mut bytes = [&b"glTF\x02\0\0\0"[..], &(length as u32).to_le_bytes()].concat();
        for (kind, content) in [(b"JSON", json.as_bytes()), (b"BIN\0", &binary)] {
            bytes.extend((content.len() as u32).to_le_bytes());
            bytes.extend(kind);
            bytes.extend(content);
        }
        write(&format!("{name}.glb"), &bytes)
    }

    /// With numbers that single precision holds, 1 - v among them.
    pub fn in_single_precision(&self) -> Mesh {
        let round = |p: &[f64; 3]| p.map(|x| f64::from(x as f32));
        Mesh {
            positions: self.positions.iter().map(round).collect(),
            normals: self.normals.iter().map(round).collect(),
            uvs: self.uvs.iter().map(|uv| uv.map(|t| (t * 4096.0).round() / 4096.0)).collect(),
            triangles: self.triangles.clone(),
        }
    }

    /// As a scene writes it out: places and triangles.
    pub fn written_out(&self) -> MeshSource {
        let mut faces = Faces::default();
        self.triangles.iter().for_each(|corners| faces.push(&corners.map(|corner| corner as u32)));
        MeshSource::Inline(Arc::new(InlineMesh { points: self.positions.clone(), faces, colors: Vec::new() }.into()))
    }

    /// With its vertices in the order in which the triangles name them, without those that none names.
    pub fn in_order_of_use(&self) -> Mesh {
        let mut numbers = vec![None; self.positions.len()];
        let mut mesh = Mesh::default();
        for triangle in &self.triangles {
            mesh.triangles.push(triangle.map(|corner| {
                *numbers[corner].get_or_insert_with(|| {
                    mesh.positions.push(self.positions[corner]);
                    mesh.normals.extend(self.normals.get(corner));
                    mesh.uvs.extend(self.uvs.get(corner));
                    mesh.positions.len() - 1
                })
            }));
        }
        mesh
    }
}

fn normalised(p: [f64; 3]) -> [f64; 3] {
    let length = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
    p.map(|x| x / length)
}

/// An icosahedron whose triangles are cut into four `cuts` times, on the unit sphere, with its normals: 20 * 4^cuts
/// triangles.
pub fn icosphere(cuts: u32) -> Mesh {
    let phi = (1.0 + 5f64.sqrt()) / 2.0;
    let mut positions: Vec<[f64; 3]> = Vec::new();
    for (a, b) in [(-1.0, phi), (1.0, phi), (-1.0, -phi), (1.0, -phi)] {
        positions.push(normalised([a, b, 0.0]));
    }
    for (a, b) in [(-1.0, phi), (1.0, phi), (-1.0, -phi), (1.0, -phi)] {
        positions.push(normalised([0.0, a, b]));
    }
    for (a, b) in [(-1.0, phi), (1.0, phi), (-1.0, -phi), (1.0, -phi)] {
        positions.push(normalised([b, 0.0, a]));
    }
    let mut triangles = vec![
        [0, 11, 5],
        [0, 5, 1],
        [0, 1, 7],
        [0, 7, 10],
        [0, 10, 11],
        [1, 5, 9],
        [5, 11, 4],
        [11, 10, 2],
        [10, 7, 6],
        [7, 1, 8],
        [3, 9, 4],
        [3, 4, 2],
        [3, 2, 6],
        [3, 6, 8],
        [3, 8, 9],
        [4, 9, 5],
        [2, 4, 11],
        [6, 2, 10],
        [8, 6, 7],
        [9, 8, 1],
    ];
    for _ in 0..cuts {
        let mut middles = BTreeMap::new();
        let mut middle = |a: usize, b: usize| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push(normalised([0, 1, 2].map(|k| positions[a][k] + positions[b][k])));
                positions.len() - 1
            })
        };
        let cut = |[a, b, c]: [usize; 3]| {
            let (ab, bc, ca) = (middle(a, b), middle(b, c), middle(c, a));
            [[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    Mesh { normals: positions.clone(), positions, uvs: Vec::new(), triangles }
}

/// A torus about the y axis, large radius 1, small radius `tube`, with normals and texture coordinates (its seam is
/// doubled).
pub fn torus(tube: f64, around: usize, across: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..=around {
        for j in 0..=across {
            let (u, v) = (i as f64 / around as f64, j as f64 / across as f64);
            let (a, b) = (u * std::f64::consts::TAU, v * std::f64::consts::TAU);
            let outward = [a.cos(), 0.0, -a.sin()];
            let normal = [outward[0] * b.cos(), b.sin(), outward[2] * b.cos()];
            mesh.positions.push([0, 1, 2].map(|k| outward[k] + tube * normal[k]));
            mesh.normals.push(normal);
            mesh.uvs.push([3.0 * u, 2.0 * v]);
        }
    }
    let at = |i: usize, j: usize| i * (across + 1) + j;
    for i in 0..around {
        for j in 0..across {
            mesh.triangles.push([at(i, j), at(i + 1, j), at(i + 1, j + 1)]);
            mesh.triangles.push([at(i, j), at(i + 1, j + 1), at(i, j + 1)]);
        }
    }
    mesh
}

/// A cube from -1 to 1.
pub fn cube() -> Mesh {
    let positions = (0..8usize).map(|k| [0, 1, 2].map(|axis| if k >> axis & 1 == 1 { 1.0 } else { -1.0 })).collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    Mesh { positions, triangles, ..Mesh::default() }
}

/// A square in y = 0 from -1 to 1, seen from above, with texture coordinates from 0 to `repeat`.
pub fn square(repeat: f64) -> Mesh {
    Mesh {
        positions: vec![[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]],
        normals: Vec::new(),
        uvs: vec![[0.0, 0.0], [repeat, 0.0], [repeat, repeat], [0.0, repeat]],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

/// A colourful picture, 5 x 4 texels, 8 bits.
pub fn picture() -> PathBuf {
    let color = |i: u32, j: u32| [(i * 60 + 10) as u8, (j * 80 + 5) as u8, ((i + j) % 2 * 200 + 30) as u8];
    let pixels: Vec<u8> = (0..4).flat_map(|j| (0..5).flat_map(move |i| color(i, j))).collect();
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::RgbImage::from_raw(5, 4, pixels)
        .expect("20 texels")
        .write_to(&mut bytes, image::ImageFormat::Png)
        .expect("a picture in memory");
    write("picture.png", bytes.get_ref())
}

/// Another, 3 x 7 texels, 16 bits.
pub fn deep_picture() -> PathBuf {
    let pixels: Vec<u16> = (0..63u32).map(|k| (k * 1021 + 400) as u16).collect();
    let mut bytes = std::io::Cursor::new(Vec::new());
    let picture: image::ImageBuffer<image::Rgb<u16>, _> =
        image::ImageBuffer::from_raw(3, 7, pixels).expect("21 texels");
    image::DynamicImage::from(picture).write_to(&mut bytes, image::ImageFormat::Png).expect("a picture in memory");
    write("deep.png", bytes.get_ref())
}
