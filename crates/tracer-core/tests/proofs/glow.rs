//! Lamps that shine by a texture: against lamps cut into even ones, against even lamps, as the reference sees them by
//! every kind of shape and texture, over glass and mirrors, and point by point.

use crate::support::compare::{
    Samples, assert_guiding_is_unbiased, assert_same_picture, assert_same_scenes, assert_sharing_is_unbiased,
};
use crate::support::meshes::{picture, square, torus};
use crate::support::{compiled, film};
use glam::DVec3;
use scene_format::desc::{Amount, Integrator, Material, MaterialRef, PixelFilter};
use scene_format::{SceneDesc, Syntax, codes};
use std::path::Path;
use tracer_core::{Layer, LayerSet, Level, RenderOptions, Unobserved, compile, render};
use tracer_reference::first_hits;

/// All whose guides are compared here, for the strictness of the tests.
const GUIDED: usize = 4;

const CHECKERED: &str = "Checkerboard(a: (1, 0.6, 0.2), b: (0.05, 0.1, 0.4), mapping: Uv(scale: 4))";
const FLOOR: &str = "Rectangle(normal: (0, 1, 0), size: 8, material: Diffuse(albedo: (0.7, 0.6, 0.5)))";
const BALL: &str = "Sphere(center: (-0.8, 0.6, 0.3), radius: 0.6, material: Diffuse(albedo: (0.3, 0.5, 0.8)))";

/// A floor, and what stands on it.
fn view(objects: &str) -> SceneDesc {
    let text = format!(
        "Scene(image: Image(width: 32, height: 32), render: Render(max_bounces: 3),
            effects: Effects(antialiasing: Box),
            camera: Camera(position: (0.5, 2.5, 6), look_at: (0, 0.8, 0), fov: 45),
            objects: [{FLOOR}, {objects}])"
    );
    let loaded = scene_format::load_str("glow.ron", &text, Syntax::Ron, Path::new(""), &[]);
    loaded.unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

/// Lamps of all kinds with textures, over glass, a mirror and a glossy ball.
pub(crate) fn lamps() -> SceneDesc {
    let lamps = format!(
        "{BALL}, Sphere(center: (0.6, 0.5, 0.8), radius: 0.5, material: Transparent(ior: 1.5)), \
         Sphere(center: (1.8, 0.4, -0.4), radius: 0.4, material: Mirror(reflectance: 0.9)), \
         Sphere(center: (-1.8, 0.4, 0.9), radius: 0.4, material: BlinnPhong(exponent: 90, specular: 0.3)), \
         Rectangle(center: (0.6, 2, 0.3), normal: (0, -1, 0), size: 0.8, material: {}), \
         Capsule(from: (-1.5, 2, 0.4), to: (-0.6, 2.2, 0.4), radius: 0.2, material: {}), \
         Sphere(center: (1.6, 1.8, 0), radius: 0.2, material: {}), \
         Torus(center: (1.2, 2.2, -0.5), axis: (0.2, 1, 0.5), radius: 0.3, tube_radius: 0.1, material: {}), \
         Sphere(center: (-0.2, 0.3, 1.5), radius: 0.2, material: Emissive(radiance: 2)), \
         Mesh(file: {:?}, material: {}, transform: [Scale(0.4), Translate((-0.3, 1.9, -1.3))])",
        glow(9.0, CHECKERED, true),
        glow(7.0, "Noise(a: 0, b: (1, 0.7, 0.4), mapping: World(scale: 3))", false),
        glow(9.0, &image(), false),
        glow(6.0, "Checkerboard(a: (1, 0.9, 0.7), b: 0.2, mapping: Uv(scale: (6, 2)))", false),
        square(1.0).obj("square-1"),
        glow(5.0, "Checkerboard(a: 1, b: 0.05, mapping: Triplanar(scale: 3))", true),
    );
    let mut desc = view(&lamps);
    desc.render.max_bounces = 6.into();
    desc
}

/// A material that shines by a texture.
fn glow(radiance: f64, color: &str, two_sided: bool) -> String {
    format!("Emissive(radiance: {radiance}, color: {color}, two_sided: {two_sided})")
}

