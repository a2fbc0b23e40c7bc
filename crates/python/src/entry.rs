//! How Python finds the module.

use crate::scene;
use pyo3::ffi;
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyModule};
use std::ptr;
use tracer_core::LayerSet;

/// Makes the module; Python calls it when the module is imported.
#[allow(unsafe_code)]
#[unsafe(no_mangle)]
pub extern "C" fn PyInit__native() -> *mut ffi::PyObject {
    // It lives as long as the process, as modules of the limited interface do.
    let definition = Box::leak(Box::new(ffi::PyModuleDef {
        m_base: ffi::PyModuleDef_HEAD_INIT,
        m_name: c"_native".as_ptr(),
        m_doc: c"What the package tracer is built on.".as_ptr(),
        m_size: -1,
        m_methods: ptr::null_mut(),
        m_slots: ptr::null_mut(),
        m_traverse: None,
        m_clear: None,
        m_free: None,
    }));
    Python::attach(|py| {
        // SAFETY: the definition is whole and stays; Python is attached. It gives a new module, or null with an error.
        let made =
            unsafe { Bound::from_owned_ptr_or_err(py, ffi::PyModule_Create2(definition, ffi::PYTHON_API_VERSION)) };
        match made.and_then(filled) {
            Ok(module) => module.into_ptr(),
            Err(error) => {
                error.restore(py);
                ptr::null_mut()
            }
        }
    })
}

fn filled(module: Bound<'_, PyAny>) -> PyResult<Bound<'_, PyAny>> {
    let py = module.py();
    let made: &Bound<'_, PyModule> = module.cast()?;
    let load = PyCFunction::new_closure(
        py,
        Some(c"load"),
        Some(c"load(request) -> dict: reads and compiles a scene; what is wrong with it comes back, too."),
        |args, _| scene::load(args),
    )?;
    made.add("load", load)?;
    made.add("version", env!("CARGO_PKG_VERSION"))?;
    made.add("layers", LayerSet::all().names().collect::<Vec<_>>())?;
    Ok(module)
}
