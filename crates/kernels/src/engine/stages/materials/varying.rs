//! What textures say of a material beside its colour: how wide its lobes are, what share they have, another colour.
//! Calls, since only scenes that have such pay for them.

use super::Bsdf;
use crate::engine::stages::patterns::pattern_color;
use crate::engine::stages::surface::Surface;
use crate::engine::stages::textures::texture_color;
use crate::lanes::{Bits, Lanes, Mask, Part};
use crate::math::V3;
use crate::scene::{LEAST_ALPHA, Scene, Table};

/// The largest exponent of Blinn-Phong.
const LARGEST_EXPONENT: f32 = 1e7;

/// The colour of a texture by its number + 1 (as in [`crate::scene::MaterialTable::rows`]), in the lanes of the mask;
/// anything elsewhere.
pub(super) struct Texel<'t, 's, F: Lanes> {
    pub scene: &'t Scene,
    pub number: F::U,
    pub s: &'s Surface<F>,
    pub mask: F::M,
}

impl<F: Lanes> Part<F> for Texel<'_, '_, F> {
    type Out = V3<F>;
    #[inline(always)]
    fn run(self) -> V3<F> {
        let Texel { scene, number, s, mask } = self;
        let one = F::U::splat(1);
        let mut color = V3::zero();
        let mut pictures = mask;
        if !scene.tables.patterns.is_empty() {
            let pattern = F::U::splat(scene.tables.materials.first_pattern);
            let reckoned = mask & pattern.lt(number);
            if reckoned.any() {
                color = pattern_color(scene, number - one - pattern, s, reckoned);
            }
            pictures = mask & !reckoned;
        }
        if pictures.any() {
            let texel = texture_color(&scene.tables.textures, number - one, s.u, s.v, pictures);
            color = V3::select(pictures, texel, color);
        }
        color
    }
}

/// A material whose constants are known, and the numbers of its other textures.
pub(super) struct Varying<'t, 's, F: Lanes> {
    pub scene: &'t Scene,
    pub table: &'t Table<3>,
    pub s: &'s Surface<F>,
    pub bsdf: Bsdf<'t, F>,
    pub valid: F::M,
}

impl<'t, F: Lanes> Part<F> for Varying<'t, '_, F> {
    type Out = Bsdf<'t, F>;
    #[inline(always)]
    fn run(self) -> Bsdf<'t, F> {
        let c = F::splat;
        let (zero, one) = (c(0.0), c(1.0));
        let Varying { scene, table, s, mut bsdf, valid } = self;
        let [width, share, second] = table.row::<F>(s.material).map(F::to_bits);
        let on = valid & !width.eq(F::U::splat(0));
        if on.any() {
            let number = luminance(F::apart(Texel { scene, number: width, s, mask: on })).max(zero);
            let roughness = number.min(one);
            let metal = on & bsdf.metal;
            let width = F::select(metal, roughness * roughness, number.min(c(LARGEST_EXPONENT)));
            bsdf.parameter = F::select(on, width, bsdf.parameter);
            let specular = metal & width.lt(c(LEAST_ALPHA as f32));
            bsdf.glossy = bsdf.glossy & !specular;
            bsdf.mirror = bsdf.mirror | specular;
        }
        let on = valid & !share.eq(F::U::splat(0));
        if on.any() {
            let number = luminance(F::apart(Texel { scene, number: share, s, mask: on }));
            bsdf.share = F::select(on, number.max(zero).min(one), bsdf.share);
        }
        let on = valid & !second.eq(F::U::splat(0));
        if on.any() {
            let V3(red, green, blue) = F::apart(Texel { scene, number: second, s, mask: on });
            let color = V3(red.max(zero).min(one), green.max(zero).min(one), blue.max(zero).min(one));
            bsdf.tint = V3::select(on, color, bsdf.tint);
        }
        bsdf
    }
}

/// 0.2126 R + 0.7152 G + 0.0722 B, of greys the very number.
#[inline(always)]
fn luminance<F: Lanes>(c: V3<F>) -> F {
    F::splat(0.0722).fma(c.2 - c.1, F::splat(0.2126).fma(c.0 - c.1, c.1))
}
