//! The server: one page, and what it asks for. Nothing else is read or given, whatever the address says.

use crate::answers::{App, Refusal, camera, open, picture, pixel, read, refused, state};
use crate::guard::Guard;
use crate::options::{Host, Listen, Options};
use crate::shared::Shared;
use crate::work;
use axum::Router;
use axum::body::Body;
use axum::extract::{Query, Request, State as Extract};
use axum::http::request::Parts;
use axum::http::{HeaderName, HeaderValue, Method, StatusCode, Uri, header};
use axum::response::{IntoResponse, Response};
use serde::de::DeserializeOwned;
use std::net::{IpAddr, SocketAddr, TcpListener};
use std::sync::Arc;
use std::thread::JoinHandle;
use tokio::sync::oneshot;

/// What the page consists of, and nothing else can be had.
const FILES: [(&str, &str, &str); 9] = [
    ("", "text/html; charset=utf-8", include_str!("page/index.html")),
    ("page.css", "text/css; charset=utf-8", include_str!("page/page.css")),
    ("main.js", SCRIPT, include_str!("page/main.js")),
    ("view.js", SCRIPT, include_str!("page/view.js")),
    ("net.js", SCRIPT, include_str!("page/net.js")),
    ("faults.js", SCRIPT, include_str!("page/faults.js")),
    ("camera.js", SCRIPT, include_str!("page/camera.js")),
    ("inspector.js", SCRIPT, include_str!("page/inspector.js")),
    ("compare.js", SCRIPT, include_str!("page/compare.js")),
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
    pub fn start(options: Options, listen: Listen, host: Box<dyn Host>) -> Result<Self, StartError> {
        let system = |what: &str, error: &dyn std::fmt::Display| StartError::System(format!("cannot {what}: {error}"));
        let asked = SocketAddr::new(listen.address, listen.port);
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
        let app = Router::new().fallback(answer).with_state(Arc::new(App::new(Arc::clone(&shared), guard)));
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
        let studio = work::begin(&shared).map_err(|error| system("start a thread", &error))?;
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

/// Answers a request, with what every answer has.
async fn answer(Extract(app): Extract<Arc<App>>, request: Request) -> Response {
    let mut response = if app.guard.lets_in(request.headers()) {
        match app.guard.behind_token(request.uri().path()) {
            Some(path) => {
                let path = path.to_owned();
                let (parts, body) = request.into_parts();
                route(&app, &path, &parts, body).await
            }
            None if request.method() == Method::GET && app.guard.lacks_slash(request.uri().path()) => {
                with_slash(&app, request.uri())
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

/// The page's address as it was meant: all that the page asks for goes on from its last slash.
fn with_slash(app: &App, uri: &Uri) -> Response {
    let query = uri.query().map_or(String::new(), |query| format!("?{query}"));
    (StatusCode::PERMANENT_REDIRECT, [(header::LOCATION, format!("/{}/{query}", app.guard.token()))]).into_response()
}

async fn route(app: &Arc<App>, path: &str, parts: &Parts, body: Body) -> Response {
    let answered = match parts.method {
        Method::GET => get(app, path, &parts.uri).await,
        Method::POST => post(app, path, parts, body).await,
        _ => Ok(refused(StatusCode::NOT_FOUND, "not found")),
    };
    answered.unwrap_or_else(|(status, why)| refused(status, &why))
}

async fn get(app: &Arc<App>, path: &str, uri: &Uri) -> Result<Response, Refusal> {
    Ok(match path {
        "state" => state::answer(app, query(uri)?).await,
        "frame" => picture::frame(app, query(uri)?).await,
        "save" => picture::save(app, query(uri)?).await,
        "pixel" => pixel::answer(app, query(uri)?).await,
        _ => match FILES.iter().find(|(name, ..)| *name == path) {
            Some((_, kind, text)) => ([(header::CONTENT_TYPE, *kind)], *text).into_response(),
            None => refused(StatusCode::NOT_FOUND, "not found"),
        },
    })
}

/// What changes something; each brings JSON, which pages of other sites cannot send unasked.
async fn post(app: &Arc<App>, path: &str, parts: &Parts, body: Body) -> Result<Response, Refusal> {
    let headers = &parts.headers;
    Ok(match path {
        "open" => open::answer(&app.shared, &read(headers, body).await?),
        "camera" => camera::moved(&app.shared, &read(headers, body).await?),
        "camera/write" => {
            read::<Nothing>(headers, body).await?;
            camera::write(app).await
        }
        "camera/undo" => {
            read::<Nothing>(headers, body).await?;
            camera::undo(app).await
        }
        "pin" => {
            read::<Nothing>(headers, body).await?;
            picture::pin(app)
        }
        "more" => {
            read::<Nothing>(headers, body).await?;
            more(&app.shared)
        }
        _ => refused(StatusCode::NOT_FOUND, "not found"),
    })
}

/// An order that needs no words.
#[derive(serde::Deserialize)]
struct Nothing {}

fn query<T: DeserializeOwned>(uri: &Uri) -> Result<T, Refusal> {
    match Query::try_from_uri(uri) {
        Ok(Query(asked)) => Ok(asked),
        Err(error) => Err((StatusCode::BAD_REQUEST, error.body_text())),
    }
}

/// Goes on with a picture that is done, to twice its samples.
fn more(shared: &Shared) -> Response {
    match work::twice(shared) {
        Ok(()) => StatusCode::NO_CONTENT.into_response(),
        Err(why) => refused(StatusCode::CONFLICT, why),
    }
}
