//! The camera, written into a scene's text: all else stays as the person wrote it.

use scene_format::render::apply_edits;
use scene_format::{SceneDesc, Syntax, Viewpoint, ViewpointError, load, load_str, write_viewpoint};
use std::path::Path;

const VIEW: Viewpoint = Viewpoint {
    position: Some([1.0, 2.5, 55.0]),
    look_at: Some([0.0, 0.5, 0.0]),
    up: Some([0.0, 1.0, 0.0]),
    fov: Some(30.0),
    focal_length: None,
    height: None,
};

fn written(text: &str, syntax: Syntax) -> String {
    let edits = write_viewpoint(text, syntax, Path::new(""), &VIEW).unwrap_or_else(|error| panic!("{error}: {text}"));
    apply_edits(text, &edits)
}

#[test]
fn values_are_replaced_and_added_and_all_else_stays() {
    let rest = "background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)]";
    let spheres = "[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 }\n";
    for (syntax, before, after) in [
        (
            Syntax::Ron,
            format!(
                "// head\nScene(\n  camera: Camera( // all of it\n    // the eye\n    position: (0, 0, 5), // \
             here\n    look_at: [9, 9, 9],\n  ), {rest})"
            ),
            format!(
                "// head\nScene(\n  camera: Camera( // all of it\n    fov: 30,\n    // the eye\n    position: \
             (1, 2.5, 55), // here\n    look_at: [0, 0.5, 0],\n  ), {rest})"
            ),
        ),
        (
            Syntax::Ron,
            format!("(camera: (fov: /* wide */ 90), {rest})"),
            format!("(camera: (position: (1, 2.5, 55), look_at: (0, 0.5, 0), fov: /* wide */ 30), {rest})"),
        ),
        (
            Syntax::Ron,
            format!("Scene(cameras: {{ \"a\": Camera(), \"b\": Camera(fov: 50) }}, camera: \"b\", {rest})"),
            format!(
                "Scene(cameras: {{ \"a\": Camera(), \"b\": Camera(position: (1, 2.5, 55), look_at: (0, 0.5, \
             0), fov: 30) }}, camera: \"b\", {rest})"
            ),
        ),
        (
            Syntax::Ron,
            format!("Scene(camera: Camera(), {rest})"),
            format!("Scene(camera: Camera(position: (1, 2.5, 55), look_at: (0, 0.5, 0), fov: 30), {rest})"),
        ),
        (
            Syntax::Ron,
            format!("Scene(\r\n\t// first\r\n\t{rest}\r\n)"),
            format!(
                "Scene(\r\n\tcamera: Camera(position: (1, 2.5, 55), look_at: (0, 0.5, 0), fov: 30),\r\n\t// \
             first\r\n\t{rest}\r\n)"
            ),
        ),
        (
            Syntax::Ron,
            format!("Scene(vars: {{ \"h\": 2 }}, camera: Camera(position: (0, 0, 5), fov: \"=20 * h\"), {rest})"),
            format!(
                "Scene(vars: {{ \"h\": 2 }}, camera: Camera(look_at: (0, 0.5, 0), position: (1, 2.5, 55), fov: \
             30), {rest})"
            ),
        ),
        (
            Syntax::Ron,
            "{\n  \"camera\": { \"fov\": 50 },\n  \"background\": 1, \"objects\": [{ \"Sphere\": { \"center\": [0, \
             0, 0], \"radius\": 1 } }]\n}"
                .to_owned(),
            "{\n  \"camera\": { \"position\": [1, 2.5, 55], \"look_at\": [0, 0.5, 0], \"fov\": 30 },\n  \
             \"background\": 1, \"objects\": [{ \"Sphere\": { \"center\": [0, 0, 0], \"radius\": 1 } \
             }]\n}"
                .to_owned(),
        ),
        (
            Syntax::Toml,
            format!("background = 1\n[camera] # the eye\nposition = [0, 0, 5] # here\n\n{spheres}"),
            format!(
                "background = 1\n[camera] # the eye\nlook_at = [0, 0.5, 0]\nfov = 30\nposition = [1, 2.5, 55] \
             # here\n\n{spheres}"
            ),
        ),
        (
            Syntax::Toml,
            format!("background = 1\ncamera.fov = 50 # wide\n{spheres}"),
            format!(
                "background = 1\ncamera.fov = 30 # wide\ncamera.position = [1, 2.5, 55]\ncamera.look_at = [0, \
             0.5, 0]\n{spheres}"
            ),
        ),
        (
            Syntax::Toml,
            format!("background = 1\ncamera = {{ fov = 50 }}\n{spheres}"),
            format!(
                "background = 1\ncamera = {{ position = [1, 2.5, 55], look_at = [0, 0.5, 0], fov = 30 \
             }}\n{spheres}"
            ),
        ),
        (
            Syntax::Toml,
            format!("background = 1\n{spheres}"),
            format!(
                "background = 1\n{spheres}\n[camera]\nposition = [1, 2.5, 55]\nlook_at = [0, 0.5, 0]\nfov = \
             30\n"
            ),
        ),
    ] {
        let now = written(&before, syntax);
        assert_eq!(now, after);
        // What is written already is left alone.
        assert_eq!(write_viewpoint(&now, syntax, Path::new(""), &VIEW), Ok(Vec::new()));
    }
}

