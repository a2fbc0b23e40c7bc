//! The indirect map: what light comes to second vertices over further surfaces, as means over cells (`render.indirect: Map`).
//!
//! A pixel's second vertices lie all over the scene. What light reaches them over three vertices and more may be known roughly, if only
//! its mean is right: edges, textures and shadows that are seen come from the first vertex, and light samples at the second are taken as
//! ever. So for each sample index some thousand paths from the camera, over the whole picture, note at their second diffuse vertex the
//! indirect light that arrives there: a [`Record`]. Records are sorted into the cells of an octree, told apart by the vertex's number and
//! the side that the surface faces. A second vertex takes the mean of the finest cell around it that is known, and its path ends.
//!
//! Records lie and come as the vertices that ask do, and each counts in the one cell that it would ask, so the means keep the sum of the light:
//! what is lost in a corner is gained beside it. To filter paths over cells is old (Keller, Dahm, Binder: Path Space Filtering, 2014;
//! Binder, Fricke, Keller: Massively Parallel Path Space Filtering, 2021); there the picture's own paths are filtered, so that a part would
//! differ from the whole. A cell is asked only from farther than its width, and than ever more of that from map to map ([`reach`]):
//! contact shadows stay, and the picture is consistent. Where no cell answers, the path goes on. The place of the cells changes from map to
//! map, so that they do not show.

use super::batch::{BLOCK_PIXELS, Batch, Columns, Counters, ITEMS, Item, PATHS, QUARTERS, TILE};
use super::caustics::Caustics;
use super::caustics::map::spread;
use super::kernels::Kernels;
use super::statistics::Stage;
use super::trace::{Pass, Task, bounce};
use super::{Worker, each};
use crate::sampling::sampler::hash3;
use crate::scene::Scene;
use std::ops::Range;
use std::sync::Mutex;
use std::time::Instant;

/// Cells hold so many records at least.
const ENOUGH: usize = 16;
/// And so many that no finer cell has answered, to be known.
const LEAST: u32 = 8;
/// A map is worth it where such a share of the paths has a second vertex.
pub const WORTH: f32 = 1.0 / 16.0;
/// A map is made of the paths of so many items at most: 32768 paths.
const MOST_ITEMS: u64 = 512;
/// Levels of the octree.
const LEVELS: u32 = 12;
/// Cells of the finest level in a unit of render space; those of the coarsest are four units wide.
const FINEST: f32 = (1 << (LEVELS - 1)) as f32 / 4.0;
/// Bits of a coordinate in cells of the finest level.
const BITS: u32 = 19;
/// Such coordinates are below this.
const MOST: f32 = (1 << BITS) as f32;

/// The indirect light that arrives at a second vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Record {
    point: [f32; 3],
    normal: [f32; 3],
    /// The mean of the radiance by the cosine: times the albedo it is what leaves.
    light: [f32; 3],
    vertex: u32,
    /// The way from the vertex before.
    distance: f32,
}

/// A cell that holds enough; an empty place of the table has the key 0.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    key: u64,
    /// The mean over those of its records that would ask here, if they are enough.
    light: Option<[f32; 3]>,
}

/// The map of a sample index.
pub struct IndirectMap {
    /// A cell is asked from farther than so many of its widths.
    reach: f32,
    /// Where the cells' corner lies, in cells.
    shift: [f32; 3],
    /// A hash table, half full at most.
    cells: Vec<Cell>,
}

/// The reach of a map: r = (number + 1)^(1/6), without end.
fn reach(number: u32) -> f32 {
    libm::cbrt((f64::from(number) + 1.0).sqrt()) as f32
}

