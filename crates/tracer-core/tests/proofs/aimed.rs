//! Rays aimed at mirrors, glass and glossy surfaces (`engine::stages::aim`): the same picture on average as without.

use crate::support::compare::assert_guiding_is_unbiased;
use crate::support::describe::*;
use crate::support::meshes::{icosphere, torus};
use crate::support::skies::{sky_without_a_sun, sunny, with_a_small_sun};
use crate::support::{compiled, film};
use scene_format::desc::{Albedo, Object, Shading, SphereLight, Transform};
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;

/// All that are compared here, for the strictness of the tests.
const SCENES: usize = 9;

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

/// Rays are aimed from rough metals as well: measured ones, tinted ones, with what textures say of colour, tint and
/// roughness, and a smooth mesh whose normals bend away from the viewer.
#[test]
fn rough_metals() {
    let text = "Scene(image: Image(width: 32, height: 32), render: Render(max_bounces: 5), \
         camera: Camera(position: (-2, 9, 20), look_at: (0, 3, 0), fov: 45), \
         lights: [SphereLight(center: (6, 16, 4), radius: 4, radiance: 10)], \
         objects: [ \
             Rectangle(size: 60, material: Conductor(reflectance: 0.8, roughness: 0.9, \
                 edge_tint: Checkerboard(a: (1, 0.4, 0.3), b: 0.9, mapping: Uv(scale: (20, 20))))), \
             Plane(point: (0, 0, -8), normal: (0, 0, 1), material: Conductor(metal: Copper, \
                 roughness: Gradient(a: 0.3, b: 0.8, axis: X, mapping: Object(scale: 0.1)))), \
             Sphere(center: (-5, 2.5, 0), radius: 2.5, material: Mirror(reflectance: 0.9)), \
             Sphere(center: (0, 3, 1), radius: 2.5, material: Transparent(ior: 1.5)), \
             Sphere(center: (4, 2, 3), radius: 1.5, material: Conductor(metal: Gold, roughness: 0.4)), \
             Mesh(points: [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], \
                 faces: [(2, 4, 0), (2, 1, 4), (2, 5, 1), (2, 0, 5), (3, 0, 4), (3, 4, 1), (3, 1, 5), (3, 5, 0)], \
                 shading: Smooth, transform: [Scale(2.5), Translate((4, 5.5, -4))], \
                 material: Conductor(roughness: 0.6, reflectance: Checkerboard(a: (0.9, 0.7, 0.3), b: 0.5, \
                     mapping: Object(scale: 1.3))))])";
    let scene = load_str("s.ron", text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    assert_guiding_is_unbiased("rough metals", &scene, 256, SCENES);
}

/// A sky of one colour.
const BLUE: &str = "(1, 1.5, 2)";

/// A picture as a sky.
fn picture(file: &Path) -> String {
    format!("Environment(file: {:?}, rotation: 75)", file.display().to_string())
}

/// A room with two windows, one with a pane, under a sky, with rough metal and glossy things in it; lights as well,
/// and what closes the one in the roof.
fn windows(sky: &str, lights: &str, caustics: &str, lid: &str) -> String {
    format!(
        "Scene(image: Image(width: 32, height: 32), background: {sky}, \
         render: Render(max_bounces: 4, caustics: {caustics}), \
         camera: Camera(position: (1.2, 1.5, 1.8), look_at: (-0.3, 0.9, -1), fov: 60), \
         materials: {{ \"wall\": Diffuse(albedo: 0.7) }}, \
         lights: [{lights}], \
         objects: [ \
             Box(center: (0, -0.05, 0), size: (4.2, 0.1, 5.2), material: \"wall\"), \
             Box(center: (0.6, 2.65, 0), size: (3, 0.1, 5.2), material: \"wall\"), \
             Box(center: (-1.5, 2.65, 0.6), size: (1.2, 0.1, 4), material: \"wall\"), \
             Box(center: (-2.05, 1.3, 0), size: (0.1, 2.6, 5.2), material: \"wall\"), \
             Box(center: (0, 1.3, -2.55), size: (4.2, 2.6, 0.1), material: \"wall\"), \
             Box(center: (0, 1.3, 2.55), size: (4.2, 2.6, 0.1), material: \"wall\"), \
             Box(center: (2.05, 1.3, 1.5), size: (0.1, 2.6, 2.2), material: \"wall\"), \
             Box(center: (2.05, 1.3, -1.9), size: (0.1, 2.6, 1.4), material: \"wall\"), \
             Box(center: (2.05, 0.45, -0.4), size: (0.1, 0.9, 1.6), material: \"wall\"), \
             Box(center: (2.05, 2.3, -0.4), size: (0.1, 0.6, 1.6), material: \"wall\"), \
             Box(center: (2.05, 1.45, -0.4), size: (0.01, 1.1, 1.6), material: Transparent(ior: 1.5)), \
             Sphere(center: (-0.6, 0.4, -0.8), radius: 0.4, material: Conductor(metal: Copper, roughness: 0.5)), \
             Sphere(center: (0.4, 0.3, -1), radius: 0.3, \
                 material: BlinnPhong(albedo: 0.7, exponent: 30, specular: 0.3, energy_conserving: true)), \
             {lid} \
         ])"
    )
}

/// Rays that are aimed at a sky through windows bring what rays by chance bring, beside those that are aimed over
/// glass.
#[test]
fn windows_under_a_sky() {
    let text = windows(BLUE, "", "Photons", "");
    let scene = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    assert_guiding_is_unbiased("windows", &scene, 256, SCENES);
}

/// And beside a lamp and what is aimed from it.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn windows_and_a_lamp() {
    let lamp = "SphereLight(center: (0.5, 2, 0.5), radius: 0.3, radiance: 1)";
    let text = windows(BLUE, lamp, "Photons", "");
    let scene = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    assert_guiding_is_unbiased("windows and a lamp", &scene, 256, SCENES);
}

