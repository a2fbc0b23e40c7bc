//! Lines that show what is no kind: the groups of a scene's fields, and fields that no kind's example has.

use super::snippets;

/// Fields of a scene as they may be written together, each with the word that it shows first.
const LINES: [(&str, &str); 37] = [
    ("Scene", "version: 1, background: (0.5, 0.7, 1)"),
    ("Scene", "include: [\"library.ron\"]"),
    ("Scene", "textures: {\"stone\": Noise(octaves: 4)}, materials: {\"wall\": Diffuse(albedo: \"stone\")}"),
    ("Animation", "animation: Animation(frames: 48, fps: 24, frame: 12)"),
    ("Camera", "camera: Camera(position: (3, 2, 6), look_at: (0, 1, 0), up: (0, 1, 0), fov: 35)"),
    ("Camera", "camera: Camera(position: (3, 2, 6), focal_length: 50, sensor_width: 36, near: 0.1)"),
    ("Camera", "camera: Camera(matrix: ((1, 0, 0, 0), (0, 1, 0, 1), (0, 0, 1, 5)))"),
    ("Camera", "camera: Camera(position: (\"=time\", 1, 6), shutter: 0.5, shift: (0, 0.2))"),
    (
        "Camera",
        "cameras: {\"front\": Camera(position: (0, 1, 6)), \"side\": Camera(position: (6, 1, 0))}, camera: \"side\"",
    ),
    ("Image", "image: Image(width: 1280, height: 720)"),
    ("Render", "render: Render(samples: 256, max_bounces: 8, seed: 7, clamp: 50)"),
    ("Render", "render: Render(noise: 0.02, time: 60, adaptive: Never)"),
    ("Effects", "effects: Effects(exposure: 0.5, tone_map: Filmic)"),
    (
        "ThinLens",
        "effects: Effects(depth_of_field: ThinLens(aperture: 0.1, focus_on: (0, 1, 0), blades: 6, tilt: (5, 0)))",
    ),
    ("Output", "output: Output(layers: [Albedo, Depth], alpha: true, light_groups: true)"),
    ("Output", "output: Output(backdrop: 1, masks: [\"ball\"], marks: {\"A\": (0, 1, 0)})"),
    ("Environment", "background: Environment(file: \"sky.hdr\", up: (0, 0, 1), camera_visible: false, group: \"sky\")"),
    (
        "SphereLight",
        "lights: [SphereLight(center: (0, 3, 0), radius: 0.2, intensity: 20, group: \"lamp\", name: \"key\")]",
    ),
    (
        "SphereLight",
        "lights: [SphereLight(center: (0, 3, 0), radius: 0.05, luminous_power: 806, camera_visible: false)]",
    ),
    ("SphereLight", "lights: [SphereLight(center: (0, 3, 0), radius: 0.05, luminous_intensity: 64)]"),
    ("SphereLight", "lights: [SphereLight(center: (0, 3, 0), radius: 0.05, luminance: 5000)]"),
    ("Emissive", "objects: [Rectangle(center: (0, 3, 0), material: Emissive(luminance: 5000, two_sided: true))]"),
    ("Noise", "objects: [Plane(material: Diffuse(albedo: Noise(lacunarity: 3)))]"),
    ("Wood", "objects: [Plane(material: Diffuse(albedo: Wood(distortion: 0.4)))]"),
    ("Transparent", "objects: [Box(material: Transparent(ior: 1.5, transmittance: (0.9, 1, 0.9)), rounding: 0.1)]"),
    (
        "BlinnPhong",
        "objects: [Plane(material: BlinnPhong(albedo: 0.5, specular: 0.3, exponent: 50, energy_conserving: true))]",
    ),
    (
        "Conductor",
        "objects: [Plane(material: Conductor(ior: (0.2, 0.9, 1.1), k: (3.9, 2.5, 2.2), multiple_scattering: true))]",
    ),
    ("Conductor", "objects: [Plane(material: Conductor(reflectance: (1, 0.8, 0.3), edge_tint: (1, 0.9, 0.7)))]"),
    ("Tube", "objects: [Tube(points: [(0, 0, 0), (1, 1, 0), (2, 0, 0)], radius: 0.1, closed: true, segments: 48)]"),
    ("Arrow", "objects: [Arrow(from: (0, 0, 0), to: (0, 2, 0), radius: 0.05, head_radius: 0.15, head_length: 0.4)]"),
    ("HeightField", "objects: [HeightField(file: \"checker.png\", size: (4, 1, 4), smooth: false)]"),
    ("Mesh", "objects: [Mesh(file: \"room.obj\", part: \"table\")]"),
    (
        "Mesh",
        "objects: [Mesh(points: [(0, 0, 0), (1, 0, 0), (0, 1, 0)], faces: [[0, 1, 2]], \
         colors: [\"#d03020\", \"#30a040\", \"#2050c0\"])]",
    ),
    (
        "Stop",
        "objects: [Plane(material: Diffuse(albedo: ColorRamp(input: Noise(), \
         stops: [Stop(at: 0, color: 0.1), Stop(at: 1, color: \"#e0b020\")])))]",
    ),
    (
        "Repeat",
        "objects: [Repeat(count: 5, index: \"i\", vars: {\"x\": \"=2*i\"}, \
         items: [Sphere(center: (\"=x\", 0, 0), radius: 0.5)])]",
    ),
    (
        "Pick",
        "objects: [Repeat(count: 5, items: [Sphere(center: (\"=2*i\", 0, 0), radius: Pick(from: [0.4, 0.6], index: \
         \"=i\"))])]",
    ),
    (
        "Ring",
        "objects: [Box(size: 0.4, transform: [Scale(factor: 2, about: (0, 0, 0))], \
         placements: Ring(count: 6, radius: 3, start: 15))]",
    ),
];

