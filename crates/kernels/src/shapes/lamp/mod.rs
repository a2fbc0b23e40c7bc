//! Curved shapes that shine: points and directions towards them, and from them.
//!
//! All is reckoned in the shape's own space, which is its object space with the z axis of cones made as long as it is
//! beside the others: a cylinder's map to render space keeps angles then, but where a transform squeezes it. A
//! direction of own space with density p has in render space the density p / (|det M| |M^-1 w|^3), w the unit direction
//! there. So an ellipsoid is seen as a ball is, whatever its form.
//!
//! From within a closed shape all directions meet it, and are as likely as each other. From outside a part is chosen,
//! by about the solid angle that it covers: what is seen of a side from its front or its back ([`side`]), a ball
//! ([`round`]), a disk or cap ([`flat`]); a torus is one part ([`ring`]). A capsule is two balls and a side that
//! overlap: all that could have taken a direction count. What a part's direction meets is found as rays find it; where
//! that is another part, which hides it, the sample is nothing.
//!
//! One scalar function in `f64` for all lanes, as hits are.

mod area;
mod flat;
mod ring;
mod round;
mod side;
mod solid;

use super::{Row, UnitShape, csg};
use flat::Flat;
use glam::{DAffine3, DMat3, DVec3};
use ring::Ring;
use side::{Facing, Side};
use std::f64::consts::PI;

/// What a lamp is in its own space.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Form {
    /// The ball of radius 1.
    Ball,
    /// A disk in the plane z = 0.
    Disk(Flat),
    /// A cone, and its caps.
    Cone { side: Side, caps: Option<[Flat; 2]> },
    /// What is at most 1 away from the z axis between its side's ends.
    Capsule(Side),
    /// A torus.
    Torus(Ring),
    /// An operand of a solid.
    Operand(solid::Operand),
}

/// A curved shape that shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lamp {
    row: Row,
    form: Form,
    /// From own space to render space, and back.
    map: DMat3,
    inverse: DMat3,
    anchor: DVec3,
    /// How much larger volumes are in render space.
    growth: f64,
    two_sided: bool,
    /// Side or ball, lower cap, upper cap.
    parts: [Share; 3],
    /// Area in render space, of one side.
    area: f64,
    /// How far off their planes rays start and end at flat parts.
    offset: f64,
}

/// A part of a lamp's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Share {
    /// Its area in own space and in render space.
    own: f64,
    area: f64,
}

/// A direction to a lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Towards {
    /// Unit direction.
    pub direction: DVec3,
    /// The distance; of flat parts to a little before them.
    pub distance: f64,
    /// One over the density in solid angle.
    pub inverse_pdf: f64,
}

/// A point of a lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// The point.
    pub point: DVec3,
    /// The unit normal outwards.
    pub normal: DVec3,
    /// One over the density in area, over the area.
    pub rarity: f64,
}

/// A ray that meets a lamp, in its own space.
struct Way {
    o: DVec3,
    /// Unit.
    d: DVec3,
    /// Where it meets it.
    q: DVec3,
}

/// How likely the parts of a lamp are chosen from a point.
struct View {
    /// The point in own space.
    o: DVec3,
    /// All directions meet it.
    within: bool,
    /// Of the side's front, its back, and what is below and above: caps or balls.
    weights: [f64; 4],
    sum: f64,
}

const NEAR: usize = 0;
const FAR: usize = 1;
const LOW: usize = 2;
const HIGH: usize = 3;

