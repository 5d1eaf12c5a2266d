//! Maps as pictures, and those of ROS.

use std::path::Path;

use mediant_formats::{
    MapOptions, Raster, RasterFormat, ReadError, RosMap, RosSettings, RosVersion, read_map_with,
};

use crate::bytes::halves;

#[path = "../../formats/tests/png_chunks.rs"]
mod png_chunks;

/// The most pixels of a picture that is compared pixel by pixel.
const MOST: u64 = 1 << 14;

/// A picture as it is, and with the checksums of a PNG made right.
pub(crate) fn run_picture(data: &[u8]) {
    picture(data);
    if data.starts_with(b"\x89PNG") {
        picture(&mended(data));
    }
}

/// The bytes with the checksums of a PNG made right.
pub(crate) fn mended(data: &[u8]) -> Vec<u8> {
    let mut bytes = data.to_vec();
    if bytes.starts_with(b"\x89PNG") {
        png_chunks::mend(&mut bytes);
    }
    bytes
}

fn picture(data: &[u8]) -> Option<Raster> {
    let size = Raster::size(data);
    let raster = Raster::parse(data).ok()?;
    assert_eq!(size.ok(), Some((raster.width(), raster.height())), "the header states the size");
    let grid = raster.to_grid(&MapOptions::default());
    assert_eq!((grid.width(), grid.height()), (raster.width(), raster.height()));
    if u64::from(raster.width()) * u64::from(raster.height()) <= MOST {
        let again = Raster::from_grid(&grid).expect("a picture of a map");
        for format in [RasterFormat::Png, RasterFormat::Pgm, RasterFormat::Pbm] {
            let mut bytes = Vec::new();
            again.write(format, &mut bytes).expect("memory");
            let read = Raster::parse(&bytes).expect("a picture that was written");
            assert_eq!(read.to_grid(&MapOptions::default()), grid, "{format:?}");
        }
    }
    Some(raster)
}

/// The YAML, a zero, and the picture.
pub(crate) fn run_ros(data: &[u8]) {
    let (yaml, image) = halves(data);
    let Ok(settings) = RosSettings::parse(yaml) else { return };
    let again = RosSettings::parse(settings.to_yaml().as_bytes());
    assert_eq!(again.as_ref(), Ok(&settings), "{}", settings.to_yaml());
    let image = mended(image);
    let raster = Raster::parse(&image).ok();
    let raster = raster.unwrap_or_else(|| {
        Raster::from_fn(4, 4, 255, |x, y| 16 * (4 * y + x)).expect("a picture of 16 pixels")
    });
    if u64::from(raster.width()) * u64::from(raster.height()) > MOST {
        return;
    }
    let map = RosMap::new(settings, raster).expect("settings that were read");
    let grid = map.to_grid(&MapOptions::default());
    for version in [RosVersion::Ros1, RosVersion::Ros2] {
        let cells = u64::from(grid.width()) * u64::from(grid.height());
        assert_eq!(map.occupancies(version).len() as u64, cells);
        assert!(map.occupancies(version).flatten().all(|occupancy| occupancy <= 100));
    }
    let files = |path: &Path| match path.extension() {
        Some(end) if end == "yaml" => Ok(yaml.to_vec()),
        _ if Raster::parse(&image).is_ok() => Ok(image.clone()),
        _ => Err(ReadError::Missing { path: path.to_owned() }),
    };
    if let Ok(source) = read_map_with("a.yaml", &MapOptions::default(), files) {
        assert_eq!(source.grid, grid);
        assert_eq!(source.frame, Some(map.frame()));
    }
}
