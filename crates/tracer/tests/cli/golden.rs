//! `tracer golden`, as a person and a CI run it.

use crate::support::{Ran, SCENE, Sandbox, repository};
use serde_json::Value;

/// A folder `golden` with two scenes, 40x24 pixels at 32 samples, their pictures accepted.
fn accepted() -> Sandbox {
    let sandbox = fresh();
    sandbox.run(&["golden", "run", "golden"]).ends(1);
    accept(&sandbox, &["--all-failed"]).ends(0);
    sandbox
}

fn fresh() -> Sandbox {
    let sandbox = Sandbox::new();
    std::fs::create_dir_all(sandbox.path("golden/room")).expect("folders");
    sandbox.write("golden/plain.ron", SCENE);
    sandbox.write("golden/room/lamp.ron", SCENE.replace("radiance: 20", "radiance: 30"));
    let ran = sandbox.run(&["golden", "new", "golden", "--samples", "32"]).ends(0);
    ran.says(&["golden/golden.toml", "tracer golden run golden", "--all-failed"]);
    sandbox
}

fn accept(sandbox: &Sandbox, names: &[&str]) -> Ran {
    sandbox.run(&[&["golden", "accept", "golden", "--reason", "looked at"], names].concat())
}

fn run(sandbox: &Sandbox) -> Ran {
    sandbox.run(&["golden", "run", "golden"])
}

#[test]
fn from_nothing_to_a_pass() {
    let sandbox = fresh();
    let ran = run(&sandbox).ends(1).says(&["look at golden/.golden/index.html"]);
    let out = ran.out_text();
    assert!(out.contains("FAIL  golden/plain: there is no expected picture"), "{out}");
    assert!(out.contains("tracer golden accept golden room/lamp --reason"), "{out}");
    assert!(out.ends_with("0 passed, 2 failed\n"), "{out}");
    assert!(!sandbox.files().contains(&"golden/plain.png".to_owned()));
    sandbox.run(&["golden", "accept", "golden", "plain"]).ends(2).says(&["--reason"]);
    sandbox.run(&["golden", "accept", "golden", "plain", "--reason", " "]).ends(2).says(&["say why"]);
    let out = accept(&sandbox, &["plain", "room/lamp"]).ends(0).out_text();
    assert_eq!(out, "golden/plain: new\ngolden/room/lamp: new\n");
    let out = run(&sandbox).ends(0).silent().out_text();
    assert!(out.contains("ok    golden/plain: equal (") && out.ends_with("2 passed, 0 failed\n"), "{out}");
    // A document on standard output is alone there.
    let json = sandbox.run(&["golden", "run", "golden", "--json", "-"]).ends(0).says(&["ok    golden/plain"]);
    assert!(serde_json::from_slice::<serde_json::Value>(&json.out_text().into_bytes()).is_ok());
    assert!(!sandbox.files().contains(&"-".to_owned()));
    let log = sandbox.text("golden/log.md");
    assert!(log.starts_with("# Why golden pictures") && log.ends_with("- room/lamp (new): looked at\n"), "{log}");
    // A page of what has passed does not stay, and nothing that was made.
    accept(&sandbox, &["plain"]).ends(2).says(&["no picture waits to be accepted"]);
    accept(&sandbox, &["--all-failed"]).ends(2).says(&["nothing waits"]);
    accept(&sandbox, &["plan"]).ends(2).says(&["did you mean plain?"]);
    // The expected picture is one that other programs read.
    sandbox.run(&["compare", "golden/plain.png", "golden/plain.exr", "--fail-above", "max=0.003"]).ends(0);
}

