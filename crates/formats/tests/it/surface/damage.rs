//! Files cut at every byte, and with each byte changed: an error or a raster, never a panic.

use std::{fs, path::Path};

use mediant_formats::{Surface, SurfaceError, SurfaceOptions};
use mediant_oracle::{Rng, is_exhaustive, seeds};

use super::{files, numbers, options};

/// Reads a file, and looks at all of it; the numbers, if there are any.
fn read(path: &Path, bytes: &[u8], context: &dyn Fn() -> String) -> Option<Vec<Option<u64>>> {
    let options = SurfaceOptions { max_bytes: 1 << 24, ..options(path) };
    let read = std::panic::catch_unwind(|| {
        let size = Surface::size(bytes);
        let surface = Surface::parse(bytes, &options);
        match &surface {
            Ok(surface) => {
                assert_eq!(size.ok(), Some((surface.width(), surface.height())));
                let cells = surface.width() as usize * surface.height() as usize;
                assert_eq!(surface.samples().len(), cells);
                let _ = (surface.cell_meters(0), surface.georeference().lower_left());
            }
            Err(error) => assert!(!error.to_string().is_empty() && !matches!(error, SurfaceError::Io(_))),
        }
        surface.ok().map(|surface| numbers(&surface))
    });
    read.unwrap_or_else(|_| panic!("{}", context()))
}

#[test]
fn cut_anywhere() {
    for path in files() {
        let bytes = fs::read(&path).unwrap();
        let name = path.display();
        let whole = read(&path, &bytes, &|| name.to_string());
        assert!(whole.is_some(), "{name}");
        let is_tiff = path.extension().is_some_and(|end| end == "tif");
        for end in 0..bytes.len() {
            let found = read(&path, &bytes[..end], &|| format!("{name} cut to {end}"));
            // The last number of a text may lose digits; a TIFF may end in bytes that nothing needs.
            let digits = bytes[end..].trim_ascii();
            let may = if is_tiff {
                found == whole
            } else {
                name.to_string().ends_with("asc") && !digits.contains(&b' ')
            };
            assert!(found.is_none() || may, "{name} cut to {end} of {} bytes", bytes.len());
        }
    }
}

#[test]
fn each_byte_changed() {
    let (mut accepted, mut refused) = (0, 0);
    let mut rng = Rng::new(7);
    for path in files() {
        let bytes = fs::read(&path).unwrap();
        for at in 0..bytes.len() {
            if !is_exhaustive() && rng.below(4) > 0 {
                continue;
            }
            let mut bytes = bytes.clone();
            let old = bytes[at];
            bytes[at] = [!old, old ^ 1 << rng.below(8), 0, 0xff][rng.below(4) as usize];
            let new = bytes[at];
            let context = || format!("{}: byte {at}, {old} as {new}", path.display());
            *(if read(&path, &bytes, &context).is_some() { &mut accepted } else { &mut refused }) += 1;
        }
    }
    assert!(accepted > refused / 20 && refused > accepted / 20, "{accepted} accepted, {refused} refused");
}

#[test]
fn several_bytes_changed() {
    let files: Vec<_> = files().into_iter().map(|path| (fs::read(&path).unwrap(), path)).collect();
    for seed in seeds(5000) {
        let mut rng = Rng::new(seed);
        let (bytes, path) = rng.pick(&files).unwrap();
        let mut bytes = bytes.clone();
        // Headers and directories are at the begin.
        let reach = if rng.below(2) == 0 { 400 } else { u32::MAX };
        for _ in 0..=rng.below(4) {
            let at = rng.below(reach.min(bytes.len() as u32)) as usize;
            match rng.below(5) {
                0 => drop(bytes.splice(at..at, [b"-+.e 9\n,n(".as_slice()[rng.below(10) as usize]])),
                1 => drop(bytes.remove(at)),
                2 => bytes[at] = rng.bits() as u8,
                3 => {
                    let end = bytes.len().min(at + 4);
                    bytes[at..end].fill([0, 0xff][rng.below(2) as usize]);
                }
                _ => bytes[at] ^= 1 << rng.below(8),
            }
            if bytes.is_empty() {
                break;
            }
        }
        let _ = read(path, &bytes, &|| format!("seed {seed}: {}", path.display()));
    }
}
