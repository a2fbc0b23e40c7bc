//! Where the sky is seen from, by place: through windows, doors ajar and holes in a roof.
//!
//! A background has no place on which points could be sampled, and from within a room nearly all directions end at its
//! walls: rays by chance find a window as often as it is wide. Rays of a few paths ahead of all others tell in which
//! directions it lies ([`Seen`]); cells of an octree keep cones of these as those of photons are kept
//! ([`super::cells`]), and rays are aimed into them (`engine::stages::aim`). Under the open sky they are not: there
//! rays by chance do as well.

use super::cells::{Cells, Photon};
use crate::lanes::{ArrayF, Bits, Lanes};
use crate::math::V3;

type One = ArrayF<1>;

/// What rays from rough surfaces have found.
#[derive(Default)]
pub struct Seen {
    /// Where such rays started.
    pub asked: Vec<[f32; 3]>,
    /// Those of them that saw the sky, straight on or over mirrors and glass.
    pub found: Vec<Photon>,
    /// Of each path what these brought, and all its light but what the camera sees: the sums of their channels.
    pub brought: Vec<[f32; 2]>,
}

/// Where the sky has this share of the paths' squares, or more, as many rays are aimed as is worth their while; where
/// lamps make most of the noise it is not.
const WHOLE_SHARE: f64 = 0.3;
/// Of a path no more counts than this times the mean of all: what is met once in a thousand paths tells little.
const MOST_COUNTS: f64 = 16.0;

impl Seen {
    /// Adds what others have found.
    pub fn append(&mut self, mut other: Seen) {
        self.asked.append(&mut other.asked);
        self.found.append(&mut other.found);
        self.brought.append(&mut other.brought);
    }

    /// The chance that a ray is aimed, on average over where they start; where too little is found to tell cells apart,
    /// as if there were one.
    pub fn mean_chance(&self, seed: u32) -> f32 {
        let cells = self.cells(seed);
        let of = |&point: &[f32; 3]| cells.chance[cell_at(&cells, point)];
        let of_cells = self.asked.iter().map(of).sum::<f32>() / self.asked.len().max(1) as f32;
        let of_all = self.matters() * worth(self.found.len() as f64 / self.asked.len().max(1) as f64);
        of_cells.max(of_all as f32)
    }

    /// How much the sky's part of the noise is worth, from zero to one.
    fn matters(&self) -> f64 {
        let mean = self.brought.iter().map(|[_, all]| f64::from(*all)).sum::<f64>() / self.brought.len().max(1) as f64;
        let squares = |of: usize| -> f64 {
            self.brought.iter().map(|both| f64::from(both[of]).min(MOST_COUNTS * mean).powi(2)).sum()
        };
        let all = squares(1);
        if all > 0.0 { (squares(0) / (WHOLE_SHARE * all)).min(1.0) } else { 0.0 }
    }

    /// The cells; `seed` decides where their borders lie.
    pub fn cells(&self, seed: u32) -> Cells {
        let mut cells = Cells::new(seed, &self.found, 1.0);
        let mut counts = vec![[0u32; 2]; cells.chance.len()];
        self.asked.iter().for_each(|&point| counts[cell_at(&cells, point)][0] += 1);
        self.found.iter().for_each(|photon| counts[cell_at(&cells, photon.point)][1] += 1);
        let matters = self.matters();
        for (chance, [asked, found]) in cells.chance.iter_mut().zip(counts).skip(1) {
            *chance = (matters * worth(f64::from(found) / f64::from(asked.max(1)))) as f32;
        }
        cells.chance[0] = 0.0;
        cells
    }
}

/// The cell around a point.
fn cell_at(cells: &Cells, point: [f32; 3]) -> usize {
    let mut cell = [0];
    cells.find(V3::<One>::splat(point), One::first(1)).store(&mut cell);
    cell[0] as usize
}

/// The chance to aim where such a share of a cell's rays finds the sky by itself. One of them has a deviation of
/// sqrt((1 - f) / f) of what it brings on average, one that is aimed about one: from four times that on a ray is always
/// aimed, from twice none. Rays by chance are well distributed, and those aimed less so: in a doll's house whose rays
/// see the sky once in three times aimed ones took half as long again, for as much noise.
fn worth(found: f64) -> f64 {
    if found <= 0.0 {
        return 0.0;
    }
    ((((1.0 - found) / found).max(0.0).sqrt() - 2.0) / 2.0).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::guide::cells::FARTHEST;
    use crate::sampling::sampler::hash3;

    /// A room two wide: of 40,000 rays from everywhere in it this share sees the sky, along x, and brings so much of a
    /// path's light.
    fn seen(share: f32, of_light: f32) -> Seen {
        let number = |k: u32, c: u32| (hash3(5, k, c) >> 40) as f32 / (1u32 << 24) as f32;
        let mut seen = Seen::default();
        for k in 0..40_000 {
            let point = [0, 1, 2].map(|axis| 2.0 * number(k, axis) - 1.0);
            seen.asked.push(point);
            let sees = number(k, 3) < share;
            if sees {
                let origin = [point[0] + FARTHEST, point[1] + 0.1 * FARTHEST * number(k, 4), point[2]];
                seen.found.push(Photon { point, from: origin, origin, flux: 1.0 });
            }
            seen.brought.push([if sees { of_light } else { 0.0 }, 1.0]);
        }
        seen
    }

    /// The chance in the middle of the room.
    fn chance(seen: &Seen) -> f32 {
        let cells = seen.cells(3);
        cells.chance[cell_at(&cells, [0.0; 3])]
    }

    /// Where a seventeenth finds the sky the deviation is four times the mean, where a fifth does twice: the ends of
    /// the ramp.
    #[test]
    fn rays_are_aimed_through_windows_and_not_outdoors() {
        assert_eq!([0.0, 0.01, 1.0 / 17.0, 0.2, 0.5, 1.0].map(worth), [0.0, 1.0, 1.0, 0.0, 0.0, 0.0]);
        assert!((worth(0.1) - 0.5).abs() < 1e-12);
        assert_eq!(chance(&seen(0.03, 40.0)), 1.0);
        assert_eq!(chance(&seen(0.7, 1.0)), 0.0);
    }

    /// Its share of the squares is 0.03 x 2^2 of 1 here, two fifths of the whole share; sampled, and a cell's count.
    #[test]
    fn what_lamps_make_most_of_is_not_looked_for() {
        let chance = chance(&seen(0.03, 2.0));
        assert!((chance - 0.4).abs() < 0.02, "{chance}");
        assert_eq!(super::tests::chance(&seen(0.03, 0.0)), 0.0);
    }

    /// Places that no ray has told of.
    #[test]
    fn nothing_is_aimed_elsewhere() {
        let cells = seen(0.03, 1.0).cells(3);
        assert_eq!(cells.chance[0], 0.0);
        assert_eq!(Seen::default().cells(3).chance, [0.0]);
    }
}
