//! Objects that shine: rectangles, boxes, meshes and spheres with `Emissive`, as paths of the reference see them, and
//! against closed forms.

use crate::coplanar::{SIZE, points};
use crate::support::compare::{Samples, assert_guiding_is_unbiased, assert_same_picture};
use crate::support::describe::*;
use crate::support::meshes::{icosphere, square, torus};
use crate::support::{compiled, film};
use glam::DVec3;
use scene_format::SceneDesc;
use scene_format::desc::{
    Amount, Emissive, Light, LightGroup, Material, MaterialRef, Name, Object, PerAxis, PixelFilter, Placements,
    RectBox, Rectangle, Shading, SphereLight, Transform, Vec3,
};

/// All whose guides are compared here, for the strictness of the tests.
const GUIDED: usize = 5;

pub fn shining(radiance: [f64; 3], two_sided: bool) -> Material {
    Material::Emissive(Box::new(Emissive {
        amount: Amount::Radiance(radiance).into(),
        color: [1.0; 3].into(),
        two_sided,
        group: LightGroup::default(),
    }))
}

pub fn powered(power: [f64; 3], two_sided: bool) -> Material {
    Material::Emissive(Box::new(Emissive {
        amount: Amount::Power(power).into(),
        color: [1.0; 3].into(),
        two_sided,
        group: LightGroup::default(),
    }))
}

pub fn inline(material: Material) -> MaterialRef {
    MaterialRef::Inline(Box::new(material.into()))
}

