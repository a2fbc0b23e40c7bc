//! Light paths from the bright parts of pictures of all directions over mirrors and glass
//! (`engine::stages::light_paths`): the same picture on average as by paths alone, and less noise.

use crate::support::compare::{assert_guiding_is_unbiased, noise};
use crate::support::meshes::{icosphere, torus};
use crate::support::skies::{with_a_small_sun, with_a_sun_below, with_wide_suns};
use crate::support::{compiled, film};
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;

/// All that are compared here, for the strictness of the tests.
const SCENES: usize = 6;

fn read(text: &str) -> SceneDesc {
    load_str("s.ron", text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene
}

/// Objects on a floor, and what else a scene has, under a picture.
fn under(sky: &Path, more: &str, objects: &str) -> SceneDesc {
    read(&format!(
        "Scene(image: Image(width: 32, height: 32), background: Environment(file: {:?}, rotation: 75), \
         render: Render(max_bounces: 5), {more} \
         objects: [Rectangle(size: 12, material: Diffuse(albedo: (0.8, 0.7, 0.6))), {objects}])",
        sky.display().to_string()
    ))
}

const CAMERA: &str = "camera: Camera(position: (0, 3, 5), look_at: (0, 0.2, 0), fov: 34),";

/// A ball of glass, one that is a mirror, water in a glass, and a mirror upright.
const THINGS: &str = "Sphere(center: (-0.9, 0.6, 0), radius: 0.6, material: Transparent(ior: 1.5)), \
    Sphere(center: (0.5, 0.4, 0.6), radius: 0.4, material: Conductor(metal: Copper)), \
    Cylinder(from: (-0.1, 0.01, 1.3), to: (-0.1, 0.8, 1.3), radius: 0.3, \
        material: Transparent(ior: 1.33, transmittance: (0.6, 0.8, 1))), \
    Box(center: (0.9, 0.5, -0.6), size: (1, 1, 0.1), material: Mirror(reflectance: 0.9))";

#[test]
fn from_above_and_below() {
    assert_guiding_is_unbiased("wide suns", &under(&with_wide_suns(), CAMERA, THINGS), 512, SCENES);
}

/// Beside a lamp, before planes, one of them a mirror, through a lens.
#[test]
fn beside_a_lamp_and_planes() {
    let more = "camera: Camera(position: (0, 3, 5), look_at: (0, 0.2, 0), fov: 34), \
                effects: Effects(depth_of_field: ThinLens(aperture: 0.2, focus_distance: 5)), \
                lights: [SphereLight(center: (-2, 3, -1), radius: 0.5, radiance: 8)],";
    let planes = "Plane(point: (0, -1.5, 0), material: Mirror(reflectance: 0.6)), \
                  Plane(point: (0, 0, -2.5), normal: (0.1, 0, 1), material: Diffuse(albedo: 0.6))";
    let scene = under(&with_wide_suns(), more, &format!("{THINGS}, {planes}"));
    assert_guiding_is_unbiased("suns, a lamp and planes", &scene, 512, SCENES);
}

/// Beside a dim lamp, with which the picture shares the light samples, all light comes from a sun below the horizon
/// over a mirror above: what both ends count is seen in all of it.
#[test]
fn where_all_light_comes_over_a_mirror() {
    let more = "camera: Camera(position: (0, 1.2, 3), look_at: (0, 0, 0), fov: 40), \
                lights: [SphereLight(center: (0, 40, 0), radius: 0.1, radiance: 1)],";
    let mirror = "Box(center: (0, 1.5, 0), size: (6, 0.1, 6), material: Mirror(reflectance: 0.9))";
    let scene = under(&with_a_sun_below(), more, mirror);
    assert_guiding_is_unbiased("over a mirror", &scene, 512, SCENES);
}

/// More casters than pairs allow, taken together, behind a pane; meshes with interpolated normals.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn over_many_things_and_meshes() {
    let balls = "Repeat(count: 300, index: \"k\", items: [Sphere(\
                     center: (\"=-2.4 + 0.25*(k % 20)\", 0.1, \"=-2 + 0.25*floor(k/20)\"), radius: 0.08, \
                     material: Transparent(ior: 1.5))]), \
                 Box(center: (0, 1.2, 0), size: (6, 0.05, 6), material: Transparent(ior: 1.5))";
    assert_guiding_is_unbiased("many", &under(&with_wide_suns(), CAMERA, balls), 512, SCENES);
    let mesh = |file: &Path, x: f64, material: &str| {
        let file = file.display().to_string();
        format!(
            "Mesh(file: {file:?}, shading: Smooth, transform: [Rotate(axis: (0.3, 1, 0.2), degrees: 40), \
             Scale(0.6), Translate(({x}, 0, 0)), DropTo(y: 0.02)], material: {material})"
        )
    };
    let statue = mesh(&icosphere(2).obj("icosphere-2"), -0.8, "Transparent(ior: 1.5)");
    let ring = mesh(&torus(0.25, 48, 16).obj("fine-torus"), 0.8, "Mirror(reflectance: (0.9, 0.8, 0.5))");
    let scene = under(&with_wide_suns(), CAMERA, &format!("{statue}, {ring}"));
    assert_guiding_is_unbiased("meshes", &scene, 512, SCENES);
}

/// A plane far below everything keeps what is below it from all: exactly.
#[test]
fn what_is_behind_a_plane_brings_nothing() {
    let planes = "Plane(point: (0, -30, 0), material: Diffuse(albedo: 0.5))";
    let scene = under(&with_a_sun_below(), CAMERA, &format!("{THINGS}, {planes}"));
    let film = film(&compiled(&scene), 32, 3);
    assert!((0..32 * 32).all(|k| film.radiance(k % 32, k / 32) == [0.0; 3]));
    // Without the plane the sun is seen from below.
    let lit = crate::support::film(&compiled(&under(&with_a_sun_below(), CAMERA, THINGS)), 32, 3);
    assert!((0..32 * 32).any(|k| lit.radiance(k % 32, k / 32) != [0.0; 3]));
}

/// The caustic of a ball of glass that the camera does not see, on a floor: its light paths leave a variance of 4.4,
/// aimed rays alone 82 (summed over pixels and channels; 64 samples).
#[test]
fn caustics_of_a_small_sun_have_no_dots() {
    let ball = "Sphere(center: (0, 0.6, 0), radius: 0.6, camera_visible: false, material: Transparent(ior: 1.5))";
    let noise = noise(&under(&with_a_small_sun(), CAMERA, ball), 64);
    assert!(noise < 19.0, "{noise}");
}
