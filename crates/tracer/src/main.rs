//! The program `tracer`.

#[cfg(all(target_os = "linux", target_env = "gnu"))]
mod large_blocks;
#[cfg(all(target_os = "linux", target_env = "gnu"))]
mod out_of_memory;

use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        large_blocks::give_back();
        out_of_memory::listen();
    }
    tracer::main()
}
