//! The cat's shape: a standing house cat as a signed distance field of melted blobs.
//!
//! Frame: x forward (the cat looks along +x), y up with the floor at y = 0, z to the cat's right. One unit is a little
//! less than a centimetre of a real cat: the back is at 28, the ears' tips at 37.

use super::sdf::{Blob, Melt, smooth_max, smooth_min};
use glam::{DMat3, DVec3};

/// What a point of the surface belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// Rump, belly, chest and neck.
    Torso,
    /// Skull and muzzle.
    Head,
    /// Outside of the left ear.
    LeftEar,
    /// Outside of the right ear.
    RightEar,
    /// Hollow of the left ear.
    LeftEarHollow,
    /// Hollow of the right ear.
    RightEarHollow,
    /// Tail.
    Tail,
    /// Left foreleg.
    LeftForeleg,
    /// Right foreleg.
    RightForeleg,
    /// Left hind leg.
    LeftHindLeg,
    /// Right hind leg.
    RightHindLeg,
    /// Left forepaw.
    LeftForepaw,
    /// Right forepaw.
    RightForepaw,
    /// Left hind paw.
    LeftHindPaw,
    /// Right hind paw.
    RightHindPaw,
}

/// Height where paws end and legs begin.
const PAW_HEIGHT: f64 = 4.6;

/// Radius of an eyeball, in the head's frame.
pub const EYE_RADIUS: f64 = 1.3;

/// Length of the head frame's unit.
const HEAD_SCALE: f64 = 1.13;

/// Points that the tail's middle line goes through, from root to tip.
const TAIL: [[f64; 3]; 8] = [
    [-13.5, 25.0, 0.0],
    [-17.4, 26.0, 0.0],
    [-20.9, 28.6, 0.2],
    [-23.0, 32.2, 0.5],
    [-24.1, 36.0, 0.8],
    [-25.6, 39.4, 0.9],
    [-28.4, 41.3, 0.7],
    [-31.3, 40.6, 0.3],
];

/// Pieces of the tail.
const TAIL_PIECES: usize = 28;

/// The cat as a signed distance field.
pub struct Cat {
    spine: Melt,
    flesh: Melt,
    skull: Melt,
    tail: Melt,
    legs: [Melt; 4],
    head_from_world: DMat3,
    head_center: DVec3,
}

/// Signed distances to the cat's parts, each without the others.
#[derive(Clone, Copy, Debug)]
pub struct PartDistances {
    /// Rump, belly, chest and neck.
    pub torso: f64,
    /// Skull, muzzle and ears.
    pub head: f64,
    /// Tail.
    pub tail: f64,
    /// Left fore, right fore, left hind, right hind.
    pub legs: [f64; 4],
}

impl PartDistances {
    /// The smallest of them.
    pub fn nearest(&self) -> f64 {
        self.legs.into_iter().fold(self.torso.min(self.head).min(self.tail), f64::min)
    }
}

/// One ear in its own frame.
struct Ear {
    outside: f64,
    hollow: f64,
}

impl Ear {
    /// How much nearer a surface point is to the hollow than to the ear's outside.
    fn hollowness(&self) -> f64 {
        -self.outside - self.hollow.abs()
    }

    /// In the hollow or on its rim.
    fn is_hollow(&self) -> bool {
        self.hollowness() > -0.2
    }
}

impl Default for Cat {
    fn default() -> Self {
        Self::new()
    }
}

impl Cat {
    /// The cat.
    pub fn new() -> Cat {
        let (pitch, yaw) = ((-4.0_f64).to_radians(), 0.0_f64.to_radians());
        let level = libm::cos(pitch);
        let forward = DVec3::new(level * libm::cos(yaw), libm::sin(pitch), level * libm::sin(yaw));
        let right = forward.cross(DVec3::Y).normalize();
        let world_from_head = DMat3::from_cols(forward, right.cross(forward), right);
        Cat {
            spine: spine(),
            flesh: flesh(),
            skull: skull(),
            tail: tail(),
            legs: [foreleg(-1.0, 1.2), foreleg(1.0, -0.9), hind_leg(-1.0, -1.6), hind_leg(1.0, 1.4)],
            head_from_world: world_from_head.transpose(),
            head_center: DVec3::new(21.8, 29.0, 0.0),
        }
    }

    /// A point in the head's frame: origin in the skull's middle, x towards the nose, y up, z to the cat's right.
    pub fn to_head(&self, p: DVec3) -> DVec3 {
        self.head_from_world * (p - self.head_center) / HEAD_SCALE
    }

    /// Centre of an eyeball in the head's frame; `side` is -1 for the left eye and 1 for the right one.
    pub fn eye_center(side: f64) -> DVec3 {
        DVec3::new(2.55, 0.55, 1.95 * side)
    }

