//! Checkpoints: a rendering that is killed, ended or finished is gone on with, and the picture is the one made at once.

use crate::support::{Ran, SCENE, Sandbox, is_done};
use serde_json::Value;
use std::fs;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A scene of its own kind each: light paths over mirror and glass, clamped samples, a lens, a part of the picture.
const KINDS: [&[&str]; 4] = [
    &[],
    &["--set", "render.clamp=0.5"],
    &["--set", "effects.depth_of_field=ThinLens(aperture: 0.4, focus_distance: 6)"],
    &["--crop", "7,3,20,18"],
];

fn render<'a>(output: &'a str, samples: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    [&["render", "scene.ron", "-o", output, "--samples", samples], more].concat()
}

fn spawn(command: &mut Command) -> Child {
    command.stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("the program starts")
}

/// Waits until something is so.
#[track_caller]
fn wait_until(what: &str, is_so: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(60), "{what} never came");
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn info(sandbox: &Sandbox, checkpoint: &str) -> Value {
    serde_json::from_str(&sandbox.run(&["info", checkpoint, "--json"]).ends(0).silent().out_text()).expect("JSON")
}

/// The picture's file is the same, with what it tells of itself, and so is what the report counts.
#[test]
fn killed_and_resumed_is_never_killed() {
    let mut random = 7_u64;
    let mut next = |most: u64| {
        random = random.wrapping_mul(0x5851_f42d_4c95_7f2d).wrapping_add(0x1405_7b7e_f767_814f);
        (random >> 33) % most
    };
    for (kind, more) in KINDS.into_iter().enumerate() {
        let sandbox = Sandbox::new();
        let report = ["--report", "r.json"];
        sandbox.run(&render("whole.png", "600", &[more, &report[..]].concat())).ends(0);
        let whole: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
        let keep = ["--resume", "c.film", "--every", "3ms"];
        let arguments = render("a.png", "600", &[more, &keep[..], &report[..]].concat());
        let mut goes_on = 0;
        for _ in 0..5 {
            let mut child = spawn(&mut sandbox.command(&arguments));
            // In the first moments, or while it renders and writes.
            std::thread::sleep(Duration::from_millis(next(120)));
            child.kill().expect("a child");
            child.wait().expect("it ends");
            goes_on += u32::from(sandbox.path("c.film").exists());
        }
        let ran = sandbox.run(&arguments).ends(0);
        assert!(goes_on == 0 || ran.err.lines().all(is_done), "{}", ran.err);
        assert_eq!(sandbox.read("a.png"), sandbox.read("whole.png"), "kind {kind}");
        let resumed: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
        for what in [
            "/rays/total",
            "/rays/photons",
            "/rays/chains",
            "/samples/total",
            "/noise/relative",
            "/picture/samples_min",
        ] {
            let of = |report: &Value| report.pointer(what).and_then(Value::as_f64);
            // Rays per second is the only one of them that may differ.
            assert_eq!(of(&resumed), of(&whole), "kind {kind}: {what}");
        }
        assert_eq!(resumed["transport"]["clamped"], whole["transport"]["clamped"]);
        // Nothing else is left there, whenever it was killed.
        assert_eq!(sandbox.files(), ["a.png", "c.film", "c.film.previous", "r.json", "scene.ron", "whole.png"]);
    }
}

