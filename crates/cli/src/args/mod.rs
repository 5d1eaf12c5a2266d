//! The command line: the arguments of each command.

mod build;
mod check;
mod convert;
mod demo;
mod explain;
mod map;
mod motion;
mod moves;
mod options;
mod reach;
mod run;
mod setup;
mod value;
mod wishes;

use clap::{Parser, Subcommand};

pub(crate) use self::{
    build::BuildArgs,
    check::CheckArgs,
    convert::ConvertArgs,
    demo::DemoArgs,
    explain::explain,
    map::MapArgs,
    moves::MovesArgs,
    reach::ReachArgs,
    run::{Format, RunArgs},
    value::{MAX_K, Place},
    wishes::WishArgs,
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
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;
    use mediant::{ConfiguredEngine, Engine};

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
        for kind in [Engine::Subgoal, Engine::SubgoalTheta, Engine::Hpa] {
            let name = engine(kind).levels().unwrap().in_words().replacen("a c", "A c", 1);
            let by = if kind == Engine::Subgoal { "by default".to_owned() } else { format!("for {kind}") };
            let name = format!("{name} {by}");
            assert!(help("levels").contains(&name), "{name}: {}", help("levels"));
        }
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
