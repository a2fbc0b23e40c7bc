//! The triangles of a tube, ring by ring.

use super::super::axis::cross;
use super::super::skew::{self, Cut};
use super::elbow::{Circle, Foot, Meeting, Way, seam};
use super::{Joint, Side, across, add, blend, turned};
use crate::data::MeshData;
use scene_format::path::{Point3, dot, length, sub, turn, unit};
use std::f64::consts::{FRAC_PI_2, TAU};

/// A piece has so many rings at most where its lines turn about it.
const MOST_RINGS: f64 = 64.0;

/// Vertices of a line along the tube that are nearer than this share of the radius are one.
const ONE: f64 = 1e-9;

/// A ring of vertices.
struct Ring {
    /// Numbers of their positions.
    positions: Vec<u32>,
    /// Number of the first of as many normals.
    normal: u32,
    /// Number of the first of one texture coordinate more.
    uvs: u32,
    v: f64,
    /// All positions are one.
    is_tip: bool,
    side: Side,
    /// Where the lines of the piece end that it belongs to.
    feet: Vec<Foot>,
}

/// A tube in the making.
pub struct Swept {
    data: MeshData,
    segments: u32,
    closed: bool,
    /// Whether its pieces are straight: then they may meet in seams.
    straight: bool,
}

impl Swept {
    pub fn new(segments: u32, closed: bool, straight: bool) -> Self {
        Swept { data: MeshData::default(), segments, closed, straight }
    }

    /// What the ball passes over. `circles`: of each joint.
    pub fn swept(mut self, joints: &[Joint], circles: &[Vec<Circle>]) -> MeshData {
        let (Some(first), Some(last)) = (joints.first(), joints.last()) else { return self.data };
        // How much of the path, and of the balls that show at joints, is behind each joint.
        let before = if self.closed { 0.0 } else { first.radius * end_angle(first, true) };
        let arc = |circles: &[Circle]| circles.last().map_or(0.0, |circle| circle.along);
        let mut whole = before + last.along + if self.closed { 0.0 } else { last.radius * end_angle(last, false) };
        let inner = 1..if self.closed { joints.len() } else { joints.len() - 1 };
        whole += circles.get(inner).into_iter().flatten().map(|circles| arc(circles)).sum::<f64>();
        let [begin, end] = frames(joints);
        let twist = if self.closed {
            libm::atan2(dot(cross(end, begin), first.sides[1].direction), dot(end, begin))
        } else {
            0.0
        };
        let mut frame = turned(begin, first.sides[1].direction, first.sides[0].direction);
        let mut last_ring: Option<Ring> = None;
        // A closed path ends with the elbow that it begins behind.
        let mut closing: Vec<Ring> = Vec::new();
        let mut arcs = before;
        for (k, (joint, circles)) in joints.iter().zip(circles).enumerate() {
            let [coming, leaving] = joint.sides.map(|side| side.direction);
            let (is_first, is_last) = (k == 0, k + 1 == joints.len());
            let round = Round { frame, turn: twist * joint.along / last.along };
            let v = |along: f64| (arcs + joint.along + along) / whole;
            let lengths = lengths(joints, k, self.closed);
            let rings = match (self.closed, is_first || is_last) {
                (false, true) => self.end(joint, &round, is_first, v),
                (true, true) if is_first => {
                    let from = whole - arc(circles);
                    closing = self.elbow(joint, circles, &round, lengths, |along| (from + along) / whole);
                    closing.last().map(|ring| self.again(ring, 0.0)).into_iter().collect()
                }
                (true, true) => std::mem::take(&mut closing),
                (_, false) => self.elbow(joint, circles, &round, lengths, v),
            };
            arcs += if is_first { 0.0 } else { arc(circles) };
            for (number, ring) in rings.into_iter().enumerate() {
                match &last_ring {
                    Some(before) if number == 0 => self.piece([&joints[k - 1], joint], before, &ring),
                    Some(before) => self.band(before, &ring, None),
                    None => {}
                }
                last_ring = Some(ring);
            }
            frame = turned(frame, coming, leaving);
            if let Some(next) = joints.get(k + 1) {
                frame = turned(frame, leaving, next.sides[0].direction);
            }
        }
        self.data
    }

