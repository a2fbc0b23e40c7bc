//! `cargo xtask denoise`: what `--denoise` does to ten scenes, as the table of docs/denoise.md has it; fails where it
//! makes one worse.

use crate::truth::written::loaded_at;
use std::path::{Path, PathBuf};
use tracer_core::{Crop, Film, GUIDES, Layer, RenderOptions, Scene, Unobserved, denoise, render};

/// Chosen before anything was measured: rooms with one lamp, textures, mirrors and glass, a lens.
const SCENES: [&str; 10] = [
    "cookbook/lampshade",
    "gallery/room",
    "gallery/still_life",
    "gallery/cornell",
    "fig4",
    "cookbook/glass",
    "cookbook/picture_on_the_wall",
    "cookbook/checkered_floor",
    "cookbook/shallow_focus",
    "cookbook/window",
];

/// What is to be done.
#[derive(Clone, Debug)]
pub struct Options {
    /// Samples per pixel.
    pub samples: u32,
    /// Samples of the reference, of another seed.
    pub reference: u32,
    /// Width and height.
    pub size: [u32; 2],
    /// Only scenes whose names contain this.
    pub name: String,
    /// Scene files instead of the ten.
    pub files: Vec<PathBuf>,
}

/// How much less the squared error is: of the picture, without its worst thousandth, at edges, in textures.
type Gains = [f64; 4];

/// Measures all scenes, with everything on and with plain paths, and prints the table; gives how many pictures have
/// become worse.
///
/// # Errors
/// A scene is refused; nothing has such a name.
pub fn run(root: &Path, options: &Options) -> anyhow::Result<usize> {
    let ours = SCENES.iter().map(|name| root.join("scenes").join(name).with_extension("ron"));
    let all: Vec<PathBuf> = if options.files.is_empty() { ours.collect() } else { options.files.clone() };
    let name = |path: &Path| {
        let path = path.with_extension("");
        path.strip_prefix(root.join("scenes")).unwrap_or(&path).display().to_string()
    };
    let scenes: Vec<&PathBuf> = all.iter().filter(|path| name(path).contains(&options.name)).collect();
    anyhow::ensure!(!scenes.is_empty(), "no scene has {:?} in its name", options.name);
    println!("| scene | integrator | relMSE before | after | gain | trimmed | at edges | in textures | energy |");
    println!("|---|---|---:|---:|---:|---:|---:|---:|---:|");
    let (mut worse, mut all) = (0, [Vec::new(), Vec::new()]);
    for path in scenes {
        let name = name(path);
        let scene = loaded_at(path, Some(options.size))?;
        let reference = picture(&rendered(&scene, options.reference, 77, false));
        for (plain, gains) in [false, true].into_iter().zip(&mut all) {
            let film = rendered(&scene, options.samples, 1, plain);
            let measured = measure(&film, &reference)?;
            let [gain, trimmed, edges, textures] = measured.gains;
            let [before, after] = measured.errors;
            let (integrator, energy) = (if plain { "Path" } else { "Full" }, measured.energy);
            // There may be no edges, or no textures.
            let [edges, textures] =
                [edges, textures].map(|gain| if gain.is_nan() { "none".to_owned() } else { format!("{gain:.2}") });
            println!(
                "| {name} | {integrator} | {before:.5} | {after:.5} | **{gain:.2}** | {trimmed:.2} | {edges} | \
                 {textures} | {energy:.3} |"
            );
            gains.push(gain);
            worse += usize::from(gain < 1.0);
        }
    }
    for (gains, integrator) in all.iter().zip(["Full", "Path"]) {
        let mean = libm::exp(gains.iter().map(|&gain| libm::log(gain)).sum::<f64>() / gains.len() as f64);
        println!("| geometric mean | {integrator} | | | **{mean:.2}** | | | | |");
    }
    Ok(worse)
}