fn image() -> String {
    format!("Texture(file: {:?}, filter: Nearest)", picture())
}

/// Nine squares, of which every second one is bright, and all are lamps of their own; some are black.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn a_checkerboard_is_the_squares_that_it_is_made_of() {
    for dark in [[0.0; 3], [0.1, 0.3, 0.2]] {
        let dark_text = format!("({}, {}, {})", dark[0], dark[1], dark[2]);
        let whole =
            glow(12.0, &format!("Checkerboard(a: (1, 0.5, 0.25), b: {dark_text}, mapping: Uv(scale: 3))"), false);
        let whole =
            format!("Rectangle(center: (0.2, 1.5, 0), normal: (0, -1, 0), size: 1.5, material: {whole}), {BALL}");
        let mut cut = BALL.to_owned();
        for (i, j) in (0..9).map(|k| (k % 3, k / 3)) {
            let [r, g, b] = if (i + j) % 2 == 0 { [12.0, 6.0, 3.0] } else { dark.map(|x| 12.0 * x) };
            let (x, z) = (0.2 + 0.5 * f64::from(i - 1), 0.5 * f64::from(j - 1));
            cut += &format!(
                ", Rectangle(center: ({x}, 1.5, {z}), normal: (0, -1, 0), size: 0.5, \
                  material: Emissive(radiance: ({r}, {g}, {b})))"
            );
        }
        assert_same_scenes("cut into squares", &view(&whole), &view(&cut), 1024);
    }
}

/// One light of one colour everywhere: with twice the amount, to the last bit what an even one brings to paths. Where
/// photons guide them they go by about how much light there is.
#[test]
fn one_colour_is_even_light() {
    let lamps = |material: &str| {
        [
            format!("Rectangle(center: (0.5, 1.5, 0), normal: (0, -1, 0), size: 1, material: {material})"),
            format!("Sphere(center: (0.5, 1.5, 0), radius: 0.5, material: {material})"),
            format!("Capsule(from: (0.5, 1.5, 0), to: (1, 1.5, 0.3), radius: 0.2, material: {material})"),
        ]
    };
    let even = lamps("Emissive(radiance: (4, 3, 2))");
    let textured = lamps("Emissive(radiance: (8, 6, 4), color: Checkerboard(a: 0.5, b: 0.5))");
    let glass = "Sphere(center: (0.6, 0.4, 1), radius: 0.4, material: Transparent(ior: 1.5))";
    for (even, textured) in even.iter().zip(&textured) {
        let [even, textured] = [even, textured].map(|lamp| {
            let mut desc = view(&format!("{lamp}, {BALL}, {glass}"));
            desc.render.integrator = Integrator::Path;
            // The film's unit is a power of two by the amount: sums are exact in both.
            film(&compiled(&desc), 8, 3)
        });
        for (x, y) in (0..32).flat_map(|y| (0..32).map(move |x| (x, y))) {
            assert_eq!(even.radiance(x, y), textured.radiance(x, y), "{x}, {y}");
        }
    }
    // Where there are several, roundings choose between them.
    let body =
        |material: &str| format!("Box(center: (0.8, 1, 0), size: (0.6, 0.9, 0.5), material: {material}), {BALL}");
    let even = view(&body("Emissive(radiance: (4, 3, 2))"));
    let textured =
        view(&body("Emissive(radiance: (5, 5, 5), color: Checkerboard(a: (0.8, 0.6, 0.4), b: (0.8, 0.6, 0.4)))"));
    assert_same_scenes("one colour", &even, &textured, 512);
}

fn same(name: &str, lamps: &str) {
    assert_same_picture(name, &view(&format!("{lamps}, {BALL}")), Samples { engine: 512, reference: 1024 });
}

