//! Where the light comes from, by place: the cells of an octree over the places that photons reached, each with spheres
//! in space that hold the last mirrors and glass on the photons' ways.

use crate::sampling::sampler::hash3;

/// Spheres of a cell.
pub const SPHERES: usize = 8;
/// A cell has so many photons at least.
const ENOUGH: usize = 24;
/// Of more photons than this in a cell every n-th is looked at.
const LOOKED_AT: usize = 48;
/// Levels of the octree; cells of the coarsest are four units of render space wide, where scenes are about one in size.
const LEVELS: u32 = 14;
/// Cells of the finest level in a unit.
const FINEST: f32 = (1u32 << (LEVELS - 1)) as f32 / 4.0;
/// Bits of a coordinate in cells of the finest level.
const BITS: u32 = 19;
/// Such coordinates are below this.
const MOST: f32 = (1u32 << BITS) as f32;
/// Spheres are made larger by this share, and by as much of the way to the next photon: the light reaches beyond the
/// photons that were sent.
const MARGIN: f32 = 0.3;
const TO_NEXT: f32 = 0.8;
/// No sphere of a cell has a smaller share of its rays, in shares of an equal part.
const LEAST_SHARE: f32 = 0.2;

/// A photon: where it was stored, where it came from there, and the sum of its channels of flux.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Photon {
    /// The point.
    pub point: [f32; 3],
    /// The last mirror, glass or glossy surface before.
    pub from: [f32; 3],
    /// Flux.
    pub flux: f32,
}

/// Spheres as columns, with what share of the rays goes to each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SphereRows {
    /// Middle.
    pub center: [Vec<f32>; 3],
    /// Squared radius.
    pub radius2: Vec<f32>,
    /// Share, up to a factor; zero: there is no sphere.
    pub weight: Vec<f32>,
    /// Irradiance of the cell over what the lights send to the middle of a scene, about.
    pub strength: Vec<f32>,
}

impl SphereRows {
    /// Adds a sphere.
    pub fn push(&mut self, center: [f32; 3], radius: f32, weight: f32) {
        for (column, x) in self.center.iter_mut().zip(center) {
            column.push(x);
        }
        self.radius2.push(radius * radius);
        self.weight.push(weight);
    }

    /// Number of rows.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.weight.len()
    }
}

/// A cell in the hash table; an empty place has the key 0.
#[derive(Clone, Copy, Debug, Default)]
struct Entry {
    key: u64,
    row: u32,
}

/// The octree. A cell of any level is there where it holds [`ENOUGH`] photons.
#[derive(Default)]
pub struct Cells {
    /// Where the cells' corner lies, in cells.
    shift: [f32; 3],
    /// A hash table, half full at most; empty where there is no cell.
    table: Vec<Entry>,
    /// [`SPHERES`] rows for each cell. The first cell's have no weight: it stands for places without a cell.
    pub rows: SphereRows,
}

impl Cells {
    /// The cells of these photons; `seed` decides where their borders lie, `unit` is the flux per area of strength one.
    pub fn new(seed: u32, photons: &[Photon], unit: f32) -> Cells {
        let shift = [0, 1, 2].map(|axis| (hash3(seed, axis, 0x001d_17ec) >> (65 - BITS)) as f32 + MOST / 4.0);
        let mut cells = Cells { shift, ..Cells::default() };
        (0..SPHERES).for_each(|_| cells.rows.push([0.0; 3], 0.0, 0.0));
        cells.rows.strength.resize(SPHERES, 0.0);
        // Along the octree's curve a cell of any level is a run.
        let mut order: Vec<(u64, u32)> = Vec::with_capacity(photons.len());
        for (photon, k) in photons.iter().zip(0..) {
            if let Some(place) = cells.place(photon.point)
                && photon.flux > 0.0
            {
                let [x, y, z] = place.map(|x| spread(u64::from(x)));
                order.push((x | y << 1 | z << 2, k));
            }
        }
        order.sort_unstable();
        let mut found = Vec::new();
        let mut looked_at: Vec<Photon> = Vec::with_capacity(LOOKED_AT);
        for level in 0..LEVELS {
            let finer = 3 * (LEVELS - 1 - level);
            for of_cell in order.chunk_by(|a, b| a.0 >> finer == b.0 >> finer) {
                if of_cell.len() < ENOUGH {
                    continue;
                }
                let step = of_cell.len().div_ceil(LOOKED_AT);
                looked_at.clear();
                looked_at.extend(of_cell.iter().step_by(step).map(|&(_, k)| photons[k as usize]));
                let Some(place) = cells.place(looked_at[0].point) else { continue };
                found.push(Entry { key: key_of(place, level), row: cells.rows.count() as u32 });
                let flux: f32 = of_cell.iter().map(|&(_, k)| photons[k as usize].flux).sum();
                let width = (1u32 << (LEVELS - 1 - level)) as f32 / FINEST;
                add_spheres(&mut looked_at, &mut cells.rows);
                cells.rows.strength.resize(cells.rows.weight.len(), flux / (unit * width * width));
            }
        }
        if !found.is_empty() {
            cells.table = vec![Entry::default(); (2 * found.len()).next_power_of_two()];
            for entry in found {
                let at = cells.position(entry.key);
                cells.table[at] = entry;
            }
        }
        cells
    }

    /// First row of the finest cell around a point; 0 where there is none.
    #[inline(always)]
    pub fn find(&self, point: [f32; 3]) -> u32 {
        let Some(place) = self.place(point) else { return 0 };
        if self.table.is_empty() {
            return 0;
        }
        // A cell is there only where all coarser ones are: the finest is found by halving.
        let (mut coarser, mut row, mut missing) = (0, 0, LEVELS);
        while coarser < missing {
            let level = (coarser + missing) / 2;
            let entry = self.table[self.position(key_of(place, level))];
            if entry.key == 0 {
                missing = level;
            } else {
                row = entry.row;
                coarser = level + 1;
            }
        }
        row
    }

