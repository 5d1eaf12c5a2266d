//! One way to run any engine under any rules, for all suites.
#![allow(dead_code, reason = "each suite uses a part")]

use std::sync::Arc;

use mediant_engines::{Setup, SharedRules, Solver};
use mediant_grid::{Centers, Corners, Grid, Lattice, Place, Rules};
use mediant_moves::K;
use mediant_search::{Counters, Guarantee, Outcome, Query, QueryError};

/// Pruning rules depend on no map: each is made once.
static RULES: SharedRules = SharedRules::new();

/// What an engine said to a query.
pub(crate) type Answer = Result<(Outcome, Counters), QueryError>;

/// An engine on one lattice, ready for any number of queries. Its planner is made for the first: most suites run few engines.
pub(crate) struct Engine<'l> {
    pub(crate) name: String,
    pub(crate) guarantee: Guarantee,
    solver: Option<Solver>,
    make: Box<dyn Fn() -> Solver + 'l>,
}

impl<'l> Engine<'l> {
    fn new<P: Place>(setup: Setup, lattice: &'l Arc<Lattice<P>>) -> Self {
        let make = move || {
            let solver = Solver::on(setup, Arc::clone(lattice), RULES.prebuilt(setup));
            let solver = solver.unwrap_or_else(|error| panic!("{setup}: {error}"));
            assert_eq!(solver.guarantee(), setup.guarantee(), "{setup}");
            solver
        };
        Self { name: setup.to_string(), guarantee: setup.guarantee(), solver: None, make: Box::new(make) }
    }

    pub(crate) fn solve(&mut self, query: Query) -> Answer {
        self.solver.get_or_insert_with(&self.make).solve_counted(query)
    }
}

/// Runs `suite` on every engine of the catalog, in each of its variants, under these rules. The first is A* with h_k.
pub(crate) fn with_engines<R>(
    grid: &Arc<Grid>,
    rules: Rules,
    k: u32,
    suite: impl FnOnce(Vec<Engine<'_>>) -> R,
) -> R {
    let k = K::new(k).expect("k is at least 2");
    match rules {
        Rules::Center(corners) => on::<Centers, R>(grid, k, corners, suite),
        Rules::Corner(gap) => on::<Corners, R>(grid, k, gap, suite),
    }
}

fn on<P: Place, R>(grid: &Arc<Grid>, k: K, rule: P::Rule, suite: impl FnOnce(Vec<Engine<'_>>) -> R) -> R {
    let lattice = Arc::new(Lattice::<P>::new(Arc::clone(grid), k, rule).expect("k is in range"));
    suite(Setup::all(k, lattice.rules()).map(|setup| Engine::new(setup, &lattice)).collect())
}
