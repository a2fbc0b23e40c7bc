//! The end of all that a test has started, whatever ends the test.

use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};

/// In the environment of what is to end: the test's folder.
pub const MARK: &str = "TRACER_PROOF";

/// Kills whatever has the mark until nothing has, once its standard input is closed: by us, or by our end.
const SCRIPT: &str = r#"
trap '' INT TERM HUP
cat >/dev/null
while :; do
    found=
    for file in /proc/[0-9]*/environ; do
        if tr '\0' '\n' <"$file" | grep -qxF "$1"; then
            process=${file#/proc/}
            found="$found ${process%/environ}"
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
        shell.args(["-c", SCRIPT, "reaper", &format!("{MARK}={}", folder.display())]).env_remove(MARK);
        shell.stdin(Stdio::piped()).stdout(Stdio::null()).stderr(Stdio::null());
        let mut shell = shell.spawn().expect("a shell");
        let input = shell.stdin.take();
        Reaper { shell, input }
    }
}

impl Drop for Reaper {
    fn drop(&mut self) {
        drop(self.input.take());
        let _ = self.shell.wait();
    }
}
