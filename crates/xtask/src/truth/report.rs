//! What `cargo xtask truth` prints.

use super::Done;
use super::examine::Fault;
use super::squares::LIMIT;
use std::collections::BTreeMap;
use std::time::Instant;

/// Means that are known to no better than this count as undecided: ten times the tolerance of the picture.
const UNDECIDED: f64 = 0.03;

/// Shares above this are of what is all but black.
const MOST_TOLD: f64 = 100.0;

/// Says what the scene that was done last gave, if that is a finding; and every so often how far it is.
pub(crate) fn progress(done: &[Done], scenes: usize, start: Instant) {
    let Some(last) = done.last() else { return };
    for finding in &last.examined.findings {
        let text = finding.text.replace('\n', "\n    ");
        println!("seed {} ({}): {:?}\n    {text}", last.case.seed, last.case.kind, finding.fault);
    }
    if let Some(path) = &last.kept {
        println!("    kept: {}", path.display());
    }
    if done.len().is_multiple_of(20) || done.len() == scenes {
        let failing = done.iter().filter(|scene| !scene.examined.findings.is_empty()).count();
        println!(
            "{} of {scenes} scenes in {:.0} s, {failing} with findings",
            done.len(),
            start.elapsed().as_secs_f64()
        );
    }
}

/// The tables at the end: by kind of finding and by kind of scene.
pub(crate) fn summary(done: &[Done], start: Instant) {
    let mut faults: BTreeMap<Fault, usize> = BTreeMap::new();
    let mut kinds: BTreeMap<&str, Vec<&Done>> = BTreeMap::new();
    for scene in done {
        kinds.entry(scene.case.kind).or_default().push(scene);
        for finding in &scene.examined.findings {
            *faults.entry(finding.fault).or_default() += 1;
        }
    }
    println!(
        "\n{:<14}{:>7}{:>9}{:>11}{:>12}{:>10}{:>8}",
        "kind", "scenes", "findings", "undecided", "known to", "a tile", "s each"
    );
    for (kind, scenes) in &kinds {
        let failing = scenes.iter().filter(|scene| !scene.examined.findings.is_empty()).count();
        let undecided = scenes.iter().filter(|scene| scene.examined.told.error > UNDECIDED).count();
        let seconds = scenes.iter().map(|scene| scene.seconds).sum::<f64>() / scenes.len() as f64;
        println!(
            "{kind:<14}{:>7}{failing:>9}{undecided:>11}{:>12}{:>10}{seconds:>8.1}",
            scenes.len(),
            percent(middle(scenes, |scene| scene.examined.told.error), 2),
            percent(middle(scenes, |scene| scene.examined.told.tile_error), 1),
        );
    }
    println!("known to: three standard errors and the allowance for rare light, relative; the middle one of its kind");
    for scene in done.iter().filter(|scene| scene.examined.told.error > UNDECIDED) {
        let error = percent(scene.examined.told.error, 1);
        println!("undecided: seed {} ({}), known to {error}", scene.case.seed, scene.case.kind);
    }
    let doubtful = done.iter().filter(|scene| scene.examined.squares > LIMIT).count();
    let asked = done.iter().filter(|scene| scene.examined.squares > 0.0).count();
    println!("squares: the upper bound at 95 % is above {LIMIT} in {doubtful} of {asked} scenes");
    println!("\n{:<14}{:>7}", "finding", "scenes");
    for (fault, count) in &faults {
        println!("{:<14}{count:>7}", format!("{fault:?}"));
    }
    let failing = done.iter().filter(|scene| !scene.examined.findings.is_empty()).count();
    println!("{failing} of {} scenes have findings; {:.0} s", done.len(), start.elapsed().as_secs_f64());
}

/// A share in per cent. Of a picture that is all but black per cents say nothing.
pub(super) fn percent(share: f64, digits: usize) -> String {
    match share.abs() < MOST_TOLD {
        true => format!("{:.digits$} %", 100.0 * share),
        false => "black".to_owned(),
    }
}

/// The same of what is added or missing.
pub(super) fn signed(share: f64, digits: usize) -> String {
    let sign = if share.abs() < MOST_TOLD && share >= 0.0 { "+" } else { "" };
    format!("{sign}{}", percent(share, digits))
}

fn middle(scenes: &[&Done], of: impl Fn(&Done) -> f64) -> f64 {
    let mut values: Vec<f64> = scenes.iter().map(|scene| of(scene)).collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[cfg(test)]
mod tests {
    use super::{percent, signed};

    #[test]
    fn black_scenes_have_no_per_cents() {
        assert_eq!(
            [percent(0.0123, 2), percent(12.5, 1), signed(0.5, 1), signed(-0.5, 0)],
            ["1.23 %", "1250.0 %", "+50.0 %", "-50 %"]
        );
        for absurd in [1e300, 0.1 / f64::MIN_POSITIVE, f64::INFINITY, f64::NAN] {
            assert_eq!([percent(absurd, 2), signed(-absurd, 2)], ["black", "black"]);
        }
    }
}
