//! The state of one batch: structures of arrays, allocated once per thread, small enough to stay in the L2 cache.
//!
//! A batch is up to [`ITEMS`] items; an item is a quarter of a block of 256 pixels at one sample index: one column
//! and one row of each pair, 64 of them. Where they lie, [`crate::sampling::blocks`] says. Slot s is pixel s % 64 (in
//! Z-order) of item s / 64; slots whose pixel lies outside of the picture have no path. A slot's radiance is summed in
//! the order of its path's vertices, whatever the schedule.

use super::pages::Pages;
use super::watch::Watch;
use crate::bvh::Rays;
use crate::lanes::{Bits, Lanes};
use crate::layers::LayerSamples;
use crate::math::V3;
use crate::report::Counters;
use crate::sampling::blocks::{ITEM_PIXELS, Item, Pixels};
pub use crate::sampling::blocks::{ITEMS, PATHS};
use crate::scene::NONE;
use bytemuck::{Pod, Zeroable};

/// At so many of its first vertices a path from the camera that has met mirrors and glass only goes both ways at glass:
/// what one of them shows, often the lamp, is far brighter than what the other does.
pub const BRANCHING: u32 = 3;

/// Glint chains of a pixel at each sample index, beside its own path. Three and a path's own four are one sequence of
/// samples each.
pub const CHAINS: u32 = 3;
/// What is left to the path's own share.
pub const WEIGHT: f32 = 1.0 / (CHAINS as f32 + 1.0);

/// From so many vertices behind those rays are aimed, too.
pub const LATE_AIMS: u32 = 2;

/// Room for all paths of a batch that go both ways wherever they may (see `stages::shade`) and have a ray aimed
/// wherever they may (`stages::aim`), and behind every array for one vector more: a compressing store writes whole
/// registers. At each of its first vertices a path becomes two at most: glass sends it both ways, and from a rough
/// surface, glossy ones that an aimed ray has met among them, one is aimed. Behind these vertices each may have
/// [`LATE_AIMS`] more, which have none.
pub const CAPACITY: usize = (1 << BRANCHING) * (1 + LATE_AIMS as usize) * PATHS + 64;

/// A value for each path. The compiler knows the length, so that a place is checked once for all columns. Structures of
/// columns lie on pages of their own ([`Pages`]) and start with these, so that each begins at a whole vector, and 256
/// bytes further within a page than the one before: rows of many columns have places of their own in the L1 cache.
pub type Column<T> = [T; CAPACITY];

/// Three columns: x, y, z or r, g, b.
pub type Columns = [Column<f32>; 3];

/// What the word [`Paths::slot`] holds beside the slot.
pub mod path {
    /// The slot: which pixel of which item.
    pub const SLOT: u32 = super::PATHS as u32 - 1;
    /// The path carries light to the second vertex of a pixel's path, which the pixels of the item share: its radiance
    /// goes to the upper half of [`super::Batch::radiance`].
    pub const SHARED: u32 = super::PATHS as u32;
    /// Slot and sum: where radiance goes.
    pub const SUM: u32 = SLOT | SHARED;
    /// The path has left a member ([`super::Members`]); what it meets next may be shared.
    pub const MAKER: u32 = 2 * SHARED;
    /// The path has been past that, or scattered where nothing is shared: it carries light to its own pixel only. None
    /// of the three: only mirrors and glass so far.
    pub const OWN: u32 = 4 * SHARED;
    /// The path's ray leaves a surface from which rays were aimed ([`super::super::stages::aim`]).
    pub const AIMS: u32 = 8 * SHARED;
    /// The fainter of both ways at glass: it goes both ways no more, and shares nothing.
    pub const BRANCH: u32 = 32 * SHARED;
    /// From so many vertices behind the first ones rays were aimed, of the path or of that from which it was aimed.
    pub const LATE: u32 = 64 * SHARED;
    /// All bits of that number.
    pub const LATES: u32 = 3 * LATE;
    /// A light that the path's ray meets is found in no other way: the ray comes from the camera, a mirror or glass, or
    /// was aimed. Its direction has no density.
    pub const SPECULAR: u32 = 256 * SHARED;
    /// The path's ray was aimed ([`super::super::stages::aim`]): it goes on where it meets a mirror, glass or a glossy
    /// surface only.
    pub const AIMED: u32 = 16 * SHARED;
    /// The path was aimed and has met mirrors and glass only since: roulette goes by what these take ([`AIMED`] ends
    /// with the ray itself).
    pub const SPARED: u32 = 512 * SHARED;
    /// Of paths with any of these the camera sees nothing by mirrors and glass alone: they have met something else, or
    /// are beside a pixel's own.
    pub const NOT_FOLLOWED: u32 = SHARED | MAKER | OWN | AIMED;
}

