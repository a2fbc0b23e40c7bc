//! Textures that are reckoned, as the engine reads them: what a point of a surface is mapped to, two colours, and the parameters of each kind.

use glam::{DAffine3, DMat3, DVec3};
use scene_format::desc::{self, GradientAxis, LinesAlong, NoiseKind, SolidMapping};

/// What a pattern's coordinates are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// (u, v, 0) of the surface.
    Uv,
    /// The point in the coordinates that its shape is written in.
    Object,
    /// The point in the scene's coordinates.
    World,
}

/// A texture that is reckoned: mix(a, b, t), t by the words and by the point in the pattern's own coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// What the scene says.
    pub words: desc::Albedo,
    /// What `map` starts from.
    pub space: Space,
    /// Rows of the 3x4 matrix to the pattern's coordinates.
    pub map: [[f64; 4]; 3],
    /// The colour at t = 0, linear RGB.
    pub a: [f64; 3],
    /// The colour at t = 1.
    pub b: [f64; 3],
}

impl Pattern {
    /// From the words of one; `None` where it is a constant colour or a picture.
    pub fn new(words: &desc::Albedo) -> Option<Self> {
        let pattern = words.pattern()?;
        let (space, map) = match pattern.mapping() {
            SolidMapping::Uv(uv) => {
                let [[ux, vx, x], [uy, vy, y]] = uv.rows();
                (Space::Uv, [[ux, vx, 0.0, x], [uy, vy, 0.0, y], [0.0; 4]])
            }
            SolidMapping::Object { scale, offset } => (Space::Object, scaled_and_moved(scale.0, offset)),
            SolidMapping::World { scale, offset } => (Space::World, scaled_and_moved(scale.0, offset)),
        };
        let [a, b] = pattern.colors();
        Some(Pattern { words: words.clone(), space, map, a, b })
    }

    /// The number of its kind, and its parameters.
    fn row(&self) -> (u32, Parameters) {
        let none = Parameters::default();
        match &self.words {
            desc::Albedo::Color(_) | desc::Albedo::Texture(_) => (kind::CHECKERBOARD, none),
            desc::Albedo::Checkerboard(_) => (kind::CHECKERBOARD, none),
            desc::Albedo::Lines(lines) => {
                let half = 0.5 * lines.width;
                let (across_u, across_v) = match lines.along {
                    LinesAlong::Both => (half, half),
                    LinesAlong::U => (-1.0, half),
                    LinesAlong::V => (half, -1.0),
                };
                (kind::LINES, Parameters { shape: [across_u, across_v, 0.0], ..none })
            }
            desc::Albedo::Dots(dots) => (kind::DOTS, Parameters { shape: [dots.radius, 0.0, 0.0], ..none }),
            desc::Albedo::Gradient(gradient) => match gradient.axis {
                GradientAxis::Radial => (kind::RADIAL, none),
                GradientAxis::X => (kind::GRADIENT, Parameters { shape: [1.0, 0.0, 0.0], ..none }),
                GradientAxis::Y => (kind::GRADIENT, Parameters { shape: [0.0, 1.0, 0.0], ..none }),
                GradientAxis::Z => (kind::GRADIENT, Parameters { shape: [0.0, 0.0, 1.0], ..none }),
            },
            desc::Albedo::Noise(noise) => {
                let octaves = if noise.kind == NoiseKind::Perlin { 1 } else { noise.octaves };
                let kind = if noise.kind == NoiseKind::Turbulence { kind::TURBULENCE } else { kind::FBM };
                let (lacunarity, gain) = (noise.lacunarity, noise.gain);
                (kind, Parameters { octaves, lacunarity, gain, ..none })
            }
            desc::Albedo::Wood(wood) => {
                (kind::WOOD, Parameters { octaves: WOOD_OCTAVES, shape: [wood.distortion, 0.0, 0.0], ..none })
            }
            desc::Albedo::Marble(marble) => {
                (kind::MARBLE, Parameters { octaves: MARBLE_OCTAVES, shape: [marble.distortion, 0.0, 0.0], ..none })
            }
        }
    }
}

