//! The place of a GeoTIFF in the world, and its number for 'no data'.

use super::{
    super::{
        SurfaceError,
        georeference::{GEO_KEYS, GEOGRAPHIC, GeoTag, Georeference, MODEL_TYPE, Origin},
        source::Source,
    },
    Directory,
    directory::number_bytes,
};

const SCALE: u16 = 33550;
const TIE_POINTS: u16 = 33922;
const TRANSFORMATION: u16 = 34264;
pub(super) const NO_DATA: u16 = 42113;

/// The tags that are kept: with these the parameters of the GeoKeys and the metadata of GDAL.
const KEPT: [u16; 8] = [SCALE, TIE_POINTS, TRANSFORMATION, GEO_KEYS, 34736, 34737, 42112, NO_DATA];

/// The types of values, by their numbers in the TIFF specification.
const ASCII: u16 = 2;
const SHORT: u16 = 3;
const DOUBLE: u16 = 12;

/// The key that says whether a place is that of a cell's center, and its two values.
const RASTER_TYPE: u16 = 1025;
const AREA: u16 = 1;
const POINT: u16 = 2;

/// The tags of the file that say where it is.
pub(super) fn tags(directory: &Directory, source: &mut Source<'_>) -> Result<Vec<GeoTag>, SurfaceError> {
    let mut tags = Vec::new();
    for tag in KEPT {
        if let Some((kind, bytes)) = directory.bytes(tag, source)? {
            tags.push(GeoTag { tag, kind, bytes });
        }
    }
    Ok(tags)
}

/// The numbers of a tag of DOUBLEs.
fn doubles(tags: &[GeoTag], tag: u16) -> Vec<f64> {
    let tag = tags.iter().find(|other| other.tag == tag && other.kind == DOUBLE);
    let (words, _) = tag.map(|tag| tag.bytes.as_chunks::<8>()).unwrap_or_default();
    words.iter().map(|&word| f64::from_le_bytes(word)).collect()
}

/// The size of a cell and the place of the lower left one, from the tags.
pub(super) fn georeference(tags: Vec<GeoTag>, height: u32) -> Result<Georeference, SurfaceError> {
    // A cell's size, and the place of the begin of the upper left cell, or of its center.
    let (size, upper_left) = match (&doubles(&tags, SCALE)[..], &doubles(&tags, TRANSFORMATION)[..]) {
        ([x, y, ..], _) => {
            let (x, y) = (x.abs(), y.abs());
            let tie = match doubles(&tags, TIE_POINTS)[..] {
                [column, row, _, right, up, ..] => Some((right - column * x, up + row * y)),
                _ => None,
            };
            ((x, y), tie)
        }
        ([], &[right, skew, _, left, turn, down, _, top, ..]) => {
            affine([right, skew, left], [turn, down, top])?
        }
        _ => return Ok(Georeference { tags, ..Georeference::default() }),
    };
    let Ok(sized) = Georeference::from_cell_size(size.0, size.1) else {
        return Ok(Georeference { tags, ..Georeference::default() });
    };
    let mut georeference = Georeference { tags, ..sized };
    let is_center = georeference.geo_key(RASTER_TYPE) == Some(POINT);
    let below = f64::from(height - u32::from(is_center)) * size.1;
    let origin = upper_left.map(|(x, y)| Origin { x, y: y - below, is_center });
    georeference.origin = origin.filter(|origin| origin.x.is_finite() && origin.y.is_finite());
    Ok(georeference)
}

type Size = (f64, f64);

/// The same from the two rows of a transformation: a place is right · column + skew · row + left, and alike
/// for the other coordinate.
fn affine(
    [right, skew, left]: [f64; 3],
    [turn, down, top]: [f64; 3],
) -> Result<(Size, Option<(f64, f64)>), SurfaceError> {
    if skew == 0.0 && turn == 0.0 && right > 0.0 && down < 0.0 {
        return Ok(((right, -down), Some((left, top))));
    }
    let (x, y) = (right.hypot(turn), skew.hypot(down));
    // Of rotated rasters cells are rectangles, too, but for rounding.
    if (right * skew + turn * down).abs() > 1e-9 * x * y {
        return Err(SurfaceError::Tiff {
            expected: "cells that are rectangles".to_owned(),
            found: "a sheared raster".to_owned(),
            remedy: "warp it, for example by `gdalwarp`",
        });
    }
    Ok(((x, y), None))
}

/// The number that GDAL's tag says.
pub(super) fn no_data(georeference: &Georeference) -> Option<f64> {
    let tag = georeference.tags.iter().find(|tag| tag.tag == NO_DATA && tag.kind == ASCII)?;
    let text = tag.bytes.split(|&byte| byte == 0).next()?;
    std::str::from_utf8(text).ok()?.trim().parse().ok()
}

/// The tags for a raster: the ones that it was read with, or new ones. Its 'no data' may be another by now.
pub(super) fn tags_of(georeference: &Georeference, height: u32, no_data_now: Option<f64>) -> Vec<GeoTag> {
    let mut tags = georeference.tags.clone();
    let of_doubles = |tag, numbers: &[f64]| {
        let bytes = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        GeoTag { tag, kind: DOUBLE, bytes }
    };
    if let (true, Some((x, y))) = (tags.is_empty(), georeference.cell_size) {
        let origin = georeference.origin.unwrap_or(Origin { x: 0.0, y: 0.0, is_center: false });
        let above = f64::from(height - u32::from(origin.is_center)) * y;
        tags.push(of_doubles(SCALE, &[x, y, 0.0]));
        tags.push(of_doubles(TIE_POINTS, &[0.0, 0.0, 0.0, origin.x, origin.y + above, 0.0]));
        let is = if origin.is_center { POINT } else { AREA };
        let geographic = [MODEL_TYPE, 0, 1, GEOGRAPHIC];
        let of_model = if georeference.is_geographic { &geographic[..] } else { &[] };
        let count = if georeference.is_geographic { 2 } else { 1 };
        let keys = [&[1, 1, 0, count], of_model, &[RASTER_TYPE, 0, 1, is]].concat();
        let bytes = keys.into_iter().flat_map(u16::to_le_bytes).collect();
        tags.push(GeoTag { tag: GEO_KEYS, kind: SHORT, bytes });
    }
    let before = no_data(georeference).filter(|number| !number.is_nan());
    if before != no_data_now {
        tags.retain(|tag| tag.tag != NO_DATA);
        if let Some(number) = no_data_now {
            tags.push(GeoTag { tag: NO_DATA, kind: ASCII, bytes: format!("{number}\0").into_bytes() });
        }
    }
    // In the order of this machine.
    if cfg!(target_endian = "big") {
        for tag in &mut tags {
            let (_, part) = number_bytes(tag.kind).unwrap_or((1, 1));
            tag.bytes.chunks_exact_mut(part).for_each(<[u8]>::reverse);
        }
    }
    tags
}
