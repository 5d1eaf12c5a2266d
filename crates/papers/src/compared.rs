//! Our engines beside other programs: what `cargo xtask compare` measures, as a page.

use mediant::{Engine, Setup};
use mediant_bench::{Comparison, Competitor, Kept, MapRecord, ReferenceProgram, ReferenceTimings, Timing};
use mediant_report::{Axis, Chart, Mark, Record, Row, Series, Table, number, stats, thousands};

use super::{
    context::Context,
    experiment::{Experiment, Findings, Page, Section},
    setups::setup,
    side_by_side::{SETS, findings},
};
use crate::Error;

/// Our engines beside the programs of `benchdata/reference_timings.json`.
pub(super) const PROGRAMS: Experiment = Experiment {
    id: "compared-programs",
    page: Page::Compared,
    title: "Every engine, and programs that were timed on another machine",
    sets: SETS,
    measure,
    show,
};

const SETUPS: [&str; 18] = [
    "astar:3:never",
    "canonical:3:never",
    "jps:3:never",
    "jps-block:3:never",
    "jps-plus:3:never",
    "subgoal:3:never",
    "subgoal:3:never,levels=contracted",
    "hpa:3:never",
    "chpa:3:never",
    "anya:any:closed",
    "anya:any:open",
    "subgoal:any:closed",
    "subgoal:any:closed,levels=contracted",
    "subgoal:any:open",
    "subgoal:any:open,levels=contracted",
    "theta:3:open",
    "lazy-theta:3:open",
    "subgoal-theta:3:open",
];
/// The setups that are also asked for the length of the path alone.
const DISTANCES: [&str; 3] = ["subgoal:3:never", "subgoal:any:closed", "subgoal:any:open"];
/// The option that has a contraction made.
const CONTRACTED: &str = ",levels=contracted";

fn measure(context: &Context<'_>) -> Result<Findings, Error> {
    let ours = SETUPS.iter().map(|text| Ok(Competitor::Ours(setup(text)?)));
    let distances = DISTANCES.iter().map(|text| Ok(Competitor::Distance(setup(text)?)));
    findings(context, ours.chain(distances).collect::<Result<_, Error>>()?)
}

/// The name of a setup in tables: a subgoal engine's says which index it may keep.
fn called(setup: &str) -> String {
    let is_subgoal =
        |setup: &str| setup.parse::<Setup>().is_ok_and(|parsed| parsed.engine.kind() == Engine::Subgoal);
    match (setup.strip_prefix("distance of "), setup.strip_suffix(CONTRACTED)) {
        (Some(setup), _) => format!("{}, distance alone", called(setup)),
        (None, Some(base)) => format!("`{base}`, contraction"),
        (None, None) if is_subgoal(setup) => format!("`{setup}`, hub labels"),
        (None, None) => format!("`{setup}`"),
    }
}

/// The maps on which a setup of hub labels keeps none.
fn exceptions(record: &Record) -> String {
    let mut all = Vec::new();
    for setup in SETUPS {
        let competitor = canonical(setup);
        for row in record.select(&[("competitor", &competitor)]) {
            let (map, kept) = (row.text("map"), row.text("kept"));
            if kept == Kept::Nothing.name() {
                all.push(format!("on {map} {}, is another engine, which prepares little", called(setup)));
            } else if kept == Kept::Contraction.name() && !setup.ends_with(CONTRACTED) {
                all.push(format!("on {map} {}, is a contraction", called(setup)));
            }
        }
    }
    all.join("; ")
}

/// The comparisons of a record, as `compare` makes them: by map, by setup.
fn comparisons(record: &Record, references: &ReferenceTimings) -> Vec<(String, Vec<Option<Comparison>>)> {
    let timing = |row: &Row| Timing {
        competitor: row.text("competitor").to_owned(),
        micros: row.number("micros").unwrap_or(f64::NAN),
        passes: Vec::new(),
        mean_cost: row.number("cost").unwrap_or(f64::NAN),
        preparation: None,
    };
    let on_map = |map: &&str| {
        let timings: Vec<Timing> = record.select(&[("map", map)]).map(timing).collect();
        let record = MapRecord { map: (*map).to_owned(), set: String::new(), instances: 0, timings };
        let compare = |setup: &&str| {
            let timing = record.timings.iter().find(|timing| timing.competitor == canonical(setup))?;
            Comparison::new(references, &record, timing)
        };
        ((*map).to_owned(), SETUPS.iter().map(compare).collect())
    };
    record.distinct("map").iter().map(on_map).collect()
}

