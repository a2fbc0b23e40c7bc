//! `--denoise`: the picture, what EXR files keep of it, parts, checkpoints, the report.

use crate::support::{Ran, Sandbox, channels, repository};
use serde_json::Value;

fn render(sandbox: &Sandbox, more: &[&str]) -> Ran {
    sandbox.run(&[&["render", "scene.ron", "-q"], more].concat())
}

fn json(sandbox: &Sandbox, name: &str) -> Value {
    serde_json::from_str(&sandbox.text(name)).expect("JSON")
}

#[test]
fn the_noisy_picture_is_kept_beside_it() {
    let sandbox = Sandbox::new();
    render(&sandbox, &["-s", "8", "-o", "plain.exr", "-o", "plain.png"]).ends(0);
    render(&sandbox, &["-s", "8", "-o", "a.exr", "-o", "a.png", "--denoise"]).ends(0).silent();
    render(&sandbox, &["-s", "8", "-o", "off.exr", "-o", "off.png", "--denoise", "off"]).ends(0);
    assert_eq!(
        (sandbox.read("off.exr"), sandbox.read("off.png")),
        (sandbox.read("plain.exr"), sandbox.read("plain.png"))
    );
    assert_ne!(sandbox.read("a.png"), sandbox.read("plain.png"));
    let (plain, all) = (channels(&sandbox, "plain.exr"), channels(&sandbox, "a.exr"));
    // What guides it is not written.
    assert_eq!(all.keys().collect::<Vec<_>>(), ["B", "G", "R", "noisy.B", "noisy.G", "noisy.R"]);
    for channel in ["R", "G", "B"] {
        assert_eq!(all[&format!("noisy.{channel}")], plain[channel]);
        assert_ne!(all[channel], plain[channel]);
    }
    // Unless it is asked for; threads do not show.
    let layers = ["-s", "8", "-o", "b.exr", "--denoise=on", "--layers", "depth", "-j", "3"];
    render(&sandbox, &layers).ends(0).silent();
    let with_depth = channels(&sandbox, "b.exr");
    assert_eq!(with_depth.keys().filter(|name| name.contains("depth")).count(), 1);
    assert!(all.iter().all(|(name, values)| with_depth[name] == *values));
}

#[test]
fn what_it_did_is_told() {
    let sandbox = Sandbox::new();
    let arguments = ["render", "scene.ron", "-s", "8", "-o", "a.png", "--denoise", "--report", "r.json"];
    sandbox.run(&arguments).ends(0).says(&[
        "denoised in ",
        " s: errors about ",
        " times smaller",
        " before it was denoised",
    ]);
    let report = json(&sandbox, "r.json");
    let of = |name: &str| report["denoise"][name].as_f64().expect("a number");
    assert!(0.0 < of("change") && of("error_after") < of("error_before") && of("error_before") < 1.0, "{report}");
    let command = report["command"].as_str().expect("a command");
    assert!(command.ends_with("--denoise=on"), "{command}");
    assert_eq!(report["picture"]["layers"], Value::Array(Vec::new()));
    render(&sandbox, &["-o", "b.png", "--report", "plain.json"]).ends(0);
    assert_eq!(json(&sandbox, "plain.json")["denoise"], Value::Null);
}

#[test]
fn parts_are_denoised_when_they_are_merged() {
    let sandbox = Sandbox::new();
    render(&sandbox, &["-s", "7", "-o", "one.exr", "-o", "one.png", "--denoise", "--layers", "normal"]).ends(0);
    for part in ["1/3", "2/3", "3/3"] {
        render(&sandbox, &["-s", "7", "--part", part, "--denoise", "--layers", "normal"]).ends(0);
        let name = format!("plain{}.tracer", &part[..1]);
        render(&sandbox, &["-s", "7", "--part", part, "-o", &name]).ends(0);
    }
    let told = sandbox.run(&["render", "scene.ron", "-s", "2", "--part", "1/2", "--denoise", "-o", "told.tracer"]);
    told.ends(0).says(&["`tracer merge .. --denoise`"]);
    let parts = ["merge", "scene.1of3.tracer", "scene.3of3.tracer", "scene.2of3.tracer"];
    let outputs = ["-o", "all.exr", "-o", "all.png", "--denoise", "--report", "r.json"];
    sandbox.run(&[&parts[..], &outputs].concat()).ends(0).says(&["denoised in "]);
    assert_eq!(sandbox.read("all.png"), sandbox.read("one.png"));
    assert_eq!(sandbox.read("all.exr"), sandbox.read("one.exr"));
    let report = json(&sandbox, "r.json");
    assert!(report["denoise"]["change"].as_f64().is_some() && report["picture"]["layers"][0] == "normal", "{report}");
    // Rows that are missing are black, and the others are denoised.
    for k in ["1/2", "2/2"] {
        let part = ["-s", "8", "--denoise", "--part", k, "--split", "rows"];
        render(&sandbox, &[&part[..], &["-o", &format!("rows{}.tracer", &k[..1])]].concat()).ends(0);
    }
    let merge = ["merge", "rows1.tracer", "-o", "rows.png", "--denoise", "--allow-missing"];
    sandbox.run(&merge).ends(0).says(&["missing: samples 0 to 7 of rows", "denoised in "]);
    // They may be merged without, too: then with the layers that were asked for.
    sandbox.run(&[&parts[..], &["-o", "noisy.exr"]].concat()).ends(0);
    let names: Vec<String> = channels(&sandbox, "noisy.exr").into_keys().collect();
    assert_eq!(names, ["B", "G", "R", "normal.X", "normal.Y", "normal.Z"]);
    let plain = ["merge", "plain1.tracer", "plain2.tracer", "plain3.tracer", "-o", "no.png", "--denoise"];
    let ran = sandbox.run(&plain).ends(2);
    ran.says(&["--denoise needs what these parts do not hold (depth", "halves", "render them with --denoise, too"]);
    let mixed = ["merge", "plain1.tracer", "scene.2of3.tracer", "scene.3of3.tracer", "-o", "no.png"];
    sandbox.run(&mixed).ends(2).says(&["is of another rendering"]);
    assert!(!sandbox.files().contains(&"no.png".to_owned()));
}

