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
    fields(&report(&sandbox, &[]), "", &mut found);
    assert!(found.contains("tree") && found.contains("stats"), "they are null");
    let many: String = (0..200).map(|k| format!("Sphere(center: ({k}, 0, 0), radius: 0.5), ")).collect();
    sandbox.write("scene.ron", format!("Scene(background: 1, objects: [{many}])"));
    fields(&report(&sandbox, &["--size", "8x8", "--stats"]), "", &mut found);
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
    // 40x24 pixels lie in whole tiles of 16x16.
    assert_eq!(number("/samples/total"), 48 * 32 * 2);
    assert_eq!(
        ["camera", "scattered", "shadow", "segments", "photons"]
            .map(|kind| number(&format!("/rays/{kind}")))
            .iter()
            .sum::<u64>(),
        number("/rays/total")
    );
    assert_eq!((number("/picture/samples_min"), number("/picture/samples_max")), (2, 2));
    assert_eq!((number("/primitives/spheres"), number("/primitives/lights")), (4, 1));
    assert_eq!((number("/machine/threads"), number("/samples/dropped")), (3, 0));
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
