//! Whatever is written is read again as the same scene; what RON's own crate reads has the same values.

mod common;

use common::{FULL_RON, FULL_TOML, Random, load};
use scene_format::desc::*;
use scene_format::diagnostic::{Span, Spanned};
use scene_format::{Defaults, SceneDesc, Syntax, convert, examples, hash, hash_hex, to_text};
use std::path::PathBuf;
use std::sync::Arc;

fn number(random: &mut Random, low: f64, high: f64) -> f64 {
    match random.below(6) {
        0 => (low + (high - low) * random.unit()).round().clamp(low, high),
        1 if low <= 0.0 && high >= 0.0 => 0.0,
        // Very small and very large ones, where decimal digits are hard to get right.
        2 if high > 1e6 => 10f64.powi(random.below(20) as i32 - 10).clamp(low, high),
        _ => low + (high - low) * random.unit(),
    }
}

fn length(random: &mut Random) -> f64 {
    number(random, 1e-9, 1e9).max(1e-9)
}

fn vector(random: &mut Random) -> Vec3 {
    [(); 3].map(|()| number(random, -1e6, 1e6))
}

fn share(random: &mut Random) -> Color {
    if random.below(3) == 0 { [random.unit(); 3] } else { [(); 3].map(|()| random.unit()) }
}

fn text(random: &mut Random) -> String {
    const LETTERS: [&str; 12] = ["a", "Z", "0", "_", "-", " ", "é", "赤", "\"", "\\", "\t", "\u{1}"];
    let letters: String = (0..1 + random.below(8)).map(|_| *random.pick(&LETTERS)).collect();
    format!("n{letters}")
}

fn mapping(random: &mut Random) -> Mapping {
    if random.below(2) == 0 {
        return Mapping::default();
    }
    let uniform = number(random, -100.0, 100.0);
    let scale = [uniform, if random.below(2) == 0 { uniform } else { number(random, -100.0, 100.0) }];
    let offset = if random.below(2) == 0 { [0.0; 2] } else { [random.unit(), number(random, -9.0, 9.0)] };
    Mapping::uv(scale, number(random, -360.0, 360.0), offset)
}

fn albedo(random: &mut Random) -> Albedo {
    match random.below(6) {
        0 => Albedo::Texture(Texture {
            file: PathBuf::from(text(random)).into(),
            filter: *random.pick(&[TextureFilter::Bilinear, TextureFilter::Nearest]),
            wrap: *random.pick(&[TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror]),
            mapping: mapping(random),
        }),
        1 => Albedo::Checkerboard(Box::new(Checkerboard {
            a: share(random).into(),
            b: share(random).into(),
            mapping: mapping(random),
        })),
        _ => Albedo::Color(share(random).into()),
    }
}

fn material(random: &mut Random) -> Material {
    match random.below(6) {
        5 => Material::Conductor(Box::new(Conductor {
            reflectance: match random.below(3) {
                0 => Reflectance::Metal(*random.pick(&[Metal::Silver, Metal::Gold, Metal::Steel])),
                1 => Reflectance::Complex { ior: share(random).into(), k: share(random).into() },
                _ => Reflectance::Tinted { reflectance: albedo(random), edge_tint: share(random).into() },
            },
            roughness: random.unit().into(),
            multiple_scattering: random.below(2) == 0,
        })),
        0 => Material::Diffuse(Diffuse { albedo: albedo(random) }),
        4 => {
            let color = share(random).map(|channel| channel * 1e3);
            let amount = if random.below(2) == 0 { Amount::Radiance(color) } else { Amount::Power(color) };
            Material::Emissive(Box::new(Emissive { amount: amount.into(), two_sided: random.below(2) == 0 }))
        }
        1 => Material::Mirror(Mirror { reflectance: share(random).into() }),
        2 => Material::Transparent(Box::new(Transparent {
            ior: number(random, 1.0, 3.0).into(),
            transmittance: share(random).into(),
        })),
        _ => Material::BlinnPhong(Box::new(BlinnPhong {
            albedo: albedo(random),
            exponent: number(random, 0.0, 1e5).into(),
            specular: random.unit().into(),
            energy_conserving: random.below(2) == 0,
        })),
    }
}

