//! The camera written into the file: what was changed of it, where it stands, and nothing that anybody has saved.

use crate::support::{SCENE, Sandbox, stage_of};
use scene_format::Override;
use serde_json::{Value, json};
use std::fs;

const CAMERA: &str = "position: (0, 0, 5), look_at: (0, 0, 0), fov: 40";

/// The scene with another camera.
fn scene(camera: &str) -> String {
    SCENE.replace(CAMERA, camera)
}

/// The state's camera with another value of a field.
fn posed(state: &Value, field: &str, value: &Value) -> String {
    let mut pose = state["camera"].clone();
    pose[field] = value.clone();
    json!({ "pose": pose, "from": state["written"] }).to_string()
}

impl Sandbox {
    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("the file")
    }

    /// Moves the camera by one field, and waits for the picture.
    fn moved(&self, field: &str, value: &Value) -> Value {
        let state = self.until(|state| state["phase"] == "done");
        let answer = self.post("camera", &posed(&state, field, value));
        assert_eq!(answer.status, 204, "{}", answer.text());
        self.done_after(stage_of(&state))
    }
}

/// How much a camera sees is one of three fields, and that one is written, in each syntax; all else stays.
#[test]
fn a_zoom_is_written_where_the_camera_has_it() {
    let toml = |camera: &str| {
        format!(
            "background = 0.5\nimage = {{ width = 24, height = 16 }}\nrender.samples = 4\n# the eye\n{camera}\n\n\
             [[objects]]\nSphere = {{ center = [0, 0, 0], radius = 1 }}\n"
        )
    };
    let json = |camera: &str| {
        format!(
            "{{\n  \"camera\": {{ {camera} }},\n  \"image\": {{ \"width\": 24, \"height\": 16 }},\n  \
             \"background\": 0.5, \"objects\": [{{ \"Sphere\": {{ \"center\": [0, 0, 0], \"radius\": 1 }} }}]\n}}\n"
        )
    };
    for (name, text, field, from, to) in [
        ("scene.ron", scene("fov: 40"), "fov", "fov: 40", "fov: 61.5"),
        (
            "scene.ron",
            SCENE.replace("    camera: Camera(position: (0, 0, 5), look_at: (0, 0, 0), fov: 40), // the eye\n", ""),
            "fov",
            "Scene(\n",
            "Scene(\n    camera: Camera(fov: 61.5),\n",
        ),
        ("scene.ron", scene("focal_length: /* mm */ 35.0"), "focal_length", "35.0", "61.5"),
        ("scene.ron", scene("projection: Orthographic(height: 4.0)"), "height", "4.0", "61.5"),
        ("scene.toml", toml("[camera]\nfocal_length = 35 # mm"), "focal_length", "35 #", "61.5 #"),
        ("scene.toml", toml("camera.projection.Orthographic.height = 4"), "height", "height = 4", "height = 61.5"),
        ("scene.json", json("\"focal_length\": 35"), "focal_length", "35", "61.5"),
        (
            "scene.json",
            json("\"projection\": { \"Orthographic\": { \"height\": 4 } }"),
            "height",
            "\"height\": 4",
            "\"height\": 61.5",
        ),
    ] {
        // An image's height stands before it in TOML.
        let at = text.rfind(from).expect("it is there");
        let expected = format!("{}{to}{}", &text[..at], &text[at + from.len()..]);
        let sandbox = Sandbox::with(&text, |options| {
            options.scene.set_file_name(name);
            fs::write(&options.scene, &text).expect("the folder can be written");
        });
        let first = sandbox.done_after(0);
        let zooms = ["fov", "focal_length", "height"];
        let told: Vec<&str> = zooms.into_iter().filter(|zoom| first["camera"].get(zoom).is_some()).collect();
        assert_eq!((told, &first["moved"]), (vec![field], &json!(false)), "{text}");
        let before = sandbox.pixels();
        let moved = sandbox.moved(field, &json!(61.5));
        assert_eq!((&moved["camera"][field], &moved["moved"]), (&json!(61.5), &json!(true)), "{text}");
        assert_ne!(sandbox.pixels(), before, "{text}");
        let seen = sandbox.pixels();
        let answer = sandbox.post("camera/write", "{}");
        assert_eq!((answer.status, answer.text().as_str()), (200, "{\"edits\":1}"), "{text}");
        assert_eq!(sandbox.text(name), expected);
        let state = sandbox.until(|state| state["written"][field] == 61.5 && state["phase"] == "done");
        assert_eq!(state["moved"], false);
        assert_eq!(sandbox.pixels(), seen, "what is written is what was seen: {text}");
        assert_eq!(sandbox.post("camera/undo", "{}").status, 204);
        assert_eq!(sandbox.text(name), text);
    }
}

/// The editor saves another camera right before it is written here: neither is lost.
#[test]
fn what_an_editor_has_saved_is_never_overwritten() {
    let mut refused = 0;
    for round in 0..8 {
        let sandbox = Sandbox::new(SCENE);
        sandbox.moved("position", &json!([0, 1, 6]));
        let saved = SCENE.replace("fov: 40", "fov: 51") + "// mine\n";
        if round % 2 == 0 {
            sandbox.write("scene.ron", &saved)
        } else {
            sandbox.rename_save("scene.ron", &saved)
        }
        let answer = sandbox.post("camera/write", "{}");
        if answer.status == 409 {
            refused += 1;
            assert!(answer.text().contains("saved meanwhile"), "{}", answer.text());
            assert_eq!(sandbox.text("scene.ron"), saved);
        }
        // The editor's picture, from where the person has gone.
        let state = sandbox.until(|state| state["written"]["fov"] == 51.0 && state["phase"] == "done");
        if answer.status == 409 {
            assert_eq!(
                (&state["camera"]["position"], &state["camera"]["fov"]),
                (&json!([0.0, 1.0, 6.0]), &json!(51.0))
            );
            assert_eq!(sandbox.post("camera/write", "{}").json(), json!({ "edits": 1 }));
        }
        assert_eq!(sandbox.text("scene.ron"), saved.replace("(0, 0, 5)", "(0, 1, 6)"));
    }
    assert!(refused > 0, "it was never in time");
}

