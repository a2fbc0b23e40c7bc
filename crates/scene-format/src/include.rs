//! The files that a scene includes, and those that these include: found and read before the scene is, so that all of
//! them are in memory as long as its tree.
//!
//! What is wrong with a file, or with a circle of them, is told by the reader at the place that names it.

use crate::diagnostic::{Label, Severity, Source, Span};
use crate::files::{self, MAX_FILE_BYTES, MOST_FILES, joined};
use crate::overrides::Override;
use crate::syntax::{Sink, Syntax, parse, ron};
use crate::tree::{Builder, Item, Kind, NOWHERE, Node, Root, Text, Tree};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A file that is included somewhere.
#[derive(Debug)]
pub(crate) struct Included {
    /// Relative to the scene's folder.
    pub path: Arc<Path>,
    /// Where paths in it start, relative to the scene's folder.
    pub folder: PathBuf,
    /// Its name and text.
    pub source: Source,
    pub syntax: Syntax,
    /// Why it could not be read.
    pub fault: Option<String>,
    /// Where it is named first.
    pub from: Span,
}

/// All of them, in the order in which they are found.
#[derive(Debug, Default)]
pub(crate) struct Library {
    pub files: Vec<Included>,
    known: HashMap<PathBuf, usize>,
    bytes: u64,
}

impl Library {
    /// Reads all files that a scene includes. `source` numbers begin after those of the overrides.
    pub fn of(text: &str, syntax: Syntax, base_dir: &Path, overrides: &[Override]) -> Library {
        let mut library = Library::default();
        let first = 1 + overrides.len();
        library.look(text, syntax, 0, Path::new(""), base_dir);
        for (k, set) in overrides.iter().enumerate() {
            library.look_at_override(&set.argument, k + 1, base_dir);
        }
        let mut k = 0;
        while let Some(file) = library.files.get_mut(k) {
            let (text, syntax, folder) = (std::mem::take(&mut file.source.text), file.syntax, file.folder.clone());
            library.look(&text, syntax, first + k, &folder, base_dir);
            library.files[k].source.text = text;
            k += 1;
        }
        library
    }

    /// Finds what a text includes. Texts without the word are not parsed twice.
    fn look(&mut self, text: &str, syntax: Syntax, source: usize, folder: &Path, base_dir: &Path) {
        if !text.contains("nclude") {
            return;
        }
        let tree = parse(text, syntax, &mut Sink::default());
        let Some(root) = tree.root() else { return };
        for (_, list) in root.fields().filter(|(key, _)| key.text() == "include") {
            self.add_all(list, source, folder, base_dir);
        }
        self.look_in(&tree, source, folder, base_dir);
    }

    /// Finds the `Include`s of a tree, wherever they stand.
    fn look_in(&mut self, tree: &Tree<'_>, source: usize, folder: &Path, base_dir: &Path) {
        for index in 0..tree.nodes.len() {
            let Some(item) = tree.item(index) else { continue };
            let body = match item.kind() {
                Kind::Struct if item.name() == Some("Include") => item,
                Kind::Key if item.text() == "Include" => match tree.item(index + 1) {
                    Some(value) => value,
                    None => continue,
                },
                _ => continue,
            };
            let file = body.fields().find(|(key, _)| key.text() == "file");
            if let Some((_, name)) = file {
                self.add_all(name, source, folder, base_dir);
            }
        }
    }

    fn look_at_override(&mut self, argument: &str, source: usize, base_dir: &Path) {
        let names = |argument: &str| argument.contains("nclude") || argument.contains(".file");
        let Some(equals) = argument.find('=').filter(|_| names(argument)) else { return };
        let mut builder = Builder::new(0);
        ron::parse_from(argument, equals + 1, &mut builder, &mut Sink::default());
        let texts = vec![Text { text: argument, syntax: Syntax::Ron, folder: Path::new("") }];
        let tree = Tree { texts, nodes: builder.nodes, ..Tree::default() };
        let field = argument[..equals].trim();
        if let Some(value) = tree.item(0).filter(|_| field.starts_with("include")) {
            self.add_all(value, source, Path::new(""), base_dir);
        }
        // A field called `file` may be that of an `Include`, where it names a scene.
        let is_scene = |name: &Item<'_, '_>| Syntax::from_path(Path::new(&*name.text())).is_some();
        if let Some(name) = tree.item(0).filter(|_| field.ends_with(".file"))
            && name.texts().any(|name| is_scene(&name))
        {
            self.add_all(name, source, Path::new(""), base_dir);
        }
        self.look_in(&tree, source, Path::new(""), base_dir);
    }

