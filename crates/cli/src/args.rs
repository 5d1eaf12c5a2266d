//! The command line.

use std::{
    fmt::Display,
    io::{self, Write},
    num::{IntErrorKind, NonZeroU32, NonZeroUsize, ParseIntError},
    path::PathBuf,
    process::ExitCode,
    str::FromStr,
};

use clap::{
    ArgGroup, Args, Parser, Subcommand, ValueEnum,
    builder::{PossibleValuesParser, TypedValueParser},
    error::ErrorKind,
};
use mediant_engines::{Engine, HeuristicName, Levels, Options, Setup, Variant};
use mediant_grid::{Centers, CornerRule, DiagonalGap, GridGraph, PlacementKind, Rules, Vertex};
use mediant_moves::{FiniteK, K, ParseKError};
use mediant_search::Smoothing;

use crate::failure::{Ending, FAILURE, Failure, finish, say_error};

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
    /// What guides the search: the cost on an empty grid, the straight-line distance, nothing (Dijkstra), or the distance squared, which
    /// overestimates
    #[arg(long, value_parser = names(HeuristicName::ALL, HeuristicName::name))]
    pub(crate) heuristic: Option<HeuristicName>,
    /// Of an engine that was published with a flaw: the optimal or complete one (the default), or the one as published
    #[arg(long, value_parser = names(Variant::ALL, Variant::name))]
    pub(crate) variant: Option<Variant>,
    /// Let no jump take more than N steps
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = |text: &str| parse_count(text, &NonZeroU32::MAX))]
    pub(crate) jump_limit: Option<NonZeroU32>,
    /// Keep the jump points at which a path only turns on its way to another, which are otherwise passed by
    #[arg(long)]
    pub(crate) keep_intermediate: bool,
    /// Leave a path through clusters as it is refined, without straightening it
    #[arg(long)]
    pub(crate) refined: bool,
    /// What guides the second phase, from checkpoint to checkpoint. What guides the first by default
    #[arg(long, value_name = "HEURISTIC", value_parser = names(HeuristicName::ALL, HeuristicName::name))]
    pub(crate) second: Option<HeuristicName>,
    /// Plan a checkpoint every N segments. 2 by default
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = |text: &str| parse_count(text, &NonZeroU32::MAX))]
    pub(crate) step: Option<NonZeroU32>,
    /// Pass by a checkpoint to which the way is more than N times as long as on an empty grid. 3 by default
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = |text: &str| parse_count(text, &NonZeroU32::MAX))]
    pub(crate) detour: Option<NonZeroU32>,
    /// Make each path shorter afterwards, by straight segments at any angle: linear (the default) looks for the next vertex in sight
    /// along the path, taut pulls the path tight around the corners
    #[arg(long, value_enum, num_args = 0..=1, require_equals = true, default_missing_value = "linear")]
    #[arg(hide_possible_values = true, value_name = "linear|taut")]
    pub(crate) smooth: Option<SmoothArg>,
    /// Also find each query's shortest any-angle path by this engine, and say how much longer the path is
    #[arg(long, value_name = "ENGINE", value_parser = names(REFERENCES, Engine::name))]
    pub(crate) reference: Option<Engine>,
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
    #[arg(long, default_value_t, value_parser = names(Engine::ALL, Engine::name))]
    pub(crate) engine: Engine,
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
    /// Give the subgoal graph or the clusters so many levels, of which 1 is the graph without a hierarchy, or all that there can be.
    /// A contraction hierarchy by default, 2 levels for subgoal-theta, 3 levels for hpa;
    /// with --index, those of the index
    #[arg(long, value_name = "N|all", allow_negative_numbers = true, value_parser = parse_levels)]
    pub(crate) levels: Option<Levels>,
    /// Cut the map into clusters (of the lowest level) or segments of N × N cells. 10 by default for hpa, 3 for chpa; with
    /// --index, those of the index
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    #[arg(value_parser = |text: &str| parse_count(text, &NonZeroU32::MAX))]
    pub(crate) side: Option<NonZeroU32>,
}

