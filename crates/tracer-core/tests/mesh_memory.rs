//! Memory stays in proportion to the file: at its peak within ten times the file and 64 MB, whatever the file promises.
//!
//! One test alone in its process, because the count is that of the whole process.

use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use tracer_core::mesh::{MeshFormat, parse};
use tracer_core::texture;

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

/// Runs, and gives the peak above what was in use before.
fn peak_of(run: impl FnOnce()) -> usize {
    let before = IN_USE.load(Relaxed);
    PEAK.store(before, Relaxed);
    run();
    PEAK.load(Relaxed) - before
}

#[test]
fn memory_is_in_proportion_to_the_file() {
    // The shortest statements that give the most data, 8 MB of each.
    let repeated = |head: &str, line: &str| head.to_owned() + &line.repeat((8 << 20) / line.len());
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
    // On a parabola, so that they are the corners of a convex polygon.
    let nine: String = (0..9).map(|i| format!("v {i} {} 0\n", i * i)).collect();
    let files = [
        ("a header of 10^12 vertices", MeshFormat::Off, "OFF\n1000000000000 1 0\n0 0 0\n".to_owned()),
        ("a header of 10^12 faces", MeshFormat::Off, "OFF\n1 1000000000000 0\n0 0 0\n3 0 0 0\n".to_owned()),
        ("a face of 10^12 corners", MeshFormat::Off, "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n1000000000000 0 1 2\n".to_owned()),
        ("OBJ vertices", MeshFormat::Obj, repeated(square, "v 0 0 0\n") + "f 1 2 3\n"),
        ("OBJ texture coordinates", MeshFormat::Obj, repeated(square, "vt 0\n") + "f 1/1 2/1 3/1\n"),
        ("OBJ normals", MeshFormat::Obj, repeated(square, "vn 0 0 1\n") + "f 1//1 2//1 3//1\n"),
        ("OBJ triangles", MeshFormat::Obj, repeated(square, "f 1 2 3\n")),
        ("OBJ triangles with all", MeshFormat::Obj, repeated(square, "f 1/1/1 2/1/1 3/1/1\n")),
        (
            "OBJ triangles with holes in attributes",
            MeshFormat::Obj,
            repeated(square, "f 1 2 3\n") + "f 1/1/1 2/1/1 3/1/1\n",
        ),
        ("OBJ triangles counted back", MeshFormat::Obj, repeated(square, "f -1 -2 -3\n")),
        ("OBJ polygons", MeshFormat::Obj, repeated(&nine, "f 1 2 3 4 5 6 7 8 9\n")),
        ("OBJ groups", MeshFormat::Obj, repeated(square, "usemtl a\n") + "f 1 2 3\n"),
        ("OBJ oddities", MeshFormat::Obj, repeated(square, "x\ny\n") + "f 1 2 3\n"),
    ];
    for (what, format, text) in files {
        let peak = peak_of(|| {
            let _ = parse(text.as_bytes(), format, Path::new("none/m"));
        });
        println!("{what}: {:.1} times {} bytes", peak as f64 / text.len() as f64, text.len());
        // The text itself is the tenth.
        assert!(peak <= 9 * text.len() + (1 << 20), "{what}: {peak} bytes for {}", text.len());
    }

    // A JPEG of a few hundred bytes that claims more pixels than it has.
    let mut jpeg = Vec::new();
    let encoder = image::codecs::jpeg::JpegEncoder::new(&mut jpeg);
    image::ImageEncoder::write_image(encoder, &[0; 192], 8, 8, image::ExtendedColorType::Rgb8).expect("encoded");
    let frame = jpeg.windows(2).position(|pair| pair == [0xff, 0xc0]).expect("a frame header");
    for side in [100_u16, 4000, 30000] {
        jpeg[frame + 5..frame + 7].copy_from_slice(&side.to_be_bytes());
        jpeg[frame + 7..frame + 9].copy_from_slice(&side.to_be_bytes());
        let peak = peak_of(|| assert!(texture::decode(&jpeg, Path::new("p.jpg")).is_err()));
        assert!(peak <= 9 * jpeg.len() + (1 << 20), "{peak} bytes for {side} x {side}");
    }
}
