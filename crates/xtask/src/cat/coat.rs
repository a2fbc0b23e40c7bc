//! The cat's colours: a ginger mackerel tabby as a function of the point on the surface.
//!
//! Colours are sRGB-encoded, 0 to 1, as they go into the texture.

use super::anatomy::{Cat, EYE_RADIUS, Part};
use crate::noise::{noise, smooth_step};
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

const GINGER: DVec3 = DVec3::new(0.82, 0.56, 0.34);
const STRIPE: DVec3 = DVec3::new(0.53, 0.29, 0.15);
const CREAM: DVec3 = DVec3::new(0.97, 0.91, 0.82);
const PINK: DVec3 = DVec3::new(0.88, 0.58, 0.55);
const DARK: DVec3 = DVec3::new(0.16, 0.09, 0.06);

/// What a place looks like before the fur's grain.
#[derive(Clone, Copy)]
struct Fur {
    /// 0 ginger, 1 stripe.
    stripe: f64,
    /// 0 coloured, 1 cream.
    cream: f64,
}

/// Colour of the surface point `p` of a part, with the unit normal `n` there.
pub fn color(cat: &Cat, part: Part, p: DVec3, n: DVec3) -> DVec3 {
    let q = cat.to_head(p);
    if part == Part::Head {
        for side in [-1.0, 1.0] {
            let eye = Cat::to_eye(q, side) / EYE_RADIUS;
            if let Some(color) = eye_color(eye, side) {
                return color;
            }
        }
    }
    let fur = fur(cat, p, n);
    let grain = grain(p, part);
    let stripe = fur.stripe * (0.88 + 0.22 * grain).min(1.0);
    let mut color = GINGER.lerp(STRIPE, stripe).lerp(CREAM, fur.cream) * (1.0 + 0.2 * grain);
    if n.y < -0.7 && p.y < 0.3 {
        color = color.lerp(PINK * 0.85, 0.7);
    }
    if part == Part::Head {
        color = face_marks(q, color);
    }
    let hollow = cat.in_ear_hollow(p);
    if hollow > 0.0 {
        let pale = 0.15 + 0.2 * smooth_step(3.0, 6.5, q.y);
        color = color.lerp((PINK * (0.95 + 0.1 * grain)).lerp(CREAM, pale), hollow);
    }
    color.clamp(DVec3::ZERO, DVec3::ONE)
}

/// Stripes and light places, mixed over the parts that meet at `p`.
fn fur(cat: &Cat, p: DVec3, n: DVec3) -> Fur {
    let distances = cat.part_distances(p);
    let nearest = distances.nearest();
    let share = |d: f64| smooth_step(1.6, 0.0, d - nearest);
    let mut sum = Fur { stripe: 0.0, cream: 0.0 };
    let mut shares = 0.0;
    let mut mix = |d: f64, fur: &dyn Fn() -> Fur| {
        let w = share(d);
        if w > 0.0 {
            let f = fur();
            sum.stripe += w * f.stripe;
            sum.cream += w * f.cream;
            shares += w;
        }
    };
    mix(distances.torso, &|| torso_fur(p, n));
    mix(distances.head, &|| head_fur(cat.to_head(p), n));
    mix(distances.tail, &|| tail_fur(p));
    for d in distances.legs {
        mix(d, &|| leg_fur(p));
    }
    Fur { stripe: sum.stripe / shares, cream: sum.cream / shares }
}

fn torso_fur(p: DVec3, n: DVec3) -> Fur {
    let wander = 1.3 * noise(p * DVec3::new(0.16, 0.16, 0.22)) + 0.5 * noise(p * 0.45);
    let lean = 0.012 * (p.y - 22.0) * (p.x + 1.0);
    let s = p.x + lean + wander;
    let broken = smooth_step(-0.75, 0.0, noise(p * DVec3::new(0.35, 0.5, 0.35) + 7.3));
    let height = smooth_step(15.2, 19.0, p.y);
    let bands = stripes(s, 2.7) * broken * height;
    let spine = smooth_step(1.5, 0.5, p.z.abs() + 0.3 * noise(p * 0.6)) * smooth_step(0.5, 0.8, n.y);
    // Belly, chest and throat are light.
    let belly = smooth_step(-0.35, -0.85, n.y + 0.15 * noise(p * 0.5));
    let chest = smooth_step(2.6, 1.0, p.z.abs() + 0.5 * noise(p * 0.5))
        * smooth_step(0.3, 0.8, n.x)
        * smooth_step(9.0, 11.0, p.x);
    Fur { stripe: (0.85 * bands).max(0.9 * spine), cream: (0.85 * belly).max(0.75 * chest) }
}

