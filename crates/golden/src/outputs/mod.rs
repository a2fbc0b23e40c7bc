//! What is told of a run: to people in lines and a page, to programs as JSON, JUnit's XML and annotations.

pub mod github;
pub mod html;
pub mod json;
pub mod junit;
pub mod lines;

use crate::outcome::{Flip, Outcome, Verdict};

/// How many passed, and how many did not.
pub fn counts(outcomes: &[Outcome]) -> [usize; 2] {
    let passed = outcomes.iter().filter(|outcome| outcome.verdict.passes()).count();
    [passed, outcomes.len() - passed]
}

/// For a place that shows numbers: FLIP's mean and largest.
fn flip_numbers(flip: Option<&Flip>) -> Option<[f64; 2]> {
    flip.map(|flip| [flip.mean, flip.max])
}

/// Everything that is said of a failure: the sentence, then what else there is.
fn whole(outcome: &Outcome) -> String {
    match &outcome.verdict {
        Verdict::Wrong { what } => what.clone(),
        _ => outcome.sentence(),
    }
}
