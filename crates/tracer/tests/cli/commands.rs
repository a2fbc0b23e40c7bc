//! The small commands, and help.

use crate::support::{Ran, SCENE, Sandbox, repository};
use serde_json::Value;

pub const COMMANDS: [&str; 21] = [
    "render",
    "preview",
    "merge",
    "farm",
    "check",
    "info",
    "inspect",
    "marks",
    "convert",
    "fmt",
    "new",
    "repro",
    "compare",
    "golden",
    "bench-acceleration",
    "bench-figures",
    "explain",
    "lsp",
    "schema",
    "completions",
    "man",
];

#[test]
fn version_and_help() {
    let sandbox = Sandbox::new();
    let version = sandbox.run(&["--version"]).ends(0).silent().out_text();
    // A release that is built in a clone says of which commit.
    let rest = version.strip_prefix(concat!("tracer ", env!("CARGO_PKG_VERSION"))).expect("the version");
    assert!(rest == "\n" || rest.starts_with(" (") && rest.ends_with(")\n"), "{version}");
    let of_golden = ["run", "accept", "new"].map(|command| vec!["golden", command, "-h"]);
    let of_farm = ["slurm", "status", "cancel"].map(|command| vec!["farm", command, "-h"]);
    let of_all = COMMANDS.map(|command| vec![command, "-h"]).into_iter().chain([vec!["-h"]]);
    for arguments in of_all.chain(of_golden).chain(of_farm) {
        let help = Ran::of(sandbox.command(&arguments).env("COLUMNS", "80")).ends(0).silent().out_text();
        assert!(help.lines().count() <= 24, "{arguments:?} does not fit a screen:\n{help}");
        assert!(help.lines().all(|line| line.chars().count() <= 80), "{arguments:?} is too wide:\n{help}");
        let examples = help.lines().skip_while(|line| *line != "Examples:").skip(1);
        assert_eq!(examples.take_while(|line| line.starts_with("  tracer ")).count(), 2, "{arguments:?}:\n{help}");
        // Every line of the options has the option and what it does: none is broken in two.
        let options = help.lines().filter(|line| line.trim_start().starts_with('-'));
        for option in options {
            assert!(option.trim_start().contains("  "), "{arguments:?}: `{option}` is not explained beside it\n{help}");
        }
    }
    assert!(sandbox.run(&["--help"]).out_text().contains("130 interrupted"));
}

#[test]
fn check_says_what_is_there() {
    let sandbox = Sandbox::new();
    let ran = sandbox.run(&["check", "scene.ron"]).ends(0).silent();
    assert_eq!(ran.out_text(), "scene.ron: ok, 3 objects, 1 light\n");
    let ran = sandbox.run(&["check", "scene.ron", "--diagnostics", "json"]).ends(0).silent();
    assert_eq!(ran.out_text(), "");
}

/// Files and folders, all of them in one run.
#[test]
fn check_takes_many_scenes() {
    let sandbox = Sandbox::new();
    std::fs::create_dir_all(sandbox.path("scenes/deep")).expect("folders");
    std::fs::create_dir(sandbox.path("empty")).expect("a folder");
    sandbox.write("scenes/a.ron", SCENE);
    sandbox.write("scenes/deep/b.toml", "background = 1\n[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 }\n");
    sandbox.write("scenes/Cargo.toml", "[package]\nname = 1\n");
    sandbox.write("scenes/report.json", "{ \"scene\": { \"objects\": 3 } }");
    let ran = sandbox.run(&["check", "scene.ron", "scenes"]).ends(0).silent().out_text();
    assert_eq!(ran.lines().count(), 3, "{ran}");
    sandbox.write("scenes/wrong.ron", "Scene(");
    let ran = sandbox.run(&["check", "scenes", "scene.ron"]).ends(2).says(&["wrong.ron", "1 of 4 scenes are wrong"]);
    assert_eq!(ran.out_text().lines().count(), 3);
    sandbox.run(&["check", "empty"]).ends(2).says(&["there is no scene in the folder empty"]);
    sandbox.write("odd.ron", SCENE.replace("materials: {", "materials: { \"spare\": Diffuse(albedo: 0.5),"));
    sandbox.run(&["check", "odd.ron"]).ends(0).says(&["W0401"]);
    sandbox.run(&["check", "odd.ron", "--deny-warnings"]).ends(2).says(&["1 warning, denied by --deny-warnings"]);
    sandbox.run(&["check", "scene.ron", "--deny-warnings"]).ends(0).silent();
}

