//! Directions to curved lights, and from them: of each the density that is told of it.

use super::*;
use glam::DQuat;
use std::f64::consts::TAU;
use tracer_reference::Random;
use tracer_reference::statistics::{chi_square_tail, sidak};

const FORMS: [UnitShape; 12] = [
    UnitShape::Sphere,
    UnitShape::Disk { inner: 0.0 },
    UnitShape::Disk { inner: 0.6 },
    UnitShape::Cone { radii: [1.0, 1.0], caps: true, upright: false },
    UnitShape::Cone { radii: [1.0, 1.0], caps: false, upright: false },
    UnitShape::Cone { radii: [1.0, 0.0], caps: true, upright: false },
    UnitShape::Cone { radii: [0.3, 1.0], caps: false, upright: false },
    UnitShape::Capsule { half: 1.5 },
    UnitShape::Cone { radii: [0.5, 1.0], caps: true, upright: false },
    UnitShape::Torus { tube: 0.4 },
    UnitShape::Torus { tube: 0.05 },
    UnitShape::Torus { tube: 1.0 },
];

/// Turned; long; flat; squeezed and sheared.
fn maps() -> [DAffine3; 4] {
    let turn = DMat3::from_quat(DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 1.0));
    let scaled = |x: f64, y: f64, z: f64| turn * DMat3::from_diagonal(DVec3::new(x, y, z));
    let sheared = DMat3::from_cols_array_2d(&[[0.9, 0.1, -0.3], [0.4, 1.7, 0.2], [-0.6, 0.5, 0.4]]);
    let at = DVec3::new(0.3, -0.2, 0.5);
    [turn, scaled(0.1, 0.1, 1.0), scaled(1.0, 1.0, 0.05), sheared].map(|matrix3| DAffine3 { matrix3, translation: at })
}

/// Points to see it from: in units of its own and of its size; far, near, within, on its axis, in its plane.
fn places(map: &DAffine3) -> Vec<DVec3> {
    let own = [
        [0.1, 0.05, 0.2],
        [1.3, 0.4, 0.3],
        [0.9, 0.9, -1.2],
        [0.2, 0.1, 1.4],
        [0.0, 0.0, 3.0],
        [0.3, -0.5, -2.6],
        [1.05, 0.0, 0.0],
        [3.0, 1.0, 4.0],
        [-20.0, 5.0, 9.0],
        [0.1, -0.6, 0.03],
    ];
    own.map(|q| map.transform_point3(DVec3::from(q))).to_vec()
}

/// A cone that holds all directions to it in its own space: its axis, and 1 - cos of half its angle.
fn around(lamp: &Lamp, unit: &UnitShape, map: &DAffine3, from: DVec3) -> (DVec3, f64) {
    let own = DAffine3::from_mat3(lamp.inverse * map.matrix3);
    let (to, radius) = (lamp.inverse * (map.translation - from), unit.radius(&own));
    let sin2 = radius * radius / to.length_squared();
    if sin2 >= 1.0 { (to.normalize(), 2.0) } else { (to.normalize(), 1.0 - (1.0 - sin2).sqrt()) }
}

/// A direction of a cone, uniform.
fn of_cone(axis: DVec3, opening: f64, u: f64, v: f64) -> DVec3 {
    let z = 1.0 - u * opening;
    let r = (1.0 - z * z).max(0.0).sqrt();
    let (right, up) = axis.any_orthonormal_pair();
    axis * z + (right * (TAU * v).cos() + up * (TAU * v).sin()) * r
}

/// In which of so many cells of the cone it lies.
fn cell(axis: DVec3, opening: f64, w: DVec3) -> usize {
    let (right, up) = axis.any_orthonormal_pair();
    let u = ((1.0 - w.dot(axis)) / opening).clamp(0.0, 0.999_999);
    let v = (up.dot(w).atan2(right.dot(w)) / TAU).rem_euclid(1.0).min(0.999_999);
    (u * 6.0) as usize * 8 + (v * 8.0) as usize
}

