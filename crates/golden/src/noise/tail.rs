//! Pixels far out: whether the largest differences go beyond the tail that all others make.

/// Groups of so many largest differences are looked at.
const GROUPS: [usize; 3] = [1, 2, 4];

/// Differences that tell the tail: a twentieth of all, from 24 to 400.
fn tail_length(all: usize) -> usize {
    (all / 20).clamp(24, 400)
}

/// A gap in the largest differences that is too wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// How many lie above it.
    pub above: usize,
    /// How many times wider the smallest above is than the largest below.
    pub ratio: f64,
    /// The probability of a gap as wide or wider.
    pub probability: f64,
}

/// Looks for a gap; `differences` are positive, in descending order. `None` where too few are there to tell a tail.
///
/// Of Pareto tails (and the heaviest of all light ones are theirs; Gaussian ones are lighter and steepen further out)
/// the logarithms are
/// exponential, and j times the j-th gap between them is exponential of one and the same mean for all j, each
/// independent of all others
/// (Rényi 1953). The mean comes of the gaps below (Hill 1975), and the gap above is compared with it: with k of them
/// the
/// probability of one as wide is (1 + gap / (k mean))^-k.
pub fn widest_gap(differences: &[f64]) -> Option<Gap> {
    let length = tail_length(differences.len());
    let most = GROUPS[GROUPS.len() - 1];
    if differences.len() < 2 * (length + most) {
        return None;
    }
    let gap = |j: usize| j as f64 * libm::log(differences[j - 1] / differences[j]);
    let of_group = |above: usize| {
        let sum: f64 = (above + 1..=above + length).map(gap).sum();
        let ratio = differences[above - 1] / differences[above];
        let probability = if sum > 0.0 { libm::pow(1.0 + gap(above) / sum, -(length as f64)) } else { 1.0 };
        Gap { above, ratio, probability: (probability * GROUPS.len() as f64).min(1.0) }
    };
    GROUPS.into_iter().map(of_group).min_by(|a, b| a.probability.total_cmp(&b.probability))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers in (0, 1) by SplitMix64.
    fn uniform(state: &mut u64) -> f64 {
        *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = *state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64 + 1e-17
    }

    fn drawn(seed: u64, count: usize, of: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut state = seed;
        let mut numbers: Vec<f64> = (0..count).map(|_| of(uniform(&mut state))).collect();
        numbers.sort_by(|a, b| b.total_cmp(a));
        numbers
    }

    /// Of 4000 drawings of Pareto's distribution with its heaviest index as many as promised have such a gap: 40, with
    /// a standard
    /// deviation of 6.3, and fewer for what the three groups have in common.
    #[test]
    fn gaps_are_as_rare_as_promised() {
        for index in [0.5, 1.0, 3.0] {
            let found = (0..4000u64)
                .filter(|&seed| {
                    let numbers = drawn(seed * 77, 1500, |u| u.powf(-1.0 / index));
                    widest_gap(&numbers).expect("enough").probability < 0.01
                })
                .count();
            assert!((10..40 + 4 * 7).contains(&found), "{index}: {found}");
        }
    }

    /// Lighter tails give fewer.
    #[test]
    fn light_tails_are_not_mistaken() {
        let found = (0..2000u64)
            .filter(|&seed| {
                let numbers = drawn(seed, 1500, |u| (-u.ln()).sqrt());
                widest_gap(&numbers).expect("enough").probability < 0.01
            })
            .count();
        assert!(found < 20, "{found}");
    }

    #[test]
    fn one_ten_times_above_is_found() {
        let mut numbers = drawn(5, 1500, |u| (-u.ln()).sqrt());
        let above = 10.0 * numbers[0];
        numbers.insert(0, above);
        let gap = widest_gap(&numbers).expect("enough");
        assert!(gap.above == 1 && (gap.ratio - 10.0).abs() < 1e-9 && gap.probability < 1e-5, "{gap:?}");
        assert_eq!(widest_gap(&numbers[..40]), None);
    }
}
