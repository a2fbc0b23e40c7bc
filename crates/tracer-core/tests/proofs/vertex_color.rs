//! Colours of vertices, point by point: the engine's arithmetic over lanes in f32 against the reference's in f64, and
//! against a closed form; what is told where there are none.

use glam::DVec3;
use scene_format::Syntax;
use std::fs;
use std::path::Path;
use tracer_core::scene::VertexSpace;
use tracer_core::{Kept, Layer, LayerSet, Level, RenderOptions, Scene, Unobserved, compile, compile_keeping, render};
use tracer_reference::first_hits;

/// A folded sheet of 4 x 4 points, with colours of every kind of file; no two neighbours have the same.
struct Sheet {
    points: Vec<[f64; 3]>,
    faces: Vec<[usize; 3]>,
}

impl Sheet {
    fn new() -> Self {
        let points = (0..16).map(|k| {
            let (x, y) = (f64::from(k % 4) / 3.0 - 0.5, f64::from(k / 4) / 3.0 - 0.5);
            [x, y, 0.3 * (x * 7.0 + y * 5.0).sin()]
        });
        let square = |k: usize| {
            let a = k % 3 + 4 * (k / 3);
            [[a, a + 1, a + 5], [a, a + 5, a + 4]]
        };
        Sheet { points: points.collect(), faces: (0..9).flat_map(square).collect() }
    }

    fn byte(k: usize) -> [u8; 3] {
        [(k * 97 % 256) as u8, (k * 53 % 256) as u8, (255 - k * 31 % 256) as u8]
    }

    fn number(k: usize) -> [f64; 3] {
        Sheet::byte(k).map(|byte| (f64::from(byte) + 0.37) / 256.0)
    }

    /// Floats in sRGB.
    fn obj(&self) -> String {
        let vertex = |(k, [x, y, z]): (usize, &[f64; 3])| {
            let [r, g, b] = Sheet::number(k);
            format!("v {x} {y} {z} {r} {g} {b}\n")
        };
        let face = |[a, b, c]: &[usize; 3]| format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        self.points.iter().enumerate().map(vertex).chain(self.faces.iter().map(face)).collect()
    }

    /// Bytes in sRGB.
    fn off(&self) -> String {
        let vertex = |(k, [x, y, z]): (usize, &[f64; 3])| {
            let [r, g, b] = Sheet::byte(k);
            format!("{x} {y} {z} {r} {g} {b} 255\n")
        };
        let head = format!("COFF\n{} {} 0\n", self.points.len(), self.faces.len());
        let face = |[a, b, c]: &[usize; 3]| format!("3 {a} {b} {c}\n");
        std::iter::once(head)
            .chain(self.points.iter().enumerate().map(vertex))
            .chain(self.faces.iter().map(face))
            .collect()
    }

    /// Linear floats.
    fn ply(&self) -> String {
        let names: String =
            ["x", "y", "z", "red", "green", "blue"].iter().map(|name| format!("property float {name}\n")).collect();
        let head = format!(
            "ply\nformat ascii 1.0\nelement vertex {}\n{names}element face {}\nproperty list uchar int \
             vertex_indices\nend_header\n",
            self.points.len(),
            self.faces.len()
        );
        let vertex = |(k, [x, y, z]): (usize, &[f64; 3])| {
            let [r, g, b] = Sheet::number(k);
            format!("{x} {y} {z} {r} {g} {b}\n")
        };
        let face = |[a, b, c]: &[usize; 3]| format!("3 {a} {b} {c}\n");
        std::iter::once(head)
            .chain(self.points.iter().enumerate().map(vertex))
            .chain(self.faces.iter().map(face))
            .collect()
    }

    /// Written in the scene; 255ths, linear.
    fn written(&self) -> String {
        let list = |items: Vec<String>| format!("[{}]", items.join(", "));
        let points = self.points.iter().map(|[x, y, z]| format!("({x}, {y}, {z})")).collect();
        let faces = self.faces.iter().map(|[a, b, c]| format!("[{a}, {b}, {c}]")).collect();
        let colors = (0..self.points.len()).map(|k| {
            let [r, g, b] = Sheet::byte(k).map(|byte| f64::from(byte) / 255.0);
            format!("({r}, {g}, {b})")
        });
        format!("points: {}, faces: {}, colors: {}", list(points), list(faces), list(colors.collect()))
    }
}

