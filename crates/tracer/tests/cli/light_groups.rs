//! Light groups in EXR files, by checkpoints and parts, and what is said where there is no place for them.

use crate::support::{Sandbox, channels};
use serde_json::Value;

const SCENE: &str = r#"Scene(
    camera: Camera(position: (0, 1, 8), look_at: (0, 0.5, 0), fov: 30),
    image: Image(width: 24, height: 20),
    render: Render(samples: 6, max_bounces: 2),
    background: (0.1, 0.2, 0.3),
    effects: Effects(exposure: 1),
    output: Output(light_groups: true),
    lights: [
        SphereLight(center: (3, 4, 3), radius: 0.5, radiance: 20, group: "key"),
        SphereLight(center: (-4, 2, 2), radius: 0.5, radiance: (2, 4, 9), group: "fill"),
    ],
    objects: [
        Sphere(center: (0, 0.8, 0), radius: 0.8),
        Rectangle(size: 8),
        Disk(center: (-1.5, 1.5, 0), normal: (1, 0, 0), radius: 0.4, material: Emissive(radiance: 3, group: "key")),
    ],
)"#;

const GROUPS: [&str; 3] = ["light.fill", "light.key", "light.rest"];

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", SCENE);
    sandbox
}

fn render(sandbox: &Sandbox, name: &str, more: &[&str]) {
    sandbox.run(&[&["render", "scene.ron", "-q", "-o", name][..], more].concat()).ends(0).silent();
}

/// The groups of a file sum to its picture (or what stands for it) within a unit in the last place of each.
fn sum_to(sandbox: &Sandbox, name: &str, picture: &str) {
    let channels = channels(sandbox, name);
    for c in ["R", "G", "B"] {
        let groups = GROUPS.map(|group| &channels[&format!("{group}.{c}")]);
        for (k, &whole) in channels[&format!("{picture}{c}")].iter().enumerate() {
            let parts = groups.map(|group| group[k]);
            let ulp = |x: f32| f64::from(x.abs().next_up() - x.abs());
            let most: f64 = parts.into_iter().chain([whole]).map(ulp).sum();
            let sum: f64 = parts.into_iter().map(f64::from).sum();
            assert!((sum - f64::from(whole)).abs() <= most, "{name}: {k}, {c}: {parts:?} {whole}");
        }
        assert!(groups.iter().all(|group| group.iter().any(|&x| x > 0.0)), "{name}: {c}");
    }
}

#[test]
fn groups_of_a_file_sum_to_its_picture() {
    let sandbox = sandbox();
    render(&sandbox, "a.exr", &["--layers", "depth"]);
    let names: Vec<String> = channels(&sandbox, "a.exr").into_keys().collect();
    let groups = ["fill", "key", "rest"].map(|group| ["B", "G", "R"].map(|c| format!("light.{group}.{c}")));
    let expected = ["B", "G", "R", "depth.Z"].map(str::to_owned);
    assert_eq!(names, [&expected[..], groups.as_flattened()].concat());
    sum_to(&sandbox, "a.exr", "");
    // What is left out behind everything is no light of any group there.
    render(&sandbox, "clear.exr", &["--set", "output.alpha=true"]);
    sum_to(&sandbox, "clear.exr", "");
    // A denoised picture has groups with their noise, which sum to what it was before.
    render(&sandbox, "denoised.exr", &["--denoise"]);
    sum_to(&sandbox, "denoised.exr", "noisy.");
    // Names may be of any script: bytes of UTF-8.
    render(&sandbox, "named.exr", &["--set", "lights[1].group=\"日本 é\""]);
    let name = "light.日本 é.R\0".as_bytes();
    assert!(sandbox.read("named.exr").windows(name.len()).any(|window| window == name));
    // The picture is the same whatever file it goes into.
    sandbox.run(&["render", "scene.ron", "-q", "-o", "b.pfm"]).ends(0);
    sandbox.run(&["compare", "a.exr", "b.pfm", "--fail-above", "max=0"]).ends(0);
}

#[test]
fn the_same_bytes_by_checkpoints_and_parts() {
    let sandbox = sandbox();
    render(&sandbox, "whole.exr", &[]);
    render(&sandbox, "again.exr", &["-j", "1"]);
    assert!(sandbox.read("whole.exr") == sandbox.read("again.exr"));
    let bits = |name: &str| -> Vec<(String, Vec<u32>)> {
        let bits = |(name, x): (String, Vec<f32>)| (name, x.into_iter().map(f32::to_bits).collect());
        channels(&sandbox, name).into_iter().map(bits).collect()
    };
    render(&sandbox, "less.exr", &["--resume", "c.film", "-s", "3"]);
    render(&sandbox, "more.exr", &["--resume", "c.film", "-s", "6"]);
    assert!(bits("more.exr") == bits("whole.exr"));
    for (k, n) in [(1, 2), (2, 2)] {
        render(&sandbox, &format!("{k}.tracer"), &["--part", &format!("{k}/{n}"), "--split", "samples"]);
    }
    sandbox.run(&["merge", "2.tracer", "1.tracer", "-q", "-o", "merged.exr"]).ends(0).silent();
    assert!(bits("merged.exr") == bits("whole.exr"));
    let told = sandbox.run(&["info", "c.film"]).ends(0).silent().out_text();
    assert!(told.contains("\nlights     fill, key, rest\n"), "{told}");
    let told: Value =
        serde_json::from_str(&sandbox.run(&["info", "1.tracer", "--json"]).ends(0).out_text()).expect("JSON");
    assert_eq!(told["light_groups"], serde_json::json!(["fill", "key", "rest"]));
    // Other groups are refused, and named.
    let other = ["--resume", "c.film", "-s", "7", "--set", "output.light_groups=false"];
    let ran = sandbox.run(&[&["render", "scene.ron", "-o", "b.exr"][..], &other].concat()).ends(2);
    ran.says(&["the set of light groups is fill, key, rest there and none here"]);
    let other = ["-q", "-o", "3.tracer", "--part", "2/2", "--split", "samples", "--set", "output.light_groups=false"];
    sandbox.run(&[&["render", "scene.ron"][..], &other].concat()).ends(0);
    let ran = sandbox.run(&["merge", "1.tracer", "3.tracer", "-o", "merged.exr"]).ends(2);
    ran.says(&["the set of light groups is none there and fill, key, rest here"]);
}

#[test]
fn no_place_and_no_name_are_told() {
    let sandbox = sandbox();
    let ran = sandbox.run(&["render", "scene.ron", "-o", "a.png"]).ends(0);
    ran.says(&["warning: the scene's light groups are written into EXR only", "add -o a.exr"]);
    let arguments = ["render", "scene.ron", "-q", "-o", "a.exr", "--report", "r.json"];
    sandbox.run(&arguments).ends(0).silent();
    let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
    assert_eq!(report["picture"]["layers"], serde_json::json!(["light.fill", "light.key", "light.rest"]));
    let ran = sandbox.run(&["check", "scene.ron", "--set", "lights[0].group=\"rest\""]).ends(2);
    ran.says(&["E0412", "lights[0]"]);
}
