//! Solids made of closed shapes: engine and reference make the same picture; what must look the same does; glass in a
//! white furnace cannot be seen.

use crate::support::compare::{Samples, assert_same_picture};
use crate::support::{compiled, film};
use glam::DVec3;
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;
use tracer_core::{Layer, LayerSet, RenderOptions, Unobserved, compile, render};
use tracer_reference::first_hits;

fn described(text: &str) -> SceneDesc {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden");
    load_str("s.ron", text, Syntax::Ron, &golden, &[]).unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

/// A bowl, a joint of three shapes and a part that they have in common, stretched, turned, mirrored and nested.
const BODIES: &str = r#"
    Difference(material: "it", transform: [Translate((-1.3, 0.8, 0))], objects: [
        Sphere(center: (0, 0, 0), radius: 0.8),
        Sphere(center: (0, 0, 0), radius: 0.65),
        Box(center: (0, 1, 0), size: (2, 1.2, 2), transform: [Rotate(axis: (0, 0, 1), degrees: 20)]),
    ]),
    Union(material: "it", transform: [
        Scale((1, 1.2, -1)), Rotate(axis: (1, 2, 0), degrees: 30), Translate((0.5, 0.9, -0.4)),
    ], objects: [
        Cylinder(from: (0, -0.5, 0), to: (0, 0.2, 0), radius: 0.3),
        Cone(from: (0, 0.2, 0), to: (0, 0.7, 0), radius: 0.3, tip_radius: 0.1),
        Difference(objects: [
            Box(size: (1.2, 0.4, 0.4), transform: [Translate((0.3, 0, 0))]),
            Capsule(from: (0.6, -1, 0), to: (0.6, 1, 0), radius: 0.12),
            Torus(center: (0.3, 0.2, 0), radius: 0.15, tube_radius: 0.05),
        ]),
        Torus(center: (0, -0.3, 0), axis: (0.3, 1, 0), radius: 0.4, tube_radius: 0.12),
    ]),
    Intersection(material: "it", objects: [
        Box(center: (1.8, 0.6, 0.6), size: 1, transform: [Rotate(axis: (0, 1, 0), degrees: 25)]),
        Sphere(center: (1.8, 0.6, 0.6), radius: 0.65, transform: [Scale((1, 0.9, 1))]),
    ]),
    Difference(material: "it", objects: [
        Intersection(objects: [
            Sphere(center: (0.4, 0.4, 1.6), radius: 0.5), Plane(point: (0, 0.5, 0)),
            Plane(point: (0.5, 0, 1.5), normal: (1, 0.3, 0.2)),
        ]),
        Plane(point: (0, 0.2, 1.4), normal: (-0.3, -0.2, -1), transform: [Scale((1, 2, 1))]),
    ]),
"#;

fn view(material: &str, bodies: &str, size: u32) -> SceneDesc {
    described(&format!(
        r#"Scene(
            camera: Camera(position: (0.5, 2.4, 6), look_at: (0.2, 0.8, 0), fov: 40),
            image: Image(width: {size}, height: {size}),
            render: Render(max_bounces: 5),
            materials: {{ "it": {material} }},
            lights: [SphereLight(center: (-2.5, 4, 3), radius: 0.7, radiance: (14, 13, 12))],
            objects: [Rectangle(size: 9, material: Diffuse(albedo: (0.7, 0.6, 0.5))), {bodies}],
        )"#
    ))
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn solids_as_the_reference_sees_them() {
    for (name, material, size, samples) in [
        ("matt", "Diffuse(albedo: (0.3, 0.5, 0.8))", 32, Samples { engine: 256, reference: 256 }),
        ("mirror", "Mirror(reflectance: (0.9, 0.8, 0.7))", 32, Samples { engine: 256, reference: 256 }),
        // Light through glass is found by few samples: many, of few pixels.
        (
            "glass",
            "Transparent(ior: 1.5, transmittance: (0.9, 0.95, 1))",
            16,
            Samples { engine: 4096, reference: 4096 },
        ),
    ] {
        assert_same_picture(&format!("solids, {name}"), &view(material, BODIES, size), samples);
    }
}

/// Materials, texture coordinates, patterns by an object's own coordinates and normals are those of the shape whose
/// surface is seen, also on a cut, and in every copy.
#[test]
fn first_hits_are_those_of_the_reference() {
    let text = r#"Scene(
        camera: Camera(position: (0.4, 1.8, 5), look_at: (0, 0.5, 0), fov: 40),
        image: Image(width: 64, height: 48),
        render: Render(samples: 2, max_bounces: 0, integrator: Path),
        effects: Effects(antialiasing: None),
        background: 1,
        materials: {
            "checks": Diffuse(albedo: Checkerboard(
                a: 0.2, b: 0.9, mapping: Object(scale: 4, offset: (0.13, 0.27, 0.41)),
            )),
            "tile": Diffuse(albedo: Texture(file: "assets/tile.png")),
            "grey": Diffuse(albedo: 0.4),
        },
        objects: [
            Difference(
                objects: [
                    Box(center: (0, 0.5, 0), size: (1.6, 1, 1), material: "checks"),
                    Cylinder(from: (-2, 0.5, 0.1), to: (2, 0.5, 0.1), radius: 0.3, material: "tile"),
                    Union(material: "checks", transform: [
                        Translate((0.2, 0.4, 0)), Rotate(axis: (0, 1, 0), degrees: 20),
                    ], objects: [
                        Sphere(center: (0.5, 0.6, 0.5), radius: 0.4, transform: [Scale((1, 1, 0.7))]),
                        Cone(from: (-0.6, 0, 0.5), to: (-0.6, 1, 0.5), radius: 0.3, tip_radius: 0.1, material: "grey"),
                    ]),
                ],
                placements: [
                    [Translate((-0.9, 0, 0))],
                    [Scale((-0.8, 0.9, 1)), Rotate(axis: (0.2, 1, 0.1), degrees: 60), Translate((1.1, 0.1, 0))],
                ],
            ),
        ],
    )"#;
    let scene = compiled(&described(text));
    let options =
        RenderOptions { layers: Some(LayerSet::all()), samples: Some(2), threads: 1, ..RenderOptions::default() };
    let film = render(&scene, &options, &Unobserved);
    let expected = first_hits(&scene);
    let layer = |layer: Layer| film.layer(layer).expect("all layers are kept");
    let at = |of: Layer, k: usize| -> Vec<f64> {
        let image = layer(of);
        let n = image.channels.len();
        image.values[k * n..(k + 1) * n].iter().map(|&x| f64::from(x)).collect()
    };
    let scale = scene.frame.scale;
    let (mut seen, mut materials) = (0, std::collections::BTreeSet::new());
    for (k, hit) in expected.iter().enumerate() {
        let Some(hit) = hit else {
            assert_eq!(at(Layer::ObjectId, k), [0.0]);
            continue;
        };
        seen += 1;
        materials.insert(hit.material);
        let near = |name: &str, found: Vec<f64>, expected: &[f64], tolerance: f64| {
            let same = found.iter().zip(expected).all(|(a, b)| (a - b).abs() <= tolerance);
            assert!(same, "{name} of pixel {k}: {found:?}, expected {expected:?}");
        };
        near("normal", at(Layer::Normal, k), &hit.normal.to_array(), 2e-5);
        near("position", at(Layer::Position, k), &(hit.point / scale + scene.frame.centre).to_array(), 3e-5);
        near("uv", at(Layer::Uv, k), &hit.uv, 3e-5);
        near("albedo", at(Layer::Albedo, k), &hit.albedo.to_array(), 1e-3);
        near("object", at(Layer::ObjectId, k), &[f64::from(hit.object) + 1.0], 0.0);
        near("material", at(Layer::MaterialId, k), &[f64::from(hit.material) + 1.0], 0.0);
    }
    assert!(seen > 500 && materials.len() == 3, "{seen} {materials:?}");
}