/// What is told of the density of a sample is what is told of its direction, and the samples are spread by it: over
/// cells of directions, whose shares are the sums of the densities over a fine raster. What hides itself is left out
/// from both.
#[test]
fn samples_have_their_density() {
    let mut random = Random::new(3);
    let mut tests = 0;
    let mut worst = (1.0, String::new());
    for (unit, map) in FORMS.iter().flat_map(|unit| maps().map(|map| (unit, map))) {
        for (place, from) in places(&map).into_iter().enumerate() {
            for two_sided in [false, true] {
                let what = format!("{unit:?} {:?} from {place}, {two_sided}", map.matrix3);
                let lamp = Lamp::new(unit, &map, two_sided);
                let (axis, opening) = around(&lamp, unit, &map, from);
                const SAMPLES: u32 = 4000;
                let (mut counts, mut none) = (vec![0; 48], 0u64);
                for _ in 0..SAMPLES {
                    let Some(towards) = lamp.sample(from, random.number(), random.number()) else {
                        none += 1;
                        continue;
                    };
                    let told = lamp.inverse_pdf(from, towards.direction);
                    assert!((told / towards.inverse_pdf - 1.0).abs() < 1e-6, "{what}: {told} {towards:?}");
                    counts[cell(axis, opening, (lamp.inverse * towards.direction).normalize())] += 1;
                }
                // Raster of 120 times 240 directions.
                let (mut shares, mut squares) = (vec![0.0; 48], vec![0.0; 48]);
                for i in 0..120 {
                    for k in 0..240 {
                        let (i, k) = (f64::from(i) + random.number(), f64::from(k) + random.number());
                        let (u, v) = (i / 120.0, k / 240.0);
                        // How much of the solid angle of render space it stands for.
                        let d = of_cone(axis, opening, u, v);
                        let w = lamp.map * d;
                        let solid = lamp.growth / (w.length_squared() * w.length());
                        let inverse = lamp.inverse_pdf(from, w.normalize());
                        if inverse.is_finite() {
                            let weight = solid * TAU * opening / (120.0 * 240.0);
                            let (cell, share) = (cell(axis, opening, d), weight / inverse);
                            shares[cell] += share;
                            squares[cell] += share * share;
                        }
                    }
                }
                let whole: f64 = shares.iter().sum();
                if none == u64::from(SAMPLES) {
                    assert!(whole == 0.0, "{what}: {whole} of nothing");
                    continue;
                }
                let open = matches!(unit, UnitShape::Cone { caps: false, .. });
                // Of some sections of a torus nothing is seen.
                let loses = open || matches!(unit, UnitShape::Torus { .. });
                assert!(loses || none < 40, "{what}: {none} samples are lost");
                // Three standard errors of the share that is lost, five of the raster, whose points stand for more.
                let rough = 0.01 + 5.0 * squares.iter().sum::<f64>().sqrt() + if open { 0.025 } else { 0.0 };
                let expected = 1.0 - none as f64 / f64::from(SAMPLES);
                assert!((whole - expected).abs() < rough, "{what}: {whole}, not {expected}");
                let taken = counts.iter().sum::<u64>() as f64;
                // Counts have the variance of counts, and what the raster tells of a cell that of its points.
                let (mut statistic, mut cells) = (0.0, 0.0);
                for ((&count, &share), &square) in counts.iter().zip(&shares).zip(&squares) {
                    let (expected, spread) = (share / whole * taken, square * (taken / whole) * (taken / whole));
                    // A cell so small that the raster misses it.
                    assert!(expected > 0.0 || count < 25, "{what}: {counts:?} {shares:?}");
                    if expected >= 8.0 {
                        let difference = count as f64 - expected;
                        statistic += difference * difference / (expected + spread);
                        cells += 1.0;
                    }
                }
                let chance = if cells > 0.0 { chi_square_tail(statistic, cells) } else { 1.0 };
                tests += 1;
                if chance < worst.0 {
                    worst = (chance, format!("{what}: {counts:?} {shares:?}"));
                }
            }
        }
    }
    assert!(worst.0 > sidak(1e-6, tests), "{} of {tests}: {}", worst.0, worst.1);
}

/// The mean of one over the density is the solid angle: of a disk from its axis, of a ball, of a long cylinder from
/// beside its middle.
#[test]
fn solid_angles() {
    let mut random = Random::new(5);
    let mut mean = |lamp: &Lamp, from: DVec3| {
        let of = |_| lamp.sample(from, random.number(), random.number()).map_or(0.0, |towards| towards.inverse_pdf);
        (0..100_000).map(of).sum::<f64>() / 100_000.0
    };
    let near = |a: f64, b: f64, what: &str| assert!((a / b - 1.0).abs() < 0.02, "{what}: {a}, not {b}");
    let map = |x: f64, y: f64, z: f64| DAffine3::from_scale(DVec3::new(x, y, z));
    let disk = Lamp::new(&UnitShape::Disk { inner: 0.0 }, &map(2.0, 2.0, 2.0), false);
    near(mean(&disk, DVec3::new(0.0, 0.0, 1.5)), TAU * (1.0 - 1.5 / 2.5), "disk");
    let ball = Lamp::new(&UnitShape::Sphere, &map(1.0, 1.0, 1.0000001), false);
    near(mean(&ball, DVec3::new(0.6, 0.0, 0.8) * 2.0), TAU * (1.0 - 0.75f64.sqrt()), "ball");
    let tube = UnitShape::Cone { radii: [1.0; 2], caps: false, upright: false };
    let tube = Lamp::new(&tube, &map(0.1, 0.1, 1e4), false);
    // As wide as it looks across, and from end to end.
    near(mean(&tube, DVec3::new(0.5, 0.0, 0.0)), 4.0 * 0.2f64.asin(), "tube");
    let capsule = Lamp::new(&UnitShape::Capsule { half: 1e4 }, &map(0.1, 0.1, 0.1), false);
    near(mean(&capsule, DVec3::new(0.5, 0.0, 0.0)), 4.0 * 0.2f64.asin(), "capsule");
}

