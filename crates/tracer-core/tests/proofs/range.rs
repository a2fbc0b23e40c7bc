//! The range of light: a picture follows its lights over all powers of ten, and what is dim in it keeps its digits
//! beside what is bright.

use crate::same_bytes::{bits, everything, many_balls, options};
use crate::support::compare::assert_same_scenes;
use crate::support::describe::*;
use crate::support::{compiled, film};
use scene_format::desc::Light;
use scene_format::{SceneDesc, Syntax, load_str};
use std::path::Path;
use tracer_core::{Crop, Film, RenderOptions, Scene, Unobserved};

/// All lights and the background so many times as bright.
fn brightened(mut desc: SceneDesc, factor: f64) -> SceneDesc {
    for light in &mut desc.lights {
        let Light::SphereLight(light) = &mut light.value;
        light.amount.value = light.amount.value.scaled(factor);
    }
    desc.background = desc.background.scaled(factor);
    desc
}

fn rendered(scene: &Scene, clamp: Option<f32>) -> Film {
    let film = tracer_core::render(scene, &RenderOptions { clamp, ..options() }, &Unobserved);
    assert_eq!((film.counters.dropped, film.counters.beyond), (0, 0));
    film
}

fn pixels(film: &Film) -> impl Iterator<Item = (u32, u32)> + use<> {
    let Crop { x, y, width, height } = film.crop();
    (y..y + height).flat_map(move |py| (x..x + width).map(move |px| (px, py)))
}

/// A power of two changes no digit: of the picture, of its variance, of what is clamped.
#[test]
fn powers_of_two_change_no_digit() {
    for (name, desc) in [("everything", everything()), ("many balls", many_balls())] {
        let plain = rendered(&compiled(&desc), Some(1.25));
        assert!(plain.clamped().is_some_and(|clamped| clamped.samples > 0), "{name}");
        for power in [66, -66] {
            let factor = 2f64.powi(power);
            let scene = compiled(&brightened(desc.clone(), factor));
            let film = rendered(&scene, Some((1.25 * factor) as f32));
            for (x, y) in pixels(&film) {
                let of = |film: &Film, factor: f64| {
                    let ([r, g, b], [s, t, u]) = (film.radiance(x, y), film.taken(x, y));
                    [r, g, b, s, t, u].map(|x| x * factor)
                };
                assert_eq!(of(&film, 1.0), of(&plain, factor), "{name}, 2^{power}, pixel ({x}, {y})");
                assert_eq!(film.variance(x, y), plain.variance(x, y) * factor * factor, "{name}, 2^{power}");
            }
            assert_eq!(film.relative_noise(), plain.relative_noise(), "{name}, 2^{power}");
            assert_eq!(film.clamped().map(|c| c.samples), plain.clamped().map(|c| c.samples));
        }
    }
}

/// Powers of ten round the lights' radiances, by 2^-24 of them at most, and what is multiplied with them a little:
/// every pixel is right to a hundred thousandth of itself, or of the mean where it is dark. No choice goes another way,
/// for of powers only ratios count. One that lies on the edge of rounding may (one pixel of the first scene did, with
/// ten of eighteen factors): another factor rounds another way. What brightness itself decided would be so with all.
#[test]
fn powers_of_ten_change_the_rounding_alone() {
    for (name, desc) in [("everything", everything()), ("many balls", many_balls())] {
        let plain = rendered(&compiled(&desc), None);
        let count = pixels(&plain).count() as f64;
        let mean = pixels(&plain).map(|(x, y)| plain.radiance(x, y)[1]).sum::<f64>() / count;
        for factors in [[1e20, 1e19, 3e20], [1e-20, 1e-19, 1e-18]] {
            let films = factors.map(|factor| rendered(&compiled(&brightened(desc.clone(), factor)), None));
            let differs = |factor: f64, film: &Film, (x, y): (u32, u32)| {
                let (a, b) = (film.radiance(x, y), plain.radiance(x, y));
                (0..3).any(|c| (a[c] / factor - b[c]).abs() > 1e-5 * (b[c] + mean))
            };
            let with_all =
                |&at: &(u32, u32)| factors.iter().zip(&films).all(|(&factor, film)| differs(factor, film, at));
            let apart = pixels(&plain).filter(with_all).count();
            assert_eq!(apart, 0, "{name}, {factors:?}: {apart} of {count} pixels");
        }
    }
}

