//! What the editor asks, and the answers: one function a request.

use crate::documents::{Document, Documents, uri_of};
use crate::kin;
use crate::{across, diagnostics};
use lsp_types::request::{
    CodeActionRequest, ColorPresentationRequest, Completion, DocumentColor, DocumentHighlightRequest,
    DocumentSymbolRequest, Formatting, GotoDefinition, HoverRequest, PrepareRenameRequest, References, Rename, Request,
};
use lsp_types::{
    CodeAction, CodeActionKind, CodeActionOrCommand, CodeActionParams, Color, ColorInformation, ColorPresentation,
    ColorPresentationParams, CompletionItem, CompletionItemKind, CompletionParams, CompletionResponse,
    CompletionTextEdit, DocumentColorParams, DocumentFormattingParams, DocumentHighlight, DocumentHighlightParams,
    DocumentSymbol, DocumentSymbolParams, DocumentSymbolResponse, Documentation, GotoDefinitionParams,
    GotoDefinitionResponse, Hover, HoverContents, HoverParams, InsertTextFormat, Location, MarkupContent, MarkupKind,
    PrepareRenameResponse, Range, ReferenceParams, RenameParams, SymbolKind, TextDocumentPositionParams, TextEdit, Uri,
    WorkspaceEdit,
};
use scene_format::analysis::{self, CompletionKind, Symbol};
use scene_format::diagnostic::Severity;
use scene_format::{Diagnostic, FileKind, LoadError, codes};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::HashMap;
use std::path::Path;

/// Why a request is not answered.
pub enum Why {
    /// It cannot be read.
    Params(String),
    /// It cannot be done now.
    Refused(String),
}

/// The answer to a request, as JSON; `None` where nobody knows it.
pub fn answer(documents: &Documents, method: &str, params: Value) -> Option<Result<String, Why>> {
    Some(match method {
        Completion::METHOD => asked(params, |params| completion(documents, params)),
        HoverRequest::METHOD => asked(params, |params| hover(documents, params)),
        GotoDefinition::METHOD => asked(params, |params| definition(documents, params)),
        References::METHOD => asked(params, |params| references(documents, params)),
        DocumentHighlightRequest::METHOD => asked(params, |params| highlights(documents, params)),
        PrepareRenameRequest::METHOD => asked(params, |params| prepare_rename(documents, params)),
        Rename::METHOD => {
            parsed(params).and_then(|params| rename(documents, params).map_err(Why::Refused)).and_then(text)
        }
        DocumentSymbolRequest::METHOD => asked(params, |params| symbols(documents, params)),
        DocumentColor::METHOD => asked(params, |params| colors(documents, params)),
        ColorPresentationRequest::METHOD => asked(params, |params| presentations(documents, params)),
        CodeActionRequest::METHOD => asked(params, |params| actions(documents, params)),
        Formatting::METHOD => {
            parsed(params).and_then(|params| formatting(documents, params).map_err(Why::Refused)).and_then(text)
        }
        _ => return None,
    })
}

fn parsed<P: DeserializeOwned>(params: Value) -> Result<P, Why> {
    serde_json::from_value(params).map_err(|error| Why::Params(error.to_string()))
}

fn text(answer: impl serde::Serialize) -> Result<String, Why> {
    serde_json::to_string(&answer).map_err(|error| Why::Params(error.to_string()))
}

/// An answer that may be nothing, which the protocol writes as null.
fn asked<P: DeserializeOwned, A: serde::Serialize>(
    params: Value,
    answer: impl FnOnce(P) -> Option<A>,
) -> Result<String, Why> {
    text(answer(parsed(params)?))
}

/// The scene at a place, and the place's byte.
fn at<'d>(documents: &'d Documents, place: &TextDocumentPositionParams) -> Option<(&'d Document, usize)> {
    let document = documents.scene(&place.text_document.uri)?;
    Some((document, document.lines.byte(&document.text, place.position)))
}

fn markdown(value: String) -> MarkupContent {
    MarkupContent { kind: MarkupKind::Markdown, value }
}

/// A snippet without its signs, for editors that do not know them.
fn plain(snippet: &str) -> String {
    let mut out = String::new();
    let mut signs = snippet.chars().peekable();
    while let Some(sign) = signs.next() {
        match sign {
            '\\' => out.extend(signs.next()),
            '$' => {
                let braces = signs.next_if_eq(&'{').is_some();
                while signs.next_if(char::is_ascii_digit).is_some() {}
                let _ = signs.next_if(|sign| braces && *sign == ':');
                // What stands there at first goes up to the brace.
                while let Some(sign) = signs.next_if(|_| braces) {
                    match sign {
                        '}' => break,
                        '\\' => out.extend(signs.next()),
                        sign => out.push(sign),
                    }
                }
            }
            sign => out.push(sign),
        }
    }
    out
}

