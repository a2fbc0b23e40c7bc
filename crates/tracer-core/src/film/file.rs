//! A film as a file: written from one or from a rendering at work ([`super::state`]), and read with nothing taken on
//! trust.
//!
//! All numbers have their lowest byte first.
//!
//! | bytes | what |
//! |---|---|
//! | 8 | [`MAGIC`] |
//! | 4 | [`FORMAT`] |
//! | 4 | length of the head |
//! | | the head: program, notes, picture, how far it is, counters ([`FilmHead`]) |
//! | 8 | checksum (XXH3, 64 bits) of all before |
//! | | the tiles, in any order: number (4), length (4), sums ([`super::pack`]) |
//! | 8 | checksum of all before |

use super::layers::SavedLayer;
use super::mattes::longest_record;
use super::record::{Records, read_tile, record};
use super::{Crop, Film, FilmGroups, FilmLayer, MattesKept, Octave, Part, Piece, TILE, Tile, TileGroups, Unfinished};
use bytemuck::Zeroable;
use bytemuck::allocation::try_zeroed_vec;
use rayon::prelude::*;
use std::io::{self, Read, Write};
use std::ops::RangeInclusive;
use tracer_kernels::layers::Kept;
use tracer_kernels::report::{Costs, Counters};
use xxhash_rust::xxh3::Xxh3Default;

/// No text begins so, and what changes the ends of lines breaks it.
const MAGIC: [u8; 8] = *b"\x89FILM\r\n\x1a";
/// The version of the format.
const FORMAT: u32 = 7;
/// No head is longer, and no tile.
const LONGEST_HEAD: u32 = 1 << 26;
const LONGEST_TILE: u32 = 1 << 18;
/// Pixels along a side at most.
const MAX_SIDE: u32 = 1 << 16;

/// The program that a film is of: its version, and a checksum of the engine's sources. Films of two programs do not
/// mix.
pub const PROGRAM: &str = concat!(env!("CARGO_PKG_VERSION"), "+", env!("TRACER_SOURCES"));

/// What whoever saves a film writes beside it: a name and a value.
pub type Note = (String, String);

/// Why a saved film cannot be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FilmError {
    /// It could not be read.
    #[error("it cannot be read: {0}")]
    Io(#[from] io::Error),
    /// It is something else.
    #[error("it is no film")]
    Foreign,
    /// It is of a later version of this library.
    #[error("it has version {0} of the format; this program knows version {FORMAT}")]
    Format(u32),
    /// It is cut short, or its bytes are not those that were written.
    #[error("it is damaged: {0}")]
    Damaged(&'static str),
    /// There is not so much memory.
    #[error("it takes {0} bytes of memory, which are not to be had")]
    Memory(u64),
    /// Another version of the program made it: [`Film::load`] only.
    #[error("version {0} of the program made it, and this is version {PROGRAM}")]
    Program(String),
}

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
    pub(super) backdrop: bool,
    pub(super) mattes: MattesKept,
    pub(super) groups: FilmGroups,
}

