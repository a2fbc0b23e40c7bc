//! What stands between the words of a scene and the engine, against formulas: reference and engine both start from the
//! compiled scene, so comparing them shows nothing about it.

use crate::support::describe::*;
use crate::support::meshes::{icosphere, square};
use crate::support::{compiled, effort, film};
use glam::{DMat3, DVec3};
use scene_format::SceneDesc;
use scene_format::desc::{Amount, Instances, LightGroup, Name, Object, Shading, SphereLight, Transform};
use std::f64::consts::PI;
use std::path::Path;
use tracer_core::Scene;
use tracer_core::scene::NONE;
use tracer_reference::statistics::Estimate;

/// In a picture four times as wide as high, pixels are squares and `fov` spans the height: a small lamp is seen where
/// its direction says, height/(2 tan(fov/2)) pixels per unit of slope in both directions.
#[test]
fn a_wide_picture_has_square_pixels() {
    let (width, height, fov) = (64u32, 16u32, 40.0f64);
    let slope = (fov / 2.0).to_radians().tan();
    let (x, y) = (2.0 * slope, -0.5 * slope);
    // A sphere of angular radius rho is seen as an ellipse whose middle is off by some rho^2 of the slope: 0.02 pixels.
    let mut desc = scene(8, vec![light([10.0 * x, 10.0 * y, -10.0], 0.3, [1.0; 3])], vec![]).camera(
        [0.0; 3],
        [0.0, 0.0, -1.0],
        fov,
    );
    desc.image.width = width.into();
    desc.image.height = height.into();
    let film = film(&compiled(&desc), 1024, 1);
    let (mut sum, mut column, mut row) = (0.0, 0.0, 0.0);
    for (i, j) in (0..height).flat_map(|j| (0..width).map(move |i| (i, j))) {
        let weight = film.radiance(i, j)[0];
        sum += weight;
        column += weight * (f64::from(i) + 0.5);
        row += weight * (f64::from(j) + 0.5);
    }
    let per_slope = f64::from(height) / (2.0 * slope);
    let expected = [f64::from(width) / 2.0 + x * per_slope, f64::from(height) / 2.0 - y * per_slope];
    let seen = [column / sum, row / sum];
    assert!((seen[0] - expected[0]).abs() < 0.1 && (seen[1] - expected[1]).abs() < 0.1, "{seen:?} not {expected:?}");
}

/// A lamp of intensity I lights a surface at distance d head on with I/d^2, whatever its radius (a sphere of even
/// radiance lights as if it were in its middle); one of power P has I = P/(4 pi). A floor of albedo a shows a E/pi.
#[test]
fn lamps_have_the_intensity_and_power_that_they_name() {
    let (distance, albedo) = (7.0, 0.6);
    for radius in [0.01, 0.8] {
        let words = [
            (Amount::Intensity([30.0, 20.0, 10.0]), [30.0, 20.0, 10.0]),
            (Amount::Power([500.0, 700.0, 900.0]), [500.0, 700.0, 900.0].map(|p| p / (4.0 * PI))),
            (Amount::Radiance([2.0, 3.0, 4.0]), [2.0, 3.0, 4.0].map(|l| l * PI * radius * radius)),
            (Amount::LuminousIntensity(683.0 * 40.0), [40.0; 3]),
            (Amount::LuminousPower(683.0 * 800.0), [800.0 / (4.0 * PI); 3]),
        ];
        for (amount, intensity) in words {
            let lamp = SphereLight {
                center: [0.0, distance, 0.0].into(),
                radius: radius.into(),
                amount: amount.clone().into(),
                color: [1.0; 3],
                camera_visible: true,
                name: Name::default(),
                group: LightGroup::default(),
            };
            let floor = mesh(&square(1.0).obj("square-1"), diffuse([albedo; 3]), Shading::Flat, vec![]);
            let desc = scene(8, vec![lamp], vec![floor]).camera([-0.3, 0.4, 0.0], [0.0, 0.0, 0.0], 0.01).bounces(0);
            let compiled = compiled(&desc);
            for (channel, intensity) in intensity.into_iter().enumerate() {
                let mean = |seed| {
                    let film = film(&compiled, 64 * effort(), seed);
                    (0..64).map(|k| film.radiance(k % 8, k / 8)[channel]).sum::<f64>() / 64.0
                };
                let estimate = Estimate::of(&(0..16).map(mean).collect::<Vec<_>>());
                let expected = albedo * intensity / (distance * distance) / PI;
                // 18 means with 15 degrees of freedom: 4.8 standard errors pass 996 of 1000 right engines. f32 is wrong
                // by 20 roundings.
                assert!(estimate.error() < 2e-3 * expected, "too noisy to tell");
                assert!(
                    (estimate.mean - expected).abs() < 4.8 * estimate.error() + 1.2e-6 * expected,
                    "radius {radius} {amount:?} channel {channel}: {} +- {} is not {expected}",
                    estimate.mean,
                    estimate.error()
                );
            }
        }
    }
}

