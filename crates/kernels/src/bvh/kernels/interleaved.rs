//! Incoherent rays, many in flight.
//!
//! One ray at a time is bound by the chain load → box test → next reference → load, and by mispredicting whether that
//! reference is a node or a leaf. Here each of `IN_FLIGHT` rays is a small state machine. A round takes every ray one
//! step further, one node or one leaf; a step ends by prefetching what the ray needs next, which has a whole round to
//! arrive.
//!
//! A round takes its rays by what is next for them: first those at a node, then those at a leaf of triangles, then
//! those whose line passes through a triangle there, then the rest (rays that are done, spheres, instances). Which
//! rays these are is known before from one look at all references, so that there is one branch that cannot be
//! predicted for each kind and round, where its loop ends, instead of one for each step: two mispredictions a ray and
//! not eight.
//!
//! Tried and lost: queues by kind, which let all rays run on to a leaf before any leaf is tested, were 13 to 25 %
//! slower with 8, 16 or 32 rays under way than rounds of eight in the order of the rays.
//!
//! Distances on the stack are in world t also inside instances (t' − tmin, a monotone function of the box's t'), so a
//! nearer hit drops whatever lies behind it, on both levels, without losing an exact tie.

use super::super::geometry::NONE;
use super::super::layout::{Node, Parts4, Ref, Shape, Spheres4, Triangles4, Unit};
use super::super::ray_space::RaySpace;
use super::isa::{Isa, Isa16, WordLanes};
use super::leaves::{LeafHits, Passage, hits4, parts_hits4, passage4, places_of, shape, spheres4};
use super::packet::run_of;
use super::packet_space::PacketSpace;
use super::query::{Batch, Goal, TreeView, WORLD};
use super::{Counters, IN_FLIGHT, STACK};

/// One ray under way.
#[repr(C, align(64))]
struct Flight {
    space: RaySpace,
    /// Byte offsets of the near planes within a node; the far ones differ in bit 5.
    near: [u32; 3],
    /// Where the octant's order is within the words of `Node::order`.
    shift: u32,
    /// Entries on the stack.
    height: u32,
    /// The nearest hit so far, or the limit.
    t: f32,
    /// Minus the distance by which the origin was moved in this space: 0 in the world.
    tmin: f32,
    primitive: u32,
    instance: u32,
    /// The instance the ray is in, or `WORLD`.
    inside: u32,
    /// What cannot be hit in this space.
    from: u32,
    target: u32,
    ray: u32,
    found: bool,
    refs: [u32; STACK],
    distances: [f32; STACK],
}

impl Flight {
    /// No ray under way.
    const NOTHING: Self = Self {
        space: RaySpace::NOWHERE,
        near: [0; 3],
        shift: 0,
        height: 0,
        t: 0.0,
        tmin: 0.0,
        primitive: NONE,
        instance: NONE,
        inside: WORLD,
        from: NONE,
        target: NONE,
        ray: NONE,
        found: false,
        refs: [0; STACK],
        distances: [0.0; STACK],
    };

    #[inline(always)]
    fn enter(&mut self, space: RaySpace, tmin: f32) {
        let negative = |axis: u32| (space.octant >> axis & 1) * 32;
        self.near = [negative(0), 64 + negative(1), 128 + negative(2)];
        self.shift = 3 * space.octant;
        self.tmin = tmin;
        self.space = space;
    }

    #[inline(always)]
    fn push(&mut self, reference: u32, distance: f32) {
        debug_assert!((self.height as usize) < STACK - 8);
        // SAFETY: the tree's depth bounds the height (see `TreeView`).
        unsafe {
            *self.refs.get_unchecked_mut(self.height as usize) = reference;
            *self.distances.get_unchecked_mut(self.height as usize) = distance;
        }
        self.height += 1;
    }

    /// Takes the top of the stack as the next thing to visit. The bottom is `END`, which is never popped twice.
    #[inline(always)]
    fn pop(&mut self) -> u32 {
        self.pop_if(true)
    }

    /// As [`pop`](Self::pop) where `taken`; else only looks.
    #[inline(always)]
    fn pop_if(&mut self, taken: bool) -> u32 {
        debug_assert!(self.height > 0);
        // SAFETY: the height is above zero and within the stack (see `TreeView`).
        let top = unsafe { *self.refs.get_unchecked(self.height as usize - 1) };
        self.height -= u32::from(taken);
        top
    }

