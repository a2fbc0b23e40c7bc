//! The language server of scenes: what an editor asks, answered by [`scene_format::analysis`] over the Language Server
//! Protocol 3.17.
//!
//! One thread reads and answers; looking at the files that a scene names, which may take long, is done by another one.
//! Documents are held whole, and are sent whole when they change: scenes are small texts, and answers come from the
//! newest one.
#![forbid(unsafe_code)]

mod across;
mod answers;
mod diagnostics;
mod documents;
mod files;
mod kin;
mod positions;
mod stdio;
mod voice;

use answers::Why;
use documents::{Client, Documents};
use lsp_server::{Connection, ErrorCode, Message, Notification, Request};
use lsp_types::notification::{
    DidChangeTextDocument, DidCloseTextDocument, DidOpenTextDocument, DidSaveTextDocument, Exit, Initialized,
    Notification as _, PublishDiagnostics,
};
use lsp_types::request::{Initialize, Request as _, Shutdown};
use lsp_types::{
    CodeActionKind, CodeActionOptions, CodeActionProviderCapability, ColorProviderCapability, CompletionOptions,
    DidChangeTextDocumentParams, DidCloseTextDocumentParams, DidOpenTextDocumentParams, DidSaveTextDocumentParams,
    HoverProviderCapability, InitializeParams, OneOf, PositionEncodingKind, PublishDiagnosticsParams, RenameOptions,
    ServerCapabilities, TextDocumentSyncCapability, TextDocumentSyncKind, TextDocumentSyncOptions,
    TextDocumentSyncSaveOptions, Uri, WorkDoneProgressOptions,
};
use positions::Encoding;
use serde_json::{Value, json};
use voice::Voice;

/// Any error of the connection.
type Error = Box<dyn std::error::Error + Send + Sync>;

/// Speaks over standard input and output until the editor says goodbye.
///
/// # Errors
/// The connection broke, or the other side does not speak the protocol.
pub fn serve_stdio() -> Result<(), Error> {
    let (connection, voice, threads) = stdio::connection();
    let served = converse(&connection, voice);
    // The writing thread ends when nobody can write any more. What was answered is written, whatever ended it.
    drop(connection);
    threads.join(served.is_ok())?;
    served
}

/// Serves one editor over a connection.
///
/// # Errors
/// As [`serve_stdio`].
pub fn serve(connection: &Connection) -> Result<(), Error> {
    let sender = connection.sender.clone();
    converse(connection, Voice::of_values(move |message| Ok(sender.send(message)?)))
}

/// Hears what comes over a connection until the editor says goodbye, and answers by a voice.
fn converse(connection: &Connection, voice: Voice) -> Result<(), Error> {
    let Some(client) = greeted(connection, &voice)? else { return Ok(()) };
    let mut documents = Documents::new(client);
    let looker = files::Looker::start(voice.clone());
    for message in &connection.receiver {
        match message {
            Message::Request(request) => {
                if request.method == Shutdown::METHOD {
                    voice.answer(&request.id, "null")?;
                    return until_exit(connection, &voice);
                }
                answer(&voice, &documents, request)?;
            }
            Message::Notification(notification) if notification.method == Exit::METHOD => {
                return Err("it ends without a shutdown".into());
            }
            Message::Notification(notification) => heard(&voice, &mut documents, &looker, notification)?,
            Message::Response(_) => {}
        }
    }
    Ok(())
}

/// Says what the server can do, and hears what columns count; `None` where nobody was there.
fn greeted(connection: &Connection, voice: &Voice) -> Result<Option<Client>, Error> {
    let (id, params) = loop {
        match connection.receiver.recv() {
            Ok(Message::Request(Request { id, method, params })) if method == Initialize::METHOD => break (id, params),
            Ok(Message::Request(Request { id, method, .. })) => {
                let why = format!("expected initialize first, got {method}");
                voice.refuse(&id, ErrorCode::ServerNotInitialized as i32, why)?;
            }
            Ok(Message::Notification(told)) if told.method == Exit::METHOD => {
                return Err("it ends without a beginning".into());
            }
            Ok(Message::Notification(_)) => {}
            Ok(Message::Response(_)) => return Err("expected initialize first, got an answer".into()),
            Err(_) => return Ok(None),
        }
    };
    let params: InitializeParams = match serde_json::from_value(params) {
        Ok(params) => params,
        Err(why) => {
            voice.refuse(&id, ErrorCode::InvalidParams as i32, why.to_string())?;
            return Err(why.into());
        }
    };
    let items = params.capabilities.text_document.and_then(|of| of.completion?.completion_item);
    let snippets = items.and_then(|items| items.snippet_support) == Some(true);
    let offered = params.capabilities.general.and_then(|general| general.position_encodings).unwrap_or_default();
    let encoding = if offered.contains(&PositionEncodingKind::UTF8) { Encoding::Utf8 } else { Encoding::Utf16 };
    let server = json!({ "name": "tracer", "version": env!("CARGO_PKG_VERSION") });
    let result: Value = json!({ "capabilities": capabilities(encoding), "serverInfo": server });
    voice.answer(&id, &result.to_string())?;
    match connection.receiver.recv() {
        Ok(Message::Notification(told)) if told.method == Initialized::METHOD => {
            Ok(Some(Client { encoding, snippets }))
        }
        Ok(_) => Err("expected initialized after initialize, got something else".into()),
        Err(_) => Err("the editor has gone before it was initialized".into()),
    }
}

