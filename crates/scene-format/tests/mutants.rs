//! Mutated scene files: whatever the bytes, the answer is a scene or its faults, soon, and without a panic.
//!
//! The run here is bounded; `SCENE_MUTANTS=100000 cargo test --release -p scene-format --test mutants` takes more.

mod common;

use common::threads::for_all;
use common::{FULL, Random};
use scene_format::render::{Style, json_lines, text};
use scene_format::{Defaults, LoadError, Override, Syntax, convert, load_bytes, to_text};
use std::path::Path;
use std::time::{Duration, Instant};

/// Pieces that parsers trip over.
const PIECES: [&str; 40] = [
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "=",
    "\"",
    "'",
    "\\",
    "#",
    "//",
    "/*",
    "*/",
    "\n",
    "\r\n",
    "\t",
    "\u{feff}",
    "é",
    "🐈",
    "0",
    "-",
    "1e999",
    "NaN",
    "inf",
    "0x",
    "r#\"",
    "\"\"\"",
    "'''",
    "Some(",
    "None",
    "Scene(",
    "[[",
    "]]",
    ".",
    "_",
    "\0",
    "[[objects]]\n",
];

fn mutate(text: &str, random: &mut Random) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..1 + random.below(4) {
        let at = random.below(bytes.len() + 1);
        let end = (at + random.below(40)).min(bytes.len());
        match random.below(8) {
            0 => drop(bytes.drain(at..end)),
            1 => {
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len() + 1);
                bytes.splice(to..to, piece);
            }
            2 => bytes.truncate(at),
            3 if at < bytes.len() => bytes[at] = random.next() as u8,
            4 => {
                let piece = random.pick(&PIECES).repeat(1 + random.below(300));
                bytes.splice(at..at, piece.into_bytes());
            }
            _ => {
                let piece = random.pick(&PIECES).as_bytes().to_vec();
                bytes.splice(at..at, piece);
            }
        }
    }
    bytes
}

/// Reads a text and does with it all that a program would.
fn exercise(bytes: Vec<u8>, syntax: Syntax, overrides: &[Override]) -> bool {
    match load_bytes("mutant", bytes.clone(), Some(syntax), Path::new(""), overrides) {
        Ok(loaded) => {
            let written = to_text(&loaded.scene, syntax, Defaults::Shown);
            assert!(load_bytes("written", written.into_bytes(), Some(syntax), Path::new(""), &[]).is_ok());
            if overrides.is_empty() {
                let source = String::from_utf8(bytes).expect("what loads is UTF-8");
                for other in Syntax::ALL.into_iter().filter(|other| *other != syntax) {
                    let converted = convert("mutant", &source, syntax, other).expect("what loads can be converted");
                    assert!(
                        load_bytes("c", converted.clone().into_bytes(), Some(other), Path::new(""), &[]).is_ok(),
                        "{converted}"
                    );
                }
            }
            true
        }
        Err(LoadError::Invalid { diagnostics, sources, .. }) => {
            assert!(!diagnostics.is_empty());
            for fault in &diagnostics {
                let source = &sources[fault.span.source as usize];
                assert!(fault.span.start <= fault.span.end, "{fault:?}");
                assert!(fault.span.start as usize <= source.text.len() + 3, "{fault:?}");
            }
            let shown: Vec<_> = diagnostics.into_iter().take(20).collect();
            assert!(!text(&shown, &sources, Style { color: true, width: 60 }).is_empty());
            assert_eq!(json_lines(&shown, &sources).lines().count(), shown.len());
            false
        }
        Err(error) => panic!("a text cannot be unreadable: {error}"),
    }
}

/// Time that this thread has had the processor (Linux tells it); elsewhere the time of day.
fn clock(started: Instant) -> Duration {
    let of_thread = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = of_thread.and_then(|text| text.split(' ').next()?.parse().ok());
    nanoseconds.map_or_else(|| started.elapsed(), Duration::from_nanos)
}

/// How long something takes; when it takes long, it is tried again, for the machine may be busy with other things.
fn soonest(mut run: impl FnMut()) -> Duration {
    let mut best = Duration::MAX;
    let started = Instant::now();
    for _ in 0..3 {
        let start = clock(started);
        run();
        best = best.min(clock(started) - start);
        if best < Duration::from_millis(500) {
            break;
        }
    }
    best
}

