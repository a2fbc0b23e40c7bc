//! How bright lamps are that say it in W/sr, W, cd/m^2, cd or lm: what one pixel sees of them, to single precision.

use crate::support::meshes::write;
use crate::support::{compiled, film};
use scene_format::SceneDesc;
use std::f64::consts::PI;
use std::path::Path;

fn seen(objects: &str, lights: &str) -> [f64; 3] {
    let text = format!(
        r#"Scene(
            camera: Camera(position: (0, 0, 9), look_at: (0, 0, 0), fov: 1),
            image: Image(width: 1, height: 1), render: Render(max_bounces: 1),
            lights: [{lights}], objects: [Sphere(center: (0, 90, 0), radius: 1), {objects}],
        )"#
    );
    let loaded = scene_format::load_str("s.ron", &text, scene_format::Syntax::Ron, Path::new("."), &[]);
    let desc: SceneDesc = loaded.unwrap_or_else(|error| panic!("{error}\n{text}")).scene;
    film(&compiled(&desc), 4, 1).radiance(0, 0)
}

#[track_caller]
fn assert_near(got: [f64; 3], expected: [f64; 3]) {
    let off = (0..3).map(|c| (got[c] / expected[c] - 1.0).abs()).fold(0.0, f64::max);
    assert!(off < 1e-6, "{got:?}, not {expected:?}");
}

/// Shapes that face the camera, their area, and I / L along the normal; of an ellipsoid its mean, A / 4 (Cauchy).
#[test]
fn surfaces_shine_as_much_as_they_say() {
    let ellipsoid = {
        // A prolate spheroid of the axes 1, 0.5, 0.5: 2 pi a^2 (1 + c/(a e) asin e).
        let (a, c) = (0.5f64, 1.0f64);
        let e = (1.0 - a * a / (c * c)).sqrt();
        2.0 * PI * a * a * (1.0 + c / (a * e) * e.asin())
    };
    for (shape, area, shown) in [
        ("Sphere(center: (0, 0, 0), radius: 0.5, @)", PI, PI / 4.0),
        ("Sphere(center: (0, 0, 0), radius: 0.5, @, transform: [Scale((2, 1, 1))])", ellipsoid, ellipsoid / 4.0),
        ("Rectangle(normal: (0, 0, 1), size: (2, 0.5), @)", 1.0, 1.0),
        ("Rectangle(normal: (0, 0, 1), size: 1, @, transform: [Scale(3)])", 9.0, 9.0),
        ("Disk(normal: (0, 0, 1), radius: 0.7, @)", PI * 0.49, PI * 0.49),
        ("Polygon(points: [(-1, -1, 0), (2, -1, 0), (-1, 2, 0)], @)", 4.5, 4.5),
    ] {
        let of = |words: &str| seen(&shape.replace('@', &format!("material: Emissive({words})")), "");
        let tint = [0.2, 1.0, 0.5];
        let color = "color: (0.2, 1, 0.5)";
        let luminance = 0.2126 * 0.2 + 0.7152 + 0.0722 * 0.5;
        assert_near(of("radiance: (3, 2, 1)"), [3.0, 2.0, 1.0]);
        assert_near(of("power: (3, 2, 1)"), [3.0, 2.0, 1.0].map(|p| p / (PI * area)));
        assert_near(of("power: 3, two_sided: true"), [3.0 / (2.0 * PI * area); 3]);
        assert_near(of("intensity: (3, 2, 1)"), [3.0, 2.0, 1.0].map(|i| i / shown));
        assert_near(of("intensity: 3, two_sided: true"), [3.0 / shown; 3]);
        assert_near(of("luminance: 683"), [1.0; 3]);
        assert_near(of(&format!("luminance: 683, {color}")), tint.map(|c| c / luminance));
        assert_near(
            of(&format!("luminous_power: 800, {color}")),
            tint.map(|c| 800.0 / 683.0 * c / luminance / PI / area),
        );
        assert_near(
            of(&format!("luminous_intensity: 90, {color}")),
            tint.map(|c| 90.0 / 683.0 * c / luminance / shown),
        );
    }
}

