//! Rays aimed at mirrors, glass and glossy surfaces (`engine::stages::aim`): the same picture on average as without.

use crate::support::compare::assert_guiding_is_unbiased;
use crate::support::describe::*;
use crate::support::meshes::{icosphere, torus};
use crate::support::{compiled, film};
use scene_format::desc::{Albedo, Object, Shading, SphereLight, Transform};
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;

/// All that are compared here, for the strictness of the tests.
const SCENES: usize = 3;

fn lamp() -> SphereLight {
    light([6.0, 16.0, 4.0], 4.0, [10.0; 3])
}

fn on_the_floor(objects: Vec<Object>) -> SceneDesc {
    let floor = sphere([0.0, -1000.0, 0.0], 1000.0, diffuse([0.8, 0.6, 0.4]));
    let wall = sphere([0.0, 0.0, -1008.0], 1000.0, diffuse([0.4, 0.7, 0.8]));
    scene(32, vec![lamp()], [floor, wall].into_iter().chain(objects).collect())
        .camera([-2.0, 9.0, 20.0], [0.0, 3.0, 0.0], 45.0)
        .bounces(5)
}

/// Balls near to each other and to the floor, whose cones overlap; one that throws no caustic to speak of, but shows
/// what is behind it.
#[test]
fn balls() {
    let balls = vec![
        sphere([-5.0, 2.5, 0.0], 2.5, mirror([0.9, 0.8, 0.7])),
        sphere([0.0, 3.0, 1.0], 2.5, glass(1.5)),
        sphere([4.0, 2.0, 3.0], 1.5, mirror([0.8; 3])),
        sphere([0.0, 7.5, -2.0], 1.2, glass(1.1)),
    ];
    assert_guiding_is_unbiased("balls", &on_the_floor(balls), 256, SCENES);
}

/// Members with both lobes, and glossy things that aimed rays meet, within spheres that are aimed at and beyond them.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn glossy_balls() {
    let grey = |x: f64| Albedo::Color([x; 3].into());
    let objects = vec![
        sphere([-4.0, 3.0, 0.0], 3.0, glossy(grey(0.8), 20.0, 0.2, false)),
        sphere([3.5, 2.5, 1.0], 2.5, glossy(grey(0.8), 400.0, 0.5, true)),
        sphere([0.0, 1.5, 4.0], 1.5, mirror([0.9; 3])),
    ];
    assert_guiding_is_unbiased("glossy", &on_the_floor(objects), 256, SCENES);
}

/// Meshes fill little of their spheres; smooth matt ones start their rays above themselves.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn meshes() {
    let ring = vec![
        scale(3.5),
        rotate([1.0, 0.0, 0.0], 70.0),
        Transform::Translate([-3.0, 0.0, 2.0]),
        Transform::DropTo { y: 0.01 },
    ];
    let body = |x: f64| vec![scale(2.5), Transform::Translate([x, 0.0, 0.0]), Transform::DropTo { y: 0.01 }];
    let objects = vec![
        mesh(&torus(0.3, 12, 6).obj("torus"), mirror([0.9; 3]), Shading::Flat, ring),
        mesh(&icosphere(1).obj("icosphere-1"), diffuse([0.7; 3]), Shading::Smooth, body(3.5)),
        mesh(&icosphere(1).obj("icosphere-1"), glass(1.5), Shading::Flat, body(-1.0)),
    ];
    assert_guiding_is_unbiased("meshes", &on_the_floor(objects), 256, SCENES);
}

/// The floor under a slab of water is found as well in the light of a lamp that is ten times as far away and as wide:
/// as much light comes from there. It was not, while the chance of aimed rays went by the flux of lamps, of which
/// little comes from afar: the deviation of its pixels was twice that.
#[test]
fn far_lamps_are_found_as_well_as_near_ones() {
    let deviation = |scale: f64| {
        let text = format!(
            "Scene(image: Image(width: 32, height: 32), render: Render(max_bounces: 8), \
             camera: Camera(position: (0, 4, 6), look_at: (0, -0.6, 0), fov: 16), \
             lights: [SphereLight(center: ({}, {}, {}), radius: {}, radiance: 45000)], \
             objects: [Plane(point: (0, -1, 0), material: Diffuse(albedo: 0.6)), \
                 Box(center: (0, -0.5, 0), size: (5, 0.8, 5), material: Transparent(ior: 1.33))])",
            6.0 * scale,
            8.0 * scale,
            4.0 * scale,
            0.05 * scale
        );
        let scene = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
        let film = film(&compiled(&scene), 64, 3);
        // Half of the pixels have less: a bright one by chance says nothing.
        let mut variances: Vec<f64> = (0..32 * 32).map(|k| film.variance(k % 32, k / 32)).collect();
        variances.sort_by(f64::total_cmp);
        variances[512].sqrt()
    };
    let [near, far] = [1.0, 10.0].map(deviation);
    assert!(far < 1.3 * near, "{near} and {far}");
}