    /// Of the vertices' angles round the path.
    fn angles(&self) -> impl Iterator<Item = f64> + use<> {
        let segments = self.segments;
        (0..segments).map(move |k| TAU * f64::from(k) / f64::from(segments))
    }

    /// The rings of a joint within the path, between pieces of these lengths. `v`: the texture coordinate so far on.
    fn elbow(
        &mut self,
        joint: &Joint,
        circles: &[Circle],
        round: &Round,
        lengths: [f64; 2],
        v: impl Fn(f64) -> f64,
    ) -> Vec<Ring> {
        let coming = joint.sides[0].direction;
        let of = |side: Side, meeting: Option<&Meeting>| {
            let round = Round { frame: turned(round.frame, coming, side.direction), ..*round };
            let across = self.angles().map(|angle| round.across(&side, angle));
            let turned = across.map(|across| meeting.map_or(across, |meeting| meeting.turned(&side, across)));
            turned.map(|across| leaning(&side, across)).collect::<Vec<Point3>>()
        };
        let all = |meeting: Option<&Meeting>| -> Vec<Vec<Point3>> {
            circles.iter().map(|circle| of(circle.side, meeting)).collect()
        };
        let (mut normals, mut ways) = (all(None), vec![Way::Ball; self.segments as usize]);
        let mut points = [[0.0; 3]; 2];
        if self.straight && circles.len() > 1 {
            let ends = |normals: &[Vec<Point3>]| -> Vec<[Point3; 2]> {
                let (one, other) = (normals.first().into_iter().flatten(), normals.last().into_iter().flatten());
                one.zip(other).map(|(one, other)| [*one, *other]).collect()
            };
            let meeting = Meeting::new(joint);
            let through = all(meeting.as_ref());
            if let Some(found) = seam(joint, lengths, &ends(&through), &ends(&normals), meeting.as_ref()) {
                (normals, ways, points) = (through, found, meeting.map_or(points, |meeting| meeting.points()));
            }
        }
        // One vertex each.
        let (mut seams, mut ends) = (vec![None; self.segments as usize], [None; 2]);
        let mut rings: Vec<Ring> = Vec::with_capacity(circles.len());
        let count = circles.len();
        for (number, (circle, normals)) in circles.iter().zip(normals).enumerate() {
            let share = if count > 1 { number as f64 / (count - 1) as f64 } else { 0.0 };
            let is_tip = libm::cos(circle.side.lean) < ONE;
            let (mut feet, mut positions): (Vec<Foot>, Vec<u32>) = (Vec::new(), Vec::new());
            for (k, normal) in normals.into_iter().enumerate() {
                let (foot, vertex) = match ways[k] {
                    Way::Seam(_, [one, _]) if number == 0 => (one, Some(&mut seams[k])),
                    Way::Seam(_, [_, other]) if number + 1 == count => (other, Some(&mut seams[k])),
                    Way::Seam(_, [one, other]) => {
                        let between = unit(blend(one.normal, 1.0 - share, other.normal, share));
                        (Foot { along: 0.0, normal: between.unwrap_or(one.normal) }, Some(&mut seams[k]))
                    }
                    Way::Point(point) => (Foot { along: 0.0, normal: points[point] }, Some(&mut ends[point])),
                    Way::Ball => (Foot { along: 0.0, normal }, None),
                };
                let way = match ways[k] {
                    Way::Seam(x, _) => x,
                    _ => foot.normal.map(|x| joint.radius * x),
                };
                let at = add(joint.at, way, 1.0);
                let vertex = match (vertex, positions.first()) {
                    (Some(known), _) => *known.get_or_insert_with(|| position(&mut self.data, at)),
                    (None, Some(&tip)) if is_tip => tip,
                    _ => {
                        let before = rings.last().and_then(|ring| ring.positions.get(k)).copied();
                        self.unless(at, before, ONE * joint.radius)
                    }
                };
                feet.push(foot);
                positions.push(vertex);
            }
            rings.push(self.ring(positions, feet, circle.side, v(circle.along), is_tip));
        }
        rings
    }

