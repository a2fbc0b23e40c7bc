//! Where the time of a rendering goes, and how well lanes and tree are used.

use std::time::Instant;

/// The stages of a batch, in the order of their first turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Camera rays.
    Camera,
    /// Rays against the spheres that every ray tests, closest hits and shadows.
    Spheres,
    /// Which rays the tree is asked about.
    Reach,
    /// Closest hits in the tree.
    Closest,
    /// What camera rays hit first, where the picture has layers.
    Layers,
    /// Surfaces, materials, lights and the next rays.
    Shade,
    /// Shadow rays, and segments between pixels, in the tree.
    Occluded,
    /// Light of shadow rays to their pixels.
    Deposit,
    /// Photons: from the lights, over mirrors and glass, and into a guide.
    Photons,
    /// Which rays are aimed, and where.
    Aim,
    /// What pixels share: which segments, and each one's part.
    Share,
    /// Samples onto the film.
    Film,
}

impl Stage {
    /// All of them.
    pub const ALL: [Stage; 12] = [
        Stage::Camera,
        Stage::Spheres,
        Stage::Reach,
        Stage::Closest,
        Stage::Layers,
        Stage::Shade,
        Stage::Occluded,
        Stage::Deposit,
        Stage::Photons,
        Stage::Aim,
        Stage::Share,
        Stage::Film,
    ];

    /// One word.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Camera => "camera",
            Stage::Spheres => "spheres",
            Stage::Reach => "reach",
            Stage::Closest => "closest",
            Stage::Layers => "layers",
            Stage::Shade => "shade",
            Stage::Occluded => "occluded",
            Stage::Deposit => "deposit",
            Stage::Photons => "photons",
            Stage::Aim => "aim",
            Stage::Share => "share",
            Stage::Film => "film",
        }
    }
}

/// What the tree did for a sample of the batches.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TreeWork {
    /// Rays it was asked about.
    pub rays: u64,
    /// Nodes of eight boxes tested.
    pub nodes: u64,
    /// Leaves tested.
    pub leaves: u64,
}

impl TreeWork {
    pub(crate) fn add(&mut self, rays: usize, counters: &crate::bvh::Counters) {
        self.rays += rays as u64;
        self.nodes += counters.nodes;
        self.leaves += counters.triangle_leaves + counters.sphere_leaves;
    }
}

/// Where the time went, summed over threads.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Seconds of each stage, as in [`Stage::ALL`].
    pub seconds: [f64; Stage::ALL.len()],
    /// Vertices of paths shaded.
    pub vertices: u64,
    /// Lanes that this took, those without a path included.
    pub lanes: u64,
    /// Closest hits.
    pub closest: TreeWork,
    /// Shadow rays and segments.
    pub occluded: TreeWork,
}

impl Statistics {
    /// Adds another thread's.
    pub(crate) fn add(&mut self, other: &Statistics) {
        for (sum, seconds) in self.seconds.iter_mut().zip(other.seconds) {
            *sum += seconds;
        }
        self.vertices += other.vertices;
        self.lanes += other.lanes;
        for (sum, work) in [(&mut self.closest, other.closest), (&mut self.occluded, other.occluded)] {
            sum.rays += work.rays;
            sum.nodes += work.nodes;
            sum.leaves += work.leaves;
        }
    }
}

/// What the switches of a rendering cost: seconds summed over threads. Always kept: the clock is looked at twice per batch and step.
/// What shading does for them (vertices remembered for sharing and aiming) is not in it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Costs {
    /// All work: paths, their samples onto the film, photons.
    pub total: f64,
    /// What pixels share: which segments, what blocks them, and each one's part.
    pub reuse: f64,
    /// Photons from the lights into guides, and which rays are aimed, but not their tracing. Glint chains.
    pub caustics: f64,
    /// Samples scaled down.
    pub clamp: f64,
}

impl Costs {
    /// Adds another thread's.
    pub(crate) fn add(&mut self, other: &Costs) {
        self.total += other.total;
        self.reuse += other.reuse;
        self.caustics += other.caustics;
        self.clamp += other.clamp;
    }

    /// All time since then was spent on photons and their guides.
    pub(crate) fn photons_since(&mut self, start: Instant) {
        let seconds = start.elapsed().as_secs_f64();
        self.total += seconds;
        self.caustics += seconds;
    }
}

/// Every so many batches the tree counts what it does, which costs it a few per cent.
const COUNTED: u32 = 64;

/// Keeps the statistics of a thread, or nothing.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    last: Option<Instant>,
    batches: u32,
    pub statistics: Statistics,
    /// Kept whether statistics are or not.
    pub costs: Costs,
}

impl Watch {
    /// Starts the time of a batch; `on`: there is somebody to tell.
    pub fn start(&mut self, on: bool) {
        self.last = on.then(Instant::now);
        self.batches = self.batches.wrapping_add(1);
    }

    /// Goes on after other work, if statistics are kept.
    pub fn resume(&mut self) {
        self.last = self.last.map(|_| Instant::now());
    }

    /// Whether statistics are kept.
    pub fn is_on(&self) -> bool {
        self.last.is_some()
    }

    /// Whether the tree is to count in this batch.
    pub fn counts_tree(&self) -> bool {
        self.is_on() && self.batches % COUNTED == 1
    }

    /// All time since the last lap was spent on this stage.
    pub fn lap(&mut self, stage: Stage) {
        if let Some(last) = &mut self.last {
            let now = Instant::now();
            self.statistics.seconds[stage as usize] += now.duration_since(*last).as_secs_f64();
            *last = now;
        }
    }

    /// So many paths were shaded, over so many lanes at a time.
    pub fn shaded(&mut self, paths: usize, lanes: usize) {
        if self.is_on() {
            self.statistics.vertices += paths as u64;
            self.statistics.lanes += paths.next_multiple_of(lanes) as u64;
        }
    }
}
