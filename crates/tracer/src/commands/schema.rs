//! `tracer schema`: the JSON Schema of scene files.

use crate::failure::{Failure, exit};
use std::io::Write;
use std::process::ExitCode;

pub(super) fn run() -> Result<ExitCode, Failure> {
    let mut out = std::io::stdout().lock();
    out.write_all(scene_format::schema().trim_end().as_bytes())?;
    writeln!(out)?;
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}
