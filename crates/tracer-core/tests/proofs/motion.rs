//! Motion blur: by closed forms, as the mean of pictures that stand still, against the reference; and the same bytes
//! however it is rendered.

use crate::same_bytes::bits;
use crate::support::compare::{Samples, assert_same_picture};
use crate::support::{compiled, film};
use scene_format::{LoadError, SceneDesc, Syntax, load_str};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use tracer_core::{
    Crop, Film, Layer, LayerSet, Level, Observer, Part, Progress, RenderOptions, Scene, Unobserved, quarter_of, render,
    resume,
};

fn read(text: &str) -> SceneDesc {
    match load_str("motion", text, Syntax::Ron, Path::new(""), &[]) {
        Ok(loaded) => loaded.scene,
        Err(LoadError::Invalid { diagnostics, .. }) => panic!("{:?}", diagnostics[0].message),
        Err(error) => panic!("{error}"),
    }
}

/// A square lamp, seen by parallel rays, 8 pixels to a unit; time goes from 0 to 1 while the shutter is open.
fn square(center: &str, camera: &str) -> SceneDesc {
    read(&format!(
        r#"Scene(
            animation: Animation(fps: 1), image: Image(width: 64, height: 16), render: Render(max_bounces: 0),
            camera: Camera(position: ({camera}, 0, 5), look_at: ({camera}, 0, 0), shutter: 1,
                projection: Orthographic(height: 2)),
            objects: [Rectangle(center: ({center}, 0, 0), normal: (0, 0, 1), size: (2, 4),
                material: Emissive(radiance: 3))])"#
    ))
}

/// Where a square is for a part of the time, it is seen for that part: a trapezium.
#[test]
fn a_moving_square_covers_a_trapezium() {
    let film = film(&compiled(&square("\"=4*time - 2\"", "0")), 256, 3);
    for x in 0..64 {
        let at = (f64::from(x) + 0.5) / 8.0 - 4.0;
        let covered = ((3.0 - at.abs()) / 4.0).clamp(0.0, 0.5);
        for y in 0..16 {
            let found = film.radiance(x, y)[0];
            // A pixel moves across in a thirty-second of the time.
            assert!((found - 3.0 * covered).abs() < 3.0 / 32.0, "{x} {y}: {found}, not {}", 3.0 * covered);
        }
    }
    let sum: f64 = (0..64).map(|x| film.radiance(x, 8)[0]).sum();
    assert!((sum - 3.0 * 16.0).abs() < 0.15, "as much light as from a square that stands still: {sum}");
}

/// It does not matter who moves.
#[test]
fn a_moving_camera_is_a_moving_world() {
    let [world, camera] = [square("\"=2*time - 1\"", "0"), square("0", "\"=1 - 2*time\"")];
    let [world, camera] = [world, camera].map(|desc| film(&compiled(&desc), 32, 5));
    let mut most: f64 = 0.0;
    for (x, y) in (0..16).flat_map(|y| (0..64).map(move |x| (x, y))) {
        let [a, b] = [&world, &camera].map(|film| film.radiance(x, y)[0]);
        most = most.max(a);
        // A sample at the very edge may fall to the other side.
        assert!((a - b).abs() < 3.0 / 31.0, "{x} {y}: {a} {b}");
    }
    assert!(most > 2.9);
}

/// Everything moves: the camera, a lamp, glass that gathers light, a mesh's copies, a pattern.
fn moving(more: &str) -> SceneDesc {
    moving_beside(more, "")
}

