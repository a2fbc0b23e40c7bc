//! What pictures tell of themselves, and what can be made of it: `info`, `new --from`, `repro`, `--no-metadata`.

use crate::support::{SCENE, Sandbox};
use serde_json::Value;
use std::fs;

/// A scene of a mesh with a material file and a texture, in a folder of its own, with two cameras.
fn with_files(sandbox: &Sandbox) {
    fs::create_dir_all(sandbox.path("scenes/assets")).expect("folders");
    let quad = "mtllib quad.mtl\nv -1 0 0\nv 1 0 0\nv 1 2 0\nv -1 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                usemtl red\nf 1/1 2/2 3/3 4/4\n";
    sandbox.write("scenes/assets/quad.obj", quad);
    sandbox.write("scenes/assets/quad.mtl", "newmtl red\nKd 0.8 0.1 0.1\n");
    let cameras = r#"camera: "front", cameras: {
        "front": Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
        "above": Camera(position: (0, 9, 1), look_at: (0, 0.5, 0), fov: 40),
    },"#;
    let scene = SCENE.replace("camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),", cameras).replace(
        "objects: [",
        "objects: [\n        Mesh(file: \"assets/quad.obj\", transform: [Translate((0, 0, -2))]),",
    );
    sandbox.write("scenes/a.ron", scene);
}

const OPTIONS: [&str; 10] =
    ["--samples", "3", "--seed", "7", "--camera", "above", "--set", "background=0.5", "--exposure", "-0.5"];

#[test]
fn pictures_are_made_again_to_the_byte() {
    let sandbox = Sandbox::new();
    with_files(&sandbox);
    let pictures = ["scenes/a.png", "scenes/a.exr"];
    let others = ["--layers", "depth", "--crop", "4,2,20,16"];
    let render = ["render", "scenes/a.ron", "-o", pictures[0], "-o", pictures[1]];
    sandbox.run(&[&render[..], &OPTIONS, &others].concat()).ends(0);
    for picture in pictures {
        sandbox.run(&["repro", picture]).ends(0).says(&["made again, the same bytes"]);
    }
    sandbox
        .run(&["render", "scenes/a.ron", "-o", "scenes/d.png", "--bits", "16", "--denoise", "--samples", "4"])
        .ends(0);
    sandbox.run(&["repro", "scenes/d.png", "-q"]).ends(0).silent();
    // A layer in place of the picture.
    for layer in ["depth", "material_id"] {
        sandbox.run(&["render", "scenes/a.ron", "-o", "scenes/s.png", "--show", layer, "--samples", "2"]).ends(0);
        sandbox.run(&["repro", "scenes/s.png"]).ends(0).says(&["made again, the same bytes"]);
        let told = sandbox.run(&["info", "scenes/s.png"]).ends(0).out_text();
        assert!(told.contains(&format!("--show {layer}")), "{told}");
    }
    // What a checkpoint or parts have gone through tells the same.
    let kept = ["--checkpoint", "a.checkpoint"];
    sandbox.run(&[&["render", "scenes/a.ron", "-o", "b.exr"], &OPTIONS[..], &others, &kept].concat()).ends(0);
    assert_eq!(sandbox.read("b.exr"), sandbox.read("scenes/a.exr"));
    sandbox.run(&["merge", "a.checkpoint", "-o", "c.png"]).ends(0);
    assert_eq!(sandbox.read("c.png"), sandbox.read("scenes/a.png"));
    // Elsewhere it needs to be told where the files lie.
    sandbox.run(&["repro", "c.png"]).ends(1).says(&["assets/quad.obj is missing", "--scene FILE"]);
    sandbox.run(&["repro", "c.png", "--scene", "scenes/a.ron", "-o", "d.png"]).ends(0);
    assert_eq!(sandbox.read("d.png"), sandbox.read("c.png"));
}

/// A goal of noise has ended where it has.
#[test]
fn what_a_goal_ended_is_made_again() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "--noise", "30%", "--samples", "200"]).ends(0);
    sandbox.run(&["repro", "scene.png"]).ends(0).says(&["the same bytes"]);
    sandbox.run(&["new", "again.ron", "--from", "scene.png"]).ends(0);
    sandbox.run(&["render", "again.ron"]).ends(0);
    let pixels = |name: &str| image::open(sandbox.path(name)).expect("a picture").to_rgb8();
    assert_eq!(pixels("again.png"), pixels("scene.png"));
}

