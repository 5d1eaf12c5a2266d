//! `mediant`: pathfinding on the 2^k neighborhoods of a grid, from the command line.
//!
//! A thin program: it turns arguments into types (a [`Setup`](mediant_engines::Setup) of a closed catalog), runs the queries on a
//! planner that is compiled for just those types, and reports. What scripts rely on (the objects of `--format jsonl`, the
//! exit status) is in [`record`] and [`failure`].

use std::{io::Write, process::ExitCode};

use clap::Parser;

use crate::{
    args::{Cli, Command},
    failure::{Ending, finish},
    terminal::screen::Screen,
};

mod args;
mod commands;
mod draw;
mod failure;
mod map;
mod run;
mod terminal;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return args::explain(&error),
    };
    let mut screen = Screen::stdout();
    let ending = match cli.command {
        Command::Run(args) => commands::run::run(&args, &mut screen),
        Command::Build(args) => commands::build::build(&args, &mut screen).map(|()| Ending::Answered),
        Command::Demo(args) => commands::demo::demo(&args, &mut screen).map(|()| Ending::Answered),
        Command::Engines => commands::engines::list(&mut screen).map(|()| Ending::Answered),
        Command::Moves(args) => commands::moves::moves(&args, &mut screen).map(|()| Ending::Answered),
    };
    // What was printed before a failure is shown before the failure is.
    let flushed = screen.flush();
    finish(ending.and_then(|ending| flushed.map(|()| ending).map_err(Into::into)))
}
