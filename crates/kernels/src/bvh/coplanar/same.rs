//! Triangles, and bodies, that are the same: a `Repeat` whose items do not go by its index makes thousands of them.
//!
//! Where one of them is passed all are, so that the first stands for those beyond the first few: these win over
//! nothing, and have the winners that it has, and it. Bodies that let light through and are of the same triangles are
//! one: light does not pass into both where it passes into the first.

use super::TRANSMITS;
use super::find::Face;
use rayon::prelude::*;
use std::collections::BTreeMap;
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

/// Bodies that let light through and are in one place, as pairs of instances, rising: all triangles of both are in
/// pairs that have the same corners, with their insides on the same side.
pub(super) fn bodies_in_one_place(faces: &[Face], pairs: &[(u32, u32, f64)]) -> Vec<[u32; 2]> {
    let same = |&&(one, other, _): &&(u32, u32, f64)| {
        let (one, other) = (&faces[one as usize], &faces[other as usize]);
        let transmit = one.rank == TRANSMITS && other.rank == TRANSMITS && one.instance != other.instance;
        let flat = one.curved.is_none() && other.curved.is_none();
        let alike = one.outward.zip(other.outward).is_some_and(|(a, b)| a.dot(b) > 0.0);
        transmit && flat && alike && corners(one) == corners(other)
    };
    let mut both: Vec<[u32; 2]> =
        pairs.iter().filter(same).map(|pair| bodies(&faces[pair.0 as usize], &faces[pair.1 as usize])).collect();
    both.sort_unstable();
    let mut counts: BTreeMap<u32, usize> = BTreeMap::new();
    if !both.is_empty() {
        faces.iter().for_each(|face| *counts.entry(face.instance).or_default() += 1);
    }
    let of_same = both.chunk_by(|a, b| a == b);
    let whole = of_same.filter(|of| of[0].iter().all(|body| counts.get(body) == Some(&of.len())));
    whole.map(|of| of[0]).collect()
}

/// The bodies of two triangles.
pub(super) fn bodies(one: &Face, other: &Face) -> [u32; 2] {
    [one.instance.min(other.instance), one.instance.max(other.instance)]
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
