//! The functions of the library that are used, and one device of it. What `oidn.h` of Open Image Denoise 2 declares
//! stands here, and nothing checks that it does but a call: so whatever is loaded has to say that it is version 2.

use crate::picture::Picture;
use libloading::Library;
use std::error::Error;
use std::ffi::{CStr, c_char, c_int, c_void};
use std::path::Path;
use std::ptr::{NonNull, null};

/// `OIDN_DEVICE_TYPE_CPU`.
const CPU: c_int = 1;
/// `OIDN_FORMAT_FLOAT3`.
const FLOAT3: c_int = 3;
/// `OIDN_ERROR_NONE`.
const NO_ERROR: c_int = 0;

/// What `OIDNDevice` points to.
enum DeviceOf {}
/// What `OIDNFilter` points to.
enum FilterOf {}

type Image = unsafe extern "C" fn(
    filter: *mut FilterOf,
    name: *const c_char,
    pixels: *mut c_void,
    format: c_int,
    width: usize,
    height: usize,
    byte_offset: usize,
    pixel_stride: usize,
    row_stride: usize,
);

/// The library's functions. It stays loaded until the program ends: its threads live on behind its devices.
pub(crate) struct Functions {
    new_device: unsafe extern "C" fn(c_int) -> *mut DeviceOf,
    set_device_bool: unsafe extern "C" fn(*mut DeviceOf, *const c_char, bool),
    set_device_int: unsafe extern "C" fn(*mut DeviceOf, *const c_char, c_int),
    commit_device: unsafe extern "C" fn(*mut DeviceOf),
    device_int: unsafe extern "C" fn(*mut DeviceOf, *const c_char) -> c_int,
    device_error: unsafe extern "C" fn(*mut DeviceOf, *mut *const c_char) -> c_int,
    release_device: unsafe extern "C" fn(*mut DeviceOf),
    new_filter: unsafe extern "C" fn(*mut DeviceOf, *const c_char) -> *mut FilterOf,
    set_image: Image,
    set_filter_bool: unsafe extern "C" fn(*mut FilterOf, *const c_char, bool),
    commit_filter: unsafe extern "C" fn(*mut FilterOf),
    execute_filter: unsafe extern "C" fn(*mut FilterOf),
    release_filter: unsafe extern "C" fn(*mut FilterOf),
}

impl Functions {
    /// Loads them from a file, or a name that the system's loader knows.
    ///
    /// # Errors
    /// In the loader's words, or which function is missing.
    pub fn load(file: &Path) -> Result<Self, String> {
        // SAFETY: what a library does when it is loaded is on whoever has named it, or installed it for all programs.
        let library = unsafe { open(file) };
        let library = library.map_err(|error| error.source().map_or_else(|| error.to_string(), ToString::to_string))?;
        let functions = Functions::of(&library)
            .map_err(|name| format!("it has no function {name}, as Open Image Denoise 2 has"))?;
        std::mem::forget(library);
        Ok(functions)
    }

    fn of(library: &Library) -> Result<Self, &'static str> {
        macro_rules! function {
            ($name:literal) => {
                // SAFETY: the type is the one that oidn.h of version 2 declares, and who calls it has seen the version.
                *unsafe { library.get($name) }.map_err(|_| $name)?
            };
        }
        Ok(Functions {
            new_device: function!("oidnNewDevice"),
            set_device_bool: function!("oidnSetDeviceBool"),
            set_device_int: function!("oidnSetDeviceInt"),
            commit_device: function!("oidnCommitDevice"),
            device_int: function!("oidnGetDeviceInt"),
            device_error: function!("oidnGetDeviceError"),
            release_device: function!("oidnReleaseDevice"),
            new_filter: function!("oidnNewFilter"),
            set_image: function!("oidnSetSharedFilterImage"),
            set_filter_bool: function!("oidnSetFilterBool"),
            commit_filter: function!("oidnCommitFilter"),
            execute_filter: function!("oidnExecuteFilter"),
            release_filter: function!("oidnReleaseFilter"),
        })
    }

    /// What went wrong since this was asked last; of a device, or of this thread where there is none.
    fn error(&self, device: *mut DeviceOf) -> Result<(), Fault> {
        let mut message = null();
        // SAFETY: the device is one or null, which is allowed; the message is written or stays null.
        let code = unsafe { (self.device_error)(device, &mut message) };
        if code == NO_ERROR {
            return Ok(());
        }
        if message.is_null() {
            return Err(Fault::Library(format!("error {code}")));
        }
        // SAFETY: a text of C that lives until the device is asked for something else.
        let message = unsafe { CStr::from_ptr(message) };
        Err(Fault::Library(message.to_string_lossy().trim().to_owned()))
    }
}

/// Loads a library, and what that needs from the folder that it lies in.
///
/// # Safety
/// As of [`Library::new`]: what the library does when it is loaded must be sound.
#[cfg(not(windows))]
unsafe fn open(file: &Path) -> Result<Library, libloading::Error> {
    // SAFETY: as the caller has promised.
    unsafe { Library::new(file) }
}

