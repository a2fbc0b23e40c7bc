//! The vector operations that the kernels are written over.
//!
//! An [`Isa`] value is a token: that one exists proves that the processor has its instructions, so the arithmetic needs
//! no `unsafe` above this line; only loads and stores through pointers do. Every function is `inline(always)`, because
//! an intrinsic that is not inlined into a function with its target feature becomes a call (some 20 times slower). All
//! operations but the memory ones are IEEE single operations lane by lane: any two `Isa`s give the same bits.

/// 8-wide boxes and 4-wide leaves.
pub trait Isa: Copy {
    type F8: Copy;
    type U8: Copy;
    type F4: Copy;
    type U4: Copy;

    fn splat8(self, x: f32) -> Self::F8;
    /// # Safety
    /// `p` points to 8 readable floats, aligned to 32 bytes.
    unsafe fn load8(self, p: *const f32) -> Self::F8;
    /// # Safety
    /// `p` points to 8 readable floats.
    unsafe fn load_any8(self, p: *const f32) -> Self::F8;
    /// # Safety
    /// `p` points to 8 readable words.
    unsafe fn load_words8(self, p: *const u32) -> Self::U8;
    /// a·b − c, rounded once.
    fn fmsub8(self, a: Self::F8, b: Self::F8, c: Self::F8) -> Self::F8;
    fn mul8(self, a: Self::F8, b: Self::F8) -> Self::F8;
    fn sub8(self, a: Self::F8, b: Self::F8) -> Self::F8;
    /// a < b ? a : b
    fn min8(self, a: Self::F8, b: Self::F8) -> Self::F8;
    /// a > b ? a : b
    fn max8(self, a: Self::F8, b: Self::F8) -> Self::F8;
    /// Bit i set where a[i] <= b[i].
    fn le8(self, a: Self::F8, b: Self::F8) -> u32;
    /// x where a <= b, NaN elsewhere.
    fn where_le8(self, a: Self::F8, b: Self::F8, x: Self::F8) -> Self::F8;
    fn shift_right8(self, a: Self::U8, bits: u32) -> Self::U8;
    /// a[index[i] & 7]
    fn permute8(self, a: Self::F8, index: Self::U8) -> Self::F8;
    /// a[index[i] & 7]
    fn permute_words8(self, a: Self::U8, index: Self::U8) -> Self::U8;
    /// Writes the lanes of `mask` one after another; what follows them, up to 8 lanes, is written with anything.
    /// # Safety
    /// `p` points to 8 writable floats.
    unsafe fn compress_store8(self, mask: u32, a: Self::F8, p: *mut f32);
    /// As [`compress_store8`](Self::compress_store8).
    /// # Safety
    /// `p` points to 8 writable words.
    unsafe fn compress_store_words8(self, mask: u32, a: Self::U8, p: *mut u32);

    fn splat4(self, x: f32) -> Self::F4;
    fn splat_words4(self, x: u32) -> Self::U4;
    /// # Safety
    /// `p` points to 4 readable floats, aligned to 16 bytes.
    unsafe fn load4(self, p: *const f32) -> Self::F4;
    /// # Safety
    /// `p` points to 4 readable words, aligned to 16 bytes.
    unsafe fn load_words4(self, p: *const u32) -> Self::U4;
    fn array4(self, a: Self::F4) -> [f32; 4];
    fn add4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn sub4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn mul4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn div4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn sqrt4(self, a: Self::F4) -> Self::F4;
    /// a·b + c, rounded once.
    fn fmadd4(self, a: Self::F4, b: Self::F4, c: Self::F4) -> Self::F4;
    /// a·b − c, rounded once.
    fn fmsub4(self, a: Self::F4, b: Self::F4, c: Self::F4) -> Self::F4;
    /// −a·b + c, rounded once.
    fn fnmadd4(self, a: Self::F4, b: Self::F4, c: Self::F4) -> Self::F4;
    /// a < b ? a : b
    fn min4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    /// a > b ? a : b
    fn max4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    fn neg4(self, a: Self::F4) -> Self::F4;
    /// The magnitude of a with the sign of b.
    fn copysign4(self, a: Self::F4, b: Self::F4) -> Self::F4;
    /// Bit i set where a[i] <= b[i].
    fn le4(self, a: Self::F4, b: Self::F4) -> u32;
    /// Bit i set where a[i] >= 0 and b[i] != 0.
    fn not_negative_and_not_zero4(self, a: Self::F4, b: Self::F4) -> u32;
    /// Bit i set where a[i] < b[i].
    fn lt4(self, a: Self::F4, b: Self::F4) -> u32;
    /// Bit i set where a[i] = b[i].
    fn eq_words4(self, a: Self::U4, b: Self::U4) -> u32;
    /// x where a > b, y elsewhere.
    fn where_gt4(self, a: Self::F4, b: Self::F4, x: Self::F4, y: Self::F4) -> Self::F4;
    /// 0 where a = b, x elsewhere.
    fn zero_where_eq4(self, a: Self::U4, b: Self::U4, x: Self::F4) -> Self::F4;
}