fn desc(text: &str, folder: &Path) -> scene_format::SceneDesc {
    let loaded = scene_format::load_str("s.ron", text, Syntax::Ron, folder, &[]);
    loaded.unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

/// Sheets of every kind: moved once, in copies with triangles of their own, mirrored instances of one, smooth and
/// flat, far from the world's origin.
fn scene(albedo: &str, folder: &Path) -> Scene {
    let sheet = Sheet::new();
    fs::write(folder.join("a.obj"), sheet.obj()).expect("a file");
    fs::write(folder.join("a.off"), sheet.off()).expect("a file");
    fs::write(folder.join("a.ply"), sheet.ply()).expect("a file");
    let text = format!(
        r#"Scene(
            camera: Camera(position: (100, 50, 6), look_at: (100, 50, 0), fov: 40),
            image: Image(width: 48, height: 40),
            render: Render(samples: 1, max_bounces: 0),
            effects: Effects(antialiasing: None),
            background: 1,
            materials: {{ "it": Diffuse(albedo: {albedo}) }},
            objects: [
                Mesh(file: "a.obj", material: "it", shading: Smooth,
                    transform: [Rotate(axis: (1, 2, 0), degrees: 20), Scale(1.7), Translate((98.9, 51, 0))]),
                Mesh(file: "a.off", material: "it", placements: [
                    [Scale((-1.6, 1.2, 1)), Rotate(axis: (0, 0, 1), degrees: 35), Translate((101, 51, 0.2))],
                    [Scale(1.1), Rotate(axis: (0, 1, 0), degrees: 200), Translate((100, 50, 1))],
                ]),
                Mesh(file: "a.ply", material: "it", instances: Always, placements: [
                    [Scale((1.4, 1.8, -1)), Rotate(axis: (1, 1, 1), degrees: 25), Translate((98.9, 49, 0))],
                    [Scale((0.7, 0.9, 0.8)), Rotate(axis: (0, 1, 1), degrees: 70), Translate((100, 48.8, 0.6))],
                ]),
                Mesh({}, material: "it", transform: [Scale(1.6), Translate((101, 49.1, 0))]),
                Sphere(center: (100, 51.6, 0), radius: 0.3),
            ],
        )"#,
        sheet.written()
    );
    compile(&desc(&text, folder)).unwrap_or_else(|error| panic!("{error:?}"))
}

/// The colours that are seen through the pixels' centres.
fn seen(scene: &Scene, level: Level) -> Vec<[f32; 3]> {
    let options =
        RenderOptions { threads: 1, level: Some(level), layers: Some(LayerSet::all()), ..RenderOptions::default() };
    let film = render(scene, &options, &Unobserved);
    film.layer(Layer::Albedo).expect("all layers are kept").values.as_chunks::<3>().0.to_vec()
}

/// Points of render space, of size about one, are right to some 1e-6, corners of instances to as much, and triangles
/// have heights of 0.03 of it at least, so that barycentric coordinates are right to some 1e-4; neighbours differ by 1
/// at most, and a ramp has a slope of 3.
#[test]
fn colours_are_those_of_the_reference_at_every_level() {
    let albedos = [
        "VertexColor()",
        "VertexColor(color_space: Srgb)",
        "VertexColor(color_space: Linear)",
        "Multiply(a: VertexColor(), b: Noise(mapping: Object(scale: 2)))",
        "Mix(a: VertexColor(color_space: Srgb), b: VertexColor(color_space: Linear), weight: VertexColor())",
        "ColorRamp(input: VertexColor(), stops: [(at: 0.2, color: 0.1), (at: 0.5, color: (0.9, 0.2, 0.4))])",
        "Checkerboard(a: VertexColor(), b: 0.9, mapping: World(scale: 1.3))",
    ];
    let folder = tempfile::tempdir().expect("a folder");
    for albedo in albedos {
        let scene = scene(albedo, folder.path());
        let expected = first_hits(&scene);
        let ours = seen(&scene, Level::PORTABLE);
        let mut other_side = 0;
        for (k, (got, hit)) in ours.iter().zip(&expected).enumerate() {
            let expected = hit.as_ref().map_or(DVec3::ZERO, |hit| hit.albedo);
            let off = (DVec3::from(got.map(f64::from)) - expected).abs().max_element();
            if albedo.starts_with("Checkerboard") && off > 5e-4 {
                other_side += 1;
                continue;
            }
            assert!(off < 5e-4, "{albedo}: pixel {k} is {got:?}, not {expected:?}");
        }
        assert!(other_side <= 1, "{albedo}: {other_side} points are on the other side of an edge");
        let hit = expected.iter().flatten().count();
        assert!(hit > 500, "{albedo}: {hit} pixels show something");
        for level in Level::available() {
            let bits =
                |colors: &[[f32; 3]]| -> Vec<u32> { colors.as_flattened().iter().map(|x| x.to_bits()).collect() };
            assert_eq!(bits(&seen(&scene, level)), bits(&ours), "{albedo}: {}", level.name());
        }
    }
}

