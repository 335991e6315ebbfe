//! Tables by Arrow's C stream interface, which polars, pyarrow, DuckDB and pandas read:
//! the structures of its specification, by hand, over numbers that stay where they are.
//!
//! A stream yields one batch, a structure of columns of doubles. Whoever is given it owns
//! what `release` frees.
//!
//! This is the only file with unsafe code. NumPy reads columns in place by
//! `__array_interface__`: the buffer protocol is not in the stable interface of 3.10.
#![allow(
    unsafe_code,
    reason = "the interface is one of C: structures with pointers and functions to free them"
)]

use crate::answer::Table;
use pyo3::prelude::*;
use pyo3::types::PyCapsule;
use std::ffi::{CStr, CString, c_char, c_int, c_void};
use std::ptr::{null, null_mut};
use std::sync::Arc;

/// `struct ArrowSchema`.
#[repr(C)]
struct Schema {
    format: *const c_char,
    name: *const c_char,
    metadata: *const c_char,
    flags: i64,
    n_children: i64,
    children: *mut *mut Schema,
    dictionary: *mut Schema,
    release: Option<unsafe extern "C" fn(*mut Schema)>,
    private: *mut c_void,
}

/// `struct ArrowArray`.
#[repr(C)]
struct Array {
    length: i64,
    null_count: i64,
    offset: i64,
    n_buffers: i64,
    n_children: i64,
    buffers: *mut *const c_void,
    children: *mut *mut Array,
    dictionary: *mut Array,
    release: Option<unsafe extern "C" fn(*mut Array)>,
    private: *mut c_void,
}

/// `struct ArrowArrayStream`.
#[repr(C)]
struct Stream {
    get_schema: Option<unsafe extern "C" fn(*mut Stream, *mut Schema) -> c_int>,
    get_next: Option<unsafe extern "C" fn(*mut Stream, *mut Array) -> c_int>,
    get_last_error: Option<unsafe extern "C" fn(*mut Stream) -> *const c_char>,
    release: Option<unsafe extern "C" fn(*mut Stream)>,
    private: *mut c_void,
}

// SAFETY: what the pointer leads to is `Source`, which is Send.
unsafe impl Send for Stream {}

impl Drop for Stream {
    fn drop(&mut self) {
        if let Some(release) = self.release {
            // SAFETY: nobody has released it, else there were no `release`.
            unsafe { release(self) };
        }
    }
}

/// What a stream yields.
struct Source {
    table: Arc<dyn Table>,
    done: bool,
}

/// What a schema owns.
struct OwnedSchema {
    _name: CString,
    _metadata: Vec<u8>,
    children: Vec<*mut Schema>,
}

/// What an array owns.
struct OwnedArray {
    _table: Option<Arc<dyn Table>>,
    _buffers: Vec<*const c_void>,
    children: Vec<*mut Array>,
}

