//! Walking over elevation.

use std::{fmt, sync::Arc};

use mediant_costs::{CostFieldError, Pace, WalkingBounds, WalkingError, WalkingMap};
use mediant_grid::{Interrupt, MapId, Vertex};
use mediant_search::{Limits, QueryError};

use crate::{
    error::Error, map::Map, memory_check, motion::Motion, never::NEVER, recent::Recent, space::Space,
    within::Within,
};

/// A map to walk on, made by [`Map::walking`]: free cells have an elevation, that of their centers, and a
/// [`Pace`] says how long a unit of length takes by the slope. It never changes. Clones share it.
///
/// **What a path costs** is its time: seconds, where elevations and cells are in meters and the pace in
/// seconds a meter, as those with a name are. Between four centers the ground is bilinear; a move is cut
/// where it crosses the lines between centers, and each piece has its own slope. So straight and diagonal
/// moves cost what they cost `r.walk` of GRASS, and longer ones what the ground below them does. A move and
/// the one back cost different times. Costs are exact integers inside, the same on every platform.
///
/// **What there is.** [`space`](Self::space) makes a [`Space`] between centers, for k = 2 to 8, with the
/// queries, limits and tables that all spaces have. Its engines are A* and Dijkstra's algorithm. A field has
/// a heading: [`Space::field`] has the times *to* the nearest source, [`Space::field_from`] those *from* it.
/// There are no edits of elevations: make the map anew.
#[derive(Clone)]
pub struct Walking {
    map: Map,
    ground: Arc<WalkingMap>,
    pace: Arc<Pace>,
    recent: Arc<Recent>,
}

impl Map {
    /// This map with the elevations of its cells, row by row, and the width and the height of a cell in the
    /// same unit. There is an elevation for each cell, those of blocked cells are not looked at.
    ///
    /// ```
    /// use mediant::{Map, Motion, Pace};
    ///
    /// // A ridge of 12 m with a saddle at the bottom, in cells of 10 m.
    /// let heights = [
    ///     0, 0, 12, 0, 0, //
    ///     0, 0, 12, 0, 0, //
    ///     0, 0, 3, 0, 0,
    /// ];
    /// let walking = Map::new(5, 3)?.walking(heights, (10.0, 10.0), &Pace::Tobler)?;
    /// let space = walking.space(Motion::centers(3))?;
    /// let path = space.path((0, 0), (4, 0))?.expect("there is a way");
    /// assert_eq!(path.to_string(), "(0, 0) → (2, 2) → (4, 0)");
    /// println!("{:.0} seconds, {:.1} cells", path.cost(), path.length());
    /// // All that is 40 seconds away from here.
    /// let reached = space.field_from_within([(0, 0)], 40.0)?;
    /// assert!(reached.get((2, 2)).is_some() && reached.get((4, 0)).is_none());
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Walking`] for another number of elevations than cells, for the first one of a free cell that
    /// is infinite or not a number, and for a pace that is no positive number on some slope of the map, or
    /// too far apart; [`Error::Costs`] for the size of a cell; [`Error::OutOfMemory`].
    pub fn walking<E: Into<f64>>(
        &self,
        elevations: impl IntoIterator<Item = E>,
        cell_size: (f64, f64),
        pace: &Pace,
    ) -> Result<Walking, Error> {
        Walking::new(self, &collected(elevations)?, None, (cell_size, pace), &NEVER)
    }

    /// [`walking`](Self::walking) with a friction for each cell: the time that a unit of length takes there
    /// beyond that of the pace, from 0 on.
    ///
    /// # Errors
    /// As for [`walking`](Self::walking); [`Error::Walking`] for another number of frictions than cells, and
    /// one that is negative, infinite or not a number.
    pub fn walking_with_friction<E: Into<f64>, F: Into<f64>>(
        &self,
        elevations: impl IntoIterator<Item = E>,
        frictions: impl IntoIterator<Item = F>,
        cell_size: (f64, f64),
        pace: &Pace,
    ) -> Result<Walking, Error> {
        let frictions = collected(frictions)?;
        Walking::new(self, &collected(elevations)?, Some(&frictions), (cell_size, pace), &NEVER)
    }
}

impl Map {
    /// This map with the elevation and the friction that `ground(x, y)` has for its free cells, without a
    /// list of them. Each is asked for three times. Of the limits the deadline and the flag count.
    ///
    /// ```
    /// use mediant::{Limits, Map, Pace};
    ///
    /// let ground = |x: u32, y: u32| (f64::from(x * y), 0.0);
    /// let walking = Map::new(3, 2)?.walking_by((30.0, 20.0), &Pace::Tobler, Limits::new(), ground)?;
    /// assert_eq!((walking.elevation((2, 1)), walking.friction((2, 1))), (Some(2.0), Some(0.0)));
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`walking_with_friction`](Self::walking_with_friction), and [`Error::Stopped`].
    pub fn walking_by(
        &self,
        cell_size: (f64, f64),
        pace: &Pace,
        limits: impl Into<Limits>,
        ground: impl Fn(u32, u32) -> (f64, f64),
    ) -> Result<Walking, Error> {
        Walking::of(self, (cell_size, pace), None, limits.into().interrupt(), ground)
    }

    /// The elevations that had these [bounds](Walking::ground_bounds), from the same elevations and frictions
    /// of the same map: a copy that was sent elsewhere, equal to the first one.
    ///
    /// # Errors
    /// As for [`walking_by`](Self::walking_by).
    pub fn walking_in(
        &self,
        bounds: WalkingBounds,
        cell_size: (f64, f64),
        pace: &Pace,
        limits: impl Into<Limits>,
        ground: impl Fn(u32, u32) -> (f64, f64),
    ) -> Result<Walking, Error> {
        Walking::of(self, (cell_size, pace), Some(bounds), limits.into().interrupt(), ground)
    }
}

