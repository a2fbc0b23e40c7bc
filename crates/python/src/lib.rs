//! tracer as a module of Python.
