//! Pathfinding on grids over the 2^k neighborhoods: every engine of Mediant behind one door.
//!
//! This page leads from a first path to an index that many threads share. The [cookbook] has whole programs
//! for common jobs.
//!
//! # A map, and a path
//!
//! A [`Map`] says which cells are blocked. Cell (x, y) is in column x from the left and row y from the top,
//! both from 0; everything outside is blocked. A map comes from a text, a function, bits, or a file
//! ([`Map::open`]).
//!
//! ```
//! use mediant::Map;
//!
//! let map: Map = "
//!     ...#....
//!     .#.#.##.
//!     .#...#..
//! ".parse()?;
//! let path = map.path((0, 0), (7, 0))?.expect("there is a way");
//! println!("{:.2} cells: {path}", path.cost());
//! for waypoint in &path {
//!     assert!(map.is_free(waypoint));
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! A [`Path`] has its waypoints, and all that can be measured on it. That there is no way is an answer
//! (`None`), not an error.
//!
//! # Motion: which directions, which rules
//!
//! A [`Motion`] says how an agent moves. k is the number of directions as a power of two: 4 at k = 2, 8 at
//! k = 3, 16 at k = 4, and every direction at [`K::ANY`]. Paths lead between the *centers* of cells, or
//! between their *corners*; any-angle paths are at corners. A [`CornerRule`] says whether a path between
//! centers may cut the corner of a blocked cell. A map with a motion is a [`Space`], which can be searched.
//!
//! ```
//! use mediant::{CornerRule, K, Map, Motion};
//!
//! let map = Map::from_fn(9, 9, |x, y| x == 4 && y != 8)?;
//! for motion in [Motion::centers(3), Motion::new(4, CornerRule::One), Motion::corners(K::ANY)] {
//!     let path = map.space(motion)?.path((0, 0), (8, 0))?.expect("there is a way");
//!     println!("{motion}: {:.2} cells", path.cost());
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Many paths: an index and a planner
//!
//! An [`Engine`] prepares an [`Index`] of a space: once for a map, which may take a while. A [`Planner`]
//! answers one [`Ends`] after another on it, far sooner than a path without an index takes.
//! [`Space::engine`] names the engine that we would take, and [`Space::engine_for`] for how many paths.
//!
//! ```
//! use mediant::{Answer, Map, Motion, Query};
//!
//! let space = Map::from_fn(64, 64, |x, y| x % 9 == 4 && y % 7 != 3)?.space(Motion::default())?;
//! let index = space.prepare(space.engine())?;
//! let mut planner = index.planner();
//! for row in 0..4 {
//!     println!("{:?}", planner.path((0, row), (60, 50))?.map(|path| path.cost()));
//! }
//! // A query can have wishes, and says what became of them.
//! match planner.find(Query::new((0, 0), (4, 0)).nearest())? {
//!     Answer::Nearest(path) => println!("the goal is blocked, this is next to it: {path}"),
//!     answer => println!("{answer}"),
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! Each thread makes a planner of its own from one index, or all share [`Planners`]. Maps, spaces and indexes
//! never change, their clones share them, and all threads may use them. An edit makes another map.
//!
//! # Maps that change
//!
//! [`Space::edit`] returns a [`Change`]: the space before, the space after, and the cells between. Whatever
//! was prepared follows it by work that follows the cells, not the map, and shares the memory of what did not
//! change; the space before stays valid for who holds it. [`Index::repair`] makes the next index, and
//! [`Planner::follow`] takes a planner to it with its scratch memory. [`Map::edit`] and [`Map::set`] do the
//! same for [`Map::path`] by themselves.
//!
//! ```
//! use mediant::{Engine, Map, Motion, Rectangle};
//!
//! let mut space = Map::from_fn(64, 64, |x, _| x == 30)?.space(Motion::default())?;
//! let mut index = space.prepare(Engine::JpsBlock)?;
//! let mut planner = index.planner();
//! for is_closed in [false, true] {
//!     let change = space.edit(Rectangle::new(30, 20, 1, 2), |_, _| is_closed)?;
//!     index = index.repair(&change)?;
//!     planner.follow(&index)?;
//!     space = change.after().clone();
//!     assert_eq!(planner.path((0, 0), (60, 50))?.is_none(), is_closed);
//! }
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! A repaired index equals a new one in one of three senses: saved, it has the same bytes; it finds the same
//! paths; or paths that cost the same, since it may leave out less than a new one.
//!
//! | engine | what follows an edit | the same |
//! |---|---|---|
//! | `astar`, `dijkstra`, `wavefront`, `theta`, `lazy-theta` | the space alone | paths |
//! | `canonical`, `jps` | the space alone up to k = 3; above, distances to obstacles, and what searches found | paths |
//! | `jps-block` | where jumps stop, and dead ends | costs |
//! | `jps-plus` | likewise, and the lists of jumps that lead there | costs |
//! | `anya` | dead ends, and rooms behind single doors | costs |
//! | `hpa`, `chpa` | clusters, segments | bytes |
//! | `subgoal` | where they prove the answer, labels or graph of the map before; elsewhere another engine | costs |
//! | `subgoal-theta` | the edges and levels of subgoals that looked at what changed; all are numbered anew | bytes |
//! | `landmarks` | where cells were freed or cost less, the distances from landmarks that shrink | costs |
//!
//! The first edit makes an index of `subgoal-theta` anew, with a record of what was looked at; by this it
//! follows the next ones.
//!
//! Labels of the map before prove 94 % of the answers and more after an edit of 10 × 10 cells (the table in
//! `docs/measurements/subgoal.md`). [`Index::finish`] makes them anew, where and when you want it: on another
//! thread, after some edits. [`Planner::searched_by`] tells by which engine a query was answered.
//!
//! [`Space::engine_for`] names the engine for so many paths between two edits ([`Demand::Changing`]).
//!
//! A [`Field`] over N(k) follows, too ([`Field::repair`]), where cells have costs as well: the same to the
//! last bit. So do distances to obstacles ([`Clearance::after`](grid::Clearance::after)), and the maps of a
//! [`Disc`] or a [`Square`], whose `change` is that of their spaces.
//!
//! An edit of one cell takes 3 to 10 µs in the median with all of that on 512 × 512 cells, 5 to 24 µs up to
//! 4096 × 4096, at k ≤ 3 and any angle; with HPA* 21 to 73 µs, with JPS+ 8 to 47
//! (`docs/measurements/changing.md`). A path is [checked](Change::check) against a change, kept while it is a
//! shortest one ([`Planner::replan`]), or [mended](Planner::mend) where it broke.
//!
//! # Costs of cells
//!
//! [`Map::costs`] gives each cell a cost a unit of length: terrain, friction, the distance to walls. A space
//! of [`Costs`] answers the same queries, and has the same fields, by A* and Dijkstra's algorithm, with exact
//! costs. [`Engine::Landmarks`] prepares an index, which can be saved and repaired: with it most queries take
//! a fifth to a tenth of the time. The paths of [`Engine::Theta`] and [`Engine::LazyTheta`], and smoothed
//! ones ([`Smoothing::Linear`]), turn at any angle; none over N(k) is cheaper.
//!
//! ```
//! use mediant::{Map, Motion};
//!
//! let costs = Map::new(9, 9)?.costs((0..81).map(|cell| if cell % 9 == 4 && cell > 8 { 20 } else { 1 }))?;
//! let path = costs.space(Motion::centers(4))?.path((0, 8), (8, 8))?.expect("there is a way");
//! println!("costs {:.2}, {:.2} cells long: {path}", path.cost(), path.length());
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! Rasters of numbers are read by `Costs::open`. Sides of costs may have up to 2²⁰ cells
//! ([`Costs::from_fn`]), those of other maps 32,768. For a robot [`Map::inflated`] puts costs around
//! obstacles, as nav2 does, and `Map::walking` walks over elevation, in seconds that differ with the
//! direction.
//!
//! ```
//! use mediant::{Inflation, Map, Motion};
//!
//! let map = Map::from_fn(40, 30, |x, y| x == 20 && !(4..7).contains(&y) && y < 16)?;
//! let inflation = Inflation { resolution: 0.05, inflation_radius: 0.4, ..Inflation::default() };
//! let space = map.inflated(&inflation)?.costs(3.0)?.space(Motion::centers(4))?;
//! println!("{}", space.path((5, 5), (35, 5))?.expect("there is a way"));
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! # Errors
//!
//! Nothing panics on bad input. Every error has a text that says what to do, and a stable
//! [code](Error::code) by which programs tell errors apart.
//!
//! ```
//! use mediant::{ErrorCode, Map};
//!
//! let map: Map = "..#".parse()?;
//! let error = map.path((2, 0), (0, 0)).unwrap_err();
//! assert_eq!(error.code(), ErrorCode::StartBlocked);
//! assert_eq!(error.to_string(), "the start (2, 0) is blocked: choose a free vertex");
//! # Ok::<(), mediant::Error>(())
//! ```
//!
//! Nothing that was prepared for one map, rule or k is ever used with another. Maps, spaces and indexes carry
//! their [`Identity`](grid::Identity); whatever joins two of them compares these in constant time, and
//! answers with [`Error::Mismatch`], which names both.
//!
//! # What else there is
//!
//! | to … | there is |
//! |---|---|
//! | ask for several ends, a tolerance, the nearest reachable vertex, limits | [`Query`] |
//! | stop a search, or go on in steps | [`Limits`], [`Planner::begin`](Planner#a-search-in-steps) |
//! | stop whatever else takes long | [`Within`], as in `space.within(&limits).prepare(engine)` |
//! | measure without the path; from many to many | [`Planner::distance`]; [`Table`] |
//! | measure to many [`Goals`], find the nearest | [`Planner::distances`], [`Planner::nearest`] |
//! | stop either of these | [`Planner::within`] |
//! | lead many agents to one goal | [`Field`] |
//! | find cheapest paths over cells with costs, cost distance, corridors | [`Map::costs`], [`Field::corridor`] |
//! | keep off walls by costs, as nav2 does | [`Map::inflated`], [`Costmap`] |
//! | walk over elevation, from places or to them | `Map::walking`, [`Space::field_from`] |
//! | write allocation and directions (back links) as rasters | [`Field::allocation`], `Field::directions` |
//! | tell the cells that a path crosses | `Space::crossings` |
//! | move a disc or a square | [`Map::for_disc`], [`Map::for_square`] |
//! | move one among obstacles that change | [`Disc`], [`Square`] |
//! | keep off walls | [`Space::widest_path`] |
//! | count some cells otherwise for one query | [`Exceptions`] |
//! | ask whether a path still holds | [`Space::check`], [`Change::check`] |
//! | replan only when that is needed | [`Planner::replan`] |
//! | make paths shorter, at any angle | [`Smoothing`], [`Index::with_smoothing`] |
//! | choose engines and options by text | [`Setup`], [`options`] |
//!
//! # Features
//!
//! - `all-engines`, on by default: without it there are A*, Dijkstra, canonical A*, JPS, block-based JPS and
//!   Anya.
//! - `clock`, on by default: [`Limits::time`] reads the system's clock, in this one place.
//! - `costs`, on by default: costs of cells, [`Map::costs`], and robots' costmaps, [`Costmap`].
//! - `rasters`, on by default: costs from rasters of numbers, `Costs::open`.
//! - `geotiff`: GeoTIFFs, too.
//! - `png`, on by default: maps that are PNG pictures.
//! - `publications`: options that only reproduce publications.
//! - `parallel`: subgoals are prepared, and tables filled, on all cores.
//! - `walking`, on by default: walking over elevation, `Map::walking`.
//! - `serde`: vertices, points, rectangles, motion, ends, paths and setups are read and written.
//! - `trace`: searches are written for the Posthoc visualizer, by `Tracer`.
//!
//! # What is not here
//!
//! Clocks, threads (but for the feature `parallel`), and output. The typed crates stay for those who want
//! them: `mediant-search`, `mediant-subgoal`, `mediant-hierarchy`.