#[derive(Args, Debug)]
pub(crate) struct BuildArgs {
    /// A MovingAI map file, or builtin:NAME (archipelago, cave, maze, town)
    pub(crate) map: PathBuf,
    #[command(flatten)]
    pub(crate) setup: SetupArgs,
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
const REFERENCES: [Engine; 2] = [Engine::Anya, Engine::Subgoal];

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
        let options = Options {
            heuristic: self.heuristic,
            variant: self.variant,
            jump_limit: self.jump_limit,
            intermediate: self.keep_intermediate,
            levels: self.setup.levels,
            side: self.setup.side,
            refined: self.refined,
            second: self.second,
            step: self.step,
            detour: self.detour,
            smoothing: self.smooth.map(|smooth| match smooth {
                SmoothArg::Linear => Smoothing::Linear,
                SmoothArg::Taut => Smoothing::Taut,
            }),
        };
        self.setup.with(options)
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
        let SetupArgs { levels, side, .. } = self.setup;
        self.setup.with(Options { levels, side, ..Options::default() })
    }
}

impl SetupArgs {
    /// The setup with these options, if there is one.
    fn with(&self, options: Options) -> Result<Setup, Failure> {
        let k = self.k.unwrap_or(self.engine.about().default_k());
        let setup = Setup { options, ..Setup::new(self.engine, k, self.rules(k)?) };
        setup.check()?;
        Ok(setup)
    }

    /// PlacementKind and rule; an error for the rule of the other placement.
    fn rules(&self, k: K) -> Result<Rules, Failure> {
        let not_applicable =
            |option, placement, other| Err(Failure::NotApplicable { option, placement, other });
        let placement = match self.placement {
            None => self.engine.about().default_rules(k).placement(),
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

fn parse_vertex(text: &str) -> Result<Vertex, String> {
    const EXPECTED: &str = "expected two whole numbers, such as 3,14";
    let parts: Vec<&str> = text.split(',').collect();
    match parts[..] {
        [x, y] => Ok(Vertex::new(parse_coordinate(x)?, parse_coordinate(y)?)),
        [_] => Err(EXPECTED.to_owned()),
        _ => Err(format!("{EXPECTED}, found {} parts", parts.len())),
    }
}

fn parse_coordinate(text: &str) -> Result<i32, String> {
    text.trim().parse().map_err(|error: ParseIntError| match error.kind() {
        IntErrorKind::PosOverflow => format!("`{text}` is too large: coordinates go up to {}", i32::MAX),
        IntErrorKind::NegOverflow => format!("`{text}` is too small: coordinates go down to {}", i32::MIN),
        _ => format!("`{text}` is no whole number; write X,Y such as 3,14"),
    })
}

fn parse_count<N: FromStr<Err = ParseIntError> + Display>(text: &str, max: &N) -> Result<N, String> {
    text.parse().map_err(|error: ParseIntError| match error.kind() {
        IntErrorKind::PosOverflow => format!("expected a whole number from 1 to {max}"),
        _ => "expected a whole number from 1 up".to_owned(),
    })
}

/// A k that some engine may take.
fn parse_k(text: &str) -> Result<K, String> {
    let form = format!("choose a number from 2 to {MAX_K}, or any");
    match text.parse() {
        Err(ParseKError::K(error)) => Err(format!("{error}; {form}")),
        Ok(K::Finite(k)) if k.get() > MAX_K => Err(format!("k = {k} is too large; {form}")),
        Ok(k) => Ok(k),
        Err(_) => Err(form),
    }
}

fn parse_levels(text: &str) -> Result<Levels, String> {
    let max = u32::MAX;
    text.parse().map_err(|_| format!("expected a whole number from 1 to {max}, or all"))
}

/// A k of which the moves can be computed, though no grid graph may take it.
fn parse_any_k(text: &str) -> Result<FiniteK, String> {
    let max = FiniteK::MAX_MOVES;
    let form = format!("choose a number from 2 to {max}");
    let k =
        FiniteK::new(text.parse().map_err(|_| form.clone())?).map_err(|error| format!("{error}; {form}"))?;
    match k.radius() {
        Ok(_) => Ok(k),
        Err(error) => Err(error.to_string()),
    }
}

fn parse_ratio(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(ratio) if ratio >= 1.0 && ratio.is_finite() => Ok(ratio),
        _ => {
            Err("expected a number from 1 up, such as 1.01: no path is shorter than an any-angle path"
                .to_owned())
        }
    }
}

/// Prints what clap has to say: help and version as they are, an error in one line.
pub(crate) fn explain(error: &clap::Error) -> ExitCode {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            let printed = error.print().and_then(|()| io::stdout().flush());
            finish(printed.map(|()| Ending::Answered).map_err(Failure::Output))
        }
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => {
            _ = write!(anstream::stderr(), "{}", error.render().ansi());
            ExitCode::from(FAILURE)
        }
        _ => {
            say_error(&one_line(error));
            ExitCode::from(FAILURE)
        }
    }
}

