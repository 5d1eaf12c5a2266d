//! The command line: the arguments of each command.

mod build;
mod check;
mod convert;
mod costs;
mod demo;
mod explain;
mod flags;
mod manual;
mod map;
mod moves;
mod query;
mod reach;
mod run;
mod setup;
mod table;
mod value;

use clap::{Parser, Subcommand};

pub(crate) use self::{
    build::BuildArgs,
    check::{CheckArgs, CheckFormat},
    convert::ConvertArgs,
    costs::{CostsArgs, InflationArgs, ReadingArgs, WalkingArgs},
    demo::DemoArgs,
    explain::explain,
    manual::{CompletionsArgs, ManArgs},
    map::MapArgs,
    moves::MovesArgs,
    query::QueryArgs,
    reach::{Directions, ReachArgs},
    run::{Format, RunArgs},
    setup::Asked,
    table::TableArgs,
    value::{Place, parse_pair, parse_place},
};

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
    Run(Box<RunArgs>),
    /// Measure the paths from many starts to many goals, or to the nearest of them.
    Table(Box<TableArgs>),
    /// Find all that is within reach of one or many places.
    Reach(ReachArgs),
    /// Say whether paths hold on a map, and where not.
    Check(CheckArgs),
    /// Write a map in another format.
    Convert(ConvertArgs),
    /// Prepare an engine's index of a map, and save it.
    Build(BuildArgs),
    /// Show the moves of N(k), its radius and its bounds.
    Moves(MovesArgs),
    /// List the engines: placements, k, guarantee, paper.
    Engines,
    /// Solve a query on a bundled map for many k, and draw the paths.
    Demo(DemoArgs),
    /// Print what a shell completes of this program's arguments.
    Completions(CompletionsArgs),
    /// Print the manual page of the program, or of a command, for man.
    Man(ManArgs),
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use mediant::{
        Engine,
        options::{ConfiguredEngine, Memory},
    };

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
        let engine = |kind: Engine| ConfiguredEngine::from(kind);
        assert_eq!(engine(Engine::Subgoal).levels(), None, "the map decides");
        for (kind, by) in [(Engine::SubgoalTheta, "2 levels for"), (Engine::Hpa, "3 for")] {
            let name = format!("{by} {kind}");
            let levels = engine(kind).levels().unwrap().to_string();
            assert!(help("levels").contains(&name) && by.starts_with(&levels), "{name}: {}", help("levels"));
        }
        let least = Memory::for_labels_of(1, 1).to_string();
        assert!(help("memory").contains(&format!("at least {least}")), "{}", help("memory"));
        for (kind, by) in [(Engine::Hpa, "10 by default for hpa"), (Engine::Chpa, "3 for chpa")] {
            assert!(
                by.contains(&engine(kind).side().unwrap().to_string()) && help("side").contains(by),
                "{by}"
            );
        }
        let chpa = engine(Engine::Chpa);
        for (option, value) in [("step", chpa.step()), ("detour", chpa.detour())] {
            assert!(help(option).contains(&format!("{} by default", value.unwrap())), "{}", help(option));
        }
    }
}
