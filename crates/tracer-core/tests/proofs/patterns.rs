//! Textures that are reckoned, point by point: the engine's arithmetic over lanes in f32 against the reference's in
//! f64.

use crate::support::compiled;
use glam::DVec3;
use std::path::Path;
use tracer_core::scene::PatternKind;
use tracer_core::{Layer, LayerSet, Level, RenderOptions, Scene, Unobserved, render};
use tracer_reference::first_hits;

/// Every pattern, by texture coordinates and in space where it may be.
const PATTERNS: [&str; 25] = [
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
    "Wood(a: 0.7, b: 0.1, axis: (-3, 1, 2), mapping: Object(scale: (4, 2, 3)))",
    "Wood(a: 0.7, b: 0.1, axis: (0, 0, 2), mapping: Uv(scale: (5, 3), offset: (-2.5, -1.5)))",
    "Marble(mapping: Object(scale: 2))",
    "Marble(axis: (1, -2, 0.5), mapping: World(scale: 2))",
    "Marble(a: 0.9, b: 0.2, distortion: -0.7, mapping: Uv(scale: (5, 3)))",
    "Voronoi(a: 0.1, b: (0.9, 0.5, 0.2), mapping: Object(scale: 3))",
    "Voronoi(feature: F2MinusF1, mapping: World(scale: (3, 4, 5), offset: (-7, 0, 3)))",
    "Voronoi(feature: Cell, a: 0.1, b: 0.9, mapping: Object(scale: 3))",
    "Voronoi(feature: F2MinusF1, jitter: 0.3, mapping: Uv(scale: (8, 4), rotation: 10))",
];

/// By points, and made of others.
const MADE: [&str; 26] = [
    "ColorRamp(input: Gradient(), interpolation: Constant, stops: [(at: 0.3, color: 0.1), (at: 0.3, color: 0.9), \
     (at: 0.6, color: 0.4)])",
    "Checkerboard(a: 0.1, b: 0.9, mapping: Planar(origin: (0.3, 0.1, 0.2), normal: (1, 2, 3), size: (0.3, 0.2)))",
    "Lines(a: 0.2, b: 0.9, width: 0.4, mapping: Planar(size: 0.25))",
    "Gradient(a: 0.1, b: 0.9, axis: X, mapping: Planar(origin: (-0.5, 0, 0), normal: (0, 0, 1), size: 1.2))",
    "Dots(a: 0.1, b: 0.9, mapping: Spherical(center: (0.1, 0.2, 0.05), axis: (1, 2, 0.5), scale: (12, 6)))",
    "Gradient(a: 0.1, b: 0.9, mapping: Spherical(axis: (0, 0, 1)))",
    "Noise(mapping: Spherical(scale: (9, 4)))",
    "Gradient(a: (0.1, 0.2, 0.9), b: 0.9, axis: X, mapping: Triplanar(scale: 1.7, blend: 0.5))",
    "Noise(b: (0.9, 0.5, 0.2), mapping: Triplanar(scale: 3))",
    "Marble(mapping: Triplanar(scale: -2, blend: 0.05))",
    r#"Texture(file: "assets/tile.png", mapping: Planar(origin: (0.1, 0, 0), normal: (0, 1, 2), size: (3, 2)))"#,
    r#"Texture(file: "assets/tile.png", channel: Green, mapping: Spherical(axis: (1, 1, 0), scale: (1, 0.5)))"#,
    "Texture(file: \"assets/tile.png\", color_space: Linear, wrap: Mirror, mapping: Triplanar(scale: 0.6, blend: \
     0.3))",
    "Multiply(a: Noise(mapping: Object(scale: 3)), b: Marble(mapping: World(scale: 1.5)))",
    "Multiply(a: (0.9, 0.5, 0.2), b: Texture(file: \"assets/tile.png\", channel: Luminance, mapping: Uv(scale: (2, \
     1))))",
    "Mix(a: (0.1, 0.2, 0.3), b: Wood(mapping: Object(scale: 2)), weight: Noise(mapping: Object(scale: 3)))",
    "Mix(a: 0.1, b: (0.9, 0.3, 0.2))",
    r#"Mix(a: Marble(), b: Gradient(), weight: Texture(file: "assets/tile.png", mapping: Planar(size: 3)))"#,
    "Wood(a: Noise(mapping: Object(scale: 3)), b: (0.9, 0.6, 0.3), mapping: Object(scale: 2))",
    "Gradient(a: Texture(file: \"assets/tile.png\"), b: Texture(file: \"assets/tile.png\", color_space: Linear), \
     axis: X)",
    "Checkerboard(a: Noise(mapping: Object(scale: 3)), b: 0.9, mapping: Uv(scale: 5))",
    "Noise(a: Marble(), b: Noise(mapping: World(scale: 2)), mapping: Triplanar(scale: 2, blend: 0.4))",
    "ColorRamp(input: Noise(mapping: Object(scale: 2)), stops: [(at: 0.3, color: 0.1), (at: 0.45, color: (0.9, 0.5, \
     0.2)), (at: 0.7, color: (0.1, 0.3, 0.9))])",
    "ColorRamp(input: Gradient(a: (0.9, 0.1, 0.3), b: (0.1, 0.9, 0.2)), interpolation: Smooth, stops: [(at: 0.2, \
     color: 0.1), (at: 0.8, color: 0.9)])",
    "ColorRamp(input: Marble(mapping: Object(scale: 2)), stops: [(at: 0, color: 0.1), (at: 1, color: (0.2, 0.5, \
     0.9))], interpolation: Linear)",
    "Multiply(a: ColorRamp(input: Mix(a: Noise(), b: Marble(), weight: Gradient()), stops: [(at: 0.2, color: 0.3), \
     (at: 0.9, color: 0.9)]), b: Mix(a: Wood(), b: Multiply(a: Noise(), b: 0.8), weight: Marble()))",
];

