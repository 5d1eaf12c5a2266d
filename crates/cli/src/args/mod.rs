//! The command line.

mod engine;
mod explain;
mod parse;

use std::{
    num::{NonZeroU32, NonZeroUsize},
    path::PathBuf,
    str::FromStr,
};

use clap::{
    ArgGroup, Args, Parser, Subcommand, ValueEnum,
    builder::{PossibleValuesParser, TypedValueParser},
};
use mediant_engines::{EngineKind, Setup};
use mediant_grid::{Centers, CornerRule, DiagonalGap, GridGraph, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, K};
use mediant_search::Smoothing;

use self::{
    engine::{AllOptions, IndexOptions},
    parse::{parse_any_k, parse_count, parse_k, parse_ratio, parse_vertex},
};
use crate::failure::Failure;

pub(crate) use self::explain::explain;

/// Pathfinding on the 2^k neighborhoods of a grid: from the 4-connected grid (k = 2) towards any angle.
#[derive(Debug, Parser)]
#[command(name = "mediant", version, max_term_width = 100)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Answer queries on a map.
    Run(RunArgs),
    /// Preprocess a map, and save what an engine needs of it.
    Build(BuildArgs),
    /// Show the moves of N(k), its radius and its bounds.
    Moves(MovesArgs),
    /// List the engines: placements, k, guarantee, paper.
    Engines,
    /// Solve a query on a bundled map for many k, and draw the paths.
    Demo(DemoArgs),
}

#[derive(Args, Debug)]
#[command(after_help = RUN_HELP, group(ArgGroup::new("aim").args(["to", "distances"])))]
pub(crate) struct RunArgs {
    /// A MovingAI map file, or builtin:NAME (archipelago, cave, maze, town)
    pub(crate) map: PathBuf,

    /// A MovingAI scenario file with the queries, or builtin:NAME
    #[arg(long, value_name = "FILE", conflicts_with_all = ["from", "to"])]
    pub(crate) scen: Option<PathBuf>,
    /// Take the instances whose index, counted from 0, is divisible by N
    #[arg(long, value_name = "N", conflicts_with_all = ["from", "to"])]
    #[arg(allow_negative_numbers = true, value_parser = |text: &str| parse_count(text, &NonZeroUsize::MAX))]
    pub(crate) every: Option<NonZeroUsize>,
    /// Take at most N instances
    #[arg(long, value_name = "N", conflicts_with_all = ["from", "to"])]
    #[arg(allow_negative_numbers = true, value_parser = |text: &str| parse_count(text, &NonZeroUsize::MAX))]
    pub(crate) limit: Option<NonZeroUsize>,
    /// The start of a single query
    #[arg(long, value_name = "X,Y", requires = "aim", allow_hyphen_values = true, value_parser = parse_vertex)]
    pub(crate) from: Option<Vertex>,
    /// The goal of a single query
    #[arg(long, value_name = "X,Y", requires = "from", allow_hyphen_values = true, value_parser = parse_vertex)]
    pub(crate) to: Option<Vertex>,

    #[command(flatten)]
    pub(crate) setup: SetupArgs,
    #[command(flatten)]
    pub(crate) options: AllOptions,
    /// Make each path shorter afterwards, by straight segments at any angle: linear (the default) looks for the next vertex in sight
    /// along the path, taut pulls the path tight around the corners
    #[arg(long, value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "linear")]
    #[arg(hide_possible_values = true, value_name = "linear|taut")]
    pub(crate) smooth: Option<SmoothArg>,
    /// Also find each query's shortest any-angle path by this engine, and say how much longer the path is
    #[arg(long, value_name = "ENGINE", value_parser = names(REFERENCES, EngineKind::name))]
    pub(crate) reference: Option<EngineKind>,
    /// Load what the engine preprocesses from a file that `mediant build` made
    #[arg(long, value_name = "FILE")]
    pub(crate) index: Option<PathBuf>,

    /// Time each query N times and report the best
    #[arg(long, value_name = "N", default_value = "1")]
    #[arg(allow_negative_numbers = true, value_parser = |text: &str| parse_count(text, &NonZeroU32::MAX))]
    pub(crate) repeat: NonZeroU32,
    /// A table for people, or one JSON object a line for programs
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Draw the map and the path of a single query
    #[arg(long)]
    pub(crate) draw: bool,
    /// Write what the search of a single query does to this file, for the Posthoc visualizer
    #[arg(long, value_name = "FILE")]
    pub(crate) trace: Option<PathBuf>,
    /// Write the distances from --from to all vertices to this file, as CSV (`-` is stdout); needs an engine that finds them
    #[arg(long, value_name = "FILE", requires = "from")]
    #[arg(conflicts_with_all = ["scen", "every", "limit", "smooth", "reference", "index", "repeat", "format", "draw", "trace"])]
    pub(crate) distances: Option<PathBuf>,
}

