//! From a hit to the surface there, whatever was hit; of spheres here.

use super::shapes::on_shapes;
use super::surface::Surface;
use super::triangles::{TriangleHits, on_triangles};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::{V3, acos, atan2_turns};
use crate::scene::Scene;

/// The surface at the hits; lanes outside `valid` hold anything. Without textures there are no texture coordinates.
#[inline(always)]
pub fn surface_at<F: Lanes>(
    scene: &Scene,
    origin: V3<F>,
    direction: V3<F>,
    t: F,
    primitive: F::U,
    instance: F::U,
    valid: F::M,
) -> Surface<F> {
    surface_and_uv_at(scene, origin, direction, t, primitive, instance, valid, scene.tables.materials.textured)
}

/// As [`surface_at`], with texture coordinates if they are wanted.
#[inline(always)]
#[allow(clippy::too_many_arguments)]
pub fn surface_and_uv_at<F: Lanes>(
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
        let hits = TriangleHits { origin, direction, triangle, instance, lanes: on_triangle };
        let m = on_triangles(scene, hits, wants_uv);
        s = Surface::select(on_triangle, m, s);
    }
    let on_shape = valid & !on_sphere & !on_triangle;
    if !shapes.rows.is_empty() && on_shape.any() {
        let index = F::U::select(on_shape, primitive - spheres, F::U::splat(0));
        s = Surface::select(on_shape, on_shapes(scene, origin, direction, t, index, on_shape), s);
    }
    s
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
