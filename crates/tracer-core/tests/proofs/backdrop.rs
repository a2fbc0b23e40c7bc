//! What is seen behind everything, by itself.

use crate::support::describe::*;
use crate::support::{compiled, film};
use scene_format::SceneDesc;
use scene_format::desc::{Caustics, Output, PixelFilter, ToneMap};
use tracer_core::{
    Backdrop, Film, GUIDES, Layer, LayerSet, Look, RenderOptions, Unobserved, denoise, develop, develop_denoised,
    render, srgb_encode,
};

const BACKGROUND: [f64; 3] = [0.25, 1.0, 3.0];

/// Balls of glass, mirror and matt, in focus and out of it, before a background that also lights them.
fn balls() -> SceneDesc {
    let objects = vec![
        sphere([-1.2, 0.0, 0.0], 0.8, glass(1.5)),
        sphere([0.6, 0.3, 1.5], 0.5, mirror([0.9; 3])),
        sphere([1.0, -0.6, -2.0], 0.9, diffuse([0.8, 0.3, 0.1])),
    ];
    let mut desc = scene(48, vec![light([0.0, 4.0, 2.0], 0.5, [30.0; 3])], objects)
        .background(BACKGROUND)
        .camera([0.0, 0.0, 6.0], [0.0; 3], 40.0)
        .lens(0.3, 6.0)
        .filter(PixelFilter::BlackmanHarris { radius: 1.5.into() });
    desc.output = Output { alpha: true, ..Output::default() };
    desc
}

/// What is left out has no noise: that of a picture for compositing is of what is before the background, however bright
/// that is, and of a picture on paper what it is under a background of the paper's colour. Seen without bounces the
/// pictures are the same before it.
#[test]
fn noise_is_of_what_is_before_the_background() {
    const PAPER: f64 = 0.75;
    let of = |background: f64, output: Output| {
        let lamps = vec![light([0.3, 0.1, 0.0], 0.8, [2.0, 1.0, 0.5]), light([-0.9, 0.4, 0.0], 0.3, [0.2; 3])];
        let mut desc = scene(24, lamps, Vec::new())
            .background([background; 3])
            .camera([0.0, 0.0, 6.0], [0.0; 3], 40.0)
            .filter(PixelFilter::BlackmanHarris { radius: 1.5.into() });
        // A stop up: the paper is as bright as it is on the screen all the same.
        desc.effects.exposure = 1.0.into();
        desc.output = output;
        film(&compiled(&desc), 32, 3)
    };
    let clear = |light_groups: bool| Output { alpha: true, light_groups, ..Output::default() };
    let paper = || Output { backdrop: Some([PAPER; 3].into()), ..Output::default() };
    let black = of(0.0, clear(false));
    let plain = of(PAPER / 2.0, Output::default());
    let assert_same = |film: &Film, expected: &Film| {
        let same = |a: f64, b: f64| (a - b).abs() <= 1e-6 * b.abs() + 1e-12;
        let [noise, other] = [film, expected].map(Film::relative_noise);
        assert!(same(noise, other) && noise > 1e-3, "{noise}, not {other}");
        for (x, y) in pixels(film) {
            let [variance, other] = [film, expected].map(|film| film.variance(x, y));
            assert!(same(variance, other), "({x}, {y}): {variance}, not {other}");
        }
    };
    assert_same(&of(4.0, clear(false)), &black);
    assert_same(&of(4.0, clear(true)), &black);
    assert_same(&of(4.0, paper()), &plain);
    assert_same(&of(0.0, paper()), &plain);
}

/// Nor does it depend on how much is free around what is seen: it was thrice as much where the frame is thrice as wide
/// and high. A ball in as many pixels has the same noise; seven hundred tell it to a twentieth.
#[test]
fn noise_for_compositing_is_of_what_is_covered() {
    let of = |size: u32, fov: f64| {
        let objects = vec![sphere([0.0; 3], 1.0, diffuse([0.8; 3]))];
        let mut desc =
            scene(size, vec![light([2.0, 3.0, 4.0], 0.8, [9.0; 3])], objects).camera([0.0, 0.0, 6.0], [0.0; 3], fov);
        desc.output = Output { alpha: true, ..Output::default() };
        film(&compiled(&desc), 16, 3).relative_noise()
    };
    let fov = 28.0f64;
    let wide = 2.0 * (3.0 * (0.5 * fov).to_radians().tan()).atan().to_degrees();
    let [near, wide] = [of(48, fov), of(144, wide)];
    assert!((wide / near - 1.0).abs() < 0.25, "{near} and {wide}");
}

fn pixels(film: &Film) -> impl Iterator<Item = (u32, u32)> + use<> {
    let [width, height] = film.size();
    (0..height).flat_map(move |y| (0..width).map(move |x| (x, y)))
}

