//! Memory stays in proportion to the file: at its peak within ten times the file and 64 MB, whatever the file holds.
//!
//! Each thread counts for itself: a file is read by one.

#[path = "common/threads.rs"]
mod threads;

use scene_format::Syntax::{self, Json, Ron, Toml};
use scene_format::desc::{Object, Sphere};
use scene_format::diagnostic::Spanned;
use scene_format::load_bytes;
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::path::Path;
use std::time::Instant;
use threads::for_all;

/// Counts the bytes in use and their peak.
struct Counting;

/// What a piece of memory takes from the system, as the allocator of glibc hands it out: 8 bytes for its length, in
/// steps of 16, at least 32.
fn taken(bytes: usize) -> usize {
    (bytes + 8).next_multiple_of(16).max(32)
}

thread_local! {
    /// What this thread has taken, less what it gave back; below zero where another one had taken it.
    static IN_USE: Cell<isize> = const { Cell::new(0) };
    static PEAK: Cell<isize> = const { Cell::new(0) };
}

/// From this many bytes on glibc takes a piece from the system by itself, and moves it without a copy.
const MOVED: usize = 128 << 10;

fn count_more(bytes: usize) {
    IN_USE.set(IN_USE.get() + taken(bytes) as isize);
    PEAK.set(PEAK.get().max(IN_USE.get()));
}

