//! PFM, the portable float map (Paul Debevec): a text header, then rows of RGB floats from the bottom of the picture to
//! its top. A negative scale says little-endian.

use tracer_core::Image;

pub(super) fn encode(image: &Image) -> Vec<u8> {
    let mut bytes = format!("PF\n{} {}\n-1.0\n", image.width, image.height).into_bytes();
    bytes.reserve_exact(4 * image.linear.len());
    for row in image.linear.chunks_exact(3 * image.width as usize).rev() {
        bytes.extend(row.iter().flat_map(|x| x.to_le_bytes()));
    }
    bytes
}
