//! The surface of triangles, lane by lane: the point by barycentric coordinates, and what is interpolated there.

use super::surface::Surface;
use crate::bvh::Accel;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{NONE, Scene, Triangles};

/// Three indices of a triangle.
#[inline(always)]
pub fn gather_indices<F: Lanes>(indices: &[[u32; 3]], triangle: F::U) -> [F::U; 3] {
    F::U::gather3(indices.as_flattened(), triangle * F::U::splat(3))
}

/// The axes in the order that makes the ray's largest one the last.
#[derive(Clone, Copy)]
struct AxisOrder<F: Lanes> {
    z_largest: F::M,
    y_largest: F::M,
}

impl<F: Lanes> AxisOrder<F> {
    #[inline(always)]
    fn of(d: V3<F>) -> Self {
        let (ax, ay, az) = (d.0.abs(), d.1.abs(), d.2.abs());
        let z_largest = ay.le(az) & ax.le(az);
        AxisOrder { z_largest, y_largest: !z_largest & ax.le(ay) }
    }
    #[inline(always)]
    fn pick(&self, x: F, y: F, z: F) -> F {
        F::select(self.z_largest, z, F::select(self.y_largest, y, x))
    }
    /// v with its axes turned (an even permutation).
    #[inline(always)]
    fn turn(&self, v: V3<F>) -> V3<F> {
        V3(self.pick(v.1, v.2, v.0), self.pick(v.2, v.0, v.1), self.pick(v.0, v.1, v.2))
    }
}

/// Barycentric coordinates of the ray in the triangle: the edge functions of the watertight test (Woop, Benthin, Wald
/// 2013) with the shear along the ray's largest axis, clamped into the triangle.
#[inline(always)]
fn barycentrics<F: Lanes>(origin: V3<F>, direction: V3<F>, corners: [V3<F>; 3]) -> [F; 3] {
    let c = F::splat;
    let order = AxisOrder::of(direction);
    let d = order.turn(direction);
    let (shear_x, shear_y) = (d.0 / d.2, d.1 / d.2);
    let v0 = order.turn(corners[0].sub(origin));
    let v1 = order.turn(corners[1].sub(origin));
    let v2 = order.turn(corners[2].sub(origin));
    let (x0, y0) = (v0.2.fnma(shear_x, v0.0), v0.2.fnma(shear_y, v0.1));
    let (x1, y1) = (v1.2.fnma(shear_x, v1.0), v1.2.fnma(shear_y, v1.1));
    let (x2, y2) = (v2.2.fnma(shear_x, v2.0), v2.2.fnma(shear_y, v2.1));
    let e0 = x2 * y1 - y2 * x1;
    let e1 = x0 * y2 - y0 * x2;
    let e2 = x1 * y0 - y1 * x0;
    let sum = e0 + e1 + e2;
    let usable = c(0.0).lt(sum.abs());
    let inverse = c(1.0) / F::select(usable, sum, c(1.0));
    let b0 = F::select(usable, (e0 * inverse).max(c(0.0)), c(1.0));
    let b1 = F::select(usable, (e1 * inverse).max(c(0.0)), c(0.0));
    let b2 = F::select(usable, (e2 * inverse).max(c(0.0)), c(0.0));
    let rescale = c(1.0) / (b0 + b1 + b2);
    [b0 * rescale, b1 * rescale, b2 * rescale]
}

/// Rays and the triangles that they hit.
#[derive(Clone, Copy)]
pub struct TriangleHits<F: Lanes> {
    /// Where the rays start.
    pub origin: V3<F>,
    /// Their unit directions.
    pub direction: V3<F>,
    /// The triangles.
    pub triangle: F::U,
    /// Their instances, or NONE.
    pub instance: F::U,
    /// Lanes that hit one; others hold anything.
    pub lanes: F::M,
}

/// A triangle as it is placed, and a point of it.
struct Placed<F: Lanes> {
    /// Lanes of instances.
    transformed: F::M,
    /// Whether any is one.
    any: bool,
    placement: Placement<F>,
    corner: [V3<F>; 3],
    /// Barycentric coordinates of the point.
    b: [F; 3],
}

impl<F: Lanes> Placed<F> {
    #[inline(always)]
    fn new(scene: &Scene, hits: &TriangleHits<F>) -> Self {
        let TriangleHits { origin, direction, triangle, instance, lanes } = *hits;
        let index = gather_indices::<F>(&scene.triangles.vertices, triangle);
        let positions = scene.triangles.positions.as_flattened();
        let mut corner = [
            V3::<F>::gather(positions, index[0]),
            V3::<F>::gather(positions, index[1]),
            V3::<F>::gather(positions, index[2]),
        ];
        let matrices = &scene.tables.instances.matrices;
        let transformed = lanes & !instance.eq(F::U::splat(NONE));
        let any = !matrices.is_empty() && transformed.any();
        let placement = Placement::<F>::gather(matrices, instance, any);
        if any {
            corner = [placement.point(corner[0]), placement.point(corner[1]), placement.point(corner[2])];
        }
        Placed { transformed, any, placement, corner, b: barycentrics(origin, direction, corner) }
    }

