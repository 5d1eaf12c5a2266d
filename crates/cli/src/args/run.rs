//! The arguments of `mediant run`.

use std::{
    num::{NonZeroU32, NonZeroUsize},
    path::{Path, PathBuf},
};

use clap::{ArgGroup, Args, ValueEnum};
use mediant::{CornerRule, DiagonalGap, Engine, K, Motion, Rules, Setup};

use super::{
    costs::{CostsArgs, WalkingArgs},
    flags::{ENGINE, Flags, MOTION, OPTIONS, SMOOTH, WISHES},
    map::MapArgs,
    query::QueryArgs,
    setup::Asked,
    value::{one_of, parse_count},
};
use crate::failure::Failure;

#[derive(Args, Debug)]
#[command(after_help = RUN_HELP, group(ArgGroup::new("aim").args(["to", "distances"])))]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) map: MapArgs,
    #[command(flatten)]
    pub(crate) costs: CostsArgs,
    #[command(flatten)]
    pub(crate) walking: WalkingArgs,

    /// A MovingAI scenario file with the queries, or builtin:NAME; - is stdin
    #[arg(long, value_name = "FILE", conflicts_with_all = ["from", "to"])]
    pub(crate) scen: Option<PathBuf>,
    /// A CSV file with the queries, a line x1,y1,x2,y2 for each, from the start to the goal (with --world
    /// in meters); a first line of names is passed over; - is stdin
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scen", "from", "to", "distances"])]
    pub(crate) pairs: Option<PathBuf>,
    /// A timeline of JSON lines, with edits of the map, {"type":"edit","x","y","rows":["..#"]} (# is blocked,
    /// . free; with costs also "costs":[[1,2.5,null]] in place of rows), and the queries between them,
    /// {"type":"query","start":[x,y],"goal":[x,y]}; - is stdin
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scen", "pairs", "from", "to", "grounds"])]
    pub(crate) edits: Option<PathBuf>,
    /// Take the instances whose index, counted from 0, is divisible by N
    #[arg(long, value_name = "N", conflicts_with_all = ["from", "to"])]
    #[arg(allow_negative_numbers = true, value_parser = |text: &str| parse_count(text, &NonZeroUsize::MAX))]
    pub(crate) every: Option<NonZeroUsize>,
    /// Take at most N instances
    #[arg(long, value_name = "N", conflicts_with_all = ["from", "to"])]
    #[arg(allow_negative_numbers = true, value_parser = |text: &str| parse_count(text, &NonZeroUsize::MAX))]
    pub(crate) limit: Option<NonZeroUsize>,
    /// Answer each query of a MovingAI map on the ground of its start: land (.GS), water (W) or trees (T),
    /// between which no step leads
    #[arg(long, conflicts_with_all = ["free", "blocked", "index", "distances", "costs"])]
    #[arg(conflicts_with_all = ["inflation_radius", "elevation", "band", "no_data"])]
    pub(crate) grounds: bool,
    #[command(flatten)]
    pub(crate) query: QueryArgs,

    #[command(flatten)]
    pub(crate) flags: Flags<{ MOTION | WISHES | ENGINE | OPTIONS | SMOOTH }>,
    /// Also find each query's shortest any-angle path by this engine, and say how much longer the path is
    #[arg(long, value_name = "ENGINE", value_parser = one_of(REFERENCES.to_vec(), Engine::name))]
    pub(crate) reference: Option<Engine>,
    /// Load the engine's index from a file that `mediant build` wrote, instead of preparing it
    #[arg(long, value_name = "FILE")]
    pub(crate) index: Option<PathBuf>,

    /// End with status 3 if any query has no path: if it is unreachable, nearest or stopped
    #[arg(long, conflicts_with = "distances")]
    pub(crate) require_path: bool,
    /// Time each query N times and report the best
    #[arg(long, value_name = "N", default_value = "1")]
    #[arg(allow_negative_numbers = true, value_parser = |text: &str| parse_count(text, &NonZeroU32::MAX))]
    pub(crate) repeat: NonZeroU32,
    /// A table for people, one JSON object a line for programs, or a line of numbers for each query (csv)
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
    /// Draw the map and the path of a single query: on the screen, or to a .png or .svg file, there also what
    /// was searched. Where cells have costs or elevations these are drawn instead
    #[arg(long, value_name = "FILE", num_args = 0..=1)]
    pub(crate) draw: Option<Option<PathBuf>>,
    /// Write the events of a single query's search to this file, for the Posthoc visualizer
    #[arg(long, value_name = "FILE", conflicts_with_all = ["nearest", "tolerance", "timeout"])]
    pub(crate) trace: Option<PathBuf>,
    /// Write the distances from --from to all vertices to this file, as CSV (`-` is stdout); needs an engine
    /// that finds them
    #[arg(long, value_name = "FILE", requires = "from")]
    #[arg(conflicts_with_all = ["scen", "every", "limit", "smooth", "reference", "index", "repeat"])]
    #[arg(conflicts_with_all = ["format", "draw", "trace", "nearest", "snap", "tolerance"])]
    #[arg(conflicts_with_all = ["max-cost", "max-expansions", "timeout"])]
    pub(crate) distances: Option<PathBuf>,
}

/// For people, and for two kinds of programs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    #[default]
    Table,
    Jsonl,
    Csv,
}

const RUN_HELP: &str = "\
Times are of the query alone, on a warm planner: each query is first solved once without a clock, which also \
counts expanded and generated nodes and heap percolations; the timed runs count nothing.

For each path found the report gives a certificate: how much longer than the shortest any-angle path between its ends \
it is at most, by the engine's guarantee and by the straight line, between centers by the straight line alone. With \
--reference it also gives how much longer it is.

