//! The lobes of metals over lanes: GGX with Smith's height-correlated shadowing and masking (Walter et al. 2007; Heitz
//! 2014), and what is reflected several times (Kulla and Conty 2017), a lobe that is sampled with the probability
//! 1 - E(mu_o), by (1 - E(mu_i)) mu_i as it is: by mu_i alone a smooth metal had weights of a hundred at grazing
//! angles, where nearly all that it loses is.

use super::seen::{raised_cosine, seen};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::{V3, sincos_turns};
use crate::scene::{ConductorTable, GGX_STEPS};
use std::f32::consts::FRAC_1_PI;

/// Parameters of the metals' lanes.
#[derive(Clone, Copy)]
pub struct Conductor<F: Lanes> {
    /// Where it begins in the table of losses.
    losses: F::U,
    /// Where the next roughness begins there, of those that have several.
    more: F::U,
    /// How far it is from the one to the other.
    between: F,
    /// Width of the lobe.
    pub alpha: F,
    /// Lanes where Fresnel's equations hold; elsewhere the F82-tint model.
    exact: F::M,
    /// F0 of the tinted lanes.
    color: V3<F>,
    /// n, or the tint.
    n: V3<F>,
    k: V3<F>,
    /// F_avg where Fresnel's equations hold.
    average: V3<F>,
    /// E_avg.
    energy: F,
    /// 1 / (pi (1 - E_avg)), or zero.
    scale: F,
}

/// A tint that textures give.
#[derive(Clone, Copy)]
pub struct Tint<F: Lanes> {
    /// The tint.
    pub color: V3<F>,
    /// Lanes that have one; others have their metal's.
    pub lanes: F::M,
}

impl<F: Lanes> Tint<F> {
    /// No lane has one.
    #[inline(always)]
    pub fn none() -> Self {
        Tint { color: V3::zero(), lanes: F::M::from_bits(0) }
    }
}

impl<F: Lanes> Conductor<F> {
    /// Conductor `index` of the table with this width and these colours.
    #[inline(always)]
    pub fn new(table: &ConductorTable, index: F::U, alpha: F, color: V3<F>, tint: Tint<F>) -> Self {
        let zero = F::splat(0.0);
        let (mut index, mut next, mut between) = (index, index, zero);
        if !table.several.is_empty() {
            let several = F::U::gather(&table.several, index).eq(F::U::splat(1));
            let place = alpha.sqrt() * F::splat((GGX_STEPS - 1) as f32);
            let low = place.min(F::splat((GGX_STEPS - 2) as f32)).to_int();
            between = F::select(several, place - F::from_int(low), zero);
            index = F::U::select(several, index + low, index);
            next = F::U::select(several, index + F::U::splat(1), index);
        }
        let [_, exact, n0, n1, n2, k0, k1, k2, f0, f1, f2, energy, scale] = table.rows.row::<F>(index);
        let steps = F::U::splat(GGX_STEPS as u32);
        let mut conductor = Conductor {
            losses: index * steps,
            more: next * steps,
            between,
            alpha,
            exact: F::splat(0.5).lt(exact),
            color,
            n: V3::select(tint.lanes, tint.color, V3(n0, n1, n2)),
            k: V3(k0, k1, k2),
            average: V3(f0, f1, f2),
            energy,
            scale,
        };
        if !table.several.is_empty() {
            conductor.reckon_between(table, next);
        }
        conductor
    }

    /// What lies between this row and the next one.
    #[inline(always)]
    fn reckon_between(&mut self, table: &ConductorTable, next: F::U) {
        let c = F::splat;
        let (zero, one) = (c(0.0), c(1.0));
        let (energy, scale) = (table.rows.column::<F>(next, 11), table.rows.column::<F>(next, 12));
        // 1 - E_avg, by 1 / (pi (1 - E_avg)) where that is there: E_avg may be near one.
        let (here, there) = (zero.lt(self.scale), zero.lt(scale));
        let left = F::select(here, c(FRAC_1_PI) / F::select(here, self.scale, one), one - self.energy);
        let next = F::select(there, c(FRAC_1_PI) / F::select(there, scale, one), one - energy);
        let left = (next - left).fma(self.between, left);
        self.energy = (energy - self.energy).fma(self.between, self.energy);
        let usable = zero.lt(scale) & c(1e-6).lt(left);
        let reckoned = F::select(usable, c(FRAC_1_PI) / F::select(usable, left, one), zero);
        self.scale = F::select(zero.lt(self.between), reckoned, self.scale);
    }

