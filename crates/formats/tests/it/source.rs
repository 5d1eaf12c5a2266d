//! Maps of all kinds by one function.

use std::fs;

use mediant_formats::{ImageOptions, MapFile, MapFormat, Raster, RasterFormat, ReadError, read_map};
use mediant_oracle::random_grid;

#[test]
fn the_content_tells_the_format() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, _) = random_grid(3);
    let raster = Raster::from_grid(&grid).unwrap();
    let picture = |format| {
        let mut bytes = Vec::new();
        raster.write(format, &mut bytes).unwrap();
        bytes
    };
    let files = [
        (MapFile::from_grid(&grid).as_bytes().to_vec(), MapFormat::MovingAi),
        (picture(RasterFormat::Png), MapFormat::Picture),
        (picture(RasterFormat::Pgm), MapFormat::Picture),
        (picture(RasterFormat::PlainPgm), MapFormat::Picture),
        (picture(RasterFormat::Pbm), MapFormat::Picture),
        (picture(RasterFormat::PlainPbm), MapFormat::Picture),
        (
            b"image: picture\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.1\n"
                .to_vec(),
            MapFormat::Ros,
        ),
    ];
    fs::write(folder.path().join("picture"), picture(RasterFormat::Pgm)).unwrap();
    for (bytes, format) in files {
        // Whatever it is called.
        for name in ["a.map", "a.png", "a.pgm", "a.yaml", "a.txt", "a"] {
            // A YAML file has no first bytes of its own: names of other kinds win.
            if format == MapFormat::Ros && ["a.map", "a.png", "a.pgm"].contains(&name) {
                continue;
            }
            let path = folder.path().join(name);
            fs::write(&path, &bytes).unwrap();
            let map = read_map(&path, &ImageOptions::default()).unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(map.format, format, "{name}");
            assert_eq!(map.grid, grid, "{name}, {format:?}");
            assert_eq!(map.frame.is_some(), format == MapFormat::Ros);
        }
    }
}

#[test]
fn the_name_tells_what_is_wrong() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        let error = read_map(&path, &ImageOptions::default()).expect_err(name);
        (error.to_string().replace(&format!("{}/", folder.path().display()), ""), error)
    };
    assert!(matches!(read("a.map", "hello").1, ReadError::Map { .. }));
    assert!(matches!(read("a.PNG", "hello").1, ReadError::Raster { .. }));
    assert!(matches!(read("a.yml", "hello").1, ReadError::Ros { .. }));
    assert!(matches!(read("a.yaml", "hello").1, ReadError::Ros { .. }));
    let (message, error) = read("a.bmp", "BM");
    assert!(matches!(error, ReadError::NoMap { .. }));
    assert_eq!(
        message,
        "a.bmp: expected a map, a MovingAI `.map`, a PNG, PGM or PBM, or the YAML file of a ROS map, found `BM`; \
         is this the file that you meant? Convert other pictures to PNG"
    );
    assert!(read("empty", "").0.contains("found nothing"));
    let missing = read_map(folder.path().join("no"), &ImageOptions::default()).expect_err("missing");
    assert!(matches!(missing, ReadError::Missing { .. }));
}
