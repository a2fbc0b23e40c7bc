//! Textures that are reckoned: where they are mapped to, two colours, and the parameters of each kind.

use super::{Operand, Program, Shape, Sphere};
use glam::{DAffine3, DMat3, DVec3};

/// What a pattern's coordinates are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Space {
    /// (u, v, 0) of the surface.
    Uv = 0,
    /// The point in the coordinates that its shape is written in.
    Object = 1,
    /// The point in the scene's coordinates.
    World = 2,
    /// The point in the coordinates that its shape is written in; the map leads to a frame about whose second axis
    /// (longitude, latitude, 0) from 0 to 1 are the pattern's coordinates, once they are multiplied by its `across`.
    Spherical = 3,
}

/// What goes from 0 to 1 in a gradient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GradientAxis {
    /// The first coordinate.
    X,
    /// The second.
    Y,
    /// The third.
    Z,
    /// The distance from the origin.
    Radial,
}

/// How octaves of noise are mixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseKind {
    /// sum g^i n(l^i p) / sum g^i, brought to 0..1.
    Fbm,
    /// sum g^i |n(l^i p)| / sum g^i.
    Turbulence,
}

/// What of scattered points goes from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VoronoiFeature {
    /// The distance to the nearest.
    F1,
    /// How much farther the second nearest is.
    F2MinusF1,
    /// A number of each cell's own.
    Cell,
}

/// How t goes with the point; the formulas are those of the manual.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PatternKind {
    /// Cubes of side 1.
    Checkerboard,
    /// Lines of a width.
    Lines {
        /// Where the first coordinate is whole.
        at_u: bool,
        /// Where the second is.
        at_v: bool,
        /// Their width.
        width: f64,
    },
    /// One in each unit square.
    Dots {
        /// Of each.
        radius: f64,
    },
    /// A coordinate, clamped.
    Gradient {
        /// Which.
        axis: GradientAxis,
    },
    /// Octaves of Perlin's noise.
    Noise {
        /// How they are mixed.
        kind: NoiseKind,
        /// How many; 1: the noise itself.
        octaves: u32,
        /// l.
        lacunarity: f64,
        /// g.
        gain: f64,
    },
    /// Rings about an axis.
    Wood {
        /// How far noise bends them.
        distortion: f64,
        /// Its direction, of length one.
        axis: [f64; 3],
    },
    /// Veins across an axis.
    Marble {
        /// How far turbulence bends them.
        distortion: f64,
        /// Its direction, of length one.
        axis: [f64; 3],
    },
    /// One scattered point in each unit cube.
    Voronoi {
        /// What goes from 0 to 1.
        feature: VoronoiFeature,
        /// How far points are from the middles of their cubes.
        jitter: f64,
    },
}

/// A texture that is reckoned: mix(a, b, t), t by the kind and by the point in the pattern's own coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    /// How t goes with the point.
    pub kind: PatternKind,
    /// What `map` starts from.
    pub space: Space,
    /// Rows of the 3x4 matrix to the pattern's coordinates.
    pub map: [[f64; 4]; 3],
    /// What longitude and latitude are multiplied by.
    pub across: [f64; 2],
    /// The colour at t = 0, linear RGB.
    pub a: [f64; 3],
    /// The colour at t = 1.
    pub b: [f64; 3],
}

/// See [`Pattern::key`].
pub type PatternKey = (u32, Space, [u32; STRIDE as usize]);

impl Pattern {
    /// All that the engine knows of it: two with the same numbers are one.
    pub fn key(&self) -> PatternKey {
        let (kind, row) = self.row();
        (kind, self.space, row.map(f32::to_bits))
    }