/// Warnings that somebody has weighed are said no more, and deny nothing.
#[test]
fn warnings_are_allowed_by_their_codes() {
    let sandbox = Sandbox::new();
    let spare = SCENE.replace("materials: {", "materials: { \"spare\": Diffuse(albedo: 0.5),");
    sandbox.write("odd.ron", spare);
    let all = sandbox.run(&["check", "odd.ron"]).ends(0).says(&["W0401"]);
    assert!(all.out_text().contains("ok"));
    let strict = ["check", "odd.ron", "--deny-warnings", "--allow", "W0401"];
    sandbox.run(&strict).ends(0).silent();
    sandbox.run(&["render", "odd.ron", "-o", "a.png", "--samples", "1", "--allow=W0401", "--quiet"]).ends(0).silent();
    sandbox.run(&["check", "odd.ron", "--allow", "W0305"]).ends(0).says(&["W0401"]);
    sandbox.run(&["check", "odd.ron", "--allow", "E0401"]).ends(2).says(&["E0401", "warnings begin with W"]);
    sandbox.run(&["check", "odd.ron", "--allow", "W9"]).ends(2).says(&["there is no such code", "tracer explain"]);
    // Quiet, it tells by its exit code alone, and errors.
    let quiet = sandbox.run(&["check", "odd.ron", "-q"]).ends(0).silent();
    assert_eq!(quiet.out_text(), "");
    let denied = sandbox.run(&["check", "odd.ron", "-q", "--deny-warnings"]).ends(2);
    denied.says(&["W0401", "denied by --deny-warnings"]);
    let added = sandbox.run(&["check", "scene.ron", "--set", "camera.fov+=5"]).ends(2);
    added.says(&["E0404", "`+=`", "--set vars.name=2"]);
}

/// Whoever asks for records gets nothing else, whatever fails.
#[test]
fn failures_of_no_scene_are_records_too() {
    let sandbox = Sandbox::new();
    sandbox.write("odd.ron", SCENE.replace("materials: {", "materials: { \"spare\": Diffuse(albedo: 0.5),"));
    sandbox.write("wrong.ron", "Scene(");
    for arguments in [
        &["check", "none.ron", "--diagnostics", "json"][..],
        &["check", "odd.ron", "wrong.ron", "none.ron", "--diagnostics", "json"],
        &["render", "scene.ron", "-o", "none/a.png", "--samples", "1", "--diagnostics", "json", "--quiet"],
        &["info", "none.ron", "--diagnostics", "json"],
    ] {
        let ran = sandbox.run(arguments);
        assert!(ran.code != Some(0) && !ran.err.is_empty());
        let is_record =
            |line: &str| serde_json::from_str::<serde_json::Value>(line).is_ok_and(|it| it["severity"] != "");
        assert!(ran.err.lines().all(is_record), "{arguments:?}: {}", ran.err);
    }
}

/// What a pipe has it gives once, so nobody looks into it before it is read.
#[cfg(unix)]
#[test]
fn scenes_come_through_pipes() {
    let sandbox = Sandbox::new();
    for command in ["check", "info", "fmt --check", "convert --to json -o -", "render -o a.png --samples 1 --quiet"] {
        let (name, rest) = command.split_once(' ').unwrap_or((command, ""));
        let ran = sandbox.shell(&format!("cat scene.ron | \"$T\" {name} /dev/stdin {rest}"));
        assert!(!ran.err.contains("error"), "{command}: {}", ran.err);
        let fifo = format!("rm -f p.ron; mkfifo p.ron; cat scene.ron > p.ron & \"$T\" {name} p.ron {rest}");
        let ran = sandbox.shell(&fifo);
        assert!(!ran.err.contains("error"), "{command}: {}", ran.err);
    }
}

