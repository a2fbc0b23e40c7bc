//! The preview over real HTTP: what it shows, what it does when files change, and whom it lets in.

mod camera;
mod guard;
mod saves;
mod support;
mod writes;

use scene_format::{Override, Syntax};
use std::path::Path;
use support::{SCENE, Sandbox, stage_of};
use tracer_core::{RenderOptions, Unobserved, compile, develop, render};

#[test]
fn the_page_shows_the_bytes_that_a_png_has() {
    let sandbox = Sandbox::new(SCENE);
    let state = sandbox.done_after(0);
    assert_eq!(state["name"], "scene.ron");
    assert_eq!(state["frame"]["size"], serde_json::json!([24, 16]));
    assert_eq!((&state["frame"]["samples"], &state["asked"]), (&4.into(), &4.into()));
    assert_eq!(state["samples_done"], 24 * 16 * 4);
    assert_eq!(state["told"], serde_json::json!([]));
    let loaded = scene_format::load(&sandbox.path("scene.ron")).expect("the scene is right");
    let scene = compile(&loaded.scene).expect("the scene compiles");
    let film = render(&scene, &RenderOptions::default(), &Unobserved);
    for (query, exposure) in [("frame", 0.0), ("frame?exposure=1.5&tone=none", 1.5)] {
        let image = develop(&film, &tracer_core::Look { exposure, ..scene.look });
        let expected: Vec<u8> = image.display.iter().map(|x| (f64::from(*x) * 255.0 + 0.5) as u8).collect();
        let answer = sandbox.get(query);
        assert!(answer.head.contains("x-size: 24x16"), "{}", answer.head);
        let shown: Vec<u8> = answer.body.chunks(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
        assert_eq!(shown, expected, "{query}");
        assert!(answer.body.chunks(4).all(|pixel| pixel[3] == 255));
    }
    // The noise is measured beside the rendering.
    sandbox.until(|state| state["frame"]["noise"].as_f64().is_some_and(|noise| noise > 0.0));
}

/// `--camera` and `--frame` choose what is shown, as they do in a rendering, and stay chosen when the scene is saved.
#[test]
fn the_camera_and_the_frame_that_are_asked_for_are_shown() {
    let text = SCENE
        .replace("camera: Camera(position: (0, 0, 5), look_at: (0, 0, 0), fov: 40), // the eye", CAMERAS)
        .replace("center: (0, 0, 0)", "center: (\"=time\", 0, 0)");
    let expected = |sets: &[Override]| {
        let scene =
            scene_format::load_str("scene.ron", &text, Syntax::Ron, Path::new(""), sets).expect("it is right").scene;
        let scene = compile(&scene).expect("the scene compiles");
        let image = develop(&render(&scene, &RenderOptions::default(), &Unobserved), &scene.look);
        image.display.iter().map(|x| (f64::from(*x) * 255.0 + 0.5) as u8).collect::<Vec<u8>>()
    };
    let shown =
        |sandbox: &Sandbox| -> Vec<u8> { sandbox.pixels().chunks(4).flat_map(|pixel| pixel[..3].to_vec()).collect() };
    let asked = [
        vec![],
        vec![Override::camera("above")],
        vec![Override::frame(3)],
        vec![Override::camera("above"), Override::frame(3)],
    ];
    let mut pictures = Vec::new();
    for sets in asked {
        let sandbox = Sandbox::with(&text, |options| options.overrides = sets.clone());
        let state = sandbox.done_after(0);
        assert_eq!(shown(&sandbox), expected(&sets), "{sets:?}");
        sandbox.write("scene.ron", format!("// saved\n{text}"));
        sandbox.done_after(stage_of(&state));
        assert_eq!(shown(&sandbox), expected(&sets), "{sets:?}, saved");
        pictures.push(expected(&sets));
    }
    // Each is another picture, so that none could stand for another.
    pictures.sort();
    pictures.dedup();
    assert_eq!(pictures.len(), 4);
    let sandbox = Sandbox::with(&text, |options| options.overrides = vec![Override::camera("below")]);
    let state = sandbox.until(|state| state["phase"] == "wrong");
    assert!(state["told"].to_string().contains("below"), "{state:#}");
}

/// Two cameras, and time that goes a unit in a second of four frames.
const CAMERAS: &str = "camera: \"front\", cameras: {
        \"front\": Camera(position: (0, 0, 5), look_at: (0, 0, 0), fov: 40),
        \"above\": Camera(position: (0, 4, 1), look_at: (0, 0, 0), fov: 40),
    },
    animation: Animation(frames: 8, fps: 4),";