/// Another seed is noise, another lamp is not.
#[test]
fn noise_passes_and_changes_fail() {
    let sandbox = accepted();
    let settings = sandbox.text("golden/golden.toml");
    sandbox.write("golden/golden.toml", settings.clone() + "seed = 7\n");
    let out = run(&sandbox).ends(0).out_text();
    assert!(out.contains("ok    golden/plain: other bytes, within the noise of both pictures"), "{out}");
    assert!(out.contains("; FLIP mean 0.") && out.ends_with("2 passed (2 within noise), 0 failed\n"), "{out}");
    sandbox.write("golden/golden.toml", &settings);
    let scene = sandbox.text("golden/plain.ron");
    // By so much less that regions tell it, and no pixel for itself.
    sandbox.write("golden/plain.ron", scene.replace("radiance: 20", "radiance: 17"));
    let before = [sandbox.read("golden/plain.png"), sandbox.read("golden/plain.exr")];
    let out = run(&sandbox).ends(1).out_text();
    assert!(out.contains("FAIL  golden/plain: ") && out.contains(" pixels differ, by up to "), "{out}");
    assert!(out.contains("light by -") && out.contains("ok    golden/room/lamp"), "{out}");
    assert_eq!(before, [sandbox.read("golden/plain.png"), sandbox.read("golden/plain.exr")], "a run changes nothing");
    // What was made of another scene is not accepted.
    sandbox.write("golden/plain.ron", scene.replace("radiance: 20", "radiance: 16"));
    accept(&sandbox, &["plain"]).ends(2).says(&["have changed since", "tracer golden run golden --only plain"]);
    sandbox.write("golden/plain.ron", scene.replace("radiance: 20", "radiance: 17"));
    let out = accept(&sandbox, &["plain"]).ends(0).out_text();
    assert_eq!(out, "golden/plain: changed\n");
    run(&sandbox).ends(0);
    // The same light through another tone map.
    sandbox.write("golden/golden.toml", settings + "set = [\"effects.tone_map=Filmic\"]\n");
    let out = run(&sandbox).ends(1).out_text();
    assert!(out.contains("it is developed by exposure 0, tone map Filmic"), "{out}");
}

#[test]
fn what_is_wrong_fails() {
    let sandbox = accepted();
    sandbox.write("golden/plain.ron", "Scene(objects: [Sphere(radius: -1)])");
    std::fs::rename(sandbox.path("golden/room/lamp.ron"), sandbox.path("golden/room/other.ron")).expect("renamed");
    let out = run(&sandbox).ends(1).out_text();
    assert!(out.contains("FAIL  golden/plain: error[E"), "{out}");
    assert!(out.contains("golden/plain.ron:1:"), "{out}");
    assert!(out.contains("FAIL  golden/room/other: there is no expected picture"), "{out}");
    for picture in ["png", "exr"] {
        assert!(out.contains(&format!("FAIL  golden/room/lamp.{picture}: this picture belongs to no scene")), "{out}");
    }
    assert!(out.ends_with("0 passed, 4 failed\n"), "{out}");
    // One alone: others' pictures are nobody's business then.
    let ran = sandbox.run(&["golden", "run", "golden", "--only", "plain"]).ends(1).out_text();
    assert!(ran.ends_with("0 passed, 1 failed\n"), "{ran}");
    sandbox.run(&["golden", "run", "golden", "--only", "plane"]).ends(2).says(&["did you mean plain?"]);
    sandbox.write("golden/room/lamp.ron", SCENE);
    sandbox.write("golden/room/lamp.png", "no picture");
    let out = sandbox.run(&["golden", "run", "golden", "--only", "room/lamp"]).ends(1).out_text();
    assert!(out.contains("the expected picture golden/room/lamp.png cannot be read"), "{out}");
}

#[test]
fn what_is_no_folder() {
    let sandbox = Sandbox::new();
    sandbox.run(&["golden", "run", "nowhere"]).ends(2).says(&["there is no folder nowhere", "tracer golden new"]);
    std::fs::create_dir(sandbox.path("some")).expect("a folder");
    sandbox.run(&["golden", "run", "some"]).ends(2).says(&["it has no golden.toml", "tracer golden new some"]);
    let ran = sandbox.run(&["golden", "run", "scene.ron"]).ends(2);
    ran.says(&["scene.ron is a file, and a folder is expected; name one that `tracer golden new` has made"]);
    sandbox.run(&["golden", "run", "scene.ron/x"]).ends(2).says(&["there is no folder scene.ron/x"]);
    sandbox.write("some/golden.toml", "# As others\nsamles = 3\n");
    let ran = sandbox.run(&["golden", "run", "some"]).ends(2);
    ran.says(&["error: some/golden.toml:2:1: there is no setting `samles`; did you mean `samples`?\n"]);
    sandbox.write("some/golden.toml", "");
    sandbox.run(&["golden", "run", "some"]).ends(2).says(&["there is no scene in some"]);
    sandbox.run(&["golden", "new", "some"]).ends(2).says(&["some/golden.toml is there already"]);
    let ran = sandbox.run(&["golden", "new", "scene.ron"]).ends(2);
    assert!(
        ran.err.contains("tracer golden new golden --scene scene.ron") && !ran.err.contains("os error"),
        "{}",
        ran.err
    );
    sandbox.run(&["golden", "new", "other", "--scene", "no.ron"]).ends(2).says(&["there is no scene file no.ron"]);
    assert!(!sandbox.path("other").exists());
    sandbox.run(&["golden", "new", "other", "--size", "0x3"]).ends(2).says(&["640x480"]);
}

