//! The texture: every triangle is drawn into the atlas, each texel coloured by the point of the surface that it shows.

use super::anatomy::Cat;
use super::coat;
use super::unwrap::{Atlas, Charted};
use crate::picture::{Picture, byte};
use glam::{DVec2, DVec3};

/// Rings of texels that a chart's border colour is carried beyond it, for filters that reach across.
const PADDING: usize = 6;

/// Paints what the meshes show of the texture; where they overlap, the first one counts.
pub fn paint(cat: &Cat, atlas: &Atlas, size: usize, meshes: &[Charted]) -> Picture {
    let mut texels: Vec<Option<DVec3>> = vec![None; size * size];
    for charted in meshes {
        let normals: Vec<DVec3> = charted.mesh.positions.iter().map(|&p| cat.normal(p)).collect();
        for (t, &id) in charted.charts.iter().enumerate() {
            let corners = charted.mesh.corners(t);
            let Some(uv) = corners.map(|p| atlas.uv(id, p)).into_iter().collect::<Option<Vec<DVec2>>>() else {
                continue;
            };
            let n = charted.mesh.triangles[t].map(|v| normals[v]);
            draw([uv[0], uv[1], uv[2]].map(|uv| uv * size as f64), size, |index, w| {
                let texel = &mut texels[index];
                if texel.is_none() {
                    let p = w[0] * corners[0] + w[1] * corners[1] + w[2] * corners[2];
                    let n = (w[0] * n[0] + w[1] * n[1] + w[2] * n[2]).normalize_or(DVec3::Y);
                    *texel = Some(coat::color(cat, id.part, p, n));
                }
            });
        }
    }
    pad(&mut texels, size);
    let mean = {
        let painted: Vec<DVec3> = texels.iter().flatten().copied().collect();
        painted.iter().copied().sum::<DVec3>() / painted.len().max(1) as f64
    };
    // Texture coordinates have v upwards, pictures start at the top.
    let rgb = (0..size)
        .rev()
        .flat_map(|row| texels[row * size..(row + 1) * size].iter())
        .flat_map(|texel| texel.unwrap_or(mean).to_array())
        .map(byte)
        .collect();
    Picture { width: size, height: size, rgb }
}

/// Calls `texel(index, barycentric weights)` for every texel whose centre lies in the triangle.
fn draw([a, b, c]: [DVec2; 3], size: usize, mut texel: impl FnMut(usize, [f64; 3])) {
    let area = (b - a).perp_dot(c - a);
    if area == 0.0 {
        return;
    }
    let min = a.min(b).min(c).floor().max(DVec2::ZERO);
    let max = a.max(b).max(c).ceil().min(DVec2::splat(size as f64));
    for y in min.y as usize..max.y as usize {
        for x in min.x as usize..max.x as usize {
            let p = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            let w = [(b - p).perp_dot(c - p), (c - p).perp_dot(a - p), (a - p).perp_dot(b - p)].map(|w| w / area);
            if w.iter().all(|&w| w >= -1e-9) {
                texel(y * size + x, w);
            }
        }
    }
}

/// Carries the border colours outwards.
fn pad(texels: &mut [Option<DVec3>], size: usize) {
    for _ in 0..PADDING {
        let before = texels.to_vec();
        for y in 0..size {
            for x in 0..size {
                if before[y * size + x].is_some() {
                    continue;
                }
                let mut sum = DVec3::ZERO;
                let mut count = 0.0;
                for v in y.saturating_sub(1)..(y + 2).min(size) {
                    for u in x.saturating_sub(1)..(x + 2).min(size) {
                        if let Some(color) = before[v * size + u] {
                            sum += color;
                            count += 1.0;
                        }
                    }
                }
                if count > 0.0 {
                    texels[y * size + x] = Some(sum / count);
                }
            }
        }
    }
}
