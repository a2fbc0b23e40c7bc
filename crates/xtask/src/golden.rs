//! Accepting golden pictures.

use anyhow::{Context as _, bail};
use std::io::Write as _;
use std::path::Path;

/// Copies what `tests/goldens.rs` made last over the golden pictures, and notes the reason.
///
/// # Errors
/// When the reason is empty, a case has no new picture, or a file cannot be written.
pub fn accept(root: &Path, cases: &[String], reason: &str) -> anyhow::Result<()> {
    let reason = reason.trim();
    if reason.is_empty() {
        bail!("say why the new picture is right: --reason \"...\"");
    }
    let log = root.join("golden/log.md");
    let mut log_file = std::fs::OpenOptions::new()
        .append(true)
        .create(true)
        .open(&log)
        .with_context(|| format!("cannot open {}", log.display()))?;
    for case in cases {
        let made = root.join("target/goldens").join(case).join("actual.png");
        let golden = root.join("golden").join(case).with_extension("png");
        if !made.exists() {
            bail!(
                "{case}: no new picture; run `cargo test -p tracer --test goldens` first, it writes one where it fails"
            );
        }
        let change = if golden.exists() { "changed" } else { "new" };
        std::fs::copy(&made, &golden).with_context(|| format!("cannot write {}", golden.display()))?;
        std::fs::remove_dir_all(root.join("target/goldens").join(case)).context("cannot clear the accepted case")?;
        writeln!(log_file, "- {case} ({change}): {reason}")
            .with_context(|| format!("cannot write {}", log.display()))?;
        println!("{case}: {change}");
    }
    Ok(())
}
