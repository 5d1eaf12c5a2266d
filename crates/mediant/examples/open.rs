//! Reads a map from a file, and finds a path across it: `cargo run -p mediant --example open -- FILE`, where
//! the file is a MovingAI map, a PNG, PGM or PBM picture, or the YAML file of a ROS map.
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "an example shows what it finds")]

use std::{env, process::ExitCode};

use mediant::{Error, Map, Motion};

fn main() -> ExitCode {
    let Some(file) = env::args().nth(1) else {
        eprintln!("usage: open FILE");
        return ExitCode::FAILURE;
    };
    match across(&file) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // The text says what to do; programs go by the code.
            eprintln!("{error} ({})", error.code());
            ExitCode::FAILURE
        }
    }
}

fn across(file: &str) -> Result<(), Error> {
    let map = Map::open(file)?;
    println!("{} × {} cells", map.width(), map.height());
    let corner = (map.width().cast_signed() - 1, map.height().cast_signed() - 1);
    let space = map.space(Motion::default())?;
    // Where the ends are blocked, the nearest free cells.
    let query = mediant::Query::new((0, 0), corner).snap();
    let mut planner = space.planner(space.engine())?;
    match planner.find(query)?.path() {
        Some(path) => println!("{:.2} cells: {path}", path.cost()),
        None => println!("no way leads across"),
    }
    Ok(())
}
