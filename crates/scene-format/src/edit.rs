//! The camera, written into a scene's text: values are replaced where they stand, fields that are missing are added,
//! and all else stays as the person wrote it, comments and layout included.

use crate::SceneDesc;
use crate::diagnostic::{Edit, Span};
use crate::load::load_bytes;
use crate::overrides::Override;
use crate::print::number;
use crate::render::apply_edits;
use crate::syntax::parse;
use crate::syntax::{Sink, Syntax};
use crate::tree::{Item, Kind, Tree};
use std::path::Path;

/// A camera as four of its fields.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewpoint {
    /// Eye point.
    pub position: [f64; 3],
    /// A point in the middle of the picture.
    pub look_at: [f64; 3],
    /// The direction that is up in the picture.
    pub up: [f64; 3],
    /// Vertical field of view in degrees.
    pub fov: f64,
}

impl Viewpoint {
    /// That of a scene.
    pub fn of(scene: &SceneDesc) -> Self {
        let camera = &scene.camera;
        Viewpoint {
            position: camera.position.value,
            look_at: camera.look_at.value,
            up: camera.up.value,
            fov: camera.fov.value,
        }
    }
}

/// Why a camera cannot be written into a text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewpointError {
    /// The text has faults.
    #[error("the scene has errors; mend them first")]
    Wrong,
    /// It moves, by an expression that numbers would stand in place of.
    #[error("the camera moves: numbers would stand in place of its expressions; change these by hand")]
    Moves,
    /// It is written in a way that no edit is known for.
    #[error("the camera of this scene is written in a way that cannot be edited here; write the values by hand")]
    Unknown,
}

/// The edits of a scene's text that give its camera this viewpoint. Fields that have their value already are left
/// alone, so there may be none; an expression is replaced by its new value. `base_dir` is where the files that the
/// text names lie.
///
/// # Errors
/// When the text is wrong, or would not say after the edits what it said before, but for the camera.
pub fn write_viewpoint(
    text: &str,
    syntax: Syntax,
    base_dir: &Path,
    viewpoint: &Viewpoint,
) -> Result<Vec<Edit>, ViewpointError> {
    let read =
        |text: &str| load_bytes("", text.as_bytes().to_vec(), Some(syntax), base_dir, &[]).map(|loaded| loaded.scene);
    let before = read(text).map_err(|_| ViewpointError::Wrong)?;
    let old = Viewpoint::of(&before);
    let vectors = [
        ("position", old.position, viewpoint.position),
        ("look_at", old.look_at, viewpoint.look_at),
        ("up", old.up, viewpoint.up),
    ];
    let mut fields: Vec<(&str, Value)> = vectors
        .into_iter()
        .filter(|(_, old, new)| old != new)
        .map(|(name, _, new)| (name, Value::Vector(new)))
        .collect();
    if old.fov != viewpoint.fov {
        fields.push(("fov", Value::Number(viewpoint.fov)));
    }
    if fields.is_empty() {
        return Ok(Vec::new());
    }
    if moves(text, syntax, base_dir, &before, &fields) {
        return Err(ViewpointError::Moves);
    }
    let tree = parse(text, syntax, &mut Sink::default());
    let name = before.camera_name.as_deref();
    let edits = edits(&tree, text, syntax, &fields, name).ok_or(ViewpointError::Unknown)?;
    // The proof that nothing else has changed.
    let after = read(&apply_edits(text, &edits)).map_err(|_| ViewpointError::Unknown)?;
    let mut wanted = SceneDesc { camera: after.camera.clone(), sources: after.sources.clone(), ..before };
    let name = wanted.camera_name.clone();
    for named in wanted.cameras.iter_mut().filter(|named| Some(&named.name.value) == name.as_ref()) {
        named.camera = after.camera.clone();
    }
    if Viewpoint::of(&after) == *viewpoint && after == wanted { Ok(edits) } else { Err(ViewpointError::Unknown) }
}

/// Frames at which a camera is looked at, whether it moves.
const LOOKED_AT: u32 = 8;

