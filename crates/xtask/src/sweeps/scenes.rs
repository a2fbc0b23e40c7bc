//! What is swept: eight scenes, each by the parameter that has most to say there, and three films of 24 frames.

use crate::truth::rooms::walls;

/// A family of scenes over a parameter.
pub struct Sweep {
    /// What changes.
    pub name: &'static str,
    /// From where to where.
    pub range: [f64; 2],
    /// Whether steps are factors rather than differences.
    pub factors: bool,
    /// Whether it is a film: its frames are compared, too.
    pub film: bool,
    /// The scene at a value, as a person would write it, for a picture of so many pixels.
    pub scene: fn(f64, u32) -> String,
}

impl Sweep {
    /// The value at a step.
    pub fn value(&self, step: usize, steps: usize) -> f64 {
        let at = step as f64 / (steps - 1).max(1) as f64;
        let [from, to] = self.range;
        // Powers reach no picture but through the text of the scene.
        if self.factors { from * libm::pow(to / from, at) } else { from + at * (to - from) }
    }
}

fn scene(size: u32, camera: &str, rest: &str, objects: &str) -> String {
    format!(
        "Scene(camera: Camera({camera}), image: Image(width: {size}, height: {size}),\n{rest},\nobjects: [\n{objects}])"
    )
}

const INSIDE: &str = "position: (1.6, 1.7, 1.8), look_at: (-0.1, 1.1, -0.8), fov: 65";
const THINGS: &str = "Sphere(center: (-0.5, 0.4, -0.9), radius: 0.4, material: Diffuse(albedo: (0.7, 0.4, 0.3))),
    Box(center: (0.6, 0.3, -0.4), size: (0.5, 0.6, 0.5), transform: [Rotate(axis: (0, 1, 0), degrees: 30)]),\n";

fn lamp(center: &str, radius: f64, radiance: f64) -> String {
    format!("lights: [SphereLight(center: {center}, radius: {radius}, radiance: {radiance})]")
}

/// A lamp that grows within its bulb, up to filling it.
fn lamp_radius(radius: f64, size: u32) -> String {
    let bulb = "Sphere(center: (0, 2, -0.4), radius: 0.6, material: Transparent(ior: 1.5)),\n";
    let radiance = 1.0 / (radius * radius);
    scene(size, INSIDE, &lamp("(0, 2, -0.4)", radius, radiance), &(walls("") + THINGS + bulb))
}

/// A marble that grows, near the camera and far from its lamp.
fn caster_radius(radius: f64, size: u32) -> String {
    let marble = format!(
        "Rectangle(size: 60, material: Diffuse(albedo: 0.6)),
        Sphere(center: (0, {radius}, 0), radius: {radius}, material: Transparent(ior: 1.5)),\n"
    );
    scene(size, "position: (0, 0.9, 1.2), look_at: (0, 0.1, 0), fov: 40", &lamp("(2, 8, -1)", 0.3, 400.0), &marble)
}

/// The camera goes away from a room without a wall, out into the open.
fn camera_distance(z: f64, size: u32) -> String {
    let camera = format!("position: (0.4, 1.6, {z}), look_at: (0, 1.4, 0), fov: 55");
    let rest = "background: 0.3, ".to_owned() + &lamp("(0, 2.6, 0)", 0.2, 40.0);
    let ball = "Sphere(center: (0.7, 0.4, 0.6), radius: 0.4, material: Transparent(ior: 1.5)),\n";
    scene(size, &camera, &rest, &(walls("near") + THINGS + ball))
}

/// A lamp goes away from a glass ball and a mirror.
fn lamp_distance(distance: f64, size: u32) -> String {
    let objects = "Rectangle(size: 40, material: Diffuse(albedo: 0.6)),
        Sphere(center: (-0.5, 0.5, 0), radius: 0.5, material: Transparent(ior: 1.5)),
        Box(center: (0.9, 0.6, -0.3), size: (0.1, 1.2, 1.4), material: Mirror(reflectance: 0.9)),\n";
    let at = format!("({}, {}, {})", -0.5 * distance, 0.8 * distance, 0.3 * distance);
    let rest = lamp(&at, 0.2, 30.0 * distance * distance);
    scene(size, "position: (0.6, 1.6, 3.2), look_at: (0, 0.4, 0), fov: 42", &rest, objects)
}

/// A glossy floor gets smoother, to all but a mirror.
fn exponent(exponent: f64, size: u32) -> String {
    let floor = format!(
        "Rectangle(size: 30, material: BlinnPhong(albedo: 0.8, exponent: {exponent}, specular: 0.6, energy_conserving: \
         true)),
        Rectangle(center: (0, 2, -3), normal: (0, 0, 1), size: (6, 4), material: Diffuse(albedo: (0.5, 0.6, 0.7))),\n"
    );
    let rest = lamp("(1.5, 2.4, -0.6)", 0.3, 25.0);
    scene(size, "position: (0, 1.4, 3.6), look_at: (0, 0.6, 0), fov: 50", &rest, &(floor + THINGS))
}

