//! Textures that are reckoned, point by point: the engine's arithmetic over lanes in f32 against the reference's in f64.

use crate::support::compiled;
use std::path::Path;
use tracer_core::{Film, Level, RenderOptions, Scene, Unobserved};
use tracer_reference::{Smoothing, render};

/// Every pattern, by texture coordinates and in space where it may be.
const PATTERNS: [&str; 18] = [
    "Checkerboard(a: 0.1, b: (0.9, 0.7, 0.5), mapping: Object(scale: (3, 2, 4), offset: (0.13, 0.27, 0.41)))",
    "Checkerboard(a: 0.1, b: 0.9, mapping: World(scale: 2.3, offset: (0.1, 0.2, 0.3)))",
    "Lines(a: 0.2, b: (0.9, 0.8, 0.3), width: 0.3, mapping: Uv(scale: (7, 5), rotation: 20, offset: (0.1, 0.3)))",
    "Lines(a: 0.2, b: 0.9, width: 0.4, along: U, mapping: Uv(scale: (7, 5), rotation: 20))",
    "Lines(a: 0.2, b: 0.9, width: 0.4, along: V, mapping: Uv(scale: (7, 5), rotation: 20))",
    "Dots(a: (0.1, 0.2, 0.3), b: 0.9, radius: 0.37, mapping: Uv(scale: (7, 5), rotation: -20))",
    "Gradient(a: 0.1, b: 0.9)",
    "Gradient(a: 0.1, b: 0.9, axis: X, mapping: Object(scale: 0.5, offset: (0.5, 0, 0)))",
    "Gradient(a: 0.1, b: 0.9, axis: Z, mapping: World(scale: 0.5, offset: (0, 0, 0.5)))",
    "Gradient(a: 0.1, b: 0.9, axis: Radial, mapping: Object(offset: (0.4, 0.3, 0)))",
    "Noise(a: 0.1, b: (0.9, 0.5, 0.2), mapping: Object(scale: 3))",
    "Noise(kind: Perlin, mapping: World(scale: (3, 4, 5), offset: (-7, 0, 3)))",
    "Noise(kind: Turbulence, octaves: 3, lacunarity: 2.7, gain: 0.7, mapping: Object(scale: 2))",
    "Noise(mapping: Uv(scale: (9, 4), rotation: 30))",
    "Wood(a: 0.7, b: 0.1, mapping: Object(scale: 4))",
    "Wood(a: 0.7, b: 0.1, distortion: 1.5, mapping: World(scale: 2))",
    "Marble(mapping: Object(scale: 2))",
    "Marble(a: 0.9, b: 0.2, distortion: -0.7, mapping: Uv(scale: (5, 3)))",
];

/// A ball, a turned and stretched box, and two copies of a box that differ, kept apart or as instances, far from the world's origin; the light is
/// one from everywhere and nothing is scattered twice, so that each pixel is the albedo at the point behind its middle, without noise.
fn scene(pattern: &str) -> Scene {
    let text = format!(
        r#"Scene(
            camera: Camera(position: (100.3, 51.1, 6), look_at: (100, 50, 0), fov: 40),
            image: Image(width: 48, height: 40),
            render: Render(samples: 1, max_bounces: 0),
            effects: Effects(antialiasing: None),
            background: 1,
            materials: {{ "it": Diffuse(albedo: {pattern}) }},
            objects: [
                Sphere(center: (98.9, 50.7, 0), radius: 0.9, material: "it"),
                Box(
                    center: (0.2, 0.1, -0.1),
                    size: (1.4, 1.1, 0.9),
                    material: "it",
                    transform: [
                        Rotate(axis: (1, 2, 3), degrees: 33),
                        Scale((1, 1.3, 0.8), about: (0, 0, 0)),
                        Translate((101, 50.8, 0)),
                    ],
                ),
                Box(
                    size: 1,
                    material: "it",
                    placements: [
                        [Rotate(axis: (1, 1, 0), degrees: 41), Translate((99, 49, 0.3))],
                        [Scale((-0.8, 1.1, 1)), Rotate(axis: (0, 1, 0), degrees: 27), Translate((101, 49, 0.1))],
                    ],
                ),
                Mesh(
                    file: "assets/cube.off",
                    instances: Always,
                    material: "it",
                    placements: [
                        [Scale(0.5), Rotate(axis: (1, 1, 1), degrees: 50), Translate((100.1, 50.1, 1))],
                        [Scale((0.3, 0.2, 0.3)), Rotate(axis: (0, 1, 1), degrees: 70), Translate((100, 51.6, 0.4))],
                    ],
                ),
            ],
        )"#
    );
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden");
    let loaded = scene_format::load_str("s.ron", &text, scene_format::Syntax::Ron, &golden, &[]);
    compiled(&loaded.unwrap_or_else(|error| panic!("{pattern}: {error}")).scene)
}

fn film(scene: &Scene, level: Level) -> Film {
    let options = RenderOptions { threads: 1, level: Some(level), ..RenderOptions::default() };
    tracer_core::render(scene, &options, &Unobserved)
}

/// Points of render space, of size about one, are right to some 1e-6, the far world's coordinates to 2^-18 (half an ulp of 100, thrice): with up to
/// 5 cells a unit and a slope of noise of at most 2 an octave and cell, which six octaves and gain 1/2 keep at 6, of waves pi, some
/// 5 * 4e-6 * 6 * pi at the very most, 4e-4. Where t jumps a point may fall on the other side: its pixel must then have the other colour, and
/// such points are as rare as the width of the rounding, 2e-5 of a cell, is small.
#[test]
fn every_pattern_is_that_of_the_reference_at_every_level() {
    for pattern in PATTERNS {
        let scene = scene(pattern);
        let theirs = render(&scene, 1, 1, Smoothing::Hanika);
        let [width, height] = scene.size;
        let jumps = ["Checkerboard", "Lines", "Dots"].iter().any(|name| pattern.starts_with(name));
        let ours = film(&scene, Level::PORTABLE);
        let mut other_side = 0;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let (got, expected) = (ours.radiance(x, y), theirs.mean[(y * width + x) as usize].to_array());
            let off = (0..3).map(|c| (got[c] - expected[c]).abs()).fold(0.0, f64::max);
            if jumps && off > 4e-4 {
                other_side += 1;
                continue;
            }
            assert!(off < 4e-4, "{pattern}: pixel ({x}, {y}) {got:?} not {expected:?}");
        }
        assert!(other_side <= 1, "{pattern}: {other_side} points are on the other side of an edge");
        for level in Level::available() {
            let again = film(&scene, level);
            let same = (0..height)
                .flat_map(|y| (0..width).map(move |x| (x, y)))
                .all(|(x, y)| again.radiance(x, y).map(f64::to_bits) == ours.radiance(x, y).map(f64::to_bits));
            assert!(same, "{pattern}: {}", level.name());
        }
    }
}