/// A page that moves the camera on has not heard yet what was saved.
#[test]
fn a_page_that_is_behind_takes_nothing_back() {
    let sandbox = Sandbox::new(SCENE);
    let first = sandbox.done_after(0);
    let saved = SCENE.replace("fov: 40", "fov: 51");
    sandbox.write("scene.ron", &saved);
    sandbox.done_after(stage_of(&first));
    assert_eq!(sandbox.post("camera", &posed(&first, "position", &json!([0, 1, 6]))).status, 204);
    let state = sandbox.until(|state| state["camera"]["position"][1] == 1.0 && state["phase"] == "done");
    assert_eq!(state["camera"]["fov"], 51.0);
    assert_eq!(sandbox.post("camera/write", "{}").json(), json!({ "edits": 1 }));
    assert_eq!(sandbox.text("scene.ron"), saved.replace("(0, 0, 5)", "(0, 1, 6)"));
    // Who has written the same another way wants to see that.
    let state = sandbox.until(|state| state["written"]["position"][1] == 1.0 && state["phase"] == "done");
    sandbox.moved("fov", &json!(30));
    sandbox.write("scene.ron", saved.replace("fov: 51", "fov: 52"));
    let state = sandbox.until(|now| now["written"]["fov"] == 52.0 && stage_of(now) > stage_of(&state));
    assert_eq!((&state["camera"]["fov"], &state["moved"]), (&json!(52.0), &json!(false)));
}

/// What cannot be written is told, and the file stays; what can be is written all the same.
#[test]
fn what_cannot_be_written_is_told() {
    let matrix = "matrix: ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 5)), focal_length: 35";
    let moving = "position: (0, 0, \"=5 + time\"), focal_length: 35), animation: Animation(frames: 8";
    let plain = "position: (0, 0, 5), focal_length: 35";
    let none: fn() -> Vec<Override> = Vec::new;
    let set: fn() -> Vec<Override> = || vec!["camera.focal_length=50".into()];
    for (camera, overrides, field, why) in [
        (matrix, none, "position", "stands by its `matrix`"),
        (matrix, none, "focal_length", ""),
        (moving, none, "position", "the camera moves"),
        (moving, none, "focal_length", ""),
        (plain, set, "focal_length", "`camera.focal_length` is set by --set"),
        (plain, set, "position", ""),
    ] {
        let text = scene(camera);
        let sandbox = Sandbox::with(&text, |options| options.overrides = overrides());
        let value = if field == "position" { json!([0.5, 1, 6]) } else { json!(61.5) };
        sandbox.moved(field, &value);
        let answer = sandbox.post("camera/write", "{}");
        if why.is_empty() {
            assert_eq!((answer.status, answer.text().as_str()), (200, "{\"edits\":1}"), "{camera}: {field}");
            let now = sandbox.text("scene.ron");
            let added = if camera == plain { ("(0, 0, 5)", "(0.5, 1, 6)") } else { ("length: 35", "length: 61.5") };
            assert_eq!(now, text.replace(added.0, added.1));
        } else {
            assert!(answer.status == 409 && answer.text().contains(why), "{camera}: {}", answer.text());
            assert_eq!(sandbox.text("scene.ron"), text);
        }
    }
    // Not moved, and another than the file has.
    let sandbox = Sandbox::with(&scene(plain), |options| options.overrides = set());
    sandbox.done_after(0);
    let answer = sandbox.post("camera/write", "{}");
    assert!(answer.status == 409 && answer.text().contains("set by --set"), "{}", answer.text());
}

#[test]
fn an_expression_that_gives_way_is_told() {
    let text = SCENE.replace(CAMERA, "focal_length: \"=f\"").replace("Scene(", "Scene(\n    vars: { \"f\": 35 },");
    let sandbox = Sandbox::new(&text);
    sandbox.moved("focal_length", &json!(61.5));
    assert_eq!(sandbox.post("camera/write", "{}").json(), json!({ "edits": 1, "expressions": 1 }));
    assert_eq!(sandbox.text("scene.ron"), text.replace("\"=f\"", "61.5"));
}

/// A pose that names what the camera does not go by would be lost without a word.
#[test]
fn a_zoom_of_another_kind_is_refused() {
    for (camera, field, why) in [
        ("focal_length: 35", "fov", "this camera goes by its `focal_length`, not by `fov`"),
        ("projection: Orthographic(height: 4)", "focal_length", "by its `height`, not by `focal_length`"),
        ("projection: Panorama", "fov", "cannot be zoomed"),
        ("fov: 40", "height", "by its `fov`, not by `height`"),
        ("focal_length: 35", "focal_length", "a length above zero"),
    ] {
        let sandbox = Sandbox::new(&scene(camera));
        let state = sandbox.done_after(0);
        let value = if why.ends_with("zero") { json!(-1) } else { json!(30) };
        let answer = sandbox.post("camera", &posed(&state, field, &value));
        assert!(answer.status == 400 && answer.text().contains(why), "{camera}: {}", answer.text());
    }
}