impl Lamp {
    /// A shape under a map from object space to render space.
    pub fn new(unit: &UnitShape, placement: &DAffine3, two_sided: bool) -> Self {
        // As rows hold them.
        let held = |x: f64| f64::from(x as f32);
        let mut map = placement.matrix3;
        let form = match *unit {
            UnitShape::Sphere => Form::Ball,
            UnitShape::Disk { inner } => Form::Disk(Flat { z: 0.0, radii: [held(inner), 1.0] }),
            UnitShape::Cone { radii, caps, .. } => {
                let [first, last] = radii.map(held);
                let half = map.z_axis.length() / (map.x_axis.length() * map.y_axis.length()).sqrt();
                map.z_axis /= half;
                let side = Side { middle: 0.5 * (first + last), slope: 0.5 * (last - first) / half, half };
                let cap = |z, radius| Flat { z, radii: [0.0, radius] };
                Form::Cone { side, caps: caps.then(|| [cap(-half, first), cap(half, last)]) }
            }
            UnitShape::Capsule { half } => Form::Capsule(Side { middle: 1.0, slope: 0.0, half: held(half) }),
            UnitShape::Torus { tube } => Form::Torus(Ring { tube: held(tube) }),
            UnitShape::Solid(solid) => Form::Operand(solid::Operand::new(&solid)),
            UnitShape::Plane | UnitShape::Cube => unreachable!("it does not shine"),
        };
        let of_side =
            |side: &Side| Share { own: side.area(), area: area::of_side(&map, side.middle, side.slope, side.half) };
        let disk = area::of_disk(&map) / PI;
        let of_flat = |flat: &Flat| Share { own: flat.area(), area: flat.area() * disk };
        let ball = Share { own: 4.0 * PI, area: area::of_ball(&map) };
        let nothing = Share { own: 0.0, area: 0.0 };
        let parts = match &form {
            Form::Ball => [ball, nothing, nothing],
            Form::Disk(flat) => [nothing, of_flat(flat), nothing],
            Form::Cone { side, caps: None } => [of_side(side), nothing, nothing],
            Form::Cone { side, caps: Some([low, high]) } => [of_side(side), of_flat(low), of_flat(high)],
            Form::Capsule(side) => [of_side(side), ball, nothing],
            Form::Torus(ring) => [Share { own: ring.area(), area: area::of_torus(&map, ring.tube) }, nothing, nothing],
            Form::Operand(operand) => [Share { own: operand.area(), area: operand.area() }, nothing, nothing],
        };
        let [low, high] = unit.bounds(placement);
        let magnitude = low.abs().max(high.abs()).element_sum();
        Lamp {
            row: Row::new(unit, placement),
            form,
            map,
            inverse: map.inverse(),
            anchor: placement.translation,
            growth: map.determinant().abs(),
            two_sided,
            parts,
            area: parts.iter().map(|part| part.area).sum(),
            offset: magnitude * 7.0 * f64::from(f32::EPSILON),
        }
    }

    /// The same, off whose flat parts rays start and end so far at least.
    #[must_use]
    pub fn keep_off(self, least: f64) -> Self {
        Lamp { offset: self.offset.max(least), ..self }
    }

    /// The area in render space, of one side; of an operand that of a sphere about it.
    pub fn area(&self) -> f64 {
        self.area
    }

    /// How far off their planes rays start at flat parts; zero where it has none.
    pub fn offset(&self) -> f64 {
        match self.form {
            Form::Disk(_) | Form::Cone { caps: Some(_), .. } => self.offset,
            _ => 0.0,
        }
    }

    /// A direction from a point to it, for two random numbers; `None`: this time none, or it does not shine there.
    pub fn sample(&self, from: DVec3, u: f64, v: f64) -> Option<Towards> {
        self.sample_among(&[], (from, false), u, v)
    }

    /// As [`sample`](Self::sample), from a point that lies on the very shape where `true`. `parts`: those of all
    /// solids.
    pub fn sample_among(&self, parts: &[csg::Part], on: (DVec3, bool), u: f64, v: f64) -> Option<Towards> {
        if let Form::Operand(operand) = &self.form {
            return operand.sample(&self.row, parts, on, self.two_sided, [u, v]);
        }
        let from = on.0;
        let view = self.view(from);
        if view.sum <= 0.0 {
            return None;
        }
        let (part, u) = picked(&view.weights, u);
        let to = self.directed(&view, part, u, v)?;
        let direction = (self.map * to).try_normalize()?;
        let t = self.row.meet(from, direction, false)?;
        let (way, length) = self.way(view.o, direction, t);
        let front = self.is_front(&way);
        // A part's back may be hidden by its front.
        let hidden = !view.within && front == (part == FAR) && matches!(self.form, Form::Cone { caps: None, .. });
        let density = self.density(&view, &way, front);
        if hidden || !(density > 0.0 && density < f64::INFINITY) {
            return None;
        }
        let mut distance = t;
        if let Some(normal) = self.flat_normal(&way) {
            let cos = direction.dot(normal).abs();
            // A point in its plane sees nothing of it. Of very large ones the offset may be beyond the point.
            if t * cos <= 1e-3 * self.offset {
                return None;
            }
            distance -= (self.offset / cos).min(0.01 * t);
        }
        let inverse_pdf = self.growth * length * length * length / density;
        (distance > 0.0).then_some(Towards { direction, distance, inverse_pdf })
    }

