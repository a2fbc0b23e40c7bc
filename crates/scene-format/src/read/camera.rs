//! Cameras: by name, by matrix, and what only a whole camera can tell.

use super::hints::kind_elsewhere;
use super::{Reader, Step, shortened};
use crate::codes;
use crate::desc::matrix::Rows;
use crate::desc::{Camera, CameraChoice, Chosen, Effects, FisheyeMapping, NamedCamera, Projection, Vec3};
use crate::diagnostic::{Diagnostic, Edit, Severity, Span, Spanned};
use crate::plane::{cross, dot};
use crate::schema::{FieldDef, StructDef, Type};
use crate::suggest;
use crate::syntax::Syntax;
use crate::tree::{Item, Kind};
use crate::words::Words;
use std::sync::Arc;

/// So much may the columns of a camera's matrix be off: other programs write few digits.
const ROUNDING: f64 = 1e-3;

/// All cameras that have names.
#[derive(Debug, Default)]
pub(super) struct Cameras {
    read: Vec<NamedCamera>,
    /// Those that could not be read, each of which has been reported.
    unread: Vec<Spanned<Arc<str>>>,
    /// Names may be missing.
    pub damaged: bool,
}

impl Cameras {
    fn first(&self, name: &str) -> Option<Span> {
        let read = self.read.iter().map(|named| &named.name);
        read.chain(&self.unread).find(|known| *known.value == *name).map(|known| known.span)
    }

    /// The cameras, which no name is asked of any more.
    pub fn take(&mut self) -> Vec<NamedCamera> {
        std::mem::take(&mut self.read)
    }
}

/// Whether a camera has a field of this name.
fn is_field(name: &str) -> bool {
    matches!(Camera::TYPE, Type::Struct(def) if def.field(name).is_some())
}

/// Whether what stands at `cameras` is a camera itself.
fn is_one_camera(item: Item<'_, '_>) -> bool {
    let holds_cameras = |value: Item<'_, '_>| matches!(value.kind(), Kind::Map | Kind::Struct | Kind::Tuple);
    item.fields().any(|(key, value)| {
        is_field(&key.text()) && (!holds_cameras(value) || value.kind() == Kind::Tuple && value.name().is_none())
    })
}

/// Whether what stands at `camera` is cameras by their names.
pub(crate) fn are_cameras(item: Item<'_, '_>) -> bool {
    let is_camera = |value: Item<'_, '_>| match value.kind() {
        Kind::Map => value.fields().all(|(key, _)| is_field(&key.text())),
        Kind::Struct | Kind::Tuple => value.name().is_some_and(|name| name == "Camera"),
        _ => false,
    };
    let mut fields = item.fields().peekable();
    item.kind() == Kind::Map
        && fields.peek().is_some()
        // One with its kind before its fields, as objects have it.
        && fields.peek().is_none_or(|(key, _)| key.text() != "Camera")
        // Nor with the kind of another program.
        && fields.all(|(key, value)| {
            let name = key.text();
            !is_field(&name) && kind_elsewhere(&name, &Projection::DEF).is_none() && is_camera(value)
        })
}

/// What is said of a projection that is written as a kind of camera; `None`: the name is none.
pub(super) fn projection_elsewhere(name: &str, def: &'static StructDef, item: Item<'_, '_>) -> Option<String> {
    let kind =
        Projection::DEF.variant(name).map(|kind| kind.name).or_else(|| kind_elsewhere(name, &Projection::DEF))?;
    let written = match kind {
        "Orthographic" => "Orthographic(height: 8)",
        "Fisheye" => "Fisheye(fov: 180)",
        "Panorama" => "Panorama",
        _ => return None,
    };
    // With the person's own number, where there is nothing else.
    let mut fields = item.fields();
    let number = fields.next().filter(|(_, value)| value.number().is_some() && fields.next().is_none());
    let own = number
        .filter(|(key, _)| written.contains(&*key.text()))
        .map(|(key, value)| format!("{kind}({}: {})", key.text(), value.lexeme()));
    let written = own.unwrap_or_else(|| written.to_owned());
    (def.name == "Camera").then(|| match item.syntax() {
        Syntax::Ron => format!("write Camera(projection: {written})"),
        _ => format!("how it projects is its `projection`, {kind}"),
    })
}

