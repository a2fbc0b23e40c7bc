//! Where the paths of a trial begin: all over the picture, few of them.

use tracer_kernels::sampling::blocks::{Block, Item, QUARTERS, TILE};
use tracer_kernels::sampling::sampler::hash3;
use tracer_kernels::scene::Scene;

/// How many quarters of tiles a picture has.
pub fn quarters(scene: &Scene) -> u64 {
    let [across, down] = scene.size.map(|size| size.div_ceil(TILE));
    u64::from(across) * u64::from(down) * u64::from(QUARTERS)
}

/// One of the k-th of so many equal shares of all quarters of the picture; where these are fewer, at another sample
/// index.
pub fn stratified(scene: &Scene, seed: u32, k: u32, count: u32) -> Item {
    let (across, all) = (scene.size[0].div_ceil(TILE), quarters(scene));
    let (sample, k) = ((u64::from(k) / all) as u32, u64::from(k) % all);
    let count = u64::from(count).min(all);
    let (first, end) = (all * k / count, (all * (k + 1) / count).max(all * k / count + 1).min(all));
    let quarter = first + hash3(seed, 0x001d_17ed, k as u32) % (end - first).max(1);
    let (tile, quarter) = ((quarter / u64::from(QUARTERS)) as u32, (quarter % u64::from(QUARTERS)) as u32);
    Item { block: Block::straight([tile % across, tile / across].map(|tile| tile as i32)), quarter, sample, resting: 0 }
}
