//! A day of a cluster in minutes: renderings are killed at random, ended by signals, gone on with, divided, merged,
//! their checkpoints cut and deleted; the picture is always the one of a single quiet run, byte for byte.
//!
//! `cargo xtask prove soak` runs it for twenty minutes, or as long as `TRACER_SOAK` says, in seconds;
//! `TRACER_SOAK_SEED` repeats what was drawn.
#![cfg(unix)]

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const TRACER: &str = env!("CARGO_BIN_EXE_tracer");
const SCENE: &str = r#"Scene(
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 40, height: 40),
    render: Render(max_bounces: 4),
    background: (0.2, 0.3, 0.4),
    lights: [SphereLight(center: (2, 5, 3), radius: 1, radiance: 20)],
    objects: [
        Sphere(center: (0, -100, 0), radius: 100),
        Sphere(center: (-1, 1, 0), radius: 1, material: Transparent(ior: 1.5)),
        Sphere(center: (1, 1, 0), radius: 1, material: Mirror(reflectance: 0.9)),
    ],
)
"#;
/// Kinds of films: light paths over mirror and glass, clamped samples, a lens, layers, no light paths.
const KINDS: [&[&str]; 5] = [
    &[],
    &["--set", "render.clamp=0.5"],
    &["--set", "effects.depth_of_field=ThinLens(aperture: 0.4, focus_distance: 6)"],
    &["--set", "output.layers=[Depth, Normal]", "--set", "output.alpha=true"],
    &["--set", "render.integrator=Path"],
];

fn number(name: &str) -> Option<u64> {
    std::env::var(name).ok().map(|value| value.parse().unwrap_or_else(|_| panic!("{name}={value} is no number")))
}

#[test]
fn whatever_happens_the_same_bytes() {
    let time = Duration::from_secs(number("TRACER_SOAK").unwrap_or(20 * 60));
    let seed = number("TRACER_SOAK_SEED").unwrap_or_else(|| u64::from(std::process::id()));
    println!("seed {seed}, {} s", time.as_secs());
    let (start, mut told) = (Instant::now(), Instant::now());
    let mut soak = Soak::new(seed);
    while start.elapsed() < time {
        soak.round();
        if told.elapsed() > Duration::from_secs(30) {
            told = Instant::now();
            println!("{:5.0} s: {}", start.elapsed().as_secs_f64(), soak.told());
        }
    }
    println!("{}", soak.told());
    assert!(soak.ended[0] > 0 && soak.ended[1] > 0, "nothing was ever ended");
}

struct Random(u64);

impl Random {
    fn below(&mut self, most: usize) -> usize {
        self.0 = self.0.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        (self.0 >> 33) as usize % most.max(1)
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }
}

/// A picture, and how long a quiet run took.
type Quiet = (Vec<u8>, Duration);

struct Soak {
    random: Random,
    folder: tempfile::TempDir,
    quiet: HashMap<Vec<String>, Quiet>,
    rounds: u32,
    parts: u32,
    /// By `kill -9`, and by signals that are heeded.
    ended: [u32; 2],
    /// Checkpoints that were damaged or deleted.
    damaged: u32,
}

fn words(words: &[&str]) -> Vec<String> {
    words.iter().map(|&word| word.to_owned()).collect()
}

