//! Bezier curves, cut into straight pieces that know the curve's directions.

use super::{NEAR, Piece, length, sub, turn, unit};

/// A span is cut in two so often at most: where it turns straight back no cut makes it turn less.
const MOST_CUTS: u32 = 12;

/// Cuts a path of Bezier spans into pieces that turn by at most `step` (radians) each, but for those in which it turns
/// back. `points`: where it begins, then for each span two handles and where it ends; those of no span are all one. It
/// ends early where there would be more than `most` pieces.
pub fn bezier_pieces<const N: usize>(points: &[[f64; N]], step: f64, most: usize) -> Vec<Piece<N>> {
    let mut pieces = Vec::new();
    for (number, span) in points.windows(4).step_by(3).enumerate() {
        let &[a, b, c, d] = span else { continue };
        Bezier::new([a, b, c, d]).cut(step, number, &mut pieces);
        if pieces.len() > most {
            break;
        }
    }
    pieces
}

/// One span.
struct Bezier<const N: usize> {
    points: [[f64; N]; 4],
    /// From each point to the next: a third of the derivative is the quadratic Bezier curve of these.
    legs: [[f64; N]; 3],
    /// Legs, and derivatives, that are not longer have no direction but that of rounding.
    nothing: f64,
}

/// The side of a place from which its direction is asked.
#[derive(Clone, Copy, PartialEq)]
enum Side {
    Coming,
    Leaving,
}

impl<const N: usize> Bezier<N> {
    fn new(points: [[f64; N]; 4]) -> Self {
        let [a, b, c, d] = points;
        let legs = [sub(b, a), sub(c, b), sub(d, c)];
        Bezier { points, legs, nothing: NEAR * legs.map(length).into_iter().fold(0.0, f64::max) }
    }

    /// By de Casteljau.
    fn at(&self, t: f64) -> [f64; N] {
        let [a, b, c, d] = self.points;
        let [ab, bc, cd] = [between(a, b, t), between(b, c, t), between(c, d, t)];
        between(between(ab, bc, t), between(bc, cd, t), t)
    }

    /// The polar form of a third of the derivative: where both are t, that; where they are the ends of a part, the leg
    /// between the part's handles, up to a factor.
    fn leg(&self, s: f64, t: f64) -> [f64; N] {
        let [a, b, c] = self.legs;
        between(between(a, b, s), between(b, c, s), t)
    }

    /// Which way it goes, of unit length. Where it stops, as at an end whose handle is in its place, that is the way in
    /// which it leaves, or has come.
    fn direction(&self, t: f64, side: Side) -> [f64; N] {
        let [a, b, c] = self.legs;
        let bend = between(sub(b, a), sub(c, b), t);
        // Before it stops at t it goes against what it is bent to.
        let bend = if side == Side::Coming { bend.map(|x| -x) } else { bend };
        // It stops, and is not bent: a straight line.
        let straight = sub(sub(c, b), sub(b, a));
        let ways = [self.leg(t, t), bend, straight];
        ways.into_iter().find(|&way| length(way) > self.nothing).and_then(unit).unwrap_or([0.0; N])
    }

    /// By which angle a part turns, at most: as its handles do, which its direction lies between.
    fn turns(&self, begin: f64, end: f64) -> f64 {
        let legs = [self.leg(begin, begin), self.leg(begin, end), self.leg(end, end)];
        let (mut turned, mut last) = (0.0, None);
        for leg in legs.into_iter().filter(|&leg| length(leg) > self.nothing) {
            turned += last.map_or(0.0, |last| turn(last, leg));
            last = Some(leg);
        }
        turned
    }

    fn cut(&self, step: f64, number: usize, pieces: &mut Vec<Piece<N>>) {
        // From the last part to the first.
        let mut parts = vec![(0.0, 1.0, 0)];
        while let Some((begin, end, cuts)) = parts.pop() {
            if cuts < MOST_CUTS && self.turns(begin, end) > step {
                let middle = 0.5 * (begin + end);
                parts.push((middle, end, cuts + 1));
                parts.push((begin, middle, cuts + 1));
                continue;
            }
            // Both ends to the bit.
            let from = if begin == 0.0 { self.points[0] } else { self.at(begin) };
            let to = if end == 1.0 { self.points[3] } else { self.at(end) };
            // One that turns back has no way.
            if from != to {
                let directions = [self.direction(begin, Side::Leaving), self.direction(end, Side::Coming)];
                pieces.push(Piece { from, to, directions, number });
            }
        }
    }
}

