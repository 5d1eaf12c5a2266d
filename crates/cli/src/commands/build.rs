//! `mediant build`: prepares an engine's index of a map, and saves it.

use std::{fs, io::Write, time::Instant};

use mediant::Demand;

use crate::{
    args::{Asked, BuildArgs},
    failure::Failure,
    map::{NamedMap, file_name},
    run::report::{by_auto, falls_back},
    terminal::{
        numbers::{grouped, time},
        progress::BuildProgress,
        screen::{BOLD, Screen},
        text::printable,
    },
    write::check_outputs,
};

/// Runs the command.
pub(crate) fn build(args: &BuildArgs, screen: &mut Screen) -> Result<(), Failure> {
    // A setup without an index is refused before anything is computed.
    let asked = Asked::of(&args.flags.0, true)?;
    let map = NamedMap::load_ground(&args.map, args.costs.reading)?
        .without_tiles()
        .for_agent(&args.map, asked.motion)?
        .with_costs(&args.map, &args.costs)?;
    check_outputs(&args.map.map, args.costs.inputs(), &[&args.output])?;
    let progress = BuildProgress::new();
    let begin = Instant::now();
    let space = map.space(asked.motion)?;
    let (setup, choice) = space.setup(&asked.call, Demand::Index)?;
    let built = space.prepare_with_progress(setup.engine, &|step| progress.tell(step));
    let took = begin.elapsed();
    progress.clear();
    let built = built?;
    built.save(&args.output)?;
    let size = grouped(fs::metadata(&args.output)?.len());
    let name = file_name(&args.output);
    let name = screen.paint(BOLD, printable(&name)).to_string();
    let took = time(took.as_nanos() as f64);
    writeln!(
        screen,
        "{name} · {} of {} · {size} bytes · built in {took}",
        setup.engine.kind(),
        printable(&map.name)
    )?;
    if let Some(choice) = choice {
        writeln!(screen, "{}", by_auto(choice))?;
    }
    if built.searched_by() != setup.engine.kind() {
        writeln!(screen, "{}", falls_back(setup.engine.kind(), built.searched_by()))?;
    }
    Ok(())
}
