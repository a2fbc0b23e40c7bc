//! From a hit to the surface there: point, normals, texture coordinates, material.

use super::shapes::on_shapes;
use crate::bvh::Accel;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::{V3, acos, atan2_turns};
use crate::scene::{NONE, Scene};

/// The surface at a hit.
#[derive(Clone, Copy)]
pub struct Surface<F: Lanes> {
    /// The point, on the surface to a few ulp.
    pub p: V3<F>,
    /// Where rays of diffuse and glossy scattering start: on low-poly smooth meshes a point of the smooth surface that
    /// the triangle stands for (Hanika: Hacking the Shadow Terminator, Ray Tracing Gems II, 2021), else `p`; offset by
    /// `offset`.
    pub start: V3<F>,
    /// Geometric normal, unit, on the side the ray came from.
    pub ng: V3<F>,
    /// Shading normal, unit, on the same side.
    pub ns: V3<F>,
    /// The ray came from outside.
    pub outside: F::M,
    /// Interpolated normals: `ns` may differ from `ng`.
    pub smooth: F::M,
    /// Bound of the error of `p` along `ng`; zero on curved shapes, whose rays know the one that they leave.
    pub offset: F,
    /// Texture coordinates: u to the right, v upwards.
    pub u: F,
    /// See `u`.
    pub v: F,
    /// Material.
    pub material: F::U,
    /// Light + 1, or 0.
    pub light: F::U,
    /// What it is of: the number of the sphere, behind the spheres that of the shape, behind those that of the
    /// instance, behind those that of a solid's operand.
    pub body: F::U,
    /// The primitive that was hit.
    pub primitive: F::U,
}

/// The surface at the hits; lanes outside `valid` hold anything. Without textures there are no texture coordinates.
#[inline(always)]
pub fn surface<F: Lanes>(
    scene: &Scene,
    origin: V3<F>,
    direction: V3<F>,
    t: F,
    primitive: F::U,
    instance: F::U,
    valid: F::M,
) -> Surface<F> {
    surface_and_uv(scene, origin, direction, t, primitive, instance, valid, scene.tables.materials.textured)
}

/// As [`surface`], with texture coordinates if they are wanted.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn surface_and_uv<F: Lanes>(
    scene: &Scene,
    origin: V3<F>,
    direction: V3<F>,
    t: F,
    primitive: F::U,
    instance: F::U,
    valid: F::M,
    wants_uv: bool,
) -> Surface<F> {
    let spheres = F::U::splat(scene.tables.spheres.len);
    let shapes = &scene.tables.shapes;
    let first_triangle = F::U::splat(scene.tables.loose());
    let on_sphere = primitive.lt(spheres);
    let on_triangle = valid & !primitive.lt(first_triangle);
    let mut s = on_spheres(scene, origin, direction, t, F::U::select(on_sphere, primitive, F::U::splat(0)), wants_uv);
    s.primitive = primitive;
    if on_triangle.any() {
        let triangle = F::U::select(on_triangle, primitive - first_triangle, F::U::splat(0));
        let m = on_triangles(scene, origin, direction, triangle, instance, on_triangle, wants_uv);
        s = chosen(on_triangle, m, s);
    }
    let on_shape = valid & !on_sphere & !on_triangle;
    if !shapes.rows.is_empty() && on_shape.any() {
        let index = F::U::select(on_shape, primitive - spheres, F::U::splat(0));
        s = chosen(on_shape, on_shapes(scene, origin, direction, t, index, on_shape), s);
    }
    s
}

