//! The surface of curved shapes that are no spheres, lane by lane: the formulas are those of [`crate::shapes`], in
//! `f64`.

use super::surface::Surface;
use crate::bvh::Accel;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::{Scene, ShapeTable};
use crate::shapes::OnUnit;
use crate::shapes::csg::OnSolid;
use glam::DVec3;

/// The most lanes that there are.
const MOST: usize = 32;

/// The surface at the hits of `mask`, on the shapes with these places in the table; other lanes hold anything.
#[inline(always)]
pub fn on_shapes<F: Lanes>(
    scene: &Scene,
    origin: V3<F>,
    direction: V3<F>,
    t: F,
    index: F::U,
    mask: F::M,
) -> Surface<F> {
    let mut at = At { t: [0.0; MOST], origin: [[0.0; MOST]; 3], direction: [[0.0; MOST]; 3], index: [0; MOST] };
    t.store(&mut at.t);
    index.store(&mut at.index);
    for (axis, (o, d)) in
        [(origin.0, direction.0), (origin.1, direction.1), (origin.2, direction.2)].into_iter().enumerate()
    {
        o.store(&mut at.origin[axis]);
        d.store(&mut at.direction[axis]);
    }
    let found = find(&scene.tables.shapes, scene.tables.spheres.len, &at, mask.bits());
    let p = V3(F::load(&found.p[0]), F::load(&found.p[1]), F::load(&found.p[2]));
    let n = V3(F::load(&found.n[0]), F::load(&found.n[1]), F::load(&found.n[2]));
    let outside = F::M::from_bits(found.outside);
    let facing = V3::select(outside, n, n.neg());
    // Rays start on the shape, but for what lies in one plane with others.
    let mut offset = F::splat(0.0);
    if let Some(offsets) = scene.accel.as_deref().and_then(Accel::coplanar_shape_offsets) {
        offset = F::gather(offsets, index);
    }
    Surface {
        p,
        start: facing.mad(offset, p),
        ng: facing,
        ns: facing,
        outside,
        smooth: F::M::from_bits(0),
        offset,
        u: F::load(&found.uv[0]),
        v: F::load(&found.uv[1]),
        material: F::U::load(&found.material),
        light: F::U::load(&found.light),
        body: F::U::load(&found.body),
        primitive: index,
    }
}

/// Hits, column by column.
struct At {
    t: [f32; MOST],
    origin: [[f32; MOST]; 3],
    direction: [[f32; MOST]; 3],
    index: [u32; MOST],
}

/// What is there; `n` is outwards.
struct Found {
    p: [[f32; MOST]; 3],
    n: [[f32; MOST]; 3],
    uv: [[f32; MOST]; 2],
    material: [u32; MOST],
    light: [u32; MOST],
    body: [u32; MOST],
    outside: u32,
}

#[inline(never)]
fn find(table: &ShapeTable, spheres: u32, at: &At, mut lanes: u32) -> Found {
    let (zero, none) = ([0.0; MOST], [0; MOST]);
    let mut found =
        Found { p: [zero; 3], n: [zero; 3], uv: [zero; 2], material: none, light: none, body: none, outside: 0 };
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize & (MOST - 1);
        lanes &= lanes - 1;
        let index = at.index[lane] as usize;
        let (Some(row), Some(&material)) = (table.rows.get(index), table.material.get(index)) else { continue };
        let of = |columns: &[[f32; MOST]; 3]| DVec3::from([0, 1, 2].map(|axis: usize| f64::from(columns[axis][lane])));
        let direction = of(&at.direction);
        let point = of(&at.origin) + f64::from(at.t[lane]) * direction;
        let (mut body, mut material) = (spheres + at.index[lane], material);
        let mut light = table.light.get(index).copied().unwrap_or(0);
        let on = match row.on_solid(&table.parts, point) {
            None => row.surface(point),
            Some(OnSolid { operand, outward }) => {
                let Some(of) = table.operands.get(operand as usize) else { continue };
                (body, material, light) = (table.first_body + operand, of.material, of.light);
                OnUnit { n: outward, ..of.row.surface(point) }
            }
        };
        for axis in 0..3 {
            found.p[axis][lane] = on.q[axis] as f32;
            found.n[axis][lane] = on.n[axis] as f32;
        }
        found.uv[0][lane] = on.uv.x as f32;
        found.uv[1][lane] = on.uv.y as f32;
        found.material[lane] = material;
        found.light[lane] = light;
        found.body[lane] = body;
        found.outside |= u32::from(on.n.dot(direction) < 0.0) << lane;
    }
    found
}