    /// Drops what lies behind the nearest hit.
    #[inline(always)]
    fn cull<I: Isa>(&mut self, isa: I) {
        let limit = isa.splat8(self.t);
        let height = self.height as usize;
        let (mut read, mut write) = (0, 0);
        while read < height {
            let left = height - read;
            // SAFETY: `read` and `write` are at most the height, which leaves 8 entries of room (see `TreeView`).
            unsafe {
                let distances = isa.load_any8(self.distances.as_ptr().add(read));
                let refs = isa.load_words8(self.refs.as_ptr().add(read));
                let kept = isa.le8(distances, limit) & if left >= 8 { 255 } else { (1 << left) - 1 };
                isa.compress_store8(kept, distances, self.distances.as_mut_ptr().add(write));
                isa.compress_store_words8(kept, refs, self.refs.as_mut_ptr().add(write));
                write += kept.count_ones() as usize;
            }
            read += 8;
        }
        self.height = write as u32;
    }
}

/// A leaf with triangles that a ray's line passes through.
#[derive(Clone, Copy)]
struct Candidate<I: Isa> {
    flight: usize,
    reference: u32,
    mask: u32,
    passage: Passage<I>,
}

/// The rays under way. They lie where they were made: to move them into this would copy them.
struct Flights<'a> {
    rays: &'a mut [Flight; IN_FLIGHT],
    /// What each of them visits next: apart from the rest of their state, for the look at all of them.
    next: &'a mut WordLanes,
}

/// Traces the batch with `IN_FLIGHT` rays under way at a time.
#[inline(always)]
pub fn trace<I: Isa16, G: Goal>(isa: I, tree: &TreeView, batch: Batch, goal: &mut G, counters: &mut Counters) {
    if batch.active.is_empty() {
        return;
    }
    let mut rays = [const { Flight::NOTHING }; IN_FLIGHT];
    let mut next = WordLanes([Ref::END.0; IN_FLIGHT]);
    let mut flights = Flights { rays: &mut rays, next: &mut next };
    let mut waiting = Waiting::new(batch);
    let mut candidates = [Candidate { flight: 0, reference: 0, mask: 0, passage: Passage::none(isa) }; IN_FLIGHT];
    // Flights that have a ray, or may still get one.
    let mut live = 0xFFFF;
    // Apart from the counters, which would be read and written in every round.
    let (mut nodes, mut triangle_leaves) = (0, 0);
    while live != 0 {
        // Nodes are 0…, triangles 10…, everything else 11… (see `Ref`).
        let (not_nodes, not_triangles) = isa.high_bits16(flights.next);
        let at_nodes = !not_nodes & 0xFFFF;
        nodes += at_nodes.count_ones();
        flights.visit_nodes::<I, G>(isa, tree, at_nodes);
        let at_triangles = not_nodes & !not_triangles;
        triangle_leaves += at_triangles.count_ones();
        let passed = flights.pass_triangles::<I, G>(isa, tree, at_triangles, &mut candidates);
        flights.test_candidates::<I, G>(isa, tree, &candidates[..passed.min(IN_FLIGHT)]);
        let others = not_nodes & not_triangles & live;
        live &= !flights.visit_others(isa, tree, goal, counters, &mut waiting, others);
    }
    counters.nodes += u64::from(nodes);
    counters.triangle_leaves += u64::from(triangle_leaves);
}

