//! A list that grows without moving what it holds, so that a large file's tree is never in memory twice.

use std::cell::RefCell;
use std::ops::Range;

/// Entries of one chunk. A chunk of nodes takes 256 KB: so much the system's allocator gives back at once when it is
/// released.
const CHUNK: usize = 1 << 14;

/// A list in chunks of equal size. Entries are read by value, so that what was read for the last time can be released
/// while the list is shared.
#[derive(Clone, Debug)]
pub(crate) struct Tape<T> {
    chunks: Vec<RefCell<Vec<T>>>,
    length: usize,
}

impl<T> Default for Tape<T> {
    fn default() -> Self {
        Tape { chunks: Vec::new(), length: 0 }
    }
}

impl<T: Copy> Tape<T> {
    pub fn len(&self) -> usize {
        self.length
    }

    pub fn is_empty(&self) -> bool {
        self.length == 0
    }

    #[inline]
    pub fn push(&mut self, entry: T) {
        if self.length.is_multiple_of(CHUNK) {
            self.chunks.push(RefCell::new(Vec::with_capacity(CHUNK)));
        }
        if let Some(last) = self.chunks.last_mut() {
            last.get_mut().push(entry);
            self.length += 1;
        }
    }

    /// An entry; `None` beyond the end, and where entries were released.
    #[inline]
    pub fn get(&self, index: usize) -> Option<T> {
        self.chunks.get(index / CHUNK)?.borrow().get(index % CHUNK).copied()
    }

    /// An entry that is there.
    #[inline]
    pub fn at(&self, index: usize) -> T {
        self.chunks[index / CHUNK].borrow()[index % CHUNK]
    }

    #[inline]
    pub fn get_mut(&mut self, index: usize) -> Option<&mut T> {
        self.chunks.get_mut(index / CHUNK)?.get_mut().get_mut(index % CHUNK)
    }

    /// An entry that is there, to be changed.
    #[inline]
    pub fn at_mut(&mut self, index: usize) -> &mut T {
        &mut self.chunks[index / CHUNK].get_mut()[index % CHUNK]
    }

    pub fn truncate(&mut self, length: usize) {
        if length >= self.length {
            return;
        }
        self.length = length;
        self.chunks.truncate(length.div_ceil(CHUNK));
        if let Some(last) = self.chunks.last_mut() {
            last.get_mut().truncate(length - (length - 1) / CHUNK * CHUNK);
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = T> {
        (0..self.length).filter_map(|index| self.get(index))
    }

    /// Gives back the memory of entries that nobody will read any more, as far as whole chunks lie in the range. Gives
    /// the first entry of the range that is still there.
    pub fn release(&self, range: Range<usize>) -> usize {
        let (first, last) = (range.start.div_ceil(CHUNK), range.end / CHUNK);
        for chunk in self.chunks.get(first..last).unwrap_or_default() {
            chunk.take();
        }
        range.start.max(last * CHUNK)
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
        assert!(tape.iter().eq(0..3 * CHUNK + 5));
        for length in [3 * CHUNK + 1, 3 * CHUNK, 3 * CHUNK - 1, CHUNK + 1, CHUNK, 1, 0] {
            tape.truncate(length);
            assert_eq!(tape.len(), length);
            assert_eq!(tape.get(length), None);
            assert!(tape.iter().eq(0..length));
        }
        assert!(tape.is_empty());
        tape.push(7);
        assert_eq!(tape.at(0), 7);
    }

    #[test]
    fn what_is_released_is_whole_chunks() {
        let mut tape = Tape::default();
        tape.extend(0..4 * CHUNK);
        assert_eq!(tape.release(1..CHUNK), CHUNK);
        assert_eq!(tape.release(1..2 * CHUNK + 7), 2 * CHUNK);
        assert_eq!(tape.len(), 4 * CHUNK);
        assert!(tape.iter().eq((0..CHUNK).chain(2 * CHUNK..4 * CHUNK)));
    }
}
