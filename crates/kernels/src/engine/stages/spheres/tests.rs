//! Rays and small spheres against double precision. (Large ones: `proofs::surfaces`.)

use super::*;
use crate::lanes::ArrayF;
use crate::scene::Sphere;
use glam::{DVec3, Vec3};
use tracer_reference::Random;

/// Rounding to single precision.
const ULP: f64 = 1.0 / 16_777_216.0;

/// A point of the cube from -1 to 1.
fn point(random: &mut Random) -> DVec3 {
    let mut number = || f64::from((random.bits() >> 40) as u32) / f64::from(1u32 << 23) - 1.0;
    DVec3::new(number(), number(), number())
}

/// A small sphere anywhere: its table, centre and radius.
fn small(random: &mut Random) -> (SphereTable, DVec3, f64) {
    let radius = 0.12 * 10f64.powf(-1.5 * point(random).x.abs());
    let spheres =
        [Sphere { center: point(random), radius, material: 0, object: 0, copy: 0, light: NONE, coordinates: 0 }];
    let table = SphereTable::new(&spheres, 1);
    (table, spheres[0].center, radius)
}

fn unit(v: DVec3) -> Vec3 {
    v.normalize().as_vec3()
}

/// One ray, closest: t, where something is hit.
fn closest(table: &SphereTable, batch: &mut Batch, o: Vec3, d: Vec3, from: u32) -> Option<f64> {
    batch.paths.len = 1;
    for axis in 0..3 {
        batch.paths.origin[axis][0] = o[axis];
        batch.paths.direction[axis][0] = d[axis];
    }
    batch.paths.from_primitive[0] = from;
    spheres_closest::<ArrayF<1>>(table, batch);
    (batch.hits.primitive[0] != NONE).then(|| f64::from(batch.hits.t[0]))
}

/// One segment: whether something is between.
fn occluded(table: &SphereTable, batch: &mut Batch, o: Vec3, d: Vec3, t_max: f64, from: u32) -> bool {
    batch.shadows.len = 1;
    for axis in 0..3 {
        batch.shadows.origin[axis][0] = o[axis];
        batch.shadows.direction[axis][0] = d[axis];
    }
    batch.shadows.t_max[0] = t_max as f32;
    batch.shadows.from_primitive[0] = from;
    batch.shadows.target_primitive[0] = NONE;
    spheres_occluded::<ArrayF<1>>(table, batch);
    batch.shadows.occluded[0] == 1
}

/// Rays from anywhere at small spheres, in units of 2^-24 and with g the way to the centre: the centre is rounded
/// twice, sqrt(3) together; g by |g| sqrt(3) / 2; the middle by 2 |g| more, and half the chord, h, by r / h of what the
/// first two say and as much again of r for the sum of squares. All of it is less than (4 + 4 |g|) r / h, and t is
/// rounded itself. Grazing rays, h below a tenth of r, are left out.
#[test]
fn small_spheres_are_hit_where_double_precision_says() {
    let (mut random, mut batch) = (Random::new(1), Batch::new());
    let (mut hits, mut within) = (0, 0);
    for _ in 0..50_000 {
        let (table, center, radius) = small(&mut random);
        let inside = random.bits() & 3 == 0;
        let o = if inside { center + 0.5 * radius * point(&mut random) } else { 2.0 * point(&mut random) }.as_vec3();
        let d = unit(center + 1.5 * radius * point(&mut random) - o.as_dvec3());
        let g = center - o.as_dvec3();
        let middle = g.dot(d.as_dvec3());
        let half2 = radius * radius - (g - middle * d.as_dvec3()).length_squared();
        if half2.abs() < 0.01 * radius * radius || ((g.length() - radius) / radius).abs() < 0.1 {
            continue;
        }
        let half = half2.max(0.0).sqrt();
        let t = if middle - half > 0.0 { middle - half } else { middle + half };
        let expected = (half2 > 0.0 && t > 0.0).then_some(t);
        let found = closest(&table, &mut batch, o, d, NONE);
        assert_eq!(found.is_some(), expected.is_some(), "{o} {d} {center} {radius}: {found:?} {expected:?}");
        let Some((found, t)) = found.zip(expected) else { continue };
        let bound = 4.0 * ULP * (1.0 + g.length()) * radius / half + ULP * t;
        assert!((found - t).abs() < bound, "{found} is not {t} within {bound}, radius {radius}");
        hits += 1;
        within += usize::from(inside);
        for (end, blocked) in [(0.99 * t, false), (1.01 * t, true), (t + half, true), (1000.0, true)] {
            assert_eq!(
                occluded(&table, &mut batch, o, d, end, NONE),
                blocked,
                "{end} of {t}: {o} {d} {center} {radius}"
            );
        }
    }
    assert!(hits > 20_000 && within > 5000, "{hits} {within}");
}

/// A ray that leaves a small sphere meets it at the other end of its chord or not at all, however flat it leaves; and
/// the chord is found as the way out is.
#[test]
fn small_spheres_do_not_meet_the_rays_that_leave_them() {
    let (mut random, mut batch) = (Random::new(2), Batch::new());
    for _ in 0..50_000 {
        let (table, center, radius) = small(&mut random);
        let n = random.direction();
        let o = (center + radius * n).as_vec3();
        let n = (o.as_dvec3() - center).normalize();
        let slope = 10f64.powf(-4.0 * point(&mut random).x.abs());
        let outwards = random.bits() & 1 == 0;
        let d = unit(n.cross(random.direction()).normalize() + if outwards { slope } else { -slope } * n);
        // The centre is off by sqrt(3) of 2^-24, the start by half of that from the sphere, products of numbers below
        // an eighth by little more: which side is closer than this cannot be told, and the middle of the chord is known
        // to as much.
        let rise = d.as_dvec3().dot(n);
        if rise.abs() < 4.0 * ULP / radius {
            continue;
        }
        let found = closest(&table, &mut batch, o, d, 0);
        let blocked = occluded(&table, &mut batch, o, d, 1000.0, 0);
        assert_eq!((found.is_some(), blocked), (rise < 0.0, rise < 0.0), "rise {rise}, radius {radius}");
        if let Some(t) = found {
            let chord = -2.0 * radius * rise;
            assert!((t - chord).abs() < 8.0 * ULP, "{t} is not {chord}, rise {rise}, radius {radius}");
            assert!(!occluded(&table, &mut batch, o, d, 0.9 * t, 0), "{t}");
        }
    }
}