/// After `shutdown` nothing is done any more, and `exit` ends it.
fn until_exit(connection: &Connection, voice: &Voice) -> Result<(), Error> {
    for message in &connection.receiver {
        match message {
            Message::Request(Request { id, .. }) => {
                voice.refuse(&id, ErrorCode::InvalidRequest as i32, "the server is shut down".to_owned())?;
            }
            Message::Notification(told) if told.method == Exit::METHOD => break,
            Message::Notification(_) | Message::Response(_) => {}
        }
    }
    Ok(())
}

/// What the server can do.
fn capabilities(encoding: Encoding) -> ServerCapabilities {
    let texts = TextDocumentSyncOptions {
        open_close: Some(true),
        change: Some(TextDocumentSyncKind::FULL),
        save: Some(TextDocumentSyncSaveOptions::Supported(true)),
        ..TextDocumentSyncOptions::default()
    };
    let triggers = ["(", "[", "{", "\"", "=", ":", ",", ".", "/", " "];
    ServerCapabilities {
        position_encoding: Some(encoding.kind()),
        text_document_sync: Some(TextDocumentSyncCapability::Options(texts)),
        completion_provider: Some(CompletionOptions {
            trigger_characters: Some(triggers.map(str::to_owned).to_vec()),
            ..CompletionOptions::default()
        }),
        hover_provider: Some(HoverProviderCapability::Simple(true)),
        definition_provider: Some(OneOf::Left(true)),
        references_provider: Some(OneOf::Left(true)),
        document_highlight_provider: Some(OneOf::Left(true)),
        rename_provider: Some(OneOf::Right(RenameOptions {
            prepare_provider: Some(true),
            work_done_progress_options: WorkDoneProgressOptions::default(),
        })),
        document_symbol_provider: Some(OneOf::Left(true)),
        document_formatting_provider: Some(OneOf::Left(true)),
        color_provider: Some(ColorProviderCapability::Simple(true)),
        code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
            code_action_kinds: Some(vec![CodeActionKind::QUICKFIX]),
            ..CodeActionOptions::default()
        })),
        ..ServerCapabilities::default()
    }
}

/// Answers a request. What nobody understands gets an error and ends nothing.
fn answer(voice: &Voice, documents: &Documents, request: Request) -> Result<(), Error> {
    let Request { id, method, params } = request;
    match answers::answer(documents, &method, params) {
        Some(Ok(result)) => voice.answer(&id, &result),
        Some(Err(Why::Params(why))) => voice.refuse(&id, ErrorCode::InvalidParams as i32, why),
        Some(Err(Why::Refused(why))) => voice.refuse(&id, ErrorCode::RequestFailed as i32, why),
        None => voice.refuse(&id, ErrorCode::MethodNotFound as i32, format!("{method} is not known here")),
    }
}

/// Takes what the editor tells.
fn heard(
    voice: &Voice,
    documents: &mut Documents,
    looker: &files::Looker,
    notification: Notification,
) -> Result<(), Error> {
    let Notification { method, params } = notification;
    match method.as_str() {
        DidOpenTextDocument::METHOD => {
            let Ok(params) = serde_json::from_value::<DidOpenTextDocumentParams>(params) else { return Ok(()) };
            let document = params.text_document;
            documents.put(document.uri.clone(), document.version, document.text);
            tell(voice, documents, looker, &document.uri, true)?;
        }
        DidChangeTextDocument::METHOD => {
            let Ok(params) = serde_json::from_value::<DidChangeTextDocumentParams>(params) else { return Ok(()) };
            let Some(text) = params.content_changes.into_iter().next_back().map(|change| change.text) else {
                return Ok(());
            };
            documents.put(params.text_document.uri.clone(), params.text_document.version, text);
            tell(voice, documents, looker, &params.text_document.uri, false)?;
        }
        DidSaveTextDocument::METHOD => {
            let Ok(params) = serde_json::from_value::<DidSaveTextDocumentParams>(params) else { return Ok(()) };
            tell(voice, documents, looker, &params.text_document.uri, true)?;
        }
        DidCloseTextDocument::METHOD => {
            let Ok(params) = serde_json::from_value::<DidCloseTextDocumentParams>(params) else { return Ok(()) };
            let uri = params.text_document.uri;
            documents.remove(&uri);
            looker.changed(&uri, None);
            publish(voice, &PublishDiagnosticsParams { uri, diagnostics: Vec::new(), version: None })?;
        }
        _ => {}
    }
    Ok(())
}

/// Tells what is wrong with a document; `files`: what it names is looked at, too, and told when that is done.
fn tell(voice: &Voice, documents: &mut Documents, looker: &files::Looker, uri: &Uri, files: bool) -> Result<(), Error> {
    let Some(document) = documents.get_mut(uri) else { return Ok(()) };
    looker.changed(uri, Some(document.version));
    document.faults = diagnostics::found(document).into();
    let diagnostics = diagnostics::translated(document, &document.faults);
    let version = Some(document.version);
    publish(voice, &PublishDiagnosticsParams { uri: uri.clone(), diagnostics, version })?;
    if files && document.is_scene {
        looker.look(document.clone());
    }
    Ok(())
}

fn publish(voice: &Voice, params: &PublishDiagnosticsParams) -> Result<(), Error> {
    voice.tell(PublishDiagnostics::METHOD, params)
}
