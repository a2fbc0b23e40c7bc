//! Picture layers in EXR files: their names and numbers, and what is said where there is no place for them.

use crate::support::{Sandbox, channels, repository};
use serde_json::Value;
use tracer_core::LayerSet;

const LAYERS: [&str; 2] = ["--layers", "albedo,Normal,depth"];

#[test]
fn layers_stand_beside_the_picture() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "plain.exr", "-o", "plain.png"]).ends(0).silent();
    let outputs = ["render", "scene.ron", "-o", "a.exr", "-o", "a.png"];
    sandbox.run(&[&outputs[..], &LAYERS].concat()).ends(0).silent();
    assert_eq!(sandbox.read("a.png"), sandbox.read("plain.png"));
    let (plain, all) = (channels(&sandbox, "plain.exr"), channels(&sandbox, "a.exr"));
    assert_eq!(plain.keys().collect::<Vec<_>>(), ["B", "G", "R"]);
    let names = ["B", "G", "R", "albedo.B", "albedo.G", "albedo.R", "depth.Z", "normal.X", "normal.Y", "normal.Z"];
    assert_eq!(all.keys().collect::<Vec<_>>(), names);
    assert!(plain.iter().all(|(name, values)| all[name] == *values));
    // The sky above, the ground below: a ball so large that it is nearly flat.
    let (first, last) = (0, 40 * 24 - 1);
    assert_eq!((all["depth.Z"][first], all["albedo.R"][first], all["normal.Y"][first]), (f32::INFINITY, 0.0, 0.0));
    assert_eq!(all["albedo.R"][last], 0.8);
    assert!(all["normal.Y"][last] > 0.99 && (2.4..2.6).contains(&all["depth.Z"][last]), "{}", all["depth.Z"][last]);
    // Exposure is the picture's; a part is that of the whole.
    let crop = ["--exposure", "2", "--crop", "30,20,10,4"];
    sandbox.run(&[&["render", "scene.ron", "-o", "part.exr"][..], &crop, &LAYERS].concat()).ends(0).silent();
    let part = channels(&sandbox, "part.exr");
    for name in &names[3..] {
        let cut: Vec<f32> = (20..24).flat_map(|y| all[*name][y * 40 + 30..y * 40 + 40].iter().copied()).collect();
        assert_eq!(part[*name], cut, "{name}");
    }
    assert!(part["R"][0] > all["R"][20 * 40 + 30]);
    // Who reads pictures finds the picture.
    sandbox.run(&["compare", "a.exr", "plain.exr", "--fail-above", "max=0"]).ends(0);
}

#[test]
fn the_scene_asks_for_layers_too() {
    let sandbox = Sandbox::new();
    let set = ["render", "scene.ron", "--set", "output.layers=[Depth, Depth]"];
    sandbox.run(&[&set[..], &["-o", "a.exr", "--layers", "depth,albedo"]].concat()).ends(0).silent();
    let names: Vec<String> = channels(&sandbox, "a.exr").into_keys().collect();
    assert_eq!(names, ["B", "G", "R", "albedo.B", "albedo.G", "albedo.R", "depth.Z"]);
    // Without a place for them it is a picture like any other.
    let ran = sandbox.run(&[&set[..], &["-o", "a.png"]].concat()).ends(0);
    let said = "warning: the scene's layers (depth) are written into EXR only; add -o a.exr\na.png in ";
    assert!(ran.err.starts_with(said), "{}", ran.err);
    sandbox.run(&[&set[..], &["-o", "a.png", "--quiet"]].concat()).ends(0).silent();
}

#[test]
fn layers_that_cannot_be_written_are_refused() {
    let sandbox = Sandbox::new();
    let ran = sandbox.run(&["render", "scene.ron", "-o", "out.png", "--layers", "depth"]).ends(2);
    ran.says(&["--layers is for EXR", "add -o out.exr"]);
    let ran = sandbox.run(&["render", "scene.ron", "-o", "out.exr", "--layers", "depth,shadow"]).ends(2);
    ran.says(&["'shadow'", "albedo, normal, depth"]);
    assert_eq!(sandbox.files(), ["scene.ron"]);
}

#[test]
fn checkpoints_hold_layers() {
    let sandbox = Sandbox::new();
    let render = |name: &str, samples: &str, more: &[&str]| {
        let arguments = ["render", "scene.ron", "-o", name, "--samples", samples];
        sandbox.run(&[&arguments[..], &["--resume", "c.film", "-q"], more].concat())
    };
    render("a.exr", "5", &LAYERS).ends(0);
    render("a.exr", "19", &LAYERS).ends(0).silent();
    sandbox.run(&[&["render", "scene.ron", "-o", "b.exr", "--samples", "19"][..], &LAYERS].concat()).ends(0);
    assert_eq!(sandbox.read("a.exr"), sandbox.read("b.exr"));
    let told = sandbox.run(&["info", "c.film"]).ends(0).silent().out_text();
    assert!(told.contains("\nlayers     albedo, normal, depth\n"), "{told}");
    let json: Value =
        serde_json::from_str(&sandbox.run(&["info", "c.film", "--json"]).ends(0).out_text()).expect("JSON");
    assert_eq!(json["layers"], serde_json::json!(["albedo", "normal", "depth"]));
    let differs = |other: &str| format!("the set of layers is albedo, normal, depth there and {other} here");
    render("c.exr", "30", &[]).ends(2).says(&[&differs("none")]);
    render("c.exr", "30", &["--layers", "depth"]).ends(2).says(&[&differs("depth")]);
    assert!(!sandbox.files().contains(&"c.exr".to_owned()));
}

#[test]
fn the_report_tells_of_layers() {
    let sandbox = Sandbox::new();
    let arguments = ["render", "scene.ron", "-o", "a.exr", "--report", "r.json", "--stats"];
    sandbox.run(&[&arguments[..], &LAYERS].concat()).ends(0);
    let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
    assert_eq!(report["picture"]["layers"], serde_json::json!(["albedo", "normal", "depth"]));
    let command = report["command"].as_str().expect("a command");
    assert!(command.contains("--layers albedo,normal,depth"), "{command}");
}

/// The page has a row for each layer, with its channels, and its commands work.
#[test]
fn the_page_is_true() {
    let page = std::fs::read_to_string(repository().join("docs/layers.md")).expect("the page");
    let rows: Vec<&str> = page.lines().filter(|line| line.starts_with("| `")).collect();
    let names: Vec<&str> = rows.iter().map(|row| row.split('`').nth(1).expect("a name")).collect();
    assert_eq!(names, LayerSet::all().names().collect::<Vec<_>>());
    let command = page.lines().find_map(|line| line.strip_prefix("tracer ")).expect("a command");
    let sandbox = Sandbox::new();
    let command = command.replace("scenes/", &format!("{}/scenes/", repository().display()));
    let arguments: Vec<&str> = command.split(' ').chain(["--size", "8x8", "--samples", "1"]).collect();
    sandbox.run(&arguments).ends(0);
    let all = ["render", "scene.ron", "-o", "all.exr", "--layers", &names.join(",")];
    sandbox.run(&all).ends(0).silent();
    for name in channels(&sandbox, "all.exr").keys().filter(|name| name.contains('.')) {
        let (layer, channel) = name.split_once('.').expect("a dot");
        let row = rows[names.iter().position(|name| *name == layer).expect("a layer")];
        assert!(row.contains(&format!("`{name}`")) || row.contains(&format!("`.{channel}`")), "{name}: {row}");
    }
}