/// A triangle across the view, by hand: through the pixel (x, y) a point is seen whose barycentric coordinates are
/// linear in x and y, and its colour is the sum of the corners' times those, each decoded before.
#[test]
fn a_triangle_is_mixed_by_barycentric_coordinates() {
    let of = |space: &str| {
        let text = format!(
            r#"Scene(
                camera: Camera(position: (0, 0, 5), look_at: (0, 0, 0), projection: Orthographic(height: 2)),
                image: Image(width: 32, height: 32),
                render: Render(samples: 1, max_bounces: 0),
                effects: Effects(antialiasing: None),
                background: 1,
                objects: [Mesh(points: [(-3, -3, 0), (3, -3, 0), (0, 3, 0)], faces: [[0, 1, 2]],
                    colors: [(0.8, 0.1, 0), (0.2, 0.6, 0), (0, 0, 1)],
                    material: Diffuse(albedo: VertexColor(color_space: {space})))],
            )"#
        );
        seen(&compile(&desc(&text, Path::new("."))).expect("right"), Level::PORTABLE)
    };
    let decoded = |code: f64| if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) };
    let corners = [DVec3::new(0.8, 0.1, 0.0), DVec3::new(0.2, 0.6, 0.0), DVec3::new(0.0, 0.0, 1.0)];
    for (space, decode) in [("Auto", false), ("Linear", false), ("Srgb", true)] {
        for (k, got) in of(space).iter().enumerate() {
            let x = ((k % 32) as f64 + 0.5) / 16.0 - 1.0;
            let y = 1.0 - ((k / 32) as f64 + 0.5) / 16.0;
            // The third grows with y from -3 to 3; the others share the rest, their difference is x / 3.
            let third = (y + 3.0) / 6.0;
            let weights = [0.5 * (1.0 - third - x / 3.0), 0.5 * (1.0 - third + x / 3.0), third];
            let light = |c: DVec3| if decode { DVec3::from(c.to_array().map(decoded)) } else { c };
            let expected: DVec3 = (0..3).map(|k| weights[k] * light(corners[k])).sum();
            let off = (DVec3::from(got.map(f64::from)) - expected).abs().max_element();
            assert!(off < 2e-6, "{space}: pixel {k} is {got:?}, not {expected:?}");
        }
    }
}

/// What nothing reads is not there: neither columns nor colours, also of a file that another object reads.
#[test]
fn colours_are_kept_where_they_are_read_and_once() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.off"), Sheet::new().off()).expect("a file");
    let scene = |objects: &str| {
        let text = format!("Scene(background: 1, objects: [{objects}])");
        compile(&desc(&text, folder.path())).expect("right")
    };
    let plain = scene("Mesh(file: \"a.off\")");
    assert!(plain.tables.colors.words.is_empty() && plain.tables.colors.mesh.is_empty());
    assert_eq!(plain.vertex_color(VertexSpace::AsFile, 0, 0), None);
    let told = plain.warnings.iter().find(|warning| warning.message.contains("16 vertex colours (ignored)"));
    assert!(told.is_some_and(|warning| warning.hint.contains("Diffuse(albedo: VertexColor())")), "{told:?}");
    let read = "Mesh(file: \"a.off\", material: Diffuse(albedo: VertexColor())";
    let once = scene(&format!("{read})"));
    assert_eq!(once.tables.colors.words.len(), 16);
    assert!(!once.warnings.iter().any(|warning| warning.message.contains("colour")), "{:?}", once.warnings);
    // Copies with triangles of their own, smooth ones and flat ones have the same colours.
    let copies = "placements: [[], [Translate((2, 0, 0))], [Translate((4, 0, 0))]]";
    let more = scene(&format!("{read}, {copies}), {read}, shading: Smooth, instances: Always, {copies})"));
    assert_eq!((more.meshes.len(), more.tables.colors.words.len()), (4, 16));
    let instances = more.instances.len() as u32;
    for instance in 0..instances {
        let mesh = more.meshes[more.instances[instance as usize].mesh as usize];
        let vertex = more.triangles.vertices[mesh.first_triangle as usize][0];
        let of_first = more.triangles.vertices[0][0];
        let (own, first) = (
            more.vertex_color(VertexSpace::AsFile, instance, vertex),
            more.vertex_color(VertexSpace::AsFile, 0, of_first),
        );
        assert_eq!(own, first, "instance {instance}");
        assert!(own.is_some());
    }
}

