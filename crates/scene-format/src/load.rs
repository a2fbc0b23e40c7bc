//! The first of the five hands: from a file to a [`SceneDesc`].

use crate::codes;
use crate::desc::{self, Moments, SceneDesc};
use crate::diagnostic::{Diagnostic, Diagnostics, Edit, Severity, Source, Span, say_where_included};
use crate::files::{self, FileKind, MAX_FILE_BYTES, NamedFile};
use crate::follow_ups;
use crate::include::Library;
use crate::nameless;
use crate::overrides::{self, Override};
use crate::read::{self, Whole};
use crate::render::apply_edits;
use crate::syntax::{Sink, Syntax, foreign, parse, parse_as};
use crate::tree::NO_SOURCE;
use crate::write::{Defaults, to_json};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A scene that loaded.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene, complete and valid.
    pub scene: SceneDesc,
    /// What is doubtful about it, in order of position.
    pub warnings: Diagnostics,
}

/// Why a scene did not load.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file could not be read at all.
    #[error("cannot read the scene file {}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The text is wrong: all that is wrong with it (warnings too), in order of position.
    #[error("the scene has {} {}", errors(diagnostics), if errors(diagnostics) == 1 { "error" } else { "errors" })]
    Invalid {
        /// Errors and warnings.
        diagnostics: Diagnostics,
        /// The texts that their spans point into.
        sources: Vec<Source>,
        /// The files that the text names, as far as it could be read, for whoever looks at them in the same run.
        files: Vec<NamedFile>,
        /// All that is wrong is that none of the scene's cameras is chosen: the first of them. Who renders nothing may
        /// take it, by [`Override::camera`].
        undecided: Option<Arc<str>>,
    },
}

fn errors(diagnostics: &Diagnostics) -> usize {
    diagnostics.iter().filter(|fault| fault.severity == Severity::Error && fault.code != codes::TOO_MANY).count()
}

/// Reads a scene file, its syntax told by the extension (else by what it looks like).
///
/// # Errors
/// [`LoadError::Io`] when the file cannot be read, [`LoadError::Invalid`] with every fault of it otherwise. Files that
/// the scene names (meshes, textures) are not looked at.
pub fn load(path: &Path) -> Result<Loaded, LoadError> {
    load_with(path, &[])
}

/// As [`load`], with fields set from outside.
///
/// # Errors
/// As [`load`].
pub fn load_with(path: &Path, overrides: &[Override]) -> Result<Loaded, LoadError> {
    let io = |source| LoadError::Io { path: path.to_owned(), source };
    let name = path.display().to_string();
    let Some(bytes) = files::read(path, MAX_FILE_BYTES).map_err(io)? else { return Err(too_large(name)) };
    let base_dir = path.parent().unwrap_or(Path::new("")).to_owned();
    load_bytes(&name, bytes, Syntax::from_path(path), &base_dir, overrides)
}

/// Reads a scene from bytes (standard input): checks that they are UTF-8, and guesses the syntax when it is not given.
///
/// # Errors
/// [`LoadError::Invalid`] with every fault.
pub fn load_bytes(
    name: &str,
    bytes: Vec<u8>,
    syntax: Option<Syntax>,
    base_dir: &Path,
    overrides: &[Override],
) -> Result<Loaded, LoadError> {
    if let Some((text, encoding)) = wide(&bytes) {
        return Err(in_wide(name, text, encoding));
    }
    let text = String::from_utf8(bytes).map_err(|error| not_utf8(name, &error))?;
    load_string(name, text, syntax, base_dir, overrides)
}

/// Reads a scene from a text. `name` is shown in diagnostics, relative paths start from `base_dir`.
///
/// # Errors
/// [`LoadError::Invalid`] with every fault.
pub fn load_str(
    name: &str,
    text: &str,
    syntax: Syntax,
    base_dir: &Path,
    overrides: &[Override],
) -> Result<Loaded, LoadError> {
    load_string(name, text.to_owned(), Some(syntax), base_dir, overrides)
}

