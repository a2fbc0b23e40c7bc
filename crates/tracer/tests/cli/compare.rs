//! `tracer compare`.

use crate::support::Sandbox;
use serde_json::Value;

fn with_pictures() -> Sandbox {
    let sandbox = Sandbox::new();
    for (name, seed) in [("a", "1"), ("b", "2")] {
        let (png, exr) = (format!("{name}.png"), format!("{name}.exr"));
        sandbox.run(&["render", "scene.ron", "-o", &png, "-o", &exr, "--seed", seed]).ends(0);
    }
    sandbox
}

#[test]
fn equal_pictures() {
    let sandbox = with_pictures();
    let ran = sandbox.run(&["compare", "a.png", "a.png", "--fail-above", "max=0"]).ends(0).silent();
    assert!(ran.out_text().contains("PSNR       infinite"), "{}", ran.out_text());
    sandbox.run(&["compare", "a.exr", "a.exr", "--fail-above", "flip-max=0"]).ends(0).silent();
}

#[test]
fn different_pictures() {
    let sandbox = with_pictures();
    let ran = sandbox.run(&["compare", "a.exr", "b.exr", "--json"]).ends(0).silent();
    let numbers: Value = serde_json::from_str(&ran.out_text()).expect("JSON");
    assert_eq!(numbers["compared"], "linear radiance");
    for metric in ["max", "rmse", "relmse", "psnr", "flip_mean", "flip_max"] {
        assert!(numbers[metric].as_f64().expect("a number") > 0.0, "{metric}");
    }
    assert!(numbers["flip_mean"].as_f64() < numbers["flip_max"].as_f64());
    // A picture for displays and one of radiance meet in display values.
    let ran = sandbox.run(&["compare", "a.png", "a.exr", "--json"]).ends(0);
    let numbers: Value = serde_json::from_str(&ran.out_text()).expect("JSON");
    assert_eq!(numbers["compared"], "display values");
    assert!(numbers["max"].as_f64().expect("a number") <= 0.5 / 255.0 + 1e-6);
}

#[test]
fn a_limit_decides() {
    let sandbox = with_pictures();
    let compare = |limits: &[&str]| sandbox.run(&[&["compare", "a.png", "b.png"][..], limits].concat());
    compare(&["--fail-above", "flip-mean=0.9", "--fail-above", "max=1"]).ends(0);
    let ran = compare(&["--fail-above", "flip-mean=0.9", "--fail-above", "max=0.0001"]).ends(1);
    assert!(ran.out_text().contains("max is above 0.0001"));
    assert!(!ran.out_text().contains("flip-mean is above"));
    let quiet = compare(&["--fail-above", "max=0.0001", "-q"]).ends(1).silent();
    assert_eq!(quiet.out_text(), "");
    compare(&["--fail-above", "0.1"]).ends(2).says(&["flip-mean=0.01"]);
    compare(&["--fail-above", "ssim=0.1"]).ends(2).says(&["ssim", "flip-mean"]);
    compare(&["--fail-above", "max=-1"]).ends(2).says(&["max=-1"]);
}

#[test]
fn a_map_in_false_colours() {
    let sandbox = with_pictures();
    sandbox.run(&["compare", "a.png", "b.png", "-o", "map.png"]).ends(0);
    let map = tracer::compare::Picture::load(&sandbox.path("map.png")).expect("a picture");
    assert_eq!((map.width, map.height), (40, 24));
    sandbox.run(&["compare", "a.png", "b.png", "-o", "map.exr"]).ends(2).says(&["map.exr", ".png"]);
    sandbox.run(&["compare", "a.png", "b.png", "-o", "no/map.png"]).ends(1).says(&["there is no folder no"]);
}

#[test]
fn what_cannot_be_compared() {
    let sandbox = with_pictures();
    sandbox.run(&["render", "scene.ron", "-o", "small.png", "--size", "20x12"]).ends(0);
    sandbox.run(&["compare", "a.png", "small.png"]).ends(2).says(&["40x24", "20x12"]);
    sandbox.run(&["compare", "a.png", "scene.ron"]).ends(2).says(&["scene.ron", "not a picture"]);
    sandbox.run(&["compare", "a.png", "nowhere.png"]).ends(2).says(&["nowhere.png"]);
    let mut broken = sandbox.read("a.png");
    broken.truncate(broken.len() / 2);
    sandbox.write("broken.png", broken);
    sandbox.run(&["compare", "broken.png", "a.png"]).ends(2).says(&["broken.png"]);
    let mut pixels = b"PF\n1 1\n-1.0\n".to_vec();
    pixels.extend([1.0f32, f32::NAN, 1.0].iter().flat_map(|x| x.to_le_bytes()));
    sandbox.write("nan.pfm", pixels);
    sandbox.run(&["compare", "nan.pfm", "nan.pfm"]).ends(2).says(&["pixel (0, 0) is not finite"]);
}

/// Pictures of the same names; one that is in one folder alone fails.
#[test]
fn folders() {
    let sandbox = with_pictures();
    for (folder, deep) in [("new", "new/deep"), ("old", "old/deep"), ("empty", "empty")] {
        std::fs::create_dir_all(sandbox.path(deep)).expect("folders");
        if folder != "empty" {
            sandbox.write(&format!("{folder}/a.png"), sandbox.read("a.png"));
        }
    }
    sandbox.write("new/deep/b.exr", sandbox.read("a.exr"));
    sandbox.write("old/deep/b.exr", sandbox.read("b.exr"));
    let table = sandbox.run(&["compare", "new", "old"]).ends(0).silent().out_text();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines.len(), 4, "{table}");
    assert!(lines[1].starts_with("a.png ") && lines[1].ends_with(" equal"), "{table}");
    assert!(lines[2].starts_with("deep/b.exr ") && lines[2].ends_with(" differs"), "{table}");
    assert_eq!(lines[3], "2 pictures, 1 equal, 0 failed");
    let table = sandbox.run(&["compare", "new", "old", "--fail-above", "max=0"]).ends(1).out_text();
    assert!(table.contains("max above the limit") && table.contains("1 failed"), "{table}");
    sandbox.write("new/extra.png", sandbox.read("b.png"));
    // As of two files: 1 says that all were compared.
    let ran = sandbox.run(&["compare", "new", "old", "--json"]).ends(2);
    let pairs: Value = serde_json::from_str(&ran.out_text()).expect("JSON");
    assert_eq!((&pairs[0]["verdict"], &pairs[0]["max"]), (&"equal".into(), &0.0.into()));
    assert_eq!((&pairs[2]["picture"], &pairs[2]["verdict"]), (&"extra.png".into(), &"is in new alone".into()));
    assert_eq!(pairs[2]["passed"], false);
    sandbox.run(&["compare", "new", "old", "-o", "map.png"]).ends(2).says(&["two folders"]);
    sandbox.run(&["compare", "new", "a.png"]).ends(2).says(&["new: it is a folder", "two folders"]);
    sandbox.run(&["compare", "empty", "empty"]).ends(2).says(&["there is no picture in empty"]);
    sandbox.run(&["render", "scene.ron", "-o", "old/extra.png", "--size", "20x12"]).ends(0);
    let sizes = sandbox.run(&["compare", "new", "old", "--fail-above", "max=0"]).ends(2).out_text();
    assert!(sizes.contains("is 40x24, and 20x12") && sizes.contains("max above the limit"), "{sizes}");
    sandbox.write("old/extra.png", "no picture");
    sandbox.run(&["compare", "new", "old"]).ends(2).says(&["old/extra.png is not a picture"]);
}
