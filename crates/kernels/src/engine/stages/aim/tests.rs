use super::*;
use crate::engine::guide::cells::{Cells, LEAST_CHANCE, Photon};
use crate::lanes::ArrayF;
use crate::sampling::blocks::{Block, ITEM_PIXELS, Item};

type One = ArrayF<1>;

/// Casters: two spheres whose cones overlap, one half below the horizon, one that the point is in, one very small and
/// one behind.
fn casters() -> SphereRows {
    let list: [([f32; 3], f32); 6] = [
        ([0.5, 0.3, 0.0], 0.2),
        ([1.0, 0.5, 0.2], 0.3),
        ([0.0, 0.05, 0.7], 0.25),
        ([0.0, 0.1, 0.0], 0.3),
        ([0.0, 0.9, 0.9], 0.03),
        ([0.2, -0.5, 0.1], 0.2),
    ];
    let mut rows = SphereRows::default();
    list.iter().for_each(|&(center, radius)| rows.push(center, radius, 1.0));
    rows
}

/// Without photons, and with some at the origin that come from two places, and as strong as one likes.
fn guide(flux: f32) -> Guide {
    let photons: Vec<Photon> = (0..60u32)
        .map(|k| {
            let at = |c: u32| (crate::sampling::sampler::hash3(7, k, c) >> 40) as f32 / (1u32 << 24) as f32 - 0.5;
            let middle = if k % 3 == 0 { [-0.5, 0.6, 0.1] } else { [0.6, 0.5, 0.4] };
            let from = std::array::from_fn(|axis| middle[axis] + 0.15 * at(axis as u32));
            Photon { point: [0.0; 3], from, origin: from, flux }
        })
        .collect();
    let cells = Cells::new(3, if flux > 0.0 { &photons } else { &[] }, 1.0);
    Guide { lights: Some(cells), sky: None, casters: casters() }
}

const UP: [f32; 3] = [0.0, 1.0, 0.0];

fn density_of(guide: &Guide, w: [f32; 3]) -> f64 {
    let mut out = [0.0];
    let from = From { p: V3::<One>::zero(), n: V3::splat(UP), shared: <One as Lanes>::first(0) };
    density(guide, from, V3::splat(w), <One as Lanes>::first(1)).store(&mut out);
    f64::from(out[0])
}

/// Directions over the sphere by equal areas: 400 heights and 800 turns; gives each to `f` with its solid angle.
fn over_directions(mut f: impl FnMut([f32; 3], f64)) {
    for i in 0..400 {
        for k in 0..800 {
            let (y, turn) = ((f64::from(i) + 0.5) / 200.0 - 1.0, std::f64::consts::TAU * (f64::from(k) + 0.5) / 800.0);
            let r = (1.0 - y * y).sqrt();
            let w = [r * libm::cos(turn), y, r * libm::sin(turn)].map(|x| x as f32);
            f(w, 4.0 * std::f64::consts::PI / 320_000.0);
        }
    }
}

/// Something is always aimed at here, so the density integrates to the chance to aim: the least without photons, all of
/// it where their light is strong. The cells of 4e-5 that a cone's border cuts are right or wrong by half at random.
/// Without photons: borders of some 6 in all, cells 0.006 wide, a thousand of them, and a density of 0.25 at most.
/// With: the sixteenth part of each cone's border weighs 0.9 / 8 over a solid angle of 0.01 at least, which is a
/// density of 12 in 8 cones of a circumference of 0.4 each, 530 cells.
#[test]
fn densities_integrate_to_the_chance_to_aim() {
    for (flux, expected, most, cut) in [(0.0, LEAST_CHANCE, 0.25, 1000.0), (1e6, 1.0, 12.0, 530.0)] {
        let guide = guide(flux);
        let mut sum = 0.0;
        over_directions(|w, area| sum += density_of(&guide, w) * area);
        let rounding = 4.0 * 0.5 * 4e-5 * most * f64::sqrt(cut) + 1e-4;
        assert!((sum - f64::from(expected)).abs() < rounding, "flux {flux}: {sum}, {rounding}");
    }
}