/// Settings of a scene that there is not are a slip, which would leave the one that is meant without them.
#[test]
fn settings_of_no_scene_are_told() {
    let sandbox = fresh();
    let with = |name: &str| {
        sandbox.write("golden/golden.toml", format!("size = [8, 8]\nsamples = 2\n[scene.\"{name}\"]\nseed = 3\n"));
        sandbox.run(&["golden", "run", "golden"])
    };
    with("plan").ends(2).says(&["golden/golden.toml: scene.\"plan\": there is no scene", "did you mean plain?"]);
    with("lamp").ends(2).says(&["scene.\"lamp\": there is no scene", "path from the folder"]);
    accept(&sandbox, &["plain"]).ends(2).says(&["scene.\"lamp\": there is no scene"]);
    with("room/lamp").ends(1);
    with("plain").ends(1);
}

/// Hosts compare the paths of annotations with those of the repository, letter by letter.
#[test]
fn files_are_told_as_a_host_knows_them() {
    let sandbox = Sandbox::new();
    let new = ["golden", "new", "golden", "--samples", "1", "--size", "8x8"];
    sandbox.run(&[&new[..], &["--scene", "scene.ron"]].concat()).ends(0);
    let outputs = ["--junit", "a.xml", "--json", "a.json", "--github"];
    let out = sandbox.run(&[&["golden", "run", "./golden"], &outputs[..]].concat()).ends(1).out_text();
    assert!(out.contains("::error file=scene.ron,title="), "{out}");
    assert!(sandbox.text("a.xml").contains(" file=\"scene.ron\""), "{}", sandbox.text("a.xml"));
    let report: Value = serde_json::from_slice(&sandbox.read("a.json")).expect("JSON");
    assert_eq!(report["scenes"][0]["file"], "scene.ron");
    // A file in the folder stands where the folder should.
    sandbox.write("golden/b.ron", SCENE);
    sandbox.run(&["golden", "run", "golden/b.ron"]).ends(2).says(&["is a file", "name its folder, golden\n"]);
}

/// Scenes stay where they are; their settings are those of the folder.
#[test]
fn scenes_elsewhere() {
    let sandbox = Sandbox::new();
    let sets = ["--size", "20x12", "--samples", "24", "--seed", "3", "--set", "render.max_bounces=2"];
    sandbox.run(&[&["golden", "new", "deep/golden", "--scene", "scene.ron"], &sets[..]].concat()).ends(0);
    let text = sandbox.text("deep/golden/golden.toml");
    for line in ["scenes = [\"../../scene.ron\"]", "size = [20, 12]", "seed = 3", "set = [\"render.max_bounces=2\"]"] {
        assert!(text.contains(line), "{line}: {text}");
    }
    sandbox.run(&["golden", "run", "deep/golden"]).ends(1);
    sandbox.run(&["golden", "accept", "deep/golden", "scene", "--reason", "first"]).ends(0);
    sandbox.run(&["golden", "run", "deep/golden"]).ends(0);
    let render = ["render", "scene.ron", "-o", "a.png"];
    sandbox.run(&[&render[..], &sets[..]].concat()).ends(0);
    sandbox.run(&["compare", "a.png", "deep/golden/scene.png", "--fail-above", "max=0"]).ends(0);
}

