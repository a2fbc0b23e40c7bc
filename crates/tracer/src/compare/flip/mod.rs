//! FLIP: what a person sees who flips between two pictures (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström,
//! Fairchild: "FLIP: A Difference Evaluator for Alternating Images", HPG 2020), for pictures of display values.
//!
//! Colours: both pictures are blurred as the eye does at a distance, per opponent channel (section 4.1), and compared
//! in a perceptually even space (4.2). Features: edges and points of the luminance, found by derivatives of a Gaussian
//! (4.3), make the colour difference larger where they differ (4.4). Nothing deviates from the paper; borders repeat
//! their pixels, as the authors' program does.

mod colour;
mod filter;

use colour::{Lab, Opponent};
use filter::{Gaussian, Kernel, Plane, Sum};
use rayon::prelude::*;

/// Pixels per degree of the eye's angle: a 4K display of 0.7 m width, 0.7 m away (the paper's, and everybody's,
/// choice).
pub const PIXELS_PER_DEGREE: f32 = 67.020_64;

/// FLIP of each pixel, 0 (equal) to 1. Both pictures are display values in 0..=1, three a pixel, `width` pixels a row.
pub fn flip(reference: &[f32], test: &[f32], width: usize) -> Vec<f32> {
    let reference = Seen::new(reference, width);
    let test = Seen::new(test, width);
    let largest = colour::largest_difference().powf(QC);
    reference
        .colours
        .par_iter()
        .zip(&test.colours)
        .zip(reference.features.par_iter().zip(&test.features))
        .map(|((a, b), (features_a, features_b))| {
            let colours = redistributed(a.hyab(b).powf(QC), largest);
            let edges = (features_a.edge - features_b.edge).abs();
            let points = (features_a.point - features_b.point).abs();
            let features = (std::f32::consts::FRAC_1_SQRT_2 * edges.max(points)).powf(QF);
            colours.powf(1.0 - features)
        })
        .collect()
}

/// Exponent of the colour difference.
const QC: f32 = 0.7;
/// Up to this share of the largest difference ...
const PC: f32 = 0.4;
/// ... goes this share of the result's range: what lies above is not told apart well anyway.
const PT: f32 = 0.95;
/// Exponent of the feature difference.
const QF: f32 = 0.5;

/// The colour difference mapped to 0..=1.
fn redistributed(difference: f32, largest: f32) -> f32 {
    let knee = PC * largest;
    if difference < knee { PT / knee * difference } else { PT + (difference - knee) / (largest - knee) * (1.0 - PT) }
}

/// Edges and points at a pixel.
#[derive(Clone, Copy)]
struct Features {
    edge: f32,
    point: f32,
}

/// A picture as the eye sees it.
struct Seen {
    colours: Vec<Lab>,
    features: Vec<Features>,
}

impl Seen {
    fn new(display: &[f32], width: usize) -> Self {
        let opponent: Vec<Opponent> =
            display.par_chunks_exact(3).map(|p| Opponent::from_display([p[0], p[1], p[2]])).collect();
        let plane = |f: fn(&Opponent) -> f32| Plane { width, values: opponent.par_iter().map(f).collect() };
        // Contrast sensitivity as sums of Gaussians: table 1 of the paper.
        let luminance = Sum::new(&[Gaussian { a: 1.0, b: 0.0047 }]);
        let red_green = Sum::new(&[Gaussian { a: 1.0, b: 0.0053 }]);
        let blue_yellow = Sum::new(&[Gaussian { a: 34.1, b: 0.04 }, Gaussian { a: 13.5, b: 0.025 }]);
        let y = luminance.blur(&plane(|o| o.y));
        let cx = red_green.blur(&plane(|o| o.cx));
        let cz = blue_yellow.blur(&plane(|o| o.cz));
        let blurred = y.values.par_iter().zip(&cx.values).zip(&cz.values);
        let colours = blurred.map(|((&y, &cx), &cz)| Opponent { y, cx, cz }.to_lab()).collect();
        Seen { colours, features: features(&plane(|o| (o.y + 16.0) / 116.0)) }
    }
}

fn features(luminance: &Plane) -> Vec<Features> {
    let [smooth, first, second] = Kernel::of_features();
    let magnitude = |derivative: &Kernel| {
        let x = luminance.convolved(derivative, &smooth);
        let y = luminance.convolved(&smooth, derivative);
        x.values.into_par_iter().zip(y.values).map(|(x, y): (f32, f32)| x.hypot(y)).collect::<Vec<f32>>()
    };
    let (edges, points) = (magnitude(&first), magnitude(&second));
    edges.into_iter().zip(points).map(|(edge, point)| Features { edge, point }).collect()
}

#[cfg(test)]
mod tests;
