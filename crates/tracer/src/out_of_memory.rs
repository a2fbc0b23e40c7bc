//! The end of a program that gets no more memory. Where the code can go on without a block, it is told so and says
//! what it was for; everywhere else the standard library aborts. That becomes an error here, without what is half
//! written.

use std::cell::Cell;
use std::ffi::c_int;
use std::io::{Cursor, Write};
use tracer::failure::exit;
use tracer::write::try_remove_unfinished;

thread_local! {
    /// Bytes of the last block that this thread did not get.
    static REFUSED: Cell<usize> = const { Cell::new(0) };
}

/// Of the allocator: this thread has not got a block.
pub fn refused(bytes: usize) {
    REFUSED.set(bytes);
}

/// From now on an abort for the sake of memory is an error.
pub fn listen() {
    let end: extern "C" fn(c_int) = end;
    // SAFETY: it asks for nothing that an abort, which comes of the program itself and never in the middle of a call
    // to the system's allocator, would not allow.
    unsafe { libc::signal(libc::SIGABRT, end as libc::sighandler_t) };
}

extern "C" fn end(signal: c_int) {
    let bytes = REFUSED.get();
    if bytes == 0 {
        // Another kind of abort: once this returns, the C library ends the program as ever.
        // SAFETY: as `listen`.
        unsafe { libc::signal(signal, libc::SIG_DFL) };
        return;
    }
    try_remove_unfinished();
    let mut line = [0_u8; 256];
    let mut to = Cursor::new(&mut line[..]);
    // It fits; and nobody could be told that it does not.
    let _ = writeln!(
        to,
        "error: there is no more memory: {} KiB were not to be had; allow more, or render a smaller picture (--size, \
         --crop) or scene",
        bytes.div_ceil(1024)
    );
    let count = to.position() as usize;
    // SAFETY: these bytes are there. The process ends without running anything else, as an abort does.
    unsafe {
        libc::write(libc::STDERR_FILENO, line.as_ptr().cast(), count);
        libc::_exit(exit::FAILED.into());
    }
}