fn load_string(
    name: &str,
    text: String,
    syntax: Option<Syntax>,
    base_dir: &Path,
    overrides: &[Override],
) -> Result<Loaded, LoadError> {
    if text.len() as u64 > MAX_FILE_BYTES {
        return Err(too_large(name.to_owned()));
    }
    let syntax = syntax.unwrap_or_else(|| Syntax::guess(&text));
    let library = Library::of(&text, syntax, base_dir, overrides);
    let mut sources = vec![Source { name: name.to_owned(), text, included: None }];
    sources.extend(overrides.iter().map(|set| Source {
        name: set.option.to_owned(),
        text: set.argument.clone(),
        included: None,
    }));
    sources.extend(library.files.iter().map(|file| file.source.clone()));
    let texts = Texts { sources, syntax, base_dir: base_dir.to_owned(), overrides: overrides.to_vec(), library };
    let (read, moves) = match texts.read(0.0) {
        Ok(read) => read,
        Err(Faults { diagnostics, files, undecided }) => {
            return Err(LoadError::Invalid { diagnostics, sources: texts.sources, files, undecided });
        }
    };
    let Loaded { mut scene, warnings } = read;
    if !moves {
        scene.sources = texts.sources;
        return Ok(Loaded { scene, warnings });
    }
    scene.sources.clone_from(&texts.sources);
    scene.moments = Moments::new(Box::new(texts), &scene);
    // What is wrong between two frames is told before anything is rendered.
    for share in [0.5, 1.0].map(|part| part * scene.camera.shutter.value) {
        if let Err(diagnostics) = scene.at(share) {
            return Err(LoadError::Invalid { diagnostics, sources: scene.sources, files: Vec::new(), undecided: None });
        }
    }
    Ok(Loaded { scene, warnings })
}

/// A scene's texts, as they are read.
#[derive(Debug)]
struct Texts {
    /// The scene, the arguments of the command line, the files that are included.
    pub sources: Vec<Source>,
    syntax: Syntax,
    base_dir: PathBuf,
    overrides: Vec<Override>,
    library: Library,
}

/// What is wrong with them.
struct Faults {
    pub diagnostics: Diagnostics,
    /// The files that the text names, as far as it could be read.
    files: Vec<NamedFile>,
    /// As that of [`LoadError::Invalid`].
    undecided: Option<Arc<str>>,
}

impl Texts {
    /// The scene as it is so large a share of a frame after its frame's beginning, without its sources; and whether
    /// anything moves in it while the shutter is open.
    pub fn read(&self, share: f64) -> Result<(Loaded, bool), Faults> {
        let Texts { sources, syntax, base_dir, overrides, library } = self;
        let text = &sources[0].text;
        let mut sink = Sink::default();
        let scene = analyse(text, *syntax, overrides, library, share, &mut sink);
        for file in &library.files {
            sink.files.add(FileKind::Scene, &file.path, file.from);
        }
        sink.diagnostics.iter_mut().for_each(|fault| say_where_included(fault, sources));
        let helps = |edit: &Edit| {
            let mut sink_of_edited = Sink::default();
            let edited = apply_edits(text, std::slice::from_ref(edit));
            analyse(&edited, *syntax, overrides, library, share, &mut sink_of_edited);
            sink_of_edited.errors < sink.errors
        };
        if sink.errors > 0
            && let Some(fault) = foreign::whole(text, *syntax)
            && fault.edit.as_ref().is_none_or(helps)
        {
            return Err(Faults { diagnostics: vec![fault], files: Vec::new(), undecided: None });
        }
        let is_undecided =
            |fault: &Diagnostic| fault.severity == Severity::Warning || fault.code == codes::UNDECIDED_CAMERA;
        let undecided = scene.as_ref().and_then(|scene| scene.camera.name.clone());
        let undecided = undecided.filter(|_| sink.errors == 1 && sink.diagnostics.iter().all(is_undecided));
        // What could be read of a wrong scene is of no use any more, and may be large.
        let scene = scene.filter(|_| sink.errors == 0);
        let mut diagnostics = sink.diagnostics;
        let broken = files::broken_lines(text, &diagnostics);
        if sink.errors > 1 && follow_ups::is_cheap(sink.repeated) {
            follow_ups::leave_out(text, &mut diagnostics, |text| {
                let mut sink = Sink::default();
                analyse(text, *syntax, overrides, library, share, &mut sink);
                sink.diagnostics.retain(|fault| fault.severity == Severity::Error);
                (sink.diagnostics, sink.repeated)
            });
        }
        diagnostics.sort_by_key(|diagnostic| diagnostic.span);
        nameless::name_values(text, &mut diagnostics);
        follow_ups::withhold(text, &mut diagnostics);
        overrides::as_arguments(&mut diagnostics, overrides);
        let Some(scene) = scene else {
            return Err(Faults { diagnostics, files: sink.files.outside(&broken), undecided });
        };
        let moves = scene.moves;
        let includes = library.files.iter().map(|file| Arc::clone(&file.path)).collect();
        let scene = SceneDesc { base_dir: base_dir.clone(), includes, ..described(scene) };
        Ok((Loaded { scene, warnings: diagnostics }, moves))
    }
}

