//! A run of the program under the injected layer.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Longer than any run takes on a busy machine: a hang.
const LONGEST: Duration = Duration::from_secs(60);
const SHIM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/faults/shim.rs");

/// The layer, compiled by the compiler that compiles this.
pub fn shim() -> &'static Path {
    static FILE: OnceLock<(tempfile::TempDir, PathBuf)> = OnceLock::new();
    let (_, file) = FILE.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("libshim.so");
        let mut rustc = Command::new(std::env::var_os("RUSTC").unwrap_or("rustc".into()));
        rustc.args(["--edition", "2024", "-O", "-C", "panic=abort", "--crate-type", "cdylib", SHIM, "-o"]).arg(&file);
        assert!(rustc.status().expect("rustc").success(), "{SHIM} is compiled");
        (folder, file)
    });
    file
}

/// A call of the log.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Call {
    /// From one on.
    pub number: usize,
    /// `write`
    pub name: String,
    /// Whether a full disk would refuse it.
    pub writes: bool,
    /// The last part of the file's name.
    pub file: String,
}

/// What ended.
pub struct Ran {
    pub code: Option<i32>,
    pub signal: Option<i32>,
    pub timed_out: bool,
    pub out: Vec<u8>,
    pub err: String,
    pub calls: Vec<Call>,
    /// Sizes of large blocks of memory.
    pub blocks: Vec<usize>,
    /// What was made to fail first.
    pub hit: Option<String>,
}

/// A folder to run in, a copy of another, with what lies beside it.
pub struct Folder {
    all: tempfile::TempDir,
}

impl Folder {
    pub fn new() -> Self {
        let all = tempfile::tempdir().expect("a folder");
        for folder in ["here", "elsewhere"] {
            fs::create_dir(all.path().join(folder)).expect("a folder");
        }
        Folder { all }
    }

    pub fn copy(&self) -> Self {
        let copy = Folder::new();
        self.copy_into(&copy);
        copy
    }

    pub fn copy_into(&self, other: &Folder) {
        copied(&self.here(), &other.here());
    }

    /// Where the program runs.
    pub fn here(&self) -> PathBuf {
        self.all.path().join("here")
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.here().join(name)
    }

    /// Where pictures go that have lost their place.
    pub fn elsewhere(&self) -> PathBuf {
        self.all.path().join("elsewhere")
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, bytes).expect("a file");
    }

    /// All files, by their names from here.
    pub fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let mut files = BTreeMap::new();
        collect(&self.here(), "", &mut files);
        files
    }

    /// Runs the program with these variables for the layer; without any there is no layer.
    pub fn run(&self, arguments: &[String], faults: &[(&str, String)]) -> Ran {
        self.run_within(arguments, faults, None)
    }

    /// The same within an address space of so many KiB.
    pub fn run_within(&self, arguments: &[String], faults: &[(&str, String)], space: Option<u64>) -> Ran {
        let [log, out, err] = ["log", "out", "err"].map(|name| self.all.path().join(name));
        let _ = fs::remove_file(&log);
        let program = env!("CARGO_BIN_EXE_tracer");
        let mut command = match space {
            None => Command::new(program),
            Some(kilobytes) => {
                let mut shell = Command::new("sh");
                shell.args(["-c", &format!("ulimit -v {kilobytes} && exec \"$0\" \"$@\""), program]);
                shell
            }
        };
        command.args(arguments).current_dir(self.here()).stdin(Stdio::null());
        command.stdout(File::create(&out).expect("a file")).stderr(File::create(&err).expect("a file"));
        command.env_remove("TRACER_LANES").env_remove("RUST_BACKTRACE").env("TMPDIR", self.elsewhere());
        if !faults.is_empty() {
            command.env("LD_PRELOAD", shim()).env("FAULT_LOG", &log);
            command.envs(faults.iter().map(|(name, value)| (name, value)));
        }
        let mut child = command.spawn().expect("the program starts");
        let started = Instant::now();
        let (status, timed_out) = loop {
            match child.try_wait().expect("a child") {
                Some(status) => break (status, false),
                None if started.elapsed() > LONGEST => {
                    let _ = child.kill();
                    break (child.wait().expect("a child"), true);
                }
                None => std::thread::sleep(Duration::from_millis(2)),
            }
        };
        let log = fs::read_to_string(&log).unwrap_or_default();
        Ran {
            code: status.code(),
            signal: status.signal(),
            timed_out,
            out: fs::read(&out).expect("its output"),
            err: String::from_utf8_lossy(&fs::read(&err).expect("its words")).into_owned(),
            calls: log.lines().filter_map(call).collect(),
            blocks: log.lines().filter_map(block).collect(),
            hit: log.lines().find(|line| line.ends_with(" FAULT")).map(str::to_owned),
        }
    }

    /// Runs the program without any fault, to the end.
    #[track_caller]
    pub fn ready(&self, line: &str, code: i32) {
        let words: Vec<String> = line.split(' ').map(str::to_owned).collect();
        let ran = self.run(&words, &[]);
        assert_eq!(ran.code, Some(code), "{line}: {}", ran.err);
    }
}

fn call(line: &str) -> Option<Call> {
    let mut words = line.trim_end_matches(" FAULT").splitn(4, ' ');
    let number = words.next()?.parse().ok()?;
    let (name, writes, file) = (words.next()?, words.next()?, words.next()?);
    Some(Call { number, name: name.to_owned(), writes: writes == "w", file: file.to_owned() })
}

fn block(line: &str) -> Option<usize> {
    line.strip_prefix("block ")?.split(' ').nth(1)?.parse().ok()
}

fn copied(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).expect("a folder").flatten() {
        let target = to.join(entry.file_name());
        if entry.file_type().expect("a kind").is_dir() {
            fs::create_dir(&target).expect("a folder");
            copied(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).expect("a copy");
        }
    }
}

fn collect(folder: &Path, below: &str, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let name = format!("{below}{}", entry.file_name().to_string_lossy());
        if entry.file_type().expect("a kind").is_dir() {
            collect(&entry.path(), &format!("{name}/"), files);
        } else {
            files.insert(name, fs::read(entry.path()).expect("a file"));
        }
    }
}
