//! The end of all that a test has started, whatever ends the test.

use std::io::Write;
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};

/// In the environment of what is to end: the test's folder.
pub const MARK: &str = "TRACER_PROOF";

/// Kills whatever has the mark until nothing has, once its standard input is closed: by us, or by our end. An sshd
/// writes over its environment, and is known by the file of its settings.
const SCRIPT: &str = r#"
trap '' INT TERM HUP
read -r folder
cat >/dev/null
while :; do
    found=
    for process in /proc/[0-9]*; do
        if tr '\0' '\n' <"$process/environ" | grep -qxF "$1=$folder" ||
            tr '\0' ' ' <"$process/cmdline" | grep -q "^sshd: .* $folder/sshd_config"; then
            found="$found ${process#/proc/}"
        fi
    done
    [ -n "$found" ] || exit 0
    kill -KILL $found
    sleep 0.1
done
"#;

/// Waits for its own end, or that of the process.
pub struct Reaper {
    shell: Child,
    input: Option<ChildStdin>,
}

impl Reaper {
    /// Of what is marked with this folder.
    pub fn new(folder: &Path) -> Self {
        let mut shell = Command::new("sh");
        shell.args(["-c", SCRIPT, "reaper", MARK]).env_remove(MARK);
        shell.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut shell = shell.spawn().expect("a shell");
        let mut input = shell.stdin.take();
        // Not among its words, by which it would find itself.
        writeln!(input.as_mut().expect("a pipe"), "{}", folder.display()).expect("it reads");
        Reaper { shell, input }
    }
}

impl Drop for Reaper {
    fn drop(&mut self) {
        drop(self.input.take());
        let _ = self.shell.wait();
    }
}