impl FilmHead {
    /// Of a film, with what is to be told beside it.
    pub(super) fn of(film: &Film) -> Self {
        // Of a pass that was ended early somebody wants to know how far it came.
        let most = film.unfinished.as_ref().map_or(film.whole, |_| film.first() + film.samples().end());
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
            backdrop: film.backdrop,
            mattes: film.mattes,
            groups: film.groups.clone(),
        }
    }

    /// Magic, format, length and head, without the checksum.
    fn to_bytes(&self) -> Vec<u8> {
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
        numbers.push(self.mattes.bits());
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
        let reals = costs.into_iter().chain(self.octave.differences).map(f64::to_bits);
        out.extend(counters.into_iter().chain(reals).flat_map(u64::to_le_bytes));
        out.extend((self.layers.len() as u32).to_le_bytes());
        for SavedLayer { name, units } in &self.layers {
            text(name, &mut out);
            out.extend(units.iter().flat_map(|x| x.to_bits().to_le_bytes()));
        }
        out.extend(self.groups.numbers().into_iter().flat_map(u32::to_le_bytes));
        self.groups.names.iter().for_each(|name| text(name, &mut out));
        let mut head = MAGIC.to_vec();
        head.extend([FORMAT, out.len() as u32].into_iter().flat_map(u32::to_le_bytes));
        head.extend(out);
        head
    }

    fn from_bytes(mut from: &[u8]) -> Option<Self> {
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
        let mut counters = [0; 8];
        for counter in &mut counters {
            *counter = long(from)?;
        }
        let real = |from: &mut &[u8]| long(from).map(f64::from_bits);
        let unit = real(from)?;
        let costs = Costs { total: real(from)?, reuse: real(from)?, caustics: real(from)?, clamp: real(from)? };
        let octave = Octave { samples: of_octave, differences: [real(from)?, real(from)?, real(from)?] };
        let mut layers = Vec::new();
        for _ in 0..number(from)? {
            let name = text(from)?;
            layers.push(SavedLayer { name, units: [real(from)?, real(from)?, real(from)?, real(from)?] });
        }
        let (of_background, count) = (number(from)?, number(from)?);
        let names = (0..count).map(|_| text(from)).collect::<Option<Vec<_>>>()?;
        let groups = FilmGroups::from_number(of_background, names);
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
            backdrop,
            mattes,
            groups,
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
            && self.samples.end() >= self.samples.start()
            && *self.samples.end() <= end
            && self.light_samples <= end
            && (self.octave.is_sound() && self.octave.samples <= whole)
            // What is added to them later does not overflow.
            && counters_as_array(self.counters).iter().all(|&count| count < 1 << 60)
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
    fn longest_tile(&self) -> u32 {
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

fn number(from: &mut &[u8]) -> Option<u32> {
    from.split_off(..4)?.try_into().ok().map(u32::from_le_bytes)
}

fn long(from: &mut &[u8]) -> Option<u64> {
    from.split_off(..8)?.try_into().ok().map(u64::from_le_bytes)
}

fn counters_as_array(counters: Counters) -> [u64; 8] {
    let Counters { camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond } =
        counters;
    [camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond]
}

fn counters_from_array(counters: [u64; 8]) -> Counters {
    let [camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond] = counters;
    Counters { camera_rays, scattered_rays, shadow_rays, segments, photon_rays, chain_rays, dropped, beyond }
}

/// Writes a film from its parts, and sums what goes through.
pub(super) struct FilmWriter<W: Write> {
    to: io::BufWriter<W>,
    sum: Xxh3Default,
    bytes: u64,
}

impl<W: Write> FilmWriter<W> {
    pub fn new(to: W, head: &FilmHead) -> io::Result<Self> {
        let mut writer =
            FilmWriter { to: io::BufWriter::with_capacity(1 << 20, to), sum: Xxh3Default::new(), bytes: 0 };
        let head = head.to_bytes();
        if head.len() as u64 > u64::from(LONGEST_HEAD) {
            return Err(io::Error::other("the notes beside the film are too long"));
        }
        writer.put(&head)?;
        writer.put_sum()?;
        Ok(writer)
    }

    /// Goes on with a tile's record.
    pub fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.sum.update(bytes);
        self.bytes += bytes.len() as u64;
        self.to.write_all(bytes)
    }

    fn put_sum(&mut self) -> io::Result<()> {
        let sum = self.sum.digest();
        self.put(&sum.to_le_bytes())
    }

    /// Ends it; how many bytes it has.
    pub fn end(mut self) -> io::Result<u64> {
        self.put_sum()?;
        self.to.flush()?;
        Ok(self.bytes)
    }
}

/// A saved film, of which only the head has been read, so that it can be refused before any memory is spent on it.
///
/// # Examples
///
/// See [`Film::save`].
pub struct SavedFilm<R: Read> {
    from: io::BufReader<R>,
    sum: Xxh3Default,
    head: FilmHead,
}

impl<R: Read> SavedFilm<R> {
    /// Reads the head.
    ///
    /// # Errors
    /// When it cannot be read or is not the head of a film.
    pub fn open(from: R) -> Result<Self, FilmError> {
        let mut from = io::BufReader::with_capacity(1 << 20, from);
        let mut start = Vec::new();
        from.by_ref().take(16).read_to_end(&mut start)?;
        if !start.starts_with(&MAGIC) {
            return Err(if MAGIC.starts_with(&start) {
                FilmError::Damaged("it is cut short")
            } else {
                FilmError::Foreign
            });
        }
        let mut rest = &start[8..];
        let (Some(format), Some(length)) = (number(&mut rest), number(&mut rest)) else {
            return Err(FilmError::Damaged("it is cut short"));
        };
        if format != FORMAT {
            return Err(FilmError::Format(format));
        }
        if length > LONGEST_HEAD {
            return Err(FilmError::Damaged("its head is wrong"));
        }
        // Grows with what comes: a length that lies takes no memory.
        let mut bytes = Vec::new();
        from.by_ref().take(u64::from(length)).read_to_end(&mut bytes)?;
        let mut sum = Xxh3Default::new();
        sum.update(&start);
        sum.update(&bytes);
        if bytes.len() < length as usize {
            return Err(FilmError::Damaged("it is cut short"));
        }
        check_sum(&mut from, &mut sum)?;
        let head = FilmHead::from_bytes(&bytes).ok_or(FilmError::Damaged("its head is wrong"))?;
        Ok(SavedFilm { from, sum, head })
    }

    /// What it tells about itself.
    pub fn head(&self) -> &FilmHead {
        &self.head
    }

    /// Reads on, and says whether all is as it was written, without making a film of it.
    ///
    /// # Errors
    /// When it cannot be read, or is not.
    pub fn check(mut self) -> Result<FilmHead, FilmError> {
        let most = *self.head.samples.end();
        let held = self.head.held(&self.head.film_layers()?);
        self.tiles(|records| {
            let read = |(_, bytes): (usize, &[u8])| read_tile(bytes, most, held, &mut Tile::zeroed());
            records.par_iter().try_for_each(read)
        })?;
        Ok(self.head)
    }

    /// Reads the film, whichever program made it.
    ///
    /// # Errors
    /// When it cannot be read, is not as it was written, or takes more memory than there is.
    pub fn film(mut self) -> Result<Film, FilmError> {
        let layers = self.head.film_layers()?;
        let held = self.head.held(&layers);
        let mut tiles: Vec<Tile> =
            try_zeroed_vec(tile_count(self.head.crop)).map_err(|()| FilmError::Memory(self.head.bytes()))?;
        let head = self.head.clone();
        self.tiles(|records| {
            records.beside(&mut tiles, 0)?.into_par_iter().try_for_each(|(tile, bytes)| {
                read_tile(bytes, *head.samples.end(), held, tile)?;
                head.has(tile, held.kept).then_some(())
            })
        })?;
        // Without tiles: theirs are at hand.
        let nothing = Crop { width: 0, height: 0, ..head.crop };
        let mut film = Film::new(head.size, nothing, head.seed, head.unit, head.clamp);
        let columns = (head.crop.x + head.crop.width).div_ceil(TILE) - head.crop.x / TILE;
        (film.crop, film.part, film.tiles, film.tile_columns) = (head.crop, head.part, tiles, columns);
        (film.whole, film.unfinished) = (*head.samples.start(), head.unfinished);
        (film.light_samples, film.octave) = (head.light_samples, head.octave);
        (film.counters, film.costs) = (head.counters, head.costs);
        (film.reuse, film.caustics, film.layers, film.halves) = (head.reuse, head.caustics, layers, head.halves);
        (film.backdrop, film.mattes, film.groups) = (head.backdrop, head.mattes, head.groups);
        Ok(film)
    }

    /// Reads the tiles, each once, and the checksum. Some records come at a time, for all cores to look at.
    pub(super) fn tiles(&mut self, mut keep: impl FnMut(&Records) -> Option<()>) -> Result<(), FilmError> {
        let count = tile_count(self.head.crop);
        let mut seen = vec![false; count];
        let mut records = Records::default();
        let longest = self.head.longest_tile();
        for left in (0..count).rev() {
            let mut start = [0; 8];
            self.from.read_exact(&mut start).map_err(cut_short)?;
            self.sum.update(&start);
            let [place, length] = [0, 4].map(|k| number(&mut &start[k..]).unwrap_or(u32::MAX));
            let first = seen.get_mut(place as usize).is_some_and(|seen| !std::mem::replace(seen, true));
            if !first || length > longest {
                return Err(FilmError::Damaged("a tile is wrong"));
            }
            // Grows with what comes: a length that lies takes no memory.
            let bytes = records.add(place as usize, &mut self.from.by_ref().take(u64::from(length)))?;
            if bytes.len() < length as usize {
                return Err(FilmError::Damaged("it is cut short"));
            }
            self.sum.update(bytes);
            if left == 0 || records.is_full() {
                keep(&records).ok_or(FilmError::Damaged("a tile is wrong"))?;
                records.clear();
            }
        }
        check_sum(&mut self.from, &mut self.sum)?;
        match self.from.read_exact(&mut [0]) {
            Ok(()) => Err(FilmError::Damaged("it goes on behind its end")),
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(()),
            Err(error) => Err(error.into()),
        }
    }
}

/// Sees that the next eight bytes are what all before sum to.
fn check_sum(from: &mut impl Read, sum: &mut Xxh3Default) -> Result<(), FilmError> {
    let expected = sum.digest().to_le_bytes();
    let mut found = [0; 8];
    from.read_exact(&mut found).map_err(cut_short)?;
    sum.update(&found);
    if found == expected { Ok(()) } else { Err(FilmError::Damaged("its checksum is wrong")) }
}

fn cut_short(error: io::Error) -> FilmError {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => FilmError::Damaged("it is cut short"),
        _ => FilmError::Io(error),
    }
}

