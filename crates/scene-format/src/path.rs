//! Points of a plane joined by straight lines or by a curve, cut into straight pieces that know the curve's directions.

mod bezier;

pub use bezier::bezier_pieces;

/// A point of the plane.
pub type Point = [f64; 2];

/// A point of space.
pub type Point3 = [f64; 3];

/// Pieces that turn by more than this where they meet have an edge there: the cosine of 40 degrees.
const EDGE: f64 = 0.766_044_443_118_978;

/// A span of a curve is cut in two so often at most.
const MOST_CUTS: u32 = 8;

/// A straight piece of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece<const N: usize = 2> {
    /// Where it begins.
    pub from: [f64; N],
    /// Where it ends.
    pub to: [f64; N],
    /// Which way the path goes at both ends, of unit length.
    pub directions: [[f64; N]; 2],
    /// The number of the written point that it begins at or after.
    pub number: usize,
}

/// What the path does beyond its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ends {
    /// It goes on at its first point.
    Joined,
    /// It ends. Ends on the line x = 0 are where the path meets its own mirror image.
    Mirrored,
    /// It ends.
    Open,
}

/// a - b.
pub fn sub<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

/// a . b.
pub fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    (1..N).fold(a[0] * b[0], |sum, axis| sum + a[axis] * b[axis])
}

/// Its length.
pub fn length<const N: usize>(a: [f64; N]) -> f64 {
    a[1..].iter().fold(a[0].abs(), |length, &x| libm::hypot(length, x))
}

/// Of unit length; `None` for the zero vector.
pub fn unit<const N: usize>(a: [f64; N]) -> Option<[f64; N]> {
    let length = length(a);
    (length > 0.0).then(|| a.map(|x| x / length))
}

/// By which angle one turns into the other, of any lengths.
pub fn turn<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    let pairs = (0..N).flat_map(|i| (i + 1..N).map(move |j| (i, j)));
    let across = pairs.fold(0.0, |sum, (i, j)| libm::hypot(sum, a[i] * b[j] - a[j] * b[i]));
    libm::atan2(across, dot(a, b))
}

/// The direction half way where two pieces meet; `None` where there is an edge.
pub fn smooth(before: Point, after: Point) -> Option<Point> {
    if dot(before, after) < EDGE { None } else { unit([before[0] + after[0], before[1] + after[1]]) }
}

/// The size of the box around points.
pub fn extent(points: &[Point]) -> f64 {
    let along = |axis: usize| {
        let (low, high) = points
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p[axis]), high.max(p[axis])));
        high - low
    };
    along(0).max(along(1))
}

/// Points nearer than this share of the size of what they are points of are one.
pub const NEAR: f64 = 1e-12;

/// The numbers of the points that are left where each one that repeats the last is dropped, and where `ring`, those at
/// the end that repeat the first. `size`: of the whole that they are points of.
pub fn distinct<const N: usize>(points: &[[f64; N]], size: f64, ring: bool) -> Vec<usize> {
    let one = |a: usize, b: usize| {
        let apart = (0..N).map(|axis| points[a][axis] - points[b][axis]);
        apart.fold(0.0, libm::hypot) <= NEAR * size
    };
    let mut kept: Vec<usize> = Vec::with_capacity(points.len());
    for k in 0..points.len() {
        if kept.last().is_none_or(|&last| !one(k, last)) {
            kept.push(k);
        }
    }
    while ring && kept.len() > 1 && one(kept[0], kept[kept.len() - 1]) {
        kept.pop();
    }
    kept
}

/// Cuts the path through these points, no two neighbours of which are equal, into pieces: straight ones, or of a
/// centripetal Catmull-Rom curve those that turn by at most `step` (radians) each.
pub fn pieces<const N: usize>(points: &[[f64; N]], ends: Ends, curved: bool, step: f64) -> Vec<Piece<N>> {
    let mut pieces = Vec::new();
    if curved {
        spans(points, ends).enumerate().for_each(|(k, span)| span.cut(step, k, &mut pieces));
        return pieces;
    }
    let count = points.len();
    for k in 0..if ends == Ends::Joined { count } else { count - 1 } {
        let (from, to) = (points[k], points[(k + 1) % count]);
        let direction = unit(sub(to, from)).unwrap_or([0.0; N]);
        pieces.push(Piece { from, to, directions: [direction; 2], number: k });
    }
    pieces
}

/// The least x of the curve through these points, between each of them and the next.
pub fn least_x(points: &[Point], ends: Ends) -> Vec<f64> {
    spans(points, ends).map(|span| span.least_x()).collect()
}

