//! Signed distance building blocks: positive outside, negative inside, in the model's unit.
//!
//! Round cone and ellipsoid after Inigo Quilez, "Distance functions" (the ellipsoid's is a first-order estimate, exact
//! on the surface); the smooth minimum is his quadratic polynomial one: it leaves the minimum alone where the two
//! differ by more than `k`, so that far shapes can be skipped exactly.

use glam::{DMat3, DVec3};

/// A convex blob that a body is made of.
#[derive(Clone, Copy, Debug)]
pub enum Blob {
    /// The convex hull of two balls.
    RoundCone {
        /// Centre of the first ball.
        a: DVec3,
        /// Radius of the first ball.
        radius_a: f64,
        /// Centre of the second ball.
        b: DVec3,
        /// Radius of the second ball.
        radius_b: f64,
    },
    /// An ellipsoid along turned axes.
    Ellipsoid {
        /// Centre.
        center: DVec3,
        /// Half axes.
        radii: DVec3,
        /// World from local: the columns are the directions of the half axes.
        axes: DMat3,
    },
}

impl Blob {
    /// A limb between two joints.
    pub fn bone(a: [f64; 3], radius_a: f64, b: [f64; 3], radius_b: f64) -> Blob {
        Blob::RoundCone { a: a.into(), radius_a, b: b.into(), radius_b }
    }

    /// A ball.
    pub fn ball(center: [f64; 3], radius: f64) -> Blob {
        Blob::ellipsoid(center, [radius; 3])
    }

    /// An ellipsoid along x, y and z.
    pub fn ellipsoid(center: [f64; 3], radii: [f64; 3]) -> Blob {
        Blob::Ellipsoid { center: center.into(), radii: radii.into(), axes: DMat3::IDENTITY }
    }

    /// Signed distance of `p`.
    pub fn distance(&self, p: DVec3) -> f64 {
        match *self {
            Blob::RoundCone { a, radius_a, b, radius_b } => round_cone(p, a, radius_a, b, radius_b),
            Blob::Ellipsoid { center, radii, axes } => {
                let q = axes.transpose() * (p - center);
                let k0 = (q / radii).length();
                let k1 = (q / (radii * radii)).length();
                if k1 < 1e-12 { -radii.min_element() } else { k0 * (k0 - 1.0) / k1 }
            }
        }
    }

    /// A ball that holds the blob: centre and radius.
    fn bound(&self) -> Ball {
        match *self {
            Blob::RoundCone { a, radius_a, b, radius_b } => {
                Ball { center: 0.5 * (a + b), radius: 0.5 * (b - a).length() + radius_a.max(radius_b) }
            }
            Blob::Ellipsoid { center, radii, .. } => Ball { center, radius: radii.max_element() },
        }
    }
}

fn round_cone(p: DVec3, a: DVec3, radius_a: f64, b: DVec3, radius_b: f64) -> f64 {
    let ba = b - a;
    let l2 = ba.length_squared();
    let rr = radius_a - radius_b;
    let a2 = l2 - rr * rr;
    let il2 = 1.0 / l2;
    let pa = p - a;
    let y = pa.dot(ba);
    let z = y - l2;
    let x2 = (pa * l2 - ba * y).length_squared();
    let y2 = y * y * l2;
    let z2 = z * z * l2;
    let k = rr.signum() * rr * rr * x2;
    if z.signum() * a2 * z2 > k {
        (x2 + z2).sqrt() * il2 - radius_b
    } else if y.signum() * a2 * y2 < k {
        (x2 + y2).sqrt() * il2 - radius_a
    } else {
        ((x2 * a2 * il2).sqrt() + y * rr) * il2 - radius_a
    }
}

#[derive(Clone, Copy, Debug)]
struct Ball {
    center: DVec3,
    radius: f64,
}

/// Blobs melted into one another.
#[derive(Clone, Debug)]
pub struct Melt {
    blobs: Vec<Blob>,
    softness: f64,
    bound: Ball,
}

impl Melt {
    /// Blobs that melt within `softness` (unit of length) of one another.
    pub fn new(softness: f64, blobs: Vec<Blob>) -> Melt {
        let bounds: Vec<Ball> = blobs.iter().map(Blob::bound).collect();
        let center = bounds.iter().map(|b| b.center).sum::<DVec3>() / bounds.len().max(1) as f64;
        let radius = bounds.iter().map(|b| (b.center - center).length() + b.radius).fold(0.0, f64::max);
        // Each join swells the surface by at most softness / 4; several can meet.
        Melt { blobs, softness, bound: Ball { center, radius: radius + softness } }
    }

    /// Signed distance of `p`.
    pub fn distance(&self, p: DVec3) -> f64 {
        self.blobs.iter().fold(f64::INFINITY, |d, blob| smooth_min(d, blob.distance(p), self.softness))
    }

    /// `smooth_min(d, self.distance(p), k)`, without looking at the blobs where they are too far to matter.
    pub fn join(&self, d: f64, p: DVec3, k: f64) -> f64 {
        if (p - self.bound.center).length() - self.bound.radius > d + k {
            return d;
        }
        smooth_min(d, self.distance(p), k)
    }
}

/// The smaller of two distances, with the crease between them filled over a width `k`.
pub fn smooth_min(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0);
    if h > 0.0 && h.is_finite() { a.min(b) - h * h / (4.0 * k) } else { a.min(b) }
}

/// The larger of two distances, with the edge between them rounded over a width `k`.
pub fn smooth_max(a: f64, b: f64, k: f64) -> f64 {
    -smooth_min(-a, -b, k)
}
