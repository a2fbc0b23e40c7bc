//! The colours of vertices, point by point in f64.

use crate::surface::Surface;
use glam::DVec3;
use tracer_core::Scene;
use tracer_core::scene::{Texel, VertexSpace};

/// The colour of vertices between them, each decoded before they are mixed.
pub fn color(scene: &Scene, space: VertexSpace, s: &Surface) -> DVec3 {
    let at = s.on_mesh.as_ref().expect("colours of vertices are those of a mesh");
    let of = |k: usize| match scene.vertex_color(space, at.instance, at.vertices[k]).expect("a colour of the mesh") {
        Texel::Srgb8(code) => DVec3::from(code.map(srgb)),
        Texel::Linear(color) => DVec3::from(color.map(f64::from)),
    };
    (0..3).map(|k| at.weights[k] * of(k)).sum()
}

/// Linear light of an sRGB code value (IEC 61966-2-1).
pub fn srgb(code: u8) -> f64 {
    let c = f64::from(code) / 255.0;
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}
