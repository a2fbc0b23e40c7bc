//! The program `tracer`.

#[cfg(target_os = "linux")]
mod large_blocks;
#[cfg(target_os = "linux")]
mod out_of_memory;

use std::process::ExitCode;

fn main() -> ExitCode {
    #[cfg(target_os = "linux")]
    {
        large_blocks::give_back();
        out_of_memory::listen();
    }
    tracer::main()
}