impl desc::Texts for Texts {
    fn scene(&self, share: f64) -> Result<SceneDesc, Diagnostics> {
        self.read(share).map(|(loaded, _)| loaded.scene).map_err(|faults| faults.diagnostics)
    }

    fn sources(&self) -> &[Source] {
        &self.sources
    }
}

/// The description that a scene's words give.
fn described(Whole { scene, camera, .. }: Whole) -> SceneDesc {
    SceneDesc {
        version: scene.version,
        animation: scene.animation.0,
        camera: camera.camera,
        camera_name: camera.name,
        cameras: scene.cameras,
        image: scene.image,
        render: scene.render,
        effects: scene.effects,
        output: scene.output,
        background: scene.background,
        lights: scene.lights,
        textures: scene.textures,
        materials: scene.materials,
        objects: scene.objects.0,
        base_dir: PathBuf::new(),
        sources: Vec::new(),
        includes: Vec::new(),
        moments: Moments::default(),
    }
}

/// Reads a scene from JSON that nobody will see: spans point nowhere, and no file is looked at.
pub(crate) fn unseen(text: &str) -> Result<SceneDesc, Diagnostics> {
    match unseen_with_warnings(text) {
        (Some(scene), _) => Ok(scene),
        (None, faults) => Err(faults),
    }
}

fn unseen_with_warnings(text: &str) -> (Option<SceneDesc>, Diagnostics) {
    let mut sink = Sink::default();
    let tree = parse_as(NO_SOURCE, text, Syntax::Json, &mut sink);
    let scene = read::scene(&tree, &mut sink).filter(|_| sink.errors == 0);
    (scene.map(described), sink.diagnostics)
}

impl SceneDesc {
    /// What is wrong with a scene that was built in code, or doubtful: all that reading it would tell, in its order.
    /// The diagnostics name fields (`objects[0].radius`) and no places. A scene that was read is right already. The
    /// files that it names are not looked at: compiling does that.
    ///
    /// ```
    /// use scene_format::desc::{Background, Object, Sphere};
    /// use scene_format::{SceneDesc, Severity};
    ///
    /// let mut scene = SceneDesc { background: Background::Color([1.0; 3]), ..SceneDesc::default() };
    /// assert_eq!(scene.validate()[0].code.as_str(), "E0207");
    ///
    /// let ball = |radius: f64| {
    ///     let (center, radius) = ([0.0; 3].into(), radius.into());
    ///     let (material, placements) = (Default::default(), Default::default());
    ///     let (transform, name, camera_visible) = (Vec::new(), Default::default(), true);
    ///     let sphere = Sphere { center, radius, material, transform, placements, camera_visible, name };
    ///     Object::from(sphere)
    /// };
    /// scene.objects = vec![ball(1.0).into(), ball(-1.0).into(), ball(f64::NAN).into()];
    /// scene.render.samples = 0.into();
    /// let faults = scene.validate();
    /// let paths: Vec<&str> = faults.iter().map(|fault| fault.path.as_str()).collect();
    /// assert_eq!(paths, ["render.samples", "objects[1].radius", "objects[2].radius"], "{faults:?}");
    /// assert!(faults.iter().all(|fault| fault.severity == Severity::Error));
    ///
    /// scene.objects.truncate(1);
    /// scene.render.samples = 16.into();
    /// assert!(scene.validate().is_empty());
    /// ```
    pub fn validate(&self) -> Diagnostics {
        let mut found = unseen_with_warnings(&with_texts(to_json(self, Defaults::Hidden))).1;
        // What reading offers to mend is in a text that nobody sees.
        found.iter_mut().for_each(|fault| fault.edit = None);
        found
    }
}

