//! The work of a pass, dealt out in batches.

use crate::film::Piece;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The batches of a pass, for whichever thread is free.
pub struct Deal {
    pieces: Vec<Piece>,
    /// Number of each piece's first batch, and of all.
    firsts: Vec<usize>,
    per_batch: u32,
    next: AtomicUsize,
    returned: Mutex<Vec<Piece>>,
}

impl Deal {
    /// So many places a batch.
    pub fn new(pieces: Vec<Piece>, per_batch: u32) -> Self {
        let mut firsts = vec![0];
        for Piece { places, .. } in &pieces {
            firsts.push(firsts[firsts.len() - 1] + places.len().div_ceil(per_batch as usize));
        }
        Deal { pieces, firsts, per_batch, next: AtomicUsize::new(0), returned: Mutex::default() }
    }

    /// Each of them a batch.
    pub fn of_batches(pieces: Vec<Piece>) -> Self {
        let firsts = (0..=pieces.len()).collect();
        Deal { pieces, firsts, per_batch: u32::MAX, next: AtomicUsize::new(0), returned: Mutex::default() }
    }

    /// Whether there is nothing to do.
    pub fn is_empty(&self) -> bool {
        self.pieces.is_empty()
    }

    /// The next batch.
    pub fn take(&self) -> Option<Piece> {
        let k = self.next.fetch_add(1, Ordering::Relaxed);
        let piece = self.firsts.partition_point(|&first| first <= k) - 1;
        let Piece { places, samples } = self.pieces.get(piece)?;
        let start = places.start + (k - self.firsts[piece]) as u32 * self.per_batch;
        let end = places.end.min(start.saturating_add(self.per_batch));
        Some(Piece { places: start..end, samples: samples.clone() })
    }

    /// What of a batch was not done.
    pub fn give_back(&self, piece: Piece) {
        self.returned.lock().unwrap_or_else(|poisoned| poisoned.into_inner()).push(piece);
    }

    /// What has not been taken or was given back.
    pub fn left(self) -> Vec<Piece> {
        let taken = self.next.into_inner();
        let mut left = self.returned.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner());
        for (Piece { places, samples }, &first) in self.pieces.iter().zip(&self.firsts) {
            let of_it = u32::try_from(taken.saturating_sub(first)).unwrap_or(u32::MAX);
            let start = places.start.saturating_add(of_it.saturating_mul(self.per_batch));
            if start < places.end {
                left.push(Piece { places: start..places.end, samples: samples.clone() });
            }
        }
        left
    }
}

/// Pieces and those that come after them, as one where they follow each other.
pub fn joined(mut pieces: Vec<Piece>, later: Vec<Piece>) -> Vec<Piece> {
    for piece in later {
        match pieces.last_mut().filter(|last| last.places.end == piece.places.start && last.samples == piece.samples) {
            Some(last) => last.places.end = piece.places.end,
            None => pieces.push(piece),
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::Range;

    #[test]
    fn what_is_dealt_and_what_is_left_is_all() {
        let piece = |places: Range<u32>, samples: Range<u32>| Piece { places, samples };
        let pieces = vec![piece(3..8, 4..6), piece(9..10, 5..6), piece(12..20, 4..6)];
        let mut all: Vec<(u32, u32)> = Vec::new();
        let add = |all: &mut Vec<(u32, u32)>, pieces: &[Piece]| {
            for Piece { places, samples } in pieces {
                all.extend(places.clone().flat_map(|place| samples.clone().map(move |sample| (place, sample))));
            }
            all.sort_unstable();
        };
        add(&mut all, &pieces);
        for per_batch in [1, 2, 4] {
            for taken in 0..20 {
                let deal = Deal::new(pieces.clone(), per_batch);
                let mut found = Vec::new();
                for k in 0..taken {
                    match deal.take() {
                        Some(piece) if k % 3 == 1 => deal.give_back(piece),
                        Some(piece) => add(&mut found, &[piece]),
                        None => {}
                    }
                }
                add(&mut found, &deal.left());
                assert_eq!(found, all, "{per_batch} {taken}");
            }
        }
    }
}
