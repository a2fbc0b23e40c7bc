//! `--frames`, `--frame`, `--camera`: one scene, many pictures.

use crate::support::Sandbox;
use std::process::Stdio;
use std::time::Duration;

const FILM: &str = r#"Scene(
    animation: Animation(frames: 4, fps: 2),
    camera: "front",
    cameras: { "front": Camera(position: (0, 0, 6)), "top": Camera(position: (0, 6, 0.1)) },
    image: Image(width: 24, height: 16), render: Render(samples: 2),
    background: 1,
    objects: [
        Sphere(center: "=(time - 1, 0, 0)", radius: "=keyframes(frame, 0, 0.5, 3, 0.8)",
            material: Diffuse(albedo: 0.4)),
        Box(center: (0, -1.5, 0), size: (4, 1, 4), material: Diffuse(albedo: (0.2, 0.4, 0.3))),
    ],
)"#;

fn film() -> Sandbox {
    let sandbox = Sandbox::new();
    sandbox.write("film.ron", FILM);
    sandbox
}

#[test]
fn a_frame_has_the_same_bytes_alone_and_in_a_row() {
    let sandbox = film();
    sandbox.run(&["render", "film.ron", "--frames", "0-3", "-o", "row_##.png", "-o", "row_##.exr"]).ends(0);
    for frame in 0..4 {
        let name = format!("alone_{frame}");
        let (png, exr) = (format!("{name}.png"), format!("{name}.exr"));
        sandbox.run(&["render", "film.ron", "--frame", &frame.to_string(), "-o", &png, "-o", &exr]).ends(0);
        assert_eq!(sandbox.read(&png), sandbox.read(&format!("row_{frame:02}.png")), "{frame}");
        assert_eq!(sandbox.read(&exr), sandbox.read(&format!("row_{frame:02}.exr")), "{frame}");
    }
    assert_ne!(sandbox.read("row_00.png"), sandbox.read("row_01.png"));
    // What is written at the frame is that frame; names without -o have the number.
    sandbox.run(&["render", "film.ron", "--set", "animation.frame=2", "-o", "set.pfm"]).ends(0);
    sandbox.run(&["render", "film.ron", "--frame", "2", "-o", "two.pfm"]).ends(0);
    assert_eq!(sandbox.read("set.pfm"), sandbox.read("two.pfm"));
    sandbox.run(&["render", "film.ron", "--frames", "all"]).ends(0);
    assert!(sandbox.files().contains(&"film_0003.png".to_owned()), "{:?}", sandbox.files());
}

#[test]
fn existing_frames_are_skipped_only_when_asked() {
    let sandbox = film();
    sandbox.write("a_1.png", "PF mine");
    let line = ["render", "film.ron", "--frames", "0-2", "-o", "a_#.png"];
    let ran = sandbox.run(&[&line[..], &["--skip-existing"]].concat()).ends(0);
    assert!(ran.err.contains("2 frames") && ran.err.contains("1 was there"), "{}", ran.err);
    assert_eq!(sandbox.text("a_1.png"), "PF mine");
    sandbox.run(&line).ends(0);
    assert_ne!(sandbox.read("a_1.png"), b"PF mine");
    // What was made of another text is told, and left as it is.
    let again = || sandbox.run(&[&line[..], &["--skip-existing"]].concat()).ends(0).err;
    assert!(!again().contains("another text"), "{}", again());
    sandbox.write("film.ron", sandbox.text("film.ron") + "// More.\n");
    std::fs::remove_file(sandbox.path("a_0.png")).expect("a picture");
    let told = again();
    assert!(told.contains("warning: 2 pictures were there") && told.contains("(a_1.png, ..)"), "{told}");
    assert!(again().contains("warning: 2 pictures"), "{}", again());
    // What is no picture is told before the first frame is made.
    sandbox.write("b_1.png", "mine");
    let line = ["render", "film.ron", "--frames", "0-2", "-o", "b_#.png"];
    sandbox.run(&line).ends(2).says(&["b_1.png is there already and is no picture"]);
    assert!(!sandbox.path("b_0.png").exists());
}

