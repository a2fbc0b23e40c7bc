//! Curved shapes that shine and are no spheres: as paths of the reference see them, against closed forms, and by guided
//! rays and light paths as by paths alone.

use crate::curved::{capsule, cone, cylinder, disk, shear, stretch, turned};
use crate::shining::{inline, powered, rectangle, shining};
use crate::support::compare::{Samples, assert_guiding_is_unbiased, assert_same_picture, assert_same_scenes};
use crate::support::describe::*;
use crate::support::{compiled, film};
use glam::DVec3;
use scene_format::SceneDesc;
use scene_format::desc::{Corners, Material, MaterialRef, Name, Object, Placements, Polygon, Transform, Vec3};
use std::f64::consts::PI;
use tracer_core::scene::Light;

/// All whose guides are compared here, for the strictness of the tests.
const GUIDED: usize = 6;

fn floor(size: f64) -> Object {
    rectangle([0.0; 3], [0.0, 1.0, 0.0], [size; 2], diffuse([0.7, 0.6, 0.5]))
}

fn view(objects: Vec<Object>) -> SceneDesc {
    let ball = sphere([-0.8, 0.6, 0.3], 0.6, diffuse([0.3, 0.5, 0.8]));
    scene(32, Vec::new(), [vec![floor(8.0), ball], objects].concat())
        .camera([0.5, 2.5, 6.0], [0.0, 0.8, 0.0], 45.0)
        .bounces(3)
}

/// Each shape, to one side and to both, stretched, sheared, mirrored and copied.
#[test]
fn lamps_as_the_reference_sees_them() {
    let samples = Samples { engine: 512, reference: 1024 };
    let (warm, cold) = ([9.0, 7.0, 5.0], [4.0, 5.0, 6.0]);
    let same = |name: &str, lamps: Vec<Object>| assert_same_picture(name, &view(lamps), samples);
    same("disk above", vec![disk([0.3, 2.0, 0.0], [0.2, -1.0, 0.0], [0.6, 0.0], shining(warm, false))]);
    let ring = |two_sided| disk([1.0, 0.9, -0.3], [-1.0, 0.2, 0.4], [0.7, 0.4], shining(cold, two_sided));
    same("ring", vec![ring(false)]);
    same("ring with two sides", vec![turned(ring(true), stretch())]);
    let tube = |caps, two_sided| cylinder([0.6, 0.3, 0.6], [1.6, 1.1, -0.2], 0.3, caps, shining(cold, two_sided));
    same("closed cylinder", vec![tube(true, false)]);
    same("open cylinder", vec![tube(false, false)]);
    same("open cylinder with two sides", vec![turned(tube(false, true), stretch())]);
    let shade = |caps, two_sided| cone([0.8, 1.0, 0.0], [0.9, 1.8, 0.0], [0.7, 0.2], caps, shining(warm, two_sided));
    same("shade", vec![shade(false, true)]);
    same("closed cone", vec![turned(shade(true, false), shear())]);
    same("cone with a tip", vec![cone([0.9, 0.4, 0.2], [0.7, 1.7, 0.1], [0.5, 0.0], true, shining(warm, true))]);
    same("capsule", vec![turned(capsule([0.6, 0.4, 0.5], [1.5, 1.2, 0.0], 0.25, shining(cold, false)), stretch())]);
    let mut copied = turned(sphere([0.0; 3], 0.5, powered([20.0, 30.0, 10.0], false)), stretch());
    let there = |x: f64, mirrored: f64| {
        let factor = [0.6, 0.6, 0.6 * mirrored];
        vec![Transform::Scale { factor, about: None }.into(), Transform::Translate([x, 1.2, 0.4]).into()]
    };
    *copied.placements_mut() = [there(1.0, 1.0), there(0.1, -1.0)].into_iter().collect();
    same("copied ellipsoids", vec![copied]);
}

