//! Planes without an end: against the reference, against formulas, and against what they must look the same as.

use crate::coplanar::{Attitude, BLUE, RED, SIZE, flat_sided, of, points, rectangle};
use crate::support::compare::{Samples, assert_guiding_is_unbiased, assert_same_picture, assert_sharing_is_unbiased};
use crate::support::describe::*;
use crate::support::{compiled, film};
use glam::{DQuat, DVec3};
use scene_format::desc::{
    Amount, Emissive, Extent, LightGroup, Material, Name, Object, PerAxis, PixelFilter, Placements, Plane, RectBox,
    Rectangle, Transform, Vec3,
};
use scene_format::diagnostic::Spanned;
use scene_format::{SceneDesc, Syntax};
use std::path::Path;
use tracer_core::{Crop, Film, compile};
use tracer_reference::statistics::Estimate;

/// A plane, which steps put in its place.
pub(crate) fn plane(point: Vec3, normal: Vec3, material: Material, transform: Vec<Transform>) -> Object {
    Object::Plane(Box::new(Plane {
        point: point.into(),
        normal: normal.into(),
        material: of(material),
        transform: transform.into_iter().map(Spanned::from).collect(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

const UP: Vec3 = [0.0, 1.0, 0.0];

/// The plane y = 0 of an attitude, written by a point of it that is far away.
fn lying(attitude: &Attitude, material: Material) -> Object {
    plane([0.0; 3], UP, material, attitude.steps(17.0, [3000.0, 0.0, -500.0]))
}

/// A scene that is written in the language.
fn written(text: &str) -> SceneDesc {
    match scene_format::load_str("planes", text, Syntax::Ron, Path::new(""), &[]) {
        Ok(loaded) => loaded.scene,
        Err(error) => panic!("{error:?}"),
    }
}

/// Half of the space before each pixel is the plane, half the white sky: exactly its albedo, sample by sample, up to
/// the horizon and whatever the attitude, the height of the eye and the scene's place. From below, too.
#[test]
fn it_reaches_to_the_horizon() {
    let attitudes = [
        Attitude { axis: DVec3::X, degrees: 0.0, place: DVec3::ZERO },
        Attitude { axis: DVec3::Z, degrees: 90.0, place: DVec3::new(0.3, 0.7, -0.2) },
        Attitude { axis: DVec3::new(0.48, 0.6, 0.64), degrees: 47.0, place: DVec3::new(1.3, -2.7, 3.1) },
        Attitude { axis: DVec3::new(-0.8, 0.0, 0.6), degrees: 161.0, place: DVec3::new(4000.0, 2000.0, -700.0) },
    ];
    for (round, attitude) in attitudes.into_iter().enumerate() {
        for height in [1e-4, 0.01, 1.0, -0.3, 50.0] {
            for with_ball in [false, true] {
                let mut objects = vec![lying(&attitude, diffuse(RED))];
                if with_ball {
                    // Where it is is all that it says: nothing sees it.
                    let behind = attitude.point(DVec3::new(0.0, -2.0 * f64::signum(height), 9.0));
                    objects.push(sphere(behind.to_array(), 0.5, diffuse(BLUE)));
                }
                let eye = DVec3::new(0.2, height, 4.0);
                // Down by less than half a degree: half of the picture is the plane, its upper rows the far of it.
                let look_at = eye + DVec3::new(0.1, -0.002, -1.0);
                let mut desc = scene(SIZE, vec![], objects)
                    .background([1.0; 3])
                    .camera(attitude.point(eye).to_array(), attitude.point(look_at).to_array(), 3.0)
                    .bounces(2)
                    .filter(PixelFilter::None);
                desc.camera.up = (attitude.point(DVec3::Y) - attitude.place).to_array().into();
                let film = film(&compiled(&desc), 4, round as u32);
                let mut of_plane = 0;
                for (k, p) in (0u32..).zip(points(eye, look_at, DVec3::Y, 3.0)) {
                    let away = (p - eye).dot(look_at - eye);
                    let expected = if away > 0.0 { RED } else { [1.0; 3] };
                    let seen = film.radiance(k % SIZE, k / SIZE);
                    let same = (0..3).all(|c| (seen[c] - expected[c]).abs() < 1e-4);
                    assert!(same, "{attitude:?}, {height} high, pixel {k}: {seen:?}, not {expected:?}");
                    of_plane += usize::from(away > 0.0);
                }
                assert!((300..800).contains(&of_plane), "{of_plane} pixels of the plane");
            }
        }
    }
}

/// Irradiance of a ball of radiance one, wholly above: pi (r / d)^2 cos. By shadow rays only, and by all rays.
#[test]
fn a_ball_of_light_lights_it_as_the_formula_says() {
    for (center, radius) in [([0.0, 2.0, 0.0], 0.5), ([1.5, 0.8, -1.0], 0.6), ([30.0, 9.0, 0.0], 4.0)] {
        for bounces in [0, 1] {
            let d2 = center.iter().map(|x: &f64| x * x).sum::<f64>();
            let expected = 0.6 * (radius * radius / d2) * (center[1] / d2.sqrt());
            let desc = scene(
                8,
                vec![light(center, radius, [1.0; 3])],
                vec![plane([5.0, 0.0, 7.0], UP, diffuse([0.6; 3]), vec![])],
            )
            .camera([-0.3, 0.4, 0.1], [0.0; 3], 0.01)
            .bounces(bounces);
            let scene = compiled(&desc);
            let means: Vec<f64> = (0..8).map(|seed| mean(&film(&scene, 256, seed))).collect();
            let estimate = Estimate::of(&means);
            println!("{center:?}: {} +- {}, expected {expected}", estimate.mean, estimate.error());
            assert!(estimate.error() <= 2e-3 * expected);
            assert!((estimate.mean - expected).abs() <= 6.0 * estimate.error() + 2e-6 * expected, "{center:?}");
        }
    }
}

fn mean(film: &Film) -> f64 {
    let Crop { width, height, .. } = film.crop();
    let pixels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    pixels.map(|(x, y)| film.radiance(x, y)[0]).sum::<f64>() / f64::from(width * height)
}

/// Its patterns, its front, its transforms and copies, and what it does to light, as the reference has it.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn planes_as_the_reference_sees_them() {
    let samples = Samples { engine: 256, reference: 256 };
    let texts = [
        (
            "patterns",
            r#"objects: [
                Plane(material: Diffuse(albedo: Checkerboard(a: (0.7, 0.5, 0.2), b: 0.1))),
                Plane(point: (0, 0, -4), normal: (0.3, 0, 1), material: Diffuse(albedo:
                    Noise(a: 0.1, b: 0.9, mapping: World(scale: 0.7)))),
                Sphere(center: (0.2, 0.7, 0), radius: 0.7, material: Diffuse(albedo: 0.6)),
            ]"#,
        ),
        (
            "transforms",
            r#"objects: [
                Plane(normal: (0.2, 1, 0.1), material: Diffuse(albedo: Gradient(a: 0.1, b: 0.9, axis: X,
                    mapping: Object(scale: 0.2))),
                    transform: [Rotate(axis: (1, 2, 0.5), degrees: 8), Scale((0.5, 2, -1.5)), Translate((0, -0.3, 0))]),
                Plane(point: (0, 1, -3), normal: (0, 0, 1), material: Diffuse(albedo:
                    Lines(a: 0.1, b: (0.2, 0.6, 0.9), width: 0.3, along: U)),
                    placements: [[], [Rotate(axis: (0, 1, 0), degrees: 70), Translate((1, 0, 0))]]),
                Sphere(center: (0.2, 0.7, 0), radius: 0.7, material: Mirror(reflectance: 0.9)),
            ]"#,
        ),
        (
            "mirror",
            r#"objects: [
                Plane(material: Diffuse(albedo: Checkerboard(a: 0.7, b: 0.2))),
                Plane(point: (-2, 0, 0), normal: (1, 0, 0.4), material: Mirror(reflectance: (0.9, 0.8, 0.7))),
                Box(center: (0.3, 0.5, 0), size: 1, material: Diffuse(albedo: (0.3, 0.5, 0.8))),
            ]"#,
        ),
        (
            "gloss",
            r#"objects: [
                Plane(material: BlinnPhong(albedo: 0.5, exponent: 200, specular: 0.3, energy_conserving: true)),
                Sphere(center: (0.2, 0.7, 0), radius: 0.7, material: Diffuse(albedo: (0.9, 0.3, 0.2))),
                Capsule(from: (1.4, 0.4, 0.4), to: (1.9, 0.4, -0.6), radius: 0.4, material: Diffuse(albedo: 0.8)),
            ]"#,
        ),
        (
            "the eye under a plane that lets light through",
            r#"objects: [
                Plane(point: (0, 4.5, 0), material: Transparent(ior: 1.2, transmittance: (0.9, 0.95, 1))),
                Plane(point: (0, -0.5, 0), material: Diffuse(albedo: (0.7, 0.6, 0.5))),
                Sphere(center: (0.2, 0.7, 0), radius: 0.7, material: Diffuse(albedo: 0.6)),
            ]"#,
        ),
    ];
    for (name, objects) in texts {
        let samples =
            Samples { reference: if name.contains("through") || name == "mirror" { 4096 } else { 256 }, ..samples };
        let desc = written(&format!(
            r#"Scene(
                image: Image(width: 32, height: 32), effects: Effects(antialiasing: Box), background: (0.1, 0.13, 0.2),
                camera: Camera(position: (0.5, 2.2, 6), look_at: (0, 0.9, 0), fov: 42), render: Render(max_bounces: 5),
                lights: [SphereLight(center: (-1, 3, 3), radius: 0.7, radiance: (14, 13, 12))], {objects})"#
        ));
        assert_same_picture(&format!("planes, {name}"), &desc, samples);
    }
}

