//! What a vertex has to do with other pixels' paths, and with rays aimed from it.

use super::Stage;
use super::vertex::{Vertex, has};
use crate::engine::batch::{BRANCHING, LATE_AIMS, Members, Paths, Suffixes, path};
use crate::engine::stages::aim;
use crate::engine::stages::share::{add_members, add_suffixes};
use crate::lanes::{Bits, Lanes, Mask};
use crate::math::V3;

impl<F: Lanes> Stage<'_, F> {
    /// Weighs what own and aimed rays both find: mirrors, glass and glossy surfaces. What an aimed ray finds else, its
    /// path's own ray finds.
    #[inline(always)]
    pub fn weigh_aimed(&self, at: &mut Vertex<'_, F>, aimed: F::M, paths: &Paths) {
        let Some(guide) = self.pass.guide.filter(|_| self.vertex > 0) else { return };
        at.surfaces = at.surfaces & !(aimed & at.bsdf.diffuse);
        at.bsdf.diffuse = at.bsdf.diffuse & at.surfaces;
        let ray = &mut at.ray;
        let both_find = at.surfaces & !at.bsdf.diffuse & has(ray.slot, path::AIMS);
        ray.slot = ray.slot & F::U::splat(!(path::AIMED | path::AIMS));
        if both_find.any() {
            let by_itself = F::load(&paths.pdf[ray.first..]);
            let normal = V3::<F>::load(&paths.normal, ray.first);
            let from = aim::From { p: ray.origin, n: normal, shared: aim::is_shared::<F>(ray.slot) };
            let by_aiming = aim::density(guide, from, ray.direction, both_find);
            let weight = by_itself / (by_itself + by_aiming);
            // Not in the throughput: roulette would undo it.
            ray.eta2 = F::select(both_find, ray.eta2 * weight, ray.eta2);
            let seen = at.film * normal.dot(ray.direction) / (by_itself + by_aiming);
            at.film = F::select(both_find, seen, at.film);
        }
    }

    /// Second vertices: light leaves a diffuse one alike in all directions, so what comes from here on is any member's,
    /// and the path carries it anew.
    #[inline(always)]
    pub fn leave_suffixes(&self, at: &mut Vertex<'_, F>, suffixes: &mut Suffixes) {
        if !self.pass.reuse || self.vertex == 0 {
            return;
        }
        let found = at.surfaces & has(at.ray.slot, path::MAKER);
        let shared = found & at.bsdf.diffuse;
        if shared.any() {
            let one = F::splat(1.0);
            add_suffixes(suffixes, at, shared);
            at.ray.throughput = V3::select(shared, V3::grey(one), at.ray.throughput);
            at.ray.eta2 = F::select(shared, one, at.ray.eta2);
        }
        let bare = at.ray.slot & F::U::splat(path::SLOT | path::LATES);
        let own = F::U::select(shared, bare | F::U::splat(path::SHARED), bare | F::U::splat(path::OWN));
        at.ray.slot = F::U::select(found, own, at.ray.slot);
    }

    /// Lanes that share what they find: first vertices of items that do.
    #[inline(always)]
    pub fn members(&self, at: &Vertex<'_, F>, item_shares: &[u32]) -> F::M {
        // A member's second vertex needs a scattering of its own.
        if !self.pass.reuse || self.vertex >= self.scene.max_bounces {
            return F::M::from_bits(0);
        }
        let fresh = (at.ray.slot & F::U::splat(!path::SLOT)).eq(F::U::splat(0));
        let shares = !F::U::gather(item_shares, at.ray.item()).eq(F::U::splat(0));
        at.surfaces & at.bsdf.has_one_color() & fresh & shares & F::splat(0.0).lt(at.colored().max_component())
    }

    /// Adds the lanes that share to the members, with the chance that their own paths go on, and says of all paths
    /// whose light they carry from here on.
    #[inline(always)]
    pub fn join(&self, at: &mut Vertex<'_, F>, lanes: F::M, survival: F, members: &mut Members) {
        if lanes.any() {
            add_members(members, at, at.colored().scale(at.ray.eta2), survival, lanes);
            at.ray.slot = F::U::select(lanes, at.ray.slot | F::U::splat(path::MAKER), at.ray.slot);
        }
        let slot = at.ray.slot;
        let untouched = at.bsdf.rough() & !has(slot, path::SHARED | path::MAKER | path::OWN);
        at.ray.slot = F::U::select(untouched, slot | F::U::splat(path::OWN), slot);
    }

    /// Lanes that rays may be aimed from.
    #[inline(always)]
    pub fn aims(&self, at: &Vertex<'_, F>) -> F::M {
        // What a ray aimed from the last vertex met could not scatter.
        if self.pass.guide.is_none() || self.vertex >= self.scene.max_bounces {
            return F::M::from_bits(0);
        }
        let aims = at.surfaces & at.bsdf.rough() & F::splat(0.0).lt(at.colored().max_component());
        if self.vertex < BRANCHING {
            return aims;
        }
        aims & (at.ray.slot & F::U::splat(path::LATES)).lt(F::U::splat(LATE_AIMS * path::LATE))
    }

    /// Adds those that rays may be aimed from to `aimers`.
    #[inline(always)]
    pub fn leave_aimers(&self, at: &mut Vertex<'_, F>, aimers: &mut Members) {
        if self.pass.guide.is_none() || self.vertex >= self.scene.max_bounces {
            return;
        }
        let aims = self.aims(at);
        let mut carried = at.colored();
        let metals = self.scene.tables.materials.conductors.is_some();
        if metals {
            carried = V3::select(at.bsdf.has_one_color(), carried, at.ray.throughput);
        }
        if self.vertex >= BRANCHING {
            let slot = at.ray.slot;
            at.ray.slot = F::U::select(aims, slot + F::U::splat(path::LATE), slot);
        }
        at.film.compress(aims, &mut aimers.film[aimers.len..]);
        if metals {
            let k = aimers.len;
            let colors = at.bsdf.colors();
            (0..2).for_each(|of| colors[of].compress(aims, &mut aimers.colors[of], k));
        }
        add_members(aimers, at, carried, at.ray.eta2, aims);
        at.ray.slot = F::U::select(aims, at.ray.slot | F::U::splat(path::AIMS), at.ray.slot);
    }
}
