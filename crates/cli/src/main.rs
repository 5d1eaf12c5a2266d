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
    screen::Screen,
};

mod args;
mod braille;
mod build;
mod demo;
mod distances;
mod engines;
mod failure;
mod map;
mod moves;
mod picture;
mod progress;
mod queries;
mod record;
mod report;
mod run;
mod screen;
mod session;
mod star;
mod summary;
mod text;
mod theme;
mod trace;

fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => return args::explain(&error),
    };
    let mut screen = Screen::stdout();
    let ending = match cli.command {
        Command::Run(args) => run::run(&args, &mut screen),
        Command::Build(args) => build::build(&args, &mut screen).map(|()| Ending::Answered),
        Command::Demo(args) => demo::demo(&args, &mut screen).map(|()| Ending::Answered),
        Command::Engines => engines::list(&mut screen).map(|()| Ending::Answered),
        Command::Moves(args) => moves::moves(&args, &mut screen).map(|()| Ending::Answered),
    };
    // What was printed before a failure is shown before the failure is.
    let flushed = screen.flush();
    finish(ending.and_then(|ending| flushed.map(|()| ending).map_err(Into::into)))
}
