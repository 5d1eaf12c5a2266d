//! The size of a cell on the ground, for rasters in degrees.

use super::Surface;

/// WGS 84: the half axis at the equator in meters, and the square of the first eccentricity.
const EQUATOR: f64 = 6_378_137.0;
const SQUARE_OF_ECCENTRICITY: f64 = 6.694_379_990_141_33e-3;

impl Surface {
    /// The width and the height in meters of the cells of a row, if the raster is
    /// [in degrees](Surface::is_in_degrees), measured at the middle of the row on the ellipsoid WGS 84. Sines
    /// and square roots are those of the platform: the last digit may be another one elsewhere.
    ///
    /// `None` for a raster that is not in degrees, has no place or cell size, or is rotated; for a row
    /// outside, and for one whose middle is beyond a pole.
    #[must_use]
    pub fn cell_meters(&self, row: u32) -> Option<(f64, f64)> {
        let ((_, bottom), (width, height)) = self.georeference.lower_left().zip(self.cell_size())?;
        let above = self.height.checked_sub(row).filter(|&above| above > 0)?;
        let latitude = bottom + (f64::from(above) - 0.5) * height;
        if !self.is_in_degrees() || latitude.abs() > 90.0 {
            return None;
        }
        let (sin, cos) = latitude.to_radians().sin_cos();
        let part = 1.0 - SQUARE_OF_ECCENTRICITY * sin * sin;
        // The radii of curvature along the parallel and along the meridian.
        let parallel = EQUATOR / part.sqrt() * cos;
        let meridian = EQUATOR * (1.0 - SQUARE_OF_ECCENTRICITY) / (part * part.sqrt());
        Some((width.to_radians() * parallel, height.to_radians() * meridian))
    }
}