fn transform(random: &mut Random) -> Transform {
    let about = (random.below(2) == 0).then(|| Box::new(vector(random)));
    match random.below(4) {
        0 => Transform::Translate(vector(random)),
        1 => {
            let uniform = random.below(2) == 0;
            let factor = [(); 3].map(|()| number(random, 0.1, 10.0) * [1.0, -1.0][random.below(2)]);
            Transform::Scale { factor: if uniform { [factor[0]; 3] } else { factor }, about }
        }
        2 => Transform::Rotate { axis: [1.0, random.unit(), 0.0], degrees: number(random, -360.0, 360.0), about },
        _ => Transform::DropTo { y: number(random, -1e3, 1e3) },
    }
}

/// Points, and faces that name them.
fn inline_mesh(random: &mut Random) -> MeshSource {
    let points: Vec<_> = (0..3 + random.below(5)).map(|_| vector(random)).collect();
    let mut faces = Faces::default();
    for _ in 0..=random.below(3) {
        let corners: Vec<u32> = (0..3 + random.below(3)).map(|_| random.below(points.len()) as u32).collect();
        faces.push(&corners);
    }
    MeshSource::Inline(Arc::new(InlineMesh { points, faces }.into()))
}

fn transforms(random: &mut Random) -> Vec<scene_format::diagnostic::Spanned<Transform>> {
    (0..random.below(4)).map(|_| transform(random).into()).collect()
}

fn pattern(random: &mut Random) -> PlacementPattern {
    let count = |random: &mut Random| 1 + random.below(5) as u32;
    match random.below(3) {
        0 => PlacementPattern::Grid { count: [count(random), 1, count(random)], spacing: vector(random) },
        1 => PlacementPattern::Ring {
            count: count(random),
            radius: length(random),
            axis: [0.0, number(random, 0.1, 1.0), 1.0],
            start: number(random, -90.0, 90.0),
            turn: random.below(2) == 0,
        },
        _ => PlacementPattern::Scatter {
            count: count(random),
            min: vector(random),
            max: vector(random),
            seed: count(random),
            spacing: (random.below(2) == 0).then(|| length(random)),
            turn: (random.below(2) == 0).then_some([0.0, 1.0, 0.0]),
            scale: [0.5, number(random, 1.0, 2.0)],
        },
    }
}

fn name(random: &mut Random) -> Name {
    (random.below(3) == 0).then(|| text(random)).into()
}

/// Puts some of the objects into groups, and groups into groups.
fn grouped(random: &mut Random, objects: &mut [Spanned<Object>]) {
    let moves = |random: &mut Random| {
        let mut steps = transforms(random);
        steps.retain(|step| !matches!(step.value, Transform::DropTo { .. }));
        steps.insert(0, Transform::Translate(vector(random)).into());
        steps
    };
    let group = |random: &mut Random| {
        let placements = match random.below(3) {
            0 => Placements::One,
            1 => Placements::File(Box::new(PathBuf::from(text(random)).into())),
            _ => Placements::List(Box::new((0..1 + random.below(3)).map(|_| moves(random)).collect())),
        };
        Arc::new(Moved { transform: moves(random), placements })
    };
    let mut groups = Arc::new(Groups { inner: None, group: group(random) });
    for object in objects {
        match random.below(5) {
            0 => groups = Arc::new(Groups { inner: None, group: group(random) }),
            1 => groups = Arc::new(Groups { inner: Some(groups), group: group(random) }),
            2 => continue,
            _ => {}
        }
        let placements = object.value.placements_mut();
        let own = std::mem::take(placements);
        *placements = Placements::Within(Box::new(Within { own, groups: Arc::clone(&groups) }));
    }
}

