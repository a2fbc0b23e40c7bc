use super::*;
use crate::engine::batch::Batch;
use crate::engine::stages::gather::gather;
use crate::lanes::ArrayF;
use crate::sampling::sampler::hash3;

/// A number in 0 .. 1.
fn random(k: usize, what: u32) -> f32 {
    (hash3(k as u32, what, 1) >> 40) as f32 / (1u32 << 24) as f32
}

/// Photons on the plane z = 0, some far away, some turned over, some after many events.
fn photons(count: usize, spread: f32) -> Vec<Photon> {
    (0..count)
        .map(|k| Photon {
            point: [spread * (random(k, 0) - 0.5), spread * (random(k, 1) - 0.5), 0.0],
            normal: [0.0, 0.0, if k % 11 == 0 { -1.0 } else { 1.0 }],
            flux: [random(k, 2), 1.0, 0.0],
            events: 1 + k as u32 % 4,
            pair: k as u32 % 2,
        })
        .collect()
}

/// What a query at a point of the plane gathers over all grids.
fn gathered(map: &Map, point: [f32; 3], most_events: u32) -> [f32; 3] {
    let mut batch = Batch::new();
    batch.queries.len = 1;
    for axis in 0..3 {
        batch.queries.point[axis][0] = point[axis];
        batch.queries.normal[axis][0] = [0.0, 0.0, 1.0][axis];
        batch.queries.value[axis][0] = 1.0;
    }
    gather::<ArrayF<1>>(map, most_events, &mut batch);
    [0, 1, 2].map(|channel| batch.radiance[channel][0])
}

const RADII: [f32; 2] = [0.02, 0.01];

/// Each photon within the radius counts once, wherever it lies, also far beyond the 64 cells after which the grid repeats.
#[test]
fn grids_hold_what_lies_around_a_point() {
    for spread in [0.1, 3.0, 40.0] {
        let photons = photons(3000, spread);
        let of_radius = |radius: f32| {
            let level: Vec<&Photon> = photons.iter().filter(|p| (p.pair == 0) == (radius == RADII[0])).collect();
            Grid::new(&level, radius)
        };
        let map = Map { number: 0, grids: RADII.map(of_radius).into() };
        for k in 0..200 {
            // On a photon, so that something is there.
            let point = photons[k * 7].point;
            let found = gathered(&map, point, 3);
            let mut expected = [0.0f64; 3];
            for photon in photons.iter().filter(|p| p.normal[2] > 0.0 && p.events <= 3) {
                let radius = f64::from(RADII[photon.pair as usize]);
                let to = [0, 1].map(|a| f64::from(photon.point[a] - point[a]));
                let weight = 1.0 - (to[0] * to[0] + to[1] * to[1]) / (radius * radius);
                for (sum, flux) in expected.iter_mut().zip(photon.flux) {
                    *sum += 2.0 / (std::f64::consts::PI * radius * radius) * weight.max(0.0) * f64::from(flux);
                }
            }
            for (a, b) in found.iter().zip(expected) {
                // Positions of single precision, some 2^-22 of 40, against a radius of 0.01.
                assert!((f64::from(*a) - b).abs() <= 2e-3 * b.max(1.0), "{spread} {k}: {found:?} {expected:?}");
            }
        }
    }
}

/// The product telescopes into gamma functions, so r_j^2 falls as j^(alpha - 1): from step 100 to step 800 to a half.
#[test]
fn radii_shrink_as_a_power() {
    assert_eq!([shrinking(0), shrinking(STEP - 1)], [1.0; 2]);
    let ratio = (shrinking(800 * STEP) / shrinking(100 * STEP)).powi(2);
    assert!((ratio - 0.5).abs() < 2e-3, "{ratio}");
}

/// Among 400 photons on a unit square a cell of side 1/12 holds three, so radii are near 1/24; a cluster a hundred times denser has radii ten
/// times smaller, and a photon alone the largest.
#[test]
fn radii_follow_the_density() {
    let mut photons = photons(400, 1.0);
    photons.extend(
        photons.clone().iter().map(|p| Photon { point: [3.0 + 0.1 * p.point[0], 0.1 * p.point[1], 0.0], ..*p }),
    );
    photons.push(Photon { point: [-5.0, 0.0, 0.0], ..Photon::default() });
    let smallest = 1.0 / 4096.0;
    let levels = levels(0, &photons, smallest);
    let radius = |level: u32| f64::from(smallest) * f64::from(1u32 << (LEVELS as u32 - 1 - level));
    let mean = |range: std::ops::Range<usize>| {
        let count = range.len() as f64;
        range.map(|k| libm::log2(radius(levels[k]))).sum::<f64>() / count
    };
    let (wide, dense) = (mean(0..400), mean(400..800));
    assert!((-5.2..-3.7).contains(&wide), "2^{wide}");
    // log2(10) = 3.3; radii are powers of two.
    assert!((2.8..3.8).contains(&(wide - dense)), "2^{wide} 2^{dense}");
    assert_eq!(levels[800], 0);
}
