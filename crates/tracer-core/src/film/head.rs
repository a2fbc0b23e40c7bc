//! The head of a film as a file ([`super::file`]): what it is of, how far it is, and what was counted.

use super::file::{FORMAT, FilmError, MAGIC, Note, PROGRAM};
use super::layers::SavedLayer;
use super::mattes::longest_record;
use super::{
    Adaptive, Crop, FROM, Film, FilmGroups, FilmLayer, MattesKept, Octave, Part, Piece, TILE, Tile, TileGroups,
    Unfinished,
};
use std::ops::RangeInclusive;
use std::sync::Arc;
use tracer_kernels::layers::Kept;
use tracer_kernels::report::{Costs, Counters};
use tracer_kernels::sampling::blocks::QUARTERS;

/// No tile's record is longer than this, but for mattes and light groups.
const LONGEST_TILE: u32 = 1 << 18;
/// Pixels along a side at most.
const MAX_SIDE: u32 = 1 << 16;

/// What a saved film tells about itself.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmHead {
    /// Version of the program that has made it, and what its sources sum to.
    pub program: String,
    /// What was written beside it.
    pub notes: Vec<Note>,
    /// Size of the whole picture in pixels.
    pub size: [u32; 2],
    /// The part of it that the film holds.
    pub crop: Crop,
    /// Seed of all random choices.
    pub seed: u32,
    /// The most that the largest channel of a sample counts, in W/(sr m^2).
    pub clamp: Option<f32>,
    /// Samples that all pixels have, and those that some have where a pass was ended early.
    pub samples: RangeInclusive<u32>,
    /// Rays and dropped samples.
    pub counters: Counters,
    pub(super) part: Option<Part>,
    pub(super) unit: f64,
    pub(super) light_samples: u32,
    pub(super) octave: Octave,
    pub(super) unfinished: Option<Unfinished>,
    pub(super) costs: Costs,
    pub(super) reuse: bool,
    pub(super) caustics: bool,
    pub(super) layers: Vec<SavedLayer>,
    pub(super) halves: bool,
    pub(super) moments: u32,
    pub(super) backdrop: bool,
    pub(super) paper: f64,
    pub(super) mattes: MattesKept,
    pub(super) groups: FilmGroups,
    pub(super) adaptive: Option<Arc<Adaptive>>,
}

impl FilmHead {
    /// Of a film, with what is to be told beside it.
    pub(super) fn of(film: &Film) -> Self {
        // Of a pass that was ended early somebody wants to know how far it came.
        let most = film
            .unfinished
            .as_ref()
            .map_or(film.whole, |_| film.first().saturating_add(*film.samples_of_pixels().end()));
        FilmHead {
            program: PROGRAM.to_owned(),
            notes: Vec::new(),
            size: film.size,
            crop: film.crop,
            seed: film.seed,
            clamp: film.clamp,
            samples: film.whole..=most.max(film.whole),
            counters: film.counters,
            part: film.part,
            unit: film.unit,
            light_samples: film.light_samples,
            octave: film.octave,
            unfinished: film.unfinished.clone(),
            costs: film.costs,
            reuse: film.reuse,
            caustics: film.caustics,
            layers: film.layers.iter().map(|layer| layer.saved()).collect(),
            halves: film.halves,
            moments: film.moments,
            backdrop: film.backdrop,
            paper: film.paper,
            mattes: film.mattes,
            groups: film.groups.clone(),
            adaptive: film.adaptive.clone(),
        }
    }

