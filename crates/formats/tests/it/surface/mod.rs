//! Rasters of numbers: read, written and read again, damaged, and every message.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

mod damage;
mod fixtures;
mod mistakes;
mod place;
mod round_trips;

use std::{
    fs,
    path::{Path, PathBuf},
};

use mediant_formats::{Samples, Surface, SurfaceOptions};

/// The rasters that other programs wrote, in order.
fn files() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/surfaces");
    let mut files: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|end| end != "txt" && end != "md"));
    files.sort();
    assert_eq!(files.len(), 74);
    files
}

/// Of files of several bands the second is read.
fn options(path: &Path) -> SurfaceOptions {
    let band = path.to_string_lossy().contains("bands").then_some(2);
    SurfaceOptions { band, ..SurfaceOptions::default() }
}

/// Samples that can be compared where they are NaN.
fn bits(samples: &Samples) -> (usize, Vec<u64>) {
    let kind = match samples {
        Samples::U8(_) => 0,
        Samples::U16(_) => 1,
        Samples::I16(_) => 2,
        Samples::U32(_) => 3,
        Samples::I32(_) => 4,
        Samples::F32(_) => 5,
        Samples::F64(_) => 6,
        _ => panic!("a new type of samples"),
    };
    (kind, (0..samples.len()).map(|at| samples.get(at).unwrap().to_bits()).collect())
}

/// The same of all numbers that count.
fn numbers(surface: &Surface) -> Vec<Option<u64>> {
    surface.iter().map(|number| number.map(f64::to_bits)).collect()
}
