//! Scattering, over lanes. wo points to the viewer, wi to the light, both unit and away from the surface; `f` has no cosine;
//! densities are in solid angle. Mirror and transparent surfaces are delta lobes: sampled only.

use super::patterns::pattern_color;
use super::surface::Surface;
use super::textures::texture_color;
use crate::engine::guide::casters::LEAST_EXPONENT;
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::{V3, exp, ln1p};
use crate::sampling::warp;
use crate::scene::{MaterialTable, Tables, kind};
use std::f32::consts::{FRAC_1_PI, PI};

/// The parameters of a material, gathered, and which kind it is.
#[derive(Clone, Copy)]
pub struct Bsdf<F: Lanes> {
    /// Albedo, reflectance or transmittance.
    pub color: V3<F>,
    /// Index of refraction, or alpha.
    pub parameter: F,
    /// s.
    pub specular: F,
    /// Lambert.
    pub diffuse: F::M,
    /// Mirror.
    pub mirror: F::M,
    /// Smooth dielectric.
    pub transparent: F::M,
    /// Blinn-Phong, both kinds.
    pub glossy: F::M,
    /// Blinn-Phong with the energy-conserving lobe.
    pub conserving: F::M,
}

impl<F: Lanes> Bsdf<F> {
    /// Looks the material up, and its texture + 1, or 0; all masks are within `valid`.
    #[inline(always)]
    fn new(table: &MaterialTable, material: F::U, valid: F::M) -> (Self, F::U) {
        let none = F::M::from_bits(0);
        let [red, green, blue, kind, texture] = table.rows.row::<F>(material);
        let kind = kind.to_bits();
        let is = |k: u32| if table.kinds >> k & 1 == 1 { valid & kind.eq(F::U::splat(k)) } else { none };
        let (transparent, conserving) = (is(kind::TRANSPARENT), is(kind::BLINN_PHONG_CONSERVING));
        let glossy = is(kind::BLINN_PHONG) | conserving;
        let (mut parameter, mut specular) = (F::splat(1.0), F::splat(0.0));
        if (transparent | glossy).any() {
            [parameter, specular] = table.parameters.row::<F>(material);
        }
        let bsdf = Bsdf {
            color: V3(red, green, blue),
            parameter,
            specular,
            diffuse: is(kind::DIFFUSE),
            mirror: is(kind::MIRROR),
            transparent,
            glossy,
            conserving,
        };
        (bsdf, texture.to_bits())
    }

    /// The material of a surface, its texture looked up.
    #[inline(always)]
    pub fn at(tables: &Tables, s: &Surface<F>, valid: F::M) -> Self {
        let (mut bsdf, texture) = Bsdf::<F>::new(&tables.materials, s.material, valid);
        if tables.materials.textured {
            let mut textured = valid & !texture.eq(F::U::splat(0));
            if !tables.patterns.patterns.is_empty() {
                // Patterns are numbered behind the pictures.
                let pattern = F::U::splat(tables.materials.first_pattern);
                let reckoned = textured & pattern.lt(texture);
                if reckoned.any() {
                    let id = texture - F::U::splat(1) - pattern;
                    let color = pattern_color(&tables.patterns, id, s, reckoned);
                    bsdf.color = V3::select(reckoned, color, bsdf.color);
                }
                textured = textured & !reckoned;
            }
            if textured.any() {
                let texel = texture_color(&tables.textures, texture - F::U::splat(1), s.u, s.v, textured);
                bsdf.color = V3::select(textured, texel, bsdf.color);
            }
        }
        bsdf
    }

    /// Probability that the glossy lobe is sampled: its share of the reflected light at normal incidence, where the report's
    /// formula with its half-vector lobe reflects 4 s.
    #[inline(always)]
    pub fn glossy_probability(&self) -> F {
        let s = F::select(self.conserving, self.specular, self.specular * F::splat(4.0));
        s / (s + (F::splat(1.0) - self.specular))
    }

    /// Both lobes at a pair of directions, for the diffuse and glossy lanes; `cos_i` is ns.wi > 0.
    #[inline(always)]
    pub fn lobes(&self, ns: V3<F>, wo: V3<F>, wi: V3<F>, cos_i: F) -> Lobes<F> {
        let c = F::splat;
        let none = c(0.0);
        let mut lobes =
            Lobes { lambert: c(FRAC_1_PI), lambert_pdf: cos_i * c(FRAC_1_PI), glossy: none, glossy_pdf: none };
        if self.glossy.any() {
            let (alpha, s) = (self.parameter, self.specular);
            let h = wo.add(wi);
            let h2 = h.dot(h).max(c(1e-30));
            let side = ns.cross(h);
            // cos^alpha from sin^2, which keeps its digits where the lobe is narrow: (1 - sin^2)^(alpha/2).
            let sin2 = (side.dot(side) / h2).min(c(0.999_999_9));
            let above = none.lt(ns.dot(h));
            let lobe = F::select(above, exp(ln1p(-sin2) * (alpha * c(0.5))), none);
            // wo.h = |wo + wi| / 2 for unit vectors.
            let wo_h = (h2.sqrt() * c(0.5)).max(c(1e-15));
            let cos_o = ns.dot(wo);
            let widest = cos_i.max(cos_o).max(c(1e-7));
            let report = lobe * ((alpha + c(2.0)) * c(0.5 * FRAC_1_PI));
            let conserving = lobe * ((alpha + c(1.0)) * c(0.125 * FRAC_1_PI)) / (wo_h * widest);
            lobes.glossy = F::select(self.glossy, s * F::select(self.conserving, conserving, report), none);
            lobes.glossy_pdf = F::select(self.glossy, lobe * ((alpha + c(1.0)) * c(0.125 * FRAC_1_PI)) / wo_h, none);
            lobes.lambert = F::select(self.glossy, (c(1.0) - s) * lobes.lambert, lobes.lambert);
        }
        lobes
    }

