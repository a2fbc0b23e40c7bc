//! Directions to luminous spheres, from outside, from within and at grazing angles.

use super::selection::probability;
use super::*;
use crate::lanes::ArrayF;
use crate::scene::{FlatLight, Light, NONE, Sphere};
use glam::DVec3;
use std::f64::consts::TAU;
use tracer_reference::Random;
use tracer_reference::statistics::{chi_square, sidak};

type S = ArrayF<1>;
type M = <S as Lanes>::M;

/// A light with a number was chosen.
fn near() -> M {
    M::from_bits(0)
}

fn scalar(x: S) -> f64 {
    let mut out = [0.0];
    x.store(&mut out);
    f64::from(out[0])
}
fn point(v: V3<S>) -> DVec3 {
    DVec3::new(scalar(v.0), scalar(v.1), scalar(v.2))
}
fn number(random: &mut Random) -> S {
    S::splat((random.bits() >> 40) as f32 / 16_777_216.0)
}

/// A receiver at a point, facing up.
fn facing_up(p: V3<S>) -> Receiver<S> {
    Receiver { p, n: V3::splat([0.0, 1.0, 0.0]) }
}

/// How a sphere was met does not matter.
fn met() -> LightHit<S> {
    let direction = V3::splat([0.0, 1.0, 0.0]);
    LightHit { direction, distance: S::splat(1.0), cos: S::splat(1.0), front: S::first(1), lanes: S::first(1) }
}

/// Lights of these centres, radii and radiances.
fn table(lights: &[(DVec3, f64, f64)]) -> LightTable {
    let spheres: Vec<Sphere> = lights
        .iter()
        .enumerate()
        .map(|(k, &(center, radius, _))| Sphere {
            center,
            radius,
            material: NONE,
            object: 0,
            copy: 0,
            light: k as u32,
            coordinates: 0,
        })
        .collect();
    let lights: Vec<Light> = lights
        .iter()
        .enumerate()
        .map(|(k, &(.., radiance))| Light::Sphere {
            sphere: k as u32,
            radiance: [radiance, 0.5, 0.0],
            two_sided: true,
            is_sky: false,
        })
        .collect();
    LightTable::new(&lights, &spheres, None)
}

/// Distances of a point from the centre of a light of radius 1: far, near, just outside, on it, just within, at its
/// centre.
const DISTANCES: [f64; 9] = [1000.0, 30.0, 3.0, 1.1, 1.001, 1.0, 0.999, 0.5, 0.0];

/// The solid angle that a sphere of radius 1 covers at this distance.
fn solid_angle(distance: f64) -> f64 {
    if distance <= 1.0 {
        return 2.0 * TAU;
    }
    let sin2 = 1.0 / (distance * distance);
    TAU * sin2 / (1.0 + (1.0 - sin2).sqrt())
}

/// Within a sky each light is asked about as often as it sends: E = pi L from all around, pi L (r/d)^2 cos from a small
/// one. It does not matter how large the sky is, nor how many lamps are in it.
#[test]
fn within_a_sky_lamps_are_asked_as_often_as_they_shine() {
    let sun = (DVec3::new(60.0, 80.0, 40.0), 0.5, 45_000.0);
    let lamps: Vec<_> = (0..9).map(|k| (DVec3::new(f64::from(k) - 4.0, 5.0, 3.0), 0.1, 300.0)).collect();
    for (sky, others) in [(120.0, 0), (300.0, 0), (1e4, 0), (300.0, 9), (1e4, 9)] {
        let mut lights = vec![(DVec3::ZERO, sky, 1.0), sun];
        lights.extend(&lamps[..others]);
        let table = table(&lights);
        for p in [DVec3::ZERO, DVec3::new(20.0, 0.0, -30.0), DVec3::new(-3.0, 1.0, 2.0)] {
            // The channels' sum: the second is half of one.
            let of_lamp = |&(center, radius, radiance): &(DVec3, f64, f64)| {
                let to = center - p;
                (radiance + 0.5) * (radius * radius / to.length_squared()) * to.normalize().y.max(0.0)
            };
            let sent: Vec<f64> = std::iter::once(1.5).chain(lights[1..].iter().map(of_lamp)).collect();
            let all: f64 = sent.iter().sum();
            for (k, sent) in sent.iter().enumerate() {
                let at = facing_up(V3::splat(p.to_array().map(|x| x as f32)));
                let light = <S as Lanes>::U::splat(k as u32);
                let asked = scalar(probability(&table, light, at)) / (sent / all);
                // Groups of lamps are told by their middle: the sun and lamps on the ground as twice what they are.
                // None of these has less than a part of the steps to it, however little it sends.
                let (least, most) = match (others, k) {
                    (0, _) => (0.7, 1.4),
                    (_, 0 | 1) => (0.2, 5.0),
                    _ => (0.2, f64::INFINITY),
                };
                assert!((least..most).contains(&asked), "{sky}, {others} others, light {k} at {p}: {asked}");
            }
        }
    }
}

