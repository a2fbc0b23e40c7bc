//! Opening places in the editor.

use super::refused;
use crate::shared::Shared;
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;

#[derive(Deserialize)]
pub struct Asked {
    /// Which of the diagnostics.
    told: usize,
    /// The version of the state that it was read in.
    version: u64,
}

/// Opens the place of a diagnostic in the editor: only places that were told of can be.
pub fn answer(shared: &Shared, asked: &Asked) -> Response {
    let Some(editor) = &shared.options.editor else {
        return refused(
            StatusCode::CONFLICT,
            "no editor is known; start the preview with --editor, as in --editor code",
        );
    };
    let place = {
        let state = shared.state();
        // A later version may only have gone on with the picture.
        let told = if asked.version <= state.version { state.told.get(asked.told) } else { None };
        told.and_then(|told| told.place.clone())
    };
    let Some(place) = place else { return refused(StatusCode::NOT_FOUND, "there is no such place any more") };
    match editor.open(&place.path, place.line, place.column) {
        Ok(()) => StatusCode::NO_CONTENT.into_response(),
        Err(why) => refused(StatusCode::INTERNAL_SERVER_ERROR, &why),
    }
}
