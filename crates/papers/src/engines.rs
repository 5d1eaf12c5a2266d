//! Every engine of the workspace: its time against its suboptimality.

use std::collections::BTreeMap;

use mediant::Setup;
use mediant_bench::Study;
use mediant_report::{Axis, Chart, Column, Mark, Record, Row, Series, Table, number, thousands};
use mediant_search::Ends;

use super::{
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    maps::{Map, evenly},
    setups::{Sums, costs, run},
};
use crate::Error;

/// Every engine on every set.
pub(super) const ENGINES: Experiment = Experiment {
    id: "engines",
    page: Page::Beyond,
    title: "Every engine: time against suboptimality",
    sets: &["bg512", "dao", "sc1", "wc3maps512", "random", "room", "street"],
    measure,
    show,
};

/// Between corners, gap open: the reference, which finds shortest paths at any angle, and the setups that are
/// compared with it.
const CORNERS: (&str, &[&str]) = (
    "subgoal:any:open",
    &[
        "astar:2:open",
        "astar:3:open",
        "astar:4:open",
        "astar:5:open",
        "astar:7:open",
        "astar:3:open,smooth",
        "astar:4:open,smooth",
        "astar:5:open,smooth",
        "dijkstra:3:open",
        "wavefront:3:open",
        "canonical:3:open",
        "canonical:4:open",
        "canonical:5:open",
        "canonical:7:open",
        "jps:3:open",
        "jps:4:open",
        "jps:5:open",
        "jps-block:2:open",
        "jps-block:3:open",
        "jps-plus:2:open",
        "jps-plus:3:open",
        "theta:3:open",
        "theta:5:open",
        "lazy-theta:3:open",
        "anya:any:open",
        // Setups that differ in smoothing alone stand together, so that they share an index.
        "subgoal:3:open",
        "subgoal:3:open,taut",
        "subgoal:4:open",
        "subgoal:5:open",
        "subgoal:5:open,taut",
        "subgoal:9:open",
        "subgoal:any:open",
        "subgoal-theta:3:open",
    ],
);
/// Between centers, no corner cut: the reference, A* over N(7) with paths pulled taut, since no engine is
/// exact at any angle there; and the setups that are compared with it.
const CENTERS: (&str, &[&str]) = (
    "astar:7:never,taut",
    &[
        "astar:2:never",
        "astar:3:never",
        "astar:4:never",
        "astar:5:never",
        "astar:3:never,squared",
        "dijkstra:3:never",
        "wavefront:3:never",
        "canonical:3:never",
        "canonical:5:never",
        "jps:3:never",
        "jps:4:never",
        "jps-block:2:never",
        "jps-block:3:never",
        "jps-plus:2:never",
        "jps-plus:3:never",
        "theta:3:never",
        "lazy-theta:3:never",
        "subgoal:2:never",
        "subgoal:3:never",
        "hpa:2:never",
        "hpa:3:never",
        "hpa:2:never,unstraightened",
        "hpa:3:never,unstraightened",
        "chpa:2:never",
        "chpa:3:never",
    ],
);

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let (maps_of, queries_of) = context.quick_or((1, 4), (6, 6));
    let (mut rows, mut maps_in_all, mut instances) = (Vec::new(), 0, 0);
    for set in context.sets() {
        let all = context.maps(set, usize::MAX)?;
        // A full run is a sample too: every engine on every map of every set would take days.
        let maps = evenly(&all, maps_of);
        let measured = context.each(set, How::Timed, &maps, |map| on_map(context, map, queries_of))?;
        maps_in_all += maps.len();
        for (at, (placement, setup)) in setups().enumerate() {
            let mut sums = Sums::default();
            measured.iter().for_each(|map| sums.add(&map[at]));
            instances += if setup == "astar:3:open" || setup == "astar:3:never" { sums.queries } else { 0 };
            rows.push(sums.row(Row::new().key("set", set).key("placement", placement).key("setup", setup)));
        }
    }
    let mut columns = vec![
        Column::key("set", "the set of maps"),
        Column::key("placement", "where the vertices are"),
        Column::key("setup", "the engine with its options"),
    ];
    columns.extend(Sums::columns());
    let drawn = format!(
        "of each set {maps_of} maps, evenly, of each scenario {queries_of} instances, evenly, that have a \
         path both between corners and between centers"
    );
    Ok(Findings { columns, rows, maps: maps_in_all, instances: instances / 2, drawn, seeded: false })
}

fn setups() -> impl Iterator<Item = (&'static str, &'static str)> {
    let corners = CORNERS.1.iter().map(|setup| ("corners", *setup));
    corners.chain(CENTERS.1.iter().map(|setup| ("centers", *setup)))
}

fn on_map(context: &Context<'_>, map: &Map, count: usize) -> Result<Vec<Sums>, Error> {
    let grid = map.grid()?;
    let candidates = map.queries(1)?;
    let candidates: Vec<Ends> =
        candidates.iter().step_by((candidates.len() / (2 * count)).max(1)).copied().collect();
    let lengths = |reference: &str| -> Result<Vec<f64>, Error> {
        Ok(costs(&run(&mut Study::new(&grid, &candidates, 0), reference)?))
    };
    let (corners, centers) = (lengths(CORNERS.0)?, lengths(CENTERS.0)?);
    let solvable: Vec<usize> =
        (0..candidates.len()).filter(|&at| corners[at] > 0.0 && centers[at] > 0.0).collect();
    let picked: Vec<usize> =
        solvable.iter().step_by((solvable.len() / count).max(1)).copied().take(count).collect();
    let queries: Vec<Ends> = picked.iter().map(|&at| candidates[at]).collect();
    let mut study = Study::new(&grid, &queries, context.passes());
    setups()
        .map(|(placement, setup)| {
            let optima = if placement == "corners" { &corners } else { &centers };
            let optima: Vec<f64> = picked.iter().map(|&at| optima[at]).collect();
            Ok(Sums::of(&run(&mut study, setup)?, &optima))
        })
        .collect()
}

