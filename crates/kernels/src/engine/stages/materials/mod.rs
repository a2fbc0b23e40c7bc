//! Scattering over lanes.
//!
//! The contract:
//! - wo points to where light goes, wi to where it comes from, both unit and away from the surface, in render space;
//!   the shading normal `ns` is on the viewer's side. Which side a lobe takes light from is for [`Bsdf::reaches`] to
//!   say: callers take |cos|.
//! - `f` is per steradian and has no cosine; densities are per unit of solid angle of wi. A weight is f |cos| /
//!   density.
//! - Lanes are told apart by flags, a mask each, as pbrt's `BxdfFlags`: `diffuse` (DIFFUSE only: f does not depend on
//!   directions), `glossy` (GLOSSY, beside DIFFUSE or not), `mirror` (SPECULAR and REFLECTION) and `transparent`
//!   (SPECULAR, REFLECTION and TRANSMISSION). A lane has one of them, or none where nothing is scattered. Specular
//!   lobes are sampled only: their f and density are zero.
//! - No sample: density 0. Radiance that is refracted is scaled by (n_i / n_t)^2 (Veach 1997, 5.2), which is kept apart
//!   as `eta2`.
//!
//! A lobe is a file here. Which material has which is in its row ([`crate::scene::materials`]); nobody outside of this
//! room asks for a kind.

mod blinn_phong;
mod conductor;
mod dielectric;
mod seen;
mod specular_reflection;
mod varying;

pub use dielectric::Dielectric;
#[cfg(test)]
use dielectric::fresnel;
pub use specular_reflection::reflect_bent;

use super::patterns::At;
use super::surface::Surface;
use crate::bvh::SAME_SIDE;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;
use crate::sampling::warp;
use crate::scene::{ConductorTable, LEAST_EXPONENT, Lobe, MaterialTable, NARROWEST_ALPHA, Scene};
use blinn_phong::BlinnPhong;
use conductor::{Conductor, Tint};
use std::f32::consts::{FRAC_1_PI, PI};
pub(super) use varying::Texel;
use varying::{Numbers, Varying, texel};

/// How lanes scatter.
#[derive(Clone, Copy)]
pub struct Bsdf<'t, F: Lanes> {
    /// Albedo, reflectance or transmittance, per channel.
    pub color: V3<F>,
    /// DIFFUSE and nothing else: light leaves alike in all directions.
    pub diffuse: F::M,
    /// GLOSSY.
    pub glossy: F::M,
    /// SPECULAR | REFLECTION.
    pub mirror: F::M,
    /// SPECULAR | REFLECTION | TRANSMISSION.
    pub transparent: F::M,
    /// Of transparent lanes the index of refraction, of Blinn-Phong's and rough metals' alpha.
    parameter: F,
    /// Of Blinn-Phong s, of metals the place in their table.
    share: F,
    /// Of metals the tint that a texture gives.
    tint: Tint<F>,
    /// Blinn-Phong, both kinds.
    blinn_phong: F::M,
    /// Blinn-Phong with the energy-conserving lobe.
    conserving: F::M,
    /// Metals, rough or smooth; no lane without a table.
    metal: F::M,
    /// Their table.
    conductors: Option<&'t ConductorTable>,
}

/// A [`Bsdf`] that is no specular one as columns hold it, without colour.
pub struct Packed<F: Lanes> {
    /// Bits of [`packed`].
    pub kind: F::U,
    /// Its numbers.
    pub numbers: [F; 2],
}

/// Bits of [`Packed::kind`]; those above [`packed::ALL`] are free for whoever keeps it.
pub mod packed {
    /// Blinn-Phong by the report's formula.
    pub const GLOSSY: u32 = 1;
    /// Blinn-Phong, energy-conserving.
    pub const CONSERVING: u32 = 2;
    /// A metal.
    pub const METAL: u32 = 4;
    /// A metal with a tint from a texture.
    pub const TINTED: u32 = 8;
    /// All bits.
    pub const ALL: u32 = GLOSSY | CONSERVING | METAL | TINTED;
}

