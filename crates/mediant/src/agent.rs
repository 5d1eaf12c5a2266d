//! Agents of a size, and paths that keep off walls.

use std::{ops::Range, sync::Arc};

use mediant_grid::{Clearance, Fit, Grid, Outside, Rectangle, Vertex};
use mediant_search::{Answer, Ends, Limit, Limits, Path, Query};

use crate::{choice::Choice, error::Error, map::Map, motion::Motion, space::Space};

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
        let fit = Fit::exact(motion.rules, motion.k);
        Ok(self.clearance(fit, Outside::Blocked).for_disc(radius)?.into())
    }

    /// The map of a disc, as [`for_disc`](Self::for_disc) has it, together with this one, so that edits of
    /// obstacles keep the disc's distance from them.
    ///
    /// # Errors
    /// As for [`for_disc`](Self::for_disc).
    pub fn disc(&self, radius: f64, motion: impl Into<Motion>) -> Result<Disc, Error> {
        let motion = motion.into();
        Ok(Disc { obstacles: self.clone(), map: self.for_disc(radius, motion)?, radius, motion })
    }

    /// The map of an agent that occupies n × n cells. Its place is its top left cell: a cell is free if all
    /// n × n cells from it on, to the right and down, are.
    /// [`Grid::for_square`](mediant_grid::Grid::for_square) states the guarantees for the moving square.
    ///
    /// # Errors
    /// [`Error::Size`] for n = 0.
    pub fn for_square(&self, n: u32) -> Result<Self, Error> {
        Ok(self.grid().for_square(n)?.into())
    }

    /// The distance of each cell to the nearest obstacle, and the maps of discs of all radii.
    #[must_use]
    pub fn clearance(&self, fit: Fit, outside: Outside) -> Clearance {
        Clearance::new(Arc::clone(self.grid()), fit, outside)
    }
}

/// A disc among obstacles that change: the map of the obstacles, and that of the disc ([`Map::disc`]).
///
/// ```
/// use mediant::{K, Map, Motion, Rectangle};
///
/// let motion = Motion::centers(K::N8);
/// let disc = Map::from_fn(40, 9, |_, _| false)?.disc(1.5, motion)?;
/// let post = Rectangle::new(20, 4, 1, 1);
/// let disc = disc.edit(post, |_, _| true)?;
/// // The disc keeps off the post.
/// assert!(disc.map().is_blocked((21, 4)) && disc.obstacles().is_free((21, 4)));
/// let space = disc.map().space(motion)?;
/// # Ok::<(), mediant::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Disc {
    obstacles: Map,
    map: Map,
    radius: f64,
    motion: Motion,
}

impl Disc {
    /// Where the disc may be: the map to search.
    #[must_use]
    pub const fn map(&self) -> &Map {
        &self.map
    }

    /// The map of the obstacles.
    #[must_use]
    pub const fn obstacles(&self) -> &Map {
        &self.obstacles
    }

    /// The radius of the disc, in cells.
    #[must_use]
    pub const fn radius(&self) -> f64 {
        self.radius
    }

    /// The disc among other obstacles in a rectangle: see [`Map::edit`]. The work follows the rectangle and
    /// the radius, not the map.
    ///
    /// # Errors
    /// As for [`Map::edit`].
    pub fn edit(&self, at: Rectangle, blocked: impl FnMut(u32, u32) -> bool) -> Result<Self, Error> {
        let obstacles = self.obstacles.edit(at, blocked)?;
        let map = match self.around(&obstacles, at)? {
            Some(map) => map,
            None => obstacles.for_disc(self.radius, self.motion)?,
        };
        Ok(Self { obstacles, map, ..*self })
    }

    /// The disc's map where only what is near a rectangle is measured anew; `None` if that is most of the
    /// map.
    fn around(&self, obstacles: &Map, at: Rectangle) -> Result<Option<Map>, Error> {
        let sides = [(at.x, at.width, obstacles.width()), (at.y, at.height, obstacles.height())];
        // An obstacle farther than this from every point of a cell cannot touch the disc. It saturates.
        let reach = self.radius.ceil() as i64 + 1;
        // The cells whose room may change, and those whose obstacles decide it: those beyond the map are
        // blocked.
        let [columns, rows] = sides.map(|(first, count, side)| {
            let (first, end) = (i64::from(first), i64::from(first) + i64::from(count));
            let changed = (first - reach).max(0)..(end + reach).min(i64::from(side));
            let read = changed.start.saturating_sub(reach)..changed.end.saturating_add(reach);
            (changed, read)
        });
        let area = |columns: &Range<i64>, rows: &Range<i64>| {
            (columns.end - columns.start).saturating_mul(rows.end - rows.start)
        };
        let whole = i64::from(obstacles.width()) * i64::from(obstacles.height());
        if reach > i64::from(Grid::MAX_SIDE) || area(&columns.1, &rows.1) > whole {
            return Ok(None);
        }
        // All of these are near the map, so 32 bits hold them.
        let (left, top) = (columns.1.start as i32, rows.1.start as i32);
        let side = |range: &Range<i64>| (range.end - range.start) as u32;
        let near = Grid::from_fn(side(&columns.1), side(&rows.1), |x, y| {
            obstacles.is_blocked((left + x as i32, top + y as i32))
        })?;
        let Motion { k, rules, .. } = self.motion;
        let room =
            Clearance::new(Arc::new(near), Fit::exact(rules, k), Outside::Open).for_disc(self.radius)?;
        let changed = Rectangle {
            x: columns.0.start as u32,
            y: rows.0.start as u32,
            width: side(&columns.0),
            height: side(&rows.0),
        };
        let blocked = |x: u32, y: u32| room.is_blocked(x as i32 - left, y as i32 - top);
        Ok(Some(self.map.grid().with_rectangle(changed, blocked).into()))
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
    /// or not a number.
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
        if surplus.is_nan() || surplus < 0.0 {
            return Err(mediant_search::QueryError::CostLimit.into());
        }
        let Some(shortest) = self.path_of(Ends::new(start, goal), limits)? else { return Ok(None) };
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