/// A room with a lamp; the sky before its open side gets brighter than that.
fn background(radiance: f64, size: u32) -> String {
    let rest = format!("background: {radiance}, ") + &lamp("(0, 2.4, -0.4)", 0.2, 30.0);
    scene(size, INSIDE, &rest, &(walls("left") + THINGS))
}

/// A vitrine before the room's back, in pictures of any size.
fn picture_size(_: f64, size: u32) -> String {
    let vitrine = "Box(center: (0, 0.9, -0.6), size: (2.4, 1.6, 1.6), material: Transparent(ior: 1.5)),\n";
    let (inside, lamp) =
        (THINGS.replace("Sphere(center: (-0.5, 0.4", "Sphere(center: (-0.5, 0.6"), lamp("(0.3, 2.5, 0.3)", 0.2, 40.0));
    scene(size, INSIDE, &lamp, &(walls("") + &inside.replace("(0.6, 0.3, -0.4)", "(0.6, 0.6, -0.4)") + vitrine))
}

/// A room, half of it open, at one seed after the other.
fn seed(_: f64, size: u32) -> String {
    camera_distance(7.0, size)
}

fn moving_marble(x: f64, size: u32) -> String {
    let marble = format!("Sphere(center: ({x}, 0.3, 0.1), radius: 0.3, material: Transparent(ior: 1.5)),\n");
    scene(size, INSIDE, &lamp("(0.2, 2.4, -0.2)", 0.15, 60.0), &(walls("") + THINGS + &marble))
}

fn moving_camera(x: f64, size: u32) -> String {
    let camera = format!("position: ({x}, 1.6, 1.8), look_at: (0, 1, -0.8), fov: 65");
    let mirror = "Box(center: (-1.9, 1.4, -0.6), size: (0.1, 1.6, 1.6), material: Mirror(reflectance: 0.9)),
        Sphere(center: (0.2, 0.3, 0.4), radius: 0.3, material: Transparent(ior: 1.5)),\n";
    scene(size, &camera, &lamp("(0.2, 2.4, -0.2)", 0.15, 60.0), &(walls("") + THINGS + mirror))
}

/// A door in a wall across the room opens; the lamp is behind it.
fn opening_door(width: f64, size: u32) -> String {
    let door = format!(
        "Box(center: (0, 1.5, {}), size: (0.1, 3.3, {})),\nBox(center: (0, 1.5, -1.95), size: (0.1, 3.3, 0.4)),\n",
        (2.15 + width - 1.75) / 2.0,
        2.15 - (width - 1.75)
    );
    let camera = "position: (1.7, 1.6, 1.8), look_at: (0.7, 0.9, -1), fov: 65";
    scene(
        size,
        camera,
        &lamp("(-1, 2, 0.3)", 0.2, 60.0),
        &(walls("") + &door + &THINGS.replace("-0.5, 0.4", "0.9, 0.4").replace("(0.6, 0.3, -0.4)", "(1.4, 0.3, -0.4)")),
    )
}

/// All sweeps. The size of the picture is the parameter itself where it is swept, and so is the seed.
pub const ALL: [Sweep; 11] = [
    Sweep { name: "lamp radius", range: [0.1, 0.59], factors: true, film: false, scene: lamp_radius },
    Sweep { name: "caster radius", range: [0.02, 0.5], factors: true, film: false, scene: caster_radius },
    Sweep { name: "camera distance", range: [1.0, 16.0], factors: true, film: false, scene: camera_distance },
    Sweep { name: "lamp distance", range: [1.5, 24.0], factors: true, film: false, scene: lamp_distance },
    Sweep { name: "exponent", range: [1.0, 100_000.0], factors: true, film: false, scene: exponent },
    Sweep { name: "background", range: [0.001, 100.0], factors: true, film: false, scene: background },
    Sweep { name: SIZE, range: [24.0, 102.0], factors: false, film: false, scene: picture_size },
    Sweep { name: SEED, range: [0.0, 39.0], factors: false, film: false, scene: seed },
    Sweep { name: "a moving marble", range: [-0.9, 0.6], factors: false, film: true, scene: moving_marble },
    Sweep { name: "a moving camera", range: [1.6, -1.2], factors: false, film: true, scene: moving_camera },
    Sweep { name: "an opening door", range: [0.02, 0.9], factors: false, film: true, scene: opening_door },
];

/// The sweep over sizes of the picture.
pub const SIZE: &str = "size of the picture";

/// The sweep over seeds.
pub const SEED: &str = "seed";
