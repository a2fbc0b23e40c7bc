//! Layers as pictures: their numbers in colours.

use crate::shared::{Shared, Stage, lock};
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex};
use tracer_core::{Film, Layer, LayerImage, LayerSet, Observer, Progress, RenderOptions, render, srgb_encode};

/// Samples of a layer's picture: edges are smooth, and it is there at once.
const SAMPLES: u32 = 8;

/// The layer that was asked for last, so that it is rendered once.
#[derive(Default)]
pub struct LastLayer(Mutex<Option<(u64, Layer, Arc<Film>)>>);

impl LastLayer {
    /// The film of a layer; `None` where the scene has changed meanwhile.
    pub fn film(&self, shared: &Shared, stage: &Stage, layer: Layer) -> Option<Arc<Film>> {
        // Others who want it wait, and find it.
        let mut last = lock(&self.0);
        if let Some((number, of, film)) = &*last
            && (*number, *of) == (stage.number, layer)
        {
            return Some(Arc::clone(film));
        }
        let options = RenderOptions {
            samples: Some(SAMPLES),
            reuse: Some(false),
            caustics: Some(false),
            layers: Some(LayerSet::from_iter([layer])),
            light_groups: Some(false),
            threads: shared.options.threads,
            ..RenderOptions::default()
        };
        let film = Arc::new(render(&stage.scene, &options, &OfStage { shared, stage: stage.number }));
        if *film.samples().start() == 0 {
            return None;
        }
        *last = Some((stage.number, layer, Arc::clone(&film)));
        Some(film)
    }
}

/// Ends when another scene is shown.
struct OfStage<'a> {
    shared: &'a Shared,
    stage: u64,
}

impl Observer for OfStage<'_> {
    fn progress(&self, _: Progress) -> ControlFlow<()> {
        let same = self.shared.state().stage.as_ref().is_some_and(|stage| stage.number == self.stage);
        if same { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

/// How noisy each pixel of a film is: its standard error, relative to the picture's mean.
pub fn noise(film: &Film) -> LayerImage {
    let [width, height] = film.size();
    let pixels = || (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)));
    let luminance = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let mean =
        pixels().map(|(x, y)| luminance(film.radiance(x, y))).sum::<f64>() / f64::from(width) / f64::from(height);
    let of = |(x, y)| if mean > 0.0 { (film.variance(x, y).sqrt() / mean) as f32 } else { 0.0 };
    LayerImage { name: "noise", channels: &["Y"], values: pixels().map(of).collect() }
}

/// A layer's numbers as bytes for a canvas: red, green, blue, opaque.
pub fn colours(image: &LayerImage, exposure: f64) -> Vec<u8> {
    let count = image.channels.len().max(1);
    let pixels = image.values.chunks_exact(count);
    match image.name {
        "albedo" | "denoising_albedo" => bytes(pixels, |p| [0, 1, 2].map(|c| encoded(p[c].into()))),
        "emission" | "direct" | "indirect" => {
            let gain = libm::exp2(exposure);
            bytes(pixels, |p| [0, 1, 2].map(|c| encoded(f64::from(p[c]) * gain)))
        }
        // The usual colours of normal maps; where there is none it is black.
        "normal" | "denoising_normal" => bytes(pixels, |p| {
            let none = p.iter().all(|&x| x == 0.0);
            [0, 1, 2].map(|c| if none { 0.0 } else { 0.5 + 0.5 * f64::from(p[c]) })
        }),
        "object_id" | "material_id" => bytes(pixels, |p| of_number(p[0] as u32)),
        "uv" => bytes(pixels, |p| [f64::from(p[0]).rem_euclid(1.0), f64::from(p[1]).rem_euclid(1.0), 0.0]),
        "noise" => bytes(pixels, |p| heat(libm::log10(f64::from(p[0]).max(1e-3)) / 3.0 + 1.0)),
        "path_length" | "nodes" | "leaves" => {
            let [(low, high), ..] = ranges(image, count);
            bytes(pixels, |p| heat((f64::from(p[0]) - low) / (high - low).max(f64::MIN_POSITIVE)))
        }
        // Near is bright.
        "depth" => {
            let [(low, high), ..] = ranges(image, count);
            bytes(pixels, |p| {
                let share = (f64::from(p[0]) - low) / (high - low).max(f64::MIN_POSITIVE);
                [if p[0].is_finite() { 1.0 - 0.85 * share } else { 0.0 }; 3]
            })
        }
        // Of what is not known here: least to most, channel by channel.
        _ => {
            let ranges = ranges(image, count);
            bytes(pixels, |p| {
                [0, 1, 2].map(|c| {
                    let (low, high) = ranges[c.min(count - 1)];
                    (f64::from(p[c.min(count - 1)]) - low) / (high - low).max(f64::MIN_POSITIVE)
                })
            })
        }
    }
}

