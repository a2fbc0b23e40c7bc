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
    let sketch = Sketch::new(word);
    let mut best: Option<(Rank, &str)> = None;
    for candidate in candidates {
        if sketch.edits_to(Sketch::new(candidate)) > MAX_DISTANCE {
            continue;
        }
        let folded = fold(candidate);
        let distance = strsim::osa_distance(&plain, &folded);
        // Two letters are not enough to know a word by that differs in two.
        let short = distance > 1 && plain.chars().count() < 3;
        if short || distance > MAX_DISTANCE || distance >= folded.chars().count().max(plain.chars().count()) {
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

/// Whether the digits of two words are the same, as far as both have any: a kind that differs in them is no slip, as
/// `F2` is not `F1`.
pub(crate) fn has_same_number(one: &str, other: &str) -> bool {
    let digits = |word: &str| word.chars().filter(char::is_ascii_digit).collect::<String>();
    let (one, other) = (digits(one), digits(other));
    one.is_empty() || other.is_empty() || one == other
}

/// What of a word tells cheaply that another one is far: most are.
#[derive(Clone, Copy)]
struct Sketch {
    /// Bytes of the folded word, if all are ASCII.
    length: Option<usize>,
    /// Which letters are in it, some of which share a bit.
    letters: u32,
}

impl Sketch {
    fn new(word: &str) -> Sketch {
        let (mut length, mut letters) = (0, 0);
        for byte in word.bytes().filter(|byte| !matches!(byte, b'_' | b'-' | b' ')) {
            // Of letters these five bits are the same in both cases.
            letters |= 1u32 << (byte & 31);
            length += 1;
        }
        Sketch { length: word.is_ascii().then_some(length), letters }
    }

    /// No more edits than between the words: each changes the length by one at most, and the set of letters by two.
    fn edits_to(self, other: Sketch) -> usize {
        let (Some(a), Some(b)) = (self.length, other.length) else { return 0 };
        a.abs_diff(b).max((self.letters ^ other.letters).count_ones().div_ceil(2) as usize)
    }
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
    fn a_sketch_never_rules_out_what_is_near() {
        let words =
            ["position", "look_at", "lookAt", "up", "fov", "Albedo", "radiance", "radius", "räder", "a-b c", ""];
        for a in words {
            for b in words {
                let edits = strsim::osa_distance(&fold(a), &fold(b));
                assert!(Sketch::new(a).edits_to(Sketch::new(b)) <= edits, "{a} {b}");
            }
        }
        assert_eq!(Sketch::new("radiance").edits_to(Sketch::new("position")), 5);
    }

    #[test]
    fn list_reads_as_a_sentence() {
        assert_eq!(list(&["a"]), "`a`");
        assert_eq!(list(&["a", "b", "c"]), "`a`, `b` or `c`");
    }
}