/// The steps of a round, each for the rays of a mask. They are a part of [`trace`], with its target features.
impl Flights<'_> {
    #[inline(always)]
    fn visit_nodes<I: Isa, G: Goal>(&mut self, isa: I, tree: &TreeView, mut at_nodes: u32) {
        while at_nodes != 0 {
            let at = first_of(&mut at_nodes);
            self.next.0[at] = visit_node::<I, G>(isa, tree, &mut self.rays[at], self.next.0[at]);
            prefetch(tree, self.next.0[at]);
        }
    }

    /// Finds which lines pass through triangles of their leaves; gives the number of these candidates.
    #[inline(always)]
    fn pass_triangles<I: Isa, G: Goal>(
        &mut self,
        isa: I,
        tree: &TreeView,
        mut at_triangles: u32,
        candidates: &mut [Candidate<I>; IN_FLIGHT],
    ) -> usize {
        let mut passed = 0;
        while at_triangles != 0 {
            let at = first_of(&mut at_triangles);
            let flight = &mut self.rays[at];
            let reference = self.next.0[at];
            // SAFETY: a reference to a triangle leaf, or one of parts, which begins like it (see `TreeView`).
            let leaf = unsafe { item::<Triangles4>(tree, reference & Ref::UNIT) };
            let mut skip = places_of(isa, &leaf.ids, flight.from);
            if G::ANY_HIT {
                skip |= places_of(isa, &leaf.ids, flight.target);
            }
            let (inside, passage) = passage4(isa, leaf, &flight.space);
            let mask = inside & !skip;
            // Always written and taken up only where it counts; the stack is popped only where the leaf is done with.
            candidates[passed & 15] = Candidate { flight: at, reference, mask, passage };
            passed += usize::from(mask != 0);
            self.next.0[at] = flight.pop_if(mask == 0);
            prefetch(tree, self.next.0[at]);
        }
        passed
    }

    /// Takes what is hit of the triangles that lines pass through.
    #[inline(always)]
    fn test_candidates<I: Isa, G: Goal>(&mut self, isa: I, tree: &TreeView, candidates: &[Candidate<I>]) {
        for candidate in candidates {
            let at = candidate.flight & 15;
            let flight = &mut self.rays[at];
            let Candidate { reference, passage, mask, .. } = candidate;
            // SAFETY: as in `pass_triangles`.
            let leaf = unsafe { item::<Triangles4>(tree, reference & Ref::UNIT) };
            // Two loops, triangles and then parts, had as many branches mispredicted.
            let hits = if *reference < Ref::PARTS {
                hits4(isa, leaf, &flight.space, passage, flight.tmin, flight.t, *mask)
            } else {
                // SAFETY: a reference to a leaf of parts.
                let leaf = unsafe { item::<Parts4>(tree, reference & Ref::UNIT) };
                parts_hits4(isa, leaf, &flight.space, passage, flight.tmin, flight.t, *mask)
            };
            let instance = flight.inside;
            self.next.0[at] = take::<I, G>(isa, tree, flight, hits, &leaf.ids, instance);
            prefetch(tree, self.next.0[at]);
        }
    }

    /// Rays that are done give way to those that wait; the others visit spheres, shapes and instances. Gives those that
    /// have no ray any more.
    #[inline(always)]
    fn visit_others<I: Isa16, G: Goal>(
        &mut self,
        isa: I,
        tree: &TreeView,
        goal: &mut G,
        counters: &mut Counters,
        waiting: &mut Waiting,
        mut others: u32,
    ) -> u32 {
        let batch = waiting.batch;
        let mut ended = 0;
        while others != 0 {
            let at = first_of(&mut others);
            let flight = &mut self.rays[at];
            let node = self.next.0[at];
            self.next.0[at] = if node == Ref::END.0 {
                land(tree, goal, flight);
                match waiting.next(isa) {
                    Some((ray, space)) => launch(tree, batch, goal, flight, ray, space),
                    None => {
                        ended |= 1 << at;
                        continue;
                    }
                }
            } else if node < Ref::INSTANCE {
                counters.sphere_leaves += 1;
                visit_spheres::<I, G>(isa, tree, batch, flight, node & Ref::UNIT)
            } else if node == Ref::LEAVE.0 {
                leave(tree, batch, goal, flight)
            } else {
                counters.instances += 1;
                enter_instance(tree, batch, goal, flight, node & Ref::UNIT)
            };
            prefetch(tree, self.next.0[at]);
        }
        ended
    }
}

/// Takes the first lane out of a mask that is not empty.
#[inline(always)]
fn first_of(mask: &mut u32) -> usize {
    let lane = mask.trailing_zeros() as usize & 15;
    *mask &= *mask - 1;
    lane
}

/// The rays of a batch that have not set off, made ready sixteen at a time over lanes.
struct Waiting<'a> {
    batch: Batch<'a>,
    groups: std::slice::Chunks<'a, u32>,
    /// The rays that are ready, and the lanes of those that have not set off.
    group: &'a [u32],
    left: u32,
    space: PacketSpace,
}

impl<'a> Waiting<'a> {
    fn new(batch: Batch<'a>) -> Self {
        Self { batch, groups: batch.active.chunks(16), group: &[], left: 0, space: PacketSpace::NOWHERE }
    }

    /// The next ray, ready for the world.
    #[inline(always)]
    fn next<I: Isa16>(&mut self, isa: I) -> Option<(u32, RaySpace)> {
        while self.left == 0 {
            self.group = self.groups.next()?;
            self.left = self.space.load(isa, self.batch.rays, self.group, &run_of(self.group));
        }
        let lane = self.left.trailing_zeros() as usize & 15;
        self.left &= self.left - 1;
        Some((self.group[lane], self.space.lane(lane)))
    }
}

/// Sets a ray under way.
#[inline(always)]
fn launch<G: Goal>(tree: &TreeView, batch: Batch, goal: &G, flight: &mut Flight, ray: u32, space: RaySpace) -> u32 {
    let start = goal.start(ray as usize);
    flight.t = start.t;
    flight.primitive = start.primitive;
    flight.instance = start.instance;
    flight.found = false;
    flight.ray = ray;
    flight.height = 0;
    flight.push(Ref::END.0, f32::NEG_INFINITY);
    enter_world(tree, batch, goal, flight, space);
    tree.root
}