/// With further objects.
fn moving_beside(more: &str, objects: &str) -> SceneDesc {
    read(&format!(
        r#"Scene(
            animation: Animation(fps: 1), image: Image(width: 37, height: 29), {more}
            camera: Camera(position: ("=0.4*time", 1.6, 6), look_at: (0, 0.7, 0), fov: 40, shutter: 0.8),
            lights: [SphereLight(center: ("=2 - time", 4, 2), radius: 0.5, radiance: 30)],
            objects: [
                Plane(material: Diffuse(albedo: Checkerboard(a: 0.7, b: 0.3))),
                Sphere(center: (-1, "=0.8 + 0.4*time", 0), radius: 0.8, material: Transparent(ior: 1.5)),
                Box(center: (1.2, 0.5, 0), size: 0.9, transform: [Rotate(axis: (0, 1, 0), degrees: "=40*time")]),
                Mesh(points: [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
                    faces: [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
                    placements: [[Translate(("=time - 0.5", 0, 1.5))], [Translate((0.8, "=time", -1))]]),
                Sphere(center: (2.2, 1, -1), radius: 0.5, material: Mirror(reflectance: 0.9)), {objects}
            ])"#
    ))
}

/// At sixteen samples no ghosts are seen: over a column of pixels the moments are 64, and of a pixel sixteen that are
/// well spread.
///
/// An edge passes a pixel in a thirty-second of the time, and is in one or two of the sixteen parts that a pixel has
/// one sample of each in, which is there or not: a variance of 1/4 at most, 0.5/16 of the whole for an edge and for two
/// 0.044; rows are of quarters of their own, so that a column of sixteen has a fourth of it. Were all pixels to see the
/// same sixteen moments, a column would be as far off as a pixel.
#[test]
fn sixteen_samples_show_no_ghosts() {
    let (mut of_pixels, mut of_columns) = (0.0, 0.0);
    for seed in 0..8 {
        let film = film(&compiled(&square("\"=4*time - 2\"", "0")), 16, seed);
        for x in 0..64 {
            let at = (f64::from(x) + 0.5) / 8.0 - 4.0;
            let covered = ((3.0 - at.abs()) / 4.0).clamp(0.0, 0.5);
            let off: Vec<f64> = (0..16).map(|y| film.radiance(x, y)[0] / 3.0 - covered).collect();
            of_pixels += off.iter().map(|off| off * off).sum::<f64>() / 16.0;
            of_columns += (off.iter().sum::<f64>() / 16.0).powi(2);
        }
    }
    let [of_pixels, of_columns] = [of_pixels, of_columns].map(|sum| (sum / (8.0 * 64.0)).sqrt());
    assert!(of_pixels < 0.044 && of_columns < 0.044 / 4.0, "{of_pixels}, {of_columns}");
}

/// Each sample is one of a picture that stands still, of the scene as it is at its moment.
#[test]
fn the_picture_is_the_mean_of_pictures_that_stand_still() {
    let scene = compiled(&moving("render: Render(max_bounces: 4, caustics: None),"));
    let samples = 11;
    let moved = film(&scene, samples, 9);
    assert_eq!(scene.moments_of_sample(), 4);
    let still = |k: u32, quarter: u32| {
        let still = scene.at_sample(k, Some(quarter), 9).expect("it moves").expect("it is right");
        assert!(!still.moves());
        let crop = Crop::whole(scene.size);
        let part = Part { crop, first: k, end: k + 1, of_crop: crop, of_samples: samples };
        let options = RenderOptions { part: Some(part), seed: Some(9), ..RenderOptions::default() };
        render(&still, &options, &Unobserved)
    };
    let stills: Vec<[Film; 4]> =
        (0..samples).map(|k| std::array::from_fn(|quarter| still(k, quarter as u32))).collect();
    for (x, y) in (0..29).flat_map(|y| (0..37).map(move |x| (x, y))) {
        let of_sample =
            |k: u32| stills[k as usize][quarter_of(&scene, [x, y], k, 9).expect("they do") as usize].radiance(x, y)[1];
        let mean = (0..samples).map(of_sample).sum::<f64>() / f64::from(samples);
        let found = moved.radiance(x, y)[1];
        assert!((mean - found).abs() <= 1e-12 * found.max(1e-3), "{x} {y}: {found}, not {mean}");
    }
}

/// What moves where no light comes, in a closed box, changes nothing, to the last bit: samples, what pixels share,
/// guides, and light paths, of which each quarter brings a fourth.
#[test]
fn light_paths_of_quarters_are_all_of_them() {
    let room = |center: &str| {
        read(&format!(
            r#"Scene(
            animation: Animation(fps: 1), image: Image(width: 40, height: 32),
            camera: Camera(position: (0, 1, 2.8), look_at: (0, 0.8, 0), fov: 60, shutter: 1),
            lights: [SphereLight(center: (0.6, 2.4, 0.5), radius: 0.08, power: 60)],
            objects: [
                Box(center: (0, 1.5, 0), size: (6, 3, 6), material: Diffuse(albedo: 0.6)),
                Sphere(center: (0, 0.7, 0), radius: 0.5, material: Transparent(ior: 1.5)),
                Box(center: (-2, 0.5, -2), size: 0.9),
                Box(center: ({center}, 0.5, -2), size: 0.2),
            ])"#
        ))
    };
    let [still, moving] = [room("-2"), room("\"=0.3*time - 2\"")].map(|desc| compiled(&desc));
    assert_eq!((still.moments_of_sample(), moving.moments_of_sample()), (0, 4));
    let [still, moving] = [&still, &moving].map(|scene| render(scene, &options(2), &Unobserved));
    assert!(still.caustics && still.reuse && still.counters.photon_rays > 1000);
    assert!(bits(&still) == bits(&moving));
}