fn between<const N: usize>(a: [f64; N], b: [f64; N], t: f64) -> [f64; N] {
    std::array::from_fn(|axis| (1.0 - t) * a[axis] + t * b[axis])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    const STEP: f64 = 0.05;

    fn cut(points: &[[f64; 2]]) -> Vec<Piece<2>> {
        let pieces = bezier_pieces(points, STEP, usize::MAX);
        for pair in pieces.windows(2) {
            assert_eq!(pair[0].to, pair[1].from);
        }
        for piece in &pieces {
            assert!(piece.directions.iter().all(|&way| (length(way) - 1.0).abs() < 1e-12), "{piece:?}");
        }
        pieces
    }

    /// A quarter of a circle as drawing programs make it, off it by 0.03 % at most.
    #[test]
    fn a_quarter_of_a_circle() {
        let k = 4.0 / 3.0 * (2.0_f64.sqrt() - 1.0);
        let pieces = cut(&[[1.0, 0.0], [1.0, k], [k, 1.0], [0.0, 1.0]]);
        assert!((32..=64).contains(&pieces.len()), "{}", pieces.len());
        for piece in &pieces {
            for (at, way) in [piece.from, piece.to].into_iter().zip(piece.directions) {
                assert!((length(at) - 1.0).abs() < 2.8e-4);
                assert!(turn(way, [-at[1], at[0]]) < 2e-3, "{piece:?}");
            }
            assert!(turn(piece.directions[0], piece.directions[1]) <= STEP);
        }
        let whole: f64 = pieces.iter().map(|piece| length(sub(piece.to, piece.from))).sum();
        assert!((whole - FRAC_PI_2).abs() < 1e-3, "{whole}");
    }

    /// An end whose handle is in its place looks at the next point that is not; all along a line is straight.
    #[test]
    fn handles_in_their_places() {
        let [a, b, c] = [[0.1, 0.2], [0.4, 0.9], [1.3, 0.7]];
        let ends = |points: [[f64; 2]; 4]| {
            let pieces = cut(&points);
            [pieces[0].directions[0], pieces[pieces.len() - 1].directions[1]]
        };
        let along = |a: [f64; 2], b: [f64; 2]| unit(sub(b, a)).expect("it has a length");
        assert_eq!(ends([a, a, b, c]), [along(a, b), along(b, c)]);
        assert_eq!(ends([a, b, c, c]), [along(a, b), along(b, c)]);
        for points in [[a, a, c, c], [a, a, a, c], [a, c, c, c]] {
            for (way, line) in ends(points).into_iter().zip([along(a, c); 2]) {
                assert!(turn(way, line) < 1e-15, "{points:?}: {way:?}");
            }
            assert_eq!(cut(&points).len(), 1, "{points:?}");
        }
    }

    /// Cusps, loops, and lines that turn back, once or where three directions do not tell: what is passed is all there.
    #[test]
    fn what_turns_back_is_passed() {
        let reach = |points: [[f64; 2]; 4]| {
            let pieces = cut(&points);
            let all = pieces.iter().flat_map(|piece| [piece.from[0], piece.to[0]]);
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
        };
        let on = |x: f64| [x, 0.0];
        // Out and back: 3 t (1 - t).
        assert_eq!(reach([on(0.0), on(1.0), on(1.0), on(0.0)]), (0.0, 0.75));
        // dx/dt = 3 (t - 0.1) (t - 0.4), with x(0.4) = -0.008 and x(1) = 0.37: the legs are its polar form.
        let leg = |s: f64, t: f64| s * t - 0.25 * (s + t) + 0.04;
        let [first, second, third] = [leg(0.0, 0.0), leg(0.0, 1.0), leg(1.0, 1.0)];
        let points = [0.0, first, first + second, first + second + third];
        let (low, high) = reach(points.map(on));
        assert!((low + 0.008).abs() < 1e-6 && (high - 0.37).abs() < 1e-12, "{low} {high}");
        // A cusp in the middle, which it comes to upwards and leaves downwards.
        let cusp = cut(&[[0.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]);
        let at = cusp.iter().position(|piece| piece.to == [0.5, 0.75]).expect("it is cut there");
        assert!(turn(cusp[at].directions[1], [0.0, 1.0]) < 1e-12);
        assert!(turn(cusp[at + 1].directions[0], [0.0, -1.0]) < 1e-12);
        // A loop turns by more than half a turn.
        let round = cut(&[[0.0, 0.0], [3.0, 2.0], [-2.0, 2.0], [1.0, 0.0]]);
        let turned: f64 = round.iter().map(|piece| turn(piece.directions[0], piece.directions[1])).sum();
        assert!(turned > PI, "{turned}");
    }
}