/// A valid scene that uses much of the language.
fn scene(random: &mut Random) -> SceneDesc {
    let names: Vec<Arc<str>> = (0..random.below(4)).map(|index| format!("{index}{}", text(random)).into()).collect();
    let material_ref = |random: &mut Random| match random.below(3) {
        0 if !names.is_empty() => MaterialRef::Named { name: Arc::clone(random.pick(&names)), span: Span::NONE },
        1 => MaterialRef::Inline(Box::new(material(random).into())),
        _ => MaterialRef::Default,
    };
    let mut objects = Vec::new();
    for _ in 0..1 + random.below(5) {
        let material = material_ref(random);
        let placements = match random.below(4) {
            0 => Placements::One,
            1 => Placements::File(Box::new(PathBuf::from(text(random)).into())),
            2 => Placements::Pattern(Box::new(pattern(random).into())),
            _ => Placements::List(Box::new((0..1 + random.below(3)).map(|_| transforms(random)).collect())),
        };
        let object = match random.below(9) {
            0 | 1 => Object::Sphere(Box::new(Sphere {
                center: vector(random).into(),
                radius: length(random).into(),
                material,
                transform: transforms(random),
                placements,
                name: name(random),
            })),
            5 => Object::Disk(Box::new(Disk {
                center: vector(random).into(),
                normal: [0.3, number(random, -1.0, 1.0), 0.0].into(),
                radius: length(random).into(),
                inner_radius: number(random, 0.0, 1.0).into(),
                material,
                transform: transforms(random),
                placements,
                name: name(random),
            })),
            6 => Object::Cylinder(Box::new(Cylinder {
                from: vector(random).into(),
                to: vector(random).into(),
                radius: length(random).into(),
                caps: random.below(2) == 0,
                material,
                transform: transforms(random),
                placements,
                name: name(random),
            })),
            7 => Object::Cone(Box::new(Cone {
                from: vector(random).into(),
                to: vector(random).into(),
                radius: length(random).into(),
                tip_radius: number(random, 0.0, 2.0).into(),
                caps: random.below(2) == 0,
                material,
                transform: transforms(random),
                placements,
                name: name(random),
            })),
            8 => Object::Capsule(Box::new(Capsule {
                from: vector(random).into(),
                to: vector(random).into(),
                radius: length(random).into(),
                material,
                transform: transforms(random),
                placements,
                name: name(random),
            })),
            2 => Object::Rectangle(Box::new(Rectangle {
                center: vector(random).into(),
                normal: [0.3, number(random, -1.0, 1.0), 0.0].into(),
                size: PerAxis([length(random), length(random)]).into(),
                material,
                transform: transforms(random),
                placements,
                name: name(random),
            })),
            3 => Object::Box(Box::new(RectBox {
                center: vector(random).into(),
                size: PerAxis(if random.below(2) == 0 { [length(random); 3] } else { [1.0, length(random), 2.0] })
                    .into(),
                material,
                transform: transforms(random),
                placements,
                name: name(random),
            })),
            _ => Object::Mesh(Mesh {
                source: if random.below(2) == 0 {
                    MeshSource::File(PathBuf::from(text(random)).into())
                } else {
                    inline_mesh(random)
                },
                material,
                transform: transforms(random),
                placements,
                instances: *random.pick(&[Instances::Auto, Instances::Always, Instances::Never]),
                shading: *random.pick(&[Shading::Auto, Shading::Smooth, Shading::Flat]),
                name: name(random),
            }),
        };
        objects.push(object.into());
    }
    grouped(random, &mut objects);
    let light = |random: &mut Random| {
        let color = share(random).map(|channel| channel * 100.0);
        let emission = match random.below(3) {
            0 => Emission::Intensity(color),
            1 => Emission::Radiance(color),
            _ => Emission::Power(color),
        };
        Light::SphereLight(SphereLight {
            center: vector(random).into(),
            radius: length(random).into(),
            emission: emission.into(),
            name: name(random),
        })
    };
    let defaults = SceneDesc::default();
    SceneDesc {
        camera: Camera {
            position: [1e7, number(random, -1.0, 1.0), 0.0].into(),
            look_at: vector(random).into(),
            fov: number(random, 1.0, 179.0).into(),
            ..Camera::default()
        },
        image: Image { width: (1 + random.below(65536) as u32).into(), ..Image::default() },
        render: Render {
            seed: (random.next() as u32).into(),
            noise: (random.below(2) == 0).then(|| number(random, 0.001, 0.9).into()),
            time: (random.below(2) == 0).then(|| length(random).into()),
            acceleration: *random.pick(&[Acceleration::Bvh, Acceleration::BoundingBox, Acceleration::None]),
            integrator: *random.pick(&[Integrator::Full, Integrator::Path]),
            ..Render::default()
        },
        effects: Effects {
            antialiasing: match random.below(4) {
                0 => PixelFilter::None,
                1 => PixelFilter::Box,
                2 => PixelFilter::Gaussian { sigma: number(random, 0.0, 3.0).into() },
                _ => PixelFilter::BlackmanHarris { radius: number(random, 0.5, 3.0).into() },
            },
            depth_of_field: (random.below(2) == 0).then(|| ThinLens {
                aperture: number(random, 0.0, 10.0).into(),
                focus_distance: length(random).into(),
            }),
            exposure: number(random, -5.0, 5.0).into(),
            tone_map: *random.pick(&[ToneMap::None, ToneMap::Filmic, ToneMap::AgX]),
        },
        output: Output { layers: (0..random.below(3)).map(|_| *random.pick(&[Layer::Albedo, Layer::Depth])).collect() },
        background: match random.below(3) {
            0 => Background::Environment(Box::new(Environment {
                file: std::sync::Arc::<std::path::Path>::from(PathBuf::from(text(random))).into(),
                scale: share(random),
                rotation: number(random, -400.0, 400.0),
                up: [1.0, number(random, -1.0, 1.0), 0.0].into(),
                camera_visible: random.below(2) == 0,
            })),
            _ => share(random).into(),
        },
        lights: (0..random.below(3)).map(|_| light(random).into()).collect(),
        materials: names
            .iter()
            .map(|name| NamedMaterial { name: name.clone().into(), material: material(random) })
            .collect(),
        objects,
        ..defaults
    }
}

