//! The program `tracer`.

use std::process::ExitCode;

fn main() -> ExitCode {
    give_back_large_blocks();
    tracer::main()
}

/// Has the C library give large blocks back to the system as soon as they are freed. By itself it keeps blocks of up to 32 MB for later, once such
/// a block has been freed; a mesh of a million triangles left 48 of 184 MB to it, most of them for good (docs/performance.md).
#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn give_back_large_blocks() {
    const LARGE: i32 = 1 << 20;
    // SAFETY: it sets two numbers of the allocator, before there is another thread.
    unsafe {
        libc::mallopt(libc::M_MMAP_THRESHOLD, LARGE);
        libc::mallopt(libc::M_TRIM_THRESHOLD, LARGE);
    }
}

#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
fn give_back_large_blocks() {}
