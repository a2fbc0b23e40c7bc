//! Curved lights that are no spheres, lane by lane: what [`crate::shapes::Lamp`] says of each, in `f64`.

use super::{LightSample, Start};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{CurvedRow, LightTable};
use crate::shapes::csg::Part;
use glam::DVec3;

/// The most lanes that there are.
pub(super) const MOST: usize = 32;

/// Three numbers of each lane.
pub(super) type Column3 = [[f32; MOST]; 3];

/// Directions to the lights `k`, in the lanes of the mask; others hold anything.
#[inline(always)]
pub fn sample<F: Lanes>(lights: &LightTable, k: F::U, from: Start<'_, F>, u: F, v: F, lanes: F::M) -> LightSample<F> {
    let asked = Asked::new::<F>(lights.spheres, k, from.p, V3(u, v, v));
    let mut on = [0; MOST];
    from.on.store(&mut on);
    let found = sampled(&lights.curved, from.parts, &asked, &on, lanes.bits());
    LightSample {
        wi: loaded(&found.direction),
        distance: F::load(&found.distance),
        inverse_pdf: F::load(&found.inverse_pdf),
        radiance: loaded(&found.radiance),
        primitive: F::U::load(&found.primitive),
    }
}

/// One over the density of [`sample`] in solid angle, of directions that have met the lights `k`.
#[inline(always)]
pub fn inverse_pdf<F: Lanes>(lights: &LightTable, k: F::U, p: V3<F>, direction: V3<F>, lanes: F::M) -> F {
    let asked = Asked::new::<F>(lights.spheres, k, p, direction);
    F::load(&inverse_pdfs(&lights.curved, &asked, lanes.bits()))
}

/// Radiance of the lights `k` to the side from which they were met; `outside`: their front.
#[inline(always)]
pub fn radiance<F: Lanes>(lights: &LightTable, k: F::U, outside: F::M, lanes: F::M) -> V3<F> {
    let asked = Asked::new::<F>(lights.spheres, k, V3::zero(), V3::zero());
    loaded(&radiances(&lights.curved, &asked, outside.bits(), lanes.bits()))
}

/// Where photons and light paths start.
pub struct PointOfLight<F: Lanes> {
    /// The point.
    pub point: V3<F>,
    /// The unit normal outwards.
    pub normal: V3<F>,
    /// One over the density in area, over the area.
    pub rarity: F,
}

/// Points of the curved lights with these rows, for two random numbers.
#[inline(always)]
pub fn start<F: Lanes>(rows: &[CurvedRow], row: F::U, u: F, v: F, lanes: F::M) -> PointOfLight<F> {
    let asked = Asked::new::<F>(0, row, V3::zero(), V3(u, v, v));
    let found = started(rows, &asked, lanes.bits());
    PointOfLight { point: loaded(&found.point), normal: loaded(&found.normal), rarity: F::load(&found.rarity) }
}

/// [`PointOfLight::rarity`] of points with these normals.
#[inline(always)]
pub fn rarity<F: Lanes>(rows: &[CurvedRow], row: F::U, normal: V3<F>, lanes: F::M) -> F {
    let asked = Asked::new::<F>(0, row, V3::zero(), normal);
    F::load(&rarities(rows, &asked, lanes.bits()))
}

#[inline(always)]
fn loaded<F: Lanes>(columns: &Column3) -> V3<F> {
    V3(F::load(&columns[0]), F::load(&columns[1]), F::load(&columns[2]))
}

/// A vector's numbers, lane by lane.
#[inline(always)]
pub(super) fn columns<F: Lanes>(vector: V3<F>) -> Column3 {
    let mut columns = [[0.0; MOST]; 3];
    vector.0.store(&mut columns[0]);
    vector.1.store(&mut columns[1]);
    vector.2.store(&mut columns[2]);
    columns
}

/// What is asked of which light.
struct Asked {
    row: [u32; MOST],
    /// The row of the first curved one.
    first: u32,
    from: Column3,
    /// A direction, or random numbers.
    numbers: Column3,
}

impl Asked {
    #[inline(always)]
    fn new<F: Lanes>(first: u32, row: F::U, from: V3<F>, numbers: V3<F>) -> Self {
        let mut asked = Asked { row: [0; MOST], first, from: columns(from), numbers: columns(numbers) };
        row.store(&mut asked.row);
        asked
    }

