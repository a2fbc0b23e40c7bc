//! Pictures of all directions as background: where they lie, what they light, and how they are read.

use crate::support::compare::{Samples, assert_same_picture, assert_sharing_is_unbiased};
use crate::support::describe::*;
use crate::support::meshes::{icosphere, write};
use crate::support::skies::{sky, sunny};
use crate::support::{compiled, film};
use image::ImageFormat;
use scene_format::SceneDesc;
use scene_format::codes;
use scene_format::desc::{Background, Environment, LightGroup, PixelFilter, Shading, Vec3};
use std::io::Cursor;
use std::path::PathBuf;

/// Scenes that are compared here, for the strictness of the tests.
const SHARED: usize = 2;

fn environment(file: PathBuf) -> Environment {
    Environment {
        file: std::sync::Arc::<std::path::Path>::from(file).into(),
        scale: [1.0; 3],
        rotation: 0.0,
        up: [0.0, 1.0, 0.0].into(),
        camera_visible: true,
        group: LightGroup::default(),
    }
}

trait Under {
    fn under(self, environment: Environment) -> Self;
}

impl Under for SceneDesc {
    fn under(self, environment: Environment) -> Self {
        SceneDesc { background: Background::Environment(Box::new(environment)), ..self }
    }
}

/// Each direction shows its texel: the picture's middle at -z, right of it +x, the top row at `up`, turned about it.
#[test]
fn directions_see_their_texels() {
    // Eight columns of 45 degrees, four rows; each texel has a colour of its own. Powers of two are exact in HDR files.
    let color = |i: u32, j: u32| [0.125 * i as f32 + 0.125, 0.25 * j as f32 + 0.25, 0.5];
    let file = sky("directions.exr", [8, 4], ImageFormat::OpenExr, color);
    let turned = Environment { rotation: 90.0, ..environment(file.clone()) };
    let lying = Environment { up: [0.0, 0.0, 1.0].into(), ..environment(file.clone()) };
    let tiny = || vec![sphere([1e3, 1e3, 1e3], 1e-3, diffuse([0.0; 3]))];
    // Direction, and column and row of a texel's middle there: from the axes by halves of texels.
    let middle = |i: f64, j: f64| -> Vec3 {
        let (phi, theta) = ((i + 0.5) / 8.0 * std::f64::consts::TAU, (j + 0.5) / 4.0 * std::f64::consts::PI);
        // Column 4 begins at -z, and columns run to +x.
        [-theta.sin() * phi.sin(), theta.cos(), theta.sin() * phi.cos()]
    };
    let to = |d: Vec3, name: &str| match name {
        "as it is" => d,
        // Counter-clockwise seen from +y by 90 degrees: -z comes to -x.
        "turned" => [d[2], d[1], -d[0]],
        // +y comes to +z by the least turn, about +x: -z comes to +y.
        _ => [d[0], -d[2], d[1]],
    };
    for (name, sky) in [("as it is", environment(file)), ("turned", turned), ("lying", lying)] {
        for (i, j) in (0..4).flat_map(|j| (0..8).map(move |i| (i, j))) {
            let d = to(middle(f64::from(i), f64::from(j)), name);
            let up = if d[1].abs() > 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
            let mut desc = scene(1, vec![], tiny()).camera([0.0; 3], d, 0.01).filter(PixelFilter::None);
            desc.camera.up = up.into();
            let seen = film(&compiled(&desc.under(sky.clone())), 1, 1).radiance(0, 0);
            let expected = color(i, j).map(f64::from);
            assert!((0..3).all(|c| (seen[c] - expected[c]).abs() < 1e-4), "{name} {i} {j}: {seen:?}, not {expected:?}");
        }
    }
}