/// The series of a setup, which is its engine with all options but k; and its k.
fn series_of(setup: &str) -> (String, String) {
    let Ok(parsed) = setup.parse::<Setup>() else { return (setup.to_owned(), String::new()) };
    let options = setup.split_once(',').map_or(String::new(), |(_, options)| format!(", {options}"));
    let k = match parsed.k().to_string().as_str() {
        "any" => "∞".to_owned(),
        k => k.to_owned(),
    };
    (format!("{}{options}", parsed.engine.kind()), k)
}

fn chart(record: &Record, set: &str, placement: &str) -> Chart {
    let reference =
        if placement == "corners" { "the shortest at any angle" } else { "A* over N(7), pulled taut" };
    let keys = [("set", set), ("placement", placement)];
    let queries = record.select(&keys).next().and_then(|row| row.number("queries")).unwrap_or_default();
    let mut chart = Chart::new(
        format!("Every engine on {set}, between {placement}"),
        Axis::new("mean time of a query, µs").log(),
        Axis::new(format!("mean excess over {reference}, %")).log().range(1e-4, 100.0),
    )
    .note(format!("{} instances; points are labelled with k", thousands(queries)));
    let mut order: Vec<String> = Vec::new();
    let mut series: BTreeMap<String, Vec<(f64, f64, String)>> = BTreeMap::new();
    for row in record.select(&keys) {
        let (name, k) = series_of(row.text("setup"));
        let (Some(micros), Some(excess)) = (row.number("micros"), row.number("excess")) else { continue };
        if !series.contains_key(&name) {
            order.push(name.clone());
        }
        series.entry(name).or_default().push((micros, excess, k));
    }
    for name in order {
        let points = &series[&name];
        let mark = if points.len() > 1 { Mark::Line } else { Mark::Points };
        let at = points.iter().map(|(micros, excess, _)| (*micros, *excess));
        chart.push(Series::new(name, mark, at).labels(points.iter().map(|(.., k)| k.clone())));
    }
    chart
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "Between corners, the reference is the shortest path at any angle. Between centers no engine is \
         exact at any angle; the reference there is A* over N(7), pulled taut. Below and to the left is \
         better; a point at the lower border is exact, or as good as the reference.",
    );
    for set in record.distinct("set") {
        section.heading(set);
        for placement in ["corners", "centers"] {
            let timed = record.select(&[("set", set)]).any(|row| row.number("micros").is_some());
            if timed {
                let alternative =
                    format!("Time against suboptimality of every engine on {set}, between {placement}");
                section.figure(
                    &format!("engines-{set}-{placement}"),
                    &alternative,
                    chart(record, set, placement).svg(),
                );
            }
        }
    }
    section.heading("Over all sets");
    section.text("Means of the sets' means.");
    let mut table =
        Table::new(["setup", "vertices", "longer than the reference", "µs", "nodes", "prepared, ms", "KB"])
            .names(2);
    for (placement, setup) in setups() {
        let keys = [("placement", placement), ("setup", setup)];
        let mean = |column: &str| {
            let values: Vec<f64> = record.select(&keys).filter_map(|row| row.number(column)).collect();
            mediant_report::stats::mean(&values)
        };
        let cell = |value: Option<f64>| value.map_or("–".to_owned(), number);
        table.row([
            format!("`{setup}`"),
            placement.to_owned(),
            mean("excess").map_or("–".to_owned(), |excess| format!("{excess:.3} %")),
            cell(mean("micros")),
            cell(mean("expanded")),
            cell(mean("preparation").map(|seconds| 1e3 * seconds)),
            cell(mean("bytes").map(|bytes| bytes / 1e3)),
        ]);
    }
    section.table(&table);
    section
}

#[cfg(test)]
mod tests {
    use mediant::Engine;

    use super::*;

    #[test]
    fn every_engine_takes_part() {
        let parsed: Vec<Setup> = setups().map(|(_, setup)| setup.parse().unwrap()).collect();
        assert!(parsed.iter().all(|setup| setup.check().is_ok()));
        // Landmarks are for costs, and measured there: `cargo xtask compare --costs`.
        for engine in Engine::ALL.into_iter().filter(|&engine| engine != Engine::Landmarks) {
            assert!(parsed.iter().any(|setup| setup.engine.kind() == engine), "{engine}");
        }
        for ((placement, setup), parsed) in setups().zip(&parsed) {
            assert_eq!(placement, format!("{}s", parsed.rules().placement()), "{setup}");
        }
    }

    #[test]
    fn series_are_engines_with_options() {
        assert_eq!(series_of("subgoal:any:open,taut"), ("subgoal, taut".to_owned(), "∞".to_owned()));
        assert_eq!(series_of("astar:3:open"), ("astar".to_owned(), "3".to_owned()));
    }
}
