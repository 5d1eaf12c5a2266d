//! Options for reading map files.

use mediant_grid::names;

use crate::{Fraction, Tiles};

/// Which cells of a map are blocked: which pixels of a picture, which characters of a MovingAI map, and by
/// whose rules a ROS map is read.
///
/// ```
/// use mediant_formats::{Fraction, MapOptions, Raster};
/// let raster = Raster::parse(b"P2 2 1 100  20 30")?;
/// let mut options = MapOptions { threshold: Fraction::new(3, 10).unwrap(), ..MapOptions::default() };
/// assert!(raster.to_grid(&options).is_blocked(0, 0) && raster.to_grid(&options).is_free(1, 0));
/// options.invert = true;
/// assert!(raster.to_grid(&options).is_free(0, 0));
/// # Ok::<(), mediant_formats::RasterError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MapOptions {
    /// A pixel that is darker than this part of white is blocked; a pixel of just this shade is free. One
    /// half by default.
    ///
    /// In a ROS map this holds for the occupancy instead: a cell that is occupied to p % is blocked where
    /// p / 100 is *more than* 1 − `threshold`. So all cells above 50 are, by default.
    pub threshold: Fraction,
    /// Takes the picture as a negative: light pixels are blocked. Off by default. A ROS map states this
    /// itself, by `negate`, and is not inverted by this.
    pub invert: bool,
    /// The state of unknown cells: pixels less than half opaque, and the unknown cells of a ROS map. Blocked
    /// by default.
    pub unknown: Unknown,
    /// By whose rules the picture of a ROS map is read. ROS 2's by default.
    pub ros: RosVersion,
    /// Which characters of a MovingAI map are free.
    pub tiles: Tiles,
}

impl Default for MapOptions {
    fn default() -> Self {
        Self {
            threshold: Fraction::HALF,
            invert: false,
            unknown: Unknown::Blocked,
            ros: RosVersion::Ros2,
            tiles: Tiles::default(),
        }
    }
}

/// The state of unknown cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Unknown {
    /// They are blocked.
    #[default]
    Blocked,
    /// They are free.
    Free,
}

names!(Unknown: Blocked => "blocked", Free => "free");

/// The `map_server` whose rules make occupancies of the pixels of a ROS map.
///
/// A pixel is *occupied to* p = 1 − its shade, as a part of white, or to its shade if the map is negated.
/// The proportion of mode scale is (p − `free_thresh`) / (`occupied_thresh` − `free_thresh`).
///
/// | | ROS 2 | ROS 1 |
/// |---|---|---|
/// | shade | luma: ⌊(306 red + 601 green + 117 blue) / 1024⌋ in 8 bits | mean of the channels, exact |
/// | arithmetic | single precision | exact |
/// | free | p ≤ `free_thresh`, even if it is occupied, too | p < `free_thresh` |
/// | occupied | p ≥ `occupied_thresh` | p > `occupied_thresh` |
/// | scale, between | by proportion, 0 to 100, halves away from 0 | the same, halves to even |
/// | raw | the luma of 0 to 100, others unknown | the nearest of 256 shades, the same |
/// | not opaque, trinary | unknown | the opacity is one more channel of the mean |
/// | not opaque, scale | unknown | unknown |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RosVersion {
    /// The `map_server` of ROS 1, and that of nav2 until 2025.
    Ros1,
    /// The `map_server` of nav2 since 2025 (navigation2, pull request 5071).
    #[default]
    Ros2,
}
