//! Camera rays: a point of the pixel by its filter, a point of the lens.

use crate::Ray;
use crate::random::Random;
use std::f64::consts::{PI, TAU};
use tracer_core::scene::{Camera, Filter};

/// A ray through the pixel (column, row).
pub fn ray(camera: &Camera, size: [u32; 2], pixel: [u32; 2], random: &mut Random) -> Ray {
    let (dx, dy) = filter(camera.filter, random);
    // From -1 to 1 over the picture, y upwards.
    let x = 2.0 * (f64::from(pixel[0]) + 0.5 + dx) / f64::from(size[0]) - 1.0;
    let y = 1.0 - 2.0 * (f64::from(pixel[1]) + 0.5 + dy) / f64::from(size[1]);
    let through = camera.forward + x * camera.right + y * camera.up;
    // The ray through the lens' middle is not bent; all rays of a point meet where it crosses the plane of focus.
    let (sin, cos) = (TAU * random.number()).sin_cos();
    let r = camera.lens_radius * random.number().sqrt();
    let on_lens = camera.right.normalize() * (r * cos) + camera.up.normalize() * (r * sin);
    Ray { origin: camera.eye + on_lens, direction: (through * camera.focus_distance - on_lens).normalize() }
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
