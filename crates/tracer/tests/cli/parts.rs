//! `--part` and `merge`: the bytes of one machine, and whatever is wrong with parts is named.

use crate::support::{Sandbox, repository};
use serde_json::Value;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};
use std::time::Duration;

fn render(sandbox: &Sandbox, more: &[&str]) {
    sandbox.run(&[&["render", "scene.ron", "-q"], more].concat()).ends(0);
}

/// Renders parts, with or without `-o`.
fn parts(sandbox: &Sandbox, n: usize, more: &[&str]) {
    (1..=n).for_each(|k| render(sandbox, &[&["--part", &format!("{k}/{n}")], more].concat()));
}

fn json(sandbox: &Sandbox, name: &str) -> Value {
    serde_json::from_str(&sandbox.text(name)).expect("JSON")
}

/// All parts together are the rendering, which can have more samples then; a part replaces no other one.
#[test]
fn what_is_merged_whole_can_be_extended() {
    for split in ["samples", "rows"] {
        let sandbox = Sandbox::new();
        let size = ["--size", "40x40", "--samples"];
        parts(&sandbox, 3, &[&size[..], &["4", "--split", split]].concat());
        let parts = ["scene.1of3.tracer", "scene.2of3.tracer", "scene.3of3.tracer"];
        sandbox.run(&[&["merge"], &parts[..], &["-o", "w.tracer"]].concat()).ends(0).says(&["w.tracer of 3 parts"]);
        render(&sandbox, &[&size[..], &["4", "-o", "four.pfm"]].concat());
        sandbox.run(&["merge", "w.tracer", "-o", "merged.pfm"]).ends(0);
        assert_eq!(sandbox.read("merged.pfm"), sandbox.read("four.pfm"), "{split}");
        render(&sandbox, &[&size[..], &["9", "-o", "nine.pfm"]].concat());
        render(&sandbox, &[&size[..], &["9", "-o", "more.pfm", "--resume", "w.tracer"]].concat());
        assert_eq!(sandbox.read("more.pfm"), sandbox.read("nine.pfm"), "{split}");
        // By a slip of the name.
        let before = sandbox.read(parts[0]);
        let slip = [&["render", "scene.ron", "-q", "--split", split], &size[..], &["4", "-o", parts[0]]].concat();
        let ran = sandbox.run(&[&slip[..], &["--part", "2/3"]].concat()).ends(2);
        ran.says(&["would replace another part of this rendering", "which is finished"]);
        assert_eq!(sandbox.read(parts[0]), before);
        sandbox.run(&[&slip[..], &["--part", "1/3"]].concat()).ends(0);
    }
}

#[test]
fn merged_pictures_are_those_of_one_machine() {
    let kinds: [&[&str]; 4] = [
        &["--samples", "7", "--layers", "depth,normal,object_id"],
        &["--samples", "7", "--set", "render.clamp=0.5", "--crop", "3,2,30,20", "--exposure", "1"],
        &["--samples", "3", "--size", "40x70", "--set", "effects.tone_map=AgX", "--seed", "5"],
        &["--samples", "2", "--size", "33x90", "--split", "rows", "--set", "render.integrator=Path"],
    ];
    for (k, more) in kinds.into_iter().enumerate() {
        let sandbox = Sandbox::new();
        let of_one: Vec<&str> = more.iter().copied().filter(|word| !["--split", "rows"].contains(word)).collect();
        render(&sandbox, &[&["-o", "one.exr", "-o", "one.png", "--report", "one.json"][..], &of_one].concat());
        let n = [3, 7, 5, 4][k];
        parts(&sandbox, n, more);
        let mut files: Vec<String> = sandbox.files().into_iter().filter(|name| name.ends_with(".tracer")).collect();
        assert_eq!(files.len(), n);
        assert_eq!(files[0], format!("scene.1of{n}.tracer"));
        files.rotate_left(2);
        files.swap(0, 1);
        let names: Vec<&str> = files.iter().map(String::as_str).collect();
        let merge = [&["merge"][..], &names, &["-o", "all.exr", "-o", "all.png", "--report", "all.json"]].concat();
        let ran = sandbox.run(&merge).ends(0);
        ran.says(&["all.exr, all.png of ", &format!("{n} parts in "), "samples per pixel"]);
        assert_eq!(sandbox.read("all.png"), sandbox.read("one.png"), "kind {k}");
        assert_eq!(sandbox.read("all.exr"), sandbox.read("one.exr"), "kind {k}");
        let (all, one) = (json(&sandbox, "all.json"), json(&sandbox, "one.json"));
        for what in ["/scene", "/picture/samples_min", "/picture/crop", "/picture/layers", "/samples/total"] {
            assert_eq!(all.pointer(what), one.pointer(what), "kind {k}: {what}");
        }
        // Of parts nobody knows by how much two halves of all samples differ.
        assert!(all["noise"]["relative"].as_f64().is_some_and(|noise| noise > 0.0), "kind {k}");
        assert_eq!(all["clamped"], one["transport"]["clamped"]);
        // Parts by samples trace no ray twice, and count none twice.
        if k < 2 {
            assert_eq!(all["rays"]["total"], one["rays"]["total"], "kind {k}");
        }
        let of_parts = all["parts"].as_array().expect("parts");
        assert_eq!((of_parts.len(), &all["missing"]), (n, &Value::Array(Vec::new())));
        assert_eq!(of_parts[0]["samples"][0], 0);
    }
}

