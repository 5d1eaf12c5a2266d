//! Requests, every engine against brute force: on random maps by seed, with every rule of motion, k = 2, 3, 5
//! and any.

mod ends;
mod junk;
mod limits;
mod pockets;
mod snapped;
mod steps;

use std::{fmt::Debug, ops::Range};

use mediant::{
    CornerRule, Cost, Ends, Engine, Guarantee, K, Map, Motion, Path, PlacementKind, Planner, Rules, Setup,
    Space, Vertex,
    grid::Grid,
    search::{NodeEvent, Observer},
};
use mediant_moves::CostTable;
use mediant_oracle::{
    Explicit, Rng, adversarial, describe, maze, noise, on_all_cores, random_free_vertex, rooms, seeds,
    validate,
};

use super::k;

/// Paths of the same cost differ by less than this, in cells; others by more.
const TIE: f64 = 1e-7;

/// The rules of motion with the k that engines search together. The last one, which is twice there, is that
/// under which segments connect more than N(k): see [`World::over_segments`].
fn motions() -> Vec<Motion> {
    let ks = [K::Finite(k(2)), K::Finite(k(3)), K::Finite(k(5)), K::Any];
    let all = ks.into_iter().flat_map(|k| Rules::ALL.map(|rules| Motion::new(k, rules)));
    let all = all.filter(|motion| motion.k != K::Any || motion.rules.placement() == PlacementKind::Corner);
    all.chain([Motion::new(K::N4, Rules::Center(CornerRule::Always))]).collect()
}

/// The motion for a seed.
fn motion(seed: u64) -> Motion {
    let motions = motions();
    motions[(seed % motions.len() as u64) as usize]
}

/// A map of 5 × 5 cells or more; each side has one of so many lengths.
fn random_grid(rng: &mut Rng, lengths: u32) -> Grid {
    let (width, height) = (5 + rng.below(lengths), 5 + rng.below(lengths));
    match rng.below(4) {
        0 => rooms(rng, width, height),
        1 => maze(rng, width, height),
        2 => adversarial(rng, width, height),
        _ => {
            let percent = 10 + rng.below(40);
            noise(rng, width, height, percent)
        }
    }
}

/// A random map, with the costs of all paths on it.
struct World {
    seed: u64,
    grid: Grid,
    space: Space,
    /// Whether only those engines take part whose paths are at any angle, where segments connect more than
    /// N(k) does: at k = 2 where corners are always cut. They take no part in other worlds like that.
    over_segments: bool,
    /// Of N(k); of all legal segments at k = any, and over segments.
    oracle: Explicit,
    /// h_k, for a finite k.
    metric: Option<CostTable>,
}

/// Checks the random worlds of these seeds on all cores. Each is given random numbers to go on with.
fn on_worlds<R: Send>(maps: Range<u64>, part: impl Fn(&World, &mut Rng) -> R + Sync) -> Vec<R> {
    on_all_cores(maps, |seed| {
        let mut rng = Rng::new(seed);
        let world = World::random(seed, &mut rng);
        part(&world, &mut rng)
    })
}

/// The seeds of so many maps for each motion; of more if the suites are to be longer. All planners are asked
/// several times on each map, which takes ten times as long as in other suites.
fn maps(for_each_motion: u64) -> Range<u64> {
    let default = for_each_motion * motions().len() as u64;
    0..default.max(seeds(10 * default).end / 10)
}

impl World {
    fn random(seed: u64, rng: &mut Rng) -> Self {
        let motion = motion(seed);
        // The oracle of segments at any angle takes long on large maps.
        Self::new(seed, random_grid(rng, if motion.k == K::Any { 11 } else { 20 }), motion)
    }

    fn new(seed: u64, grid: Grid, motion: Motion) -> Self {
        let space = Map::from(grid.clone()).space(motion).expect("engines search these motions");
        let motions = motions();
        let is_last = (seed + 1).is_multiple_of(motions.len() as u64);
        let over_segments = is_last && motions.last() == Some(&motion);
        let oracle = Explicit::new(&grid, motion.rules, motion.k.finite().filter(|_| !over_segments));
        let metric = motion.k.finite().map(|k| CostTable::new(k).expect("a small k"));
        Self { seed, grid, space, over_segments, oracle, metric }
    }

    /// A planner of every setup.
    fn planners(&self) -> impl Iterator<Item = (Setup, Planner)> {
        let Motion { k, rules, .. } = self.space.motion();
        let is_special = k == K::N4 && rules == Rules::Center(CornerRule::Always);
        let takes_part = move |setup: &Setup| {
            let is_any_angle = matches!(setup.engine.kind(), Engine::Theta | Engine::LazyTheta);
            !is_special || is_any_angle == self.over_segments
        };
        Setup::all(Motion::new(k, rules)).filter(takes_part).map(|setup| {
            let index = setup.prepare(&self.space).unwrap_or_else(|error| panic!("{setup}: {error}"));
            (setup, index.planner())
        })
    }

    /// By which 'near' is measured: h_k in fixed point, at k = any the square of the straight line.
    fn distance(&self, from: Vertex, to: Vertex) -> u64 {
        let d = from.to(to);
        self.metric.as_ref().map_or_else(|| d.norm_squared(), |metric| metric.distance(d).to_bits())
    }