/// The capsule `arrow_array_stream` of a table.
pub(crate) fn stream(py: Python<'_>, table: Arc<dyn Table>) -> PyResult<Bound<'_, PyCapsule>> {
    let source = Box::new(Source { table, done: false });
    let stream = Stream {
        get_schema: Some(get_schema),
        get_next: Some(get_next),
        get_last_error: Some(get_last_error),
        release: Some(release_stream),
        private: Box::into_raw(source).cast(),
    };
    // Whoever takes the stream over clears `release`; else it is freed with the capsule.
    PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
}

unsafe extern "C" fn get_schema(stream: *mut Stream, out: *mut Schema) -> c_int {
    // SAFETY: the caller gives a stream that is not released, of this module.
    let source = unsafe { &*(*stream).private.cast::<Source>() };
    let children = source.table.heads().into_iter().map(|(name, unit)| {
        let unit = metadata(&unit);
        Box::into_raw(Box::new(schema(c"g", &name, unit, Vec::new())))
    });
    let whole = schema(c"+s", "", Vec::new(), children.collect());
    // SAFETY: `out` is a place for a schema.
    unsafe { out.write(whole) };
    0
}

unsafe extern "C" fn get_next(stream: *mut Stream, out: *mut Array) -> c_int {
    // SAFETY: as in `get_schema`; the caller has it for itself.
    let source = unsafe { &mut *(*stream).private.cast::<Source>() };
    if source.done {
        // SAFETY: `out` is a place for an array; one that is released ends the stream.
        unsafe { out.write(ended()) };
        return 0;
    }
    source.done = true;
    let count = source.table.heads().len();
    let length = match count {
        0 => 0,
        _ => source.table.values(0).len(),
    };
    let children = (0..count).map(|index| {
        let values = source.table.values(index);
        let buffers = vec![null(), values.as_ptr().cast()];
        let table = Some(Arc::clone(&source.table));
        Box::into_raw(Box::new(array(length, buffers, Vec::new(), table)))
    });
    let whole = array(length, vec![null()], children.collect(), None);
    // SAFETY: `out` is a place for an array.
    unsafe { out.write(whole) };
    0
}

unsafe extern "C" fn get_last_error(_: *mut Stream) -> *const c_char {
    null()
}

unsafe extern "C" fn release_stream(stream: *mut Stream) {
    // SAFETY: the caller gives a stream of this module and releases it once.
    unsafe {
        drop(Box::from_raw((*stream).private.cast::<Source>()));
        (*stream).private = null_mut();
        (*stream).release = None;
    }
}

/// Text of the unit as metadata of a column: number of pairs, then lengths and bytes.
fn metadata(unit: &str) -> Vec<u8> {
    if unit.is_empty() {
        return Vec::new();
    }
    let mut bytes = 1i32.to_ne_bytes().to_vec();
    for text in ["unit", unit] {
        let length = i32::try_from(text.len()).unwrap_or(0);
        bytes.extend(length.to_ne_bytes());
        bytes.extend(text.as_bytes());
    }
    bytes
}

fn schema(format: &'static CStr, name: &str, unit: Vec<u8>, children: Vec<*mut Schema>) -> Schema {
    let mut owned = Box::new(OwnedSchema {
        // Names of objects hold no zero byte.
        _name: CString::new(name).unwrap_or_default(),
        _metadata: unit,
        children,
    });
    Schema {
        format: format.as_ptr(),
        name: owned._name.as_ptr(),
        metadata: match owned._metadata.is_empty() {
            true => null(),
            false => owned._metadata.as_ptr().cast(),
        },
        flags: 0,
        n_children: i64::try_from(owned.children.len()).unwrap_or(0),
        children: owned.children.as_mut_ptr(),
        dictionary: null_mut(),
        release: Some(release_schema),
        private: Box::into_raw(owned).cast(),
    }
}

unsafe extern "C" fn release_schema(schema: *mut Schema) {
    // SAFETY: the caller gives a schema of this module and releases it once. Children that
    // were moved elsewhere have no `release` any more.
    unsafe {
        let owned = Box::from_raw((*schema).private.cast::<OwnedSchema>());
        for &child in &owned.children {
            if let Some(release) = (*child).release {
                release(child);
            }
            drop(Box::from_raw(child));
        }
        (*schema).private = null_mut();
        (*schema).release = None;
    }
}

fn array(
    length: usize,
    buffers: Vec<*const c_void>,
    children: Vec<*mut Array>,
    table: Option<Arc<dyn Table>>,
) -> Array {
    let mut owned = Box::new(OwnedArray {
        _table: table,
        _buffers: buffers,
        children,
    });
    Array {
        length: i64::try_from(length).unwrap_or(0),
        null_count: 0,
        offset: 0,
        n_buffers: i64::try_from(owned._buffers.len()).unwrap_or(0),
        n_children: i64::try_from(owned.children.len()).unwrap_or(0),
        buffers: owned._buffers.as_mut_ptr(),
        children: owned.children.as_mut_ptr(),
        dictionary: null_mut(),
        release: Some(release_array),
        private: Box::into_raw(owned).cast(),
    }
}

/// An array that is released: the end of a stream.
fn ended() -> Array {
    Array {
        length: 0,
        null_count: 0,
        offset: 0,
        n_buffers: 0,
        n_children: 0,
        buffers: null_mut(),
        children: null_mut(),
        dictionary: null_mut(),
        release: None,
        private: null_mut(),
    }
}

unsafe extern "C" fn release_array(array: *mut Array) {
    // SAFETY: as in `release_schema`.
    unsafe {
        let owned = Box::from_raw((*array).private.cast::<OwnedArray>());
        for &child in &owned.children {
            if let Some(release) = (*child).release {
                release(child);
            }
            drop(Box::from_raw(child));
        }
        (*array).private = null_mut();
        (*array).release = None;
    }
}
