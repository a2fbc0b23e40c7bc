//! From a [`SceneDesc`] back to text, and to a hash that says whether two scenes say the same.

use crate::desc::{CameraChoice, Film, Object, Objects, Scene, SceneDesc, group};
use crate::diagnostic::Spanned;
use crate::form::{Entry, Form};
use crate::print;
use crate::syntax::Syntax;
use crate::words::Words;
use sha2::{Digest, Sha256};

/// Whether fields that have their default are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Defaults {
    /// Only what differs from the default.
    Hidden,
    /// Every field: the scene as the program sees it.
    Shown,
}

/// A scene as RON.
pub fn to_ron(scene: &SceneDesc, defaults: Defaults) -> String {
    print::ron(&form(scene, defaults), &[], &[])
}

/// A scene as TOML.
pub fn to_toml(scene: &SceneDesc, defaults: Defaults) -> String {
    print::toml(&form(scene, defaults), &[], &[])
}

/// A scene as JSON.
pub fn to_json(scene: &SceneDesc, defaults: Defaults) -> String {
    print::json(&form(scene, defaults))
}

/// A scene in any syntax.
pub fn to_text(scene: &SceneDesc, syntax: Syntax, defaults: Defaults) -> String {
    print::scene(&form(scene, defaults), syntax, &[], &[])
}

pub(crate) fn form(scene: &SceneDesc, defaults: Defaults) -> Form {
    form_with(scene, scene.objects.clone(), defaults)
}

/// A scene with these objects in place of its own.
fn form_with(scene: &SceneDesc, objects: Vec<Spanned<Object>>, defaults: Defaults) -> Form {
    let words = Scene {
        include: crate::read::Includes,
        vars: crate::read::Vars,
        version: scene.version,
        animation: Film(scene.animation.clone()),
        camera: CameraChoice::of(&scene.camera, scene.camera_name.as_ref(), &scene.cameras),
        cameras: scene.cameras.clone(),
        image: scene.image.clone(),
        render: scene.render.clone(),
        effects: scene.effects.clone(),
        output: scene.output.clone(),
        background: scene.background.clone(),
        lights: scene.lights.clone(),
        textures: scene.textures.clone(),
        materials: scene.materials.clone(),
        objects: Objects(objects),
    };
    let mut form = words.form(defaults == Defaults::Shown);
    if let Form::Struct { fields, .. } = &mut form {
        // The version is said even when it is the default: it is what makes old files load for ever.
        if fields.first().is_none_or(|field| field.name != "version") {
            fields.insert(0, Entry::new("version", Form::Integer(u64::from(scene.version))));
        }
    }
    form
}

/// SHA-256 over what the scene says: every field that differs from its default, with its value; not how it is written,
/// nor where.
///
/// A field that has its default counts as not written, so that a field that the language gets later changes no hash of
/// today. (A default never changes within a version of the language.) Two scenes have the same hash when they have the
/// same fields with the same numbers, whatever the syntax, the order of materials and of fields, the comments, or the
/// form of the numbers. Files that a scene names count by their names alone. Where something moves while the shutter is
/// open, what the scene says at several moments counts.
pub fn hash(scene: &SceneDesc) -> [u8; 32] {
    let mut hasher = Sha256::new();
    hasher.update(b"tracer scene 1");
    feed_scene(&mut hasher, scene);
    if scene.moves() {
        // Two ways to move that agree here are the same for all practical purposes.
        for k in 0..8 {
            let later = scene.at(scene.camera.shutter.value * (f64::from(k) + 0.5) / 8.0);
            match later {
                Ok(later) => feed_scene(&mut hasher, &later),
                Err(_) => feed(&mut hasher, &Form::Absent),
            }
        }
    }
    hasher.finalize().into()
}

/// [`hash`] as 64 hexadecimal digits.
pub fn hash_hex(scene: &SceneDesc) -> String {
    hash(scene).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Feeds a scene as [`feed`] feeds its form, but for the objects, of which there may be millions, one at a time.
fn feed_scene(hasher: &mut Sha256, scene: &SceneDesc) {
    let bare = form_with(scene, Vec::new(), Defaults::Hidden);
    let Form::Struct { name, fields } = &bare else { return feed(hasher, &bare) };
    // The objects are the last field; where there are none it is not written.
    let has_objects = !scene.objects.is_empty();
    tagged(hasher, b'(', name.as_bytes());
    tagged(hasher, b'#', &((fields.len() + usize::from(has_objects)) as u64).to_le_bytes());
    feed_fields(hasher, &fields.iter().collect::<Vec<&Entry>>());
    if has_objects {
        feed(hasher, &Form::Text("objects".to_owned()));
        let entries = group::entries(&scene.objects);
        tagged(hasher, b'[', &(entries.clone().count() as u64).to_le_bytes());
        entries.for_each(|entry| feed(hasher, &group::form_of_entry(entry, false)));
    }
}

/// Feeds a value: a tag for its kind, its length where it has one, its content.
fn feed(hasher: &mut Sha256, form: &Form) {
    let mut tagged = |tag: u8, bytes: &[u8]| tagged(hasher, tag, bytes);
    match form {
        Form::Absent => tagged(b'-', &[]),
        Form::Bool(value) => tagged(b'b', &[u8::from(*value)]),
        // Minus zero is zero.
        Form::Number(value) => tagged(b'n', &(value + 0.0).to_bits().to_le_bytes()),
        Form::Integer(value) => tagged(b'i', &value.to_le_bytes()),
        Form::Lexeme(text) => tagged(b'l', text.as_bytes()),
        Form::Text(text) => tagged(b't', text.as_bytes()),
        Form::Vector(numbers) => {
            tagged(b'v', &[]);
            numbers.iter().for_each(|number| feed(hasher, number));
        }
        Form::List(entries) => {
            tagged(b'[', &(entries.len() as u64).to_le_bytes());
            entries.iter().for_each(|entry| feed(hasher, &entry.value));
        }
        Form::Map(entries) => {
            tagged(b'{', &(entries.len() as u64).to_le_bytes());
            let mut sorted: Vec<&Entry> = entries.iter().collect();
            sorted.sort_by(|a, b| a.name.cmp(&b.name));
            feed_fields(hasher, &sorted);
        }
        Form::Struct { name, fields } => {
            tagged(b'(', name.as_bytes());
            tagged(b'#', &(fields.len() as u64).to_le_bytes());
            feed_fields(hasher, &fields.iter().collect::<Vec<&Entry>>());
        }
        Form::Variant { name, content } => {
            tagged(b'|', name.as_bytes());
            feed(hasher, content.as_deref().unwrap_or(&Form::Absent));
        }
    }
}

fn tagged(hasher: &mut Sha256, tag: u8, bytes: &[u8]) {
    hasher.update([tag]);
    hasher.update((bytes.len() as u64).to_le_bytes());
    hasher.update(bytes);
}

fn feed_fields(hasher: &mut Sha256, fields: &[&Entry]) {
    for field in fields {
        feed(hasher, &Form::Text(field.name.to_string()));
        feed(hasher, &field.value);
    }
}
