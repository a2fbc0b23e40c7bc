//! A layer between the program and the C library, loaded by `LD_PRELOAD`: it counts calls that concern files, and has
//! the one fail that it is told to. The test compiles it by `rustc` alone; it is no part of any crate.
//!
//! | variable | what it says |
//! |---|---|
//! | `FAULT_LOG` | the file for a line of each call: number, name, `w` or `r`, file, `FAULT` where it has failed |
//! | `FAULT_AT` | the number of the call that fails |
//! | `FAULT_HOW` | how: a number of `errno`, or `short`: only a half is read or written |
//! | `FAULT_ON` | where it is set, all calls that write fail from then on, as on a full disk |
//! | `FAULT_CALL` | the name of a call that fails for all files: for programs whose calls come in any order |
//! | `FAULT_BLOCK` | the number of the large block of memory that is not given; blocks are counted apart |
//!
//! Not counted are standard error, where the program tells of faults, and the system's own files (`/proc`, `/etc`, ..).

use std::ffi::{CStr, c_char, c_int, c_long, c_void};
use std::ptr::null_mut;
use std::sync::atomic::{AtomicI32, AtomicPtr, AtomicU8, AtomicUsize, Ordering::SeqCst};

unsafe extern "C" {
    fn dlsym(handle: *mut c_void, name: *const c_char) -> *mut c_void;
    fn getenv(name: *const c_char) -> *const c_char;
    fn syscall(number: c_long, ...) -> c_long;
    fn __errno_location() -> *mut c_int;
    fn __libc_malloc(size: usize) -> *mut c_void;
    fn __libc_calloc(count: usize, size: usize) -> *mut c_void;
    fn __libc_realloc(block: *mut c_void, size: usize) -> *mut c_void;
    fn __libc_memalign(align: usize, size: usize) -> *mut c_void;
}

#[cfg(target_arch = "x86_64")]
const WRITE: c_long = 1;
#[cfg(target_arch = "aarch64")]
const WRITE: c_long = 64;

const NEXT: *mut c_void = -1_isize as *mut c_void;
const ENOMEM: c_int = 12;
/// Blocks of at least so many bytes are counted.
const LARGE: usize = 1 << 20;
const MOST_FILES: usize = 256;
const LONGEST: usize = 64;

/// What is known of open files: whether they count, and the ends of their names.
static COUNTS: [AtomicU8; MOST_FILES] = [const { AtomicU8::new(0) }; MOST_FILES];
static NAMES: [[AtomicU8; LONGEST]; MOST_FILES] = [const { [const { AtomicU8::new(0) }; LONGEST] }; MOST_FILES];
static CALLS: AtomicUsize = AtomicUsize::new(0);
static BLOCKS: AtomicUsize = AtomicUsize::new(0);
/// The log: -2 not opened yet, -1 none.
static LOG: AtomicI32 = AtomicI32::new(-2);

fn variable(name: &CStr) -> Option<&'static [u8]> {
    // SAFETY: nobody changes the environment.
    let value = unsafe { getenv(name.as_ptr()) };
    if value.is_null() { None } else { Some(unsafe { CStr::from_ptr(value) }.to_bytes()) }
}

fn number(name: &CStr) -> Option<usize> {
    let digits = variable(name)?;
    digits.iter().try_fold(0, |sum, digit| Some(10 * sum + usize::from(digit.checked_sub(b'0').filter(|d| *d < 10)?)))
}

fn log(line: &[u8]) {
    if LOG.load(SeqCst) == -2 {
        LOG.store(-1, SeqCst);
        if let Some(path) = variable(c"FAULT_LOG") {
            // O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC
            let file = unsafe { real::open64(path.as_ptr().cast(), 0o2002101, 0o644) };
            LOG.store(file, SeqCst);
        }
    }
    let file = LOG.load(SeqCst);
    if file >= 0 {
        unsafe { syscall(WRITE, file, line.as_ptr(), line.len()) };
    }
}

