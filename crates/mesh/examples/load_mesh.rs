//! Loads a mesh and prints what it has, and how long that took: `cargo run --release -p tracer-mesh --example load_mesh
//! -- cat.obj`.
//!
//! `--make BYTES` first writes an OBJ file of about that size to the path: a wavy sheet with `vt` and `vn`.

use std::error::Error;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;
use tracer_mesh as mesh;

fn main() -> Result<(), Box<dyn Error>> {
    let mut make = None;
    let mut path = None;
    let mut arguments = std::env::args_os().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--make" {
            let bytes = arguments.next().and_then(|bytes| bytes.into_string().ok());
            make = Some(bytes.ok_or("--make needs a number of bytes")?.parse::<u64>()?);
        } else {
            path = Some(PathBuf::from(argument));
        }
    }
    let path = path.ok_or("usage: load_mesh [--make BYTES] MESH")?;
    if let Some(bytes) = make {
        write_sheet(&path, bytes)?;
    }
    let bytes = std::fs::metadata(&path)?.len();
    for _ in 0..3 {
        let start = Instant::now();
        let mesh = mesh::load(&path)?;
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "{}: {} vertices, {} triangles, {} normals, {} uvs, {} materials; {:.1} MB in {:.3} s",
            path.display(),
            mesh.positions.len(),
            mesh.triangles.len(),
            mesh.normals.len(),
            mesh.uvs.len(),
            mesh.materials.len(),
            bytes as f64 / 1e6,
            seconds,
        );
        for warning in &mesh.warnings {
            println!("  {}: {}", warning.code, warning.message);
        }
    }
    let mesh = mesh::load(&path)?;
    let start = Instant::now();
    let normals = mesh::normals::vertex_normals(&mesh.positions, &mesh.triangles);
    println!("{} vertex normals in {:.3} s", normals.len(), start.elapsed().as_secs_f64());
    Ok(())
}

/// About 139 bytes for each vertex and its two triangles.
fn write_sheet(path: &Path, bytes: u64) -> Result<(), Box<dyn Error>> {
    let side = ((bytes / 139) as f64).sqrt() as u32;
    let mut out = BufWriter::new(std::fs::File::create(path)?);
    for y in 0..side {
        for x in 0..side {
            let (u, v) = (f64::from(x) / f64::from(side), f64::from(y) / f64::from(side));
            let height = libm::sin(20.0 * u) * libm::cos(30.0 * v);
            writeln!(
                out,
                "v {:.6} {:.6} {:.6}\nvt {u:.6} {v:.6}\nvn {:.4} {:.4} 0.7071",
                u * 10.0,
                height,
                v * 10.0,
                u,
                v
            )?;
        }
    }
    for y in 1..side {
        for x in 1..side {
            let [a, b, c, d] = [y * side + x, y * side + x + 1, (y - 1) * side + x + 1, (y - 1) * side + x];
            writeln!(out, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\nf {a}/{a}/{a} {c}/{c}/{c} {d}/{d}/{d}")?;
        }
    }
    out.flush()?;
    Ok(())
}