/// JSON with a text wherever a number is none or infinite, which JSON cannot say: so the fault is told of the field.
fn with_texts(json: String) -> String {
    if !json.contains("NaN") && !json.contains("inf") {
        return json;
    }
    let mut out = String::with_capacity(json.len() + 16);
    // Within quotes nothing is changed; a quote there stands behind a backslash.
    let (mut is_text, mut is_escaped, mut rest) = (false, false, json.as_str());
    while let Some(c) = rest.chars().next() {
        let none = ["NaN", "-inf", "inf"].into_iter().find(|none| !is_text && rest.starts_with(none));
        if let Some(none) = none {
            out += &format!("\"{none}\"");
            rest = &rest[none.len()..];
            continue;
        }
        is_text ^= c == '"' && !is_escaped;
        is_escaped = c == '\\' && !is_escaped;
        out.push(c);
        rest = &rest[c.len_utf8()..];
    }
    out
}

/// The scene of a text, or what could be read of it, so large a share of a frame after its beginning; what is wrong
/// goes to `sink`.
fn analyse(
    text: &str,
    syntax: Syntax,
    overrides: &[Override],
    library: &Library,
    share: f64,
    sink: &mut Sink,
) -> Option<Whole> {
    let mut tree = parse(text, syntax, sink);
    tree.share = share;
    overrides::apply(&mut tree, overrides, sink);
    library.append_to(&mut tree, sink);
    read::scene(&tree, sink)
}

fn too_large(name: String) -> LoadError {
    let gib = MAX_FILE_BYTES >> 30;
    let diagnostic =
        Diagnostic::error(codes::TOO_LARGE, Span { source: 0, start: 0, end: 0 }, "the scene file is too large")
            .expected(format!("at most {gib} GiB"))
            .hint("put many copies of a mesh into a placements file beside the scene");
    LoadError::Invalid {
        diagnostics: vec![diagnostic],
        sources: vec![Source { name, text: String::new(), included: None }],
        files: Vec::new(),
        undecided: None,
    }
}

/// The text of a file in UTF-16, as Windows programs save it: told by its byte order mark, or by a zero in every other
/// byte at its beginning.
fn utf16(bytes: &[u8]) -> Option<String> {
    const LOOK_AT: usize = 64;
    let head = &bytes[..bytes.len().min(LOOK_AT)];
    let zeros = |from: usize| head.len() >= 8 && head.iter().skip(from).step_by(2).all(|&byte| byte == 0);
    let of_two: fn([u8; 2]) -> u16 = match head {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ if zeros(1) && !zeros(0) => u16::from_le_bytes,
        _ if zeros(0) && !zeros(1) => u16::from_be_bytes,
        _ => return None,
    };
    let units = bytes.chunks_exact(2).map(|pair| of_two([pair[0], pair[1]]));
    Some(char::decode_utf16(units).map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER)).collect())
}

/// The text of a file in UTF-32 or UTF-16, and which it is.
fn wide(bytes: &[u8]) -> Option<(String, &'static str)> {
    let of_four: Option<fn([u8; 4]) -> u32> = match bytes {
        [0xff, 0xfe, 0, 0, ..] => Some(u32::from_le_bytes),
        [0, 0, 0xfe, 0xff, ..] => Some(u32::from_be_bytes),
        [a, 0, 0, 0, b, 0, 0, 0, ..] if *a != 0 && *b != 0 => Some(u32::from_le_bytes),
        [0, 0, 0, a, 0, 0, 0, b, ..] if *a != 0 && *b != 0 => Some(u32::from_be_bytes),
        _ => None,
    };
    let Some(of_four) = of_four else { return utf16(bytes).map(|text| (text, "UTF-16")) };
    let signs = bytes.chunks_exact(4).map(|four| of_four([four[0], four[1], four[2], four[3]]));
    Some((signs.map(|sign| char::from_u32(sign).unwrap_or(char::REPLACEMENT_CHARACTER)).collect(), "UTF-32"))
}