/// Beside each other, a sphere and a square among them, over glass and a glossy surface.
#[test]
fn lamps_of_all_kinds() {
    let glossy = sphere([0.2, 0.4, 1.2], 0.4, blinn_phong([0.5; 3], 80.0, 0.2));
    let lamps = vec![
        disk([0.0, 2.0, 0.5], [0.0, -1.0, 0.0], [0.4, 0.0], shining([6.0, 5.0, 4.0], false)),
        capsule([1.2, 0.3, 0.4], [1.6, 0.9, 0.0], 0.15, powered([5.0, 9.0, 4.0], false)),
        cylinder([-1.8, 0.1, -0.5], [-1.6, 1.8, -0.5], 0.1, true, powered([9.0, 4.0, 3.0], false)),
        sphere([0.9, 0.2, 1.6], 0.2, shining([3.0; 3], false)),
        rectangle([0.0, 1.2, -1.5], [0.0, 0.0, 1.0], [1.0, 0.5], shining([2.0; 3], true)),
    ];
    let samples = Samples { engine: 1024, reference: 4096 };
    assert_same_picture("lamps of all kinds", &view([lamps, vec![glossy]].concat()), samples);
}

/// In a closed shape that shines inwards all directions bring the same: a ball of albedo a shows a L, all else L.
#[test]
fn within_what_shines_all_is_alike() {
    let lamp = || shining([0.5, 0.7, 0.9], true);
    let around = [
        ("ellipsoid", turned(sphere([0.0; 3], 4.0, lamp()), stretch())),
        ("cylinder", cylinder([0.0, -5.0, 0.0], [0.0, 5.0, 1.0], 3.0, true, lamp())),
        ("cone", cone([0.0, -5.0, 0.0], [0.0, 9.0, 1.0], [4.0, 0.0], true, lamp())),
        ("capsule", capsule([0.0, -1.0, 0.0], [0.3, 3.0, 1.0], 2.5, lamp())),
    ];
    for (name, lamp) in around {
        let ball = sphere([0.0; 3], 0.6, diffuse([0.4; 3]));
        let desc = scene(16, Vec::new(), vec![ball, lamp]).camera([0.3, 0.2, 1.7], [0.0; 3], 70.0).bounces(0);
        let picture = film(&compiled(&desc), 256, 3);
        let mean = (0..16).map(|k| picture.radiance(6 + k % 4, 6 + k / 4)[0]).sum::<f64>() / 16.0;
        assert!((mean - 0.4 * 0.5).abs() < 2e-3, "{name}: {mean}");
        let corner = picture.radiance(0, 0);
        assert!((0..3).all(|k| (corner[k] - [0.5, 0.7, 0.9][k]).abs() < 1e-6), "{name}: {corner:?}");
        let dark = scene(
            16,
            Vec::new(),
            desc.objects
                .iter()
                .map(|object| {
                    let mut object = object.value.clone();
                    if let Some(material) = one_sided(&object) {
                        *object.material_mut() = material;
                    }
                    object
                })
                .collect(),
        );
        let dark = dark.camera([0.3, 0.2, 1.7], [0.0; 3], 70.0).bounces(0);
        let picture = film(&compiled(&dark), 4, 3);
        assert!((0..256).all(|k| picture.radiance(k % 16, k / 16) == [0.0; 3]), "{name} shines inwards");
    }
}

/// The same lamp to the outside only, where it is one.
fn one_sided(object: &Object) -> Option<MaterialRef> {
    let MaterialRef::Inline(material) = object.material() else { return None };
    matches!(material.value, Material::Emissive(_)).then(|| inline(shining([0.5, 0.7, 0.9], false)))
}

/// What a spot of albedo one half shows right under a lamp, as the mean over a picture of it and its error.
fn spot(lamp: Object, floor: f64, camera: [f64; 3], samples: u32) -> (f64, f64) {
    let ground = rectangle([0.0; 3], [0.0, 1.0, 0.0], [floor; 2], diffuse([0.5; 3]));
    let desc = scene(8, Vec::new(), vec![ground, lamp]).bounces(0).camera(camera, [0.0; 3], 0.01);
    let picture = film(&compiled(&desc), samples, 5);
    let mean = (0..64).map(|k| picture.radiance(k % 8, k / 8)[0]).sum::<f64>() / 64.0;
    let error = (0..64).map(|k| picture.variance(k % 8, k / 8)).sum::<f64>().sqrt() / 64.0;
    (mean, error)
}

