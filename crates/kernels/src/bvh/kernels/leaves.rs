//! Leaf tests: one ray against four triangles, four spheres or one other shape. The formulas are those of
//! [`triangle`](super::super::triangle) and [`sphere`](super::super::sphere), operation by operation.

use super::super::layout::{Parts4, Shape, Spheres4, Triangles4};
use super::super::ray_space::{PAD, RaySpace};
use super::super::triangle::{SLACK, SLACK_OF_ZERO};
use super::isa::Isa;
use crate::shapes::csg::Part;

/// Candidates of a leaf: bit i of `mask` set where `t[i]` is a hit in (0, limit].
pub struct LeafHits {
    pub mask: u32,
    pub t: [f32; 4],
}

/// How a ray passes four triangles: the edge functions, their sum, and the corners' depths.
#[derive(Clone, Copy)]
pub struct Passage<I: Isa> {
    u: I::F4,
    v: I::F4,
    w: I::F4,
    det: I::F4,
    depths: [I::F4; 3],
}

impl<I: Isa> Passage<I> {
    /// A place holder.
    #[inline(always)]
    pub fn none(isa: I) -> Self {
        let zero = isa.splat4(0.0);
        Self { u: zero, v: zero, w: zero, det: zero, depths: [zero; 3] }
    }
}

/// The triangles of `leaf` that the ray meets at 0 < t <= `limit`, but for those whose bits are set in `skip`.
#[inline(always)]
pub fn triangles4<I: Isa>(
    isa: I,
    leaf: &Triangles4,
    ray: &RaySpace,
    tmin: f32,
    limit: f32,
    skip: u32,
) -> Option<LeafHits> {
    let (inside, passage) = passage4(isa, leaf, ray);
    let mask = inside & !skip;
    if mask == 0 {
        return None;
    }
    hits4(isa, leaf, ray, &passage, tmin, limit, mask)
}

/// As [`triangles4`], of the parts of `leaf`.
#[inline(always)]
pub fn parts4<I: Isa>(isa: I, leaf: &Parts4, ray: &RaySpace, tmin: f32, limit: f32, skip: u32) -> Option<LeafHits> {
    let (inside, passage) = passage4(isa, &leaf.triangles, ray);
    let mask = inside & !skip;
    if mask == 0 {
        return None;
    }
    parts_hits4(isa, leaf, ray, &passage, tmin, limit, mask)
}

/// The triangles of `leaf` that the ray's line passes through.
#[inline(always)]
pub fn passage4<I: Isa>(isa: I, leaf: &Triangles4, ray: &RaySpace) -> (u32, Passage<I>) {
    let [x, y, z] = ray.axes;
    let (sx, sy) = (isa.splat4(ray.shear[0]), isa.splat4(ray.shear[1]));
    let (ox, oy, oz) =
        (isa.splat4(ray.shear_origin[0]), isa.splat4(ray.shear_origin[1]), isa.splat4(ray.shear_origin[2]));
    let (az, bz, cz) =
        (isa.sub4(row(isa, leaf, 0, z), oz), isa.sub4(row(isa, leaf, 1, z), oz), isa.sub4(row(isa, leaf, 2, z), oz));
    let ax = isa.fnmadd4(sx, az, isa.sub4(row(isa, leaf, 0, x), ox));
    let ay = isa.fnmadd4(sy, az, isa.sub4(row(isa, leaf, 0, y), oy));
    let bx = isa.fnmadd4(sx, bz, isa.sub4(row(isa, leaf, 1, x), ox));
    let by = isa.fnmadd4(sy, bz, isa.sub4(row(isa, leaf, 1, y), oy));
    let cx = isa.fnmadd4(sx, cz, isa.sub4(row(isa, leaf, 2, x), ox));
    let cy = isa.fnmadd4(sy, cz, isa.sub4(row(isa, leaf, 2, y), oy));
    let u = isa.sub4(isa.mul4(cx, by), isa.mul4(cy, bx));
    let v = isa.sub4(isa.mul4(ax, cy), isa.mul4(ay, cx));
    let w = isa.sub4(isa.mul4(bx, ay), isa.mul4(by, ax));
    // Vertices and rays are finite and within range, so no product overflows and nothing here is NaN.
    let least = isa.min4(isa.min4(u, v), w);
    let most = isa.max4(isa.max4(u, v), w);
    let det = isa.add4(isa.add4(u, v), w);
    // All three >= 0 or all three <= 0.
    let inside = isa.max4(least, isa.neg4(most));
    (isa.not_negative_and_not_zero4(inside, det), Passage { u, v, w, det, depths: [az, bz, cz] })
}

