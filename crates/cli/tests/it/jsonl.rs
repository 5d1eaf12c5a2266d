//! `--format jsonl`: the records that scripts rely on.

use std::{
    collections::BTreeSet,
    io::{BufRead, BufReader},
    process::{Command, Stdio},
    sync::{Arc, mpsc},
    thread,
    time::Duration,
};

use mediant_formats::{MapFile, Scenario};
use mediant_grid::{Centers, CornerRule, Corners, DiagonalGap, Grid, GridGraph, Placement, Rules};
use mediant_moves::FiniteK;
use mediant_search::{AStar, Counters, Ends, Hk, Path, Planner};
use serde_json::Value;

use crate::common::{Files, Ran, bundled, mediant, run};

/// Runs a command that answers all its queries, and parses each line.
#[track_caller]
pub(crate) fn records(args: &[&str]) -> Vec<Value> {
    let Ran { status, stdout, stderr } = mediant(args);
    assert_eq!((stderr.as_str(), status), ("", Some(0)), "{args:?}");
    stdout.lines().map(|line| serde_json::from_str(line).expect("each line is JSON")).collect()
}

/// The records of the run and of its queries, and the summary.
#[track_caller]
pub(crate) fn parts(records: &[Value]) -> (&Value, &[Value], &Value) {
    let [run, queries @ .., summary] = records else { panic!("too few records: {records:?}") };
    assert_eq!((&run["type"], &summary["type"]), (&Value::from("run"), &Value::from("summary")));
    assert!(queries.iter().all(|query| query["type"] == "query"));
    (run, queries, summary)
}

/// The keys of a record.
fn keys(record: &Value) -> BTreeSet<&str> {
    record.as_object().expect("an object").keys().map(String::as_str).collect()
}

/// The records of our own scenario of the bundled map `cave`, read from files.
#[track_caller]
fn cave() -> Vec<Value> {
    records(&[
        "run",
        &bundled("cave.map"),
        "--scen",
        &bundled("cave.map.scen"),
        "--engine",
        "astar",
        "--format",
        "jsonl",
    ])
}

/// The keys of a run's record that scripts rely on.
const RUN_KEYS: [&str; 11] = [
    "type",
    "map",
    "engine",
    "k",
    "placement",
    "corners",
    "gap",
    "smooth",
    "guarantee",
    "preprocess_ns",
    "index_bytes",
];

/// The keys of a query's record.
const QUERY_KEYS: [&str; 20] = [
    "type",
    "index",
    "start",
    "goal",
    "status",
    "cost",
    "path",
    "reference",
    "expanded",
    "generated",
    "percolations",
    "updated",
    "scanned",
    "fallbacks",
    "smoothness",
    "lower_bound",
    "bound",
    "any_angle",
    "ratio",
    "nanos",
];

#[test]
fn the_record_of_a_run_is_complete() {
    let records = cave();
    let (run, ..) = parts(&records);
    assert!(keys(run).is_superset(&RUN_KEYS.into()), "{run}");
    let expected: Value = serde_json::json!({
        "map": "cave.map", "scenario": "cave.map.scen", "queries": 32, "repeat": 1,
        "engine": "astar", "k": 3, "placement": "center", "corners": "never", "gap": "open",
        "heuristic": "hk", "variant": null, "jump_limit": null, "keep_intermediate": false,
        "levels": null, "side": null, "landmarks": null, "unstraightened": false, "second": null, "step": null,
        "detour": null,
        "smooth": false, "smoothing": null, "any_angle": null, "guarantee": "optimal(3)",
    });
    for (key, value) in expected.as_object().expect("an object") {
        assert_eq!(&run[key], value, "{key}");
    }
    assert!(run["preprocess_ns"].as_u64() > Some(0));
    // The components alone take four bytes for each word of 64 cells.
    assert!(run["index_bytes"].as_u64() > Some(72 * 36 / 16), "{run}");
}