#[test]
fn mutants_neither_panic_nor_hang() {
    let count = std::env::var("SCENE_MUTANTS").ok().and_then(|count| count.parse().ok()).unwrap_or(2000);
    let mut random = Random(5);
    let (mut right, mut slowest) = (0, (Duration::ZERO, 0));
    // In pieces: a hundred thousand of them are some hundred megabytes.
    for first in (0..count).step_by(1000) {
        let made = (first..count.min(first + 1000)).map(|index| {
            let (source, syntax) = FULL[index % FULL.len()];
            (index, syntax, mutate(source, &mut random))
        });
        let tried = for_all(&made.collect::<Vec<_>>(), |(index, syntax, mutant)| {
            let mut is_right = false;
            let took = soonest(|| is_right = exercise(mutant.clone(), *syntax, &[]));
            (is_right, (took, *index))
        });
        right += tried.iter().filter(|(is_right, _)| *is_right).count();
        slowest = tried.iter().map(|(_, took)| *took).fold(slowest, Ord::max);
    }
    // Most mutants are wrong, but a test that never gets beyond the syntax would prove little.
    assert!(right > count / 100, "{right} of {count} are right");
    let (took, index) = slowest;
    assert!(took < Duration::from_secs(1), "mutant {index} took {took:?}");
}

#[test]
fn mutated_set_arguments_neither_panic_nor_hang() {
    const ARGUMENTS: [&str; 8] = [
        "camera.fov=40",
        "materials.glass=Transparent(ior: 1.6)",
        "objects[2].radius=3",
        "objects[4].transform[0].factor=(1, 2, 3)",
        "effects.antialiasing.Gaussian.sigma=1",
        "materials[\"fur\"].albedo.file=\"x.png\"",
        "render.seed=3",
        "lights[0].SphereLight.center=[1, 2, 3]",
    ];
    let mut random = Random(6);
    let made = (0..3000).map(|index| {
        let argument: &str = ARGUMENTS[random.below(ARGUMENTS.len())];
        (FULL[index % FULL.len()], String::from_utf8_lossy(&mutate(argument, &mut random)).into_owned())
    });
    for_all(&made.collect::<Vec<_>>(), |((source, syntax), argument)| {
        let overrides = [Override::from(argument.clone()), Override::from("camera.fov=50")];
        exercise(source.as_bytes().to_vec(), *syntax, &overrides)
    });
}

/// Files made to take quadratic time, or to fill the stack or the memory, of a reader that is not careful.
#[test]
fn hostile_files_take_no_longer_than_others() {
    // The tests run unoptimised, five times slower than the program.
    const SIZE: usize = if cfg!(debug_assertions) { 100_000 } else { 400_000 };
    let pieces = [
        "(", "[", "{", ")", "]", "}", ",", "\"", "'", "#", "/*", "//\n", "a", "a,", "a ", "a:", "a=", "a.", "1,", "-",
        "[1],", "(a:", "[[a]]\n", "[a.b]\n", "a=1\n", "{a=", "a.b.", "\\", "\n", "\r", "é", "\"\"\"", "r#", "(]", "[)",
        "\"a\":1,", "Sphere(", "x: 1, ", "[a]\n", "\"a\": {", "{\"a\":[", "\\u0", "\u{a0}",
    ];
    let heads = [
        (Syntax::Ron, ""),
        (Syntax::Ron, "Scene(objects: ["),
        (Syntax::Ron, "Scene(materials: {"),
        (Syntax::Ron, "Scene(objects: [Sphere("),
        (Syntax::Toml, ""),
        (Syntax::Toml, "objects = ["),
        (Syntax::Toml, "materials = {"),
        (Syntax::Toml, "[camera]\n"),
        (Syntax::Json, ""),
        (Syntax::Json, "{\"objects\": ["),
        (Syntax::Json, "{\"materials\": {"),
        (Syntax::Json, "{\"a\": "),
    ];
    let all = heads.iter().flat_map(|head| pieces.map(|piece| (*head, piece)));
    for_all(&all.collect::<Vec<_>>(), |&((syntax, head), piece)| {
        let text = format!("{head}{}", piece.repeat(SIZE / piece.len()));
        let took = soonest(|| {
            let loaded = load_bytes("hostile", text.clone().into_bytes(), Some(syntax), Path::new(""), &[]);
            assert!(loaded.is_err(), "{head}{piece:?}");
        });
        assert!(took < Duration::from_secs(1), "{head}{piece:?}.. took {took:?}");
    });
    // Many different names, many wrong uses of them.
    let names: String = (0..20_000).map(|index| format!("\"m{index}\": Mirror(), ")).collect();
    let uses: String =
        (0..20_000).map(|index| format!("Sphere(center: (0, 0, 0), radius: 1, material: \"n{index}\"), ")).collect();
    let text = format!("Scene(materials: {{ {names} }}, objects: [{uses}])");
    let took = soonest(|| {
        assert!(load_bytes("names", text.clone().into_bytes(), Some(Syntax::Ron), Path::new(""), &[]).is_err());
    });
    assert!(took < Duration::from_secs(1), "took {took:?}");
}
