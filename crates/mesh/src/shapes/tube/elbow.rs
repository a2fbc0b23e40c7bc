//! Where two pieces of a path meet: the circles between theirs, and the seam in which they meet on the inner side.
//!
//! The piece that comes ends, and the one that leaves begins, in a circle on the ball of the joint: n . t = -s, with t
//! its direction and s its slope. What of the ball is beyond both (n . t + s > 0 of the one that comes, < 0 of the one
//! that leaves) shows; what is within both is hidden. The circles from one to the other pass over the first once
//! outwards and over the second once inwards, and over nothing else: so the surface has an inside that is what the
//! balls pass over, however sharp the turn and however short the pieces.

use super::super::axis::cross;
use super::{Joint, Side, across, add, blend};
use scene_format::path::{Point3, dot, length, turn, unit};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Directions that turn by less are one: curves are smooth but for rounding.
pub const SMOOTH: f64 = 1e-6;

/// Directions that turn by less than this short of half a turn turn straight back.
const BACK: f64 = 1e-9;

/// Normals that a seam turns about their piece by more than this would bend it: there is none.
const BENT: f64 = 0.5;

/// Normals within this of a circle are on it.
const ONE: f64 = 1e-9;

/// A circle on the ball of a joint.
#[derive(Clone, Copy, Debug)]
pub struct Circle {
    pub side: Side,
    /// Length on the ball from the first circle, where it shows.
    pub along: f64,
}

/// The circles of a joint; one where the path is smooth there.
pub fn circles(joint: &Joint, segments: u32) -> Vec<Circle> {
    let [coming, leaving] = joint.sides;
    let (theta, [from, to]) = (turn(coming.direction, leaving.direction), [coming.lean, leaving.lean]);
    let step = TAU / f64::from(segments);
    if theta + (to - from).abs() < SMOOTH {
        let direction = unit(add(coming.direction, leaving.direction, 1.0)).unwrap_or(coming.direction);
        return vec![Circle { side: Side { direction, lean: 0.5 * (from + to) }, along: 0.0 }];
    }
    let second = unit(add(leaving.direction, coming.direction, -libm::cos(theta)));
    let second = second.unwrap_or_else(|| across(coming.direction));
    // In the plane of both directions.
    let direction = |[x, y]: [f64; 2]| blend(coming.direction, x, second, y);
    if (to - from).abs() >= theta {
        // One circle is within the other.
        let shown = (from - to).max(0.0);
        let count = count((to - from).abs(), step);
        let of = |k: u32| {
            let share = f64::from(k) / f64::from(count);
            let angle = share * theta;
            let side =
                Side { direction: direction([libm::cos(angle), libm::sin(angle)]), lean: from + share * (to - from) };
            Circle { side, along: share * shown * joint.radius }
        };
        return exact((0..=count).map(of).collect(), joint.sides);
    }
    if (from + to).abs() >= PI - theta || theta > PI - BACK {
        return exact(opposed(joint, step), joint.sides);
    }
    // They meet in two points, whose middle is this. All circles pass through these.
    let (sin, cos) = (libm::sin(theta), libm::cos(theta));
    let slopes = [from, to].map(libm::sin);
    let middle = [-slopes[0], (slopes[0] * cos - slopes[1]) / sin];
    let shown = theta + from - to;
    let count = count(shown, step);
    let of = |k: u32| {
        let share = f64::from(k) / f64::from(count);
        let angle = share * shown - FRAC_PI_2 - from;
        let way = [libm::cos(angle) - middle[0], libm::sin(angle) - middle[1]];
        // Across that, forwards.
        let forwards = unit([-way[1], way[0]]).unwrap_or([1.0, 0.0]);
        let slope = -dot(middle, forwards);
        let side = Side { direction: direction(forwards), lean: libm::asin(slope.clamp(-1.0, 1.0)) };
        Circle { side, along: share * shown * joint.radius }
    };
    exact((0..=count).map(of).collect(), joint.sides)
}

/// How many steps an angle has, one at least.
fn count(angle: f64, step: f64) -> u32 {
    (angle / step - 1e-9).ceil().max(1.0) as u32
}

/// The circles of a joint whose path turns back so far that both circles lie apart, each on its side of what shows:
/// the one shrinks to a point, and from the point on the other side the other one grows.
fn opposed(joint: &Joint, step: f64) -> Vec<Circle> {
    let [coming, leaving] = joint.sides;
    let hidden_first = coming.lean + leaving.lean >= 0.0;
    let pole = if hidden_first { FRAC_PI_2 } else { -FRAC_PI_2 };
    let mut circles = Vec::new();
    let mut along = 0.0;
    for (side, ends, shows) in
        [(coming, [coming.lean, pole], !hidden_first), (leaving, [pole, leaving.lean], hidden_first)]
    {
        let angle = (ends[1] - ends[0]).abs();
        let count = count(angle, step);
        for k in 0..=count {
            let share = f64::from(k) / f64::from(count);
            let on = if shows { share * angle * joint.radius } else { 0.0 };
            let lean = ends[0] + share * (ends[1] - ends[0]);
            circles.push(Circle { side: Side { lean, ..side }, along: along + on });
        }
        along += if shows { angle * joint.radius } else { 0.0 };
    }
    circles
}

/// With the sides themselves at the ends, to the bit.
fn exact(mut circles: Vec<Circle>, [coming, leaving]: [Side; 2]) -> Vec<Circle> {
    if let Some(first) = circles.first_mut() {
        first.side = coming;
    }
    if let Some(last) = circles.last_mut() {
        last.side = leaving;
    }
    circles
}

