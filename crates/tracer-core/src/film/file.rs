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

use super::head::{FilmHead, number, tile_count};
use super::record::{Records, read_tile, record};
use super::{Crop, Film, TILE, Tile};
use bytemuck::Zeroable;
use bytemuck::allocation::try_zeroed_vec;
use rayon::prelude::*;
use std::io::{self, Read, Write};
use xxhash_rust::xxh3::Xxh3Default;

/// No text begins so, and what changes the ends of lines breaks it.
pub(super) const MAGIC: [u8; 8] = *b"\x89FILM\r\n\x1a";
/// The version of the format.
pub(super) const FORMAT: u32 = 13;
/// No head is longer.
const LONGEST_HEAD: u32 = 1 << 26;

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
    #[error("it is no checkpoint, and no part of a picture")]
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
        let most = self.head.most();
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
                read_tile(bytes, head.most(), held, tile)?;
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
        (film.moments, film.paper) = (head.moments, head.paper);
        film.keep_adaptive(head.adaptive);
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