/// A large rectangle in place of a plane: the same samples, but for the few that fall differently by rounding.
#[test]
fn it_is_a_rectangle_that_is_large_enough() {
    let floor = |endless: bool, material: Material| match endless {
        true => plane([0.0; 3], UP, material, vec![]),
        false => Object::Rectangle(Box::new(Rectangle {
            center: [0.0; 3].into(),
            normal: UP.into(),
            size: PerAxis([4096.0; 2]).into(),
            material: of(material),
            transform: Vec::new(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        })),
    };
    for (name, material) in [("matt", diffuse([0.7, 0.5, 0.3])), ("glossy", blinn_phong([0.4; 3], 80.0, 0.3))] {
        let picture = |endless: bool| {
            let things = vec![
                floor(endless, material.clone()),
                sphere([0.0, 0.8, 0.0], 0.8, glass(1.5)),
                sphere([1.4, 0.5, 0.6], 0.5, mirror([0.9; 3])),
            ];
            let desc = scene(32, vec![light([-2.0, 4.0, 2.0], 0.6, [30.0; 3])], things)
                .camera([0.5, 1.2, 5.0], [0.0, 0.1, 0.0], 60.0)
                .bounces(5);
            film(&compiled(&desc), 32, 3)
        };
        let [ours, theirs] = [true, false].map(picture);
        let (mut off, mut all) = (0.0, 0.0);
        for (x, y) in (12..32).flat_map(|y| (0..32).map(move |x| (x, y))) {
            let (a, b) = (ours.radiance(x, y), theirs.radiance(x, y));
            off += (0..3).map(|c| a[c] - b[c]).sum::<f64>();
            all += b.iter().sum::<f64>();
        }
        println!("{name}: off by {off} of {all}");
        assert!(all > 0.0 && off.abs() < 0.02 * all, "{name}: {off} of {all}");
    }
}

/// A mirror without an end shows a lamp where its image is: the receiver has the light of both.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn a_mirror_is_a_lamp_behind_it() {
    let tilt = DQuat::from_rotation_z(-0.3);
    let (normal, lamp) = (tilt * DVec3::X, DVec3::new(0.2, 1.1, 0.3));
    let point = DVec3::new(-1.5, 0.0, 0.0);
    let image = lamp - 2.0 * normal * normal.dot(lamp - point);
    let receiver = rectangle(0.05, diffuse([0.5; 3]), vec![]);
    let seen = |lamps: &[DVec3], mirrored: bool| {
        let lights = lamps.iter().map(|at| light(at.to_array(), 0.3, [10.0; 3])).collect();
        let mut objects = vec![receiver.clone()];
        if mirrored {
            objects.push(plane(
                (point + tilt * DVec3::Y * 40.0).to_array(),
                normal.to_array(),
                mirror([1.0; 3]),
                vec![],
            ));
        }
        let desc = scene(8, lights, objects).camera([0.0, 0.3, 0.01], [0.0; 3], 1.0).bounces(2);
        let scene = compiled(&desc);
        let means: Vec<f64> = (0..8).map(|seed| mean(&film(&scene, 512, seed))).collect();
        Estimate::of(&means)
    };
    let (ours, theirs) = (seen(&[lamp], true), seen(&[lamp, image], false));
    let error = ours.error().hypot(theirs.error());
    println!("{} +- {} and {} +- {}", ours.mean, ours.error(), theirs.mean, theirs.error());
    assert!(error < 0.01 * theirs.mean, "too noisy to tell: {error}");
    assert!((ours.mean - theirs.mean).abs() < 5.0 * error, "{} is not {}", ours.mean, theirs.mean);
}