#[test]
fn the_record_of_every_query_is_complete() {
    let records = cave();
    let (_, queries, summary) = parts(&records);
    assert_eq!(queries.len(), 32);
    let scenario = Scenario::read(bundled("cave.map.scen")).expect("our own scenario");
    for (i, (query, instance)) in queries.iter().zip(scenario.instances()).enumerate() {
        assert_eq!(keys(query), QUERY_KEYS.into(), "no `error` where there is none: {query}");
        assert_eq!((query["index"].as_u64(), &query["status"]), (Some(i as u64), &Value::from("found")));
        let (start, goal) = (
            serde_json::json!([instance.start.x, instance.start.y]),
            serde_json::json!([instance.goal.x, instance.goal.y]),
        );
        let path = query["path"].as_array().expect("waypoints");
        assert_eq!((&query["start"], &query["goal"]), (&start, &goal));
        assert_eq!((path.first(), path.last()), (Some(&start), Some(&goal)));
        assert_eq!(query["reference"].as_f64(), Some(instance.optimal));
        assert!(query["nanos"].as_u64() > Some(0) && query["expanded"].as_u64() > Some(0));
    }
    assert_eq!((&summary["queries"], &summary["fallbacks"]), (&32.into(), &0.into()));
    let total: u64 = queries.iter().filter_map(|query| query["nanos"].as_u64()).sum();
    assert_eq!(summary["total_nanos"].as_u64(), Some(total));
}

#[test]
fn indices_count_the_instances_of_the_scenario() {
    let indices = |options: &str| {
        let line = format!("run builtin:cave --format jsonl{options}");
        let records = records(&line.split(' ').collect::<Vec<_>>());
        let (_, queries, _) = parts(&records);
        queries.iter().filter_map(|query| query["index"].as_u64()).collect::<Vec<_>>()
    };
    assert_eq!(indices(""), (0..32).collect::<Vec<_>>());
    assert_eq!(indices(" --every 10"), [0, 10, 20, 30]);
    assert_eq!(indices(" --every 10 --limit 2"), [0, 10]);
    assert_eq!(indices(" --limit 99 --every 99"), [0]);
}

#[test]
fn errors_and_missing_paths_are_records() {
    let files = Files::new();
    let map = files.add("walls.map", "type octile\nheight 1\nwidth 4\nmap\n.@..\n");
    let line = |x: i32, goal: i32| format!("0\twalls.map\t4\t1\t{x}\t0\t{goal}\t0\t1\n");
    let scenario = files
        .add("walls.scen", format!("version 1\n{}{}{}{}", line(0, 2), line(-1, 0), line(3, 2), line(2, 1)));
    let Ran { status, stdout, .. } = mediant(&["run", &map, "--scen", &scenario, "--format", "jsonl"]);
    assert_eq!(status, Some(1));
    let records: Vec<Value> =
        stdout.lines().map(|line| serde_json::from_str(line).expect("each line is JSON")).collect();
    let (_, queries, summary) = parts(&records);
    let statuses: Vec<_> = queries.iter().filter_map(|query| query["status"].as_str()).collect();
    assert_eq!(statuses, ["unreachable", "error", "found", "error"]);
    for query in queries.iter().filter(|query| query["status"] != "found") {
        assert_eq!((&query["cost"], &query["path"]), (&Value::Null, &serde_json::json!([])));
    }
    let errors: Vec<_> = queries.iter().map(|query| query["error"].as_str()).collect();
    let outside = "the start (-1, 0) is outside the map, whose vertices run from (0, 0) to (3, 0)";
    let blocked = "the goal (1, 0) is blocked: choose a free vertex; the nearest one is (0, 0)";
    assert_eq!(errors, [None, Some(outside), None, Some(blocked)]);
    assert_eq!(summary["errors"].as_u64(), Some(2));
}

#[test]
fn a_mean_of_no_cost_is_null() {
    let files = Files::new();
    let map = files.add("walls.map", "type octile\nheight 1\nwidth 3\nmap\n.@.\n");
    let records = records(&["run", &map, "--from", "0,0", "--to", "2,0", "--format", "jsonl"]);
    let (_, _, summary) = parts(&records);
    assert_eq!((&summary["unreachable"], &summary["mean_cost"]), (&Value::from(1), &Value::Null));
}

