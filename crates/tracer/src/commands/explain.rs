//! `tracer explain`: what a diagnostic's code means.

use crate::args::ExplainArgs;
use crate::failure::{Failure, exit};
use scene_format::codes::{CODES, find};
use std::io::Write;
use std::process::ExitCode;

pub(super) fn run(args: &ExplainArgs) -> Result<ExitCode, Failure> {
    let mut out = std::io::stdout().lock();
    match &args.code {
        None => {
            for code in CODES {
                writeln!(out, "{}  {}", code.code, code.title)?;
            }
        }
        Some(asked) => {
            let code = find(asked).ok_or_else(|| {
                Failure::wrong(format!("there is no code `{asked}`; `tracer explain` lists all codes"))
            })?;
            writeln!(out, "{}: {}\n\n{}", code.code, code.title, unindented(code.text))?;
        }
    }
    out.flush()?;
    Ok(ExitCode::from(exit::DONE))
}

/// Doc comments begin each line with a space.
fn unindented(text: &str) -> String {
    text.trim_end().lines().map(|line| line.strip_prefix(' ').unwrap_or(line)).collect::<Vec<_>>().join("\n")
}