/// Things on both sides of a plane that is seen from its edge, or nearly: who shares what must not share through it.
/// And a mirror that photons go over.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn sharing_and_guiding_change_nothing() {
    let scenes = [
        ("edge on", 0.0, "Diffuse(albedo: 0.6)"),
        ("from above", 0.4, "Diffuse(albedo: (0.8, 0.4, 0.3))"),
        ("mirror", 0.4, "Mirror(reflectance: 0.95)"),
    ];
    for (name, height, material) in scenes {
        let desc = written(&format!(
            r#"Scene(
                image: Image(width: 32, height: 32), effects: Effects(antialiasing: Box),
                render: Render(max_bounces: 4),
                camera: Camera(position: (0.3, {height}, 5), look_at: (0, 0, 0), fov: 40),
                lights: [SphereLight(center: (-2, 2.5, 2), radius: 0.6, radiance: (9, 5, 2)),
                         SphereLight(center: (2, -2.5, 2), radius: 0.6, radiance: (2, 5, 9))],
                objects: [Plane(point: (9, 0, 3), material: {material}),
                    Sphere(center: (-0.8, 0.2, 0), radius: 0.7, material: Diffuse(albedo: 0.8)),
                    Box(center: (0.8, -0.1, 0), size: (1, 1.4, 1), material: Diffuse(albedo: 0.7),
                        transform: [Rotate(axis: (0, 1, 0), degrees: 30)]),
                    Cylinder(from: (0, 0, 1), to: (0, 0.4, 1), radius: 0.2)])"#
        ));
        assert_sharing_is_unbiased(&format!("planes, {name}"), &desc, 6);
        if name == "mirror" {
            assert_guiding_is_unbiased(&format!("planes, {name}"), &desc, 256, 6);
        }
    }
}