/// Merged in two steps, on several machines, and what no part can be made of.
#[test]
fn parts_become_a_larger_part() {
    let sandbox = Sandbox::new();
    let more = ["--samples", "7", "--layers", "depth", "--denoise"];
    render(&sandbox, &[&["-o", "one.exr"][..], &more].concat());
    parts(&sandbox, 5, &more);
    let part = |k: usize| format!("scene.{k}of5.tracer");
    let (one, two, three, four, five) = (part(1), part(2), part(3), part(4), part(5));
    let made = sandbox.run(&["merge", &four, &three, &five, "-o", "late.tracer", "--report", "late.json"]).ends(0);
    made.says(&["late.tracer of 3 parts in ", "samples 2 to 6 of 7, rows 0 to"]);
    assert_eq!(json(&sandbox, "late.json")["picture"]["samples_min"], 5);
    let info = sandbox.run(&["info", "late.tracer"]).ends(0).out_text();
    assert!(info.contains("samples 2 to 6 of 7"), "{info}");
    sandbox.run(&["merge", &one, &two, "-o", "early.tracer", "-q"]).ends(0);
    sandbox.run(&["merge", "late.tracer", "early.tracer", "-o", "all.exr", "--denoise", "-q"]).ends(0);
    assert_eq!(sandbox.read("all.exr"), sandbox.read("one.exr"));

    let files = sandbox.files();
    let wrong = |words: &[&str], code: i32, says: &[&str]| {
        sandbox.run(&[&["merge"], words].concat()).ends(code).says(says);
        assert_eq!(sandbox.files(), files);
    };
    wrong(&[&one, &three, "-o", "x.tracer"], 1, &["missing: samples 1 to 1 of rows", "must lie together"]);
    wrong(&[&two, "late.tracer", &four, "-o", "x.tracer"], 2, &["have the same samples"]);
    wrong(&[&one, &two, "-o", "x.tracer", "--denoise"], 2, &["--denoise is for pictures"]);
    wrong(&[&one, &two, "-o", "x.tracer", "--allow-missing"], 2, &["--allow-missing is for pictures"]);
    wrong(&[&one, &two, "-o", "x.tracer", "-o", "x.png"], 2, &["a part is one file"]);
    wrong(&[&one, &two, "-o", &two], 2, &["would replace a part"]);
}

/// Parts of different numbers of parts, other threads and instructions.
#[test]
fn unequal_parts_of_unequal_machines() {
    let sandbox = Sandbox::new();
    render(&sandbox, &["-o", "one.pfm", "--samples", "24"]);
    let part = |part: &str, name: &str, lanes: Option<&str>, threads: &str| {
        let arguments = ["render", "scene.ron", "-qj", threads, "--samples", "24", "--part", part, "-o", name];
        let mut command = sandbox.command(&arguments);
        if let Some(lanes) = lanes {
            command.env("TRACER_LANES", lanes);
        }
        assert!(command.status().expect("it starts").success());
    };
    part("1/2", "a.tracer", Some("1"), "1");
    part("3/4", "b.tracer", None, "3");
    part("4/4", "c.tracer", Some("1"), "2");
    sandbox.run(&["merge", "c.tracer", "a.tracer", "b.tracer", "-o", "all.pfm"]).ends(0);
    assert_eq!(sandbox.read("all.pfm"), sandbox.read("one.pfm"));
    // All of it at once is a part, too, and so is a checkpoint.
    render(&sandbox, &["-o", "whole.pfm", "--samples", "24", "--checkpoint", "whole.film"]);
    sandbox.run(&["merge", "whole.film", "-o", "all.pfm"]).ends(0).says(&["all.pfm of 1 part"]);
    assert_eq!(sandbox.read("all.pfm"), sandbox.read("one.pfm"));
}