#[test]
fn checkpoints_hold_what_it_needs() {
    let sandbox = Sandbox::new();
    render(&sandbox, &["-s", "19", "-o", "once.exr", "--denoise"]).ends(0);
    render(&sandbox, &["-s", "5", "-o", "a.exr", "--denoise", "--resume", "c.film"]).ends(0);
    render(&sandbox, &["-s", "19", "-o", "a.exr", "--denoise", "--resume", "c.film"]).ends(0).silent();
    assert_eq!(sandbox.read("a.exr"), sandbox.read("once.exr"));
    let told = sandbox.run(&["info", "c.film"]).ends(0).out_text();
    assert!(told.contains("denoising_normal, halves\n"), "{told}");
    let ran = render(&sandbox, &["-s", "30", "-o", "b.exr", "--resume", "c.film"]).ends(2);
    ran.says(&["the set of layers is ", "halves there and none here"]);
}

#[test]
fn what_cannot_be_is_said() {
    let sandbox = Sandbox::new();
    render(&sandbox, &["-o", "a.png", "--denoise", "strong"]).ends(2).says(&["expected on, off or oidn"]);
    let ran = sandbox.run(&["render", "--denoise", "scene.ron", "-o", "a.png"]).ends(2);
    ran.says(&["before the name of a file write --denoise=on"]);
    let ran = render(&sandbox, &["-s", "1", "-o", "a.png", "--denoise"]).ends(2);
    ran.says(&["--denoise needs two samples per pixel at least"]);
    assert_eq!(sandbox.files(), ["scene.ron"]);
}

/// Where Open Image Denoise is to work and is not there, nothing is rendered; parts do not need it.
#[test]
fn a_library_is_looked_for_first() {
    let sandbox = Sandbox::new();
    sandbox.write("no-library", "text");
    std::fs::create_dir(sandbox.path("folder")).expect("a folder");
    let with = |named: &str, arguments: &[&str]| Ran::of(sandbox.command(arguments).env("TRACER_OIDN", named));
    let render = ["render", "scene.ron", "-o", "a.png", "--denoise=oidn"];
    let ways = "; install Open Image Denoise 2, or have TRACER_OIDN name its library or the folder of that; --denoise \
                alone needs none\n";
    let absent = with("missing/lib.so", &render).ends(1);
    let start = "error: --denoise oidn: no Open Image Denoise: TRACER_OIDN names missing/lib.so, which is not there";
    assert_eq!(absent.err, format!("{start}{ways}"));
    let empty = with("folder", &render).ends(1);
    empty.says(&["TRACER_OIDN names the folder folder, which has no ", "OpenImageDenoise", ways]);
    let told = with("no-library", &render).ends(1).says(&["no-library will not do: ", ways]).err;
    assert_eq!(told.lines().count(), 1, "{told}");
    assert_eq!(sandbox.files(), ["folder", "no-library", "scene.ron"]);
    for part in ["1/2", "2/2"] {
        with("missing", &["render", "scene.ron", "--part", part, "--denoise=oidn"]).ends(0);
    }
    let merge = ["merge", "scene.1of2.tracer", "scene.2of2.tracer", "-o", "a.png", "--denoise"];
    with("missing", &[&merge[..], &["oidn"]].concat()).ends(1).says(&["TRACER_OIDN names missing, which", ways]);
    with("missing", &merge).ends(0).says(&["denoised in "]);
}

/// The commands of the page work.
#[test]
fn the_page_is_true() {
    let page = std::fs::read_to_string(repository().join("docs/denoise.md")).expect("the page");
    let commands: Vec<&str> = page.lines().filter_map(|line| line.strip_prefix("tracer ")).collect();
    assert_eq!(commands.len(), 2);
    let sandbox = Sandbox::new();
    for command in commands {
        let command = command.replace("scenes/", &format!("{}/scenes/", repository().display()));
        let command = command.replace("--samples 16", "--samples 2 --size 12x8");
        sandbox.run(&command.split(' ').collect::<Vec<_>>()).ends(0).says(&["denoised in "]);
    }
    assert_eq!(sandbox.files(), ["lamp.exr", "lamp.png", "scene.ron"]);
}
