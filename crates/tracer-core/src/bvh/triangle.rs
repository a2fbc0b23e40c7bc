//! Where a ray meets a triangle: the canonical formula.
//!
//! Woop, Benthin and Wald, *Watertight Ray/Triangle Intersection*, JCGT 2013: the vertices are moved to the ray's
//! origin and sheared along its largest axis so that the ray becomes the axis; three edge functions in the plane then
//! decide. Each is two products and a difference, *without* fma, so that the two triangles of an edge get exactly
//! opposite values. Rounding is monotone, so a sign is right or the value is zero, and zero counts as inside: a ray
//! cannot slip between two triangles that share an edge or a vertex.
//!
//! Deviations: no double-precision fall-back (zero being inside on both sides makes up for it; a triangle seen so
//! exactly edge-on that its three functions vanish is no hit), and t is clamped into the interval of the triangle's own
//! box, which makes every traversal order agree (see [`RaySpace`](super::ray_space)).
//!
//! ```text
//! vertices  Az = a.z - o.z,  Ax = fma(-sx, Az, a.x - o.x),  Ay = fma(-sy, Az, a.y - o.y),  so for B and C
//! edges     U = Cx*By - Cy*Bx,  V = Ax*Cy - Ay*Cx,  W = Bx*Ay - By*Ax       all >= 0 or all <= 0, else no hit
//!           det = (U + V) + W                                               zero: no hit
//! distance  t' = (fma(U, Az, fma(V, Bz, W*Cz)) / det) * sz
//! box       pad = 2^-19 * (largest |coordinate|),  lower = min over vertices - pad,  upper = max over vertices + pad
//!           near = max over axes of min over (lower, upper) of fma(plane, rd, -near_offset)
//!           far = min over axes of max over (lower, upper) of fma(plane, rd, -far_offset);  near > far: no hit
//!           t' = t' < near ? near : t' ;  t' = t' > far ? far : t'
//! result    t = t' - tmin                      tmin = 0 in the world, -t0 in an instance; a hit where t > 0
//! ```

use super::ray_space::{PAD, RaySpace};

/// The t > 0 at which the ray `origin + t direction` meets a triangle of render space, if it does. What a
/// tree answers is the least of these, to the bit.
pub fn triangle_hit(triangle: [[f32; 3]; 3], origin: [f32; 3], direction: [f32; 3]) -> Option<f32> {
    hit(&RaySpace::new(origin, direction)?, 0.0, triangle)
}

/// The box of a triangle, padded by [`PAD`]: lower and upper corner.
pub(crate) fn padded_box(triangle: [[f32; 3]; 3]) -> [[f32; 3]; 2] {
    let [a, b, c] = triangle;
    let lower = [0, 1, 2].map(|i: usize| a[i].min(b[i]).min(c[i]));
    let upper = [0, 1, 2].map(|i: usize| a[i].max(b[i]).max(c[i]));
    let largest = [0, 1, 2].map(|i: usize| upper[i].max(-lower[i]));
    let pad = PAD * largest[0].max(largest[1]).max(largest[2]);
    [lower.map(|x| x - pad), upper.map(|x| x + pad)]
}

/// The scalar twin of the kernels' leaf test. `tmin` is minus the distance by which the origin was moved (0 in the world).
#[inline]
pub(crate) fn hit(ray: &RaySpace, tmin: f32, triangle: [[f32; 3]; 3]) -> Option<f32> {
    let axes = ray.axes.map(|axis| axis as usize);
    let [a, b, c] = triangle.map(|v| {
        let p = [v[axes[0]] - ray.shear_origin[0], v[axes[1]] - ray.shear_origin[1], v[axes[2]] - ray.shear_origin[2]];
        [(-ray.shear[0]).mul_add(p[2], p[0]), (-ray.shear[1]).mul_add(p[2], p[1]), p[2]]
    });
    let u = c[0] * b[1] - c[1] * b[0];
    let v = a[0] * c[1] - a[1] * c[0];
    let w = b[0] * a[1] - b[1] * a[0];
    let det = (u + v) + w;
    let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
    if !inside || det == 0.0 {
        return None;
    }
    let t = (u.mul_add(a[2], v.mul_add(b[2], w * c[2])) / det) * ray.shear[2];
    let (mut near, mut far) = (f32::NEG_INFINITY, f32::INFINITY);
    let planes = padded_box(triangle);
    for i in 0..3 {
        let enter = planes.map(|plane| plane[i].mul_add(ray.rd[i], -ray.near_offset[i]));
        let leave = planes.map(|plane| plane[i].mul_add(ray.rd[i], -ray.far_offset[i]));
        near = near.max(enter[0].min(enter[1]));
        far = far.min(leave[0].max(leave[1]));
    }
    if near > far {
        return None;
    }
    let t = if t < near { near } else { t };
    let t = if t > far { far } else { t };
    let t = t - tmin;
    (t > 0.0).then_some(t)
}