impl<'t, F: Lanes> Bsdf<'t, F> {
    /// Looks the material up, and its texture + 1, or 0; all masks are within `valid`.
    #[inline(always)]
    fn new(table: &'t MaterialTable, material: F::U, valid: F::M) -> (Self, F::U) {
        let none = F::M::from_bits(0);
        let [red, green, blue, kind, texture] = table.rows.row::<F>(material);
        let kind = kind.to_bits();
        let is = |k: Lobe| if table.has(k) { valid & kind.eq(F::U::splat(k as u32)) } else { none };
        let (transparent, conserving) = (is(Lobe::Dielectric), is(Lobe::BlinnPhongConserving));
        let blinn_phong = is(Lobe::BlinnPhong) | conserving;
        let (rough_metal, smooth_metal) = (is(Lobe::Conductor), is(Lobe::SmoothConductor));
        let metal = rough_metal | smooth_metal;
        let (mut parameter, mut share) = (F::splat(1.0), F::splat(0.0));
        if (transparent | blinn_phong | metal).any() {
            [parameter, share] = table.parameters.row::<F>(material);
        }
        let bsdf = Bsdf {
            color: V3(red, green, blue),
            diffuse: is(Lobe::Lambert),
            glossy: blinn_phong | rough_metal,
            mirror: is(Lobe::Mirror) | smooth_metal,
            transparent,
            parameter,
            share,
            tint: Tint::none(),
            blinn_phong,
            conserving,
            metal,
            conductors: table.conductors.as_ref(),
        };
        (bsdf, texture.to_bits())
    }

    /// The material of a surface, its texture looked up.
    #[inline(always)]
    pub fn at(scene: &'t Scene, s: &Surface<F>, valid: F::M) -> Self {
        let tables = &scene.tables;
        let (mut bsdf, texture) = Bsdf::<'t, F>::new(&tables.materials, s.material, valid);
        if tables.materials.textured {
            let textured = valid & !texture.eq(F::U::splat(0));
            bsdf.color = texel(scene, texture, (At::of(s), s.ns), textured, bsdf.color);
            if let Some(table) = &tables.materials.varying {
                let Bsdf { parameter, share, tint, metal, .. } = bsdf;
                let numbers = Numbers { parameter, share, tint, specular: F::M::from_bits(0) };
                let (at, normal, material) = (At::of(s), s.ns, s.material);
                let told = F::apart(Varying { scene, table, at, normal, material, metal, numbers, valid });
                (bsdf.parameter, bsdf.share, bsdf.tint) = (told.parameter, told.share, told.tint);
                bsdf.glossy = bsdf.glossy & !told.specular;
                bsdf.mirror = bsdf.mirror | told.specular;
            }
        }
        bsdf
    }

    /// The material of a surface that rays have met, the first of them the batch's i-th: with what is behind it, where
    /// bodies touch.
    #[inline(always)]
    pub fn met(scene: &'t Scene, s: &Surface<F>, valid: F::M, behind: &[u32], i: usize) -> Self {
        let mut bsdf = Self::at(scene, s, valid);
        if scene.has_touching() {
            bsdf.touch(scene, s, F::U::load(&behind[i..]));
        }
        bsdf
    }

    /// Takes what is behind transparent lanes for the body that begins there, by its material + 1; 0: there is none.
    /// Light passes from one body into the other, or into both at once ([`SAME_SIDE`]), and takes on the colour of
    /// both. What textures say there, they say by the coordinates of the face that stands for both.
    #[inline(always)]
    fn touch(&mut self, scene: &Scene, s: &Surface<F>, behind: F::U) {
        let table = &scene.tables.materials;
        let none = F::U::splat(0);
        let on = self.transparent & !behind.eq(none);
        if !on.any() {
            return;
        }
        let both = !(behind & F::U::splat(SAME_SIDE)).eq(none);
        let other = F::U::select(on, (behind & F::U::splat(!SAME_SIDE)) - F::U::splat(1), none);
        let [ior, _] = table.parameters.row::<F>(other);
        let [red, green, blue, _, number] = table.rows.row::<F>(other);
        let mut color = V3(red, green, blue);
        if table.textured {
            let number = number.to_bits();
            let mask = on & !number.eq(none);
            if mask.any() {
                color = V3::select(mask, F::apart(Texel { scene, number, at: At::of(s), normal: s.ns, mask }), color);
            }
        }
        let touching = F::select(both, self.parameter * ior, self.parameter / ior);
        self.parameter = F::select(on, touching, self.parameter);
        self.color = V3::select(on, self.color.mul(color), self.color);
    }

