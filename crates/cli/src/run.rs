//! `mediant run`: queries on a map.

use std::io::{self, IsTerminal, Write};

use mediant_grid::{CornerRule, DiagonalGap, Rules};

use crate::{
    args::{Format, RunArgs},
    braille::Stroke,
    engines::{Setup, with_planner},
    failure::{Ending, Failure},
    map::Map,
    picture::Canvas,
    progress::Progress,
    queries::Queries,
    record::RunRecord,
    report::{Jsonl, Report, TableReport},
    screen::Screen,
    session::{Finished, Session},
    text::count,
    theme::INKS,
};

/// Runs the command.
pub(crate) fn run(args: &RunArgs, screen: &mut Screen) -> Result<Ending, Failure> {
    let setup = Setup::new(args)?;
    if args.draw && args.format == Format::Jsonl {
        return Err(Failure::DrawJsonl);
    }
    let map = Map::load(&args.map)?;
    let queries = Queries::load(args, &map)?;
    if args.draw && queries.len() > 1 {
        return Err(Failure::DrawMany);
    }
    // Lines of JSON on the screen are progress enough, and a bar would break them.
    let lines_on_screen = args.format == Format::Jsonl && io::stdout().is_terminal();
    let mut report: Box<dyn Report> = match args.format {
        Format::Jsonl => Box::new(Jsonl::new(screen, lines_on_screen)),
        Format::Table => Box::new(TableReport::new(screen)),
    };
    let session = Session {
        queries: &queries,
        grid: &map.grid,
        placement: setup.rules.placement(),
        run: describe(args, setup, &map, &queries),
        report: &mut *report,
        progress: Progress::new(queries.len(), !lines_on_screen),
    };
    let finished = with_planner(setup, map.grid.clone(), session)??;
    drop(report);
    if args.draw {
        draw(setup, &map, &queries, &finished, screen)?;
    }
    Ok(ending(&queries, finished))
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
        k: setup.k.get(),
        placement: setup.rules.placement().to_string(),
        corners: corners.to_string(),
        gap: gap.to_string(),
        heuristic: setup.heuristic.to_string(),
        smooth: false,
        guarantee: String::new(),
        repeat: args.repeat.get(),
        preprocess_ns: 0,
        index_bytes: 0,
        version: env!("CARGO_PKG_VERSION"),
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
