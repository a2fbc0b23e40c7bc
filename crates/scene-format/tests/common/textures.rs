//! Pictures and patterns by chance.

use super::Random;
use super::generated::{number, share, text, vector};
use scene_format::desc::*;
use scene_format::diagnostic::Spanned;
use std::path::PathBuf;
use std::sync::Arc;

fn mapping(random: &mut Random) -> Mapping {
    if random.below(2) == 0 {
        return Mapping::default();
    }
    if random.below(2) == 0 {
        return match random.below(3) {
            0 => planar(random).into(),
            1 => spherical(random).into(),
            _ => triplanar(random).into(),
        };
    }
    let uniform = number(random, -100.0, 100.0);
    let scale = [uniform, if random.below(2) == 0 { uniform } else { number(random, -100.0, 100.0) }];
    let offset = if random.below(2) == 0 { [0.0; 2] } else { [random.unit(), number(random, -9.0, 9.0)] };
    Mapping::uv(scale, number(random, -360.0, 360.0), offset)
}

fn planar(random: &mut Random) -> Planar {
    let size = PerAxis([(); 2].map(|()| number(random, 0.1, 9.0)));
    Planar { origin: vector(random), normal: [number(random, 0.1, 9.0), random.unit(), 0.0].into(), size }
}

fn direction(random: &mut Random) -> Spanned<[f64; 3]> {
    [number(random, 0.1, 9.0), random.unit(), 0.0].into()
}

fn spherical(random: &mut Random) -> Spherical {
    let scale = PerAxis([(); 2].map(|()| number(random, -9.0, 9.0)));
    Spherical { center: vector(random), axis: direction(random), scale }
}

fn triplanar(random: &mut Random) -> Triplanar {
    Triplanar { scale: number(random, -9.0, 9.0), blend: number(random, 0.01, 1.0) }
}

/// A colour, or another pattern.
fn part(random: &mut Random) -> Albedo {
    if random.below(8) == 0 { reckoned(random) } else { share(random).into() }
}

/// A number up to this, constant or by place.
pub fn varying(random: &mut Random, high: f64) -> Number {
    if random.below(4) > 0 {
        return (high * random.unit()).into();
    }
    let [a, b] = [(); 2].map(|()| share(random).map(|channel| high * channel).into());
    Number(Albedo::Gradient(Box::new(Gradient { a, b, axis: GradientAxis::X, mapping: solid_mapping(random) })))
}

fn solid_mapping(random: &mut Random) -> SolidMapping {
    let (scale, offset) = (PerAxis([(); 3].map(|()| number(random, -9.0, 9.0))), vector(random));
    match random.below(4) {
        0 => SolidMapping::object(),
        1 => SolidMapping::Object { scale, offset },
        2 => SolidMapping::World { scale, offset },
        _ => mapping(random).into(),
    }
}

