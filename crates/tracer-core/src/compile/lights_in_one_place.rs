//! Flat lamps in one place: one of them is seen wherever all are, the first ([`tracer_kernels::bvh`]), so that the
//! others give no light either, and need not be asked for it.
//!
//! Of lamps that overlap only in part, samples of points where another one is seen bring nothing
//! ([`tracer_kernels::scene::Glow`]).

use glam::DVec3;
use std::collections::BTreeSet;
use tracer_kernels::scene::Light;
use tracer_kernels::shapes::UnitShape;

/// Takes the light of all but the first of those that have the same corners.
pub fn keep_first(lights: &mut [Light]) {
    let mut taken: BTreeSet<Vec<[u64; 3]>> = BTreeSet::new();
    for light in lights {
        let (place, radiance) = match light {
            Light::Parallelogram(flat) => {
                let [a, b] = flat.edges;
                (place(&[flat.corner, flat.corner + a, flat.corner + b, flat.corner + a + b]), &mut flat.radiance)
            }
            Light::Triangle(flat) => {
                let [a, b] = flat.edges;
                (place(&[flat.corner, flat.corner + a, flat.corner + b]), &mut flat.radiance)
            }
            // Of those with one the others are left out of the scene.
            Light::Sphere { .. } => continue,
            Light::Curved(curved) => {
                let UnitShape::Disk { inner } = curved.unit else { continue };
                let map = curved.placement;
                let mut place: Vec<[u64; 3]> =
                    [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| bits(map.transform_point3(p))).to_vec();
                place.push([inner.to_bits(); 3]);
                (place, &mut curved.radiance)
            }
        };
        if !taken.insert(place) {
            *radiance = [0.0; 3];
        }
    }
}

/// The corners in an order of their own.
fn place(corners: &[DVec3]) -> Vec<[u64; 3]> {
    let mut place: Vec<[u64; 3]> = corners.iter().copied().map(bits).collect();
    place.sort_unstable();
    place
}

/// Zeros of either sign are one place.
fn bits(p: DVec3) -> [u64; 3] {
    (p + DVec3::ZERO).to_array().map(f64::to_bits)
}