/// What is kept while a scene is edited, or from run to run, never shows: with colours and without are two meshes.
#[test]
fn a_kept_mesh_without_colours_is_read_again() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("a.off"), Sheet::new().off()).expect("a file");
    let of = |albedo: &str| {
        let text =
            format!("Scene(background: 1, objects: [Mesh(file: \"a.off\", material: Diffuse(albedo: {albedo}))])");
        desc(&text, folder.path())
    };
    let kept = Kept::default();
    for albedo in ["0.5", "VertexColor()", "0.5", "VertexColor(color_space: Linear)"] {
        let with = compile_keeping(&of(albedo), &kept).expect("right");
        let plain = compile(&of(albedo)).expect("right");
        assert_eq!(with.tables.colors.words, plain.tables.colors.words, "{albedo}");
        let told = |scene: &Scene| scene.warnings.iter().map(|w| w.message.clone()).collect::<Vec<_>>();
        assert_eq!(told(&with), told(&plain), "{albedo}");
    }
}

/// Which object, which file, where, and what to do.
#[test]
fn what_has_no_colours_is_told() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("plain.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("a file");
    let solid = "solid\nfacet\nouter\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
    fs::write(folder.path().join("part.stl"), solid).expect("a file");
    let faults = |objects: &str| {
        let text = format!(
            "Scene(background: 1, materials: {{ \"skin\": Diffuse(albedo: Multiply(a: VertexColor(), b: 0.5)) }}, \
             objects: [{objects}])"
        );
        let error = compile(&desc(&text, folder.path())).err().expect("a fault");
        let told = error.diagnostics.iter().map(|fault| {
            assert_eq!(fault.code.as_str(), "E0515");
            let at = |span: scene_format::diagnostic::Span| text[span.start as usize..span.end as usize].to_owned();
            let labels: Vec<String> = fault.labels.iter().map(|label| at(label.span)).collect();
            (fault.message.clone(), at(fault.span), labels.join(", "))
        });
        told.collect::<Vec<_>>()
    };
    let own = |message: &str, at: &str, label: &str| (message.to_owned(), at.to_owned(), label.to_owned());
    // Of one material on one file, or one kind, the first.
    let found = faults(
        "Mesh(file: \"plain.obj\", material: \"skin\"), Mesh(file: \"plain.obj\", material: \"skin\"), \
         Mesh(file: \"part.stl\", material: Diffuse(albedo: VertexColor()))",
    );
    assert_eq!(
        found,
        [
            own(
                "the mesh plain.obj has no colours of vertices, and its material shows them",
                "\"plain.obj\"",
                "\"skin\""
            ),
            own(
                "the mesh part.stl has no colours of vertices, and its material shows them",
                "\"part.stl\"",
                "Diffuse(albedo: VertexColor())"
            ),
        ]
    );
    let found = faults(
        "Sphere(center: (0, 0, 0), radius: 1, material: \"skin\"), Box(size: 1, material: \"skin\"), \
         Union(objects: [Sphere(center: (9, 0, 0), radius: 1), Sphere(center: (9, 1, 0), radius: 1, material: \
         \"skin\")])",
    );
    let messages: Vec<&str> = found.iter().map(|(message, ..)| message.as_str()).collect();
    assert!(messages.contains(&"a `Box` has no vertices with colours, and its material shows them"), "{messages:?}");
    assert_eq!(messages.iter().filter(|message| message.starts_with("a `Sphere` has no vertices")).count(), 1);
    let found = faults("Mesh(points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]], material: \"skin\")");
    assert_eq!(found[0].0, "the mesh has no `colors`, and its material shows them");
}
