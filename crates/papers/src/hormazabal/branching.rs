//! The branching factors of 2-level subgoal graphs ('Comparing Sub2-Theta* with Sub2-A*(k)').

use std::num::NonZeroU32;

use mediant_grid::{Corners, DiagonalGap, FreeSpace};
use mediant_moves::FiniteK;
use mediant_report::{Axis, Chart, Claim, Column, Mark, Record, Row, Series, Table};
use mediant_subgoal::{Hierarchy, SubgoalGraph};
use serde::{Deserialize, Serialize};

use super::planners::KS;
use crate::{
    Error,
    context::{Context, How},
    experiment::{Experiment, Findings, Page, Section},
    kramm::ratios::is_published,
    maps::Map,
};

pub(crate) const BRANCHING: Experiment = Experiment {
    id: "hormazabal2017-branching",
    page: Page::Hormazabal2017,
    title: "Branching factors of subgoal graphs",
    sets: &["bg512", "room"],
    measure,
    show,
};

/// The paper's numbers: set, k, branching factor.
const PUBLISHED: [(&str, u32, f64); 4] =
    [("room", 3, 5.3), ("room", 9, 9.3), ("bg512", 3, 9.3), ("bg512", 9, 19.8)];

/// The graphs of a map for a k: of one level and of two.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Graphs {
    subgoals: u32,
    /// Arcs of the graph of one level, out of each subgoal.
    arcs: u32,
    /// The subgoals of the second level, and the arcs out of each of them to others.
    core: u32,
    core_arcs: u32,
    /// Arcs of two levels: those of the core, and those of other subgoals upward.
    upward: u32,
}

impl Graphs {
    fn of(space: &FreeSpace<Corners>, k: u32) -> Result<Self, Error> {
        let wrong =
            |wrong: &dyn std::fmt::Display| Error::Reproduce(format!("subgoal graph, k = {k}: {wrong}"));
        let k = FiniteK::new(k).map_err(|error| wrong(&error))?;
        let graph = |levels: u32| {
            let levels = NonZeroU32::MIN.saturating_add(levels - 1);
            SubgoalGraph::new(space, k, Hierarchy::Levels(levels)).map_err(|error| wrong(&error))
        };
        let (one, two) = (graph(1)?, graph(2)?);
        let count = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        Ok(Self {
            subgoals: count(one.subgoals()),
            arcs: count(one.arcs()),
            core: count(two.core()),
            core_arcs: count(two.core_arcs()),
            upward: count(two.arcs()),
        })
    }

    /// The branching factor in one of the senses; none where there is no subgoal to count.
    fn factor(self, sense: Sense) -> Option<f64> {
        let (arcs, of) = self.pair(sense);
        (of > 0.0).then(|| arcs / of)
    }

    fn pair(self, sense: Sense) -> (f64, f64) {
        let [subgoals, arcs, core, core_arcs, upward] =
            [self.subgoals, self.arcs, self.core, self.core_arcs, self.upward].map(f64::from);
        match sense {
            Sense::OneLevel => (arcs, subgoals),
            Sense::Core => (core_arcs, core),
            Sense::Upward => (upward, subgoals),
            // An upward arc of the first level, counted from its other end as well.
            Sense::BothWays => (2.0 * upward - core_arcs, subgoals),
        }
    }
}

/// A definition of the branching factor: the arcs that count, and the divisor.
#[derive(Clone, Copy, Debug)]
enum Sense {
    OneLevel,
    Core,
    Upward,
    BothWays,
}

impl Sense {
    const ALL: [Self; 4] = [Self::Core, Self::Upward, Self::BothWays, Self::OneLevel];

    const fn column(self) -> &'static str {
        match self {
            Self::OneLevel => "one_level",
            Self::Core => "core",
            Self::Upward => "upward",
            Self::BothWays => "both_ways",
        }
    }

    const fn about(self) -> &'static str {
        match self {
            Self::OneLevel => "graph of one level: arcs out of a subgoal",
            Self::Core => "second of two levels: arcs out of a subgoal of it to others of it",
            Self::Upward => "two levels: arcs out of a subgoal to those of its level or above",
            Self::BothWays => "two levels: arcs that meet a subgoal, upward or downward",
        }
    }
}

