//! Trees as they were built.

use super::file::{self, KeptError, KeptFile, KeptKind};
use super::{Key, Store, Told};
use std::sync::Arc;
use tracer_kernels::bvh::{Accel, BuildError, Geometry, Ranks, RestoreError, TreeHead};

/// Trees over fewer things are built as fast.
const LEAST_PRIMITIVES: usize = 1 << 12;

/// The tree over a geometry, kept or built; `number` makes the number of 128 bits that it goes by.
///
/// # Errors
/// Those of `build`.
pub fn build_tree(
    store: &dyn Store,
    geometry: &Geometry<'_>,
    ranks: &Ranks,
    number: u128,
    build: impl FnOnce() -> Result<Arc<Accel>, BuildError>,
) -> Result<Arc<Accel>, BuildError> {
    let triangles: usize = geometry.meshes.iter().map(|mesh| mesh.triangles.len()).sum();
    let primitives = triangles + geometry.spheres.len() + geometry.shapes.len() + geometry.instances.len();
    if primitives < LEAST_PRIMITIVES {
        return build();
    }
    let key = Key::new(KeptKind::Tree, &[&number.to_le_bytes()]);
    let name = key.name();
    if let Some(file) = store.open(&name) {
        match KeptFile::open(file).and_then(|file| Ok((file.bytes, read(&file.expect(&key)?, geometry, ranks)?))) {
            Ok((bytes, tree)) => {
                store.told(Told::Taken { what: "the tree", bytes });
                return Ok(Arc::new(tree));
            }
            Err(broken) => store.told(Told::Broken { name: &name, why: &broken.to_string() }),
        }
    }
    store.told(Told::Missing { what: "the tree" });
    let tree = build()?;
    let (kept, head, roots) = (Arc::clone(&tree), tree.head(), tree.roots());
    let bytes = file::bytes_of(&sections(&tree, &head, &roots));
    store.keep(&name, bytes, Box::new(move |to| file::write(to, &key, &sections(&kept, &head, &roots))));
    Ok(tree)
}

fn sections<'a>(tree: &'a Accel, head: &'a TreeHead, roots: &'a [u32]) -> [&'a [u8]; 3] {
    [bytemuck::bytes_of(head), bytemuck::cast_slice(roots), tree.bytes()]
}

fn read(file: &KeptFile, geometry: &Geometry<'_>, ranks: &Ranks) -> Result<Accel, KeptError> {
    let heads: Vec<TreeHead> = file.array(0)?;
    let [head] = heads[..] else { return Err(KeptError::Unfit("its arrays are not as long as they should be")) };
    let roots: Vec<u32> = file.array(1)?;
    if file.length(2)? != head.bytes {
        return Err(KeptError::Unfit("its arrays are not as long as they should be"));
    }
    Accel::restore(geometry, ranks, &head, &roots, |to| file.fill(2, to)).map_err(|error| match error {
        RestoreError::Read(broken) => broken,
        RestoreError::Unfit(why) => KeptError::Unfit(why),
        RestoreError::Memory { bytes, .. } => KeptError::Memory(bytes),
    })
}