/// Rectangles and boxes, whose lights are pairs of triangles: turned, sheared, mirrored; to both sides.
#[test]
fn flat_lamps_as_the_reference_sees_them() {
    let panel = |material: String, more: &str| {
        format!(
            "Rectangle(center: (1, 0.9, -0.3), normal: (-1, 0.2, 0.4), size: (1.2, 0.7), material: {material}{more})"
        )
    };
    same("checkered panel", &panel(glow(9.0, CHECKERED, false), ""));
    let sheared = ", transform: [Rotate(axis: (0.3, 0.2, 1), degrees: 35), Scale((1, 1.8, 0.6)), \
                   Rotate(axis: (0, 1, 0.4), degrees: -20)], placements: [[], [Scale((1, 1, -1))]]";
    same("picture, sheared and mirrored", &panel(glow(9.0, &image(), true), sheared));
    let noisy = "Noise(a: 0, b: (1, 0.7, 0.4), mapping: World(scale: 3))";
    let cube = format!(
        "Box(center: (0.9, 0.9, 0), size: (0.6, 0.9, 0.4), material: {}, \
         transform: [Rotate(axis: (0.3, 1, 0.2), degrees: 40)])",
        glow(9.0, CHECKERED, false)
    );
    same("checkered box", &cube);
    same("clouds", &panel(glow(9.0, noisy, true), ""));
}

/// Spheres that stay spheres and such that do not, disks, cylinders, cones, capsules.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn curved_lamps_as_the_reference_sees_them() {
    let ball = |more: &str| {
        let material = glow(6.0, &image(), false);
        format!("Sphere(center: (0.8, 1, 0), radius: 0.5, material: {material}{more})")
    };
    same("a ball with a picture", &ball(""));
    same("turned", &ball(", transform: [Rotate(axis: (0.3, 0.2, 1), degrees: 75)]"));
    let ellipsoids = ", transform: [Scale((0.7, 1.3, 0.5)), Rotate(axis: (1, 0.2, 1), degrees: 40)], \
                      placements: [[Translate((0.3, 0.3, 0.4))], \
                      [Scale((0.6, 0.6, -0.6)), Translate((-0.6, 0.8, 0.2))]]";
    same("ellipsoids", &ball(ellipsoids));
    let ring = format!(
        "Disk(center: (1, 0.9, -0.3), normal: (-1, 0.2, 0.4), radius: 0.7, inner_radius: 0.3, material: {})",
        glow(9.0, CHECKERED, true)
    );
    same("a ring", &ring);
    let stripes = "Lines(a: (1, 0.8, 0.5), b: 0.02, width: 0.5, mapping: Uv(scale: (9, 3), rotation: 20))";
    let tube = format!(
        "Cylinder(from: (0.6, 0.3, 0.6), to: (1.6, 1.1, -0.2), radius: 0.3, material: {})",
        glow(9.0, CHECKERED, false)
    );
    same("a closed cylinder", &tube);
    let shade = format!(
        "Cone(from: (0.8, 1, 0), to: (0.9, 1.8, 0), radius: 0.7, tip_radius: 0.2, caps: false, material: {})",
        glow(9.0, stripes, true)
    );
    same("a striped shade", &shade);
    let capsule = format!(
        "Capsule(from: (0.6, 0.4, 0.5), to: (1.5, 1.2, 0), radius: 0.25, material: {})",
        glow(9.0, &format!("Mix(a: {CHECKERED}, b: {stripes}, weight: 0.5)"), false)
    );
    same("a capsule of both", &capsule);
}

