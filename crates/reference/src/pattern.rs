//! Textures that are reckoned, point by point in f64: written after the manual's formulas.

use crate::surface::Surface;
use glam::DVec3;
use scene_format::desc::{Albedo, GradientAxis, LinesAlong, NoiseKind};
use std::f64::consts::TAU;
use tracer_core::Scene;
use tracer_core::scene::Space;

/// The colour of a pattern at a surface.
pub fn color(scene: &Scene, index: u32, s: &Surface) -> DVec3 {
    let pattern = scene.pattern(index).expect("a pattern of the scene");
    let apply = |rows: [[f64; 4]; 3], p: DVec3| {
        DVec3::from(rows.map(|row| row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]))
    };
    let to_object = |instance| apply(scene.to_object(instance).expect("a scene with solid textures"), s.p);
    let p = match pattern.space {
        Space::Uv => DVec3::new(s.uv[0], s.uv[1], 0.0),
        Space::Object => to_object(s.instance),
        Space::World => to_object(None),
    };
    DVec3::from(pattern.a).lerp(DVec3::from(pattern.b), t(&pattern.words, apply(pattern.map, p)))
}

/// Where between a and b.
fn t(words: &Albedo, p: DVec3) -> f64 {
    let wave = |x: f64| 0.5 - 0.5 * (TAU * x).cos();
    match words {
        Albedo::Color(_) | Albedo::Texture(_) => unreachable!("no pattern"),
        Albedo::Checkerboard(_) => p.floor().element_sum().rem_euclid(2.0),
        Albedo::Lines(lines) => {
            let near = |x: f64| (x - x.round()).abs() <= 0.5 * lines.width;
            let on = match lines.along {
                LinesAlong::Both => near(p.x) || near(p.y),
                LinesAlong::U => near(p.y),
                LinesAlong::V => near(p.x),
            };
            f64::from(!on)
        }
        Albedo::Dots(dots) => f64::from((p - p.floor() - 0.5).truncate().length() < dots.radius),
        Albedo::Gradient(gradient) => match gradient.axis {
            GradientAxis::X => p.x,
            GradientAxis::Y => p.y,
            GradientAxis::Z => p.z,
            GradientAxis::Radial => p.length(),
        }
        .clamp(0.0, 1.0),
        Albedo::Noise(noise) => {
            let (count, l, g) = (noise.octaves, noise.lacunarity, noise.gain);
            match noise.kind {
                NoiseKind::Perlin => 0.5 + 0.5 * perlin(p),
                NoiseKind::Fbm => 0.5 + 0.5 * octaves(p, count, l, g, |n| n),
                NoiseKind::Turbulence => octaves(p, count, l, g, f64::abs),
            }
        }
        Albedo::Wood(wood) => wave(p.x.hypot(p.z) + wood.distortion * octaves(p, 4, 2.0, 0.5, |n| n)),
        Albedo::Marble(marble) => wave(p.x + marble.distortion * octaves(p, 6, 2.0, 0.5, f64::abs)),
    }
}

/// sum g^i f(n(l^i p)) / sum g^i.
fn octaves(p: DVec3, count: u32, l: f64, g: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in 0..count {
        sum += g.powi(i as i32) * f(perlin(p * l.powi(i as i32)));
        weights += g.powi(i as i32);
    }
    sum / weights
}

/// Perlin: Improving Noise (2002), as his program has it.
fn perlin(p: DVec3) -> f64 {
    let hash = |k: i64| i64::from(PERMUTATION[k.rem_euclid(256) as usize]);
    let [x, y, z] = p.floor().to_array().map(|x| x as i64);
    let f = p - p.floor();
    let fade = f.to_array().map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
    let mut sum = 0.0;
    for corner in 0..8i64 {
        let at = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
        let weight: f64 = (0..3).map(|k| if at[k] == 1 { fade[k] } else { 1.0 - fade[k] }).product();
        let d = f - DVec3::from(at.map(|k| k as f64));
        let h = hash(hash(hash(x + at[0]) + y + at[1]) + z + at[2]) & 15;
        let u = if h < 8 { d.x } else { d.y };
        let v = if h < 4 {
            d.y
        } else if h == 12 || h == 14 {
            d.x
        } else {
            d.z
        };
        sum += weight * ((if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v }));
    }
    sum
}

/// Perlin's table.
#[rustfmt::skip]
const PERMUTATION: [u8; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225,
    140, 36, 103, 30, 69, 142, 8, 99, 37, 240, 21, 10, 23, 190, 6, 148,
    247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32,
    57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175,
    74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122,
    60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54,
    65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169,
    200, 196, 135, 130, 116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64,
    52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82, 85, 212,
    207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213,
    119, 248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9,
    129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104,
    218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162, 241,
    81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157,
    184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93,
    222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78, 66, 215, 61, 156, 180,
];
