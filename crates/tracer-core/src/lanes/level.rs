//! Which lane type a CPU runs: found once, at run time. The picture is the same for all of them.

/// A way of running the stages that this CPU was seen to support: values come from [`Level::available`] and [`Level::from_lanes`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Level {
    /// One lane, no CPU feature asked for; without hardware fma, slow.
    Portable,
    /// Eight lanes in arrays, left to the compiler.
    #[cfg(not(target_arch = "x86_64"))]
    Portable8,
    /// One lane with hardware fma.
    #[cfg(target_arch = "x86_64")]
    Scalar,
    /// Eight lanes, AVX2 and FMA.
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// Sixteen lanes, AVX-512 F, VL, DQ, BW, CD.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

impl Level {
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
                levels.push(Level::Avx512);
            }
            if avx2 {
                levels.push(Level::Avx2);
            }
            if fma {
                levels.push(Level::Scalar);
            }
        }
        #[cfg(not(target_arch = "x86_64"))]
        levels.push(Level::Portable8);
        levels.push(Level::Portable);
        levels
    }

    /// The fastest level.
    pub fn best() -> Level {
        Level::available()[0]
    }

    /// The fastest level with this many lanes, if this CPU has one.
    pub fn from_lanes(lanes: usize) -> Option<Level> {
        Level::available().into_iter().find(|l| l.lanes() == lanes)
    }

    /// Number of lanes.
    pub fn lanes(self) -> usize {
        match self {
            Level::Portable => 1,
            #[cfg(not(target_arch = "x86_64"))]
            Level::Portable8 => 8,
            #[cfg(target_arch = "x86_64")]
            Level::Scalar => 1,
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => 8,
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => 16,
        }
    }

    /// A name for reports.
    pub fn name(self) -> &'static str {
        match self {
            Level::Portable => "portable, 1 lane",
            #[cfg(not(target_arch = "x86_64"))]
            Level::Portable8 => "portable, 8 lanes",
            #[cfg(target_arch = "x86_64")]
            Level::Scalar => "FMA, 1 lane",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "AVX2, 8 lanes",
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "AVX-512, 16 lanes",
        }
    }
}