/// A density that is the same within the cone integrates to one when it is one over the cone's solid angle.
#[test]
fn densities_integrate_to_one() {
    let center = DVec3::new(0.3, -0.2, 0.5);
    let lights = table(&[(center, 1.0, 1.0)]);
    let mut random = Random::new(1);
    for distance in DISTANCES {
        for _ in 0..20 {
            let p = (center + distance * random.direction()).as_vec3();
            let v = V3::<S>::splat(p.to_array());
            let density = scalar(pdf(&lights, <S as Lanes>::U::splat(0), facing_up(v), &met()));
            // Where the point really is, after rounding. Close to the surface the solid angle grows with a square root
            // of the distance to it: rounding of the point (1e-7) then moves it by up to sqrt(2e-7) = 5e-4.
            let at = (p.as_dvec3() - center.as_vec3().as_dvec3()).length();
            let near = (at - 1.0).abs() < 1e-5;
            if near {
                assert!((2.0 * TAU * density - 1.5).abs() < 0.502, "on the surface: {density}");
                continue;
            }
            let error = (density * solid_angle(at) - 1.0).abs();
            assert!(error < if (at - 1.0).abs() < 0.01 { 1e-4 } else { 2e-6 }, "distance {at}: {error}");
        }
    }
}

/// Sampled directions meet the light, at the distance that is said, and their density is the one that meeting it gives.
#[test]
fn samples_meet_the_light() {
    let center = DVec3::new(0.3, -0.2, 0.5);
    let lights = table(&[(center, 1.0, 1.0)]);
    let mut random = Random::new(2);
    for distance in DISTANCES {
        for _ in 0..500 {
            let p = (center + distance * random.direction()).as_vec3();
            let v = V3::<S>::splat(p.to_array());
            let k = <S as Lanes>::U::splat(0);
            let choice = Choice { light: k, probability: S::splat(1.0), environment: near() };
            let sample =
                sample(&lights, &choice, Start::free(v), number(&mut random), number(&mut random), S::first(1));
            // Each of them is rounded three times at most.
            let product = scalar(sample.inverse_pdf) * scalar(pdf(&lights, k, facing_up(v), &met()));
            assert!((product - 1.0).abs() < 6.0 * 2f64.powi(-24), "distance {distance}: {product}");
            let (wi, t) = (point(sample.wi), scalar(sample.distance));
            assert!((wi.length() - 1.0).abs() < 2e-6);
            assert!(t > 0.0 || (distance - 1.0).abs() < 1e-2, "behind, from distance {distance}: {t}");
            let met = p.as_dvec3() + t * wi - center;
            // The chord's end is found to sqrt(rounding) where the direction only just touches.
            let rounding = 1e-6 * distance.max(1.0);
            assert!(
                (met.length() - 1.0).abs() < 2.0 * rounding.sqrt() * 1e-1 + rounding,
                "distance {distance}: {}",
                met.length()
            );
            if distance > 1.0 {
                assert!(met.dot(wi) < rounding.sqrt(), "the far side, from distance {distance}");
            }
        }
    }
}

