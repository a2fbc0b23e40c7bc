//! The camera, moved by the page and written into the file; pixels, layers, pinned states, more samples.

use crate::support::{SCENE, Sandbox, stage_of};
use serde_json::json;
use std::fs;

#[test]
fn a_camera_is_moved_written_and_taken_back() {
    let sandbox = Sandbox::new(SCENE);
    let first = sandbox.done_after(0);
    let before = sandbox.pixels();
    let pose =
        json!({ "pose": { "position": [1.0, 0.1 + 0.2, 4.0], "look_at": [0, 0, 0], "up": [0, 1, 0], "fov": 30 } });
    assert_eq!(sandbox.post("camera", &pose.to_string()).status, 204);
    let moved = sandbox.done_after(stage_of(&first));
    assert_ne!(sandbox.pixels(), before);
    assert_eq!(moved["written"], first["camera"], "not in the file yet");
    assert_eq!(fs::read_to_string(sandbox.path("scene.ron")).expect("the file"), SCENE);

    let answer = sandbox.post("camera/write", "{}");
    assert_eq!((answer.status, answer.json()), (200, json!({ "edits": 2 })));
    let text = fs::read_to_string(sandbox.path("scene.ron")).expect("the file");
    let expected = SCENE.replace("(0, 0, 5)", "(1, 0.3, 4)").replace("fov: 40", "fov: 30");
    assert_eq!(text, expected, "comments and layout stay");
    let state = sandbox.until(|state| state["written"]["fov"] == 30.0 && state["phase"] == "done");
    assert_eq!((&state["camera"], &state["undo"]), (&state["written"], &json!(true)));
    assert_eq!(sandbox.post("camera/write", "{}").json(), json!({ "edits": 0 }));

    assert_eq!(sandbox.post("camera/undo", "{}").status, 204);
    assert_eq!(fs::read_to_string(sandbox.path("scene.ron")).expect("the file"), SCENE);
    let state = sandbox.until(|state| state["written"]["fov"] == 40.0 && state["phase"] == "done");
    assert_eq!(state["undo"], false);
    assert_eq!(sandbox.pixels(), before);
    assert_eq!(sandbox.post("camera/undo", "{}").status, 409);
}

#[test]
fn what_was_changed_since_is_not_taken_back_and_what_is_wrong_not_written() {
    let sandbox = Sandbox::new(SCENE);
    let first = sandbox.done_after(0);
    let pose = json!({ "pose": { "position": [0, 1, 6], "look_at": [0, 0, 0], "up": [0, 1, 0], "fov": 40 } });
    sandbox.post("camera", &pose.to_string());
    sandbox.done_after(stage_of(&first));
    assert_eq!(sandbox.post("camera/write", "{}").status, 200);
    let text = fs::read_to_string(sandbox.path("scene.ron")).expect("the file") + "// mine\n";
    sandbox.write("scene.ron", &text);
    let answer = sandbox.post("camera/undo", "{}");
    assert!(answer.status == 409 && answer.text().contains("changed since"), "{}", answer.text());
    assert_eq!(fs::read_to_string(sandbox.path("scene.ron")).expect("the file"), text);
    sandbox.write("scene.ron", "Scene(");
    sandbox.until(|state| state["phase"] == "wrong");
    assert_eq!(sandbox.post("camera/write", "{}").status, 409);
    assert_eq!(fs::read_to_string(sandbox.path("scene.ron")).expect("the file"), "Scene(");
    for bad in [
        json!({ "pose": { "position": [0, 0, 0], "look_at": [0, 0, 0], "up": [0, 1, 0], "fov": 40 } }),
        json!({ "pose": { "position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 0, 1], "fov": 40 } }),
        json!({ "pose": { "position": [0, 0, 5], "look_at": [0, 0, 0], "up": [0, 1, 0], "fov": 180 } }),
        json!({ "pose": 3 }),
    ] {
        assert_eq!(sandbox.post("camera", &bad.to_string()).status, 400, "{bad}");
    }
}

#[test]
fn a_pixel_tells_what_is_seen_there() {
    let sandbox = Sandbox::new(SCENE);
    sandbox.done_after(0);
    let pixel = sandbox.get("pixel?x=12&y=8").json();
    assert_eq!(pixel["object"]["name"], "objects[0] Sphere");
    let place = &pixel["object"]["place"];
    assert_eq!((&place["name"], &place["line"]), (&json!("scene.ron"), &json!(7)));
    let layer = |name: &str| {
        let layers = pixel["layers"].as_array().expect("a list");
        layers.iter().find(|layer| layer["name"] == name).expect("the layer")["values"].clone()
    };
    assert!((layer("depth")[0].as_f64().expect("a number") - 4.0).abs() < 0.1);
    assert!(layer("normal")[2].as_f64() > Some(0.9));
    assert!(pixel["radiance"][0].as_f64() > pixel["radiance"][1].as_f64(), "the ball is red: {pixel}");
    let corner = sandbox.get("pixel?x=0&y=0").json();
    assert!(corner["object"].is_null() && corner["radiance"] == json!([0.5, 0.5, 0.5]), "{corner}");
    for path in ["pixel?x=24&y=0", "pixel?x=-1&y=0", "pixel?x=0"] {
        assert_eq!(sandbox.get(path).status, 400, "{path}");
    }
}

#[test]
fn every_layer_is_shown_and_a_pinned_state_stays() {
    let sandbox = Sandbox::new(SCENE);
    let state = sandbox.done_after(0);
    let picture = sandbox.pixels();
    let names = state["layers"].as_array().expect("a list");
    assert!(names.len() >= 8, "{names:?}");
    for name in names {
        let answer = sandbox.get(&format!("frame?layer={}", name.as_str().expect("a name")));
        assert_eq!((answer.status, answer.body.len()), (200, 24 * 16 * 4), "{name}");
        // There is no lamp, one thing that nothing else lights, as many samples everywhere, and nothing moves.
        let one = answer.body.chunks(4).all(|pixel| pixel == &answer.body[..4]);
        assert_eq!(one, ["emission", "indirect", "samples", "motion"].iter().any(|flat| name == flat), "{name}");
    }
    let pin = sandbox.post("pin", "{}").json()["pin"].clone();
    sandbox.write("scene.ron", SCENE.replace("0.8", "0.1"));
    sandbox.done_after(stage_of(&state));
    assert_eq!(sandbox.get(&format!("frame?pin={pin}")).body, picture);
    assert_ne!(sandbox.pixels(), picture);
    // Three are kept.
    for _ in 0..3 {
        sandbox.post("pin", "{}");
    }
    assert_eq!(sandbox.get(&format!("frame?pin={pin}")).status, 410);
}

#[test]
fn twice_the_samples_are_those_of_a_longer_rendering() {
    let sandbox = Sandbox::new(SCENE);
    sandbox.done_after(0);
    assert_eq!(sandbox.post("more", "{}").status, 204);
    sandbox.until(|state| state["phase"] == "done" && state["frame"]["samples"] == 8);
    let more = sandbox.pixels();
    let whole = Sandbox::with(SCENE, |options| options.samples = Some(8));
    whole.done_after(0);
    assert_eq!(more, whole.pixels());
}