    /// Lanes with a lobe that is not specular: [`Bsdf::evaluate`] and [`Bsdf::sample_rough`] are for them.
    #[inline(always)]
    pub fn rough(&self) -> F::M {
        self.diffuse | self.glossy
    }

    /// Lanes with specular lobes only.
    #[inline(always)]
    pub fn specular(&self) -> F::M {
        self.mirror | self.transparent
    }

    /// Takes away all lobes but the specular ones.
    #[inline(always)]
    pub fn keep_specular(&mut self) {
        self.diffuse = F::M::from_bits(0);
        self.glossy = F::M::from_bits(0);
    }

    /// Rough lanes that light from a direction with this cosine to the shading normal gets through: from above, since
    /// none of these lobes transmits.
    #[inline(always)]
    pub fn reaches(&self, cos_i: F) -> F::M {
        F::splat(0.0).lt(cos_i)
    }

    /// Index of refraction of the inside against the outside where light passes, else one.
    #[inline(always)]
    pub fn ior(&self) -> F {
        F::select(self.transparent, self.parameter, F::splat(1.0))
    }

    /// Both ways of transparent lanes.
    #[inline(always)]
    pub fn dielectric(&self, s: &Surface<F>, wo: V3<F>) -> Dielectric<F> {
        Dielectric::new(s, wo, self.parameter)
    }

    /// What a mirror or smooth metal carries on, at this cosine to the normal that reflects.
    #[inline(always)]
    pub fn mirrored_color(&self, cos: F) -> V3<F> {
        let Some(table) = self.conductors else { return self.color };
        let metal = self.mirror & self.metal;
        if !metal.any() {
            return self.color;
        }
        V3::select(metal, self.conductor(table, metal).fresnel(cos), self.color)
    }

    /// The metals' lobe, for these of their lanes.
    #[inline(always)]
    fn conductor(&self, table: &ConductorTable, lanes: F::M) -> Conductor<F> {
        let place = F::select(lanes, self.share, F::splat(0.0));
        Conductor::new(table, place.to_int(), self.parameter, self.color, self.tint)
    }

    /// Rough lanes whose f is their colour times a number. Metals' is another colour at every angle; they share
    /// nothing, and what light paths bring to them is left to paths.
    #[inline(always)]
    pub fn has_one_color(&self) -> F::M {
        self.diffuse | self.blinn_phong
    }

    /// The Blinn-Phong lobe.
    #[inline(always)]
    fn lobe(&self) -> BlinnPhong<F> {
        BlinnPhong { exponent: self.parameter, share: self.share, conserving: self.conserving }
    }

    /// Both lobes at a pair of directions, for the diffuse lanes and Blinn-Phong; `cos_i` is ns.wi > 0.
    #[inline(always)]
    fn lobes(&self, ns: V3<F>, wo: V3<F>, wi: V3<F>, cos_i: F) -> Lobes<F> {
        let c = F::splat;
        let none = c(0.0);
        let mut lobes =
            Lobes { lambert: c(FRAC_1_PI), lambert_pdf: cos_i * c(FRAC_1_PI), glossy: none, glossy_pdf: none };
        if self.blinn_phong.any() {
            let (f, pdf) = self.lobe().evaluate(ns, wo, wi, cos_i);
            lobes.glossy = F::select(self.blinn_phong, f, none);
            lobes.glossy_pdf = F::select(self.blinn_phong, pdf, none);
            lobes.lambert = F::select(self.blinn_phong, (c(1.0) - self.share) * lobes.lambert, lobes.lambert);
        }
        lobes
    }

