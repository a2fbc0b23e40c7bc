//! A preview of a scene in a folder of its own, and a client that speaks HTTP itself, so that it can say what no
//! browser would.

use scene_format::SceneDesc;
use serde_json::Value;
use std::fs;
use std::io::{Read, Write};
use std::net::{IpAddr, Ipv4Addr, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use tempfile::TempDir;
use tracer_core::{Film, Look, develop};
use tracer_preview::{Editor, Host, Kind, Listen, Options, Preview};

/// A scene that renders in a moment.
pub const SCENE: &str = "// ball
Scene(
    camera: Camera(position: (0, 0, 5), look_at: (0, 0, 0), fov: 40), // the eye
    image: Image(width: 24, height: 16),
    render: Render(samples: 4),
    background: 0.5,
    objects: [Sphere(center: (0, 0, 0), radius: 1, material: Diffuse(albedo: (0.8, 0.2, 0.2)))],
)
";

/// Here, at a port that is free.
pub const ANY_PORT: Listen = Listen { address: IpAddr::V4(Ipv4Addr::LOCALHOST), port: 0 };

/// What comes late because other tests run beside it must not fail: nothing here takes a second by itself.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// Writes bytes that tell what they were made of, and keeps what was told of wrong scenes.
#[derive(Default)]
pub struct Program {
    pub wrong: Arc<Mutex<Vec<Option<String>>>>,
}

impl Host for Program {
    fn encode(&self, desc: &SceneDesc, film: &Film, look: &Look, kind: Kind) -> Result<Vec<u8>, String> {
        let image = develop(film, look);
        Ok(format!("{kind:?} {}x{} {} {}", image.width, image.height, look.exposure, desc.render.samples.value)
            .into_bytes())
    }

    fn save(&self, path: &Path, bytes: &[u8]) -> Result<(), String> {
        fs::write(path, bytes).map_err(|error| error.to_string())
    }

    fn wrong(&self, faults: Option<&str>) {
        self.wrong.lock().expect("nobody panics").push(faults.map(str::to_owned));
    }

    fn free_memory(&self) -> Option<u64> {
        Some(1 << 30)
    }
}

pub struct Sandbox {
    pub folder: TempDir,
    pub preview: Preview,
    /// What was told of wrong scenes elsewhere than on the page.
    pub wrong: Arc<Mutex<Vec<Option<String>>>>,
}

/// What came back.
#[derive(Debug)]
pub struct Answer {
    pub status: u16,
    pub head: String,
    pub body: Vec<u8>,
}

impl Answer {
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {}", self.text()))
    }

    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }
}

impl Sandbox {
    pub fn new(text: &str) -> Self {
        Sandbox::with(text, |_| {})
    }

    pub fn with(text: &str, change: impl FnOnce(&mut Options)) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        fs::write(folder.path().join("scene.ron"), text).expect("the folder can be written");
        let mut options = Options {
            scene: folder.path().join("scene.ron"),
            syntax: None,
            overrides: Vec::new(),
            samples: None,
            size: None,
            threads: 1,
            editor: None::<Editor>,
        };
        change(&mut options);
        let program = Program::default();
        let wrong = Arc::clone(&program.wrong);
        let preview = Preview::start(options, ANY_PORT, Box::new(program)).expect("it starts");
        Sandbox { folder, preview, wrong }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        fs::write(self.path(name), text).expect("the folder can be written");
    }

    /// Saves as most editors do: another file, renamed.
    pub fn rename_save(&self, name: &str, text: &str) {
        self.write(".saved.swp", text);
        fs::rename(self.path(".saved.swp"), self.path(name)).expect("it can be renamed");
    }

    /// `127.0.0.1:4000` and the token.
    pub fn place(&self) -> (String, String) {
        let address = self.preview.address();
        let rest = address.strip_prefix("http://").expect("an address");
        let (host, token) = rest.split_once('/').expect("a token");
        (host.to_owned(), token.trim_end_matches('/').to_owned())
    }

    pub fn get(&self, path: &str) -> Answer {
        let (host, token) = self.place();
        self.send(&format!("GET /{token}/{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n"))
    }

    pub fn post(&self, path: &str, json: &str) -> Answer {
        let (host, token) = self.place();
        self.send(&format!(
            "POST /{token}/{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Type: application/json\r\n\
             Content-Length: {}\r\n\r\n{json}",
            json.len()
        ))
    }

    /// Sends what is written, whatever it is.
    pub fn send(&self, request: &str) -> Answer {
        let mut stream = TcpStream::connect(self.place().0).expect("it listens");
        stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
        // It may answer, and close, before it has read all.
        let _ = stream.write_all(request.as_bytes());
        let mut bytes = Vec::new();
        let _ = stream.read_to_end(&mut bytes);
        let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").unwrap_or(bytes.len());
        let head = String::from_utf8_lossy(&bytes[..end]).into_owned();
        let status = head.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
        Answer { status, head, body: bytes.get(end + 4..).unwrap_or_default().to_vec() }
    }

    pub fn state(&self) -> Value {
        self.get("state").json()
    }

    /// The first state of which this is true, asked for as a page does.
    #[track_caller]
    pub fn until(&self, what: impl Fn(&Value) -> bool) -> Value {
        let began = Instant::now();
        let mut state = self.state();
        while !what(&state) {
            assert!(began.elapsed() < PATIENCE, "in vain: {state:#}");
            state = self.get(&format!("state?after={}", state["version"])).json();
        }
        state
    }

    /// The state when the picture is done, of a later stage than this.
    #[track_caller]
    pub fn done_after(&self, stage: u64) -> Value {
        self.until(|state| state["phase"] == "done" && stage_of(state) > stage)
    }

    /// The bytes of the picture as it is.
    pub fn pixels(&self) -> Vec<u8> {
        self.get("frame").body
    }
}

/// The stage of a state's frame; 0: there is none.
pub fn stage_of(state: &Value) -> u64 {
    state["frame"]["stage"].as_u64().unwrap_or(0)
}