/// Under a picture light samples see the sky through windows, too: three ways are weighed, and from its sun photons
/// come over panes.
#[test]
fn windows_under_a_picture() {
    let text = windows(&picture(&sunny()), "", "Photons", "");
    let scene = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    assert_guiding_is_unbiased("windows under a picture", &scene, 256, SCENES);
}

/// And beside a lamp, with which it shares the light samples.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn windows_under_a_picture_and_a_lamp() {
    let lamp = "SphereLight(center: (0.5, 2, 0.5), radius: 0.3, radiance: 1)";
    let text = windows(&picture(&sunny()), lamp, "Photons", "");
    let scene = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    assert_guiding_is_unbiased("windows under a picture and a lamp", &scene, 256, SCENES);
}

/// With one window, and rays that are aimed at it, half of the pixels have less than half the deviation.
#[test]
fn windows_are_found() {
    let lid = "Box(center: (-1.5, 2.65, -2), size: (1.2, 0.1, 1.2), material: \"wall\")";
    for sky in [BLUE, &picture(&sky_without_a_sun())] {
        let [aimed, by_chance] = ["Photons", "None"].map(|how| deviation_of_half(&windows(sky, "", how, lid)));
        assert!(2.0 * aimed < by_chance, "{sky}: {aimed} and {by_chance}");
    }
}

/// A ball of glass and a mirror on a floor under a picture with a sun, whose light they throw there.
fn under_a_sun() -> String {
    format!(
        "Scene(image: Image(width: 32, height: 32), background: {}, \
         render: Render(max_bounces: 5), \
         camera: Camera(position: (0, 3, 5), look_at: (0, 0.2, 0), fov: 34), \
         objects: [Rectangle(size: 12, material: Diffuse(albedo: (0.8, 0.7, 0.6))), \
             Sphere(center: (-0.7, 0.6, 0), radius: 0.6, material: Transparent(ior: 1.5)), \
             Box(center: (0.9, 0.5, -0.6), size: (1, 1, 0.1), material: Mirror(reflectance: 0.9)), \
             Plane(point: (0, -2, 0), material: Mirror(reflectance: 0.5))])",
        picture(&with_a_small_sun())
    )
}

