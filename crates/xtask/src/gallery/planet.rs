//! Cats all over a planet: placements for `scenes/gallery/cat_planet.ron`.

use crate::cat::write::line;
use crate::noise::lattice;
use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::{PI, TAU};

/// Radius of the planet.
const RADIUS: f64 = 80.0;
/// Cats on it.
const CATS: usize = 12_000;
/// One cat in so many is golden.
const GOLD: i64 = 40;
/// The north pole of the spiral, which would be seen as a pattern, is turned out of sight.
const SPIRAL_AXIS: DVec3 = DVec3::new(0.6, -0.64, 0.48);

/// A cat's place: first scaled, then turned, then moved.
pub struct Placement {
    /// Where its paws are.
    pub translation: DVec3,
    /// Its size.
    pub scale: f64,
    /// How it stands.
    pub rotation: DQuat,
}

/// All cats of the planet.
pub struct Herd {
    /// Those with fur.
    pub tabby: Vec<Placement>,
    /// Those of gold.
    pub gold: Vec<Placement>,
}

/// Cats at the points of a Fibonacci lattice, a little off, looking more or less towards +z.
pub fn herd() -> Herd {
    let mut herd = Herd { tabby: Vec::new(), gold: Vec::new() };
    let axes = DQuat::from_rotation_arc(DVec3::Y, SPIRAL_AXIS.normalize());
    for i in 0..CATS {
        let random = |what: i64| lattice(i as i64, what, 77);
        let golden_angle = PI * (3.0 - 5f64.sqrt());
        let height = 1.0 - (2.0 * i as f64 + 1.0) / CATS as f64;
        let around = (golden_angle * i as f64) % TAU;
        let ring = (1.0 - height * height).sqrt();
        let point = DVec3::new(ring * libm::cos(around), height, ring * libm::sin(around));
        let up = (axes * point + 0.006 * DVec3::new(random(0), random(1), random(2))).normalize();

        let turn = 0.9 * random(3) * random(4).abs() + 0.25 * random(5);
        let ahead = DVec3::new(libm::sin(turn), 0.0, libm::cos(turn));
        let ahead = (ahead - up * ahead.dot(up)).normalize_or(up.any_orthonormal_vector());
        let rotation = DQuat::from_mat3(&DMat3::from_cols(ahead, up, ahead.cross(up)));
        let placement = Placement { translation: up * RADIUS, scale: 0.047 + 0.008 * random(6), rotation };
        if (random(7) * 1e9) as i64 % GOLD == 0 { herd.gold.push(placement) } else { herd.tabby.push(placement) }
    }
    herd
}

/// The placements file: translation, scale, axis and degrees.
pub fn placements(cats: &[Placement]) -> String {
    let mut text = String::from("# Made by `cargo xtask gallery`: x y z, scale, axis, degrees.\n");
    for cat in cats {
        // Axis and angle of a unit quaternion (cos a/2, sin a/2 axis).
        let q = if cat.rotation.w < 0.0 { -cat.rotation } else { cat.rotation };
        let sine = q.xyz().length();
        let axis = q.xyz().normalize_or(DVec3::Y);
        let degrees = 2.0 * libm::atan2(sine, q.w).to_degrees();
        let t = cat.translation;
        line(&mut text, "", &[t.x, t.y, t.z, cat.scale, axis.x, axis.y, axis.z, degrees], 4);
    }
    text
}
