//! Random damage to the bytes of a file, for whatever reads files: shared with the tests of pictures in `tracer-core`.
//!
//! `TRACER_MUTANTS=100000` sets the number of mutants of each kind.

use std::time::{Duration, Instant};

/// Words that mutations put in: numbers at the limits and statements out of place.
const WORDS: [&str; 33] = [
    "nan",
    "inf",
    "1e999",
    "-1e-999",
    "1e30",
    "0",
    "-1",
    "-0",
    "1",
    "99999999999999999999",
    "4294967295",
    "4294967296",
    "2147483648",
    "-2147483649",
    "\\\n",
    "\r\n",
    "\n",
    "#",
    "/",
    "f 1 2 3 1 2 3",
    "usemtl m",
    "v 1 1 1",
    "OFF",
    "\u{feff}",
    "solid",
    "endloop\nendfacet\nendsolid\n",
    "element vertex 3\n",
    "property list uchar int vertex_indices\n",
    "binary_big_endian",
    "end_header\n",
    "{}",
    "],[",
    "\"sparse\":",
];

/// How many mutants of each kind are made.
pub fn mutants() -> usize {
    std::env::var("TRACER_MUTANTS").ok().and_then(|count| count.parse().ok()).unwrap_or(10_000)
}

/// A linear congruential generator (Knuth's MMIX), its upper bits.
pub struct Random(pub u64);

impl Random {
    /// A number below a bound.
    pub fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as usize % bound.max(1)
    }

    fn range(&mut self, length: usize) -> std::ops::Range<usize> {
        let (a, b) = (self.below(length + 1), self.below(length + 1));
        a.min(b)..a.max(b)
    }

    fn mutate(&mut self, original: &[u8]) -> Vec<u8> {
        let mut bytes = original.to_vec();
        for _ in 0..=self.below(4) {
            let at = self.below(bytes.len() + 1);
            match self.below(8) {
                0 => bytes.truncate(at),
                1 => drop(bytes.drain(self.range(original.len().min(bytes.len())))),
                2 => {
                    let range = self.range(bytes.len());
                    let part = bytes[range].to_vec();
                    bytes.splice(at..at, part);
                }
                3 | 4 => {
                    let word = WORDS[self.below(WORDS.len())];
                    bytes.splice(at..at, word.bytes());
                }
                5 => bytes.insert(at, self.below(256) as u8),
                _ => {
                    let value = self.below(256) as u8;
                    if let Some(byte) = bytes.get_mut(at) {
                        *byte = if value.is_multiple_of(2) { value } else { *byte ^ (1 << (value % 8)) };
                    }
                }
            }
            bytes.truncate(1 << 16);
        }
        bytes
    }
}

/// Runs all mutants of one file, and says how many were read without an error: some must, else the test tests nothing.
pub fn run(seed: u64, count: usize, original: &[u8], mut test: impl FnMut(&[u8]) -> bool) -> usize {
    let mut random = Random(seed);
    let mut good = 0;
    for number in 0..count {
        let bytes = random.mutate(original);
        let mut soon = |right: &mut bool| {
            let start = Instant::now();
            *right = test(&bytes);
            start.elapsed() < Duration::from_secs(1)
        };
        // Files of a few KB: a second is a thousand times what they take. What takes longer is tried again, for the
        // machine may be busy with other things.
        let mut right = false;
        let in_time = (0..4).any(|_| soon(&mut right));
        assert!(in_time, "mutant {number}: {:?}", String::from_utf8_lossy(&bytes));
        good += usize::from(right);
    }
    good
}
