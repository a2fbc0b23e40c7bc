//! The JSON report: what `docs/report.md` promises.

use crate::support::{Sandbox, repository};
use serde_json::Value;
use std::collections::BTreeSet;

fn report(sandbox: &Sandbox, more: &[&str]) -> Value {
    sandbox
        .run(&[&["render", "scene.ron", "-o", "a.png", "-o", "b c.exr", "--report", "r.json"][..], more].concat())
        .ends(0);
    serde_json::from_str(&sandbox.text("r.json")).expect("JSON")
}

/// Paths of all fields that hold no further ones: `seconds.read`, `files[].path`.
fn fields(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(map) => {
            for (name, value) in map {
                fields(value, &if path.is_empty() { name.clone() } else { format!("{path}.{name}") }, found);
            }
        }
        Value::Array(items) if items.iter().any(Value::is_object) => {
            items.iter().for_each(|item| fields(item, &format!("{path}[]"), found));
        }
        _ => {
            found.insert(path.to_owned());
        }
    }
}

#[test]
fn fields_are_the_documented_ones() {
    let sandbox = Sandbox::new();
    let mut found = BTreeSet::new();
    // One scene without a tree, one with it.
    let mark = "output.marks={\"A\": (0, 0, 0)}";
    fields(&report(&sandbox, &["--set", mark]), "", &mut found);
    assert!(found.contains("tree") && found.contains("stats"), "they are null");
    let many: String = (0..200).map(|k| format!("Sphere(center: ({k}, 0, 0), radius: 0.5), ")).collect();
    sandbox.write("scene.ron", format!("Scene(background: 1, objects: [{many}])"));
    fields(
        &report(
            &sandbox,
            &["--size", "8x8", "--stats", "--denoise", "--set", "render.clamp=0.5", "--cache", "kept", "--set", mark],
        ),
        "",
        &mut found,
    );
    let documentation = std::fs::read_to_string(repository().join("docs/report.md")).expect("documentation");
    let documented: BTreeSet<String> = documentation
        .lines()
        .filter_map(|line| line.strip_prefix("| `")?.split_once('`'))
        .map(|(field, _)| field.to_owned())
        .collect();
    assert_eq!(found, documented);
}

#[test]
fn phases_sum_to_the_total() {
    let sandbox = Sandbox::new();
    let report = report(&sandbox, &["--samples", "50"]);
    let seconds = |phase: &str| report["seconds"][phase].as_f64().expect("a number");
    let phases = ["read", "compile", "build", "render", "develop", "write"];
    let sum: f64 = phases.iter().map(|phase| seconds(phase)).sum();
    assert!((sum / seconds("total") - 1.0).abs() < 0.02, "{sum} {}", seconds("total"));
    assert!(phases.iter().all(|phase| seconds(phase) >= 0.0));
}

#[test]
fn numbers_fit_together() {
    let sandbox = Sandbox::new();
    let report = report(&sandbox, &["--threads", "3"]);
    let number = |path: &str| report.pointer(path).and_then(Value::as_u64).unwrap_or_else(|| panic!("{path}"));
    assert_eq!(number("/report_version"), 1);
    // Of blocks that reach beyond the picture only its pixels are sampled.
    assert_eq!(number("/samples/total"), 40 * 24 * 2);
    assert_eq!(
        ["camera", "scattered", "shadow", "segments", "photons", "chains"]
            .map(|kind| number(&format!("/rays/{kind}")))
            .iter()
            .sum::<u64>(),
        number("/rays/total")
    );
    assert_eq!((number("/picture/samples_min"), number("/picture/samples_max")), (2, 2));
    assert_eq!((number("/primitives/spheres"), number("/primitives/lights")), (4, 1));
    assert_eq!((number("/machine/threads"), number("/samples/dropped")), (3, 0));
    assert_eq!(number("/samples/beyond"), 0);
    let length = report["mean_path_length"].as_f64().expect("a number");
    assert!((1.0..6.0).contains(&length), "{length}");
    assert!(report["noise"]["relative"].as_f64().expect("a number") > 0.0);
    for (k, name) in ["a.png", "b c.exr"].iter().enumerate() {
        let file = &report["files"][k];
        assert_eq!(file["path"], *name);
        assert_eq!(file["sha256"], tracer::write::sha256(&sandbox.read(name)));
        assert_eq!(file["bytes"].as_u64(), Some(sandbox.read(name).len() as u64));
    }
}

/// Matt things, glass and a small lamp in the dark: sharing and photons are worth it.
const ROOM: &str = "Scene(
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 40, height: 24),
    render: Render(samples: 4),
    lights: [SphereLight(center: (2, 5, 3), radius: 0.3, radiance: 200)],
    objects: [
        Sphere(center: (0, -100, 0), radius: 100),
        Sphere(center: (0, 1, -104), radius: 100),
        Sphere(center: (0, 1, 0), radius: 1, material: Transparent(ior: 1.5)),
    ],
)";