/// What to search, and by which engine.
#[derive(Args, Debug)]
pub(crate) struct SetupArgs {
    /// How to search
    #[arg(long, default_value_t, value_parser = names(EngineKind::ALL, EngineKind::name))]
    pub(crate) engine: EngineKind,
    /// The neighborhood: 2 to 12, or any, which is every direction. 3 by default, any for anya
    #[arg(long, allow_negative_numbers = true, value_parser = parse_k)]
    pub(crate) k: Option<K>,
    /// Where the vertices are: at cell centers or at cell corners. center by default, corner for anya, subgoal-theta and k = any
    #[arg(long, value_enum, hide_possible_values = true, value_name = "center|corner")]
    pub(crate) placement: Option<PlacementArg>,
    /// At centers, whether a path may cut the corner of a blocked cell: never (the default), one (if the cell across is
    /// free), always
    #[arg(long, value_enum, hide_possible_values = true, value_name = "never|one|always")]
    pub(crate) corners: Option<CornersArg>,
    /// At corners, whether a path may pass between two blocked cells that touch diagonally: open (the default), closed
    #[arg(long, value_enum, hide_possible_values = true, value_name = "open|closed")]
    pub(crate) gap: Option<GapArg>,
}

#[derive(Args, Debug)]
pub(crate) struct BuildArgs {
    /// A MovingAI map file, or builtin:NAME (archipelago, cave, maze, town)
    pub(crate) map: PathBuf,
    #[command(flatten)]
    pub(crate) setup: SetupArgs,
    #[command(flatten)]
    pub(crate) options: IndexOptions,
    /// The file to make
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: PathBuf,
}

const RUN_HELP: &str = "\
Times are of the query alone, on a warm planner: each query is first solved once without a clock, which also counts \
expanded and generated nodes and heap percolations; the timed runs count nothing.

Of each path found the report says how much longer than the shortest any-angle path it can be: the certificate, which follows from \
what the engine guarantees and from the straight line between the ends. --reference says how much longer it is.

A builtin map with no query given runs its own scenario.

A trace is JSON for the Posthoc visualizer, with every event of the search, and the path found as its end.

Exit status: 0 when every query was answered (found or unreachable), 1 when any was an error, 2 for bad arguments or an \
unreadable file.

Examples:
  mediant run builtin:archipelago
  mediant run arena.map --scen arena.map.scen --k 5 --placement corner --format jsonl
  mediant run arena.map --from 1,11 --to 40,30 --draw
  mediant run arena.map --from 1,11 --to 40,30 --engine anya --draw
  mediant run arena.map --scen arena.map.scen --engine subgoal --index arena.idx
  mediant run builtin:town --k 4 --placement corner --smooth --reference anya
  mediant run arena.map --from 1,11 --engine dijkstra --distances -";

#[derive(Args, Debug)]
pub(crate) struct MovesArgs {
    /// The neighborhood: 2 to 47
    #[arg(long, allow_negative_numbers = true, value_parser = parse_any_k)]
    pub(crate) k: Option<FiniteK>,
    /// Find the smallest k whose paths are at most R times as long as any-angle paths, for instance 1.01
    #[arg(long, value_name = "R", allow_negative_numbers = true, value_parser = parse_ratio)]
    pub(crate) ratio: Option<f64>,
}

#[derive(Args, Debug)]
pub(crate) struct DemoArgs {
    /// The bundled map: archipelago, cave, maze or town
    #[arg(default_value = "archipelago")]
    pub(crate) name: String,
}

/// The largest k that grid graphs take.
pub(crate) const MAX_K: u32 = GridGraph::<Centers>::MAX_K;