    /// The rings of a round end. `v`: the texture coordinate so far on from its middle.
    fn end(&mut self, joint: &Joint, round: &Round, is_first: bool, v: impl Fn(f64) -> f64) -> Vec<Ring> {
        let side = if is_first { joint.sides[1] } else { joint.sides[0] };
        let angle = end_angle(joint, is_first);
        let count = (angle * f64::from(self.segments) / TAU - ONE).ceil().max(0.0) as u32;
        let mut rings = Vec::with_capacity(count as usize + 1);
        for n in 0..=count {
            // From the tip.
            let number = if is_first { n } else { count - n };
            let from_tip = if count == 0 { 0.0 } else { f64::from(number) / f64::from(count) * angle };
            let off = (angle - from_tip) * joint.radius;
            let v = v(if is_first { -off } else { off });
            let lean = if is_first { FRAC_PI_2 - from_tip } else { from_tip - FRAC_PI_2 };
            let of_ring = Side { lean: if number == count { side.lean } else { lean }, ..side };
            let normals: Vec<Point3> = self.angles().map(|angle| round.normal(&of_ring, angle)).collect();
            let is_tip = number == 0 || libm::cos(of_ring.lean) < ONE;
            let positions = if is_tip {
                let axis = side.direction.map(|x| if lean > 0.0 { -x } else { x });
                vec![self.position(add(joint.at, axis, joint.radius)); self.segments as usize]
            } else {
                normals.iter().map(|&n| self.position(add(joint.at, n, joint.radius))).collect()
            };
            let feet = normals.into_iter().map(|normal| Foot { along: 0.0, normal }).collect();
            rings.push(self.ring(positions, feet, of_ring, v, is_tip));
        }
        rings
    }

    /// Adds a piece of the path between two rings: part of a cone.
    fn piece(&mut self, [one, other]: [&Joint; 2], from: &Ring, to: &Ring) {
        if from.is_tip || to.is_tip {
            return self.band(from, to, None);
        }
        let circles = [(one, from), (other, to)].map(|(joint, ring)| joint.radius * libm::cos(ring.side.lean));
        let mut cut = Cut::new(circles, [from, to].map(|ring| libm::cos(ring.side.lean)));
        // Where lines turn about the piece, by half a piece of the circle from ring to ring at most.
        let lines = Lines::new([one, other], from, to);
        let bands = (2.0 * lines.turn * f64::from(self.segments) / TAU - ONE).ceil().clamp(1.0, MOST_RINGS);
        if bands as usize + 1 > cut.rings.len() {
            cut.rings = skew::rings(bands as u32, circles);
        }
        let mut last: Option<Ring> = None;
        let count = cut.rings.len();
        for (number, &share) in cut.rings.iter().enumerate().skip(1) {
            let ring = (number + 1 < count).then(|| {
                let (side, v) = (lines.side(share), from.v + share * (to.v - from.v));
                let places: Vec<(Point3, Point3)> = (0..lines.ends.len()).map(|k| lines.at(k, share)).collect();
                let positions = places.iter().map(|place| self.position(place.0)).collect();
                let feet = places.iter().map(|place| Foot { along: 0.0, normal: place.1 }).collect();
                self.ring(positions, feet, side, v, false)
            });
            let radii = [number - 1, number].map(|k| circles[0] + cut.rings[k] * (circles[1] - circles[0]));
            let middle = cut.middles.then(|| skew::middle(radii));
            self.band(last.as_ref().unwrap_or(from), ring.as_ref().unwrap_or(to), middle);
            last = ring;
        }
    }

    /// The vertex there, or the one before if that is as near as this.
    fn unless(&mut self, at: Point3, before: Option<u32>, near: f64) -> u32 {
        match before.filter(|&k| length(sub(self.data.positions[k as usize], at)) < near) {
            Some(before) => before,
            None => self.position(at),
        }
    }

    fn position(&mut self, at: Point3) -> u32 {
        position(&mut self.data, at)
    }

