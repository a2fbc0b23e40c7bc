//! `--integrator`, and layers as pictures (`--show`).

use crate::support::Sandbox;
use serde_json::Value;
use tracer::compare::Picture;

fn mean(sandbox: &Sandbox, name: &str) -> f64 {
    let picture = Picture::load(&sandbox.path(name)).expect("a picture");
    picture.values.iter().map(|&x| f64::from(x)).sum::<f64>() / picture.values.len() as f64
}

/// As if the scene had said so; the report and the pictures tell of it.
#[test]
fn an_integrator_is_that_of_the_scene() {
    let sandbox = Sandbox::new();
    let words = [
        ("full", "Full"),
        ("path", "Path"),
        ("direct", "Direct"),
        ("ambient_occlusion", "AmbientOcclusion"),
        ("ao", "AmbientOcclusion"),
    ];
    let mut seen = std::collections::BTreeSet::new();
    for (name, word) in words {
        let line = ["render", "scene.ron", "-o", "a.pfm", "--integrator", name, "--report", "a.json"];
        sandbox.run(&line).ends(0).silent();
        let brackets = if word == "AmbientOcclusion" { "()" } else { "" };
        let set = format!("render.integrator={word}{brackets}");
        sandbox.run(&["render", "scene.ron", "-o", "b.pfm", "--set", &set]).ends(0).silent();
        assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"), "{name}");
        let report: Value = serde_json::from_slice(&sandbox.read("a.json")).expect("a report");
        assert_eq!(report["transport"]["integrator"], word);
        assert!(report["command"].as_str().is_some_and(|command| command.contains(&set)), "{report}");
        seen.insert(sandbox.read("a.pfm"));
    }
    assert_eq!(seen.len(), 4);
    let distance = ["--set", "render.integrator=AmbientOcclusion(distance: 0.5)"];
    sandbox.run(&[&["render", "scene.ron", "-o", "near.pfm"][..], &distance].concat()).ends(0).silent();
    sandbox.run(&["render", "scene.ron", "-o", "far.pfm", "--integrator", "ao"]).ends(0).silent();
    assert!(mean(&sandbox, "near.pfm") > mean(&sandbox, "far.pfm"));
    // A part of it is a part of it, and a checkpoint of another one is refused.
    let kept = ["render", "scene.ron", "-o", "a.pfm", "--integrator", "direct", "--checkpoint", "a.film"];
    sandbox.run(&kept).ends(0).silent();
    let other = ["render", "scene.ron", "-o", "a.pfm", "--integrator", "ao", "--resume", "a.film"];
    sandbox.run(&other).ends(2).says(&["integrator", "Direct", "AmbientOcclusion"]);
    sandbox.run(&["render", "scene.ron", "-o", "a.pfm", "--integrator", "bdpt"]).ends(2).says(&["ambient_occlusion"]);
}

/// The reference's picture is that of the engine but for noise, and the same whatever the threads.
#[test]
fn the_reference_is_a_slow_renderer() {
    let sandbox = Sandbox::new();
    let render = |output: &str, more: &[&str]| {
        sandbox.run(&[&["render", "scene.ron", "-o", output, "--samples", "64"][..], more].concat()).ends(0).silent();
    };
    render("engine.pfm", &[]);
    render("a.pfm", &["--integrator", "reference"]);
    render("b.pfm", &["--integrator", "reference", "-j", "1"]);
    render("c.pfm", &["--integrator", "reference", "--seed", "5"]);
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
    assert_ne!(sandbox.read("a.pfm"), sandbox.read("c.pfm"));
    let [engine, reference] = [mean(&sandbox, "engine.pfm"), mean(&sandbox, "a.pfm")];
    assert!((engine / reference - 1.0).abs() < 0.03, "{engine} {reference}");
    render("a.png", &["--integrator", "reference", "--exposure", "1"]);
    let line = ["render", "scene.ron", "-o", "d.pfm", "--integrator", "reference"];
    for (more, word) in [
        (&["--crop", "1,2,3,4"][..], "--crop"),
        (&["--resume", "a.film"], "--resume"),
        (&["--report", "r.json"], "--report"),
        (&["--samples", "1"], "two samples"),
        (&["--set", "output.alpha=true"], "output.alpha"),
    ] {
        sandbox.run(&[&line[..], more].concat()).ends(2).says(&["--integrator reference", word]);
    }
    let parts = ["farm", "slurm", "scene.ron", "-o", "d.png", "--parts", "2", "--dry-run", "--integrator", "reference"];
    sandbox.run(&parts).ends(2).says(&["whole pictures only"]);
    assert!(!sandbox.files().contains(&"d.pfm".to_owned()));
}

/// A layer in false colours, with a legend below; the picture itself elsewhere is what it was.
#[test]
fn a_layer_is_shown_as_a_picture() {
    let sandbox = Sandbox::new();
    let show = |layer: &str| {
        ["render", "scene.ron", "-o", "a.png", "--samples", "8", "--show"]
            .map(str::to_owned)
            .into_iter()
            .chain([layer.to_owned()])
            .collect::<Vec<_>>()
    };
    let ran = |layer: &str| {
        let line = show(layer);
        sandbox.run(&line.iter().map(String::as_str).collect::<Vec<_>>()).ends(0)
    };
    for (layer, is_heat) in [
        ("noise", true),
        ("path_length", true),
        ("PathLength", true),
        ("variance", true),
        ("depth", true),
        ("normal", false),
        ("object_id", false),
        ("albedo", false),
    ] {
        let ran = ran(layer);
        let picture = Picture::load(&sandbox.path("a.png")).expect("a picture");
        assert_eq!((picture.width, picture.height), (40, if is_heat { 24 + 28 } else { 24 }), "{layer}");
        assert_eq!(ran.err.contains("is dark, "), is_heat, "{layer}: {}", ran.err);
        let colours: std::collections::BTreeSet<_> =
            picture.values.chunks(3).map(|p| [p[0], p[1], p[2]].map(f32::to_bits)).collect();
        assert!(colours.len() > 3, "{layer}");
    }
    ran("path_length").says(&["path_length: 1 is dark"]);
    // Nobody's picture is replaced by a map that has no name.
    sandbox.run(&["render", "scene.ron", "--samples", "2", "--show", "noise"]).ends(0).says(&["scene_noise.png in"]);
    assert!(!sandbox.files().contains(&"scene.png".to_owned()));
    let wrong = ["render", "scene.ron", "-o", "a.exr", "--show", "noise"];
    sandbox.run(&wrong).ends(2).says(&["--show is for PNG only"]);
    let wrong = ["render", "scene.ron", "-o", "a.png", "--show", "heat"];
    sandbox.run(&wrong).ends(2).says(&["the name of a layer", "path_length", "nodes"]);
}
