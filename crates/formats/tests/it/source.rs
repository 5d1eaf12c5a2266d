//! Maps of all kinds by one function.

use std::{fs, path::Path};

use mediant_formats::{
    MapFile, MapFormat, MapOptions, Raster, RasterFormat, ReadError, map_size_with, read_map, read_map_with,
};
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
            let map = read_map(&path, &MapOptions::default()).unwrap_or_else(|error| panic!("{error}"));
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
        let error = read_map(&path, &MapOptions::default()).expect_err(name);
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
    let missing = read_map(folder.path().join("no"), &MapOptions::default()).expect_err("missing");
    assert!(matches!(missing, ReadError::Missing { .. }));
}

/// A function that reads files in memory.
fn in_memory<'a>(files: &'a [(&'a str, Vec<u8>)]) -> impl FnMut(&Path) -> Result<Vec<u8>, ReadError> + 'a {
    move |path| {
        let file = files.iter().find(|(name, _)| path == Path::new(name));
        file.map(|(_, bytes)| bytes.clone()).ok_or_else(|| ReadError::Missing { path: path.to_owned() })
    }
}

#[test]
fn maps_in_memory_are_those_on_disk() {
    let folder = tempfile::tempdir().unwrap();
    let (grid, _) = random_grid(5);
    let raster = Raster::from_grid(&grid).unwrap();
    let picture = |format| {
        let mut bytes = Vec::new();
        raster.write(format, &mut bytes).unwrap();
        bytes
    };
    let yaml = "image: sub/a.pgm\nresolution: 1\norigin: [2, 3, 0]\nnegate: 0\n\
        occupied_thresh: 0.65\nfree_thresh: 0.1\n";
    let files = [
        ("a.map", MapFile::from_grid(&grid).as_bytes().to_vec()),
        ("a.png", picture(RasterFormat::Png)),
        ("b.pgm", picture(RasterFormat::PlainPgm)),
        ("a.pbm", picture(RasterFormat::Pbm)),
        ("a.yaml", yaml.into()),
        ("sub/a.pgm", picture(RasterFormat::Pgm)),
    ];
    fs::create_dir(folder.path().join("sub")).unwrap();
    for (name, bytes) in &files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    let options = MapOptions::default();
    for (name, bytes) in &files {
        let read = read_map_with(name, &options, in_memory(&files)).unwrap();
        assert_eq!(read, read_map(folder.path().join(name), &options).unwrap(), "{name}");
        assert_eq!(read.grid, grid, "{name}");
        assert_eq!(map_size_with(name, in_memory(&files)).unwrap(), (grid.width(), grid.height()), "{name}");
        // Of a file that is cut short, the size is known as long as the header is whole, and then the same.
        for length in 0..bytes.len().min(200) {
            let cut = [(*name, bytes[..length].to_vec()), ("sub/a.pgm", files[5].1.clone())];
            if let Ok(size) = map_size_with(name, in_memory(&cut)) {
                let is_whole_header = size == (grid.width(), grid.height());
                // A number that is cut has fewer digits.
                assert!(
                    is_whole_header || size.1 < grid.height() || size.0 < grid.width(),
                    "{name}, {length}"
                );
            }
        }
    }
}

#[test]
fn what_is_missing_in_memory_is_named() {
    let yaml = b"image: a.pgm\nresolution: 1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.1\n";
    let files = [("maps/a.yaml", yaml.to_vec())];
    let options = MapOptions::default();
    let missing = |error: &ReadError| match error {
        ReadError::RosImage { source, .. } => {
            matches!(&**source, ReadError::Missing { path } if path == Path::new("maps/a.pgm"))
        }
        _ => false,
    };
    assert!(missing(&read_map_with("maps/a.yaml", &options, in_memory(&files)).unwrap_err()));
    assert!(missing(&map_size_with("maps/a.yaml", in_memory(&files)).unwrap_err()));
    let none = read_map_with("b.map", &options, in_memory(&files)).unwrap_err();
    assert!(matches!(none, ReadError::Missing { .. }));
}

#[test]
fn sizes_are_checked_as_maps_are() {
    let size = |name: &str, text: &str| map_size_with(name, in_memory(&[(name, text.into())]));
    assert_eq!(size("a.map", "type octile\nheight 7\nwidth 32768\nmap\n").unwrap(), (32_768, 7));
    assert!(matches!(size("a.map", "type octile\nheight 7\nwidth 32769\nmap\n"), Err(ReadError::Map { .. })));
    assert!(matches!(size("a.map", ""), Err(ReadError::Map { .. })));
    assert_eq!(size("a.pgm", "P5 16384 16384 255 ").unwrap(), (16_384, 16_384));
    assert!(matches!(size("a.pgm", "P5 16384 16385 255 "), Err(ReadError::Raster { .. })));
    assert!(matches!(size("a.pgm", "P6 2 2 255 "), Err(ReadError::Raster { .. })));
    assert!(matches!(size("a.txt", "hello"), Err(ReadError::NoMap { .. })));
}

#[test]
fn other_kinds_of_files_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let files: [(&[u8], &str); 15] = [
        (b"\xff\xd8\xff\xe0\0\x10JFIF", "a JPEG picture"),
        (b"II*\0\x08\0\0\0", "a TIFF picture"),
        (b"MM\0*\0\0\0\x08", "a TIFF picture"),
        (b"GIF89a\x01\0", "a GIF picture"),
        (b"BM\x46\0\0\0\0\0\0\0\x36\0", "a BMP picture"),
        (b"RIFF\x24\0\0\0WEBPVP8 ", "a WebP picture"),
        (b"\x1f\x8b\x08\0", "a file compressed by gzip"),
        (b"\xfd7zXZ\0\0", "a file compressed by xz"),
        (b"BZh9", "a file compressed by bzip2"),
        (b"PK\x03\x04\x14\0", "a ZIP archive"),
        (b"\x93NUMPY\x01\0", "an array of NumPy"),
        (b"%PDF-1.7", "a PDF document"),
        (b"version https://git-lfs.github.com/spec/v1\n", "a pointer of Git LFS"),
        (b"\xef\xbb\xbf\nvoxel 10 10 10\n0 0 0\n", "a 3-D map, `voxel`"),
        (b"\n<!DOCTYPE HTML>\n", "an HTML page"),
    ];
    for (bytes, what) in files {
        for name in ["a", "a.map", "a.png", "a.pgm", "a.yaml"] {
            let path = folder.path().join(name);
            fs::write(&path, bytes).unwrap();
            let error = read_map(&path, &MapOptions::default()).expect_err(name).to_string();
            assert!(error.contains(&format!("found {what}")), "{error}");
        }
        // As the picture that a YAML file names, and where only one kind is read.
        let error = Raster::parse(bytes).expect_err(what).to_string();
        assert!(error.contains(&format!("found {what}")), "{error}");
        let error = MapFile::parse(bytes).expect_err(what).to_string();
        assert!(error.contains(&format!("found {what}")), "{error}");
    }
}

#[test]
fn a_ros_map_in_braces_or_indented_is_known_without_a_name() {
    for yaml in ["{image: a.pgm}", "\u{feff}  image: a.pgm\n", "---\n{ image: a.pgm,\n resolution: 1}"] {
        assert_eq!(MapFormat::of(yaml.as_bytes(), "a"), Some(MapFormat::Ros), "{yaml}");
    }
}
