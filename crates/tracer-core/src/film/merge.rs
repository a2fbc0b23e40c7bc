//! Parts of a rendering, wherever they were made, become its film. Sums are exact, so it is the film of one machine:
//! whatever the parts are, in whatever order they come.
//!
//! One part is read at a time, and of it some tiles, which all cores add: memory is the film's, however many parts
//! there are.

use super::file::PROGRAM;
use super::layers::SavedLayer;
use super::record::read_tile;
use super::{Crop, FROM, Film, FilmError, FilmHead, Part, SavedFilm, Sums, TILE, Tile};
use bytemuck::Zeroable;
use bytemuck::allocation::try_zeroed_vec;
use rayon::prelude::*;
use std::io::Read;
use std::ops::Range;
use tracer_kernels::report::Counters;

/// Samples of rows that no part has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Gap {
    /// Rows of the picture.
    pub rows: Range<u32>,
    /// Sample indices of all their pixels.
    pub samples: Range<u32>,
}

/// What becomes of samples that no part has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gaps {
    /// They are an error.
    Refused,
    /// The film is of the samples that there are. It can be developed, but neither saved nor gone on with.
    Allowed,
    /// They are an error between the parts, and not around them: the film is a part itself, the smallest that holds
    /// them all. So many parts are merged by many machines.
    Around,
}

/// Why parts do not make a film. Parts have the numbers of their heads, from zero.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MergeError {
    /// There is none.
    #[error("there are no parts")]
    Empty,
    /// It is of another rendering than the first.
    #[error("part {part} is of another rendering than part 0: it has another {what}")]
    Foreign {
        /// Which.
        part: usize,
        /// What differs.
        what: &'static str,
    },
    /// Its rendering was ended early.
    #[error("part {part} is not finished: go on with it first")]
    Unfinished {
        /// Which.
        part: usize,
    },
    /// Two have the same samples.
    #[error("parts {first} and {second} have the same samples")]
    Overlap {
        /// The first.
        first: usize,
        /// The second.
        second: usize,
    },
    /// Samples are missing.
    #[error("samples are missing: {}", told(.0))]
    Missing(Vec<Gap>),
    /// Rows would have the light of different numbers of samples, which one film cannot hold.
    #[error("with what is missing, rows differ in their samples, and light paths fall on them: all rows need the same")]
    Uneven,
    /// Tiles rest, and with samples that are missing nobody knows how many light paths count for each.
    #[error("samples are missing, parts of the picture rest, and light paths fall on them: all samples are needed")]
    Resting,
    /// A part cannot be read.
    #[error("part {part}: {error}")]
    Part {
        /// Which.
        part: usize,
        /// Why.
        #[source]
        error: FilmError,
    },
    /// There is not so much memory.
    #[error("the film takes {0} bytes of memory, which are not to be had")]
    Memory(u64),
}

fn told(gaps: &[Gap]) -> String {
    let one = |Gap { rows, samples }: &Gap| {
        format!("{} to {} of rows {} to {}", samples.start, samples.end - 1, rows.start, rows.end - 1)
    };
    gaps.iter().map(one).collect::<Vec<_>>().join(", ")
}

impl FilmHead {
    /// The part that the film is; a film that was no part is all of its rendering.
    pub fn part(&self) -> Part {
        let end = self.end();
        self.part.unwrap_or(Part { crop: self.crop, first: 0, end, of_crop: self.crop, of_samples: end })
    }

    /// Whether it is a part of its rendering.
    pub fn is_part(&self) -> bool {
        self.part.is_some()
    }

    /// The sample index that it ends before, when what was begun is whole.
    fn end(&self) -> u32 {
        self.unfinished.as_ref().map_or(*self.samples.start(), |rest| rest.end)
    }

    /// Whether nothing is left to do.
    pub fn is_finished(&self) -> bool {
        self.unfinished.is_none() && *self.samples.start() == self.part().end && self.part().end > 0
    }

    /// What is not the same in a part of the same rendering, if anything.
    fn differs(&self, other: &FilmHead) -> Option<&'static str> {
        let of = |head: &FilmHead| (head.part().of_crop, head.part().of_samples);
        let layers = |head: &FilmHead| -> Vec<SavedLayer> { head.layers.clone() };
        let same = [
            ("program", self.program == other.program && self.program == PROGRAM),
            ("size", self.size == other.size),
            ("crop", of(self).0 == of(other).0),
            ("number of samples", of(self).1 == of(other).1),
            ("seed", self.seed == other.seed),
            ("clamp", self.clamp == other.clamp),
            ("range of brightness", self.unit == other.unit),
            ("backdrop", self.backdrop == other.backdrop),
            ("choice of mattes", self.mattes == other.mattes),
            ("set of light groups", self.groups == other.groups),
            ("set of layers", layers(self) == layers(other)),
            ("reuse", self.reuse == other.reuse),
            ("caustics", self.caustics == other.caustics),
            ("choice of halves", self.halves == other.halves),
            ("plan of adaptive sampling", self.rests_as(other)),
        ];
        same.into_iter().find(|(_, same)| !same).map(|(what, _)| what)
    }
}

