//! One way to run any engine under any rules, for all suites.
#![allow(dead_code, reason = "each suite uses a part")]

use std::sync::Arc;

use mediant_grid::{Centers, Corners, Grid, Lattice, Place, Rules};
use mediant_moves::K;
use mediant_search::{
    AStar, Counters, Euclidean, Guarantee, LatticeDistance, Outcome, Planner, Query, QueryError, Zero,
};

/// What an engine said to a query.
pub(crate) type Answer = Result<(Outcome, Counters), QueryError>;

/// An engine on one lattice, ready for any number of queries.
pub(crate) struct Engine<'l> {
    pub(crate) name: &'static str,
    pub(crate) guarantee: Guarantee,
    solve: Box<dyn FnMut(Query) -> Answer + 'l>,
}

impl<'l> Engine<'l> {
    fn new(name: &'static str, mut planner: impl Planner + 'l) -> Self {
        let guarantee = planner.guarantee();
        let solve = move |query| {
            let mut counters = Counters::default();
            let outcome = planner.solve_observed(query, &mut counters)?;
            Ok((outcome, counters))
        };
        Self { name, guarantee, solve: Box::new(solve) }
    }

    pub(crate) fn solve(&mut self, query: Query) -> Answer {
        (self.solve)(query)
    }
}

/// Every engine that works on a lattice.
pub(crate) fn engines<P: Place>(lattice: &Lattice<P>) -> Vec<Engine<'_>> {
    vec![
        Engine::new("A*, h_k", AStar::new(lattice, LatticeDistance)),
        Engine::new("A*, Euclidean", AStar::new(lattice, Euclidean)),
        Engine::new("A*, zero", AStar::new(lattice, Zero)),
    ]
}

/// Runs `suite` on every engine under these rules.
pub(crate) fn with_engines<R>(
    grid: &Arc<Grid>,
    rules: Rules,
    k: u32,
    suite: impl FnOnce(Vec<Engine<'_>>) -> R,
) -> R {
    let k = K::new(k).expect("k is at least 2");
    match rules {
        Rules::Center(corners) => {
            suite(engines(&Lattice::<Centers>::new(Arc::clone(grid), k, corners).expect("k is in range")))
        }
        Rules::Corner(gap) => {
            suite(engines(&Lattice::<Corners>::new(Arc::clone(grid), k, gap).expect("k is in range")))
        }
    }
}
