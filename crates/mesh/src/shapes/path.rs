//! Points of a plane joined by straight lines or by a curve, cut into straight pieces that know the curve's directions.

#![expect(clippy::indexing_slicing, reason = "points are numbered by the path itself")]

use scene_format::desc::Curve;

/// A point of the plane.
pub type Point = [f64; 2];

/// Pieces that turn by more than this where they meet have an edge there: the cosine of 40 degrees.
const EDGE: f64 = 0.766_044_443_118_978;

/// A span of a curve is cut in two so often at most.
const MOST_CUTS: u32 = 8;

/// A straight piece of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Where it begins.
    pub from: Point,
    /// Where it ends.
    pub to: Point,
    /// Which way the path goes at both ends, of unit length.
    pub directions: [Point; 2],
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
}

pub fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub fn length(a: Point) -> f64 {
    libm::hypot(a[0], a[1])
}

/// Of unit length; `None` for the zero vector.
pub fn unit(a: Point) -> Option<Point> {
    let length = length(a);
    (length > 0.0).then(|| [a[0] / length, a[1] / length])
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

/// Cuts the path through these points, no two neighbours of which are equal, into pieces that turn by at most `step` (radians) each.
pub fn pieces(points: &[Point], ends: Ends, curve: Curve, step: f64) -> Vec<Piece> {
    let count = points.len();
    let spans = if ends == Ends::Joined { count } else { count - 1 };
    let mut pieces = Vec::new();
    for k in 0..spans {
        let (from, to) = (points[k], points[(k + 1) % count]);
        if curve == Curve::Linear {
            let direction = unit(sub(to, from)).unwrap_or_default();
            pieces.push(Piece { from, to, directions: [direction; 2], number: k });
            continue;
        }
        // Beyond an end: of its mirror image on the axis, else straight on.
        let beyond = |end: Point, inner: Point| match end[0] == 0.0 {
            true => [-inner[0], inner[1]],
            false => [2.0 * end[0] - inner[0], 2.0 * end[1] - inner[1]],
        };
        let before = match k {
            0 if ends == Ends::Mirrored => beyond(from, to),
            _ => points[(k + count - 1) % count],
        };
        let after = match k + 2 {
            next if next >= count && ends == Ends::Mirrored => beyond(to, from),
            next => points[next % count],
        };
        Span::new([before, from, to, after]).cut(step, k, &mut pieces);
    }
    pieces
}

/// A cubic from `from` to `to`.
struct Span {
    from: Point,
    to: Point,
    /// Derivatives at both ends.
    slopes: [Point; 2],
}

impl Span {
    /// Centripetal Catmull-Rom between the two points in the middle (Yuksel, Schaefer, Keyser: "Parameterization and applications of
    /// Catmull-Rom curves", 2011), as Hermite's cubic.
    fn new([a, b, c, d]: [Point; 4]) -> Span {
        let knots = [sub(b, a), sub(c, b), sub(d, c)].map(|side| length(side).sqrt());
        let slope = |axis: usize, p: [Point; 3], [first, second]: [f64; 2]| {
            let [p, q, r] = p.map(|point| point[axis]);
            let chord = |from: f64, to: f64, time: f64| if time > 0.0 { (to - from) / time } else { 0.0 };
            knots[1] * (chord(p, q, first) - chord(p, r, first + second) + chord(q, r, second))
        };
        let slopes = [[a, b, c], [b, c, d]]
            .into_iter()
            .zip([[knots[0], knots[1]], [knots[1], knots[2]]])
            .map(|(points, times)| [0, 1].map(|axis| slope(axis, points, times)));
        let slopes: Vec<Point> = slopes.collect();
        Span { from: b, to: c, slopes: [slopes[0], slopes[1]] }
    }

    fn at(&self, t: f64) -> Point {
        let (t2, t3) = (t * t, t * t * t);
        let weights = [2.0 * t3 - 3.0 * t2 + 1.0, t3 - 2.0 * t2 + t, 3.0 * t2 - 2.0 * t3, t3 - t2];
        self.sum(weights)
    }

    fn direction(&self, t: f64) -> Point {
        let t2 = t * t;
        let weights = [6.0 * t2 - 6.0 * t, 3.0 * t2 - 4.0 * t + 1.0, 6.0 * t - 6.0 * t2, 3.0 * t2 - 2.0 * t];
        let along = unit(self.sum(weights)).or_else(|| unit(sub(self.to, self.from)));
        along.unwrap_or_default()
    }

    fn sum(&self, weights: [f64; 4]) -> Point {
        let of = [self.from, self.slopes[0], self.to, self.slopes[1]];
        [0, 1].map(|axis| (0..4).map(|k| weights[k] * of[k][axis]).sum())
    }

    fn cut(&self, step: f64, number: usize, pieces: &mut Vec<Piece>) {
        let turn = |a: Point, b: Point| libm::atan2((a[0] * b[1] - a[1] * b[0]).abs(), dot(a, b));
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