    fn ring(&mut self, positions: Vec<u32>, feet: Vec<Foot>, side: Side, v: f64, is_tip: bool) -> Ring {
        let (normal, uvs) = (self.data.normals.len() as u32, self.uvs(v, is_tip));
        self.data.normals.extend(feet.iter().map(|foot| foot.normal.map(|x| x as f32)));
        Ring { positions, normal, uvs, v, is_tip, side, feet }
    }

    /// Adds texture coordinates of a ring; gives the number of the first.
    fn uvs(&mut self, v: f64, halfway: bool) -> u32 {
        let first = self.data.uvs.len() as u32;
        // At a tip, and in the middle, each piece has its own.
        let shift = if halfway { 0.5 } else { 0.0 };
        let u = |k: u32| (f64::from(k) + shift) / f64::from(self.segments);
        self.data.uvs.extend((0..=self.segments).map(|k| [u(k) as f32, v as f32]));
        first
    }

    /// A ring that is where another is, with other texture coordinates.
    fn again(&mut self, ring: &Ring, v: f64) -> Ring {
        let uvs = self.uvs(v, ring.is_tip);
        Ring { positions: ring.positions.clone(), feet: ring.feet.clone(), uvs, v, ..*ring }
    }

    /// Adds what lies between two rings; with a vertex in the middle of each piece, so far from the first, where there
    /// is to be one. Where both have one vertex, nothing does.
    fn band(&mut self, from: &Ring, to: &Ring, middle: Option<f64>) {
        let share = middle.unwrap_or(0.0);
        let middles = middle.map(|share| self.uvs(from.v + share * (to.v - from.v), true));
        for k in 0..self.segments as usize {
            let next = (k + 1) % self.segments as usize;
            let corner = |ring: &Ring, last: bool| {
                let at = if last { next } else { k };
                let uv = k as u32 + u32::from(last && !ring.is_tip);
                [ring.positions[at], ring.normal + at as u32, ring.uvs + uv]
            };
            let [a, b, c, d] = [corner(from, false), corner(from, true), corner(to, true), corner(to, false)];
            let Some(uvs) = middles else {
                // One of the two where two corners are one: it does not matter which has that corner.
                self.triangle([a, b, c]);
                self.triangle([a, c, d]);
                continue;
            };
            let between = |[a, b, c, d]: [Point3; 4]| {
                let [low, high] = [blend(a, 0.5, b, 0.5), blend(c, 0.5, d, 0.5)];
                blend(low, 1.0 - share, high, share)
            };
            let corners = [a, b, c, d];
            let at = between(corners.map(|corner| self.data.positions[corner[0] as usize]));
            let normals = corners.map(|corner| self.data.normals[corner[1] as usize]);
            let normal = unit(between(normals.map(|normal| normal.map(f64::from))));
            let middle = [self.position(at), self.data.normals.len() as u32, uvs + k as u32];
            self.data.normals.push(normal.map_or(normals[0], |normal| normal.map(|x| x as f32)));
            for [one, other] in [[a, b], [b, c], [c, d], [d, a]] {
                self.triangle([one, other, middle]);
            }
        }
    }

    fn triangle(&mut self, corners: [[u32; 3]; 3]) {
        let [a, b, c] = corners.map(|corner| corner[0]);
        if a == b || b == c || c == a {
            return;
        }
        let data = &mut self.data;
        data.triangles.push([a, b, c]);
        data.normal_triangles.get_or_insert_default().push(corners.map(|corner| corner[1]));
        data.uv_triangles.get_or_insert_default().push(corners.map(|corner| corner[2]));
    }
}

/// A new vertex.
fn position(data: &mut MeshData, at: Point3) -> u32 {
    data.positions.push(at);
    data.positions.len() as u32 - 1
}

/// How vertices go round the path.
#[derive(Clone, Copy, Debug)]
struct Round {
    /// Across the path, where they begin.
    frame: Point3,
    /// By how much they are turned about the path from there, so that those of a closed path meet.
    turn: f64,
}

impl Round {
    /// What is across at an angle.
    fn across(&self, side: &Side, angle: f64) -> Point3 {
        let (sin, cos) = (libm::sin(angle + self.turn), libm::cos(angle + self.turn));
        blend(self.frame, cos, cross(side.direction, self.frame), sin)
    }

