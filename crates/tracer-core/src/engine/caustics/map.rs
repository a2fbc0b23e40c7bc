//! A map: the photons that lie on diffuse surfaces, sorted into the cells of grids, one grid per radius.
//!
//! Each photon has a radius of its own, among a few: small where photons are dense, large where few have come, so that a focus is
//! sharp and what a ball reflects all over a room is smooth (the sample-point estimator of Breiman, Meisel and Purcell: Variable Kernel
//! Estimates of Multivariate Densities, 1977). A photon's flux counts once whatever its radius, so this moves light but does not
//! change its sum.
//!
//! A grid's cells are twice the radius wide, so what lies within the radius of a point is in eight cells, four pairs of neighbours
//! along x. 64 cells along each axis repeat for ever: no two cells of a point's eight are the same, and what lies in a copy far
//! away fails the test of distance.

use super::plan::{LEVELS, PairTable};
use crate::lanes::prefetch;
use crate::sampling::sampler::hash3;

/// Cells along an axis: the bits of a word.
const SIDE: u32 = 64;
/// Rows of cells along x.
const ROWS: usize = 64 * 64;
/// Added to a coordinate in cells, so that it is positive; cells beyond it on either side are one.
pub const OFFSET: f32 = 16384.0;

/// A photon where it was stored, in render space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Photon {
    /// The point.
    pub point: [f32; 3],
    /// Geometric normal on the side that it came from.
    pub normal: [f32; 3],
    /// Flux times the ratio of the cosines to the shading and to the geometric normal.
    pub flux: [f32; 3],
    /// Mirrors and glass on its way.
    pub events: u32,
    /// Its pair of light and caster.
    pub pair: u32,
}

/// Photons of one radius, sorted by cell.
pub struct Grid {
    /// 1 / (2 radius).
    pub inverse_cell: f32,
    /// 1 / radius^2.
    pub inverse_radius2: f32,
    /// A quarter of the radius.
    pub height: f32,
    /// Per row of cells along x: a bit per cell that holds photons.
    rows: Vec<u64>,
    /// Per row: a bit per cell that holds photons, or one of whose seven neighbours towards +x, +y, +z does.
    near: Vec<u64>,
    /// Per row: cells that hold photons in the rows before.
    before: Vec<u32>,
    /// Where each cell that holds photons starts, and the end.
    starts: Vec<u32>,
    /// Points, with room for one vector more.
    pub points: [Vec<f32>; 3],
    /// Geometric normals.
    pub normals: [Vec<f32>; 3],
    /// Flux over the norm of the kernel.
    pub flux: [Vec<f32>; 3],
    /// Mirrors and glass on the way.
    pub events: Vec<u32>,
}

/// Index of a row, from coordinates in cells.
#[inline(always)]
fn row(y: u32, z: u32) -> usize {
    ((z % SIDE) * SIDE + y % SIDE) as usize
}

/// Which cell a coordinate lies in; [`OFFSET`] is added.
fn along(x: f32, inverse_cell: f32) -> u32 {
    x.mul_add(inverse_cell, OFFSET).clamp(0.0, 2.0 * OFFSET) as u32
}

impl Grid {
    /// Sorts photons into cells; those of a cell keep their order.
    fn new(photons: &[&Photon], radius: f32) -> Grid {
        let inverse_cell = 0.5 / radius;
        // Row, then column, then order.
        let mut order: Vec<(u32, u32)> = photons
            .iter()
            .enumerate()
            .map(|(k, p)| {
                let [x, y, z] = p.point.map(|x| along(x, inverse_cell));
                (row(y, z) as u32 * SIDE + x % SIDE, k as u32)
            })
            .collect();
        order.sort_unstable();
        let mut rows = vec![0u64; ROWS];
        let mut starts = Vec::new();
        for (k, &(cell, _)) in order.iter().enumerate() {
            if k == 0 || order[k - 1].0 != cell {
                starts.push(k as u32);
                rows[(cell / SIDE) as usize] |= 1 << (cell % SIDE);
            }
        }
        starts.push(order.len() as u32);
        let mut near = vec![0u64; ROWS];
        for (k, near) in near.iter_mut().enumerate() {
            let (y, z) = (k as u32 % SIDE, k as u32 / SIDE);
            let any = rows[row(y, z)] | rows[row(y + 1, z)] | rows[row(y, z + 1)] | rows[row(y + 1, z + 1)];
            *near = any | any.rotate_right(1);
        }
        let mut count = 0;
        let before = rows
            .iter()
            .map(|row| {
                count += row.count_ones();
                count - row.count_ones()
            })
            .collect();
        // Epanechnikov's kernel on the disc: 2 / (pi r^2) (1 - d^2 / r^2).
        let norm = 2.0 * std::f32::consts::FRAC_1_PI / (radius * radius);
        let column = |of: &dyn Fn(&Photon) -> f32| {
            let mut column: Vec<f32> = order.iter().map(|&(_, k)| of(photons[k as usize])).collect();
            column.resize(column.len() + 32, 0.0);
            column
        };
        let mut events: Vec<u32> = order.iter().map(|&(_, k)| photons[k as usize].events).collect();
        events.resize(events.len() + 32, 0);
        Grid {
            inverse_cell,
            inverse_radius2: 1.0 / (radius * radius),
            height: 0.25 * radius,
            points: [0, 1, 2].map(|k| column(&|p| p.point[k])),
            normals: [0, 1, 2].map(|k| column(&|p| p.normal[k])),
            flux: [0, 1, 2].map(|k| column(&|p| p.flux[k] * norm)),
            events,
            rows,
            near,
            before,
            starts,
        }
    }

