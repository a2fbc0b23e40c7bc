//! The colours of a mesh's vertices, between them by barycentric coordinates.

use super::At;
use crate::engine::stages::triangles::{Placement, gather_indices};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{Coded, Scene, VertexSpace};
use crate::srgb::SRGB_TO_LINEAR;

/// The colour at points of triangles, in the lanes of the mask; anything elsewhere. Barycentric coordinates are those
/// of the point, which lies on its triangle to some ulp: they are as exact as that is in proportion to the triangle,
/// and surfaces need not carry them.
#[inline(always)]
pub fn color<F: Lanes>(scene: &Scene, space: VertexSpace, s: &At<F>, on: F::M) -> V3<F> {
    let zero = F::U::splat(0);
    let table = &scene.tables.colors;
    let places = &table.places[space as usize];
    if places.is_empty() {
        return V3::zero();
    }
    let instance = F::U::select(on, s.body - F::U::splat(scene.tables.loose()), zero);
    let triangle = F::U::select(on, s.primitive - F::U::splat(scene.tables.loose()), zero);
    let vertex = gather_indices::<F>(&scene.triangles.vertices, triangle);
    let positions = scene.triangles.positions.as_flattened();
    let mut corner = [V3::<F>::zero(); 3];
    let matrices = &scene.tables.instances.matrices;
    let is_placed = !matrices.is_empty();
    let placement = Placement::<F>::gather(matrices, instance, is_placed);
    for k in 0..3 {
        let p = V3::<F>::gather(positions, vertex[k]);
        corner[k] = if is_placed { placement.point(p) } else { p };
    }
    let weight = weights(corner, s.p);

    let mesh = F::U::gather(&table.mesh, instance);
    let place = mesh + mesh;
    let coded = F::U::gather(places, place);
    let first = F::U::gather(places, place + F::U::splat(1));
    let floats = on & coded.eq(F::U::splat(Coded::Floats as u32));
    let linear = on & coded.eq(F::U::splat(Coded::Linear8 as u32));
    let mut color = V3::zero();
    for k in 0..3 {
        let mut of_vertex = V3::zero();
        if (on & !floats).any() {
            let word = F::U::gather(&table.words, F::U::select(floats, zero, first + vertex[k]));
            of_vertex = V3(
                decoded::<F>(word, linear),
                decoded::<F>(word.shr::<8>(), linear),
                decoded::<F>(word.shr::<16>(), linear),
            );
        }
        if floats.any() {
            let three = F::U::splat(3);
            let [r, g, b] = F::U::gather3(&table.words, F::U::select(floats, first + vertex[k] * three, zero));
            of_vertex = V3::select(floats, V3(F::from_bits(r), F::from_bits(g), F::from_bits(b)), of_vertex);
        }
        color = of_vertex.mad(weight[k], color);
    }
    color
}

/// Linear light of the lowest byte: a 255th of it in the lanes of the mask, else of sRGB.
#[inline(always)]
fn decoded<F: Lanes>(word: F::U, linear: F::M) -> F {
    let byte = word & F::U::splat(0xff);
    F::select(linear, F::from_int(byte) * F::splat(1.0 / 255.0), F::gather(&*SRGB_TO_LINEAR, byte))
}

/// Barycentric coordinates of a point of a triangle: areas that it has with two corners each, over their sum, none
/// below zero. They are of differences from the point, so that they keep their digits far from the origin.
#[inline(always)]
fn weights<F: Lanes>(corner: [V3<F>; 3], p: V3<F>) -> [F; 3] {
    let (zero, one) = (F::splat(0.0), F::splat(1.0));
    let (a, b, c) = (corner[0].sub(p), corner[1].sub(p), corner[2].sub(p));
    let n = corner[1].sub(corner[0]).cross(corner[2].sub(corner[0]));
    // A number of size one, so that products of small areas do not vanish.
    let size = n.abs().max_component();
    let n = n.scale(one / F::select(zero.lt(size), size, one));
    let x = n.dot(b.cross(c)).max(zero);
    let y = n.dot(c.cross(a)).max(zero);
    let z = n.dot(a.cross(b)).max(zero);
    let sum = x + y + z;
    let usable = zero.lt(sum);
    let inverse = one / F::select(usable, sum, one);
    [F::select(usable, x * inverse, one), y * inverse, z * inverse]
}
