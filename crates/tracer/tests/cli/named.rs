//! Files that are named on the command line: what stands in their place, and what replaces what.

use crate::support::{SCENE, Sandbox};
use std::fs;

/// Pictures replace pictures, reports replace reports; what somebody wrote is replaced by neither.
#[test]
fn what_is_something_else_is_not_replaced() {
    let sandbox = Sandbox::new();
    let notes = "what I wanted to remember: buy milk\n";
    sandbox.write("other.ron", notes);
    sandbox.write("notes.png", notes);
    let render = |more: &[&str]| {
        let line = ["render", "scene.ron", "--size", "4x4", "--samples", "1"];
        sandbox.run(&[&line[..], more].concat())
    };
    render(&["-o", "a.png", "--report", "other.ron"]).ends(2).says(&["other.ron", "is no report", "name another"]);
    render(&["-o", "notes.png"]).ends(2).says(&["notes.png", "is no picture"]);
    assert_eq!((sandbox.text("other.ron"), sandbox.text("notes.png")), (notes.to_owned(), notes.to_owned()));
    for name in ["a.png", "a.exr", "a.hdr", "a.pfm"] {
        render(&["-o", name, "--report", "report.json"]).ends(0);
        render(&["-o", name, "--report", "report.json"]).ends(0);
    }
    sandbox.write("empty.png", "");
    render(&["-o", "empty.png"]).ends(0);
    sandbox.run(&["compare", "a.png", "a.png", "-o", "notes.png"]).ends(2).says(&["is no picture"]);
    fs::create_dir(sandbox.path("golden")).expect("a folder");
    sandbox.write("golden/golden.toml", "");
    sandbox.write("golden/one.ron", sandbox.text("scene.ron"));
    for option in ["--json", "--junit", "--html"] {
        sandbox.run(&["golden", "run", "golden", option, "other.ron"]).ends(2).says(&["is there already and is no "]);
        sandbox.run(&["golden", "run", "golden", option, "made"]).ends(1);
        sandbox.run(&["golden", "run", "golden", option, "made"]).ends(1);
        fs::remove_file(sandbox.path("made")).expect("it is there");
    }
    sandbox.write("logo.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"><circle r=\"9\"/></svg>");
    sandbox.run(&["inspect", "scene.ron", "--pixel", "0,0", "--svg", "logo.svg"]).ends(2).says(&["logo.svg"]);
    sandbox.run(&["inspect", "scene.ron", "--pixel", "0,0", "--svg", "a.svg"]).ends(0);
    sandbox.run(&["inspect", "scene.ron", "--pixel", "0,0", "--svg", "a.svg"]).ends(0);
    assert_eq!(sandbox.text("other.ron"), notes);
}

/// A file is replaced by one of its own kind only, however short it is; an empty one holds nothing.
#[test]
fn a_kind_replaces_its_own_alone() {
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("golden")).expect("a folder");
    sandbox.write("golden/golden.toml", "size = [4, 4]\nsamples = 1\n");
    sandbox.write("golden/one.ron", SCENE);
    let kinds = [
        ("report", "render scene.ron --size 4x4 --samples 1 -o a.png --report", "r.json"),
        ("picture", "render scene.ron --size 4x4 --samples 1 -o", "p.png"),
        ("drawing", "inspect scene.ron --pixel 0,0 --svg", "d.svg"),
        ("file of tracer marks", "marks scene.ron --set output.marks={\"A\":(0,0,0)} -o", "m.tex"),
        ("JUnit report", "golden run golden --junit", "j.xml"),
        ("page", "golden run golden --html", "h.html"),
    ];
    let run = |line: &str, file: &str| sandbox.run(&line.split(' ').chain([file]).collect::<Vec<_>>());
    let made = kinds.map(|(noun, line, file)| {
        sandbox.write(file, "");
        run(line, file);
        let made = sandbox.read(file);
        assert!(!made.is_empty(), "{noun}");
        made
    });
    for (k, (noun, line, file)) in kinds.into_iter().enumerate() {
        assert_ne!(run(line, file).code, Some(2), "{noun}");
        let others = made.iter().enumerate().filter(|(other, _)| *other != k).map(|(_, bytes)| bytes.as_slice());
        for other in others.chain([&b"eggs\n"[..]]) {
            sandbox.write(file, other);
            run(line, file).ends(2).says(&[&format!("{file} is there already and is no {noun}")]);
            assert_eq!(sandbox.read(file), other, "{noun}");
        }
    }
    // Who takes a file for a folder is told which.
    let render = |output: &str| sandbox.run(&["render", "scene.ron", "-o", output]).ends(1);
    render("scene.ron/a.png").says(&["scene.ron is a file, and no folder; name another place"]);
    render("no/a.png").says(&["there is no folder no; make it"]);
}

/// A file that is named and is no scene, not there or a folder is told in our words, with what is there instead.
#[test]
fn what_is_named_and_is_no_scene_is_told() {
    let sandbox = Sandbox::new();
    fs::create_dir(sandbox.path("rooms")).expect("a folder");
    sandbox.run(&["render", "scene.ron", "-o", "pic.png", "--samples", "1"]).ends(0);
    sandbox.write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let before = ["pic.png", "tri.obj"].map(|name| sandbox.read(name));
    for command in [&["convert"][..], &["fmt"], &["check", "--fix"], &["check"], &["render"]] {
        let run = |file: &str| {
            let ran = sandbox.run(&[command, &[file]].concat()).ends(2);
            assert!(!ran.err.contains("os error") && !ran.err.contains("UTF-8"), "{command:?} {file}: {}", ran.err);
            ran
        };
        run("pic.png").says(&["pic.png is a picture, not a scene", "--from pic.png"]);
        run("tri.obj").says(&["tri.obj is a mesh, not a scene"]);
        run("sceen.ron").says(&["there is no scene file sceen.ron; did you mean scene.ron?"]);
        run("scene.ron/x").says(&["there is no scene file scene.ron/x; scene.ron is no folder\n"]);
        run("no/a.ron").says(&["there is no scene file no/a.ron; no is no folder\n"]);
    }
    assert_eq!(["pic.png", "tri.obj"].map(|name| sandbox.read(name)), before);
    // The others are looked at all the same.
    let ran = sandbox.run(&["check", "--fix", "pic.png", "scene.ron"]).ends(2).says(&["is a picture", "1 of 2 scenes"]);
    assert!(ran.out_text().contains("scene.ron: ok"), "{}", ran.out_text());
    // Of a command's place, too.
    sandbox.run(&["scene.ro"]).ends(2).says(&["there is no scene file scene.ro; did you mean scene.ron?"]);
    sandbox.run(&["./rooms"]).ends(2).says(&["cannot read ./rooms: it is a folder; name a scene file in it"]);
    sandbox.run(&["rooms"]).ends(2).says(&["tip: rooms is a folder; name a scene file in it"]);
    sandbox.run(&["scene"]).ends(2).says(&["tip: did you mean scene.ron?"]);
    for command in [&["repro"][..], &["new", "a.ron", "--from"]] {
        let run = |file: &str| sandbox.run(&[command, &[file]].concat()).ends(2);
        run("rooms").says(&["cannot read rooms: it is a folder; name a picture in it"]);
        run("pci.png").says(&["there is no picture pci.png; did you mean pic.png?"]);
        run("pic.png/x").says(&["there is no picture pic.png/x"]);
    }
    // An address of the documentation (RFC 5737), which no machine has.
    let ran = sandbox.run(&["preview", "scene.ron", "--address", "192.0.2.1"]).ends(2);
    ran.says(&["--address 192.0.2.1: this machine has no such address; "]);
}
