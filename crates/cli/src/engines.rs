//! The engines as a closed enum, and the way from its values to planners that are compiled for their types.

use std::{fmt, sync::Arc, time::Duration, time::Instant};

use clap::ValueEnum;
use mediant_grid::{Centers, Corners, Grid, Lattice, Place, Rules};
use mediant_moves::{K, KError};
use mediant_search::{AStar, Euclidean, Guarantee, LatticeDistance, Planner, Zero};

use crate::{
    args::{KArg, RunArgs},
    failure::Failure,
    screen::Screen,
    text::{Align, Table},
};

/// Every engine that there is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Engine {
    #[default]
    Astar,
}

/// What the table of engines says of one.
struct About {
    placements: &'static str,
    k: &'static str,
    guarantee: &'static str,
    paper: &'static str,
}

impl Engine {
    const fn about(self) -> About {
        match self {
            Self::Astar => About {
                placements: "center, corner",
                k: "2 … 12",
                guarantee: "optimal(k)",
                paper: "Hart 1968, Rivera 2017",
            },
        }
    }
}

/// The names that the command line takes.
macro_rules! display_as_value {
    ($($type:ty),+) => {
        $(impl fmt::Display for $type {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.to_possible_value().map_or(Ok(()), |value| f.pad(value.get_name()))
            }
        })+
    };
}

display_as_value!(Engine, HeuristicName);

/// The heuristics of A*.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum HeuristicName {
    /// The cost on an empty grid.
    #[default]
    Hk,
    /// The straight-line distance.
    Euclidean,
    /// None: Dijkstra's algorithm.
    Zero,
}

/// All that makes a planner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Setup {
    pub(crate) engine: Engine,
    pub(crate) k: K,
    pub(crate) rules: Rules,
    pub(crate) heuristic: HeuristicName,
}

impl Setup {
    /// The setup that the arguments ask for, if there is one.
    pub(crate) fn new(args: &RunArgs) -> Result<Self, Failure> {
        let rules = args.rules()?;
        let k = match (args.engine, args.k) {
            (Engine::Astar, KArg::Finite(k)) => k,
            (engine @ Engine::Astar, KArg::Any) => {
                return Err(Failure::NeedsFiniteK { engine, min: K::FOUR_CONNECTED.get(), max: KArg::MAX });
            }
        };
        Ok(Self { engine: args.engine, k, rules, heuristic: args.heuristic })
    }
}

/// What preprocessing took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Preprocessing {
    pub(crate) time: Duration,
    /// Beyond the map itself.
    pub(crate) index_bytes: u64,
}

/// Something to do with a planner, whatever its type.
pub(crate) trait Task {
    type Output;

    fn run<P: Planner>(self, planner: P, preprocessing: Preprocessing) -> Self::Output;
}

/// Makes the planner and hands it to the task.
pub(crate) fn with_planner<T: Task>(setup: Setup, grid: Arc<Grid>, task: T) -> Result<T::Output, KError> {
    match setup.rules {
        Rules::Center(corners) => on_lattice::<Centers, T>(setup, grid, corners, task),
        Rules::Corner(gap) => on_lattice::<Corners, T>(setup, grid, gap, task),
    }
}

fn on_lattice<P: Place, T: Task>(
    setup: Setup,
    grid: Arc<Grid>,
    rule: P::Rule,
    task: T,
) -> Result<T::Output, KError> {
    let begin = Instant::now();
    let lattice = Lattice::<P>::new(grid, setup.k, rule)?;
    let preprocessing = Preprocessing { time: begin.elapsed(), index_bytes: lattice.index_bytes() as u64 };
    Ok(match (setup.engine, setup.heuristic) {
        (Engine::Astar, HeuristicName::Hk) => task.run(AStar::new(&lattice, LatticeDistance), preprocessing),
        (Engine::Astar, HeuristicName::Euclidean) => task.run(AStar::new(&lattice, Euclidean), preprocessing),
        (Engine::Astar, HeuristicName::Zero) => task.run(AStar::new(&lattice, Zero), preprocessing),
    })
}

/// A guarantee in one word: `optimal(3)`, `optimal(any)`, `suboptimal`.
pub(crate) fn guarantee_name(guarantee: Guarantee) -> String {
    match guarantee {
        Guarantee::Optimal(k) => format!("optimal({k})"),
        Guarantee::OptimalAnyAngle => "optimal(any)".to_owned(),
        Guarantee::Suboptimal => "suboptimal".to_owned(),
    }
}

/// `mediant engines`.
pub(crate) fn list(screen: &mut Screen) -> Result<(), Failure> {
    let heads = ["engine", "placements", "k", "guarantee", "paper"].map(|head| (head, Align::Left));
    let mut table = Table::new(heads);
    for &engine in Engine::value_variants() {
        let About { placements, k, guarantee, paper } = engine.about();
        table.row([&engine.to_string(), placements, k, guarantee, paper].map(str::to_owned));
    }
    Ok(table.write(screen)?)
}
