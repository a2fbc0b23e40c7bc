//! What the golden scenes cover: every material in every shape under every effect, each later kind once, and each
//! layer.

use libtest_mimic::Failed;
use scene_format::SceneDesc;
use scene_format::desc::{Material, MaterialRef, Object, PixelFilter, Placements, Shading, ToneMap};
use std::collections::BTreeSet;
use std::path::PathBuf;
use tracer_core::LayerSet;

const MATERIALS: [&str; 5] = ["diffuse", "texture", "mirror", "transparent", "Blinn-Phong"];
const SHAPES: [&str; 4] = ["sphere", "flat mesh", "smooth mesh", "copies of a mesh"];
const EFFECTS: [&str; 5] = ["no effect", "antialiasing", "depth of field", "exposure", "tone map"];

/// Kinds of the language that need a picture of their own, in a folder of that name, and no more.
const FOLDERS: [&str; 27] = [
    "rectangle",
    "box",
    "disk",
    "cylinder",
    "cone",
    "capsule",
    "emissive",
    "checkerboard",
    "lines",
    "dots",
    "gradient",
    "noise",
    "wood",
    "marble",
    "voronoi",
    "conductor",
    "polygon",
    "extrude",
    "lathe",
    "torus",
    "tube",
    "arrow",
    "height_field",
    "mapping",
    "color_ramp",
    "mix",
    "multiply",
];

/// Fails where a combination is shown by no scene. What a scene is about is its first object.
pub fn check_coverage(scenes: &[PathBuf]) -> Result<(), Failed> {
    let mut shown = BTreeSet::new();
    for file in scenes {
        let scene = scene_format::load(file).map_err(|e| format!("{}: {e}", file.display()))?.scene;
        if let (Some(material), Some(shape)) = (material(&scene), shape(&scene)) {
            shown.extend(effects(&scene).into_iter().map(|effect| (material, shape, effect)));
        }
    }
    let all = MATERIALS.iter().flat_map(|&m| SHAPES.iter().flat_map(move |&s| EFFECTS.iter().map(move |&e| (m, s, e))));
    let missing: Vec<String> =
        all.filter(|case| !shown.contains(case)).map(|(m, s, e)| format!("{m}, {s}, {e}")).collect();
    let folder = |file: &PathBuf| Some(file.parent()?.file_name()?.to_string_lossy().into_owned());
    let folders: BTreeSet<String> = scenes.iter().filter_map(folder).collect();
    let layer = |name: &&str| !scenes.iter().any(|file| file.ends_with(format!("layers/{name}.ron")));
    let layers = LayerSet::all().names().filter(layer).map(|name| format!("golden/layers/{name}.ron"));
    let missing: Vec<String> = FOLDERS
        .iter()
        .filter(|name| !folders.contains(**name))
        .map(|name| format!("golden/{name}"))
        .chain(layers)
        .chain(missing)
        .collect();
    if missing.is_empty() { Ok(()) } else { Err(format!("no golden scene shows\n{}", missing.join("\n")).into()) }
}

fn material(scene: &SceneDesc) -> Option<&'static str> {
    let material = match scene.objects.first()?.value.material() {
        MaterialRef::Default => return None,
        MaterialRef::Named { name, .. } => &scene.materials.iter().find(|m| m.name.value == *name)?.material,
        MaterialRef::Inline(material) => &material.value,
    };
    Some(match material {
        Material::Diffuse(_) if !material.textures().is_empty() => "texture",
        Material::Diffuse(_) => "diffuse",
        Material::Mirror(_) => "mirror",
        Material::Transparent(_) => "transparent",
        Material::BlinnPhong(_) => "Blinn-Phong",
        // Each has a folder of its own.
        _ => return None,
    })
}

fn shape(scene: &SceneDesc) -> Option<&'static str> {
    Some(match &scene.objects.first()?.value {
        Object::Sphere(_) => "sphere",
        Object::Mesh(mesh) if mesh.placements != Placements::One => "copies of a mesh",
        Object::Mesh(mesh) if smooth(mesh) => "smooth mesh",
        Object::Mesh(_) => "flat mesh",
        // Each other shape has a folder of its own.
        _ => return None,
    })
}

/// `Auto` is smooth where the file has normals.
fn smooth(mesh: &scene_format::desc::Mesh) -> bool {
    match mesh.shading {
        Shading::Smooth => true,
        Shading::Flat => false,
        Shading::Auto => mesh.file().and_then(|file| file.value.file_stem()).is_some_and(|name| name == "icosphere"),
    }
}

/// An effect is one that differs from what a scene without a word about it has.
fn effects(scene: &SceneDesc) -> Vec<&'static str> {
    let effects = &scene.effects;
    let mut found = Vec::new();
    if effects.antialiasing != PixelFilter::default() {
        found.push("antialiasing");
    }
    if effects.depth_of_field.is_some() {
        found.push("depth of field");
    }
    if effects.exposure.value != 0.0 {
        found.push("exposure");
    }
    if effects.tone_map != ToneMap::None {
        found.push("tone map");
    }
    if found.is_empty() {
        found.push("no effect");
    }
    found
}