/// A scene without the texts it came from.
fn plain(scene: SceneDesc) -> SceneDesc {
    let mut materials = scene.materials;
    materials.sort_by(|a, b| a.name.value.cmp(&b.name.value));
    SceneDesc { sources: Vec::new(), base_dir: PathBuf::new(), materials, ..scene }
}

fn read(text: &str, syntax: Syntax) -> SceneDesc {
    match load(text, syntax) {
        Ok(loaded) => loaded.scene,
        Err(error) => panic!("{error:?}\n{text}"),
    }
}

#[test]
fn generated_scenes_are_read_as_they_were_written() {
    let mut random = Random(1);
    for _ in 0..1500 {
        let written = scene(&mut random);
        let expected = plain(written.clone());
        for syntax in [Syntax::Ron, Syntax::Toml] {
            for defaults in [Defaults::Hidden, Defaults::Shown] {
                let text = to_text(&written, syntax, defaults);
                let back = read(&text, syntax);
                assert_eq!(hash(&back), hash(&written), "{text}");
                assert_eq!(plain(back), expected, "{text}");
            }
        }
    }
}

#[test]
fn converted_scenes_say_the_same() {
    let mut random = Random(2);
    let mut texts: Vec<(String, Syntax)> =
        vec![(FULL_RON.to_owned(), Syntax::Ron), (FULL_TOML.to_owned(), Syntax::Toml)];
    texts.extend(examples().into_iter().map(|example| (example.ron, Syntax::Ron)));
    texts.extend((0..300).map(|_| (to_text(&scene(&mut random), Syntax::Ron, Defaults::Hidden), Syntax::Ron)));
    for (text, syntax) in texts {
        let expected = hash_hex(&read(&text, syntax));
        let other = if syntax == Syntax::Ron { Syntax::Toml } else { Syntax::Ron };
        let there = convert("scene", &text, syntax, other).expect("the scene is right");
        assert_eq!(hash_hex(&read(&there, other)), expected, "{there}");
        let back = convert("scene", &there, other, syntax).expect("the converted scene is right");
        assert_eq!(hash_hex(&read(&back, syntax)), expected, "{back}");
        // Once converted, a text stays as it is.
        let again = convert("scene", &back, syntax, other).expect("the scene is right");
        assert_eq!(again, there);
    }
}

