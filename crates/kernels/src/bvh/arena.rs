//! One block of memory for the whole tree: zeroed, aligned to cache lines, on huge pages where the system grants them.

use super::layout::Unit;
use memmap2::MmapMut;

const HUGE_PAGE: usize = 2 << 20;

/// The units of a tree. References to them are counted from the first.
pub struct Arena {
    map: MmapMut,
    /// Bytes to skip so that the first unit starts on a huge page (or at least on a page).
    start: usize,
    bytes: usize,
}

impl Arena {
    /// `units` units of zero bytes. Pages that are never written cost nothing.
    pub fn new(units: usize) -> std::io::Result<Self> {
        let bytes = units * size_of::<Unit>();
        let slack = if bytes >= HUGE_PAGE { HUGE_PAGE } else { 0 };
        let map = MmapMut::map_anon((bytes + slack).max(1))?;
        let start = if slack == 0 { 0 } else { map.as_ptr().align_offset(HUGE_PAGE) };
        // Page walks cost 13 % on trees beyond the caches. A system without huge pages refuses, and all still works.
        #[cfg(target_os = "linux")]
        if slack != 0 {
            let _ = map.advise(memmap2::Advice::HugePage);
        }
        Ok(Self { map, start, bytes })
    }

    pub fn units(&self) -> &[Unit] {
        bytemuck::cast_slice(&self.map[self.start..self.start + self.bytes])
    }

    pub fn units_mut(&mut self) -> &mut [Unit] {
        bytemuck::cast_slice_mut(&mut self.map[self.start..self.start + self.bytes])
    }

    pub fn bytes(&self) -> usize {
        self.bytes
    }
}
