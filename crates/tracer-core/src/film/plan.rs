//! Where a rendering was ended by the clock, so that it can be ended there again.

use super::{Film, Piece, Unfinished};
use std::fmt;
use std::str::FromStr;

/// How far a rendering goes that ends within a pass: so a picture that a time has ended can be made again
/// ([`crate::RenderOptions::plan`]). As text its four numbers with commas between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Plan {
    /// Samples that all pixels have.
    pub whole: u32,
    /// The sample index that the pass after these ends before.
    pub end: u32,
    /// Blocks of the picture, row by row, that have this pass.
    pub blocks: u32,
    /// Sample indices whose light paths are on the film.
    pub light: u32,
}

impl Plan {
    /// Whether a rendering can have been ended so.
    pub fn is_sound(&self) -> bool {
        const MOST: u32 = 1_000_000_000;
        // A pass has one guide: it ends at a power of two at the latest.
        let latest = (u64::from(self.whole) + 1).next_power_of_two();
        self.whole > 0
            && self.whole < self.end
            && self.end <= MOST
            && u64::from(self.end) <= latest
            && self.light <= self.end
    }

    /// What of its last pass is to be done, where there are so many blocks.
    pub(crate) fn pieces(&self, blocks: u32) -> Unfinished {
        let places = 0..self.blocks.min(blocks);
        let pieces = if places.is_empty() { Vec::new() } else { vec![Piece { places, samples: self.whole..self.end }] };
        Unfinished { end: self.end, pieces }
    }

    /// What of it is left then.
    pub(crate) fn left(&self, blocks: u32) -> Option<Unfinished> {
        let places = self.blocks.min(blocks)..blocks;
        let pieces = if places.is_empty() { Vec::new() } else { vec![Piece { places, samples: self.whole..self.end }] };
        (!pieces.is_empty() || self.light < self.end).then_some(Unfinished { end: self.end, pieces })
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Plan { whole, end, blocks, light } = self;
        write!(f, "{whole},{end},{blocks},{light}")
    }
}

/// A text that is no [`Plan`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected the four numbers that the report of a rendering with --time names")]
pub struct NoPlan;

impl FromStr for Plan {
    type Err = NoPlan;

    fn from_str(text: &str) -> Result<Self, NoPlan> {
        let numbers: Result<Vec<u32>, _> = text.split(',').map(|number| number.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[whole, end, blocks, light]) => Some(Plan { whole, end, blocks, light }),
            _ => None,
        }
        .filter(Plan::is_sound)
        .ok_or(NoPlan)
    }
}

impl Film {
    /// Where it was ended within a pass by a time ([`crate::RenderOptions::until`]); `None` where all pixels have the
    /// same samples, and where what is left is not all of one pass from some block on: an observer has ended that, or
    /// it had gone on with a film that one had ended.
    pub fn plan(&self) -> Option<Plan> {
        let Unfinished { end, pieces } = self.unfinished.as_ref().filter(|_| self.part.is_none())?;
        let blocks = match &pieces[..] {
            [] => u32::MAX,
            [Piece { places, samples }] if *samples == (self.whole..*end) => places.start,
            _ => return None,
        };
        Some(Plan { whole: self.whole, end: *end, blocks, light: self.light_samples }).filter(Plan::is_sound)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plans_are_read_as_they_are_written() {
        let plan = Plan { whole: 64, end: 80, blocks: 1234, light: 70 };
        assert_eq!(plan.to_string().parse(), Ok(plan));
        for bad in [
            "",
            "64",
            "64,80,1",
            "64,80,1,2,3",
            "0,1,0,0",
            "80,64,1,1",
            "64,200,1,1",
            "64,80,1,81",
            "a,b,c,d",
            "1,4294967295,2,1",
        ] {
            assert_eq!(bad.parse::<Plan>(), Err(NoPlan), "{bad}");
        }
        // What is done and what is left are all.
        for (blocks, done, left) in [(0, 0, 10), (4, 4, 6), (10, 10, 0), (u32::MAX, 10, 0)] {
            let plan = Plan { blocks, ..plan };
            let count = |rest: &Unfinished| rest.pieces.iter().map(|piece| piece.places.len()).sum::<usize>();
            assert_eq!((count(&plan.pieces(10)), plan.left(10).as_ref().map(count)), (done, Some(left)));
        }
        assert_eq!(Plan { blocks: 10, light: 80, ..plan }.left(10), None);
    }
}