    /// No path is shorter, in cells.
    fn least(&self, from: Vertex, to: Vertex) -> f64 {
        let d = from.to(to);
        self.metric.as_ref().map_or_else(|| d.norm(), |metric| metric.distance(d).to_f64())
    }

    /// The cost of an optimal path.
    fn optimum(&self, from: Vertex, to: Vertex) -> Option<f64> {
        self.oracle.costs_from(from).to(to)
    }

    /// A free vertex.
    fn free(&self, rng: &mut Rng) -> Option<Vertex> {
        random_free_vertex(rng, &self.grid, self.space.motion().rules.placement())
    }

    /// The columns and the rows of vertices.
    fn size(&self) -> (i32, i32) {
        let extra = i32::from(self.space.motion().rules.placement() == PlacementKind::Corner);
        (self.grid.width() as i32 + extra, self.grid.height() as i32 + extra)
    }

    /// The free vertex nearest to a vertex, of several the first row by row; with the vertex that is nearest
    /// to one outside the map along each axis.
    fn snapped(&self, at: Vertex) -> Option<Vertex> {
        let (width, height) = self.size();
        let at = Vertex::new(at.x.clamp(0, width - 1), at.y.clamp(0, height - 1));
        self.oracle.free_vertices().min_by_key(|&free| self.distance(free, at))
    }

    /// A query between two different free vertices; with a path between them, unless there hardly is such a
    /// pair.
    fn ends(&self, rng: &mut Rng) -> Option<Ends> {
        let draws: Vec<Ends> =
            (0..8).filter_map(|_| Some(Ends::new(self.free(rng)?, self.free(rng)?))).collect();
        let is_good =
            |query: &&Ends| query.start != query.goal && self.optimum(query.start, query.goal).is_some();
        draws.iter().find(is_good).or(draws.first()).copied()
    }

    /// Fails unless a path is legal, begins and ends at these vertices, and has the length that it states.
    #[track_caller]
    fn check_path(&self, setup: Setup, path: &Path, (start, end): (Vertex, Vertex), asked: &dyn Debug) {
        let Motion { rules, .. } = self.space.motion();
        let (waypoints, cost) = (path.waypoints(), path.cost());
        let fault = validate(&self.grid, rules, setup.paths().finite(), start, end, waypoints, cost).err();
        assert!(fault.is_none(), "{path}: {fault:?}; {}", self.text(setup, asked));
        let inner = waypoints.len().saturating_sub(2);
        assert_eq!(path.bends(), inner, "{path} goes straight on at a waypoint; {}", self.text(setup, asked));
    }

    /// The text of a failure.
    fn text(&self, setup: Setup, asked: &dyn Debug) -> String {
        let nowhere = Vertex::new(-1, -1);
        let map = describe(&self.grid, self.space.motion().rules, nowhere, nowhere, self.seed);
        format!("{setup}: {asked:?}; {map}")
    }
}

/// Whether no path of the planner's kind is shorter than its paths.
fn is_exact(planner: &Planner) -> bool {
    matches!(planner.guarantee(), Guarantee::Optimal(_) | Guarantee::OptimalAnyAngle)
}

/// Whether the searches within clusters, which cannot be paused, count as expansions, too.
fn expands_in_clusters(setup: Setup) -> bool {
    setup.engine.kind() == Engine::Hpa
}

/// The last waypoint.
fn end(path: &Path) -> Vertex {
    *path.waypoints().last().expect("a path has a waypoint")
}

/// The first waypoint.
fn start(path: &Path) -> Vertex {
    path.waypoints()[0]
}

/// An event that a search told its observer.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    Expanded(NodeEvent),
    Generated(NodeEvent),
    Updated(NodeEvent),
    Percolated(u32),
    Scanned(u32),
    FellBack,
    Reached(Vertex, Cost),
}

/// Writes all events down.
#[derive(Debug, Default)]
struct Log(Vec<Event>);

impl Log {
    fn expansions(&self) -> u64 {
        self.0.iter().filter(|event| matches!(event, Event::Expanded(_))).count() as u64
    }

    /// The events but those that only a search in steps tells.
    fn of_search(&self) -> Vec<Event> {
        self.0.iter().filter(|event| !matches!(event, Event::Reached(..))).copied().collect()
    }
}

impl Observer for Log {
    fn expanded(&mut self, node: NodeEvent) {
        self.0.push(Event::Expanded(node));
    }

    fn generated(&mut self, node: NodeEvent) {
        self.0.push(Event::Generated(node));
    }

    fn updated(&mut self, node: NodeEvent) {
        self.0.push(Event::Updated(node));
    }

    fn percolated(&mut self, swaps: u32) {
        self.0.push(Event::Percolated(swaps));
    }

    fn scanned(&mut self, vertices: u32) {
        self.0.push(Event::Scanned(vertices));
    }

    fn fell_back(&mut self) {
        self.0.push(Event::FellBack);
    }

    fn reached(&mut self, at: Vertex, g: Cost) {
        self.0.push(Event::Reached(at, g));
    }
}