/// One mesh, stretched about the origin.
fn stretched(file: &Path, factor: [f64; 3], shading: Shading) -> SceneDesc {
    let steps = vec![Transform::Scale { factor, about: Some(Box::new([0.0; 3])) }];
    let object = mesh(file, diffuse([0.5; 3]), shading, steps);
    scene(8, vec![], vec![object]).camera([0.0, 0.0, 9.0], [0.0; 3], 40.0)
}

/// Volume that the triangles enclose in the world, negative where they are seen from within: sum of a.(b x c)/6.
fn volume(scene: &Scene) -> f64 {
    let scale = scene.frame.scale;
    let corners = (0..scene.triangles.vertices.len() as u32).map(|k| scene.triangles.corners(k).expect("a triangle"));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum::<f64>() / (scale * scale * scale)
}

/// What was outside stays outside, also where a mesh is mirrored.
#[test]
fn mirrored_meshes_are_not_inside_out() {
    let file = icosphere(2).off("icosphere-2");
    let plain = volume(&compiled(&stretched(&file, [1.0; 3], Shading::Flat)));
    assert!(plain > 3.9 && plain < 4.19, "{plain}");
    for factor in [[-1.0, 1.0, 1.0], [2.0, -3.0, 0.5], [-1.0, -1.0, 1.0], [-0.7; 3]] {
        let expected = plain * factor.iter().product::<f64>().abs();
        let there = volume(&compiled(&stretched(&file, factor, Shading::Flat)));
        // Vertices are rounded to f32: 6e-8 of the size each.
        assert!((there / expected - 1.0).abs() < 1e-6, "{factor:?}: {there} not {expected}");
    }
}

/// A ball with its normals, stretched to an ellipsoid: at (x, y, z) the normal is along (x/a^2, y/b^2, z/c^2),
/// outwards.
#[test]
fn normals_stay_upright_when_a_mesh_is_stretched() {
    let file = icosphere(2).obj("icosphere-2");
    for factor in [[1.0, 2.0, 0.5], [1.0, 3.0, -0.4], [-2.0, -1.0, -0.5]] {
        let scene = compiled(&stretched(&file, factor, Shading::Smooth));
        for triangle in 0..scene.triangles.vertices.len() as u32 {
            let corners = scene.triangles.corners(triangle).expect("a triangle");
            let normals = scene.triangles.corner_normals(triangle).expect("a smooth triangle");
            for (corner, normal) in corners.iter().zip(normals) {
                let p = *corner / scene.frame.scale + scene.frame.centre;
                let f = DVec3::from(factor);
                let expected = (p / (f * f)).normalize();
                assert!(normal.distance(expected) < 1e-6, "{factor:?} at {p}: {normal} not {expected}");
            }
        }
    }
}

