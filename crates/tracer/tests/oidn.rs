//! Open Image Denoise as it is: `cargo xtask prove oidn` runs this with the library that PyPI's wheel holds.

#[expect(dead_code, reason = "what other tests of the program need")]
#[path = "cli/support.rs"]
mod support;

use serde_json::Value;
use std::collections::BTreeMap;
use support::{Ran, Sandbox, channels, repository};

fn run(sandbox: &Sandbox, arguments: &[&str]) -> Ran {
    let named = std::env::var_os("TRACER_OIDN").expect("TRACER_OIDN: `cargo xtask prove oidn` sets it");
    Ran::of(sandbox.command(arguments).env("TRACER_OIDN", named))
}

/// Mean of (x - r)^2 / (r^2 + 0.01) over pixels and channels.
fn relative_error(picture: &BTreeMap<String, Vec<f32>>, layer: &str, truth: &BTreeMap<String, Vec<f32>>) -> f64 {
    let of = |channel: &str| {
        let pixels = picture[&format!("{layer}{channel}")].iter().zip(&truth[channel]);
        let square = |x: f32| f64::from(x) * f64::from(x);
        let relative = |(x, r): (&f32, &f32)| square(x - r) / (square(*r) + 0.01);
        pixels.map(relative).sum::<f64>() / truth[channel].len() as f64
    };
    ["R", "G", "B"].map(of).iter().sum::<f64>() / 3.0
}

#[test]
fn errors_fall_and_what_was_done_is_told() {
    for scene in ["cookbook/lampshade", "gallery/cornell", "cookbook/window"] {
        let sandbox = Sandbox::new();
        let file = repository().join("scenes").join(scene).with_extension("ron").display().to_string();
        let render = |more: &[&str]| run(&sandbox, &[&["render", &file, "--size", "150x100"], more].concat()).ends(0);
        render(&["-q", "-s", "512", "--seed", "77", "-o", "truth.exr"]);
        render(&["-q", "-s", "16", "-o", "plain.exr"]);
        let told = render(&["-s", "16", "-o", "a.exr", "--denoise=oidn", "--report", "r.json"]);
        told.says(&["denoised by Open Image Denoise 2."]);
        let (truth, all) = (channels(&sandbox, "truth.exr"), channels(&sandbox, "a.exr"));
        let [before, after] = ["noisy.", ""].map(|layer| relative_error(&all, layer, &truth));
        println!("{scene}: relMSE {before:.5}, {after:.5} afterwards, {:.2} times less", before / after);
        assert!(after < before / 2.0, "{scene}: {before} {after}");
        let plain = channels(&sandbox, "plain.exr");
        assert!(["R", "G", "B"].iter().all(|channel| all[&format!("noisy.{channel}")] == plain[*channel]));
        let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
        let of = &report["denoise"];
        assert!(of["by"].as_str().is_some_and(|by| by.starts_with("Open Image Denoise 2.")), "{of}");
        assert!(of["change"].as_f64() > Some(0.0) && of["error_before"].as_f64() > Some(0.0), "{of}");
        assert_eq!(of["error_after"], Value::Null);
        assert!(report["command"].as_str().is_some_and(|command| command.ends_with("--denoise=oidn")));
    }
}

#[test]
fn the_same_bytes_again_by_threads_parts_checkpoints_and_frames() {
    let sandbox = Sandbox::new();
    let render = |more: &[&str]| run(&sandbox, &[&["render", "scene.ron", "-q", "-s", "8"], more].concat()).ends(0);
    render(&["-o", "a.exr", "-o", "a.png", "--denoise=oidn", "-j", "1"]);
    render(&["-o", "b.exr", "-o", "b.png", "--denoise=oidn", "-j", "2"]);
    // The built-in denoiser's film is no other, so either goes on with what the other has begun.
    run(&sandbox, &["render", "scene.ron", "-q", "-s", "3", "-o", "c.exr", "--denoise", "--resume", "c.film"]).ends(0);
    render(&["-o", "c.exr", "-o", "c.png", "--denoise=oidn", "--resume", "c.film"]);
    for part in ["1/2", "2/2"] {
        render(&["--part", part, "--denoise"]);
    }
    let merge = ["merge", "scene.1of2.tracer", "scene.2of2.tracer", "-o", "d.exr", "-o", "d.png", "--denoise=oidn"];
    run(&sandbox, &merge).ends(0).says(&["denoised by Open Image Denoise 2."]);
    render(&["-o", "f#.png", "--frames", "0-2", "--set", "animation.frames=3", "--denoise=oidn"]);
    for name in ["b", "c", "d"] {
        for kind in ["exr", "png"] {
            assert!(sandbox.read(&format!("{name}.{kind}")) == sandbox.read(&format!("a.{kind}")), "{name}.{kind}");
        }
    }
    run(&sandbox, &["repro", "a.png"]).ends(0).says(&["made again, the same bytes"]);
    let info = run(&sandbox, &["info", "a.png"]).ends(0).out_text();
    assert!(info.contains("oidn"), "{info}");
    let pixels = |name: &str| image::open(sandbox.path(name)).expect("a picture");
    for frame in ["f0.png", "f1.png", "f2.png"] {
        assert!(pixels(frame) == pixels("a.png"), "{frame}");
    }
    // What is clear stays so.
    let clear = ["--set", "output.alpha=true"];
    render(&[&["-o", "e.exr"], &clear[..]].concat());
    render(&[&["-o", "f.exr", "--denoise=oidn"], &clear[..]].concat());
    let (noisy, denoised) = (channels(&sandbox, "e.exr"), channels(&sandbox, "f.exr"));
    assert!(noisy["A"] == denoised["A"] && noisy["R"] == denoised["noisy.R"] && noisy["R"] != denoised["R"]);
}
