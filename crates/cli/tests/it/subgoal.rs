//! Subgoal graphs from the command line: built, saved, loaded, and refused if they do not fit.

use std::{fs, path::Path};

use mediant_formats::{IndexFile, IndexKey};
use mediant_grid::{CornerRule, DiagonalGap, Identity, Rules};
use mediant_moves::K;
use serde_json::Value;

use crate::common::{Files, Ran, built, check_mismatch, mediant, redact_times, refused, run, told};

/// Status, cost and path of each query: the same with a saved index.
fn answers(queries: &[Value]) -> Vec<[Value; 3]> {
    queries.iter().map(|query| ["status", "cost", "path"].map(|key| query[key].clone())).collect()
}

#[test]
fn a_saved_graph_gives_the_same_answers() {
    let files = Files::new();
    for (options, levels) in [
        ("--engine subgoal", "labels".into()),
        ("--engine subgoal --k 2 --corners always", "labels".into()),
        ("--engine subgoal --levels contracted", "contracted".into()),
        ("--engine subgoal --memory 1kB", "contracted".into()),
        ("--engine subgoal --levels labels", "labels".into()),
        ("--engine subgoal --levels 1", 1.into()),
        ("--engine subgoal --placement corner --k 4 --gap closed --levels 2", 2.into()),
        ("--engine subgoal --placement corner --k 8 --levels all", "all".into()),
        ("--engine subgoal --k any", "labels".into()),
        ("--engine subgoal --k any --gap closed --levels 2", 2.into()),
        ("--engine subgoal-theta --k 5", 2.into()),
        ("--engine subgoal-theta --levels all", "all".into()),
    ] {
        let index = built(&files, "town.idx", &format!("builtin:town {options}"));
        let (run, new, _) = told(&format!("run builtin:town {options}"));
        let (with, saved, _) = told(&format!("run builtin:town {options} --index {index}"));
        assert_eq!((&run["levels"], &with["levels"]), (&levels, &levels), "{options}");
        assert_eq!((new.len(), answers(&saved)), (22, answers(&new)), "{options}");
        assert_eq!(
            (&run["index_bytes"], &run["heuristic"]),
            (&with["index_bytes"], &Value::Null),
            "{options}"
        );
        assert!(with["preprocess_ns"].as_u64() > Some(0), "{options}");
    }
}

#[test]
fn costs_are_those_of_engines_without_a_graph() {
    for (options, same) in [
        ("--corners never", "--engine jps"),
        ("--k 2 --corners one", "--engine astar --k 2 --corners one"),
        ("--placement corner --k 6 --gap closed", "--engine canonical --placement corner --k 6 --gap closed"),
        ("--k any", "--engine anya"),
    ] {
        let costs = |line: &str| -> Vec<u64> {
            let cost = |query: &Value| query["cost"].as_f64().map(|cost| (cost * 1e9).round() as u64);
            told(line).1.iter().map(|query| cost(query).expect("there is a path")).collect()
        };
        for map in ["town", "archipelago", "maze", "cave"] {
            let subgoal = costs(&format!("run builtin:{map} --engine subgoal {options}"));
            assert_eq!(subgoal, costs(&format!("run builtin:{map} {same}")), "{map}, {options}");
        }
    }
}

#[test]
fn an_index_says_which_levels_it_has() {
    let files = Files::new();
    let index = built(&files, "cave.idx", "builtin:cave --engine subgoal --levels 2");
    let (run, ..) = told(&format!("run builtin:cave --engine subgoal --index {index}"));
    assert_eq!(run["levels"], 2);
    let line = format!("run builtin:cave --engine subgoal --index {index} --levels");
    for (levels, name) in [("1", "1 level"), ("all", "all levels"), ("labels", "hub labels")] {
        let message = format!(
            "error: cave.idx: needs an index with {name}, found one with 2 levels; choose the levels that \
             it has, or prepare it again\n"
        );
        assert_eq!(refused(&files, &format!("{line} {levels}")), message);
    }
    let shown = |line: &str| redact_times(&crate::common::run(line).stdout);
    let text = shown(&format!("run builtin:cave --engine subgoal --index {index} --limit 1"));
    assert!(
        text.contains(
            "\nsubgoal, 2 levels · k = 3 (8 moves) · center, corners never\noptimal(3) · prepared in TIME\n"
        ),
        "{text}"
    );
    let text = shown("run builtin:cave --engine subgoal --k any --limit 1");
    assert!(text.contains("\nsubgoal, hub labels · k = any · corner, gap open\noptimal(any) · "), "{text}");
    let stdout = shown(&format!("build builtin:cave --engine subgoal -o {index}"));
    assert!(
        stdout.starts_with("cave.idx · subgoal of cave.map · ")
            && stdout.ends_with(" bytes · built in TIME\n"),
        "{stdout}"
    );
}

