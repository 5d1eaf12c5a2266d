//! Whether a path still holds.

use mediant_grid::{Centers, Corners, PlacementKind};
use mediant_search::{BrokenPath, Path};

use crate::{
    change::Change,
    space::{Placed, Space},
};

impl Space {
    /// Whether a path obeys the rules of motion in this space, at any angle: whether it still holds after an
    /// [`edit`](Self::edit), before anything is searched again. It asks for sight along each segment.
    ///
    /// Whether the segments are moves of N(k) is another question ([`Path::is_over`]): a smoothed path holds
    /// without.
    ///
    /// ```
    /// use mediant::{K, Map, Motion, Rectangle, errors::BrokenPath};
    /// let space = Map::from_rows(["....", "...."])?.space(Motion::centers(K::N8))?;
    /// let path = space.path((0, 0), (3, 0))?.expect("there is a way");
    /// assert_eq!(space.check(&path), Ok(()));
    /// let edited = space.edit_cells([((2, 0), true)])?.after().clone();
    /// let broken = edited.check(&path).unwrap_err();
    /// assert!(matches!(broken, BrokenPath::Segment { by, .. } if by.cell() == Some((2, 0))));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// A [`BrokenPath`] for what is found first: no waypoint, one outside the map, a blocked end, the segment
    /// that does not hold, with the first blocked cell on it, or a closed gap that the path crosses.
    pub fn check(&self, path: &Path) -> Result<(), BrokenPath> {
        match self.placed() {
            Placed::Centers(layers) => path.check(&layers.free),
            Placed::Corners(layers) if self.is_between_centers() => {
                path.at_corners().check(&layers.free).map_err(BrokenPath::at_centers)
            }
            Placed::Corners(layers) => path.check(&layers.free),
        }
    }
}

impl Change {
    /// [`Space::check`] in the space after the change, of a path that held before it: with the same result,
    /// but only segments near the changed cells are looked at.
    ///
    /// ```
    /// use mediant::{Map, Motion};
    /// let space = Map::new(9, 9)?.space(Motion::default())?;
    /// let path = space.path((0, 0), (8, 0))?.expect("there is a way");
    /// assert!(space.edit_cells([((4, 1), true)])?.check(&path).is_ok());
    /// assert!(space.edit_cells([((4, 0), true)])?.check(&path).is_err());
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`Space::check`].
    pub fn check(&self, path: &Path) -> Result<(), BrokenPath> {
        match self.after().placed() {
            Placed::Centers(layers) => path.check_after(&layers.free, self.of_grid()),
            Placed::Corners(layers) if self.after().is_between_centers() => {
                let checked = path.at_corners().check_after(&layers.free, self.of_grid());
                checked.map_err(BrokenPath::at_centers)
            }
            Placed::Corners(layers) => path.check_after(&layers.free, self.of_grid()),
        }
    }

    /// The length below which no path from the path's start to its goal is that passes cells which the change
    /// has freed; infinite if it has freed none: see [`Path::least_by_freed`]. A shortest path that holds and
    /// is no longer than this is a shortest one still. Where cells have costs it is 0, which says nothing.
    #[must_use]
    pub fn least_by_freed(&self, path: &Path) -> f64 {
        if self.has_costs() {
            return 0.0;
        }
        match self.after().motion().rules.placement() {
            PlacementKind::Center => path.least_by_freed::<Centers>(self.of_grid()),
            PlacementKind::Corner => path.least_by_freed::<Corners>(self.of_grid()),
        }
    }
}
