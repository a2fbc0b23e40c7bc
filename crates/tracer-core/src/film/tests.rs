//! Tests of the film.

use super::*;

fn filled(value: impl Fn(usize) -> f32) -> [Vec<f32>; 3] {
    let column: Vec<f32> = (0..64).map(value).collect();
    [column.clone(), column.clone(), column]
}

fn slices(samples: &[Vec<f32>; 3]) -> [&[f32]; 3] {
    samples.each_ref().map(Vec::as_slice)
}

/// Sample k is pixel k's.
fn first_pixels() -> [[u8; 2]; 64] {
    std::array::from_fn(|k| [k as u8; 2])
}

#[test]
fn sums_do_not_depend_on_their_order() {
    let samples: Vec<[Vec<f32>; 3]> = (0..500u32)
        .map(|k| {
            filled(|pixel| {
                let h = (k * 64 + pixel as u32).wrapping_mul(0x9e37_79b9);
                let sign = if h & 16 == 0 { 1.0 } else { -1.0 };
                // From 2^-63 to 2^25: sums of doubles would round nearly all of them.
                f32::from_bits(0x2000_0000 + h % 0x2c00_0000) * sign
            })
        })
        .collect();
    let (mut forwards, mut backwards) = (Tile::zeroed(), Tile::zeroed());
    samples.iter().for_each(|s| assert_eq!(forwards.add(slices(s), &first_pixels()), LeftOut::default()));
    samples.iter().rev().for_each(|s| assert_eq!(backwards.add(slices(s), &first_pixels()), LeftOut::default()));
    assert!(forwards == backwards);
}

/// One pixel of 256 in which now and then there is something very bright, and one of which that is so in all pixels.
#[test]
fn the_few_pixels_that_bear_the_noise_are_found() {
    let film = |brightest: f32| {
        let mut film = Film::new([16, 16], Crop::whole([16, 16]), 0, 1.0, None);
        let (_, bright) = film.place(5, 9);
        for sample in 0..8 {
            for first in [0, 64, 128, 192] {
                let light = |k: usize| match first + k {
                    pixel if pixel == bright && sample == 3 => brightest,
                    _ if sample % 2 == 0 => 0.75,
                    _ => 0.25,
                };
                let pixels: [[u8; 2]; 64] = std::array::from_fn(|k| [k as u8, (first + k) as u8]);
                film.tiles[0].add(slices(&filled(light)), &pixels);
            }
        }
        film
    };
    assert_eq!(film(0.25).few_noisy(), None);
    let few = film(1e6).few_noisy().expect("one that is brighter");
    assert_eq!((few.pixels, few.worst), (1, [5, 9]));
    // Eight samples that scatter by a quarter: the variance of the mean is 1/16/7, relative to a mean of a half.
    let expected = (1.0 / 112.0f64).sqrt() / 0.5;
    assert!((few.rest / expected - 1.0).abs() < 1e-6, "{few:?}, {expected}");
}

#[test]
fn a_film_takes_the_bytes_that_were_foretold() {
    for crop in
        [Crop::whole([17, 8]), Crop { x: 7, y: 3, width: 2, height: 6 }, Crop { x: 16, y: 8, width: 16, height: 1 }]
    {
        for clamp in [None, Some(1.0)] {
            let film = Film::new([40, 40], crop, 0, 1.0, clamp);
            assert_eq!(film.bytes() as u64, Film::bytes_of(crop, clamp.is_some(), false, LayerSet::default(), false));
        }
    }
}

/// Light paths are counted by themselves: by as many sample indices as the pixels have samples, or by more where a
/// rendering was ended.
#[test]
fn what_light_paths_bring_is_a_mean_of_its_own() {
    let mut film = Film::new([16, 16], Crop::whole([16, 16]), 0, 2.0, None);
    let tile = &mut film.tiles[0];
    for _ in 0..2 {
        tile.add(slices(&filled(|_| 0.25)), &first_pixels());
    }
    tile.splat(0, [1.0, 2.0, 4.0], None);
    tile.splat(0, [1.0, 0.0, f32::NAN], None);
    film.light_samples = 2;
    assert_eq!(film.radiance(0, 0), [2.0 * (0.25 + 0.5), 2.0 * (0.25 + 1.0), 2.0 * (0.25 + 2.0)]);
    assert!(film.variance(0, 0) > 0.0);
    film.light_samples = 4;
    assert_eq!(film.radiance(0, 0), [2.0 * (0.25 + 0.25), 2.0 * (0.25 + 0.5), 2.0 * (0.25 + 1.0)]);
    // Clamped, what is taken and what is left are the whole.
    let mut clamped = Film::new([16, 16], Crop::whole([16, 16]), 0, 2.0, Some(4.0));
    clamped.tiles[0].add(slices(&filled(|_| 0.25)), &first_pixels());
    clamped.tiles[0].splat(0, [1.0, 2.0, 4.0], Some(2.0));
    clamped.light_samples = 1;
    assert_eq!((clamped.radiance(0, 0), clamped.taken(0, 0)), ([1.5, 2.5, 4.5], [1.0, 2.0, 4.0]));
    // A pixel that they have not met.
    assert_eq!(film.radiance(1, 0), [0.5; 3]);
    assert_eq!(film.variance(1, 0), 0.0);
}