#[test]
fn an_index_for_something_else_is_refused() {
    let files = Files::new();
    let index = built(&files, "cave.idx", "builtin:cave --engine subgoal --placement corner");
    let refused = |options: &str| refused(&files, &format!("run {options} --index {index}"));
    let again = "or prepare it again";
    for (options, message) in [
        (
            "--engine subgoal-theta",
            "expected an index of the engine subgoal-theta, found one of subgoal; choose that engine",
        ),
        (
            "--engine jps-plus --placement corner",
            "expected an index of the engine jps-plus, found one of subgoal; choose that engine",
        ),
    ] {
        assert_eq!(
            refused(&format!("builtin:cave {options}")),
            format!("error: cave.idx: {message}, {again}\n")
        );
    }
    for (options, needed) in [
        ("cave --engine subgoal --placement corner --k 4", "corner, gap open, k = 4"),
        ("cave --engine subgoal --k any", "corner, gap open, k = any"),
        ("cave --engine subgoal --placement corner --gap closed", "corner, gap closed, k = 3"),
        ("cave --engine subgoal", "center, corners never, k = 3"),
        ("maze --engine subgoal --placement corner", " of 69 columns and 33 rows, corner, gap open, k = 3"),
    ] {
        let built = " of 72 columns and 36 rows, corner, gap open, k = 3";
        check_mismatch(&refused(&format!("builtin:{options}")), "cave.idx", [built, needed]);
    }
    let none = refused("builtin:cave --engine jps");
    assert_eq!(
        none,
        "error: jps has no index: choose jps-plus, subgoal, subgoal-theta, hpa, chpa, landmarks\n"
    );
}

#[test]
fn a_damaged_index_is_refused() {
    let files = Files::new();
    let index = built(&files, "cave.idx", "builtin:cave --engine subgoal --k any");
    let whole = fs::read(&index).expect("the index");
    let line = format!("run builtin:cave --engine subgoal --k any --index {}", files.path("damaged.idx"));
    // Each run takes milliseconds, so only some bits and lengths are tried, among them the first and the
    // last.
    const SOME: usize = 60;
    for i in 0..=SOME {
        let mut bytes = whole.clone();
        let bit = i * (8 * whole.len() - 1) / SOME;
        bytes[bit / 8] ^= 1 << (bit % 8);
        files.add("damaged.idx", &bytes);
        let message = refused(&files, &line);
        assert!(message.starts_with("error: damaged.idx: expected "), "bit {bit}: {message}");
    }
    for i in 0..SOME {
        let length = i * (whole.len() - 1) / (SOME - 1);
        files.add("damaged.idx", &whole[..length]);
        let message = refused(&files, &line);
        assert!(message.starts_with("error: damaged.idx: expected "), "{length} bytes: {message}");
    }
    files.add("damaged.idx", [&whole[..], b"\0"].concat());
    assert!(refused(&files, &line).contains("copy the file again"));
}

/// Undamaged files, but not as this program writes them.
#[test]
fn an_index_of_another_version_is_refused() {
    let files = Files::new();
    let index =
        IndexFile::read(built(&files, "cave.idx", "builtin:cave --engine subgoal")).expect("an index");
    let map =
        mediant_formats::MapFile::read(crate::common::bundled("cave.map")).expect("our own map").to_grid();
    let saved = |engine: &str, version: u32, rules: Rules, payload: &[u8]| {
        let identity = Identity { map: Some(map.id()), rules, k: Some(K::N8) };
        let key = IndexKey::new(engine, version, identity).expect("a plain name");
        IndexFile::new(key, payload.to_vec()).write(files.path("other.idx")).expect("a file");
        refused(&files, &format!("run builtin:cave --engine subgoal --index {}", files.path("other.idx")))
    };
    let (version, payload) = (index.key().version(), index.clone().into_payload());
    let never = Rules::Center(CornerRule::Never);
    assert_eq!(
        saved("subgoal", version + 1, never, &payload),
        format!(
            "error: other.idx: expected version {version} of the subgoal index, found version {}; prepare it \
             again\n",
            version + 1
        )
    );
    let other = saved("warp", version, never, &payload);
    assert!(other.contains("expected an index of the engine subgoal, found one of warp; "), "{other}");
    let other = saved("subgoal", version, Rules::Corner(DiagonalGap::Open), &payload);
    check_mismatch(&other, "other.idx", ["corner, gap open, k = 3", "center, corners never, k = 3"]);
    for damaged in [&payload[..payload.len() - 4], &payload[..32], &[], &[0xff; 50]] {
        let message = saved("subgoal", version, never, damaged);
        assert!(
            message.starts_with("error: other.idx: these bytes are no subgoal graph of this map: "),
            "{message}"
        );
    }
    // An index says itself what it belongs to, whatever its file says.
    let mut foreign = payload;
    foreign[28] = 2;
    let message = saved("subgoal", version, never, &foreign);
    assert!(
        message.starts_with("error: other.idx: the subgoal graph is for map ") && message.contains("k = 2"),
        "{message}"
    );
}

