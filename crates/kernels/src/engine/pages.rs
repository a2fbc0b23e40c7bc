//! Memory that costs nothing until it is written.

use bytemuck::Pod;
use memmap2::MmapMut;
use std::alloc::{Layout, handle_alloc_error};
use std::marker::PhantomData;
use std::ops::{Deref, DerefMut};

/// A value of zeros on pages of its own, which the system gives when they are first written. An allocator gives memory
/// again that was freed, and writes zeros into all of it. That the value can be copied is what reading it from bytes
/// asks for: nobody copies it.
pub struct Pages<T> {
    map: MmapMut,
    of: PhantomData<T>,
}

impl<T: Pod> Pages<T> {
    /// All bits zero.
    pub fn zeroed() -> Self {
        match MmapMut::map_anon(size_of::<T>().max(1)) {
            Ok(map) => Pages { map, of: PhantomData },
            Err(_) => {
                // So that who listens to the allocator knows what was refused.
                let _ = Vec::<u8>::new().try_reserve_exact(size_of::<T>());
                handle_alloc_error(Layout::new::<T>())
            }
        }
    }
}

impl<T: Pod> Deref for Pages<T> {
    type Target = T;
    #[inline(always)]
    fn deref(&self) -> &T {
        bytemuck::from_bytes(&self.map[..size_of::<T>()])
    }
}

impl<T: Pod> DerefMut for Pages<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut T {
        bytemuck::from_bytes_mut(&mut self.map[..size_of::<T>()])
    }
}
