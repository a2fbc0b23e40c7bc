//! The layers `direct` and `indirect`: exactly the picture in two, and what its bounces make of it.

use crate::same_bytes::everything;
use crate::support::compare::assert_agree;
use crate::support::compiled;
use crate::support::describe::*;
use rayon::prelude::*;
use scene_format::SceneDesc;
use scene_format::desc::Integrator;
use tracer_core::{Film, Layer, LayerSet, RenderOptions, Unobserved, render};
use tracer_reference::statistics::Estimate;

fn film(desc: &SceneDesc, samples: u32, seed: u32) -> Film {
    let layers = Some(LayerSet::from_iter([Layer::Direct, Layer::Indirect]));
    let options = RenderOptions { samples: Some(samples), seed: Some(seed), layers, ..RenderOptions::default() };
    render(&compiled(desc), &RenderOptions { threads: 1, ..options }, &Unobserved)
}

/// Direct light, indirect light and the picture without what is left out behind it, number by number.
fn parts(film: &Film) -> [Vec<f32>; 3] {
    let of = |layer| film.layer(layer).expect("it was asked for").values;
    let width = film.size()[0] as usize;
    let picture = |(k, _): (usize, &f32)| {
        let (x, y) = ((k / 3 % width) as u32, (k / 3 / width) as u32);
        (film.radiance(x, y)[k % 3] - film.background(x, y)[k % 3]) as f32
    };
    let (direct, indirect) = (of(Layer::Direct), of(Layer::Indirect));
    let whole = direct.iter().enumerate().map(picture).collect();
    [direct, indirect, whole]
}

/// A mirror and a glass ball in a bright room: shared vertices, chains and light paths are at work.
fn balls() -> SceneDesc {
    let objects = vec![
        sphere([0.0, -1000.0, 0.0], 1000.0, diffuse([0.7, 0.6, 0.5])),
        sphere([0.0, 0.0, -1004.0], 1000.0, diffuse([0.4, 0.6, 0.8])),
        sphere([-1.2, 1.0, 0.0], 1.0, mirror([0.9; 3])),
        sphere([1.2, 1.1, 0.6], 1.0, glass(1.5)),
        sphere([0.2, 0.4, 2.0], 0.4, blinn_phong([0.8, 0.2, 0.1], 60.0, 0.3)),
    ];
    scene(32, vec![light([1.0, 5.0, 3.0], 0.8, [30.0, 28.0, 24.0])], objects)
        .camera([0.0, 2.0, 8.0], [0.0, 1.0, 0.0], 40.0)
        .bounces(6)
}

/// Rounded once each, and once their sum: three halves of a unit in the last place.
fn assert_sums(name: &str, film: &Film) {
    let [direct, indirect, whole] = parts(film);
    assert!(direct.iter().zip(&indirect).all(|(a, b)| *a >= 0.0 && *b >= 0.0), "{name}: light below zero");
    for ((direct, indirect), whole) in direct.iter().zip(&indirect).zip(&whole) {
        let unit = f64::from(whole.next_up() - whole);
        let sum = f64::from(*direct) + f64::from(*indirect);
        assert!((sum - f64::from(*whole)).abs() <= 1.5 * unit, "{name}: {direct} + {indirect}, not {whole}");
    }
    let of = |part: &[f32]| part.iter().map(|x| f64::from(*x)).sum::<f64>();
    assert!(of(&direct) > 0.0 && of(&indirect) > 0.01 * of(&direct), "{name}: {} {}", of(&direct), of(&indirect));
}

#[test]
fn together_they_are_the_picture() {
    assert_sums("everything", &film(&everything(), 5, 1));
    assert_sums("balls", &film(&balls(), 16, 2));
    let with = |change: &dyn Fn(&mut SceneDesc)| {
        let mut desc = balls();
        change(&mut desc);
        film(&desc, 8, 3)
    };
    assert_sums("clamped", &with(&|desc| desc.render.clamp = Some(2.0.into())));
    assert_sums("paths", &with(&|desc| desc.render.integrator = Integrator::Path));
    let cut_out = |desc: &mut SceneDesc| {
        desc.output.alpha = true;
        desc.objects.remove(1);
        desc.background = scene_format::desc::Background::Color([0.3, 0.5, 0.9]);
    };
    assert_sums("cut out", &with(&cut_out));
    assert_sums("light groups", &film(&crate::light_groups::described(&[]), 8, 3));
}

/// Without bounces all light is direct, to the last bit.
#[test]
fn without_bounces_nothing_is_indirect() {
    for integrator in [Integrator::Full, Integrator::Path] {
        let mut desc = balls().bounces(0);
        desc.render.integrator = integrator;
        let [direct, indirect, whole] = parts(&film(&desc, 8, 4));
        assert!(direct == whole && indirect.iter().all(|x| *x == 0.0));
        assert!(whole.iter().any(|x| *x > 0.0));
    }
}

/// Direct light is the picture without bounces, in the mean of each tile of 8x8 pixels, whatever finds the rest.
#[test]
fn direct_light_is_the_picture_without_bounces() {
    let pictures = |desc: &SceneDesc, first: u32| -> Vec<Vec<f32>> {
        (first..first + 32).into_par_iter().map(|seed| parts(&film(desc, 16, seed))[0].clone()).collect()
    };
    let (with, without) = (pictures(&balls(), 100), pictures(&balls().bounces(0), 200));
    let estimate = |of: &[Vec<f32>], [left, top, right, bottom]: [u32; 4], channel: usize| {
        let places = || (top..bottom).flat_map(|y| (left..right).map(move |x| (3 * (y * 32 + x)) as usize + channel));
        let mean = |picture: &Vec<f32>| {
            places().map(|k| f64::from(picture[k])).sum::<f64>() / f64::from((right - left) * (bottom - top))
        };
        Estimate::of(&of.iter().map(mean).collect::<Vec<_>>())
    };
    assert_agree("direct light", [32; 2], &|r, c| estimate(&with, r, c), &|r, c| estimate(&without, r, c));
}
