//! Pixels that share what they find (`render.reuse`): the same picture on average, with far less noise.

use crate::random_scenes::random_scene;
use crate::support::compare::assert_sharing_is_unbiased;
use crate::support::describe::*;
use crate::support::meshes::{cube, icosphere, picture, torus};
use crate::support::{compiled, film};
use scene_format::SceneDesc;
use scene_format::desc::{Albedo, Material, Object, Reuse, Shading, TextureFilter, TextureWrap, Transform};

/// All that are compared here, for the strictness of the tests.
const SCENES: usize = 16;

fn in_the_room(bounces: u32, objects: Vec<Object>) -> SceneDesc {
    scene(32, vec![room_light()], room().into_iter().chain(objects).collect())
        .camera([0.0, 0.0, 55.0], [0.0, 0.0, 0.0], 60.0)
        .bounces(bounces)
}

fn grey(x: f64) -> Albedo {
    Albedo::Color([x; 3].into())
}

fn ball(material: Material, x: f64) -> Object {
    sphere([x, -10.0, 0.0], 10.0, material)
}

fn low_poly(material: Material, x: f64, shading: Shading) -> Object {
    let steps = vec![scale(9.0), Transform::Translate([x, 0.0, 0.0]), Transform::DropTo { y: -20.0 }];
    mesh(&icosphere(1).obj("icosphere-1"), material, shading, steps)
}

/// First vertices seen directly, in a mirror and through glass; sharp and broad lobes; roulette.
#[test]
fn every_kind_of_first_vertex() {
    let balls =
        vec![ball(mirror([0.8; 3]), -22.0), ball(glass(1.5), 0.0), ball(glossy(grey(0.8), 300.0, 0.2, false), 22.0)];
    assert_sharing_is_unbiased("three balls", &in_the_room(9, balls.clone()), SCENES);
    let conserving =
        vec![ball(glossy(grey(0.8), 5.0, 1.0, true), -22.0), ball(glossy(grey(0.8), 5000.0, 0.7, true), 12.0)];
    assert_sharing_is_unbiased("conserving balls", &in_the_room(4, conserving).lens(3.0, 50.0), SCENES);
}

/// Smooth triangles, whose rays start above them, and flat ones; textures; a mesh that hides much of the room.
#[test]
fn meshes() {
    let fur = || textured(&picture(), TextureFilter::Bilinear, TextureWrap::Repeat);
    let ring = vec![scale(14.0), rotate([1.0, 0.0, 0.0], 70.0), Transform::DropTo { y: -20.0 }];
    let objects = vec![
        low_poly(fur(), -20.0, Shading::Smooth),
        low_poly(diffuse([0.7; 3]), 20.0, Shading::Flat),
        mesh(&torus(0.3, 12, 6).obj("torus"), glossy(grey(0.6), 50.0, 0.25, false), Shading::Smooth, ring),
    ];
    assert_sharing_is_unbiased("meshes", &in_the_room(5, objects.clone()), SCENES);
    let outdoors =
        scene(32, vec![], objects).camera([0.0, 10.0, 70.0], [0.0, -10.0, 0.0], 40.0).background([0.4, 0.6, 1.0]);
    assert_sharing_is_unbiased("outdoors", &outdoors, SCENES);
}

#[test]
fn random_scenes_36_to_47() {
    for seed in 36..48 {
        assert_sharing_is_unbiased(&format!("random scene {seed}"), &random_scene(seed), SCENES);
    }
}

/// In a room of diffuse walls the second vertices of 64 paths light each of 64 pixels. At 256x256 pixels that is worth
/// 40 times less squared error (`docs/performance.md`); at the 32x32 of this test, where the pixels of an item lie far
/// apart and half of them share what the tree may hide, 5.7 times at 4 samples. An eighth of a 32-fold use is asked
/// for. The seeds are fixed, so the test gives the same every time.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn sharing_is_worth_it() {
    let objects = vec![ball(diffuse([0.7; 3]), -15.0), low_poly(diffuse([0.7; 3]), 15.0, Shading::Smooth)];
    let render = |reuse: Reuse, samples: u32, seed: u32| {
        let mut desc = in_the_room(5, objects.clone());
        desc.render.reuse = reuse;
        film(&compiled(&desc), samples, seed)
    };
    let truth = render(Reuse::Blocks, 2048, 1);
    let error = |reuse: Reuse, samples: u32| {
        let film = render(reuse, samples, 2);
        let pixel = |(x, y): (u32, u32)| {
            let (a, b) = (film.radiance(x, y), truth.radiance(x, y));
            let squared: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
            squared / (b.iter().sum::<f64>().powi(2) + 1e-3)
        };
        (0..32).flat_map(|y| (0..32).map(move |x| (x, y))).map(pixel).sum::<f64>()
    };
    for samples in [4, 32] {
        let gain = error(Reuse::None, samples) / error(Reuse::Blocks, samples);
        println!("{samples} samples: {gain:.1} times less squared error");
        assert!(gain > 4.0, "{samples} samples: only {gain:.2} times less squared error");
    }
}

/// A room that has half a wall to the sky: nine paths in ten have a second vertex, so pixels share. On a floor under
/// the sky they do not.
#[test]
fn rooms_with_a_window() {
    let mut walls = cube();
    walls.triangles.pop();
    let walls = mesh(&walls.obj("window"), diffuse([0.8, 0.7, 0.6]), Shading::Flat, vec![scale(60.0)]);
    let ball = || sphere([-15.0, -40.0, 0.0], 20.0, diffuse([0.3, 0.4, 0.8]));
    let under_a_sky = |lights, objects| {
        scene(48, lights, objects)
            .camera([0.0, 0.0, 55.0], [0.0, -10.0, 0.0], 60.0)
            .bounces(6)
            .background([4.0, 5.0, 7.0])
    };
    let window = under_a_sky(vec![], vec![walls, ball()]);
    let floor = || sphere([0.0, -10_060.0, 0.0], 10_000.0, diffuse([0.8; 3]));
    let rendered = |desc: &SceneDesc| film(&compiled(desc), 1, 1);
    assert!(rendered(&window).reuse && rendered(&window).counters.segments > 0);
    assert!(!rendered(&under_a_sky(vec![room_light()], vec![floor(), ball()])).reuse);
    let mut alone = window;
    alone.render.reuse = Reuse::None;
    assert!(!rendered(&alone).reuse && rendered(&alone).counters.segments == 0);
}
