//! The message of every mistake.

use std::{
    fs,
    io::Cursor,
    sync::{Arc, atomic::AtomicBool},
};

use mediant_formats::{ReadError, Surface, SurfaceError, SurfaceOptions, read_surface, surface_size};
use mediant_grid::Interrupt;

use super::{files, options};

fn message(bytes: &[u8]) -> String {
    Surface::parse(bytes, &SurfaceOptions::default()).unwrap_err().to_string()
}

fn fixture(name: &str) -> Vec<u8> {
    fs::read(files().into_iter().find(|path| path.ends_with(name)).unwrap()).unwrap()
}

#[test]
fn no_rasters() {
    let nothing = "expected a raster, NPY, ESRI ASCII grid, PGM, PNG or GeoTIFF, found ";
    let you = "; is this the file that you meant?";
    for (bytes, found) in [
        (&b""[..], "nothing"),
        (b"type octile\n", "`type octile\\n`"),
        (b"GIF89a", "a GIF picture (convert it to PNG)"),
        (b"PK\x03\x04", "a ZIP archive (unpack it first)"),
    ] {
        assert_eq!(message(bytes), format!("{nothing}{found}{you}"));
    }
    assert_eq!(
        message(b"P4 1 1 a"),
        "expected a picture with one gray a pixel, found a PBM, whose pixels are black and white; save it as \
         gray without opacity"
    );
    assert!(
        message(b"P6 1 1 255 abc").starts_with("expected a PGM or PBM"),
        "{}",
        message(b"P6 1 1 255 abc")
    );
}

/// An array of NumPy.
fn npy(header: &str, body: &[u8]) -> Vec<u8> {
    let length = (header.len() as u16).to_le_bytes();
    [b"\x93NUMPY\x01\0", &length[..], header.as_bytes(), body].concat()
}

#[test]
fn arrays() {
    let anew = "; save the array anew by `numpy.save`";
    let of = |header: &str, body: &[u8]| message(&npy(header, body));
    let good = "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 2)}";
    assert!(Surface::parse(&npy(good, b"ab"), &SurfaceOptions::default()).is_ok());
    assert!(Surface::parse(&npy(&good.replace("2)", "2L,)"), b"ab"), &SurfaceOptions::default()).is_ok());
    let short = "; is the file cut short, or a side in the header too large?";
    assert_eq!(of(good, b"a"), format!("expected 2 bytes of numbers, found 1{short}"));
    assert_eq!(
        of(good, b"abc"),
        "expected the end of the file after 2 bytes of numbers, found 1 more; remove what follows, or mend the \
         sides in the header"
    );
    let shape = "a shape of two dimensions, rows and columns, or of three, with 1 to 65535 bands first";
    for (header, expected, found, remedy) in [
        ("", "a dictionary", "nothing", anew),
        (
            "{'descr': '<c8', 'fortran_order': False, 'shape': (1, 2)}",
            "truth values, integers or floats, of up to 64 bits",
            "`<c8`",
            "; convert it, for example by `array.astype('float32')`",
        ),
        (
            "{'descr': [('a', '<f4')], 'fortran_order': False, 'shape': (1, 2)}",
            "a type of numbers",
            "`[(\\'a\\', \\'<f4\\')], \\'fortran_order\\': False, …`",
            "; convert it, for example by `array.astype('float32')`",
        ),
        (
            "{'descr': '|u1', 'fortran_order': False, 'shape': (2,)}",
            shape,
            "`(2,)`",
            "; save one layer of the array, with its rows and columns",
        ),
        (
            "{'descr': '|u1', 'fortran_order': False, 'shape': (0, 1, 2)}",
            shape,
            "`(0, 1, 2)`",
            "; save one layer of the array, with its rows and columns",
        ),
        (
            "{'descr': '|u1', 'fortran_order': True, 'shape': (3, 1, 2)}",
            shape,
            "`bands in Fortran order`",
            "; save it anew by `numpy.save(file, numpy.ascontiguousarray(array))`",
        ),
        (
            "{'descr': '|u1', 'fortran_order': 0, 'shape': (1, 2)}",
            "`True` or `False`",
            "`0, \\'shape\\': (1, 2)}`",
            anew,
        ),
        ("{'descr': '|u1'}", "the keys `descr`, `fortran_order` and `shape`", "`fewer keys`", anew),
        ("{'other': 1}", "the keys `descr`, `fortran_order` and `shape`", "`other`", anew),
    ] {
        assert_eq!(
            of(header, b"ab"),
            format!("the header of the NPY: expected {expected}, found {found}{remedy}")
        );
    }
}

