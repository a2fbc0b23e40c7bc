//! The real program in a folder of its own.

use exr::prelude::{FlatSamples, read_all_flat_layers_from_file};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A folder that is deleted afterwards, with a small scene in it.
pub struct Sandbox {
    folder: TempDir,
}

/// A scene that renders in a moment: 40x24 pixels, all materials but textures.
pub const SCENE: &str = r#"// small
Scene(
    camera: Camera(position: (0, 1, 6), look_at: (0, 0.5, 0), fov: 40),
    image: Image(width: 40, height: 24),
    render: Render(samples: 2, max_bounces: 4),
    background: (0.2, 0.3, 0.4),
    lights: [SphereLight(center: (2, 5, 3), radius: 1, radiance: 20)],
    materials: { "glass": Transparent(ior: 1.5) },
    objects: [
        Sphere(center: (0, -100, 0), radius: 100),
        Sphere(center: (-1, 1, 0), radius: 1, material: "glass"),
        Sphere(center: (1, 1, 0), radius: 1, material: Mirror(reflectance: 0.9)),
    ],
)
"#;

impl Sandbox {
    pub fn new() -> Self {
        let sandbox = Sandbox { folder: tempfile::tempdir().expect("a temporary folder") };
        sandbox.write("scene.ron", SCENE);
        sandbox
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, contents: impl AsRef<[u8]>) {
        fs::write(self.path(name), contents).expect("the folder can be written");
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).expect("text")
    }

    /// Names of all files, sorted.
    pub fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).expect("the folder can be listed");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The program, in the folder, with nothing of the tester's environment that it heeds.
    pub fn command(&self, arguments: &[&str]) -> Command {
        self.in_folder(env!("CARGO_BIN_EXE_tracer"), arguments)
    }

    /// A shell line in the folder; `"$T"` is the program.
    pub fn shell(&self, line: &str) -> Ran {
        let mut command = self.in_folder("sh", &["-c", line]);
        command.env("T", env!("CARGO_BIN_EXE_tracer"));
        Ran::of(&mut command)
    }

    fn in_folder(&self, program: &str, arguments: &[&str]) -> Command {
        let mut command = Command::new(program);
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null());
        command.env_remove("TRACER_LANES").env_remove("TRACER_OIDN").env_remove("NO_COLOR");
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Ran {
        Ran::of(&mut self.command(arguments))
    }
}

/// What a run of the program gave.
#[derive(Debug)]
pub struct Ran {
    pub code: Option<i32>,
    pub out: Vec<u8>,
    pub err: String,
}

impl Ran {
    pub fn of(command: &mut Command) -> Self {
        let Output { status, stdout, stderr } = command.output().expect("the program starts");
        Ran { code: status.code(), out: stdout, err: String::from_utf8_lossy(&stderr).into_owned() }
    }

    #[track_caller]
    pub fn ends(self, code: i32) -> Self {
        assert_eq!(self.code, Some(code), "standard error: {}", self.err);
        self
    }

    /// Standard error has each of these.
    #[track_caller]
    pub fn says(self, words: &[&str]) -> Self {
        for word in words {
            assert!(self.err.contains(word), "`{word}` is not in: {}", self.err);
        }
        self
    }

    /// Nothing on standard error.
    #[track_caller]
    /// Nothing is said but that a picture is done, which every rendering says.
    pub fn silent(self) -> Self {
        let said: Vec<&str> = self.err.lines().filter(|line| !is_done(line)).collect();
        assert!(said.is_empty(), "{said:?}");
        self
    }

    pub fn out_text(&self) -> String {
        String::from_utf8_lossy(&self.out).into_owned()
    }
}

/// The top of the repository.
pub fn repository() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// `a.png in 0.02 s, 3.4 M samples/s; noise 4 %, about 1000 samples for 1 %`
pub fn is_done(line: &str) -> bool {
    let is_told = line.contains(" samples/s") || line.contains("all samples were there");
    line.contains(" s, ") && is_told && line.contains(" in ")
}

/// The channels of an EXR file, which has one part, by name.
pub fn channels(sandbox: &Sandbox, name: &str) -> BTreeMap<String, Vec<f32>> {
    let image = read_all_flat_layers_from_file(sandbox.path(name)).expect("an EXR file");
    assert_eq!(image.layer_data.len(), 1);
    let channel = |channel: &exr::prelude::AnyChannel<FlatSamples>| {
        let FlatSamples::F32(values) = &channel.sample_data else { panic!("{} is no float", channel.name) };
        (channel.name.to_string(), values.clone())
    };
    image.layer_data[0].channel_data.list.iter().map(channel).collect()
}