    /// Magic, format, length and head, without the checksum.
    pub(super) fn to_bytes(&self) -> Vec<u8> {
        let mut out = Vec::new();
        let text = |text: &str, out: &mut Vec<u8>| {
            out.extend((text.len() as u32).to_le_bytes());
            out.extend(text.as_bytes());
        };
        text(&self.program, &mut out);
        out.extend((self.notes.len() as u32).to_le_bytes());
        for (name, value) in &self.notes {
            text(name, &mut out);
            text(value, &mut out);
        }
        let Crop { x, y, width, height } = self.crop;
        let whole = *self.samples.start();
        let mut numbers = vec![self.size[0], self.size[1], x, y, width, height, self.seed];
        numbers.push(self.clamp.map_or(0, f32::to_bits));
        numbers.extend([self.reuse, self.caustics, self.halves, self.backdrop].map(u32::from));
        numbers.extend([self.mattes.bits(), self.moments]);
        numbers.extend([whole, *self.samples.end(), self.light_samples, self.octave.samples]);
        let (end, pieces) = self.unfinished.as_ref().map_or((0, &[][..]), |rest| (rest.end, &rest.pieces[..]));
        numbers.extend([end, pieces.len() as u32]);
        numbers.extend(
            pieces.iter().flat_map(|Piece { places, samples }| [places.start, places.end, samples.start, samples.end]),
        );
        out.extend(numbers.into_iter().flat_map(u32::to_le_bytes));
        out.extend(Part::numbers(self.part).into_iter().flat_map(u32::to_le_bytes));
        let counters = counters_as_array(self.counters);
        let costs = [self.unit, self.costs.total, self.costs.reuse, self.costs.caustics, self.costs.clamp];
        let reals =
            costs.into_iter().chain(self.octave.differences).chain([self.octave.pixels, self.paper]).map(f64::to_bits);
        out.extend(counters.into_iter().chain(reals).flat_map(u64::to_le_bytes));
        out.extend((self.layers.len() as u32).to_le_bytes());
        for SavedLayer { name, units } in &self.layers {
            text(name, &mut out);
            out.extend(units.iter().flat_map(|x| x.to_bits().to_le_bytes()));
        }
        out.extend(self.groups.numbers().into_iter().flat_map(u32::to_le_bytes));
        self.groups.names.iter().for_each(|name| text(name, &mut out));
        let rests = self.adaptive.as_ref().map_or(Vec::new(), |adaptive| adaptive.to_bytes());
        out.extend((rests.len() as u32).to_le_bytes());
        out.extend(rests);
        let mut head = MAGIC.to_vec();
        head.extend([FORMAT, out.len() as u32].into_iter().flat_map(u32::to_le_bytes));
        head.extend(out);
        head
    }

    pub(super) fn from_bytes(mut from: &[u8]) -> Option<Self> {
        let from = &mut from;
        let program = text(from)?;
        let count = number(from)?;
        // A note is eight bytes at least, so that a count that lies ends soon.
        let mut notes = Vec::new();
        for _ in 0..count {
            notes.push((text(from)?, text(from)?));
        }
        let mut next = || number(from);
        let size = [next()?, next()?];
        let crop = Crop { x: next()?, y: next()?, width: next()?, height: next()? };
        let (seed, clamp) = (next()?, f32::from_bits(next()?));
        let [reuse, caustics] = [next()? != 0, next()? != 0];
        let [halves, backdrop] = [next()? != 0, next()? != 0];
        let mattes = MattesKept::from_bits(next()?)?;
        let moments = next()?;
        let samples = next()?..=next()?;
        let (light_samples, of_octave, end, count) = (next()?, next()?, next()?, next()?);
        let mut pieces = Vec::new();
        for _ in 0..count {
            pieces.push(Piece { places: next()?..next()?, samples: next()?..next()? });
        }
        let mut part = [0; 7];
        for number in &mut part {
            *number = next()?;
        }
        let mut counters = [0; 9];
        for counter in &mut counters {
            *counter = long(from)?;
        }
        let real = |from: &mut &[u8]| long(from).map(f64::from_bits);
        let unit = real(from)?;
        let costs = Costs { total: real(from)?, reuse: real(from)?, caustics: real(from)?, clamp: real(from)? };
        let octave =
            Octave { samples: of_octave, differences: [real(from)?, real(from)?, real(from)?], pixels: real(from)? };
        let paper = real(from)?;
        let mut layers = Vec::new();
        for _ in 0..number(from)? {
            let name = text(from)?;
            layers.push(SavedLayer { name, units: [real(from)?, real(from)?, real(from)?, real(from)?] });
        }
        let (of_background, count) = (number(from)?, number(from)?);
        let names = (0..count).map(|_| text(from)).collect::<Option<Vec<_>>>()?;
        let groups = FilmGroups::from_number(of_background, names);
        let adaptive = match number(from)? {
            0 => None,
            length => Some(Arc::new(Adaptive::from_bytes(size, from.split_off(..length as usize)?)?)),
        };
        let head = FilmHead {
            program,
            notes,
            size,
            crop,
            seed,
            clamp: Some(clamp).filter(|&clamp| clamp != 0.0),
            samples,
            counters: counters_from_array(counters),
            part: Part::from_numbers(part, crop),
            unit,
            light_samples,
            octave,
            unfinished: (end > 0).then_some(Unfinished { end, pieces }),
            costs,
            reuse,
            caustics,
            layers,
            halves,
            moments,
            backdrop,
            paper,
            mattes,
            groups,
            adaptive,
        };
        (from.is_empty() && head.is_sound()).then_some(head)
    }