/// How much a camera sees is written where it goes by that, in each way to write it.
#[test]
fn focal_lengths_and_heights_are_replaced_where_they_stand() {
    let length = Viewpoint { focal_length: Some(52.5), ..Viewpoint::default() };
    let height = Viewpoint { height: Some(2.25), ..Viewpoint::default() };
    let ron = "background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)]";
    let toml = "[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 }\n";
    let json = "\"background\": 1, \"objects\": [{ \"Sphere\": { \"center\": [0, 0, 0], \"radius\": 1 } }]";
    for (view, syntax, text, old) in [
        (length, Syntax::Ron, format!("(camera: (focal_length: /* mm */ 35.0, sensor_width: 24), {ron})"), "35.0"),
        (length, Syntax::Ron, format!("(vars: {{ \"f\": 35 }}, camera: (focal_length: \"=f\"), {ron})"), "\"=f\""),
        (length, Syntax::Toml, format!("background = 1\n[camera]\nfocal_length = 35 # mm\n{toml}"), "35"),
        (length, Syntax::Json, format!("{{\n  \"camera\": {{ \"focal_length\": 35 }},\n  {json}\n}}"), "35"),
        (
            height,
            Syntax::Ron,
            format!("(camera: (projection: Orthographic( // seen\n height: 4.0 /* m */)), {ron})"),
            "4.0",
        ),
        (
            height,
            Syntax::Ron,
            format!("(cameras: {{ \"a\": (projection: Orthographic(height: 4)) }}, camera: \"a\", {ron})"),
            "4",
        ),
        (
            height,
            Syntax::Toml,
            format!("background = 1\ncamera = {{ projection = {{ Orthographic = {{ height = 4 }} }} }}\n{toml}"),
            "4",
        ),
        (
            height,
            Syntax::Toml,
            format!("background = 1\n[camera.projection.Orthographic]\nheight = 4 # m\n{toml}"),
            "4",
        ),
        (height, Syntax::Toml, format!("background = 1\ncamera.projection.Orthographic.height = 4\n{toml}"), "4"),
        (
            height,
            Syntax::Json,
            format!("{{ \"camera\": {{ \"projection\": {{ \"Orthographic\": {{ \"height\": 4 }} }} }}, {json} }}"),
            "4",
        ),
    ] {
        let new = if view == length { "52.5" } else { "2.25" };
        let edits =
            write_viewpoint(&text, syntax, Path::new(""), &view).unwrap_or_else(|error| panic!("{error}: {text}"));
        let after = apply_edits(&text, &edits);
        // Nothing before it has these digits.
        assert_eq!((edits.len(), &after), (1, &text.replacen(old, new, 1)));
        assert_eq!(write_viewpoint(&after, syntax, Path::new(""), &view), Ok(Vec::new()));
    }
}

