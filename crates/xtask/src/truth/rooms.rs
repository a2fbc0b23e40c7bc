//! Ten rooms in which light is hard to find, and the squares that their noise must not show.

use super::squares::{LIMIT, Squares, squares};
use super::trial::Source;
use super::written::compiled;

/// Pixels along a side: seven borders of 8 pixels, three of 16.
const SIZE: u32 = 64;

/// The walls of a room of 4 by 3 by 4 about (0, 1.5, 0), a floor and a ceiling, but for the sides named; solid, and
/// into each other at the corners, so that no light comes through.
pub fn walls(without: &str) -> String {
    [
        ("left", "(-2.1, 1.5, 0)", "(0.2, 3.4, 4.4)", 0.6),
        ("right", "(2.1, 1.5, 0)", "(0.2, 3.4, 4.4)", 0.5),
        ("floor", "(0, -0.1, 0)", "(4.4, 0.2, 4.4)", 0.55),
        ("ceiling", "(0, 3.1, 0)", "(4.4, 0.2, 4.4)", 0.75),
        ("far", "(0, 1.5, -2.1)", "(4.4, 3.4, 0.2)", 0.7),
        ("near", "(0, 1.5, 2.1)", "(4.4, 3.4, 0.2)", 0.7),
    ]
    .iter()
    .filter(|wall| !without.contains(wall.0))
    .map(|(_, center, size, albedo)| {
        format!("Box(center: {center}, size: {size}, material: Diffuse(albedo: {albedo})),\n")
    })
    .collect()
}

/// A wall across x = 0 with a hole between these z and y.
fn partition(z: [f64; 2], y: [f64; 2]) -> String {
    let block = |low: [f64; 2], high: [f64; 2]| {
        let middle = [0, 1].map(|k: usize| (low[k] + high[k]) / 2.0);
        let size = [0, 1].map(|k: usize| high[k] - low[k]);
        format!("Box(center: (0, {}, {}), size: (0.1, {}, {})),\n", middle[1], middle[0], size[1], size[0])
    };
    let (low, high) = (-2.15, 2.15);
    let (floor, ceiling) = (-0.15, 3.15);
    block([low, floor], [z[0], ceiling])
        + &block([z[1], floor], [high, ceiling])
        + &block([z[0], floor], [z[1], y[0]])
        + &block([z[0], y[1]], [z[1], ceiling])
}

/// Things on the floor at x.
fn things(x: f64) -> String {
    format!(
        "Sphere(center: ({x}, 0.4, -0.9), radius: 0.4, material: Diffuse(albedo: (0.7, 0.4, 0.3))),\n\
         Box(center: ({}, 0.3, -0.2), size: (0.5, 0.6, 0.5), transform: [Rotate(axis: (0, 1, 0), degrees: 30)]),\n",
        x + 0.7
    )
}

fn lamp(center: &str, radius: f64, radiance: f64) -> String {
    format!("SphereLight(center: {center}, radius: {radius}, radiance: {radiance})")
}

/// The rooms: their names, and scenes as a person would write them.
// Long: a list of scenes.
pub fn all() -> Vec<(&'static str, String)> {
    let scene = |eye: &str, at: &str, lights: String, background: f64, objects: String| {
        format!(
            "Scene(camera: Camera(position: {eye}, look_at: {at}, fov: 65), image: Image(width: {SIZE}, height: \
             {SIZE}),\n\
             background: {background}, lights: [{lights}],\nobjects: [\n{objects}])"
        )
    };
    let (eye, at) = ("(1.7, 1.6, 1.8)", "(0.7, 0.9, -1)");
    let (whole, behind) = (walls(""), lamp("(-1, 2, 0.3)", 0.2, 60.0));
    vec![
        (
            "a door ajar",
            scene(eye, at, behind.clone(), 0.0, whole.clone() + &partition([-1.9, -1.75], [0.0, 2.0]) + &things(0.6)),
        ),
        (
            "a pinhole",
            scene(
                eye,
                at,
                lamp("(-1, 1.5, -0.3)", 0.3, 300.0),
                0.0,
                whole.clone() + &partition([-0.5, -0.44], [1.4, 1.46]) + &things(0.6),
            ),
        ),
        (
            "a key light behind a curtain",
            scene(eye, at, lamp("(-1.2, 2.3, 0.5)", 0.15, 90.0), 0.0, whole.clone() + &curtain() + &things(0.6)),
        ),
        (
            "a lamp in an open box",
            scene(eye, at, lamp("(0.2, 2.35, -0.6)", 0.08, 250.0), 0.0, whole.clone() + &open_box() + &things(0.4)),
        ),
        ("a small window", scene(eye, at, String::new(), 25.0, walls("left") + &window() + &things(0.4))),
        (
            "a lamp behind a column",
            scene(
                eye,
                at,
                lamp("(-0.9, 1.2, -1.4)", 0.12, 120.0),
                0.0,
                whole.clone() + "Box(center: (-0.2, 1.5, -0.6), size: (0.7, 3.2, 0.7)),\n" + &things(0.8),
            ),
        ),
        (
            "a lamp in a bulb of glass",
            scene(
                eye,
                at,
                lamp("(0.1, 2.2, -0.3)", 0.1, 200.0),
                0.0,
                whole.clone()
                    + "Sphere(center: (0.1, 2.2, -0.3), radius: 0.3, material: Transparent(ior: 1.5)),\n"
                    + &things(0.6),
            ),
        ),
        (
            "light over a mirror through a door",
            scene(
                eye,
                at,
                behind,
                0.0,
                whole.clone()
                    + &partition([-1.2, -0.7], [0.0, 2.0])
                    + &things(0.6)
                    + "Box(center: (-1.5, 1.4, -1.9), size: (0.9, 1.4, 0.05), material: Mirror(reflectance: 0.9)),\n",
            ),
        ),
        (
            "lamps along a cornice",
            scene(
                eye,
                at,
                [-1.4, -0.7, 0.0, 0.7, 1.4].map(|x| lamp(&format!("({x}, 2.85, -1.85)"), 0.05, 200.0)).join(", "),
                0.0,
                whole.clone()
                    + "Box(center: (0, 2.7, -1.75), size: (3.9, 0.1, 0.5)),\n\
                       Box(center: (0, 2.78, -1.52), size: (3.9, 0.25, 0.06)),\n"
                    + &things(0.4),
            ),
        ),
        (
            "a shining strip under a bed",
            scene(
                eye,
                at,
                String::new(),
                0.0,
                whole
                    + "Box(center: (0.2, 0.55, -0.8), size: (1.8, 0.2, 1.6)),\n\
                       Rectangle(center: (0.2, 0.42, -0.8), normal: (0, -1, 0), size: (1.4, 0.3), material: \
                       Emissive(radiance: 40)),\n",
            ),
        ),
    ]
}

