//! Motion blur: by closed forms, as the mean of pictures that stand still, against the reference; and the same bytes
//! however it is rendered.

use crate::same_bytes::bits;
use crate::support::compare::{Samples, assert_same_picture};
use crate::support::{compiled, film};
use scene_format::{LoadError, SceneDesc, Syntax, load_str};
use std::ops::ControlFlow;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};
use tracer_core::{Crop, Film, Level, Observer, Part, Progress, RenderOptions, Scene, Unobserved, render, resume};

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
                Sphere(center: (2.2, 1, -1), radius: 0.5, material: Mirror(reflectance: 0.9)),
            ])"#
    ))
}

/// Each sample is one of a picture that stands still, of the scene as it is at its moment.
#[test]
fn the_picture_is_the_mean_of_pictures_that_stand_still() {
    let scene = compiled(&moving("render: Render(max_bounces: 4, caustics: None),"));
    let samples = 11;
    let moved = film(&scene, samples, 9);
    let stills: Vec<Film> = (0..samples)
        .map(|k| {
            let still = scene.at_sample(k, 9).expect("it moves").expect("it is right");
            assert!(!still.moves());
            let crop = Crop::whole(scene.size);
            let part = Part { crop, first: k, end: k + 1, of_crop: crop, of_samples: samples };
            let options = RenderOptions { part: Some(part), seed: Some(9), ..RenderOptions::default() };
            render(&still, &options, &Unobserved)
        })
        .collect();
    for (x, y) in (0..29).flat_map(|y| (0..37).map(move |x| (x, y))) {
        let mean = stills.iter().map(|film| film.radiance(x, y)[1]).sum::<f64>() / f64::from(samples);
        let found = moved.radiance(x, y)[1];
        assert!((mean - found).abs() <= 1e-12 * found.max(1e-3), "{x} {y}: {found}, not {mean}");
    }
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
    let scene = compiled(&moving("render: Render(max_bounces: 4), background: 0.1,"));
    let whole = render(&scene, &options(1), &Unobserved);
    assert!(whole.caustics, "rays are aimed");
    let expected = bits(&whole);
    for threads in [2, 3] {
        let film = render(&scene, &options(threads), &Unobserved);
        assert!(bits(&film) == expected, "{threads} threads");
        assert_eq!(film.counters, whole.counters);
    }
    let crop = Crop { x: 9, y: 5, width: 17, height: 13 };
    let cut = render(&scene, &RenderOptions { crop: Some(crop), ..options(2) }, &Unobserved);
    for (x, y) in [(9, 5), (25, 17), (14, 11)] {
        assert_eq!(cut.radiance(x, y), whole.radiance(x, y));
    }
    // Ended anywhere and gone on with, and more samples asked for later.
    for end in [1, 7, 20, 33] {
        let film = render(&scene, &options(2), &Ends(AtomicU64::new(end)));
        let film = resume(&scene, &options(1), film, &Unobserved).expect("it fits");
        assert!(bits(&film) == expected, "ended after {end}");
        assert_eq!(film.counters, whole.counters, "ended after {end}");
    }
    let few = render(&scene, &RenderOptions { samples: Some(6), ..options(1) }, &Unobserved);
    assert!(bits(&resume(&scene, &options(1), few, &Unobserved).expect("it fits")) == expected, "more samples");
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