/// Hands out what a ray has found.
#[inline(always)]
fn land<G: Goal>(tree: &TreeView, goal: &mut G, flight: &Flight) {
    if flight.found {
        let instance = if flight.instance == WORLD { tree.world_instance(flight.primitive) } else { flight.instance };
        goal.found(flight.ray as usize, flight.t, flight.primitive, instance);
    }
}

#[inline(always)]
fn enter_world<G: Goal>(tree: &TreeView, batch: Batch, goal: &G, flight: &mut Flight, space: RaySpace) {
    let ray = flight.ray as usize;
    flight.enter(space, 0.0);
    flight.inside = WORLD;
    flight.from = tree.in_world(batch.rays.from_primitive[ray], batch.rays.from_instance[ray]);
    if G::ANY_HIT {
        let (primitive, instance) = goal.target(ray);
        flight.target = tree.in_world(primitive, instance);
    }
}

#[inline(always)]
fn leave<G: Goal>(tree: &TreeView, batch: Batch, goal: &G, flight: &mut Flight) -> u32 {
    let ray = flight.ray as usize;
    if let Some(space) = RaySpace::new(batch.origin(ray), batch.direction(ray)) {
        enter_world(tree, batch, goal, flight, space);
    }
    flight.pop()
}

#[inline(always)]
fn enter_instance<G: Goal>(tree: &TreeView, batch: Batch, goal: &G, flight: &mut Flight, instance: u32) -> u32 {
    let ray = flight.ray as usize;
    let record = &tree.instances[instance as usize];
    let mesh = &tree.meshes[record.mesh as usize];
    let moved = record.object_ray(batch.origin(ray), batch.direction(ray));
    // A placement so extreme that the ray is no ray in object space: nothing is hit there.
    let Some(space) = RaySpace::new(moved.origin, moved.direction) else { return flight.pop() };
    flight.push(Ref::LEAVE.0, f32::NEG_INFINITY);
    flight.enter(space, -moved.t0);
    flight.inside = instance;
    let here = |primitive, from| if from == instance { primitive } else { NONE };
    flight.from = here(batch.rays.from_primitive[ray], batch.rays.from_instance[ray]);
    if G::ANY_HIT {
        let (primitive, from) = goal.target(ray);
        flight.target = here(primitive, from);
    }
    mesh.root
}

/// Eight boxes: those that the ray is in before its nearest hit go onto the stack, the nearest on top and next.
#[inline(always)]
fn visit_node<I: Isa, G: Goal>(isa: I, tree: &TreeView, flight: &mut Flight, node: u32) -> u32 {
    // SAFETY: a reference to a node (see `TreeView`).
    let node = unsafe { item::<Node>(tree, node) };
    let planes = node.planes.as_ptr().cast::<u8>();
    let [near_x, near_y, near_z] = flight.near;
    let space = &flight.space;
    let (rx, ry, rz) = (isa.splat8(space.rd[0]), isa.splat8(space.rd[1]), isa.splat8(space.rd[2]));
    // SAFETY: the offsets are multiples of 32 below 192, and the node is aligned to 32 bytes.
    let (ax, ay, az, bx, by, bz) = unsafe {
        (
            isa.fmsub8(plane(isa, planes, near_x), rx, isa.splat8(space.near_offset[0])),
            isa.fmsub8(plane(isa, planes, near_y), ry, isa.splat8(space.near_offset[1])),
            isa.fmsub8(plane(isa, planes, near_z), rz, isa.splat8(space.near_offset[2])),
            isa.fmsub8(plane(isa, planes, near_x ^ 32), rx, isa.splat8(space.far_offset[0])),
            isa.fmsub8(plane(isa, planes, near_y ^ 32), ry, isa.splat8(space.far_offset[1])),
            isa.fmsub8(plane(isa, planes, near_z ^ 32), rz, isa.splat8(space.far_offset[2])),
        )
    };
    let tmin = isa.splat8(flight.tmin);
    let near = isa.max8(isa.max8(ax, ay), isa.max8(az, tmin));
    let far = isa.min8(isa.min8(bx, by), bz);
    let distance = isa.where_le8(near, far, isa.sub8(near, tmin));
    if G::ANY_HIT {
        // Any will do, so they are not sorted.
        let entered = isa.le8(distance, isa.splat8(flight.t));
        // SAFETY: as below.
        unsafe {
            let children = isa.load_words8(node.children.as_ptr().cast());
            isa.compress_store_words8(entered, children, flight.refs.as_mut_ptr().add(flight.height as usize));
        }
        flight.height += entered.count_ones();
        return flight.pop();
    }
    // SAFETY: eight words each, and the stack has room for eight more entries (see `TreeView`).
    unsafe {
        let order = isa.shift_right8(isa.load_words8(node.order.as_ptr()), flight.shift);
        let distance = isa.permute8(distance, order);
        let children = isa.permute_words8(isa.load_words8(node.children.as_ptr().cast()), order);
        let entered = isa.le8(distance, isa.splat8(flight.t));
        let height = flight.height as usize;
        isa.compress_store_words8(entered, children, flight.refs.as_mut_ptr().add(height));
        isa.compress_store8(entered, distance, flight.distances.as_mut_ptr().add(height));
        flight.height += entered.count_ones();
    }
    flight.pop()
}