/// Glass in a white furnace cannot be seen, also where its parts touch: no wall is within it, and each way in has its
/// way out.
#[test]
fn glass_solids_in_a_white_furnace_cannot_be_seen() {
    let bodies = [
        ("two blocks", "Union(objects: [Box(center: (-0.5, 0, 0)), Box(center: (0.5, 0.1, 0))], "),
        (
            "overlap",
            "Union(objects: [Sphere(center: (0, 0, 0), radius: 0.8), Cylinder(from: (0, -1, 0), radius: 0.4)], ",
        ),
        (
            "stack",
            "Union(objects: [Cylinder(from: (0, -1, 0), to: (0, 0, 0), radius: 0.5), \
             Sphere(center: (0, 0, 0), radius: 0.5), Capsule(radius: 0.5)], ",
        ),
        (
            "lens",
            "Intersection(objects: [Sphere(center: (0, 0, -1), radius: 1.4), Sphere(center: (0, 0, 1), radius: 1.4)], ",
        ),
        (
            "hollow",
            "Difference(objects: [Sphere(center: (0, 0, 0), radius: 1), Sphere(center: (0, 0, 0), radius: 0.9)], ",
        ),
        (
            "bowl",
            "Difference(objects: [Sphere(center: (0, 0, 0), radius: 1), \
             Sphere(center: (0, 0, 0), radius: 0.9), Box(center: (0, 1, 0), size: 2)], ",
        ),
        (
            "rings",
            "Union(objects: [Torus(radius: 0.7, tube_radius: 0.25), \
             Torus(axis: (1, 0, 0), radius: 0.6, tube_radius: 0.2), Torus(radius: 0.7, tube_radius: 0.25)], ",
        ),
        ("step", "Difference(objects: [Box(), Box(center: (0.25, 0.25, 0), size: (0.5, 0.5, 1))], "),
    ];
    for (name, body) in bodies {
        for eye in ["(0.3, 0.4, 5)", "(3, 4, 1)", "(0.1, -5, 0.2)"] {
            let desc = described(&format!(
                "Scene(camera: Camera(position: {eye}, look_at: (0, 0, 0), fov: 30), image: Image(width: 24, \
                 height: 24), render: Render(max_bounces: 300), background: 1, objects: [{body}\
                 material: Transparent(ior: 1.5), \
                 transform: [Rotate(axis: (1, 2, 3), degrees: 35)])])"
            ));
            let film = film(&compiled(&desc), 16, 1);
            let of: Vec<f64> = (0..24 * 24).map(|k| film.radiance(k % 24, k / 24)[0]).collect();
            // Rays that go round within corners for ever are seen by some pixels; others are one but for rounding.
            let white = of.iter().filter(|x| (*x - 1.0).abs() < 1e-3).count() as f64 / of.len() as f64;
            let mean = of.iter().sum::<f64>() / of.len() as f64;
            assert!(white > 0.95 && (mean - 1.0).abs() < 0.01, "{name} from {eye}: {mean}, {white} of the pixels");
        }
    }
}