/// The views of all of a scene's cameras can be looked through, one after the other.
#[test]
fn check_looks_through_the_camera_that_is_named() {
    let sandbox = Sandbox::new();
    let cameras = "cameras: { \"front\": Camera(position: (0, 0, 5), look_at: (0, 0, 0)), \
                   \"away\": Camera(position: (0, 0, 5), look_at: (0, 0, 9)) },";
    let objects = "objects: [Sphere(center: (0, 0, 0), radius: 1)], background: 1";
    sandbox.write("two.ron", format!("Scene({cameras} {objects})"));
    let front = sandbox.run(&["check", "two.ron", "--camera", "front"]).ends(0).silent();
    assert!(!front.out_text().contains("none is chosen"), "{}", front.out_text());
    sandbox.run(&["check", "two.ron", "--camera", "away"]).ends(0).says(&["W0309"]);
    sandbox.run(&["check", "two.ron", "--camera", "back"]).ends(2).says(&["front"]);
}

#[test]
fn help_is_a_command_too() {
    let sandbox = Sandbox::new();
    let help = |arguments: &[&str]| sandbox.run(arguments).ends(0).silent().out_text();
    assert_eq!(help(&["help"]), help(&["--help"]));
    assert_eq!(help(&["help", "render"]), help(&["render", "--help"]));
    let render = help(&["render", "--help"]);
    // All of it, under headings, with what holds where nothing is written; `-h` is a screen.
    let short = help(&["render", "-h"]);
    for option in ["--checkpoint", "--crop", "--layers", "--report", "--seed", "--syntax", "--cache-size", "--stats"] {
        assert!(render.contains(option) && !short.contains(&format!("  {option}")), "{option}: {render}");
    }
    for word in ["Picture:", "Parts and checkpoints:", "[default: the scene's `image`]", "[default: text]"] {
        assert!(render.contains(word), "{word}: {render}");
    }
    let all = help(&["--help"]);
    assert!(COMMANDS.iter().all(|command| all.contains(&format!("\n  {command} "))), "{all}");
    for word in ["<SCENE>", "--color", "--verbose"] {
        assert!(render.contains(word), "{word}: {render}");
    }
}

#[test]
fn info_counts() {
    let sandbox = Sandbox::new();
    let cat = repository().join("assets/cat.obj");
    let placements = "[Translate((1, 0, 0))], [Translate((4, 0, 0))]";
    sandbox.write(
        "cat.ron",
        SCENE.replace(
            "    objects: [",
            &format!("    objects: [ Mesh(file: {cat:?}, placements: [{placements}], instances: Always),"),
        ),
    );
    let json: Value =
        serde_json::from_str(&sandbox.run(&["info", "cat.ron", "--json"]).ends(0).out_text()).expect("JSON");
    let number = |path: &str| json.pointer(path).and_then(Value::as_u64).unwrap_or_else(|| panic!("{path}"));
    assert_eq!((number("/objects/total"), number("/objects/spheres"), number("/objects/meshes")), (4, 3, 1));
    assert_eq!((number("/meshes"), number("/instances"), number("/lights")), (1, 2, 1));
    assert_eq!(number("/placed_triangles"), 2 * number("/triangles"));
    assert!(number("/tree/nodes") > 0 && number("/memory/geometry") > 0 && number("/memory/film") > 0);
    assert_eq!(json["files"], serde_json::json!([cat]));
    assert_eq!(json["bounds"]["min"], serde_json::json!([-100.0, -200.0, -100.0]));
    assert_eq!(json["material_names"][0], "glass");
    let text = sandbox.run(&["info", "scene.ron"]).ends(0).out_text();
    for word in ["40x24", "3 spheres", "\"glass\"", "2 samples", "none needed"] {
        assert!(text.contains(word), "{word}:\n{text}");
    }
}

#[test]
fn every_default_can_be_seen_and_rendered() {
    let sandbox = Sandbox::new();
    let resolved = sandbox.run(&["info", "scene.ron", "--resolved", "--set", "camera.fov=50"]).ends(0).silent();
    let text = resolved.out_text();
    for word in ["up: (0, 1, 0)", "seed: 0", "tone_map: None", "fov: 50"] {
        assert!(text.contains(word), "{word}:\n{text}");
    }
    sandbox.write("resolved.ron", &text);
    sandbox.run(&["render", "resolved.ron", "-o", "a.pfm"]).ends(0);
    sandbox.run(&["render", "scene.ron", "-o", "b.pfm", "--set", "camera.fov=50"]).ends(0);
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
}

