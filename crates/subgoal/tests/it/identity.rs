//! A subgoal graph is used in no other space than its own, and read for no other: all else is refused with an
//! error that names both.

use mediant_grid::{
    Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph, Identity, Mismatch,
};
use mediant_moves::{FiniteK, K};
use mediant_oracle::{Rng, noise};
use mediant_search::{Planner, parts::HasFreeSpace};
use mediant_subgoal::{SubgoalAStar, SubgoalError, SubgoalGraph, SubgoalPlacement, SubgoalTheta};

use crate::common::{graph, identity, k, levels, space};

fn map(seed: u64, width: u32, height: u32) -> Grid {
    noise(&mut Rng::new(seed), width, height, 20)
}

/// A free space with its grid graph, where there is one, and its subgoal graph.
struct Prepared<P: SubgoalPlacement> {
    space: FreeSpace<P>,
    grid_graph: Option<GridGraph<P>>,
    k: K,
    graph: SubgoalGraph<P>,
}

impl<P: SubgoalPlacement> Prepared<P> {
    fn new(grid: &Grid, k: K, rule: P::Rule) -> Self {
        let space = space::<P>(grid, rule);
        let of = |k: FiniteK| GridGraph::in_space(&space, k).expect("k is in range");
        Self { grid_graph: k.finite().map(of), graph: graph(&space, k, levels(2)), k, space }
    }

    /// Two that are equal, and others of another map, size, rule and k.
    fn all(k: K, other_k: K, [rule, other]: [P::Rule; 2]) -> Vec<Self> {
        vec![
            Self::new(&map(1, 20, 14), k, rule),
            Self::new(&map(1, 20, 14), k, rule),
            Self::new(&map(2, 20, 14), k, rule),
            Self::new(&map(1, 14, 20), k, rule),
            Self::new(&map(1, 60, 40), k, rule),
            Self::new(&map(1, 20, 14), k, other),
            Self::new(&map(1, 20, 14), other_k, rule),
        ]
    }
}

/// Checks that both planners take a graph in a space, or refuse it and say what each is for.
fn check<P: SubgoalPlacement>(
    graph: &SubgoalGraph<P>,
    space: &impl HasFreeSpace<Placement = P>,
    belong: bool,
) {
    let planners = [
        SubgoalAStar::new(space, graph).map(|planner| planner.identity()),
        SubgoalTheta::new(space, graph).map(|planner| planner.identity()),
    ];
    for planner in planners {
        match planner {
            Ok(identity) => assert!(belong && identity == graph.identity(), "{identity}"),
            Err(Mismatch {
                prepared: "the subgoal graph",
                belongs_to,
                other: "the space",
                other_belongs_to: found,
            }) => {
                assert!(!belong, "{belongs_to}");
                assert_eq!((belongs_to, found), (graph.identity(), space.identity()));
            }
            Err(wrong) => panic!("{wrong}"),
        }
    }
}

fn refused<P: SubgoalPlacement>(space: &FreeSpace<P>, k: K, bytes: &[u8]) -> SubgoalError {
    SubgoalGraph::<P>::from_bytes(space, k, bytes).map(|_| ()).expect_err("to be refused")
}

fn check_all<P: SubgoalPlacement>(k: K, other_k: K, rules: [P::Rule; 2]) {
    let all = Prepared::<P>::all(k, other_k, rules);
    let mut counts = [0; 2];
    for own in &all {
        assert_eq!(own.graph.identity(), identity(&own.space, own.k));
        for other in &all {
            let (one, another) = (own.graph.identity(), other.graph.identity());
            check(&own.graph, &other.space, Identity { k: None, ..one } == other.space.identity());
            if let Some(grid_graph) = &other.grid_graph {
                check(&own.graph, grid_graph, one == another);
            }
            counts[usize::from(one == another)] += 1;
            let bytes = own.graph.to_bytes();
            if one == another {
                let read = SubgoalGraph::<P>::from_bytes(&other.space, other.k, &bytes);
                assert_eq!(read.expect("these are its bytes").identity(), another);
            } else {
                let SubgoalError::Mismatch(wrong) = refused(&other.space, other.k, &bytes) else {
                    panic!("{one} is not {another}");
                };
                assert_eq!((wrong.belongs_to, wrong.other_belongs_to), (one, another));
            }
        }
    }
    assert_eq!(counts, [all.len() * all.len() - all.len() - 2, all.len() + 2]);
}

#[test]
fn a_graph_of_something_else_is_refused() {
    check_all::<Corners>(K::Any, k(3), [DiagonalGap::Open, DiagonalGap::Closed]);
    check_all::<Corners>(k(4), k(5), [DiagonalGap::Closed, DiagonalGap::Open]);
    check_all::<Corners>(k(3), K::Any, [DiagonalGap::Closed, DiagonalGap::Open]);
    check_all::<Centers>(k(2), k(3), [CornerRule::Never, CornerRule::One]);
}

#[test]
fn bytes_of_the_other_placement_are_refused() {
    let corners = Prepared::<Corners>::new(&map(1, 20, 14), k(3), DiagonalGap::Open);
    let centers = Prepared::<Centers>::new(&map(1, 20, 14), k(3), CornerRule::Never);
    let errors = [
        refused(&corners.space, k(3), &centers.graph.to_bytes()),
        refused(&centers.space, k(3), &corners.graph.to_bytes()),
    ];
    for error in errors {
        assert!(matches!(error, SubgoalError::Mismatch(_)), "{error}");
        let message = error.to_string();
        assert!(message.contains("the subgoal graph is for ") && message.contains("center"), "{message}");
    }
}

/// The identity is the first that is looked at, and only its own is good enough.
#[test]
fn bytes_are_those_of_one_map_and_one_k() {
    let own = Prepared::<Corners>::new(&map(1, 20, 14), k(3), DiagonalGap::Open);
    let identity = own.graph.identity();
    for other in [Identity { map: None, ..identity }, Identity { k: None, ..identity }] {
        let mut bytes = own.graph.to_bytes();
        bytes[..Identity::BYTES].copy_from_slice(&other.to_bytes());
        assert!(matches!(refused(&own.space, k(3), &bytes), SubgoalError::Mismatch(_)), "{other}");
        // Nor does it matter what else is wrong.
        bytes.truncate(Identity::BYTES);
        assert!(matches!(refused(&own.space, k(3), &bytes), SubgoalError::Mismatch(_)), "{other}");
    }
    let refused = refused(&own.space, k(3), &[0xff; 100]);
    assert_eq!(refused, SubgoalError::Bytes("they do not begin with what they belong to"));
}
