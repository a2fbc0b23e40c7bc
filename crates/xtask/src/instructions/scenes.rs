//! Scenes to measure, made by the program: sizes are its arguments, and nothing is read from elsewhere. `bench/`
//! measures curves over them.

use scene_format::{Syntax, load_str};
use std::fmt::Write as _;
use std::path::Path;
use tracer_core::{Film, RenderOptions, Scene, Unobserved, compile, render};

/// The room of the report's figures, with what else is in it.
fn in_the_room(size: u32, samples: u32, lights: &str, objects: &str, base: &Path) -> Scene {
    let wall = |center: &str, albedo: &str| {
        format!("Sphere(center: {center}, radius: 10000, material: Diffuse(albedo: {albedo})),\n")
    };
    let walls: String = [
        wall("(0, -10020, 0)", "(1, 1, 1)"),
        wall("(0, 10050, 0)", "(1, 0.01, 0.01)"),
        wall("(0, 0, -10050)", "(0.01, 1, 1)"),
        wall("(0, 0, 10100)", "(1, 0.01, 1)"),
        wall("(-10050, 0, 0)", "(0.01, 1, 0.01)"),
        wall("(10050, 0, 0)", "(0.01, 0.01, 1)"),
    ]
    .concat();
    let text = format!(
        "Scene(version: 1,
            camera: Camera(position: (0, 0, 55), look_at: (0, 0, 0), fov: 60),
            image: Image(width: {size}, height: {size}),
            render: Render(samples: {samples}, max_bounces: 5),
            lights: [{lights}],
            objects: [{walls}{objects}],
        )"
    );
    let loaded = load_str("bench.ron", &text, Syntax::Ron, base, &[]).expect("a scene that is right");
    compile(&loaded.scene).expect("a scene that compiles")
}

const LAMP: &str = "SphereLight(center: (-10, 20, 40), radius: 5, intensity: 3974)";

/// The report's figure 4: nine balls of mirror, Blinn-Phong and glass.
pub fn balls(size: u32, samples: u32) -> Scene {
    let materials = [
        "Mirror(reflectance: 1)",
        "Mirror(reflectance: 0.5)",
        "Mirror(reflectance: 0.1)",
        "BlinnPhong(albedo: (0.1, 0.1, 1), exponent: 1000, specular: 0.01)",
        "BlinnPhong(albedo: (0.1, 1, 0.1), exponent: 1000, specular: 0.05)",
        "BlinnPhong(albedo: (1, 0.1, 0.1), exponent: 1000, specular: 0.1)",
        "Transparent(ior: 1.33)",
        "Transparent(ior: 1.52)",
        "Transparent(ior: 2.42)",
    ];
    let mut objects = String::new();
    for (k, material) in materials.iter().enumerate() {
        let (x, y) = (20 * (k as i32 % 3 - 1), 20 * (k as i32 / 3) - 10);
        let _ = write!(objects, "Sphere(center: ({x}, {y}, -20), radius: 10, material: {material}),");
    }
    in_the_room(size, samples, LAMP, &objects, Path::new("."))
}

/// A hilly, smooth ground of about `triangles` triangles in the room.
pub fn hills(triangles: usize, size: u32, samples: u32) -> Scene {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let side = ((triangles as f64 / 2.0).sqrt().ceil() as usize).max(1);
    let mut off = format!("OFF\n{} {} 0\n", (side + 1) * (side + 1), 2 * side * side);
    for j in 0..=side {
        for i in 0..=side {
            let (x, z) = (i as f64 / side as f64, j as f64 / side as f64);
            let y = 0.08 * (9.0 * x).sin() * (7.0 * z).cos() + 0.004 * (170.0 * x).sin() * (190.0 * z).sin();
            let _ = writeln!(off, "{:.6} {:.6} {:.6}", x - 0.5, y, z - 0.5);
        }
    }
    for j in 0..side {
        for i in 0..side {
            let a = j * (side + 1) + i;
            let (b, c, d) = (a + 1, a + side + 1, a + side + 2);
            let _ = writeln!(off, "3 {a} {c} {b}\n3 {b} {c} {d}");
        }
    }
    std::fs::write(folder.path().join("hills.off"), off).expect("a scratch file");
    let mesh = "Mesh(file: \"hills.off\", material: Diffuse(albedo: 0.7), shading: Smooth,
        transform: [Scale(factor: 90, about: (0, 0, 0)), Translate((0, -12, 0))])";
    in_the_room(size, samples, LAMP, mesh, folder.path())
}