/// Whether a field that would be written is another at another frame. Of a text that names no time none is.
fn moves(text: &str, syntax: Syntax, base_dir: &Path, now: &SceneDesc, fields: &[(&str, Value)]) -> bool {
    let frames = now.animation.frames.value;
    let named = now.sources.iter().any(|source| source.text.contains("frame") || source.text.contains("time"));
    if frames < 2 || !named {
        return false;
    }
    let seen = Viewpoint::of(now);
    let is_written = |name: &str| fields.iter().any(|(field, _)| *field == name);
    let looked = LOOKED_AT.min(frames);
    (0..looked).any(|k| {
        // The first, the last, and as far apart as may be between.
        let frame = (u64::from(k) * u64::from(frames - 1) / u64::from(looked - 1)) as u32;
        let at = load_bytes("", text.as_bytes().to_vec(), Some(syntax), base_dir, &[Override::frame(frame)]);
        at.is_ok_and(|loaded| {
            let then = Viewpoint::of(&loaded.scene);
            is_written("position") && then.position != seen.position
                || is_written("look_at") && then.look_at != seen.look_at
                || is_written("up") && then.up != seen.up
                || is_written("fov") && then.fov != seen.fov
        })
    })
}

#[derive(Clone, Copy)]
enum Value {
    Number(f64),
    Vector([f64; 3]),
}

impl Value {
    /// As it is written: a vector between these brackets.
    fn text(self, [open, close]: [char; 2]) -> String {
        match self {
            Value::Number(x) => number(x),
            Value::Vector(v) => format!("{open}{}{close}", v.map(number).join(", ")),
        }
    }
}

const ROUND: [char; 2] = ['(', ')'];
const SQUARE: [char; 2] = ['[', ']'];

/// `name`: that of the camera, where it is one of `cameras`.
fn edits(
    tree: &Tree<'_>,
    text: &str,
    syntax: Syntax,
    fields: &[(&str, Value)],
    name: Option<&str>,
) -> Option<Vec<Edit>> {
    let root = tree.root()?;
    let field = |item: Item<'_, '_>, name: &str| {
        item.fields().find(|(key, _)| key.text() == name).map(|(_, value)| value.index())
    };
    let found = match name {
        // In another file it stays as it is.
        Some(name) => Some(field(tree.item(field(root, "cameras")?)?, name)?),
        None => field(root, "camera"),
    };
    let Some(camera) = found.and_then(|at| tree.item(at)) else { return whole(root, text, syntax, fields) };
    if camera.span().source != 0 || !matches!(camera.kind(), Kind::Struct | Kind::Map | Kind::Tuple) {
        return None;
    }
    let mut edits = Vec::new();
    let mut missing = Vec::new();
    for &(name, value) in fields {
        match camera.fields().find(|(key, _)| key.text() == name) {
            Some((_, written)) => {
                let square = syntax != Syntax::Ron || written.lexeme().trim_start().starts_with('[');
                let replacement = value.text(if square { SQUARE } else { ROUND });
                edits.push(Edit { span: written.span(), replacement });
            }
            None => missing.push((name, value)),
        }
    }
    if !missing.is_empty() {
        edits.push(added(camera, text, syntax, &missing)?);
    }
    Some(edits)
}

/// An edit that puts fields into a struct or table that has none of them.
fn added(item: Item<'_, '_>, text: &str, syntax: Syntax, fields: &[(&str, Value)]) -> Option<Edit> {
    let newline = newline(text);
    let lexeme = item.lexeme();
    let start = item.span().start as usize;
    let braced = lexeme.starts_with('{');
    let pair = |(name, value): &(&str, Value)| match syntax {
        Syntax::Toml => format!("{name} = {}", value.text(SQUARE)),
        Syntax::Json => format!("\"{name}\": {}", value.text(SQUARE)),
        Syntax::Ron if braced => format!("\"{name}\": {}", value.text(SQUARE)),
        Syntax::Ron => format!("{name}: {}", value.text(ROUND)),
    };
    let pairs: Vec<String> = fields.iter().map(pair).collect();
    let first = item.fields().next();
    if syntax == Syntax::Toml && !braced {
        // A table with a header: below it. One of dotted keys: below the first of them, written as it is.
        let (at, prefix) = if lexeme.starts_with('[') {
            (start, String::new())
        } else {
            let (key, value) = first?;
            let line = line_start(text, key.span().start as usize);
            let prefix = text.get(line..key.span().start as usize)?.to_owned();
            (value.span().end as usize, prefix)
        };
        let end = line_end(text, at);
        return Some(insert(end, pairs.iter().map(|pair| format!("{newline}{prefix}{pair}")).collect()));
    }
    let open = start + lexeme.find(['(', '{'])? + 1;
    let Some((key, _)) = first else { return Some(insert(open, pairs.join(", "))) };
    let first = key.span().start as usize;
    let between = text.get(open..first)?;
    if between.contains('\n') {
        // Fields on lines of their own: so are these, above the others and what is said of them.
        let indent = text.get(line_start(text, first)..first).filter(|indent| indent.trim().is_empty())?;
        let end = line_end(text, open);
        return Some(insert(end, pairs.iter().map(|pair| format!("{newline}{indent}{pair},")).collect()));
    }
    let (before, after) = if between.is_empty() { ("", " ") } else { (" ", "") };
    Some(insert(open, format!("{before}{},{after}", pairs.join(", "))))
}