/// What lies in a plane is seen there where it is of the same kind, and does not speckle: a rug, a lid flush with it,
/// boxes and glass that stand on it.
#[test]
fn what_lies_in_it_does_not_speckle() {
    let attitudes = [
        Attitude { axis: DVec3::X, degrees: 0.0, place: DVec3::ZERO },
        Attitude { axis: DVec3::new(0.48, 0.6, 0.64), degrees: 47.0, place: DVec3::new(1.3, -2.7, 3.1) },
    ];
    let cube = |material: Material, steps: Vec<Transform>| {
        Object::Box(Box::new(RectBox {
            center: [0.0, 0.6, 0.0].into(),
            size: PerAxis([1.2; 3]).into(),
            rounding: 0.0.into(),
            material: of(material),
            transform: steps.into_iter().map(Spanned::from).collect(),
            placements: Placements::One,
            camera_visible: true,
            name: Name::default(),
        }))
    };
    let albedo = [1.0, 0.5, 0.25];
    for attitude in attitudes {
        let steps = attitude.steps(25.0, [0.1, 0.0, 0.0]);
        let things: [(&str, Object, [f64; 3]); 6] = [
            ("rug", rectangle(3.0, diffuse(BLUE), steps.clone()), BLUE),
            ("lid", flat_sided("below", diffuse(BLUE), steps.clone()), BLUE),
            ("disk", flat_sided("disk", diffuse(BLUE), steps.clone()), BLUE),
            ("glass", cube(glass(1.0), steps.clone()), albedo),
            ("tumbler", flat_sided("above", glass(1.0), steps.clone()), albedo),
            ("pane", rectangle(3.0, glass(1.0), steps), albedo),
        ];
        for (name, thing, expected) in things {
            for (view, eye, fov) in [
                ("near", DVec3::new(1.0, 3.0, 2.5), 20.0),
                ("grazing", DVec3::new(0.0, 0.5, 9.0), 12.0),
                ("far", DVec3::new(300.0, 400.0, 250.0), 0.5),
            ] {
                let objects = vec![thing.clone(), lying(&attitude, diffuse(albedo))];
                let [from, to] = [eye, DVec3::ZERO].map(|p| attitude.point(p).to_array());
                let mut desc = scene(SIZE, vec![], objects)
                    .background([1.0; 3])
                    .camera(from, to, fov)
                    .bounces(12)
                    .filter(PixelFilter::None);
                desc.camera.up = (attitude.point(DVec3::Y) - attitude.place).to_array().into();
                let film = film(&compiled(&desc), 4, 5);
                let mut counts = [0; 2];
                for (k, p) in (0u32..).zip(points(eye, DVec3::ZERO, DVec3::Y, fov)) {
                    let beyond = (p - eye).dot(-eye) < 0.0;
                    let seen = film.radiance(k % SIZE, k / SIZE);
                    let is = |colour: [f64; 3]| (0..3).all(|c| (seen[c] - colour[c]).abs() < 1e-4);
                    assert!(is(albedo) || is(expected) || beyond, "{name}, {view}, pixel {k}: {seen:?}");
                    counts[usize::from(is(expected))] += 1;
                    let q = DQuat::from_rotation_y(-25f64.to_radians()) * (p - DVec3::new(0.1, 0.0, 0.0));
                    // Well within and well beside the rug.
                    let beside = q.x.abs().max(q.z.abs()) - 1.5;
                    if name == "rug" && beside.abs() > 0.05 && !beyond {
                        assert_eq!(is(BLUE), beside < 0.0, "{view}, pixel {k}: {p}");
                    }
                }
                assert!(counts[1] > 8, "{name}, {view}: {counts:?}");
            }
        }
    }
}

