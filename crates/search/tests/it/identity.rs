//! Nothing prepared for one grid graph is used on another: each pair that can be joined is refused with an
//! error that names both, or accepted if both are for the same map, rules and k.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::sync::Arc;

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Identity, Mismatch, Placement,
    Vertex,
};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, noise};
use mediant_search::{
    AStar, Anya, BlockJps, Canonical, CanonicalRule, DeadEnds, Dijkstra, Ends, Hk, Jps, JpsPlus, JumpError,
    JumpTable, LazyThetaStar, PaperCanonical, Planner, Pruning, Smoothed, Smoothing, ThetaStar, Wavefront,
    parts::{BlockFinder, HasFreeSpace, JumpFinder, StepwiseFinder},
};

/// A grid graph, with all that is prepared on it.
struct Prepared<P: Placement> {
    graph: GridGraph<P>,
    rule: Arc<CanonicalRule<P>>,
    pruning: Arc<Pruning<P>>,
    /// For k ≤ 3.
    jumps: Option<(BlockFinder, Arc<JumpTable>)>,
}

impl<P: Placement> Prepared<P> {
    fn new(grid: Grid, k: u32, rule: P::Rule) -> Self {
        let k = FiniteK::new(k).unwrap();
        let graph = GridGraph::new(Arc::new(grid), k, rule).unwrap();
        let rule = Arc::new(CanonicalRule::new(k, rule));
        let pruning = Arc::new(Pruning::with_rule(&graph, Arc::clone(&rule)).unwrap());
        let jumps = (k <= FiniteK::N8).then(|| {
            let blocks = BlockFinder::new(&graph, &pruning).unwrap();
            (blocks, Arc::new(JumpTable::new(&graph).unwrap()))
        });
        Self { graph, rule, pruning, jumps }
    }

    /// Everything of one kind and of the next, twice; the first two are equal.
    fn all(k: u32, other_k: u32, [rule, other_rule]: [P::Rule; 2]) -> Vec<Self> {
        let grid = |seed, width, height| noise(&mut Rng::new(seed), width, height, 20);
        let map = || grid(1, 20, 14);
        vec![
            Self::new(map(), k, rule),
            Self::new(map(), k, rule),
            Self::new(grid(2, 20, 14), k, rule),
            Self::new(grid(1, 14, 20), k, rule),
            Self::new(grid(1, 90, 70), k, rule),
            Self::new(map(), k, other_rule),
            Self::new(map(), other_k, rule),
        ]
    }
}

fn mismatch(error: JumpError) -> Mismatch {
    match error {
        JumpError::Mismatch(mismatch) => mismatch,
        other => panic!("{other}"),
    }
}

/// An attempt to join two things of these identities, and its result.
struct Joined {
    by: &'static str,
    identities: [Identity; 2],
    /// The costs of some queries.
    result: Result<Vec<Option<f64>>, Mismatch>,
}

/// The costs of some queries.
fn costs(mut planner: impl Planner) -> Vec<Option<f64>> {
    let queries = (0..40).map(|i| Ends::new((i % 20, i % 14), Vertex::new(19 - i % 3, 13 - i % 7)));
    queries.map(|query| planner.solve(query).ok()?.path().map(|path| path.cost())).collect()
}

