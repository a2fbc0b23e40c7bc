//! The camera, written into a scene's text: values are replaced where they stand, fields that are missing are added,
//! and all else stays as the person wrote it, comments and layout included.

use crate::SceneDesc;
use crate::desc::{Camera, Projection};
use crate::diagnostic::{Edit, Span};
use crate::load::load_bytes;
use crate::overrides::Override;
use crate::print::number;
use crate::render::apply_edits;
use crate::syntax::parse;
use crate::syntax::{Sink, Syntax};
use crate::tree::{Item, Kind, Tree};
use std::path::Path;

/// Fields of a camera that say where it stands and how much it sees; `None`: as it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Viewpoint {
    /// Eye point.
    pub position: Option<[f64; 3]>,
    /// A point in the middle of the picture.
    pub look_at: Option<[f64; 3]>,
    /// The direction that is up in the picture.
    pub up: Option<[f64; 3]>,
    /// Field of view in degrees, of a camera without a `focal_length`.
    pub fov: Option<f64>,
    /// The focal length in millimetres, of a camera that has one.
    pub focal_length: Option<f64>,
    /// What the picture's height shows, of an orthographic camera.
    pub height: Option<f64>,
}

impl Viewpoint {
    /// That of a camera: where it stands, and of the three that say how much it sees the one that it goes by. A camera
    /// that sees all around goes by none.
    pub fn of(camera: &Camera) -> Self {
        let (mut fov, mut focal_length, mut height) = (None, None, None);
        match (&camera.projection, &camera.focal_length) {
            (Projection::Perspective, Some(length)) => focal_length = Some(length.value),
            (Projection::Perspective, None) => fov = Some(camera.fov.value),
            (Projection::Orthographic { height: seen }, _) => height = Some(seen.value),
            (Projection::Panorama | Projection::Fisheye { .. }, _) => {}
        }
        Viewpoint {
            position: Some(camera.position.value),
            look_at: Some(camera.look_at.value),
            up: Some(camera.up.value),
            fov,
            focal_length,
            height,
        }
    }

    /// Gives a camera this viewpoint. What the camera does not go by is left out.
    pub fn give(&self, camera: &mut Camera) {
        let places =
            [(self.position, &mut camera.position), (self.look_at, &mut camera.look_at), (self.up, &mut camera.up)];
        for (value, field) in places {
            if let Some(value) = value {
                *field = value.into();
            }
        }
        let (field, value) = match (&mut camera.projection, &mut camera.focal_length) {
            (Projection::Perspective, Some(length)) => (length, self.focal_length),
            (Projection::Perspective, None) => (&mut camera.fov, self.fov),
            (Projection::Orthographic { height }, _) => (height, self.height),
            (Projection::Panorama | Projection::Fisheye { .. }, _) => return,
        };
        if let Some(value) = value {
            *field = value.into();
        }
    }

    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        *self == Viewpoint::default()
    }

    /// What it says.
    fn fields(&self) -> Vec<(&'static str, Value)> {
        let vectors = [("position", self.position), ("look_at", self.look_at), ("up", self.up)];
        let numbers = [("fov", self.fov), ("focal_length", self.focal_length), (HEIGHT, self.height)];
        let vectors = vectors.into_iter().map(|(name, value)| (name, value.map(Value::Vector)));
        let numbers = numbers.into_iter().map(|(name, value)| (name, value.map(Value::Number)));
        vectors.chain(numbers).filter_map(|(name, value)| Some((name, value?))).collect()
    }
}

/// The one field that stands in the camera's `projection`.
const HEIGHT: &str = "height";

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
    /// It stands by a matrix, and not by the fields that would be written.
    #[error(
        "the camera stands by its `matrix`, and `position`, `look_at` and `up` cannot stand beside that; \
             change the matrix by hand"
    )]
    Matrix,
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
    let old = Viewpoint::of(&before.camera).fields();
    let mut fields = viewpoint.fields();
    fields.retain(|field| !old.contains(field));
    if fields.is_empty() {
        return Ok(Vec::new());
    }
    if before.camera.matrix.is_some() && fields.iter().any(|(_, value)| matches!(value, Value::Vector(_))) {
        return Err(ViewpointError::Matrix);
    }
    if moves(text, syntax, base_dir, &before, &fields) {
        return Err(ViewpointError::Moves);
    }
    let tree = parse(text, syntax, &mut Sink::default());
    let name = before.camera_name.as_deref();
    let edits = edits(&tree, text, syntax, &fields, name).ok_or(ViewpointError::Unknown)?;
    // The proof that nothing else has changed, and that all of it has.
    let after = read(&apply_edits(text, &edits)).map_err(|_| ViewpointError::Unknown)?;
    let mut camera = before.camera.clone();
    viewpoint.give(&mut camera);
    let mut wanted = SceneDesc { camera: camera.clone(), sources: after.sources.clone(), ..before };
    let name = wanted.camera_name.clone();
    for named in wanted.cameras.iter_mut().filter(|named| Some(&named.name.value) == name.as_ref()) {
        named.camera = camera.clone();
    }
    let new = Viewpoint::of(&after.camera).fields();
    let is_written = fields.iter().all(|field| new.contains(field));
    if is_written && after == wanted { Ok(edits) } else { Err(ViewpointError::Unknown) }
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
    let seen = Viewpoint::of(&now.camera).fields();
    let looked = LOOKED_AT.min(frames);
    (0..looked).any(|k| {
        // The first, the last, and as far apart as may be between.
        let frame = (u64::from(k) * u64::from(frames - 1) / u64::from(looked - 1)) as u32;
        let at = load_bytes("", text.as_bytes().to_vec(), Some(syntax), base_dir, &[Override::frame(frame)]);
        at.is_ok_and(|loaded| {
            let then = Viewpoint::of(&loaded.scene.camera).fields();
            let is_written = |name: &str| fields.iter().any(|(field, _)| *field == name);
            seen.iter().zip(&then).any(|(now, then)| now != then && is_written(now.0))
        })
    })
}

#[derive(Clone, Copy, PartialEq)]
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
        match place(camera, name) {
            Some(written) if written.span().source != 0 => return None,
            Some(written) => {
                let square = syntax != Syntax::Ron || written.lexeme().trim_start().starts_with('[');
                let replacement = value.text(if square { SQUARE } else { ROUND });
                edits.push(Edit { span: written.span(), replacement });
            }
            // A projection that has none is none of parallel rays.
            None if name == HEIGHT => return None,
            None => missing.push((name, value)),
        }
    }
    if !missing.is_empty() {
        edits.push(added(camera, text, syntax, &missing)?);
    }
    Some(edits)
}

/// Where a field of a camera is written, if it is.
fn place<'t, 's>(camera: Item<'t, 's>, name: &str) -> Option<Item<'t, 's>> {
    let field =
        |item: Item<'t, 's>, name: &str| item.fields().find(|(key, _)| key.text() == name).map(|(_, value)| value);
    if name != HEIGHT {
        return field(camera, name);
    }
    let projection = field(camera, "projection")?;
    // `Orthographic(..)`, or a table whose only name is that.
    let fields = if projection.kind() == Kind::Map { projection.fields().next()?.1 } else { projection };
    field(fields, HEIGHT)
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
