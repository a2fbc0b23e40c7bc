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
use isa::Isa16;
use query::{AnyHit, Closest, Goal};
pub use query::{Batch, MeshRecord, TreeView};

/// Entries of a traversal stack: seven siblings a node on the way down, and the marks.
pub const STACK: usize = 576;

/// The deepest tree, both levels together, whose traversal fits the stack: 7 siblings a node, a mark on each level,
/// and 8 entries of room for a whole vector to be stored.
pub const DEEPEST: usize = (STACK - 10) / 7;

/// Rays under way at a time: enough to hide a miss to memory, few enough for their state to stay in L1; and one for each
/// lane of [`WordLanes`](isa::WordLanes), which the rounds of `interleaved` rely on.
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

/// Closest hits, counting only where `COUNT`.
pub fn closest<const COUNT: bool>(
    level: Level,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    hits: &mut Hits,
    counters: &mut Counters,
) {
    trace::<_, COUNT>(level, coherence, tree, batch, &mut Closest { hits }, counters);
}

/// Occlusion, counting only where `COUNT`.
pub fn occluded<const COUNT: bool>(
    level: Level,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    occlusion: &mut Occlusion,
    counters: &mut Counters,
) {
    trace::<_, COUNT>(level, coherence, tree, batch, &mut AnyHit { occlusion }, counters);
}

#[allow(unsafe_code)]
fn trace<G: Goal, const COUNT: bool>(
    level: Level,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    match level.set() {
        Set::Portable => kernel::<_, G, COUNT>(portable::Portable, coherence, tree, batch, goal, counters),
        #[cfg(not(target_arch = "x86_64"))]
        Set::Portable8 => kernel::<_, G, COUNT>(portable::Portable, coherence, tree, batch, goal, counters),
        // SAFETY: a `Level` of this set exists only where the processor has its instructions.
        #[cfg(target_arch = "x86_64")]
        Set::Scalar => unsafe { kernel_fma::<G, COUNT>(coherence, tree, batch, goal, counters) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Set::Avx2 => unsafe { kernel_avx2::<G, COUNT>(coherence, tree, batch, goal, counters) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Set::Avx512 => unsafe { kernel_avx512::<G, COUNT>(coherence, tree, batch, goal, counters) },
    }
}

#[inline(always)]
fn kernel<I: Isa16, G: Goal, const COUNT: bool>(
    isa: I,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    match coherence {
        Coherence::Incoherent => interleaved::trace::<I, G, COUNT>(isa, tree, batch, goal, counters),
        Coherence::Coherent => packet::trace::<I, G, COUNT>(isa, tree, batch, goal, counters),
    }
}

/// The portable kernel, whose fused multiplications become one instruction each here and a call of a library elsewhere.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "fma")]
fn kernel_fma<G: Goal, const COUNT: bool>(
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    kernel::<_, G, COUNT>(portable::Portable, coherence, tree, batch, goal, counters);
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt,lzcnt")]
fn kernel_avx2<G: Goal, const COUNT: bool>(
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    // SAFETY: this function runs only where the processor has its features.
    let isa = unsafe { avx2::Avx2::new() };
    kernel::<_, G, COUNT>(isa, coherence, tree, batch, goal, counters);
}

#[cfg(target_arch = "x86_64")]
#[allow(unsafe_code)]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi1,bmi2,popcnt,lzcnt")]
fn kernel_avx512<G: Goal, const COUNT: bool>(
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    // SAFETY: this function runs only where the processor has its features.
    let isa = unsafe { avx512::Avx512::new() };
    kernel::<_, G, COUNT>(isa, coherence, tree, batch, goal, counters);
}