/// A line without the help of an allocator.
struct Line {
    bytes: [u8; 256],
    end: usize,
}

impl Line {
    fn new() -> Self {
        Line { bytes: [0; 256], end: 0 }
    }

    fn text(&mut self, text: &[u8]) -> &mut Self {
        let count = text.len().min(self.bytes.len() - self.end);
        self.bytes[self.end..self.end + count].copy_from_slice(&text[..count]);
        self.end += count;
        self
    }

    fn number(&mut self, mut number: usize) -> &mut Self {
        let mut digits = [0; 20];
        let mut first = digits.len();
        loop {
            first -= 1;
            digits[first] = b'0' + (number % 10) as u8;
            number /= 10;
            if number == 0 {
                return self.text(&digits[first..]);
            }
        }
    }
}

/// What becomes of a call.
enum Fate {
    Done,
    Short,
    Fails(c_int),
}

/// Counts a call, and says whether it is the one. `writes`: a full disk would refuse it.
fn fate(call: &str, file: &[u8], writes: bool) -> Fate {
    let this = CALLS.fetch_add(1, SeqCst) + 1;
    let at = number(c"FAULT_AT").unwrap_or(0);
    let is_it = at > 0 && (this == at || (this > at && writes && variable(c"FAULT_ON").is_some()));
    let is_named = writes && file != b"stdout" && variable(c"FAULT_CALL") == Some(call.as_bytes());
    let is_it = is_it || is_named;
    let how = variable(c"FAULT_HOW").unwrap_or(b"5");
    let mut line = Line::new();
    line.number(this).text(b" ").text(call.as_bytes()).text(if writes { b" w " } else { b" r " }).text(file);
    line.text(if is_it { b" FAULT\n" } else { b"\n" });
    log(&line.bytes[..line.end]);
    match is_it {
        false => Fate::Done,
        true if how == b"short" => Fate::Short,
        true => Fate::Fails(number(c"FAULT_HOW").unwrap_or(5) as c_int),
    }
}

fn fails(error: c_int) -> c_int {
    unsafe { *__errno_location() = error };
    -1
}

/// Whether a file of that name counts, and the end of the name.
fn counted<'a>(path: *const c_char) -> Option<&'a [u8]> {
    if path.is_null() {
        return None;
    }
    let path = unsafe { CStr::from_ptr(path) }.to_bytes();
    let of_system = ["/proc", "/sys", "/dev", "/etc", "/usr", "/lib", "/run"];
    if path.is_empty() || of_system.iter().any(|folder| path.starts_with(folder.as_bytes())) {
        return None;
    }
    let start = path.iter().rposition(|&byte| byte == b'/').map_or(0, |at| at + 1);
    Some(if start == path.len() { path } else { &path[start..] })
}

fn remember(file: c_int, name: &[u8]) {
    if let Some(counts) = usize::try_from(file).ok().and_then(|file| COUNTS.get(file)) {
        let kept = &NAMES[file as usize];
        (0..LONGEST).for_each(|k| kept[k].store(name.get(k).copied().unwrap_or(0), SeqCst));
        counts.store(1, SeqCst);
    }
}

/// Calls `with` the name of an open file that counts.
fn of_file(file: c_int, with: impl FnOnce(&[u8]) -> Fate) -> Fate {
    if file == 1 {
        return with(b"stdout");
    }
    let Some(counts) = usize::try_from(file).ok().and_then(|file| COUNTS.get(file)) else { return Fate::Done };
    if counts.load(SeqCst) == 0 {
        return Fate::Done;
    }
    let name: [u8; LONGEST] = std::array::from_fn(|k| NAMES[file as usize][k].load(SeqCst));
    let end = name.iter().position(|&byte| byte == 0).unwrap_or(LONGEST);
    with(&name[..end])
}

/// The C library's own functions, found when they are first asked for.
mod real {
    use super::*;