/// Photons from the bright parts of a picture only say where to aim.
#[test]
fn a_sun_over_glass_and_mirrors() {
    let scene = load_str("s.ron", &under_a_sun(), Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    assert_guiding_is_unbiased("a sun over glass", &scene, 256, SCENES);
}

/// What a sun brings through water is told by most samples, not by one of thousands: half of the pixels have the mean
/// and more (seeds 3 to 5). Seven tenths of the light is the sun's; rays by chance leave 0.29 to 0.35 of the mean.
#[test]
fn a_sun_over_glass_is_found() {
    let text = format!(
        "Scene(image: Image(width: 32, height: 32), background: {}, render: Render(max_bounces: 8), \
         camera: Camera(position: (0, 4, 6), look_at: (0, -0.6, 0), fov: 16), \
         objects: [Plane(point: (0, -1, 0), material: Diffuse(albedo: 0.6)), \
             Box(center: (0, -0.5, 0), size: (5, 0.8, 5), material: Transparent(ior: 1.33))])",
        picture(&with_a_small_sun())
    );
    let share = share_of_half(&text);
    assert!(share > 0.8, "{share}");
}

/// A sun shines through a pane onto a floor; walls see that. Roulette spares aimed rays within the pane, though paths
/// carry little there: with 16 samples 377 to 392 of the 1024 pixels see some light (seeds 3 to 5). When it did not,
/// 301 to 306 of them did.
#[test]
fn aimed_rays_are_spared_by_roulette() {
    let sun = "SphereLight(center: (60, 50, -12), radius: 4, radiance: 3000)";
    let lid = "Box(center: (-1.5, 2.65, -2), size: (1.2, 0.1, 1.2), material: \"wall\")";
    let text = windows("(0, 0, 0)", sun, "Photons, reuse: None", lid);
    let scene = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    let film = film(&compiled(&scene), 16, 3);
    let lit = (0..32 * 32).filter(|k| film.radiance(k % 32, k / 32) != [0.0; 3]).count();
    assert!(lit > 32 * 32 / 3, "{lit}");
}

/// What half of the pixels have at least, of 64 samples, over their mean.
fn share_of_half(text: &str) -> f64 {
    let scene = load_str("s.ron", text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    let film = film(&compiled(&scene), 64, 3);
    let mut pixels: Vec<f64> = (0..32 * 32).map(|k| film.radiance(k % 32, k / 32).iter().sum()).collect();
    pixels.sort_by(f64::total_cmp);
    pixels[512] / (pixels.iter().sum::<f64>() / pixels.len() as f64)
}

/// The deviation that half of the pixels exceed over their mean, of 64 samples: a bright one by chance says nothing.
fn deviation_of_half(text: &str) -> f64 {
    let scene = load_str("s.ron", text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    let film = film(&compiled(&scene), 64, 3);
    let pixels = || (0..32 * 32).map(|k| (k % 32, k / 32));
    let mut variances: Vec<f64> = pixels().map(|(x, y)| film.variance(x, y)).collect();
    variances.sort_by(f64::total_cmp);
    let mean = pixels().map(|(x, y)| film.radiance(x, y).iter().sum::<f64>() / 3.0).sum::<f64>() / (32.0 * 32.0);
    variances[512].sqrt() / mean
}

/// A small lamp that shines through a slab of water.
fn under_water(floor: &str, scale: f64) -> String {
    format!(
        "Scene(image: Image(width: 32, height: 32), render: Render(max_bounces: 8), \
         camera: Camera(position: (0, 4, 6), look_at: (0, -0.6, 0), fov: 16), \
         lights: [SphereLight(center: ({}, {}, {}), radius: {}, radiance: 45000)], \
         objects: [Plane(point: (0, -1, 0), material: {floor}), \
             Box(center: (0, -0.5, 0), size: (5, 0.8, 5), material: Transparent(ior: 1.33))])",
        6.0 * scale,
        8.0 * scale,
        4.0 * scale,
        0.05 * scale
    )
}

/// Steel under water: half of its pixels have 0.95 of the mean and more. While nothing was aimed from metals nearly all
/// were black, and the mean was 0.004 of what it is, for the rest came once in thousands of samples.
#[test]
fn light_over_glass_is_found_from_rough_metals() {
    let text = under_water("Conductor(metal: Steel, roughness: 0.7)", 1.0);
    let share = share_of_half(&text);
    assert!(share > 0.8, "{share}");
}

/// The floor under a slab of water is found as well in the light of a lamp that is ten times as far away and as wide:
/// as much light comes from there. It was not, while the chance of aimed rays went by the flux of lamps, of which
/// little comes from afar: the deviation of its pixels was twice that.
#[test]
fn far_lamps_are_found_as_well_as_near_ones() {
    let [near, far] = [1.0, 10.0].map(|scale| deviation_of_half(&under_water("Diffuse(albedo: 0.6)", scale)));
    assert!(far < 1.3 * near, "{near} and {far}");
}