fn completion(documents: &Documents, params: CompletionParams) -> Option<CompletionResponse> {
    // What is offered makes the first words of a scene, too.
    let place = params.text_document_position;
    let document = documents.get(&place.text_document.uri)?;
    let byte = document.lines.byte(&document.text, place.position);
    if !document.is_scene && !kin::may_become_scene(&document.text, document.syntax, byte) {
        return None;
    }
    let found = analysis::complete(&document.text, document.syntax, byte);
    let range = document.lines.range(&document.text, found.range.clone());
    let format = if documents.client.snippets { InsertTextFormat::SNIPPET } else { InsertTextFormat::PLAIN_TEXT };
    let mut items: Vec<CompletionItem> = found
        .items
        .into_iter()
        .enumerate()
        .map(|(k, item)| CompletionItem {
            kind: Some(match item.kind {
                CompletionKind::Field => CompletionItemKind::FIELD,
                CompletionKind::Kind => CompletionItemKind::CLASS,
                CompletionKind::Name => CompletionItemKind::VARIABLE,
                CompletionKind::Value => CompletionItemKind::VALUE,
                CompletionKind::Function => CompletionItemKind::FUNCTION,
            }),
            detail: (!item.detail.is_empty()).then_some(item.detail),
            documentation: (!item.documentation.is_empty())
                .then(|| Documentation::MarkupContent(markdown(item.documentation))),
            // Ours is the order that they have in the language.
            sort_text: Some(format!("{k:04}")),
            insert_text_format: Some(format),
            text_edit: Some(CompletionTextEdit::Edit(TextEdit {
                range,
                new_text: if documents.client.snippets { item.snippet } else { plain(&item.snippet) },
            })),
            label: item.label,
            ..CompletionItem::default()
        })
        .collect();
    if let Some((kind, begun)) = found.files {
        items.extend(files(document.folder(), kind, &begun).into_iter().map(|(name, is_folder)| CompletionItem {
            kind: Some(if is_folder { CompletionItemKind::FOLDER } else { CompletionItemKind::FILE }),
            text_edit: Some(CompletionTextEdit::Edit(TextEdit { range, new_text: name.clone() })),
            label: name,
            ..CompletionItem::default()
        }));
    }
    Some(CompletionResponse::Array(items))
}

/// So many names of a folder are offered.
const MOST_FILES: usize = 1000;

/// The files of a kind and the folders where a name has been begun, as they would be written; and which are folders.
fn files(folder: &Path, kind: FileKind, begun: &str) -> Vec<(String, bool)> {
    let inner = begun.rfind('/').map_or("", |end| &begun[..=end]);
    let Ok(entries) = std::fs::read_dir(folder.join(inner)) else { return Vec::new() };
    let mut names: Vec<(String, bool)> = entries
        .take(MOST_FILES)
        .filter_map(|entry| {
            let entry = entry.ok()?;
            let name = entry.file_name().into_string().ok()?;
            let is_folder = entry.path().is_dir();
            let fits = is_folder || is_kind(Path::new(&name), kind);
            let shown = !name.starts_with('.') && fits;
            shown.then(|| (format!("{inner}{name}{}", if is_folder { "/" } else { "" }), is_folder))
        })
        .collect();
    names.sort();
    names
}

fn is_kind(path: &Path, kind: FileKind) -> bool {
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_lowercase()).unwrap_or_default();
    match kind {
        FileKind::Mesh => tracer_core::mesh::MeshFormat::of(path).is_some(),
        FileKind::Scene => matches!(extension.as_str(), "ron" | "toml" | "json"),
        FileKind::Placements => matches!(extension.as_str(), "txt" | "csv" | "dat"),
        FileKind::Texture | FileKind::Environment | FileKind::Heights => {
            matches!(extension.as_str(), "hdr" | "exr" | "png" | "jpg" | "jpeg")
        }
    }
}

fn hover(documents: &Documents, params: HoverParams) -> Option<Hover> {
    let (document, byte) = at(documents, &params.text_document_position_params)?;
    // What an included file gives is told as it is told there.
    let included = across::definition(documents, document, byte).and_then(|(other, place)| {
        let found = analysis::hover(&other.text, other.syntax, place.start)?;
        let range = analysis::name_at(&document.text, document.syntax, byte)?;
        Some(analysis::Hover { range, ..found })
    });
    let found = included.or_else(|| analysis::hover(&document.text, document.syntax, byte))?;
    let range = Some(document.lines.range(&document.text, found.range));
    Some(Hover { contents: HoverContents::Markup(markdown(found.markdown)), range })
}