    /// The number of its kind, and its numbers in [`PatternTable::rows`].
    fn row(&self) -> (u32, [f32; STRIDE as usize]) {
        let (kind, p) = number_and_parameters(&self.kind);
        let octaves = [f64::from(p.octaves), p.lacunarity, p.gain];
        let numbers = self.map.as_flattened().iter().chain(&self.a).chain(&self.b).chain(&octaves);
        let numbers = numbers.chain(&p.shape).chain(&self.across).chain([&p.distortion]);
        let mut row = [0.0; STRIDE as usize];
        for (to, &x) in row.iter_mut().zip(numbers) {
            *to = x as f32;
        }
        (kind, row)
    }
}

/// The number of a kind in the table, and its parameters there.
fn number_and_parameters(of: &PatternKind) -> (u32, Parameters) {
    let none = Parameters::default();
    let shape = |x: f64, y: f64, z: f64| Parameters { shape: [x, y, z], ..none };
    let bent = |octaves: u32, distortion: f64, axis: [f64; 3]| Parameters { octaves, shape: axis, distortion, ..none };
    match *of {
        PatternKind::Checkerboard => (kind::CHECKERBOARD, none),
        PatternKind::Lines { at_u, at_v, width } => {
            // No point is that near.
            let half = |on: bool| if on { 0.5 * width } else { -1.0 };
            (kind::LINES, shape(half(at_u), half(at_v), 0.0))
        }
        PatternKind::Dots { radius } => (kind::DOTS, shape(radius, 0.0, 0.0)),
        PatternKind::Gradient { axis } => match axis {
            GradientAxis::Radial => (kind::RADIAL, none),
            GradientAxis::X => (kind::GRADIENT, shape(1.0, 0.0, 0.0)),
            GradientAxis::Y => (kind::GRADIENT, shape(0.0, 1.0, 0.0)),
            GradientAxis::Z => (kind::GRADIENT, shape(0.0, 0.0, 1.0)),
        },
        PatternKind::Noise { kind, octaves, lacunarity, gain } => {
            let number = match kind {
                NoiseKind::Fbm => kind::FBM,
                NoiseKind::Turbulence => kind::TURBULENCE,
            };
            (number, Parameters { octaves, lacunarity, gain, ..none })
        }
        PatternKind::Wood { distortion, axis } => (kind::WOOD, bent(WOOD_OCTAVES, distortion, axis)),
        PatternKind::Marble { distortion, axis } => (kind::MARBLE, bent(MARBLE_OCTAVES, distortion, axis)),
        PatternKind::Voronoi { feature, jitter } => {
            let feature = match feature {
                VoronoiFeature::F1 => voronoi_feature::F1,
                VoronoiFeature::F2MinusF1 => voronoi_feature::F2_MINUS_F1,
                VoronoiFeature::Cell => voronoi_feature::CELL,
            };
            (kind::VORONOI, shape(f64::from(feature), jitter, 0.0))
        }
    }
}

/// Octaves of the noise that bends the rings of wood.
const WOOD_OCTAVES: u32 = 4;
/// Octaves of the turbulence that bends the veins of marble.
const MARBLE_OCTAVES: u32 = 6;

/// Numbers of the kinds of patterns in the table.
pub(crate) mod kind {
    pub const CHECKERBOARD: u32 = 0;
    pub const LINES: u32 = 1;
    pub const DOTS: u32 = 2;
    pub const GRADIENT: u32 = 3;
    pub const RADIAL: u32 = 4;
    pub const FBM: u32 = 5;
    pub const TURBULENCE: u32 = 6;
    pub const WOOD: u32 = 7;
    pub const MARBLE: u32 = 8;
    pub const VORONOI: u32 = 9;
    /// Those that take octaves of noise.
    pub const NOISY: u32 = 1 << FBM | 1 << TURBULENCE | 1 << WOOD | 1 << MARBLE;
}

/// Numbers of what goes from 0 to 1 in cells.
pub(crate) mod voronoi_feature {
    pub const F1: f32 = 0.0;
    pub const F2_MINUS_F1: f32 = 1.0;
    pub const CELL: f32 = 2.0;
}

/// What a kind of pattern goes by.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Parameters {
    octaves: u32,
    lacunarity: f64,
    gain: f64,
    /// Of its kind's own.
    shape: [f64; 3],
    /// How far octaves bend it.
    distortion: f64,
}