/// The first where it is picked, else the second.
#[inline(always)]
fn chosen<F: Lanes>(pick: F::M, m: Surface<F>, s: Surface<F>) -> Surface<F> {
    Surface {
        p: V3::select(pick, m.p, s.p),
        start: V3::select(pick, m.start, s.start),
        ng: V3::select(pick, m.ng, s.ng),
        ns: V3::select(pick, m.ns, s.ns),
        outside: (m.outside & pick) | (s.outside & !pick),
        smooth: (m.smooth & pick) | (s.smooth & !pick),
        offset: F::select(pick, m.offset, s.offset),
        u: F::select(pick, m.u, s.u),
        v: F::select(pick, m.v, s.v),
        material: F::U::select(pick, m.material, s.material),
        light: F::U::select(pick, m.light, s.light),
        body: F::U::select(pick, m.body, s.body),
        primitive: s.primitive,
    }
}

#[inline(always)]
fn on_spheres<F: Lanes>(scene: &Scene, origin: V3<F>, direction: V3<F>, t: F, id: F::U, wants_uv: bool) -> Surface<F> {
    let c = F::splat;
    let table = &scene.tables.spheres;
    let [px, py, pz, nx, ny, nz, k, material, light] = table.rows.row::<F>(id);
    let (anchor, n) = (V3(px, py, pz), V3(nx, ny, nz));
    let hit = direction.mad(t, origin);
    // Back onto the sphere by one Newton step; the normal N + k g, renormalised to first order.
    let g = hit.sub(anchor);
    let normal = g.mad(k, n);
    let outward = normal.scale(normal.dot(normal).fma(c(-0.5), c(1.5)));
    let ng = n.dot(g);
    let gamma = g.dot(g).fma(k, ng + ng);
    let p = outward.mad(gamma * c(-0.5), hit);
    let outside = outward.dot(direction).lt(c(0.0));
    let facing = V3::select(outside, outward, outward.neg());
    let (u, v) = if wants_uv {
        // Longitude and latitude; the middle of the picture looks along +z, u grows towards +x.
        let turns = atan2_turns(outward.0, outward.2);
        (turns + c(0.5), acos(outward.1).fma(c(-std::f32::consts::FRAC_1_PI), c(1.0)))
    } else {
        (c(0.0), c(0.0))
    };
    Surface {
        p,
        start: p,
        ng: facing,
        ns: facing,
        outside,
        smooth: F::M::from_bits(0),
        offset: c(0.0),
        u,
        v,
        material: material.to_bits(),
        light: light.to_bits(),
        body: id,
        primitive: id,
    }
}

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

