//! Memory stays in proportion to the file: at its peak within ten times the file and 64 MB, whatever the file holds.
//!
//! One test alone in its process, because the count is that of the whole process.

use scene_format::{Syntax, load_bytes};
use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Counts the bytes in use and their peak.
struct Counting;

static IN_USE: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

fn count_more(bytes: usize) {
    PEAK.fetch_max(IN_USE.fetch_add(bytes, Relaxed) + bytes, Relaxed);
}

// SAFETY: every call goes to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count_more(layout.size());
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        count_more(layout.size());
        // SAFETY: the caller keeps the contract of `alloc_zeroed`.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        IN_USE.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count_more(size);
        IN_USE.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Bytes of each file that is wrong, and of each that is right.
const WRONG: usize = 4 << 20;
const RIGHT: usize = 2 << 20;

/// The shortest pieces that give the largest trees; `#` becomes a name that no other piece has.
const HOSTILE: [(Syntax, &str, &str, &str); 37] = [
    (Syntax::Ron, "Scene(objects: [", "1,", "])"),
    (Syntax::Ron, "Scene(objects: [", "[],", "])"),
    (Syntax::Ron, "Scene(objects: [", "(),", "])"),
    (Syntax::Ron, "Scene(objects: [", "[1],", "])"),
    (Syntax::Ron, "Scene(objects: [", "a,", "])"),
    // A bracket that is never closed: the file is read again by its indentation.
    (Syntax::Ron, "Scene(objects: [[", "1,", "]"),
    (Syntax::Ron, "Scene(objects: [", "(a:1),", "])"),
    (Syntax::Ron, "Scene(objects: [", "(a:1),", ""),
    (Syntax::Ron, "Scene(", "a:1,", ")"),
    (Syntax::Ron, "Scene(", "a#:1,", ")"),
    (Syntax::Ron, "Scene(materials: {", "\"a\":1,", "})"),
    (Syntax::Ron, "Scene(materials: {", "\"#\":1,", "})"),
    (Syntax::Ron, "", "//\n", "Scene()"),
    (Syntax::Toml, "objects = [", "1,", "]"),
    (Syntax::Toml, "objects = [", "[],", "]"),
    (Syntax::Toml, "objects = [", "{},", "]"),
    (Syntax::Toml, "objects = [", "{a=1},", "]"),
    (Syntax::Toml, "objects = [", "{a.a=1},", "]"),
    (Syntax::Toml, "objects = [", "{a.b.c.d.e.f=1},", "]"),
    (Syntax::Toml, "objects = {", "a.b=1,", "}"),
    (Syntax::Toml, "objects = {", "#.b=1,", "}"),
    (Syntax::Toml, "objects = {", "#=1,", "}"),
    (Syntax::Toml, "", "a=1\n", ""),
    (Syntax::Toml, "", "#=1\n", ""),
    (Syntax::Toml, "", "#.a=1\n", ""),
    (Syntax::Toml, "", "#.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=1\n", ""),
    (Syntax::Toml, "", "[[a]]\n", ""),
    (Syntax::Toml, "", "[[a]]\nb=1\n", ""),
    (Syntax::Toml, "", "[[a]]\n[a.b]\n", ""),
    (Syntax::Toml, "", "[[a]]\n[[a.b]]\n[[c]]\n", ""),
    (Syntax::Toml, "", "[#]\n", ""),
    (Syntax::Toml, "", "[[#]]\n", ""),
    (Syntax::Toml, "", "[#.a]\n", ""),
    (Syntax::Toml, "", "[a.#]\n[b.#]\n", ""),
    (Syntax::Toml, "", "[#.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a]\n", ""),
    (Syntax::Toml, "", "[a]\n", ""),
    (Syntax::Toml, "", "#\n", ""),
];

/// The shortest pieces of right scenes that give the most.
const DENSE: [(Syntax, &str, &str, &str); 9] = [
    (Syntax::Ron, "Scene(objects: [", "Sphere(center:(0,0,0),radius:1),", "])"),
    (Syntax::Ron, "Scene(objects: [", "Mesh(file:\"a\"),", "])"),
    (Syntax::Ron, "Scene(objects: [Mesh(file: \"a\", transform: [", "Scale(1),", "])])"),
    (Syntax::Ron, "Scene(objects: [Mesh(file: \"a\", placements: [", "[],", "])])"),
    (Syntax::Ron, "Scene(objects: [Mesh(file: \"a\", placements: [", "[DropTo(1)],", "])])"),
    (
        Syntax::Ron,
        "Scene(objects: [Sphere(center:(0,0,0),radius:1)],lights: [",
        "SphereLight(center:(0,0,0),radius:1,power:1),",
        "])",
    ),
    (Syntax::Ron, "Scene(objects: [Sphere(center:(0,0,0),radius:1)],materials: {", "\"#\":Mirror(),", "})"),
    (Syntax::Toml, "", "[[objects]]\nSphere={center=[0,0,0],radius=1}\n", ""),
    (Syntax::Toml, "", "[[objects]]\nMesh.file=\"a\"\n", ""),
];

fn name(mut index: usize) -> String {
    let mut out = String::new();
    loop {
        out.push(char::from(b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"[index % 52]));
        index /= 52;
        if index == 0 {
            return out;
        }
    }
}

fn file(size: usize, head: &str, piece: &str, tail: &str) -> Vec<u8> {
    let mut out = String::with_capacity(size + 200);
    out.push_str(head);
    let named = piece != "#\n";
    for index in 0.. {
        let name = name(index);
        out.push_str(&if named { piece.replace('#', &name) } else { piece.to_owned() });
        if out.len() + tail.len() >= size {
            break;
        }
    }
    (out + tail).into_bytes()
}

/// The peak while a file is read, its own bytes included; whether it is right.
fn read(syntax: Syntax, bytes: Vec<u8>) -> (usize, bool) {
    let before = IN_USE.load(Relaxed) - bytes.capacity();
    PEAK.store(before, Relaxed);
    let right = load_bytes("dense", bytes, Some(syntax), Path::new(""), &[]).is_ok();
    (PEAK.load(Relaxed) - before, right)
}

#[test]
fn memory_is_in_proportion_to_the_file() {
    for (syntax, head, piece, tail) in HOSTILE {
        let bytes = file(WRONG, head, piece, tail);
        let length = bytes.len();
        let (peak, right) = read(syntax, bytes);
        println!("{head}{piece:?}{tail}: {:.1} times", peak as f64 / length as f64);
        assert!(!right, "{head}{piece}{tail} is a scene");
        // A thousand diagnostics, the room of tables that are always allowed, and chunks that are not full: 16 MB of the 64.
        assert!(peak <= 10 * length + (16 << 20), "{head}{piece:?}{tail}: {peak} bytes for {length}");
    }
    for (syntax, head, piece, tail) in DENSE {
        let bytes = file(RIGHT, head, piece, tail);
        let length = bytes.len();
        let (peak, right) = read(syntax, bytes);
        println!("{head}{piece:?}{tail}: {:.1} times", peak as f64 / length as f64);
        assert!(right, "{head}{piece}{tail} is no scene");
        assert!(peak <= 10 * length + (64 << 20), "{head}{piece:?}{tail}: {peak} bytes for {length}");
    }
}
