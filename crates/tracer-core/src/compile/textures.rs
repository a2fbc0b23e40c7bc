//! Textures that are reckoned, from their words to what is rendered.

use scene_format::desc::{self, Albedo, LinesAlong, SolidMapping};
use tracer_kernels::scene::{GradientAxis, NoiseKind, Pattern, PatternKind, Space, VoronoiFeature};

/// The pattern of these words; `None` where they are a constant colour or a picture.
pub fn pattern(words: &Albedo) -> Option<Pattern> {
    let pattern = words.pattern()?;
    let (space, map) = match pattern.mapping() {
        SolidMapping::Uv(uv) => {
            let [[ux, vx, x], [uy, vy, y]] = uv.rows();
            (Space::Uv, [[ux, vx, 0.0, x], [uy, vy, 0.0, y], [0.0; 4]])
        }
        SolidMapping::Object { scale, offset } => (Space::Object, scaled_and_moved(scale.0, offset)),
        SolidMapping::World { scale, offset } => (Space::World, scaled_and_moved(scale.0, offset)),
    };
    let [a, b] = pattern.colors();
    Some(Pattern { kind: kind(words)?, space, map, a, b })
}

fn scaled_and_moved([x, y, z]: [f64; 3], [dx, dy, dz]: [f64; 3]) -> [[f64; 4]; 3] {
    [[x, 0.0, 0.0, dx], [0.0, y, 0.0, dy], [0.0, 0.0, z, dz]]
}

fn kind(words: &Albedo) -> Option<PatternKind> {
    Some(match words {
        Albedo::Color(_) | Albedo::Texture(_) => return None,
        Albedo::Checkerboard(_) => PatternKind::Checkerboard,
        Albedo::Lines(lines) => PatternKind::Lines {
            at_u: lines.along != LinesAlong::U,
            at_v: lines.along != LinesAlong::V,
            width: lines.width,
        },
        Albedo::Dots(dots) => PatternKind::Dots { radius: dots.radius },
        Albedo::Gradient(gradient) => PatternKind::Gradient {
            axis: match gradient.axis {
                desc::GradientAxis::X => GradientAxis::X,
                desc::GradientAxis::Y => GradientAxis::Y,
                desc::GradientAxis::Z => GradientAxis::Z,
                desc::GradientAxis::Radial => GradientAxis::Radial,
            },
        },
        Albedo::Noise(noise) => {
            let (kind, octaves) = match noise.kind {
                desc::NoiseKind::Fbm => (NoiseKind::Fbm, noise.octaves),
                desc::NoiseKind::Perlin => (NoiseKind::Fbm, 1),
                desc::NoiseKind::Turbulence => (NoiseKind::Turbulence, noise.octaves),
            };
            PatternKind::Noise { kind, octaves, lacunarity: noise.lacunarity, gain: noise.gain }
        }
        Albedo::Wood(wood) => PatternKind::Wood { distortion: wood.distortion },
        Albedo::Marble(marble) => PatternKind::Marble { distortion: marble.distortion },
        Albedo::Voronoi(voronoi) => PatternKind::Voronoi {
            feature: match voronoi.feature {
                desc::VoronoiFeature::F1 => VoronoiFeature::F1,
                desc::VoronoiFeature::F2MinusF1 => VoronoiFeature::F2MinusF1,
                desc::VoronoiFeature::Cell => VoronoiFeature::Cell,
            },
            jitter: voronoi.jitter,
        },
    })
}
