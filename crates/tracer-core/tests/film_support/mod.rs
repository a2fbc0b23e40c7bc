//! Damage to the files of films.
//!
//! `FILM_MUTANTS=1000000` sets the number of mutants of each kind.

use std::time::{Duration, Instant};
use xxhash_rust::xxh3::xxh3_64;

/// A linear congruential generator (Knuth's MMIX), its upper bits.
pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        (self.0 >> 33) as usize % most
    }
}

/// A film's file, to be damaged.
pub struct Victim<'a> {
    file: &'a [u8],
    /// Bytes before the first checksum.
    head: usize,
}

impl<'a> Victim<'a> {
    pub fn new(file: &'a [u8]) -> Self {
        Victim { file, head: 16 + u32::from_le_bytes([file[12], file[13], file[14], file[15]]) as usize }
    }

    /// Hands out mutants, so many by default: each as it is, which must be refused, and as somebody has made it who
    /// knows checksums. None may take long.
    pub fn each(&self, default: usize, refused: impl Fn(&[u8]) -> bool, mut read: impl FnMut(&[u8])) {
        let count = std::env::var("FILM_MUTANTS").ok().and_then(|count| count.parse().ok()).unwrap_or(default);
        let mut random = Random(1);
        for k in 0..count {
            let mut mutant = self.mutant(k, &mut random);
            if mutant == self.file {
                continue;
            }
            let start = Instant::now();
            assert!(refused(&mutant), "{k}");
            if mutant.len() > self.head + 16 {
                let sum = xxh3_64(&mutant[..self.head]).to_le_bytes();
                mutant[self.head..self.head + 8].copy_from_slice(&sum);
                let end = mutant.len() - 8;
                let sum = xxh3_64(&mutant[..end]).to_le_bytes();
                mutant[end..].copy_from_slice(&sum);
                read(&mutant);
            }
            // Some milliseconds on a free machine.
            assert!(start.elapsed() < Duration::from_secs(10), "{k} takes {:?}", start.elapsed());
        }
    }

    fn mutant(&self, k: usize, random: &mut Random) -> Vec<u8> {
        let mut mutant = self.file.to_vec();
        // Half of them in the head, which is small.
        let place = random.below(if k.is_multiple_of(2) { self.head } else { mutant.len() });
        let end = (place + 1 + random.below(40)).min(mutant.len());
        match k % 7 {
            0 => mutant[place] ^= 1 << random.below(8),
            1 => mutant[place] = 0xff,
            2 => mutant.iter_mut().skip(place).take(4).for_each(|byte| *byte = 0xff),
            3 => drop(mutant.drain(place..end)),
            4 => mutant.insert(place, random.below(256) as u8),
            // What stands elsewhere in it: a number of another tile, a whole record.
            5 => {
                let from = random.below(mutant.len() - (end - place));
                mutant.copy_within(from..from + (end - place), place);
            }
            _ => (0..1 + random.below(4)).for_each(|_| {
                let place = random.below(mutant.len());
                mutant[place] = [0, 1, 0x7f, 0x80, 0xfe, 0xff][random.below(6)];
            }),
        }
        mutant
    }
}
