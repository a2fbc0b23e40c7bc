//! How many textures stand within each other.

/// Textures in one, at most: with so many no program needs more places than the engine has.
const MOST_TEXTURES: usize = 1024;

/// Textures that are being read, one within the other; of one that was read, what it is made of.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Nested {
    /// So many stand around what is read now.
    depth: usize,
    /// How many of the outermost were read so far.
    count: usize,
    /// How deep they stand.
    deepest: usize,
}

impl Nested {
    /// Textures within each other, at most; what a name stands for counts where the name stands.
    pub const MOST: usize = 16;

    /// One texture, as far as it is known before it is read.
    pub const ONE: Nested = Nested { depth: 0, count: 1, deepest: 1 };

    /// Counts one that stands here, with all that it is made of. What is wrong with so many, told once.
    pub fn add(&mut self, other: Nested) -> Option<String> {
        // What is too much by itself has been told.
        if self.depth == 0 {
            *self = other;
            return None;
        }
        let before = self.count;
        self.count += other.count;
        self.deepest = self.deepest.max(self.depth + other.deepest);
        if self.depth + other.deepest > Nested::MOST && other.deepest <= Nested::MOST {
            return Some(format!("textures stand more than {} deep", Nested::MOST));
        }
        (before <= MOST_TEXTURES && self.count > MOST_TEXTURES && other.count <= MOST_TEXTURES)
            .then(|| format!("a texture is made of more than {MOST_TEXTURES} others"))
    }

    /// What is read from now on stands within one more.
    pub fn enter(&mut self) {
        self.depth += 1;
    }

    /// That one has been read.
    pub fn leave(&mut self) {
        self.depth -= 1;
    }
}