/// Uniform in the cone (1 - cos to the axis over its largest value, and the angle about the axis), 5 % for all
/// distances together.
#[test]
fn directions_are_uniform_in_the_cone() {
    let level = sidak(0.05, DISTANCES.len());
    let center = DVec3::new(0.3, -0.2, 0.5);
    let lights = table(&[(center, 1.0, 1.0)]);
    let mut random = Random::new(3);
    for distance in DISTANCES {
        let p = (center + distance * DVec3::new(0.6, 0.48, 0.64)).as_vec3();
        let to_center = center.as_vec3().as_dvec3() - p.as_dvec3();
        let axis = to_center.try_normalize().unwrap_or(DVec3::Z);
        let opening = solid_angle(to_center.length()) / TAU;
        let (x, y) = axis.any_orthonormal_pair();
        let mut cells = vec![0u64; 128];
        for _ in 0..50_000 {
            let only = Choice { light: <S as Lanes>::U::splat(0), probability: S::splat(1.0), environment: near() };
            let wi = point(
                sample(
                    &lights,
                    &only,
                    Start::free(V3::splat(p.to_array())),
                    number(&mut random),
                    number(&mut random),
                    S::first(1),
                )
                .wi,
            );
            // 1 - cos from the chord, which keeps its digits.
            let share = 0.5 * (wi - axis).length_squared() / opening;
            let turn = libm::atan2(wi.dot(y), wi.dot(x)).rem_euclid(TAU) / TAU;
            cells[8 * ((16.0 * share) as usize).min(15) + ((8.0 * turn) as usize).min(7)] += 1;
        }
        let probability = chi_square(&cells, &[50_000.0 / 128.0; 128]);
        assert!(probability > level, "distance {distance}: p {probability}");
    }
}

/// Lights are chosen as their probabilities say, from near, from afar and from between them; the probabilities sum to
/// one.
#[test]
fn lights_are_chosen_as_their_probabilities_say() {
    let place = |k: u32| DVec3::new(f64::from(k % 5), f64::from(k * k % 7), f64::from(k / 5));
    let lights: Vec<(DVec3, f64, f64)> =
        (0..23).map(|k| (3.0 * place(k), 0.1 + f64::from(k % 4) * 0.2, 0.3 + f64::from(k % 7))).collect();
    let table = table(&lights);
    let mut random = Random::new(4);
    let points = [[6.0, 9.0, 6.0], [0.0, 0.05, 0.0], [-300.0, 200.0, 100.0], [7.0, -2.0, 3.0]];
    let level = sidak(0.05, points.len());
    for p in points {
        // From the second and the third, lights lie on both sides of the horizon.
        let p = Receiver { p: V3::<S>::splat(p), n: V3::splat([0.6, 0.0, 0.8]) };
        let chance = |k: u32| scalar(probability(&table, <S as Lanes>::U::splat(k), p));
        let chances: Vec<f64> = (0..23).map(chance).collect();
        // 23 products of up to 5 factors that are rounded to 2^-24.
        assert!((chances.iter().sum::<f64>() - 1.0).abs() < 23.0 * 5.0 * 6e-8);
        let mut counts = vec![0u64; lights.len()];
        let n = 1_000_000;
        for _ in 0..n {
            let choice = choose::<S>(&table, p, number(&mut random), number(&mut random));
            let mut out = [0];
            choice.light.store(&mut out);
            counts[out[0] as usize] += 1;
            assert_eq!(scalar(choice.probability), chances[out[0] as usize]);
        }
        let expected: Vec<f64> = chances.iter().map(|c| c * f64::from(n)).collect();
        assert!(chi_square(&counts, &expected) > level, "{counts:?} {expected:.0?}");
    }
}

/// The density of a direction to one of several lights is that of the light times that of the direction to it, however
/// it is asked for.
#[test]
fn densities_hold_the_choice_of_the_light() {
    let lights = [(DVec3::ZERO, 0.5, 1.0), (DVec3::X * 3.0, 0.2, 4.0), (DVec3::Y * 2.0, 1.0, 0.5)];
    let table = table(&lights);
    let mut random = Random::new(5);
    for p in [[1.0, 1.0, 1.0], [0.1, 0.2, -0.1], [-8.0, 3.0, 5.0]] {
        let v = V3::<S>::splat(p);
        // Facing the middle of them, so that none lies behind.
        let n = (DVec3::new(1.0, 2.0 / 3.0, 0.0) - DVec3::from(p.map(f64::from))).normalize().as_vec3();
        let at = Receiver { p: v, n: V3::splat(n.to_array()) };
        for (k, (center, radius, _)) in lights.iter().enumerate() {
            let light = <S as Lanes>::U::splat(k as u32);
            let chance = probability(&table, light, at);
            let distance = (DVec3::from(p.map(f64::from)) - center).length() / radius;
            let expected = scalar(chance) / solid_angle(distance);
            // Some twenty roundings of 2^-24.
            let is_right = |density: f64| (density / expected - 1.0).abs() < 2e-6;
            assert!(scalar(chance) < 0.99 && is_right(scalar(pdf(&table, light, at, &met()))), "light {k} from {p:?}");
            let choice = Choice { light, probability: chance, environment: near() };
            let sample = sample(&table, &choice, Start::free(v), number(&mut random), number(&mut random), S::first(1));
            assert!(is_right(1.0 / scalar(sample.inverse_pdf)), "light {k} from {p:?}, sampled");
        }
    }
}