/// The pixels that differ by more than rounding, of all.
fn differing(a: &SceneDesc, b: &SceneDesc) -> f64 {
    let [a, b] = [a, b].map(|desc| film(&compiled(desc), 4, 1));
    let [w, h] = [a.crop().width, a.crop().height];
    let far = |k: &u32| {
        let [a, b] = [&a, &b].map(|film| DVec3::from(film.radiance(k % w, k / w)));
        (a - b).abs().max_element() > 1e-3 * (a.max_element() + b.max_element())
    };
    (0..w * h).filter(far).count() as f64 / f64::from(w * h)
}

/// A solid of one shape is that shape; so it is without a body far away, within a large one, and with itself.
#[test]
fn solids_that_are_one_of_their_shapes() {
    let shapes = [
        "Sphere(center: (0, 0.8, 0), radius: 0.7, transform: [Scale((1, 0.8, 1))])",
        "Cylinder(from: (-0.6, 0.3, 0), to: (0.5, 1.2, 0.3), radius: 0.4)",
        "Cone(from: (0, 0.01, 0), to: (0.2, 1.4, 0), radius: 0.8, tip_radius: 0.2)",
        "Capsule(from: (-0.6, 0.5, 0), to: (0.6, 0.8, 0.3), radius: 0.4)",
        "Torus(center: (0.5, 0.6, 0), axis: (0, 0.3, 1), radius: 0.5, tube_radius: 0.25)",
        "Box(center: (0, 0.6, 0), transform: [Rotate(axis: (0, 1, 0), degrees: 25)])",
    ];
    let with = |body: &str| {
        described(&format!(
            "Scene(camera: Camera(position: (0.5, 2.2, 6), look_at: (0, 0.7, 0), fov: 26), image: Image(width: 48, \
             height: 48), render: Render(max_bounces: 1, integrator: Path), lights: [SphereLight(center: (-2.5, 4, 3), \
             radius: 0.7, radiance: 14)], objects: [Rectangle(size: 9), {body}])"
        ))
    };
    for shape in shapes {
        let alone = with(shape);
        for solid in [
            format!("Union(objects: [{shape}])"),
            format!("Difference(objects: [{shape}, Sphere(center: (0, 90, 0), radius: 3)])"),
            format!("Intersection(objects: [{shape}, Box(size: 20)])"),
            format!("Intersection(objects: [Box(size: 20), {shape}])"),
            format!("Union(objects: [{shape}, {shape}])"),
            format!("Union(objects: [{shape}, Box(center: (0, 0.6, 0), size: 0.01)])"),
            format!("Intersection(objects: [{shape}, Plane(point: (0, 3, 0))])"),
            format!("Intersection(objects: [Plane(point: (0, 3, 0), normal: (0.1, 1, 0.2)), {shape}])"),
            format!("Difference(objects: [{shape}, Plane(point: (0, -1, 0))])"),
        ] {
            let share = differing(&alone, &with(&solid));
            assert!(share < 0.01, "{solid}: {share} of the pixels differ");
        }
    }
}