    /// One over the density of [`Lamp::sample`] in solid angle, of a direction that meets it.
    pub fn inverse_pdf(&self, from: DVec3, direction: DVec3) -> f64 {
        if let Form::Operand(operand) = &self.form {
            return operand.inverse_pdf(from);
        }
        let Some(t) = self.row.meet(from, direction, false) else { return f64::INFINITY };
        let view = self.view(from);
        let (way, length) = self.way(view.o, direction, t);
        let density = self.density(&view, &way, self.is_front(&way));
        let inverse = self.growth * length * length * length / density;
        if inverse > 0.0 { inverse } else { f64::INFINITY }
    }

    /// A ray that meets it, and the length that a unit of its way has in own space.
    fn way(&self, o: DVec3, direction: DVec3, t: f64) -> (Way, f64) {
        let d = self.inverse * direction;
        let length = d.length();
        (Way { o, d: d / length, q: o + t * d }, length)
    }

    /// How a point sees it.
    fn view(&self, from: DVec3) -> View {
        let o = self.inverse * (from - self.anchor);
        let within = match &self.form {
            Form::Ball => o.length_squared() <= 1.0,
            Form::Disk(_) | Form::Cone { caps: None, .. } => false,
            Form::Cone { side, .. } => o.z.abs() <= side.half && side.holds(o),
            Form::Capsule(side) => (o - DVec3::new(0.0, 0.0, o.z.clamp(-side.half, side.half))).length_squared() <= 1.0,
            Form::Torus(ring) => ring.holds(o),
            Form::Operand(_) => false,
        };
        let mut weights = [0.0; 4];
        match &self.form {
            _ if within => weights[NEAR] = if self.two_sided { 1.0 } else { 0.0 },
            Form::Ball => weights[LOW] = round::measure(o),
            Form::Disk(flat) if o.z > 0.0 || self.two_sided => weights[LOW] = flat.measure(o),
            Form::Disk(_) => {}
            Form::Cone { side, caps } => {
                let seen = side.seen(o);
                weights[NEAR] = side.measure(&seen, Facing::Near);
                match caps {
                    None if self.two_sided => weights[FAR] = side.measure(&seen, Facing::Far),
                    Some([low, _]) if o.z < low.z => weights[LOW] = low.measure(o),
                    Some([_, high]) if o.z > high.z => weights[HIGH] = high.measure(o),
                    _ => {}
                }
            }
            Form::Capsule(side) => {
                weights[NEAR] = side.measure(&side.seen(o), Facing::Near);
                weights[LOW] = round::measure(side.beside_end(o, -1.0));
                weights[HIGH] = round::measure(side.beside_end(o, 1.0));
            }
            Form::Torus(_) => weights[NEAR] = 1.0,
            Form::Operand(_) => {}
        }
        View { o, within, weights, sum: weights.iter().sum() }
    }