/// Those of the triangles in `mask`, which the ray passes so, that it meets at 0 < t <= `limit`.
#[inline(always)]
pub fn hits4<I: Isa>(
    isa: I,
    leaf: &Triangles4,
    ray: &RaySpace,
    passage: &Passage<I>,
    tmin: f32,
    limit: f32,
    mask: u32,
) -> Option<LeafHits> {
    let t = distance4(isa, passage, ray);
    let (near, far) = interval4(isa, ray, &padded_planes(isa, leaf));
    hits_within4(isa, t, near, far, tmin, limit, mask & isa.le4(near, far))
}

/// As [`hits4`], of the parts of `leaf`.
#[inline(always)]
pub fn parts_hits4<I: Isa>(
    isa: I,
    leaf: &Parts4,
    ray: &RaySpace,
    passage: &Passage<I>,
    tmin: f32,
    limit: f32,
    mask: u32,
) -> Option<LeafHits> {
    let t = distance4(isa, passage, ray);
    let lower = [load(isa, &leaf.lower[0]), load(isa, &leaf.lower[1]), load(isa, &leaf.lower[2])];
    let upper = [load(isa, &leaf.upper[0]), load(isa, &leaf.upper[1]), load(isa, &leaf.upper[2])];
    let (near, far) = interval4(isa, ray, &(lower, upper));
    let slack = slack4(isa, &leaf.triangles, ray, passage);
    let cut = isa.le4(lower[0], upper[0]);
    let beside = cut & (isa.lt4(t, isa.sub4(near, slack)) | isa.lt4(isa.add4(far, slack), t));
    hits_within4(isa, t, near, far, tmin, limit, mask & isa.le4(near, far) & !beside)
}

/// t before it is clamped.
#[inline(always)]
fn distance4<I: Isa>(isa: I, passage: &Passage<I>, ray: &RaySpace) -> I::F4 {
    let Passage { u, v, w, det, depths: [az, bz, cz] } = *passage;
    let distance = isa.fmadd4(u, az, isa.fmadd4(v, bz, isa.mul4(w, cz)));
    isa.mul4(isa.div4(distance, det), isa.splat4(ray.shear[2]))
}

/// Where the ray is inside four boxes.
#[inline(always)]
fn interval4<I: Isa>(isa: I, ray: &RaySpace, (lower, upper): &([I::F4; 3], [I::F4; 3])) -> (I::F4, I::F4) {
    let (mut near, mut far) = (isa.splat4(f32::NEG_INFINITY), isa.splat4(f32::INFINITY));
    for axis in 0..3 {
        let (lower, upper) = (lower[axis], upper[axis]);
        let rd = isa.splat4(ray.rd[axis]);
        let (enter, leave) = (isa.splat4(ray.near_offset[axis]), isa.splat4(ray.far_offset[axis]));
        near = isa.max4(near, isa.min4(isa.fmsub4(lower, rd, enter), isa.fmsub4(upper, rd, enter)));
        far = isa.min4(far, isa.max4(isa.fmsub4(lower, rd, leave), isa.fmsub4(upper, rd, leave)));
    }
    (near, far)
}

/// How far off t may be for the rounding of the edge functions.
#[inline(always)]
fn slack4<I: Isa>(isa: I, leaf: &Triangles4, ray: &RaySpace, passage: &Passage<I>) -> I::F4 {
    let [x, y, _] = ray.axes;
    let (sx, sy) = (isa.splat4(ray.shear[0]), isa.splat4(ray.shear[1]));
    let (ox, oy) = (isa.splat4(ray.shear_origin[0]), isa.splat4(ray.shear_origin[1]));
    let mut size = isa.splat4(0.0);
    for (vertex, z) in passage.depths.into_iter().enumerate() {
        let px = isa.fnmadd4(sx, z, isa.sub4(row(isa, leaf, vertex, x), ox));
        let py = isa.fnmadd4(sy, z, isa.sub4(row(isa, leaf, vertex, y), oy));
        size = isa.max4(size, isa.max4(absolute4(isa, px), absolute4(isa, py)));
    }
    let [az, bz, cz] = passage.depths;
    let depth = isa.sub4(isa.max4(isa.max4(az, bz), cz), isa.min4(isa.min4(az, bz), cz));
    let size = isa.fmadd4(size, size, isa.splat4(SLACK_OF_ZERO));
    let unit = isa.splat4(SLACK * ray.shear[2].abs());
    isa.mul4(isa.div4(size, absolute4(isa, passage.det)), isa.mul4(depth, unit))
}