/// Everything that joins the grid graph of one with what was prepared on another.
fn join<P: Placement, Q: Placement>(own: &Prepared<P>, other: &Prepared<Q>) -> Vec<Joined> {
    let (graph, here, there) = (&own.graph, own.graph.identity(), other.graph.identity());
    let any_k = |identity: Identity| Identity { k: None, ..identity };
    let a_star = || AStar::new(graph, Hk);
    let space: &FreeSpace<Q> = &other.graph;
    let mut joined = vec![
        Joined {
            by: "smoothing on a grid graph",
            identities: [here, there],
            result: Smoothed::new(a_star(), &other.graph, None).map(costs),
        },
        Joined {
            by: "smoothing in a free space",
            identities: [here, any_k(there)],
            result: Smoothed::new(a_star(), space, None).map(costs),
        },
    ];
    if let Some((blocks, table)) = &other.jumps {
        let identities = [there, here];
        let pruning = || Arc::clone(&own.pruning);
        let with_blocks = BlockJps::with_finder(graph, pruning(), blocks.clone(), Hk);
        joined.push(Joined { by: "blocks", identities, result: with_blocks.map(costs) });
        let on_table = JpsPlus::new(graph, Arc::clone(table), Hk).map_err(mismatch);
        joined.push(Joined { by: "a table", identities, result: on_table.map(costs) });
        let with_table = JpsPlus::with_finder(graph, pruning(), Arc::clone(table), Hk);
        joined.push(Joined { by: "a table as a finder", identities, result: with_table.map(costs) });
    }
    joined
}

/// Everything that joins the grid graph of one with a pruning rule of another.
fn join_pruning<P: Placement>(own: &Prepared<P>, other: &Prepared<P>) -> Vec<Joined> {
    let (graph, pruning) = (&own.graph, || Arc::clone(&other.pruning));
    let identities = [other.pruning.identity(), graph.identity()];
    let with_rule = Pruning::with_rule(graph, Arc::clone(&other.rule));
    let with_rule =
        with_rule.map(|pruning| costs(Canonical::with_pruning(graph, pruning.into(), Hk).unwrap()));
    let canonical = Canonical::with_pruning(graph, pruning(), Hk).map(costs);
    let jps = Jps::with_finder(graph, pruning(), StepwiseFinder, Hk).map(costs);
    let mut joined = vec![
        Joined { by: "a rule", identities: [other.rule.identity(), graph.identity()], result: with_rule },
        Joined { by: "canonical A*", identities, result: canonical },
        Joined { by: "JPS", identities, result: jps },
    ];
    if let Some((blocks, table)) = &own.jumps {
        let prepared = BlockFinder::new(graph, &pruning()).map_err(mismatch);
        let prepared = prepared
            .map(|blocks| costs(BlockJps::with_finder(graph, Arc::clone(&own.pruning), blocks, Hk).unwrap()));
        joined.push(Joined { by: "a rule for blocks", identities, result: prepared });
        let blocks = BlockJps::with_finder(graph, pruning(), blocks.clone(), Hk).map(costs);
        joined.push(Joined { by: "a rule with blocks", identities, result: blocks });
        let table = JpsPlus::with_finder(graph, pruning(), Arc::clone(table), Hk).map(costs);
        joined.push(Joined { by: "a rule with a table", identities, result: table });
    }
    joined
}

/// Checks that what belongs together is accepted, with the answers of A*, and all else refused. Returns how
/// many were accepted and refused.
fn check(joined: Vec<Joined>, a_star: &[Option<f64>]) -> [usize; 2] {
    let mut counts = [0; 2];
    for Joined { by, identities: [prepared, other], result } in joined {
        fn differ<T: PartialEq>(one: Option<T>, other: Option<T>) -> bool {
            one.zip(other).is_some_and(|(one, other)| one != other)
        }
        let is_other =
            differ(prepared.map, other.map) || differ(prepared.k, other.k) || prepared.rules != other.rules;
        counts[usize::from(is_other)] += 1;
        match result {
            Ok(costs) => {
                assert!(!is_other, "{by}: {prepared} with {other}");
                let near = |(a, b): (&Option<f64>, &Option<f64>)| match (a, b) {
                    (Some(a), Some(b)) => (a - b).abs() < 1e-9,
                    _ => a == b,
                };
                assert!(costs.iter().zip(a_star).all(near), "{by}: {prepared}");
            }
            Err(wrong) => {
                assert!(is_other, "{by}: {wrong}");
                assert_eq!((wrong.belongs_to, wrong.other_belongs_to), (prepared, other), "{by}");
                assert_ne!(wrong.prepared, wrong.other, "{by}");
            }
        }
    }
    counts
}