    /// Reflectance of a flat surface at a cosine from 0 to 1.
    #[inline(always)]
    pub fn fresnel(&self, cos: F) -> V3<F> {
        let cos = cos.max(F::splat(0.0)).min(F::splat(1.0));
        V3(
            self.channel(cos, self.color.0, self.n.0, self.k.0),
            self.channel(cos, self.color.1, self.n.1, self.k.1),
            self.channel(cos, self.color.2, self.n.2, self.k.2),
        )
    }

    #[inline(always)]
    fn channel(&self, cos: F, f0: F, n: F, k: F) -> F {
        F::select(self.exact, exact(n, k, cos), tinted(f0, n, cos))
    }

    /// F_ms of one channel.
    #[inline(always)]
    fn several(&self, f0: F, tint: F, average: F) -> F {
        let c = F::splat;
        let one = c(1.0);
        // The mean of c (1 - c)^5 and c (1 - c)^6 over the hemisphere, 2 integral .. c dc: 1/21 and 1/126.
        let of_tinted = (one - f0).fma(c(1.0 / 21.0), f0) - edge(f0, tint) * c(1.0 / 126.0);
        let f = F::select(self.exact, average, of_tinted);
        f * f * self.energy / (one - f * (one - self.energy))
    }

    /// 1 - E at a cosine, and the step that begins below it.
    #[inline(always)]
    fn loss(&self, table: &ConductorTable, cos: F) -> (F, F::U) {
        let c = F::splat;
        let place = cos.max(c(0.0)).min(c(1.0)).sqrt() * c((GGX_STEPS - 1) as f32);
        let low = place.min(c((GGX_STEPS - 2) as f32)).to_int();
        let (here, next) = (self.at(table, &table.losses, low), self.at(table, &table.losses, low + F::U::splat(1)));
        ((next - here).fma(place - F::from_int(low), here), low)
    }

    /// Number `step` of the row of one of the tables by cosine, or between those of two rows.
    #[inline(always)]
    fn at(&self, table: &ConductorTable, of: &[f32], step: F::U) -> F {
        let here = F::gather(of, self.losses + step);
        if table.several.is_empty() {
            return here;
        }
        (F::gather(of, self.more + step) - here).fma(self.between, here)
    }

    /// The density of a direction of the lobe of several reflections, over that of a cosine-weighted one: the same in
    /// all of a step of the table.
    #[inline(always)]
    fn crowding(&self, table: &ConductorTable, step: F::U) -> F {
        let (from, to) = (squares::<F>(step), squares::<F>(step + F::U::splat(1)));
        let within = self.at(table, &table.sums, step + F::U::splat(1)) - self.at(table, &table.sums, step);
        let all = self.at(table, &table.sums, F::U::splat(GGX_STEPS as u32 - 1));
        within / ((to - from) * all.max(F::splat(1e-30)))
    }

    /// A direction of the lobe of several reflections: a step by its share of what is lost, by a number from 0 to 1,
    /// and cosine-weighted within it.
    #[inline(always)]
    fn sample_several(&self, table: &ConductorTable, ns: V3<F>, u: F, v: F, number: F) -> V3<F> {
        let one = F::splat(1.0);
        let aim = number * self.at(table, &table.sums, F::U::splat(GGX_STEPS as u32 - 1));
        let mut step = F::U::splat(0);
        for width in [16, 8, 4, 2, 1] {
            let next = step + F::U::splat(width);
            let is_there = next.lt(F::U::splat(GGX_STEPS as u32 - 1));
            let next = F::U::select(is_there, next, step);
            step = F::U::select(self.at(table, &table.sums, next).le(aim), next, step);
        }
        let (from, to) = (squares::<F>(step), squares::<F>(step + F::U::splat(1)));
        let cos2 = (to - from).fma(u, from).min(one);
        let (sin, cos) = sincos_turns(v);
        let radius = (one - cos2).sqrt();
        ns.to_world(V3(radius * cos, radius * sin, cos2.sqrt()))
    }

