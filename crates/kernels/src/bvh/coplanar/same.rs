//! Triangles that are the same: a `Repeat` whose items do not go by its index makes thousands of them.
//!
//! Where one of them is passed all are, so that the first stands for those beyond the first few: these win over
//! nothing, and have the winners that it has, and it.

use super::find::Face;
use rayon::prelude::*;
use std::hash::{DefaultHasher, Hash, Hasher};

/// So many of the same are kept: bodies of glass that touch may need more than one.
const KEPT: usize = 8;

/// Those that another one stands for.
#[derive(Default)]
pub(super) struct Same {
    /// Each with the one that stands for it.
    pub pairs: Vec<(u32, u32)>,
    /// By triangle; empty where there are none.
    stood_for: Vec<bool>,
}

impl Same {
    pub fn of(faces: &[Face]) -> Self {
        if faces.len() <= KEPT {
            return Self::default();
        }
        let hash = |face: &Face| {
            let mut hasher = DefaultHasher::new();
            corners(face).hash(&mut hasher);
            hasher.finish()
        };
        let triangles = (0..faces.len()).into_par_iter().filter(|&k| faces[k].curved.is_none());
        let mut order: Vec<(u64, u32)> = triangles.map(|k| (hash(&faces[k]), k as u32)).collect();
        order.par_sort_unstable();
        let mut same = Self::default();
        for alike in order.chunk_by(|a, b| a.0 == b.0).filter(|alike| alike.len() > KEPT) {
            let mut ids: Vec<u32> = alike.iter().map(|&(_, k)| k).collect();
            ids.sort_unstable_by_key(|&k| faces[k as usize].order());
            let winner = ids[0];
            let of_winner = corners(&faces[winner as usize]);
            ids.retain(|&k| corners(&faces[k as usize]) == of_winner);
            same.pairs.extend(ids.iter().skip(KEPT).map(|&k| (k, winner)));
        }
        if !same.pairs.is_empty() {
            same.stood_for = vec![false; faces.len()];
            same.pairs.iter().for_each(|&(k, _)| same.stood_for[k as usize] = true);
        }
        same
    }

    /// Whether another one stands for a triangle.
    pub fn stood_for(&self, k: u32) -> bool {
        self.stood_for.get(k as usize).is_some_and(|stood_for| *stood_for)
    }
}

/// The corners in an order of their own.
fn corners(face: &Face) -> [[u64; 3]; 3] {
    let mut corners = face.corners.map(|corner| corner.to_array().map(f64::to_bits));
    corners.sort_unstable();
    corners
}

/// The pairs of triangles too narrow to have a plane, those from `first` on, whose corners are the same, winner first.
pub(super) fn identical(faces: &[Face], first: usize) -> Vec<(u32, u32, f64)> {
    let mut order: Vec<_> = (first..faces.len()).into_par_iter().map(|k| (corners(&faces[k]), k as u32)).collect();
    order.par_sort_unstable();
    let mut pairs = Vec::new();
    for same in order.chunk_by(|a, b| a.0 == b.0) {
        let ids = || same.iter().map(|&(_, k)| k);
        // Who wins, wins everywhere.
        let Some(winner) = ids().min_by_key(|&k| faces[k as usize].order()) else { continue };
        let gap = 2.0 * faces[winner as usize].error;
        pairs.extend(ids().filter(|&k| k != winner).map(|loser| (winner, loser, gap)));
    }
    pairs
}
