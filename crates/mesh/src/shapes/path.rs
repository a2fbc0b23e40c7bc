//! Points, of a plane or of space, joined by straight lines or by a curve, cut into straight pieces that know the
//! curve's directions.

#![expect(clippy::indexing_slicing, reason = "points are numbered by the path itself")]

use scene_format::desc::Curve;

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

pub fn sub<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

pub fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    (1..N).fold(a[0] * b[0], |sum, axis| sum + a[axis] * b[axis])
}

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

/// Cuts the path through these points, no two neighbours of which are equal, into pieces that turn by at most `step`
/// (radians) each.
pub fn pieces<const N: usize>(points: &[[f64; N]], ends: Ends, curve: Curve, step: f64) -> Vec<Piece<N>> {
    let count = points.len();
    let spans = if ends == Ends::Joined { count } else { count - 1 };
    let mut pieces = Vec::new();
    for k in 0..spans {
        let (from, to) = (points[k], points[(k + 1) % count]);
        if curve == Curve::Linear {
            let direction = unit(sub(to, from)).unwrap_or([0.0; N]);
            pieces.push(Piece { from, to, directions: [direction; 2], number: k });
            continue;
        }
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
        Span::new([before, from, to, after]).cut(step, k, &mut pieces);
    }
    pieces
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
        let along = unit(self.sum(weights)).or_else(|| unit(sub(self.to, self.from)));
        along.unwrap_or([0.0; N])
    }

    fn sum(&self, weights: [f64; 4]) -> [f64; N] {
        let of = [self.from, self.slopes[0], self.to, self.slopes[1]];
        std::array::from_fn(|axis| (0..4).map(|k| weights[k] * of[k][axis]).sum())
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
