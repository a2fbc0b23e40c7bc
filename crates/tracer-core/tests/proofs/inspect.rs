//! A sample that is explained is the sample that the picture has, and the numbers that are told of it are those that it
//! is made of.

use crate::same_bytes::{everything, many_balls};
use crate::support::compiled;
use crate::support::describe::*;
use crate::support::meshes::square;
use scene_format::SceneDesc;
use scene_format::desc::{Integrator, PixelFilter, Shading, Transform};
use tracer_core::{Crop, Ended, Film, Inspection, Part, RenderOptions, Scene, Unobserved, VertexTold, inspect, render};

/// A closed room with a lamp, a mirror and glass, where nothing is behind everything.
fn room() -> SceneDesc {
    let wall = |axis: [f64; 3], degrees: f64, at: [f64; 3], albedo: [f64; 3]| {
        let transform = vec![rotate(axis, degrees), scale(4.0), Transform::Translate(at)];
        mesh(&square(1.0).obj("square-1"), diffuse(albedo), Shading::Flat, transform)
    };
    let objects = vec![
        wall([0.0, 1.0, 0.0], 0.0, [0.0, 0.0, 0.0], [0.7; 3]),
        wall([1.0, 0.0, 0.0], 90.0, [0.0, 2.0, -4.0], [0.7, 0.2, 0.2]),
        wall([0.0, 0.0, 1.0], 90.0, [-4.0, 2.0, 0.0], [0.2, 0.7, 0.2]),
        sphere([-1.0, 1.0, 0.0], 1.0, glass(1.5)),
        sphere([1.2, 0.8, 0.3], 0.8, mirror([0.9; 3])),
        sphere([0.2, 0.4, 1.6], 0.4, blinn_phong([0.3, 0.4, 0.8], 80.0, 0.3)),
    ];
    scene(24, vec![light([0.0, 4.0, 2.0], 0.5, [30.0, 28.0, 25.0])], objects)
        .camera([0.0, 2.0, 7.0], [0.0, 1.0, 0.0], 50.0)
        .bounces(8)
}

fn scenes() -> Vec<(&'static str, SceneDesc)> {
    let mut direct = everything();
    direct.render.integrator = Integrator::Direct;
    let mut clamped = room();
    clamped.render.clamp = Some(0.2.into());
    vec![
        ("everything", everything()),
        ("many balls", many_balls()),
        ("a room", room()),
        ("a clamped room", clamped),
        ("direct light", direct),
        ("one bounce", room().bounces(0)),
        ("hidden", crate::hidden::hidden()),
        ("lamps with textures", crate::glow::lamps()),
    ]
}

/// What the film of one pixel and sample has.
fn film(scene: &Scene, [x, y]: [u32; 2], sample: u32, techniques: Option<bool>) -> Film {
    let crop = Crop { x, y, width: 1, height: 1 };
    let part = Part { crop, first: sample, end: sample + 1, of_crop: crop, of_samples: sample + 1 };
    let options = RenderOptions {
        part: Some(part),
        threads: 1,
        reuse: techniques,
        caustics: techniques,
        ..RenderOptions::default()
    };
    render(scene, &options, &Unobserved)
}

fn told(scene: &Scene, pixel: [u32; 2], sample: u32) -> Inspection {
    let options = RenderOptions { threads: 1, ..RenderOptions::default() };
    inspect(scene, &options, pixel, sample).expect("the picture has it")
}

/// Contributions in their order, summed as the batch does, in single precision.
fn sum(scene: &Scene, vertices: &[VertexTold]) -> [f64; 3] {
    let mut sum = [0f32; 3];
    let mut add = |x: [f64; 3]| (0..3).for_each(|c| sum[c] += (x[c] / scene.radiance_unit) as f32);
    for depth in 0..=vertices.iter().map(|vertex| vertex.depth).max().unwrap_or(0) {
        let there = || vertices.iter().filter(move |vertex| vertex.depth == depth);
        there().filter_map(|vertex| vertex.met.as_ref()).for_each(|met| add(met.brings));
        there().filter_map(|vertex| vertex.sampled.as_ref()).for_each(|sampled| add(sampled.brings()));
    }
    sum.map(|x| f64::from(x) * scene.radiance_unit)
}