/// With what denoising needs.
fn rendered(scene: &Scene, samples: u32, seed: u32, plain: bool) -> Film {
    let off = plain.then_some(false);
    let options = RenderOptions {
        samples: Some(samples),
        seed: Some(seed),
        // The last two for the masks.
        layers: Some(GUIDES.into_iter().chain([Layer::Albedo, Layer::Normal]).collect()),
        halves: true,
        reuse: off,
        caustics: off,
        ..RenderOptions::default()
    };
    render(scene, &options, &Unobserved)
}

fn picture(film: &Film) -> Vec<f64> {
    let Crop { width, height, .. } = film.crop();
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).flat_map(|(x, y)| film.radiance(x, y)).collect()
}

struct Measured {
    errors: [f64; 2],
    gains: Gains,
    energy: f64,
}

fn measure(film: &Film, reference: &[f64]) -> anyhow::Result<Measured> {
    let noisy = picture(film);
    let denoised: Vec<f64> = denoise(film)?.radiance.into_iter().map(f64::from).collect();
    let [edges, textures] = masks(film);
    let [before, after] = [&noisy, &denoised].map(|picture| relative_errors(picture, reference));
    let mean = |errors: &[f64]| errors.iter().sum::<f64>() / errors.len().max(1) as f64;
    let trimmed = |errors: &[f64]| {
        let mut sorted = errors.to_vec();
        sorted.sort_by(f64::total_cmp);
        mean(&sorted[..sorted.len() - sorted.len().div_ceil(1000)])
    };
    let of = |mask: &[bool]| {
        let meant = |errors: &[f64]| -> Vec<f64> {
            errors.iter().zip(mask).filter(|(_, is_meant)| **is_meant).map(|(error, _)| *error).collect()
        };
        mean(&meant(&before)) / mean(&meant(&after))
    };
    let gains = [mean(&before) / mean(&after), trimmed(&before) / trimmed(&after), of(&edges), of(&textures)];
    let energy = denoised.iter().sum::<f64>() / noisy.iter().sum::<f64>();
    Ok(Measured { errors: [mean(&before), mean(&after)], gains, energy })
}

/// (x - r)^2 / (r^2 + 0.01) of each pixel, mean over its channels.
fn relative_errors(picture: &[f64], reference: &[f64]) -> Vec<f64> {
    let square = |(x, r): (&f64, &f64)| (x - r) * (x - r) / (r * r + 0.01);
    let pixels = picture.chunks(3).zip(reference.chunks(3));
    pixels.map(|(x, r)| x.iter().zip(r).map(square).sum::<f64>() / 3.0).collect()
}

/// Where things end, by normals and depth; and where the albedo changes but nothing ends.
fn masks(film: &Film) -> [Vec<bool>; 2] {
    let Crop { width, height, .. } = film.crop();
    let (width, height) = (width as usize, height as usize);
    let layer = |layer: Layer| film.layer(layer).map(|image| image.values).unwrap_or_default();
    let (albedo, normal, depth) = (layer(Layer::Albedo), layer(Layer::Normal), layer(Layer::Depth));
    let near: Vec<f32> = depth.iter().map(|&depth| if depth.is_finite() { 1.0 / depth } else { 0.0 }).collect();
    let apart =
        |values: &[f32], a: usize, b: usize| (0..3).map(|c| (values[3 * a + c] - values[3 * b + c]).abs()).sum::<f32>();
    let mut masks = [vec![false; width * height], vec![false; width * height]];
    for k in 0..width * height {
        let (x, y) = (k % width, k / width);
        let neighbours = [
            (x > 0).then(|| k - 1),
            (x + 1 < width).then_some(k + 1),
            (y > 0).then(|| k - width),
            (y + 1 < height).then_some(k + width),
        ];
        let ends =
            |&other: &usize| apart(&normal, k, other) > 0.4 || (near[k] - near[other]).abs() > 0.05 * near[k].max(1e-9);
        let changes = |&other: &usize| apart(&albedo, k, other) > 0.05;
        masks[0][k] = neighbours.iter().flatten().any(ends);
        masks[1][k] = !masks[0][k] && neighbours.iter().flatten().any(changes);
    }
    masks
}