impl FilmHead {
    /// Whether tiles rest in both alike, as far as they have samples at which any may.
    fn rests_as(&self, other: &FilmHead) -> bool {
        let is_told = |head: &FilmHead| head.adaptive.is_some() || head.part().end > FROM;
        self.adaptive == other.adaptive || !is_told(self) || !is_told(other)
    }
}

/// What is wrong with parts, as far as their heads tell: all of it, each by itself. What is missing comes last: of the
/// whole rendering, or with [`Gaps::Around`] of the smallest part that holds them all.
pub fn faults(heads: &[FilmHead], allowed: Gaps) -> Vec<MergeError> {
    let Some(first) = heads.first() else { return vec![MergeError::Empty] };
    let mut found = Vec::new();
    let mut sound: Vec<(usize, Part)> = Vec::new();
    for (part, head) in heads.iter().enumerate() {
        if let Some(what) = head.differs(first) {
            found.push(MergeError::Foreign { part, what });
        } else if !head.is_finished() {
            found.push(MergeError::Unfinished { part });
        } else {
            sound.push((part, head.part()));
        }
    }
    found.extend(overlaps(&sound));
    let gaps = gaps(&made_of(heads, allowed).unwrap_or(first.part()), sound.iter().map(|&(_, part)| part));
    if !gaps.is_empty() {
        found.push(MergeError::Missing(gaps));
    }
    found
}

/// What parts are to make: the whole rendering, or the smallest part that holds them all.
fn made_of(heads: &[FilmHead], allowed: Gaps) -> Option<Part> {
    let parts = || heads.iter().map(FilmHead::part);
    let Part { of_crop, of_samples, .. } = parts().next()?;
    if allowed != Gaps::Around {
        return Some(Part { crop: of_crop, first: 0, end: of_samples, of_crop, of_samples });
    }
    let (top, bottom) = (parts().map(|part| part.crop.y).min()?, parts().map(|part| rows(part.crop).end).max()?);
    let (first, end) = (parts().map(|part| part.first).min()?, parts().map(|part| part.end).max()?);
    Some(Part { crop: Crop { y: top, height: bottom - top, ..of_crop }, first, end, of_crop, of_samples })
}

fn rows(crop: Crop) -> Range<u32> {
    crop.y..crop.y + crop.height
}

/// Two that have samples in common; each part is told once at most.
fn overlaps(parts: &[(usize, Part)]) -> Vec<MergeError> {
    let common = |a: Range<u32>, b: Range<u32>| a.start.max(b.start) < a.end.min(b.end);
    let mut found = Vec::new();
    for (k, &(second, part)) in parts.iter().enumerate() {
        let before = parts[..k].iter().find(|(_, other)| {
            common(part.first..part.end, other.first..other.end) && common(rows(part.crop), rows(other.crop))
        });
        found.extend(before.map(|&(first, _)| MergeError::Overlap { first, second }));
    }
    found
}

/// What the parts lack of a larger one. Rows that lack the same are told together.
pub(super) fn gaps(of: &Part, parts: impl Iterator<Item = Part>) -> Vec<Gap> {
    let parts: Vec<Part> = parts.filter(|part| part.crop.height > 0).collect();
    let mut cuts: Vec<u32> = parts.iter().flat_map(|part| [rows(part.crop).start, rows(part.crop).end]).collect();
    cuts.extend([rows(of.crop).start, rows(of.crop).end]);
    cuts.sort_unstable();
    cuts.dedup();
    let mut gaps: Vec<Gap> = Vec::new();
    let bands = cuts.windows(2).map(|cuts| cuts[0]..cuts[1]);
    for band in bands.filter(|band| rows(of.crop).contains(&band.start)) {
        let here = parts.iter().filter(|part| rows(part.crop).contains(&band.start));
        let mut samples: Vec<Range<u32>> = here.map(|part| part.first..part.end).collect();
        samples.sort_unstable_by_key(|samples| samples.start);
        samples.push(of.end..of.end);
        let mut next = of.first;
        for Range { start, end } in samples {
            if next < start {
                let above = gaps.iter_mut().find(|gap| gap.rows.end == band.start && gap.samples == (next..start));
                match above {
                    Some(gap) => gap.rows.end = band.end,
                    None => gaps.push(Gap { rows: band.clone(), samples: next..start }),
                }
            }
            next = next.max(end);
        }
    }
    gaps
}

