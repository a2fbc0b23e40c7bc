//! What only the scene as a whole can tell: version, materials and who uses them, the camera's directions, light.

use super::{Reader, Step};
use crate::codes;
use crate::desc::{Camera, Material, NamedMaterial, Scene, VERSION, Vec3};
use crate::diagnostic::{Diagnostic, Severity, Span, Spanned};
use crate::schema::{FieldDef, Rule, Type};
use crate::suggest;
use crate::syntax::{Sink, Syntax};
use crate::tree::{Item, Kind, Tree};
use crate::words::Words;

/// Comparisons of unknown names with known ones.
const MAX_COMPARISONS: usize = 200_000;

static ROOT: FieldDef =
    FieldDef { name: "", noun: "the scene", doc: &[], kind: Type::Bool, rule: Rule::ANY, default: None };

/// Reads a whole scene. What is wrong goes to `sink`; the result counts only when that holds no error.
pub(crate) fn scene(tree: &Tree<'_>, sink: &mut Sink) -> Option<Scene> {
    let syntax_errors = sink.errors;
    let Some(root) = tree.root() else {
        if syntax_errors > 0 {
            return None;
        }
        sink.push(no_objects(Span { source: 0, start: 0, end: 0 }, "the file is empty", Syntax::Ron));
        return None;
    };
    if newer_version(root, sink) {
        return None;
    }
    let mut reader = Reader::new(sink);
    // Names of materials may be missing where `materials` itself is mistyped or could not be read.
    let unread = |key: Item<'_, '_>, value: Item<'_, '_>| {
        let name = key.text();
        name == "materials" && value.kind() == Kind::Broken
            || Scene::DEF.field(&name).is_none() && super::meant(&name, root, &Scene::DEF) == Some("materials")
    };
    reader.materials.damaged =
        root.fields().take(super::LOOK_AT).any(|(key, value)| unread(key, value)) || root.is_damaged();
    let scene = Scene::read(&mut reader, root, &ROOT);
    let objects = root.fields().find(|(key, _)| key.text() == "objects").map(|(_, value)| value);
    let no_root = scene.is_none();
    let missing = match objects {
        Some(list) => (list.kind() == Kind::List && list.children().next().is_none()).then(|| list.span()),
        None => {
            let mistyped = root.fields().take(super::LOOK_AT).any(|(key, _)| {
                let key = key.text();
                Scene::DEF.field(&key).is_none() && suggest::nearest(&key, super::names(&Scene::DEF)) == Some("objects")
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
    let scene = scene?;
    let camera = root.fields().find(|(key, _)| key.text() == "camera").map(|(_, value)| value);
    if camera.is_none_or(|camera| !camera.holds_damage()) {
        reader.camera(&scene.camera, root.syntax());
    }
    // Warnings about what is absent mean something only when the structure could be read.
    let structure = |fault: &Diagnostic| fault.severity == Severity::Error && !fault.code.starts_with("E03");
    if !reader.sink.diagnostics.iter().any(structure) {
        reader.unused_materials();
        let lights = root.fields().find(|(key, _)| key.text() == "lights").map(|(_, value)| value);
        let dark = lights.is_none_or(|lights| lights.children().next().is_none());
        let black = root.fields().all(|(key, _)| key.text() != "background") || scene.background == [0.0; 3];
        if dark && black {
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
                }),
            );
            reader.path.pop();
        }
    }
    Some(scene)
}

fn no_objects(span: Span, message: &str, syntax: Syntax) -> Diagnostic {
    Diagnostic::error(codes::NO_OBJECTS, span, message)
        .expected("at least one object")
        .hint(match syntax {
            Syntax::Ron => "add `objects: [Sphere(center: (0, 0, 0), radius: 1)]`",
            Syntax::Toml => "add a [[objects]] table with `Sphere = { center = [0, 0, 0], radius = 1 }`",
        })
        .at_path("objects")
}

/// A scene of a later version: that is all that is said of it.
fn newer_version(root: Item<'_, '_>, sink: &mut Sink) -> bool {
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

impl Reader<'_> {
    /// `{ "name": material }`
    pub(crate) fn materials(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<Vec<NamedMaterial>> {
        match item.kind() {
            Kind::Map => {}
            Kind::Tuple if item.name().is_none() && item.children().next().is_none() => return Some(Vec::new()),
            _ => {
                // Which names were meant nobody knows, so none is called unknown.
                self.materials.damaged = true;
                return self.wrong_type(item, at, "names with their materials: { \"white\": Diffuse(albedo: 1) }");
            }
        }
        self.materials.damaged |= item.is_damaged();
        let mut list = Vec::new();
        for (key, value) in item.fields() {
            if self.sink.is_full() {
                break;
            }
            let name = key.text().into_owned();
            self.path.push(Step::Key(name.clone()));
            if name.trim().is_empty() {
                self.report(
                    Diagnostic::error(codes::EMPTY_TEXT, key.span(), "the name of a material is empty")
                        .expected("a name between quotes"),
                );
            }
            let first = self.materials.index.get(&name).and_then(|&first| self.materials.names.get(first));
            if let Some(first) = first.map(|first| first.span) {
                self.report(
                    Diagnostic::error(
                        codes::DUPLICATE_NAME,
                        key.span(),
                        format!("two materials have the name \"{}\"", super::shortened(&name)),
                    )
                    .hint("rename one of the two, or remove it")
                    .label(first, "the first one is here"),
                );
            } else {
                self.materials.index.insert(name.clone(), self.materials.names.len());
                self.materials.names.push(Spanned { value: name.clone(), span: key.span() });
                self.materials.used.push(false);
            }
            if let Some(material) = Material::read(self, value, at) {
                super::make_room(&mut list, item, key);
                list.push(NamedMaterial { name: Spanned { value: name, span: key.span() }, material });
            }
            self.path.pop();
        }
        Some(list)
    }

    /// An object names a material.
    pub(crate) fn use_name(&mut self, name: &Spanned<String>, syntax: Syntax) {
        if let Some(&index) = self.materials.index.get(&name.value) {
            if let Some(used) = self.materials.used.get_mut(index) {
                *used = true;
            }
            return;
        }
        if self.materials.damaged {
            return;
        }
        let known: Vec<&str> = self.materials.names.iter().map(|name| name.value.as_str()).collect();
        let kind = Material::DEF.variant(&name.value);
        let mut fault = Diagnostic::error(
            codes::UNKNOWN_MATERIAL,
            name.span,
            format!("there is no material \"{}\"", super::shortened(&name.value)),
        );
        fault.expected = match known.len() {
            0 => "a material written here: `materials` is empty".to_owned(),
            1..=8 => format!("a name from `materials`: {}", suggest::list(&known)),
            count => format!("one of the {count} names in `materials`"),
        };
        // Many names times many mistakes would take long: the first mistakes are the ones that are read.
        self.materials.unknown += 1;
        let few = known.len() * self.materials.unknown <= MAX_COMPARISONS;
        let nearest = few.then(|| suggest::nearest(&name.value, known.iter().copied())).flatten();
        fault.did_you_mean(nearest, |word| format!("\"{}\"", word.escape_default()));
        if nearest.is_none() {
            fault.hint = match (kind, syntax) {
                (Some(_), Syntax::Ron) => format!("for a material written here, remove the quotes: {}(..)", name.value),
                (Some(_), Syntax::Toml) => format!("for a material written here: {{ {} = {{ .. }} }}", name.value),
                (None, Syntax::Ron) => {
                    "add it to `materials`, or write the material here: Diffuse(albedo: 0.5)".to_owned()
                }
                (None, Syntax::Toml) => {
                    "add it to [materials], or write the material here: { Diffuse = { albedo = 0.5 } }".to_owned()
                }
            };
        }
        self.report(fault);
    }

    fn unused_materials(&mut self) {
        let materials = std::mem::take(&mut self.materials);
        for (name, _) in materials.names.iter().zip(&materials.used).filter(|(_, used)| !**used) {
            if self.sink.is_full() {
                break;
            }
            self.path = vec![Step::Field("materials"), Step::Key(name.value.clone())];
            self.report(
                Diagnostic::warning(
                    codes::UNUSED_MATERIAL,
                    name.span,
                    format!("no object uses the material \"{}\"", super::shortened(&name.value)),
                )
                .hint("remove it, or give its name to an object"),
            );
        }
        self.path.clear();
    }

    /// The view must have a direction, and `up` must not lie along it.
    fn camera(&mut self, camera: &Camera, syntax: Syntax) {
        if self.sink.diagnostics.iter().any(|fault| fault.path.starts_with("camera")) {
            return;
        }
        let (position, look_at, up) = (&camera.position, &camera.look_at, &camera.up);
        let written = |choices: &[Span]| choices.iter().copied().find(|&span| span != Span::NONE).unwrap_or_default();
        let view: Vec3 = std::array::from_fn(|axis| look_at.value[axis] - position.value[axis]);
        let length2 = dot(view, view);
        self.path = vec![Step::Field("camera")];
        if length2 == 0.0 {
            let span = written(&[look_at.span, position.span]);
            let mut fault =
                Diagnostic::error(codes::CAMERA_IN_TARGET, span, "the camera stands at the very point it looks at")
                    .expected("`position` and `look_at` at different points");
            if look_at.span == Span::NONE {
                fault.hint = "`look_at` is (0, 0, 0) unless written: write the point to look at".to_owned();
            }
            self.report(fault);
        } else {
            let across = cross(view, up.value);
            if dot(across, across) <= 1e-20 * length2 * dot(up.value, up.value) {
                let span = written(&[up.span, look_at.span, position.span]);
                let fault =
                    Diagnostic::error(codes::UP_ALONG_VIEW, span, "the camera looks along its own `up` direction")
                        .expected("`up` in another direction than from `position` to `look_at`");
                let other = if view[0] == 0.0 && view[1] == 0.0 { "0, 1, 0" } else { "0, 0, -1" };
                let other = match syntax {
                    Syntax::Ron => format!("up: ({other})"),
                    Syntax::Toml => format!("up = [{other}]"),
                };
                self.report(fault.hint(format!("write `{other}`")));
            }
        }
        self.path.clear();
    }
}

fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
