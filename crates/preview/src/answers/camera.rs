//! The camera: moved by the page, and written into the scene's file.

use super::{App, Refusal, aside, refused};
use crate::camera::{self, Outcome, Refused};
use crate::shared::{Pose, Shared};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use scene_format::Viewpoint;
use serde::Deserialize;
use std::sync::Arc;

#[derive(Deserialize)]
pub struct Asked {
    /// Where the camera is to be; null: where the file has it.
    pose: Option<Pose>,
    /// The file's camera as the page had it, which the pose was made of: only what is another counts. Left out: that of
    /// now.
    from: Option<Pose>,
}

/// Moves the camera, not in the file.
pub fn moved(shared: &Shared, asked: &Asked) -> Response {
    match &asked.pose {
        None => shared.move_camera(Viewpoint::default()),
        Some(pose) => {
            if let Err(why) = camera::moved(shared, pose, asked.from.as_ref()) {
                return refused(StatusCode::BAD_REQUEST, &why);
            }
        }
    }
    StatusCode::NO_CONTENT.into_response()
}

/// Writes what was changed of the camera into the scene's file.
pub async fn write(app: &Arc<App>) -> Response {
    let app = Arc::clone(app);
    aside(move || match camera::write(&app.shared, &app.undo).map_err(told) {
        Ok(Outcome { edits, expressions: 0 }) => axum::Json(serde_json::json!({ "edits": edits })).into_response(),
        Ok(Outcome { edits, expressions }) => {
            axum::Json(serde_json::json!({ "edits": edits, "expressions": expressions })).into_response()
        }
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
