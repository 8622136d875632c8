//! HDF5 files that are made in memory, so that every byte reaches the disk by calls of ours whose results are looked at.
//!
//! HDF5 keeps small blocks back until an object is closed, and the library's wrapper drops objects without a look at what
//! closing them gave: written to a disk that is full, a file would be broken and the program none the wiser.

use hdf5::{File, Group};
use hdf5_sys::h5f::{H5Fget_file_image, H5Fget_vfd_handle};
use hdf5_sys::h5p::H5P_DEFAULT;
use std::ffi::c_void;

/// Bytes by which the memory of a file grows.
const INCREMENT: usize = 1 << 20;

/// Makes a file, and hands its bytes to `take`.
pub fn make<T>(build: impl FnOnce(&File) -> hdf5::Result<()>, take: impl FnOnce(&[u8]) -> T) -> hdf5::Result<T> {
    let mut options = File::with_options();
    options.with_fapl(|access| access.core_options(INCREMENT, false).libver_v18());
    // The same numbers give the same bytes, whenever they are written.
    options.with_fcpl(|create| create.obj_track_times(false));
    // The name is for HDF5's own table of open files; no file of this name is looked for or made.
    let file = options.create("in memory")?;
    build(&file)?;
    file.flush()?;
    let taken = take(bytes(&file)?);
    file.close()?;
    Ok(taken)
}

/// What the file consists of, as long as it is open and nothing is written to it.
fn bytes(file: &File) -> hdf5::Result<&[u8]> {
    let (id, mut handle) = (file.id(), std::ptr::null_mut::<c_void>());
    // SAFETY: the library is called under its wrapper's lock, with a valid file; no buffer asks for the size alone, and the
    // handle of HDF5's core driver is the address of the pointer to the file's bytes.
    let (length, got) = hdf5::sync::sync(|| unsafe {
        (H5Fget_file_image(id, std::ptr::null_mut(), 0), H5Fget_vfd_handle(id, H5P_DEFAULT, &raw mut handle))
    });
    if length <= 0 || got < 0 || handle.is_null() {
        return Err("HDF5 does not give the bytes of a file in memory".into());
    }
    // SAFETY: the driver holds at least as many bytes as the file is long, and they stay where they are until the file is
    // written to or closed, which the borrow of the file forbids.
    Ok(unsafe { std::slice::from_raw_parts(*handle.cast::<*const u8>(), length as usize) })
}

/// A group that does not tell when it was made.
pub fn group(parent: &Group, name: &str) -> hdf5::Result<Group> {
    parent.create_group_builder().obj_track_times(false).create(name)
}
