//! Textures that are reckoned, point by point in f64: written after the manual's formulas.

use crate::surface::Surface;
use crate::vertex_color;
use glam::{DMat3, DVec3};
use std::f64::consts::{PI, TAU};
use tracer_core::Scene;
use tracer_core::scene::{Between, GradientAxis, Made, NoiseKind, PatternKind, Space, VoronoiFeature};

/// The colour of a pattern at a surface.
pub fn color(scene: &Scene, index: u32, s: &Surface) -> DVec3 {
    let pattern = scene.pattern(index).expect("a pattern of the scene");
    let p = coordinates(scene, pattern.space, pattern.map, s);
    let p =
        if pattern.space == Space::Spherical { p * DVec3::new(pattern.across[0], pattern.across[1], 1.0) } else { p };
    DVec3::from(pattern.a).lerp(DVec3::from(pattern.b), t(pattern.kind, p))
}

/// Where a texture is looked up.
fn coordinates(scene: &Scene, space: Space, map: [[f64; 4]; 3], s: &Surface) -> DVec3 {
    let apply = |rows: [[f64; 4]; 3], p: DVec3| {
        DVec3::from(rows.map(|row| row[0] * p.x + row[1] * p.y + row[2] * p.z + row[3]))
    };
    let to_object = |body| apply(scene.to_object(body).expect("a scene with solid textures"), s.p);
    match space {
        Space::Uv => apply(map, DVec3::new(s.uv[0], s.uv[1], 0.0)),
        Space::Object => apply(map, to_object(Some(s.body))),
        Space::World => apply(map, to_object(None)),
        Space::Spherical => {
            let d = apply(map, to_object(Some(s.body))).normalize();
            DVec3::new(0.5 + d.x.atan2(d.z) / TAU, 0.5 + d.y.asin() / PI, 0.0)
        }
    }
}

/// The colour of a texture made of others. `texel`: that of a picture at coordinates before its own mapping.
pub fn program(scene: &Scene, index: u32, s: &Surface, texel: impl Fn(u32, [f64; 2]) -> DVec3) -> DVec3 {
    let program = scene.program(index).expect("a program of the scene");
    let luminance = |c: DVec3| c.dot(DVec3::new(0.2126, 0.7152, 0.0722));
    let mut places = vec![DVec3::ZERO; 256];
    for op in &program.ops {
        let of = |place: u8| places[usize::from(place)];
        let made = match op.made {
            Made::Color(color) => color.into(),
            Made::Pattern(index) => color(scene, index, s),
            Made::Texture { texture, space: Space::Uv, .. } => texel(texture, s.uv),
            Made::Texture { texture, space, map } => {
                let p = coordinates(scene, space, map, s);
                texel(texture, [p.x, p.y])
            }
            Made::VertexColor(space) => vertex_color::color(scene, space, s),
            Made::Mix([a, b, weight]) => of(a).lerp(of(b), luminance(of(weight))),
            Made::Multiply([a, b]) => of(a) * of(b),
            Made::Ramp { input, first, count, between } => {
                let stops = &program.stops[first as usize..][..count as usize];
                ramp(luminance(of(input)), stops, between)
            }
            Made::Triplanar { colors, sharpness } => {
                let rows = scene.to_object(Some(s.body)).expect("a scene with solid textures");
                let to_object = DMat3::from_cols_array_2d(&rows.map(|[x, y, z, _]| [x, y, z])).transpose();
                let n = (to_object.inverse().transpose() * s.ns).normalize();
                let weights = n.abs().powf(sharpness);
                let sum: DVec3 = (0..3).map(|k| weights[k] * of(colors[k])).sum();
                sum / weights.element_sum()
            }
        };
        places[usize::from(op.to)] = made;
    }
    places[0]
}

/// The colour at x: that of the last stop that is not beyond it, on the way to the next.
fn ramp(x: f64, stops: &[(f64, [f64; 3])], between: Between) -> DVec3 {
    let next = stops.iter().position(|(at, _)| x < *at).unwrap_or(stops.len());
    let color = |k: usize| DVec3::from(stops[k].1);
    if next == 0 || next == stops.len() || between == Between::Constant {
        return color(next.max(1) - 1);
    }
    let f = (x - stops[next - 1].0) / (stops[next].0 - stops[next - 1].0);
    let f = if between == Between::Smooth { f * f * (3.0 - 2.0 * f) } else { f };
    color(next - 1).lerp(color(next), f)
}