/// Far away two lights are chosen by power; close to one of them, that one.
#[test]
fn near_lights_are_chosen_more_often() {
    let table = table(&[(DVec3::ZERO, 0.1, 1.0), (DVec3::X * 10.0, 0.1, 2.5)]);
    let chance = |p: [f32; 3], n: [f32; 3]| {
        let at = Receiver { p: V3::<S>::splat(p), n: V3::splat(n) };
        scalar(probability(&table, <S as Lanes>::U::splat(0), at))
    };
    // (1 + 0.5) / (1 + 0.5 + 2.5 + 0.5), see `table`.
    assert!((chance([5.0, 1e6, 0.0], [0.0, -1.0, 0.0]) - 1.0 / 3.0).abs() < 1e-5);
    // Both on the horizon: their radius above it.
    let sends = |power: f64, d2: f64| power * 0.1 / (d2 + 0.1 * 0.01).powf(1.5);
    let near = |d: f64| sends(1.5, d * d) / (sends(1.5, d * d) + sends(3.0, (10.0 - d) * (10.0 - d)));
    assert!((chance([3.0, 0.0, 0.0], [0.0, 1.0, 0.0]) - near(3.0)).abs() < 1e-5);
    // The other one may be all that is not hidden.
    assert!(near(1.0) > 0.997 && chance([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]) == 1.0 - 1.0 / 16.0);
}

/// A light that lies wholly behind the receiver is not chosen where another is not; one of which a bit shows is.
#[test]
fn lights_behind_are_not_chosen() {
    let table = table(&[(DVec3::Y * 10.0, 0.5, 1.0), (DVec3::Y * -10.0, 0.5, 100.0)]);
    let chance = |light: u32, height: f32| {
        let at = facing_up(V3::splat([1.0, height, 0.0]));
        scalar(probability(&table, <S as Lanes>::U::splat(light), at))
    };
    assert_eq!([chance(0, 0.0), chance(1, 0.0)], [1.0, 0.0]);
    assert_eq!([chance(0, -9.49), chance(1, -9.49)], [1.0, 0.0]);
    assert!(chance(1, -9.51) > 0.0 && chance(1, -10.4) > 0.5);
}

/// Lights in clouds through which the horizon goes: each that shows above it can be chosen, however many below it are
/// in its nodes.
#[test]
fn lights_that_show_are_in_reach() {
    let mut random = Random::new(8);
    let mut showing = 0;
    for cloud in 0..20 {
        let lights: Vec<_> = (0..64)
            .map(|_| {
                let [x, y, z] = [0; 3].map(|_| 10.0 * (scalar(number(&mut random)) - 0.5));
                // From cloud to cloud lower: from half of them above the horizon to a tenth.
                (DVec3::new(x + 7.0, y - 0.2 * f64::from(cloud), z), 0.1, 1.0)
            })
            .collect();
        let table = table(&lights);
        let at = facing_up(V3::splat([0.0; 3]));
        for (k, (center, radius, _)) in (0..).zip(&lights) {
            // Beyond the rounding of single precision.
            if center.y + radius > 1e-4 {
                assert!(scalar(probability(&table, <S as Lanes>::U::splat(k), at)) > 0.0, "cloud {cloud}, light {k}");
                showing += 1;
            }
        }
    }
    assert!(showing > 300, "{showing}");
}