/// # Safety
/// `offset` is a multiple of 32 below 192, and `planes` those of a node.
#[inline(always)]
unsafe fn plane<I: Isa>(isa: I, planes: *const u8, offset: u32) -> I::F8 {
    // SAFETY: the caller's promise.
    unsafe { isa.load8(planes.add(offset as usize).cast()) }
}

/// A leaf of spheres, or of one other shape.
#[inline(always)]
fn visit_spheres<I: Isa, G: Goal>(isa: I, tree: &TreeView, batch: Batch, flight: &mut Flight, unit: u32) -> u32 {
    // SAFETY: a reference to a sphere leaf (see `TreeView`).
    let leaf = unsafe { item::<Spheres4>(tree, unit) };
    let ray = flight.ray as usize;
    let (o, d) = (batch.origin(ray), batch.direction(ray));
    let mut hits = if leaf.is_shape() {
        // SAFETY: a leaf of spheres with this mark is one of a shape, which is as long.
        let leaf = unsafe { item::<Shape>(tree, unit) };
        let target = if G::ANY_HIT { flight.target } else { NONE };
        shape(leaf, tree.parts, o, d, [flight.from, target], flight.t)
    } else {
        spheres4(isa, leaf, o, d, flight.from, flight.t)
    };
    if G::ANY_HIT
        && !leaf.is_shape()
        && let Some(hits) = &mut hits
    {
        hits.mask &= !places_of(isa, &leaf.ids, flight.target);
    }
    take::<I, G>(isa, tree, flight, hits, &leaf.ids, WORLD)
}

/// Takes the best of a leaf's candidates, if it beats the hit in hand, and goes on.
#[inline(always)]
fn take<I: Isa, G: Goal>(
    isa: I,
    tree: &TreeView,
    flight: &mut Flight,
    hits: Option<LeafHits>,
    ids: &[u32; 4],
    instance: u32,
) -> u32 {
    if let Some(hits) = hits {
        let mut mask = hits.mask;
        let mut nearer = false;
        while mask != 0 {
            let place = mask.trailing_zeros() as usize & 3;
            mask &= mask - 1;
            let t = hits.t[place];
            if G::ANY_HIT {
                if t < flight.t {
                    flight.found = true;
                    return Ref::END.0;
                }
            } else if t < flight.t
                || (t == flight.t && tree.wins_tie(ids[place], instance, flight.primitive, flight.instance))
            {
                flight.t = t;
                flight.primitive = ids[place];
                flight.instance = instance;
                nearer = true;
            }
        }
        if nearer {
            flight.found = true;
            flight.cull(isa);
        }
    }
    flight.pop()
}

/// # Safety
/// An item of type `T` starts at `unit` of the tree's arena.
#[inline(always)]
pub unsafe fn item<'a, T>(tree: &TreeView<'a>, unit: u32) -> &'a T {
    // SAFETY: the caller's promise.
    unsafe { &*tree.base.add(unit as usize * size_of::<Unit>()).cast::<T>() }
}

/// Asks for the lines of what a reference points to. Marks and instances give addresses that may not exist, which a
/// prefetch ignores.
#[inline(always)]
pub fn prefetch(tree: &TreeView, reference: u32) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        let at = tree.base.wrapping_add((reference & Ref::UNIT) as usize * size_of::<Unit>()).cast::<i8>();
        // SAFETY: every x86-64 processor has SSE, and a prefetch never faults.
        unsafe {
            _mm_prefetch::<_MM_HINT_T0>(at);
            _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(64));
            _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(128));
            _mm_prefetch::<_MM_HINT_T0>(at.wrapping_add(192));
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = (tree, reference);
}
