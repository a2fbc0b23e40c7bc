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
//!
//! # Parts
//! Large triangles that leave their boxes empty are cut (`build/parts.rs`), and the tree holds a box for each part. A
//! part is hit where t' lies in the interval of its own box, or outside it by no more than t' may be off; and t' is
//! clamped into that interval, so that whoever passes by the box may pass by the hit:
//!
//! ```text
//! slack     s = (m^2 + 2^-100) / |det| * ((zmax - zmin) * (2^-20 * |sz|)),
//!           m = max(|Ax|, |Ay|, |Bx| .. |Cy|),  z of A, B, C
//! part      t' < near - s or t' > far + s: no hit;  then as above, near and far being those of the part's box
//! ```
//!
//! The triangle's hit is the least of its parts' and exists wherever the edges say so: the edge functions are those of
//! a triangle whose corners are off by 5uM (see [`RaySpace`](super::ray_space)), each off by u (2 m^2 + |det|) for its
//! own roundings. With exact ones t' would be the depth of a point of the triangle that is within 5uM of the ray, hence
//! in the interval of the box of the part that has it, by the same count as there. The roundings of the three move t'
//! by u (6 m^2 + |det|) / |det| of the triangle's depth at most, and |det| <= 4 m^2: s is more. (2^-100 stands for
//! products that are subnormal; triangles are cut from 2^-30 on.) Seen face on s is some 2^-20 of the triangle's size;
//! seen edge-on it grows until t' says nothing, and the ray meets the first part whose box it is in.

use super::ray_space::{PAD, RaySpace};

/// See the slack above: 16 units in the last place.
pub const SLACK: f32 = 1.0 / 1_048_576.0; // 2^-20
pub const SLACK_OF_ZERO: f32 = 1.0 / (1u128 << 100) as f32;

/// The t > 0 at which the ray `origin + t direction` meets a triangle of render space, if it does. What a
/// tree answers is the least of these, to the bit, unless it has cut the triangle (see [`part_hit`]).
pub fn triangle_hit(triangle: [[f32; 3]; 3], origin: [f32; 3], direction: [f32; 3]) -> Option<f32> {
    hit(&RaySpace::new(origin, direction)?, 0.0, triangle)
}

/// How far the boxes of a triangle and of its parts are padded.
pub fn padding(triangle: [[f32; 3]; 3]) -> f32 {
    PAD * triangle.as_flattened().iter().fold(0.0, |largest: f32, x| largest.max(x.abs()))
}

/// The box of a triangle, padded: lower and upper corner.
pub fn padded_box(triangle: [[f32; 3]; 3]) -> [[f32; 3]; 2] {
    let [a, b, c] = triangle;
    let lower = [0, 1, 2].map(|i: usize| a[i].min(b[i]).min(c[i]));
    let upper = [0, 1, 2].map(|i: usize| a[i].max(b[i]).max(c[i]));
    let pad = padding(triangle);
    [lower.map(|x| x - pad), upper.map(|x| x + pad)]
}

/// As [`triangle_hit`] for a part of a triangle, which is what lies in the box `part` (lower and upper corner), padded
/// already. What a tree answers for a triangle that it has cut is the least of its parts'.
pub fn part_hit(triangle: [[f32; 3]; 3], part: [[f32; 3]; 2], origin: [f32; 3], direction: [f32; 3]) -> Option<f32> {
    hit_of_part(&RaySpace::new(origin, direction)?, 0.0, triangle, part)
}

/// The scalar twin of the kernels' leaf test. `tmin` is minus the distance by which the origin was moved (0 in the
/// world).
#[inline]
pub fn hit(ray: &RaySpace, tmin: f32, triangle: [[f32; 3]; 3]) -> Option<f32> {
    let passage = Passage::of(ray, triangle)?;
    let (near, far) = interval(ray, padded_box(triangle));
    (near <= far).then(|| clamped(passage.t, near, far) - tmin).filter(|t| *t > 0.0)
}

/// The scalar twin of the kernels' test of parts.
pub fn hit_of_part(ray: &RaySpace, tmin: f32, triangle: [[f32; 3]; 3], part: [[f32; 3]; 2]) -> Option<f32> {
    let passage = Passage::of(ray, triangle)?;
    let (near, far) = interval(ray, part);
    let slack = passage.slack(ray);
    // Written so that a slack without end, even times no depth, which is NaN, is enough.
    let beside = passage.t < near - slack || passage.t > far + slack;
    let here = near <= far && !beside;
    here.then(|| clamped(passage.t, near, far) - tmin).filter(|t| *t > 0.0)
}

/// Whether a ray's line passes through a triangle.
pub fn passes(ray: &RaySpace, triangle: [[f32; 3]; 3]) -> bool {
    Passage::of(ray, triangle).is_some()
}

/// How a ray's line passes through a triangle.
struct Passage {
    /// The corners, sheared.
    corners: [[f32; 3]; 3],
    det: f32,
    /// Before it is clamped.
    t: f32,
}

impl Passage {
    fn of(ray: &RaySpace, triangle: [[f32; 3]; 3]) -> Option<Self> {
        let axes = ray.axes.map(|axis| axis as usize);
        let corners = triangle.map(|v| {
            let p =
                [v[axes[0]] - ray.shear_origin[0], v[axes[1]] - ray.shear_origin[1], v[axes[2]] - ray.shear_origin[2]];
            [(-ray.shear[0]).mul_add(p[2], p[0]), (-ray.shear[1]).mul_add(p[2], p[1]), p[2]]
        });
        let [a, b, c] = corners;
        let u = c[0] * b[1] - c[1] * b[0];
        let v = a[0] * c[1] - a[1] * c[0];
        let w = b[0] * a[1] - b[1] * a[0];
        let det = (u + v) + w;
        let inside = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        if !inside || det == 0.0 {
            return None;
        }
        let t = (u.mul_add(a[2], v.mul_add(b[2], w * c[2])) / det) * ray.shear[2];
        Some(Self { corners, det, t })
    }

    /// How far off t may be for the rounding of the edge functions.
    fn slack(&self, ray: &RaySpace) -> f32 {
        let [a, b, c] = self.corners;
        let size = [a, b, c].iter().fold(0.0, |m: f32, p| m.max(p[0].abs()).max(p[1].abs()));
        let depth = a[2].max(b[2]).max(c[2]) - a[2].min(b[2]).min(c[2]);
        (size.mul_add(size, SLACK_OF_ZERO) / self.det.abs()) * (depth * (SLACK * ray.shear[2].abs()))
    }
}

/// Where the ray is inside a box.
fn interval(ray: &RaySpace, planes: [[f32; 3]; 2]) -> (f32, f32) {
    let (mut near, mut far) = (f32::NEG_INFINITY, f32::INFINITY);
    for i in 0..3 {
        let enter = planes.map(|plane| plane[i].mul_add(ray.rd[i], -ray.near_offset[i]));
        let leave = planes.map(|plane| plane[i].mul_add(ray.rd[i], -ray.far_offset[i]));
        near = near.max(enter[0].min(enter[1]));
        far = far.min(leave[0].max(leave[1]));
    }
    (near, far)
}

fn clamped(t: f32, near: f32, far: f32) -> f32 {
    let t = if t < near { near } else { t };
    if t > far { far } else { t }
}
