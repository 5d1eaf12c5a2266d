//! `mediant build`: prepares an engine's index of a map, and saves it.

use std::{io::Write, time::Instant};

use mediant::{Index, SharedRules, Space};

use crate::{
    args::BuildArgs,
    failure::Failure,
    index_file,
    map::{Map, file_name},
    terminal::{
        numbers::{grouped, time},
        progress::BuildProgress,
        screen::{BOLD, Screen},
        text::printable,
    },
};

/// Runs the command.
pub(crate) fn build(args: &BuildArgs, screen: &mut Screen) -> Result<(), Failure> {
    let setup = args.setup()?;
    // A setup without an index is refused before anything is computed.
    setup.index_version()?;
    let map = Map::load(&args.map)?;
    let progress = BuildProgress::new();
    let begin = Instant::now();
    let built = Space::new(setup, &map.grid).and_then(|space| {
        Index::with_progress(setup, &space, &SharedRules::new(), &|step| progress.tell(step))?.to_bytes()
    });
    let took = begin.elapsed();
    progress.clear();
    let bytes = built?;
    let size = grouped(bytes.len() as u64);
    index_file::save(&args.output, setup, &map.grid, bytes)?;
    let name = file_name(&args.output);
    let name = screen.paint(BOLD, printable(&name)).to_string();
    let took = time(took.as_nanos() as f64);
    writeln!(
        screen,
        "{name} · {} of {} · {size} bytes · built in {took}",
        setup.engine.kind(),
        printable(&map.name)
    )?;
    Ok(())
}