/// Glass of index one changes nothing: lamps are seen through it as without.
#[test]
fn a_lens_of_index_one_is_not_there() {
    let with = |body: &str| {
        described(&format!(
            "Scene(camera: Camera(position: (0.2, 0.3, 6), look_at: (0, 0, 0), fov: 30), image: Image(width: 64, \
             height: 64), render: Render(max_bounces: 60), effects: Effects(antialiasing: None), \
             background: 0.1, objects: [\
             Box(center: (-1, 0, -2), size: (1, 1, 0.1), material: Emissive(radiance: 3)), \
             Sphere(center: (0.6, 0.2, -2), radius: 0.6, material: Emissive(radiance: (1, 2, 5))), {body}])"
        ))
    };
    let free = with("Sphere(center: (0, -50, 0), radius: 1)");
    for body in [
        "Intersection(objects: [Sphere(center: (0, 0, -1), radius: 1.6), Sphere(center: (0, 0, 1), radius: 1.6)], ",
        "Difference(objects: [Sphere(center: (0, 0, 0), radius: 1), Sphere(center: (0, 0, 0), radius: 0.9)], ",
        "Union(objects: [Box(center: (-0.5, 0, 0)), Box(center: (0.5, 0.1, 0)), Capsule(radius: 0.4)], ",
    ] {
        let share = differing(
            &free,
            &with(&format!("Sphere(center: (0, -50, 0), radius: 1), {body}material: Transparent(ior: 1))")),
        );
        assert!(share < 0.002, "{body}: {share} of the pixels differ");
    }
}