    /// A direction of own space to a part of it, for two random numbers; `None`: this time none.
    fn directed(&self, view: &View, part: usize, u: f64, v: f64) -> Option<DVec3> {
        let o = view.o;
        let to = match &self.form {
            _ if view.within => round::anywhere(u, v),
            Form::Ball => round::direction(o, u, v),
            Form::Disk(flat) => flat.towards(o, u, v) - o,
            Form::Cone { caps: Some([low, _]), .. } if part == LOW => low.towards(o, u, v) - o,
            Form::Cone { caps: Some([_, high]), .. } if part == HIGH => high.towards(o, u, v) - o,
            Form::Capsule(side) if part == LOW => round::direction(side.beside_end(o, -1.0), u, v),
            Form::Capsule(side) if part == HIGH => round::direction(side.beside_end(o, 1.0), u, v),
            Form::Cone { side, .. } | Form::Capsule(side) => {
                let facing = if part == FAR { Facing::Far } else { Facing::Near };
                side.towards(&side.seen(o), facing, u, v) - o
            }
            Form::Torus(ring) => ring.towards(o, u, v)? - o,
            Form::Operand(_) => return None,
        };
        Some(to)
    }

    /// The density of a direction in own space.
    fn density(&self, view: &View, way: &Way, front: bool) -> f64 {
        let [near, far, low, high] = view.weights;
        let of_parts = match &self.form {
            _ if view.within => return if front { 0.0 } else { near / (4.0 * PI) },
            Form::Ball => return if low > 0.0 { 1.0 / low } else { 0.0 },
            Form::Disk(flat) => return if low > 0.0 { flat.density(way) } else { 0.0 },
            Form::Cone { side, caps } => match (self.cap(way.q), caps) {
                (Some(k), Some(caps)) => [low, high][k] * caps[k].density(way),
                _ if front => near * side.density(&side.seen(way.o), Facing::Near, way),
                _ if far > 0.0 => far * side.density(&side.seen(way.o), Facing::Far, way),
                _ => 0.0,
            },
            Form::Capsule(side) => {
                let ball = |end: f64| round::density(&Way { o: side.beside_end(way.o, end), ..*way });
                low * ball(-1.0) + high * ball(1.0) + near * side.density_of_line(way)
            }
            Form::Torus(ring) => near * ring.density(way),
            Form::Operand(_) => 0.0,
        };
        of_parts / view.sum
    }

    /// Which of its caps a point of own space lies on.
    fn cap(&self, q: DVec3) -> Option<usize> {
        let Form::Cone { side, caps: Some(_) } = &self.form else { return None };
        side.is_beside(q).then_some(usize::from(q.z > 0.0))
    }

    /// The unit normal in render space where a ray meets a flat part.
    fn flat_normal(&self, way: &Way) -> Option<DVec3> {
        let is_flat = matches!(self.form, Form::Disk(_)) || self.cap(way.q).is_some();
        is_flat.then(|| (self.inverse.transpose() * DVec3::Z).normalize())
    }

    /// Whether a ray meets it from its front. The normal of own space tells.
    fn is_front(&self, way: &Way) -> bool {
        self.own_normal(way.q).dot(way.d) < 0.0
    }

    /// The outward unit normal at a point of the surface, in own space.
    fn own_normal(&self, q: DVec3) -> DVec3 {
        match &self.form {
            Form::Ball => q.normalize_or_zero(),
            Form::Disk(_) => DVec3::Z,
            Form::Cone { side, .. } => match self.cap(q) {
                Some(k) => DVec3::new(0.0, 0.0, [-1.0, 1.0][k]),
                None => side.normal(q),
            },
            Form::Capsule(side) => (q - DVec3::new(0.0, 0.0, q.z.clamp(-side.half, side.half))).normalize_or_zero(),
            Form::Torus(ring) => ring.normal(q),
            Form::Operand(_) => DVec3::ZERO,
        }
    }

    /// A point of it, for two random numbers: of parts by their areas, in them uniform in own space.
    pub fn start(&self, u: f64, v: f64) -> Start {
        let (part, u) = picked(&self.parts.map(|part| part.area), u);
        let (q, n) = match (&self.form, part) {
            (Form::Operand(operand), _) => return operand.start(),
            (Form::Ball, _) => (round::anywhere(u, v), None),
            (Form::Disk(flat), _) => (flat.point(u, v), Some(DVec3::Z)),
            (Form::Cone { caps: Some([low, _]), .. }, 1) => (low.point(u, v), Some(DVec3::NEG_Z)),
            (Form::Cone { caps: Some([_, high]), .. }, 2) => (high.point(u, v), Some(DVec3::Z)),
            (Form::Capsule(side), 1..) => {
                let n = round::anywhere(u, v);
                (n + DVec3::new(0.0, 0.0, side.half.copysign(n.z)), Some(n))
            }
            (Form::Torus(ring), _) => {
                let q = ring.point(u, v);
                (q, Some(ring.normal(q)))
            }
            (Form::Cone { side, .. } | Form::Capsule(side), _) => {
                let q = side.point(u, v);
                (q, Some(side.normal(q)))
            }
        };
        let n = n.unwrap_or(q);
        let normal = (self.inverse.transpose() * n).normalize();
        Start { point: self.anchor + self.map * q, normal, rarity: self.rarity_in(part, n) }
    }