/// The same colour everywhere is the background of that colour, for all materials.
#[test]
fn a_picture_of_one_colour_is_a_background_of_that_colour() {
    let file = sky("one.hdr", [4, 2], ImageFormat::Hdr, |_, _| [1.0, 0.5, 0.25]);
    let objects = || {
        vec![
            sphere([0.0, -101.0, 0.0], 100.0, diffuse([0.7, 0.6, 0.5])),
            sphere([-1.2, -0.3, 0.0], 0.7, conserving([0.7, 0.5, 0.3], 60.0, 0.5)),
            sphere([0.3, -0.4, 0.9], 0.6, glass(1.5)),
            sphere([1.4, -0.2, -0.2], 0.8, mirror([0.9, 0.8, 0.7])),
        ]
    };
    let desc = || scene(24, vec![], objects()).camera([0.0, 1.0, 5.0], [0.0, -0.2, 0.0], 40.0).bounces(4);
    let scale = [1.0, 2.0, 4.0];
    let samples = Samples { engine: 512, reference: 512 };
    assert_same_picture("under one colour", &desc().under(Environment { scale, ..environment(file.clone()) }), samples);
    let mean = |desc: &SceneDesc| {
        let picture = film(&compiled(desc), 1024, 3);
        let pixels = (0..24 * 24).map(|k| (k % 24, k / 24));
        let sum: f64 = pixels.clone().map(|(x, y)| picture.radiance(x, y)[1]).sum();
        let variance: f64 = pixels.map(|(x, y)| picture.variance(x, y)).sum();
        (sum / 576.0, variance.sqrt() / 576.0)
    };
    let (picture, error) = mean(&desc().under(Environment { scale, ..environment(file) }));
    let (color, other) = mean(&desc().background([1.0; 3]));
    // Two means of independent samples: 4.5 standard errors are left by chance once in 150,000 runs.
    let allowed = 4.5 * error.hypot(other) + 1e-5;
    assert!((picture - color).abs() < allowed, "{picture}, not {color}: {allowed}");
}

/// A sun of two texels over all materials, alone and beside a lamp, turned, unseen by the camera, seen through glass.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn skies_as_the_reference_sees_them() {
    let file = sunny();
    let ball = icosphere(2).obj("ball-under-a-sky");
    let objects = || {
        vec![
            sphere([0.0, -101.0, 0.0], 100.0, diffuse([0.7, 0.6, 0.5])),
            sphere([-1.3, -0.3, 0.0], 0.7, conserving([0.7, 0.5, 0.3], 200.0, 0.5)),
            mesh(&ball, diffuse([0.4, 0.5, 0.6]), Shading::Smooth, vec![scale(0.5)]),
            sphere([1.4, -0.2, -0.2], 0.8, mirror([0.9, 0.8, 0.7])),
        ]
    };
    let view = |lights| scene(24, lights, objects()).camera([0.0, 1.0, 5.0], [0.0, -0.2, 0.0], 40.0).bounces(2);
    let samples = Samples { engine: 1024, reference: 4096 };
    assert_same_picture("under a sun", &view(vec![]).under(environment(file.clone())), samples);
    let turned = Environment {
        rotation: 130.0,
        up: [0.2, 1.0, 0.4].into(),
        camera_visible: false,
        scale: [0.5, 0.6, 0.7],
        ..environment(file)
    };
    let lamp = light([-2.0, 2.0, 2.0], 0.4, [8.0, 6.0, 4.0]);
    assert_same_picture("under a turned sun and a lamp", &view(vec![lamp]).under(turned), samples);
}

/// What pixels share under a sky with a sun is right on average, indoors too.
#[test]
fn sharing_under_a_sky() {
    let sky = || environment(sunny());
    let open = scene(
        48,
        vec![],
        vec![
            sphere([0.0, -101.0, 0.0], 100.0, diffuse([0.7, 0.6, 0.5])),
            sphere([0.0, -0.3, 0.0], 0.7, diffuse([0.4, 0.5, 0.6])),
        ],
    );
    assert_sharing_is_unbiased("open under a sky", &open.camera([0.0, 1.0, 5.0], [0.0; 3], 40.0).under(sky()), SHARED);
    let mut room = room();
    room.remove(0);
    let desc = scene(48, vec![room_light()], room).camera([0.0, 0.0, 3.5], [0.0; 3], 50.0);
    assert_sharing_is_unbiased("a room that is open under a sky", &desc.under(sky()), SHARED);
}

