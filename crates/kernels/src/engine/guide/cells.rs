//! Where the light comes from, by place: the cells of an octree over the places that photons reached, each with spheres
//! in space. They hold the last mirrors and glass on the photons' ways or, where a cell sees it within narrower cones,
//! what the photons seem to come from, straight on by the length of their ways: over flat mirrors and through panes
//! that is the light's image, which is the same from all of the cell.

use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
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
/// Bits of a place along the octree's curve below those of a cell of the coarsest level.
const BELOW_COARSEST: u32 = 3 * (LEVELS - 1);
/// Spheres are made larger by this share, and by as much of the way to the next photon: the light reaches beyond the
/// photons that were sent.
const MARGIN: f32 = 0.3;
const TO_NEXT: f32 = 0.8;
/// No sphere of a cell has a smaller share of its rays, in shares of an equal part.
const LEAST_SHARE: f32 = 0.2;

/// Chance that a ray is aimed where there is nothing, or faint light only.
pub const LEAST_CHANCE: f32 = 0.1;
/// With s, the strength of light over mirrors and glass over what the lights send to the middle of a scene, the chance
/// is this times s / (s + 1), at most one: so rays are spent where the noise is. A ray from every vertex was twice as
/// many in a room of balls, for a fifth less error.
const STEEPNESS: f32 = 5.0;

/// From so far on in render units what is seen from all of a cell is in one direction: to a ten thousandth of a radian.
pub const FARTHEST: f32 = 1e5;

/// A photon: where it was stored, where it came from there, and the sum of its channels of flux.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Photon {
    /// The point.
    pub point: [f32; 3],
    /// The last mirror, glass or glossy surface before.
    pub from: [f32; 3],
    /// Where it seems to come from: the point, back along the direction by the length of the whole way, of which more
    /// than [`FARTHEST`] counts as that.
    pub origin: [f32; 3],
    /// Flux.
    pub flux: f32,
}

/// Spheres, with what share of the rays goes to each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SphereRows {
    /// Four numbers each: middle and squared radius.
    pub spheres: Vec<f32>,
    /// Share, up to a factor; zero: there is no sphere.
    pub weight: Vec<f32>,
}

impl SphereRows {
    /// Adds a sphere.
    pub fn push(&mut self, [x, y, z]: [f32; 3], radius: f32, weight: f32) {
        self.spheres.extend([x, y, z, radius * radius]);
        self.weight.push(weight);
    }

    /// Number of rows.
    #[inline(always)]
    pub fn count(&self) -> usize {
        self.weight.len()
    }

    /// Middle and squared radius of a sphere, for all lanes.
    #[inline(always)]
    pub fn splat<F: Lanes>(&self, k: usize) -> [F; 4] {
        let of = |number: usize| F::splat(self.spheres[4 * k + number]);
        [of(0), of(1), of(2), of(3)]
    }
}

/// The octree. A cell of any level is there where it holds [`ENOUGH`] photons. Cell 0 stands for places without one.
#[derive(Default)]
pub struct Cells {
    /// Where the cells' corner lies, in cells of the finest level.
    shift: [f32; 3],
    /// The cell that holds all others, in cells of its own size, and that size as a power of two of the finest cells';
    /// cell 1. Above the coarsest level cells have no spheres.
    root: [u32; 3],
    height: u32,
    /// Of each cell its eight children, x first; 0: there is none. Empty where there is no cell.
    children: Vec<u32>,
    /// [`SPHERES`] rows for each cell. Cell 0's have no weight.
    pub rows: SphereRows,
    /// Of each cell the irradiance over what the lights send to the middle of a scene, about.
    pub strength: Vec<f32>,
    /// Of each cell the chance that a ray is aimed from there.
    pub chance: Vec<f32>,
}

/// A cell that is being added: its place along the octree's curve, in cells of its level, and its number.
type Numbered = (u64, u32);