    macro_rules! found {
        ($($name:ident($($of:ident: $kind:ty),*) -> $back:ty;)*) => {$(
            pub unsafe fn $name($($of: $kind),*) -> $back {
                static PLACE: AtomicPtr<c_void> = AtomicPtr::new(null_mut());
                let mut place = PLACE.load(SeqCst);
                if place.is_null() {
                    const NAME: &[u8] = concat!(stringify!($name), "\0").as_bytes();
                    place = unsafe { dlsym(NEXT, NAME.as_ptr().cast()) };
                    PLACE.store(place, SeqCst);
                }
                let function: unsafe extern "C" fn($($kind),*) -> $back = unsafe { std::mem::transmute(place) };
                unsafe { function($($of),*) }
            }
        )*};
    }

    found! {
        open64(path: *const c_char, flags: c_int, mode: c_int) -> c_int;
        close(file: c_int) -> c_int;
        fcntl(file: c_int, command: c_int, value: usize) -> c_int;
        read(file: c_int, to: *mut c_void, count: usize) -> isize;
        pread64(file: c_int, to: *mut c_void, count: usize, from: i64) -> isize;
        write(file: c_int, from: *const c_void, count: usize) -> isize;
        writev(file: c_int, from: *const c_void, count: c_int) -> isize;
        fsync(file: c_int) -> c_int;
        fdatasync(file: c_int) -> c_int;
        ftruncate64(file: c_int, length: i64) -> c_int;
        fchmod(file: c_int, mode: u32) -> c_int;
        flock(file: c_int, operation: c_int) -> c_int;
        lseek64(file: c_int, offset: i64, from: c_int) -> i64;
        mmap64(at: *mut c_void, length: usize, may: c_int, flags: c_int, file: c_int, from: i64) -> *mut c_void;
        rename(from: *const c_char, to: *const c_char) -> c_int;
        linkat(a: c_int, from: *const c_char, b: c_int, to: *const c_char, flags: c_int) -> c_int;
        unlink(path: *const c_char) -> c_int;
        mkdir(path: *const c_char, mode: u32) -> c_int;
        rmdir(path: *const c_char) -> c_int;
        readlink(path: *const c_char, to: *mut c_char, count: usize) -> isize;
        realpath(path: *const c_char, to: *mut c_char) -> *mut c_char;
        opendir(path: *const c_char) -> *mut c_void;
        statx(folder: c_int, path: *const c_char, flags: c_int, mask: u32, to: *mut c_void) -> c_int;
        copy_file_range(a: c_int, x: *mut i64, b: c_int, y: *mut i64, count: usize, flags: u32) -> isize;
    }
}

/// `O_WRONLY`, `O_RDWR`, `O_CREAT` among the flags.
fn is_for_writing(flags: c_int) -> bool {
    flags & 0o103 != 0
}

