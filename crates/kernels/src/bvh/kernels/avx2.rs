//! AVX2 with FMA; a table of permutations stands in for compress.

use super::isa::{Isa, Isa16, Lanes, WordLanes};
use std::arch::x86_64::*;

/// Proof that the processor has AVX2, FMA, BMI 1 and 2.
#[derive(Clone, Copy)]
pub struct Avx2(());

impl Avx2 {
    /// # Safety
    /// The processor has AVX2, FMA, BMI 1 and 2.
    #[inline(always)]
    pub unsafe fn new() -> Self {
        Self(())
    }
}

impl Isa for Avx2 {
    type F8 = __m256;
    type U8 = __m256i;
    type F4 = __m128;
    type U4 = __m128i;

    #[inline(always)]
    fn splat8(self, x: f32) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_set1_ps(x) }
    }
    #[inline(always)]
    unsafe fn load8(self, p: *const f32) -> __m256 {
        // SAFETY: the token proves the instructions; the pointer is the caller's promise.
        unsafe { _mm256_load_ps(p) }
    }
    #[inline(always)]
    unsafe fn load_any8(self, p: *const f32) -> __m256 {
        // SAFETY: the token proves the instructions; the pointer is the caller's promise.
        unsafe { _mm256_loadu_ps(p) }
    }
    #[inline(always)]
    unsafe fn load_words8(self, p: *const u32) -> __m256i {
        // SAFETY: the token proves the instructions; the pointer is the caller's promise.
        unsafe { _mm256_loadu_si256(p.cast()) }
    }
    #[inline(always)]
    fn fmsub8(self, a: __m256, b: __m256, c: __m256) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_fmsub_ps(a, b, c) }
    }
    #[inline(always)]
    fn mul8(self, a: __m256, b: __m256) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_mul_ps(a, b) }
    }
    #[inline(always)]
    fn sub8(self, a: __m256, b: __m256) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_sub_ps(a, b) }
    }
    #[inline(always)]
    fn min8(self, a: __m256, b: __m256) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_min_ps(a, b) }
    }
    #[inline(always)]
    fn max8(self, a: __m256, b: __m256) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_max_ps(a, b) }
    }
    #[inline(always)]
    fn le8(self, a: __m256, b: __m256) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a, b)) as u32 }
    }
    #[inline(always)]
    fn where_le8(self, a: __m256, b: __m256, x: __m256) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_or_ps(x, _mm256_cmp_ps::<_CMP_NLE_UQ>(a, b)) }
    }
    #[inline(always)]
    fn shift_right8(self, a: __m256i, bits: u32) -> __m256i {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_srl_epi32(a, _mm_cvtsi32_si128(bits as i32)) }
    }
    #[inline(always)]
    fn permute8(self, a: __m256, index: __m256i) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_permutevar8x32_ps(a, index) }
    }
    #[inline(always)]
    fn permute_words8(self, a: __m256i, index: __m256i) -> __m256i {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_permutevar8x32_epi32(a, index) }
    }
    #[inline(always)]
    unsafe fn compress_store8(self, mask: u32, a: __m256, p: *mut f32) {
        // SAFETY: the token proves the instructions; the pointer is the caller's promise.
        unsafe { _mm256_storeu_ps(p, _mm256_permutevar8x32_ps(a, lanes_of(mask))) }
    }
    #[inline(always)]
    unsafe fn compress_store_words8(self, mask: u32, a: __m256i, p: *mut u32) {
        // SAFETY: the token proves the instructions; the pointer is the caller's promise.
        unsafe { _mm256_storeu_si256(p.cast(), _mm256_permutevar8x32_epi32(a, lanes_of(mask))) }
    }
    #[inline(always)]
    fn splat4(self, x: f32) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_set1_ps(x) }
    }
    #[inline(always)]
    fn splat_words4(self, x: u32) -> __m128i {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_set1_epi32(x as i32) }
    }
    #[inline(always)]
    unsafe fn load4(self, p: *const f32) -> __m128 {
        // SAFETY: the token proves the instructions; the pointer is the caller's promise.
        unsafe { _mm_load_ps(p) }
    }
    #[inline(always)]
    unsafe fn load_words4(self, p: *const u32) -> __m128i {
        // SAFETY: the token proves the instructions; the pointer is the caller's promise.
        unsafe { _mm_load_si128(p.cast()) }
    }
    #[inline(always)]
    fn array4(self, a: __m128) -> [f32; 4] {
        // SAFETY: the token proves the instructions.
        unsafe {
            let mut to = [0.0; 4];
            _mm_storeu_ps(to.as_mut_ptr(), a);
            to
        }
    }
    #[inline(always)]
    fn add4(self, a: __m128, b: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_add_ps(a, b) }
    }
    #[inline(always)]
    fn sub4(self, a: __m128, b: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_sub_ps(a, b) }
    }
    #[inline(always)]
    fn mul4(self, a: __m128, b: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_mul_ps(a, b) }
    }
    #[inline(always)]
    fn div4(self, a: __m128, b: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_div_ps(a, b) }
    }
    #[inline(always)]
    fn sqrt4(self, a: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_sqrt_ps(a) }
    }
    #[inline(always)]
    fn fmadd4(self, a: __m128, b: __m128, c: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_fmadd_ps(a, b, c) }
    }
    #[inline(always)]
    fn fmsub4(self, a: __m128, b: __m128, c: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_fmsub_ps(a, b, c) }
    }
    #[inline(always)]
    fn fnmadd4(self, a: __m128, b: __m128, c: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_fnmadd_ps(a, b, c) }
    }
    #[inline(always)]
    fn min4(self, a: __m128, b: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_min_ps(a, b) }
    }
    #[inline(always)]
    fn max4(self, a: __m128, b: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_max_ps(a, b) }
    }
    #[inline(always)]
    fn neg4(self, a: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_xor_ps(a, _mm_set1_ps(-0.0)) }
    }
    #[inline(always)]
    fn copysign4(self, a: __m128, b: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let sign = _mm_set1_ps(-0.0);
            _mm_or_ps(_mm_andnot_ps(sign, a), _mm_and_ps(sign, b))
        }
    }
    #[inline(always)]
    fn le4(self, a: __m128, b: __m128) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_movemask_ps(_mm_cmp_ps::<_CMP_LE_OQ>(a, b)) as u32 }
    }
    #[inline(always)]
    fn not_negative_and_not_zero4(self, a: __m128, b: __m128) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let zero = _mm_setzero_ps();
            let (first, second) = (_mm_cmp_ps::<_CMP_GE_OQ>(a, zero), _mm_cmp_ps::<_CMP_NEQ_OQ>(b, zero));
            _mm_movemask_ps(_mm_and_ps(first, second)) as u32
        }
    }
    #[inline(always)]
    fn lt4(self, a: __m128, b: __m128) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_movemask_ps(_mm_cmp_ps::<_CMP_LT_OQ>(a, b)) as u32 }
    }
    #[inline(always)]
    fn eq_words4(self, a: __m128i, b: __m128i) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_movemask_ps(_mm_castsi128_ps(_mm_cmpeq_epi32(a, b))) as u32 }
    }
    #[inline(always)]
    fn where_gt4(self, a: __m128, b: __m128, x: __m128, y: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_blendv_ps(y, x, _mm_cmp_ps::<_CMP_GT_OQ>(a, b)) }
    }
    #[inline(always)]
    fn zero_where_eq4(self, a: __m128i, b: __m128i, x: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_andnot_ps(_mm_castsi128_ps(_mm_cmpeq_epi32(a, b)), x) }
    }
}

