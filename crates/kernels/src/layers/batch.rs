//! What a batch has for the film's layers.

use super::Kept;
use crate::sampling::blocks::{ITEMS, PATHS};

/// What camera rays hit first, for the layers that are asked for ([`crate::layers`]), slot by slot.
#[derive(Default)]
pub struct LayerSamples {
    /// A column for each channel of those layers that are means, one layer after the other; zero where nothing is hit.
    pub sums: Vec<Box<[f32; PATHS]>>,
    /// A column for each of those that go by the nearest sample; zero where nothing is hit.
    pub nearest: Vec<Box<[u32; PATHS]>>,
    /// For these: the square of the sample's distance from its pixel's centre, in pixels; infinite where there is no
    /// camera ray.
    pub distance2: Vec<f32>,
    /// Per item: the slots whose ray hit something, a bit each.
    pub hits: [u64; ITEMS],
    /// A row for each slot where a layer asks for it.
    pub direct: Vec<DirectLight>,
    /// What paths have seen of lamps, straight, over mirrors and glass or nearly so, a row for each slot where that is
    /// told apart ([`Pass::lamps`](crate::engine::pass::Pass::lamps)): as much as they have added of it to the slot's
    /// sample.
    pub lamps: Vec<[f32; 3]>,
}

/// What has come to a sample over one surface at most.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DirectLight {
    /// From all lights that were traced before these: of other light groups.
    pub before: [f64; 3],
    /// From these.
    pub now: [f64; 3],
    /// The sample's radiance when it was looked at last.
    pub mark: [f32; 3],
}

impl LayerSamples {
    /// Makes ready for so many columns, and for what is seen of lamps.
    pub fn start(&mut self, kept: Kept, lamps: bool) {
        self.hits = [0; ITEMS];
        self.sums.resize_with(kept.sums, || Box::new([0.0; PATHS]));
        self.sums.iter_mut().for_each(|column| column.fill(0.0));
        self.nearest.resize_with(kept.nearest, || Box::new([0; PATHS]));
        self.nearest.iter_mut().for_each(|column| column.fill(0));
        self.distance2.clear();
        self.distance2.resize(if kept.nearest > 0 { PATHS } else { 0 }, f32::INFINITY);
        self.direct.clear();
        self.direct.resize(if kept.direct { PATHS } else { 0 }, DirectLight::default());
        self.lamps.clear();
        self.lamps.resize(if lamps { PATHS } else { 0 }, [0.0; 3]);
    }

    /// What there are columns for.
    pub fn kept(&self) -> Kept {
        Kept { sums: self.sums.len(), nearest: self.nearest.len(), ..Kept::default() }
    }
}
