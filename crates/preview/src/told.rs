//! Diagnostics as the page shows them: the text that the terminal shows, and the place for the editor.

use scene_format::diagnostic::Source;
use scene_format::render::{Style, position, texts};
use scene_format::{Diagnostic, Severity};
use serde::Serialize;
use std::path::{Path, PathBuf};

/// Columns of an excerpt where nobody asks for fewer; longer lines are cut around the caret.
pub const WIDTH: usize = 110;

/// A diagnostic, told.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Told {
    /// `error` or `warning`.
    pub severity: &'static str,
    /// `E0201`; empty for what the language has no code for.
    pub code: String,
    /// Excerpt, caret, what was expected, a hint.
    pub text: String,
    /// Where it is.
    pub place: Option<Place>,
}

/// A place in a file, counted as editors do.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// The file, as the page names it.
    pub name: String,
    /// The file, to be opened: pages are not told of folders.
    #[serde(skip)]
    pub path: PathBuf,
    /// 1-based; 0: the file as a whole.
    pub line: u64,
    /// 1-based, in characters.
    pub column: u64,
}

impl Told {
    /// A fault that is none of the scene's text.
    pub fn plain(text: impl Into<String>) -> Self {
        Told { severity: "error", code: String::new(), text: text.into(), place: None }
    }
}

/// All diagnostics; of many that are alike the first one tells. `scene`: the file of the first source,
/// `width`: columns of an excerpt.
pub fn told(diagnostics: &[Diagnostic], sources: &[Source], scene: &Path, width: usize) -> Vec<Told> {
    texts(diagnostics, sources, Style { color: false, width })
        .into_iter()
        .map(|(index, text)| {
            let diagnostic = &diagnostics[index];
            Told {
                severity: match diagnostic.severity {
                    Severity::Error => "error",
                    Severity::Warning => "warning",
                },
                code: diagnostic.code.as_str().to_owned(),
                text,
                place: place(diagnostic, sources, scene),
            }
        })
        .collect()
}

fn place(diagnostic: &Diagnostic, sources: &[Source], scene: &Path) -> Option<Place> {
    if let Some(elsewhere) = &diagnostic.elsewhere {
        let name = elsewhere.path.file_name().unwrap_or(elsewhere.path.as_os_str());
        return Some(Place {
            name: name.to_string_lossy().into_owned(),
            path: elsewhere.path.clone(),
            line: elsewhere.line,
            column: 1,
        });
    }
    of_span(diagnostic.span, sources, scene)
}

/// The place of a span, where its source is a file.
pub fn of_span(span: scene_format::diagnostic::Span, sources: &[Source], scene: &Path) -> Option<Place> {
    let source = sources.get(span.source as usize)?;
    let path = if span.source == 0 { scene.to_owned() } else { file_of(source, scene)? };
    let at = position(&source.text, span.start as usize);
    let name = path.file_name().map_or_else(|| source.name.clone(), |name| name.to_string_lossy().into_owned());
    Some(Place { name, path, line: at.line as u64, column: at.column as u64 })
}

/// The file of a source beside the scene's own; `--set` has none.
pub fn file_of(source: &Source, scene: &Path) -> Option<PathBuf> {
    let named = Path::new(&source.name);
    let beside = scene.parent().unwrap_or(Path::new("")).join(named);
    [named.to_owned(), beside].into_iter().find(|path| path.is_file())
}