fn check_placement<P: Placement>(k: u32, other_k: u32, rules: [P::Rule; 2]) {
    let all = Prepared::<P>::all(k, other_k, rules);
    let mut counts = [0; 2];
    for own in &all {
        let a_star = costs(AStar::new(&own.graph, Hk));
        for other in &all {
            for joined in [join(own, other), join_pruning(own, other)] {
                let [accepted, refused] = check(joined, &a_star);
                counts = [counts[0] + accepted, counts[1] + refused];
            }
        }
    }
    assert!(counts[0] > 60 && counts[1] > 150, "{counts:?}");
}

#[test]
fn what_was_prepared_for_something_else_is_refused() {
    check_placement::<Centers>(3, 2, [CornerRule::Never, CornerRule::Always]);
    check_placement::<Centers>(3, 4, [CornerRule::One, CornerRule::Never]);
    check_placement::<Corners>(2, 3, [DiagonalGap::Open, DiagonalGap::Closed]);
    check_placement::<Corners>(4, 5, [DiagonalGap::Closed, DiagonalGap::Open]);
}

#[test]
fn what_was_prepared_for_the_other_placement_is_refused() {
    let map = |width, height| noise(&mut Rng::new(1), width, height, 20);
    let centers = Prepared::<Centers>::new(map(20, 14), 3, CornerRule::Never);
    // On the same map, and with as many vertices.
    for (width, height) in [(20, 14), (19, 13)] {
        let corners = Prepared::<Corners>::new(map(width, height), 3, DiagonalGap::Open);
        assert_eq!(check(join(&centers, &corners), &[]), [0, 5]);
        assert_eq!(check(join(&corners, &centers), &[]), [0, 5]);
    }
}

/// At any angle a free space is that of no other map or rule, and a grid graph that of no such search.
#[test]
fn a_search_at_any_angle_is_smoothed_in_its_own_space() {
    let space = |seed, gap| FreeSpace::<Corners>::new(Arc::new(noise(&mut Rng::new(seed), 20, 14, 20)), gap);
    let own = space(1, DiagonalGap::Open);
    let planner = || Anya::new(&own);
    assert!(Smoothed::new(planner(), &space(1, DiagonalGap::Open), None).is_ok());
    for other in [space(2, DiagonalGap::Open), space(1, DiagonalGap::Closed)] {
        let wrong = Smoothed::new(planner(), &other, Some(Smoothing::Taut)).map(|_| ()).unwrap_err();
        assert_eq!((wrong.belongs_to, wrong.other_belongs_to), (planner().identity(), other.identity()));
    }
    let graph = GridGraph::in_space(&own, FiniteK::N16).unwrap();
    let wrong = Smoothed::new(planner(), &graph, None).map(|_| ()).unwrap_err();
    assert_eq!(wrong.other_belongs_to, graph.identity());
    let message = wrong.to_string();
    for part in ["the planner", "the space", "k = any", "k = 4"] {
        assert!(message.contains(part), "{message}");
    }
}

/// The dead ends of a map and a rule serve every k, and no other map or rule.
#[test]
fn dead_ends_are_those_of_one_map_and_rule() {
    let space = |seed, (width, height), gap| {
        FreeSpace::<Corners>::new(Arc::new(noise(&mut Rng::new(seed), width, height, 20)), gap)
    };
    let (open, closed) = (DiagonalGap::Open, DiagonalGap::Closed);
    let own = space(1, (20, 14), open);
    let again = Arc::new(DeadEnds::new(&space(1, (20, 14), open)));
    assert_eq!(again.identity(), own.identity());
    assert!(Anya::new(&own).without(Arc::clone(&again)).is_ok());
    for k in [FiniteK::N4, FiniteK::N16] {
        assert!(Anya::over(&own, k).unwrap().without(Arc::clone(&again)).is_ok());
    }
    let others = [
        space(2, (20, 14), open),
        space(1, (14, 20), open),
        space(1, (90, 70), open),
        space(1, (20, 14), closed),
    ];
    for other in &others {
        let dead_ends = Arc::new(DeadEnds::new(other));
        let wrong = [
            Anya::new(&own).without(Arc::clone(&dead_ends)).map(|_| ()).unwrap_err(),
            Anya::over(&own, FiniteK::N8).unwrap().without(dead_ends).map(|_| ()).unwrap_err(),
        ];
        for wrong in wrong {
            assert_eq!((wrong.belongs_to, wrong.other_belongs_to), (other.identity(), own.identity()));
            assert_eq!((wrong.prepared, wrong.other), ("the dead ends", "the free space"));
        }
    }
}

