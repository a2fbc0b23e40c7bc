//! Textures drawn at random: pictures, patterns, and what is made of both.

use super::draw::{color, magnitude, once_in, one_of};
use super::world::World;
use crate::picture::Picture;
use glam::DVec3;
use scene_format::desc::{
    Albedo, Checkerboard, Color, ColorRamp, Dots, Gradient, GradientAxis, Lines, LinesAlong, Mapping, Marble, Material,
    MaterialRef, Mix, Multiply, NamedTexture, Noise, NoiseKind, Number, PerAxis, Planar, RampInterpolation,
    Reflectance, SolidMapping, Spherical, Stop, Stops, Texture, TextureChannel, TextureColorSpace, TextureFilter,
    TextureWrap, Triplanar, VertexColor, VertexColorSpace, Voronoi, VoronoiFeature, Wood,
};
use scene_format::diagnostic::Spanned;
use std::sync::Arc;
use tracer_reference::Random;

/// A small picture, coarse enough that its texels show.
fn texture(world: &mut World, random: &mut Random) -> Albedo {
    let (a, b, n) = (color(random), color(random), 2.0 + random.below(4) as f64);
    let paint = |u: f64, v: f64| {
        let checked = ((u * n).floor() + (v * n).floor()) % 2.0 == 0.0;
        DVec3::from_array(if checked { a } else { b }) * (0.6 + 0.4 * u)
    };
    let picture = Picture::from_fn(8, 8, paint);
    // Eight by eight pixels: the encoder has nothing to refuse.
    let Ok(bytes) = picture.png() else { return Albedo::default() };
    let file = world.file("texture", "png", bytes).into();
    let filter = one_of(random, &[TextureFilter::Bilinear, TextureFilter::Nearest]);
    let wrap = one_of(random, &[TextureWrap::Repeat, TextureWrap::Clamp, TextureWrap::Mirror]);
    let spaces = [TextureColorSpace::Auto, TextureColorSpace::Auto, TextureColorSpace::Srgb, TextureColorSpace::Linear];
    let channels = [
        TextureChannel::Red,
        TextureChannel::Green,
        TextureChannel::Blue,
        TextureChannel::Alpha,
        TextureChannel::Luminance,
    ];
    let channel = if once_in(random, 3) { one_of(random, &channels) } else { TextureChannel::Auto };
    Albedo::Texture(Texture {
        file,
        filter,
        wrap,
        color_space: one_of(random, &spaces),
        channel,
        mapping: mapping(random),
    })
}

/// Where a texture lies, as often as not as it is.
fn mapping(random: &mut Random) -> Mapping {
    if once_in(random, 2) {
        return Mapping::default();
    }
    match random.below(6) {
        0 => return planar(random).into(),
        1 => return spherical(random).into(),
        2 => return triplanar(random).into(),
        _ => {}
    }
    let side = |random: &mut Random| magnitude(random, 0.5, 6.0);
    let scale = if once_in(random, 2) { [side(random); 2] } else { [side(random), -side(random)] };
    let offset = if once_in(random, 2) { [0.0; 2] } else { [random.number(), random.between(-3.0, 3.0)] };
    Mapping::uv(scale, if once_in(random, 2) { 0.0 } else { random.between(-180.0, 180.0) }, offset)
}

/// Any direction.
fn direction(random: &mut Random) -> [f64; 3] {
    [random.between(0.1, 1.0), random.between(-1.0, 1.0), random.between(-1.0, 1.0)]
}

/// The usual one as often as any.
fn axis(random: &mut Random, usual: [f64; 3]) -> Spanned<[f64; 3]> {
    if once_in(random, 2) { usual } else { direction(random) }.into()
}

fn point(random: &mut Random) -> [f64; 3] {
    if once_in(random, 2) { [0.0; 3] } else { [0; 3].map(|_| random.between(-1.0, 1.0)) }
}

fn planar(random: &mut Random) -> Planar {
    let size = if once_in(random, 2) { [1.0; 2] } else { [0; 2].map(|_| magnitude(random, 0.2, 2.0)) };
    let normal = if once_in(random, 2) { [0.0, 1.0, 0.0] } else { direction(random) };
    Planar { origin: point(random), normal: normal.into(), size: PerAxis(size) }
}

fn spherical(random: &mut Random) -> Spherical {
    let scale = if once_in(random, 2) { [1.0; 2] } else { [0; 2].map(|_| magnitude(random, 1.0, 8.0)) };
    let axis = if once_in(random, 2) { [0.0, 1.0, 0.0] } else { direction(random) };
    Spherical { center: point(random), axis: axis.into(), scale: PerAxis(scale) }
}