#[test]
fn every_switch_says_what_it_costs() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", ROOM);
    let biased = ["--set", "render.clamp=0.25"];
    let off: [&[&str]; 3] = [&["--set", "render.integrator=Path"], &[], &biased];
    // Of reuse, caustics, clamp: the setting, whether it is at work, and what the picture is an estimate of.
    let expected = [
        ([("Blocks", false), ("Photons", false), ("None", false)], "unbiased"),
        ([("Blocks", true), ("Photons", true), ("None", false)], "unbiased"),
        ([("Blocks", true), ("Photons", true), ("0.25", true)], "biased"),
    ];
    for (more, (switches, estimate)) in off.into_iter().zip(expected) {
        let report = report(&sandbox, more);
        let transport = &report["transport"];
        assert_eq!(transport["estimate"], estimate, "{more:?}");
        let total = transport["seconds"].as_f64().expect("seconds");
        let threads = report["machine"]["threads"].as_f64().expect("a number");
        assert!(
            total > 0.0 && total <= threads * report["seconds"]["render"].as_f64().expect("seconds"),
            "{transport}"
        );
        let mut sum = 0.0;
        let names = ["reuse", "caustics", "clamp"];
        let when_on = ["unbiased", "unbiased", "biased"];
        for (k, (setting, on)) in switches.into_iter().enumerate() {
            let switch = &transport["switches"][k];
            assert_eq!((&switch["name"], &switch["setting"]), (&names[k].into(), &setting.into()), "{more:?}");
            assert_eq!(switch["on"], on, "{more:?} {switch}");
            assert_eq!(switch["estimate"], if on { when_on[k] } else { "unbiased" }, "{more:?} {switch}");
            let [seconds, share] = ["seconds", "share"].map(|field| switch[field].as_f64().expect("a number"));
            assert_eq!(seconds > 0.0, on, "{more:?} {switch}");
            assert!((share * total - seconds).abs() <= 1e-9 * total, "{more:?} {switch}");
            sum += share;
        }
        assert!(sum < 1.0, "{transport}");
        let clamped = &transport["clamped"];
        assert_eq!(clamped.is_null(), estimate != "biased");
        if !clamped.is_null() {
            assert_eq!(clamped["limit"], 0.25);
            assert!((1..=40 * 24 * 4).contains(&clamped["samples"].as_u64().expect("a number")), "{clamped}");
            assert!((0.0..1.0).contains(&clamped["share"].as_f64().expect("a number")), "{clamped}");
            assert_eq!(clamped["radiance"].as_array().map(Vec::len), Some(3));
        }
    }
    // For people, in the same words.
    let said = sandbox.run(&["render", "scene.ron", "-o", "a.png", "--stats", "--set", "render.clamp=0.25"]).ends(0);
    said.says(&["what the switches of `render` cost", "reuse", "Photons: unbiased", "0.25: biased", "clamping took"]);
    let said = sandbox.run(&["render", "scene.ron", "-o", "a.png", "--stats", "--set", "background=1"]).ends(0);
    said.says(&["Blocks, not used: unbiased"]);
}

/// The examples of the report's page, few samples of a small picture: each is what its comment says.
#[test]
fn examples_are_what_they_say() {
    let sandbox = Sandbox::new();
    let page = std::fs::read_to_string(repository().join("docs/report.md")).expect("documentation");
    let block = page.split("```sh\n").nth(1).and_then(|rest| rest.split("```").next()).expect("a block");
    let scenes = format!(" {}/scenes/", repository().display());
    for line in block.lines() {
        let (command, said) = line.split_once('#').expect("a comment");
        let command = command.strip_prefix("tracer").expect("the program").replace(" scenes/", &scenes);
        sandbox.shell(&format!("\"$T\" {command} --size 24x24 --samples 2 --report r.json")).ends(0);
        let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
        let estimate = report["transport"]["estimate"].as_str().expect("a word");
        assert_eq!(said.trim().split(':').next(), Some(estimate), "{line}");
    }
    assert_eq!(block.lines().count(), 4);
}

/// Everything that the report says of what was taken is the same for any number of threads.
#[test]
fn what_clamping_took_does_not_depend_on_threads() {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", ROOM);
    let taken = |threads: &str| {
        let report = report(&sandbox, &["--threads", threads, "--set", "render.clamp=0.25", "--crop", "3,3,30,20"]);
        report["transport"]["clamped"].clone()
    };
    let one = taken("1");
    assert!(one["share"].as_f64() > Some(0.0), "{one}");
    assert_eq!(taken("3"), one);
}

/// The command, given to a shell, makes the same files.
#[test]
fn the_command_repeats_the_picture() {
    let sandbox = Sandbox::new();
    let more = [
        "--samples",
        "3",
        "--seed",
        "5",
        "--crop",
        "3,3,20,10",
        "--exposure",
        "-0.5",
        "--set",
        "objects[1].radius=0.5",
    ];
    let report = report(&sandbox, &more);
    let files = ["a.png", "b c.exr"].map(|name| sandbox.read(name));
    for name in ["a.png", "b c.exr"] {
        std::fs::remove_file(sandbox.path(name)).expect("a file");
    }
    let command = report["command"].as_str().expect("a text");
    let line = command.strip_prefix("tracer").expect("it begins with the program");
    sandbox.shell(&format!(r#""$T"{line}"#)).ends(0);
    assert_eq!(["a.png", "b c.exr"].map(|name| sandbox.read(name)), files);
}

#[test]
fn a_report_to_standard_output() {
    let sandbox = Sandbox::new();
    let ran = sandbox.run(&["render", "scene.ron", "-o", "a.png", "--report", "-"]).ends(0).silent();
    let report: Value = serde_json::from_str(&ran.out_text()).expect("JSON and nothing else");
    assert_eq!(report["scene"]["file"], "scene.ron");
    sandbox.run(&["render", "scene.ron", "-o", "-", "--format", "png", "--report", "-"]).ends(2).says(&["--report"]);
}
