//! The indirect map (`render.indirect: Map`, `engine::indirect`): the picture of the paths, smoother, but for a small bias.

use crate::random_scenes::random_scene;
use crate::support::compare::{assert_map_is_consistent, noise};
use crate::support::describe::*;
use crate::support::meshes::{cube, icosphere, picture, torus};
use crate::support::{compiled, film};
use scene_format::SceneDesc;
use scene_format::desc::{
    Albedo, Caustics, Indirect, Light, Object, Reuse, Shading, TextureFilter, TextureWrap, Transform,
};
use scene_format::diagnostic::Spanned;
use tracer_core::{RenderOptions, Unobserved};

/// All that are compared here, for the strictness of the tests.
const SCENES: usize = 16;

fn in_the_room(bounces: u32, objects: Vec<Object>) -> SceneDesc {
    scene(48, vec![room_light()], room().into_iter().chain(objects).collect())
        .camera([0.0, 0.0, 55.0], [0.0, 0.0, 0.0], 60.0)
        .bounces(bounces)
}

fn matt_room() -> SceneDesc {
    let ring = vec![scale(14.0), rotate([1.0, 0.0, 0.0], 70.0), Transform::DropTo { y: -20.0 }];
    in_the_room(
        5,
        vec![
            sphere([-15.0, -10.0, 0.0], 10.0, diffuse([0.7; 3])),
            mesh(&torus(0.3, 12, 6).obj("torus"), diffuse([0.6, 0.7, 0.8]), Shading::Smooth, ring),
        ],
    )
}

/// Matt walls of many colours, edges, contacts; and walls so bright that half of the light has come over five surfaces.
#[test]
fn matt_rooms() {
    assert!(assert_map_is_consistent("matt room", &matt_room(), SCENES));
    let white = || diffuse([0.9; 3]);
    let within = sphere([0.0, 0.0, 30.0], 60.0, white());
    let white = scene(48, vec![room_light()], vec![within, sphere([0.0, -10.0, 0.0], 10.0, white())])
        .camera([0.0, 0.0, 55.0], [0.0, 0.0, 0.0], 60.0)
        .bounces(12);
    assert!(assert_map_is_consistent("white room", &white, SCENES));
}

/// Under a ceiling of light every other ray from a second vertex meets it: the light sample stands for that.
#[test]
fn a_wide_lamp() {
    let mut desc = matt_room();
    desc.lights = vec![Spanned::from(Light::SphereLight(light([0.0, 10_040.0, 0.0], 10_000.0, [1.0, 1.2, 1.4])))];
    assert!(assert_map_is_consistent("under a ceiling of light", &desc, SCENES));
}

/// Second vertices seen over mirrors and through glass, whose paths have fewer vertices left; photons; glossy walls and textures; two lamps,
/// and a wide one, which rays find by themselves.
#[test]
fn what_stands_between() {
    let fur = || textured(&picture(), TextureFilter::Bilinear, TextureWrap::Repeat);
    let balls = |ior| {
        vec![
            sphere([-20.0, -10.0, 0.0], 10.0, mirror([0.8; 3])),
            sphere([0.0, -10.0, 0.0], 10.0, glass(ior)),
            sphere([20.0, -10.0, 0.0], 10.0, glossy(Albedo::Color([0.8; 3].into()), 30.0, 0.2, true)),
            mesh(
                &icosphere(1).obj("icosphere-1"),
                fur(),
                Shading::Flat,
                vec![scale(8.0), Transform::Translate([0.0, 10.0, -10.0])],
            ),
        ]
    };
    assert!(assert_map_is_consistent("with photons", &in_the_room(7, balls(1.5)), SCENES));
    let mut without = in_the_room(4, balls(1.2)).lens(3.0, 50.0);
    without.render.caustics = Caustics::None;
    without.lights.push(Spanned::from(Light::SphereLight(light([20.0, 30.0, 10.0], 9.0, [3.0, 4.0, 5.0]))));
    assert!(assert_map_is_consistent("without photons", &without, SCENES));
}

/// A room that has half a wall to the sky: nine paths in ten have a second vertex, so pixels share, and the map knows the sky, too. On a floor under
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
    let floor =
        under_a_sky(vec![room_light()], vec![sphere([0.0, -10_060.0, 0.0], 10_000.0, diffuse([0.8; 3])), ball()]);
    let rendered = |desc: &SceneDesc| film(&compiled(desc), 1, 1);
    assert!(assert_map_is_consistent("room with a window", &window, SCENES));
    assert!(rendered(&window).reuse && rendered(&window).indirect);
    assert!(!rendered(&floor).reuse && !rendered(&floor).indirect);
    let mut alone = window;
    alone.render.reuse = Reuse::None;
    assert!(!rendered(&alone).reuse && rendered(&alone).counters.record_rays == 0);
}

#[test]
fn random_scenes_48_to_79() {
    let mut tested = 0;
    for seed in 48..80 {
        let mut desc = random_scene(seed);
        desc.background = [0.0; 3];
        desc.render.max_bounces = desc.render.max_bounces.value.max(3).into();
        tested += u32::from(assert_map_is_consistent(&format!("random scene {seed}"), &desc, SCENES));
    }
    println!("{tested} of 32 scenes have a map");
    assert!(tested >= 8, "{tested} of 32 scenes have a map");
}

/// In a matt room the map takes away most of the variance from behind second vertices. At 256x256 pixels that leaves two thirds
/// of the relMSE (docs/noise.md); of the variance at the 128x128 of this test, with a quarter of the records, 0.87. The seeds are fixed, so the test gives the same every
/// time.
#[test]
fn the_map_is_worth_it() {
    let noise_of = |indirect: Indirect| {
        let mut desc = matt_room();
        (desc.image.width, desc.image.height) = (128.into(), 128.into());
        desc.render.indirect = indirect;
        noise(&desc, 2)
    };
    let left = noise_of(Indirect::Map) / noise_of(Indirect::Paths);
    println!("variance left by the map: {left:.3}");
    assert!(left < 0.93, "{left}");
}

/// It is at work only where pixels share and second vertices scatter once more, and counts its rays.
#[test]
fn where_it_is_at_work() {
    let rendered = |reuse: Reuse, bounces: u32, indirect: Indirect| {
        let mut desc = matt_room().bounces(bounces);
        (desc.image.width, desc.image.height) = (256.into(), 256.into());
        (desc.render.reuse, desc.render.indirect) = (reuse, indirect);
        tracer_core::render(&compiled(&desc), &RenderOptions { samples: Some(1), ..Default::default() }, &Unobserved)
    };
    let on = rendered(Reuse::Blocks, 5, Indirect::Map);
    assert!(on.indirect && on.counters.record_rays > 0);
    let paths = rendered(Reuse::Blocks, 5, Indirect::Paths);
    // What the picture's paths no longer trace: most of what comes after second vertices.
    assert!(2 * on.counters.scattered_rays < paths.counters.scattered_rays);
    for film in [paths, rendered(Reuse::None, 5, Indirect::Map), rendered(Reuse::Blocks, 1, Indirect::Map)] {
        assert!(!film.indirect && film.counters.record_rays == 0);
    }
    // One ball in the dark: a trial finds no second vertex, and that is all it costs.
    let alone = scene(64, vec![room_light()], vec![sphere([0.0; 3], 10.0, diffuse([0.8; 3]))])
        .camera([0.0, 0.0, 55.0], [0.0, 0.0, 0.0], 60.0)
        .bounces(5);
    let alone = film(&compiled(&alone), 1, 1);
    assert!(!alone.indirect && (1024..4096).contains(&alone.counters.record_rays), "{:?}", alone.counters);
}