#[test]
fn wrong_samples_are_dropped_and_counted() {
    let mut tile = Tile::zeroed();
    let samples = filled(|k| [1.0, f32::NAN, -1.0, f32::INFINITY, -1e30, LARGEST, 2.0 * LARGEST, 0.0][k % 8]);
    let left_out = tile.add(slices(&samples), &first_pixels());
    assert_eq!(left_out, LeftOut { dropped: 16, beyond: 16 });
    let sums = [1.0, 0.0, -1.0, 0.0, 0.0, LARGEST, 0.0, 0.0].map(fixed);
    assert_eq!(std::array::from_fn(|k| tile.sums.of(0, k)), sums);
}

/// Samples of all signs and sizes, some of them far above the limit: per pixel and channel, what is taken and what is
/// left sum to what there was to the last bit; nothing is above the limit, and the rest is as it was.
#[test]
fn what_is_taken_and_what_is_left_are_the_whole() {
    const LIMIT: f32 = 0.7;
    let sample = |k: u32, channel: u32| {
        filled(|pixel| {
            let h = tracer_kernels::sampling::sampler::hash3(k, pixel as u32, channel);
            let sign = if h >> 62 == 0 { -1.0 } else { 1.0 };
            // From 2^-31 to 2^23.
            f32::from_bits(0x3000_0000 + h as u32 % 0x1b00_0000) * sign
        })[0]
            .clone()
    };
    let (mut whole, mut clamped) = (Tile::zeroed(), Tile::zeroed());
    clamped.keep_taken();
    for k in 0..200 {
        let before = [0, 1, 2].map(|channel| sample(k, channel));
        let mut after = before.clone();
        whole.add(slices(&before), &first_pixels());
        clamped.clamp(f64::from(LIMIT), after.each_mut().map(Vec::as_mut_slice), &first_pixels());
        clamped.add(slices(&after), &first_pixels());
        for slot in 0..64 {
            let [before, after] = [&before, &after].map(|s| s.each_ref().map(|channel| channel[slot]));
            let largest = before.iter().fold(f32::MIN, |a, &b| a.max(b));
            if largest <= LIMIT {
                assert_eq!(after, before);
                continue;
            }
            for c in 0..3 {
                assert_eq!(after[c] == LIMIT, before[c] == largest, "{before:?} {after:?}");
                // The quotient is rounded twice, to f64 and to f32; below 2^-126 f32 is coarser.
                let exact = f64::from(before[c]) * f64::from(LIMIT) / f64::from(largest);
                assert!((f64::from(after[c]) - exact).abs() <= exact.abs() * 1.2e-7 + 1e-45);
            }
        }
    }
    let taken = clamped.taken.as_ref().expect("it was clamped");
    assert!(taken.samples[..64].iter().all(|&n| (50..200).contains(&n)), "{:?}", &taken.samples[..64]);
    for c in 0..3 {
        for pixel in 0..64 {
            let (left, took) = (clamped.sums.of(c, pixel), taken.sums.of(c, pixel));
            assert_eq!(left + took, whole.sums.of(c, pixel), "channel {c}, pixel {pixel}");
        }
    }
}

#[test]
fn what_is_not_finite_is_dropped_and_not_clamped() {
    let mut tile = Tile::zeroed();
    tile.keep_taken();
    let mut samples = filled(|k| [9.0, f32::NAN, -9.0, f32::INFINITY][k % 4]);
    tile.clamp(3.0, samples.each_mut().map(Vec::as_mut_slice), &first_pixels());
    assert_eq!(tile.add(slices(&samples), &first_pixels()), LeftOut { dropped: 32, beyond: 0 });
    assert_eq!([0, 1, 2, 3].map(|k| tile.sums.of(0, k)), [3.0, 0.0, -9.0, 0.0].map(fixed));
    let taken = tile.taken.expect("it was clamped");
    assert_eq!(
        [0, 1, 2, 3].map(|k| (taken.samples[k], taken.sums.of(0, k))),
        [(1, 6.0), (0, 0.0), (0, 0.0), (0, 0.0)].map(|(n, x)| (n, fixed(x)))
    );
}
