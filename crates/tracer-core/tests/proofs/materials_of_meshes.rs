//! Materials of glTF files are what they are turned into: the same picture, byte for byte, as with that material
//! written in the scene.

use crate::support::meshes::picture;
use scene_format::{Syntax, load_str};
use std::path::Path;
use tracer_core::{Film, RenderOptions, Scene, Unobserved, compile, render};

/// A square of one material, whose picture stands in its buffer, and as a file beside it.
fn write(folder: &Path, material: &str) {
    let points: [[f32; 3]; 4] = [[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0]];
    let uvs: [[f32; 2]; 4] = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];
    let mut buffer: Vec<u8> = points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    buffer.extend(uvs.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    buffer.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|k| k.to_le_bytes()));
    let start = buffer.len();
    let png = std::fs::read(picture()).expect("a picture");
    buffer.extend(&png);
    let (all, length) = (buffer.len(), png.len());
    std::fs::write(folder.join("m.bin"), buffer).expect("written");
    std::fs::write(folder.join("beside.png"), png).expect("written");
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [
            {{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "indices": 2, "material": 0}}]}}],
        "materials": [{material}], "textures": [{{"source": 0}}, {{"source": 1}}],
        "images": [{{"bufferView": 3, "mimeType": "image/png"}}, {{"uri": "beside.png"}}],
        "buffers": [{{"uri": "m.bin", "byteLength": {all}}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 48}}, {{"buffer": 0, "byteOffset": 48, "byteLength": 32}},
            {{"buffer": 0, "byteOffset": 80, "byteLength": 12}},
            {{"buffer": 0, "byteOffset": {start}, "byteLength": {length}}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}},
            {{"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2"}},
            {{"bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR"}}]}}"#
    );
    std::fs::write(folder.join("m.gltf"), text).expect("written");
}

fn scene(folder: &Path, material: &str) -> Scene {
    let text = format!(
        "Scene(
            camera: Camera(position: (0.3, 2.5, 2), look_at: (0, 0, 0), fov: 50), image: Image(width: 40, height: 32),
            background: (0.1, 0.1, 0.12), lights: [SphereLight(center: (1, 3, 1), radius: 0.3, power: 100)],
            objects: [Mesh(file: \"m.gltf\"{material}), Sphere(center: (0.4, 0.4, 0), radius: 0.3),
                Plane(point: (0, -0.5, 0), normal: (0, 1, 0))],
        )"
    );
    compile(&load_str("s.ron", &text, Syntax::Ron, folder, &[]).expect("right").scene).expect("compiles")
}

fn rendered(scene: &Scene) -> Film {
    render(scene, &RenderOptions { samples: Some(4), ..RenderOptions::default() }, &Unobserved)
}

#[test]
fn materials_of_gltf_are_the_scenes() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = folder.path();
    let pbr = |words: &str| format!(r#"{{"pbrMetallicRoughness": {{{words}}}}}"#);
    for (own, written) in [
        (pbr(r#""metallicFactor": 0, "baseColorFactor": [0.8, 0.3, 0.1, 1]"#), "Diffuse(albedo: (0.8, 0.3, 0.1))"),
        (
            pbr(r#""metallicFactor": 0, "baseColorTexture": {"index": 0}"#),
            "Diffuse(albedo: Texture(file: \"m.gltf/images[0]\"))",
        ),
        (
            pbr(r#""metallicFactor": 0, "baseColorTexture": {"index": 1}, "baseColorFactor": [1, 0.5, 0.5, 1]"#),
            "Diffuse(albedo: Multiply(a: Texture(file: \"beside.png\"), b: (1, 0.5, 0.5)))",
        ),
        (
            pbr(r#""roughnessFactor": 0.25, "baseColorTexture": {"index": 0}"#),
            "Conductor(reflectance: Texture(file: \"beside.png\"), roughness: 0.25)",
        ),
        (r#"{"emissiveFactor": [1, 0.5, 0.25]}"#.to_owned(), "Emissive(radiance: (1, 0.5, 0.25), two_sided: true)"),
        (
            r#"{"extensions": {"KHR_materials_unlit": {}}, "pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}}"#
                .to_owned(),
            "Emissive(radiance: 1, color: Texture(file: \"beside.png\"), two_sided: true)",
        ),
        (
            r#"{"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1},
                "KHR_materials_ior": {"ior": 1.5}}, "pbrMetallicRoughness": {"roughnessFactor": 0}}"#
                .to_owned(),
            "Transparent(ior: 1.5)",
        ),
    ] {
        write(at, &own);
        let (ours, theirs) = (scene(at, ""), scene(at, &format!(", material: {written}")));
        assert!(!ours.warnings.iter().any(|told| told.code.as_str() == "W0511"), "{own}: {:?}", ours.warnings);
        // What within the file is a picture is no file of its own.
        assert!(ours.files.iter().all(|file| file.is_file()), "{:?}", ours.files);
        let (ours, theirs) = (rendered(&ours), rendered(&theirs));
        for (x, y) in (0..32).flat_map(|y| (0..40).map(move |x| (x, y))) {
            assert_eq!(ours.radiance(x, y), theirs.radiance(x, y), "{own}: ({x}, {y})");
        }
    }
}

/// What a picture within a file may be, and is not.
#[test]
fn pictures_that_are_not_there_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), "{}");
    let text = "Scene(background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1,
        material: Diffuse(albedo: Texture(file: \"m.gltf/images[7]\")))])";
    let desc = load_str("s.ron", text, Syntax::Ron, folder.path(), &[]).expect("right").scene;
    let Err(error) = compile(&desc) else { panic!("there is no such picture") };
    let fault = &error.diagnostics[0];
    assert_eq!(fault.code.as_str(), "E0502");
    assert!(fault.message.ends_with("m.gltf: there is no images[7]"), "{}", fault.message);
}