impl IndirectMap {
    fn new(number: u32, records: &[Record]) -> IndirectMap {
        let shift = [0, 1, 2].map(|axis| (hash3(number, axis, 0x001d_17ec) >> (65 - BITS)) as f32 + MOST / 4.0);
        let mut map = IndirectMap { reach: reach(number), shift, cells: Vec::new() };
        // By vertex and side, then along the octree's curve: a cell of any level is a run.
        let mut order: Vec<(u32, u64, u32)> = Vec::with_capacity(records.len());
        for (record, k) in records.iter().zip(0..) {
            if let Some(place) = map.place(record.point) {
                let [x, y, z] = place.map(|x| spread(u64::from(x)));
                order.push((record.vertex << 3 | side(record.normal), x | y << 1 | z << 2, k));
            }
        }
        order.sort_unstable();
        // From the finest level on: a record counts where a vertex that lies and comes as it does would ask, and nowhere else.
        let mut counted = vec![false; records.len()];
        let mut found = Vec::new();
        for level in (0..LEVELS).rev() {
            let finer = 3 * (LEVELS - 1 - level);
            let farther_than = map.farther_than(level);
            for of_cell in order.chunk_by(|a, b| a.0 == b.0 && a.1 >> finer == b.1 >> finer) {
                if of_cell.len() < ENOUGH {
                    continue;
                }
                let (mut sum, mut count) = ([0.0; 3], 0);
                let asks = |k: usize| !counted[k] && farther_than < records[k].distance;
                for record in of_cell.iter().map(|&(_, _, k)| k as usize).filter(|&k| asks(k)).map(|k| &records[k]) {
                    for (sum, light) in sum.iter_mut().zip(record.light) {
                        *sum += f64::from(light);
                    }
                    count += 1;
                }
                let light = (count >= LEAST).then(|| sum.map(|sum| (sum / f64::from(count)) as f32));
                if light.is_some() {
                    for &(_, _, k) in of_cell {
                        counted[k as usize] |= farther_than < records[k as usize].distance;
                    }
                }
                let first = &records[of_cell[0].2 as usize];
                if let Some(place) = map.place(first.point) {
                    found.push(Cell { key: key_of(place, side(first.normal), first.vertex, level), light });
                }
            }
        }
        map.cells = vec![Cell::default(); (2 * found.len()).next_power_of_two().max(2)];
        for cell in found {
            let at = map.position(cell.key);
            map.cells[at] = cell;
        }
        map
    }

    /// The mean light that arrives around a second vertex, if it is known; `distance` is the way from the vertex before.
    #[inline(always)]
    pub fn find(&self, point: [f32; 3], normal: [f32; 3], vertex: u32, distance: f32) -> Option<[f32; 3]> {
        let (place, side) = (self.place(point)?, side(normal));
        let mut found = None;
        let finer = (0..LEVELS).skip_while(|&level| self.farther_than(level) >= distance);
        for level in finer {
            let cell = &self.cells[self.position(key_of(place, side, vertex, level))];
            if cell.key == 0 {
                break;
            }
            found = cell.light.or(found);
        }
        found
    }