/// An edit that adds a whole camera.
fn whole(root: Item<'_, '_>, text: &str, syntax: Syntax, fields: &[(&str, Value)]) -> Option<Vec<Edit>> {
    let newline = newline(text);
    if syntax == Syntax::Toml {
        let line = |(name, value): &(&str, Value)| format!("{name} = {}{newline}", value.text(SQUARE));
        let lines: String = fields.iter().map(line).collect();
        let gap = if text.is_empty() || text.ends_with('\n') { "" } else { newline };
        return Some(vec![insert(text.len(), format!("{gap}{newline}[camera]{newline}{lines}"))]);
    }
    let lexeme = root.lexeme();
    let braced = lexeme.starts_with('{');
    let pair = |(name, value): &(&str, Value)| {
        if braced { format!("\"{name}\": {}", value.text(SQUARE)) } else { format!("{name}: {}", value.text(ROUND)) }
    };
    let pairs = fields.iter().map(pair).collect::<Vec<_>>().join(", ");
    let camera = if braced { format!("\"camera\": {{ {pairs} }},") } else { format!("camera: Camera({pairs}),") };
    let open = root.span().start as usize + lexeme.find(['(', '{'])? + 1;
    let (key, _) = root.fields().next()?;
    let first = key.span().start as usize;
    let edit = if text.get(open..first)?.contains('\n') {
        let indent = text.get(line_start(text, first)..first).filter(|indent| indent.trim().is_empty())?;
        insert(line_end(text, open), format!("{newline}{indent}{camera}"))
    } else {
        insert(first, format!("{camera} "))
    };
    Some(vec![edit])
}

fn insert(at: usize, replacement: String) -> Edit {
    Edit { span: Span { source: 0, start: at as u32, end: at as u32 }, replacement }
}

/// How the text ends its lines.
fn newline(text: &str) -> &'static str {
    if text.contains("\r\n") { "\r\n" } else { "\n" }
}

fn line_start(text: &str, at: usize) -> usize {
    text[..at].rfind('\n').map_or(0, |newline| newline + 1)
}