/// A lamp in the plane of the ceiling lights the floor as one without a ceiling.
#[test]
fn a_lamp_let_into_it_shines() {
    let emissive = Material::Emissive(Box::new(Emissive {
        amount: Amount::Radiance([3.0; 3]).into(),
        color: [1.0; 3].into(),
        two_sided: false,
        group: LightGroup::default(),
    }));
    let attitude = Attitude { axis: DVec3::new(0.6, 0.0, 0.8), degrees: 33.0, place: DVec3::new(0.1, 0.2, 0.3) };
    let up = [0.0, 2.0, 0.0];
    let mut steps = attitude.steps(25.0, up);
    steps.insert(0, Transform::Rotate { axis: [1.0, 0.0, 0.0], degrees: 180.0, about: Some(Box::new([0.0; 3])) });
    let lamp = rectangle(1.3, emissive, steps);
    let ceiling = plane([0.0; 3], UP, diffuse([0.5; 3]), attitude.steps(0.0, up));
    let floor = rectangle(60.0, diffuse([0.5; 3]), attitude.steps(10.0, [0.0; 3]));
    let seen = |objects: Vec<Object>, eye: DVec3, look_at: DVec3| {
        let [eye, look_at] = [eye, look_at].map(|p| attitude.point(p).to_array());
        let film = film(&compiled(&scene(SIZE, vec![], objects).camera(eye, look_at, 50.0).bounces(0)), 16, 1);
        (0..SIZE * SIZE).map(|k| film.radiance(k % SIZE, k / SIZE)).collect::<Vec<_>>()
    };
    let (eye, below) = (DVec3::new(1.0, 1.5, 2.0), DVec3::new(0.0, 0.0, -0.4));
    let alone = seen(vec![lamp.clone(), floor.clone()], eye, below);
    let with = seen(vec![ceiling.clone(), floor.clone(), lamp.clone()], eye, below);
    for (k, (a, b)) in alone.iter().zip(&with).enumerate() {
        // The ceiling is lit from along itself, which is nothing but for rounding.
        assert!((a[0] - b[0]).abs() <= 1e-4 * a[0] + 1e-12, "pixel {k}: {b:?}, not {a:?}");
    }
    assert!(alone.iter().filter(|c| c[0] > 0.0).count() > 900);
    let whole = seen(vec![ceiling, floor, lamp], DVec3::new(0.05, 1.4, 0.02), DVec3::new(0.0, 2.0, 0.0));
    assert!(whole.iter().all(|c| (c[0] - 3.0).abs() < 1e-4), "the lamp is not whole");
}