impl Cells {
    /// The cells of these photons; `seed` decides where their borders lie, `unit` is the flux per area of strength one.
    pub fn new(seed: u32, photons: &[Photon], unit: f32) -> Cells {
        let shift = [0, 1, 2].map(|axis| (hash3(seed, axis, 0x001d_17ec) >> (65 - BITS)) as f32 + MOST / 4.0);
        let mut cells = Cells { shift, ..Cells::default() };
        cells.add_bare();
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
        let coarsest: Vec<u64> = order
            .chunk_by(|a, b| a.0 >> BELOW_COARSEST == b.0 >> BELOW_COARSEST)
            .filter(|of_cell| of_cell.len() >= ENOUGH)
            .map(|of_cell| of_cell[0].0 >> BELOW_COARSEST)
            .collect();
        let Some(mut above) = cells.add_root(&coarsest) else { return cells };
        let mut looked_at: Vec<Photon> = Vec::with_capacity(LOOKED_AT);
        for level in 0..LEVELS {
            let finer = 3 * (LEVELS - 1 - level);
            let mut added = Vec::new();
            for of_cell in order.chunk_by(|a, b| a.0 >> finer == b.0 >> finer) {
                if of_cell.len() < ENOUGH {
                    continue;
                }
                let step = of_cell.len().div_ceil(LOOKED_AT);
                looked_at.clear();
                looked_at.extend(of_cell.iter().step_by(step).map(|&(_, k)| photons[k as usize]));
                let flux: f32 = of_cell.iter().map(|&(_, k)| photons[k as usize].flux).sum();
                let width = (1u32 << (LEVELS - 1 - level)) as f32 / FINEST;
                add_spheres(&mut looked_at, &mut cells.rows);
                added.push((of_cell[0].0 >> finer, cells.add(flux / (unit * width * width))));
            }
            cells.link(&above, &added);
            above = added;
        }
        cells
    }

    /// Adds the cells above the coarsest level that hold all of that level's; `None` where it has none. What is right
    /// above that level.
    fn add_root(&mut self, coarsest: &[u64]) -> Option<Vec<Numbered>> {
        let first = *coarsest.first()?;
        let is_alike = |up: u32| coarsest.iter().all(|cell| cell >> (3 * up) == first >> (3 * up));
        let up = (0..).find(|&up| is_alike(up))?;
        self.height = LEVELS - 1 + up;
        let root = first >> (3 * up);
        self.root = [0, 1, 2].map(|axis| gathered(root >> axis));
        let mut above = Vec::new();
        for up in (1..=up).rev() {
            let mut places: Vec<u64> = coarsest.iter().map(|cell| cell >> (3 * up)).collect();
            places.dedup();
            let added: Vec<Numbered> = places.into_iter().map(|place| (place, self.add_bare())).collect();
            self.link(&above, &added);
            above = added;
        }
        Some(above)
    }

    /// Adds a cell whose rows are there, and tells its number.
    fn add(&mut self, strength: f32) -> u32 {
        self.strength.push(strength);
        // Without end where next to nothing is sent to the middle of the scene.
        let often = if strength.is_finite() { strength * STEEPNESS / (strength + 1.0) } else { 1.0 };
        self.chance.push(often.clamp(LEAST_CHANCE, 1.0));
        self.children.resize(8 * self.strength.len(), 0);
        self.strength.len() as u32 - 1
    }

    /// Adds a cell without spheres.
    fn add_bare(&mut self) -> u32 {
        (0..SPHERES).for_each(|_| self.rows.push([0.0; 3], 0.0, 0.0));
        self.add(0.0)
    }

    /// Makes cells the children of those one level above, both along the curve.
    fn link(&mut self, above: &[Numbered], added: &[Numbered]) {
        let mut parents = above.iter();
        let mut parent = parents.next();
        for &(place, number) in added {
            while parent.is_some_and(|&(above, _)| above < place >> 3) {
                parent = parents.next();
            }
            if let Some(&(_, of)) = parent {
                self.children[8 * of as usize + (place & 7) as usize] = number;
            }
        }
    }

    /// The finest cells around points, in the lanes of the mask; elsewhere 0, as where there is none.
    #[inline(always)]
    pub fn find<F: Lanes>(&self, point: V3<F>, mask: F::M) -> F::U {
        let none = F::U::splat(0);
        if self.children.len() <= 8 {
            return none;
        }
        let place = |x: F, shift: f32| x.fma(F::splat(FINEST), F::splat(shift));
        let [x, y, z] = [place(point.0, self.shift[0]), place(point.1, self.shift[1]), place(point.2, self.shift[2])];
        let zero = F::splat(0.0);
        let (least, most) = (x.min(y).min(z), x.max(y).max(z));
        let mut on = mask & zero.le(least) & most.lt(F::splat(MOST)) & x.le(x) & y.le(y) & z.le(z);
        // The bits below the root's, the highest one first.
        let up = F::U::splat(1 << (32 - self.height));
        let whole = F::splat(1.0 / (1u32 << self.height) as f32);
        let mut bits = [none; 3];
        for ((bits, x), root) in bits.iter_mut().zip([x, y, z]).zip(self.root) {
            let x = F::select(on, x, zero);
            on = on & (x * whole).to_int().eq(F::U::splat(root));
            *bits = x.to_int() * up;
        }
        let mut cell = F::U::select(on, F::U::splat(1), none);
        for _ in 0..self.height {
            let [x, y, z] = bits;
            let octant = x.shr::<31>() + y.shr::<31>().shl::<1>() + z.shr::<31>().shl::<2>();
            bits = [x.shl::<1>(), y.shl::<1>(), z.shl::<1>()];
            let child = F::U::gather(&self.children, cell.shl::<3>() + octant);
            on = on & !child.eq(none);
            if !on.any() {
                break;
            }
            cell = F::U::select(on, child, cell);
        }
        cell
    }