#[test]
fn files_of_frames_have_numbers() {
    let sandbox = film();
    let line = ["render", "film.ron", "--frames", "0-1"];
    let with = |more: &[&str]| sandbox.run(&[&line[..], more].concat());
    with(&["-o", "a.png"]).ends(2).says(&["put #### for its number into a.png, as in a_####.png"]);
    with(&["-o", "-"]).ends(2).says(&["shot_####.png"]);
    with(&["-o", "a_#.png", "--report", "r.json"]).ends(2).says(&["r_####.json"]);
    with(&["-o", "a_#.png", "--open"]).ends(2);
    with(&["--frame", "1"]).ends(2);
    sandbox.run(&["render", "film.ron", "--skip-existing"]).ends(2).says(&["--frames"]);
    sandbox.run(&["render", "film.ron", "--frames", "3-1"]).ends(2).says(&["0-47"]);
    sandbox.run(&["render", "film.ron", "--frames", "0-4"]).ends(2).says(&["there is no frame 4", "0 to 3"]);
    sandbox.run(&["render", "scene.ron", "--frame", "1"]).ends(2).says(&["there is no frame 1", "frames"]);
    with(&["-o", "a_#.png", "--report", "r_#.json", "--checkpoint", "c_#.film"]).ends(0);
    let (first, second) = (sandbox.text("r_0.json"), sandbox.text("r_1.json"));
    assert!(first.contains("--frame 0") && second.contains("--frame 1"), "{first}");
    let told = |text: &str| {
        let report: serde_json::Value = serde_json::from_str(text).expect("JSON");
        (report["picture"]["frame"].as_u64(), report["picture"]["camera"].as_str().map(str::to_owned))
    };
    assert_eq!(told(&second), (Some(1), Some("front".to_owned())));
    with(&["-o", "b_#.png", "--resume", "c_#.film"]).ends(0);
    assert_eq!(sandbox.read("a_1.png"), sandbox.read("b_1.png"));
}

#[test]
fn what_is_wrong_with_a_frame_is_told_before_the_first() {
    let sandbox = film();
    sandbox.write("bad.ron", FILM.replace("radius: \"=", "radius: \"=1.25 - frame/2 + 0*"));
    let ran = sandbox.run(&["check", "bad.ron"]).ends(2);
    assert!(
        ran.err.contains("must be positive (frame 3)") && ran.err.contains("1 of 4 frames is wrong"),
        "{}",
        ran.err
    );
    sandbox.run(&["render", "bad.ron", "--frames", "0-3", "-o", "b_#.png"]).ends(2).says(&["(frame 3)"]);
    assert!(!sandbox.files().contains(&"b_0.png".to_owned()));
    sandbox.run(&["render", "bad.ron", "--frames", "0-2", "-o", "b_#.png"]).ends(0);
    let ran = sandbox.run(&["check", "film.ron"]).ends(0);
    assert!(ran.out_text().contains("4 frames"), "{}", ran.out_text());
}

/// Files and what only compiling finds, too, and each once.
#[test]
fn files_of_later_frames_are_looked_at_before_the_first() {
    let sandbox = film();
    let file = FILM.replace(
        "Diffuse(albedo: 0.4)",
        "Diffuse(albedo: Pick(from: [0.5, Texture(file: \"no.png\")], index: \"=frame\"))",
    );
    // Each factor can be, all of them together leave nothing.
    let flat = "transform: [Repeat(count: \"=if(frame == 1, 13, 0)\", items: [Scale(1e-9)])], size: (4, 1, 4)";
    let shape = FILM.replace("size: (4, 1, 4)", flat);
    for (text, code, frames) in [(file, "E0501", "2 of 4 frames are wrong"), (shape, "E0540", "1 of 4 frames is wrong")]
    {
        sandbox.write("bad.ron", text);
        for line in [&["check", "bad.ron"][..], &["render", "bad.ron", "--frames", "all", "-o", "b_#.png"]] {
            let ran = sandbox.run(line).ends(2).says(&[code, "(frame 1)", frames]);
            assert_eq!(ran.err.matches(&format!("[{code}]")).count(), 1, "{}", ran.err);
        }
        assert!(!sandbox.files().contains(&"b_0.png".to_owned()));
    }
}