/// Of scenes with several cameras one is chosen for all of the folder, or for each.
#[test]
fn cameras_are_chosen() {
    let sandbox = Sandbox::new();
    let near = "\"near\": Camera(position: (0, 0, 3), look_at: (0, 0, 0))";
    let far = "\"far\": Camera(position: (0, 0, 9), look_at: (0, 0, 0))";
    let rest = "background: (0.2, 0.4, 0.8), image: Image(width: 16, height: 12), render: Render(samples: 2), \
                objects: [Sphere(center: (0, 0, 0), radius: 1)]";
    sandbox.write("room.ron", format!("Scene(cameras: {{ {near}, {far} }}, {rest})"));
    let new = ["golden", "new", "golden", "--bytes", "--scene", "room.ron"];
    sandbox.run(&[&new[..], &["--camera", "far"]].concat()).ends(0);
    assert!(sandbox.text("golden/golden.toml").contains("\ncamera = \"far\"\n"));
    sandbox.run(&["golden", "run", "golden"]).ends(1);
    sandbox.run(&["golden", "accept", "golden", "room", "--reason", "first"]).ends(0);
    for camera in ["near", "far"] {
        sandbox.run(&["render", "room.ron", "--camera", camera, "-o", &format!("{camera}.png")]).ends(0);
    }
    sandbox.run(&["compare", "far.png", "golden/room.png", "--fail-above", "max=0"]).ends(0);
    sandbox.run(&["compare", "far.png", "near.png", "--fail-above", "max=0"]).ends(1);
    // One scene's own goes before that of all.
    let text = sandbox.text("golden/golden.toml");
    sandbox.write("golden/golden.toml", format!("{text}[scene.room]\ncamera = \"near\"\n"));
    sandbox.run(&["golden", "run", "golden"]).ends(1);
    // None: what is said is how it is written here.
    sandbox.write("golden/golden.toml", text.replace("camera = \"far\"\n", ""));
    let out = sandbox.run(&["golden", "run", "golden"]).ends(1).out_text();
    assert!(out.contains("here one is chosen in golden.toml: `camera = \"near\"`"), "{out}");
    sandbox.write("golden/golden.toml", text.replace("far", "fur"));
    let out = sandbox.run(&["golden", "run", "golden"]).ends(1).out_text();
    assert!(out.contains("there is no camera \"fur\""), "{out}");
}

/// Without noise every byte counts, or FLIP where the folder says so much is allowed.
#[test]
fn bytes_alone() {
    let sandbox = fresh();
    sandbox.write("golden/golden.toml", "samples = 32\nnoise = false\n");
    run(&sandbox).ends(1);
    accept(&sandbox, &["--all-failed"]).ends(0);
    assert!(!sandbox.path("golden/plain.exr").exists());
    run(&sandbox).ends(0);
    sandbox.write("golden/golden.toml", "samples = 32\nnoise = false\nseed = 7\n");
    let out = run(&sandbox).ends(1).out_text();
    assert!(out.contains(" pixels differ") && out.contains("FLIP mean"), "{out}");
    sandbox.write("golden/golden.toml", "samples = 32\nnoise = false\nseed = 7\nflip = 0.2\n");
    let out = run(&sandbox).ends(0).out_text();
    assert!(out.contains("other bytes, within flip = 0.2"), "{out}");
    // Pictures from before noise was kept.
    sandbox.write("golden/golden.toml", "samples = 32\nseed = 7\n");
    let out = run(&sandbox).ends(1).out_text();
    assert!(out.contains("no noise is kept of the expected picture"), "{out}");
}

/// Too few samples do not know their noise: that is said, and bytes count.
#[test]
fn few_samples() {
    let sandbox = fresh();
    sandbox.write("golden/golden.toml", "samples = 4\n");
    run(&sandbox).ends(1);
    accept(&sandbox, &["--all-failed"]).ends(0);
    run(&sandbox).ends(0);
    sandbox.write("golden/golden.toml", "samples = 4\nseed = 1\n");
    let out = run(&sandbox).ends(1).out_text();
    assert!(out.contains("4 samples are too few to know the noise; 32 are enough"), "{out}");
}