#[test]
fn integers_of_64_bits() {
    let good = "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 2)}";
    let of = |header: &str, body: &[u8]| message(&npy(header, body));
    let exact = [&(1_u64 << 53).to_le_bytes()[..], &((1_u64 << 53) + 1).to_le_bytes()].concat();
    assert_eq!(
        of(&good.replace("|u1", "<u8"), &exact),
        "cell (1, 0): expected an integer that 64-bit floats hold exactly, found 9007199254740993; convert the \
         numbers to `float64` where you know how exact they must be"
    );
    let most = [u64::MAX.to_le_bytes(), (i64::MAX as u64).to_le_bytes()].concat();
    assert!(of(&good.replace("|u1", "<u8"), &most).contains("found 18446744073709551615"));
    assert!(of(&good.replace("|u1", "<i8"), &most).contains("found 9223372036854775807"));
}

#[test]
fn sizes() {
    let large = "a raster of 1048577 × 2 cells: expected sides of 1 to 1048576, and at most 4278190080 cells in \
                 all; make its cells larger, or split it";
    let text = b"ncols 1048577\nnrows 2\n1 2\n";
    assert_eq!(message(text), large);
    assert_eq!(Surface::size(text).unwrap_err().to_string(), large);
    assert_eq!(message(b"P5 1048577 2 255 "), large);
    assert!(matches!(Surface::size(b"P5 0 2 255 "), Err(SurfaceError::Size { width: 0, height: 2 })));
    assert!(matches!(Surface::check_size(1 << 20, 4081), Err(SurfaceError::Size { .. })));
    assert_eq!(Surface::check_size(1 << 20, 4080).unwrap(), (1 << 20, 4080));
    assert!(Surface::check_size(u64::MAX, u64::MAX).is_err());
    let options = SurfaceOptions { max_bytes: 11, ..SurfaceOptions::default() };
    let budget = "a raster whose numbers take 12 bytes: expected at most 11; allow more by `max_bytes`, make \
                  its cells larger, or split it";
    let text = b"ncols 3\nnrows 1\n1 2 3\n";
    assert_eq!(Surface::parse(text, &options).unwrap_err().to_string(), budget);
    assert_eq!(
        Surface::new(2, 3, vec![0_u8; 5]).unwrap_err().to_string(),
        "expected 6 numbers, one a cell, found 5; mend the sides, or the numbers"
    );
    // The default does for the largest raster of 16 bits.
    assert!(2 * Surface::MAX_CELLS <= SurfaceOptions::default().max_bytes);
}

#[test]
fn texts() {
    let form = "; the header has the lines `ncols N`, `nrows N`, `xllcorner X`, `yllcorner Y`, `cellsize S` and \
                `NODATA_value V`, and the rows follow";
    let digits = "; write numbers as digits with a decimal point, not a comma, and `nan` for none";
    for (text, expected) in [
        (
            "ncols 2\nnrows x\n",
            format!("line 2, column 7: expected the number of columns or rows, found `x`{form}"),
        ),
        (
            "ncols 2\n1 2\n",
            format!(
                "line 2, column 1: expected the keys `ncols` and `nrows` before the \
          first number, found `1`{form}"
            ),
        ),
        ("ncols 2\nncols 2\n", format!("line 2, column 1: expected each key once, found `ncols`{form}")),
        (
            "ncols 1 nrows 1\ncellsize 0\n1",
            format!(
                "line 2, column 10: expected a positive number, the size of a cell, \
          found `0`{form}"
            ),
        ),
        (
            "ncols 1 nrows 1\nxllcorner inf\n1",
            format!("line 2, column 11: expected a coordinate, found `inf`{form}"),
        ),
        (
            "ncols 1 nrows 1\nunits m\n1",
            format!(
                "line 2, column 1: expected a key of the header, or the first number, \
          found `units`{form}"
            ),
        ),
        ("ncols 2 nrows 1\r\n1 0,5\r\n", format!("line 2, column 3: expected a number, found `0,5`{digits}")),
        ("ncols 2 nrows 1\n1 1e999\n", format!("line 2, column 3: expected a number, found `1e999`{digits}")),
        (
            "ncols 2 nrows 2\n1 2\n3\n",
            "expected 4 numbers, found 3; is the file cut short, or a side in the header \
          too large?"
                .to_owned(),
        ),
        (
            "ncols 9 nrows 9\n1 2\n3\n",
            "expected 81 numbers, found 3; is the file cut short, or a side in the header \
          too large?"
                .to_owned(),
        ),
        (
            "ncols 2 nrows 1\n1 2\n3\n",
            "expected the end of the file after 2 numbers, found `3`; remove what follows, \
          or mend the sides in the header"
                .to_owned(),
        ),
    ] {
        assert_eq!(message(text.as_bytes()), expected, "{text}");
    }
    // A word that never ends takes no memory.
    let endless = format!("ncols 1 nrows 1\n{}", "1".repeat(5000));
    assert!(message(endless.as_bytes()).starts_with("line 2, column 1: expected a number, found `1111"));
}

