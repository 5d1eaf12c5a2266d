//! `--format csv` of `run`: columns that scripts rely on.

use crate::{
    common::{Ran, mediant},
    jsonl::{parts, records},
};

/// Lines of CSV have the numbers of the records; where there is no path they are empty.
#[test]
fn lines_of_csv_have_the_numbers_of_the_records() {
    let of_scenario = ["run", "builtin:cave", "--scen", "builtin:cave", "--limit", "9"];
    // Both ends are in different parts of the map.
    let unreachable =
        ["run", "builtin:town", "--from", "0,0", "--to", "37,0", "--snap", "--max-expansions", "1"];
    for args in [&of_scenario[..], &unreachable] {
        let records = records(&[args, &["--format", "jsonl"]].concat());
        let (_, queries, _) = parts(&records);
        let Ran { status, stdout, stderr } = mediant(&[args, &["--format", "csv"]].concat());
        assert_eq!((stderr.as_str(), status), ("", Some(0)));
        let mut lines = stdout.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let columns = lines.next().expect("a head");
        let lines: Vec<_> = lines.collect();
        assert_eq!((lines.len(), columns.len()), (queries.len(), 11), "{stdout}");
        for (line, query) in lines.into_iter().zip(queries) {
            let cell = |name: &str| line[columns.iter().position(|column| *column == name).expect(name)];
            for (name, value) in [
                ("index", &query["index"]),
                ("start_x", &query["start"][0]),
                ("start_y", &query["start"][1]),
                ("goal_x", &query["goal"][0]),
                ("goal_y", &query["goal"][1]),
                ("cost", &query["cost"]),
                ("reference", &query["reference"]),
                ("expanded", &query["expanded"]),
            ] {
                assert_eq!(cell(name).parse().ok(), value.as_f64(), "{name} of {query}");
            }
            assert_eq!(cell("status"), query["status"], "{query}");
            let waypoints = query["path"].as_array().map_or(0, Vec::len);
            assert_eq!(cell("waypoints").parse().unwrap_or(0), waypoints, "{query}");
        }
    }
}