/// clap's error without its paragraphs: what is wrong, what is possible, where to read more.
fn one_line(error: &clap::Error) -> String {
    // The tip on `--` is for positional arguments that look like options; none here does.
    const NOISE: [&str; 3] = ["Usage:", "For more information", "tip: to pass"];
    let text = error.render().to_string();
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let mut parts: Vec<String> = Vec::new();
    for line in lines.filter(|line| !NOISE.iter().any(|noise| line.starts_with(noise))) {
        let line = line.strip_prefix("error: ").unwrap_or(line);
        match parts.last_mut() {
            // A list of arguments follows the line that announces it.
            Some(last) if last.ends_with(':') => *last = format!("{last} {line}"),
            Some(last) if line.starts_with('[') => *last = format!("{last} {line}"),
            _ => parts.push(line.to_owned()),
        }
    }
    parts.push("see --help".to_owned());
    parts.join("; ")
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use mediant_engines::hierarchy_name;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn coordinates_may_be_negative_and_spaced() {
        assert_eq!(parse_vertex("-1, 3"), Ok(Vertex::new(-1, 3)));
        assert!(parse_vertex("3").is_err() && parse_vertex("3,").is_err() && parse_vertex("1,2,3").is_err());
        assert!(parse_vertex("99999999999,0").is_err());
    }

    #[test]
    fn k_is_a_number_or_any() {
        assert_eq!(parse_k("any"), Ok(K::Any));
        assert_eq!(parse_k("2"), Ok(K::Finite(FiniteK::N4)));
        for wrong in ["1", "13", "-3", "three", ""] {
            assert!(parse_k(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn the_help_says_what_is_meant_where_nothing_is_said() {
        let command = Cli::command();
        let run = command.find_subcommand("run").unwrap();
        let help = |name: &str| {
            let argument = run.get_arguments().find(|argument| argument.get_id() == name).unwrap();
            argument.get_help().unwrap().to_string()
        };
        let setup = |engine: Engine| {
            Setup::new(engine, FiniteK::N4, engine.about().default_rules(FiniteK::N4.into()))
        };
        for engine in [Engine::Subgoal, Engine::SubgoalTheta, Engine::Hpa] {
            let name = hierarchy_name(setup(engine).hierarchy().unwrap()).replacen("a c", "A c", 1);
            let name = if engine == Engine::Subgoal {
                format!("{name} by default")
            } else {
                format!("{name} for {engine}")
            };
            assert!(help("levels").contains(&name), "{name}: {}", help("levels"));
        }
        let chpa = setup(Engine::Chpa);
        for (option, value) in [("step", chpa.step()), ("detour", chpa.detour())] {
            assert!(help(option).contains(&format!("{} by default", value.unwrap())), "{}", help(option));
        }
    }

    #[test]
    fn references_are_the_engines_that_promise_the_shortest_any_angle_paths() {
        let promises = |engine: &Engine| {
            let setup = Setup::new(*engine, K::Any, engine.about().default_rules(K::Any));
            setup.check().is_ok() && setup.optimal_over() == Some(K::Any)
        };
        assert!(Engine::ALL.into_iter().filter(promises).eq(REFERENCES));
    }
}