impl Reader<'_> {
    /// `{ "name": camera }`
    pub(crate) fn cameras(&mut self, item: Item<'_, '_>, at: &'static FieldDef) -> Option<()> {
        match item.kind() {
            Kind::Map => {}
            Kind::Tuple if item.name().is_none() && item.children().next().is_none() => return Some(()),
            _ => {
                self.cameras.damaged = true;
                let expected = match item.syntax() {
                    Syntax::Ron => "names with their cameras: { \"front\": Camera(position: (0, 1, 5)) }",
                    Syntax::Toml => "a table for each: [cameras.front]",
                    Syntax::Json => "names with their cameras: { \"front\": { \"position\": [0, 1, 5] } }",
                };
                return self.wrong_type(item, at, expected);
            }
        }
        self.cameras.damaged |= item.is_damaged();
        if is_one_camera(item) {
            self.cameras.damaged = true;
            let message = "`cameras` holds cameras by their names, and this is one camera";
            let fault = Diagnostic::error(codes::WRONG_TYPE, item.span(), message);
            self.report(fault.expected("names with their cameras").hint("write `camera`"));
            return None;
        }
        for (key, value) in item.fields() {
            if self.sink.is_full() {
                break;
            }
            let name = key.text();
            self.path.push(Step::Key((*name).to_owned()));
            if name.trim().is_empty() {
                let fault = Diagnostic::error(codes::EMPTY_TEXT, key.span(), "the name of a camera is empty");
                self.report(fault.expected("a name between quotes"));
            }
            let first = self.cameras.first(&name);
            // What a file includes gives way to its own names.
            let replaces = first.is_some_and(|first| self.is_included(first) && first.source != key.span().source);
            if let Some(first) = first.filter(|_| !replaces) {
                let message = format!("two cameras have the name \"{}\"", shortened(&name));
                let fault = Diagnostic::error(codes::DUPLICATE_NAME, key.span(), message);
                self.report(fault.hint("rename one of the two, or remove it").label(first, "the first one is here"));
            }
            let camera = self.picked(value).and_then(|value| Camera::read(self, value, at));
            let name = Spanned { value: Arc::from(&*name), span: key.span() };
            if replaces {
                self.cameras.read.retain(|named| named.name != name);
                self.cameras.unread.retain(|known| *known != name);
            }
            match camera {
                _ if first.is_some() && !replaces => {}
                Some(camera) => self.cameras.read.push(NamedCamera { name, camera }),
                None => self.cameras.unread.push(name),
            }
            self.path.pop();
        }
        Some(())
    }

    /// Whether there is one of this name.
    pub(crate) fn knows_camera(&self, name: &str) -> bool {
        self.cameras.first(name).is_some()
    }

    /// Cameras by their names at `camera`; where it is written twice, that is told already.
    pub(super) fn several_cameras(&mut self, root: Item<'_, '_>) {
        let mut written = root.fields().filter(|(key, _)| key.text() == "camera");
        if let (Some((_, item)), None) = (written.next(), written.next())
            && are_cameras(item)
        {
            let message = "the camera is one, and these are several by their names";
            let fault = Diagnostic::error(codes::WRONG_TYPE, item.span(), message);
            self.report(fault.expected("a name from `cameras`, or a camera written here").hint("write `cameras`"));
        }
    }

    /// A field of the camera that `--set` gives where the scene writes none and takes those of included files: another
    /// camera would be made, with its own defaults.
    pub(super) fn camera_of_set(&mut self, root: Item<'_, '_>) {
        let written = root.fields().find(|(key, _)| key.text() == "camera").map(|(_, item)| item);
        let of_set = |item: &Item<'_, '_>| item.kind() == Kind::Map && item.span().source != root.span().source;
        let Some(item) = written.filter(of_set) else { return };
        let Some(first) = self.cameras.read.first().filter(|named| self.is_included(named.name.span)) else { return };
        let name = shortened(&first.name.value);
        let message = "the camera of this scene is one of an included file";
        let fault = Diagnostic::error(codes::BAD_SET_PATH, item.head(), message);
        self.report(fault.hint(format!("set it as a whole: 'cameras.{name}=Camera(..)'")));
    }

    /// The camera that is meant.
    pub(super) fn chosen(&mut self, choice: CameraChoice) -> Chosen {
        let name = match choice {
            CameraChoice::Written(camera) => return Chosen::written(*camera),
            CameraChoice::Named(name) => name,
            CameraChoice::Only => {
                let (of_files, mut own): (Vec<NamedCamera>, Vec<NamedCamera>) =
                    self.cameras.read.iter().cloned().partition(|named| self.is_included(named.name.span));
                if own.is_empty() {
                    own = of_files;
                }
                return match own.as_slice() {
                    [] => Chosen::written(Camera::default()),
                    [only] => Chosen { camera: only.camera.clone(), name: Some(Arc::clone(&only.name.value)) },
                    [first, ..] => {
                        self.camera_not_chosen(&own);
                        Chosen { camera: first.camera.clone(), name: Some(Arc::clone(&first.name.value)) }
                    }
                };
            }
        };
        if let Some(named) = self.cameras.read.iter().find(|named| named.name == name) {
            return Chosen { camera: named.camera.clone(), name: Some(Arc::clone(&named.name.value)) };
        }
        if !self.cameras.damaged && self.cameras.first(&name.value).is_none() {
            self.unknown_camera(&name);
        }
        Chosen::written(Camera::default())
    }

    /// Of several none is said to be meant. In which order they stand means nothing: JSON and TOML keep none.
    fn camera_not_chosen(&mut self, own: &[NamedCamera]) {
        let [first, ..] = own else { return };
        // What else is wrong may be why.
        if self.cameras.damaged || self.sink.diagnostics.iter().any(|fault| fault.severity == Severity::Error) {
            return;
        }
        let names: Vec<&str> = own.iter().map(|named| &*named.name.value).collect();
        let message = format!("the scene has {} cameras and does not say which one is meant", own.len());
        let fault = Diagnostic::error(codes::UNDECIDED_CAMERA, first.name.span, message);
        let hint = format!("write the name at `camera`, or choose by `tracer render --camera {}`", shortened(names[0]));
        self.report(fault.expected("a name from `cameras` at `camera`").hint(hint));
    }

    fn unknown_camera(&mut self, name: &Spanned<Arc<str>>) {
        const SHOWN: usize = 8;
        let known: Vec<&str> = self.cameras.read.iter().map(|named| &*named.name.value).collect();
        let message = format!("there is no camera \"{}\"", shortened(&name.value));
        let mut fault = Diagnostic::error(codes::UNKNOWN_CAMERA, name.span, message).expected(match known.len() {
            0 => "a camera written here: the scene has no `cameras`".to_owned(),
            1..=SHOWN => format!("a name from `cameras`: {}", suggest::list(&known)),
            count => format!("one of the {count} names in `cameras`"),
        });
        let nearest = suggest::nearest(&name.value, known.iter().copied());
        fault.did_you_mean(nearest, |word| crate::print::text(word, crate::Syntax::Ron));
        self.path = vec![Step::Field("camera")];
        self.report(fault);
        self.path.clear();
    }

    /// A matrix stands alone, and turns and moves only. `None`: it does not, which is reported.
    pub(crate) fn camera_matrix(&mut self, camera: &Camera, matrix: &Spanned<Rows>, syntax: Syntax) -> Option<()> {
        let default = Camera::default();
        let others = [
            ("position", &camera.position, default.position),
            ("look_at", &camera.look_at, default.look_at),
            ("up", &camera.up, default.up),
        ];
        if let Some((name, other, _)) =
            others.into_iter().find(|(_, other, default)| other.span != Span::NONE || *other != default)
        {
            let message = format!("the camera has both `matrix` and `{name}`");
            let fault = Diagnostic::error(codes::EXACTLY_ONE, matrix.span, message)
                .expected("`matrix`, or `position`, `look_at` and `up`")
                .hint("remove one of the two")
                .label(other.span, format!("`{name}` is written here"));
            self.at_step(Step::Field("matrix"), |reader| reader.report(fault));
            return None;
        }
        let rows = &*matrix.value.0;
        let Err((message, hint)) = wrong(rows)? else { return Some(()) };
        let mut fault = Diagnostic::error(codes::CAMERA_MATRIX, matrix.span, message)
            .expected("three columns of length 1 at right angles: right, up, back; and the eye");
        match hint {
            Mend::Words(words) => fault.hint = words.to_owned(),
            Mend::By(rows) => {
                let mended = written(&rows, syntax);
                fault.hint = format!("without the scale it is {mended}");
                fault.edit = Some(Edit { span: matrix.span, replacement: mended });
            }
        }
        self.at_step(Step::Field("matrix"), |reader| reader.report(fault));
        None
    }

    fn at_step(&mut self, step: Step, act: impl FnOnce(&mut Self)) {
        self.path.push(step);
        act(self);
        self.path.pop();
    }

    /// All cameras: each must have a view, and say nothing twice.
    pub(super) fn check_cameras(&mut self, chosen: &Chosen, effects: &Effects, syntax: Syntax) {
        let root = match chosen.place() {
            None => vec![Step::Field("camera")],
            Some(name) => vec![Step::Field("cameras"), Step::Key(name.to_owned())],
        };
        let known = |reader: &Self| {
            reader
                .sink
                .diagnostics
                .iter()
                .any(|fault| fault.severity == Severity::Error && fault.path.starts_with("camera"))
        };
        if known(self) {
            return;
        }
        self.view(&chosen.camera, syntax, &root);
        self.projection(&chosen.camera, &root);
        if !known(self) {
            self.lens(&chosen.camera, effects);
        }
        for named in std::mem::take(&mut self.cameras.read) {
            let is_chosen = chosen.name.as_ref() == Some(&named.name.value);
            // Those of other files were made for these.
            if !is_chosen && !self.is_included(named.name.span) {
                let root = [Step::Field("cameras"), Step::Key(named.name.value.to_string())];
                self.view(&named.camera, syntax, &root);
                self.projection(&named.camera, &root);
            }
            self.cameras.read.push(named);
        }
    }

    /// The view must have a direction, and `up` must not lie along it.
    fn view(&mut self, camera: &Camera, syntax: Syntax, root: &[Step]) {
        let (position, look_at, up) = (&camera.position, &camera.look_at, &camera.up);
        let written = |choices: &[Span]| choices.iter().copied().find(|&span| span != Span::NONE).unwrap_or_default();
        let view: Vec3 = std::array::from_fn(|axis| look_at.value[axis] - position.value[axis]);
        let length2 = dot(view, view);
        self.path = root.to_vec();
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
                    Syntax::Json => format!("\"up\": [{other}]"),
                };
                self.report(fault.hint(format!("write `{other}`")));
            }
        }
        self.path.clear();
    }

    /// What the camera's fields say must go together.
    fn projection(&mut self, camera: &Camera, root: &[Step]) {
        let at = |field: &[&'static str]| {
            let fields = field.iter().copied().map(Step::Field);
            root.iter().cloned().chain(fields).collect::<Vec<Step>>()
        };
        for (field, span, why) in camera.of_no_use() {
            self.path = at(&[field]);
            let message = format!("`{field}` has no use here: {why}");
            self.report(Diagnostic::error(codes::NO_USE, span, message).hint(format!("leave `{field}` out")));
        }
        let eyes = camera.stereo.as_ref().filter(|_| camera.projection == Projection::Panorama);
        if let Some(convergence) = eyes.and_then(|stereo| stereo.convergence.as_ref()) {
            self.path = at(&["stereo", "convergence"]);
            let message = "`convergence` has no use here: the eyes of a panorama look straight ahead, whichever way";
            self.report(Diagnostic::error(codes::NO_USE, convergence.span, message).hint("leave `convergence` out"));
        }
        let other_fov = camera.fov.span != Span::NONE || camera.fov.value != Camera::default().fov.value;
        if let (Some(length), Projection::Perspective, true) = (&camera.focal_length, &camera.projection, other_fov) {
            self.path = at(&["focal_length"]);
            let fault =
                Diagnostic::error(codes::EXACTLY_ONE, length.span, "the camera has both `fov` and `focal_length`");
            self.report(fault.expected("one of them").hint("remove one of the two"));
        }
        if let Projection::Fisheye { fov, mapping } = &camera.projection {
            let most = match mapping {
                FisheyeMapping::Orthographic => Some(("Orthographic", "180 at most", 180.0)),
                FisheyeMapping::Stereographic => Some(("Stereographic", "less than 360", 359.999)),
                FisheyeMapping::Equidistant | FisheyeMapping::Equisolid => None,
            };
            if let Some((name, expected, _)) = most.filter(|(.., most)| fov.value > *most) {
                self.path = at(&["projection", "fov"]);
                let message = format!("the fov of a fisheye is too wide for the mapping `{name}`");
                let fault = Diagnostic::error(codes::OUT_OF_RANGE, fov.span, message);
                self.report(fault.expected(expected).hint("`Equidistant` goes to 360"));
            }
        }
        self.path.clear();
    }

    /// The camera and the lens must go together.
    fn lens(&mut self, camera: &Camera, effects: &Effects) {
        let Some(lens) = &effects.depth_of_field else { return };
        self.path = vec![Step::Field("effects"), Step::Field("depth_of_field")];
        if camera.projection != Projection::Perspective {
            let message = "`depth_of_field` has no use here: the camera's `projection` has no lens";
            let fault = Diagnostic::error(codes::NO_USE, lens.aperture.span, message);
            self.report(fault.hint("leave `depth_of_field` or `projection` out"));
        } else if lens.plane_of_focus(camera).0 <= 0.0 {
            let message = "the point in focus does not lie before the camera";
            let fault = Diagnostic::error(codes::OUT_OF_RANGE, lens.focus.span, message);
            self.report(fault.expected("a point that the camera looks at"));
        }
        let (blades, rotation) = (&lens.blades, &lens.rotation);
        if matches!(blades.value, 1 | 2) {
            let message =
                format!("an aperture of {} is no polygon", ["one blade", "two blades"][blades.value as usize - 1]);
            let fault = Diagnostic::error(codes::OUT_OF_RANGE, blades.span, message);
            self.at_step(Step::Field("blades"), |reader| {
                reader.report(fault.expected("0, which is a disc, or 3 to 64"))
            });
        } else if blades.value == 0 && rotation.value != 0.0 {
            let message = "`rotation` has no use here: an aperture without `blades` is round";
            let fault = Diagnostic::error(codes::NO_USE, rotation.span, message).hint("add `blades`, or leave it out");
            self.at_step(Step::Field("rotation"), |reader| reader.report(fault));
        }
        self.path.clear();
    }
}

