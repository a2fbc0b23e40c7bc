//! Textures on what is not a material's first colour: reflectance and transmittance, the lobe's width and share, the
//! tint. A texture of one colour is the constant; half and half is both; and all is that of the reference.

use crate::support::compare::{Samples, assert_guiding_is_unbiased, assert_same_picture, assert_sharing_is_unbiased};
use crate::support::{compiled, film};
use scene_format::SceneDesc;
use std::path::Path;
use tracer_core::{Film, Level, RenderOptions, Unobserved};
use tracer_reference::{Smoothing, render};

fn desc(text: &str) -> SceneDesc {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../golden");
    let loaded = scene_format::load_str("s.ron", text, scene_format::Syntax::Ron, &golden, &[]);
    loaded.unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

/// A ball and a turned box of this material before a white sky, and nothing else.
fn alone(material: &str, bounces: u32) -> SceneDesc {
    desc(&format!(
        r#"Scene(
            camera: Camera(position: (0.3, 0.4, 6), look_at: (0, 0, 0), fov: 32),
            image: Image(width: 48, height: 32),
            render: Render(samples: 1, max_bounces: {bounces}),
            effects: Effects(antialiasing: None),
            background: 1,
            materials: {{ "it": {material} }},
            objects: [
                Sphere(center: (-1.1, 0, 0), radius: 1, material: "it"),
                Box(center: (1.2, 0, 0), size: 1.4, material: "it", transform: [Rotate(axis: (1, 2, 3), degrees: 33)]),
            ],
        )"#
    ))
}

/// Pictures, patterns in the plane and in space, and what is made of these.
const TEXTURES: [&str; 5] = [
    "Texture(file: \"assets/tile.png\", mapping: Uv(scale: (3, 2)))",
    "Checkerboard(a: (0.1, 0.5, 0.9), b: (1, 0.4, 0.2), mapping: Object(scale: (3.1, 2.3, 1.7), offset: (0.2, 0.3, \
     0.4)))",
    "Gradient(a: (0.9, 0.1, 0.3), b: (0.1, 0.9, 0.2), mapping: Object(scale: 0.5, offset: (0, 0.5, 0)))",
    "Mix(a: Marble(mapping: Object(scale: 2)), b: Texture(file: \"assets/tile.png\"), weight: Gradient())",
    "Multiply(a: Texture(file: \"assets/tile.png\", mapping: Triplanar()), b: (0.9, 0.5, 0.7))",
];

/// A convex mirror under a white sky shows its reflectance, and glass of the index 1 its transmittance twice, without
/// noise. The textures themselves are right to 4e-4 (`patterns`), and glass multiplies two of them; where colours jump
/// a point may fall on the other side.
#[test]
fn mirrors_and_glass_show_their_textures_point_by_point() {
    for texture in TEXTURES {
        for (material, bounces) in [("Mirror(reflectance: @)", 1), ("Transparent(ior: 1, transmittance: @)", 4)] {
            let scene = compiled(&alone(&material.replace('@', texture), bounces));
            let (ours, theirs) = (film(&scene, 1, 1), render(&scene, 2, 1, Smoothing::Hanika));
            let mut other_side = 0;
            for (k, expected) in theirs.mean.iter().enumerate() {
                let got = ours.radiance(k as u32 % 48, k as u32 / 48);
                let off = (0..3).map(|c| (got[c] - expected[c]).abs()).fold(0.0, f64::max);
                other_side += u32::from(off > 8e-4);
            }
            let shown = theirs.mean.iter().filter(|color| color.min_element() < 0.99).count();
            assert!(shown > 400, "{material} {texture}: {shown} pixels show something");
            assert!(other_side <= 2, "{material} {texture}: {other_side} pixels are others");
        }
    }
}

fn bits(film: &Film) -> Vec<u64> {
    let pixels = (0..32).flat_map(|y| (0..48).map(move |x| (x, y)));
    pixels.flat_map(|(x, y)| film.radiance(x, y).map(f64::to_bits)).collect()
}