fn loaded(text: &str) -> Scene {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden");
    let loaded = scene_format::load_str("s.ron", text, scene_format::Syntax::Ron, &golden, &[]);
    compiled(&loaded.unwrap_or_else(|error| panic!("{error}\n{text}")).scene)
}

/// A ball, an ellipsoid, a leaning cylinder, a turned and stretched box, and two copies of a box that differ, kept
/// apart or as instances, far from the world's origin.
fn scene(pattern: &str) -> Scene {
    with_names("", pattern)
}

/// The same with textures by name.
fn with_names(textures: &str, albedo: &str) -> Scene {
    loaded(&format!(
        r#"Scene(
            camera: Camera(position: (100.3, 51.1, 6), look_at: (100, 50, 0), fov: 40),
            image: Image(width: 48, height: 40),
            render: Render(samples: 1, max_bounces: 0),
            effects: Effects(antialiasing: None),
            background: 1,
            textures: {{ {textures} }},
            materials: {{ "it": Diffuse(albedo: {albedo}) }},
            objects: [
                Sphere(center: (98.9, 50.7, 0), radius: 0.9, material: "it"),
                Sphere(
                    center: (0.1, 0, 0),
                    radius: 0.4,
                    material: "it",
                    transform: [Scale((1, 0.6, 1)), Rotate(axis: (0, 0, 1), degrees: 25), Translate((101.8, 49.9, 0))],
                ),
                Cylinder(
                    from: (0, -0.4, 0),
                    to: (0.2, 0.5, 0),
                    radius: 0.25,
                    material: "it",
                    transform: [Rotate(axis: (1, 0, 1), degrees: 35), Translate((99.9, 48.6, 0.8))],
                ),
                Box(
                    center: (0.2, 0.1, -0.1),
                    size: (1.4, 1.1, 0.9),
                    material: "it",
                    transform: [
                        Rotate(axis: (1, 2, 3), degrees: 33),
                        Scale(factor: (1, 1.3, 0.8), about: (0, 0, 0)),
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
    ))
}

/// The colours that are seen through the pixels' centres.
fn seen(scene: &Scene, level: Level) -> Vec<[f32; 3]> {
    let options =
        RenderOptions { threads: 1, level: Some(level), layers: Some(LayerSet::all()), ..RenderOptions::default() };
    let film = render(scene, &options, &Unobserved);
    film.layer(Layer::Albedo).expect("all layers are kept").values.as_chunks::<3>().0.to_vec()
}

/// Points of render space, of size about one, are right to some 1e-6, the far world's coordinates to 2^-18 (half an ulp
/// of 100, thrice): with up to 5 cells a unit and a slope of noise of at most 2 an octave and cell, which six octaves
/// and gain 1/2 keep at 6, of waves pi, some 5 * 4e-6 * 6 * pi at the very most, 4e-4. Where t jumps a point may fall
/// on the other side: such points are as rare as the width of the rounding, 2e-5 of a cell, is small.
#[test]
fn every_pattern_is_that_of_the_reference_at_every_level() {
    for pattern in PATTERNS.into_iter().chain(MADE) {
        let scene = scene(pattern);
        let expected = first_hits(&scene);
        let jumps =
            ["Checkerboard", "Lines", "Dots", "Voronoi(feature: Cell"].iter().any(|name| pattern.starts_with(name))
                || pattern.contains("Constant");
        let ours = seen(&scene, Level::PORTABLE);
        let mut other_side = 0;
        for (k, (got, hit)) in ours.iter().zip(&expected).enumerate() {
            let expected = hit.as_ref().map_or(DVec3::ZERO, |hit| hit.albedo);
            let off = (DVec3::from(got.map(f64::from)) - expected).abs().max_element();
            if jumps && off > 4e-4 {
                other_side += 1;
                continue;
            }
            assert!(off < 4e-4, "{pattern}: pixel {k} is {got:?}, not {expected:?}");
        }
        assert!(other_side <= 1, "{pattern}: {other_side} points are on the other side of an edge");
        let hit = expected.iter().flatten().count();
        assert!(hit > 500, "{pattern}: {hit} pixels show something");
        for level in Level::available() {
            let bits =
                |colors: &[[f32; 3]]| -> Vec<u32> { colors.as_flattened().iter().map(|x| x.to_bits()).collect() };
            assert_eq!(bits(&seen(&scene, level)), bits(&ours), "{pattern}: {}", level.name());
        }
    }
}

/// The direction of a grain is that of its words, at length one, whatever theirs is.
#[test]
fn grain_runs_along_its_axis() {
    let axis = |words: &str| match scene(words).pattern(0).map(|pattern| pattern.kind) {
        Some(PatternKind::Wood { axis, .. } | PatternKind::Marble { axis, .. }) => axis,
        other => panic!("{words}: {other:?}"),
    };
    assert_eq!(axis("Wood()"), [0.0, 1.0, 0.0]);
    assert_eq!(axis("Marble()"), [1.0, 0.0, 0.0]);
    for size in ["", "e9", "e-9"] {
        let along = DVec3::from(axis(&format!("Wood(axis: (3{size}, 0, -4{size}))")));
        assert!(along.distance(DVec3::new(0.6, 0.0, -0.8)) < 1e-15, "{along}");
    }
}

/// A name is what stands at it: the same bytes, and what many name is in memory once.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn names_of_textures_change_nothing() {
    let bits = |scene: &Scene| -> Vec<u32> {
        seen(scene, Level::PORTABLE).as_flattened().iter().map(|x| x.to_bits()).collect()
    };
    for pattern in PATTERNS.into_iter().chain(MADE) {
        let inline = scene(pattern);
        let named = with_names(&format!("\"it\": \"that\", \"that\": {pattern}"), "\"it\"");
        assert_eq!(bits(&named), bits(&inline), "{pattern}");
        // Twice the same, as a part of another one: by name, and written twice.
        let [by_name, written] = [
            with_names(&format!("\"it\": {pattern}"), "Mix(a: \"it\", b: \"it\", weight: \"it\")"),
            scene(&format!("Mix(a: {pattern}, b: {pattern}, weight: {pattern})")),
        ];
        assert_eq!(bits(&by_name), bits(&written), "{pattern}");
        let (one, other) = (by_name.statistics(), written.statistics());
        assert_eq!((one.textures, one.texture_bytes), (other.textures, other.texture_bytes), "{pattern}");
    }
}

/// From render space back to the coordinates that things are written in, by transforms whose matrices are known: half
/// turns, factors and steps.
#[test]
fn objects_know_the_coordinates_that_they_are_written_in() {
    let scene = loaded(
        r#"Scene(
            background: 1,
            materials: { "it": Diffuse(albedo: Noise()) },
            objects: [
                Sphere(center: (1, 2, 3), radius: 0.5, material: "it"),
                Sphere(center: (0, 0, 0), radius: 1, material: "it",
                    transform: [Scale(factor: 2, about: (1, 0, 0)), Translate((5, 0, 0))]),
                Sphere(center: (0, 0, 0), radius: 1, material: "it",
                    transform: [Scale(factor: (2, 1, -3), about: (0, 0, 0))]),
                Cylinder(
                    from: (1, 0, 0),
                    to: (1, 1, 2),
                    radius: 0.2,
                    material: "it",
                    transform: [Rotate(axis: (0, 1, 0), degrees: 180, about: (0, 0, 0)), Translate((0, 1, 0))],
                ),
                Box(
                    center: (4, 0, 0),
                    size: (1, 2, 3),
                    material: "it",
                    placements: [[Translate((1, 0, 0))], [Scale((2, 3, 4)), Translate((0, 3, 0))]],
                ),
                Rectangle(center: (0, -2, 0), size: (3, 4), material: "it"),
                Mesh(
                    file: "assets/cube.off",
                    instances: Always,
                    material: "it",
                    placements: [[Rotate(axis: (1, 0, 0), degrees: 180)], [Scale(0.5), Translate((0, 0, 7))]],
                ),
            ],
        )"#,
    );
    // Spheres, shapes, instances: what takes a point of an object's coordinates to the world.
    let to_world: [fn(DVec3) -> DVec3; 9] = [
        |p| p,
        |p| DVec3::new(2.0 * p.x + 4.0, 2.0 * p.y, 2.0 * p.z),
        |p| DVec3::new(2.0 * p.x, p.y, -3.0 * p.z),
        |p| DVec3::new(-p.x, p.y + 1.0, -p.z),
        |p| p + DVec3::X,
        |p| DVec3::new(2.0 * p.x, 3.0 * p.y + 3.0, 4.0 * p.z),
        |p| p,
        |p| DVec3::new(p.x, -p.y, -p.z),
        |p| 0.5 * p + DVec3::new(0.0, 0.0, 7.0),
    ];
    let [spheres, shapes, copies] = [scene.spheres.len(), scene.shapes.len(), scene.instances.len()];
    assert_eq!([spheres, shapes, copies], [2, 2, 5]);
    let back = |rows: [[f64; 4]; 3], world: DVec3| {
        let q = scene.frame.point(world);
        DVec3::from(rows.map(|row| DVec3::new(row[0], row[1], row[2]).dot(q) + row[3]))
    };
    for (body, to_world) in (0..).zip(to_world) {
        let rows = scene.to_object(Some(body)).expect("a pattern asks for it");
        for p in [DVec3::ZERO, DVec3::new(0.3, -0.7, 1.9), DVec3::new(-2.0, 5.0, 0.4)] {
            let found = back(rows, to_world(p));
            // Some hundred roundings of numbers below ten.
            assert!((found - p).length() < 1e-12, "body {body}: {found} is not {p}");
        }
    }
    let rows = scene.to_object(None).expect("a pattern asks for it");
    assert!((back(rows, DVec3::new(1.0, 2.0, 3.0)) - DVec3::new(1.0, 2.0, 3.0)).length() < 1e-12);
}
