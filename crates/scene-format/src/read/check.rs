//! What only the scene as a whole can tell: version, the camera's directions, light.

use super::{Reader, Step};
use crate::codes;
use crate::desc::{CameraChoice, Chosen, Integrator, MaterialRef, Object, Output, Scene, VERSION};
use crate::diagnostic::{Diagnostic, Severity, Span, Spanned};
use crate::schema::{FieldDef, Rule, Type};
use crate::suggest;
use crate::syntax::{Sink, Syntax};
use crate::tree::{Item, Kind, Tree};
use crate::words::Words;
use std::collections::BTreeSet;

pub(super) static ROOT: FieldDef =
    FieldDef { name: "", noun: "the scene", doc: &[], kind: Type::Bool, rule: Rule::ANY, default: None };

/// The words of a scene, and which of its cameras is meant.
pub(crate) struct Whole {
    pub scene: Scene,
    pub camera: Chosen,
    /// Whether anything moves while the camera's shutter is open.
    pub moves: bool,
}

/// Reads a whole scene. What is wrong goes to `sink`; the result counts only when that holds no error.
// Long: one step after the other.
pub(crate) fn scene(tree: &Tree<'_>, sink: &mut Sink) -> Option<Whole> {
    let syntax_errors = sink.errors;
    let Some(root) = tree.root() else {
        if syntax_errors > 0 {
            return None;
        }
        let syntax = tree.texts.first().map_or(Syntax::Ron, |text| text.syntax);
        sink.push(no_objects(Span { source: 0, start: 0, end: 0 }, "the file is empty", syntax));
        return None;
    };
    if newer_version(root, sink) {
        return None;
    }
    let mut reader = Reader::new(sink);
    reader.clock = super::clock::Clock::of(root, tree.share);
    reader.first_included = (tree.texts.len() - tree.included.len()) as u32;
    // Names of materials may be missing where `materials` itself is mistyped or could not be read.
    let unread = |key: Item<'_, '_>, value: Item<'_, '_>, field: &str| {
        let name = key.text();
        name == field && value.kind() == Kind::Broken
            || Scene::DEF.field(&name).is_none() && super::unknown::is_meant(&name, root, &Scene::DEF, field)
    };
    let damaged = |field: &str| {
        root.fields().take(super::LOOK_AT).any(|(key, value)| unread(key, value, field)) || root.is_damaged()
    };
    (reader.materials.damaged, reader.cameras.damaged) = (damaged("materials"), damaged("cameras"));
    reader.named.damaged = damaged("textures");
    reader.foretell_textures(root);
    let scene = Scene::read(&mut reader, root, &ROOT);
    reader.several_cameras(root);
    reader.camera_of_set(root);
    reader.pending_vars(root);
    let objects = root.fields().find(|(key, _)| key.text() == "objects").map(|(_, value)| value);
    let no_root = scene.is_none();
    let missing = match objects {
        Some(list) => (list.kind() == Kind::List && list.children().next().is_none()).then(|| list.span()),
        None => {
            let mistyped = root.fields().take(super::LOOK_AT).any(|(key, _)| {
                let key = key.text();
                Object::DEF.variant(&key).is_some()
                    || Scene::DEF.field(&key).is_none()
                        && suggest::nearest(&key, super::names(&Scene::DEF)) == Some("objects")
            });
            (!no_root && !mistyped && !root.is_damaged() && syntax_errors == 0).then(|| root.head())
        }
    };
    if let Some(span) = missing {
        let message = if root.fields().next().is_none() { "the scene is empty" } else { "the scene has no objects" };
        reader.path.push(Step::Field("objects"));
        reader.report(no_objects(span, message, root.syntax()));
        reader.path.pop();
    }
    let mut scene = scene?;
    let chosen = reader.chosen(std::mem::replace(&mut scene.camera, CameraChoice::Only));
    reader.output(&scene.output);
    reader.masks(&scene);
    let camera = root.fields().find(|(key, _)| key.text() == "camera").map(|(_, value)| value);
    if camera.is_none_or(|camera| !camera.holds_damage()) {
        reader.check_cameras(&chosen, &scene.effects, root.syntax());
    }
    // Warnings about what is absent mean something only when the structure could be read.
    let structure = |fault: &Diagnostic| fault.severity == Severity::Error && !fault.code.is_value();
    if !reader.sink.diagnostics.iter().any(structure) {
        reader.unused_names(tree);
        reader.nothing_moves(&chosen.camera.shutter);
        let lights = root.fields().find(|(key, _)| key.text() == "lights").map(|(_, value)| value);
        let dark = lights.is_none_or(|lights| lights.children().next().is_none());
        let black = scene.background.is_black();
        let is_wrong = reader.sink.diagnostics.iter().any(|fault| fault.path.starts_with("background"));
        // What the materials of a mesh's own file are, whoever reads that file says.
        let may_shine = |object: &Spanned<Object>| shines(&object.value) || object.value.has_materials_of_file();
        // Which is of no light.
        let occlusion = matches!(scene.render.integrator, Integrator::AmbientOcclusion { .. });
        let dark = dark && black && !occlusion && !is_wrong && !reader.materials.any_shines();
        if dark && !scene.objects.0.iter().any(may_shine) {
            let lights = lights.map(|lights| lights.span());
            reader.path.push(Step::Field("lights"));
            reader.report(
                Diagnostic::warning(
                    codes::BLACK_PICTURE,
                    lights.unwrap_or(root.head()),
                    "the scene has no light, so the picture will be black",
                )
                .hint(match root.syntax() {
                    Syntax::Ron => {
                        "add `lights: [SphereLight(center: (0, 10, 0), radius: 1, radiance: 50)]` or `background: 1`"
                    }
                    Syntax::Toml => "add a [[lights]] table, or `background = 1`",
                    Syntax::Json => "add `\"lights\": [..]`, or `\"background\": 1`",
                }),
            );
            reader.path.pop();
        }
    }
    reader.all_copies(&scene.objects.0);
    scene.textures = reader.take_textures();
    scene.materials = reader.materials.take();
    scene.cameras = reader.cameras.take();
    reader.shapes(&scene);
    reader.unseen(root, &scene);
    let moves = reader.moves(&chosen.camera.shutter);
    Some(Whole { scene, camera: chosen, moves })
}

