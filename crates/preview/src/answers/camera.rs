//! The camera: moved by the page, and written into the scene's file.

use super::{App, Refusal, aside, refused};
use crate::camera::{self, Refused};
use crate::shared::{Pose, Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use std::sync::Arc;

#[derive(Deserialize)]
pub struct Asked {
    /// Where the camera is to be; null: where the file has it.
    pose: Option<Pose>,
}

/// Moves the camera, not in the file.
pub fn moved(shared: &Shared, asked: &Asked) -> Response {
    if let Some(pose) = &asked.pose
        && let Err(why) = camera::check(pose)
    {
        return refused(StatusCode::BAD_REQUEST, why);
    }
    shared.order(|orders| orders.pose = Some(asked.pose));
    StatusCode::NO_CONTENT.into_response()
}

/// Writes the camera as it is into the scene's file.
pub async fn write(app: &Arc<App>) -> Response {
    let app = Arc::clone(app);
    aside(move || match camera::write(&app.shared, &app.undo, None).map_err(told) {
        Ok(fields) => axum::Json(serde_json::json!({ "edits": fields })).into_response(),
        Err((status, why)) => refused(status, &why),
    })
    .await
}

/// Puts back what stood in the file before the camera was written.
pub async fn undo(app: &Arc<App>) -> Response {
    let app = Arc::clone(app);
    aside(move || match camera::undo(&app.shared, &app.undo).map_err(told) {
        Ok(()) => StatusCode::NO_CONTENT.into_response(),
        Err((status, why)) => refused(status, &why),
    })
    .await
}

fn told(refused: Refused) -> Refusal {
    match refused {
        Refused::Now(why) => (StatusCode::CONFLICT, why),
        Refused::Unwritten(why) => (StatusCode::INTERNAL_SERVER_ERROR, why),
    }
}
