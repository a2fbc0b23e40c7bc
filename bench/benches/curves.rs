//! How time grows with the size of a scene: `cargo bench --bench curves`, in this folder. One group per size; the
//! report with its pictures is in `target/criterion`. Times of one run on a quiet machine are compared with each other,
//! not with other runs.
//!
//! `BENCH_LARGE=1` adds meshes of ten million triangles, which take some gigabytes.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use tracer_core::Scene;
use xtask::instructions::scenes::{balls, copies, hills, lamps, rendered};

const SIZE: u32 = 256;

/// One point of a curve: the whole rendering, in camera samples.
fn point(c: &mut Criterion, curve: &str, x: impl std::fmt::Display, scene: &Scene, threads: usize) {
    let mut group = c.benchmark_group(curve);
    group.sample_size(10).warm_up_time(Duration::from_millis(300)).measurement_time(Duration::from_secs(2));
    let [width, height] = scene.size;
    group.throughput(Throughput::Elements(u64::from(width) * u64::from(height) * u64::from(scene.samples)));
    group.bench_with_input(BenchmarkId::from_parameter(x), scene, |b, scene| b.iter(|| rendered(scene, threads)));
    group.finish();
}

fn curves(c: &mut Criterion) {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let scene = balls(SIZE, 16);
    let mut threads = 1;
    while threads <= cores {
        point(c, "threads", threads, &scene, threads);
        threads *= 2;
    }
    for size in [64, 128, 256, 512, 1024, 2048] {
        point(c, "resolution", size, &balls(size, 4), cores);
    }
    for samples in [1, 4, 16, 64, 256] {
        point(c, "samples", samples, &balls(SIZE, samples), cores);
    }
    let most = if std::env::var_os("BENCH_LARGE").is_some() { 7 } else { 6 };
    for triangles in (3..=most).map(|k| 10usize.pow(k)) {
        point(c, "triangles", triangles, &hills(triangles, SIZE, 4), cores);
    }
    for count in [1, 10, 100, 1_000, 10_000, 100_000] {
        point(c, "copies", count, &copies(count, SIZE, 4), cores);
    }
    for count in [1, 10, 100, 1_000, 10_000] {
        point(c, "lamps", count, &lamps(count, SIZE, 4), cores);
    }
}

criterion_group!(benches, curves);
criterion_main!(benches);
