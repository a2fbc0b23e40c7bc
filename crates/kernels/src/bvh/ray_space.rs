//! A ray made ready for one space (the world's, or an instance's object space): what boxes and triangles are tested
//! with.
//!
//! # Boxes that can lose nothing
//! A slab test answers with the interval of t in which the ray is inside a box. Here it is computed as `plane * rd −
//! (o * rd ± pad * |rd|)`, one fma: a *monotone* function of the plane. So the interval of a box lies within the
//! interval of any box around it, exactly, in floating point. A triangle's hit is clamped into the interval of the
//! triangle's own box, or that of its part (see [`triangle`](super::triangle)), hence into the interval of every box of
//! the tree that holds it: a traversal, in whatever order, finds what testing every triangle finds, to the last bit.
//!
//! `pad` only keeps true hits from being clamped or thrown away. With u = 2^-24 and M = max|o| + max|v|, over the
//! coordinates of origin and triangle: the sheared vertices are off by at most 5uM, t times the direction by 8uM, and
//! the slab's own roundings add 4uM; 32uM = 2^-19 M covers the sum of 17uM. The part with max|o| is the ray's `pad`;
//! the part with max|v| widens the triangle's box itself ([`PAD`]), so that a large primitive costs the small nothing.
//!
//! A component of the direction below 2^-50 of the largest one is taken as that much (its sign kept): the ray then
//! leaves its true place by 2^-50 of the distance, far inside `pad`, and no reciprocal is infinite.

/// The largest coordinate, and the largest and (inverted) smallest direction, with which the arithmetic cannot
/// overflow.
pub const RANGE: f32 = 1_099_511_627_776.0; // 2^40
/// Smaller components of directions are taken for this.
pub const SMALLEST_COMPONENT: f32 = 1.0 / 1_125_899_906_842_624.0; // 2^-50
/// 2^-19: by this part of the largest coordinate (of the origin, of the triangle) boxes are padded.
pub const PAD: f32 = 1.0 / 524_288.0;

/// A ray in one space. Arrays are indexed by axis, but `shear_origin` and `shear` by *role*: see `axes`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct RaySpace {
    /// 1 / direction, finite.
    pub rd: [f32; 3],
    /// What the near planes' products are lessened by: `o * rd + pad * |rd|`.
    pub near_offset: [f32; 3],
    /// What the far planes' products are lessened by: `o * rd − pad * |rd|`.
    pub far_offset: [f32; 3],
    /// Bit i set: component i of the direction is negative.
    pub octant: u32,
    /// The axes in the roles x, y, z of the triangle test: z is where the direction is largest.
    pub axes: [u32; 3],
    /// The origin in those roles.
    pub shear_origin: [f32; 3],
    /// dx / dz, dy / dz and 1 / dz in those roles.
    pub shear: [f32; 3],
}

impl RaySpace {
    /// A place holder that is never traced.
    pub const NOWHERE: Self = Self {
        rd: [0.0; 3],
        near_offset: [0.0; 3],
        far_offset: [0.0; 3],
        octant: 0,
        axes: [0; 3],
        shear_origin: [0.0; 3],
        shear: [0.0; 3],
    };

    /// `None` where the ray is no ray: something not finite, no direction, or beyond [`RANGE`].
    #[inline(always)]
    pub fn new(o: [f32; 3], d: [f32; 3]) -> Option<Self> {
        let a = [d[0].abs(), d[1].abs(), d[2].abs()];
        // Written for conditional moves: which one it is cannot be predicted.
        let of_two = usize::from(a[0] <= a[1]);
        let z = if larger(a[0], a[1]) > a[2] { of_two } else { 2 };
        let largest = a[z];
        let far = larger(larger(o[0].abs(), o[1].abs()), o[2].abs());
        // Comparisons with a NaN are false, so this refuses them too (each component by itself: a maximum may drop
        // one).
        let ordinary = o[0].abs() <= RANGE && o[1].abs() <= RANGE && o[2].abs() <= RANGE;
        let pointed = a[0] <= RANGE && a[1] <= RANGE && a[2] <= RANGE && largest >= 1.0 / RANGE;
        if !(ordinary && pointed) {
            return None;
        }
        let pad = PAD * far;
        let least = largest * SMALLEST_COMPONENT;
        let (mut rd, mut near_offset, mut far_offset, mut octant) = ([0.0; 3], [0.0; 3], [0.0; 3], 0);
        for i in 0..3 {
            let r = 1.0 / larger(a[i], least).copysign(d[i]);
            rd[i] = r;
            near_offset[i] = o[i].mul_add(r, pad * r.abs());
            far_offset[i] = o[i].mul_add(r, -(pad * r.abs()));
            octant |= (d[i].to_bits() >> 31) << i;
        }
        let (x, y) = ([1, 2, 0][z], [2, 0, 1][z]);
        let inverse = 1.0 / d[z];
        Some(Self {
            rd,
            near_offset,
            far_offset,
            octant,
            axes: [x as u32, y as u32, z as u32],
            shear_origin: [o[x], o[y], o[z]],
            shear: [d[x] * inverse, d[y] * inverse, inverse],
        })
    }
}

#[inline(always)]
fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