fn definition(documents: &Documents, params: GotoDefinitionParams) -> Option<GotoDefinitionResponse> {
    let (document, byte) = at(documents, &params.text_document_position_params)?;
    if let Some(found) = analysis::definition(&document.text, document.syntax, byte) {
        let range = document.lines.range(&document.text, found);
        return Some(GotoDefinitionResponse::Scalar(Location { uri: document.uri.clone(), range }));
    }
    if let Some((other, place)) = across::definition(documents, document, byte) {
        return Some(GotoDefinitionResponse::Scalar(across::location(documents, &other, place)));
    }
    let (_, name) = analysis::file_at(&document.text, document.syntax, byte)?;
    // The beginning of a file that is there.
    let path = document.path.is_some().then(|| document.folder().join(name)).filter(|path| path.is_file())?;
    Some(GotoDefinitionResponse::Scalar(Location { uri: uri_of(&path)?, range: Range::default() }))
}

fn occurrences(document: &Document, byte: usize) -> Vec<Range> {
    let found = analysis::occurrences(&document.text, document.syntax, byte);
    found.into_iter().map(|range| document.lines.range(&document.text, range)).collect()
}

fn references(documents: &Documents, params: ReferenceParams) -> Option<Vec<Location>> {
    let (document, byte) = at(documents, &params.text_document_position)?;
    let uri = &document.uri;
    Some(occurrences(document, byte).into_iter().map(|range| Location { uri: uri.clone(), range }).collect())
}

fn highlights(documents: &Documents, params: DocumentHighlightParams) -> Option<Vec<DocumentHighlight>> {
    let (document, byte) = at(documents, &params.text_document_position_params)?;
    Some(occurrences(document, byte).into_iter().map(|range| DocumentHighlight { range, kind: None }).collect())
}

fn prepare_rename(documents: &Documents, params: TextDocumentPositionParams) -> Option<PrepareRenameResponse> {
    let (document, byte) = at(documents, &params)?;
    let name = analysis::name_at(&document.text, document.syntax, byte)?;
    Some(PrepareRenameResponse::Range(document.lines.range(&document.text, name)))
}

fn rename(documents: &Documents, params: RenameParams) -> Result<WorkspaceEdit, String> {
    let Some((document, byte)) = at(documents, &params.text_document_position) else {
        return Err("this is no scene, or it is not open".to_owned());
    };
    let edits = analysis::rename(&document.text, document.syntax, byte, &params.new_name)?;
    let mut changed = in_document(document, edits.iter().map(|edit| diagnostics::edit(document, edit)).collect());
    // Those that include it use the name, too.
    if let Some(given) = analysis::given_at(&document.text, document.syntax, byte) {
        let elsewhere = across::renamed(documents, document, &given, &params.new_name)?;
        changed.changes.get_or_insert_default().extend(elsewhere);
    }
    Ok(changed)
}

// The protocol's own type; an address is compared by its text.
#[allow(clippy::mutable_key_type)]
fn in_document(document: &Document, edits: Vec<TextEdit>) -> WorkspaceEdit {
    let changes: HashMap<Uri, Vec<TextEdit>> = HashMap::from([(document.uri.clone(), edits)]);
    WorkspaceEdit { changes: Some(changes), ..WorkspaceEdit::default() }
}

fn symbols(documents: &Documents, params: DocumentSymbolParams) -> Option<DocumentSymbolResponse> {
    let document = documents.scene(&params.text_document.uri)?;
    let outline = analysis::symbols(&document.text, document.syntax);
    Some(DocumentSymbolResponse::Nested(outline.into_iter().map(|symbol| in_outline(document, symbol)).collect()))
}

fn in_outline(document: &Document, symbol: Symbol) -> DocumentSymbol {
    let children: Vec<_> = symbol.children.into_iter().map(|child| in_outline(document, child)).collect();
    #[allow(deprecated)] // A field of the protocol that nobody may leave out here.
    DocumentSymbol {
        name: symbol.name,
        detail: (!symbol.detail.is_empty()).then_some(symbol.detail),
        kind: match symbol.kind {
            analysis::SymbolKind::Section => SymbolKind::NAMESPACE,
            analysis::SymbolKind::Named => SymbolKind::VARIABLE,
            analysis::SymbolKind::Item => SymbolKind::OBJECT,
        },
        tags: None,
        deprecated: None,
        range: document.lines.range(&document.text, symbol.range),
        selection_range: document.lines.range(&document.text, symbol.head),
        children: (!children.is_empty()).then_some(children),
    }
}

/// sRGB from linear light, as editors' colours are, and back.
fn encoded(x: f64) -> f32 {
    let x = x.clamp(0.0, 1.0);
    (if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }) as f32
}

fn decoded(x: f32) -> f64 {
    let x = f64::from(x).clamp(0.0, 1.0);
    if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
}

