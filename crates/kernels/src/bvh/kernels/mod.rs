//! The traversal kernels: the only place of the tree with `unsafe`.
//!
//! Kernels are written once over [`Isa`](isa::Isa) and compiled for each [`Level`] in an entry function that carries
//! its target features. One dispatch a batch.

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod avx2;
#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
mod avx512;
#[allow(unsafe_code)]
mod interleaved;
#[allow(unsafe_code)]
mod isa;
#[allow(unsafe_code)]
mod leaves;
#[allow(unsafe_code)]
mod packet;
#[allow(unsafe_code)]
mod packet_space;
#[allow(unsafe_code)]
mod portable;
mod query;

use super::{Coherence, Hits, Occlusion};
use crate::level::{Level, Set};
use query::{AnyHit, Closest, Goal};
pub use query::{Batch, MeshRecord, TreeView};

/// Entries of a traversal stack: seven siblings a node on the way down, and the marks.
pub const STACK: usize = 576;

/// The deepest tree, both levels together, whose traversal fits the stack: 7 siblings a node, a mark on each level,
/// and 8 entries of room for a whole vector to be stored.
pub const DEEPEST: usize = (STACK - 10) / 7;

/// Rays under way at a time: enough to hide a miss to memory, few enough for their state to stay in L1; and one for
/// each lane of [`WordLanes`](isa::WordLanes), which the rounds of `interleaved` rely on.
const IN_FLIGHT: usize = 16;

/// What traversals did, summed over rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Nodes of eight boxes tested.
    pub nodes: u64,
    /// Leaves of up to four triangles tested.
    pub triangle_leaves: u64,
    /// Leaves of up to four spheres, or of one other shape, tested.
    pub sphere_leaves: u64,
    /// Instances entered.
    pub instances: u64,
}

/// Closest hits; counts what it does.
pub fn closest(
    level: Level,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    hits: &mut Hits,
    counters: &mut Counters,
) {
    trace(level, coherence, tree, batch, &mut Closest { hits }, counters);
}

/// Occlusion; counts what it does.
pub fn occluded(
    level: Level,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    occlusion: &mut Occlusion,
    counters: &mut Counters,
) {
    trace(level, coherence, tree, batch, &mut AnyHit { occlusion }, counters);
}

/// Packets gain where sixteen lanes are one or two instructions. Without them they are code alone: unrolled by the
/// compiler, a quarter of a megabyte for each question.
#[allow(unsafe_code)]
fn trace<G: Goal>(
    level: Level,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    match (level.set(), coherence) {
        (Set::Portable, _) => one_by_one_portable(tree, batch, goal, counters),
        #[cfg(not(target_arch = "x86_64"))]
        (Set::Portable8, _) => one_by_one_portable(tree, batch, goal, counters),
        // SAFETY: a `Level` of this set exists only where the processor has its instructions.
        #[cfg(target_arch = "x86_64")]
        (Set::Scalar, _) => unsafe { one_by_one_fma(tree, batch, goal, counters) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        (Set::Avx2, Coherence::Incoherent) => unsafe { one_by_one_avx2(tree, batch, goal, counters) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        (Set::Avx2, Coherence::Coherent) => unsafe { packets_avx2(tree, batch, goal, counters) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        (Set::Avx512, Coherence::Incoherent) => unsafe { one_by_one_avx512(tree, batch, goal, counters) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        (Set::Avx512, Coherence::Coherent) => unsafe { packets_avx512(tree, batch, goal, counters) },
    }
}

fn one_by_one_portable<G: Goal>(tree: &TreeView, batch: Batch, goal: &mut G, counters: &mut Counters) {
    interleaved::trace(portable::Portable, tree, batch, goal, counters);
}

/// The portable kernel, whose fused multiplications become one instruction each here and a call of a library elsewhere.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "fma")]
fn one_by_one_fma<G: Goal>(tree: &TreeView, batch: Batch, goal: &mut G, counters: &mut Counters) {
    interleaved::trace(portable::Portable, tree, batch, goal, counters);
}

/// Both ways through the tree with the instructions of a level.
#[cfg(target_arch = "x86_64")]
macro_rules! kernels {
    ($one_by_one:ident, $packets:ident, $isa:ty, $features:literal) => {
        #[allow(unsafe_code)]
        #[inline(never)]
        #[target_feature(enable = $features)]
        fn $one_by_one<G: Goal>(tree: &TreeView, batch: Batch, goal: &mut G, counters: &mut Counters) {
            // SAFETY: this function runs only where the processor has its features.
            let isa = unsafe { <$isa>::new() };
            interleaved::trace(isa, tree, batch, goal, counters);
        }

        #[allow(unsafe_code)]
        #[target_feature(enable = $features)]
        fn $packets<G: Goal>(tree: &TreeView, batch: Batch, goal: &mut G, counters: &mut Counters) {
            // SAFETY: this function runs only where the processor has its features.
            let isa = unsafe { <$isa>::new() };
            packet::trace(isa, tree, batch, goal, counters, |rest, goal, counters| {
                $one_by_one(tree, rest, goal, counters);
            });
        }
    };
}

#[cfg(target_arch = "x86_64")]
kernels!(one_by_one_avx2, packets_avx2, avx2::Avx2, "avx2,fma,bmi1,bmi2,popcnt,lzcnt");
#[cfg(target_arch = "x86_64")]
kernels!(
    one_by_one_avx512,
    packets_avx512,
    avx512::Avx512,
    "avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi1,bmi2,popcnt,lzcnt"
);