    /// All names that a value may come to, be it picked or repeated.
    fn add_all(&mut self, value: Item<'_, '_>, source: usize, folder: &Path, base_dir: &Path) {
        let names: Vec<Item<'_, '_>> = value.texts().filter(|name| !name.text().starts_with('=')).collect();
        names.into_iter().for_each(|name| self.add(name, source, folder, base_dir));
    }

    fn add(&mut self, name: Item<'_, '_>, source: usize, folder: &Path, base_dir: &Path) {
        if name.kind() != Kind::Text || self.files.len() >= MOST_FILES {
            return;
        }
        let path = joined(folder, &name.text());
        if self.known.contains_key(&path) {
            return;
        }
        let whole = base_dir.join(&path);
        /// What a `Mesh` places.
        const MESHES: [&str; 6] = ["obj", "off", "ply", "stl", "gltf", "glb"];
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
        let is_mesh = ending.is_some_and(|ending| MESHES.contains(&&*ending));
        let read = if is_mesh {
            Err("it is a mesh, which stands in a scene: Mesh(file: ..)".to_owned())
        } else {
            self.read(&whole)
        };
        let (text, fault) = match read {
            Ok(text) => (text, None),
            Err(fault) => (String::new(), Some(fault)),
        };
        let syntax = Syntax::from_path(&path).unwrap_or_else(|| Syntax::guess(&text));
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let from = Span { source: source as u32, ..name.span() };
        self.known.insert(path.clone(), self.files.len());
        let included = Label { span: from, text: format!("{} is included here", path.display()) };
        let source = Source { name: whole.display().to_string(), text, included: Some(included) };
        self.files.push(Included { path: path.into(), folder, source, syntax, fault, from });
    }

    /// The text of a file, or why there is none.
    fn read(&mut self, path: &Path) -> Result<String, String> {
        let why = |error: std::io::Error| match error.kind() {
            std::io::ErrorKind::NotFound => "there is no such file".to_owned(),
            _ => error.to_string(),
        };
        let about = std::fs::metadata(path).map_err(why)?;
        if !about.is_file() {
            return Err("it is no file".to_owned());
        }
        self.bytes += about.len();
        if self.bytes > MAX_FILE_BYTES {
            return Err(format!("all included files have more than {} GiB", MAX_FILE_BYTES >> 30));
        }
        let Some(bytes) = files::read(path, MAX_FILE_BYTES).map_err(why)? else {
            return Err(format!("it has more than {} GiB", MAX_FILE_BYTES >> 30));
        };
        String::from_utf8(bytes)
            .map_err(|error| format!("it is not UTF-8 at byte {}", error.utf8_error().valid_up_to()))
    }

    /// Puts the nodes of all files behind those of the scene. Of faults of syntax the first of each file is told.
    pub fn append_to<'s>(&'s self, tree: &mut Tree<'s>, sink: &mut Sink) {
        for file in &self.files {
            let number = tree.texts.len();
            tree.texts.push(Text { text: &file.source.text, syntax: file.syntax, folder: &file.folder });
            let mut root = Root {
                path: Arc::clone(&file.path),
                name: file.path.display().to_string(),
                root: NOWHERE,
                nodes: 0,
                fault: file.fault.clone(),
            };
            let mut faults = Sink::default();
            let mut inner = parse(&file.source.text, file.syntax, &mut faults);
            inner.flatten();
            let first = faults.diagnostics.into_iter().find(|fault| fault.severity == Severity::Error);
            if let Some(mut fault) = first {
                fault.span.source = number as u32;
                fault.labels.iter_mut().for_each(|label| label.span.source = number as u32);
                fault.edit = None;
                sink.push(fault);
            } else if file.fault.is_none() && !inner.nodes.is_empty() {
                (root.root, root.nodes) = (tree.nodes.len() as u32, inner.nodes.len() as u32);
                tree.nodes.extend(inner.nodes.iter().map(|node| Node { source: number as u16, ..node }));
            }
            tree.included.push(root);
        }
    }
}
