//! The noise that a film tells is its error.

use crate::support::{compiled, film};
use rayon::prelude::*;
use scene_format::{Override, Syntax, load_str, load_with};
use std::path::Path;
use tracer_core::{Crop, Film, RenderOptions, Scene, Unobserved, compile, render};
use tracer_reference::statistics::Estimate;

const SIZE: u32 = 64;
const SEEDS: u32 = 12;

/// Ten scenes of the gallery and the figures, as they come.
const SCENES: [&str; 10] = [
    "gallery/cornell",
    "gallery/room",
    "gallery/marbles",
    "gallery/still_life",
    "gallery/cradle",
    "gallery/helix",
    "fig2",
    "fig4",
    "fig6",
    "fig9",
];

fn of_gallery(name: &str) -> Scene {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name).with_extension("ron");
    let set = [format!("image.width={SIZE}"), format!("image.height={SIZE}")].map(Override::from);
    let loaded = load_with(&file, &set).unwrap_or_else(|error| panic!("{name}: {error:?}"));
    compile(&loaded.scene).unwrap_or_else(|error| panic!("{name}: {error:?}"))
}

fn luminance([r, g, b]: [f64; 3]) -> f64 {
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// Root mean square error of the luminance relative to its mean, by what pictures with other seeds differ by.
pub fn error(films: &[Film]) -> f64 {
    let n = films.len() as f64;
    let (mut squares, mut mean) = (0.0, 0.0);
    let Crop { x, y, width, height } = films[0].crop();
    for (x, y) in (y..y + height).flat_map(|y| (x..x + width).map(move |x| (x, y))) {
        let values: Vec<f64> = films.iter().map(|film| luminance(film.radiance(x, y))).collect();
        let of_pixel = values.iter().sum::<f64>() / n;
        squares += values.iter().map(|value| (value - of_pixel).powi(2)).sum::<f64>() / (n - 1.0);
        mean += of_pixel;
    }
    let pixels = f64::from(width * height);
    (squares / pixels).sqrt() / (mean / pixels)
}

/// Behind a power of two, at one, and between two of them. Where few of 4096 pixels bear the error (a lamp's border,
/// glints of glass) four seeds know the ratio to a tenth only: of `gallery/cornell` with 28 samples it was 0.98 to 1.39
/// in eight times four, 1.19 in all. As for independent samples (`Film::variance`) they were 1.15 to 2.9 in five
/// scenes.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn what_is_told_is_the_error() {
    let ratios: Vec<(String, f64)> = SCENES
        .par_iter()
        .flat_map(|name| {
            let scene = of_gallery(name);
            let of = |samples| {
                let films: Vec<Film> = (0..SEEDS).map(|seed| film(&scene, samples, seed)).collect();
                let squares = films.iter().map(|film| film.relative_noise().powi(2)).sum::<f64>();
                let (told, error) = ((squares / f64::from(SEEDS)).sqrt(), error(&films));
                (format!("{name}, {samples} samples: told {told:.4}, error {error:.4}"), told / error)
            };
            [28, 64, 80].map(of)
        })
        .collect();
    let wrong: Vec<_> = ratios.iter().filter(|(_, ratio)| !(1.0 / 1.3..=1.3).contains(ratio)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Where a goal ends a rendering of few pixels, chance is not to end it too soon: the error of 32 seeds is the goal at
/// most. One pixel's is known to an eighth from so many (1/sqrt(64)), and nearly three times that is allowed.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn few_pixels_are_not_said_to_be_good_too_soon() {
    const GOAL: f64 = 0.05;
    let scene = of_gallery("gallery/cornell");
    for crop in [Crop { x: 10, y: 20, width: 1, height: 1 }, Crop { x: 28, y: 30, width: 8, height: 1 }] {
        let of = |seed| {
            let options = RenderOptions { crop: Some(crop), threads: 1, seed: Some(seed), ..RenderOptions::default() };
            let film =
                render(&scene, &RenderOptions { noise: Some(GOAL), samples: Some(1 << 16), ..options }, &Unobserved);
            assert!(film.relative_noise() <= GOAL);
            film
        };
        let films: Vec<Film> = (0..32).into_par_iter().map(of).collect();
        let error = error(&films);
        assert!(error <= 1.33 * GOAL, "{crop:?}: {error:.4}, not {GOAL}");
    }
}

/// What is there for a thirtieth of the time is seen by all pixels or by none: halves that agree since both have missed
/// it tell nothing. The mean is within three standard errors of the closed form, and the error is the goal at most: of
/// 24 pictures it is known to a seventh (1/sqrt(48)), and three times that is allowed.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn a_flash_is_not_missed() {
    const GOAL: f64 = 0.2;
    let text = "Scene(animation: Animation(frames: 1, fps: 1), image: Image(width: 16, height: 16), camera: \
                Camera(position: (0, 0, 5), look_at: (0, 0, 0), shutter: 1), background: \"=if(time > 0.97, 100, 1)\", \
                objects: [Sphere(center: (0, 1000, 0), radius: 0.1)])";
    let desc = load_str("flash.ron", text, Syntax::Ron, Path::new(""), &[]).expect("a scene").scene;
    let scene = compiled(&desc);
    let mean = |seed: u32| {
        let options = RenderOptions { threads: 1, seed: Some(seed), ..RenderOptions::default() };
        let film = render(&scene, &RenderOptions { noise: Some(GOAL), samples: Some(1 << 12), ..options }, &Unobserved);
        film.radiance(3, 3)[1]
    };
    let means: Vec<f64> = (0..24).into_par_iter().map(mean).collect();
    let (truth, found) = (0.97 + 0.03 * 100.0, Estimate::of(&means));
    assert!((found.mean - truth).abs() <= 3.0 * found.variance.sqrt(), "{} instead of {truth}", found.mean);
    let error = (means.iter().map(|mean| (mean / truth - 1.0).powi(2)).sum::<f64>() / 24.0).sqrt();
    assert!(error <= 1.43 * GOAL, "{error}, not {GOAL}");
}

/// Of a pass that was ended early pixels have other samples than others, and light paths of other indices.
#[test]
#[ignore = "long: cargo xtask prove proofs"]
fn what_is_told_of_an_unfinished_pass_is_the_error() {
    for name in ["fig6", "gallery/still_life"] {
        let scene = of_gallery(name);
        let of = |seed| {
            let plan = Some("64,80,2,72".parse().expect("a plan"));
            render(&scene, &RenderOptions { plan, seed: Some(seed), ..RenderOptions::default() }, &Unobserved)
        };
        let films: Vec<Film> = (0..SEEDS).map(of).collect();
        assert!(films.iter().all(|film| film.samples() == (64..=80)), "{name}");
        let squares = films.iter().map(|film| film.relative_noise().powi(2)).sum::<f64>();
        let ratio = (squares / f64::from(SEEDS)).sqrt() / error(&films);
        assert!((1.0 / 1.3..=1.3).contains(&ratio), "{name}: {ratio}");
    }
}