    /// f and the density with which [`Bsdf::sample_rough`] takes wi, for the diffuse and glossy lanes; `cos_i` is ns.wi > 0.
    #[inline(always)]
    pub fn evaluate(&self, ns: V3<F>, wo: V3<F>, wi: V3<F>, cos_i: F) -> (V3<F>, F) {
        self.both(&self.lobes(ns, wo, wi, cos_i))
    }

    /// f and density of the lobes together.
    #[inline(always)]
    pub fn both(&self, lobes: &Lobes<F>) -> (V3<F>, F) {
        if !self.glossy.any() {
            return (self.color.scale(lobes.lambert), lobes.lambert_pdf);
        }
        let p = self.glossy_probability();
        let mixed = p.fma(lobes.glossy_pdf, (F::splat(1.0) - p) * lobes.lambert_pdf);
        let pdf = F::select(self.glossy, mixed, lobes.lambert_pdf);
        (self.color.scale(lobes.lambert + lobes.glossy), pdf)
    }

    /// A direction for the diffuse and glossy lanes: cosine-weighted, or the reflection in a half vector of the lobe. The weight
    /// f cos / pdf and the density are those of both lobes together; the density is 0 where sampling failed.
    #[inline(always)]
    pub fn sample_rough(&self, ns: V3<F>, wo: V3<F>, u: F, v: F, lobe: F) -> RoughSample<F> {
        let c = F::splat;
        let local = warp::cosine_hemisphere(u, v);
        let mut wi = ns.to_world(local);
        let mut weight = self.color;
        let mut pdf = local.2 * c(FRAC_1_PI);
        if self.glossy.any() {
            let p = self.glossy_probability();
            let from_lobe = self.glossy & lobe.lt(p);
            if from_lobe.any() {
                wi = V3::select(from_lobe, self.reflect_in_lobe(ns, wo, u, v), wi);
            }
            let cos_i = ns.dot(wi);
            let lobes = self.lobes(ns, wo, wi, cos_i.max(c(0.0)));
            let value = lobes.lambert + lobes.glossy;
            let density = p.fma(lobes.glossy_pdf, (c(1.0) - p) * lobes.lambert_pdf);
            let usable = c(0.0).lt(cos_i) & c(0.0).lt(density);
            let scale = F::select(usable, value * cos_i / F::select(usable, density, c(1.0)), c(0.0));
            weight = V3::select(self.glossy, self.color.scale(scale), weight);
            pdf = F::select(self.glossy, F::select(usable, density, c(0.0)), pdf);
        }
        RoughSample { wi, weight, pdf }
    }

    /// wo reflected in a half vector of the glossy lobe.
    #[inline(always)]
    pub fn reflect_in_lobe(&self, ns: V3<F>, wo: V3<F>, u: F, v: F) -> V3<F> {
        let h = ns.to_world(warp::power_cosine(u, v, self.parameter));
        let d = wo.dot(h);
        h.scale(d + d).sub(wo)
    }

    /// Glossy lanes whose lobe is so narrow that photons go on by it (see `engine::guide`).
    #[inline(always)]
    pub fn narrow(&self) -> F::M {
        self.glossy & F::splat(LEAST_EXPONENT).le(self.parameter)
    }
}

