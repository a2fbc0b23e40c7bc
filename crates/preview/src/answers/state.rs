//! The state of things, as soon as it is another than the page has.

use super::App;
use super::picture::{layer_names, tone_name};
use crate::shared::{Phase, Pose, State, lock};
use crate::told::Told;
use axum::response::{IntoResponse, Response};
use scene_format::SceneDesc;
use serde::{Deserialize, Serialize};
use std::future::pending;
use std::sync::atomic::Ordering;
use std::time::Duration;

/// A page waits so long for news before it asks again.
const PATIENCE: Duration = Duration::from_secs(20);
/// While something is rendered there is news so often.
const TICK: Duration = Duration::from_millis(200);

#[derive(Deserialize)]
pub struct Asked {
    /// The version that the page has.
    #[serde(default)]
    after: u64,
}

/// The state as JSON, as soon as it is another than the page has.
pub async fn answer(app: &App, asked: Asked) -> Response {
    let shared = &app.shared;
    let mut versions = shared.versions();
    let rendering = {
        let state = shared.state();
        if state.version != asked.after {
            return axum::Json(Shown::of(&state, app)).into_response();
        }
        state.phase == Phase::Rendering
    };
    let news = async {
        while *versions.borrow_and_update() == asked.after {
            if versions.changed().await.is_err() {
                pending::<()>().await;
            }
        }
    };
    // That there is none is an answer, too: samples go on.
    let _ = tokio::time::timeout(if rendering { TICK } else { PATIENCE }, news).await;
    axum::Json(Shown::of(&shared.state(), app)).into_response()
}

/// The state, as the page gets it.
#[derive(Serialize)]
struct Shown<'s> {
    version: u64,
    /// The scene file's name.
    name: String,
    phase: Phase,
    told: &'s [Told],
    /// Whether places can be opened.
    editor: bool,
    frame: Option<ShownFrame>,
    samples_done: u64,
    samples_total: u64,
    asked: u32,
    seconds: f64,
    look: Option<ShownLook>,
    /// The camera of the picture, and as the file had it then.
    camera: Option<Pose>,
    written: Option<Pose>,
    /// Whether something was changed of it that is not in the file.
    moved: bool,
    /// What the picture's height shows at a distance of one, where things become smaller with distance.
    seen: Option<f64>,
    /// Samples that were there when the rendering began.
    samples_begun: u64,
    /// Whether a camera that was written can be taken back.
    undo: bool,
    /// Layers that can be shown.
    layers: Vec<&'static str>,
}

#[derive(Serialize)]
struct ShownFrame {
    number: u64,
    stage: u64,
    draft: bool,
    size: [u32; 2],
    samples: u32,
    noise: Option<f64>,
    /// Pixels that bear nearly all of it, where they are few, and the noise of the others.
    few: Option<(usize, f64)>,
}

#[derive(Serialize)]
struct ShownLook {
    exposure: f64,
    tone: &'static str,
}

impl<'s> Shown<'s> {
    fn of(state: &'s State, app: &App) -> Self {
        let shared = &app.shared;
        let noise = |frame: u64| state.noise.filter(|noise| noise.frame == frame && noise.relative > 0.0);
        let frame = state.frame.as_deref().map(|frame| ShownFrame {
            number: frame.number,
            stage: frame.stage,
            draft: frame.draft,
            size: frame.size,
            samples: frame.samples,
            noise: noise(frame.number).map(|noise| noise.relative),
            few: noise(frame.number).and_then(|noise| noise.few).map(|few| (few.pixels, few.rest)),
        });
        let look = state.stage.as_ref().map(|stage| stage.scene.look);
        Shown {
            version: state.version,
            name: shared.options.scene.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            phase: state.phase,
            told: &state.told,
            editor: shared.options.editor.is_some(),
            frame,
            samples_done: shared.done.load(Ordering::Relaxed),
            samples_total: shared.total.load(Ordering::Relaxed),
            asked: state.asked,
            seconds: state.seconds(),
            look: look.map(|look| ShownLook { exposure: look.exposure, tone: tone_name(look.tone_map) }),
            camera: state.stage.as_ref().map(|stage| Pose::of(&stage.desc)),
            written: state.stage.as_ref().map(|stage| stage.written),
            moved: !state.moves.is_empty(),
            seen: state.stage.as_ref().map(|stage| seen(&stage.desc)),
            samples_begun: state.begun,
            undo: lock(&app.undo).is_some(),
            layers: layer_names().collect(),
        }
    }
}

/// What the picture's height shows at a distance of one.
fn seen(desc: &SceneDesc) -> f64 {
    let size = [desc.image.width.value, desc.image.height.value].map(f64::from);
    let [half_height, _] = desc.camera.half_extents(desc.camera.size_for_one_eye(size));
    2.0 * half_height
}
