//! Planners: one type for all engines.

mod follow;
mod steps;

use std::{fmt, sync::Arc};

use mediant_grid::{FreeSpace, Identity, Placement, Point, Vertex};
use mediant_search::{
    Answer, Counters, Guarantee, Observer, Path, Planner as _, PointEnds, Query, QueryError, Search,
    Smoothing,
};

use crate::{
    configured::ConfiguredEngine,
    engine::Engine,
    erased::{Dynamic, Erased},
    error::Error,
    exceptions::Excepted,
    index::Index,
    labeled::Asked,
    map::Map,
    memory_check,
    setup::Setup,
    setup_error::SetupError,
    space::{Placed, Space},
};

/// Answers queries on an [`Index`], one after another, on scratch memory of its own. A warm planner allocates
/// nothing but the path that it returns; one that smooths paths allocates more. The same query always gives
/// the same path.
///
/// A planner can be sent to another thread, but it is not `Sync`: two threads cannot use it at once, and a
/// `static` or a resource of Bevy cannot hold it. There are two ways for threads:
/// - each has a planner of its own, from one index: [`Index::planner`];
/// - all share [`Planners`](crate::Planners), which is `Sync`, and lends each query a planner.
///
/// A query costs one dynamic call; the search itself is compiled for its types.
///
/// ```
/// use mediant::{K, Map, Motion, Query};
///
/// let space = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?.space(Motion::centers(K::N8))?;
/// let mut planner = space.planner(space.engine())?;
/// let answer = planner.find(Query::new((0, 0), (8, 0)))?;
/// assert!(answer.path().is_some_and(|path| path.cost() > 16.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Planner {
    index: Index,
    search: Box<dyn Erased + Send>,
    /// Smooths paths; `None` for paths as they are found.
    smooth: Option<Smoother>,
    guarantee: Guarantee,
    /// The search that was begun last.
    begun: Option<Search>,
    /// The planner that answered the last query with exceptions.
    pub(crate) excepted: Option<Box<Excepted>>,
    /// The many-goals search, on an index with hub labels.
    pub(crate) asked: Asked,
}

impl Space {
    /// A planner of an engine, on an index of its own.
    ///
    /// # Errors
    /// As for [`prepare`](Self::prepare) and [`Index::try_planner`].
    pub fn planner(&self, engine: impl Into<ConfiguredEngine>) -> Result<Planner, Error> {
        self.prepare(engine)?.try_planner()
    }
}

impl Setup {
    /// A map with the setup's k and rules.
    ///
    /// # Errors
    /// [`Error::Setup`] for a setup whose parts do not fit together.
    pub fn space(&self, map: &Map) -> Result<Space, Error> {
        self.check()?;
        map.space(self.motion)
    }

    /// Prepares the setup's engine in a space.
    ///
    /// # Errors
    /// As for [`Space::prepare`], and [`Error::Mismatch`] for a space of another k or other rules.
    pub fn prepare(&self, space: &Space) -> Result<Index, Error> {
        let needed = Identity { map: None, rules: self.rules(), k: Some(self.k()) };
        needed.check("the setup", ("the space", space.identity()))?;
        Ok(space.prepare(self.engine)?.with_smoothing(self.smoothing))
    }

    /// A planner on a map, with a space and an index of its own.
    ///
    /// # Errors
    /// As for [`space`](Self::space), [`prepare`](Self::prepare) and [`Index::try_planner`].
    pub fn planner(&self, map: &Map) -> Result<Planner, Error> {
        self.prepare(&self.space(map)?)?.try_planner()
    }
}

impl Index {
    /// A planner on this index, if there is room for its [scratch memory](Self::scratch_bytes).
    ///
    /// # Errors
    /// [`Error::OutOfMemory`] where memory is short; [`Error::Setup`] for taut smoothing where cells have
    /// costs, and for any smoothing on maps with longer sides than it takes.
    pub fn try_planner(&self) -> Result<Planner, Error> {
        if self.setup().smoothing == Some(Smoothing::Taut) {
            self.space().check_is_without_costs(SetupError::TAUT_ON_COSTS)?;
        }
        self.space().check_sides(&self.setup())?;
        memory_check::check("the planner", self.scratch_bytes())?;
        Ok(self.planner())
    }

    /// A planner on this index. It shares the index, and owns its scratch memory. Where memory is short, the
    /// program ends, as always in Rust; [`try_planner`](Self::try_planner) returns an error.
    #[must_use]
    pub fn planner(&self) -> Planner {
        let search = self.search().expect("every constructor of an index checks what its planners need");
        let guarantee = search.guarantee();
        let smoothing = self.setup().smoothing;
        Planner {
            search,
            smooth: smoothing.map(|smoothing| smoother(self.space(), smoothing)),
            guarantee: if smoothing.is_some() { guarantee.smoothed() } else { guarantee },
            index: self.clone(),
            begun: None,
            excepted: None,
            asked: Asked::default(),
        }
    }
}