/// How a matrix is to be mended.
enum Mend {
    Words(&'static str),
    By([[f64; 4]; 3]),
}

/// What else than turning and moving a matrix does. `None`: it cannot be undone, which was told.
fn wrong(rows: &[[f64; 4]; 3]) -> Option<Result<(), (String, Mend)>> {
    let column = |k: usize| rows.map(|row| row[k]);
    let lengths = [0, 1, 2].map(|k| libm::sqrt(dot(column(k), column(k))));
    if lengths.contains(&0.0) {
        return None;
    }
    let [right, up, back] = [0, 1, 2].map(|k| column(k).map(|x| x / lengths[k]));
    for (one, other, names) in [(right, up, "right and up"), (right, back, "right and back"), (up, back, "up and back")]
    {
        if dot(one, other).abs() > ROUNDING {
            let message = format!("the camera's matrix shears: {names} do not stand at right angles");
            let words = "the columns are right, up, back and the eye; rows and columns may be exchanged";
            return Some(Err((message, Mend::Words(words))));
        }
    }
    if dot(cross(right, up), back) < 0.0 {
        let words = "negate the first column if the other program's x points to the left, as that of pbrt and POV-Ray";
        return Some(Err(("the camera's matrix mirrors the picture".to_owned(), Mend::Words(words))));
    }
    if lengths.iter().any(|length| (length - 1.0).abs() > ROUNDING) {
        let mut mended = *rows;
        for (k, unit) in [right, up, back].into_iter().enumerate() {
            mended.iter_mut().zip(unit).for_each(|(row, x)| row[k] = (x * 1e9).round() / 1e9 + 0.0);
        }
        let [a, b, c] = lengths.map(|length| format!("{:.6}", length));
        let [a, b, c] = [&a, &b, &c].map(|length| length.trim_end_matches('0').trim_end_matches('.'));
        let by = if a == b && b == c { a.to_owned() } else { format!("{a}, {b} and {c}") };
        let message = format!("the camera's matrix scales by {by}, and a camera has no size");
        return Some(Err((message, Mend::By(mended))));
    }
    Some(Ok(()))
}

/// Rows as they are written.
fn written(rows: &[[f64; 4]; 3], syntax: Syntax) -> String {
    let rows = rows.map(|row| row.map(crate::print::number).join(", "));
    match syntax {
        Syntax::Ron => format!("(({}), ({}), ({}))", rows[0], rows[1], rows[2]),
        Syntax::Toml | Syntax::Json => format!("[[{}], [{}], [{}]]", rows[0], rows[1], rows[2]),
    }
}
