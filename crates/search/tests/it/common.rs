//! Runs any engine under any rules, for all suites.

use std::sync::Arc;

use mediant::{Engine, Map, Motion, Planner, Setup, Space, options::Variant};
use mediant_grid::{DiagonalGap, Grid, Rules};
use mediant_moves::{FiniteK, K};
use mediant_search::{Answer, Counters, Ends, Guarantee, QueryError};

/// The answer of an engine to a query.
pub(crate) type CountedAnswer = Result<(Answer, Counters), QueryError>;

/// An engine on one search space, for any number of queries. Its planner is made at the first one, since most
/// suites run few engines.
pub(crate) struct TestedEngine<'g> {
    pub(crate) name: String,
    pub(crate) guarantee: Guarantee,
    /// The directions that its paths may take.
    pub(crate) paths: K,
    /// Whether it may fail to find a path where there is one.
    pub(crate) may_give_up: bool,
    /// Whether it searches a prepared graph. The crates of those engines have long suites of their own.
    pub(crate) is_prepared: bool,
    planner: Option<Planner>,
    setup: Setup,
    space: &'g Space,
}

impl<'g> TestedEngine<'g> {
    fn new(setup: Setup, space: &'g Space) -> Self {
        let (guarantee, paths) = (setup.guarantee(), setup.paths());
        let may_give_up =
            (setup.engine.kind(), setup.engine.variant()) == (Engine::Chpa, Some(Variant::Paper));
        let is_prepared = matches!(
            setup.engine.kind(),
            Engine::Subgoal | Engine::SubgoalTheta | Engine::Hpa | Engine::Chpa
        );
        let name = setup.to_string();
        Self { name, guarantee, paths, may_give_up, is_prepared, planner: None, setup, space }
    }

    pub(crate) fn solve(&mut self, query: Ends) -> CountedAnswer {
        let Self { setup, space, .. } = *self;
        let make = || {
            let index = setup.prepare(space).unwrap_or_else(|error| panic!("{setup}: {error}"));
            let planner = index.planner();
            assert_eq!(planner.guarantee(), setup.guarantee(), "{setup}");
            planner
        };
        self.planner.get_or_insert_with(make).find_counted(query)
    }
}

/// Runs `suite` on every engine of the catalog that searches N(k), in each of its variants, under these
/// rules. The first is A* with h_k.
pub(crate) fn with_engines<R>(
    grid: &Arc<Grid>,
    rules: Rules,
    k: u32,
    suite: impl FnOnce(Vec<TestedEngine<'_>>) -> R,
) -> R {
    on(grid, rules, K::Finite(FiniteK::new(k).expect("k is at least 2")), suite)
}

/// Runs `suite` on every engine of the catalog that searches at any angle under these rules. There is at
/// least one.
pub(crate) fn with_any_angle_engines<R>(
    grid: &Arc<Grid>,
    gap: DiagonalGap,
    suite: impl FnOnce(Vec<TestedEngine<'_>>) -> R,
) -> R {
    on(grid, Rules::Corner(gap), K::Any, suite)
}

fn on<R>(grid: &Arc<Grid>, rules: Rules, k: K, suite: impl FnOnce(Vec<TestedEngine<'_>>) -> R) -> R {
    let setups: Vec<Setup> = Setup::all(Motion::new(k, rules)).collect();
    let space = setups[0].space(&Map::from(Arc::clone(grid))).expect("k is in range");
    suite(setups.into_iter().map(|setup| TestedEngine::new(setup, &space)).collect())
}
