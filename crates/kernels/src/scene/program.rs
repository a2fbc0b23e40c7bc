//! Textures made of others: a flat list of steps, each of which writes a colour to a place, from colours at other
//! places.

use super::{Space, VertexSpace};

/// Places that a program may have. A step of three operands needs two beside what the first of them needs, if those
/// that need most are reckoned first: a program that needs more has several thousand steps.
pub const PLACES: usize = 16;

/// What a step writes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Made {
    /// Linear RGB.
    Color([f64; 3]),
    /// The colour of a pattern, by its index.
    Pattern(u32),
    /// The colour of a picture.
    Texture {
        /// Index into the scene's textures, whose own mapping comes last.
        texture: u32,
        /// What `map` starts from.
        space: Space,
        /// Rows of the 3x4 matrix to what the texture's coordinates are made of.
        map: [[f64; 4]; 3],
    },
    /// The colour of a mesh's vertices.
    VertexColor(VertexSpace),
    /// a + w (b - a), w the luminance of the third.
    Mix([u8; 3]),
    /// The product, channel by channel.
    Multiply([u8; 2]),
    /// A colour of the program's stops by the luminance of one place.
    Ramp {
        /// Where.
        input: u8,
        /// Which of the stops are its: from here.
        first: u32,
        /// So many.
        count: u32,
        /// Between two stops.
        between: Between,
    },
    /// Three colours, seen along x, y and z of the coordinates that the surface is written in, by |n|^sharpness of the
    /// normal there.
    Triplanar {
        /// Where they are.
        colors: [u8; 3],
        /// The exponent.
        sharpness: f64,
    },
}

/// How a ramp goes from stop to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Between {
    /// f.
    Linear,
    /// f^2 (3 - 2 f).
    Smooth,
    /// Not at all: it jumps at the next.
    Constant,
}

/// A step of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Op {
    /// The place that it writes to, below [`PLACES`].
    pub to: u8,
    /// What it writes there.
    pub made: Made,
}

/// A texture made of others.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// In their order; the result is at place 0 when all are done.
    pub ops: Vec<Op>,
    /// Where stops are, from 0 to 1 and never falling, and their colours; those of all its ramps.
    pub stops: Vec<(f64, [f64; 3])>,
}

impl Program {
    /// Whether it asks for points in space itself, beside its patterns.
    pub fn is_solid(&self) -> bool {
        self.ops.iter().any(|op| match op.made {
            Made::Texture { space, .. } => space != Space::Uv,
            Made::Triplanar { .. } => true,
            _ => false,
        })
    }
}
