//! Files cut short at every byte, and with bits flipped by seed: always an error or a map, never a panic.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{
    fs,
    path::{Path, PathBuf},
};

use mediant_formats::{MapOptions, Raster, RosMap, RosSettings};
use mediant_oracle::{Rng, seeds};

use crate::png_chunks;

/// All pictures and YAML files of the fixtures.
fn files() -> Vec<(PathBuf, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let mut paths: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| {
        path.extension().is_some_and(|end| ["png", "pgm", "pbm", "yaml"].iter().any(|known| end == *known))
    });
    paths.sort();
    assert_eq!(paths.len(), 31);
    let braces =
        b"{image: 'a.pgm', resolution: 0.05, # [m\norigin: [-1, \"2\", 0], negate: 0, nested: {a: [b, c]},\
                   \"occupied_thresh\":0.65,\nfree_thresh : 0.196}\n";
    let read = paths.into_iter().map(|path| (path.clone(), fs::read(path).unwrap()));
    read.chain([(PathBuf::from("braces.yaml"), braces.to_vec())]).collect()
}

/// Reads a picture or a YAML file, and uses what was read; whether there was anything.
fn read(path: &Path, bytes: &[u8]) -> bool {
    let raster = if path.extension().is_some_and(|end| end == "yaml") {
        let raster = Raster::from_fn(4, 4, 255, |x, y| 16 * (4 * y + x)).unwrap();
        match RosSettings::parse(bytes) {
            Ok(settings) => {
                let map = RosMap::new(settings, raster).expect("settings that were read are valid");
                let (x, y) = map.frame().center_of((1, 1).into());
                let _ = map.frame().cell_at(x, y);
                return map.to_grid(&MapOptions::default()).width() == 4;
            }
            Err(error) => {
                assert!(error.to_string().starts_with("line "), "{error}");
                return false;
            }
        }
    } else {
        Raster::parse(bytes)
    };
    match raster {
        Ok(raster) => {
            let grid = raster.to_grid(&MapOptions::default());
            (grid.width(), grid.height()) == (raster.width(), raster.height())
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}

#[test]
fn cut_short_at_every_byte() {
    for (path, bytes) in files() {
        assert!(read(&path, &bytes), "{}", path.display());
        for end in 0..bytes.len() {
            let whole = read(&path, &bytes[..end]);
            // The last number of a text may lose digits; all else must be found wrong.
            let text = path.extension().is_some_and(|found| found == "yaml")
                || path.to_string_lossy().contains("plain");
            let may = text && !bytes[end..].trim_ascii().contains(&b' ') && !bytes[end..].contains(&b':');
            assert!(!whole || may, "{} cut to {end} of {} bytes", path.display(), bytes.len());
        }
    }
}

#[test]
fn bits_flipped() {
    let files = files();
    let (mut accepted, mut refused) = (0, 0);
    for seed in seeds(8000) {
        let mut rng = Rng::new(seed);
        let (path, mut bytes) = rng.pick(&files).unwrap().clone();
        for _ in 0..=rng.below(3) {
            let at = rng.below(bytes.len() as u32) as usize;
            match rng.below(4) {
                0 => bytes[at] = rng.bits() as u8,
                1 => drop(bytes.splice(at..at, [b"-[]\"':#\n 9".as_slice()[rng.below(10) as usize]])),
                _ => bytes[at] ^= 1 << rng.below(8),
            }
        }
        // With right checksums the damage is read deeper.
        if rng.chance(70) && path.extension().is_some_and(|end| end == "png") {
            png_chunks::mend(&mut bytes);
        }
        // The seed is in the message of a panic.
        let read = std::panic::catch_unwind(|| read(&path, &bytes));
        let whole = read.unwrap_or_else(|_| panic!("seed {seed}: {}", path.display()));
        *(if whole { &mut accepted } else { &mut refused }) += 1;
    }
    // If nearly all were refused or accepted, the rounds would show nothing.
    assert!(accepted > refused / 20 && refused > accepted / 20, "{accepted} accepted, {refused} refused");
}