#[test]
fn lines_come_while_the_run_goes_on() {
    // A line may wait for a second. The first queries take about that long, all of them minutes.
    let line = "run builtin:cave --repeat 3000000 --format jsonl";
    let mut command = Command::new(env!("CARGO_BIN_EXE_mediant"));
    let mut child = command.args(line.split(' ')).stdout(Stdio::piped()).spawn().expect("the program starts");
    let stdout = BufReader::new(child.stdout.take().expect("a pipe"));
    let (sender, receiver) = mpsc::channel();
    let reader = thread::spawn(move || {
        // The receiver goes after two lines.
        stdout.lines().map_while(Result::ok).try_for_each(|line| sender.send(line)).is_ok()
    });
    let lines = [(); 2].map(|()| receiver.recv_timeout(Duration::from_secs(120)));
    let ended = child.try_wait().expect("a child to ask about");
    child.kill().expect("a child to stop");
    child.wait().expect("a child that was stopped");
    drop(receiver);
    reader.join().expect("the reader ends");
    let types = lines.map(|line| {
        let record: Value = serde_json::from_str(&line.expect("a line in time")).expect("each line is JSON");
        record["type"].clone()
    });
    assert_eq!((types, ended), ([Value::from("run"), Value::from("query")], None));
}

#[test]
fn our_own_scenarios_are_right() {
    // Their lengths were computed by another program's Dijkstra.
    for (name, instances) in [("archipelago", 40), ("cave", 32), ("maze", 40), ("town", 22)] {
        let records = records(&["run", &format!("builtin:{name}"), "--format", "jsonl"]);
        let (run, queries, summary) = parts(&records);
        assert_eq!(run["map"], format!("{name}.map"));
        assert_eq!(queries.len(), instances, "{name}");
        for query in queries {
            let (cost, reference) = (query["cost"].as_f64(), query["reference"].as_f64());
            let (cost, reference) = (cost.expect("a path"), reference.expect("a reference"));
            assert!((cost - reference).abs() < 1e-7, "{name}: {query}");
        }
        assert_eq!(summary["reference"]["equal"].as_u64(), Some(instances as u64), "{name}");
    }
}

/// A length in billionths of a cell: reading it as JSON may change its last bit.
fn nanocells(length: f64) -> u64 {
    (length * 1e9).round() as u64
}

/// For each query of a scenario the cost, and the expanded, generated and percolated nodes of the library's
/// A*.
fn library<P: Placement>(
    grid: &Arc<Grid>,
    k: u32,
    rule: P::Rule,
    scenario: &Scenario,
) -> Vec<(Option<u64>, u64, u64, u64)> {
    let k = FiniteK::new(k).expect("a k");
    let grid_graph = GridGraph::<P>::new(grid.clone(), k, rule).expect("a grid graph");
    let mut planner = AStar::new(&grid_graph, Hk);
    let mut solve = |query| {
        let mut counters = Counters::default();
        let answer = planner.solve_observed(query, &mut counters).expect("free ends");
        (
            answer.path().map(|path| nanocells(path.cost())),
            counters.expanded,
            counters.generated,
            counters.percolations,
        )
    };
    scenario.instances().iter().map(|instance| solve(Ends::new(instance.start, instance.goal))).collect()
}

