//! Light paths of a rendering: how many go from which light to which caster. What becomes of them,
//! [`super::stages::light_paths`] says.
//!
//! At every sample index there are as many, whose numbers go on where those of the sample index before have ended. What
//! they bring is summed apart from the pixels' samples, exactly, and counts as much whatever the crop, the threads and
//! the order.

use super::guide::plan::{Plan, Share};
use crate::sampling::sampler::hash3;
use crate::scene::{NONE, Scene};

/// Light paths of a sample index for five pixels. With half as many the statues' error was a twentieth larger, with ten
/// for five pixels a twentieth smaller, for a twentieth and a seventh of the time.
const PER_FIVE_PIXELS: u64 = 2;
/// Light paths of a sample index at most, and at a time.
const MOST: u64 = 1 << 22;

/// How many light paths there are.
pub struct LightPaths {
    /// Seed of their random choices.
    pub seed: u32,
    /// Those of one sample index.
    pub shares: Vec<Share>,
    /// Pair of light `l` and caster `c`, at `l` times the number of casters plus `c`, or [`NONE`].
    pub pair_of: Vec<u32>,
    /// The sky's number among the lights, behind all others.
    pub sky: u32,
    /// Per pair: light paths of a sample index over the area of light that they start from, of the sky over that of
    /// the disc before the caster.
    pub density: Vec<f32>,
    /// How far outside of the picture they count, in pixels.
    pub reach: f32,
}

impl LightPaths {
    /// `None` where no pixel could see them: all rays of a pixel go through its centre.
    pub fn new(scene: &Scene, plan: &Plan, seed: u32) -> Option<Self> {
        let reach = scene.camera.filter.reach();
        if reach <= 0.0 {
            return None;
        }
        let pixels = u64::from(scene.size[0]) * u64::from(scene.size[1]);
        let count = plan.worth((pixels * PER_FIVE_PIXELS / 5).clamp(1, MOST) as u32);
        let strays = |share: &Share| plan.pairs.strays[share.pair as usize];
        let shares: Vec<Share> = plan.shares(count).filter(|share| !strays(share)).collect();
        let casters = plan.casters.list.len();
        let mut pair_of = vec![NONE; (scene.lights.len() + 1) * casters];
        let mut density = vec![0.0; plan.ends.len()];
        for share in &shares {
            let pair = share.pair as usize;
            let [light, caster] = plan.ends[pair];
            pair_of[light * casters + caster] = share.pair;
            density[pair] = share.count as f32 / plan.pairs.area[pair];
        }
        let seed = hash3(seed, 0, 0x0011_6847) as u32;
        (!shares.is_empty()).then_some(LightPaths {
            seed,
            shares,
            pair_of,
            sky: scene.lights.len() as u32,
            density,
            reach,
        })
    }

    /// How many there are for a sample index.
    pub fn count(&self) -> u64 {
        self.shares.iter().map(|share| u64::from(share.count)).sum()
    }

    /// Sample indices that are followed at a time.
    pub fn at_once(&self) -> u32 {
        (MOST / self.count()).max(1) as u32
    }
}