#[test]
fn a_build_that_fails_leaves_nothing_behind() {
    let files = Files::new();
    let contents = || -> Vec<String> {
        let names = fs::read_dir(files.path("")).expect("the folder");
        names.map(|name| name.expect("a name").file_name().to_string_lossy().into_owned()).collect()
    };
    let line = |path: &str| format!("build builtin:cave --engine subgoal -o {path}");
    let message = refused(&files, &line(&files.path("no/cave.idx")));
    assert!(message.starts_with("error: no/cave.idx: there is no folder no: make it first"), "{message}");
    fs::create_dir(files.path("folder")).expect("a folder");
    let message = refused(&files, &line(&files.path("folder")));
    assert!(message.contains("expected a regular file or none, found a directory"), "{message}");
    assert_eq!(contents(), ["folder"]);
    // A setup that is refused does not touch the file that is there.
    let path = files.add("cave.idx", "kept");
    refused(&files, &format!("build builtin:cave --engine subgoal --k 4 -o {path}"));
    refused(&files, &format!("build builtin:nowhere --engine subgoal -o {path}"));
    assert_eq!(fs::read_to_string(&path).expect("the file"), "kept");
    assert!(!Path::new(&files.path("no")).exists());
    let Ran { status, .. } = mediant(&["build", "builtin:cave", "--engine", "subgoal", "-o", &path]);
    assert_eq!((status, contents().len()), (Some(0), 2), "no temporary file stays");
}

/// In a folder without permission to write, nothing is written. (Root may write everywhere.)
#[cfg(unix)]
#[test]
fn an_unwritable_folder_is_an_error() {
    use std::os::unix::fs::PermissionsExt;
    let files = Files::new();
    let folder = files.path("locked");
    fs::create_dir(&folder).expect("a folder");
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o555)).expect("permissions");
    let path = format!("{folder}/cave.idx");
    let may_write = fs::write(format!("{folder}/probe"), "").is_ok();
    let Ran { status, stderr, .. } = run(&format!("build builtin:cave --engine subgoal -o {path}"));
    assert_eq!(status, Some(if may_write { 0 } else { 2 }), "{stderr}");
    assert_eq!(Path::new(&path).exists(), may_write);
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o755)).expect("permissions");
}

#[test]
fn setups_without_a_subgoal_graph_are_refused() {
    let files = Files::new();
    let refused = |options: &str, message: &str| {
        assert_eq!(refused(&files, &format!("run builtin:cave {options}")), format!("error: {message}\n"));
    };
    for (options, message) in [
        (
            "--engine astar --levels 2",
            "astar takes no levels: leave it out, or choose subgoal, subgoal-theta, hpa",
        ),
        (
            "--engine subgoal --heuristic hk",
            "subgoal takes no heuristic: leave it out, or choose astar, canonical, jps, jps-block, \
             jps-plus, theta, lazy-theta, chpa",
        ),
        (
            "--engine subgoal --k 4",
            "at centers subgoal takes k = 2, or k = 3 with corners never, not k = 4 with corners never: \
             choose one of these, placement corner, or another engine",
        ),
        (
            "--engine subgoal --corners one",
            "at centers subgoal takes k = 2, or k = 3 with corners never, not k = 3 with corners one: \
             choose one of these, placement corner, or another engine",
        ),
        (
            "--engine subgoal-theta --k any",
            "subgoal-theta needs a k from 2 to 12; for any choose anya, subgoal",
        ),
        (
            "--engine subgoal-theta --placement center",
            "subgoal-theta needs placement corner; for center choose astar, dijkstra, wavefront, \
             canonical, jps, jps-block, \
             jps-plus, theta, lazy-theta, subgoal, hpa, chpa, landmarks",
        ),
    ] {
        refused(options, message);
    }
    for levels in ["0", "-1", "x", "4294967296"] {
        refused(
            &format!("--engine subgoal --levels {levels}"),
            &format!(
                "invalid value '{levels}' for '--levels <N|all|contracted|labels>': expected a whole number from 1 to \
                 4294967295, all, contracted or labels; see --help"
            ),
        );
    }
}