/// What cannot be is told, also of what was built in code.
#[test]
fn faults_of_solids() {
    let mut desc = described("Scene(background: 1, objects: [Union(objects: [Box(), Cylinder(radius: 1)])])");
    let told = |desc: &SceneDesc| match compile(desc) {
        Err(error) => error.diagnostics.iter().map(|d| format!("{}: {}", d.code, d.message)).collect::<Vec<_>>(),
        Ok(_) => Vec::new(),
    };
    assert!(told(&desc).is_empty());
    let scene_format::desc::Object::Union(union) = &mut desc.objects[0].value else { panic!("a union") };
    let shape = |text: &str| described(&format!("Scene(background: 1, objects: [{text}])")).objects.remove(0);
    union.objects.0.push(shape("Arrow(radius: 0.2)"));
    union.objects.0.push(shape("Cylinder(radius: 1, caps: false)"));
    let expected = [
        "E0543: an `Arrow` is made of triangles, and cannot be part of a solid",
        "E0543: an open cylinder has no inside",
    ];
    assert_eq!(told(&desc), expected);
    let scene_format::desc::Object::Union(union) = &mut desc.objects[0].value else { panic!("a union") };
    union.objects.0.truncate(1);
    union.objects.0.push(shape("Sphere(center: (0, 0, 0), radius: 1, material: Emissive(radiance: 1))"));
    assert!(told(&desc).is_empty());
    // One mistake is told once, at the whole or at the part.
    let lamp = "background: 1, materials: { \"lamp\": Emissive(luminous_power: 5) }";
    for (solid, word, what) in [
        ("Union(material: Emissive(power: 1), objects: [Box(), Box()])", "power", "a union"),
        ("Intersection(material: \"lamp\", objects: [Box(), Box()])", "luminous_power", "an intersection"),
        ("Difference(objects: [Box(), Box(material: \"lamp\")])", "luminous_power", "a part of a solid"),
        ("Union(objects: [Box(), Union(material: \"lamp\", objects: [Box()])])", "luminous_power", "a union"),
    ] {
        let expected =
            format!("E0544: `{word}` is of a whole lamp, and of {what} nobody knows how much surface is left");
        assert_eq!(told(&described(&format!("Scene({lamp}, objects: [{solid}])"))), [expected], "{solid}");
    }
}

/// Rings about a lamp on a floor: what is lit of their far inner side does not shine through the near one. The floor
/// outside is black to the last bit, as rims are of one height and nothing is above.
#[test]
fn nothing_shines_through_its_own_near_wall() {
    let rings = [
        ("torus", "Torus(center: (0, 0.3, 0), radius: 1, tube_radius: 0.3)"),
        (
            "pipe",
            "Difference(objects: [Cylinder(to: (0, 0.6, 0), radius: 1.3), \
             Cylinder(from: (0, -1, 0), to: (0, 1, 0), radius: 1)])",
        ),
        ("open cylinder", "Cylinder(to: (0, 0.6, 0), radius: 1, caps: false)"),
        ("open cone", "Cone(to: (0, 0.6, 0), radius: 1.2, tip_radius: 0.9, caps: false)"),
    ];
    for (name, ring) in rings {
        let desc = described(&format!(
            "Scene(camera: Camera(position: (0, 8, 0), look_at: (0, 0, 0), up: (0, 0, -1), fov: 30), \
             image: Image(width: 16, height: 16), render: Render(max_bounces: 3), \
             lights: [SphereLight(center: (0, 0.3, 0), radius: 0.1, power: 100)], \
             objects: [Rectangle(size: 20), {ring}])"
        ));
        let film = film(&compiled(&desc), 64, 1);
        let (mut inside, mut outside, mut count) = (0.0, 0.0, 0);
        for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
            // What a pixel spans of the floor, seen from 8 above with a field of 30 degrees.
            let at = |k: u32| (f64::from(k) - 7.5) / 8.0 * 8.0 * 0.267_949;
            let light = film.radiance(x, y)[0];
            if at(x).hypot(at(y)) > 1.75 {
                (outside, count) = (outside + light, count + 1);
            } else {
                inside += light;
            }
        }
        assert!(inside > 1.0 && count > 40 && outside == 0.0, "{name}: {outside} of {inside} in {count} pixels");
    }
}
