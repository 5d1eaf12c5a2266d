//! Tables of speed beside other programs, from the record of `cargo xtask compare --peers`.

use mediant_report::{Record, Row, Table, number, stats::geometric_mean, thousands};

use super::{Region, records::source};
use crate::tree::Tree;

/// The record.
const FILE: &str = "docs/results/data/peers.json";
const PAGE: &str = "docs/performance.md";
/// The list that counts.
const WHOLE: &str = "whole files";

/// The regions of README and of the page of performance; none without the record.
///
/// # Errors
/// In words, that the file is no record.
pub(super) fn regions(tree: &Tree) -> Result<Vec<Region>, String> {
    let Some(bytes) = tree.bytes(FILE.as_ref()) else { return Ok(Vec::new()) };
    let text = std::str::from_utf8(bytes).map_err(|error| format!("{FILE}: {error}"))?;
    let record = Record::parse(text).map_err(|error| format!("{FILE}: {error}"))?;
    let peers = Peers { record: &record };
    let region = |file, name: &str, table: &Table| Region {
        file,
        name: name.to_owned(),
        text: format!("\n{}\n", table.markdown()),
    };
    let mut regions = vec![
        region("README.md", "speed", &peers.fastest()),
        region(PAGE, "ratios", &peers.ratios()),
        region(PAGE, "programs", &peers.programs()),
        region(PAGE, "behind", &peers.behind()),
    ];
    let (k, any) = ([":3:", "k-3"], [":any:", "any-angle"]);
    for ([motion, name], list) in [k, any].into_iter().flat_map(|kind| [(kind, WHOLE), (kind, "every 20th")])
    {
        let name = format!("{name}-{}", list.replace(' ', "-"));
        regions.push(region(PAGE, &name, &peers.times(motion, list)));
    }
    let source = Region { file: PAGE, name: "source".to_owned(), text: format!("\n{}\n\n", source(&record)) };
    regions.push(source);
    Ok(regions)
}

/// The rows of the record, read.
struct Peers<'a> {
    record: &'a Record,
}

impl<'a> Peers<'a> {
    /// The other programs, each with our setup beside it.
    fn pairs(&self) -> Vec<(&'a str, &'a str)> {
        let mut pairs = Vec::new();
        for row in self.record.rows.iter().filter(|row| !row.text("beside").is_empty()) {
            let pair = (row.text("beside"), row.text("program"));
            if !pairs.contains(&pair) {
                pairs.push(pair);
            }
        }
        pairs
    }