/// Numbers that binary fractions hold, so that nothing is rounded: the same bytes, at every level.
#[test]
fn a_texture_of_one_colour_is_the_constant() {
    let squares = |color: &str| format!("Checkerboard(a: {color}, b: {color})");
    let solid = |color: &str| format!("Checkerboard(a: {color}, b: {color}, mapping: Object(scale: 3))");
    let product = |color: &str| format!("Multiply(a: {color}, b: 1)");
    for (material, value) in [
        ("Mirror(reflectance: @)", "(0.5, 0.25, 0.75)"),
        ("Transparent(ior: 1.5, transmittance: @)", "(0.5, 0.25, 0.75)"),
        ("BlinnPhong(albedo: 0.5, exponent: @, specular: 0.25)", "200"),
        ("BlinnPhong(albedo: 0.5, exponent: @, specular: 0.5, energy_conserving: true)", "3"),
        ("BlinnPhong(albedo: 0.5, exponent: 200, specular: @)", "0.25"),
        ("Conductor(reflectance: 0.75, edge_tint: @)", "(0.5, 0.25, 0.75)"),
        ("Conductor(reflectance: 0.75, roughness: 0.5, edge_tint: @)", "(0.5, 0.25, 0.75)"),
        ("Conductor(metal: Gold, roughness: @, multiple_scattering: false)", "0.5"),
        ("Conductor(metal: Gold, roughness: @, multiple_scattering: false)", "0.25"),
        ("Conductor(metal: Gold, roughness: @)", "0"),
    ] {
        let film_of = |value: &str, level: Level| {
            let options =
                RenderOptions { samples: Some(4), threads: 1, level: Some(level), ..RenderOptions::default() };
            tracer_core::render(&compiled(&alone(&material.replace('@', value), 3)), &options, &Unobserved)
        };
        let constant = bits(&film_of(value, Level::PORTABLE));
        for level in Level::available() {
            for texture in [squares(value), solid(value), product(value)] {
                let same = bits(&film_of(&texture, level)) == constant;
                assert!(same, "{material} with {texture}: {}", level.name());
            }
        }
    }
}

/// What is left and what is right of the middle of one square is two squares side by side: the same bytes, since each
/// pixel sees one of both.
#[test]
fn half_and_half_is_both() {
    let scene = |objects: &str| {
        desc(&format!(
            r#"Scene(
                camera: Camera(position: (0, 0, 4), look_at: (0, 0, 0), fov: 30),
                image: Image(width: 48, height: 32),
                render: Render(samples: 16, max_bounces: 2),
                effects: Effects(antialiasing: None),
                background: (0.5, 0.75, 1),
                objects: [{objects}],
            )"#
        ))
    };
    for (material, left, right) in [
        ("Mirror(reflectance: @)", "0.25", "(0.5, 1, 0.75)"),
        ("Transparent(ior: 1.5, transmittance: @)", "0.25", "(0.5, 1, 0.75)"),
        ("Conductor(metal: Copper, roughness: @, multiple_scattering: false)", "0.0", "0.5"),
        ("BlinnPhong(albedo: 0.5, exponent: @, specular: 0.25)", "8", "4096"),
    ] {
        let half = |value: &str| material.replace('@', value);
        let checked = format!("Checkerboard(a: {left}, b: {right}, mapping: Uv(scale: (2, 1)))");
        let one = scene(&format!("Rectangle(normal: (0, 0, 1), size: 2, material: {})", half(&checked)));
        let side = |x: f64, value: &str| {
            format!("Rectangle(center: ({x}, 0, 0), normal: (0, 0, 1), size: (1, 2), material: {}),", half(value))
        };
        let both = scene(&format!("{}{}", side(-0.5, left), side(0.5, right)));
        let [one, both] = [one, both].map(|desc| {
            let film = film(&compiled(&desc), 16, 1);
            let pixels = (0..32).flat_map(|y| (0..48).map(move |x| (x, y)));
            pixels.map(|(x, y)| film.radiance(x, y)).collect::<Vec<_>>()
        });
        let off = one.iter().zip(&both).flat_map(|(a, b)| (0..3).map(|c| (a[c] - b[c]).abs())).fold(0.0, f64::max);
        // Other triangles: points and directions are rounded otherwise, at most 1e-6 of a lobe that is 0.02 wide.
        assert!(off < 1e-4, "{material}: {off:e}");
    }
}

