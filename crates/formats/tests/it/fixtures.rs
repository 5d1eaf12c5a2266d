//! Files that other programs wrote, against what another program reads in them. `fixtures/README.md` says
//! which.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{
    fs,
    path::{Path, PathBuf},
};

use mediant_formats::{Raster, RosMap, RosVersion};

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures")
}

/// The files of the folder with one of these extensions, in order.
fn files(extensions: &[&str]) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> =
        fs::read_dir(folder()).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| extensions.iter().any(|end| path.extension().is_some_and(|found| found == *end)));
    files.sort();
    files
}

/// The numbers of the text beside a file.
fn numbers(path: &Path) -> Vec<i64> {
    let text = fs::read_to_string(format!("{}.txt", path.display())).unwrap();
    text.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

#[test]
fn pictures() {
    let files: Vec<PathBuf> = files(&["png", "pgm", "pbm"])
        .into_iter()
        .filter(|path| !path.ends_with("saver1.pgm") && !path.ends_with("saver2.pgm"))
        .collect();
    assert_eq!(files.len(), 23);
    for path in files {
        let name = path.display();
        let raster = Raster::read(&path).unwrap_or_else(|error| panic!("{error}"));
        let numbers = numbers(&path);
        let [width, height, white, opaque] = [0, 1, 2, 3].map(|i| numbers[i] as u32);
        assert_eq!((raster.width(), raster.height()), (width, height), "{name}");
        assert_eq!(raster.opaque(), (opaque > 0).then_some(opaque), "{name}");
        let cells = (width * height) as usize;
        for (at, &expected) in numbers[4..][..cells].iter().enumerate() {
            let (x, y) = (at as u32 % width, at as u32 / width);
            // Another reader may scale its shades: what counts is the part of white.
            let shade = u64::from(raster.shade(x, y).unwrap());
            assert_eq!(
                shade * u64::from(white),
                expected as u64 * u64::from(raster.white()),
                "{name}: shade of ({x}, {y})"
            );
            let opacity = numbers.get(4 + cells + at).map(|&opacity| opacity as u32);
            assert_eq!(raster.opacity(x, y), opacity, "{name}: opacity of ({x}, {y})");
        }
    }
}

#[test]
fn ros_maps() {
    let files = files(&["yaml"]);
    assert_eq!(files.len(), 6);
    for (path, ros) in files.iter().flat_map(|path| [(path, RosVersion::Ros1), (path, RosVersion::Ros2)]) {
        let map = RosMap::read(path).unwrap_or_else(|error| panic!("{error}"));
        let width = map.raster().width();
        let numbers = numbers(&match ros {
            RosVersion::Ros1 => path.clone(),
            RosVersion::Ros2 => path.with_extension("yaml.ros2"),
        });
        assert_eq!(numbers.len() as u32, width * map.raster().height());
        let all = map.occupancies(ros);
        assert_eq!(numbers.len(), all.len());
        for ((at, expected), of_all) in numbers.into_iter().enumerate().zip(all) {
            let (x, y) = (at as u32 % width, at as u32 / width);
            assert_eq!(map.occupancy(x, y, ros), of_all, "{}, {ros:?}: ({x}, {y})", path.display());
            let found = map.occupancy(x, y, ros).map_or(-1, i64::from);
            assert_eq!(found, expected, "{}, {ros:?}: occupancy of ({x}, {y})", path.display());
        }
    }
}