#[test]
fn convert_goes_to_json_and_back() {
    let sandbox = Sandbox::new();
    sandbox.run(&["convert", "scene.ron", "-o", "scene.json"]).ends(0).says(&["JSON has no comments", "left out"]);
    sandbox.run(&["check", "scene.json", "--deny-warnings"]).ends(0).silent();
    sandbox.run(&["fmt", "scene.json", "--check"]).ends(0).silent();
    // RON is what comes of it when nothing else is asked for, and it is told by its looks.
    let back = sandbox.shell(r#""$T" convert - < scene.json"#).ends(0).silent().out_text();
    assert!(back.starts_with("Scene("), "{back}");
    sandbox.run(&["convert", "scene.json", "-o", "scene.toml"]).ends(0).silent();
    for scene in ["scene.ron", "scene.json", "scene.toml"] {
        sandbox.run(&["render", scene, "-o", &format!("{scene}.pfm")]).ends(0);
    }
    assert_eq!(sandbox.read("scene.json.pfm"), sandbox.read("scene.ron.pfm"));
    assert_eq!(sandbox.read("scene.toml.pfm"), sandbox.read("scene.ron.pfm"));
    sandbox.write("bad.json", "{ \"objects\": [{ \"Sphere\": { \"radius\": -1, } }] }");
    let ran = sandbox.run(&["check", "bad.json"]).ends(2);
    ran.says(&["bad.json:1:", "JSON has no comma before `}`"]);
}

#[test]
fn convert_goes_both_ways() {
    let sandbox = Sandbox::new();
    sandbox.run(&["convert", "scene.ron", "-o", "scene.toml"]).ends(0).silent();
    assert!(sandbox.text("scene.toml").contains("# small"));
    let back = sandbox.run(&["convert", "scene.toml"]).ends(0).silent().out_text();
    assert!(back.contains("// small"), "{back}");
    sandbox.write("back.ron", back);
    let hash = |scene: &str| {
        let json: Value =
            serde_json::from_str(&sandbox.run(&["info", scene, "--json"]).ends(0).out_text()).expect("JSON");
        json["hash"].clone()
    };
    assert_eq!(hash("scene.ron"), hash("scene.toml"));
    assert_eq!(hash("scene.ron"), hash("back.ron"));
    sandbox.run(&["convert", "scene.ron", "-o", "x.txt"]).ends(2).says(&[".ron, .toml or .json"]);
    sandbox.run(&["convert", "scene.ron", "-o", "x.toml", "--to", "ron"]).ends(2).says(&["--to"]);
    sandbox.write("bad.ron", "Scene(objects: [Sphere(radius: -1)])");
    sandbox.run(&["convert", "bad.ron", "-o", "bad.toml"]).ends(2).says(&["bad.ron:1:"]);
    sandbox.write("bytes.ron", b"Scene(\xff)");
    sandbox.run(&["convert", "bytes.ron"]).ends(2).says(&["UTF-8"]);
    assert!(!sandbox.files().contains(&"bad.toml".to_owned()));
}

/// A path starts from the scene's folder: whoever converts into another one is told, but only where the scene names
/// such a path.
#[test]
fn convert_warns_of_paths_that_move() {
    let sandbox = Sandbox::new();
    std::fs::create_dir(sandbox.path("elsewhere")).expect("a folder");
    sandbox.run(&["convert", "scene.ron", "-o", "elsewhere/plain.toml"]).ends(0).silent();
    sandbox.write("mesh.ron", "Scene(objects: [Mesh(file: \"cube.obj\")])");
    sandbox.run(&["convert", "mesh.ron", "-o", "mesh.toml"]).ends(0).silent();
    sandbox.run(&["convert", "mesh.ron", "-o", "elsewhere/mesh.toml"]).ends(0).says(&["warning: paths in a scene"]);
    sandbox.write("absolute.ron", "Scene(objects: [Mesh(file: \"/cube.obj\")])");
    sandbox.run(&["convert", "absolute.ron", "-o", "elsewhere/absolute.toml"]).ends(0).silent();
}

#[test]
fn templates_are_right_and_render() {
    let sandbox = Sandbox::new();
    for template in ["ball", "materials", "room"] {
        for name in ["new.ron", "new.toml", "new.json"] {
            sandbox.run(&["new", name, "--template", template, "--force"]).ends(0).says(&["tracer render", name]);
            sandbox.run(&["check", name]).ends(0).silent();
            sandbox.run(&["render", name, "-o", "new.png", "--size", "16x16", "--samples", "1"]).ends(0).silent();
        }
    }
    sandbox.run(&["new", "first.ron"]).ends(0);
    assert!(sandbox.text("first.ron").contains("tracer render first.ron -o first.png"));
    sandbox.write("mine.ron", "mine");
    sandbox.run(&["new", "mine.ron"]).ends(2).says(&["mine.ron is there already", "--force"]);
    assert_eq!(sandbox.text("mine.ron"), "mine");
    sandbox.run(&["new", "scene.txt"]).ends(2).says(&[".ron, .toml or .json"]);
    sandbox.run(&["new", "x.ron", "--template", "castle"]).ends(2).says(&["ball", "materials", "room"]);
    let out = sandbox.run(&["new", "-"]).ends(0).silent().out_text();
    assert!(out.contains("Scene("));
}

#[test]
fn codes_are_explained() {
    let sandbox = Sandbox::new();
    let text = sandbox.run(&["explain", "e0201"]).ends(0).silent().out_text();
    assert!(text.starts_with("E0201: "), "{text}");
    let all = sandbox.run(&["explain"]).ends(0).silent().out_text();
    assert!(all.lines().count() > 20 && all.contains("E0201"));
    assert!(all.contains("`object` lists all shapes"), "{all}");
    for kinds in ["object", "material", "texture", "light", "transform", "layer", "projection"] {
        assert!(all.contains(&format!("`{kinds}`")), "{kinds}: {all}");
        let listed = sandbox.run(&["explain", kinds]).ends(0).silent().out_text();
        assert!(listed.contains("Kinds:\n") || kinds == "light", "{kinds}: {listed}");
    }
    let two = sandbox.run(&["explain", "look", "at"]).ends(0).silent().out_text();
    assert_eq!(two, sandbox.run(&["explain", "look_at"]).ends(0).silent().out_text());
    let apart = sandbox.run(&["explain", "E0606", "Sphere"]).ends(0).silent().out_text();
    assert!(apart.contains("side by side") && apart.contains("\n\nSphere, a kind of Object"), "{apart}");
    let both = sandbox.run(&["explain", "301"]).ends(0).silent().out_text();
    assert!(both.starts_with("E0301: ") && both.contains("\nW0301: "), "{both}");
    let word = sandbox.run(&["explain", "radius"]).ends(0).silent().out_text();
    assert!(word.contains("radius of Sphere: "), "{word}");
    // What is a word of every day is said with nothing about where it does not stand.
    let glass = sandbox.run(&["explain", "glass"]).ends(0).silent().out_text();
    assert_eq!(glass, "glass is called Transparent here: `tracer explain Transparent` tells more\n");
    sandbox.run(&["explain", "radus"]).ends(2).says(&["did you mean radius?"]);
    sandbox.run(&["explain", "E9999"]).ends(2).says(&["E9999", "lists all codes"]);
}

#[test]
fn schema_completions_and_man_pages() {
    let sandbox = Sandbox::new();
    let schema: Value = serde_json::from_str(&sandbox.run(&["schema"]).ends(0).silent().out_text()).expect("JSON");
    assert!(schema["$schema"].as_str().is_some_and(|draft| draft.contains("draft-07")));
    for shell in ["bash", "zsh", "fish", "powershell", "elvish", "nushell"] {
        let script = sandbox.run(&["completions", shell]).ends(0).silent().out_text();
        assert!(COMMANDS.iter().all(|command| script.contains(command)), "{shell}");
    }
    // What can be chosen is offered, and no files where none stand.
    let script = sandbox.run(&["completions", "bash"]).ends(0).silent().out_text();
    let of_render = script.split_once("\n        tracer__subcmd__render)").map_or(&*script, |(_, rest)| rest);
    let after = |option: &str| {
        let from = of_render.find(&format!("{option})")).unwrap_or_else(|| panic!("{option}: {of_render}"));
        of_render[from..].lines().take(9).collect::<String>()
    };
    assert!(after("--layers").contains("albedo normal depth") && after("--bits").contains("8 16"), "{script}");
    assert!(after("--format").contains("png exr") && !after("--samples").contains("compgen -f"), "{script}");
    assert!(after("--report").contains("compgen -f"), "{script}");
    assert!(script.contains("Sphere") && script.contains("E0102"));
    for code in ["E0102", "e0102", "e102", "102"] {
        assert!(sandbox.run(&["explain", code]).ends(0).out_text().starts_with("E0102: "), "{code}");
    }
    let page = sandbox.run(&["man"]).ends(0).silent().out_text();
    let sections = [".TH tracer 1", ".SH EXAMPLES", ".SH \"EXIT STATUS\"", ".SH FILES", ".SH ENVIRONMENT"];
    assert!(sections.iter().all(|section| page.contains(section)) && !page.contains("EXTRA"), "{page}");
    assert!(sandbox.run(&["man", "render"]).ends(0).silent().out_text().contains("\\-\\-samples"));
    // The synopsis says what options take.
    let check = sandbox.run(&["man", "check"]).ends(0).silent().out_text();
    let synopsis = check.lines().skip_while(|line| *line != ".SH SYNOPSIS").nth(1).expect("a line");
    for word in [r"[\fB\-\-set\fR \fIPATH=VALUE\fR]...", r"[\fB\-\-fix\fR]", r"[\fB\-q\fR]", r"\fISCENE\fR..."] {
        assert!(synopsis.contains(word), "{word}: {synopsis}");
    }
    assert!(sandbox.run(&["man", "golden-run"]).ends(0).silent().out_text().contains("\\-\\-junit"));
    sandbox.run(&["man", "nothing"]).ends(2).says(&["nothing", "render"]);
}

/// The figures at the report's settings: its times stand beside those of as many samples only.
#[test]
fn the_table_of_figures() {
    let sandbox = Sandbox::new();
    let scenes = repository().join("scenes");
    let scenes = scenes.to_str().expect("a path");
    let table = |more: &[&str]| {
        sandbox.run(&[&["bench-figures", "--scenes", scenes][..], more].concat()).ends(0).silent().out_text()
    };
    let quick = table(&["4", "8", "--samples", "1"]);
    let lines: Vec<&str> = quick.lines().collect();
    assert_eq!(lines.len(), 3, "{quick}");
    assert!(lines[1].starts_with("4       512x512, 1 samples, 5 bounces") && lines[1].ends_with(" s  -"), "{quick}");
    assert!(lines[2].starts_with("8       256x256, 1 samples, 5 bounces"), "{quick}");
    let third = table(&["3", "--samples", "1000"]);
    assert!(third.contains("3       256x256, 10 samples, 5 bounces") && third.contains("7 s (with a tree)"), "{third}");
    sandbox.run(&["bench-figures", "10"]).ends(2).says(&["10", "1..=9"]);
    sandbox.run(&["bench-figures", "--scenes", "nowhere"]).ends(2).says(&["there is no nowhere/fig1.ron", "--scenes"]);
}

#[test]
fn the_table_of_accelerations() {
    let sandbox = Sandbox::new();
    let cat = repository().join("assets/cat.obj");
    let scene = SCENE.replace("    objects: [", &format!("    objects: [ Mesh(file: {cat:?}),"));
    sandbox.write("fig3.ron", scene);
    let table = sandbox.run(&["bench-acceleration", "fig3.ron"]).ends(0).out_text();
    for word in ["None", "BoundingBox", "Bvh", "167 s", "40 s", "7 s", "the same picture in all three"] {
        assert!(table.contains(word), "{word}:\n{table}");
    }
    // Another scene, or another size, is not the report's figure.
    let table = sandbox.run(&["bench-acceleration", "fig3.ron", "--size", "8x8"]).ends(0).out_text();
    assert!(!table.contains("167 s") && table.contains("the same picture in all three"), "{table}");
}

/// What stands where no more is taken is told with what it was meant for.
#[test]
fn words_too_many_have_a_tip() {
    let sandbox = Sandbox::new();
    for (line, told) in [
        ("convert scene.ron b.toml", "the file to write: -o b.toml"),
        ("render scene.ron b.ron", "one after the other"),
        ("render scene.ron b.png", "the picture to write: -o b.png"),
        ("golden new g --scene scene.ron b.ron", "--scene b.ron"),
        ("info scene.ron b.ron", "info takes one scene at a time"),
        ("render scene.ron --set camera.fov = 20", "without spaces: --set camera.fov=20"),
        ("render scene.ron --set camera.fov=20 render.seed=3", "--set render.seed=3"),
        ("render scene.ron --crop -5,0,20,20", "'--crop"),
        ("render scene.ron --layers depht", "did you mean depth?"),
        ("-v info scene.ron b.ron", "info takes one scene at a time"),
        ("--allow W0302 render scene.ron b.ron", "one after the other"),
        ("render scene.ron --frames -1", "counted from 0, as in 0-47, or all"),
        ("render scene.ron --frames 1,3", "frames apart are rendered one range after the other"),
    ] {
        let words: Vec<&str> = line.split(' ').collect();
        sandbox.run(&words).ends(2).says(&[told]);
    }
    // Options of all commands may stand before the command, or before the scene alone.
    for line in ["-v scene.ron -o a.png", "--color never scene.ron -o a.png", "--allow W0302 check scene.ron"] {
        let words: Vec<&str> = line.split(' ').collect();
        sandbox.run(&words).ends(0);
    }
    assert!(!sandbox.run(&["--color", "never", "help"]).ends(0).out.is_empty());
    let help = sandbox.run(&["render", "--help"]).ends(0).out_text();
    assert!(help.contains("--camera") && help.contains("--frame <N>"), "{help}");
}

/// Where every object is, in the scene and in the picture.
#[test]
fn info_tells_where_objects_are() {
    let sandbox = Sandbox::new();
    let camera = "position: (0, 0, 10), look_at: (0, 0, 0), fov: 90";
    let balls = "Sphere(center: (0, 0, 0), radius: 1, name: \"ball\"), Sphere(center: (0, 0, 12), radius: 1), \
                 Box(center: (-30, 0, 0), size: 2), Box(center: (0, 30, 0), size: 2), \
                 Box(size: 1, placements: Grid(count: (2, 1, 2), spacing: (2, 2, 2))), Plane(point: (0, -1, 0))";
    let scene = |camera: &str| {
        format!(
            "Scene(image: Image(width: 100, height: 100), camera: Camera({camera}), objects: [{balls}], \
             lights: [SphereLight(center: (0, -20, 0), radius: 1, power: 100)])"
        )
    };
    sandbox.write("a.ron", scene(camera));
    let told = sandbox.run(&["info", "a.ron", "--objects"]).ends(0).out_text();
    let expected = [
        "ball                       (-1, -1, -1) to (1, 1, 1)          pixels 44,44 to 55,55",
        "objects[1] Sphere          (-1, -1, 11) to (1, 1, 13)         not in view: behind the camera",
        "objects[2] Box             (-31, -1, -1) to (-29, 1, 1)       not in view: to the left",
        "objects[3] Box             (-1, 29, -1) to (1, 31, 1)         not in view: above",
        "objects[4] Box         x4  (-1.5, -0.5, -1.5) to (1.5, 0.5, 1.5)  pixels 41,47 to 58,52",
    ];
    let squeezed = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    for line in expected {
        assert!(squeezed(&told).contains(&squeezed(line)), "{line}\n{told}");
    }
    assert!(told.contains("objects[5] Plane") && told.contains("without an end\n"), "{told}");
    assert!(told.contains("lights[0] SphereLight") && told.ends_with("not in view: below\n"), "{told}");
    let whole = sandbox.run(&["info", "a.ron"]).ends(0).out_text();
    assert!(whole.contains("no view of 3 of 6: objects[1] Sphere, objects[2] Box, objects[3] Box ("), "{whole}");
    let json: Value =
        serde_json::from_str(&sandbox.run(&["info", "a.ron", "--objects", "--json"]).ends(0).out_text()).expect("JSON");
    assert_eq!(json[0]["object"], "ball");
    assert_eq!(json[0]["bounds"]["max"], serde_json::json!([1.0, 1.0, 1.0]));
    assert_eq!(json[0]["seen"], serde_json::json!({"left": 44, "top": 44, "right": 56, "bottom": 56}));
    assert_eq!([&json[1]["seen"], &json[5]["bounds"]], [&Value::from("behind"), &Value::Null]);
    // From within a ball, with two eyes, and all around.
    for (camera, seen) in [
        ("position: (0.5, 0, 0), look_at: (9, 0, 0)".to_owned(), "in view, and around the camera"),
        (
            "position: (0, 0, 10), look_at: (0, 0, 0), projection: Orthographic(height: 40)".to_owned(),
            "pixels 47,47 to 52,52",
        ),
        ("position: (0, 0, 10), look_at: (0, 0, 0), projection: Panorama".to_owned(), "about pixel 50,50"),
        ("position: (0, 0, -10), look_at: (0, 0, -20), projection: Fisheye(fov: 90)".to_owned(), "not in view"),
    ] {
        sandbox.write("b.ron", scene(&camera));
        let told = sandbox.run(&["info", "b.ron", "--objects"]).ends(0).out_text();
        assert!(squeezed(told.lines().next().expect("a line")).ends_with(seen), "{camera}\n{told}");
    }
    sandbox.run(&["render", "b.ron", "-o", "b.png", "--samples", "1", "--size", "8x8"]).ends(0);
    sandbox.run(&["info", "b.png", "--objects"]).ends(2).says(&["is a picture; --objects"]);
}

/// What is told is right in its numbers.
#[test]
fn small_words_are_right() {
    let sandbox = Sandbox::new();
    sandbox.write("two.ron", SCENE.replace("// small", "// small\n// and short"));
    sandbox.run(&["convert", "two.ron", "-o", "two.json"]).ends(0).says(&["so 2 comments are left out"]);
    sandbox.run(&["convert", "scene.ron", "-o", "one.json"]).ends(0).says(&["so 1 comment is left out"]);
    // A lamp of many triangles is one; what is nearly at zero is there.
    let lamp = "Scene(objects: [Torus(radius: 1, tube_radius: 0.2, material: Emissive(radiance: 1)), \
                Box(center: (0, 0.5, 0), size: 1, transform: [Rotate(axis: (0, 0, 1), degrees: 90)])])";
    sandbox.write("lamp.ron", lamp);
    let ran = sandbox.run(&["check", "lamp.ron"]).ends(0);
    assert!(ran.out_text().contains("2 objects, 1 light"), "{}", ran.out_text());
    let info = sandbox.run(&["info", "lamp.ron"]).ends(0).out_text();
    assert!(!info.contains("0.0000") && info.contains("lights     1\n"), "{info}");
    // A mesh that shines by its own file is one, too.
    sandbox.write("lamp.mtl", "newmtl on\nKe 3\nnewmtl off\nKd 0.5\n");
    sandbox.write(
        "lamp.obj",
        "mtllib lamp.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl on\nf 1 2 3 4\nusemtl off\nf 4 3 2\n",
    );
    let light = "SphereLight(center: (0, 9, 0), radius: 1, power: 100)";
    sandbox.write("file.ron", format!("Scene(objects: [Mesh(file: \"lamp.obj\")], lights: [{light}])"));
    sandbox.write("only.ron", "Scene(objects: [Mesh(file: \"lamp.obj\")])");
    for (scene, lights) in [("file.ron", "2 lights"), ("only.ron", "1 light")] {
        let ran = sandbox.run(&["check", scene, "--deny-warnings"]).ends(0);
        assert!(ran.out_text().contains(&format!("1 object, {lights}")), "{}", ran.out_text());
        let info = sandbox.run(&["info", scene]).ends(0).out_text();
        assert!(info.contains(&format!("lights     {}\n", &lights[..1])), "{info}");
    }
    // So many copies share their triangles, unless they are asked not to.
    for (instances, told) in [("Auto", "none of them shines"), ("Always", "none of them shines"), ("Never", "")] {
        let mesh = format!("Mesh(file: \"lamp.obj\", placements: Grid(count: (40, 40, 1)), instances: {instances})");
        sandbox.write("many.ron", format!("Scene(background: 1, objects: [{mesh}])"));
        let ran = sandbox.run(&["check", "many.ron"]).ends(0);
        assert!(ran.err.contains(told) && ran.err.is_empty() == told.is_empty(), "{instances}: {}", ran.err);
        let lights = if told.is_empty() { "1 light" } else { "0 lights" };
        assert!(ran.out_text().contains(lights), "{instances}: {}", ran.out_text());
    }
    sandbox.write("lamp.mtl", "newmtl on\nKd 0.9\nnewmtl off\nKd 0.5\n");
    sandbox.run(&["check", "only.ron"]).ends(0).says(&["W0301", "no light"]);
    let line = ["render", "scene.ron", "-o", "a.png", "--resume", "a.film"];
    sandbox.run(&line).ends(0).says(&["samples/s"]);
    let ran = sandbox.run(&line).ends(0);
    assert!(ran.err.contains("all samples were there") && !ran.err.contains("samples/s"), "{}", ran.err);
}
