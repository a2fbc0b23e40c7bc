//! Pictures: for the page's canvas, and as files.

use super::{App, Refusal, aside, refused};
use crate::layers;
use crate::options::Kind;
use crate::picture::{developed, look};
use crate::shared::{Frame, lock};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use scene_format::desc::ToneMap;
use serde::Deserialize;
use std::sync::Arc;
use tracer_core::{Layer, LayerSet, Look};

/// The tone maps, as the page names them.
const TONES: [(&str, ToneMap); 3] = [("none", ToneMap::None), ("filmic", ToneMap::Filmic), ("agx", ToneMap::AgX)];

pub fn tone_name(tone: ToneMap) -> &'static str {
    TONES.iter().find(|(_, map)| *map == tone).map_or("", |(name, _)| name)
}

/// How a page wants a picture developed; what it does not say is the scene's.
#[derive(Deserialize)]
struct AskedLook {
    exposure: Option<f64>,
    tone: Option<String>,
}

impl AskedLook {
    fn look(&self, scene: Look) -> Result<Look, Refusal> {
        let wrong = |why: &str| Err((StatusCode::BAD_REQUEST, why.to_owned()));
        let exposure = self.exposure.unwrap_or(scene.exposure);
        if exposure.is_nan() || exposure.abs() > 64.0 {
            return wrong("the exposure is from -64 to 64 stops");
        }
        let tone_map = match &self.tone {
            None => scene.tone_map,
            Some(name) => match TONES.iter().find(|(known, _)| known == name) {
                Some((_, tone_map)) => *tone_map,
                None => return wrong("there is no such tone map"),
            },
        };
        Ok(Look { exposure, tone_map, ..scene })
    }
}

/// States that were pinned, to be held against later ones: the last few.
#[derive(Default)]
pub struct Pins {
    next: u64,
    kept: Vec<(u64, Arc<Frame>)>,
}

/// A pinned state takes as much memory as a picture that is rendered.
const MOST_PINS: usize = 3;

impl Pins {
    fn add(&mut self, frame: Arc<Frame>) -> u64 {
        self.next += 1;
        if self.kept.len() >= MOST_PINS {
            self.kept.remove(0);
        }
        self.kept.push((self.next, frame));
        self.next
    }

    fn get(&self, pin: u64) -> Option<Arc<Frame>> {
        self.kept.iter().find(|(number, _)| *number == pin).map(|(_, frame)| Arc::clone(frame))
    }
}

/// Keeps the picture as it is.
pub fn pin(app: &App) -> Response {
    match app.shared.state().frame.clone() {
        Some(frame) if !frame.draft => {
            let pin = lock(&app.pins).add(frame);
            axum::Json(serde_json::json!({ "pin": pin })).into_response()
        }
        _ => refused(StatusCode::CONFLICT, "there is no picture yet; wait a moment"),
    }
}

/// What the picture's noise is called among the layers.
const NOISE: &str = "noise";

/// The layers that the page offers.
pub fn layer_names() -> impl Iterator<Item = &'static str> {
    // What the variance of a few samples is tells nothing; that of the picture is its noise. To count what rays ask of
    // the tree takes too long while somebody waits.
    let left_out = |layer: &Layer| matches!(layer, Layer::Variance | Layer::Noise | Layer::Nodes | Layer::Leaves);
    let shown = LayerSet::all().iter().filter(|layer| !left_out(layer));
    shown.collect::<LayerSet>().names().chain([NOISE]).collect::<Vec<_>>().into_iter()
}

/// Which picture, and how.
#[derive(Deserialize)]
pub struct AskedFrame {
    exposure: Option<f64>,
    tone: Option<String>,
    /// A layer in its place.
    layer: Option<String>,
    /// A state that was pinned in its place.
    pin: Option<u64>,
}

