//! Coherent rays, sixteen together.
//!
//! Camera rays of neighbouring pixels, and shadow rays from neighbouring points to a small light, visit nearly the same
//! nodes. A packet visits a node once: its beam is tested against the eight boxes together, and only children that the
//! beam is in are tested against all sixteen rays. A leaf's triangles are tested one by one against sixteen rays, or,
//! where few rays get there, all four against one ray at a time.
//!
//! The batch decides by itself. Sixteen rays that turn out not to go the same way are traced as incoherent ones. And
//! each packet counts what it cost against what its rays would have cost one by one: where it does not pay (triangles
//! smaller than the gaps between the rays), the next rays go one by one, and after a while a packet is tried again.

use super::super::geometry::NONE;
use super::super::layout::{Node, Parts4, Ref, Shape, Spheres4, Triangles4};
use super::interleaved::{item, prefetch};
use super::isa::{Isa16, Lanes, WordLanes};
use super::leaves::{LeafHits, PaddedBoxes, padded_boxes, parts4, places_of, shape, spheres4, triangles4};
use super::packet_space::PacketSpace;
use super::query::{Batch, Goal, TreeView, WORLD};
use super::{Counters, STACK};
use std::ops::Range;

/// Leaves are tested ray by ray for at most this many rays.
const FEW: u32 = 3;
/// What a packet's visit costs, in visits of one ray among those in flight (some 38 cycles on Zen 4): of a tree in the
/// caches, and of one that is not, whose misses a packet waits for.
const NEAR_COST: u32 = 3;
const FAR_COST: u32 = 6;
/// Trees of more bytes than this are taken to be beyond the caches.
const NEAR_BYTES: usize = 16 << 20;
/// How many groups of rays go one by one after a packet that did not pay: at first, and at most.
const FIRST_PAUSE: u32 = 1;
const LONGEST_PAUSE: u32 = 64;
/// Fewer rays than this are not made a packet.
const SMALLEST: usize = 4;
/// Rays put aside until they are traced as incoherent ones.
const ASIDE: usize = 512;

/// Something to visit: what, by which rays, and a lower bound on where they enter it.
#[derive(Clone, Copy)]
struct Entry {
    reference: u32,
    lanes: u32,
    distance: f32,
}

struct Packet<'a, 'b, I> {
    isa: I,
    tree: &'a TreeView<'b>,
    batch: Batch<'a>,
    /// The rays' indices; lanes beyond it are not in use.
    rays: &'a [u32],
    /// The world, and the object space of the instance that the packet is in.
    spaces: [PacketSpace; 2],
    in_object: bool,
    inside: u32,
    t: Lanes,
    /// The greatest of them among the rays alive, and whether they have changed since it was found.
    greatest_t: f32,
    moved: bool,
    primitive: WordLanes,
    instance: WordLanes,
    from: WordLanes,
    target: WordLanes,
    found: u32,
    /// Rays that still look for something.
    alive: u32,
    /// What the packet's visits have cost, and what they would have cost one by one.
    cost: u32,
    saved: u32,
    height: usize,
    stack: [Entry; STACK],
}

/// Traces the batch in packets, and by `one_by_one` those rays that are better off alone.
#[inline(always)]
pub fn trace<I: Isa16, G: Goal>(
    isa: I,
    tree: &TreeView,
    batch: Batch,
    goal: &mut G,
    counters: &mut Counters,
    one_by_one: impl Fn(Batch, &mut G, &mut Counters),
) {
    let nothing = WordLanes([NONE; 16]);
    let mut packet = Packet {
        isa,
        tree,
        batch,
        rays: &[],
        spaces: [PacketSpace::NOWHERE; 2],
        in_object: false,
        inside: WORLD,
        t: Lanes([0.0; 16]),
        greatest_t: 0.0,
        moved: false,
        primitive: nothing,
        instance: nothing,
        from: nothing,
        target: nothing,
        found: 0,
        alive: 0,
        cost: 0,
        saved: 0,
        height: 0,
        stack: [Entry { reference: 0, lanes: 0, distance: 0.0 }; STACK],
    };
    let mut aside = [0; ASIDE];
    let mut put_aside = 0;
    let (mut pause, mut left) = (FIRST_PAUSE, 0);
    for rays in batch.active.chunks(16) {
        if left > 0 {
            left -= 1;
        } else if rays.len() >= SMALLEST && packet.load(rays, goal) {
            packet.traverse::<G>(goal, counters);
            if packet.cost > packet.saved {
                left = pause;
                pause = LONGEST_PAUSE.min(2 * pause);
            } else {
                pause = FIRST_PAUSE;
            }
            continue;
        }
        aside[put_aside..put_aside + rays.len()].copy_from_slice(rays);
        put_aside += rays.len();
        if put_aside > ASIDE - 16 {
            let rest = Batch { rays: batch.rays, active: &aside[..put_aside] };
            one_by_one(rest, goal, counters);
            put_aside = 0;
        }
    }
    let rest = Batch { rays: batch.rays, active: &aside[..put_aside] };
    one_by_one(rest, goal, counters);
}