#[test]
fn the_two_full_scenes_are_the_same_and_their_hash_stays() {
    let (ron, toml) = (read(FULL_RON, Syntax::Ron), read(FULL_TOML, Syntax::Toml));
    assert_eq!(plain(ron.clone()), plain(toml.clone()));
    assert_eq!(hash_hex(&ron), hash_hex(&toml));
    // Fields at their default are left out of it, so that version 1 files keep their hash when the language gets new fields.
    let shown = to_text(&ron, Syntax::Ron, Defaults::Shown);
    assert_eq!(hash_hex(&read(&shown, Syntax::Ron)), hash_hex(&ron));
    assert_eq!(hash_hex(&ron), "49b55913529e6d0e1b6b07bfcacabea51e0c84883c4319ef21ea4ea7ec0d523d");
}

#[test]
fn the_hash_sees_values_and_not_their_form() {
    let hash = |objects: &str| hash_hex(&read(&format!("Scene(background: 1, objects: [{objects}])"), Syntax::Ron));
    let one = hash("Sphere(center: (0, 0, 0), radius: 1)");
    assert_eq!(hash("Sphere(radius: 1.0, center: [0.0, -0.0, 0e5]) /* one */"), one);
    assert_eq!(hash("Sphere(center: (0, 0, 0), radius: 1_0e-1,)"), one);
    assert_ne!(hash("Sphere(center: (0, 0, 0), radius: 1.0000000000000002)"), one);
    assert_ne!(hash("Sphere(center: (0, 0, 0), radius: 1, material: Mirror())"), one);
}