/// Irradiance right under the middle of a disk of radius r at height h, of radiance one: pi r^2 / (r^2 + h^2) (Howell:
/// A Catalog of Radiation Heat Transfer Configuration Factors, B-13); with a hole the difference of two.
#[test]
fn light_under_a_disk() {
    let cases = [(0.5, 0.0), (2.0, 0.0), (2.0, 1.5), (0.05, 0.0), (1e-4, 0.0), (20.0, 0.0)];
    for ((r, hole), h) in cases.into_iter().flat_map(|case| [1.0, 0.05, 30.0].map(|h| (case, h))) {
        let lamp = disk([0.0, h, 0.0], [0.0, -1.0, 0.0], [r, hole], shining([1.0; 3], false));
        let (mean, error) = spot(lamp, 4.0 * h, [0.3 * h, 0.6 * h, 0.0], 1024);
        let of = |r: f64| r * r / (r * r + h * h);
        let expected = 0.5 * (of(r) - of(hole));
        // Rays start off the ground by what single precision does not tell, and light falls with the square of the
        // distance at most.
        assert!(
            (mean - expected).abs() < 4.8 * error + 3e-5 * expected,
            "{r} {hole} {h}: {mean} +- {error}, not {expected}"
        );
    }
}

/// Irradiance of what faces a very long cylinder of radius a, d away from its axis, of radiance one: pi a / d. A
/// capsule's is the same; what is squeezed across shines as wide as it looks.
#[test]
fn light_beside_a_long_cylinder() {
    for (a, d) in [(0.5, 1.0), (0.1, 1.0), (1e-3, 1.0), (9.0, 10.0), (0.999, 1.0)] {
        let long = 3e3 * d;
        let ends = [[-long, d, 0.0], [long, d, 0.0]];
        let lamp = || shining([1.0; 3], false);
        let lamps = [
            ("closed", cylinder(ends[0], ends[1], a, true, lamp())),
            ("open", cylinder(ends[0], ends[1], a, false, lamp())),
            ("capsule", capsule(ends[0], ends[1], a, lamp())),
            ("cone", cone(ends[0], ends[1], [1.000_001 * a, 0.999_999 * a], true, lamp())),
        ];
        for (name, lamp) in lamps {
            let gap = d - a;
            let (mean, error) = spot(lamp, 4.0 * d, [0.3 * d, 0.5 * gap, 0.0], 1024);
            let expected = 0.5 * a / d;
            assert!(
                (mean - expected).abs() < 4.8 * error + 1e-4 * expected,
                "{name} {a} {d}: {mean} +- {error}, not {expected}"
            );
        }
    }
}

/// A polygon of many corners on a circle.
fn ngon(center: Vec3, normal: Vec3, radius: f64, count: u32, material: Material) -> Object {
    let (center, normal) = (DVec3::from(center), DVec3::from(normal).normalize());
    let (right, up) = normal.any_orthonormal_pair();
    // Counter-clockwise, seen from its front.
    let up = if right.cross(up).dot(normal) > 0.0 { up } else { -up };
    let corner = |k: u32| {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(count);
        (center + radius * (right * angle.cos() + up * angle.sin())).to_array()
    };
    Object::Polygon(Box::new(Polygon {
        points: Corners((0..count).map(corner).collect()).into(),
        material: inline(material),
        transform: Vec::new(),
        placements: Placements::One,
        camera_visible: true,
        name: Name::default(),
    }))
}

/// A disk is a polygon of very many corners; a sphere that a map squeezes by nothing to speak of is a sphere; a
/// cylinder is a cone.
#[test]
fn lamps_that_are_the_same() {
    let at = [0.3, 1.6, 0.0];
    let around = disk(at, [0.2, -1.0, 0.1], [0.6, 0.0], shining([9.0, 7.0, 5.0], false));
    let corners = ngon(at, [0.2, -1.0, 0.1], 0.6, 400, shining([9.0, 7.0, 5.0], false));
    assert_same_scenes("disk and polygon", &view(vec![around]), &view(vec![corners]), 256);
    let squeezed = vec![Transform::Scale { factor: [1.0, 1.0, 1.000_000_1], about: None }];
    let ball = || sphere([0.9, 1.2, 0.2], 0.4, shining([9.0, 7.0, 5.0], false));
    let (plain, ellipsoid) = (view(vec![ball()]), view(vec![turned(ball(), squeezed)]));
    assert!(matches!(compiled(&plain).lights[..], [Light::Sphere { .. }]));
    assert!(matches!(compiled(&ellipsoid).lights[..], [Light::Curved(_)]));
    assert_same_scenes("sphere and ellipsoid", &plain, &ellipsoid, 256);
    let [from, to] = [[0.6, 0.3, 0.6], [1.6, 1.1, -0.2]];
    let cylinder = cylinder(from, to, 0.3, true, powered([20.0, 10.0, 5.0], false));
    let cone = cone(from, to, [0.300_000_1, 0.299_999_9], true, powered([20.0, 10.0, 5.0], false));
    assert_same_scenes("cylinder and cone", &view(vec![cylinder]), &view(vec![cone]), 256);
}