fn tile_count(crop: Crop) -> usize {
    let tiles = |first: u32, length: u32| ((first + length).div_ceil(TILE) - first / TILE) as usize;
    tiles(crop.x, crop.width) * tiles(crop.y, crop.height)
}

impl Film {
    /// Writes the film, with notes that [`SavedFilm::head`] gives back; gives its bytes. It has some 23 bytes a
    /// pixel, 43 where light paths fall: a quarter and a third of the memory.
    ///
    /// # Errors
    /// When it cannot be written; when it was merged with gaps.
    ///
    /// # Examples
    ///
    /// A rendering that goes on where an earlier one has ended:
    ///
    /// ```
    /// use std::path::Path;
    /// use tracer_core::{Film, RenderOptions, Unobserved, compile, render, resume};
    ///
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let text = "Scene(background: 1, image: Image(width: 8, height: 8), objects: [Sphere(center: (0, 0, 0), radius:
    /// 1)])"; let loaded = scene_format::load_str("ball.ron", text, scene_format::Syntax::Ron, Path::new("."), &[])?;
    /// let scene = compile(&loaded.scene)?; let samples = |count| RenderOptions { samples: Some(count),
    /// ..RenderOptions::default() };
    ///
    /// let mut file = Vec::new();
    /// render(&scene, &samples(3), &Unobserved).save(&mut file, &[("scene".into(), "ball.ron".into())])?;
    ///
    /// let film = Film::load(&mut file.as_slice())?;
    /// let film = resume(&scene, &samples(10), film, &Unobserved)?;
    /// let at_once = render(&scene, &samples(10), &Unobserved);
    /// assert_eq!(film.radiance(4, 4), at_once.radiance(4, 4));
    /// assert_eq!(film.counters, at_once.counters);
    /// # Ok(())
    /// # }
    /// ```
    pub fn save(&self, to: &mut impl Write, notes: &[Note]) -> io::Result<u64> {
        if self.has_gaps {
            return Err(io::Error::other("samples of it are missing"));
        }
        let head = FilmHead { notes: notes.to_vec(), ..FilmHead::of(self) };
        let mut writer = FilmWriter::new(to, &head)?;
        for (place, tile) in self.tiles.iter().enumerate() {
            writer.put(&record(place, tile))?;
        }
        writer.end()
    }

    /// Reads a film that [`Film::save`] has written. [`SavedFilm`] does it in two steps, so that one can look before.
    ///
    /// # Errors
    /// When it cannot be read, is damaged or no film, or another version of the program made it: then its samples do
    /// not mix with ours.
    pub fn load(from: &mut impl Read) -> Result<Self, FilmError> {
        let saved = SavedFilm::open(from)?;
        if saved.head.program != PROGRAM {
            return Err(FilmError::Program(saved.head.program));
        }
        saved.film()
    }
}