/// Warnings of other frames than the one that is seen are told with the number, each once, and count.
#[test]
fn warnings_of_later_frames_are_told_by_check() {
    let sandbox = film();
    // What reading finds, what compiling finds, and what the frame that is seen has, too.
    let sky = "background: Pick(from: [(1, 1, 1), (135, 206, 235)], index: \"=if(frame >= 2, 1, 0)\")";
    let turned = "Box(transform: [Rotate(axis: (0, 1, 0), degrees: \"=if(frame == 1, 1.5708, 0)\")])";
    let objects = format!("vars: {{ \"unused\": 1 }}, objects: [{turned}, ");
    let text = FILM.replace("background: 1", sky).replace("objects: [", &objects);
    sandbox.write("warned.ron", text);
    let ran = sandbox.run(&["check", "warned.ron"]).ends(0);
    assert_eq!(ran.err.matches("W0402").count(), 1, "{}", ran.err);
    assert!(ran.err.contains("looks like radians (frame 1)"), "{}", ran.err);
    let told = ["looks like a colour in bytes (frame 2)", "(frame 3)", "(frame 0)"].map(|what| ran.err.contains(what));
    assert_eq!(told, [true, false, false], "{}", ran.err);
    let ran = sandbox.run(&["check", "warned.ron", "--deny-warnings"]).ends(2);
    ran.says(&["3 warnings, denied by --deny-warnings"]);
    // Seen at that frame it is told without a number.
    let ran = sandbox.run(&["check", "warned.ron", "--set", "animation.frame=1"]).ends(0);
    assert!(ran.err.contains("looks like radians\n") && ran.err.contains("bytes (frame 2)"), "{}", ran.err);
    // Who renders frames tells warnings as they come.
    let ran = sandbox.run(&["render", "warned.ron", "--frames", "0-1", "-o", "w_#.png"]).ends(0);
    assert_eq!((ran.err.matches("W0317").count(), ran.err.matches("W0402").count()), (1, 1), "{}", ran.err);
}

/// A warning is told once for a film.
#[test]
fn warnings_are_told_once_for_all_frames() {
    let sandbox = film();
    let text = FILM.replace("objects: [", "output: Output(layers: [Depth]), vars: { \"unused\": 1 }, objects: [");
    sandbox.write("warned.ron", text);
    let ran = sandbox.run(&["render", "warned.ron", "--frames", "all", "-o", "w_##.png"]).ends(0);
    assert_eq!(ran.err.matches("W0402").count(), 1, "{}", ran.err);
    assert_eq!(ran.err.matches("into EXR only; add -o w_##.exr").count(), 1, "{}", ran.err);
    // What only a later frame has is told with its number.
    sandbox.write("black.ron", FILM.replace("background: 1", "background: \"=if(frame == 2, (0, 0, 0), (1, 1, 1))\""));
    let ran = sandbox.run(&["render", "black.ron", "--frames", "all", "-o", "w_##.png"]).ends(0);
    assert!(ran.err.contains("black (frame 2)") && !ran.err.contains("(frame 3)"), "{}", ran.err);
}

#[test]
fn parts_of_frames_are_merged() {
    let sandbox = film();
    sandbox.run(&["render", "film.ron", "--frames", "1-2", "-o", "whole_#.pfm"]).ends(0);
    for part in ["1/2", "2/2"] {
        let name = format!("p{}_#.tracer", &part[..1]);
        sandbox.run(&["render", "film.ron", "--frames", "1-2", "--part", part, "-o", &name]).ends(0);
    }
    sandbox.run(&["merge", "p1_2.tracer", "p2_2.tracer", "-o", "merged.pfm"]).ends(0);
    assert_eq!(sandbox.read("merged.pfm"), sandbox.read("whole_2.pfm"));
    let ran = sandbox.run(&["merge", "p1_1.tracer", "p2_2.tracer", "-o", "mixed.pfm"]);
    assert_ne!(ran.code, Some(0), "frames are not mixed");
}

