//! What is said to the editor: texts of JSON, written in one go.
//!
//! In the tree of values that `lsp-server` sends every place of a long answer is three maps with keys of their own,
//! which takes much longer than to write them.

use crate::Error;
use lsp_server::{Message, RequestId, ResponseError};
use serde::Serialize;
use serde_json::json;
use std::sync::Arc;

/// Takes a message as text.
type Say = dyn Fn(String) -> Result<(), Error> + Send + Sync;

/// The way to the editor.
#[derive(Clone)]
pub struct Voice(Arc<Say>);

impl Voice {
    /// What is said is given to `say`, which fails where nobody is there any more.
    pub fn new(say: impl Fn(String) -> Result<(), Error> + Send + Sync + 'static) -> Self {
        Voice(Arc::new(say))
    }

    /// Whoever takes messages as values.
    pub fn of_values(send: impl Fn(Message) -> Result<(), Error> + Send + Sync + 'static) -> Self {
        Voice::new(move |text| send(serde_json::from_str(&text)?))
    }

    /// Answers a request; `result` is JSON.
    ///
    /// # Errors
    /// Nobody is there any more.
    pub fn answer(&self, id: &RequestId, result: &str) -> Result<(), Error> {
        let id = serde_json::to_string(id)?;
        (self.0)(format!(r#"{{"jsonrpc":"2.0","id":{id},"result":{result}}}"#))
    }

    /// Answers a request by what is wrong with it.
    ///
    /// # Errors
    /// As [`Voice::answer`].
    pub fn refuse(&self, id: &RequestId, code: i32, message: String) -> Result<(), Error> {
        let error = ResponseError { code, message, data: None };
        (self.0)(json!({ "jsonrpc": "2.0", "id": id, "error": error }).to_string())
    }

    /// Tells something that nobody has asked for.
    ///
    /// # Errors
    /// As [`Voice::answer`].
    pub fn tell(&self, method: &str, params: &impl Serialize) -> Result<(), Error> {
        let params = serde_json::to_string(params)?;
        (self.0)(format!(r#"{{"jsonrpc":"2.0","method":"{method}","params":{params}}}"#))
    }
}