/// Where between a and b.
fn t(kind: PatternKind, p: DVec3) -> f64 {
    let wave = |x: f64| 0.5 - 0.5 * (TAU * x).cos();
    match kind {
        PatternKind::Checkerboard => {
            // A face that lies where two cubes meet is in the upper one.
            (p + 1.0 / 1_048_576.0).floor().element_sum().rem_euclid(2.0)
        }
        PatternKind::Lines { at_u, at_v, width } => {
            let near = |x: f64| (x - x.round()).abs() <= 0.5 * width;
            f64::from(!(at_u && near(p.x) || at_v && near(p.y)))
        }
        PatternKind::Dots { radius } => f64::from((p - p.floor() - 0.5).truncate().length() < radius),
        PatternKind::Gradient { axis } => match axis {
            GradientAxis::X => p.x,
            GradientAxis::Y => p.y,
            GradientAxis::Z => p.z,
            GradientAxis::Radial => p.length(),
        }
        .clamp(0.0, 1.0),
        PatternKind::Noise { kind, octaves: count, lacunarity, gain } => match kind {
            NoiseKind::Fbm => 0.5 + 0.5 * octaves(p, count, lacunarity, gain, |n| n),
            NoiseKind::Turbulence => octaves(p, count, lacunarity, gain, f64::abs),
        },
        PatternKind::Wood { distortion, axis } => {
            let distance = DVec3::from(axis).cross(p).length();
            wave(distance + distortion * octaves(p, 4, 2.0, 0.5, |n| n))
        }
        PatternKind::Marble { distortion, axis } => {
            wave(DVec3::from(axis).dot(p) + distortion * octaves(p, 6, 2.0, 0.5, f64::abs))
        }
        PatternKind::Voronoi { feature, jitter } => cells(p, feature, jitter),
    }
}

/// Worley: A Cellular Texture Basis Function (1996), one point a cube. All cubes are looked at that may hold one of the
/// two nearest: those beyond three are farther away than the second nearest, which is at most sqrt(1.5^2 + 2).
fn cells(p: DVec3, feature: VoronoiFeature, jitter: f64) -> f64 {
    let share = |hash: u32| f64::from(hash >> 8) / f64::from(1 << 24);
    let mut points = Vec::new();
    for k in 0..343 {
        let cube = p.floor() + DVec3::new(f64::from(k % 7 - 3), f64::from(k / 7 % 7 - 3), f64::from(k / 49 - 3));
        let hash = pcg3d(cube.to_array().map(|x| x as i32 as u32));
        let point = cube + 0.5 + jitter * (DVec3::from(hash.map(share)) - 0.5);
        points.push(((point - p).length(), share(pcg3d(hash)[0])));
    }
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    match feature {
        VoronoiFeature::F1 => points[0].0.min(1.0),
        VoronoiFeature::F2MinusF1 => (points[1].0 - points[0].0).min(1.0),
        VoronoiFeature::Cell => points[0].1,
    }
}

/// Jarzynski, Olano: Hash Functions for GPU Rendering (2020), listing of pcg3d.
fn pcg3d(v: [u32; 3]) -> [u32; 3] {
    let mut v = v.map(|x| x.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let mix = |v: &mut [u32; 3]| {
        for k in 0..3 {
            v[k] = v[k].wrapping_add(v[(k + 1) % 3].wrapping_mul(v[(k + 2) % 3]));
        }
    };
    mix(&mut v);
    v = v.map(|x| x ^ (x >> 16));
    mix(&mut v);
    v
}

/// sum g^i f(n(l^i p)) / sum g^i.
fn octaves(p: DVec3, count: u32, l: f64, g: f64, f: impl Fn(f64) -> f64) -> f64 {
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in 0..count {
        sum += g.powi(i as i32) * f(perlin(p * l.powi(i as i32)));
        weights += g.powi(i as i32);
    }
    sum / weights
}

/// Perlin: Improving Noise (2002), as his program has it.
fn perlin(p: DVec3) -> f64 {
    let hash = |k: i64| i64::from(PERMUTATION[k.rem_euclid(256) as usize]);
    let [x, y, z] = p.floor().to_array().map(|x| x as i64);
    let f = p - p.floor();
    let fade = f.to_array().map(|t| t * t * t * (t * (t * 6.0 - 15.0) + 10.0));
    let mut sum = 0.0;
    for corner in 0..8i64 {
        let at = [corner & 1, corner >> 1 & 1, corner >> 2 & 1];
        let weight: f64 = (0..3).map(|k| if at[k] == 1 { fade[k] } else { 1.0 - fade[k] }).product();
        let d = f - DVec3::from(at.map(|k| k as f64));
        let h = hash(hash(hash(x + at[0]) + y + at[1]) + z + at[2]) & 15;
        let u = if h < 8 { d.x } else { d.y };
        let v = if h < 4 {
            d.y
        } else if h == 12 || h == 14 {
            d.x
        } else {
            d.z
        };
        sum += weight * ((if h & 1 == 0 { u } else { -u }) + (if h & 2 == 0 { v } else { -v }));
    }
    sum
}

/// Perlin's table.
#[rustfmt::skip]
const PERMUTATION: [u8; 256] = [
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225,
    140, 36, 103, 30, 69, 142, 8, 99, 37, 240, 21, 10, 23, 190, 6, 148,
    247, 120, 234, 75, 0, 26, 197, 62, 94, 252, 219, 203, 117, 35, 11, 32,
    57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136, 171, 168, 68, 175,
    74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122,
    60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54,
    65, 25, 63, 161, 1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169,
    200, 196, 135, 130, 116, 188, 159, 86, 164, 100, 109, 198, 173, 186, 3, 64,
    52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126, 255, 82, 85, 212,
    207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213,
    119, 248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9,
    129, 22, 39, 253, 19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104,
    218, 246, 97, 228, 251, 34, 242, 193, 238, 210, 144, 12, 191, 179, 162, 241,
    81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31, 181, 199, 106, 157,
    184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93,
    222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78, 66, 215, 61, 156, 180,
];