    /// [`Start::rarity`] of points with this unit normal, outwards or inwards.
    pub fn rarity(&self, normal: DVec3) -> f64 {
        let n = (self.map.transpose() * normal).normalize_or_zero();
        let part = match &self.form {
            Form::Ball | Form::Torus(_) | Form::Operand(_) => 0,
            Form::Disk(_) => 1,
            Form::Cone { caps: None, .. } => 0,
            Form::Cone { side, caps: Some(_) } => {
                let of_side = side.normal(DVec3::X).z.abs();
                // The normals of caps are upright, those of the side nowhere so much.
                usize::from(2.0 * n.z.abs() > 1.0 + of_side)
            }
            Form::Capsule(_) => usize::from(n.z.abs() > LEVEL),
        };
        self.rarity_in(part, n)
    }

    fn rarity_in(&self, part: usize, n: DVec3) -> f64 {
        let Share { own, area } = self.parts[part];
        if area > 0.0 { own * area::growth(&self.map, n) / area } else { 1.0 }
    }
}

/// The place that a number from 0 to 1 falls to, by weights of which one is above zero, and what is left of it there.
fn picked(weights: &[f64], number: f64) -> (usize, f64) {
    let mut rest = number * weights.iter().sum::<f64>();
    let mut last = (0, 0.0);
    for (k, &weight) in weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
        last = (k, (rest / weight).clamp(0.0, 1.0));
        if rest < weight {
            break;
        }
        rest -= weight;
    }
    last
}

/// Normals of a capsule that are as level as this are of its side.
const LEVEL: f64 = 1e-6;

impl UnitShape {
    /// The true area of its surface under a map, of one side.
    pub fn area(&self, map: &DAffine3) -> f64 {
        Lamp::new(self, map, false).area
    }

    /// The radius of a sphere about the image of the origin that holds it under a map.
    pub fn radius(&self, map: &DAffine3) -> f64 {
        let m = &map.matrix3;
        match *self {
            UnitShape::Sphere => area::reach_of_ball(m),
            UnitShape::Disk { .. } => area::reach_of_ball(&DMat3::from_cols(m.x_axis, m.y_axis, DVec3::ZERO)),
            UnitShape::Cone { radii, .. } => {
                // Of each rim 64 points, and what an arc between two of them may reach beyond both.
                let of_rim = |k: u32| {
                    let (sin, cos) = libm::sincos(f64::from(k) * PI / 32.0);
                    let reach = |z: f64, r: f64| (*m * DVec3::new(r * cos, r * sin, z)).length();
                    reach(-1.0, radii[0]).max(reach(1.0, radii[1]))
                };
                1.004 * (0..64).map(of_rim).fold(0.0, f64::max)
            }
            UnitShape::Capsule { half } => area::reach_of_ball(m) + half * m.z_axis.length(),
            UnitShape::Torus { tube } => {
                area::reach_of_ball(&DMat3::from_cols(m.x_axis, m.y_axis, DVec3::ZERO)) + tube * area::reach_of_ball(m)
            }
            UnitShape::Plane => f64::INFINITY,
            UnitShape::Cube | UnitShape::Solid(_) => {
                let [low, high] = self.bounds(&DAffine3 { matrix3: *m, translation: DVec3::ZERO });
                low.abs().max(high.abs()).length()
            }
        }
    }
}

#[cfg(test)]
mod tests;