    /// The same mean of what stands at the corners.
    #[inline(always)]
    fn mean(&self, of: [V3<F>; 3]) -> V3<F> {
        of[0].scale(self.b[0]).add(of[1].scale(self.b[1])).add(of[2].scale(self.b[2]))
    }

    /// Unit normal, on the side that the vertices run round counterclockwise, mirrored instances included.
    #[inline(always)]
    fn normal(&self) -> V3<F> {
        let corner = &self.corner;
        let edge_normal = corner[1].sub(corner[0]).cross(corner[2].sub(corner[0]));
        let mut mirrored = F::M::from_bits(0);
        if self.any {
            mirrored = self.transformed & self.placement.determinant().lt(F::splat(0.0));
        }
        V3::select(mirrored, edge_normal.neg(), edge_normal).normalise()
    }

    /// Bound of the error of the point along a unit vector.
    #[inline(always)]
    fn error(&self) -> F {
        // pbrt 4, 6.8.4: |error| <= gamma(7) (|b0 v0| + |b1 v1| + |b2 v2|) per axis, gamma(n) = n e / (1 - n e),
        // e = 2^-24.
        let [first, second, third] = self.corner;
        let magnitude = self.mean([first.abs(), second.abs(), third.abs()]);
        let error = magnitude.scale(F::splat(7.0 * 5.960_465e-8));
        // All of it along the normal, whatever its direction: a ray that starts on the edge of two coplanar triangles
        // must not meet the other one, whose distance is wrong by its vertices' coordinates, not by those across the
        // plane (which may be zero).
        error.0 + error.1 + error.2
    }
}

/// What interpolated normals say of a point.
struct Smooth<F: Lanes> {
    /// Lanes that have them.
    lanes: F::M,
    /// The shading normal.
    ns: V3<F>,
    /// Where rays start.
    start: V3<F>,
}

impl<F: Lanes> Smooth<F> {
    /// Of a point p, whose geometric normal on the viewer's side is ng.
    #[inline(always)]
    fn new(triangles: &Triangles, hits: &TriangleHits<F>, placed: &Placed<F>, p: V3<F>, ng: V3<F>) -> Self {
        let c = F::splat;
        let mut smooth = Smooth { lanes: F::M::from_bits(0), ns: ng, start: p };
        if triangles.normal_indices.is_empty() {
            return smooth;
        }
        let index = gather_indices::<F>(&triangles.normal_indices, hits.triangle);
        let mut lanes = hits.lanes & !index[0].eq(F::U::splat(NONE));
        if !lanes.any() {
            return smooth;
        }
        let table = triangles.normals.as_flattened();
        let mut normal =
            [V3::<F>::gather(table, index[0]), V3::<F>::gather(table, index[1]), V3::<F>::gather(table, index[2])];
        if placed.any {
            let placement = &placed.placement;
            normal = [placement.normal(normal[0]), placement.normal(normal[1]), placement.normal(normal[2])];
        }
        let interpolated = placed.mean(normal);
        // Normals that cancel out say nothing: the triangle's own.
        let length2 = interpolated.dot(interpolated);
        lanes = lanes & c(1e-12).lt(length2);
        let unit = interpolated.scale(c(1.0) / F::select(lanes, length2, c(1.0)).sqrt());
        let turned = unit.dot(ng).lt(c(0.0));
        let facing = V3::select(turned, unit.neg(), unit);
        smooth.ns = V3::select(lanes, facing, ng);
        // Hanika 2021: from p up to the tangent plane of each vertex that it lies below, weighted by the barycentrics.
        // A vertex normal counts on the viewer's side; where the surface is hollow seen from there, nothing moves.
        let mut moved = p;
        for (k, normal) in normal.into_iter().enumerate() {
            let facing = V3::select(turned, normal.neg(), normal);
            let below = p.sub(placed.corner[k]).dot(facing).min(c(0.0));
            moved = facing.mad(-(below * placed.b[k]), moved);
        }
        smooth.start = V3::select(lanes, moved, p);
        smooth.lanes = lanes;
        smooth
    }
}

