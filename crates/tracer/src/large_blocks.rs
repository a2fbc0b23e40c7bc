//! Large blocks of memory: on huge pages, and the system's again as soon as they are freed.

use crate::out_of_memory::refused;
use std::alloc::{GlobalAlloc, Layout, System};

/// Has the C library give large blocks back to the system as soon as they are freed. By itself it keeps blocks of up to
/// 32 MB for later, once such a block has been freed; a mesh of a million triangles left 48 of 184 MB to it, most of
/// them for good (docs/performance.md).
#[cfg(target_env = "gnu")]
pub fn give_back() {
    const LARGE: i32 = 1 << 20;
    // SAFETY: it sets two numbers of the allocator, before there is another thread.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE);
        libc::mallopt(libc::M_TRIM_THRESHOLD, LARGE);
    }
}

/// Other C libraries have no such numbers. That of musl keeps no block of 128 KiB or more.
#[cfg(not(target_env = "gnu"))]
pub fn give_back() {}

#[global_allocator]
static ALLOCATOR: OnHugePages = OnHugePages;

/// The system's allocator, which asks for huge pages where a block is large: to bring in ordinary pages one by one took
/// a sixth of the time from a mesh of a million triangles to its tree (docs/performance.md). A system without them
/// refuses, and all still works.
struct OnHugePages;

/// Two huge pages: less might not hold a whole one.
const LARGE: usize = 4 << 20;

fn advise(block: *mut u8, size: usize) {
    const PAGE: usize = 4096;
    if block.is_null() {
        refused(size);
        return;
    }
    if size < LARGE {
        return;
    }
    let skipped = block.align_offset(PAGE);
    let whole = (size - skipped) & !(PAGE - 1);
    // SAFETY: these pages lie within the block. The advice changes what backs them, not what they hold.
    unsafe { libc::madvise(block.wrapping_add(skipped).cast(), whole, libc::MADV_HUGEPAGE) };
}

// SAFETY: the system's allocator does all the work, and `advise` leaves its blocks as they are.
unsafe impl GlobalAlloc for OnHugePages {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let block = unsafe { System.alloc(layout) };
        advise(block, layout.size());
        block
    }
    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        let block = unsafe { System.alloc_zeroed(layout) };
        advise(block, layout.size());
        block
    }
    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        let block = unsafe { System.realloc(block, layout, size) };
        advise(block, size);
        block
    }
    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        unsafe { System.dealloc(block, layout) };
    }
}