    /// The frame of an eye: axes from its inner to its outer corner, up, and out of the pupil. `q` in the head's frame.
    pub fn to_eye(q: DVec3, side: f64) -> DVec3 {
        let gaze = DVec3::new(0.88, 0.05, 0.36 * side).normalize();
        let corners = DVec3::new(-0.36, 0.22, 0.88 * side);
        let corners = (corners - gaze * corners.dot(gaze)).normalize();
        let up = gaze.cross(corners) * -side;
        let r = q - Cat::eye_center(side);
        DVec3::new(r.dot(corners), r.dot(up), r.dot(gaze))
    }

    /// Signed distance of `p` to the whole cat.
    pub fn distance(&self, p: DVec3) -> f64 {
        let mut d = self.torso_distance(p);
        d = self.tail.join(d, p, 2.2);
        for leg in &self.legs {
            d = leg.join(d, p, 2.4);
        }
        if (p - self.head_center).length() - 12.0 < d + 2.0 {
            d = smooth_min(d, self.head_distance(p), 2.0);
        }
        // Soles are flat: the cat stands on the floor.
        smooth_max(d, -p.y, 0.25)
    }

    /// Unit normal: the field's gradient by four differences.
    pub fn normal(&self, p: DVec3) -> DVec3 {
        let h = 4e-3;
        [DVec3::new(1., -1., -1.), DVec3::new(-1., -1., 1.), DVec3::new(-1., 1., -1.), DVec3::new(1., 1., 1.)]
            .into_iter()
            .map(|e| e * self.distance(p + e * h))
            .sum::<DVec3>()
            .normalize_or(DVec3::Y)
    }

    /// The surface point near `p`, along the normal.
    pub fn project(&self, p: DVec3) -> DVec3 {
        let mut q = p;
        for _ in 0..3 {
            let d = self.distance(q);
            if d.abs() < 1e-6 {
                break;
            }
            q -= self.normal(q) * d;
        }
        q
    }

    /// The part whose own surface is nearest to `p`.
    pub fn part(&self, p: DVec3) -> Part {
        let head = self.to_head(p);
        let skull = self.skull.distance(head) * HEAD_SCALE;
        let [left, right] = [ear(head, -1.0), ear(head, 1.0)];
        let low = p.y < PAW_HEIGHT;
        let mut best = (Part::Torso, self.torso_distance(p));
        // The torso's blobs reach into the legs and the neck into the head: these win a little early.
        for (part, d) in [
            (Part::Head, skull - 0.3),
            (Part::LeftEar, left.outside),
            (Part::RightEar, right.outside),
            (Part::Tail, self.tail.distance(p) - 0.2),
            (if low { Part::LeftForepaw } else { Part::LeftForeleg }, self.legs[0].distance(p)),
            (if low { Part::RightForepaw } else { Part::RightForeleg }, self.legs[1].distance(p)),
            (if low { Part::LeftHindPaw } else { Part::LeftHindLeg }, self.legs[2].distance(p)),
            (if low { Part::RightHindPaw } else { Part::RightHindLeg }, self.legs[3].distance(p)),
        ] {
            if d < best.1 {
                best = (part, d);
            }
        }
        match best.0 {
            // Nearer to the cut than to the ear's outside.
            Part::LeftEar | Part::Head if left.is_hollow() => Part::LeftEarHollow,
            Part::RightEar | Part::Head if right.is_hollow() => Part::RightEarHollow,
            part => part,
        }
    }

    /// Signed distances to the parts alone.
    pub fn part_distances(&self, p: DVec3) -> PartDistances {
        let head = self.to_head(p);
        let ears = ear(head, -1.0).outside.min(ear(head, 1.0).outside);
        PartDistances {
            torso: self.torso_distance(p),
            head: self.skull.distance(head).min(ears) * HEAD_SCALE,
            tail: self.tail.distance(p),
            legs: std::array::from_fn(|leg| self.legs[leg].distance(p)),
        }
    }

    /// 1 in the hollow of an ear, 0 outside of it, with a narrow passage along the rim.
    pub fn in_ear_hollow(&self, p: DVec3) -> f64 {
        let q = self.to_head(p);
        let depth = [-1.0, 1.0].into_iter().map(|side| ear(q, side).hollowness());
        (0.5 + 2.5 * depth.fold(f64::NEG_INFINITY, f64::max)).clamp(0.0, 1.0)
    }