#[test]
fn engine_and_reference_agree() {
    let samples = Samples { engine: 32 * 8, reference: 256 };
    let mut desc = moving("render: Render(max_bounces: 3), background: 0.2,");
    (desc.image.width, desc.image.height) = (24.into(), 16.into());
    assert_same_picture("moving", &desc, samples);
}

const SAMPLES: u32 = 13;

fn options(threads: usize) -> RenderOptions {
    let levels = Level::available();
    let level = Some(levels[(threads + levels.len() - 1) % levels.len()]).filter(|level| *level != Level::PORTABLE);
    RenderOptions { samples: Some(SAMPLES), seed: Some(7), threads, level, ..RenderOptions::default() }
}

/// Ends a rendering after so many batches.
struct Ends(AtomicU64);

impl Observer for Ends {
    fn progress(&self, _: Progress) -> ControlFlow<()> {
        match self.0.fetch_sub(1, Ordering::Relaxed) {
            1 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        }
    }
}

/// With all techniques: glass gathers light, so photons guide rays.
#[test]
fn the_same_bytes_however_it_is_rendered() {
    assert_same_bytes(&compiled(&moving("render: Render(max_bounces: 4), background: 0.1,")), [1, 7, 20, 33]);
}

/// As many triangles as make all pixels of a sample index see one moment.
#[test]
fn the_same_bytes_of_many_triangles() {
    let many = "Repeat(count: 40, items: [Box(center: (\"=0.1*i - 2\", -1, 0), size: 0.05)]),";
    let scene = compiled(&moving_beside("render: Render(max_bounces: 4), background: 0.1,", many));
    assert_eq!(scene.moments_of_sample(), 1);
    assert_same_bytes(&scene, [1, 2, 5, 9]);
}

/// Ended after so many batches, too.
fn assert_same_bytes(scene: &Scene, ends: [u64; 4]) {
    let whole = render(scene, &options(1), &Unobserved);
    assert!(whole.caustics, "rays are aimed");
    let expected = bits(&whole);
    for threads in [2, 3] {
        let film = render(scene, &options(threads), &Unobserved);
        assert!(bits(&film) == expected, "{threads} threads");
        assert_eq!(film.counters, whole.counters);
    }
    let crop = Crop { x: 9, y: 5, width: 17, height: 13 };
    let cut = render(scene, &RenderOptions { crop: Some(crop), ..options(2) }, &Unobserved);
    for (x, y) in [(9, 5), (25, 17), (14, 11)] {
        assert_eq!(cut.radiance(x, y), whole.radiance(x, y));
    }
    // Ended anywhere and gone on with, and more samples asked for later.
    for end in ends {
        let film = render(scene, &options(2), &Ends(AtomicU64::new(end)));
        let film = resume(scene, &options(1), film, &Unobserved).expect("it fits");
        assert!(bits(&film) == expected, "ended after {end}");
        assert_eq!(film.counters, whole.counters, "ended after {end}");
    }
    let few = render(scene, &RenderOptions { samples: Some(6), ..options(1) }, &Unobserved);
    assert!(bits(&resume(scene, &options(1), few, &Unobserved).expect("it fits")) == expected, "more samples");
}

