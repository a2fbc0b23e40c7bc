//! Placements by a rule as matrices.

use super::placing::sides;
use glam::{DAffine3, DMat3, DVec3};
use scene_format::codes;
use scene_format::desc::PlacementPattern;
use scene_format::diagnostic::Spanned;
use scene_format::{Diagnostic, Diagnostics};
use std::collections::BTreeMap;
use tracer_mesh::placements::rotation;

/// A copy that is to keep its distance gets so many tries.
const TRIES: u64 = 32;
/// After so many copies in a row without room there is hardly any left: no more are tried, so that a full box does not
/// take for ever.
const MISSES: u32 = 256;

/// The maps of the copies. Copies of a `Scatter` that find no room are left out, with `W0311`.
pub fn maps(pattern: &Spanned<PlacementPattern>, diagnostics: &mut Diagnostics) -> Vec<DAffine3> {
    match &pattern.value {
        PlacementPattern::Grid { count, spacing } => grid(*count, DVec3::from(*spacing)),
        PlacementPattern::Ring { count, radius, axis, start, turn } => {
            let axis = DVec3::from(*axis);
            let [right, ..] = sides(axis);
            let copy = |k: u32| {
                let turned = rotation(axis, start + 360.0 * f64::from(k) / f64::from(*count));
                let matrix3 = if *turn { turned } else { DMat3::IDENTITY };
                DAffine3 { matrix3, translation: turned * (right * *radius) }
            };
            (0..*count).map(copy).collect()
        }
        PlacementPattern::Scatter { count, min, max, seed, spacing, turn, scale } => {
            let draw = |copy: u32, what: u64| random([u64::from(*seed), u64::from(copy), what]);
            let (min, max) = (DVec3::from(*min), DVec3::from(*max));
            let mut room = spacing.map(|spacing| Room::new(min.min(max), (max - min).abs(), spacing));
            let mut maps = Vec::new();
            let mut misses = 0;
            for copy in 0..*count {
                let place = |attempt: u64| {
                    let share = [2, 3, 4].map(|axis| draw(copy, axis + 3 * attempt));
                    min + (max - min) * DVec3::from(share)
                };
                let found = match &mut room {
                    None => Some(place(0)),
                    Some(room) => (0..TRIES).map(place).find(|p| room.take(*p)),
                };
                let Some(translation) = found else {
                    misses += 1;
                    if misses == MISSES {
                        break;
                    }
                    continue;
                };
                misses = 0;
                let turned = turn.map_or(DMat3::IDENTITY, |axis| rotation(DVec3::from(axis), 360.0 * draw(copy, 0)));
                let factor = scale[0] + (scale[1] - scale[0]) * draw(copy, 1);
                maps.push(DAffine3 { matrix3: turned * factor, translation });
            }
            if maps.len() < *count as usize {
                let message = format!("there was room for {} of {count} copies only", maps.len());
                let fault = Diagnostic::warning(codes::FEWER_COPIES, pattern.span, message);
                diagnostics.push(fault.hint("make the box larger, or `spacing` or `count` smaller"));
            }
            maps
        }
    }
}

/// Rows and columns about the origin, x first.
fn grid(count: [u32; 3], spacing: DVec3) -> Vec<DAffine3> {
    let at = |k: u32, count: u32| f64::from(k) - 0.5 * f64::from(count - 1);
    let [x, y, z] = count;
    let row =
        |k, j| (0..x).map(move |i| DAffine3::from_translation(spacing * DVec3::new(at(i, x), at(j, y), at(k, z))));
    (0..z).flat_map(|k| (0..y).flat_map(move |j| row(k, j))).collect()
}