#[test]
fn comments_and_the_form_of_values_travel_with_their_items() {
    let ron = "\
// The room.
Scene(
    // Seen from the door.
    camera: Camera(fov: 6_0), // wide
    background: \"#ff8800\",
    objects: [
        // The big one.
        Sphere(center: (0, 0, 0), radius: 1e1), // round
        Mesh(
            file: \"cat.obj\", // ours
            // First to last.
            transform: [
                Scale(.5), // half
            ],
        ),
    ],
    // The end.
)
";
    let toml = convert("room.ron", ron, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    assert_eq!(
        toml,
        "\
# The room.

background = \"#ff8800\"

# Seen from the door.
[camera] # wide
fov = 6_0

# The big one.
[[objects]] # round
Sphere = { center = [0, 0, 0], radius = 1e1 }

[[objects]]
[objects.Mesh]
file = \"cat.obj\" # ours
# First to last.
transform = [
    { Scale = 0.5 }, # half
]

# The end.
"
    );
}

/// A headline, a licence, how to render it: what stands at a file's top stays there, there and back.
#[test]
fn the_comment_at_the_top_stays_at_the_top() {
    let ron = "// A ball.\n//\n// Render it.\nScene(\n    background: 1,\n    // The view.\n    camera: Camera(fov: 60),\n    \
               objects: [Sphere(center: (0, 0, 0), radius: 1)],\n)\n";
    let toml = convert("s", ron, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    assert!(toml.starts_with("# A ball.\n#\n# Render it.\n\nbackground = 1\n\n# The view.\n[camera]\n"), "{toml}");
    assert_eq!(convert("s", &toml, Syntax::Toml, Syntax::Ron).expect("the scene is right"), ron);
    // Also where no empty line follows, and where the entry below it moves: plain values come before tables in TOML.
    let toml = "# A ball.\nbackground = 1\n[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 }\n";
    let there = convert("s", toml, Syntax::Toml, Syntax::Ron).expect("the scene is right");
    assert!(there.starts_with("// A ball.\nScene(\n"), "{there}");
    let ron = "// A ball.\nScene(objects: [Sphere(center: (0, 0, 0), radius: 1)], background: 1)";
    let toml = convert("s", ron, Syntax::Ron, Syntax::Toml).expect("the scene is right");
    assert!(toml.starts_with("# A ball.\n\nbackground = 1\n"), "{toml}");
}

#[test]
fn a_wrong_scene_is_not_converted() {
    assert!(convert("s.ron", "Scene(objects: [Sphere(radius: 1)])", Syntax::Ron, Syntax::Toml).is_err());
}

/// What the `ron` crate reads of a sphere, for comparison.
#[derive(Debug, serde::Deserialize)]
#[serde(rename = "Scene")]
struct OracleScene {
    camera: OracleCamera,
    objects: Vec<OracleObject>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(rename = "Camera")]
struct OracleCamera {
    position: (f64, f64, f64),
    fov: f64,
}

#[derive(Debug, serde::Deserialize)]
enum OracleObject {
    Sphere { center: (f64, f64, f64), radius: f64, material: String },
}

#[test]
fn the_ron_crate_reads_the_same_numbers_and_texts() {
    let numbers = ["0", "-0.0", "1", "-17", "3.25", "1e3", "-2.5E-3", "1_000", ".5", "7.", "1.7976931348623157e300"];
    let texts = [r#""a""#, r#""a\"b\\c""#, r##"r#"raw "x""#"##, r#""\u{e9}\x41\n""#, r#""é赤""#];
    let mut random = Random(3);
    for _ in 0..500 {
        let n: Vec<&str> = (0..4).map(|_| *random.pick(&numbers)).collect();
        let name = *random.pick(&texts);
        let source = format!(
            "#![enable(implicit_some)]\n/* a */ Scene( // b\n camera: Camera(position: (1, {}, 5), fov: 4_0.5,), objects: [ \
             Sphere(center: ({}, {}, {},), radius: 2, material: {name}) , ] )",
            n[0], n[1], n[2], n[3]
        );
        let oracle: OracleScene = ron::from_str(&source).unwrap_or_else(|error| panic!("{error}\n{source}"));
        let with_material = source.replacen("objects:", &format!("materials: {{ {name}: Mirror() }}, objects:"), 1);
        let large = n.iter().any(|number| number.contains("e300"));
        match load(&with_material, Syntax::Ron) {
            Err(_) => assert!(large, "{with_material}"),
            Ok(loaded) => {
                let Object::Sphere(sphere) = &loaded.scene.objects[0].value else { panic!("a sphere") };
                let OracleObject::Sphere { center, radius, material } = &oracle.objects[0];
                assert_eq!(sphere.center.value, [center.0, center.1, center.2], "{source}");
                assert_eq!(sphere.radius.value, *radius);
                assert_eq!(sphere.material, MaterialRef::Named { name: material.as_str().into(), span: Span::NONE });
                assert_eq!(loaded.scene.camera.fov.value, oracle.camera.fov);
                assert_eq!(loaded.scene.camera.position.value[1], oracle.camera.position.1);
            }
        }
    }
}

/// Every TOML text that loads is TOML for the `toml` crate too, and no other.
#[test]
fn the_toml_crate_takes_what_loads() {
    assert!(toml::from_str::<toml::Value>(FULL_TOML).is_ok());
    let mut random = Random(4);
    for _ in 0..300 {
        let text = to_text(&scene(&mut random), Syntax::Toml, Defaults::Shown);
        assert!(toml::from_str::<toml::Value>(&text).is_ok(), "{text}");
    }
}