/// Meshes by their own texture coordinates, colours of vertices and places in space; copies, and what is made of
/// triangles.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn meshes_as_the_reference_sees_them() {
    let sheet = square(1.0).obj("square-1");
    let lit = format!(
        "Mesh(file: {sheet:?}, material: {}, instances: Never, transform: [Scale(0.5), \
         Rotate(axis: (1, 0, 0.3), degrees: 160)], placements: [[Translate((0.9, 1.2, 0.2))], \
         [Scale((-0.7, 1, 1.2)), Translate((-0.4, 1.6, 0))]])",
        glow(9.0, &image(), true)
    );
    same("sheets in copies", &lit);
    let ring = torus(0.3, 10, 6).obj("torus-10-6");
    let sides = "Checkerboard(a: 1, b: 0.05, mapping: Triplanar(scale: 3))";
    let ring = format!(
        "Mesh(file: {ring:?}, material: {}, shading: Smooth, transform: [Rotate(axis: (1, 0, 0.2), degrees: 50), \
         Translate((0.7, 1.2, 0))])",
        glow(4.0, sides, false)
    );
    same("a ring of triangles", &ring);
    let painted = "Mesh(points: [(0, 0, 0), (1, 0, 0), (1, 1, 0.3), (0, 1, 0)], faces: [[0, 1, 2], [0, 2, 3]], \
                   colors: [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]";
    let painted = format!(
        "{painted}, material: {}, transform: [Rotate(axis: (0, 1, 0), degrees: -40), Translate((0.3, 0.4, -0.3))])",
        glow(6.0, "VertexColor()", true)
    );
    same("colours of vertices", &painted);
    let corners = "[(0, 0, 0), (1, 0, 0), (1.2, 0.5, 0), (0.5, 0.3, 0), (0, 1, 0)]";
    let made = format!(
        "Polygon(points: {corners}, material: {}, transform: [Rotate(axis: (0, 1, 0), degrees: -40), \
         Translate((0.3, 0.4, -0.3))])",
        glow(6.0, CHECKERED, false)
    );
    same("a polygon", &made);
}

/// A lamp all of whose points that are looked at beforehand are black, beside an even one.
#[test]
fn what_is_bright_in_few_places_is_found() {
    let dots = "Dots(a: 0, b: 1, radius: 0.06, mapping: Uv(scale: 2, offset: (0.53, 0.47)))";
    let lamps = format!(
        "Rectangle(center: (0.8, 1.2, 0), normal: (0, -1, 0), size: 1, material: {}), \
         Sphere(center: (-1.5, 1.6, 0.5), radius: 0.2, material: Emissive(radiance: 6))",
        glow(300.0, dots, false)
    );
    assert_same_picture("few dots", &view(&format!("{lamps}, {BALL}")), Samples { engine: 2048, reference: 4096 });
}

/// Glass and mirrors under them: photons, light paths, aimed rays and glint chains bring what paths bring.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn guided_rays_and_light_paths_as_paths_alone() {
    let casters = format!(
        "{BALL}, Sphere(center: (0.6, 0.5, 0.8), radius: 0.5, material: Transparent(ior: 1.5)), \
         Sphere(center: (1.8, 0.4, -0.4), radius: 0.4, material: Mirror(reflectance: 0.9))"
    );
    let lamps = [
        (
            "panel",
            format!(
                "Rectangle(center: (0.6, 2, 0.3), normal: (0, -1, 0), size: 0.8, material: {})",
                glow(20.0, CHECKERED, true)
            ),
        ),
        ("ball", format!("Sphere(center: (0.4, 2, 0.4), radius: 0.4, material: {})", glow(20.0, &image(), false))),
        (
            "cylinder",
            format!(
                "Cylinder(from: (0.2, 2, 0.4), to: (1.2, 2.2, 0.4), radius: 0.2, material: {})",
                glow(20.0, CHECKERED, false)
            ),
        ),
        (
            "sheet",
            format!(
                "Mesh(file: {:?}, material: {}, transform: [Scale(0.4), Translate((0.5, 1.9, 0.3))])",
                square(1.0).obj("square-1"),
                glow(20.0, &image(), true)
            ),
        ),
    ];
    for (name, lamp) in lamps {
        assert_guiding_is_unbiased(name, &view(&format!("{lamp}, {casters}")), 1024, GUIDED);
    }
}

/// Pixels that share what they find.
#[test]
fn sharing_changes_nothing() {
    let lamp = format!(
        "Rectangle(center: (0.6, 2, 0.3), normal: (0, -1, 0), size: 1.5, material: {})",
        glow(9.0, CHECKERED, false)
    );
    assert_sharing_is_unbiased("checkered", &view(&format!("{lamp}, {BALL}")), 1);
}

