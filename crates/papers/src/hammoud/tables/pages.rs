//! The section of tables I and II.

use mediant_report::{Claim, Record, Row, Table, number, stats, thousands};

use super::{
    super::published::{Published, rows},
    ENGINES, KEPT, LIST, RULES, point,
};
use crate::experiment::Section;

/// A query of the record or of the tables.
struct Asked<'a> {
    record: &'a Record,
    map: String,
    start: String,
    goal: String,
    published: Option<Published>,
}

impl<'a> Asked<'a> {
    /// A row of the tables.
    fn published(record: &'a Record, published: Published) -> Self {
        let (start, goal) = (point(published.start), point(published.goal));
        Self { record, map: published.map.to_owned(), start, goal, published: Some(published) }
    }

    /// The query of a row of the record.
    fn of(record: &'a Record, row: &Row) -> Self {
        let [map, start, goal] = ["map", "start", "goal"].map(|column| row.text(column).to_owned());
        let is = |published: &Published| {
            (published.map, point(published.start), point(published.goal))
                == (&map, start.clone(), goal.clone())
        };
        let published = rows().find(is);
        Self { record, map, start, goal, published }
    }

    fn get(&self, rule: &str, engine: &str, column: &str) -> Option<f64> {
        let keys = [("map", &*self.map), ("start", &self.start), ("goal", &self.goal)];
        self.record.number(&[&keys[..], &[("rule", rule), ("engine", engine)]].concat(), column)
    }

    /// `Boston_0_512 (352, 0) → (0, 407)`.
    fn name(&self) -> String {
        format!("{} {} → {}", self.map, self.start, self.goal)
    }

    /// The time of A*, which cuts no corners, over the time of JPS, which does.
    fn ratio(&self) -> Option<f64> {
        Some(self.get("never", "astar", "micros")? / self.get("one", "jps", "micros")?)
    }

    /// The published times in microseconds: of A* for each entry that [`LIST`] looks at, of JPS for each
    /// vertex that jumps look at.
    fn paces(&self) -> Option<(f64, f64)> {
        let published = self.published?;
        let (looked, scanned) = (self.get("never", LIST, "looked")?, self.get("one", KEPT, "scanned")?);
        Some((1e6 * published.astar_seconds / looked, 1e6 * published.jps_seconds / scanned))
    }
}

/// The queries of a record.
fn asked(record: &Record) -> Vec<Asked<'_>> {
    let first = [("rule", "never"), ("engine", "astar")];
    record.select(&first).map(|row| Asked::of(record, row)).collect()
}

/// The section.
pub(in crate::hammoud) fn show(record: &Record) -> Section {
    let asked = asked(record);
    let mut section = Section::default();
    lengths(&mut section, &asked);
    times(&mut section, &asked);
    by_engine(&mut section, &asked);
    section.claims(claims(record), false);
    section
}

fn text(number: Option<f64>, digits: usize) -> String {
    number.map_or("–".to_owned(), |number| format!("{number:.digits$}"))
}

fn short(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), number)
}

