//! The file beside an ESRI ASCII grid that names its coordinate system.

use std::{io::Read, path::Path};

use crate::read::open_regular;

/// As much of the file is read: such systems take a few hundred bytes.
const MOST: u64 = 1 << 16;

/// Whether the `.prj` beside a file, if there is one that can be read, says that coordinates are longitudes
/// and latitudes.
pub(super) fn is_geographic(path: &Path) -> bool {
    let mut text = Vec::new();
    let read = |end: &str| open_regular(&path.with_extension(end)).ok();
    let file = read("prj").or_else(|| read("PRJ"));
    file.is_some_and(|(file, _)| file.take(MOST).read_to_end(&mut text).is_ok()) && is_of_degrees(&text)
}

/// Whether a coordinate system is one of longitudes and latitudes, in well-known text (of version 1, also as
/// ESRI writes it, or 2), or in the lines of older programs: `Projection GEOGRAPHIC`. A projected system
/// has a geographic one inside.
fn is_of_degrees(text: &[u8]) -> bool {
    let text = String::from_utf8_lossy(text).to_ascii_uppercase();
    let has = |names: &[&str]| names.iter().any(|name| text.contains(name));
    let mut words = text.split_whitespace();
    let is_of_lines =
        words.find(|&word| word == "PROJECTION").is_some() && words.next() == Some("GEOGRAPHIC");
    is_of_lines || has(&["GEOGCS", "GEOGCRS"]) && !has(&["PROJCS", "PROJCRS", "PROJECTEDCRS"])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems() {
        for (text, expected) in [
            ("GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\"],UNIT[\"Degree\",0.0174532925199433]]", true),
            ("geogcs[\"wgs 84\"]", true),
            ("GEOGCRS[\"WGS 84\",ENSEMBLE[\"World Geodetic System 1984 ensemble\"]]", true),
            ("COMPD_CS[\"x\",GEOGCS[\"WGS 84\"],VERT_CS[\"EGM96\"]]", true),
            ("Projection    GEOGRAPHIC\nDatum         WGS84\nUnits         DD\n", true),
            ("PROJCS[\"UTM\",GEOGCS[\"GCS_WGS_1984\"],PROJECTION[\"Transverse_Mercator\"]]", false),
            ("PROJCRS[\"UTM\",BASEGEOGCRS[\"WGS 84\"]]", false),
            ("Projection    UTM\nZone          32\n", false),
            ("LOCAL_CS[\"a yard\"]", false),
            ("", false),
            ("\u{fffd}\0", false),
        ] {
            assert_eq!(is_of_degrees(text.as_bytes()), expected, "{text}");
        }
    }
}