fn in_wide(name: &str, text: String, encoding: &str) -> LoadError {
    let start = if text.starts_with('\u{feff}') { 3 } else { 0 };
    let end = start + text[start..].lines().next().map_or(0, str::len);
    let span = Span { source: 0, start: start as u32, end: end as u32 };
    let diagnostic = Diagnostic::error(codes::NOT_UTF8, span, format!("the file is {encoding}, not UTF-8"))
        .expected("a text file in UTF-8")
        .hint("save it as UTF-8 in your editor; in PowerShell: `.. | Out-File -Encoding utf8 FILE`");
    LoadError::Invalid {
        diagnostics: vec![diagnostic],
        sources: vec![Source { name: name.to_owned(), text, included: None }],
        files: Vec::new(),
        undecided: None,
    }
}

/// What a file is that is no text, by its first bytes, and what to do with it.
fn of_bytes(bytes: &[u8]) -> Option<(&'static str, &'static str)> {
    const MESH: &str = "a mesh stands in a scene: Mesh(file: \"..\")";
    const PICTURE: &str = "a picture stands in a scene as a texture or a background; `tracer new` starts a scene";
    const KNOWN: [(&[u8], &str, &str); 12] = [
        (b"BLENDER", "a file of Blender", "export a mesh from it, as glTF or OBJ, and name that: Mesh(file: \"..\")"),
        (b"\x28\xb5\x2f\xfd", "packed by zstd, as files of Blender are", "unpack it"),
        (b"\x1f\x8b", "packed by gzip", "unpack it: `gunzip FILE`"),
        (b"PK\x03\x04", "a zip archive", "unpack it"),
        (b"%PDF", "a PDF", "save it as text in UTF-8"),
        (b"glTF", "a mesh in GLB", MESH),
        (b"ply\n", "a mesh in PLY", MESH),
        (b"\x89PNG", "a picture in PNG", PICTURE),
        (b"\xff\xd8\xff", "a picture in JPEG", PICTURE),
        (b"\x76\x2f\x31\x01", "a picture in OpenEXR", PICTURE),
        (b"#?RADIANCE", "a picture in Radiance HDR", PICTURE),
        (b"\x7fELF", "a program", "name a scene"),
    ];
    KNOWN.iter().find(|(head, ..)| bytes.starts_with(head)).map(|(_, name, way)| (*name, *way))
}

