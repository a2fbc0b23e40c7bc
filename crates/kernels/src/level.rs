//! Which vector instructions the stages and the tree are run with: found once, at run time. The picture is the same
//! for all of them.

use std::fmt;

/// A way of running the stages and the tree that this CPU was seen to support. Values come from [`Level::available`],
/// [`Level::best`], [`Level::from_lanes`], [`Level::from_name`] and [`Level::PORTABLE`] only: that one exists proves
/// that the CPU has its instructions.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Level(Set);

/// What there is to choose from. Public to this crate for matching; only this module makes a [`Level`] of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Set {
    /// One lane, no CPU feature asked for; without hardware fma, slow.
    Portable,
    /// Eight lanes in arrays, left to the compiler.
    #[cfg(not(target_arch = "x86_64"))]
    Portable8,
    /// One lane with hardware fma.
    #[cfg(target_arch = "x86_64")]
    Scalar,
    /// Eight lanes: AVX2, FMA, BMI 1 and 2, LZCNT, POPCNT.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// Sixteen lanes: AVX-512 F, VL, DQ, BW, CD, and all of the above.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Level {
    /// The level that every CPU has: one lane, no instruction asked for. Slow where the CPU has better.
    pub const PORTABLE: Level = Level(Set::Portable);

    /// The levels that this CPU supports, the fastest first.
    pub fn available() -> Vec<Level> {
        let mut levels = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            let fma = is_x86_feature_detected!("fma");
            let avx2 = fma
                && is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("bmi2")
                && is_x86_feature_detected!("lzcnt")
                && is_x86_feature_detected!("popcnt");
            if avx2
                && is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512vl")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512bw")
                && is_x86_feature_detected!("avx512cd")
            {
                levels.push(Level(Set::Avx512));
            }
            if avx2 {
                levels.push(Level(Set::Avx2));
            }
            if fma {
                levels.push(Level(Set::Scalar));
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        levels.push(Level(Set::Portable8));
        levels.push(Level::PORTABLE);
        levels
    }

    /// The fastest level.
    pub fn best() -> Level {
        Level::available().first().copied().unwrap_or(Level::PORTABLE)
    }

    /// The fastest level with this many lanes, if this CPU has one.
    pub fn from_lanes(lanes: usize) -> Option<Level> {
        Level::available().into_iter().find(|l| l.lanes() == lanes)
    }

    /// The level of this [`name`](Level::name), if this CPU has it.
    pub fn from_name(name: &str) -> Option<Level> {
        Level::available().into_iter().find(|l| l.name() == name)
    }

    /// Number of lanes.
    pub fn lanes(self) -> usize {
        match self.0 {
            Set::Portable => 1,
            #[cfg(not(target_arch = "x86_64"))]
            Set::Portable8 => 8,
            #[cfg(target_arch = "x86_64")]
            Set::Scalar => 1,
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => 8,
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => 16,
        }
    }

    /// A name for reports.
    pub fn name(self) -> &'static str {
        match self.0 {
            Set::Portable => "portable, 1 lane",
            #[cfg(not(target_arch = "x86_64"))]
            Set::Portable8 => "portable, 8 lanes",
            #[cfg(target_arch = "x86_64")]
            Set::Scalar => "FMA, 1 lane",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => "AVX2, 8 lanes",
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => "AVX-512, 16 lanes",
        }
    }

    /// The kernels that it stands for.
    pub fn set(self) -> Set {
        self.0
    }
}

impl fmt::Debug for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Level({})", self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cpu_has_the_portable_level_and_best_is_the_first() {
        let levels = Level::available();
        assert_eq!(levels.last(), Some(&Level::PORTABLE));
        assert_eq!(levels.first(), Some(&Level::best()));
        for level in levels {
            assert_eq!(Level::from_name(level.name()), Some(level));
            assert!(Level::from_lanes(level.lanes()).is_some_and(|found| found.lanes() == level.lanes()));
        }
        assert_eq!((Level::from_name("AVX-1024"), Level::from_lanes(3)), (None, None));
    }
}