/// Smooths a path.
type Smoother = Box<dyn Fn(Rough<'_>) -> Path + Send>;

/// A path to be smoothed.
enum Rough<'p> {
    /// As it was found.
    Found(&'p Path),
    /// The bends of a path: see [`Search::bends_to`](mediant_search::Planner::bends_to).
    Bends(&'p [Vertex]),
}

fn smoother(space: &Space, smoothing: Smoothing) -> Smoother {
    if let Some(surface) = space.surface().cloned() {
        return Box::new(move |path| match path {
            Rough::Found(path) => surface.smooth(path),
            // Bends are those of a path on a map without costs; no planner on costs knows any.
            Rough::Bends(bends) => surface.smooth(&Path::new(bends.to_vec())),
        });
    }
    match space.placed() {
        Placed::Centers(layers) => smoother_in(&layers.free, smoothing),
        Placed::Corners(layers) => smoother_in(&layers.free, smoothing),
    }
}

fn smoother_in<P: Placement>(free: &Arc<FreeSpace<P>>, smoothing: Smoothing) -> Smoother {
    let free = Arc::clone(free);
    Box::new(move |path| match path {
        Rough::Found(path) => smoothing.apply(&free, path),
        Rough::Bends(bends) => smoothing.apply_to_bends(&free, bends),
    })
}

/// The smoothed answer of a search that has ended.
fn smoothed_to(search: &mut dyn Erased, smooth: &Smoother, goal: Vertex, is_found: bool) -> Answer {
    let smoothed = |search: &mut dyn Erased| match search.bends_to(goal) {
        Some(bends) => Some(smooth(Rough::Bends(&bends))),
        None => Some(smooth(Rough::Found(&search.path_to(goal)?))),
    };
    let path = if is_found { smoothed(search) } else { None };
    path.map_or(Answer::Unreachable, Answer::Found)
}

impl Planner {
    /// Answers a query. A pair or an array of two vertices is a query, too.
    ///
    /// ```
    /// use mediant::{Answer, K, Limits, Map, Motion, Query};
    ///
    /// let space = Map::from_fn(9, 9, |x, _| x == 4)?.space(Motion::centers(K::N8))?;
    /// let mut planner = space.planner(space.engine())?;
    /// assert_eq!(planner.find(Query::new((0, 0), (8, 0)))?, Answer::Unreachable);
    /// assert_eq!(planner.find([(0, 0), (3, 0)])?.cost(), Some(3.0));
    /// let nearest = planner.find(Query::new((0, 0), (8, 0)).nearest())?;
    /// assert_eq!(nearest.cost(), Some(3.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`QueryError`] for an end that is blocked or outside the map, or where the engine gives up.
    pub fn find(&mut self, query: impl Into<Query>) -> Result<Answer, QueryError> {
        let query = query.into();
        let Some(ends) = query.as_points() else {
            self.begin(query)?;
            return self.finish();
        };
        self.begun = None;
        self.check_smoothing()?;
        if self.index.space().is_between_centers() {
            let answer = self.solve_at(ends.at_corners());
            return self.at_centers(answer);
        }
        let Some(ends) = ends.vertices() else { return self.solve_at(ends) };
        let Some(smooth) = &self.smooth else { return self.search.solve(ends) };
        let is_found = self.search.seek(ends)?;
        Ok(smoothed_to(&mut *self.search, smooth, ends.goal, is_found))
    }

    /// Answers a query between points, in the coordinates of the search.
    fn solve_at(&mut self, ends: PointEnds) -> Result<Answer, QueryError> {
        let answer = match ends.vertices() {
            Some(ends) => self.search.solve(ends),
            None => Dynamic(&mut *self.search).solve_at(ends).unwrap_or_else(|| Err(ends.between())),
        };
        self.smoothed(answer)
    }

    /// An answer of the search in the coordinates of the space.
    fn at_centers(&self, answer: Result<Answer, QueryError>) -> Result<Answer, QueryError> {
        match self.index.space().is_between_centers() {
            true => answer.map(Answer::at_centers).map_err(QueryError::at_centers),
            false => answer,
        }
    }

    /// The path from `start` to `goal`, if there is one: [`find`](Self::find) for a plain query.
    ///
    /// ```
    /// use mediant::{Engine, Map, Motion};
    ///
    /// let space = Map::new(8, 8)?.space(Motion::default())?;
    /// let mut planner = space.planner(Engine::Subgoal)?;
    /// let path = planner.path((0, 0), (7, 0))?.expect("there is a way");
    /// assert_eq!(path.cost(), 7.0);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// As for [`find`](Self::find).
    pub fn path(
        &mut self,
        start: impl Into<Point>,
        goal: impl Into<Point>,
    ) -> Result<Option<Path>, QueryError> {
        Ok(self.find(Query::new(start, goal))?.into_path())
    }

    /// The length of the path that [`find`](Self::find) finds, in cells, or where cells have costs its cost;
    /// `None` if there is none. On hub labels this takes less time than the path. A planner that smooths its
    /// paths measures the smoothed one.
    ///
    /// Over N(k), shortest paths have the same length here, in a [`Table`](crate::Table) and in a
    /// [`Field`](crate::Field), to the last bit, whatever the engine: [`Guarantee::length`]. It differs from
    /// [`Path::cost`](crate::Path::cost) by one part in 2³³ at most. At any angle lengths of the same path
    /// can differ by one part in 2³¹ (see [`Cost`](mediant_moves::Cost)).
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion};
    ///
    /// let space = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?.space(Motion::corners(K::ANY))?;
    /// let mut planner = space.planner(Engine::Subgoal)?;
    /// assert_eq!(planner.distance([(0, 0), (4, 3)])?, Some(5.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As for [`find`](Self::find).
    pub fn distance(&mut self, ends: impl Into<PointEnds>) -> Result<Option<f64>, QueryError> {
        let ends = ends.into();
        let is_plain = self.smooth.is_none() && !self.index.space().is_between_centers();
        match ends.vertices().filter(|_| is_plain) {
            Some(ends) => {
                self.begun = None;
                self.search.distance(ends)
            }
            None => Ok(self.find(ends)?.cost()),
        }
    }

    /// Answers a query and reports the events of the search. Where cells have costs, events count these in
    /// units (`Costs::unit`). Between centers at any angle the search turns at corners of cells, and its
    /// events name these: (x, y) is the upper left corner of cell (x, y).
    ///
    /// # Errors
    /// As for [`find`](Self::find).
    pub fn find_observed(
        &mut self,
        query: impl Into<Query>,
        observer: &mut dyn Observer,
    ) -> Result<Answer, QueryError> {
        let query = query.into();
        let is_between_centers = self.index.space().is_between_centers();
        let Some(ends) = query.as_ends().filter(|_| !is_between_centers) else {
            self.begin(query)?;
            return self.finish_observed(observer);
        };
        self.begun = None;
        self.check_smoothing()?;
        let mut observer = observer;
        let mut search = Dynamic(&mut *self.search);
        let Some(smooth) = &self.smooth else { return search.solve_observed(ends, &mut observer) };
        let is_found = mediant_search::Planner::seek(&mut search, ends, &mut observer)?;
        Ok(smoothed_to(search.0, smooth, ends.goal, is_found))
    }

    /// Answers a query and counts the events of the search.
    ///
    /// # Errors
    /// As for [`find`](Self::find).
    pub fn find_counted(&mut self, query: impl Into<Query>) -> Result<(Answer, Counters), QueryError> {
        let mut counters = Counters::default();
        let answer = self.find_observed(query, &mut counters)?;
        Ok((answer, counters))
    }

    /// Refuses to pull paths taut where cells have costs.
    fn check_smoothing(&self) -> Result<(), QueryError> {
        match self.index.setup().smoothing {
            Some(Smoothing::Taut) if self.index.space().has_costs() => Err(QueryError::Smoothing),
            _ => Ok(()),
        }
    }

    /// Smooths the path, if the planner smooths its paths.
    fn smoothed(&self, answer: Result<Answer, QueryError>) -> Result<Answer, QueryError> {
        let Some(smooth) = &self.smooth else { return answer };
        let bends = self.begun.as_ref().and_then(Search::bends);
        let smooth = |path: &Path| smooth(bends.map_or(Rough::Found(path), Rough::Bends));
        Ok(match answer? {
            Answer::Found(path) => Answer::Found(smooth(&path)),
            Answer::Nearest(path) => Answer::Nearest(smooth(&path)),
            Answer::Stopped(mut stopped) => {
                stopped.best = smooth(&stopped.best);
                stopped.lower_bound = self.smoothed_bound(stopped.lower_bound);
                Answer::Stopped(stopped)
            }
            answer => answer,
        })
    }

    /// A lower bound on smoothed paths, from one on the paths of the search.
    fn smoothed_bound(&self, lower_bound: f64) -> f64 {
        match self.guarantee {
            Guarantee::AtMost(_) => self.bound().map_or(0.0, |bound| lower_bound / bound),
            // It is a bound over N(k), and smoothed paths can be cheaper.
            Guarantee::AtMostCheapest(_) if self.search.guarantee().is_optimal() => 0.0,
            _ => lower_bound,
        }
    }

    /// The guarantee of the paths.
    #[must_use]
    pub const fn guarantee(&self) -> Guarantee {
        self.guarantee
    }

    /// How much longer than the shortest path at any angle its paths can be: 1.08 is 8 %. `None` where no
    /// bound is proven, as none is where cells have costs.
    #[must_use]
    pub fn bound(&self) -> Option<f64> {
        self.guarantee.bound(self.index.setup().rules())
    }

    /// The engine that answered the last query. It is that of its index
    /// ([`Index::searched_by`](crate::Index::searched_by)), unless this is not
    /// [finished](crate::Index::is_finished): then either the labels of an earlier map have proven the
    /// answer, and it is that of the setup, or another engine has searched.
    #[must_use]
    pub fn searched_by(&self) -> Engine {
        self.index.answered_by(&self.search)
    }

    /// The index that it searches.
    #[must_use]
    pub const fn index(&self) -> &Index {
        &self.index
    }
}

impl fmt::Debug for Planner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Planner").field("setup", &self.index.setup()).finish_non_exhaustive()
    }
}
