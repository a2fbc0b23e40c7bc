//! A Slurm of two nodes on this machine, with its own key, ports and folder: nothing of it is outside the folder, and
//! nothing of it runs when it is dropped, or when this program is killed.

use crate::reaper::{MARK, Reaper};
use std::fs;
use std::io::Read;
use std::net::TcpListener;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The nodes' names.
pub const NODES: [&str; 2] = ["n1", "n2"];
/// In that of what belongs to a node; what Slurm starts there has its own word for it.
const NODE: [&str; 2] = ["TRACER_PROOF_NODE", "SLURMD_NODENAME"];
/// How long anything may take.
const PATIENCE: Duration = Duration::from_secs(120);

pub struct Cluster {
    // Before the folder: what still runs writes there.
    reaper: Option<Reaper>,
    folder: TempDir,
    daemons: Vec<Child>,
}

impl Cluster {
    /// Starts all daemons, and waits until both nodes are idle.
    pub fn start() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let reaper = Some(Reaper::new(folder.path()));
        let mut cluster = Cluster { reaper, folder, daemons: Vec::new() };
        for name in ["state", "spool", "run", "log", "work"] {
            fs::create_dir(cluster.path(name)).expect("a folder");
        }
        let mut key = [0; 1024];
        fs::File::open("/dev/urandom").and_then(|mut random| random.read_exact(&mut key)).expect("random bytes");
        fs::write(cluster.path("munge.key"), key).expect("a key");
        fs::set_permissions(cluster.path("munge.key"), fs::Permissions::from_mode(0o400)).expect("ours");
        fs::write(cluster.path("slurm.conf"), cluster.configuration()).expect("a configuration");

        let of = |name: &str, path: &str| format!("--{name}={}", cluster.path(path).display());
        let munge = [
            of("key-file", "munge.key"),
            of("socket", "run/munge.socket"),
            of("pid-file", "run/munged.pid"),
            of("log-file", "log/munged.log"),
            of("seed-file", "munge.seed"),
        ];
        // Its folder belongs to us alone, which it takes for a mistake.
        let munge: Vec<&str> = munge.iter().map(String::as_str).chain(["--foreground", "--force"]).collect();
        cluster.daemon("munged", &munge, None);
        cluster.wait("munge", || cluster.path("run/munge.socket").exists());
        cluster.daemon("slurmctld", &["-D"], None);
        NODES.iter().for_each(|node| cluster.start_node(node));
        cluster.wait("two idle nodes", || cluster.run("sinfo", &["-h", "-N", "-o", "%t"]) == "idle\nidle\n");
        cluster
    }

    fn configuration(&self) -> String {
        let host = fs::read_to_string("/proc/sys/kernel/hostname").expect("a name");
        let host = host.trim().split('.').next().unwrap_or_default().to_owned();
        // All are held until all are known, so that no two are the same.
        let listeners: Vec<TcpListener> =
            (0..3).map(|_| TcpListener::bind("127.0.0.1:0").expect("a free port")).collect();
        let ports: Vec<u16> = listeners.iter().map(|port| port.local_addr().expect("an address").port()).collect();
        let mut text = include_str!("slurm.conf").replace("@FOLDER@", &self.folder.path().display().to_string());
        for (name, value) in [
            ("@HOST@", host),
            ("@PORT@", ports[0].to_string()),
            ("@PORT1@", ports[1].to_string()),
            ("@PORT2@", ports[2].to_string()),
        ] {
            text = text.replace(name, &value);
        }
        text
    }

    fn daemon(&mut self, program: &str, arguments: &[&str], node: Option<&str>) {
        let log = self.path("log").join(format!("{program}{}.out", node.unwrap_or_default()));
        let log = fs::OpenOptions::new().create(true).append(true).open(log).expect("a log");
        let mut command = self.command(program, arguments);
        if let Some(node) = node {
            command.env(NODE[0], node);
        }
        command.stdout(log.try_clone().expect("a handle")).stderr(log);
        self.daemons.push(command.spawn().unwrap_or_else(|error| panic!("{program}: {error}")));
    }

    pub fn start_node(&mut self, node: &str) {
        self.daemon("slurmd", &["-D", "-N", node], Some(node));
    }

    /// Kills all that runs on a node at once, as when its power goes: the daemon, and what it has started.
    pub fn kill_node(&self, node: &str) {
        let words = NODE.map(|name| format!("{name}={node}"));
        let mut killed = 0;
        for process in fs::read_dir("/proc").expect("processes").flatten() {
            let environment = fs::read(process.path().join("environ")).unwrap_or_default();
            let has = |word: &str| environment.split(|&byte| byte == 0).any(|entry| entry == word.as_bytes());
            if has(&format!("{MARK}={}", self.folder.path().display())) && words.iter().any(|word| has(word)) {
                let process = process.file_name().to_string_lossy().into_owned();
                let _ = Command::new("kill").args(["-KILL", &process]).stderr(Stdio::null()).status();
                killed += 1;
            }
        }
        assert!(killed >= 3, "a daemon, a script and a program at least, not {killed}");
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// A program in the work folder that belongs to the cluster.
    pub fn command(&self, program: &str, arguments: &[&str]) -> Command {
        let path = std::env::var("PATH").unwrap_or_default();
        let mut command = Command::new(program);
        command.args(arguments).current_dir(self.path("work")).stdin(Stdio::null());
        command.env(MARK, self.folder.path()).env("PATH", format!("{path}:/usr/local/sbin:/usr/sbin:/sbin"));
        command.env("SLURM_CONF", self.path("slurm.conf")).env_remove("TRACER_LANES");
        command
    }

    /// What a program says.
    pub fn run(&self, program: &str, arguments: &[&str]) -> String {
        let output = self.command(program, arguments).output().unwrap_or_else(|error| panic!("{program}: {error}"));
        String::from_utf8_lossy(&output.stdout).into_owned()
    }

    /// Waits for something; logs are shown where it does not come.
    #[track_caller]
    pub fn wait(&self, what: &str, is: impl Fn() -> bool) {
        let start = Instant::now();
        while !is() {
            assert!(start.elapsed() < PATIENCE, "{what} does not come\n{}", self.logs());
            std::thread::sleep(Duration::from_millis(100));
        }
    }

    /// The ends of all logs.
    fn logs(&self) -> String {
        let mut text = self.run("squeue", &["--array"]);
        let mut folders = vec![self.path("log"), self.path("work")];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                let path = entry.path();
                let is_log = |path: &Path| path.extension().is_some_and(|end| end == "log" || end == "out");
                if path.is_dir() {
                    folders.push(path);
                } else if is_log(&path) {
                    let log = fs::read_to_string(&path).unwrap_or_default();
                    let lines: Vec<&str> = log.lines().collect();
                    text += &format!("-- {}\n", path.display());
                    text += &lines[lines.len().saturating_sub(12)..].join("\n");
                    text.push('\n');
                }
            }
        }
        text
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        drop(self.reaper.take());
        for daemon in &mut self.daemons {
            let _ = daemon.wait();
        }
    }
}