pub fn rectangle(center: Vec3, normal: Vec3, size: [f64; 2], material: Material) -> Object {
    Object::Rectangle(Box::new(Rectangle {
        center: center.into(),
        normal: normal.into(),
        size: PerAxis(size).into(),
        material: inline(material),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

pub fn cuboid(center: Vec3, size: Vec3, material: Material, transform: Vec<Transform>) -> Object {
    Object::Box(Box::new(RectBox {
        center: center.into(),
        size: PerAxis(size).into(),
        rounding: 0.0.into(),
        material: inline(material),
        transform: transform.into_iter().map(Into::into).collect(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

fn floor() -> Object {
    rectangle([0.0; 3], [0.0, 1.0, 0.0], [8.0, 8.0], diffuse([0.7, 0.6, 0.5]))
}

fn view(objects: Vec<Object>) -> SceneDesc {
    scene(32, Vec::new(), objects).camera([0.5, 2.5, 6.0], [0.0, 0.8, 0.0], 45.0).bounces(3)
}

/// A square lamp that faces down, sideways, to both sides; sheared, so that it is no rectangle; mirrored copies.
#[test]
fn rectangles_as_the_reference_sees_them() {
    let samples = Samples { engine: 512, reference: 512 };
    let down = rectangle([0.0, 2.0, 0.0], [0.0, -1.0, 0.0], [1.0, 0.6], shining([9.0, 7.0, 5.0], false));
    let ball = sphere([-0.8, 0.6, 0.3], 0.6, diffuse([0.3, 0.5, 0.8]));
    assert_same_picture("lamp above", &view(vec![floor(), down, ball.clone()]), samples);
    let panel =
        |two_sided| rectangle([1.0, 0.9, -0.3], [-1.0, 0.2, 0.4], [1.2, 0.7], shining([4.0, 5.0, 6.0], two_sided));
    let polished = sphere([-0.8, 0.6, 0.3], 0.6, blinn_phong([0.5; 3], 80.0, 0.2));
    assert_same_picture("panel", &view(vec![floor(), panel(false), polished.clone()]), samples);
    assert_same_picture("two sides", &view(vec![floor(), panel(true), polished]), samples);
    let mut sheared = panel(false);
    if let Object::Rectangle(rectangle) = &mut sheared {
        let steps = [
            rotate([0.3, 0.2, 1.0], 35.0),
            Transform::Scale { factor: [1.0, 1.8, 0.6], about: None },
            rotate([0.0, 1.0, 0.4], -20.0),
        ];
        rectangle.transform = steps.map(Into::into).to_vec();
        let turned = |z: f64| vec![Transform::Scale { factor: [1.0, 1.0, z], about: Some(Box::new([0.0; 3])) }.into()];
        rectangle.placements = [turned(1.0), turned(-1.0)].into_iter().collect();
    }
    // One tile is lit by so few paths that 512 samples of the reference are no sum that a normal distribution
    // describes.
    let samples = Samples { engine: 512, reference: 8192 };
    assert_same_picture("sheared and mirrored", &view(vec![floor(), sheared, ball]), samples);
}

/// A box, a mesh of triangles and a sphere that shine outwards only, beside a lamp.
#[test]
fn bodies_as_the_reference_sees_them() {
    let samples = Samples { engine: 512, reference: 512 };
    let turned = vec![rotate([0.3, 1.0, 0.2], 40.0)];
    let cube = cuboid([0.9, 0.8, 0.0], [0.5, 0.8, 0.3], powered([30.0, 20.0, 10.0], false), turned);
    let ring = torus(0.3, 10, 6).obj("torus-10-6");
    let ring =
        mesh(&ring, shining([1.0, 2.0, 3.0], false), Shading::Flat, vec![Transform::Translate([-0.9, 1.2, -0.5])]);
    let ball = sphere([-0.2, 0.4, 1.4], 0.3, powered([3.0, 4.0, 2.0], false));
    let mut desc = view(vec![floor(), cube, ring, ball, sphere([0.1, 0.5, 0.2], 0.5, diffuse([0.6; 3]))]);
    desc.lights.push(Light::SphereLight(light([1.0, 3.0, 1.0], 0.2, [20.0; 3])).into());
    assert_same_picture("bodies", &desc, samples);
    // From within a body that shines outwards only comes nothing; from one with two sides it comes.
    let inside = |two_sided| {
        let around = sphere([0.0, 1.0, 0.0], 9.0, shining([0.5, 0.7, 0.9], two_sided));
        view(vec![floor(), around, sphere([-0.8, 0.6, 0.3], 0.6, diffuse([0.3, 0.5, 0.8]))])
    };
    let dark = film(&compiled(&inside(false)), 4, 1);
    assert!((0..32).all(|y| (0..32).all(|x| dark.radiance(x, y) == [0.0; 3])));
    assert_same_picture("within", &inside(true), samples);
}

/// Light of flat lamps over glass and mirrors is the same by guides and light paths as by paths alone.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn over_glass_and_mirrors() {
    let on_floor = |lamps: Vec<Object>, object: Object| {
        let floor = rectangle([0.0; 3], [0.0, 1.0, 0.0], [40.0, 40.0], diffuse([0.8, 0.6, 0.4]));
        scene(32, Vec::new(), [vec![floor, object], lamps].concat())
            .camera([-3.0, 14.0, 18.0], [-1.0, 0.0, 0.0], 40.0)
            .bounces(6)
    };
    let high = |two_sided| rectangle([6.0, 14.0, 0.0], [-0.4, -1.0, 0.0], [8.0, 6.0], shining([10.0; 3], two_sided));
    let ball = |y: f64, material| sphere([0.0, y, 0.0], 2.5, material);
    assert_guiding_is_unbiased("glass under a panel", &on_floor(vec![high(false)], ball(3.0, glass(1.5))), 512, GUIDED);
    let standing = rectangle([-4.5, 2.5, 0.0], [1.0, 0.0, 0.1], [5.0, 5.0], shining([6.0, 8.0, 10.0], true));
    assert_guiding_is_unbiased(
        "mirror beside a panel",
        &on_floor(vec![standing], ball(2.6, mirror([0.9; 3]))),
        512,
        GUIDED,
    );
    // The lamp's plane cuts the ball.
    let cutting = rectangle([6.5, 2.5, 0.0], [0.0, 1.0, 0.0], [6.0, 6.0], shining([6.0, 8.0, 10.0], false));
    assert_guiding_is_unbiased(
        "beside its plane",
        &on_floor(vec![cutting, high(false)], ball(3.0, glass(1.5))),
        512,
        GUIDED,
    );
    let block = cuboid([6.0, 9.0, 1.0], [4.0, 3.0, 5.0], shining([8.0; 3], false), vec![rotate([1.0, 0.3, 0.2], 30.0)]);
    assert_guiding_is_unbiased("under a box", &on_floor(vec![block], ball(2.6, mirror([0.9, 0.7, 0.3]))), 512, GUIDED);
    let lump = icosphere(1).obj("icosphere-1");
    let steps = vec![scale(3.5), Transform::Translate([6.0, 12.0, 0.0])];
    let lump = mesh(&lump, shining([10.0; 3], false), Shading::Flat, steps);
    assert_guiding_is_unbiased("under a mesh", &on_floor(vec![lump], ball(3.0, glass(1.5))), 512, GUIDED);
}

/// A lamp is the same light whichever word says it.
#[test]
fn a_sphere_that_shines_is_a_sphere_light() {
    let with = |lights: Vec<SphereLight>, objects: Vec<Object>| {
        let ball = sphere([-0.8, 0.6, 0.3], 0.6, mirror([0.9; 3]));
        scene(32, lights, [vec![floor(), ball], objects].concat()).camera([0.5, 2.5, 6.0], [0.0, 0.8, 0.0], 45.0)
    };
    let (center, radius, radiance) = ([1.0, 2.0, 0.5], 0.25, [40.0, 50.0, 30.0]);
    let ball = sphere(center, radius, shining(radiance, true));
    // The same random numbers; but the middle of the scene, and with it all rounding, is not quite the same.
    let mean = |desc: SceneDesc| {
        let picture = film(&compiled(&desc), 64, 1);
        (0..1024).map(|k| picture.radiance(k % 32, k / 32)[1]).sum::<f64>()
    };
    let (word, object) = (mean(with(vec![light(center, radius, radiance)], vec![])), mean(with(vec![], vec![ball])));
    assert!((word / object - 1.0).abs() < 1e-3, "{word} {object}");
}

/// Irradiance right under the middle of a square lamp of side 2a at height h that faces down, of radiance one: the four
/// corners' form factors (Howell: A Catalog of Radiation Heat Transfer Configuration Factors, B-3), E = 4 a /
/// sqrt(a^2 + h^2) atan(a / sqrt(a^2 + h^2)).
#[test]
fn light_under_a_square_lamp() {
    for (a, h) in [(0.5, 1.0), (2.0, 1.0), (0.05, 1.0), (0.5, 0.05)] {
        let lamp = rectangle([0.0, h, 0.0], [0.0, -1.0, 0.0], [2.0 * a; 2], shining([1.0; 3], false));
        let ground = rectangle([0.0; 3], [0.0, 1.0, 0.0], [4.0; 2], diffuse([0.5; 3]));
        // From within the gap, down at a spot that is small beside both.
        let mut desc = scene(8, Vec::new(), vec![ground, lamp]).bounces(0);
        desc = desc.camera([0.4 * a, 0.5 * h, 0.0], [0.0; 3], 0.01);
        let picture = film(&compiled(&desc), 1024, 5);
        let mean = (0..64).map(|k| picture.radiance(k % 8, k / 8)[0]).sum::<f64>() / 64.0;
        let s = (a * a + h * h).sqrt();
        let expected = 0.5 / std::f64::consts::PI * 4.0 * a / s * (a / s).atan();
        let error = (0..64).map(|k| picture.variance(k % 8, k / 8)).sum::<f64>().sqrt() / 64.0;
        // Four cases: 4.5 standard errors are left by chance once in 40,000 runs. Rays start off the ground by what
        // single precision does not tell of a square 4 wide, 1e-6 of it, and light falls with the square of the
        // distance at most.
        assert!((mean - expected).abs() < 4.5 * error + 1e-5 * expected, "{a} {h}: {mean} +- {error}, not {expected}");
    }
}

/// The square of two triangles in a file, and the word: the same place, and the same light.
#[test]
fn a_square_of_a_file_shines_like_the_word() {
    let file = square(1.0).obj("square-1");
    let steps = || vec![rotate([0.0, 0.0, 1.0], 180.0), Transform::Translate([0.0, 2.0, 0.0])];
    let word = {
        let mut word = rectangle([0.0; 3], [0.0, 1.0, 0.0], [2.0, 2.0], shining([3.0; 3], false));
        if let Object::Rectangle(rectangle) = &mut word {
            rectangle.transform = steps().into_iter().map(Into::into).collect();
        }
        word
    };
    let of_file = mesh(&file, shining([3.0; 3], false), Shading::Flat, steps());
    let samples = Samples { engine: 512, reference: 512 };
    assert_same_picture("a square's file", &view(vec![floor(), of_file]), samples);
    assert_same_picture("a square's word", &view(vec![floor(), word]), samples);
}

/// A lamp at the origin of render space, where its coordinates are next to nothing and those of what it lights are not:
/// no ray to it ends in it, as a sixth of them did. A point of a floor at h = 1 below gets the integral of
/// L albedo h^2 / (pi d^4) over its area. Over a lamp of 0.02 d^4 is within 0.06 of its mean, so that 900 pixels of 64
/// samples are right to 4.5 standard errors of at most 0.06 / sqrt(57600).
#[test]
fn a_lamp_at_the_origin_is_not_in_its_own_way() {
    let (eye, look_at) = (DVec3::new(0.4, 2.5, 1.5), DVec3::ZERO);
    let lamp = rectangle([0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.02; 2], shining([5.0; 3], false));
    let floor = rectangle([0.0; 3], [0.0, 1.0, 0.0], [60.0; 2], diffuse([0.5; 3]));
    // They bring the origin to the lamp.
    let specks = [-0.3, 0.3].map(|z| sphere([0.0, 1.0, z], 1e-4, diffuse([0.0; 3])));
    let desc = scene(SIZE, vec![], [vec![lamp, floor], specks.to_vec()].concat())
        .camera(eye.to_array(), look_at.to_array(), 40.0)
        .bounces(0)
        .filter(PixelFilter::None);
    let scene = compiled(&desc);
    let at = scene.frame.point(DVec3::Y).length();
    assert!(at < 1e-3, "the lamp is {at} off the origin");
    let film = film(&scene, 64, 1);
    let (mut seen, mut expected, mut pixels) = (0.0, 0.0, 0);
    for (k, p) in (0u32..).zip(points(eye, look_at, DVec3::Y, 40.0)) {
        // Where the way from the eye passes the height of the lamp.
        let beside = p.lerp(eye, 1.0 / eye.y);
        if beside.x.abs().max(beside.z.abs()) < 0.02 {
            continue;
        }
        let of_lamp =
            (0..64).map(|k| DVec3::new(f64::from(k % 8) - 3.5, 0.0, f64::from(k / 8) - 3.5) * 0.0025 + DVec3::Y);
        let sum: f64 = of_lamp.map(|q| q.distance_squared(p).powi(-2)).sum();
        expected += 5.0 * 0.5 / std::f64::consts::PI * sum * 0.0004 / 64.0;
        seen += film.radiance(k % SIZE, k / SIZE)[0];
        pixels += 1;
    }
    let ratio = seen / expected;
    assert!(pixels > 900 && (ratio - 1.0).abs() < 0.0012, "{ratio} of the light on {pixels} pixels");
}
