//! How fast scenes are read and checked: `cargo run --release -p scene-format --example reading_speed`.
//!
//! Writes a scene of 100,000 spheres in each syntax into memory and reads it several times.

use scene_format::{Syntax, load_bytes};
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

const SPHERES: usize = 100_000;
const RUNS: usize = 7;

fn main() {
    for syntax in Syntax::ALL {
        let text = scene(syntax);
        let mut best = f64::INFINITY;
        for _ in 0..RUNS {
            let bytes = text.clone().into_bytes();
            let start = Instant::now();
            let loaded = load_bytes("speed", bytes, Some(syntax), Path::new(""), &[]);
            let seconds = start.elapsed().as_secs_f64();
            match loaded {
                Ok(loaded) => assert_eq!(loaded.scene.objects.len(), SPHERES),
                Err(error) => panic!("the scene is right: {error}"),
            }
            best = best.min(seconds);
        }
        let megabytes = text.len() as f64 / 1e6;
        println!("{}: {megabytes:.1} MB in {:.0} ms, {:.0} MB/s", syntax.name(), best * 1e3, megabytes / best);
    }
}

fn scene(syntax: Syntax) -> String {
    let mut out = String::new();
    let materials = ["red", "glass", "chrome"];
    let _ = match syntax {
        Syntax::Ron => write!(
            out,
            "Scene(\n    background: 1,\n    materials: {{ \"red\": Diffuse(albedo: (0.8, 0.1, 0.1)), \"glass\": \
             Transparent(ior: 1.5), \"chrome\": Mirror() }},\n    objects: [\n"
        ),
        Syntax::Toml => writeln!(
            out,
            "background = 1\n[materials]\nred = {{ Diffuse = {{ albedo = [0.8, 0.1, 0.1] }} }}\nglass = {{ Transparent \
             = \
             {{ ior = 1.5 }} }}\nchrome = {{ Mirror = {{}} }}"
        ),
        Syntax::Json => writeln!(
            out,
            "{{\n    \"background\": 1,\n    \"materials\": {{ \"red\": {{ \"Diffuse\": {{ \"albedo\": [0.8, 0.1, 0.1] \
             }} }}, \
             \"glass\": {{ \"Transparent\": {{ \"ior\": 1.5 }} }}, \"chrome\": {{ \"Mirror\": {{}} }} }},\n    \
             \"objects\": ["
        ),
    };
    for index in 0..SPHERES {
        let (x, y, z) = (index as f64 * 0.37 % 91.0 - 45.0, index as f64 * 0.73 % 83.0, index as f64 * 1.13 % 77.0);
        let (radius, material) = (0.1 + (index % 17) as f64 * 0.05, materials[index % 3]);
        let _ = match syntax {
            Syntax::Ron => writeln!(
                out,
                "        Sphere(center: ({x:.3}, {y:.3}, {z:.3}), radius: {radius:.2}, material: \"{material}\"),"
            ),
            Syntax::Toml => writeln!(
                out,
                "[[objects]]\nSphere = {{ center = [{x:.3}, {y:.3}, {z:.3}], radius = {radius:.2}, material = \
                 \"{material}\" }}"
            ),
            Syntax::Json => writeln!(
                out,
                "        {{ \"Sphere\": {{ \"center\": [{x:.3}, {y:.3}, {z:.3}], \"radius\": {radius:.2}, \
                 \"material\": \"{material}\" }} }}{}",
                if index + 1 < SPHERES { "," } else { "" }
            ),
        };
    }
    out.push_str(match syntax {
        Syntax::Ron => "    ],\n)\n",
        Syntax::Toml => "",
        Syntax::Json => "    ]\n}\n",
    });
    out
}