impl Film {
    /// The film of a rendering from its parts ([`crate::RenderOptions::part`]), which [`Film::save`] has written: the
    /// film of one machine, for any parts in any order. It is told their heads, and asks for each part when it comes to
    /// it, so that not all have to be open. [`crate::film_faults`] tells all that is wrong with the heads at once.
    ///
    /// # Errors
    /// When a part is of another rendering, not finished, or cannot be read; when two have samples in common; when some
    /// are missing and that is not allowed.
    ///
    /// # Examples
    ///
    /// ```
    /// use std::path::Path;
    /// use tracer_core::{Crop, Film, Gaps, Part, RenderOptions, SavedFilm, Split, Unobserved, compile, render};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let text = "Scene(background: 1, image: Image(width: 8, height: 8), \
    ///             objects: [Sphere(center: (0, 0, 0), radius: 1)])";
    /// let loaded = scene_format::load_str("ball.ron", text, scene_format::Syntax::Ron, Path::new("."), &[])?;
    /// let scene = compile(&loaded.scene)?;
    ///
    /// // On three machines:
    /// let mut files = Vec::new();
    /// for k in 1..=3 {
    ///     let part = Part::of(Crop::whole([8, 8]), 10, Split::Samples, k, 3);
    ///     let mut file = Vec::new();
    ///     render(&scene, &RenderOptions { part, ..RenderOptions::default() }, &Unobserved).save(&mut file, &[])?;
    ///     files.push(file);
    /// }
    ///
    /// // On one:
    /// let open = |part: usize| SavedFilm::open(files[part].as_slice());
    /// let heads = (0..3).map(|part| Ok(open(part)?.head().clone()));
    /// let heads = heads.collect::<Result<Vec<_>, tracer_core::FilmError>>()?;
    /// let film = Film::merge(&heads, open, Gaps::Refused)?;
    /// let at_once = render(&scene, &RenderOptions { samples: Some(10), ..RenderOptions::default() }, &Unobserved);
    /// assert_eq!(film.radiance(4, 4), at_once.radiance(4, 4));
    /// assert_eq!(film.counters, at_once.counters);
    /// # Ok(())
    /// # }
    /// ```
    pub fn merge<R: Read>(
        heads: &[FilmHead],
        mut open: impl FnMut(usize) -> Result<SavedFilm<R>, FilmError>,
        allowed: Gaps,
    ) -> Result<Film, MergeError> {
        let (mut is_whole, mut lacks_samples) = (true, false);
        for fault in faults(heads, allowed) {
            match fault {
                MergeError::Missing(gaps) if allowed == Gaps::Allowed => {
                    is_whole = false;
                    lacks_samples = gaps.iter().any(|gap| gap.samples != (0..heads[0].part().of_samples));
                }
                fault => return Err(fault),
            }
        }
        let of = made_of(heads, allowed).ok_or(MergeError::Empty)?;
        let mut film = empty(&heads[0], of.crop)?;
        let light = light_samples(heads).ok_or(MergeError::Uneven)?;
        film.keep_adaptive(heads.iter().find_map(|head| head.adaptive.clone()));
        if lacks_samples && light > 0 && film.is_adaptive() {
            return Err(MergeError::Resting);
        }
        for (part, head) in heads.iter().enumerate() {
            let added = open(part).and_then(|saved| film.add_part(head, saved));
            added.map_err(|error| MergeError::Part { part, error })?;
        }
        film.light_samples = of.first + light;
        film.whole = if is_whole { of.end } else { *film.samples().start() };
        film.has_gaps = !is_whole;
        // All of the rendering is no part any more: more samples can be added.
        let is_all = of.crop == of.of_crop && (of.first..of.end) == (0..of.of_samples);
        film.part = (allowed == Gaps::Around && !is_all).then_some(of);
        Ok(film)
    }

