//! Flat lamps that lie in one plane and overlap: one of them is seen where both are, so the other one gives no light
//! there, by no kind of sample. They light a room as the pieces do that are seen of them, or, where those cannot be
//! written, as the same lamps do with the one that is seen a ten-thousandth of its size before the other one.
//!
//! Of light past the edge of a lamp that hangs h before another one a receiver at a height of d sees a strip h tan(a)
//! wide, a being the angle off the normal: with h = 1e-4, a width of 1 and tan(a) = 4 that is 4e-4 of a lamp, less than
//! half of the standard error of a picture's mean here.

use crate::support::compare::{assert_guiding_is_unbiased, assert_same_scenes};
use scene_format::desc::Integrator;
use scene_format::{SceneDesc, Syntax};
use std::path::Path;

/// How far the winner hangs before the loser.
const GAP: &str = "1.9999";

/// A room with these objects.
fn room(objects: &str) -> SceneDesc {
    let text = format!(
        "Scene(image: Image(width: 32, height: 32), render: Render(max_bounces: 2), effects: Effects(antialiasing: Box),
            camera: Camera(position: (0.5, 1.1, 4.5), look_at: (0, 0.9, 0), fov: 55),
            objects: [
                Rectangle(normal: (0, 1, 0), size: 8, material: Diffuse(albedo: (0.7, 0.6, 0.5))),
                Sphere(center: (-0.9, 0.5, 0.3), radius: 0.5, material: Diffuse(albedo: (0.3, 0.5, 0.8))),
                {objects}
            ])"
    );
    let loaded = scene_format::load_str("room.ron", &text, Syntax::Ron, Path::new(""), &[]);
    loaded.unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

/// Both by all that is on by default, and as the plain path tracer.
fn assert_same_light(name: &str, overlapping: &str, apart: &str) {
    for integrator in [Integrator::Full, Integrator::Path] {
        let [one, other] = [overlapping, apart].map(|objects| {
            let mut desc = room(objects);
            desc.render.integrator = integrator.clone();
            desc
        });
        assert_same_scenes(&format!("{name}, {integrator:?}"), &one, &other, 256);
    }
}

fn shining(radiance: [f64; 3]) -> String {
    let [r, g, b] = radiance;
    format!("material: Emissive(radiance: ({r}, {g}, {b}))")
}

const WARM: [f64; 3] = [8.0, 4.0, 2.0];
const COLD: [f64; 3] = [1.0, 3.0, 6.0];

/// A rectangle that faces down: its middle and its size.
fn panel(x: f64, y: &str, [width, depth]: [f64; 2], material: &str) -> String {
    format!("Rectangle(center: ({x}, {y}, 0), normal: (0, -1, 0), size: ({width}, {depth}), {material})")
}

#[test]
fn rectangles_light_as_the_pieces_that_are_seen() {
    for (name, colors) in [("of one colour", [WARM, WARM]), ("of two colours", [WARM, COLD])] {
        let [first, second] = colors.map(shining);
        let whole = panel(-0.3, "2", [1.2, 1.0], &first);
        // The first reaches up to x = 0.3, the middle of the second.
        let both = format!("{whole}, {}", panel(0.3, "2", [1.2, 1.0], &second));
        let cut = format!("{whole}, {}", panel(0.6, "2", [0.6, 1.0], &second));
        assert_same_light(&format!("half covered, {name}"), &both, &cut);
    }
    let [first, second] = [WARM, COLD].map(|color| shining(color).replace("))", "), two_sided: true)"));
    let whole = panel(-0.3, "1", [1.2, 1.0], &first);
    let both = format!("{whole}, {}", panel(0.3, "1", [1.2, 1.0], &second));
    let cut = format!("{whole}, {}", panel(0.6, "1", [0.6, 1.0], &second));
    assert_same_light("two sides", &both, &cut);
    // Nothing of it is left.
    let [first, second] = [WARM, COLD].map(shining);
    let whole = panel(0.0, "2", [1.2, 1.0], &first);
    let both = format!("{whole}, {}", panel(0.1, "2", [0.6, 0.7], &second));
    assert_same_light("covered", &both, &whole);
}

/// A turned one over another one, both tilted; 25 over one, which are looked up by a grid.
#[test]
fn what_cannot_be_cut_lights_as_what_hangs_before_it() {
    let turned = |y: &str| {
        format!(
            "Group(transform: [Rotate(axis: (1, 0, 0.5), degrees: 20, about: (0, 2, 0))], objects: [
                Rectangle(center: (0.3, {y}, 0.1), normal: (0, -1, 0), size: 0.9, {},
                    transform: [Rotate(axis: (0, 1, 0), degrees: 30)]),
                {}])",
            shining(WARM),
            panel(0.0, "2", [1.2, 1.0], &shining(COLD)),
        )
    };
    assert_same_light("turned", &turned("2"), &turned(GAP));
    let tiles = |y: &str| {
        let places = (0..25).map(|k| (f64::from(k % 5 - 2) * 0.25, f64::from(k / 5 - 2) * 0.25));
        let tile =
            |(x, z)| format!("Rectangle(center: ({x}, {y}, {z}), normal: (0, -1, 0), size: 0.2, {}), ", shining(WARM));
        format!("{}{}", places.map(tile).collect::<String>(), panel(0.0, "2", [1.3, 1.3], &shining(COLD)))
    };
    assert_same_light("tiles", &tiles("2"), &tiles(GAP));
}