fn belongs_to(planner: &impl Planner) -> Identity {
    planner.identity()
}

#[test]
fn planners_and_their_parts_say_what_they_belong_to() {
    let prepared = Prepared::<Corners>::new(noise(&mut Rng::new(1), 20, 14, 20), 3, DiagonalGap::Open);
    let Prepared { graph, rule, pruning, jumps } = &prepared;
    let (blocks, table) = jumps.as_ref().unwrap();
    let own =
        Identity { map: Some(graph.grid().id()), rules: graph.rules(), k: Some(K::Finite(FiniteK::N8)) };
    let identities = [
        graph.identity(),
        HasFreeSpace::identity(graph),
        pruning.identity(),
        JumpTable::identity(table),
        JumpFinder::<Corners>::identity(blocks).unwrap(),
        JumpFinder::<Corners>::identity(table).unwrap(),
        belongs_to(&AStar::new(graph, Hk)),
        belongs_to(&Dijkstra::new(graph, mediant_search::Zero)),
        belongs_to(&Wavefront::new(graph)),
        belongs_to(&Canonical::new(graph, Hk)),
        belongs_to(&PaperCanonical::new(graph, Hk)),
        belongs_to(&Jps::new(graph, Hk)),
        belongs_to(&BlockJps::new(graph, Hk).unwrap()),
        belongs_to(&JpsPlus::new(graph, Arc::clone(table), Hk).unwrap()),
        belongs_to(&ThetaStar::new(graph, Hk)),
        belongs_to(&LazyThetaStar::new(graph, Hk)),
        belongs_to(&Smoothed::new(AStar::new(graph, Hk), graph, Some(Smoothing::Taut)).unwrap()),
    ];
    for (number, identity) in identities.into_iter().enumerate() {
        assert_eq!(identity, own, "number {number}");
    }
    let space: &FreeSpace<Corners> = graph;
    assert_eq!(rule.identity(), Identity { map: None, ..own });
    assert_eq!(HasFreeSpace::identity(space), Identity { k: None, ..own });
    assert_eq!(JumpFinder::<Corners>::identity(&StepwiseFinder), None);
    assert_eq!(belongs_to(&Anya::new(space)), Identity { k: Some(K::Any), ..own });
}

/// Above k = 3 there are no tables and no blocks, whatever they are for.
#[test]
fn there_are_no_jump_distances_above_k_3() {
    let prepared = |k| Prepared::<Centers>::new(noise(&mut Rng::new(1), 12, 10, 20), k, CornerRule::Never);
    let (three, four) = (prepared(3), prepared(4));
    assert!(JumpTable::new(&four.graph).is_err());
    assert!(BlockJps::new(&four.graph, Hk).is_err());
    assert!(matches!(BlockFinder::new(&four.graph, &four.pruning), Err(JumpError::K(_))));
    let (blocks, table) = three.jumps.unwrap();
    let refused = JpsPlus::new(&four.graph, table, Hk).map(|_| ());
    assert!(matches!(refused, Err(JumpError::Mismatch(_))), "{refused:?}");
    let refused = BlockJps::with_finder(&four.graph, four.pruning, blocks, Hk).map(|_| ());
    assert_eq!(refused.unwrap_err().other_belongs_to, four.graph.identity());
}
