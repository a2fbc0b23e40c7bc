//! Numbers of names, as Cryptomatte has them: MurmurHash3_x86_32 (Austin Appleby, public domain) with seed 0, whose
//! bits are taken for those of a float.

/// The hash of a text's bytes.
pub fn murmur3(bytes: &[u8], seed: u32) -> u32 {
    let scrambled = |block: u32| block.wrapping_mul(0xcc9e_2d51).rotate_left(15).wrapping_mul(0x1b87_3593);
    let (blocks, rest) = bytes.as_chunks::<4>();
    let mut hash = seed;
    for block in blocks {
        hash ^= scrambled(u32::from_le_bytes(*block));
        hash = hash.rotate_left(13).wrapping_mul(5).wrapping_add(0xe654_6b64);
    }
    let tail = rest.iter().rev().fold(0, |tail, &byte| tail << 8 | u32::from(byte));
    // Of no bytes that is zero, and changes nothing.
    hash ^= scrambled(tail) ^ bytes.len() as u32;
    hash = (hash ^ hash >> 16).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ hash >> 13).wrapping_mul(0xc2b2_ae35);
    hash ^ hash >> 16
}

/// The number of a name in pixels: its hash, but for exponents that would make it infinite, no number, or so small that
/// some programs take it for zero (the specification's `uint32_to_float32`).
pub fn id(name: &str) -> f32 {
    let hash = murmur3(name.as_bytes(), 0);
    let exponent = hash >> 23 & 255;
    f32::from_bits(if matches!(exponent, 0 | 255) { hash ^ 1 << 23 } else { hash })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of the author's test program and of other implementations.
    #[test]
    fn hashes_are_those_of_others() {
        for (text, seed, hash) in [
            ("", 0, 0),
            ("", 1, 0x514e_28b7),
            ("", u32::MAX, 0x81f1_6f39),
            ("test", 0, 0xba6b_d213),
            ("test", 0x9747_b28c, 0x704b_81dc),
            ("Hello, world!", 0, 0xc036_3e43),
            ("Hello, world!", 0x9747_b28c, 0x2488_4cba),
            ("The quick brown fox jumps over the lazy dog", 0, 0x2e4f_f723),
            ("The quick brown fox jumps over the lazy dog", 0x9747_b28c, 0x2fa8_26cd),
            ("a", 0x9747_b28c, 0x7fa0_9ea6),
            ("aa", 0x9747_b28c, 0x5d21_1726),
            ("aaa", 0x9747_b28c, 0x283e_0130),
            ("aaaa", 0x9747_b28c, 0x5a97_808a),
            ("ππππππππ", 0x9747_b28c, 0xd58063c1),
        ] {
            assert_eq!(murmur3(text.as_bytes(), seed), hash, "{text:?} {seed:x}");
        }
        assert_eq!(murmur3(&[0, 0, 0, 0], 0), 0x2362_f9de);
        assert_eq!(murmur3(&[0x21, 0x43, 0x65, 0x87], 0x5082_edee), 0x2362_f9de);
    }

    #[test]
    fn ids_are_normal_numbers() {
        // Examples of the specification's tests.
        assert_eq!(id("hello").to_bits(), 0x248b_fa47);
        let mut mended = 0;
        for k in 0..20_000 {
            let name = format!("object {k}");
            let (hash, id) = (murmur3(name.as_bytes(), 0), id(&name));
            assert!(id.is_normal());
            mended += u32::from(id.to_bits() != hash);
        }
        // Two exponents of 256.
        assert!((100..220).contains(&mended), "{mended}");
    }
}