fn triplanar(random: &mut Random) -> Triplanar {
    let blend = if once_in(random, 2) { 0.2 } else { magnitude(random, 0.02, 1.0) };
    Triplanar { scale: magnitude(random, 0.5, 6.0), blend }
}

/// Where a texture lies on a surface or in space.
fn solid_mapping(random: &mut Random) -> SolidMapping {
    let cells = |random: &mut Random| magnitude(random, 0.5, 6.0);
    let scale = PerAxis(if once_in(random, 2) { [cells(random); 3] } else { [0; 3].map(|_| cells(random)) });
    let offset = if once_in(random, 2) { [0.0; 3] } else { [0; 3].map(|_| random.between(-3.0, 3.0)) };
    match random.below(4) {
        0 => SolidMapping::object(),
        1 => SolidMapping::Object { scale, offset },
        2 => SolidMapping::World { scale, offset },
        _ => mapping(random).into(),
    }
}

/// A colour, or seldom another texture, so many within each other at most.
fn part(world: &mut World, random: &mut Random, depth: u32) -> Albedo {
    match random.below(if depth > 0 { 6 } else { 1 }) {
        1 => texture(world, random),
        2 => pattern(world, random, depth - 1),
        _ => color(random).into(),
    }
}

/// Colours of a ramp.
fn stops(random: &mut Random) -> Stops {
    let mut places: Vec<f64> = (0..2 + random.below(3)).map(|_| random.number()).collect();
    places.sort_by(f64::total_cmp);
    Stops(places.into_iter().map(|at| Stop { at: at.into(), color: color(random).into() }).collect())
}

/// A texture that is reckoned.
// Long: one arm a kind.
fn pattern(world: &mut World, random: &mut Random, depth: u32) -> Albedo {
    let (a, b) = (part(world, random, depth), part(world, random, depth));
    let solid = solid_mapping(random);
    let half = |random: &mut Random, usual: f64, high: f64| {
        if once_in(random, 2) { usual } else { random.between(0.1 * high, high) }
    };
    match random.below(11) {
        0 => Albedo::Checkerboard(Box::new(Checkerboard { a, b, mapping: solid })),
        1 => {
            let along = one_of(random, &[LinesAlong::Both, LinesAlong::U, LinesAlong::V]);
            let width = half(random, 0.05, 0.9);
            Albedo::Lines(Box::new(Lines { a, b, width, along, mapping: mapping(random) }))
        }
        2 => Albedo::Dots(Box::new(Dots { a, b, radius: half(random, 0.3, 0.5), mapping: mapping(random) })),
        3 => {
            let axis = one_of(random, &[GradientAxis::X, GradientAxis::Y, GradientAxis::Z, GradientAxis::Radial]);
            Albedo::Gradient(Box::new(Gradient { a, b, axis, mapping: solid }))
        }
        4 => {
            let kind = one_of(random, &[NoiseKind::Fbm, NoiseKind::Perlin, NoiseKind::Turbulence]);
            let octaves = if once_in(random, 2) { 6 } else { 1 + random.below(10) as u32 };
            let (lacunarity, gain) = (half(random, 2.0, 3.0).max(1.0), half(random, 0.5, 0.9));
            Albedo::Noise(Box::new(Noise { a, b, kind, octaves, lacunarity, gain, mapping: solid }))
        }
        5 => Albedo::Wood(Box::new(Wood {
            a,
            b,
            distortion: half(random, 0.2, 2.0),
            axis: axis(random, [0.0, 1.0, 0.0]),
            mapping: solid,
        })),
        7 => {
            let weight = if once_in(random, 3) { [0.5; 3].into() } else { part(world, random, depth.max(1)) };
            Albedo::Mix(Box::new(Mix { a, b, weight }))
        }
        8 => Albedo::Multiply(Box::new(Multiply { a, b })),
        9 => {
            let kinds = [RampInterpolation::Linear, RampInterpolation::Smooth, RampInterpolation::Constant];
            let (input, interpolation) = (part(world, random, depth.max(1)), one_of(random, &kinds));
            Albedo::ColorRamp(Box::new(ColorRamp { input, stops: stops(random), interpolation }))
        }
        6 => Albedo::Marble(Box::new(Marble {
            a,
            b,
            distortion: half(random, 1.0, 3.0),
            axis: axis(random, [1.0, 0.0, 0.0]),
            mapping: solid,
        })),
        _ => {
            let feature = one_of(random, &[VoronoiFeature::F1, VoronoiFeature::F2MinusF1, VoronoiFeature::Cell]);
            Albedo::Voronoi(Box::new(Voronoi { a, b, feature, jitter: half(random, 1.0, 1.0), mapping: solid }))
        }
    }
}