/// `count` copies of a ball of 960 triangles, in a cube that they fill alike.
pub fn copies(count: usize, size: u32, samples: u32) -> Scene {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (rows, columns) = (16, 32);
    let mut off = format!("OFF\n{} {} 0\n", (rows + 1) * columns, 2 * (rows - 1) * columns);
    for j in 0..=rows {
        for i in 0..columns {
            let (polar, around) =
                (std::f64::consts::PI * j as f64 / rows as f64, std::f64::consts::TAU * i as f64 / columns as f64);
            let (s, c) = polar.sin_cos();
            let _ = writeln!(off, "{:.6} {:.6} {:.6}", s * around.cos(), c, s * around.sin());
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            let (a, b) = (j * columns + i, j * columns + (i + 1) % columns);
            let (c, d) = (a + columns, b + columns);
            if j > 0 {
                let _ = writeln!(off, "3 {a} {b} {c}");
            }
            if j + 1 < rows {
                let _ = writeln!(off, "3 {b} {d} {c}");
            }
        }
    }
    std::fs::write(folder.path().join("ball.off"), off).expect("a scratch file");
    let radius = 20.0 / (count as f64).cbrt();
    let mut placements = String::new();
    for k in 0..count {
        let [x, y, z] = spread(k).map(|u| 60.0 * u - 30.0);
        let _ = writeln!(placements, "{x:.4} {y:.4} {z:.4} {radius:.5}");
    }
    std::fs::write(folder.path().join("placements.txt"), placements).expect("a scratch file");
    let mesh = "Mesh(file: \"ball.off\", material: Diffuse(albedo: 0.7), placements: \"placements.txt\")";
    in_the_room(size, samples, LAMP, mesh, folder.path())
}

/// `count` small lamps under the ceiling, over a few balls.
pub fn lamps(count: usize, size: u32, samples: u32) -> Scene {
    let mut lights = String::new();
    for k in 0..count {
        let [x, y, z] = spread(k);
        let _ = write!(
            lights,
            "SphereLight(center: ({:.3}, {:.3}, {:.3}), radius: 0.3, power: {:.4}),",
            80.0 * x - 40.0,
            30.0 + 15.0 * y,
            90.0 * z - 40.0,
            120_000.0 / count as f64
        );
    }
    let balls: String = (0..5).map(|k| format!("Sphere(center: ({}, -10, 0), radius: 8),", 18 * k - 36)).collect();
    in_the_room(size, samples, &lights, &balls, Path::new("."))
}

/// The scene with every pixel for itself.
pub fn alone(mut scene: Scene) -> Scene {
    scene.reuse = tracer_core::scene::Sharing::Never;
    scene.caustics = false;
    scene
}

/// A scene file with so many spheres.
pub fn many_spheres(count: usize) -> String {
    let mut objects = String::new();
    for k in 0..count {
        let [x, y, z] = spread(k);
        let _ = writeln!(
            objects,
            "        Sphere(center: ({x:.3}, {y:.3}, {z:.3}), radius: 0.01, material: Diffuse(albedo: 0.5)),"
        );
    }
    format!("Scene(\n    version: 1,\n    objects: [\n{objects}    ],\n)\n")
}

/// The k-th point of a sequence that fills the unit cube evenly (Roberts' R3).
fn spread(k: usize) -> [f64; 3] {
    [0.819_172_513_396, 0.671_043_606_704, 0.549_700_477_902].map(|a: f64| (0.5 + a * (k as f64 + 1.0)).fract())
}

/// Renders it on so many threads.
pub fn rendered(scene: &Scene, threads: usize) -> Film {
    render(scene, &RenderOptions { threads, ..RenderOptions::default() }, &Unobserved)
}
