//! The preview saves a camera into a scene's file, and cannot.

use super::run::{Folder, shim};
use serde_json::Value;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const SCENE: &str = "Scene(
    camera: Camera(position: (0, 0, 5), look_at: (0, 0, 0), fov: 40), // the eye
    image: Image(width: 8, height: 8),
    render: Render(samples: 1),
    background: 0.5,
    objects: [Sphere(center: (0, 0, 0), radius: 1)],
)
";
const POSE: &str = r#"{ "pose": { "position": [1, 0, 4], "look_at": [0, 0, 0], "up": [0, 1, 0], "fov": 30 } }"#;

/// A preview in which one kind of call fails; it is ended when dropped.
struct Preview {
    child: Child,
    host: String,
    token: String,
}

impl Preview {
    fn start(folder: &Folder, call: &str) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_tracer"));
        command.args(["preview", "scene.ron"]).current_dir(folder.here()).stdin(Stdio::null());
        command.env("LD_PRELOAD", shim()).env("FAULT_CALL", call).env("FAULT_HOW", "28");
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("the program starts");
        let mut line = String::new();
        BufReader::new(child.stdout.take().expect("a pipe")).read_line(&mut line).expect("an address");
        let (host, token) =
            line.trim_end().strip_prefix("http://").and_then(|rest| rest.split_once('/')).expect("an address");
        Preview { host: host.to_owned(), token: token.trim_end_matches('/').to_owned(), child }
    }

    /// Status and body of the answer.
    fn ask(&self, method: &str, path: &str, json: &str) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.host).expect("it listens");
        stream.set_read_timeout(Some(Duration::from_secs(60))).expect("a timeout");
        let (host, token, length) = (&self.host, &self.token, json.len());
        let request = format!(
            "{method} /{token}/{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Type: \
             application/json\r\nContent-Length: {length}\r\n\r\n{json}"
        );
        let _ = stream.write_all(request.as_bytes());
        let mut text = String::new();
        let _ = stream.read_to_string(&mut text);
        let status = text.split(' ').nth(1).and_then(|status| status.parse().ok()).unwrap_or(0);
        (status, text.split_once("\r\n\r\n").map_or(String::new(), |(_, body)| body.to_owned()))
    }

    /// Waits for a picture with the camera as it is written in the file, or with another.
    fn wait_until_done(&self, as_written: bool) {
        let start = Instant::now();
        let is_done = || {
            let state: Value = serde_json::from_str(&self.ask("GET", "state", "").1).unwrap_or_default();
            state["phase"] == "done" && (state["camera"] == state["written"]) == as_written
        };
        while !is_done() {
            assert!(start.elapsed() < Duration::from_secs(60), "it is never done");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Preview {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// The page is told why and what to do, the file stays as it was, and nothing is left beside it.
#[test]
fn a_camera_that_cannot_be_saved() {
    for call in ["create", "write", "fsync", "rename", "none"] {
        let folder = Folder::new();
        folder.write("scene.ron", SCENE);
        let preview = Preview::start(&folder, call);
        preview.wait_until_done(true);
        assert_eq!(preview.ask("POST", "camera", POSE).0, 204, "{call}");
        preview.wait_until_done(false);
        let (status, said) = preview.ask("POST", "camera/write", "{}");
        drop(preview);
        let files = folder.files();
        if call == "none" {
            assert!(status == 200 && files["scene.ron"] != SCENE.as_bytes(), "{status}: {said}");
        } else {
            assert!(status >= 400 && files["scene.ron"] == SCENE.as_bytes(), "{call}: {status}: {said}");
            assert!(said.contains("scene.ron") && said.contains("make room"), "{call}: {said}");
        }
        assert_eq!(files.len(), 1, "{call}: {:?}", files.keys());
    }
}
