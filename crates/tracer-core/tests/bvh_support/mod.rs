//! Meshes, rays and batches that the tests of the tree share.

// Rays and meshes of tests reach no picture.
#![allow(clippy::disallowed_methods)]
#![allow(dead_code)] // Each test file is a crate of its own and uses a part.

use tracer_core::Level;
use tracer_core::bvh::{
    Accel, Acceleration, Coherence, Geometry, Hits, InstanceGeometry, MeshGeometry, NONE, Occlusion, Rays,
};

/// The levels of this processor whose code for the tree differs: hardware fma alone runs the portable code, only
/// sooner.
pub fn levels() -> Vec<Level> {
    let mut levels = Level::available();
    levels.dedup_by_key(|level| level.lanes());
    levels.push(Level::PORTABLE);
    levels
}

/// A small generator of uniform numbers with a fixed seed (O'Neill, *PCG*, 2014).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let word = ((self.0 >> 18) ^ self.0) >> 27;
        (word as u32).rotate_right((self.0 >> 59) as u32)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f32 {
        (self.bits() >> 8) as f32 / 16_777_216.0
    }

    /// In [−1, 1)³.
    pub fn cube(&mut self) -> [f32; 3] {
        [0; 3].map(|_| 2.0 * self.unit() - 1.0)
    }

    pub fn below(&mut self, n: usize) -> usize {
        ((u64::from(self.bits()) * n as u64) >> 32) as usize
    }
}

#[derive(Clone, Default)]
pub struct Mesh {
    pub positions: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Unconnected triangles about `size` large in [−1, 1]³.
    pub fn soup(count: usize, size: f32, random: &mut Random) -> Self {
        let mut mesh = Self::default();
        for _ in 0..count {
            let center = random.cube();
            for _ in 0..3 {
                let offset = random.cube();
                mesh.positions.push([0, 1, 2].map(|i: usize| center[i] + size * offset[i]));
            }
            let first = mesh.positions.len() as u32 - 3;
            mesh.triangles.push([first, first + 1, first + 2]);
        }
        mesh
    }

    /// A closed, bumpy sphere of radius about 0.8 with 2·`around`·(`down` − 1) triangles.
    pub fn ball(around: u32, down: u32) -> Self {
        let mut mesh = Self::default();
        mesh.positions.push([0.0, 0.8, 0.0]);
        for row in 1..down {
            for column in 0..around {
                let theta = std::f64::consts::PI * f64::from(row) / f64::from(down);
                let phi = std::f64::consts::TAU * f64::from(column) / f64::from(around);
                let r = 0.8 * (1.0 + 0.05 * (9.0 * phi).sin() * (7.0 * theta).sin());
                let p = [r * theta.sin() * phi.cos(), r * theta.cos(), r * theta.sin() * phi.sin()];
                mesh.positions.push(p.map(|x| x as f32));
            }
        }
        mesh.positions.push([0.0, -0.8, 0.0]);
        let last = mesh.positions.len() as u32 - 1;
        let at = |row: u32, column: u32| 1 + (row - 1) * around + column % around;
        for column in 0..around {
            mesh.triangles.push([0, at(1, column + 1), at(1, column)]);
            mesh.triangles.push([last, at(down - 1, column), at(down - 1, column + 1)]);
            for row in 1..down - 1 {
                let [a, b, c, d] = [at(row, column), at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)];
                mesh.triangles.push([a, b, c]);
                mesh.triangles.push([b, d, c]);
            }
        }
        mesh
    }

    /// Closed square beams, up to two long and `width` wide, aslant in [−1, 1]³: eight vertices and twelve triangles
    /// each.
    pub fn aslant(count: usize, width: f32, random: &mut Random) -> Self {
        let mut mesh = Self::default();
        for _ in 0..count {
            let ends = [random.cube(), random.cube()];
            let along = [0, 1, 2].map(|k: usize| ends[1][k] - ends[0][k]);
            let side = unit(cross(along, random.cube()), width);
            let other = unit(cross(along, side), width);
            let first = mesh.positions.len() as u32;
            for end in ends {
                for (a, b) in [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)] {
                    mesh.positions.push([0, 1, 2].map(|k: usize| end[k] + a * side[k] + b * other[k]));
                }
            }
            let quads = [[0, 1, 2, 3], [7, 6, 5, 4], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]];
            for [a, b, c, d] in quads.map(|quad: [u32; 4]| quad.map(|vertex| first + vertex)) {
                mesh.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        mesh
    }

    pub fn scaled(mut self, factor: f32) -> Self {
        self.positions.iter_mut().flatten().for_each(|x| *x *= factor);
        self
    }

    pub fn geometry(&self, first_primitive: u32) -> MeshGeometry<'_> {
        MeshGeometry { positions: &self.positions, triangles: &self.triangles, first_primitive }
    }

    pub fn corners(&self, triangle: usize) -> [[f32; 3]; 3] {
        self.triangles[triangle].map(|vertex| self.positions[vertex as usize])
    }
}

fn cross(a: [f32; 3], b: [f32; 3]) -> [f32; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f32; 3], length: f32) -> [f32; 3] {
    let norm = a.iter().map(|x| x * x).sum::<f32>().sqrt();
    a.map(|x| x * length / norm)
}

/// A mesh placed where it is.
pub const HERE: InstanceGeometry = InstanceGeometry { mesh: 0, placement: None };

