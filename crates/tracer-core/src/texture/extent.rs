//! Whether a picture file can hold the pixels that its header promises, asked before they are decoded.
//!
//! Decoders reserve memory by the header, and the one for JPEG fills what is missing with grey. Here a file that is cut
//! off or whose header was damaged is found out by bounds that no whole file breaks:
//!
//! - PNG: deflate packs at most 1032 bytes into one.
//! - JPEG (baseline and progressive): each block of 8 x 8 values of a component takes at least one bit for its mean,
//!   and in baseline files one more for its end; and the file has an end marker.

/// Most bytes that deflate makes of one: 258 of a match that costs two bits.
const DEFLATE_RATIO: u64 = 1032;

/// What is wrong with the file of a PNG picture, if its header can be read.
#[expect(clippy::indexing_slicing, reason = "ten bytes are asked for first")]
pub(super) fn fault_of_png(bytes: &[u8]) -> Option<String> {
    // Signature, length and name of the chunk IHDR, then width, height, bits per sample and the kind of colour.
    let header = bytes.get(16..26)?;
    let side = |at: usize| u64::from(u32::from_be_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]]));
    let samples = match header[9] {
        2 => 3,
        4 => 2,
        6 => 4,
        _ => 1,
    };
    let row = (side(0) * samples * u64::from(header[8])).div_ceil(8);
    let needed = row.saturating_mul(side(4)) / DEFLATE_RATIO;
    (bytes.len() as u64 <= needed).then(|| too_short(side(0), side(4), bytes.len()))
}

fn too_short(width: u64, height: u64, bytes: usize) -> String {
    format!("{bytes} bytes are too few for its {width} x {height} pixels")
}

/// A JPEG frame header.
struct Frame {
    width: u64,
    height: u64,
    /// Bits that whole data take at least.
    bits: u64,
}

/// What is wrong with the file of a JPEG picture.
#[expect(clippy::indexing_slicing, reason = "places found in the rest itself")]
pub(super) fn fault_of_jpeg(bytes: &[u8]) -> Option<String> {
    const CUT_OFF: &str = "the file ends before the picture does";
    let mut rest = bytes.get(2..)?;
    let mut frame = None;
    let mut data = 0_u64;
    loop {
        // To the next marker: 0xff (perhaps several), then neither that nor a zero.
        let Some(at) = rest.windows(2).position(|pair| pair[0] == 0xff && !matches!(pair[1], 0 | 0xff)) else {
            return Some(CUT_OFF.to_owned());
        };
        let marker = rest[at + 1];
        rest = &rest[at + 2..];
        match marker {
            // End of image.
            0xd9 => break,
            // Markers that stand alone: restarts and a private one.
            0x01 | 0xd0..=0xd8 => continue,
            _ => {}
        }
        let Some(segment) = segment(rest) else { return Some(CUT_OFF.to_owned()) };
        rest = &rest[segment.len()..];
        match marker {
            0xc0..=0xc2 => frame = read_frame(segment, if marker == 0xc2 { 1 } else { 2 }),
            // Start of scan: the data go on to the next marker that is no restart.
            0xda => {
                let ends = |pair: &[u8]| pair[0] == 0xff && !matches!(pair[1], 0 | 0xff | 0xd0..=0xd7);
                let end = rest.windows(2).position(ends).unwrap_or(rest.len());
                data += end as u64;
                rest = &rest[end..];
            }
            _ => {}
        }
    }
    let Frame { width, height, bits } = frame?;
    (data * 8 < bits).then(|| too_short(width, height, bytes.len()))
}

/// A segment with its two bytes of length, which count themselves.
fn segment(rest: &[u8]) -> Option<&[u8]> {
    let length = usize::from(u16::from_be_bytes([*rest.first()?, *rest.get(1)?]));
    rest.get(..length.max(2))
}

/// A frame header: length, bits per sample, height, width, and for each component its name, factors and table.
#[expect(clippy::indexing_slicing, reason = "chunks of exactly three bytes")]
fn read_frame(segment: &[u8], bits_per_block: u64) -> Option<Frame> {
    let side = |at: usize| Some(u64::from(u16::from_be_bytes([*segment.get(at)?, *segment.get(at + 1)?])));
    let (height, width) = (side(3)?, side(5)?);
    let (mut across, mut down, mut blocks) = (1, 1, 0);
    for component in segment.get(8..)?.chunks_exact(3) {
        let (h, v) = (u64::from(component[1] >> 4), u64::from(component[1] & 15));
        across = across.max(h);
        down = down.max(v);
        blocks += h * v;
    }
    // A picture of one component has no padding to whole groups of blocks.
    let units = (width / (8 * across)) * (height / (8 * down));
    Some(Frame { width, height, bits: units * blocks * bits_per_block })
}
