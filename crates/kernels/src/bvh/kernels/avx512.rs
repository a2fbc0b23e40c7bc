//! AVX-512 (F, VL, DQ, BW): masks and compress, also in the narrower registers.

use super::isa::{Isa, Isa16, Lanes, WordLanes};
use std::arch::x86_64::*;

/// Proof that the processor has AVX-512 F, VL, DQ and BW, FMA, BMI 1 and 2.
#[derive(Clone, Copy)]
pub struct Avx512(());

impl Avx512 {
    /// # Safety
    /// The processor has AVX-512 F, VL, DQ and BW, FMA, BMI 1 and 2.
    #[inline(always)]
    pub unsafe fn new() -> Self {
        Self(())
    }
}

impl Isa for Avx512 {
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
        unsafe { u32::from(_mm256_cmp_ps_mask::<_CMP_LE_OQ>(a, b)) }
    }
    #[inline(always)]
    fn where_le8(self, a: __m256, b: __m256, x: __m256) -> __m256 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let mask = _mm256_cmp_ps_mask::<_CMP_LE_OQ>(a, b);
            _mm256_mask_mov_ps(_mm256_set1_ps(f32::NAN), mask, x)
        }
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
        unsafe { _mm256_storeu_ps(p, _mm256_maskz_compress_ps(mask as u8, a)) }
    }
    #[inline(always)]
    unsafe fn compress_store_words8(self, mask: u32, a: __m256i, p: *mut u32) {
        // SAFETY: the token proves the instructions; the pointer is the caller's promise.
        unsafe { _mm256_storeu_si256(p.cast(), _mm256_maskz_compress_epi32(mask as u8, a)) }
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
            _mm_castsi128_ps(_mm_ternarylogic_epi32::<0xE4>(
                _mm_castps_si128(a),
                _mm_castps_si128(b),
                _mm_set1_epi32(i32::MAX),
            ))
        }
    }
    #[inline(always)]
    fn le4(self, a: __m128, b: __m128) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { u32::from(_mm_cmp_ps_mask::<_CMP_LE_OQ>(a, b)) }
    }
    #[inline(always)]
    fn not_negative_and_not_zero4(self, a: __m128, b: __m128) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let zero = _mm_setzero_ps();
            let mask = _mm_cmp_ps_mask::<_CMP_GE_OQ>(a, zero);
            u32::from(_mm_mask_cmp_ps_mask::<_CMP_NEQ_OQ>(mask, b, zero))
        }
    }
    #[inline(always)]
    fn lt4(self, a: __m128, b: __m128) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { u32::from(_mm_cmp_ps_mask::<_CMP_LT_OQ>(a, b)) }
    }
    #[inline(always)]
    fn eq_words4(self, a: __m128i, b: __m128i) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { u32::from(_mm_cmpeq_epi32_mask(a, b)) }
    }
    #[inline(always)]
    fn where_gt4(self, a: __m128, b: __m128, x: __m128, y: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_mask_blend_ps(_mm_cmp_ps_mask::<_CMP_GT_OQ>(a, b), y, x) }
    }
    #[inline(always)]
    fn zero_where_eq4(self, a: __m128i, b: __m128i, x: __m128) -> __m128 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm_maskz_mov_ps(_mm_cmpneq_epi32_mask(a, b), x) }
    }
}

impl Isa16 for Avx512 {
    type F16 = __m512;

    #[inline(always)]
    fn splat16(self, x: f32) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_set1_ps(x) }
    }
    #[inline(always)]
    fn load16(self, from: &Lanes) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_load_ps(from.0.as_ptr()) }
    }
    #[inline(always)]
    fn store16(self, a: __m512, to: &mut Lanes) {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_store_ps(to.0.as_mut_ptr(), a) }
    }
    #[inline(always)]
    fn add16(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_add_ps(a, b) }
    }
    #[inline(always)]
    fn sub16(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_sub_ps(a, b) }
    }
    #[inline(always)]
    fn mul16(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_mul_ps(a, b) }
    }
    #[inline(always)]
    fn div16(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_div_ps(a, b) }
    }
    #[inline(always)]
    fn min16(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_min_ps(a, b) }
    }
    #[inline(always)]
    fn max16(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_max_ps(a, b) }
    }
    #[inline(always)]
    fn fmadd16(self, a: __m512, b: __m512, c: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_fmadd_ps(a, b, c) }
    }
    #[inline(always)]
    fn fmsub16(self, a: __m512, b: __m512, c: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_fmsub_ps(a, b, c) }
    }
    #[inline(always)]
    fn fnmadd16(self, a: __m512, b: __m512, c: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_fnmadd_ps(a, b, c) }
    }
    #[inline(always)]
    fn abs16(self, a: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_abs_ps(a) }
    }
    #[inline(always)]
    fn copysign16(self, a: __m512, b: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let sign = _mm512_set1_ps(-0.0);
            _mm512_or_ps(_mm512_andnot_ps(sign, a), _mm512_and_ps(sign, b))
        }
    }
    #[inline(always)]
    fn signs16(self, a: __m512) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { u32::from(_mm512_movepi32_mask(_mm512_castps_si512(a))) }
    }
    #[inline(always)]
    fn le16(self, a: __m512, b: __m512) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { u32::from(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(a, b)) }
    }
    #[inline(always)]
    fn lt16(self, a: __m512, b: __m512) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe { u32::from(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b)) }
    }
    #[inline(always)]
    fn high_bits16(self, a: &WordLanes) -> (u32, u32) {
        // SAFETY: the token proves the instructions, and lanes are aligned.
        unsafe {
            let a = _mm512_load_si512(a.0.as_ptr().cast());
            let signs = |a| u32::from(_mm512_movepi32_mask(a));
            (signs(a), signs(_mm512_slli_epi32::<1>(a)))
        }
    }
    #[inline(always)]
    fn eq_words16(self, a: &WordLanes, x: u32) -> u32 {
        // SAFETY: the token proves the instructions.
        unsafe {
            let a = _mm512_load_si512(a.0.as_ptr().cast());
            u32::from(_mm512_cmpeq_epi32_mask(a, _mm512_set1_epi32(x as i32)))
        }
    }
    #[inline(always)]
    fn put_words16(self, mask: u32, x: u32, to: &mut WordLanes) {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_mask_store_epi32(to.0.as_mut_ptr().cast(), mask as u16, _mm512_set1_epi32(x as i32)) }
    }
    #[inline(always)]
    fn select16(self, mask: u32, x: __m512, y: __m512) -> __m512 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_mask_blend_ps(mask as u16, y, x) }
    }
    #[inline(always)]
    fn least16(self, a: __m512) -> f32 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_reduce_min_ps(a) }
    }
    #[inline(always)]
    fn greatest16(self, a: __m512) -> f32 {
        // SAFETY: the token proves the instructions.
        unsafe { _mm512_reduce_max_ps(a) }
    }
}
