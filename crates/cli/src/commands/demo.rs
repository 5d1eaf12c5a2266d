//! `mediant demo`: a query on a bundled map for many k, as a table and a picture.

use std::io::{self, Write};

use anstyle::RgbColor;
use mediant::{Answer, Ends, Engine, FiniteK, K, Motion, PlacementKind, Rules, Setup, Vertex, files::Tiles};

use crate::{
    args::DemoArgs,
    builtin::Builtin,
    draw::{
        braille::Stroke,
        picture::{Canvas, GOAL_MARK, START_MARK},
        theme::INKS,
    },
    failure::Failure,
    map::NamedMap,
    run::measure::Measured,
    terminal::{
        numbers::{grouped, percent_over, time},
        screen::{BOLD, DIM, Screen},
        table::{Align, TextTable},
        text::wrap,
    },
};

/// The finite k of the table's rows at corners.
const KS: [u32; 8] = [2, 3, 4, 5, 6, 7, 9, 12];
/// The number of times that each query is timed; the best time counts.
const REPEAT: u32 = 20;

/// A line of the table.
struct Row {
    rules: Rules,
    k: K,
    /// At most this many times as long as the shortest any-angle path on any map; `None` where no such bound
    /// is known.
    bound: Option<f64>,
    cost: f64,
    waypoints: Vec<Vertex>,
    expanded: u64,
    nanos: u64,
}

/// Solves the demo's query in one setup; `None` if there is no path.
fn solve(setup: Setup, map: &NamedMap, query: Ends) -> Result<Option<Row>, Failure> {
    let (k, rules) = (setup.k(), setup.rules());
    let mut planner = setup.planner(&map.to_library())?;
    // The table compares with any-angle paths between corners; no bound to these is known for paths between
    // centers.
    let at_corners = rules.placement() == PlacementKind::Corner;
    let bound = planner.guarantee().bound(rules).filter(|_| at_corners);
    let Measured { answer, counters, nanos } = Measured::new(&mut planner, || query.into(), REPEAT);
    let Ok(Answer::Found(path)) = answer else { return Ok(None) };
    let (cost, expanded) = (path.cost(), counters.expanded);
    Ok(Some(Row { rules, k, bound, cost, waypoints: path.into_waypoints(), expanded, nanos }))
}

/// Runs the command.
pub(crate) fn demo(args: &DemoArgs, screen: &mut Screen) -> Result<(), Failure> {
    let builtin = Builtin::of_name(&args.name)?;
    let map = NamedMap::bundled(builtin, Tiles::default())?;
    let query = Ends::new(builtin.start, builtin.goal);
    let mut setups = Vec::new();
    for k in KS {
        setups.push(Setup::new(Engine::AStar, Motion::corners(FiniteK::new(k)?)));
    }
    setups.push(Setup::new(Engine::Anya, Motion::corners(K::Any)));
    setups.push(Setup::new(Engine::AStar, Motion::centers(FiniteK::N8)));
    let mut rows = Vec::new();
    for setup in setups {
        rows.extend(solve(setup, &map, query)?);
    }
    title(builtin, &map, query, screen)?;
    picture(&map, query, &rows, screen)?;
    table(&map, &rows, screen)?;
    Ok(explanation(builtin, screen)?)
}

/// Writes the map's name and size, and the query.
fn title(builtin: &Builtin, map: &NamedMap, query: Ends, screen: &mut Screen) -> io::Result<()> {
    let name = screen.paint(BOLD, builtin.name);
    let (width, height) = (map.grid.width(), map.grid.height());
    let Ends { start, goal, .. } = query;
    writeln!(screen, "\n  {name} · {width} × {height} · {}, {start} to {goal}\n", builtin.caption)
}

/// The stroke and the color of a row's path on the map; `None` if it is not drawn.
fn stroke(row: &Row) -> Option<(Stroke, RgbColor)> {
    match (row.rules.placement(), row.k) {
        (PlacementKind::Corner, K::Finite(FiniteK::N4)) => Some((Stroke::Dotted, INKS.four)),
        (PlacementKind::Corner, K::Finite(FiniteK::N8)) => Some((Stroke::Dashed, INKS.eight)),
        (PlacementKind::Corner, K::Any) => Some((Stroke::Solid, INKS.best)),
        _ => None,
    }
}