/// A matrix that shears and mirrors leaves the outside outside, and normals upright: A^-T of those of the ball.
#[test]
fn normals_stay_upright_under_any_matrix() {
    let file = icosphere(2).obj("icosphere-2");
    let plain = volume(&compiled(&stretched(&file, [1.0; 3], Shading::Flat)));
    for rows in [
        [[1.0, 0.7, 0.0, 0.5], [0.0, 1.0, -0.4, 0.0], [0.3, 0.0, -0.8, 0.1]],
        [[0.0, 1.5, 0.0, 0.0], [1.0, 0.0, 0.2, -2.0], [0.0, 0.6, 1.0, 0.0]],
        [[0.0, 0.0, 1.0, 0.0], [1.0, 0.5, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0]],
    ] {
        let [a, b, c] = rows.map(|[x, y, z, _]| DVec3::new(x, y, z));
        let linear = DMat3::from_cols(a, b, c).transpose();
        let moved = DVec3::from(rows.map(|row| row[3]));
        let steps = vec![Transform::Matrix { rows: Box::new(rows) }];
        let object = mesh(&file, diffuse([0.5; 3]), Shading::Smooth, steps);
        let scene = compiled(&scene(8, vec![], vec![object]).camera([0.0, 0.0, 9.0], [0.0; 3], 40.0));
        let there = volume(&scene) / plain;
        assert!((there / linear.determinant().abs() - 1.0).abs() < 1e-6, "{rows:?}: {there}");
        for triangle in 0..scene.triangles.vertices.len() as u32 {
            let corners = scene.triangles.corners(triangle).expect("a triangle");
            let normals = scene.triangles.corner_normals(triangle).expect("a smooth triangle");
            for (corner, normal) in corners.iter().zip(normals) {
                let ball = linear.inverse() * (*corner / scene.frame.scale + scene.frame.centre - moved);
                let expected = (linear.inverse().transpose() * ball).normalize();
                assert!((ball.length() - 1.0).abs() < 1e-6 && normal.distance(expected) < 1e-6, "{rows:?} at {ball}");
            }
        }
    }
}

/// `Auto` smooths what has normals; the other words do what they say.
#[test]
fn shading_is_as_the_scene_and_the_file_say() {
    let (with, without) = (icosphere(1).obj("icosphere-1"), icosphere(1).off("icosphere-1"));
    for (file, shading, smooth) in [
        (&with, Shading::Auto, true),
        (&with, Shading::Smooth, true),
        (&with, Shading::Flat, false),
        (&without, Shading::Auto, false),
        (&without, Shading::Smooth, true),
        (&without, Shading::Flat, false),
    ] {
        let scene = compiled(&stretched(file, [1.0; 3], shading));
        let count = scene.triangles.vertices.len() as u32;
        assert_eq!(count, 80);
        for triangle in 0..count {
            assert_eq!(scene.triangles.corner_normals(triangle).is_some(), smooth, "{} {shading:?}", file.display());
        }
    }
}

/// Copies of a ball, flattened and as instances: where the one has a triangle, the other's matrix puts it.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn copies_are_flattened_as_the_scene_says() {
    let file = icosphere(1).off("icosphere-1");
    let copies = |count: u32, instances: Instances| {
        let copy = |k: u32| {
            let (k, mirrored) = (f64::from(k), [1.0, -1.0][k as usize % 2]);
            let factor = [mirrored * (1.0 + 0.1 * k), 1.0, 0.7];
            vec![Transform::Scale { factor, about: None }.into(), Transform::Translate([3.0 * k, 0.5, -k]).into()]
        };
        let placements = (0..count).map(copy).collect();
        let mut object = placed(&file, diffuse([0.5; 3]), Shading::Smooth, vec![scale(0.5)], placements);
        if let Object::Mesh(mesh) = &mut object {
            mesh.instances = instances;
        }
        compiled(&scene(8, vec![light([0.0, 9.0, 0.0], 1.0, [1.0; 3])], vec![object]))
    };
    let is_flattened = |scene: &Scene| scene.instances.iter().all(|i| i.placement.is_none());
    let (never, always) = (copies(4, Instances::Never), copies(4, Instances::Always));
    assert!(
        is_flattened(&never)
            && is_flattened(&copies(4, Instances::Auto))
            && is_flattened(&copies(1, Instances::Always))
    );
    assert!(!is_flattened(&always) && !is_flattened(&copies(1025, Instances::Auto)));
    // 80 triangles each.
    assert_eq!(always.triangles.vertices.len(), 80);
    assert_eq!(never.triangles.vertices.len(), 4 * 80);
    for (ours, theirs) in always.instances.iter().zip(never.instances.iter()) {
        let rows = ours.placement.expect("an instance").map(|row| row.map(f64::from));
        let moved = |p: DVec3| DVec3::from(rows.map(|[x, y, z, w]| DVec3::new(x, y, z).dot(p) + w));
        let [x, y, z] = rows.map(|[x, y, z, _]| DVec3::new(x, y, z));
        let inside_out = x.dot(y.cross(z)) < 0.0;
        for k in 0..80 {
            let first = always.meshes[ours.mesh as usize].first_triangle;
            let [a, b, c] = always.triangles.corners(first + k).expect("a triangle").map(moved);
            let [a, b, c] = if inside_out { [a, c, b] } else { [a, b, c] };
            let first = never.meshes[theirs.mesh as usize].first_triangle;
            let corners = never.triangles.corners(first + k).expect("a triangle");
            for (p, q) in [a, b, c].into_iter().zip(corners) {
                // A few roundings to f32 of numbers of about one.
                assert!(p.distance(q) < 1e-6, "triangle {k}: {p} and {q}");
            }
        }
    }
}

