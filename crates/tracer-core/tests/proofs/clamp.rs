//! Clamped samples (`render.clamp`): what is taken is told to the last bit, and without it nothing changes.

use crate::same_bytes::{bits, cut, everything, many_balls, options};
use crate::support::describe::*;
use crate::support::{compiled, film};
use scene_format::SceneDesc;
use tracer_core::{Clamped, Crop, Film, Level, RenderOptions, Scene, Unobserved};

/// Far below what lamps in view, fireflies and what sharing corrects come to in these scenes.
const LIMIT: f32 = 1.25;

fn scenes() -> [(&'static str, SceneDesc); 2] {
    [("everything", everything()), ("many balls", many_balls())]
}

fn rendered(scene: &Scene, clamp: Option<f32>, more: RenderOptions) -> Film {
    tracer_core::render(scene, &RenderOptions { clamp, ..more }, &Unobserved)
}

fn pixels(film: &Film) -> impl Iterator<Item = (u32, u32)> + use<> {
    let Crop { x, y, width, height } = film.crop();
    (y..y + height).flat_map(move |py| (x..x + width).map(move |px| (px, py)))
}

fn luminance(rgb: [f64; 3]) -> f64 {
    0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
}

/// No limit, an infinite one and one above all samples are the same picture, of which nothing is taken.
#[test]
fn without_a_limit_nothing_changes() {
    for (name, mut desc) in scenes() {
        let scene = compiled(&desc);
        let free = rendered(&scene, None, options());
        assert_eq!((free.clamp, free.clamped()), (None, None), "{name}");
        let infinite = rendered(&scene, Some(f32::INFINITY), options());
        assert!(infinite.clamp.is_none() && bits(&infinite) == bits(&free), "{name}");
        let high = rendered(&scene, Some(1e12), options());
        let nothing = Clamped { limit: 1e12, samples: 0, radiance: [0.0; 3], share: 0.0 };
        assert_eq!(high.clamped(), Some(nothing), "{name}");
        assert!(bits(&high) == bits(&free), "{name}");
        // The caller's word counts before the scene's.
        desc.render.clamp = Some(f64::from(LIMIT).into());
        let scene = compiled(&desc);
        assert!(bits(&rendered(&scene, Some(f32::INFINITY), options())) == bits(&free), "{name}");
        assert!(bits(&rendered(&scene, None, options())) == bits(&rendered(&scene, Some(LIMIT), options())), "{name}");
        assert!(bits(&rendered(&scene, None, options())) != bits(&free), "{name}: nothing was clamped");
    }
}

/// What is left and what was taken are the picture without clamping, pixel by pixel and in the sum over all of them.
#[test]
fn left_and_taken_are_the_whole() {
    for (name, desc) in scenes() {
        let scene = compiled(&desc);
        for samples in [1, 21] {
            let more = RenderOptions { samples: Some(samples), ..options() };
            let free = rendered(&scene, None, more);
            let clamped = rendered(&scene, Some(LIMIT), more);
            let of_samples = rendered(&scene, Some(LIMIT), RenderOptions { caustics: Some(false), ..more });
            let (mut whole, mut left, mut taken) = ([0.0; 3], [0.0; 3], [0.0; 3]);
            let mut size = 0.0;
            for (x, y) in pixels(&free) {
                let values = [free.radiance(x, y), clamped.radiance(x, y), clamped.taken(x, y)];
                for c in 0..3 {
                    let [w, l, t] = values.map(|value| value[c]);
                    // The sums of the film are exact. Each value is the sum of its two parts over the number of
                    // samples, rounded twice, and l + t is rounded once: at most 2 + 2 + 2 + 1 halves of 2^-52 of the
                    // largest of the three.
                    let largest = w.abs().max(l.abs()).max(t.abs()).max((l + t).abs());
                    assert!((w - (l + t)).abs() <= 4.0 * f64::EPSILON * largest, "{name}, {x}, {y}: {w} {l} {t}");
                    // No sample is above the limit, and so is no mean but for its own rounding; what light paths bring
                    // is a sum of its own.
                    let mean = of_samples.radiance(x, y)[c];
                    assert!(mean <= f64::from(LIMIT) * (1.0 + 2.0 * f64::EPSILON), "{name}, {x}, {y}: {mean}");
                    whole[c] += w;
                    left[c] += l;
                    taken[c] += t;
                    size += largest;
                }
            }
            let count = f64::from(scene.size[0]) * f64::from(scene.size[1]);
            let told = clamped.clamped().expect("it was clamped");
            assert!(told.samples > 0 && told.samples < u64::from(samples) * count as u64, "{name}: {told:?}");
            for c in 0..3 {
                // As many roundings as there are terms, each at most half of 2^-52 of all that was added, in each of
                // the three sums.
                let tolerance = (4.0 + 1.5 * count) * f64::EPSILON * size;
                assert!((whole[c] - (left[c] + taken[c])).abs() <= tolerance, "{name}: {whole:?} {left:?} {taken:?}");
                assert!((told.radiance[c] * count - taken[c]).abs() <= tolerance, "{name}: {told:?} {taken:?}");
            }
            let share = luminance(taken) / luminance(whole);
            assert!((told.share - share).abs() <= 1e-9 && share > 0.0, "{name}: {told:?} {share}");
        }
    }
}

/// Sharing and photons included, for any number of threads and lanes; a crop tells of its own pixels.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn threads_lanes_and_crops() {
    for (name, desc) in scenes() {
        let scene = compiled(&desc);
        let expected = rendered(&scene, Some(LIMIT), options());
        let crop = Crop { x: 3, y: 5, width: 21, height: 11 };
        let part = rendered(&scene, Some(LIMIT), RenderOptions { crop: Some(crop), ..options() });
        assert!(bits(&part) == cut(&bits(&expected), scene.size, crop), "{name}");
        assert!(part.clamped().expect("it was clamped").samples < expected.clamped().expect("it was clamped").samples);
        for level in Level::available().into_iter().filter(|&level| level != Level::PORTABLE) {
            for threads in [1, 2, 3, 7] {
                for (crop, whole) in [(None, &expected), (Some(crop), &part)] {
                    let more = RenderOptions { threads, level: Some(level), crop, ..options() };
                    let film = rendered(&scene, Some(LIMIT), more);
                    let place = format!("{name}: {threads} threads, {}, {crop:?}", level.name());
                    assert!(bits(&film) == bits(whole), "{place}");
                    assert_eq!(film.clamped(), whole.clamped(), "{place}");
                }
            }
        }
    }
}

