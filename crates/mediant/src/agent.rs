//! Agents of a size, and paths that keep off walls.

mod kept;

use std::sync::Arc;

use mediant_grid::{Clearance, Fit, Outside, Vertex};
use mediant_search::{Answer, Limit, Limits, Path, PointEnds, Query};

pub use self::kept::{Disc, Square};
use crate::{choice::Choice, error::Error, map::Map, motion::Motion, setup_error::SetupError, space::Space};

impl Map {
    /// The map of a disc, whose radius is in cells: it is free where the disc fits. On each path over this
    /// motion on that map the moving disc keeps its radius: it touches obstacles at most
    /// ([guarantees](Clearance#guarantees)).
    ///
    /// For several radii make a [`clearance`](Self::clearance), which is measured once and also has looser
    /// fits.
    ///
    /// An edit of the map that this returns changes where the disc may be, and gives a new obstacle no
    /// margin. For obstacles that come and go make a [`disc`](Self::disc).
    ///
    /// ```
    /// use mediant::{K, Map, Motion};
    ///
    /// let motion = Motion::centers(K::N8);
    /// let map = Map::from_fn(40, 9, |x, y| x == 20 && y != 4)?;
    /// assert!(map.for_disc(0.5, motion)?.path((2, 4), (38, 4))?.is_some());
    /// assert!(map.for_disc(0.6, motion)?.path((2, 4), (38, 4))?.is_none());
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Size`] for a radius that is negative or not finite; [`Error::K`] or
    /// [`SetupError::Motion`](crate::errors::SetupError::Motion) for a number that is no k.
    pub fn for_disc(&self, radius: f64, motion: impl Into<Motion>) -> Result<Self, Error> {
        let motion = motion.into();
        motion.check_k()?;
        self.check_sides("clearance")?;
        let fit = Fit::exact(motion.rules, motion.k);
        let clearance = self.within(crate::limits::Limits::new()).clearance(fit, Outside::Blocked)?;
        Ok(clearance.for_disc(radius)?.into())
    }

    /// The map of a disc, as [`for_disc`](Self::for_disc) has it, together with this one, so that edits of
    /// obstacles keep the disc's distance from them.
    ///
    /// # Errors
    /// As for [`for_disc`](Self::for_disc).
    pub fn disc(&self, radius: f64, motion: impl Into<Motion>) -> Result<Disc, Error> {
        let motion = motion.into();
        Disc::new(self, radius, motion)
    }

    /// The map of an agent that occupies n × n cells. Its place is its top left cell: a cell is free if all
    /// n × n cells from it on, to the right and down, are.
    /// [`Grid::for_square`](mediant_grid::Grid::for_square) states the guarantees for the moving square.
    ///
    /// # Errors
    /// [`Error::Size`] for n = 0; [`SetupError::LongSide`] for a map that is for costs alone.
    pub fn for_square(&self, n: u32) -> Result<Self, Error> {
        self.check_sides("clearance")?;
        Ok(self.grid().for_square(n)?.into())
    }

    /// The map of a square, as [`for_square`](Self::for_square) has it, together with this one, so that it
    /// follows edits of obstacles.
    ///
    /// # Errors
    /// As for [`for_square`](Self::for_square).
    pub fn square(&self, n: u32) -> Result<Square, Error> {
        Square::new(self, n)
    }

    /// The distance of each cell to the nearest obstacle, and the maps of discs of all radii. After an edit
    /// of the map it follows by [`Clearance::after`]. On a map with sides beyond
    /// [`Grid::MAX_SIDE`](mediant_grid::Grid::MAX_SIDE), which is for costs alone, nothing fits anywhere.
    #[must_use]
    pub fn clearance(&self, fit: Fit, outside: Outside) -> Clearance {
        self.clearance_or_none(fit, outside)
    }
}

/// A path that keeps off walls: see [`Space::widest_path`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct WidestPath {
    /// The path.
    pub path: Path,
    /// The radius, in cells, of the disc that keeps its distance to all obstacles along the path.
    pub radius: f64,
}

impl Space {
    /// Of all paths whose length is at most (1 + `surplus`) times that of the shortest, one that keeps off
    /// walls farthest, measured where it comes nearest to one; and of these a shortest. With a surplus of 0
    /// it is a shortest path of the space; 0.1 allows 10 % more. `None` if there is no path.
    ///
    /// 'Keeps off' is exact: no path that is short enough lies on the map of a larger disc
    /// ([`Clearance::widest`]). How far a path keeps off elsewhere is not promised. There is one search for
    /// each of the discs that a bisection tries: about ten.
    ///
    /// ```
    /// use mediant::{K, Map, Motion};
    ///
    /// // A wall with a gap of one cell on the straight way, and a wide opening below.
    /// let map = Map::from_fn(20, 15, |x, y| x == 10 && y != 3 && y < 9)?;
    /// let space = map.space(Motion::centers(K::N8))?;
    /// let shortest = space.widest_path((2, 3), (17, 3), 0.0)?.expect("there is a way");
    /// let wider = space.widest_path((2, 3), (17, 3), 1.0)?.expect("there is a way");
    /// assert_eq!((shortest.radius, wider.radius), (0.5, 2.5));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Query`] for a start or goal that is blocked or outside the map, or a surplus that is negative
    /// or not a number; [`Error::Setup`] where cells have costs.
    pub fn widest_path(
        &self,
        start: impl Into<Vertex>,
        goal: impl Into<Vertex>,
        surplus: f64,
    ) -> Result<Option<WidestPath>, Error> {
        self.within(Limits::new()).widest_path(start, goal, surplus)
    }

    pub(crate) fn widest_path_of(
        &self,
        [start, goal]: [Vertex; 2],
        surplus: f64,
        limits: &Limits,
    ) -> Result<Option<WidestPath>, Error> {
        let Motion { k, rules, .. } = self.motion();
        self.check_is_without_costs(SetupError::WIDEST_ON_COSTS)?;
        if surplus.is_nan() || surplus < 0.0 {
            return Err(mediant_search::QueryError::CostLimit.into());
        }
        let Some(shortest) = self.path_of(PointEnds::new(start, goal), limits)? else { return Ok(None) };
        // Two paths of one length can have sums that differ in the last digits.
        let greatest = match surplus {
            f64::INFINITY => f64::INFINITY,
            surplus => shortest.cost() * (1.0 + surplus) * (1.0 + 1e-12),
        };
        let clearance = self.map().within(limits).clearance(Fit::exact(rules, k), Outside::Blocked)?;
        let at_ends = [start, goal].map(|at| clearance.largest_disc_at(rules.placement(), at).unwrap_or(0.0));
        let at_most = at_ends[0].min(at_ends[1]);
        let widest = clearance.widest_interruptible(at_most, limits.interrupt(), |grid| {
            let space = Map::from(Arc::clone(grid)).within(limits).space(self.motion())?;
            if !(space.is_free(start) && space.is_free(goal)) {
                return Ok::<_, Error>(None);
            }
            let query = Query::new(start, goal).within(limits.clone().cost(greatest));
            let index = space.within(limits).prepare_for_one_path(Choice::for_one_path(self.motion()))?;
            Ok(match index.try_planner()?.find(query)? {
                Answer::Found(path) => Some(path),
                Answer::Stopped(stopped) if stopped.by != Limit::Cost => {
                    return Err(Error::Stopped { by: stopped.by, during: "searching a path" });
                }
                _ => None,
            })
        })?;
        Ok(widest.map(|widest| WidestPath { path: widest.found, radius: widest.radius }))
    }
}