/// Octaves of the noise that bends the rings of wood.
pub const WOOD_OCTAVES: u32 = 4;
/// Octaves of the turbulence that bends the veins of marble.
pub const MARBLE_OCTAVES: u32 = 6;

fn scaled_and_moved([x, y, z]: [f64; 3], [dx, dy, dz]: [f64; 3]) -> [[f64; 4]; 3] {
    [[x, 0.0, 0.0, dx], [0.0, y, 0.0, dy], [0.0, 0.0, z, dz]]
}

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
    /// Those that take octaves of noise.
    pub const NOISY: u32 = 1 << FBM | 1 << TURBULENCE | 1 << WOOD | 1 << MARBLE;
}

/// What a kind of pattern goes by.
struct Parameters {
    octaves: u32,
    lacunarity: f64,
    gain: f64,
    /// Of its kind's own.
    shape: [f64; 3],
}

impl Default for Parameters {
    fn default() -> Self {
        Parameters { octaves: 0, lacunarity: 2.0, gain: 0.5, shape: [0.0; 3] }
    }
}

/// Numbers a pattern takes in [`PatternTable::rows`]: the map, both colours, the octaves' three, the kind's three.
pub(crate) const STRIDE: u32 = 24;

/// Patterns as columns, index = pattern.
#[derive(Default)]
pub(crate) struct PatternTable {
    /// One of [`kind`].
    pub kind: Vec<u32>,
    /// 0 texture coordinates, 1 object, 2 world.
    pub space: Vec<u32>,
    /// [`STRIDE`] numbers a pattern.
    pub rows: Vec<f32>,
    /// Which kinds occur, one bit each.
    pub kinds: u32,
    /// Whether any goes by points in space.
    pub solid: bool,
    /// 12 numbers an instance, the rows of the matrix from render space to the coordinates that its shape is written in; the last is the world,
    /// which those of spheres are. Empty where no pattern goes by points in space.
    pub to_object: Vec<f32>,
    /// Index of the world in `to_object`.
    pub world: u32,
    /// How each is looked up, as the scene says it.
    pub patterns: Vec<Pattern>,
    /// As `to_object`, in full precision.
    pub maps: Vec<[[f64; 4]; 3]>,
}

impl PatternTable {
    /// `objects`: per instance from the coordinates of its shape to the world.
    pub fn new(patterns: Vec<Pattern>, frame: &super::Frame, objects: &[DAffine3]) -> Self {
        let mut table = PatternTable::default();
        for pattern in &patterns {
            let (kind, p) = pattern.row();
            table.kind.push(kind);
            table.kinds |= 1 << kind;
            table.space.push(match pattern.space {
                Space::Uv => 0,
                Space::Object => 1,
                Space::World => 2,
            });
            table.solid |= pattern.space != Space::Uv;
            let numbers = pattern.map.as_flattened().iter().chain(&pattern.a).chain(&pattern.b);
            let octaves = [f64::from(p.octaves), p.lacunarity, p.gain];
            table.rows.extend(numbers.chain(&octaves).chain(&p.shape).map(|&x| x as f32));
        }
        if table.solid {
            let to_world =
                DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(1.0 / frame.scale)), translation: frame.centre };
            table.world = objects.len() as u32;
            let maps = objects.iter().map(|object| object.inverse() * to_world).chain([to_world]);
            table.maps = maps.map(|map| rows(&map)).collect();
            table.to_object = table.maps.as_flattened().as_flattened().iter().map(|&x| x as f32).collect();
        }
        // Columns are read sixteen at a time.
        for column in [&mut table.kind, &mut table.space] {
            column.resize(column.len().max(16), 0);
        }
        table.rows.resize(table.rows.len().max(16), 0.0);
        table.to_object.resize(table.to_object.len().max(16), 0.0);
        table.patterns = patterns;
        table
    }
}

fn rows(map: &DAffine3) -> [[f64; 4]; 3] {
    [0, 1, 2].map(|r| {
        let row = map.matrix3.row(r);
        [row.x, row.y, row.z, map.translation[r]]
    })
}