#[cfg(unix)]
#[test]
fn signals_write_picture_and_checkpoint() {
    for (signal, code) in [("INT", 130), ("TERM", 143), ("HUP", 129)] {
        let sandbox = Sandbox::new();
        // An hour between checkpoints: what is there is written because of the signal.
        let keep = ["--checkpoint", "c.film", "--every", "1h"];
        let arguments = render("a.png", "100000000", &keep);
        let mut child = sandbox.command(&[&arguments[..], &["-v"]].concat());
        let mut child = child.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("the program starts");
        let mut said = std::io::BufReader::new(child.stderr.take().expect("a pipe"));
        let mut line = String::new();
        while !line.starts_with("compiled") {
            line.clear();
            assert!(std::io::BufRead::read_line(&mut said, &mut line).expect("text") > 0, "it ended early");
        }
        std::thread::sleep(Duration::from_millis(100));
        let kill = format!("kill -{signal} {}", child.id());
        assert!(Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
        let status = child.wait().expect("it ends");
        let mut rest = String::new();
        std::io::Read::read_to_string(&mut said, &mut rest).expect("text");
        assert_eq!(status.code(), Some(code), "{rest}");
        assert!(rest.contains("a.png holds") && rest.contains("--resume c.film goes on"), "{rest}");
        assert_eq!(sandbox.files(), ["a.png", "c.film", "scene.ron"]);
        // What is there is what the picture shows, and a few more samples are those that follow.
        let held = info(&sandbox, "c.film");
        let most = held["samples_max"].as_u64().expect("a number");
        let samples = (most + 70).to_string();
        sandbox.run(&render("b.png", &samples, &["--resume", "c.film"])).ends(0).silent();
        sandbox.run(&render("c.png", &samples, &[])).ends(0);
        assert_eq!(sandbox.read("b.png"), sandbox.read("c.png"));
    }
}

/// A signal while noise is taken out: the picture is written as it is, and the exit code says that it is not all.
#[cfg(unix)]
#[test]
fn signals_end_denoising() {
    let sandbox = Sandbox::new();
    let line = ["render", "scene.ron", "-o", "a.png", "--size", "700x500", "-s", "2", "--denoise", "-j", "1", "-v"];
    let mut child = sandbox.command(&line);
    let mut child = child.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("the program starts");
    std::thread::sleep(Duration::from_millis(1500));
    let kill = format!("kill -TERM {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
    let mut said = String::new();
    std::io::Read::read_to_string(&mut child.stderr.take().expect("a pipe"), &mut said).expect("text");
    assert_eq!(child.wait().expect("it ends").code(), Some(143), "{said}");
    // On a busy machine it was rendering still.
    assert!(said.contains("the picture is not denoised") || said.contains("a.png holds"), "{said}");
    assert_eq!(sandbox.files(), ["a.png", "scene.ron"]);
}

#[test]
fn a_finished_picture_is_extended() {
    let sandbox = Sandbox::new();
    sandbox.run(&render("a.pfm", "5", &["--resume", "c.film"])).ends(0).says(&["c.film is not there yet", "anew"]);
    let held = info(&sandbox, "c.film");
    assert_eq!((&held["samples_min"], &held["samples_max"]), (&5.into(), &5.into()));
    // The same line again: nothing is left to do, and the picture is the same.
    let first = sandbox.read("a.pfm");
    sandbox.run(&render("a.pfm", "5", &["--resume", "c.film", "--report", "r.json"])).ends(0).silent();
    assert_eq!(sandbox.read("a.pfm"), first);
    let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
    assert_eq!((&report["picture"]["samples_resumed"], &report["samples"]["total"]), (&5.into(), &4800.into()));
    assert_eq!(report["samples"]["per_second"], 0.0);
    // Into another file, so that the first stays.
    let before = sandbox.read("c.film");
    sandbox.run(&render("a.pfm", "9", &["--resume", "c.film", "--checkpoint", "d.film"])).ends(0).silent();
    assert_eq!(sandbox.read("c.film"), before);
    sandbox.run(&render("b.pfm", "9", &[])).ends(0);
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
    sandbox.run(&render("a.pfm", "20", &["--resume", "d.film"])).ends(0).silent();
    sandbox.run(&render("b.pfm", "20", &[])).ends(0);
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
    sandbox.run(&render("a.pfm", "19", &["--resume", "d.film"])).ends(2).says(&[
        "20 samples per pixel",
        "19 are asked",
        "--samples 20 or more",
        "`tracer merge d.film -o out.png`",
    ]);
    sandbox.run(&["merge", "d.film", "-o", "out.png"]).ends(0);
    // Exposure and tone map are made of the film.
    let brighter = ["--resume", "d.film", "--exposure", "1", "--set", "effects.tone_map=AgX"];
    sandbox.run(&render("a.png", "20", &brighter)).ends(0).silent();
    sandbox.run(&render("b.png", "20", &brighter[2..])).ends(0);
    assert_eq!(sandbox.read("a.png"), sandbox.read("b.png"));
    let files = sandbox.files();
    assert!(!files.iter().any(|name| name.ends_with(".lock") || name.ends_with(".writing")), "{files:?}");
}

#[test]
fn one_process_at_a_time() {
    let sandbox = Sandbox::new();
    let keep = ["--checkpoint", "c.film", "--every", "5ms"];
    let mut child = spawn(&mut sandbox.command(&render("a.png", "100000000", &keep)));
    wait_until("a checkpoint", || sandbox.path("c.film").exists());
    for option in ["--checkpoint", "--resume"] {
        let ran = sandbox.run(&render("b.png", "4", &[option, "./c.film"]));
        let ran = ran.ends(1);
        ran.says(&["another process writes ./c.film", "wait for it, or name another file"]);
    }
    child.kill().expect("a child");
    child.wait().expect("it ends");
    // The lock ends with the process.
    sandbox.run(&["info", "c.film"]).ends(0);
    sandbox.run(&render("b.png", "4", &["--checkpoint", "c.film"])).ends(0).says(&["c.film is there already"]);
}

#[test]
fn another_rendering_is_refused() {
    let sandbox = Sandbox::new();
    sandbox.write("t.off", "OFF\n4 4 0\n-1 -1 -1\n1 1 -1\n1 -1 1\n-1 1 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n");
    sandbox.run(&["render", "scene.ron", "-o", "t.png", "--size", "8x8"]).ends(0);
    let objects = r#"    objects: [ Mesh(file: "t.off"),
        Sphere(center: (0, 9, 0), radius: 1, material: Diffuse(albedo: Texture(file: "t.png"))),"#;
    let text = SCENE.replace("    objects: [", objects);
    sandbox.write("scene.ron", &text);
    let keep = ["--resume", "c.film"];
    sandbox.run(&render("a.png", "2", &keep)).ends(0);
    let before = sandbox.read("c.film");
    let refused = |more: &[&str], says: &[&str]| {
        let ran = sandbox.run(&render("a.png", "4", &[&keep[..], more].concat())).ends(2);
        ran.says(&["c.film is of another rendering: ", "name another file, or delete it"]).says(says);
        assert_eq!(sandbox.read("c.film"), before);
    };
    refused(&["--seed", "3"], &["the seed is 0 there and 3 here"]);
    refused(&["--size", "41x24"], &["the size is 40x24 there and 41x24 here"]);
    refused(&["--crop", "0,0,8,8"], &["the crop is 0,0,40,24 there and 0,0,8,8 here"]);
    refused(&["--set", "render.clamp=2"], &["render.clamp is None there and 2 here"]);
    refused(&["--set", "render.integrator=Path"], &["render.integrator is Full there and Path here"]);
    refused(&["--set", "render.max_bounces=7"], &["render.max_bounces is 4 there and 7 here"]);
    refused(&["--set", "camera.fov=41"], &["`camera` of the scene has changed"]);
    refused(&["--set", "effects.antialiasing=Box"], &["`effects` of the scene has changed"]);
    sandbox.write("scene.ron", text.replace("radius: 100)", "radius: 99)").replace("ior: 1.5", "ior: 1.4"));
    refused(&[], &["`objects` of the scene has changed", "`materials` of the scene has changed"]);
    // How it is written does not matter.
    sandbox.write("scene.ron", text.replace("// small", "// other"));
    sandbox.run(&render("a.png", "2", &keep)).ends(0).silent();
    let mesh = sandbox.text("t.off");
    let before = sandbox.read("c.film");
    sandbox.write("t.off", mesh.replace("1 1 -1\n", "1 1 -2\n"));
    let ran = sandbox.run(&render("a.png", "4", &keep)).ends(2);
    ran.says(&["the contents of t.off have changed"]);
    sandbox.write("t.off", &mesh);
    sandbox.run(&["render", "scene.ron", "-o", "t.png", "--size", "8x8", "--set", "background=1"]).ends(2);
    fs::copy(sandbox.path("a.png"), sandbox.path("t.png")).expect("a picture");
    sandbox.run(&render("a.png", "4", &keep)).ends(2).says(&["the contents of t.png have changed"]);
    assert_eq!(sandbox.read("c.film"), before);
}

#[test]
fn a_damaged_file_falls_back_to_the_one_before() {
    let sandbox = Sandbox::new();
    sandbox.run(&render("b.pfm", "12", &[])).ends(0);
    for samples in ["3", "6"] {
        sandbox.run(&render("a.pfm", samples, &["--resume", "c.film"])).ends(0);
    }
    let (good, before) = (sandbox.read("c.film"), sandbox.read("c.film.previous"));
    let mut flipped = good.clone();
    flipped[good.len() / 2] ^= 4;
    let foreign = sandbox.read("b.pfm");
    for (bad, why) in [
        (&good[..good.len() / 3], "cut short"),
        (&flipped[..], "damaged"),
        (&foreign[..], "it is no checkpoint"),
        (&[][..], "cut short"),
    ] {
        sandbox.write("c.film", bad);
        sandbox.write("c.film.previous", &before);
        let ran = sandbox.run(&render("a.pfm", "12", &["--resume", "c.film"])).ends(0);
        ran.says(&["c.film cannot be used: ", why, "going on from the one before, c.film.previous"]);
        assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
        // What was damaged has not replaced what was good.
        assert_eq!(info(&sandbox, "c.film")["samples_min"], 12);
        assert_eq!(sandbox.read("c.film.previous"), before);
    }
    // As killed between two renames, where there are no links.
    fs::rename(sandbox.path("c.film"), sandbox.path("c.film.previous")).expect("a file");
    let ran = sandbox.run(&render("a.pfm", "12", &["--resume", "c.film"])).ends(0);
    ran.says(&["c.film is not there; going on from the one before"]);
    sandbox.write("c.film", &flipped);
    sandbox.write("c.film.previous", &good[..good.len() - 1]);
    let ran = sandbox.run(&render("a.pfm", "12", &["--resume", "c.film"])).ends(1);
    ran.says(&[
        "c.film cannot be used: it is damaged",
        "nor the one before, c.film.previous: it is damaged: it is cut short",
    ]);
    fs::remove_file(sandbox.path("c.film.previous")).expect("a file");
    let ran = sandbox.run(&render("a.pfm", "12", &["--resume", "c.film"])).ends(1);
    ran.says(&["there is none before it", "name another file to begin anew"]);
}

/// What lies beside a checkpoint is replaced or deleted: only if it is tracer's.
#[test]
fn somebody_elses_files_beside_a_checkpoint_stay() {
    for beside in ["c.film.previous", "c.film.writing", "c.film.lock"] {
        let sandbox = Sandbox::new();
        sandbox.write(beside, "my notes, longer than a head of a film");
        for option in ["--checkpoint", "--resume"] {
            let ran = sandbox.run(&render("a.png", "2", &[option, "c.film"])).ends(2);
            ran.says(&[&format!("{beside} is no file of tracer's"), "name another file"]);
        }
        assert_eq!(sandbox.text(beside), "my notes, longer than a head of a film");
        assert!(!sandbox.path("c.film").exists());
    }
    // What a power cut has left is.
    let sandbox = Sandbox::new();
    sandbox.write("c.film.writing", [0; 4096]);
    sandbox.run(&render("a.png", "2", &["--checkpoint", "c.film"])).ends(0);
}

/// A checkpoint that nobody may write can be gone on with, if another place is named to write to.
#[test]
fn a_checkpoint_that_is_only_read() {
    let sandbox = Sandbox::new();
    sandbox.run(&render("b.pfm", "6", &[])).ends(0);
    sandbox.run(&render("a.pfm", "3", &["--checkpoint", "c.film"])).ends(0);
    let mut permissions = fs::metadata(sandbox.path("c.film")).expect("a file").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(sandbox.path("c.film"), permissions).expect("my file");
    sandbox.run(&render("a.pfm", "6", &["--resume", "c.film"])).ends(1).says(&["c.film", "read-only"]);
    sandbox.run(&render("a.pfm", "6", &["--resume", "c.film", "--checkpoint", "e.film"])).ends(0);
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
    assert_eq!(info(&sandbox, "c.film")["samples_min"], 3);
}

/// A file that would be larger than the system allows is as a full disk: the rendering goes on.
#[cfg(target_os = "linux")]
#[test]
fn a_limit_of_file_sizes_ends_nothing() {
    let sandbox = Sandbox::new();
    // 8 blocks of 512 or 1024 bytes, as the shell counts them; the film has more, and the picture has less.
    let line = "ulimit -f 8; exec \"$0\" render scene.ron -o a.png --samples 2 --checkpoint c.film";
    let mut command = std::process::Command::new("sh");
    command.args(["-c", line, env!("CARGO_BIN_EXE_tracer")]).current_dir(sandbox.path("."));
    let ran = Ran::of(&mut command).ends(1);
    ran.says(&["cannot write the checkpoint c.film", "ulimit -f"]);
    assert!(sandbox.path("a.png").exists() && !sandbox.path("c.film.writing").exists());
}

#[test]
fn info_tells_what_a_checkpoint_holds() {
    let sandbox = Sandbox::new();
    sandbox.run(&render("a.png", "3", &["--checkpoint", "c.film", "--crop", "1,2,30,20", "--seed", "5"])).ends(0);
    let text = sandbox.run(&["info", "c.film"]).ends(0).silent().out_text();
    for word in
        ["c.film", "whole", "scene.ron", "40x24 pixels, of it 1,2,30,20, seed 5", "samples    3\n", "0.1.0+", "Z\n"]
    {
        assert!(text.contains(word), "{word}:\n{text}");
    }
    let json = info(&sandbox, "c.film");
    let scene: Value = serde_json::from_str(
        &sandbox
            .run(&["info", "scene.ron", "--json", "--set", "render.samples=3", "--set", "render.seed=5"])
            .ends(0)
            .out_text(),
    )
    .expect("JSON");
    assert_eq!((&json["hash"], &json["scene"]), (&scene["hash"], &"scene.ron".into()));
    assert_eq!(json["picture"]["crop"], serde_json::json!([1, 2, 30, 20]));
    let mut bytes = sandbox.read("c.film");
    let last = bytes.len() - 1;
    bytes[last] ^= 1;
    sandbox.write("c.film", bytes);
    sandbox.run(&["info", "c.film"]).ends(1).says(&["c.film cannot be used", "checksum"]);
    sandbox.run(&["info", "c.film", "--resolved"]).ends(2).says(&["is a checkpoint"]);
}

#[test]
fn wrong_words_for_checkpoints() {
    let sandbox = Sandbox::new();
    let wrong = |more: &[&str], says: &[&str]| {
        sandbox.run(&render("a.png", "1", more)).ends(2).says(says);
    };
    wrong(&["--every", "60s"], &["--every is for checkpoints"]);
    wrong(&["--checkpoint", "c", "--every", "0s"], &["--every", "60s, 5m"]);
    wrong(&["--checkpoint", "a.png"], &["-o and --checkpoint both name a.png"]);
    wrong(&["--resume", "r.json", "--report", "r.json"], &["--report and --resume both name r.json"]);
    wrong(&["--resume", "scene.ron"], &["--resume scene.ron would replace the scene"]);
    wrong(&["--checkpoint", "scene.ron"], &["would replace what is no checkpoint"]);
    wrong(&["--checkpoint", "-"], &["a checkpoint is a file"]);
    let ran = sandbox.run(&render("a.png", "100000000", &["--checkpoint", "no/such/c.film"])).ends(1);
    ran.says(&["there is no folder no/such"]);
    assert_eq!(sandbox.files(), ["scene.ron"]);
}

/// Files may have some blocks: checkpoints fail in their middle, as on a full disk. It is said once, the picture comes.
#[cfg(unix)]
#[test]
fn a_full_disk_is_said_once_and_the_rendering_goes_on() {
    let sandbox = Sandbox::new();
    sandbox.run(&render("whole.png", "400", &[])).ends(0);
    let line = r#"trap '' XFSZ; ulimit -f 16
        exec "$T" render scene.ron -o a.png --samples 400 --checkpoint c.film --every 2ms"#;
    let ran: Ran = sandbox.shell(line).ends(1);
    assert_eq!(ran.err.matches("the rendering goes on").count(), 1, "{}", ran.err);
    let ran = ran.says(&["warning: cannot write the checkpoint c.film", "error: cannot write the checkpoint c.film"]);
    drop(ran);
    assert_eq!(sandbox.read("a.png"), sandbox.read("whole.png"));
    assert_eq!(sandbox.files(), ["a.png", "scene.ron", "whole.png"]);
}

/// The folders of picture and checkpoint go while it renders.
#[cfg(unix)]
#[test]
fn folders_that_vanish_are_made_again() {
    let sandbox = Sandbox::new();
    for folder in ["pictures", "states"] {
        fs::create_dir(sandbox.path(folder)).expect("a folder");
    }
    let mut command =
        sandbox.command(&render("pictures/a.png", "4000", &["--checkpoint", "states/c", "--every", "20ms"]));
    let child = command.stderr(Stdio::piped()).spawn().expect("the program starts");
    wait_until("a checkpoint", || sandbox.path("states/c").exists());
    fs::remove_dir_all(sandbox.path("pictures")).expect("my folder");
    while fs::remove_dir_all(sandbox.path("states")).is_err() {}
    let ended = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(0), "{said}");
    assert!(said.contains("the folder of pictures/a.png was gone: it is made again"), "{said}");
    assert!(said.contains("the folder of states/c was gone: it is made again"), "{said}");
    assert!(sandbox.read("pictures/a.png").starts_with(b"\x89PNG"));
    assert_eq!(info(&sandbox, "states/c")["samples_min"], 4000);
}

/// Where the folder cannot be made again the picture is put elsewhere.
#[cfg(unix)]
#[test]
fn a_picture_without_a_folder_is_put_elsewhere() {
    let sandbox = Sandbox::new();
    for folder in ["pictures", "temporary"] {
        fs::create_dir(sandbox.path(folder)).expect("a folder");
    }
    let mut command = sandbox.command(&render("pictures/a.png", "4000", &["--checkpoint", "c", "--every", "20ms"]));
    command.env("TMPDIR", sandbox.path("temporary"));
    let child = command.stderr(Stdio::piped()).spawn().expect("the program starts");
    wait_until("a checkpoint", || sandbox.path("c").exists());
    fs::remove_dir_all(sandbox.path("pictures")).expect("my folder");
    sandbox.write("pictures", "a file, which no folder can replace");
    let ended = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&ended.stderr);
    assert_eq!(ended.status.code(), Some(1), "{said}");
    assert!(said.contains("cannot write pictures/a.png") && said.contains("the picture is in"), "{said}");
    let found = fs::read_dir(sandbox.path("temporary")).expect("my folder").count();
    assert_eq!(found, 1);
}

/// A checkpoint that was ended within a pass is enough to make its picture.
#[cfg(unix)]
#[test]
fn what_was_ended_within_a_pass_makes_its_picture() {
    let sandbox = Sandbox::new();
    let line =
        ["render", "scene.ron", "-o", "a.pfm", "--samples", "100000000", "--checkpoint", "a.film", "--every", "1h"];
    let mut child = spawn(&mut sandbox.command(&line));
    std::thread::sleep(Duration::from_millis(1500));
    let kill = format!("kill -INT {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    let said = sandbox.run(&["merge", "a.film", "-o", "b.pfm"]).ends(0).err;
    assert!(said.contains("--resume a.film goes on") || said.contains("b.pfm of 1 part"), "{said}");
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
}
