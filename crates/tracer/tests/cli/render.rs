//! `tracer render`: the files it writes, and that they depend on nothing but scene, seed and samples.

use crate::support::{Ran, SCENE, Sandbox};
use tracer::compare::{Kind, Picture};

/// The text chunks of a PNG that are not compressed: keyword and text.
fn png_texts(bytes: &[u8]) -> Vec<[String; 2]> {
    let reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let text = |chunk: &png::text_metadata::ITXtChunk| [chunk.keyword.clone(), chunk.get_text().expect("readable")];
    reader.info().utf8_text.iter().map(text).collect()
}

#[test]
fn every_kind_of_picture_by_extension() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "a.png", "-o", "a.exr", "-o", "a.hdr", "-o", "a.PFM"]).ends(0).silent();
    assert_eq!(sandbox.files(), ["a.PFM", "a.exr", "a.hdr", "a.png", "scene.ron"]);
    let load = |name: &str| Picture::load(&sandbox.path(name)).expect("a picture");
    let (png, exr, hdr, pfm) = (load("a.png"), load("a.exr"), load("a.hdr"), load("a.PFM"));
    for picture in [&png, &exr, &hdr, &pfm] {
        assert_eq!((picture.width, picture.height), (40, 24));
    }
    assert_eq!((png.kind, exr.kind), (Kind::Display, Kind::Linear));
    assert_eq!(exr.values, pfm.values);
    assert!(exr.values.iter().any(|&value| value > 1.0), "the light is brighter than white");
    for (k, (rgbe, exact)) in hdr.values.chunks(3).zip(exr.values.chunks(3)).enumerate() {
        let most = exact.iter().copied().fold(0.0, f32::max);
        for c in 0..3 {
            // Half a step of 8 bits of mantissa, 1/256 of the largest channel.
            assert!((rgbe[c] - exact[c]).abs() <= most / 256.0 * 1.0001, "pixel {k}: {rgbe:?} {exact:?}");
        }
    }
    for (code, display) in png.values.iter().zip(exr.display()) {
        // Half a code value, and the rounding of f32.
        assert!((code - display).abs() <= 0.5 / 255.0 + 1e-6);
    }
}

#[test]
fn sixteen_bits_are_nearer() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "a.png", "-o", "a.pfm", "--bits", "16"]).ends(0);
    let load = |name: &str| Picture::load(&sandbox.path(name)).expect("a picture");
    for (code, display) in load("a.png").values.iter().zip(load("a.pfm").display()) {
        assert!((code - display).abs() <= 0.5 / 65535.0 + 1e-6);
    }
}

#[test]
fn pictures_say_what_they_were_made_from() {
    let sandbox = Sandbox::new();
    let arguments =
        ["render", "scene.ron", "-o", "a.png", "-o", "a.exr", "-o", "a.hdr", "--seed", "7", "--samples", "3"];
    sandbox.run(&[&arguments[..], &["--set", "camera.fov=50"]].concat()).ends(0);
    let texts = png_texts(&sandbox.read("a.png"));
    let text = |keyword: &str| texts.iter().find(|text| text[0] == keyword).map_or("", |text| text[1].as_str());
    assert_eq!(text("Software"), concat!("tracer ", env!("CARGO_PKG_VERSION")));
    assert_eq!(text("Source"), "scene.ron");
    assert_eq!(text("Scene"), SCENE);
    for setting in ["samples 3", "seed 7", "size 40x24", "set camera.fov=50"] {
        assert!(text("Comment").contains(setting), "{setting}: {}", text("Comment"));
    }
    let reader = png::Decoder::new(std::io::Cursor::new(sandbox.read("a.png"))).read_info().expect("a PNG");
    assert!(reader.info().srgb.is_some(), "says that it is sRGB");
    for name in ["a.exr", "a.hdr"] {
        let bytes = sandbox.read(name);
        let file = String::from_utf8_lossy(&bytes);
        for word in ["tracer 0.", "scene.ron", "samples 3", "seed 7"] {
            assert!(file.contains(word), "{name}: {word}");
        }
    }
    assert!(String::from_utf8_lossy(&sandbox.read("a.exr")).contains(SCENE));
}

