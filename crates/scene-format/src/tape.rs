//! A list that grows without moving what it holds, so that a large file's tree is never in memory twice.

/// Entries of one chunk. A chunk of nodes takes 64 KB: little beside a scene, and few of them in a large one.
const CHUNK: usize = 1 << 12;

/// A list in chunks of equal size.
#[derive(Clone, Debug)]
pub(crate) struct Tape<T> {
    chunks: Vec<Vec<T>>,
}

impl<T> Default for Tape<T> {
    fn default() -> Self {
        Tape { chunks: Vec::new() }
    }
}

impl<T: Copy> Tape<T> {
    pub fn len(&self) -> usize {
        self.chunks.last().map_or(0, |last| (self.chunks.len() - 1) * CHUNK + last.len())
    }

    pub fn is_empty(&self) -> bool {
        self.chunks.is_empty()
    }

    #[inline]
    pub fn push(&mut self, entry: T) {
        match self.chunks.last_mut() {
            Some(last) if last.len() < CHUNK => last.push(entry),
            _ => {
                let mut chunk = Vec::with_capacity(CHUNK);
                chunk.push(entry);
                self.chunks.push(chunk);
            }
        }
    }

    #[inline]
    pub fn get(&self, index: usize) -> Option<&T> {
        self.chunks.get(index / CHUNK)?.get(index % CHUNK)
    }

    #[inline]
    pub fn get_mut(&mut self, index: usize) -> Option<&mut T> {
        self.chunks.get_mut(index / CHUNK)?.get_mut(index % CHUNK)
    }

    pub fn truncate(&mut self, length: usize) {
        self.chunks.truncate(length.div_ceil(CHUNK));
        if length < self.len()
            && let Some(last) = self.chunks.last_mut()
        {
            last.truncate(length - (length - 1) / CHUNK * CHUNK);
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.chunks.iter().flatten()
    }
}

impl<T: Copy> std::ops::Index<usize> for Tape<T> {
    type Output = T;

    #[inline]
    fn index(&self, index: usize) -> &T {
        &self.chunks[index / CHUNK][index % CHUNK]
    }
}

impl<T: Copy> std::ops::IndexMut<usize> for Tape<T> {
    #[inline]
    fn index_mut(&mut self, index: usize) -> &mut T {
        &mut self.chunks[index / CHUNK][index % CHUNK]
    }
}

impl<T: Copy> Extend<T> for Tape<T> {
    fn extend<I: IntoIterator<Item = T>>(&mut self, entries: I) {
        entries.into_iter().for_each(|entry| self.push(entry));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_a_list() {
        let mut tape = Tape::default();
        tape.extend(0..3 * CHUNK + 5);
        assert_eq!(tape.len(), 3 * CHUNK + 5);
        assert!(tape.iter().copied().eq(0..3 * CHUNK + 5));
        for length in [3 * CHUNK + 1, 3 * CHUNK, 3 * CHUNK - 1, CHUNK + 1, CHUNK, 1, 0] {
            tape.truncate(length);
            assert_eq!(tape.len(), length);
            assert_eq!(tape.get(length), None);
            assert!(tape.iter().copied().eq(0..length));
        }
        assert!(tape.is_empty());
        tape.push(7);
        assert_eq!(tape[0], 7);
    }
}
