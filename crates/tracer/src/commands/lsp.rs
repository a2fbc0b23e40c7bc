//! `tracer lsp`: the language server of scenes, over standard input and output.

use crate::failure::{Failure, exit};
use std::process::ExitCode;

pub(super) fn run() -> Result<ExitCode, Failure> {
    tracer_lsp::serve_stdio()
        .map_err(|error| Failure::could_not(format!("the editor went away, or speaks no LSP: {error}")))?;
    Ok(ExitCode::from(exit::DONE))
}
