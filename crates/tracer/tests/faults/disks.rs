//! Disks that are really full: small ones in memory, which only root may mount.

use super::cases;
use super::judge::{Quiet, words};
use super::run::Folder;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A disk of so many bytes, mounted.
struct Disk {
    at: PathBuf,
}

impl Disk {
    fn mount(at: &Path, kilobytes: u64) -> Option<Self> {
        let size = format!("size={kilobytes}k");
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", &size, "tmpfs"]).arg(at);
        let is_mounted = mount.output().is_ok_and(|output| output.status.success());
        is_mounted.then(|| Disk { at: at.to_owned() })
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.at).status();
    }
}

/// Disks of all sizes from full to large enough, a block more each time: the end of the disk comes at every place.
#[test]
fn a_disk_is_full() {
    if !super::is_long() {
        return;
    }
    let probe = tempfile::tempdir().expect("a folder");
    if Disk::mount(probe.path(), 64).is_none() {
        println!("SKIPPED: no disk can be mounted here; as root, `cargo xtask prove faults-long` tries full disks");
        return;
    }
    let mut found = Vec::new();
    let mut full = 0;
    for case in cases::all().iter().filter(|case| !case.outputs.is_empty()) {
        let quiet = Quiet::of(case);
        let bytes = case.folder.files().values().map(|bytes| bytes.len().div_ceil(4096) as u64).sum::<u64>();
        let mut done = false;
        for more in 0..64 {
            // Each folder takes none; each file its pages.
            let folder = Folder::new();
            let disk = Disk::mount(&folder.here(), 4 * (bytes + more)).expect("a disk");
            case.folder.copy_into(&folder);
            let ran = folder.run(&words(case), &[("FAULT_AT", "0".to_owned())]);
            full += u32::from(ran.code != Some(0));
            done |= ran.code == Some(0);
            let wrong = quiet.wrong_on_full_disk(case, &folder, &ran);
            if !wrong.is_empty() {
                let said = ran.err.trim();
                found.push(format!("{}, {more} blocks free: {}; it says: {said}", case.name, wrong.join("; ")));
            }
            drop(disk);
            if done {
                break;
            }
        }
        assert!(done, "{}: no disk was large enough", case.name);
    }
    println!("{full} runs on full disks");
    assert!(full > 20 && found.is_empty(), "{full} runs, {} wrong:\n{}", found.len(), found.join("\n"));
}