fn open(path: *const c_char, flags: c_int, mode: c_int) -> c_int {
    let Some(name) = counted(path) else { return unsafe { real::open64(path, flags, mode) } };
    let call = if is_for_writing(flags) { "create" } else { "open" };
    match fate(call, name, is_for_writing(flags)) {
        Fate::Fails(error) => fails(error),
        _ => {
            let file = unsafe { real::open64(path, flags, mode) };
            remember(file, name);
            file
        }
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn open64(path: *const c_char, flags: c_int, mode: c_int) -> c_int {
    open(path, flags, mode)
}

#[unsafe(no_mangle)]
pub extern "C" fn close(file: c_int) -> c_int {
    let fate = of_file(file, |name| fate("close", name, false));
    if let Some(counts) = usize::try_from(file).ok().and_then(|file| COUNTS.get(file)) {
        counts.store(0, SeqCst);
    }
    let closed = unsafe { real::close(file) };
    if let Fate::Fails(error) = fate { fails(error) } else { closed }
}

#[unsafe(no_mangle)]
pub extern "C" fn fcntl(file: c_int, command: c_int, value: usize) -> c_int {
    const F_DUPFD_CLOEXEC: c_int = 1030;
    let given = unsafe { real::fcntl(file, command, value) };
    if command == F_DUPFD_CLOEXEC && given >= 0 {
        of_file(file, |name| {
            remember(given, name);
            Fate::Done
        });
    }
    given
}

/// Calls that read or write so many bytes of an open file.
macro_rules! of_bytes {
    ($($name:ident, $bytes:ty, $writes:literal;)*) => {$(
        #[unsafe(no_mangle)]
        pub extern "C" fn $name(file: c_int, bytes: $bytes, count: usize) -> isize {
            match of_file(file, |of| fate(stringify!($name), of, $writes)) {
                Fate::Done => unsafe { real::$name(file, bytes, count) },
                Fate::Short => unsafe { real::$name(file, bytes, count.div_ceil(2)) },
                Fate::Fails(error) => fails(error) as isize,
            }
        }
    )*};
}

of_bytes! {
    read, *mut c_void, false;
    write, *const c_void, true;
}

#[unsafe(no_mangle)]
pub extern "C" fn pread64(file: c_int, to: *mut c_void, count: usize, from: i64) -> isize {
    match of_file(file, |of| fate("pread64", of, false)) {
        Fate::Done => unsafe { real::pread64(file, to, count, from) },
        Fate::Short => unsafe { real::pread64(file, to, count.div_ceil(2), from) },
        Fate::Fails(error) => fails(error) as isize,
    }
}

/// Calls about an open file, told as one number.
macro_rules! of_open {
    ($($name:ident($($of:ident: $kind:ty),*), $writes:literal;)*) => {$(
        #[unsafe(no_mangle)]
        pub extern "C" fn $name(file: c_int $(, $of: $kind)*) -> c_int {
            match of_file(file, |of| fate(stringify!($name), of, $writes)) {
                Fate::Fails(error) => fails(error),
                _ => unsafe { real::$name(file $(, $of)*) },
            }
        }
    )*};
}

of_open! {
    fsync(), true;
    fdatasync(), true;
    ftruncate64(length: i64), true;
    fchmod(mode: u32), false;
    flock(operation: c_int), false;
}

#[unsafe(no_mangle)]
pub extern "C" fn writev(file: c_int, from: *const c_void, count: c_int) -> isize {
    match of_file(file, |of| fate("writev", of, true)) {
        Fate::Done => unsafe { real::writev(file, from, count) },
        Fate::Short => unsafe { real::writev(file, from, 1) },
        Fate::Fails(error) => fails(error) as isize,
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn lseek64(file: c_int, offset: i64, from: c_int) -> i64 {
    match of_file(file, |of| fate("lseek", of, false)) {
        Fate::Fails(error) => fails(error).into(),
        _ => unsafe { real::lseek64(file, offset, from) },
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn mmap64(at: *mut c_void, n: usize, may: c_int, flags: c_int, file: c_int, from: i64) -> *mut c_void {
    match of_file(file, |of| fate("mmap", of, false)) {
        Fate::Fails(error) if file > 2 => fails(error) as isize as *mut c_void,
        _ => unsafe { real::mmap64(at, n, may, flags, file, from) },
    }
}

/// Calls about a path, which comes last among what is told before it.
macro_rules! of_path {
    ($($name:ident, $shown:literal, ($($of:ident: $kind:ty),*),
       $path:ident, $writes:literal, $back:ty, $bad:expr;)*) => {$(
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($of: $kind),*) -> $back {
            match counted($path).map_or(Fate::Done, |of| fate($shown, of, $writes)) {
                Fate::Fails(error) => {
                    fails(error);
                    $bad
                }
                _ => unsafe { real::$name($($of),*) },
            }
        }
    )*};
}

of_path! {
    rename, "rename", (from: *const c_char, to: *const c_char), to, true, c_int, -1;
    linkat, "link", (a: c_int, from: *const c_char, b: c_int, to: *const c_char, flags: c_int), to, true, c_int, -1;
    unlink, "unlink", (path: *const c_char), path, false, c_int, -1;
    mkdir, "mkdir", (path: *const c_char, mode: u32), path, true, c_int, -1;
    rmdir, "rmdir", (path: *const c_char), path, false, c_int, -1;
    readlink, "readlink", (path: *const c_char, to: *mut c_char, count: usize), path, false, isize, -1;
    realpath, "realpath", (path: *const c_char, to: *mut c_char), path, false, *mut c_char, null_mut();
}

#[unsafe(no_mangle)]
pub extern "C" fn opendir(path: *const c_char) -> *mut c_void {
    match counted(path).map_or(Fate::Done, |of| fate("opendir", of, false)) {
        Fate::Fails(error) => {
            fails(error);
            null_mut()
        }
        _ => unsafe { real::opendir(path) },
    }
}

#[unsafe(no_mangle)]
pub extern "C" fn copy_file_range(a: c_int, x: *mut i64, b: c_int, y: *mut i64, n: usize, flags: u32) -> isize {
    match of_file(b, |of| fate("copy", of, true)) {
        Fate::Fails(error) => fails(error) as isize,
        _ => unsafe { real::copy_file_range(a, x, b, y, n, flags) },
    }
}

/// Whether a block is the one that is not given.
fn is_refused(size: usize) -> bool {
    if size < LARGE {
        return false;
    }
    let this = BLOCKS.fetch_add(1, SeqCst) + 1;
    let refused = number(c"FAULT_BLOCK") == Some(this);
    let mut line = Line::new();
    line.text(b"block ").number(this).text(b" ").number(size).text(if refused { b" FAULT\n" } else { b"\n" });
    log(&line.bytes[..line.end]);
    if refused {
        fails(ENOMEM);
    }
    refused
}

#[unsafe(no_mangle)]
pub extern "C" fn malloc(size: usize) -> *mut c_void {
    if is_refused(size) { null_mut() } else { unsafe { __libc_malloc(size) } }
}

#[unsafe(no_mangle)]
pub extern "C" fn calloc(count: usize, size: usize) -> *mut c_void {
    if is_refused(count.saturating_mul(size)) { null_mut() } else { unsafe { __libc_calloc(count, size) } }
}

#[unsafe(no_mangle)]
pub extern "C" fn realloc(block: *mut c_void, size: usize) -> *mut c_void {
    if is_refused(size) { null_mut() } else { unsafe { __libc_realloc(block, size) } }
}

#[unsafe(no_mangle)]
pub extern "C" fn posix_memalign(to: *mut *mut c_void, align: usize, size: usize) -> c_int {
    let block = if is_refused(size) { null_mut() } else { unsafe { __libc_memalign(align, size) } };
    if block.is_null() {
        return ENOMEM;
    }
    // SAFETY: the caller gives a place for it.
    unsafe { *to = block };
    0
}

#[unsafe(no_mangle)]
pub extern "C" fn aligned_alloc(align: usize, size: usize) -> *mut c_void {
    if is_refused(size) { null_mut() } else { unsafe { __libc_memalign(align, size) } }
}

#[unsafe(no_mangle)]
pub extern "C" fn statx(folder: c_int, path: *const c_char, flags: c_int, mask: u32, to: *mut c_void) -> c_int {
    let is_open = !path.is_null() && unsafe { *path } == 0;
    let fate = match counted(path) {
        Some(of) => fate("stat", of, false),
        None if is_open => of_file(folder, |of| fate("fstat", of, false)),
        None => Fate::Done,
    };
    match fate {
        Fate::Fails(error) => fails(error),
        _ => unsafe { real::statx(folder, path, flags, mask, to) },
    }
}
