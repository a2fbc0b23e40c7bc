//! The state of one batch: structures of arrays, allocated once per thread, small enough to stay in the L2 cache.
//!
//! A batch is up to [`ITEMS`] items; an item is a block of 8x8 pixels at one sample index. Slot s is pixel s % 64 (in Z-order) of
//! item s / 64; a slot's radiance is summed in the order of its path's vertices, whatever the schedule.

use crate::scene::NONE;

/// Pixels along a block's side.
pub const BLOCK: u32 = 8;
/// Pixels in a block.
pub const BLOCK_PIXELS: usize = 64;
/// Items in a batch. 1024 paths: fewer leave the vectors of deep bounces empty, more leave the L2 cache.
pub const ITEMS: usize = 16;
/// Paths in a batch.
pub const PATHS: usize = ITEMS * BLOCK_PIXELS;
/// Room behind every array for one vector more: a compressing store writes whole registers.
const CAPACITY: usize = PATHS + 64;

/// Three columns: x, y, z or r, g, b.
pub type Columns = [Vec<f32>; 3];

fn floats() -> Vec<f32> {
    vec![0.0; CAPACITY]
}
fn words() -> Vec<u32> {
    vec![0; CAPACITY]
}
fn columns() -> Columns {
    [floats(), floats(), floats()]
}

/// One item.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Item {
    /// Block column.
    pub block_x: u32,
    /// Block row.
    pub block_y: u32,
    /// Sample index.
    pub sample: u32,
}

/// The living paths of a batch: the ray that each is about to trace and what it carries.
pub struct Paths {
    /// Number of paths.
    pub len: usize,
    /// Origin.
    pub origin: Columns,
    /// Unit direction.
    pub direction: Columns,
    /// Product of f cos / pdf so far, without the radiance scaling of refraction.
    pub throughput: Columns,
    /// Radiance scaling of refraction: product of (n_i / n_t)^2.
    pub eta2: Vec<f32>,
    /// Solid-angle density of the direction; negative when a light hit by it was not sampled otherwise (camera, mirror, glass).
    pub pdf: Vec<f32>,
    /// Slot.
    pub slot: Vec<u32>,
    /// The surface the ray leaves.
    pub from_primitive: Vec<u32>,
    /// Its instance.
    pub from_instance: Vec<u32>,
}

impl Paths {
    fn new() -> Self {
        Paths {
            len: 0,
            origin: columns(),
            direction: columns(),
            throughput: columns(),
            eta2: floats(),
            pdf: floats(),
            slot: words(),
            from_primitive: vec![NONE; CAPACITY],
            from_instance: vec![NONE; CAPACITY],
        }
    }
}

/// What the rays of [`Paths`] hit.
pub struct Hits {
    /// Ray parameter; infinite: nothing.
    pub t: Vec<f32>,
    /// Primitive, or NONE.
    pub primitive: Vec<u32>,
    /// Instance, or NONE.
    pub instance: Vec<u32>,
}

/// Shadow rays: from surfaces to points on lights.
pub struct Shadows {
    /// Number of rays.
    pub len: usize,
    /// Origin.
    pub origin: Columns,
    /// Unit direction.
    pub direction: Columns,
    /// Distance to the light.
    pub t_max: Vec<f32>,
    /// What arrives at the slot if nothing is between.
    pub contribution: Columns,
    /// Slot.
    pub slot: Vec<u32>,
    /// The surface the ray leaves.
    pub from_primitive: Vec<u32>,
    /// Its instance.
    pub from_instance: Vec<u32>,
    /// The light's own primitive.
    pub light_primitive: Vec<u32>,
    /// The instance of a light: always NONE.
    pub light_instance: Vec<u32>,
    /// 1: something is between.
    pub occluded: Vec<u32>,
}

/// What a batch counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Camera rays.
    pub camera_rays: u64,
    /// Rays that went on from a surface.
    pub scattered_rays: u64,
    /// Rays to lights.
    pub shadow_rays: u64,
    /// Samples that were not finite or negative.
    pub dropped: u64,
}

impl Counters {
    /// Adds another batch's.
    pub fn add(&mut self, other: &Counters) {
        self.camera_rays += other.camera_rays;
        self.scattered_rays += other.scattered_rays;
        self.shadow_rays += other.shadow_rays;
        self.dropped += other.dropped;
    }
}

/// All of a thread's working memory.
pub struct Batch {
    /// The items; at most [`ITEMS`].
    pub items: Vec<Item>,
    /// Z-order number of each item's block (padded to a register's table).
    pub block_z: Vec<u32>,
    /// The living paths.
    pub paths: Paths,
    /// The paths after the next scattering.
    pub next: Paths,
    /// What [`Batch::paths`] hit.
    pub hits: Hits,
    /// Shadow rays of this bounce.
    pub shadows: Shadows,
    /// Radiance of each slot.
    pub radiance: Columns,
    /// Indices of the rays that the tree is asked about.
    pub active: Vec<u32>,
    /// How many they are.
    pub active_len: usize,
    /// Counters.
    pub counters: Counters,
}

impl Batch {
    /// Allocates.
    pub fn new() -> Self {
        Batch {
            items: Vec::with_capacity(ITEMS),
            block_z: vec![0; ITEMS],
            paths: Paths::new(),
            next: Paths::new(),
            hits: Hits { t: floats(), primitive: words(), instance: words() },
            shadows: Shadows {
                len: 0,
                origin: columns(),
                direction: columns(),
                t_max: floats(),
                contribution: columns(),
                slot: words(),
                from_primitive: words(),
                from_instance: words(),
                light_primitive: words(),
                light_instance: vec![NONE; CAPACITY],
                occluded: words(),
            },
            radiance: columns(),
            active: words(),
            active_len: 0,
            counters: Counters::default(),
        }
    }
}
