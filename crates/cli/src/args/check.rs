//! The arguments of `mediant check`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};

use super::{
    costs::{CostsArgs, WalkingArgs},
    flags::{Flags, MOTION},
    map::MapArgs,
};

#[derive(Args, Debug)]
#[command(after_help = CHECK_HELP)]
#[command(mut_arg("k", |arg| arg.help(K_HELP)))]
#[command(mut_arg("placement", |arg| arg.help(PLACEMENT_HELP)))]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) map: MapArgs,
    #[command(flatten)]
    pub(crate) costs: CostsArgs,
    #[command(flatten)]
    pub(crate) walking: WalkingArgs,
    /// The paths: what `mediant run --format jsonl` prints, or CSV with the columns x and y for one path; -
    /// is stdin
    #[arg(required = true, value_name = "PATHS")]
    pub(crate) paths: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) motion: Flags<MOTION>,
    /// Lines for people, or one JSON object a line for programs
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: CheckFormat,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum CheckFormat {
    #[default]
    Table,
    Jsonl,
}

const K_HELP: &str = "\
Each segment is to be moves of N(k): 2 to 12, or any, for segments of any direction. By default as the run \
says, any for smoothed paths and those of theta, lazy-theta and subgoal-theta, any for CSV";

const PLACEMENT_HELP: &str = "\
Where the vertices are: at cell centers or at cell corners. By default as the run says, and for CSV \
center, or corner with --k any; so are --corners and --gap";

const CHECK_HELP: &str = "\
A path holds if its ends are free, each of its segments obeys the rules of motion on this map, and each is \
made of moves of N(k). For a path that does not hold, a line says where: the index of its query, the \
segment, counted from 0, with its ends, and the blocked cell. Queries without a path are passed over. Edits \
between the queries of a run change the map for the paths after them.

With --radius a path must hold on the map of that agent, which is that of run with the same --k (for CSV 3 \
by default). With --world, CSV is in meters. A path that was found with --grounds must hold on the ground of \
its start.

With --costs, on a raster, or with --elevation a path must also cost what its run says, but for rounding.

With --format jsonl: a line {\"type\": \"path\"} for each path, with \"file\", \"index\", \"holds\", and \
for one that does not hold \"error\", \"holds_up_to\" (the number of waypoints to which it can be \
followed), \"segment\", \"from\", \"to\" and \"cell\", as far as there are such; on costs with \"cost\"; \
last a line {\"type\": \"summary\"} with \"paths\" and \"broken\".

Exit status: 0 if all paths hold, 1 if some do not, 2 for bad arguments, or a file that cannot be read.

Examples:
  mediant check arena.map arena.jsonl
  mediant check arena.map arena.csv --k 3
  mediant check arena.map arena.jsonl arena.csv --format jsonl
  mediant check depot.yaml depot.csv --world
  mediant check friction.tif friction.jsonl
  mediant check dem.tif walk.jsonl --elevation";
