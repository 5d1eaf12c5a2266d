//! Bytes that the library made.

#![allow(unsafe_code, reason = "functions of C")]

use std::sync::Arc;

use crate::{
    code::Code,
    failure::{Failure, call},
    handles::{Held, Kind, Table},
    memory,
};

/// Bytes that the library made. `{0}` is none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct BytesHandle {
    /// Its number.
    pub id: u64,
}

impl Held for Vec<u8> {
    type Kept = Arc<Self>;

    fn handles() -> &'static Table<Arc<Self>> {
        static HANDLES: Table<Arc<Vec<u8>>> = Table::new(Kind::Bytes);
        &HANDLES
    }
}

impl BytesHandle {
    /// Keeps bytes, and writes their handle.
    ///
    /// # Safety
    /// As for [`memory::put`].
    pub(crate) unsafe fn put(bytes: Vec<u8>, place: *mut Self) -> Result<(), Failure> {
        memory::check_place("bytes", place)?;
        let id = Vec::<u8>::handles().share(bytes)?;
        // SAFETY: the caller promises it.
        unsafe { memory::put("bytes", place, Self { id }) }
    }
}

/// Where the bytes are, and how many. They stay until they are freed.
///
/// # Safety
/// `data` leads to memory for a pointer, `size` to a number's.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn mediant_bytes_data(
    bytes: BytesHandle,
    data: *mut *const u8,
    size: *mut usize,
) -> Code {
    call(|| {
        memory::check_place("size", size)?;
        let bytes = Vec::<u8>::handles().get(bytes.id)?;
        // SAFETY: the caller promises it.
        unsafe {
            memory::put("data", data, bytes.as_ptr())?;
            memory::put("size", size, bytes.len())
        }
    })
}

/// Frees bytes.
#[unsafe(no_mangle)]
pub extern "C" fn mediant_bytes_free(bytes: BytesHandle) -> Code {
    call(|| Vec::<u8>::handles().free(bytes.id))
}
