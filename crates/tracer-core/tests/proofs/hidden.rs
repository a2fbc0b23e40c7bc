//! What the camera does not see: its rays pass it, and nothing else does.

use crate::caustics::on_the_floor;
use crate::same_bytes::many_balls;
use crate::support::compare::{Samples, assert_guiding_is_unbiased, assert_same_picture, assert_sharing_is_unbiased};
use crate::support::compiled;
use crate::support::describe::*;
use scene_format::desc::{Acceleration, Object, PixelFilter};
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;
use tracer_core::{Layer, LayerSet, RenderOptions, Unobserved, render};
use tracer_reference::first_hits;

/// Comparisons of guided and of shared rays here.
const SCENES: usize = 3;

fn read(text: &str) -> SceneDesc {
    match load_str("hidden", text, Syntax::Ron, Path::new(""), &[]) {
        Ok(loaded) => loaded.scene,
        Err(error) => panic!("{error:?}"),
    }
}

/// Things of every kind that the camera does not see, in its way and in planes with others, and a mirror that shows
/// them.
pub(crate) fn hidden() -> SceneDesc {
    read(
        r#"Scene(
        image: Image(width: 32, height: 32), background: (0.2, 0.25, 0.3), render: Render(max_bounces: 5),
        camera: Camera(position: (0, 1.4, 6), look_at: (0, 0.8, 0), fov: 50),
        effects: Effects(antialiasing: Box),
        lights: [
            SphereLight(center: (-1.2, 2, 1), radius: 0.5, radiance: 8, camera_visible: false),
            SphereLight(center: (2.2, 2.4, 1), radius: 0.3, radiance: 6),
        ],
        materials: { "red": Diffuse(albedo: (0.7, 0.2, 0.2)), "glass": Transparent(ior: 1.5) },
        objects: [
            Plane(material: Diffuse(albedo: 0.7)),
            Plane(point: (0, 0, 5), normal: (0, 0, 1), material: "red", camera_visible: false),
            Rectangle(center: (0, 1.5, -2), normal: (0.1, 0, 1), size: (6, 3), material: Mirror(reflectance: 0.9)),
            Rectangle(center: (0.8, 0, 1.2), size: 1, material: Diffuse(albedo: 0.7), camera_visible: false),
            Sphere(center: (-1, 0.5, 1.5), radius: 0.5, material: "red", camera_visible: false),
            Sphere(center: (0.9, 0.5, 0), radius: 0.5, material: "glass"),
            Sphere(center: (0.1, 0.5, 2), radius: 0.4, material: "glass", camera_visible: false),
            Box(center: (-0.2, 0.4, -0.8), size: 0.8, material: Diffuse(albedo: (0.3, 0.6, 0.3))),
            Disk(center: (0, 1.2, 2.5), normal: (0, 0, 1), radius: 0.4, material: "red", camera_visible: false),
            Cylinder(from: (1.8, 0, 0.5), to: (1.8, 1.2, 0.5), radius: 0.3, camera_visible: false),
            Rectangle(center: (-1.9, 1, 0), normal: (1, 0, 0.5), camera_visible: false,
                material: Emissive(radiance: 4)),
            Difference(camera_visible: false, objects: [
                Box(center: (0.4, 1.6, 0), size: 0.6), Sphere(center: (0.4, 1.6, 0.3), radius: 0.3),
            ]),
            Mesh(
                points: [(0, 0, 0), (0.6, 0, 0), (0.3, 0, 0.5), (0.3, 0.6, 0.2)],
                faces: [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]], instances: Always, camera_visible: false,
                placements: [[Translate((-2, 0, 0.8))], [Translate((1, 0.8, 1))]],
            ),
            Group(camera_visible: false, transform: [Translate((-0.6, 0, 3))], objects: [
                Capsule(from: (0, 0.3, 0), to: (0, 0.7, 0), radius: 0.15, material: "glass"),
            ]),
        ])"#,
    )
}

fn hide(desc: &mut SceneDesc, which: impl Fn(usize, &Object) -> bool) {
    for (k, object) in desc.objects.iter_mut().enumerate() {
        *object.value.camera_visible_mut() = !which(k, &object.value);
    }
}