/// The spans of the curve through points.
fn spans<const N: usize>(points: &[[f64; N]], ends: Ends) -> impl Iterator<Item = Span<N>> {
    let count = points.len();
    let spans = if ends == Ends::Joined { count } else { count - 1 };
    (0..spans).map(move |k| {
        let (from, to) = (points[k], points[(k + 1) % count]);
        // Beyond an end: of its mirror image on the axis, else straight on.
        let beyond = |end: [f64; N], inner: [f64; N]| match ends == Ends::Mirrored && end[0] == 0.0 {
            true => std::array::from_fn(|axis| if axis == 0 { -inner[axis] } else { inner[axis] }),
            false => std::array::from_fn(|axis| 2.0 * end[axis] - inner[axis]),
        };
        let before = match k {
            0 if ends != Ends::Joined => beyond(from, to),
            _ => points[(k + count - 1) % count],
        };
        let after = match k + 2 {
            next if next >= count && ends != Ends::Joined => beyond(to, from),
            next => points[next % count],
        };
        Span::new([before, from, to, after])
    })
}

/// A cubic from `from` to `to`.
struct Span<const N: usize> {
    from: [f64; N],
    to: [f64; N],
    /// Derivatives at both ends.
    slopes: [[f64; N]; 2],
}

impl<const N: usize> Span<N> {
    /// Centripetal Catmull-Rom between the two points in the middle (Yuksel, Schaefer, Keyser: "Parameterization and
    /// applications of Catmull-Rom curves", 2011), as Hermite's cubic.
    fn new([a, b, c, d]: [[f64; N]; 4]) -> Self {
        let knots = [sub(b, a), sub(c, b), sub(d, c)].map(|side| length(side).sqrt());
        let slope = |axis: usize, p: [[f64; N]; 3], [first, second]: [f64; 2]| {
            let [p, q, r] = p.map(|point| point[axis]);
            let chord = |from: f64, to: f64, time: f64| if time > 0.0 { (to - from) / time } else { 0.0 };
            knots[1] * (chord(p, q, first) - chord(p, r, first + second) + chord(q, r, second))
        };
        let slopes = [[a, b, c], [b, c, d]]
            .into_iter()
            .zip([[knots[0], knots[1]], [knots[1], knots[2]]])
            .map(|(points, times)| std::array::from_fn(|axis| slope(axis, points, times)));
        let slopes: Vec<[f64; N]> = slopes.collect();
        Span { from: b, to: c, slopes: [slopes[0], slopes[1]] }
    }

    fn at(&self, t: f64) -> [f64; N] {
        let (t2, t3) = (t * t, t * t * t);
        let weights = [2.0 * t3 - 3.0 * t2 + 1.0, t3 - 2.0 * t2 + t, 3.0 * t2 - 2.0 * t3, t3 - t2];
        self.sum(weights)
    }

    fn direction(&self, t: f64) -> [f64; N] {
        let t2 = t * t;
        let weights = [6.0 * t2 - 6.0 * t, 3.0 * t2 - 4.0 * t + 1.0, 6.0 * t - 6.0 * t2, 3.0 * t2 - 2.0 * t];
        let (along, chord) = (self.sum(weights), sub(self.to, self.from));
        if length(along) > NEAR * length(chord) {
            return unit(along).unwrap_or([0.0; N]);
        }
        // It stops to turn straight back: it comes, or leaves, as it bends there.
        let sign = if t > 0.5 { -1.0 } else { 1.0 };
        let weights = [12.0 * t - 6.0, 6.0 * t - 4.0, 6.0 - 12.0 * t, 6.0 * t - 2.0].map(|weight| sign * weight);
        unit(self.sum(weights)).or_else(|| unit(chord)).unwrap_or([0.0; N])
    }

    fn sum(&self, weights: [f64; 4]) -> [f64; N] {
        let of = [self.from, self.slopes[0], self.to, self.slopes[1]];
        std::array::from_fn(|axis| (0..4).map(|k| weights[k] * of[k][axis]).sum())
    }

    /// The least x on it: at its ends, or where it turns back.
    fn least_x(&self) -> f64 {
        let ([p, m], [q, n]) = ([self.from[0], self.slopes[0][0]], [self.to[0], self.slopes[1][0]]);
        // The derivative is a t^2 + 2 b t + m.
        let (a, b) = (6.0 * (p - q) + 3.0 * (m + n), 3.0 * (q - p) - 2.0 * m - n);
        let root = (b * b - a * m).max(0.0).sqrt();
        // Either of the two has no difference of near numbers in it.
        let far = -b - root.copysign(b);
        let turns = [far / a, m / far].into_iter().filter(|t| *t > 0.0 && *t < 1.0);
        turns.map(|t| self.at(t)[0]).fold(p.min(q), f64::min)
    }