#[test]
fn disks_and_caps_light_as_what_is_seen_of_them() {
    let disk = |x: f64, y: &str, radii: [f64; 2], material: &str| {
        let [inner, outer] = radii;
        format!("Disk(center: ({x}, {y}, 0), normal: (0, -1, 0), radius: {outer}, inner_radius: {inner}, {material})")
    };
    let [warm, cold] = [WARM, COLD].map(shining);
    let small = disk(0.0, "2", [0.0, 0.4], &warm);
    assert_same_light(
        "a disk in a disk",
        &format!("{small}, {}", disk(0.0, "2", [0.0, 0.6], &cold)),
        &format!("{small}, {}", disk(0.0, "2", [0.4, 0.6], &cold)),
    );
    // Curved shapes come before triangles.
    let rectangle = panel(0.0, "2", [1.2, 1.0], &cold);
    let on = |y: &str| format!("{rectangle}, {}", disk(0.5, y, [0.0, 0.5], &warm));
    assert_same_light("a disk on a rectangle", &on("2"), &on(GAP));
    let through =
        |y: &str| format!("{rectangle}, Cylinder(from: (0.5, {y}, 0), to: (0.5, 2.4, 0), radius: 0.5, {warm})");
    assert_same_light("a cylinder in a rectangle", &through("2"), &through(GAP));
}

#[test]
fn triangles_light_as_the_pieces_that_are_seen() {
    let triangle = |corners: [[f64; 2]; 3], material: &str| {
        let [a, b, c] = corners.map(|[x, z]| format!("({x}, 2, {z})"));
        format!("Mesh(points: [{a}, {b}, {c}], faces: [[0, 1, 2]], {material})")
    };
    let [first, second] = [WARM, COLD].map(shining);
    // All face down. The first is the half of the second to the left of x = 0.25.
    let whole = triangle([[-0.75, -0.5], [0.25, -0.5], [0.25, 0.75]], &first);
    let both = format!("{whole}, {}", triangle([[-0.75, -0.5], [1.25, -0.5], [0.25, 0.75]], &second));
    let cut = format!("{whole}, {}", triangle([[0.25, -0.5], [1.25, -0.5], [0.25, 0.75]], &second));
    assert_same_light("triangles", &both, &cut);
}

/// What shines is seen, not what is matt in its plane: neither takes any of its light, whichever comes first.
#[test]
fn what_is_matt_takes_no_light_from_a_lamp_in_its_plane() {
    let black = "material: Diffuse(albedo: 0)";
    let disk = |radius: f64, material: &str| {
        format!("Disk(center: (0, 2, 0), normal: (0, -1, 0), radius: {radius}, {material})")
    };
    let lamp = disk(0.5, &shining(WARM));
    assert_same_light("a disk on a disk", &format!("{}, {lamp}", disk(0.8, black)), &lamp);
    let matt = |y: &str| panel(0.3, y, [1.2, 1.6], "material: Diffuse(albedo: 0.4)");
    let lamp = panel(-0.3, "2", [1.2, 1.0], &shining(WARM));
    let behind = format!("{lamp}, {}", matt("2.0001"));
    assert_same_light("a poster after a lamp", &format!("{lamp}, {}", matt("2")), &behind);
    assert_same_light("a lamp after a poster", &format!("{}, {lamp}", matt("2")), &behind);
}

/// Photons and light paths start where a lamp is seen.
#[test]
fn what_guides_starts_where_lamps_are_seen() {
    let casters = "Sphere(center: (0.6, 0.5, 0.8), radius: 0.5, material: Transparent(ior: 1.5)), \
                   Sphere(center: (1.8, 0.4, -0.4), radius: 0.4, material: Mirror(reflectance: 0.9))";
    let [first, second] = [WARM, COLD].map(shining);
    let whole = panel(-0.1, "2", [0.4, 0.5], &first);
    let both = format!("{casters}, {whole}, {}", panel(0.1, "2", [0.4, 0.5], &second));
    let cut = format!("{casters}, {whole}, {}", panel(0.2, "2", [0.2, 0.5], &second));
    assert_guiding_is_unbiased("lamps that overlap", &room(&both), 1024, 1);
    assert_same_scenes("over glass and mirrors", &room(&both), &room(&cut), 1024);
}