/// Small triangles with these centres and normals, in a tree.
fn triangles(lights: &[(DVec3, DVec3)]) -> LightTable {
    let triangle = |&(center, normal): &(DVec3, DVec3)| {
        let [a, b] = [normal.any_orthonormal_vector(), normal.cross(normal.any_orthonormal_vector())];
        let corner = center - (a + b) * 0.01;
        Light::Triangle(FlatLight {
            corner,
            edges: [0.03 * a, 0.03 * b],
            radiance: [1.0; 3],
            two_sided: false,
            offset: 0.0,
        })
    };
    LightTable::new(&lights.iter().map(triangle).collect::<Vec<_>>(), &[], None)
}

/// Clusters of triangles that face one way, more or less, seen from all around and from among them: each that faces the
/// receiver can be chosen.
#[test]
fn clusters_that_face_are_in_reach() {
    let mut random = Random::new(9);
    let mut facing = 0;
    for cloud in 0..24 {
        let spread = [0.0, 0.2, 0.8, 3.0][cloud % 4];
        let mut within = |side: f64| DVec3::from([0; 3].map(|_| side * (scalar(number(&mut random)) - 0.5)));
        let lights: Vec<_> = (0..48).map(|_| (within(1.0), (DVec3::Y + spread * within(2.0)).normalize())).collect();
        let table = triangles(&lights);
        for _ in 0..40 {
            let p = within(2.0);
            for (k, &(center, normal)) in (0..).zip(&lights) {
                // Beyond the rounding of single precision.
                if normal.dot(p - center) > 1e-4 {
                    let [at, n] = [p, (center - p).normalize()].map(|v| V3::<S>::splat(v.as_vec3().to_array()));
                    let chance = scalar(probability(&table, <S as Lanes>::U::splat(k), Receiver { p: at, n }));
                    assert!(chance > 0.0, "cloud {cloud}, light {k} from {p}");
                    facing += 1;
                }
            }
        }
    }
    assert!(facing > 10_000, "{facing}");
}

/// Of two clusters that are equally far, the one that turns its back is chosen seldom.
#[test]
fn clusters_that_turn_their_backs_are_chosen_seldom() {
    let mut random = Random::new(10);
    let mut within = || DVec3::from([0; 3].map(|_| scalar(number(&mut random)) - 0.5));
    let mut cluster = |side: f64, up: f64| -> Vec<_> {
        (0..32).map(|_| (DVec3::X * side + within(), (DVec3::Y * up + 0.5 * within()).normalize())).collect()
    };
    let table = triangles(&[cluster(-3.0, 1.0), cluster(3.0, -1.0)].concat());
    let [p, n] = [[0.0, 8.0, 0.0], [0.0, -1.0, 0.0]].map(V3::<S>::splat);
    let of_backs = |k| scalar(probability(&table, <S as Lanes>::U::splat(k), Receiver { p, n }));
    let chance: f64 = (32..64).map(of_backs).sum();
    // Their axis is 180 - 20 degrees off at least, and 90 + 25 + 5 are asked for.
    assert!(chance < 0.02, "{chance}");
}

/// A thousand lights, and ten thousand at one place: the way to none is longer than the logarithm, and none is out
/// of reach.
#[test]
fn many_lights_are_all_found() {
    let spread: Vec<_> =
        (0..1000).map(|k| (DVec3::splat(f64::from(k % 10)) + DVec3::Y * f64::from(k), 0.1, 1.0)).collect();
    let stacked = vec![(DVec3::ONE, 0.1, 1.0); 10_000];
    for (lights, depth) in [(spread, 10), (stacked, 14)] {
        let table = table(&lights);
        assert_eq!(table.depth, depth);
        let mut random = Random::new(6);
        let p = facing_up(V3::splat([3.0, -5.0, 2.0]));
        let mut seen = vec![false; lights.len()];
        for k in 0..lights.len() as u32 {
            assert!(scalar(probability(&table, <S as Lanes>::U::splat(k), p)) > 0.0);
        }
        for _ in 0..20 * lights.len() {
            let mut out = [0];
            choose::<S>(&table, p, number(&mut random), number(&mut random)).light.store(&mut out);
            seen[out[0] as usize] = true;
        }
        // 20 n choices among n lights that are alike leave n e^-20 = 2e-5 of them unseen; among those spread out the
        // far ones are rare.
        assert!(depth == 10 || seen.iter().all(|&s| s));
    }
}
