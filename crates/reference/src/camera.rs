//! Camera rays: a point of the pixel by its filter, a point of the lens.

use crate::Ray;
use crate::random::Random;
use glam::DVec3;
use std::f64::consts::{PI, TAU};
use tracer_core::scene::{Camera, Filter, FisheyeMapping, Lens, Projection};

/// A ray through the pixel (column, row); `None` where the picture shows nothing.
pub fn ray(camera: &Camera, size: [u32; 2], pixel: [u32; 2], random: &mut Random) -> Option<Ray> {
    let (dx, dy) = filter(camera.filter, random);
    // From -1 to 1 over the picture, y upwards.
    let x = 2.0 * (f64::from(pixel[0]) + 0.5 + dx) / f64::from(size[0]) - 1.0;
    let y = 1.0 - 2.0 * (f64::from(pixel[1]) + 0.5 + dy) / f64::from(size[1]);
    let (camera, [x, y]) = &of_eye(camera, pixel_place(size, pixel), [x, y]);
    // Drawn with or without a lens: pictures of the one are then those of the other but for it.
    let polar = [random.number(), random.number()];
    let Ray { mut origin, mut direction } = through(camera, *x, *y)?;
    if let Projection::Perspective { lens: Some(lens), .. } = camera.projection {
        // The ray through the lens' middle is not bent; all rays of a point meet where it crosses the plane of focus.
        let on_lens = point_of(&lens, polar, random);
        let on_lens = camera.right.normalize() * on_lens[0] + camera.up.normalize() * on_lens[1];
        let normal = lens.tilted.unwrap_or(camera.forward);
        let distance = lens.focus_distance * normal.dot(camera.forward) / normal.dot(direction);
        let focus = direction * distance;
        // Where the plane is behind the eye, rays go away from their common point.
        direction = (focus - on_lens) * distance.signum();
        origin += on_lens;
    }
    let direction = direction.normalize();
    let start = camera.near / direction.dot(camera.forward);
    Some(Ray { origin: origin + if camera.near > 0.0 { start * direction } else { DVec3::ZERO }, direction })
}

/// The middle of a pixel, from -1 to 1.
fn pixel_place(size: [u32; 2], pixel: [u32; 2]) -> [f64; 2] {
    let [x, y] = [0, 1].map(|axis| (2.0 * f64::from(pixel[axis]) + 1.0) / f64::from(size[axis]) - 1.0);
    [x, -y]
}

/// Of two eyes that share a picture that which has a pixel, as a camera by itself, and a place as it has it: cameras
/// that stand beside each other with their films moved inwards, and in a panorama for each column two of their own.
pub fn of_eye(camera: &Camera, pixel: [f64; 2], [x, y]: [f64; 2]) -> (Camera, [f64; 2]) {
    let Some(stereo) = camera.stereo else { return (*camera, [x, y]) };
    let is_right = if stereo.above { pixel[1] <= 0.0 } else { pixel[0] >= 0.0 };
    let place = match (stereo.above, is_right) {
        (false, false) => [2.0 * x + 1.0, y],
        (false, true) => [2.0 * x - 1.0, y],
        (true, false) => [x, 2.0 * y - 1.0],
        (true, true) => [x, 2.0 * y + 1.0],
    };
    let aside = if is_right { stereo.aside } else { -stereo.aside };
    let mut one = Camera { stereo: None, ..*camera };
    match &mut one.projection {
        Projection::Perspective { shift, .. } => {
            one.eye += aside * camera.right.normalize();
            shift[0] += if is_right { -stereo.inwards } else { stereo.inwards };
        }
        _ => {
            let ahead = through(&one, place[0], 0.0).expect("a panorama shows all").direction;
            one.eye += aside * ahead.cross(camera.up);
        }
    }
    (one, place)
}

/// The ray from the eye to a place in the picture, `near` and lens aside.
pub fn through(camera: &Camera, x: f64, y: f64) -> Option<Ray> {
    let Camera { eye, forward, right, up, .. } = *camera;
    let ray = |direction: DVec3| Ray { origin: eye, direction: direction.normalize() };
    match camera.projection {
        Projection::Perspective { shift, .. } => Some(ray(forward + (x + shift[0]) * right + (y + shift[1]) * up)),
        Projection::Orthographic => Some(Ray { origin: eye + x * right + y * up, direction: forward }),
        Projection::Panorama => {
            let (longitude, latitude) = (PI * x, PI / 2.0 * y);
            let level = longitude.cos() * forward + longitude.sin() * right;
            Some(ray(latitude.cos() * level + latitude.sin() * up))
        }
        Projection::Fisheye { mapping, scale } => {
            let place = x * right + y * up;
            let r = place.length();
            let angle = match mapping {
                FisheyeMapping::Equidistant => scale * r,
                FisheyeMapping::Equisolid => 2.0 * (scale * r).min(1.0).asin(),
                FisheyeMapping::Stereographic => 2.0 * (scale * r).atan(),
                FisheyeMapping::Orthographic => (scale * r).min(1.0).asin(),
            };
            let towards = place.normalize_or_zero();
            (r < 1.0).then(|| ray(angle.cos() * forward + angle.sin() * towards))
        }
    }
}

/// A uniform point of the lens, to the right and up.
fn point_of(lens: &Lens, [turn, share]: [f64; 2], random: &mut Random) -> [f64; 2] {
    if lens.blades < 3 {
        let (sin, cos) = (TAU * turn).sin_cos();
        return [cos, sin].map(|side| side * share.sqrt() * lens.radius);
    }
    let step = TAU / f64::from(lens.blades);
    loop {
        let point = [random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
        // Below each side, whose normal lies half way between two corners.
        let reach = (step / 2.0).cos();
        let inside = (0..lens.blades).all(|side| {
            let (sin, cos) = (TAU * lens.rotation + step * (f64::from(side) + 0.5)).sin_cos();
            point[0] * cos + point[1] * sin < reach
        });
        if inside {
            return point.map(|side| side * lens.radius);
        }
    }
}

/// An offset from the pixel's centre with the filter as its density.
fn filter(filter: Filter, random: &mut Random) -> (f64, f64) {
    let (u, v) = (random.number(), random.number());
    match filter {
        Filter::Centre => (0.0, 0.0),
        Filter::Box => (u - 0.5, v - 0.5),
        // Box and Muller 1958.
        Filter::Gaussian(sigma) => {
            let r = sigma * (-2.0 * (1.0 - u).ln()).sqrt();
            (r * (TAU * v).cos(), r * (TAU * v).sin())
        }
        Filter::BlackmanHarris(radius) => (radius * blackman_harris(random), radius * blackman_harris(random)),
    }
}

/// A number with the 4-term Blackman-Harris window (Harris 1978) on [-1, 1] as its density, by rejection.
fn blackman_harris(random: &mut Random) -> f64 {
    loop {
        let x = random.between(-1.0, 1.0);
        let a = PI * x;
        let window = 0.35875 + 0.48829 * a.cos() + 0.14128 * (2.0 * a).cos() + 0.01168 * (3.0 * a).cos();
        if random.number() < window {
            return x;
        }
    }
}