fn count_less(bytes: usize) {
    IN_USE.set(IN_USE.get() - taken(bytes) as isize);
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
        count_less(layout.size());
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // What is small is copied; large pieces grow in place, the system putting their pages elsewhere.
        if layout.size() < MOVED {
            count_more(size);
            count_less(layout.size());
        } else {
            count_less(layout.size());
            count_more(size);
        }
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Bytes of each file; `SCENE_MEMORY=64` makes each 64 MB long.
const SIZE: usize = 2 << 20;
/// What a file may take beyond ten times its bytes is 64 MB. A file of `SIZE` has no reason to need more than a fifth
/// of them, for a thousand diagnostics, chunks that are not full and small tables.
const BEYOND: usize = 12 << 20;

/// The shortest pieces that give the largest trees; `#` becomes a name that no other piece has.
const WRONG: [(Syntax, &str, &str, &str); 57] = [
    (Ron, "Scene(objects: [", "1,", "])"),
    (Ron, "Scene(objects: [", "[],", "])"),
    (Ron, "Scene(objects: [", "(),", "])"),
    (Ron, "Scene(objects: [", "[1],", "])"),
    (Ron, "Scene(objects: [", "a,", "])"),
    // A bracket that is never closed: the file is read again by its indentation.
    (Ron, "Scene(objects: [[", "1,", "]"),
    (Ron, "Scene(objects: [", "(a:1),", "])"),
    (Ron, "Scene(objects: [", "(a:1),", ""),
    (Ron, "Scene(", "a:1,", ")"),
    (Ron, "Scene(", "a#:1,", ")"),
    (Ron, "Scene(materials: {", "\"a\":1,", "})"),
    (Ron, "Scene(materials: {", "\"#\":1,", "})"),
    (Ron, "Scene(materials: {", "\"a\":Mirror(),", "})"),
    (Json, "{\"objects\": [", "1,", "1]}"),
    (Json, "{\"objects\": [", "[],", "1]}"),
    (Json, "{\"objects\": [", "{\"a\":1},", "1]}"),
    (Json, "{\"objects\": [", "a,", "1]}"),
    (Json, "{\"materials\": {", "\"#\":1,", "\"a\":1}}"),
    (Json, "{", "a:1,", "\"a\":1}"),
    (Json, "", "//\n", "{}"),
    (Json, "", "[", ""),
    (Json, "{\"objects\": [", "\"", "]}"),
    (Ron, "", "//\n", "Scene()"),
    (Ron, "", "[", ""),
    (Ron, "", "(", ""),
    (Ron, "Scene(objects: ", "[", "])"),
    (Ron, "Scene(objects: [\"", "a", ""),
    (Ron, "Scene(objects: [", "\"", "])"),
    (Ron, "Scene(objects: [", ",", "])"),
    // Two mistakes in a scene that is right otherwise.
    (Ron, "Scene(version: a, camera: 1, objects: [", "Mesh(file:\"a\"),", "])"),
    (Toml, "objects = [", "1,", "]"),
    (Toml, "objects = [", "[],", "]"),
    (Toml, "objects = [", "{},", "]"),
    (Toml, "objects = [", "{a=1},", "]"),
    (Toml, "objects = [", "{a.a=1},", "]"),
    (Toml, "objects = [", "{a.b.c.d.e.f=1},", "]"),
    (Toml, "objects = {", "a.b=1,", "}"),
    (Toml, "objects = {", "#.b=1,", "}"),
    (Toml, "objects = {", "#=1,", "}"),
    (Toml, "", "a=1\n", ""),
    (Toml, "", "#=1\n", ""),
    (Toml, "", "#.a=1\n", ""),
    (Toml, "", "#.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a=1\n", ""),
    (Toml, "", "[[a]]\n", ""),
    (Toml, "", "[[a]]\nb=1\n", ""),
    (Toml, "", "[[a]]\n[a.b]\n", ""),
    (Toml, "", "[[a]]\n[[a.b]]\n[[c]]\n", ""),
    (Toml, "", "[#]\n", ""),
    (Toml, "", "[[#]]\n", ""),
    (Toml, "", "[#.a]\n", ""),
    (Toml, "", "[a.#]\n[b.#]\n", ""),
    (Toml, "", "[#.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a]\n", ""),
    (Toml, "", "[a]\n", ""),
    (Toml, "", "#\n", ""),
    (Toml, "", "[", ""),
    (Toml, "objects = ", "[", "]"),
    (Toml, "version=\"a\"\ncamera=1\nobjects=[", "{Mesh={file=\"a\"}},", "]"),
];

/// The shortest pieces of right scenes that give the most.
const RIGHT: [(Syntax, &str, &str, &str); 38] = [
    (Ron, "Scene(objects: [Mesh(faces: [[0,1,2]], points: [", "(0,0,0),", "])])"),
    (Ron, "Scene(objects: [Mesh(points: [(0,0,0),(1,0,0),(0,1,0)], faces: [", "[0,1,2],", "])])"),
    (Ron, "Scene(objects: [Mesh(points: [(0,0,0),(1,0,0),(0,1,0)], faces: [[0,1,", "2,", "]])])"),
    (Toml, "objects=[{Mesh={faces=[[0,1,2]],points=[", "[0,0,0],", "]}}]"),
    (Toml, "objects=[{Mesh={points=[[0,0,0],[1,0,0],[0,1,0]],faces=[", "[0,1,2],", "]}}]"),
    (Ron, "Scene(objects: [", "Sphere(center:(0,0,0),radius:1),", "])"),
    (Ron, "Scene(objects: [", "Sphere(center:(0,0,0),radius:1,material:Mirror()),", "])"),
    (Ron, "Scene(objects: [", "{\"Sphere\":{\"center\":[0,0,0],\"radius\":1}},", "])"),
    (Ron, "Scene(materials:{\"a\":Mirror()},objects: [", "Mesh(file:\"a\",material:\"a\"),", "])"),
    (Ron, "Scene(objects: [", "Mesh(file:\"a\"),", "])"),
    (Ron, "Scene(objects: [", "Mesh(file:\"#\"),", "])"),
    (Ron, "Scene(objects: [", "Mesh(file:\"a\",transform:[Scale(1)]),", "])"),
    (Ron, "Scene(objects: [", "Mesh(file:\"a\",placements:[[]]),", "])"),
    (Ron, "Scene(objects: [", "Mesh(file:\"a\",placements:\"a\"),", "])"),
    (Ron, "Scene(objects: [", "Mesh(file:\"a\",material:Mirror()),", "])"),
    (Ron, "Scene(objects: [Mesh(file: \"a\", transform: [", "Scale(1),", "])])"),
    (Ron, "Scene(objects: [Mesh(file: \"a\", transform: [", "Scale(factor:1,about:(0,0,0)),", "])])"),
    (Ron, "Scene(objects: [Mesh(file: \"a\", placements: [", "[],", "])])"),
    (Ron, "Scene(objects: [Mesh(file: \"a\", placements: [", "[Scale(1)],", "])])"),
    (Ron, "Scene(objects: [Mesh(file: \"a\", placements: [[", "Scale(1),", "]])])"),
    (Ron, "Scene(objects: [Mesh(file: \"", "a", "\")])"),
    (Ron, "Scene(objects: [Mesh(file: \"a", "\\n", "\")])"),
    (
        Ron,
        "Scene(objects: [Sphere(center:(0,0,0),radius:1)],lights: [",
        "SphereLight(center:(0,0,0),radius:1,power:1),",
        "])",
    ),
    (Ron, "Scene(objects: [Sphere(center:(0,0,0),radius:1)],materials: {", "\"#\":Mirror(),", "})"),
    (
        Ron,
        "Scene(objects: [Sphere(center:(0,0,0),radius:1)],materials: {",
        "\"#\":BlinnPhong(exponent:1,specular:1),",
        "})",
    ),
    (Toml, "", "[[objects]]\nSphere={center=[0,0,0],radius=1}\n", ""),
    (Toml, "", "[[objects]]\nMesh.file=\"a\"\n", ""),
    (Toml, "objects=[", "{Mesh.file=\"a\"},", "]"),
    (Toml, "objects=[", "{Mesh={file=\"a\"}},", "]"),
    (Toml, "objects=[{Mesh={file=\"a\",placements=[", "[{Scale=1}],", "]}}]"),
    (Toml, "lights=[", "{SphereLight={center=[0,0,0],radius=1,power=1}},", "]\nobjects=[{Mesh={file=\"a\"}}]"),
    (Toml, "objects=[{Mesh.file=\"a\"}]\n[materials]\n", "#.Mirror={}\n", ""),
    (Toml, "objects=[{Mesh.file=\"a\"}]\n[materials]\n", "#={Mirror={}}\n", ""),
    (Toml, "objects=[{Mesh.file=\"a\"}]\n", "[materials.#.Mirror]\n", ""),
    (Json, "{\"objects\":[{\"Mesh\":{\"file\":\"a\"}}", ",{\"Mesh\":{\"file\":\"a\"}}", "]}"),
    (
        Json,
        "{\"objects\":[{\"Mesh\":{\"file\":\"a\"}}",
        ",{\"Sphere\":{\"center\":[0,0,0],\"radius\":1,\"material\":{\"Mirror\":{}}}}",
        "]}",
    ),
    (Json, "{\"objects\":[{\"Mesh\":{\"file\":\"a\",\"placements\":[[]", ",[{\"Scale\":1}]", "]}}]}"),
    (
        Json,
        "{\"objects\":[{\"Mesh\":{\"file\":\"a\"}}],\"materials\":{\"a b\":{\"Mirror\":{}}",
        ",\"#\":{\"Mirror\":{}}",
        "}}",
    ),
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
    let before = IN_USE.get() - taken(bytes.capacity()) as isize;
    PEAK.set(before);
    let right = load_bytes("dense", bytes, Some(syntax), Path::new(""), &[]).is_ok();
    ((PEAK.get() - before) as usize, right)
}

/// What a repetition makes: a million spheres take the memory of a million spheres, whatever their expressions are.
/// Each is one piece of a `Sphere` and its place in the list, which has room for an eighth more at most, and is moved
/// in place as it grows; what does not grow with their number is less than a megabyte.
fn repeated_objects_take_what_they_are() {
    let scene = |count: usize| {
        let sphere =
            r#"Sphere(center: ("=i%100", "=floor(i/100)", "=(i + 1)*2"), radius: "=0.2 + i/1e9", material: "a")"#;
        let head = r#"Scene(background: 1, materials: { "a": Mirror() }, objects: "#;
        format!("{head}[Repeat(count: {count}, items: [{sphere}])])").into_bytes()
    };
    let count = 100_000;
    let (peak, right) = read(Ron, scene(count));
    let each = taken(size_of::<Sphere>()) + size_of::<Spanned<Object>>() * 9 / 8;
    assert!(right && peak <= count * each + (1 << 20), "{} bytes each instead of {each}", peak / count);
}

#[test]
fn memory_is_in_proportion_to_the_file() {
    repeated_objects_take_what_they_are();
    let megabytes =
        std::env::var("SCENE_MEMORY").ok().map(|text| text.parse::<usize>().expect("a number of megabytes"));
    let size = megabytes.map_or(SIZE, |megabytes| megabytes << 20);
    let beyond = if megabytes.is_some() { 64 << 20 } else { BEYOND };
    let wrong = WRONG.iter().map(|case| (*case, false));
    let cases: Vec<_> = wrong.chain(RIGHT.iter().map(|case| (*case, true))).collect();
    let too_much = for_all(&cases, |&((syntax, head, piece, tail), should_be_right)| {
        let bytes = file(size, head, piece, tail);
        let length = bytes.len();
        let start = Instant::now();
        let (peak, right) = read(syntax, bytes);
        let (times, speed) = (peak as f64 / length as f64, length as f64 / 1e6 / start.elapsed().as_secs_f64());
        let line = format!("{} {head}{piece:?}{tail}: {times:.1} times, {speed:.0} MB/s", syntax.name());
        println!("{line}");
        assert_eq!(right, should_be_right, "{line}");
        (peak > 10 * length + beyond).then_some(line)
    });
    let too_much: Vec<String> = too_much.into_iter().flatten().collect();
    assert!(too_much.is_empty(), "more than ten times the file and {beyond} bytes:\n{}", too_much.join("\n"));
}
