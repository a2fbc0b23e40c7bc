//! What is wrong with a document, in the protocol's words.

use crate::documents::Document;
use lsp_types::{DiagnosticRelatedInformation, DiagnosticSeverity, Location, NumberOrString, Range, TextEdit};
use scene_format::diagnostic::{Edit, Source, Span};
use scene_format::render::apply_edits;
use scene_format::{Diagnostic, Diagnostics, LoadError, Loaded, Override, SceneDesc, Severity, codes, is_library};
use tracer_core::Looking;

/// Frames that are looked at, at most: somebody is writing.
const MOST_FRAMES: usize = 200;

/// The scene of a document with what is set. Of cameras of which none is chosen the first is taken: that is for whoever
/// renders to say.
fn load(document: &Document, text: &str, set: &[Override]) -> Result<Loaded, LoadError> {
    let load =
        |set: &[Override]| scene_format::load_str(&document.name(), text, document.syntax, document.folder(), set);
    match load(set) {
        Err(LoadError::Invalid { undecided: Some(camera), .. }) => load(&[set, &[Override::camera(&camera)]].concat()),
        loaded => loaded,
    }
}

/// What the text by itself tells; nothing of what is no scene.
pub fn found(document: &Document) -> Diagnostics {
    if !document.is_scene {
        return Diagnostics::new();
    }
    found_in(document, &document.text)
}

fn found_in(document: &Document, text: &str) -> Diagnostics {
    match load(document, text, &[]) {
        Ok(loaded) => loaded.warnings,
        Err(LoadError::Invalid { mut diagnostics, .. }) => {
            // A file that is there to be included has nothing to render.
            if is_library(text, document.syntax) {
                diagnostics.retain(|fault| fault.code != codes::NO_OBJECTS);
            }
            diagnostics
        }
        Err(LoadError::Io { .. }) => Diagnostics::new(),
    }
}

/// No edit of a longer text is tried: somebody waits at every move of the cursor.
const LONGEST_TRIED: usize = 64 << 10;

/// So many bytes are read for all edits that are asked for at a time.
const MOST_READ: usize = 256 << 10;

/// Edits that are tried: most that faults offer mend them, and some only bring the next fault to light.
pub struct Tried<'d> {
    document: &'d Document,
    before: (usize, usize),
    /// Bytes that may still be read.
    left: usize,
}

impl<'d> Tried<'d> {
    /// Those of a document.
    pub fn of(document: &'d Document) -> Self {
        let left = if document.text.len() < LONGEST_TRIED { MOST_READ } else { 0 };
        Tried { document, before: count(&document.faults), left }
    }

    /// Whether errors become fewer by an edit, or warnings where errors do not become more; not where that would take
    /// too long to say.
    pub fn is_better(&mut self, edit: &Edit) -> bool {
        let text = apply_edits(&self.document.text, std::slice::from_ref(edit));
        let Some(left) = self.left.checked_sub(text.len()) else { return false };
        self.left = left;
        count(&found_in(self.document, &text)) < self.before
    }
}

/// Errors first, then warnings.
fn count(faults: &[Diagnostic]) -> (usize, usize) {
    let errors = faults.iter().filter(|fault| fault.severity == Severity::Error).count();
    (errors, faults.len() - errors)
}

/// With what the files that it names tell, and its other frames: meshes and pictures are read, so this may take as long
/// as they do.
pub fn with_files(document: &Document) -> Diagnostics {
    match load(document, &document.text, &[]) {
        Ok(loaded) => {
            let mut all = loaded.warnings;
            match tracer_core::compile(&loaded.scene) {
                Ok(scene) => {
                    all.extend(scene.warnings.iter().cloned());
                    all.extend(of_frames(document, &loaded.scene));
                }
                Err(error) => all.extend(error.diagnostics),
            }
            all
        }
        Err(LoadError::Invalid { mut diagnostics, sources, files, .. }) => {
            let sources: &[Source] = &sources;
            diagnostics.extend(tracer_core::check_files(&files, document.folder(), sources));
            diagnostics
        }
        Err(LoadError::Io { .. }) => Diagnostics::new(),
    }
}

/// What is wrong at other frames of its animation.
fn of_frames(document: &Document, scene: &SceneDesc) -> Diagnostics {
    // Their warnings are left to `tracer check`: they would take longer than a keystroke may.
    let looking = Looking { first: 0, last: scene.animation.frames.value - 1, most: MOST_FRAMES, warnings: false };
    let at = |frame: u32| load(document, &document.text, &[Override::frame(frame)]);
    let wrong = tracer_core::check_frames(scene, looking, at).map_or_else(Vec::new, |looked| looked.wrong);
    wrong.into_iter().flat_map(|frame| frame.diagnostics).collect()
}

/// Diagnostics in the protocol's words; those of other texts stand at the beginning.
pub fn translated(document: &Document, diagnostics: &[Diagnostic]) -> Vec<lsp_types::Diagnostic> {
    diagnostics.iter().map(|fault| one(document, fault)).collect()
}

fn one(document: &Document, fault: &Diagnostic) -> lsp_types::Diagnostic {
    let fault = &fault.in_syntax(document.syntax);
    let mut message = fault.message.clone();
    if let Some(elsewhere) = &fault.elsewhere {
        let line = if elsewhere.line > 0 { format!(", line {}", elsewhere.line) } else { String::new() };
        message += &format!("\n{}{line}", elsewhere.path.display());
    }
    for (what, text) in [("expected", &fault.expected), ("hint", &fault.hint)] {
        if !text.is_empty() {
            message += &format!("\n{what}: {text}");
        }
    }
    let related: Vec<DiagnosticRelatedInformation> = fault
        .labels
        .iter()
        .map(|label| DiagnosticRelatedInformation {
            location: Location { uri: document.uri.clone(), range: range(document, label.span) },
            message: label.text.clone(),
        })
        .collect();
    lsp_types::Diagnostic {
        range: range(document, fault.span),
        severity: Some(match fault.severity {
            Severity::Error => DiagnosticSeverity::ERROR,
            Severity::Warning => DiagnosticSeverity::WARNING,
        }),
        code: Some(NumberOrString::String(fault.code.as_str().to_owned())),
        code_description: None,
        source: Some("tracer".to_owned()),
        message,
        related_information: (!related.is_empty()).then_some(related),
        tags: None,
        data: None,
    }
}

/// The place of a span of the document's own text.
pub fn range(document: &Document, span: Span) -> Range {
    if span.source != 0 {
        return Range::default();
    }
    document.lines.range(&document.text, span.start as usize..span.end as usize)
}

/// An edit of the document's own text.
pub fn edit(document: &Document, edit: &Edit) -> TextEdit {
    TextEdit { range: range(document, edit.span), new_text: edit.replacement.clone() }
}
