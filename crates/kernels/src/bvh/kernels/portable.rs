//! The scalar twin of the vector instruction sets, and what processors without them run.

use super::isa::{Isa, Isa16, Lanes, WordLanes};
use std::array::from_fn;

/// Arrays and loops. Any processor has these.
#[derive(Clone, Copy)]
pub struct Portable;

impl Isa for Portable {
    type F8 = [f32; 8];
    type U8 = [u32; 8];
    type F4 = [f32; 4];
    type U4 = [u32; 4];

    #[inline(always)]
    fn splat8(self, x: f32) -> [f32; 8] {
        [x; 8]
    }
    #[inline(always)]
    unsafe fn load8(self, p: *const f32) -> [f32; 8] {
        // SAFETY: the caller's promise.
        unsafe { p.cast::<[f32; 8]>().read() }
    }
    #[inline(always)]
    unsafe fn load_any8(self, p: *const f32) -> [f32; 8] {
        // SAFETY: the caller's promise.
        unsafe { p.cast::<[f32; 8]>().read() }
    }
    #[inline(always)]
    unsafe fn load_words8(self, p: *const u32) -> [u32; 8] {
        // SAFETY: the caller's promise.
        unsafe { p.cast::<[u32; 8]>().read() }
    }
    #[inline(always)]
    fn fmsub8(self, a: [f32; 8], b: [f32; 8], c: [f32; 8]) -> [f32; 8] {
        from_fn(|i| a[i].mul_add(b[i], -c[i]))
    }
    #[inline(always)]
    fn mul8(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        from_fn(|i| a[i] * b[i])
    }
    #[inline(always)]
    fn sub8(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        from_fn(|i| a[i] - b[i])
    }
    #[inline(always)]
    fn min8(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        from_fn(|i| if a[i] < b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn max8(self, a: [f32; 8], b: [f32; 8]) -> [f32; 8] {
        from_fn(|i| if a[i] > b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn le8(self, a: [f32; 8], b: [f32; 8]) -> u32 {
        (0..8).fold(0, |mask, i| mask | (u32::from(a[i] <= b[i]) << i))
    }
    #[inline(always)]
    fn where_le8(self, a: [f32; 8], b: [f32; 8], x: [f32; 8]) -> [f32; 8] {
        from_fn(|i| if a[i] <= b[i] { x[i] } else { f32::NAN })
    }
    #[inline(always)]
    fn shift_right8(self, a: [u32; 8], bits: u32) -> [u32; 8] {
        a.map(|x| x >> bits)
    }
    #[inline(always)]
    fn permute8(self, a: [f32; 8], index: [u32; 8]) -> [f32; 8] {
        index.map(|i| a[(i & 7) as usize])
    }
    #[inline(always)]
    fn permute_words8(self, a: [u32; 8], index: [u32; 8]) -> [u32; 8] {
        index.map(|i| a[(i & 7) as usize])
    }
    #[inline(always)]
    unsafe fn compress_store8(self, mask: u32, a: [f32; 8], p: *mut f32) {
        let mut to = p;
        for (i, x) in a.into_iter().enumerate() {
            if mask >> i & 1 == 1 {
                // SAFETY: at most 8 floats are written from `p` on, which the caller promises to be writable.
                unsafe {
                    to.write(x);
                    to = to.add(1);
                }
            }
        }
    }
    #[inline(always)]
    unsafe fn compress_store_words8(self, mask: u32, a: [u32; 8], p: *mut u32) {
        let mut to = p;
        for (i, x) in a.into_iter().enumerate() {
            if mask >> i & 1 == 1 {
                // SAFETY: at most 8 words are written from `p` on, which the caller promises to be writable.
                unsafe {
                    to.write(x);
                    to = to.add(1);
                }
            }
        }
    }

    #[inline(always)]
    fn splat4(self, x: f32) -> [f32; 4] {
        [x; 4]
    }
    #[inline(always)]
    fn splat_words4(self, x: u32) -> [u32; 4] {
        [x; 4]
    }
    #[inline(always)]
    unsafe fn load4(self, p: *const f32) -> [f32; 4] {
        // SAFETY: the caller's promise.
        unsafe { p.cast::<[f32; 4]>().read() }
    }
    #[inline(always)]
    unsafe fn load_words4(self, p: *const u32) -> [u32; 4] {
        // SAFETY: the caller's promise.
        unsafe { p.cast::<[u32; 4]>().read() }
    }
    #[inline(always)]
    fn array4(self, a: [f32; 4]) -> [f32; 4] {
        a
    }
    #[inline(always)]
    fn add4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        from_fn(|i| a[i] + b[i])
    }
    #[inline(always)]
    fn sub4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        from_fn(|i| a[i] - b[i])
    }
    #[inline(always)]
    fn mul4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        from_fn(|i| a[i] * b[i])
    }
    #[inline(always)]
    fn div4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        from_fn(|i| a[i] / b[i])
    }
    #[inline(always)]
    fn sqrt4(self, a: [f32; 4]) -> [f32; 4] {
        a.map(f32::sqrt)
    }
    #[inline(always)]
    fn fmadd4(self, a: [f32; 4], b: [f32; 4], c: [f32; 4]) -> [f32; 4] {
        from_fn(|i| a[i].mul_add(b[i], c[i]))
    }
    #[inline(always)]
    fn fmsub4(self, a: [f32; 4], b: [f32; 4], c: [f32; 4]) -> [f32; 4] {
        from_fn(|i| a[i].mul_add(b[i], -c[i]))
    }
    #[inline(always)]
    fn fnmadd4(self, a: [f32; 4], b: [f32; 4], c: [f32; 4]) -> [f32; 4] {
        from_fn(|i| (-a[i]).mul_add(b[i], c[i]))
    }
    #[inline(always)]
    fn min4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        from_fn(|i| if a[i] < b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn max4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        from_fn(|i| if a[i] > b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn neg4(self, a: [f32; 4]) -> [f32; 4] {
        a.map(|x| -x)
    }
    #[inline(always)]
    fn copysign4(self, a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
        from_fn(|i| a[i].copysign(b[i]))
    }
    #[inline(always)]
    fn le4(self, a: [f32; 4], b: [f32; 4]) -> u32 {
        (0..4).fold(0, |mask, i| mask | (u32::from(a[i] <= b[i]) << i))
    }
    #[inline(always)]
    fn not_negative_and_not_zero4(self, a: [f32; 4], b: [f32; 4]) -> u32 {
        (0..4).fold(0, |mask, i| mask | (u32::from(a[i] >= 0.0 && b[i] != 0.0) << i))
    }
    #[inline(always)]
    fn lt4(self, a: [f32; 4], b: [f32; 4]) -> u32 {
        (0..4).fold(0, |mask, i| mask | (u32::from(a[i] < b[i]) << i))
    }
    #[inline(always)]
    fn eq_words4(self, a: [u32; 4], b: [u32; 4]) -> u32 {
        (0..4).fold(0, |mask, i| mask | (u32::from(a[i] == b[i]) << i))
    }
    #[inline(always)]
    fn where_gt4(self, a: [f32; 4], b: [f32; 4], x: [f32; 4], y: [f32; 4]) -> [f32; 4] {
        from_fn(|i| if a[i] > b[i] { x[i] } else { y[i] })
    }
    #[inline(always)]
    fn zero_where_eq4(self, a: [u32; 4], b: [u32; 4], x: [f32; 4]) -> [f32; 4] {
        from_fn(|i| if a[i] == b[i] { 0.0 } else { x[i] })
    }
}

impl Isa16 for Portable {
    type F16 = [f32; 16];

    #[inline(always)]
    fn splat16(self, x: f32) -> [f32; 16] {
        [x; 16]
    }
    #[inline(always)]
    fn load16(self, from: &Lanes) -> [f32; 16] {
        from.0
    }
    #[inline(always)]
    fn store16(self, a: [f32; 16], to: &mut Lanes) {
        to.0 = a;
    }
    #[inline(always)]
    fn add16(self, a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        from_fn(|i| a[i] + b[i])
    }
    #[inline(always)]
    fn sub16(self, a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        from_fn(|i| a[i] - b[i])
    }
    #[inline(always)]
    fn mul16(self, a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        from_fn(|i| a[i] * b[i])
    }
    #[inline(always)]
    fn div16(self, a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        from_fn(|i| a[i] / b[i])
    }
    #[inline(always)]
    fn fmadd16(self, a: [f32; 16], b: [f32; 16], c: [f32; 16]) -> [f32; 16] {
        from_fn(|i| a[i].mul_add(b[i], c[i]))
    }
    #[inline(always)]
    fn fmsub16(self, a: [f32; 16], b: [f32; 16], c: [f32; 16]) -> [f32; 16] {
        from_fn(|i| a[i].mul_add(b[i], -c[i]))
    }
    #[inline(always)]
    fn fnmadd16(self, a: [f32; 16], b: [f32; 16], c: [f32; 16]) -> [f32; 16] {
        from_fn(|i| (-a[i]).mul_add(b[i], c[i]))
    }
    #[inline(always)]
    fn min16(self, a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        from_fn(|i| if a[i] < b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn max16(self, a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        from_fn(|i| if a[i] > b[i] { a[i] } else { b[i] })
    }
    #[inline(always)]
    fn abs16(self, a: [f32; 16]) -> [f32; 16] {
        a.map(f32::abs)
    }
    #[inline(always)]
    fn copysign16(self, a: [f32; 16], b: [f32; 16]) -> [f32; 16] {
        from_fn(|i| a[i].copysign(b[i]))
    }
    #[inline(always)]
    fn signs16(self, a: [f32; 16]) -> u32 {
        (0..16).fold(0, |mask, i| mask | (a[i].to_bits() >> 31) << i)
    }
    #[inline(always)]
    fn le16(self, a: [f32; 16], b: [f32; 16]) -> u32 {
        (0..16).fold(0, |mask, i| mask | (u32::from(a[i] <= b[i]) << i))
    }
    #[inline(always)]
    fn lt16(self, a: [f32; 16], b: [f32; 16]) -> u32 {
        (0..16).fold(0, |mask, i| mask | (u32::from(a[i] < b[i]) << i))
    }
    #[inline(always)]
    fn high_bits16(self, a: &WordLanes) -> (u32, u32) {
        let bits = |bit: u32| (0..16).fold(0, |mask, i| mask | (a.0[i] >> bit & 1) << i);
        (bits(31), bits(30))
    }
    #[inline(always)]
    fn eq_words16(self, a: &WordLanes, x: u32) -> u32 {
        (0..16).fold(0, |mask, i| mask | (u32::from(a.0[i] == x) << i))
    }
    #[inline(always)]
    fn put_words16(self, mask: u32, x: u32, to: &mut WordLanes) {
        for (lane, word) in to.0.iter_mut().enumerate() {
            *word = if mask >> lane & 1 == 1 { x } else { *word };
        }
    }
    #[inline(always)]
    fn select16(self, mask: u32, x: [f32; 16], y: [f32; 16]) -> [f32; 16] {
        from_fn(|i| if mask >> i & 1 == 1 { x[i] } else { y[i] })
    }
    #[inline(always)]
    fn least16(self, a: [f32; 16]) -> f32 {
        a.into_iter().fold(f32::INFINITY, f32::min)
    }
    #[inline(always)]
    fn greatest16(self, a: [f32; 16]) -> f32 {
        a.into_iter().fold(f32::NEG_INFINITY, f32::max)
    }
}
