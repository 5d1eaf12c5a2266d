//! The records `docs/proof/instances.json` and `docs/proof/laws.json`.

use std::{collections::BTreeMap, fs, path::Path};

use mediant_report::{Column, ColumnKind, Machine, Provenance, Record, Row, revision};

use super::{
    Pace, ProveError,
    families::CONTESTANTS,
    laws::CASES,
    parts::{Done, Kept, Part},
    sources::Sources,
    suite::Suite,
    tally::WRONG,
};

/// The counts of a family beside those of its contestants, each with its meaning.
const OF_FAMILIES: [(&str, &str); 6] = [
    ("problems", "instances, each under each rule of motion of the family"),
    ("unreachable", "those that have no path"),
    ("refused", "those with an end that is no free vertex, which each engine must refuse"),
    ("scenario", "those compared with the length that the scenario states"),
    ("incomparable", "those whose scenario was made on another map and states another length"),
    (WRONG, "answers that differ"),
];

/// The state of a family or a law on a set.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// The first so many maps are proven.
    pub(super) maps: usize,
    /// The maps of the set.
    pub(super) of: usize,
    pub(super) done: Done,
}

impl State {
    /// The first maps that are proven: those of the record, and those kept since.
    pub(super) fn of(parts: &[Part], kept: &Kept, recorded: Option<Self>) -> Self {
        let mut state = recorded.unwrap_or_default();
        state.of = parts.len();
        while let Some(done) = parts.get(state.maps).and_then(|part| kept.get(part)) {
            state = state.with(&done);
        }
        state
    }

    /// With one more map.
    pub(super) fn with(mut self, done: &Done) -> Self {
        self.maps += 1;
        self.done.seconds += done.seconds;
        self.done.tally.add(&done.tally);
        self
    }
}

/// A record that is there, or an empty one.
struct Page {
    is_of_laws: bool,
    record: Record,
}

impl Page {
    const fn id(is_of_laws: bool) -> &'static str {
        if is_of_laws { "laws" } else { "instances" }
    }

    /// The key column of its suites.
    const fn key(is_of_laws: bool) -> &'static str {
        if is_of_laws { "law" } else { "family" }
    }

    fn read(folder: &Path, is_of_laws: bool) -> Result<Self, ProveError> {
        let file = folder.join(format!("{}.json", Self::id(is_of_laws)));
        let record = match fs::read_to_string(&file) {
            Ok(text) => Record::parse(&text)?,
            Err(_) => Record {
                id: Self::id(is_of_laws).to_owned(),
                title: String::new(),
                provenance: Provenance::default(),
                columns: Vec::new(),
                rows: Vec::new(),
            },
        };
        Ok(Self { is_of_laws, record })
    }

    fn columns(&self) -> Vec<Column> {
        let mut columns = vec![
            Column::key(Self::key(self.is_of_laws), "the name by which the command takes it"),
            Column::key("set", "the set of maps"),
            Column::key("sources", "the digest of the sources of libraries and program"),
            Column::count("maps", "", "the maps that are proven, the first by name"),
            Column::count("of", "", "the maps of the set"),
        ];
        let count = |name: &str, about: &str| Column::count(name, "", about);
        if self.is_of_laws {
            columns.push(count(CASES, "comparisons"));
            columns.push(count(WRONG, "those in which the law is broken"));
        } else {
            columns.extend(OF_FAMILIES.map(|(name, about)| count(name, about)));
            columns.extend(CONTESTANTS.map(|name| count(name, "its answers that were compared")));
        }
        columns
    }
}

/// The states that the records in `folder` have of these sources, by suite and set.
pub(super) fn recorded(
    folder: &Path,
    sources: &Sources,
) -> Result<BTreeMap<(String, String), State>, ProveError> {
    let mut states = BTreeMap::new();
    for is_of_laws in [false, true] {
        let record = Page::read(folder, is_of_laws)?.record;
        let key = Page::key(is_of_laws);
        for row in record.rows.iter().filter(|row| row.text("sources") == sources.of(is_of_laws)) {
            let number = |column: &str| row.number(column).unwrap_or(0.0);
            let mut state = State { maps: number("maps") as usize, ..State::default() };
            let counts = record.columns.iter().filter(|column| column.kind == ColumnKind::Count);
            for column in counts.filter(|column| column.name != "maps" && column.name != "of") {
                if let Some(count) = row.number(&column.name) {
                    state.done.tally.count_many(&column.name, count as u64);
                }
            }
            states.insert((row.text(key).to_owned(), row.text("set").to_owned()), state);
        }
    }
    Ok(states)
}

