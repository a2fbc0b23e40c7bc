//! Cells about one point in each unit cube (Worley: A Cellular Texture Basis Function, 1996), whose place in it is by
//! PCG3D (Jarzynski, Olano: Hash Functions for GPU Rendering, 2020).
//!
//! Points of cubes that do not touch the one that is looked up are at least 1 away, so the 27 about it are enough where
//! what is asked for is nearer. Where it is not, the next 98 are looked at, too. Points of those beyond are at least 2
//! away, the nearest at most sqrt(3), the second nearest at most 2.06, for which every cube about would have to have
//! its point in its farthest corner.

use super::whole;
use crate::engine::stages::textures::floor;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::scene::voronoi_feature as feature;

/// What was found so far: squared distances to the two nearest points, and the cube that the nearest is in.
struct Found<F: Lanes> {
    first: F,
    second: F,
    cube: [F::U; 3],
}

/// `which`: one of [`feature`]; `jitter`: how far points are from the middles of their cubes.
#[inline(always)]
pub fn t<F: Lanes>(p: V3<F>, which: F, jitter: F, mask: F::M) -> F {
    let c = F::splat;
    let base = V3(floor(p.0), floor(p.1), floor(p.2));
    let rest = p.sub(base);
    // -1 is 2^32 - 1.
    let low = F::U::splat(0u32.wrapping_sub(4_194_304));
    let cube = [whole(p.0) + low, whole(p.1) + low, whole(p.2) + low];
    let far = c(1e9);
    let mut found = Found { first: far, second: far, cube };
    let one = c(1.0);
    let of_cells = mask & which.to_bits().eq(F::U::splat(feature::CELL.to_bits()));
    let of_borders = mask & which.to_bits().eq(F::U::splat(feature::F2_MINUS_F1.to_bits()));
    for reach in 1..3 {
        look::<F>(&mut found, cube, rest, jitter, reach);
        let farther = (of_cells & one.lt(found.first)) | (of_borders & one.lt(found.second));
        if !farther.any() {
            break;
        }
    }
    let first = found.first.sqrt();
    let between = found.second.sqrt() - first;
    // What the points are placed by is hashed once more, so that a cell's number says nothing of its place.
    let number = unit::<F>(pcg3d::<F>(pcg3d::<F>(found.cube))[0]);
    F::select(of_cells, number, F::select(of_borders, between, first).min(one))
}

/// Looks at the points of the cubes that are so many steps away along some axis; with the first step at the cube's own,
/// too.
#[inline(always)]
fn look<F: Lanes>(found: &mut Found<F>, cube: [F::U; 3], rest: V3<F>, jitter: F, reach: i32) {
    for z in -reach..reach + 1 {
        for y in -reach..reach + 1 {
            for x in -reach..reach + 1 {
                let inner = x.abs().max(y.abs()).max(z.abs()) < reach;
                if reach == 1 || !inner {
                    meet(found, cube, rest, jitter, [x, y, z]);
                }
            }
        }
    }
}

/// Looks at the point of one cube.
#[inline(always)]
fn meet<F: Lanes>(found: &mut Found<F>, cube: [F::U; 3], rest: V3<F>, jitter: F, step: [i32; 3]) {
    let [x, y, z] = step;
    let at = [cube[0] + F::U::splat(x as u32), cube[1] + F::U::splat(y as u32), cube[2] + F::U::splat(z as u32)];
    let hash = pcg3d::<F>(at);
    let away = V3(
        placed::<F>(hash[0], jitter, x) - rest.0,
        placed::<F>(hash[1], jitter, y) - rest.1,
        placed::<F>(hash[2], jitter, z) - rest.2,
    );
    let square = away.dot(away);
    let nearest = square.lt(found.first);
    found.second = F::select(nearest, found.first, square.min(found.second));
    found.first = F::select(nearest, square, found.first);
    let [a, b, c] = found.cube;
    found.cube = [F::U::select(nearest, at[0], a), F::U::select(nearest, at[1], b), F::U::select(nearest, at[2], c)];
}

/// Where along an axis a point is, from the cube that is looked up: so many cubes on, 1/2 + jitter (h - 1/2) within.
#[inline(always)]
fn placed<F: Lanes>(hash: F::U, jitter: F, step: i32) -> F {
    jitter.fma(unit::<F>(hash) - F::splat(0.5), F::splat(step as f32 + 0.5))
}

/// From 0 to 1, by the upper 24 bits.
#[inline(always)]
fn unit<F: Lanes>(hash: F::U) -> F {
    F::from_int(hash.shr::<8>()) * F::splat(5.960_464_5e-8)
}

/// PCG3D.
#[inline(always)]
fn pcg3d<F: Lanes>(v: [F::U; 3]) -> [F::U; 3] {
    let (factor, term) = (F::U::splat(1_664_525), F::U::splat(1_013_904_223));
    let [mut x, mut y, mut z] = [v[0] * factor + term, v[1] * factor + term, v[2] * factor + term];
    x = x + y * z;
    y = y + z * x;
    z = z + x * y;
    x = x ^ x.shr::<16>();
    y = y ^ y.shr::<16>();
    z = z ^ z.shr::<16>();
    x = x + y * z;
    y = y + z * x;
    z = z + x * y;
    [x, y, z]
}
