//! Every call to the system that concerns a file fails once, in every way that is usual; so does every large block of
//! memory. Then the program ends by itself and says why, no file is half written, and none is lost.
//!
//! A layer between the program and the C library does it (`shim.rs`). `cargo xtask prove faults-long` takes all ways
//! at every call (`FAULTS=long`), and disks that are really full; `cargo xtask prove faults` takes them in turns.
#![cfg(all(target_os = "linux", target_env = "gnu", any(target_arch = "x86_64", target_arch = "aarch64")))]

mod cases;
mod disks;
mod judge;
mod memory;
mod preview;
mod run;

use cases::Case;
use judge::{Fault, Quiet};
use rayon::prelude::*;
use run::Call;

fn is_long() -> bool {
    std::env::var("FAULTS").is_ok_and(|value| value == "long")
}

const EINTR: i32 = 4;
const EIO: i32 = 5;
const EACCES: i32 = 13;
const ENOSPC: i32 = 28;
const EROFS: i32 = 30;

/// The ways in which a call may fail.
fn ways(call: &Call) -> Vec<Fault> {
    let fails = |error: i32| Fault { call: call.number, how: error.to_string(), goes_on: false, is_harmless: false };
    let name = call.name.as_str();
    let mut ways = vec![fails(EIO), fails(EACCES)];
    if call.writes {
        ways.extend([fails(ENOSPC), fails(EROFS), Fault { goes_on: true, ..fails(ENOSPC) }]);
    }
    if ["open", "create", "read", "pread64", "write", "writev", "fsync", "fdatasync", "ftruncate64"].contains(&name) {
        ways.push(Fault { is_harmless: true, ..fails(EINTR) });
    }
    if ["read", "pread64", "write", "writev"].contains(&name) {
        ways.push(Fault { how: "short".to_owned(), is_harmless: true, ..fails(EIO) });
    }
    ways
}

/// Each call of a case fails; what went wrong then.
fn tried(case: &Case) -> (usize, Vec<String>) {
    let quiet = Quiet::of(case);
    let chosen = |(k, call): (usize, &Call)| {
        let mut ways = ways(call);
        if !is_long() {
            // Another way at each call, so that calls that are alike go through them.
            ways = vec![ways.swap_remove((k + case.name.len()) % ways.len())];
        }
        ways
    };
    let faults: Vec<Fault> = quiet.calls.iter().enumerate().flat_map(chosen).collect();
    let wrong = faults.par_iter().filter_map(|fault| quiet.judge(case, fault)).collect();
    (faults.len(), wrong)
}

#[test]
fn every_call_fails() {
    let found: Vec<(usize, Vec<String>)> = cases::all().iter().map(tried).collect();
    let count: usize = found.iter().map(|(count, _)| count).sum();
    let wrong: Vec<String> = found.into_iter().flat_map(|(_, wrong)| wrong).collect();
    println!("{count} calls failed");
    // What is not counted cannot fail.
    assert!(count > 300, "only {count} calls were counted");
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
}
