//! A line a scene.

use super::counts;
use crate::outcome::{Outcome, Verdict, accept_command};

/// `ok    room/lamp  equal` and, below it, what a person does next.
pub fn line(outcome: &Outcome) -> String {
    let word = if outcome.verdict.passes() { "ok  " } else { "FAIL" };
    let Outcome { folder, name, .. } = outcome;
    let mut text = format!("{word}  {folder}/{name}: {} ({:.2} s)\n", outcome.sentence(), outcome.seconds);
    if let Verdict::Wrong { what } = &outcome.verdict {
        what.lines().skip(1).for_each(|line| text += &format!("      {line}\n"));
    }
    if matches!(outcome.verdict, Verdict::Missing | Verdict::Different { .. }) {
        text += &format!("      accept it when it is right: {}\n", accept_command(folder, name));
    }
    text
}

/// The last line.
pub fn summary(outcomes: &[Outcome]) -> String {
    let [passed, failed] = counts(outcomes);
    let noisy = outcomes.iter().filter(|outcome| matches!(outcome.verdict, Verdict::WithinNoise { .. })).count();
    let noisy = if noisy > 0 { format!(" ({noisy} within noise)") } else { String::new() };
    format!("{passed} passed{noisy}, {failed} failed\n")
}
