//! The noise that a film tells is its error.

use crate::support::film;
use rayon::prelude::*;
use scene_format::{Override, load_with};
use std::path::Path;
use tracer_core::{Film, Scene, compile};

const SIZE: u32 = 64;
const SEEDS: u32 = 4;

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
fn error(films: &[Film]) -> f64 {
    let n = films.len() as f64;
    let (mut squares, mut mean) = (0.0, 0.0);
    for (x, y) in (0..SIZE).flat_map(|y| (0..SIZE).map(move |x| (x, y))) {
        let values: Vec<f64> = films.iter().map(|film| luminance(film.radiance(x, y))).collect();
        let of_pixel = values.iter().sum::<f64>() / n;
        squares += values.iter().map(|value| (value - of_pixel).powi(2)).sum::<f64>() / (n - 1.0);
        mean += of_pixel;
    }
    (squares / f64::from(SIZE * SIZE)).sqrt() / (mean / f64::from(SIZE * SIZE))
}

/// Behind a power of two, at one, and between two of them. The error of 4096 pixels is known to a few percent from four
/// seeds where few of them bear it (a lamp's border, glints of glass): in six seeds ratios were from 0.84 to 1.17. As
/// for independent samples (`Film::variance`) they were 1.15 to 2.9 in five scenes.
#[test]
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