    /// f times the cosine of wi to the normal that is seen over that to `ns`, which is what callers multiply by, and
    /// the density of [`Conductor::sample`]. Both cosines are more than zero, elsewhere the density is zero.
    #[inline(always)]
    pub fn evaluate(&self, table: &ConductorTable, ns: V3<F>, wo: V3<F>, wi: V3<F>) -> (V3<F>, F) {
        let c = F::splat;
        let (zero, one) = (c(0.0), c(1.0));
        let by_callers = ns.dot(wi);
        let (ns, raised) = seen(ns, wo);
        let (cos_o, cos_i) = (ns.dot(wo), ns.dot(wi));
        let above = zero.lt(cos_o) & zero.lt(cos_i);
        let (cos_o, cos_i) = (cos_o.max(c(1e-7)), cos_i.max(c(1e-7)));
        let h = wo.add(wi);
        let h2 = h.dot(h).max(c(1e-30));
        let side = ns.cross(h);
        // D by the half vector's squared sine, which keeps its digits where the lobe is narrow.
        let sin2 = (side.dot(side) / h2).min(one);
        let alpha2 = self.alpha * self.alpha;
        let spread = (one - sin2).fma(alpha2, sin2);
        let d = alpha2 * c(FRAC_1_PI) / (spread * spread);
        let root_o = ((one - alpha2) * cos_o).fma(cos_o, alpha2).sqrt();
        let root_i = ((one - alpha2) * cos_i).fma(cos_i, alpha2).sqrt();
        // D G2 / (4 cos_i cos_o), and D G1(o) / (4 cos_o), the density of the half vector's visible normals over 4
        // wo.h.
        let once = d * c(0.5) / cos_o.fma(root_i, cos_i * root_o);
        let visible = d * c(0.5) / (cos_o + root_o);
        let mut f = self.fresnel(h2.sqrt() * c(0.5)).scale(once);
        let mut pdf = visible;
        if zero.lt(self.scale).any() {
            let ((loss_o, _), (loss_i, step)) = (self.loss(table, cos_o), self.loss(table, cos_i));
            let (n, color, average) = (self.n, self.color, self.average);
            let several = V3(
                self.several(color.0, n.0, average.0),
                self.several(color.1, n.1, average.1),
                self.several(color.2, n.2, average.2),
            );
            f = f.add(several.scale(loss_o * loss_i * self.scale));
            let p = F::select(zero.lt(self.scale), loss_o, zero);
            pdf = p.fma(self.crowding(table, step) * cos_i * c(FRAC_1_PI), (one - p) * visible);
        }
        if raised.any() {
            f = f.scale(raised_cosine(raised, cos_i, by_callers));
        }
        (V3::select(above, f, V3::grey(zero)), F::select(above, pdf, zero))
    }

    /// A direction: wo reflected in one of the normals that it sees (Dupuy and Benyoub 2023, algorithm 3), or of the
    /// lobe of several reflections where `lobe` is below the probability of that.
    #[inline(always)]
    pub fn sample(&self, table: &ConductorTable, ns: V3<F>, wo: V3<F>, u: F, v: F, lobe: F) -> V3<F> {
        let (zero, one) = (F::splat(0.0), F::splat(1.0));
        let reflected = self.sample_visible(ns, wo, u, v);
        let (ns, _) = seen(ns, wo);
        let p = F::select(zero.lt(self.scale), self.loss(table, ns.dot(wo)).0, zero);
        let several = lobe.lt(p);
        if !several.any() {
            return reflected;
        }
        let number = lobe / F::select(several, p, one);
        V3::select(several, self.sample_several(table, ns, u, v, number), reflected)
    }