/// Under a background of one colour it is that colour times the share of the samples that miss, in every pixel; clamped
/// samples, too. The sums are exact, so only single precision's rounding of the colour is between.
#[test]
fn a_background_of_one_colour_is_the_share_that_misses() {
    let mut clamped = balls();
    clamped.render.clamp = Some(1.5.into());
    for (desc, scale) in [(balls(), 1.0), (clamped, 0.5)] {
        let film = film(&compiled(&desc), 9, 3);
        let (mut covered, mut clear, mut part) = (0, 0, 0);
        for (x, y) in pixels(&film) {
            let (alpha, behind, radiance) = (film.alpha(x, y), film.background(x, y), film.radiance(x, y));
            for c in 0..3 {
                let expected = (1.0 - alpha) * scale * BACKGROUND[c];
                assert!((behind[c] - expected).abs() <= 1e-6 * BACKGROUND[c], "{behind:?} {alpha} at ({x}, {y})");
                assert!(radiance[c] >= behind[c] - 1e-12, "({x}, {y})");
            }
            match alpha {
                0.0 => clear += 1,
                1.0 => covered += 1,
                _ => part += 1,
            }
        }
        assert!(covered > 100 && clear > 100 && part > 100, "{covered} {clear} {part}");
    }
    // Who does not ask for it has all of the picture, and pays nothing. (Where there is glass, samples have other
    // rays.)
    let mut matt = balls();
    matt.objects.drain(..2);
    let with = film(&compiled(&matt), 9, 3);
    matt.output = Output::default();
    let plain = film(&compiled(&matt), 9, 3);
    for (x, y) in pixels(&plain) {
        assert_eq!((plain.alpha(x, y), plain.background(x, y)), (1.0, [0.0; 3]));
        assert_eq!(plain.radiance(x, y), with.radiance(x, y));
    }
    assert!(plain.bytes() < with.bytes());
}

/// Foreground and background are the picture; over paper it is as if laid there by hand.
#[test]
fn laid_over_something() {
    // Without light paths, which may fall where no camera ray of the pixel has met anything.
    let mut desc = balls();
    desc.render.caustics = Caustics::None;
    let film = film(&compiled(&desc), 9, 3);
    let look = |backdrop| Look { exposure: -0.7, tone_map: ToneMap::AgX, backdrop };
    let paper = [0.9, 0.8, 0.1];
    let whole = develop(&film, &look(Backdrop::Background));
    let [clear, laid] = [Backdrop::Clear, Backdrop::Color(paper)].map(|backdrop| develop(&film, &look(backdrop)));
    assert_eq!((&whole.alpha, &laid.alpha), (&None, &None));
    let alpha = clear.alpha.as_ref().expect("it is clear");
    let decoded = |x: f32| if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) };
    for k in 0..clear.linear.len() {
        let (alpha, background) = (alpha[k / 3], BACKGROUND[k % 3] as f32 * (-0.7_f32).exp2());
        let sum = clear.linear[k] + (1.0 - alpha) * background;
        assert!((sum - whole.linear[k]).abs() <= 1e-5 * whole.linear[k], "{k}");
        let over = alpha * decoded(clear.display[k]) + (1.0 - alpha) * paper[k % 3] as f32;
        let shown = srgb_encode(f64::from(over)) as f32;
        assert!((shown - laid.display[k]).abs() < 1e-4, "{k}: {shown} {}", laid.display[k]);
        if alpha == 0.0 {
            assert_eq!((clear.linear[k], clear.display[k]), (0.0, 0.0), "{k}");
        }
    }
}

/// What is black stays black when it is denoised, whatever is behind it: nothing of the background gets into what is
/// before it, out of focus or not. With the background in place again it is the picture that is denoised as a whole,
/// but for what filtering makes of noise.
#[test]
fn denoised_foregrounds_have_nothing_of_the_background() {
    let mut desc = scene(48, Vec::new(), vec![sphere([0.0; 3], 1.0, diffuse([0.0; 3]))])
        .background(BACKGROUND)
        .camera([0.0, 0.0, 6.0], [0.0; 3], 40.0)
        .lens(0.6, 4.0)
        .filter(PixelFilter::BlackmanHarris { radius: 1.5.into() });
    desc.output = Output { alpha: true, ..Output::default() };
    let layers: LayerSet = GUIDES.into_iter().chain([Layer::Alpha]).collect();
    let options = RenderOptions { samples: Some(9), halves: true, layers: Some(layers), ..RenderOptions::default() };
    let film = render(&compiled(&desc), &options, &Unobserved);
    let denoised = denoise(&film).expect("it has all that is needed");
    let look = |backdrop| Look { exposure: 0.0, tone_map: ToneMap::None, backdrop };
    let clear = develop_denoised(&film, &look(Backdrop::Clear), &denoised);
    assert_eq!(clear.linear, vec![0.0; clear.linear.len()]);
    assert_eq!(clear.display, vec![0.0; clear.display.len()]);
    let whole = develop_denoised(&film, &look(Backdrop::Background), &denoised);
    let plain = develop(&film, &look(Backdrop::Background));
    let pairs = whole.linear.iter().zip(&plain.linear);
    assert!(pairs.clone().all(|(a, b)| (a - b).abs() <= 1e-5 * b), "a black ball has nothing to filter");
    assert!(pairs.filter(|(a, _)| **a > 0.0).count() > 1000);
}
