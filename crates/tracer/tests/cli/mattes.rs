//! Cryptomatte and masks in EXR files, and what is said where there is no place for them.

use crate::support::{Sandbox, channels};
use exr::prelude::read_all_flat_layers_from_file;
use serde_json::Value;
use std::collections::BTreeMap;

const SCENE: &str = r##"Scene(
    camera: Camera(position: (0, 0, 10), look_at: (0, 0, 0), fov: 30),
    image: Image(width: 32, height: 32),
    render: Render(samples: 8, max_bounces: 1),
    background: 0.5,
    lights: [SphereLight(center: (1.5, 1.5, 0), radius: 0.5, radiance: 5, name: "lamp")],
    materials: { "red \"wood\"": Diffuse(albedo: "#aa2211") },
    objects: [
        Sphere(center: (-1, 0, 0), radius: 1, material: "red \"wood\"", name: "ball"),
        Sphere(center: (1, -1, 0), radius: 0.8, material: Mirror(), name: "ball"),
        Box(center: (0, 1.8, -1), size: 1),
    ],
)"##;

const CRYPTOMATTE: [&str; 4] =
    ["--set", "output.cryptomatte=[Objects, Materials]", "--set", "output.masks=[\"ball\", \"lamp\"]"];

fn sandbox() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("scene.ron", SCENE);
    sandbox
}

/// The channels of an EXR file, and its attributes of Cryptomatte.
fn picture(sandbox: &Sandbox, name: &str) -> (BTreeMap<String, Vec<f32>>, BTreeMap<String, String>) {
    let image = read_all_flat_layers_from_file(sandbox.path(name)).expect("an EXR file");
    let layer = &image.layer_data[0];
    let others = layer.attributes.other.iter().chain(&image.attributes.other);
    let attributes = others.filter_map(|(name, value)| match value {
        exr::prelude::AttributeValue::Text(text) => Some((name.to_string(), text.to_string())),
        _ => None,
    });
    let attributes = attributes.filter(|(name, _)| name.starts_with("cryptomatte/")).collect();
    (channels(sandbox, name), attributes)
}

fn render(sandbox: &Sandbox, name: &str, more: &[&str]) {
    sandbox.run(&[&["render", "scene.ron", "-q", "-o", name][..], &CRYPTOMATTE, more].concat()).ends(0).silent();
}

/// The share of each pixel that a name covers, as a decoder finds it.
fn decoded(
    channels: &BTreeMap<String, Vec<f32>>,
    attributes: &BTreeMap<String, String>,
    kind: &str,
    name: &str,
) -> Vec<f32> {
    let key = attributes.iter().find(|(key, value)| key.ends_with("/name") && *value == kind).expect("a name").0;
    let manifest = &attributes[&key.replace("/name", "/manifest")];
    let manifest: BTreeMap<String, String> = serde_json::from_str(manifest).expect("JSON");
    let id = u32::from_str_radix(&manifest[name], 16).expect("a number");
    let mut shares = vec![0.0; 32 * 32];
    for (id_of, share_of) in [("R", "G"), ("B", "A")] {
        for k in 0..3 {
            let of = |channel: &str| &channels[&format!("{kind}{k:02}.{channel}")];
            for ((sum, found), share) in shares.iter_mut().zip(of(id_of)).zip(of(share_of)) {
                *sum += if found.to_bits() == id { *share } else { 0.0 };
            }
        }
    }
    shares
}