/// Each object has its own material: the last of them, and a mesh placed twice, as triangles and as instances.
#[test]
fn objects_have_their_materials() {
    let ball = |x: f64, color| sphere([x, 0.0, 0.0], 0.5, diffuse(color));
    let file = icosphere(1).off("icosphere-1");
    let copy = |x: f64, color| {
        mesh(&file, diffuse(color), Shading::Flat, vec![scale(0.5), Transform::Translate([x, 0.0, 0.0])])
    };
    let colors = [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6], [0.7, 0.8, 0.9], [0.15, 0.35, 0.55]];
    let objects = |instances: Instances| {
        let mut objects =
            vec![ball(-3.0, colors[0]), ball(-1.0, colors[1]), copy(1.0, colors[2]), copy(3.0, colors[3])];
        for object in &mut objects {
            if let Object::Mesh(mesh) = object {
                mesh.instances = instances;
            }
        }
        objects
    };
    let cases = [Instances::Always, Instances::Never].into_iter().flat_map(|i| (0..4).map(move |k| (i, k)));
    for (instances, k) in cases {
        let color = colors[k];
        let x = 2.0 * k as f64 - 3.0;
        let desc = scene(8, vec![], objects(instances))
            .camera([x, 0.0, 6.0], [x, 0.0, 0.0], 0.5)
            .background([1.0; 3])
            .bounces(0);
        let scene = compiled(&desc);
        assert!(scene.instances.iter().all(|i| i.material != NONE), "each mesh object names one material");
        let film = film(&scene, 64, 1);
        let mean = [0, 1, 2].map(|c| (0..64).map(|p| film.radiance(p % 8, p / 8)[c]).sum::<f64>() / 64.0);
        // White all around but for the other objects, which take up to a tenth of the light: the colour is still its
        // own.
        for channel in 0..3 {
            let ratio = mean[channel] / color[channel];
            assert!((0.85..=1.000_01).contains(&ratio), "object {k}: {mean:?} is not {color:?}");
        }
    }
}

/// Every sample is black or white: with mean m of n samples, were they independent, the variance of the mean is
/// m (1 - m)/(n - 1).
#[test]
fn a_film_knows_its_variance() {
    let black =
        mesh(&square(1.0).obj("square-1"), diffuse([0.0; 3]), Shading::Flat, vec![rotate([1.0, 0.0, 0.3], 70.0)]);
    let desc = scene(16, vec![], vec![black]).camera([0.0, 0.0, 6.0], [0.0; 3], 30.0).background([1.0; 3]);
    let film = film(&compiled(&desc), 48, 1);
    let mut mixed = 0;
    for (x, y) in (0..16).flat_map(|y| (0..16).map(move |x| (x, y))) {
        let mean = film.radiance(x, y)[0];
        let expected = mean * (1.0 - mean) / 47.0;
        assert!((film.variance(x, y) - expected).abs() < 1e-12, "{} not {expected}", film.variance(x, y));
        mixed += u32::from(expected > 0.0);
    }
    assert!(mixed > 20, "{mixed}");
}
