//! "Did you mean": the nearest word.

/// A word this many edits away is taken for a typo.
const MAX_DISTANCE: usize = 2;

/// The candidate that `word` most probably stands for, if any is near enough.
///
/// Near is: the same but for case and `_`/`-`, or at most two edits (a swap of neighbours is one). Among equals the one
/// that begins alike wins, then the one of nearer length, then the first.
pub fn nearest<'c>(word: &str, candidates: impl IntoIterator<Item = &'c str>) -> Option<&'c str> {
    // Nobody mistypes such a word, and the distance takes quadratic time.
    if word.len() > 64 {
        return None;
    }
    let plain = fold(word);
    let mut best: Option<(Rank, &str)> = None;
    for candidate in candidates {
        if candidate.len() > word.len() + 4 * MAX_DISTANCE || word.len() > candidate.len() + 4 * MAX_DISTANCE {
            continue;
        }
        let folded = fold(candidate);
        let distance = strsim::osa_distance(&plain, &folded);
        if distance > MAX_DISTANCE || distance >= folded.chars().count().max(2) {
            continue;
        }
        let rank = Rank {
            distance,
            unlike: folded.len().max(plain.len()).saturating_sub(
                alike(plain.chars(), folded.chars()) + alike(plain.chars().rev(), folded.chars().rev()).min(3),
            ),
        };
        if best.as_ref().is_none_or(|(best, _)| rank < *best) {
            best = Some((rank, candidate));
        }
    }
    best.map(|(_, word)| word)
}

/// Smaller is nearer.
#[derive(PartialEq, PartialOrd)]
struct Rank {
    distance: usize,
    unlike: usize,
}

/// Length of what two words begin with in common.
fn alike(a: impl Iterator<Item = char>, b: impl Iterator<Item = char>) -> usize {
    a.zip(b).take_while(|(a, b)| a == b).count()
}

fn fold(word: &str) -> String {
    word.chars().filter(|c| !matches!(c, '_' | '-' | ' ')).flat_map(char::to_lowercase).collect()
}

/// a, b and c.
pub(crate) fn join(words: &[&str], last: &str) -> String {
    match words.split_last() {
        None => String::new(),
        Some((only, [])) => (*only).to_owned(),
        Some((end, rest)) => format!("{} {last} {end}", rest.join(", ")),
    }
}

/// `a`, `b` or `c`.
pub(crate) fn list(words: &[&str]) -> String {
    let quoted: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
    match quoted.split_last() {
        None => String::new(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_takes_case_separators_swaps_and_two_edits() {
        let words = ["position", "look_at", "up", "fov"];
        assert_eq!(nearest("Position", words), Some("position"));
        assert_eq!(nearest("lookAt", words), Some("look_at"));
        assert_eq!(nearest("fvo", words), Some("fov"));
        assert_eq!(nearest("posiion", words), Some("position"));
        assert_eq!(nearest("psition_", words), Some("position"));
        assert_eq!(nearest("colour", words), None);
    }

    #[test]
    fn list_reads_as_a_sentence() {
        assert_eq!(list(&["a"]), "`a`");
        assert_eq!(list(&["a", "b", "c"]), "`a`, `b` or `c`");
    }
}