#[test]
fn names_are_found_in_pixels() {
    let sandbox = sandbox();
    render(&sandbox, "a.exr", &["--layers", "albedo,alpha"]);
    let (channels, attributes) = picture(&sandbox, "a.exr");
    // Nothing is there but what was asked for: not the layers that mattes are made of.
    let names: Vec<&str> = channels.keys().map(String::as_str).filter(|name| !name.starts_with("Crypto")).collect();
    let asked = ["B", "G", "R", "albedo.B", "albedo.G", "albedo.R", "alpha.A", "mask.ball.Y", "mask.lamp.Y"];
    assert_eq!((names, channels.len()), (asked.to_vec(), 24 + 9));
    let told: Vec<(&str, &str)> = attributes
        .iter()
        .filter(|(key, _)| !key.ends_with("/manifest"))
        .map(|(key, value)| (key.as_str(), value.as_str()))
        .collect();
    let expected = [
        ("cryptomatte/3ae39a5/conversion", "uint32_to_float32"),
        ("cryptomatte/3ae39a5/hash", "MurmurHash3_32"),
        ("cryptomatte/3ae39a5/name", "CryptoObject"),
        ("cryptomatte/be359d6/conversion", "uint32_to_float32"),
        ("cryptomatte/be359d6/hash", "MurmurHash3_32"),
        ("cryptomatte/be359d6/name", "CryptoMaterial"),
    ];
    assert_eq!((told, attributes.len()), (expected.to_vec(), 8));
    // Both balls are one; the box stands where it stands.
    let ball = decoded(&channels, &attributes, "CryptoObject", "ball");
    assert_eq!(ball, channels["mask.ball.Y"]);
    assert_eq!(decoded(&channels, &attributes, "CryptoObject", "lamp"), channels["mask.lamp.Y"]);
    let cube = decoded(&channels, &attributes, "CryptoObject", "objects[2] Box");
    let sums = ball.iter().zip(&channels["mask.lamp.Y"]).zip(&cube).map(|((a, b), c)| a + b + c);
    assert!(sums.zip(&channels["alpha.A"]).all(|(sum, alpha)| (sum - alpha).abs() < 1e-5));
    assert!(ball[16 * 32 + 10] == 1.0 && ball.iter().any(|&x| x > 0.0 && x < 1.0) && ball[0] == 0.0);
    // Materials by their names, whatever is in these; those without by their objects.
    let wood = decoded(&channels, &attributes, "CryptoMaterial", "red \"wood\"");
    let mirror = decoded(&channels, &attributes, "CryptoMaterial", "objects[1].material");
    let default = decoded(&channels, &attributes, "CryptoMaterial", "default");
    assert!(wood.iter().zip(&mirror).zip(&ball).all(|((a, b), ball)| (a + b - ball).abs() < 1e-6));
    assert!(default.iter().zip(&cube).all(|(a, b)| a == b));
    // Who reads pictures finds the picture, the same as without.
    sandbox.run(&["render", "scene.ron", "-q", "-o", "plain.exr"]).ends(0).silent();
    sandbox.run(&["compare", "a.exr", "plain.exr", "--fail-above", "max=0"]).ends(0);
}

#[test]
fn the_same_bytes_by_checkpoints_and_parts() {
    let sandbox = sandbox();
    render(&sandbox, "whole.exr", &[]);
    render(&sandbox, "again.exr", &["-j", "1"]);
    assert!(sandbox.read("whole.exr") == sandbox.read("again.exr"));
    render(&sandbox, "less.exr", &["--resume", "c.film", "-s", "3"]);
    render(&sandbox, "more.exr", &["--resume", "c.film", "-s", "8"]);
    let same = |other: &str| {
        let [(a, told), (b, of_other)] = ["whole.exr", other].map(|name| picture(&sandbox, name));
        let bits = |of: BTreeMap<String, Vec<f32>>| {
            of.into_iter()
                .map(|(name, x)| (name, x.iter().map(|x| x.to_bits()).collect::<Vec<_>>()))
                .collect::<Vec<_>>()
        };
        assert!(bits(a) == bits(b) && told == of_other, "{other}");
    };
    same("more.exr");
    for (k, n) in [(1, 2), (2, 2)] {
        render(&sandbox, &format!("{k}.tracer"), &["--part", &format!("{k}/{n}"), "--split", "samples"]);
    }
    sandbox.run(&["merge", "2.tracer", "1.tracer", "-q", "-o", "merged.exr"]).ends(0).silent();
    same("merged.exr");
    let told = sandbox.run(&["info", "c.film"]).ends(0).silent().out_text();
    assert!(told.contains("\nmattes     CryptoObject, CryptoMaterial, mask.ball, mask.lamp\n"), "{told}");
    // Another choice is refused, and named; of parts other masks are, too.
    let other = ["render", "scene.ron", "-o", "b.exr", "--resume", "c.film", "-s", "9"];
    let said = "the choice of mattes is CryptoObject, CryptoMaterial, mask.ball, mask.lamp there and none here";
    let ran = sandbox.run(&other).ends(2).says(&[said]);
    assert!(!ran.err.contains("the set of layers"), "{}", ran.err);
    let masks = ["--set", "output.masks=[\"lamp\"]", "--set", "output.cryptomatte=[Objects, Materials]"];
    let part = ["render", "scene.ron", "-q", "-o", "3.tracer", "--part", "2/2", "--split", "samples"];
    sandbox.run(&[&part[..], &masks].concat()).ends(0);
    let ran = sandbox.run(&["merge", "1.tracer", "3.tracer", "-o", "merged.exr"]).ends(2);
    ran.says(&["the choice of mattes is CryptoObject, CryptoMaterial, mask.lamp there"]);
}

