use super::*;

fn even(colour: [f32; 3], width: usize, height: usize) -> Vec<f32> {
    colour.repeat(width * height)
}

fn one(reference: [f32; 3], test: [f32; 3]) -> f32 {
    let map = flip(&even(reference, 9, 7), &even(test, 9, 7), 9);
    assert!(map.iter().all(|e| (e - map[0]).abs() < 1e-5), "even pictures differ evenly");
    map[0]
}

#[test]
fn the_largest_difference_is_one() {
    assert!((one([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]) - 1.0).abs() < 1e-4);
}

#[test]
fn equal_pictures_have_none() {
    assert_eq!(one([0.2, 0.7, 0.4], [0.2, 0.7, 0.4]), 0.0);
}

/// White against black: HyAB is 100, and between green and blue it is 308.3 (L 87.73 and 32.30, the rest chroma under
/// the Hunt effect): 100^0.7 = 25.12 lies above the knee at 0.4 * 308.3^0.7 = 22.09, a tenth of the way to the end, so
/// that the result is 0.95 + 0.05 * 0.0914.
#[test]
fn white_against_black_by_hand() {
    let largest = colour::largest_difference().powf(QC);
    let expected = PT + (1.0 - PT) * (100f32.powf(QC) - PC * largest) / (largest - PC * largest);
    let got = one([1.0; 3], [0.0; 3]);
    assert!((got - expected).abs() < 1e-4, "{got} {expected}");
    assert!((0.95..1.0).contains(&got));
}

#[test]
fn it_does_not_matter_which_is_the_reference() {
    let (a, b) = (noise(1), noise(2));
    assert_eq!(flip(&a, &b, 32), flip(&b, &a, 32));
}

#[test]
fn a_larger_difference_is_larger() {
    let grey = |x: f32| one([0.5; 3], [x; 3]);
    assert!(grey(0.52) < grey(0.6) && grey(0.6) < grey(0.9));
}

/// One white pixel on black: the eye blurs its colour, and the point detector finds it.
#[test]
fn a_firefly_is_seen_where_it_is() {
    let (width, at) = (33, 16 * 33 + 16);
    let black = even([0.0; 3], width, width);
    let mut firefly = black.clone();
    firefly[3 * at..3 * at + 3].fill(1.0);
    let map = flip(&black, &firefly, width);
    let most = (0..map.len()).max_by(|&i, &j| map[i].total_cmp(&map[j]));
    assert_eq!(most, Some(at));
    assert!(map[at] > 0.4, "{}", map[at]);
    // Far from it, nothing.
    assert_eq!(map[0], 0.0);
}

/// The authors' own program (version 1.2, at the same pixels per degree) gives these numbers for these pictures of 8
/// bits. It works in f32 with another order of sums; the tolerance is that of a few thousand roundings.
#[test]
fn numbers_of_the_authors_program() {
    let check = |reference: &[f32], test: &[f32], mean: f32, max: f32| {
        let map = flip(reference, test, 32);
        let got_mean = map.iter().sum::<f32>() / map.len() as f32;
        let got_max = map.iter().copied().fold(0.0, f32::max);
        assert!((got_mean - mean).abs() < 1e-4, "mean {got_mean} {mean}");
        assert!((got_max - max).abs() < 1e-4, "max {got_max} {max}");
    };
    check(&noise(1), &noise(2), 0.458_652_26, 0.961_800_46);
    let ramp = picture(|x, y| [8 * x, 8 * y, 128]);
    let rings = picture(|x, y| {
        let ring = (x * x + y * y) / 8 % 32;
        [8 * ring, 255 - 8 * ring, 8 * x]
    });
    check(&ramp, &rings, 0.869_144_86, 0.995_757_46);
}

/// A picture of 32 x 32 pixels with these 8-bit values.
fn picture(colour: impl Fn(u32, u32) -> [u32; 3]) -> Vec<f32> {
    (0..32 * 32u32).flat_map(|k| colour(k % 32, k / 32).map(|c| c as f32 / 255.0)).collect()
}

/// 8-bit values in 0..=1 from a counter.
fn noise(seed: u32) -> Vec<f32> {
    (0..32 * 32 * 3u32)
        .map(|k| {
            let mut h = (k + 1).wrapping_mul(0x9e37_79b9) ^ seed.wrapping_mul(0x85eb_ca6b);
            h = (h ^ h >> 16).wrapping_mul(0x21f0_aaad);
            h = (h ^ h >> 15).wrapping_mul(0x735a_2d97);
            ((h ^ h >> 15) >> 24) as f32 / 255.0
        })
        .collect()
}