fn tail_fur(p: DVec3) -> Fur {
    let t = Cat::along_tail(p);
    let tip = smooth_step(0.90, 0.94, t + 0.01 * noise(p * 0.8));
    let rings = stripes(t * 11.0 + 0.12 * noise(p * 0.7), 1.0) * smooth_step(0.02, 0.15, t);
    Fur { stripe: rings.max(tip), cream: 0.0 }
}

fn leg_fur(p: DVec3) -> Fur {
    let wander = 0.7 * noise(p * 0.3) + 0.3 * noise(p * 0.7);
    let rings = stripes(p.y + wander + 0.12 * p.x, 2.15) * smooth_step(4.2, 6.5, p.y);
    let inner = smooth_step(2.2, 1.0, p.z.abs()) * 0.5;
    let sock = smooth_step(5.0, 3.2, p.y + 0.9 * noise(p * 0.5));
    Fur { stripe: 0.8 * rings, cream: (0.92 * sock).max(inner) }
}

/// `q` in the head's frame.
fn head_fur(q: DVec3, n: DVec3) -> Fur {
    let side = q.z.abs();
    let wander = 0.25 * noise(q * 0.8);
    // The tabby's M: lines from the brow over the crown.
    let crown = stripes(side + 0.35 + 0.5 * wander, 1.05) * smooth_step(1.7, 2.4, q.y) * smooth_step(3.1, 2.7, side);
    // Lines from the eye's corner and across the cheek.
    let cheek_line = q.y + 0.28 * (q.x - 1.5) + wander;
    let cheek = stripes(cheek_line - 0.25, 1.35)
        * smooth_step(2.7, 3.2, side)
        * smooth_step(2.4, 1.6, q.x)
        * smooth_step(-2.6, -1.8, q.y)
        * smooth_step(2.0, 1.2, q.y);
    let neck = stripes(q.x + wander, 1.9) * smooth_step(-2.0, -3.2, q.x) * smooth_step(-1.5, 0.5, q.y);
    let muzzle = smooth_step(2.5, 1.7, (q - DVec3::new(4.6, -2.3, 0.0)).length() + 0.4 * wander);
    let chin = smooth_step(-1.7, -2.6, q.y + 0.6 * wander) * smooth_step(0.1, -0.3, n.y);
    let blaze =
        smooth_step(0.75, 0.35, side + 0.3 * wander) * smooth_step(2.6, 3.4, q.x) * smooth_step(2.1, 1.2, q.y) * 0.45;
    let around_eye = [-1.0, 1.0]
        .into_iter()
        .map(|s| smooth_step(1.75, 1.2, ((Cat::to_eye(q, s)) / EYE_RADIUS).length()) * 0.6)
        .fold(0.0, f64::max);
    Fur { stripe: 0.85 * crown.max(cheek).max(neck), cream: muzzle.max(chin).max(blaze).max(around_eye) }
}

