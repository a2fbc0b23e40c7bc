//! Parts by GNU parallel over ssh, as docs/scale.md has it: an sshd of our own on a port of its own, with its own keys.

use crate::reaper::{MARK, Reaper};
use crate::{SCENE, TRACER, manual};
use std::fs;
use std::net::{TcpListener, TcpStream};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Starts sshd with all that it needs in a folder.
fn start(folder: &Path, path: &str) {
    let shown = folder.display();
    for key in ["host", "mine"] {
        let mut keygen = Command::new("ssh-keygen");
        keygen.args(["-q", "-t", "ed25519", "-N", "", "-f"]).arg(folder.join(key));
        assert!(keygen.status().expect("ssh-keygen").success());
    }
    fs::copy(folder.join("mine.pub"), folder.join("allowed")).expect("a key");
    let port = TcpListener::bind("127.0.0.1:0").and_then(|free| free.local_addr()).expect("a free port").port();
    let daemon = format!(
        "ListenAddress 127.0.0.1:{port}\nHostKey {shown}/host\nAuthorizedKeysFile {shown}/allowed\nStrictModes no\n\
         UsePAM no\nPidFile none\nPermitRootLogin prohibit-password\nPasswordAuthentication no\n\
         SetEnv PATH={path} {MARK}={shown}\n"
    );
    fs::write(folder.join("sshd_config"), daemon).expect("a file");
    let client = format!(
        "Host *\n  Port {port}\n  IdentityFile {shown}/mine\n  IdentitiesOnly yes\n  UserKnownHostsFile /dev/null\n  \
         StrictHostKeyChecking no\n  LogLevel ERROR\n"
    );
    fs::write(folder.join("ssh_config"), client).expect("a file");
    // Debian's scripts make it before they start sshd, which does not start without.
    fs::create_dir_all("/run/sshd").expect("root");
    let mut sshd = Command::new("/usr/sbin/sshd");
    sshd.args(["-D", "-e", "-f"]).arg(folder.join("sshd_config")).stdin(Stdio::null()).stdout(Stdio::null());
    sshd.stderr(fs::File::create(folder.join("sshd.log")).expect("a file"));
    sshd.env(MARK, folder).spawn().expect("sshd");
    let start = Instant::now();
    while TcpStream::connect(("127.0.0.1", port)).is_err() {
        assert!(start.elapsed() < Duration::from_secs(30), "sshd does not answer");
        std::thread::sleep(Duration::from_millis(50));
    }
}

/// The lines of the manual on these machines; `more` is set for them, too.
fn lines_of_the_manual(folder: &Path, path: &str, machines: &str, more: &[(&str, String)]) {
    let work = folder.join("work");
    for name in ["work", "bin", "home"] {
        fs::create_dir(folder.join(name)).expect("a folder");
    }
    std::os::unix::fs::symlink(TRACER, folder.join("bin/tracer")).expect("a link");
    fs::write(work.join("scene.ron"), SCENE.replace("samples: 8", "samples: 16")).expect("a scene");
    fs::write(work.join("machines"), machines).expect("a file");
    let run = |line: &str| {
        let mut shell = Command::new("sh");
        // A home of its own, for parallel writes there; not above the scene, for it takes folders there to be elsewhere
        // on other machines.
        shell.args(["-euc", line]).current_dir(&work).env("PATH", path).env("HOME", folder.join("home"));
        let output = shell.envs(more.iter().cloned()).stdin(Stdio::null()).output().expect("a shell");
        let log = fs::read_to_string(folder.join("sshd.log")).unwrap_or_default();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{line}\n{said}\n{log}");
    };
    let parts = || {
        let files = fs::read_dir(&work).expect("files").flatten();
        files.filter(|file| file.path().extension().is_some_and(|end| end == "tracer")).count()
    };
    run("tracer render scene.ron -q -o one.exr");
    let lines = manual::block("## GNU parallel over ssh");
    run(&lines);
    let read = |name: &str| fs::read(work.join(name)).expect("a picture");
    assert_eq!((read("scene.exr") == read("one.exr"), parts()), (true, 16));
    // The same lines again go on with what is missing.
    fs::remove_file(work.join("scene.exr")).expect("a picture");
    fs::remove_file(work.join("scene.7of16.tracer")).expect("a part");
    run(&lines);
    assert_eq!((read("scene.exr") == read("one.exr"), parts()), (true, 16));
}

/// The folders of programs: of ours first.
fn path(folder: &Path) -> String {
    format!("{}:/usr/local/bin:/usr/bin:/bin", folder.join("bin").display())
}

/// Without ssh: parallel takes `:` for the machine that it runs on.
#[test]
fn parts_by_gnu_parallel() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    lines_of_the_manual(folder.path(), &path(folder.path()), "2/:\n", &[]);
}

#[test]
fn parts_by_gnu_parallel_over_ssh() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = path(folder.path());
    let _reaper = Reaper::new(folder.path());
    start(folder.path(), &path);
    let ssh = format!("ssh -F {}", folder.path().join("ssh_config").display());
    lines_of_the_manual(folder.path(), &path, "2/127.0.0.1\n", &[("PARALLEL_SSH", ssh)]);
}