/// The least and the most finite number of each channel, but for a hundredth at either end.
fn ranges(image: &LayerImage, count: usize) -> [(f64, f64); 3] {
    [0, 1, 2].map(|c| {
        let mut values: Vec<f32> =
            image.values.iter().skip(c.min(count - 1)).step_by(count).copied().filter(|x| x.is_finite()).collect();
        values.sort_unstable_by(f32::total_cmp);
        let at = |share: usize| values.get(values.len().saturating_sub(1) * share / 100).map_or(0.0, |&x| f64::from(x));
        (at(1), at(99))
    })
}

fn bytes<'a>(pixels: impl Iterator<Item = &'a [f32]>, colour: impl Fn(&[f32]) -> [f64; 3]) -> Vec<u8> {
    let byte = |x: f64| (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    pixels
        .flat_map(|pixel| {
            let [r, g, b] = colour(pixel).map(byte);
            [r, g, b, u8::MAX]
        })
        .collect()
}

fn encoded(linear: f64) -> f64 {
    srgb_encode(linear.clamp(0.0, 1.0))
}

/// A colour of its own for each number; none for zero.
fn of_number(number: u32) -> [f64; 3] {
    if number == 0 {
        return [0.0; 3];
    }
    // Steps of the golden section: neighbours are far apart on the circle of hues.
    let hue = f64::from(number) * 0.618_033_988_75;
    let light = 0.62 + 0.2 * f64::from(number % 3);
    [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|turn| {
        let x = ((hue + turn).rem_euclid(1.0) * 6.0 - 3.0).abs() - 1.0;
        light * (0.25 + 0.75 * x.clamp(0.0, 1.0))
    })
}

/// Black over violet and orange to white, for 0 to 1.
fn heat(share: f64) -> [f64; 3] {
    const STOPS: [[f64; 3]; 5] =
        [[0.0, 0.0, 0.05], [0.27, 0.05, 0.42], [0.73, 0.21, 0.33], [0.98, 0.55, 0.04], [0.99, 1.0, 0.75]];
    let at = share.clamp(0.0, 1.0) * 4.0;
    let k = (at as usize).min(3);
    let t = at - k as f64;
    [0, 1, 2].map(|c| STOPS[k][c] * (1.0 - t) + STOPS[k + 1][c] * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_colours_of_their_own() {
        let colours: std::collections::BTreeSet<String> = (0..24).map(|k| format!("{:.2?}", of_number(k))).collect();
        assert_eq!(colours.len(), 24);
    }

    #[test]
    fn depth_is_bright_where_it_is_near_and_black_where_there_is_none() {
        let values = (0..200).map(|k| k as f32).chain([f32::INFINITY]).collect();
        let bytes = colours(&LayerImage { name: "depth", channels: &["Z"], values }, 0.0);
        assert_eq!((bytes[0], bytes[4 * 200]), (255, 0));
        assert!(bytes[4 * 150] < bytes[4 * 50] && bytes[4 * 199] > 0);
        assert_eq!(bytes.len(), 4 * 201);
    }
}
