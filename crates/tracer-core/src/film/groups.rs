//! Light groups: what each group of the scene's lights brings, summed by itself in the same whole numbers.
//!
//! A sample is traced once for each group. What a group's is worth in least units is added to the group's sums and to
//! the picture's alike, so the groups sum to the picture exactly. Squares, halves and all else that goes by a sample as
//! a whole see the total over the groups.

use super::exact::{LEAST, Sums, fixed};
use super::pack::{pack, unpack};
use super::record::{Held, kept};
use super::{Crop, Film, FilmHead, FilmLayer, LeftOut, PIXELS, TILE, Tile, counts, luminance};
use bytemuck::Zeroable;

/// The light groups of a film.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct FilmGroups {
    /// Their names.
    pub names: Vec<String>,
    /// Which of them the background is of, if any.
    pub of_background: Option<u32>,
}

impl FilmGroups {
    /// As the head of a saved film has them, before their names: which is the background's, and how many there are.
    pub fn numbers(&self) -> [u32; 2] {
        [self.of_background.unwrap_or(u32::MAX), self.names.len() as u32]
    }

    /// Back again.
    pub fn from_number(of_background: u32, names: Vec<String>) -> Self {
        FilmGroups { names, of_background: Some(of_background).filter(|&group| group != u32::MAX) }
    }
}

/// What a tile holds of its groups.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct TileGroups(Vec<OfGroup>);

/// What a group has brought to the pixels of a tile.
#[derive(Clone, Debug, PartialEq)]
struct OfGroup {
    sums: Box<Sums>,
    /// Where its light paths have fallen.
    splats: Option<Box<Sums>>,
}

/// Samples of a block, as what is summed.
pub(crate) trait Samples {
    /// A sample in least units; `None` where it cannot be summed.
    fn whole(&self, k: usize) -> Option<[i128; 3]>;

    /// Its luminance, as its square is summed.
    fn luminance(&self, k: usize) -> f64;
}

impl Samples for [&[f32]; 3] {
    #[inline(always)]
    fn whole(&self, k: usize) -> Option<[i128; 3]> {
        let sample = self.map(|channel| channel[k]);
        counts(sample).then(|| sample.map(fixed))
    }

    #[inline(always)]
    fn luminance(&self, k: usize) -> f64 {
        luminance(self.map(|channel| f64::from(channel[k])))
    }
}

/// Totals over the groups.
impl Samples for &[[i128; 3]] {
    #[inline(always)]
    fn whole(&self, k: usize) -> Option<[i128; 3]> {
        Some(self[k])
    }

    #[inline(always)]
    fn luminance(&self, k: usize) -> f64 {
        luminance(self[k].map(|x| x as f64 * LEAST))
    }
}

impl TileGroups {
    fn new(count: usize) -> Self {
        TileGroups(vec![OfGroup { sums: Box::new(Sums::zeroed()), splats: None }; count])
    }

    /// Bytes of memory that it takes.
    pub fn bytes(&self) -> usize {
        let splats = self.0.iter().filter(|group| group.splats.is_some()).count();
        TileGroups::bytes_of(self.0.len()) + splats * size_of::<Sums>()
    }

    /// Bytes of memory that so many groups take in a tile without light paths.
    fn bytes_of(count: usize) -> usize {
        if count == 0 { 0 } else { size_of::<TileGroups>() + count * (size_of::<OfGroup>() + size_of::<Sums>()) }
    }

    /// Bytes of memory that so many groups take in a tile at most.
    pub fn most_bytes(count: usize) -> usize {
        TileGroups::bytes_of(count) + count * size_of::<Sums>()
    }

    /// Bytes of its record at most: a number has no more than 16, and each 64 of them 20 beside.
    pub fn longest_record(count: usize) -> u64 {
        count as u64 * (1 + 6 * (PIXELS as u64 * 16 + PIXELS as u64 / 64 * 20))
    }

    /// Adds what another has of the same pixels.
    pub fn merge(&mut self, other: &TileGroups) {
        for (to, from) in self.0.iter_mut().zip(&other.0) {
            super::merge::add_sums(&mut to.sums, &from.sums);
            if let Some(from) = &from.splats {
                super::merge::add_sums(to.splats.get_or_insert_with(|| Box::new(Sums::zeroed())), from);
            }
        }
    }

    /// Appends it to a tile's record.
    pub fn record(&self, out: &mut Vec<u8>) {
        for OfGroup { sums, splats } in &self.0 {
            out.push(u8::from(splats.is_some()));
            for sums in std::iter::once(sums).chain(splats) {
                (0..3).for_each(|c| pack(|k| sums.of(c, k), out));
            }
        }
    }

