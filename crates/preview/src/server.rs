//! The server: one page, and what it asks for. Nothing else is read or given, whatever the address says.

use crate::guard::Guard;
use crate::options::{Host, Kind, Options};
use crate::shared::{Phase, Pose, Shared, State};
use crate::told::Told;
use crate::{picture, studio, watch};
use axum::Router;
use axum::body::Bytes;
use axum::extract::{DefaultBodyLimit, Query, Request, State as Extract};
use axum::http::{HeaderMap, HeaderName, HeaderValue, Method, StatusCode, header};
use axum::response::{IntoResponse, Response};
use scene_format::desc::ToneMap;
use serde::{Deserialize, Serialize};
use std::future::pending;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::sync::oneshot;
use tracer_core::Look;

/// A page waits so long for news before it asks again.
const PATIENCE: Duration = Duration::from_secs(20);
/// While something is rendered there is news so often.
const TICK: Duration = Duration::from_millis(200);
/// Requests bring no more than this.
const LARGEST_REQUEST: usize = 4096;

/// What the page consists of, and nothing else can be had.
const FILES: [(&str, &str, &str); 6] = [
    ("", "text/html; charset=utf-8", include_str!("page/index.html")),
    ("page.css", "text/css; charset=utf-8", include_str!("page/page.css")),
    ("main.js", SCRIPT, include_str!("page/main.js")),
    ("view.js", SCRIPT, include_str!("page/view.js")),
    ("net.js", SCRIPT, include_str!("page/net.js")),
    ("faults.js", SCRIPT, include_str!("page/faults.js")),
];
const SCRIPT: &str = "text/javascript; charset=utf-8";

/// The page may load from its own address and from nowhere else, and stands in no other page.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; \
     img-src 'self' blob: data:; \
     base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// Why a preview did not start.
#[derive(Debug)]
pub enum StartError {
    /// The address cannot be listened at.
    Listen {
        /// Address and port.
        at: SocketAddr,
        /// What the system says.
        source: std::io::Error,
    },
    /// The system gives no random numbers or threads.
    System(String),
}

impl std::fmt::Display for StartError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            StartError::Listen { at, source } if source.kind() == std::io::ErrorKind::AddrInUse => {
                write!(
                    f,
                    "port {} is taken by another program; name another one, or none for any that is free",
                    at.port()
                )
            }
            StartError::Listen { at, source } => write!(f, "cannot listen at {at}: {source}"),
            StartError::System(why) => f.write_str(why),
        }
    }
}

impl std::error::Error for StartError {}

/// A preview that runs. It ends when it is dropped.
pub struct Preview {
    shared: Arc<Shared>,
    at: SocketAddr,
    token: String,
    end: Option<oneshot::Sender<()>>,
    server: Option<JoinHandle<()>>,
    studio: Option<JoinHandle<()>>,
}

impl Preview {
    /// Starts one. The scene need not be right, nor there.
    ///
    /// # Errors
    /// When its place is taken, or the system lacks something.
    pub fn start(options: Options, host: Box<dyn Host>) -> Result<Self, StartError> {
        let system = |what: &str, error: &dyn std::fmt::Display| StartError::System(format!("cannot {what}: {error}"));
        let asked = SocketAddr::new(options.address, options.port);
        let listener = TcpListener::bind(asked).map_err(|source| StartError::Listen { at: asked, source })?;
        listener.set_nonblocking(true).map_err(|source| StartError::Listen { at: asked, source })?;
        let at = listener.local_addr().map_err(|source| StartError::Listen { at: asked, source })?;
        let guard = Guard::new(at.ip()).map_err(|error| system("make a token", &error))?;
        let token = guard.token().to_owned();
        let shared = Arc::new(Shared::new(options, host));
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .max_blocking_threads(8)
            .build()
            .map_err(|error| system("start the server", &error))?;
        let (end, ended) = oneshot::channel();
        let app = Router::new()
            .fallback(answer)
            .layer(DefaultBodyLimit::max(LARGEST_REQUEST))
            .with_state(Arc::new(App { shared: Arc::clone(&shared), guard }));
        let thread = |name: &str| std::thread::Builder::new().name(name.to_owned());
        let server = thread("server").spawn(move || {
            runtime.block_on(async move {
                let Ok(listener) = tokio::net::TcpListener::from_std(listener) else { return };
                tokio::select! {
                    _ = axum::serve(listener, app) => {}
                    _ = ended => {}
                }
            });
            runtime.shutdown_background();
        });
        let server = server.map_err(|error| system("start a thread", &error))?;
        let worker = Arc::clone(&shared);
        let studio =
            thread("studio").spawn(move || studio::run(&worker)).map_err(|error| system("start a thread", &error))?;
        let watched = Arc::clone(&shared);
        thread("watch").spawn(move || watch::run(watched)).map_err(|error| system("start a thread", &error))?;
        Ok(Preview { shared, at, token, end: Some(end), server: Some(server), studio: Some(studio) })
    }