#[test]
fn what_is_wrong_with_parts_is_named() {
    let sandbox = Sandbox::new();
    let more = ["--samples", "9"];
    parts(&sandbox, 3, &more);
    let [one, two, three] = ["scene.1of3.tracer", "scene.2of3.tracer", "scene.3of3.tracer"];
    let merge = |parts: &[&str], more: &[&str]| {
        let ran = sandbox.run(&[&["merge"], parts, &["-o", "all.png"], more].concat());
        assert_eq!(ran.code == Some(0), sandbox.path("all.png").exists(), "{}", ran.err);
        let _ = std::fs::remove_file(sandbox.path("all.png"));
        ran
    };
    merge(&[one, three], &[]).ends(1).says(&["missing: samples 3 to 5 of rows 0 to 23", "--allow-missing"]);
    let ran = merge(&[one, three], &["--allow-missing", "--report", "r.json"]).ends(0);
    ran.says(&["warning: missing: samples 3 to 5 of rows 0 to 23", "2 parts", "6 samples per pixel"]);
    let missing = &json(&sandbox, "r.json")["missing"];
    assert_eq!(missing[0]["samples"], serde_json::json!([3, 6]));
    assert_eq!(missing[0]["rows"], serde_json::json!([0, 24]));
    // The same name, another name of the same part, another part of the same samples.
    merge(&[one, two, three, one], &[]).ends(2).says(&["scene.1of3.tracer is named twice"]);
    sandbox.write("again.tracer", sandbox.read(two));
    merge(&[one, two, three, "again.tracer"], &["--allow-missing"]).ends(2).says(&[
        "again.tracer (samples 3 to 5 of 9, rows 0 to 23) and scene.2of3.tracer",
        "same samples",
        "leave one out",
    ]);
    render(&sandbox, &[&more[..], &["--part", "1/2", "-o", "half.tracer"]].concat());
    merge(&[one, "half.tracer", three], &[]).ends(2).says(&["half.tracer", "same samples"]);
    // Of other renderings: whatever differs is said, of the one that is alone.
    for (set, says) in [
        (&["--seed", "3"][..], "the seed is 3 there and 0 here"),
        (&["--samples", "12"], "the number of samples is 12 there and 9 here"),
        (&["--size", "41x24"], "the size is 41x24 there and 40x24 here"),
        (&["--set", "render.clamp=2"], "render.clamp is 2 there and None here"),
        (&["--set", "camera.fov=41"], "`camera` of the scene has changed"),
        (&["--layers", "depth"], "the set of layers is depth there and none here"),
        (&["--crop", "0,0,8,8"], "the crop is 0,0,8,8 there and 0,0,40,24 here"),
    ] {
        let arguments = [&["--part", "1/3", "-o", "x.tracer", "--samples", "9"], set].concat();
        let arguments: Vec<&str> = match set[0] {
            "--samples" => [&arguments[..4], set].concat(),
            _ => arguments,
        };
        render(&sandbox, &arguments);
        let ran = merge(&["x.tracer", two, three], &["--allow-missing"]).ends(2);
        ran.says(&["x.tracer is of another rendering than scene.2of3.tracer (here): ", says]);
    }
    // Cut, changed, not finished, no part at all.
    let good = sandbox.read(two);
    sandbox.write("cut.tracer", &good[..good.len() / 2]);
    let mut flipped = good.clone();
    flipped[good.len() - 100] ^= 4;
    sandbox.write("flipped.tracer", &flipped);
    let ran = merge(&[one, "cut.tracer", "flipped.tracer", three], &[]).ends(1);
    ran.says(&["cut.tracer cannot be used: it is damaged", "flipped.tracer cannot be used", "missing: samples 3 to 5"]);
    merge(&[one, "cut.tracer", three], &["--allow-missing"]).ends(0).says(&["warning: cut.tracer cannot be used"]);
    merge(&["cut.tracer"], &["--allow-missing"]).ends(1).says(&["no part is left"]);
    merge(&[one, "scene.ron"], &[]).ends(2).says(&["scene.ron is no part", "tracer render SCENE --part"]);
    // What is not there is told in our words, whatever else is lost; it may be missing where parts may.
    let ran = merge(&[one, "none.tracer", "cut.tracer"], &[]).ends(2);
    assert!(ran.err.contains("there is no part none.tracer\n") && !ran.err.contains("os error"), "{}", ran.err);
    merge(&[one, two, "scene.3of4.tracer"], &[]).ends(2).says(&["did you mean scene.3of3.tracer?"]);
    merge(&[one, "none.tracer"], &["--allow-missing"]).ends(0).says(&["warning: there is no part none.tracer"]);
    merge(&["none.tracer"], &["--allow-missing"]).ends(2).says(&["no part is left"]);
    merge(&[one, "scene.ron/x"], &[]).ends(2).says(&["there is no part scene.ron/x"]);
    let ran = merge(&[one, "."], &[]).ends(2);
    assert!(ran.err.contains(". is a folder; name the parts in it") && !ran.err.contains("os error"), "{}", ran.err);
    sandbox.run(&["merge", one, two, three, "-o", one]).ends(2).says(&["-o scene.1of3.tracer"]);
    sandbox.run(&["merge", one, two, three, "-o", "a.png", "--report", one]).ends(2).says(&["would replace a part"]);
}

