//! Planners that follow to another map know nothing of the one before, and answer as new ones.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::sync::Arc;

use mediant_grid::{
    Centers, Change, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Placement, Vertex,
};
use mediant_moves::{Cost, FiniteK};
use mediant_oracle::{Rng, random_vertex, seeds, suite_grid};
use mediant_search::{
    AStar, Anya, Canonical, Counters, DeadEnds, Ends, Hk, Jps, JumpTable, LazyThetaStar, Observer,
    PaperCanonical, Planner, Pruning, SearchStatus, ThetaStar, Wavefront,
    parts::{AllMoves, BestFirst, BlockFinder, JumpPointSearch, StepwiseFinder},
};

/// Pauses a search after some expansions.
struct Pause(u32);

impl Observer for Pause {
    fn pauses(&mut self, _: Cost) -> bool {
        self.0 = self.0.saturating_sub(1);
        self.0 == 0
    }
}

/// A map with what is prepared of it.
trait Of {
    fn grid(&self) -> &Grid;
}

/// Follows to each map in turn, from a search that is paused. Returns the number of searches compared.
fn check<M: Of, S: Planner>(
    maps: &[M],
    rng: &mut Rng,
    new: impl Fn(&M) -> S,
    follow: impl Fn(&mut S, &M),
    said: &str,
) -> usize {
    let kind = new(&maps[0]).identity().rules.placement();
    let query = |rng: &mut Rng, map: &M| {
        let [start, goal] = [(); 2].map(|()| random_vertex(rng, map.grid(), kind));
        Ends::new(start, goal)
    };
    let (mut planner, mut searched) = (new(&maps[0]), 0);
    for (map, next) in maps.iter().zip(&maps[1..]) {
        _ = planner.solve(query(rng, map));
        if planner.begin(query(rng, map), &mut ()).is_ok() {
            _ = planner.proceed(&mut Pause(1 + rng.below(20)));
        }
        follow(&mut planner, next);
        let mut fresh = new(next);
        assert_eq!(planner.identity(), fresh.identity(), "{said}");
        let (width, height) = (next.grid().width() as i32, next.grid().height() as i32);
        for at in (0..=height).flat_map(|y| (0..=width).map(move |x| Vertex::new(x, y))) {
            assert!(planner.path_to(at).is_none(), "{at}, {said}");
        }
        assert_eq!(planner.proceed(&mut ()), Ok(SearchStatus::Unreachable), "{said}");
        for _ in 0..5 {
            let (query, mut counters) = (query(rng, next), [Counters::default(); 2]);
            let answer = planner.solve_observed(query, &mut counters[0]);
            assert_eq!(answer, fresh.solve_observed(query, &mut counters[1]), "{query:?}, {said}");
            assert_eq!(counters[0], counters[1], "{query:?}, {said}");
            searched += usize::from(counters[0].expanded > 0);
        }
    }
    searched
}

/// A grid graph with what engines prepare.
struct Prepared<P: Placement> {
    graph: Arc<GridGraph<P>>,
    pruning: Arc<Pruning<P>>,
    /// For k ≤ 3.
    jumps: Option<(BlockFinder, Arc<JumpTable>)>,
}

impl<P: Placement> Of for Prepared<P> {
    fn grid(&self) -> &Grid {
        self.graph.grid()
    }
}

impl<P: Placement> Prepared<P> {
    fn new(grid: &Arc<Grid>, k: FiniteK, rule: P::Rule) -> Self {
        let graph = Arc::new(GridGraph::new(Arc::clone(grid), k, rule).unwrap());
        let pruning = Arc::new(Pruning::new(&graph));
        let jumps = (k <= FiniteK::N8).then(|| {
            (BlockFinder::new(&graph, &pruning).unwrap(), Arc::new(JumpTable::new(&graph).unwrap()))
        });
        Self { graph, pruning, jumps }
    }
}

/// A map, it after an edit, another of another size, and back.
fn maps(rng: &mut Rng, seed: u64) -> Vec<Arc<Grid>> {
    let [one, other] = [seed, seed + 1_000].map(|seed| Arc::new(suite_grid(seed).0));
    let cells: Vec<(u32, u32, bool)> = (0..9)
        .map(|_| (rng.below(one.width()), rng.below(one.height())))
        .map(|(x, y)| (x, y, one.is_free(x as i32, y as i32)))
        .collect();
    let edited = Arc::clone(Change::new(Arc::clone(&one)).edit_cells(cells).after());
    vec![Arc::clone(&one), Arc::clone(&edited), other, edited, one]
}

