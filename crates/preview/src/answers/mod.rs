//! What the page asks for, an answer a file.

pub mod camera;
pub mod open;
pub mod picture;
pub mod pixel;
pub mod state;

use crate::camera::Undo;
use crate::guard::Guard;
use crate::layers::LastLayer;
use crate::shared::Shared;
use axum::body::Body;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use picture::Pins;
use serde::Deserialize;
use std::sync::{Arc, Mutex};

/// Requests bring no more than this.
const LARGEST_REQUEST: usize = 4096;

/// What answers are made of.
pub struct App {
    pub shared: Arc<Shared>,
    pub guard: Guard,
    pub pins: Mutex<Pins>,
    pub undo: Mutex<Undo>,
    pub layer: LastLayer,
}

impl App {
    pub fn new(shared: Arc<Shared>, guard: Guard) -> Self {
        App { shared, guard, pins: Mutex::default(), undo: Mutex::default(), layer: LastLayer::default() }
    }
}

/// Why a request is refused, in words for the person.
pub type Refusal = (StatusCode, String);

/// A refusal as an answer.
pub fn refused(status: StatusCode, why: &str) -> Response {
    (status, [(header::CONTENT_TYPE, "text/plain; charset=utf-8")], why.to_owned()).into_response()
}

/// What a request brings, as JSON.
pub async fn read<T: for<'de> Deserialize<'de>>(headers: &HeaderMap, body: Body) -> Result<T, Refusal> {
    // Forms of other sites' pages cannot send this kind.
    let is_json = headers.get(header::CONTENT_TYPE).is_some_and(|kind| kind == "application/json");
    if !is_json {
        return Err((StatusCode::UNSUPPORTED_MEDIA_TYPE, "expected JSON".to_owned()));
    }
    let bytes = axum::body::to_bytes(body, LARGEST_REQUEST)
        .await
        .map_err(|_| (StatusCode::PAYLOAD_TOO_LARGE, "too large".to_owned()))?;
    serde_json::from_slice(&bytes).map_err(|error| (StatusCode::BAD_REQUEST, error.to_string()))
}

/// Does what takes a while on a thread of its own.
pub async fn aside(work: impl FnOnce() -> Response + Send + 'static) -> Response {
    let done = tokio::task::spawn_blocking(work).await;
    done.unwrap_or_else(|_| {
        refused(StatusCode::INTERNAL_SERVER_ERROR, "tracer failed on this, which is a fault of tracer")
    })
}