#[test]
fn what_a_camera_does_not_go_by_is_not_written() {
    let rest = "background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)]";
    let write = |camera: &str, view: &Viewpoint| {
        write_viewpoint(&format!("Scene(camera: Camera({camera}), {rest})"), Syntax::Ron, Path::new(""), view)
    };
    let none = Viewpoint::default();
    for (camera, view) in [
        ("focal_length: 35", Viewpoint { fov: Some(30.0), ..none }),
        ("fov: 50", Viewpoint { height: Some(3.0), ..none }),
        ("projection: Panorama", Viewpoint { height: Some(3.0), ..none }),
        ("projection: Orthographic(height: 3)", Viewpoint { focal_length: Some(30.0), ..none }),
    ] {
        assert_eq!(write(camera, &view), Err(ViewpointError::Unknown), "{camera}");
    }
    let matrix = "matrix: ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 5))";
    assert_eq!(write(matrix, &Viewpoint { position: Some([1.0; 3]), ..none }), Err(ViewpointError::Matrix));
    assert_eq!(write(matrix, &Viewpoint { fov: Some(30.0), ..none }).map(|edits| edits.len()), Ok(1));
}

#[test]
fn a_camera_that_moves_is_left_alone() {
    let rest = "animation: Animation(frames: 9), background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)]";
    let write = |camera: &str| {
        let text = format!("Scene(vars: {{ \"far\": \"=5 + time\" }}, camera: Camera({camera}), {rest})");
        write_viewpoint(&text, Syntax::Ron, Path::new(""), &VIEW)
    };
    assert_eq!(write("position: (\"=time\", 0, 5)"), Err(ViewpointError::Moves));
    assert_eq!(write("position: (0, 0, \"=far\")"), Err(ViewpointError::Moves));
    // What moves and is not written anew does not matter, nor an expression that stands still.
    assert!(write("up: (0, 1, 0), fov: 30, position: (0, 0, \"=2 + 3\")").is_ok());
    assert!(write("near: \"=0.1 + time\"").is_ok());
}

#[test]
fn a_text_with_faults_is_left_alone() {
    let write = |text: &str| write_viewpoint(text, Syntax::Ron, Path::new(""), &VIEW);
    assert_eq!(write("Scene("), Err(ViewpointError::Wrong));
    assert_eq!(write("Scene(background: 1, objects: [], camera: Camera(fovv: 3))"), Err(ViewpointError::Wrong));
    assert_eq!(write(""), Err(ViewpointError::Wrong));
}

/// Every scene of the repository, in its own syntax: turned, and turned back, it says what it said.
#[test]
fn every_scene_can_be_turned() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut seen = 0;
    for entry in std::fs::read_dir(&root).expect("the scenes").flatten() {
        let path = entry.path();
        let Some(syntax) = Syntax::from_path(&path) else { continue };
        let text = std::fs::read_to_string(&path).expect("a scene");
        let write = |text: &str, viewpoint: &Viewpoint| {
            let edits = write_viewpoint(text, syntax, &root, viewpoint)
                .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            apply_edits(text, &edits)
        };
        let scene = load(&path).expect("the scene is right").scene;
        let there = Viewpoint::of(&scene.camera);
        // Each goes by one of them, or by none.
        let view = Viewpoint {
            fov: there.fov.map(|_| 30.0),
            focal_length: there.focal_length.map(|_| 31.5),
            height: there.height.map(|_| 7.25),
            ..VIEW
        };
        let turned = write(&text, &view);
        let back = write(&turned, &there);
        let again = load_str("", &back, syntax, &root, &[]).expect("it is right").scene;
        assert_eq!(SceneDesc { sources: Vec::new(), ..again }, SceneDesc { sources: Vec::new(), ..scene });
        seen += 1;
    }
    assert!(seen > 8, "{seen} scenes");
}
