//! Rasters of numbers.

use std::io::Cursor;

use mediant_formats::{GeoTiffOptions, Surface, SurfaceFormat, SurfaceOptions};

use crate::{bytes::Bytes, pictures::mended};

/// The most bytes that a raster may take here: a small file may unpack to a large one.
const MOST_BYTES: u64 = 1 << 22;
/// The most cells of a raster that is written and read again.
const MOST: usize = 1 << 12;

/// The first byte is the band; the rest is the file.
pub(crate) fn run(data: &[u8]) {
    let mut bytes = Bytes::new(data);
    let band = Some(u16::from(bytes.byte() % 4)).filter(|&band| band > 0);
    let options = SurfaceOptions { band, max_bytes: MOST_BYTES };
    let file = mended(bytes.rest());
    let size = Surface::size(&file);
    let Ok(surface) = Surface::parse(&file, &options) else { return };
    assert_eq!(size.ok(), Some((surface.width(), surface.height())), "the header states the size");
    let numbers = of(&surface);
    assert_eq!(numbers.len() as u64, u64::from(surface.width()) * u64::from(surface.height()));
    if numbers.len() > MOST {
        return;
    }
    // An NPY says of no number that it stands for none.
    let mut npy = Vec::new();
    surface.to_npy(&mut npy).expect("memory");
    let again = Surface::parse(&npy, &SurfaceOptions::default()).expect("an NPY that was written");
    let is_same = |(one, other): (&Option<u64>, &Option<u64>)| one.is_none() || one == other;
    assert!(numbers.iter().zip(&of(&again)).all(is_same), "NPY: {surface:?}");
    let mut tiff = Cursor::new(Vec::new());
    if surface.to_geotiff(&mut tiff, &GeoTiffOptions::default()).is_ok() {
        let tiff = tiff.into_inner();
        assert_eq!(SurfaceFormat::of(&tiff), Some(SurfaceFormat::GeoTiff));
        let again = Surface::parse(&tiff, &SurfaceOptions::default()).expect("a GeoTIFF that was written");
        assert_eq!(of(&again), numbers, "GeoTIFF: {surface:?}");
    }
}

/// The numbers by their bits.
fn of(surface: &Surface) -> Vec<Option<u64>> {
    surface.iter().map(|number| number.map(f64::to_bits)).collect()
}