#[inline(always)]
fn absolute4<I: Isa>(isa: I, a: I::F4) -> I::F4 {
    isa.max4(a, isa.neg4(a))
}

/// Those of `mask` whose t, clamped, is in (0, limit].
#[inline(always)]
fn hits_within4<I: Isa>(
    isa: I,
    t: I::F4,
    near: I::F4,
    far: I::F4,
    tmin: f32,
    limit: f32,
    mask: u32,
) -> Option<LeafHits> {
    let t = isa.sub4(isa.min4(isa.max4(t, near), far), isa.splat4(tmin));
    let mask = mask & isa.lt4(isa.splat4(0.0), t) & isa.le4(t, isa.splat4(limit));
    if mask == 0 {
        return None;
    }
    Some(LeafHits { mask, t: isa.array4(t) })
}

/// The padded boxes of four triangles: axis, triangle.
pub struct PaddedBoxes {
    pub lower: [[f32; 4]; 3],
    pub upper: [[f32; 4]; 3],
}

/// The boxes that the triangle test clamps to, for reading one by one.
#[inline(always)]
pub fn padded_boxes<I: Isa>(isa: I, leaf: &Triangles4) -> PaddedBoxes {
    let ([lx, ly, lz], [ux, uy, uz]) = padded_planes(isa, leaf);
    PaddedBoxes {
        lower: [isa.array4(lx), isa.array4(ly), isa.array4(lz)],
        upper: [isa.array4(ux), isa.array4(uy), isa.array4(uz)],
    }
}

/// Lower and upper planes of the triangles' boxes, padded by [`PAD`] of their largest coordinate.
#[inline(always)]
fn padded_planes<I: Isa>(isa: I, leaf: &Triangles4) -> ([I::F4; 3], [I::F4; 3]) {
    let (mut lower, mut upper) = ([isa.splat4(0.0); 3], [isa.splat4(0.0); 3]);
    for axis in 0..3 {
        let (a, b, c) = (row(isa, leaf, 0, axis), row(isa, leaf, 1, axis), row(isa, leaf, 2, axis));
        lower[axis as usize] = isa.min4(isa.min4(a, b), c);
        upper[axis as usize] = isa.max4(isa.max4(a, b), c);
    }
    let largest_x = isa.max4(upper[0], isa.neg4(lower[0]));
    let largest_y = isa.max4(upper[1], isa.neg4(lower[1]));
    let largest_z = isa.max4(upper[2], isa.neg4(lower[2]));
    let pad = isa.mul4(isa.splat4(PAD), isa.max4(isa.max4(largest_x, largest_y), largest_z));
    (
        [isa.sub4(lower[0], pad), isa.sub4(lower[1], pad), isa.sub4(lower[2], pad)],
        [isa.add4(upper[0], pad), isa.add4(upper[1], pad), isa.add4(upper[2], pad)],
    )
}

