//! Memory grows with what a file has, not with the sides that its header states.
#![allow(unsafe_code, reason = "a counting allocator implements an unsafe trait")]

use std::{
    alloc::{GlobalAlloc, Layout, System},
    sync::atomic::{AtomicUsize, Ordering},
};

use mediant_formats::{Raster, RasterFormat, Surface, SurfaceOptions};

mod png_chunks;

/// The bytes that are allocated, and the most that ever were since [`peak`] was asked.
static BYTES: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

struct Counting;

// SAFETY: every call goes to the system's allocator unchanged; the counts touch no heap memory.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let bytes = BYTES.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        PEAK.fetch_max(bytes, Ordering::Relaxed);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        BYTES.fetch_sub(layout.size(), Ordering::Relaxed);
        // SAFETY: the caller keeps the contract of `dealloc`, and `at` came from `System`.
        unsafe { System.dealloc(at, layout) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Memory of a reader besides the pixels: the decoder of PNG has tables, and buffers for a few rows.
const SLACK: usize = 1 << 20;

/// The most bytes that reading a picture allocates at a time, and whether there was one.
fn peak(bytes: &[u8]) -> (usize, bool) {
    peak_of(|| Raster::parse(bytes).is_ok())
}

/// The same of a raster of numbers.
fn peak_of_surface(bytes: &[u8]) -> (usize, bool) {
    peak_of(|| Surface::parse(bytes, &SurfaceOptions::default()).is_ok())
}

fn peak_of(read: impl FnOnce() -> bool) -> (usize, bool) {
    let before = BYTES.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    let read = read();
    (PEAK.load(Ordering::Relaxed) - before, read)
}

/// A PNG with other sides in its header, of another color type, interlaced or not.
fn claiming(png: &[u8], width: u32, height: u32, color: [u8; 2], interlaced: bool) -> Vec<u8> {
    let mut png = png.to_vec();
    png[16..20].copy_from_slice(&width.to_be_bytes());
    png[20..24].copy_from_slice(&height.to_be_bytes());
    png[24..26].copy_from_slice(&color);
    png[28] = u8::from(interlaced);
    png_chunks::mend(&mut png);
    png
}

// One test, since all threads are counted.
#[test]
fn memory_follows_the_file() {
    let headers = [
        "P1 16384 16384 0101",
        "P2 16384 16384 65535 1 2 3",
        "P4 16384 16384 abcd",
        "P5 16384 16384 255 abcd",
        "P5 16384 16384 65535 abcd",
        "P5 32768 8192 65535 abcd",
        "P5 4294967295 4294967295 255 abcd",
        "P5 99999999999999999999999 1 255 abcd",
    ];
    for header in headers {
        let (bytes, read) = peak(header.as_bytes());
        assert!(!read && bytes < 1 << 12, "{header}: {bytes} bytes");
    }

    let mut png = Vec::new();
    let small = Raster::from_fn(16, 16, 255, |x, y| 16 * y + x).expect("a picture");
    small.write(RasterFormat::Png, &mut png).expect("memory takes all");
    assert!(peak(&png).1);
    let gray = claiming(&png, 16, 16, [8, 0], false);
    assert!(gray == png, "the chunk's CRC is that of the writer");
    for (width, height) in
        [(16_384, 16_384), (32_768, 8192), (8192, 32_768), (u32::MAX, 1), (i32::MAX as u32, 9)]
    {
        // Gray, and colours of 16 bits with opacity.
        for (color, interlaced) in [([8, 0], false), ([8, 0], true), ([16, 6], false), ([16, 6], true)] {
            let (bytes, read) = peak(&claiming(&png, width, height, color, interlaced));
            assert!(!read && bytes < SLACK, "{width} × {height}, {color:?}, {interlaced}: {bytes} bytes");
        }
    }

    surfaces();

    // A picture that is large and compresses well takes what its pixels take.
    let mut white = Vec::new();
    let large = Raster::from_fn(2000, 2000, 255, |_, _| 255).expect("a picture");
    large.write(RasterFormat::Png, &mut white).expect("memory takes all");
    drop(large);
    let (bytes, read) = peak(&white);
    assert!(white.len() < 50_000 && read, "{}", white.len());
    // A growing vector is copied: at most its old and its new place, the new one up to twice as long.
    assert!((4_000_000..3 * 4_000_000 + SLACK).contains(&bytes), "{bytes} bytes");
    // Half of the file gives half of the pixels, and no more memory than these.
    let (half, read) = peak(&white[..white.len() / 2]);
    assert!(!read && half < 3 * 2_000_000 + SLACK, "{half} bytes");
}

/// Rasters of numbers whose headers state more than their files have.
fn surfaces() {
    let npy = |shape: &str, kind: &str| {
        let header = format!("{{'descr': '{kind}', 'fortran_order': True, 'shape': {shape}, }}");
        let length = (header.len() as u16).to_le_bytes();
        [b"\x93NUMPY\x01\0", &length[..], header.as_bytes(), b"abcd"].concat()
    };
    let headers = [
        npy("(1048576, 1000)", "|u1"),
        npy("(1048576, 1000)", "<f8"),
        npy("(99999999999999999999999, 1)", "<f8"),
        b"\x93NUMPY\x02\0\xff\xff\xff\xff{".to_vec(),
        b"ncols 1048576 nrows 1000 1 2 3".to_vec(),
        b"ncols 1048576 nrows 1000 1.5 2 3".to_vec(),
        b"P5 1048576 1000 65535 abcd".to_vec(),
        b"P2 1048576 1000 65535 1 2 3".to_vec(),
    ];
    for bytes in headers {
        let (peak, read) = peak_of_surface(&bytes);
        assert!(!read && peak < 1 << 15, "{}: {peak} bytes", bytes.escape_ascii());
    }

    // Of a damaged GeoTIFF, a chunk is unpacked into at most 4096 times its bytes.
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/surfaces");
    let mut files = 0;
    for entry in std::fs::read_dir(folder).expect("the folder is there") {
        let path = entry.expect("the folder can be read").path();
        if path.extension().is_none_or(|end| end != "tif") {
            continue;
        }
        files += 1;
        let bytes = std::fs::read(&path).expect("the file can be read");
        // The header, the directory and its values are at the begin.
        for at in (0..bytes.len().min(700)).step_by(3) {
            for flip in [0xff, 0x80, 0x10] {
                let mut bytes = bytes.clone();
                bytes[at] ^= flip;
                let (peak, _) = peak_of_surface(&bytes);
                let most = SLACK + 3 * 4096 * bytes.len();
                assert!(peak < most, "{}: byte {at}, {flip:#x}: {peak} bytes", path.display());
            }
        }
    }
    assert!(files > 40, "{files}");
}