#[test]
fn every_option_reaches_the_planner() {
    let (map, scen) = (bundled("town.map"), bundled("town.map.scen"));
    let grid = Arc::new(MapFile::read(&map).expect("our own map").to_grid());
    let scenario = Scenario::read(&scen).expect("our own scenario");
    let mut different = BTreeSet::new();
    for rules in Rules::ALL {
        for k in [2, 3, 5, 12] {
            let (expected, options) = match rules {
                Rules::Center(corners) => (
                    library::<Centers>(&grid, k, corners, &scenario),
                    match corners {
                        CornerRule::Never => ["--corners", "never"],
                        CornerRule::One => ["--corners", "one"],
                        CornerRule::Always => ["--corners", "always"],
                    },
                ),
                Rules::Corner(gap) => (
                    library::<Corners>(&grid, k, gap, &scenario),
                    match gap {
                        DiagonalGap::Open => ["--gap", "open"],
                        DiagonalGap::Closed => ["--gap", "closed"],
                    },
                ),
                Rules::CenterGap(_) => unreachable!("it is not among those over N(k)"),
            };
            let (k, placement) = (k.to_string(), rules.placement().to_string());
            let args = [
                "run",
                &map,
                "--scen",
                &scen,
                "--engine",
                "astar",
                "--k",
                &k,
                "--placement",
                &placement,
                "--format",
                "jsonl",
            ];
            let records = records(&[&args[..], &options[..]].concat());
            let (run, queries, _) = parts(&records);
            assert_eq!((&run["placement"], &run["k"].to_string()), (&Value::from(placement), &k));
            assert_eq!(run[&options[0][2..]], options[1]);
            let count = |query: &Value, name: &str| query[name].as_u64().expect("a count");
            let found: Vec<_> = queries
                .iter()
                .map(|query| {
                    (
                        query["cost"].as_f64().map(nanocells),
                        count(query, "expanded"),
                        count(query, "generated"),
                        count(query, "percolations"),
                    )
                })
                .collect();
            assert_eq!(found, expected, "{rules}, k = {k}");
            different.insert(format!("{found:?}"));
        }
    }
    // At k = 2 no move passes a corner point, so that the corner rules agree, and town has few gaps.
    assert!(different.len() >= 14, "only {} of 20 setups differ: are options lost?", different.len());
}

/// The run record and the queries of the town's scenario with these options.
fn town(options: &str) -> (Value, Vec<Value>) {
    let line = format!("run builtin:town --format jsonl{options}");
    let records = records(&line.split(' ').collect::<Vec<_>>());
    let (run, queries, _) = parts(&records);
    (run.clone(), queries.to_vec())
}

/// The cost of each query.
fn costs(queries: &[Value]) -> Vec<Option<u64>> {
    queries.iter().map(|query| query["cost"].as_f64().map(nanocells)).collect()
}

/// The sum of a count over all queries.
fn sum(queries: &[Value], count: &str) -> u64 {
    queries.iter().filter_map(|query| query[count].as_u64()).sum()
}

#[test]
fn every_exact_engine_costs_the_same() {
    for k in [2, 3, 4] {
        let (_, astar) = town(&format!(" --engine astar --k {k}"));
        assert_eq!(sum(&astar, "scanned"), 0);
        for engine in ["dijkstra", "canonical", "jps", "jps-block", "jps-plus"] {
            if k > 3 && ["jps-block", "jps-plus"].contains(&engine) {
                continue;
            }
            let (run, queries) = town(&format!(" --k {k} --engine {engine}"));
            assert_eq!(
                (&run["engine"], &run["guarantee"]),
                (&engine.into(), &format!("optimal({k})").into())
            );
            assert_eq!(costs(&queries), costs(&astar), "{engine}, k = {k}");
        }
    }
    let (run, wavefront) = town(" --engine wavefront --k 2");
    assert_eq!(run["guarantee"], "optimal(2)");
    assert_eq!(costs(&wavefront), costs(&town(" --k 2").1));
    assert_eq!(town(" --engine wavefront").0["guarantee"], "suboptimal");
}

#[test]
fn variants_and_jump_options_reach_the_planner() {
    let (exact, by_default) =
        (town(" --engine canonical --variant exact --k 5"), town(" --engine canonical --k 5"));
    assert_eq!((&exact.0["variant"], &by_default.0["variant"]), (&"exact".into(), &"exact".into()));
    assert_eq!(sum(&exact.1, "generated"), sum(&by_default.1, "generated"));
    let (run, paper) = town(" --engine canonical --variant paper --k 5");
    assert_eq!((&run["variant"], &run["guarantee"]), (&"paper".into(), &"suboptimal".into()));
    assert_ne!(sum(&paper, "generated"), sum(&exact.1, "generated"));
    let cost = |queries: &[Value]| costs(queries).into_iter().flatten().sum::<u64>();
    assert!(cost(&paper) >= cost(&exact.1));

    let (run, far) = town(" --engine jps");
    assert_eq!((&run["variant"], &run["jump_limit"]), (&Value::Null, &Value::Null));
    let (run, bounded) = town(" --engine jps --jump-limit 3");
    assert_eq!(run["jump_limit"].as_u64(), Some(3));
    assert!(sum(&bounded, "expanded") > sum(&far, "expanded"));
    let (run, kept) = town(" --engine jps --keep-intermediate");
    assert_eq!((&run["keep_intermediate"], &run["type"]), (&true.into(), &"run".into()));
    assert!(sum(&kept, "expanded") != sum(&far, "expanded"));
    assert_eq!((costs(&bounded), costs(&kept)), (costs(&far), costs(&far)));
    assert!(sum(&far, "scanned") > 0);
}