/// The spheres of `leaf` that the ray meets at 0 < t <= `limit`. `from` is the primitive that the ray leaves.
#[inline(always)]
pub fn spheres4<I: Isa>(
    isa: I,
    leaf: &Spheres4,
    origin: [f32; 3],
    direction: [f32; 3],
    from: u32,
    limit: f32,
) -> Option<LeafHits> {
    // SAFETY: the rows of a leaf are aligned to 16 bytes.
    let ids = unsafe { isa.load_words4(leaf.ids.as_ptr()) };
    let from = isa.splat_words4(from);
    let (dx, dy, dz) = (isa.splat4(direction[0]), isa.splat4(direction[1]), isa.splat4(direction[2]));
    let (nx, ny, nz) = (load(isa, &leaf.normal[0]), load(isa, &leaf.normal[1]), load(isa, &leaf.normal[2]));
    let k = load(isa, &leaf.curvature);
    let dd = dot(isa, dx, dy, dz, dx, dy, dz);
    let idd = isa.div4(isa.splat4(1.0), dd);
    let gx = isa.sub4(isa.splat4(origin[0]), load(isa, &leaf.anchor[0]));
    let gy = isa.sub4(isa.splat4(origin[1]), load(isa, &leaf.anchor[1]));
    let gz = isa.sub4(isa.splat4(origin[2]), load(isa, &leaf.anchor[2]));
    let s = isa.zero_where_eq4(ids, from, isa.neg4(isa.mul4(dot(isa, gx, gy, gz, dx, dy, dz), idd)));
    let (gx, gy, gz) = (isa.fmadd4(s, dx, gx), isa.fmadd4(s, dy, gy), isa.fmadd4(s, dz, gz));
    let beta = isa.fmadd4(k, dot(isa, gx, gy, gz, dx, dy, dz), dot(isa, nx, ny, nz, dx, dy, dz));
    let twice = isa.mul4(isa.splat4(2.0), dot(isa, nx, ny, nz, gx, gy, gz));
    let gamma = isa.zero_where_eq4(ids, from, isa.fmadd4(k, dot(isa, gx, gy, gz, gx, gy, gz), twice));
    let a = isa.mul4(k, dd);
    let disc = isa.fmadd4(beta, beta, isa.neg4(isa.mul4(a, gamma)));
    let zero = isa.splat4(0.0);
    let met = isa.le4(zero, disc);
    if met == 0 {
        return None;
    }
    let q = isa.neg4(isa.add4(beta, isa.copysign4(isa.sqrt4(disc), beta)));
    let (u0, u1) = (isa.div4(gamma, q), isa.div4(q, a));
    let (near, far) = (isa.add4(s, isa.min4(u0, u1)), isa.add4(s, isa.max4(u1, u0)));
    let t = isa.where_gt4(near, zero, near, far);
    let mask = met & isa.lt4(zero, t) & isa.le4(t, isa.splat4(limit)) & isa.lt4(t, isa.splat4(f32::INFINITY));
    if mask == 0 {
        return None;
    }
    Some(LeafHits { mask, t: isa.array4(t) })
}

/// Where the ray meets the shape at 0 < t <= `limit`; `from` is the primitive that the ray leaves, `target` the one
/// that it goes to, which counts only where another part of it stands before the ray's end. One function for all
/// levels and widths ([`Row::hit`](crate::shapes::Row::hit)), so that they have the same bits. `parts`: those of all
/// shapes that are made of several.
#[inline(always)]
pub fn shape(
    leaf: &Shape,
    parts: &[Part],
    origin: [f32; 3],
    direction: [f32; 3],
    [from, target]: [u32; 2],
    limit: f32,
) -> Option<LeafHits> {
    if leaf.ids[0] == target {
        let hides = leaf.row.hides_itself(parts, origin, direction, target == from, limit);
        return hides.then_some(LeafHits { mask: 1, t: [0.5 * limit; 4] });
    }
    let t = leaf.row.hit_among(parts, origin, direction, leaf.ids[0] == from)?;
    (t <= limit).then_some(LeafHits { mask: 1, t: [t; 4] })
}

/// One coordinate of one vertex of the four triangles.
#[inline(always)]
fn row<I: Isa>(isa: I, leaf: &Triangles4, vertex: usize, axis: u32) -> I::F4 {
    debug_assert!(vertex < 3 && axis < 3);
    // SAFETY: the rows of a leaf are aligned to 16 bytes, and there are three of three: callers pass literals or
    // `RaySpace::axes`, which are below 3.
    unsafe { isa.load4(leaf.vertices.as_ptr().cast::<[f32; 4]>().add(3 * vertex + axis as usize).cast()) }
}

#[inline(always)]
fn load<I: Isa>(isa: I, row: &[f32; 4]) -> I::F4 {
    // SAFETY: the rows of a leaf are aligned to 16 bytes.
    unsafe { isa.load4(row.as_ptr()) }
}

#[inline(always)]
fn dot<I: Isa>(isa: I, ax: I::F4, ay: I::F4, az: I::F4, bx: I::F4, by: I::F4, bz: I::F4) -> I::F4 {
    isa.fmadd4(ax, bx, isa.fmadd4(ay, by, isa.mul4(az, bz)))
}

/// The bits of the four ids that equal `id` (`NONE` finds the unused places, which nothing hits anyway).
#[inline(always)]
pub fn places_of<I: Isa>(isa: I, ids: &[u32; 4], id: u32) -> u32 {
    // SAFETY: the rows of a leaf are aligned to 16 bytes.
    let ids = unsafe { isa.load_words4(ids.as_ptr()) };
    isa.eq_words4(ids, isa.splat_words4(id))
}