fn measure(ctx: &Context<'_>) -> Result<Findings, Error> {
    let mut maps = Vec::new();
    for set in ctx.sets() {
        maps.extend(ctx.maps(set, 4)?);
    }
    let part = |map: &Map| -> Result<Vec<Graphs>, Error> {
        let space = FreeSpace::<Corners>::new(map.grid()?, DiagonalGap::Open);
        KS.map(|k| Graphs::of(&space, k)).collect()
    };
    let parts = ctx.each("graphs", How::Counted, &maps, part)?;
    let mut rows = Vec::new();
    for set in ctx.sets() {
        for (taken, last_five) in [("all", false), ("last five", true)] {
            let of_set = maps
                .iter()
                .zip(&parts)
                .filter(|(map, _)| map.set == set && (!last_five || is_published(map)));
            let of_set: Vec<&Vec<Graphs>> = of_set.map(|(_, part)| part).collect();
            if !of_set.is_empty() {
                rows.extend(KS.enumerate().flat_map(|(at, k)| {
                    pair(&of_set, at).map(|row| row.key("set", set).key("taken", taken).key("k", k))
                }));
            }
        }
    }
    let graphs = (2 * maps.len() * KS.count()) as u64;
    Ok(Findings {
        columns: columns(),
        rows,
        maps: maps.len(),
        instances: graphs,
        drawn: "graphs of one and of two levels, vertices at corners, gaps open".to_owned(),
        seeded: false,
    })
}

/// The rows for the k with this index: over maps and over subgoals.
fn pair(parts: &[&Vec<Graphs>], at: usize) -> [Row; 2] {
    let graphs: Vec<Graphs> = parts.iter().filter_map(|part| part.get(at)).copied().collect();
    [("maps", true), ("subgoals", false)].map(|(name, means)| {
        let row = Row::new().key("over", name).with("maps", graphs.len() as f64);
        let factor = |sense| if means { mean(&graphs, sense) } else { overall(&graphs, sense) };
        Sense::ALL.into_iter().fold(row, |row, sense| row.with(sense.column(), factor(sense)))
    })
}

fn columns() -> Vec<Column> {
    let mut columns = vec![
        Column::key("set", "the set of maps"),
        Column::key(
            "taken",
            "all maps of the set, or the last five of each kind: those of Kramm et al. 2018",
        ),
        Column::key("k", "paths over the 2^k neighborhood"),
        Column::key("over", "the mean of the maps' branching factors, or that over the subgoals of all maps"),
        Column::count("maps", "", "maps"),
    ];
    columns.extend(Sense::ALL.map(|sense| Column::count(sense.column(), "", sense.about())));
    columns
}

fn mean(graphs: &[Graphs], sense: Sense) -> Option<f64> {
    let factors: Vec<f64> = graphs.iter().filter_map(|graphs| graphs.factor(sense)).collect();
    mediant_report::stats::mean(&factors)
}

fn overall(graphs: &[Graphs], sense: Sense) -> Option<f64> {
    let pairs = graphs.iter().map(|graphs| graphs.pair(sense));
    let (arcs, of) = pairs.fold((0.0, 0.0), |sums, pair| (sums.0 + pair.0, sums.1 + pair.1));
    (of > 0.0).then(|| arcs / of)
}

fn show(record: &Record) -> Section {
    let mut section = Section::default();
    section.text(
        "The paper gives an average branching factor of the 2-level graph and does not say over what. Here \
         are four readings, each as the mean of the maps' factors and over the subgoals of all maps \
         together.",
    );
    let mut table = Table::new([
        "set",
        "maps",
        "over",
        "k",
        "second level",
        "upward",
        "both ways",
        "one level",
        "published",
    ])
    .names(3);
    for row in &record.rows {
        let number =
            |column: &str| row.number(column).map_or("–".to_owned(), |number| format!("{number:.1}"));
        let published =
            PUBLISHED.iter().find(|(set, k, _)| row.text("set") == *set && row.text("k") == k.to_string());
        table.row([
            row.text("set").to_owned(),
            row.text("taken").to_owned(),
            row.text("over").to_owned(),
            row.text("k").to_owned(),
            number("core"),
            number("upward"),
            number("both_ways"),
            number("one_level"),
            published.map_or_else(String::new, |(.., factor)| format!("{factor:.1}")),
        ]);
    }
    section.table(&table);
    section.figure("hormazabal2017-branching", "Branching factor of the second level by k", chart(record));
    section.claims(claims(record), true);
    section
}