    /// Coordinates in cells of the finest level.
    fn place(&self, point: [f32; 3]) -> Option<[u32; 3]> {
        let place = [0, 1, 2].map(|axis| point[axis].mul_add(FINEST, self.shift[axis]));
        place.iter().all(|x| (0.0..MOST).contains(x)).then(|| place.map(|x| x as u32))
    }
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

/// Every third of 21 bits, the inverse of [`spread`].
fn gathered(x: u64) -> u32 {
    (0..21).map(|k| ((x >> (3 * k)) as u32 & 1) << k).sum()
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
    #[inline(always)]
    fn whole(photons: &[Photon], of: impl Fn(&Photon) -> [f32; 3]) -> Cluster {
        let empty = Cluster { first: 0, end: photons.len(), low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };
        photons.iter().fold(empty, |cluster, photon| cluster.with(of(photon)))
    }

    fn middle(&self) -> [f32; 3] {
        [0, 1, 2].map(|axis| 0.5 * (self.low[axis] + self.high[axis]))
    }

    /// How wide the cones are that its photons see it in, squared, in all: as wide as that of one of them.
    fn width(&self, photons: &[Photon]) -> f32 {
        let size2 = 0.25 * distance2(self.low, self.high);
        let distance2 = photons.get(self.first).map_or(0.0, |photon| distance2(photon.point, self.middle()));
        (self.end - self.first) as f32 * (size2 / distance2).min(1.0)
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

/// Cones so many times as wide, squared, do not become narrower than others by being cut into [`SPHERES`].
const CLEARLY: f32 = 16.0;

/// Adds [`SPHERES`] rows for the photons of a cell, which are put in another order, and come from their origins then
/// where these are what rows are added for.
fn add_spheres(photons: &mut [Photon], rows: &mut SphereRows) {
    let met = Cluster::whole(photons, |photon| photon.from).width(photons);
    let seen = Cluster::whole(photons, |photon| photon.origin).width(photons);
    let clusters = if met <= seen {
        clusters_of(photons)
    } else {
        let mut others: Vec<Photon> = photons.iter().map(|photon| Photon { from: photon.origin, ..*photon }).collect();
        let of_origins = clusters_of(&mut others);
        let all = |clusters: &[Cluster], photons: &[Photon]| -> f32 {
            clusters.iter().map(|cluster| cluster.width(photons)).sum()
        };
        let of_casters = if met > CLEARLY * seen { Vec::new() } else { clusters_of(photons) };
        if of_casters.is_empty() || all(&of_origins, &others) < all(&of_casters, photons) {
            photons.copy_from_slice(&others);
            of_origins
        } else {
            of_casters
        }
    };
    let whole: f32 = photons.iter().map(|photon| photon.flux).sum();
    let least = LEAST_SHARE / SPHERES as f32;
    for cluster in &clusters {
        let center = cluster.middle();
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

/// At most [`SPHERES`] runs of photons, which are put in their order.
fn clusters_of(photons: &mut [Photon]) -> Vec<Cluster> {
    let mut clusters = vec![Cluster::whole(photons, |photon| photon.from)];
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
    clusters
}

fn distance2(a: [f32; 3], b: [f32; 3]) -> f32 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

/// The way from where a photon came from to where the nearest other one did.
fn to_next(from: [f32; 3], photons: &[Photon]) -> f32 {
    let others = photons.iter().map(|photon| distance2(photon.from, from)).filter(|&d| d > 0.0);
    let nearest = others.fold(f32::INFINITY, f32::min);
    if nearest.is_finite() { nearest.sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests;