fn collected<N: Into<f64>>(numbers: impl IntoIterator<Item = N>) -> Result<Vec<f64>, Error> {
    memory_check::collected("the elevations", numbers.into_iter().map(Into::into))
}

impl Walking {
    fn new(
        map: &Map,
        elevations: &[f64],
        frictions: Option<&[f64]>,
        by: ((f64, f64), &Pace),
        interrupt: &Interrupt,
    ) -> Result<Self, Error> {
        let columns = map.width() as usize;
        let expected = u64::from(map.width()) * u64::from(map.height());
        for (what, numbers) in [("elevations", Some(elevations)), ("frictions", frictions)] {
            if let Some(found) = numbers.map(<[f64]>::len).filter(|&found| found as u64 != expected) {
                return Err(WalkingError::Count { what, found, expected }.into());
            }
        }
        let friction = |at: usize| frictions.map_or(0.0, |frictions| frictions[at]);
        Self::of(map, by, None, interrupt, |x, y| {
            let at = y as usize * columns + x as usize;
            (elevations[at], friction(at))
        })
    }

    /// The free cells of a map, with the elevation and the friction of each; a copy, if it has bounds.
    pub(crate) fn of(
        map: &Map,
        (cell_size, pace): ((f64, f64), &Pace),
        bounds: Option<WalkingBounds>,
        interrupt: &Interrupt,
        ground: impl Fn(u32, u32) -> (f64, f64),
    ) -> Result<Self, Error> {
        let (grid, size) = (map.grid(), (map.width(), map.height()));
        let cells = u64::from(size.0) * u64::from(size.1);
        memory_check::check("the elevations", cells.saturating_mul(BYTES))?;
        let free = |x: u32, y: u32| grid.is_free(x as i32, y as i32).then(|| ground(x, y));
        let ground = match bounds {
            Some(bounds) => WalkingMap::with_bounds(size, cell_size, pace, bounds, interrupt, free),
            None => WalkingMap::with_friction(size, cell_size, pace, interrupt, free),
        };
        // Without what the map keeps for paths of its own.
        let (map, pace) = (Arc::clone(grid).into(), Arc::new(pace.clone()));
        Ok(Self { map, ground: Arc::new(ground?), pace, recent: Arc::default() })
    }

    /// This elevation without what it keeps, of which a space of it may become a part.
    pub(crate) fn alone(&self) -> Self {
        Self { map: Arc::clone(self.map.grid()).into(), recent: Arc::default(), ..self.clone() }
    }

    pub(crate) const fn recent(&self) -> &Arc<Recent> {
        &self.recent
    }

