//! `--cache`: the same pictures, sooner; whatever happens to the folder.

use crate::support::{Sandbox, repository};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// A hilly field of so many rows, with a triangle that has no area.
fn field(sandbox: &Sandbox, name: &str, rows: usize, height: f64) {
    let mut text = format!("OFF\n{} {} 0\n", (rows + 1) * (rows + 1), 2 * rows * rows + 1);
    for k in 0..(rows + 1) * (rows + 1) {
        let (x, z) = (k % (rows + 1), k / (rows + 1));
        text += &format!("{x} {:.3} {z}\n", height * (((x * 7 + z * 13) % 11) as f64));
    }
    for k in 0..rows * rows {
        let a = k / rows * (rows + 1) + k % rows;
        text += &format!("3 {a} {} {}\n3 {} {} {}\n", a + 1, a + rows + 1, a + 1, a + rows + 2, a + rows + 1);
    }
    sandbox.write(name, text + "3 4 4 4\n");
}

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    field(&sandbox, "field.off", 70, 0.1);
    sandbox.write(
        "scene.ron",
        "Scene(background: 1, image: Image(width: 24, height: 16), render: Render(samples: 1), \
         camera: Camera(position: (35, 60, -30), look_at: (35, 0, 35)), objects: [Mesh(file: \"field.off\")])",
    );
    sandbox
}

const LINE: [&str; 6] = ["render", "scene.ron", "-o", "a.pfm", "--cache", "kept"];

/// Renders with the cache; what the report tells of it: hits, misses, damaged files.
#[track_caller]
fn render(sandbox: &Sandbox, more: &[&str], says: &[&str]) -> [u64; 3] {
    sandbox.run(&[&LINE[..], &["--report", "r.json"], more].concat()).ends(0).says(says);
    let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
    ["hits", "misses", "broken"].map(|field| report["cache"][field].as_u64().expect("a number"))
}

/// The files of the cache, with their sizes.
fn kept(sandbox: &Sandbox) -> Vec<(PathBuf, u64)> {
    let entries = fs::read_dir(sandbox.path("kept")).expect("a folder").map(|entry| entry.expect("an entry"));
    let mut files: Vec<_> = entries.map(|entry| (entry.path(), entry.metadata().expect("a file").len())).collect();
    files.sort();
    files
}

fn named(sandbox: &Sandbox, kind: &str) -> PathBuf {
    let is_it = |path: &Path| path.file_name().and_then(|name| name.to_str()).is_some_and(|n| n.starts_with(kind));
    kept(sandbox).into_iter().map(|(path, _)| path).find(|path| is_it(path)).expect("it is kept")
}

fn plain(sandbox: &Sandbox) -> Vec<u8> {
    sandbox.run(&["render", "scene.ron", "-o", "plain.pfm"]).ends(0);
    sandbox.read("plain.pfm")
}

#[test]
fn the_second_start_takes_what_the_first_has_kept() {
    let sandbox = sandbox();
    let plain = plain(&sandbox);
    for expected in [[0, 2, 0], [2, 0, 0], [2, 0, 0]] {
        // What is odd about the mesh is told every time.
        assert_eq!(render(&sandbox, &[], &["1 triangle without area"]), expected);
        assert_eq!(sandbox.read("a.pfm"), plain);
    }
    assert_eq!(render(&sandbox, &["--threads", "1"], &[]), [2, 0, 0]);
    // Neither locks nor halves of files are left.
    assert!(kept(&sandbox).iter().all(|(path, _)| path.extension().is_some_and(|extension| extension == "kept")));
    let mesh = named(&sandbox, "mesh-").display().to_string();
    let told = sandbox.run(&["info", &mesh]).ends(0).out_text();
    assert!(told.contains("a mesh, kept by --cache; whole") && told.contains("0.1.0+"), "{told}");
    let told: Value = serde_json::from_str(&sandbox.run(&["info", &mesh, "--json"]).ends(0).out_text()).expect("JSON");
    assert_eq!(told["kind"], "mesh");
    sandbox.run(&["info", &mesh, "--resolved"]).ends(2).says(&["is a file of a cache"]);
    // Frames share it.
    let frames = ["render", "scene.ron", "--cache", "kept", "--frames", "0", "-v", "-o", "f_####.pfm"];
    sandbox.run(&frames).ends(0).says(&["from the cache: field.off", "from the cache: the tree"]);
    assert_eq!(sandbox.read("f_0000.pfm"), plain);
}

#[test]
fn what_a_file_holds_counts() {
    let sandbox = sandbox();
    plain(&sandbox);
    // Too young to be recorded: by its contents it is found all the same.
    assert_eq!((render(&sandbox, &[], &[]), render(&sandbox, &[], &[])), ([0, 2, 0], [2, 0, 0]));
    std::thread::sleep(Duration::from_millis(2200));
    assert_eq!(render(&sandbox, &[], &[]), [2, 0, 0]);
    let record = named(&sandbox, "hash-");
    let told = sandbox.run(&["info", &record.display().to_string()]).ends(0).out_text();
    assert!(told.contains("the hash of ") && told.contains("field.off, kept by --cache"), "{told}");
    assert_eq!(render(&sandbox, &[], &[]), [2, 0, 0]);
    // Another file of the same size and time.
    let time = fs::metadata(sandbox.path("field.off")).and_then(|file| file.modified()).expect("a time");
    field(&sandbox, "field.off", 70, 0.2);
    let file = fs::File::options().write(true).open(sandbox.path("field.off")).expect("a file");
    file.set_modified(time).expect("a time");
    drop(file);
    let more: &[&str] = if cfg!(unix) { &[] } else { &["--cache-verify"] };
    assert_eq!(render(&sandbox, more, &[]), [0, 2, 0]);
    assert_eq!(sandbox.read("a.pfm"), plain(&sandbox));
    assert_eq!(render(&sandbox, &["--cache-verify"], &[]), [2, 0, 0]);
    // A record that is damaged is none.
    let mut text = fs::read(&record).expect("a file");
    let end = text.len();
    text[end - 100] ^= 1;
    fs::write(&record, text).expect("a file");
    assert_eq!(render(&sandbox, &[], &[]), [2, 0, 0]);
    assert_eq!(sandbox.read("a.pfm"), plain(&sandbox));
}

