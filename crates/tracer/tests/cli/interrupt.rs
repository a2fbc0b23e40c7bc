//! Ctrl-C, SIGTERM and SIGHUP: the first writes the picture so far, the second leaves at once.

use crate::support::{Sandbox, repository};
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, ChildStderr, Command, Stdio};
use std::time::{Duration, Instant};
use tracer::compare::Picture;

/// Starts the program and waits until it renders: with `-v` it says when it has compiled.
fn started(command: &mut Command) -> (Child, BufReader<ChildStderr>) {
    let mut child = command.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("the program starts");
    let mut stderr = BufReader::new(child.stderr.take().expect("a pipe"));
    let mut line = String::new();
    while !line.starts_with("compiled") {
        line.clear();
        assert!(stderr.read_line(&mut line).expect("text") > 0, "it ended early");
    }
    // From the line to the first batch there is little to do.
    std::thread::sleep(Duration::from_millis(100));
    (child, stderr)
}

fn interrupt(child: &Child) {
    send("INT", child);
}

fn send(signal: &str, child: &Child) {
    let line = format!("kill -{signal} {}", child.id());
    assert!(Command::new("sh").args(["-c", &line]).status().expect("a shell").success());
}

#[test]
fn the_first_writes_the_picture_so_far() {
    let sandbox = Sandbox::new();
    let arguments = ["render", "scene.ron", "-o", "a.png", "-o", "a.pfm", "--samples", "100000000", "-v"];
    let mut command = sandbox.command(&[&arguments[..], &["--report", "r.json"]].concat());
    let (mut child, mut stderr) = started(&mut command);
    interrupt(&child);
    let status = child.wait().expect("it ends");
    let mut said = String::new();
    stderr.read_to_string(&mut said).expect("text");
    assert_eq!(status.code(), Some(130), "{said}");
    assert!(said.contains("interrupted: a.png, a.pfm holds") && said.contains("of 100000000 samples"), "{said}");
    let picture = Picture::load(&sandbox.path("a.pfm")).expect("a whole picture");
    assert!(picture.values.iter().any(|&value| value > 0.0));
    let report: serde_json::Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
    assert_eq!(report["interrupted"], true);
    assert!(report["picture"]["samples_max"].as_u64().expect("a number") > 0);
    assert_eq!(sandbox.files(), ["a.pfm", "a.png", "r.json", "scene.ron"]);
}

#[test]
fn the_second_leaves_at_once() {
    let sandbox = Sandbox::new();
    // Without boxes a batch takes long: every ray meets three million triangles.
    let mesh = repository().join("assets/cat_60k.obj");
    sandbox.write(
        "slow.ron",
        format!(
            "Scene(background: 1, render: Render(acceleration: None), image: Image(width: 256, height: 256), \
             camera: Camera(position: (0, 1, 5)), objects: [Mesh(file: {mesh:?}, material: Diffuse(), placements: \
             [{}])])",
            "[Translate((0.1, 0, 0))], ".repeat(50)
        ),
    );
    sandbox.write("a.png", "PF old");
    let (mut child, _stderr) = started(&mut sandbox.command(&["render", "slow.ron", "-o", "a.png", "-v"]));
    interrupt(&child);
    std::thread::sleep(Duration::from_millis(50));
    assert_eq!(child.try_wait().expect("a child"), None, "the first one waits for the batch");
    let second = Instant::now();
    interrupt(&child);
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    assert!(second.elapsed() < Duration::from_secs(1));
    assert_eq!(sandbox.text("a.png"), "PF old");
    assert_eq!(sandbox.files(), ["a.png", "scene.ron", "slow.ron"]);
}

/// What `docker stop`, Slurm and systemd send, and what a lost ssh does: the picture so far is written, and the exit
/// code tells which it was.
#[test]
fn the_system_may_end_it_too() {
    for (signal, other, code) in
        [("TERM", "TERM", 143), ("HUP", "HUP", 129), ("TERM", "HUP", 143), ("HUP", "TERM", 129)]
    {
        let sandbox = Sandbox::new();
        let mut command = sandbox.command(&["render", "scene.ron", "-o", "a.pfm", "--samples", "100000000", "-v"]);
        let (mut child, mut stderr) = started(&mut command);
        send(signal, &child);
        // A terminal that goes away sends SIGHUP, and so does the shell in it; Slurm sends SIGTERM to all of a job, and
        // so does the script that it has started; systemd sends both where a session ends: that is one wish.
        if other != signal {
            // Of two that wait nobody knows which came first.
            std::thread::sleep(Duration::from_millis(100));
        }
        send(other, &child);
        let status = child.wait().expect("it ends");
        let mut said = String::new();
        stderr.read_to_string(&mut said).expect("text");
        assert_eq!(status.code(), Some(code), "{said}");
        assert!(said.contains(&format!("another SIG{signal} leaves at once")), "{said}");
        assert!(said.contains("interrupted: a.pfm holds"), "{said}");
        let picture = Picture::load(&sandbox.path("a.pfm")).expect("a whole picture");
        assert!(picture.values.iter().any(|&value| value > 0.0));
    }
}
