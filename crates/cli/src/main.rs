//! `mediant`: pathfinding on the 2^k neighborhoods of a grid, from the command line.
//!
//! The program is thin: it turns arguments into a [`Setup`](mediant::Setup) of the catalog, runs the
//! queries on the planner of that setup, and reports the answers. Scripts rely on the objects of `--format
//! jsonl` (`run/jsonl.rs`) and on the exit status (`failure.rs`).

use std::{io::Write, process::ExitCode};

use clap::Parser;

use crate::{
    args::{Cli, Command},
    failure::{Ending, finish},
    terminal::screen::Screen,
};

mod args;
mod builtin;
mod check;
mod commands;
mod draw;
mod edit;
mod failure;
mod map;
mod run;
mod terminal;
mod write;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return args::explain(&error),
    };
    let mut screen = Screen::stdout();
    let ending = match cli.command {
        Command::Run(args) => commands::run::run(&args, &mut screen),
        Command::Table(args) => commands::table::table(&args, &mut screen),
        Command::Reach(args) => commands::reach::reach(&args, &mut screen),
        Command::Check(args) => commands::check::check(&args, &mut screen),
        Command::Convert(args) => commands::convert::convert(&args, &mut screen).map(|()| Ending::Answered),
        Command::Build(args) => commands::build::build(&args, &mut screen).map(|()| Ending::Answered),
        Command::Demo(args) => commands::demo::demo(&args, &mut screen).map(|()| Ending::Answered),
        Command::Completions(args) => {
            commands::manual::completions(&args, &mut screen).map(|()| Ending::Answered)
        }
        Command::Man(args) => commands::manual::man(&args, &mut screen).map(|()| Ending::Answered),
        Command::Engines => commands::engines::list(&mut screen).map(|()| Ending::Answered),
        Command::Moves(args) => commands::moves::moves(&args, &mut screen).map(|()| Ending::Answered),
    };
    // Output printed before a failure is shown before it.
    let flushed = screen.flush();
    finish(ending.and_then(|ending| flushed.map(|()| ending).map_err(Into::into)))
}