/// The living paths of a batch: the ray that each is about to trace and what it carries.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Paths {
    /// Origin.
    pub origin: Columns,
    /// Unit direction.
    pub direction: Columns,
    /// Product of f cos / pdf so far, without the radiance scaling of refraction and the shares of both ways at glass:
    /// what roulette goes by.
    pub throughput: Columns,
    /// Radiance scaling of refraction, the product of (n_i / n_t)^2, times the shares of both ways at glass.
    pub eta2: Column<f32>,
    /// Solid-angle density of the direction; anything where the path is [`path::SPECULAR`].
    pub pdf: Column<f32>,
    /// Shading normal where the ray starts; written and read only where there are several lights or rays are aimed, and
    /// the path is not [`path::SPECULAR`].
    pub normal: Columns,
    /// Camera rays: the camera's measure over the pixel's filter there. From a rough surface that they hit, with
    /// light paths at work: K cos J / (h P) of [`super::stages::light_paths`], before what the ray meets is known
    /// without cos and P; zero where no light path could come.
    pub film: Column<f32>,
    /// Slot and state, see [`path`].
    pub slot: Column<u32>,
    /// The surface the ray leaves.
    pub from_primitive: Column<u32>,
    /// Its instance.
    pub from_instance: Column<u32>,
    /// Number of paths.
    pub len: usize,
}

impl Paths {
    /// Leaves those from `from` on that have a bit set in the mask, which is for one vector of camera rays.
    #[inline(always)]
    pub fn keep<F: Lanes>(&mut self, from: usize, mask: F::M) {
        V3::<F>::load(&self.origin, from).compress(mask, &mut self.origin, from);
        V3::<F>::load(&self.direction, from).compress(mask, &mut self.direction, from);
        // All else is the same for all camera rays.
        F::U::load(&self.slot[from..]).compress(mask, &mut self.slot[from..]);
        F::load(&self.film[from..]).compress(mask, &mut self.film[from..]);
    }

    /// Adds those of another, which come from glass, behind these.
    #[inline(always)]
    pub fn append(&mut self, other: &Paths) {
        let (to, from) = (self.len..self.len + other.len, ..other.len);
        for k in 0..3 {
            self.origin[k][to.clone()].copy_from_slice(&other.origin[k][from]);
            self.direction[k][to.clone()].copy_from_slice(&other.direction[k][from]);
            self.throughput[k][to.clone()].copy_from_slice(&other.throughput[k][from]);
        }
        self.eta2[to.clone()].copy_from_slice(&other.eta2[from]);
        self.pdf[to.clone()].copy_from_slice(&other.pdf[from]);
        // From the camera over mirrors and glass only.
        self.film[to.clone()].fill(0.0);
        self.slot[to.clone()].copy_from_slice(&other.slot[from]);
        self.from_primitive[to.clone()].copy_from_slice(&other.from_primitive[from]);
        self.from_instance[to].copy_from_slice(&other.from_instance[from]);
        self.len += other.len;
    }
}

/// What the rays of [`Paths`] hit.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Hits {
    /// Ray parameter; infinite: nothing.
    pub t: Column<f32>,
    /// Primitive, or NONE.
    pub primitive: Column<u32>,
    /// Instance, or NONE.
    pub instance: Column<u32>,
    /// Where a body begins behind the one that is hit, its material + 1, else 0; kept where bodies touch
    /// ([`Accel::has_touching`](crate::bvh::Accel::has_touching)).
    pub behind: Column<u32>,
}

/// Shadow rays: from surfaces to points on lights.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Shadows {
    /// Origin.
    pub origin: Columns,
    /// Unit direction.
    pub direction: Columns,
    /// Distance to the light.
    pub t_max: Column<f32>,
    /// What arrives at the slot if nothing is between.
    pub contribution: Columns,
    /// Slot and sum, see [`path`].
    pub slot: Column<u32>,
    /// The surface the ray leaves.
    pub from_primitive: Column<u32>,
    /// Its instance.
    pub from_instance: Column<u32>,
    /// The primitive that the ray goes to, which does not block it.
    pub target_primitive: Column<u32>,
    /// Its instance; of lights always NONE.
    pub target_instance: Column<u32>,
    /// 1: something is between.
    pub occluded: Column<u32>,
    /// Number of rays.
    pub len: usize,
}

impl Shadows {
    /// None of them; those to lights need no target's instance.
    fn new() -> Pages<Self> {
        let mut shadows: Pages<Self> = Pages::zeroed();
        shadows.target_instance.fill(NONE);
        shadows
    }
}