#[test]
fn odd_texts_that_are_read() {
    let read = |text: &str| Surface::parse(text.as_bytes(), &SurfaceOptions::default()).unwrap();
    let odd = read("\u{feff}\n\n NCOLS 2\tNRows 2 NODATA_VALUE nan\r\n-0 +5\n\n\n1e2 NaN");
    let numbers: Vec<_> = odd.iter().collect();
    assert_eq!(numbers, [Some(-0.0), Some(5.0), Some(100.0), None]);
    assert!(numbers[0].unwrap().is_sign_negative());
    assert_eq!((odd.cell_size(), odd.no_data()), (None, None));
    // Without a word, −9999 is none.
    assert_eq!(read("ncols 2 nrows 1 -9999 1").get(0, 0), None);
    assert_eq!(read("ncols 2 nrows 1 nodata_value 0 -9999 1").get(0, 0), Some(-9999.0));
}

#[test]
fn bands() {
    let bytes = fixture("gdal-bands-pixel.tif");
    assert_eq!(message(&bytes), "expected one band, found 3; choose one of 1 to 3 by `band`");
    let of = |band| Surface::parse(&bytes, &SurfaceOptions { band: Some(band), ..SurfaceOptions::default() });
    assert_eq!(
        of(4).unwrap_err().to_string(),
        "expected one band, found 3; choose one of 1 to 3 by `band` (not 4)"
    );
    assert!(of(0).is_err());
    let all: Vec<_> = [1, 2, 3].map(|band| of(band).unwrap().into_samples()).to_vec();
    assert!(all[0] != all[1] && all[1] != all[2]);
    let one = SurfaceOptions { band: Some(1), ..SurfaceOptions::default() };
    for name in ["gdal-u2.tif", "numpy-le-f4.npy", "gdal-i4.asc", "pillow-16.pgm", "pillow-8.png"] {
        let bytes = fixture(name);
        assert!(Surface::parse(&bytes, &one).is_ok(), "{name}");
        let second = SurfaceOptions { band: Some(2), ..SurfaceOptions::default() };
        assert_eq!(
            Surface::parse(&bytes, &second).unwrap_err().to_string(),
            "expected band 1, which is the only one, found 2; name no band",
            "{name}"
        );
    }
}