#[test]
fn parts_are_the_whole() {
    let scene = compiled(&moving("render: Render(max_bounces: 4), background: 0.1,"));
    let whole = render(&scene, &options(1), &Unobserved);
    let of_crop = Crop::whole(scene.size);
    // Some begin where a guide does, some do not.
    let ranges = [0..3, 3..4, 4..7, 7..SAMPLES];
    let files = ranges.map(|range| {
        let part = Part { crop: of_crop, first: range.start, end: range.end, of_crop, of_samples: SAMPLES };
        let film = render(&scene, &RenderOptions { part: Some(part), ..options(2) }, &Unobserved);
        let mut bytes = Vec::new();
        film.save(&mut bytes, &[]).expect("memory");
        bytes
    });
    let open = |file: &[u8]| tracer_core::SavedFilm::open(std::io::Cursor::new(file.to_vec()));
    let heads: Vec<_> = files.iter().map(|file| open(file).expect("a head").head().clone()).collect();
    let merged = Film::merge(&heads, |part| open(&files[part]), tracer_core::Gaps::Refused).expect("all are there");
    assert!(bits(&merged) == bits(&whole));
}

/// What is wrong at a moment that nobody looked at before ends the rendering, and is told.
#[test]
fn what_is_wrong_at_a_moment_is_told() {
    let desc = read(
        r#"Scene(animation: Animation(fps: 1), background: 1, image: Image(width: 8, height: 8),
            camera: Camera(shutter: 1), render: Render(samples: 64),
            objects: [Sphere(center: (0, 0, 0), radius: "=if(abs(time - 0.3) < 0.1, -1, 1)")])"#,
    );
    let film = render(&compiled(&desc), &RenderOptions::default(), &Unobserved);
    let faults = film.fault.as_ref().expect("a radius is negative");
    assert!(faults[0].message.contains("while the shutter is open"), "{}", faults[0].message);
    assert!(*film.samples().end() < 64);
}

/// A lamp that becomes a thousand times as bright is still in the film's window.
#[test]
fn the_unit_is_that_of_the_brightest_time() {
    let desc = read(
        r#"Scene(animation: Animation(fps: 1), image: Image(width: 8, height: 8), camera: Camera(shutter: 1),
            background: "=1000*time", objects: [Sphere(center: (0, 0, 50), radius: 1)])"#,
    );
    let scene: Scene = compiled(&desc);
    assert_eq!(scene.radiance_unit, 512.0);
    let film = film(&scene, 64, 1);
    let mean = film.radiance(3, 3)[0];
    assert!((mean - 500.0).abs() < 10.0, "{mean}");
}

/// The layer of motion: width, and both numbers of each pixel.
fn told(desc: &SceneDesc, samples: u32) -> (usize, Vec<[f64; 2]>) {
    let layers = Some(LayerSet::from_iter([Layer::Motion]));
    let options = RenderOptions { layers, samples: Some(samples), threads: 1, ..RenderOptions::default() };
    let film = render(&compiled(desc), &options, &Unobserved);
    let values = film.layer(Layer::Motion).expect("it is asked for").values;
    let pixels = values.as_chunks::<2>().0.iter().map(|v| v.map(f64::from)).collect();
    (desc.image.width.value as usize, pixels)
}