/// Photons of a batch, and those of them that were stored.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Photons {
    /// Pair of light and caster of each photon sent.
    pub pair: Column<u32>,
    /// Index of each photon sent among those of its pair.
    pub index: Column<u32>,
    /// Where they are stored.
    pub point: Columns,
    /// Where they came from: the last mirror, glass or glossy surface.
    pub from: Columns,
    /// Where they seem to come from ([`super::guide::cells::Photon`]).
    pub origin: Columns,
    /// Flux, the sum of its channels.
    pub flux: Column<f32>,
    /// Number of photons stored.
    pub len: usize,
}

/// What light paths bring to the film (see [`super::stages::light_paths`]); the shadow rays to the lens are in
/// [`Batch::shadows`].
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Splats {
    /// F.
    pub brings: Columns,
    /// P.
    pub by_paths: Column<f32>,
    /// D.
    pub by_light: Column<f32>,
    /// Column on the film, in pixels from the picture's left edge.
    pub x: Column<f32>,
    /// Row, from the upper edge.
    pub y: Column<f32>,
    /// How many.
    pub len: usize,
}

/// The first diffuse or glossy vertices of the paths, where pixels meet what others have found. In the order of
/// vertices, items, pixels.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Members {
    /// Where rays from here start.
    pub start: Columns,
    /// Shading normal.
    pub normal: Columns,
    /// Geometric normal.
    pub geometric: Columns,
    /// Direction to the viewer.
    pub wo: Columns,
    /// What the path carried to here times the material's colour, but for metals.
    pub weight: Columns,
    /// How it scatters: `stages::materials::Packed`.
    pub numbers: [Column<f32>; 2],
    /// Metals, from which rays are aimed: their colour at right angles, and the tint that a texture gives.
    pub colors: [Columns; 2],
    /// Probability that the path went on from here; where rays are aimed, what [`Paths::eta2`] holds.
    pub survival: Column<f32>,
    /// Where rays are aimed: what [`Paths::film`] holds.
    pub film: Column<f32>,
    /// How it scatters: `stages::materials::Packed`; and [`RAISED`].
    pub kind: Column<u32>,
    /// Slot.
    pub slot: Column<u32>,
    /// The surface.
    pub primitive: Column<u32>,
    /// Its instance.
    pub instance: Column<u32>,
    /// Not zero where some of them may lie on smooth triangles.
    pub smooth: u64,
    /// Number of members.
    pub len: usize,
}

impl Members {
    /// Moves those of the mask, from `from` on, to `to`, which does not lie behind; with what only metals have, where
    /// there may be some.
    #[inline(always)]
    pub fn keep<F: Lanes>(&mut self, from: usize, mask: F::M, to: usize, metals: bool) {
        for columns in [&mut self.start, &mut self.normal, &mut self.geometric, &mut self.wo, &mut self.weight] {
            V3::<F>::load(columns, from).compress(mask, columns, to);
        }
        for columns in self.colors.iter_mut().filter(|_| metals) {
            V3::<F>::load(columns, from).compress(mask, columns, to);
        }
        let [first, second] = &mut self.numbers;
        for column in [first, second, &mut self.survival, &mut self.film] {
            F::load(&column[from..]).compress(mask, &mut column[to..]);
        }
        for column in [&mut self.kind, &mut self.slot, &mut self.primitive, &mut self.instance] {
            F::U::load(&column[from..]).compress(mask, &mut column[to..]);
        }
    }
}

/// Added to [`Members::kind`] where `start` lies above the surface (see `Surface::start`), so that sinking rays
/// may meet it.
pub const RAISED: u32 = 1 << 31;

/// Second vertices that are diffuse: light leaves them alike in all directions. In the order of vertices, items,
/// pixels.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub struct Suffixes {
    /// The point, off the surface by its error.
    pub point: Columns,
    /// Geometric normal, on the side that light leaves.
    pub normal: Columns,
    /// Slot of the path that found it; its radiance is in the upper half of [`Batch::radiance`] there.
    pub slot: Column<u32>,
    /// The surface.
    pub primitive: Column<u32>,
    /// Its instance.
    pub instance: Column<u32>,
    /// Number of suffixes.
    pub len: usize,
}

/// A run of [`Members`] of one item whose paths have the same number of vertices: they share.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// First member.
    pub first: u32,
    /// Number of members, at most [`ITEM_PIXELS`].
    pub len: u32,
}

/// Who shares what, and what comes of it.
pub struct Groups {
    /// The groups.
    pub list: Vec<Group>,
    /// Per item: the last group of it.
    pub of_item: [u32; ITEMS],
    /// Per suffix: the group that shares it.
    pub of_suffix: Pages<Column<u32>>,
    /// Per suffix: the members of its group that do not see it or do not share it, a bit each.
    pub hidden: Pages<Column<u64>>,
    /// Per member: the light that it gets.
    pub gathered: Pages<Columns>,
}

