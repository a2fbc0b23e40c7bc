//! What `cargo xtask truth` prints.

use super::Done;
use super::examine::Fault;
use super::squares::LIMIT;
use std::collections::BTreeMap;
use std::time::Instant;

/// Means that are known to no better than this count as undecided: ten times the tolerance of the picture.
const UNDECIDED: f64 = 0.03;

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
            "{kind:<14}{:>7}{failing:>9}{undecided:>11}{:>10.2} %{:>8.1} %{seconds:>8.1}",
            scenes.len(),
            100.0 * middle(scenes, |scene| scene.examined.told.error),
            100.0 * middle(scenes, |scene| scene.examined.told.tile_error),
        );
    }
    println!("known to: three standard errors and the allowance for rare light, relative; the middle one of its kind");
    for scene in done.iter().filter(|scene| scene.examined.told.error > UNDECIDED) {
        let error = 100.0 * scene.examined.told.error;
        println!("undecided: seed {} ({}), known to {error:.1} %", scene.case.seed, scene.case.kind);
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

fn middle(scenes: &[&Done], of: impl Fn(&Done) -> f64) -> f64 {
    let mut values: Vec<f64> = scenes.iter().map(|scene| of(scene)).collect();
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