    /// Coordinates in cells of the finest level.
    #[inline(always)]
    fn place(&self, point: [f32; 3]) -> Option<[u32; 3]> {
        let place = [0, 1, 2].map(|axis| point[axis].mul_add(FINEST, self.shift[axis]));
        place.iter().all(|x| (0.0..MOST).contains(x)).then(|| place.map(|x| x as u32))
    }

    /// Where in the table a key is, or would be.
    #[inline(always)]
    fn position(&self, key: u64) -> usize {
        let mask = self.table.len() - 1;
        let mut at = (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize & mask;
        while self.table[at].key != key && self.table[at].key != 0 {
            at = (at + 1) & mask;
        }
        at
    }
}

/// A number for a cell of a level, never 0.
#[inline(always)]
fn key_of(place: [u32; 3], level: u32) -> u64 {
    let [x, y, z] = place.map(|x| u64::from(x >> (LEVELS - 1 - level)));
    ((x << BITS | y) << BITS | z) << 4 | u64::from(level + 1)
}

/// The lower 21 bits, two places between any two.
fn spread(x: u64) -> u64 {
    let x = x & 0x1f_ffff;
    let x = (x | x << 32) & 0x001f_0000_0000_ffff;
    let x = (x | x << 16) & 0x001f_0000_ff00_00ff;
    let x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    let x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

/// A run of photons that get one sphere, and their bounds.
#[derive(Clone, Copy)]
struct Cluster {
    first: usize,
    end: usize,
    low: [f32; 3],
    high: [f32; 3],
}

impl Cluster {
    /// All of them.
    fn whole(photons: &[Photon]) -> Cluster {
        let empty = Cluster { first: 0, end: photons.len(), low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };
        photons.iter().fold(empty, |cluster, photon| cluster.with(photon.from))
    }

    /// Photons times squared size: about how many rays of its cone go astray.
    fn cost(&self) -> f32 {
        (self.end - self.first) as f32 * distance2(self.low, self.high)
    }

    /// Cuts it across its longest side, where both parts cost least.
    fn cut(&self, photons: &mut [Photon]) -> [Cluster; 2] {
        let size = |axis: usize| self.high[axis] - self.low[axis];
        let axis = (1..3).fold(0, |longest, axis| if size(axis) > size(longest) { axis } else { longest });
        let photons = &mut photons[self.first..self.end];
        photons.sort_unstable_by(|a, b| a.from[axis].total_cmp(&b.from[axis]));
        let empty =
            Cluster { first: self.first, end: self.first, low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };
        let mut right = [Cluster { first: self.end, end: self.end, ..empty }; LOOKED_AT + 1];
        for k in (0..photons.len()).rev() {
            right[k] = right[k + 1].with(photons[k].from);
            right[k].first = self.first + k;
        }
        let (mut left, mut best, mut least) = (empty, [*self, *self], f32::INFINITY);
        for (k, photon) in photons.iter().enumerate().take(photons.len() - 1) {
            left = left.with(photon.from);
            left.end = self.first + k + 1;
            let cost = left.cost() + right[k + 1].cost();
            if cost < least {
                (best, least) = ([left, right[k + 1]], cost);
            }
        }
        best
    }

    /// With one more point in its bounds.
    fn with(mut self, point: [f32; 3]) -> Cluster {
        for ((low, high), x) in self.low.iter_mut().zip(&mut self.high).zip(point) {
            *low = low.min(x);
            *high = high.max(x);
        }
        self
    }
}

/// Adds [`SPHERES`] rows for the photons of a cell.
fn add_spheres(photons: &mut [Photon], rows: &mut SphereRows) {
    let mut clusters = vec![Cluster::whole(photons)];
    while clusters.len() < SPHERES {
        let Some(worst) = (0..clusters.len()).max_by(|&a, &b| clusters[a].cost().total_cmp(&clusters[b].cost())) else {
            break;
        };
        if clusters[worst].end - clusters[worst].first < 2 || clusters[worst].cost() <= 0.0 {
            break;
        }
        let [a, b] = clusters[worst].cut(photons);
        clusters[worst] = a;
        clusters.push(b);
    }
    let whole: f32 = photons.iter().map(|photon| photon.flux).sum();
    let least = LEAST_SHARE / SPHERES as f32;
    for cluster in &clusters {
        let center = [0, 1, 2].map(|axis| 0.5 * (cluster.low[axis] + cluster.high[axis]));
        let own = &photons[cluster.first..cluster.end];
        let radius = own.iter().map(|photon| distance2(photon.from, center)).fold(0.0, f32::max).sqrt();
        // The way from the outermost photon to the next one.
        let next = own.iter().map(|photon| to_next(photon.from, photons)).sum::<f32>() / own.len() as f32;
        let flux: f32 = own.iter().map(|photon| photon.flux).sum();
        let share = if whole > 0.0 { (flux / whole).max(least) } else { least };
        rows.push(center, radius.mul_add(1.0 + MARGIN, TO_NEXT * next).max(1e-7), share);
    }
    (clusters.len()..SPHERES).for_each(|_| rows.push([0.0; 3], 0.0, 0.0));
}

fn distance2(a: [f32; 3], b: [f32; 3]) -> f32 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

/// The way from the origin of a photon to that of the nearest other one.
fn to_next(from: [f32; 3], photons: &[Photon]) -> f32 {
    let others = photons.iter().map(|photon| distance2(photon.from, from)).filter(|&d| d > 0.0);
    let nearest = others.fold(f32::INFINITY, f32::min);
    if nearest.is_finite() { nearest.sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests;
