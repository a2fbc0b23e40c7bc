//! What holds for any picture: what is right stays, what is noise goes, and nothing depends on the machine.

use tracer_denoise::{Input, REACH, WrongSize, denoise};

/// A rendering by hand.
#[derive(Clone)]
struct Picture {
    width: usize,
    height: usize,
    truth: Vec<f32>,
    halves: [Vec<f32>; 2],
    lamps: Vec<f32>,
    albedo: Vec<f32>,
    normal: Vec<f32>,
    depth: Vec<f32>,
    variance: Vec<f32>,
}

/// A number from -1 to 1 for each place, even (SplitMix64).
fn noise(k: usize, half: usize) -> f32 {
    let mut h = (k as u64 * 2 + half as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    h = (h ^ (h >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    h = (h ^ (h >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (h >> 40) as f32 / 8_388_608.0 - 1.0
}

impl Picture {
    /// Light of a white wall two metres away: `light` in all channels, and noise of that size, in each half its own.
    fn wall([width, height]: [usize; 2], light: impl Fn(usize, usize) -> f32, size: f32) -> Self {
        let at = |k: usize| light(k % width, k / width);
        let pixels = width * height;
        let of = |half: usize| (0..pixels).flat_map(|k| [at(k) * (1.0 + size * noise(k, half)); 3]).collect();
        Picture {
            width,
            height,
            truth: (0..pixels).flat_map(|k| [at(k); 3]).collect(),
            halves: [of(0), of(1)],
            lamps: vec![0.0; 3 * pixels],
            albedo: vec![0.8; 3 * pixels],
            normal: [0.0, 0.0, 1.0].repeat(pixels),
            depth: vec![2.0; pixels],
            // The variance of the mean of two even numbers: a third of the square, halved.
            variance: (0..pixels).map(|k| at(k) * at(k) * size * size / 6.0).collect(),
        }
    }

    fn input(&self) -> Input<'_> {
        Input {
            width: self.width,
            height: self.height,
            halves: [&self.halves[0], &self.halves[1]],
            share: 0.5,
            lamps: &self.lamps,
            albedo: [&self.albedo, &self.albedo],
            normal: &self.normal,
            depth: &self.depth,
            variance: &self.variance,
        }
    }

    fn denoised(&self) -> Vec<f32> {
        denoise(&self.input()).expect("the sizes are right").pixels
    }

    fn noisy(&self) -> Vec<f32> {
        (0..self.truth.len()).map(|k| 0.5 * (self.halves[0][k] + self.halves[1][k]) + self.lamps[k]).collect()
    }

    /// Mean squared errors before and afterwards, of pixels that are meant.
    fn errors(&self, denoised: &[f32], is_meant: impl Fn(usize, usize) -> bool) -> [f64; 2] {
        let mean = |picture: &[f32]| {
            let meant = |k: &usize| is_meant(k / 3 % self.width, k / 3 / self.width);
            let square = |k: usize| f64::from(picture[k] - self.truth[k]) * f64::from(picture[k] - self.truth[k]);
            let all: Vec<f64> = (0..picture.len()).filter(meant).map(square).collect();
            all.iter().sum::<f64>() / all.len() as f64
        };
        [mean(&self.noisy()), mean(denoised)]
    }
}

fn mean(picture: &[f32]) -> f64 {
    picture.iter().map(|&x| f64::from(x)).sum::<f64>() / picture.len() as f64
}

/// Light that falls off from a lamp, an edge of shadow, a bright spot.
fn lit(x: usize, y: usize) -> f32 {
    let (dx, dy) = (x as f32 - 20.0, y as f32 - 5.0);
    let light = 40.0 / (30.0 + 0.1 * (dx * dx + dy * dy));
    if 2 * x > y + 50 { 0.1 * light } else { light }
}

#[test]
fn a_picture_without_noise_stays() {
    let mut picture = Picture::wall([70, 45], lit, 0.0);
    // A texture, a lamp, a line of another thing.
    for k in 0..70 * 45 {
        picture.albedo[3 * k + 1] = 0.1 + 0.4 * (1.0 + noise(k / 3, 0));
        picture.normal[3 * k] = if k % 70 == 33 { 1.0 } else { 0.0 };
        picture.lamps[3 * k] = if k / 70 < 4 { 5.0 } else { 0.0 };
    }
    let denoised = picture.denoised();
    for (before, after) in picture.noisy().iter().zip(&denoised) {
        assert!((before - after).abs() <= 1e-3 * before.abs(), "{before} {after}");
    }
    // Nor does what is black, or dark as night, or as bright as a sun.
    assert_eq!(Picture::wall([9, 7], |_, _| 0.0, 0.0).denoised(), [0.0; 3 * 63]);
    for scale in [1e-30, 1e-12, 1e12, 1e30] {
        let picture = Picture::wall([40, 30], |x, y| scale * lit(x, y), 0.0);
        let denoised = picture.denoised();
        let same = picture.truth.iter().zip(&denoised).all(|(a, b)| (a - b).abs() <= 1e-3 * a);
        assert!(same, "{scale}");
    }
}

#[test]
fn what_is_even_stays_even() {
    let picture = Picture::wall([64, 48], |_, _| 3.0, 0.3);
    let denoised = picture.denoised();
    let [before, after] = picture.errors(&denoised, |_, _| true);
    // The first pass alone means over 81 pixels, of which those count that are alike by the noise: at least a third.
    assert!(after < before / 27.0, "{before} {after}");
    assert!((mean(&denoised) / mean(&picture.noisy()) - 1.0).abs() < 3e-3);
}

/// Noise goes, and edges of light that no feature knows stay: their errors do not rise.
#[test]
fn edges_of_light_stay() {
    let picture = Picture::wall([96, 64], lit, 0.2);
    let denoised = picture.denoised();
    let [before, after] = picture.errors(&denoised, |_, _| true);
    assert!(after < before / 8.0, "{before} {after}");
    let [before, after] = picture.errors(&denoised, |x, y| (2 * x as i32 - y as i32 - 50).abs() < 5);
    assert!(after < before, "{before} {after}");
    assert!((mean(&denoised) / mean(&picture.truth) - 1.0).abs() < 0.01);
}

/// Light that one sample in a hundred finds is in neither half of most pixels: these are no black dots in what the
/// others have found. Of 6580 pixels 877 were darker than half of what is around them, and four are; one in a thousand
/// may be.
#[test]
fn light_that_few_samples_find_leaves_no_dots() {
    let mut picture = Picture::wall([96, 72], |_, _| 0.4, 0.0);
    let (dark, bright) = (0.1, 30.0);
    for k in 0..96 * 72 {
        // Eight samples of each half.
        let found = [0, 1].map(|half| (0..8).filter(|n| noise(8 * k + n + 7, half) > 0.98).count() as f32);
        for (half, found) in picture.halves.iter_mut().zip(found) {
            half[3 * k..3 * k + 3].fill(dark + bright * found / 8.0);
        }
        let share = (found[0] + found[1]) / 16.0;
        picture.variance[k] = bright * bright * share * (1.0 - share) / 16.0;
    }
    let denoised = picture.denoised();
    let at = |x: usize, y: usize| denoised[3 * (y * 96 + x)];
    let around = |x: usize, y: usize| {
        let square =
            (y - 1..y + 2).flat_map(|y| (x - 1..x + 2).map(move |x| (x, y))).map(|(x, y)| at(x, y)).sum::<f32>();
        (square - at(x, y)) / 8.0
    };
    let inner = (1..71).flat_map(|y| (1..95).map(move |x| (x, y)));
    let dots = inner.filter(|&(x, y)| at(x, y) < 0.5 * around(x, y)).count();
    assert!(dots < 7, "{dots}");
}

/// What the albedo shows is not blurred, however fine it is.
#[test]
fn textures_stay() {
    let mut picture = Picture::wall([80, 60], |_, _| 2.0, 0.2);
    for k in 0..80 * 60 {
        let texel = if (k % 80 + k / 80) % 2 == 0 { 0.9 } else { 0.1 };
        for c in 0..3 {
            picture.albedo[3 * k + c] = texel;
            picture.truth[3 * k + c] *= texel;
            picture.halves.iter_mut().for_each(|half| half[3 * k + c] *= texel);
        }
        picture.variance[k] *= texel * texel;
    }
    let denoised = picture.denoised();
    let [before, after] = picture.errors(&denoised, |_, _| true);
    assert!(after < before / 10.0, "{before} {after}");
}

/// Black texels stay black, and do not darken the others.
#[test]
fn black_texels_stay_black() {
    let mut picture = Picture::wall([80, 60], |_, _| 2.0, 0.3);
    for k in (0..80 * 60).filter(|k| (k % 80 / 3 + k / 80 / 3) % 2 == 0) {
        picture.albedo[3 * k..3 * k + 3].fill(0.0);
        picture.truth[3 * k..3 * k + 3].fill(0.0);
        picture.halves.iter_mut().for_each(|half| half[3 * k..3 * k + 3].fill(0.0));
        picture.variance[k] = 0.0;
    }
    let denoised = picture.denoised();
    let black = (0..80 * 60).filter(|&k| picture.truth[3 * k] == 0.0).map(|k| denoised[3 * k]).fold(0.0, f32::max);
    assert!(black < 0.01, "{black}");
    let [before, after] = picture.errors(&denoised, |_, _| true);
    assert!(after < before / 10.0, "{before} {after}");
    assert!((mean(&denoised) / mean(&picture.truth) - 1.0).abs() < 0.01);
}

/// What one half has met more of a fine pattern than the other is no noise of light: that goes as without a pattern, no
/// light is lost at the brightest place, and halves that have met black alone do not darken the others.
#[test]
fn halves_may_have_met_unlike_parts_of_a_texture() {
    let light = |x: usize, y: usize| {
        let (dx, dy) = (x as f32 - 40.0, y as f32 - 30.0);
        2.0 / (1.0 + (dx * dx + dy * dy) / 400.0)
    };
    let mut picture = Picture::wall([80, 60], light, 0.05);
    // Of eight samples of each half some have met white, the others black.
    let met = |k: usize, half: usize| (0..8).filter(|n| noise(8 * k + n + 99, half) > 0.0).count() as f32 / 8.0;
    let mut albedo = [vec![0.0; 3 * 80 * 60], vec![0.0; 3 * 80 * 60]];
    for k in 0..80 * 60 {
        let (mean, numbers) = (0.5 * (met(k, 0) + met(k, 1)), 3 * k..3 * k + 3);
        for (half, albedo) in albedo.iter_mut().enumerate() {
            albedo[numbers.clone()].fill(met(k, half));
            picture.halves[half][numbers.clone()].iter_mut().for_each(|x| *x *= met(k, half));
        }
        picture.truth[numbers].iter_mut().for_each(|x| *x *= mean);
        // The samples' own variance is that of the pattern.
        let light = light(k % 80, k / 80);
        picture.variance[k] = light * light * 0.25 / 16.0;
    }
    let denoised =
        denoise(&Input { albedo: [&albedo[0], &albedo[1]], ..picture.input() }).expect("the sizes are right");
    let [before, after] = picture.errors(&denoised.pixels, |_, _| true);
    assert!(after < before / 3.0, "{before} {after}");
    let kept = |is_meant: &dyn Fn(usize) -> bool| {
        let sum = |of: &[f32]| (0..of.len()).filter(|k| is_meant(k / 3)).map(|k| f64::from(of[k])).sum::<f64>();
        sum(&denoised.pixels) / sum(&picture.truth)
    };
    let peak = |k: usize| (30..50).contains(&(k % 80)) && (20..40).contains(&(k / 80));
    // 400 pixels with 4 white samples each, a twentieth over root three of noise: 7e-4.
    for kept in [kept(&|_| true), kept(&peak)] {
        assert!((kept - 1.0).abs() < 3e-3, "{kept}");
    }
    // What is told of errors has that of the pattern in it, before and afterwards.
    assert!(denoised.told.error_before > 0.2 && denoised.told.error_after > 0.2, "{:?}", denoised.told);
}

/// A lamp before a wall, its edge in many pixels in part: what is seen of it stays, to the last bit but for rounding,
/// and the wall beside it is as clean as elsewhere.
#[test]
fn lamps_stay() {
    let mut picture = Picture::wall([80, 60], |_, _| 1.0, 0.3);
    let mut lamps = [vec![0.0; 3 * 80 * 60], vec![0.0; 3 * 80 * 60]];
    for k in 0..80 * 60 {
        let (dx, dy) = ((k % 80) as f32 - 40.0, (k / 80) as f32 - 30.0);
        let inside = (10.0 - (dx * dx + dy * dy).sqrt() + 0.5).clamp(0.0, 1.0);
        // Of an edge some samples see the lamp, in each half others.
        for (half, lamps) in lamps.iter_mut().enumerate() {
            let share =
                if inside > 0.0 && inside < 1.0 { (inside + 0.3 * noise(k, half)).clamp(0.0, 1.0) } else { inside };
            for c in 0..3 {
                lamps[3 * k + c] = 500.0 * share;
                picture.halves[half][3 * k + c] *= 1.0 - share;
            }
        }
        for c in 0..3 {
            picture.lamps[3 * k + c] = 0.5 * (lamps[0][3 * k + c] + lamps[1][3 * k + c]);
            picture.truth[3 * k + c] = picture.lamps[3 * k + c] + 1.0 - picture.lamps[3 * k + c] / 500.0;
        }
        if inside > 0.0 {
            picture.albedo[3 * k..3 * k + 3].fill(0.8 * (1.0 - inside));
        }
    }
    let denoised = denoise(&picture.input()).expect("the sizes are right");
    assert!(denoised.pixels.iter().all(|&x| x >= 0.0));
    let [before, after] = picture.errors(&denoised.pixels, |_, _| true);
    assert!(after < before / 10.0, "{before} {after}");
    // The error that is told is that of the picture, over that of its root mean square.
    let truth = (picture.truth.iter().map(|x| x * x).sum::<f32>() / picture.truth.len() as f32).sqrt();
    let told = denoised.told.error_before * f64::from(truth);
    assert!((told / before.sqrt() - 1.0).abs() < 0.1, "{told} {before}");
    let told = denoised.told.error_after * f64::from(truth);
    assert!(told > 0.3 * after.sqrt() && told < 3.0 * after.sqrt(), "{told} {after}");
}

/// What both halves have is no noise, however small it is.
#[test]
fn small_lights_stay() {
    let mut picture = Picture::wall([60, 40], |_, _| 1.0, 0.1);
    let spots = [(30, 20), (10, 8), (45, 31)].map(|(x, y)| 60 * y + x);
    for k in spots {
        (0..3).for_each(|c| picture.truth[3 * k + c] = 5.0);
        picture.halves.iter_mut().for_each(|half| (0..3).for_each(|c| half[3 * k + c] *= 5.0));
    }
    let denoised = picture.denoised();
    for k in spots {
        assert!((denoised[3 * k] / picture.noisy()[3 * k] - 1.0).abs() < 0.01, "{}", denoised[3 * k]);
    }
}

/// A firefly is in one half only.
#[test]
fn fireflies_go() {
    let mut picture = Picture::wall([60, 40], |_, _| 1.0, 0.1);
    let flies = [(30, 20), (10, 8), (45, 31)].map(|(x, y)| 60 * y + x);
    for (n, k) in flies.into_iter().enumerate() {
        (0..3).for_each(|c| picture.halves[n % 2][3 * k + c] = 100.0);
        picture.variance[k] = 2500.0;
    }
    let denoised = picture.denoised();
    let [before, after] = picture.errors(&denoised, |_, _| true);
    assert!(after < before / 20.0, "{before} {after}");
}

/// Nothing is hit, nothing is seen, numbers are none: all that comes out is a number.
#[test]
fn whatever_comes_in_numbers_come_out() {
    let mut picture = Picture::wall([50, 34], lit, 0.5);
    for k in 0..50 * 34 {
        match k % 7 {
            0 => picture.depth[k] = f32::INFINITY,
            1 => picture.albedo[3 * k..3 * k + 3].fill(0.0),
            2 => picture.normal[3 * k..3 * k + 3].fill(0.0),
            3 => picture.variance[k] = [0.0, f32::MAX, f32::NAN, -1.0][k % 4],
            4 => picture.depth[k] = [0.0, -1.0, f32::NAN, 1e-38][k % 4],
            5 => picture.halves[k % 2][3 * k] = [f32::MAX, -1.0, f32::MIN, 1e-40][k % 4],
            _ => picture.lamps[3 * k] = [f32::MAX, 0.0, 7.0, 1e-40][k % 4],
        }
    }
    assert!(picture.denoised().iter().all(|x| x.is_finite()));
    picture.halves[0][17] = f32::NAN;
    picture.halves[1][170] = f32::INFINITY;
    picture.albedo[5] = f32::NAN;
    picture.normal[9] = f32::INFINITY;
    assert!(picture.denoised().iter().all(|x| !x.is_nan()));
    for size in [[1, 1], [1, 50], [50, 1], [2, 3], [33, 9]] {
        let denoised = Picture::wall(size, lit, 0.5).denoised();
        assert!(denoised.len() == 3 * size[0] * size[1] && denoised.iter().all(|x| x.is_finite()));
    }
    let nothing = Picture::wall([0, 5], lit, 0.5);
    assert!(nothing.denoised().is_empty());
}

#[test]
fn threads_do_not_show() {
    let picture = Picture::wall([131, 77], lit, 0.4);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let denoised = pool.install(|| denoise(&picture.input())).expect("the sizes are right");
        let bits: Vec<u32> = denoised.pixels.iter().map(|x| x.to_bits()).collect();
        (bits, denoised.told)
    };
    let one = with(1);
    assert!([2, 3, 7].into_iter().all(|threads| with(threads) == one));
}

/// A pixel does not depend on those that are farther away than that: so that one knows how far crops differ.
#[test]
fn a_pixel_depends_on_those_within_reach() {
    let [width, height] = [REACH + 60, 40];
    let picture = Picture::wall([width, height], |x, y| lit(x % 60, y), 0.4);
    let mut other = picture.clone();
    // The picture's mean, by which all is measured, stays between the same powers of two.
    for y in 0..height {
        for k in 3 * (y * width)..3 * (y * width + 8) {
            other.halves[0][k] *= 1.1;
            other.albedo[k] *= 0.9;
        }
    }
    let (one, other) = (picture.denoised(), other.denoised());
    let differs = |x: usize| (0..height).any(|y| one[3 * (y * width + x)] != other[3 * (y * width + x)]);
    assert!(differs(8));
    assert!((8 + REACH..width).all(|x| !differs(x)));
}

/// Halves of unequal numbers of samples count by them: nothing is changed but noise.
#[test]
fn shares_count() {
    let mut picture = Picture::wall([64, 48], |_, _| 1.0, 0.0);
    // A quarter of the samples has four times the variance of the rest.
    for k in 0..64 * 48 {
        for c in 0..3 {
            picture.halves[0][3 * k + c] = 1.0 + 0.3 * noise(k, 0);
            picture.halves[1][3 * k + c] = 1.0 + 0.3 / 3.0_f32.sqrt() * noise(k, 1);
        }
    }
    let input = Input { share: 0.25, ..picture.input() };
    let denoised = denoise(&input).expect("the sizes are right");
    let noisy = |k: usize| 0.25 * picture.halves[0][k] + 0.75 * picture.halves[1][k];
    let error =
        |value: &dyn Fn(usize) -> f32| (0..3 * 64 * 48).map(|k| (value(k) - 1.0) * (value(k) - 1.0)).sum::<f32>();
    let (before, after) = (error(&noisy), error(&|k| denoised.pixels[k]));
    assert!(after < before / 27.0, "{before} {after}");
    // Errors are told rightly: those before to a twentieth, for there are three thousand of them.
    let told = (before / (3.0 * 64.0 * 48.0)).sqrt();
    assert!((denoised.told.error_before as f32 / told - 1.0).abs() < 0.05, "{told} {:?}", denoised.told);
    assert!(denoised.told.error_after < 0.4 * denoised.told.error_before);
    assert!((denoised.told.change as f32 / told - 1.0).abs() < 0.1);
}

#[test]
fn pictures_of_another_size_are_refused() {
    let picture = Picture::wall([8, 6], lit, 0.1);
    let wrong = |input: Input<'_>| denoise(&input).expect_err("it is refused").to_string();
    let input = picture.input();
    let said = "what is to be denoised has the wrong number of pixels";
    assert_eq!(wrong(Input { width: 9, ..input }), said);
    assert_eq!(wrong(Input { depth: &picture.depth[1..], ..input }), said);
    assert_eq!(wrong(Input { albedo: [&[], &picture.albedo], ..input }), said);
    assert_eq!(denoise(&Input { share: 1.0, ..input }), Err(WrongSize("share of the halves")));
    assert_eq!(denoise(&Input { width: usize::MAX, height: 3, ..input }), Err(WrongSize("size")));
}
