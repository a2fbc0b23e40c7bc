use super::*;

/// Photons on a floor, half of it lit from each of two places, and one photon from a third.
fn photons() -> Vec<Photon> {
    let number = |k: u32, c: u32| (hash3(5, k, c) >> 40) as f32 / (1u32 << 24) as f32;
    let mut photons: Vec<Photon> = (0..20_000)
        .map(|k| {
            let x = number(k, 0) - 0.5;
            let from = if x < 0.0 { [-0.4, 0.3, 0.0] } else { [0.4, 0.3, 0.0] };
            let from = [0, 1, 2].map(|axis| from[axis] + 0.02 * (number(k, 2 + axis as u32) - 0.5));
            Photon { point: [x, 0.0, number(k, 1) - 0.5], from, flux: 1.0 }
        })
        .collect();
    photons.push(Photon { point: [0.25, 0.0, 0.25], from: [0.0, 0.9, 0.0], flux: 1.0 });
    photons
}

fn spheres(cells: &Cells, point: [f32; 3]) -> Vec<([f32; 3], f32, f32)> {
    let (first, rows) = (cells.find(point) as usize, &cells.rows);
    let sphere = |k: usize| (rows.center.each_ref().map(|c| c[k]), rows.radius2[k].sqrt(), rows.weight[k]);
    (first..first + SPHERES).map(sphere).filter(|s| s.2 > 0.0).collect()
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
        let holds = |k: usize| distance2(rows.center.each_ref().map(|c| c[k]), photon.from) <= rows.radius2[k];
        assert!((0..SPHERES).any(holds), "{photon:?}");
    }
}

/// The finest cell is found; where there is none, no sphere; a rare way is in some cell's spheres.
#[test]
fn cells_are_found_by_halving() {
    let photons = photons();
    let cells = Cells::new(1, &photons, 1.0);
    assert_eq!(cells.find([100.0, 0.0, 0.0]), 0);
    assert_eq!(Cells::new(1, &[], 1.0).find([0.0; 3]), 0);
    assert!(spheres(&cells, [100.0, 0.0, 0.0]).is_empty());
    for photon in photons.iter().step_by(37) {
        let place = cells.place(photon.point).expect("in the octree");
        let there = |level: &u32| cells.table[cells.position(key_of(place, *level))].key != 0;
        let finest = (0..LEVELS).take_while(there).last().expect("the coarsest cell holds all");
        assert!((finest + 1..LEVELS).all(|level| !there(&level)), "a cell without the coarser ones around it");
        assert_eq!(cells.find(photon.point), cells.table[cells.position(key_of(place, finest))].row);
    }
}

/// A cell's strength is its flux over its width squared and the unit: that of a floor of 20000 photons in a unit
/// square, where the finest cells lie by chance on either side of one that is full.
#[test]
fn strength_is_irradiance() {
    let cells = Cells::new(1, &photons(), 20_000.0);
    let strength = |x: f32| f64::from(cells.rows.strength[cells.find([x, 0.0, 0.1]) as usize]);
    let mean = (0..40).map(|k| strength(-0.45 + 0.02 * k as f32)).sum::<f64>() / 40.0;
    assert!((0.5..2.0).contains(&mean), "{mean}");
}