fn chart(record: &Record) -> String {
    let ticks = KS.map(|k| (f64::from(k), k.to_string()));
    let mut chart = Chart::new(
        "Branching factor of 2-level subgoal graphs",
        Axis::new("k").ticks(ticks),
        Axis::new("arcs out of a subgoal of the second level"),
    );
    let mut note = Vec::new();
    for set in record.distinct("set") {
        let keys = [("set", set), ("taken", "all"), ("over", "subgoals")];
        let point = |row: &Row| Some((row.text("k").parse().ok()?, row.number("core")?));
        chart.push(Series::new(set, Mark::Line, record.select(&keys).filter_map(point)));
        note.push(format!("{set}: {:.0} maps", record.number(&keys, "maps").unwrap_or_default()));
    }
    for (index, set) in record.distinct("set").into_iter().enumerate() {
        let points: Vec<(f64, f64)> = PUBLISHED
            .iter()
            .filter(|published| published.0 == set)
            .map(|(_, k, factor)| (f64::from(*k), *factor))
            .collect();
        if !points.is_empty() {
            chart.push(Series::new(format!("{set}, published"), Mark::Points, points).style(index).hollow());
        }
    }
    chart.note(note.join(", ") + "; over all subgoals").svg()
}

fn claims(record: &Record) -> Vec<Claim> {
    let of = |set: &str, k: u32, over: &str, sense: Sense| {
        record
            .number(&[("set", set), ("taken", "all"), ("k", &k.to_string()), ("over", over)], sense.column())
    };
    let told = |set: &str, sense: Sense| {
        let ends = |over| {
            [3, 9].map(|k| of(set, k, over, sense).map_or("–".to_owned(), |factor| format!("{factor:.1}")))
        };
        let ([a, b], [c, d]) = (ends("subgoals"), ends("maps"));
        format!("{a} and {b} ({c} and {d})")
    };
    let claim = |&(set, k, factor): &(&str, u32, f64)| {
        let cause = format!(
            "The paper does not say over what it averages. At k = 3 and 9, over all subgoals of {set} (in \
             the mean of maps): {} within the second level, {} upward, {} both ways, {} on one level. None \
             of these, nor of the last five maps of each kind, gives all four published numbers; for rooms \
             the second level comes nearest, for Baldur's Gate what leads upward.",
            told(set, Sense::Core),
            told(set, Sense::Upward),
            told(set, Sense::BothWays),
            told(set, Sense::OneLevel)
        );
        let what = format!("{set}, k = {k}: arcs out of a subgoal of the second level");
        let ours = of(set, k, "subgoals", Sense::Core);
        Claim::new("Comparing Sub2-Theta* with Sub2-A*(k)", what, factor, ours).written(1, "").because(cause)
    };
    PUBLISHED.iter().map(claim).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use mediant_grid::Grid;

    use super::*;

    #[test]
    fn factors_of_one_obstacle() {
        // Four corners around one cell, each next to two others: a single path around.
        let grid = Grid::from_fn(3, 3, |x, y| (x, y) == (1, 1)).unwrap();
        let space = FreeSpace::<Corners>::new(Arc::new(grid), DiagonalGap::Open);
        let graphs = Graphs::of(&space, 3).unwrap();
        assert_eq!((graphs.subgoals, graphs.factor(Sense::OneLevel)), (4, Some(2.0)));
        assert!(graphs.core <= 4 && graphs.upward >= graphs.core_arcs);
        assert_eq!(Graphs::default().factor(Sense::Core), None);
        // Over the subgoals of both maps, not the mean of the maps' factors.
        let larger = Graphs { subgoals: 12, arcs: 72, ..graphs };
        assert_eq!(overall(&[graphs, larger], Sense::OneLevel), Some(5.0));
        assert_eq!(mean(&[graphs, larger, Graphs::default()], Sense::OneLevel), Some(4.0));
    }
}
