use std::fs;

use clap::Parser;
use zip::{ZipWriter, write::SimpleFileOptions};

use super::*;

#[derive(Parser)]
struct Cli {
    #[command(flatten)]
    options: Options,
}

fn options(arguments: &[&str]) -> Options {
    Cli::try_parse_from(["compare"].iter().chain(arguments)).unwrap().options
}

/// A mirror whose set `dao` has a map of our own under the name arena2, with one query of this length.
fn mirror(optimal: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let scenario = format!("version 1\n0\tarena2.map\t4\t3\t0\t1\t3\t1\t{optimal}\n");
    let entries = [
        ("dao-map.zip", "arena2.map", "type octile\nheight 3\nwidth 4\nmap\n....\n.@@.\n....\n".to_owned()),
        ("dao-scen.zip", "arena2.map.scen", scenario),
    ];
    for (archive, name, text) in entries {
        let mut zip = ZipWriter::new(fs::File::create(folder.path().join(archive)).unwrap());
        zip.start_file(name, SimpleFileOptions::default()).unwrap();
        zip.write_all(text.as_bytes()).unwrap();
        zip.finish().unwrap();
    }
    folder
}

/// A run in a project without a cache.
fn compare(mirror: &Path, arguments: &[&str]) -> Result<String, CompareError> {
    let root = tempfile::tempdir().unwrap();
    let mut options = options(arguments);
    options.mirror = Some(mirror.to_owned());
    let mut out = Vec::new();
    run_in(root.path(), &options, &mut out)?;
    Ok(String::from_utf8(out).unwrap())
}

#[test]
fn tables_and_figures_of_the_maps_that_are_there() {
    let mirror = mirror("5");
    let file = mirror.path().join("figures.json");
    let arguments = ["--engines", "astar", "astar:5:open", "--passes", "2", "--json", file.to_str().unwrap()];
    let text = compare(mirror.path(), &arguments).unwrap();
    let row = text.lines().find(|line| line.starts_with("arena2")).unwrap();
    assert_eq!(row.split_whitespace().nth(1), Some("1"), "{row}");
    assert_eq!(row.split_whitespace().count(), 7, "{row}");
    assert!(
        text.contains("astar:3:never by the scaled time of programs that solve the same problem"),
        "{text}"
    );
    assert!(
        !text.contains("astar:5:open by the scaled time of programs that solve the same problem"),
        "{text}"
    );
    assert!(text.contains("Missing: brc202d, orz900d,"), "{text}");
    assert!(text.contains("cargo xtask download --set dao bg512 sc1 random room street"), "{text}");

    let figures: serde_json::Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    assert_eq!(figures["engines"], serde_json::json!(["astar:3:never", "astar:5:open"]));
    let record = &figures["records"][0];
    assert_eq!((&record["map"], &record["instances"]), (&"arena2".into(), &1.into()));
    let competitors: Vec<_> =
        record["timings"].as_array().unwrap().iter().map(|timing| &timing["competitor"]).collect();
    assert_eq!(competitors, ["astar:3:never", "astar:5:open", "pathfinding", "grid_pathfinding"]);
    let ratio =
        |task: usize, program: usize| figures["comparisons"][0][task]["ratios"][program].as_f64().unwrap();
    let micros = |i: usize| record["timings"][i]["micros"].as_f64().unwrap();
    // Warthog A* and pathfinding take 732 and 1522 µs there, grid_pathfinding 108.
    let target = 732.0 * (micros(2) / 1522.0 * micros(3) / 108.0).sqrt();
    assert!((ratio(0, 0) - micros(0) / target).abs() < 1e-9 * ratio(0, 0));
    assert!((ratio(1, 0) / ratio(0, 0) - micros(1) / micros(0)).abs() < 1e-9 * micros(1) / micros(0));
    assert_eq!(figures["programs"].as_array().unwrap().len(), 13);
}

