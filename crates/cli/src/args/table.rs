//! The arguments of `mediant table`.

use std::path::PathBuf;

use clap::Args;

use super::{
    costs::{CostsArgs, WalkingArgs},
    flags::{ENGINE, Flags, MOTION, OPTIONS},
    map::MapArgs,
    run::Format,
    value::{Place, parse_place},
};

#[derive(Args, Debug)]
#[command(after_help = TABLE_HELP)]
pub(crate) struct TableArgs {
    #[command(flatten)]
    pub(crate) map: MapArgs,
    #[command(flatten)]
    pub(crate) costs: CostsArgs,
    #[command(flatten)]
    pub(crate) walking: WalkingArgs,

    /// A start (repeat it for several)
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = parse_place)]
    pub(crate) from: Vec<Place>,
    /// A goal (repeat it for several)
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = parse_place)]
    pub(crate) to: Vec<Place>,
    /// A file with more starts, one x,y a line; - is stdin
    #[arg(long, value_name = "FILE")]
    pub(crate) from_file: Option<PathBuf>,
    /// A file with more goals, one x,y a line; - is stdin
    #[arg(long, value_name = "FILE")]
    pub(crate) to_file: Option<PathBuf>,
    /// End with status 3 if there is no way between any start and goal, with --nearest from any start
    #[arg(long)]
    pub(crate) require_path: bool,
    /// Find only the nearest goal of each start
    #[arg(long)]
    pub(crate) nearest: bool,

    #[command(flatten)]
    pub(crate) flags: Flags<{ MOTION | ENGINE | OPTIONS }>,
    /// Load the engine's index from a file that `mediant build` wrote, instead of preparing it
    #[arg(long, value_name = "FILE")]
    pub(crate) index: Option<PathBuf>,
    /// A table for people, one JSON object a line, or CSV
    #[arg(long, value_enum, default_value_t)]
    pub(crate) format: Format,
}

const TABLE_HELP: &str = "\
With hub labels (engine subgoal, on most maps) all goals of a start are measured together, in far less time than a \
query for each takes. With other engines each pair is a query. By default, more than 1,000 pairs are measured by \
subgoal, fewer by an engine that prepares little.

Lengths are in cells; with costs of cells they are costs, and with --elevation seconds. The table \
shows what fits on the screen; jsonl and csv have everything. CSV has a line for \
each pair: start_x, start_y, goal_x, goal_y and distance, empty if there is no way. With --format jsonl: a line \
{\"type\": \"table\"} with \"starts\" and \"goals\", how many there are, then a line {\"type\": \"row\"} for each \
start, with \"start\" and \"distances\" (null: no way), with --nearest \"goal\", \"number\" (of the goal, from 0) \
and \"distance\"; last a line {\"type\": \"summary\"} with \"nanos\", the time of all.

Exit status: 0, 1 if a start or goal is blocked or outside the map, 2 for bad arguments, or a file that cannot be \
read, 3 with --require-path if there is no way somewhere.

Examples:
  mediant table builtin:town --from 10,3 --from 58,18 --to 6,6 --to 60,29
  mediant table arena.map --from-file homes.txt --to-file hotels.txt --nearest --format csv
  mediant table friction.tif --k 4 --from 1,11 --from 9,9 --to-file goals.txt --nearest
  mediant table arena.map --k any --from 1,11 --to-file goals.txt --index arena.idx --format jsonl";