#[test]
fn a_changed_file_of_the_scene_is_another_rendering() {
    let sandbox = Sandbox::new();
    let mesh = "OFF\n4 4 0\n-1 -1 -1\n1 1 -1\n1 -1 1\n-1 1 1\n3 0 1 2\n3 0 2 3\n3 0 3 1\n3 1 3 2\n";
    sandbox.write("t.off", mesh);
    sandbox.write(
        "scene.ron",
        "Scene(background: 1, image: Image(width: 9, height: 9), objects: [Mesh(file: \"t.off\")])",
    );
    render(&sandbox, &["--samples", "3", "--part", "1/3"]);
    render(&sandbox, &["--samples", "3", "--part", "2/3"]);
    sandbox.write("t.off", mesh.replace("-1 1 1", "-1 1 2"));
    render(&sandbox, &["--samples", "3", "--part", "3/3"]);
    sandbox.run(&["merge", "scene.3of3.tracer", "scene.1of3.tracer", "scene.2of3.tracer", "-o", "a.png"]).ends(2).says(
        &["scene.3of3.tracer is of another rendering than scene.1of3.tracer", "the contents of t.off have changed"],
    );
}

#[test]
fn options_that_a_part_cannot_have() {
    let sandbox = Sandbox::new();
    let wrong = |more: &[&str], says: &[&str]| {
        sandbox.run(&[&["render", "scene.ron"], more].concat()).ends(2).says(says);
        assert_eq!(sandbox.files(), ["scene.ron"]);
    };
    wrong(&["--part", "3"], &["3/16"]);
    wrong(&["--part", "4/3"], &["3/16"]);
    wrong(&["--part", "1/2", "-o", "a.png"], &["a part is no picture", "a.tracer"]);
    wrong(&["--part", "1/2", "-o", "a"], &["no name of a part", "a.tracer"]);
    wrong(&["--part", "1/2", "-o", "a.tracer", "-o", "b.tracer"], &["one file", "tracer merge"]);
    wrong(&["--part", "1/2", "-o", "-"], &["cannot be standard output"]);
    wrong(&["--part", "1/5", "--samples", "4"], &["4 parts by samples, 2 by rows"]);
    wrong(&["--part", "1/3", "--split", "rows"], &["--split rows", "2 by rows"]);
    wrong(&["--part", "1/2", "--noise", "1%"], &["--noise", "--part"]);
    wrong(&["--part", "1/2", "--set", "render.noise=0.01"], &["`render.noise` is a goal for the whole picture"]);
    wrong(&["--split", "rows"], &["--part"]);
    wrong(&["--part", "1/2", "-o", "a.tracer", "--report", "a.tracer"], &["both name a.tracer"]);
    wrong(&["-o", "a.tracer"], &["a.tracer", "no kind of picture"]);
    sandbox.write("a.tracer", "mine");
    sandbox
        .run(&["render", "scene.ron", "--part", "1/2", "-o", "a.tracer"])
        .ends(2)
        .says(&["would replace what is no part"]);
    assert_eq!(sandbox.text("a.tracer"), "mine");
}

