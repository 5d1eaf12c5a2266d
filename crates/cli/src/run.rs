//! `mediant run`: queries on a map.

use std::{
    fs::File,
    io::{self, BufWriter, IsTerminal, Write},
    num::NonZeroU32,
    time::{Duration, Instant},
};

use mediant_engines::{Engine, Prebuilt, Setup, Solver, with_planner};
use mediant_grid::{CornerRule, DiagonalGap, Rules};
use mediant_search::Smoothing;

use crate::{
    args::{Format, RunArgs},
    braille::Stroke,
    build, distances,
    failure::{Ending, Failure},
    map::Map,
    picture::Canvas,
    progress::Progress,
    queries::Queries,
    record::RunRecord,
    report::{Jsonl, Report, TableReport},
    screen::Screen,
    session::{Finished, Session, TraceFile},
    text::count,
    theme::INKS,
};

/// Runs the command.
pub(crate) fn run(args: &RunArgs, screen: &mut Screen) -> Result<Ending, Failure> {
    let setup = args.setup()?;
    let reference = args.reference(setup.rules)?;
    if args.draw && args.format == Format::Jsonl {
        return Err(Failure::DrawJsonl);
    }
    if args.index.is_some() {
        setup.index_version()?;
    }
    let map = Map::load(&args.map)?;
    if let (Some(path), Some(from)) = (&args.distances, args.from) {
        return distances::write(setup, &map, from, path, screen);
    }
    let queries = Queries::load(args, &map)?;
    if args.draw && queries.len() > 1 {
        return Err(Failure::DrawMany);
    }
    if args.trace.is_some() && queries.len() > 1 {
        return Err(Failure::TraceMany);
    }
    let (prebuilt, load_time) = load_index(args, setup, &map)?;
    let trace = args.trace.as_deref().map(|path| {
        let file = File::create(path).map_err(Failure::writing(path))?;
        Ok::<_, Failure>(TraceFile { path, out: BufWriter::new(file) })
    });
    // Lines of JSON on the screen are progress enough, and a bar would break them.
    let lines_on_screen = args.format == Format::Jsonl && io::stdout().is_terminal();
    let mut report: Box<dyn Report> = match args.format {
        Format::Jsonl => Box::new(Jsonl::new(screen, lines_on_screen)),
        Format::Table => Box::new(TableReport::new(screen)),
    };
    let session = Session {
        queries: &queries,
        grid: &map.grid,
        rules: setup.rules,
        any_angle: reference.map(|setup| Solver::new(setup, &map.grid, Prebuilt::default())).transpose()?,
        run: describe(args, setup, &map, &queries),
        report: &mut *report,
        progress: Progress::new(queries.len(), !lines_on_screen),
        load_time,
        trace: trace.transpose()?,
    };
    let finished = with_planner(setup, &map.grid, prebuilt, session)??;
    drop(report);
    if args.draw {
        draw(setup, &map, &queries, &finished, screen)?;
    }
    Ok(ending(&queries, finished))
}

/// The saved index, if one is named, and what reading it took.
fn load_index(args: &RunArgs, setup: Setup, map: &Map) -> Result<(Prebuilt, Duration), Failure> {
    let begin = Instant::now();
    let index = args.index.as_deref().map(|path| build::load(path, setup, &map.grid)).transpose()?;
    let time = if index.is_some() { begin.elapsed() } else { Duration::ZERO };
    Ok((Prebuilt { index, ..Prebuilt::default() }, time))
}

/// All that is known of the run before its planner is made.
fn describe(args: &RunArgs, setup: Setup, map: &Map, queries: &Queries) -> RunRecord {
    // The rule of the other placement is reported by its default.
    let (corners, gap) = match setup.rules {
        Rules::Center(corners) => (corners, DiagonalGap::default()),
        Rules::Corner(gap) => (CornerRule::default(), gap),
    };
    RunRecord {
        map: map.name.clone(),
        width: map.grid.width(),
        height: map.grid.height(),
        free_cells: map.grid.free_cells(),
        scenario: queries.scenario_name().map(str::to_owned),
        queries: queries.len(),
        engine: setup.engine.to_string(),
        k: setup.k,
        placement: setup.rules.placement().to_string(),
        corners: corners.to_string(),
        gap: gap.to_string(),
        heuristic: setup.heuristic().map(|heuristic| heuristic.to_string()),
        second: setup.second().map(|heuristic| heuristic.to_string()),
        variant: setup.variant().map(|variant| variant.to_string()),
        jump_limit: setup.options.jump_limit.map(NonZeroU32::get),
        keep_intermediate: setup.options.intermediate,
        levels: None,
        side: None,
        refined: setup.options.refined,
        step: setup.step().map(NonZeroU32::get),
        detour: setup.detour().map(NonZeroU32::get),
        smooth: setup.options.smoothing.is_some(),
        smoothing: setup.options.smoothing.map(smoothing_name),
        any_angle: args.reference.map(Engine::name),
        guarantee: String::new(),
        repeat: args.repeat.get(),
        preprocess_ns: 0,
        index_bytes: 0,
        version: env!("CARGO_PKG_VERSION"),
    }
}

const fn smoothing_name(smoothing: Smoothing) -> &'static str {
    match smoothing {
        Smoothing::Linear => "linear",
        Smoothing::Taut => "taut",
    }
}

/// The picture of a single query.
fn draw(
    setup: Setup,
    map: &Map,
    queries: &Queries,
    finished: &Finished,
    screen: &mut Screen,
) -> io::Result<()> {
    let Some(item) = queries.iter().next() else { return Ok(()) };
    let mut canvas = Canvas::fit(map, setup.rules.placement(), screen);
    canvas.path(&finished.path, Stroke::Solid, INKS.best);
    canvas.ends(item.query);
    writeln!(screen)?;
    canvas.write(screen)
}

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