#[test]
fn damaged_files_are_told_and_made_anew() {
    let sandbox = sandbox();
    let plain = plain(&sandbox);
    render(&sandbox, &[], &[]);
    for kind in ["mesh-", "tree-"] {
        let file = named(&sandbox, kind);
        let bytes = fs::read(&file).expect("a file");
        let mut flipped = bytes.clone();
        flipped[bytes.len() / 2] ^= 16;
        for (damaged, why) in [
            (&bytes[..bytes.len() - 1], "in place of"),
            (&flipped[..], "its checksum is wrong"),
            (&b"nothing of the kind"[..], "it is no file of a cache"),
            (&[], "it is no file of a cache"),
        ] {
            fs::write(&file, damaged).expect("a file");
            let shown = file.display().to_string();
            sandbox.run(&["info", &shown]).ends(if why.contains("no file") { 2 } else { 1 });
            assert_eq!(render(&sandbox, &[], &["warning: ", why, "it is made anew"]), [1, 1, 1]);
            assert_eq!(sandbox.read("a.pfm"), plain);
            // It was kept anew.
            assert_eq!(render(&sandbox, &[], &[]), [2, 0, 0]);
        }
    }
}

#[test]
fn what_was_used_longest_ago_goes() {
    let sandbox = sandbox();
    render(&sandbox, &["--cache-size", "3MB"], &[]);
    let old = named(&sandbox, "tree-");
    for k in 2..8 {
        let past = SystemTime::now() - Duration::from_secs(100);
        for (path, _) in kept(&sandbox).iter().filter(|(path, _)| *path != old) {
            fs::File::options().write(true).open(path).and_then(|file| file.set_modified(past)).expect("a time");
        }
        field(&sandbox, "field.off", 70, 0.1 * f64::from(k));
        render(&sandbox, &["--cache-size", "3MB"], &[]);
        let size: u64 = kept(&sandbox).iter().map(|(_, bytes)| bytes).sum();
        assert!((1_000_000..=3_000_000).contains(&size), "{size}");
        // What is used stays.
        if k < 4 {
            fs::File::options().write(true).open(&old).and_then(|f| f.set_modified(SystemTime::now())).expect("a time");
            assert!(old.exists());
        }
    }
    sandbox.write("kept/mine.txt", "not to be deleted");
    sandbox.run(&[&LINE[..], &["--cache-size", "1MB"]].concat()).ends(0);
    assert!(sandbox.path("kept/mine.txt").exists());
    field(&sandbox, "field.off", 200, 0.1);
    sandbox.run(&[&LINE[..], &["--cache-size", "1MB"]].concat()).ends(0).says(&["raise --cache-size"]);
}

#[test]
fn nothing_that_is_wrong_with_the_folder_ends_a_rendering() {
    let sandbox = sandbox();
    let plain = plain(&sandbox);
    let at = |folder: &str| sandbox.run(&["render", "scene.ron", "-o", "a.pfm", "--cache", folder]);
    at("scene.ron").ends(2).says(&["--cache scene.ron: it is no folder"]);
    at("scene.ron/deeper").ends(0).says(&["warning: --cache scene.ron/deeper cannot be used"]);
    assert_eq!(sandbox.read("a.pfm"), plain);
    sandbox.run(&["render", "scene.ron", "--cache-size", "10"]).ends(2);
    // A folder where a file should be.
    render(&sandbox, &[], &[]);
    let file = named(&sandbox, "tree-");
    fs::remove_file(&file).expect("it is there");
    fs::create_dir(&file).expect("a folder");
    at("kept").ends(0);
    assert_eq!(sandbox.read("a.pfm"), plain);
}

#[test]
fn writers_at_once_and_writers_that_are_killed_leave_whole_files() {
    let sandbox = sandbox();
    let plain = plain(&sandbox);
    let spawned = |name: &str| {
        let mut command = sandbox.command(&["render", "scene.ron", "-q", "--cache", "kept", "-o", name]);
        command.spawn().expect("the program starts")
    };
    let names = ["0.pfm", "1.pfm", "2.pfm", "3.pfm"];
    let running: Vec<_> = names.map(spawned).into();
    for (mut child, name) in running.into_iter().zip(names) {
        assert!(child.wait().expect("it ends").success());
        assert_eq!(sandbox.read(name), plain);
    }
    for milliseconds in [5, 15, 25, 35, 45, 60, 80, 100] {
        fs::remove_dir_all(sandbox.path("kept")).expect("it is there");
        let mut child = spawned("killed.pfm");
        std::thread::sleep(Duration::from_millis(milliseconds));
        let _ = child.kill();
        child.wait().expect("it ends");
        assert_eq!(render(&sandbox, &[], &[])[2], 0);
        assert_eq!(sandbox.read("a.pfm"), plain);
        assert_eq!(render(&sandbox, &[], &[]), [2, 0, 0]);
    }
}

#[test]
fn the_manual_tells_of_it() {
    let manual = fs::read_to_string(repository().join("docs/scale.md")).expect("a manual");
    for word in ["--cache", "--cache-size", "--cache-verify", "10 GiB"] {
        assert!(manual.contains(word), "{word}");
    }
}