#[test]
fn why_it_is_not_the_same_is_told() {
    let sandbox = Sandbox::new();
    with_files(&sandbox);
    sandbox.run(&["render", "scenes/a.ron"]).ends(0);
    let file = sandbox.text("scenes/assets/quad.mtl");
    sandbox.write("scenes/assets/quad.mtl", file.replace("0.8", "0.2"));
    let ran = sandbox.run(&["repro", "scenes/a.png"]).ends(1);
    ran.says(&["is not made again: the contents of assets/quad.mtl have changed"]);
    let ran = sandbox.run(&["repro", "scenes/a.png", "-o", "now.png"]).ends(1);
    ran.says(&["assets/quad.mtl have changed", "pixels have another colour"]);
    assert!(sandbox.path("now.png").exists());
    fs::remove_file(sandbox.path("scenes/assets/quad.obj")).expect("it is there");
    sandbox.run(&["repro", "scenes/a.png"]).ends(1).says(&["scenes/assets/quad.obj is missing"]);

    // The scene's text is in the picture; that the file has changed is said.
    sandbox.run(&["render", "scene.ron"]).ends(0);
    sandbox.write("scene.ron", SCENE.replace("reflectance: 0.9", "reflectance: 0.5"));
    sandbox.run(&["repro", "scene.png"]).ends(0).says(&["scene.ron has changed since", "the same bytes"]);
    let picture = sandbox.read("scene.png");

    // Edited, or saved by a program that keeps texts.
    let edited = edit(&picture, |pixels| pixels[7] ^= 0x40, |text| text.to_owned());
    sandbox.write("edited.png", edited);
    sandbox.run(&["repro", "edited.png"]).ends(1).says(&["1 of 960 pixels", "it was edited afterwards"]);
    sandbox.write("saved.png", edit(&picture, |_| (), |text| text.to_owned()));
    sandbox.run(&["repro", "saved.png"]).ends(0).says(&["the same colours in other bytes"]);
    sandbox.write("old.png", edit(&picture, |_| (), |text| text.replace("\"program\":\"0", "\"program\":\"9")));
    sandbox.run(&["repro", "old.png"]).ends(0).says(&["the same colours", "it was made by tracer 9"]);
    let cut = |text: &str| text.replace("\"samples\":[2,2]", "\"samples\":[1,2]");
    sandbox.write("cut.png", edit(&picture, |_| (), cut));
    sandbox.run(&["repro", "cut.png"]).ends(1).says(&["some pixels had 1 samples and others 2"]);
}

/// The same PNG with other pixels and another record, compressed by another program.
fn edit(file: &[u8], pixels: impl Fn(&mut [u8]), record: impl Fn(&str) -> String) -> Vec<u8> {
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().expect("a picture");
    let mut data = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut data).expect("pixels");
    pixels(&mut data);
    let mut info = png::Info::with_size(reader.info().width, reader.info().height);
    (info.color_type, info.bit_depth) = (png::ColorType::Rgb, png::BitDepth::Eight);
    info.utf8_text = reader.info().utf8_text.clone();
    for chunk in &mut info.utf8_text {
        if chunk.keyword == "tracer" {
            let text = record(&chunk.get_text().expect("text"));
            *chunk = png::text_metadata::ITXtChunk::new("tracer", text);
        }
    }
    let mut bytes = Vec::new();
    let mut writer = png::Encoder::with_info(&mut bytes, info).and_then(png::Encoder::write_header).expect("a head");
    writer.write_image_data(&data).expect("pixels");
    writer.finish().expect("a file");
    bytes
}