    /// The normal there.
    fn normal(&self, side: &Side, angle: f64) -> Point3 {
        leaning(side, self.across(side, angle))
    }
}

/// The normal of a circle where this is across.
fn leaning(side: &Side, across: Point3) -> Point3 {
    blend(across, libm::cos(side.lean), side.direction, -libm::sin(side.lean))
}

/// The lines along a piece.
struct Lines<'a> {
    joints: [&'a Joint; 2],
    sides: [Side; 2],
    /// Of each how far from the first joint its ends are, as shares of the way, and what is across there.
    ends: Vec<[(f64, Point3); 2]>,
    /// By how much they turn about the piece, at most.
    turn: f64,
}

impl<'a> Lines<'a> {
    fn new(joints: [&'a Joint; 2], from: &Ring, to: &Ring) -> Self {
        let way = length(sub(joints[1].at, joints[0].at)).max(f64::MIN_POSITIVE);
        let sides = [from.side, to.side];
        let across_of = |normal: Point3, side: Side| {
            let across_it = unit(add(normal, side.direction, -dot(normal, side.direction)));
            across_it.unwrap_or_else(|| across(side.direction))
        };
        let ends: Vec<[(f64, Point3); 2]> = from
            .feet
            .iter()
            .zip(&to.feet)
            .map(|(one, other)| {
                let last = 1.0 + other.along / way;
                [(one.along / way, across_of(one.normal, sides[0])), (last, across_of(other.normal, sides[1]))]
            })
            .collect();
        let turns =
            |[one, other]: &[(f64, Point3); 2]| turn(turned(one.1, sides[0].direction, sides[1].direction), other.1);
        let turn = ends.iter().map(turns).fold(0.0, f64::max);
        Lines { joints, sides, ends, turn }
    }

    fn side(&self, share: f64) -> Side {
        let [one, other] = self.sides;
        let direction = unit(blend(one.direction, 1.0 - share, other.direction, share)).unwrap_or(one.direction);
        Side { direction, lean: one.lean + share * (other.lean - one.lean) }
    }

    /// Place and normal so far on a line.
    fn at(&self, line: usize, share: f64) -> (Point3, Point3) {
        let [one, other] = self.joints;
        let [(begin, a), (end, b)] = self.ends[line];
        let (side, along) = (self.side(share), begin + share * (end - begin));
        let between = blend(a, 1.0 - share, b, share);
        let across = unit(add(between, side.direction, -dot(between, side.direction))).unwrap_or(a);
        let normal = leaning(&side, across);
        let center = blend(one.at, 1.0 - along, other.at, along);
        (add(center, normal, one.radius + along * (other.radius - one.radius)), normal)
    }
}

/// How long the pieces before and after a joint are.
fn lengths(joints: &[Joint], k: usize, closed: bool) -> [f64; 2] {
    let way = |a: usize, b: usize| length(sub(joints[b].at, joints[a].at));
    let last = joints.len() - 1;
    match (k, closed) {
        (0, true) => [way(last - 1, last), way(0, 1)],
        (k, true) if k == last => [way(last - 1, last), way(0, 1)],
        (0, false) => [way(0, 1); 2],
        (k, false) if k == last => [way(last - 1, last); 2],
        _ => [way(k - 1, k), way(k, k + 1)],
    }
}

/// The angle from the tip of a round end to the circle in which it meets the rest.
fn end_angle(joint: &Joint, is_first: bool) -> f64 {
    let lean = joint.sides[0].lean;
    FRAC_PI_2 + if is_first { -lean } else { lean }
}

/// Frames, that turn as little as they can, where the path begins and where one comes again at its end.
fn frames(joints: &[Joint]) -> [Point3; 2] {
    let begin = across(joints[0].sides[1].direction);
    let (mut frame, mut direction) = (begin, joints[0].sides[1].direction);
    for joint in &joints[1..] {
        for side in joint.sides {
            frame = turned(frame, direction, side.direction);
            direction = side.direction;
        }
    }
    [begin, frame]
}
