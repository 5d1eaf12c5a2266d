//! Agents of a size: how far each cell is from the nearest obstacle, and the maps of discs and squares.
//!
//! **The key decision: an agent's map is a map.** Which cells are free for a disc is a [`Grid`] like any
//! other, so every engine searches it, and everything that can be prepared of a map can be prepared of it.
//! [`Clearance`] proves which distance the disc keeps along a path of that map, for each placement.
//!
//! One exact squared Euclidean distance transform, [`transform`], serves all radii: [`columns`] finds how far
//! the nearest obstacle is in each column, and [`envelope`] combines the columns row by row. A map for one
//! radius is then one comparison a cell ([`disc`]).

mod centers;
mod columns;
mod disc;
mod envelope;
mod exact;
mod fit;
mod radii;
mod repair;
mod sites;
mod square;
mod transform;
mod widest;

use std::sync::Arc;

use crate::{
    Grid, PlacementKind, Versioned, Vertex,
    interrupt::{Interrupt, Interrupted, uninterrupted},
};

pub use exact::SizeError;
pub use fit::{Fit, Outside};
pub use widest::Widest;

/// How far each cell of a map is from the nearest obstacle, and so which cells are free for discs of all
/// radii.
///
/// An obstacle is a blocked cell, as a closed square of side 1; the outside of the map is one too, unless
/// [`Outside::Open`] says otherwise. The [`Fit`] says whether cell centers keep the distance, or whole cells.
/// Distances are Euclidean and exact, and measured in linear time; with the feature `parallel` in rayon's
/// current pool, with the same result.
///
/// ```
/// use std::sync::Arc;
/// use mediant_grid::{AsciiMap, Clearance, Fit, Outside, PlacementKind, draw};
/// let map = AsciiMap::parse("
///     .......
///     .......
///     ...#...
///     .......
///     .......
/// ")?;
/// let clearance = Clearance::new(Arc::new(map.grid), Fit::Centers, Outside::Open);
/// // From the center of a cell to the edge of the blocked one.
/// assert_eq!(clearance.distance((1, 2).into()), 1.5);
/// let for_disc = clearance.for_disc(1.5)?;
/// assert_eq!(
///     draw(&for_disc, PlacementKind::Center, &[]),
///     ".......\n..###..\n..###..\n..###..\n.......\n"
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Guarantees
///
/// A disc *keeps* radius r on a path if every point of the path has a distance of at least r to each
/// obstacle: the disc of this radius around the point touches obstacles at most. Let a path be legal on the
/// map that [`for_disc`](Self::for_disc) returns for radius r. Then the disc keeps
///
/// | | [`Fit::Centers`] | [`Fit::WholeCells`] |
/// |---|---|---|
/// | centers, N(2); N(3) under [`CornerRule::Never`](crate::CornerRule::Never) | r | r |
/// | centers, all other k and rules, and any angle | r − ½ | r |
/// | corners, all k and rules, and any angle | r − √½ | r |
///
/// [`Fit::exact`] names the looser fit that keeps r. With `Fit::Centers` exactly those centers are free on
/// which the disc can stand. N(2) then has all steps that the disc can make; a diagonal step needs room on
/// both sides, as for a point under `Never`.
///
/// **Proof.** A point of a legal path lies in the closed square of a cell that is free on the agent's map. At
/// centers a segment stays in such squares by definition; at corners it runs through the interior of free
/// cells or along their edges. (1) With whole cells, all points of a free square are at least r away. (2) The
/// center of a free square is at most √½ away from each of its points: the last line.
///
/// (3) The first line. Cells are as wide as the distance between neighboring centers. So between two of
/// them, along each axis, the gap to a blocked square only grows or only shrinks: it is 0 up to a
/// line half way, or from there on, or never. On a step along an axis the distance is then least at one of
/// its ends, and on a diagonal step it is at least that of one of the four centers around it, all of which
/// are free under `Never`.
///
/// (4) The second line. Let p lie in the free cell c, at (x, y) seen from its center. Turn the map so that
/// the obstacle is not to the left of c and not below it. If x ≤ 0 or y ≤ 0, or if the obstacle is straight
/// to the right or straight above, then only one of the two gaps is smaller at p than at the center, by at
/// most ½, and so is the distance. Otherwise x + y > 0. The center of c and its left and lower edge have x +
/// y ≤ 0, so a segment through p meets the right or the upper edge, and not only where these end. If it meets
/// the corner between these, the cell beyond is swept, and so is free, and its center has no larger gaps than
/// p. Otherwise the cell to the right is swept (or the one above): along x the gap of its center is not
/// larger than that of p, and along y larger by at most ½. ∎
///
/// The ½ is not too much: under [`CornerRule::One`](crate::CornerRule::One) a diagonal step beside one
/// blocked cell touches it, where discs of radius ½ may pass. Nor is √½: at corners a path may turn at the
/// corner of a free cell.
#[derive(Clone, Debug)]
pub struct Clearance {
    grid: Arc<Grid>,
    fit: Fit,
    outside: Outside,
    /// Whether there is no obstacle at all.
    unlimited: bool,
    /// The squared distance of each center, in half cells, or of each corner vertex, in cells. See
    /// [`transform`].
    squared: Versioned<u32>,
}