    fn lists(&self) -> Vec<&'a str> {
        self.record.distinct("list")
    }

    fn row(&self, list: &str, map: &str, program: &str) -> Option<&'a Row> {
        let keys = [("list", list), ("map", map), ("program", program)];
        self.record.rows.iter().find(|row| row.is(&keys))
    }

    /// Our figure over the other's on each map that both have.
    fn map_ratios(&self, list: &str, (ours, theirs): (&str, &str), column: &str) -> Vec<f64> {
        let figure = |map: &str, program: &str| self.row(list, map, program)?.number(column);
        let maps = self.record.distinct("map").into_iter();
        maps.filter_map(|map| Some(figure(map, ours)? / figure(map, theirs)?)).collect()
    }

    /// The geometric mean, with the least and the most.
    fn ratio(&self, list: &str, pair: (&str, &str), column: &str) -> String {
        let ratios = self.map_ratios(list, pair, column);
        let Some(mean) = geometric_mean(&ratios) else { return "–".to_owned() };
        let (least, most) =
            ratios.iter().fold((f64::MAX, 0.0_f64), |(a, b), &ratio| (a.min(ratio), b.max(ratio)));
        format!("{mean:.2} ({least:.2} to {most:.2})")
    }

    /// For each of our setups the time of a query and the fastest other program, on whole files.
    fn fastest(&self) -> Table {
        let heading = ["Mediant", "µs a query", "beside the fastest other program", "maps", "ratio"];
        let mut table = Table::new(heading).names(1);
        let pairs = self.pairs();
        let mut setups: Vec<&str> = pairs.iter().map(|(ours, _)| *ours).collect();
        setups.dedup();
        for setup in setups {
            let own = pairs.iter().filter(|(ours, _)| *ours == setup);
            let means = own.filter_map(|pair| {
                let ratios = self.map_ratios(WHOLE, *pair, "query");
                Some((pair.1, ratios.len(), geometric_mean(&ratios)?))
            });
            // The greater our ratio, the faster the other.
            let Some((program, maps, mean)) = means.max_by(|one, other| one.2.total_cmp(&other.2)) else {
                continue;
            };
            let ours: Vec<f64> = self.map_times(WHOLE, setup).into_iter().flatten().collect();
            let query = geometric_mean(&ours).map_or("–".to_owned(), number);
            table.row([in_words(setup), query, program.to_owned(), maps.to_string(), format!("{mean:.2}")]);
        }
        table
    }

    fn ratios(&self) -> Table {
        let lists = self.lists();
        let heading = ["Mediant", "beside", "maps"].map(str::to_owned).into_iter();
        let first = format!("first pass, {WHOLE}");
        let heading = heading.chain(lists.iter().map(|list| (*list).to_owned())).chain([first]);
        let mut table = Table::new(heading).names(2);
        for pair in self.pairs() {
            let maps = self.map_ratios(WHOLE, pair, "query").len();
            let cells = [format!("`{}`", pair.0), pair.1.to_owned(), maps.to_string()].into_iter();
            let cells = cells.chain(lists.iter().map(|list| self.ratio(list, pair, "query")));
            table.row(cells.chain([self.ratio(WHOLE, pair, "first")]));
        }
        table
    }

    /// The version of each program, and its preparation: geometric means over maps.
    fn programs(&self) -> Table {
        let heading =
            ["program", "version", "maps", "prepared, s", "size, MB", "paths that are not shortest"];
        let mut table = Table::new(heading).names(2);
        for program in self.record.distinct("program") {
            let keys = [("list", WHOLE), ("program", program)];
            let rows: Vec<&Row> = self.record.select(&keys).collect();
            let middle = |column: &str| {
                let values: Vec<f64> = rows.iter().filter_map(|row| row.number(column)).collect();
                geometric_mean(&values).map_or("–".to_owned(), number)
            };
            let differ: f64 = rows.iter().filter_map(|row| row.number("differ")).sum();
            let Some(first) = rows.first() else { continue };
            let is_ours = first.text("beside").is_empty();
            let name = if is_ours { format!("`{program}`") } else { program.to_owned() };
            let version = if is_ours { "Mediant" } else { first.text("version") };
            let cells =
                [name, version.to_owned(), rows.len().to_string(), middle("prepared"), middle("size")];
            table.row(cells.into_iter().chain([thousands(differ)]));
        }
        table
    }

    /// Each pair of programs of which ours takes longer on some map, with these maps by list.
    fn behind(&self) -> Table {
        let heading = ["Mediant", "beside", "list", "maps", "of", "ratios"];
        let mut table = Table::new(heading).names(3);
        for (pair, list) in
            self.pairs().iter().flat_map(|pair| self.lists().into_iter().map(move |list| (pair, list)))
        {
            let mut all = Vec::new();
            for map in self.record.distinct("map") {
                let query = |program: &str| self.row(list, map, program)?.number("query");
                if let (Some(ours), Some(theirs)) = (query(pair.0), query(pair.1)) {
                    all.push((map, ours / theirs));
                }
            }
            let of = all.len();
            all.retain(|(_, ratio)| *ratio > 1.0);
            all.sort_by(|one, other| other.1.total_cmp(&one.1));
            if !all.is_empty() {
                let named: Vec<String> = all.iter().map(|(map, ratio)| format!("{map} {ratio:.2}")).collect();
                let cells =
                    [format!("`{}`", pair.0), pair.1.to_owned(), list.to_owned(), all.len().to_string()];
                table.row(cells.into_iter().chain([of.to_string(), named.join(", ")]));
            }
        }
        table
    }

    /// The microseconds of a query on each map.
    fn map_times(&self, list: &str, program: &str) -> Vec<Option<f64>> {
        let maps = self.record.distinct("map").into_iter();
        maps.map(|map| self.row(list, map, program)?.number("query")).collect()
    }

    /// Microseconds, map by map, of the programs of one motion.
    fn times(&self, motion: &str, list: &str) -> Table {
        let pairs = self.pairs().into_iter().filter(|(ours, _)| ours.contains(motion));
        let mut programs: Vec<&str> = Vec::new();
        for program in pairs.flat_map(|(ours, theirs)| [ours, theirs]) {
            if !programs.contains(&program) {
                programs.push(program);
            }
        }
        let is_ours = |program: &&str| program.contains(motion);
        let heading = |program: &&str| {
            if is_ours(program) { format!("*`{program}`*") } else { (*program).to_owned() }
        };
        let mut table = Table::new(["map".to_owned()].into_iter().chain(programs.iter().map(heading)));
        let columns: Vec<Vec<Option<f64>>> =
            programs.iter().map(|program| self.map_times(list, program)).collect();
        for (at, map) in self.record.distinct("map").into_iter().enumerate() {
            let cell = |column: &Vec<Option<f64>>| column[at].map_or("–".to_owned(), number);
            table.row([map.to_owned()].into_iter().chain(columns.iter().map(cell)));
        }
        let mean = |column: &Vec<Option<f64>>| {
            let times: Vec<f64> = column.iter().copied().flatten().collect();
            let over = if times.len() < column.len() { format!(" ({})", times.len()) } else { String::new() };
            geometric_mean(&times).map_or("–".to_owned(), |mean| format!("**{}**{over}", number(mean)))
        };
        table.row(["**geometric mean** (maps)".to_owned()].into_iter().chain(columns.iter().map(mean)));
        table
    }
}