/// Loads a library, and what that needs from the folder that it lies in.
///
/// # Safety
/// As of [`Library::new`]: what the library does when it is loaded must be sound.
#[cfg(windows)]
unsafe fn open(file: &Path) -> Result<Library, libloading::Error> {
    use libloading::os::windows::{LOAD_WITH_ALTERED_SEARCH_PATH, Library as OfWindows};
    let flags = if file.is_absolute() { LOAD_WITH_ALTERED_SEARCH_PATH } else { 0 };
    // SAFETY: as the caller has promised.
    unsafe { OfWindows::load_with_flags(file, flags) }.map(Into::into)
}

/// What went wrong with a picture.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// An array does not have the size that the picture tells.
    #[error("the arrays of the picture do not have three numbers for each of its pixels")]
    Size,
    /// In the library's words.
    #[error("{0}")]
    Library(String),
}

/// The processor, as a device that filters.
pub(crate) struct Device {
    functions: Functions,
    device: NonNull<DeviceOf>,
    version: [c_int; 3],
}

impl Device {
    /// Makes one of that many threads, or of as many as the library likes for 0.
    ///
    /// # Errors
    /// When the library is of another version, or the processor is none that it can use.
    pub fn new(functions: Functions, threads: usize) -> Result<Self, Fault> {
        // SAFETY: it takes a number. So do those of other versions, which have been 1 so far.
        let device = NonNull::new(unsafe { (functions.new_device)(CPU) });
        let Some(device) = device else {
            functions.error(std::ptr::null_mut())?;
            return Err(Fault::Library("there is no device".to_owned()));
        };
        let mut device = Device { functions, device, version: [0; 3] };
        let Device { functions: of, device: at, .. } = &device;
        // SAFETY: the device is there, and names are texts of C. The function is the same in all versions that have it.
        let version = unsafe { (of.device_int)(at.as_ptr(), c"version".as_ptr()) };
        device.version = [version / 10_000, version / 100 % 100, version % 100];
        let [major, minor, patch] = device.version;
        if major != 2 {
            return Err(Fault::Library(format!(
                "its version is {major}.{minor}.{patch}, and Open Image Denoise 2 is needed"
            )));
        }
        let Device { functions: of, device: at, .. } = &device;
        // SAFETY: the device is there and of version 2, and names are texts of C.
        unsafe {
            // Threads that are bound to cores would stay so for whatever else is at work here.
            (of.set_device_bool)(at.as_ptr(), c"setAffinity".as_ptr(), false);
            let threads = c_int::try_from(threads).unwrap_or(c_int::MAX);
            (of.set_device_int)(at.as_ptr(), c"numThreads".as_ptr(), threads);
            (of.commit_device)(at.as_ptr());
        }
        of.error(at.as_ptr())?;
        Ok(device)
    }

    /// Major, minor and patch.
    pub fn version(&self) -> [c_int; 3] {
        self.version
    }

    /// Filters a picture.
    ///
    /// # Errors
    /// When an array has another size; what the library says.
    pub fn denoise(&self, picture: &Picture<'_>) -> Result<Vec<f32>, Fault> {
        let Picture { width, height, color, albedo, normal } = *picture;
        let numbers = width.checked_mul(height).and_then(|pixels| pixels.checked_mul(3)).ok_or(Fault::Size)?;
        if [color, albedo, normal].iter().any(|array| array.len() != numbers) {
            return Err(Fault::Size);
        }
        let mut output = vec![0.0_f32; numbers];
        if numbers == 0 {
            return Ok(output);
        }
        let (of, device) = (&self.functions, self.device.as_ptr());
        // SAFETY: the device is there, and names are texts of C.
        let filter = NonNull::new(unsafe { (of.new_filter)(device, c"RT".as_ptr()) });
        let Some(filter) = filter.map(NonNull::as_ptr) else {
            of.error(device)?;
            return Err(Fault::Library("there is no filter RT".to_owned()));
        };
        let guides = [(c"color", color), (c"albedo", albedo), (c"normal", normal)];
        let inputs = guides.map(|(name, array)| (name, array.as_ptr().cast_mut()));
        for (name, pixels) in inputs.into_iter().chain([(c"output", output.as_mut_ptr())]) {
            // SAFETY: each array has three numbers for each pixel and outlives the filter, which is released below. The
            // filter writes to `output` alone.
            unsafe { (of.set_image)(filter, name.as_ptr(), pixels.cast(), FLOAT3, width, height, 0, 0, 0) };
        }
        // SAFETY: filter and device are there, and names are texts of C. Executing returns when it is done.
        unsafe {
            (of.set_filter_bool)(filter, c"hdr".as_ptr(), true);
            // The guides are means over the same samples: they have noise of their own.
            (of.set_filter_bool)(filter, c"cleanAux".as_ptr(), false);
            (of.commit_filter)(filter);
            (of.execute_filter)(filter);
            (of.release_filter)(filter);
        }
        of.error(device)?;
        Ok(output)
    }
}

impl Drop for Device {
    fn drop(&mut self) {
        // SAFETY: it is there, and nothing of it is used any more.
        unsafe { (self.functions.release_device)(self.device.as_ptr()) };
    }
}