impl Isa16 for Avx2 {
    type F16 = [__m256; 2];

    #[inline(always)]
    fn splat16(self, x: f32) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_set1_ps(x); 2] }
    }
    #[inline(always)]
    fn load16(self, from: &Lanes) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_load_ps(from.0.as_ptr()), _mm256_load_ps(from.0.as_ptr().add(8))] }
    }
    #[inline(always)]
    fn store16(self, a: [__m256; 2], to: &mut Lanes) {
        // SAFETY: the token proves the instructions.
        unsafe {
            _mm256_store_ps(to.0.as_mut_ptr(), a[0]);
            _mm256_store_ps(to.0.as_mut_ptr().add(8), a[1]);
        }
    }
    #[inline(always)]
    fn add16(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_add_ps(a[0], b[0]), _mm256_add_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn sub16(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_sub_ps(a[0], b[0]), _mm256_sub_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn mul16(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_mul_ps(a[0], b[0]), _mm256_mul_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn div16(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_div_ps(a[0], b[0]), _mm256_div_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn min16(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_min_ps(a[0], b[0]), _mm256_min_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn max16(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_max_ps(a[0], b[0]), _mm256_max_ps(a[1], b[1])] }
    }
    #[inline(always)]
    fn fmadd16(self, a: [__m256; 2], b: [__m256; 2], c: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_fmadd_ps(a[0], b[0], c[0]), _mm256_fmadd_ps(a[1], b[1], c[1])] }
    }
    #[inline(always)]
    fn fmsub16(self, a: [__m256; 2], b: [__m256; 2], c: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_fmsub_ps(a[0], b[0], c[0]), _mm256_fmsub_ps(a[1], b[1], c[1])] }
    }
    #[inline(always)]
    fn fnmadd16(self, a: [__m256; 2], b: [__m256; 2], c: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe { [_mm256_fnmadd_ps(a[0], b[0], c[0]), _mm256_fnmadd_ps(a[1], b[1], c[1])] }
    }
    #[inline(always)]
    fn abs16(self, a: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe {
            let sign = _mm256_set1_ps(-0.0);
            [_mm256_andnot_ps(sign, a[0]), _mm256_andnot_ps(sign, a[1])]
        }
    }
    #[inline(always)]
    fn copysign16(self, a: [__m256; 2], b: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe {
            let sign = _mm256_set1_ps(-0.0);
            [
                _mm256_or_ps(_mm256_andnot_ps(sign, a[0]), _mm256_and_ps(sign, b[0])),
                _mm256_or_ps(_mm256_andnot_ps(sign, a[1]), _mm256_and_ps(sign, b[1])),
            ]
        }
    }
    #[inline(always)]
    fn signs16(self, a: [__m256; 2]) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm256_movemask_ps(a[0]) as u32 | (_mm256_movemask_ps(a[1]) as u32) << 8 }
    }
    #[inline(always)]
    fn le16(self, a: [__m256; 2], b: [__m256; 2]) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let low = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a[0], b[0])) as u32;
            low | (_mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(a[1], b[1])) as u32) << 8
        }
    }
    #[inline(always)]
    fn lt16(self, a: [__m256; 2], b: [__m256; 2]) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let low = _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(a[0], b[0])) as u32;
            low | (_mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(a[1], b[1])) as u32) << 8
        }
    }
    #[inline(always)]
    fn high_bits16(self, a: &WordLanes) -> (u32, u32) {
        // SAFETY: the token proves the instructions, and lanes are aligned.
        unsafe {
            let (low, high) = (_mm256_load_si256(a.0.as_ptr().cast()), _mm256_load_si256(a.0.as_ptr().add(8).cast()));
            let signs = |low, high| {
                let (low, high) = (_mm256_castsi256_ps(low), _mm256_castsi256_ps(high));
                _mm256_movemask_ps(low) as u32 | (_mm256_movemask_ps(high) as u32) << 8
            };
            (signs(low, high), signs(_mm256_slli_epi32::<1>(low), _mm256_slli_epi32::<1>(high)))
        }
    }
    #[inline(always)]
    fn eq_words16(self, a: &WordLanes, x: u32) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let x = _mm256_set1_epi32(x as i32);
            let low = _mm256_cmpeq_epi32(_mm256_load_si256(a.0.as_ptr().cast()), x);
            let high = _mm256_cmpeq_epi32(_mm256_load_si256(a.0.as_ptr().add(8).cast()), x);
            let low = _mm256_movemask_ps(_mm256_castsi256_ps(low)) as u32;
            low | (_mm256_movemask_ps(_mm256_castsi256_ps(high)) as u32) << 8
        }
    }
    #[inline(always)]
    fn put_words16(self, mask: u32, x: u32, to: &mut WordLanes) {
        for (lane, word) in to.0.iter_mut().enumerate() {
            *word = if mask >> lane & 1 == 1 { x } else { *word };
        }
    }
    #[inline(always)]
    fn select16(self, mask: u32, x: [__m256; 2], y: [__m256; 2]) -> [__m256; 2] {
        // SAFETY: the token proves the instructions.
        unsafe {
            let bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let low = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32(mask as i32), bits), bits);
            let high = _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32((mask >> 8) as i32), bits), bits);
            [
                _mm256_blendv_ps(y[0], x[0], _mm256_castsi256_ps(low)),
                _mm256_blendv_ps(y[1], x[1], _mm256_castsi256_ps(high)),
            ]
        }
    }
    #[inline(always)]
    fn least16(self, a: [__m256; 2]) -> f32 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let both = _mm256_min_ps(a[0], a[1]);
            let four = _mm_min_ps(_mm256_castps256_ps128(both), _mm256_extractf128_ps::<1>(both));
            let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_shuffle_ps::<1>(two, two)))
        }
    }
    #[inline(always)]
    fn greatest16(self, a: [__m256; 2]) -> f32 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let both = _mm256_max_ps(a[0], a[1]);
            let four = _mm_max_ps(_mm256_castps256_ps128(both), _mm256_extractf128_ps::<1>(both));
            let two = _mm_max_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_max_ss(two, _mm_shuffle_ps::<1>(two, two)))
        }
    }
}

/// For each mask, its set lanes in order, one byte each.
static LANES_OF: [u64; 256] = {
    let mut table = [0; 256];
    let mut mask = 0;
    while mask < 256 {
        let (mut lane, mut to) = (0, 0);
        while lane < 8 {
            if mask >> lane & 1 == 1 {
                table[mask] |= lane << (8 * to);
                to += 1;
            }
            lane += 1;
        }
        mask += 1;
    }
    table
};

/// # Safety
/// The processor has AVX2.
#[inline(always)]
unsafe fn lanes_of(mask: u32) -> __m256i {
    // SAFETY: the caller's promise.
    unsafe { _mm256_cvtepu8_epi32(_mm_cvtsi64_si128(LANES_OF[(mask & 255) as usize] as i64)) }
}