    /// How much a deviation of the surface disturbs at this place: people look at faces.
    pub fn importance(&self, p: DVec3) -> f64 {
        let q = self.to_head(p);
        if q.length() > 8.5 {
            return if p.y < 3.5 { 2.0 } else { 1.0 };
        }
        let eyes =
            [-1.0, 1.0].into_iter().map(|side| (q - Cat::eye_center(side)).length()).fold(f64::INFINITY, f64::min);
        if eyes < 1.6 {
            16.0
        } else if q.x > 2.0 || q.y > 3.2 {
            7.0
        } else {
            3.0
        }
    }

    /// How far along the tail the nearest point of its middle line is, from 0 at the root to 1 at the tip.
    pub fn along_tail(p: DVec3) -> f64 {
        let mut best = (f64::INFINITY, 0.0);
        for i in 0..TAIL_PIECES {
            let [a, b] = [i, i + 1].map(|i| tail_point(i as f64 / TAIL_PIECES as f64));
            let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
            let d = (p - a.lerp(b, t)).length_squared();
            if d < best.0 {
                best = (d, (i as f64 + t) / TAIL_PIECES as f64);
            }
        }
        best.1
    }

    /// Torso and neck are a little narrower than they are high.
    fn torso_distance(&self, p: DVec3) -> f64 {
        let narrow = 0.84;
        let q = DVec3::new(p.x, p.y, p.z / narrow);
        narrow * self.flesh.join(self.spine.distance(q), q, 2.2)
    }

    fn head_distance(&self, p: DVec3) -> f64 {
        let q = self.to_head(p);
        let mut d = self.skull.distance(q);
        for side in [-1.0, 1.0] {
            let eye = Cat::to_eye(q, side);
            // A shallow socket, and the eye's dome in it.
            d = smooth_max(d, 2.4 - (eye - DVec3::new(-0.1, 0.1, 3.15)).length(), 0.9);
            d = smooth_min(d, eye.length() - EYE_RADIUS, 0.2);
        }
        for side in [-1.0, 1.0] {
            let ear = ear(q, side);
            d = smooth_min(d, ear.outside, 0.9);
            d = smooth_max(d, -ear.hollow, 0.45);
        }
        d * HEAD_SCALE
    }
}

/// The tail's middle line at `t` from 0 to 1: a Catmull-Rom spline.
fn tail_point(t: f64) -> DVec3 {
    let last = TAIL.len() - 1;
    let segment = ((t * last as f64) as usize).min(last - 1);
    let u = t * last as f64 - segment as f64;
    let at = |i: isize| DVec3::from(TAIL[(segment as isize + i).clamp(0, last as isize) as usize]);
    let (p0, p1, p2, p3) = (at(-1), at(0), at(1), at(2));
    0.5 * (2.0 * p1 + u * ((p2 - p0) + u * ((2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) + u * (3.0 * (p1 - p2) + p3 - p0))))
}

/// Thick at the root, blunt at the tip.
fn tail() -> Melt {
    let radius = |t: f64| 1.45 + 0.75 * (1.0 - t) * (1.0 - t) - 0.25 * t * t;
    let pieces = (0..TAIL_PIECES).map(|i| {
        let [t0, t1] = [i, i + 1].map(|i| i as f64 / TAIL_PIECES as f64);
        Blob::RoundCone { a: tail_point(t0), radius_a: radius(t0), b: tail_point(t1), radius_b: radius(t1) }
    });
    Melt::new(0.02, pieces.collect())
}

/// Rump, loins, ribs and chest: one chain, so that it needs no melting (which would swell it at the joints).
fn spine() -> Melt {
    let joints = [
        ([-12.2, 22.4, 0.0], 5.6),
        ([-7.5, 22.1, 0.0], 5.5),
        ([-3.0, 21.8, 0.0], 5.5),
        ([2.0, 21.4, 0.0], 5.9),
        ([7.0, 21.1, 0.0], 6.4),
        ([12.2, 21.4, 0.0], 5.7),
    ];
    Melt::new(0.02, joints.windows(2).map(|w| Blob::bone(w[0].0, w[0].1, w[1].0, w[1].1)).collect())
}

fn flesh() -> Melt {
    Melt::new(
        2.0,
        vec![
            // Shoulder blades.
            Blob::ellipsoid([9.3, 24.8, 0.0], [4.4, 2.9, 3.0]),
            // Belly.
            Blob::ellipsoid([-1.5, 19.0, 0.0], [9.0, 3.6, 4.6]),
            // Neck, thicker at its root.
            Blob::bone([12.6, 22.4, 0.0], 5.2, [19.2, 27.4, 0.0], 4.3),
        ],
    )
}