/// Nothing that a scene reads is ever replaced.
#[test]
fn files_of_scenes_are_spared() {
    let sandbox = fresh();
    sandbox.run(&["render", "scene.ron", "-o", "golden/plain.png"]).ends(0);
    let texture = sandbox.read("golden/plain.png");
    let wood = "Diffuse(albedo: Texture(file: \"../plain.png\"))";
    sandbox.write("golden/room/lamp.ron", SCENE.replace("radius: 100)", &format!("radius: 100, material: {wood})")));
    // It is no expected picture of `plain`, and is taken for one all the same.
    run(&sandbox).ends(1);
    accept(&sandbox, &["plain"]).ends(2).says(&["golden/plain.png is read by a scene and is not replaced"]);
    assert_eq!(sandbox.read("golden/plain.png"), texture);
    for (option, file) in [
        ("--json", "golden/plain.ron"),
        ("--html", "golden/plain.png"),
        ("--junit", "golden/golden.toml"),
        ("--html", "golden/room/lamp.ron"),
    ] {
        let before = sandbox.read(file);
        let ran = sandbox.run(&["golden", "run", "golden", option, file]).ends(2);
        ran.says(&[option, "would replace a file of the scenes"]);
        assert_eq!(sandbox.read(file), before);
    }
    // Also what a scene reads that is not run, or that is wrong.
    sandbox.write("leaf.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let leaf = SCENE.replace("objects: [", "objects: [Mesh(file: \"../leaf.obj\"), ");
    for text in [leaf.clone(), leaf.trim_end().trim_end_matches(')').to_owned()] {
        sandbox.write("golden/leaf.ron", text);
        for only in [&["--only", "plain"][..], &[]] {
            let line = [&["golden", "run", "golden", "--json", "leaf.obj"], only].concat();
            sandbox.run(&line).ends(2).says(&["--json", "leaf.obj"]);
        }
    }
    let twice = ["golden", "run", "golden", "--json", "a.txt", "--junit", "./a.txt"];
    sandbox.run(&twice).ends(2).says(&["both name"]);
}

#[test]
fn outputs_for_programs() {
    let sandbox = accepted();
    let scene = sandbox.text("golden/plain.ron");
    sandbox.write("golden/plain.ron", scene.replace("radiance: 20", "radiance: 15"));
    let outputs = ["--junit", "a.xml", "--json", "a.json", "--html", "a.html"];
    let ran = sandbox.run(&[&["golden", "run", "golden"], &outputs[..], &["--github"]].concat()).ends(1);
    assert!(
        ran.out_text().contains("\n::error file=golden/plain.ron,title=golden golden/plain::"),
        "{}",
        ran.out_text()
    );
    let report: Value = serde_json::from_slice(&sandbox.read("a.json")).expect("JSON");
    assert_eq!((&report["passed"], &report["failed"]), (&1.into(), &1.into()));
    assert_eq!(report["scenes"][0]["verdict"], "different");
    assert!(report["scenes"][0]["probability"].as_f64().is_some_and(|p| p < 1e-3));
    assert!(
        sandbox.text("a.xml").contains("<testsuites name=\"tracer golden\" tests=\"2\" failures=\"1\" errors=\"0\"")
    );
    let page = sandbox.text("a.html");
    assert!(page.contains("1 failed, 1 passed") && page.matches("<img ").count() == 6, "{}", page.len());
    assert_eq!(page, sandbox.text("golden/.golden/index.html"));
    assert_eq!(sandbox.text("golden/.golden/.gitignore"), "*\n");
    // In a runner of GitHub's the annotations come without being asked for.
    let mut command = sandbox.command(&["golden", "run", "golden"]);
    assert!(Ran::of(command.env("GITHUB_ACTIONS", "true")).ends(1).out_text().contains("::error file="));
}

/// The commands of docs/golden.md, one after the other in one folder, as a person and as its workflow run them; its
/// settings and its workflow are read.
#[test]
fn the_page_of_the_manual() {
    let page = std::fs::read_to_string(repository().join("docs/golden.md")).expect("the page");
    let sandbox = Sandbox::new();
    sandbox.write("room.ron", SCENE);
    let mut commands = 0;
    for block in page.split("\n```").skip(1).step_by(2) {
        let (kind, text) = block.split_once('\n').expect("a block");
        match kind {
            "sh" => {
                for line in text.lines().filter(|line| line.starts_with("tracer ")) {
                    let (line, code) = line.split_once("  # exit code ").unwrap_or((line, "0"));
                    let line = line.replacen("tracer", "\"$T\"", 1);
                    sandbox.shell(&line).ends(code.trim().parse().expect("an exit code"));
                    commands += 1;
                }
            }
            "toml" => assert!(tracer_golden::settings::Settings::parse(text, &|_, _| None).is_ok(), "{text}"),
            "yaml" => {
                let run = text.lines().find_map(|line| line.trim().strip_prefix("- run: tracer ")).expect("a step");
                sandbox.shell(&format!("\"$T\" {run}")).ends(0);
                for file in ["golden.xml", "golden.html"] {
                    assert!(text.contains(file) && !sandbox.read(file).is_empty(), "{file}");
                }
                commands += 1;
            }
            other => panic!("a block in `{other}`"),
        }
    }
    assert!(commands >= 6, "{commands}");
}
