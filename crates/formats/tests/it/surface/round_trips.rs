//! Rasters written and read again: every kind of file and of samples, by seed.

use std::io::Cursor;

use mediant_formats::{
    GeoTiffOptions, Georeference, Samples, Surface, SurfaceOptions, TiffCompression, read_surface,
};
use mediant_oracle::{Rng, seeds};

use super::{bits, files, numbers, options};

fn random(rng: &mut Rng) -> Surface {
    let (width, height) = (1 + rng.below(40), 1 + rng.below(40));
    let cells = (width * height) as usize;
    let mut words = (0..cells).map(|_| rng.bits()).collect::<Vec<u64>>().into_iter();
    let words = words.by_ref();
    let few = rng.below(3) == 0;
    let words = words.map(|word| if few { word % 5 } else { word });
    let samples: Samples = match rng.below(7) {
        0 => words.map(|word| word as u8).collect::<Vec<_>>().into(),
        1 => words.map(|word| word as u16).collect::<Vec<_>>().into(),
        2 => words.map(|word| word as i16).collect::<Vec<_>>().into(),
        3 => words.map(|word| word as u32).collect::<Vec<_>>().into(),
        4 => words.map(|word| word as i32).collect::<Vec<_>>().into(),
        // All floats: the smallest, NaN, infinities.
        5 => words.map(|word| f32::from_bits((word >> 11) as u32)).collect::<Vec<_>>().into(),
        _ => words.map(f64::from_bits).collect::<Vec<_>>().into(),
    };
    let some = samples.get(rng.below(cells as u32) as usize);
    let no_data = [None, Some(-9999.0), Some(0.0), some][rng.below(4) as usize];
    let surface = Surface::new(width, height, samples).unwrap().with_no_data(no_data);
    match rng.below(3) {
        0 => surface,
        1 => surface.with_georeference(Georeference::from_cell_size(0.1, 30.0).unwrap()),
        _ => {
            let text = format!(
                "ncols 1 nrows 1 xllcenter {} yllcenter -70.5 cellsize 25.25 1",
                f64::from(rng.below(1000)) / 8.0
            );
            let placed = Surface::parse(text.as_bytes(), &SurfaceOptions::default()).unwrap();
            surface.with_georeference(placed.georeference().clone())
        }
    }
}