    /// Reads so many groups from one.
    pub fn read(from: &mut &[u8], count: usize) -> Option<Self> {
        let mut groups = TileGroups(Vec::new());
        for _ in 0..count {
            let has_splats = *from.split_off_first()?;
            let mut sums = || {
                let mut sums = Box::new(Sums::zeroed());
                (0..3).try_for_each(|c| unpack(from, |k, sum| sums.set(c, k, sum)))?;
                Some(sums)
            };
            let of_paths = sums()?;
            let splats = if has_splats == 0 { None } else { Some(sums()?) };
            groups.0.push(OfGroup { sums: of_paths, splats });
            if has_splats > 1 {
                return None;
            }
        }
        Some(groups)
    }
}

impl Tile {
    fn groups(&mut self, count: usize) -> &mut [OfGroup] {
        &mut self.groups.get_or_insert_with(|| Box::new(TileGroups::new(count))).0
    }

    /// Adds what a group, of so many, brings to samples of a block, to its sums and to the picture's; samples and
    /// pixels are those of [`Tile::add`]. The total over the groups is added to `totals`, sample by sample. Gives how
    /// many samples were left out, of this group alone.
    pub(crate) fn add_group(
        &mut self,
        (group, count): (usize, usize),
        samples: [&[f32]; 3],
        pixels: &[[u8; 2]],
        totals: &mut [[i128; 3]],
    ) -> LeftOut {
        let mut left_out = LeftOut::default();
        let groups = self.groups.get_or_insert_with(|| Box::new(TileGroups::new(count)));
        let OfGroup { sums, .. } = &mut groups.0[group];
        for &[k, pixel] in pixels {
            let (k, pixel) = (usize::from(k), usize::from(pixel));
            let Some(whole) = samples.whole(k) else {
                left_out.count(samples.map(|channel| channel[k]));
                continue;
            };
            sums.add(pixel, whole);
            self.sums.add(pixel, whole);
            for (total, x) in totals[k].iter_mut().zip(whole) {
                *total = total.wrapping_add(x);
            }
        }
        left_out
    }

    /// Counts samples of a block whose groups [`Tile::add_group`] has added all.
    pub(crate) fn count_totals(&mut self, totals: &[[i128; 3]], pixels: &[[u8; 2]]) {
        for &[k, pixel] in pixels {
            let (k, pixel) = (usize::from(k), usize::from(pixel));
            self.samples[pixel] += 1;
            self.squares.add(pixel, Samples::luminance(&totals, k));
        }
    }

    /// Adds to a group, of so many, what a light path has brought, as [`Tile::splat`] gives it.
    pub(crate) fn splat_group(&mut self, (group, count): (usize, usize), pixel: usize, added: [i128; 3]) {
        let splats = &mut self.groups(count)[group].splats;
        splats.get_or_insert_with(|| Box::new(Sums::zeroed())).add(pixel, added);
    }
}

impl FilmHead {
    /// The names of the light groups that it keeps apart.
    pub fn light_groups(&self) -> &[String] {
        &self.groups.names
    }

    /// What its tiles hold beside the picture, with these layers.
    pub(super) fn held(&self, layers: &[FilmLayer]) -> Held {
        Held { kept: kept(layers), mattes: self.mattes, groups: self.groups.names.len() }
    }
}

impl Film {
    /// Keeps groups apart; before anything is added.
    pub(crate) fn keep_groups(&mut self, groups: FilmGroups) {
        self.groups = groups;
    }

    /// The names of the light groups that it keeps apart ([`crate::LightGroups`]), in their order; none where it keeps
    /// none.
    ///
    /// # Examples
    ///
    /// ```
    /// use scene_format::{Syntax, load_str};
    /// use std::path::Path;
    /// use tracer_core::{RenderOptions, Unobserved, compile, render};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let text = "Scene(image: Image(width: 9, height: 9), output: Output(light_groups: true), background: 0.25, \
    ///             lights: [SphereLight(center: (9, 9, 9), radius: 1, radiance: 50, group: \"key\")], \
    ///             objects: [Sphere(center: (0, 0, 0), radius: 1)])";
    /// let scene = compile(&load_str("ball.ron", text, Syntax::Ron, Path::new("."), &[])?.scene)?;
    /// let film = render(&scene, &RenderOptions::default(), &Unobserved);
    ///
    /// assert_eq!(film.light_groups(), ["key", "rest"]);
    /// let (key, rest, all) = (film.radiance_of_group(0, 4, 4), film.radiance_of_group(1, 4, 4), film.radiance(4, 4));
    /// assert!((key[0] + rest[0] - all[0]).abs() <= 1e-15 * all[0]);
    /// # Ok(())
    /// # }
    /// ```
    pub fn light_groups(&self) -> &[String] {
        &self.groups.names
    }

    /// Which of them the background is of, if any.
    pub(crate) fn group_of_background(&self) -> Option<usize> {
        self.groups.of_background.map(|group| group as usize)
    }

    /// Bytes of memory that so many light groups take in a picture, or part of one, beside [`Film::bytes_of`], where
    /// light paths fall everywhere.
    pub fn bytes_of_groups(crop: Crop, groups: usize) -> u64 {
        let tiles = |first: u32, length: u32| u64::from((first + length).div_ceil(TILE) - first / TILE);
        tiles(crop.x, crop.width) * tiles(crop.y, crop.height) * TileGroups::most_bytes(groups) as u64
    }

