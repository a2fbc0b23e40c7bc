//! The pixel inspector's answer.

use super::{App, aside, refused};
use crate::pixel;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use std::sync::Arc;

#[derive(Deserialize)]
pub struct Asked {
    x: u32,
    y: u32,
    /// Opens the line of the object that is seen there.
    #[serde(default)]
    open: bool,
}

/// What a pixel is.
pub async fn answer(app: &Arc<App>, asked: Asked) -> Response {
    let (frame, stage) = {
        let state = app.shared.state();
        (state.frame.clone(), state.stage.clone())
    };
    let (Some(frame), Some(stage)) = (frame, stage) else {
        return refused(StatusCode::CONFLICT, "there is no picture yet");
    };
    let shared = Arc::clone(&app.shared);
    aside(move || {
        let Some(pixel) = pixel::at(&stage, &frame, [asked.x, asked.y], &shared.options.scene) else {
            return refused(StatusCode::BAD_REQUEST, "the picture has no such pixel");
        };
        if asked.open
            && let Some(place) = pixel.object.as_ref().and_then(|object| object.place.as_ref())
        {
            let Some(editor) = &shared.options.editor else {
                return refused(StatusCode::CONFLICT, "no editor is known; start the preview with --editor");
            };
            if let Err(why) = editor.open(&place.path, place.line, place.column) {
                return refused(StatusCode::INTERNAL_SERVER_ERROR, &why);
            }
        }
        axum::Json(pixel).into_response()
    })
    .await
}