    /// This elevation with rules of motion, which are those of centers, and a k from 2 to 8.
    ///
    /// # Errors
    /// [`Error::K`] for a number that is no k, [`SetupError::CostsK`](crate::errors::SetupError::CostsK) for
    /// another k; [`Error::Walking`] for paths between corners.
    pub fn space(&self, motion: impl Into<Motion>) -> Result<Space, Error> {
        Space::of_walking(self, motion.into(), &NEVER)
    }

    /// The map: which cells are blocked.
    #[must_use]
    pub const fn map(&self) -> &Map {
        &self.map
    }

    /// The elevation of a cell; `None` for a blocked cell and outside the map. It is kept with 30 binary
    /// digits above the lowest one.
    #[must_use]
    pub fn elevation(&self, cell: impl Into<Vertex>) -> Option<f64> {
        let Vertex { x, y } = cell.into();
        self.ground.elevation(u32::try_from(x).ok()?, u32::try_from(y).ok()?)
    }

    /// The friction of a cell; `None` for a blocked cell and outside the map.
    #[must_use]
    pub fn friction(&self, cell: impl Into<Vertex>) -> Option<f64> {
        let Vertex { x, y } = cell.into();
        self.ground.friction(u32::try_from(x).ok()?, u32::try_from(y).ok()?)
    }

    /// The bounds of its elevations and frictions, as they were given: see [`Map::walking_in`].
    #[must_use]
    pub fn ground_bounds(&self) -> WalkingBounds {
        self.ground.ground_bounds()
    }

    /// The pace.
    #[must_use]
    pub fn pace(&self) -> &Pace {
        &self.pace
    }

    /// The bounds of the time of a unit of length on the slopes of the map, friction included.
    #[must_use]
    pub fn bounds(&self) -> (f64, f64) {
        self.ground.bounds()
    }

    /// The width and the height of a cell.
    #[must_use]
    pub fn cell_size(&self) -> (f64, f64) {
        self.ground.cell_size()
    }

    /// The unit of the integers in which searches count times, a power of two.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.ground.unit()
    }

    /// The identity: the same for all with the same cells, elevations, frictions and pace.
    #[must_use]
    pub fn id(&self) -> MapId {
        self.ground.id()
    }

    /// The map to walk on, for the typed crate `mediant-costs`.
    #[must_use]
    pub const fn ground(&self) -> &Arc<WalkingMap> {
        &self.ground
    }

    /// This elevation, for work that stops at a deadline or by a flag.
    #[must_use]
    pub fn within(&self, limits: impl Into<Limits>) -> Within<'_, Self> {
        Within { of: self, limits: limits.into() }
    }
}

/// The bytes of a cell: its height and its friction.
const BYTES: u64 = (size_of::<i32>() + size_of::<u32>()) as u64;

impl Within<'_, Walking> {
    /// [`Walking::space`].
    ///
    /// # Errors
    /// As for [`Walking::space`], and [`Error::Stopped`].
    pub fn space(&self, motion: impl Into<Motion>) -> Result<Space, Error> {
        Space::of_walking(self.of, motion.into(), self.limits.interrupt())
    }
}

impl Within<'_, Map> {
    /// [`Map::walking`].
    ///
    /// # Errors
    /// As for [`Map::walking`], and [`Error::Stopped`].
    pub fn walking<E: Into<f64>>(
        &self,
        elevations: impl IntoIterator<Item = E>,
        cell_size: (f64, f64),
        pace: &Pace,
    ) -> Result<Walking, Error> {
        Walking::new(self.of, &collected(elevations)?, None, (cell_size, pace), self.limits.interrupt())
    }
}

/// Maps with the same cells, elevations, frictions and pace are one.
impl PartialEq for Walking {
    fn eq(&self, other: &Self) -> bool {
        self.ground == other.ground
    }
}

impl fmt::Debug for Walking {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Walking")
            .field("id", &self.id())
            .field("bounds", &self.bounds())
            .finish_non_exhaustive()
    }
}

impl From<WalkingError> for Error {
    fn from(error: WalkingError) -> Self {
        match error {
            WalkingError::Costs(error) => error.into(),
            WalkingError::Field(CostFieldError::Query(error)) => error.into(),
            WalkingError::Field(CostFieldError::Mismatch(mismatch)) => mismatch.into(),
            WalkingError::Field(CostFieldError::Interrupted(interrupted)) => interrupted.into(),
            WalkingError::Field(_) => QueryError::CostLimit.into(),
            error => Self::Walking(error),
        }
    }
}