impl Soak {
    fn new(seed: u64) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("scene.ron"), SCENE).expect("a file");
        let (random, quiet) = (Random(seed), HashMap::new());
        Soak { random, folder, quiet, rounds: 0, parts: 0, ended: [0; 2], damaged: 0 }
    }

    fn told(&self) -> String {
        let Soak { rounds, parts, ended: [killed, signalled], damaged, .. } = self;
        format!(
            "{rounds} pictures of {parts} parts, {killed} times killed, {signalled} times ended by a signal, \
             {damaged} checkpoints damaged or deleted: the same bytes"
        )
    }

    /// A folder of its own below, empty.
    fn place(&self, name: &str) -> PathBuf {
        let place = self.folder.path().join(name);
        let _ = fs::remove_dir_all(&place);
        fs::create_dir(&place).expect("a folder");
        place
    }

    fn command(&mut self, place: &Path, arguments: &[String]) -> Command {
        let mut command = Command::new(TRACER);
        command.args(arguments).current_dir(place).env_remove("TRACER_LANES").stdin(Stdio::null());
        // Another machine.
        if self.random.below(3) == 0 {
            command.env("TRACER_LANES", "1");
        }
        command.stdout(Stdio::null()).stderr(fs::File::create(self.folder.path().join("said")).expect("a file"));
        command
    }

    fn said(&self) -> String {
        fs::read_to_string(self.folder.path().join("said")).unwrap_or_default()
    }

    /// What is rendered, and the picture of it.
    fn quiet(&mut self) -> (Vec<String>, u32, Quiet) {
        let samples = self.random.of(&[8, 33, 100, 400]);
        let count = samples.to_string();
        let mut options = words(&["../scene.ron", "-q", "--samples", &count]);
        options.extend(words(self.random.of(&KINDS)));
        if !self.quiet.contains_key(&options) {
            let place = self.place("quiet");
            let line = [words(&["render"]), options.clone(), words(&["-o", "a.exr"])].concat();
            let start = Instant::now();
            let status = self.command(&place, &line).status().expect("the program starts");
            assert!(status.success(), "{line:?}: {}", self.said());
            let bytes = fs::read(place.join("a.exr")).expect("a picture");
            self.quiet.insert(options.clone(), (bytes, start.elapsed()));
        }
        let quiet = self.quiet[&options].clone();
        (options, samples, quiet)
    }

    fn round(&mut self) {
        let (options, samples, (bytes, time)) = self.quiet();
        let place = self.place("work");
        self.rounds += 1;
        if self.random.below(2) == 0 {
            self.parts += 1;
            let line = [words(&["render"]), options.clone(), words(&["-o", "a.exr", "--resume", "c.film"])].concat();
            self.to_its_end(&place, &line, "c.film", time);
            assert_same(&place, &bytes, &line, &["a.exr", "c.film", "c.film.previous"]);
            return;
        }
        let split = self.random.of(&["samples", "rows"]);
        let most = if split == "samples" { samples as usize } else { 3 };
        let parts = 1 + self.random.below(most.min(6));
        self.parts += parts as u32;
        let mut order: Vec<usize> = (1..=parts).collect();
        self.shuffle(&mut order);
        let names: Vec<String> = order.iter().map(|k| format!("p{k}.tracer")).collect();
        for (done, (k, name)) in order.iter().zip(&names).enumerate() {
            if done > 0 && self.random.below(4) == 0 {
                self.is_missed(&place, &names[..done]);
            }
            let of = format!("{k}/{parts}");
            let part = words(&["--part", &of, "--split", split, "-o", name, "--resume", name]);
            let line = [words(&["render"]), options.clone(), part].concat();
            self.to_its_end(&place, &line, name, time / parts as u32);
        }
        let mut merged = names.clone();
        self.shuffle(&mut merged);
        let line = [words(&["merge", "-q", "-o", "a.exr"]), merged].concat();
        let status = self.command(&place, &line).status().expect("the program starts");
        assert!(status.success(), "{line:?} of {options:?}: {}", self.said());
        let mut may_be = words(&["a.exr"]);
        may_be.extend(names.iter().flat_map(|name| [name.clone(), format!("{name}.previous")]));
        let may_be: Vec<&str> = may_be.iter().map(String::as_str).collect();
        assert_same(&place, &bytes, &[options, line].concat(), &may_be);
    }

    fn shuffle<T>(&mut self, all: &mut [T]) {
        (1..all.len()).rev().for_each(|k| all.swap(k, self.random.below(k + 1)));
    }

    /// A merge of too few parts says so, and writes nothing.
    fn is_missed(&mut self, place: &Path, parts: &[String]) {
        let line = [words(&["merge", "-q", "-o", "a.exr"]), parts.to_vec()].concat();
        let status = self.command(place, &line).status().expect("the program starts");
        assert!(status.code() == Some(1) && self.said().contains("missing"), "{line:?}: {}", self.said());
        assert!(!place.join("a.exr").exists());
    }

    /// Starts it, ends it at a random moment and starts it again, until it has come to its end.
    fn to_its_end(&mut self, place: &Path, line: &[String], film: &str, time: Duration) {
        for _ in 0..self.random.below(12) {
            let every = self.random.of(&["1ms", "5ms", "40ms", "60s"]);
            let threads = self.random.of(&["1", "2", "3"]);
            let line = [line, &words(&["--every", every, "--threads", threads])].concat();
            let mut child = self.command(place, &line).spawn().expect("the program starts");
            let most = 20_000 + time.as_micros() as usize;
            std::thread::sleep(Duration::from_micros(self.random.below(most) as u64));
            if self.end(&mut child, &line) {
                break;
            }
            self.damage(place, film);
        }
        let status = self.command(place, line).status().expect("the program starts");
        assert!(status.success(), "{line:?}: {}", self.said());
    }

    /// Ends it one way or another; whether it was at its end already.
    fn end(&mut self, child: &mut Child, line: &[String]) -> bool {
        let signal = self.random.of(&["KILL", "KILL", "KILL", "TERM", "INT", "HUP"]);
        if child.try_wait().expect("a child").is_none() {
            let kill = format!("kill -{signal} {}", child.id());
            let _ = Command::new("sh").args(["-c", &kill]).stderr(Stdio::null()).status();
        }
        let code = child.wait().expect("it ends").code();
        match code {
            Some(0) => return true,
            None => self.ended[0] += 1,
            Some(129 | 130 | 143) => self.ended[1] += 1,
            Some(_) => panic!("{line:?}: exit code {code:?}: {}", self.said()),
        }
        false
    }

    /// What a disk may do to the newest checkpoint. Never to both: that is what two are for.
    fn damage(&mut self, place: &Path, film: &str) {
        let (film, previous) = (place.join(film), place.join(format!("{film}.previous")));
        let Ok(mut bytes) = fs::read(&film) else { return };
        if !previous.exists() || self.random.below(6) > 0 {
            return;
        }
        self.damaged += 1;
        let at = self.random.below(bytes.len());
        match self.random.below(3) {
            0 => fs::remove_file(&film).expect("a file"),
            1 => fs::write(&film, &bytes[..at]).expect("a file"),
            _ => {
                bytes[at] ^= 1 << self.random.below(8);
                fs::write(&film, bytes).expect("a file");
            }
        }
    }
}

/// The picture is that of the quiet run, and nothing else is left in its folder.
#[track_caller]
fn assert_same(place: &Path, bytes: &[u8], line: &[String], may_be: &[&str]) {
    assert!(fs::read(place.join("a.exr")).expect("a picture") == bytes, "{line:?} gives another picture");
    for entry in fs::read_dir(place).expect("a folder").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        // What `kill -9` has met in the middle of its writing stays there, under a name of its own.
        let is_unfinished = name.starts_with(".tracer-") && name.ends_with(".tmp");
        assert!(is_unfinished || may_be.contains(&name.as_str()), "{line:?} leaves {name}");
    }
}