    /// Has the memory of a photon fetched, which will soon be asked for.
    #[inline(always)]
    pub fn prefetch(&self, photon: usize) {
        for columns in [&self.points, &self.normals, &self.flux] {
            for column in columns {
                prefetch(column, photon);
            }
        }
    }

    /// Whether there are photons in the cell (x, y, z) or its seven neighbours towards larger coordinates.
    #[inline(always)]
    pub fn is_near(&self, x: u32, y: u32, z: u32) -> bool {
        self.near[row(y, z)] >> (x % SIDE) & 1 == 1
    }

    /// The photons in cells (x, y, z) and (x + 1, y, z): first and end of two runs, the second one empty unless the first ends the row.
    #[inline(always)]
    pub fn pair_of_cells(&self, x: u32, y: u32, z: u32) -> [(u32, u32); 2] {
        let (row, x) = (row(y, z), x % SIDE);
        let (bits, before) = (self.rows[row], self.before[row]);
        let below = before + (bits & ((1 << x) - 1)).count_ones();
        let count = (bits >> x & 3).count_ones();
        // Where x is the last cell the next one is the row's first.
        let first = u32::from(x == SIDE - 1) & bits as u32 & 1;
        let start = |k: u32| self.starts[k as usize];
        [(start(below), start(below + count)), (start(before), start(before + first))]
    }
}

/// A map for some sample indices.
pub struct Map {
    /// Its number.
    pub number: u32,
    /// A grid per radius that occurs.
    pub grids: Vec<Grid>,
}

impl Map {
    /// Map `number` of these photons, among whose radii are those of `pairs` that they may have; `radii` are those of map 0, each half
    /// the one before.
    pub fn new(number: u32, photons: &[Photon], pairs: &PairTable, radii: &[f32; LEVELS]) -> Map {
        let shrunk = shrinking(number) as f32;
        let by_density = levels(number, photons, radii[LEVELS - 1] * shrunk);
        let level_of = |k: usize| {
            let pair = photons[k].pair as usize;
            by_density[k].clamp(pairs.coarsest[pair], pairs.finest[pair]) as usize
        };
        let mut grids = Vec::new();
        for (level, radius) in radii.iter().enumerate() {
            let of_level: Vec<&Photon> =
                photons.iter().enumerate().filter(|&(k, _)| level_of(k) == level).map(|(_, p)| p).collect();
            if !of_level.is_empty() {
                grids.push(Grid::new(&of_level, radius * shrunk));
            }
        }
        Map { number, grids }
    }
}

/// So many photons in a cell of twice the radius make the radius small enough.
const NEIGHBOURS: usize = 3;

/// The level of each photon's radius: the finest one whose cell around it holds [`NEIGHBOURS`], the cells being those of an octree whose
/// place changes from map to map, so that it does not show. `smallest` is the radius of the finest level.
fn levels(number: u32, photons: &[Photon], smallest: f32) -> Vec<u32> {
    let inverse_cell = 0.5 / f64::from(smallest);
    let shift = [0, 1, 2].map(|axis| (hash3(number, axis, 0x0c7_2ee) >> 44) as f64);
    let mut codes: Vec<(u64, u32)> = photons
        .iter()
        .enumerate()
        .map(|(k, photon)| {
            let mut code = 0;
            for (axis, (&x, shift)) in photon.point.iter().zip(shift).enumerate() {
                let cell = f64::from(x).mul_add(inverse_cell, shift + f64::from(1u32 << 19));
                code |= spread(cell.clamp(0.0, f64::from((1u32 << 21) - 1)) as u64) << axis;
            }
            (code, k as u32)
        })
        .collect();
    codes.sort_unstable();
    let mut levels = vec![0; photons.len()];
    let mut is_known = vec![false; photons.len()];
    for level in (0..LEVELS).rev() {
        let cell_of = |k: usize| codes[k].0 >> (3 * (LEVELS - 1 - level));
        let mut first = 0;
        for k in 1..=codes.len() {
            if k == codes.len() || cell_of(k) != cell_of(first) {
                if k - first >= NEIGHBOURS {
                    for &(_, photon) in &codes[first..k] {
                        if !std::mem::replace(&mut is_known[photon as usize], true) {
                            levels[photon as usize] = level as u32;
                        }
                    }
                }
                first = k;
            }
        }
    }
    levels
}

/// The lower 21 bits, two places between any two.
pub fn spread(x: u64) -> u64 {
    let x = x & 0x1f_ffff;
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

/// Maps that have the same radius.
const STEP: u32 = 4;

/// Radius of map `number` over that of map 0: r_j^2 = r_0^2 prod_{i = 1..j} (i + alpha) / (i + 1) with alpha = 2/3, j counting every fourth
/// map. No pixel has to remember anything (Knaus and Zwicker: Progressive Photon Mapping: A Probabilistic Approach, 2011).
fn shrinking(number: u32) -> f64 {
    const ALPHA: f64 = 2.0 / 3.0;
    let squared: f64 = (1..=number / STEP).map(|i| (f64::from(i) + ALPHA) / (f64::from(i) + 1.0)).product();
    squared.sqrt()
}

#[cfg(test)]
mod tests;
