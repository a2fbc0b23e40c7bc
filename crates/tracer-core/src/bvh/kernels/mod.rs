//! The traversal kernels: the only place of the tree with `unsafe`.
//!
//! Kernels are written once over [`Isa`](isa::Isa) and compiled for each [`Level`] in an entry function that carries
//! its target features. One dispatch a batch.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod interleaved;
mod isa;
mod leaves;
mod packet;
mod packet_space;
mod portable;
mod query;

use super::{Coherence, Hits, Occlusion};
use isa::Isa16;
use query::{AnyHit, Closest, Goal};
pub(crate) use query::{Batch, MeshRecord, TreeView};

/// Entries of a traversal stack: seven siblings a node on the way down, and the marks.
pub(crate) const STACK: usize = 576;

/// The deepest tree, both levels together, whose traversal fits the stack: 7 siblings a node, a mark on each level,
/// and 8 entries of room for a whole vector to be stored.
pub(crate) const DEEPEST: usize = (STACK - 10) / 7;

/// Rays under way at a time: enough to hide a miss to memory, few enough for their state to stay in L1; and one for each
/// lane of [`WordLanes`](isa::WordLanes), which the rounds of `interleaved` rely on.
const IN_FLIGHT: usize = 16;

/// An instruction set to trace with. All give the same bits; values exist only for those that this processor has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Level(Set);

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Set {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Level {
    /// The levels of this processor, slowest first.
    pub fn supported() -> Vec<Self> {
        let mut levels = vec![Self(Set::Portable)];
        #[cfg(target_arch = "x86_64")]
        {
            let avx2 = is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("fma")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
                && is_x86_feature_detected!("popcnt")
                && is_x86_feature_detected!("lzcnt");
            if avx2 {
                levels.push(Self(Set::Avx2));
            }
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw");
            if avx2 && avx512 {
                levels.push(Self(Set::Avx512));
            }
        }
        levels
    }

    /// The fastest level of this processor.
    pub fn best() -> Self {
        Self::supported().last().copied().unwrap_or(Self(Set::Portable))
    }

    /// `portable`, `avx2` or `avx512`.
    pub fn name(self) -> &'static str {
        match self.0 {
            Set::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => "avx2",
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => "avx512",
        }
    }
}

/// What traversals did, summed over rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Nodes of eight boxes tested.
    pub nodes: u64,
    /// Leaves of up to four triangles tested.
    pub triangle_leaves: u64,
    /// Leaves of up to four spheres tested.
    pub sphere_leaves: u64,
    /// Instances entered.
    pub instances: u64,
}

/// Closest hits, counting only where `COUNT`.
pub(crate) fn closest<const COUNT: bool>(
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
pub(crate) fn occluded<const COUNT: bool>(
    level: Level,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    occlusion: &mut Occlusion,
    counters: &mut Counters,
) {
    trace::<_, COUNT>(level, coherence, tree, batch, &mut AnyHit { occlusion }, counters);
}

fn trace<G: Goal, const COUNT: bool>(
    level: Level,
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    match level.0 {
        Set::Portable => kernel::<_, G, COUNT>(portable::Portable, coherence, tree, batch, goal, counters),
        // SAFETY: a `Level` of this set exists only where the processor has its instructions (`Level::supported`).
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

/// # Safety
/// The processor has these features.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,popcnt,lzcnt")]
unsafe fn kernel_avx2<G: Goal, const COUNT: bool>(
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    // SAFETY: the caller's promise.
    let isa = unsafe { avx2::Avx2::new() };
    kernel::<_, G, COUNT>(isa, coherence, tree, batch, goal, counters);
}

/// # Safety
/// The processor has these features.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx512bw,avx2,fma,bmi1,bmi2,popcnt,lzcnt")]
unsafe fn kernel_avx512<G: Goal, const COUNT: bool>(
    coherence: Coherence,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
) {
    // SAFETY: the caller's promise.
    let isa = unsafe { avx512::Avx512::new() };
    kernel::<_, G, COUNT>(isa, coherence, tree, batch, goal, counters);
}
