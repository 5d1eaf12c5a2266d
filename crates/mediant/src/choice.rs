//! Recommends an engine, with the reason; and finds a path by it at once.

use mediant_grid::{PlacementKind, Point, Vertex};
use mediant_moves::K;
use mediant_search::{Answer, Ends, Limits, Path, PointEnds, Query};

use crate::{
    call::Call, configured::ConfiguredEngine, engine::Engine, error::Error, map::Map, motion::Motion,
    setup::Setup, space::Space,
};

/// A recommended engine, with the reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choice {
    /// The engine.
    pub engine: Engine,
    /// The reason, in a sentence.
    pub why: &'static str,
}

/// The most cells of a map that was measured: up to there subgoals pay on nearly every kind of map
/// (`docs/measurements/subgoal.md`, 'On large maps'), and where they do not, another engine searches.
const MOST_CELLS_FOR_SUBGOALS: u64 = 1 << 24;

/// The most cells of a map on which the next path is searched without the preparation of block-based JPS,
/// which takes longer than a handful of queries there.
const MOST_CELLS_WITHOUT_BLOCKS: u64 = 1 << 12;

/// Block-based JPS, for more than one path at k = 2 and 3.
const BLOCKS: Choice = Choice { engine: Engine::JpsBlock, why: "it reads the map by words of 64 cells" };

fn cells(map: &Map) -> u64 {
    u64::from(map.width()) * u64::from(map.height())
}

/// Whether Anya searches this motion: every k at corners.
fn is_for_anya(motion: Motion) -> bool {
    motion.k == K::Any || motion.rules.placement() == PlacementKind::Corner
}

impl Choice {
    /// For a single path: an engine that prepares next to nothing, the least by
    /// [`Space::prepare_for_one_path`].
    ///
    /// At corners it is Anya for every k. It needs no grid graph either. Its queries alone, on two maps of
    /// games and one of rooms, took 0.1 to 0.95 of the time of canonical A* at k = 2 and 3, 0.04 to 0.23 of
    /// that of A* at k = 4, and about 0.01 to 0.08 at k = 7. On 512 × 512 random cells, a tenth of them
    /// blocked, they took 10 to 14 times as long as canonical A* at k = 2 and 3, 2.4 times as long as A* at
    /// k = 4, and a quarter of its time at k = 7.
    ///
    /// At centers, on four maps of up to 1024 × 1024 cells, space and search together, canonical A* took 0.6
    /// to 0.9 of the time of A* at k = 3 and 0.7 to 1.1 at k = 2. From k = 4 on its preparation takes longer
    /// than A*; that of block-based JPS makes it slower than A* at k = 3 already, by a factor of 1.2 to 2.2.
    #[must_use]
    pub fn for_one_path(motion: Motion) -> Self {
        if is_for_anya(motion) {
            return Self { engine: Engine::Anya, why: "it prepares next to nothing" };
        }
        match motion.k.finite().map(|k| k.get()) {
            Some(2 | 3) => Self { engine: Engine::Canonical, why: "it prepares next to nothing" },
            _ => Self { engine: Engine::AStar, why: "it prepares nothing" },
        }
    }

    /// For some paths in a space, without an index that takes long to prepare: block-based JPS at k = 2 and
    /// 3, whose preparation takes a few milliseconds; else as for one path.
    ///
    /// Between corners, on the four maps of [`for_one_path`](Self::for_one_path), a query of block-based JPS
    /// took 0.16 to 0.7 of the time of Anya, with all dead ends, at k = 3. At k = 4 Anya took 0.2 to 0.65 of
    /// the time of jump point search on three of them, and 1.4 times as long on the random one; with k its
    /// time hardly grows.
    #[must_use]
    pub fn for_some_paths(motion: Motion) -> Self {
        match motion.k.finite().map(|k| k.get()) {
            Some(2 | 3) => BLOCKS,
            _ => Self::for_one_path(motion),
        }
    }

    /// For the next path on a map that may change before the one after it: on maps of up to 64 × 64 cells,
    /// between their centers, as for one path; else as for some.
    ///
    /// Called from Python on 64 × 64 cells (empty, random, rooms), canonical A* took 22 to 62 µs for a map,
    /// its space and one path at k = 3, block-based JPS 106 to 134 µs. A further path took 6 to 29 µs against
    /// 4 to 26: at most 2.6 times as long, in rooms.
    #[must_use]
    pub fn for_next_path(motion: Motion, map: &Map) -> Self {
        let is_small = cells(map) <= MOST_CELLS_WITHOUT_BLOCKS;
        match motion.rules.placement() {
            PlacementKind::Center if is_small => Self::for_one_path(motion),
            _ => Self::for_some_paths(motion),
        }
    }

    /// For many paths in a space.
    pub(crate) fn for_many_paths(motion: Motion, map: &Map) -> Self {
        let takes_subgoals = Setup::new(Engine::Subgoal, motion).check().is_ok();
        if takes_subgoals && cells(map) <= MOST_CELLS_FOR_SUBGOALS {
            let why =
                "it prepares the map once; with hub labels it then finds most paths in a few microseconds";
            return Self { engine: Engine::Subgoal, why };
        }
        match motion.k.finite().map(|k| k.get()) {
            None => {
                Self { engine: Engine::Anya, why: "on maps this large it is as fast as prepared engines" }
            }
            Some(2 | 3) => BLOCKS,
            Some(_) if is_for_anya(motion) => {
                Self { engine: Engine::Anya, why: "from k = 4 on it is faster than engines that jump" }
            }
            Some(4 | 5) => Self { engine: Engine::Jps, why: "for these k jumping is faster than A*" },
            Some(_) => Self { engine: Engine::Canonical, why: "for large k pruning is faster than jumping" },
        }
    }
}

