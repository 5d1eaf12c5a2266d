//! `prove` compares what it says, finds what is wrong, and goes on where it ended.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{fs, path::Path};

use clap::Parser;
use mediant_bench::prove::{Options, Places, run_in};
use mediant_report::{Record, Row};
use mediant_sets::root;

#[derive(Parser)]
struct Cli {
    #[command(flatten)]
    options: Options,
}

/// Two maps of set `dao`, each with two queries. Of the first one's second query the scenario states this
/// length; in the other one no way leads to the last cell.
fn places(folder: &Path, stated: &str) -> Places {
    let set = folder.join("cache").join("dao");
    fs::create_dir_all(&set).unwrap();
    let maps = [("a.map", "....\n.@@.\n....\n", stated), ("b.map", "....\n@@@.\n..@.\n", "5")];
    for (name, rows, stated) in maps {
        fs::write(set.join(name), format!("type octile\nheight 3\nwidth 4\nmap\n{rows}")).unwrap();
        let goal = if name == "a.map" { "3\t1\t5" } else { "0\t2\t0" };
        let scenario =
            format!("version 1\n0\t{name}\t4\t3\t0\t0\t3\t2\t{stated}\n0\t{name}\t4\t3\t0\t0\t{goal}\n");
        fs::write(set.join(format!("{name}.scen")), scenario.replace("0\t0\t3\t1\t5", "0\t1\t3\t1\t5"))
            .unwrap();
    }
    Places {
        cache: folder.join("cache"),
        root: root(),
        kept: folder.join("kept"),
        records: folder.join("records"),
    }
}

/// The error of `prove`, if any, and what it prints.
fn prove(places: &Places, arguments: &[&str]) -> (Option<String>, String) {
    let mut out = Vec::new();
    let options = Cli::parse_from(["prove"].iter().chain(arguments)).options;
    let error = run_in(places, &options, &mut out).err().map(|error| error.to_string());
    (error, String::from_utf8(out).unwrap())
}

fn record(places: &Places, name: &str) -> Record {
    Record::parse(&fs::read_to_string(places.records.join(name)).unwrap()).unwrap()
}

/// Four queries by labels, graph, three kinds of jump points, canonical A* and fields, and each stated by the
/// scenario; two by A*, wavefront and Dijkstra, which are asked the first of each map.
#[test]
fn comparisons_are_counted_and_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let places = places(folder.path(), "5");
    let of_family = ["--family", "centers-3", "--expect", "38"];
    let (error, text) = prove(&places, &[&of_family[..], &["--record"]].concat());
    assert_eq!(error, None, "{text}");
    assert!(
        text.contains("centers-3      dao             2 of   2 maps,        38 comparisons, 0 wrong"),
        "{text}"
    );
    let record = record(&places, "instances.json");
    let number = |column| record.number(&[("family", "centers-3"), ("set", "dao")], column);
    assert_eq!(["maps", "of", "problems", "scenario"].map(number), [2.0, 2.0, 4.0, 4.0].map(Some));
    assert_eq!(
        ["unreachable", "wrong", "labels", "field", "astar"].map(number),
        [1.0, 0.0, 4.0, 4.0, 2.0].map(Some)
    );
    let (error, _) = prove(&places, &["--family", "centers-3", "--expect", "39"]);
    assert_eq!(error.as_deref(), Some("expected 39 comparisons, made 38"));
}

#[test]
fn what_is_done_is_not_done_again() {
    let folder = tempfile::tempdir().unwrap();
    let places = places(folder.path(), "5");
    let arguments = ["--family", "corners-any", "--record"];
    assert_eq!(prove(&places, &arguments).0, None);
    let file = places.records.join("instances.json");
    // As if it had been proven by another revision.
    let mut before = record(&places, "instances.json");
    before.provenance.revision = "earlier".to_owned();
    fs::write(&file, before.json()).unwrap();
    // The record alone says what is done: without the results, and without the maps' content.
    fs::remove_dir_all(&places.kept).unwrap();
    for name in ["a.map", "b.map"] {
        fs::write(places.cache.join("dao").join(name), "no map").unwrap();
    }
    assert_eq!(prove(&places, &arguments).0, None);
    // Nothing new: the revision stays that at which it was proven.
    assert_eq!(record(&places, "instances.json"), before);
    // Without it both are read again.
    fs::remove_dir_all(&places.records).unwrap();
    let (error, _) = prove(&places, &arguments);
    assert!(error.is_some_and(|error| error.contains("no map") || error.contains("a.map")));
}

/// Records of other sources, of more maps and of as many: the first stay beside today's.
#[test]
fn what_other_sources_proved_stays_until_as_much_is_proven() {
    let folder = tempfile::tempdir().unwrap();
    let places = places(folder.path(), "5");
    let arguments = ["--family", "corners-any", "corners-2", "--record"];
    assert_eq!(prove(&places, &arguments).0, None);
    let (mut old, file) = (record(&places, "instances.json"), places.records.join("instances.json"));
    let today = old.rows[0].text("sources").to_owned();
    let of = |family: &str, maps: usize, sources: &str| {
        let row = Row::new().key("family", family).key("set", "dao").key("sources", sources);
        row.with("maps", maps as f64).with("of", 2.0).with("problems", 8.0)
    };
    old.rows = vec![of("corners-any", 3, "older"), of("corners-2", 2, "older")];
    fs::write(&file, old.json()).unwrap();
    assert_eq!(prove(&places, &arguments).0, None);
    let rows = record(&places, "instances.json").rows;
    let rows: Vec<_> = rows.iter().map(|row| (row.text("family"), row.text("sources"))).collect();
    let today = today.as_str();
    assert_eq!(rows, [("corners-2", today), ("corners-any", today), ("corners-any", "older")]);
}

#[test]
fn a_wrong_length_fails_each_time() {
    let folder = tempfile::tempdir().unwrap();
    let places = places(folder.path(), "4.5");
    for arguments in [["--family", "centers-3"], ["--family", "centers-3"]] {
        let (error, text) = prove(&places, &arguments);
        let error = error.unwrap();
        assert!(
            error.contains("1 of 38 comparisons are wrong") && error.contains("a.map instance 0"),
            "{error}"
        );
        assert!(text.contains("1 wrong"), "{text}");
    }
}

/// The laws that prepare little, and a family of each kind.
#[test]
fn a_sample_holds_on_small_maps() {
    let folder = tempfile::tempdir().unwrap();
    let places = places(folder.path(), "5");
    let families = ["--family", "centers-3", "centers-any", "corners-2", "corners-4"];
    let laws = ["--law", "order-corners", "scaled", "repaired", "unit-costs", "threads"];
    let (error, text) = prove(&places, &[&["--sample"], &families[..], &laws[..]].concat());
    assert_eq!(error, None, "{text}");
    let (suites, digest) = text.trim_end().rsplit_once('\n').expect("some lines");
    assert_eq!(suites.lines().count(), 4 + 5, "{text}");
    assert!(
        suites.lines().all(|line| line.contains(" 0 wrong") && !line.contains(" 0 comparisons")),
        "{text}"
    );
    // The answers are the same on every run and platform.
    assert_eq!(digest, "digest of the families' answers: 38af2dd4a178be20");
    assert!(!places.kept.exists() && !places.records.exists());
    let (error, _) = prove(&places, &["--law", "gravity"]);
    assert!(
        error.is_some_and(|error| error.starts_with("`gravity` is none of order-corners, order-centers"))
    );
}