/// A picture is no reason to read or write what nobody has named.
#[test]
fn pictures_that_mean_ill_are_refused() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron"]).ends(0);
    let picture = sandbox.read("scene.png");
    let with = |name: &str, from: &str, to: &str| {
        let changed = edit(
            &picture,
            |_| (),
            |text| {
                assert!(text.contains(from), "{from} is not in {text}");
                text.replace(from, to)
            },
        );
        sandbox.write(name, changed);
        sandbox.run(&["repro", name])
    };
    with("a.png", "\"size\":[40,24]", "\"size\":[65537,24]").ends(2).says(&["is damaged"]);
    let size = |size: &str, crop: &str| {
        format!("\"size\":[{size}],\"samples\":[2,2],\"seed\":0,\"exposure\":0.0,\"crop\":[0,0,{crop}]")
    };
    with("b.png", &size("40,24", "40,24"), &size("65536,65536", "65536,65536")).ends(1).says(&["of memory"]);
    with("c.png", "\"record\":1", "\"record\":2").ends(2).says(&["another version of tracer"]);
    let files = "\"files\":[{\"name\":\"/dev/zero\",\"sha256\":\"00\"}]";
    with("d.png", "\"files\":[]", files).ends(1).says(&["/dev/zero is missing"]);
    with("e.png", "\"scene\":\"scene.ron\"", "\"scene\":\"\\u001b[2J.ron\"").ends(0);
    with("f.png", "\"set\":[]", "\"set\":[\"no.such=1\"]").ends(2);
    for length in [0, 7, 40, 120, 300, picture.len() / 2] {
        sandbox.write("cut.png", &picture[..length]);
        let ran = sandbox.run(&["repro", "cut.png"]);
        assert!(matches!(ran.code, Some(1 | 2)) && ran.err.starts_with("error: "), "{length}: {ran:?}");
    }
    sandbox.run(&["repro", "none.png"]).ends(2).says(&["there is no picture none.png"]);
    sandbox.run(&["repro", "scene.ron"]).ends(2).says(&["no PNG, EXR, HDR or PFM"]);
    for output in ["scene.png", "scene.ron", "again.exr", "again.png/x.png", "-"] {
        let ran = sandbox.run(&["repro", "scene.png", "-o", output]);
        assert!(matches!(ran.code, Some(1 | 2)), "{output}: {ran:?}");
    }
    assert_eq!((sandbox.read("scene.png"), sandbox.text("scene.ron").as_str()), (picture, SCENE));
}

#[test]
fn the_scene_comes_back_as_it_was_rendered() {
    let sandbox = Sandbox::new();
    with_files(&sandbox);
    // Of the text alone, comments and all.
    sandbox.run(&["render", "scene.ron"]).ends(0);
    sandbox.run(&["new", "b.ron", "--from", "scene.png"]).ends(0).says(&["see it by: tracer render b.ron -o b.png"]);
    assert_eq!(sandbox.text("b.ron"), SCENE);
    sandbox.run(&["new", "b.ron", "--from", "scene.png"]).ends(2).says(&["there already"]);
    sandbox.run(&["new", "scene.toml", "--from", "scene.png"]).ends(0);
    sandbox.run(&["render", "scene.toml", "-o", "t.png"]).ends(0);
    // With options it is what they made of it.
    sandbox.run(&[&["render", "scenes/a.ron", "-o", "a.exr", "--layers", "depth"], &OPTIONS[..]].concat()).ends(0);
    let ran = sandbox.run(&["new", "scenes/c.ron", "--from", "a.exr"]).ends(0);
    ran.says(&["its comments are not"]);
    sandbox.run(&["render", "scenes/c.ron", "-o", "c.exr"]).ends(0);
    let pixels = |name: &str| tracer::compare::Picture::load(&sandbox.path(name)).expect("a picture");
    assert_eq!(pixels("c.exr"), pixels("a.exr"));
    sandbox.run(&["new", "scenes/d.ron", "--from", "a.exr", "--as-written"]).ends(0);
    assert_eq!(sandbox.text("scenes/d.ron"), sandbox.text("scenes/a.ron"));
    // What it needs is not everywhere.
    sandbox.run(&["new", "e.ron", "--from", "a.exr"]).ends(0).says(&["warning: assets/quad.obj is not there"]);
    sandbox.run(&["render", "scene.ron", "-o", "scene.hdr"]).ends(0);
    sandbox.run(&["new", "f.ron", "--from", "scene.hdr"]).ends(2).says(&["does not hold the text of its scene"]);
    sandbox.run(&["new", "scene.ron", "--from", "scene.ron", "--force"]).ends(2);
    assert_eq!(sandbox.text("scene.ron"), SCENE);
}

