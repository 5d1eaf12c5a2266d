//! Planners of the typed crates, to measure what the library `mediant` adds to a query.

use std::{fmt, sync::Arc};

use mediant::{Error, Setup};
use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, FreeSpace, Grid, GridGraph};
use mediant_moves::{FiniteK, K};
use mediant_search::{AStar, Answer, Anya, BlockJps, Ends, Hk, Planner, QueryError};
use mediant_subgoal::{Hierarchy, HubLabelSearch, HubLabels, SubgoalAStar, SubgoalGraph, SubgoalPlacement};

/// An engine that is also measured as a typed planner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct TypedEngine {
    engine: Kind,
    setup: Setup,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Kind {
    AStar,
    JpsBlock,
    Labels,
    AnyAngleLabels,
    Subgoal,
    AnyAngleSubgoal,
    Anya,
}

/// As the setup, after `typed`.
impl fmt::Display for TypedEngine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "typed {}", self.setup)
    }
}

impl TypedEngine {
    /// The engine of a setup; `None` if it is not measured as a typed planner.
    #[must_use]
    pub fn of(setup: Setup) -> Option<Self> {
        let engine = match setup.to_string().as_str() {
            "astar:3:never" => Kind::AStar,
            "jps-block:3:never" => Kind::JpsBlock,
            "subgoal:3:never,levels=labels" => Kind::Labels,
            "subgoal:any:open,levels=labels" => Kind::AnyAngleLabels,
            "subgoal:3:never,levels=contracted" => Kind::Subgoal,
            "subgoal:any:open,levels=contracted" => Kind::AnyAngleSubgoal,
            "anya:any:open" => Kind::Anya,
            _ => return None,
        };
        Some(Self { engine, setup })
    }

    /// The setup through which the library has it.
    #[must_use]
    pub const fn setup(self) -> Setup {
        self.setup
    }

    /// A planner on a map.
    pub(crate) fn planner(self, grid: &Arc<Grid>) -> Result<Typed, Error> {
        let (never, open) = (CornerRule::Never, DiagonalGap::Open);
        let graph = || GridGraph::new(Arc::clone(grid), FiniteK::N8, never).map(Arc::new);
        let corners = || Arc::new(FreeSpace::<Corners>::new(Arc::clone(grid), open));
        Ok(match self.engine {
            Kind::AStar => Typed::AStar(AStar::new(graph()?, Hk)),
            Kind::JpsBlock => Typed::JpsBlock(BlockJps::new(graph()?, Hk)?),
            Kind::Labels => {
                let space = Arc::new(FreeSpace::<Centers>::new(Arc::clone(grid), never));
                Typed::Labels(labels(space, K::N8)?)
            }
            Kind::AnyAngleLabels => Typed::AnyAngleLabels(labels(corners(), K::Any)?),
            Kind::Subgoal => {
                let space = Arc::new(FreeSpace::<Centers>::new(Arc::clone(grid), never));
                let subgoals = SubgoalGraph::new(&space, K::N8, Hierarchy::Contracted)?;
                Typed::Subgoal(SubgoalAStar::new(space, Arc::new(subgoals))?)
            }
            Kind::AnyAngleSubgoal => {
                let space = corners();
                let subgoals = SubgoalGraph::new(&space, K::Any, Hierarchy::Contracted)?;
                Typed::AnyAngleSubgoal(SubgoalAStar::new(space, Arc::new(subgoals))?)
            }
            // As the library's index, with its dead ends.
            Kind::Anya => Typed::Anya(Anya::new(corners()).without_dead_ends()),
        })
    }
}

type Graph = Arc<GridGraph<Centers>>;
type Free<P> = Arc<FreeSpace<P>>;
type OnSubgoals<P> = SubgoalAStar<Free<P>, Arc<SubgoalGraph<P>>, P>;
type OnLabels<P> = HubLabelSearch<Free<P>, Arc<HubLabels<P>>>;

/// A planner on the hub labels of a space.
fn labels<P: SubgoalPlacement>(space: Free<P>, k: K) -> Result<OnLabels<P>, Error> {
    let labels = HubLabels::within(&space, k, usize::MAX, &|_| {}, &mediant_grid::Interrupt::NEVER)?;
    Ok(HubLabelSearch::new(space, Arc::new(labels))?)
}

/// A planner whose type the compiler knows.
pub(crate) enum Typed {
    AStar(AStar<Graph, Hk>),
    JpsBlock(BlockJps<Graph, Hk, Centers>),
    Labels(OnLabels<Centers>),
    AnyAngleLabels(OnLabels<Corners>),
    Subgoal(OnSubgoals<Centers>),
    AnyAngleSubgoal(OnSubgoals<Corners>),
    Anya(Anya<Free<Corners>>),
}

impl Typed {
    pub(crate) fn solve(&mut self, query: Ends) -> Result<Answer, QueryError> {
        match self {
            Self::AStar(planner) => planner.solve(query),
            Self::JpsBlock(planner) => planner.solve(query),
            Self::Labels(planner) => planner.solve(query),
            Self::AnyAngleLabels(planner) => planner.solve(query),
            Self::Subgoal(planner) => planner.solve(query),
            Self::AnyAngleSubgoal(planner) => planner.solve(query),
            Self::Anya(planner) => planner.solve(query),
        }
    }
}