#[inline(always)]
fn on_triangles<F: Lanes>(
    scene: &Scene,
    origin: V3<F>,
    direction: V3<F>,
    triangle: F::U,
    instance: F::U,
    valid: F::M,
    wants_uv: bool,
) -> Surface<F> {
    let c = F::splat;
    let zero = c(0.0);
    let triangles = &scene.triangles;
    let instances = &scene.tables.instances;
    let index = gather_indices::<F>(&triangles.vertices, triangle);
    let positions = triangles.positions.as_flattened();
    let mut corner = [
        V3::<F>::gather(positions, index[0]),
        V3::<F>::gather(positions, index[1]),
        V3::<F>::gather(positions, index[2]),
    ];
    let transformed = valid & !instance.eq(F::U::splat(NONE));
    let placed = !instances.matrices.is_empty() && transformed.any();
    let placement = Placement::<F>::gather(&instances.matrices, instance, placed);
    let mut mirrored = F::M::from_bits(0);
    if placed {
        corner = [placement.point(corner[0]), placement.point(corner[1]), placement.point(corner[2])];
        mirrored = transformed & placement.determinant().lt(zero);
    }
    let b = barycentrics(origin, direction, corner);
    let p = corner[0].scale(b[0]).add(corner[1].scale(b[1])).add(corner[2].scale(b[2]));
    // pbrt 4, 6.8.4: |error| <= gamma(7) (|b0 v0| + |b1 v1| + |b2 v2|) per axis, gamma(n) = n e/(1 - n e), e = 2^-24.
    let magnitude = corner[0].abs().scale(b[0]).add(corner[1].abs().scale(b[1])).add(corner[2].abs().scale(b[2]));
    let error = magnitude.scale(c(7.0 * 5.960_465e-8));
    let edge_normal = corner[1].sub(corner[0]).cross(corner[2].sub(corner[0]));
    let n = V3::select(mirrored, edge_normal.neg(), edge_normal).normalise();
    let outside = n.dot(direction).lt(zero);
    let ng = V3::select(outside, n, n.neg());
    // All of it along the normal, whatever its direction: a ray that starts on the edge of two coplanar triangles must
    // not meet the other one, whose distance is wrong by its vertices' coordinates, not by those across the plane
    // (which may be zero).
    let mut offset = error.0 + error.1 + error.2;
    if let Some(offsets) = scene.accel.as_deref().and_then(Accel::coplanar_offsets) {
        offset = offset.max(F::gather(offsets, triangle));
    }

    let mut ns = ng;
    let mut start = p;
    let mut smooth = F::M::from_bits(0);
    if !triangles.normal_indices.is_empty() {
        let ni = gather_indices::<F>(&triangles.normal_indices, triangle);
        smooth = valid & !ni[0].eq(F::U::splat(NONE));
        if smooth.any() {
            let table = triangles.normals.as_flattened();
            let mut normal =
                [V3::<F>::gather(table, ni[0]), V3::<F>::gather(table, ni[1]), V3::<F>::gather(table, ni[2])];
            if placed {
                normal = [placement.normal(normal[0]), placement.normal(normal[1]), placement.normal(normal[2])];
            }
            let interpolated = normal[0].scale(b[0]).add(normal[1].scale(b[1])).add(normal[2].scale(b[2]));
            // Normals that cancel out say nothing: the triangle's own.
            let length2 = interpolated.dot(interpolated);
            smooth = smooth & c(1e-12).lt(length2);
            let unit = interpolated.scale(c(1.0) / F::select(smooth, length2, c(1.0)).sqrt());
            let turned = unit.dot(ng).lt(zero);
            let facing = V3::select(turned, unit.neg(), unit);
            ns = V3::select(smooth, facing, ng);
            // Hanika 2021: from p up to the tangent plane of each vertex that it lies below, weighted by the
            // barycentrics. A vertex normal counts on the viewer's side; where the surface is hollow seen from there,
            // nothing moves.
            let mut moved = p;
            for k in 0..3 {
                let facing = V3::select(turned, normal[k].neg(), normal[k]);
                let below = p.sub(corner[k]).dot(facing).min(zero);
                moved = facing.mad(-(below * b[k]), moved);
            }
            start = V3::select(smooth, moved, p);
        }
    }
    let start = ng.mad(offset, start);

    let (mut u, mut v) = (zero, zero);
    if wants_uv && !triangles.uv_indices.is_empty() {
        let ti = gather_indices::<F>(&triangles.uv_indices, triangle);
        let has = valid & !ti[0].eq(F::U::splat(NONE));
        if has.any() {
            let table = triangles.uvs.as_flattened();
            for k in 0..3 {
                let corner = F::gather2(table, F::U::select(has, ti[k] + ti[k], F::U::splat(0)));
                u = corner[0].fma(b[k], u);
                v = corner[1].fma(b[k], v);
            }
            u = F::select(has, u, zero);
            v = F::select(has, v, zero);
        }
    }
    let mut material = F::U::gather(&triangles.material, triangle);
    if placed {
        let whole = F::U::gather(&instances.material, instance);
        material = F::U::select(transformed & !whole.eq(F::U::splat(NONE)), whole, material);
    }
    let mut light = F::U::splat(0);
    if !triangles.light.is_empty() {
        light = F::U::gather(&triangles.light, triangle) + F::U::splat(1);
    }
    let body = instance + F::U::splat(scene.tables.loose());
    let primitive = triangle;
    Surface { p, start, ng, ns, outside, smooth, offset, u, v, material, light, body, primitive }
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