/// Threads, lanes, and a second run: the same bytes.
#[test]
fn the_bytes_depend_on_the_scene_alone() {
    let sandbox = Sandbox::new();
    let outputs = ["-o", "a.png", "-o", "a.exr", "-o", "a.hdr"];
    let render = |threads: &str, lanes: Option<&str>| {
        let mut command = sandbox.command(&[&["render", "scene.ron", "--threads", threads][..], &outputs].concat());
        if let Some(lanes) = lanes {
            command.env("TRACER_LANES", lanes);
        }
        let ran = Ran::of(&mut command);
        // A CPU without AVX2 or AVX-512 says so.
        if ran.code == Some(1) && ran.err.contains("this CPU computes in") {
            return None;
        }
        ran.ends(0).silent();
        Some(["a.png", "a.exr", "a.hdr"].map(|name| sandbox.read(name)))
    };
    let first = render("1", None);
    assert!(first.is_some());
    for threads in ["1", "2", "3", "7"] {
        assert!(render(threads, None) == first, "{threads} threads give another picture");
    }
    for lanes in ["1", "8", "16"] {
        if let Some(pictures) = render("2", Some(lanes)) {
            assert!(Some(pictures) == first, "{lanes} lanes give another picture");
        }
    }
}

#[test]
fn a_crop_is_that_part_of_the_whole() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "whole.pfm"]).ends(0);
    let whole = Picture::load(&sandbox.path("whole.pfm")).expect("a picture");
    for [x, y, width, height] in [[0, 0, 1, 1], [5, 3, 17, 9], [39, 23, 1, 1], [0, 8, 40, 8]] {
        let crop = format!("{x},{y},{width},{height}");
        sandbox.run(&["render", "scene.ron", "-o", "part.pfm", "--crop", &crop]).ends(0);
        let part = Picture::load(&sandbox.path("part.pfm")).expect("a picture");
        assert_eq!((part.width, part.height), (width, height));
        for row in 0..height as usize {
            let at = 3 * ((y as usize + row) * 40 + x as usize);
            let length = 3 * width as usize;
            assert_eq!(part.values[row * length..][..length], whole.values[at..][..length], "{crop}, row {row}");
        }
    }
    sandbox
        .run(&["render", "scene.ron", "-o", "part.pfm", "--crop", "30,0,11,5"])
        .ends(2)
        .says(&["--crop 30,0,11,5", "40x24"]);
}

#[test]
fn options_win_over_the_scene() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "a.pfm", "--size", "16x9", "--samples", "1", "--seed", "4"]).ends(0);
    let edited = SCENE.replace("width: 40, height: 24", "width: 16, height: 9");
    sandbox.write("edited.ron", edited.replace("samples: 2", "samples: 1, seed: 4"));
    sandbox.run(&["render", "edited.ron", "-o", "b.pfm"]).ends(0);
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("b.pfm"));
    let sets = ["--set", "image=Image(width: 16, height: 9)", "--set", "render.samples=1", "--set", "render.seed=4"];
    sandbox.run(&[&["render", "scene.ron", "-o", "c.pfm"][..], &sets].concat()).ends(0);
    assert_eq!(sandbox.read("a.pfm"), sandbox.read("c.pfm"));
    sandbox.run(&["render", "edited.ron", "-o", "d.pfm", "--exposure", "-1"]).ends(0);
    let load = |name: &str| Picture::load(&sandbox.path(name)).expect("a picture").values;
    for (half, full) in load("d.pfm").iter().zip(load("a.pfm")) {
        assert_eq!(*half, full / 2.0);
    }
}