mod absent;
mod agent;
pub mod call;
mod capabilities;
mod change;
mod changing;
mod choice;
mod code;
mod configured;
pub mod cookbook;
#[cfg(feature = "costs")]
mod costmap;
#[cfg(feature = "costs")]
mod costs;
#[cfg(feature = "costs")]
mod costs_by;
mod demand;
mod engine;
mod engine_name;
#[cfg_attr(not(feature = "all-engines"), expect(dead_code, reason = "left out, but for their options"))]
mod engines;
mod erased;
mod error;
pub mod errors;
mod exceptions;
mod field;
pub mod files;
mod goals;
pub mod grid;
mod ground;
mod heuristic;
mod index;
mod labeled;
mod limits;
mod long;
mod map;
mod memory_check;
mod motion;
mod motion_check;
mod never;
mod option;
pub mod options;
mod path_check;
mod planner;
mod planners;
#[cfg(feature = "rasters")]
mod rasters;
#[cfg(doctest)]
mod readme;
mod recent;
mod replan;
pub mod search;
#[cfg(feature = "serde")]
mod serialized;
mod setup;
mod setup_error;
mod shared_rules;
mod space;
mod suite;
mod surface;
mod table;
mod text;
#[cfg(feature = "trace")]
mod trace;
mod walk;
#[cfg(feature = "walking")]
mod walking;
mod within;