/// With all that is on by default: shadows, mirrors and glass know what the camera passes.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn pictures_are_those_of_the_reference() {
    assert_same_picture("hidden", &hidden(), Samples { engine: 4096, reference: 768 });
    // From within glass that the camera does not see, at a ball of glass that it does not see either.
    let mut within = hidden();
    let around = sphere([0.0, 1.4, 6.0], 0.4, glass(1.5));
    within.objects.push(around.into());
    let last = within.objects.len() - 1;
    *within.objects[last].value.camera_visible_mut() = false;
    assert_same_picture("within hidden glass", &within, Samples { engine: 4096, reference: 768 });
}

/// Depth and object of first hits, whatever finds them, are those of the reference; many balls hang in the tree.
#[test]
fn first_hits_pass() {
    let mut balls = many_balls();
    hide(&mut balls, |k, _| k % 3 == 0);
    for mut desc in [hidden(), balls] {
        desc.effects.antialiasing = PixelFilter::None;
        for acceleration in [Acceleration::Bvh, Acceleration::BoundingBox, Acceleration::None] {
            desc.render.acceleration = acceleration;
            let scene = compiled(&desc);
            let layers = LayerSet::from_iter([Layer::ObjectId, Layer::Depth, Layer::Alpha]);
            let options =
                RenderOptions { samples: Some(1), threads: 1, layers: Some(layers), ..RenderOptions::default() };
            let film = render(&scene, &options, &Unobserved);
            let of = |layer: Layer| film.layer(layer).expect("it was asked for").values.clone();
            let (objects, depths, alpha) = (of(Layer::ObjectId), of(Layer::Depth), of(Layer::Alpha));
            for (k, hit) in first_hits(&scene).iter().enumerate() {
                let object = hit.map_or(0.0, |hit| f64::from(hit.object) + 1.0);
                assert_eq!(f64::from(objects[k]), object, "pixel {k}, {acceleration:?}");
                assert_eq!(alpha[k], f32::from(hit.is_some()), "pixel {k}");
                let depth = hit.map_or(f64::INFINITY, |hit| hit.depth / scene.frame.scale);
                let found = f64::from(depths[k]);
                assert!(found == depth || (found - depth).abs() <= 1e-4 * depth, "pixel {k}: {found} and {depth}");
                let seen = |object: u32| desc.objects.get(object as usize).is_none_or(|o| o.value.camera_visible());
                assert!(hit.is_none_or(|hit| seen(hit.object)));
            }
        }
    }
}

/// Light paths come to the camera through what it does not see, and not from there.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn light_paths_pass() {
    let ball = |x: f64, y: f64, radius: f64, of| sphere([x, y, 0.0], radius, of);
    let mut desc = on_the_floor(vec![
        ball(0.0, 5.0, 2.5, glass(1.5)),
        // It catches some of the light, and is not seen; one before the camera, and a ball of glass.
        ball(-3.0, 1.5, 1.5, diffuse([0.8; 3])),
        sphere([-2.5, 10.0, 13.0], 1.0, diffuse([0.3, 0.8, 0.4])),
        ball(4.0, 2.0, 2.0, glass(1.4)),
    ]);
    hide(&mut desc, |k, _| k >= 2);
    assert_guiding_is_unbiased("hidden things", &desc, 512, SCENES);
    hide(&mut desc, |k, _| k == 1);
    assert_guiding_is_unbiased("hidden glass", &desc, 512, SCENES);
}

#[test]
fn shared_vertices_pass() {
    assert_sharing_is_unbiased("hidden", &hidden(), SCENES);
}

/// Where all is hidden there is the background.
#[test]
fn nothing_is_seen_of_a_hidden_scene() {
    let mut desc = hidden();
    hide(&mut desc, |_, _| true);
    desc.lights.truncate(1);
    let options = RenderOptions { samples: Some(2), threads: 1, ..RenderOptions::default() };
    let film = render(&compiled(&desc), &options, &Unobserved);
    for k in 0..32 * 32 {
        let found = film.radiance(k % 32, k / 32);
        assert!(found.iter().zip([0.2, 0.25, 0.3]).all(|(a, b)| (a - b).abs() < 1e-7), "{found:?}");
    }
}