fn reckoned(random: &mut Random) -> Albedo {
    let (a, b, solid) = (part(random), part(random), solid_mapping(random));
    match random.below(12) {
        0 => Albedo::Checkerboard(Box::new(Checkerboard { a, b, mapping: solid })),
        1 => {
            let along = *random.pick(&[LinesAlong::Both, LinesAlong::U, LinesAlong::V]);
            Albedo::Lines(Box::new(Lines { a, b, width: random.unit(), along, mapping: mapping(random) }))
        }
        2 => Albedo::Dots(Box::new(Dots { a, b, radius: 0.5 * random.unit(), mapping: mapping(random) })),
        3 => {
            let axis = *random.pick(&[GradientAxis::X, GradientAxis::Y, GradientAxis::Z, GradientAxis::Radial]);
            Albedo::Gradient(Box::new(Gradient { a, b, axis, mapping: solid }))
        }
        4 => {
            let kind = *random.pick(&[NoiseKind::Fbm, NoiseKind::Perlin, NoiseKind::Turbulence]);
            let (octaves, lacunarity, gain) = (1 + random.below(16) as u32, number(random, 1.0, 8.0), random.unit());
            Albedo::Noise(Box::new(Noise { a, b, kind, octaves, lacunarity, gain, mapping: solid }))
        }
        5 => Albedo::Wood(Box::new(Wood {
            a,
            b,
            distortion: number(random, -9.0, 9.0),
            axis: direction(random),
            mapping: solid,
        })),
        8 => Albedo::Mix(Box::new(Mix { a, b, weight: part(random) })),
        9 => Albedo::Multiply(Box::new(Multiply { a, b })),
        11 => {
            let spaces = [VertexColorSpace::Auto, VertexColorSpace::Srgb, VertexColorSpace::Linear];
            Albedo::VertexColor(Box::new(VertexColor { color_space: *random.pick(&spaces) }))
        }
        10 => {
            let [low, high] = [0.5 * random.unit(), 0.5 + 0.5 * random.unit()];
            let stops = [low, low, high].map(|at| Stop { at: at.into(), color: share(random).into() });
            let kinds = [RampInterpolation::Linear, RampInterpolation::Smooth, RampInterpolation::Constant];
            let (stops, interpolation) = (Stops(stops.into()), *random.pick(&kinds));
            Albedo::ColorRamp(Box::new(ColorRamp { input: a, stops, interpolation }))
        }
        6 => Albedo::Marble(Box::new(Marble {
            a,
            b,
            distortion: number(random, -9.0, 9.0),
            axis: direction(random),
            mapping: solid,
        })),
        _ => {
            let feature = *random.pick(&[VoronoiFeature::F1, VoronoiFeature::F2MinusF1, VoronoiFeature::Cell]);
            Albedo::Voronoi(Box::new(Voronoi { a, b, feature, jitter: random.unit(), mapping: solid }))
        }
    }
}

/// Any colour: a picture, a pattern, or the same everywhere.
pub fn albedo(random: &mut Random) -> Albedo {
    match random.below(6) {
        0 => Albedo::Texture(Texture {
            file: PathBuf::from(text(random)).into(),
            filter: *random.pick(&[TextureFilter::Bilinear, TextureFilter::Nearest]),
            wrap: *random.pick(&[TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror]),
            color_space: *random.pick(&[TextureColorSpace::Auto, TextureColorSpace::Srgb, TextureColorSpace::Linear]),
            channel: *random.pick(&[
                TextureChannel::Auto,
                TextureChannel::Red,
                TextureChannel::Green,
                TextureChannel::Blue,
                TextureChannel::Alpha,
                TextureChannel::Luminance,
            ]),
            mapping: mapping(random),
        }),
        1 | 2 => reckoned(random),
        _ => Albedo::Color(share(random).into()),
    }
}

/// Gives names to some of the textures, and has some of them made of these.
pub fn named_textures(
    random: &mut Random,
    materials: &mut [NamedMaterial],
    objects: &mut [Spanned<Object>],
) -> Vec<Arc<NamedTexture>> {
    let mut textures: Vec<Arc<NamedTexture>> = Vec::new();
    let inline = objects.iter_mut().filter_map(|object| match object.value.material_mut() {
        MaterialRef::Inline(material) => Some(&mut material.value),
        MaterialRef::Named { .. } | MaterialRef::Default => None,
    });
    for material in materials.iter_mut().map(|named| &mut named.material).chain(inline) {
        let color = match material {
            Material::Diffuse(words) => &mut words.albedo,
            Material::BlinnPhong(words) => &mut words.albedo,
            _ => continue,
        };
        if random.below(3) > 0 {
            continue;
        }
        let (k, mut texture) = (textures.len(), color.clone());
        if let Some(last) = textures.last().filter(|_| k % 8 > 0 && random.below(2) == 0) {
            let b = Albedo::Named(Arc::clone(last));
            texture = Albedo::Mix(Box::new(Mix { a: texture, b, weight: part(random) }));
        }
        let name: Arc<str> = format!("{}{k}", text(random)).into();
        textures.push(Arc::new(NamedTexture { name: name.into(), texture }));
        *color = Albedo::Named(Arc::clone(&textures[k]));
    }
    textures
}
