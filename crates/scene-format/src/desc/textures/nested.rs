//! How many textures stand within each other, and what the outermost is of.

use crate::schema::FieldDef;

/// Textures in one, at most: with so many no program needs more places than the engine has.
const MOST_TEXTURES: usize = 1024;

/// Textures that are being read, one within the other; of one that was read, what it is made of.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Nested {
    /// What the outermost is of whose place in the one around it is no colour of that.
    of: Option<&'static FieldDef>,
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
    pub const ONE: Nested = Nested { of: None, depth: 0, count: 1, deepest: 1 };

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

    /// What is read from now on stands within one more, which is of this field. What [`Nested::leave`] wants then.
    pub fn enter(&mut self, at: &'static FieldDef) -> Option<&'static FieldDef> {
        let before = self.of;
        // What says how much of either of two colours counts, say, is no colour of what stands around it.
        if self.depth == 0 || !at.rule.of_texture {
            self.of = Some(at);
        }
        self.depth += 1;
        before
    }

    /// The field whose range a constant has: what stands in place of a texture's colour is what the texture is of, and
    /// may be as large.
    pub fn range(&self, at: &'static FieldDef) -> &'static FieldDef {
        match self.of {
            Some(of) if self.depth > 0 && at.rule.of_texture && of.rule.range != at.rule.range => {
                if of.rule.shared_out { at } else { of }
            }
            _ => at,
        }
    }

    /// That one has been read.
    pub fn leave(&mut self, before: Option<&'static FieldDef>) {
        self.of = before;
        self.depth -= 1;
    }
}