/// The most bytes that landmarks may take where they are chosen: as many as hub labels by default.
const MOST_BYTES_OF_LANDMARKS: u64 = 1_000_000_000;

/// The bytes of a cell that the landmarks take: 8 numbers of 32 bits.
const BYTES_OF_LANDMARKS: u64 = 32;

impl Choice {
    /// Where cells have costs, for few paths.
    pub(crate) const ON_COSTS: Self = Self { engine: Engine::AStar, why: "it knows the costs of cells" };

    /// Where cells have costs, for many paths: landmarks, unless all cells cost the same, or there are more
    /// than 31 million.
    ///
    /// Where costs differ, a path took a fifth to a tenth of the time of A* with 8 landmarks; where all are
    /// 1, two thirds, which pays for the preparation only after hundreds of paths, and engines without costs
    /// are many times as fast there (`docs/measurements/costs.md`).
    pub(crate) fn for_many_paths_on_costs(space: &Space) -> Self {
        #[cfg(feature = "costs")]
        if let Some((least, greatest)) = space.costs().map(|costs| costs.bounds()) {
            let bytes = cells(space.map()).saturating_mul(BYTES_OF_LANDMARKS);
            if least < greatest && bytes <= MOST_BYTES_OF_LANDMARKS {
                let why = "it prepares the distances from a few landmarks, and then searches a small part";
                return Self { engine: Engine::Landmarks, why };
            }
        }
        #[cfg(not(feature = "costs"))]
        let _ = (space, BYTES_OF_LANDMARKS, MOST_BYTES_OF_LANDMARKS);
        Self::ON_COSTS
    }
}

impl Space {
    /// The engine recommended for many paths, with the reason. It depends on the motion and on the size of
    /// the map alone. Whether subgoals pay on the map is found out when they are prepared; where they do not,
    /// nothing of them is kept, and another engine searches:
    /// [`Index::searched_by`](crate::Index::searched_by). Where cells have costs, it is landmarks; A* if all
    /// cost the same, or landmarks would take more than a gigabyte.
    ///
    /// ```
    /// use mediant::{Engine, K, Map, Motion};
    /// let map = Map::from_fn(40, 40, |x, y| x % 9 == 4 && y % 7 != 3)?;
    /// let space = map.space(Motion::centers(K::N8))?;
    /// assert_eq!(space.engine().engine, Engine::Subgoal);
    /// let mut planner = space.planner(space.engine())?;
    /// # Ok::<(), mediant::Error>(())
    /// ```
    #[must_use]
    pub fn engine(&self) -> Choice {
        match self.has_costs() {
            true => Choice::for_many_paths_on_costs(self),
            false => Choice::for_many_paths(self.motion(), self.map()),
        }
    }

    /// The engine that prepares least.
    pub(crate) fn engine_for_one_path(&self) -> Choice {
        if self.has_costs() { Choice::ON_COSTS } else { Choice::for_one_path(self.motion()) }
    }

    /// A shortest path, or a cheapest one where cells have costs, by an engine that prepares little; `None`
    /// if there is none. For more than a few paths make a [`planner`](Self::planner).
    ///
    /// # Errors
    /// [`Error::Query`] for a start or goal that is blocked or outside the map.
    pub fn path(&self, start: impl Into<Point>, goal: impl Into<Point>) -> Result<Option<Path>, Error> {
        self.path_of(PointEnds::new(start, goal), &Limits::new())
    }

    /// Of the limits only the deadline and the flag count.
    pub(crate) fn path_of(&self, query: PointEnds, limits: &Limits) -> Result<Option<Path>, Error> {
        self.check_query(query)?;
        let index = self.within(limits).prepare_for_one_path(self.engine_for_one_path())?;
        whole(index.try_planner()?.find(within(query, limits))?)
    }
}

impl Map {
    /// A shortest path from one cell to another over k = 3: along rows, columns and diagonals between the
    /// centers of cells, without cutting corners. `None` if there is none.
    ///
    /// The first call prepares a little, for some milliseconds on large maps, and the map keeps it for the
    /// next one. For many paths prepare an index; for other motion make a [`Space`].
    ///
    /// # Errors
    /// [`Error::Query`] for a start or goal that is blocked or outside the map.
    pub fn path(&self, start: impl Into<Vertex>, goal: impl Into<Vertex>) -> Result<Option<Path>, Error> {
        self.path_of(Ends::new(start, goal), &Limits::new())
    }

    /// Of the limits only the deadline and the flag count.
    pub(crate) fn path_of(&self, query: Ends, limits: &Limits) -> Result<Option<Path>, Error> {
        let setup = self.setup(&Call::default())?;
        let planners = self.keep_planners(&setup, limits)?;
        planners.try_make_ready()?;
        whole(planners.find(within(query, limits))?)
    }
}

/// The query, within limits if there are any.
fn within(query: impl Into<Query>, limits: &Limits) -> Query {
    let query = query.into();
    if limits.interrupt().is_never() { query } else { query.within(limits.clone()) }
}

/// The path of an answer that no limit has stopped.
fn whole(answer: Answer) -> Result<Option<Path>, Error> {
    match answer {
        Answer::Stopped(stopped) => Err(Error::Stopped { by: stopped.by, during: "searching a path" }),
        answer => Ok(answer.into_path()),
    }
}

impl From<Choice> for ConfiguredEngine {
    fn from(choice: Choice) -> Self {
        choice.engine.into()
    }
}

impl std::fmt::Display for Choice {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.engine, self.why)
    }
}
