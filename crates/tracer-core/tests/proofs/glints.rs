//! Glint chains (`engine::glints`): the same picture on average as the plain path tracer's, and less than a quarter of
//! its noise where all light comes over mirrors and glass. So the floor is black: what it would show of light over
//! mirrors and glass, paths alone meet so seldom that no number of samples would tell the mean of a tile with little
//! floor in it.

use crate::support::compare::{assert_guiding_is_unbiased, noise};
use crate::support::describe::*;
use crate::support::meshes::{icosphere, square};
use scene_format::SceneDesc;
use scene_format::desc::{Caustics, Object, Reuse, Shading, Transform};

/// All that are compared here, for the strictness of the tests.
const SCENES: usize = 2;

fn over_black(objects: Vec<Object>) -> SceneDesc {
    let floor = sphere([0.0, -1000.0, 0.0], 1000.0, diffuse([0.0; 3]));
    let lamps = vec![light([6.0, 14.0, 6.0], 2.0, [40.0, 30.0, 20.0]), light([-2.0, 6.0, -4.0], 1.0, [40.0; 3])];
    scene(32, lamps, [floor].into_iter().chain(objects).collect())
        .camera([0.0, 5.0, 18.0], [0.0, 3.0, 0.0], 40.0)
        .bounces(5)
}

/// Balls that show the lamps and each other; a matt square stands before one of the lamps, where chains must end as
/// paths do.
fn balls() -> SceneDesc {
    let before_the_lamp = vec![rotate([1.0, 0.0, 0.0], 90.0), Transform::Translate([-1.636, 5.818, 0.0])];
    let screen = mesh(&square(1.0).obj("square-1"), diffuse([0.001; 3]), Shading::Flat, before_the_lamp);
    over_black(vec![
        sphere([-3.5, 2.5, 0.0], 2.5, mirror([0.9, 0.8, 0.7])),
        sphere([0.5, 6.0, 0.0], 2.0, glass(1.5)),
        sphere([3.5, 2.0, 3.0], 2.0, glass(1.3)),
        screen,
    ])
}

#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn chains_see_what_paths_see() {
    assert_guiding_is_unbiased("balls", &balls(), 96, SCENES);
    // A mesh, and a background that chains and paths see, too.
    let place = vec![scale(3.0), Transform::Translate([2.0, 3.5, 0.0])];
    let open = over_black(vec![
        mesh(&icosphere(2).obj("icosphere-2"), glass(1.5), Shading::Smooth, place),
        sphere([-3.5, 3.0, 0.0], 2.5, mirror([0.9; 3])),
    ])
    .background([0.2, 0.3, 0.4]);
    assert_guiding_is_unbiased("a mesh under a background", &open, 96, SCENES);
}

/// At one sample a path's own share has a quarter of the weight and three chains the rest: 1/16 of the path's variance
/// V and 9/16 of V/3, a quarter in all, if the chains were independent. Three samples of one sequence are stratified
/// among themselves and do better: 0.17 is left, and 1/16 at the very least. Chains that were alike would leave 5/8,
/// none all of it. The middle of 0.25 and 0.625 is 0.43; tiles without mirrors and glass hold no noise here but the
/// lamps' edges.
#[test]
fn a_quarter_of_the_noise_is_left() {
    let noise_of = |caustics: Caustics| {
        let mut desc = balls();
        desc.render.caustics = caustics;
        desc.render.reuse = Reuse::None;
        noise(&desc, 1)
    };
    let (chains, alone) = (noise_of(Caustics::Photons), noise_of(Caustics::None));
    let left = chains / alone;
    println!("variance left by chains: {left:.3}");
    assert!((0.15..0.43).contains(&left), "{left}");
}
