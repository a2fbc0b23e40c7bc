//! Which segments from a suffix to the members of its group no triangle can block: a fan of up to 64, all at once.
//!
//! In a scene of few triangles most of the work is done once a suffix, over lanes that are triangles: the planes
//! through y and their edges, and on which sides of them the bounds of the members lie. Few triangles are left, and
//! each is four inner products a member.
//!
//! With m a member, d = m - y, and p, q the ends of an edge, f = ((p - y) x (q - y)) . d has the sign of the side on
//! which the line of the segment passes the edge. Where two edges of a triangle are passed on different sides (they are
//! taken in turn), the line passes beside it. Where y and m are on one side of its plane, the segment ends before it.
//!
//! # The tree's answers
//! What is said to be free here, the tree finds free ([`triangle`](crate::bvh::triangle_hit), and parts of triangles),
//! to the last bit; the rest the tree is asked about. With u = 2^-24 and M the sum of the largest coordinates of the
//! triangle and of the segments (render space is about one in size, so no product vanishes):
//!
//! The tree's edge functions are those of corners that are off by 5uM, for a line that is off by 8uM, which moves f by
//! 8 + 14 times uM |d| (|p - y| + |q - y|); their own roundings by 11, those here by 9 times that. 2^-17 = 128u is
//! three times as much.
//!
//! The tree's t is that of a point of the triangle which is off by 10uM from its plane, and by 57u L^3 / (A |n.d|)
//! along the ray, whose distance from the plane changes by |n.d| for each of its length: L is the longest side, A the
//! area. (6u m^2 / |det| of the depth for the roundings of the edge functions, and twice 8u m^2 / |det| where a part
//! takes what lies beside it; m^2 is 3 L^2 at most, the depth times the largest component's inverse 1.8 L, and |det|
//! 2 A |n.d| but for 14uM L, which its corners may be off.) Where 14uM L is at most half of that, the distance from the
//! plane is less than 2 * 57u L^3 / A, which is 800uM L^2 / (2 A), as L is at most 3.5M. Where it is more, t may be
//! that of any point of the triangle, which is L |n.d| from the plane, less than 28uM L^2 / (2 A). The slack here is
//! 128uM (1 + 8 L^2 / (2 A)), and what is nearer than that is never called one side.

use super::shaft::{Ends, Shaft};
use crate::engine::batch::{Group, Members};
use crate::lanes::{Bits, Lanes, Mask, Part};
use crate::math::V3;
use crate::scene::OccluderTable;

/// 2^-17, see above.
const MARGIN: f32 = 1.0 / 131_072.0;
/// No more triangles than these are tested member by member.
const MOST: usize = 48;
/// No lanes are more.
const MOST_LANES: usize = 16;
/// Numbers of a triangle: for each edge the normal of the plane through y and it, and the f from which on the side is
/// sure; then the triangle's normal towards y (zero where y is on no side of it for sure) and the height along it from
/// which on members are on y's side.
const NUMBERS: usize = 16;
const HEIGHT: usize = 15;

/// The triangles that may hide a suffix from members of its group.
pub struct Fan {
    /// How many there are; more than [`MOST`] are too many.
    len: usize,
    y: [f32; 3],
    rows: [[f32; NUMBERS]; MOST],
    ids: [u32; MOST],
}

impl Fan {
    /// Of no suffix.
    pub fn new() -> Self {
        Fan { len: 0, y: [0.0; 3], rows: [[0.0; NUMBERS]; MOST], ids: [0; MOST] }
    }

    /// Finds those triangles, but for `primitive`, that may stand between the ends of a shaft; `false` where they are
    /// too many.
    #[inline(always)]
    pub fn find<F: Lanes>(&mut self, table: &OccluderTable, ends: &Ends, shaft: &Shaft, primitive: u32) -> bool {
        F::apart(Find { fan: self, table, ends, shaft, primitive });
        self.len <= MOST
    }

    /// Takes the triangles base .. base + N that are in `lanes`.
    #[inline(always)]
    fn take(&mut self, table: &OccluderTable, base: usize, lanes: u32, columns: &[[f32; MOST_LANES]; NUMBERS]) {
        let mut left = lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % MOST_LANES;
            left &= left - 1;
            if let (Some(row), Some(id)) = (self.rows.get_mut(self.len), self.ids.get_mut(self.len)) {
                for (number, column) in row.iter_mut().zip(columns) {
                    *number = column[lane];
                }
                *id = table.id[base + lane];
            }
            self.len += 1;
        }
    }

    /// Members of the group, among those with a bit set in the mask, that a triangle may hide y from; `from`: the
    /// primitives that their segments leave. The triangles must not be too many.
    #[inline(always)]
    pub fn in_doubt<F: Lanes>(&self, members: &Members, group: Group, from: &[u32; 64], mask: u64) -> u64 {
        if self.len == 0 {
            return 0;
        }
        F::apart(Doubt { fan: self, members, group, from, mask })
    }
}

/// [`Fan::find`].
struct Find<'a> {
    fan: &'a mut Fan,
    table: &'a OccluderTable,
    ends: &'a Ends,
    shaft: &'a Shaft,
    primitive: u32,
}

impl<F: Lanes> Part<F> for Find<'_> {
    type Out = ();
    #[inline(always)]
    fn run(self) {
        let Find { fan, table, ends, shaft, primitive } = self;
        (fan.len, fan.y) = (0, shaft.y);
        let mut columns = [[0.0; MOST_LANES]; NUMBERS];
        for base in (0..table.len).step_by(F::N) {
            let other = F::first(table.len - base) & !F::U::load(&table.id[base..]).eq(F::U::splat(primitive));
            let between = between::<F>(table, ends, shaft, base, other, &mut columns);
            fan.take(table, base, between.bits(), &columns);
            if fan.len > MOST {
                return;
            }
        }
    }
}

