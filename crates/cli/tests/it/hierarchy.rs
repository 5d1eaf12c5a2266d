//! HPA* and CHPA* from the command line: what their options do, their indexes, and what they refuse.

use std::fs;

use serde_json::Value;

use crate::common::{Files, Ran, built, check_mismatch, redact_times, refused, run, told};

/// Status, cost, path and counts of each query: the same with a saved index.
fn answers(queries: &[Value]) -> Vec<[Value; 5]> {
    let keys = ["status", "cost", "path", "expanded", "fallbacks"];
    queries.iter().map(|query| keys.map(|key| query[key].clone())).collect()
}

/// The sum of a number over all queries.
fn total(queries: &[Value], key: &str) -> f64 {
    queries.iter().filter_map(|query| query[key].as_f64()).sum()
}

/// The records of a run, a line each, without what differs from machine to machine.
#[track_caller]
fn shown(line: &str) -> String {
    let (run, queries, summary) = told(line);
    let mut text = String::new();
    for mut record in [run].into_iter().chain(queries).chain([summary]) {
        let record_keys = record.as_object_mut().expect("an object");
        record_keys
            .retain(|key, _| !["nanos", "_ns", "version", "_bytes"].iter().any(|end| key.ends_with(end)));
        text += &format!("{record}\n");
    }
    text
}

#[test]
fn records_of_hpa() {
    insta::assert_snapshot!(shown("run builtin:town --engine hpa --levels 2 --side 5 --every 9"));
}

#[test]
fn records_of_chpa() {
    let options = "--side 4 --step 3 --detour 1 --heuristic euclidean --second squared";
    insta::assert_snapshot!(shown(&format!("run builtin:town --engine chpa {options} --every 9")));
}