/// Before the line's end, and before a carriage return in front of that.
fn line_end(text: &str, at: usize) -> usize {
    let end = text[at..].find('\n').map_or(text.len(), |newline| at + newline);
    at + text[at..end].trim_end_matches('\r').len()
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: Viewpoint =
        Viewpoint { position: [1.0, 2.5, 55.0], look_at: [0.0, 0.5, 0.0], up: [0.0, 1.0, 0.0], fov: 30.0 };

    fn written(text: &str, syntax: Syntax) -> String {
        let edits =
            write_viewpoint(text, syntax, Path::new(""), &VIEW).unwrap_or_else(|error| panic!("{error}: {text}"));
        apply_edits(text, &edits)
    }

    #[test]
    fn values_are_replaced_and_added_and_all_else_stays() {
        let rest = "background: 1, objects: [Sphere(center: (0, 0, 0), radius: 1)]";
        let spheres = "[[objects]]\nSphere = { center = [0, 0, 0], radius = 1 }\n";
        for (syntax, before, after) in [
            (
                Syntax::Ron,
                format!("// head\nScene(\n  camera: Camera( // all of it\n    // the eye\n    position: (0, 0, 5), // \
                 here\n    look_at: [9, 9, 9],\n  ), {rest})"),
                format!("// head\nScene(\n  camera: Camera( // all of it\n    fov: 30,\n    // the eye\n    position: \
                 (1, 2.5, 55), // here\n    look_at: [0, 0.5, 0],\n  ), {rest})"),
            ),
            (
                Syntax::Ron,
                format!("(camera: (fov: /* wide */ 90), {rest})"),
                format!("(camera: (position: (1, 2.5, 55), look_at: (0, 0.5, 0), fov: /* wide */ 30), {rest})"),
            ),
            (
                Syntax::Ron,
                format!("Scene(cameras: {{ \"a\": Camera(), \"b\": Camera(fov: 50) }}, camera: \"b\", {rest})"),
                format!("Scene(cameras: {{ \"a\": Camera(), \"b\": Camera(position: (1, 2.5, 55), look_at: (0, 0.5, \
                 0), fov: 30) }}, camera: \"b\", {rest})"),
            ),
            (
                Syntax::Ron,
                format!("Scene(camera: Camera(), {rest})"),
                format!("Scene(camera: Camera(position: (1, 2.5, 55), look_at: (0, 0.5, 0), fov: 30), {rest})"),
            ),
            (
                Syntax::Ron,
                format!("Scene(\r\n\t// first\r\n\t{rest}\r\n)"),
                format!("Scene(\r\n\tcamera: Camera(position: (1, 2.5, 55), look_at: (0, 0.5, 0), fov: 30),\r\n\t// \
                 first\r\n\t{rest}\r\n)"),
            ),
            (
                Syntax::Ron,
                format!("Scene(vars: {{ \"h\": 2 }}, camera: Camera(position: (0, 0, 5), fov: \"=20 * h\"), {rest})"),
                format!("Scene(vars: {{ \"h\": 2 }}, camera: Camera(look_at: (0, 0.5, 0), position: (1, 2.5, 55), fov: \
                 30), {rest})"),
            ),
            (
                Syntax::Ron,
                "{\n  \"camera\": { \"fov\": 50 },\n  \"background\": 1, \"objects\": [{ \"Sphere\": { \"center\": [0, \
                 0, 0], \"radius\": 1 } }]\n}".to_owned(),
                "{\n  \"camera\": { \"position\": [1, 2.5, 55], \"look_at\": [0, 0.5, 0], \"fov\": 30 },\n  \
                 \"background\": 1, \"objects\": [{ \"Sphere\": { \"center\": [0, 0, 0], \"radius\": 1 } \
                 }]\n}".to_owned(),
            ),
            (
                Syntax::Toml,
                format!("background = 1\n[camera] # the eye\nposition = [0, 0, 5] # here\n\n{spheres}"),
                format!("background = 1\n[camera] # the eye\nlook_at = [0, 0.5, 0]\nfov = 30\nposition = [1, 2.5, 55] \
                 # here\n\n{spheres}"),
            ),
            (
                Syntax::Toml,
                format!("background = 1\ncamera.fov = 50 # wide\n{spheres}"),
                format!("background = 1\ncamera.fov = 30 # wide\ncamera.position = [1, 2.5, 55]\ncamera.look_at = [0, \
                 0.5, 0]\n{spheres}"),
            ),
            (
                Syntax::Toml,
                format!("background = 1\ncamera = {{ fov = 50 }}\n{spheres}"),
                format!("background = 1\ncamera = {{ position = [1, 2.5, 55], look_at = [0, 0.5, 0], fov = 30 \
                 }}\n{spheres}"),
            ),
            (
                Syntax::Toml,
                format!("background = 1\n{spheres}"),
                format!("background = 1\n{spheres}\n[camera]\nposition = [1, 2.5, 55]\nlook_at = [0, 0.5, 0]\nfov = \
                 30\n"),
            ),
        ] {
            let now = written(&before, syntax);
            assert_eq!(now, after);
            // What is written already is left alone.
            assert_eq!(write_viewpoint(&now, syntax, Path::new(""), &VIEW), Ok(Vec::new()));
        }
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
            let scene = crate::load(&path).expect("the scene is right").scene;
            let turned = write(&text, &VIEW);
            let back = write(&turned, &Viewpoint::of(&scene));
            let again = crate::load_str("", &back, syntax, &root, &[]).expect("it is right").scene;
            assert_eq!(SceneDesc { sources: Vec::new(), ..again }, SceneDesc { sources: Vec::new(), ..scene });
            seen += 1;
        }
        assert!(seen > 8, "{seen} scenes");
    }
}