/// The full text of a setup.
fn canonical(text: &str) -> String {
    text.parse::<Setup>().map_or_else(|_| text.to_owned(), |setup| setup.to_string())
}

/// A setup, a program, and the geometric mean of our time over that of the program.
type Mean = (&'static str, String, f64);

/// Each setup beside each program that solves the same problem, and has not run beside ours since.
fn means(record: &Record, references: &ReferenceTimings) -> (Table, Vec<Mean>) {
    let compared = comparisons(record, references);
    let mut table =
        Table::new(["ours", "program", "geometric mean", "best map", "worst map", "maps"]).names(2);
    let mut means: Vec<Mean> = Vec::new();
    for (at, text) in SETUPS.iter().enumerate() {
        let Ok(parsed) = text.parse::<Setup>() else { continue };
        let is_shown = |program: &ReferenceProgram| program.solves(parsed) && !program.has_run_beside;
        for (which, program) in
            references.programs.iter().enumerate().filter(|(_, program)| is_shown(program))
        {
            let ratio = |(map, all): &(String, Vec<Option<Comparison>>)| {
                let ratio = all[at].as_ref()?.ratios.get(which).copied().flatten()?;
                ratio.is_finite().then(|| (map.clone(), ratio))
            };
            let mut ratios: Vec<(String, f64)> = compared.iter().filter_map(ratio).collect();
            ratios.sort_by(|a, b| a.1.total_cmp(&b.1));
            let values: Vec<f64> = ratios.iter().map(|ratio| ratio.1).collect();
            let (Some(mean), Some(best), Some(worst)) =
                (stats::geometric_mean(&values), ratios.first(), ratios.last())
            else {
                continue;
            };
            let extreme = |(map, ratio): &(String, f64)| format!("{} ({map})", number(*ratio));
            table.row([
                called(text),
                program.name.clone(),
                number(mean),
                extreme(best),
                extreme(worst),
                values.len().to_string(),
            ]);
            means.push((text, program.name.clone(), mean));
        }
    }
    (table, means)
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    let Ok(references) = ReferenceTimings::bundled() else { return section };
    section.text(
        "The fastest programs have run beside Mediant on one machine since, and have a page of their own: \
         [performance](../performance.md). Here stand those that were timed on another machine alone. \
         Ratios, never times: two crates that anyone can run were measured on the machine of the other \
         programs, and here in the same passes as our engines; their times tell the ratio of the machines, \
         map by map. Below 1, ours is faster. Only programs that solve the same problem are compared: the \
         same directions and rules, both optimally or neither.",
    );
    section.text(format!(
        "`subgoal` stands twice: with the hub labels that it keeps by default, and with a contraction \
         hierarchy, `levels=contracted`, which takes less memory and more time. Hub labels are kept where \
         they fit a budget of memory. In sparse noise a contraction does not come to its end: too many \
         subgoals see each other. Labels cannot be made then, and if the contraction would be slower than \
         Anya (at any angle) or block-based JPS (at k = 3), nothing is kept and that engine searches.{}",
        match exceptions(record) {
            exceptions if exceptions.is_empty() => String::new(),
            exceptions => format!(" Here: {exceptions}."),
        }
    ));
    let (table, means) = means(record, &references);
    section.table(&table);
    let (octile, any_angle): (Vec<_>, Vec<_>) =
        means.into_iter().partition(|(setup, ..)| setup.contains(":never"));
    for (name, title, means) in [
        ("octile", "Octile-optimal engines: k = 3 between centers", octile),
        ("any-angle", "Engines of any angle, between corners", any_angle),
    ] {
        if !means.is_empty() {
            let chart = ratio_chart(record, title, &means);
            section.figure(
                &format!("compared-programs-{name}"),
                &format!("{title}: our time over that of other programs"),
                chart.svg(),
            );
        }
    }
    section.heading("Times here");
    section.text("Mean time of a query in µs, with the path but where the distance alone was asked for.");
    section.table(&times(record));
    section.heading("Prepared");
    section
        .text("What comes before the first query, on all cores: milliseconds, and megabytes beyond the map.");
    section.table(&prepared(record));
    section
}

/// A row for each program, a point for each setup of ours: its geometric mean over the maps.
fn ratio_chart(record: &Record, title: &str, means: &[(&'static str, String, f64)]) -> Chart {
    let mut programs: Vec<&str> = Vec::new();
    for (_, program, _) in means {
        if !programs.contains(&program.as_str()) {
            programs.push(program);
        }
    }
    let rows = programs.len() as f64;
    let place = |program: &str| {
        programs.iter().position(|name| *name == program).map_or(-1.0, |at| rows - 1.0 - at as f64)
    };
    let mut chart = Chart::new(
        title,
        Axis::new("our time over the other program's, scaled to one machine; below 1 ours is faster").log(),
        Axis::new("")
            .ticks(programs.iter().map(|name| (place(name), (*name).to_owned())))
            .range(-0.7, rows - 0.3),
    )
    .note(format!(
        "geometric means over {} maps, {} instances",
        record.provenance.maps,
        thousands(record.provenance.instances as f64)
    ));
    for setup in SETUPS {
        let points: Vec<(f64, f64)> = means
            .iter()
            .filter(|(ours, ..)| *ours == setup)
            .map(|(_, program, mean)| (*mean, place(program)))
            .collect();
        if !points.is_empty() {
            chart.push(Series::new(called(setup).replace('`', ""), Mark::Points, points));
        }
    }
    chart.push(Series::new("equal", Mark::Reference, [(1.0, -0.7), (1.0, rows - 0.3)]));
    chart
}

fn times(record: &Record) -> Table {
    let maps = record.distinct("map");
    let heading = ["competitor".to_owned()].into_iter().chain(maps.iter().map(|map| (*map).to_owned()));
    let mut table = Table::new(heading.chain(["geometric mean".to_owned()]));
    for competitor in record.distinct("competitor") {
        let micros: Vec<Option<f64>> = maps
            .iter()
            .map(|map| record.number(&[("map", map), ("competitor", competitor)], "micros"))
            .collect();
        let all: Vec<f64> = micros.iter().flatten().copied().collect();
        let mean = stats::geometric_mean(&all);
        let cells = micros.into_iter().chain([mean]).map(|value| value.map_or("–".to_owned(), number));
        table.row([called(competitor)].into_iter().chain(cells));
    }
    table
}

fn prepared(record: &Record) -> Table {
    let mut table = Table::new(["engine", "ms, mean", "ms, most", "MB, mean", "MB, most"]);
    for competitor in record.distinct("competitor").into_iter().filter(|text| !text.contains(' ')) {
        let values = |column: &str, scale: f64| -> Vec<f64> {
            record
                .select(&[("competitor", competitor)])
                .filter_map(|row| Some(scale * row.number(column)?))
                .collect()
        };
        let (times, sizes) = (values("preparation", 1e3), values("bytes", 1e-6));
        let most = |values: &[f64]| values.iter().copied().reduce(f64::max);
        if sizes.is_empty() {
            continue;
        }
        let cells = [stats::mean(&times), most(&times), stats::mean(&sizes), most(&sizes)];
        let cells = cells.map(|value| value.map_or("–".to_owned(), number));
        table.row([called(competitor)].into_iter().chain(cells));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_said_where_there_are_no_labels() {
        let row = |map: &str, competitor: &str, kept: Kept| {
            Row::new().key("map", map).key("competitor", competitor).key("kept", kept.name())
        };
        let rows = vec![
            row("maze", "subgoal:3:never", Kept::Labels),
            row("noise", "subgoal:3:never", Kept::Contraction),
            row("noise", "subgoal:3:never,levels=contracted", Kept::Contraction),
            row("noise", "subgoal:any:open", Kept::Nothing),
        ];
        let (id, title) = ("compared-programs".to_owned(), String::new());
        let provenance = mediant_report::Provenance::default();
        let record = Record { id, title, provenance, columns: Vec::new(), rows };
        assert_eq!(
            exceptions(&record),
            "on noise `subgoal:3:never`, hub labels, is a contraction; on noise `subgoal:any:open`, hub labels, \
             is another engine, which prepares little"
        );
    }

    #[test]
    fn subgoals_are_called_by_what_is_kept() {
        assert_eq!(called("subgoal:3:never"), "`subgoal:3:never`, hub labels");
        assert_eq!(called("subgoal:any:open,levels=contracted"), "`subgoal:any:open`, contraction");
        assert_eq!(called("distance of subgoal:any:open"), "`subgoal:any:open`, hub labels, distance alone");
        assert_eq!(called("subgoal-theta:3:open"), "`subgoal-theta:3:open`");
        assert_eq!(called("pathfinding"), "`pathfinding`");
        for setup in SETUPS {
            assert_eq!(canonical(setup), setup, "records hold the text as the library writes it");
        }
    }
}