/// Things that move without turning, of every kind that a hit may be of: parallel rays, 8 pixels to a unit; a unit to
/// the right and half a unit up in a frame, and the camera a quarter down.
#[test]
fn motion_of_all_kinds_is_told_in_pixels_a_frame() {
    let move_it = "transform: [Translate((\"=time\", \"=time/2\", 0))]";
    for thing in [
        "Sphere(center: (\"=time\", \"=time/2\", 0), radius: 1)".to_owned(),
        format!("Sphere(center: (0, 0, 0), radius: 1, {})", move_it.replace('[', "[Scale((1, 0.5, 1)), ")),
        format!("Cylinder(from: (-1, 0, 0), to: (1, 0.5, 0), radius: 0.4, {move_it})"),
        format!("Torus(center: (0, 0, 0), axis: (0.2, 0.3, 1), radius: 0.8, tube_radius: 0.3, {move_it})"),
        format!("Box(center: (0, 0, 0), size: 1.5, {move_it})"),
        format!(
            "Difference(objects: [Box(size: 1.5), Sphere(center: (0.5, 0, 0.5), radius: 0.6, \
             transform: [Scale(1.1)])], {move_it})"
        ),
        "Difference(objects: [Box(center: (\"=time\", \"=time/2\", 0), size: 1.5), \
         Sphere(center: (\"=0.5 + time\", \"=time/2\", 0.5), radius: 0.6)])"
            .to_owned(),
        "Mesh(file: \"icosphere.obj\", placements: [[Translate((\"=time\", \"=time/2\", 0))], \
         [Translate((\"=2 + time\", \"=time/2\", -1))]])"
            .to_owned(),
        "Mesh(points: [(\"=time - 1\", \"=time/2\", 0), (\"=time + 1\", \"=time/2\", 0), \
         (\"=time\", \"=1 + time/2\", 0)], faces: [[0, 1, 2]])"
            .to_owned(),
        "Rectangle(center: (\"=time\", \"=time/2\", 0), normal: (0.3, 0, 1), size: 1.5, \
         material: Emissive(radiance: 1))"
            .to_owned(),
        "Plane(point: (\"=time\", \"=time/2\", 0), normal: (0, 1, 1))".to_owned(),
    ] {
        let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden/assets");
        let text = format!(
            r#"Scene(
            animation: Animation(fps: 1), image: Image(width: 48, height: 32), render: Render(max_bounces: 0),
            background: 1, camera: Camera(position: (0, "=-time/4", 5), look_at: (0, "=-time/4", 0), shutter: 0.25,
            projection: Orthographic(height: 4)), objects: [{thing}])"#
        );
        let desc = match load_str("motion", &text, Syntax::Ron, &assets, &[]) {
            Ok(loaded) => loaded.scene,
            Err(error) => panic!("{error}\n{text}"),
        };
        let (_, pixels) = told(&desc, 8);
        let moving: Vec<_> = pixels.iter().filter(|v| **v != [0.0; 2]).collect();
        assert!(moving.len() > 50, "{thing}: {} pixels move", moving.len());
        for v in moving {
            assert!((v[0] - 8.0).abs() < 2e-3 && (v[1] + 6.0).abs() < 2e-3, "{thing}: {v:?}");
        }
    }
}

/// Of what turns about the view axis by an angle w a frame a point at p moves by w x p; of what comes nearer by v, a
/// point at p (from the middle, in pixels) at the depth z by p v / z. A shutter of a hundredth tells it to a hundredth.
#[test]
fn motion_of_what_turns_and_of_what_comes_near() {
    let view = |camera: &str, thing: &str| {
        read(&format!(
            "Scene(animation: Animation(fps: 1), image: Image(width: 32, height: 32), background: 1, \
             effects: Effects(antialiasing: None), render: Render(max_bounces: 0), \
             camera: Camera(position: (0, 0, 5), look_at: (0, 0, 0), shutter: 0.01, {camera}), objects: [{thing}])"
        ))
    };
    let turning = "Rectangle(normal: (0, 0, 1), size: 9, \
                   transform: [Rotate(axis: (0, 0, 1), degrees: \"=90*time\")])";
    let coming = "Rectangle(center: (0, 0, \"=0.5*time\"), normal: (0, 0, 1), size: 9)";
    let by_hand = |what: &str, desc: &SceneDesc, expected: &dyn Fn([f64; 2]) -> [f64; 2]| {
        let (width, pixels) = told(desc, 8);
        for (k, found) in pixels.iter().enumerate() {
            let at = [(k % width) as f64 + 0.5 - 16.0, (k / width) as f64 + 0.5 - 16.0];
            let expected = expected(at);
            let off = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            assert!(off < 0.02 * (1.0 + expected[0].hypot(expected[1])), "{what} {at:?}: {found:?}, not {expected:?}");
        }
    };
    let w = std::f64::consts::FRAC_PI_2;
    // Counter-clockwise, y downwards.
    by_hand("turning", &view("projection: Orthographic(height: 4)", turning), &|[x, y]| [w * y, -w * x]);
    by_hand("coming", &view("fov: 40", coming), &|[x, y]| [0.1 * x, 0.1 * y]);
    // The same to the right half as to the left one.
    let stereo = view("fov: 40, stereo: Stereo(separation: 0.0001)", coming);
    let (width, pixels) = told(&stereo, 8);
    for (k, found) in pixels.iter().enumerate() {
        let at = [(k % width % 16) as f64 + 0.5 - 8.0, (k / width) as f64 + 0.5 - 16.0];
        assert!((found[0] - 0.1 * at[0]).abs() < 0.02 && (found[1] - 0.1 * at[1]).abs() < 0.04, "{at:?}: {found:?}");
    }
}