/// A k, with the sign for ∞.
fn k_sign(k: K) -> String {
    k.finite().map_or_else(|| "∞".to_owned(), |k| k.to_string())
}

/// Draws the map with some of the paths, and says which is which.
fn picture(map: &NamedMap, query: Ends, rows: &[Row], screen: &mut Screen) -> io::Result<()> {
    let mut canvas = Canvas::fit(&map.tiles(), map.theme, PlacementKind::Corner, screen);
    for row in rows {
        if let Some((stroke, ink)) = stroke(row) {
            canvas.path(&row.waypoints, stroke, ink);
        }
    }
    canvas.ends(&[query.start.into()], &[query.goal.into()]);
    canvas.write(screen)?;
    let ground = map.theme.ground();
    let mut legend = String::new();
    for (mark, color, name) in [(START_MARK, INKS.start, "start"), (GOAL_MARK, INKS.goal, "goal")] {
        legend += &format!("{} {name}   ", screen.paint(screen.ink_on(color, ground), format!(" {mark} ")));
    }
    for row in rows {
        if let Some((stroke, color)) = stroke(row) {
            let line = screen.paint(screen.ink_on(color, ground), stroke.sample().repeat(2));
            legend += &format!("{line} k = {}   ", k_sign(row.k));
        }
    }
    writeln!(screen, "\n  {}\n", legend.trim_end())
}

/// Writes the table, a row for each setup.
fn table(map: &NamedMap, rows: &[Row], screen: &mut Screen) -> io::Result<()> {
    let best = rows.iter().filter(|row| row.rules.placement() == PlacementKind::Corner).map(|row| row.cost);
    let best = best.fold(f64::INFINITY, f64::min);
    let names = ["k", "at", "moves", "cost", "over best", "bound", "turns", "expanded", "time"];
    let mut table =
        TextTable::new(names.map(|name| (name, if name == "at" { Align::Left } else { Align::Right })));
    for row in rows {
        let placement = row.rules.placement();
        let cells = [
            // Wider than any k, so that there is a gap after the sample of the stroke.
            format!("{:>3}", k_sign(row.k)),
            format!("{placement}s"),
            row.k.finite().and_then(FiniteK::moves).map_or_else(|| "∞".to_owned(), grouped),
            format!("{:.4}", row.cost),
            percent_over(row.cost / best, 2),
            row.bound.map_or_else(|| "–".to_owned(), |bound| percent_over(bound, 2)),
            row.waypoints.len().saturating_sub(2).to_string(),
            grouped(row.expanded),
            time(row.nanos as f64),
        ];
        match stroke(row) {
            None => table.row(cells),
            Some((stroke, color)) => {
                let sample = screen.paint(screen.ink_on(color, map.theme.ground()), stroke.sample());
                table.row_with(sample.to_string(), BOLD, cells);
            }
        }
    }
    table.write(screen)
}

/// Says how to read the table, and what to try next.
fn explanation(builtin: &Builtin, screen: &mut Screen) -> io::Result<()> {
    let words = "Each path is the shortest that its moves allow. k = 2 moves along the axes, k = 3 adds the \
                 diagonals, each further k adds a move between every two, and k = ∞ allows every direction. \
                 `bound` says how much longer than an any-angle path the shortest path of that k can be, \
                 whatever the map.";
    let text = wrap("  ", words.split(' ').map(str::to_owned), screen.columns().min(80) - 2);
    writeln!(screen, "\n{text}")?;
    let Builtin { name, start, goal, .. } = builtin;
    let (from, to) = (format!("{},{}", start.x, start.y), format!("{},{}", goal.x, goal.y));
    let next = [
        format!("mediant demo {}", builtin.next()),
        format!("mediant run builtin:{name} --from {from} --to {to} --k 4 --draw"),
        "mediant moves --k 5".to_owned(),
    ];
    for (command, lead) in next.into_iter().zip(["Next:", "", ""]) {
        writeln!(screen, "  {}", screen.paint(DIM, format!("{lead:<6} {command}")))?;
    }
    Ok(())
}