#[test]
fn smoothness_is_that_of_the_path() {
    let (_, queries) = town(" --engine astar --k 4 --placement corner");
    for query in &queries {
        let waypoints = query["path"].as_array().expect("a path").iter().map(|at| {
            let x = |i: usize| at[i].as_i64().expect("a coordinate") as i32;
            (x(0), x(1)).into()
        });
        let expected = Path::new(waypoints.collect()).smoothness();
        let found = query["smoothness"].as_f64().expect("a number");
        assert!((found - expected).abs() < 1e-9, "{query}");
    }
    let mean =
        queries.iter().filter_map(|query| query["smoothness"].as_f64()).sum::<f64>() / queries.len() as f64;
    let records = records(
        &"run builtin:town --engine astar --k 4 --placement corner --format jsonl"
            .split(' ')
            .collect::<Vec<_>>(),
    );
    let (_, _, summary) = parts(&records);
    assert!((summary["mean_smoothness"].as_f64().expect("a number") - mean).abs() < 1e-9);
    assert!(summary["mean_updated"].as_f64() > Some(0.0) && summary["mean_scanned"].as_f64() == Some(0.0));
}

#[test]
fn a_saved_index_gives_the_same_answers() {
    let files = Files::new();
    let index = files.path("town.idx");
    let rules: [&[&str]; 3] =
        [&[], &["--k", "2", "--corners", "always"], &["--placement", "corner", "--gap", "closed"]];
    for options in rules {
        let build = ["build", "builtin:town", "--engine", "jps-plus", "-o", &index];
        assert_eq!(mediant(&[&build[..], options].concat()).status, Some(0));
        let run = ["run", "builtin:town", "--engine", "jps-plus", "--format", "jsonl"];
        let new = records(&[&run[..], options].concat());
        let saved = records(&[&run[..], options, &["--index", &index]].concat());
        let told = |records: &[Value]| {
            let (run, queries, _) = parts(records);
            assert!(run["preprocess_ns"].as_u64() > Some(0));
            let queries = queries.iter().map(|query| (query["path"].clone(), query["expanded"].clone()));
            (run["index_bytes"].clone(), queries.collect::<Vec<_>>())
        };
        assert_eq!(told(&saved), told(&new), "{options:?}");
    }
}

#[test]
fn heuristics_change_the_counts_and_not_the_costs() {
    let sums = |heuristic: &str| {
        let records = records(&[
            "run",
            "builtin:archipelago",
            "--k",
            "4",
            "--heuristic",
            heuristic,
            "--format",
            "jsonl",
        ]);
        let (run, _, summary) = parts(&records);
        assert_eq!(run["heuristic"], heuristic);
        (summary["mean_cost"].as_f64().expect("a cost"), summary["mean_expanded"].as_f64().expect("a count"))
    };
    let [hk, euclidean, zero] = ["hk", "euclidean", "zero"].map(sums);
    assert!((hk.0 - euclidean.0).abs() < 1e-9 && (hk.0 - zero.0).abs() < 1e-9);
    assert!(hk.1 < euclidean.1 && euclidean.1 < zero.1, "{hk:?} {euclidean:?} {zero:?}");
}

#[test]
fn the_same_run_gives_the_same_answers() {
    let answers = || {
        let Ran { stdout, .. } = run("run builtin:maze --k 7 --placement corner --format jsonl --repeat 2");
        let mut records: Vec<Value> =
            stdout.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
        for record in &mut records {
            let record = record.as_object_mut().expect("an object");
            record.retain(|key, _| !key.ends_with("nanos") && key != "preprocess_ns");
        }
        records
    };
    assert_eq!(answers(), answers());
}