/// All pixels of a coarse grid, several samples each: to the bit what the film has.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn what_is_told_sums_to_the_sample() {
    for (name, desc) in scenes() {
        let scene = compiled(&desc);
        let (mut lit, mut deep) = (0, 0);
        for (k, sample) in [0, 1, 5, 31].into_iter().enumerate() {
            for y in (k as u32..scene.size[1]).step_by(5) {
                for x in (2 * k as u32..scene.size[0]).step_by(7) {
                    let path = told(&scene, [x, y], sample).path;
                    assert!(path.agrees, "{name}: {x},{y}, sample {sample}");
                    assert_eq!(sum(&scene, &path.vertices), path.radiance, "{name}: {x},{y}, sample {sample}");
                    let film = film(&scene, [x, y], sample, Some(false));
                    assert_eq!(film.radiance(x, y), path.counts, "{name}: {x},{y}, sample {sample}");
                    lit += u32::from(path.radiance != [0.0; 3]);
                    deep += u32::from(path.vertices.iter().any(|vertex| vertex.depth > 3));
                }
            }
        }
        assert!(lit > 20, "{name}: {lit}");
        assert!(deep > 5 || ["direct light", "one bounce", "lamps with textures"].contains(&name), "{name}: {deep}");
    }
}

/// The techniques, too: what each brings sums to what the film has, and none is told that is not at work.
#[test]
fn what_techniques_bring_sums_to_the_sample() {
    let mut seen = std::collections::BTreeSet::new();
    for (name, desc) in [
        ("a room", room()),
        ("many balls", many_balls()),
        ("everything", everything()),
        ("lamps with textures", crate::glow::lamps()),
    ] {
        let scene = compiled(&desc);
        for (k, sample) in [0, 9].into_iter().enumerate() {
            for (x, y) in (0..8).map(|k| (2 + 3 * k, 1 + (7 * k) % 21)).skip(k) {
                let whole = told(&scene, [x, y], sample).whole.expect("techniques are at work");
                assert!(whole.agrees, "{name}: {x},{y}, sample {sample}: {whole:?}");
                assert_eq!(film(&scene, [x, y], sample, None).radiance(x, y), whole.radiance, "{name}: {x},{y}");
                let has = |by: &str| whole.brought.iter().any(|brought| brought.by == by);
                assert!(!has("aimed rays") || whole.aimed > 0);
                assert!(!has("sharing") || whole.shared.is_some_and(|shared| shared.seen <= shared.found));
                seen.extend(whole.brought.iter().map(|brought| brought.by));
            }
        }
    }
    let all = ["aimed rays", "glint chains", "light paths", "paths", "sharing"];
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), all);
    let mut plain = room();
    plain.render.integrator = Integrator::Path;
    assert_eq!(told(&compiled(&plain), [12, 12], 0).whole, None);
}

fn close(found: [f64; 3], expected: [f64; 3]) -> bool {
    (0..3).all(|c| (found[c] - expected[c]).abs() <= 2e-4 * expected[c].abs().max(found[c].abs()) + 1e-30)
}