    fn cut(&self, step: f64, number: usize, pieces: &mut Vec<Piece<N>>) {
        // From the last part to the first.
        let mut parts = vec![(0.0, 1.0, 0)];
        while let Some((begin, end, cuts)) = parts.pop() {
            let middle = 0.5 * (begin + end);
            let [first, half, last] = [begin, middle, end].map(|t| self.direction(t));
            if cuts < MOST_CUTS && turn(first, half) + turn(half, last) > step {
                parts.push((middle, end, cuts + 1));
                parts.push((begin, middle, cuts + 1));
                continue;
            }
            // Both ends to the bit.
            let from = if begin == 0.0 { self.from } else { self.at(begin) };
            let to = if end == 1.0 { self.to } else { self.at(end) };
            pieces.push(Piece { from, to, directions: [first, last], number });
        }
    }
}

/// A place in words, rounded to five digits.
pub fn shown(place: &[f64]) -> String {
    let rounded = place.iter().map(|x| format!("{x:.4e}").parse().unwrap_or(*x) + 0.0);
    let words: Vec<String> = rounded.map(|x| format!("{x}")).collect();
    format!("({})", words.join(", "))
}

/// Two straight sides that cross, by their numbers, and where.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The sides.
    pub sides: [usize; 2],
    /// How far along the first of them.
    pub along: f64,
    /// The place.
    pub at: Point,
}

/// Pairs of sides that are looked at, at most: a fraction of a second.
const MOST_PAIRS: usize = 2_000_000;

/// Shows the pairs of sides whose boxes meet, the smaller number first; whether all were shown: there may be too many
/// to tell soon.
fn near(sides: &[[Point; 2]], mut show: impl FnMut([usize; 2])) -> bool {
    let low = |k: usize, axis: usize| sides[k][0][axis].min(sides[k][1][axis]);
    let high = |k: usize, axis: usize| sides[k][0][axis].max(sides[k][1][axis]);
    let mut order: Vec<usize> = (0..sides.len()).collect();
    order.sort_by(|&a, &b| low(a, 0).total_cmp(&low(b, 0)));
    let mut pairs = 0;
    for (place, &one) in order.iter().enumerate() {
        for &other in order[place + 1..].iter().take_while(|&&other| low(other, 0) <= high(one, 0)) {
            pairs += 1;
            if pairs > MOST_PAIRS {
                return false;
            }
            if low(other, 1) <= high(one, 1) && low(one, 1) <= high(other, 1) {
                show([one.min(other), one.max(other)]);
            }
        }
    }
    true
}

/// The first two sides that cross within both of them; `None` also where there are too many to tell soon. Sides that
/// only touch do not cross.
pub fn crossing(sides: &[[Point; 2]]) -> Option<Crossing> {
    let mut found: Option<Crossing> = None;
    let all = near(sides, |numbers| {
        if found.is_none_or(|found| numbers < found.sides)
            && let Some((along, at)) = meet(sides[numbers[0]], sides[numbers[1]])
        {
            found = Some(Crossing { sides: numbers, along, at });
        }
    });
    found.filter(|_| all)
}