/// 16 rays side by side. Masks are words: bit i for lane i.
pub trait Isa16: Isa {
    type F16: Copy;

    fn splat16(self, x: f32) -> Self::F16;
    fn load16(self, from: &Lanes) -> Self::F16;
    fn store16(self, a: Self::F16, to: &mut Lanes);
    fn add16(self, a: Self::F16, b: Self::F16) -> Self::F16;
    fn sub16(self, a: Self::F16, b: Self::F16) -> Self::F16;
    fn mul16(self, a: Self::F16, b: Self::F16) -> Self::F16;
    fn div16(self, a: Self::F16, b: Self::F16) -> Self::F16;
    /// a·b + c, rounded once.
    fn fmadd16(self, a: Self::F16, b: Self::F16, c: Self::F16) -> Self::F16;
    /// a·b − c, rounded once.
    fn fmsub16(self, a: Self::F16, b: Self::F16, c: Self::F16) -> Self::F16;
    /// −a·b + c, rounded once.
    fn fnmadd16(self, a: Self::F16, b: Self::F16, c: Self::F16) -> Self::F16;
    /// a < b ? a : b
    fn min16(self, a: Self::F16, b: Self::F16) -> Self::F16;
    /// a > b ? a : b
    fn max16(self, a: Self::F16, b: Self::F16) -> Self::F16;
    fn abs16(self, a: Self::F16) -> Self::F16;
    /// The magnitude of a with the sign of b.
    fn copysign16(self, a: Self::F16, b: Self::F16) -> Self::F16;
    /// Lanes whose sign bit is set.
    fn signs16(self, a: Self::F16) -> u32;
    fn le16(self, a: Self::F16, b: Self::F16) -> u32;
    fn lt16(self, a: Self::F16, b: Self::F16) -> u32;
    /// Lanes whose words have bit 31 set, and those whose words have bit 30 set.
    fn high_bits16(self, a: &WordLanes) -> (u32, u32);
    /// Lanes whose word equals `x`.
    fn eq_words16(self, a: &WordLanes, x: u32) -> u32;
    /// Writes x into the lanes of `mask`.
    fn put_words16(self, mask: u32, x: u32, to: &mut WordLanes);
    /// x in the lanes of `mask`, y elsewhere.
    fn select16(self, mask: u32, x: Self::F16, y: Self::F16) -> Self::F16;
    /// The least of all lanes; none may be NaN.
    fn least16(self, a: Self::F16) -> f32;
    /// The greatest of all lanes; none may be NaN.
    fn greatest16(self, a: Self::F16) -> f32;
}

/// One float for each of 16 rays.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub struct Lanes(pub [f32; 16]);

/// One word for each of 16 rays.
#[repr(C, align(64))]
#[derive(Clone, Copy, Debug)]
pub struct WordLanes(pub [u32; 16]);