    /// Adds a part, some tiles at a time.
    fn add_part<R: Read>(&mut self, head: &FilmHead, mut saved: SavedFilm<R>) -> Result<(), FilmError> {
        if saved.head() != head {
            return Err(FilmError::Damaged("it has changed since its head was read"));
        }
        let layers = head.film_layers()?;
        let (held, most) = (head.held(&layers), head.most());
        let Crop { x, y, width, .. } = head.crop;
        let columns = ((x + width).div_ceil(TILE) - x / TILE) as usize;
        // In the same columns, but further down.
        let before = (y / TILE - self.first_tile[1]) as usize * columns;
        saved.tiles(|records| {
            records.beside(&mut self.tiles, before)?.into_par_iter().try_for_each(|(sum, bytes)| {
                let mut tile = Tile::zeroed();
                read_tile(bytes, most, held, &mut tile)?;
                head.has(&tile, held.kept).then(|| sum.merge(&tile))
            })
        })?;
        add_counters(&mut self.counters, &head.counters);
        self.costs.add(&head.costs);
        Ok(())
    }
}

/// The film of a rendering before any part of it.
fn empty(head: &FilmHead, of: Crop) -> Result<Film, MergeError> {
    let whole = FilmHead { crop: of, ..head.clone() };
    let nothing = Crop { width: 0, height: 0, ..of };
    let mut film = Film::new(head.size, nothing, head.seed, head.unit, head.clamp);
    let [across, down] = [(of.x, of.width), (of.y, of.height)].map(|(at, side)| (at + side).div_ceil(TILE) - at / TILE);
    film.tiles = try_zeroed_vec(across as usize * down as usize).map_err(|()| MergeError::Memory(whole.bytes()))?;
    if head.clamp.is_some() {
        film.tiles.iter_mut().for_each(Tile::keep_taken);
    }
    (film.crop, film.tile_columns) = (of, across);
    (film.reuse, film.caustics, film.moments) = (head.reuse, head.caustics, head.moments);
    film.keep_halves(head.halves);
    film.keep_backdrop(head.backdrop);
    film.paper = head.paper;
    film.keep_mattes(head.mattes);
    film.keep_groups(head.groups.clone());
    film.layers = head.film_layers().map_err(|error| MergeError::Part { part: 0, error })?;
    Ok(film)
}

/// Sample indices whose light paths are on every row; `None` where rows differ.
fn light_samples(heads: &[FilmHead]) -> Option<u32> {
    let light = |head: &FilmHead| head.light_samples.saturating_sub(head.part().first);
    if heads.iter().all(|head| light(head) == 0) {
        return Some(0);
    }
    let mut of_rows = heads.iter().flat_map(|head| [rows(head.crop).start, rows(head.crop).end]).collect::<Vec<u32>>();
    of_rows.sort_unstable();
    of_rows.dedup();
    let of_row = |row: &u32| heads.iter().filter(|head| rows(head.crop).contains(row)).map(light).sum::<u32>();
    // Rows without any part are black.
    let mut sums = of_rows.iter().map(of_row).filter(|&sum| sum > 0);
    let first = sums.next()?;
    sums.all(|sum| sum == first).then_some(first)
}

fn add_counters(to: &mut Counters, from: &Counters) {
    // Heads hold less than 2^60 each; a lie must not be a panic.
    let add = |to: &mut u64, from: u64| *to = to.saturating_add(from);
    let Counters { camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond, cut } =
        *from;
    add(&mut to.camera_rays, camera_rays);
    add(&mut to.scattered_rays, scattered_rays);
    add(&mut to.shadow_rays, shadow_rays);
    add(&mut to.segments, segments);
    add(&mut to.photon_rays, photon_rays);
    add(&mut to.chain_rays, chain_rays);
    add(&mut to.dropped, dropped);
    add(&mut to.beyond, beyond);
    add(&mut to.cut, cut);
}

impl Tile {
    /// Adds what another has of the same pixels.
    fn merge(&mut self, other: &Tile) {
        add_sums(&mut self.sums, &other.sums);
        self.squares.merge(&other.squares);
        add_counts(&mut self.samples, &other.samples);
        if let Some(from) = &other.taken {
            let taken = self.taken.get_or_insert_with(|| Box::new(super::Taken::zeroed()));
            add_sums(&mut taken.sums, &from.sums);
            add_counts(&mut taken.samples, &from.samples);
        }
        if let Some(from) = &other.splats {
            let splats = self.splats.get_or_insert_with(|| Box::new(super::Splats::zeroed()));
            add_sums(&mut splats.sums, &from.sums);
            splats.squares.merge(&from.squares);
        }
        match (&mut self.layers, &other.layers) {
            (_, None) => {}
            (Some(layers), Some(from)) => layers.merge(from),
            (layers, from) => layers.clone_from(from),
        }
        if let (Some(half), Some(from)) = (&mut self.half, &other.half) {
            half.merge(from);
        }
        if let Some(from) = &other.missed {
            add_sums(self.missed.get_or_insert_with(|| Box::new(Sums::zeroed())), from);
        }
        match (&mut self.mattes, &other.mattes) {
            (_, None) => {}
            (Some(mattes), Some(from)) => mattes.merge(from),
            (mattes, from) => mattes.clone_from(from),
        }
        match (&mut self.groups, &other.groups) {
            (_, None) => {}
            (Some(groups), Some(from)) => groups.merge(from),
            (groups, from) => groups.clone_from(from),
        }
    }
}