    /// What of [`Film::radiance`] the lights of a group have brought, linear RGB; (x, y) in the whole picture, within
    /// the crop. The sums of the groups are exactly the picture's, so these means sum to its mean but for the rounding
    /// of each. Black for a number that no group has.
    pub fn radiance_of_group(&self, group: usize, x: u32, y: u32) -> [f64; 3] {
        let (tile, pixel) = self.place(x, y);
        let Some(of) = tile.groups.as_ref().and_then(|groups| groups.0.get(group)) else { return [0.0; 3] };
        self.mean(tile, (&of.sums, of.splats.as_deref()), pixel)
    }

    /// Whether the groups' sums are the picture's, as whole numbers: so they are wherever groups are kept.
    pub fn groups_are_all(&self) -> bool {
        let of_tile = |tile: &Tile| {
            let groups = || tile.groups.iter().flat_map(|groups| &groups.0);
            (0..PIXELS).flat_map(|pixel| [0, 1, 2].map(|c| (c, pixel))).all(|(c, pixel)| {
                let splats = tile.splats.as_ref().map_or(0, |splats| splats.sums.of(c, pixel));
                let of_splats = groups().filter_map(|group| Some(group.splats.as_ref()?.of(c, pixel)));
                tile.sums.of(c, pixel) == groups().map(|group| group.sums.of(c, pixel)).sum::<i128>()
                    && splats == of_splats.sum::<i128>()
            })
        };
        self.tiles.iter().all(of_tile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Groups of samples that sum to the picture's, and of light paths.
    fn filled(seed: u32) -> Box<Tile> {
        let mut tile = Box::new(Tile::zeroed());
        let pixels: [[u8; 2]; 64] = std::array::from_fn(|k| [k as u8, (k as u8).wrapping_mul(5)]);
        for sample in 0..9 {
            let mut totals = [[0; 3]; 64];
            for group in 0..3 {
                let of = |c: u32| -> Vec<f32> {
                    let number = |k: u32| (k * 7 + sample * 11 + group * 13 + c * 17).wrapping_mul(0x9e37_79b9 ^ seed);
                    (0..64).map(|k| f32::from_bits(0x2000_0000 + number(k) % 0x2c00_0000)).collect()
                };
                let [r, g, b] = [0, 1, 2].map(of);
                tile.add_group((group as usize, 3), [&r, &g, &b], &pixels, &mut totals);
            }
            tile.count_totals(&totals, &pixels);
        }
        let added = tile.splat(3, [0.5, 0.25, 2.0], None).expect("finite");
        tile.splat_group((1, 3), 3, added);
        tile
    }

    #[test]
    fn a_record_gives_back_what_was_written() {
        let tile = filled(1);
        let groups = tile.groups.as_deref().expect("three");
        let mut bytes = Vec::new();
        groups.record(&mut bytes);
        assert!(bytes.len() as u64 <= TileGroups::longest_record(3));
        assert_eq!(TileGroups::read(&mut &*bytes, 3).as_ref(), Some(groups));
        for cut in [0, 1, bytes.len() / 2, bytes.len() - 1] {
            assert_eq!(TileGroups::read(&mut &bytes[..cut], 3), None, "cut at {cut}");
        }
        bytes[0] = 7;
        assert_eq!(TileGroups::read(&mut &*bytes, 3), None);
    }

    /// What is merged is what would have been added to one.
    #[test]
    fn groups_of_parts_add_up() {
        let (one, other) = (filled(1), filled(2));
        let mut sum = one.groups.clone().expect("three");
        sum.merge(other.groups.as_deref().expect("three"));
        for (group, c, pixel) in (0..3).flat_map(|g| (0..3).flat_map(move |c| (0..PIXELS).map(move |p| (g, c, p)))) {
            let of = |tile: &Tile| tile.groups.as_ref().map_or(0, |groups| groups.0[group].sums.of(c, pixel));
            assert_eq!(sum.0[group].sums.of(c, pixel), of(&one) + of(&other));
        }
    }

    /// The picture's sums are those of the groups, and its squares those of whole samples.
    #[test]
    fn a_sample_is_squared_as_a_whole() {
        let mut tile = Tile::zeroed();
        let (ones, twos) = ([1.0f32; 64], [2.0f32; 64]);
        let mut totals = [[0; 3]; 64];
        tile.add_group((0, 2), [&ones; 3], &[[0, 9]], &mut totals);
        tile.add_group((1, 2), [&twos; 3], &[[0, 9]], &mut totals);
        tile.count_totals(&totals, &[[0, 9]]);
        assert_eq!(tile.sums.mean(9, tile.samples[9]), [3.0; 3]);
        assert!((tile.squares.of(9) - 9.0).abs() < 1e-12);
    }
}
