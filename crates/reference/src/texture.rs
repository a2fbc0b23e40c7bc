//! Colours of surfaces, constant or from a picture.

use crate::pattern;
use crate::surface::Surface;
use crate::vertex_color::srgb;
use glam::DVec3;
use tracer_core::Scene;
use tracer_core::scene::{Albedo, Light, Material, Texel, TextureView};
use tracer_core::scene::{TextureFilter, TextureWrap};

/// The albedo at a surface.
pub fn albedo(scene: &Scene, albedo: Albedo, s: &Surface) -> DVec3 {
    let index = match albedo {
        Albedo::Color(color) => return DVec3::from(color),
        Albedo::Texture(index) => index,
        Albedo::Pattern(index) => return pattern::color(scene, index, s),
        Albedo::Program(index) => return pattern::program(scene, index, s, |k, uv| texel_at(scene, k, uv)),
    };
    texel_at(scene, index, s.uv)
}

/// What a lamp shines from a surface of it to the viewer, in W/(sr m^2): its radiance times what its material's texture
/// is there, from 0 to 1.
pub fn shine(scene: &Scene, light: &Light, s: &Surface) -> DVec3 {
    if !light.two_sided() && !s.outside {
        return DVec3::ZERO;
    }
    let share = match scene.materials.get(s.material as usize) {
        Some(Material::Emissive(words)) => albedo(scene, words.glow, s).clamp(DVec3::ZERO, DVec3::ONE),
        _ => DVec3::ONE,
    };
    DVec3::from(light.radiance()) * share * scene.radiance_unit
}

/// The number at a surface: of a texture the luminance.
pub fn number(scene: &Scene, number: Albedo, s: &Surface) -> f64 {
    match number {
        Albedo::Color([number, ..]) => number,
        texture => albedo(scene, texture, s).dot(DVec3::new(0.2126, 0.7152, 0.0722)),
    }
}

/// The colour of a texture at coordinates before its own mapping.
fn texel_at(scene: &Scene, index: u32, [u, v]: [f64; 2]) -> DVec3 {
    let texture = scene.texture(index).expect("a texture of the scene");
    let [x, y] = texture.mapping;
    let (u, v) = (x[0] * u + x[1] * v + x[2], y[0] * u + y[1] * v + y[2]);
    // Texel (i, j) covers [i, i + 1) x [j, j + 1), row 0 at the top.
    let x = u * f64::from(texture.width);
    let y = (1.0 - v) * f64::from(texture.height);
    match texture.filter {
        TextureFilter::Nearest => texel(&texture, x.floor(), y.floor()),
        TextureFilter::Bilinear => {
            let (x, y) = (x - 0.5, y - 0.5);
            let row = |j: f64| texel(&texture, x.floor(), j).lerp(texel(&texture, x.floor() + 1.0, j), x - x.floor());
            row(y.floor()).lerp(row(y.floor() + 1.0), y - y.floor())
        }
    }
}

/// A texel by whole numbers, which may lie beyond the borders.
fn texel(texture: &TextureView, i: f64, j: f64) -> DVec3 {
    let (i, j) = (wrap(i, texture.width, texture.wrap), wrap(j, texture.height, texture.wrap));
    match texture.texel(i, j).expect("a texel of the picture") {
        Texel::Srgb8(code) => DVec3::from(code.map(srgb)),
        Texel::Linear(color) => DVec3::from(color.map(f64::from)),
    }
}

fn wrap(i: f64, n: u32, wrap: TextureWrap) -> u32 {
    let size = f64::from(n);
    let k = match wrap {
        TextureWrap::Repeat => i.rem_euclid(size),
        TextureWrap::Clamp => i.clamp(0.0, size - 1.0),
        TextureWrap::Mirror => {
            let k = i.rem_euclid(2.0 * size);
            if k < size { k } else { 2.0 * size - 1.0 - k }
        }
    };
    k as u32
}
