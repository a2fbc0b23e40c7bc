//! The texts that are open in the editor.

use crate::kin;
use crate::positions::{Encoding, Lines};
use lsp_types::Uri;
use scene_format::{Diagnostic, Syntax};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// An open text.
#[derive(Clone, Debug)]
pub struct Document {
    /// Its address.
    pub uri: Uri,
    /// What the editor counts its changes by.
    pub version: i32,
    /// All of it.
    pub text: Arc<str>,
    /// By its name, else by its looks.
    pub syntax: Syntax,
    /// Whether it is a scene; of other files nothing is told.
    pub is_scene: bool,
    /// Where it lies, if it lies on this machine.
    pub path: Option<PathBuf>,
    /// Its lines.
    pub lines: Lines,
    /// What was told to be wrong with it, by itself.
    pub faults: Arc<[Diagnostic]>,
}

impl Document {
    /// The folder that the names of files start from.
    pub fn folder(&self) -> &Path {
        self.path.as_deref().and_then(Path::parent).unwrap_or(Path::new(""))
    }

    /// The name to show in messages.
    pub fn name(&self) -> String {
        let name = self.path.as_deref().and_then(Path::file_name);
        name.map_or_else(|| "scene".to_owned(), |name| name.to_string_lossy().into_owned())
    }
}

/// All of them.
pub struct Documents {
    open: HashMap<String, Document>,
    /// Who asks.
    pub client: Client,
}

/// What an editor can take.
#[derive(Clone, Copy)]
pub struct Client {
    /// What columns count.
    pub encoding: Encoding,
    /// Whether what is completed may say where to go on (`$0`).
    pub snippets: bool,
}

impl Documents {
    /// None yet.
    pub fn new(client: Client) -> Self {
        Documents { open: HashMap::new(), client }
    }

    /// A text as it is now.
    pub fn put(&mut self, uri: Uri, version: i32, text: String) {
        let path = path_of(&uri);
        let syntax = path.as_deref().and_then(Syntax::from_path).unwrap_or_else(|| Syntax::guess(&text));
        let is_scene = kin::is_scene(&text, syntax);
        let lines = Lines::new(&text, self.client.encoding);
        let key = uri.as_str().to_owned();
        let faults = Arc::default();
        self.open.insert(key, Document { uri, version, text: text.into(), syntax, is_scene, path, lines, faults });
    }

    /// It is open no more.
    pub fn remove(&mut self, uri: &Uri) {
        self.open.remove(uri.as_str());
    }

    /// A text that is open.
    pub fn get(&self, uri: &Uri) -> Option<&Document> {
        self.open.get(uri.as_str())
    }

    /// A text that is open, to be changed.
    pub fn get_mut(&mut self, uri: &Uri) -> Option<&mut Document> {
        self.open.get_mut(uri.as_str())
    }

    /// All that are open.
    pub fn all(&self) -> impl Iterator<Item = &Document> {
        self.open.values()
    }

    /// A scene that is open.
    pub fn scene(&self, uri: &Uri) -> Option<&Document> {
        self.get(uri).filter(|document| document.is_scene)
    }
}

/// The `file:` address of a path, without steps up: `None` where it has none.
pub fn uri_of(path: &Path) -> Option<Uri> {
    let path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let text = path.to_str()?;
    // On Windows: \\?\C:\folder.
    let text = if cfg!(windows) { text.trim_start_matches(r"\\?\").replace('\\', "/") } else { text.to_owned() };
    let mut uri = if text.starts_with('/') { "file://".to_owned() } else { "file:///".to_owned() };
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || matches!(byte, b'/' | b'-' | b'_' | b'.' | b'~' | b':') {
            uri.push(char::from(byte));
        } else {
            uri += &format!("%{byte:02X}");
        }
    }
    uri.parse().ok()
}

/// The path of a `file:` address.
fn path_of(uri: &Uri) -> Option<PathBuf> {
    let rest = uri.as_str().strip_prefix("file://")?;
    let path = rest.find('/').map(|at| &rest[at..])?;
    let mut bytes = Vec::with_capacity(path.len());
    let mut from = path.bytes();
    while let Some(byte) = from.next() {
        if byte == b'%' {
            let digits = [from.next()?, from.next()?];
            bytes.push(u8::from_str_radix(std::str::from_utf8(&digits).ok()?, 16).ok()?);
        } else {
            bytes.push(byte);
        }
    }
    let path = String::from_utf8(bytes).ok()?;
    // On Windows: /c:/folder.
    let drive = path.as_bytes().get(2) == Some(&b':') && cfg!(windows);
    Some(PathBuf::from(if drive { &path[1..] } else { &path[..] }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_paths() {
        let path = |uri: &str| path_of(&uri.parse::<Uri>().expect("an address"));
        assert_eq!(path("file:///home/a%20b/%C3%A9.ron"), Some(PathBuf::from("/home/a b/é.ron")));
        assert_eq!(path("untitled:Untitled-1"), None);
    }
}
