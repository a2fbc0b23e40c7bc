//! What textures say of a material beside its colour: how wide its lobes are, what share they have, another colour.
//! Calls, since only scenes that have such pay for them.

use super::conductor::Tint;
use crate::engine::stages::patterns::{At, luminance, pattern_color};
use crate::engine::stages::textures::texture_color;
use crate::lanes::{Bits, Lanes, Mask, Part};
use crate::math::V3;
use crate::scene::{LEAST_ALPHA, Scene, Table};

/// The largest exponent of Blinn-Phong.
const LARGEST_EXPONENT: f32 = 1e7;

/// The colour of a texture by its number + 1 (as in [`crate::scene::MaterialTable::rows`]), in the lanes of the mask;
/// elsewhere this one.
#[inline(always)]
pub(super) fn texel<F: Lanes>(
    scene: &Scene,
    number: F::U,
    (at, normal): (At<F>, V3<F>),
    mask: F::M,
    mut color: V3<F>,
) -> V3<F> {
    let one = F::U::splat(1);
    let mut pictures = mask;
    if !scene.tables.patterns.is_empty() {
        let pattern = F::U::splat(scene.tables.materials.first_pattern);
        let reckoned = mask & pattern.lt(number);
        if reckoned.any() {
            let told = pattern_color(scene, number - one - pattern, at, normal, reckoned);
            color = V3::select(reckoned, told, color);
        }
        pictures = mask & !reckoned;
    }
    if pictures.any() {
        let [u, v] = at.uv();
        let told = texture_color(&scene.tables.textures, number - one, u, v, pictures);
        color = V3::select(pictures, told, color);
    }
    color
}

/// The same as a call, from black.
pub struct Texel<'t, F: Lanes> {
    pub scene: &'t Scene,
    pub number: F::U,
    pub at: At<F>,
    pub normal: V3<F>,
    pub mask: F::M,
}

impl<F: Lanes> Part<F> for Texel<'_, F> {
    type Out = V3<F>;
    #[inline(always)]
    fn run(self) -> V3<F> {
        let Texel { scene, number, at, normal, mask } = self;
        texel(scene, number, (at, normal), mask, V3::zero())
    }
}

/// A material whose constants are known, where it is met.
pub(super) struct Varying<'t, F: Lanes> {
    pub scene: &'t Scene,
    /// The numbers of its other textures.
    pub table: &'t Table<3>,
    pub at: At<F>,
    pub normal: V3<F>,
    pub material: F::U,
    /// Lanes with metals.
    pub metal: F::M,
    /// As the constants have them.
    pub numbers: Numbers<F>,
    pub valid: F::M,
}

/// What textures may say of a material.
pub(super) struct Numbers<F: Lanes> {
    pub parameter: F,
    pub share: F,
    pub tint: Tint<F>,
    /// Metals that are smooth here.
    pub specular: F::M,
}

impl<F: Lanes> Part<F> for Varying<'_, F> {
    type Out = Numbers<F>;
    #[inline(always)]
    fn run(self) -> Numbers<F> {
        let c = F::splat;
        let (zero, one) = (c(0.0), c(1.0));
        let Varying { scene, table, at, normal, material, metal: metals, mut numbers, valid } = self;
        let [width, share, second] = table.row::<F>(material).map(F::to_bits);
        let on = valid & !width.eq(F::U::splat(0));
        if on.any() {
            let number = luminance(F::apart(Texel { scene, number: width, at, normal, mask: on })).max(zero);
            let roughness = number.min(one);
            let metal = on & metals;
            let width = F::select(metal, roughness * roughness, number.min(c(LARGEST_EXPONENT)));
            numbers.parameter = F::select(on, width, numbers.parameter);
            numbers.specular = metal & width.lt(c(LEAST_ALPHA as f32));
        }
        let on = valid & !share.eq(F::U::splat(0));
        if on.any() {
            let number = luminance(F::apart(Texel { scene, number: share, at, normal, mask: on }));
            numbers.share = F::select(on, number.max(zero).min(one), numbers.share);
        }
        let on = valid & !second.eq(F::U::splat(0));
        if on.any() {
            let V3(red, green, blue) = F::apart(Texel { scene, number: second, at, normal, mask: on });
            let color = V3(red.max(zero).min(one), green.max(zero).min(one), blue.max(zero).min(one));
            numbers.tint = Tint { color, lanes: on };
        }
        numbers
    }
}