/// Whether an object shines by a material that it has itself, or one of the shapes that it is made of does.
fn shines(object: &Object) -> bool {
    let own = match object.material() {
        MaterialRef::Inline(material) => material.value.shines().is_some(),
        MaterialRef::Named { .. } | MaterialRef::Default => false,
    };
    own || object.operands().is_some_and(|operands| operands.0.iter().any(|operand| shines(&operand.value)))
}

fn no_objects(span: Span, message: &str, syntax: Syntax) -> Diagnostic {
    Diagnostic::error(codes::NO_OBJECTS, span, message)
        .expected("at least one object")
        .hint(match syntax {
            Syntax::Ron => "add `objects: [Sphere(center: (0, 0, 0), radius: 1)]`",
            Syntax::Toml => "add a [[objects]] table with `Sphere = { center = [0, 0, 0], radius = 1 }`",
            Syntax::Json => r#"add `"objects": [{ "Sphere": { "center": [0, 0, 0], "radius": 1 } }]`"#,
        })
        .at_path("objects")
}

/// A scene of a later version: that is all that is said of it.
pub(super) fn newer_version(root: Item<'_, '_>, sink: &mut Sink) -> bool {
    let Some((_, version)) = root.fields().find(|(key, _)| key.text() == "version") else { return false };
    let newer = version.kind() == Kind::Integer && version.number().is_some_and(|number| number > f64::from(VERSION));
    if newer {
        sink.push(
            Diagnostic::error(
                codes::NEWER_VERSION,
                version.span(),
                format!(
                    "this scene is written in version {} of the language, and this program knows version {VERSION}",
                    super::shortened(version.lexeme())
                ),
            )
            .expected(format!("version {VERSION}"))
            .hint("use a newer tracer")
            .at_path("version"),
        );
    }
    newer
}

/// Objects that a scene may have, their copies counted.
const MOST_OBJECTS: u64 = 100_000_000;

impl Reader<'_> {
    /// There may not be too many objects: copies of groups within each other soon are.
    fn all_copies(&mut self, objects: &[Spanned<Object>]) {
        let mut all = 0u64;
        for object in objects {
            all = all.saturating_add(object.value.placements().known_copies());
            if all > MOST_OBJECTS {
                let message = format!("the scene has more than {MOST_OBJECTS} objects, copies counted");
                self.report(Diagnostic::error(codes::TOO_MUCH, object.span, message).expected("fewer copies"));
                return;
            }
        }
    }

    /// A picture is laid over another one, or has a colour behind everything.
    fn output(&mut self, output: &Output) {
        if let Some(backdrop) = output.backdrop.as_ref().filter(|_| output.alpha) {
            self.path = vec![Step::Field("output"), Step::Field("backdrop")];
            let message = "the output has both `alpha: true` and `backdrop`";
            let fault = Diagnostic::error(codes::EXACTLY_ONE, backdrop.span, message);
            self.report(
                fault.expected("one of them: nothing behind everything, or a colour").hint("remove one of the two"),
            );
            self.path.clear();
        }
    }

    /// Masks are of what is there.
    fn masks(&mut self, scene: &Scene) {
        if scene.output.masks.is_empty() || self.sink.diagnostics.iter().any(|d| d.severity == Severity::Error) {
            return;
        }
        let objects = scene.objects.0.iter().filter_map(|object| object.value.name().as_str());
        let lights = scene.lights.iter().filter_map(|light| light.value.name().as_str());
        let names: BTreeSet<&str> = objects.chain(lights).collect();
        for (k, mask) in scene.output.masks.iter().enumerate() {
            let name = mask.value.0.as_str();
            self.path = vec![Step::Field("output"), Step::Field("masks"), Step::Index(k)];
            // OpenEXR's names of channels have 255 bytes at most, with `mask.` and `.Y`, and end at a zero.
            if name.len() > MASK_NAME || name.contains('\0') {
                let message = format!("\"{}\" cannot name a layer of a picture", super::shortened(name));
                let expected = format!("a name of at most {MASK_NAME} bytes without a zero byte");
                self.report(Diagnostic::error(codes::UNKNOWN_MASK, mask.span, message).expected(expected));
                continue;
            }
            if names.contains(name) {
                continue;
            }
            let message = format!("no object has the name \"{}\"", super::shortened(name));
            let mut fault = Diagnostic::error(codes::UNKNOWN_MASK, mask.span, message)
                .expected("a name that an object or a light has")
                .hint("give it one: `name: \"lamp\"`; of a group or an include the objects in it need it");
            fault.did_you_mean(suggest::nearest(name, names.iter().copied()), |name| format!("{name:?}"));
            self.report(fault);
        }
        self.path.clear();
    }
}

/// Bytes of a mask's name at most.
const MASK_NAME: usize = 240;
