//! `mediant run`: answers queries on a map.

use std::io::{self, IsTerminal, Write};

use mediant::options::EngineOption;

use crate::{
    args::{Format, RunArgs},
    draw::query::{Drawing, check_name},
    failure::{Ending, Failure},
    map::{NamedMap, file_name},
    run::{
        answer::RunHead,
        csv::Csv,
        distances,
        jsonl::Jsonl,
        queries::Queries,
        report::{Report, without_path},
        searchers::{Searcher, Searchers},
        session::{Finished, Session},
        summary::Summary,
        table::TableReport,
        trace::TraceFile,
    },
    terminal::{numbers::count, progress::Progress, screen::Screen, text::printable},
    write::check_outputs,
};

/// Runs the command.
pub(crate) fn run(args: &RunArgs, screen: &mut Screen) -> Result<Ending, Failure> {
    let asked = args.asked()?;
    let reference = args.reference(asked.motion.rules)?;
    match &args.draw {
        Some(None) if args.format != Format::Table => return Err(Failure::DrawAmongLines),
        Some(Some(file)) => check_name(file)?,
        _ => {}
    }
    args.check_ends()?;
    let map = match args.grounds {
        true => load(args)?.with_own_costs()?.on_all_grounds(&args.map)?,
        false => with_costs(args, load(args)?.for_agent(&args.map, asked.motion)?)?,
    };
    let inputs = args.costs.inputs().chain(args.walking.inputs());
    check_outputs(&args.map.map, inputs, &args.outputs())?;
    let query = args.query.on(asked.call.wishes(), &map, asked.motion)?;
    if let (Some(path), Some(from)) = (&args.distances, query.from.first()) {
        let no_vertex = Failure::NoVertex { x: from.x(), y: from.y() };
        return distances::write(&asked, &map, from.vertex().ok_or(no_vertex)?, path, screen);
    }
    let queries = Queries::load(args, &query, &map, asked.motion)?;
    check_number(args, &queries)?;
    let mut searchers = Searchers::new(args, &asked, reference, &map, &queries)?;
    let trace = args.trace.as_deref().map(TraceFile);
    let Searcher { index, planner, choice, .. } = searchers.first();
    let setup = index.setup();
    let run = RunHead {
        map: &map,
        scenario: queries.scenario_name(),
        queries: queries.len(),
        edits: matches!(queries, Queries::Timeline { .. }).then(|| queries.edits().len()),
        query: &query,
        setup,
        choice: *choice,
        searched_by: index.searched_by(),
        options: EngineOption::ALL.map(|option| (option, index.value(option))).to_vec(),
        guarantee: planner.guarantee(),
        reference: args.reference,
        repeat: args.repeat.get(),
        grounds: args.grounds,
        preparation: searchers.preparation,
        memory_bytes: searchers.memory_bytes(),
    };
    // Lines on the screen show progress themselves, and a bar would break them.
    let lines_on_screen = args.format != Format::Table && io::stdout().is_terminal();
    let mut report = report(args.format, screen, lines_on_screen);
    let session = Session {
        queries: &queries,
        report: &mut *report,
        progress: Progress::new(queries.len(), !lines_on_screen),
        trace,
    };
    let finished = session.answer_all(&mut searchers, &run)?;
    drop(report);
    if let (Some(target), Some(item)) = (&args.draw, queries.iter().next()) {
        let Searcher { map, planner, .. } = searchers.of(item.ends.start);
        let drawing = Drawing { map, setup, query: query.between(item.ends) };
        match target {
            None => drawing.on_screen(&finished.path, screen)?,
            Some(path) => drawing.to_file(path, planner, &finished.path)?,
        }
        if let (Some(path), Format::Table) = (target, args.format) {
            writeln!(screen, "  drawn {}", printable(&file_name(path)))?;
        }
    }
    Ok(ending(&queries, finished, args.require_path))
}

/// A report in this format; `watched`: on a terminal.
fn report(format: Format, screen: &mut Screen, watched: bool) -> Box<dyn Report + '_> {
    match format {
        Format::Jsonl => Box::new(Jsonl::new(screen, watched)),
        Format::Csv => Box::new(Csv::new(screen)),
        Format::Table => Box::new(TableReport::new(screen)),
    }
}

/// The map with its costs, if it has any; refuses options that have no meaning then.
fn with_costs(args: &RunArgs, map: NamedMap) -> Result<NamedMap, Failure> {
    let map = map.with_numbers(&args.map, &args.costs, &args.walking)?;
    let edits = args.edits.as_ref().map(|_| "--edits");
    if let Some(option) = edits.or(args.query.exception()).filter(|_| map.walking.is_some()) {
        return Err(Failure::NotOverElevation { option });
    }
    map.refuse_on_costs("--reference", args.reference.is_some())?;
    Ok(map)
}

/// Checks that there is one query where only one can be shown.
fn check_number(args: &RunArgs, queries: &Queries) -> Result<(), Failure> {
    if queries.len() <= 1 {
        Ok(())
    } else if args.draw.is_some() {
        Err(Failure::DrawMany)
    } else if args.trace.is_some() {
        Err(Failure::TraceMany)
    } else {
        Ok(())
    }
}

/// The map, with its characters if they are to be drawn, or say which ground a cell is.
fn load(args: &RunArgs) -> Result<NamedMap, Failure> {
    let needs_tiles = args.grounds || matches!(args.draw, Some(None));
    let map = NamedMap::load_ground(&args.map, args.costs.reading)?;
    Ok(if needs_tiles { map } else { map.without_tiles() })
}

/// The ending after the last query, with its message and exit status.
fn ending(queries: &Queries, finished: Finished, requires_path: bool) -> Ending {
    let Summary { queries: all, found, .. } = finished.summary;
    match (finished.first_error, queries) {
        (None, _) if requires_path && found < all => Ending::NoPaths(without_path(all - found, all)),
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