/// What passes behind the eye of a panorama moves a little to the other edge, and not through the whole picture; what
/// does not move, in a scene that does, has no motion, and what has no shutter none at all.
#[test]
fn motion_round_about_and_of_what_stands_still() {
    let view = |shutter: f64, thing: &str| {
        read(&format!(
            "Scene(animation: Animation(frames: 2, fps: 1), image: Image(width: 64, height: 32), background: 1, \
             render: Render(max_bounces: 0), camera: Camera(position: (0, 0, 0), look_at: (0, 0, -1), \
             shutter: {shutter}, projection: Panorama), objects: [{thing}])"
        ))
    };
    let behind = "Sphere(center: (\"=0.3 - 0.6*time\", 0, 3), radius: 1)";
    let still = "Sphere(center: (0, 0, -3), radius: 1)";
    let (width, pixels) = told(&view(1.0, &format!("{behind}, {still}")), 8);
    let moving: Vec<usize> = (0..pixels.len()).filter(|&k| pixels[k] != [0.0; 2]).collect();
    assert!(moving.iter().any(|k| k % width == 0) && moving.iter().any(|k| k % width == 63));
    assert!(moving.iter().all(|k| (k % width).abs_diff(32) > 20), "what stands still moves");
    // 0.6 at the distance of two is 0.3 radians at most, of 64 pixels for a turn; to the right, as seen from behind.
    assert!(moving.iter().all(|&k| (1.0..3.5).contains(&pixels[k][0])), "{:?}", pixels[moving[0]]);
    let (_, pixels) = told(&view(0.0, &format!("{behind}, {still}")), 8);
    assert!(pixels.iter().all(|v| *v == [0.0; 2]));
}