    /// The address of the page.
    pub fn address(&self) -> String {
        // What listens everywhere is reached here by the name of this computer to itself.
        let ip = match self.at.ip() {
            IpAddr::V4(ip) if ip.is_unspecified() => IpAddr::from([127, 0, 0, 1]),
            IpAddr::V6(ip) if ip.is_unspecified() => IpAddr::V6(std::net::Ipv6Addr::LOCALHOST),
            ip => ip,
        };
        format!("http://{}/{}/", SocketAddr::new(ip, self.at.port()), self.token)
    }

    /// Waits for ever: the preview ends with the program.
    pub fn wait(mut self) {
        if let Some(server) = self.server.take() {
            // A server that fell is told by there being no page.
            let _ = server.join();
        }
    }
}

impl Drop for Preview {
    fn drop(&mut self) {
        self.shared.order(|orders| orders.quit = true);
        if let Some(end) = self.end.take() {
            // The server may have ended by itself.
            let _ = end.send(());
        }
        for thread in [self.server.take(), self.studio.take()].into_iter().flatten() {
            let _ = thread.join();
        }
    }
}

struct App {
    shared: Arc<Shared>,
    guard: Guard,
}

/// Answers a request, with what every answer has.
async fn answer(Extract(app): Extract<Arc<App>>, request: Request) -> Response {
    let mut response = if app.guard.lets_in(request.headers()) {
        match app.guard.behind_token(request.uri().path()) {
            Some(path) => {
                let path = path.to_owned();
                route(&app, &path, request).await
            }
            None => refused(StatusCode::NOT_FOUND, "not found"),
        }
    } else {
        refused(StatusCode::FORBIDDEN, "not from here")
    };
    let headers = response.headers_mut();
    let mut set = |name: HeaderName, value: &'static str| headers.insert(name, HeaderValue::from_static(value));
    set(header::CONTENT_SECURITY_POLICY, POLICY);
    set(header::X_CONTENT_TYPE_OPTIONS, "nosniff");
    // The address has the token.
    set(header::REFERRER_POLICY, "no-referrer");
    set(header::CACHE_CONTROL, "no-store");
    set(HeaderName::from_static("cross-origin-resource-policy"), "same-origin");
    set(HeaderName::from_static("cross-origin-opener-policy"), "same-origin");
    response
}

async fn route(app: &Arc<App>, path: &str, request: Request) -> Response {
    let shared = &app.shared;
    let (parts, body) = request.into_parts();
    match (&parts.method, path) {
        (&Method::GET, "state") => match Query::try_from_uri(&parts.uri) {
            Ok(Query(asked)) => state(shared, asked).await,
            Err(error) => refused(StatusCode::BAD_REQUEST, &error.body_text()),
        },
        (&Method::GET, "frame") => match Query::try_from_uri(&parts.uri) {
            Ok(Query(asked)) => frame(shared, asked).await,
            Err(error) => refused(StatusCode::BAD_REQUEST, &error.body_text()),
        },
        (&Method::GET, "save") => match Query::try_from_uri(&parts.uri) {
            Ok(Query(asked)) => save(shared, asked).await,
            Err(error) => refused(StatusCode::BAD_REQUEST, &error.body_text()),
        },
        (&Method::POST, "open") => match read(&parts.headers, body).await {
            Ok(asked) => open(shared, &asked),
            Err((status, why)) => refused(status, &why),
        },
        (&Method::GET, _) => match FILES.iter().find(|(name, ..)| *name == path) {
            Some((_, kind, text)) => ([(header::CONTENT_TYPE, *kind)], *text).into_response(),
            None => refused(StatusCode::NOT_FOUND, "not found"),
        },
        _ => refused(StatusCode::NOT_FOUND, "not found"),
    }
}

/// A refusal, with its reason for the person.
type Refusal = (StatusCode, String);

fn refused(status: StatusCode, why: &str) -> Response {
    (status, [(header::CONTENT_TYPE, "text/plain; charset=utf-8")], why.to_owned()).into_response()
}

