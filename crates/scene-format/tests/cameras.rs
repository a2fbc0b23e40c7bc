//! What the fields of a camera say beside each other.

use scene_format::{Defaults, LoadError, Syntax, load_str, to_text};
use std::path::Path;

/// What is said twice is told, also where one of them is the default; and what is written with all defaults says
/// nothing twice.
#[test]
fn nothing_is_said_twice() {
    let scene = |camera: &str| format!("Scene(background: 1, camera: Camera({camera}), objects: [Sphere(radius: 1)])");
    let read = |text: &str| load_str("c.ron", text, Syntax::Ron, Path::new(""), &[]);
    for (camera, code) in [
        ("fov: 40, focal_length: 200", "E0209"),
        ("fov: 41, focal_length: 200", "E0209"),
        ("up: (0, 1, 0), matrix: ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 5))", "E0209"),
        ("position: (0, 0, 5), matrix: ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 5))", "E0209"),
        ("fov: 40, projection: Panorama", "E0212"),
        ("sensor_width: 20, projection: Panorama", "E0212"),
        ("sensor_width: 36, projection: Fisheye(fov: 180)", "E0212"),
        ("fov: 40, projection: Orthographic(height: 4)", "E0212"),
    ] {
        match read(&scene(camera)) {
            Err(LoadError::Invalid { diagnostics, .. }) => {
                let codes: Vec<String> = diagnostics.iter().map(|fault| fault.code.to_string()).collect();
                assert_eq!(codes, [code], "{camera}");
            }
            other => panic!("{camera}: {other:?}"),
        }
    }
    for camera in [
        "",
        "fov: 30, fov_axis: Diagonal",
        "focal_length: 50, sensor_width: 24",
        "matrix: ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 5))",
        "projection: Panorama",
        "projection: Fisheye(fov: 180)",
        "projection: Orthographic(height: 4)",
    ] {
        let first = read(&scene(camera)).expect("a scene").scene;
        for syntax in [Syntax::Ron, Syntax::Toml, Syntax::Json] {
            let written = to_text(&first, syntax, Defaults::Shown);
            let again = load_str("c", &written, syntax, Path::new(""), &[]);
            let again = again.unwrap_or_else(|error| panic!("{camera}: {error:?}\n{written}")).scene;
            assert_eq!(again.camera, first.camera, "{camera}");
        }
    }
}
