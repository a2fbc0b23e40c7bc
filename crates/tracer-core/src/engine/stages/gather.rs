//! Photons around diffuse vertices: density estimation with Epanechnikov's kernel (see `engine::caustics`).
//!
//! Nearly all of the time is waiting for memory, so the work is cut into loops without branches that depend on what was just looked up:
//! which queries have photons near, which runs of photons these are, and the photons themselves. The processor then waits for
//! many at once (one loop for all took half as long again).

use crate::engine::batch::{Batch, Queries};
use crate::engine::caustics::map::{Grid, Map, OFFSET};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;

/// Photons whose surface is turned by more than this (cosine) against the vertex's belong to another one.
const LEAST_COS: f32 = 0.7;
/// The photons of a run are summed in so many columns, so that the sum does not depend on the number of lanes.
const COLUMNS: usize = 8;
/// Queries whose runs are found at once.
const CHUNK: usize = 64;

/// The memory of so many runs is fetched while others are summed.
const AHEAD: usize = 4;

/// A query with photons near, and the cell from which on they are.
#[derive(Clone, Copy, Default)]
struct Near {
    query: u32,
    cell: [u32; 3],
}

/// Photons first .. end are in a cell near a query.
#[derive(Clone, Copy, Default)]
struct Run {
    query: u32,
    first: u32,
    end: u32,
}

/// Adds what the queries in `batch.queries` gather to their slots; photons that came over more than `most_events` mirrors and glass are
/// left out: their paths would be too long.
#[inline(always)]
pub fn gather<F: Lanes>(map: &Map, most_events: u32, batch: &mut Batch) {
    let Batch { queries, radiance, .. } = batch;
    let mut near = [Near::default(); CHUNK + 32];
    let mut runs = [Run::default(); 8 * CHUNK];
    for grid in &map.grids {
        let mut waiting = 0;
        for i in (0..queries.len).step_by(F::N) {
            waiting = find_near::<F>(grid, queries, i, &mut near, waiting);
            if waiting >= CHUNK || i + F::N >= queries.len {
                // What is over waits for the next chunk.
                for chunk in near[..waiting].chunks(CHUNK) {
                    let count = find_runs(grid, chunk, &mut runs);
                    for (r, run) in runs[..count].iter().enumerate() {
                        if let Some(ahead) = runs[..count].get(r + AHEAD) {
                            grid.prefetch(ahead.first as usize);
                        }
                        let Some(sum) = flux_per_area::<F>(grid, *run, queries, most_events) else { continue };
                        let k = run.query as usize;
                        let slot = queries.slot[k] as usize;
                        for ((radiance, value), sum) in radiance.iter_mut().zip(&queries.value).zip(sum) {
                            radiance[slot] += value[k] * sum;
                        }
                    }
                }
                waiting = 0;
            }
        }
    }
}

/// Adds those of queries i .. i + N that have photons near; gives how many are listed now.
#[inline(always)]
fn find_near<F: Lanes>(grid: &Grid, queries: &Queries, i: usize, near: &mut [Near], mut count: usize) -> usize {
    let c = F::splat;
    let most = c(2.0 * OFFSET);
    let p = V3::<F>::load(&queries.point, i);
    // The cell of the corner a radius, half a cell, below.
    let (inverse, offset) = (c(grid.inverse_cell), c(OFFSET - 0.5));
    let along = V3(p.0.fma(inverse, offset), p.1.fma(inverse, offset), p.2.fma(inverse, offset));
    let (mut x, mut y, mut z) = ([0u32; 32], [0u32; 32], [0u32; 32]);
    along.0.max(c(0.0)).min(most).to_int().store(&mut x);
    along.1.max(c(0.0)).min(most).to_int().store(&mut y);
    along.2.max(c(0.0)).min(most).to_int().store(&mut z);
    let lanes = F::N.min(queries.len - i);
    for (lane, ((&x, &y), &z)) in x.iter().zip(&y).zip(&z).take(lanes).enumerate() {
        near[count] = Near { query: (i + lane) as u32, cell: [x, y, z] };
        count += usize::from(grid.is_near(x, y, z));
    }
    count
}

/// The runs of photons in the eight cells of each of these; gives their number.
#[inline(always)]
fn find_runs(grid: &Grid, near: &[Near], runs: &mut [Run]) -> usize {
    let mut count = 0;
    for &Near { query, cell: [x, y, z] } in near {
        for row in 0..4 {
            for (first, end) in grid.pair_of_cells(x, y + (row & 1), z + (row >> 1)) {
                if let Some(run) = runs.get_mut(count) {
                    *run = Run { query, first, end };
                }
                count += usize::from(first < end);
            }
        }
    }
    count
}

/// Flux per area that a run of photons brings to its query; `None` where none is near enough.
#[inline(always)]
fn flux_per_area<F: Lanes>(grid: &Grid, run: Run, queries: &Queries, most_events: u32) -> Option<[f32; 3]> {
    let k = run.query as usize;
    let point = V3::<F>::splat([queries.point[0][k], queries.point[1][k], queries.point[2][k]]);
    let normal = V3::<F>::splat([queries.normal[0][k], queries.normal[1][k], queries.normal[2][k]]);
    let c = F::splat;
    let step = F::N.min(COLUMNS);
    let (first, end) = (run.first as usize, run.end as usize);
    // In registers where they hold all columns; wider ones leave what is beyond at zero.
    let mut wide = V3::<F>::zero();
    let mut sums = [[0.0f32; 32]; 3];
    let mut found = false;
    for i in (first..end).step_by(step) {
        let to = V3::<F>::load(&grid.points, i).sub(point);
        let weight = c(1.0) - to.dot(to) * c(grid.inverse_radius2);
        let near = F::first(step.min(end - i)) & c(0.0).lt(weight) & normal.dot(to).abs().lt(c(grid.height));
        if near.any() {
            let same_side = c(LEAST_COS).lt(normal.dot(V3::load(&grid.normals, i)));
            let short = F::U::load(&grid.events[i..]).lt(F::U::splat(most_events + 1));
            let weight = F::select(near & same_side & short, weight, c(0.0));
            let flux = V3::<F>::load(&grid.flux, i);
            if F::N >= COLUMNS {
                wide = flux.mad(weight, wide);
            } else {
                let column = (i - first) % COLUMNS;
                let before = V3(F::load(&sums[0][column..]), F::load(&sums[1][column..]), F::load(&sums[2][column..]));
                let after = flux.mad(weight, before);
                after.0.store(&mut sums[0][column..]);
                after.1.store(&mut sums[1][column..]);
                after.2.store(&mut sums[2][column..]);
            }
            found = true;
        }
    }
    if !found {
        return None;
    }
    if F::N >= COLUMNS {
        wide.0.store(&mut sums[0]);
        wide.1.store(&mut sums[1]);
        wide.2.store(&mut sums[2]);
    }
    Some([total(&sums[0]), total(&sums[1]), total(&sums[2])])
}

/// The sum of all columns.
#[inline(always)]
fn total(s: &[f32; 32]) -> f32 {
    ((s[0] + s[4]) + (s[2] + s[6])) + ((s[1] + s[5]) + (s[3] + s[7]))
}
