//! The program `tracer`.

#[cfg(all(target_os = "linux", target_env = "gnu"))]
mod large_blocks;

use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    large_blocks::give_back();
    tracer::main()
}