#[test]
fn bands_of_arrays() {
    let array = |bands: u16, numbers: &[u8]| {
        npy(&format!("{{'descr': '|u1', 'fortran_order': False, 'shape': ({bands}, 2, 3)}}"), numbers)
    };
    let of =
        |bytes: &[u8], band| Surface::parse(bytes, &SurfaceOptions { band, ..SurfaceOptions::default() });
    let numbers: Vec<u8> = (0..24).collect();
    let four = array(4, &numbers);
    assert_eq!(Surface::size(&four).unwrap(), (3, 2));
    for (band, all) in (1..).zip(numbers.chunks(6)) {
        let read: Vec<_> = of(&four, Some(band)).unwrap().iter().flatten().collect();
        assert_eq!(read, all.iter().copied().map(f64::from).collect::<Vec<_>>(), "band {band}");
    }
    for band in [None, Some(0), Some(5)] {
        assert!(matches!(of(&four, band), Err(SurfaceError::Band { bands: 4, found }) if found == band));
    }
    assert_eq!(of(&array(1, &numbers[..6]), None).unwrap().get(2, 1), Some(5.0));
    for numbers in [&numbers[..23], &[&numbers[..], &[1]].concat()] {
        let error = of(&array(4, numbers), Some(1)).unwrap_err().to_string();
        assert!(error.contains("24 bytes of numbers"), "{error}");
    }
}

/// The tag of a TIFF of GDAL with the number of its compression, and that of its samples' format.
#[test]
fn geotiffs() {
    let anew = "; write the file anew, for example by `gdal_translate -co COMPRESS=DEFLATE`";
    let with = |tag: u16, value: u16| {
        let mut bytes = fixture("gdal-u2.tif");
        let at = bytes.windows(4).position(|entry| entry[..2] == tag.to_le_bytes() && entry[2..] == [3, 0]);
        bytes[at.unwrap() + 8..][..2].copy_from_slice(&value.to_le_bytes());
        message(&bytes)
    };
    assert_eq!(
        with(259, 50000),
        format!("the GeoTIFF: expected no compression, LZW, deflate or PackBits, found Zstandard{anew}")
    );
    assert_eq!(
        with(339, 6),
        format!(
            "the GeoTIFF: expected whole numbers or floats of up to 64 bits, found complex numbers of 16 bits{anew}"
        )
    );
    assert_eq!(
        with(256, 0),
        "a raster of 0 × 5 cells: expected sides of 1 to 1048576, and at most 4278190080 \
        cells in all; make its cells larger, or split it"
    );
    assert_eq!(
        with(256, 60000),
        format!(
            "the GeoTIFF: expected strips or tiles whose 600000 bytes are all in the file, found one of 70 \
             bytes; is it cut short?{anew}"
        )
    );
    assert_eq!(
        with(262, 6),
        format!("the GeoTIFF: expected a raster of numbers, found a photograph (YCbCr){anew}")
    );
    assert_eq!(
        message(b"II*\0"),
        format!("the GeoTIFF: expected the place of the first image, found the end of the file{anew}")
    );
}

#[test]
fn files_on_a_disk() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.npy");
    let missing = read_surface(&path, &SurfaceOptions::default()).unwrap_err();
    assert!(matches!(missing, ReadError::Missing { .. }));
    fs::write(&path, "x").unwrap();
    let error = surface_size(&path).unwrap_err();
    assert!(matches!(error, ReadError::Surface { .. }));
    assert_eq!(
        error.to_string(),
        format!(
            "{}: expected a raster, NPY, ESRI ASCII grid, PGM, PNG or GeoTIFF, found `x`; is this the file that \
             you meant?",
            path.display()
        )
    );
}

#[test]
fn sheared_rasters() {
    let mut bytes = fixture("gdal-rotated.tif");
    let skew = (-8.0_f64).to_le_bytes();
    let at = bytes.windows(8).position(|word| word == skew).unwrap();
    bytes[at..][..8].copy_from_slice(&7.0_f64.to_le_bytes());
    assert_eq!(
        message(&bytes),
        "the GeoTIFF: expected cells that are rectangles, found a sheared raster; warp it, for example by `gdalwarp`"
    );
}

/// A set flag stops the reading of every kind of file.
#[test]
fn interrupts() {
    let flag = Arc::new(AtomicBool::new(true));
    let interrupt = Interrupt::new().cancel(flag);
    for path in files() {
        let bytes = Cursor::new(fs::read(&path).unwrap());
        let error = Surface::read_from(bytes, &options(&path), &interrupt).unwrap_err();
        assert!(matches!(error, SurfaceError::Interrupted(_)), "{}: {error}", path.display());
        let error =
            mediant_formats::read_surface_interruptible(&path, &options(&path), &interrupt).unwrap_err();
        assert!(matches!(error, ReadError::Interrupted(_)), "{}: {error}", path.display());
    }
}
