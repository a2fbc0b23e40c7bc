//! Words of other programs: each gets one error, whose hint says what the language has for it, or that it has none.

use scene_format::{Diagnostic, LoadError, Severity, Syntax, load_str};
use std::path::Path;

fn errors(text: &str) -> Vec<Diagnostic> {
    match load_str("scene", text, Syntax::Ron, Path::new(""), &[]) {
        Err(LoadError::Invalid { diagnostics, .. }) => {
            diagnostics.into_iter().filter(|fault| fault.severity == Severity::Error).collect()
        }
        _ => Vec::new(),
    }
}

/// A scene with something in one place.
fn scene(top: &str, camera: &str, object: &str) -> String {
    format!(
        "Scene({top} background: 1, camera: Camera({camera}), objects: [Sphere(center: (0, 0, 0), radius: 1), {object}])"
    )
}

fn check(cases: &[(&str, &str)], scene: impl Fn(&str) -> String) {
    let mut wrong = Vec::new();
    for (written, told) in cases {
        let errors = errors(&scene(written));
        let hints: Vec<&str> = errors.iter().map(|fault| &*fault.hint).collect();
        if errors.len() != 1 || !hints[0].contains(told) {
            let messages: Vec<&str> = errors.iter().map(|fault| &*fault.message).collect();
            wrong.push(format!("{written}: {messages:?}, hints {hints:?}, not {told:?}"));
        }
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}

#[test]
fn kinds_of_objects() {
    let cases = [
        ("AreaLight(size: 1)", "Emissive(radiance: 5)"),
        ("Pyramid(radius: 1)", "`Mesh`"),
        ("Ellipsoid(radius: 1)", "`transform: [Scale((1, 2, 1))]`"),
        ("Collection(objects: [])", "did you mean `Group`?"),
        ("Instance(of: 1)", "`placements`"),
        ("Difference(a: 1)", "cannot be cut"),
        ("Plane(y: 0)", "`Rectangle(size: 20)`"),
        ("PointLight(radius: 1)", "`lights`"),
        ("Box(size: 1, id: 1)", "has a `name`"),
        ("Box(size: 1, visible: false)", "leave the object out"),
        ("Box(size: 1, emission: 3)", "Emissive(radiance: 5)"),
        ("Box(size: 1, transform: [Matrix([1, 0, 0])])", "placements file"),
        ("Box(size: 1, transform: [LookAt((0, 0, 0))])", "Rotate(axis: (0, 1, 0), degrees: 90)"),
        ("Box(size: 1, transform: [Shear(1)])", "no shear"),
    ];
    check(&cases, |object| scene("", "", object));
}

#[test]
fn kinds_of_materials_and_textures() {
    let cases = [
        ("Translucent()", "no such material"),
        ("Principled(roughness: 0.2)", "BlinnPhong("),
        ("RoughConductor(alpha: 0.1)", "`Conductor(reflectance: ..)`"),
        ("Glass(roughness: 0.1)", "`Transparent(ior: ..)`"),
        ("FrostedGlass()", "smooth"),
        ("Mix(a: 1)", "cannot be mixed"),
        ("Diffuse(bump: 1)", "no bumps"),
        ("Diffuse(roughness: 1)", "`exponent` of BlinnPhong"),
        ("Diffuse(albedo: Perlin())", "did you mean `Noise`?"),
        ("Diffuse(albedo: Checker())", "did you mean `Checkerboard`?"),
        ("Diffuse(albedo: Bricks(a: 1))", "make a picture of it"),
        ("Diffuse(albedo: Worley())", "did you mean `Voronoi`?"),
        ("Diffuse(albedo: Crackle())", "did you mean `Voronoi`?"),
        ("Diffuse(albedo: Granite())", "did you mean `Noise`?"),
        ("Diffuse(albedo: Agate())", "did you mean `Marble`?"),
        ("Diffuse(albedo: Wave())", "Marble(..) in planes"),
        ("Diffuse(albedo: ColorRamp(stops: 1))", "`a` and `b`"),
        ("Diffuse(albedo: Lines(mapping: Object()))", "lie on surfaces: Uv(..)"),
        ("Diffuse(albedo: Texture(file: \"a.png\", mapping: World()))", "lie on surfaces: Uv(..)"),
        ("Diffuse(albedo: Noise(mapping: Triplanar(scale: 2)))", "Object(..) and World(..)"),
        ("Diffuse(albedo: Noise(mapping: Local()))", "did you mean `Object`?"),
        ("Diffuse(albedo: Grid())", "did you mean `Lines`?"),
    ];
    check(&cases, |material| scene("", "", &format!("Box(size: 1, material: {material})")));
}

#[test]
fn kinds_of_lights() {
    let cases = [
        ("EnvironmentMap(file: 1)", "`Environment(file: \"sky.hdr\")`"),
        ("DirectionalLight(direction: (0, 1, 0))", "a sun is a large sphere light"),
        ("SpotLight(position: (0, 1, 0))", "there is no spotlight"),
        ("AreaLight(size: 1)", "Emissive(radiance: 5)"),
        ("PointLight(position: (0, 5, 0), intensity: 3)", "`SphereLight(center: .., radius: .., power: ..)`"),
        ("SphereLight(center: (0, 5, 0), radius: 1, color: (1, 1, 1))", "per channel"),
        ("SphereLight(center: (0, 5, 0), radius: 1, brightness: 3)", "`radiance`"),
    ];
    check(&cases, |light| scene(&format!("lights: [{light}],"), "", ""));
}

#[test]
fn fields_of_the_scene_and_of_the_camera() {
    let of_scene = [
        ("sky: 1,", "`background`"),
        ("emission: 1,", "Emissive(radiance: 5)"),
        ("vertices: 1,", "Mesh(file:"),
        ("bump: 1,", "no bumps"),
        ("roughness: 1,", "`exponent`"),
        ("resolution: 1,", "Image(width: 640, height: 480)"),
        ("name: 1,", "comment"),
    ];
    check(&of_scene, |field| scene(field, "", ""));
    let of_camera = [
        ("dof: 1", "ThinLens(aperture: 0.1, focus_distance: 5)"),
        ("focal_length: 50", "27 for 50 mm"),
        ("projection: 1", "in perspective"),
        ("near: 1", "no clip planes"),
        ("direction: (0, 0, -1)", "`look_at`"),
    ];
    check(&of_camera, |field| scene("", field, ""));
}

/// What hints tell to write is right.
#[test]
fn what_hints_tell_to_write_loads() {
    let objects = [
        "Rectangle(size: 20)",
        "Rectangle(size: 1, material: Emissive(radiance: 5))",
        "Box(size: 1, material: BlinnPhong(albedo: 0.5, exponent: 1000, specular: 1, energy_conserving: true))",
        "Box(size: 1, material: Transparent(ior: 1.5), transform: [Scale((-1, 1, 1)), Rotate(axis: (0, 1, 0), degrees: 90)])",
        "Repeat(count: 2, items: [Box(size: 1)])",
    ];
    for object in objects {
        assert!(errors(&scene("", "", object)).is_empty(), "{object}");
    }
    let top = "image: Image(width: 640, height: 480), effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_distance: 5)),";
    assert!(errors(&scene(top, "", "")).is_empty());
}
