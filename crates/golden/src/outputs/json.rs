//! The run as one JSON object.

use super::{counts, flip_numbers, whole};
use crate::noise::Finding;
use crate::outcome::{Outcome, Verdict};
use serde::Serialize;

/// Raised when a field changes its meaning or goes; new fields may come without that.
pub const VERSION: u32 = 1;

#[derive(Serialize)]
struct Report<'a> {
    golden_version: u32,
    passed: usize,
    failed: usize,
    scenes: Vec<Scene<'a>>,
}

#[derive(Serialize)]
struct Scene<'a> {
    folder: &'a str,
    name: &'a str,
    file: String,
    verdict: &'static str,
    passed: bool,
    message: String,
    probability: Option<f64>,
    findings: &'a [Finding],
    flip_mean: Option<f64>,
    flip_max: Option<f64>,
    seconds: f64,
}

/// Its text.
///
/// # Errors
/// When a number has no place in JSON, which none of these is.
pub fn report(outcomes: &[Outcome]) -> Result<String, serde_json::Error> {
    let [passed, failed] = counts(outcomes);
    let scenes = outcomes.iter().map(|outcome| {
        let flip = flip_numbers(outcome.flip.as_ref());
        let (probability, findings) = match &outcome.verdict {
            Verdict::WithinNoise { probability } => (Some(*probability), &[][..]),
            Verdict::Different { findings, .. } => (findings.first().map(|finding| finding.probability), &findings[..]),
            _ => (None, &[][..]),
        };
        Scene {
            folder: &outcome.folder,
            name: &outcome.name,
            file: outcome.file.display().to_string(),
            verdict: outcome.verdict.word(),
            passed: outcome.verdict.passes(),
            message: whole(outcome),
            probability,
            findings,
            flip_mean: flip.map(|flip| flip[0]),
            flip_max: flip.map(|flip| flip[1]),
            seconds: outcome.seconds,
        }
    });
    let report = Report { golden_version: VERSION, passed, failed, scenes: scenes.collect() };
    Ok(serde_json::to_string_pretty(&report)? + "\n")
}