/// Where a line along the tube ends in a joint: how far from it along the path the ball is that it touches there, and
/// the normal.
#[derive(Clone, Copy, Debug)]
pub struct Foot {
    pub along: f64,
    pub normal: Point3,
}

/// Where a line of the one piece goes on as one of the other.
#[derive(Clone, Copy, Debug)]
pub enum Way {
    /// Over the ball.
    Ball,
    /// They meet within the tube, here relative to the joint's place.
    Seam(Point3, [Foot; 2]),
    /// In this one of the points in which the circles meet.
    Point(usize),
}

/// Where the lines of both pieces, that have these normals, meet on the inner side of a joint; `None` where a piece is
/// too short for that: then they lie in each other. `plain`: the normals that they have elsewhere.
///
/// Two cones about one ball meet in a plane.
pub fn seam(
    joint: &Joint,
    lengths: [f64; 2],
    normals: &[[Point3; 2]],
    plain: &[[Point3; 2]],
    meeting: Option<&Meeting>,
) -> Option<Vec<Way>> {
    let [coming, leaving] = joint.sides;
    let ([s, t], r) = (joint.sides.map(|side| libm::sin(side.lean)), joint.radius);
    let uprights = joint.sides.map(|side| libm::cos(side.lean));
    let back = dot(coming.direction, leaving.direction) < 1e-6 - 1.0;
    if back || uprights.iter().any(|upright| *upright < 1e-6) {
        return None;
    }
    let mut ways = Vec::with_capacity(normals.len());
    for (&[one, other], plain) in normals.iter().zip(plain) {
        // How far each is within the other piece.
        let within = [dot(one, leaving.direction) + t, -dot(other, coming.direction) - s];
        let (way, feet) = if within.iter().all(|way| *way < -ONE) {
            ways.push(Way::Ball);
            continue;
        } else if within.iter().all(|way| *way > ONE) {
            let line = blend(coming.direction, 1.0 / uprights[0], one, s / uprights[0]);
            let steep = uprights[1] + dot(line, leaving.direction);
            if steep < 1e-6 {
                return None;
            }
            let along = -r * within[0] / steep;
            let x = blend(one, r, line, along);
            let after = (dot(x, leaving.direction) + t * r) / (uprights[1] * uprights[1]);
            let normal = unit(add(x, leaving.direction, -after))?;
            let feet = [Foot { along: along / uprights[0], normal: one }, Foot { along: after, normal }];
            (Way::Seam(x, feet), feet)
        } else {
            let [p, q] = meeting?.points();
            let nearer = usize::from(dot(one, p) < dot(one, q));
            (Way::Point(nearer), [Foot { along: 0.0, normal: [p, q][nearer] }; 2])
        };
        let short = -feet[0].along > 0.5 * lengths[0] || feet[1].along > 0.5 * lengths[1];
        let bent = (0..2).any(|k| {
            let round = |n: Point3| add(n, joint.sides[k].direction, -dot(n, joint.sides[k].direction));
            turn(round(feet[k].normal), round(plain[k])) > BENT
        });
        if short || bent {
            return None;
        }
        ways.push(way);
    }
    Some(ways)
}

/// The two points of a joint's ball in which the circles of both pieces meet, and lines that go through them.
pub struct Meeting {
    /// Half way between.
    middle: Point3,
    /// Across the plane of both pieces.
    axis: Point3,
    off: f64,
    /// The angle from the inner side at which lines go through them.
    angle: f64,
}

impl Meeting {
    pub fn new(joint: &Joint) -> Option<Self> {
        let [coming, leaving] = joint.sides;
        let axis = cross(coming.direction, leaving.direction);
        let (sin, cos) = (length(axis), dot(coming.direction, leaving.direction));
        let axis = unit(axis)?;
        let [s, t] = joint.sides.map(|side| libm::sin(side.lean));
        let (x, y) = ((t * cos - s) / (sin * sin), (s * cos - t) / (sin * sin));
        let middle = blend(coming.direction, x, leaving.direction, y);
        let off = (1.0 - dot(middle, middle)).max(0.0).sqrt();
        if off.is_nan() || off < 1e-6 {
            return None;
        }
        let mut meeting = Meeting { middle, axis, off, angle: 0.0 };
        // Half way between where they are on both circles: each is turned as little as can be.
        meeting.angle = 0.5 * joint.sides.iter().map(|side| meeting.angle_on(side)).sum::<f64>();
        Some(meeting)
    }

    pub fn points(&self) -> [Point3; 2] {
        [self.off, -self.off].map(|off| add(self.middle, self.axis, off))
    }

    /// Their angle from the inner side on a circle.
    fn angle_on(&self, side: &Side) -> f64 {
        libm::atan2(self.off, dot(self.middle, cross(self.axis, side.direction)))
    }

    /// What is across on a circle, turned so that what is at `angle` comes to one of the points.
    pub fn turned(&self, side: &Side, across: Point3) -> Point3 {
        let inner = cross(self.axis, side.direction);
        let angle = libm::atan2(dot(across, self.axis), dot(across, inner));
        let (here, from) = (self.angle_on(side), angle.abs());
        let to = match from < self.angle {
            true => from * here / self.angle,
            false => here + (from - self.angle) * (PI - here) / (PI - self.angle),
        };
        let to = to.copysign(angle);
        blend(inner, libm::cos(to), self.axis, libm::sin(to))
    }
}