/// Eleven slats that overlap, all before the lamp.
fn curtain() -> String {
    (0..11)
        .map(|k| {
            let z = -2.0 + 0.4 * f64::from(k);
            format!(
                "Box(center: (-0.2, 1.45, {z}), size: (0.04, 2.9, 0.36), transform: [Rotate(axis: (0, 1, 0), \
                     degrees: 35)]),\n"
            )
        })
        .collect()
}

/// A box whose lid is off: the lamp in it lights the ceiling.
fn open_box() -> String {
    let side = |x: f64, z: f64, sx: f64, sz: f64| format!("Box(center: ({x}, 2.38, {z}), size: ({sx}, 0.5, {sz})),\n");
    side(-0.1, -0.6, 0.04, 0.64)
        + &side(0.5, -0.6, 0.04, 0.64)
        + &side(0.2, -0.9, 0.64, 0.04)
        + &side(0.2, -0.3, 0.64, 0.04)
        + "Box(center: (0.2, 2.12, -0.6), size: (0.64, 0.04, 0.64)),\n"
}

/// The left wall with a window of 0.4 by 0.4.
fn window() -> String {
    let block = |low: [f64; 2], high: [f64; 2]| {
        let middle = [0, 1].map(|k: usize| (low[k] + high[k]) / 2.0);
        let size = [0, 1].map(|k: usize| high[k] - low[k]);
        format!("Box(center: (-2.1, {}, {}), size: (0.2, {}, {})),\n", middle[1], middle[0], size[1], size[0])
    };
    block([-2.2, -0.2], [-0.7, 3.2])
        + &block([-0.3, -0.2], [2.2, 3.2])
        + &block([-0.7, -0.2], [-0.3, 1.5])
        + &block([-0.7, 1.9], [-0.3, 3.2])
}

/// Measures all rooms, or those whose names hold `name`, at these numbers of samples; gives how many upper bounds are
/// above the limit.
///
/// # Errors
/// A scene is refused; nothing has such a name.
pub fn run(samples: &[u32], name: &str, pictures: u32) -> anyhow::Result<usize> {
    anyhow::ensure!(pictures > 3, "four pictures at least");
    let rooms: Vec<_> = all().into_iter().filter(|room| room.0.contains(name)).collect();
    anyhow::ensure!(!rooms.is_empty(), "no room has {name:?} in its name");
    println!(
        "{pictures} pictures of {SIZE}x{SIZE}; ratio of squared steps at borders, and its upper bound at 95 % ({LIMIT} \
         is right)"
    );
    println!("{:38} {:>7}  {:>16}  {:>16}  below zero", "room", "samples", "8 pixels", "16 pixels");
    let mut above = 0;
    for (name, text) in rooms {
        let scenes = [compiled(&text)?];
        for &samples in samples {
            let source = Source { scenes: &scenes, plain: false, samples, threads: 1, flip: false };
            let measured: [Squares; 2] = squares(&source, 1000, pictures);
            above += measured.iter().filter(|s| s.upper() > LIMIT).count();
            let [small, large] = measured.map(|s| format!("{:.3} < {:.3}", s.ratio, s.upper()));
            let film = source.films(1).remove(0);
            let pixels = (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y)));
            let negative = pixels.filter(|&(x, y)| film.radiance(x, y).iter().any(|&c| c < 0.0)).count();
            println!("{name:38} {samples:>7}  {small:>16}  {large:>16}  {negative}");
        }
    }
    Ok(above)
}
