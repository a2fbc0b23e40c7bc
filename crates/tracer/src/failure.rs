//! How a command ends, and its exit code.

use crate::write::WriteError;
use std::io;
use std::process::ExitCode;

/// Exit codes, as `--help` documents them.
pub mod exit {
    /// Done.
    pub const DONE: u8 = 0;
    /// What was asked for could not be done (unreadable, read-only, disk full); `compare`: the pictures differ by more
    /// than allowed.
    pub const FAILED: u8 = 1;
    /// The scene or the command line is wrong, or names a file that is there already and is not to be replaced.
    pub const WRONG: u8 = 2;
    /// Interrupted by Ctrl-C.
    pub const INTERRUPTED: u8 = 130;
    /// Ended by SIGTERM.
    pub const TERMINATED: u8 = 143;
    /// Ended by SIGHUP: the terminal is gone.
    pub const HUNG_UP: u8 = 129;
}

/// Why a command did not do what it was asked for.
#[derive(Debug)]
pub enum Failure {
    /// The command line is wrong, or a file on it is not what the command takes.
    Wrong(anyhow::Error),
    /// The scene is wrong; its diagnostics have been printed.
    WrongScene,
    /// It could not be done.
    CouldNot(anyhow::Error),
    /// Nobody reads standard output any more; nothing is to be said.
    PipeClosed,
}

impl Failure {
    /// A wrong command line.
    pub fn wrong(message: impl Into<String>) -> Self {
        Failure::Wrong(anyhow::Error::msg(message.into()))
    }

    /// Something that could not be done.
    pub fn could_not(message: impl Into<String>) -> Self {
        Failure::CouldNot(anyhow::Error::msg(message.into()))
    }

    /// The exit code.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(match self {
            // As programs that SIGPIPE may end: the reader had enough, which is no failure.
            Failure::PipeClosed => exit::DONE,
            Failure::CouldNot(_) => exit::FAILED,
            Failure::Wrong(_) | Failure::WrongScene => exit::WRONG,
        })
    }
}

/// Of writing results to standard output.
impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Failure::from(WriteError::Stdout(error))
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        match error {
            _ if error.is_broken_pipe() => Failure::PipeClosed,
            // Who names a file that is there names another one, or says that it may go.
            WriteError::There { .. } | WriteError::Other { .. } => Failure::Wrong(error.into()),
            _ => Failure::CouldNot(error.into()),
        }
    }
}

/// Why a file that is named could not be read: in our words what whoever named it can mend, else in the system's.
pub fn why(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "it is not there".to_owned(),
        io::ErrorKind::IsADirectory => "it is a folder".to_owned(),
        io::ErrorKind::NotADirectory => "what its name takes for a folder is a file".to_owned(),
        io::ErrorKind::PermissionDenied => "its permissions do not allow it".to_owned(),
        _ => error.to_string(),
    }
}

/// Whether a name leads to no file: so named, the input is wrong.
pub fn leads_nowhere(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory)
}
