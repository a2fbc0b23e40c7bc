//! What a rendering counted and what it cost: where the time goes, and how well lanes and tree are used.

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

/// What the tree did.
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
    /// Adds what the tree did for so many rays.
    pub fn add(&mut self, rays: usize, counters: &crate::bvh::Counters) {
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
    pub fn add(&mut self, other: &Statistics) {
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

/// What the switches of a rendering cost: seconds summed over threads. Always kept: the clock is looked at twice per
/// batch and step. What shading does for them (vertices remembered for sharing and aiming) is not in it.
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
    pub fn add(&mut self, other: &Costs) {
        self.total += other.total;
        self.reuse += other.reuse;
        self.caustics += other.caustics;
        self.clamp += other.clamp;
    }

    /// All time since then was spent on photons and their guides.
    pub fn photons_since(&mut self, start: Instant) {
        let seconds = start.elapsed().as_secs_f64();
        self.total += seconds;
        self.caustics += seconds;
    }
}

/// What was counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Camera rays.
    pub camera_rays: u64,
    /// Rays that went on from a surface.
    pub scattered_rays: u64,
    /// Rays to lights.
    pub shadow_rays: u64,
    /// Rays to what other pixels have found.
    pub segments: u64,
    /// Photons sent, and those that went on from mirrors and glass.
    pub photon_rays: u64,
    /// Rays of glint chains and of their pilot.
    pub chain_rays: u64,
    /// Samples that were not finite.
    pub dropped: u64,
    /// Samples that were finite, but too far above the scene's brightest light (see `film::exact`).
    pub beyond: u64,
    /// Paths that had met mirrors and glass only when the scene allowed no more of them: what they would have seen is
    /// black. Those are left out of which no light to speak of could have come.
    pub cut: u64,
}

impl Counters {
    /// Adds another batch's.
    pub fn add(&mut self, other: &Counters) {
        self.camera_rays += other.camera_rays;
        self.scattered_rays += other.scattered_rays;
        self.shadow_rays += other.shadow_rays;
        self.segments += other.segments;
        self.photon_rays += other.photon_rays;
        self.chain_rays += other.chain_rays;
        self.dropped += other.dropped;
        self.beyond += other.beyond;
        self.cut += other.cut;
    }
}