fn colors(documents: &Documents, params: DocumentColorParams) -> Option<Vec<ColorInformation>> {
    let document = documents.scene(&params.text_document.uri)?;
    let found = analysis::colors(&document.text, document.syntax);
    let swatch = |place: analysis::ColorPlace| {
        let [red, green, blue] = place.linear.map(encoded);
        let range = document.lines.range(&document.text, place.range);
        ColorInformation { range, color: Color { red, green, blue, alpha: 1.0 } }
    };
    Some(found.into_iter().map(swatch).collect())
}

fn presentations(documents: &Documents, params: ColorPresentationParams) -> Option<Vec<ColorPresentation>> {
    let document = documents.scene(&params.text_document.uri)?;
    let Color { red, green, blue, .. } = params.color;
    let texts = analysis::color_texts([red, green, blue].map(decoded), document.syntax);
    let written = |text: String| ColorPresentation {
        text_edit: Some(TextEdit { range: params.range, new_text: text.clone() }),
        label: text,
        additional_text_edits: None,
    };
    Some(texts.into_iter().map(written).collect())
}

fn actions(documents: &Documents, params: CodeActionParams) -> Option<Vec<CodeActionOrCommand>> {
    let document = documents.scene(&params.text_document.uri)?;
    let overlaps = |range: &Range| range.start <= params.range.end && params.range.start <= range.end;
    let mut tried = diagnostics::Tried::of(document);
    let mut actions = Vec::new();
    // What is marked is what was told.
    for fault in document.faults.iter() {
        if fault.code == codes::UNKNOWN_MATERIAL && fault.span.source == 0 {
            actions.extend(
                material_added(document, fault).filter(|_| overlaps(&diagnostics::range(document, fault.span))),
            );
        }
        let Some(mends) = fault.edit.as_ref().filter(|edit| edit.span.source == 0) else { continue };
        let range = diagnostics::range(document, fault.span);
        let edit = diagnostics::edit(document, mends);
        if !overlaps(&range) && !overlaps(&edit.range) {
            continue;
        }
        let title = match edit.new_text.trim() {
            "" => "Leave it out".to_owned(),
            text => format!("Write {}", text.chars().take(60).collect::<String>()),
        };
        actions.push(CodeActionOrCommand::CodeAction(CodeAction {
            title,
            kind: Some(CodeActionKind::QUICKFIX),
            diagnostics: Some(diagnostics::translated(document, std::slice::from_ref(fault))),
            edit: Some(in_document(document, vec![edit])),
            is_preferred: tried.is_better(mends).then_some(true),
            ..CodeAction::default()
        }));
    }
    Some(actions)
}

/// A material of the name that there is none of.
fn material_added(document: &Document, fault: &Diagnostic) -> Option<CodeActionOrCommand> {
    let name = &analysis::name_meant(&document.text, document.syntax, fault.span.start as usize + 1)?;
    let added = analysis::material_to_add(&document.text, document.syntax, name)?;
    Some(CodeActionOrCommand::CodeAction(CodeAction {
        title: format!("Add a material \"{name}\""),
        kind: Some(CodeActionKind::QUICKFIX),
        diagnostics: Some(diagnostics::translated(document, std::slice::from_ref(fault))),
        edit: Some(in_document(document, vec![diagnostics::edit(document, &added)])),
        ..CodeAction::default()
    }))
}

/// The first error of a scene in words.
fn first_of(error: &LoadError) -> String {
    let LoadError::Invalid { diagnostics, .. } = error else { return error.to_string() };
    let first = diagnostics.iter().find(|fault| fault.severity == Severity::Error);
    first.map_or_else(|| error.to_string(), |fault| fault.message.clone())
}

/// Nothing of what is no scene.
///
/// # Errors
/// The scene is wrong: nobody could say what to write.
fn formatting(documents: &Documents, params: DocumentFormattingParams) -> Result<Option<Vec<TextEdit>>, String> {
    let Some(document) = documents.scene(&params.text_document.uri) else { return Ok(None) };
    let tidy = scene_format::format(&document.name(), &document.text, document.syntax)
        .map_err(|error| format!("a scene with errors is not laid out: {}", first_of(&error)))?;
    if *tidy == *document.text {
        return Ok(Some(Vec::new()));
    }
    let range = document.lines.range(&document.text, 0..document.text.len());
    Ok(Some(vec![TextEdit { range, new_text: tidy }]))
}

#[cfg(test)]
mod tests {
    #[test]
    fn snippets_without_their_signs() {
        for (snippet, plain) in [
            ("Sphere(center: ($1), radius: $2)", "Sphere(center: (), radius: )"),
            ("fov: ${1:40}, up: ${12:(0, 1, 0)}$0", "fov: 40, up: (0, 1, 0)"),
            ("\"a\\$0b\\}\\\\\"", "\"a$0b}\\\""),
            ("{ ${1:a\\}b} }", "{ a}b }"),
        ] {
            assert_eq!(super::plain(snippet), plain);
        }
    }
}
