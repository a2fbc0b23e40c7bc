//! Opening pictures and pages in what a person has for them.

use std::ffi::OsStr;
use std::io::ErrorKind;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// Whether it can show anything is known by then; what runs longer shows it.
const TELLS: Duration = Duration::from_secs(1);

/// Opens a file or an address.
///
/// # Errors
/// Why it cannot be opened, in words for the person.
pub fn open(what: impl AsRef<OsStr>) -> Result<(), String> {
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "macos") {
        ("open", &[])
    } else if cfg!(windows) {
        ("cmd", &["/C", "start", ""])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command.args(arguments).arg(what).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    let mut child = command.spawn().map_err(|error| match error.kind() {
        ErrorKind::NotFound if program == "xdg-open" => {
            "there is no xdg-open here, which would (package xdg-utils)".to_owned()
        }
        _ => format!("cannot start {program}: {error}"),
    })?;
    let began = Instant::now();
    while began.elapsed() < TELLS {
        match child.try_wait() {
            Ok(Some(status)) if status.success() => return Ok(()),
            Ok(Some(status)) => return Err(format!("{program} found nothing that can ({status})")),
            Ok(None) => std::thread::sleep(Duration::from_millis(10)),
            Err(error) => return Err(format!("cannot wait for {program}: {error}")),
        }
    }
    // Somebody has to wait for it, or it stays in the system's table when it has ended.
    let waits = std::thread::Builder::new().name("opened".to_owned()).spawn(move || child.wait());
    waits.map(drop).map_err(|error| format!("cannot wait for {program}: {error}"))
}