#[test]
fn scene_from_standard_input_picture_to_standard_output() {
    let sandbox = Sandbox::new();
    sandbox.run(&["render", "scene.ron", "-o", "a.pfm"]).ends(0);
    let ran = sandbox.shell(r#""$T" render - -o - --format pfm < scene.ron"#).ends(0).silent();
    assert_eq!(ran.out, sandbox.read("a.pfm"));
    // TOML is told by its looks, or by --syntax.
    for syntax in ["", "--syntax toml"] {
        let line = format!(r#""$T" convert scene.ron | "$T" render - -o - --format pfm {syntax}"#);
        assert_eq!(sandbox.shell(&line).ends(0).silent().out, sandbox.read("a.pfm"));
    }
    // As help says: a picture without a name is a PNG.
    let ran = sandbox.run(&["render", "scene.ron", "-o", "-"]).ends(0).silent();
    assert!(ran.out.starts_with(b"\x89PNG"), "{}", ran.out_text());
    sandbox.run(&["render", "scene.ron", "-o", "-", "--format", "gif"]).ends(2).says(&["png, exr, hdr, pfm"]);
}

#[test]
fn nothing_but_the_picture_is_written() {
    let sandbox = Sandbox::new();
    let ran = sandbox.run(&["render", "scene.ron", "-o", "a.png"]).ends(0).silent();
    assert_eq!(ran.out, b"");
    assert_eq!(sandbox.files(), ["a.png", "scene.ron"]);
}

/// Start-up, reading, compiling, a picture of one batch, writing. The bound is for a machine that does nothing else;
/// eight times of it are allowed here, and the best of several runs counts.
#[test]
fn a_small_picture_is_there_at_once() {
    let sandbox = Sandbox::new();
    let best = (0..5)
        .map(|_| {
            let start = std::time::Instant::now();
            sandbox.run(&["render", "scene.ron", "-o", "a.png", "--size", "64x64", "--samples", "1"]).ends(0);
            start.elapsed()
        })
        .min();
    assert!(best < Some(std::time::Duration::from_millis(8 * 50)), "{best:?}");
}

/// Without `-o` the picture lies beside the scene, under its name.
#[test]
fn a_scene_alone_is_enough() {
    let sandbox = Sandbox::new();
    std::fs::create_dir(sandbox.path("folder")).expect("a folder");
    sandbox.write("folder/a.ron", crate::support::SCENE);
    for arguments in [&["render", "folder/a.ron"][..], &["folder/a.ron", "--samples", "1e0"]] {
        sandbox.run(arguments).ends(0).says(&["folder/a.png in ", " samples/s"]);
    }
    assert!(sandbox.read("folder/a.png").starts_with(b"\x89PNG"));
    sandbox.run(&["folder/a.ron", "--format", "pfm"]).ends(0);
    assert!(sandbox.read("folder/a.pfm").starts_with(b"PF"));
    sandbox.write("scene.png", "no picture");
    sandbox.run(&["scene.ron"]).ends(2).says(&["scene.png is there already and is no picture"]);
    assert_eq!(sandbox.text("scene.png"), "no picture");
    // Nor is what the scene is made of written over.
    sandbox.run(&["scene.ron", "-o", "reads.png"]).ends(0);
    let before = sandbox.read("reads.png");
    let reads = SCENE.replace(
        "Sphere(center: (0, -100, 0), radius: 100)",
        "Rectangle(material: Diffuse(albedo: Texture(file: \"reads.png\")))",
    );
    sandbox.write("reads.ron", reads);
    for arguments in [&["reads.ron"][..], &["render", "reads.ron"]] {
        sandbox.run(arguments).ends(2).says(&["reads.png would replace a file of the scene; name another file"]);
    }
    assert_eq!(sandbox.read("reads.png"), before);
    sandbox.run(&["render", "-"]).ends(2).says(&["standard input has no name"]);
}

/// Where nobody watches the last line is said all the same, with the noise.
#[test]
fn the_last_line_tells_of_noise() {
    let sandbox = Sandbox::new();
    let ran = sandbox.run(&["render", "scene.ron", "-o", "a.png", "--report", "a.json"]).ends(0);
    assert!(
        ran.err.starts_with("a.png in ") && ran.err.contains("; noise ") && ran.err.contains(" samples for "),
        "{}",
        ran.err
    );
    assert_eq!(ran.err.lines().count(), 1);
    sandbox.run(&["render", "scene.ron", "-o", "a.png", "-q"]).ends(0).silent();
}

/// What is hard to quote in a shell needs no quotes.
#[test]
fn set_takes_bare_words_colours_and_vectors() {
    let sandbox = Sandbox::new();
    let sets = ["objects[0].material=glass", "background=#ff0000", "camera.position=1,2,6"];
    let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", *set]).collect();
    sandbox.run(&[&["render", "scene.ron", "-o", "a.png"][..], &sets].concat()).ends(0);
    sandbox.run(&["check", "scene.ron", "--set", "fov=3"]).ends(2).says(&["did you mean `camera.fov`?"]);
}

/// A folder with an `xdg-open` that writes down what it is asked for, and ends with this code.
#[cfg(target_os = "linux")]
fn with_xdg_open(sandbox: &Sandbox, code: i32) -> String {
    use std::os::unix::fs::PermissionsExt;
    std::fs::create_dir_all(sandbox.path("bin")).expect("a folder");
    sandbox.write("bin/xdg-open", format!("#!/bin/sh\necho \"$@\" > opened\nexit {code}\n"));
    std::fs::set_permissions(sandbox.path("bin/xdg-open"), PermissionsExt::from_mode(0o755)).expect("permissions");
    sandbox.path("bin").display().to_string()
}

#[cfg(target_os = "linux")]
#[test]
fn a_picture_that_is_done_is_opened() {
    let sandbox = Sandbox::new();
    let bin = with_xdg_open(&sandbox, 0);
    let run = |arguments: &[&str], path: &str| Ran::of(sandbox.command(arguments).env("PATH", path));
    let opened = || {
        let text = sandbox.text("opened");
        std::fs::remove_file(sandbox.path("opened")).expect("it was opened");
        text.trim_end().to_owned()
    };
    let canonical = |name: &str| sandbox.path(name).display().to_string();
    run(&["scene.ron", "--open"], &bin).ends(0).silent();
    assert_eq!(opened(), canonical("scene.png"));
    // One that every program shows.
    run(&["render", "scene.ron", "-o", "a.exr", "-o", "b.png", "--open"], &bin).ends(0);
    assert_eq!(opened(), canonical("b.png"));
    run(&["render", "scene.ron", "-o", "a.exr", "--open"], &bin).ends(0);
    assert_eq!(opened(), canonical("a.exr"));
    run(&["scene.ron"], &bin).ends(0);
    assert!(!sandbox.path("opened").exists(), "nobody asked");

    // That nobody can show it is said, and the picture is there.
    with_xdg_open(&sandbox, 3);
    let says = "warning: cannot open scene.png: xdg-open found nothing that can (exit status: 3); open it yourself";
    run(&["scene.ron", "--open"], &bin).ends(0).says(&[says]);
    run(&["scene.ron", "--open"], "/nowhere").ends(0).says(&["there is no xdg-open here", "open it yourself"]);
    run(&["render", "scene.ron", "-o", "-", "--format", "png", "--open"], &bin)
        .ends(2)
        .says(&["--open is for pictures"]);
}

/// What is said twice in two ways is not passed over in one of them.
#[test]
fn an_exposure_is_said_once() {
    let sandbox = Sandbox::new();
    let render =
        |more: &[&str]| sandbox.run(&[&["render", "scene.ron", "-o", "a.png", "--samples", "1"], more].concat());
    let ran = render(&["--exposure", "3", "--set", "effects.exposure=8"]).ends(2);
    ran.says(&["--exposure 3 and --set effects.exposure=8 say two things: leave one of them out"]);
    assert!(!sandbox.path("a.png").exists());
    render(&["--exposure", "-1", "--set", "effects.exposure=-1"]).ends(0);
    render(&["--exposure", "-1", "--set", "effects.tone_map=AgX"]).ends(0);
}
