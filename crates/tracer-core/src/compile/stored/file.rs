//! The files of a cache: a head, checksums, arrays as they lie in memory.
//!
//! They are read, not mapped: into memory of the program's own, on large pages, by all threads, each piece held
//! against its checksum while it is in the processor's caches. A mapped file that another process cuts would end the
//! program, one that it writes to would be another tree than the one that was looked at; and walking a tree on the
//! pages of a mapped file is slower.

use super::Key;
use crate::film::PROGRAM;
use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;
use xxhash_rust::xxh3::xxh3_64;

const MAGIC: [u8; 8] = *b"\x89TKEPT\r\n";
const VERSION: u32 = 1;

/// Bytes that have a checksum of their own: few enough for a core's cache.
const PIECE: usize = 1 << 20;

/// A file has no more arrays.
const MOST_SECTIONS: u32 = 16;

/// What a file holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum KeptKind {
    /// A mesh as it was read.
    Mesh,
    /// A tree as it was built.
    Tree,
}

impl KeptKind {
    /// In one word.
    pub fn name(self) -> &'static str {
        match self {
            KeptKind::Mesh => "mesh",
            KeptKind::Tree => "tree",
        }
    }

    fn number(self) -> u32 {
        match self {
            KeptKind::Mesh => 1,
            KeptKind::Tree => 2,
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Head {
    magic: [u8; 8],
    version: u32,
    /// 1 in the order of bytes of the machine that has written the file: all its numbers are in that order.
    order: u32,
    kind: u32,
    sections: u32,
    key: [u8; 16],
    /// Of the whole file.
    bytes: u64,
    program: [u8; 40],
    /// Of all before it, and of the lengths and checksums after it.
    sum: u64,
}

/// What is wrong with a file.
#[derive(Debug, thiserror::Error)]
pub enum KeptError {
    /// The system says so.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// It begins as no such file does.
    #[error("it is no file of a cache")]
    Foreign,
    /// Another program has written it, or a machine with another order of bytes.
    #[error("another version of the program made it, or a machine of another kind")]
    Elsewhere,
    /// It is not as long as it says.
    #[error("it has {found} bytes in place of {expected}")]
    Cut {
        /// Bytes that it should have.
        expected: u64,
        /// Bytes that it has.
        found: u64,
    },
    /// Some of it is not what was written.
    #[error("its checksum is wrong")]
    Sum,
    /// It is sound, and still not what it should be.
    #[error("{0}")]
    Unfit(&'static str),
    /// There is no memory for it.
    #[error("no memory for {0} bytes of it")]
    Memory(u64),
}

/// A file whose head was read.
#[derive(Debug)]
pub struct KeptFile {
    file: File,
    /// What it holds.
    pub kind: KeptKind,
    /// Its size.
    pub bytes: u64,
    /// The program that made it.
    pub program: String,
    key: u128,
    sections: Vec<Section>,
}

#[derive(Debug)]
struct Section {
    at: u64,
    bytes: u64,
    sums: Vec<u64>,
}

/// Whether a file begins as those of a cache do.
pub fn is_kept_file(path: &Path) -> bool {
    let mut magic = [0; MAGIC.len()];
    path.is_file() && File::open(path).and_then(|mut file| file.read_exact(&mut magic)).is_ok() && magic == MAGIC
}

/// Bytes of a file of such arrays.
pub(super) fn bytes_of(sections: &[&[u8]]) -> u64 {
    let one = |section: &&[u8]| (8 + 8 * section.len().div_ceil(PIECE) + section.len()) as u64;
    size_of::<Head>() as u64 + sections.iter().map(one).sum::<u64>()
}

/// Writes a file; gives its size.
pub(super) fn write(to: &mut dyn Write, key: &Key, sections: &[&[u8]]) -> io::Result<u64> {
    let mut tables: Vec<u64> = sections.iter().map(|section| section.len() as u64).collect();
    tables.extend(sections.iter().flat_map(|section| section.chunks(PIECE).map(xxh3_64)));
    let mut program = [0; 40];
    program.iter_mut().zip(PROGRAM.bytes()).for_each(|(to, byte)| *to = byte);
    let bytes = bytes_of(sections);
    let head = Head {
        magic: MAGIC,
        version: VERSION,
        order: 1,
        kind: key.kind.number(),
        sections: sections.len() as u32,
        key: key.hash.to_le_bytes(),
        bytes,
        program,
        sum: 0,
    };
    let tables: &[u8] = bytemuck::cast_slice(&tables);
    to.write_all(bytemuck::bytes_of(&Head { sum: sum(&head, tables), ..head }))?;
    to.write_all(tables)?;
    sections.iter().try_for_each(|section| to.write_all(section))?;
    Ok(bytes)
}

/// The checksum of a head and what comes after it.
fn sum(head: &Head, tables: &[u8]) -> u64 {
    let head = Head { sum: 0, ..*head };
    xxh3_64(&[bytemuck::bytes_of(&head), tables].concat())
}

impl KeptFile {
    /// Reads the head of a file.
    ///
    /// # Errors
    /// When it is no such file, or cut short, or damaged.
    pub fn open(file: File) -> Result<Self, KeptError> {
        let found = file.metadata()?.len();
        let mut head = Head::zeroed();
        if found < size_of::<Head>() as u64 {
            return Err(KeptError::Foreign);
        }
        read_at(&file, bytemuck::bytes_of_mut(&mut head), 0)?;
        if head.magic != MAGIC {
            return Err(KeptError::Foreign);
        }
        if head.version != VERSION || head.order != 1 || head.sections > MOST_SECTIONS {
            return Err(KeptError::Elsewhere);
        }
        if head.bytes != found {
            return Err(KeptError::Cut { expected: head.bytes, found });
        }
        let kind = [KeptKind::Mesh, KeptKind::Tree].into_iter().find(|kind| kind.number() == head.kind);
        let (lengths, mut at) = table(&file, size_of::<Head>() as u64, head.sections.into(), found)?;
        // No sum is larger than what is a file's size.
        let pieces = lengths.iter().try_fold(0u64, |sum, bytes| sum.checked_add(bytes.div_ceil(PIECE as u64)));
        let (sums, after) = table(&file, at, pieces.ok_or(KeptError::Sum)?, found)?;
        let tables: Vec<u64> = lengths.iter().chain(&sums).copied().collect();
        if sum(&head, bytemuck::cast_slice(&tables)) != head.sum {
            return Err(KeptError::Sum);
        }
        at = after;
        let mut rest = sums.into_iter();
        let mut sections = Vec::new();
        for bytes in lengths {
            sections.push(Section {
                at,
                bytes,
                sums: rest.by_ref().take(bytes.div_ceil(PIECE as u64) as usize).collect(),
            });
            at = at.checked_add(bytes).ok_or(KeptError::Sum)?;
        }
        let Some(kind) = kind.filter(|_| at == found) else { return Err(KeptError::Sum) };
        let program = head.program.iter().take_while(|byte| **byte != 0).map(|byte| char::from(*byte)).collect();
        Ok(KeptFile { file, kind, bytes: found, program, key: u128::from_le_bytes(head.key), sections })
    }

    /// Sees that it is the one that was asked for.
    pub(super) fn expect(self, key: &Key) -> Result<Self, KeptError> {
        let is_it = self.kind == key.kind && self.key == key.hash && self.program == PROGRAM;
        if is_it { Ok(self) } else { Err(KeptError::Unfit("it is another one under this name")) }
    }

    /// Reads all of it.
    ///
    /// # Errors
    /// When some of it is not what was written.
    pub fn check(&self) -> Result<(), KeptError> {
        let mut piece = vec![0; PIECE];
        for section in &self.sections {
            for (k, sum) in section.sums.iter().enumerate() {
                let from = (k * PIECE) as u64;
                let length = (section.bytes - from).min(PIECE as u64) as usize;
                read_piece(&self.file, &mut piece[..length], section.at + from, *sum)?;
            }
        }
        Ok(())
    }

    fn section(&self, k: usize) -> Result<&Section, KeptError> {
        self.sections.get(k).ok_or(KeptError::Unfit("it has fewer arrays"))
    }

    /// The bytes of an array.
    pub(super) fn length(&self, k: usize) -> Result<u64, KeptError> {
        self.section(k).map(|section| section.bytes)
    }

    /// Reads an array to where there is room for exactly that.
    pub(super) fn fill(&self, k: usize, to: &mut [u8]) -> Result<(), KeptError> {
        let section = self.section(k)?;
        if section.bytes != to.len() as u64 {
            return Err(KeptError::Unfit("its arrays are not as long as they should be"));
        }
        to.par_chunks_mut(PIECE)
            .zip(&section.sums)
            .enumerate()
            .try_for_each(|(k, (piece, sum))| read_piece(&self.file, piece, section.at + (k * PIECE) as u64, *sum))
    }

    /// Reads an array.
    pub(super) fn array<T: Pod>(&self, k: usize) -> Result<Vec<T>, KeptError> {
        let bytes = self.section(k)?.bytes;
        let count = bytes / size_of::<T>() as u64;
        if count * size_of::<T>() as u64 != bytes {
            return Err(KeptError::Unfit("its arrays are not as long as they should be"));
        }
        let memory = |_| KeptError::Memory(bytes);
        let mut array = usize::try_from(count).map_err(|_| KeptError::Memory(bytes)).and_then(|count| {
            // No more than the file has.
            bytemuck::allocation::try_zeroed_vec(count).map_err(memory)
        })?;
        self.fill(k, bytemuck::cast_slice_mut(&mut array))?;
        Ok(array)
    }
}

/// So many numbers that begin at a byte, and the byte after them.
fn table(file: &File, at: u64, count: u64, found: u64) -> Result<(Vec<u64>, u64), KeptError> {
    let end = count.checked_mul(8).and_then(|bytes| bytes.checked_add(at)).filter(|end| *end <= found);
    let end = end.ok_or(KeptError::Sum)?;
    let mut table = bytemuck::allocation::try_zeroed_vec(count as usize).map_err(|()| KeptError::Memory(8 * count))?;
    read_at(file, bytemuck::cast_slice_mut(&mut table), at)?;
    Ok((table, end))
}

fn read_piece(file: &File, to: &mut [u8], at: u64, sum: u64) -> Result<(), KeptError> {
    read_at(file, to, at)?;
    if xxh3_64(to) == sum { Ok(()) } else { Err(KeptError::Sum) }
}

#[cfg(unix)]
fn read_at(file: &File, to: &mut [u8], at: u64) -> io::Result<()> {
    std::os::unix::fs::FileExt::read_exact_at(file, to, at)
}

#[cfg(windows)]
fn read_at(file: &File, mut to: &mut [u8], mut at: u64) -> io::Result<()> {
    while !to.is_empty() {
        match std::os::windows::fs::FileExt::seek_read(file, to, at) {
            Ok(0) => return Err(io::ErrorKind::UnexpectedEof.into()),
            Ok(count) => (to, at) = (&mut to[count..], at + count as u64),
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}