/// Names of channels are bytes of UTF-8, in manifests they are JSON; and where a mask shows nothing it is 0, not -0.
#[test]
fn names_may_be_of_any_script() {
    let sandbox = sandbox();
    sandbox.write("scene.ron", SCENE.replace("\"lamp\"", "\"日本 é\""));
    let masks = ["--set", "output.masks=[\"日本 é\", \"ball\"]", "--set", "output.cryptomatte=[Objects]"];
    sandbox.run(&[&["render", "scene.ron", "-q", "-o", "a.exr"][..], &masks].concat()).ends(0).silent();
    let name = "mask.日本 é.Y\0".as_bytes();
    assert!(sandbox.read("a.exr").windows(name.len()).any(|window| window == name));
    let (channels, attributes) = picture(&sandbox, "a.exr");
    assert!(decoded(&channels, &attributes, "CryptoObject", "日本 é").iter().any(|&share| share > 0.5));
    let masks: Vec<&f32> = channels.iter().filter(|(name, _)| name.starts_with("mask.")).flat_map(|of| of.1).collect();
    assert_eq!(masks.len(), 2 * 32 * 32);
    assert!(masks.iter().any(|&&x| x == 0.0) && masks.iter().all(|x| x.is_sign_positive()));
}

#[test]
fn what_is_no_mask_is_told_and_so_is_no_place() {
    let sandbox = sandbox();
    let ran = sandbox.run(&["check", "scene.ron", "--set", "output.masks=[\"bal\", \"lamp\"]"]).ends(2);
    ran.says(&["E0410", "no object has the name \"bal\"", "did you mean `ball`?"]);
    let ran = sandbox.run(&["render", "scene.ron", "-o", "a.png", CRYPTOMATTE[0], CRYPTOMATTE[1]]).ends(0);
    ran.says(&["warning: the scene's mattes (CryptoObject, CryptoMaterial) are written into EXR only; add -o a.exr"]);
    let arguments = ["render", "scene.ron", "-q", "-o", "a.exr", "--report", "r.json"];
    sandbox.run(&[&arguments[..], &CRYPTOMATTE].concat()).ends(0);
    let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
    let names = serde_json::json!(["CryptoObject", "CryptoMaterial", "mask.ball", "mask.lamp"]);
    assert_eq!(report["picture"]["layers"], names);
}

/// What is behind everything is named, not the layer that it needs; of parts one picture is made, so it is the same.
#[test]
fn another_backdrop_is_named() {
    let sandbox = sandbox();
    let run = |name: &str, more: &[&str]| {
        sandbox.run(&[&["render", "scene.ron", "-q", "-s", "4", "-o", name][..], more].concat())
    };
    let (clear, paper) = (["--set", "output.alpha=true"], ["--set", "output.backdrop=1"]);
    run("a.exr", &["--resume", "c.film"]).ends(0);
    let ran = run("a.exr", &[&["--resume", "c.film"][..], &clear].concat()).ends(2);
    let ran = ran.says(&["the backdrop is the background there and nothing (alpha) here"]);
    assert!(!ran.err.contains("layers"), "{}", ran.err);
    // One that can be laid under later is no reason to begin anew.
    run("a.exr", &[&["--resume", "d.film"][..], &clear].concat()).ends(0);
    run("a.png", &[&["--resume", "d.film"][..], &paper].concat()).ends(0);
    run("paper.png", &paper).ends(0);
    assert!(sandbox.read("a.png") == sandbox.read("paper.png"));
    run("1.tracer", &[&["--part", "1/2"][..], &clear].concat()).ends(0);
    run("2.tracer", &[&["--part", "2/2"][..], &paper].concat()).ends(0);
    let ran = sandbox.run(&["merge", "1.tracer", "2.tracer", "-o", "m.png"]).ends(2);
    ran.says(&[
        "2.tracer is of another rendering than 1.tracer",
        "the backdrop is 1 1 1 there and nothing (alpha) here",
    ]);
}