/// Members that all lie at one point: directions come with the density that is reckoned with, and count what the
/// balance heuristic says.
#[test]
fn directions_have_the_density_that_is_reckoned_with() {
    for flux in [0.0, 1e6] {
        let guide = guide(flux);
        let mut batch = Batch::new();
        let (mut area, mut squares, mut members) = (0.0, 0.0, 0.0);
        for sample in 0..512 {
            batch.items = vec![Item { block: Block::straight([1, 2]), quarter: 1, sample, resting: 0 }];
            batch.pixels.find(&batch.items);
            batch.paths.len = 0;
            batch.aimers.len = ITEM_PIXELS;
            for k in 0..ITEM_PIXELS {
                (0..3).for_each(|axis| batch.aimers.normal[axis][k] = UP[axis]);
                (0..3).for_each(|axis| batch.aimers.geometric[axis][k] = UP[axis]);
                (0..3).for_each(|axis| batch.aimers.weight[axis][k] = 1.0);
                batch.aimers.survival[k] = 1.0;
                batch.aimers.kind[k] = 0;
                batch.aimers.slot[k] = k as u32;
            }
            aim::<One>(None, &guide, 5, 0, &mut batch);
            members += ITEM_PIXELS as f64;
            for i in 0..batch.paths.len {
                let w = batch.paths.direction.each_ref().map(|column| column[i]);
                let a = density_of(&guide, w);
                let cos = f64::from(w[1]) / std::f64::consts::PI;
                assert!(a > 0.0 && cos > 0.0, "{w:?}: {a}");
                let counts = f64::from(batch.paths.throughput[0][i]) * f64::from(batch.paths.eta2[i]);
                assert!((counts - cos / (cos + a)).abs() < 1e-4, "{w:?}: {counts}");
                area += 1.0 / a;
                squares += 1.0 / (a * a);
            }
        }
        // The mean of 1/density over all members is the area that may be aimed at. Stratified points spread less than
        // independent ones, whose standard error this is.
        let (mean, variance) = (area / members, (squares / members - (area / members).powi(2)) / members);
        let mut expected = 0.0;
        over_directions(|w, area| expected += if density_of(&guide, w) > 0.0 && w[1] > 0.0 { area } else { 0.0 });
        let rounding = 4.0 * 0.5 * 4e-5 * 1500f64.sqrt();
        let allowed = 4.0 * variance.sqrt() + rounding;
        assert!((mean - expected).abs() < allowed, "flux {flux}: {mean} {expected} {allowed}");
    }
}

/// Photons tell of light from two places, boxes of 0.15 along each side. There are directions of these that no cone
/// holds, but hardly one that none is around.
#[test]
fn no_holes_in_images() {
    let guide = Guide { casters: SphereRows::default(), ..guide(1e6) };
    let (mut around, mut bare) = (0, 0);
    for k in 0..20_000u32 {
        let at = |c: u32| (crate::sampling::sampler::hash3(8, k, c) >> 40) as f32 / (1u32 << 24) as f32 - 0.5;
        let middle = if k % 2 == 0 { [-0.5, 0.6, 0.1] } else { [0.6, 0.5, 0.4] };
        let to: [f32; 3] = std::array::from_fn(|axis| middle[axis] + 0.15 * at(axis as u32));
        let length = (to[0] * to[0] + to[1] * to[1] + to[2] * to[2]).sqrt();
        let density = density_of(&guide, to.map(|x| x / length));
        bare += u32::from(density == 0.0);
        around += u32::from(density > 0.0 && density < 0.7);
    }
    assert!(bare < 10 && around > 50, "{around} have rays around cones only, {bare} none");
}

/// Most rays go where the photons came from.
#[test]
fn rays_go_where_light_comes_from() {
    let guide = guide(1e6);
    let (mut near, mut all) = (0.0, 0.0);
    over_directions(|w, area| {
        let a = density_of(&guide, w) * area;
        let towards = |p: [f32; 3]| {
            let length = (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt();
            (0..3).map(|axis| p[axis] / length * w[axis]).sum::<f32>() > 0.96
        };
        all += a;
        near += if towards([-0.5, 0.6, 0.1]) || towards([0.6, 0.5, 0.4]) { a } else { 0.0 };
    });
    assert!(near > (1.0 - f64::from(TO_CASTERS)) * 0.95 * all, "{near} of {all}");
}