#[test]
fn pictures_are_saved_in_the_look_of_the_page() {
    let sandbox = Sandbox::new(SCENE);
    sandbox.done_after(0);
    let answer = sandbox.get("save?kind=png&exposure=2&tone=agx");
    assert_eq!((answer.status, answer.text().as_str()), (200, "Png 24x16 2 4"));
    assert!(answer.head.contains("attachment; filename=\"scene.png\""), "{}", answer.head);
    assert_eq!(sandbox.get("save?kind=exr").text(), "Exr 24x16 0 4");
    assert_eq!(sandbox.get("save?kind=gif").status, 400);
}

#[test]
fn large_pictures_have_a_draft_first_and_are_the_same_in_the_end() {
    let large = SCENE.replace("width: 24, height: 16", "width: 401, height: 303");
    let sandbox = Sandbox::new(&large);
    let state = sandbox.until(|state| !state["frame"].is_null());
    if state["frame"]["draft"] == true {
        assert_eq!(state["frame"]["size"], serde_json::json!([401, 303]));
        assert_eq!(sandbox.get("save?kind=png").status, 409, "a draft is no picture");
    }
    sandbox.done_after(0);
    let loaded = scene_format::load(&sandbox.path("scene.ron")).expect("the scene is right");
    let scene = compile(&loaded.scene).expect("the scene compiles");
    let image = develop(&render(&scene, &RenderOptions::default(), &Unobserved), &scene.look);
    let expected: Vec<u8> = image.display.iter().map(|x| (f64::from(*x) * 255.0 + 0.5) as u8).collect();
    let shown: Vec<u8> = sandbox.pixels().chunks(4).flat_map(|pixel| pixel[..3].to_vec()).collect();
    assert_eq!(shown, expected);
}

#[test]
fn options_count_each_time_that_the_scene_is_read() {
    let sandbox = Sandbox::with(SCENE, |options| {
        options.size = Some([10, 8]);
        options.samples = Some(2);
        options.overrides = vec!["effects.exposure=3".into()];
    });
    let state = sandbox.done_after(0);
    sandbox.write("scene.ron", SCENE.replace("0.8", "0.1"));
    for state in [&state, &sandbox.done_after(stage_of(&state))] {
        assert_eq!(state["frame"]["size"], serde_json::json!([10, 8]));
        assert_eq!(state["frame"]["samples"], 2);
        assert_eq!(state["look"]["exposure"], 3.0);
    }
}

#[test]
fn what_cannot_fit_is_refused_with_a_way_out() {
    let sandbox = Sandbox::new(&SCENE.replace("width: 24, height: 16", "width: 60000, height: 60000"));
    let state = sandbox.until(|state| state["phase"] == "wrong");
    let text = state["told"][0]["text"].as_str().expect("a text");
    assert!(text.contains("60000x60000") && text.contains("--size"), "{text}");
    sandbox.write("scene.ron", SCENE);
    sandbox.done_after(0);
}

#[test]
fn two_pages_ask_beside_each_other() {
    let sandbox = Sandbox::new(SCENE);
    let state = sandbox.done_after(0);
    let version = state["version"].as_u64().expect("a number");
    std::thread::scope(|scope| {
        let pages: Vec<_> = (0..2)
            .map(|_| scope.spawn(|| sandbox.until(|state| stage_of(state) > 1 && state["phase"] == "done")))
            .collect();
        sandbox.write("scene.ron", SCENE.replace("0.8", "0.1"));
        for page in pages {
            let seen = page.join().expect("a page");
            assert!(seen["version"].as_u64() > Some(version));
        }
    });
}

#[test]
fn a_port_that_is_taken_is_told() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = taken.local_addr().expect("an address").port();
    let options = tracer_preview::Options {
        scene: "none.ron".into(),
        syntax: None,
        overrides: Vec::new(),
        samples: None,
        size: None,
        threads: 1,
        editor: None,
    };
    let listen = tracer_preview::Listen { port, ..support::ANY_PORT };
    let error =
        tracer_preview::Preview::start(options, listen, Box::<support::Program>::default()).err().expect("it is taken");
    assert_eq!(
        error.to_string(),
        format!("port {port} is taken by another program; name another one, or none for any that is free")
    );
}