/// Points where light starts are uniform in true area, once they are weighted: all of it is there, the normals of
/// closed ones cancel out, and by the divergence theorem they tell the volume. What is told of a normal is what is told
/// of the point.
#[test]
fn starts_have_their_density() {
    let mut random = Random::new(7);
    for (unit, map) in FORMS.iter().flat_map(|unit| maps().map(|map| (unit, map))) {
        let lamp = Lamp::new(unit, &map, false);
        let what = format!("{unit:?} {:?}", map.matrix3);
        const SAMPLES: u32 = 200_000;
        let (mut all, mut normals, mut volume, mut others) = (0.0, DVec3::ZERO, 0.0, 0);
        for _ in 0..SAMPLES {
            let start = lamp.start(random.number(), random.number());
            for normal in [start.normal, -start.normal] {
                // A level normal of a capsule's end is one of its side.
                let told = lamp.rarity(normal);
                others += u32::from((told / start.rarity - 1.0).abs() >= 1e-6);
            }
            all += start.rarity;
            normals += start.rarity * start.normal;
            volume += start.rarity * (start.point - map.translation).dot(start.normal);
        }
        assert!(others < 10, "{what}: {others}");
        let mean = 1.0 / f64::from(SAMPLES);
        assert!((all * mean - 1.0).abs() < 0.01, "{what}: {}", all * mean);
        let expected = match *unit {
            UnitShape::Sphere => 2.0 * TAU / 3.0,
            UnitShape::Disk { .. } => {
                let normal = (map.matrix3.inverse().transpose() * DVec3::Z).normalize();
                assert!((normals * mean).distance(normal) < 1e-9, "{what}");
                continue;
            }
            UnitShape::Plane | UnitShape::Cube | UnitShape::Solid(_) | UnitShape::Cone { caps: false, .. } => continue,
            UnitShape::Cone { radii: [a, b], .. } => TAU / 3.0 * (a * a + a * b + b * b),
            UnitShape::Capsule { half } => 2.0 * TAU / 3.0 + TAU * half,
            UnitShape::Torus { tube } => 0.5 * TAU * TAU * tube * tube,
        };
        assert!((normals * mean).length() < 0.01, "{what}: {}", normals * mean);
        let told = volume * mean * lamp.area() / 3.0;
        let expected = expected * map.matrix3.determinant().abs();
        assert!((told / expected - 1.0).abs() < 0.03, "{what}: {told}, not {expected}");
    }
}

/// From very near and very far, of very small and very large ones, what comes is a number, and what is sampled lies on
/// the shape.
#[test]
fn sizes_and_distances() {
    let mut random = Random::new(11);
    for unit in FORMS {
        for size in [1e-6, 1e-3, 1.0, 1e3, 1e6] {
            for away in [1e-6, 1e-3, 0.1, 1.0, 10.0, 1e4] {
                let map = DAffine3::from_scale(DVec3::new(size, size, 0.7 * size));
                let lamp = Lamp::new(&unit, &map, true);
                for _ in 0..200 {
                    let out = round::anywhere(random.number(), random.number());
                    let from = map.transform_point3(out * 2.6 * (1.0 + away));
                    let Some(towards) = lamp.sample(from, random.number(), random.number()) else { continue };
                    let what = format!("{unit:?} of {size} from {away}: {towards:?}");
                    let inverse = towards.inverse_pdf;
                    assert!(inverse > 0.0 && inverse < 1e3, "{what}");
                    let told = lamp.inverse_pdf(from, towards.direction);
                    assert!((told / inverse - 1.0).abs() < 1e-3, "{what}: {told}");
                    let length = towards.distance * towards.direction;
                    let q = lamp.inverse * (from + length - lamp.anchor);
                    assert!(q.length() < 4.0, "{what}: {q}");
                }
            }
        }
    }
}