/// Things of all kinds beside each other: of each pixel's own point what its thing does with it.
/// Balls that a turn makes shapes while the shutter is open, copies of which some turn, balls that grow past what
/// orders them, a pendulum that passes the vertical, meshes behind spheres and shapes, solids. Points are told by the
/// layer of positions of a picture whose shutter is hardly open.
#[test]
fn motion_of_things_beside_each_other() {
    let many: String = (0..30)
        .map(|k| format!("Sphere(center: ({}, -1.6, 0.5), radius: {}),", -2.0 + 0.13 * f64::from(k), 0.05))
        .collect();
    let view = |objects: &str| {
        read(&format!(
            "Scene(animation: Animation(fps: 1), image: Image(width: 64, height: 48), background: 1, \
             effects: Effects(antialiasing: None), render: Render(max_bounces: 0), \
             camera: Camera(position: (0, 0, 6), look_at: (0, 0, 0), fov: 40, shutter: 0.01), \
             lights: [SphereLight(center: (0, 9, 9), radius: 1, radiance: 3)], objects: [{objects}])"
        ))
    };
    let told = |desc: &SceneDesc| {
        let layers = Some(LayerSet::from_iter([Layer::Motion, Layer::Position, Layer::ObjectId]));
        let options = RenderOptions { layers, samples: Some(1), threads: 1, ..RenderOptions::default() };
        let film = render(&compiled(desc), &options, &Unobserved);
        [Layer::Motion, Layer::Position, Layer::ObjectId]
            .map(|layer| film.layer(layer).expect("it is asked for").values)
    };
    // Pixels to a unit at the depth of one.
    let focal = 24.0 / 20.0f64.to_radians().tan();
    let shown = |p: [f64; 3]| [focal * p[0] / (6.0 - p[2]), -focal * p[1] / (6.0 - p[2])];
    let check = |what: &str, objects: &str, number: f32, least: usize, speed: &dyn Fn([f64; 3]) -> [f64; 3]| {
        let [motion, position, object] = told(&view(objects));
        let mut count = 0;
        for (k, _) in object.iter().enumerate().filter(|(_, of)| **of == number) {
            let p = [0, 1, 2].map(|c| f64::from(position[3 * k + c]));
            let v = speed(p);
            let step = 1e-4;
            let (from, to) = (shown(p), shown([0, 1, 2].map(|c| p[c] + step * v[c])));
            let expected = [0, 1].map(|c| (to[c] - from[c]) / step);
            let found = [0, 1].map(|c| f64::from(motion[2 * k + c]));
            let off = (found[0] - expected[0]).hypot(found[1] - expected[1]);
            // A hundredth of a frame bends ways by some hundredths.
            assert!(
                off < 0.03 * (1.0 + expected[0].hypot(expected[1])),
                "{what}, pixel {k} at {p:?}: {found:?}, not {expected:?}"
            );
            count += 1;
        }
        assert!(count >= least, "{what}: {count} pixels");
    };
    let (ball, still) =
        ("Sphere(center: (-1, 0, 0), radius: 0.8, transform: [TURN])", "Box(center: (1, 0, 0), size: 1)");
    let turn = "Rotate(axis: (0, 1, 0), degrees: \"=90*time\", about: (-1, 0, 0))";
    let w = std::f64::consts::FRAC_PI_2;
    let turning = format!("{}, {still}", ball.replace("TURN", turn));
    // About the vertical: w x (p - m).
    check("a turning ball", &turning, 1.0, 60, &|p| [w * p[2], 0.0, -w * (p[0] + 1.0)]);
    check("beside it", &turning, 2.0, 60, &|_| [0.0; 3]);
    let copies = format!(
        "Sphere(center: (0, 0, 0), radius: 0.7, placements: [[Translate((-1.2, 0, 0))], \
         [Rotate(axis: (0, 0, 1), degrees: \"=90*time\"), Translate((1.2, 0, 0))], \
         [Translate((0, \"=1.2 + time\", 0))]]), {many}"
    );
    check("copies", &copies, 1.0, 60, &|[x, y, _]| {
        let to = |at: [f64; 2]| (x - at[0]).hypot(y - at[1]);
        let [still, turning, climbing] = [[-1.2, 0.0], [1.2, 0.0], [0.0, 1.2]].map(to);
        match () {
            () if turning < still.min(climbing) => [-w * y, w * (x - 1.2), 0.0],
            () if climbing < still => [0.0, 1.0, 0.0],
            () => [0.0; 3],
        }
    });
    let growing = format!(
        "Sphere(center: (0, 0, 0), radius: \"=0.7 + time\"), \
         Sphere(center: (1.6, 0, 0), radius: \"=0.5 + time\"), {many}"
    );
    check("balls that grow", &growing, 1.0, 60, &|p| p.map(|x| x / 0.7));
    check("balls that grow", &growing, 2.0, 60, &|p| [(p[0] - 1.6) / 0.5, p[1] / 0.5, p[2] / 0.5]);
    let pendulum =
        format!("Cylinder(from: (0, 1.5, 0), to: (\"=0.005 - time\", -1.5, 0), radius: 0.3, caps: false), {many}");
    check("a pendulum", &pendulum, 1.0, 60, &|p| [-(1.5 - p[1]) / 3.0, -p[0] / 3.0, 0.0]);
    let meshes = format!(
        "{many} Cylinder(radius: 0.1, to: (0, 0.2, 0)), Box(center: (-1, 0, 0), size: 1, \
         transform: [Rotate(axis: (0, 0, 1), degrees: \"=90*time\", about: (-1, 0, 0))]), \
         Rectangle(center: (1, 0, \"=time\"), normal: (0, 0, 1), size: 1.2)"
    );
    check("a box among others", &meshes, 32.0, 60, &|p| [-w * p[1], w * (p[0] + 1.0), 0.0]);
    check("a rectangle among others", &meshes, 33.0, 60, &|_| [0.0, 0.0, 1.0]);
    let solids = format!(
        "{many} Union(objects: [Box(center: (-1, 0, 0), size: 0.5)]), \
         Difference(objects: [Box(size: 1), Sphere(center: (0, 0, 0.5), radius: 0.3)], \
         transform: [Translate((1, 0, 0))], placements: [[], [Translate((0, \"=1.2 + time\", 0))]])"
    );
    check("solids", &solids, 32.0, 60, &|p| if p[1] > 0.6 { [0.0, 1.0, 0.0] } else { [0.0; 3] });
}
