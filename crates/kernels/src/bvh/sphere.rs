//! Where a ray meets a sphere: the canonical formula, in f32, for spheres of any radius.
//!
//! Textbook formulas lose three digits inside a sphere of radius 10 000. Two remedies together lose none:
//! the quadratic is *anchored* at a surface point, so that nothing of the radius' size appears, and *recentred*, its
//! unknown counted from the ray's closest approach to that point.
//!
//! Operation by operation (`fma(a, b, c)` = a·b + c rounded once; everything else rounded each time):
//!
//! ```text
//! per ray   dd    = fma(dx, dx, fma(dy, dy, dz * dz))
//!           idd   = 1 / dd
//! g0 = o - anchor                                     (three subtractions)
//! s     = -(dot(g0, d) * idd)                         dot(a, b) = fma(ax, bx, fma(ay, by, az * bz))
//! s     = 0 where the ray leaves this very sphere
//! g     = fma(s, d, g0)                               (three)
//! beta  = fma(k, dot(g, d), dot(n, d))
//! gamma = fma(k, dot(g, g), 2 * dot(n, g))
//! gamma = 0 where the ray leaves this very sphere
//! a     = k * dd
//! disc  = fma(beta, beta, -(a * gamma))               no hit where disc < 0
//! q     = -(beta + copysign(sqrt(disc), beta))
//! u0    = gamma / q ;  u1 = q / a
//! lo    = u0 < u1 ? u0 : u1 ;  hi = u1 > u0 ? u1 : u0
//! near  = s + lo ;  far = s + hi
//! t     = near > 0 ? near : far                       a hit where 0 < t < infinity
//! ```
//!
//! A ray that leaves the sphere itself has the roots 0 and −2β/a exactly, because sqrt(β²) = |β| in IEEE arithmetic:
//! the first is no hit, the second is the far side. No epsilon is needed.

use super::geometry::SphereGeometry;

/// The nearest t > 0 at which the ray `origin + t direction` meets the sphere; `leaves` says that the ray starts on
/// this very sphere. The direction need not be unit. See the head of the file for the formula.
#[inline]
pub fn sphere_hit(sphere: &SphereGeometry, origin: [f32; 3], direction: [f32; 3], leaves: bool) -> Option<f32> {
    let (o, d, k, n) = (origin, direction, sphere.curvature, sphere.normal);
    let dd = dot(d, d);
    let idd = 1.0 / dd;
    let g0 = [o[0] - sphere.anchor[0], o[1] - sphere.anchor[1], o[2] - sphere.anchor[2]];
    let s = if leaves { 0.0 } else { -(dot(g0, d) * idd) };
    let g = [s.mul_add(d[0], g0[0]), s.mul_add(d[1], g0[1]), s.mul_add(d[2], g0[2])];
    let beta = k.mul_add(dot(g, d), dot(n, d));
    let gamma = if leaves { 0.0 } else { k.mul_add(dot(g, g), 2.0 * dot(n, g)) };
    let a = k * dd;
    let disc = beta.mul_add(beta, -(a * gamma));
    let q = -(beta + disc.sqrt().copysign(beta));
    let (u0, u1) = (gamma / q, q / a);
    let lo = if u0 < u1 { u0 } else { u1 };
    let hi = if u1 > u0 { u1 } else { u0 };
    let (near, far) = (s + lo, s + hi);
    let t = if near > 0.0 { near } else { far };
    (disc >= 0.0 && t > 0.0 && t < f32::INFINITY).then_some(t)
}

#[inline]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0].mul_add(b[0], a[1].mul_add(b[1], a[2] * b[2]))
}