/// Every parameter by a texture, lit by a lamp and a sky, over one another.
fn balls(background: &str) -> SceneDesc {
    desc(&format!(
        r#"Scene(
            camera: Camera(position: (0, 3, 9), look_at: (0, 0.8, 0), fov: 35),
            image: Image(width: 32, height: 32),
            render: Render(max_bounces: 3),
            background: {background},
            lights: [SphereLight(center: (3, 7, 5), radius: 1.5, radiance: (12, 11, 9))],
            objects: [
                Plane(material: Diffuse(albedo: 0.6)),
                Sphere(center: (-2.1, 1, 0), radius: 1, material: Conductor(metal: Gold, roughness:
                    Checkerboard(a: 0, b: 0.6, mapping: Object(scale: 1.7, offset: (0.1, 0.2, 0.3))))),
                Sphere(center: (0, 1, 0), radius: 1, material: Conductor(reflectance: (0.9, 0.5, 0.3),
                    edge_tint: Gradient(a: (1, 0.2, 0.4), b: 1, mapping: Object(scale: 0.5)),
                    roughness: Gradient(a: 0.1, b: 0.9, axis: X, mapping: Object(scale: 0.5, offset: (0.5, 0, 0))))),
                Sphere(center: (2.1, 1, 0), radius: 1, material: BlinnPhong(albedo: (0.7, 0.5, 0.3),
                    exponent: Gradient(a: 4, b: 300, mapping: Object(scale: 0.5)),
                    specular: Noise(a: 0, b: 0.8, mapping: Object(scale: 2)), energy_conserving: true)),
                Sphere(center: (-1, 0.6, 2), radius: 0.6, material: Transparent(ior: 1.5,
                    transmittance: Checkerboard(a: (1, 0.3, 0.5), b: 1, mapping: Object(scale: 4)))),
                Sphere(center: (1, 0.6, 2), radius: 0.6, material: Mirror(
                    reflectance: Checkerboard(a: (0.2, 0.6, 0.3), b: 0.9, mapping: Object(scale: 4)))),
            ],
        )"#
    ))
}

#[test]
fn varying_materials_are_those_of_the_reference() {
    assert_same_picture("varying", &balls("(0.2, 0.3, 0.4)"), Samples { engine: 256, reference: 256 });
}

#[test]
fn varying_materials_share_and_guide_without_bias() {
    let desc = balls("0");
    assert_sharing_is_unbiased("varying", &desc, 5);
    assert_guiding_is_unbiased("varying", &desc, 256, 5);
}

/// White metal reflects all that it gets, however rough it is where: the furnace at every pixel's own roughness.
#[test]
fn a_furnace_of_all_roughnesses() {
    let metal = |value: &str| format!("Conductor(reflectance: 1, roughness: {value})");
    let scene = compiled(&alone(&metal("Gradient(axis: X, mapping: Object(scale: 0.5, offset: (0.5, 0, 0)))"), 64));
    let film = film(&scene, 256, 1);
    let mut means = [0.0; 3];
    for (x, y) in (0..32).flat_map(|y| (0..48).map(move |x| (x, y))) {
        let got = film.radiance(x, y);
        (0..3).for_each(|c| means[c] += got[c] / (48.0 * 32.0));
        assert!((got[0] - 1.0).abs() < 0.1, "({x}, {y}): {got:?}");
    }
    // E between the table's places is linear: 3e-3, as in the lobe's own furnace.
    assert!(means.iter().all(|mean| (mean - 1.0).abs() < 3e-3), "{means:?}");
}