/// The picture as it is now, as bytes for a canvas.
pub async fn frame(app: &Arc<App>, asked: AskedFrame) -> Response {
    let (frame, stage) = {
        let state = app.shared.state();
        (state.frame.clone(), state.stage.clone())
    };
    let frame = match asked.pin {
        None => frame,
        Some(pin) => match lock(&app.pins).get(pin) {
            Some(pinned) => Some(pinned),
            None => return refused(StatusCode::GONE, "that state is not kept any more; pin another one"),
        },
    };
    let Some(frame) = frame else { return refused(StatusCode::CONFLICT, "there is no picture yet") };
    let look = match (AskedLook { exposure: asked.exposure, tone: asked.tone }).look(look(stage.as_deref())) {
        Ok(look) => look,
        Err((status, why)) => return refused(status, &why),
    };
    let layer = match asked.layer.as_deref() {
        None => None,
        Some(NOISE) => Some(None),
        Some(name) => match LayerSet::by_name(name) {
            Some(layer) => Some(Some(layer)),
            None => return refused(StatusCode::BAD_REQUEST, "there is no such layer"),
        },
    };
    let app = Arc::clone(app);
    aside(move || {
        let (size, bytes) = match (layer, stage) {
            (None, _) => (frame.film.size(), developed(&frame.film, &look)),
            (Some(None), _) => (frame.film.size(), layers::colours(&layers::noise(&frame.film), look.exposure)),
            (Some(Some(layer)), Some(stage)) => {
                let film = app.layer.film(&app.shared, &stage, layer);
                let Some(image) = film.as_ref().and_then(|film| film.layer(layer)) else {
                    return refused(StatusCode::CONFLICT, "the picture is being made anew");
                };
                (stage.scene.size, layers::colours(&image, look.exposure))
            }
            (Some(Some(_)), None) => return refused(StatusCode::CONFLICT, "there is no picture yet"),
        };
        let headers = [
            ("content-type", "application/octet-stream".to_owned()),
            ("x-frame", frame.number.to_string()),
            ("x-size", format!("{}x{}", size[0], size[1])),
        ];
        (headers, bytes).into_response()
    })
    .await
}

#[derive(Deserialize)]
pub struct AskedFile {
    kind: String,
    exposure: Option<f64>,
    tone: Option<String>,
}

/// The picture as a file.
pub async fn save(app: &Arc<App>, asked: AskedFile) -> Response {
    let (kind, extension, media) = match asked.kind.as_str() {
        "png" => (Kind::Png, "png", "image/png"),
        "exr" => (Kind::Exr, "exr", "image/x-exr"),
        _ => return refused(StatusCode::BAD_REQUEST, "pictures are png or exr"),
    };
    let (frame, stage) = {
        let state = app.shared.state();
        (state.frame.clone(), state.stage.clone())
    };
    let (Some(frame), Some(stage)) = (frame.filter(|frame| !frame.draft), stage) else {
        return refused(StatusCode::CONFLICT, "there is no picture yet, but for a draft; wait a moment");
    };
    if frame.stage != stage.number {
        return refused(StatusCode::CONFLICT, "the picture is being made anew; wait a moment");
    }
    let look = match (AskedLook { exposure: asked.exposure, tone: asked.tone }).look(stage.scene.look) {
        Ok(look) => look,
        Err((status, why)) => return refused(status, &why),
    };
    let shared = Arc::clone(&app.shared);
    aside(move || {
        let bytes = match shared.host.encode(&stage.desc, &frame.film, &look, kind) {
            Ok(bytes) => bytes,
            Err(why) => return refused(StatusCode::INTERNAL_SERVER_ERROR, &why),
        };
        let stem = shared.options.scene.file_stem().unwrap_or_default().to_string_lossy();
        // What would end the name in a header, or is not to be read in all of them.
        let stem: String =
            stem.chars().map(|c| if c.is_ascii_alphanumeric() || "-_. ".contains(c) { c } else { '_' }).collect();
        let headers = [
            ("content-type", media.to_owned()),
            ("content-disposition", format!("attachment; filename=\"{stem}.{extension}\"")),
        ];
        (headers, bytes).into_response()
    })
    .await
}