fn lengths(section: &mut Section, asked: &[Asked<'_>]) {
    section.heading("Lengths");
    section.text(
        "The captions of tables I and II are swapped: the instances of table I are on the 512 × 512 maps, \
         those of table II on the 256 × 256 maps. *Instance* is the place in the map's scenario, from 0. The \
         paper's A* lengths are those of corner rule `never`, which the scenarios are made for. Its JPS \
         lengths are shorter: they are those of rule `one`, under which a path may pass one blocked cell's \
         corner. So the two columns are answers to two problems; under one rule, A* and JPS are equally \
         long.",
    );
    let mut table = Table::new([
        "table",
        "map",
        "start → goal",
        "instance",
        "benchmark, published",
        "scenario",
        "A*, published",
        "A* `never`",
        "JPS, published",
        "JPS `one`",
        "`always`",
    ])
    .names(3);
    for asked in asked {
        let published = |of: fn(&Published) -> f64| text(asked.published.as_ref().map(of), 4);
        table.row([
            asked.published.map_or("–", |published| published.table).to_owned(),
            asked.map.clone(),
            format!("{} → {}", asked.start, asked.goal),
            text(asked.get("never", "astar", "index"), 0),
            published(|row| row.optimum),
            text(asked.get("never", "astar", "optimum"), 4),
            published(|row| row.astar),
            text(asked.get("never", "astar", "cost"), 4),
            published(|row| row.jps),
            text(asked.get("one", "jps", "cost"), 4),
            text(asked.get("always", "jps", "cost"), 4),
        ]);
    }
    section.table(&table);
    section.text(format!(
        "Under each rule the four engines A*, JPS, block JPS and JPS+ agree: over these queries their \
         lengths differ by at most {} cells.",
        text(widest(asked), 9)
    ));
}

/// The largest difference of the engines' lengths under one rule.
fn widest(asked: &[Asked<'_>]) -> Option<f64> {
    let mut widest: Option<f64> = None;
    for (asked, rule) in asked.iter().flat_map(|asked| RULES.map(|rule| (asked, rule))) {
        let cost = |(engine, _): (&str, &str)| asked.get(rule, engine, "cost");
        let costs: Option<Vec<f64>> = ENGINES.into_iter().map(cost).collect();
        let costs = costs?;
        let most = costs.iter().copied().fold(f64::MIN, f64::max);
        let least = costs.iter().copied().fold(f64::MAX, f64::min);
        widest = Some(widest.map_or(most - least, |widest| widest.max(most - least)));
    }
    widest
}

fn times(section: &mut Section, asked: &[Asked<'_>]) {
    section.heading("Times");
    section.text(
        "The published times are seconds of the paper's program, ours microseconds; what compares is the \
         ratio of the two columns. A* is `never`, JPS is `one`, as in the paper. The last columns explain \
         the published times by counts. *List* is how many entries an A* looks at that keeps its open list \
         unsorted and searches it for each node; *steps* is how many vertices the jumps look at of a JPS as \
         of 2011, which keeps the jump points at which a path only turns. The published times are so many \
         microseconds for each.",
    );
    let mut table = Table::new([
        "map",
        "start → goal",
        "A*, published (s)",
        "JPS, published (s)",
        "A*/JPS, published",
        "A* (µs)",
        "JPS (µs)",
        "A*/JPS",
        "A* expands",
        "JPS expands",
        "list",
        "steps",
        "A*, published (µs) / list",
        "JPS, published (µs) / steps",
    ])
    .names(2);
    for asked in asked {
        let published = |of: fn(&Published) -> f64, digits| text(asked.published.as_ref().map(of), digits);
        let count = |rule, engine, column| asked.get(rule, engine, column).map_or("–".to_owned(), thousands);
        table.row([
            asked.map.clone(),
            format!("{} → {}", asked.start, asked.goal),
            published(|row| row.astar_seconds, 4),
            published(|row| row.jps_seconds, 4),
            published(Published::ratio, 2),
            short(asked.get("never", "astar", "micros")),
            short(asked.get("one", "jps", "micros")),
            text(asked.ratio(), 2),
            count("never", "astar", "expanded"),
            count("one", "jps", "expanded"),
            count("never", LIST, "looked"),
            count("one", KEPT, "scanned"),
            text(asked.paces().map(|paces| paces.0), 3),
            text(asked.paces().map(|paces| paces.1), 1),
        ]);
    }
    section.table(&table);
}

fn by_engine(section: &mut Section, asked: &[Asked<'_>]) {
    for rule in RULES {
        section.heading(&format!("Every engine, rule `{rule}`"));
        let mut heading = vec!["map".to_owned(), "start → goal".to_owned(), "length".to_owned()];
        heading.extend(ENGINES.map(|(_, name)| format!("{name} (µs)")));
        heading.extend(ENGINES.map(|(_, name)| format!("{name} expands")));
        heading.extend(ENGINES.map(|(_, name)| format!("{name} turns (°)")));
        let mut table = Table::new(heading).names(2);
        for asked in asked {
            let mut cells = vec![
                asked.map.clone(),
                format!("{} → {}", asked.start, asked.goal),
                text(asked.get(rule, "astar", "cost"), 4),
            ];
            let whole = |number: Option<f64>| number.map_or("–".to_owned(), thousands);
            cells.extend(ENGINES.map(|(engine, _)| short(asked.get(rule, engine, "micros"))));
            cells.extend(ENGINES.map(|(engine, _)| whole(asked.get(rule, engine, "expanded"))));
            cells.extend(ENGINES.map(|(engine, _)| whole(asked.get(rule, engine, "smoothness"))));
            table.row(cells);
        }
        section.table(&table);
    }
}

/// The published numbers as claims: lengths to the last digit, times as the ratio of the two columns.
fn claims(record: &Record) -> Vec<Claim> {
    let asked: Vec<Asked<'_>> = rows().map(|row| Asked::published(record, row)).collect();
    let mut claims = Vec::new();
    let (repeated, slower, misprinted) = (repeated(&asked), slower(&asked), misprinted(&asked));
    for asked in &asked {
        let Some(published) = asked.published else { continue };
        let source = |column: &str| format!("Table {}, {column}", published.table);
        let claim = |column, number, ours| Claim::new(source(column), asked.name(), number, ours).exact(4);
        let astar = |column| asked.get("never", "astar", column);
        claims.push(claim("benchmark length", published.optimum, astar("optimum")));
        claims.push(claim("A* length", published.astar, astar("cost")));
        let jps = asked.get("one", "jps", "cost");
        claims.push(claim("JPS length", published.jps, jps).because(&repeated));
        let ratio =
            Claim::new(source("A* time over JPS time"), asked.name(), published.ratio(), asked.ratio());
        claims.push(ratio.of_times(true).because(if published.is_misprinted() {
            &misprinted
        } else {
            &slower
        }));
    }
    claims
}

/// Why one JPS length differs.
fn repeated(asked: &[Asked<'_>]) -> String {
    let fits = |asked: &&Asked<'_>| {
        let (published, ours) = (asked.published.map(|row| row.jps), asked.get("one", "jps", "cost"));
        published.zip(ours).is_none_or(|(published, ours)| (published - ours).abs() < 1e-4)
    };
    let Some(odd) = asked.iter().find(|asked| !fits(asked)) else { return String::new() };
    let length = |rule, engine| text(odd.get(rule, engine, "cost"), 4);
    format!(
        "The printed JPS length is the A* length once more. It is the optimum of rule `never` ({}). Under \
         rule `one`, which gives the other 15 rows to the last digit, the shortest path has {}, by A*, JPS, \
         block JPS and JPS+ alike, with the Euclidean distance as heuristic {}, without a heuristic {}; \
         under `always` it has {}. Of the scenario's instances, {} have the printed length under `one`.",
        length("never", "jps"),
        length("one", "jps"),
        length("one", "jps:3:one,euclidean"),
        length("one", "jps:3:one,zero"),
        length("always", "jps"),
        text(odd.get("one", "jps", "alike"), 0),
    )
}

/// Why the ratios of times differ.
fn slower(asked: &[Asked<'_>]) -> String {
    let sound = || asked.iter().filter(|asked| asked.published.is_some_and(|row| !row.is_misprinted()));
    let paces: Vec<(f64, f64)> = sound().filter_map(Asked::paces).collect();
    let Some((list, steps)) =
        spread(paces.iter().map(|paces| paces.0)).zip(spread(paces.iter().map(|paces| paces.1)))
    else {
        return String::new();
    };
    let per = |rule, engine, of: &str| {
        let paces = sound()
            .filter_map(|asked| Some(asked.get(rule, engine, "micros")? / asked.get(rule, engine, of)?));
        spread(paces).map_or("–".to_owned(), |pace| number(1e3 * pace.middle))
    };
    format!(
        "The published times fit a program whose A* searches an unsorted open list for each node: they are \
         {:.2} µs (median; {:.2} to {:.2}) for each entry that it then looks at. The JPS times are {:.1} µs \
         (median; {:.1} to {:.1}) for each vertex that the jumps of a JPS as of 2011 look at. So the \
         published ratio is that of these two counts, a vertex weighing {:.0} entries. Here the open list is \
         a heap: a node that A* expands takes {} ns, a vertex that a jump looks at {} ns.",
        list.middle,
        list.least,
        list.most,
        steps.middle,
        steps.least,
        steps.most,
        steps.middle / list.middle,
        per("never", "astar", "expanded"),
        per("one", "jps", "scanned"),
    )
}

/// Why one ratio of times is far from the others.
fn misprinted(asked: &[Asked<'_>]) -> String {
    let is_misprinted = |asked: &&Asked<'_>| asked.published.is_some_and(|row| row.is_misprinted());
    let paces =
        asked.iter().filter(|asked| !is_misprinted(asked)).filter_map(Asked::paces).map(|paces| paces.1);
    let (Some(steps), Some(odd)) = (spread(paces), asked.iter().find(is_misprinted)) else {
        return String::new();
    };
    let (Some(count), Some((astar, jps))) = (odd.get("one", KEPT, "scanned"), odd.paces()) else {
        return String::new();
    };
    format!(
        "The JPS time of this row, 167.0000 s, is a misprint. It would be {jps:.0} µs for each of the {} \
         vertices that jumps look at, where all other rows have {:.1} to {:.1} µs; at their median the row \
         takes {:.2} s. The A* time of the row is sound: {astar:.2} µs for each entry of the list, as on the \
         other rows.",
        thousands(count),
        steps.least,
        steps.most,
        1e-6 * steps.middle * count,
    )
}

/// The median and the range of some numbers.
struct Spread {
    least: f64,
    middle: f64,
    most: f64,
}

fn spread(values: impl Iterator<Item = f64>) -> Option<Spread> {
    let values: Vec<f64> = values.collect();
    let middle = stats::median(&values)?;
    let (least, most) =
        values.iter().fold((f64::MAX, f64::MIN), |(least, most), &value| (least.min(value), most.max(value)));
    Some(Spread { least, middle, most })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A record of the published values, but for one JPS length.
    fn record() -> Record {
        let mut found = Vec::new();
        for published in rows() {
            let key = |rule, engine| {
                let row = Row::new().key("map", published.map).key("start", point(published.start));
                row.key("goal", point(published.goal)).key("rule", rule).key("engine", engine)
            };
            let jps = if published.start == (244, 40) { 826.4356 } else { published.jps };
            for (rule, cost) in [("never", published.astar), ("one", jps), ("always", jps)] {
                for (engine, _) in ENGINES {
                    let micros =
                        if engine == "jps" { published.jps_seconds } else { published.astar_seconds };
                    let row = key(rule, engine).with("cost", cost).with("micros", micros);
                    found.push(
                        row.with("optimum", published.optimum)
                            .with("expanded", 100.0)
                            .with("scanned", 1000.0),
                    );
                }
            }
            found.push(key("never", LIST).with("looked", 1e6 * published.astar_seconds));
            found.push(key("one", KEPT).with("scanned", 1e5 * published.jps_seconds.min(0.8)));
        }
        let (id, title) = ("hammoud2023-tables".to_owned(), String::new());
        Record {
            id,
            title,
            provenance: mediant_report::Provenance::default(),
            columns: Vec::new(),
            rows: found,
        }
    }

    #[test]
    fn one_length_of_48_differs_and_says_why() {
        let record = record();
        let section = show(&record);
        assert_eq!(section.claims.len(), 64);
        let differing: Vec<&Claim> = section
            .claims
            .iter()
            .filter(|claim| claim.verdict() != mediant_report::Verdict::Matched)
            .collect();
        let [odd] = differing[..] else { panic!("{differing:?}") };
        assert_eq!(odd.what, "London_0_512 (244, 40) → (507, 502)");
        assert!(odd.cause.contains("826.4356") && odd.cause.contains("828.1930"), "{}", odd.cause);
        let misprinted: Vec<&Claim> =
            section.claims.iter().filter(|claim| claim.cause.contains("misprint")).collect();
        let [misprinted] = misprinted[..] else { panic!("{misprinted:?}") };
        assert!(misprinted.source.contains("time") && misprinted.what.contains("(67, 499)"));
        assert_eq!(widest(&asked(&record)), Some(0.0));
    }

    #[test]
    fn without_the_maps_nothing_is_measured() {
        let record = Record { rows: Vec::new(), ..record() };
        let section = show(&record);
        assert!(section.claims.len() == 64 && section.claims.iter().all(|claim| claim.ours.is_none()));
    }

    #[test]
    fn lengths_that_differ_are_seen() {
        let mut record = record();
        let at = record.rows.iter().position(|row| row.text("engine") == "jps-plus").unwrap();
        let cost = record.rows[at].number("cost").unwrap();
        record.rows[at] = record.rows[at].clone().with("cost", cost + 0.25);
        assert_eq!(widest(&asked(&record)), Some(0.25));
    }
}
