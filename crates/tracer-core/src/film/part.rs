//! Parts of a rendering: what one of several machines is to do.

use super::{Crop, TILE};

/// A part of a rendering: some of the sample indices of some of the rows.
///
/// Any parts that lie beside each other and are all of the rendering sum to it ([`crate::Film::merge`]): equal ones or
/// not, divided by samples, by rows or by both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Pixels of the part: rows of [`Part::of_crop`], over its whole width.
    pub crop: Crop,
    /// Its first sample index.
    pub first: u32,
    /// The sample index that it ends before.
    pub end: u32,
    /// All pixels of the rendering.
    pub of_crop: Crop,
    /// All samples per pixel of the rendering.
    pub of_samples: u32,
}

/// What a rendering is divided by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Split {
    /// Every part has some of the samples of all pixels. Nothing is done twice but the guides of
    /// [`crate::Film::caustics`].
    Samples,
    /// Every part has all samples of some rows, as many as tiles have (16) or a multiple. Blocks that lie across its
    /// borders, and all light paths, are done by more than one.
    Rows,
}

impl Part {
    /// The k-th of n nearly equal parts, counted from one; `None` where there are not so many, or no such one.
    ///
    /// # Examples
    ///
    /// ```
    /// use tracer_core::{Crop, Part, Split};
    ///
    /// let crop = Crop::whole([640, 480]);
    /// let part = Part::of(crop, 100, Split::Samples, 3, 16).expect("there are 100 samples");
    /// assert_eq!((part.first, part.end, part.crop), (12, 18, crop));
    /// let part = Part::of(crop, 100, Split::Rows, 3, 16).expect("there are 30 rows of tiles");
    /// assert_eq!((part.first, part.end), (0, 100));
    /// assert_eq!(part.crop, Crop { y: 48, height: 32, ..crop });
    /// assert_eq!(Part::of(crop, 4, Split::Samples, 3, 16), None);
    /// ```
    pub fn of(crop: Crop, samples: u32, split: Split, k: u32, n: u32) -> Option<Self> {
        let whole = Part { crop, first: 0, end: samples, of_crop: crop, of_samples: samples };
        if !(1..=n).contains(&k) || n > Part::most(crop, samples, split) {
            return None;
        }
        // Where the k-th ends.
        let end = |all: u32, k: u32| (u64::from(all) * u64::from(k) / u64::from(n)) as u32;
        Some(match split {
            Split::Samples => Part { first: end(samples, k - 1), end: end(samples, k), ..whole },
            Split::Rows => {
                let (first, bottom) = (crop.y / TILE, crop.y + crop.height);
                let tiles = bottom.div_ceil(TILE) - first;
                let row = |k: u32| ((first + end(tiles, k)) * TILE).clamp(crop.y, bottom);
                Part { crop: Crop { y: row(k - 1), height: row(k) - row(k - 1), ..crop }, ..whole }
            }
        })
    }

    /// How many parts there can be.
    pub fn most(crop: Crop, samples: u32, split: Split) -> u32 {
        match split {
            Split::Samples => samples,
            Split::Rows => (crop.y + crop.height).div_ceil(TILE) - crop.y / TILE,
        }
    }

    /// Whether it can be one of a picture of this size.
    pub(super) fn is_sound(&self, size: [u32; 2]) -> bool {
        let Part { crop, first, end, of_crop, of_samples } = *self;
        let rows = |crop: Crop| crop.y..=crop.y + crop.height;
        of_crop.within(size) == of_crop
            && (crop.x, crop.width) == (of_crop.x, of_crop.width)
            && rows(of_crop).contains(&crop.y)
            && rows(of_crop).contains(rows(crop).end())
            && first < end
            && end <= of_samples
    }

    /// As the head of a saved film has it, but for its pixels, which are the film's own.
    pub(super) fn numbers(part: Option<Part>) -> [u32; 7] {
        part.map_or([0; 7], |Part { first, end, of_crop: Crop { x, y, width, height }, of_samples, .. }| {
            [first, end, of_samples, x, y, width, height]
        })
    }

    /// Back again; no part ends before sample index zero.
    pub(super) fn from_numbers([first, end, of_samples, x, y, width, height]: [u32; 7], crop: Crop) -> Option<Self> {
        let of_crop = Crop { x, y, width, height };
        (end > 0).then_some(Part { crop, first, end, of_crop, of_samples })
    }
}
