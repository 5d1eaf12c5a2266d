//! Whether a path still holds.

use mediant_search::{BrokenPath, Path};

use crate::space::{Placed, Space};

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
            Placed::Corners(layers) => path.check(&layers.free),
        }
    }
}