/// HDR, EXR and PNG give the same light; a black picture gives none.
#[test]
fn formats_are_alike() {
    let color = |i: u32, j: u32| if (i + j).is_multiple_of(2) { [1.0, 1.0, 1.0] } else { [0.0, 0.0, 1.0] };
    let png = |color: &dyn Fn(u32, u32) -> [f32; 3]| {
        let bytes = (0..8).flat_map(|k| color(k % 4, k / 4)).map(|x| (255.0 * x) as u8).collect();
        let mut file = Cursor::new(Vec::new());
        let picture = image::RgbImage::from_raw(4, 2, bytes).expect("eight pixels");
        picture.write_to(&mut file, ImageFormat::Png).expect("a picture in memory");
        write("format.png", file.get_ref())
    };
    let files = [
        sky("format.hdr", [4, 2], ImageFormat::Hdr, color),
        sky("format.exr", [4, 2], ImageFormat::OpenExr, color),
        png(&color),
    ];
    let desc = || {
        let ball = sphere([0.0; 3], 1.0, diffuse([0.5; 3]));
        scene(16, vec![], vec![ball]).camera([0.0, 0.0, 4.0], [0.0; 3], 40.0)
    };
    let pictures = files.map(|file| {
        let film = film(&compiled(&desc().under(environment(file))), 8, 1);
        (0..256).map(|k| film.radiance(k % 16, k / 16)).collect::<Vec<_>>()
    });
    assert_eq!(pictures[0], pictures[1]);
    assert_eq!(pictures[0], pictures[2]);
    let black = sky("black.exr", [4, 2], ImageFormat::OpenExr, |_, _| [0.0; 3]);
    let film = film(&compiled(&desc().under(environment(black))), 4, 1);
    assert!((0..256).all(|k| film.radiance(k % 16, k / 16) == [0.0; 3]));
}

/// What is wrong with a picture is told at its name; what is odd, too.
#[test]
fn faults_of_pictures_are_told() {
    let scene =
        |file: PathBuf| scene(8, vec![], vec![sphere([0.0; 3], 1.0, diffuse([0.5; 3]))]).under(environment(file));
    let whole = std::fs::read(sunny()).expect("a file");
    let cut = write("cut.exr", &whole[..whole.len() / 2]);
    let text = write("text.hdr", b"no picture");
    let header = write("header.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 30000 +X 30000\n");
    for (file, code) in [
        (cut, codes::BROKEN_ENVIRONMENT),
        (text, codes::BROKEN_ENVIRONMENT),
        (header, codes::BROKEN_ENVIRONMENT),
        (PathBuf::from("none.exr"), codes::FILE_NOT_FOUND),
    ] {
        let Err(error) = tracer_core::compile(&scene(file.clone())) else { panic!("{}", file.display()) };
        let found: Vec<_> = error.diagnostics.iter().map(|fault| fault.code).collect();
        assert_eq!(found, [code], "{}", file.display());
    }
    let odd =
        sky("odd.exr", [3, 3], ImageFormat::OpenExr, |i, _| [f32::NAN, -1.0, [f32::INFINITY, 1.0, 2.0][i as usize]]);
    let compiled = tracer_core::compile(&scene(odd)).expect("odd, not wrong");
    let found: Vec<_> = compiled.warnings.iter().map(|warning| warning.code).collect();
    assert_eq!(found, [codes::ENVIRONMENT_SHAPE, codes::ENVIRONMENT_PIXELS]);
    assert_eq!(compiled.environment().and_then(|sky| sky.texel(0, 0)).map(|texel| texel[0]), Some(0.0));
}