/// The lobes of a rough material at a pair of directions: f without colour, and the densities of their own samples.
pub struct Lobes<F: Lanes> {
    /// f of the Lambert lobe.
    pub lambert: F,
    /// Its density.
    pub lambert_pdf: F,
    /// f of the glossy lobe.
    pub glossy: F,
    /// Its density.
    pub glossy_pdf: F,
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

/// wo reflected in the shading normal, bent so that it leaves the geometric surface: where it would start inside, the reflected
/// direction is raised to just above the surface (the bend-normal rule of Keller et al., The Iray Light Transport Simulation
/// and Rendering System, 2017, A.3). Gives the direction and the normal that makes it.
#[inline(always)]
pub fn reflect_bent<F: Lanes>(s: &Surface<F>, wo: V3<F>) -> (V3<F>, V3<F>) {
    let c = F::splat;
    let d = wo.dot(s.ns);
    let r = s.ns.scale(d + d).sub(wo);
    let mut normal = s.ns;
    let mut direction = r;
    if s.smooth.any() {
        let height = r.dot(s.ng);
        let least = (wo.dot(s.ng) * c(0.9)).min(c(0.01));
        let low = s.smooth & height.lt(least);
        let raised = s.ng.mad(least - height, r).normalise();
        direction = V3::select(low, raised, r);
        let bent = wo.add(raised);
        let length2 = bent.dot(bent).max(c(1e-30));
        normal = V3::select(low, bent.scale(c(1.0) / length2.sqrt()), s.ns);
    }
    (direction, normal)
}

/// What a smooth dielectric does with wo: its two lobes.
pub struct Dielectric<F: Lanes> {
    /// Where it reflects to.
    pub reflected: V3<F>,
    /// Where it lets pass to; where `reflectance` is 1 this means nothing.
    pub passed: V3<F>,
    /// Share that it reflects.
    pub reflectance: F,
    /// Radiance scaling of what passes: (n_i / n_t)^2.
    pub eta2: F,
}

/// A direction of a smooth dielectric.
pub struct DielectricSample<F: Lanes> {
    /// Direction.
    pub wi: V3<F>,
    /// It passes the surface.
    pub refracted: F::M,
    /// Radiance scaling (n_i / n_t)^2 where refracted, else 1.
    pub eta2: F,
}

impl<F: Lanes> Dielectric<F> {
    /// `ior` is the inside's against the outside's.
    #[inline(always)]
    pub fn new(s: &Surface<F>, wo: V3<F>, ior: F) -> Self {
        let c = F::splat;
        let one = c(1.0);
        let (mut reflected, mut normal) = reflect_bent(s, wo);
        // n_incident / n_transmitted.
        let eta = F::select(s.outside, one / ior, ior);
        if s.smooth.any() {
            // From within, where the interpolated normal reflects totally but the triangle's own lets light out, the latter decides:
            // else rays that entered close to the outline of a low-poly body run round under its surface for ever, and its rim is dark.
            let cos_g = wo.dot(s.ng);
            let total = one.le(refract(wo, normal, eta).sin2_t);
            let caught = s.smooth & !s.outside & total & refract(wo, s.ng, eta).sin2_t.lt(one);
            reflected = V3::select(caught, s.ng.scale(cos_g + cos_g).sub(wo), reflected);
            normal = V3::select(caught, s.ng, normal);
        }
        let r = refract(wo, normal, eta);
        let mut passed = r.direction;
        let reflectance = F::select(r.sin2_t.lt(one), fresnel(r.cos_i, r.cos_t, eta), one);
        if s.smooth.any() {
            // A refracted ray that would stay on the viewer's side takes the geometric normal.
            let wrong = s.smooth & c(-1e-3).lt(passed.dot(s.ng));
            let geometric = refract(wo, s.ng, eta);
            passed = V3::select(wrong & geometric.sin2_t.lt(one), geometric.direction, passed);
        }
        let reflectance = F::select(passed.dot(s.ng).lt(c(0.0)), reflectance, one);
        Dielectric { reflected, passed: passed.normalise(), reflectance, eta2: eta * eta }
    }

    /// One of the two.
    #[inline(always)]
    pub fn take(&self, refracted: F::M) -> DielectricSample<F> {
        DielectricSample {
            wi: V3::select(refracted, self.passed, self.reflected),
            refracted,
            eta2: F::select(refracted, self.eta2, F::splat(1.0)),
        }
    }

    /// Reflection with the reflectance as probability, else refraction.
    #[inline(always)]
    pub fn sample(&self, lobe: F) -> DielectricSample<F> {
        self.take(self.reflectance.le(lobe))
    }
}

/// wo refracted in a plane; where sin2_t reaches 1, all is reflected and `direction` means nothing.
#[derive(Clone, Copy)]
struct Refraction<F: Lanes> {
    direction: V3<F>,
    cos_i: F,
    cos_t: F,
    sin2_t: F,
}

/// Snell's law; `eta` = n_incident / n_transmitted.
#[inline(always)]
fn refract<F: Lanes>(wo: V3<F>, n: V3<F>, eta: F) -> Refraction<F> {
    let (zero, one) = (F::splat(0.0), F::splat(1.0));
    let cos_i = wo.dot(n);
    let sin2_t = eta * eta * (one - cos_i * cos_i).max(zero);
    let cos_t = (one - sin2_t).max(zero).sqrt();
    Refraction { direction: n.mad(eta * cos_i - cos_t, wo.scale(-eta)), cos_i, cos_t, sin2_t }
}

/// Fresnel reflectance of unpolarised light; `eta` = n_incident / n_transmitted.
#[inline(always)]
pub fn fresnel<F: Lanes>(cos_i: F, cos_t: F, eta: F) -> F {
    let (a, b) = (eta * cos_i, eta * cos_t);
    let rs = (a - cos_t) / (a + cos_t);
    let rp = (cos_i - b) / (cos_i + b);
    rs.fma(rs, rp * rp) * F::splat(0.5)
}

/// 2 pi, for densities of cones.
pub const TWO_PI: f32 = 2.0 * PI;

#[cfg(test)]
mod tests;
