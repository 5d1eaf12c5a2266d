//! Spaces: a map with rules of motion and a k.

use std::sync::{Arc, OnceLock};

#[cfg(feature = "costs")]
use mediant_costs::CostGraph;
use mediant_grid::{
    Centers, Change, Corners, FreeSpace, GridGraph, Identity, Interrupt, Interrupted, Placement,
    PlacementKind, Point, Rules, Vertex,
};
use mediant_moves::{FiniteK, K};
use mediant_search::{CenterSpace, End, EndSpace as _, PointEnds, QueryError, Wavefront, parts::Metric};
use mediant_subgoal::SubgoalPlacement;

#[cfg(feature = "costs")]
use crate::costs::Costs;
use crate::{
    configured::ConfiguredEngine, engine::Engine, error::Error, map::Map, memory_check, motion::Motion,
    never::NEVER, setup::Setup, setup_error::SetupError, shared_rules::Shared, surface::Surface, walk::Walk,
};

/// A map with rules of motion and a k: what can be searched. It never changes, and all threads can share it;
/// clones are cheap.
///
/// ```
/// use mediant::{Engine, K, Map, Motion, Query};
///
/// let map = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?;
/// let space = map.space(Motion::corners(K::ANY))?;
/// // An engine that prepares little.
/// let mut planner = space.planner(Engine::Anya)?;
/// let answer = planner.find(Query::new((0, 0), (9, 0)))?;
/// assert!(answer.path().is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Space {
    inner: Arc<Inner>,
}

#[derive(Debug)]
struct Inner {
    map: Map,
    motion: Motion,
    metric: Metric,
    placed: Placed,
    /// Where cells have costs.
    surface: Option<Surface>,
    /// Where cells have elevations.
    walk: Option<Walk>,
}

/// The free space and the grid graph, by the placement of the vertices at which paths bend.
#[derive(Debug)]
pub(crate) enum Placed {
    Centers(Layers<Centers>),
    Corners(Layers<Corners>),
}

/// The free space of a map, and the grid graph of N(k), which is made when an engine first searches it.
#[derive(Debug)]
pub(crate) struct Layers<P: Placement> {
    pub(crate) free: Arc<FreeSpace<P>>,
    graph: OnceLock<Arc<GridGraph<P>>>,
    /// The free space for paths at any angle, where that has other components.
    any_angle: OnceLock<Arc<FreeSpace<P>>>,
}

/// A placement of the vertices of a space.
pub(crate) trait PlacementOfSpace: SubgoalPlacement + Shared {
    /// The layers of this placement, for an engine that takes no other.
    fn layers(space: &Space, engine: Engine) -> Result<&Layers<Self>, SetupError>;
}

impl PlacementOfSpace for Centers {
    fn layers(space: &Space, engine: Engine) -> Result<&Layers<Self>, SetupError> {
        match space.placed() {
            Placed::Centers(layers) => Ok(layers),
            Placed::Corners(_) => Err(SetupError::placement(engine, Self::KIND, PlacementKind::Corner)),
        }
    }
}

impl PlacementOfSpace for Corners {
    fn layers(space: &Space, engine: Engine) -> Result<&Layers<Self>, SetupError> {
        match space.placed() {
            Placed::Corners(layers) => Ok(layers),
            Placed::Centers(_) => Err(SetupError::placement(engine, Self::KIND, PlacementKind::Center)),
        }
    }
}

impl<P: Placement> Layers<P> {
    fn new(map: &Map, motion: Motion, rule: P::Rule, interrupt: &Interrupt) -> Result<Self, Interrupted> {
        let free = FreeSpace::interruptible(Arc::clone(map.grid()), rule, motion.k, interrupt)?;
        Ok(Self { free: Arc::new(free), graph: OnceLock::new(), any_angle: OnceLock::new() })
    }

    /// The layers after a change of the map.
    fn follow(&self, change: &Change) -> Self {
        let after = |free: &Arc<FreeSpace<P>>| Arc::new(free.after(change));
        let any_angle = self.any_angle.get().map(after).map(OnceLock::from).unwrap_or_default();
        Self { free: after(&self.free), graph: OnceLock::new(), any_angle }
    }

