//! Solids that shine, and parts of solids that do: as paths of the reference see them, as the shapes that they are, in
//! closed form, and in the groups of their lights.

use crate::support::compare::{Samples, assert_same_picture, assert_same_scenes};
use crate::support::{compiled, film};
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;
use tracer_core::Layer;

fn described(text: &str) -> SceneDesc {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden");
    load_str("s.ron", text, Syntax::Ron, &golden, &[]).unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

fn view(objects: &str) -> SceneDesc {
    described(&format!(
        "Scene(camera: Camera(position: (0.5, 2.5, 6), look_at: (0, 0.8, 0), fov: 45), \
         image: Image(width: 32, height: 32), render: Render(max_bounces: 3), objects: [\
         Rectangle(size: 8, material: Diffuse(albedo: (0.7, 0.6, 0.5))), \
         Sphere(center: (-0.8, 0.6, 0.3), radius: 0.6, material: Diffuse(albedo: (0.3, 0.5, 0.8))), {objects}])"
    ))
}

/// Cut, joined, in common; whole and in parts, of which some take the light of others; to both sides, copied, stretched
/// and mirrored; where faces coincide; by a texture; half spaces that shine.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn shining_solids_as_the_reference_sees_them() {
    let samples = Samples { engine: 512, reference: 1024 };
    let same = |name: &str, objects: &str| assert_same_picture(name, &view(objects), samples);
    same(
        "a union of two lamps",
        "Union(material: Emissive(radiance: (4, 5, 6)), objects: [Sphere(center: (0.9, 0.7, 0.3), radius: 0.4), \
         Box(center: (1.2, 1.1, 0.2), size: 0.6, material: Emissive(radiance: (9, 7, 5)))])",
    );
    same(
        "a bowl that shines within",
        "Difference(material: Diffuse(albedo: 0.5), transform: [Rotate(axis: (0, 0, 1), degrees: 120), \
          Translate((1.2, 1.2, 0))], objects: [Sphere(center: (0, 0, 0), radius: 0.8), \
         Sphere(center: (0, 0, 0), radius: 0.7, material: \
         Emissive(radiance: (9, 7, 5))), Box(center: (0, 1, 0), size: (2, 1.4, 2))])",
    );
    same(
        "a lens to both sides, twice",
        "Intersection(material: Emissive(radiance: (9, 7, 5), two_sided: true), placements: [[Translate((0.9, 1, 0))], \
         [Scale((1, -0.5, 0.7)), Translate((0.2, 1.8, -0.5))]], objects: [Sphere(center: (0.3, 0, 0), radius: 0.6), \
         Sphere(center: (-0.3, 0, 0), radius: 0.6)])",
    );
    same(
        "a slot that shines, by a texture",
        "Difference(material: Diffuse(albedo: 0.6), objects: [Box(center: (1, 0.6, 0), size: (1.2, 1.2, 1)), \
         Box(center: (1, 1, 0), size: (0.5, 0.8, 1), material: Emissive(radiance: 9, color: \
         Checkerboard(a: 0.1, b: (1, 0.6, 0.3), mapping: Uv(scale: (3, 3)))))])",
    );
    same(
        "a half space of a cylinder",
        "Intersection(material: Diffuse(albedo: (0.6, 0.7, 0.5)), objects: [Cylinder(from: (1, 0, 0), to: (1, 1.5, 0), \
         radius: 0.5), Plane(point: (1, 0.9, 0), normal: (-0.3, 1, 0.3), material: Emissive(radiance: (6, 5, 4)))])",
    );
    same(
        "a ring with a shining face, beside a lamp",
        "Difference(material: Emissive(radiance: (3, 4, 5)), objects: [Torus(center: (0.8, 1, 0), axis: (0.2, 1, 0.6), \
         radius: 0.6, tube_radius: 0.25), Box(center: (0.2, 1, 0), size: (1, 2, 2), material: Mirror())]), \
         Sphere(center: (1.9, 0.3, 0.8), radius: 0.3, material: Emissive(radiance: 6))",
    );
}

/// A solid of one shape is that shape, and so is what adds or takes away nothing that is seen.
#[test]
fn shining_solids_that_are_one_shape() {
    let lamp = "material: Emissive(radiance: (9, 7, 5))";
    for (name, shape, solid) in [
        ("ball", "Sphere(center: (0.9, 1, 0.2), radius: 0.4, LAMP)", "Union(LAMP, objects: [SHAPE])"),
        (
            "box",
            "Box(center: (0.9, 0.7, 0.2), size: 0.7, LAMP)",
            "Intersection(objects: [SHAPE, Sphere(center: (0, 0, 0), radius: 9)])",
        ),
        (
            "cylinder",
            "Cylinder(from: (0.6, 0.3, 0.6), to: (1.6, 1.1, -0.2), radius: 0.3, LAMP)",
            "Difference(objects: [SHAPE, Sphere(center: (1.1, 0.7, 0.2), radius: 0.1)])",
        ),
    ] {
        let shape = shape.replace("LAMP", lamp);
        let solid = solid.replace("SHAPE", &shape).replace("LAMP", lamp);
        assert_same_scenes(&format!("{name} as a solid"), &view(&shape), &view(&solid), 1024);
    }
}

/// Within a hollow that shines all directions bring the same: a ball of albedo a shows a L, and what is seen past it L.
/// The camera and the ball are in what a ball takes away from a box.
#[test]
fn within_a_hollow_that_shines() {
    let desc = described(
        "Scene(camera: Camera(position: (0.3, 0.2, 1.7), fov: 70), image: Image(width: 16, height: 16), \
         render: Render(max_bounces: 0), objects: [Difference(objects: [Box(size: 9), \
         Sphere(center: (0, 0, 0), radius: 4, material: Emissive(radiance: (0.5, 0.7, 0.9)))]), \
         Sphere(center: (0, 0, 0), radius: 0.6, material: Diffuse(albedo: 0.4))])",
    );
    let picture = film(&compiled(&desc), 256, 3);
    let mean = (0..16).map(|k| picture.radiance(6 + k % 4, 6 + k / 4)[0]).sum::<f64>() / 16.0;
    assert!((mean - 0.4 * 0.5).abs() < 2e-3, "{mean}");
    let corner = picture.radiance(0, 0);
    assert!((0..3).all(|k| (corner[k] - [0.5, 0.7, 0.9][k]).abs() < 1e-6), "{corner:?}");
}

/// Groups are those of the parts' materials, and together the picture; the layer of emission shows what the parts
/// shine.
#[test]
fn shining_solids_in_groups_and_layers() {
    let desc = described(
        "Scene(camera: Camera(position: (0, 0, 8), fov: 30), image: Image(width: 16, height: 16), \
         output: Output(layers: [Emission], light_groups: true), objects: [Union(\
         material: Emissive(radiance: 2, group: \"left\"), objects: [Box(center: (-1, 0, 0), size: 1.5), \
         Box(center: (1, 0, 0), size: 1.5, material: Emissive(radiance: 3, group: \"right\"))])])",
    );
    let scene = compiled(&desc);
    let picture = film(&scene, 16, 1);
    let emission = picture.layer(Layer::Emission).expect("it is asked for").values;
    let groups = scene.light_groups.as_ref().expect("they are asked for");
    assert_eq!(groups.names, ["left", "right"]);
    assert_eq!(groups.of_light.len(), 2);
    for (x, radiance) in [(4, 2.0), (11, 3.0)] {
        assert!((picture.radiance(x, 8)[1] - radiance).abs() < 1e-6);
        assert!((f64::from(emission[(8 * 16 + x as usize) * 3]) - radiance).abs() < 1e-6);
    }
}