/// Killed at random moments and started by the same line again, the state kept in the part's own file.
#[test]
fn a_part_that_is_killed_goes_on() {
    let sandbox = Sandbox::new();
    render(&sandbox, &["-o", "one.exr", "--samples", "900"]);
    for part in ["1/3", "2/3", "3/3"] {
        let name = format!("p{}.tracer", &part[..1]);
        let arguments = [
            "render",
            "scene.ron",
            "-q",
            "--samples",
            "900",
            "--part",
            part,
            "-o",
            &name,
            "--resume",
            &name,
            "--every",
            "3ms",
        ];
        for wait in [15, 40, 90] {
            let mut child = sandbox.command(&arguments);
            let mut child = child.stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("it starts");
            std::thread::sleep(Duration::from_millis(wait));
            child.kill().expect("a child");
            child.wait().expect("it ends");
        }
        sandbox.run(&arguments).ends(0);
        let report: Value =
            serde_json::from_str(&sandbox.run(&["info", &name, "--json"]).ends(0).out_text()).expect("JSON");
        assert_eq!((&report["samples_min"], &report["samples_max"]), (&300.into(), &300.into()));
        assert!(sandbox.run(&["info", &name]).ends(0).out_text().contains("of 900, rows 0 to 23"));
    }
    sandbox.run(&["merge", "p3.tracer", "p1.tracer", "p2.tracer", "-o", "all.exr"]).ends(0);
    assert_eq!(sandbox.read("all.exr"), sandbox.read("one.exr"));
    // Of another part the file is refused.
    let other =
        ["render", "scene.ron", "--samples", "900", "--part", "2/3", "-o", "p1.tracer", "--resume", "p1.tracer"];
    sandbox
        .run(&other)
        .ends(2)
        .says(&["the part is samples 0 to 299 of 900, rows 0 to 23 there and samples 300 to 599"]);
}

#[cfg(unix)]
#[test]
fn an_interrupted_part_is_kept_and_named() {
    let sandbox = Sandbox::new();
    let arguments = ["render", "scene.ron", "--samples", "100000000", "--part", "2/2", "-o", "p.tracer"];
    let mut child = sandbox.command(&[&arguments[..], &["-v"]].concat());
    let mut child = child.stderr(Stdio::piped()).stdout(Stdio::null()).spawn().expect("it starts");
    let mut reader = BufReader::new(child.stderr.take().expect("a pipe"));
    let mut said = String::new();
    while !said.contains("compiled") {
        assert!(reader.read_line(&mut said).expect("text") > 0, "it ended early: {said}");
    }
    std::thread::sleep(Duration::from_millis(300));
    let kill = format!("kill -TERM {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
    let status = child.wait().expect("it ends");
    reader.read_to_string(&mut said).expect("text");
    assert_eq!(status.code(), Some(143), "{said}");
    assert!(said.contains("--resume p.tracer goes on"), "{said}");
    let ran = sandbox.run(&["merge", "p.tracer", "-o", "a.png", "--allow-missing"]).ends(1);
    ran.says(&["p.tracer is not finished", "of 50000000 samples per pixel"]);
}

/// The lines of docs/scale.md that can run here do.
#[cfg(unix)]
#[test]
fn the_lines_of_the_manual_work() {
    let manual = std::fs::read_to_string(repository().join("docs/scale.md")).expect("the manual");
    let block = |after: &str| {
        let (_, rest) = manual.split_once(after).unwrap_or_else(|| panic!("{after} is not in docs/scale.md"));
        let (_, rest) = rest.split_once("```sh\n").expect("a block");
        rest.split_once("```").expect("its end").0.to_owned()
    };
    let sandbox = Sandbox::new();
    std::fs::create_dir(sandbox.path("bin")).expect("a folder");
    let program = sandbox.path("bin/tracer");
    std::os::unix::fs::symlink(env!("CARGO_BIN_EXE_tracer"), program).expect("a link");
    let scene = sandbox.text("scene.ron").replace("samples: 2", "samples: 32");
    sandbox.write("scene.ron", scene);
    render(&sandbox, &["-o", "one.exr"]);
    let shell = |line: &str| sandbox.shell(&format!("set -eu; PATH=\"$PWD/bin:$PATH\"; export PATH\n{line}")).ends(0);
    shell(&block("## By hand"));
    assert_eq!(sandbox.read("scene.exr"), sandbox.read("one.exr"));
    // The array's tasks, as Slurm and Kubernetes would start them.
    for (title, task) in [("### `parts.sbatch`", "SLURM_ARRAY_TASK_ID"), ("### The task", "JOB_COMPLETION_INDEX")] {
        let sandbox_files: Vec<String> = sandbox.files().into_iter().filter(|name| name.ends_with(".tracer")).collect();
        sandbox_files.iter().for_each(|name| std::fs::remove_file(sandbox.path(name)).expect("a file"));
        sandbox.write("task.sh", block(title));
        let first = u32::from(title.contains("sbatch"));
        for k in 0..16 {
            shell(&format!("{task}={} sh task.sh scene.ron", k + first));
        }
        shell("rm scene.exr; tracer merge scene.*of16.tracer -o scene.exr");
        assert_eq!(sandbox.read("scene.exr"), sandbox.read("one.exr"), "{title}");
    }
}
