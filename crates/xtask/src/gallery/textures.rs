//! Textures: marble and a globe (by longitude and latitude), and wood.

use crate::noise::{fractal_noise, noise, smooth_step};
use crate::picture::Picture;
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A direction from texture coordinates: `u` is the longitude, `v` the latitude from the south pole.
fn direction(u: f64, v: f64) -> DVec3 {
    let (longitude, latitude) = (TAU * u, PI * (v - 0.5));
    let ring = libm::cos(latitude);
    DVec3::new(ring * libm::cos(longitude), libm::sin(latitude), ring * libm::sin(longitude))
}

/// White marble with grey veins: the creases of folded noise.
pub fn marble() -> Picture {
    Picture::from_fn(1024, 512, |u, v| {
        let p = direction(u, v);
        let fold = DVec3::new(noise(p * 1.9 + 3.0), noise(p * 1.9 + 41.0), noise(p * 1.9 + 83.0));
        let q = p + 0.55 * fold + 0.12 * fractal_noise(p * 5.0, 3);
        let broad = libm::sin(5.0 * (0.8 * q.x + 1.0 * q.y + 0.5 * q.z)).abs();
        let thin = libm::sin(9.0 * (q.x - 0.6 * q.y + 0.9 * q.z) + 1.0).abs();
        let strength = smooth_step(-0.5, 0.6, noise(p * 2.3 + 19.0));
        let dark = strength * (0.55 * smooth_step(0.35, 0.0, broad) + 0.25 * smooth_step(0.06, 0.0, broad))
            + (1.0 - strength) * 0.35 * smooth_step(0.10, 0.0, thin);
        let cloud = 0.5 + 0.5 * fractal_noise(p * 2.0 + 9.0, 4);
        let stone = DVec3::new(0.96, 0.95, 0.93).lerp(DVec3::new(0.84, 0.85, 0.86), cloud);
        stone.lerp(DVec3::new(0.30, 0.32, 0.36), dark.min(0.9))
    })
}

/// A world that never was: seas, coasts, forests, deserts, snow.
pub fn globe() -> Picture {
    Picture::from_fn(1024, 512, |u, v| {
        let p = direction(u, v);
        let height = fractal_noise(p * 1.5 + 2.3, 7) + 0.02;
        let wet = fractal_noise(p * 2.2 + 31.0, 4);
        let cold = p.y.abs() + 0.12 * fractal_noise(p * 4.0, 4) + 0.35 * height.max(0.0);
        let sea = DVec3::new(0.05, 0.22, 0.42).lerp(DVec3::new(0.20, 0.55, 0.66), smooth_step(-0.22, 0.0, height));
        let dry = DVec3::new(0.82, 0.68, 0.42);
        let green = DVec3::new(0.24, 0.45, 0.18);
        let ground = dry.lerp(green, smooth_step(-0.12, 0.15, wet + 0.25 * p.y.abs()));
        let ground = ground.lerp(DVec3::new(0.45, 0.36, 0.28), smooth_step(0.22, 0.42, height));
        let land = smooth_step(0.0, 0.012, height);
        sea.lerp(ground, land).lerp(DVec3::splat(0.95), smooth_step(0.93, 0.97, cold))
    })
}

/// Boards side by side along v, sawn from the log along its length.
pub fn wood() -> Picture {
    let boards = 5.0;
    Picture::from_fn(1024, 1024, move |u, v| {
        let board = (u * boards).floor();
        let across = u * boards - board;
        let tone = noise(DVec3::new(7.0 * board, 0.5, 3.5));
        // Distance from the log's heart, which lies somewhere below the board.
        let wobble = 0.10 * noise(DVec3::new(2.0 * across, 1.6 * v, 11.0 * board));
        let x = across - 0.5 + 0.4 * noise(DVec3::new(board * 5.0, 0.0, 0.5)) + wobble;
        let ring = (x * x + 0.05 + 0.03 * noise(DVec3::new(0.3, 1.1 * v, 4.0 * board))).sqrt() * 17.0;
        let saw = ring - ring.floor();
        let late = smooth_step(0.25, 0.9, saw) * smooth_step(1.0, 0.92, saw);
        let fibre = noise(DVec3::new(260.0 * u, 9.0 * v, 1.0)) * 0.6 + noise(DVec3::new(120.0 * u, 4.0 * v, 2.0)) * 0.4;
        let light = DVec3::new(0.76, 0.56, 0.36);
        let dark = DVec3::new(0.53, 0.34, 0.19);
        let grain = light.lerp(dark, 0.75 * late) * (1.0 + 0.08 * fibre + 0.10 * tone);
        let gap = smooth_step(0.008, 0.002, across.min(1.0 - across));
        grain.lerp(DVec3::new(0.12, 0.07, 0.04), gap)
    })
}
