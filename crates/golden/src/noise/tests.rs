//! Pictures drawn from known distributions; those of the engine are in `crates/tracer/tests/golden.rs`.

use super::*;
use crate::measured::{MOST_BATCHES, Recorder};

/// No sample of these pictures is brighter.
const BRIGHTEST: f32 = 100.0;

/// SplitMix64.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 + 1e-17
    }
}

/// A picture whose samples are one distribution, of mean one, times the light of a pixel. `shared` of each sample is
/// common to 8x8 pixels, at places that differ by sample: the correlation that sharing brings, at its worst.
fn picture(
    seed: u64,
    [width, height]: [u32; 2],
    samples: u32,
    shared: f64,
    draw: fn(&mut Random) -> f64,
    light: impl Fn(u32, u32) -> f64,
) -> Measured {
    let mut random = Random(seed.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let count = (width * height) as usize;
    let (mut sums, mut squares) = (vec![0.0; count], vec![0.0; count]);
    let mut recorder = Recorder::new(width, height, samples);
    for n in 1..=samples {
        let shift = [0; 2].map(|_: u32| (random.uniform() * 8.0) as u32);
        let blocks = width / 8 + 2;
        let common: Vec<f64> = (0..blocks * (height / 8 + 2)).map(|_| draw(&mut random)).collect();
        for y in 0..height {
            for x in 0..width {
                let block = (y + shift[1]) / 8 * blocks + (x + shift[0]) / 8;
                let sample = light(x, y) * (shared * common[block as usize] + (1.0 - shared) * draw(&mut random));
                let i = (y * width + x) as usize;
                sums[i] += sample;
                squares[i] += sample * sample;
            }
        }
        if recorder.wants(n) {
            recorder.see(n, |x, y| [sums[(y * width + x) as usize] / f64::from(n); 3]);
        }
    }
    let n = f64::from(samples);
    let variance =
        |(sum, square): (&f64, &f64)| ((square / n - (sum / n) * (sum / n)) / (n - 1.0).max(1.0)).max(0.0) as f32;
    Measured {
        width,
        height,
        samples,
        brightest: BRIGHTEST,
        look: String::new(),
        rgb: sums.iter().flat_map(|sum| [(sum / n) as f32; 3]).collect(),
        variance: sums.iter().zip(&squares).map(variance).collect(),
        batches: recorder.batches().expect("all"),
    }
}

fn exponential(random: &mut Random) -> f64 {
    -random.uniform().ln()
}

/// Seldom and bright: one in fifty brings fifty.
fn seldom(random: &mut Random) -> f64 {
    if random.uniform() < 0.02 { 50.0 } else { 0.0 }
}

/// Pareto with index 1.5, which has no variance; mean one, but for what is cut off at the brightest light.
fn heavy(random: &mut Random) -> f64 {
    (random.uniform().powf(-1.0 / 1.5) / 3.0).min(f64::from(BRIGHTEST))
}

fn grey(_: u32, _: u32) -> f64 {
    0.5
}

fn is_noise(judgement: &Judgement) -> bool {
    matches!(judgement, Judgement::Noise { .. })
}

/// None in 300 pairs for each distribution, the heavy ones and those that share among them: with one in a thousand one
/// would be seen among 900 with 59 %; what is promised is a bound, and the tests of signs stay far below it for few
/// batches.
#[test]
fn noise_is_no_alarm() {
    for (name, draw, shared) in [
        ("plain", exponential as fn(&mut Random) -> f64, 0.0),
        ("shared", exponential, 0.6),
        ("seldom", seldom, 0.3),
        ("heavy", heavy, 0.3),
    ] {
        let alarms: Vec<Judgement> = (0..300)
            .map(|seed| {
                judge(
                    &picture(2 * seed, [48, 32], 32, shared, draw, grey),
                    &picture(2 * seed + 1, [48, 32], 32, shared, draw, grey),
                )
            })
            .filter(|judgement| !is_noise(judgement))
            .collect();
        assert!(alarms.is_empty(), "{name}: {alarms:?}");
    }
}

#[test]
fn changes_are_found() {
    let size = [48, 32];
    let expected = picture(1, size, 32, 0.0, exponential, grey);
    // All of it two per cent darker: the standard error of the mean of 48x32x32 samples is 0.45 %, that of the
    // difference 0.64 %.
    let darker = picture(2, size, 32, 0.0, |random| 0.3 * exponential(random) + 0.7, |x, y| 0.98 * grey(x, y));
    let plain = picture(3, size, 32, 0.0, |random| 0.3 * exponential(random) + 0.7, grey);
    assert!(!is_noise(&judge(&plain, &darker)));
    // A corner without light.
    let corner = |x: u32, y: u32| if x < 12 && y < 12 { 0.2 } else { 0.5 };
    let Judgement::Different { findings } = judge(&expected, &picture(4, size, 32, 0.0, exponential, corner)) else {
        panic!("the corner is found")
    };
    let [x, y, width, height] = findings[0].region;
    assert!(x < 12 && y < 12 && width <= 16 && height <= 16, "{findings:?}");
    // One pixel: all its samples, and one sample that no light makes.
    for (light, variance) in [(5.0, 0.01), (90.0, 8100.0)] {
        let mut other = picture(5, size, 32, 0.0, exponential, grey);
        other.rgb[3 * 500..3 * 500 + 3].fill(light);
        other.variance[500] = variance;
        let Judgement::Different { findings } = judge(&expected, &other) else { panic!("the pixel is found") };
        assert_eq!(findings[0].region, [500 % 48, 500 / 48, 1, 1], "{findings:?}");
    }
    // One sample that a light may make is noise.
    let mut firefly = picture(5, size, 32, 0.0, exponential, grey);
    firefly.rgb[3 * 500..3 * 500 + 3].fill(3.0);
    firefly.variance[500] = 9.0;
    assert!(is_noise(&judge(&expected, &firefly)));
}

/// What has no noise is compared as it is, but for rounding.
#[test]
fn pixels_without_noise() {
    let flat = |seed, light: fn(u32, u32) -> f64| picture(seed, [16, 16], 32, 0.0, |_| 1.0, light);
    let expected = flat(1, grey);
    assert!(is_noise(&judge(&expected, &flat(2, |_, _| 0.5001))));
    let Judgement::Different { findings } =
        judge(&expected, &flat(2, |x, y| if (x, y) == (3, 4) { 0.51 } else { 0.5 }))
    else {
        panic!("the pixel is found")
    };
    assert!(findings[0].what.contains("pixel (3, 4) has no noise"), "{findings:?}");
}

#[test]
fn what_cannot_be_judged_is_said() {
    let of = |size, samples| picture(1, size, samples, 0.0, exponential, grey);
    let why = |judgement| match judgement {
        Judgement::Unknown { why } => why,
        other => panic!("{other:?}"),
    };
    assert!(why(judge(&of([8, 8], 32), &of([16, 8], 32))).contains("16x8, expected 8x8"));
    assert!(why(judge(&of([8, 8], 32), &of([8, 8], 64))).contains("64 samples a pixel, expected 32"));
    assert!(why(judge(&of([48, 32], 8), &of([48, 32], 8))).contains("too few"));
    let other = Measured { look: "filmic".to_owned(), ..of([8, 8], 32) };
    assert!(why(judge(&of([8, 8], 32), &other)).contains("developed by filmic"));
}

/// 32 samples are enough for any picture, 64 for its smallest regions.
#[test]
fn sizes_of_regions() {
    let of = |width, height, samples| Measured {
        width,
        height,
        samples,
        brightest: BRIGHTEST,
        look: String::new(),
        rgb: Vec::new(),
        variance: Vec::new(),
        batches: Vec::new(),
    };
    let sides = |m: &Measured| scales(m).iter().map(|scale| scale.side).collect::<Vec<_>>();
    assert_eq!(sides(&of(48, 32, 32)), [1, 2, 4, 8]);
    assert_eq!(sides(&of(48, 32, 64)), [1, 2, 4, 8]);
    assert!(sides(&of(1920, 1080, 32)).len() >= 4);
    assert_eq!(sides(&of(1920, 1080, MOST_BATCHES)).len(), 9);
    assert_eq!(sides(&of(1, 1, 32)), [1]);
    assert!(sides(&of(48, 32, 8)).is_empty());
    for scale in scales(&of(100, 50, 64)) {
        let regions: Vec<[u32; 4]> = scale.regions().map(|region| region.pixels(&of(100, 50, 64))).collect();
        assert_eq!(regions.iter().map(|r| u64::from(r[2]) * u64::from(r[3])).sum::<u64>(), 5000);
    }
}
