//! `tracer inspect`: a sample is told as the picture has it, in words, as JSON, as a drawing.

use crate::support::Sandbox;
use serde_json::Value;
use tracer::compare::Picture;

/// Pixels of the sandbox's scene: ground, glass, mirror, sky.
const PIXELS: [[usize; 2]; 6] = [[5, 20], [14, 12], [26, 12], [20, 1], [12, 9], [28, 15]];

fn told(sandbox: &Sandbox, [x, y]: [usize; 2], more: &[&str]) -> Value {
    let pixel = format!("{x},{y}");
    let line = [&["inspect", "scene.ron", "--format", "json", "--pixel", &pixel][..], more].concat();
    serde_json::from_str(&sandbox.run(&line).ends(0).silent().out_text()).expect("JSON")
}

fn radiance(value: &Value) -> [f64; 3] {
    [0, 1, 2].map(|c| value[c].as_f64().expect("a number"))
}

/// What is told is the very sample that a picture of one sample has, by plain paths and by all that helps.
#[test]
fn a_sample_is_that_of_the_picture() {
    let sandbox = Sandbox::new();
    let line = ["render", "scene.ron", "--samples", "1", "-o"];
    sandbox.run(&[&line[..], &["full.pfm"]].concat()).ends(0).silent();
    sandbox.run(&[&line[..], &["path.pfm", "--integrator", "path"]].concat()).ends(0).silent();
    let [full, path] = ["full.pfm", "path.pfm"].map(|name| Picture::load(&sandbox.path(name)).expect("a picture"));
    for [x, y] in PIXELS {
        let told = told(&sandbox, [x, y], &[]);
        let of = |picture: &Picture| [0, 1, 2].map(|c| f64::from(picture.values[3 * (y * 40 + x) + c]));
        let single = |value: &Value| radiance(value).map(|x| f64::from(x as f32));
        assert_eq!(single(&told["path"]["radiance"]), of(&path), "{x},{y}");
        assert_eq!(single(&told["whole"]["radiance"]), of(&full), "{x},{y}");
        assert_eq!((&told["path"]["agrees"], &told["whole"]["agrees"]), (&Value::Bool(true), &Value::Bool(true)));
        // In their order, in single precision; this scene's unit is a power of two.
        let contributions = told["path"]["contributions"].as_array().expect("a list");
        let mut sum = [0f32; 3];
        for brings in contributions.iter().map(|one| radiance(&one["radiance"])) {
            (0..3).for_each(|c| sum[c] += brings[c] as f32);
        }
        assert_eq!(sum.map(f64::from), radiance(&told["path"]["radiance"]), "{x},{y}: {contributions:?}");
        let brought = told["whole"]["brought"].as_array().expect("a list");
        let sum = |c: usize| brought.iter().map(|by| radiance(&by["radiance"])[c]).sum::<f64>();
        for c in 0..3 {
            let all = sum(c) + radiance(&told["whole"]["rounding"])[c];
            assert!((all - radiance(&told["whole"]["radiance"])[c]).abs() <= 1e-12, "{x},{y}");
        }
    }
}

#[test]
fn a_path_is_told_in_words() {
    let sandbox = Sandbox::new();
    let ran = |more: &[&str]| sandbox.run(&[&["inspect", "scene.ron"][..], more].concat());
    let text = ran(&["--pixel", "14,12"]).ends(0).silent().out_text();
    for words in [
        "scene.ron, pixel 14,12, sample 0",
        "the camera's ray starts at (0, 1, 6)",
        "1  objects[1] Sphere, material glass",
        "glass of index 1.5: reflects",
        "scattered: refraction",
        "the fainter way at glass",
        "What it brings, in W/(sr m^2)",
        "to the bit",
        "The same sample with all that the scene asks for",
    ] {
        assert!(text.contains(words), "{words}:\n{text}");
    }
    let text = ran(&["--pixel", "5,20"]).ends(0).silent().out_text();
    for words in ["objects[0] Sphere", "light sampled: lights[0] SphereLight at (", "scattered: diffuse to ("] {
        assert!(text.contains(words), "{words}:\n{text}");
    }
    // Other samples and seeds are other paths; the plain path tracer has no techniques.
    for more in [["--sample", "1"], ["--seed", "7"], ["--size", "80x48"]] {
        assert_ne!(ran(&[&["--pixel", "5,20"][..], &more].concat()).ends(0).out_text(), text);
    }
    let plain = ran(&["--pixel", "5,20", "--set", "render.integrator=Path"]).ends(0).silent().out_text();
    assert!(!plain.contains("with all that the scene asks for") && text.starts_with(plain.trim_end()), "{plain}");
    let sky = ran(&["--pixel", "20,1"]).ends(0).silent().out_text();
    assert!(sky.contains("1  leaves the scene") && sky.contains("ends: nothing is there"), "{sky}");
}

/// The drawing has all that the path has: two views of each number and ray.
#[test]
fn a_path_is_drawn() {
    let sandbox = Sandbox::new();
    for pixel in PIXELS {
        let told = told(&sandbox, pixel, &["--svg", "a.svg"]);
        let svg = sandbox.text("a.svg");
        let vertices = told["path"]["vertices"].as_array().expect("a list");
        let count = |what: &dyn Fn(&Value) -> bool| 2 * vertices.iter().filter(|vertex| what(vertex)).count();
        let has = |text: &str| svg.matches(text).count();
        assert_eq!(has("<circle class=\"hit"), count(&|vertex| !vertex["hit"].is_null()));
        assert_eq!(has("<line class=\"ray"), 2 * vertices.len());
        assert_eq!(has("class=\"shadow seen\""), count(&|vertex| vertex["sampled"]["arrives"] == true));
        assert_eq!(has("class=\"shadow hidden\""), count(&|vertex| vertex["sampled"]["arrives"] == false));
        assert_eq!((has("<g"), has("</g>"), has("<svg"), has("</svg>")), (4, 4, 1, 1));
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }
    assert_eq!(sandbox.files(), ["a.svg", "scene.ron"]);
}

#[test]
fn mistakes_are_told() {
    let sandbox = Sandbox::new();
    let ran = |more: &[&str]| sandbox.run(&[&["inspect", "scene.ron"][..], more].concat()).ends(2);
    ran(&["--pixel", "40,3"]).says(&["--pixel 40,3 does not lie in the picture", "40x24", "0,0 to 39,23"]);
    ran(&["--pixel", "4"]).says(&["expected column and row"]);
    ran(&[]).says(&["--pixel"]);
    ran(&["--pixel", "4,4", "--sample", "-1"]).says(&["--sample", "-1"]);
    ran(&["--pixel", "4,4", "--svg", "scene.ron"]).says(&["is to end in .svg"]);
    ran(&["--pixel", "4,4", "--svg", "-"]).says(&["standard output has the text"]);
    ran(&["--pixel", "4,4", "--set", "render.integrator=AmbientOcclusion()"]).says(&["follows no paths"]);
    let scene = sandbox.read("scene.ron");
    std::fs::rename(sandbox.path("scene.ron"), sandbox.path("scene.svg")).expect("renamed");
    let line = ["inspect", "scene.svg", "--syntax", "ron", "--pixel", "4,4", "--svg", "scene.svg"];
    sandbox.run(&line).ends(2).says(&["would replace a file of the scene"]);
    assert_eq!(sandbox.read("scene.svg"), scene);
}
