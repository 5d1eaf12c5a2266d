//! `verify` succeeds with as many costs as expected, all of them right.
#![allow(clippy::unwrap_used, reason = "a test may fail")]

use std::{fs, path::Path};

use clap::Parser;
use mediant_bench::verify::{Options, run_in};

#[derive(Parser)]
struct Cli {
    #[command(flatten)]
    options: Options,
}

/// A cache whose set `dao` has one map with one query, of which the scenario says this length.
fn cache(optimal: &str) -> tempfile::TempDir {
    let cache = tempfile::tempdir().unwrap();
    let map = cache.path().join("dao").join("slalom.map");
    fs::create_dir(cache.path().join("dao")).unwrap();
    fs::write(&map, "type octile\nheight 3\nwidth 4\nmap\n....\n.@@.\n....\n").unwrap();
    let scenario = format!("version 1\n0\tslalom.map\t4\t3\t0\t1\t3\t1\t{optimal}\n");
    fs::write(map.with_extension("map.scen"), scenario).unwrap();
    cache
}

/// The error of `verify`, if any. Of the set's many instances there is one, so not every one is asked for.
fn verify(cache: &Path, arguments: &[&str]) -> Option<String> {
    let arguments = ["verify", "--every", "2"].iter().chain(arguments);
    run_in(cache, &Cli::parse_from(arguments).options, &mut Vec::new()).err().map(|error| error.to_string())
}

#[test]
fn costs_are_counted_over_all_engines() {
    let cache = cache("5");
    let engines = ["--engine", "astar", "jps-block", "--expect"];
    assert_eq!(verify(cache.path(), &[&engines[..], &["2"]].concat()), None);
    let wrong = verify(cache.path(), &[&engines[..], &["1_000"]].concat()).unwrap();
    assert!(wrong.contains("expected 1000 comparisons, made 2"), "{wrong}");
    assert_eq!(verify(cache.path(), &[]), None);
}

#[test]
fn wrong_costs_and_none_at_all_are_errors() {
    let wrong = verify(cache("4.5").path(), &["--expect", "1"]).unwrap();
    assert!(wrong.contains("1 of 1 costs differ") && wrong.contains("found 5.000000, known 4.5"), "{wrong}");
    let wrong = verify(tempfile::tempdir().unwrap().path(), &[]).unwrap();
    assert!(wrong.contains("nothing was compared"), "{wrong}");
    for engine in ["theta", "anya", "subgoal-theta"] {
        let wrong = verify(cache("5").path(), &["--engine", engine]).unwrap();
        assert!(wrong.contains(&format!("{engine} finds no paths over the moves of k = 3")), "{wrong}");
    }
}

/// The shortest path costs 5: those of engines that may find longer ones cost as much or more, and there are
/// some.
#[test]
fn paths_that_may_be_longer_are_never_shorter_nor_missing() {
    for engine in ["hpa", "chpa", "wavefront"] {
        let verify = |optimal| verify(cache(optimal).path(), &["--engine", engine, "--expect", "1"]);
        assert_eq!((verify("5"), verify("4.5")), (None, None), "{engine}");
        let wrong = verify("20").unwrap();
        assert!(wrong.contains("1 of 1 costs differ") && wrong.contains("known 20.000000"), "{wrong}");
        let wrong = verify("0").unwrap();
        assert!(wrong.contains("known no path"), "{wrong}");
    }
}

#[test]
fn references_are_those_of_the_problems_that_an_engine_solves() {
    let (cache, oracle) = (cache("5"), tempfile::tempdir().unwrap());
    let reference = |name: &str, row: &str| {
        fs::write(oracle.path().join(name), format!("index,cost\n{row}\n")).unwrap();
    };
    let folder = oracle.path().to_str().unwrap();
    reference("center-k3-slalom.csv", "0,5");
    reference("center-k5-slalom.csv", "0,5");
    // Between corners the straight line runs along the wall.
    reference("any-open-slalom.csv", "0,3");
    reference("any-closed-slalom.csv", "0,3.000002");
    reference("somewhere-else.csv", "0,0");
    // JPS by blocks knows no k = 5, and Theta* promises nothing. Anya is for every k and any at corners, and
    // so are subgoal graphs, which are also for k = 3 at centers.
    reference("corner-k5-slalom.csv", "0,3");
    let counts = [("astar", "3"), ("jps-block", "1"), ("anya", "3"), ("subgoal", "4"), ("hpa", "1")];
    for (engine, count) in counts {
        assert_eq!(verify(cache.path(), &["--oracle", folder, "--engine", engine, "--expect", count]), None);
    }
    let wrong = verify(cache.path(), &["--oracle", folder, "--engine", "theta"]).unwrap();
    assert!(wrong.contains("nothing was compared"), "{wrong}");
    reference("any-closed-slalom.csv", "0,3.000004");
    let wrong = verify(cache.path(), &["--oracle", folder, "--engine", "anya"]).unwrap();
    assert!(
        wrong.contains("1 of 3 costs differ") && wrong.contains("any-closed-slalom.csv instance 0"),
        "{wrong}"
    );
    reference("center-k5-slalom.csv", "0,4.9");
    let wrong = verify(cache.path(), &["--oracle", folder]).unwrap();
    assert!(wrong.contains("1 of 3 costs differ"), "{wrong}");
    reference("center-k5-slalom.csv", "zero");
    let wrong = verify(cache.path(), &["--oracle", folder]).unwrap();
    assert!(wrong.contains("no index and cost: `zero`"), "{wrong}");
}