/// A batch that owns its arrays.
#[derive(Clone, Default)]
pub struct Batch {
    pub origin: [Vec<f32>; 3],
    pub direction: [Vec<f32>; 3],
    pub from_primitive: Vec<u32>,
    pub from_instance: Vec<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    pub t: f32,
    pub primitive: u32,
    pub instance: u32,
}

pub const MISS: Hit = Hit { t: f32::INFINITY, primitive: NONE, instance: NONE };

impl Batch {
    pub fn push(&mut self, origin: [f32; 3], direction: [f32; 3]) {
        self.push_from(origin, direction, NONE, NONE);
    }

    pub fn push_from(&mut self, origin: [f32; 3], direction: [f32; 3], primitive: u32, instance: u32) {
        for i in 0..3 {
            self.origin[i].push(origin[i]);
            self.direction[i].push(direction[i]);
        }
        self.from_primitive.push(primitive);
        self.from_instance.push(instance);
    }

    pub fn len(&self) -> usize {
        self.from_primitive.len()
    }

    pub fn ray(&self, i: usize) -> ([f32; 3], [f32; 3]) {
        ([0, 1, 2].map(|k: usize| self.origin[k][i]), [0, 1, 2].map(|k: usize| self.direction[k][i]))
    }

    pub fn rays(&self) -> Rays<'_> {
        let [ox, oy, oz] = &self.origin;
        let [dx, dy, dz] = &self.direction;
        Rays { ox, oy, oz, dx, dy, dz, from_primitive: &self.from_primitive, from_instance: &self.from_instance }
    }

    /// `count` rays that start in [−`size`, `size`]³ and go anywhere.
    pub fn random(count: usize, size: f32, random: &mut Random) -> Self {
        let mut batch = Self::default();
        for _ in 0..count {
            batch.push(random.cube().map(|x| x * size), random.cube());
        }
        batch
    }

    /// `count` groups of about 20 rays that go nearly the same way: what packets are made of. Some groups straddle
    /// octants or the diagonals between axes, some start at one point, a few rays are none.
    pub fn beams(count: usize, size: f32, random: &mut Random) -> Self {
        let mut batch = Self::default();
        for group in 0..count {
            let origin = random.cube().map(|x| x * size);
            let direction = match group % 4 {
                0 => random.cube(),
                1 => [1.0, 1e-3, random.unit()],
                2 => [1.0, -0.3, -1.0],
                _ => random.cube().map(|x| if random.bits() & 1 == 0 { 0.0 } else { x }),
            };
            let (start, spread) = ([0.0, 1e-3, 0.02][random.below(3)], [1e-3, 0.02, 0.1][random.below(3)]);
            for _ in 0..16 + random.below(10) {
                let (about, aside) = (random.cube(), random.cube());
                let mut d = [0, 1, 2].map(|k: usize| direction[k] + spread * aside[k]);
                if random.below(50) == 0 {
                    d[random.below(3)] = f32::NAN;
                }
                batch.push([0, 1, 2].map(|k: usize| origin[k] + start * about[k]), d);
            }
        }
        batch
    }

    pub fn append(&mut self, other: &Self) {
        for ray in 0..other.len() {
            let (origin, direction) = other.ray(ray);
            self.push_from(origin, direction, other.from_primitive[ray], other.from_instance[ray]);
        }
    }

    pub fn scaled(mut self, factor: f32) -> Self {
        self.origin.iter_mut().chain(&mut self.direction).flatten().for_each(|x| *x *= factor);
        self
    }

    pub fn closest(&self, accel: &Accel, coherence: Coherence) -> Vec<Hit> {
        let active: Vec<u32> = (0..self.len() as u32).collect();
        self.closest_of(accel, &active, coherence)
    }

    pub fn closest_of(&self, accel: &Accel, active: &[u32], coherence: Coherence) -> Vec<Hit> {
        let mut t = vec![f32::INFINITY; self.len()];
        let mut primitive = vec![NONE; self.len()];
        let mut instance = vec![NONE; self.len()];
        let mut hits = Hits { t: &mut t, primitive: &mut primitive, instance: &mut instance };
        accel.closest(&self.rays(), active, &mut hits, coherence);
        let hits = t.iter().zip(&primitive).zip(&instance);
        hits.map(|((&t, &primitive), &instance)| Hit { t, primitive, instance }).collect()
    }

    /// Which rays are blocked before `tmax`, as 0 and 1.
    pub fn occluded(&self, accel: &Accel, tmax: &[f32], targets: &[Hit], coherence: Coherence) -> Vec<u32> {
        let active: Vec<u32> = (0..self.len() as u32).collect();
        let target_primitive: Vec<u32> = targets.iter().map(|hit| hit.primitive).collect();
        let target_instance: Vec<u32> = targets.iter().map(|hit| hit.instance).collect();
        let mut occluded = vec![0; self.len()];
        let mut occlusion = Occlusion {
            tmax,
            target_primitive: &target_primitive,
            target_instance: &target_instance,
            occluded: &mut occluded,
        };
        accel.occluded(&self.rays(), &active, &mut occlusion, coherence);
        occluded
    }
}

/// Built, and found valid.
pub fn build(geometry: &Geometry, acceleration: Acceleration) -> Accel {
    let accel = Accel::build(geometry, acceleration).expect("the geometry is sound");
    accel.validate(geometry).expect("the tree is valid");
    accel
}

pub const MODES: [Acceleration; 3] = [Acceleration::None, Acceleration::BoundingBox, Acceleration::Bvh];
pub const COHERENCES: [Coherence; 2] = [Coherence::Incoherent, Coherence::Coherent];