/// Weights, densities and throughputs are those that the contributions are made of.
#[test]
fn numbers_that_are_told_are_those_of_the_sample() {
    let (mut met_lights, mut sampled_lights, mut survived, mut ended) =
        ([0; 2], 0, 0, std::collections::BTreeSet::new());
    for (name, desc) in scenes() {
        let scene = compiled(&desc);
        for (x, y) in (0..60).map(|k| ((5 * k) % scene.size[0], (11 * k) % scene.size[1])) {
            let path = told(&scene, [x, y], x % 3).path;
            for (k, vertex) in path.vertices.iter().enumerate() {
                let at = format!("{name}: {x},{y}, vertex {k}: {vertex:?}");
                if let Some(met) = &vertex.met {
                    let expected = [0, 1, 2].map(|c| vertex.throughput[c] * met.radiance[c] * met.weight);
                    assert!(close(met.brings, expected), "{at}");
                    // A sky is never asked, so that it has no density.
                    met_lights[usize::from(met.light_pdf.is_some())] += 1;
                }
                if let Some(sampled) = vertex.sampled.as_ref().filter(|sampled| sampled.arrives.is_some()) {
                    let scale = sampled.cos / sampled.pdf * sampled.weight;
                    let expected = [0, 1, 2].map(|c| vertex.throughput[c] * sampled.f[c] * sampled.radiance[c] * scale);
                    assert!(close(sampled.carries, expected), "{at}, not {expected:?}");
                    sampled_lights += 1;
                }
                ended.extend(vertex.ended.map(|why| format!("{why:?}")));
                let next = path.vertices.iter().find(|next| next.from == Some(k) && next.is_branch == vertex.is_branch);
                assert_eq!(next.is_none(), vertex.ended.is_some(), "{at}");
                let (Some(next), Some(scattering)) = (next, &vertex.scattering) else { continue };
                let survival = scattering.roulette.as_ref().map_or(1.0, |by| by.survival);
                survived += u32::from(survival < 1.0);
                let expected = [0, 1, 2].map(|c| vertex.throughput[c] * scattering.weight[c] / survival);
                assert!(close(next.throughput, expected), "{at}, {next:?}");
                assert_eq!((next.direction, next.pdf), (scattering.direction, scattering.pdf), "{at}");
                assert!(scattering.roulette.as_ref().is_none_or(|by| by.drawn < by.survival), "{at}");
            }
        }
    }
    let [of_skies, of_others] = met_lights;
    assert!(of_skies > 30 && of_others > 3, "{met_lights:?}");
    assert!(sampled_lights > 300 && survived > 30, "{sampled_lights} {survived}");
    let all = ["AtLight", "Bounces", "Direct", "Left", "Roulette"];
    assert!(all.iter().all(|why| ended.contains(*why)), "{ended:?}");
}

/// A path whose every number is known: a camera over a floor, a lamp above.
#[test]
fn a_path_by_hand() {
    let floor = mesh(&square(1.0).obj("square-1"), diffuse([0.5; 3]), Shading::Flat, vec![scale(20.0)]);
    let desc = scene(3, vec![light([0.0, 6.0, 0.0], 1.0, [10.0; 3])], vec![floor])
        .camera([0.0, 4.0, 3.0], [0.0; 3], 1.0)
        .filter(PixelFilter::None)
        .bounces(0);
    let scene = compiled(&desc);
    let told = told(&scene, [1, 1], 0);
    let [vertex] = &told.path.vertices[..] else { panic!("{:?}", told.path) };
    let hit = vertex.told.as_ref().expect("the floor");
    assert!(close(hit.normal, [0.0, 1.0, 0.0]) && (hit.distance - 5.0).abs() < 1e-5, "{hit:?}");
    assert!(hit.point.iter().all(|x| x.abs() < 1e-5) && hit.object == Some(0), "{hit:?}");
    let sampled = vertex.sampled.as_ref().expect("the lamp is sampled");
    // A sphere of radius 1 at distance 6: uniform over its cone.
    let solid_angle = std::f64::consts::TAU * (1.0 - (1.0f64 - 1.0 / 36.0).sqrt());
    assert!((sampled.pdf * solid_angle - 1.0).abs() < 1e-4 && sampled.weight == 1.0, "{sampled:?}");
    assert!(close(sampled.f, [0.5 / std::f64::consts::PI; 3]) && close(sampled.radiance, [10.0; 3]));
    assert_eq!((vertex.ended, sampled.arrives), (Some(Ended::Bounces), Some(true)));
    assert_eq!(inspect(&scene, &RenderOptions::default(), [3, 0], 0), None);
}