/// A number from 0 to 1, below 1: a hash (SplitMix64, Steele et al. 2014).
fn random(numbers: [u64; 3]) -> f64 {
    let mut state = 0u64;
    for number in numbers {
        state = (state ^ number).wrapping_add(0x9e37_79b9_7f4a_7c15);
        state = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        state = (state ^ (state >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        state ^= state >> 31;
    }
    (state >> 11) as f64 / (1u64 << 53) as f64
}

/// What is taken of a box by points that keep their distance.
struct Room {
    low: DVec3,
    spacing: f64,
    /// The side of a cell: at least the distance, so that only neighbours matter, and not so small that cells could not
    /// be counted.
    cell: f64,
    /// The last point of each cell, and of each point the one before it in its cell.
    last: BTreeMap<[i64; 3], u32>,
    points: Vec<(DVec3, u32)>,
}

/// No point.
const NONE: u32 = u32::MAX;

impl Room {
    fn new(low: DVec3, extent: DVec3, spacing: f64) -> Room {
        let cell = spacing.max(extent.max_element() / f64::from(1 << 20));
        Room { low, spacing, cell, last: BTreeMap::new(), points: Vec::new() }
    }

    /// Takes the place of a point if it is free.
    fn take(&mut self, p: DVec3) -> bool {
        let cell = ((p - self.low) / self.cell).to_array().map(|x| x.floor() as i64);
        let around = |k: i64| [cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1];
        for near in (0..27).map(around) {
            let mut next = self.last.get(&near).copied().unwrap_or(NONE);
            while next != NONE {
                let (other, before) = self.points[next as usize];
                if (other - p).length() < self.spacing {
                    return false;
                }
                next = before;
            }
        }
        let before = self.last.insert(cell, self.points.len() as u32).unwrap_or(NONE);
        self.points.push((p, before));
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(pattern: PlacementPattern) -> (Vec<DAffine3>, usize) {
        let mut diagnostics = Diagnostics::default();
        let maps = maps(&pattern.into(), &mut diagnostics);
        (maps, diagnostics.len())
    }

    fn scatter(count: u32, max: [f64; 3], spacing: Option<f64>) -> PlacementPattern {
        let turn = Some([0.0, 2.0, 0.0]);
        PlacementPattern::Scatter { count, min: [0.0; 3], max, seed: 7, spacing, turn, scale: [0.5, 1.5] }
    }

    #[test]
    fn grids_are_centred_and_count_along_x_first() {
        let (maps, _) = of(PlacementPattern::Grid { count: [3, 1, 2], spacing: [2.0, 9.0, 1.0] });
        let places: Vec<[f64; 3]> = maps.iter().map(|map| map.translation.to_array()).collect();
        let row = |z: f64| [[-2.0, 0.0, z], [0.0, 0.0, z], [2.0, 0.0, z]];
        assert_eq!(places, [row(-0.5), row(0.5)].concat());
        assert!(maps.iter().all(|map| map.matrix3 == DMat3::IDENTITY));
    }

    #[test]
    fn rings_go_round_their_axis_and_turn_what_stands_on_them() {
        for (turn, axis) in [(true, [0.0, 3.0, 0.0]), (false, [0.0, 3.0, 0.0]), (true, [1.0, 2.0, -0.5])] {
            let (maps, _) = of(PlacementPattern::Ring { count: 8, radius: 2.0, axis, start: 30.0, turn });
            assert_eq!(maps.len(), 8);
            let [right, up, normal] = sides(DVec3::from(axis));
            for (k, map) in (0..).zip(&maps) {
                let (sin, cos) = (30.0 + 45.0 * f64::from(k)).to_radians().sin_cos();
                assert!((map.translation - 2.0 * (right * cos + up * sin)).length() < 1e-14, "{map:?}");
                let outward = if turn { map.translation / 2.0 } else { right };
                assert!((map.matrix3 * right - outward).length() < 1e-14);
                let stays = if turn { normal } else { up };
                assert!((map.matrix3 * stays - stays).length() < 1e-14);
            }
        }
    }

    #[test]
    fn scattered_copies_are_spread_evenly() {
        let count = 8000;
        let (maps, warnings) = of(scatter(count, [4.0, 0.0, -2.0], None));
        assert_eq!((maps.len(), warnings), (count as usize, 0));
        // Chi-square over 8 x 8 x 4 classes of x, z, and size, which are independent: 255 degrees of freedom, 5
        // standard deviations.
        let mut classes = [0u32; 256];
        for map in &maps {
            let (p, factor) = (map.translation, map.matrix3.y_axis.y);
            assert!(p.y == 0.0 && (0.5..1.5).contains(&factor) && map.matrix3.y_axis.x == 0.0);
            assert!((map.matrix3.x_axis.length() - factor).abs() < 1e-14);
            let class = |share: f64, count: f64| (share * count) as usize;
            classes[class(p.x / 4.0, 8.0) + 8 * class(p.z / -2.0, 8.0) + 64 * class(factor - 0.5, 4.0)] += 1;
        }
        let mean = f64::from(count) / 256.0;
        let chi_square: f64 = classes.iter().map(|&n| (f64::from(n) - mean).powi(2) / mean).sum();
        assert!((chi_square - 255.0).abs() < 5.0 * 510f64.sqrt(), "{chi_square}");
        assert_ne!(maps[0].matrix3.x_axis.normalize(), maps[1].matrix3.x_axis.normalize());
    }

    #[test]
    fn scattered_copies_keep_their_distance() {
        let (maps, warnings) = of(scatter(400, [4.0, 1.0, 4.0], Some(0.25)));
        assert_eq!((maps.len(), warnings), (400, 0));
        for (k, a) in maps.iter().enumerate() {
            assert!(maps[..k].iter().all(|b| a.translation.distance(b.translation) >= 0.25));
        }
    }

    /// Where there is no room it is said, and soon.
    #[test]
    fn a_full_box_ends() {
        let (maps, warnings) = of(scatter(10_000_000, [1.0, 0.0, 1.0], Some(0.5)));
        assert!((4..=9).contains(&maps.len()) && warnings == 1, "{}", maps.len());
        assert_eq!(of(scatter(10_000_000, [0.0; 3], Some(1e-6))).0.len(), 1);
        assert_eq!(of(scatter(2000, [1e12, 0.0, 0.0], Some(1e-6))).0.len(), 2000);
    }
}