/// What a request brings, as JSON.
async fn read<T: for<'de> Deserialize<'de>>(headers: &HeaderMap, body: axum::body::Body) -> Result<T, Refusal> {
    // Forms of other sites' pages cannot send this kind.
    let is_json = headers.get(header::CONTENT_TYPE).is_some_and(|kind| kind == "application/json");
    if !is_json {
        return Err((StatusCode::UNSUPPORTED_MEDIA_TYPE, "expected JSON".to_owned()));
    }
    let bytes: Bytes = axum::body::to_bytes(body, LARGEST_REQUEST)
        .await
        .map_err(|_| (StatusCode::PAYLOAD_TOO_LARGE, "too large".to_owned()))?;
    serde_json::from_slice(&bytes).map_err(|error| (StatusCode::BAD_REQUEST, error.to_string()))
}

/// Does what takes a while on a thread of its own.
async fn aside(work: impl FnOnce() -> Response + Send + 'static) -> Response {
    let done = tokio::task::spawn_blocking(work).await;
    done.unwrap_or_else(|_| {
        refused(StatusCode::INTERNAL_SERVER_ERROR, "tracer failed on this, which is a fault of tracer")
    })
}

#[derive(Deserialize)]
struct AskedState {
    /// The version that the page has.
    #[serde(default)]
    after: u64,
}

/// The state as JSON, as soon as it is another than the page has.
async fn state(shared: &Arc<Shared>, asked: AskedState) -> Response {
    let mut versions = shared.versions();
    let rendering = {
        let state = shared.state();
        if state.version != asked.after {
            return axum::Json(Shown::of(&state, shared)).into_response();
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
    axum::Json(Shown::of(&shared.state(), shared)).into_response()
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
    camera: Option<Pose>,
    written: Option<Pose>,
}

#[derive(Serialize)]
struct ShownFrame {
    number: u64,
    stage: u64,
    draft: bool,
    size: [u32; 2],
    samples: u32,
    noise: Option<f64>,
}

#[derive(Serialize)]
struct ShownLook {
    exposure: f64,
    tone: &'static str,
}

impl<'s> Shown<'s> {
    fn of(state: &'s State, shared: &Shared) -> Self {
        let frame = state.frame.as_deref().map(|frame| ShownFrame {
            number: frame.number,
            stage: frame.stage,
            draft: frame.draft,
            size: frame.size,
            samples: frame.samples,
            noise: state
                .noise
                .filter(|(number, noise)| *number == frame.number && *noise > 0.0)
                .map(|(_, noise)| noise),
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
            seconds: state.took.unwrap_or_else(|| state.began.elapsed().as_secs_f64()),
            look: look.map(|look| ShownLook { exposure: look.exposure, tone: tone_name(look.tone_map) }),
            camera: state.stage.as_ref().map(|stage| Pose::of(&stage.desc)),
            written: state.written,
        }
    }
}

/// The tone maps, as the page names them.
const TONES: [(&str, ToneMap); 3] = [("none", ToneMap::None), ("filmic", ToneMap::Filmic), ("agx", ToneMap::AgX)];

fn tone_name(tone: ToneMap) -> &'static str {
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
        Ok(Look { exposure, tone_map })
    }
}

/// The picture as it is now, as bytes for a canvas.
async fn frame(shared: &Arc<Shared>, asked: AskedLook) -> Response {
    let (frame, stage) = {
        let state = shared.state();
        (state.frame.clone(), state.stage.clone())
    };
    let Some(frame) = frame else { return refused(StatusCode::CONFLICT, "there is no picture yet") };
    let look = match asked.look(stage.map_or(Look::default(), |stage| stage.scene.look)) {
        Ok(look) => look,
        Err((status, why)) => return refused(status, &why),
    };
    aside(move || {
        let [width, height] = frame.film.size();
        let headers = [
            ("content-type", "application/octet-stream".to_owned()),
            ("x-frame", frame.number.to_string()),
            ("x-size", format!("{width}x{height}")),
        ];
        (headers, picture::developed(&frame.film, &look)).into_response()
    })
    .await
}

#[derive(Deserialize)]
struct AskedFile {
    kind: String,
    exposure: Option<f64>,
    tone: Option<String>,
}

/// The picture as a file.
async fn save(shared: &Arc<Shared>, asked: AskedFile) -> Response {
    let (kind, extension, media) = match asked.kind.as_str() {
        "png" => (Kind::Png, "png", "image/png"),
        "exr" => (Kind::Exr, "exr", "image/x-exr"),
        _ => return refused(StatusCode::BAD_REQUEST, "pictures are png or exr"),
    };
    let (frame, stage) = {
        let state = shared.state();
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
    let shared = Arc::clone(shared);
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

#[derive(Deserialize)]
struct AskedPlace {
    /// Which of the diagnostics.
    told: usize,
    /// The version of the state that it was read in.
    version: u64,
}

/// Opens the place of a diagnostic in the editor: only places that were told of can be.
fn open(shared: &Shared, asked: &AskedPlace) -> Response {
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