/// [`Fan::in_doubt`].
struct Doubt<'a> {
    fan: &'a Fan,
    members: &'a Members,
    group: Group,
    from: &'a [u32; 64],
    mask: u64,
}

impl<F: Lanes> Part<F> for Doubt<'_> {
    type Out = u64;
    #[inline(always)]
    fn run(self) -> u64 {
        let Doubt { fan, members, group, from, mask } = self;
        let (zero, y) = (F::splat(0.0), V3::<F>::splat(fan.y));
        let mut all = 0;
        for base in (0..group.len as usize).step_by(F::N) {
            let lanes = F::M::from_bits((mask >> base) as u32) & F::first(group.len as usize - base);
            if !lanes.any() {
                continue;
            }
            let start = V3::<F>::load(&members.start, group.first as usize + base);
            let (away, from) = (start.sub(y), F::U::load(&from[base..]));
            let mut doubt = F::M::from_bits(0);
            for (row, &id) in fan.rows.iter().zip(&fan.ids).take(fan.len) {
                let (mut most, mut least) = (F::splat(f32::NEG_INFINITY), F::splat(f32::INFINITY));
                for edge in row[..HEIGHT - 3].chunks_exact(4) {
                    let f = V3::<F>::splat([edge[0], edge[1], edge[2]]).dot(away);
                    let margin = F::splat(edge[3]);
                    most = (f - margin).max(most);
                    least = (f + margin).min(least);
                }
                let beside = zero.lt(most) & least.lt(zero);
                let along = V3::<F>::splat([row[HEIGHT - 3], row[HEIGHT - 2], row[HEIGHT - 1]]).dot(start);
                let before = F::splat(row[HEIGHT]).lt(along);
                doubt = doubt | !(beside | before | from.eq(F::U::splat(id)));
            }
            all |= u64::from((doubt & lanes).bits()) << base;
        }
        all
    }
}

/// Which of the triangles base .. base + N, among `lanes`, may stand between the ends of a shaft; `columns` are their
/// numbers.
#[inline(always)]
fn between<F: Lanes>(
    table: &OccluderTable,
    ends: &Ends,
    shaft: &Shaft,
    base: usize,
    lanes: F::M,
    columns: &mut [[f32; MOST_LANES]; NUMBERS],
) -> F::M {
    let (c, zero) = (F::splat, F::splat(0.0));
    let reach = (F::load(&table.magnitude[base..]) + c(shaft.magnitude)) * c(MARGIN);
    // On which side of the triangle's plane y is, and all members are.
    let (normal, height) = (V3::<F>::load(&table.normal, base), F::load(&table.height[base..]));
    let slack = reach * F::load(&table.slack[base..]);
    let of_y = normal.dot(V3::splat(shaft.y)) - height;
    let (least, most) = over_box(normal, ends.lower, ends.upper);
    let (above, below) = (slack.lt(of_y), of_y.lt(-slack));
    let one_side = (above & slack.lt(least - height)) | (below & (most - height).lt(-slack));
    let lanes = lanes & !one_side;
    if !lanes.any() {
        return lanes;
    }
    let y = V3::splat(shaft.y);
    let a = V3::<F>::load(&table.corners[0], base).sub(y);
    let b = V3::<F>::load(&table.corners[1], base).sub(y);
    let p = V3::<F>::load(&table.corners[2], base).sub(y);
    let far = reach * c(shaft.length2.sqrt());
    let none = F::M::from_bits(0);
    let (mut left, mut right) = (none, none);
    for (edge, (from, to)) in [(a, b), (b, p), (p, a)].into_iter().enumerate() {
        let normal = from.cross(to);
        let margin = far * (sum(from.abs()) + sum(to.abs()));
        let (least, most) = over_box(normal, shaft.lower, shaft.upper);
        left = left | margin.lt(least);
        right = right | most.lt(-margin);
        normal.0.store(&mut columns[4 * edge]);
        normal.1.store(&mut columns[4 * edge + 1]);
        normal.2.store(&mut columns[4 * edge + 2]);
        margin.store(&mut columns[4 * edge + 3]);
    }
    // Where the triangle has no plane its normal is no number, and y on no side of it.
    let sided = above | below;
    let sign = F::select(above, c(1.0), c(-1.0));
    F::select(sided, normal.0 * sign, zero).store(&mut columns[HEIGHT - 3]);
    F::select(sided, normal.1 * sign, zero).store(&mut columns[HEIGHT - 2]);
    F::select(sided, normal.2 * sign, zero).store(&mut columns[HEIGHT - 1]);
    F::select(sided, height.fma(sign, slack), c(f32::INFINITY)).store(&mut columns[HEIGHT]);
    lanes & !(left & right)
}

#[inline(always)]
fn sum<F: Lanes>(v: V3<F>) -> F {
    v.0 + v.1 + v.2
}

/// Least and greatest inner product of a vector with the points of a box.
#[inline(always)]
fn over_box<F: Lanes>(v: V3<F>, lower: [f32; 3], upper: [f32; 3]) -> (F, F) {
    let (a, b) = (v.mul(V3::splat(lower)), v.mul(V3::splat(upper)));
    let least = a.0.min(b.0) + a.1.min(b.1) + a.2.min(b.2);
    (least, a.0.max(b.0) + a.1.max(b.1) + a.2.max(b.2))
}

#[cfg(test)]
mod tests;