    /// f and the density with which [`Bsdf::sample_rough`] takes wi, for the rough lanes that wi reaches; `cos_i` is
    /// ns.wi.
    #[inline(always)]
    pub fn evaluate(&self, ns: V3<F>, wo: V3<F>, wi: V3<F>, cos_i: F) -> (V3<F>, F) {
        let lobes = self.lobes(ns, wo, wi, cos_i);
        if !self.glossy.any() {
            return (self.color.scale(lobes.lambert), lobes.lambert_pdf);
        }
        let p = self.lobe().probability();
        let mixed = p.fma(lobes.glossy_pdf, (F::splat(1.0) - p) * lobes.lambert_pdf);
        let pdf = F::select(self.blinn_phong, mixed, lobes.lambert_pdf);
        let f = self.color.scale(lobes.lambert + lobes.glossy);
        let Some(table) = self.conductors else { return (f, pdf) };
        let metal = self.glossy & self.metal;
        if !metal.any() {
            return (f, pdf);
        }
        let (of_metal, metal_pdf) = self.conductor(table, metal).evaluate(table, ns, wo, wi);
        (V3::select(metal, of_metal, f), F::select(metal, metal_pdf, pdf))
    }

    /// A direction for the rough lanes: cosine-weighted, or of the glossy lobe. The weight and the density are those of
    /// both lobes together.
    #[inline(always)]
    pub fn sample_rough(&self, ns: V3<F>, wo: V3<F>, u: F, v: F, lobe: F) -> RoughSample<F> {
        let c = F::splat;
        let local = warp::cosine_hemisphere(u, v);
        let mut wi = ns.to_world(local);
        let mut weight = self.color;
        let mut pdf = local.2 * c(FRAC_1_PI);
        if self.blinn_phong.any() {
            let p = self.lobe().probability();
            let from_lobe = self.blinn_phong & lobe.lt(p);
            let mut counted = self.blinn_phong;
            if from_lobe.any() {
                let (reflected, before) = self.lobe().sample(ns, wo, u, v);
                wi = V3::select(from_lobe, reflected, wi);
                counted = counted & (!from_lobe | before);
            }
            let cos_i = ns.dot(wi);
            let lobes = self.lobes(ns, wo, wi, cos_i.max(c(0.0)));
            let value = lobes.lambert + lobes.glossy;
            let density = p.fma(lobes.glossy_pdf, (c(1.0) - p) * lobes.lambert_pdf);
            let usable = counted & c(0.0).lt(cos_i) & c(0.0).lt(density);
            let scale = F::select(usable, value * cos_i / F::select(usable, density, c(1.0)), c(0.0));
            weight = V3::select(self.blinn_phong, self.color.scale(scale), weight);
            pdf = F::select(self.blinn_phong, F::select(usable, density, c(0.0)), pdf);
        }
        if let Some(table) = self.conductors
            && (self.glossy & self.metal).any()
        {
            let metal = self.glossy & self.metal;
            let conductor = self.conductor(table, metal);
            let of_metal = conductor.sample(table, ns, wo, u, v, lobe);
            let (f, density) = conductor.evaluate(table, ns, wo, of_metal);
            let usable = c(0.0).lt(density);
            let scale = F::select(usable, ns.dot(of_metal) / F::select(usable, density, c(1.0)), c(0.0));
            wi = V3::select(metal, of_metal, wi);
            weight = V3::select(metal, f.scale(scale), weight);
            pdf = F::select(metal, density, pdf);
        }
        RoughSample { wi, weight, pdf }
    }

    /// Rough lanes where [`Bsdf::sample_rough`] takes the glossy lobe.
    #[inline(always)]
    pub fn takes_glossy(&self, lobe: F) -> F::M {
        (self.blinn_phong & lobe.lt(self.lobe().probability())) | (self.glossy & self.metal)
    }

    /// Glossy lanes whose lobe is so narrow that photons go on by it (see `engine::guide`).
    #[inline(always)]
    pub fn narrow(&self) -> F::M {
        let blinn_phong = self.blinn_phong & F::splat(LEAST_EXPONENT).le(self.parameter) & F::splat(0.0).lt(self.share);
        if self.conductors.is_none() {
            return blinn_phong;
        }
        blinn_phong | (self.glossy & self.metal & self.parameter.le(F::splat(NARROWEST_ALPHA)))
    }

