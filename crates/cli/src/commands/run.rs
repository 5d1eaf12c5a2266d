//! `mediant run`: answers queries on a map.

use std::{
    io::{self, IsTerminal, Write},
    time::Instant,
};

use mediant::{EngineOption, Index, Setup, Space};

use crate::{
    args::{Format, RunArgs},
    draw::query::{Drawing, check_name},
    failure::{Ending, Failure},
    map::{Map, file_name},
    run::{
        answer::Run,
        distances,
        jsonl::Jsonl,
        queries::Queries,
        report::Report,
        session::{Finished, Session},
        table::TableReport,
        trace::TraceFile,
    },
    terminal::{numbers::count, progress::Progress, screen::Screen, text::printable},
};

/// Runs the command.
pub(crate) fn run(args: &RunArgs, screen: &mut Screen) -> Result<Ending, Failure> {
    let setup = args.setup()?;
    let reference = args.reference(setup.rules)?;
    match &args.draw {
        Some(None) if args.format == Format::Jsonl => return Err(Failure::DrawJsonl),
        Some(Some(file)) => check_name(file)?,
        _ => {}
    }
    args.check_ends()?;
    if args.index.is_some() {
        setup.index_version()?;
    }
    let map = load(args)?.for_agent(&args.map, setup.motion())?;
    let wishes = args.wishes.on(&map, setup.rules.placement())?;
    if let (Some(path), Some(from)) = (&args.distances, wishes.from.first()) {
        return distances::write(setup, &map, *from, path, screen);
    }
    let queries = Queries::load(args, &wishes, &map)?;
    if args.draw.is_some() && queries.len() > 1 {
        return Err(Failure::DrawMany);
    }
    if args.trace.is_some() && queries.len() > 1 {
        return Err(Failure::TraceMany);
    }
    let begin = Instant::now();
    let (space, index) = prepare(args, setup, &map)?;
    let preparation = begin.elapsed();
    let trace = args.trace.as_deref().map(TraceFile::create).transpose()?;
    let mut planner = index.try_planner()?;
    let run = Run {
        map: &map,
        scenario: queries.scenario_name(),
        queries: queries.len(),
        wishes: &wishes,
        setup,
        searched_by: index.searched_by(),
        options: EngineOption::ALL.map(|option| (option, index.value(option))).to_vec(),
        guarantee: planner.guarantee(),
        reference: args.reference,
        repeat: args.repeat.get(),
        preparation,
        memory_bytes: space.memory_bytes() + index.memory_bytes(),
    };
    // Lines of JSON on the screen show progress themselves, and a bar would break them.
    let lines_on_screen = args.format == Format::Jsonl && io::stdout().is_terminal();
    let mut report: Box<dyn Report> = match args.format {
        Format::Jsonl => Box::new(Jsonl::new(screen, lines_on_screen)),
        Format::Table => Box::new(TableReport::new(screen)),
    };
    let session = Session {
        queries: &queries,
        any_angle: reference.map(|setup| setup.planner(&map.to_library())).transpose()?,
        report: &mut *report,
        progress: Progress::new(queries.len(), !lines_on_screen),
        trace,
    };
    let finished = session.answer_all(&mut planner, &run)?;
    drop(report);
    if let (Some(target), Some(item)) = (&args.draw, queries.iter().next()) {
        let drawing = Drawing { map: &map, setup, request: wishes.request(item.query) };
        match target {
            None => drawing.on_screen(&finished.path, screen)?,
            Some(path) => drawing.to_file(path, &mut planner, &finished.path)?,
        }
        if let (Some(path), Format::Table) = (target, args.format) {
            writeln!(screen, "  drawn {}", printable(&file_name(path)))?;
        }
    }
    Ok(ending(&queries, finished))
}

/// The map, with its characters if they are to be drawn.
fn load(args: &RunArgs) -> Result<Map, Failure> {
    if matches!(args.draw, Some(None)) { Map::load_with_tiles(&args.map) } else { Map::load(&args.map) }
}

/// The space of a map, and the index: a new one, or that of the file that the arguments name.
fn prepare(args: &RunArgs, setup: Setup, map: &Map) -> Result<(Space, Index), Failure> {
    let space = setup.space(&map.to_library())?;
    let index = match &args.index {
        None => space.prepare(setup.engine)?,
        Some(path) => space.load_for(setup.engine, path)?,
    };
    Ok((space, index.with_smoothing(setup.smoothing)))
}

/// What the program says and returns after the last query.
fn ending(queries: &Queries, finished: Finished) -> Ending {
    match (finished.first_error, queries) {
        (None, _) => Ending::Answered,
        (Some((_, error)), Queries::Single(_)) => Ending::QueryErrors(error),
        (Some((index, error)), _) => {
            let errors = count(finished.summary.errors, "query", "queries");
            let all = finished.summary.queries;
            Ending::QueryErrors(format!(
                "{errors} of {all} cannot be answered; the first, index {index}: {error}"
            ))
        }
    }
}