fn read(bytes: &[u8]) -> Surface {
    Surface::parse(bytes, &SurfaceOptions::default()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn npy_and_text() {
    for seed in seeds(400) {
        let surface = random(&mut Rng::new(seed));
        let mut bytes = Vec::new();
        surface.to_npy(&mut bytes).unwrap();
        let again = read(&bytes);
        let floats = matches!(surface.samples(), Samples::F32(_) | Samples::F64(_));
        if floats {
            assert_eq!(numbers(&again), numbers(&surface), "seed {seed}");
        } else {
            assert_eq!(bits(again.samples()), bits(surface.samples()), "seed {seed}");
        }
        bytes.clear();
        surface.to_esri_ascii(&mut bytes).unwrap();
        let again = read(&bytes);
        let text = String::from_utf8(bytes).unwrap();
        let same = |surface: &Surface| (surface.width(), surface.height());
        assert_eq!(same(&again), same(&surface), "seed {seed}");
        // Floats of 32 bits have the digits that tell them from other such.
        let is_narrow = matches!(surface.samples(), Samples::F32(_));
        let exact = |number: f64| if is_narrow { f64::from(number as f32) } else { number };
        let found: Vec<_> = again.iter().map(|number| number.map(exact)).collect();
        assert_eq!(found, surface.iter().collect::<Vec<_>>(), "seed {seed}: {text}");
        let place = |surface: &Surface| (surface.cell_size(), surface.georeference().lower_left());
        let expected = place(&surface);
        let found = place(&again);
        assert_eq!(found.0, expected.0.or(Some((1.0, 1.0))), "seed {seed}");
        assert_eq!(found.1, expected.1.or(Some((0.0, 0.0))), "seed {seed}");
    }
}

#[test]
fn pictures() {
    let mut written = 0;
    for seed in seeds(400) {
        let surface = random(&mut Rng::new(seed));
        let (mut pgm, mut png) = (Vec::new(), Vec::new());
        let whole = (0..surface.samples().len()).all(|at| {
            surface.samples().get(at).is_some_and(|n| n.fract() == 0.0 && (0.0..=65535.0).contains(&n))
        });
        assert_eq!(surface.to_pgm(&mut pgm).is_ok(), whole, "seed {seed}");
        assert_eq!(surface.to_png(&mut png).is_ok(), whole, "seed {seed}");
        if whole {
            written += 1;
            for bytes in [pgm, png] {
                let again = read(&bytes);
                let all = |surface: &Surface| bits(surface.samples()).1;
                assert_eq!(all(&again), all(&surface), "seed {seed}");
                let narrow = matches!(surface.samples(), Samples::U8(_));
                assert_eq!(matches!(again.samples(), Samples::U8(_)), narrow, "seed {seed}");
            }
        }
    }
    assert!(written > 20, "{written}");
}

#[test]
fn geotiffs() {
    for seed in seeds(400) {
        let rng = &mut Rng::new(seed);
        let surface = random(rng);
        let compressions = [TiffCompression::None, TiffCompression::Lzw, TiffCompression::Deflate];
        let compression = compressions[rng.below(3) as usize];
        let options = GeoTiffOptions { compression, big_tiff: rng.below(2) == 0 };
        let mut bytes = Cursor::new(Vec::new());
        surface.to_geotiff(&mut bytes, &options).unwrap();
        let bytes = bytes.into_inner();
        assert_eq!(bytes[2] == 43, options.big_tiff);
        let again = read(&bytes);
        assert_eq!(bits(again.samples()), bits(surface.samples()), "seed {seed}");
        assert_eq!(again.no_data(), surface.no_data(), "seed {seed}");
        assert_eq!(again.cell_size(), surface.cell_size(), "seed {seed}");
        let place = surface.georeference().lower_left().or(surface.cell_size().map(|_| (0.0, 0.0)));
        let found = again.georeference().lower_left();
        let near = found.zip(place).is_none_or(|(a, b)| (a.0 - b.0).abs().max((a.1 - b.1).abs()) < 1e-9);
        assert!(near && found.is_some() == place.is_some(), "seed {seed}: {found:?}, {place:?}");
    }
}

#[test]
fn numbers_that_look_like_no_data() {
    let all = vec![-9999.0, -99_999.0, f64::NAN, 5.0];
    let surface = Surface::new(2, 2, all).unwrap();
    let mut bytes = Vec::new();
    surface.to_esri_ascii(&mut bytes).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    assert_eq!(
        text,
        "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -999999\n-9999.0 -99999.0\n\
         -999999 5.0\n"
    );
    assert_eq!(numbers(&read(text.as_bytes())), numbers(&surface));
    let large = Surface::new(2, 1, vec![u32::MAX, 7]).unwrap();
    let mut bytes = Vec::new();
    large.to_esri_ascii(&mut bytes).unwrap();
    assert!(bytes.ends_with(b"NODATA_value -9999\n4294967295.0 7.0\n"));
}

/// The place of a file that another program wrote is kept to the byte.
#[test]
fn places_are_kept() {
    for path in files() {
        let surface = read_surface(&path, &options(&path)).unwrap();
        let mut bytes = Cursor::new(Vec::new());
        surface.to_geotiff(&mut bytes, &GeoTiffOptions::default()).unwrap();
        let again = read(&bytes.into_inner());
        assert_eq!(bits(again.samples()), bits(surface.samples()), "{}", path.display());
        if path.extension().is_some_and(|end| end == "tif") {
            assert_eq!(again.georeference(), surface.georeference(), "{}", path.display());
        }
        assert_eq!(numbers(&again), numbers(&surface), "{}", path.display());
    }
}

/// A result in the place of its raster, with another number for 'no data'.
#[test]
fn another_no_data() {
    let path = files().into_iter().find(|path| path.ends_with("gdal-big-tiff.tif")).unwrap();
    let surface = read_surface(&path, &SurfaceOptions::default()).unwrap();
    assert!(surface.no_data().is_some_and(|number| number < -3e38));
    for no_data in [None, Some(-1.0), surface.no_data()] {
        let costs = Surface::new(surface.width(), surface.height(), vec![-1.0; 54]).unwrap();
        let costs = costs.with_georeference(surface.georeference().clone()).with_no_data(no_data);
        let mut bytes = Cursor::new(Vec::new());
        costs.to_geotiff(&mut bytes, &GeoTiffOptions::default()).unwrap();
        let again = read(&bytes.into_inner());
        assert_eq!(again.no_data(), no_data);
        assert_eq!(again.get(0, 0), (no_data != Some(-1.0)).then_some(-1.0));
        assert_eq!(again.cell_size(), Some((30.0, 30.0)));
    }
}

#[test]
fn files_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let surface = Surface::new(3, 2, vec![1_u16, 2, 3, 4, 5, 60_000]).unwrap();
    for name in ["a.npy", "a.asc", "a.PGM", "a.png", "a.tif", "b.tiff"] {
        let path = folder.path().join(name);
        surface.save(&path).unwrap();
        assert_eq!(numbers(&read_surface(&path, &SurfaceOptions::default()).unwrap()), numbers(&surface));
    }
    for name in ["a.jpg", "a", "npy"] {
        let path = folder.path().join(name);
        let message = surface.save(&path).unwrap_err().to_string();
        let expected =
            format!("{}: no name for a raster; end it in .npy, .asc, .pgm, .png, .tif", path.display());
        assert_eq!(message, expected);
        assert!(!path.exists());
    }
    // Half a file is not left.
    let path = folder.path().join("c.pgm");
    let error = Surface::new(2, 1, vec![1.0, 2.5]).unwrap().save(&path).unwrap_err();
    let expected = format!(
        "{}: cannot be written: cell (1, 0): expected a whole number of 0 to 65535 for a PGM, found 2.5; scale \
         and round the numbers, or write NPY or GeoTIFF",
        path.display()
    );
    assert_eq!(error.to_string(), expected);
    assert!(!path.exists());
}
