//! How a picture becomes a map.

use crate::Fraction;

/// Which pixels of a picture are blocked cells.
///
/// ```
/// use mediant_formats::{Fraction, ImageOptions, Raster};
/// let raster = Raster::parse(b"P2 2 1 100  20 30")?;
/// let mut options = ImageOptions { threshold: Fraction::new(3, 10).unwrap(), ..ImageOptions::default() };
/// assert!(raster.to_grid(&options).is_blocked(0, 0) && raster.to_grid(&options).is_free(1, 0));
/// options.invert = true;
/// assert!(raster.to_grid(&options).is_free(0, 0));
/// # Ok::<(), mediant_formats::RasterError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageOptions {
    /// A pixel that is darker than this part of white is blocked; a pixel of just this shade is free. One
    /// half by default.
    ///
    /// In a ROS map this holds for the occupancy instead: a cell that is occupied to p % is blocked where
    /// p / 100 is *more than* 1 − `threshold`. So all cells above 50 are, by default.
    pub threshold: Fraction,
    /// Takes the picture as a negative: light pixels are blocked. Off by default. A ROS map states this
    /// itself, by `negate`, and is not inverted by this.
    pub invert: bool,
    /// What becomes of pixels that say nothing: those that are less than half opaque, and the unknown cells
    /// of a ROS map. Blocked by default.
    pub unknown: Unknown,
}

impl Default for ImageOptions {
    fn default() -> Self {
        Self { threshold: Fraction::HALF, invert: false, unknown: Unknown::Blocked }
    }
}

/// What becomes of cells about which nothing is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// They are blocked.
    #[default]
    Blocked,
    /// They are free.
    Free,
}