/// The engines whose paths are the shortest at any angle.
const REFERENCES: [EngineKind; 2] = [EngineKind::Anya, EngineKind::Subgoal];

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlacementArg {
    Center,
    Corner,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CornersArg {
    Never,
    One,
    Always,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum GapArg {
    Open,
    Closed,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SmoothArg {
    Linear,
    Taut,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    #[default]
    Table,
    Jsonl,
}

/// Takes one of these names.
fn names<T: FromStr<Err = mediant_engines::UnknownName> + Clone + Send + Sync + 'static, const N: usize>(
    all: [T; N],
    name: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T> {
    PossibleValuesParser::new(all.map(name)).try_map(|name| name.parse())
}

impl RunArgs {
    /// The setup that the arguments ask for, if there is one.
    pub(crate) fn setup(&self) -> Result<Setup, Failure> {
        let mut setup = self.setup.plain()?;
        self.options.choose(&mut setup.engine)?;
        setup.smoothing = self.smooth.map(|smooth| match smooth {
            SmoothArg::Linear => Smoothing::Linear,
            SmoothArg::Taut => Smoothing::Taut,
        });
        setup.check()?;
        Ok(setup)
    }

    /// The setup that finds the shortest any-angle paths to compare with, if it is asked for.
    pub(crate) fn reference(&self, rules: Rules) -> Result<Option<Setup>, Failure> {
        let Some(engine) = self.reference else { return Ok(None) };
        let setup = Setup::new(engine, K::Any, rules);
        match setup.check() {
            Ok(()) => Ok(Some(setup)),
            Err(_) => Err(Failure::NoReference { engine, placement: rules.placement() }),
        }
    }
}

impl BuildArgs {
    /// The setup that the arguments ask for, if there is one.
    pub(crate) fn setup(&self) -> Result<Setup, Failure> {
        let mut setup = self.setup.plain()?;
        self.options.choose(&mut setup.engine)?;
        setup.check()?;
        Ok(setup)
    }
}

impl SetupArgs {
    /// The setup without options.
    fn plain(&self) -> Result<Setup, Failure> {
        let k = self.k.unwrap_or(self.engine.capabilities().default_k());
        Ok(Setup::new(self.engine, k, self.rules(k)?))
    }

    /// Placement and rule; an error for the rule of the other placement.
    fn rules(&self, k: K) -> Result<Rules, Failure> {
        let not_applicable =
            |option, placement, other| Err(Failure::NotApplicable { option, placement, other });
        let placement = match self.placement {
            None => self.engine.capabilities().default_rules(k).placement(),
            Some(PlacementArg::Center) => PlacementKind::Center,
            Some(PlacementArg::Corner) => PlacementKind::Corner,
        };
        match placement {
            PlacementKind::Center if self.gap.is_some() => not_applicable("--gap", "center", "corner"),
            PlacementKind::Corner if self.corners.is_some() => {
                not_applicable("--corners", "corner", "center")
            }
            PlacementKind::Center => Ok(Rules::Center(match self.corners {
                None | Some(CornersArg::Never) => CornerRule::Never,
                Some(CornersArg::One) => CornerRule::One,
                Some(CornersArg::Always) => CornerRule::Always,
            })),
            PlacementKind::Corner => Ok(Rules::Corner(match self.gap {
                None | Some(GapArg::Open) => DiagonalGap::Open,
                Some(GapArg::Closed) => DiagonalGap::Closed,
            })),
        }
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use mediant_engines::Engine;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn the_help_says_what_is_meant_where_nothing_is_said() {
        let command = Cli::command();
        let run = command.find_subcommand("run").unwrap();
        let help = |name: &str| {
            let argument = run.get_arguments().find(|argument| argument.get_id() == name).unwrap();
            argument.get_help().unwrap().to_string()
        };
        let engine = |kind: EngineKind| Engine::from(kind);
        for kind in [EngineKind::Subgoal, EngineKind::SubgoalTheta, EngineKind::Hpa] {
            let name = engine(kind).levels().unwrap().in_words().replacen("a c", "A c", 1);
            let by =
                if kind == EngineKind::Subgoal { "by default".to_owned() } else { format!("for {kind}") };
            let name = format!("{name} {by}");
            assert!(help("levels").contains(&name), "{name}: {}", help("levels"));
        }
        for (kind, by) in [(EngineKind::Hpa, "10 by default for hpa"), (EngineKind::Chpa, "3 for chpa")] {
            assert!(
                by.contains(&engine(kind).side().unwrap().to_string()) && help("side").contains(by),
                "{by}"
            );
        }
        let chpa = engine(EngineKind::Chpa);
        for (option, value) in [("step", chpa.step()), ("detour", chpa.detour())] {
            assert!(help(option).contains(&format!("{} by default", value.unwrap())), "{}", help(option));
        }
    }

    #[test]
    fn references_are_the_engines_that_promise_the_shortest_any_angle_paths() {
        let promises = |engine: &EngineKind| {
            let setup = Setup::new(*engine, K::Any, engine.capabilities().default_rules(K::Any));
            setup.check().is_ok() && setup.optimal_over() == Some(K::Any)
        };
        assert!(EngineKind::ALL.into_iter().filter(promises).eq(REFERENCES));
    }
}