/// The colours of so many vertices, by which what a matt or glossy material reflects is multiplied; else none.
pub fn of_vertices(material: &mut Material, vertices: usize, random: &mut Random) -> Vec<Color> {
    let albedo = match material {
        Material::Diffuse(words) => &mut words.albedo,
        Material::BlinnPhong(words) => &mut words.albedo,
        _ => return Vec::new(),
    };
    let spaces = [VertexColorSpace::Auto, VertexColorSpace::Srgb, VertexColorSpace::Linear];
    let b = Albedo::VertexColor(Box::new(VertexColor { color_space: one_of(random, &spaces) }));
    let a = std::mem::take(albedo);
    *albedo = Albedo::Multiply(Box::new(Multiply { a, b }));
    (0..vertices).map(|_| color(random)).collect()
}

/// A colour or a texture.
pub fn albedo(world: &mut World, random: &mut Random) -> Albedo {
    match random.below(8) {
        0 => texture(world, random),
        1 => pattern(world, random, 2),
        _ => Albedo::Color(color(random).into()),
    }
}

/// A texture.
pub fn textured(world: &mut World, random: &mut Random) -> Albedo {
    if once_in(random, 2) { texture(world, random) } else { pattern(world, random, 2) }
}

/// A number between these, seldom by place.
pub fn number(world: &mut World, low: f64, high: f64, random: &mut Random) -> Number {
    let between =
        |random: &mut Random| if low > 0.0 { magnitude(random, low, high) } else { random.between(low, high) };
    let a = between(random);
    if !once_in(random, 6) {
        return a.into();
    }
    let [a, b] = [a, between(random)].map(|number| Albedo::from([number; 3]));
    let weight = if once_in(random, 2) { texture(world, random) } else { pattern(world, random, 1) };
    Number(Albedo::Mix(Box::new(Mix { a, b, weight })))
}

/// The colour of a material, to be written anew.
fn color_of(material: &mut Material) -> Option<&mut Albedo> {
    match material {
        Material::Diffuse(words) => Some(&mut words.albedo),
        Material::BlinnPhong(words) => Some(&mut words.albedo),
        Material::Mirror(words) => Some(&mut words.reflectance),
        Material::Transparent(words) => Some(&mut words.transmittance),
        Material::Emissive(words) => Some(&mut words.color),
        Material::Conductor(words) => match &mut words.reflectance {
            Reflectance::Tinted { reflectance, .. } => Some(reflectance),
            Reflectance::Metal(_) | Reflectance::Complex { .. } => None,
        },
    }
}

/// Gives names to textures, as a person would who uses one twice, and has some named that others are made of.
pub fn name_textures(world: &mut World, random: &mut Random) {
    let textures = &mut world.desc.textures;
    let inline = world.desc.objects.iter_mut().filter_map(|object| match object.value.material_mut() {
        MaterialRef::Inline(inner) => Some(&mut inner.value),
        MaterialRef::Named { .. } | MaterialRef::Default => None,
    });
    for material in world.desc.materials.iter_mut().map(|named| &mut named.material).chain(inline) {
        if let Some(color) = color_of(material) {
            name_texture(textures, color, random);
        }
    }
}

fn name_texture(textures: &mut Vec<Arc<NamedTexture>>, color: &mut Albedo, random: &mut Random) {
    let parts = match color {
        Albedo::Color(_) | Albedo::Named(_) => return,
        Albedo::Mix(mix) => vec![&mut mix.a, &mut mix.b, &mut mix.weight],
        Albedo::ColorRamp(ramp) => vec![&mut ramp.input],
        _ => Vec::new(),
    };
    parts.into_iter().for_each(|part| name_texture(textures, part, random));
    if once_in(random, 2) {
        // The same one has one name.
        let known = textures.iter().find(|named| named.texture == *color).map(Arc::clone);
        let named = known.unwrap_or_else(|| {
            let name: Arc<str> = format!("t{}", textures.len()).into();
            let named = Arc::new(NamedTexture { name: name.into(), texture: color.clone() });
            textures.push(Arc::clone(&named));
            named
        });
        *color = Albedo::Named(named);
    }
}
