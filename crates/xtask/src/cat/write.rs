//! OBJ, MTL and OFF.

use super::anatomy::Cat;
use super::mesh::Mesh;
use super::unwrap::{Atlas, Charted};
use anyhow::Context as _;
use glam::DVec3;
use std::collections::BTreeMap;
use std::fmt::Write as _;

/// An OBJ file with v, vt, vn; one vt per vertex and chart.
///
/// # Errors
/// When the atlas lacks a chart of the mesh.
pub fn obj(cat: &Cat, charted: &Charted, atlas: &Atlas, material: &str) -> anyhow::Result<String> {
    let Charted { mesh, charts } = charted;
    let mut text = String::with_capacity(100 * mesh.positions.len());
    text.push_str(
        "# A tabby cat, made by `cargo xtask cat`. x forward, y up, floor at y = 0.\nmtllib cat.mtl\no cat\n",
    );
    for p in &mesh.positions {
        line(&mut text, "v", &p.to_array(), 4);
    }
    let mut index_of = BTreeMap::new();
    let mut faces = String::with_capacity(40 * mesh.triangles.len());
    for (triangle, &id) in mesh.triangles.iter().zip(charts) {
        faces.push('f');
        for &v in triangle {
            let next = index_of.len() + 1;
            let vt = *index_of.entry((v, id)).or_insert(next);
            if vt == next {
                let uv =
                    atlas.uv(id, mesh.positions[v]).with_context(|| format!("the atlas lacks the chart {id:?}"))?;
                line(&mut text, "vt", &uv.to_array(), 5);
            }
            write!(faces, " {}/{vt}/{}", v + 1, v + 1)?;
        }
        faces.push('\n');
    }
    for &p in &mesh.positions {
        line(&mut text, "vn", &cat.normal(p).to_array(), 3);
    }
    writeln!(text, "usemtl {material}\ns 1")?;
    text.push_str(&faces);
    Ok(text)
}

/// The MTL file beside the OBJ files.
pub fn mtl(material: &str) -> String {
    format!("# Fur of the cat, see `cargo xtask cat`.\nnewmtl {material}\nKd 1 1 1\nillum 1\nmap_Kd cat.png\n")
}

/// An OFF file: positions and triangles alone.
pub fn off(mesh: &Mesh) -> String {
    let mut text =
        format!("OFF\n# A cat, made by `cargo xtask cat`.\n{} {} 0\n", mesh.positions.len(), mesh.triangles.len());
    for p in &mesh.positions {
        line(&mut text, "", &p.to_array(), 4);
    }
    for [a, b, c] in &mesh.triangles {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "3 {a} {b} {c}");
    }
    text
}

/// Positions as they will stand in the files, so that everything else is computed from what a reader sees.
pub fn rounded(p: DVec3) -> DVec3 {
    (p * 1e4).round() / 1e4
}

/// A line of a keyword (or none) and numbers, without the zeros at their ends.
pub fn line(text: &mut String, key: &str, values: &[f64], decimals: usize) {
    text.push_str(key);
    for (i, value) in values.iter().enumerate() {
        if i > 0 || !key.is_empty() {
            text.push(' ');
        }
        let digits = format!("{value:.decimals$}");
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        text.push_str(if digits == "-0" { "0" } else { digits });
    }
    text.push('\n');
}