    /// wo reflected in one of the normals that it sees.
    #[inline(always)]
    pub fn sample_visible(&self, ns: V3<F>, wo: V3<F>, u: F, v: F) -> V3<F> {
        let c = F::splat;
        let (zero, one) = (c(0.0), c(1.0));
        let (ns, _) = seen(ns, wo);
        let (t, b) = ns.basis();
        let z = wo.dot(ns).max(zero);
        // Stretched so that the lobe is a hemisphere.
        let stretched = V3(wo.dot(t) * self.alpha, wo.dot(b) * self.alpha, z);
        let stretched = stretched.scale(one / stretched.dot(stretched).max(c(1e-30)).sqrt());
        // A point of the cap of directions whose sum with it points up.
        let (sin, cos) = sincos_turns(v);
        let height = one - u * (one + stretched.2);
        let radius = (one - height * height).max(zero).sqrt();
        let h = V3(radius * cos, radius * sin, height).add(stretched);
        let h = V3(h.0 * self.alpha, h.1 * self.alpha, h.2.max(zero));
        let h = h.scale(one / h.dot(h).max(c(1e-30)).sqrt());
        let h = t.mad(h.0, b.mad(h.1, ns.scale(h.2)));
        let d = wo.dot(h);
        h.scale(d + d).sub(wo)
    }

    /// G2/G1 F of a direction of [`Conductor::sample_visible`]: f cos / density of the single reflection.
    #[inline(always)]
    pub fn visible_weight(&self, ns: V3<F>, wo: V3<F>, wi: V3<F>) -> V3<F> {
        let c = F::splat;
        let (zero, one) = (c(0.0), c(1.0));
        let (ns, _) = seen(ns, wo);
        let (cos_o, cos_i) = (ns.dot(wo), ns.dot(wi));
        let above = zero.lt(cos_o) & zero.lt(cos_i);
        let (cos_o, cos_i) = (cos_o.max(c(1e-7)), cos_i.max(c(1e-7)));
        let alpha2 = self.alpha * self.alpha;
        let root_o = ((one - alpha2) * cos_o).fma(cos_o, alpha2).sqrt();
        let root_i = ((one - alpha2) * cos_i).fma(cos_i, alpha2).sqrt();
        let share = cos_i * (cos_o + root_o) / cos_o.fma(root_i, cos_i * root_o);
        let h = wo.add(wi);
        let weight = self.fresnel(h.dot(h).sqrt() * c(0.5)).scale(share);
        V3::select(above, weight, V3::grey(zero))
    }
}

/// The squared cosine at which a step of the tables begins.
#[inline(always)]
fn squares<F: Lanes>(step: F::U) -> F {
    let root = F::from_int(step) * F::splat(1.0 / (GGX_STEPS - 1) as f32);
    let cos = root * root;
    cos * cos
}

/// b of the F82-tint model.
#[inline(always)]
fn edge<F: Lanes>(f0: F, tint: F) -> F {
    let c = F::splat;
    // Schlick's reflectance at c = 1/7, and c (1 - c)^6 there.
    const FIFTH: f32 = (6.0 / 7.0) * (6.0 / 7.0) * (6.0 / 7.0) * (6.0 / 7.0) * (6.0 / 7.0);
    let schlick = (c(1.0) - f0).fma(c(FIFTH), f0);
    schlick * (c(1.0) - tint) * c(7.0 / (FIFTH * (6.0 / 7.0)))
}

/// The F82-tint model of one channel.
#[inline(always)]
fn tinted<F: Lanes>(f0: F, tint: F, cos: F) -> F {
    let one = F::splat(1.0);
    let x = one - cos;
    let x2 = x * x;
    let fifth = x2 * x2 * x;
    ((one - f0).fma(fifth, f0) - edge(f0, tint) * cos * fifth * x).max(F::splat(0.0)).min(one)
}

/// Fresnel's equations for unpolarised light, n and k of one channel (Born and Wolf, 14.4).
#[inline(always)]
fn exact<F: Lanes>(n: F, k: F, cos: F) -> F {
    let c = F::splat;
    let (zero, one) = (c(0.0), c(1.0));
    let (n2, k2, c2) = (n * n, k * k, cos * cos);
    let s2 = one - c2;
    let t0 = n2 - k2 - s2;
    let a2_b2 = t0.fma(t0, c(4.0) * n2 * k2).sqrt();
    let a = (c(0.5) * (a2_b2 + t0)).max(zero).sqrt();
    let (t1, t2) = (a2_b2 + c2, (cos + cos) * a);
    let rs = (t1 - t2) / (t1 + t2);
    let (t3, t4) = (c2.fma(a2_b2, s2 * s2), t2 * s2);
    c(0.5) * rs * (one + (t3 - t4) / (t3 + t4))
}

#[cfg(test)]
mod tests;