impl Default for Parameters {
    fn default() -> Self {
        Parameters { octaves: 0, lacunarity: 2.0, gain: 0.5, shape: [0.0; 3], distortion: 0.0 }
    }
}

/// Numbers a pattern takes in [`PatternTable::rows`]: the map, both colours, the octaves' three, the kind's three,
/// those of longitude and latitude, how far it is bent.
pub const STRIDE: u32 = 27;

/// Which coordinates surfaces are written in. Nothing where no pattern asks for it.
#[derive(Default)]
pub struct Written {
    /// Per sphere, behind them per shape, behind them per instance, behind them per operand of solids: which of `maps`.
    pub entry: Vec<u32>,
    /// From there to the world; the first is the world's own.
    pub maps: Vec<DAffine3>,
}

impl Written {
    /// `of_instances`: which of the maps each instance has.
    pub fn new(
        maps: Vec<DAffine3>,
        spheres: &[Sphere],
        shapes: &[Shape],
        of_instances: &[u32],
        operands: &[Operand],
    ) -> Self {
        let loose = spheres.iter().map(|s| s.coordinates).chain(shapes.iter().map(|s| s.coordinates));
        let of_operands = operands.iter().map(|operand| operand.coordinates);
        let mut entry: Vec<u32> = loose.chain(of_instances.iter().copied()).chain(of_operands).collect();
        // It is looked up even where nothing is.
        entry.resize(entry.len().max(1), 0);
        Written { entry, maps }
    }
}

/// Patterns as columns, index = pattern.
#[derive(Default)]
pub struct PatternTable {
    /// One of [`kind`].
    pub kind: Vec<u32>,
    /// [`Space`].
    pub space: Vec<u32>,
    /// [`STRIDE`] numbers a pattern.
    pub rows: Vec<f32>,
    /// Which kinds occur, one bit each.
    pub kinds: u32,
    /// Whether any goes by points in space.
    pub solid: bool,
    /// Whether any goes by longitude and latitude.
    pub spherical: bool,
    /// Per sphere, behind them per shape, behind them per instance, behind them per operand of solids: which matrix of
    /// `to_object`.
    pub entry: Vec<u32>,
    /// Rows of the 3x4 matrices from render space to the coordinates that something is written in, 12 numbers each; the
    /// first is to the world's.
    pub to_object: Vec<f32>,
    /// What each is.
    pub patterns: Vec<Pattern>,
    /// Textures made of these and of others, numbered behind the patterns.
    pub programs: Vec<Program>,
    /// As `to_object`, in full precision.
    pub maps: Vec<[[f64; 4]; 3]>,
}

impl PatternTable {
    /// Of the patterns, in their order, and of what is made of them.
    pub fn new(patterns: Vec<Pattern>, programs: Vec<Program>, frame: &super::Frame, written: Written) -> Self {
        let mut table = PatternTable { entry: written.entry, programs, ..PatternTable::default() };
        for pattern in &patterns {
            let (kind, row) = pattern.row();
            table.kind.push(kind);
            table.kinds |= 1 << kind;
            table.space.push(pattern.space as u32);
            table.solid |= pattern.space != Space::Uv;
            table.spherical |= pattern.space == Space::Spherical;
            table.rows.extend(row);
        }
        let to_world =
            DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(1.0 / frame.scale)), translation: frame.centre };
        table.maps = written.maps.iter().map(|map| rows(&(map.inverse() * to_world))).collect();
        table.to_object = table.maps.as_flattened().as_flattened().iter().map(|&x| x as f32).collect();
        table.patterns = patterns;
        table
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.patterns.is_empty() && self.programs.is_empty()
    }
}

fn rows(map: &DAffine3) -> [[f64; 4]; 3] {
    [0, 1, 2].map(|r| {
        let row = map.matrix3.row(r);
        [row.x, row.y, row.z, map.translation[r]]
    })
}