/// All of a thread's working memory.
pub struct Batch {
    /// The items; at most [`ITEMS`].
    pub items: Vec<Item>,
    /// The pixels of the slots.
    pub pixels: Pixels,
    /// Items with glint chains (`techniques::glints`), a bit each.
    pub glints: u32,
    /// Items whose pixels share, a bit each, where any do.
    pub shares: u32,
    /// The same as words, one or zero.
    pub item_shares: [u32; ITEMS],
    /// Per item: the weight of what a path sees that has met mirrors and glass only: one, or what glint chains leave to
    /// it.
    pub glint_weight: [f32; ITEMS],
    /// The living paths.
    pub paths: Pages<Paths>,
    /// The paths after the next scattering.
    pub next: Pages<Paths>,
    /// The other ways of paths that go both ways at glass.
    pub branches: Pages<Paths>,
    /// What [`Batch::paths`] hit.
    pub hits: Pages<Hits>,
    /// Shadow rays of this bounce.
    pub shadows: Pages<Shadows>,
    /// Rays between first and second vertices of different pixels; they change places with `shadows` while they are
    /// traced.
    pub segments: Pages<Shadows>,
    /// Radiance of each slot; in the upper half (from [`PATHS`] on) what leaves the second vertex that the slot's path
    /// found.
    pub radiance: Pages<Columns>,
    /// What camera rays hit first.
    pub layers: LayerSamples,
    /// Photons on their way from the lights.
    pub photons: Pages<Photons>,
    /// What light paths bring to the film.
    pub splats: Pages<Splats>,
    /// Rough vertices of this bounce that rays may be aimed from.
    pub aimers: Pages<Members>,
    /// First vertices that share.
    pub members: Pages<Members>,
    /// Second vertices that are shared.
    pub suffixes: Pages<Suffixes>,
    /// Who shares what.
    pub groups: Groups,
    /// Indices of the rays that the tree is asked about.
    pub active: Pages<Column<u32>>,
    /// How many they are.
    pub active_len: usize,
    /// Counters.
    pub counters: Counters,
    /// Statistics, if they are wanted.
    pub watch: Watch,
}

impl Default for Batch {
    fn default() -> Self {
        Self::new()
    }
}

impl Batch {
    /// Allocates.
    pub fn new() -> Self {
        Batch {
            items: Vec::with_capacity(ITEMS),
            pixels: Pixels::new(PATHS),
            glints: 0,
            shares: u32::MAX,
            item_shares: [1; ITEMS],
            glint_weight: [1.0; ITEMS],
            paths: Pages::zeroed(),
            next: Pages::zeroed(),
            branches: Pages::zeroed(),
            layers: LayerSamples::default(),
            photons: Pages::zeroed(),
            splats: Pages::zeroed(),
            aimers: Pages::zeroed(),
            hits: Pages::zeroed(),
            shadows: Shadows::new(),
            segments: Shadows::new(),
            radiance: Pages::zeroed(),
            members: Pages::zeroed(),
            suffixes: Pages::zeroed(),
            groups: Groups {
                list: Vec::new(),
                of_item: [0; ITEMS],
                of_suffix: Pages::zeroed(),
                hidden: Pages::zeroed(),
                gathered: Pages::zeroed(),
            },
            active: Pages::zeroed(),
            active_len: 0,
            counters: Counters::default(),
            watch: Watch::default(),
        }
    }

    /// Makes ready for the items; of those with a bit set in `glints`, a path's own share of what chains see is
    /// [`WEIGHT`].
    pub fn start(&mut self) {
        for k in 0..self.items.len() {
            self.item_shares[k] = self.shares >> k & 1;
            self.glint_weight[k] = if self.glints >> k & 1 == 1 { WEIGHT } else { 1.0 };
        }
        self.pixels.find(&self.items);
        let slots = self.items.len() * ITEM_PIXELS;
        for channel in self.radiance.iter_mut() {
            channel[..slots].fill(0.0);
            channel[PATHS..PATHS + slots].fill(0.0);
        }
        (self.members.len, self.members.smooth) = (0, 0);
        self.suffixes.len = 0;
        self.groups.list.clear();
        self.groups.of_item = [0; ITEMS];
    }
}

/// The first `len` rays of columns, for the tree.
pub fn rays<'a>(
    origin: &'a Columns,
    direction: &'a Columns,
    from_primitive: &'a [u32],
    from_instance: &'a [u32],
    len: usize,
) -> Rays<'a> {
    Rays {
        ox: &origin[0][..len],
        oy: &origin[1][..len],
        oz: &origin[2][..len],
        dx: &direction[0][..len],
        dy: &direction[1][..len],
        dz: &direction[2][..len],
        from_primitive: &from_primitive[..len],
        from_instance: &from_instance[..len],
    }
}