/// The number of maps of each suite and set that any sources have proven.
pub(super) fn reach(folder: &Path) -> Result<BTreeMap<(String, String), usize>, ProveError> {
    let mut reach = BTreeMap::new();
    for is_of_laws in [false, true] {
        let (record, key) = (Page::read(folder, is_of_laws)?.record, Page::key(is_of_laws));
        for row in &record.rows {
            let maps = row.number("maps").unwrap_or(0.0) as usize;
            let most = reach.entry((row.text(key).to_owned(), row.text("set").to_owned())).or_default();
            *most = maps.max(*most);
        }
    }
    Ok(reach)
}

/// Writes the states to the records in `folder`. Rows of other sources stay until these have proven as many
/// maps.
pub(super) fn write(
    (root, folder): (&Path, &Path),
    sources: &Sources,
    pace: Pace,
    states: &[(Suite, String, State)],
) -> Result<(), ProveError> {
    fs::create_dir_all(folder).map_err(ProveError::at(folder))?;
    for is_of_laws in [false, true] {
        let mut page = Page::read(folder, is_of_laws)?;
        let key = Page::key(is_of_laws);
        page.record.columns = page.columns();
        let new = states.iter().filter(|(suite, _, state)| suite.is_law() == is_of_laws && state.maps > 0);
        let (mut rows, mut problems) = (Vec::new(), 0);
        for (suite, set, state) in new {
            let mut row = Row::new().key(key, suite).key("set", set).key("sources", sources.of(is_of_laws));
            row = row.with("maps", state.maps as f64).with("of", state.of as f64);
            row = row.with(WRONG, 0.0);
            for (name, count) in state.done.tally.counts().filter(|&(_, count)| count > 0) {
                row = row.with(name, count as f64);
            }
            rows.push(row);
            problems += state.done.tally.get("problems") + state.done.tally.get(CASES);
        }
        let maps = |row: &Row| row.number("maps").unwrap_or(0.0);
        let is_old = |row: &&Row| {
            let keys = [(key, row.text(key)), ("set", row.text("set"))];
            let is_of_these = row.text("sources") == sources.of(is_of_laws);
            !rows.iter().any(|new| new.is(&keys) && (is_of_these || maps(new) >= maps(row)))
        };
        let old: Vec<Row> = page.record.rows.iter().filter(is_old).cloned().collect();
        problems +=
            old.iter().filter_map(|row| row.number("problems").or(row.number(CASES))).sum::<f64>() as u64;
        rows.extend(old);
        rows.sort_by_key(|row| place(row, key));
        // The revision is that at which a row was last proven.
        if rows == page.record.rows {
            continue;
        }
        page.record.rows = rows;
        page.record.provenance = provenance(root, pace, problems, &page.record, is_of_laws);
        page.record.title = match is_of_laws {
            true => "Laws that need no known cost".to_owned(),
            false => "Every public instance by every exact engine".to_owned(),
        };
        let file = folder.join(format!("{}.json", page.record.id));
        fs::write(&file, page.record.json()).map_err(ProveError::at(&file))?;
    }
    Ok(())
}

/// The place of a row: in the order of the suites, then by set and sources.
fn place(row: &Row, key: &str) -> (usize, String, String) {
    let name = row.text(key);
    let at = Suite::all().iter().position(|suite| suite.to_string() == name);
    (at.unwrap_or(usize::MAX), row.text("set").to_owned(), row.text("sources").to_owned())
}

fn provenance(root: &Path, pace: Pace, instances: u64, record: &Record, is_of_laws: bool) -> Provenance {
    let Pace { slow, at_large_k } = pace;
    let drawn = match is_of_laws {
        true => "every 1st, 2nd, 20th or 100th instance of a map, by the law; most laws ask each under one \
                 motion, in turn"
            .to_owned(),
        false => format!(
            "all instances of the first maps of each set; slow engines are asked every {slow}th instance, \
             from k = 6 on every {at_large_k}th"
        ),
    };
    Provenance {
        revision: revision(root),
        machine: Machine::here(),
        sets: record.distinct("set").into_iter().map(str::to_owned).collect(),
        maps: record.rows.iter().filter_map(|row| row.number("maps")).sum::<f64>() as usize,
        instances,
        drawn,
        seed: None,
        quick: false,
        bundled: false,
        passes: None,
    }
}