impl<'a, I: Isa16> Packet<'a, '_, I> {
    /// Loads rays; false if they are not coherent.
    #[inline(always)]
    fn load<G: Goal>(&mut self, rays: &'a [u32], goal: &G) -> bool {
        let world = &mut self.spaces[0];
        let run = run_of(rays);
        let valid = world.load(self.isa, self.batch.rays, rays, &run);
        if valid == 0 || !world.is_coherent(self.isa, self.tree.size) {
            return false;
        }
        self.rays = rays;
        goal.start_packet(rays, &run, &mut self.t.0, &mut self.primitive.0, &mut self.instance.0);
        // A limit that is NaN is a limit that nothing is below.
        self.alive = valid & self.isa.lt16(self.isa.splat16(0.0), self.isa.load16(&self.t));
        self.found = 0;
        self.height = 0;
        (self.cost, self.saved) = (0, 0);
        self.enter_world(goal);
        self.limit();
        true
    }

    #[inline(always)]
    fn enter_world<G: Goal>(&mut self, goal: &G) {
        self.in_object = false;
        self.inside = WORLD;
        let run = run_of(self.rays);
        let mut instance = [NONE; 16];
        gather(&mut self.from.0, self.batch.rays.from_primitive, self.rays, &run);
        gather(&mut instance, self.batch.rays.from_instance, self.rays, &run);
        self.drop_placed(&instance, |packet| &mut packet.from);
        if G::ANY_HIT {
            goal.target_packet(self.rays, &run, &mut self.target.0, &mut instance);
            self.drop_placed(&instance, |packet| &mut packet.target);
        }
    }

    /// Surfaces of placed instances are not in the world.
    #[inline(always)]
    fn drop_placed(&mut self, instance: &[u32; 16], primitives: impl Fn(&mut Self) -> &mut WordLanes) {
        if self.tree.instances.is_empty() {
            return;
        }
        let tree = self.tree;
        for (primitive, &instance) in primitives(self).0.iter_mut().zip(instance) {
            *primitive = tree.in_world(*primitive, instance);
        }
    }

    /// Lanes that enter an instance go on in its object space.
    #[inline(always)]
    fn enter_instance<G: Goal>(&mut self, goal: &G, instance: u32, lanes: u32) {
        let record = &self.tree.instances[instance as usize];
        let mesh = &self.tree.meshes[record.mesh as usize];
        let object = &mut self.spaces[1];
        for (lane, &ray) in self.rays.iter().enumerate() {
            let ray = ray as usize;
            let moved = record.object_ray(self.batch.origin(ray), self.batch.direction(ray));
            for axis in 0..3 {
                object.origin[axis].0[lane] = moved.origin[axis];
                object.direction[axis].0[lane] = moved.direction[axis];
            }
            object.tmin.0[lane] = -moved.t0;
            let here = |primitive, from| if from == instance { primitive } else { NONE };
            self.from.0[lane] = here(self.batch.rays.from_primitive[ray], self.batch.rays.from_instance[ray]);
            if G::ANY_HIT {
                let (primitive, from) = goal.target(ray);
                self.target.0[lane] = here(primitive, from);
            }
        }
        let valid = object.prepare(self.isa, lanes);
        self.in_object = true;
        self.inside = instance;
        self.push(Entry { reference: Ref::LEAVE.0, lanes: 0, distance: 0.0 });
        if valid != 0 {
            self.push(Entry { reference: mesh.root, lanes: valid, distance: f32::NEG_INFINITY });
        }
    }

    #[inline(always)]
    fn push(&mut self, entry: Entry) {
        debug_assert!(self.height < STACK);
        // SAFETY: the tree's depth bounds the height (see `TreeView`).
        unsafe { *self.stack.get_unchecked_mut(self.height) = entry };
        self.height += 1;
    }

    /// The greatest distance that still matters to a ray.
    #[inline(always)]
    fn limit(&mut self) {
        self.moved = false;
        let t = self.isa.load16(&self.t);
        let out = self.isa.splat16(f32::NEG_INFINITY);
        self.greatest_t = self.isa.greatest16(self.isa.select16(self.alive, t, out));
    }

    #[inline(always)]
    fn traverse<G: Goal>(&mut self, goal: &mut G, counters: &mut Counters) {
        self.push(Entry { reference: self.tree.root, lanes: self.alive, distance: f32::NEG_INFINITY });
        while self.height > 0 && self.alive != 0 {
            self.height -= 1;
            // SAFETY: below the height (see `push`).
            let entry = unsafe { *self.stack.get_unchecked(self.height) };
            let node = entry.reference;
            if node == Ref::LEAVE.0 {
                self.enter_world(goal);
                continue;
            }
            let t = self.isa.load16(&self.t);
            let lanes = entry.lanes & self.alive & self.isa.le16(self.isa.splat16(entry.distance), t);
            if lanes == 0 || node == Ref::END.0 {
                continue;
            }
            self.saved += lanes.count_ones();
            self.cost += if self.tree.bytes > NEAR_BYTES { FAR_COST } else { NEAR_COST };
            if node < Ref::TRIANGLES {
                counters.nodes += 1;
                self.visit_node(node, lanes);
            } else if node < Ref::SPHERES {
                counters.triangle_leaves += 1;
                if node < Ref::PARTS {
                    self.visit_triangles::<G, false>(node & Ref::UNIT, lanes);
                } else {
                    self.visit_triangles::<G, true>(node & Ref::UNIT, lanes);
                }
            } else if node < Ref::INSTANCE {
                counters.sphere_leaves += 1;
                self.visit_spheres::<G>(node & Ref::UNIT, lanes);
            } else {
                counters.instances += 1;
                self.enter_instance(goal, node & Ref::UNIT, lanes);
            }
        }
        let mut found = self.found;
        while found != 0 {
            let lane = found.trailing_zeros() as usize & 15;
            found &= found - 1;
            let (primitive, instance) = (self.primitive.0[lane], self.instance.0[lane]);
            let instance = if instance == WORLD { self.tree.world_instance(primitive) } else { instance };
            goal.found(self.rays[lane] as usize, self.t.0[lane], primitive, instance);
        }
    }

    #[inline(always)]
    fn visit_node(&mut self, unit: u32, lanes: u32) {
        let isa = self.isa;
        // SAFETY: a reference to a node (see `TreeView`).
        let node = unsafe { item::<Node>(self.tree, unit) };
        let space = &self.spaces[usize::from(self.in_object)];
        let t = isa.load16(&self.t);
        let (mut places, mut distances) = ([0u32; 8], [f32::NEG_INFINITY; 8]);
        let mut count = 8;
        // SAFETY: eight words and floats are read and written, in arrays of eight.
        unsafe {
            let order = isa.load_words8(node.order.as_ptr());
            let mut entered = 255;
            let mut order = isa.shift_right8(order, 3 * space.octant());
            if let Some(beam) = &space.beam {
                let distance = isa.permute8(beam.enter(isa, node), order);
                entered = isa.le8(distance, isa.splat8(self.greatest_t));
                isa.compress_store8(entered, distance, distances.as_mut_ptr());
                count = entered.count_ones() as usize;
            }
            order = isa.permute_words8(order, isa.load_words8([0, 1, 2, 3, 4, 5, 6, 7].as_ptr()));
            isa.compress_store_words8(entered, order, places.as_mut_ptr());
        }
        let mut height = self.height;
        for place in 0..count {
            let child = (places[place & 7] & 7) as usize;
            let p = &node.planes;
            let lower = [p[0][child], p[2][child], p[4][child]];
            let upper = [p[1][child], p[3][child], p[5][child]];
            let inside = space.in_box(isa, lower, upper, t) & lanes;
            let entry = Entry { reference: node.children[child].0, lanes: inside, distance: distances[place & 7] };
            // SAFETY: the tree's depth bounds the height (see `TreeView`).
            unsafe { *self.stack.get_unchecked_mut(height) = entry };
            height += usize::from(inside != 0);
        }
        self.height = height;
        if height > 0 {
            // SAFETY: below the height.
            prefetch(self.tree, unsafe { self.stack.get_unchecked(height - 1) }.reference);
        }
    }

    /// Visits a leaf of triangles, or one of `PARTS`.
    #[inline(always)]
    fn visit_triangles<G: Goal, const PARTS: bool>(&mut self, unit: u32, lanes: u32) {
        // SAFETY: a reference to a triangle leaf, or one of parts, which begins like it (see `TreeView`).
        let leaf = unsafe { item::<Triangles4>(self.tree, unit) };
        let axes = self.spaces[usize::from(self.in_object)].axes;
        match axes {
            // Parts go one ray at a time: code for whole packets of them made packets of triangles slower.
            Some(axes) if !PARTS && lanes.count_ones() > FEW => {
                let boxes = padded_boxes(self.isa, leaf);
                for place in 0..4 {
                    if leaf.ids[place] == NONE {
                        break;
                    }
                    self.triangle::<G>(leaf, place, &boxes, axes, lanes);
                }
            }
            _ => {
                let mut left = lanes;
                while left != 0 {
                    let lane = left.trailing_zeros() as usize & 15;
                    left &= left - 1;
                    let mut skip = places_of(self.isa, &leaf.ids, self.from.0[lane]);
                    if G::ANY_HIT {
                        skip |= places_of(self.isa, &leaf.ids, self.target.0[lane]);
                    }
                    let space = &self.spaces[usize::from(self.in_object)];
                    let (ray, tmin, limit) = (space.lane(lane), space.tmin.0[lane], self.t.0[lane]);
                    let hits = if PARTS {
                        // SAFETY: a reference to a leaf of parts.
                        let parts = unsafe { item::<Parts4>(self.tree, unit) };
                        parts4(self.isa, parts, &ray, tmin, limit, skip)
                    } else {
                        triangles4(self.isa, leaf, &ray, tmin, limit, skip)
                    };
                    self.take_one::<G>(lane, hits, &leaf.ids);
                }
            }
        }
        if self.moved {
            self.limit();
        }
    }

    #[inline(always)]
    fn visit_spheres<G: Goal>(&mut self, unit: u32, lanes: u32) {
        // SAFETY: a reference to a sphere leaf (see `TreeView`).
        let leaf = unsafe { item::<Spheres4>(self.tree, unit) };
        let mut left = lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize & 15;
            left &= left - 1;
            let ray = self.rays[lane] as usize;
            let (o, d) = (self.batch.origin(ray), self.batch.direction(ray));
            let mut hits = if leaf.is_shape() {
                // SAFETY: a leaf of spheres with this mark is one of a shape, which is as long.
                let leaf = unsafe { item::<Shape>(self.tree, unit) };
                let target = if G::ANY_HIT { self.target.0[lane] } else { NONE };
                shape(leaf, self.tree.parts, o, d, [self.from.0[lane], target], self.t.0[lane])
            } else {
                spheres4(self.isa, leaf, o, d, self.from.0[lane], self.t.0[lane])
            };
            if G::ANY_HIT
                && !leaf.is_shape()
                && let Some(hits) = &mut hits
            {
                hits.mask &= !places_of(self.isa, &leaf.ids, self.target.0[lane]);
            }
            self.take_one::<G>(lane, hits, &leaf.ids);
        }
        if self.moved {
            self.limit();
        }
    }

    /// Takes the best of a leaf's candidates for one ray.
    #[inline(always)]
    fn take_one<G: Goal>(&mut self, lane: usize, hits: Option<LeafHits>, ids: &[u32; 4]) {
        let Some(hits) = hits else { return };
        let mut mask = hits.mask;
        while mask != 0 {
            let place = mask.trailing_zeros() as usize & 3;
            mask &= mask - 1;
            let (t, held) = (hits.t[place], self.t.0[lane]);
            let nearer = t < held;
            if G::ANY_HIT {
                if nearer {
                    self.found |= 1 << lane;
                    self.alive &= !(1 << lane);
                    self.moved = true;
                }
            } else if nearer || (t == held && self.wins_tie(lane, ids[place])) {
                self.t.0[lane] = t;
                self.primitive.0[lane] = ids[place];
                self.instance.0[lane] = self.inside;
                self.found |= 1 << lane;
                self.moved = true;
            }
        }
    }

    #[inline(always)]
    fn wins_tie(&self, lane: usize, primitive: u32) -> bool {
        self.tree.wins_tie(primitive, self.inside, self.primitive.0[lane], self.instance.0[lane])
    }

    /// One triangle against the rays of `lanes`, by the formula of [`triangle`](super::super::triangle).
    #[inline(always)]
    fn triangle<G: Goal>(&mut self, leaf: &Triangles4, place: usize, boxes: &PaddedBoxes, axes: [u32; 3], lanes: u32) {
        let isa = self.isa;
        let space = &self.spaces[usize::from(self.in_object)];
        let (x, y, z) = (axes[0] as usize, axes[1] as usize, axes[2] as usize);
        let (ox, oy, oz) = (
            isa.load16(&space.shear_origin[0]),
            isa.load16(&space.shear_origin[1]),
            isa.load16(&space.shear_origin[2]),
        );
        let (sx, sy) = (isa.load16(&space.shear[0]), isa.load16(&space.shear[1]));
        let [a, b, c] = &leaf.vertices;
        let az = isa.sub16(isa.splat16(a[z][place]), oz);
        let bz = isa.sub16(isa.splat16(b[z][place]), oz);
        let cz = isa.sub16(isa.splat16(c[z][place]), oz);
        let ax = isa.fnmadd16(sx, az, isa.sub16(isa.splat16(a[x][place]), ox));
        let ay = isa.fnmadd16(sy, az, isa.sub16(isa.splat16(a[y][place]), oy));
        let bx = isa.fnmadd16(sx, bz, isa.sub16(isa.splat16(b[x][place]), ox));
        let by = isa.fnmadd16(sy, bz, isa.sub16(isa.splat16(b[y][place]), oy));
        let cx = isa.fnmadd16(sx, cz, isa.sub16(isa.splat16(c[x][place]), ox));
        let cy = isa.fnmadd16(sy, cz, isa.sub16(isa.splat16(c[y][place]), oy));
        let u = isa.sub16(isa.mul16(cx, by), isa.mul16(cy, bx));
        let v = isa.sub16(isa.mul16(ax, cy), isa.mul16(ay, cx));
        let w = isa.sub16(isa.mul16(bx, ay), isa.mul16(by, ax));
        let zero = isa.splat16(0.0);
        let least = isa.min16(isa.min16(u, v), w);
        let most = isa.max16(isa.max16(u, v), w);
        let mut mask = lanes & (isa.le16(zero, least) | isa.le16(most, zero));
        if mask == 0 {
            return;
        }
        let id = leaf.ids[place];
        let det = isa.add16(isa.add16(u, v), w);
        mask &= isa.lt16(zero, det) | isa.lt16(det, zero);
        mask &= !isa.eq_words16(&self.from, id);
        if G::ANY_HIT {
            mask &= !isa.eq_words16(&self.target, id);
        }
        let distance = isa.fmadd16(u, az, isa.fmadd16(v, bz, isa.mul16(w, cz)));
        let t = isa.mul16(isa.div16(distance, det), isa.load16(&space.shear[2]));
        let (lower, upper) = (&boxes.lower, &boxes.upper);
        let (near, far) = space.interval(
            isa,
            [lower[0][place], lower[1][place], lower[2][place]],
            [upper[0][place], upper[1][place], upper[2][place]],
        );
        let t = isa.sub16(isa.min16(isa.max16(t, near), far), isa.load16(&space.tmin));
        let held = isa.load16(&self.t);
        mask &= isa.le16(near, far) & isa.lt16(zero, t) & isa.le16(t, held);
        let nearer = isa.lt16(t, held);
        if G::ANY_HIT {
            self.found |= mask & nearer;
            self.alive &= !(mask & nearer);
            self.moved |= mask & nearer != 0;
            return;
        }
        let mut taken = mask & nearer;
        let mut ties = mask & !nearer;
        while ties != 0 {
            let lane = ties.trailing_zeros() as usize & 15;
            ties &= ties - 1;
            taken |= u32::from(self.wins_tie(lane, id)) << lane;
        }
        isa.store16(isa.select16(taken, t, held), &mut self.t);
        isa.put_words16(taken, id, &mut self.primitive);
        isa.put_words16(taken, self.inside, &mut self.instance);
        self.found |= taken;
        self.moved |= taken != 0;
    }
}

/// The range of indices that `rays` are, if they are 16 that follow one another.
#[inline(always)]
pub fn run_of(rays: &[u32]) -> Option<Range<usize>> {
    let rays: &[u32; 16] = rays.try_into().ok()?;
    let first = rays[0];
    let mut apart = 0;
    for (lane, &ray) in (0u32..).zip(rays) {
        apart |= ray.wrapping_sub(first) ^ lane;
    }
    (apart == 0).then(|| first as usize..first as usize + 16)
}

/// The values of some rays, in lanes.
#[inline(always)]
pub fn gather<T: Copy>(lanes: &mut [T; 16], values: &[T], rays: &[u32], run: &Option<Range<usize>>) {
    match run {
        Some(run) => lanes.copy_from_slice(&values[run.clone()]),
        None => {
            for (lane, &ray) in lanes.iter_mut().zip(rays) {
                *lane = values[ray as usize];
            }
        }
    }
}