#[test]
fn info_tells_what_made_a_picture() {
    let sandbox = Sandbox::new();
    with_files(&sandbox);
    sandbox.run(&[&["render", "scenes/a.ron", "--report", "r.json"], &OPTIONS[..]].concat()).ends(0);
    let text = sandbox.run(&["info", "scenes/a.png"]).ends(0).silent().out_text();
    let words =
        ["PNG, 8 bits, 40x24 pixels", "a.ron, its text is in the picture", "assets/quad.mtl  SHA-256", "--seed 7"];
    for word in words {
        assert!(text.contains(word), "{word} is not in:\n{text}");
    }
    let json: Value =
        serde_json::from_str(&sandbox.run(&["info", "scenes/a.png", "--json"]).ends(0).out_text()).expect("JSON");
    assert_eq!(json["scene"], sandbox.text("scenes/a.ron"));
    let report: Value = serde_json::from_str(&sandbox.text("r.json")).expect("JSON");
    assert_eq!(report["scene"]["assets"], json["record"]["assets"]);
    // As a shell reckons it.
    let line = "sha256sum scenes/assets/quad.* | cut -c1-64 | sort | sha256sum | cut -c1-64";
    assert_eq!(sandbox.shell(line).ends(0).out_text().trim(), json["record"]["assets"].as_str().expect("a hash"));
    // The command makes the picture, where the scene is.
    let command = json["command"].as_str().expect("a command").replace("tracer render", "\"$T\" render");
    let before = sandbox.read("scenes/a.png");
    sandbox.shell(&format!("cd scenes && rm a.png && {command}")).ends(0);
    assert_eq!(sandbox.read("scenes/a.png"), before);
    sandbox.run(&["info", "scenes/a.png", "--resolved"]).ends(2).says(&["is a picture"]);
    // One that another program has made.
    let other = image::RgbImage::from_pixel(3, 2, image::Rgb([1, 2, 3]));
    other.save(sandbox.path("other.png")).expect("a file");
    let text = sandbox.run(&["info", "other.png"]).ends(0).out_text();
    assert!(text.contains("3x2 pixels") && text.contains("not told"), "{text}");
    sandbox.run(&["repro", "other.png"]).ends(2).says(&["does not tell how it was made"]);
    sandbox.write("bad.png", &before[..60]);
    sandbox.run(&["info", "bad.png"]).ends(2).says(&["its head cannot be read"]);
}

/// Where things lie on a machine is nobody's business: a picture has the names of the scene's own text.
#[test]
fn no_path_of_the_machine_is_in_a_picture() {
    let sandbox = Sandbox::new();
    with_files(&sandbox);
    let folder = sandbox.path("").to_string_lossy().trim_end_matches('/').to_owned();
    let scene = sandbox.path("scenes/a.ron").to_string_lossy().into_owned();
    sandbox.run(&["render", &scene, "-o", "a.exr"]).ends(0);
    let bytes = sandbox.read("a.exr");
    assert!(!bytes.windows(folder.len()).any(|part| part == folder.as_bytes()));
    let info = sandbox.run(&["info", "a.exr", "--json"]).ends(0).out_text();
    assert!(info.contains("assets/quad.mtl") && !info.contains(&folder), "{info}");
}

#[test]
fn without_metadata_the_same_picture_is_the_same_bytes() {
    let sandbox = Sandbox::new();
    sandbox.write("other.ron", format!("// Another text of the same scene.\n{SCENE}"));
    for kind in ["png", "exr", "hdr", "pfm"] {
        let [a, b] = ["a", "b"].map(|name| format!("{name}.{kind}"));
        sandbox.run(&["render", "scene.ron", "-o", &a, "--no-metadata"]).ends(0);
        sandbox.run(&["render", "other.ron", "-o", &b, "--no-metadata", "--exposure", "0"]).ends(0);
        assert_eq!(sandbox.read(&a), sandbox.read(&b), "{kind}");
        let bytes = sandbox.read(&a);
        for word in ["tracer", "scene", "Comment", "samples"] {
            assert!(!bytes.windows(word.len()).any(|part| part == word.as_bytes()), "{word} is in the {kind}");
        }
    }
    sandbox.run(&["repro", "a.png"]).ends(2).says(&["--no-metadata"]);
    sandbox.run(&["render", "scene.ron", "--part", "1/1", "-o", "p.tracer"]).ends(0);
    sandbox.run(&["merge", "p.tracer", "-o", "m.png", "--no-metadata"]).ends(0);
    assert_eq!(sandbox.read("m.png"), sandbox.read("a.png"));
}