    /// The free space whose components say what paths at any angle connect. It is another one at k = 2 where
    /// corners are always cut, and made when it is first needed.
    pub(crate) fn at_any_angle(&self) -> &Arc<FreeSpace<P>> {
        if self.free.identity().k.is_none() {
            return &self.free;
        }
        let new = || Arc::new(FreeSpace::new(Arc::clone(self.free.grid()), self.free.rule()));
        self.any_angle.get_or_init(new)
    }

    /// The grid graph of N(k). Two threads that ask first at the same time both make it, and one is kept.
    pub(crate) fn graph(&self, k: FiniteK) -> Result<&Arc<GridGraph<P>>, Error> {
        if let Some(graph) = self.graph.get() {
            return Ok(graph);
        }
        let graph = Arc::new(GridGraph::in_space(&self.free, k)?);
        Ok(self.graph.get_or_init(|| graph))
    }

    /// The grid graph shares the free space.
    fn memory_bytes(&self) -> usize {
        let any_angle = self.any_angle.get().map_or(0, |free| free.memory_bytes());
        any_angle + self.graph.get().map_or_else(|| self.free.memory_bytes(), |graph| graph.memory_bytes())
    }
}

impl Map {
    /// This map with rules of motion and a k. A k alone means that between centers; corners are never cut.
    ///
    /// ```
    /// use mediant::{K, Map, Motion};
    ///
    /// let map = Map::new(8, 8)?;
    /// assert_eq!(map.space(Motion::default())?.identity(), map.space(3)?.identity());
    /// let at_any_angle = map.space(Motion::corners(K::ANY))?;
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::K`] for a number that is no k; [`SetupError::Motion`] where no engine searches: at k above
    /// 12, and between centers at any angle; [`SetupError::LongSide`] for a map that is for costs alone.
    pub fn space(&self, motion: impl Into<Motion>) -> Result<Space, Error> {
        Space::new(self, motion.into(), &NEVER)
    }
}

impl Space {
    /// A map with rules of motion and a k.
    pub(crate) fn new(map: &Map, motion: Motion, interrupt: &Interrupt) -> Result<Self, Error> {
        motion.check()?;
        map.check_sides("a space without costs")?;
        Self::searched(map, (None, None), motion, interrupt)
    }

    /// Costs with rules of motion and a k.
    #[cfg(feature = "costs")]
    pub(crate) fn of_costs(costs: &Costs, motion: Motion, interrupt: &Interrupt) -> Result<Self, Error> {
        const MAX: u32 = CostGraph::MAX_K;
        motion.check_k()?;
        let k = motion.k.finite().filter(|k| k.get() <= MAX);
        let k = k.ok_or_else(|| SetupError::k_on_costs(motion.k, MAX, false))?;
        let graph = Arc::new(CostGraph::new(Arc::clone(costs.surface()), motion.rules, k)?);
        let surface = Surface { costs: costs.alone(), graph };
        Self::searched(costs.map(), (Some(surface), None), motion, interrupt)
    }

    /// The space after a change of its map, with the costs after it if its cells have costs.
    pub(crate) fn follow(&self, change: &Change, surface: Option<Surface>) -> Self {
        let (motion, metric) = (self.motion(), self.metric());
        let placed = match self.placed() {
            Placed::Centers(layers) => Placed::Centers(layers.follow(change)),
            Placed::Corners(layers) => Placed::Corners(layers.follow(change)),
        };
        let map = Arc::clone(change.after()).into();
        Self { inner: Arc::new(Inner { map, motion, metric, placed, surface, walk: None }) }
    }

    /// A map with a motion that some engine searches.
    pub(crate) fn searched(
        map: &Map,
        (surface, walk): (Option<Surface>, Option<Walk>),
        motion: Motion,
        interrupt: &Interrupt,
    ) -> Result<Self, Error> {
        let metric = Metric::new(motion.k)?;
        let placed = match motion.rules {
            Rules::Center(rule) => Placed::Centers(Layers::new(map, motion, rule, interrupt)?),
            Rules::Corner(gap) | Rules::CenterGap(gap) => {
                Placed::Corners(Layers::new(map, motion, gap, interrupt)?)
            }
        };
        // Without what the map keeps, of which this space may become a part.
        let map = Arc::clone(map.grid()).into();
        Ok(Self { inner: Arc::new(Inner { map, motion, metric, placed, surface, walk }) })
    }

    /// The map.
    #[must_use]
    pub fn map(&self) -> &Map {
        &self.inner.map
    }

    /// The costs of its cells, if it is a space [of costs](Map::costs).
    #[cfg(feature = "costs")]
    #[must_use]
    pub fn costs(&self) -> Option<&Costs> {
        self.surface().map(|surface| &surface.costs)
    }

    /// The rules of motion and the k.
    #[must_use]
    pub fn motion(&self) -> Motion {
        self.inner.motion
    }

    /// The identity: its map, or the costs or elevations of its cells, rules and k.
    #[must_use]
    pub fn identity(&self) -> Identity {
        if let Some(of) = self.weighed() {
            return of.identity();
        }
        let Motion { k, rules, .. } = self.motion();
        Identity { map: Some(self.map().id()), rules, k: Some(k) }
    }

    /// Whether a path may stand on this vertex, at any angle on this point; false outside the map, and of a
    /// point that is no vertex where paths start and end at vertices. A vertex on a closed gap is free, too,
    /// but a path starts or ends there only through the vertex's own cell, and if that is blocked, not at
    /// all: it is [`connected`](Self::connected) to no other vertex then.
    #[must_use]
    pub fn is_free(&self, at: impl Into<Point>) -> bool {
        let at = self.in_search(at.into());
        match (self.placed(), at.vertex()) {
            (Placed::Centers(layers), Some(at)) => layers.free.is_free(at),
            (Placed::Corners(layers), Some(at)) => layers.free.is_free(at),
            (Placed::Corners(layers), None) if self.takes_points() => layers.free.point_is_free(at),
            (_, None) => false,
        }
    }

    /// Whether paths lead between the centers of cells and bend at corners: at any angle.
    pub(crate) fn is_between_centers(&self) -> bool {
        matches!(self.motion().rules, Rules::CenterGap(_))
    }

    /// A point in the coordinates in which planners search.
    pub(crate) fn in_search(&self, at: Point) -> Point {
        if self.is_between_centers() { at.at_corners() } else { at }
    }

    /// Whether paths start and end at any point of the free space: at any angle.
    fn takes_points(&self) -> bool {
        self.motion().k == K::Any
    }

    /// Whether there is a path over N(k) from one vertex to another, at any angle from one point to another,
    /// in constant time. (At k = 2 where corners are always cut, paths at any angle connect more than this.)
    #[must_use]
    pub fn connected(&self, from: impl Into<Point>, to: impl Into<Point>) -> bool {
        let (from, to) = (self.in_search(from.into()), self.in_search(to.into()));
        match (self.placed(), from.vertex().zip(to.vertex())) {
            (Placed::Centers(layers), Some((from, to))) => layers.free.connected(from, to),
            (Placed::Corners(layers), Some((from, to))) => layers.free.connected(from, to),
            (Placed::Corners(layers), None) if self.takes_points() => layers.free.points_connected(from, to),
            (_, None) => false,
        }
    }

    /// Whether the straight segment between two vertices, at any angle between two points, obeys the rules of
    /// motion. It is judged for itself:
    /// a closed gap that it passes is in its way, one at which it begins or ends is not.
    /// [`check`](Self::check) judges whole paths.
    #[must_use]
    pub fn sees(&self, from: impl Into<Point>, to: impl Into<Point>) -> bool {
        let (from, to) = (self.in_search(from.into()), self.in_search(to.into()));
        match (self.placed(), from.vertex().zip(to.vertex())) {
            (Placed::Centers(layers), Some((from, to))) => layers.free.sees(from, to),
            (Placed::Corners(layers), Some((from, to))) => layers.free.sees(from, to),
            (Placed::Corners(layers), None) if self.takes_points() => layers.free.point_sees(from, to),
            (_, None) => false,
        }
    }

    /// The vertices that can be reached from `start`, row by row, with their distances: in cells (or costs)
    /// by [`Engine::Dijkstra`], in moves by [`Engine::Wavefront`]. For more than one source, a limit, paths
    /// and directions see [`field`](Self::field).
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion};
    /// let space = Map::from_rows(["..#"])?.space(Motion::centers(K::N4))?;
    /// let found = space.distances(Engine::Dijkstra, (0, 0))?;
    /// assert_eq!(found, [((0, 0).into(), 0.0), ((1, 0).into(), 1.0)]);
    /// # Ok::<(), mediant::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Setup`] for another engine, [`Error::Query`] for a start that is blocked or outside the map.
    pub fn distances(&self, engine: Engine, start: impl Into<Vertex>) -> Result<Vec<(Vertex, f64)>, Error> {
        self.distances_of(engine, start.into(), &NEVER)
    }

    pub(crate) fn distances_of(
        &self,
        engine: Engine,
        start: Vertex,
        interrupt: &Interrupt,
    ) -> Result<Vec<(Vertex, f64)>, Error> {
        let motion = self.motion();
        self.check_setup(&Setup::new(engine, motion))?;
        if !engine.capabilities().distances {
            return Err(SetupError::without_distances(engine).into());
        }
        match (engine, self.placed(), motion.k.finite()) {
            (Engine::Dijkstra, ..) => {
                let field = self.field_from_of(&[start], f64::INFINITY, interrupt)?;
                memory_check::collected("the distances", field.iter())
            }
            (Engine::Wavefront, Placed::Centers(layers), Some(k)) => {
                moves(layers.graph(k)?, start, interrupt)
            }
            (Engine::Wavefront, Placed::Corners(layers), Some(k)) => {
                moves(layers.graph(k)?, start, interrupt)
            }
            _ => Err(SetupError::without_distances(engine).into()),
        }
    }

    /// Makes what an engine searches, if it is not there yet. [`prepare`](Self::prepare) does it by itself;
    /// who measures it, calls it before.
    ///
    /// # Errors
    /// [`Error::Setup`] for an engine that does not take the space's k or rules.
    pub fn make_ready(&self, engine: impl Into<ConfiguredEngine>) -> Result<(), Error> {
        let (engine, motion) = (engine.into(), self.motion());
        self.check_setup(&Setup::new(engine, motion))?;
        let searches = engine.kind().capabilities().grid_graph && !self.has_costs();
        if let Some(k) = motion.k.finite().filter(|_| searches) {
            match self.placed() {
                Placed::Centers(layers) => _ = layers.graph(k)?,
                Placed::Corners(layers) => _ = layers.graph(k)?,
            }
        }
        Ok(())
    }

    /// The memory that it uses beyond the map, in bytes: that of the connected components, of the search
    /// graph once an engine has searched it, and of costs.
    #[must_use]
    pub fn memory_bytes(&self) -> u64 {
        let bytes = match self.placed() {
            Placed::Centers(layers) => layers.memory_bytes(),
            Placed::Corners(layers) => layers.memory_bytes(),
        };
        (bytes + self.weighed().map_or(0, |of| of.memory_bytes())) as u64
    }

    /// The costs of its cells with their search graph.
    pub(crate) fn surface(&self) -> Option<&Surface> {
        self.inner.surface.as_ref()
    }

    /// The elevations of its cells with their search graph.
    pub(crate) fn walk(&self) -> Option<&Walk> {
        self.inner.walk.as_ref()
    }

    /// The length of a displacement where no obstacle is in the way: that of its k.
    pub(crate) fn metric(&self) -> Metric {
        self.inner.metric
    }

    pub(crate) fn placed(&self) -> &Placed {
        &self.inner.placed
    }

    /// Checks an end of a query.
    pub(crate) fn check_end(&self, end: End, at: impl Into<Point>) -> Result<(), QueryError> {
        let at = at.into();
        match self.placed() {
            _ if at.vertex().is_none() && !self.takes_points() => Err(QueryError::Between { end, at }),
            Placed::Centers(layers) => layers.free.check(end, at),
            Placed::Corners(layers) if self.is_between_centers() => CenterSpace(&layers.free).check(end, at),
            Placed::Corners(layers) => layers.free.check(end, at),
        }
    }

    /// Checks the ends of a query.
    pub(crate) fn check_query(&self, query: PointEnds) -> Result<(), Error> {
        self.check_end(End::Start, query.start)?;
        Ok(self.check_end(End::Goal, query.goal)?)
    }
}

/// The number of moves from a vertex to all others.
fn moves<P: Placement>(
    graph: &Arc<GridGraph<P>>,
    start: Vertex,
    interrupt: &Interrupt,
) -> Result<Vec<(Vertex, f64)>, Error> {
    let moves = Wavefront::new(&**graph).distances_interruptible(start, interrupt)??;
    memory_check::collected("the distances", moves.iter().map(|(at, moves)| (at, f64::from(moves))))
}