#[test]
fn a_signal_ends_it_and_leaves_whole_frames() {
    let sandbox = film();
    let line = ["render", "film.ron", "--frames", "0-3", "--samples", "200000", "-o", "s_#.png", "--skip-existing"];
    let mut child = sandbox.command(&line).stderr(Stdio::piped()).spawn().expect("it starts");
    std::thread::sleep(Duration::from_millis(800));
    let kill = format!("kill -TERM {}", child.id());
    assert!(std::process::Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
    let status = child.wait().expect("it ends");
    assert_eq!(status.code(), Some(143));
    let files = sandbox.files();
    assert!(!files.contains(&"s_3.png".to_owned()), "{files:?}");
}

/// A part that is its own checkpoint is gone on with, not taken for done.
#[test]
fn a_part_that_is_not_done_is_not_left_out() {
    let sandbox = film();
    let part = ["render", "film.ron", "--part", "1/2"];
    let line = |more: &[&'static str]| [&part[..], more].concat();
    let mut child = sandbox
        .command(&line(&["--frame", "1", "--samples", "64000", "-o", "p1.tracer", "--checkpoint", "p1.tracer"]))
        .stderr(Stdio::null())
        .spawn()
        .expect("it starts");
    std::thread::sleep(Duration::from_millis(800));
    let kill = format!("kill -TERM {}", child.id());
    assert!(std::process::Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
    child.wait().expect("it ends");
    let before = sandbox.read("p1.tracer");
    let more = ["--frames", "1-1", "--samples", "64000", "-o", "p#.tracer", "--resume", "p#.tracer", "--skip-existing"];
    let mut child = sandbox.command(&line(&more)).stderr(Stdio::null()).spawn().expect("it starts");
    std::thread::sleep(Duration::from_millis(800));
    let kill = format!("kill -TERM {}", child.id());
    assert!(std::process::Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
    child.wait().expect("it ends");
    assert_ne!(sandbox.read("p1.tracer"), before, "it was gone on with");
}

/// Frames that are there count as done, wherever it is interrupted.
#[test]
fn frames_that_are_there_are_done() {
    let sandbox = film();
    sandbox.write("s_2.png", "there");
    sandbox.write("s_3.png", "there");
    let line = ["render", "film.ron", "--frames", "0-3", "--samples", "9000000", "-o", "s_#.png", "--skip-existing"];
    let child = sandbox.command(&line).stderr(Stdio::piped()).spawn().expect("it starts");
    std::thread::sleep(Duration::from_millis(800));
    let kill = format!("kill -TERM {}", child.id());
    assert!(std::process::Command::new("sh").args(["-c", &kill]).status().expect("a shell").success());
    let ended = child.wait_with_output().expect("it ends");
    let told = String::from_utf8_lossy(&ended.stderr).into_owned();
    assert!(told.contains("interrupted: 2 of 4 frames done; the same line does the rest"), "{told}");
}

#[test]
fn cameras_are_chosen_by_name() {
    let sandbox = film();
    sandbox.run(&["render", "film.ron", "-o", "first.pfm"]).ends(0);
    sandbox.run(&["render", "film.ron", "--camera", "front", "-o", "front.pfm"]).ends(0);
    sandbox.run(&["render", "film.ron", "--camera", "top", "-o", "top.pfm"]).ends(0);
    assert_eq!(sandbox.read("first.pfm"), sandbox.read("front.pfm"));
    assert_ne!(sandbox.read("first.pfm"), sandbox.read("top.pfm"));
    let ran = sandbox.run(&["render", "film.ron", "--camera", "tap", "-o", "x.png"]).ends(2);
    ran.says(&["there is no camera \"tap\"", "`front` or `top`", "--camera"]);
    sandbox.run(&["info", "film.ron", "--camera", "top"]).ends(0);
    sandbox.write("which.ron", FILM.replace("camera: \"front\",", ""));
    sandbox.run(&["render", "which.ron", "-o", "x.png"]).ends(2).says(&["2 cameras", "--camera front"]);
    // Who renders nothing needs none.
    sandbox.run(&["fmt", "which.ron"]).ends(0);
    sandbox.run(&["convert", "which.ron", "-o", "which.toml"]).ends(0);
    for scene in ["which.ron", "which.toml"] {
        let ran = sandbox.run(&["check", scene]).ends(0);
        assert!(ran.out_text().contains("4 frames, 2 cameras of which none is chosen"), "{}", ran.out_text());
    }
    sandbox.run(&["render", "which.ron", "--camera", "front", "-o", "chosen.pfm"]).ends(0);
    assert_eq!(sandbox.read("chosen.pfm"), sandbox.read("front.pfm"));
    sandbox.run(&["render", "scene.ron", "--camera", "a", "-o", "x.png"]).ends(2).says(&["no `cameras`"]);
    // What is set of the named one is seen.
    let set = ["--camera", "top", "--set", "cameras.top.fov=20", "-o", "near.pfm"];
    sandbox.run(&[&["render", "film.ron"][..], &set].concat()).ends(0);
    assert_ne!(sandbox.read("near.pfm"), sandbox.read("top.pfm"));
    let set = ["--set", "camera=top", "--set", "camera.fov=20", "-o", "x.png"];
    sandbox.run(&[&["render", "film.ron"][..], &set].concat()).ends(2).says(&["cameras.top.fov"]);
    let set = ["--set", "camera.fov=20", "-o", "x.png"];
    sandbox.run(&[&["render", "film.ron"][..], &set].concat()).ends(2).says(&["cameras.front.fov"]);
    sandbox.run(&["render", "film.ron", "--frame", "-1"]).ends(2).says(&["--frame"]);
}

/// A camera by its matrix sees what the same one sees by its place.
#[test]
fn a_matrix_is_a_camera() {
    let sandbox = film();
    let other = |camera: &str| FILM.replace("camera: \"front\"", &format!("camera: {camera}"));
    let placed = other("Camera(position: (3, 4, 5), look_at: (3, -1, 5), up: (0, 0, -1))");
    let matrix = other("Camera(matrix: ((1, 0, 0, 3), (0, 0, 1, 4), (0, -1, 0, 5)))");
    sandbox.write("placed.ron", placed);
    sandbox.write("matrix.ron", matrix);
    for name in ["placed", "matrix"] {
        sandbox.run(&["render", &format!("{name}.ron"), "-o", &format!("{name}.pfm")]).ends(0);
    }
    assert_eq!(sandbox.read("placed.pfm"), sandbox.read("matrix.pfm"));
    let ran = sandbox.run(&["info", "matrix.ron", "--resolved"]).ends(0);
    assert!(
        ran.out_text().contains("matrix: ((1, 0, 0, 3)") && !ran.out_text().contains("look_at: (3"),
        "{}",
        ran.out_text()
    );
}

/// What another frame picks is an input of the film.
#[test]
fn no_frame_replaces_what_another_is_made_of() {
    let sandbox = Sandbox::new();
    let scene = r#"Scene(
        animation: Animation(frames: 4), background: 1, image: Image(width: 8, height: 8), render: Render(samples: 1),
        objects: [Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: Texture(
            file: Pick(from: ["wood1.png", "wood2.png"], index: "=frame")))) ],
    )"#;
    let plain = FILM.replace("samples: 2", "samples: 1");
    sandbox.write("plain.ron", &plain);
    for name in ["wood1.png", "wood2.png"] {
        sandbox.run(&["render", "plain.ron", "-o", name]).ends(0);
    }
    let before = [sandbox.read("wood1.png"), sandbox.read("wood2.png")];
    sandbox.write("wood.ron", scene);
    sandbox.write("still.ron", scene.replace("\"=frame\"", "0").replace("animation: Animation(frames: 4),", ""));
    for line in [
        &["wood.ron", "--frames", "0-3", "-o", "wood#.png"][..],
        &["wood.ron", "--frames", "0-3", "-o", "a#.png", "--report", "wood#.png"],
        &["wood.ron", "--frames", "0-3", "-o", "a#.png", "--checkpoint", "wood#.png"],
        &["wood.ron", "--frame", "0", "-o", "wood2.png"],
        &["still.ron", "-o", "./wood2.png"],
    ] {
        let ran = sandbox.run(&[&["render"], line].concat()).ends(2);
        assert!(ran.err.contains("would replace a file"), "{}", ran.err);
        assert!(!sandbox.files().iter().any(|name| name.starts_with('a')), "{line:?}: something was rendered");
    }
    assert!(before == [sandbox.read("wood1.png"), sandbox.read("wood2.png")]);
    sandbox.run(&["render", "wood.ron", "--frames", "0-3", "-o", "a#.png"]).ends(0);
    sandbox.run(&["render", "wood.ron", "--frames", "0-3", "-o", "a#.png"]).ends(0);
}

/// What is wrong with an option is said of that option; names with room for a number are taken as they stand where
/// no frame is asked for, and that is said.
#[test]
fn options_of_frames_are_told_by_their_names() {
    let sandbox = film();
    let ran = sandbox.run(&["render", "film.ron", "--frames", "9", "-o", "a_####.png"]).ends(2);
    assert!(ran.err.contains("--> --frames:1:") && !ran.err.contains("--> --frame:"), "{}", ran.err);
    sandbox.run(&["render", "film.ron", "--frame", "9", "-o", "a_####.png"]).ends(2).says(&["--> --frame:1:"]);
    let says = "b_##.png is written under just that name: # stands for a frame's number with --frames or --frame alone";
    sandbox.run(&["render", "scene.ron", "-o", "b_##.png"]).ends(0).says(&[says]);
    assert!(sandbox.files().contains(&"b_##.png".to_owned()));
    let ran = sandbox.run(&["render", "film.ron", "--frame", "1", "-o", "b_##.png"]).ends(0);
    assert!(!ran.err.contains("warning") && sandbox.files().contains(&"b_01.png".to_owned()), "{}", ran.err);
}