#[test]
fn the_record_of_a_run_has_the_options() {
    let keys = ["levels", "side", "unstraightened", "heuristic", "second", "variant", "step", "detour"];
    let told = |options: &str| {
        let (run, ..) = told(&format!("run builtin:cave --limit 1 --engine {options}"));
        assert_eq!(run["guarantee"], "suboptimal", "{options}");
        Value::from(keys.map(|key| run[key].clone()).to_vec()).to_string()
    };
    let null = "null,null,null,null,null";
    for (options, expected) in [
        ("hpa --levels 1", format!("[1,10,false,{null}]")),
        ("hpa --side 4 --levels 2 --unstraightened", format!("[2,4,true,{null}]")),
        // Clusters of 10, 20, 40, 80 and 160 cells.
        ("hpa --levels all", format!("[5,10,false,{null}]")),
        ("hpa --levels all --side 64", format!("[3,64,false,{null}]")),
        ("chpa", r#"[null,3,false,"hk","hk","complete",2,3]"#.to_owned()),
        ("chpa --heuristic squared", r#"[null,3,false,"squared","squared","complete",2,3]"#.to_owned()),
        ("chpa --k 2 --side 7 --step 1", r#"[null,7,false,"hk","hk","complete",1,3]"#.to_owned()),
        ("chpa --second zero --detour 9", r#"[null,3,false,"hk","zero","complete",2,9]"#.to_owned()),
        ("chpa --variant paper --step 4", r#"[null,3,false,"hk","hk","paper",4,null]"#.to_owned()),
        ("astar --heuristic squared", r#"[null,null,false,"squared",null,null,null,null]"#.to_owned()),
    ] {
        assert_eq!(told(options), expected, "{options}");
    }
}

#[test]
fn every_option_reaches_the_planner() {
    let costs =
        |options: &str| total(&told(&format!("run builtin:archipelago --engine {options}")).1, "cost");
    let [exact, straightened, unstraightened] = ["astar", "hpa", "hpa --unstraightened"].map(costs);
    assert!(
        exact < straightened && straightened < unstraightened,
        "{exact}, {straightened}, {unstraightened}"
    );
    let mut different: Vec<String> = Vec::new();
    for options in [
        "",
        " --side 5",
        " --step 1",
        " --detour 1",
        " --second squared",
        " --second zero",
        " --heuristic squared --second hk",
        " --heuristic squared",
        " --smooth",
        " --smooth=taut",
    ] {
        let (_, queries, summary) = told(&format!("run builtin:archipelago --engine chpa{options}"));
        assert_eq!(summary["fallbacks"].as_f64(), Some(total(&queries, "fallbacks")), "{options}");
        assert!(total(&queries, "cost") > exact || options.starts_with(" --smooth"), "{options}");
        different.push(format!("{:?}", answers(&queries)));
    }
    let count = different.len();
    different.sort_unstable();
    different.dedup();
    assert_eq!(different.len(), count, "two setups do the same: are options lost?");
}

#[test]
fn the_table_says_how_often_a_plan_was_left() {
    let shown = |options: &str| redact_times(&run(&format!("run builtin:cave {options}")).stdout);
    let text = shown("--engine chpa --detour 1 --second squared");
    assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
    let head = "\nchpa, heuristic hk, variant complete, side 3, second heuristic squared, step 2,\n\
                detours up to 1 · k = 3 (8 moves) · center, corners never\nsuboptimal · prepared in TIME\n";
    assert!(text.contains(head), "{text}");
    let (_, queries, _) = told("run builtin:cave --engine chpa --detour 1 --second squared");
    let times = total(&queries, "fallbacks");
    assert!(times > 1.0 && text.contains(&format!("\n  plans      left {times} times\n")), "{text}");
    let left = queries.iter().find(|query| query["fallbacks"] == 1).expect("a plan that was left once");
    let [from, to] = [&left["start"], &left["goal"]].map(|at| format!("{},{}", at[0], at[1]));
    let text = shown(&format!("--engine chpa --detour 1 --second squared --from {from} --to {to}"));
    assert!(text.contains("\n  plan  left once\n"), "{text}");
    let text = shown("--engine hpa --levels 1 --unstraightened");
    assert!(
        text.contains("\nhpa, 1 level, side 10, paths not straightened · k = 3 (8 moves) ·")
            && !text.contains("plan"),
        "{text}"
    );
}

#[test]
fn a_saved_index_gives_the_same_answers() {
    let files = Files::new();
    for (built_with, more) in [
        ("--engine hpa", ""),
        ("--engine hpa --k 2 --corners always --levels 1", " --unstraightened"),
        ("--engine hpa --side 4 --levels all", " --smooth=taut"),
        ("--engine chpa", ""),
        ("--engine chpa --k 2 --corners one --side 5", " --step 1 --second squared"),
        ("--engine chpa --side 2", " --heuristic zero --detour 1"),
    ] {
        let index = built(&files, "town.idx", &format!("builtin:town {built_with}"));
        let (new_run, new, _) = told(&format!("run builtin:town {built_with}{more}"));
        // Options that are left out are those of the index.
        let without: Vec<&str> =
            built_with.split(" --side").next().expect("a part").split(" --levels").collect();
        for options in [built_with, without[0]] {
            let (run, saved, _) = told(&format!("run builtin:town {options}{more} --index {index}"));
            assert_eq!((saved.len(), answers(&saved)), (22, answers(&new)), "{options}");
            for key in ["levels", "side", "index_bytes"] {
                assert_eq!(run[key], new_run[key], "{options}: {key}");
            }
            assert!(run["preprocess_ns"].as_u64() > Some(0), "{options}");
        }
    }
    let line = format!("build builtin:cave --engine chpa -o {}", files.path("cave.idx"));
    let text = redact_times(&run(&line).stdout);
    // The key of the index, the side, a byte for each of 24 × 12 segments, a checksum.
    assert_eq!(text, "cave.idx · chpa of cave.map · 428 bytes · built in TIME\n");
}

#[test]
fn an_index_for_something_else_is_refused() {
    let files = Files::new();
    let clusters = built(&files, "hpa.idx", "builtin:cave --engine hpa --levels 2");
    let segments = built(&files, "chpa.idx", "builtin:cave --engine chpa --k 2");
    let again = "or prepare it again";
    let levels = |named: &str| {
        let found = "found one with 2 levels; choose the levels that it has";
        format!("hpa.idx: needs an index with {named}, {found}, {again}")
    };
    let side = |file: &str, named: u32, found: u32| {
        let needs = format!("needs an index whose clusters or segments have {named} × {named} cells");
        let found = format!("found one with {found} × {found}; choose the side that it has");
        format!("{file}: {needs}, {found}, {again}")
    };
    let other = "hpa.idx: expected an index of the engine chpa, found one of hpa; choose that engine";
    for (options, message) in [
        (format!("--engine hpa --levels 1 --index {clusters}"), levels("1 level")),
        (format!("--engine hpa --levels all --index {clusters}"), levels("5 levels")),
        (format!("--engine hpa --side 8 --index {clusters}"), side("hpa.idx", 8, 10)),
        (format!("--engine chpa --k 2 --side 4 --index {segments}"), side("chpa.idx", 4, 3)),
        (format!("--engine chpa --index {clusters}"), format!("{other}, or prepare it again")),
    ] {
        assert_eq!(refused(&files, &format!("run builtin:cave {options}")), format!("error: {message}\n"));
    }
    let [two, three] = ["center, corners never, k = 2", "center, corners never, k = 3"];
    for (options, file, identities) in [
        (format!("cave --engine hpa --k 2 --index {clusters}"), "hpa.idx", [three, two]),
        (
            format!("cave --engine chpa --k 2 --corners one --index {segments}"),
            "chpa.idx",
            [two, "center, corners one, k = 2"],
        ),
        (format!("maze --engine hpa --index {clusters}"), "hpa.idx", [three, three]),
    ] {
        check_mismatch(&refused(&files, &format!("run builtin:{options}")), file, identities);
    }
    for (engine, index) in [("hpa", clusters), ("chpa --k 2", segments)] {
        let line = format!("run builtin:cave --engine {engine} --index {}", files.path("damaged.idx"));
        let whole = fs::read(&index).expect("the index");
        for i in 0..=20 {
            let mut bytes = whole.clone();
            let bit = i * (8 * whole.len() - 1) / 20;
            bytes[bit / 8] ^= 1 << (bit % 8);
            files.add("damaged.idx", &bytes);
            let message = refused(&files, &line);
            assert!(message.starts_with("error: damaged.idx: expected "), "bit {bit}: {message}");
            files.add("damaged.idx", &whole[..i * (whole.len() - 1) / 20]);
            let message = refused(&files, &line);
            assert!(message.starts_with("error: damaged.idx: expected "), "{i} of 20 parts: {message}");
        }
    }
}

#[test]
fn options_that_an_engine_does_not_take_are_refused() {
    let files = Files::new();
    let choose = "leave it out, or choose";
    let small = "not k = 3 with corners one: choose one of these, or another engine";
    for (options, message) in [
        ("--engine astar --side 3", "astar takes no side: leave it out, or choose hpa, chpa".to_owned()),
        ("--engine subgoal --side 3", "subgoal takes no side: leave it out, or choose hpa, chpa".to_owned()),
        ("--engine chpa --levels 2", format!("chpa takes no levels: {choose} subgoal, subgoal-theta, hpa")),
        ("--engine chpa --unstraightened", format!("chpa takes no option unstraightened: {choose} hpa")),
        ("--engine hpa --second hk", "hpa takes no second heuristic: leave it out, or choose chpa".to_owned()),
        ("--engine hpa --step 2", "hpa takes no step: leave it out, or choose chpa".to_owned()),
        ("--engine astar --detour 2", "astar takes no detour: leave it out, or choose chpa".to_owned()),
        ("--engine hpa --variant paper", "hpa takes no variant: leave it out, or choose canonical, chpa".to_owned()),
        (
            "--engine chpa --variant exact",
            "chpa takes no variant exact: leave it out, or choose canonical".to_owned(),
        ),
        (
            "--engine canonical --variant complete",
            "canonical takes no variant complete: leave it out, or choose chpa".to_owned(),
        ),
        (
            "--engine chpa --variant paper --detour 2",
            "chpa as published has no limit to detours: leave out the detour, or choose the variant \
             complete".to_owned(),
        ),
        (
            "--engine hpa --heuristic squared",
            "hpa takes no heuristic: leave it out, or choose astar, canonical, jps, jps-block, jps-plus, theta, \
             lazy-theta, chpa"
                .to_owned(),
        ),
        (
            "--engine jps --heuristic squared",
            "jps takes no heuristic that overestimates: leave it out, or choose astar, chpa".to_owned(),
        ),
        ("--engine hpa --corners one", format!("at centers hpa takes k = 2, or k = 3 with corners never, {small}")),
        ("--engine chpa --corners one", format!("at centers chpa takes k = 2, or k = 3 with corners never, {small}")),
        ("--engine hpa --k 4", "hpa needs a k from 2 to 3, found 4 (16 neighbors)".to_owned()),
        ("--engine chpa --k any", "chpa needs a k from 2 to 3; for any choose anya, subgoal".to_owned()),
        (
            "--engine chpa --placement corner",
            "chpa needs placement center; for corner choose astar, dijkstra, wavefront, canonical, jps, \
             jps-block, jps-plus, \
             theta, lazy-theta, anya, subgoal, subgoal-theta, landmarks"
                .to_owned(),
        ),
        ("--engine hpa --side 65", "a cluster or segment of 65 × 65 cells: the side must be 2 to 64".to_owned()),
        ("--engine chpa --side 64", "a cluster or segment of 64 × 64 cells: the side must be 1 to 63".to_owned()),
        (
            "--engine hpa --levels 6",
            "6 levels of clusters, the lowest of 10 × 10 cells: there must be at least one level, and the \
             clusters of the highest at most 256 \
             cells long"
                .to_owned(),
        ),
    ] {
        assert_eq!(refused(&files, &format!("run builtin:cave {options}")), format!("error: {message}\n"));
    }
}

#[test]
fn numbers_of_the_options_begin_at_one() {
    let files = Files::new();
    for option in ["side", "step", "detour"] {
        for (wrong, found) in [
            ("0", " of 1 or more, found 0"),
            ("-1", " of 1 or more, found -1"),
            ("x", ", found the text 'x'"),
        ] {
            let message = refused(&files, &format!("run builtin:cave --engine chpa --{option} {wrong}"));
            let expected =
                format!("invalid value '{wrong}' for '--{option} <N>': expected an integer{found}");
            assert_eq!(message, format!("error: {expected}; see --help\n"));
        }
    }
}

/// CHPA* as published joins two segments beside each other if a path leads from the left side of the first to
/// the second. Here that side is blocked.
#[test]
fn a_query_that_is_given_up_is_an_error() {
    let files = Files::new();
    let map = files.add("nook.map", "type octile\nheight 3\nwidth 6\nmap\n@@....\n@@@...\n@@@...\n");
    let line = format!("run {map} --from 2,0 --to 5,0 --engine chpa");
    let (_, queries, summary) = told(&line);
    assert_eq!((&queries[0]["status"], &queries[0]["cost"]), (&"found".into(), &3.0.into()));
    assert_eq!((&queries[0]["fallbacks"], &summary["fallbacks"]), (&1.into(), &1.into()));
    let Ran { status, stdout, stderr } = run(&format!("{line} --variant paper --format jsonl"));
    let why = "no path was found, though there is one: the segments of its ends are not connected";
    assert_eq!((status, stderr), (Some(1), format!("error: {why}\n")));
    let records: Vec<Value> =
        stdout.lines().map(|line| serde_json::from_str(line).expect("each line is JSON")).collect();
    let query = &records[1];
    assert_eq!((&query["status"], &query["error"]), (&"error".into(), &why.into()));
    assert_eq!(
        (&query["cost"], &query["path"], &query["nanos"]),
        (&Value::Null, &serde_json::json!([]), &0.into())
    );
    assert_eq!(records[2]["errors"], 1);
}