fn check_graphs<P: Placement>(k: FiniteK, rule: P::Rule, seed: u64) -> usize {
    let rng = &mut Rng::new(seed);
    let maps: Vec<_> = maps(rng, seed).iter().map(|grid| Prepared::<P>::new(grid, k, rule)).collect();
    let graph = |of: &Prepared<P>| Arc::clone(&of.graph);
    let mut searched = 0;
    macro_rules! check {
        ($name:literal, $new:expr, $follow:expr) => {
            let said = format!("{}, k = {k}, {}, seed {seed}", $name, maps[0].graph.rules());
            searched += check(&maps, rng, $new, $follow, &said);
        };
    }
    check!("A*", |of| AStar::new(graph(of), Hk), |planner, of| planner.follow(graph(of)));
    check!("own", |of| BestFirst::with_successors(graph(of), Hk, AllMoves), |planner, of| {
        planner.follow_with(graph(of), AllMoves);
    });
    check!("wavefront", |of| Wavefront::new(graph(of)), |planner, of| planner.follow(graph(of)));
    check!("theta", |of| ThetaStar::new(graph(of), Hk), |planner, of| planner.follow(graph(of)));
    check!("lazy", |of| LazyThetaStar::new(graph(of), Hk), |planner, of| planner.follow(graph(of)));
    check!("paper", |of| PaperCanonical::new(graph(of), Hk), |planner, of| planner.follow(graph(of)));
    check!(
        "canonical",
        |of| Canonical::with_pruning(graph(of), Arc::clone(&of.pruning), Hk).unwrap(),
        |planner, of| planner.follow(graph(of), Arc::clone(&of.pruning)).unwrap()
    );
    check!("jps", |of| Jps::new(graph(of), Hk), |planner, of| {
        planner.follow(graph(of), Arc::clone(&of.pruning), StepwiseFinder).unwrap();
    });
    if maps[0].jumps.is_some() {
        let blocks = |of: &Prepared<P>| of.jumps.as_ref().unwrap().0.clone();
        let table = |of: &Prepared<P>| Arc::clone(&of.jumps.as_ref().unwrap().1);
        macro_rules! check_jumps {
            ($name:literal, $finder:ident) => {
                check!(
                    $name,
                    |of| JumpPointSearch::with_finder(graph(of), Arc::clone(&of.pruning), $finder(of), Hk)
                        .unwrap()
                        .with_intermediate(seed % 2 == 1),
                    |planner, of| {
                        planner.follow(graph(of), Arc::clone(&of.pruning), $finder(of)).unwrap();
                    }
                );
            };
        }
        check_jumps!("blocks", blocks);
        check_jumps!("table", table);
    }
    searched
}

/// A free space with its dead ends.
struct Free(Arc<FreeSpace<Corners>>, Arc<DeadEnds>);

impl Of for Free {
    fn grid(&self) -> &Grid {
        self.0.grid()
    }
}

fn check_anya(gap: DiagonalGap, seed: u64) -> usize {
    let rng = &mut Rng::new(seed);
    let free = |grid: &Arc<Grid>| {
        let space = Arc::new(FreeSpace::<Corners>::new(Arc::clone(grid), gap));
        let dead_ends = Arc::new(DeadEnds::new(&space));
        Free(space, dead_ends)
    };
    let maps: Vec<_> = maps(rng, seed).iter().map(free).collect();
    let said = format!("Anya, {gap}, seed {seed}");
    // With dead ends, without, and with those of some maps: planners come by them and lose them.
    let mut searched = 0;
    for left_out in [|_: &Free| true, |_: &Free| false, |free: &Free| free.grid().width() % 2 == 1] {
        let dead_ends = |free: &Free| left_out(free).then(|| Arc::clone(&free.1));
        macro_rules! check {
            ($new:expr) => {
                let new = |free: &Free| match dead_ends(free) {
                    Some(dead_ends) => $new(Arc::clone(&free.0)).without(dead_ends).unwrap(),
                    None => $new(Arc::clone(&free.0)),
                };
                let follow = |planner: &mut _, free: &Free| -> () {
                    Anya::follow(planner, Arc::clone(&free.0), dead_ends(free)).unwrap();
                };
                searched += check(&maps, rng, new, follow, &said);
            };
        }
        check!(Anya::new);
        check!(|space| Anya::over(space, FiniteK::N16).unwrap());
    }
    searched
}

#[test]
fn a_planner_that_followed_knows_nothing_of_the_map_before() {
    let mut searched = 0;
    for seed in seeds(12) {
        for k in [FiniteK::N4, FiniteK::N8, FiniteK::N16] {
            let rule = [CornerRule::Never, CornerRule::One, CornerRule::Always][seed as usize % 3];
            searched += check_graphs::<Centers>(k, rule, seed);
            let gap = [DiagonalGap::Open, DiagonalGap::Closed][seed as usize % 2];
            searched += check_graphs::<Corners>(k, gap, seed);
        }
        searched += check_anya([DiagonalGap::Open, DiagonalGap::Closed][seed as usize % 2], seed);
    }
    assert!(searched > 200 * seeds(12).end as usize, "only {searched} searches");
}

/// Parts of another map are refused, and the planner goes on as before.
#[test]
fn parts_of_another_map_are_refused() {
    let [one, other] =
        [20, 21].map(|side| Arc::new(Grid::from_fn(side, 9, |x, y| x == 9 && y != 4).unwrap()));
    let [one, other] =
        [one, other].map(|grid| Prepared::<Corners>::new(&grid, FiniteK::N8, DiagonalGap::Open));
    let query = Ends::new((0, 0), (20, 9));
    let (mut canonical, mut jps) = (
        Canonical::with_pruning(Arc::clone(&one.graph), Arc::clone(&one.pruning), Hk).unwrap(),
        Jps::new(Arc::clone(&one.graph), Hk),
    );
    let space = Arc::new(FreeSpace::<Corners>::new(Arc::clone(one.graph.grid()), DiagonalGap::Open));
    let mut anya = Anya::new(Arc::clone(&space)).without_dead_ends();
    canonical.begin(query, &mut ()).unwrap();
    assert!(canonical.follow(Arc::clone(&other.graph), Arc::clone(&one.pruning)).is_err());
    assert_eq!(canonical.proceed(&mut ()), Ok(SearchStatus::Found));
    assert!(jps.follow(Arc::clone(&other.graph), Arc::clone(&one.pruning), StepwiseFinder).is_err());
    assert!(jps.solve(query).unwrap().path().is_some());
    let dead_ends = Arc::new(DeadEnds::new(&other.graph));
    assert!(anya.follow(space, Some(dead_ends)).is_err());
    assert!(anya.solve(query).unwrap().path().is_some());
}
