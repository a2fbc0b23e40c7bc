use super::*;
use crate::lanes::ArrayF;
use std::collections::{BTreeMap, BTreeSet};

/// Photons on a floor, half of it lit from each of two places, and one photon from a third.
fn photons() -> Vec<Photon> {
    let number = |k: u32, c: u32| (hash3(5, k, c) >> 40) as f32 / (1u32 << 24) as f32;
    let mut photons: Vec<Photon> = (0..20_000)
        .map(|k| {
            let x = number(k, 0) - 0.5;
            let from = if x < 0.0 { [-0.4, 0.3, 0.0] } else { [0.4, 0.3, 0.0] };
            let from = [0, 1, 2].map(|axis| from[axis] + 0.02 * (number(k, 2 + axis as u32) - 0.5));
            Photon { point: [x, 0.0, number(k, 1) - 0.5], from, origin: from, flux: 1.0 }
        })
        .collect();
    let from = [0.0, 0.9, 0.0];
    photons.push(Photon { point: [0.25, 0.0, 0.25], from, origin: from, flux: 1.0 });
    photons
}

type One = ArrayF<1>;

/// Where lamps send next to nothing to the middle of the scene, what arrives elsewhere is strong without end: rays are
/// always aimed there.
#[test]
fn chances_are_numbers() {
    for unit in [0.0, 1e-38, 1e38] {
        let cells = Cells::new(3, &photons(), unit);
        assert!(cells.chance.iter().all(|chance| (LEAST_CHANCE..=1.0).contains(chance)), "{unit}");
    }
    let cells = Cells::new(3, &photons(), 0.0);
    assert_eq!(cells.chance[found(&cells, [0.25, 0.0, 0.25]) as usize], 1.0);
}

/// Through a pane the whole floor sees the sun in one direction, whatever part of the pane it is seen through: the
/// cones are as narrow as the sun, where those around the pieces of the pane were as wide as the cells.
#[test]
fn flat_glass_shows_the_light_itself() {
    let number = |k: u32, c: u32| (hash3(7, k, c) >> 40) as f32 / (1u32 << 24) as f32;
    let (far, size) = (FARTHEST, 0.00465 * FARTHEST);
    let photon = |k: u32| {
        let point = [number(k, 0) - 0.5, 0.0, number(k, 1) - 0.5];
        let origin = [size * (2.0 * number(k, 2) - 1.0), 0.8 * far, 0.6 * far];
        // On a pane half a unit above.
        let from = [0, 1, 2].map(|axis| point[axis] + (origin[axis] - point[axis]) * 0.5 / (0.8 * far));
        Photon { point, from, origin, flux: 1.0 }
    };
    let cells = Cells::new(3, &(0..4000).map(photon).collect::<Vec<_>>(), 1.0);
    for x in [-0.4, 0.1, 0.3] {
        let found = spheres(&cells, [x, 0.0, x]);
        assert!(!found.is_empty());
        for (center, radius, _) in found {
            let distance = distance2(center, [x, 0.0, x]).sqrt();
            assert!(radius / distance < 0.01, "{x}: {center:?} {radius}");
            assert!((center[1] / distance - 0.8).abs() < 0.01);
        }
    }
}

/// The number of the finest cell around a point.
fn found(cells: &Cells, point: [f32; 3]) -> u32 {
    let mut out = [0];
    cells.find(V3::<One>::splat(point), One::first(1)).store(&mut out);
    out[0]
}

fn spheres(cells: &Cells, point: [f32; 3]) -> Vec<([f32; 3], f32, f32)> {
    let (first, rows) = (found(cells, point) as usize * SPHERES, &cells.rows);
    let sphere = |k: usize| (center(rows, k), rows.spheres[4 * k + 3].sqrt(), rows.weight[k]);
    (first..first + SPHERES).map(sphere).filter(|s| s.2 > 0.0).collect()
}

fn center(rows: &SphereRows, k: usize) -> [f32; 3] {
    [0, 1, 2].map(|axis| rows.spheres[4 * k + axis])
}

/// What a place is lit from is in its spheres: every photon of its cell came from within one.
#[test]
fn spheres_hold_where_light_comes_from() {
    let cells = Cells::new(1, &photons(), 1.0);
    for (x, from) in [(-0.3, [-0.4, 0.3, 0.0]), (0.3, [0.4, 0.3, 0.0])] {
        let found = spheres(&cells, [x, 0.0, 0.1]);
        assert!(!found.is_empty());
        for (center, radius, _) in found {
            assert!(distance2(center, from).sqrt() < 0.03 && radius < 0.04, "{x}: {center:?} {radius}");
        }
    }
    let mut looked_at: Vec<Photon> = photons().into_iter().step_by(420).collect();
    let mut rows = SphereRows::default();
    add_spheres(&mut looked_at, &mut rows);
    assert_eq!(rows.count(), SPHERES);
    for photon in looked_at {
        let holds = |k: usize| distance2(center(&rows, k), photon.from) <= rows.spheres[4 * k + 3];
        assert!((0..SPHERES).any(holds), "{photon:?}");
    }
}