/// Texture coordinates at barycentric ones; zero where the triangle has none.
#[inline(always)]
fn texture_coordinates<F: Lanes>(triangles: &Triangles, hits: &TriangleHits<F>, b: [F; 3]) -> (F, F) {
    let zero = F::splat(0.0);
    if triangles.uv_indices.is_empty() {
        return (zero, zero);
    }
    let index = gather_indices::<F>(&triangles.uv_indices, hits.triangle);
    let has = hits.lanes & !index[0].eq(F::U::splat(NONE));
    if !has.any() {
        return (zero, zero);
    }
    let table = triangles.uvs.as_flattened();
    let (mut u, mut v) = (zero, zero);
    for k in 0..3 {
        let corner = F::gather2(table, F::U::select(has, index[k] + index[k], F::U::splat(0)));
        u = corner[0].fma(b[k], u);
        v = corner[1].fma(b[k], v);
    }
    (F::select(has, u, zero), F::select(has, v, zero))
}

/// The surface at hits of triangles.
#[inline(always)]
pub fn on_triangles<F: Lanes>(scene: &Scene, hits: TriangleHits<F>, wants_uv: bool) -> Surface<F> {
    let zero = F::splat(0.0);
    let triangles = &scene.triangles;
    let TriangleHits { direction, triangle, instance, .. } = hits;
    let placed = Placed::new(scene, &hits);
    let p = placed.mean(placed.corner);
    let n = placed.normal();
    let outside = n.dot(direction).lt(zero);
    let ng = V3::select(outside, n, n.neg());
    let mut offset = placed.error();
    if let Some(offsets) = scene.accel.as_deref().and_then(Accel::coplanar_offsets) {
        offset = offset.max(F::gather(offsets, triangle));
    }
    let Smooth { lanes: smooth, ns, start } = Smooth::new(triangles, &hits, &placed, p, ng);
    let start = ng.mad(offset, start);
    let (u, v) = if wants_uv { texture_coordinates(triangles, &hits, placed.b) } else { (zero, zero) };
    let mut material = F::U::gather(&triangles.material, triangle);
    if placed.any {
        let whole = F::U::gather(&scene.tables.instances.material, instance);
        material = F::U::select(placed.transformed & !whole.eq(F::U::splat(NONE)), whole, material);
    }
    let mut light = F::U::splat(0);
    if !triangles.light.is_empty() {
        light = F::U::gather(&triangles.light, triangle) + F::U::splat(1);
    }
    let body = instance + F::U::splat(scene.tables.loose());
    Surface { p, start, ng, ns, outside, smooth, offset, u, v, material, light, body, primitive: triangle }
}

/// The matrix of an instance: rows of its linear part, and the translation.
pub struct Placement<F: Lanes> {
    rows: [V3<F>; 3],
    translation: V3<F>,
}

impl<F: Lanes> Placement<F> {
    /// Gathers the matrices; anything when `wanted` is false.
    #[inline(always)]
    pub fn gather(matrices: &[f32], instance: F::U, wanted: bool) -> Self {
        let zero = V3::zero();
        if !wanted {
            return Placement { rows: [zero, zero, zero], translation: zero };
        }
        let (i, four) = (instance * F::U::splat(12), F::U::splat(4));
        let [ax, ay, az, tx] = F::gather4(matrices, i);
        let [bx, by, bz, ty] = F::gather4(matrices, i + four);
        let [cx, cy, cz, tz] = F::gather4(matrices, i + four + four);
        Placement { rows: [V3(ax, ay, az), V3(bx, by, bz), V3(cx, cy, cz)], translation: V3(tx, ty, tz) }
    }
    /// Where it puts a point.
    #[inline(always)]
    pub fn point(&self, p: V3<F>) -> V3<F> {
        let [a, b, c] = self.rows;
        let t = self.translation;
        V3(
            a.2.fma(p.2, a.1.fma(p.1, a.0.fma(p.0, t.0))),
            b.2.fma(p.2, b.1.fma(p.1, b.0.fma(p.0, t.1))),
            c.2.fma(p.2, c.1.fma(p.1, c.0.fma(p.0, t.2))),
        )
    }
    #[inline(always)]
    fn determinant(&self) -> F {
        self.rows[0].dot(self.rows[1].cross(self.rows[2]))
    }
    /// The unit normal in render space: by the transpose of the inverse, which is the matrix of cofactors up to a
    /// factor (whose sign does not matter: the caller turns normals to the viewer's side).
    #[inline(always)]
    fn normal(&self, n: V3<F>) -> V3<F> {
        let [a, b, c] = self.rows;
        let world = V3(b.cross(c).dot(n), c.cross(a).dot(n), a.cross(b).dot(n));
        let length2 = world.dot(world);
        let usable = F::splat(0.0).lt(length2);
        world.scale(F::splat(1.0) / F::select(usable, length2, F::splat(1.0)).sqrt())
    }
}