/// Where two sides cross, and how far along the first.
fn meet([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Option<(f64, Point)> {
    let area = |p: Point, q: Point, r: Point| {
        let ([x, y], [z, w]) = (sub(q, p), sub(r, p));
        x * w - y * z
    };
    let size = length(sub(b, a)).max(length(sub(d, c))).max(length(sub(c, a)));
    // Less than this is rounding: it touches.
    let sign = |area: f64| if area.abs() <= NEAR * size * size { 0.0 } else { area.signum() };
    let of_first = [area(c, d, a), area(c, d, b)];
    let of_second = [area(a, b, c), area(a, b, d)];
    if [of_first, of_second].iter().any(|[p, q]| sign(*p) * sign(*q) >= 0.0) {
        return None;
    }
    let t = of_first[0] / (of_first[0] - of_first[1]);
    Some((t, [0, 1].map(|k| a[k] + t * (b[k] - a[k]))))
}

/// On which side of the line from `a` to `b` a point is, exactly: more than zero to the left.
pub(crate) fn orientation(a: Point, b: Point, p: Point) -> f64 {
    let [a, b, p] = [a, b, p].map(|[x, y]| robust::Coord { x, y });
    robust::orient2d(a, b, p)
}

/// The first two sides, by their numbers, of which the second begins on the first: within it, or where it begins too;
/// `None` also where there are too many to tell soon.
pub(crate) fn touching(sides: &[[Point; 2]]) -> Option<[usize; 2]> {
    let begins_on = |[one, other]: [usize; 2]| {
        let ([a, b], [p, _]) = (sides[one], sides[other]);
        let inside = (0..2).all(|axis| a[axis].min(b[axis]) <= p[axis] && p[axis] <= a[axis].max(b[axis]));
        a == p || inside && p != b && orientation(a, b, p) == 0.0
    };
    let mut found: Option<[usize; 2]> = None;
    let all = near(sides, |[one, other]| {
        let way = [[one, other], [other, one]].into_iter().find(|&way| begins_on(way));
        found = way.filter(|&way| found.is_none_or(|found| way < found)).or(found);
    });
    found.filter(|_| all)
}

/// How often a side goes round a point that is not on it, as far as what is to its right is concerned: the sum over a
/// ring is 0 outside.
pub(crate) fn winding([a, b]: [Point; 2], p: Point) -> i32 {
    match (a[1] <= p[1], b[1] <= p[1]) {
        (true, false) if orientation(a, b, p) > 0.0 => 1,
        (false, true) if orientation(a, b, p) < 0.0 => -1,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_x_is_that_of_the_curve() {
        let points = [[0.2, 0.09], [0.05, 0.25], [0.05, 0.8], [0.2, 1.0], [0.5, 1.3], [0.0, 2.0]];
        let all = pieces(&points, Ends::Mirrored, true, 0.001);
        for (k, least) in least_x(&points, Ends::Mirrored).into_iter().enumerate() {
            let cut = all.iter().filter(|piece| piece.number == k);
            let seen = cut.map(|piece| piece.from[0].min(piece.to[0])).fold(f64::INFINITY, f64::min);
            assert!(least <= seen && seen - least < 1e-4, "{k}: {least} {seen}");
        }
        assert_eq!(least_x(&[[1.0, 0.0], [1.0, 1.0]], Ends::Mirrored), [1.0]);
    }

    #[test]
    fn sides_cross_within_both_of_them() {
        let side = |a: [f64; 4]| [[a[0], a[1]], [a[2], a[3]]];
        let found = crossing(&[side([0.0, 0.0, 2.0, 2.0]), side([5.0, 0.0, 6.0, 0.0]), side([0.0, 1.0, 1.0, 0.0])]);
        assert_eq!(found, Some(Crossing { sides: [0, 2], along: 0.25, at: [0.5, 0.5] }));
        let touching = [side([0.0, 0.0, 2.0, 0.0]), side([1.0, 0.0, 1.0, 1.0]), side([2.0, 0.0, 2.0, 1.0])];
        assert_eq!(crossing(&touching), None);
        assert_eq!(crossing(&[side([0.0, 0.0, 1.0, 1.0]), side([0.0, 0.0, 1.0, 1.0])]), None);
    }

    #[test]
    fn places_are_rounded() {
        assert_eq!(shown(&[4.0 / 3.0, -0.0, 1e-7, 12345.678, -2.5]), "(1.3333, 0, 0.0000001, 12346, -2.5)");
    }

    #[test]
    fn repeated_points_are_dropped() {
        let points = [[0.0, 0.0], [0.0, 1e-13], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0]];
        assert_eq!(distinct(&points, 1.0, true), [0, 2, 4]);
        assert_eq!(distinct(&points, 1.0, false), [0, 2, 4, 5]);
    }

    #[test]
    fn sides_that_touch_are_found_exactly() {
        let ring = |points: &[Point]| -> Vec<[Point; 2]> {
            (0..points.len()).map(|k| [points[k], points[(k + 1) % points.len()]]).collect()
        };
        assert_eq!(touching(&ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])), None);
        // A corner on the first side, a corner twice, a side that goes back along the last one.
        assert_eq!(touching(&ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]])), Some([0, 3]));
        let twice = [[0.0, 0.0], [2.0, 2.0], [4.0, 0.0], [4.0, 4.0], [2.0, 2.0], [0.0, 4.0]];
        assert_eq!(touching(&ring(&twice)), Some([1, 4]));
        assert_eq!(touching(&ring(&[[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [2.0, 3.0]])), Some([0, 2]));
        // One rounding off is off.
        let near = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, f64::MIN_POSITIVE], [0.0, 4.0]];
        assert_eq!(touching(&ring(&near)), None);
        let square = ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]);
        let around = |p: Point| square.iter().map(|side| winding(*side, p)).sum::<i32>();
        assert_eq!([[1.0, 1.0], [-1.0, 0.0], [1.0, 4.5], [5.0, 4.0]].map(around), [1, 0, 0, 0]);
    }
}