/// A lamp that fills the picture: every sample is the lamp, and comes out at the limit, in its own hue.
#[test]
fn a_lamp_in_view_keeps_its_hue() {
    let far = sphere([0.0, 0.0, -500.0], 1.0, diffuse([0.5; 3]));
    let mut desc = scene(16, vec![light([0.0, 0.0, -20.0], 19.0, [12.0, 6.0, 1.5])], vec![far]).camera(
        [0.0; 3],
        [0.0, 0.0, -1.0],
        20.0,
    );
    desc.render.clamp = Some(3.0.into());
    let film = film(&compiled(&desc), 16, 0);
    for (x, y) in pixels(&film) {
        // 3 is a quarter of 12, and the mean of 16 samples exact.
        assert_eq!(film.radiance(x, y), [3.0, 1.5, 0.375]);
        assert_eq!(film.taken(x, y), [9.0, 4.5, 1.125]);
        // Zero but for the rounding of squares of about 1.8.
        assert!(film.variance(x, y) < 1e-14);
    }
    let clamped = film.clamped().expect("it was clamped");
    // Of 12 nine were taken, but for the rounding of a few products and sums.
    assert!((clamped.share - 0.75).abs() < 1e-12, "{clamped:?}");
    assert_eq!(clamped, Clamped { limit: 3.0, samples: 16 * 256, radiance: [9.0, 4.5, 1.125], share: clamped.share });
}

/// What switches cost is told: nothing of what is off, and no more than all.
#[test]
fn costs_are_told() {
    let scene = compiled(&many_balls());
    let all = rendered(&scene, Some(LIMIT), options());
    assert!(all.reuse && all.caustics, "nothing shared, no photons");
    let parts = [all.costs.reuse, all.costs.caustics, all.costs.clamp];
    assert!(parts.iter().all(|&seconds| seconds > 0.0), "{:?}", all.costs);
    assert!(parts.iter().sum::<f64>() < all.costs.total, "{:?}", all.costs);
    let none = rendered(&scene, None, RenderOptions { reuse: Some(false), caustics: Some(false), ..options() });
    assert!(!none.reuse && !none.caustics);
    assert_eq!([none.costs.reuse, none.costs.caustics, none.costs.clamp], [0.0; 3]);
    assert!(none.costs.total > 0.0);
}