    fn light<'r>(&self, rows: &'r [CurvedRow], lane: usize) -> Option<&'r CurvedRow> {
        rows.get(self.row[lane].wrapping_sub(self.first) as usize)
    }
}

/// The lanes of a mask.
pub(super) struct Set(pub u32);

impl Iterator for Set {
    type Item = usize;

    fn next(&mut self) -> Option<usize> {
        let lane = self.0.trailing_zeros() as usize;
        self.0 &= self.0.wrapping_sub(1);
        (lane < MOST).then_some(lane)
    }
}

fn vector(columns: &Column3, lane: usize) -> DVec3 {
    DVec3::from([0, 1, 2].map(|axis: usize| f64::from(columns[axis][lane])))
}

fn store(columns: &mut Column3, lane: usize, v: [f32; 3]) {
    for (column, x) in columns.iter_mut().zip(v) {
        column[lane] = x;
    }
}

/// Samples, column by column.
struct Sampled {
    direction: Column3,
    distance: [f32; MOST],
    inverse_pdf: [f32; MOST],
    radiance: Column3,
    primitive: [u32; MOST],
}

#[inline(never)]
fn sampled(rows: &[CurvedRow], parts: &[Part], asked: &Asked, on: &[u32; MOST], lanes: u32) -> Sampled {
    let zero = [0.0; MOST];
    let mut found = Sampled {
        direction: [zero, zero, [1.0; MOST]],
        distance: zero,
        inverse_pdf: zero,
        radiance: [zero; 3],
        primitive: [0; MOST],
    };
    for lane in Set(lanes) {
        let Some(light) = asked.light(rows, lane) else { continue };
        let numbers = vector(&asked.numbers, lane);
        let from = (vector(&asked.from, lane), on[lane] == light.primitive);
        let Some(towards) = light.lamp.sample_among(parts, from, numbers.x, numbers.y) else { continue };
        store(&mut found.direction, lane, towards.direction.as_vec3().to_array());
        found.distance[lane] = towards.distance as f32;
        found.inverse_pdf[lane] = towards.inverse_pdf as f32;
        store(&mut found.radiance, lane, light.radiance);
        found.primitive[lane] = light.primitive;
    }
    found
}

#[inline(never)]
fn inverse_pdfs(rows: &[CurvedRow], asked: &Asked, lanes: u32) -> [f32; MOST] {
    let mut found = [1.0; MOST];
    for lane in Set(lanes) {
        let Some(light) = asked.light(rows, lane) else { continue };
        found[lane] = light.lamp.inverse_pdf(vector(&asked.from, lane), vector(&asked.numbers, lane)) as f32;
    }
    found
}

#[inline(never)]
fn radiances(rows: &[CurvedRow], asked: &Asked, outside: u32, lanes: u32) -> Column3 {
    let mut found = [[0.0; MOST]; 3];
    for lane in Set(lanes) {
        let Some(light) = asked.light(rows, lane) else { continue };
        if light.two_sided || outside >> lane & 1 == 1 {
            store(&mut found, lane, light.radiance);
        }
    }
    found
}

/// Starts, column by column.
struct Started {
    point: Column3,
    normal: Column3,
    rarity: [f32; MOST],
}

#[inline(never)]
fn started(rows: &[CurvedRow], asked: &Asked, lanes: u32) -> Started {
    let zero = [0.0; MOST];
    let mut found = Started { point: [zero; 3], normal: [zero, zero, [1.0; MOST]], rarity: [1.0; MOST] };
    for lane in Set(lanes) {
        let Some(light) = asked.light(rows, lane) else { continue };
        let numbers = vector(&asked.numbers, lane);
        let start = light.lamp.start(numbers.x, numbers.y);
        store(&mut found.point, lane, start.point.as_vec3().to_array());
        store(&mut found.normal, lane, start.normal.as_vec3().to_array());
        found.rarity[lane] = start.rarity as f32;
    }
    found
}

#[inline(never)]
fn rarities(rows: &[CurvedRow], asked: &Asked, lanes: u32) -> [f32; MOST] {
    let mut found = [1.0; MOST];
    for lane in Set(lanes) {
        let Some(light) = asked.light(rows, lane) else { continue };
        found[lane] = light.lamp.rarity(vector(&asked.numbers, lane)) as f32;
    }
    found
}

#[cfg(test)]
mod tests;