    /// Whether it can be what a film has written.
    fn is_sound(&self) -> bool {
        let whole = *self.samples.start();
        let rest = self.unfinished.as_ref().is_none_or(|Unfinished { end, pieces }| {
            let within = |piece: &Piece| {
                let Piece { places, samples } = piece;
                places.start < places.end
                    && whole <= samples.start
                    && samples.start < samples.end
                    && samples.end <= *end
            };
            // A pass has one guide: it ends at a power of two at the latest.
            let latest = (u64::from(whole) + 1).next_power_of_two();
            whole < *end && u64::from(*end) <= latest && pieces.iter().all(within)
        });
        let end = self.unfinished.as_ref().map_or(whole, |rest| rest.end);
        self.size.iter().all(|side| (1..=MAX_SIDE).contains(side))
            && self.crop.within(self.size) == self.crop
            && self.part.is_none_or(|part| part.is_sound(self.size) && whole >= part.first && end <= part.end)
            && self.clamp.is_none_or(|limit| limit > 0.0 && limit.is_finite())
            && (self.unit > 0.0 && self.unit.is_normal())
            && self.layers.iter().flat_map(|layer| layer.units).all(f64::is_finite)
            && rest
            && (self.paper >= 0.0 && self.paper.is_finite())
            && matches!(self.moments, 0 | 1 | QUARTERS)
            && self.samples.end() >= self.samples.start()
            && *self.samples.end() <= end
            && (self.adaptive.is_none() || end >= FROM && self.moments == 0)
            && self.light_samples <= end
            && (self.octave.is_sound() && self.octave.samples <= whole)
            && self.part.is_none_or(|_| self.octave == Octave::default())
            // What is added to them later does not overflow.
            && counters_as_array(self.counters).iter().all(|&count| count < 1 << 60)
    }

    /// Samples of a pixel at most.
    pub(super) fn most(&self) -> u32 {
        self.samples.end().saturating_sub(self.part.map_or(0, |part| part.first))
    }

    /// Bytes of memory that the film takes at most.
    pub fn bytes(&self) -> u64 {
        let layers = self.layers.iter().filter_map(|layer| Some(layer.layer()?.layer)).collect();
        Film::bytes_of(self.crop, self.clamp.is_some(), true, layers, self.halves)
            + tile_count(self.crop) as u64
                * (self.mattes.bytes() + TileGroups::most_bytes(self.light_groups().len())) as u64
    }

    /// The mattes that it holds.
    pub fn mattes(&self) -> MattesKept {
        self.mattes
    }

    /// Whether what is seen behind everything is kept apart.
    pub fn has_backdrop(&self) -> bool {
        self.backdrop
    }

    /// No tile's record is longer.
    pub(super) fn longest_tile(&self) -> u32 {
        let mattes = longest_record(self.mattes, *self.samples.end());
        let more = mattes.saturating_add(TileGroups::longest_record(self.light_groups().len()));
        u32::try_from(more.saturating_add(LONGEST_TILE.into())).unwrap_or(u32::MAX)
    }

    /// The names of the layers that it holds, as files have them.
    pub fn layers(&self) -> impl Iterator<Item = &str> {
        self.layers.iter().map(|layer| layer.name.as_str())
    }

    /// Whether a tile that was read holds what the head says.
    pub(super) fn has(&self, tile: &Tile, kept: Kept) -> bool {
        tile.taken.is_some() == self.clamp.is_some()
            && tile.half.is_some() == self.halves
            && (tile.missed.is_none() || self.backdrop)
            && (tile.layers.is_none() || kept != Kept::default())
            && tile.mattes.as_ref().is_none_or(|_| !self.mattes.is_empty())
            && (tile.groups.is_none() || !self.light_groups().is_empty())
    }

    /// Whether two halves of the samples are kept apart.
    pub fn has_halves(&self) -> bool {
        self.halves
    }

    /// The layers, as this program has them.
    pub(super) fn film_layers(&self) -> Result<Vec<FilmLayer>, FilmError> {
        let layers: Option<Vec<FilmLayer>> = self.layers.iter().map(SavedLayer::layer).collect();
        layers.ok_or_else(|| FilmError::Program(self.program.clone()))
    }
}

fn text(from: &mut &[u8]) -> Option<String> {
    let length = number(from)? as usize;
    String::from_utf8(from.split_off(..length)?.to_vec()).ok()
}

pub(super) fn number(from: &mut &[u8]) -> Option<u32> {
    from.split_off(..4)?.try_into().ok().map(u32::from_le_bytes)
}

fn long(from: &mut &[u8]) -> Option<u64> {
    from.split_off(..8)?.try_into().ok().map(u64::from_le_bytes)
}

fn counters_as_array(counters: Counters) -> [u64; 9] {
    let Counters { camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond, cut } =
        counters;
    [camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond, cut]
}

fn counters_from_array(counters: [u64; 9]) -> Counters {
    let [camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond, cut] = counters;
    Counters { camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond, cut }
}

/// Tiles that the pixels of a crop lie in.
pub(super) fn tile_count(crop: Crop) -> usize {
    let tiles = |first: u32, length: u32| ((first + length).div_ceil(TILE) - first / TILE) as usize;
    tiles(crop.x, crop.width) * tiles(crop.y, crop.height)
}