/// The line that shows a group of a scene's fields: `Camera`, or `Scene` itself.
pub(crate) fn group(name: &str) -> Option<&'static str> {
    LINES.iter().find(|(of, _)| *of == name).map(|(_, line)| *line)
}

/// A field as it may be written in the word that it belongs to, where an example has it: in another word it may mean
/// something else.
pub(crate) fn field(name: &str, of: &str) -> Option<&'static str> {
    let all = || LINES.iter().copied().chain(snippets().map(|(_, kind, words)| (kind, words)));
    let is_of_it = |words: &&str| words.strip_prefix(of).is_some_and(|rest| rest.starts_with('('));
    let within = |words: &'static str| places(words, name).filter_map(move |at| around(words, at)).find(is_of_it);
    // What stands in no brackets is a field of the scene, or as it is in whatever has it.
    let bare =
        |words: &'static str| places(words, name).filter_map(move |at| around(words, at)).find(|&it| it == words);
    let own = || all().filter(|(word, _)| *word == of).find_map(|(_, words)| within(words).or_else(|| bare(words)));
    own().or_else(|| all().find_map(|(_, words)| within(words))).or_else(|| all().find_map(|(_, words)| bare(words)))
}

/// Where a field stands in a text.
fn places<'t>(text: &'t str, field: &'t str) -> impl Iterator<Item = usize> + use<'t> {
    let bytes = text.as_bytes();
    text.match_indices(field).map(|(at, _)| at).filter(move |&at| {
        let alone = at.checked_sub(1).is_none_or(|before| !is_word(bytes[before]) && bytes[before] != b'"');
        alone && bytes.get(at + field.len()) == Some(&b':')
    })
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

/// The innermost `Name(..)` of a text about a place, or the whole line.
fn around(text: &'static str, at: usize) -> Option<&'static str> {
    let bytes = text.as_bytes();
    let mut depth = 0usize;
    let open = bytes[..at].iter().rposition(|byte| match byte {
        b')' | b']' | b'}' => {
            depth += 1;
            false
        }
        b'(' | b'[' | b'{' if depth > 0 => {
            depth -= 1;
            false
        }
        b'(' => true,
        _ => false,
    });
    let Some(open) = open else { return Some(text) };
    let start = bytes[..open].iter().rposition(|&byte| !is_word(byte)).map_or(0, |before| before + 1);
    let mut depth = 0usize;
    let length = bytes[open..].iter().position(|byte| {
        match byte {
            b'(' => depth += 1,
            b')' => depth -= 1,
            _ => {}
        }
        depth == 0
    })?;
    text.get(start..=open + length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Syntax, load_str};
    use std::path::Path;

    #[test]
    fn lines_load_and_hold_what_they_show() {
        let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/src"));
        for (of, line) in LINES {
            let own = line.starts_with("objects");
            let rest = if own { "" } else { ", objects: [Sphere(center: (0, 1, 0), radius: 1, name: \"ball\")]" };
            let text = format!("Scene({line}{rest})");
            let loaded = load_str(of, &text, Syntax::Ron, folder, &[]);
            assert!(loaded.is_ok(), "{text}: {:?}", loaded.err());
            assert!(of == "Scene" || line.contains(&format!("{of}(")), "{of}: {line}");
        }
    }

    #[test]
    fn fields_are_shown_where_they_belong() {
        assert_eq!(
            field("fov", "Camera"),
            Some("Camera(position: (3, 2, 6), look_at: (0, 1, 0), up: (0, 1, 0), fov: 35)")
        );
        assert_eq!(field("frames", "Animation"), Some("Animation(frames: 48, fps: 24, frame: 12)"));
        assert_eq!(field("about", "Scale"), Some("Scale(factor: 2, about: (0, 0, 0))"));
        assert_eq!(field("version", "Scene"), Some("version: 1, background: (0.5, 0.7, 1)"));
        assert_eq!(field("no_such_field", "Scene"), None);
    }
}
