//! Textures that are reckoned, from their words to what is rendered.

use super::placing::sides;
use glam::DVec3;
use scene_format::desc::{self, Albedo, LinesAlong, SolidMapping};
use scene_format::diagnostic::Spanned;
use tracer_kernels::scene::{GradientAxis, NoiseKind, Pattern, PatternKind, Space, VoronoiFeature};

/// Where a texture lies: what its coordinates start from, and the way from there.
#[derive(Clone, Copy)]
pub struct Lies {
    /// What the map starts from.
    pub space: Space,
    /// Rows of the 3x4 matrix to the texture's coordinates, or to what longitude and latitude are of.
    pub map: [[f64; 4]; 3],
    /// What longitude and latitude are multiplied by.
    pub across: [f64; 2],
}

impl Lies {
    fn by(space: Space, map: [[f64; 4]; 3]) -> Self {
        Lies { space, map, across: [1.0; 2] }
    }
}

/// How a mapping lies: once, or three times along x, y and z.
pub enum Lying {
    /// Once.
    Once(Lies),
    /// Three times, with the exponent of the normal.
    Thrice(Box<[Lies; 3]>, f64),
}

/// Where a mapping lies.
pub fn lying(mapping: &SolidMapping) -> Lying {
    Lying::Once(match mapping {
        SolidMapping::Uv(uv) => {
            let [[ux, vx, x], [uy, vy, y]] = uv.rows();
            Lies::by(Space::Uv, [[ux, vx, 0.0, x], [uy, vy, 0.0, y], [0.0; 4]])
        }
        SolidMapping::Object { scale, offset } => Lies::by(Space::Object, scaled_and_moved(scale.0, *offset)),
        SolidMapping::World { scale, offset } => Lies::by(Space::World, scaled_and_moved(scale.0, *offset)),
        SolidMapping::Planar(planar) => {
            let size = planar.size.0.map(|size| 1.0 / size);
            seen_from(DVec3::from(planar.normal.value), DVec3::from(planar.origin), size)
        }
        SolidMapping::Spherical(spherical) => {
            let [right, up, front] = sides(DVec3::from(spherical.axis.value));
            // The axis is the front: longitude goes from `up`, which is -z of an upright axis, over the right.
            let center = DVec3::from(spherical.center);
            let map = [right, front, -up].map(|axis| row(axis, center));
            Lies { space: Space::Spherical, map, across: spherical.scale.0 }
        }
        SolidMapping::Triplanar(triplanar) => {
            let side = |normal| seen_from(normal, DVec3::ZERO, [triplanar.scale; 2]);
            return Lying::Thrice(Box::new([DVec3::X, DVec3::Y, DVec3::Z].map(side)), 1.0 / triplanar.blend);
        }
    })
}

/// As it is seen against a direction, so many times along a unit to the right and upwards.
fn seen_from(normal: DVec3, origin: DVec3, scale: [f64; 2]) -> Lies {
    let [right, up, _] = sides(normal);
    Lies::by(Space::Object, [row(scale[0] * right, origin), row(scale[1] * up, origin), [0.0; 4]])
}

/// How far points are from the origin along an axis, times its length.
fn row(axis: DVec3, origin: DVec3) -> [f64; 4] {
    [axis.x, axis.y, axis.z, -axis.dot(origin)]
}

/// The pattern of these words, between these colours; `None` where they are no pattern with coordinates of its own.
pub fn pattern(words: &Albedo, lies: &Lies, [a, b]: [desc::Color; 2]) -> Option<Pattern> {
    let Lies { space, map, across } = *lies;
    Some(Pattern { kind: kind(words)?, space, map, across, a, b })
}

fn scaled_and_moved([x, y, z]: [f64; 3], [dx, dy, dz]: [f64; 3]) -> [[f64; 4]; 3] {
    [[x, 0.0, 0.0, dx], [0.0, y, 0.0, dy], [0.0, 0.0, z, dz]]
}

/// A direction at length one.
fn unit(direction: &Spanned<desc::Vec3>) -> [f64; 3] {
    let direction = DVec3::from(direction.value);
    (direction / direction.abs().max_element()).normalize().to_array()
}

fn kind(words: &Albedo) -> Option<PatternKind> {
    Some(match words {
        Albedo::Color(_) | Albedo::Texture(_) | Albedo::Named(_) => return None,
        Albedo::ColorRamp(_) | Albedo::Mix(_) | Albedo::Multiply(_) | Albedo::VertexColor(_) => return None,
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
        Albedo::Wood(wood) => PatternKind::Wood { distortion: wood.distortion, axis: unit(&wood.axis) },
        Albedo::Marble(marble) => PatternKind::Marble { distortion: marble.distortion, axis: unit(&marble.axis) },
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