/// Nose, mouth and whisker roots over the fur; `q` in the head's frame.
fn face_marks(q: DVec3, fur: DVec3) -> DVec3 {
    let side = q.z.abs();
    let mut color = fur;
    if q.x > 3.6 {
        // Whisker roots in three rows.
        for (row, y) in [-1.35, -1.7, -2.05].into_iter().enumerate() {
            for k in 0..3 {
                let z = 0.95 + 0.42 * k as f64 + 0.12 * row as f64;
                let d = ((q.y - y - 0.06 * k as f64).powi(2) + (side - z).powi(2)).sqrt();
                color = color.lerp(STRIPE, 0.75 * smooth_step(0.11, 0.06, d));
            }
        }
    }
    if q.x > 2.9 {
        // Mouth: down from the nose, then out along both lips.
        let bow = (side - 0.95) / 0.95;
        let lip = -2.22 - 0.36 * (1.0 - bow * bow) - 0.10 * side;
        let lips = smooth_step(0.11, 0.04, (q.y - lip).abs()) * smooth_step(1.75, 1.2, side);
        let groove = smooth_step(0.11, 0.05, side) * smooth_step(-1.25, -1.4, q.y) * smooth_step(-2.4, -2.25, q.y);
        color = color.lerp(DARK * 1.6, 0.65 * lips.max(groove));
    }
    if q.x > 4.6 {
        let half_width = 0.74 * ((q.y + 1.58) / 1.0).clamp(0.0, 1.0).sqrt();
        let inside = (half_width - side).min(-0.50 - q.y).min(q.y + 1.58);
        color = color.lerp(DARK * 2.2, smooth_step(-0.10, -0.02, inside));
        color = color.lerp(PINK, smooth_step(0.0, 0.07, inside));
        let nostril = DVec2::new((side - 0.34) / 0.15, (q.y + 1.15) / 0.11).length_squared();
        color = color.lerp(DARK, smooth_step(1.3, 0.7, nostril));
    }
    color
}

/// `eye` in the eye's frame, in radii; `None` outside the eye and its dark rim.
fn eye_color(eye: DVec3, side: f64) -> Option<DVec3> {
    if eye.z < 0.2 || eye.length() > 1.25 {
        return None;
    }
    let across = 1.0 - (eye.x / 0.86).powi(2);
    // Positive inside the almond.
    let inside = (0.66 * across - eye.y).min(0.58 * across + eye.y);
    if inside < -0.16 {
        return None;
    }
    if inside < 0.0 {
        return Some(DARK);
    }
    let r = (eye.x * eye.x + eye.y * eye.y).sqrt();
    let rays = 0.08 * noise(DVec3::new(9.0 * eye.x / r.max(0.05), 9.0 * eye.y / r.max(0.05), 2.0 * r));
    let green = DVec3::new(0.50, 0.62, 0.20);
    let yellow = DVec3::new(0.86, 0.80, 0.28);
    let mut color = yellow.lerp(green, smooth_step(0.2, 0.6, r)) * (1.0 + rays);
    color = color.lerp(DARK, 0.85 * smooth_step(0.62, 0.78, r));
    color = color.lerp(DARK, smooth_step(0.10, 0.02, inside));
    // The slit stands upright in the head, however the eye slants.
    let upright = Cat::to_eye(Cat::eye_center(side) + DVec3::Y, side).truncate().normalize();
    let (beside, above) = (upright.perp_dot(eye.truncate()), upright.dot(eye.truncate()));
    let slit = 0.19 * (1.0 - (above / 0.62) * (above / 0.62));
    color = color.lerp(DVec3::splat(0.02), smooth_step(-0.02, 0.03, slit - beside.abs()));
    // A glint, on the same side in both eyes.
    let glint = ((eye.x * side - 0.20).powi(2) + (eye.y - 0.26).powi(2)).sqrt();
    Some(color.lerp(DVec3::ONE, smooth_step(0.13, 0.08, glint)))
}

/// Hairs: noise drawn out along the way the fur lies.
fn grain(p: DVec3, part: Part) -> f64 {
    let along = match part {
        Part::Torso | Part::Tail => DVec3::new(0.9, 3.6, 3.6),
        Part::LeftForeleg | Part::RightForeleg | Part::LeftHindLeg | Part::RightHindLeg => DVec3::new(3.2, 0.9, 3.2),
        _ => DVec3::new(2.4, 3.8, 3.8),
    };
    0.6 * noise(p * along) + 0.4 * noise(p * along * 2.3 + 3.1)
}

/// 1 in a stripe, 0 between stripes; one stripe per `period`.
fn stripes(s: f64, period: f64) -> f64 {
    smooth_step(-0.15, 0.5, libm::sin(TAU * s / period))
}