/// Where a lamp is seen, the picture and the layer of what shines are the amount times the texture, at every level;
/// single precision and roundings of coordinates as for textures (see `textures`).
#[test]
fn what_is_seen_is_the_texture() {
    let lamps = format!(
        "Rectangle(center: (-1, 1, 0.5), size: 1, material: {}), \
         Sphere(center: (0.5, 1, 0), radius: 0.5, material: {}), \
         Cylinder(from: (1.5, 0.4, 0), to: (1.7, 1.6, 0), radius: 0.3, material: {}), \
         Box(center: (-0.3, 2.2, -0.5), size: 0.7, material: {})",
        glow(3.0, "Noise(a: 0, b: (1, 0.7, 0.4), mapping: Uv(scale: 5))", false),
        glow(5.0, "Gradient(a: (1, 0, 0.5), b: (0, 1, 0.2))", false),
        glow(0.7, "Wood(a: 0.1, b: (1, 0.5, 0.3), mapping: Object(scale: 3))", false),
        glow(2.0, "Multiply(a: Gradient(axis: X), b: (0.3, 0.9, 1))", false),
    );
    let mut desc = view(&lamps);
    desc.effects.antialiasing = PixelFilter::None;
    let scene = compiled(&desc);
    let expected = first_hits(&scene);
    let mut shining = 0;
    let mut first: Option<Vec<u32>> = None;
    for level in Level::available() {
        let options = RenderOptions {
            threads: 1,
            samples: Some(1),
            level: Some(level),
            layers: Some(LayerSet::all()),
            ..RenderOptions::default()
        };
        let film = render(&scene, &options, &Unobserved);
        let layer = film.layer(Layer::Emission).expect("all layers are kept").values;
        for (k, hit) in (0..).zip(&expected) {
            let Some(hit) = hit.as_ref().filter(|hit| hit.emission != DVec3::ZERO) else { continue };
            shining += 1;
            let of_layer = DVec3::from([0, 1, 2].map(|c: usize| f64::from(layer[3 * k as usize + c])));
            for got in [DVec3::from(film.radiance(k % 32, k / 32)), of_layer] {
                let off = (got - hit.emission).abs().max_element();
                assert!(off < 2e-3, "pixel {k}: {got} is not {}", hit.emission);
            }
        }
        let bits: Vec<u32> = layer.iter().map(|x| x.to_bits()).collect();
        assert_eq!(first.get_or_insert_with(|| bits.clone()), &bits, "{}", level.name());
    }
    assert!(shining > 150, "{shining} pixels show a lamp");
}

/// A picture's texels, seen one by one.
#[test]
fn texels_are_seen_as_they_are() {
    let lamp = format!(
        "Rectangle(center: (0, 0, 0), normal: (0, 0, 1), size: 2.01, material: {})",
        glow(10.0, &image(), false)
    );
    let text = format!(
        "Scene(image: Image(width: 40, height: 40), effects: Effects(antialiasing: None), objects: [{lamp}],
            camera: Camera(projection: Orthographic(height: 2), position: (0, 0, 5), look_at: (0, 0, 0)))"
    );
    let desc = scene_format::load_str("glow.ron", &text, Syntax::Ron, Path::new(""), &[]).expect("it is right").scene;
    let scene = compiled(&desc);
    let film = film(&scene, 1, 1);
    for (k, hit) in (0..).zip(first_hits(&scene)) {
        let expected = hit.expect("the lamp fills the picture").emission;
        let got = DVec3::from(film.radiance(k % 40, k / 40));
        assert!((got - expected).abs().max_element() <= 1e-6 * expected.max_element(), "{k}: {got}, not {expected}");
    }
}

/// A scene that is made in code is told the same as one that is read.
#[test]
fn a_texture_on_the_power_of_a_lamp_is_told() {
    let mut desc = view(&format!("Sphere(center: (0, 1, 0), radius: 0.2, material: {})", glow(1.0, CHECKERED, false)));
    let MaterialRef::Inline(material) = desc.objects[1].value.material_mut() else { panic!() };
    let Material::Emissive(emissive) = &mut material.value else { panic!() };
    emissive.amount = Amount::Power([5.0; 3]).into();
    let Err(error) = compile(&desc) else { panic!("it compiles") };
    assert!(error.diagnostics.iter().any(|fault| fault.code == codes::NO_USE), "{error:?}");
}