    /// A direction of the narrow lanes' glossy lobe alone, and its weight f cos / density.
    #[inline(always)]
    pub fn sample_narrow(&self, ns: V3<F>, wo: V3<F>, u: F, v: F) -> (V3<F>, V3<F>) {
        let c = F::splat;
        let (zero, one) = (c(0.0), c(1.0));
        let (wi, counted) = self.lobe().sample(ns, wo, u, v);
        let cos_i = ns.dot(wi);
        let lobes = self.lobes(ns, wo, wi, cos_i.max(zero));
        let usable = counted & zero.lt(cos_i) & zero.lt(lobes.glossy_pdf);
        let scale = F::select(usable, lobes.glossy * cos_i / F::select(usable, lobes.glossy_pdf, one), zero);
        let weight = self.color.scale(scale);
        let Some(table) = self.conductors else { return (wi, weight) };
        let metal = self.glossy & self.metal;
        if !metal.any() {
            return (wi, weight);
        }
        let conductor = self.conductor(table, metal);
        let of_metal = conductor.sample_visible(ns, wo, u, v);
        let of_lobe = conductor.visible_weight(ns, wo, of_metal);
        (V3::select(metal, of_metal, wi), V3::select(metal, of_lobe, weight))
    }

    /// The rough lanes as columns hold them; of metals [`Bsdf::colors`] belong to it.
    #[inline(always)]
    pub fn pack(&self) -> Packed<F> {
        let bits = F::U::splat;
        let glossy = F::U::select(self.conserving, bits(packed::CONSERVING), bits(packed::GLOSSY));
        let mut kind = F::U::select(self.blinn_phong, glossy, bits(0));
        if self.conductors.is_some() {
            let metal = F::U::select(self.tint.lanes, bits(packed::TINTED), bits(packed::METAL));
            kind = F::U::select(self.glossy & self.metal, metal, kind);
        }
        Packed { kind, numbers: [self.parameter, self.share] }
    }

    /// The colour and the tint of metals.
    #[inline(always)]
    pub fn colors(&self) -> [V3<F>; 2] {
        [self.color, self.tint.color]
    }

    /// Which of these kinds are glossy.
    #[inline(always)]
    pub fn packed_glossy(kind: F::U, lanes: F::M) -> F::M {
        lanes & !(kind & F::U::splat(packed::ALL)).eq(F::U::splat(0))
    }

    /// What was packed, with colour one.
    #[inline(always)]
    pub fn unpack(packed: Packed<F>, lanes: F::M) -> Self {
        let none = F::M::from_bits(0);
        let kind = packed.kind & F::U::splat(packed::ALL);
        let glossy = Self::packed_glossy(kind, lanes);
        let [parameter, share] = packed.numbers;
        Bsdf {
            color: V3::grey(F::splat(1.0)),
            diffuse: lanes & !glossy,
            glossy,
            mirror: none,
            transparent: none,
            parameter,
            share,
            tint: Tint::none(),
            blinn_phong: glossy,
            conserving: glossy & kind.eq(F::U::splat(packed::CONSERVING)),
            metal: none,
            conductors: None,
        }
    }

    /// What was unpacked, with the table of metals and their colours ([`Bsdf::colors`]), by the kinds that were packed.
    #[inline(always)]
    pub fn metals<'a>(self, table: &'a ConductorTable, kind: F::U, colors: [V3<F>; 2]) -> Bsdf<'a, F> {
        let kind = kind & F::U::splat(packed::ALL);
        let tinted = self.glossy & kind.eq(F::U::splat(packed::TINTED));
        let metal = tinted | self.glossy & kind.eq(F::U::splat(packed::METAL));
        Bsdf {
            color: V3::select(metal, colors[0], self.color),
            blinn_phong: self.blinn_phong & !metal,
            tint: Tint { color: colors[1], lanes: tinted },
            metal,
            conductors: Some(table),
            ..self
        }
    }
}

/// The lobes of a rough material at a pair of directions: f without colour, and the densities of their own samples.
struct Lobes<F: Lanes> {
    /// f of the Lambert lobe.
    lambert: F,
    /// Its density.
    lambert_pdf: F,
    /// f of the glossy lobe.
    glossy: F,
    /// Its density.
    glossy_pdf: F,
}

/// A sampled direction with f cos / pdf and its density.
pub struct RoughSample<F: Lanes> {
    /// Direction.
    pub wi: V3<F>,
    /// f cos / pdf.
    pub weight: V3<F>,
    /// Density; 0: no direction.
    pub pdf: F,
}

/// 2 pi, for densities of cones.
pub const TWO_PI: f32 = 2.0 * PI;

#[cfg(test)]
mod tests;