pub(super) fn add_sums(to: &mut Sums, from: &Sums) {
    (0..super::PIXELS).for_each(|pixel| to.add(pixel, [0, 1, 2].map(|c| from.of(c, pixel))));
}

/// Adds counts; a file that lies must not be a panic.
pub(super) fn add_counts(to: &mut [u32], from: &[u32]) {
    to.iter_mut().zip(from).for_each(|(to, &from)| *to = to.saturating_add(from));
}

#[cfg(test)]
mod tests {
    use super::super::Split;
    use super::*;

    fn part(rows: Range<u32>, samples: Range<u32>) -> Part {
        let of_crop = Crop { x: 3, y: 0, width: 5, height: 64 };
        let crop = Crop { y: rows.start, height: rows.end - rows.start, ..of_crop };
        Part { crop, first: samples.start, end: samples.end, of_crop, of_samples: 10 }
    }

    fn missing(parts: &[Part]) -> Vec<Gap> {
        gaps(&part(0..64, 0..10), parts.iter().copied())
    }

    #[test]
    fn what_is_missing_is_named_once() {
        let gap = |rows, samples| Gap { rows, samples };
        assert_eq!(missing(&[]), [gap(0..64, 0..10)]);
        assert_eq!(missing(&[part(0..64, 0..10)]), []);
        assert_eq!(missing(&[part(0..64, 4..7)]), [gap(0..64, 0..4), gap(0..64, 7..10)]);
        assert_eq!(missing(&[part(16..32, 0..10)]), [gap(0..16, 0..10), gap(32..64, 0..10)]);
        let parts = [part(0..64, 0..4), part(0..16, 4..10), part(16..48, 4..9), part(48..64, 5..10)];
        assert_eq!(missing(&parts), [gap(16..48, 9..10), gap(48..64, 4..5)]);
        // Of a part, only what is within.
        assert_eq!(gaps(&part(0..32, 2..7), parts.iter().copied()), []);
        assert_eq!(gaps(&part(16..48, 4..10), parts.iter().copied()), [gap(16..48, 9..10)]);
        // Rows that lack the same though other parts hold them.
        assert_eq!(missing(&[part(0..32, 0..9), part(32..64, 0..9)]), [gap(0..64, 9..10)]);
    }

    #[test]
    fn parts_of_any_number_are_all_of_it() {
        let crop = Crop { x: 3, y: 7, width: 5, height: 75 };
        for split in [Split::Samples, Split::Rows] {
            for samples in [1, 7, 100] {
                for n in 1..=Part::most(crop, samples, split) {
                    let parts: Vec<Part> = (1..=n).filter_map(|k| Part::of(crop, samples, split, k, n)).collect();
                    assert_eq!(parts.len(), n as usize);
                    assert!(parts.iter().all(|part| part.is_sound([100, 100]) && part.crop.height > 0), "{parts:?}");
                    let whole = Part { crop, first: 0, end: samples, ..parts[0] };
                    assert_eq!(gaps(&whole, parts.iter().copied()), []);
                    assert!(overlaps(&parts.iter().copied().enumerate().collect::<Vec<_>>()).is_empty());
                }
                assert_eq!(Part::of(crop, samples, split, 1, Part::most(crop, samples, split) + 1), None);
            }
        }
        assert_eq!((Part::of(crop, 9, Split::Samples, 0, 3), Part::of(crop, 9, Split::Samples, 4, 3)), (None, None));
    }

    #[test]
    fn samples_in_common_are_found() {
        let all = [part(0..32, 0..5), part(32..64, 0..5), part(0..64, 5..10), part(31..33, 4..5)];
        let numbered: Vec<(usize, Part)> = all.into_iter().enumerate().collect();
        assert!(overlaps(&numbered[..3]).is_empty());
        assert!(matches!(overlaps(&numbered)[..], [MergeError::Overlap { first: 0, second: 3 }]));
    }
}