/// A lamp of 1e12 is seen beside a ball whose near left side gets some 1e-6 from a lamp of its own: that side is the
/// one of a picture without the bright lamp, which lies behind the ball and to the right, so that all of it is below
/// the horizon there.
#[test]
fn eighteen_orders_in_one_picture() {
    let ball = sphere([0.0, 0.0, 0.0], 1.0, diffuse([0.5; 3]));
    let dim = scene(32, vec![light([-3.0, 6.0, 8.0], 0.02, [0.2; 3])], vec![ball])
        .camera([0.0, 0.0, 6.0], [0.0; 3], 40.0)
        .bounces(1);
    let mut desc = dim.clone();
    desc.lights.push(Light::SphereLight(light([5.0, 0.0, -14.0], 1.5, [1e12; 3])).into());
    let (both, alone) = (film(&compiled(&desc), 64, 1), film(&compiled(&dim), 64, 1));
    let (mut dims, mut brights) = (0, 0);
    for (x, y) in pixels(&both) {
        let (a, b) = (both.radiance(x, y)[1], alone.radiance(x, y)[1]);
        brights += usize::from(a > 0.99e12);
        // Inside of the ball's outline, where 64 samples of a small lamp differ by rounding, light's way of choosing
        // and little else.
        if x < 14 && b > 1e-7 {
            assert!(b < 1e-5 && (a / b - 1.0).abs() < 0.1, "pixel ({x}, {y}): {a:e} {b:e}");
            dims += 1;
        }
    }
    assert!(dims > 40 && brights > 4, "{dims} {brights}");
}

/// The unit goes by the brightest, and is one where there is no light.
#[test]
fn the_unit_is_the_brightest_power_of_two() {
    let unit = |lights, background: [f64; 3]| {
        let ball = sphere([0.0, 0.0, 0.0], 1.0, diffuse([0.5; 3]));
        compiled(&scene(8, lights, vec![ball]).background(background)).radiance_unit
    };
    assert_eq!(unit(vec![], [0.0; 3]), 1.0);
    assert_eq!(unit(vec![], [0.1, 0.2, 0.3]), 0.25);
    assert_eq!(unit(vec![light([0.0, 9.0, 0.0], 1.0, [3.0, 70.0, 5.0])], [1.0; 3]), 64.0);
}

/// What single precision cannot hold beside the brightest is told.
#[test]
fn lights_that_are_lost_are_told() {
    let ball = sphere([0.0, 0.0, 0.0], 1.0, diffuse([0.5; 3]));
    let dim = light([0.0, 9.0, 0.0], 1.0, [1e-20; 3]);
    let desc = scene(8, vec![light([0.0, -9.0, 0.0], 1.0, [1e20; 3]), dim], vec![ball]);
    let codes = |desc: &SceneDesc| compiled(desc).warnings.iter().map(|w| w.code).collect::<Vec<_>>();
    assert_eq!(codes(&desc), ["W0303"]);
    assert_eq!(codes(&SceneDesc { lights: desc.lights[1..].to_vec(), ..desc.clone() }), [""; 0]);
    let film = film(&compiled(&desc), 4, 0);
    assert_eq!(bits(&film).len(), 64);
}

/// A lamp that is ten thousand million times as bright, behind a wall, takes nothing from a dim one: it was asked every
/// time, or the dim one so rarely that random numbers of 24 bits missed it, and a room lost 5 per cent at 5 bounces,
/// half at one, and nine tenths without any.
#[test]
fn dim_lamps_are_asked_beside_bright_ones() {
    let room = |lamps: &str, bounces: u32| {
        let wall =
            |center: &str, size: &str| format!("Box(center: {center}, size: {size}, material: Diffuse(albedo: 0.7))");
        let walls = [
            wall("(0, -0.1, 0)", "(4.4, 0.2, 4.4)"),
            wall("(0, 3.1, 0)", "(4.4, 0.2, 4.4)"),
            wall("(-2.1, 1.5, 0)", "(0.2, 3.4, 4.4)"),
            wall("(2.1, 1.5, 0)", "(0.2, 3.4, 4.4)"),
            wall("(0, 1.5, -2.1)", "(4.4, 3.4, 0.2)"),
            wall("(0, 1.5, 2.1)", "(4.4, 3.4, 0.2)"),
        ];
        let text = format!(
            "Scene(camera: Camera(position: (0, 1.6, 1.9), look_at: (0, 0.7, -0.5), fov: 75), \
             image: Image(width: 32, height: 32), render: Render(max_bounces: {bounces}), \
             lights: [{lamps} SphereLight(center: (-0.9, 2.3, 0.2), radius: 0.15, radiance: 1)], objects: [{}])",
            walls.join(", ")
        );
        let loaded = load_str("s.ron", &text, Syntax::Ron, Path::new(""), &[]);
        loaded.unwrap_or_else(|error| panic!("{error}\n{text}")).scene
    };
    // The bright one comes first in the tree of lights, or last.
    for x in [6, -6] {
        let bright = format!("SphereLight(center: ({x}, 1.5, 0), radius: 0.3, radiance: 1e10),");
        for bounces in [0, 1] {
            let name = format!("a dim lamp beside a bright one at {x}, {bounces} bounces");
            assert_same_scenes(&name, &room("", bounces), &room(&bright, bounces), 256);
        }
    }
}
