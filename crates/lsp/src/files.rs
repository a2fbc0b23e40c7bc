//! Looking at the files that scenes name, by a thread of its own: a mesh of a million triangles must not keep an editor
//! waiting.

use crate::diagnostics;
use crate::documents::Document;
use crate::voice::Voice;
use lsp_types::notification::{Notification as _, PublishDiagnostics};
use lsp_types::{PublishDiagnosticsParams, Uri};
use std::collections::HashMap;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// The newest version of each open document.
type Versions = Arc<Mutex<HashMap<String, i32>>>;

/// The thread that looks.
pub struct Looker {
    documents: Sender<Document>,
    newest: Versions,
}

impl Looker {
    /// Starts it; it tells the editor what it finds. It ends when nobody can ask any more.
    pub fn start(voice: Voice) -> Self {
        let (documents, received) = channel();
        let newest = Versions::default();
        let versions = Arc::clone(&newest);
        std::thread::spawn(move || look(&received, &versions, &voice));
        Looker { documents, newest }
    }

    /// Has it look at a document as it is now.
    pub fn look(&self, document: Document) {
        // Where nobody looks any more, the editor is gone.
        let _ = self.documents.send(document);
    }

    /// A document has changed, or is closed: what is found of older versions is of no use.
    pub fn changed(&self, uri: &Uri, version: Option<i32>) {
        let mut newest = lock(&self.newest);
        match version {
            Some(version) => newest.insert(uri.as_str().to_owned(), version),
            None => newest.remove(uri.as_str()),
        };
    }
}

fn lock(versions: &Versions) -> MutexGuard<'_, HashMap<String, i32>> {
    versions.lock().unwrap_or_else(PoisonError::into_inner)
}

fn look(received: &Receiver<Document>, newest: &Versions, voice: &Voice) {
    while let Ok(document) = received.recv() {
        let is_newest = || lock(newest).get(document.uri.as_str()) == Some(&document.version);
        if !is_newest() {
            continue;
        }
        let found = diagnostics::with_files(&document);
        let params = PublishDiagnosticsParams {
            uri: document.uri.clone(),
            diagnostics: diagnostics::translated(&document, &found),
            version: Some(document.version),
        };
        if is_newest() && voice.tell(PublishDiagnostics::METHOD, &params).is_err() {
            return;
        }
    }
}