impl Clearance {
    /// Measures a map. Four bytes a cell, and linear time.
    #[must_use]
    pub fn new(grid: Arc<Grid>, fit: Fit, outside: Outside) -> Self {
        uninterrupted(|never| Self::interruptible(grid, fit, outside, never))
    }

    /// [`new`](Self::new), which an interrupt can stop; it asks before each row.
    ///
    /// # Errors
    /// [`Interrupted`].
    pub fn interruptible(
        grid: Arc<Grid>,
        fit: Fit,
        outside: Outside,
        interrupt: &Interrupt,
    ) -> Result<Self, Interrupted> {
        let sites = sites::Sites { rows: grid.rows(), measure: fit.into(), outside };
        let squared = transform::squared_distances(sites, interrupt)?;
        let (width, height) = (u64::from(grid.width()), u64::from(grid.height()));
        let unlimited = outside == Outside::Open && grid.free_cells() == width * height;
        Ok(Self { fit, outside, unlimited, squared: squared.into_vec().into(), grid })
    }
}

impl Clearance {
    /// The distance, in cells, from a point to the nearest obstacle: from the center of cell `at` with
    /// [`Fit::Centers`], from corner vertex `at` with [`Fit::WholeCells`]. 0 on obstacles and outside the
    /// map; infinite if there are none within 32,767 cells.
    ///
    /// It is exact but for rounding: the largest number that is not above the distance.
    #[must_use]
    pub fn distance(&self, at: Vertex) -> f64 {
        self.squared(at).map_or(0.0, |squared| self.root(squared))
    }

    /// The radius of the largest disc for which a cell is free: [`for_disc`](Self::for_disc) with this radius
    /// leaves the cell free, and with the next larger number it does not. `None` for blocked cells; infinite
    /// if no disc is too large.
    #[must_use]
    pub fn largest_disc(&self, cell: Vertex) -> Option<f64> {
        let free = self.grid.is_free(cell.x, cell.y);
        free.then(|| self.root(self.squared_of_cell(cell.x as usize, cell.y as usize)))
    }

    /// The radius of the largest disc for which a path may stand on a vertex: of its cell, or at corners of
    /// that of its four cells which has the most. `None` for vertices that are not free.
    #[must_use]
    pub fn largest_disc_at(&self, placement: PlacementKind, at: Vertex) -> Option<f64> {
        let cells = match placement {
            PlacementKind::Center => &[(0, 0)][..],
            PlacementKind::Corner => &[(0, 0), (-1, 0), (0, -1), (-1, -1)],
        };
        let cells = cells.iter().map(|&(dx, dy)| Vertex::new(at.x.wrapping_add(dx), at.y.wrapping_add(dy)));
        cells.filter_map(|cell| self.largest_disc(cell)).reduce(f64::max)
    }

    /// The map that was measured.
    #[must_use]
    pub const fn grid(&self) -> &Arc<Grid> {
        &self.grid
    }

    /// The points that were measured.
    #[must_use]
    pub const fn fit(&self) -> Fit {
        self.fit
    }

    /// The outside of the map: an obstacle or not.
    #[must_use]
    pub const fn outside(&self) -> Outside {
        self.outside
    }

    /// The memory used beyond the map, in bytes: four a cell.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        size_of_val(&*self.squared)
    }

    /// How many times a stored square is the square in cells.
    const fn scale(&self) -> u32 {
        match self.fit {
            Fit::Centers => 4,
            Fit::WholeCells => 1,
        }
    }

    /// The centers or corner vertices of a row.
    fn columns(&self) -> usize {
        self.grid.width() as usize + usize::from(self.fit == Fit::WholeCells)
    }

    /// The stored square of a center or corner vertex.
    fn squared(&self, at: Vertex) -> Option<u32> {
        let (x, y) = (usize::try_from(at.x).ok()?, usize::try_from(at.y).ok()?);
        let row = self.squared.chunks_exact(self.columns()).nth(y)?;
        row.get(x).copied()
    }

    /// The least stored square among the points of a cell on the map.
    fn squared_of_cell(&self, x: usize, y: usize) -> u32 {
        let columns = self.columns();
        let row = |y: usize| &self.squared[y * columns + x..];
        match self.fit {
            Fit::Centers => row(y)[0],
            Fit::WholeCells => row(y)[0].min(row(y)[1]).min(row(y + 1)[0]).min(row(y + 1)[1]),
        }
    }

    /// The radius of a stored square.
    fn root(&self, squared: u32) -> f64 {
        if squared == u32::MAX { f64::INFINITY } else { exact::root(squared, self.scale()) }
    }
}