pub use agent::{Disc, Square};
pub use change::Change;
pub use choice::Choice;
pub use code::ErrorCode;
#[cfg(feature = "costs")]
pub use costmap::Costmap;
#[cfg(feature = "costs")]
pub use costs::Costs;
pub use demand::Demand;
pub use engine::Engine;
pub use error::Error;
pub use exceptions::Exceptions;
pub use field::Field;
pub use goals::{Goals, PlannerWithin};
pub use ground::Ground;
pub use index::{Index, Origin};
pub use limits::Limits;
pub use map::Map;
#[cfg(feature = "costs")]
pub use mediant_costs::{CostUnits, DirectionCode, Inflation, Traversal};
#[cfg(feature = "walking")]
pub use mediant_costs::{Langmuir, Pace, WalkingBounds};
#[doc(hidden)]
pub use mediant_grid::names;
pub use mediant_grid::{CornerRule, DiagonalGap, PlacementKind, Point, Rectangle, Rules, Vertex};
/// The mathematics of the neighborhoods: moves, h_k, bounds.
pub use mediant_moves as moves;
pub use mediant_moves::{Cost, FiniteK, K};
pub use mediant_search::{
    Answer, Ends, Guarantee, Limit, Path, PointEnds, Query, Smoothing, Status, Stopped,
};
pub use motion::Motion;
pub use planner::Planner;
pub use planners::Planners;
pub use replan::Replanned;
pub use setup::Setup;
pub use space::Space;
pub use table::Table;
#[cfg(feature = "walking")]
pub use walking::Walking;
pub use within::Within;