fn foreleg(side: f64, step: f64) -> Melt {
    let x = 12.2 + step;
    let z = 3.2 * side;
    let mut blobs = vec![
        Blob::bone([11.4, 20.6, 3.2 * side], 3.7, [10.7 + 0.5 * step, 13.4, 3.4 * side], 2.6),
        Blob::bone([10.7 + 0.5 * step, 13.4, 3.4 * side], 2.5, [x - 0.3, 4.6, z], 1.75),
        Blob::bone([x - 0.3, 4.6, z], 1.75, [x + 0.5, 2.0, z], 1.75),
    ];
    blobs.extend(paw([x + 1.3, 1.35, z], side));
    Melt::new(0.6, blobs)
}

fn hind_leg(side: f64, step: f64) -> Melt {
    let x = -14.6 + step;
    let z = 3.5 * side;
    let knee = [-8.4 + 0.6 * step, 13.9, 3.6 * side];
    let hock = [x - 0.5, 7.3, z];
    let mut blobs = vec![
        // Thigh, its hind edge, shank, metatarsus.
        Blob::bone([-11.8, 20.8, 2.7 * side], 4.7, knee, 2.9),
        Blob::bone([-13.2, 19.2, 2.8 * side], 3.9, [-12.4 + 0.8 * step, 12.6, 3.3 * side], 2.6),
        Blob::bone(knee, 2.9, hock, 1.65),
        Blob::bone([-12.4 + 0.8 * step, 12.6, 3.3 * side], 2.6, hock, 1.6),
        Blob::bone(hock, 1.6, [x + 1.5, 2.0, z], 1.65),
    ];
    blobs.extend(paw([x + 2.6, 1.35, z], side));
    Melt::new(0.6, blobs)
}

/// A paw with four toes; `center` is the middle of its pad.
fn paw(center: [f64; 3], side: f64) -> Vec<Blob> {
    let [x, y, z] = center;
    let mut blobs = vec![Blob::ellipsoid([x, y - 0.25, z], [2.3, 1.75, 2.05])];
    for (dx, dz, r) in [(1.2, -1.5, 0.86), (2.05, -0.54, 0.98), (2.05, 0.54, 0.98), (1.2, 1.5, 0.86)] {
        blobs.push(Blob::bone([x + dx - 0.9, y + 0.3, z + dz * side], r, [x + dx, y - 0.55, z + dz * 1.05 * side], r));
    }
    blobs
}

fn skull() -> Melt {
    let mut blobs = vec![
        Blob::ellipsoid([-0.2, 0.4, 0.0], [4.3, 3.9, 4.5]),
        // Forehead and bridge of the nose.
        Blob::ellipsoid([1.2, 1.6, 0.0], [3.0, 2.3, 3.2]),
        Blob::bone([2.4, 0.7, 0.0], 1.75, [4.75, -0.85, 0.0], 0.8),
        // Nose.
        Blob::ellipsoid([5.35, -0.95, 0.0], [0.5, 0.42, 0.68]),
        // Chin.
        Blob::bone([1.6, -2.5, 0.0], 1.8, [4.2, -2.85, 0.0], 0.95),
    ];
    for side in [-1.0, 1.0] {
        // Cheek, whisker pad.
        blobs.push(Blob::ellipsoid([0.5, -1.3, 2.75 * side], [2.6, 2.1, 2.3]));
        blobs.push(Blob::ellipsoid([4.0, -1.75, 1.05 * side], [1.35, 1.0, 1.25]));
    }
    Melt::new(0.8, blobs)
}

/// An ear; `q` in the head's frame.
fn ear(q: DVec3, side: f64) -> Ear {
    let base = DVec3::new(-0.8, 2.5, 2.75 * side);
    let up = DVec3::new(-0.10, 0.93, 0.36 * side).normalize();
    // The hollow looks forward and a little outward.
    let front = DVec3::new(0.9, 0.0, 0.42 * side);
    let front = (front - up * front.dot(up)).normalize();
    let across = up.cross(front);
    let r = q - base;
    let local = DVec3::new(r.dot(across), r.dot(up), r.dot(front));
    let flat = 0.58;
    let squashed = DVec3::new(local.x, local.y, local.z / flat);
    let outside = flat * round_cone_y(squashed, 0.0, 2.6, 5.0, 0.3);
    let hollow = {
        let s = DVec3::new(local.x, local.y - 0.3, (local.z - 0.80) / 0.5);
        0.5 * round_cone_y(s, 0.4, 1.9, 4.1, 0.2)
    };
    Ear { outside, hollow }
}

/// A round cone on the y axis.
fn round_cone_y(p: DVec3, y0: f64, radius0: f64, y1: f64, radius1: f64) -> f64 {
    Blob::bone([0.0, y0, 0.0], radius0, [0.0, y1, 0.0], radius1).distance(p)
}