/// Lamps of every kind of shape shine the same wherever among the objects a plane and a solid stand.
#[test]
fn the_order_of_planes_lamps_and_solids_does_not_matter() {
    let floor = "Plane(material: Diffuse(albedo: 0.5))";
    let lamp = "Disk(center: (0, 2, 0), radius: 0.7, normal: (0.1, -1, 0), material: Emissive(radiance: 3))";
    let solid = "Difference(objects: [Box(center: (1, 0.5, 0)), Sphere(center: (1, 1, 0), radius: 0.4)])";
    let seen = |objects: [&str; 3]| {
        let desc = written(&format!(
            "Scene(camera: Camera(position: (0, 1.5, 5), look_at: (0, 0.5, 0), fov: 40), image: Image(width: 24, \
             height: 24), render: Render(max_bounces: 2), objects: [{}])",
            objects.join(", ")
        ));
        let film = film(&compiled(&desc), 16, 1);
        (0..24 * 24).map(|k| film.radiance(k % 24, k / 24)).collect::<Vec<_>>()
    };
    let expected = seen([lamp, solid, floor]);
    assert!(expected.iter().filter(|c| c[0] > 0.001).count() > 200, "it is dark");
    for objects in [[lamp, floor, solid], [floor, lamp, solid]] {
        assert!(seen(objects) == expected, "{objects:?}");
    }
}

/// What cannot be is told.
#[test]
fn faults_of_planes() {
    let told = |object: Object| match compile(&scene(8, vec![], vec![object]).background([1.0; 3])) {
        Err(error) => error.diagnostics.iter().map(|d| format!("{}: {}", d.code, d.message)).collect::<Vec<_>>(),
        Ok(scene) => scene.warnings.iter().map(|d| format!("{}: {}", d.code, d.message)).collect(),
    };
    let lamp = Material::Emissive(Box::new(Emissive {
        amount: Amount::Radiance([1.0; 3]).into(),
        color: [1.0; 3].into(),
        two_sided: false,
        group: LightGroup::default(),
    }));
    assert_eq!(told(plane([0.0; 3], UP, lamp, vec![])), ["E0544: a plane cannot shine"]);
    assert_eq!(told(plane([0.0; 3], UP, glass(1.5), vec![])), ["W0310: glass of an open plane has no inside"]);
    let drop = Transform::DropTo { y: 1.0 };
    let fit = Transform::FitTo { extent: Extent::Width, length: 2.0, about: None };
    let centre = Transform::CenterTo { point: [0.0; 3] };
    let matt = || diffuse([0.5; 3]);
    assert_eq!(told(plane([0.0; 3], UP, matt(), vec![drop.clone()])), ["E0211: a plane has no lowest point"]);
    let centred = "E0211: a plane has no middle that could be centred";
    assert_eq!(told(plane([0.0; 3], UP, matt(), vec![centre])), [centred]);
    let fitted = "E0211: a plane has no extent that could be fitted";
    assert_eq!(told(plane([0.0; 3], UP, matt(), vec![fit.clone()])), [fitted]);
    let mut copied = plane([0.0; 3], UP, matt(), vec![]);
    *copied.placements_mut() = [vec![], vec![fit.into()]].into_iter().collect();
    assert_eq!(told(copied), [fitted]);
    let flat = Transform::Scale { factor: [1.0, 0.0, 1.0], about: None };
    let flattened = "E0540: the transforms flatten the plane to nothing";
    assert_eq!(told(plane([0.0; 3], UP, matt(), vec![flat])), [flattened]);
    let mut twice = plane([0.0; 3], UP, matt(), vec![]);
    let copies = [vec![], vec![Transform::Translate([3.0, 0.0, 1.0]).into()]];
    *twice.placements_mut() = copies.into_iter().collect();
    assert_eq!(told(twice), ["W0316: this shape lies in one place with another: one of the two is seen"]);
}