#[test]
fn sphere_lights_shine_as_much_as_they_say() {
    let of = |words: &str| seen("", &format!("SphereLight(center: (0, 0, 0), radius: 0.5, {words})"));
    // The disc that is seen, times what goes to all sides.
    let disc = PI * 0.25;
    assert_near(of("radiance: (3, 2, 1)"), [3.0, 2.0, 1.0]);
    assert_near(of("intensity: 3"), [3.0 / disc; 3]);
    assert_near(of("power: 3"), [3.0 / (4.0 * PI * disc); 3]);
    assert_near(of("luminance: 1366"), [2.0; 3]);
    assert_near(of("luminous_intensity: 683"), [1.0 / disc; 3]);
    let warm =
        seen("", "SphereLight(center: (0, 0, 0), radius: 0.5, luminous_power: 800, color: \"=blackbody(2700)\")");
    let seen = 683.0 * (0.2126 * warm[0] + 0.7152 * warm[1] + 0.0722 * warm[2]);
    assert!((seen * 4.0 * PI * disc / 800.0 - 1.0).abs() < 1e-6 && warm[0] > 2.0 * warm[2], "{warm:?}");
}

/// A light of a group is a sphere that shines: the same, however much it says it does.
#[test]
fn lights_of_groups_shine_as_much() {
    for words in
        ["radiance: 2", "intensity: 2", "power: 2", "luminance: 900", "luminous_intensity: 900", "luminous_power: 900"]
    {
        let light = format!("SphereLight(center: (0, 0, 0), radius: 0.5, {words}, color: (1, 0.5, 0.2))");
        let grouped = format!("Group(objects: [Box(center: (0, 80, 0))], lights: [{light}])");
        assert_near(seen(&grouped, ""), seen("", &light));
    }
}

/// A room of a file whose MTL says that its lamp shines (`Ke`), twice; and the same with the lamp as an object.
#[test]
fn what_a_file_says_that_shines_is_a_lamp() {
    let corners = "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv -0.5 2 -0.5\nv 0.5 2 -0.5\nv 0.5 2 0.5\nv -0.5 2 0.5\n";
    write("ke.mtl", b"newmtl floor\nKd 0.6 0.5 0.4\nnewmtl lamp\nKd 0 0 0\nKe 5 4 3\n");
    let file = write(
        "ke.obj",
        format!("mtllib ke.mtl\n{corners}usemtl floor\nf 4 3 2 1\nusemtl lamp\nf 5 6 7 8\n").as_bytes(),
    );
    let of_file = format!("Mesh(file: {file:?}, placements: [[], [Translate((3, 0, 0))]]),");
    let word = |points: &str, material: &str| {
        format!(
            "Mesh(points: {points}, faces: [(0, 1, 2, 3)], material: {material}, placements: [[], [Translate((3, 0, \
             0))]]),"
        )
    };
    let of_words = word("[(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)]", "Diffuse(albedo: (0.6, 0.5, 0.4))")
        + &word(
            "[(-0.5, 2, -0.5), (0.5, 2, -0.5), (0.5, 2, 0.5), (-0.5, 2, 0.5)]",
            "Emissive(radiance: (5, 4, 3), two_sided: true)",
        );
    let [by_file, by_words] = [of_file, of_words].map(|objects| {
        let text = format!(
            "Scene(image: Image(width: 32, height: 24), objects: [{objects}], \
             camera: Camera(position: (1.5, 3, 7), look_at: (1.5, 1, 0), fov: 40))"
        );
        let loaded = scene_format::load_str("s.ron", &text, scene_format::Syntax::Ron, Path::new("."), &[]);
        let loaded = loaded.unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert!(loaded.warnings.is_empty(), "{:?}", loaded.warnings);
        let scene = compiled(&loaded.scene);
        assert!(scene.warnings.is_empty(), "{:?}", scene.warnings);
        film(&scene, 256, 3)
    });
    let (mut off, mut lamps) = (0.0, 0);
    for (x, y) in (0..24).flat_map(|y| (0..32).map(move |x| (x, y))) {
        let [a, b] = [by_file.radiance(x, y), by_words.radiance(x, y)];
        let error = (by_file.variance(x, y) + by_words.variance(x, y)).sqrt();
        // The luminance's error in all channels; less than a ten-thousandth is rounding.
        off = (0..3).map(|c| (a[c] - b[c]).abs() / (error + 1e-4)).fold(off, f64::max);
        // Brighter than what is lit by it.
        lamps += u32::from(a[0] > 0.7);
    }
    // Of 768 pixels none is beyond 4.5 standard errors (once in 200 runs), which stratification makes smaller.
    assert!(off < 4.5 && lamps > 1, "{off} standard errors, {lamps} pixels of lamps");
}