    /// Cells of a level are asked from farther than this.
    #[inline(always)]
    fn farther_than(&self, level: u32) -> f32 {
        self.reach * (1 << (LEVELS - 1 - level)) as f32 / FINEST
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
        let mask = self.cells.len() - 1;
        let mut at = (key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize & mask;
        while self.cells[at].key != key && self.cells[at].key != 0 {
            at = (at + 1) & mask;
        }
        at
    }
}

/// Which of six sides a surface faces.
#[inline(always)]
fn side(normal: [f32; 3]) -> u32 {
    let [x, y, z] = normal.map(f32::abs);
    let axis = if x >= y && x >= z { 0 } else { 1 + usize::from(z > y) };
    2 * axis as u32 + u32::from(normal[axis] < 0.0)
}

/// A number for a cell of a level, never 0; those of one vertex are all different.
#[inline(always)]
fn key_of(place: [u32; 3], side: u32, vertex: u32, level: u32) -> u64 {
    let [x, y, z] = place.map(|x| u64::from(x >> (LEVELS - 1 - level)));
    let cell = (x << BITS | y) << BITS | z;
    let key = (cell << 3 | u64::from(side)) << 4 | u64::from(level + 1);
    key.wrapping_add(u64::from(vertex).wrapping_mul(0xd6e8_feb8_6659_fd93)).max(1)
}

/// The share of a trial's paths that have a second vertex. It depends on scene and seed alone.
pub fn trial(scene: &Scene, kernels: &Kernels, pass: Pass<'_>, workers: &[Mutex<Worker>]) -> f32 {
    let pass = Pass { reuse: true, ..pass };
    let items = items(scene.size, pass.seed, u32::MAX, ITEMS as u64);
    let found = each(workers, 1, |_, worker| records(scene, kernels, pass, &items, &mut worker.batch).len());
    found[0] as f32 / (items.len() * BLOCK_PIXELS) as f32
}

/// The maps of these sample indices, in their order.
pub fn maps(
    scene: &Scene,
    kernels: &Kernels,
    pass: Pass<'_>,
    caustics: Option<&Caustics>,
    numbers: Range<u32>,
    workers: &[Mutex<Worker>],
) -> Vec<IndirectMap> {
    let items: Vec<Vec<Item>> =
        numbers.clone().map(|number| items(scene.size, pass.seed, number, MOST_ITEMS)).collect();
    let batches: Vec<(u32, &[Item])> = numbers
        .clone()
        .zip(&items)
        .flat_map(|(number, items)| items.chunks(ITEMS).map(move |items| (number, items)))
        .collect();
    let made = each(workers, batches.len(), |k, worker| {
        let (number, items) = batches[k];
        let photons = caustics.and_then(|caustics| caustics.map(number));
        records(scene, kernels, Pass { photons, ..pass }, items, &mut worker.batch)
    });
    each(workers, numbers.len(), |k, worker| {
        worker.batch.watch.resume();
        let start = Instant::now();
        let number = numbers.start + k as u32;
        let of_number = batches.iter().zip(&made).filter(|(batch, _)| batch.0 == number);
        let records: Vec<Record> = of_number.flat_map(|(_, records)| records.iter().copied()).collect();
        let map = IndirectMap::new(number, &records);
        worker.batch.watch.lap(Stage::Records);
        worker.batch.watch.costs.indirect_since(start);
        map
    })
}

/// The items whose pixels make the records of a map: a quarter of the picture's pixels, 1024 at least and `most` items at most, spread over
/// all of it by chance.
fn items([width, height]: [u32; 2], seed: u32, number: u32, most: u64) -> Vec<Item> {
    let across = width.div_ceil(TILE);
    let all = u64::from(across) * u64::from(height.div_ceil(TILE)) * u64::from(QUARTERS);
    let count = (all / 4).clamp(ITEMS as u64, most).min(all);
    let item = |k: u64| {
        // One of the k-th of equal shares of all quarters.
        let (first, end) = (all * k / count, all * (k + 1) / count);
        let quarter = first + hash3(seed ^ 0x001d_17ed, number, k as u32) % (end - first);
        let tile = (quarter / u64::from(QUARTERS)) as u32;
        let quarter = (quarter % u64::from(QUARTERS)) as u32;
        Item::new([tile % across, tile / across].map(|tile| (tile * TILE) as i32), quarter, number)
    };
    (0..count).map(item).collect()
}

/// The records of a batch of these items.
fn records(scene: &Scene, kernels: &Kernels, pass: Pass<'_>, items: &[Item], batch: &mut Batch) -> Vec<Record> {
    batch.watch.resume();
    let start = Instant::now();
    let costs = batch.watch.costs;
    let before = batch.counters;
    // Choices of its own: what a map holds must not depend on the very paths that ask.
    let pass = Pass { seed: hash3(pass.seed, 0, 0x001d_17ee) as u32, task: Task::Records, ..pass };
    batch.items.clear();
    batch.items.extend_from_slice(items);
    batch.glints = 0;
    batch.start();
    kernels.camera(scene, pass.seed, u32::MAX, batch);
    let mut vertices = Vec::new();
    let mut vertex = 0;
    while batch.paths.len > 0 {
        bounce(scene, kernels, pass, vertex, batch);
        vertices.resize(batch.suffixes.len, vertex);
        vertex += 1;
    }
    let at = |columns: &Columns, k: usize| [columns[0][k], columns[1][k], columns[2][k]];
    let record = |(j, vertex)| Record {
        point: at(&batch.suffixes.point, j),
        normal: at(&batch.suffixes.normal, j),
        light: at(&batch.radiance, PATHS + batch.suffixes.slot[j] as usize),
        vertex,
        distance: batch.suffixes.distance[j],
    };
    let records = vertices.into_iter().enumerate().map(record).collect();
    let rays = |c: &Counters| c.camera_rays + c.scattered_rays + c.shadow_rays;
    batch.counters = Counters { record_rays: before.record_rays + rays(&batch.counters) - rays(&before), ..before };
    // Photons that were gathered for it, too.
    batch.watch.costs = costs;
    batch.watch.lap(Stage::Records);
    batch.watch.costs.indirect_since(start);
    records
}

#[cfg(test)]
mod tests;