fn not_utf8(name: &str, error: &std::string::FromUtf8Error) -> LoadError {
    let at = error.utf8_error().valid_up_to();
    let text = String::from_utf8_lossy(error.as_bytes()).into_owned();
    let byte = error.as_bytes().get(at).copied().unwrap_or(0);
    let span = Span { source: 0, start: at as u32, end: at as u32 + 3 };
    let bad = format!("byte {at} (0x{byte:02x}) is no character");
    let (message, way) = match of_bytes(error.as_bytes()) {
        Some((what, way)) => (format!("the file is {what}, not a scene: {bad}"), way),
        None => (format!("the file is not UTF-8: {bad}"), "save it as UTF-8 in your editor"),
    };
    let diagnostic = Diagnostic::error(codes::NOT_UTF8, span, message).expected("a text file in UTF-8").hint(way);
    LoadError::Invalid {
        diagnostics: vec![diagnostic],
        sources: vec![Source { name: name.to_owned(), text, included: None }],
        files: Vec::new(),
        undecided: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::desc::{Amount, Light, MaterialRef, Object, Transform};

    const RON: &str = r#"Scene(
        camera: Camera(position: (0, 0, 55), fov: 60),
        lights: [SphereLight(center: [-10, 20, 40], radius: 5, intensity: 3974)],
        materials: { "glass": Transparent(ior: 1.52) },
        objects: [
            Sphere(center: (20, 30, -20), radius: 10, material: "glass"),
            Mesh(file: "cat.obj", transform: [Scale(0.8), DropTo(y: -20)]),
        ],
    )"#;

    const TOML: &str = r#"
        [camera]
        position = [0, 0, 55]
        fov = 60
        [materials]
        glass = { Transparent = { ior = 1.52 } }
        [[lights]]
        SphereLight = { center = [-10, 20, 40], radius = 5, intensity = 3974 }
        [[objects]]
        Sphere = { center = [20, 30, -20], radius = 10, material = "glass" }
        [[objects]]
        [objects.Mesh]
        file = "cat.obj"
        transform = [{ Scale = 0.8 }, { DropTo = { y = -20 } }]
    "#;

    fn read(text: &str, syntax: Syntax) -> SceneDesc {
        load_str("scene", text, syntax, Path::new("."), &[]).expect("the scene is right").scene
    }

    #[test]
    fn both_syntaxes_give_the_same_scene() {
        let (ron, toml) = (read(RON, Syntax::Ron), read(TOML, Syntax::Toml));
        assert_eq!(SceneDesc { sources: Vec::new(), ..ron.clone() }, SceneDesc { sources: Vec::new(), ..toml });
        assert_eq!(ron.camera.fov.value, 60.0);
        let Light::SphereLight(light) = &ron.lights[0].value;
        assert_eq!(light.amount.value, Amount::Intensity([3974.0; 3]));
        let Object::Mesh(mesh) = &ron.objects[1].value else { panic!("the second object is a mesh") };
        assert_eq!(mesh.material, MaterialRef::Default);
        assert_eq!(mesh.transform[0].value, Transform::Scale { factor: [0.8; 3], about: None });
    }

    #[test]
    fn editors_may_name_the_schema_and_other_strange_keys_are_reported() {
        read(&format!("\"$schema\" = \"scene.schema.json\"\n{TOML}"), Syntax::Toml);
        let strange = format!("\"$scheme\" = \"scene.schema.json\"\n{TOML}");
        assert!(load_str("scene", &strange, Syntax::Toml, Path::new("."), &[]).is_err());
    }

    #[test]
    fn json_is_ron_enough() {
        let json = r#"{ "background": 1, "objects": [{ "Sphere": { "center": [0, 0, 0], "radius": 1 } }] }"#;
        assert_eq!(read(json, Syntax::Ron).objects.len(), 1);
    }

    #[test]
    fn spans_point_at_the_very_value() {
        let scene = read(RON, Syntax::Ron);
        let span = scene.camera.fov.span;
        assert_eq!(&RON[span.start as usize..span.end as usize], "60");
    }

    #[test]
    fn a_missing_file_is_no_diagnostic() {
        let error = load(Path::new("no/such/scene.ron")).expect_err("there is no such file");
        assert!(matches!(error, LoadError::Io { .. }));
        assert!(error.to_string().starts_with("cannot read the scene file no/such/scene.ron"), "{error}");
    }

    #[test]
    fn bytes_that_are_no_text_are_reported_where_they_stand() {
        let bytes = b"Scene(objects: [\xff])".to_vec();
        let error = load_bytes("s.ron", bytes, Some(Syntax::Ron), Path::new("."), &[]).expect_err("not UTF-8");
        let LoadError::Invalid { diagnostics, .. } = error else { panic!("a diagnostic") };
        assert_eq!((diagnostics[0].code, diagnostics[0].span.start), (codes::NOT_UTF8, 16));
    }

    #[test]
    fn a_set_edits_the_tree_and_its_value_points_into_the_argument() {
        let sets = ["camera.fov=45", "objects[0].radius=2", "effects.exposure=1", "materials.glass.ior=1.33"];
        let sets = sets.map(Override::from);
        let scene = load_str("s", RON, Syntax::Ron, Path::new("."), &sets).expect("right").scene;
        assert_eq!(scene.camera.fov.value, 45.0);
        assert_eq!(scene.camera.fov.span, Span { source: 1, start: 11, end: 13 });
        assert_eq!(scene.effects.exposure.value, 1.0);
        let Object::Sphere(sphere) = &scene.objects[0].value else { panic!("a sphere") };
        assert_eq!(sphere.radius.value, 2.0);
        assert_eq!(scene.sources[2].text, "objects[0].radius=2");
    }
}