/// The finest cell that has enough photons is found, and by nobody else; where there is none, no sphere. Wherever the
/// borders lie: with some seeds the coarsest cells have only a far coarser one in common.
#[test]
fn the_finest_cells_are_found() {
    let photons = photons();
    let mut heights = BTreeSet::new();
    for seed in 0..200 {
        let cells = Cells::new(seed, &photons, 1.0);
        heights.insert(cells.height);
        // Above the coarsest level cells have nothing.
        assert_eq!(cells.strength[found(&cells, [100.0, 0.0, 0.0]) as usize], 0.0);
        assert_eq!(found(&cells, [f32::NAN, 0.0, 0.0]), 0);
        assert_eq!(found(&cells, [1e9, 0.0, 0.0]), 0);
        assert_eq!(found(&Cells::new(seed, &[], 1.0), [0.0; 3]), 0);
        assert!(spheres(&cells, [100.0, 0.0, 0.0]).is_empty());
        if seed % 20 != 0 {
            continue;
        }
        let places: Vec<[u32; 3]> =
            photons.iter().map(|photon| cells.place(photon.point).expect("in the octree")).collect();
        let mut of_cell: BTreeMap<u32, (u32, [u32; 3])> = BTreeMap::new();
        for (photon, place) in photons.iter().zip(&places).step_by(37) {
            let in_cell =
                |level: u32, other: &&[u32; 3]| (0..3).all(|k| (other[k] ^ place[k]) >> (LEVELS - 1 - level) == 0);
            let is_there = |level: &u32| places.iter().filter(|other| in_cell(*level, other)).count() >= ENOUGH;
            let finest = (0..LEVELS).take_while(is_there).last().expect("the coarsest cells hold enough");
            let cell = (finest, place.map(|x| x >> (LEVELS - 1 - finest)));
            let number = found(&cells, photon.point);
            assert!(number > 0 && *of_cell.entry(number).or_insert(cell) == cell, "{number}: {cell:?}");
            assert!(cells.strength[number as usize] > 0.0);
        }
        let different: BTreeSet<_> = of_cell.values().collect();
        assert_eq!(different.len(), of_cell.len(), "two numbers of one cell");
    }
    assert!(heights.len() > 2, "{heights:?}");
}

/// A cell's strength is its flux over its width squared and the unit: that of a floor of 20000 photons in a unit
/// square, where the finest cells lie by chance on either side of one that is full.
#[test]
fn strength_is_irradiance() {
    let cells = Cells::new(1, &photons(), 20_000.0);
    let strength = |x: f32| f64::from(cells.strength[found(&cells, [x, 0.0, 0.1]) as usize]);
    let mean = (0..40).map(|k| strength(-0.45 + 0.02 * k as f32)).sum::<f64>() / 40.0;
    assert!((0.5..2.0).contains(&mean), "{mean}");
}

/// Lanes side by side find what each finds alone: in cells of all levels, in none, and outside of all.
#[test]
fn lanes_find_what_each_finds_alone() {
    type Eight = ArrayF<8>;
    let photons = photons();
    for seed in [1, 60, 140] {
        let cells = Cells::new(seed, &photons, 1.0);
        for k in 0..500u32 {
            let number =
                |lane: usize, axis: u32| (hash3(9, 8 * k + lane as u32, axis) >> 40) as f32 / (1u32 << 24) as f32;
            let points: [[f32; 3]; 8] = std::array::from_fn(|lane| {
                let far = [1.0, 1.0, 1.0, 3.0, 200.0, 1e7, 1.0, 1.0][lane];
                [0, 1, 2].map(|axis| far * (number(lane, axis) - 0.5) * if axis == 1 { 0.01 } else { 1.0 })
            });
            let column = |axis: usize| Eight::load(&points.map(|point| point[axis]));
            let mut out = [0; 8];
            cells.find(V3(column(0), column(1), column(2)), Eight::first(7)).store(&mut out);
            let alone: [u32; 8] = std::array::from_fn(|lane| if lane < 7 { found(&cells, points[lane]) } else { 0 });
            assert_eq!(out, alone, "{points:?}");
        }
    }
}