#[test]
fn programs_that_solve_the_same_problem_have_a_table_of_their_own() {
    let text = compare(mirror("5").path(), &["--engines", "anya", "theta:3:open"]).unwrap();
    let [anya, theta] = ["anya:any:open", "theta:3:open"].map(|setup| {
        let heading = format!("{setup} by the scaled time of programs that solve the same problem");
        let mut lines = text.lines().skip_while(|line| !line.starts_with(&heading));
        lines.next().zip(lines.next()).unwrap_or_else(|| panic!("{setup}: {text}"))
    });
    assert!(!anya.0.contains("neither") && anya.1.split_whitespace().eq(["map", "ENLSVG"]), "{anya:?}");
    assert!(theta.0.contains(", neither optimally (") && theta.1.ends_with("Lazy Theta*"), "{theta:?}");
}

#[test]
fn what_engines_prepare_is_compared_too() {
    let text = compare(mirror("5").path(), &["--engines", "subgoal", "subgoal:any:closed", "astar"]).unwrap();
    let table = |setup: &str| {
        let heading = format!("{setup}: what comes before the first query");
        let mut lines = text.lines().skip_while(|line| !line.starts_with(&heading)).skip(1);
        let heading = lines.next().map(str::to_owned);
        heading.zip(lines.nth(1).map(|row| row.split_whitespace().count()))
    };
    let (heading, cells) = table("subgoal:3:never").unwrap();
    assert!(
        heading.contains("2013-subgoal-fast time  2013-subgoal-fast size  2019-SGCH-JPD time"),
        "{heading}"
    );
    assert_eq!(cells, 9, "{text}");
    let (heading, cells) = table("subgoal:any:closed").unwrap();
    assert!(heading.contains("Polyanya_MCDT time") && !heading.contains("RayScan"), "{heading}");
    assert_eq!((cells, table("astar:3:never")), (7, None), "{text}");
}

#[test]
fn wrong_answers_and_missing_maps_are_errors() {
    let wrong = mirror("4.5");
    let error = compare(wrong.path(), &[]).unwrap_err();
    assert!(matches!(error, CompareError::Measure(MeasureError::Answer { expected: 4.5, .. })), "{error}");
    let error = compare(wrong.path(), &["--maps", "Cauldron"]).unwrap_err().to_string();
    let expected = "none of the maps is there: Cauldron; `cargo xtask download --set sc1` fetches them";
    assert_eq!(error, expected);
    let error = compare(wrong.path(), &["--maps", "atlantis"]).unwrap_err().to_string();
    assert!(error.starts_with("no figures of other programs for map `atlantis`"), "{error}");
    for refused in [
        ["--every", "0"],
        ["--passes", "0"],
        ["--engines", "warp"],
        ["--engines", "astar:99"],
        ["--engines", "jps-block:4"],
        ["--engines", "astar,paper"],
    ] {
        assert!(Cli::try_parse_from(["compare"].iter().chain(&refused)).is_err(), "{refused:?}");
    }
}

/// The tables of maps on which this machine seems to be so much slower.
fn tables(scales: &[f64]) -> String {
    let references = ReferenceTimings::bundled().unwrap();
    let comparison = |&scale: &f64| {
        vec![Comparison {
            map: "arena2".to_owned(),
            competitor: "astar".to_owned(),
            scale,
            ratios: Vec::new(),
            preparation: Vec::new(),
        }]
    };
    let comparisons = scales.iter().map(comparison).collect();
    report::text(&Results {
        references: &references,
        setups: &[],
        every: 20,
        passes: 3,
        records: Vec::new(),
        comparisons,
    })
}

#[test]
fn a_disturbed_run_is_called_so() {
    for calm in [&[0.71, 0.80, 0.77][..], &[]] {
        assert!(!tables(calm).contains("CAUTION"), "{calm:?}");
    }
    let text = tables(&[1.64, 0.70, 0.76]);
    assert!(text.contains("CAUTION: here/there differs by a factor of 2.34"), "{text}");
}