/// A setup for README: `k = 3: jps-block`.
fn in_words(setup: &str) -> String {
    let (engine, rest) = setup.split_once(':').unwrap_or((setup, ""));
    let k = rest.split([':', ',']).next().unwrap_or_default();
    let options = setup.split_once(',').map_or(String::new(), |(_, options)| format!(", {options}"));
    let k = if k == "any" { "any angle".to_owned() } else { format!("k = {k}") };
    format!("{k}: `{engine}`{options}")
}

#[cfg(test)]
mod tests {
    use mediant_report::{Column, Provenance};

    use super::*;

    fn record() -> Record {
        let row = |list: &str, map: &str, (program, beside): (&str, &str), query: f64| {
            let row = Row::new().key("list", list).key("map", map).key("program", program);
            row.key("beside", beside).key("version", "1.2").with("query", query).with("first", 2.0 * query)
        };
        let (ours, slow, fast) =
            (("jps-block:3:never", ""), ("slow", "jps-block:3:never"), ("fast", "jps-block:3:never"));
        let labels = ("subgoal:any:closed,memory=5000000", "");
        Record {
            id: "peers".to_owned(),
            title: "Beside".to_owned(),
            provenance: Provenance::default(),
            columns: vec![
                Column::key("list", ""),
                Column::key("map", ""),
                Column::key("program", ""),
                Column::key("beside", ""),
                Column::key("version", ""),
                Column::time("query", "µs", ""),
                Column::time("first", "µs", ""),
            ],
            rows: vec![
                row("every 20th", "a", ours, 1.0),
                row("every 20th", "a", slow, 4.0),
                row(WHOLE, "a", ours, 1.0),
                row(WHOLE, "a", slow, 8.0),
                row(WHOLE, "a", fast, 2.0),
                row(WHOLE, "b", ours, 2.0),
                row(WHOLE, "b", slow, 4.0),
                row(WHOLE, "b", labels, 1.0),
                row(WHOLE, "b", ("EHL", labels.0), 2.0),
            ],
        }
    }

    #[test]
    fn ratios_are_geometric_means_over_the_maps_of_both() {
        let record = record();
        let peers = Peers { record: &record };
        let text = peers.ratios().markdown();
        assert!(
            text.contains("| `jps-block:3:never` | slow | 2 | 0.25 (0.25 to 0.25) | 0.25 (0.12 to 0.50) |"),
            "{text}"
        );
        assert!(text.contains("| `jps-block:3:never` | fast | 1 | – | 0.50 (0.50 to 0.50) |"), "{text}");
        let text = peers.fastest().markdown();
        assert!(text.contains("| k = 3: `jps-block` | 1.41 | fast | 1 | 0.50 |"), "{text}");
        assert!(text.contains("| any angle: `subgoal`, memory=5000000 | 1.00 | EHL | 1 | 0.50 |"), "{text}");
    }

    #[test]
    fn times_are_those_of_one_motion() {
        let record = record();
        let text = Peers { record: &record }.times(":3:", WHOLE).markdown();
        assert_eq!(
            text,
            "| map | *`jps-block:3:never`* | slow | fast |\n|---|--:|--:|--:|\n| a | 1.00 | 8.00 | 2.00 |\n\
             | b | 2.00 | 4.00 | – |\n| **geometric mean** (maps) | **1.41** | **5.66** | **2.00** (1) |\n"
        );
    }

    #[test]
    fn maps_are_named_on_which_ours_takes_longer() {
        let mut record = record();
        assert!(Peers { record: &record }.behind().is_empty());
        let set = |record: &mut Record, at: usize, query: f64| {
            let row = &record.rows[at];
            let keys = ["list", "map", "program", "beside"];
            let row = keys.iter().fold(Row::new(), |new, key| new.key(key, row.text(key)));
            record.rows[at] = row.with("query", query).with("first", query);
        };
        set(&mut record, 6, 1.6);
        let text = Peers { record: &record }.behind().markdown();
        assert!(text.ends_with("| `jps-block:3:never` | slow | whole files | 1 | 2 | b 1.25 |\n"), "{text}");
        assert_eq!(text.lines().count(), 3, "{text}");
    }

    #[test]
    fn without_the_record_nothing_is_drawn() {
        assert!(regions(&Tree::new(Vec::new())).is_ok_and(|regions| regions.is_empty()));
        let text = record().json().into_bytes();
        let regions = regions(&Tree::new(vec![(FILE.into(), text)])).map(|regions| regions.len());
        assert_eq!(regions, Ok(9));
    }
}