--tolerance, --nearest, --snap and the limits hold for each query. What is near is measured by the length of \
a path on an empty map, for --tolerance by the straight line. A search that a limit stops gives the best \
path so far, and a lower bound on the cost of the path that was asked for. A deadline holds for each run of \
a query, and the first run, which counts, gives the answer. hpa links its ends to their clusters before it \
looks at a limit.

For a builtin map without queries, the queries are those of its own scenario.

After an edit the index is repaired, or prepared anew where its engine cannot be repaired, and the planner follows. \
The time of a change has all of that; the time of a query is as ever. The coordinates of a timeline are cells and \
vertices, also with --world. Edits with \"more\": true are one change with the next. With --format jsonl each edit is \
repeated, with the number of \"cells\" that it changed and the \"nanos\" of its change (0 where more follow), so that \
the output can be replayed; it is a timeline, too. Where cells have costs a . frees a cell at its last cost, and what \
is repeated is \"costs\": a number for each cell, null for a blocked one.

The map may be a scenario of the Grid-Based Path Planning Competition, version 2, with its file of patches beside it: \
its patches and queries are a timeline, and its octile costs are compared. The patches before the first query make the \
map, which the output tells as an edit with \"initial\": true of a map without obstacles. Other commands take such a \
scenario as its map at the first query.

A trace is JSON for the Posthoc visualizer: every event of the search, then the path found.

Exit status: 0 if every query was answered (found, unreachable, nearest or stopped), 1 if any was an error, \
2 for bad arguments, or a file that cannot be read or written, 3 with --require-path if no query was an \
error but any is without the path that was asked for.

Examples:
  mediant run builtin:archipelago
  mediant run arena.map --scen arena.map.scen --k 5 --placement corner --format jsonl
  mediant run arena.map --pairs pairs.csv --format jsonl
  mediant run arena.map --scen arena.map.scen --format csv
  mediant run arena.map --edits timeline.jsonl --engine jps-block
  mediant run changing.scen
  mediant run arena.map --from 1,11 --to 40,30 --draw
  mediant run arena.map --from 1,11 --to 40,30 --engine anya --draw
  mediant run arena.map --from 1,11 --to 40,30 --draw path.svg
  mediant run depot.yaml --world --radius 0.3 --from 0,0 --to 2,1 --draw path.png
  mediant run depot.yaml --world --inscribed-radius 0.1 --inflation-radius 0.5 --from 0,0 --to 2,1
  mediant run arena.map --scen arena.map.scen --engine subgoal --index arena.idx
  mediant run dem.tif --elevation --k 5 --from 3,4 --to 100,200
  mediant run builtin:town --k 4 --placement corner --smooth --reference anya
  mediant run arena.map --from 1,11 --to 40,30 --to 30,5 --to 8,40
  mediant run arena.map --from 1,11 --to 40,30 --snap --nearest --tolerance 1.5
  mediant run arena.map --scen arena.map.scen --max-expansions 1000 --max-cost 60 --timeout 0.5
  mediant run arena.map --scen arena.map.scen --engine subgoal --memory 8MB --distance
  mediant run arena.map --scen arena.map.scen --grounds
  mediant run arena.map --from 1,11 --engine dijkstra --distances -";

/// The engines whose paths are the shortest at any angle.
const REFERENCES: [Engine; 2] = [Engine::Anya, Engine::Subgoal];

impl RunArgs {
    /// The setup that is asked for.
    pub(crate) fn asked(&self) -> Result<Asked, Failure> {
        let Self { flags, index, map, costs, walking, .. } = self;
        Asked::of_numbers(&flags.0, index.is_some(), map, costs, walking)
    }

    /// The files to be written.
    pub(crate) fn outputs(&self) -> Vec<&Path> {
        let drawn = self.draw.iter().flatten().chain(&self.trace);
        let printed = |path: &&PathBuf| *path == Path::new("-");
        drawn.chain(self.distances.iter().filter(|path| !printed(path))).map(PathBuf::as_path).collect()
    }

    /// Checks that a single query has several ends only where that has a meaning.
    pub(crate) const fn check_ends(&self) -> Result<(), Failure> {
        if !self.query.has_several_ends() {
            Ok(())
        } else if self.trace.is_some() {
            Err(Failure::TraceEnds)
        } else if self.distances.is_some() {
            Err(Failure::DistancesEnds)
        } else if self.query.distance {
            Err(Failure::DistanceEnds)
        } else {
            Ok(())
        }
    }

    /// The setup of `--reference`, under the same rules of motion, between centers by corners of obstacles;
    /// `None` without it.
    pub(crate) fn reference(&self, rules: Rules) -> Result<Option<Setup>, Failure> {
        let Some(engine) = self.reference else { return Ok(None) };
        // So the same is connected at any angle as by moves.
        let rules = match rules {
            Rules::Center(CornerRule::Always) => Rules::CenterGap(DiagonalGap::Open),
            Rules::Center(_) => Rules::CenterGap(DiagonalGap::Closed),
            rules => rules,
        };
        let setup = Setup::new(engine, Motion::new(K::Any, rules));
        setup.check().map_err(mediant::Error::from)?;
        Ok(Some(setup))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn references_are_the_engines_that_promise_the_shortest_any_angle_paths() {
        let promises = |engine: &Engine| {
            let setup = Setup::new(*engine, Motion::new(K::Any, engine.capabilities().default_rules(K::Any)));
            setup.check().is_ok() && setup.optimal_over() == Some(K::Any)
        };
        assert!(Engine::ALL.into_iter().filter(promises).eq(REFERENCES));
    }
}
