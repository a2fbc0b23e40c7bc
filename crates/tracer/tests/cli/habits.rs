//! Habits of the terminal: closed pipes, colours, `-v`, what goes to which stream.

use crate::commands::COMMANDS;
use crate::support::{Ran, SCENE, Sandbox, repository};
use std::process::Stdio;

/// A command line of each command that prints to standard output.
fn printing() -> Vec<Vec<&'static str>> {
    vec![
        vec!["render", "scene.ron", "-o", "-", "--format", "png"],
        vec!["render", "scene.ron", "-o", "a.png", "--report", "-"],
        vec!["merge", "b.film", "-q", "-o", "-", "--format", "pfm"],
        vec!["merge", "b.film", "-q", "-o", "c.png", "--report", "-"],
        vec!["farm", "slurm", "scene.ron", "-o", "d.png", "--parts", "2", "--dry-run"],
        vec!["preview", "scene.ron"],
        vec!["check", "scene.ron"],
        vec!["info", "scene.ron"],
        vec!["info", "scene.ron", "--json"],
        vec!["info", "scene.ron", "--resolved"],
        vec!["inspect", "scene.ron", "--pixel", "20,12"],
        vec!["inspect", "scene.ron", "--pixel", "20,12", "--format", "json"],
        vec!["marks", "scene.ron", "--set", "output.marks={\"A\": (0, 0, 0)}"],
        vec!["convert", "scene.ron"],
        vec!["fmt", "scene.ron", "--check"],
        vec!["new", "-"],
        vec!["new", "-", "--from", "b.png"],
        vec!["info", "b.png"],
        vec!["repro", "b.png", "-q"],
        vec!["compare", "b.png", "b.png"],
        vec!["compare", "b.png", "b.png", "--json"],
        vec!["bench-acceleration", "scene.ron", "--size", "8x8"],
        vec!["bench-figures", "8", "--samples", "1", "--scenes", concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenes")],
        vec!["golden", "accept", "shots", "ball", "--reason", "first"],
        vec!["golden", "run", "shots"],
        vec!["explain"],
        vec!["explain", "E0201"],
        vec!["lsp"],
        vec!["schema"],
        vec!["completions", "bash"],
        vec!["man"],
        vec!["man", "render"],
        vec!["--help"],
        vec!["--version"],
    ]
}

/// As in `tracer info scene.ron | head -1`: the reader has had enough, which is no fault and nothing to talk about.
#[test]
fn a_closed_pipe_is_no_fault() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "b.png", "--checkpoint", "b.film"]).ends(0);
    std::fs::create_dir(sandbox.path("shots")).expect("a folder");
    sandbox.write("shots/ball.ron", SCENE);
    sandbox.run(&["golden", "new", "shots"]).ends(0);
    sandbox.run(&["golden", "run", "shots"]).ends(1);
    let commands = printing();
    for command in COMMANDS {
        assert!(commands.iter().any(|arguments| arguments[0] == command), "{command} is not tried");
    }
    let helps = COMMANDS.map(|command| vec![command, "--help"]);
    for arguments in commands.into_iter().chain(helps) {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let ran = Ran::of(sandbox.command(&arguments).stdout(Stdio::from(writer)));
        assert_eq!(ran.silent().code, Some(0), "{arguments:?}");
    }
}

/// Nor is it one that nobody reads standard error.
#[test]
fn closed_standard_error_is_no_fault() {
    let sandbox = Sandbox::new();
    sandbox.write("bad.ron", "Scene(");
    for (arguments, code) in
        [(&["check", "bad.ron"][..], 2), (&["render", "scene.ron", "-o", "a.png", "-v"], 0), (&["nothing"], 2)]
    {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let status = sandbox.command(arguments).stderr(Stdio::from(writer)).status().expect("the program starts");
        assert_eq!(status.code(), Some(code), "{arguments:?}");
    }
}

/// On a terminal there are colours, unless NO_COLOR is set or `--color never` says so. `script` (of util-linux) is the
/// terminal.
#[cfg(target_os = "linux")]
#[test]
fn colours_on_a_terminal() {
    let sandbox = Sandbox::new();
    sandbox.write("bad.ron", "Scene(");
    let on_terminal = |line: &str| {
        let ran = sandbox.shell(&format!("TERM=xterm script -qec '{line}' /dev/null"));
        assert!(ran.out_text().contains("rror"), "{line}: {ran:?}");
        ran.out_text().contains('\x1b')
    };
    assert!(on_terminal(r#""$T" check bad.ron"#));
    assert!(!on_terminal(r#"NO_COLOR=1 "$T" check bad.ron"#));
    assert!(!on_terminal(r#""$T" check bad.ron --color never"#));
    assert!(!on_terminal(r#"TERM=dumb "$T" check bad.ron"#));
    // What a person asks for by an option wins over the environment.
    assert!(on_terminal(r#"NO_COLOR=1 "$T" check bad.ron --color always"#));
    // Faults of the command line itself, and an empty NO_COLOR, which counts as none (no-color.org).
    assert!(on_terminal(r#""$T" nothing"#));
    assert!(!on_terminal(r#"NO_COLOR=1 "$T" nothing"#));
    assert!(!on_terminal(r#""$T" nothing --color=never"#));
    assert!(on_terminal(r#"NO_COLOR= "$T" check bad.ron"#));
}

/// `-v` tells what is loaded: the scene, each file that it names, what became of it.
#[test]
fn verbose_tells_what_is_loaded() {
    let sandbox = Sandbox::new();
    std::fs::copy(repository().join("assets/globe.png"), sandbox.path("globe.png")).expect("a texture");
    sandbox.write("t.off", "OFF\n4 4 0\n-1 -1 -1\n1 1 -1\n1 -1 1\n-1 1 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n");
    let objects = r#"    objects: [
        Mesh(file: "t.off"),
        Sphere(center: (0, 9, 0), radius: 1, material: Diffuse(albedo: Texture(file: "globe.png"))),"#;
    sandbox.write("all.ron", SCENE.replace("    objects: [", objects));
    for command in [&["check", "all.ron"][..], &["render", "all.ron", "-o", "a.png"], &["info", "all.ron"]] {
        let quiet = sandbox.run(command).ends(0).silent();
        let ran = sandbox.run(&[command, &["-v"]].concat()).ends(0);
        for word in ["read all.ron: 5 objects, 1 light", "loaded t.off", "loaded globe.png", "4 triangles", "1 texture"]
        {
            assert!(ran.err.contains(word), "`{word}` is not in: {}", ran.err);
        }
        // Results are the same: what is said goes to standard error.
        assert_eq!(quiet.out, ran.out);
    }
}
