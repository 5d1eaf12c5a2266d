//! Where a raster is in the world, as its file says it.

use super::SurfaceError;

/// Where a raster is in the world: what its file says of it, kept for the file that is written.
///
/// Of a GeoTIFF these are its GeoKeys, its tie points, scale and transformation, and GDAL's metadata, byte by
/// byte; of an ESRI ASCII grid its lower left cell and the size of a cell, and of the `.prj` beside it
/// whether the coordinates are degrees. Each is written in the form of the other, too, but an ESRI ASCII grid
/// says nothing of the coordinate system.
///
/// ```
/// use mediant_formats::{Surface, SurfaceOptions};
/// let text = b"ncols 2\nnrows 1\nxllcorner 500\nyllcorner 30.5\ncellsize 10\n3 4\n";
/// let friction = Surface::parse(text, &SurfaceOptions::default())?;
/// let result = Surface::new(2, 1, vec![0.0, 35.0])?.with_georeference(friction.georeference().clone());
/// assert_eq!(result.cell_size(), Some((10.0, 10.0)));
/// assert_eq!(result.georeference().lower_left(), Some((500.0, 30.5)));
/// # Ok::<(), mediant_formats::SurfaceError>(())
/// ```
///
/// Needs the feature `surface`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Georeference {
    pub(super) cell_size: Option<(f64, f64)>,
    pub(super) origin: Option<Origin>,
    /// The tags of a GeoTIFF. They are what is written in one; size and origin follow from them.
    pub(super) tags: Vec<GeoTag>,
    /// Whether the file beside an ESRI ASCII grid says that the coordinates are longitudes and latitudes.
    pub(super) is_geographic: bool,
}

/// The place of the lower left cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Origin {
    pub(super) x: f64,
    pub(super) y: f64,
    /// Whether the place is the cell's center, or its lower left corner.
    pub(super) is_center: bool,
}

/// A tag of a GeoTIFF.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct GeoTag {
    pub(super) tag: u16,
    /// The number of its type in the TIFF specification.
    pub(super) kind: u16,
    /// Each number with its lowest byte first.
    pub(super) bytes: Vec<u8>,
}

/// The key of the kind of coordinates, and its value for longitudes and latitudes.
pub(super) const MODEL_TYPE: u16 = 1024;
pub(super) const GEOGRAPHIC: u16 = 2;

/// The directory of the GeoKeys.
pub(super) const GEO_KEYS: u16 = 34735;

impl Georeference {
    /// One that has the size of a cell only.
    ///
    /// # Errors
    /// [`SurfaceError::CellSize`] unless both are positive numbers.
    pub fn from_cell_size(x: f64, y: f64) -> Result<Self, SurfaceError> {
        let is_size = |side: f64| side.is_finite() && side > 0.0;
        if !is_size(x) || !is_size(y) {
            return Err(SurfaceError::CellSize { x, y });
        }
        Ok(Self { cell_size: Some((x, y)), ..Self::default() })
    }

    /// One that has the size of a cell, and the lower left corner of the raster.
    ///
    /// # Errors
    /// [`SurfaceError::CellSize`] unless both sides are positive numbers. A corner that is not finite is left
    /// out.
    pub fn from_lower_left(cell_size: (f64, f64), (x, y): (f64, f64)) -> Result<Self, SurfaceError> {
        let of_size = Self::from_cell_size(cell_size.0, cell_size.1)?;
        let origin = (x.is_finite() && y.is_finite()).then_some(Origin { x, y, is_center: false });
        Ok(Self { origin, ..of_size })
    }

    /// The width and the height of a cell, in the unit of the coordinate system; `None` if the file says
    /// nothing of it.
    #[must_use]
    pub const fn cell_size(&self) -> Option<(f64, f64)> {
        self.cell_size
    }

    /// The lower left corner of the raster; `None` if the file says nothing of it, or the raster is rotated.
    #[must_use]
    pub fn lower_left(&self) -> Option<(f64, f64)> {
        let (Origin { x, y, is_center }, (width, height)) = self.origin.zip(self.cell_size)?;
        Some(if is_center { (x - width / 2.0, y - height / 2.0) } else { (x, y) })
    }

    /// Whether the coordinates are longitudes and latitudes: the GeoKey `GTModelTypeGeoKey` is 2,
    /// 'geographic', or the `.prj` beside an ESRI ASCII grid has such a system (`GEOGCS`). Then a cell is
    /// narrower the nearer it is to a pole, and lengths in the unit of its size are no lengths on the ground.
    /// Project the raster first (`gdalwarp -t_srs …`), or weigh each row by
    /// [`Surface::cell_meters`](super::Surface::cell_meters).
    ///
    /// Other files do not say it, nor does an ESRI ASCII grid that is no file.
    #[must_use]
    pub fn is_in_degrees(&self) -> bool {
        self.is_geographic || self.geo_key(MODEL_TYPE) == Some(GEOGRAPHIC)
    }

    /// The short value of a GeoKey.
    pub(super) fn geo_key(&self, key: u16) -> Option<u16> {
        let directory = self.tags.iter().find(|tag| tag.tag == GEO_KEYS)?;
        let (shorts, _) = directory.bytes.as_chunks::<2>();
        // The first four are versions and the number of keys; each key has its number, the place of its value
        // (0: here), their number, and the value.
        let (keys, _) = shorts.get(4..)?.as_chunks::<4>();
        let mut keys = keys.iter().map(|words| words.map(u16::from_le_bytes));
        keys.find_map(|[number, place, _, value]| (number == key && place == 0).then_some(value))
    }
}
