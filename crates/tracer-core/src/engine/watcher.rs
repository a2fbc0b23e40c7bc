//! Who looks at a batch between the stages, to explain it. Nobody does while pictures are made, and that costs nothing:
//! it is compiled away.

use tracer_kernels::engine::batch::Batch;

/// Who looks at a batch while it is traced.
pub trait Watcher {
    /// The items, a bit each, whose pixels have paths.
    fn items(&self) -> u32 {
        u32::MAX
    }

    /// A technique has done what it does after a vertex; there were so many paths before.
    fn after_vertex(&mut self, _before: usize, _: &mut Batch) {}

    /// The paths have all ended.
    fn after_paths(&mut self, _: &Batch) {}

    /// A technique of this name has done what it does after a batch.
    fn after_batch(&mut self, _technique: &'static str, _: &Batch) {}
}

/// Nobody.
pub struct Unwatched;

impl Watcher for Unwatched {}