/// Radiance by power: P / (pi A) of the true area, for each copy.
#[test]
fn power_is_of_the_true_area() {
    let radiance = |lamp: Object| {
        let scene = compiled(&view(vec![lamp]));
        scene.lights.iter().map(|light| light.radiance()[0] * scene.radiance_unit).collect::<Vec<_>>()
    };
    let near = |lamp: Object, area: f64| {
        let told = radiance(lamp);
        assert!(told.iter().all(|l| (l * PI * area - 10.0).abs() < 1e-6), "{told:?}, not {}", 10.0 / (PI * area));
    };
    let (up, lamp) = ([0.0, 1.0, 0.0], |two_sided| powered([10.0; 3], two_sided));
    near(disk(up, up, [0.5, 0.3], lamp(false)), PI * 0.16);
    near(disk(up, up, [0.5, 0.3], lamp(true)), 2.0 * PI * 0.16);
    near(cylinder(up, [0.0, 2.0, 0.0], 0.5, true, lamp(false)), PI * 1.5);
    near(cylinder(up, [0.0, 2.0, 0.0], 0.5, false, lamp(true)), 2.0 * PI);
    near(cone(up, [0.0, 2.2, 0.0], [0.5, 0.0], true, lamp(false)), PI * 0.5 * (0.5 + 1.3));
    near(capsule(up, [0.0, 2.0, 0.0], 0.5, lamp(false)), PI * 2.0);
    // A prolate spheroid: 2 pi b^2 (1 + a / (b e) asin e).
    let long = vec![Transform::Scale { factor: [1.0, 2.0, 1.0], about: None }];
    let e = 0.75f64.sqrt();
    near(turned(sphere(up, 0.5, lamp(false)), long), PI * 0.5 * (1.0 + 2.0 / e * e.asin()));
}

/// Light over glass and mirrors is the same by guides and light paths as by paths alone.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn over_glass_and_mirrors() {
    let on_floor = |lamp: Object, object: Object| {
        scene(32, Vec::new(), vec![floor(40.0), object, lamp])
            .camera([-3.0, 14.0, 18.0], [-1.0, 0.0, 0.0], 40.0)
            .bounces(6)
    };
    let ball = |y: f64, material| sphere([0.0, y, 0.0], 2.5, material);
    let same = |name: &str, lamp: Object, object: Object| {
        assert_guiding_is_unbiased(name, &on_floor(lamp, object), 512, GUIDED);
    };
    let bright = |two_sided| shining([14.0, 12.0, 10.0], two_sided);
    same("under a disk", disk([6.0, 14.0, 0.0], [-0.4, -1.0, 0.0], [4.0, 1.0], bright(false)), ball(3.0, glass(1.5)));
    let tube = cylinder([-5.5, 1.0, -3.0], [-4.5, 5.0, 4.0], 0.8, true, bright(false));
    same("beside a cylinder", tube, ball(2.6, mirror([0.9; 3])));
    let shade = cone([5.0, 8.0, 0.0], [6.0, 14.0, 0.0], [4.0, 1.0], false, bright(true));
    same("under a shade", shade, ball(3.0, glass(1.5)));
    let long = capsule([6.0, 9.0, -4.0], [7.0, 12.0, 4.0], 1.0, bright(false));
    same(
        "under a capsule",
        turned(long, vec![Transform::Scale { factor: [1.0, 0.6, 1.4], about: None }]),
        ball(3.0, glass(1.5)),
    );
    let egg = turned(sphere([6.0, 12.0, 0.0], 3.0, bright(false)), stretch());
    same("under an ellipsoid", egg, ball(2.6, mirror([0.9, 0.7, 0.3])));
    // So near that neither is apart from the other.
    let close = cone([3.0, 1.0, 0.0], [3.5, 6.0, 0.0], [1.5, 0.0], true, bright(false));
    same("beside a cone", close, ball(2.6, glass(1.5)));
}
